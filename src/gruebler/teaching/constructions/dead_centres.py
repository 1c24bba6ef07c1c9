"""Dead centres, transmission angles, permissible lengths: circles about the pivots."""

from __future__ import annotations

import cmath
from math import degrees, pi

from gruebler.base.errors import LinkageError
from gruebler.base.text import message
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.pictures.canvas.construction import (
    Angle,
    Construction,
    Dot,
    Drawn,
    DrawnCircle,
    DrawnLine,
    Segment,
    quantity,
)
from gruebler.teaching.constructions.compass import (
    Board,
    along,
    degrees_between,
    line_meets_circle,
    meet_left,
    segments,
    turned_angle,
)
from gruebler.teaching.constructions.given_linkages import check_that_crank_turns


def _crank_rocker_given(board: Board, a: float, b: float, c: float, d: float) -> tuple[complex, complex]:
    """The step with the given lengths, the frame and the circle of the crank; returns A0 and B0."""
    a0, b0 = 0j, complex(d)
    board.step(
        "Given: the frame A₀B₀ = {d:g}, the crank a = {a:g}, the coupler b = {b:g}, the rocker c = {c:g}.",
        Dot(a0, "A₀"),
        Dot(b0, "B₀"),
        Segment(a0, b0, "given"),
        DrawnCircle(a0, a, "curve-rest"),
        a=a,
        b=b,
        c=c,
        d=d,
    )
    return a0, b0


def dead_centres_of_crank_rocker(a: float = 20, b: float = 70, c: float = 45, d: float = 55) -> Construction:
    """Both dead centres: the circles b - a and b + a about A0 meet the circle of the rocker."""
    if FourBar(a, b, c, d).dead_centres is None:
        raise LinkageError(
            "the four-bar a = {a:g}, b = {b:g}, c = {c:g}, d = {d:g} is not a crank-rocker", a=a, b=b, c=c, d=d
        )
    board = Board(message("Dead centres of a crank-rocker"))
    a0, b0 = _crank_rocker_given(board, a, b, c, d)
    board.step(
        "The pin B of the rocker moves on the circle about B₀ with the radius c = {c:g}.", DrawnCircle(b0, c), c=c
    )
    outer = meet_left(a0, b + a, b0, c)
    board.step(
        "Outer dead centre: crank and coupler are stretched. The circle about A₀ with the radius b + a = {sum:g} "
        "meets the circle of the rocker in B_a.",
        DrawnCircle(a0, b + a),
        Dot(outer, "B_a"),
        sum=a + b,
    )
    inner = meet_left(a0, b - a, b0, c)
    board.step(
        "Inner dead centre: crank and coupler overlap. The circle about A₀ with the radius b - a = {rest:g} meets "
        "it in B_i.",
        DrawnCircle(a0, b - a),
        Dot(inner, "B_i"),
        rest=b - a,
    )
    pin_outer = along(a0, outer, a)
    pin_inner = along(a0, inner, -a)
    board.step(
        "The lines A₀B_a and A₀B_i meet the crank's circle in A_a and, beyond A₀, in A_i.",
        *segments("edge", a0, outer, b0),
        *segments("ghost", pin_inner, inner, b0),
        Dot(pin_outer, "A_a"),
        Dot(pin_inner, "A_i"),
    )
    phi_a, phi_i = cmath.phase(outer), cmath.phase(inner)
    # The crank goes from the outer to the inner dead centre counter-clockwise.
    return_angle = (cmath.phase(pin_inner) - phi_a) % (2 * pi)
    swing = turned_angle(outer - b0, inner - b0)
    longer = max(return_angle, 2 * pi - return_angle)
    board.step(
        "Measured: φ_a = {outer:.4g}°, φ_i = {inner:.4g}°, the crank angles between the dead centres {longer:.4g}° "
        "and {shorter:.4g}°, the swing of the rocker ψ_H = {swing:.4g}°.",
        Angle(a0, begin=phi_a, turn=return_angle, text=quantity("φ", degrees(return_angle), "°"), radius=30),
        Angle(b0, begin=cmath.phase(outer - b0), turn=swing, text=quantity("ψ_H", degrees(abs(swing)), "°"), radius=46),
        outer=degrees(phi_a),
        inner=degrees(phi_i),
        longer=degrees(longer),
        shorter=360 - degrees(longer),
        swing=degrees(abs(swing)),
    )
    return board.done(
        phi_outer=degrees(phi_a),
        phi_inner=degrees(cmath.phase(pin_inner)) % 360,
        phi_max=degrees(longer),
        swing=degrees(abs(swing)),
        time_ratio=longer / (2 * pi - longer),
    )


