"""Faults of the channel find their place anew while the model changes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from unit.assess.rig import REGISTRY, fitted
from unit.assess.test_refits import TABLE, bench_of

from dashpot.assess.contest import try_finding
from dashpot.assess.suspicion import look_at

CAUSE = REGISTRY.causes["clipping"]
STRAIGHT = """\
format: dashpot-network/1
name: straight
branches:
  stiffness: {element: spring, stiffness: {start: 200 N/mm}}
  damping: {element: damper, damping: {start: 200 N*s/m, bounds: [20 N*s/m, 2 kN*s/m]}}
"""


@pytest.fixture
def level(rng):
    """The end of the range in N; the force goes to 4.4 kN."""
    return rng.uniform(3.0e3, 3.9e3)


def clipped(level):
    return lambda x, v: np.minimum(200e3 * x + 250.0 * v, level)


def found(bench, network):
    look = look_at(bench, fitted(bench, network), [CAUSE], None, 0)
    return look, look.screen.best


def test_the_end_of_the_range_is_found_once_the_model_no_longer_follows_the_clipped_force(rng, level):
    """A free table first bends over like the force, which leaves the level 3.5 % too low."""
    bench, _ = bench_of(clipped(level), rng)
    look, finding = found(bench, TABLE)
    trial = try_finding(bench, look.model, finding, look.noise, look.screen.samples)
    (mend,) = trial.model.mends
    told = mend.told()
    assert told["level"][0] == pytest.approx(level, rel=0.01)
    assert told["share that is missing"][0] == pytest.approx(1.0, abs=0.2)
    assert mend.finding is finding


def test_places_that_explain_as_much_are_left_where_they_are(rng, level):
    """Turned on and on, the mend stays where it is best."""
    bench, _ = bench_of(clipped(level), rng)
    look, finding = found(bench, STRAIGHT)
    model = try_finding(bench, look.model, finding, look.noise, look.screen.samples).model
    again = bench.fit(model.declared, model.fitted, look.noise, model.mends)
    assert [mend.chosen for mend in again.mends] == [mend.chosen for mend in model.mends]
    assert again.chi_square == pytest.approx(model.chi_square, rel=1e-4)


def test_a_refit_is_not_given_up_before_its_mend_has_moved(rng, level):
    """From a place far off it does not come near to what it reaches in the end."""
    bench, _ = bench_of(clipped(level), rng)
    look, finding = found(bench, STRAIGHT)
    aim = try_finding(bench, look.model, finding, look.noise, look.screen.samples).model.chi_square
    suspect = finding.candidate.suspect
    far = len(suspect.grid) - 1
    lost = replace(finding, atoms=((finding.strengths[0], suspect.grid[far]),), chosen=(far,),
                   strengths=finding.strengths[:1], deviations=finding.deviations[:1],
                   absorbed=finding.absorbed[:, :1])  # fmt: skip
    trial = try_finding(bench, look.model, lost, look.noise, look.screen.samples, beat=aim)
    assert trial.model.chi_square < 1.01 * aim
