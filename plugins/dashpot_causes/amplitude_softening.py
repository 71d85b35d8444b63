"""Softening with amplitude, as in filled rubber."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import product

from dashpot.contract.cause import Cause, Pair, Suspect, View, added_branch
from dashpot.model.network import NetworkSpec

UNITS = {"stiffness": "N/m", "shortest": "m", "longest": "m", "travel": "m", "exponent": "1"}
SHORTEST = (1e-3, 4e-3, 1.5e-2)  # of the stroke
LONGEST = (0.3, 1.0, 3.0)
MIDDLE = (0.01, 0.04, 0.15, 0.6)  # of the stroke
EXPONENTS = (0.5, 0.8)
SPREAD = 15.0  # longest over shortest yield travel
WIDE = (0.35, 1.3)  # a larger exponent is that of one contact


class AmplitudeSoftening(Cause):
    """Sliders behind springs whose yield travels are spread over decades (Payne effect)."""

    word = "amplitude_softening"
    kind = "specimen"
    about = "softening with amplitude"
    shows = "storage stiffness falls with the logarithm of amplitude over decades, the loop stays near to an ellipse"
    confused_with = {
        "friction": "a wider ladder of amplitudes: one slider softens within a decade, and shows a third harmonic",
        "relaxation": "an amplitude ladder at one frequency: relaxation does not soften",
        "softening": "the ladder up and down again: warming lags behind, amplitude does not",
        "bedding_in": "the ladder up and down again: bedding-in does not come back",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """Sliders spread between a shortest and a longest yield travel; sliders spread around a middle one."""
        stroke = view.stroke
        spans = [{"shortest": short * stroke, "longest": long * stroke} for short, long in product(SHORTEST, LONGEST)]
        bells = [{"travel": share * stroke, "exponent": power} for share, power in product(MIDDLE, EXPONENTS)]
        yield _spread("iwan", spans, admits=is_spread)
        yield _spread("kraus", bells, {"exponent": WIDE})


def is_spread(numbers: Mapping[str, float]) -> bool:
    """Whether the yield travels reach over more than a single contact does, which is dry friction."""
    return numbers["longest"] > SPREAD * numbers["shortest"]


def _spread(
    element: str,
    spreads: Sequence[Mapping[str, float]],
    bounds: Mapping[str, Pair] | None = None,
    admits: Callable[[Mapping[str, float]], bool] = lambda numbers: True,
) -> Suspect:
    return added_branch(
        element,
        "amplitude_softening",
        tuple(float(number) for number in range(len(spreads))),
        lambda stiffness, place: {"stiffness": stiffness, **spreads[int(place)]},
        UNITS,
        unknowns=2,
        bounds=bounds or {},
        admits=admits,
    )