def _turning_slider_crank_given(board: Board, a: float, b: float, e: float, end: float, *drawn: Drawn) -> complex:
    """The step with the given lengths, the circle of the crank and the line of the slider; returns A0."""
    if SliderCrank(a, b, e).dead_centres is None:
        raise LinkageError("the crank of the slider-crank a = {a:g}, b = {b:g}, e = {e:g} does not turn", a=a, b=b, e=e)
    board.step(
        "Given: the crank a = {a:g} about A₀, the coupler b = {b:g}, the line of the slider at the distance e = {e:g}.",
        Dot(0j, "A₀"),
        DrawnCircle(0j, a, "curve-rest"),
        Segment(complex(-a, e), complex(end, e), "given"),
        *drawn,
        a=a,
        b=b,
        e=abs(e),
    )
    return 0j


def dead_centres_of_slider_crank(a: float = 17, b: float = 60, e: float = 15) -> Construction:
    """Both dead centres: the circles b - a and b + a about A0 meet the line of the slider."""
    board = Board(message("Dead centres of a slider-crank"))
    rail = complex(0, e)
    offset = [Segment(0j, rail, "help", quantity("e", abs(e)))] if e else []
    a0 = _turning_slider_crank_given(board, a, b, e, a + b + 0.2 * a, *offset)
    _, outer = line_meets_circle(rail, 1 + 0j, a0, b + a)
    board.step(
        "Outer dead centre: crank and coupler are stretched. The circle about A₀ with the radius b + a = {sum:g} "
        "meets the line in T_a.",
        DrawnCircle(a0, b + a),
        Dot(outer, "T_a"),
        sum=a + b,
    )
    _, inner = line_meets_circle(rail, 1 + 0j, a0, b - a)
    board.step(
        "Inner dead centre: crank and coupler overlap. The circle about A₀ with the radius b - a = {rest:g} meets "
        "it in T_i.",
        DrawnCircle(a0, b - a),
        Dot(inner, "T_i"),
        rest=b - a,
    )
    pin_outer, pin_inner = along(a0, outer, a), along(a0, inner, -a)
    board.step(
        "The lines A₀T_a and A₀T_i meet the crank's circle in A_a and, beyond A₀, in A_i.",
        Segment(a0, outer, "edge"),
        Segment(pin_inner, inner, "ghost"),
        Dot(pin_outer, "A_a"),
        Dot(pin_inner, "A_i"),
    )
    stroke = abs(outer - inner)
    turn = turned_angle(pin_outer, pin_inner) % (2 * pi)
    longer = max(turn, 2 * pi - turn)
    low = -0.35 * a if e >= 0 else 0.35 * a
    board.step(
        "Measured: l_a = {outer:.4g}, l_i = {inner:.4g}, the stroke H = {stroke:.4g}, the crank angles between the "
        "dead centres {longer:.4g}° and {shorter:.4g}°.",
        Segment(inner - 1j * low, outer - 1j * low, "dimension", quantity("H", stroke)),
        Angle(a0, begin=cmath.phase(pin_outer), turn=turn, text=quantity("φ", degrees(turn), "°"), radius=30),
        outer=outer.real,
        inner=inner.real,
        stroke=stroke,
        longer=degrees(longer),
        shorter=360 - degrees(longer),
    )
    return board.done(
        l_outer=outer.real,
        l_inner=inner.real,
        stroke=stroke,
        phi_max=degrees(longer),
        time_ratio=longer / (2 * pi - longer),
    )


