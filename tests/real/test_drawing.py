"""Pictures are small, well-formed, and show what they are given where it is."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import numpy as np
from real import drawing

SVG = "{http://www.w3.org/2000/svg}"


def test_a_long_curve_stays_within_its_frame_and_the_file_small():
    angle = np.linspace(0.0, 200.0, 50_000)
    panel = drawing.Panel("a <run>", [("#000000", np.sin(angle), 1e4 * np.cos(angle))])
    text = drawing.panels([panel] * 6, "x", "y", [("#000000", "measured & told")])
    assert len(text) < 50_000
    frame = ElementTree.fromstring(text).find(f".//{SVG}g/{SVG}rect")
    left, top, wide, high = (float(frame.get(key)) for key in ("x", "y", "width", "height"))
    line = ElementTree.fromstring(text).find(f".//{SVG}polyline").get("points")
    points = np.array([pair.split(",") for pair in line.split()], dtype=float)
    assert (points >= [left, top]).all() and (points <= [left + wide, top + high]).all()


def test_a_map_is_orange_where_too_little_blue_where_too_much_and_empty_where_unknown():
    mean = np.array([[2.0, -2.0], [np.nan, 0.0]])
    text = drawing.heat(mean, np.arange(3.0), np.arange(3.0), "x", "y", "N")
    fills = [rect.get("fill") for rect in ElementTree.fromstring(text).iter(f"{SVG}rect")]
    assert fills[2:] == ["#d55e00", "#0072b2", "#ffffff"]
    assert re.search(r"\+2 N orange", text)
