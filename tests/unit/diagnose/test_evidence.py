"""Evidence against the rig: what a fault of the measurement does and no law of a specimen."""

from dataclasses import replace
from types import MappingProxyType

import numpy as np
import pytest
from scipy.signal import lfilter
from unit.diagnose import laws
from unit.diagnose.rig import (
    MOTIONS,
    NETWORK,
    REGISTRY,
    STIFFNESS,
    TIME,
    Motion,
    bench,
    causes,
    dataset,
    friction,
    plain,
)

from dashpot.diagnose.diagnose import diagnose
from dashpot.diagnose.evidence import has_evidence, is_determined
from dashpot.diagnose.folds import folds_of
from dashpot.diagnose.look import look_at
from dashpot.diagnose.score import Added, Scores, Structure
from dashpot.diagnose.search import additions
from dashpot.diagnose.trials import terms_of
from dashpot.model.reading import parse_network


def refitter_of(made, sheet):
    """The refitter of a bench whose force channel has a data sheet."""
    return replace(made.refitter, sensors={run.name: sheet for run in made.refitter.runs})


def proven(data, word, sheet=MappingProxyType({}), text=NETWORK):
    """Whether the best form of a cause, refitted beside the network, has its evidence."""
    made = bench(data, text)
    refitter = refitter_of(made, sheet)
    folds, chosen = folds_of(refitter.runs, made.groups), causes(word)
    look = look_at(refitter, made.model, chosen, folds)
    scores = Scores(look)
    places = [(k, place) for k, one in enumerate(look.candidates) for place in range(len(one.suspect.grid))]
    structures = [Structure(added=frozenset({Added(k, (place,))})) for k, place in places]
    best = min(structures, key=scores.score)
    model = refitter.refit(look.model, terms_of(scores, best), look.noise, scores.moves(best))
    seen = Scores(look_at(refitter, model, chosen, folds, look.noise))
    return is_determined(seen, 0) and has_evidence(refitter, seen, 0)


def rubbing(motion):
    """Dry friction beside a soft spring (n,) N: its force, too, ends at one value."""
    return friction(motion, limit=900.0, travel=0.5e-3) + 4e3 * motion.x()


def late(law, lag):
    """The force of a law, shown by so much too late, between samples."""
    return lambda motion: np.interp(TIME - lag, TIME, law(motion))


def test_a_channel_at_the_end_of_its_range_is_proven():
    """A spring ends at one value on the way out and on the way back."""
    assert proven(dataset(lambda motion: np.minimum(plain(motion), 1500.0)), "clipping")


def test_a_force_that_rises_beyond_the_level_is_not_clipped():
    """It rises a third as fast: a specimen that yields."""
    yielding = dataset(lambda motion: np.minimum(plain(motion), 1500.0 + (plain(motion) - 1500.0) / 3.0))
    assert not proven(yielding, "clipping")


def test_dry_friction_is_no_clipping():
    assert not proven(dataset(rubbing), "clipping")


@pytest.mark.parametrize("lag", [0.6e-3, 1.2e-3])
def test_a_late_channel_is_proven_where_the_force_is_in_phase(lag):
    assert proven(dataset(late(plain, lag)), "delay")


def test_an_early_channel_is_told_as_that_alone():
    """The last samples show what the motion does after the record: a mass and a damper would make up for them."""
    early = dataset(lambda motion: plain(motion, TIME + 4e-3))
    found = diagnose(parse_network(NETWORK, REGISTRY.elements), early, registry=REGISTRY)
    assert [(term.cause.word, term.accepted) for term in found.named] == [("delay", True)]
    assert found.verdict == "explained"


def test_dry_friction_behind_a_spring_is_no_delay():
    """Its force lags behind the velocity alike in all runs, and no phase of a spring is there to prove a delay."""
    assert not proven(dataset(late(rubbing, 1.2e-3)), "delay")


@pytest.mark.parametrize("fastest, shown", [(1.0, False), (12.0, True)])
def test_a_delay_does_not_show_at_one_frequency(fastest, shown):
    """From a spring alone: at 1 Hz a delay of 6 ms is a loss angle of 2 degrees, up to 12 Hz it is a delay."""
    motions = {name: replace(motion, fastest=fastest) for name, motion in MOTIONS.items()}
    springs = "\n".join(line for line in NETWORK.splitlines() if "damping" not in line)

    def late_spring(motion):
        return STIFFNESS * motion.x(TIME - 6e-3)

    assert proven(dataset(late_spring, motions=motions), "delay", text=springs) is shown


def heavy(motion, stiffness=40e3, damping=800.0, mass=28.0):
    """A mass that moves along with a spring and a dashpot (n,) N, driven through their resonance at 6 Hz."""
    rate = 2.0 * np.pi * (1.0 + (motion.fastest - 1.0) * TIME / TIME[-1])
    bend = 2.0 * np.pi * (motion.fastest - 1.0) / TIME[-1] * np.cos(motion.phase()) - rate**2 * np.sin(motion.phase())
    return stiffness * motion.x() + damping * motion.v() + mass * motion.amplitude * bend


