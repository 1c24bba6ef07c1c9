"""Velocities and accelerations of four-bars and slider-cranks in one pose, step by step."""

from __future__ import annotations

import cmath
from math import atan2, cos, degrees, hypot, pi, radians, sin, sqrt

import numpy as np

from gruebler.base.errors import LinkageError
from gruebler.base.text import message
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages.branch import branch_side
from gruebler.mechanics.linkages.quantities import as_finite
from gruebler.teaching.exercises.solution import Solution, SolutionBuilder, angle, figure

_COUPLER_RATE = message("angular velocity of the coupler")
_COUPLER_ACCELERATION = message("angular acceleration of the coupler")
_SPEED_A = message("velocity of the crank pin A")
_ACCELERATION_A = message("acceleration of A, towards A0 (constant speed of the crank)")
_SIGN_OF_BETA = message(
    "β has a sign: it is negative where the rod falls from A to B. With the acute angle |β| there, φ + |β| stands in "
    "place of φ - β."
)
_TURNED = message("The sign says in which sense: positive is counter-clockwise, as the crank turns.")


def four_bar(
    a: float, b: float, c: float, d: float, phi: float, omega: float, branch: str = "+", unit: str = "mm"
) -> Solution:
    """Velocity and acceleration of the joint B of a four-bar at a crank angle, crank at constant speed (rad/s).

    >>> solution = four_bar(25, 70, 40, 70, phi=55, omega=10)
    >>> round(solution.number("v_B"), 6), round(solution.number("i"), 6), round(solution.number("a_B"), 5)
    (191.408211, 2.089775, 2024.47534)
    """
    size = FourBar(a, b, c, d)
    if as_finite("omega", omega) == 0:
        raise LinkageError("at ω = 0 nothing moves: give an angular velocity")
    side = branch_side(branch)
    pose = size.motion(radians(phi), branch=branch)
    if not pose.complete:
        raise LinkageError(pose.message)
    builder = SolutionBuilder(unit=unit)
    theta, psi = _directions(builder, size, phi, side)
    builder.say(
        "Velocities: v_B = v_A + v_BA. v_A is at right angles to the crank, v_B to the rocker, v_BA to the "
        "coupler; the triangle of velocities has the angles between them."
    )
    rates = _four_bar_rates(builder, size, (phi, theta, psi), omega)
    _four_bar_accelerations(builder, size, (phi, theta, psi), (omega, *rates))
    moved = move_quietly(size.linkage(), [radians(phi)], speed=omega, branch=branch)
    _add_vectors(builder, moved)
    _check_four_bar(builder, size, moved, phi)
    return builder.done()


def _directions(builder: SolutionBuilder, size: FourBar, phi: float, side: int) -> tuple[float, float]:
    a, b, c, d = size.a, size.b, size.c, size.d
    crank = radians(phi)
    joint = a * cmath.exp(1j * crank)
    diagonal = builder.find(
        "f", message("diagonal A-B0"), "√(a² + d² - 2·a·d·cos φ)", abs(d - joint), a=a, d=d, φ=angle(phi)
    )
    name = message("direction of the diagonal")
    values: dict[str, float | str] = {"a": a, "d": d, "φ": angle(phi)}
    delta = degrees(cmath.phase(d - joint))
    builder.find("δ", name, "-arctan(a·sin φ/(d - a·cos φ))", delta, unit="°", values=values)
    opening = degrees(np.arccos((b**2 + diagonal**2 - c**2) / (2 * b * diagonal)))
    name = message("angle between coupler and diagonal")
    builder.find("ε", name, "arccos((b² + f² - c²)/(2·b·f))", opening, unit="°", b=b, f=diagonal, c=c)
    name = message("direction of the coupler, from A to B")
    sign = "+" if side > 0 else "-"
    theta = builder.find("θ", name, f"δ {sign} ε", delta + side * opening, unit="°", δ=angle(delta), ε=angle(opening))
    end = joint + b * cmath.exp(1j * radians(theta))
    name = message("direction of the rocker, from B0 to B")
    psi = degrees(cmath.phase(end - d))
    values = {"B_x": end.real, "B_y": end.imag, "d": d}
    builder.say(
        "Joint B = ({real}, {imag}) {unit}, in the frame with A0 = (0, 0) and B0 = (d, 0).",
        "B = A + b·(cos θ, sin θ)",
        real=figure(end.real),
        imag=figure(end.imag),
        unit=builder.unit,
    )
    half = "" if end.real > d else " + 180°" if psi > 0 else " - 180°"
    builder.find("ψ", name, f"arctan(B_y/(B_x - d)){half}", psi, unit="°", values=values)
    mu = abs(psi - theta) % 360
    mu = min(mu, 360 - mu)
    name = message("transmission angle")
    builder.keep("μ", name, min(mu, 180 - mu), unit="°")
    return theta, psi


