"""What an element declares by being written."""

from __future__ import annotations

import pytest
from unit.model.specimens import Elastic, Slider, Viscous

from dashpot.model.element import Curve, Element, Motion, Parameter, Response, State


def test_declarations_are_collected_in_the_order_in_which_they_stand():
    assert list(Slider.declares.parameters) == ["stiffness", "limit", "exponent"]
    assert list(Slider.declares.states) == ["force"]
    assert list(Elastic.declares.curves) == ["stiffness"]


def test_an_element_inherits_declarations_and_may_replace_them():
    class Harder(Slider):
        """With another limit and more."""

        limit = Parameter("N", "another limit", bounds=(1.0, 2.0))
        wear = State("m", "worn off")

    assert list(Harder.declares.parameters) == ["stiffness", "limit", "exponent"]
    assert Harder.declares.parameters["limit"].bounds == (1.0, 2.0)
    assert list(Harder.declares.states) == ["force", "wear"]
    assert Slider.declares.parameters["limit"].bounds == (1e-3, 1e6)


def test_the_word_of_an_element_is_the_name_of_its_module_unless_it_says_another():
    class Nameless(Element):
        """Without a word."""

        def step(self, x, z, p, dt):
            return Response(x.new)

    assert Nameless.word == "test_element"
    assert Viscous.word == "viscous"


def test_an_element_without_a_law_cannot_be_made():
    class Lawless(Element):
        """Without a step."""

    with pytest.raises(TypeError, match="abstract"):
        Lawless()


def test_the_travel_of_a_motion():
    assert Motion(1.0, 3.5, 0.0, 0.0, 0.0).travel == 2.5


def test_a_response_names_its_states():
    response = Response(2.0, force=3.0, wear=4.0)
    assert (response.force, response.states) == (2.0, {"force": 3.0, "wear": 4.0})


@pytest.mark.parametrize(
    ("over", "units"), [("m", ["N/m", "N/m^2", "N/m^3"]), ("m/s", ["N/(m/s)", "N/(m/s)^2", "N/(m/s)^3"])]
)
def test_the_coefficients_of_a_polynomial_have_their_units(over, units):
    curve = Curve(("force", "N"), ("argument", over), "a curve")
    assert [curve.coefficient_unit(power) for power in (1, 2, 3)] == units
    assert curve.slope_unit == units[0]
