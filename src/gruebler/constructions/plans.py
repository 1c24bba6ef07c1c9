"""Instant centres; polygons of velocities and accelerations, drawn from a pole beside the linkage.

The arrows of a polygon are to scale: its title says what length stands for how much. The polygon of accelerations
begins with the parts that are known, a = v²/r towards the centre and, on a lever, 2 ω v_rel across it (Coriolis).
There is one linkage for each kind of dyad that a crank or lever drives: RRR the four-bar, RRP the slider-crank, RPR the
inverted slider-crank, RPP the Scotch yoke, PRP the tangent mechanism.
"""

from __future__ import annotations

import cmath
from math import radians

from gruebler.constructions.compass import Board, line_meets_circle, lines_meet, meet_left
from gruebler.drawing.canvas.construction import Arrow, Construction, Dot, DrawnLine, Segment
from gruebler.errors import LinkageError
from gruebler.text import message

__all__ = [
    "accelerations_of_four_bar",
    "accelerations_of_inverted_slider_crank",
    "accelerations_of_scotch_yoke",
    "accelerations_of_slider_crank",
    "accelerations_of_tangent_mechanism",
    "four_bar_given",
    "instant_centres_of_four_bar",
    "instant_centres_of_slider_crank",
    "velocities_of_four_bar",
    "velocities_of_inverted_slider_crank",
    "velocities_of_scotch_yoke",
    "velocities_of_slider_crank",
    "velocities_of_tangent_mechanism",
]

_LONG = 1.1  # of the linkage: the longest known arrow of a polygon


def four_bar_given(
    board: Board, a: float, b: float, c: float, d: float, phi: float
) -> tuple[complex, complex, complex, complex]:
    """The pins A0, A, B, B0 in a pose, found with circles."""
    a0, b0 = 0j, complex(d)
    pin = cmath.rect(a, radians(phi))
    joint = meet_left(pin, b, b0, c)
    board.step(
        message(
            "Given: the four-bar a = {a:g}, b = {b:g}, c = {c:g}, d = {d:g} in the pose φ = {phi:g}°. B is where the "
            "circles about A and B₀ with b and c meet.",
            a=a,
            b=b,
            c=c,
            d=d,
            phi=phi,
        ),
        *(Dot(z, name) for z, name in ((a0, "A₀"), (b0, "B₀"), (pin, "A"), (joint, "B"))),
        Segment(a0, b0, "dead"),
        Segment(a0, pin, "edge"),
        Segment(pin, joint, "edge"),
        Segment(joint, b0, "edge"),
    )
    return a0, pin, joint, b0


def _slider_crank(board: Board, a: float, b: float, e: float, phi: float) -> tuple[complex, complex, complex]:
    """The pins A0, A, B in a pose."""
    pin = cmath.rect(a, radians(phi))
    _, joint = line_meets_circle(complex(0, e), 1 + 0j, pin, b)
    board.step(
        message(
            "Given: the slider-crank a = {a:g}, b = {b:g}, e = {e:g} in the pose φ = {phi:g}°. B is where the circle "
            "about A with b meets the line of the slider.",
            a=a,
            b=b,
            e=e,
            phi=phi,
        ),
        *(Dot(z, name) for z, name in ((0j, "A₀"), (pin, "A"), (joint, "B"))),
        Segment(0j, pin, "edge"),
        Segment(pin, joint, "edge"),
        Segment(joint - 0.6 * a, joint + 0.6 * a, "given"),
    )
    return 0j, pin, joint


def _lever(board: Board, a: float, d: float, phi: float) -> tuple[complex, complex, complex]:
    """A0, the block A on the lever, B0, in a pose."""
    pin, b0 = cmath.rect(a, radians(phi)), complex(d)
    end = b0 + 1.25 * (pin - b0)
    board.step(
        message(
            "Given: the crank a = {a:g} about A₀ drives the lever about B₀, A₀B₀ = d = {d:g}, by a block at its pin A, "
            "in the pose φ = {phi:g}°.",
            a=a,
            d=d,
            phi=phi,
        ),
        *(Dot(z, name) for z, name in ((0j, "A₀"), (b0, "B₀"), (pin, "A"))),
        Segment(0j, b0, "dead"),
        Segment(0j, pin, "edge"),
        Segment(b0, end, "given"),
    )
    return 0j, pin, b0


