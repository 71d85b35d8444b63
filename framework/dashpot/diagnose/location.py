"""Where suspects are looked for: at the rig, and in a network with nodes at each of its sites."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

from dashpot.contract.cause import Cause, Suspect
from dashpot.diagnose.candidate import Candidate
from dashpot.diagnose.inside import Inside
from dashpot.diagnose.view import ModelView
from dashpot.model.network import NetworkSpec
from dashpot.model.sites import At, Site, rig_site
from dashpot.text.problem import InputError


@dataclass(frozen=True, eq=False)
class Location:
    """``view`` and ``network`` are what causes see from here; ``site`` is None at the rig.

    ``ends`` says that the network has two ends only: whatever is added lies between them, and is measured.
    """

    view: ModelView
    network: NetworkSpec
    site: Site | None = None
    ends: bool = False

    def suspects(self, cause: type[Cause], able: set[object]) -> list[Suspect]:
        """The forms of a cause to try here. Raises InputError for a form that cannot be tried.

        What is ``able`` to be tried joins the set: whether it is does not depend on the numbers of the network.
        """
        if self.site and cause.kind == "measurement":
            return []
        found = [suspect for suspect in cause().suspects(self.view, self.network) if self._admits(cause, suspect)]
        for suspect in found:
            if (form := (cause, self.site, suspect.form, suspect.grid)) not in able:
                suspect.columns(self.view, self.view.runs[0])
                able.add(form)
        if self.ends:
            return found
        # columns inside a network are those of small forces: what several make up for may be the size of a single one
        where, most = self.site or rig_site(self.network), 1 if self.site else None
        return [replace(each, extend=At(where, each.extend), most=most or each.most) for each in found]

    def _admits(self, cause: type[Cause], suspect: Suspect) -> bool:
        measured = cause.kind == "measurement" or suspect.measured
        return self.ends or measured == (self.site is None)


def locations_of(view: ModelView, network: NetworkSpec, inside: Inside | None) -> Sequence[Location]:
    """The only location of a network with two ends; the rig and all sites of one with nodes."""
    if inside is None:
        return [Location(view, network, ends=True)]
    return [
        Location(view, network),
        *(Location(inside.view(site), inside.members(site), site) for site in inside.sites),
    ]


def gather_candidates(
    causes: Sequence[type[Cause]],
    locations: Sequence[Location],
    sheet: Collection[str] = (),
    able: set[object] | None = None,
) -> tuple[list[Candidate], tuple[tuple[str, str], ...]]:
    """All forms of all causes that act in every run alike, and the causes that cannot be tried with the reason.

    What only a data sheet can tell is provable where the ``sheet`` of the force channel names its quantity. Forms that
    are ``able`` to be tried are not examined again.
    """
    able = set() if able is None else able
    found: list[Candidate] = []
    unavailable, first, twins = [], 0, Counter[tuple[object, ...]]()
    for cause in causes:
        for location in locations:
            try:
                suspects = location.suspects(cause, able)
            except InputError as error:
                unavailable.append((cause.word, str(error)))
                continue
            for suspect in suspects:
                of_sheet = cause.kind == "measurement" and cause.evidence_of == "data_sheet"
                provable = not of_sheet or suspect.quantity in sheet
                alike = cause, location.site, suspect.form, suspect.grid
                columns = slice(first, first + len(suspect.grid))
                found.append(Candidate(cause, suspect, columns, location.site, twins[alike], provable))
                twins[alike] += 1
                first = columns.stop
    return found, tuple(dict.fromkeys(unavailable))


def of_names(candidates: Sequence[Candidate], names: Collection[tuple[str, str]]) -> list[Candidate]:
    """The candidates of some causes where they are, their columns one behind the other."""
    found, first = [], 0
    for candidate in (candidate for candidate in candidates if candidate.name in names):
        found.append(replace(candidate, columns=slice(first, first + len(candidate.suspect.grid))))
        first = found[-1].columns.stop
    return found
