"""Transmission angles of four-bars and slider-cranks at their extremes, step by step."""

from __future__ import annotations

from math import acos, asin, degrees, isclose, pi

from gruebler.base.errors import LinkageError
from gruebler.base.text import Readable, message
from gruebler.mechanics.analysis import measures
from gruebler.mechanics.fourbar import SliderCrank
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages import Linkage
from gruebler.teaching.exercises.solution import (
    Solution,
    SolutionBuilder,
    angle,
    figure,
    formula_number,
    with_turning_crank,
)

_SMALLEST = message("smallest transmission angle")
_LARGEST = message("largest transmission angle")
_DEVIATION = message("largest deviation angle")
_RATIO = message("ratio of crank to connecting rod")
_FOLD = message("A transmission angle is at most 90°: what lies above is taken from 180°.")
_IS_DEVIATION = message("That is the deviation angle α; μ = 90° - α.")


def four_bar(a: float, b: float, c: float, d: float, unit: str = "mm") -> Solution:
    """The transmission angle of a four-bar with turning crank in its two frame positions.

    >>> round(four_bar(2, 5, 4, 5).number("μ_min"), 6)
    36.869898
    """
    size = with_turning_crank(a, b, c, d)
    builder = SolutionBuilder(unit=unit)
    builder.say(
        "The transmission angle is extreme where the crank lies on the frame line: the distance A-B0 is d - "
        "a or d + a.",
        "(d ∓ a)² = b² + c² - 2·b·c·cos μ",
    )
    folded, deviations = [], []
    for key, sign in (("I", "-"), ("II", "+")):
        across = d - a if sign == "-" else d + a
        value = degrees(acos((b**2 + c**2 - across**2) / (2 * b * c)))
        name = message("angle between coupler and rocker, frame position {key}", key=key)
        formula = f"arccos((b² + c² - (d {sign} a)²)/(2·b·c))"
        builder.find(f"μ_{key}", name, formula, value, unit="°", a=a, b=b, c=c, d=d)
        folded.append(_add_folded(builder, key, value))
        name = message("deviation angle, frame position {key}", key=key)
        small = f"μ_{key}*" if value > 90 else f"μ_{key}"
        values = {small: angle(folded[-1])}
        deviations.append(builder.find(f"α_{key}", name, f"90° - {small}", 90 - folded[-1], unit="°", values=values))
    names = ["μ_I*" if builder.number("μ_I") > 90 else "μ_I", "μ_II*" if builder.number("μ_II") > 90 else "μ_II"]
    mu = builder.find(
        "μ_min",
        _SMALLEST,
        f"min({names[0]}, {names[1]})",
        min(folded),
        unit="°",
        values=dict(zip(names, map(angle, folded), strict=True)),
    )
    _add_rule(builder, mu)
    _check_smallest(builder, size.linkage(), mu)
    moved = move_quietly(size.linkage(), [0.0, pi], branch="+")
    for key, turned in zip(("I", "II"), abs(moved.angle("rocker") - moved.angle("coupler")).tolist(), strict=True):
        quantity = message("{quantity}, by the general solver", quantity=f"μ_{key}")
        between = degrees(turned) % 360
        builder.check(quantity, builder.number(f"μ_{key}"), min(between, 360 - between), "°")
    builder.mistake("μ_min", max(folded), message("That is the better of the two frame positions."))
    for value in folded:
        builder.mistake("μ_min", 180 - value, _FOLD)
    builder.mistake("μ_min", min(deviations), _IS_DEVIATION)
    builder.mistake("μ_min", max(deviations), _IS_DEVIATION)
    return builder.done()


def _add_folded(builder: SolutionBuilder, key: str, value: float) -> float:
    name = message("transmission angle, frame position {key}", key=key)
    if value <= 90:
        builder.keep(f"μ_{key}*", name, value, unit="°")
        return value
    folded = builder.find(
        f"μ_{key}*", name, f"180° - μ_{key}", 180 - value, unit="°", values={f"μ_{key}": angle(value)}
    )
    builder.mistake(f"μ_{key}*", value, _FOLD)
    return folded


def _add_rule(builder: SolutionBuilder, mu: float) -> None:
    builder.keep("good", message("good transmission (μ_min at least 40°)"), mu >= 40)
    builder.mistake("good", mu < 40, message("Compare μ_min with 40°."))
    builder.say(
        message("μ_min is at least the 40° of the rule of thumb.")
        if mu >= 40
        else message("μ_min is below the 40° of the rule of thumb.")
    )


def _check_smallest(builder: SolutionBuilder, linkage: Linkage, mu: float, name: Readable = _SMALLEST) -> None:
    extremes = measures(linkage).transmission
    builder.check(
        message("{quantity}, from the solved motion", quantity=name),
        mu,
        degrees(extremes.smallest.mu) if extremes else 0.0,
        "°",
    )


def slider_crank(a: float, b: float, e: float = 0.0, unit: str = "mm") -> Solution:
    """The transmission angle of a slider-crank at its extremes, crank across the slider's line.

    >>> round(slider_crank(3, 5, 1).number("μ_min"), 6)
    36.869898
    """
    SliderCrank(a, b, e)  # raises for invalid lengths
    builder = SolutionBuilder(unit=unit)
    builder.find("λ", _RATIO, "a/b", a / b, unit="", a=a, b=b)
    _add_slider_crank(builder, a, b, e)
    return builder.done()