def test_a_mass_that_is_driven_through_its_resonance_is_proven():
    """Stiffness and inertia cancel there, and the loss angle of the whole is that of what is left of both."""
    assert proven(dataset(heavy), "moving_mass")


ORDER = [(2, 5), (1, 11), (3, 8), (1, 5), (3, 11), (2, 8), (3, 5), (1, 8), (2, 11)]  # no stroke foretells it
SESSION = {f"a{a}_p{p}": Motion(1e-3 * a, 1e-3 * p) for a, p in ORDER}
PLACE = {motion: place for place, motion in enumerate(SESSION.values())}


@pytest.mark.parametrize("stiffness, damping", [(200e3, 400.0), (40e3, 2e3)])
def test_a_zero_that_moves_over_the_session_is_proven_whatever_the_losses(stiffness, damping):
    """It has no phase: 6 N from each run to the next, in a spring as well as in a damper."""

    def law(motion):
        return stiffness * motion.x() + damping * motion.v() + 6.0 * PLACE[motion]

    assert proven(dataset(law, motions=SESSION), "drift")


def test_a_zero_that_jumps_once_does_not_move_with_the_order():
    def law(motion):
        return plain(motion) + 30.0 * (PLACE[motion] > 6)

    assert not proven(dataset(law, motions=SESSION), "drift")


def test_a_specimen_that_relaxes_from_run_to_run_is_no_drift():
    """It loses 0.5 % of its load with each run: at 5, 8 and 11 mm of preload 5, 8 and 11 N."""

    def law(motion):
        return plain(motion) - 1e3 * motion.preload * PLACE[motion]

    assert not proven(dataset(law, motions=SESSION), "drift")


def test_a_force_that_moves_at_one_preload_only_may_be_that_of_the_specimen():
    one = {
        f"a{a}_f{f}": Motion(1e-3 * a, 8e-3, f) for a, f in [(2, 2.0), (1, 3.0), (3, 2.0), (1, 2.0), (3, 3.0), (2, 3.0)]
    }
    place = {motion: number for number, motion in enumerate(one.values())}
    assert not proven(dataset(lambda motion: plain(motion) + 6.0 * place[motion], motions=one), "drift")


def soft_fixture(motion, compliance=1e-6, damping=4e3):
    """Spring and dashpot behind a fixture of 1 kN/mm (n,) N: F + T dF/dt = (k x + d v) / (1 + k c)."""
    fine = np.linspace(0.0, TIME[-1], 10 * (TIME.size - 1) + 1)
    share = 1.0 / (1.0 + STIFFNESS * compliance)
    driven = share * (STIFFNESS * motion.x(fine) + damping * motion.v(fine))
    kept = np.exp(-(fine[1] - fine[0]) / (damping * compliance * share))
    middle = 0.5 * (driven[1:] + driven[:-1])
    return np.append(driven[0], lfilter([1.0 - kept], [1.0, -kept], middle, zi=[kept * driven[0]])[0])[::10]


@pytest.mark.parametrize("most, admitted", [(2e-6, True), (0.2e-6, False)])
def test_a_fixture_gives_way_within_the_data_sheet(most, admitted):
    assert proven(dataset(soft_fixture), "fixture_compliance", {"compliance": most}) is admitted


def test_without_a_data_sheet_a_fixture_is_not_proposed():
    made = bench(dataset(soft_fixture))
    folds = folds_of(made.refitter.runs, made.groups)
    scores = Scores(look_at(made.refitter, made.model, causes("fixture_compliance"), folds))
    assert len(scores.look.candidates) == 1 and additions(scores, Structure()) == []


def rigidly_held(motion):
    """The cubic spring and the dashpot of ``laws.soft_fixture`` (n,) N."""
    return STIFFNESS * motion.x() + 1.2e9 * motion.x() ** 3 + 1500.0 * motion.v()


@pytest.mark.parametrize("law, is_late", [(laws.soft_fixture, False), (late(rigidly_held, 1e-3), True)])
def test_a_soft_fixture_without_a_data_sheet_is_a_rival_of_a_late_channel(law, is_late):
    """Where the specimen is stiffer more of its damping is lost in the fixture, as with a channel that is late."""
    network, words = parse_network(laws.BENT, REGISTRY.elements), ("delay", "moving_mass", "fixture_compliance")
    registry = replace(REGISTRY, causes={word: REGISTRY.causes[word] for word in words})
    found = diagnose(network, dataset(law, motions=laws.GRID), registry=registry).as_dict()
    delay = next(each for each in found["causes"] if each["cause"] == "delay")
    assert delay["accepted"] is is_late
    assert [rival["cause"] for rival in delay["rivals"]] == ([] if is_late else ["fixture_compliance"])
