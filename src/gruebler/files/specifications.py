"""Specifications in files: a task with its demands, the mechanisms that are tried, and what is to be kept clear of.

docs/theory/synthesis-types.md has every key; a file with the keys of a task alone is a specification, too.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import radians
from pathlib import Path
from typing import Any

import msgspec

from gruebler.base.documents import convert_document, load_document
from gruebler.base.errors import SynthesisError, naming
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.specification import Clearance, Specification
from gruebler.files.tasks import counting_from_one, read_task, task_from_json


class _Demands(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    crank: bool = False
    transmission: float = 0.0
    size_ratio: float = Demands.size_ratio
    region: tuple[float, float, float, float] | None = None
    lengths: dict[str, float] = {}
    frame_direction: float | None = None
    near_pivots: list[tuple[float, float]] = []
    tolerance: float = Demands.tolerance
    one_branch: bool = True
    in_order: bool = True


class _Clearance(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    body: tuple[tuple[float, float], ...]
    obstacle: tuple[tuple[float, float], ...]
    distance: float = 0.0


class _Specification(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    links: int = 6
    sliding_joints: int | None = None
    demands: _Demands = _Demands()
    clear: list[_Clearance] = []


def specification_from_json(document: Mapping[str, Any]) -> Specification:
    """The specification of plain data: the keys of a task, ``links``, ``sliding_joints``, ``demands``, ``clear``.

    Raises `SynthesisError` with the key of the first thing that does not fit.

    >>> document = {"swing": 60, "time_ratio": 1.2, "links": 4, "demands": {"transmission": 40}}
    >>> round(specification_from_json(document).demands.transmission, 4)
    0.6981
    """
    own = {name: document[name] for name in _Specification.__struct_fields__ if name in document}
    record = convert_document(own, _Specification, counting_from_one)
    task = task_from_json({name: value for name, value in document.items() if name not in own})
    values = msgspec.structs.asdict(record.demands)
    for name in ("transmission", "frame_direction"):  # in degrees there
        values[name] = None if values[name] is None else radians(values[name])
    return Specification(
        task,
        demands=Demands(**values),
        links=record.links,
        sliding_joints=record.sliding_joints,
        clear=tuple(Clearance(row.body, obstacle=row.obstacle, distance=row.distance) for row in record.clear),
    )


def read_specification(path: Path | str) -> Specification:
    """The specification in a ``.toml`` or ``.json`` file; a ``.csv`` file has a task alone.

    Raises `SynthesisError` with file and key of the first thing that does not fit.
    """
    path = Path(path)
    if path.suffix.lower() not in (".toml", ".json"):
        return Specification(read_task(path))
    with naming(path, SynthesisError):
        return specification_from_json(load_document(path, SynthesisError))
