"""Where work is done: in threads or forks of this process, or piece by piece on somebody's pool or cluster.

Whatever takes ``jobs`` takes a number of threads, a ``concurrent.futures.Executor`` or a client of Dask. Threads share
the runs of one piece of work, as numpy and compiled loops let go of the interpreter. A fork does what keeps the
interpreter busy, and has all that this process has. A pool or a cluster does whole pieces, each of them on one thread,
so that no processor is asked for twice.
"""

from __future__ import annotations

import io
import os
import pickle
import sys
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import CancelledError, Executor, Future, ThreadPoolExecutor, as_completed
from contextlib import contextmanager
from functools import cache
from itertools import islice
from operator import itemgetter
from threading import local
from typing import TYPE_CHECKING, Any, TypeVar

from dashpot.text.problem import InputError, Place

if TYPE_CHECKING:
    from concurrent.futures import ProcessPoolExecutor

    from distributed import Client

    Jobs = int | Executor | Client

Item = TypeVar("Item")
Result = TypeVar("Result")

MEMORY = "memory"  # the resource by which workers say how many bytes they have


def threads(jobs: Jobs) -> int:
    """The threads for a piece of work in this process. InputError for what can do no work."""
    if isinstance(jobs, int) and not isinstance(jobs, bool) and jobs > 0:
        return jobs
    if isinstance(jobs, Executor) or hasattr(jobs, "get_executor"):
        return 1
    raise InputError.at(Place("jobs"), f"expected a number of threads, an Executor or a Dask client, got {jobs!r}")


def spread(work: Callable[[Item], Result], items: Iterable[Item], jobs: int) -> list[Result]:
    """What ``work`` makes of each item, in their order, no more than ``jobs`` threads at once."""
    each = list(items)
    shares = [each[first::jobs] for first in range(min(jobs, len(each)))]
    found: list[Any] = [None] * len(each)
    for first, done in enumerate(streamed(lambda share: [work(item) for item in share], shares, jobs)):
        found[first::jobs] = done
    return found


def streamed(work: Callable[[Item], Result], items: Iterable[Item], jobs: int) -> Iterator[Result]:
    """The same one after the other; no more than ``jobs`` of them are ahead of the one that is asked for."""
    if jobs == 1 or _within.thread:
        yield from map(work, items)
        return
    left, pool, ahead = iter(items), _pool(jobs), deque[Future[Result]]()
    try:
        ahead.extend(pool.submit(work, item) for item in islice(left, jobs))
        while ahead:
            found = ahead.popleft().result()
            ahead.extend(pool.submit(work, item) for item in islice(left, 1))
            yield found
    except KeyboardInterrupt:
        # a thread that had just begun may be unknown to the pool: the end of the process would wait for it for ever
        pool.shutdown(wait=False, cancel_futures=True)
        _pool.cache_clear()
        raise
    finally:
        for future in ahead:
            future.cancel()


class _Within(local):
    """Whether this is a thread of a pool: what it does is not spread once more."""

    thread = False


_within = _Within()


@cache
def _pool(jobs: int) -> ThreadPoolExecutor:
    """The threads of this process: making new ones each time would take longer than what they do."""
    return ThreadPoolExecutor(jobs, "dashpot", lambda: setattr(_within, "thread", True))


if hasattr(os, "register_at_fork"):  # threads do not come along
    os.register_at_fork(after_in_child=_pool.cache_clear)


def forks(jobs: int, pieces: int) -> int:
    """In how many copies of this process so many pieces of work are done, no more than ``jobs`` at once.

    On systems that cannot copy a process whose libraries have threads, and within a thread or a copy, it is one.
    """
    return min(jobs, pieces) if sys.platform == "linux" and not _within.thread else 1


def forked(
    work: Callable[[Item], Result], items: Iterable[Item], jobs: int, shared: Sequence[object] = ()
) -> list[Result]:
    """What ``work`` makes of each item, in their order, in ``forks`` of this process.

    Each is a copy of this process, so that ``work`` and the items may be anything. What they come to is pickled on its
    way back; what is ``shared`` is not, but is the same object here. What else they change stays with them.
    """
    return [found for _, found in sorted(forked_as_done(work, items, jobs, shared), key=itemgetter(0))]


def forked_as_done(
    work: Callable[[Item], Result], items: Iterable[Item], jobs: int, shared: Sequence[object] = ()
) -> Iterator[tuple[int, Result]]:
    """The same as they are done, each with the number of its item."""
    each = list(items)
    if (count := forks(jobs, len(each))) < 2:
        yield from enumerate(map(work, each))
        return
    with _ending(count, "fork", _inherit, (work, each, shared)) as pool:
        numbers = {pool.submit(_packed_answer, number): number for number in range(len(each))}
        for future in as_completed(numbers):
            yield numbers[future], _Unpacker(future.result(), shared).load()


