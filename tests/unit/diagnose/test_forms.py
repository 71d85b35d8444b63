"""The form in which a cause is written: that of its forms which predicts best."""

import numpy as np
import pytest
from unit.diagnose.rig import NETWORK, NOISE, REGISTRY, TIME, dataset, friction, plain

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
        "digressive damping",
        "digressive_damping",
    )
    assert "# cause: digressive damping" in found.extended_text
