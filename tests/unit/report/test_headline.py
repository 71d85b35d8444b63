"""The first sentence of a diagnosis says size, causes, certainty and remaining residual."""

from __future__ import annotations

import re

import pytest
from unit.report.report_samples import comparison, diagnosis, friction, relaxation

from dashpot.report.comparison import closeness, comparison_headline
from dashpot.report.grids import parameter_texts, unnamed_grid
from dashpot.report.headline import SENTENCES, beside_references, headline, short_headline
from dashpot.report.look import look_headline


def test_an_explained_error_is_named_with_its_size():
    assert headline(diagnosis()) == (
        "RMSE 61.0 N, 4.2 × the noise floor (14.5 N); "
        "76 % of it is dry friction of 41 N [38, 44], missing in the model."
    )


@pytest.mark.parametrize("verdict", SENTENCES)
@pytest.mark.parametrize("count", [0, 1, 9])
def test_a_page_begins_with_25_words_at_most(verdict, count):
    causes = [friction(title=f"dry friction that depends on the setting number {k}") for k in range(count)]
    said = short_headline(diagnosis(verdict=verdict, causes=causes))
    assert 3 < len(said.split()) <= 25 and said.endswith(".")


def test_the_short_headline_names_as_many_causes_as_there_is_room_for():
    assert short_headline(diagnosis()) == "RMSE 61.0 N, 4.2 × the noise floor; 76 % of it is dry friction."
    many = short_headline(diagnosis(causes=[friction(title=f"cause {k}") for k in range(9)]))
    assert "cause 0, cause 1" in many and many.endswith("more.") and "cause 8" not in many
    left = short_headline(diagnosis(verdict="partly_explained"))
    assert left.endswith("N remain.")


def test_the_short_headline_counts_what_is_named_apart_from_what_is_probable():
    long = "a title that is far too long to be told beside the size of the error in the few words of a headline"
    sure, probable = friction(title=long), relaxation(title=long, standing="probable")
    assert short_headline(diagnosis(causes=[sure, probable])).endswith(": 1 cause is named, 1 more is probable.")
    assert short_headline(diagnosis(causes=[sure] * 2)).endswith(": 2 causes are named.")
    assert short_headline(diagnosis(causes=[probable] * 3)).endswith(": 3 causes are probable.")
    half = [friction(title="dependence of friction on yoke"), relaxation(title=long, standing="probable")]
    assert short_headline(diagnosis(causes=half)).endswith("is dependence of friction on yoke and probably 1 more.")
    room = friction(title="dependence of velocity dependent friction and friction on yoke and pressure")
    said = short_headline(diagnosis(verdict="partly_explained", causes=[room]))
    assert said.endswith("on yoke and pressure.")


@pytest.mark.parametrize("verdict", ["explained", "nothing_missing", "unexplained"])
def test_what_may_go_of_the_diagnosed_network_is_told(verdict):
    plain = headline(diagnosis(verdict=verdict))
    told = headline(diagnosis(verdict=verdict, may_go=["maxwell_1", "friction"]))
    assert told == f"{plain} 'maxwell_1' and 'friction' of the diagnosed network may go."


def test_errors_stand_beside_what_is_explainable_and_the_noise_floor():
    told = diagnosis(explainable={"held_out": 15.1, "by": "ridge"})
    assert beside_references(told) == (
        "RMSE on held-out runs: before 61.0 N, after 14.6 N, explainable 15.1 N, noise floor 14.5 N."
    )
    bare = diagnosis(rmse={"before": {"train": 14.0}}, noise_floor=None)
    assert beside_references(bare) == "RMSE on training runs: before 14.0 N."


def test_bad_data_names_what_the_sound_runs_show():
    assert short_headline(diagnosis(verdict="bad_data")) == "The measurement is at fault first; named: dry friction."


def test_several_causes_share_the_gain():
    causes = [friction(), relaxation(accepted=True)]
    assert "dry friction of 41 N [38, 44] and relaxation of 160 ms [20, 900], missing" in headline(
        diagnosis(causes=causes)
    )


def test_a_fault_of_the_measurement_is_not_called_missing_in_the_model():
    fault = friction(cause="delay", title=None, **{"class": "measurement"}, parameters={})
    assert "is delay, a fault of the measurement." in headline(diagnosis(causes=[fault]))


