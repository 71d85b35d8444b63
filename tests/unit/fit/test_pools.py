"""Studies, fits and joint fits are the same bits on a pool of processes and on a cluster as in this process."""

from __future__ import annotations

import sys

import numpy as np
import pytest
from unit.pools import two_workers

import dashpot as dp
from dashpot import load_registry
from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.fit.api import fit_each, prepare, silent
from dashpot.fit.joint.reading import read_joint
from dashpot.fit.joint.run import fit_joint
from dashpot.fit.study.reading import read_study
from dashpot.fit.study.run import run_study
from dashpot.model.reading import read_network
from dashpot.notebook.progress import Cancelled
from dashpot.study.study import study_content
from dashpot_elements.spring import Spring

ONE = "rubber: {element: spring, stiffness: {start: 150 N/mm}}"
TWO = ONE + "\n  oil: {element: damper, damping: {start: 900 N*s/m}}"
STUDY = """\
format: dashpot-study/1
name: s
data: d
bootstrap: 3
profiles: "oil.*"
stages: [{name: a, optimizer: least_squares, starts: 2, budget: 200}]
models: [one.yaml, two.yaml, {network: three.yaml, start_from: two}]
"""
JOINT = """\
format: dashpot-joint/1
name: pair
specimens: {a: {network: two.yaml, data: a}, b: {network: three.yaml, data: b}}
shared: [oil.damping]
"""


@pytest.fixture(scope="module", params=["processes", "dask"])
def pool(request):
    """Two workers."""
    with two_workers(request.param) as made:
        yield made


@pytest.fixture(scope="module")
def data() -> Dataset:
    """A spring of 200 N/mm and a damper of 300 N*s/m with noise."""
    time, rng = 1e-3 * np.arange(1200), np.random.default_rng(5)
    runs = []
    for hertz in (2.0, 5.0, 9.0, 14.0):
        x = 1e-3 * np.sin(2.0 * np.pi * hertz * time)
        force = 2e5 * x + 300.0 * np.gradient(x, time) + rng.normal(0.0, 2.0, x.size)
        name = f"f{hertz:g}"
        runs.append(Run(name, "harmonic", time, {"displacement": x, "force": force}, group=name))
    return Dataset("bench", tuple(runs))


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    made = tmp_path_factory.mktemp("pools")
    for name, branches in (("one", ONE), ("two", TWO), ("three", TWO)):
        (made / f"{name}.yaml").write_text(f"format: dashpot-network/1\nname: {name}\nbranches:\n  {branches}\n")
    (made / "study.yaml").write_text(STUDY)
    (made / "joint.yaml").write_text(JOINT)
    return made


def test_a_study(pool, folder, data, tmp_path):
    made, told = read_study(folder / "study.yaml", load_registry()), []
    here = run_study(made, data, registry=load_registry())

    def there():
        return run_study(
            made,
            data,
            registry=load_registry(),
            jobs=pool,
            here=2,
            checkpoint=tmp_path / "records",
            progress=lambda stage, *_: told.append(stage),
        )

    first = there()
    assert study_content(first) == study_content(here)
    assert here.models[1].bootstrap and here.models[1].profiles and len(here.models[1].stages[0].spread) == 2
    # the first two do not build on each other; the third is alone, and its starts are pieces
    assert {"one: identified", "two: identified", "three: bootstrap"} <= set(told)
    assert len({id(model.fit.dataset) for model in first.models}) == 1
    # what workers have written is gone on with
    kept = {path.name: path.stat().st_mtime_ns for path in (tmp_path / "records").iterdir() if path.suffix == ".json"}
    assert len(kept) == 6
    assert study_content(there()) == study_content(here)
    assert all((tmp_path / "records" / name).stat().st_mtime_ns == when for name, when in kept.items())


def test_a_joint_fit(pool, folder, data):
    spec = read_joint(folder / "joint.yaml", load_registry())
    here, there = (fit_joint(spec, {"a": data, "b": data}, jobs=jobs) for jobs in (1, pool))
    assert there.as_dict() == here.as_dict()


def test_a_fit_elsewhere_is_told_of_and_can_be_cancelled(pool, folder, data):
    told = []
    here = dp.fit(folder / "two.yaml", data)
    there = dp.fit(folder / "two.yaml", data, jobs=pool, progress=lambda stage, *_: told.append(stage))
    assert there.as_dict() == here.as_dict()
    assert told == ["two: fitted"]
    with pytest.raises(Cancelled):
        dp.fit(folder / "two.yaml", data, jobs=pool, cancel=lambda: True)


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere networks are fitted one after the other")
def test_networks_are_fitted_side_by_side_on_one_dataset(folder, data):
    class Stiff(Spring):
        """An element of no module: it cannot be pickled by its name."""

    setting, told = prepare(data, 0), []
    made = {word: Stiff if word == "spring" else element for word, element in load_registry().elements.items()}
    specs = [read_network(folder / f"{name}.yaml", made) for name in ("two", "one", "three")]
    alone = fit_each(specs, setting, None, 0, 1, silent)
    beside = fit_each(specs, setting, None, 0, 2, lambda stage, *_: told.append(stage))
    assert [fit.as_dict() for fit in beside] == [fit.as_dict() for fit in alone]
    assert sorted(told) == ["one: fitted", "three: fitted", "two: fitted"]
    assert all(fit.dataset is setting.dataset and next(fit.fitted.root.leaves()).element is Stiff for fit in beside)
