"""Transmission angles of four-bars and slider-cranks at their extremes, step by step."""

from __future__ import annotations

from math import acos, asin, degrees, isclose, pi

from gruebler.analysis import measures
from gruebler.errors import LinkageError
from gruebler.exercises.solution import Solution, SolutionBuilder, angle, number
from gruebler.fourbar import FourBar, SliderCrank
from gruebler.kinematics import move
from gruebler.linkages import Linkage
from gruebler.text import Text

__all__ = ["compare_rods", "four_bar", "slider_crank"]

_SMALLEST = Text("smallest transmission angle", "kleinster Übertragungswinkel")
_LARGEST = Text("largest transmission angle", "größter Übertragungswinkel")
_DEVIATION = Text("largest deviation angle", "größter Ablenkwinkel")
_RATIO = Text("crank-conrod ratio", "Schubstangenverhältnis")
_FOLD = (
    "A transmission angle is at most 90°: what lies above is taken from 180°.",
    "Ein Übertragungswinkel ist höchstens 90°: Was darüber liegt, wird von 180° abgezogen.",
)
_IS_DEVIATION = ("That is the deviation angle α; μ = 90° - α.", "Das ist der Ablenkwinkel α; μ = 90° - α.")


def four_bar(a: float, b: float, c: float, d: float, unit: str = "mm") -> Solution:
    """The transmission angle of a four-bar with turning crank in its two frame positions.

    >>> round(four_bar(2, 5, 4, 5).number("μ_min"), 6)
    36.869898
    """
    size = FourBar(a, b, c, d)
    if "a" not in size.turning:
        raise LinkageError(
            "the crank of the four-bar {a:g}, {b:g}, {c:g}, {d:g} does not turn fully: {type}",
            a=a,
            b=b,
            c=c,
            d=d,
            type=size.type,
        )
    builder = SolutionBuilder(unit)
    builder.say(
        "The transmission angle is extreme where the crank lies on the frame line: the distance A-B0 is d - a or d + "
        "a.",
        "Der Übertragungswinkel ist in den Steglagen am größten und am kleinsten: Dort ist der Abstand A-B0 gleich d "
        "- a oder d + a.",
        "(d ∓ a)² = b² + c² - 2·b·c·cos μ",
    )
    folded, deviations = [], []
    for key, sign in (("I", "-"), ("II", "+")):
        across = d - a if sign == "-" else d + a
        value = degrees(acos((b**2 + c**2 - across**2) / (2 * b * c)))
        name = Text(
            f"angle between coupler and rocker, frame position {key}",
            f"Winkel zwischen Koppel und Schwinge, Steglage {key}",
        )
        formula = f"arccos((b² + c² - (d {sign} a)²)/(2·b·c))"
        builder.find(f"μ_{key}", name, formula, value, unit="°", a=a, b=b, c=c, d=d)
        folded.append(_add_folded(builder, key, value))
        name = Text(f"deviation angle, frame position {key}", f"Ablenkwinkel, Steglage {key}")
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
    moved = move(size.linkage(), [0.0, pi], branch="+")
    for key, turned in zip(("I", "II"), abs(moved.angle("rocker") - moved.angle("coupler")).tolist(), strict=True):
        en, de = f"μ_{key}, by the general solver", f"μ_{key}, mit dem allgemeinen Löser"
        between = degrees(turned) % 360
        builder.check(en, de, builder.number(f"μ_{key}"), min(between, 360 - between), "°")
    builder.mistake(
        "μ_min",
        max(folded),
        "That is the better of the two frame positions.",
        "Das ist die günstigere der beiden Steglagen.",
    )
    for value in folded:
        builder.mistake("μ_min", 180 - value, *_FOLD)
    builder.mistake("μ_min", min(deviations), *_IS_DEVIATION)
    builder.mistake("μ_min", max(deviations), *_IS_DEVIATION)
    return builder.done()


def _add_folded(builder: SolutionBuilder, key: str, value: float) -> float:
    name = Text(f"transmission angle, frame position {key}", f"Übertragungswinkel, Steglage {key}")
    if value <= 90:
        builder.keep(f"μ_{key}*", name, value, unit="°")
        return value
    found = builder.find(f"μ_{key}*", name, f"180° - μ_{key}", 180 - value, unit="°", values={f"μ_{key}": angle(value)})
    builder.mistake(f"μ_{key}*", value, *_FOLD)
    return found


def _add_rule(builder: SolutionBuilder, mu: float) -> None:
    builder.keep(
        "good", Text("good transmission (μ_min at least 40°)", "gute Kraftübertragung (μ_min mindestens 40°)"), mu >= 40
    )
    good = ("at least", "mindestens") if mu >= 40 else ("below", "unter")
    builder.say(
        f"μ_min is {good[0]} the 40° of the rule of thumb.",
        f"μ_min liegt {'bei ' if mu >= 40 else ''}{good[1]} 40°, der Faustregel für langsam laufende Getriebe.",
    )


def _check_smallest(builder: SolutionBuilder, linkage: Linkage, mu: float) -> None:
    extremes = measures(linkage).transmission
    builder.check(
        "Smallest transmission angle, from the solved motion",
        "Kleinster Übertragungswinkel, aus der durchgerechneten Bewegung",
        mu,
        degrees(extremes.smallest.mu) if extremes else 0.0,
        "°",
    )