class _Plan:
    """A polygon beside the linkage: its pole and its scale."""

    def __init__(self, pins: tuple[complex, ...], longest: float, down: float = 0.0) -> None:
        low, high = min(z.real for z in pins), max(z.real for z in pins)
        size = max(high - low, max(z.imag for z in pins) - min(z.imag for z in pins))
        self.scale = _LONG * size / longest
        self.pole = complex(high + 1.6 * size, max(z.imag for z in pins) / 2 - down * size)

    def at(self, vector: complex) -> complex:
        """The tip of a vector from the pole."""
        return self.pole + self.scale * vector


# --- instant centres ---------------------------------------------------------------------------------


def instant_centres_of_four_bar(
    a: float = 25, b: float = 70, c: float = 40, d: float = 70, phi: float = 150
) -> Construction:
    """All six instant centres: four joints, and two by the theorem of three centres."""
    board = Board(message("Instant centres of a four-bar"))
    a0, pin, joint, b0 = four_bar_given(board, a, b, c, d, phi)
    board.step(
        message(
            "The joints are instant centres: P₁₂ = A₀, P₂₃ = A, P₃₄ = B, P₁₄ = B₀ (1 frame, 2 crank, 3 coupler, 4 "
            "rocker)."
        ),
        Dot(a0, "P₁₂"),
        Dot(pin, "P₂₃"),
        Dot(joint, "P₃₄"),
        Dot(b0, "P₁₄"),
    )
    board.step(
        message("P₁₃ lies on one line with P₁₂ and P₂₃, the polar ray of A, and on one with P₁₄ and P₃₄, that of B."),
        DrawnLine(a0, pin - a0),
        DrawnLine(b0, joint - b0),
    )
    pole = lines_meet(a0, pin - a0, b0, joint - b0)
    board.step(
        message(
            "The polar rays meet in P₁₃ = ({x:.4g}, {y:.4g}), the velocity pole of the coupler.",
            x=pole.real,
            y=pole.imag,
        ),
        Segment(a0, pole),
        Segment(b0, pole),
        Dot(pole, "P₁₃"),
    )
    relative = lines_meet(a0, b0 - a0, pin, joint - pin)
    ratio = abs(relative - b0) / abs(relative - a0)
    board.step(
        message(
            "P₂₄ lies on A₀B₀ and on AB, at x = {x:.4g}. It divides the frame in the transmission ratio: "
            "i = ω₂/ω₄ = P₂₄B₀ / P₂₄A₀ = {ratio:.4g}.",
            x=relative.real,
            ratio=ratio,
        ),
        DrawnLine(a0, b0 - a0),
        DrawnLine(pin, joint - pin),
        Dot(relative, "P₂₄"),
    )
    return board.done(x13=pole.real, y13=pole.imag, x24=relative.real, ratio=ratio)


def instant_centres_of_slider_crank(a: float = 20, b: float = 50, e: float = 0, phi: float = 60) -> Construction:
    """The instant centres of a slider-crank: that of slider and frame lies at infinity."""
    board = Board(message("Instant centres of a slider-crank"))
    a0, pin, joint = _slider_crank(board, a, b, e, phi)
    board.step(
        message(
            "P₁₂ = A₀, P₂₃ = A, P₃₄ = B; P₁₄ lies at infinity, across the line of the slider "
            "(1 frame, 2 crank, 3 coupler, 4 slider)."
        ),
        Dot(a0, "P₁₂"),
        Dot(pin, "P₂₃"),
        Dot(joint, "P₃₄"),
        DrawnLine(joint, 1j, "dead"),
    )
    pole = lines_meet(a0, pin - a0, joint, 1j)
    board.step(
        message(
            "The polar rays of A and of B meet in P₁₃ = ({x:.4g}, {y:.4g}), the velocity pole of the coupler.",
            x=pole.real,
            y=pole.imag,
        ),
        Segment(a0, pole),
        Segment(joint, pole),
        Dot(pole, "P₁₃"),
    )
    relative = lines_meet(a0, 1j, pin, joint - pin)
    board.step(
        message(
            "P₂₄ lies on AB and on the line through A₀ to the infinite P₁₄. The slider has the velocity of this point "
            "of "
            "the crank: v_B = ω · A₀P₂₄ = ω · {arm:.4g}.",
            arm=abs(relative),
        ),
        DrawnLine(a0, 1j),
        DrawnLine(pin, joint - pin),
        Dot(relative, "P₂₄"),
    )
    return board.done(x13=pole.real, y13=pole.imag, arm=abs(relative))


