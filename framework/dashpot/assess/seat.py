"""Where suspects are looked for: at the rig, and in a network with nodes at each of its sites."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from dashpot.assess.inside import Inside
from dashpot.assess.view import ModelView
from dashpot.contract.cause import Cause, Suspect
from dashpot.model.network import NetworkSpec
from dashpot.model.sites import At, Site, rig_site


@dataclass(frozen=True, eq=False)
class Seat:
    """``view`` and ``network`` are what causes see from here; ``site`` is None at the rig.

    ``ends`` says that the network has two ends only: whatever is added lies between them, and is measured.
    """

    view: ModelView
    network: NetworkSpec
    site: Site | None = None
    ends: bool = False

    def suspects(self, cause: type[Cause]) -> list[Suspect]:
        """The forms of a cause to try here. Raises InputError for a form that cannot be tried."""
        if self.site and cause.kind == "measurement":
            return []
        found = [suspect for suspect in cause().suspects(self.view, self.network) if self._admits(cause, suspect)]
        for suspect in found:
            suspect.columns(self.view, self.view.runs[0])
        if self.ends:
            return found
        # columns inside a network are those of small forces: what several make up for may be the size of a single one
        where, most = self.site or rig_site(self.network), 1 if self.site else None
        return [replace(each, extend=At(where, each.extend), most=most or each.most) for each in found]

    def _admits(self, cause: type[Cause], suspect: Suspect) -> bool:
        measured = cause.kind == "measurement" or suspect.mends or suspect.measured
        return self.ends or measured == (self.site is None)


def seats_of(view: ModelView, network: NetworkSpec, inside: Inside | None) -> Sequence[Seat]:
    """The only seat of a network with two ends; the rig and all sites of one with nodes."""
    if inside is None:
        return [Seat(view, network, ends=True)]
    return [Seat(view, network), *(Seat(inside.view(site), inside.members(site), site) for site in inside.sites)]
