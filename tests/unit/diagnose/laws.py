"""A law for each cause that is none of the elements, on runs that show it: closed forms and own integrations."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from unit.diagnose.rig import (
    DAMPING,
    MOTIONS,
    NETWORK,
    SAMPLES,
    STEP,
    STIFFNESS,
    TIME,
    Array,
    Motion,
    dataset,
    friction,
    line,
    plain,
    relaxation,
)

from dashpot.data.dataset import Dataset
from dashpot.data.run import Run

PARTS = 10  # of a step of the records
FINE = np.linspace(0.0, TIME[-1], PARTS * (SAMPLES - 1) + 1)
REST = 6.0  # s, between two runs of a session
ONLY_SPRING = """\
format: dashpot-network/1
name: plain
branches:
  stiffness: {element: spring, stiffness: {start: 150 N/mm}}
"""
ORIFICE = ONLY_SPRING + "  orifice: {element: quadratic_damper, damping: {start: 8000 N*s^2/m^2}}\n"
BENT = """\
format: dashpot-network/1
name: plain
branches:
  stiffness:
    element: spring
    stiffness: {polynomial: [{start: 150 N/mm}, {start: 1 N/mm^2}, {start: 0.1 N/mm^3}]}
  damping: {element: damper, damping: {start: 200 N*s/m}}
