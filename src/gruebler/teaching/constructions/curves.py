"""Coupler curves point by point, curvature, cognates, Meyer zur Capellen's straight-line linkage."""

from __future__ import annotations

import cmath
from math import degrees, pi, radians

from gruebler.base.errors import LinkageError
from gruebler.base.text import message
from gruebler.pictures.canvas.construction import (
    Angle,
    Construction,
    Dot,
    Drawn,
    DrawnCircle,
    DrawnCurve,
    DrawnLine,
    Segment,
)
from gruebler.teaching.constructions.compass import (
    Board,
    along,
    circle_through,
    coordinates,
    degrees_between,
    line_meets_circle,
    lines_meet,
    meet_left,
    mirrored,
    segments,
)
from gruebler.teaching.constructions.given_linkages import check_that_crank_turns, four_bar_given

_HELPER = cmath.rect(1.0, 0.9)  # direction of the auxiliary line of a third proportional, against the ray
_FINE = 360


def _coupler_point(pin: complex, joint: complex, u: float, v: float) -> complex:
    return pin + complex(u, v) * (joint - pin) / abs(joint - pin)


def _trace_triangle(pin: complex, joint: complex, point: complex) -> tuple[Drawn, ...]:
    return Segment(pin, point, "edge"), Segment(joint, point, "edge"), Dot(point, "K")


def coupler_curve_by_points(
    a: float = 30, b: float = 90, c: float = 100, d: float = 120, u: float = 45, v: float = 40, step: float = 30
) -> Construction:
    """The path of a coupler point in numbered positions, with the trace triangle."""
    check_that_crank_turns(a, b, c, d)
    if not 5 <= step <= 120 or abs(360 / step - round(360 / step)) > 1e-9:
        raise LinkageError("step must divide 360° and lie from 5 to 120, not {step!r}", step=step)
    board = Board(message("Coupler curve, point by point"))
    a0, b0 = 0j, complex(d)
    count = round(360 / step)
    pins = [cmath.rect(a, radians(k * step)) for k in range(count)]
    joints = [meet_left(pin, b, b0, c) for pin in pins]
    first = _coupler_point(pins[0], joints[0], u, v)
    board.step(
        "Given: the four-bar a = {a:g}, b = {b:g}, c = {c:g}, d = {d:g} and the trace triangle ABK with the sides "
        "AK = {k:.4g} and BK = {l:.4g}.",
        *(Dot(z, name) for z, name in ((a0, "A₀"), (b0, "B₀"), (pins[0], "A"), (joints[0], "B"), (first, "K"))),
        *segments("edge", a0, pins[0], joints[0], b0),
        Segment(pins[0], first, "edge"),
        Segment(joints[0], first, "edge"),
        a=a,
        b=b,
        c=c,
        d=d,
        k=abs(first - pins[0]),
        l=abs(first - joints[0]),
    )
    board.step(
        "The crank's circle is divided into {count} parts: the positions 0, 1, 2, … of A.",
        DrawnCircle(a0, a, "curve-rest"),
        *(Dot(pin, str(k)) for k, pin in enumerate(pins)),
        count=count,
    )
    board.step(
        "Arcs about the positions of A with b cut the circle about B₀ with c: the positions of B, numbered alike.",
        DrawnCircle(b0, c),
        *(Dot(joint, str(k)) for k, joint in enumerate(joints)),
    )
    points = [_coupler_point(pin, joint, u, v) for pin, joint in zip(pins, joints, strict=True)]
    board.step(
        "The trace triangle is laid on each pair of positions, or K is found with arcs AK and BK.",
        *(Segment(pin, point) for pin, point in zip(pins, points, strict=True)),
        *(Segment(joint, point) for joint, point in zip(joints, points, strict=True)),
        *(Dot(point, str(k)) for k, point in enumerate(points)),
    )
    fine = [cmath.rect(a, 2 * pi * k / _FINE) for k in range(_FINE + 1)]
    path = tuple(_coupler_point(pin, meet_left(pin, b, b0, c), u, v) for pin in fine)
    board.step("The curve through the points is the coupler curve of K.", DrawnCurve(path))
    values = {f"x{k}": point.real for k, point in enumerate(points)}
    return board.done(**values, **{f"y{k}": point.imag for k, point in enumerate(points)})


