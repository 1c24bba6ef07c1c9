"""The table of file formats: names, endings of files, what they carry, how they are read and written.

`files` looks a format up here; another format is another row of `FORMATS`.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gruebler.base.atomic_files import write_whole
from gruebler.base.documents import load_document
from gruebler.base.errors import GrueblerError, naming
from gruebler.base.text import Message, message, reason_of
from gruebler.files.documents import (
    drawn_linkage,
    function_of,
    linkage_to_write,
    read_own_document,
    read_task_or_curve,
    write_csv,
    write_own_document,
    write_parquet_table,
    write_spreadsheet,
)

if TYPE_CHECKING:
    from gruebler.mechanics.linkages import Linkage
    from gruebler.mechanics.screws import SpatialLinkage
    from gruebler.structure.chain import Chain


@dataclass(frozen=True, slots=True, kw_only=True)
class Format:
    """A row of the table of formats."""

    name: str
    suffixes: tuple[str, ...]
    """Endings of file names; without one the format is named."""
    title: Message
    """Whose format it is."""
    carries: Message
    """What it can carry."""
    read: Callable[[Path, list[Message]], Any] | None = None
    """The value in a file; the list gets a message for each thing that the value does not have."""
    write: Callable[[Any, Path, list[Message]], None]
    """Write a value; the list gets a message for each thing that the file does not have."""
    write_between: Callable[[Any, Path, list[Message], tuple[float, float]], None] | None = None
    """Write its motion between two values of the drive; None if the file has no motion."""
    lengths: Message | None = None
    """What the numbers of lengths are; None if there are none."""
    loads: Callable[[Path], Mapping[str, Any]] | None = None
    """What a file of another program has of a table ``[loads]``, with places in its drawing."""


_WITH_UNIT = message("with their unit")
_AS_MILLIMETRES = message("mm (the format has no unit)")
_HEADER = message("millimetres or inches, in the header")


def loads_document(path: Path, form: Format, linkage: Linkage) -> dict[str, Any]:
    """What another program's file says of what acts on its linkage, as `loads_of_document` takes it; else nothing."""
    table = {} if form.loads is None else form.loads(path)
    mechanism = linkage.mechanism
    bodies = {link: body for link, body in table.get("bodies", {}).items() if link in mechanism.chain.links}
    loads: dict[str, Any] = {"bodies": bodies} if bodies else {}
    speed = str(table.get("speed", ""))
    if speed and [drive.turning for drive in mechanism.drives] == [speed.endswith("rpm")]:
        loads["speed"] = speed
    drawn = [force for force in table.get("forces", ()) if force.link in mechanism.chain.links]
    if drawn and (poses := linkage.reference_pose):
        loads["forces"] = dict(force.load(poses[force.link]) for force in drawn)
    return {"loads": loads, "places": {}} if loads else {}


def _drawn(
    name: str, suffix: str, title: Message, carries: Message, lengths: Message, *, written_as: str = ""
) -> Format:
    """A row for a text of pins and slots: ``drawing_from_...`` of its module reads it, ``..._from_drawing`` writes."""
    module, called = name.replace("-", "_"), written_as or name

    def read(path: Path, left_out: list[Message]) -> Linkage:
        from gruebler.files.text_files import read_text

        text = read_text(path)
        return drawn_linkage(path, lambda: function_of(module, f"drawing_from_{called}")(text, left_out), left_out)

    def write(value: Any, path: Path, left_out: list[Message]) -> None:
        from gruebler.files.linkage_drawings import drawing_of

        drawing = drawing_of(linkage_to_write(value), left_out)
        write_whole(path, function_of(module, f"{called}_from_drawing")(drawing, left_out))

    def loads(path: Path) -> Mapping[str, Any]:
        from gruebler.files.text_files import read_text

        return function_of(module, f"drawing_from_{called}")(read_text(path), []).loads  # type: ignore[no-any-return]

    suffixes = (suffix,)
    return Format(
        name=name, suffixes=suffixes, title=title, carries=carries, read=read, write=write, lengths=lengths, loads=loads
    )


def _json_of_others(name: str, title: Message, carries: Message) -> Format:
    def read(path: Path, left_out: list[Message]) -> Linkage:
        data = load_document(path, lambda text: GrueblerError("{path}: {problem}", path=path, problem=text))
        if not function_of(name, f"is_{name}")(data):
            raise GrueblerError("{path}: is not a document of {program}", path=path, program=title)
        return drawn_linkage(path, partial(function_of(name, f"drawing_from_{name}"), data, left_out), left_out)

    def write(value: Any, path: Path, left_out: list[Message]) -> None:
        from gruebler.files.linkage_drawings import drawing_of

        document = function_of(name, f"{name}_from_drawing")(drawing_of(linkage_to_write(value), left_out), left_out)
        write_whole(path, json.dumps(document, indent=1) + "\n")

    return Format(name=name, suffixes=(), title=title, carries=carries, read=read, write=write, lengths=_AS_MILLIMETRES)


