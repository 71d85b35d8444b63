"""The posterior of a fit: what data and priors together tell of the parameters, drawn by an ensemble sampler.

With misfits r in N, what a sample counts for e (see ``prior``) and the densities of the priors p, the logarithm of the
posterior is, up to a constant,

    - sum of r^2 / (2 e^2) + sum of log p ,

within the bounds, and flat there in the coordinates of the fit for a parameter without a prior.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from dashpot.fit.algebra import single_threaded_algebra
from dashpot.fit.chains import at_rest
from dashpot.fit.coordinates import Coordinates, search_coordinates
from dashpot.fit.kept_curves import kept_curves
from dashpot.fit.known import known_numbers
from dashpot.fit.objective import Objective
from dashpot.fit.order import in_order, interchangeable
from dashpot.fit.prior import beside_priors, priors_of
from dashpot.fit.scored import ScoredRun
from dashpot.fit.uncertainty import effective_error
from dashpot.kernel.network import compile_network
from dashpot.model.network import NetworkSpec
from dashpot.text.problem import InputError, Place, nearest

if TYPE_CHECKING:
    from dashpot.fit.result import FitResult

Array = NDArray[np.float64]

SAMPLERS = ("emcee",)
STEPS = 10_000  # at most, unless told otherwise
FEWEST_STEPS = 100
FEWEST_WALKERS, WALKERS_EACH = 32, 4  # in all; for each parameter
FIRST_LOOK, LOOKS = 400, 1.3  # steps after which convergence is looked at first, and by what factor later
DISCARDED = 0.25  # of the steps, at the beginning
TIMES = 50.0  # autocorrelation times that a converged chain has at least
R_HAT = 1.05  # of a converged chain at most; halves of 25 autocorrelation times alone give 1.02
HALVINGS = 40  # of the distance of a walker from the fit, until its start is likely enough
WIDEST = 0.25  # of the range of a parameter: the deviation of the starts
NARROWEST = 1e-3  # of the intervals: how far walkers are apart at least, in every direction
JUMPS = 0.1  # of the steps are as long as the distance of two walkers


@dataclass(frozen=True)
class Marginal:
    """What a posterior tells of one number: median, the 95 % interval between ``low`` and ``high``, all in SI.

    ``r_hat``, the ``effective`` number of draws and the autocorrelation ``time`` in steps are those of ``chains``.
    """

    path: str
    unit: str
    median: float
    low: float
    high: float
    r_hat: float
    effective: float
    time: float


@dataclass(frozen=True, eq=False)
class Posterior:
    """Draws from the posterior of a fit.

    ``draws`` (steps, walkers, n) are the numbers of ``marginals`` in SI, without the first ``discarded`` steps.
    ``acceptance`` is the share of the proposed moves that were accepted, ``error`` what a sample counts for in N. The
    numbers ``held`` have an uncertainty of their own, in which the draws do not move.
    """

    sampler: str
    marginals: tuple[Marginal, ...]
    draws: Array
    discarded: int
    acceptance: float
    error: float
    held: tuple[str, ...] = ()

    @property
    def steps(self) -> int:
        """The steps that were kept."""
        return len(self.draws)

    @property
    def converged(self) -> bool:
        """Whether the draws are many autocorrelation times long and R-hat is small, of every number."""
        return all(_settled(self.steps, each.r_hat, each.time) for each in self.marginals)

    @property
    def sentence(self) -> str:
        """Whether it has converged, and what to do where it has not."""
        worst = max(self.marginals, key=lambda each: each.time)
        fewest = min(each.effective for each in self.marginals)
        told = f"{fewest:.0f} effective draws or more of each parameter, R-hat up to {self.r_hat:.3f}"
        if self.converged:
            return f"the posterior converged: {told}"
        return (
            f"the posterior did not converge: {told}; the {self.steps} steps kept are {self.steps / worst.time:.0f} "
            f"autocorrelation times of {worst.path}, {TIMES:.0f} are needed: allow more steps with --sampler-steps, or "
            "drop what the data do not determine"
        )

    @property
    def r_hat(self) -> float:
        """The largest R-hat of all numbers."""
        return max(each.r_hat for each in self.marginals)

    def thinned(self, most: int) -> Array:
        """At most ``most`` draws (k, 2 + n): step, walker, numbers; steps half an autocorrelation time apart."""
        steps, walkers, _ = self.draws.shape
        fewest = -(-steps // max(most // walkers, 1))
        apart = max(round(max(each.time for each in self.marginals) / 2.0), fewest)
        taken = np.arange(steps)[::apart]
        place = np.stack(np.meshgrid(taken + self.discarded, np.arange(walkers), indexing="ij"), axis=2)
        return np.concatenate([place, self.draws[taken]], axis=2).reshape(-1, 2 + len(self.marginals))

    def as_dict(self) -> dict[str, Any]:
        """The posterior as it stands in result files, in SI."""
        return {
            "sampler": self.sampler,
            "converged": self.converged,
            "sentence": self.sentence,
            "walkers": self.draws.shape[1],
            "steps": self.steps,
            "discarded": self.discarded,
            "acceptance": self.acceptance,
            "error": self.error,
            "held": list(self.held),
            "parameters": {
                each.path: {
                    "median": each.median,
                    "interval": [each.low, each.high],
                    "unit": each.unit,
                    "r_hat": each.r_hat,
                    "effective_draws": each.effective,
                    "autocorrelation_time": each.time,
                }
                for each in self.marginals
            },
        }


def require_sampler(word: str, steps: int = STEPS) -> None:
    """InputError for an unknown sampler, one that is not installed (with the command for it), and too few steps."""
    if word not in SAMPLERS:
        hint = nearest(word, SAMPLERS) or f"there is: {', '.join(SAMPLERS)}"
        raise InputError.at(Place("sampler"), f"expected a sampler, got '{word}'", hint)
    if steps < FEWEST_STEPS:
        message = f"expected {FEWEST_STEPS} steps or more, got {steps}"
        raise InputError.at(Place("sampler"), message, f"the default is {STEPS}")
    try:
        import emcee  # noqa: F401
    except ImportError:
        raise InputError.at(
            Place("sampler"),
            "expected emcee for the posterior, it is not installed",
            "pip install 'dashpot[sampler]', or fit without a sampler",
        ) from None


class LogPosterior:
    """The logarithm of the posterior of a network on an objective, where a sample counts for ``error`` in N.

    Raises InputError where a sample counts for nothing: of data without any noise there is no posterior.
    """

    def __init__(self, objective: Objective, coordinates: Coordinates, spec: NetworkSpec, error: float) -> None:
        if not error > 0.0:
            message = "expected a residual, the fit has none: its posterior is a point"
            raise InputError.at(Place(spec.file), message, "fit without a sampler, or measured data")
        self.loss, self.coordinates = beside_priors(objective, spec, error), coordinates
        self.factor = -0.5 * objective.total / error**2
        self.normal_by_log, self.lognormal_straight = _changed(coordinates, spec)

    def __call__(self, points: Array) -> Array:
        """The logarithm (lanes,) of points (lanes, p), minus infinity outside of the bounds."""
        found = np.full(len(points), -np.inf)
        inside = self._inside(points)
        if inside.any():
            chosen = points[inside]
            losses = self.loss.losses(self.coordinates.to_values(chosen))
            found[inside] = self.factor * losses**2 + self._volume(chosen)
        return found

    def _inside(self, points: Array) -> NDArray[np.bool_]:
        inside = np.all((points >= self.coordinates.low) & (points <= self.coordinates.high), axis=1)
        inside &= np.all(points[:, self.lognormal_straight] > 0.0, axis=1)
        for knots in map(list, self.coordinates.rising):
            inside &= np.all(np.diff(points[:, knots]) >= 0.0, axis=1)
        return inside

    def _volume(self, points: Array) -> Array:
        # a normal density of a number searched by logarithm, and a lognormal one of one that is not, in coordinates
        straight = np.log(points[:, self.lognormal_straight])
        return np.asarray(points[:, self.normal_by_log].sum(axis=1) - straight.sum(axis=1))


def _changed(coordinates: Coordinates, spec: NetworkSpec) -> tuple[list[int], list[int]]:
    """The coordinates with normal priors of a logarithm's number, and with lognormal ones of a straight number."""
    priors = priors_of(spec)
    if priors is None:
        return [], []
    pairs = [(coordinates.paths.index(path), bool(log)) for path, log in zip(priors.paths, priors.log, strict=True)]
    by_log = [k for k, lognormal in pairs if coordinates.log[k] and not lognormal]
    return by_log, [k for k, lognormal in pairs if lognormal and not coordinates.log[k]]


