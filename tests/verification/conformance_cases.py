"""Cases of known truth: networks, numbers, motions and sampling rates, drawn one by one from fixed seeds.

A case is written twice: as the text of a network with samples of its motion, for dashpot, and as arrays for
the integrator in ``truth``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from seeds import seed_of
from verification.truth import branches as law
from verification.truth.hybrid import hybrid_force

SPAN, SECONDS = 3e-3, 0.5
ROUGH, FINE = 1e-7, 1e-8  # tolerances of the truth
SETTLED, SETTLED_PEAK, LEAST = 5e-5, 1e-3, 1.0  # shares by which they may differ; N
RATES = (250.0, 500.0, 1000.0, 2000.0, 4000.0)
MOTIONS = ("cosines", "sweep", "steps", "triangle", "small")
FAMILIES = ("interior", "corner")
NUMBERS = 6  # of a law, at most
RANGES = {
    "stiffness": (1e4, 2e6),
    "damping": (30.0, 1e4),
    "other": (30.0, 1e4),
    "force": (10.0, 316.0),
    "creep": (1e-6, 1e-3),
    "time": (1e-3, 1.0),
    "gap": (3e-4, 3e-3),
    "mass": (0.05, 30.0),
    "slow": (1e-3, 1e-1),
}


@dataclass(frozen=True)
class Kind:
    """An element: its number in ``truth``, what it is written as, its numbers in order; whether it always holds."""

    number: int
    text: str
    numbers: tuple[str, ...]
    holds: bool = True


KINDS = {
    "spring": Kind(law.SPRING, "stiffness: {stiffness} N/m", ("stiffness",)),
    "damper": Kind(law.DAMPER, "damping: {damping} N*s/m", ("damping",)),
    "maxwell": Kind(law.MAXWELL, "stiffness: {stiffness} N/m, relaxation_time: {time} s", ("stiffness", "time")),
    "coulomb": Kind(law.COULOMB, "limit: {force} N, creep_velocity: {creep} m/s", ("force", "creep")),
    "dahl": Kind(law.DAHL, "stiffness: {stiffness} N/m, limit: {force} N", ("stiffness", "force")),
    "prandtl": Kind(law.PRANDTL, "stiffness: {stiffness} N/m, limit: {force} N", ("stiffness", "force")),
    "end_stop": Kind(law.STOP, "stiffness: {stiffness} N/m, compression: {gap} m", ("stiffness", "gap"), False),
    "contact": Kind(law.STOP, "stiffness: {stiffness} N/m", ("stiffness", ""), False),
    "clearance": Kind(law.CLEARANCE, "stiffness: {stiffness} N/m, gap: {gap} m", ("stiffness", "gap"), False),
    "backlash": Kind(law.BACKLASH, "stiffness: {stiffness} N/m, gap: {gap} m", ("stiffness", "gap"), False),
    "bouc_wen": Kind(
        law.BOUC_WEN, "stiffness: {stiffness} N/m, limit: {force} N, shape: 0.7, exponent: 1.5", ("stiffness", "force")
    ),
    "iwan": Kind(law.IWAN, "stiffness: {stiffness} N/m, shortest: 0.05 mm, longest: 1 mm", ("stiffness",)),
    "quadratic_damper": Kind(law.QUADRATIC, "damping: {damping} N*s^2/m^2", ("damping",)),
    "loose_friction": Kind(
        law.LOOSE, "limit: {force} N, stiffness: {stiffness} N/m, gap: 0.3 mm", ("stiffness", "force"), False
    ),
    "asymmetric_damper": Kind(
        law.ASYMMETRIC,
        "compression: {damping} N*s/m, rebound: {other} N*s/m, compression_digression: 3 s/m",
        ("damping", "other"),
    ),
}
MORE = {"bouc_wen": (0.7, 1.5), "iwan": (5e-5, 1e-3), "loose_friction": (3e-4,), "asymmetric_damper": (3.0,)}


@dataclass(frozen=True)
class Motion:
    """The motion of the driven node, from zero: cosines (amplitude, omega, phase), smooth steps (height, time, width),
    and a sweep (amplitude, first frequency, rise of the frequency in a second); see ``place_and_speed`` in ``truth``.
    """

    waves: np.ndarray
    steps: np.ndarray
    sweep: np.ndarray

    def sampled(self, t: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Place, speed and acceleration (samples,)."""
        x, v, a = np.zeros((3, t.size))
        for amplitude, omega, phase in self.waves:
            x += amplitude * (np.cos(omega * t + phase) - np.cos(phase))
            v -= amplitude * omega * np.sin(omega * t + phase)
            a -= amplitude * omega**2 * np.cos(omega * t + phase)
        for height, time, width in self.steps:
            level = np.tanh((t - time) / width)
            x += 0.5 * height * (level - np.tanh(-time / width))
            v += 0.5 * height * (1.0 - level**2) / width
            a -= height * level * (1.0 - level**2) / width**2
        amplitude, first, rise = self.sweep
        angle, rate = 2.0 * np.pi * t * (first + 0.5 * rise * t), 2.0 * np.pi * (first + rise * t)
        x += amplitude * np.sin(angle)
        v += amplitude * rate * np.cos(angle)
        a += amplitude * (2.0 * np.pi * rise * np.cos(angle) - rate**2 * np.sin(angle))
        return x, v, a


