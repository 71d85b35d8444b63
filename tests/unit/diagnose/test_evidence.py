"""Evidence against the rig: what a fault of the measurement does and no law of a specimen."""

import numpy as np
import pytest
from unit.diagnose.rig import TIME, bench, causes, dataset, friction, plain

from dashpot.diagnose.evidence import has_evidence, is_determined
from dashpot.diagnose.folds import folds_of
from dashpot.diagnose.look import look_at
from dashpot.diagnose.pursue import terms_of
from dashpot.diagnose.score import Added, Scores, Structure


def proven(data, word):
    """Whether the best form of a cause, refitted beside the network, has its evidence."""
    made = bench(data)
    folds, chosen = folds_of(made.refitter.runs, made.groups), causes(word)
    look = look_at(made.refitter, made.model, chosen, folds)
    scores = Scores(look)
    places = [(k, place) for k, one in enumerate(look.candidates) for place in range(len(one.suspect.grid))]
    structures = [Structure(added=frozenset({Added(k, (place,))})) for k, place in places]
    best = min(structures, key=scores.score)
    model = made.refitter.refit(look.model, terms_of(scores, best), look.noise, scores.moves(best))
    seen = Scores(look_at(made.refitter, model, chosen, folds, look.noise))
    return is_determined(seen, 0) and has_evidence(made.refitter, seen, 0)


def rubbing(motion):
    """Dry friction beside a soft spring (n,) N: its force, too, ends at one value."""
    return friction(motion, limit=900.0, travel=0.5e-3) + 4e3 * motion.x()


def late(law, lag):
    """The force of a law, shown by so much too late, between samples."""
    return lambda motion: np.interp(TIME - lag, TIME, law(motion))


def test_a_channel_at_the_end_of_its_range_is_proven():
    """A spring ends at one value on the way out and on the way back."""
    assert proven(dataset(lambda motion: np.minimum(plain(motion), 1500.0)), "clipping")


def test_dry_friction_is_no_clipping():
    assert not proven(dataset(rubbing), "clipping")


@pytest.mark.parametrize("lag", [0.6e-3, 1.2e-3])
def test_a_late_channel_is_proven_where_the_force_is_in_phase(lag):
    assert proven(dataset(late(plain, lag)), "delay")


def test_dry_friction_behind_a_spring_is_no_delay():
    """Its force lags behind the velocity alike in all runs, and no phase of a spring is there to prove a delay."""
    assert not proven(dataset(late(rubbing, 1.2e-3)), "delay")

