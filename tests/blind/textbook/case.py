"""One blind case from one seed: specimen, rig, motion, hidden effects, noise, sealed label."""

from __future__ import annotations

import tempfile
from dataclasses import asdict, dataclass, replace
from itertools import islice
from pathlib import Path

import numpy as np
from scipy.signal import lfilter
from truth.case import Case
from truth.label import Hidden, SealedLabel, Truth

from .laws import CLIPPING, DELAY, KINDS, LAWS, Law, delayed
from .motion import MOTIONS, derivative, triangle
from .record import Circumstances, Record
from .rig import RIGS, Rig
from .specimen import NETWORKS, Specimen

NULL = "null"
NULL_SHARE = 0.2
WEAKEST, STRONGEST, RATIO = 0.1, 10.0, 10.0
LEAST_SHARE_LEFT = 0.05  # of a force, that no refit of the network can follow
NOISE_SHARE = (0.002, 0.008)  # of the force without noise
COLOURS = (0.0, 0.3, 0.7)
CLIPPED_PER_STRENGTH, MOST_CLIPPED = 0.004, 3.0  # of all samples; a strength
AGAIN = ((0, 1), (2, 0), (3, 2))
_HEAD = """\
format: dashpot-dataset/1
name: textbook case {seed}
defaults:
  channels:
    time: {{column: time, unit: s}}
    displacement: {{column: s, unit: mm}}
    force: {{column: load, unit: N}}
runs:
"""


def draw_textbook(
    seed: int,
    rig: str,
    kind: str | None = None,
    strength: float | None = None,
    *,
    double: bool = False,
    folder: Path | None = None,
) -> Case:
    """Draw a case and write its dataset and its network.

    rig: a key of RIGS; kind: a word of KINDS, two joined by "+", "null", or None (drawn: one in five null, or two if
    `double`); strength: root mean square that a refit of the network leaves of the effect, over the noise, or None
    (log-uniform from 0.1 to 10; of two, one up to ten times the other); folder: where to write, or None (temporary).
    Everything random comes from `seed`. Raises ValueError for an unknown word, and for a kind that a refit of the
    network follows.
    """
    rng, place = np.random.default_rng([seed, 7]), folder or Path(tempfile.mkdtemp(prefix="textbook-"))
    bench, effects = _Bench.draw(RIGS[rig], rng), []
    kinds = bench.draw_kinds(rng, double) if kind is None else _words(kind)
    for word, value in zip(kinds, _draw_strengths(len(kinds), strength, rng), strict=True):
        bench, effect = bench.hide(word, value, rng)
        effects.append(effect)
    noise = {"rms": bench.noise, "memory": float(rng.choice(COLOURS))}
    realised = bench.write(place, seed, noise["memory"], rng)
    (place / "network.yaml").write_text(bench.specimen.write_network(f"{rig}_{bench.specimen.network}", bench.rig))
    truth = Truth(seed, rig, asdict(bench.specimen), noise, realised, tuple(effects))
    return Case(seed, place, SealedLabel(truth))


