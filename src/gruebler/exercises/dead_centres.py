"""Dead centres, stroke and times: slider-cranks and crank-rockers, step by step."""

from __future__ import annotations

from math import acos, asin, cos, degrees, hypot, pi, radians, sin, sqrt

from gruebler.analysis import Measures, measures
from gruebler.errors import LinkageError
from gruebler.exercises.solution import Solution, SolutionBuilder, angle, as_step, number
from gruebler.fourbar import FourBar, SliderCrank
from gruebler.kinematics import move
from gruebler.linkages.quantities import as_positive
from gruebler.text import Text

__all__ = ["central_crank_rocker", "crank_rocker", "slider_crank", "stroke_middle", "stroke_table"]

FLAT = 1e-7
"""Tolerance of an angle at which an output turns back, which is less sharp than the output."""
_OUTER = Text("outer dead centre, crank and connecting rod stretched", "äußere Totlage, Kurbel und Koppel gestreckt")
_INNER = Text(
    "inner dead centre, crank and connecting rod overlapping", "innere Totlage, Kurbel und Koppel in Decklage"
)
_STROKE = Text("stroke, the distance of the dead centres", "Hub, der Abstand der Totlagen")
_RATIO = Text("crank-conrod ratio", "Schubstangenverhältnis")
_LONGER = Text("longer way of the crank between the dead centres", "größerer Kurbelwinkel zwischen den Totlagen")
_SHORTER = Text("shorter way of the crank between the dead centres", "kleinerer Kurbelwinkel zwischen den Totlagen")
_TIMES = Text("ratio of the times at constant speed", "Zeitverhältnis bei konstanter Drehzahl")
_SWING = Text("swing of the rocker", "Schwingwinkel der Schwinge")


def slider_crank(a: float, b: float, e: float = 0.0, unit: str = "mm") -> Solution:
    """Dead centres and stroke of a slider-crank; of an eccentric one the division of the crank's turn too.

    >>> round(slider_crank(1.7, 6, 1.5).number("H"), 6)
    3.522595
    """
    builder = SolutionBuilder(unit)
    _add_dead_centres(builder, SliderCrank(a, b, e))
    return builder.done()


def _add_dead_centres(builder: SolutionBuilder, size: SliderCrank) -> None:
    if size.dead_centres is None:
        raise LinkageError(
            "the crank of the slider-crank a = {a:g}, b = {b:g}, e = {e:g} does not turn", a=size.a, b=size.b, e=size.e
        )
    a, b, e = size.a, size.b, abs(size.e)
    if not e:
        outer = builder.find("l_a", _OUTER, "a + b", a + b, a=a, b=b)
        inner = builder.find("l_i", _INNER, "b - a", b - a, a=a, b=b)
    else:
        outer = builder.find("l_a", _OUTER, "√((a + b)² - e²)", sqrt((a + b) ** 2 - e**2), a=a, b=b, e=e)
        inner = builder.find("l_i", _INNER, "√((b - a)² - e²)", sqrt((b - a) ** 2 - e**2), a=a, b=b, e=e)
    stroke = builder.find("H", _STROKE, "l_a - l_i", outer - inner, l_a=outer, l_i=inner)
    found = measures(size.linkage())
    builder.check(
        "Stroke, from the extremes of the solved motion",
        "Hub, aus den Extremwerten der durchgerechneten Bewegung",
        stroke,
        found.travel or 0.0,
    )
    for key, centre in (("l_a", found.outer), ("l_i", found.inner)):
        there = abs(centre.output) if centre else 0.0
        builder.check(
            f"{key} of the solved motion", f"{key} aus der durchgerechneten Bewegung", builder.number(key), there
        )
    builder.mistake(
        "H", a, "The stroke is twice the crank, not once.", "Der Hub ist zweimal die Kurbellänge, nicht einmal."
    )
    builder.mistake(
        "H",
        2 * a,
        "H = 2a holds for a central slider-crank only; this one is eccentric.",
        "H = 2a gilt nur für die zentrische Schubkurbel; diese hier ist exzentrisch.",
    )
    builder.mistake(
        "H",
        sqrt((a + b) ** 2 + e**2) - sqrt((b - a) ** 2 + e**2),
        "e is a side of the right triangle at the slider's line, so e² is taken off, not added.",
        "e ist Kathete des rechtwinkligen Dreiecks an der Totlagengeraden: e² wird abgezogen, nicht addiert.",
    )
    if e:
        _add_division(builder, a, b, e, found)


