"""Specimens identified together, against linear regression of all of them at once."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from seeds import seed_of
from unit.fit.bench import ready, runs

import dashpot as dp
from dashpot import load_registry
from dashpot.fit.coordinates import search_coordinates
from dashpot.fit.joint.declaration import Tie
from dashpot.fit.joint.objective import JointObjective, Member
from dashpot.fit.joint.reading import read_joint
from dashpot.fit.joint.run import fit_joint
from dashpot.fit.joint.tied import common_coordinates
from dashpot.fit.linear import linearise
from dashpot.fit.refine import refine
from dashpot.text.problem import InputError

STIFF, LOSS, ERRORS = (2e5, 6e5), 300.0, (20.0, 80.0)
SOFT = """
    rubber: {element: spring, stiffness: {start: 1e5}}
    oil: {element: damper, damping: {start: 1000}}
"""
HARD = """
    fluid: {element: damper, damping: {start: 200}}
    rubber: {element: spring, stiffness: {start: 1e5}}
    tied: {element: damper, damping: {expression: 0.5 * fluid.damping}}
"""
TIE = Tie({"soft": "oil.damping", "hard": "fluid.damping"})


@pytest.fixture(scope="module")
def specimens():
    """Soft and hard; the hard one has 1.5 times the damping of its first damper."""
    rng, found = np.random.default_rng(seed_of("test_joint")), {}
    for name, stiffness, loss, error, branches in zip(
        ("soft", "hard"), STIFF, (LOSS, 1.5 * LOSS), ERRORS, (SOFT, HARD), strict=True
    ):
        scored = [
            replace(each, first=0, force=each.force + error * rng.standard_normal(each.force.size))
            for each in runs(lambda x, v, a, k=stiffness, c=loss: k * x + c * v)
        ]
        found[name] = ready(branches, scored)
    return found


def joint(specimens):
    whole = JointObjective(
        [
            Member(objective, objective, error)
            for (_, objective, _), error in zip(specimens.values(), ERRORS, strict=True)
        ]
    )
    own = {name: coordinates for name, (_, _, coordinates) in specimens.items()}
    common = common_coordinates(own, [TIE], {name: np.ones(len(each.paths)) for name, each in own.items()})
    return whole, common


def test_the_fit_is_the_weighted_regression_of_both(specimens):
    whole, common = joint(specimens)
    assert common.coordinates.paths == (
        "soft: rubber.stiffness",
        "oil.damping = fluid.damping",
        "hard: rubber.stiffness",
    )
    found = refine(whole, common.coordinates, common.coordinates.start)
    rows, aim = [], []
    for k, (_, objective, _) in enumerate(specimens.values()):
        x = np.concatenate([run.drive.displacement for run in objective.runs])
        v = np.concatenate([run.drive.velocity for run in objective.runs])
        nothing = np.zeros(x.size)
        table = [x, v, nothing] if k == 0 else [nothing, 1.5 * v, x]
        rows.append(np.array(table) / ERRORS[k])
        aim.append(np.concatenate([run.force for run in objective.runs]) / ERRORS[k])
    table, force = np.concatenate(rows, axis=1), np.concatenate(aim)
    expected = np.linalg.solve(table @ table.T, table @ force)
    assert common.coordinates.numbers(found.point) == pytest.approx(expected, rel=1e-6)


def test_the_gradient_is_that_of_the_loss(specimens):
    whole, common = joint(specimens)
    point = common.coordinates.start
    linear = linearise(whole, common.coordinates, point)
    assert np.sqrt(linear.square / whole.total) == pytest.approx(
        whole.losses(common.coordinates.to_values(point))[0], rel=1e-9
    )
    for k in range(point.size):
        step = 1e-4 * np.eye(point.size)[k]
        up, down = whole.losses(common.coordinates.to_values(np.array([point + step, point - step]))) ** 2
        assert 2.0 * linear.gradient[k] == pytest.approx(whole.total * (up - down) / 2e-4, rel=1e-3)


def test_bounds_without_anything_in_common_are_refused(specimens):
    own = {name: coordinates for name, (_, _, coordinates) in specimens.items()}
    far = replace(own["hard"], low=own["hard"].low + 50.0, high=own["hard"].high + 50.0)
    with pytest.raises(InputError, match="have nothing in common"):
        common_coordinates({**own, "hard": far}, [TIE], {name: np.ones(2) for name in own})


NETWORK = """\
format: dashpot-network/1
name: {name}
branches:
  rubber: {{element: spring, stiffness: {stiffness}}}
  relaxing: {{element: maxwell, stiffness: {share}, relaxation_time: {time}}}
