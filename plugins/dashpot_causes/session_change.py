"""Parameters of the network that rise or fall from run to run, as runs were made one after the other."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from dashpot.contract.cause import Cause, Suspect, View
from dashpot.model.network import NetworkSpec
from dashpot_causes.session import goes_by_heat
from dashpot_causes.setting_dependence import changed, has_curved_spring, numbers_of, stiffness_over
from dashpot_causes.settings import session_of


class SessionChange(Cause):
    """A parameter of the network is another one from run to run over the session, whatever makes it so."""

    word = "session_change"
    kind = "specimen"
    about = "change from run to run over the session"
    shows = "stiffness or loss rise or fall steadily from run to run, in the order in which they were measured"
    confused_with = {
        "heating": "the runs in another order: heat follows the work of the runs before, and goes at rest",
        "softening": "the runs in another order: warmth follows the motion of the runs before, and goes at rest",
        "bedding_in": "the largest run first: what has bedded in stays as it is from there on",
        "relaxation": "the first run again after a rest under the same preload: what relaxes goes on while it rests",
        "setting_dependence": "the settings in another order: a session goes on with the clock",
        "drift": "a reading without load between the runs: a zero that drifts shows there as well",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """Each parameter of each branch along a straight line over the order of the runs, but for those of a law that
        goes by the heat of the runs before; and a stiffness over it, where the spring has a curve.
        """
        session = session_of(view)
        if session is None:
            return
        numbers = [number for number in numbers_of(network) if not goes_by_heat(number.branch)]
        if numbers:
            yield replace(changed(session, numbers), form="numbers from run to run")
        if has_curved_spring(network):
            yield replace(stiffness_over(session), form="a stiffness from run to run")
