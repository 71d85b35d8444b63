"""The error on runs left out in turn against plain least squares."""

import numpy as np
import pytest
from unit.diagnose.rig import MOTIONS, NETWORK, Motion, bench, dataset, friction, plain

from dashpot.diagnose.polish import left_out_error
from dashpot.fit.objective import Objective
from dashpot.kernel.network import compile_network


def test_a_network_is_fitted_to_the_other_groups_and_judged_on_each():
    """Spring and dashpot are linear: the same by least squares, repeats left out together, all runs as one group."""
    made = bench(dataset(lambda motion: plain(motion) + friction(motion), repeats={"again": "a3_p8"}))
    rows = {}
    for run in made.refitter.runs:
        # each run weighs the same, whatever its length
        motion = np.array([run.drive.displacement, run.drive.velocity])[:, run.first :]
        rows[run.name] = np.vstack([motion, run.force[run.first :]]) / np.sqrt(motion.shape[1])
    whole = np.concatenate(list(rows.values()), axis=1)
    fit = np.linalg.lstsq(whole[:2].T, whole[2], rcond=None)[0]
    kept = np.vstack([whole[:2], fit @ whole[:2]]) / np.sqrt(len(set(made.groups.values())))
    squares = []
    for run, left_out in rows.items():
        others = [found for name, found in rows.items() if made.groups[name] != made.groups[run]]
        told = np.concatenate([*others, kept], axis=1)
        numbers = np.linalg.lstsq(told[:2].T, told[2], rcond=None)[0]
        squares.append(np.sum((left_out[2] - numbers @ left_out[:2]) ** 2))
    found = left_out_error(made.model.fitted, made.model.coordinates, made.refitter.runs, made.groups, 1)
    assert found == pytest.approx(np.sqrt(np.mean(squares)), rel=1e-4)


def trained(made):
    """The error of a network on the runs that it was fitted to, in N."""
    objective = Objective(compile_network(made.model.fitted), made.refitter.runs)
    return float(objective.losses(objective.network.start[None])[0])


def test_what_one_run_alone_tells_is_not_put_to_the_test():
    """One run alone is fast: from the others the damping is hardly known. Without the fit to all 2.1 times as much."""
    slow = {name: Motion(motion.amplitude, motion.preload, 1.05) for name, motion in MOTIONS.items()}
    motions = {**slow, "fast": Motion(3e-3, 8e-3, 20.0)}
    made = bench(dataset(lambda motion: plain(motion) + 2e4 * motion.v() * np.abs(motion.v()), motions=motions))
    found = left_out_error(made.model.fitted, made.model.coordinates, made.refitter.runs, made.groups, 1)
    assert trained(made) < found < 1.2 * trained(made)


def test_a_step_that_leads_far_away_is_damped():
    """Of three sliders that stand for one the data tell the sum alone. The whole step would miss 38 times as much."""
    sliders = "".join(
        f"  slider_{n}: {{element: dahl, limit: {{start: {limit} N}}, stiffness: {{start: {k} N/mm}}, "
        f"exponent: {{start: {exponent}}}}}\n"
        for n, limit, k, exponent in ((1, 25, 120, 1), (2, 15, 60, 0.5), (3, 20, 20, 2))
    )
    made = bench(dataset(lambda motion: plain(motion) + friction(motion, 300.0, 1.5e-3)), NETWORK + sliders)
    found = left_out_error(made.model.fitted, made.model.coordinates, made.refitter.runs, made.groups, 1)
    assert trained(made) < found < 1.05 * trained(made)


def test_a_single_group_cannot_be_left_out():
    made = bench(dataset())
    together = dict.fromkeys(made.groups, "all")
    assert left_out_error(made.model.fitted, made.model.coordinates, made.refitter.runs, together, 1) is None


def test_a_network_without_free_parameters_is_not_fitted():
    fixed = NETWORK.replace("{start: 150 N/mm}", "200 N/mm").replace("{start: 200 N*s/m}", "400 N*s/m")
    made = bench(dataset(), fixed)
    assert left_out_error(made.model.fitted, made.model.coordinates, made.refitter.runs, made.groups, 1) is None
