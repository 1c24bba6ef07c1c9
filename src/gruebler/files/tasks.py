"""Tasks in files and as plain data: TOML, JSON and CSV, read and written without losing a bit.

Lengths are in the unit that the file names, angles in degrees; docs/theory/synthesis.md has every key.
"""

from __future__ import annotations

import csv
import io
import json
import re
import warnings
from collections.abc import Iterator, Mapping
from itertools import compress
from pathlib import Path
from typing import Any

import msgspec

from gruebler.base.atomic_files import write_whole
from gruebler.base.documents import convert_document, load_document
from gruebler.base.errors import SynthesisError, UnitWarning, naming
from gruebler.base.text import Message, joined
from gruebler.design.synthesis.formulas import FunctionLaw
from gruebler.design.synthesis.tasks import (
    DeadCentreTask,
    DwellTask,
    FunctionTask,
    PathTask,
    PositionTask,
    Task,
    function_task,
    numbered_entry,
)
from gruebler.files.angles import in_degrees, in_radians
from gruebler.files.text_files import read_text


class _Record(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    unit: str = "mm"


class _Positions(_Record, frozen=True, forbid_unknown_fields=True, kw_only=True):
    positions: list[list[Any]]
    moving_pivots: list[list[float]] = []
    fixed_pivots: list[list[float]] = []
    curve_parameters: list[float] = []
    order: list[Any] = []


class _Path(_Record, frozen=True, forbid_unknown_fields=True, kw_only=True):
    points: list[list[float] | None]
    angles: list[Any] = []
    crank_angles: list[Any] = []
    output_angles: list[Any] = []
    fixed_pivots: list[list[float]] = []
    closed: bool = False
    tolerances: list[float | None] = []
    weights: list[float] = []
    order: list[Any] = []


class _Function(_Record, frozen=True, forbid_unknown_fields=True, kw_only=True):
    inputs: list[Any]
    outputs: list[Any]
    output: str = "angle"
    start_input: bool = True
    start_output: bool = True


class _Law(_Record, frozen=True, forbid_unknown_fields=True, kw_only=True):
    function: str
    interval: tuple[float, float]
    input_swing: Any
    output_swing: Any
    input_start: Any = None
    output_start: Any = None
    precision_points: int = 5
    output: str = "angle"


class _DeadCentres(_Record, frozen=True, forbid_unknown_fields=True, kw_only=True):
    swing: Any = None
    stroke: float | None = None
    crank_angle: Any = None
    time_ratio: float | None = None


class _Dwell(_Record, frozen=True, forbid_unknown_fields=True, kw_only=True):
    dwell: Any
    swing: Any = None
    stroke: float | None = None


_KINDS: dict[str, type[_Record]] = {
    "function": _Law,
    "positions": _Positions,
    "points": _Path,
    "inputs": _Function,
    "dwell": _Dwell,
    "swing": _DeadCentres,
    "stroke": _DeadCentres,
}
"""The key that every task of a kind has."""
_RECORDS = {PositionTask: _Positions, PathTask: _Path, DeadCentreTask: _DeadCentres, DwellTask: _Dwell}
"""The record of a task that has the same keys."""


def _radians(value: Any, where: Message | str) -> float:
    try:
        return in_radians(value)
    except ValueError:
        raise SynthesisError(
            "{where}: expected an angle in degrees, but found {value!r}", where=where, value=str(value)[:40]
        ) from None


def counting_from_one(problem: Message) -> SynthesisError:
    """The error of a key such as ``points[2][1]``, which is told as that of point 3.

    >>> print(counting_from_one(Message("{key}: expected a number", {"key": "clear[0].body[2][1]"})))
    clear 1, body 3: expected a number
    """
    key = str(problem.values.get("key", ""))
    if "[" not in key:
        return SynthesisError(problem)
    entries = [(part, re.match(r"(\w+)\[(\d+)\]", part)) for part in key.split(".")]
    names = [part if entry is None else numbered_entry(entry[1], int(entry[2])) for part, entry in entries]
    return SynthesisError(problem.filled(key=joined(names)))


def task_from_json(document: Mapping[str, Any]) -> Task:
    """The task of plain data, such as `task_to_json` makes.

    Raises `SynthesisError` with the key of the first thing that does not fit.

    >>> task_from_json({"positions": [[0, 0, 0], [3, 4, 90]]}).angles
    array([0.        , 1.57079633])
    """
    if not isinstance(document, Mapping):
        raise SynthesisError("expected a table of keys")
    kind = next((record for key, record in _KINDS.items() if key in document), None)
    if kind is None:
        raise SynthesisError(
            "a task has positions, points, inputs and outputs, a function, or a swing or stroke, perhaps with a dwell; "
            "found none of them"
        )
    given = dict(document)
    for key in ("points", *_TURNED, "tolerances", "order"):  # null stands for what is free in JSON, "" in TOML
        if isinstance(given.get(key), list):
            given[key] = [None if value == "" else value for value in given[key]]
    record = convert_document(given, kind, counting_from_one)
    with warnings.catch_warnings(action="ignore", category=UnitWarning):  # these are degrees
        return _task(record)


def _task(record: Any) -> Task:
    """The task of a record."""
    data: dict[str, Any] = msgspec.structs.asdict(record)
    match record:
        case _Positions():
            for k, row in enumerate(record.positions):
                if len(row) != 3:
                    raise SynthesisError(
                        "{where}: expected [x, y, degrees], but found {count} values",
                        where=numbered_entry("positions", k),
                        count=len(row),
                    )
            rows = [
                (row[0], row[1], _radians(row[2], numbered_entry("positions", k)))
                for k, row in enumerate(record.positions)
            ]
            return PositionTask(**{**data, "positions": rows})
        case _Path():
            for key in _TURNED:
                data[key] = [
                    None if a is None else _radians(a, numbered_entry(key, k)) for k, a in enumerate(data[key])
                ]
            return PathTask(**data)
        case _Function():
            inputs = [_radians(a, numbered_entry("inputs", k)) for k, a in enumerate(record.inputs)]
            turning = record.output == "angle"
            outputs = [
                _radians(a, numbered_entry("outputs", k)) if turning else a for k, a in enumerate(record.outputs)
            ]
            return FunctionTask(**{**data, "inputs": tuple(inputs), "outputs": tuple(outputs)})
        case _Law():
            return _function_task(record)
        case _:
            for key in _OF_OUTPUTS & data.keys():
                data[key] = None if data[key] is None else _radians(data[key], key)
            return (DwellTask if isinstance(record, _Dwell) else DeadCentreTask)(**data)


def _function_task(record: _Law) -> FunctionTask:
    def output(value: Any, where: str) -> float:
        return _radians(value, where) if record.output == "angle" else _length(value, where)

    law = FunctionLaw(
        record.function,
        interval=record.interval,
        input_swing=_radians(record.input_swing, "input_swing"),
        output_swing=output(record.output_swing, "output_swing"),
        input_start=None if record.input_start is None else _radians(record.input_start, "input_start"),
        output_start=None if record.output_start is None else output(record.output_start, "output_start"),
    )
    return function_task(law, record.precision_points, output=record.output, unit=record.unit)


def _length(value: Any, where: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise SynthesisError("{where}: expected a number, but found {value!r}", where=where, value=str(value)[:40])
    return float(value)


def task_to_json(task: Task) -> dict[str, Any]:
    """Plain data for `json.dumps`; `task_from_json` takes it back exactly."""
    document: dict[str, Any] = {"unit": task.unit}
    match task:
        case FunctionTask(law=FunctionLaw() as law):

            def output(value: float | None) -> float | str | None:
                return _degrees(value) if task.output == "angle" else value

            more: dict[str, Any] = {
                "function": law.function,
                "interval": list(law.interval),
                "input_swing": in_degrees(law.input_swing),
                "output_swing": output(law.output_swing),
                "input_start": _degrees(law.input_start),
                "output_start": output(law.output_start),
                "precision_points": len(task),
                "output": task.output,
            }
        case FunctionTask():
            turning = task.output == "angle"
            document["inputs"] = [in_degrees(a) for a in task.inputs]
            document["outputs"] = [in_degrees(a) if turning else a for a in task.outputs]
            document |= {"output": task.output, "start_input": task.start_input, "start_output": task.start_output}
            more = {}
        case _:
            more = {key: _plain(key, getattr(task, key)) for key in _RECORDS[type(task)].__struct_fields__}
    return document | {
        key: value for key, value in more.items() if value is not None and value is not False and value != []
    }


def _plain(key: str, value: Any) -> Any:
    """What a task has under a key: tuples as lists, angles in degrees."""
    if key == "positions":
        return [[x, y, in_degrees(angle)] for x, y, angle in value]
    if isinstance(value, tuple):
        return [_plain(key, part) for part in value]
    return _degrees(value) if key in _TURNED or key in _OF_OUTPUTS else value


def _degrees(radians: float | None) -> float | str | None:
    return None if radians is None else in_degrees(radians)


_OF_OUTPUTS = {"swing", "crank_angle", "dwell"}
_OF_ONE_ROW = ("swing", "stroke", "crank_angle", "time_ratio", "dwell")
"""The columns of a CSV file that has dead centres or a rest."""
_TURNED = ("angles", "crank_angles", "output_angles")
"""The angles that a path gives for its targets."""
_COLUMNS_OF = {"angles": "angle", "crank_angles": "crank", "output_angles": "output"} | {
    "tolerances": "tolerance",
    "weights": "weight",
    "order": "order",
}
"""The columns of a CSV file beside x and y for what a path gives for its targets."""


def read_task(path: Path | str) -> Task:
    """The task in a ``.toml``, ``.json`` or ``.csv`` file.

    The columns of a CSV file say what it is: ``x,y,angle`` positions (an empty angle is free: a mixed task), ``x,y``
    points, perhaps with ``angle``, ``crank``, ``output``, ``tolerance``, ``weight`` (empty cells are free), both
    perhaps with ``order``, ``input,output`` or ``input,travel`` a function, ``swing`` or ``stroke`` with
    ``crank_angle`` or ``time_ratio`` dead centres, with ``dwell`` a rest. Without a header two columns are points,
    three positions. With semicolons or tabs between the columns a comma is the decimal sign.

    Raises `SynthesisError` with file and key or line of the first thing that does not fit.
    """
    path = Path(path)
    if path.suffix.lower() not in (".toml", ".json", ".csv"):
        raise SynthesisError("{path}: a task is in a .toml, .json or .csv file", path=path)
    if path.suffix.lower() == ".csv":
        text = read_text(path, kind=SynthesisError)
        with naming(path, SynthesisError):
            return _from_csv(text)
    with naming(path, SynthesisError):
        return task_from_json(load_document(path, SynthesisError))


def _rows(text: str) -> Iterator[list[str]]:
    """Between commas, else semicolons or tabs, as spreadsheets write and copy where the comma is the decimal sign."""
    first_line = text.partition("\n")[0]
    other = next((sign for sign in (";", "\t") if sign in first_line), None)
    for row in csv.reader(io.StringIO(text), delimiter=other or ","):
        yield row if other is None else [cell.replace(",", ".") for cell in row]


def _from_csv(text: str) -> Task:
    try:
        lines = [row for row in _rows(text) if any(cell.strip() for cell in row)]
    except csv.Error as error:
        raise SynthesisError("is not a table: {reason}", reason=error) from None
    if not lines:
        raise SynthesisError("is empty")
    header = [cell.strip().lower() for cell in lines[0]]
    first = 2  # the line of the first row of numbers
    if all(map(_is_number, header)):
        header, first, lines = _columns(len(header)), 1, [header, *lines]
    for k, row in enumerate(lines[1:]):
        if len(row) != len(header):
            raise SynthesisError(
                "line {line}: expected {expected} columns, but found {count}",
                line=k + first,
                expected=len(header),
                count=len(row),
            )
    columns = {name: [row[c].strip() for row in lines[1:]] for c, name in enumerate(header)}

    def numbers(name: str) -> list[float]:
        values = []
        for k, cell in enumerate(columns[name]):
            try:
                values.append(float(cell))
            except ValueError:
                raise SynthesisError(
                    "line {line}, {name}: expected a number, but found {cell!r}",
                    line=k + first,
                    name=name,
                    cell=cell[:40],
                ) from None
        return values

    def angles(name: str) -> list[Any]:
        return [_angle(cell) for cell in columns[name]]

    def ranks() -> list[Any]:
        return [int(cell) if cell.lstrip("+-").isdecimal() else cell or None for cell in columns["order"]]

    match frozenset(header):
        case names if names - {"order"} == {"x", "y", "angle"} and all(columns["angle"]):
            rows_of_numbers = zip(numbers("x"), numbers("y"), angles("angle"), strict=True)
            order = {"order": ranks()} if "order" in names else {}
            return task_from_json({"positions": [list(row) for row in rows_of_numbers], **order})
        case names if {"x", "y"} <= names <= {"x", "y", *_COLUMNS_OF.values()}:
            placed = [bool(x or y) for x, y in zip(columns["x"], columns["y"], strict=True)]
            for name in ("x", "y"):
                columns[name] = list(compress(columns[name], placed))
            places = map(list, zip(numbers("x"), numbers("y"), strict=True))
            given: dict[str, Any] = {"points": [next(places) if there else None for there in placed]}
            given |= {key: angles(name) for key, name in _COLUMNS_OF.items() if name in names}
            return task_from_json(given | ({"order": ranks()} if "order" in names else {}))
        case names if names == {"input", "output"}:
            return task_from_json({"inputs": angles("input"), "outputs": angles("output")})
        case names if names == {"input", "travel"}:
            return task_from_json({"inputs": angles("input"), "outputs": numbers("travel"), "output": "travel"})
        case names if names and names <= {*_OF_ONE_ROW} and len(lines) == 2:
            return task_from_json(
                {name: angles(name)[0] if name in _OF_OUTPUTS else numbers(name)[0] for name in header}
            )
    raise SynthesisError(
        "line 1: expected the columns x,y with any of {more}, or input,output, or input,travel, or one row with some "
        "of {single}, but found {header}",
        more=",".join(_COLUMNS_OF.values()),
        single=",".join(_OF_ONE_ROW),
        header=",".join(header)[:60],
    )


def _is_number(cell: str) -> bool:
    """Whether the cell is one of a row of numbers, not of a header; an empty one is a free angle."""
    try:
        float(cell.removesuffix("°") or "0")
    except ValueError:
        return False
    return True


def _columns(count: int) -> list[str]:
    """The columns of a file without a header: two numbers are a point, three a position."""
    if count not in (2, 3):
        raise SynthesisError(
            "line 1: expected the names of the columns, or rows x,y (points) or x,y,angle (positions) without them, "
            "but found {count} numbers",
            count=count,
        )
    return ["x", "y", "angle"][:count]


def _angle(cell: str) -> float | str | None:
    """An angle of a CSV file; one with more digits than a double has ends with a degree sign."""
    if not cell or cell.endswith("°"):
        return cell[:-1] or None
    try:
        return float(cell)
    except ValueError:
        return cell


def write_task(path: Path | str, task: Task) -> None:
    """Write a ``.toml``, ``.json`` or ``.csv`` file; `read_task` takes it back exactly.

    Raises `SynthesisError` for a task that has more than the columns of a CSV file.
    """
    path = Path(path)
    document = task_to_json(task)
    match path.suffix.lower():
        case ".toml":
            text = "".join(f"{key} = {_toml(value)}\n" for key, value in document.items())
        case ".json":
            text = json.dumps(document, ensure_ascii=False, indent=2) + "\n"
        case ".csv":
            text = _to_csv(document)
        case _:
            raise SynthesisError("{path}: end the name with .toml, .json or .csv", path=path)
    if not path.parent.is_dir():
        raise SynthesisError("{path}: there is no folder {parent!r}", path=path, parent=str(path.parent))
    write_whole(path, text)


def _toml(value: Any) -> str:
    if value is None:
        return '""'
    if isinstance(value, list):
        return "[" + ", ".join(map(_toml, value)) + "]"
    return json.dumps(value, ensure_ascii=False)


def _to_csv(document: Mapping[str, Any]) -> str:
    keys = {key for key in document if key != "unit"}
    rows: list[list[Any]]
    match keys:
        case _ if keys - {"order"} == {"positions"} or {"points"} <= keys <= {"points", *_COLUMNS_OF}:
            targets, places = ("points", ["x", "y"]) if "points" in keys else ("positions", ["x", "y", "angle"])
            more = [key for key in _COLUMNS_OF if key in keys]
            header = [*places, *(_COLUMNS_OF[key] for key in more)]
            lists = [[each or ["", ""] for each in document[targets]], *(document[key] for key in more)]
            rows = [[*each, *("" if v is None else v for v in rest)] for each, *rest in zip(*lists, strict=True)]
        case _ if keys == {"inputs", "outputs", "output", "start_input", "start_output"} and (
            document["start_input"] and document["start_output"]
        ):
            header = ["input", "output" if document["output"] == "angle" else "travel"]
            rows = [list(pair) for pair in zip(document["inputs"], document["outputs"], strict=True)]
        case _ if keys & {"swing", "stroke"}:
            header = sorted(keys)
            rows = [[document[key] for key in header]]
        case _:
            raise SynthesisError(
                "a CSV file has no columns for {keys}: write .toml or .json", keys=", ".join(sorted(keys))
            )
    if document["unit"] != "mm":
        raise SynthesisError("a CSV file does not name the unit {unit!r}: write .toml or .json", unit=document["unit"])
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(
        [header, *([f"{v}°" if isinstance(v, str) and v else v for v in row] for row in rows)]
    )
    return text.getvalue()