def _add_division(builder: SolutionBuilder, a: float, b: float, e: float, measures: Measures) -> None:
    """How the eccentricity divides the turn of the crank."""
    name = Text("inclination of the stretched linkage", "Neigung der gestreckten Lage")
    phi_a = builder.find("φ_a", name, "arcsin(e/(a + b))", degrees(asin(e / (a + b))), unit="°", a=a, b=b, e=e)
    name = Text("inclination of the overlapping linkage", "Neigung der Decklage")
    phi_i = builder.find("φ_i", name, "arcsin(e/(b - a))", degrees(asin(e / (b - a))), unit="°", a=a, b=b, e=e)
    longer = _add_times(builder, phi_i - phi_a, {"φ_i": angle(phi_i), "φ_a": angle(phi_a)}, "φ_i - φ_a")
    name = Text("difference between forward and return travel", "Winkeldifferenz zwischen Hin- und Rückhub")
    builder.find(
        "difference", name, "2·Δφ", 2 * (phi_i - phi_a), unit="°", symbol="φ_max - φ_min", Δφ=angle(phi_i - phi_a)
    )
    builder.check(
        "Longer crank angle, between the dead centres of the solved motion",
        "Größerer Kurbelwinkel, zwischen den Totlagen der durchgerechneten Bewegung",
        longer,
        degrees(measures.phi_max or 0.0),
        "°",
    )
    for key, centre in (("φ_a", measures.outer), ("φ_i", measures.inner)):
        tilt = degrees(abs(asin(sin(centre.drive)))) if centre else 0.0
        en, de = f"{key}, the crank's inclination there", f"{key}, Neigung der Kurbel dort"
        builder.check(en, de, builder.number(key), tilt, "°", tolerance=FLAT)
    builder.mistake(
        "difference",
        phi_i - phi_a,
        "Asked is φ_max - φ_min = 2·Δφ: one way is longer by Δφ, the other shorter by it.",
        "Gefragt ist φ_max - φ_min = 2·Δφ: Der eine Weg ist um Δφ länger, der andere um Δφ kürzer als 180°.",
    )


def _add_times(builder: SolutionBuilder, delta: float, angles: dict[str, str], formula: str) -> float:
    name = Text("deviation from half a turn", "Abweichung von der halben Umdrehung")
    builder.find("Δφ", name, formula, delta, unit="°", values=angles)
    longer = builder.find("φ_max", _LONGER, "180° + Δφ", 180 + delta, unit="°", Δφ=angle(delta))
    shorter = builder.find("φ_min", _SHORTER, "180° - Δφ", 180 - delta, unit="°", Δφ=angle(delta))
    ratio = longer / shorter
    values = {"φ_max": angle(longer), "φ_min": angle(shorter)}
    builder.find("time_ratio", _TIMES, "φ_max/φ_min", ratio, unit="", symbol="k", values=values)
    hint = (
        "Both ways together are a full turn; φ_max is more than 180°, φ_min less.",
        "Beide Wege ergeben zusammen eine volle Umdrehung; φ_max liegt über 180°, φ_min darunter.",
    )
    builder.mistake("φ_max", shorter, *hint)
    builder.mistake("φ_min", longer, *hint)
    builder.mistake(
        "time_ratio", shorter / longer, "The longer time is divided by the shorter.", "Länger durch kürzer."
    )
    return longer