def _proportional(at: complex, pole: complex, centre: complex) -> tuple[complex, complex, complex]:
    """By two parallels the point J of the ray to a centre with at-J · at-centre = at-pole².

    Returns the length at-pole carried to an auxiliary line, where the parallel cuts that line, and J.
    """
    unit = (centre - at) / abs(centre - at)
    helper = unit * _HELPER
    carried = at + abs(pole - at) * helper
    cut = lines_meet(at, helper, pole, centre - carried)
    return carried, cut, at + abs(cut - at) * unit


def _third_proportional(board: Board, name: str, at: complex, pole: complex, centre: complex) -> complex:
    """The point J of a ray with AJ · AA0 = AP², on the side of A0, by two parallels."""
    carried, cut, third = _proportional(at, pole, centre)
    board.step(
        "Euler and Savary: {name}J · {name}{name}₀ = {name}P². On a line through {name} the length {name}P is laid "
        "off; the parallel through P to the line from its end to {name}₀ cuts off {name}J = {length:.4g}, which is "
        "carried to the polar ray, towards {name}₀.",
        DrawnLine(at, (centre - at) / abs(centre - at) * _HELPER),
        Segment(carried, centre),
        Segment(pole, cut),
        Dot(third, f"J_{name}"),
        name=name,
        length=abs(third - at),
    )
    return third


def _polar_rays(board: Board, pins: tuple[complex, complex, complex, complex]) -> complex:
    a0, pin, joint, b0 = pins
    pole = lines_meet(a0, pin - a0, b0, joint - b0)
    board.step(
        "The polar rays A₀A and B₀B meet in the velocity pole P.",
        DrawnLine(a0, pin - a0),
        DrawnLine(b0, joint - b0),
        Dot(pole, "P"),
    )
    return pole


def inflection_circle(
    a: float = 25, b: float = 70, c: float = 40, d: float = 70, phi: float = 225, u: float = 35, v: float = 25
) -> Construction:
    """The inflection circle by Euler and Savary, and the centre of curvature of the path of a coupler point."""
    board = Board(message("Inflection circle and centre of curvature by Euler and Savary"))
    pins = four_bar_given(board, a, b, c, d, phi)
    a0, pin, joint, b0 = pins
    pole = _polar_rays(board, pins)
    first = _third_proportional(board, "A", pin, pole, a0)
    second = _third_proportional(board, "B", joint, pole, b0)
    middle = circle_through(pole, first, second)
    top = 2 * middle - pole
    board.step(
        "The circle through P, J_A and J_B is the inflection circle, D = {diameter:.4g}. Opposite to P lies the "
        "inflection pole W; the pole normal n is PW, the pole tangent t is perpendicular to it.",
        DrawnCircle(middle, abs(middle - pole), "inflection"),
        DrawnLine(pole, middle - pole, "dead"),
        DrawnLine(pole, 1j * (middle - pole), "dead"),
        Dot(top, "W"),
        Dot(pole + 0.8 * 1j * (middle - pole), "t"),
        Dot(pole + 2.5 * (middle - pole), "n"),
        diameter=2 * abs(middle - pole),
    )
    point = _coupler_point(pin, joint, u, v)
    ends = line_meets_circle(pole, point - pole, middle, abs(middle - pole))
    inflection = max(ends, key=lambda z: abs(z - pole))
    carried, cut, centre = _proportional(point, pole, inflection)
    board.step(
        "A coupler point K: its polar ray meets the circle again in J. The same construction backwards, KK₀ · KJ = "
        "KP², gives the centre of curvature K₀ of its path and the radius {radius:.4g}.",
        *_trace_triangle(pin, joint, point),
        DrawnLine(pole, point - pole),
        Segment(carried, inflection),
        Segment(pole, cut),
        Dot(inflection, "J"),
        Dot(centre, "K₀"),
        radius=abs(centre - point),
    )
    return board.done(diameter=2 * abs(middle - pole), **coordinates(P=pole, W=top, K0=centre))