# --- velocities --------------------------------------------------------------------------------------


def velocities_of_four_bar(
    a: float = 25, b: float = 70, c: float = 40, d: float = 70, phi: float = 55, omega: float = 10
) -> Construction:
    """The triangle v_B = v_A + v_BA: v_B across the rocker, v_BA across the coupler."""
    board = Board(message("Velocities of a four-bar"))
    pins = four_bar_given(board, a, b, c, d, phi)
    plan = _Plan(pins, abs(a * omega))
    v_a, v_b, _ = _four_bar_velocities(board, plan, pins, omega)
    return board.done(v_A=abs(v_a), v_B=abs(v_b), v_BA=abs(v_b - v_a))


def _four_bar_velocities(
    board: Board, plan: _Plan, pins: tuple[complex, complex, complex, complex], omega: float
) -> tuple[complex, complex, complex]:
    a0, pin, joint, b0 = pins
    v_a = _crank(board, plan, pin - a0, omega)
    across_coupler, across_rocker = 1j * (joint - pin), 1j * (joint - b0)
    board.step(
        message(
            "v_BA is perpendicular to AB: its line goes through the tip a. v_B is perpendicular to B₀B: its line goes "
            "through the pole p_v."
        ),
        DrawnLine(plan.at(v_a), across_coupler),
        DrawnLine(plan.pole, across_rocker),
    )
    tip = lines_meet(plan.at(v_a), across_coupler, plan.pole, across_rocker)
    v_b = (tip - plan.pole) / plan.scale
    _velocity_triangle(board, plan, v_a, v_b)
    return v_a, v_b, tip


def _crank(board: Board, plan: _Plan, arm: complex, omega: float) -> complex:
    """The velocity of the crank's pin."""
    v_a = 1j * omega * arm
    board.step(
        message(
            "The crank turns with ω = {omega:g} 1/s: v_A = a ω = {speed:.4g}, perpendicular to A₀A. It is drawn from "
            "the pole p_v; 1 mm of the linkage's scale stands for {scale:.4g} mm/s.",
            omega=omega,
            speed=abs(v_a),
            scale=1 / plan.scale,
        ),
        Dot(plan.pole, "p_v"),
        Arrow(plan.pole, plan.at(v_a), "v_A"),
        Dot(plan.at(v_a), "a"),
    )
    return v_a


def _velocity_triangle(board: Board, plan: _Plan, v_a: complex, v_b: complex) -> None:
    board.step(
        message(
            "The lines meet in b: v_B = {v_b:.4g} from p_v to b, v_BA = {v_ba:.4g} from a to b.",
            v_b=abs(v_b),
            v_ba=abs(v_b - v_a),
        ),
        Arrow(plan.pole, plan.at(v_b), "v_B"),
        Arrow(plan.at(v_a), plan.at(v_b), "v_BA"),
        Dot(plan.at(v_b), "b"),
    )


def velocities_of_slider_crank(
    a: float = 20, b: float = 50, e: float = 0, phi: float = 60, omega: float = 10
) -> Construction:
    """The triangle v_B = v_A + v_BA: v_B along the line of the slider, v_BA across the coupler."""
    board = Board(message("Velocities of a slider-crank"))
    pins = _slider_crank(board, a, b, e, phi)
    plan = _Plan(pins, abs(a * omega))
    v_a, v_b = _slider_crank_velocities(board, plan, pins, omega)
    return board.done(v_A=abs(v_a), v_B=abs(v_b), v_BA=abs(v_b - v_a))


def _slider_crank_velocities(
    board: Board, plan: _Plan, pins: tuple[complex, complex, complex], omega: float
) -> tuple[complex, complex]:
    a0, pin, joint = pins
    v_a = _crank(board, plan, pin - a0, omega)
    across = 1j * (joint - pin)
    board.step(
        message(
            "v_BA is perpendicular to AB: its line goes through the tip a. v_B lies along the line of the slider, "
            "through the pole p_v."
        ),
        DrawnLine(plan.at(v_a), across),
        DrawnLine(plan.pole, 1 + 0j),
    )
    tip = lines_meet(plan.at(v_a), across, plan.pole, 1 + 0j)
    v_b = (tip - plan.pole) / plan.scale
    _velocity_triangle(board, plan, v_a, v_b)
    return v_a, v_b


