"""Refits of extended networks: where they begin, and what becomes of numbers at an end of their range."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from unit.assess.rig import REGISTRY, STEP, TIME, fitted, sweep

from dashpot.assess.accepted import Accepted
from dashpot.assess.contest import Bench, Trial, admitted, try_finding, with_numbers_of
from dashpot.assess.court import Court
from dashpot.assess.finalists import form_of
from dashpot.assess.instead import part_of, plainer_form, simplified
from dashpot.assess.noise import flat_noise
from dashpot.assess.pursuit import Pursuer
from dashpot.assess.revision import Revision
from dashpot.assess.suspicion import linear_view, look_at
from dashpot.contract.cause import Cause, added_branch
from dashpot.data.dataset import Dataset
from dashpot.fit.api import prepare
from dashpot.model.reading import parse_network

TABLE = """\
format: dashpot-network/1
name: table
branches:
  stiffness:
    element: spring
    stiffness:
      deflection: [5 mm, 10 mm, 15 mm, 20 mm, 25 mm]
      force: [{start: 1 kN}, {start: 2 kN}, {start: 3 kN}, {start: 4 kN}, {start: 5 kN}]
  damping: {element: damper, damping: {start: 200 N*s/m, bounds: [20 N*s/m, 2 kN*s/m]}}
"""


def bench_of(force, rng):
    runs = [sweep(f"r{k}", a, p, rng, force, k == 3)
            for k, (a, p) in enumerate([(2e-3, 10e-3), (4e-3, 12e-3), (6e-3, 16e-3), (4e-3, 14e-3)])]  # fmt: skip
    setting = prepare(Dataset("made", tuple(runs)))
    return Bench(setting.train, REGISTRY.elements, {}, unseen=setting.held_out), setting.held_out


def softening(x, v):
    """A spring that loses a fifth of 200 N/mm while the mean square of its velocity warms it, by explicit steps."""
    warmth = np.zeros(x.size)
    for k in range(1, x.size):
        warmth[k] = warmth[k - 1] + STEP / 0.8 * ((v[k - 1] / 0.3) ** 2 - warmth[k - 1])
    return 160e3 * x + 40e3 * x / (1.0 + warmth) + 250.0 * v


def test_a_spring_that_joins_a_table_takes_its_force_over_from_it(rng):
    """Beside the numbers of the table its patch is kilonewtons off; the refit begins below the model before it."""
    bench, _ = bench_of(softening, rng)
    look = look_at(bench, fitted(bench, TABLE), [REGISTRY.causes["softening"]], None, 0)
    finding = look.screen.best
    trial = try_finding(bench, look.model, finding, look.noise, look.screen.samples)
    assert trial.gain > 0.8 * finding.gain
    (stiffness,) = [slot.value.number for slot in trial.model.fitted.slots() if slot.path == "softening.stiffness"]
    assert stiffness == pytest.approx(40e3, rel=0.3)


def test_a_weak_effect_is_refitted_though_a_tenth_of_it_is_less_than_an_element_admits(rng):
    bench, _ = bench_of(softening, rng)
    look = look_at(bench, fitted(bench, TABLE), [REGISTRY.causes["softening"]], None, 0)
    least = REGISTRY.elements["softening"].declares.parameters["stiffness"].bounds[0]
    weak = look.screen.best.scaled(5.0 * least / look.screen.best.strengths[0])
    trial = try_finding(bench, look.model, weak, look.noise, look.screen.samples)
    assert trial.failure == ""
    assert trial.gain > 0.0


def test_a_number_at_its_end_absorbs_nothing_and_starts_anew_from_the_file(rng):
    """Negative damping drives the damper to the end of its range."""
    bench, _ = bench_of(lambda x, v: 200e3 * x - 40.0 * v, rng)
    model = fitted(bench, TABLE)
    place = model.coordinates.paths.index("damping.damping")
    assert model.at_end[place]
    _, _, tangents = linear_view(bench, model)
    assert all(not rows[place].any() and rows[:place].any() for rows in tangents.values())
    assert model.revived["damping.damping"].number == 200.0
    noise = flat_noise({run.name: 4.0 for run in bench.runs})
    white = bench.fit(model.declared, model.fitted, noise)
    assert bench.revive(white, white.revived, noise).chi_square <= white.chi_square


def late(x, v):
    """A spring of 200 N/mm and a damper of 250 N s/m, shown 1.5 ms late, which is more than the damper's share."""
    return CubicSpline(TIME, 200e3 * x + 250.0 * v)(np.maximum(TIME - 1.5e-3, 0.0))


