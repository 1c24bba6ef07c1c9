"""Values as plain data: units by name, records within records, texts, NaN."""

from dataclasses import dataclass, field
from enum import StrEnum
from fractions import Fraction
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


def test_angles_in_degrees_places_and_lists_of_records() -> None:
    assert plain([Leg(pi), Leg(-pi / 2)], "angle_deg hidden") == [
        {"angle_deg": 180.0, "hidden": 7},
        {"angle_deg": -90.0, "hidden": 7},
    ]
    assert plain(None, "angle_deg") is None
    assert plain({"at": 3 - 4j, "half": Fraction(1, 2)}, units={"half": float}) == {
        "at": [3.0, -4.0],
        "half": Fraction(1, 2),
    }
    assert plain(Leg(Fraction(1, 2)), "angle", units={"angle": str}) == {"angle": "1/2"}