def stroke_table(
    a: float, e: float = 0.0, b: float | None = None, ratio: float | None = None, step: float = 30, unit: str = "mm"
) -> Solution:
    """The transfer function s(φ) of a slider-crank in steps from the outer dead centre, with stroke and division.

    The crank turns left. The table has the crank angle from the dead centre and from the slider's line, the way s from
    below the crank's pivot, and the way made from the outer dead centre.
    """
    as_step(step)
    builder = SolutionBuilder(unit)
    rod = _rod(builder, a, b, ratio)
    size = SliderCrank(a, rod, e)
    _add_dead_centres(builder, size)
    centres = size.dead_centres
    assert centres is not None  # _add_dead_centres has refused the others
    start = centres.outer.phi if centres.outer.phi < pi else centres.outer.phi - 2 * pi
    low = "" if not e else " - e" if e > 0 else " + e"
    builder.say(
        "The slider's way at every crank angle, counted from below the crank's pivot:",
        "Der Schieberweg zu jedem Kurbelwinkel, gezählt vom Lot durch den Kurbeldrehpunkt:",
        f"s = a·cos φ + √(b² - (a·sin φ{low})²)",
    )
    rows = []
    for k in range(int(360 / step + 1e-9) + 1):
        phi = start + radians(k * step)
        s = a * cos(phi) + sqrt(rod**2 - (a * sin(phi) - e) ** 2)
        rows.append((k * step, degrees(phi), s, centres.outer.output - s))
    title = Text(
        "Transfer function s(φ), from the outer dead centre", "Übertragungsfunktion s(φ), ab der äußeren Totlage"
    )
    headers = ("Δφ [°]", "φ [°]", f"s [{unit}]", f"l_a - s [{unit}]")
    builder.table(title, [Text(h, h) for h in headers], rows, decimals=3)
    inner = (centres.inner.phi - centres.outer.phi) % (2 * pi)
    name = Text(
        "crank angle from the outer to the inner dead centre", "Kurbelwinkel von der äußeren zur inneren Totlage"
    )
    builder.keep("inner_at", name, degrees(inner), unit="°", symbol="Δφ(Ti)")
    moved = move(size.linkage(), [radians(row[1]) for row in rows])
    builder.check(
        "Largest difference of s in the table from the general solver's",
        "Größter Unterschied von s in der Tabelle gegenüber dem allgemeinen Löser",
        0.0,
        max(abs(row[2] - s) for row, s in zip(rows, moved.displacement("P(frame-slider)").tolist(), strict=True)),
    )
    return builder.done()


def _rod(builder: SolutionBuilder, a: float, b: float | None, ratio: float | None) -> float:
    if (b is None) == (ratio is None):
        raise LinkageError("either the connecting rod b is given or the ratio lambda = a/b")
    as_positive("lambda" if b is None else "b", ratio if b is None else b)
    if ratio is not None:
        name = Text("connecting rod from the crank-conrod ratio", "Koppellänge aus dem Schubstangenverhältnis")
        return builder.find("b", name, "a/λ", a / ratio, a=a, λ=ratio)
    assert b is not None
    builder.find("λ", _RATIO, "a/b", a / b, unit="", a=a, b=b)
    return b


def stroke_middle(a: float, b: float | None = None, ratio: float | None = None, unit: str = "mm") -> Solution:
    """A central slider-crank in the middle of its stroke, and how far from the middle of the time that is.

    >>> found = stroke_middle(20, 50)
    >>> round(found.number("φ_H2"), 4), round(found.number("μ_H2"), 4)
    (78.463, 66.9261)
    """
    builder = SolutionBuilder(unit)
    rod = _rod(builder, a, b, ratio)
    size = SliderCrank(a, rod)
    if size.dead_centres is None:
        raise LinkageError("the crank of the slider-crank a = {a:g}, b = {rod:g} does not turn", a=a, rod=rod)
    builder.find("H", _STROKE, "2·a", 2 * a, a=a)
    builder.find(
        "s_H2",
        Text("slider in the middle of the stroke", "Schieber in Hubmitte"),
        "(l_a + l_i)/2",
        rod,
        l_a=rod + a,
        l_i=rod - a,
    )
    name = Text(
        "crank angle in the middle of the stroke, on either side of the outer dead centre",
        "Kurbelwinkel in der Hubmitte, beiderseits der äußeren Totlage",
    )
    text = Text(
        "crank angle there: the triangle A0, A, B has two sides b, so its height from B stands on the middle of a",
        "Kurbelwinkel dort: Das Dreieck A0, A, B hat zwei Seiten b, seine Höhe von B aus trifft also die Mitte von a",
    )
    phi = degrees(acos(a / (2 * rod)))
    builder.find("φ_H2", name, "± arccos(a/(2·b))", phi, unit="°", text=text, either_sign=True, a=a, b=rod)
    name = Text(
        "crank angle from the inner dead centre to the middle", "Kurbelwinkel von der inneren Totlage bis zur Hubmitte"
    )
    builder.find("φ_i_H2", name, "180° - φ_H2", 180 - phi, unit="°", φ_H2=angle(phi))
    name = Text("deviation angle in the middle of the stroke", "Ablenkwinkel in der Hubmitte")
    values = {"a": number(a), "b": number(rod), "φ_H2": angle(phi)}
    alpha = builder.find(
        "α_H2", name, "arcsin(a·sin φ_H2/b)", degrees(asin(a * sin(radians(phi)) / rod)), unit="°", values=values
    )
    builder.find(
        "μ_H2",
        Text("transmission angle in the middle of the stroke", "Übertragungswinkel in der Hubmitte"),
        "90° - α_H2",
        90 - alpha,
        unit="°",
        α_H2=angle(alpha),
    )
    _add_middle_of_time(builder, size, phi)
    moved = move(size.linkage(), [radians(phi)])
    slide = float(moved.displacement("P(frame-slider)")[0])
    rod_angle = degrees(abs(float(moved.angle("coupler")[0])))
    builder.check(
        "s at this angle, by the general solver", "s bei diesem Winkel, mit dem allgemeinen Löser", rod, slide
    )
    builder.check("α there, by the general solver", "α dort, mit dem allgemeinen Löser", alpha, rod_angle, "°")
    _add_middle_mistakes(builder, phi, alpha)
    return builder.done()