def test_a_fault_and_its_rival_in_the_specimen_are_told_apart():
    rivals = {"indistinguishable_from": ["heating"], "rivals": [{"cause": "heating", "class": "specimen"}]}
    drift = friction(cause="drift", title="drift of the force channel", **{"class": "measurement"}, **rivals)
    said = headline(diagnosis(causes=[relaxation(accepted=True), drift | {"accepted": False, "standing": "probable"}]))
    assert said.endswith(
        "is relaxation of 160 ms [20, 900], missing in the model; and probably drift of the force channel, "
        "a fault of the measurement, or heating, missing in the model."
    )
    late = {"indistinguishable_from": ["delay"], "rivals": [{"cause": "delay", "class": "measurement"}]}
    said = headline(diagnosis(causes=[friction(**late)]))
    assert said.endswith("is dry friction, missing in the model, or delay, a fault of the measurement.")
    both = {"indistinguishable_from": ["offset"], "rivals": [{"cause": "offset", "class": "measurement"}]}
    said = headline(diagnosis(causes=[drift | both]))
    assert said.endswith("is drift of the force channel or offset, a fault of the measurement.")
    unknown = {"indistinguishable_from": ["x"], "rivals": []}
    said = headline(diagnosis(causes=[drift | unknown]))
    assert said.endswith("is drift of the force channel, a fault of the measurement, or x.")


def test_nothing_missing_compares_the_error_with_the_floor():
    said = headline(diagnosis(verdict="nothing_missing", causes=[], rmse={"before": {"held_out": 14.9}, "after": None}))
    assert said == "Nothing is missing: the error of 14.9 N is at the noise floor (14.5 N)."


def test_nothing_missing_tells_the_error_of_the_file_that_goes_with_it():
    """Without the branches that may go a network can be a little better than the diagnosed one."""
    rmse = {"before": {"held_out": 18.0}, "after": {"held_out": 15.1}}
    told = diagnosis(verdict="nothing_missing", causes=[], rmse=rmse, may_go=["maxwell"])
    start = "Nothing is missing: the error of 15.1 N is at the noise floor (14.5 N)."
    assert headline(told).startswith(start) and short_headline(told) == start


def test_partly_explained_says_what_is_left():
    rmse = {"before": {"held_out": 61.0}, "after": {"held_out": 27.5}}
    said = headline(diagnosis(verdict="partly_explained", rmse=rmse))
    assert "only 55 % of it is dry friction" in said
    assert said.endswith("27.5 N remain unexplained, 1.9 × the noise floor.")


def test_what_is_left_is_described():
    left = {"score": 36.0, "size": 0.2134, "what": "is a line at 48.7 Hz", "share": 0.0436}
    rmse = {"before": {"held_out": 61.0}, "after": {"held_out": 3.0}}
    partly = headline(diagnosis(verdict="partly_explained", rmse=rmse, leftover=left))
    assert "; 95 % of it is dry friction" in partly
    unexplained = headline(diagnosis(verdict="unexplained", causes=[], leftover=left))
    for said in (partly, unexplained):
        assert said.endswith("; 4.4 % of the square of the remaining residual is a line at 48.7 Hz.")
    assert "48.7" not in headline(diagnosis(verdict="unexplained", causes=[], leftover=left | {"share": 0.0}))


def test_a_run_that_departs_is_no_gap_in_the_model():
    told = diagnosis(verdict="unexplained", causes=[], apart=["a5_p30"])
    assert headline(told).endswith(": run 'a5_p30' departs from what the others show, in which nothing is missing.")
    two = diagnosis(verdict="unexplained", causes=[], apart=["a5_p30", "qs"])
    assert "runs 'a5_p30' and 'qs' depart from what the others show" in headline(two)
    assert "something is missing in the model" in headline(diagnosis(verdict="unexplained", apart=["a5_p30"]))
    rmse = {"before": {"held_out": 61.0}, "after": {"held_out": 14.5}}
    said = headline(diagnosis(verdict="partly_explained", rmse=rmse, apart=["a5_p30"]))
    assert said.endswith("; run 'a5_p30' departs from what the others show.") and "remain unexplained" not in said