def test_a_damper_that_a_delay_has_eaten_comes_back_with_it(rng):
    bench, _ = bench_of(late, rng)
    free = TABLE.replace(", bounds: [20 N*s/m, 2 kN*s/m]", "")
    look = look_at(bench, fitted(bench, free), [REGISTRY.causes["delay"]], None, 0)
    place = look.model.coordinates.paths.index("damping.damping")
    assert look.model.at_end[place]
    finding = next(one for one in look.screen.findings if one.candidate.suspect.form == "delay")
    trial = try_finding(bench, look.model, finding, look.noise, look.screen.samples)
    found = {slot.path: slot.value.number for slot in trial.model.fitted.slots()}
    assert found["measurement.force.delay"] == pytest.approx(1.5e-3, rel=0.1)
    assert found["damping.damping"] == pytest.approx(250.0, rel=0.15)


def test_a_number_of_a_named_cause_that_was_at_its_end_before_is_not_started_anew():
    """That of the diagnosed network is, whatever was missing may have driven it there; and one that came to it now."""
    ended = dict.fromkeys(("damping.damping", "resonance.damping", "resonance.stiffness"))
    base = SimpleNamespace(revived=dict.fromkeys(("damping.damping", "resonance.damping")))
    bench = Bench((), {}, {}, given=["stiffness.stiffness", "damping.damping"])
    assert set(bench.driven(SimpleNamespace(revived=ended), base)) == {"damping.damping", "resonance.stiffness"}
    assert set(Bench((), {}, {}).driven(SimpleNamespace(revived=ended), base)) == set(ended)


def test_held_out_runs_judge_in_white_noise_where_coloured_noise_hides_a_gain(rng, monkeypatch):
    """Slow noise of 50 N that happens to grow by 1 % hides that fast errors of 2 N are gone."""
    bench, held_out = bench_of(lambda x, v: 200e3 * x, rng)
    slow = 50.0 * np.sin(2.0 * np.pi * 0.2 * TIME[-held_out[0].samples :])
    fast = 2.0 * rng.standard_normal(slow.size)
    misfits = {"before": slow + fast, "better": 1.01 * slow + 0.5 * fast, "worse": 1.01 * slow + 1.2 * fast}
    monkeypatch.setattr("dashpot.assess.court.misfits_of", lambda model, runs: [misfits[model]])
    monkeypatch.setattr("dashpot.assess.court.runs_that_show", lambda *asked: ())
    court = Court(bench, held_out, (), 0)
    for after, holds in (("better", True), ("worse", False)):
        gain = court.gain_of(*(SimpleModel(name) for name in ("before", after)))
        assert gain.value < 0.0
        assert court.holds("before", after, gain) is holds


class SimpleModel(str):
    """A name that passes for a model without mends."""

    mends = ()


SPRING = """\
format: dashpot-network/1
name: straight
branches:
  stiffness: {element: spring, stiffness: {start: 150 N/mm}}
"""


def relaxing(damping):
    """A spring of 200 N/mm, one of 60 N/mm that relaxes within 30 ms, by explicit steps, and a damper."""

    def force(x, v):
        spring = np.zeros(x.size)
        for k in range(1, x.size):
            spring[k] = spring[k - 1] + 60e3 * (x[k] - x[k - 1]) - STEP / 30e-3 * spring[k - 1]
        return 200e3 * x + spring + damping * v

    return force