def _add_middle_of_time(builder: SolutionBuilder, size: SliderCrank, phi: float) -> None:
    name = Text("slider in the middle of the time, at φ = 90°", "Schieber in der Zeitmitte, bei φ = 90°")
    at_time = builder.find("s_T", name, "√(b² - a²)", sqrt(size.b**2 - size.a**2), a=size.a, b=size.b)
    name = Text("middle of the way less middle of the time", "Wegmitte minus Zeitmitte")
    offset = builder.find("offset", name, "s_H2 - s_T", size.b - at_time, symbol="Δs", s_H2=size.b, s_T=at_time)
    name = Text("the same as a part of the stroke", "dasselbe bezogen auf den Hub")
    builder.find("offset_H", name, "Δs/H", offset / (2 * size.a), unit="", symbol="δ", Δs=offset, H=2 * size.a)
    name = Text("part of the time that the outer half of the stroke takes", "Zeitanteil der äußeren Hubhälfte")
    builder.find("time_part", name, "φ_H2/180°", phi / 180, unit="", symbol="τ", φ_H2=angle(phi))


def _add_middle_mistakes(builder: SolutionBuilder, phi: float, alpha: float) -> None:
    builder.mistake(
        "φ_H2",
        90.0,
        "At 90° the crank is in the middle of the time, not of the way: the slider is already beyond H/2.",
        "Bei 90° steht die Kurbel in der Zeitmitte, nicht in der Wegmitte: Der Schieber ist schon über H/2 hinaus.",
    )
    builder.mistake(
        "φ_H2", 180 - phi, "Counted from the inner dead centre; asked is the outer.", "Von der inneren Totlage gezählt."
    )
    builder.mistake(
        "φ_i_H2", phi, "Counted from the outer dead centre; asked is the inner.", "Von der äußeren Totlage gezählt."
    )
    builder.mistake(
        "μ_H2", alpha, "That is the deviation angle α; μ = 90° - α.", "Das ist der Ablenkwinkel α; μ = 90° - α."
    )