def slider_crank(a: float, b: float, e: float = 0.0, unit: str = "mm") -> Solution:
    """The transmission angle of a slider-crank at its extremes, crank across the slider's line.

    >>> round(slider_crank(3, 5, 1).number("μ_min"), 6)
    36.869898
    """
    SliderCrank(a, b, e)  # refuses lengths that are none
    builder = SolutionBuilder(unit)
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
        builder.say(
            "The joint A is farthest from the slider's line, by a + e, where the crank points away from it.",
            "Am weitesten, nämlich a + e, ist das Gelenk A von der Totlagengeraden entfernt, wenn die Kurbel von ihr "
            "weg zeigt.",
        )
    values = {"a": number(a), f"b{mark}": number(b), "e": number(off)}
    alpha = degrees(asin((a + off) / b))
    worst = builder.find(
        f"α_max{mark}", _DEVIATION, f"arcsin({rise.replace('b', 'b' + mark)})", alpha, unit="°", values=values
    )
    mu = builder.find(
        f"μ_min{mark}", _SMALLEST, f"90° - α_max{mark}", 90 - worst, unit="°", values={f"α_max{mark}": angle(worst)}
    )
    _check_smallest(builder, size.linkage(), mu)
    builder.mistake(f"μ_min{mark}", worst, *_IS_DEVIATION)
    if off:
        _add_other_extreme(builder, a, b, off)
        moved = move(size.linkage(), pi / 2 if e > 0 else -pi / 2)
        there = 90 - degrees(abs(float(moved.angle("coupler")[0])))
        builder.check(
            "μ_II, by the general solver", "μ_II, mit dem allgemeinen Löser", builder.number("μ_II"), there, "°"
        )
        builder.mistake(
            "μ_min",
            90 - degrees(asin(a / b)),
            "The eccentricity counts too: sin α_max = (a + e)/b.",
            "Die Exzentrizität zählt mit: sin α_max = (a + e)/b.",
        )
        builder.mistake(
            "μ_min",
            degrees(acos((a - off) / b)),
            "On the worse side e is added to a: sin α_max = (a + e)/b.",
            "Auf der ungünstigen Seite wird e zu a addiert: sin α_max = (a + e)/b.",
        )
    else:
        largest = Text("largest transmission angle, in the dead centres", "größter Übertragungswinkel, in den Totlagen")
        builder.keep(f"μ_max{mark}", largest, 90.0, unit="°")
    extremes = measures(size.linkage()).transmission
    builder.check(
        "Largest transmission angle, from the solved motion",
        "Größter Übertragungswinkel, aus der durchgerechneten Bewegung",
        builder.number(f"μ_max{mark}"),
        degrees(extremes.largest.mu) if extremes else 0.0,
        "°",
    )
    return mu


def _add_other_extreme(builder: SolutionBuilder, a: float, b: float, e: float) -> None:
    name = Text("deviation angle with the crank on the other side", "Ablenkwinkel mit der Kurbel auf der anderen Seite")
    other = builder.find("α_II", name, "arcsin((a - e)/b)", degrees(asin((a - e) / b)), unit="°", a=a, b=b, e=e)
    name = Text("transmission angle there", "Übertragungswinkel dort")
    mu = builder.find("μ_II", name, "90° - |α_II|", 90 - abs(other), unit="°", α_II=angle(other))
    if a >= e:
        touches = isclose(a, e)
        text = Text(
            "largest transmission angle: with a = e the joint A just touches the slider's line on that side, and the "
            "rod lies along it",
            "größter Übertragungswinkel: Wegen a = e berührt das Gelenk A auf dieser Seite gerade die Totlagengerade, "
            "und die Koppel liegt auf ihr",
        )
        crosses = Text(
            "largest transmission angle: in between the joint A crosses the slider's line, as a is larger than e, and "
            "the rod lies along it there",
            "größter Übertragungswinkel: Dazwischen kreuzt das Gelenk A die Totlagengerade, da a größer ist als e; die "
            "Koppel liegt dort auf ihr",
        )
        builder.find("μ_max", _LARGEST, "90° - arcsin(0/b)", 90.0, unit="°", text=text if touches else crosses, b=b)
    else:
        builder.find("μ_max", _LARGEST, "μ_II", mu, unit="°", μ_II=angle(mu))


def compare_rods(a: float, b1: float, b2: float, unit: str = "mm") -> Solution:
    """Two central slider-cranks with one crank: how the ratio a/b decides about the transmission angle."""
    builder = SolutionBuilder(unit)
    found = []
    for mark, b in (("1", b1), ("2", b2)):
        SliderCrank(a, b)
        builder.find(f"λ{mark}", _RATIO, f"a/b{mark}", a / b, unit="", a=a, values={f"b{mark}": b})
        found.append(_add_slider_crank(builder, a, b, 0.0, mark))
    better = 1 if found[0] > found[1] else 2
    builder.say(
        f"Slider-crank {better} with the longer rod has the smaller ratio λ, the smaller deviation and the larger "
        "μ_min.",
        f"Schubkurbel {better} mit der längeren Koppel hat das kleinere Schubstangenverhältnis, den kleineren "
        "Ablenkwinkel und das größere μ_min.",
    )
    return builder.done()
