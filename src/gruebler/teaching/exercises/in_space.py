"""Universal joints, four-bars on the sphere, bevel differentials, step by step (closed-forms-in-space.md)."""

from __future__ import annotations

import math

from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, in_every_language, message
from gruebler.machines.gears import read_train, speeds
from gruebler.mechanics.fourbar.four_bar_types import FOUR_BAR_TYPES
from gruebler.mechanics.linkages.quantities import as_positive
from gruebler.mechanics.space import SphericalFourBar, UniversalJoint, move
from gruebler.mechanics.space.drive_ranges import spatial_range
from gruebler.teaching.exercises.grashof import comparison_step, turning_sentence
from gruebler.teaching.exercises.solution import Solution, SolutionBuilder, SolutionStep, angle, formula_number

_SPEED = "1/min"
_CLOSE = 1e-9  # degrees


def _cos(degrees: float) -> float:
    return math.cos(math.radians(degrees))


def universal_joint(beta: float, n: float, phi: float | None = None) -> Solution:
    """The speeds of a universal joint that bends by beta degrees, its phase error, and its output at phi.

    >>> solution = universal_joint(30, 1000)
    >>> round(solution.number("n_min"), 3), round(solution.number("n_max"), 3), round(solution.number("ε_max"), 4)
    (866.025, 1154.701, 4.1172)
    """
    joint = UniversalJoint(math.radians(beta))
    builder = SolutionBuilder()
    builder.say(
        "φ is counted from the position in which the fork of the input lies in the plane of both shafts. There the "
        "output is fastest, a quarter of a turn later slowest.",
        "n_2 = n_1 cos β/(1 - sin² β cos² φ)",
    )
    values: dict[str, float | str] = {"n_1": float(n), "β": angle(beta)}
    low = builder.find(
        "n_min", message("smallest speed of the output"), "n_1 cos β", n * _cos(beta), unit=_SPEED, values=values
    )
    high = builder.find(
        "n_max", message("largest speed of the output"), "n_1/cos β", n / _cos(beta), unit=_SPEED, values=values
    )
    uneven = math.sin(math.radians(beta)) * math.tan(math.radians(beta))
    builder.find("U", message("irregularity"), "sin β tan β", uneven, unit="", values=values)
    lead = math.degrees(math.asin(math.tan(math.radians(beta / 2)) ** 2))
    half = {"β": angle(beta)}
    builder.find(
        "ε_max", message("largest lead of the output"), "arcsin(tan²(β/2))", lead, unit="°", symbol="ε", values=half
    )
    _check_shafts(builder, joint, n)
    builder.mistake("n_min", float(n), _NOT_EVEN)
    builder.mistake("n_max", float(n), _NOT_EVEN)
    builder.mistake("n_min", high, _SWAPPED)
    builder.mistake("n_max", low, _SWAPPED)
    builder.mistake("U", 1 / _cos(beta) - 1, message("U compares largest and smallest speed: (n_max - n_min)/n_1."))
    builder.mistake("ε_max", beta / 2, message("The lead is much smaller than the bend angle β: sin ε = tan²(β/2)."))
    if phi is not None:
        _at_angle(builder, beta, n, phi)
    return builder.done()


_NOT_EVEN = message("A single universal joint does not turn evenly: its output is now faster, now slower.")
_SWAPPED = message("The output is slowest with cos β, fastest with 1/cos β.")


def _check_shafts(builder: SolutionBuilder, joint: UniversalJoint, n: float) -> None:
    """Both extremes by the joint as a four-bar on the sphere, the lead by its angles."""
    four_bar = joint.four_bar
    for key, phi in (("n_max", 0.0), ("n_min", math.pi / 2)):
        rate = float(four_bar.motion(phi).output.velocity)
        said = message("{key}: as a four-bar on the sphere with three right angles", key=key)
        builder.check(said, builder.number(key), n * rate, _SPEED)
    at = joint.phase_error_at
    psi = float(four_bar.motion(at).output.value) + math.pi / 2
    builder.check(
        "Lead where tan φ = √(cos β), by the four-bar",
        builder.number("ε_max"),
        abs(math.degrees(math.remainder(psi - at, math.pi))),
        "°",
    )


