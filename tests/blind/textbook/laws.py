"""Forces and faults as textbooks write them, by the cause word they stand for.

A law gives the force of a record at size one; a size has no meaning but in proportion, save for the fault `delay`,
where it is the time in s, and for `clipping`, which is done to the measured force and has no law here.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.interpolate import make_interp_spline
from scipy.signal import cont2discrete, fftconvolve, lfilter
from scipy.special import erf

from .memory import bouc_wen, maxwell, slider
from .motion import derivative
from .record import Circumstances, Record

Law = Callable[[Record, Circumstances], np.ndarray]
RINGING_STEPS = 16
DELAY, CLIPPING = "delay", "clipping"


def coulomb(run: Record, case: Circumstances) -> np.ndarray:
    """tanh(v/v_c)."""
    return np.tanh(run.velocity / (0.02 * case.rig.speed))


def jenkins(run: Record, case: Circumstances) -> np.ndarray:
    """A spring in series with a slider."""
    return slider(run.displacement, 0.15 * case.rig.amplitude)


def hysteretic(run: Record, case: Circumstances) -> np.ndarray:
    """Bouc-Wen."""
    return bouc_wen(run.displacement, 0.3 * case.rig.amplitude)


def load_on_rubber(run: Record, case: Circumstances) -> np.ndarray:
    """mu |F| tanh(v/v_c)."""
    return np.abs(run.force) * coulomb(run, case)


def load_by_deflection(run: Record, case: Circumstances) -> np.ndarray:
    """A normal force that grows with deflection."""
    return (run.displacement - min(case.rig.preloads) + 0.5 * case.rig.amplitude) * coulomb(run, case)


def stribeck(run: Record, case: Circumstances) -> np.ndarray:
    """tanh(v/v_c) (0.4 + 0.6 exp(-(v/v_s)^2))."""
    fall = np.exp(-((run.velocity / (0.6 * case.rig.speed)) ** 2))
    return np.tanh(run.velocity / (0.01 * case.rig.speed)) * (0.4 + 0.6 * fall)


def relaxing(run: Record, case: Circumstances) -> np.ndarray:
    """One relaxation time in the middle of the band."""
    return maxwell(run.displacement, 1.0 / case.rig.pulsation, case.rig.rate)


def relaxing_twice(run: Record, case: Circumstances) -> np.ndarray:
    """Two relaxation times, a factor of 7.5 apart."""
    slow, fast = 2.5 / case.rig.pulsation, 1.0 / (3.0 * case.rig.pulsation)
    return maxwell(run.displacement, slow, case.rig.rate) + 0.7 * maxwell(run.displacement, fast, case.rig.rate)


def many_sliders(run: Record, case: Circumstances) -> np.ndarray:
    """Seven sliders from 0.03 to 4 amplitudes: Iwan."""
    return sum(slider(run.displacement, reach * case.rig.amplitude) for reach in np.geomspace(0.03, 4.0, 7))


def squared(run: Record, case: Circumstances) -> np.ndarray:
    """v |v|."""
    return run.velocity * np.abs(run.velocity)


def rooted(run: Record, case: Circumstances) -> np.ndarray:
    """sgn(v) |v|^0.5."""
    return np.sign(run.velocity) * np.sqrt(np.abs(run.velocity))


def one_sided(run: Record, case: Circumstances) -> np.ndarray:
    """max(v, 0)."""
    return np.maximum(run.velocity, 0.0)


def bilinear(run: Record, case: Circumstances) -> np.ndarray:
    """x v, from where the sweeps reach least."""
    return (run.displacement - min(case.rig.preloads) + max(case.rig.amplitudes)) * run.velocity


def mass(run: Record, case: Circumstances) -> np.ndarray:
    """a."""
    return run.acceleration


def ringing(run: Record, case: Circumstances) -> np.ndarray:
    """The force on a mass on a lightly damped spring, foot driven."""
    return _oscillator(run.acceleration, case.pitch * case.rig.band[1], 0.05, case.rig.rate)


def tuned(run: Record, case: Circumstances) -> np.ndarray:
    """A well damped absorber in the middle of the band."""
    return _oscillator(run.acceleration, 0.5 * case.rig.band[1], 0.15, case.rig.rate)


def stop(run: Record, case: Circumstances) -> np.ndarray:
    """A second spring beyond a gap."""
    gap = max(case.rig.preloads) + 0.5 * max(case.rig.amplitudes)
    return np.maximum(run.displacement - gap, 0.0)


def progressive_stop(run: Record, case: Circumstances) -> np.ndarray:
    """(x - gap)^3."""
    gap = max(case.rig.preloads) + 0.3 * max(case.rig.amplitudes)
    return np.maximum(run.displacement - gap, 0.0) ** 3


def backlash(run: Record, case: Circumstances) -> np.ndarray:
    """What lost motion takes away from a spring."""
    return -slider(run.displacement, 0.1 * case.rig.amplitude)


def quadratic(run: Record, case: Circumstances) -> np.ndarray:
    """x^2."""
    return run.displacement**2


def cubic(run: Record, case: Circumstances) -> np.ndarray:
    """x^3."""
    return run.displacement**3


def warming(run: Record, case: Circumstances) -> np.ndarray:
    """A stiffness that falls towards another one with time."""
    return -run.force * -np.expm1(-run.time / (0.6 * case.rig.duration))


def heating(run: Record, case: Circumstances) -> np.ndarray:
    """A stiffness that falls with the work that was lost."""
    return -run.displacement * np.cumsum(run.velocity**2)


def ogden_roxburgh(run: Record, case: Circumstances) -> np.ndarray:
    """k x erf((W_max - W)/(m + beta W_max)), lost."""
    energy = 0.5 * run.displacement**2
    largest = np.maximum.accumulate(energy)
    return -run.displacement * erf((largest - energy) / (0.1 * np.max(energy) + 0.1 * largest))


def logarithmic(run: Record, case: Circumstances) -> np.ndarray:
    """lg(1 + t/0.3 s) after every change of deflection, the first from rest."""
    changes = np.diff(run.displacement, prepend=0.0)
    return -fftconvolve(changes, np.log10(1.0 + run.time / 0.3))[: changes.size]


def settling(run: Record, case: Circumstances) -> np.ndarray:
    """x_0 lg(1 + t/0.5 s) of the preload; the quasi-static loop starts without."""
    return -np.nan_to_num(run.preload) * np.log10(1.0 + run.time / 0.5)


def gain(run: Record, case: Circumstances) -> np.ndarray:
    """In some runs the force is too large in proportion."""
    return run.force * (run.name in case.spoiled)


def offset(run: Record, case: Circumstances) -> np.ndarray:
    """In some runs the force is too large."""
    return np.full(run.time.size, float(run.name in case.spoiled))


def drift(run: Record, case: Circumstances) -> np.ndarray:
    """In some runs the zero moves evenly."""
    return run.time * (run.name in case.spoiled)


def hum(run: Record, case: Circumstances) -> np.ndarray:
    """50 Hz in all runs."""
    return np.sin(2 * np.pi * 50.0 * run.time + case.phase)


def late(run: Record, case: Circumstances) -> np.ndarray:
    """The change of force per second by which it comes late, to first order."""
    return -derivative(run.force, case.rig.rate)


def delayed(run: Record, seconds: float) -> np.ndarray:
    """What a delay adds to the force, exactly."""
    return make_interp_spline(run.time, run.force, k=5)(run.time - seconds) - run.force


def _oscillator(acceleration: np.ndarray, frequency: float, damping: float, rate: float) -> np.ndarray:
    pulsation = 2 * np.pi * frequency
    fine = np.linspace(0, acceleration.size - 1, (acceleration.size - 1) * RINGING_STEPS + 1)
    driven = np.interp(fine, np.arange(acceleration.size), acceleration)
    system = ([pulsation**2], [1.0, 2 * damping * pulsation, pulsation**2])
    above, below, _ = cont2discrete(system, 1.0 / (rate * RINGING_STEPS), method="foh")
    return lfilter(np.squeeze(above), below, driven)[::RINGING_STEPS]


# in the order in which they are hidden: first the specimen, then the channel, which spoils all the rest
LAWS: dict[str, tuple[Law, ...]] = {
    "friction": (coulomb, jenkins, hysteretic),
    "load_dependent_friction": (load_on_rubber, load_by_deflection),
    "velocity_dependent_friction": (stribeck,),
    "relaxation": (relaxing, relaxing_twice),
    "amplitude_softening": (many_sliders,),
    "quadratic_damping": (squared,),
    "power_law_damping": (rooted,),
    "asymmetric_damping": (one_sided,),
    "preload_dependent_damping": (bilinear,),
    "moving_mass": (mass,),
    "resonance": (ringing, tuned),
    "end_stop": (stop, progressive_stop),
    "clearance": (backlash,),
    "stiffness_curve": (quadratic, cubic),
    "softening": (warming, heating),
    "bedding_in": (ogden_roxburgh,),
    "creep": (logarithmic, settling),
    "gain": (gain,),
    "offset": (offset,),
    "drift": (drift,),
    "hum": (hum,),
    DELAY: (late,),
}
KINDS = (*LAWS, CLIPPING)
