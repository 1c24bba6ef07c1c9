"""Dead centres, stroke and times: slider-cranks and crank-rockers, step by step."""

from __future__ import annotations

from math import acos, asin, cos, degrees, hypot, pi, radians, sin, sqrt

from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, in_every_language, joined_by_or, message
from gruebler.mechanics.analysis import Measures, measures
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.kinematics.drive_rows import rpm as per_minute
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages.quantities import as_positive
from gruebler.teaching.exercises.solution import Solution, SolutionBuilder, angle, as_step, formula_number

FLAT = 1e-7
"""Tolerance of an angle at which an output turns back, which is less sharp than the output."""
_OUTER = message("outer dead centre, crank and coupler stretched")
_INNER = message("inner dead centre, crank and coupler overlapping")
_STROKE = message("stroke, the distance of the dead centres")
_NOT_ONCE = message("The stroke is twice the crank, not once.")
_ONE_CENTRE = message("That is the distance in one dead centre; the stroke is the difference of both.")
_RATIO = message("ratio of crank to connecting rod")
_LONGER = message("larger crank angle between the dead centres")
_SHORTER = message("smaller crank angle between the dead centres")
_TIMES = message("ratio of the times at constant speed")
_SWING = message("swing of the rocker")


def slider_crank(a: float, b: float, e: float = 0.0, unit: str = "mm") -> Solution:
    """Dead centres and stroke of a slider-crank; for an eccentric one also the division of the crank's turn.

    >>> round(slider_crank(1.7, 6, 1.5).number("H"), 6)
    3.522595
    """
    builder = SolutionBuilder(unit=unit)
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
    measured = measures(size.linkage())
    builder.check("Stroke, from the extremes of the solved motion", stroke, measured.travel or 0.0)
    for key, centre in (("l_a", measured.outer), ("l_i", measured.inner)):
        position = abs(centre.output) if centre else 0.0
        builder.check("{key} of the solved motion", builder.number(key), position, key=key)
    builder.mistake("H", a, _NOT_ONCE)
    builder.mistake("H", outer, _ONE_CENTRE)
    builder.mistake("H", 2 * a, message("H = 2a holds for a central slider-crank only; this one is eccentric."))
    builder.mistake(
        "H",
        sqrt((a + b) ** 2 + e**2) - sqrt((b - a) ** 2 + e**2),
        message("e is a side of the right triangle at the slider's line, so e² is subtracted, not added."),
    )
    if e:
        _add_division(builder, a, b, e, measured)


def _add_division(builder: SolutionBuilder, a: float, b: float, e: float, measures: Measures) -> None:
    """The division of the crank's turn by the eccentricity."""
    name = message("inclination of the stretched linkage")
    phi_a = builder.find("φ_a", name, "arcsin(e/(a + b))", degrees(asin(e / (a + b))), unit="°", a=a, b=b, e=e)
    name = message("inclination of the overlapping linkage")
    phi_i = builder.find("φ_i", name, "arcsin(e/(b - a))", degrees(asin(e / (b - a))), unit="°", a=a, b=b, e=e)
    longer = _add_times(builder, phi_i - phi_a, {"φ_i": angle(phi_i), "φ_a": angle(phi_a)}, "φ_i - φ_a")
    name = message("difference between forward and return travel")
    builder.find("difference", name, "2·Δφ", 2 * (phi_i - phi_a), unit="°", symbol="δ", Δφ=angle(phi_i - phi_a))
    builder.check(
        "Longer crank angle, between the dead centres of the solved motion",
        longer,
        degrees(measures.phi_max or 0.0),
        "°",
    )
    for key, centre in (("φ_a", measures.outer), ("φ_i", measures.inner)):
        tilt = degrees(abs(asin(sin(centre.drive)))) if centre else 0.0
        inclination = message("{angle}, the crank's inclination there", angle=key)
        builder.check(inclination, builder.number(key), tilt, "°", tolerance=FLAT)
    builder.mistake(
        "difference",
        phi_i - phi_a,
        message("The task asks for δ = φ_max - φ_min = 2·Δφ: one stroke is longer by Δφ, the other shorter by it."),
    )