def velocities_of_inverted_slider_crank(
    a: float = 30, d: float = 50, phi: float = 70, omega: float = 10
) -> Construction:
    """The triangle v_A = v_C + v_rel: the point C of the lever under A goes across the lever, the block along it."""
    board = Board(message("Velocities of an inverted slider-crank"))
    pins = _lever(board, a, d, phi)
    plan = _Plan(pins, abs(a * omega))
    v_a, v_c = _lever_velocities(board, plan, pins, omega)
    arm = abs(pins[1] - pins[2])
    return board.done(v_A=abs(v_a), v_C=abs(v_c), v_rel=abs(v_a - v_c), omega_lever=abs(v_c) / arm)


def _lever_velocities(
    board: Board, plan: _Plan, pins: tuple[complex, complex, complex], omega: float
) -> tuple[complex, complex]:
    a0, pin, b0 = pins
    v_a = _crank(board, plan, pin - a0, omega)
    lever = pin - b0
    board.step(
        message(
            "C is the point of the lever under A. v_C is perpendicular to B₀A: its line goes through the pole p_v; the "
            "block slides along the lever: the line of v_rel goes through a."
        ),
        DrawnLine(plan.pole, 1j * lever),
        DrawnLine(plan.at(v_a), lever),
    )
    tip = lines_meet(plan.pole, 1j * lever, plan.at(v_a), lever)
    v_c = (tip - plan.pole) / plan.scale
    board.step(
        message(
            "The lines meet in c: v_C = {v_c:.4g} from p_v to c, v_rel = {v_rel:.4g} from c to a. The lever turns with "
            "ω₄ = v_C / B₀A = {omega:.4g} 1/s.",
            v_c=abs(v_c),
            v_rel=abs(v_a - v_c),
            omega=abs(v_c) / abs(lever),
        ),
        Arrow(plan.pole, tip, "v_C"),
        Arrow(tip, plan.at(v_a), "v_rel"),
        Dot(tip, "c"),
    )
    return v_a, v_c


def velocities_of_scotch_yoke(a: float = 25, slot: float = 70, phi: float = 55, omega: float = 10) -> Construction:
    """The triangle v_A = v_C + v_rel: the yoke moves along its guide, the block along the slot."""
    board = Board(message("Velocities of a Scotch yoke"))
    pins = _scotch_yoke(board, a, slot, phi)
    plan = _Plan(pins, abs(a * omega))
    v_a, v_c = _yoke_velocities(board, plan, pins, slot, omega)
    return board.done(v_A=abs(v_a), v_C=abs(v_c), v_rel=abs(v_a - v_c))


def _scotch_yoke(board: Board, a: float, slot: float, phi: float) -> tuple[complex, complex, complex]:
    """A0, the block A in the slot of the yoke, and the yoke's end, in a pose."""
    pin, direction = cmath.rect(a, radians(phi)), cmath.rect(1.0, radians(slot))
    foot = lines_meet(pin, direction, 0j, 1 + 0j)
    board.step(
        message(
            "Given: the crank a = {a:g} about A₀ drives a yoke by a block at its pin A, in the pose φ = {phi:g}°. The "
            "slot of the yoke stands at {slot:g}° to its guide.",
            a=a,
            phi=phi,
            slot=slot,
        ),
        Dot(0j, "A₀"),
        Dot(pin, "A"),
        Segment(0j, pin, "edge"),
        Segment(foot - 1.3 * a * direction, foot + 1.3 * a * direction, "given"),
        Segment(foot, foot + a, "given"),
        Segment(foot + (0.4 + 0.08j) * a, foot + (1 + 0.08j) * a, "dead"),
        Segment(foot + (0.4 - 0.08j) * a, foot + (1 - 0.08j) * a, "dead"),
    )
    return 0j, pin, foot + a