def _at_angle(builder: SolutionBuilder, beta: float, n: float, phi: float) -> None:
    if not 0 < phi < 90:
        raise LinkageError("the angle φ must lie between 0 and 90 degrees, not {phi!r}", phi=phi)
    tangent = math.tan(math.radians(phi))
    values: dict[str, float | str] = {"n_1": float(n), "β": angle(beta), "φ": angle(phi)}
    psi = math.degrees(math.atan(tangent / _cos(beta)))
    builder.find("ψ", message("angle of the output"), "arctan(tan φ/cos β)", psi, unit="°", values=values)
    speed = n * _cos(beta) / (1 - (math.sin(math.radians(beta)) * _cos(phi)) ** 2)
    name = message("speed of the output at φ")
    builder.find("n_2", name, "n_1 cos β/(1 - sin² β cos² φ)", speed, unit=_SPEED, values=values)
    motion = UniversalJoint(math.radians(beta)).four_bar.motion(math.radians(phi))
    builder.check(
        "Speed at φ: as a four-bar on the sphere with three right angles",
        speed,
        n * float(motion.output.velocity),
        _SPEED,
    )
    builder.mistake(
        "ψ", math.degrees(math.atan(tangent * _cos(beta))), message("That is ψ with the fork at right angles to it.")
    )
    builder.mistake("ψ", phi, _NOT_EVEN)
    builder.mistake("n_2", float(n), _NOT_EVEN)
    other = n * _cos(beta) / (1 - (math.sin(math.radians(beta)) * math.sin(math.radians(phi))) ** 2)
    builder.mistake("n_2", other, message("φ is counted from the other position: cos² φ, not sin² φ."))


# --- four-bars on the sphere ----------------------------------------------------------------------------


def spherical_grashof(a: float, b: float, c: float, d: float) -> Solution:
    """Which links of a four-bar on the sphere turn fully, its arcs in degrees; swing and transmission of a rocker.

    >>> solution = spherical_grashof(30, 80, 60, 70)
    >>> solution["type"].in_language("en"), round(solution.number("ψ_H"), 3)
    ('crank-rocker', 74.512)
    """
    size = SphericalFourBar(*(math.radians(arc) for arc in (a, b, c, d)))
    if not size.limits:
        raise LinkageError("arcs of {a:g}, {b:g}, {c:g}, {d:g} degrees cannot be assembled", a=a, b=b, c=c, d=d)
    arcs = dict(zip("abcd", (float(a), float(b), float(c), float(d)), strict=True))
    builder = SolutionBuilder()
    total = builder.find(
        "total", message("sum of all arcs"), "a + b + c + d", a + b + c + d, unit="°", symbol="Σ", values=arcs
    )
    plain = sorted(arcs.values())
    if total > 360 + _CLOSE:
        builder.say(
            "More than 360°: two axes that are not neighbours are counted from their other ends, which changes "
            "nothing. Every arc then becomes its supplement.",
            "a' = 180° - a",
        )
        arcs = {name: 180 - arc for name, arc in arcs.items()}
    else:
        builder.parts.append(
            SolutionStep(
                text=message("At most 360°: the arcs stay as they are."),
                formula="Σ ≤ 360°",
                numbers=f"{formula_number(total)}° ≤ 360°",
            )
        )
    low, first, second, high = sorted(arcs.values())
    ends = builder.find(
        "sum_ends",
        message("sum of the shortest and the longest arc"),
        "l_min + l_max",
        low + high,
        unit="°",
        symbol="s1",
        l_min=low,
        l_max=high,
    )
    name = message("sum of the two others")
    numbers = {"l'": second, "l''": first}
    others = builder.find("sum_others", name, "l' + l''", first + second, unit="°", symbol="s2", values=numbers)
    shortest = ", ".join(k for k, arc in arcs.items() if abs(arc - low) < _CLOSE)
    place = (ends > others - _CLOSE) + (ends > others + _CLOSE)
    text = message(
        "Grashof's condition on the sphere, shortest arc {shortest}: {meaning}",
        shortest=shortest,
        meaning=_SPHERE_SAYS[place],
    )
    builder.parts.append(comparison_step(text, "<=>"[place], ends, others, "°"))
    turns = "a" in size.turning
    builder.keep("turns", message("the crank a turns fully"), turns)
    kind = in_every_language(size.type.name)
    builder.keep("type", message("type"), kind, symbol="")
    builder.parts.append(
        SolutionStep(
            text=message(
                "The place of the shortest arc ({shortest}; d is the frame) tells the type:", shortest=shortest
            ),
            value=kind,
        )
    )
    if size.turning == ("a",) and size.dead_centres is not None:
        _swing(builder, size, (float(a), float(b), float(c), float(d)))
    if abs(ends - others) > _CLOSE:
        full = spatial_range(
            size.linkage(size.limits[0].start + 0.5 * (size.limits[0].end - size.limits[0].start))
        ).full
        builder.check(turning_sentence(turns), True, bool(full) == turns, "")
    builder.mistake("turns", not turns, message("Compare both sums, and see where the shortest arc is."))
    if total > 360 + _CLOSE:
        builder.mistake("sum_ends", plain[0] + plain[3], _TOO_LONG)
        builder.mistake("sum_others", plain[1] + plain[2], _TOO_LONG)
    for other in FOUR_BAR_TYPES.values():
        builder.mistake("type", in_every_language(other.name), _TYPE)
    return builder.done()


