"""A bushing property file of Altair's multi-body tools."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from typing import TYPE_CHECKING, Annotated

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.export import Export
from dashpot.data.drive import drive_from_samples
from dashpot.model.network import NetworkSpec
from dashpot_exports.sines import SAMPLES, beyond, preloads_of, require_one_end, sine

if TYPE_CHECKING:
    from dashpot.kernel.network import CompiledNetwork
    from dashpot.kernel.system import CompiledSystem

    Compiled = CompiledNetwork | CompiledSystem

Array = NDArray[np.float64]
Sine = tuple[float, float, float]  # frequency, amplitude, preload

POINTS, BETWEEN = 41, 50  # of the static curve, and steps from one to the next
TURNING = 4  # points beyond each end of the static curve, where the slow loop turns
SLOW = 1000.0  # s, from one end of the static curve to the other
WAY = (-5e-3, 5e-3)  # m, of the static curve of a network whose range of identification is not known
DIRECTIONS = ("FX", "FY", "FZ", "TX", "TY", "TZ")
METHODS = (
    "SPLINE_STIFFNESS",
    "CONSTANT_STIFFNESS",
    "CUBIC_STIFFNESS",
    "CONSTANT_DAMPING",
    "RUBBER_DAMPING",
    "HYDROMOUNT_DAMPING",
)
ACTIVE = ("SPLINE_STIFFNESS", "CONSTANT_DAMPING")
TEXT = """\
$ {title}
$ Approximated by a static curve and a constant damping; friction, relaxation and all that depends on amplitude or
$ frequency are left out. The largest error along the sines of {name}_conversion.csv: {worst:.1%} of the dynamic force.
$ Compression positive.{outside}
$------------------------------------------------------------------------- HEADER
[HEADER]
FILE_TYPE    = 'gbs'
FILE_VERSION = '1'
FILE_FORMAT  = 'ASCII'
$-------------------------------------------------------------------------- UNITS
[UNITS]
LENGTH = 'mm'
FORCE  = 'newton'
ANGLE  = 'degree'
MASS   = 'kg'
TIME   = 'second'
$------------------------------------------------------------------------- GLOBAL
[GLOBAL]
COUPLING = 'UNCOUPLED'
$--------------------------------------------------------------------- DIRECTIONS
[DIRECTIONS]
(ACTIVITY)
{{ formulation {directions} }}
{activity}
$---------------------------------------------------------------- STIFFNESS AND DAMPING
[SPLINE_STIFFNESS_{direction}]
(SPLINE_DATA)
{{ disp force }}
{curve}
[CONSTANT_DAMPING_{direction}]
C = {damping!r}
"""
TABLE = """\
frequency,amplitude,preload,error,share
Hz,m,m,N,1
"""


class Gbs(Export):
    """A bushing property file (.gbs) of one direction: a static curve and a constant damping.

    It follows the public description of the format and holds less than a network: the errors of the conversion along
    sines stand in NAME_conversion.csv, the largest one in its head.

    frequencies, amplitudes, preloads: of the sines; by default the least, the middle and the largest preload of the
    identification. direction: FX, FY or FZ.
    """

    word = "gbs"

    def __init__(
        self,
        frequencies: Annotated[tuple[float, ...], "Hz"] = (1.0, 5.0, 15.0, 25.0),
        amplitudes: Annotated[tuple[float, ...], "m"] = (5e-4, 2e-3),
        preloads: Annotated[tuple[float, ...], "m"] = (),
        direction: str = "FZ",
    ):
        if min(*frequencies, *amplitudes) <= 0.0:
            raise ValueError("frequencies and amplitudes: expected more than 0")
        if direction not in DIRECTIONS[:3]:
            raise ValueError(f"direction: expected one of {', '.join(DIRECTIONS[:3])}, got '{direction}'")
        self.frequencies, self.amplitudes, self.preloads = frequencies, amplitudes, preloads
        self.direction = direction

    def files(self, network: NetworkSpec) -> Mapping[str, bytes]:
        """``NAME.gbs`` and ``NAME_conversion.csv``."""
        from dashpot.kernel.export import exported
        from dashpot.kernel.network import compile_network
        from dashpot.kernel.targets.c99.header import identifier

        require_one_end(network, "a bushing property file")
        found, name, compiled = exported(network), identifier(network.name), compile_network(network)
        sines = list(product(self.frequencies, self.amplitudes, self.preloads or preloads_of(network)))
        place, static = _static(network, compiled, sines)
        damping, errors = _damping(compiled, sines, place, static)
        outside = beyond(network, sines)
        text = TEXT.format(
            title=" ".join(found.title.split()),
            name=name,
            worst=max(share for _, share in errors),
            outside=f"\n$ {outside}" if outside else "",
            directions=" ".join(DIRECTIONS),
            activity="\n".join(self._activity()),
            direction=self.direction,
            curve="\n".join(f"{1e3 * x!r} {force!r}" for x, force in zip(place.tolist(), static.tolist(), strict=True)),
            damping=1e-3 * damping,
        )
        rows = "\n".join(",".join(map(repr, (*given, *told))) for given, told in zip(sines, errors, strict=True))
        return {f"{name}.gbs": text.encode(), f"{name}_conversion.csv": (TABLE + rows + "\n").encode()}

    def _activity(self) -> Iterator[str]:
        for method in METHODS:
            flags = (int(method in ACTIVE and each == self.direction) for each in DIRECTIONS)
            yield f"'{method}' {' '.join(map(str, flags))}"


def _static(network: NetworkSpec, compiled: Compiled, sines: Sequence[Sine]) -> tuple[Array, Array]:
    """Places (m) and the mid line (N) of a slow loop through all of them."""
    recorded = [ends for key, ends in network.identified.range.items() if key.startswith("displacement")]
    low, high = recorded[0] if recorded else WAY
    reached = [preload + side * amplitude for _, amplitude, preload in sines for side in (-1.0, 1.0)]
    place = np.linspace(min(low, *reached), max(high, *reached), POINTS)
    margin = TURNING * (place[1] - place[0])  # at its ends a loop has no middle
    there = np.linspace(place[0] - margin, place[-1] + margin, (POINTS - 1 + 2 * TURNING) * BETWEEN + 1)
    path = np.concatenate([there, there[-2::-1], there[1:]])  # the first way leads onto the loop
    force = compiled.along(drive_from_samples(SLOW / (there.size - 1), path, smooth=False))()
    once = there.size - 1
    down, up = force[once : 2 * once + 1][::-1], force[2 * once :]
    return place, 0.5 * (up + down)[TURNING * BETWEEN :: BETWEEN][:POINTS]


def _damping(
    compiled: Compiled, sines: Sequence[Sine], place: Array, static: Array
) -> tuple[float, list[tuple[float, float]]]:
    """The damping (N s/m) by least squares in which all sines count alike, and the error (N, share) of each."""
    rests = []
    for each in sines:
        drive = sine(*each)
        x, v, force = (row[-SAMPLES:] for row in (drive.displacement, drive.velocity, compiled.along(drive)()))
        rests.append((force - _curve(place, static, x), v, float(np.std(force))))
    damping = sum(rest @ v / size**2 for rest, v, size in rests) / sum(v @ v / size**2 for _, v, size in rests)
    errors = [float(np.sqrt(np.mean((rest - damping * v) ** 2))) for rest, v, _ in rests]
    return float(damping), [(error, error / size) for error, (_, _, size) in zip(errors, rests, strict=True)]


def _curve(place: Array, static: Array, x: Array) -> Array:
    from scipy.interpolate import CubicSpline

    return np.asarray(CubicSpline(place, static)(x), dtype=float)