def bobillier(
    a: float = 25, b: float = 70, c: float = 40, d: float = 70, phi: float = 225, u: float = 35, v: float = 25
) -> Construction:
    """The pole tangent and a centre of curvature by Bobillier's theorem."""
    board = Board(message("Pole tangent and centre of curvature by Bobillier"))
    pins = four_bar_given(board, a, b, c, d, phi)
    a0, pin, joint, b0 = pins
    pole = _polar_rays(board, pins)
    relative = lines_meet(a0, b0 - a0, pin, joint - pin)
    axis = relative - pole
    board.step(
        "A₀B₀ and AB meet in Q. The line PQ is the collineation axis of the pair of rays.",
        DrawnLine(a0, b0 - a0),
        DrawnLine(pin, joint - pin),
        Dot(relative, "Q"),
        DrawnLine(pole, axis, "line-6"),
    )
    ray_a, ray_b = pin - pole, joint - pole
    tangent = ray_a * ray_b / axis
    tangent /= abs(tangent)
    size = 0.5 * abs(b0 - a0)
    board.step(
        "Bobillier: the pole tangent t makes the angle with the ray of A that the ray of B makes with the axis. "
        "The "
        "angle is carried over; t has the direction {angle:.4g}°.",
        Angle(pole, begin=cmath.phase(axis), turn=cmath.phase(ray_b / axis), radius=60),
        Angle(pole, begin=cmath.phase(ray_a), turn=cmath.phase(tangent / ray_a), radius=60),
        DrawnLine(pole, tangent, "inflection"),
        Dot(pole + size * tangent, "t"),
        angle=degrees(cmath.phase(tangent)) % 180,
    )
    point = _coupler_point(pin, joint, u, v)
    ray_k = point - pole
    second_axis = ray_a * ray_k / tangent
    crossing = lines_meet(pin, point - pin, pole, second_axis)
    centre = lines_meet(pole, ray_k, a0, crossing - a0)
    board.step(
        "For a coupler point K the angle is carried over backwards: the axis of the rays of A and K. It meets AK "
        "in Q_K; the line A₀-Q_K meets the ray of K in the centre of curvature K₀ = ({x:.4g}, {y:.4g}).",
        *_trace_triangle(pin, joint, point),
        DrawnLine(pole, ray_k),
        DrawnLine(pole, second_axis),
        DrawnLine(pin, point - pin),
        DrawnLine(a0, crossing - a0),
        Dot(crossing, "Q_K"),
        Dot(centre, "K₀"),
        x=centre.real,
        y=centre.imag,
    )
    return board.done(tangent=degrees(cmath.phase(tangent)) % 180, **coordinates(K0=centre))


def roberts_cognates(
    a: float = 25, b: float = 70, c: float = 40, d: float = 70, u: float = 45, v: float = 40, phi: float = 60
) -> Construction:
    """The two other four-bars with the same coupler curve: parallelograms and similar triangles."""
    board = Board(message("Roberts' cognates"))
    a0, pin, joint, b0 = four_bar_given(board, a, b, c, d, phi)
    point = _coupler_point(pin, joint, u, v)
    board.step("The coupler point K and the coupler triangle ABK.", *_trace_triangle(pin, joint, point))
    first, second = a0 + point - pin, b0 + point - joint
    board.step(
        "Parallelograms A₀AKA′ and B₀BKB″.",
        *segments("line-6", a0, first, point),
        *segments("line-7", b0, second, point),
        Dot(first, "A′"),
        Dot(second, "B″"),
    )
    shape = (point - pin) / (joint - pin)
    left, right = first + shape * (point - first), point + shape * (second - point)
    board.step(
        "Over A′K and KB″ triangles similar to ABK, with the apexes C′ and C″: equal angles are carried over.",
        Segment(first, left, "line-6"),
        Segment(point, left, "line-6"),
        Segment(second, right, "line-7"),
        Segment(point, right, "line-7"),
        Dot(left, "C′"),
        Dot(right, "C″"),
    )
    pivot = left + right - point
    board.step(
        "The parallelogram KC′C₀C″ gives the third pivot C₀; the triangle A₀B₀C₀ is similar to ABK.",
        Segment(left, pivot, "line-6"),
        Segment(right, pivot, "line-7"),
        Segment(a0, pivot, "dead"),
        Segment(b0, pivot, "dead"),
        Dot(pivot, "C₀"),
    )
    lengths = {
        "a1": abs(first - a0),
        "b1": abs(left - first),
        "c1": abs(pivot - left),
        "d1": abs(pivot - a0),
        "a2": abs(second - b0),
        "b2": abs(right - second),
        "c2": abs(pivot - right),
        "d2": abs(pivot - b0),
    }
    board.step(
        message(
            "Measured: A₀A′C′C₀ with {a1:.4g}, {b1:.4g}, {c1:.4g}, frame {d1:.4g}; B₀B″C″C₀ with {a2:.4g}, {b2:.4g}, "
            "{c2:.4g}, frame {d2:.4g}. All three move K on the same curve.",
            **lengths,
        )
    )
    return board.done(**lengths)