_SPHERE_SAYS = (
    message("the shortest link turns fully against all others."),
    message("limiting case: all four axes can lie in one plane."),
    message("no link turns fully."),
)
_TOO_LONG = message("The arcs are longer than a whole great circle together: take the supplements first.")
_TYPE = message("The sums decide whether a link turns, the place of the shortest arc decides which: d is the frame.")


def _swing(builder: SolutionBuilder, size: SphericalFourBar, arcs: tuple[float, float, float, float]) -> None:
    """Dead centres by the cosine law at B0, the transmission angle by that at B."""
    a, b, c, d = arcs
    values: dict[str, float | str] = dict(zip("abcd", map(angle, arcs), strict=True))
    ends = []
    for key, reach, formula in (("ψ_i", b - a, "b - a"), ("ψ_a", b + a, "b + a")):
        cosine = (_cos(reach) - _cos(c) * _cos(d)) / (math.sin(math.radians(c)) * math.sin(math.radians(d)))
        ends.append(math.degrees(math.acos(max(-1.0, min(1.0, cosine)))))
        name = message("angle of the rocker at B0 in the dead centre with {reach}", reach=formula)
        text = f"arccos((cos({formula}) - cos c cos d)/(sin c sin d))"
        builder.find(key, name, text, ends[-1], unit="°", values=values)
    values = {"ψ_a": angle(ends[1]), "ψ_i": angle(ends[0])}
    name = message("swing of the rocker")
    swing = builder.find("ψ_H", name, "ψ_a - ψ_i", ends[1] - ends[0], unit="°", values=values)
    builder.check("Swing by the closed form of the motion", swing, math.degrees(size.swing or 0.0), "°")
    linkage = size.linkage(0.3)
    turn = move(linkage, [k * math.tau / 360 for k in range(361)], order=0).joint("R(frame-rocker)")
    turned = math.degrees(float(turn.max() - turn.min()))
    builder.check("Swing by following the motion in steps of 1°", swing, turned, "°", tolerance=1e-3)
    inner = []
    for reach in (d - a, d + a):
        cosine = (_cos(reach) - _cos(b) * _cos(c)) / (math.sin(math.radians(b)) * math.sin(math.radians(c)))
        mu = math.degrees(math.acos(max(-1.0, min(1.0, cosine))))
        inner.append(min(mu, 180 - mu))
    least = min(inner)
    sign = "-" if inner[0] <= inner[1] else "+"
    formula = f"arccos(|cos(d {sign} a) - cos b cos c|/(sin b sin c))"
    builder.find("μ_min", message("smallest transmission angle"), formula, least, unit="°", values=values)
    smallest = math.degrees(size.transmission_angle.smallest.mu)
    builder.check("Smallest transmission angle by the closed form", least, smallest, "°")
    builder.mistake("ψ_H", ends[1] + ends[0], message("Both angles are counted from the frame: their difference."))
    builder.mistake(
        "μ_min", max(inner), message("That is the better of both positions with the crank along the frame.")
    )


# --- bevel differentials --------------------------------------------------------------------------------


