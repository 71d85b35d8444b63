"""Pictures of a measured set beside a written network: loops, force over velocity, and the map of what is left."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from real.drawing import INK, Panel, heat, panels
from real.trial import simulated

from dashpot.compare.residual_map import residual_maps
from dashpot.compare.strokes import Seen, see
from dashpot.notebook.look import Look

FILE = "#0072b2"
MOST_RUNS, CYCLES, SAMPLES = 6, 2, 250
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
        parts = [_panel(each, word == "velocity", each.name in held_out) for each in chosen]
        drawn.append(
            _write(f"{words}, measured and simulated", stem, word, panels(parts, x_title, "force (N)", legend))
        )
    told = residual_maps(seen)[0]
    (x, x_title), (y, y_title) = (_axis(told[which]) for which in ("x", "y"))
    words = (
        f"Measured less simulated force over the two variables that explain most of it: {x_title} and {y_title}, "
        f"{max(told['explained'], 0.0):.0%} of its mean square"
    )
    return [*drawn, _write(words, stem, "residual", heat(np.asarray(told["mean"]), x, y, x_title, y_title, "N"))]


def _write(words: str, stem: Path, word: str, text: str) -> tuple[str, Path]:
    path = stem.with_name(f"{stem.name}-{word}.svg")
    path.write_text(text, encoding="utf-8")
    return words, path


def _panel(seen: Seen, over_velocity: bool, held_out: bool) -> Panel:
    rows = _piece(seen)
    x = 1e3 * (seen.velocity if over_velocity else seen.displacement)[rows]
    curves = [(color, x, seen.forces[label][rows]) for color, label in ((INK, "measured"), (FILE, "file"))]
    return Panel(seen.name.replace("_", " ") + (" (held out)" if held_out else ""), curves)


def _piece(seen: Seen) -> slice:
    """The last cycles of a run, or its end where it has none."""
    cycles = seen.cycles()
    if cycles:
        return slice(cycles[-min(CYCLES, len(cycles))][0], cycles[-1][1] + 1)
    return slice(max(seen.first, seen.run.time.size - SAMPLES), seen.run.time.size)


def _axis(variable: dict) -> tuple[np.ndarray, str]:
    factor, unit = RIG_UNITS.get(variable["unit"], (1.0, variable["unit"]))
    name = variable["name"].replace("_", " ")
    return factor * np.asarray(variable["edges"], dtype=float), f"{name} ({unit})" if unit else name
