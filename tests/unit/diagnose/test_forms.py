"""The form in which a cause is written: that of its forms which predicts best."""

from dataclasses import replace

import numpy as np
import pytest
from unit.diagnose.rig import (
    DAMPING,
    MOTIONS,
    NETWORK,
    NOISE,
    REGISTRY,
    STIFFNESS,
    TIME,
    dataset,
    friction,
    plain,
    with_force,
)

from dashpot.diagnose.diagnose import diagnose
from dashpot.model.reading import parse_network

REPEATS = {"again": "a3_p8"}


def rubbing(motion):
    """A sharp slider behind a spring beside spring and dashpot (n,) N."""
    return plain(motion) + friction(motion, limit=400.0, travel=0.5e-3)


@pytest.mark.parametrize("late", [0.0, 4e-3])
def test_a_sharp_slider_is_written_as_one(late):
    """A rounded one is wrong by less than a form may be, and still leaves twice the noise."""

    def shown(motion):
        return np.interp(TIME - late, TIME, rubbing(motion))

    found = diagnose(parse_network(NETWORK, REGISTRY.elements), dataset(shown, repeats=REPEATS), registry=REGISTRY)
    assert {term.cause.word for term in found.named} == {"friction"} | ({"delay"} if late else set())
    assert found.after.train < 1.05 * NOISE
    assert found.verdict == "explained"


def levelling(motion):
    """Spring and dashpot, and a damper whose force levels off along a root (n,) N."""
    return plain(motion) + 150.0 * motion.v() / np.hypot(motion.v(), 0.06)


def test_a_damping_that_levels_off_is_titled_by_its_form_and_not_as_a_power():
    found = diagnose(parse_network(NETWORK, REGISTRY.elements), dataset(levelling, repeats=REPEATS), registry=REGISTRY)
    (told,) = found.as_dict()["causes"]
    assert (told["cause"], told["title"], told["branch"]) == (
        "power_law_damping",
        "damping that thins with velocity",
        "power_law_damping",
    )
    assert "# cause: damping that thins with velocity" in found.extended_text


WARMTH = dict(zip(MOTIONS, (0.0, 20.0, 40.0, 40.0, 0.0, 20.0), strict=True))  # K


@pytest.mark.parametrize("way", ["rate", "slope"])
def test_what_falls_along_an_exponential_is_told_by_its_rate_and_what_falls_along_a_line_by_its_slope(way):
    """Both are the same to first order: what predicts better is known after a refit only."""
    rng, fall = np.random.default_rng(3), {"rate": lambda s: np.exp(-0.03 * s), "slope": lambda s: 1.0 - 0.017 * s}
    forces = {
        name: STIFFNESS * motion.x()
        + 3.0 * DAMPING * fall[way](WARMTH[name]) * motion.v()
        + NOISE * rng.normal(size=1000)
        for name, motion in MOTIONS.items()
    }
    told = with_force(dataset(), forces).runs
    runs = tuple(replace(run, settings={**run.settings, "warmth": WARMTH[run.name]}) for run in told)
    data = replace(dataset(), runs=runs)
    found = diagnose(parse_network(NETWORK, REGISTRY.elements), data, registry=REGISTRY)
    assert [named.cause.word for named in found.named if named.accepted] == ["setting_dependence"]
    overs = [
        slot.value.over for slot in parse_network(found.extended_text, REGISTRY.elements).slots() if slot.value.over
    ]
    (over,) = overs
    expected = -0.03 if way == "rate" else -0.017 * 3.0 * DAMPING
    assert (over.way, over.numbers[0].number) == (way, pytest.approx(expected, rel=0.05))