def differential(n_C: float, n_1: float, z_s: float | None = None, z_p: float | None = None) -> Solution:
    """The second axle shaft of a bevel differential, and with its teeth the planets against the carrier.

    >>> solution = differential(100, 60, 16, 10)
    >>> solution.number("n_2"), solution.number("n_p")
    (140.0, 64.0)
    """
    builder = SolutionBuilder()
    builder.say(
        "Seen from the carrier both axle wheels turn against each other: the planets reverse the sense.",
        "(n_1 - n_C)/(n_2 - n_C) = -1",
    )
    teeth = {key: as_positive(key, z) for key, z in (("z_s", z_s), ("z_p", z_p)) if z is not None}
    _shafts(builder, message("speed of the second axle shaft"), n_C, n_1, **teeth)
    return builder.done()


def differential_in_a_curve(v: float, diameter: float, radius: float, track: float) -> Solution:
    """Speeds of carrier and axle shafts of a car in a curve: v in km/h, the wheel's diameter in mm, else metres.

    >>> solution = differential_in_a_curve(36, 600, 10, 1.5)
    >>> [round(solution.number(key), 2) for key in ("n_C", "n_1", "n_2")]
    [318.31, 294.44, 342.18]
    """
    given = {"v": v, "D": diameter, "R": radius, "s": track}
    for key, value in given.items():
        as_positive(key, value)
    if track >= 2 * radius:
        raise LinkageError("the radius of the curve must be more than half the track")
    builder = SolutionBuilder()
    turns = v / 3.6 / (math.pi * diameter / 1000) * 60
    name = message("speed of the carrier")
    carrier = builder.find("n_C", name, "v/(π D)", turns, unit=_SPEED, v=f"{v:g} km/h", D=f"{diameter:g} mm")
    builder.say("The wheels follow circles of the radii R - s/2 and R + s/2, the middle of the axle one of R.")
    numbers: dict[str, float | str] = {"n_C": carrier, "R": radius, "s": track}
    inner = carrier * (1 - track / (2 * radius))
    name = message("speed of the inner wheel")
    builder.find("n_1", name, "n_C (1 - s/(2·R))", inner, unit=_SPEED, values=numbers)
    _shafts(builder, message("speed of the outer wheel"), carrier, inner)
    outer = carrier * (radius + track / 2) / radius
    builder.check("Outer wheel by its own circle", builder.number("n_2"), outer, _SPEED)
    builder.mistake("n_1", carrier * (1 - track / radius), message("The inner wheel runs half the track nearer."))
    builder.mistake("n_C", 2 * turns, message("π D is the way of a turn: D is the diameter, not the radius."))
    return builder.done()


def _shafts(
    builder: SolutionBuilder, shaft: Message, n_c: float, n_1: float, z_s: float | None = None, z_p: float | None = None
) -> None:
    numbers: dict[str, float | str] = {"n_C": float(n_c), "n_1": float(n_1)}
    n_2 = builder.find("n_2", shaft, "2·n_C - n_1", 2 * n_c - n_1, unit=_SPEED, values=numbers)
    if z_s is not None and z_p is not None:
        teeth = {"z_s": z_s, "z_p": z_p, **numbers}
        planet = abs(n_1 - n_c) * z_s / z_p
        name = message("speed of the planets against the carrier, without sign")
        builder.find("n_p", name, "|n_1 - n_C| z_s/z_p", planet, unit=_SPEED, values=teeth)
        train = read_train(f"bevel first:{z_s:g} planet:{z_p:g} second:-{z_s:g} on carrier").train
        turned = speeds(train, {"carrier": n_c, "first": n_1}).values
        builder.check("Planets, as a train", planet, abs(float(turned["planet"] or 0)), _SPEED)
        builder.mistake("n_p", abs(n_1 - n_c), message("The teeth count, too: z_s/z_p."))
        builder.mistake("n_p", abs(n_1) * z_s / z_p, message("Against the carrier: n_1 - n_C, not n_1."))
    else:
        train = read_train("bevel first:1 planet:1 second:-1 on carrier").train
        turned = speeds(train, {"carrier": n_c, "first": n_1}).values
    builder.check("Second shaft, as a train", n_2, float(turned["second"] or 0), _SPEED)
    builder.mistake("n_2", n_c - n_1, message("The carrier counts twice: n_1 + n_2 = 2 n_C."))
    builder.mistake("n_2", float(n_c), message("Both shafts have the carrier's speed only while they turn alike."))
    builder.mistake("n_2", (n_c + n_1) / 2, message("The carrier has the mean, not the shaft: n_C = (n_1 + n_2)/2."))