def test_an_error_far_above_the_noise_is_told_so_without_a_number_of_times():
    far = {"value": 1.534e-4, "from": "residual"}
    told = diagnosis(verdict="partly_explained", noise_floor=far)
    assert headline(told).startswith("RMSE 61.0 N, far above the noise floor (0.000153 N); only 76 %")
    assert headline(told).endswith("14.6 N remain unexplained, far above the noise floor.")
    assert short_headline(told).startswith("RMSE 61.0 N, far above the noise floor; 76 % of it")
    assert closeness(61.0, 1.534e-4) == "61.0 N, far above the noise floor (0.000153 N)."
    near = diagnosis(noise_floor={"value": 0.0611, "from": "residual"})
    assert headline(near).startswith("RMSE 61.0 N, 998 × the noise floor (0.0611 N)")


def test_unexplained_tells_what_it_resembles_and_does_not_guess():
    said = headline(diagnosis(verdict="unexplained", causes=[]))
    assert said.endswith("something is missing in the model, and no known cause fits it.")
    said = headline(diagnosis(verdict="unexplained", causes=[relaxation(accepted=False)]))
    assert said.endswith(
        "no known cause fits it; it resembles relaxation, with which 14.6 N remain, 1.0 × the noise floor."
    )
    rival = relaxation(accepted=False, indistinguishable_from=["creep"])
    said = headline(diagnosis(verdict="unexplained", causes=[rival]))
    assert said.endswith(
        "no known cause fits it; it resembles relaxation or creep, with which 14.6 N remain, 1.0 × the noise floor."
    )


def test_what_an_unexplained_error_resembles_is_numbered_where_it_has_rivals():
    valve = friction(title="a valve", accepted=False, indistinguishable_from=["delay", "power_law_damping"])
    causes = [relaxation(accepted=False), valve, friction(accepted=False, indistinguishable_from=["creep"])]
    said = headline(diagnosis(verdict="unexplained", causes=causes))
    assert (
        "it resembles (1) relaxation, (2) a valve or delay or power law damping and (3) dry friction or creep, with"
        in said
    )


def test_what_is_less_likely_than_one_in_ten_is_not_what_the_error_resembles():
    """It stays in the table, with its number."""
    unlikely = friction(accepted=False, standing="resembles", presence=0.002, indistinguishable_from=["clearance"])
    other = relaxation(standing="resembles", presence=0.3)
    told = diagnosis(verdict="unexplained", causes=[other, unlikely])
    assert headline(told).endswith("; it resembles relaxation, with which 14.6 N remain, 1.0 × the noise floor.")
    assert short_headline(told).endswith("it resembles relaxation.")
    alone = diagnosis(verdict="unexplained", causes=[unlikely])
    assert headline(alone).endswith(
        "; what was added makes up for a part of the force, and nothing tells what it is, with which 14.6 N remain, "
        "1.0 × the noise floor."
    )
    assert short_headline(alone).endswith("no known cause fits.")
    open_end = diagnosis(verdict="ambiguous", causes=[unlikely])
    assert "friction" not in headline(open_end) and "nothing tells what it is." in headline(open_end)
    assert short_headline(open_end).endswith(": the cause is not identifiable from these data.")
    assert [row["cause"] for row in unnamed_grid(told).rows] == ["relaxation", "dry friction"]


def test_ambiguous_names_all_rivals():
    causes = [friction(indistinguishable_from=["relaxation"]), relaxation()]
    said = headline(diagnosis(verdict="ambiguous", causes=causes))
    assert "dry friction of 41 N [38, 44] and relaxation of 160 ms [20, 900] explain it equally well" in said


def test_a_rival_that_is_only_mentioned_is_named_too():
    causes = [friction(indistinguishable_from=["end_stop"])]
    assert "and end stop explain it equally well" in headline(diagnosis(verdict="ambiguous", causes=causes))


def test_bad_data_comes_before_any_judgement_of_the_model():
    fault = friction(cause="clipping", title=None, **{"class": "measurement"}, parameters={})
    said = headline(diagnosis(verdict="bad_data", causes=[fault, relaxation()]))
    assert said.startswith("The measurement is at fault first: clipping.")


FAULTS = [
    {"run": "n4", "kind": "polarity", "evidence": "it gives back work"},
    {"run": "n6", "kind": "unit", "evidence": "its force is 0.001 times that expected"},
    {"run": "n7", "kind": "unit", "evidence": "its force is 0.00101 times that expected"},
]


