"""The columns of the atlas: one table says name, type, unit, meaning and origin of each.

Definitions and theorems: docs/theory/atlas.md. The same texts stand in the metadata of every file.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

from gruebler.base.errors import GrueblerError

if TYPE_CHECKING:
    import pyarrow as pa

SCHEMA = 2
"""The version of the columns; a change of a column or of its meaning raises it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SchemaColumn:
    """A column of a table."""

    table: str
    name: str
    type: str
    """``int16``, ``int32``, ``int64``, ``bool``, ``string``, ``list<...>``; with ``?`` if it may be empty."""
    unit: str
    definition: str
    origin: str


_FIELDS = tuple(field.name for field in fields(SchemaColumn))

_DESCRIBED = "_core.describe_chains"

COLUMNS: tuple[SchemaColumn, ...] = tuple(
    SchemaColumn(**dict(zip(_FIELDS, row, strict=True)))
    for row in (
        ("chains", "links", "int16", "links", "number of links n", "request"),
        ("chains", "mobility", "int16", "freedoms", "F = 3(n - 1) - 2 g1, all joints turning or sliding", "request"),
        ("chains", "loops", "int16", "loops", "independent loops, (n - 1 - F)/2", "enumeration.assortment"),
        ("chains", "joints", "int16", "joints", "number of joints, a multiple joint counted once", "the chain"),
        ("chains", "multiple_joints", "int16", "joints", "joints of three links or more", "the chain"),
        ("chains", "prismatic", "int16", "joints", "sliding joints; all others turn", "type_synthesis.joint_types"),
        (
            "chains",
            "fractionated",
            "string",
            "",
            "none, link or joint: where the chain falls apart",
            "enumeration.fractionation",
        ),
        ("chains", "assortment", "string", "links", "numbers of links with 2, 3, ... joints, such as 4,4", "the chain"),
        ("chains", "graph6", "string?", "", "the chain as graph6, links in canonical order; simple joints", _DESCRIBED),
        ("chains", "code", "string", "", "canonical code, equal exactly for chains of one structure", "isomorphism"),
        (
            "chains",
            "contracted_graph",
            "int32?",
            "",
            "number of the contracted graph among those of as many loops, from 0; if not fractionated, with simple "
            "joints, of two loops or more",
            "enumeration.contracted_graphs",
        ),
        (
            "chains",
            "contracted_code",
            "string?",
            "",
            "its bundles: node-node, and x and the number of strings if there are several",
            "enumeration.ContractedGraph",
        ),
        ("chains", "group_order", "int64", "", "number of automorphisms", "isomorphism.labelling"),
        ("chains", "inversions", "int32", "", "orbits of links: mechanisms by choice of the frame", _DESCRIBED),
        ("chains", "joint_orbits", "int32", "", "orbits of joints", _DESCRIBED),
        ("chains", "drives", "int32", "", "orbits of (frame, joint at it, link that the joint drives)", _DESCRIBED),
        ("chains", "planar", "bool", "", "whether the graph of links can be drawn without crossings", "networkx"),
        (
            "chains",
            "crossings",
            "int16?",
            "crossings",
            "fewest crossings of joints in a drawing of the graph, 0 or 1; empty for more",
            "atlas.crossings",
        ),
        ("chains", "smallest_circuit", "int16", "links", "links of the shortest closed circuit", _DESCRIBED),
        ("chains", "largest_circuit", "int16", "links", "links of the longest one that repeats no link", _DESCRIBED),
        ("chains", "diameter", "int16", "joints", "most joints on a shortest path between two links", _DESCRIBED),
        ("chains", "dyadic", "bool", "", "whether it grows from a single loop by dyads", _DESCRIBED),
        (
            "chains",
            "certificate",
            "string?",
            "",
            "a digit 0, 1, 2 for each joint of the code in turn; without the joints of any one digit the others make a "
            "forest, which proves that no part is overconstrained; simple turning joints",
            _DESCRIBED,
        ),
        ("mechanisms", "links", "int16", "links", "number of links", "the chain"),
        ("mechanisms", "mobility", "int16", "freedoms", "F of the chain", "the chain"),
        ("mechanisms", "chain", "string", "", "code of the chain", "table chains"),
        ("mechanisms", "frame", "int16", "", "the frame: a link of that code, the least of its orbit", "isomorphism"),
        ("mechanisms", "frame_joints", "int16", "joints", "number of joints at the frame", "the chain"),
        ("mechanisms", "orbit", "int16", "links", "links of the chain that give this mechanism", "isomorphism"),
        ("mechanisms", "family", "string?", "", "name of the family, such as Watt I", "mechanism.family"),
        ("driven", "links", "int16", "links", "number of links", "the chain"),
        ("driven", "mobility", "int16", "freedoms", "F of the chain, as many drives", "the chain"),
        ("driven", "chain", "string", "", "code of the chain", "table chains"),
        ("driven", "frame", "int16", "", "the frame: number of a link in that code", "isomorphism"),
        (
            "driven",
            "drives",
            "string",
            "",
            "each driven joint by the two links that it moves against each other, such as 0-3",
            "mechanism.driven_mechanisms",
        ),
        ("driven", "at_frame", "bool", "", "whether every drive acts on the frame", "mechanism.driven_mechanisms"),
        ("driven", "groups", "list<string>", "", "forms of the Assur groups in solving order", "assur.decompose"),
        ("driven", "classes", "list<int16>", "", "their classes", "assur.decompose"),
        ("driven", "orders", "list<int16>", "", "their orders: numbers of outer joints", "assur.decompose"),
        ("driven", "highest_class", "int16", "", "the highest of the classes", "assur.decompose"),
        ("driven", "dyads_only", "bool", "", "whether all groups are dyads", "assur.decompose"),
        (
            "driven",
            "assembly_modes",
            "int64?",
            "",
            "assembly modes at almost all dimensions, complex ones included: product over the groups; turning joints",
            "assur.count_modes",
        ),
        ("driven", "family", "string?", "", "name of the family", "mechanism.family"),
    )
)

TABLES: tuple[str, ...] = tuple(dict.fromkeys(column.table for column in COLUMNS))


def columns_of(table: str) -> tuple[SchemaColumn, ...]:
    """The columns of a table, in their order.

    >>> [column.name for column in columns_of("mechanisms")][:4]
    ['links', 'mobility', 'chain', 'frame']
    """
    return tuple(column for column in COLUMNS if column.table == table)


def arrow_library() -> Any:
    """The library of Arrow tables; `GrueblerError` if it is not installed."""
    try:
        import pyarrow
        import pyarrow.compute
        import pyarrow.parquet
    except ImportError:
        raise GrueblerError("the atlas needs pyarrow: pip install 'gruebler[atlas]'") from None
    return pyarrow


def arrow_schema(table: str, **metadata: str) -> pa.Schema:
    """The columns of a table for Arrow; unit, definition and origin are metadata of each field."""
    pa = arrow_library()

    def kind(name: str) -> Any:
        if name.startswith("list<"):
            return pa.list_(pa.field("element", kind(name[5:-1]), nullable=False))
        return {"string": pa.string(), "bool": pa.bool_()}.get(name) or getattr(pa, name)()

    return pa.schema(
        [
            pa.field(
                column.name,
                kind(column.type.rstrip("?")),
                nullable=column.type.endswith("?"),
                metadata={"unit": column.unit, "definition": column.definition, "origin": column.origin},
            )
            for column in columns_of(table)
        ],
        metadata=metadata,
    )