@single_threaded_algebra
def sample_posterior(
    fit: FitResult,
    runs: Sequence[ScoredRun],
    *,
    sampler: str = "emcee",
    steps: int = STEPS,
    jobs: int = 1,
    progress: Callable[[float], None] = lambda done: None,
) -> Posterior:
    """Draw from the posterior of a fit to its training ``runs``, until it has converged or after so many ``steps``.

    The walkers start around the fit, as its intervals say; the seed is that of the fit. ``progress`` hears the share of
    the steps that is done. InputError as from ``require_sampler``, for a fit without searched parameters, and without a
    residual.
    """
    require_sampler(sampler, steps)
    coordinates = search_coordinates(fit.fitted)
    if not coordinates.paths:
        message = f"expected parameters to be identified, '{fit.fitted.name}' has none"
        raise InputError.at(Place(fit.fitted.file), message, "fit without a sampler")
    objective = Objective(compile_network(fit.fitted), runs, jobs)
    error = effective_error(objective, coordinates, coordinates.start, fit.noise_floor.value)
    density = LogPosterior(objective, coordinates, fit.fitted, error)
    rng = np.random.default_rng(fit.seed)

    def settled(chain: Array) -> bool:
        draws = _numbers(fit, coordinates, chain)[1]
        rest = at_rest(draws)
        return all(_settled(len(draws), *each) for each in zip(rest.r_hat, rest.time, strict=True))

    assert fit.errors_of_numbers is not None and fit.correlation is not None
    starts = scattered_starts(density, fit.errors_of_numbers, fit.correlation, rng)
    chain, acceptance = _walk(density, starts, steps, fit.seed, settled, progress)
    discarded = round(DISCARDED * len(chain))
    shown, draws = _numbers(fit, coordinates, chain[discarded:])
    return Posterior(
        sampler, _marginals(fit.fitted, shown, draws), draws, discarded, acceptance, error, _held(fit.fitted)
    )


