"""The work of an atlas, divided into parts: each part becomes one file of every table.

The parts of a task and their order are always the same, and so are the bytes of their files. A part is plain data;
`PartWriter` is a function of a part that any worker can run, and run again: its files appear complete or not at all.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence
from dataclasses import KW_ONLY, dataclass, fields, replace
from hashlib import sha256
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from gruebler.base.atomic_files import atomic_file
from gruebler.base.errors import GrueblerError, RunError
from gruebler.structure.atlas.chain_table import ChainArrays, Contracted, arrays_of_chains, chain_table
from gruebler.structure.atlas.mechanism_tables import bulk_tables, driven_table, mechanism_table
from gruebler.structure.atlas.schema import SCHEMA, arrow_library, arrow_schema
from gruebler.structure.chain import Chain
from gruebler.structure.enumeration.assortment import joint_count, loop_count
from gruebler.structure.enumeration.contracted import unpacked
from gruebler.structure.enumeration.fractionated import BlockAddition
from gruebler.structure.enumeration.pieces import WorkPiece, census, list_piece
from gruebler.structure.enumeration.request import Request
from gruebler.structure.enumeration.work_units import MultipleJointPiece, RingPiece, Work, chains_of_piece, work_units
from gruebler.structure.type_synthesis import joint_types

if TYPE_CHECKING:
    import pyarrow as pa

_SIZE = 1_000_000  # work of a piece, see `pieces.WorkPiece`: some ten thousand chains, seconds
_DRIVES = 500_000  # driven mechanisms made at a time: half a gigabyte
_AT_ONCE = {WorkPiece: 1, RingPiece: 1, BlockAddition: 64, MultipleJointPiece: 1}  # pieces in a part
_CHECKED = ("inversions", "joint_orbits", "drives")  # columns whose sums the enumeration counts as well


@dataclass(frozen=True, slots=True)
class AtlasTask:
    """What an atlas contains.

    Raises `GrueblerError` for invalid values.

    >>> [(request.links, request.mobility) for request in AtlasTask("4-8", mobility="1-2").requests()]
    [(4, 1), (6, 1), (8, 1), (5, 2), (7, 2)]
    """

    links: str
    """A number of links or a range, such as ``4-10``."""
    _: KW_ONLY
    mobility: str = "1"
    """F, or a range."""
    fractionated: str = "none"
    """As `enumeration.Request`: ``none``, ``link``, ``joint`` or ``all``."""
    multiple_joints: str = "0"
    """As `enumeration.Request`: a number, a range or ``any``."""
    prismatic: str = "0"
    """The number of sliding joints, or a range."""
    inversions: bool = False
    """Whether to list the mechanisms."""
    drives: str = "none"
    """Driven mechanisms: ``none``, with drives at the ``frame``, or with ``any`` drives."""

    def __post_init__(self) -> None:
        for name in ("links", "mobility", "prismatic"):
            first, last = _range(name, getattr(self, name))
            if first > last:
                raise GrueblerError(
                    "{name}: the range {found} ends before it begins", name=name, found=f"{first}-{last}"
                )
        if self.drives not in ("none", "frame", "any"):
            raise GrueblerError("drives are none, frame or any, not {found!r}", found=self.drives)
        for _ in self.requests():
            break
        else:
            raise GrueblerError(
                "there is no chain of {links} links with mobility {mobility}: n + F is odd, n at least F + 3",
                links=self.links,
                mobility=self.mobility,
            )
        if all(self.sliding[0] > (joint_count(request.links, request.mobility) or 0) for request in self.requests()):
            raise GrueblerError(
                "no chain of {links} links has {count} sliding joints", links=self.links, count=self.sliding[0]
            )

    @property
    def tables(self) -> tuple[str, ...]:
        """The tables that are made."""
        return ("chains", *(["mechanisms"] if self.inversions else []), *(["driven"] if self.drives != "none" else []))

    @property
    def sliding(self) -> range:
        """The numbers of sliding joints."""
        first, last = _range("prismatic", self.prismatic)
        return range(first, last + 1)

    def requests(self) -> Iterator[Request]:
        """The requests of the enumeration: by mobility, then by links."""
        first, last = _range("links", self.links)
        least, most = _range("mobility", self.mobility)
        for mobility in range(least, most + 1):
            for links in range(max(first, 3), last + 1):
                if loop_count(links, mobility) is not None:
                    yield Request(
                        links,
                        mobility=mobility,
                        fractionated=self.fractionated,
                        assortment=None,
                        multiple_joints=self.multiple_joints,
                    )

    def covers(self, links: int, mobility: int, prismatic: int, multiple_joints: int) -> bool:
        """Whether the atlas has all chains of these numbers, fractionated ones included.

        >>> task = AtlasTask("4-8", mobility="1-2")
        >>> task.covers(7, 2, 0, 0), replace(task, fractionated="all").covers(7, 2, 0, 0)
        (False, True)
        """
        every = [request for request in self.requests() if (request.links, request.mobility) == (links, mobility)]
        for request in every:
            whole = request.classes == replace(request, fractionated="all").classes
            fewest, most = request.joints_range
            if whole and prismatic in self.sliding and fewest <= multiple_joints <= (links if most is None else most):
                return True
        return False

    @staticmethod
    def of_command(text: str) -> AtlasTask:
        """The task of a command that makes an atlas.

        Raises `GrueblerError` for another text.

        >>> AtlasTask.of_command(AtlasTask("4-8", inversions=True).command()) == AtlasTask("4-8", inversions=True)
        True
        """
        pattern = r"gruebler atlas build((?: --[a-z-]+(?: [\w-]+)?)*) DIR"
        if (match := re.fullmatch(pattern, text)) is None:
            raise GrueblerError("{text!r} is not a command that builds an atlas", text=text)
        flags = re.findall(r"--([a-z-]+)(?: (\w[\w-]*))?", match[1])
        options: dict[str, Any] = {name.replace("-", "_"): value or True for name, value in flags}
        if not {"links"} <= set(options) <= {field.name for field in fields(AtlasTask)}:
            raise GrueblerError("{text!r} is not a command that builds an atlas", text=text)
        return AtlasTask(**options)

    def command(self) -> str:
        """The command that makes the atlas."""
        words = ["gruebler atlas build", f"--links {self.links}", f"--mobility {self.mobility}"]
        if self.fractionated != "none":
            words.append(f"--fractionated {self.fractionated}")
        if self.multiple_joints != "0":
            words.append(f"--multiple-joints {self.multiple_joints}")
        if self.prismatic != "0":
            words.append(f"--prismatic {self.prismatic}")
        if self.inversions:
            words.append("--inversions")
        if self.drives != "none":
            words.append(f"--drives {self.drives}")
        return " ".join([*words, "DIR"])


def _range(name: str, text: str) -> tuple[int, int]:
    match = re.fullmatch(r"(\d{1,6})(?:-(\d{1,6}))?", str(text))
    if match is None:
        raise GrueblerError(
            "{name}: expected a number or a range such as 4-10, but found {found!r}", name=name, found=text
        )
    return int(match[1]), int(match[2] or match[1])


@dataclass(frozen=True, slots=True)
class Part:
    """A part of an atlas."""

    request: Request
    number: int
    """Among the parts of this request."""
    work: tuple[Work, ...]
    first_graph: int
    """The number of its first contracted graph, where it has some."""

    def path(self, table: str) -> str:
        """The file of a table, within the directory of the atlas."""
        where = f"{table}/mobility={self.request.mobility}/links={self.request.links}"
        return f"{where}/part-{self.number:05d}.parquet"


@dataclass(frozen=True, slots=True, kw_only=True)
class PartFile:
    """A finished file."""

    table: str
    path: str
    mobility: int
    links: int
    rows: int
    bytes: int
    sha256: str
    sums: dict[str, int]
    """Sums of the columns that the enumeration counts as well."""


def parts(task: AtlasTask) -> Iterator[Part]:
    """The parts of a task, lazily."""
    for request in task.requests():
        graphs = 0
        work = work_units(request, size=_SIZE)
        for number, piece in enumerate(work):
            some = (piece, *islice(work, _AT_ONCE[type(piece)] - 1))
            yield Part(request, number, some, graphs)
            graphs += len(piece.graphs) if isinstance(piece, WorkPiece) else 0


@dataclass(frozen=True, slots=True)
class PartWriter:
    """Makes the files of a part in a worker."""

    directory: Path
    task: AtlasTask
    identity: str
    """What the files belong to: kept in their metadata."""

    def __call__(self, part: Part) -> list[PartFile]:
        """Write the files that do not exist yet; returns all of them."""
        existing = self.existing(part)
        if existing is not None:
            return existing
        tables = {"chains": self._chains(part)}
        if len(self.task.tables) > 1:
            tables |= self._mechanisms(part.request, tables["chains"])
        for name in self.task.tables:
            table = tables[name]
            path = self.directory / part.path(name)
            path.parent.mkdir(parents=True, exist_ok=True)
            write_parquet(table, path, {"atlas": self.identity, "part": part.path(name)})
        return [self._described(part, name) for name in self.task.tables]

    def _mechanisms(self, request: Request, chains: pa.Table) -> dict[str, pa.Table]:
        """The tables of mechanisms and driven mechanisms, as far as they are wanted."""
        plain = request.only_simple and request.mobility == 1 and self.task.sliding == range(1)
        if plain and self.task.drives != "any":
            slices = (bulk_tables(some, driven=self.task.drives == "frame") for some in _slices(chains))
            if tables := [each for each in slices if each is not None]:
                return {name: arrow_library().concat_tables([each[name] for each in tables]) for name in tables[0]}
        codes = chains.column("code").to_pylist()
        chunks = {}
        if self.task.inversions:
            chunks["mechanisms"] = mechanism_table(codes, request.mobility)
        if self.task.drives != "none":
            chunks["driven"] = driven_table(codes, request.mobility, at_frame=self.task.drives == "frame")
        return chunks

    def existing(self, part: Part) -> list[PartFile] | None:
        """The files of a part if all of them are there and undamaged, else None.

        Raises `RunError` for files that belong to something else.
        """
        files = []
        for name in self.task.tables:
            if not (self.directory / part.path(name)).exists():
                return None
            try:
                files.append(self._described(part, name))
            except _DamagedError:
                return None
        return files

    def _described(self, part: Part, name: str) -> PartFile:
        path = part.path(name)
        table, content = read_part(self.directory / path)
        metadata = table.schema.metadata or {}
        if metadata.get(b"atlas") != self.identity.encode() or metadata.get(b"part") != path.encode():
            raise RunError(
                "{path} is not a file of this atlas; give another directory or remove it", path=self.directory / path
            )
        sums = (
            {column: int(np.sum(table.column(column).to_numpy(), dtype=np.int64)) for column in _CHECKED}
            if (name == "chains")
            else {}
        )
        digest = sha256(content).hexdigest()
        request = part.request
        return PartFile(
            table=name,
            path=path,
            mobility=request.mobility,
            links=request.links,
            rows=table.num_rows,
            bytes=len(content),
            sha256=digest,
            sums=sums,
        )

    def _chains(self, part: Part) -> pa.Table:
        request = part.request
        tables = []
        for piece in part.work:
            if isinstance(piece, WorkPiece) and self.task.sliding == range(1):
                tables.append(_simple_chains(piece, part.first_graph))
                continue
            chains, kinds = _typed(request, piece, self.task.sliding)
            if chains:
                tables.append(chain_table(arrays_of_chains(request.links, request.mobility, chains), kinds))
        return arrow_library().concat_tables(tables) if tables else arrow_schema("chains").empty_table()


def _simple_chains(piece: WorkPiece, first_graph: int) -> pa.Table:
    """The rows of a piece of contracted graphs, checked against their numbers by Burnside's lemma."""
    edges = list_piece(piece)
    numbers = census(piece, orbits=True)[:, 1:]
    graph = np.repeat(np.arange(len(piece.graphs), dtype=np.int32), numbers[:, 0])
    contracted = Contracted(graph + np.int32(first_graph), tuple(map(unpacked, piece.graphs)), first_graph)
    sums = numbers.sum(axis=0).tolist()
    table = None
    if sums[0] == len(edges):
        table = chain_table(ChainArrays.of_edges(piece.links, piece.mobility, edges), "none", contracted)
    if table is None or sums[1:] != [int(table.column(name).to_numpy().sum()) for name in _CHECKED]:
        raise RunError(
            "the chains of {links} links that are listed and those that are counted differ; please report this",
            links=piece.links,
        )
    return table