"""


def sweeps(amplitudes: tuple[float, ...], preloads: tuple[float, ...], fastest: float = 12.0) -> dict[str, Motion]:
    """Sweeps of all amplitudes about all preloads, in mm."""
    return {f"a{a:g}_p{p:g}": Motion(1e-3 * a, 1e-3 * p, fastest) for p in preloads for a in amplitudes}


def mixed(motions: Mapping[str, Motion]) -> dict[str, Motion]:
    """The same in an order of which neither amplitude nor preload tells."""
    names = list(motions)
    order = np.random.default_rng(3).permutation(len(names))
    return {names[k]: motions[names[k]] for k in order}


LADDER = sweeps((0.1, 0.3, 1.0, 3.0), (5, 8))
GRID = sweeps((1, 2, 3), (5, 8, 11))
SESSION = mixed(sweeps((1, 2, 4), (6, 9, 12)))


@dataclass(frozen=True)
class Case:
    """A law beside spring and dashpot, or ``alone``, the runs that show it, and the network that lacks it.

    ``session`` answers the force of every run, as one was made after the other; ``recorded`` changes what is kept of a
    run.
    """

    law: Callable[[Motion], Array] | None = None
    session: Callable[[Mapping[str, Motion]], dict[Motion, Array]] | None = None
    alone: bool = False
    motions: Mapping[str, Motion] = field(default_factory=lambda: MOTIONS)
    network: str = NETWORK
    repeats: Mapping[str, str] | None = None
    fault: Mapping[str, Callable[[Array], Array]] | None = None
    settings: Mapping[str, Mapping[str, float]] | None = None
    channels: Mapping[str, Mapping[str, Array]] | None = None
    sheet: str = ""
    kind: str = "sweep"
    recorded: Callable[[Run], Run] = lambda run: run

    def force(self, motion: Motion) -> Array:
        """All that the load cell carries in a run (n,) N."""
        rest = np.zeros(SAMPLES) if self.alone else plain(motion)
        return rest + self.law(motion) if self.law else rest

    def forces(self) -> dict[Motion, Array]:
        """The same of all runs."""
        return self.session(self.motions) if self.session else {m: self.force(m) for m in self.motions.values()}

    def data(self) -> Dataset:
        """The measured runs, the fifth one held out."""
        made = dataset(
            self.forces().__getitem__,
            motions=self.motions,
            held_out=(list(self.motions)[4],),
            repeats=self.repeats,
            fault=self.fault,
            settings=self.settings,
            channels=self.channels,
            kind=self.kind,
        )
        return replace(made, runs=tuple(self.recorded(run) for run in made.runs))


# states of their own


def followed(motion: Motion, rate: Callable[[Array, float, float], Array], start: Array) -> Array:
    """The state (n, k) at every sample by the classical Runge-Kutta method; ``rate(state, x, v)`` is its rate."""
    halves = np.linspace(0.0, TIME[-1], 2 * PARTS * (SAMPLES - 1) + 1)
    x, v = motion.x(halves).tolist(), motion.v(halves).tolist()
    step, state = STEP / PARTS, np.array(start, float)
    found = [state]
    for k in range(0, len(x) - 2, 2):
        one = rate(state, x[k], v[k])
        two = rate(state + 0.5 * step * one, x[k + 1], v[k + 1])
        three = rate(state + 0.5 * step * two, x[k + 1], v[k + 1])
        four = rate(state + step * three, x[k + 2], v[k + 2])
        state = state + step / 6.0 * (one + 2.0 * two + 2.0 * three + four)
        found.append(state)
    return np.array(found[::PARTS])


def bent(motion: Motion) -> Array:
    """A stiffness that grows to both sides."""
    return 1.5e8 * (motion.x() - 8e-3) ** 3 / 8e-3


def blow_off(motion: Motion) -> Array:
    """Two hyperbolas, steep up to the blow-off of each side, flat behind it."""
    v = motion.v()
    knee, most = np.where(v > 0.0, 0.03, 0.05), np.where(v > 0.0, 80.0, 200.0)
    return most * (v / knee) / np.sqrt(1.0 + (v / knee) ** 2)


def filler(motion: Motion) -> Array:
    """Sliders of 3 N/mm each whose yield travels are spread over three decades."""
    travels, force, found = np.geomspace(4e-6, 4e-3, 25), np.zeros(25), [0.0]
    for way in np.diff(motion.x(FINE)).tolist():
        force = np.clip(force + 3e3 * way, -3e3 * travels, 3e3 * travels)
        found.append(force.sum())
    return np.array(found[::PARTS])


def lost_motion(motion: Motion, gap: float = 0.15e-3) -> Array:
    """A spring of 60 N/mm that is pushed to and fro through play."""
    place, found = motion.x(FINE[:1])[0], []
    for x in motion.x(FINE).tolist():
        place = min(max(place, x - gap), x + gap)
        found.append(60e3 * place)
    return np.array(found[::PARTS])


def hose(motion: Motion) -> Array:
    """A spring beside an orifice, 12 kN at 1 m/s in turbulent flow, behind a hose of 100 N/mm."""

    def rate(force: Array, _: float, v: float) -> Array:
        return 100e3 * (v - np.sign(force) * np.sqrt(np.abs(force) / 12e3))

    return STIFFNESS * motion.x() + followed(motion, rate, [0.0])[:, 0]


def soft_fixture(motion: Motion) -> Array:
    """A cubic spring and a dashpot on a fixture that gives by 1.5 mm under a kilonewton."""

    def force(y: Array, x: float) -> Array:
        return (x - y) / 1.5e-6

    def elastic(y: Array) -> Array:
        return STIFFNESS * y + 1.2e9 * y**3

    start, x = motion.x(FINE[:1])[0], motion.x(FINE[:1])[0]
    for _ in range(50):  # the rest position, by Newton
        start -= (elastic(start) - force(start, x)) / (STIFFNESS + 3.6e9 * start**2 + 1.0 / 1.5e-6)
    return force(followed(motion, lambda y, x, v: (force(y, x) - elastic(y)) / 1500.0, [start])[:, 0], motion.x())


def weight_on_spring(motion: Motion) -> Array:
    """A mass of 8 kg hung on a spring of 20 N/mm and a dashpot of 40 N s/m: it swings at 8 Hz."""

    def rate(state: Array, x: float, v: float) -> Array:
        return np.array([state[1], (20e3 * (x - state[0]) + 40.0 * (v - state[1])) / 8.0])

    states = followed(motion, rate, [motion.x(FINE[:1])[0], motion.v(FINE[:1])[0]])
    return 20e3 * (motion.x() - states[:, 0]) + 40.0 * (motion.v() - states[:, 1])


def dragged(motion: Motion) -> Array:
    """A weight of 3 kg held by bristles that slide at 25 N (LuGre)."""
    v, weight, bristle, step, found = motion.v(FINE), 0.0, 0.0, STEP / PARTS, []
    for platform in v.tolist():
        slip = platform - weight
        bent = slip - 120e3 * abs(slip) * bristle / 25.0
        bristle += step * bent
        found.append(120e3 * bristle + 40.0 * bent)
        weight += step * found[-1] / 3.0
    return np.array(found[::PARTS])


# what changes from run to run


def warming(motions: Mapping[str, Motion]) -> dict[Motion, Array]:
    """A damping that takes up less as it is warm: it cools within 20 s, in the rests as well."""
    heat, found = 0.0, {}
    for motion in motions.values():
        course = []
        for square in (motion.v() ** 2).tolist():
            heat += STEP * (DAMPING * square / (1.0 + heat) / 8.0 - heat / 20.0)
            course.append(heat)
        found[motion] = STIFFNESS * motion.x() + 2.0 * DAMPING * motion.v() / (1.0 + np.array(course))
        heat *= np.exp(-REST / 20.0)
    return found


def agitated(motions: Mapping[str, Motion]) -> dict[Motion, Array]:
    """A spring that its motion softens, and that cools within 6 s."""
    warmth, found = 0.0, {}
    for motion in motions.values():
        course = []
        for square in (motion.v() ** 2).tolist():
            warmth += STEP * (square / 0.02 - warmth / 6.0)
            course.append(warmth)
        found[motion] = STIFFNESS * motion.x() * (0.8 + 0.2 * np.exp(-np.array(course))) + DAMPING * motion.v()
        warmth *= np.exp(-REST / 6.0)
    return found


def bedding(motions: Mapping[str, Motion]) -> dict[Motion, Array]:
    """A spring that gets softer where it goes further than ever before in the session."""
    furthest, found = 0.0, {}
    for motion in motions.values():
        reach = np.maximum(furthest, np.maximum.accumulate(np.abs(motion.x())))
        found[motion] = STIFFNESS * motion.x() * (1.0 + 0.3 * np.exp(-reach / 8e-3)) + DAMPING * motion.v()
        furthest = reach[-1]
    return found


def hardening(motions: Mapping[str, Motion]) -> dict[Motion, Array]:
    """A spring that gets harder by an exponential of the clock, whatever its motion and its rest."""
    found = {}
    for number, motion in enumerate(motions.values()):
        clock = number * (TIME[-1] + REST)
        found[motion] = STIFFNESS * motion.x() * (1.2 - 0.2 * np.exp(-clock / 90.0)) + DAMPING * motion.v()
    return found


# what follows a temperature

HOT = {name: 293.0 + 15.0 * (k % 3) for k, name in enumerate(mixed(GRID))}
TEMPERATURES = {GRID[name]: kelvin for name, kelvin in HOT.items()}


def oil(motion: Motion) -> Array:
    """Spring and dashpot; the viscosity of the oil falls with the temperature by the law of Arrhenius."""
    colder = 1.0 / TEMPERATURES[motion] - 1.0 / 293.0
    return STIFFNESS * motion.x() + 3.0 * DAMPING * np.exp(25e3 / 8.314 * colder) * motion.v()


# faults of the channel

AGAIN = {"again": "a3_p8"}


def hum(size: float) -> dict[str, Callable[[Array], Array]]:
    """Mains of another phase in every run."""
    return {name: lambda force, phase=number: force + line(50.0, size, phase) for number, name in enumerate(MOTIONS)}


CASES = {
    "amplitude_softening": Case(filler, motions=LADDER),
    "asymmetric_damping": Case(lambda m: 300.0 * m.v() * (1.0 + np.tanh(m.v() / 5e-3))),
    "bedding_in": Case(session=bedding, motions=SESSION),
    "clearance": Case(lost_motion, motions=LADDER),
    "clipping": Case(fault=dict.fromkeys(MOTIONS, lambda force: np.minimum(force, 2500.0))),
    "compliant_damper": Case(hose, alone=True, network=ORIFICE),
    "creep": Case(lambda m: -12e3 * m.preload * np.log10(1.0 + TIME / 0.02)),
    "delay": Case(lambda m: plain(m, TIME - 4e-3) - plain(m), motions=GRID),
    "drift": Case(repeats=AGAIN, fault={"again": lambda force: force + np.linspace(0.0, 60.0, SAMPLES)}),
    "end_stop": Case(lambda m: 80e3 * np.maximum(m.x() - 12e-3, 0.0)),
    "fading_damping": Case(lambda m: 2.0 * DAMPING * m.v() / (1.0 + TIME / 0.6)),
    "fixture_compliance": Case(soft_fixture, alone=True, motions=GRID, network=BENT, sheet="{compliance: 3e-6 m/N}"),
    "friction": Case(friction),
    "gain": Case(repeats=AGAIN, fault={"again": lambda force: 1.04 * force}),
    "gas_spring": Case(lambda m: 300.0 * (1.0 - m.x() / 25e-3) ** -1.25),
    "heating": Case(session=warming, motions=SESSION),
    "hum": Case(fault=hum(25.0)),
    "lift_off": Case(lambda m: np.maximum(plain(m), 0.0), alone=True, motions=sweeps((1, 3, 5), (2, 4, 12))),
    "load_dependent_friction": Case(lambda m: 25.0 * (m.x() / 8e-3) ** 2 * np.tanh(m.v() / 1e-3)),
    "loose_mass": Case(dragged, motions=sweeps((1, 2, 3), (5, 11))),
    "moving_mass": Case(lambda m: 3.0 * np.gradient(m.v(), STEP)),
    "offset": Case(repeats=AGAIN, fault={"again": lambda force: force + 25.0}),
    "power_law_damping": Case(lambda m: 300.0 * m.v() / np.sqrt(1e-3 + np.abs(m.v()))),
    "preload_dependent_damping": Case(lambda m: DAMPING * (m.x() / 8e-3) ** 2 * m.v()),
    "quadratic_damping": Case(lambda m: 1500.0 * m.v() * np.abs(m.v())),
    "relaxation": Case(relaxation),
    "resonance": Case(weight_on_spring),
    "session_change": Case(session=hardening, motions=SESSION),
    "setting_dependence": Case(
        oil, alone=True, motions=mixed(GRID), settings={name: {"temperature": kelvin} for name, kelvin in HOT.items()}
    ),
    "softening": Case(session=agitated, motions=SESSION),
    "stiffness_curve": Case(bent),
    "valve": Case(blow_off, motions=sweeps((0.3, 1, 3), (5, 11))),
    "velocity_dependent_friction": Case(
        lambda m: (20.0 + 60.0 * np.exp(-((m.v() / 0.02) ** 2))) * np.tanh(m.v() / 5e-4)
    ),
    "viscous_damping": Case(network=ONLY_SPRING),
}


# forms that other data show

WARMING = {name: 293.0 + 10.0 * k + 15.0 * TIME / TIME[-1] for k, name in enumerate(MOTIONS)}
WARM_OIL = {MOTIONS[name]: kelvin for name, kelvin in WARMING.items()}


def warm_oil(motion: Motion) -> Array:
    """Spring and dashpot; the viscosity follows the temperature along the run."""
    colder = 1.0 / WARM_OIL[motion] - 1.0 / 293.0
    return STIFFNESS * motion.x() + 3.0 * DAMPING * np.exp(25e3 / 8.314 * colder) * motion.v()


def wandering(motions: Mapping[str, Motion]) -> dict[Motion, Array]:
    """Spring and dashpot; the zero of the load cell wanders by an exponential of the clock."""
    found = {}
    for number, motion in enumerate(motions.values()):
        clock = TIME + number * (TIME[-1] + REST)
        found[motion] = plain(motion) - 400.0 * np.expm1(-clock / 400.0)
    return found


@dataclass(frozen=True)
class Random(Motion):
    """Random motion: forty sines up to the fastest, all of one velocity, each of a phase of its own."""

    seed: int = 0

    def sines(self, time: Array, turned: float) -> Array:
        """Their sum (n,), each ``turned`` by so many quarters and told over its angular frequency."""
        speeds = 2.0 * np.pi * np.linspace(0.5, self.fastest, 40)
        phases = np.random.default_rng(self.seed).uniform(0.0, 2.0 * np.pi, 40)
        return np.sin(np.outer(time, speeds) + phases + 0.5 * np.pi * turned) @ speeds ** (turned - 1.0)

    def x(self, time: Array = TIME) -> Array:
        """The deflection (n,) in m."""
        return self.preload + self.amplitude * self.sines(time, 0.0)

    def v(self, time: Array = TIME) -> Array:
        """The velocity (n,) in m/s."""
        return self.amplitude * self.sines(time, 1.0)


@dataclass(frozen=True)
class Sine(Motion):
    """A sine of one frequency."""

    def phase(self, time: Array = TIME) -> Array:
        """The angle (n,)."""
        return 2.0 * np.pi * self.fastest * time

    def v(self, time: Array = TIME) -> Array:
        """The velocity (n,) in m/s."""
        return 2.0 * np.pi * self.fastest * self.amplitude * np.cos(self.phase(time))


def in_another_unit(case: Case, name: str, factor: float) -> Case:
    """The case with the displacement of one run as if it were in another unit."""
    return replace(case, channels={name: {"displacement": factor * case.motions[name].x()}})


def at_half_the_rate(run: Run) -> Run:
    """Some runs with every other sample."""
    return cut(run, slice(None, None, 2)) if run.name in ("a1_p5", "a3_p11") else run


def with_gaps(run: Run) -> Run:
    """Some runs without one sample in twenty, their clock from one second on."""
    kept = np.random.default_rng(1).permutation(SAMPLES)[: SAMPLES * 19 // 20]
    return cut(run, np.unique([0, *kept, SAMPLES - 1]), 1.0) if run.name in ("a1_p5", "a3_p11") else run


def shorter(run: Run) -> Run:
    """Some runs that end earlier."""
    return cut(run, slice({"a1_p5": 600, "a3_p11": 800}.get(run.name)))


def cut(run: Run, kept: Array | slice, begin: float = 0.0) -> Run:
    """The samples of a run that are kept, from a time in s on."""
    return replace(
        run, time=begin + run.time[kept], channels={name: values[kept] for name, values in run.channels.items()}
    )


def clipped(run: Run) -> Run:
    """The third run of a session at the end of its range: reading sets it aside."""
    return with_force_of(run, np.minimum(run.force, np.quantile(run.force, 0.93)))


def interrupted(run: Run) -> Run:
    """The third run of a session with a value that is no number, for which it is set aside."""
    return with_force_of(run, np.where(np.arange(SAMPLES) == 500, np.nan, run.force))


def with_force_of(run: Run, force: Array) -> Run:
    """The third run of a session with another force."""
    return replace(run, channels={**run.channels, "force": force}) if run.name == THIRD else run


def slow_loop(run: Run) -> Run:
    """The slow runs among sweeps."""
    return replace(run, kind="quasi_static") if run.name in SLOW or run.repeats in SLOW else run


SLOW = {"slow": Motion(7e-3, 8e-3, 1.0)}
NOISY = {f"r{k}": Random((4e-3, 12e-3)[k % 2], 8e-3, 15.0, k) for k in range(6)}
SINES = {f"f{f:g}_a{a:g}": Sine(1e-3 * a, 8e-3, f) for f in (2.0, 5.0, 10.0) for a in (1, 3)}
BEGIN = {name: {"warm_up": 0.3} for name in (*NOISY, *SINES)}
FIRST, THIRD = list(SESSION)[0], list(SESSION)[2]
CURVE = NETWORK.replace("{start: 150 N/mm}", "{from: quasi_static}")
FURTHER = {
    "temperature along the runs": (
        "setting_dependence",
        Case(warm_oil, alone=True, channels={name: {"temperature": kelvin} for name, kelvin in WARMING.items()}),
    ),
    "zero from run to run": ("drift", Case(session=wandering, motions=SESSION)),
    "random motion": ("relaxation", Case(relaxation, motions=NOISY, settings=BEGIN, kind="random")),
    "random motion in turbulence": (
        "quadratic_damping",
        replace(CASES["quadratic_damping"], motions=NOISY, settings=BEGIN, kind="random"),
    ),
    "a fluid that thins": (  # after Cross, not Carreau
        "power_law_damping",
        Case(lambda m: 2500.0 * m.v() / (1.0 + (np.abs(m.v()) / 0.02) ** 0.7)),
    ),
    "sines": ("friction", Case(friction, motions=SINES, settings=BEGIN, kind="harmonic")),
    "curve of a slow loop": (
        "relaxation",
        Case(lambda m: bent(m) + relaxation(m), motions=MOTIONS | SLOW, network=CURVE, recorded=slow_loop),
    ),
    "gain of a slow loop": (
        "gain",
        Case(
            bent,
            motions=MOTIONS | SLOW,
            network=CURVE,
            recorded=slow_loop,
            repeats={"again": "slow"},
            fault=CASES["gain"].fault,
        ),
    ),
    "force turned round": ("friction", Case(friction, fault={"a3_p5": np.negative})),
    "force in pounds": (
        "gain",
        replace(CASES["setting_dependence"], fault={"a3_p8": lambda force: force / 4.4482216}),
    ),
    "displacement in inches": ("bedding_in", in_another_unit(CASES["bedding_in"], FIRST, 1.0 / 25.4)),
    "displacement in micrometres": ("heating", in_another_unit(CASES["heating"], THIRD, 1e3)),
    "a clipped run": ("softening", replace(CASES["softening"], recorded=clipped)),
    "no number": ("heating", replace(CASES["heating"], recorded=interrupted)),
    "other rates": ("friction", Case(friction, recorded=at_half_the_rate)),
    "gaps": ("hum", replace(CASES["hum"], recorded=with_gaps)),
    "other lengths": ("drift", replace(CASES["drift"], recorded=shorter)),
}


# faults of the channel beside a law


def faults(case: Case) -> dict[str, Case]:
    """The case with a fault of the measurement, by its cause: of a repeated run, or of all runs."""
    again = {"again": list(case.motions)[2]}
    motions = case.motions | {"again": case.motions[again["again"]]}
    forces = case.forces()
    most = 0.97 * max(force.max() for force in forces.values())
    of_again = {
        "gain": lambda force: 1.04 * force,
        "offset": lambda force: force + 25.0,
        "drift": lambda force: force + np.linspace(0.0, 60.0, SAMPLES),
    }
    of_all = {
        "hum": lambda name: lambda force: force + line(50.0, 25.0, len(name) + motions[name].amplitude),
        "clipping": lambda _: lambda force: np.minimum(force, most),
        "delay": lambda _: lambda force: np.concatenate([np.full(2, force[0]), force[:-2]]),
        "moving_mass": lambda name: lambda force: force + 3.0 * np.gradient(motions[name].v(), STEP),
    }
    single = {word: replace(case, repeats=again, fault={"again": fault}) for word, fault in of_again.items()}
    every = {word: replace(case, fault={name: make(name) for name in motions}) for word, make in of_all.items()}
    return single | every
