"""The reference has every key of every schema, every command, effect, threshold and public name, with its meaning."""

from __future__ import annotations

import dataclasses
import inspect
import re
from collections.abc import Iterator
from functools import cache

import pytest
from pydantic import BaseModel
from typer.testing import CliRunner

import parastiff
from docs.made import expanded, pieces
from docs.made.allowed import allowed, anchor, default_of, short, unit_of
from docs.made.choice import scored
from docs.made.commands import names as command_names
from docs.made.described import descriptions
from docs.made.keys import ANSWERS, TABLES
from docs.made.lists import deviations
from pipeline.campaign.tables import GaugeTable, NoiseTable, TestTable
from pipeline.cli import app
from pipeline.record import Record
from pipeline.selection.criteria import CRITERIA, Criteria
from pipeline.toml.fields import Table
from pipeline.validation.case_tables import Part
from tests.conftest import ROOT
from vjm.effects import catalogue

PAGES = {
    str(path.relative_to(ROOT / "docs")): path.read_text(encoding="utf-8")
    for path in (ROOT / "docs").rglob("*.md")
}
SCHEMAS = {**TABLES, **ANSWERS}
RECORDS = (
    "pipeline.answer.record",
    "pipeline.answer.evidence",
    "pipeline.compare.record",
    "pipeline.discover.record",
    "pipeline.answer.law",
    "pipeline.answer.value",
    "pipeline.plan.record",
    "pipeline.predict.record",
    "pipeline.manipulator.table_record",
)


@cache
def reference() -> dict[str, str]:
    """The pages of the reference as they are shown."""
    return {name: expanded(text) for name, text in PAGES.items() if name.startswith("reference/")}


def leaves(cls: type[BaseModel]) -> Iterator[type[BaseModel]]:
    """Classes that others are not made from."""
    below = cls.__subclasses__()
    for each in below:
        yield from leaves(each)
    if not below:
        yield cls


def keys(schema: type[BaseModel]) -> list[str]:
    return [field.alias or name for name, field in schema.model_fields.items()]


def rows_of(schema: type[BaseModel]) -> dict[str, list[str]]:
    """Cells of the table of a schema in the pages, by key."""
    every = "\n".join(reference().values())
    (place,) = re.findall(rf"^\({re.escape(anchor(schema))}\)=$\n\n((?:\|.*\n)+)", every, re.MULTILINE)
    cells = [re.split(r"(?<!\\)\|", line)[1:-1] for line in place.splitlines()[2:]]
    return {row[0].strip().strip("`"): [cell.strip() for cell in row[1:]] for row in cells}


def test_every_schema_is_in_the_reference() -> None:
    written = {
        cls for base in (Table, Part) for cls in leaves(base) if cls.__module__.startswith("pipeline.")
    }
    answered = {cls for cls in leaves(Record) if cls.__module__ in RECORDS}
    assert len(written) > 25 and len(answered) > 20
    assert set(TABLES.values()) == written
    assert set(ANSWERS.values()) == answered


@pytest.mark.parametrize("name", SCHEMAS)
def test_every_key_is_in_its_table_and_says_what_it_means(name: str) -> None:
    schema = SCHEMAS[name]
    found = rows_of(schema)
    assert sorted(found) == sorted(keys(schema))
    for key, (allows, meaning) in found.items():
        assert allows and meaning.endswith("."), f"{name}: {key} has no description below it in {schema}"


def test_a_key_without_a_description_is_found() -> None:
    class Bare(BaseModel):
        there: int
        """It is there."""
        missing: int
        beside: int = 0  # no text below

    class Inherits(Bare):
        own: int
        """Its own."""

    assert descriptions(Inherits) == {"there": "It is there.", "own": "Its own."}


