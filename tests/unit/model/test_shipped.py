"""Where networks are found."""

from __future__ import annotations

import pytest

from dashpot.model.shipped import find_network, find_used_network, shipped_networks, spec_folder
from dashpot.text.problem import InputError


def test_the_shipped_networks_lie_beside_the_other_specifications():
    assert (spec_folder() / "networks").is_dir()
    assert set(shipped_networks()) >= {"spring", "kelvin_voigt", "gehmann", "ftire", "tire_model_1", "tire_model_5"}


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