def crank_rocker(a: float, b: float, c: float, d: float, rpm: float | None = None, unit: str = "mm") -> Solution:
    """Dead centres, swing and division of the crank's turn of a crank-rocker; with a speed the times.

    >>> found = crank_rocker(2, 7, 4.5, 5.5, rpm=300, unit="cm")
    >>> round(found.number("φ_max"), 4), round(found.number("T_min"), 4)
    (207.287, 84.8405)
    """
    size = FourBar(a, b, c, d)
    if size.dead_centres is None:
        raise LinkageError(
            "the four-bar a = {a:g}, b = {b:g}, c = {c:g}, d = {d:g} is no crank-rocker: {type}",
            a=a,
            b=b,
            c=c,
            d=d,
            type=size.type,
        )
    way = SolutionBuilder(unit)
    lengths = {"a": number(a), "b": number(b), "c": number(c), "d": number(d)}
    phi_i, phi_a = _dead_centre_angles(way, size, lengths)
    way.say(
        "Between the dead centres the crank's line turns by the difference; the crank itself makes half a turn more "
        "or less.",
        "Zwischen den Totlagen dreht sich die Koppelgerade um die Differenz; die Kurbel macht eine halbe Umdrehung "
        "mehr oder weniger.",
    )
    angles = {"φ_i": angle(phi_i), "φ_a": angle(phi_a)}
    way_angle = _add_times(way, abs(phi_i - phi_a), angles, "φ_i - φ_a" if phi_i >= phi_a else "φ_a - φ_i")
    _add_swing(way, size, lengths)
    found = measures(size.linkage(), rpm)
    en, de = "between the dead centres of the solved motion", "zwischen den Totlagen der durchgerechneten Bewegung"
    way.check(f"Longer crank angle, {en}", f"Größerer Kurbelwinkel, {de}", way_angle, degrees(found.phi_max or 0), "°")
    way.check(f"Swing, {en}", f"Schwingwinkel, {de}", way.number("ψ_H"), degrees(found.travel or 0), "°")
    for key, centre in (("i", found.inner), ("a", found.outer)):
        rocker, crank = (degrees(centre.output), degrees(centre.drive)) if centre else (0.0, 0.0)
        way.check(f"ψ_{key}, {en}", f"ψ_{key}, {de}", way.number(f"ψ_{key}"), rocker, "°")
        line = crank % 180 if key == "i" else crank
        way.check(f"φ_{key}, {en}", f"φ_{key}, {de}", way.number(f"φ_{key}"), line, "°", tolerance=FLAT)
    if rpm is not None:
        _add_durations(way, abs(rpm), 180 + abs(phi_i - phi_a), found.times.longest * 1000 if found.times else 0.0)
    return way.done()


def _dead_centre_angles(builder: SolutionBuilder, size: FourBar, lengths: dict[str, str]) -> tuple[float, float]:
    a, b, c, d = size.a, size.b, size.c, size.d
    builder.say(
        "In a dead centre crank and coupler lie on one line; with rocker and frame they form a triangle with the "
        "side b - a (inner) or b + a (outer). The cosine rule gives the angle at A0.",
        "In einer Totlage liegen Kurbel und Koppel auf einer Geraden; mit Schwinge und Gestell bilden sie ein "
        "Dreieck mit der Seite b - a (innen) oder b + a (außen). Der Cosinussatz liefert den Winkel bei A0.",
    )
    found = []
    for key, sign, en, de in (("φ_i", "-", "inner", "innere"), ("φ_a", "+", "outer", "äußere")):
        side = b - a if sign == "-" else b + a
        value = degrees(acos((side**2 + d**2 - c**2) / (2 * side * d)))
        formula = f"arccos(((b {sign} a)² + d² - c²)/(2·(b {sign} a)·d))"
        name = Text(f"{en} dead centre, direction of the coupler's line", f"{de} Totlage, Richtung der Koppelgeraden")
        found.append(builder.find(key, name, formula, value, unit="°", values=lengths))
    return found[0], found[1]


def _add_swing(builder: SolutionBuilder, size: FourBar, lengths: dict[str, str]) -> None:
    a, b, c, d = size.a, size.b, size.c, size.d
    found = []
    for key, sign, en, de in (("ψ_i", "-", "inner", "inneren"), ("ψ_a", "+", "outer", "äußeren")):
        side = b - a if sign == "-" else b + a
        value = 180 - degrees(acos((c**2 + d**2 - side**2) / (2 * c * d)))
        formula = f"180° - arccos((c² + d² - (b {sign} a)²)/(2·c·d))"
        name = Text(f"angle of the rocker in the {en} dead centre", f"Winkel der Schwinge in der {de} Totlage")
        found.append(builder.find(key, name, formula, value, unit="°", values=lengths))
    inner, outer = found
    swing = builder.find("ψ_H", _SWING, "ψ_i - ψ_a", inner - outer, unit="°", ψ_i=angle(inner), ψ_a=angle(outer))
    builder.mistake(
        "ψ_H",
        180 - swing,
        "Take both angles of the rocker from the same side of the frame line.",
        "Nehmen Sie beide Schwingenwinkel von derselben Seite der Gestellgeraden.",
    )