@pytest.mark.parametrize("damping", [150.0, 0.0])
def test_a_branch_that_relaxes_too_fast_to_show_is_left_to_a_dashpot(rng, damping):
    """Two Maxwell branches would fit as well as one and a dashpot, but one of them would be no relaxation."""
    bench, held_out = bench_of(relaxing(damping), rng)
    causes = [REGISTRY.causes[word] for word in ("relaxation", "viscous_damping")]
    court = Court(bench, held_out, causes, 0)
    look = court.look(fitted(bench, SPRING), None)
    best = look.screen.best
    assert best.candidate.cause.word == "relaxation"
    assert len(best.atoms) > 1 or damping == 0.0
    simple = simplified(court, court.try_out(best, look), look)
    assert simple.failure == ""
    times = [slot.value.number for slot in simple.model.fitted.slots() if slot.path.endswith("relaxation_time")]
    assert len(times) == 1
    assert times[0] > 10e-3
    after = court.look(simple.model, look.noise)
    assert (after.screen.best is not None) is (damping > 0.0)


def rubbery(order, damping, stiffness):
    """A spring of 200 N/mm, a springpot with the memory of t^-order rested for 20 s, and a damper."""

    def force(x, v):
        time = STEP * np.arange(x.size + 1)
        modulus = stiffness * np.diff(time ** (1.0 - order)) / STEP * 0.02**order / (1.0 - order)
        felt = np.convolve(np.diff(x, prepend=x[0]), modulus)[: x.size]
        return 200e3 * x + felt + x[0] * stiffness * 0.02**order * (20.0 + time[1:]) ** -order + damping * v

    return force


def relaxations(rng, order, damping, stiffness=60e3):
    """Before a court the refits of both forms of relaxation, and a look at what they were found in."""
    bench, held_out = bench_of(rubbery(order, damping, stiffness), rng)
    court = Court(bench, held_out, [REGISTRY.causes[word] for word in ("relaxation", "viscous_damping")], 0)
    look = court.look(fitted(bench, SPRING), None)
    found = {one.candidate.suspect.form: one for one in look.screen.findings}
    return (
        court,
        look,
        *(simplified(court, court.try_out(found[form], look), look) for form in ("maxwell", "springpot")),
    )


def numbers_of(trial):
    return {slot.path: slot.value.number for slot in trial.model.fitted.slots()}


def test_a_springpot_explains_more_than_many_branches_and_knows_how_long_it_rested(rng):
    order = rng.uniform(0.15, 0.35)
    _, _, branches, springpot = relaxations(rng, order, 0.0)
    assert springpot.merit > branches.merit
    assert springpot.model.numbers < branches.model.numbers
    found = numbers_of(springpot)
    assert found["relaxation.order"] == pytest.approx(order, abs=0.02)
    assert found["relaxation.dwell"] == pytest.approx(20.0, rel=0.25)


def test_where_a_springpot_beside_a_dashpot_explains_more_it_takes_the_place_of_branches_that_make_up_both(rng):
    court, look, branches, springpot = relaxations(rng, rng.uniform(0.18, 0.28), 15.0, 10e3)
    assert springpot.model.numbers < branches.model.numbers
    plain = plainer_form(court, branches, [branches, springpot], look)
    assert plain.finding is springpot.finding
    left = court.look(plain.model, look.noise).screen
    dashpot = next(one for one in left.findings if one.candidate.cause.word == "viscous_damping")
    assert dashpot.merit > left.threshold and dashpot.strengths[0] == pytest.approx(15.0, rel=0.5)
    assert plainer_form(court, springpot, [branches, springpot], look) is None
    court.relevance = 0.1
    assert plainer_form(court, branches, [branches, springpot], look) is None, "a dashpot is not of that interest"


def test_branches_that_relax_each_by_itself_keep_their_place(rng):
    bench, held_out = bench_of(relaxing(0.0), rng)
    court = Court(bench, held_out, [REGISTRY.causes["relaxation"]], 0)
    look = court.look(fitted(bench, SPRING), None)
    branch, springpot = (court.try_out(one, look) for one in look.screen.findings)
    assert branch.merit > springpot.merit
    assert plainer_form(court, branch, [branch, springpot], look) is None