def _yoke_velocities(
    board: Board, plan: _Plan, pins: tuple[complex, complex, complex], slot: float, omega: float
) -> tuple[complex, complex]:
    v_a, direction = _crank(board, plan, pins[1] - pins[0], omega), cmath.rect(1.0, radians(slot))
    board.step(
        message(
            "C is the point of the yoke under A. The yoke does not turn: v_C lies along its guide, through the pole "
            "p_v; the block slides along the slot: the line of v_rel goes through a."
        ),
        DrawnLine(plan.pole, 1 + 0j),
        DrawnLine(plan.at(v_a), direction),
    )
    tip = lines_meet(plan.pole, 1 + 0j, plan.at(v_a), direction)
    v_c = (tip - plan.pole) / plan.scale
    board.step(
        message(
            "The lines meet in c: v_C = {v_c:.4g} from p_v to c, v_rel = {v_rel:.4g} from c to a. The whole yoke has "
            "the velocity v_C.",
            v_c=abs(v_c),
            v_rel=abs(v_a - v_c),
        ),
        Arrow(plan.pole, tip, "v_C"),
        Arrow(tip, plan.at(v_a), "v_rel"),
        Dot(tip, "c"),
    )
    return v_a, v_c


def velocities_of_tangent_mechanism(d: float = 40, phi: float = 55, omega: float = 2) -> Construction:
    """The triangle v_B = v_C + v_rel: the lever's point C under B goes across the lever, the block along it."""
    board = Board(message("Velocities of a tangent mechanism"))
    pins = _tangent_mechanism(board, d, phi)
    plan = _Plan(pins, abs(abs(pins[1]) * omega))
    v_c, v_b = _tangent_velocities(board, plan, pins, omega)
    return board.done(v_C=abs(v_c), v_B=abs(v_b), v_rel=abs(v_b - v_c))


def _tangent_mechanism(board: Board, d: float, phi: float) -> tuple[complex, complex]:
    """A0 of the lever and the slider's pin B, in a pose."""
    direction = cmath.rect(1.0, radians(phi))
    pin = lines_meet(0j, direction, complex(0, d), 1 + 0j)
    if (pin / direction).real <= 0:
        raise LinkageError("the lever does not reach the guide of the slider: phi must lie between 0° and 180°")
    board.step(
        message(
            "Given: a lever about A₀ drives a slider by a block that slides along it and turns about the slider's pin "
            "B, in the pose φ = {phi:g}°. The guide of B has the distance d = {d:g} from A₀.",
            phi=phi,
            d=d,
        ),
        Dot(0j, "A₀"),
        Dot(pin, "B"),
        Segment(0j, 1.25 * pin, "given"),
        Segment(pin - 0.5 * d, pin + 0.5 * d, "edge"),
        Segment(pin - 0.5 * d - 0.06j * d, pin + 0.5 * d - 0.06j * d, "dead"),
    )
    return 0j, pin


def _tangent_velocities(
    board: Board, plan: _Plan, pins: tuple[complex, complex], omega: float
) -> tuple[complex, complex]:
    arm = pins[1] - pins[0]
    v_c = 1j * omega * arm
    board.step(
        message(
            "C is the point of the lever under B. The lever turns with ω = {omega:g} 1/s: v_C = A₀B ω = {speed:.4g}, "
            "perpendicular to the lever. It is drawn from the pole p_v; 1 mm of the linkage's scale stands for "
            "{scale:.4g} mm/s.",
            omega=omega,
            speed=abs(v_c),
            scale=1 / plan.scale,
        ),
        Dot(plan.pole, "p_v"),
        Arrow(plan.pole, plan.at(v_c), "v_C"),
        Dot(plan.at(v_c), "c"),
    )
    board.step(
        message(
            "The slider moves along its guide: the line of v_B goes through the pole p_v. The block slides along the "
            "lever: the line of v_rel goes through c."
        ),
        DrawnLine(plan.pole, 1 + 0j),
        DrawnLine(plan.at(v_c), arm),
    )
    tip = lines_meet(plan.pole, 1 + 0j, plan.at(v_c), arm)
    v_b = (tip - plan.pole) / plan.scale
    board.step(
        message(
            "The lines meet in b: v_B = {v_b:.4g} from p_v to b, v_rel = {v_rel:.4g} from c to b.",
            v_b=abs(v_b),
            v_rel=abs(v_b - v_c),
        ),
        Arrow(plan.pole, tip, "v_B"),
        Arrow(plan.at(v_c), tip, "v_rel"),
        Dot(tip, "b"),
    )
    return v_c, v_b


