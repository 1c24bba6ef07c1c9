"""Values as plain data: units by name, records within records, texts, NaN."""

from dataclasses import dataclass, field
from enum import StrEnum
from math import degrees, nan, pi

import numpy as np

from gruebler.base.errors import GrueblerError
from gruebler.base.plain_data import plain
from gruebler.base.text import Message, message


class Colour(StrEnum):
    RED = "red"


@dataclass
class Leg:
    angle: float
    hidden: int = 7

    @property
    def double(self) -> float:
        return 2 * self.angle


@dataclass
class Body:
    legs: tuple[Leg, ...]
    angle: float | None
    text: Message = field(default_factory=lambda: message("dead centre"))
    why: GrueblerError = field(default_factory=lambda: GrueblerError("no {what}", what="way"))


def test_units_reach_records_within_records_and_none_stays_none() -> None:
    body = Body((Leg(pi), Leg(pi / 4)), None)
    units, shown = {"angle": degrees, "double": degrees}, {Leg: "angle double"}
    assert plain(body, units=units, shown=shown) == {
        "legs": [{"angle": 180.0, "double": 360.0}, {"angle": 45.0, "double": 90.0}],
        "angle": None,
        "text": "dead centre",
        "why": "no way",
    }
    assert plain(body, "legs") == {"legs": [{"angle": pi, "hidden": 7}, {"angle": pi / 4, "hidden": 7}]}
    assert plain(body, "text", text=lambda text: text.in_language("de")) == {"text": "Totlage"}


def test_numbers_that_are_none_and_other_kinds() -> None:
    values = {"a": nan, "b": [True, Colour.RED, 2], 3: np.array([[1.0, 2.0]])}
    assert plain(values) == {"a": None, "b": [True, "red", 2], "3": [[1.0, 2.0]]}
    assert type(plain(Colour.RED)) is str