def _add_times(builder: SolutionBuilder, delta: float, angles: dict[str, str], formula: str) -> float:
    name = message("deviation from half a turn")
    builder.find("Δφ", name, formula, delta, unit="°", values=angles)
    longer = builder.find("φ_max", _LONGER, "180° + Δφ", 180 + delta, unit="°", Δφ=angle(delta))
    shorter = builder.find("φ_min", _SHORTER, "180° - Δφ", 180 - delta, unit="°", Δφ=angle(delta))
    ratio = longer / shorter
    values = {"φ_max": angle(longer), "φ_min": angle(shorter)}
    builder.find("time_ratio", _TIMES, "φ_max/φ_min", ratio, unit="", symbol="k", values=values)
    hint = message("Both angles together are a full turn; φ_max is more than 180°, φ_min less.")
    builder.mistake("φ_max", shorter, hint)
    builder.mistake("φ_min", longer, hint)
    builder.mistake("time_ratio", shorter / longer, message("The longer time is divided by the shorter."))
    return longer


_STARTS = ("overlapping", "stretched")


def stroke_table(
    a: float,
    e: float = 0.0,
    b: float | None = None,
    ratio: float | None = None,
    step: float = 30,
    start: str = "stretched",
    unit: str = "mm",
) -> Solution:
    """The transfer function s(φ) of a slider-crank in steps from a dead centre, with stroke and division.

    It begins where crank and coupler are ``stretched`` (outer dead centre) or ``overlapping`` (*Decklage*, inner dead
    centre). The crank turns counter-clockwise. The table has the crank angle from that dead centre and from the
    slider's line, the slider's displacement s from below the crank's pivot, and its distance from the dead centre.
    """
    if start not in _STARTS:
        raise LinkageError("start is {starts}, not {start!r}", starts=joined_by_or(_STARTS), start=start)
    as_step(step)
    builder = SolutionBuilder(unit=unit)
    rod = _rod(builder, a, b, ratio)
    size = SliderCrank(a, rod, e)
    _add_dead_centres(builder, size)
    centres = size.dead_centres
    assert centres is not None  # _add_dead_centres raises for the others
    from_outer = start == "stretched"
    first = centres.outer if from_outer else centres.inner
    begin = first.drive if first.drive < pi or not from_outer else first.drive - 2 * pi
    low = "" if not e else " - e" if e > 0 else " + e"
    builder.say(
        "The slider's travel at every crank angle, measured from below the crank's pivot:",
        f"s = a·cos φ + √(b² - (a·sin φ{low})²)",
    )
    rows = []
    for k in range(int(360 / step + 1e-9) + 1):
        phi = begin + radians(k * step)
        s = a * cos(phi) + sqrt(rod**2 - (a * sin(phi) - e) ** 2)
        rows.append((k * step, degrees(phi), s, abs(first.output - s)))
    if from_outer:
        title = message("Transfer function s(φ), from the outer dead centre (crank and coupler stretched)")
    else:
        title = message("Transfer function s(φ), from the inner dead centre (crank and coupler overlapping)")
    counted = message("from the dead centre [°]")
    headers = (counted, "φ [°]", f"s [{unit}]", f"l_a - s [{unit}]" if from_outer else f"s - l_i [{unit}]")
    builder.table(title, headers, rows, decimals=3)
    inner = (centres.inner.drive - centres.outer.drive) % (2 * pi)
    name = message("crank angle from the outer to the inner dead centre")
    builder.keep("inner_at", name, degrees(inner), unit="°", symbol="φ_ai")
    moved = move_quietly(size.linkage(), [radians(row[1]) for row in rows])
    builder.check(
        "Largest difference of s in the table from the general solver's",
        0.0,
        max(abs(row[2] - s) for row, s in zip(rows, moved.displacement("P(frame-slider)").tolist(), strict=True)),
    )
    return builder.done()


def _rod(builder: SolutionBuilder, a: float, b: float | None, ratio: float | None) -> float:
    if (b is None) == (ratio is None):
        raise LinkageError("either the coupler b is given or the ratio lambda = a/b")
    as_positive("lambda" if b is None else "b", ratio if b is None else b)
    if ratio is not None:
        name = message("coupler from the ratio of crank to connecting rod")
        return builder.find("b", name, "a/λ", a / ratio, a=a, λ=ratio)
    assert b is not None
    builder.find("λ", _RATIO, "a/b", a / b, unit="", a=a, b=b)
    return b


