"""The error on runs left out in turn against plain least squares."""

import numpy as np
import pytest
from unit.diagnose.rig import MOTIONS, NETWORK, Motion, bench, dataset, friction, plain

from dashpot.diagnose.polish import left_out_error
from dashpot.fit.objective import Objective
from dashpot.kernel.network import compile_network

CURVED = NETWORK.replace(
    "stiffness: {start: 150 N/mm}",
    "stiffness: {deflection: [2 mm, 14 mm, 15 mm, 16 mm, 17 mm, 18 mm], "
    "force: {start: [0.3 kN, 2 kN, 2.2 kN, 2.4 kN, 2.6 kN, 2.8 kN]}}",
)


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
    found = left_out_error(made.model.fitted, made.model, made.refitter.runs, made.groups, 1)
    assert found == pytest.approx(np.sqrt(np.mean(squares)), rel=1e-4)


def test_what_one_run_alone_tells_is_not_put_to_the_test():
    """Only one run is deep enough to feel that the spring stiffens: the others know nothing of it."""

    def stiffer(motion):
        return plain(motion) + 3e7 * np.maximum(motion.x() - 14e-3, 0.0) ** 2

    made = bench(dataset(stiffer, motions={**MOTIONS, "deep": Motion(2e-3, 16e-3)}), CURVED)
    objective = Objective(compile_network(made.model.fitted), made.refitter.runs)
    trained = float(objective.losses(objective.network.start[None])[0])
    found = left_out_error(made.model.fitted, made.model, made.refitter.runs, made.groups, 1)
    assert trained < found < 1.2 * trained


def test_a_single_group_cannot_be_left_out():
    made = bench(dataset())
    together = dict.fromkeys(made.groups, "all")
    assert left_out_error(made.model.fitted, made.model, made.refitter.runs, together, 1) is None