def _of_linkages(name: str, title: Message, carries: Message, lengths: Message, *, in_space: bool = False) -> Format:
    """A row for a text that is only written, by ``NAME_from_linkage`` in the module of its name."""

    def write(value: Any, path: Path, left_out: list[Message]) -> None:
        from gruebler.mechanics.screws import SpatialLinkage

        linkage = value if in_space and isinstance(value, SpatialLinkage) else linkage_to_write(value)
        write_whole(path, function_of(name, f"{name}_from_linkage")(linkage, left_out))

    return Format(name=name, suffixes=(f".{name}",), title=title, carries=carries, write=write, lengths=lengths)


def _write_dxf_of_links(value: Any, path: Path, left_out: list[Message]) -> None:
    """One file a link, in a folder."""
    from gruebler.files.dxf import dxf_of_links

    texts = dxf_of_links(linkage_to_write(value), left_out)
    _write_in_folder(path, {f"{name}.dxf": text for name, text in texts.items()})


def _write_in_folder(path: Path, files: Mapping[str, bytes | str]) -> None:
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise GrueblerError(
            "{path}: the folder cannot be made ({reason})", path=path, reason=reason_of(error)
        ) from None
    for name, content in files.items():
        write_whole(path / name, content)


def _write_glb(value: Any, path: Path, left_out: list[Message], between: tuple[float, float] | None = None) -> None:
    from gruebler.files.gltf import glb_from_linkage

    write_whole(path, glb_from_linkage(_in_space(value), left_out, between))


def _write_stl_of_links(value: Any, path: Path, left_out: list[Message]) -> None:
    from gruebler.files.gltf import stl_of_links

    _write_in_folder(
        path, {f"{link}.stl": content for link, content in stl_of_links(_in_space(value), left_out).items()}
    )


def _in_space(value: Any) -> SpatialLinkage:
    from gruebler.mechanics.screws import SpatialLinkage

    if not isinstance(value, SpatialLinkage):
        raise GrueblerError("bodies are written of linkages in space only; a plane linkage and a chain have none")
    return value


def _lines(name: str, suffix: str, title: Message, carries: Message) -> Format:
    def read(path: Path, left_out: list[Message]) -> list[Chain]:
        from gruebler.files.chain_files import read_lines

        del left_out
        return list(read_lines(path, name))

    def write(value: Any, path: Path, left_out: list[Message]) -> None:
        from gruebler.files.chain_files import write_lines

        write_lines(_chains_of(value, left_out), path, name)

    return Format(name=name, suffixes=(suffix, f"{suffix}.gz"), title=title, carries=carries, read=read, write=write)


def _graph(name: str, suffixes: tuple[str, ...], title: Message, carries: Message) -> Format:
    def read(path: Path, left_out: list[Message]) -> Chain:
        from gruebler.files.chain_files import chain_from_graph_text
        from gruebler.files.text_files import read_text

        del left_out
        text = read_text(path)
        with naming(path, GrueblerError):
            return chain_from_graph_text(text, name)

    def write(value: Any, path: Path, left_out: list[Message]) -> None:
        from gruebler.files.chain_files import graph_text

        chains = list(_chains_of(value, left_out))
        if len(chains) != 1:
            raise GrueblerError("{path}: the format holds one chain, not {count}", path=path, count=len(chains))
        write_whole(path, graph_text(chains[0], name, left_out))

    return Format(name=name, suffixes=suffixes, title=title, carries=carries, read=read, write=write)


def _chains_of(value: Any, left_out: list[Message]) -> Iterable[Chain]:
    """The chains to write: those given, or the chain of a linkage."""
    from gruebler.mechanics.linkages.conversion import makes_linkage
    from gruebler.structure.chain import Chain
    from gruebler.structure.mechanism import Mechanism

    if isinstance(value, Chain):
        return [value]
    mechanism = getattr(value.linkage() if makes_linkage(value) else value, "mechanism", None)
    if isinstance(mechanism, Mechanism):
        left_out.append(message("dimensions, frame and drives"))
        return [mechanism.chain]
    if isinstance(value, Sequence) and all(isinstance(each, Chain) for each in value):
        return value
    raise GrueblerError("a {kind} is not a chain", kind=type(value).__name__)


_PINS = message("one position of a linkage of pins, slides and slots, points, drives of pins on the frame; no wheels")
_ANY_CHAIN = message("one chain with any joints")