def stroke_middle(a: float, b: float | None = None, ratio: float | None = None, unit: str = "mm") -> Solution:
    """A central slider-crank in the middle of its stroke, and its distance from the middle of the time.

    >>> solution = stroke_middle(20, 50)
    >>> round(solution.number("φ_H2"), 4), round(solution.number("μ_H2"), 4)
    (78.463, 66.9261)
    """
    builder = SolutionBuilder(unit=unit)
    rod = _rod(builder, a, b, ratio)
    size = SliderCrank(a, rod)
    if size.dead_centres is None:
        raise LinkageError("the crank of the slider-crank a = {a:g}, b = {rod:g} does not turn", a=a, rod=rod)
    builder.find("H", _STROKE, "2·a", 2 * a, a=a)
    builder.find("s_H2", message("slider in the middle of the stroke"), "(l_a + l_i)/2", rod, l_a=rod + a, l_i=rod - a)
    name = message("crank angle in the middle of the stroke, on either side of the outer dead centre")
    text = message(
        "crank angle there: the triangle A₀, A, B has two sides b, so its height from B stands on the middle of a"
    )
    phi = degrees(acos(a / (2 * rod)))
    builder.find("φ_H2", name, "± arccos(a/(2·b))", phi, unit="°", text=text, either_sign=True, a=a, b=rod)
    name = message("crank angle from the inner dead centre to the middle")
    builder.find("φ_iH2", name, "180° - φ_H2", 180 - phi, unit="°", φ_H2=angle(phi))
    name = message("deviation angle in the middle of the stroke")
    values = {"a": formula_number(a), "b": formula_number(rod), "φ_H2": angle(phi)}
    alpha = builder.find(
        "α_H2", name, "arcsin(a·sin φ_H2/b)", degrees(asin(a * sin(radians(phi)) / rod)), unit="°", values=values
    )
    builder.find(
        "μ_H2",
        message("transmission angle in the middle of the stroke"),
        "90° - α_H2",
        90 - alpha,
        unit="°",
        α_H2=angle(alpha),
    )
    _add_middle_of_time(builder, size, phi)
    moved = move_quietly(size.linkage(), [radians(phi)])
    slide = float(moved.displacement("P(frame-slider)")[0])
    rod_angle = degrees(abs(float(moved.angle("coupler")[0])))
    builder.check("s at this angle, by the general solver", rod, slide)
    builder.check("α there, by the general solver", alpha, rod_angle, "°")
    builder.mistake("H", a, _NOT_ONCE)
    builder.mistake("H", rod + a, _ONE_CENTRE)
    _add_middle_mistakes(builder, phi, alpha)
    return builder.done()


def _add_middle_of_time(builder: SolutionBuilder, size: SliderCrank, phi: float) -> None:
    name = message("slider at mid-time, at φ = 90°")
    at_time = builder.find("s_T", name, "√(b² - a²)", sqrt(size.b**2 - size.a**2), a=size.a, b=size.b)
    name = message("mid-stroke minus mid-time")
    offset = builder.find("offset", name, "s_H2 - s_T", size.b - at_time, symbol="Δs", s_H2=size.b, s_T=at_time)
    name = message("the same as a part of the stroke")
    builder.find("offset_H", name, "Δs/H", offset / (2 * size.a), unit="", symbol="δ", Δs=offset, H=2 * size.a)
    name = message("part of the time that the outer half of the stroke takes")
    builder.find("time_part", name, "φ_H2/180°", phi / 180, unit="", symbol="τ", φ_H2=angle(phi))


def _add_middle_mistakes(builder: SolutionBuilder, phi: float, alpha: float) -> None:
    builder.mistake(
        "φ_H2",
        90.0,
        message("At 90° half of the time has passed, but not half of the stroke: the slider is already beyond H/2."),
    )
    builder.mistake("φ_H2", 180 - phi, message("Counted from the inner dead centre; the answer counts from the outer."))
    builder.mistake("φ_iH2", phi, message("Counted from the outer dead centre; the answer counts from the inner."))
    builder.mistake("μ_H2", alpha, message("That is the deviation angle α; μ = 90° - α."))


