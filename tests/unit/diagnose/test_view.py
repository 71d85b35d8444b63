"""What a cause sees of an element that the network may lack."""

import numpy as np
import pytest
from unit.diagnose.rig import REGISTRY, dataset

from dashpot.diagnose.view import ModelView
from dashpot.fit.api import prepare
from dashpot.text.problem import InputError


@pytest.fixture(scope="module")
def view():
    scored = {run.name: run for run in prepare(dataset()).train}
    return ModelView(scored, {}, REGISTRY.elements)


def test_what_a_set_of_values_leaves_out_has_its_default(view):
    run = view.runs[0]
    velocity = view.velocity(run)
    sets = [{"compression": 1.0, "rebound": 0.0}, {"compression": 0.0, "rebound": 2.0, "rebound_exponent": 2.0}]
    first, second = view.respond(run, "asymmetric_damper", sets)
    assert first == pytest.approx(np.maximum(velocity, 0.0))
    assert second == pytest.approx(-2.0 * 0.1 * (np.minimum(velocity, 0.0) / 0.1) ** 2, abs=2e-4 * np.abs(second).max())


def test_a_value_without_a_default_is_asked_for(view):
    with pytest.raises(InputError, match="'compression' is missing in a set of values"):
        view.respond(view.runs[0], "asymmetric_damper", [{"rebound": 1.0}, {"compression": 1.0}])


def test_a_value_may_move_along_the_run(view):
    """A dashpot whose damping is another one at every sample, and a spring whose stiffness is."""
    run = view.runs[0]
    moving = 300.0 + np.cumsum(np.abs(view.displacement(run)))
    damped, plain = view.respond(run, "damper", [{"damping": moving}, {"damping": 7.0}])
    assert damped == pytest.approx(moving * view.velocity(run), rel=1e-9, abs=1e-9)
    assert plain == pytest.approx(7.0 * view.velocity(run), rel=1e-9, abs=1e-9)
    [pressed] = view.respond(run, "spring", [{"stiffness": moving}])
    assert pressed == pytest.approx(moving * view.displacement(run), rel=1e-9, abs=1e-9)