def test_units_defaults_and_limits_are_told() -> None:
    field = GaugeTable.model_fields["station"]
    assert allowed(field) == "number from 0 to 1" and default_of(field) == ""
    assert allowed(GaugeTable.model_fields["on"]) == '`"bar"`, `"platform"`'
    assert default_of(GaugeTable.model_fields["on"]) == 'default `"bar"`'
    assert allowed(GaugeTable.model_fields["offset_mm"]).startswith("list of three numbers from -1e6")
    assert allowed(NoiseTable.model_fields["gain"]) == "number from 0 to 0.2"
    assert default_of(TestTable.model_fields["role"]) == "needed"
    assert [unit_of(key) for key in ("EIy_Nmm2", "radial_mm_per_N", "length_mm", "kind")] == [
        "N·mm²",
        "mm/N",
        "mm",
        "",
    ]
    assert [short(x) for x in (1e6, 1e-9, 0.5, -1e15, 300.0)] == ["1e6", "1e-9", "0.5", "-1e15", "300"]


def test_every_mark_of_a_page_is_made_and_everything_made_is_shown() -> None:
    marks = {name for text in PAGES.values() for name in re.findall(r"<!-- made: (.+?) -->", text)}
    assert marks <= set(pieces())
    unused = {name for name in set(pieces()) - marks if not name.startswith("criterion ")}
    assert unused == {f"keys of rig {kind}" for kind in ("bar", "manipulator", "parallelogram")} | {
        name for name in pieces() if name.startswith("keys of part ")
    }
    with pytest.raises(ValueError, match="nothing is made for 'no such thing'"):
        expanded("<!-- made: no such thing -->")


def test_a_page_that_is_read_as_its_source_says_where_the_built_one_is() -> None:
    for name, text in PAGES.items():
        said = f"filled in by `make docs`, which writes\n> `build/docs/{name.removesuffix('.md')}.html`.\n"
        assert (said in text) == ("<!-- made: " in text), name
        assert "This is the source of a page" not in expanded(text), name


def test_every_command_has_all_its_options() -> None:
    text, runner = reference()["reference/commands.md"], CliRunner()
    sections = dict(zip(command_names(), text.split("\n(command-")[1:], strict=True))
    for name, section in sections.items():
        said = runner.invoke(app, [name, "--help"], env={"COLUMNS": "200", "TERM": "dumb"}).output
        wanted = set(re.findall(r"(?<![\w-])--[a-z][\w-]*", said)) - {"--help"}
        # An option that another one's help names is among them as well.
        assert wanted == set(re.findall(r"(?<![\w-])--[a-z][\w-]*", section)), name
    assert len(sections) == len(app.registered_commands)


def test_every_effect_and_every_threshold_is_described() -> None:
    effects, thresholds = reference()["reference/effects.md"], reference()["reference/criteria.md"]
    for name, effect in catalogue().items():
        section = effects.split(f"(effect-{name})=")[1].split("\n(effect-")[0]
        assert effect.equation in section and f"signatures/{name}.png" in section
        assert all(f"| `{p.name}` | {p.unit} |" in section for p in effect.parameters)
    assert len(dataclasses.fields(Criteria)) > 70
    for each in CRITERIA.of():
        assert f"| `{each.name}` | {each.value:g} | {each.unit} |" in thresholds


@pytest.mark.parametrize("name", parastiff.__all__)
def test_every_public_name_is_documented(name: str) -> None:
    found = getattr(parastiff, name)
    assert inspect.getdoc(found), name
    target = found.__name__ if inspect.ismodule(found) else f"parastiff.{name}"
    assert re.search(
        rf"^\.\. auto\w+:: {re.escape(target)}$", reference()["reference/python.md"], re.MULTILINE
    )


def test_the_score_is_that_of_the_kept_challenge() -> None:
    verdict = expanded(PAGES["verdict.md"])
    assert all(f"| {goal.name} | {goal.wanted} | {goal.share} |" in verdict for goal in scored().goals)
    assert len(scored().goals) == 11


def test_the_usual_tolerances_are_told() -> None:
    assert "| `EA` |" in deviations() and "| 0.02 | 0 to 0.2 |" in deviations()


def test_each_term_of_the_glossary_is_there_once() -> None:
    terms = re.findall(
        r"^(\S.*)$", PAGES["glossary.md"].split("```{glossary}")[1].split("```")[0], re.MULTILINE
    )
    assert len(terms) > 50 and terms == sorted(set(terms), key=str.casefold)
