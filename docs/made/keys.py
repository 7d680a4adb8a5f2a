"""The keys of every file and answer, from their schemas."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

from pydantic import BaseModel

from docs.made.allowed import allowed, anchor, default_of, unit_of
from docs.made.described import descriptions, summary
from pipeline.answer import evidence, value
from pipeline.answer import law as law_record
from pipeline.answer import record as answer
from pipeline.bar import tables as bar
from pipeline.campaign import tables as campaign
from pipeline.campaign.mapped import schema as mapped
from pipeline.campaign.rigs import KINDS
from pipeline.compare import record as compare
from pipeline.discover import record as laws
from pipeline.inference import model_reading as model
from pipeline.manipulator import table_record as table_1
from pipeline.manipulator import tables as manipulator
from pipeline.plan import record as plan
from pipeline.predict import record as predict
from pipeline.toml.fields import BarTable
from pipeline.validation import case_tables as case

TABLES: dict[str, type[BaseModel]] = {
    "campaign": campaign.Top,
    "noise": campaign.NoiseTable,
    "gauges": campaign.GaugeTable,
    "tests": campaign.TestTable,
    "file": mapped.FileTable,
    "columns": mapped.ColumnTable,
    "cell": mapped.CellTable,
    "derived": mapped.DerivedTable,
    "uniform bar": BarTable,
    **{f"rig {kind}": schema for kind, schema in KINDS.items()},
    "manipulator": manipulator.Top,
    "leg": manipulator.LegTable,
    **{f"part {part}": schema for part, schema in manipulator.PARTS.items()},
    "case": case.Case,
    "case material": case.Material,
    "case linkage": case.LinkageSize,
    "case bar": case.BarChoice,
    "section i_section": case.ISectionSize,
    "section rectangle": case.RectangleSize,
    "section round": case.RoundSize,
    "section tube": case.TubeSize,
    "case lug": case.LugSize,
    "case paper": case.Paper,
    "case mesh": case.MeshSize,
    "file case": bar.FileCase,
    "file bar": bar.FileBar,
    "file end plane": bar.PlaneEnd,
    "file end cylinder": bar.CylinderEnd,
    "file end name": bar.NamedEnd,
    "file material": bar.OrthotropicMaterial,
    "file linkage": bar.FileLinkage,
    "file mesh": bar.FileMesh,
    "model": model._Top,
    "model from": model._Source,
    "model effects": model._Effect,
    "model errors": model._Error,
}
"""Schemas of what a user writes, by the name of their line in a page."""

ANSWERS: dict[str, type[BaseModel]] = {
    "Answer": answer.Answer,
    "Value": value.Value,
    "ModelError": answer.ModelError,
    "TestChange": answer.TestChange,
    "TestNoise": answer.TestNoise,
    "Candidate": answer.Candidate,
    "Correlation": answer.Correlation,
    "Certain": answer.Certain,
    "NominalValue": answer.NominalValue,
    "DoctorFinding": answer.DoctorFinding,
    "UnknownZero": answer.UnknownZero,
    "SetAside": answer.SetAside,
    "FoundNoise": answer.FoundNoise,
    "Evidence": evidence.Evidence,
    "Explained": evidence.Explained,
    "RivalSet": evidence.RivalSet,
    "SensorInstead": evidence.SensorInstead,
    "LookAlike": evidence.LookAlike,
    "FailedCheck": evidence.FailedCheck,
    "NearMiss": evidence.NearMiss,
    "RestOfChannel": evidence.RestOfChannel,
    "Comparison": compare.Comparison,
    "compare ModelError": compare.ModelError,
    "TestError": compare.TestError,
    "ChannelError": compare.ChannelError,
    "Finding": compare.Finding,
    "Lost": compare.Lost,
    "Discovered": laws.Discovered,
    "LawFound": law_record.LawFound,
    "Tie": law_record.Tie,
    "Grouped": law_record.Grouped,
    "Curve": law_record.Curve,
    "Entered": laws.Entered,
    "Plan": plan.Plan,
    "Size": plan.Size,
    "Predictions": predict.Predictions,
    "PredictedRow": predict.PredictedRow,
    "Reading": predict.Reading,
    "ColumnBand": predict.ColumnBand,
    "Counted": predict.Counted,
    "ColumnComparison": predict.ColumnComparison,
    "Budget": predict.Budget,
    "Source": predict.Source,
    "Table1": table_1.Table1,
    "Unknown": table_1.Unknown,
    "Cell": table_1.Cell,
    "ReadingRow": table_1.ReadingRow,
    "Agreement": table_1.Agreement,
    "table Finding": table_1.Finding,
}
"""Records of what `--json` writes."""


def key_table(schema: type[BaseModel], written: bool = True) -> str:
    """The keys of a schema as a table. written: whether a user writes them, so that defaults and units count."""
    meaning = descriptions(schema)
    rows = [f"({anchor(schema)})=", "", *_head(("key", "allowed" if written else "value", "meaning"))]
    # What says the kind of a table comes first.
    fields = sorted(schema.model_fields.items(), key=lambda it: it[0] not in ("kind", "part"))
    for name, field in fields:
        key = field.alias or name
        parts = [allowed(field), *((unit_of(key), default_of(field)) if written else ())]
        rows.append(f"| `{key}` | {_cell(', '.join(filter(None, parts)))} | {_cell(meaning.get(name, ''))} |")
    return "\n".join(rows) + "\n"


def _head(names: tuple[str, ...]) -> Iterator[str]:
    yield "| " + " | ".join(names) + " |"
    yield "|" + "---|" * len(names)


def _cell(text: str) -> str:
    """Text inside a cell: what Markdown would take for marks stands as it is."""
    return text.replace("|", r"\|").replace("*", r"\*").replace("<", "&lt;")


def _rigs() -> str:
    return "\n".join(f'### `kind = "{kind}"`\n\n{key_table(schema)}' for kind, schema in KINDS.items())


def _parts() -> str:
    return "\n".join(
        f'### `part = "{part}"`\n\n{key_table(schema)}' for part, schema in manipulator.PARTS.items()
    )


def _record(schema: type[BaseModel]) -> str:
    return f"{summary(schema)}\n\n{key_table(schema, written=False)}"


PIECES: dict[str, Callable[[], str]] = {
    **{f"keys of {name}": partial(key_table, schema) for name, schema in TABLES.items()},
    **{f"record {name}": partial(_record, schema) for name, schema in ANSWERS.items()},
    "rigs": _rigs,
    "parts": _parts,
}
