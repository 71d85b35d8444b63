"""Every number of the force channel is found by a fit, with the right Jacobian, and written with its interval."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from unit.fit.bench import DAMPING, DT, STIFFNESS, TIME, jacobian_of, network, ready

from dashpot import load_registry
from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.fit.api import fit_network, measure_errors, prepare
from dashpot.fit.scored import score_run
from dashpot.model.patch import add_measurement, fill_numbers
from dashpot.model.reading import parse_network

OMEGA = 2.0 * np.pi * np.array([3.0, 13.0])
NETWORK = """
    rubber: {element: spring, stiffness: {start: 150 N/mm}}
    oil: {element: damper, damping: {start: 500}}
"""
LAG, DELAY, COMPLIANCE, LARGEST = 6e-3, 4e-3, 8e-7, 230.0
HUM = (49.4, 9.0, -5.0)
KEYS = {
    "gain": "{start: 0.9, bounds: [0.5, 2]}",
    "offset": "{start: 1 N, bounds: [-50 N, 50 N]}",
    "delay": "{start: 1 ms, bounds: [-20 ms, 20 ms]}",
    "lag": "{start: 1 ms, bounds: [0 s, 50 ms]}",
    "largest": "{start: 200 N, bounds: [100 N, 1 kN]}",
    "compliance": "{start: 1e-8 m/N, bounds: [0 m/N, 1e-5 m/N]}",
    "hum": "{frequency: {start: 49.5 Hz, bounds: [49 Hz, 51 Hz]}, cosine: {start: 1 N}, sine: {start: 1 N}}",
}
# what the numbers above are to become, and which number of the specimen has to be known beside them
TRUTHS = {
    "gain": ({"gain": 1.2}, "rubber.stiffness"),
    "offset": ({"offset": -17.0}, ""),
    "delay": ({"delay": DELAY}, ""),
    "lag": ({"lag": LAG}, ""),
    "largest": ({"largest": LARGEST}, ""),
    "compliance": ({"compliance": COMPLIANCE}, "rubber.stiffness"),
    "hum": ({"hum.frequency": HUM[0], "hum.cosine": HUM[1], "hum.sine": HUM[2]}, ""),
}


def text(key: str, known: str = "") -> str:
    branches = NETWORK
    if known:
        branches = branches.replace("{start: 150 N/mm}", f"{STIFFNESS!r}").replace("{start: 500}", f"{DAMPING!r}")
    document = network(branches).document
    assert document is not None
    return add_measurement(document.text, key, KEYS[key])


def force(key: str, phases: np.ndarray) -> np.ndarray:
    """The steady force of spring and damper on two sines of 1 mm and 0.5 mm, as the channel shows it: closed forms."""
    stiffness = STIFFNESS + 1j * OMEGA * DAMPING
    if key == "compliance":
        stiffness = stiffness / (1.0 + COMPLIANCE * stiffness)
    if key == "lag":
        stiffness = stiffness / (1.0 + 1j * OMEGA * LAG)
    if key == "delay":
        stiffness = stiffness * np.exp(-1j * OMEGA * DELAY)
    waves = np.exp(1j * (np.outer(TIME, OMEGA) + phases)) * stiffness * np.array([1e-3, 5e-4])
    found = waves.imag.sum(axis=1)
    hum = HUM[1] * np.cos(2 * np.pi * HUM[0] * TIME) + HUM[2] * np.sin(2 * np.pi * HUM[0] * TIME)
    return {"gain": 1.2 * found, "offset": found - 17.0, "largest": np.minimum(found, LARGEST), "hum": found + hum}.get(
        key, found
    )


def measured(key: str) -> Dataset:
    rng = np.random.default_rng(5)
    runs = []
    for number, phases in enumerate(([0.3, 1.0], [2.0, -1.0], [4.0, 0.5])):
        x = (np.sin(np.outer(TIME, OMEGA) + phases) * np.array([1e-3, 5e-4])).sum(axis=1)
        channels = {"displacement": x, "force": force(key, np.array(phases)) + 0.2 * rng.normal(size=TIME.size)}
        name = f"run{number}"
        runs.append(
            Run(name, "random", DT * np.arange(TIME.size), channels, {"warm_up": 0.3}, group=name, held_out=number == 2)
        )
    return Dataset("measured", tuple(runs))


@pytest.mark.parametrize("key", KEYS)
def test_the_jacobian_is_that_of_central_differences(key):
    scored = [score_run(run) for run in measured(key).runs[:2]]
    document = parse_network(text(key), load_registry().elements).document
    _, objective, coordinates = ready(NETWORK, scored, document.text.partition("  oil:")[2].partition("\n")[2])
    residual, jacobian = jacobian_of(objective, coordinates, coordinates.start)
    assert residual == pytest.approx(objective.residuals(coordinates.to_values(coordinates.start))[0], abs=1e-9)
    # a number at the end of its range is not to be moved out of it
    for number, row in enumerate(jacobian):
        step = np.zeros(len(jacobian))
        step[number] = 1e-4 * coordinates.unit[number]
        ahead, back = (
            objective.residuals(coordinates.to_values(coordinates.start + side * step))[0] for side in (1.0, -1.0)
        )
        slope = (ahead - back) / 2e-4
        # single samples pass the end of the range within the step; late or smoothed changes follow straight lines
        wrong = np.abs(row - slope) > (2e-3 if key in ("delay", "lag") else 2e-4) * np.abs(slope).max()
        assert wrong.mean() < 0.01, coordinates.paths[number]


@pytest.mark.parametrize("key", KEYS)
def test_a_fit_finds_the_channel_and_writes_what_it_found(key):
    truth, known = TRUTHS[key]
    dataset = measured(key)
    spec = parse_network(text(key, known), load_registry().elements, "n.yaml")
    found = fit_network(spec, dataset, seed=0, registry=load_registry())
    values = {slot.path: slot.value for slot in found.fitted.slots()}
    for name, number in truth.items():
        value = values[f"measurement.force.{name}"]
        # noise of 0.2 N on 1500 samples a run
        assert value.number == pytest.approx(number, rel=5e-3), name
        assert value.interval[0] < value.number < value.interval[1]
        assert value.interval[1] - value.interval[0] < 0.05 * abs(number)
    if not known:
        assert values["rubber.stiffness"].number == pytest.approx(STIFFNESS, rel=2e-3)
    assert found.errors.held_out == pytest.approx(0.2, rel=0.1)
    # a file holds eight digits
    again = parse_network(fill_numbers(spec, found.fitted, {}), load_registry().elements)
    assert measure_errors(again, prepare(dataset, 0)).held_out == pytest.approx(found.errors.held_out, rel=1e-5)


def test_a_run_may_give_a_number_of_the_channel_by_its_settings():
    runs = [
        replace(run, settings={**run.settings, "zero": zero})
        for run, zero in zip(measured("hum").runs, (0.0, 3.0, -7.0), strict=True)
    ]
    scored = [score_run(run) for run in runs]
    _, objective, _ = ready(NETWORK, scored, "measurement: {force: {offset: {setting: zero, value: 0 N}}}\n")
    _, plain, _ = ready(NETWORK, scored)
    shown, felt = objective.forces(objective.network.start), plain.forces(plain.network.start)
    assert [float(np.ptp(one - other)) for one, other in zip(shown, felt, strict=True)] == pytest.approx([0.0] * 3)
    assert [float(np.mean(one - other)) for one, other in zip(shown, felt, strict=True)] == pytest.approx([0, 3, -7])
    ends = np.cumsum([run.samples for run in scored])[:-1]
    errors = [
        float(np.sqrt(np.mean(np.square(misfits))))
        for misfits in np.split(objective.misfits(objective.network.start)[0], ends)
    ]
    assert objective.rmse(objective.network.start)[:, 0] == pytest.approx(errors)