def _four_bar_rates(
    builder: SolutionBuilder, size: FourBar, angles: tuple[float, float, float], omega: float
) -> tuple[float, float]:
    a, b, c = size.a, size.b, size.c
    phi, theta, psi = (radians(x) for x in angles)
    shown = dict(zip("φθψ", map(angle, angles), strict=True))
    speed = builder.find("v_A", _SPEED_A, "a·ω", a * abs(omega), unit=f"{builder.unit}/s", a=a, ω=abs(omega))
    name = message("angular velocity of the rocker")
    if min(abs(sin(psi - theta)), abs(sin(phi - theta))) < 1e-9:
        raise LinkageError("in the dead centre at φ = {angle:g}° there is no transmission ratio", angle=angles[0])
    rocker = omega * a * sin(phi - theta) / (c * sin(psi - theta))
    formula = "ω·a·sin(φ - θ)/(c·sin(ψ - θ))"
    builder.find("ω_c", name, formula, rocker, unit="1/s", a=a, c=c, ω=omega, values=shown)
    coupler = omega * a * sin(phi - psi) / (b * sin(psi - theta))
    formula = "ω·a·sin(φ - ψ)/(b·sin(ψ - θ))"
    builder.find("ω_b", _COUPLER_RATE, formula, coupler, unit="1/s", a=a, b=b, ω=omega, values=shown)
    builder.say(_TURNED)
    name = message("velocity of the joint B")
    builder.find("v_B", name, "c·|ω_c|", c * abs(rocker), unit=f"{builder.unit}/s", c=c, ω_c=rocker)
    name = message("velocity of B about A")
    builder.find("v_BA", name, "b·|ω_b|", b * abs(coupler), unit=f"{builder.unit}/s", b=b, ω_b=coupler)
    name = message("transmission ratio in this pose")
    ratio = builder.find("i", name, "ω/ω_c", omega / rocker, unit="", ω=omega, ω_c=rocker)
    builder.mistake("i", 1 / ratio, message("i is the input speed divided by the output speed."))
    builder.mistake("v_B", speed, message("v_A and v_B differ: the coupler turns."))
    builder.mistake("v_B", c * abs(omega), message("The rocker turns with ω_c, not with ω."))
    return coupler, rocker


def _four_bar_accelerations(
    builder: SolutionBuilder, size: FourBar, angles: tuple[float, float, float], rates: tuple[float, float, float]
) -> None:
    a, b, c = size.a, size.b, size.c
    phi, theta, psi = (radians(x) for x in angles)
    omega, coupler, rocker = rates
    unit = f"{builder.unit}/s²"
    builder.say(
        "Accelerations: a_B = a_A + a_BA, each with a normal part towards the centre, r·ω², and a tangential one, r·α."
    )
    a_a = builder.find("a_A", _ACCELERATION_A, "a·ω²", a * omega**2, unit=unit, a=a, ω=omega)
    name = message("centripetal part of B about A")
    about = builder.find("a_BAn", name, "b·ω_b²", b * coupler**2, unit=unit, b=b, ω_b=coupler)
    name = message("centripetal part of B about B0")
    normal = builder.find("a_Bn", name, "c·ω_c²", c * rocker**2, unit=unit, c=c, ω_c=rocker)
    shown: dict[str, float | str] = dict(zip("φθψ", map(angle, angles), strict=True))
    values = shown | {"a_A": a_a, "a_BAn": about, "a_Bn": normal, "b": b, "c": c}
    name = message("angular acceleration of the rocker")
    alpha_c = (a_a * cos(phi - theta) + about - normal * cos(psi - theta)) / (c * sin(psi - theta))
    formula = "(a_A·cos(φ - θ) + a_BAn - a_Bn·cos(ψ - θ))/(c·sin(ψ - θ))"
    builder.find("α_c", name, formula, alpha_c, unit="1/s²", values=values)
    alpha_b = (a_a * cos(phi - psi) + about * cos(psi - theta) - normal) / (b * sin(psi - theta))
    formula = "(a_A·cos(φ - ψ) + a_BAn·cos(ψ - θ) - a_Bn)/(b·sin(ψ - θ))"
    builder.find("α_b", _COUPLER_ACCELERATION, formula, alpha_b, unit="1/s²", values=values)
    name = message("tangential part of B about B0")
    tangential = builder.find("a_Bt", name, "c·|α_c|", c * abs(alpha_c), unit=unit, c=c, α_c=alpha_c)
    name = message("tangential part of B about A")
    builder.find("a_BAt", name, "b·|α_b|", b * abs(alpha_b), unit=unit, b=b, α_b=alpha_b)
    name = message("acceleration of the joint B")
    builder.find("a_B", name, "√(a_Bn² + a_Bt²)", hypot(normal, tangential), unit=unit, a_Bn=normal, a_Bt=tangential)
    builder.mistake("a_B", normal + tangential, message("The parts are at right angles: add them by Pythagoras."))
    builder.mistake("a_B", normal, message("The tangential part is missing."))