def crank_rocker(a: float, b: float, c: float, d: float, rpm: float | None = None, unit: str = "mm") -> Solution:
    """Dead centres, swing and division of the crank's turn of a crank-rocker; with a speed also the times.

    >>> solution = crank_rocker(2, 7, 4.5, 5.5, rpm=300, unit="cm")
    >>> round(solution.number("φ_max"), 4), round(solution.number("T_min"), 4)
    (207.287, 84.8405)
    """
    size = FourBar(a, b, c, d)
    if size.dead_centres is None:
        raise LinkageError(
            "the four-bar a = {a:g}, b = {b:g}, c = {c:g}, d = {d:g} is not a crank-rocker: {type}",
            a=a,
            b=b,
            c=c,
            d=d,
            type=in_every_language(size.type.name),
        )
    builder = SolutionBuilder(unit=unit)
    lengths = {"a": formula_number(a), "b": formula_number(b), "c": formula_number(c), "d": formula_number(d)}
    phi_i, phi_a = _dead_centre_angles(builder, size, lengths)
    builder.say(
        "Between the dead centres the crank's line turns by the difference; the crank itself makes half a "
        "turn more or less."
    )
    angles = {"φ_i": angle(phi_i), "φ_a": angle(phi_a)}
    way_angle = _add_times(builder, abs(phi_i - phi_a), angles, "φ_i - φ_a" if phi_i >= phi_a else "φ_a - φ_i")
    _add_swing(builder, size, lengths)
    measured = measures(size.linkage(), speed=None if rpm is None else per_minute(rpm))

    def between(quantity: object) -> Message:
        return message("{quantity}, between the dead centres of the solved motion", quantity=quantity)

    builder.check(between(message("Longer crank angle")), way_angle, degrees(measured.phi_max or 0), "°")
    builder.check(between(message("Swing")), builder.number("ψ_H"), degrees(measured.travel or 0), "°")
    for key, centre in (("i", measured.inner), ("a", measured.outer)):
        rocker, crank = (degrees(centre.output), degrees(centre.drive)) if centre else (0.0, 0.0)
        builder.check(between(f"ψ_{key}"), builder.number(f"ψ_{key}"), rocker, "°")
        line = crank % 180 if key == "i" else crank
        builder.check(between(f"φ_{key}"), builder.number(f"φ_{key}"), line, "°", tolerance=FLAT)
    if rpm is not None:
        _add_durations(
            builder, abs(rpm), 180 + abs(phi_i - phi_a), measured.times.longest * 1000 if measured.times else 0.0
        )
    return builder.done()


def _dead_centre_angles(builder: SolutionBuilder, size: FourBar, lengths: dict[str, str]) -> tuple[float, float]:
    a, b, c, d = size.a, size.b, size.c, size.d
    builder.say(
        "In a dead centre crank and coupler lie on one line; with rocker and frame they form a triangle with "
        "the side b - a (inner) or b + a (outer). The cosine rule gives the angle at A0."
    )
    angles = []
    for key, sign, name in (
        ("φ_i", "-", message("inner dead centre, direction of the coupler's line")),
        ("φ_a", "+", message("outer dead centre, direction of the coupler's line")),
    ):
        side = b - a if sign == "-" else b + a
        value = degrees(acos((side**2 + d**2 - c**2) / (2 * side * d)))
        formula = f"arccos(((b {sign} a)² + d² - c²)/(2·(b {sign} a)·d))"
        angles.append(builder.find(key, name, formula, value, unit="°", values=lengths))
    return angles[0], angles[1]


