"""Every format and every family of elements has its page; what stands on the pages of formats runs."""

from __future__ import annotations

import inspect
import sys
from collections import Counter

import pytest
from architecture.source import ROOT
from architecture.written import things

from dashpot.contract import hooks as declared
from dashpot_elements import FAMILIES

sys.path.insert(0, str(ROOT / "docs"))

from building import elements, formats  # noqa: E402
from building.api import hooks  # noqa: E402

FORMATS = things("formats")


def source(kind: str, name: str) -> str:
    """The written part of a page."""
    return (ROOT / "docs" / kind / f"{name}.md").read_text(encoding="utf-8")


def test_every_page_belongs_to_a_format_or_a_family():
    assert {path.stem for path in (ROOT / "docs" / "formats").iterdir()} == set(FORMATS)
    assert {path.stem for path in (ROOT / "docs" / "elements").iterdir()} == set(FAMILIES)


def test_every_element_belongs_to_one_family():
    assert Counter(word for words in FAMILIES.values() for word in words) == Counter(list(things("elements")))


@pytest.mark.parametrize("word", FORMATS)
def test_the_example_of_a_format_runs(word, tmp_path):
    text = "\n\n".join(formats.page(word, FORMATS[word], source("formats", word), tmp_path))
    made = FORMATS[word]
    assert all(f"`{suffix}`" in text for suffix in made.suffixes) and all(f"`{key}`" in text for key in made.options)
    if "The answers are left out" not in text:
        assert "<<<" not in text
        assert "written: imported/dataset.yaml" in text or "dataset.yaml: good" in text


def test_a_missing_library_leaves_the_answers_out(tmp_path):
    text = formats.played("```python\nimport no_such_library\n```\n\n```yaml\n<<< out.yaml\n```\n", tmp_path)
    assert "no_such_library was not installed" in text and "<<<" not in text


@pytest.mark.parametrize("family", FAMILIES)
def test_the_table_of_a_family_names_its_laws(family):
    text = source("elements", family)
    table = "".join(line for line in text.splitlines() if line.startswith("|"))
    assert not [word for word in FAMILIES[family] if f"`{word}`" not in table]
    assert text.startswith(f"# {elements.title(family)}")


def test_every_option_of_a_reader_is_taken_and_no_other():
    from dashpot.contract.reader import ReadingError

    for word, made in FORMATS.items():
        with pytest.raises(ReadingError, match="no file option 'nothing'"):
            made().read(ROOT / "LICENSE", {"nothing": 1})
        for key in made.options:
            assert f'"{key}"' in inspect.getsource(sys.modules[made.__module__]).partition("def read")[2], (word, key)


def test_every_hook_is_on_the_page_of_python():
    text = "\n".join(hooks())
    assert not [name for name in vars(declared) if name.startswith("dashpot_") and f"| `{name}` |" not in text]