FORMATS: tuple[Format, ...] = (
    Format(
        name="toml",
        suffixes=(".toml",),
        title=message("gruebler, TOML"),
        carries=message("linkages in plane and space, tasks, gear trains (read), completely"),
        read=read_own_document,
        write=write_own_document,
        lengths=_WITH_UNIT,
    ),
    Format(
        name="json",
        suffixes=(".json",),
        title=message("gruebler, JSON; JSON of other programs is recognised"),
        carries=message("linkages in plane and space, tasks, chains, completely"),
        read=read_own_document,
        write=write_own_document,
        lengths=_WITH_UNIT,
    ),
    Format(
        name="csv",
        suffixes=(".csv",),
        title=message("gruebler, CSV; curves of four-bar-rs are recognised"),
        carries=message("synthesis tasks, completely; tables of motions with units in their headers (written)"),
        read=read_task_or_curve,
        write=write_csv,
        lengths=message("of tables with their unit, of tasks as they are"),
    ),
    _lines("text", ".txt", message("gruebler, texts of chains"), message("chains, one per line, with any joints")),
    _lines(
        "graph6",
        ".g6",
        message("nauty, House of Graphs"),
        message("chains, one per line: revolute joints, at most one between two links"),
    ),
    _lines("sparse6", ".s6", message("nauty"), message("chains, one per line: simple revolute joints")),
    _graph("graphml", (".graphml",), message("GraphML"), _ANY_CHAIN),
    _graph("gml", (".gml",), message("GML"), _ANY_CHAIN),
    _graph("dot", (".dot", ".gv"), message("Graphviz"), _ANY_CHAIN),
    _graph("edge-list", (".edgelist", ".edges"), message("edge list"), message("one chain with simple joints")),
    _graph("matrix", (".adj",), message("adjacency matrix"), message("one chain with simple revolute joints")),
    _drawn(
        "linkage2",
        ".linkage2",
        message("Linkage by D. Rector"),
        message("one position of a linkage of pins and slots, points, driven cranks, driven lengths of links"),
        message("1/96 inch, shown as mm or in"),
    ),
    _drawn(
        "pyslvs",
        ".pyslvs",
        message("Pyslvs"),
        message("one position of a linkage of pins, slides and slots, points; drives in comments"),
        _AS_MILLIMETRES,
    ),
    _drawn("pmks", ".pmks", message("PMKS+"), _PINS, message("cm, in or m, which the address says")),
    _drawn(
        "four-bar-rs",
        ".ron",
        message("four-bar-rs"),
        message("a four-bar with a driven crank and one coupler point"),
        _AS_MILLIMETRES,
        written_as="ron",
    ),
    _json_of_others(
        "motiongen",
        message("MotionGen"),
        message("one position of a linkage of pins, slides and slots, points, drives"),
    ),
    _json_of_others(
        "pylinkage",
        message("pylinkage"),
        message("one position of a linkage of pins, pins in slots of the frame, points, driven cranks on the frame"),
    ),
    _of_linkages(
        "dxf",
        message("CAD, laser cutters (DXF)"),
        message("plates of links of pins and slides with holes and slots, paths of points, in one position"),
        _HEADER,
    ),
    Format(
        name="dxf-links",
        suffixes=(),
        title=message("CAD, laser cutters (DXF), a file for each link"),
        carries=message("a folder of plates with holes and slots, one file per link, with its plane in the name"),
        lengths=_HEADER,
        write=_write_dxf_of_links,
    ),
    _of_linkages(
        "mjcf",
        message("MuJoCo"),
        message("a linkage of pins, slides and slots as a model that runs, points, drives"),
        message("m"),
    ),
    _of_linkages(
        "urdf",
        message("robots (URDF)"),
        message("a linkage in the plane or in space as a tree: its loops are cut"),
        message("m"),
        in_space=True,
    ),
    Format(
        name="glb",
        suffixes=(".glb",),
        title=message("glTF 2.0, viewers of bodies"),
        carries=message("bodies of the links of a linkage in space, an animation for each drive"),
        write=_write_glb,
        write_between=_write_glb,
        lengths=message("m"),
    ),
    Format(
        name="stl",
        suffixes=(),
        title=message("printers (STL), a file for each link"),
        carries=message("a folder of bodies, one file per link of a linkage in space, in the reference pose"),
        write=_write_stl_of_links,
        lengths=message("as they are; programs take them for mm"),
    ),
    Format(
        name="spreadsheet",
        suffixes=(),
        title=message("CSV for spreadsheets with decimal commas"),
        carries=message("tables of motions with units in their headers, semicolons between cells"),
        lengths=_WITH_UNIT,
        write=write_spreadsheet,
    ),
    Format(
        name="parquet",
        suffixes=(".parquet",),
        title=message("Parquet"),
        carries=message("tables of motions with units in their headers"),
        lengths=_WITH_UNIT,
        write=write_parquet_table,
    ),
)
"""Every format, those of this library first."""