def _add_durations(builder: SolutionBuilder, rpm: float, longer: float, by_motion: float) -> None:
    name = Text("time of one turn", "Dauer einer Umdrehung")
    period = builder.find("T", name, "(60000 ms/min)/n", 60000 / rpm, unit="ms", n=f"({number(rpm)}/min)")
    times = []
    for key, name, angle_name, part in (
        ("T_max", Text("time of the slower way", "Dauer des langsamen Weges"), "φ_max", longer),
        ("T_min", Text("time of the quicker way", "Dauer des schnellen Weges"), "φ_min", 360 - longer),
    ):
        values = {angle_name: angle(part), "T": f"{number(period)} ms"}
        times.append(builder.find(key, name, f"{angle_name}/360°·T", part / 360 * period, unit="ms", values=values))
    slow, quick = times
    name = Text("difference of the times", "Zeitdifferenz zwischen Hin- und Rückhub")
    shown = {"T_max": f"{number(slow)} ms", "T_min": f"{number(quick)} ms"}
    builder.find("ΔT", name, "T_max - T_min", slow - quick, unit="ms", values=shown)
    builder.check(
        "Time of the slower way, by the solved motion",
        "Dauer des langsamen Weges, aus der Bewegung",
        slow,
        by_motion,
        "ms",
    )
    builder.mistake(
        "ΔT",
        (slow - quick) / 2,
        "That is the distance from T/2; the ways differ by twice it.",
        "Das ist der Abstand von T/2; die Wege unterscheiden sich um das Doppelte.",
    )


def central_crank_rocker(a: float, b: float, c: float, unit: str = "mm") -> Solution:
    """The frame that makes a crank-rocker central, its swing, ratio and smallest transmission angle.

    >>> found = central_crank_rocker(30, 75, 60)
    >>> round(found.number("d"), 6), round(found.number("μ_min"), 6)
    (91.241438, 52.535031)
    """
    size = FourBar.central(a=a, b=b, c=c)
    way = SolutionBuilder(unit)
    text = Text(
        "frame: in both dead centres B lies on one line through A0, so the chord of the swing is 2a long",
        "Gestell: In beiden Totlagen liegt B auf einer Geraden durch A0, die Sehne des Schwingwinkels ist also 2a lang",
    )
    name = Text("frame", "Gestelllänge")
    way.find("d", name, "√(b² + c² - a²)", sqrt(b**2 + c**2 - a**2), text=text, a=a, b=b, c=c)
    d = size.d
    way.find("λ", _RATIO, "a/b", a / b, unit="", a=a, b=b)
    swing = way.find("ψ_H", _SWING, "2·arcsin(a/c)", 2 * degrees(asin(a / c)), unit="°", a=a, c=c)
    name = Text("smallest transmission angle", "kleinster Übertragungswinkel")
    text = Text(
        "smallest transmission angle: both frame positions give the same one (one acute, one obtuse), for cos μ = ± "
        "a·d/(b·c)",
        "kleinster Übertragungswinkel: Beide Steglagen ergeben denselben (einer spitz, einer stumpf), denn cos μ = ± "
        "a·d/(b·c)",
    )
    value = degrees(acos((b**2 + c**2 - (d - a) ** 2) / (2 * b * c)))
    formula = "arccos((b² + c² - (d - a)²)/(2·b·c))"
    mu = way.find("μ_min", name, formula, value, unit="°", text=text, a=a, b=b, c=c, d=d)
    found = measures(size.linkage())
    en, de = "from the solved motion", "aus der durchgerechneten Bewegung"
    way.check(f"Swing, {en}", f"Schwingwinkel, {de}", swing, degrees(found.travel or 0), "°")
    smallest = found.transmission.smallest.mu if found.transmission else 0.0
    way.check(f"Smallest transmission angle, {en}", f"Kleinster Übertragungswinkel, {de}", mu, degrees(smallest), "°")
    way.check(
        "Time ratio, 1 for a central linkage", "Zeitverhältnis, zentrisch gleich 1", 1.0, found.time_ratio or 0, ""
    )
    way.mistake(
        "d",
        hypot(b, c),
        "b² + c² is still a² too much: the triangle has its right angle elsewhere.",
        "b² + c² ist noch um a² zu groß: d² = b² + c² - a².",
    )
    way.mistake("d", sqrt(a**2 + b**2 + c**2), "a² is taken off, not added.", "a² wird abgezogen, nicht addiert.")
    way.mistake("μ_min", 180 - mu, "μ is folded to at most 90°.", "μ wird auf höchstens 90° umgerechnet: 180° - μ.")
    way.mistake("λ", b / a, "λ is the crank by the connecting rod.", "λ ist Kurbellänge durch Koppellänge.")
    return way.done()
