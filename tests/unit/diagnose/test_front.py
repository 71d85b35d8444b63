"""What is refitted beside structures of which terms are gone."""

from itertools import combinations

import numpy as np

from dashpot.diagnose import front
from dashpot.diagnose.front import Front


def test_what_is_known_beside_structures_keeps_to_its_room_and_comes_out_the_same(monkeypatch):
    rows = np.random.default_rng(1).standard_normal((3, 40, 200))
    grams = rows @ rows.transpose(0, 2, 1)
    owners = np.array([0, 0, 1, 2, 3, 3])

    def made():
        return Front(grams, grams.sum(axis=0), np.zeros((0, 40)), np.full(6, 100.0), owners, 3)

    room = 5 * made().beside().nbytes
    monkeypatch.setattr(front, "ROOM", room)
    asked, much = [frozenset(gone) for k in range(4) for gone in combinations(range(4), k)], made()
    for gone in [*asked, *asked[::-1]]:
        assert np.array_equal(much.beside(gone).gram, made().beside(gone).gram)
        assert sum(one.nbytes for one in much._known.values()) <= room
    assert len(much._known) == 5
