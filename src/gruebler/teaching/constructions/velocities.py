"""Polygons of velocities, drawn from a pole beside the linkage.

The arrows of a polygon are to scale: its first step says what length stands for how much. There is one linkage for each
kind of dyad that a crank or lever drives: RRR the four-bar, RRP the slider-crank, RPR the inverted slider-crank, RPP
the Scotch yoke, PRP the tangent mechanism.
"""

from __future__ import annotations

import cmath
from math import radians

from gruebler.base.text import message
from gruebler.pictures.canvas.construction import Arrow, Construction, Dot, DrawnLine
from gruebler.teaching.constructions.compass import Board, lines_meet
from gruebler.teaching.constructions.given_linkages import (
    four_bar_given,
    lever_given,
    scotch_yoke_given,
    slider_crank_given,
    tangent_mechanism_given,
)

_LONG = 1.1  # of the linkage: the longest known arrow of a polygon


class VectorPlan:
    """A polygon beside the linkage: its pole and its scale."""

    def __init__(self, pins: tuple[complex, ...], longest: float, down: float = 0.0) -> None:
        low, high = min(z.real for z in pins), max(z.real for z in pins)
        size = max(high - low, max(z.imag for z in pins) - min(z.imag for z in pins))
        self.scale = _LONG * size / longest
        self.pole = complex(high + 1.6 * size, max(z.imag for z in pins) / 2 - down * size)

    def at(self, vector: complex) -> complex:
        """The tip of a vector from the pole."""
        return self.pole + self.scale * vector


def velocities_of_four_bar(
    a: float = 25, b: float = 70, c: float = 40, d: float = 70, phi: float = 55, omega: float = 10
) -> Construction:
    """The triangle v_B = v_A + v_BA: v_B across the rocker, v_BA across the coupler."""
    board = Board(message("Velocities of a four-bar"))
    pins = four_bar_given(board, a, b, c, d, phi)
    plan = VectorPlan(pins, abs(a * omega))
    v_a, v_b = add_four_bar_velocities(board, plan, pins, omega)
    return board.done(v_A=abs(v_a), v_B=abs(v_b), v_BA=abs(v_b - v_a))


def add_four_bar_velocities(
    board: Board, plan: VectorPlan, pins: tuple[complex, complex, complex, complex], omega: float
) -> tuple[complex, complex]:
    """Add the steps of the polygon; v_A and v_B."""
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
    return v_a, v_b


def _crank(board: Board, plan: VectorPlan, arm: complex, omega: float) -> complex:
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


def _velocity_triangle(board: Board, plan: VectorPlan, v_a: complex, v_b: complex) -> None:
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
    pins = slider_crank_given(board, a, b, e, phi)
    plan = VectorPlan(pins, abs(a * omega))
    v_a, v_b = add_slider_crank_velocities(board, plan, pins, omega)
    return board.done(v_A=abs(v_a), v_B=abs(v_b), v_BA=abs(v_b - v_a))


def add_slider_crank_velocities(
    board: Board, plan: VectorPlan, pins: tuple[complex, complex, complex], omega: float
) -> tuple[complex, complex]:
    """Add the steps of the polygon; v_A and v_B."""
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
    pins = lever_given(board, a, d, phi)
    plan = VectorPlan(pins, abs(a * omega))
    v_a, v_c = add_lever_velocities(board, plan, pins, omega)
    arm = abs(pins[1] - pins[2])
    return board.done(v_A=abs(v_a), v_C=abs(v_c), v_rel=abs(v_a - v_c), omega_lever=abs(v_c) / arm)


def add_lever_velocities(
    board: Board, plan: VectorPlan, pins: tuple[complex, complex, complex], omega: float
) -> tuple[complex, complex]:
    """Add the steps of the polygon; v_A and v_C."""
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
    pins = scotch_yoke_given(board, a, slot, phi)
    plan = VectorPlan(pins, abs(a * omega))
    v_a, v_c = add_yoke_velocities(board, plan, pins, slot, omega)
    return board.done(v_A=abs(v_a), v_C=abs(v_c), v_rel=abs(v_a - v_c))


def add_yoke_velocities(
    board: Board, plan: VectorPlan, pins: tuple[complex, complex, complex], slot: float, omega: float
) -> tuple[complex, complex]:
    """Add the steps of the polygon; v_A and v_C."""
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
    pins = tangent_mechanism_given(board, d, phi)
    plan = VectorPlan(pins, abs(abs(pins[1]) * omega))
    v_c, v_b = add_tangent_velocities(board, plan, pins, omega)
    return board.done(v_C=abs(v_c), v_B=abs(v_b), v_rel=abs(v_b - v_c))


def add_tangent_velocities(
    board: Board, plan: VectorPlan, pins: tuple[complex, complex], omega: float
) -> tuple[complex, complex]:
    """Add the steps of the polygon; v_C and v_B."""
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
