"""One blind case from one seed: specimen, hidden effect, measurement, sealed label."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from .axle_case import draw_axle
from .base import BRANCHES_OF_MODEL, KIND_OF_BRANCH, Base, draw_base
from .branches import Branch
from .design import DESIGNS, Plan
from .effects import FAULTS, FORMS, KINDS_OF_BASE
from .fault import Fault
from .folder import write_dataset
from .form import DoesNotShow, Forces, Form, alternating_rms, log_uniform
from .label import Hidden, SealedLabel, Truth
from .motion import Motion, at_samples
from .noise import Noise
from .sensor import DATA_SHEET, EXACT, Channel, draw_channels

NULL = "null"
NULL_SHARE = 0.2
WEAKEST, STRONGEST, RATIO = 0.1, 10.0, 10.0
MOST_DRAWS = 50  # of forms that do not show in a design
DISPLACEMENT_NOISE = 2e-6


@dataclass(frozen=True)
class Case:
    """What an engine may see (`folder`, holding dataset.yaml), and the label it may not."""

    seed: int
    folder: Path
    label: SealedLabel


def draw_case(
    seed: int,
    base: str = "kelvin_voigt",
    kind: str | None = None,
    strength: float | None = None,
    *,
    design: str = "full",
    form: str | None = None,
    model: str | None = None,
    sensors: bool = False,
    further: tuple[Plan, ...] = (),
    folder: Path | None = None,
) -> Case:
    """Draw a case and write its dataset.

    base: a key of KINDS_OF_BASE; kind: a cause word, several joined by "+", "null", or None (drawn, one in five null);
    strength: effect over noise (root mean squares), or None (log-uniform from 0.1 to 10; of two, one up to ten times
    the other); design: a key of DESIGNS;
    form: class name of one functional form of the kind, or None (drawn); model: the network that will be diagnosed, or
    None (that of the base): branches of the base that it lacks are hidden, too; a kind is drawn from those of both;
    sensors: whether the force channel errs within
    its data sheet, which the dataset then states; further: runs behind those of the design, the same specimen on them;
    folder: where to write, or None (temporary).
    An axle has one design and exact channels. Everything random comes from `seed`. Raises ValueError where a word is
    unknown, and where the runs of a design show no form of a kind; a form that they do not show is drawn again.
    """
    _check(base, kind, form, design, model)
    rng, place = np.random.default_rng([seed, 0]), folder or Path(tempfile.mkdtemp(prefix="blind-"))
    if base == "axle":
        kinds = _draw_kinds(KINDS_OF_BASE[base], kind, rng)
        truth = draw_axle(seed, kinds, _draw_strengths(kinds, strength, rng), rng, place)
        return Case(seed, place, SealedLabel(truth))
    specimen, noise, plans = draw_base(base, rng), Noise.draw(rng), DESIGNS[design]
    runs, kinds_of_both = len(plans), [word for word in KINDS_OF_BASE[base] if word in KINDS_OF_BASE[model or base]]
    plans = (*plans, *further)
    for _ in range(MOST_DRAWS):
        forms = [_draw_form(word, form, rng, runs) for word in _draw_kinds(kinds_of_both, kind, rng)]
        strengths, bench = _draw_strengths(forms, strength, rng), _Bench(plans, specimen, model)
        try:
            effects = (
                *bench.branches_unknown(noise.rms),
                *(bench.hide(form, value, noise.rms) for form, value in zip(forms, strengths, strict=True)),
            )
            break
        except DoesNotShow:
            continue
    else:
        raise DoesNotShow(f"kind: expected one that shows in the runs of '{design}', got '{kind}'")
    channels = draw_channels(len(plans), np.random.default_rng([seed, 2])) if sensors else (EXACT,) * len(plans)
    measured, noise_rms = bench.measure(noise, channels, np.random.default_rng([seed, 1]))
    write_dataset(place, f"blind case {seed}", measured, DATA_SHEET if sensors else None)
    truth = Truth(seed, design, asdict(specimen), asdict(noise), noise_rms, effects)
    return Case(seed, place, SealedLabel(truth))


class _Bench:
    """A specimen on the rig: the noise-free force of every path, to which effects are added in turn."""

    def __init__(self, plans: tuple[Plan, ...], specimen: Base, model: str | None = None) -> None:
        self.plans = plans
        self.specimen = specimen
        self.known = specimen.known_to(model) if model else specimen
        driven = {plan.path: plan for plan in plans}
        self.paths = list(driven)
        self.motions = [plan.motion for plan in driven.values()]
        self.dynamic = [plan.dynamic for plan in driven.values()]
        self.forces: Forces = [specimen.force(motion) for motion in self.motions]
        self.faults: Forces = [np.zeros(at_samples(motion.time).size) for motion in map(self._motion, plans)]

    def branches_unknown(self, noise_rms: float) -> list[Hidden]:
        """What the label says of the branches that the diagnosed network lacks."""
        return [
            self._told(KIND_OF_BRANCH[word], branch, 1.0, [branch.force(motion) for motion in self.motions], noise_rms)
            for word, branch in self.specimen.branches.items()
            if word not in self.known.branches
        ]

    def hide(self, form: Form | Fault, strength: float, noise_rms: float) -> Hidden:
        """Add an effect to the forces, or a fault to the channel; returns what the label says of it."""
        if isinstance(form, Fault):
            return self._spoil(form, strength, noise_rms)
        return self._hide(form, strength, noise_rms)

    def _spoil(self, form: Fault, strength: float, noise_rms: float) -> Hidden:
        forces = [at_samples(self.forces[self.paths.index(plan.path)]) for plan in self.plans]
        size, added = form.at_rms(forces, [plan.dynamic for plan in self.plans], strength * noise_rms)
        self.faults = [fault + more for fault, more in zip(self.faults, added, strict=True)]
        motions = [self._motion(plan) for plan in self.plans]
        return Hidden(
            kind=form.kind,
            form=type(form).__name__,
            size=size,
            unit=form.unit,
            parameters=asdict(form),
            strength=strength,
            strength_left=_rms_left(self.known, motions, added) / noise_rms,
            rms={plan.name: _rms(more) for plan, more in zip(self.plans, added, strict=True)},
        )

    def _motion(self, plan: Plan) -> Motion:
        return self.motions[self.paths.index(plan.path)]

    def _hide(self, form: Form, strength: float, noise_rms: float) -> Hidden:
        size, added = form.at_rms(self.motions, self.forces, self.dynamic, strength * noise_rms)
        self.forces = [force + more for force, more in zip(self.forces, added, strict=True)]
        return self._told(form.kind, form, size, added, noise_rms, form.unit)

    def _told(self, kind: str, law: Form | Branch, size: float, added: Forces, noise_rms: float, unit="1") -> Hidden:
        sampled = [at_samples(more) for more in added]
        shown = alternating_rms([more for more, counts in zip(added, self.dynamic, strict=True) if counts])
        return Hidden(
            kind=kind,
            form=type(law).__name__,
            size=size,
            unit=unit,
            parameters=asdict(law),
            strength=shown / noise_rms,
            strength_left=_rms_left(self.known, self.motions, sampled) / noise_rms,
            rms=self._per_run([_rms(more) for more in sampled]),
        )

    def measure(
        self, noise: Noise, channels: Sequence[Channel], rng: np.random.Generator
    ) -> tuple[dict, dict[str, float]]:
        """Displacement and force of every run with noise, and the realised noise per run."""
        measured, realised = {}, {}
        for plan, fault, channel in zip(self.plans, self.faults, channels, strict=True):
            place = self.paths.index(plan.path)
            displacement = at_samples(self.motions[place].displacement)
            error = noise.sample(rng, displacement.size)
            jitter = DISPLACEMENT_NOISE * rng.standard_normal(displacement.size)
            force = channel.shows(self.motions[place].time, self.forces[place])
            measured[plan] = displacement + jitter, at_samples(force) + fault + error
            realised[plan.name] = _rms(error)
        return measured, realised

    def _per_run(self, values: list[float]) -> dict[str, float]:
        return {plan.name: values[self.paths.index(plan.path)] for plan in self.plans}


def _rms_left(specimen: Base, motions: list[Motion], added: Forces) -> float:
    """What the numbers of the base cannot follow of the effect, to first order, as root mean square."""
    columns = np.concatenate([specimen.tangents(motion) for motion in motions])
    sizes = np.sqrt((columns**2).mean(axis=0))
    columns = columns[:, sizes > 0.0] / sizes[sizes > 0.0]
    effect = np.concatenate(added)
    coefficients, *_ = np.linalg.lstsq(columns[::4], effect[::4], rcond=None)
    return _rms(effect - columns @ coefficients)


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _draw_kinds(known: Sequence[str], kind: str | None, rng: np.random.Generator) -> list[str]:
    """The kinds to hide; a late channel comes last, it delays all the rest."""
    drawn = NULL if rng.random() < NULL_SHARE else str(rng.choice(known))
    asked = drawn if kind is None else kind
    return [] if asked == NULL else sorted(asked.split("+"), key=lambda word: word == "delay")


def _draw_strengths(hidden: Sequence, strength: float | None, rng: np.random.Generator) -> list[float]:
    if strength is not None or len(hidden) != 2:
        return [log_uniform(rng, WEAKEST, STRONGEST) if strength is None else strength for _ in hidden]
    weaker = log_uniform(rng, WEAKEST, STRONGEST / RATIO)
    both = [weaker, weaker * log_uniform(rng, 1.0, RATIO)]
    return both if rng.random() < 0.5 else both[::-1]


def _draw_form(kind: str, form: str | None, rng: np.random.Generator, runs: int) -> Form | Fault:
    candidates = FAULTS[kind] if kind in FAULTS else FORMS[kind]
    known = {candidate.__name__: candidate for candidate in candidates}
    drawn = str(rng.choice(list(known)))
    chosen = known.get(form, known[drawn])
    return chosen.draw(rng, runs) if kind in FAULTS else chosen.draw(rng)


def _check(base: str, kind: str | None, form: str | None, design: str, model: str | None) -> None:
    _expect("base", base, KINDS_OF_BASE)
    if model is not None:
        _expect("model", model, BRANCHES_OF_MODEL)
        _expect("base of another model", base, BRANCHES_OF_MODEL)
    _expect("design", design, DESIGNS)
    kinds = [] if kind in (None, NULL) else kind.split("+")
    for word in kinds:
        _expect("kind", word, {**FORMS, **FAULTS})
    if form is not None:
        _expect("form", form, [known.__name__ for word in kinds for known in (FAULTS.get(word) or FORMS[word])])


def _expect(what: str, got: str, known) -> None:
    if got not in known:
        raise ValueError(f"{what}: expected one of {', '.join(known)}, got {got!r}")
