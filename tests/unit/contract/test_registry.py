"""Plugins come in with their origin; broken ones are named and set aside, and the rest works."""

from __future__ import annotations

import pytest

from dashpot.contract import registry as registry_module
from dashpot.contract.origin import Origin
from dashpot.contract.registry import Registry, allow_only, build_registry, load_registry
from dashpot.text.problem import InputError

GOOD = """
    from dashpot import Element, Parameter, Response, hookimpl

    class Gum(Element):
        "A spring that somebody else wrote."
        word = "gum"
        stiffness = Parameter("N/m", "slope")

        def step(self, x, z, p, dt):
            return Response(p.stiffness * x.new)

    @hookimpl
    def dashpot_elements():
        return [Gum]
"""

BROKEN = {
    "raises on import": ("raise OSError('no such device')", "cannot be loaded: OSError: no such device"),
    "misses a module": (
        "import nowhere_to_be_found",
        "cannot be loaded: ModuleNotFoundError: No module named 'nowhere",
    ),
    "is not Python": ("def (:", "cannot be loaded: SyntaxError"),
    "leaves the process": ("raise SystemExit(5)", "cannot be loaded: SystemExit: 5"),
    "misspells a hook": (
        "from dashpot import hookimpl\n@hookimpl\ndef dashpot_element(): return []",
        "cannot be loaded: PluginValidationError: unknown hook 'dashpot_element'",
    ),
    "wants arguments": (
        "from dashpot import hookimpl\n@hookimpl\ndef dashpot_elements(more): return []",
        "cannot be loaded: PluginValidationError",
    ),
    "raises when called": (
        "from dashpot import hookimpl\n@hookimpl\ndef dashpot_elements(): return [1 / 0]",
        "failed in dashpot_elements(): ZeroDivisionError: division by zero",
    ),
    "gives no list": (
        "from dashpot import hookimpl\n@hookimpl\ndef dashpot_elements(): return 7",
        "gave 7 in dashpot_elements(), expected a list of classes",
    ),
    "gives no class": (
        "from dashpot import hookimpl\n@hookimpl\ndef dashpot_elements(): return ['gum']",
        "gave 'gum' in dashpot_elements(), expected a class derived from dashpot.model.element.Element",
    ),
    "gives another class": (
        "from dashpot import hookimpl\n@hookimpl\ndef dashpot_elements(): return [dict]",
        "expected a class derived from dashpot.model.element.Element",
    ),
    "leaves the law unwritten": (
        "from dashpot import Element, hookimpl\nclass Gum(Element): pass\n"
        "@hookimpl\ndef dashpot_elements(): return [Gum]",
        "gave Gum, which leaves step() unwritten",
    ),
    "has no usable word": (
        "from dashpot import Element, hookimpl\nclass Gum(Element):\n    word = 'my gum'\n"
        "    def step(self, x, z, p, dt): ...\n@hookimpl\ndef dashpot_elements(): return [Gum]",
        "gave Gum with the word 'my gum', expected small letters, digits and '_'",
    ),
    "has no meanings of its options": (
        "from dashpot import Reader, hookimpl\nclass Bench(Reader):\n"
        "    word, suffixes, options = 'bench', (), ('skip',)\n"
        "    def read(self, path, options): ...\n@hookimpl\ndef dashpot_formats(): return [Bench]",
        "gave Bench with the options ('skip',), expected the meaning of each key as a text",
    ),
}


def test_a_thing_is_found_by_its_word_and_knows_its_origin(install):
    found = build_registry(install("good", GOOD))
    assert found.elements["gum"].__name__ == "Gum"
    assert found.origin("elements", "gum") == Origin("good", "dist_of_good", "1.5")
    assert found.plugins == (Origin("good", "dist_of_good", "1.5"),)
    assert found.faults == ()


@pytest.mark.parametrize("source, message", BROKEN.values(), ids=BROKEN)
def test_a_broken_plugin_is_named_and_the_rest_works(install, source, message):
    install("broken", source)
    found = build_registry(install("good", GOOD))
    assert list(found.elements) == ["gum"]
    [fault] = found.faults
    assert fault.origin == Origin("broken", "dist_of_broken", "1.5")
    assert str(fault).startswith("plugin broken (dist_of_broken 1.5) ")
    assert message in fault.message


def test_the_fault_of_a_plugin_says_where_it_was_raised(install):
    found = build_registry(install("broken", "x = 1\n\nraise ValueError('bad')\n"))
    assert found.faults[0].message.endswith("broken.py:3)")


def test_a_plugin_whose_module_is_gone_is_named(install):
    found = build_registry(install("gone", None))
    assert "No module named 'gone'" in found.faults[0].message


def test_one_bad_thing_leaves_the_good_ones_of_the_same_plugin(install):
    found = build_registry(install("mixed", GOOD.replace("[Gum]", "[dict, Gum]")))
    assert list(found.elements) == ["gum"]
    assert len(found.faults) == 1


def test_a_word_given_twice_stays_with_the_first_plugin_by_name(install):
    install("zebra", GOOD)
    found = build_registry(install("ant", GOOD))
    assert found.origin("elements", "gum").plugin == "ant"
    [fault] = found.faults
    assert str(fault) == (
        "plugin zebra (dist_of_zebra 1.5) gave 'gum' in dashpot_elements(), "
        "a word already taken by plugin ant (dist_of_ant 1.5)"
    )


def test_no_foreign_plugin_takes_a_word_from_dashpots_own(install):
    install("zebra", GOOD, distribution="dashpot")
    found = build_registry(install("ant", GOOD, distribution="aardvark"))
    assert found.origin("elements", "gum").distribution == "dashpot"


def test_the_same_word_may_name_things_of_different_kinds(install):
    source = (
        GOOD.replace("Response, hookimpl", "Response, Specimen, hookimpl")
        + """
    class Block(Specimen):
        word = "gum"
        def measure(self, folder, seed): return folder

    @hookimpl
    def dashpot_specimens():
        return [Block]
    """
    )
    found = build_registry(install("both", source))
    assert found.faults == ()
    assert "gum" in found.elements and "gum" in found.specimens


def test_the_allow_list_restricts_by_plugin_name(install):
    install("broken", "raise ValueError('never imported')")
    entries = install("good", GOOD)
    assert [entry.name for entry in allow_only(" good ,", entries)] == ["good"]
    assert allow_only("", entries) == []


def test_a_name_on_the_allow_list_that_is_not_installed_is_refused_with_the_nearest(install):
    with pytest.raises(InputError, match=r"DASHPOT_PLUGINS: expected .*got 'godo'. did you mean 'good'\?"):
        allow_only("godo", install("good", GOOD))


@pytest.fixture
def fresh_load(monkeypatch):
    load_registry.cache_clear()
    yield monkeypatch
    load_registry.cache_clear()


def test_the_environment_decides_what_is_loaded(fresh_load, install):
    entries = install("good", GOOD)
    install("other", "raise ValueError('not wanted')")
    fresh_load.setattr(registry_module, "entry_points", lambda group: entries)
    fresh_load.setenv("DASHPOT_PLUGINS", "good")
    found = load_registry()
    assert isinstance(found, Registry)
    assert [origin.plugin for origin in found.plugins] == ["good"]
    assert load_registry() is found
