"""Options given as text arrive in the type that the constructor declares."""

from __future__ import annotations

import pytest

from dashpot.contract.options import read_options


class Method:
    word = "method"

    def __init__(
        self,
        particles: int = 96,
        weight: float = 0.7,
        restart: bool = True,
        law: str = "ring",
        untyped="ring",
        table: dict | None = None,
    ) -> None:
        if particles < 1:
            raise ValueError("particles: expected at least 1")


def test_each_option_is_read_in_its_declared_type():
    texts = {"particles": "12", "weight": "1e-3", "restart": "no", "law": "star", "untyped": "7"}
    options = read_options(Method, texts)
    assert options == {"particles": 12, "weight": 1e-3, "restart": False, "law": "star", "untyped": "7"}
    assert [type(value) for value in options.values()] == [int, float, bool, str, str]


@pytest.mark.parametrize(
    "name, text, message",
    [
        ("particles", "1.5", "option 'particles' expected a whole number, got '1.5'"),
        ("weight", "much", "option 'weight' expected a number, got 'much'"),
        ("restart", "perhaps", "option 'restart' expected yes or no, got 'perhaps'"),
        ("particle", "3", "'method' has no option 'particle', did you mean 'particles'?"),
        ("zzz", "3", "'method' has no option 'zzz', it has: particles, weight, restart, law, untyped, table"),
        ("table", "3", "option 'table' is of a type that cannot be given as text"),
        ("particles", "0", "particles: expected at least 1"),
    ],
)
def test_what_does_not_fit_is_said(name, text, message):
    with pytest.raises(ValueError) as raised:
        read_options(Method, {name: text})
    assert str(raised.value) == message


def test_a_class_without_options_says_so():
    class Plain:
        word = "plain"

    with pytest.raises(ValueError, match="'plain' has no option 'x', it has: none"):
        read_options(Plain, {"x": "1"})
