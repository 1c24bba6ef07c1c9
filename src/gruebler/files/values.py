"""`read`, `write` and `convert`: any value in a file, by the ending of its name and by what the file holds."""

from __future__ import annotations

import os
from collections.abc import Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING

from gruebler.base.doors import door
from gruebler.base.errors import GrueblerError, unknown, warn
from gruebler.base.text import Message, joined, joined_by_or, message
from gruebler.files.documents import LOADS, json_of_another_program
from gruebler.files.formats import FORMATS, Format, loads_document

if TYPE_CHECKING:
    from gruebler.files.documents import Value
    from gruebler.mechanics.forces.loads import Loads
    from gruebler.mechanics.linkages import Linkage

_OWN = frozenset({"toml", "csv", "text", "graph6"})  # names of formats that the other readers of this library know, too
_DOCUMENTS = frozenset({"toml", "json"})  # the formats that hold loads


class FormatWarning(UserWarning):
    """A file has something that the value does not have, or the other way round."""


def format_of(path: str | PathLike[str], name: str | None = None, *, to_read: bool = False) -> Format:
    """The format of a name, else of the ending of a path; `GrueblerError` lists those there are, or those to read.

    >>> format_of("chains.g6.gz").name, format_of("leg.json", "pylinkage").name
    ('graph6', 'pylinkage')
    """
    if name is not None:
        for form in FORMATS:
            if form.name == name:
                return form
        names = [form.name for form in FORMATS]
        raise GrueblerError("there is no format {word!r}{suggestion}; known are {known}", **unknown(name, names))
    lower = Path(path).name.lower()
    for form in FORMATS:
        if lower.endswith(form.suffixes):
            return form
    if lower.endswith(".stl") and not to_read:
        raise GrueblerError("{path}: STL is a file for each link: give a folder and --to stl", path=path)
    if lower.endswith(".gltf") and not to_read:
        raise GrueblerError("{path}: glTF is written as one file, which ends with .glb", path=path)
    listed = [form for form in FORMATS if form.read is not None or not to_read]
    endings = [ending for form in listed for ending in form.suffixes if not ending.endswith(".gz")]
    raise GrueblerError(
        "{path}: expected {endings}, not {suffix!r}", path=path, endings=joined_by_or(endings), suffix=Path(path).suffix
    )


def is_of_another_program(path: Path) -> bool:
    """Whether a file is one that `read` alone reads: by the ending of its name, of JSON by its keys.

    >>> is_of_another_program(Path("leg.linkage2")), is_of_another_program(Path("leg.toml"))
    (True, False)
    """
    if path.suffix.lower() == ".json":
        return json_of_another_program(path)
    others = [form for form in FORMATS if form.read is not None and form.name not in _OWN]
    return path.name.lower().endswith(tuple(ending for form in others for ending in form.suffixes))


@door
def read(path: str | PathLike[str], *, format_name: str | None = None, left_out: list[Message] | None = None) -> Value:
    """The value in a file: a linkage, a chain or a list of chains, a task, a gear train.

    Args:
        path: a file; the ending of its name says the format, JSON of other programs is recognised.
        format_name: the format, if the name does not say it: one of `FORMATS`.
        left_out: gets a message for each thing in the file that the value does not have; without it such things are
            warnings, `FormatWarning`.

    Raises `GrueblerError` that names the file and what does not fit. docs/theory/formats.md has every format.
    """
    path = Path(path)
    refuse_folder(path)
    form = format_of(path, format_name, to_read=True)
    if form.read is None:
        raise GrueblerError("{path}: the format {name} is written only", path=path, name=form.name)
    notes: list[Message] = []
    value = form.read(path, notes)
    _say(notes, left_out, message("{path}: not read: {items}", path=path, items=joined(notes, "; ")))
    return value  # type: ignore[no-any-return]


def refuse_folder(path: Path) -> None:
    """An error where a folder stands for a file."""
    if os.path.isdir(path):  # noqa: PTH112  Path.is_dir refuses long names
        raise GrueblerError("{path} is a folder; expected a file", path=path)


def _say(notes: list[Message], left_out: list[Message] | None, text: Message) -> None:
    if left_out is not None:
        left_out += notes
    elif notes:
        warn(text, FormatWarning)


def write(
    value: object,
    path: str | PathLike[str],
    *,
    between: tuple[float, float] | None = None,
    format_name: str | None = None,
    left_out: list[Message] | None = None,
) -> Path:
    """Write a value into a file that `read` takes back, a motion as a table; returns the path.

    Args:
        value: a linkage, a chain or a list of chains, a task, a motion or its table (`Motion.table`).
        path: a file, which appears complete or not at all; the ending of its name says the format.
        between: of a linkage in space with one drive, as glTF: values of the drive (radians, or lengths) between which
            it moves; by default its full range.
        format_name: the format, if the name does not say it: one of `FORMATS`.
        left_out: gets a message for each thing of the value that the file does not have; without it such things are
            warnings, `FormatWarning`.

    Returns:
        The path of the file.

    Raises:
        GrueblerError: a value and a format that do not go together, value and path exchanged.

    Cost:
        Below 1 ms for a linkage; some microseconds a chain or row.

    Example:
        >>> import tempfile
        >>> from gruebler.structure.chain import Chain
        >>> folder = Path(tempfile.mkdtemp())
        >>> write(Chain.parse("R(0-1) R(1-2) R(2-0)"), folder / "triangle.txt").name
        'triangle.txt'

    See Also:
        `read`, `draw`, `Motion`

    Theory:
        docs/theory/formats.md
    """
    if isinstance(value, str | PathLike) and not isinstance(path, str | PathLike):
        raise GrueblerError("write(value, path): the value comes first, then {path!r}", path=fspath(value))
    return _written(value, path, between, format_name, left_out)


