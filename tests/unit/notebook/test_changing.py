"""Networks built and changed as objects, and written back to their text."""

from __future__ import annotations

import numpy as np
import pytest

import dashpot as dp
from dashpot.text.problem import InputError

TEXT = """\
format: dashpot-network/1
name: mount          # of the engine
branches:
  rubber:
    element: spring
    stiffness: 220 N/mm   # at 20 degC
  strut:
    series:
      damper: {element: damper, damping: 0.5 N*s/mm}
      bracket: {element: spring, stiffness: 2 kN/mm}
  maxwell:
    repeat: 2
    element: maxwell
    stiffness: [20 N/mm, 30 N/mm]
    relaxation_time: [10 ms, 100 ms]
"""
CARRIED = """\
format: dashpot-network/1
name: carried
nodes:
  platform: driven
  engine: {mass: 40 kg}
  body: ground
branches:
  mount: {element: spring, stiffness: 220 N/mm, between: [platform, engine]}
  loss: {element: damper, damping: 0.3 N*s/mm, between: [platform, engine]}
  stay: {element: spring, stiffness: 15 N/mm, between: [engine, body]}
"""
SWEEP = {"amplitudes": "1 mm", "preloads": "3 mm", "duration": "2 s", "sampling": "500 Hz"}


@pytest.fixture
def model():
    return dp.declare(TEXT)


@pytest.fixture(scope="module")
def data():
    return dp.measure(dp.declare(TEXT), "hydropulser", **SWEEP)


def test_numbers_are_read_in_si_and_set_as_in_a_file(model):
    assert model["rubber"].stiffness == 220e3 and model["rubber"].element == "spring"
    model["rubber"].stiffness = "180 N/mm"
    assert model["rubber"].stiffness == 180e3
    model["rubber"].stiffness *= 0.5
    assert model["rubber"].stiffness == 90e3
    model["strut.damper"].damping = np.float64(700.0)
    assert model["strut.damper"].damping == 700.0
    assert model["maxwell_2"].stiffness == 30e3 and model["maxwell"].stiffness == (20e3, 30e3)
    model["maxwell"].stiffness = np.array([1e4, 2e4])
    assert model["maxwell"].stiffness == (1e4, 2e4)


def test_comments_and_the_rest_of_the_text_stay(model):
    model["rubber"].stiffness = "180 N/mm"
    assert model.text == TEXT.replace("220 N/mm", "180 N/mm")


def test_a_number_can_be_set_free(model):
    model["rubber"].stiffness = {"start": "200 N/mm", "bounds": ["20 N/mm", "2 kN/mm"]}
    [free] = [slot for slot in model.slots() if slot.value.searched]
    assert (free.path, free.value.number, free.value.bounds) == ("rubber.stiffness", 200e3, (20e3, 2e6))


def test_masses_of_nodes_are_numbers_too():
    carried = dp.declare(CARRIED)
    carried["engine"].mass = "35 kg"
    assert carried["engine"].mass == 35.0 and "engine: {mass: 35 kg}" in carried.text


def test_branches_come_and_go(model):
    model.add("friction", {"element": "dahl", "stiffness": "400 N/mm", "limit": 20.0})
    model.add(
        "second", series={"a": {"element": "damper", "damping": 10.0}, "b": {"element": "spring", "stiffness": 1e5}}
    )
    assert [branch.name for branch in model.leaves()][-3:] == ["friction", "second.a", "second.b"]
    del model["rubber"]
    del model["strut"]
    del model["second"]
    assert [branch.name for branch in model.leaves()] == ["maxwell_1", "maxwell_2", "friction"]
    assert "# at 20 degC" not in model.text and "# of the engine" in model.text


def test_what_is_saved_and_read_again_gives_the_same_forces(model, data, tmp_path):
    model["rubber"].stiffness = 1.0 / 3.0 * 1e6
    model.add("friction", "dahl", stiffness=np.pi * 1e5, limit="20 N")
    again = dp.load(model.save(tmp_path / "mount.yaml"))
    own, read = dp.simulate(model, data), dp.simulate(again, data)
    assert all((own[name] == read[name]).all() for name in own)
    before = dp.simulate(dp.declare(TEXT), data)
    assert all(np.abs(own[name] - before[name]).max() > 10.0 for name in own)


def test_a_network_built_from_nothing_is_the_one_of_the_text(data):
    built = dp.Network("mount")
    built.add("rubber", "spring", stiffness="220 N/mm")
    built.add(
        "strut",
        series={"damper": {"element": "damper", "damping": 500.0}, "bracket": {"element": "spring", "stiffness": 2e6}},
    )
    built.add("maxwell", "maxwell", repeat=2, stiffness=[2e4, "30 N/mm"], relaxation_time=[0.01, "100 ms"])
    assert built == dp.declare(TEXT)
    nodes = {"platform": "driven", "engine": {"mass": "40 kg"}, "body": "ground"}
    carried = dp.Network(
        "carried",
        {
            "mount": {"element": "spring", "stiffness": "220 N/mm", "between": ["platform", "engine"]},
            "loss": {"element": "damper", "damping": "0.3 N*s/mm", "between": ["platform", "engine"]},
            "stay": {"element": "spring", "stiffness": "15 N/mm", "between": ["engine", "body"]},
        },
        nodes=nodes,
    )
    assert carried == dp.declare(CARRIED)


@pytest.mark.parametrize(
    "change, told",
    [
        (lambda model: setattr(model["rubber"], "stiffness", "3 N"), "rubber.stiffness: expected a quantity in N/m"),
        (lambda model: setattr(model["rubber"], "stifness", 3.0), "did you mean 'stiffness'"),
        (lambda model: setattr(model["maxwell_1"], "stiffness", 3.0), "no branch 'maxwell_1'. did you mean 'maxwell'"),
        (lambda model: model["ruber"], "no branch or node 'ruber'. did you mean 'rubber'"),
        (lambda model: model.add("friction", "dahll"), "there is no element 'dahll'. did you mean 'dahl'"),
        (lambda model: model.__delitem__("strut.nothing"), "no branch or node 'strut.nothing'"),
        (lambda model: dp.fit(dp.Network("empty"), dp.Data("none", ())), "the network 'empty' has no branch"),
    ],
)
def test_a_wrong_change_is_told_and_changes_nothing(model, change, told):
    with pytest.raises(InputError, match=told):
        change(model)
    assert model == dp.declare(TEXT) and model.text == TEXT


def test_a_branch_of_that_name_is_not_replaced(model):
    with pytest.raises(ValueError, match="'rubber' stands there already"):
        model.add("rubber", "spring", stiffness=1.0)


def test_a_number_that_is_not_there_is_told(model):
    with pytest.raises(AttributeError, match="'rubber' has no parameter 'stifness'; did you mean 'stiffness'"):
        model["rubber"].stifness  # noqa: B018
    assert dir(model["strut.damper"]) == ["damping", "element"]
    assert model["strut"].element == "" and model["maxwell"].element == "maxwell"
    with pytest.raises(TypeError, match="expected a number, a text such as '220 N/mm'"):
        model["rubber"].stiffness = None


def test_a_result_keeps_the_model_it_was_computed_with(data):
    model = dp.Network("one", {"rubber": {"element": "spring", "stiffness": {"start": 1e5}}})
    fit = dp.fit(model, data)
    found = fit.identified_text
    model["rubber"].stiffness = 1.0
    fit.model["rubber"].stiffness = 2.0
    assert fit.identified_text == found and fit.declared["rubber"].stiffness == 1e5