@dataclass(frozen=True, eq=False)
class _Bench:
    """A specimen on a rig: its records with what is hidden so far, and the size of the noise [N]."""

    rig: Rig
    specimen: Specimen
    records: tuple[Record, ...]
    circumstances: Circumstances
    noise: float

    @classmethod
    def draw(cls, rig: Rig, rng: np.random.Generator) -> _Bench:
        specimen = Specimen.draw(str(rng.choice(NETWORKS)), rig, rng)
        records = tuple(_records(rig, specimen, rng))
        dynamic = [record.name for record in records if record.dynamic]
        spread = _rms(np.concatenate([record.force - record.force.mean() for record in records]))
        return cls(rig, specimen, records, Circumstances.draw(rig, dynamic, rng), spread * rng.uniform(*NOISE_SHARE))

    def draw_kinds(self, rng: np.random.Generator, double: bool) -> list[str]:
        """None in one case of five, one or two of those that no refit of the network follows."""
        count = 2 if double else int(rng.random() > NULL_SHARE)
        drawn = (str(word) for word in rng.permutation(KINDS))
        shown = (word for word in drawn if word == CLIPPING or self._shown(LAWS[word]))
        return _in_order(list(islice(shown, count)))

    def hide(self, kind: str, strength: float, rng: np.random.Generator) -> tuple[_Bench, Hidden]:
        """The bench with an effect added, and what the label says of it."""
        if kind == CLIPPING:
            return self._clip(strength)
        if not (laws := self._shown(LAWS[kind])):
            network = self.specimen.network
            raise ValueError(f"kind: expected one that a refit of the {network} network does not follow, got '{kind}'")
        law = laws[rng.integers(len(laws))]
        forces = self._forces(law)
        return self._add(kind, law, forces, strength * self.noise / self._left(forces))

    def _shown(self, laws: tuple[Law, ...]) -> list[Law]:
        """Those of which a refit of the network leaves enough to speak of."""
        forces = {law: self._forces(law) for law in laws}
        return [law for law in laws if self._left(forces[law]) > LEAST_SHARE_LEFT * _rms(np.concatenate(forces[law]))]

    def _forces(self, law: Law) -> list[np.ndarray]:
        return [law(record, self.circumstances) for record in self.records]

    def _add(self, kind: str, law: Law, forces: list[np.ndarray], size: float) -> tuple[_Bench, Hidden]:
        if kind == DELAY:
            return self._with(kind, law.__name__, size, [delayed(record, size) for record in self.records])
        return self._with(kind, law.__name__, size, [size * force for force in forces])

    def _clip(self, strength: float) -> tuple[_Bench, Hidden]:
        forces = [record.force for record in self.records]
        level = float(np.quantile(np.concatenate(forces), 1.0 - CLIPPED_PER_STRENGTH * min(strength, MOST_CLIPPED)))
        return self._with(CLIPPING, CLIPPING, level, [np.minimum(level - force, 0.0) for force in forces])

    def _with(self, kind: str, form: str, size: float, added: list[np.ndarray]) -> tuple[_Bench, Hidden]:
        pairs = list(zip(self.records, added, strict=True))
        rms = {record.name: _rms(force) for record, force in pairs}
        raw, left = _rms(np.concatenate(added)) / self.noise, self._left(added) / self.noise
        records = tuple(replace(record, force=record.force + force) for record, force in pairs)
        return replace(self, records=records), Hidden(kind, form, size, "", {}, raw, left, rms)

    def _left(self, forces: list[np.ndarray]) -> float:
        """What the numbers of the network cannot follow, to first order, as root mean square [N]."""
        columns = np.concatenate([self.specimen.tangents(record, self.rig) for record in self.records])
        columns /= np.sqrt((columns**2).mean(axis=0))
        effect = np.concatenate(forces)
        coefficients, *_ = np.linalg.lstsq(columns[::4], effect[::4], rcond=None)
        return _rms(effect - columns @ coefficients)

    def write(self, folder: Path, seed: int, memory: float, rng: np.random.Generator) -> dict[str, float]:
        """Write the dataset; returns the realised noise of every run [N]."""
        folder.mkdir(parents=True, exist_ok=True)
        realised = {}
        for record in self.records:
            error = self._error(record.time.size, memory, rng)
            table = np.column_stack([record.time, record.displacement * 1e3, record.force + error])
            target = folder / f"{record.name}.csv"
            np.savetxt(target, table, delimiter=",", header="time,s,load", comments="", fmt="%.9g")
            realised[record.name] = _rms(error)
        entries = "".join(_entry(record) for record in self.records)
        (folder / "dataset.yaml").write_text(_HEAD.format(seed=seed) + entries, encoding="utf-8")
        return realised

    def _error(self, samples: int, memory: float, rng: np.random.Generator) -> np.ndarray:
        driven = rng.standard_normal(samples + 200)
        return self.noise * lfilter([np.sqrt(1.0 - memory**2)], [1.0, -memory], driven)[200:]


def _records(rig: Rig, specimen: Specimen, rng: np.random.Generator) -> list[Record]:
    """Quasi-static loop, every amplitude at every preload by one kind of motion, three of them and the loop again."""
    motion = MOTIONS[rng.integers(len(MOTIONS))]
    loop = _record(rig, specimen, "static", "quasi_static", triangle(rig))
    grid = {
        (i, j): replace(
            _record(rig, specimen, f"r{i}{j}", "transient", preload + amplitude * motion(rig, rng)),
            amplitude=amplitude,
            preload=preload,
        )
        for i, amplitude in enumerate(rig.amplitudes)
        for j, preload in enumerate(rig.preloads)
    }
    again = [replace(one, name=f"{one.name}_again", repeats=one.name) for one in [*map(grid.get, AGAIN), loop]]
    return [loop, *grid.values(), *again]


def _record(rig: Rig, specimen: Specimen, name: str, kind: str, path: np.ndarray) -> Record:
    velocity = derivative(path, rig.rate)
    time = np.arange(path.size) / rig.rate
    force = specimen.force(path, velocity, rig)
    return Record(name, kind, time, path, velocity, derivative(velocity, rig.rate), force)


def _entry(record: Record) -> str:
    head = f"  - {{name: {record.name}, file: {record.name}.csv, kind: {record.kind}"
    lengths = f"amplitude: {record.amplitude * 1e3:g} mm, preload: {record.preload * 1e3:g} mm"
    settings = f", settings: {{{lengths}}}" if record.dynamic else ""
    again = f", repeats: {record.repeats}" if record.repeats else ""
    return f"{head}{settings}{again}}}\n"


def _words(kind: str) -> list[str]:
    kinds = [] if kind == NULL else kind.split("+")
    if unknown := set(kinds) - set(KINDS):
        raise ValueError(f"kind: expected words of {', '.join(KINDS)}, got {', '.join(sorted(unknown))}")
    return _in_order(kinds)


def _in_order(kinds: list[str]) -> list[str]:
    return sorted(kinds, key=KINDS.index)


def _draw_strengths(count: int, strength: float | None, rng: np.random.Generator) -> list[float]:
    def drawn(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(np.log(low), np.log(high))))

    if strength is not None or count != 2:
        return [drawn(WEAKEST, STRONGEST) if strength is None else strength for _ in range(count)]
    weaker = drawn(WEAKEST, STRONGEST / RATIO)
    both = [weaker, weaker * drawn(1.0, RATIO)]
    return both if rng.random() < 0.5 else both[::-1]


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))