def _add_vectors(builder: SolutionBuilder, moved: Motion) -> None:
    """The vectors of the plans of velocities and accelerations, from the general solver."""
    pins = {name: moved.linkage.points_named(name)[-1] for name in ("R(crank-coupler)", "R(coupler-rocker)")}
    a, b = pins.values()
    va, vb = (moved.complex_point(p, order=1)[0] for p in (a, b))
    aa, ab = (moved.complex_point(p, order=2)[0] for p in (a, b))
    arm = moved.turns[0, moved.link_index("rocker")]
    along = arm * (ab * np.conj(arm)).real
    coupler = moved.turns[0, moved.link_index("coupler")]
    relative = coupler * ((ab - aa) * np.conj(coupler)).real
    rows = [
        ("v_A", va),
        ("v_BA", vb - va),
        ("v_B", vb),
        ("a_A", aa),
        ("a_BAn", relative),
        ("a_BAt", ab - aa - relative),
    ]
    rows += [("a_Bn", along), ("a_Bt", ab - along), ("a_B", ab)]
    title = message("Vectors of the plans of velocities and accelerations")
    headers = (message("vector"), "x", "y", message("magnitude"))
    builder.table(title, headers, [(name, float(z.real), float(z.imag), float(abs(z))) for name, z in rows])


def _check_four_bar(builder: SolutionBuilder, size: FourBar, moved: Motion, phi: float) -> None:
    speed = f"{builder.unit}/s"
    a = size.a * cmath.exp(1j * radians(phi))
    b = complex(moved.complex_point("R(coupler-rocker)")[0])
    v_a, v_b = (builder.number(key) for key in ("v_A", "v_B"))
    # The pole of the coupler is the intersection of the lines of crank and rocker.
    u, w = a / abs(a), (b - size.d) / size.c
    cross = (np.conj(u) * w).imag
    if abs(cross) > 1e-9:
        pole = u * ((size.d * np.conj(w)).imag / (u * np.conj(w)).imag)
        builder.keep("P_x", message("instant centre of the coupler, x"), float(pole.real), unit=builder.unit)
        builder.keep("P_y", message("instant centre of the coupler, y"), float(pole.imag), unit=builder.unit)
        builder.check(
            "v_B by the instant centre P of the coupler, v_A·PB/PA",
            v_b,
            v_a * float(abs(b - pole) / abs(a - pole)),
            speed,
        )
    vector = moved.complex_point("R(coupler-rocker)", order=1)[0]
    builder.check("{quantity} by the general solver", v_b, float(abs(vector)), speed, quantity="v_B")
    acceleration = float(abs(moved.complex_point("R(coupler-rocker)", order=2)[0]))
    a_b = builder.number("a_B")
    builder.check("{quantity} by the general solver", a_b, acceleration, f"{builder.unit}/s²", quantity="a_B")
    for key, link in (("α_b", "coupler"), ("α_c", "rocker")):
        value = builder.number(key)
        builder.check(
            "{quantity} by the general solver", value, float(moved.angular(link, order=2)[0]), "1/s²", quantity=key
        )


