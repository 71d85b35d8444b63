"""Optimizer options on the command line reach the optimizer in its own types, or are refused."""

from __future__ import annotations

import pytest

from dashpot.cli.session import Session
from dashpot.cli.switches import Switches

pytestmark = pytest.mark.usefixtures("layers")


def test_an_option_arrives_in_the_type_that_the_optimizer_declares():
    assert Session(Switches(), "swarm", ["particles=12"]).options == {"particles": 12}


@pytest.mark.parametrize(
    "given, hint",
    [
        (["--optimizer", "swrm"], "No such optimizer 'swrm', did you mean 'swarm'?"),
        (["--optimizer", "zzz"], "No such optimizer 'zzz', there are: swarm"),
        (["--optimizer", "swarm", "--set", "particle=3"], "has no option 'particle', did you mean 'particles'?"),
        (["--optimizer", "swarm", "--set", "particles=many"], "'particles' expected a whole number, got 'many'"),
        (["--optimizer", "swarm", "--set", "particles=1"], "particles: expected at least 2, got 1"),
        (["--optimizer", "swarm", "--set", "particles"], "--set expected KEY=VALUE, got 'particles'"),
        (["--set", "particles=3"], "name it with --optimizer"),
    ],
)
def test_what_the_optimizer_does_not_take_is_a_usage_error(call, given, hint):
    code, _, error = call("fit", "spring", "nowhere", "-o", "never", *given)
    assert code == 2
    assert hint in error
