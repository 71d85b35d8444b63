"""The error on runs left out in turn against plain least squares."""

from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import numpy as np
import pytest
from unit.diagnose.rig import bench, dataset, friction, plain

from dashpot.diagnose.polish import left_out_error


def test_a_network_is_fitted_to_the_other_groups_and_judged_on_each():
    """Spring and dashpot are linear: the same by the normal equations, repeats left out together."""
    made = bench(dataset(lambda motion: plain(motion) + friction(motion), repeats={"again": "a3_p8"}))
    rows = {
        run.name: (np.array([run.drive.displacement, run.drive.velocity])[:, run.first :], run.force[run.first :])
        for run in made.refitter.runs
    }
    squares = []
    for run, (motion, force) in rows.items():
        # each run weighs the same, whatever its length
        others = [
            (x / np.sqrt(y.size), y / np.sqrt(y.size))
            for name, (x, y) in rows.items()
            if made.groups[name] != made.groups[run]
        ]
        all_motion, all_force = np.concatenate([x for x, _ in others], axis=1), np.concatenate([y for _, y in others])
        numbers = np.linalg.lstsq(all_motion.T, all_force, rcond=None)[0]
        squares.append(np.mean((force - numbers @ motion) ** 2))
    found = left_out_error(made.model.fitted, made.model, made.refitter.runs, made.groups, 1)
    assert found == pytest.approx(np.sqrt(np.mean(squares)), rel=1e-3)


def test_groups_are_left_out_on_a_pool_with_the_same_result():
    made = bench(dataset(lambda motion: plain(motion) + friction(motion)))
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        here, there = (
            left_out_error(made.model.fitted, made.model, made.refitter.runs, made.groups, jobs) for jobs in (1, pool)
        )
    assert here == there


def test_a_single_group_cannot_be_left_out():
    made = bench(dataset())
    together = dict.fromkeys(made.groups, "all")
    assert left_out_error(made.model.fitted, made.model, made.refitter.runs, together, 1) is None