def _add_slider_crank(builder: SolutionBuilder, a: float, b: float, e: float, mark: str = "") -> float:
    """Steps for one slider-crank; ``mark`` numbers its symbols. Returns the smallest transmission angle."""
    size = SliderCrank(a, b, e)
    if size.turning != ("a",):
        raise LinkageError(
            "the crank of the slider-crank a = {a:g}, b = {b:g}, e = {e:g} does not turn fully", a=a, b=b, e=e
        )
    off = abs(e)
    rise = "(a + e)/b" if off else "a/b"
    if off and not mark:
        builder.say("The joint A is farthest from the slider's line, by a + e, where the crank points away from it.")
    values = {"a": formula_number(a), f"b{mark}": formula_number(b), "e": formula_number(off)}
    alpha = degrees(asin((a + off) / b))
    worst = builder.find(
        f"α_max{mark}", _DEVIATION, f"arcsin({rise.replace('b', 'b' + mark)})", alpha, unit="°", values=values
    )
    name = message("{name} with b = {b} {unit}", name=_SMALLEST, b=figure(b), unit=builder.unit) if mark else _SMALLEST
    mu = builder.find(
        f"μ_min{mark}", name, f"90° - α_max{mark}", 90 - worst, unit="°", values={f"α_max{mark}": angle(worst)}
    )
    _check_smallest(builder, size.linkage(), mu, name)
    builder.mistake(f"μ_min{mark}", worst, _IS_DEVIATION)
    if off:
        _add_other_extreme(builder, a, b, off)
        moved = move_quietly(size.linkage(), pi / 2 if e > 0 else -pi / 2)
        angle_there = 90 - degrees(abs(float(moved.angle("coupler")[0])))
        builder.check("{quantity}, by the general solver", builder.number("μ_II"), angle_there, "°", quantity="μ_II")
        builder.mistake(
            "μ_min", 90 - degrees(asin(a / b)), message("The eccentricity counts too: sin α_max = (a + e)/b.")
        )
        builder.mistake(
            "μ_min", degrees(acos((a - off) / b)), message("On the worse side e is added to a: sin α_max = (a + e)/b.")
        )
    else:
        largest = message("largest transmission angle, in the dead centres")
        builder.keep(f"μ_max{mark}", largest, 90.0, unit="°")
    along = message("μ is largest where the rod lies along the slider's line: α = 0° there, and μ = 90° - α.")
    for value in (0.0, 180.0, 90 - degrees(asin(abs(a - off) / b))):
        if value < 90 or not off or a >= off:
            builder.mistake(f"μ_max{mark}", value, along)
    if not mark:  # of those that are compared nobody asks for it
        extremes = measures(size.linkage()).transmission
        largest = message("Largest transmission angle, from the solved motion")
        builder.check(largest, builder.number("μ_max"), degrees(extremes.largest.mu) if extremes else 0.0, "°")
    return mu


def _add_other_extreme(builder: SolutionBuilder, a: float, b: float, e: float) -> None:
    name = message("deviation angle with the crank on the other side")
    deviation = builder.find("α_II", name, "arcsin((a - e)/b)", degrees(asin((a - e) / b)), unit="°", a=a, b=b, e=e)
    name = message("transmission angle there")
    mu = builder.find("μ_II", name, "90° - |α_II|", 90 - abs(deviation), unit="°", α_II=angle(deviation))
    if a >= e:
        touches = message(
            "largest transmission angle: with a = e the joint A just touches the slider's line on that side, and "
            "the rod lies along it: α = 0°"
        )
        crosses = message(
            "largest transmission angle: in between the joint A crosses the slider's line, as a is larger than "
            "e, and the rod lies along it there: α = 0°"
        )
        text = touches if isclose(a, e) else crosses
        builder.find("μ_max", _LARGEST, "90° - α", 90.0, unit="°", text=text, α=angle(0.0))
    else:
        builder.find("μ_max", _LARGEST, "μ_II", mu, unit="°", μ_II=angle(mu))


def compare_rods(a: float, b1: float, b2: float, unit: str = "mm") -> Solution:
    """Two central slider-cranks with the same crank: the influence of the ratio a/b on the transmission angle."""
    builder = SolutionBuilder(unit=unit)
    angles = []
    for mark, b in (("1", b1), ("2", b2)):
        SliderCrank(a, b)
        builder.find(f"λ{mark}", _RATIO, f"a/b{mark}", a / b, unit="", a=a, values={f"b{mark}": b})
        angles.append(_add_slider_crank(builder, a, b, 0.0, mark))
    better = 1 if angles[0] > angles[1] else 2
    builder.say(
        "Slider-crank {better} with the longer rod has the smaller ratio λ, the smaller deviation and the "
        "larger μ_min.",
        better=better,
    )
    longer = (angles[0] > angles[1]) == (b1 > b2)
    builder.keep("longer", message("the longer rod has the better transmission angle"), longer)
    builder.mistake("longer", not longer, message("The larger μ_min is the better one."))
    return builder.done()