# --- accelerations -----------------------------------------------------------------------------------


def _towards(arm: complex, v: complex) -> complex:
    """The normal acceleration v²/r, from the tip of the arm to its foot."""
    return -arm / abs(arm) * abs(v) ** 2 / abs(arm)


def accelerations_of_four_bar(
    a: float = 25, b: float = 70, c: float = 40, d: float = 70, phi: float = 55, omega: float = 10
) -> Construction:
    """The polygon a_B = a_A + a_BAn + a_BAt = a_Bn + a_Bt, the crank turning evenly."""
    board = Board(message("Accelerations of a four-bar"))
    pins = four_bar_given(board, a, b, c, d, phi)
    a0, pin, joint, b0 = pins
    v_a, v_b, _ = _four_bar_velocities(board, _Plan(pins, abs(a * omega), 0.2), pins, omega)
    a_a = _towards(pin - a0, v_a)
    n_ba, n_b = _towards(joint - pin, v_b - v_a), _towards(joint - b0, v_b)
    plan = _acceleration_start(board, pins, a_a, n_ba)
    foot, begin = plan.at(n_b), plan.at(a_a + n_ba)
    board.step(
        message("From the pole p_a: a_Bn = v_B²/c = {n:.5g} towards B₀.", n=abs(n_b)),
        Arrow(plan.pole, foot, "a_Bn", "acceleration"),
    )
    ways = 1j * (joint - pin), 1j * (joint - b0)
    board.step(
        message(
            "The tangential parts are perpendicular to AB, through the tip of a_BAn, and perpendicular to B₀B, "
            "through the tip of a_Bn."
        ),
        DrawnLine(begin, ways[0]),
        DrawnLine(foot, ways[1]),
    )
    a_b = (lines_meet(begin, ways[0], foot, ways[1]) - plan.pole) / plan.scale
    t_ba, t_b = a_b - a_a - n_ba, a_b - n_b
    board.step(
        message(
            "They meet in b: a_B = {a_b:.5g}, a_BAt = {t_ba:.5g}, a_Bt = {t_b:.5g}.",
            a_b=abs(a_b),
            t_ba=abs(t_ba),
            t_b=abs(t_b),
        ),
        Arrow(begin, plan.at(a_b), "a_BAt", "acceleration"),
        Arrow(foot, plan.at(a_b), "a_Bt", "acceleration"),
        Arrow(plan.pole, plan.at(a_b), "a_B", "acceleration"),
        Dot(plan.at(a_b), "b"),
    )
    return board.done(
        a_A=abs(a_a), a_B=abs(a_b), a_BAn=abs(n_ba), a_BAt=abs(t_ba), a_Bn=abs(n_b), a_Bt=abs(t_b), v_B=abs(v_b)
    )


def _acceleration_start(board: Board, pins: tuple[complex, ...], a_a: complex, n_ba: complex) -> _Plan:
    """The pole of the polygon below that of the velocities, with the known parts of the coupler."""
    plan = _Plan(pins, abs(a_a), 1.5)
    board.step(
        message(
            "Accelerations: a_A = a ω² = {a_a:.5g} towards A₀, from the pole p_a, 1 mm for {scale:.4g} mm/s²; from its "
            "tip a_BAn = v_BA²/b = {n:.5g}, from B towards A.",
            a_a=abs(a_a),
            scale=1 / plan.scale,
            n=abs(n_ba),
        ),
        Dot(plan.pole, "p_a"),
        Arrow(plan.pole, plan.at(a_a), "a_A", "acceleration"),
        Arrow(plan.at(a_a), plan.at(a_a + n_ba), "a_BAn", "acceleration"),
    )
    return plan


def _crank_acceleration(board: Board, plan: _Plan, a_a: complex) -> None:
    """The acceleration of the crank's pin, from the pole."""
    board.step(
        message(
            "Accelerations: a_A = a ω² = {a_a:.5g} towards A₀, from the pole p_a, 1 mm for {scale:.4g} mm/s².",
            a_a=abs(a_a),
            scale=1 / plan.scale,
        ),
        Dot(plan.pole, "p_a"),
        Arrow(plan.pole, plan.at(a_a), "a_A", "acceleration"),
        Dot(plan.at(a_a), "a"),
    )


