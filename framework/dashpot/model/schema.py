"""The JSON schema of a network file, with the elements that are installed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import get_args

from dashpot.model.branches import FOR_ALL, MAXIMUM_COPIES, NAME, WAYS
from dashpot.model.curves import FACTOR, FEWEST_KNOTS, MOST_KNOTS, SOURCES
from dashpot.model.element import Curve, Element, Parameter, Scale
from dashpot.model.identified import QUANTITIES
from dashpot.model.joints import HOLDS, WEIGHTS
from dashpot.model.prior import LAWS
from dashpot.model.reading import FORMAT, MEASUREMENT
from dashpot.model.values import Kind
from dashpot.text import schema as s
from dashpot.text.schema import Schema

NAMES = {"pattern": f"^{NAME.pattern}$"}
LAW, SERIES, PARALLEL, USE, SAME_AS = WAYS
REPEAT, ABOUT, SCALING = FOR_ALL
ENDS = {
    "between": s.pair(s.text(), "the two nodes that the branch connects, the lower one first"),
    "offset": s.part("value", "its deflection when both nodes stand at zero (m)"),
}


def network_schema(elements: Mapping[str, type[Element]]) -> Schema:
    """The schema of a network file."""
    content = s.mapping(
        {
            "format": s.choice((FORMAT,)),
            "name": s.text("the name of the network, and of result files"),
            "about": s.text("a remark for people"),
            "source": s.text("where the structure comes from"),
            "gravity": s.quantity("m/s^2", "pulls at the masses of all nodes"),
            "nodes": s.named(
                _node(),
                "what the branches connect, where there is more than two ends",
                propertyNames=NAMES,
                minProperties=1,
            ),
            "branches": {"type": "object", "minProperties": 1, "propertyNames": NAMES},
            "measurement": _measurement(),
            "identified": _identified(),
        },
        required=("format", "name", "branches"),
        dependencies={"gravity": ["nodes"]},
    )
    content |= {
        "if": {"required": ["nodes"]},
        "then": {"properties": {"branches": s.named(s.part("connected_branch"))}},
        "else": {"properties": {"branches": s.named(s.part("branch"))}},
    }
    return s.document("network", "Named branches between two ends or between nodes.", content, _parts(elements))


def _parts(elements: Mapping[str, type[Element]]) -> dict[str, Schema]:
    parts = {"value": _value(), "over": _over(), "single": _single(), "scale": _table(FACTOR)}
    for word, law in elements.items():
        for key, curve in law.declares.curves.items():
            parts[f"{word}.{key}"] = _curve(curve)
    return parts | {
        "element": _laws(elements, {}),
        "connected_element": _laws(elements, ENDS),
        "branch": _branch("element", "branch", {}),
        "connected_branch": _branch("connected_element", "branch", ENDS),
        "copied_branch": _ways("element", "copied_branch", {}),
        "connected_copied_branch": _ways("connected_element", "copied_branch", ENDS),
    }


def _branch(law: str, inner: str, ends: Mapping[str, Schema]) -> Schema:
    """A branch; a list of numbers, one for each copy, is for repeated ones."""
    copied = s.part("connected_copied_branch" if ends else "copied_branch")
    single = {"additionalProperties": s.part("single"), "properties": {"between": s.ANYTHING}}
    return s.by_key({REPEAT: copied}, {"allOf": [_ways(law, inner, ends), single]})


def _ways(law: str, inner: str, ends: Mapping[str, Schema]) -> Schema:
    common = {
        REPEAT: s.integer("so many branches of this kind", minimum=1, maximum=MAXIMUM_COPIES),
        ABOUT: s.text("a remark for people"),
        **ends,
    }
    needed = ("between",) if ends else ()
    group = s.named(s.part(inner), minProperties=1, propertyNames=NAMES)
    cases = {
        SAME_AS: s.mapping(
            {SAME_AS: s.text("the branch above whose parameters it has"), ABOUT: s.text(), **ends}, (SAME_AS, *needed)
        ),
        SERIES: s.mapping({SERIES: group, **common}, (SERIES, *needed)),
        PARALLEL: s.mapping({PARALLEL: group, **common}, (PARALLEL, *needed)),
        USE: s.mapping(
            {USE: s.text("a shipped network, or a file in the folder of this one"), "fixed": {"const": True}, **common},
            (USE, *needed),
        ),
    }
    return {"type": "object", **s.by_key(cases, s.part(law))}


def _laws(elements: Mapping[str, type[Element]], ends: Mapping[str, Schema]) -> Schema:
    cases = {word: _law(word, law, ends) for word, law in elements.items()}
    return s.by_word(LAW, cases, "the law of the branch; see `dashpot list elements`")


def _law(word: str, law: type[Element], ends: Mapping[str, Schema]) -> Schema:
    declared = law.declares
    numbers = {key: s.part(f"{word}.{key}", curve.about) for key, curve in declared.curves.items()}
    numbers |= {key: s.part("value", _told(parameter)) for key, parameter in declared.parameters.items()}
    needed = [*declared.curves, *(key for key, each in declared.parameters.items() if each.default is None)]
    keys = {
        LAW: {"const": word},
        **numbers,
        SCALING: s.part("scale", "a factor on the force over deflection"),
        REPEAT: s.integer("so many branches of this kind", minimum=1, maximum=MAXIMUM_COPIES),
        ABOUT: s.text("a remark for people"),
        **ends,
    }
    about = (law.__doc__ or "").strip().partition("\n")[0]
    return s.mapping(keys, (LAW, *needed, *(("between",) if ends else ())), about)


def _told(parameter: Parameter) -> str:
    default = "" if parameter.default is None else f"; {parameter.default:g} if left out"
    return s.in_unit(parameter.about, parameter.unit) + default


def _value() -> Schema:
    """A number: fixed, to be found, found, given by the run, or known from elsewhere."""
    found = {
        "bounds": s.pair(s.quantity(), "where it is searched"),
        "scale": s.choice(get_args(Scale), "how it is searched"),
        "interval": {
            "anyOf": [s.pair(s.quantity()), s.items(s.pair(s.quantity()))],
            "description": "how well it is known",
        },
        "over": s.part("over"),
        "prior": _prior(),
    }
    numbers = {"anyOf": [s.quantity(), s.items(s.quantity(), minItems=1)]}
    searched = s.mapping({"start": numbers, **found}, ("start",), "a parameter to be identified")
    known = s.mapping({"value": numbers, **found}, ("value",), "a parameter identified by an earlier fit")
    given = s.mapping(
        {"setting": s.text("the setting of a run that gives it"), "value": s.quantity()}, ("setting", "value")
    )
    measured = s.mapping(
        {"known": s.quantity(), "interval": s.pair(s.quantity(), "its 95 % interval")},
        ("known", "interval"),
        "a parameter known from elsewhere, not searched",
    )
    follows = s.mapping(
        {"expression": {"anyOf": [s.text(), s.items(s.text(), minItems=1)]}},
        ("expression",),
        "follows from other parameters: `0.5 * front.stiffness`",
    )
    plain = {"if": {"type": "array"}, "then": s.items(s.quantity(), minItems=1), "else": s.quantity()}
    fixed = s.mapping({"fixed": numbers, "over": s.part("over")}, ("fixed", "over"), "a parameter that is not searched")
    return s.by_key(
        {
            "setting": given,
            "known": measured,
            "fixed": fixed,
            "expression": follows,
            "value": known,
            "start": searched,
        },
        {"if": {"type": "object"}, "then": searched, "else": plain},
    )


def _prior() -> Schema:
    """What is known of a number before."""
    numbers = {"anyOf": [s.quantity(), s.items(s.quantity(), minItems=1)]}
    laws: dict[str, Schema] = {
        law: s.mapping({law: numbers, "deviation": numbers}, (law, "deviation"), f"a {law} distribution")
        for law in LAWS
    }
    return s.by_key(laws, {"type": "object", "required": [LAWS[0]]})


def _over() -> Schema:
    """What a number does over a setting, or along a channel."""
    words = {
        "setting": s.text("the setting of a run on which it depends"),
        "channel": s.text("the channel that it follows along the run; a mass or the offset of a branch takes its mean"),
    }
    place = {"at": s.quantity("", "where it has its base value")}
    ways = {
        "slope": s.mapping(
            {**words, **place, "slope": s.part("value", "what it rises by per setting")},
            ("at", "slope"),
            "along a straight line",
        ),
        "rate": s.mapping(
            {**words, **place, "rate": s.part("value", "rise of its logarithm per setting")},
            ("at", "rate"),
            "along an exponential",
        ),
        "wlf": s.mapping(
            {**words, **place, "wlf": s.items(s.part("value"), "[C1, C2]", minItems=2, maxItems=2)},
            ("at", "wlf"),
            "over a temperature, by Williams, Landel and Ferry",
        ),
        "arrhenius": s.mapping(
            {**words, **place, "arrhenius": s.part("value", "activation energy over R, K")},
            ("at", "arrhenius"),
            "over a temperature, by Arrhenius",
        ),
        "kept": s.mapping(
            {"setting": words["setting"], "kept": s.part("value", "share that is left of it at the next run")},
            ("setting", "kept"),
            "the sum over the runs before",
        ),
    }
    table = s.mapping(
        {
            **words,
            "at": s.items(s.quantity(), "growing", minItems=2),
            "factor": s.items(s.part("value"), "one for each place", minItems=2),
        },
        ("at", "factor"),
        "by factors between places",
    )
    one = {"oneOf": [{"required": [word]} for word in words]}
    return {"allOf": [s.by_key(ways, table), one]}


def _single() -> Schema:
    """Anything but a list for copies."""
    return {"not": {"anyOf": [{"type": "array"}, _listing()]}}


def _listing() -> Schema:
    """A number that is a list: for copies, or for the knots of a table."""
    listed = [{"properties": {key: {"type": "array"}}, "required": [key]} for key in ("start", "value")]
    return {"type": "object", "anyOf": listed}


def _curve(curve: Curve) -> Schema:
    powers = s.items(s.part("value"), "coefficients of the powers from the first on", minItems=1)
    cases = {"from": _data(curve)} if (curve.value[1], curve.over[1]) == ("N", "m") else {}
    cases["polynomial"] = s.mapping({"polynomial": powers}, ("polynomial",))
    cases |= {key: _table(curve) for key in (curve.over[0], curve.value[0])}
    return s.by_key(cases, s.part("value", s.in_unit("a constant slope", curve.slope_unit)))


def _data(curve: Curve) -> Schema:
    over, value = curve.over[0], curve.value[0]
    keys = {
        "from": s.choice(SOURCES, "the runs that it is taken from"),
        "knots": s.integer("of the table", minimum=FEWEST_KNOTS, maximum=MOST_KNOTS),
        "refine": s.flag("whether a fit moves it together with the other parameters"),
        **_axes(curve),
    }
    return s.mapping(keys, ("from",), dependencies={over: [value], value: [over]})


def _table(curve: Curve) -> Schema:
    return s.mapping(_axes(curve), (curve.over[0], curve.value[0]), "a table")


def _axes(curve: Curve) -> dict[str, Schema]:
    (value, unit), (over, over_unit) = curve.value, curve.over
    column = {
        "if": {"type": "array"},
        "then": s.items(s.part("value"), minItems=2),
        "else": {**_listing(), "allOf": [s.part("value")]},
    }
    return {
        over: s.items(s.quantity(), s.in_unit("growing", over_unit), minItems=2),
        value: {**column, "description": s.in_unit("an entry for each, or one that holds all", unit)},
    }


def _node() -> Schema:
    masses = {key: s.part("value", _weight(key, kind)) for key, kind in WEIGHTS.items()}
    keys = {"about": s.text(), SAME_AS: s.text("the node above whose masses it has"), "hold": s.choice(HOLDS), **masses}
    return {"if": {"type": "object"}, "then": s.mapping(keys), "else": s.choice(HOLDS)}


def _weight(key: str, kind: Kind) -> str:
    return s.in_unit(key.replace("_", " "), kind.unit)


def _identified() -> Schema:
    names = {"pattern": f"^({'|'.join(QUANTITIES)})(@.+)?$"}
    seen = s.named(
        s.pair(s.quantity()),
        "the least and the largest of the motions that were seen, e.g. speed@wheel",
        propertyNames=names,
    )
    return {"properties": {"range": seen}, "description": "where the parameters come from: written by a fit"}


def _measurement() -> Schema:
    keys = {
        path.partition(".")[2]: s.part("value", s.in_unit("of the load cell", kind.unit))
        for path, kind in MEASUREMENT.items()
    }
    sensed = {key: part for key, part in keys.items() if "." not in key}
    hum = {key.partition(".")[2]: part for key, part in keys.items() if key.startswith("hum.")}
    sensed["hum"] = s.mapping(hum, ("frequency",), "cosine * cos(2 pi f t) + sine * sin(2 pi f t), t: time of the run")
    return s.mapping(
        {"force": s.mapping(sensed)},
        about="how the load cell shows the force: "
        "min(gain * smoothed(max(force, least))(time - delay) + offset + hum, largest)",
    )
