"""Runs that depart from all others, which nothing proves to be at fault: they spoil no name, and hide nothing."""

from dataclasses import replace

import numpy as np
import pytest
from unit.diagnose.rig import MOTIONS, NOISE, SAMPLES, Motion, bench, dataset, friction, plain

from dashpot.contract.registry import load_registry
from dashpot.diagnose.diagnose import diagnose
from dashpot.diagnose.single_runs import share_explained

AGAIN = {"again": "a3_p8"}


def with_friction(motion):
    return plain(motion) + friction(motion)


@pytest.mark.parametrize("apart", [("a3_p11",), ("a3_p11", "a1_p5")], ids=["one run", "two runs"])
@pytest.mark.parametrize("law", [with_friction, plain], ids=["friction", "nothing"])
def test_runs_that_depart_from_the_others_spoil_no_name(law, apart):
    """Runs at corners of the conditions have faults, which nothing proves; the friction that all runs have is named."""
    faults = {"a3_p11": lambda force: force + np.linspace(0.0, 60.0, SAMPLES), "a1_p5": lambda force: force - 40.0}
    data = dataset(law, repeats=AGAIN, fault={run: faults[run] for run in apart})
    found = diagnose(bench(data).model.declared, data, registry=load_registry())
    others = [run for run in found.setting.split.train if run not in apart]
    assert set(found.apart) == set(apart) and found.leftover.run in apart and not found.accused
    assert [one.cause.word for one in found.named] == ["friction"] * (law is with_friction)
    assert found.verdict == ("partly_explained" if law is with_friction else "unexplained")
    assert all(found.after.per_run[run] == pytest.approx(NOISE, rel=0.15) for run in others)
    assert all(found.after.per_run[run] > 3.0 * NOISE for run in apart)  # they are not corrected
    reach = max(MOTIONS[run].x().max() for run in others if run != "again")
    assert found.written.identified.range["displacement"][1] == pytest.approx(reach, rel=1e-3)
    assert any(all(f"'{run}'" in remark for run in apart) and "depart" in remark for remark in found.remarks)


def test_what_a_bad_run_hides_is_found_in_the_others():
    """Beside a gain of 4 % in a run of small strokes the friction is not found at first."""
    data = dataset(with_friction, repeats=AGAIN, fault={"a1_p11": lambda force: 1.04 * force})
    found = diagnose(bench(data).model.declared, data, registry=load_registry())
    assert found.apart == ("a1_p11",) and [one.cause.word for one in found.named] == ["friction"]


def test_the_share_that_a_model_explains_of_a_run_beside_another_one():
    made = bench(dataset(fault={"a3_p11": lambda force: 1.05 * force}))
    path, damping = "stiffness.stiffness", made.model.values[1]
    known = {slot.path: slot.value for slot in made.model.fitted.slots()}

    def with_stiffness(stiffness):
        changed = made.model.fitted.with_values({path: replace(known[path], number=stiffness)})
        return replace(made.model, fitted=changed)

    def square(run, stiffness):
        motion = MOTIONS[run.name]
        return np.mean((run.force - stiffness * motion.x() - damping * motion.v())[run.first :] ** 2)

    runs = {run.name: run for run in made.refitter.runs}
    departs, others = runs.pop("a3_p11"), runs.values()
    most, left, noise = square(departs, 200e3), square(departs, 208e3), np.mean([square(run, 200e3) for run in others])
    share = share_explained(made.refitter, ["a3_p11"], with_stiffness(208e3), with_stiffness(200e3))
    assert 0.9 < share < 1.0 and share == pytest.approx((most - left) / (most - noise), rel=1e-6)


def test_a_cause_that_one_run_alone_shows_is_not_lost():
    """The deepest run alone reaches a stop, and drifts: the stop explains far more of it than what is left."""
    data = dataset(
        lambda motion: plain(motion) + 400.0 * np.expm1(np.maximum(motion.x() - 15.5e-3, 0.0) / 0.8e-3),
        motions={**MOTIONS, "deepest": Motion(3e-3, 15e-3)},
        repeats=AGAIN,
        fault={"deepest": lambda force: force + np.linspace(0.0, 40.0, SAMPLES)},
    )
    found = diagnose(bench(data).model.declared, data, registry=load_registry())
    assert found.leftover.run == "deepest" and found.leftover.notable()
    assert not found.apart and "end_stop" in [term.cause.word for term in found.terms]


def test_a_zero_of_its_own_in_every_run_is_told_of_most_runs():
    """No cause fits it; where the data sheet states how much zeros scatter, nothing is missing."""
    zeros = dict(zip([*MOTIONS, "again"], 25.0 * np.random.default_rng(5).standard_normal(7), strict=True))
    fault = {run: lambda force, zero=zero: force + zero for run, zero in zeros.items()}
    data = dataset(repeats=AGAIN, fault=fault)
    registry, network = load_registry(), bench(data).model.declared
    found = diagnose(network, data, registry=registry)
    assert found.verdict == "unexplained" and not found.named and not found.apart and not found.accused
    assert found.leftover.what == "follows a constant of its own in most runs" and not found.leftover.run
    stated = [replace(run, sensors={"force": {"zero": 25.0}}) for run in data.runs]
    found = diagnose(network, replace(data, runs=tuple(stated)), registry=registry)
    assert found.verdict == "nothing_missing"