@dataclass(frozen=True)
class Case:
    """A network with its motion; ``text`` for dashpot, the arrays for the truth."""

    name: str
    family: str
    kind: str
    rate: float
    words: tuple[str, ...]
    nodes: str
    branches: str
    motion: Motion
    mass: np.ndarray
    kinds: np.ndarray
    ends: np.ndarray
    numbers: np.ndarray

    @property
    def samples(self) -> int:
        return round(SECONDS * self.rate) + 1

    def truth(self, tolerance: float = FINE) -> np.ndarray:
        """The force on the driven node (samples,) in N; NaN where the integrator finds none."""
        return hybrid_force(
            self.samples,
            1.0 / self.rate,
            self.mass,
            self.kinds,
            self.ends,
            self.numbers,
            (self.motion.waves, self.motion.steps, self.motion.sweep),
            SPAN,
            tolerance,
        )


@dataclass(frozen=True)
class Known:
    """A case with its true force (samples,) in N; the root mean square and the peak in N by which two tolerances
    differ; how many draws were set aside before it."""

    case: Case
    force: np.ndarray
    doubt: float
    doubt_peak: float
    aside: int


def settled_case(number: int) -> Known:
    """The case of a number with its truth.

    Families, motions and rates come in turn, so that every number of cases has all of them. A draw is set aside where
    the force is hardly any, or where the truth itself is not settled: two tolerances do not give the same, as where
    impacts make more and more of each difference. dashpot is not asked.
    """
    rng = np.random.default_rng(seed_of(f"conformance {number}"))
    family, kind = FAMILIES[number % len(FAMILIES)], MOTIONS[number // 2 % len(MOTIONS)]
    rate, aside = RATES[number // 10 % len(RATES)], 0
    while True:
        case = _drawn(rng, number, family, kind, rate)
        if case is None:
            continue
        rough, truth = case.truth(ROUGH), case.truth(FINE)
        size, doubt = np.sqrt(np.mean(truth**2)), np.abs(rough - truth)
        if size > LEAST and np.sqrt(np.mean(doubt**2)) < SETTLED * size and np.max(doubt) < SETTLED_PEAK * size:
            return Known(case, truth, float(np.sqrt(np.mean(doubt**2))), float(np.max(doubt)), aside)
        aside += 1


def _drawn(rng: np.random.Generator, number: int, family: str, kind: str, rate: float) -> Case | None:
    free = [f"n{place}" for place in range(1, rng.integers(2, 6))]
    mass = [_number(rng, "mass", family) if rng.random() < 0.4 else 0.0 for _ in free]
    chain = ["base", *free, "wall"]
    pairs = [pair for pair in zip(chain[:-1], chain[1:], strict=True) for _ in range(rng.integers(1, 4))]
    for _ in range(rng.integers(0, 3)):
        first, second = np.sort(rng.choice(len(chain), 2, replace=False))
        pairs.append((chain[first], chain[second]))
    words = tuple(str(word) for word in rng.choice(list(KINDS), len(pairs)))
    places = {name: place for place, name in enumerate(free)} | {"base": -1, "wall": -2}
    ends = np.array([[places[lower], places[upper]] for lower, upper in pairs])
    if not _held(mass, words, ends):
        return None
    numbers, lines = np.zeros((len(pairs), NUMBERS)), []
    for row, (word, (lower, upper)) in enumerate(zip(words, pairs, strict=True)):
        drawn = {key: _number(rng, key, family) for key in RANGES}
        given = (*(drawn[key] if key else 0.0 for key in KINDS[word].numbers), *MORE.get(word, ()))
        numbers[row, : len(given)] = given
        lines.append(f"e{row}: {{element: {word}, {KINDS[word].text.format(**drawn)}, between: [{lower}, {upper}]}}")
    holds = [f"{{mass: {kg} kg}}" if kg else "free" for kg in mass]
    nodes = ["base: driven", "wall: ground", *(f"{n}: {hold}" for n, hold in zip(free, holds, strict=True))]
    return Case(
        f"case {number}",
        family,
        kind,
        rate,
        words,
        "{" + ", ".join(nodes) + "}",
        "\n".join(lines),
        _motion(rng, kind, rate),
        np.array(mass),
        np.array([KINDS[word].number for word in words]),
        ends,
        numbers,
    )


def _held(mass: list[float], words: tuple[str, ...], ends: np.ndarray) -> bool:
    """Whether every node without a mass is held, by elements that never let go, to one with a mass or to the outside;
    else its place is not determined while a gap is open."""
    reached = {-1, -2, *(place for place, kg in enumerate(mass) if kg)}
    for _ in mass:
        for word, (lower, upper) in zip(words, ends.tolist(), strict=True):
            if KINDS[word].holds and reached & {lower, upper}:
                reached |= {lower, upper}
    return len(reached) == len(mass) + 2


def _number(rng: np.random.Generator, key: str, family: str) -> float:
    low, high = RANGES[key]
    number = np.exp(rng.uniform(np.log(low), np.log(high))) if family == "interior" else rng.choice([low, high])
    return float(f"{number:.6g}")


def _motion(rng: np.random.Generator, kind: str, rate: float) -> Motion:
    waves, steps, sweep = np.zeros((0, 3)), np.zeros((0, 3)), np.array([0.0, 1.0, 0.0])
    if kind in ("cosines", "small"):
        span = SPAN if kind == "cosines" else 0.1 * SPAN
        count = 6
        heights, omegas = rng.standard_normal(count), 2.0 * np.pi * rng.uniform(3.0, 20.0, count)
        waves = np.stack((heights, omegas, rng.uniform(-np.pi, np.pi, count)), axis=1)
        waves[:, 0] *= span / np.abs(Motion(waves, steps, sweep).sampled(np.linspace(0.0, SECONDS, 2000))[0]).max()
    elif kind == "sweep":
        sweep = np.array([SPAN, 1.0, 19.0 / SECONDS])
    elif kind == "steps":
        # four samples and more in a width, so that their rates tell the way between them
        width = max(3e-3, 4.0 / rate)
        steps = np.array([[SPAN, 0.1, width], [-1.5 * SPAN, 0.25, width], [SPAN, 0.4, width]])
    else:
        harmonics, omega = np.arange(1, 12, 2), 2.0 * np.pi * rng.uniform(3.0, 8.0 if rate > 500.0 else 4.0)
        signs = np.where(harmonics % 4 == 1, 1.0, -1.0)
        waves = np.stack([signs * 8.0 / np.pi**2 * SPAN / harmonics**2, omega * harmonics, np.full(6, -0.5 * np.pi)], 1)
    return Motion(waves, steps, sweep)