@door
def _written(
    value: object,
    path: str | PathLike[str],
    between: tuple[float, float] | None,
    format_name: str | None,
    left_out: list[Message] | None,
) -> Path:
    from gruebler.mechanics.linkages.conversion import linkage_made

    path = Path(path)
    refuse_folder(path)
    value = linkage_made(value)
    _check_kind(value)
    form = format_of(path, format_name)
    notes: list[Message] = []
    if between is None:
        form.write(value, path, notes)
    elif form.write_between is not None:
        form.write_between(value, path, notes, between)
    else:
        raise GrueblerError("{path}: only glTF has a motion between values of the drive", path=path)
    _say(notes, left_out, message("{path}: not written: {items}", path=path, items=joined(notes, "; ")))
    return path


def _check_kind(value: object) -> None:
    from gruebler.base.columns import Table
    from gruebler.design.synthesis import Task
    from gruebler.mechanics.kinematics.motion import Motion
    from gruebler.mechanics.linkages import Linkage
    from gruebler.mechanics.screws import SpatialLinkage
    from gruebler.structure.chain import Chain

    chains = isinstance(value, Sequence) and value and all(isinstance(item, Chain) for item in value)
    if not (chains or isinstance(value, Chain | Linkage | SpatialLinkage | Task | Motion | Table)):
        raise GrueblerError(
            "values of type {kind} cannot be written; linkages, tasks, motions, tables, chains and lists of chains can",
            kind=type(value).__name__,
        )


def convert(
    source: str | PathLike[str],
    target: str | PathLike[str],
    source_format: str | None = None,
    target_format: str | None = None,
) -> list[Message]:
    """Read a file in one format and write it in another; returns what was left out, as messages.

    A linkage keeps its loads where the other format is one of this library. Files of chains one a line are converted
    line by line, however many there are. Raises `GrueblerError` as `read` and
    `write`.

    >>> import tempfile
    >>> folder = Path(tempfile.mkdtemp())
    >>> _ = (folder / "chain.txt").write_text("R(a-b) R(b-c) R(c-d) R(d-a)", encoding="utf-8")
    >>> convert(folder / "chain.txt", folder / "chain.graphml")
    []
    >>> print(read(folder / "chain.graphml"))
    R(a-b) R(b-c) R(c-d) R(d-a)
    """
    from gruebler.files.chain_files import LINES, read_lines, write_lines

    source, target = Path(source), Path(target)
    from_form, to_form = format_of(source, source_format), format_of(target, target_format)
    if source.exists() and target.exists() and source.samefile(target):
        raise GrueblerError("{path}: would overwrite itself", path=source)
    left_out: list[Message] = []
    if from_form.name in LINES and to_form.name in LINES:
        write_lines(read_lines(source, from_form.name), target, to_form.name)
    else:
        not_read: list[Message] = []
        value = read(source, format_name=source_format, left_out=not_read)
        loaded = _loaded(source, from_form, value)
        if loaded is not None:
            left_out += [note for note in not_read if note != LOADS]
            write_loaded(*loaded, target, target_format, left_out)
        else:
            left_out += not_read
            write(value, target, format_name=target_format, left_out=left_out)
    return left_out


def _loaded(path: Path, form: Format, value: Value) -> tuple[Linkage, Loads, float | None] | None:
    """The linkage of a file with its loads and speed; None where it has no loads."""
    from gruebler.base.documents import load_document
    from gruebler.files.linkages import read_loaded
    from gruebler.files.load_reading import loads_of_document
    from gruebler.mechanics.linkages import Linkage

    if not isinstance(value, Linkage):
        return None
    if form.name not in _DOCUMENTS:
        drawn = loads_document(path, form, value)
        return (value, *loads_of_document(drawn, value)) if drawn else None
    document = load_document(path, lambda problem: GrueblerError("{path}: {problem}", path=path, problem=problem))
    return read_loaded(path) if "loads" in document else None


def write_loaded(
    linkage: Linkage,
    loads: Loads,
    speed: float | None,
    path: Path,
    format_name: str | None,
    left_out: list[Message],
) -> None:
    """Write a linkage with its loads, which are left out where the format is not one of this library."""
    if format_of(path, format_name).name in _DOCUMENTS:
        from gruebler.files.linkages import write_linkage

        write_linkage(path, linkage, loads, speed)
    else:
        write(linkage, path, format_name=format_name, left_out=left_out)
        acting = (loads.forces, loads.moments, loads.springs, loads.torsion_springs, loads.motors)
        left_out += [message("loads")] if any(acting) else []
        left_out += [message("masses")] if loads.bodies or loads.masses else []
        left_out += [message("the speed of the drive")] if speed is not None else []
