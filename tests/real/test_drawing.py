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


def test_a_map_is_as_wide_as_a_row_of_panels_and_its_letters_as_large():
    """A page draws both as wide as itself."""
    mean, edges, line = np.ones((3, 3)), np.arange(4.0), np.arange(3.0)
    row = drawing.panels([drawing.Panel("a", [("#000000", line, line)])] * 3, "x", "y")
    pair = [ElementTree.fromstring(text) for text in (drawing.heat(mean, edges, edges, "x", "y", "N"), row)]
    assert [each.get("viewBox").split()[2] for each in pair] == ["720", "720"]
    assert len({each.get("font-size") for each in pair}) == 1


def test_all_words_of_a_map_lie_within_it_and_apart():
    """A letter is at most 7 wide and 10 high at this size."""
    edges = np.array([-320_000.0, -83_900.0, -14_100.0, 83_900.0, 305_000.0])
    found = ElementTree.fromstring(drawing.heat(np.ones((4, 4)), edges, edges, "place of it (mm)", "force (N)", "N"))
    boxes = []
    for each in found.iter(f"{SVG}text"):
        x, y, wide = float(each.get("x")), float(each.get("y")), 6.0 * len(each.text)
        left = x - {"start": 0.0, "middle": 0.5, "end": 1.0}[each.get("text-anchor")] * wide
        boxes.append((left, left + wide, y - 8.0, y))
    assert all(left >= 0.0 and right <= 720.0 for left, right, _, _ in boxes)
    for k, (left, right, top, bottom) in enumerate(boxes):
        for others_left, others_right, others_top, others_bottom in boxes[:k]:
            assert others_right <= left or right <= others_left or others_bottom <= top or bottom <= others_top


def test_edges_that_read_alike_have_one_tick():
    edges = np.array([-0.0251, -0.0244, 0.0965, 0.203, 0.204])
    text = drawing.heat(np.ones((4, 4)), edges, edges, "x", "y", "N")
    told = [each.text for each in ElementTree.fromstring(text).iter(f"{SVG}text")]
    assert told[:6] == ["-0.0251", "0.0965", "0.203"] * 2


def test_what_is_no_loop_is_drawn_as_points():
    x = np.linspace(0.0, 1.0, 40)
    text = drawing.panels([drawing.Panel("a", [("#000000", x, x)], points=True)], "x", "y")
    found = ElementTree.fromstring(text)
    assert not list(found.iter(f"{SVG}polyline"))
    assert next(found.iter(f"{SVG}path")).get("d").count("M") == 40


def test_a_map_is_orange_where_too_little_blue_where_too_much_and_empty_where_unknown():
    mean = np.array([[2.0, -2.0], [np.nan, 0.0]])
    text = drawing.heat(mean, np.arange(3.0), np.arange(3.0), "x", "y", "N")
    fills = [rect.get("fill") for rect in ElementTree.fromstring(text).iter(f"{SVG}rect")]
    assert fills[2:] == ["#d55e00", "#0072b2", "#ffffff"]
    assert re.search(r"\+2 N orange", text)