def test_runs_of_all_kinds_of_faults_are_named():
    said = headline(diagnosis(verdict="bad_data", causes=[], faults=FAULTS))
    assert said.startswith(
        "The measurement is at fault first: it gives back work (run 'n4'); "
        "its force is 0.001 times that expected (run 'n6', likewise run 'n7'). RMSE"
    )
    many = [{"run": f"r{k}", "kind": "unit", "evidence": "alike"} for k in range(9)]
    assert "alike (9 runs)." in headline(diagnosis(verdict="bad_data", causes=[], faults=many))
    look = {"faults": FAULTS, "runs": []}
    assert look_headline(look) == (
        "Run 'n4': it gives back work. Run 'n6', likewise run 'n7': its force is 0.001 times that expected."
    )


def test_the_explainable_error_of_cross_validation_is_called_so():
    told = diagnosis(rmse={"before": {"train": 14.0}}, explainable={"held_out": None, "cross_validated": 60.0})
    assert "RMSE on training runs: before 14.0 N, explainable in cross-validation 60.0 N" in beside_references(told)


@pytest.mark.parametrize("short", [False, True])
def test_without_a_noise_floor_nothing_is_said_to_be_at_it(short):
    told = diagnosis(verdict="nothing_missing", causes=[], rmse={"before": {"train": 12.0}, "after": {"train": 12.0}})
    told = {**told, "noise_floor": {"value": None, "from": None}}
    found = short_headline(told) if short else headline(told)
    assert "they support no candidate cause; the error is 12.0 N, its noise is unknown." in found


def test_a_slope_over_the_order_of_the_runs_is_per_run():
    slope = {"value": -5.2, "interval": [-7.6, -2.9], "unit": "N", "per": "run"}
    assert parameter_texts(friction(parameters={"slope": slope})) == ["slope -5 N per run [-8, -3]"]
    assert "of -5 N per run [-8, -3]" in headline(diagnosis(causes=[friction(parameters={"slope": slope})]))


def test_without_held_out_runs_the_training_error_is_quoted():
    said = headline(diagnosis(rmse={"before": {"train": 50.0, "held_out": None}, "after": {"train": 25.0}}))
    assert said.startswith("RMSE 50.0 N") and "50 % of it" in said


def test_without_a_noise_floor_none_is_invented():
    said = headline(diagnosis(noise_floor={"value": None, "from": None}))
    assert said.startswith("RMSE 61.0 N (noise floor unknown); 76 % of it")


def test_an_unknown_verdict_is_refused():
    with pytest.raises(ValueError, match="expected one of explained, .* got 'perfect'"):
        headline(diagnosis(verdict="perfect"))


def test_a_cause_without_the_extras_is_named_by_its_word():
    plain = {"cause": "end_stop", "class": "specimen", "accepted": True, "parameters": {"gap": {"value": 3.0}}}
    assert "76 % of it is end stop of 3.00, missing" in headline(diagnosis(causes=[plain]))


def test_a_comparison_names_the_closest_model():
    assert comparison_headline(comparison()) == (
        "tire_model_5 has the lowest RMSE: 14.9 N, 1.0 × the noise floor (14.5 N)."
    )
    assert comparison_headline({"models": []}) == "No model could be compared."


def test_a_cause_is_told_as_sure_as_it_is():
    sure, probable = friction(probability=0.97), relaxation(probability=0.68, standing="probable")
    said = headline(diagnosis(causes=[sure, probable]))
    assert "is dry friction of 41 N [38, 44] and probably relaxation of 160 ms [20, 900], missing" in said
    assert "dry friction and probably relaxation" in short_headline(diagnosis(causes=[sure, probable]))
    either = relaxation(probability=0.95, accepted=True, indistinguishable_from=["power_law_damping"])
    said = headline(diagnosis(verdict="partly_explained", causes=[sure, either]))
    assert "is (1) dry friction of 41 N [38, 44] and (2) relaxation or power law damping, missing" in said
    either = relaxation(standing="probable", indistinguishable_from=["power_law_damping"])
    said = headline(diagnosis(verdict="partly_explained", causes=[sure, either]))
    assert "and (2) probably relaxation or power law damping, missing" in said


def test_a_lone_cause_that_is_only_probable_is_told_so():
    probable = friction(accepted=False, standing="probable")
    said = headline(diagnosis(verdict="ambiguous", causes=[probable]))
    assert said.endswith(
        "not identifiable from these data, probably dry friction of 41 N [38, 44], missing in the model."
    )
    assert short_headline(diagnosis(verdict="ambiguous", causes=[probable])).endswith(": probably dry friction.")


