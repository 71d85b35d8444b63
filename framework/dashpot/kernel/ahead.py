"""Compiling networks before they are needed."""

from __future__ import annotations

import numpy as np

from dashpot.data.drive import drive_from_samples
from dashpot.data.excitation import Excitation
from dashpot.kernel.following import keys_of
from dashpot.kernel.network import CompiledNetwork, compile_network
from dashpot.kernel.parts import take_apart
from dashpot.kernel.system import CompiledSystem
from dashpot.kernel.targets.choice import LLVM, backend
from dashpot.model.network import Characteristic, NetworkSpec, Value

KNOTS = (0.0, 1e-3)  # a curve along the motion is looked up outside the compiled code, however many knots it has
STEP, SAMPLES = 1e-3, 16  # s; of the record with which a backend is called that compiles what it is called with


def compile_ahead(spec: NetworkSpec) -> None:
    """Compile all that simulations and fits of a network need, for every number of lanes, or find it in the cache.

    Raises InputError for a network that cannot be compiled, and where the cache folder cannot be written.
    """
    filled = with_curves(spec)
    network = compile_network(filled)
    if isinstance(network, CompiledSystem):
        _compile_system(network)
        return
    for each in (network, *(part.network for part in take_apart(filled).members)):
        _compile_network(each)


def _compile_network(network: CompiledNetwork) -> None:
    if backend() != LLVM:
        network.simulate(network.prepare(drive_from_samples(STEP, np.zeros(SAMPLES))))
        return
    for group in network.groups:
        network.native(*group)


def _compile_system(network: CompiledSystem) -> None:
    if backend() != LLVM:
        network.solve(network.prepare(_at_rest(network)))
        return
    for alone in (True, False):
        network.native(alone)


def _at_rest(network: CompiledSystem) -> Excitation:
    drive, slots = drive_from_samples(STEP, np.zeros(SAMPLES)), network.spec.slots()
    settings = {slot.value.setting: slot.value.number for slot in slots if slot.value.setting}
    settings |= {keys_of(slot.value.over)[0]: slot.value.over.at[0] for slot in slots if slot.value.over}
    loads = {node: np.zeros(SAMPLES) for node in network.topology.held("loaded")}
    return Excitation({node: drive for node in network.outputs}, loads, settings, STEP, SAMPLES, "at rest")


def with_curves(spec: NetworkSpec) -> NetworkSpec:
    """The network with some table in the place of every curve that is to come from data."""
    for path, curve in spec.data_curves().items():
        if curve.form == "data":
            values = tuple(Value(at, curve.curve.value[1]) for at in KNOTS)
            spec = spec.with_curve(path, Characteristic(curve.curve, "table", values, KNOTS, curve.data))
    return spec