class Wrong(Cause):
    """A power of the velocity that is none: what it becomes beside relaxation is a plain dashpot."""

    word, kind, about, shows = "wrong", "specimen", "damping that is not straight", "in no way"

    def suspects(self, view, network):
        """A power law that says what it is only far from a power of one."""
        yield added_branch("power_law_damper", "wrong", (0.7,),
                           lambda force, power: {"force": force, "exponent": power, "reference": 0.1},
                           {"force": "N", "exponent": "1", "reference": "m/s"}, fixed=("reference",),
                           admits=lambda found: not 0.9 < found["exponent"] < 1.1)  # fmt: skip


def test_a_cause_that_turned_into_another_one_gets_its_name(rng):
    """Once the relaxation is there, its power is one."""
    bench, held_out = bench_of(relaxing(150.0), rng)
    causes = [Wrong, *(REGISTRY.causes[word] for word in ("relaxation", "viscous_damping"))]
    court = Court(bench, held_out, causes, 0)
    look, accepted = court.look(fitted(bench, SPRING), None), []
    first = look.model
    for word in ("wrong", "relaxation"):
        finding = next(one for one in look.screen.findings if one.candidate.cause.word == word).keeping([0])
        trial = try_finding(bench, look.model, finding, look.noise, look.screen.samples)
        accepted.append(Accepted(finding, trial, 0.0, None, (), base=look.model))
        look = court.look(trial.model, look.noise)
    assert not admitted(accepted[0].trial, accepted[0].base, look.model)
    revision = Revision(court, first, lambda look, explained: ())
    (one, two), after = revision.prune(accepted, look)
    assert [entry.finding.candidate.cause.word for entry in (one, two)] == ["viscous_damping", "relaxation"]
    assert after.model.chi_square == pytest.approx(look.model.chi_square, abs=20.0)
    found = {slot.path: slot.value.number for slot in after.model.fitted.slots()}
    assert found["viscous_damping.damping"] == pytest.approx(150.0, rel=0.1)
    court.effort.most = 0
    (left,), _ = revision.prune(accepted, look)
    assert left.finding.candidate.cause.word == "relaxation"


def test_numbers_of_a_branch_that_changed_its_name_are_known_where_it_is_the_only_one():
    """Without the relaxation that was named first, the second one has the name of the first."""
    suspect = SimpleNamespace(admits=lambda found: found["order"] < 0.5, stays=None)
    trial = Trial(SimpleNamespace(candidate=SimpleNamespace(suspect=suspect)), model_with("pot_2.order"), 0.0, 0.0)
    base = model_with("pot.order")
    assert not admitted(trial, base, model_with("pot.order"))
    assert admitted(trial, base, model_with("pot.order", "other.order"))
    assert not admitted(trial, base, model_with("pot_2.order"))


def model_with(*paths):
    slots = [SimpleNamespace(path=path, value=SimpleNamespace(number=0.6)) for path in paths]
    return SimpleNamespace(fitted=SimpleNamespace(slots=lambda: slots))


def heavy(x, v):
    """A spring of 200 N/mm, a mass of 2 kg and a damper."""
    return 200e3 * x + 2.0 * np.gradient(v, STEP) + 400.0 * v


def ringing(x, v):
    """A spring of 200 N/mm and 20 kg hung on a spring at 10 Hz with a damping ratio of 0.1, by explicit steps."""
    turning = 2.0 * np.pi * 10.0
    pulls, place, speed = np.zeros(x.size), x[0], v[0]
    for k in range(x.size):
        pulls[k] = turning**2 * (x[k] - place) + 0.2 * turning * (v[k] - speed)
        speed += STEP * pulls[k]
        place += STEP * speed
    return 200e3 * x + 20.0 * pulls


