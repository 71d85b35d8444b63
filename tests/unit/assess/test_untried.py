"""A cause that no plugin provides was not tried: what is confused with it is not sure."""

from dataclasses import replace
from types import SimpleNamespace

import pytest

from dashpot.assess.accepted import Accepted
from dashpot.assess.evidence import telling_measurement
from dashpot.assess.pursuit import Pursuit
from dashpot.assess.untried import remarks_on_untried, with_untried
from dashpot.contract.registry import load_registry

CAUSES = load_registry().causes


def pursuit_of(word):
    finding = SimpleNamespace(candidate=SimpleNamespace(cause=CAUSES[word]))
    entry = Accepted(finding, None, 0.0, None, ("hum",))
    return Pursuit(None, None, (entry,), (), 1, (), 0.0)


def test_with_all_plugins_nothing_is_untried():
    """Every word that a shipped plugin is confused with is provided by another one."""
    for word in CAUSES:
        pursuit = pursuit_of(word)
        assert with_untried(pursuit, CAUSES).accepted[0].rivals == ("hum",)
        assert remarks_on_untried(pursuit, CAUSES) == []


@pytest.mark.parametrize("missing", ["moving_mass", "relaxation"])
def test_what_could_not_be_tried_is_a_rival_and_is_told(missing):
    causes = {word: cause for word, cause in CAUSES.items() if word != missing}
    pursuit = pursuit_of("resonance")
    (entry,) = with_untried(pursuit, causes).accepted
    assert entry.rivals == ("hum", missing)
    twice = replace(pursuit, accepted=2 * pursuit.accepted)
    (remark,) = remarks_on_untried(twice, causes)
    assert f"No plugin provides the cause '{missing}'" in remark
    assert telling_measurement(CAUSES["resonance"], missing, causes) == CAUSES["resonance"].confused_with[missing]


def test_what_it_is_not_confused_with_may_be_missing():
    causes = {word: cause for word, cause in CAUSES.items() if word != "clearance"}
    pursuit = replace(pursuit_of("resonance"), tried=2)
    assert with_untried(pursuit, causes).accepted[0].rivals == ("hum",)