def transmission_of_crank_rocker(a: float = 20, b: float = 50, c: float = 40, d: float = 50) -> Construction:
    """The extremes of the transmission angle: the crank lies on the line of the frame."""
    check_that_crank_turns(a, b, c, d)
    board = Board(message("Extremes of the transmission angle of a crank-rocker"))
    a0, b0 = _crank_rocker_given(board, a, b, c, d)
    places, folded = [], []
    for k, (pin, name) in enumerate(((complex(a), "I"), (complex(-a), "II"))):
        board.step(
            "The crank over the frame: A_I at the distance d - a = {rest:g} from B₀."
            if k == 0
            else "The crank away from the frame: A_II at the distance d + a = {rest:g} from B₀.",
            Dot(pin, f"A_{name}"),
            Segment(a0, pin, "edge" if k == 0 else "ghost"),
            rest=abs(b0 - pin),
        )
        joint = meet_left(pin, b, b0, c)
        mu = turned_angle(pin - joint, b0 - joint)
        places.append(joint)
        folded.append(min(degrees(abs(mu)), 180 - degrees(abs(mu))))
        board.step(
            "The circles about A_{name} with b and about B₀ with c meet in B_{name}. The angle there between "
            "coupler and rocker is {angle:.4g}°.",
            DrawnCircle(pin, b),
            DrawnCircle(b0, c),
            *segments("edge" if k == 0 else "ghost", pin, joint, b0),
            Dot(joint, f"B_{name}"),
            Angle(
                joint,
                begin=cmath.phase(pin - joint),
                turn=mu,
                text=quantity(f"μ_{name}", degrees(abs(mu)), "°"),
                radius=34,
            ),
            name=name,
            angle=degrees(abs(mu)),
        )
    board.step(
        "An obtuse angle counts as its supplement. The smallest transmission angle is μ_min = {least:.4g}°, the "
        "largest deviation angle 90° - μ_min = {deviation:.4g}°.",
        least=min(folded),
        deviation=90 - min(folded),
    )
    return board.done(mu_min=min(folded), mu_I=folded[0], mu_II=folded[1])


def transmission_of_slider_crank(a: float = 30, b: float = 50, e: float = 10) -> Construction:
    """The extreme of the transmission angle: the crank is perpendicular to the line of the slider."""
    board = Board(message("Smallest transmission angle of a slider-crank"))
    a0, rail = _turning_slider_crank_given(board, a, b, e, a + b), complex(0, e)
    pin = complex(0, -a if e >= 0 else a)
    board.step(
        "The coupler is most inclined where the crank is perpendicular to the line of the slider and points away "
        "from it: A at the distance a + e = {sum:g} from the line.",
        Segment(a0, pin, "edge"),
        Dot(pin, "A"),
        DrawnLine(a0, 1j),
        sum=a + abs(e),
    )
    _, joint = line_meets_circle(rail, 1 + 0j, pin, b)
    normal = complex(0, (pin - rail).imag)
    mu = turned_angle(pin - joint, normal)
    board.step(
        "The circle about A with b meets the line in B.",
        DrawnCircle(pin, b),
        Segment(pin, joint, "edge"),
        Dot(joint, "B"),
        Segment(joint, joint + 0.8 * normal, "dead"),
    )
    least = degrees(abs(mu))
    board.step(
        "Between the coupler and the normal of the line lies the transmission angle: μ_min = {least:.4g}°. The "
        "deviation angle is α_max = 90° - μ_min = {deviation:.4g}°.",
        Angle(joint, begin=cmath.phase(pin - joint), turn=mu, text=quantity("μ_min", least, "°"), radius=40),
        least=least,
        deviation=90 - least,
    )
    return board.done(mu_min=least, deviation=90 - least)


