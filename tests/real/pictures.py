"""Pictures of a measured set beside a written network: loops, force over velocity, and the map of what is left."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray
from real.drawing import INK, Panel, heat, panels
from real.trial import simulated

from dashpot.compare.residual_map import residual_maps
from dashpot.compare.strokes import CLOSED, Seen, see
from dashpot.notebook.look import Look
from dashpot.text.digits import rig_unit

Array = NDArray[np.float64]

FILE = "#0072b2"
MOST_RUNS, CYCLES = 6, 2
RIG_UNITS = {"m": (1e3, "mm"), "m/s": (1e3, "mm/s")}


def pictures(look: Look, network: Path, found: Path, stem: Path) -> list[tuple[str, Path]]:
    """Draw a set with the force of a written network; the words for each picture, and its file.

    `found` is the folder of the diagnosis, beside whose ``data`` the runs are described.
    """
    forces = {"file": simulated(network, found.parent / "data" / "dataset.yaml")}
    held_out = set(look.setting.split.held_out)
    runs = [run for run in look.setting.dataset.runs if run.name in forces["file"]]
    seen = [see(run, forces) for run in runs]
    chosen = [seen[k] for k in np.unique(np.linspace(0, len(seen) - 1, MOST_RUNS).astype(int))]
    legend = [(INK, "measured"), (FILE, "written file")]
    drawn = []
    for word, words, x_title in (
        ("loops", "Force over displacement", "displacement (mm)"),
        ("velocity", "Force over velocity", "velocity (mm/s)"),
    ):
        parts = _panels(chosen, word == "velocity", held_out)
        drawn.append(
            _write(f"{words}, measured and simulated", stem, word, panels(parts, x_title, "force (N)", legend))
        )
    return [*drawn, _residual([each for each in seen if each.name not in held_out], stem)]


def _residual(seen: Sequence[Seen], stem: Path) -> tuple[str, Path]:
    """The map of what is left in some runs."""
    told = residual_maps(seen)[0]
    (x, x_title), (y, y_title) = (_axis(told[which]) for which in ("x", "y"))
    words = (
        "Measured less simulated force of the training runs over the two variables that explain most of it: "
        f"{x_title} and {y_title}, {max(told['explained'], 0.0):.0%} of its mean square"
    )
    mean, unit = _in_rig_unit(told["mean"], "N")
    return _write(words, stem, "residual", heat(mean, x, y, x_title, y_title, unit))


def _write(words: str, stem: Path, word: str, text: str) -> tuple[str, Path]:
    path = stem.with_name(f"{stem.name}-{word}.svg")
    path.write_text(text, encoding="utf-8")
    return words, path


def _panels(seen: Sequence[Seen], over_velocity: bool, held_out: Collection[str]) -> list[Panel]:
    """Loops as lines; as points runs without cycles, and all of a kind of which one is torn: like runs look alike."""
    over = [(each, 1e3 * (each.velocity if over_velocity else each.displacement)) for each in seen]
    torn = {each.run.kind for each, x in over if each.cycles() and not _is_closed(each, x)}
    return [_panel(each, x, bool(each.cycles()) and each.run.kind not in torn, held_out) for each, x in over]


def _panel(seen: Seen, x: Array, loops: bool, held_out: Collection[str]) -> Panel:
    rows = _piece(seen) if loops else slice(seen.first, None)
    x = x[rows]
    curves = [(color, x, seen.forces[label][rows]) for color, label in ((INK, "measured"), (FILE, "file"))]
    return Panel(seen.name.replace("_", " ") + (" (held out)" if seen.name in held_out else ""), curves, not loops)


def _is_closed(seen: Seen, x: Array) -> bool:
    """Whether the last cycles of a run are closed over `x` (n,), and not only by chance as in random motion.

    A reversal lies up to half a sample beside its place, so that the velocity there is up to pi / N of its size with
    N samples of a cycle.
    """
    piece = x[_piece(seen)]
    samples = (piece.size - 1) / min(CYCLES, len(seen.cycles()))
    closed = abs(piece[-1] - piece[0]) <= max(CLOSED, np.pi / samples) * np.ptp(piece)
    return bool(closed) and seen.run.kind != "random"


def _piece(seen: Seen) -> slice:
    """The last cycles of a run."""
    cycles = seen.cycles()
    return slice(cycles[-min(CYCLES, len(cycles))][0], cycles[-1][1] + 1)


def _axis(variable: dict) -> tuple[np.ndarray, str]:
    edges, unit = _in_rig_unit(variable["edges"], variable["unit"])
    name = variable["name"].replace("_", " ")
    return edges, f"{name} ({unit})" if unit else name


def _in_rig_unit(values: ArrayLike, unit: str) -> tuple[Array, str]:
    """Values in the unit of the other pictures, forces in the one that suits the largest; settings as they are told."""
    values = np.asarray(values, dtype=float)
    force = rig_unit("N", float(np.nanmax(np.abs(values))))
    factor, shown = force if unit == "N" else RIG_UNITS.get(unit, (1.0, unit))
    return factor * values, shown