def _slices(chains: pa.Table) -> Iterator[pa.Table]:
    """The rows of a table of chains, some at a time, so that their mechanisms fit into memory."""
    drives = np.cumsum(chains["drives"].to_numpy())
    begin = 0
    while begin < len(drives):
        before = int(drives[begin - 1]) if begin else 0
        end = max(begin + 1, int(np.searchsorted(drives, before + _DRIVES, "right")))
        yield chains.slice(begin, end - begin)
        begin = end


def _typed(request: Request, piece: Work, sliding: Sequence[int]) -> tuple[list[Chain], list[str]]:
    """The chains of a piece with these numbers of sliding joints, and how they are fractionated."""
    chains: list[Chain] = []
    kinds: list[str] = []
    for kind, chain in _listed(request, piece):
        simple = sum(joint.count == 1 for joint in chain.joints)
        for number in sliding:
            if number > simple:
                break
            typed = list(joint_types(chain, {"prismatic": number})) if number else [chain]
            chains += typed
            kinds += [kind] * len(typed)
    return chains, kinds


def _listed(request: Request, piece: Work) -> Iterator[tuple[str, Chain]]:
    if isinstance(piece, WorkPiece):
        for edges in list_piece(piece).tolist():
            yield "none", Chain([("revolute", edge) for edge in edges], links=range(piece.links))
    else:
        yield from chains_of_piece(request, piece)