@pytest.mark.parametrize(("force", "apart"), [(heavy, True), (ringing, False)])
def test_a_resonance_that_makes_up_a_mass_and_a_dashpot_is_taken_apart(rng, force, apart):
    """Beyond the band of 20 Hz a damped resonance looks like both; within it, it does not."""
    bench, held_out = bench_of(force, rng)
    causes = [REGISTRY.causes[word] for word in ("resonance", "moving_mass", "viscous_damping")]
    court = Court(bench, held_out, causes, 0)
    look = court.look(fitted(bench, SPRING), None)
    resonances = [one for one in look.screen.findings if one.candidate.cause.word == "resonance"]
    pick = min if apart else max  # one far beyond the band is a mass and a dashpot: it may fit as well
    trial = pick((court.try_out(one, look) for one in resonances[:3]), key=lambda each: each.gain)
    part = part_of(court, trial, look)
    assert (part is not None) is apart
    if part:
        assert part.finding.candidate.cause.word in ("moving_mass", "viscous_damping")
        court.barred |= {form_of(one) for one in look.screen.findings if one.candidate.cause.word == "moving_mass"}
        assert part_of(court, trial, look) is None


ASTRAY = """\
format: dashpot-network/1
name: astray
branches:
  stiffness: {element: spring, stiffness: {start: 150 N/mm}}
  relaxation: {element: maxwell, stiffness: {start: 50 N/mm}, relaxation_time: {start: 30 ms}}
"""


def test_numbers_far_from_the_file_are_astray_and_are_put_back(rng):
    """The damper of 900 N s/m makes the branch stiff and fast; put back, the spring is fitted by itself."""
    bench, _ = bench_of(relaxing(900.0), rng)
    model = fitted(bench, ASTRAY)
    assert set(model.astray) == {"relaxation.stiffness", "relaxation.relaxation_time"}
    assert fitted(bench_of(relaxing(0.0), rng)[0], ASTRAY).astray == {}
    noise = flat_noise({run.name: 4.0 for run in bench.runs})
    back = bench.put_back(model, model.astray, noise)
    found = {slot.path: slot.value.number for slot in back.fitted.slots()}
    assert found["relaxation.stiffness"] == 50e3
    assert found["relaxation.relaxation_time"] == 30e-3
    assert found["stiffness.stiffness"] == pytest.approx(200e3, rel=0.1)
    assert back.chi_square > bench.fit(model.declared, model.fitted, noise).chi_square
    assert len(back.point) == len(model.point)


def test_beside_its_cause_a_number_that_went_astray_is_found_again(rng):
    """From the numbers that the damper drove far away, and from those of the file: the better one is kept."""
    bench, held_out = bench_of(relaxing(900.0), rng)
    court = Court(bench, held_out, [REGISTRY.causes["viscous_damping"]], 0)
    look = court.look(fitted(bench, ASTRAY), None)
    pursuer = Pursuer(court, lambda what, done: None)
    plain, *_ = sorted(pursuer.refit_finalists(look, 0.0, exchange=True), key=lambda each: -each.merit)
    trial, *_ = sorted(pursuer.refit_finalists(look, 0.0), key=lambda each: -each.merit)
    assert trial.merit >= plain.merit
    assert trial.gain == pytest.approx(look.model.chi_square - trial.model.chi_square)
    found = {slot.path: slot.value.number for slot in trial.model.fitted.slots()}
    assert found["relaxation.relaxation_time"] == pytest.approx(30e-3, rel=0.2)
    assert found["viscous_damping.damping"] == pytest.approx(900.0, rel=0.1)


def test_a_network_with_fewer_branches_keeps_their_own_numbers():
    """Without the first of three relaxations the names of the others move up; their numbers go with them."""
    branch = "{{element: maxwell, stiffness: {} N/m, relaxation_time: {} s}}"
    head = "format: dashpot-network/1\nname: soft\nbranches:\n"
    three = head + "".join(f"  pot_{n}: {branch.format(n, n)}\n" for n in (1, 2, 3))
    two = head + "".join(f"  pot_{n}: {branch.format(9, 9)}\n" for n in (1, 2))
    known, fewer = (parse_network(text, REGISTRY.elements) for text in (three, two))
    found = with_numbers_of(fewer, known, {"pot_1": "pot_2", "pot_2": "pot_3"})
    numbers = {slot.path: slot.value.number for slot in found.slots()}
    assert [numbers[f"pot_{n}.{key}"] for n in (1, 2) for key in ("stiffness", "relaxation_time")] == [2, 2, 3, 3]