def meyer_zur_capellen(ratio: float = 5 / 6, D: float = 10) -> Construction:
    """The symmetric double rocker with a six-point tangent, from its inflection circle (figure 4a of sheet 001)."""
    if not 0.5 < ratio < 1.5:
        raise LinkageError("lambda must lie between 0.5 and 1.5, both excluded, not {ratio!r}", ratio=ratio)
    board = Board(message("Meyer zur Capellen's linkage from its inflection circle"))
    pole, top = 0j, complex(0, D)
    board.step(
        "Given: the pole P with tangent t and normal n, the inflection circle with D = {D:g}, and λ = "
        "{ratio:.4g}. The "
        "coupler point K is the inflection pole.",
        DrawnLine(pole, 1 + 0j, "dead"),
        DrawnLine(pole, 1j, "dead"),
        DrawnCircle(complex(0, D / 2), D / 2, "inflection"),
        Dot(pole, "P"),
        Dot(top, "K"),
        Dot(complex(0.9 * D, 0), "t"),
        Dot(complex(0, 1.2 * D), "n"),
        D=D,
        ratio=ratio,
    )
    height = complex(0, D * (1 + 2 * ratio) / 4)
    cut = line_meets_circle(height, -1 + 0j, top / 2, D / 2)[1]
    board.step(
        "A six-point tangent needs sin² φ₀ = (1 + 2λ)/4. The horizontal line at the height D(1 + 2λ)/4 cuts the "
        "circle in J: by Thales PJ² = PK · height, and PJ = D sin φ₀. The ray PJ makes the angle φ₀ = {phi:.4g}° "
        "with t.",
        DrawnLine(height, 1 + 0j),
        DrawnLine(pole, cut),
        Dot(cut, "J"),
        Segment(cut, top),
        Angle(pole, begin=pi, turn=-radians(degrees_between(cut, -1 + 0j)), text="φ₀", radius=36),
        phi=degrees_between(cut - pole, -1 + 0j),
    )
    level = complex(0, ratio * D)
    pin = lines_meet(pole, cut, level, 1 + 0j)
    joint = mirrored(pin, pole, 1j)
    board.step(
        "The coupler line lies at λD from t. It meets the ray in A, and the mirrored ray in B.",
        DrawnLine(level, 1 + 0j),
        DrawnLine(pole, mirrored(cut, pole, 1j)),
        Dot(pin, "A"),
        Dot(joint, "B"),
        Segment(pin, joint, "edge"),
    )
    # AJ · AA0 = AP²: A0 from A through J.
    unit = (cut - pin) / abs(cut - pin)
    helper = unit * _HELPER
    carried = pin + abs(pole - pin) * helper
    third = lines_meet(pin, helper, pole, cut - carried)
    a0 = along(pin, pin + unit, abs(third - pin))
    b0 = mirrored(a0, pole, 1j)
    board.step(
        "Euler and Savary on the ray: AJ · AA₀ = AP². The parallel through P to the line from J to the end of AP "
        "on "
        "the auxiliary line cuts off AA₀, which is carried to the ray, from A through J.",
        DrawnLine(pin, helper),
        Segment(carried, cut),
        Segment(pole, third),
        Dot(a0, "A₀"),
    )
    board.step(
        "The mirror image gives B₀. Measured: l₁ = l₃ = {l1:.4g}, l₂ = {l2:.4g}, l₄ = {l4:.4g}, k = {k:.4g}.",
        Dot(b0, "B₀"),
        Segment(a0, pin, "edge"),
        Segment(b0, joint, "edge"),
        Segment(pin, top, "edge"),
        Segment(joint, top, "edge"),
        Segment(a0, b0, "given"),
        l1=abs(a0 - pin),
        l2=abs(joint - pin),
        l4=abs(b0 - a0),
        k=abs(top - pin),
    )
    return board.done(
        l1=abs(a0 - pin),
        l2=abs(joint - pin),
        l4=abs(b0 - a0),
        k=abs(top - pin),
        kappa=degrees_between(joint - pin, top - pin),
        phi0=degrees_between(cut, -1 + 0j),
    )
