"""Tire model 5 written by hand in C, compiled by the compiler of the system for this processor."""

from __future__ import annotations

import ctypes
import subprocess
import tempfile
from collections.abc import Mapping
from pathlib import Path
from shutil import which

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator
from truth import FACTOR_AT, SHARPNESS, strokes
from workload import DT, KNOTS, Sweep

Array = NDArray[np.float64]

SOURCE = Path(__file__).with_name("by_hand.c")
GROUP = 16
FLAGS = ("-O3", "-std=gnu11", "-march=native", "-mprefer-vector-width=512", "-ffp-contract=fast", "-shared", "-fPIC")
GAUSS = 16


class ByHand:
    """The scores of all ``lanes`` (count, slots) on a sweep against zero; ``paths`` name the slots."""

    def __init__(self, sweep: Sweep, paths: tuple[str, ...], lanes: Array) -> None:
        self.code, self.count = _library().score, lanes.shape[0]
        wide = np.concatenate([lanes, np.repeat(lanes[-1:], -len(lanes) % GROUP, axis=0)])
        numbers = dict(zip(paths, wide.T, strict=True))
        self.numbers = np.ascontiguousarray(_rows(numbers))
        self.static, self.motion, self.first, self.sides, self.ways = _motion(
            sweep, {k: v[0] for k, v in numbers.items()}
        )
        self.measured, self.error = np.zeros(self.static.size), np.zeros(wide.shape[0])

    def score(self) -> Array:
        """The sums of squares (lanes,)."""
        arrays = (self.first, self.sides, self.ways, self.motion, self.static, self.measured)
        for lane in range(0, self.error.size, GROUP):
            own, error = _place(self.numbers[:, lane:]), _place(self.error[lane:])
            self.code(
                ctypes.c_long(self.sides.size),
                *map(_place, arrays),
                own,
                ctypes.c_long(self.error.size),
                ctypes.c_double(SHARPNESS),
                error,
            )
        return self.error[: self.count].copy()


def compiler() -> str:
    """The C compiler of the system, empty where there is none."""
    return which("cc") or which("gcc") or which("clang") or ""


def _library() -> ctypes.CDLL:
    target = Path(tempfile.mkdtemp()) / "by_hand.so"
    subprocess.run([compiler(), *FLAGS, str(SOURCE), "-o", str(target), "-lm"], check=True, capture_output=True)
    return ctypes.CDLL(str(target))


def _place(array: Array) -> ctypes.c_void_p:
    return ctypes.c_void_p(array.ctypes.data)


def _rows(numbers: Mapping[str, Array]) -> Array:
    rows = [numbers["damping.damping"]]
    for name in ("prandtl_1", "prandtl_2", "prandtl_3", "friction"):
        rows += [numbers[f"{name}.stiffness"], numbers[f"{name}.limit"]]
    at, weight = np.polynomial.legendre.leggauss(GAUSS)
    u, weight = 0.5 * (at + 1.0), 0.5 * DT * weight
    shapes = (1.0 - u, u, 6.0 * u * (1.0 - u))  # of the velocity between two samples
    for k in (1, 2, 3):
        time, stiffness = numbers[f"maxwell_{k}.relaxation_time"], numbers[f"maxwell_{k}.stiffness"]
        fading = np.exp(-DT * (1.0 - u)[:, None] / time)
        rows += [np.exp(-DT / time), *(stiffness * ((weight * shape) @ fading) for shape in shapes)]
    return np.array(rows)


def _motion(sweep: Sweep, numbers: Mapping[str, float]) -> tuple[Array, ...]:
    x, v, _ = sweep.path(sweep.time)
    before, v_before = np.concatenate([x[:1], x[:-1]]), np.concatenate([v[:1], v[:-1]])
    bow = (x - before) / DT - 0.5 * (v + v_before)
    found = strokes(sweep)
    way = np.concatenate([ways for _, ways, _, _ in found])
    factor = PchipInterpolator(FACTOR_AT, [numbers[f"damping.scale[{k}]"] for k in range(FACTOR_AT.size)])
    held = factor(np.clip(x, FACTOR_AT[0], FACTOR_AT[-1]))
    motion = np.ascontiguousarray(np.stack([way, v_before, v, bow, held * v], axis=1))
    motion[0, 1:4] = 0.0  # nothing is remembered when the record begins
    static = PchipInterpolator(KNOTS, [numbers[f"stiffness.stiffness[{k}]"] for k in range(KNOTS.size)])(x)
    first = np.array([*(here.start for *_, here in found), x.size], dtype=np.int64)
    return static, motion, first, np.array([side for side, *_ in found]), np.array([whole for _, _, whole, _ in found])
