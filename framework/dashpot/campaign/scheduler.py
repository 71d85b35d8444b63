"""Workers by a word: processes of this machine, or a cluster whose scheduler somebody has started."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from typing import TYPE_CHECKING, Any

from dashpot.kernel.workers import MEMORY
from dashpot.text.problem import InputError, Place

if TYPE_CHECKING:
    from distributed import Client

PATIENCE = 20.0  # s until a scheduler must have answered
# a look at what every worker is about, a hundred times a second, which nobody sees
UNWATCHED = {"distributed.worker.profile.enabled": False}
LOCAL, REMOTE = "local:", ("tcp://", "tls://", "ws://", "wss://")


@contextmanager
def scheduled(word: str, memory: float | None = None) -> Iterator[Client]:
    """A client of the scheduler at an address, or of so many workers ``local:N`` that end with the block.

    Every local worker has one thread and, where ``memory`` (bytes) is given, no more than that. InputError where there
    is no such scheduler, none of its workers has the memory, or Dask is not installed.
    """
    if not word.startswith((LOCAL, *REMOTE)):
        raise _wrong(word, f"expected local:N or the address of a scheduler such as tcp://host:8786, got '{word}'")
    try:
        import distributed
    except ImportError:
        raise _wrong(
            word,
            "expected Dask for a scheduler, it is not installed",
            "pip install 'dashpot[cluster]', or leave --scheduler out",
        ) from None
    with _local(word, memory) if word.startswith(LOCAL) else nullcontext(word) as place:
        try:
            client = distributed.Client(place, timeout=PATIENCE)
        except OSError:
            raise _wrong(
                word, f"no scheduler answers within {PATIENCE:g} s", "is it running, and may you reach it?"
            ) from None
        with client:
            _refuse_small(client, word, memory)
            yield client


def _local(word: str, memory: float | None) -> Any:
    import dask
    from distributed import LocalCluster

    count = word.removeprefix(LOCAL)
    if not count.isdecimal() or int(count) < 1:
        raise _wrong(word, f"expected a number of workers as in local:8, got '{word}'")
    limits = {"memory_limit": int(memory), "resources": {MEMORY: memory}} if memory else {}
    with dask.config.set(UNWATCHED):
        return LocalCluster(n_workers=int(count), threads_per_worker=1, dashboard_address=":0", **limits)


def _refuse_small(client: Client, word: str, memory: float | None) -> None:
    """A job that asks for more than any worker has would wait for ever."""
    workers = client.scheduler_info(n_workers=-1)["workers"].values()
    told = [worker["resources"].get(MEMORY, worker["memory_limit"] or float("inf")) for worker in workers]
    if memory and told and max(told) < memory:
        raise _wrong(
            word,
            f"expected a worker with {memory:.3g} B of memory for a job, got at most {max(told):.3g} B",
            "start workers with more, or write less under 'memory'",
        )


def _wrong(word: str, message: str, hint: str = "") -> InputError:
    return InputError.at(Place(f"--scheduler {word}"), message, hint)