def _add_swing(builder: SolutionBuilder, size: FourBar, lengths: dict[str, str]) -> None:
    a, b, c, d = size.a, size.b, size.c, size.d
    angles = []
    for key, sign, name in (
        ("ψ_i", "-", message("angle of the rocker in the inner dead centre")),
        ("ψ_a", "+", message("angle of the rocker in the outer dead centre")),
    ):
        side = b - a if sign == "-" else b + a
        value = 180 - degrees(acos((c**2 + d**2 - side**2) / (2 * c * d)))
        formula = f"180° - arccos((c² + d² - (b {sign} a)²)/(2·c·d))"
        angles.append(builder.find(key, name, formula, value, unit="°", values=lengths))
    inner, outer = angles
    swing = builder.find("ψ_H", _SWING, "ψ_i - ψ_a", inner - outer, unit="°", ψ_i=angle(inner), ψ_a=angle(outer))
    builder.mistake("ψ_H", 180 - swing, message("Take both angles of the rocker from the same side of the frame line."))


def _add_durations(builder: SolutionBuilder, rpm: float, longer: float, by_motion: float) -> None:
    name = message("time of one turn")
    period = builder.find("T", name, "(60000 ms/min)/n", 60000 / rpm, unit="ms", n=f"({formula_number(rpm)}/min)")
    times = []
    for key, name, angle_name, part in (
        ("T_max", message("time of the slower stroke"), "φ_max", longer),
        ("T_min", message("time of the quicker stroke"), "φ_min", 360 - longer),
    ):
        values = {angle_name: angle(part), "T": f"{formula_number(period)} ms"}
        times.append(builder.find(key, name, f"{angle_name}/360°·T", part / 360 * period, unit="ms", values=values))
    slow, quick = times
    name = message("difference of the times")
    shown = {"T_max": f"{formula_number(slow)} ms", "T_min": f"{formula_number(quick)} ms"}
    builder.find("ΔT", name, "T_max - T_min", slow - quick, unit="ms", values=shown)
    builder.check("Time of the slower stroke, by the solved motion", slow, by_motion, "ms")
    builder.mistake("ΔT", (slow - quick) / 2, message("That is the distance from T/2; the strokes differ by twice it."))


def central_crank_rocker(a: float, b: float, c: float, unit: str = "mm") -> Solution:
    """The frame length of a central crank-rocker, its swing, ratio and smallest transmission angle.

    >>> solution = central_crank_rocker(30, 75, 60)
    >>> round(solution.number("d"), 6), round(solution.number("μ_min"), 6)
    (91.241438, 52.535031)
    """
    size = FourBar.central(a=a, b=b, c=c)
    builder = SolutionBuilder(unit=unit)
    text = message("frame: in both dead centres B lies on one line through A₀, so the chord of the swing is 2a long")
    name = message("length of the frame")
    builder.find("d", name, "√(b² + c² - a²)", sqrt(b**2 + c**2 - a**2), text=text, a=a, b=b, c=c)
    d = size.d
    builder.find("λ", _RATIO, "a/b", a / b, unit="", a=a, b=b)
    swing = builder.find("ψ_H", _SWING, "2·arcsin(a/c)", 2 * degrees(asin(a / c)), unit="°", a=a, c=c)
    name = message("smallest transmission angle")
    text = message(
        "smallest transmission angle: both frame positions give the same one (one acute, one obtuse), for "
        "cos μ = ± a·d/(b·c)"
    )
    value = degrees(acos((b**2 + c**2 - (d - a) ** 2) / (2 * b * c)))
    formula = "arccos((b² + c² - (d - a)²)/(2·b·c))"
    mu = builder.find("μ_min", name, formula, value, unit="°", text=text, a=a, b=b, c=c, d=d)
    measured = measures(size.linkage())
    builder.check("Swing, from the solved motion", swing, degrees(measured.travel or 0), "°")
    smallest = measured.transmission.smallest.mu if measured.transmission else 0.0
    builder.check("Smallest transmission angle, from the solved motion", mu, degrees(smallest), "°")
    builder.check("Time ratio, 1 for a central linkage", 1.0, measured.time_ratio or 0, "")
    builder.mistake(
        "d", hypot(b, c), message("b² + c² is still a² too much: the triangle has its right angle elsewhere.")
    )
    builder.mistake("d", sqrt(a**2 + b**2 + c**2), message("a² is subtracted, not added."))
    builder.mistake("μ_min", 180 - mu, message("μ is folded to at most 90°."))
    builder.mistake("λ", b / a, message("λ is the crank divided by the coupler."))
    return builder.done()
