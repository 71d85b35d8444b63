"""Pure chance: what every other method has to beat."""

from dashpot import Search


class RandomSearch(Search):
    """Points drawn evenly from the unit cube."""

    word = "random_search"

    def __init__(self, points: int = 64, rounds: int = 20) -> None:
        self.points, self.rounds = points, rounds

    def search(self, space, rng):
        for _ in range(self.rounds):
            yield rng.random((self.points, space.size))
