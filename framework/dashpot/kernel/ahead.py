"""Compiling networks before they are needed."""

from __future__ import annotations

from dashpot.kernel.network import CompiledNetwork, compile_network
from dashpot.kernel.parts import take_apart
from dashpot.kernel.targets.choice import BACKEND, LLVM, backend
from dashpot.model.network import Characteristic, NetworkSpec, Value
from dashpot.text.problem import InputError, Place

KNOTS = (0.0, 1e-3)  # a curve along the motion is looked up outside the compiled code, however many knots it has


def compile_ahead(spec: NetworkSpec) -> None:
    """Compile all that simulations and fits of a network need, for every number of lanes, or find it in the cache.

    Raises InputError for a network that cannot be compiled, where the cache folder cannot be written, and on another
    backend than LLVM, which compiles when it is called.
    """
    if backend() != LLVM:
        message = f"nothing is compiled ahead on the backend '{backend()}', which compiles at the first call"
        raise InputError.at(Place(BACKEND), message, "run a simulation once: what it compiles is kept")
    filled = with_curves(spec)
    network = compile_network(filled)
    if isinstance(network, CompiledNetwork):
        members = [part.network for part in take_apart(filled).members]
        for each in (network, *members):
            for group in each.groups:
                each.native(*group)
    else:
        for alone in (True, False):
            network.native(alone)


def with_curves(spec: NetworkSpec) -> NetworkSpec:
    """The network with some table in the place of every curve that is to come from data."""
    for path, curve in spec.data_curves().items():
        if curve.form == "data":
            values = tuple(Value(at, curve.curve.value[1]) for at in KNOTS)
            spec = spec.with_curve(path, Characteristic(curve.curve, "table", values, KNOTS, curve.data))
    return spec
