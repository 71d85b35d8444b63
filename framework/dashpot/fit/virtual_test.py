"""A network on a test bench: what its load cell and its displacement sensor would write down."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.bench import Bench
from dashpot.contract.measuring import Measuring
from dashpot.contract.rig import PORT, PlannedRun
from dashpot.data.excitation import channel_at
from dashpot.data.run import Run
from dashpot.fit.driven import as_driven
from dashpot.kernel.api import RunSolution, solve
from dashpot.kernel.network import CompiledNetwork, compile_network
from dashpot.kernel.observe import Observation
from dashpot.kernel.system import CompiledSystem
from dashpot.kernel.within import TOLERANCE
from dashpot.model.network import NetworkSpec

Array = NDArray[np.float64]
DYNAMIC = ("sweep", "harmonic", "random", "transient")
LETTERS = "bcdefghijklmnopqrstuvwxyz"


def bench_as_driven(spec: NetworkSpec, bench: Bench, refine: int | None = None, tolerance: float = TOLERANCE) -> Bench:
    """The bench with its runs as the rig can drive them on the network; one that is not as planned has a note of it.

    ``refine`` and ``tolerance`` as in ``virtual_test``.

    InputError for a network that cannot be simulated, or that presses with more than the rig bears.
    """
    network = compile_network(spec)

    def largest_force(planned: PlannedRun) -> float:
        answer = answer_of(network, planned, refine, tolerance)
        return max(float(np.max(np.abs(force))) for force in answer.force.values())

    return as_driven(bench, largest_force)


def virtual_test(
    spec: NetworkSpec,
    bench: Bench,
    seed: int = 0,
    refine: int | None = None,
    progress: Callable[[str, float], None] | None = None,
    tolerance: float = TOLERANCE,
) -> list[Run]:
    """Every run of the bench as the rig can drive it, measured on the network; the same seed gives the same noise.

    Where the motion of a node is unknown, the numerical error of each force is at most the ``tolerance``, a share of
    its root mean square; or, by hand, ``refine`` times as many steps as usual lie between two samples.
    ``progress`` hears of each planned run, by name and with the share of those before it.

    InputError for a network that cannot be simulated, or that has not the nodes that the bench drives.
    """
    network = compile_network(spec)
    measured: list[Run] = []
    planned_runs = bench_as_driven(spec, bench, refine, tolerance).runs()
    for number, planned in enumerate(planned_runs):
        if progress:
            progress(planned.name, number / len(planned_runs))
        answer = answer_of(network, planned, refine, tolerance)
        for repeat in range(bench.measuring.repeats if planned.kind in DYNAMIC else 1):
            rng = np.random.default_rng([seed, len(measured)])
            measured.append(_measured(planned, answer, bench.measuring, repeat, len(measured), rng))
    return measured


def answer_of(
    network: CompiledNetwork | CompiledSystem, planned: PlannedRun, refine: int | None, tolerance: float
) -> RunSolution:
    """The forces at the driven nodes and the motions of the free ones."""
    found = solve(network, planned.excitation(), refine, tolerance)
    if list(planned.motion) == [PORT]:
        return replace(found, force={PORT: next(iter(found.force.values()))})
    return found


def _measured(
    planned: PlannedRun,
    answer: RunSolution,
    chain: Measuring,
    repeat: int,
    order: int,
    rng: np.random.Generator,
) -> Run:
    name = planned.name + (f"_{LETTERS[repeat - 1]}" if repeat else "")
    channels = dict(_channels(planned, answer, chain, rng))
    return Run(
        name=name,
        kind=planned.kind,
        time=planned.time,
        channels=channels,
        settings=planned.settings,
        notes=planned.notes,
        repeats=planned.name if repeat else None,
        group=planned.name,
        sensors=_data_sheet(channels, chain),
        order=order,
    )


def _channels(
    planned: PlannedRun, answer: RunSolution, chain: Measuring, rng: np.random.Generator
) -> Iterator[tuple[str, Array]]:
    moved = {node: path.displacement for node, path in planned.motion.items()} | dict(answer.motion)
    for node, displacement in moved.items():
        jitter = chain.displacement_noise * rng.standard_normal(planned.samples)
        yield channel_at("displacement", node), displacement + jitter
    for node, force in answer.force.items():
        felt = force + carried_mass(chain) * planned.motion[node].acceleration
        shown = Observation(np.array([chain.gain]), np.array([chain.zero]), np.array([chain.delay]))
        noise = chain.force_noise * coloured_noise(rng, planned.samples, planned.sample_time, chain.noise_memory)
        yield channel_at("force", node), shown.see(felt[None], planned.sample_time)[0] + noise


def carried_mass(chain: Measuring) -> float:
    """The mass in kg between the load cell and the driven end."""
    return chain.platform_mass if chain.side == "platform" else 0.0


def coloured_noise(rng: np.random.Generator, samples: int, sample_time: float, memory: float) -> Array:
    """Gaussian noise (samples,) of variance 1, half of it white, half remembered over ``memory`` s."""
    white, driven = rng.standard_normal((2, samples))
    if memory == 0.0:
        return white
    from scipy.signal import lfilter

    kept = np.exp(-sample_time / memory)
    driven[1:] *= np.sqrt(1.0 - kept**2)
    return np.sqrt(0.5) * (white + lfilter([1.0], [1.0, -kept], driven))


def _data_sheet(channels: Mapping[str, Array], chain: Measuring) -> dict[str, dict[str, float]]:
    noise = {"displacement": chain.displacement_noise, "force": chain.force_noise}
    levels = {name: noise[name.partition("@")[0]] for name in channels}
    return {name: {"noise": level} for name, level in levels.items() if level > 0.0}