def accelerations_of_slider_crank(
    a: float = 20, b: float = 50, e: float = 0, phi: float = 60, omega: float = 10
) -> Construction:
    """The polygon a_B = a_A + a_BAn + a_BAt, a_B along the line of the slider, the crank turning evenly."""
    board = Board(message("Accelerations of a slider-crank"))
    pins = _slider_crank(board, a, b, e, phi)
    a0, pin, joint = pins
    v_a, v_b = _slider_crank_velocities(board, _Plan(pins, abs(a * omega), 0.2), pins, omega)
    a_a, n_ba = _towards(pin - a0, v_a), _towards(joint - pin, v_b - v_a)
    plan = _acceleration_start(board, pins, a_a, n_ba)
    begin, direction = plan.at(a_a + n_ba), 1j * (joint - pin)
    board.step(
        message(
            "a_BAt is perpendicular to AB, through the tip of a_BAn; a_B lies along the line of the slider, through "
            "p_a."
        ),
        DrawnLine(begin, direction),
        DrawnLine(plan.pole, 1 + 0j),
    )
    a_b = (lines_meet(begin, direction, plan.pole, 1 + 0j) - plan.pole) / plan.scale
    t_ba = a_b - a_a - n_ba
    board.step(
        message("They meet in b: a_B = {a_b:.5g}, a_BAt = {t_ba:.5g}.", a_b=abs(a_b), t_ba=abs(t_ba)),
        Arrow(begin, plan.at(a_b), "a_BAt", "acceleration"),
        Arrow(plan.pole, plan.at(a_b), "a_B", "acceleration"),
        Dot(plan.at(a_b), "b"),
    )
    return board.done(a_A=abs(a_a), a_B=abs(a_b), a_BAn=abs(n_ba), a_BAt=abs(t_ba), v_B=abs(v_b))


def accelerations_of_inverted_slider_crank(
    a: float = 30, d: float = 50, phi: float = 70, omega: float = 10
) -> Construction:
    """The polygon a_A = a_Cn + a_Ct + a_Cor + a_rel with Coriolis' acceleration, the crank turning evenly."""
    board = Board(message("Accelerations of an inverted slider-crank, with Coriolis"))
    pins = _lever(board, a, d, phi)
    a0, pin, b0 = pins
    v_a, v_c = _lever_velocities(board, _Plan(pins, abs(a * omega), 0.2), pins, omega)
    lever = pin - b0
    a_a, n_c = _towards(pin - a0, v_a), _towards(lever, v_c)
    turn = (v_c / (1j * lever)).real
    coriolis = 2j * turn * (v_a - v_c)
    plan = _Plan(pins, abs(a_a), 1.5)
    _crank_acceleration(board, plan, a_a)
    board.step(
        message(
            "a_Cn = v_C²/B₀A = {n:.5g} towards B₀, from p_a; from its tip Coriolis' acceleration 2 ω₄ v_rel = "
            "{cor:.5g}: "
            "v_rel turned by 90° in the sense of ω₄.",
            n=abs(n_c),
            cor=abs(coriolis),
        ),
        Arrow(plan.pole, plan.at(n_c), "a_Cn", "acceleration"),
        Arrow(plan.at(n_c), plan.at(n_c + coriolis), "a_Cor", "acceleration"),
    )
    begin = plan.at(n_c + coriolis)
    board.step(
        message("a_Ct is perpendicular to the lever, through the tip of a_Cor; a_rel lies along the lever, through a."),
        DrawnLine(begin, 1j * lever),
        DrawnLine(plan.at(a_a), lever),
    )
    tip = lines_meet(begin, 1j * lever, plan.at(a_a), lever)
    t_c, rel = (tip - begin) / plan.scale, (plan.at(a_a) - tip) / plan.scale
    board.step(
        message(
            "They meet: a_Ct = {t:.5g}, a_rel = {rel:.5g}. The lever's angular acceleration is α₄ = a_Ct / B₀A = "
            "{alpha:.4g} 1/s².",
            t=abs(t_c),
            rel=abs(rel),
            alpha=abs(t_c) / abs(lever),
        ),
        Arrow(begin, tip, "a_Ct", "acceleration"),
        Arrow(tip, plan.at(a_a), "a_rel", "acceleration"),
    )
    return board.done(
        a_A=abs(a_a),
        a_Cor=abs(coriolis),
        a_Ct=abs(t_c),
        a_rel=abs(rel),
        alpha_lever=abs(t_c) / abs(lever),
        omega_lever=abs(turn),
    )


