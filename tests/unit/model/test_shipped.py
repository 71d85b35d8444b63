"""Where networks are found."""

from __future__ import annotations

import pytest

from dashpot import load_registry
from dashpot.model.reading import parse_network, read_network
from dashpot.model.shipped import find_network, find_used_network, shipped_networks, spec_folder
from dashpot.model.topology import topology_of
from dashpot.text.document import Document, Mapping, Node, Sequence
from dashpot.text.problem import InputError
from dashpot_specimens.car_laws import Car


def test_the_shipped_networks_lie_beside_the_other_specifications():
    assert (spec_folder() / "networks").is_dir()
    assert set(shipped_networks()) >= {
        "spring",
        "kelvin_voigt",
        "gehmann",
        "ftire",
        "tire_model_1",
        "tire_model_5",
        "axle_model_1",
        "axle_model_2",
        "axle_model_3",
        "axle_model_3_top_mount",
        "quarter_car",
    }


def test_a_network_is_found_by_its_shipped_name_or_its_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine").write_text("")
    assert find_network("gehmann") == shipped_networks()["gehmann"]
    assert find_network("anything.yaml").name == "anything.yaml"
    assert find_network("mine").name == "mine"


def test_an_unknown_name_is_told_with_the_nearest_one():
    with pytest.raises(InputError, match="tire_model5: there is no such file .* did you mean 'tire_model_5'?"):
        find_network("tire_model5")
    with pytest.raises(InputError, match="shipped networks: .*gehmann"):
        find_network("qqqqqq")


def test_a_word_finds_the_networks_that_are_called_or_told_so():
    with pytest.raises(InputError, match="did you mean 'rubber_bushing', 'eub' or 'ubs'?"):
        find_network("bushing")
    with pytest.raises(InputError, match="did you mean 'shock_absorber'"):
        find_network("Shock")


def test_a_used_name_is_a_shipped_one_whatever_lies_in_the_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "gehmann").write_text("")
    assert find_used_network("gehmann", tmp_path) == shipped_networks()["gehmann"]


def test_a_used_file_lies_in_or_below_the_folder(tmp_path):
    assert find_used_network("parts/a.yaml", tmp_path) == tmp_path / "parts" / "a.yaml"
    outside = tmp_path / "link.yaml"
    outside.symlink_to(tmp_path.parent / "elsewhere.yaml")
    for word in ("../a.yaml", "parts/../../a.yaml", str(tmp_path.parent / "a.yaml"), "link.yaml"):
        with pytest.raises(InputError, match="expected a file in or below"):
            find_used_network(word, tmp_path)


AXLES = [name for name in shipped_networks() if name.startswith("axle_model")]


@pytest.mark.parametrize("name", AXLES)
def test_an_axle_has_two_wheels_of_the_same_numbers_between_two_platforms_and_the_body(name):
    spec = read_network(name, load_registry().elements)
    topology = topology_of(spec)
    assert topology.held("driven") == ("platform_left", "platform_right") and topology.held("ground") == ("body",)
    assert {"wheel_left", "wheel_right"} <= set(topology.unknown)
    assert spec.joints["wheel_right"].numbers == "wheel_left"
    assert spec.joints["wheel_left"].masses["added_mass"].setting == "added_mass"
    assert len([branch for branch in spec.leaves() if branch.shares]) == len(topology.edges) // 2 - 1


@pytest.mark.parametrize("name", AXLES)
def test_of_an_axle_everything_but_the_tire_is_searched(name):
    spec = read_network(name, load_registry().elements)
    searched = {slot.path.partition("[")[0] for slot in spec.slots() if slot.value.searched}
    slow = {
        "suspension.stiffness",
        "friction.stiffness",
        "friction.limit",
        "anti_roll_bar.bar.stiffness",
        "anti_roll_bar.friction.stiffness",
        "anti_roll_bar.friction.limit",
    }
    assert slow | {"wheel_left.mass"} <= searched
    fast = searched - slow - {"wheel_left.mass"}
    assert sum("shock_absorber.damping" in path for path in fast) == 1
    assert all("shock_absorber" in path or "top_mount" in path for path in fast)


