"""How values are read from files and written to them: own documents, tables, tasks, drawings of other programs."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from functools import partial
from importlib import import_module
from math import atan2
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gruebler.base.atomic_files import write_whole
from gruebler.base.documents import load_document
from gruebler.base.errors import GrueblerError, naming
from gruebler.base.text import Message, message

if TYPE_CHECKING:
    from typing import TypeAlias

    from gruebler.base.columns import Table
    from gruebler.design.synthesis import Task
    from gruebler.files.pin_drawings import PinDrawing
    from gruebler.machines.gears import TrainReading
    from gruebler.mechanics.linkages import Linkage
    from gruebler.mechanics.screws import SpatialLinkage
    from gruebler.structure.chain import Chain

    Value: TypeAlias = Chain | list[Chain] | Linkage | SpatialLinkage | TrainReading | Task

_TASKS = frozenset({"positions", "points", "inputs", "function", "swing", "stroke"})
LINKAGES = frozenset({"joints", "four_bar", "slider_crank", "inverted_slider_crank"})
"""Keys of which a document of a linkage has one; it may have points, too."""
KINDS = LINKAGES | _TASKS | {"train", "elements", "places", "screws"}
"""Keys of which each document of ours has one."""
_LARGEST_TABLE = 1_000_000  # bytes
_POSE = 4  # numbers: a place and a direction
LOADS = message("loads, masses and the speed of the drive")
"""What is left out of a linkage by those who want the linkage alone."""
_JSON_OF_OTHERS = ("motiongen", "pylinkage")
"""Programs whose documents are JSON; their module knows them by ``is_...``."""


def read_own_document(path: Path, left_out: list[Message]) -> Value:
    """A TOML or JSON document: of this library, or JSON of another program that shows by its keys."""
    data = load_document(path, lambda text: GrueblerError("{path}: {problem}", path=path, problem=text))
    if isinstance(data, list):
        return [_chain(path, item) for item in data]
    if not isinstance(data, Mapping):
        raise GrueblerError("{path}: expected a table of keys", path=path)
    if (program := _program_of(data)) is not None:
        return drawn_linkage(path, partial(function_of(program, f"drawing_from_{program}"), data, left_out), left_out)
    if not _TASKS.isdisjoint(data) and LINKAGES.isdisjoint(data):
        from gruebler.files.tasks import read_task

        return read_task(path)
    if "train" in data:
        from gruebler.machines.gears import read_toml

        return read_toml(path.read_text(encoding="utf-8-sig"), str(path))
    if "pair" in str(data.get("joints", ""))[:200] and not isinstance(data.get("joints"), str):
        return _chain(path, data)
    from gruebler.files.screws import read_any_linkage

    value = read_any_linkage(path)
    if data.get("loads"):
        left_out.append(LOADS)
    return value


def _chain(path: Path, document: Any) -> Chain:
    from gruebler.structure.chain import Chain

    with naming(path, GrueblerError):
        return Chain.from_json(document)


def write_own_document(value: Any, path: Path, left_out: list[Message]) -> None:
    """TOML or JSON of this library."""
    from gruebler.design.synthesis import Task
    from gruebler.mechanics.linkages import Linkage
    from gruebler.mechanics.screws import SpatialLinkage
    from gruebler.structure.chain import Chain

    del left_out
    suffix = path.suffix.lower()
    if isinstance(value, SpatialLinkage):
        from gruebler.files.screws import write_screws

        write_screws(path, value)
    elif isinstance(value, Linkage):
        from gruebler.files import write_linkage

        write_linkage(path, value)
    elif isinstance(value, Task):
        from gruebler.files.tasks import write_task

        write_task(path, value)
    elif type(value).__name__ in ("Motion", "SpatialMotion", "Table"):
        raise GrueblerError(
            "{path}: motions and tables go to .csv or .parquet, not {suffix!r}", path=path, suffix=suffix
        )
    elif suffix == ".json":
        document = value.to_json() if isinstance(value, Chain) else [chain.to_json() for chain in value]
        write_whole(path, json.dumps(document, ensure_ascii=False, indent=1) + "\n")
    else:
        raise GrueblerError("{path}: chains go to .json, .txt or .g6, not {suffix!r}", path=path, suffix=suffix)


def write_csv(value: Any, path: Path, left_out: list[Message]) -> None:
    """A table, or a task."""
    table = _as_table(value)
    if table is None:
        _write_task(value, path, left_out)
    else:
        write_whole(path, table.csv())


def write_spreadsheet(value: Any, path: Path, left_out: list[Message]) -> None:
    """With a byte order mark: without it spreadsheets take ° and ′ for other signs."""
    del left_out
    write_whole(path, "\ufeff" + _required_table(value, path).csv(decimal_comma=True))


def write_parquet_table(value: Any, path: Path, left_out: list[Message]) -> None:
    """A table; `GrueblerError` without pyarrow."""
    del left_out
    write_whole(path, _required_table(value, path).parquet())


def _as_table(value: Any) -> Table | None:
    """The table of a motion, or the table itself; None for other values."""
    from gruebler.base.columns import Table
    from gruebler.mechanics.kinematics.motion import Motion

    if isinstance(value, Motion):
        return value.table()
    return value if isinstance(value, Table) else None


def _required_table(value: Any, path: Path) -> Table:
    table = _as_table(value)
    if table is None:
        kind = type(value).__name__
        raise GrueblerError("{path}: the format holds motions and tables, not a {kind}", path=path, kind=kind)
    return table


def read_task_or_curve(path: Path, left_out: list[Message]) -> Task:
    """A task in CSV, or without a header a curve of four-bar-rs, closed if its name has ``.closed.``."""
    from gruebler.design.synthesis import PathTask, PositionTask
    from gruebler.files.four_bar_rs import curve_from_csv
    from gruebler.files.tasks import read_task
    from gruebler.files.text_files import read_text

    del left_out
    text = read_text(path, _LARGEST_TABLE)
    try:
        rows = curve_from_csv(text)
        if rows is None:
            return read_task(path)
        if len(rows[0]) == _POSE:
            return PositionTask(tuple((x, y, atan2(dy, dx)) for x, y, dx, dy in rows))
        return PathTask(tuple((x, y) for x, y in rows), closed=".closed." in path.name.lower())
    except GrueblerError as error:
        if str(path) in str(error):
            raise
        raise GrueblerError("{path}: {error}", path=path, error=error) from None


def _write_task(value: Any, path: Path, left_out: list[Message]) -> None:
    from gruebler.design.synthesis import Task
    from gruebler.files.tasks import write_task

    del left_out
    if not isinstance(value, Task):
        raise GrueblerError("{path}: expected a synthesis task", path=path)
    write_task(path, value)


def drawn_linkage(path: Path, drawing: Callable[[], PinDrawing], left_out: list[Message]) -> Linkage:
    """The linkage of a drawing; errors name the file, also where numbers near the largest have no square."""
    from gruebler.files.drawing_linkages import linkage_of_drawing

    try:
        drawn = drawing()
        left_out += [LOADS] if drawn.loads else []
        return linkage_of_drawing(drawn, left_out)
    except OverflowError:
        raise GrueblerError("{path}: it has numbers that are too large to be lengths", path=path) from None
    except GrueblerError as error:
        raise GrueblerError("{path}: {error}", path=path, error=error) from None


def linkage_to_write(value: Any) -> Linkage:
    """The linkage to write; `GrueblerError` for a value without dimensions."""
    from gruebler.mechanics.linkages.conversion import as_linkage

    return as_linkage(value)


def function_of(module: str, name: str) -> Callable[..., Any]:
    """A function of a file in this folder, loaded when it is called for."""
    function: Callable[..., Any] = getattr(import_module(f"gruebler.files.{module}"), name)
    return function


def _program_of(document: Any) -> str | None:
    """The other program whose document this is, by its keys."""
    return next((each for each in _JSON_OF_OTHERS if function_of(each, f"is_{each}")(document)), None)


def json_of_another_program(path: Path) -> bool:
    """Whether a JSON file is one of another program, by its keys; False for a file that is no JSON."""
    try:
        data = load_document(path, GrueblerError)
    except GrueblerError:
        return False
    return _program_of(data) is not None
