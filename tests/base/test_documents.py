"""Records of plain data: what does not fit is told with its key and value, and what was expected."""

from typing import Literal

import msgspec
import pytest

from gruebler.base.documents import convert_document
from gruebler.base.errors import GrueblerError
from gruebler.base.text import error_in_language


class Spring(msgspec.Struct, forbid_unknown_fields=True):
    kind: Literal["steel", "gas"] = "steel"
    length: float = 0.0


class Record(msgspec.Struct, forbid_unknown_fields=True):
    length: float | None = None
    teeth: int = 0
    names: str | tuple[str, ...] | None = None
    curve: list[tuple[float, float]] = []
    masses: dict[str, float] = {}
    springs: list[Spring] = []


@pytest.mark.parametrize(
    ("data", "english", "german"),
    [
        (
            {"length": "20 mm"},
            "length: expected a number without a unit, but found '20 mm'",
            "length: erwartet wird eine Zahl ohne Einheit, nicht '20 mm'",
        ),
        (
            {"length": "long"},
            "length: expected a number, but found 'long'",
            "length: erwartet wird eine Zahl, nicht 'long'",
        ),
        (
            {"length": [20]},
            "length: expected a number, but found a list",
            "length: erwartet wird eine Zahl, nicht eine Liste",
        ),
        (
            {"teeth": True},
            "teeth: expected a whole number, but found true",
            "teeth: erwartet wird eine ganze Zahl, nicht true",
        ),
        (
            {"names": 3},
            "names: expected a text or a list, but found 3",
            "names: erwartet wird ein Text oder eine Liste, nicht 3",
        ),
        (
            {"curve": [[1, 2], [1, 2, 3]]},
            "curve[1]: expected 2 values, but found 3",
            "curve[1]: erwartet werden 2 Werte, nicht 3",
        ),
        (
            {"masses": {"crank": "1 kg"}},
            "masses[...]: expected a number, but found a text",
            "masses[...]: erwartet wird eine Zahl, nicht ein Text",
        ),
        (
            {"springs": [{"kind": "rubber"}]},
            "springs[0].kind: expected 'steel' or 'gas', but found 'rubber'",
            "springs[0].kind: erwartet wird 'steel' oder 'gas', nicht 'rubber'",
        ),
        (
            {"springs": [{"length": "-3 m"}]},
            "springs[0].length: expected a number without a unit, but found '-3 m'",
            "springs[0].length: erwartet wird eine Zahl ohne Einheit, nicht '-3 m'",
        ),
    ],
)
def test_values_that_do_not_fit(data, english, german):
    with pytest.raises(GrueblerError) as refusal:
        convert_document(data, Record, GrueblerError)
    assert (str(refusal.value), error_in_language(refusal.value, "de")) == (english, german)
