"""Orientations of a body that turns about a fixed point, in files: rows of an axis and an angle in degrees.

docs/theory/synthesis-sphere.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import msgspec
import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.documents import convert_document, load_document
from gruebler.base.errors import SynthesisError, naming
from gruebler.files.tasks import counting_from_one


class _Orientations(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    orientations: list[list[Any]]


def rotation(x: float, y: float, z: float, angle: float) -> Reals:
    """(3, 3) the rotation about an axis through the origin, by Rodrigues; any axis where the angle is 0.

    >>> rotation(0, 0, 2, np.pi / 2).round(9).tolist()
    [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
    """
    axis = np.array([x, y, z]) / (np.sqrt(x * x + y * y + z * z) or 1.0)
    cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross)


def read_orientations(path: Path | str) -> Reals:
    """(targets, 3, 3) the rotation matrices of a ``.toml`` or ``.json`` file with rows ``[x, y, z, degrees]``.

    Raises `SynthesisError` with the file and the number of the first row that does not fit.
    """
    path = Path(path)
    if path.suffix.lower() not in (".toml", ".json"):
        raise SynthesisError("{path}: orientations are in a .toml or .json file", path=path)
    with naming(path, SynthesisError):
        record = convert_document(load_document(path, SynthesisError), _Orientations, counting_from_one)
        turns = [_checked(row, k) for k, row in enumerate(record.orientations, 1)]
        if not 3 <= len(turns) <= 5:
            raise SynthesisError("expected three to five orientations, but found {count}", count=len(turns))
        return np.array(turns)


def _checked(row: Sequence[Any], number: int) -> Reals:
    numbers = all(isinstance(value, int | float) and not isinstance(value, bool) for value in row)
    if len(row) != 4 or not numbers or not np.isfinite(row).all() or not (any(row[:3]) or row[3] == 0):
        raise SynthesisError(
            "orientation {number}: expected an axis and an angle in degrees, [x, y, z, angle], but found {row}",
            number=number,
            row=str(list(row))[:60],
        )
    x, y, z, angle = map(float, row)
    return rotation(x, y, z, np.radians(angle))
