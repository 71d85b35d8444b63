"""Diagnoses of tables of dynamic stiffness; truth: complex stiffness and describing functions in closed form."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from seeds import seed_of
from unit.steady_rows import row

from dashpot import load_registry
from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.data.steady import SAMPLES, cosine, parts_of, sine
from dashpot.diagnose.diagnose import diagnose
from dashpot.diagnose.diagnosis import Diagnosis
from dashpot.diagnose.plainest import not_shown
from dashpot.diagnose.table_rows import diagnosed as taken_of
from dashpot.diagnose.table_rows import folds_with_rows, groups_of, shown, weighed
from dashpot.diagnose.view import view_of
from dashpot.diagnose.whitening import ROW, Noise
from dashpot.fit.scored import score_run, weighted
from dashpot.model.reading import parse_network
from dashpot.text.problem import InputError
from dashpot_causes.asymmetric_damping import AsymmetricDamping
from dashpot_causes.fading_damping import FadingDamping
from dashpot_causes.offset import Offset
from dashpot_causes.viscous_damping import ViscousDamping

REGISTRY = load_registry()
STIFFNESS, DAMPING, SECOND, TIME = 2e5, 100.0, 6e4, 0.02
SOLID = parse_network(
    "format: dashpot-network/1\nname: mount\nbranches:\n"
    "  rubber: {element: spring, stiffness: {start: 1e5}}\n"
    "  oil: {element: damper, damping: {start: 30}}\n",
    REGISTRY.elements,
)
FREQUENCIES, AMPLITUDES = (1.0, 3.0, 7.0, 14.0, 25.0), (1e-4, 3e-4, 1e-3, 2e-3)
Stiffness = Callable[[float, float], complex]


def solid(frequency: float) -> complex:
    return STIFFNESS + 2j * np.pi * frequency * DAMPING


def relaxing(frequency: float, amplitude: float) -> complex:
    rate = 2j * np.pi * frequency * TIME
    return SECOND * rate / (1.0 + rate)


def slider(stiffness: float, travel: float, amplitude: float) -> complex:
    """The describing function of an ideal slider behind a spring, which yields at a travel."""
    if amplitude <= travel:
        return complex(stiffness)
    share = travel / amplitude
    angle = np.arccos(1.0 - 2.0 * share)
    return complex(stiffness / np.pi * (angle - 0.5 * np.sin(2.0 * angle) + 4j * share * (1.0 - share)))


def sliding(frequency: float, amplitude: float) -> complex:
    return slider(8e4, 2.5e-4, amplitude)


def softening(frequency: float, amplitude: float) -> complex:
    return sum(slider(1e3, float(travel), amplitude) for travel in np.geomspace(2e-5, 4e-3, 60))


def nothing(frequency: float, amplitude: float) -> complex:
    return 0j


def table(hidden: Stiffness, scatter: float = 0.005, **settings: float) -> list[Run]:
    rng, found = np.random.default_rng(seed_of(f"rows of {hidden.__name__}")), []
    for amplitude in AMPLITUDES:
        for frequency in FREQUENCIES:
            truth = solid(frequency) + hidden(frequency, amplitude)
            drawn = scatter * abs(truth) * complex(*rng.standard_normal(2))
            found.append(
                row(
                    f"t-{len(found) + 1}", frequency, amplitude, truth + drawn, scatter=scatter * abs(truth), **settings
                )
            )
    return found


def diagnosed(runs: list[Run]) -> Diagnosis:
    return diagnose(SOLID, Dataset("table", tuple(runs)), registry=REGISTRY)


@pytest.mark.parametrize(
    ("hidden", "word"), [(relaxing, "relaxation"), (sliding, "friction"), (softening, "amplitude_softening")]
)
def test_what_is_hidden_in_a_table_is_named(hidden, word):
    found = diagnosed(table(hidden))
    assert [cause.cause.word for cause in found.named] == [word]
    assert found.verdict == "explained"
    assert found.after.train < 1.25 * found.setting.floor.value < 0.2 * found.before.train
    if hidden is relaxing:
        numbers = {path.rpartition(".")[2]: entry["value"] for path, entry in found.named[0].parameters().items()}
        assert numbers["stiffness"] == pytest.approx(SECOND, rel=0.05)
        assert numbers["relaxation_time"] == pytest.approx(TIME, rel=0.1)


def test_nothing_is_named_in_a_table_of_what_the_network_says():
    found = diagnosed(table(nothing))
    assert found.verdict == "nothing_missing" and not found.named


def test_records_and_rows_are_diagnosed_together():
    rng, time = np.random.default_rng(seed_of("records beside rows")), 1e-3 * np.arange(2000)
    records = []
    for name, frequency, amplitude in (("a", 2.0, 1e-3), ("b", 12.0, 5e-4)):
        stiffness, turn = solid(frequency) + relaxing(frequency, amplitude), 2.0 * np.pi * frequency * time
        force = amplitude * (stiffness.real * np.sin(turn) + stiffness.imag * np.cos(turn))
        channels = {"displacement": amplitude * np.sin(turn), "force": force + 2.0 * rng.standard_normal(time.size)}
        records.append(Run(name, "harmonic", time, channels, group=name))
    found = diagnosed([*records, *table(relaxing)])
    assert [cause.cause.word for cause in found.named] == ["relaxation"]
    numbers = {path.rpartition(".")[2]: entry["value"] for path, entry in found.named[0].parameters().items()}
    assert numbers["stiffness"] == pytest.approx(SECOND, rel=0.05)


def test_a_few_rows_are_refused():
    with pytest.raises(InputError, match="6 rows or more, got 5"):
        diagnosed(table(nothing)[:5])


def test_of_a_network_with_nodes_records_alone_are_diagnosed():
    text = "format: dashpot-network/1\nname: two\nnodes: {a: driven, b: {mass: 2 kg}, c: ground}\nbranches:\n"
    text += "  k: {between: [a, b], element: spring, stiffness: {start: 1e5}}\n"
    text += "  d: {between: [b, c], element: spring, stiffness: {start: 1e5}}\n"
    spec, rows = parse_network(text, REGISTRY.elements), table(nothing)
    with pytest.raises(InputError, match="needs a network between two ends, 'two' has nodes"):
        diagnose(spec, Dataset("rows", tuple(rows)), registry=REGISTRY)
    time = 1e-3 * np.arange(500)
    record = Run("r", "random", time, {"displacement": time, "force": time})
    assert [run.name for run in taken_of(spec, Dataset("both", (record, *rows))).runs] == ["r"]


def test_two_values_have_the_mean_square_of_their_period():
    period = 3.0 * sine(SAMPLES) - 4.0 * cosine(SAMPLES)
    assert parts_of(period) == pytest.approx([3.0, -4.0])
    noise = Noise({"r": ROW})
    assert noise.kept("r", SAMPLES) == 2
    assert np.mean(noise.reduce("r", period) ** 2) == pytest.approx(np.mean(period**2))


def test_curves_are_left_out_together_and_few_of_them_in_bands_of_frequency():
    runs = [score_run(run) for run in table(nothing)]
    groups = groups_of(runs, {})
    by_band = {}
    for run in runs:
        by_band.setdefault(groups[run.name], []).append(run.excitation.settings)
    assert len(by_band) == 8  # four curves in two bands each
    for settings in by_band.values():
        assert len({each["amplitude"] for each in settings}) == 1
        assert max(each["frequency"] for each in settings) <= 7.0 or min(each["frequency"] for each in settings) > 7.0
    folds = folds_with_rows(runs, {})
    assert (folds.groups, len(folds.names)) == (4, 8)
    assert {number for run in runs for number in folds.parts[run.name][1]} == set(range(8))


def test_rows_weigh_by_their_scatter_and_by_the_error_on_their_curve():
    runs = [row(f"t-{k}", rate, 1e-3, 2e5 + 0j, scatter=100.0 * (1 + k)) for k, rate in enumerate((1.0, 2.0, 4.0, 8.0))]
    scored = weighted(runs)
    blank = Noise(dict.fromkeys((run.name for run in runs), ROW)).with_white({run.name: 1.0 for run in runs})
    left = {run.name: np.array([1.0, -1.0]) * 0.3 * (1 + k) for k, run in enumerate(runs)}  # three times the scatter
    deviations = [1.0 / weighed(blank, left, scored).filters[run.name][0] for run in runs]
    assert deviations == pytest.approx([0.3, 0.6, 0.9, 1.2])


def test_an_offset_is_not_shown_and_a_slope_is():
    run = score_run(row("t-1", 5.0, 1e-3, 2e5 + 0j, preload=2e-3))
    path = run.drive.displacement
    level, slope = shown(run, np.array([np.full(path.size, 7.0), 2e5 * path]))
    assert not level.any()
    assert slope == pytest.approx(2e5 * 1e-3 * sine(SAMPLES), abs=1e-9)


def test_of_laws_with_one_fundamental_the_plainest_is_tried_and_none_that_fades():
    from dashpot.diagnose.location import gather_candidates, locations_of

    runs = [score_run(run) for run in table(nothing)]
    view = view_of(SOLID, runs, REGISTRY.elements)
    causes = [AsymmetricDamping, FadingDamping, Offset, ViscousDamping]
    candidates, _ = gather_candidates(causes, locations_of(view, SOLID, None), {})
    hidden = set(not_shown(candidates, view, runs).tolist())
    tried = {
        (one.cause.word, one.suspect.form): [k not in hidden for k in range(one.columns.start, one.columns.stop)]
        for one in candidates
    }
    assert tried["asymmetric_damping", "one direction"] == [False, False]
    assert all(tried["viscous_damping", "damper"])
    assert not any(tried["fading_damping", "with time"])
    time = 1e-3 * np.arange(500)
    record = Run("r", "random", time, {"displacement": 1e-3 * np.sin(9.0 * time), "force": np.zeros(500)})
    assert not not_shown(candidates, view, [*runs, score_run(record)]).size
