"""Runs in memory whose faults a diagnosis puts right."""

import numpy as np
import pytest
from unit.diagnose.rig import MOTIONS, NETWORK, NOISE, dataset, plain

import dashpot as dp


@pytest.fixture(scope="module")
def diagnosis():
    """The second run of two repeats shows 4 % too much, another one is told in mN."""
    faults = {"again": lambda force: 1.04 * force, "a3_p5": lambda force: 1e3 * force}
    made = dataset(repeats={"again": "a3_p8"}, fault=faults)
    return dp.diagnose(dp.declare(NETWORK), dp.Data("bench", made.runs))


@pytest.mark.parametrize(("run", "motion"), [("again", "a3_p8"), ("a3_p5", "a3_p5"), ("a1_p5", "a1_p5")])
def test_every_run_has_the_force_of_the_specimen(diagnosis, run, motion):
    force = diagnosis.corrected_data.run(run).force
    assert np.sqrt(np.mean((force - plain(MOTIONS[motion])) ** 2)) < 2.0 * NOISE


def test_it_is_data_that_a_fit_takes_and_files_hold(diagnosis, tmp_path):
    fit = dp.fit(dp.declare(NETWORK), diagnosis.corrected_data)
    assert fit.errors.train == pytest.approx(diagnosis.after.train, rel=1e-3)
    again = dp.load_dataset(dp.write_dataset(diagnosis.corrected_data, tmp_path))
    assert [run.name for run in again.runs] == [run.name for run in diagnosis.corrected_data.runs]
