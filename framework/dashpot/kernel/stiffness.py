"""Dynamic stiffness of a network: the fundamental of its force under a steady sine, over the motion."""

from __future__ import annotations

import warnings
from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dashpot.data.drive import Drive, drive_from_path
from dashpot.data.excitation import Excitation
from dashpot.kernel.api import solve
from dashpot.kernel.network import CompiledNetwork, compile_network
from dashpot.kernel.settings import require_settings
from dashpot.kernel.system import CompiledSystem
from dashpot.model.network import NetworkSpec
from dashpot.model.topology import topology_of
from dashpot.text.problem import InputError, Place

AnyCompiled = CompiledNetwork | CompiledSystem

SAMPLES = 200  # in a period
FIRST, LAST = 8, 256  # periods
SETTLED = 1e-4  # change of the stiffness while the number of periods doubles


def dynamic_stiffness(
    spec: NetworkSpec,
    frequency: ArrayLike,
    amplitude: ArrayLike,
    preload: ArrayLike = 0.0,
    settings: Mapping[str, float] | None = None,
) -> NDArray[np.complex128]:
    """K* = K' + i K'' in N/m of a network with one driven end, as the load cell shows it.

    ``frequency`` in Hz, ``amplitude`` and ``preload`` in m are broadcast against each other; the answer has their
    common shape. The sine begins at rest at the preload; K* is the fundamental of the force in the last period over the
    amplitude, and the periods are doubled until it changes by less than 1e-4 (else a RuntimeWarning says so).
    ``settings`` in SI are those that its parameters depend on, a channel among them by its name. InputError for a
    network with several driven ends, with curves that have no numbers yet, or without a setting that it needs;
    ValueError for frequencies and amplitudes that are not above 0.
    """
    _refuse_several_ends(spec)
    shape = np.broadcast(frequency, amplitude, preload).shape
    sines = np.stack(np.broadcast_arrays(frequency, amplitude, preload)).astype(float).reshape(3, -1).T
    if not (sines[:, :2] > 0.0).all() or not np.isfinite(sines).all():
        raise ValueError(
            "expected frequencies (Hz) and amplitudes (m) above 0 and finite preloads (m), got "
            f"frequency {frequency!r}, amplitude {amplitude!r}, preload {preload!r}"
        )
    require_settings(spec, {"the sine": settings or {}})
    network = compile_network(spec)
    found = [_settled(network, sine, settings or {}) for sine in sines.tolist()]
    return np.array(found, dtype=complex).reshape(shape)


def _refuse_several_ends(spec: NetworkSpec) -> None:
    driven = topology_of(spec).held("driven")
    if len(driven) != 1:
        raise InputError.at(
            Place(spec.file),
            f"a dynamic stiffness needs a network with one driven end, got {len(driven)}",
            "hold the other ends, or simulate a motion of all of them",
        )


def _settled(network: AnyCompiled, sine: list[float], settings: Mapping[str, float]) -> complex:
    periods, found = FIRST, _stiffness(network, sine, settings, FIRST)
    while periods < LAST:
        periods, before, found = 2 * periods, found, _stiffness(network, sine, settings, 2 * periods)
        if abs(found - before) <= SETTLED * abs(found):
            return found
    frequency, amplitude, preload = sine
    warnings.warn(
        f"the force of '{network.spec.name}' does not settle within {LAST} periods of {frequency:g} Hz, "
        f"{amplitude:g} m around {preload:g} m",
        RuntimeWarning,
        stacklevel=4,
    )
    return found


def _stiffness(network: AnyCompiled, sine: list[float], settings: Mapping[str, float], periods: int) -> complex:
    frequency, amplitude, preload = sine
    drive = _drive(frequency, amplitude, preload, periods)
    excitation = Excitation({"": drive}, settings=settings, dt=drive.dt, samples=drive.samples, name="the sine")
    force = next(iter(solve(network, excitation).force.values()))[-SAMPLES:]
    phase = 2.0 * np.pi * np.arange(1, SAMPLES + 1) / SAMPLES
    # sin is the motion, and i times it is a quarter of a period ahead
    return complex(2.0 * np.mean(force * (np.sin(phase) + 1j * np.cos(phase))) / amplitude)


def _drive(frequency: float, amplitude: float, preload: float, periods: int) -> Drive:
    phase = 2.0 * np.pi * np.arange(periods * SAMPLES + 1) / SAMPLES
    rate = 2.0 * np.pi * frequency
    return drive_from_path(
        1.0 / (frequency * SAMPLES),
        preload + amplitude * np.sin(phase),
        amplitude * rate * np.cos(phase),
        -amplitude * rate**2 * np.sin(phase),
    )
