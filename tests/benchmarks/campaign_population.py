"""How well a campaign tells outliers, trend and scatter: ``python tests/benchmarks/campaign_population.py``.

The parameters of virtual bushings with known truth, and errors of the size that their fits have, are drawn instead of
fitted, so that many campaigns can be judged: outliers among sound specimens, how many specimens it takes until one with
a fault is named, how often the 95 % intervals of trend and scatter hold the truth, and whether two groups are found.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from unit.campaign.bushings import FAULTS, PATHS, SCATTER, TREND, Fault, draw_population

from dashpot.campaign.alike import groups_alike
from dashpot.campaign.named import NAMED
from dashpot.campaign.numbers import Numbers
from dashpot.campaign.unlike import Unlike, unlike

ERRORS = np.array([0.0008, 0.002, 0.005])  # standard errors of the logarithms in fits of these bushings
UNITS = ("N/m", "N/m", "s")
SOUND = 100  # specimens of a sound campaign
COUNTS = (10, 12, 16, 20, 30, 40)
FACTORS = (1.15, 1.3, 1.6)
WRONG = {
    "stiffness less by 35 %": Fault(factors=(0.65, 1.0, 1.0)),
    "stiffness less by 20 %": Fault(factors=(0.8, 1.0, 1.0)),
    "gain of 1.5": Fault(gain=1.5),
}


def drawn(seed: int, count: int, faults: dict[int, Fault]) -> Numbers:
    """The parameters of ``count`` bushings over their temperature; play, which no parameter shows, is left out."""
    population = draw_population(seed, count, faults)
    at = np.log(population.numbers) + np.random.default_rng([seed, 2]).normal(size=(count, 3)) * ERRORS
    for which, fault in faults.items():
        at[which] += np.log(fault.factors) + np.log([fault.gain, fault.gain, 1.0])
    temperatures = population.temperatures - population.temperatures.mean()
    design = np.column_stack([np.ones(count), temperatures])
    errors = np.tile(np.diag(ERRORS**2), (count, 1, 1))
    names = tuple(f"b{k:02d}" for k in range(count))
    return Numbers(names, PATHS, UNITS, np.ones(3, dtype=bool), at, errors, design, ("temperature",))


def named(found: Unlike) -> set[int]:
    """The specimens that are named."""
    return set(np.flatnonzero(found.outside >= NAMED).tolist())


def sound(campaigns: int) -> None:
    """Print how many of sound specimens are named."""
    false = sum(len(named(unlike(drawn(seed, SOUND, {})))) for seed in range(campaigns))
    print(f"{campaigns} campaigns of {SOUND} sound specimens: {false} of {campaigns * SOUND} named", flush=True)


def wrong(campaigns: int) -> None:
    """Print how often one specimen with a fault is named, by the number of specimens, and how many others are."""
    for told, fault in WRONG.items():
        for count in COUNTS:
            found = [named(unlike(drawn(seed, count, {count // 2: fault}))) for seed in range(campaigns)]
            hits = sum(count // 2 in each for each in found)
            others = sum(len(each - {count // 2}) for each in found)
            print(f"{told}, {count} specimens: named in {hits} of {campaigns}, others {others}", flush=True)


def covered(campaigns: int, count: int) -> None:
    """Print how often the intervals of trend and scatter hold the truth, with the outliers of the population."""
    fits = [unlike(drawn(seed, count, dict(FAULTS))).population for seed in range(campaigns)]
    trend = np.mean([np.abs(fit.means[1] - TREND) <= fit.widths[1] for fit in fits], axis=0)
    scatter = np.mean([(fit.scatter[:, 0] <= SCATTER) & (SCATTER <= fit.scatter[:, 1]) for fit in fits], axis=0)
    print(f"{campaigns} campaigns of {count} specimens: intervals hold the trend in {trend}, the scatter in {scatter}")


def grouped(campaigns: int, count: int) -> None:
    """Print how often specimens are one group, and two, where every second one has other stiffnesses."""
    for factor in (1.0, *FACTORS):
        other = Fault(factors=(factor, 1.0 / factor, 1.0))
        found = [groups_of(drawn(seed, count, {k: other for k in range(0, count, 2)})) for seed in range(campaigns)]
        one = sum(len(set(each)) == 1 for each in found)
        two = sum(len(set(each[::2])) == len(set(each[1::2])) == 1 for each in found) - one
        print(f"{count} specimens, every second one by {factor:g}: one group {one}, these two {two} of {campaigns}")


def groups_of(numbers: Numbers) -> list[int]:
    """The group of each specimen, without any that is named."""
    judged = unlike(numbers)
    sound = judged.outside < NAMED
    return groups_alike(judged.population.deviations[sound], judged.population.between, 0).tolist()


def main() -> None:
    """Draw, judge and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--campaigns", type=int, default=120)
    options = parser.parse_args()
    covered(options.campaigns, 40)
    sound(options.campaigns)
    wrong(options.campaigns)
    grouped(options.campaigns, 40)


if __name__ == "__main__":
    main()
