"""What is drawn can be seen: contrast after WCAG 2.1."""

from __future__ import annotations

import pytest

from dashpot.report.theme import DARK, LIGHT, shortened

TEXTS = ("ink", "soft", "link", "good", "warning", "bad")
LINES = ("measured", "before", "after", "model-1", "model-2", "model-3", "model-6", "ordered-1", "ordered-4")
LINES += ("model-4", "model-5", "model-7", "model-8", "model-9", "held-out", "ordered-2", "ordered-3")


def luminance(color: str) -> float:
    parts = (int(color[index : index + 2], 16) / 255.0 for index in (1, 3, 5))
    red, green, blue = (part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def contrast(one: str, other: str) -> float:
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("colors", [LIGHT, DARK], ids=["light", "dark"])
@pytest.mark.parametrize("ground", ["paper", "panel"])
@pytest.mark.parametrize("name", TEXTS)
def test_texts_can_be_read(colors, ground, name):
    assert contrast(colors[name], colors[ground]) >= 4.5


@pytest.mark.parametrize("colors", [LIGHT, DARK], ids=["light", "dark"])
@pytest.mark.parametrize("name", LINES)
def test_lines_can_be_seen(colors, name):
    assert contrast(colors[name], colors["paper"]) >= 2.8


@pytest.mark.parametrize("colors", [LIGHT, DARK], ids=["light", "dark"])
def test_errors_grow_monotonically_in_lightness(colors):
    shades = [luminance(colors[f"heat-{index}"]) for index in range(1, 6)]
    assert shades in (sorted(shades), sorted(shades, reverse=True))


def test_both_themes_have_the_same_colours():
    assert LIGHT.keys() == DARK.keys()


def test_a_long_name_loses_its_middle_and_a_short_one_nothing():
    assert shortened("a1_p15", 28) == "a1_p15"
    short = shortened("2023-11-04_bearing_rig_run_0017_repeat_2", 28)
    assert len(short) <= 28 and short.startswith("2023-11-04") and short.endswith("repeat_2")
