"""``dashpot draw``."""

from __future__ import annotations

import io
import sys
from xml.etree import ElementTree

from dashpot.cli.draw import text_for_terminal


def test_a_picture_is_written(call, tmp_path):
    picture = tmp_path / "pictures" / "tire.svg"
    code, out, err = call("draw", "tire_model_5", "-o", picture)
    assert (code, err) == (0, "")
    assert out == f"drawn: {picture}\n"
    assert ElementTree.parse(picture).getroot().tag == "{http://www.w3.org/2000/svg}svg"
    assert call("draw", "tire_model_5", "-o", picture)[0] == 1
    assert call("draw", "tire_model_5", "-o", picture, "--force")[0] == 0


def test_without_a_file_the_terminal_gets_a_drawing(call):
    code, out, err = call("draw", "kelvin_voigt", "--quiet")
    assert (code, err) == (0, "")
    assert "╱╲╱╲╱" in out and "damping" in out


def test_a_drawing_can_be_kept_as_text(call, tmp_path):
    assert call("draw", "gehmann", "--ascii", "-o", tmp_path / "gehmann.txt")[0] == 0
    text = (tmp_path / "gehmann.txt").read_text()
    assert text.isascii() and "maxwell" in text


def test_a_terminal_without_line_characters_gets_ascii(monkeypatch):
    from dashpot.contract.registry import load_registry
    from dashpot.model.reading import read_network

    spec = read_network("gehmann", load_registry().elements)
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(io.BytesIO(), encoding="ascii"))
    assert text_for_terminal(spec, plain=False).isascii()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(io.BytesIO(), encoding="utf-8"))
    assert not text_for_terminal(spec, plain=False).isascii()


def test_other_endings_are_refused(call, tmp_path):
    code, _, err = call("draw", "gehmann", "-o", tmp_path / "gehmann.png")
    assert code == 2
    assert "expected a file ending in .svg or .txt, got 'gehmann.png'" in err
