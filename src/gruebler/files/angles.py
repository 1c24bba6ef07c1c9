"""Angles in degrees as files have them, in radians as the library has them, without losing a bit on the way.

The nearest radians to a number of degrees are computed with sixty digits and rounded once. Not every double in radians
is the nearest to a double in degrees (about one in ten is not); such an angle is written as a text with more digits.
"""

from __future__ import annotations

from decimal import Context, Decimal, InvalidOperation
from math import isfinite

_EXACT = Context(prec=60)
_RADIAN = _EXACT.divide(Decimal(180), Decimal("3.14159265358979323846264338327950288419716939937510582097494459"))
_LONGEST = 60  # characters of an angle written as a text


def in_radians(degrees: float | str) -> float:
    """The double nearest to an angle given in degrees; `ValueError` for what is no finite number.

    >>> in_radians(90), in_radians("90")
    (1.5707963267948966, 1.5707963267948966)
    """
    if isinstance(degrees, bool) or not isinstance(degrees, int | float | str) or len(str(degrees)) > _LONGEST:
        raise ValueError(degrees)
    try:
        exact = Decimal(degrees)
        if not exact.is_finite() or abs(exact.adjusted()) > 400:
            raise ValueError(degrees)
        radians = float(_EXACT.divide(exact, _RADIAN))
    except (InvalidOperation, OverflowError):
        raise ValueError(degrees) from None
    if not isfinite(radians):
        raise ValueError(degrees)
    return radians


def in_degrees(radians: float) -> float | str:
    """The shortest number of degrees whose nearest radians are these; a text where no double has enough digits.

    >>> in_degrees(1.5707963267948966), in_degrees(in_radians(55.3))
    (90.0, 55.3)
    """
    exact = _EXACT.multiply(Decimal(radians), _RADIAN)
    for digits in range(1, 25):
        text = str(Context(prec=digits).plus(exact))
        if in_radians(float(text)) == radians:
            return float(text)
        if digits > 16 and in_radians(text) == radians:
            return text
    raise AssertionError(f"no degrees for {radians!r}")  # 25 digits tell any double