_inherited: list[Any] = []  # in a fork: what to do, with what, and what is shared


def _inherit(*given: Any) -> None:
    """Begin a fork: its threads and its keyboard are those of the process that it is a copy of."""
    _left_to_the_parent()
    _within.thread = True
    _inherited[:] = given


def _packed_answer(number: int) -> bytes:
    work, each, shared = _inherited
    packed = io.BytesIO()
    _Packer(packed, shared).dump(work(each[number]))
    return packed.getvalue()


class _Packer(pickle.Pickler):
    """What is shared travels as its number."""

    def __init__(self, packed: io.BytesIO, shared: Sequence[object]) -> None:
        super().__init__(packed, pickle.HIGHEST_PROTOCOL)
        self._numbers = {id(one): number for number, one in enumerate(shared)}

    def persistent_id(self, obj: Any) -> int | None:
        return self._numbers.get(id(obj))


class _Unpacker(pickle.Unpickler):
    def __init__(self, packed: bytes, shared: Sequence[object]) -> None:
        super().__init__(io.BytesIO(packed))
        self._shared = shared

    def persistent_load(self, pid: Any) -> object:
        return self._shared[pid]


@contextmanager
def processes(count: int) -> Iterator[Executor]:
    """So many processes of this machine, which end with the block, at once where it fails or is interrupted."""
    with _ending(count, "spawn", _left_to_the_parent) as pool:
        yield pool


@contextmanager
def _ending(
    count: int, how: str, begin: Callable[..., None], given: tuple[Any, ...] = ()
) -> Iterator[ProcessPoolExecutor]:
    from concurrent.futures import ProcessPoolExecutor
    from multiprocessing import active_children, get_context

    others = active_children()
    pool = ProcessPoolExecutor(count, get_context(how), begin, given)
    try:
        yield pool
    except BaseException:
        pool.shutdown(wait=False, cancel_futures=True)
        for child in active_children():
            if child not in others:
                child.terminate()
        raise
    pool.shutdown()


def _left_to_the_parent() -> None:
    """A key that interrupts reaches all processes of a terminal; the parent ends the others."""
    import signal

    signal.signal(signal.SIGINT, signal.SIG_IGN)


def pieces(work: Callable[..., Result], shared: Any, each: Sequence[Any], jobs: Jobs) -> list[Result]:
    """``work(shared, one)`` for every one, in their order, one after the other here or side by side elsewhere.

    On processes and clusters ``work`` is a function of a module, and what it takes and gives can be pickled. The first
    one that fails raises what it failed with.
    """
    found = {number: result_of(future) for number, future in finished(work, shared, each, jobs)}
    return [found[number] for number in range(len(each))]


def result_of(future: Future[Result]) -> Result:
    """What a finished piece came to, or its error; InputError where its scheduler was lost."""
    try:
        return future.result()
    except CancelledError:
        raise InputError.at(
            Place("scheduler"),
            "the scheduler was lost; what a checkpoint holds is kept",
            "start it again and say the same command, which goes on where it stopped",
        ) from None


def finished(
    work: Callable[..., Result], shared: Any, each: Sequence[Any], jobs: Jobs, memory: float | None = None
) -> Iterator[tuple[int, Future[Result]]]:
    """The same as it is finished: the number of a piece, and a future with its result or its error.

    ``memory`` is what a piece needs, in bytes, told to a scheduler whose workers say what they have. What is not begun
    when the caller stops is not done. A result that was handed out is let go of, so that a scheduler does not keep it
    on its worker, and does not have it done again when that worker is lost.
    """
    if isinstance(jobs, int):
        threads(jobs)
        yield from ((number, _done_here(work, shared, one)) for number, one in enumerate(each))
        return
    pool, shared = _pool_of(jobs, shared, memory)
    futures = {pool.submit(work, shared, one): number for number, one in enumerate(each)}
    try:
        for future in as_completed(futures):
            yield futures.pop(future), future
    finally:
        for future in futures:
            future.cancel()


def _done_here(work: Callable[..., Result], *arguments: Any) -> Future[Result]:
    future: Future[Result] = Future()
    try:
        future.set_result(work(*arguments))
    except Exception as error:
        future.set_exception(error)
    return future


def _pool_of(jobs: Any, shared: Any, memory: float | None) -> tuple[Executor, Any]:
    """Where pieces are handed in, and what they share, which is sent to a cluster once."""
    threads(jobs)
    if isinstance(jobs, Executor):
        return jobs, shared
    told = any(MEMORY in worker["resources"] for worker in jobs.scheduler_info(n_workers=-1)["workers"].values())
    resources = {"resources": {MEMORY: memory}} if memory and told else {}
    # as a task, and not as data that lie with one worker alone, it outlives that worker
    return jobs.get_executor(pure=False, **resources), jobs.submit(_given, shared, pure=False)


def _given(shared: Result) -> Result:
    return shared
