"""Dynamic stiffness and harmonics of a specimen from sweeps and harmonic runs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields

import numpy as np

from .noise_spectrum import NoiseSpectrum, noise_between_orders
from .orders import TURN, OrderBasis, OrderFit, Windows, place_windows
from .phase import NotOscillatingError, phase_of_frequency, track_phase
from .reversals import noise_threshold, strokes
from .white_noise import white_noise

ORDERS = 7

# A window counts when the first order carries this share of the motion around its mean.
_PURITY = 0.9
_COVERED = 0.25
_STEP = 0.25
_FEWEST_PERIODS = 2.0


@dataclass(frozen=True)
class Oscillation:
    """How a specimen is moved: the orders of its phase in m windows, and the motion in each of them.

    time: s, middle of the window; frequency: Hz; sweep_rate: Hz/s; preload: m, mean displacement;
    motion: (m,) complex amplitude X1 of the displacement, m; displacement_noise: m, its white part.
    """

    orders: OrderBasis
    sample_time: float
    time: np.ndarray
    frequency: np.ndarray
    sweep_rate: np.ndarray
    preload: np.ndarray
    motion: np.ndarray
    displacement_noise: float

    @property
    def angle(self) -> np.ndarray:
        """The phase (n,) rad at every sample, NaN where the specimen does not oscillate."""
        return self.orders.angle

    @property
    def envelope(self) -> np.ndarray:
        """Amplitude of the displacement at every sample (n,), m."""
        return np.interp(np.arange(len(self.angle)) * self.sample_time, self.time, np.abs(self.motion))


@dataclass(frozen=True, repr=False)
class DynamicStiffness:
    """Complex stiffness and harmonics of a force over m windows.

    time s, frequency Hz, sweep_rate Hz/s, amplitude m, preload m (mean displacement);
    storage K' and loss K'' N/m, of K* = F1 / X1;
    sine, cosine: (m, 7) N, a_k and b_k of r = r0 + sum a_k sin k theta + b_k cos k theta with x = x0 + X sin theta,
    NaN above the Nyquist frequency; offset: r0 N;
    noise: N, standard deviation of what the orders leave; confidence: N/m, standard deviation of K' and of K''.
    periods: length of a window, step: distance of windows, both in periods.
    """

    time: np.ndarray
    frequency: np.ndarray
    sweep_rate: np.ndarray
    amplitude: np.ndarray
    preload: np.ndarray
    storage: np.ndarray
    loss: np.ndarray
    sine: np.ndarray
    cosine: np.ndarray
    offset: np.ndarray
    noise: np.ndarray
    confidence: np.ndarray
    periods: float
    step: float

    def __repr__(self) -> str:
        if not len(self):
            return "DynamicStiffness: no windows"
        low, high, middle = self.frequency.min(), self.frequency.max(), np.median(self.magnitude)
        return f"DynamicStiffness: {len(self)} windows, {low:.3g} to {high:.3g} Hz, median |K*| {middle:.4g} N/m"

    @property
    def magnitude(self) -> np.ndarray:
        """|K*| N/m."""
        return np.hypot(self.storage, self.loss)

    @property
    def loss_angle(self) -> np.ndarray:
        """Phase of K* rad."""
        return np.arctan2(self.loss, self.storage)

    def independent(self, windows: np.ndarray) -> np.ndarray:
        """How many windows without overlap would say as much as so many next to one another."""
        return 1.0 + (windows - 1) * 1.5 * self.step / self.periods

    def select(self, chosen: np.ndarray) -> DynamicStiffness:
        """The windows named by a mask or by numbers."""
        return self.with_columns({name: getattr(self, name)[chosen] for name in self.columns()})

    def with_columns(self, columns: Mapping[str, np.ndarray]) -> DynamicStiffness:
        """The same with other values in every field that holds a value per window."""
        return DynamicStiffness(**columns, periods=self.periods, step=self.step)

    @classmethod
    def columns(cls) -> tuple[str, ...]:
        """Names of the fields that hold a value per window."""
        return tuple(field.name for field in fields(cls) if field.name not in ("periods", "step"))

    def __len__(self) -> int:
        return len(self.time)


def dynamic_stiffness(
    displacement: np.ndarray,
    force: np.ndarray,
    sample_time: float,
    frequency: np.ndarray | None = None,
    periods: float = 4.0,
) -> DynamicStiffness:
    """Dynamic stiffness over a sweep or a harmonic run of displacement (n,) m and force (n,) N.

    `frequency` (n,) Hz is the law of the run if it is known; else the phase is followed in the displacement.
    Windows are `periods` long (3 to 6; shorter runs take what they have) and a quarter period apart.

    In a sweep K* is off by -j (beta / 2) (d2 K* / d omega2) with beta = d omega / dt, with opposite sign in the other
    direction: see `average_directions`. Raises NotOscillatingError when the motion has no phase to follow.
    """
    return harmonics_of(force, follow(displacement, sample_time, frequency, periods))


def follow(
    displacement: np.ndarray, sample_time: float, frequency: np.ndarray | None = None, periods: float = 4.0
) -> Oscillation:
    """Follow the oscillation in a displacement (n,) m; see `dynamic_stiffness`."""
    angle = track_phase(displacement) if frequency is None else phase_of_frequency(frequency, sample_time)
    windows = _longest_windows(angle, periods)
    turning = np.gradient(np.nan_to_num(angle)) / (TURN * sample_time)
    orders = OrderBasis.of(angle, windows, ORDERS)
    fit = orders.fit(np.column_stack([displacement, turning]), ORDERS)
    pure = _purity(fit) >= _PURITY
    if not _covers(pure, np.abs(fit.harmonics[:, 0, 0]), windows, displacement):
        raise NotOscillatingError(
            "expected a sweep or a harmonic motion, got one whose first order carries less than "
            f"{_PURITY:.0%} of it nearly everywhere; leave the run out of order tracking, or give its frequency law"
        )
    return Oscillation(
        orders=orders.select(pure),
        sample_time=sample_time,
        time=fit.middle[pure] * sample_time,
        frequency=fit.mean[pure, 1],
        sweep_rate=fit.slope[pure, 1] / sample_time,
        preload=fit.mean[pure, 0],
        motion=fit.harmonics[pure, 0, 0],
        displacement_noise=white_noise(displacement),
    )


def harmonics_of(signal: np.ndarray, oscillation: Oscillation, confident: bool = True) -> DynamicStiffness:
    """Stiffness and harmonics of any force signal (n,) N relative to the motion, of a measured force or of a residual.

    For a residual, storage and loss are the missing dK' and dK''. The `confidence`, for which the noise of the whole
    signal is read, is NaN where it is not asked for.
    """
    fit = oscillation.orders.fit(signal[:, None], ORDERS)
    harmonics = fit.harmonics[:, :, 0]
    stiffness = harmonics[:, 0] / oscillation.motion
    lead = np.angle(1j * oscillation.motion)
    turned = harmonics * np.exp(-1j * np.outer(lead, np.arange(1, ORDERS + 1)))
    magnitude = np.abs(stiffness)
    return DynamicStiffness(
        time=oscillation.time,
        frequency=oscillation.frequency,
        sweep_rate=oscillation.sweep_rate,
        amplitude=np.abs(oscillation.motion),
        preload=oscillation.preload,
        storage=stiffness.real,
        loss=stiffness.imag,
        sine=-turned.imag,
        cosine=turned.real,
        offset=fit.mean[:, 0],
        noise=np.sqrt(fit.variance[:, 0]),
        confidence=_confidence(signal, oscillation, fit, magnitude) if confident else np.full_like(magnitude, np.nan),
        periods=oscillation.orders.windows.periods,
        step=oscillation.orders.windows.step,
    )


def read_noise(signal: np.ndarray, oscillation: Oscillation) -> NoiseSpectrum | None:
    """Spectrum of the noise on a signal (n,) between the orders of the motion; None when the run is too short."""
    return noise_between_orders(signal, oscillation.angle, oscillation.envelope, oscillation.sample_time)


def _longest_windows(angle: np.ndarray, periods: float) -> Windows:
    while len(windows := place_windows(angle, periods, _STEP)) == 0:
        if periods <= _FEWEST_PERIODS:
            raise NotOscillatingError(
                "expected at least two periods of oscillation, got fewer; measure longer, or leave the run out"
            )
        periods = max(_FEWEST_PERIODS, periods - 0.5)
    return windows


def _purity(fit: OrderFit) -> np.ndarray:
    power = np.abs(fit.harmonics[:, :, 0]) ** 2
    return power[:, 0] / (np.nansum(power, axis=1) + 2.0 * fit.variance[:, 0])


def _covers(pure: np.ndarray, amplitude: np.ndarray, windows: Windows, displacement: np.ndarray) -> bool:
    """Whether pure windows see a fair part of the way travelled, which a random motion grants them by chance only."""
    if not pure.any():
        return False
    periods = windows.step * (np.sum(pure) - 1) + windows.periods
    way = np.sum(strokes(displacement, noise_threshold(displacement)))
    return bool(4.0 * periods * np.mean(amplitude[pure]) >= _COVERED * way)


def _confidence(signal: np.ndarray, oscillation: Oscillation, fit: OrderFit, magnitude: np.ndarray) -> np.ndarray:
    """sigma_n sqrt(2 / N_w) / |X1|, with the density of the noise at the excited frequency, as noise has a colour."""
    spectrum = read_noise(signal, oscillation)
    noise = np.sqrt(fit.variance[:, 0]) if spectrum is None else spectrum.white_equivalent(oscillation.frequency)
    both = np.hypot(noise, magnitude * oscillation.displacement_noise)
    return both * np.sqrt(2.0 / fit.samples) / np.abs(oscillation.motion)