# --- files -------------------------------------------------------------------------------------------


class _DamagedError(Exception):
    """A file that cannot be read as a whole."""


def write_parquet(table: pa.Table, path: Path, metadata: dict[str, str]) -> None:
    """Write a table as a Parquet file that appears complete or not at all; equal tables give equal bytes."""
    pa = arrow_library()
    table = table.replace_schema_metadata({"schema": str(SCHEMA), **metadata})
    with atomic_file(path) as file:
        pa.parquet.write_table(
            table,
            file,
            compression="zstd",
            compression_level=6,
            row_group_size=131072,
            write_page_checksum=True,
            version="2.6",
        )


def read_part(path: Path) -> tuple[pa.Table, bytes]:
    """A file and its bytes, all checksums tested.

    Raises:
        RunError: it cannot be read.
    """
    pa = arrow_library()
    try:
        content = path.read_bytes()
    except OSError as error:
        from gruebler.base.text import reason_of

        raise RunError("{path} cannot be read: {reason}", path=path, reason=reason_of(error)) from None
    try:
        return pa.parquet.read_table(pa.BufferReader(content), page_checksum_verification=True), content
    except (pa.ArrowException, OSError):
        raise _DamagedError from None


def identity_of(task: AtlasTask, version: str) -> str:
    """The text that tells the files of this task and version from others."""
    return json.dumps(
        {"schema": SCHEMA, "version": version, "pyarrow": arrow_library().__version__, "command": task.command()}
    )