def central_crank_rocker(a: float = 30, b: float = 75, c: float = 60) -> Construction:
    """The frame of a central crank-rocker: both dead centres of the rocker's pin lie on one line with A0."""
    if not a < c or not a < b:
        raise LinkageError(
            "a central crank-rocker has a < b and a < c, not a = {a:g}, b = {b:g}, c = {c:g}", a=a, b=b, c=c
        )
    board = Board(message("Central crank-rocker"))
    a0 = 0j
    inner, outer = complex(b - a), complex(b + a)
    board.step(
        "Given: crank a = {a:g}, coupler b = {b:g}, rocker c = {c:g}. In a central crank-rocker both dead centres "
        "B_i and B_a lie on one line through A₀.",
        Dot(a0, "A₀"),
        DrawnCircle(a0, a, "curve-rest"),
        Segment(a0, complex(1.1 * (a + b)), "dead"),
        a=a,
        b=b,
        c=c,
    )
    board.step(
        "On the line from A₀: B_i at b - a = {inner:g}, B_a at b + a = {outer:g}; their distance is 2a.",
        DrawnCircle(a0, b - a),
        DrawnCircle(a0, b + a),
        Dot(inner, "B_i"),
        Dot(outer, "B_a"),
        inner=b - a,
        outer=b + a,
    )
    pivot = meet_left(outer, c, inner, c)
    board.step(
        "The circles about B_i and B_a with the radius c = {c:g} meet in B₀.",
        DrawnCircle(inner, c),
        DrawnCircle(outer, c),
        Segment(inner, pivot, "ghost"),
        Segment(outer, pivot, "edge"),
        Dot(pivot, "B₀"),
        c=c,
    )
    frame, swing = abs(pivot - a0), degrees_between(inner - pivot, outer - pivot)
    board.step(
        "Measured: the frame A₀B₀ = d = {d:.4g}, the swing of the rocker ψ_H = {swing:.4g}°.",
        Segment(a0, pivot, "given", quantity("d", frame)),
        Angle(
            pivot,
            begin=cmath.phase(inner - pivot),
            turn=turned_angle(inner - pivot, outer - pivot),
            text=quantity("ψ_H", swing, "°"),
            radius=40,
        ),
        d=frame,
        swing=swing,
    )
    return board.done(d=frame, swing=swing)


def permissible_frame(a: float = 25, b: float = 40, c: float = 70) -> Construction:
    """The lengths of the frame for which the crank turns: the four-bars that are just possible, joints on one line."""
    if not a < min(b, c):
        raise LinkageError(
            "the crank a must be shorter than b and c, not a = {a:g}, b = {b:g}, c = {c:g}", a=a, b=b, c=c
        )
    board = Board(message("Permissible lengths of the frame of a crank-rocker"))
    low_line, high_line = 0j, complex(0, -1.2 * a)
    board.step(
        "Given: crank a = {a:g}, coupler b = {b:g}, rocker c = {c:g}. The crank turns fully if the triangle of "
        "coupler, rocker and the distance AB₀ exists in every position; AB₀ runs from d - a to d + a.",
        Segment(low_line, complex(a), "given", "a"),
        Segment(complex(1.3 * a), complex(1.3 * a + b), "given", "b"),
        Segment(complex(1.6 * a + b), complex(1.6 * a + b + c), "given", "c"),
        a=a,
        b=b,
        c=c,
    )
    a0 = high_line
    pin = a0 - a
    joint = pin + b
    pivot = joint + c
    longest = abs(pivot - a0)
    board.step(
        "The longest frame: the crank points away from B₀, coupler and rocker are stretched. From A₀ to the left "
        "a, from there to the right b and c: d_max = b + c - a = {d:.4g}.",
        Dot(a0, "A₀"),
        Dot(pin, "A"),
        Dot(joint, "B"),
        Dot(pivot, "B₀"),
        Segment(a0, pin, "edge", "a"),
        Segment(pin, joint, "edge", "b"),
        Segment(joint, pivot, "edge", "c"),
        d=longest,
    )
    start = a0 - 1.4j * a
    near = start + a
    turn_back = near + b if b >= c else near - b
    end = turn_back - c if b >= c else turn_back + c
    shortest = abs(end - start)
    lift = -0.18j * a
    board.step(
        "The shortest frame: the crank points to B₀, coupler and rocker overlap. From A₀ to the right a, then the "
        "longer of b and c less the other: d_min = a + |b - c| = {d:.4g}.",
        Dot(start, "A₀"),
        Dot(near, "A"),
        Dot(turn_back + lift, "B"),
        Dot(end + 2 * lift, "B₀"),
        Segment(start, near, "edge", "a"),
        Segment(near, turn_back + lift, "edge", "b"),
        Segment(turn_back + lift, end + 2 * lift, "edge", "c"),
        d=shortest,
    )
    board.step(
        "The crank-rocker is possible for {low:.4g} < d < {high:.4g}; at the ends it is at a change point.",
        Segment(start - 0.8j * a, start - 0.8j * a + longest, "dimension", quantity("d_max", longest)),
        Segment(start - 1.3j * a, start - 1.3j * a + shortest, "dimension", quantity("d_min", shortest)),
        low=shortest,
        high=longest,
    )
    return board.done(d_min=shortest, d_max=longest)
