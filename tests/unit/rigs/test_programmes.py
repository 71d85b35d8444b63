"""Test programmes: rates that are those of the displacement, what each programme drives, and what it refuses."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import make_interp_spline
from scipy.signal import periodogram

from dashpot import load_registry
from dashpot.contract.rig import PORT

RIGS = load_registry().rigs
SHORT = {
    "stepped_sine": {"frequencies": (2.0, 8.0), "cycles": 3, "sampling": 2000.0},
    "blocks": {"cycles": (3.0, 3.0, 3.0, 3.0), "sampling": 4000.0},
    "preload_ramp": {"duration": 3.0, "sampling": 2000.0},
    "hold": {"ramp": 0.2, "dwell": 0.5},
    "random": {"duration": 4.0, "sampling": 2000.0, "high": 20.0},
    "damper_ladder": {"velocities": (0.1, 1.0)},
    "four_post": {"duration": 4.0, "sampling": 2000.0},
}


def node_of(run):
    return next(iter(run.motion))


@pytest.mark.parametrize("word", SHORT)
def test_the_rates_are_those_of_the_displacement(word):
    for run in RIGS[word](**SHORT[word]).runs():
        path = run.motion[node_of(run)]
        spline = make_interp_spline(run.time, path.displacement, k=5)
        inner = slice(20, -20)
        # at the joints of smooth steps the third rate jumps, which a spline rounds
        speed, change = spline(run.time, 1), spline(run.time, 2)
        assert path.velocity[inner] == pytest.approx(speed[inner], abs=2e-5 * np.ptp(speed))
        assert path.acceleration[inner] == pytest.approx(change[inner], abs=2e-2 * np.ptp(change))


@pytest.mark.parametrize("word", [*SHORT, "triangles"])
def test_the_names_of_all_runs_differ_and_all_begin_and_end_at_rest(word):
    runs = RIGS[word](**SHORT.get(word, {})).runs()
    assert len({run.name for run in runs}) == len(runs)
    for run in runs:
        path = run.motion[node_of(run)]
        assert abs(path.velocity[0]) <= 1e-9 * np.ptp(path.velocity)
        assert word == "four_post" or abs(path.velocity[-1]) < 0.02 * np.ptp(path.velocity)


def test_stepped_sines_have_each_frequency_for_so_many_cycles():
    rig = RIGS["stepped_sine"](frequencies=(2.0, 8.0), amplitudes=(1e-3,), preloads=(5e-3,), cycles=4, sampling=4000.0)
    [run] = rig.runs()
    swing = run.motion[PORT].displacement - 5e-3
    rises = run.time[1:][(swing[:-1] < 0.0) & (swing[1:] >= 0.0)]
    # a cycle fades in and one out: 6 / 2 Hz + 6 / 8 Hz
    assert run.time[-1] == pytest.approx(3.75, abs=1e-3)
    assert np.diff(rises[rises < 2.9]) == pytest.approx(0.5, abs=1e-3)
    assert np.diff(rises[rises > 3.0]) == pytest.approx(0.125, abs=1e-3)
    assert np.ptp(swing) == pytest.approx(2e-3, rel=1e-4)


@pytest.mark.parametrize("spectrum, fall", [("road", 2.0), ("pink", 1.0), ("white", 0.0)])
def test_a_random_motion_has_its_spectrum_and_its_size(spectrum, fall):
    rig = RIGS["random"](
        spectrum=spectrum, rms=(2e-3,), preloads=(0.0,), low=1.0, high=20.0, duration=200.0, fade=1.0, sampling=500.0
    )
    [run] = rig.runs()
    x = run.motion[PORT].displacement
    assert x[500:-500].std() == pytest.approx(2e-3, rel=0.01)
    frequency, power = periodogram(x, 500.0)
    bands = [(1.2, 2.4), (2.4, 4.8), (4.8, 9.6), (9.6, 19.2)]
    level = [np.log2(power[(frequency >= low) & (frequency < high)].mean()) for low, high in bands]
    assert -np.diff(level) == pytest.approx(fall, abs=0.15)
    assert power[(frequency < 0.9) | (frequency > 20.1)].sum() < 1e-3 * power.sum()


def test_another_seed_is_another_road_and_the_same_one_the_same():
    roads = [RIGS["random"](seed=seed, duration=5.0).runs()[0].motion[PORT].displacement for seed in (3, 3, 4)]
    assert np.array_equal(roads[0], roads[1]) and not np.allclose(roads[0], roads[2])


def test_a_hold_rests_at_its_places():
    [run] = RIGS["hold"](places=(1e-3, 4e-3, 2e-3), ramp=0.1, dwell=1.0, sampling=1000.0).runs()
    path = run.motion[PORT]
    for place, begin in ((1e-3, 0.0), (4e-3, 1.1), (2e-3, 2.2)):
        resting = (run.time >= begin + 1e-6) & (run.time <= begin + 1.0 - 1e-6)
        assert path.displacement[resting] == pytest.approx(place, abs=1e-12)
        assert not path.velocity[resting].any()


def test_triangles_run_at_their_speeds_between_the_same_turns():
    runs = RIGS["triangles"](amplitude=2e-3, preload=10e-3, speeds=(1e-3, 50e-3)).runs()
    assert [run.kind for run in runs] == ["quasi_static", "transient"]
    for run in runs:
        path = run.motion[PORT]
        assert np.abs(path.velocity).max() == pytest.approx(run.settings["speed"], rel=1e-9)
        assert [path.displacement.min(), path.displacement.max()] == pytest.approx([8e-3, 12e-3], abs=1e-6)


def test_a_damper_ladder_reaches_its_velocities_with_one_stroke():
    for run in RIGS["damper_ladder"](amplitude=40e-3, velocities=(0.1, 0.5)).runs():
        path = run.motion[PORT]
        assert np.abs(path.displacement).max() == pytest.approx(40e-3, rel=1e-4)
        assert np.abs(path.velocity[1000:-1000]).max() == pytest.approx(run.settings["velocity"], rel=1e-6)


def test_a_preload_ramp_passes_every_preload_once():
    [run] = RIGS["preload_ramp"](low=5e-3, high=15e-3, amplitudes=(1e-3,), duration=10.0).runs()
    x = run.motion[PORT].displacement
    cycle = 100
    middle = np.convolve(x[cycle:-cycle], np.ones(cycle) / cycle, "valid")  # of whole cycles at full amplitude
    assert np.all(np.diff(middle) > -1e-9) and [middle[0], middle[-1]] == pytest.approx([5e-3, 15e-3], abs=1e-4)
    assert [x[0], x[-1]] == pytest.approx([5e-3, 15e-3]) and np.ptp(x[5000:5100]) == pytest.approx(2e-3, rel=0.1)


def test_four_posts_heave_roll_pitch_and_warp():
    nodes = {"front_left": "fl", "front_right": "fr", "rear_left": "rl", "rear_right": "rr"}
    runs = {run.notes["phase"]: run for run in RIGS["four_post"](duration=2.0, **nodes).runs()}
    signs = {
        mode: [
            np.sign(run.motion[node].displacement @ runs["heave"].motion["fl"].displacement)
            for node in ("fl", "fr", "rl", "rr")
        ]
        for mode, run in runs.items()
    }
    assert signs == {"heave": [1, 1, 1, 1], "roll": [1, -1, 1, -1], "pitch": [1, 1, -1, -1], "warp": [1, -1, -1, 1]}
    assert [run.notes["phase"] for run in RIGS["four_post"](duration=2.0).runs()] == ["heave", "roll"]


@pytest.mark.parametrize(
    "word, options, said",
    [
        ("stepped_sine", {"frequencies": (60.0,)}, "20 samples a cycle"),
        ("stepped_sine", {"cycles": 0}, "more than 0"),
        ("blocks", {"cycles": (3.0,)}, "as many frequencies and cycles as the 4"),
        ("preload_ramp", {"duration": 0.5}, "ten cycles"),
        ("hold", {"places": (1e-3,)}, "two places"),
        ("hold", {"ramp": 1e-3}, "20 samples within a ramp"),
        ("random", {"spectrum": "blue"}, "road, pink, white"),
        ("random", {"fade": 20.0}, "room at both ends"),
        ("triangles", {"speeds": (0.0,)}, "more than 0"),
        ("damper_ladder", {"amplitude": 0.0}, "more than 0"),
        ("four_post", {"rear_left": "rl"}, "two front nodes, or four"),
        ("four_post", {"front_right": "platform_left"}, "two front nodes, or four"),
    ],
)
def test_an_impossible_programme_is_refused(word, options, said):
    with pytest.raises(ValueError, match=said):
        RIGS[word](**options)
