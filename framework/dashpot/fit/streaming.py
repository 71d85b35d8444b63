"""What sets of parameters are worth on more runs than memory holds."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from dashpot.data.dataset import Dataset
from dashpot.data.ends import one_force_each
from dashpot.data.run import Run
from dashpot.fit.objective import Objective
from dashpot.fit.scored import score_run
from dashpot.kernel.network import CompiledNetwork
from dashpot.kernel.system import CompiledSystem

Array = NDArray[np.float64]


class StreamedObjective:
    """The misfit of a compiled network on ``runs`` that are read whenever they are needed; see ``Objective``.

    ``runs`` can be iterated over again and again, such as a ``RunStream``. No more than ``jobs`` of them are in memory.
    """

    def __init__(self, network: CompiledNetwork | CompiledSystem, runs: Iterable[Run], jobs: int = 1) -> None:
        self.network, self.runs, self.jobs = network, runs, jobs

    def losses(self, values: Array) -> Array:
        """The loss of every lane (lanes,) in N; a lane that fails costs infinity."""
        total, count = np.zeros(np.atleast_2d(values).shape[0]), 0
        for _, errors in self.rmse(values):
            total += np.square(errors)
            count += 1
        return np.sqrt(total / count)

    def rmse(self, values: Array) -> Iterator[tuple[str, Array]]:
        """The name of one run after the other with its root mean square error (lanes,) in N."""
        runs = iter(self.runs)
        with ThreadPoolExecutor(self.jobs) as pool:
            while some := list(islice(runs, self.jobs)):
                for found in pool.map(lambda run: self._errors(run, values), some):
                    yield from found

    def _errors(self, run: Run, values: Array) -> list[tuple[str, Array]]:
        scored = [score_run(part) for part in one_force_each(Dataset(run.name, (run,))).runs]
        return [
            (part.name, error) for part, error in zip(scored, Objective(self.network, scored).rmse(values), strict=True)
        ]