def test_what_is_in_the_file_and_less_likely_than_its_rival_is_told_with_it():
    valve = friction(cause="valve", title="a valve", standing="resembles", indistinguishable_from=["delay"])
    said = headline(diagnosis(verdict="ambiguous", causes=[valve | {"accepted": False}]))
    assert said.endswith("not identifiable from these data; it resembles a valve or delay.")
    short = short_headline(diagnosis(verdict="ambiguous", causes=[valve | {"accepted": False}]))
    assert short.endswith(": not distinguishable by these data: a valve and delay.")


def test_what_an_unexplained_error_resembles_is_not_said_to_be_its_cause():
    causes = [friction(accepted=False, standing="resembles"), relaxation(standing="probable")]
    said = short_headline(diagnosis(verdict="unexplained", causes=causes))
    assert said.endswith("no known cause fits; it resembles dry friction and relaxation.")


def test_a_cause_in_several_branches_is_not_given_the_number_of_one_of_them():
    sliders = {
        "limit": {"value": 9.0, "unit": "N"},
        "stiffness": {"value": 5e3, "unit": "N/m"},
        "friction_2.limit": {"value": 50.0, "unit": "N"},
        "friction_2.stiffness": {"value": 1e3, "unit": "N/m"},
    }
    assert "is dry friction in 2 branches, missing" in headline(diagnosis(causes=[friction(parameters=sliders)]))


def test_a_cause_that_changes_numbers_of_the_network_has_no_branches_of_its_own():
    """A zero that moves by 5 N from run to run is one fault, no two branches, and its fixed start is not its size."""
    session = {
        "force.offset": {"value": 0.0, "interval": None, "unit": "N"},
        "force.offset.slope": {"value": -5.0, "interval": [-5.1, -4.9], "unit": "N"},
    }
    fault = friction(cause="drift", title=None, **{"class": "measurement"}, parameters=session)
    assert "drift, a fault" in headline(diagnosis(causes=[fault]))
    slopes = {name: {"value": 3.0, "interval": [2.0, 4.0], "unit": "N"} for name in ("a.limit.slope", "b.force.slope")}
    current = friction(cause="setting_dependence", title="dependence on a setting", parameters=slopes)
    assert "is dependence on a setting, missing" in headline(diagnosis(causes=[current]))


def test_a_fault_of_a_channel_is_one_number():
    lag = {"force.delay": {"value": 2e-3, "interval": [1e-3, 3e-3], "unit": "s"}}
    fault = friction(cause="delay", title=None, **{"class": "measurement"}, parameters=lag)
    assert "delay of 2.0 ms [1.0, 3.0], a fault" in headline(diagnosis(causes=[fault]))


@pytest.mark.parametrize(
    ("title", "told"),
    [
        ("damping with a power of the velocity", "damping with a power of the velocity (limit 40.0 N)"),
        ("the limit of a slider", "the limit of a slider (40.0 N)"),
        ("a valve that opens (digressive)", "a valve that opens (digressive; limit 40.0 N)"),
        ("relaxation (dynamic stiffening)", "relaxation (dynamic stiffening) of 40.0 N"),
        ("an end stop", "an end stop of 40.0 N"),
    ],
)
def test_a_number_is_named_behind_a_name_whose_last_word_has_another_size(title, told):
    """A form of damping that levels out at 40 N has no velocity of 40 N."""
    levelling = {"limit": {"value": 40.0, "unit": "N"}, "creep_velocity": {"value": 0.1, "unit": "m/s"}}
    assert f"is {told}, missing" in headline(diagnosis(causes=[friction(title=title, parameters=levelling)]))


def test_a_force_that_ends_at_zero_has_no_size():
    """Lift-off is a least force of nothing, which no fit has found."""
    least = {"force.least": {"value": 0.0, "interval": None, "unit": "N"}}
    assert "is lift-off, missing" in headline(diagnosis(causes=[friction(title="lift-off", parameters=least)]))