@pytest.mark.parametrize("name", [*AXLES, "quarter_car"])
def test_the_tire_of_an_axle_is_exchanged_in_one_line(name, tmp_path):
    elements = load_registry().elements
    text = shipped_networks()[name].read_text()
    (line,) = [line for line in text.splitlines() if "use:" in line]
    used = line.partition("use: ")[2].partition(",")[0]
    spec = parse_network(text.replace(line, line.replace(used, "car_tire_ftire")), elements)
    tire = [branch.element.word for branch in spec.leaves() if branch.name.startswith("tire.")]
    assert tire == [branch.element.word for branch in read_network("car_tire_ftire", elements).leaves()]


def test_the_shipped_car_tires_have_numbers_and_the_structure_of_their_models():
    elements = load_registry().elements
    for name, model in (
        ("car_tire_kelvin_voigt", "kelvin_voigt"),
        ("car_tire_ftire", "ftire"),
        ("car_tire_model_5", "tire_model_5"),
    ):
        tire, found = read_network(name, elements), read_network(model, elements)
        assert not tire.data_curves() and not any(slot.value.searched for slot in tire.slots())
        assert [(b.name, b.element.word) for b in tire.leaves()] == [(b.name, b.element.word) for b in found.leaves()]


def test_the_axle_with_the_known_shock_absorber_is_axle_model_3_but_for_its_curve():
    elements = load_registry().elements
    file = spec_folder() / "studies" / "paper_axle" / "axle_model_3_known_damper.yaml"
    known, searched = read_network(file, elements), read_network("axle_model_3", elements)
    assert [(b.name, b.element.word) for b in known.leaves()] == [(b.name, b.element.word) for b in searched.leaves()]
    free = [{slot.path for slot in spec.slots() if slot.value.searched} for spec in (known, searched)]
    assert {path.partition("[")[0] for path in free[1] - free[0]} == {"shock_absorber.damping"} and free[0] < free[1]


def test_the_known_curve_is_that_of_the_virtual_shock_absorber():
    file = spec_folder() / "studies" / "paper_axle" / "axle_model_3_known_damper.yaml"
    curve = read_network(file, load_registry().elements).curves()["shock_absorber.damping"]
    for velocity, value in zip(curve.at, curve.values, strict=True):
        slope, knee = Car().rebound if velocity < 0.0 else Car().compression
        assert value.number == pytest.approx(slope * velocity / (1.0 + abs(velocity) / knee), abs=0.6)


def nodes(node: Node) -> list[tuple[object, ...]]:
    """Everything below a node with its place, in the order of the text."""
    own = (type(node), node.place, node.start, node.end, getattr(node, "value", None))
    inner = [*getattr(node, "items", ())] if isinstance(node, Sequence) else []
    if isinstance(node, Mapping):
        inner = [each for name, entry in node.entries.items() for each in (node.keys[name], entry)]
    return [own, *(each for below in inner for each in nodes(below))]


@pytest.mark.parametrize("path", sorted(spec_folder().rglob("*.yaml")), ids=lambda path: path.stem)
def test_a_shipped_file_is_read_alike_by_both_parsers_of_yaml(path):
    quick, careful = (nodes(Document.read(path, ours=ours).root) for ours in (True, False))
    assert len(quick) > 10 and quick == careful


def test_what_yaml_forbids_is_refused_in_files_of_users(tmp_path):
    path = tmp_path / "tabs.yaml"
    path.write_text("format: dashpot-network/1\nname:\tmine\nbranches: {a: {element: ,spring}\t}\n")
    Document.read(path, ours=True)
    with pytest.raises(InputError, match="tabs"):
        Document.read(path)