def accelerations_of_scotch_yoke(a: float = 25, slot: float = 70, phi: float = 55, omega: float = 10) -> Construction:
    """The polygon a_A = a_C + a_rel: the yoke does not turn, so there is no Coriolis' acceleration."""
    board = Board(message("Accelerations of a Scotch yoke"))
    pins = _scotch_yoke(board, a, slot, phi)
    direction = cmath.rect(1.0, radians(slot))
    v_a, v_c = _yoke_velocities(board, _Plan(pins, abs(a * omega), 0.2), pins, slot, omega)
    a_a = _towards(pins[1] - pins[0], v_a)
    plan = _Plan(pins, abs(a_a), 1.5)
    _crank_acceleration(board, plan, a_a)
    board.step(
        message(
            "a_C lies along the guide, through p_a; a_rel lies along the slot, through a. The yoke does not turn: "
            "there is no Coriolis' acceleration."
        ),
        DrawnLine(plan.pole, 1 + 0j),
        DrawnLine(plan.at(a_a), direction),
    )
    tip = lines_meet(plan.pole, 1 + 0j, plan.at(a_a), direction)
    a_c = (tip - plan.pole) / plan.scale
    board.step(
        message(
            "They meet in c: a_C = {a_c:.5g}, the acceleration of the whole yoke; a_rel = {rel:.5g}.",
            a_c=abs(a_c),
            rel=abs(a_a - a_c),
        ),
        Arrow(plan.pole, tip, "a_C", "acceleration"),
        Arrow(tip, plan.at(a_a), "a_rel", "acceleration"),
        Dot(tip, "c"),
    )
    return board.done(a_A=abs(a_a), a_C=abs(a_c), a_rel=abs(a_a - a_c), v_C=abs(v_c))


def accelerations_of_tangent_mechanism(d: float = 40, phi: float = 55, omega: float = 2) -> Construction:
    """The polygon a_B = a_Cn + a_Cor + a_rel with Coriolis' acceleration, the lever turning evenly."""
    board = Board(message("Accelerations of a tangent mechanism, with Coriolis"))
    pins = _tangent_mechanism(board, d, phi)
    arm = pins[1] - pins[0]
    v_c, v_b = _tangent_velocities(board, _Plan(pins, abs(abs(arm) * omega), 0.2), pins, omega)
    n_c, coriolis = _towards(arm, v_c), 2j * omega * (v_b - v_c)
    plan = _Plan(pins, max(abs(n_c), abs(coriolis)), 1.5)
    begin = plan.at(n_c + coriolis)
    board.step(
        message(
            "Accelerations: a_Cn = A₀B ω² = {n:.5g} towards A₀, from the pole p_a, 1 mm for {scale:.4g} mm/s²; from "
            "its tip Coriolis' acceleration 2 ω v_rel = {cor:.5g}: v_rel turned by 90° in the sense of ω.",
            n=abs(n_c),
            scale=1 / plan.scale,
            cor=abs(coriolis),
        ),
        Dot(plan.pole, "p_a"),
        Arrow(plan.pole, plan.at(n_c), "a_Cn", "acceleration"),
        Arrow(plan.at(n_c), begin, "a_Cor", "acceleration"),
    )
    board.step(
        message("a_rel lies along the lever, through the tip of a_Cor; a_B lies along the guide, through p_a."),
        DrawnLine(begin, arm),
        DrawnLine(plan.pole, 1 + 0j),
    )
    tip = lines_meet(begin, arm, plan.pole, 1 + 0j)
    a_b = (tip - plan.pole) / plan.scale
    board.step(
        message("They meet in b: a_B = {a_b:.5g}, a_rel = {rel:.5g}.", a_b=abs(a_b), rel=abs(tip - begin) / plan.scale),
        Arrow(begin, tip, "a_rel", "acceleration"),
        Arrow(plan.pole, tip, "a_B", "acceleration"),
        Dot(tip, "b"),
    )
    return board.done(
        a_Cn=abs(n_c), a_Cor=abs(coriolis), a_B=abs(a_b), a_rel=abs(tip - begin) / plan.scale, v_B=abs(v_b)
    )