"""
SEARCHED = {"stiffness": "{start: 100 N/mm}", "share": "{start: 30 N/mm}", "time": "{start: 10 ms}"}
FILE = """\
format: dashpot-joint/1
name: pair
specimens:
  soft: {network: soft.yaml, data: soft}
  hard: {network: hard.yaml, data: hard}
shared: [relaxing.relaxation_time]
"""


def measured_from(first):
    """Both specimens on the bench, with seeds from the ``first`` on."""
    found = {}
    for seed, (name, stiffness, share) in enumerate(
        (("soft", "200 N/mm", "60 N/mm"), ("hard", "500 N/mm", "150 N/mm")), first
    ):
        model = dp.declare(NETWORK.format(name=name, stiffness=stiffness, share=share, time="20 ms"))
        found[name] = dp.measure(model, "bushing_bench", seed=seed)
    return found


@pytest.fixture(scope="module")
def measured():
    return measured_from(0)


def files(folder, text=FILE):
    for name in ("soft", "hard"):
        (folder / f"{name}.yaml").write_text(NETWORK.format(name=name, **SEARCHED))
    (folder / "pair.yaml").write_text(text)
    return folder / "pair.yaml"


def width(interval):
    return interval[1] - interval[0]


def test_specimens_that_agree_narrow_the_interval_of_what_they_share(tmp_path, measured):
    """In the mean over three pairs of tests: the width of an interval is itself known to a tenth or so."""
    joint = read_joint(files(tmp_path), load_registry())
    fits = [fit_joint(joint, each) for each in (measured, measured_from(2), measured_from(4))]
    ties = [tie for fit in fits for tie in fit.shared]
    assert len(ties) == 3 and all(tie.interval[0] < 20e-3 < tie.interval[1] and tie.apart > 1e-4 for tie in ties)
    ratios = [width(tie.interval) / min(width(one) for _, one in tie.alone.values()) for tie in ties]
    assert np.mean(ratios) < 0.95
    found, shared = fits[0], ties[0]
    for name, fit in found.fits.items():
        assert fit.errors.train < 1.02 * found.alone[name].errors.train
        times = [slot.value.number for slot in fit.fitted.slots() if slot.path == "relaxing.relaxation_time"]
        assert times == [pytest.approx(shared.value)]
    content = found.as_dict()
    assert content["shared"][0]["number"] == "relaxing.relaxation_time"
    assert set(content["specimens"]["soft"]["rmse_alone"]) == {"train", "held_out", "all"}


def test_specimens_that_contradict_one_another_are_told_apart(tmp_path, measured):
    found = fit_joint(
        read_joint(files(tmp_path, FILE.replace("relaxing.relaxation_time", "rubber.stiffness")), load_registry()),
        measured,
    )
    [shared] = found.shared
    assert shared.apart < 1e-12
    assert shared.interval[0] < 200e3 and shared.interval[1] > 400e3  # wide enough to say that nothing is known
    assert found.fits["soft"].errors.train > 20.0 * found.alone["soft"].errors.train


@pytest.mark.parametrize(
    ("shared", "told"),
    [
        ("[relaxing.relaxation_tim]", "did you mean 'relaxing.relaxation_time'?"),
        ("[{soft: rubber.stiffness, hart: rubber.stiffness}]", "there is no specimen 'hart'; did you mean 'hard'?"),
        ("[{soft: rubber.stiffness}]", "of two specimens or more, got 1"),
        ("[{soft: rubber.stiffness, hard: rubber.stifness}]", "'hard' has no parameter 'rubber.stifness'"),
        (
            "[{soft: rubber.stiffness, hard: relaxing.relaxation_time}]",
            "in s and N/m; share parameters of one unit",
        ),
        ("['*', rubber.stiffness]", "is shared twice; name it once"),
    ],
)
def test_what_cannot_be_shared_is_refused_with_its_place(tmp_path, shared, told):
    file = files(tmp_path, FILE.replace("[relaxing.relaxation_time]", shared))
    with pytest.raises(InputError) as caught:
        read_joint(file, load_registry())
    assert told in str(caught.value)
    assert "pair.yaml:6:" in str(caught.value)


def test_a_file_without_shared_numbers_or_with_one_specimen_is_refused(tmp_path):
    with pytest.raises(InputError, match="lacks 'shared'"):
        read_joint(files(tmp_path, FILE.replace("shared: [relaxing.relaxation_time]\n", "")), load_registry())
    with pytest.raises(InputError, match="expected two specimens or more, got 1"):
        read_joint(files(tmp_path, FILE.replace("  hard: {network: hard.yaml, data: hard}\n", "")), load_registry())


def test_what_a_search_moves_in_a_specimen_is_what_its_own_network_says(specimens):
    spec, _, coordinates = specimens["hard"]
    assert search_coordinates(spec).paths == coordinates.paths == ("fluid.damping", "rubber.stiffness")
