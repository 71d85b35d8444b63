"""Small pictures of curves and maps as SVG, all as wide as a row of panels so that their letters are as large."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape

import numpy as np
from numpy.typing import NDArray

from dashpot.report.figures.residual_map import told_apart

Array = NDArray[np.float64]

WIDE, HIGH = 240.0, 190.0  # of a panel
LEFT, RIGHT, ABOVE, BELOW = 46.0, 8.0, 20.0, 34.0
IN_A_ROW = 3
MOST = 250  # points of a curve
TICKS = 5  # of a map, on each axis
INK, SOFT = "#1b1f24", "#57606a"
LOWEST, MIDDLE, HIGHEST = np.array([0, 114, 178]), np.array([255, 255, 255]), np.array([213, 94, 0])


@dataclass(frozen=True)
class Panel:
    """Curves (name of the colour, x, y) over common axes, or single points where they make no loop."""

    title: str
    curves: Sequence[tuple[str, Array, Array]]
    points: bool = False


def panels(found: Sequence[Panel], x_title: str, y_title: str, legend: Sequence[tuple[str, str]] = ()) -> str:
    """Panels side by side, each with its own range; `legend` holds colours and words."""
    across = min(len(found), IN_A_ROW)
    rows = -(-len(found) // IN_A_ROW)
    parts = [
        f'<g transform="translate({WIDE * (k % IN_A_ROW):g} {24 + HIGH * (k // IN_A_ROW):g})">'
        f"{_panel(one, x_title, y_title)}</g>"
        for k, one in enumerate(found)
    ]
    words = [f'<tspan fill="{color}" dx="12">{escape(text)}</tspan>' for color, text in legend]
    return _svg(WIDE * across, 24 + HIGH * rows, [f'<text x="{LEFT:g}" y="15">{"".join(words)}</text>', *parts])


def heat(mean: Array, x: Array, y: Array, x_title: str, y_title: str, unit: str) -> str:
    """A map of fields `mean` (ny, nx) over the edges `x` and `y`, drawn as wide as each other; empty where NaN."""
    wide, high = IN_A_ROW * WIDE, 300.0
    top = float(np.nanmax(np.abs(mean)))
    step_x, step_y = (wide - LEFT - RIGHT) / (x.size - 1), (high - ABOVE - BELOW) / (y.size - 1)
    parts = [
        f'<rect x="{LEFT:g}" y="{ABOVE:g}" width="{wide - LEFT - RIGHT:g}" height="{high - ABOVE - BELOW:g}" '
        'fill="#e8ebee"/>'
    ]
    parts += [
        f'<rect x="{LEFT + column * step_x:.1f}" y="{high - BELOW - (row + 1) * step_y:.1f}" width="{step_x:.1f}" '
        f'height="{step_y:.1f}" fill="{_shade(value / top)}"/>'
        for row, values in enumerate(mean)
        for column, value in enumerate(values)
        if np.isfinite(value)
    ]
    for edges, along in ((x, True), (y, False)):
        for k in told_apart(edges, np.unique(np.linspace(0, edges.size - 1, TICKS).astype(int))):
            first, last = k == 0, k == edges.size - 1
            down = 0 if first else 8 if last else 3
            place = (LEFT + k * step_x, high - BELOW + 12) if along else (LEFT - 4, high - BELOW - k * step_y + down)
            parts.append(_words(*place, shown(edges[k]), "middle" if along and not last else "end"))
    parts += [_words(0.5 * wide, high - 6, x_title, "middle"), _words(4, 12, y_title, "start")]
    parts.append(_words(wide - RIGHT, 12, f"-{shown(top)} {unit} blue, +{shown(top)} {unit} orange", "end"))
    return _svg(wide, high, parts)


def shown(value: float) -> str:
    """A number with three digits and, below a million, without an exponent."""
    return f"{float(f'{value:.3g}'):g}"


def _svg(wide: float, high: float, parts: Sequence[str]) -> str:
    style = f'font-family="sans-serif" font-size="10" fill="{INK}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide:g} {high:g}" width="{wide:g}" {style}>'
    return "\n".join([head, '<rect width="100%" height="100%" fill="#ffffff"/>', *parts, "</svg>"]) + "\n"


def _panel(panel: Panel, x_title: str, y_title: str) -> str:
    (x_low, x_high), (y_low, y_high) = (_range([curve[k] for curve in panel.curves]) for k in (1, 2))
    right, bottom = WIDE - RIGHT, HIGH - BELOW

    def place(x: Array, y: Array) -> tuple[Array, Array]:
        return (
            LEFT + (x - x_low) / (x_high - x_low) * (right - LEFT),
            bottom - (y - y_low) / (y_high - y_low) * (bottom - ABOVE),
        )

    frame = (
        f'<rect x="{LEFT:g}" y="{ABOVE:g}" width="{right - LEFT:g}" height="{bottom - ABOVE:g}" fill="none" '
        'stroke="#c9cfd6"/>'
    )
    draw = _dots if panel.points else _line
    lines = [draw(color, *place(x, y)) for color, x, y in panel.curves]
    ticks = [*_ticks((x_low, x_high), LEFT, right, bottom, True), *_ticks((y_low, y_high), bottom, ABOVE, LEFT, False)]
    titles = [
        _words(LEFT, ABOVE - 6, panel.title, "start"),
        _words(0.5 * (LEFT + right), HIGH - 8, x_title, "middle"),
        f'<text x="10" y="{0.5 * (ABOVE + bottom):g}" fill="{SOFT}" text-anchor="middle" '
        f'transform="rotate(-90 10 {0.5 * (ABOVE + bottom):g})">{escape(y_title)}</text>',
    ]
    return "".join([frame, *ticks, *lines, *titles])


def _ticks(ends: tuple[float, float], start: float, stop: float, across: float, along: bool) -> Iterator[str]:
    for share, value in ((0.0, ends[0]), (1.0, ends[1])):
        at = start + share * (stop - start)
        anchor = ("start" if share == 0.0 else "end") if along else "end"
        yield _words(
            at if along else across - 3,
            across + 12 if along else at + (0 if share == 0.0 else 8),
            shown(value),
            anchor,
        )


def _range(parts: Sequence[Array]) -> tuple[float, float]:
    low, high = min(float(part.min()) for part in parts), max(float(part.max()) for part in parts)
    room = 0.03 * (high - low) or 1.0
    return low - room, high + room


def _line(color: str, x: Array, y: Array) -> str:
    points = " ".join(f"{a:.1f},{b:.1f}" for a, b in _some(x, y))
    return f'<polyline points="{points}" fill="none" stroke="{color}" stroke-width="1.2"/>'


def _dots(color: str, x: Array, y: Array) -> str:
    """Lines of no length with round ends."""
    path = "".join(f"M{a:.1f},{b:.1f}h0" for a, b in _some(x, y))
    return f'<path d="{path}" fill="none" stroke="{color}" stroke-width="2.2" stroke-linecap="round" opacity="0.6"/>'


def _some(x: Array, y: Array) -> Iterator[tuple[float, float]]:
    rows = np.unique(np.linspace(0, x.size - 1, min(x.size, MOST)).astype(int))
    return zip(x[rows], y[rows], strict=True)


def _words(x: float, y: float, text: str, anchor: str) -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" fill="{SOFT}" text-anchor="{anchor}">{escape(text)}</text>'


def _shade(share: float) -> str:
    end = HIGHEST if share > 0.0 else LOWEST
    red, green, blue = (MIDDLE + min(abs(share), 1.0) * (end - MIDDLE)).astype(int)
    return f"#{red:02x}{green:02x}{blue:02x}"