def slider_crank(
    a: float, b: float, phi: float, omega: float, e: float = 0.0, unit: str = "mm", either: float = 0
) -> Solution:
    """Velocity and acceleration of the slider at a crank angle from its line, crank at constant speed (rad/s).

    With ``either`` = 1 the solution adds the values for the same angle from the inner dead centre of a central one.

    >>> solution = slider_crank(25, 70, phi=55, omega=10)
    >>> round(solution.number("v_B"), 6), round(solution.number("a_B"), 6)
    (-248.657931, -1143.345966)
    """
    size = SliderCrank(a, b, e)
    if not size.motion(radians(phi)).complete:
        raise LinkageError(size.motion(radians(phi)).message)
    builder = SolutionBuilder(unit=unit)
    crank = radians(phi)
    low = "e - a·sin φ" if e else "-a·sin φ"
    beta = atan2(e - a * sin(crank), sqrt(b**2 - (e - a * sin(crank)) ** 2))
    name = message("inclination of the coupler (negative: it falls towards the slider)")
    values: dict[str, float | str] = {"a": a, "b": b, "e": e, "φ": angle(phi)}
    numerator = f"({low})" if e else low
    builder.find("β", name, f"arcsin({numerator}/b)", degrees(beta), unit="°", values=values)
    values |= {"β": angle(degrees(beta)), "ω": omega}
    builder.find("v_A", _SPEED_A, "a·ω", a * abs(omega), unit=f"{unit}/s", a=a, ω=abs(omega))
    rate = -omega * a * cos(crank) / (b * cos(beta))
    builder.find("ω_b", _COUPLER_RATE, "-ω·a·cos φ/(b·cos β)", rate, unit="1/s", values=values)
    name = message("velocity of the slider (negative: towards the crank)")
    v = builder.find(
        "v_B",
        name,
        "-ω·a·sin(φ - β)/cos β",
        -omega * a * sin(crank - beta) / cos(beta),
        unit=f"{unit}/s",
        values=values,
    )
    builder.mistake("v_B", -omega * a * sin(crank + beta) / cos(beta), _SIGN_OF_BETA)
    builder.mistake(
        "v_B", -omega * a * sin(crank), message("That holds for an endless rod: here it is inclined, by β.")
    )
    builder.find("a_A", _ACCELERATION_A, "a·ω²", a * omega**2, unit=f"{unit}/s²", a=a, ω=omega)
    values["ω_b"] = rate
    alpha = (a * omega**2 * sin(crank) + b * rate**2 * sin(beta)) / (b * cos(beta))
    builder.find(
        "α_b", _COUPLER_ACCELERATION, "(a·ω²·sin φ + b·ω_b²·sin β)/(b·cos β)", alpha, unit="1/s²", values=values
    )
    name = message("acceleration of the slider (negative: towards the crank)")
    acceleration = -a * omega**2 * cos(crank) - b * rate**2 * cos(beta) - b * alpha * sin(beta)
    formula = "-a·ω²·cos φ - b·ω_b²·cos β - b·α_b·sin β"
    builder.find("a_B", name, formula, acceleration, unit=f"{unit}/s²", values=values, α_b=alpha)
    builder.keep("μ", message("transmission angle"), 90 - abs(degrees(beta)), unit="°")
    if either and not e:
        _add_inner(builder, size, phi, omega)
    _check_slider(builder, size, (phi, omega), (v, acceleration))
    return builder.done()


def _add_inner(builder: SolutionBuilder, size: SliderCrank, phi: float, omega: float) -> None:
    """The values for the angle counted from the inner dead centre."""
    other = size.motion(pi + radians(phi), omega=omega)
    v, a = float(other.output.velocity), float(other.output.acceleration)
    unit = builder.unit
    builder.keep("v_B_i", message("velocity from the inner dead centre"), v, unit=f"{unit}/s")
    builder.keep("a_B_i", message("acceleration from the inner dead centre"), a, unit=f"{unit}/s²")
    builder.say(
        "Counted from the inner dead centre (crank and rod overlapping) it would be v_B = {v} {unit}/s and "
        "a_B = {a} {unit}/s².",
        v=figure(v),
        unit=unit,
        a=figure(a),
    )


def _check_slider(
    builder: SolutionBuilder, size: SliderCrank, inputs: tuple[float, float], results: tuple[float, float]
) -> None:
    phi, omega = inputs
    v, acceleration = results
    unit, a, b = builder.unit, size.a, size.b
    moved = move_quietly(size.linkage(), [radians(phi)], speed=omega)
    slide = "P(frame-slider)"
    builder.check(
        "{quantity} by the general solver", v, float(moved.displacement(slide, order=1)[0]), f"{unit}/s", quantity="v_B"
    )
    second = float(moved.displacement(slide, order=2)[0])
    builder.check("{quantity} by the general solver", acceleration, second, f"{unit}/s²", quantity="a_B")
    crank, lam = radians(phi), a / b
    rough_v = -a * omega * (sin(crank) + lam / 2 * sin(2 * crank))
    rough_a = -a * omega**2 * (cos(crank) + lam * cos(2 * crank))
    moves = message(
        "The slider moves away from the crank: positive." if v > 0 else "The slider moves towards the crank: negative."
    )
    points = message(
        "The acceleration points away from the crank: positive."
        if acceleration > 0
        else "The acceleration points towards the crank: negative."
    )
    builder.mistake("v_B", -v, moves)
    builder.mistake("a_B", -acceleration, points)
    if not size.e:
        near = message("That is the approximation for small λ: sin φ + λ/2·sin 2φ.")
        builder.mistake("v_B", rough_v, near)
        builder.mistake("a_B", rough_a, message("That is the approximation cos φ + λ·cos 2φ."))
        builder.keep("v_approx", message("velocity for small λ"), rough_v, unit=f"{unit}/s")
        builder.keep("a_approx", message("acceleration for small λ"), rough_a, unit=f"{unit}/s²")
    builder.mistake("v_B", -a * omega * sin(crank), message("The tilt of the rod is missing."))
