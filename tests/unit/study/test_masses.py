"""The answer about a mass names its model, and what the interval does not hold."""

from __future__ import annotations

from dashpot.study.masses import identified_masses, mass_sentence, mass_warnings


def model(name, train, held_out, value, moved=0.07):
    owed = [{"branch": "tire", "model": "tire_model_5", "share": 0.002, "moved": moved}]
    mass = {
        "node": "wheel",
        "parameter": "wheel.mass",
        "value": value,
        "interval": [value - 0.25, value + 0.5],
        "owed": owed,
        "owed_to_known": [{"number": "rod.mass", "unit": "kg", "interval": [0.8, 2.2], "moved": -0.05}],
    }
    return {"name": name, "rmse": {"train": train, "held_out": held_out}, "masses": [mass]}


PLAIN, MOUNT = model("plain", 20.0, 31.0, 46.2), model("mount", 21.0, 12.0, 47.4)


def test_the_model_that_errs_least_on_unseen_runs_answers():
    (mass,) = identified_masses([PLAIN, MOUNT], 9.0)
    assert (mass["value"], mass["model"], mass["interval"]) == (47.4, "mount", [47.15, 47.9])
    assert mass["others"] == [{"model": "plain", "value": 46.2, "error": 31.0}]


def test_without_held_out_runs_the_training_error_decides():
    models = [{**each, "rmse": {**each["rmse"], "held_out": None}} for each in (PLAIN, MOUNT)]
    assert identified_masses(models, 9.0)[0]["model"] == "plain"


def test_the_answer_in_words():
    (mass,) = identified_masses([PLAIN, MOUNT], 9.0)
    assert mass_sentence(mass) == (
        "wheel: 47.40 kg, 95 % interval 47.15 to 47.90 kg; from mount, "
        "which has the lowest RMSE (12 N at a noise floor of 9 N)"
    )


def test_a_stiffer_tire_and_the_other_structures_are_named_with_what_they_mean():
    (mass,) = identified_masses([PLAIN, MOUNT], 9.0)
    tire, rod, others = mass_warnings(mass)
    assert "includes 0.2 % for the force of tire" in tire
    assert "0.35 kg too small" in tire  # five times 0.07 kg, and the mass rises with the stiffness of the tire
    assert (
        rod == "wheel: the interval includes rod.mass from 0.8 kg to 2.2 kg; "
        "with 2.2 kg this mass would be 0.098 kg smaller"
    )
    assert others == "wheel: other structures give 46.20 kg with plain (31 N)"


def test_the_sense_of_the_shift_is_told():
    (mass,) = identified_masses([model("plain", 20.0, None, 46.2, moved=-0.07)], None)
    assert "0.35 kg too large" in next(mass_warnings(mass))


def test_no_mass_no_answer():
    assert identified_masses([{"name": "tire", "rmse": {"train": 1.0, "held_out": None}, "masses": []}], 1.0) == []


def test_a_mass_that_was_weighed_is_told_with_the_difference():
    weighed = {"parameter": "wheel.mass", "value": 47.5, "unit": "kg", "by": "weighed"}
    (mass,) = identified_masses([PLAIN, MOUNT], 9.0, [weighed])
    assert "47.15 to 47.90 kg, 0.2 % below the 47.50 kg weighed; from mount" in mass_sentence(mass)
    (other,) = identified_masses([MOUNT], 9.0, [{**weighed, "parameter": "hub.mass"}])
    assert other["reference"] is None