def scattered_starts(density: LogPosterior, errors: Array, correlation: Array, rng: np.random.Generator) -> Array:
    """Where the walkers (walkers, p) start: scattered as the intervals say, nearer to the fit where unlikely.

    ``errors`` (p,) are the standard errors of the numbers in SI, ``correlation`` (p, p) theirs.
    """
    coordinates = density.coordinates
    point, size = coordinates.start, len(coordinates.paths)
    widths = np.minimum(errors / coordinates.slopes(point), WIDEST * (coordinates.high - coordinates.low))
    values, vectors = np.linalg.eigh(correlation)
    # where the data tell two numbers by their sum alone, the walkers still have to span every direction
    root = vectors * np.sqrt(np.maximum(values, NARROWEST**2))
    walkers = max(FEWEST_WALKERS, WALKERS_EACH * size)
    moves = widths * (rng.standard_normal((walkers, size)) @ root.T)
    # of a normal posterior nearly all draws are less far below the top
    least = float(density(point[None])[0]) - 2.0 * size - 8.0
    found = _mirrored(coordinates, point + moves)
    for _ in range(HALVINGS):
        unlikely = ~(density(found) >= least)
        if not unlikely.any():
            break
        moves[unlikely] /= 2.0
        found = _mirrored(coordinates, point + moves)
    return found


def _mirrored(coordinates: Coordinates, points: Array) -> Array:
    """Points (lanes, p) with what is beyond a bound mirrored at it."""
    points = coordinates.low + np.abs(points - coordinates.low)
    return coordinates.allowed(coordinates.high - np.abs(coordinates.high - points))


def _walk(
    density: LogPosterior,
    starts: Array,
    steps: int,
    seed: int,
    settled: Callable[[Array], bool],
    progress: Callable[[float], None],
) -> tuple[Array, float]:
    """The chain (steps, walkers, p) of an ensemble and the share of accepted moves.

    It ends as soon as a chain is ``settled``. Moves by differential evolution: half of the walkers, in one block, move
    along the differences between two walkers of the other half.

    Source: ter Braak, Statistics and Computing 16 (2006) 239.
    """
    import emcee

    walkers, size = starts.shape
    moves = [(emcee.moves.DEMove(), 1.0 - JUMPS), (emcee.moves.DEMove(gamma0=1.0), JUMPS)]
    ensemble = emcee.EnsembleSampler(walkers, size, density, moves=moves, vectorize=True)
    # as it is: the library would print every interruption on standard output
    ensemble.log_prob_fn = density
    begin = emcee.State(starts, random_state=np.random.RandomState(seed).get_state())
    look = min(FIRST_LOOK, steps)
    for _ in ensemble.sample(begin, iterations=steps):
        done = ensemble.iteration
        progress(done / steps)
        if done == look and done < steps:
            if settled(ensemble.get_chain(discard=round(DISCARDED * done))):
                break
            look = min(round(LOOKS * look), steps)
    return ensemble.get_chain()[:done], float(np.sum(ensemble.backend.accepted) / (walkers * done))


def _settled(steps: int, r_hat: float, time: float) -> bool:
    return bool(r_hat <= R_HAT and steps >= TIMES * time)


def _numbers(fit: FitResult, coordinates: Coordinates, chain: Array) -> tuple[list[int], Array]:
    """Which slots the chain (steps, walkers, p) moves, and their numbers (steps, walkers, n) in SI."""
    values = coordinates.to_values(chain.reshape(-1, chain.shape[2]))
    values = in_order(interchangeable(fit.declared, fit.fitted), values)
    follow = [rule.slot for rule in coordinates.derived.rules if np.ptp(values[:, rule.slot]) > 0.0]
    shown = sorted({*map(int, coordinates.which), *follow})
    return shown, values[:, shown].reshape(*chain.shape[:2], len(shown))


def _marginals(spec: NetworkSpec, shown: Sequence[int], draws: Array) -> tuple[Marginal, ...]:
    rest, slots = at_rest(draws), spec.slots()
    low, median, high = np.percentile(draws, (2.5, 50.0, 97.5), axis=(0, 1))
    return tuple(
        Marginal(
            slots[slot].path,
            slots[slot].value.unit,
            *map(float, (median[k], low[k], high[k], rest.r_hat[k], rest.effective[k], rest.time[k])),
        )
        for k, slot in enumerate(shown)
    )


def _held(spec: NetworkSpec) -> tuple[str, ...]:
    """What has an uncertainty of its own beside the free parameters: kept curves, and numbers known from elsewhere."""
    known = [each.path.partition("[")[0] for each in known_numbers(spec)]
    return tuple(dict.fromkeys([*kept_curves(spec), *known]))