def test_a_number_that_the_data_leave_open_is_not_quoted():
    unknown = {"limit": {"value": 9.0, "interval": [1e-3, 1e6], "unit": "N", "determined": False}}
    assert "is dry friction, missing" in headline(diagnosis(causes=[friction(parameters=unknown)]))
    [told] = parameter_texts(friction(parameters=unknown))
    assert told.endswith("N [0.001, 1000000], not determined by these runs")


def test_what_is_sure_comes_before_what_cannot_be_told_apart():
    causes = [friction(gain=0.6), relaxation(accepted=True, indistinguishable_from=["delay", "friction"])]
    said = headline(diagnosis(verdict="ambiguous", causes=causes))
    assert "60 % of it is dry friction of 41 N [38, 44], missing in the model; a further part" in said
    assert "explained equally well by more dry friction, relaxation of 160 ms [20, 900] and delay;" in said


@pytest.mark.parametrize("verdict", ["explained", "partly_explained", "ambiguous"])
def test_no_share_is_negative(verdict):
    """On runs that took no part a cause may cost more than it gains."""
    causes = [friction(gain=-0.16), relaxation(accepted=True, indistinguishable_from=["delay"])]
    rmse = {"before": {"held_out": 61.0}, "after": {"held_out": 70.0}}
    told = diagnosis(verdict=verdict, causes=causes, rmse=rmse)
    for said in (headline(told), short_headline(told)):
        assert not re.search(r"-\d", said) and "15 %" not in said
    assert "; on held-out runs nothing is gained by " in headline(told)
    if verdict == "ambiguous":
        assert "by dry friction of 41 N [38, 44]; a part is explained equally well by" in headline(told)
    else:
        assert "by (1) dry friction of 41 N [38, 44] and (2) relaxation or delay" in headline(told)


def test_what_gains_nothing_is_told_as_sure_as_it_is():
    told = diagnosis(verdict="ambiguous", causes=[friction(accepted=False, standing="probable", gain=-0.1), RIVAL])
    assert "nothing is gained by what is probably dry friction of 41 N [38, 44]; a part" in headline(told)


def test_large_forces_are_given_in_kilonewtons():
    rmse = {"before": {"held_out": 56311.8}, "after": {"held_out": 25617.2}}
    said = headline(diagnosis(rmse=rmse, noise_floor={"value": 3626.0, "from": "repeats"}))
    assert said.startswith("RMSE 56.3 kN, 16 × the noise floor (3626 N)")


def test_silence_says_how_small_an_effect_it_is_about():
    """The hardest to see of all causes, in force and in its own unit."""
    limits = [
        {
            "cause": "friction",
            "title": "dry friction",
            "quantity": "limit as dahl",
            "value": 2.0,
            "unit": "N",
            "force": 1.4,
            "left": 1.3,
        },
        {
            "cause": "delay",
            "title": "delay",
            "quantity": "delay",
            "value": 45e-6,
            "unit": "s",
            "force": 9.0,
            "left": 1.2,
        },
    ]
    said = headline(diagnosis(verdict="nothing_missing", causes=[], limits=limits))
    assert "leaves 1.30 N RMS of it or more" in said
    assert "delay, from 9.00 N RMS on (delay 45.0 µs)." in said


RIVAL = relaxation(accepted=True, indistinguishable_from=["delay"])
SUSPENSION, BAR = "between wheel_left and body, likewise wheel_right and body", "between wheel_left and wheel_right"


def test_a_cause_in_a_network_with_nodes_is_told_with_its_place():
    said = headline(diagnosis(causes=[friction(place=SUSPENSION)]))
    assert f"76 % of it is dry friction of 41 N [38, 44] {SUSPENSION}, missing in the model" in said


def test_the_same_cause_at_another_place_is_a_rival():
    other = {"cause": "friction", "title": "dry friction", "place": BAR}
    cause = friction(place=SUSPENSION, indistinguishable_from=["friction"], alternatives=[other])
    said = headline(diagnosis(verdict="ambiguous", causes=[cause]))
    assert f"dry friction of 41 N [38, 44] {SUSPENSION} and dry friction {BAR} explain it equally well" in said


def test_a_cause_that_was_needed_twice_may_not_be_the_one_that_is_hidden():
    said = headline(diagnosis(verdict="partly_explained", causes=[friction(stands_in=True)]))
    assert "; dry friction had to be added twice, so the true law may be another one" in said
    assert "twice" not in headline(diagnosis(verdict="partly_explained", causes=[friction(stands_in=False)]))
