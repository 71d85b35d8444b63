"""Which findings are refitted: no cause crowds out the others by its forms."""

from types import SimpleNamespace

from dashpot.assess.finalists import FINALISTS, MOST_FORMS, choose_finalists

LOOK = SimpleNamespace(screen=SimpleNamespace(threshold=10.0))


def finding(word, gain):
    return SimpleNamespace(candidate=SimpleNamespace(name=(word, "")), gain=gain, merit=gain - 1.0)


def chosen(*findings):
    ordered = sorted(findings, key=lambda one: -one.merit)
    return [one.candidate.name[0] for one in choose_finalists(ordered, LOOK)]


def test_many_forms_of_one_cause_leave_room_for_others():
    forms = [finding("resonance", 1000.0 - number) for number in range(MOST_FORMS + 2)]
    assert chosen(*forms, finding("relaxation", 800.0)) == ["resonance"] * MOST_FORMS + ["relaxation"]


def test_a_form_that_explains_less_than_the_best_one_of_its_cause_is_none():
    assert (
        chosen(finding("friction", 1000.0), finding("friction", 850.0), finding("friction", 950.0)) == ["friction"] * 2
    )


def test_there_are_no_more_than_a_few_and_none_that_chance_makes():
    several = [finding(f"cause {number}", 1000.0 - number) for number in range(FINALISTS + 2)]
    assert len(chosen(*several)) == FINALISTS
    assert chosen(finding("friction", 10.5)) == []
