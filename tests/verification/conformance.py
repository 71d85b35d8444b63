"""Cases of known truth as a user simulates them: `python tests/verification/conformance.py --write` writes the table.

What is measured of a case: the error of the force that ``dashpot simulate`` writes, and whether its bounds hold. The
table stands in docs/explanation/accuracy.md.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

TESTS = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(TESTS))

from verification.conformance_cases import FAMILIES, KINDS, MOTIONS, RATES, Known, settled_case  # noqa: E402
from verification.systems import system  # noqa: E402

from dashpot.data.drive import drive_from_path  # noqa: E402
from dashpot.data.excitation import Excitation  # noqa: E402
from dashpot.kernel.api import solve  # noqa: E402

CASES = 300
PAGE = TESTS.parent / "docs" / "explanation" / "accuracy.md"
BEGIN, END = "<!-- written: conformance -->", "<!-- end: conformance -->"
# beside what two tolerances of the truth differ by: of the path between samples, which both sides interpolate
RESOLVED = 1e-5


@dataclass(frozen=True)
class Measured:
    """A case as it came out: errors and bounds as shares of the root mean square of the true force."""

    known: Known
    error: float
    peak: float
    bound: float
    bound_peak: float
    refine: int

    @property
    def inside(self) -> bool:
        """Whether the bound of the root mean square holds, but for the doubt of the truth."""
        return self.error <= self.bound + self.known.doubt / rms(self.known.force) + RESOLVED

    @property
    def inside_peak(self) -> bool:
        """Whether the bound of the peak holds."""
        return self.peak <= self.bound_peak + self.known.doubt_peak / rms(self.known.force) + 10.0 * RESOLVED


def rms(signal: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.square(signal))))


def excitation_of(known: Known) -> Excitation:
    """The motion with its true rates at the samples."""
    case = known.case
    dt = 1.0 / case.rate
    drive = drive_from_path(dt, *case.motion.sampled(dt * np.arange(case.samples)))
    return Excitation({"base": drive}, {}, {}, dt, case.samples)


def measure(known: Known) -> Measured:
    """The case as dashpot simulates it by default; an error for one that it cannot solve."""
    case = known.case
    found = solve(system(case.nodes, case.branches), excitation_of(known))
    away, size = found.force["base"] - known.force, rms(known.force)
    error, peak = rms(away) / size, float(np.max(np.abs(away))) / size
    return Measured(known, error, peak, found.error["base"] / size, found.peak["base"] / size, found.refine)


def table(cases: list[Measured]) -> Iterator[str]:
    """A line for all cases, and one for each family, motion, sampling rate and element."""
    aside = sum(each.known.aside for each in cases)
    yield (
        f"{len(cases)} cases; {aside} draws were set aside before, because the integrator did not settle their truth "
        "or the force was below 1 N. Errors and bounds are shares of the RMS of the true force."
    )
    yield ""
    yield "| cases | | RMS error, median | 95 % | largest | inside the bound | peak inside | steps, median |"
    yield "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
    yield row("all", cases)
    for word in FAMILIES:
        yield row(f"parameters: {word}", [each for each in cases if each.known.case.family == word])
    for word in MOTIONS:
        yield row(f"motion: {word}", [each for each in cases if each.known.case.kind == word])
    for rate in RATES:
        yield row(f"sampled at {rate:.0f} Hz", [each for each in cases if each.known.case.rate == rate])
    for word in KINDS:
        yield row(f"with `{word}`", [each for each in cases if word in each.known.case.words])


def row(what: str, cases: list[Measured]) -> str:
    """One line of the table."""
    errors = np.array([each.error for each in cases])
    held, held_peak = (share(cases, inside) for inside in (lambda each: each.inside, lambda each: each.inside_peak))
    steps = int(np.median([each.refine for each in cases]))
    return (
        f"| {what} | {len(cases)} | {np.median(errors):.1e} | {np.quantile(errors, 0.95):.1e} | {errors.max():.1e} | "
        f"{held} | {held_peak} | {steps} |"
    )


def share(cases: Iterable[Measured], inside: Callable[[Measured], bool]) -> str:
    """How many cases hold their bound, in percent."""
    return f"{100.0 * np.mean([inside(each) for each in cases]):.1f} %"


def main() -> None:
    """Measure, print, and write where that is wanted."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=int, default=CASES)
    parser.add_argument("--write", action="store_true", help="renew the table of the documentation")
    asked = parser.parse_args()
    cases = []
    for number in range(asked.cases):
        cases.append(measure(settled_case(number)))
        print(number, cases[-1].known.case.words, f"{cases[-1].error:.1e} of {cases[-1].bound:.1e}", flush=True)
    lines = "\n".join(table(cases))
    print(lines)
    if asked.write:
        before, rest = PAGE.read_text(encoding="utf-8").split(BEGIN)
        PAGE.write_text(f"{before}{BEGIN}\n\n{lines}\n\n{END}{rest.split(END)[1]}", encoding="utf-8")


if __name__ == "__main__":
    main()
