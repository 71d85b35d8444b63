"""A campaign file, its tables and its patterns: read as they stand, every mistake told with its place."""

from __future__ import annotations

from pathlib import Path

import jsonschema
import pytest

from dashpot import load_registry
from dashpot.campaign.declaration import CampaignSpec
from dashpot.campaign.reading import read_campaign
from dashpot.campaign.schema import campaign_schema
from dashpot.text.document import Document
from dashpot.text.problem import InputError

TABLE = "specimen,data,temperature,supplier,batch\na,x/a,20,north,1\nb,x/b,,south,2\n"
HEAD = "format: dashpot-campaign/1\nname: c\n"
REST = "models: [kelvin_voigt]\n"


def read(folder: Path, text: str, table: str = TABLE) -> CampaignSpec:
    (folder / "specimens.csv").write_text(table)
    (folder / "campaign.yaml").write_text(text)
    return read_campaign(folder / "campaign.yaml", load_registry())


def mistake(folder: Path, text: str, table: str = TABLE) -> str:
    with pytest.raises(InputError) as caught:
        read(folder, text, table)
    return str(caught.value)


def test_a_table_gives_specimens_with_their_properties(tmp_path):
    found = read(tmp_path, HEAD + "specimens: specimens.csv\n" + REST)
    assert [one.name for one in found.specimens] == ["a", "b"]
    assert found.specimens[0].data == str(tmp_path / "x/a")
    assert found.specimens[0].properties == {"temperature": 20.0, "supplier": "north", "batch": 1.0}
    assert found.specimens[1].properties == {"supplier": "south", "batch": 2.0}
    assert (found.verbs, found.dependence, found.memory) == (("fit",), ("temperature", "supplier"), None)


@pytest.mark.parametrize("delimiter", [";", "\t"])
def test_a_table_may_have_other_delimiters_and_a_byte_order_mark(tmp_path, delimiter):
    found = read(tmp_path, HEAD + "specimens: specimens.csv\n" + REST, "\ufeff" + TABLE.replace(",", delimiter))
    assert [one.name for one in found.specimens] == ["a", "b"]


def test_a_pattern_names_specimens_after_its_stars(tmp_path):
    for name in ("m1", "m2"):
        (tmp_path / "measured" / name).mkdir(parents=True)
        (tmp_path / "measured" / name / "dataset.yaml").write_text("")
    (tmp_path / "properties.csv").write_text("specimen,wear\nm2,0.5\nm1,0.1\n")
    found = read(tmp_path, HEAD + "specimens: {pattern: measured/*/dataset.yaml, table: properties.csv}\n" + REST)
    assert {one.name: one.properties["wear"] for one in found.specimens} == {"m1": 0.1, "m2": 0.5}
    assert found.specimens[0].data == str(tmp_path / "measured/m1/dataset.yaml")


def test_every_verb_and_model_is_a_job_but_a_comparison_takes_all_models(tmp_path):
    asked = "models: [kelvin_voigt, gehmann]\nverbs: [compare, diagnose]\nmemory: 2 GB\n"
    found = read(tmp_path, HEAD + "specimens: specimens.csv\n" + asked)
    assert [job.name for job in found.jobs if job.specimen == "a"] == [
        "a-compare",
        "a-diagnose-kelvin_voigt",
        "a-diagnose-gehmann",
    ]
    assert found.memory == 2e9


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("verbs: [fit, diagnos]", "campaign.yaml:3:8: the campaign, 'verbs': expected one of fit, compare, diagnose"),
        ("memory: 2 apples", "campaign.yaml:3:9: the campaign, 'memory': expected an amount of memory such as '2 GB'"),
        ("memory: -1 GB", "expected an amount of memory above 0"),
        ("dependence: temprature", "no specimen has a property 'temprature'"),
        ("shared: 'spring.*'", "expected a pattern of searched parameters, got 'spring.*', which names none"),
        ("sed: 1", "the campaign has no key 'sed'"),
    ],
)
def test_mistakes_of_the_file_are_told(tmp_path, line, told):
    assert told in mistake(tmp_path, HEAD + line + "\nspecimens: specimens.csv\n" + REST)


@pytest.mark.parametrize(
    ("table", "told"),
    [
        ("name,data\na,x\n", "specimens.csv: expected a column 'specimen', got: name, data"),
        ("specimen,data\na,x\na,y\n", "specimens.csv:3: two specimens are called 'a'"),
        ("specimen,data\na/b,x\n", "expected a specimen whose name can be that of a folder, got 'a/b'"),
        ("specimen,data\na,\n", "specimens.csv:2: the specimen 'a' has no data"),
        ("specimen,data\na,x,7\n", "specimens.csv:2: expected 2 cells, as in the first line"),
        ("specimen,data\n", "expected at least one specimen"),
    ],
)
def test_mistakes_of_the_table_are_told(tmp_path, table, told):
    assert told in mistake(tmp_path, HEAD + "specimens: specimens.csv\n" + REST, table)


@pytest.mark.parametrize(
    ("pattern", "told"),
    [
        ("measured/dataset.yaml", "expected a pattern with '*'"),
        ("measured/*/none.yaml", "the pattern 'measured/*/none.yaml' names no data"),
    ],
)
def test_mistakes_of_a_pattern_are_told(tmp_path, pattern, told):
    assert told in mistake(tmp_path, HEAD + f"specimens: {{pattern: '{pattern}'}}\n" + REST)


def test_all_mistakes_come_at_once(tmp_path):
    told = mistake(tmp_path, "format: dashpot-campaign/1\nspecimens: none.csv\nmodels: [kelvin_vogt]\n")
    assert "lacks 'name'" in told and "none.csv" in told and "did you mean 'kelvin_voigt'?" in told


def test_the_schema_takes_what_the_reader_takes(tmp_path):
    text = HEAD + (
        "about: x\nspecimens: {pattern: 'm/*', table: t.csv}\nmodels: [a]\nverbs: fit\nseed: 1\n"
        "shared: 'a.*'\ndependence: [t]\nbatch: b\nmemory: 2 GB\nreports: false\n"
    )
    jsonschema.validate(Document.parse(text).root.plain(), campaign_schema())
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(Document.parse(text + "sed: 1\n").root.plain(), campaign_schema())


def test_the_names_of_a_campaign_and_of_its_jobs_can_be_those_of_folders(tmp_path):
    told = mistake(tmp_path, HEAD.replace("name: c", "name: ../c") + "specimens: specimens.csv\n" + REST)
    assert "the campaign, 'name': '../c' cannot be a name: leave out" in told
    table = TABLE.replace("\na,", f"\n{'€' * 80},").replace("\nb,", f"\n{'€' * 80}b,")
    found = read(tmp_path, HEAD + "specimens: specimens.csv\n" + REST, table)
    names = {job.name for job in found.jobs}
    assert len(names) == 2 and all(len(name.encode()) <= 200 for name in names)
