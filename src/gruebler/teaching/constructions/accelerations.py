"""Polygons of accelerations, drawn from a pole beside the linkage, behind those of velocities.

A polygon begins with the parts that are known, a = v²/r towards the centre and, on a lever, 2 ω v_rel across it
(Coriolis); the linkages are those of `velocities`.
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
from gruebler.teaching.constructions.velocities import (
    VectorPlan,
    add_four_bar_velocities,
    add_lever_velocities,
    add_slider_crank_velocities,
    add_tangent_velocities,
    add_yoke_velocities,
)


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
    v_a, v_b = add_four_bar_velocities(board, VectorPlan(pins, abs(a * omega), 0.2), pins, omega)
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


def _acceleration_start(board: Board, pins: tuple[complex, ...], a_a: complex, n_ba: complex) -> VectorPlan:
    """The pole of the polygon below that of the velocities, with the known parts of the coupler."""
    plan = VectorPlan(pins, abs(a_a), 1.5)
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


def _crank_acceleration(board: Board, plan: VectorPlan, a_a: complex) -> None:
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
    pins = slider_crank_given(board, a, b, e, phi)
    a0, pin, joint = pins
    v_a, v_b = add_slider_crank_velocities(board, VectorPlan(pins, abs(a * omega), 0.2), pins, omega)
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
    pins = lever_given(board, a, d, phi)
    a0, pin, b0 = pins
    v_a, v_c = add_lever_velocities(board, VectorPlan(pins, abs(a * omega), 0.2), pins, omega)
    lever = pin - b0
    a_a, n_c = _towards(pin - a0, v_a), _towards(lever, v_c)
    turn = (v_c / (1j * lever)).real
    coriolis = 2j * turn * (v_a - v_c)
    plan = VectorPlan(pins, abs(a_a), 1.5)
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
    pins = scotch_yoke_given(board, a, slot, phi)
    direction = cmath.rect(1.0, radians(slot))
    v_a, v_c = add_yoke_velocities(board, VectorPlan(pins, abs(a * omega), 0.2), pins, slot, omega)
    a_a = _towards(pins[1] - pins[0], v_a)
    plan = VectorPlan(pins, abs(a_a), 1.5)
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
    pins = tangent_mechanism_given(board, d, phi)
    arm = pins[1] - pins[0]
    v_c, v_b = add_tangent_velocities(board, VectorPlan(pins, abs(abs(arm) * omega), 0.2), pins, omega)
    n_c, coriolis = _towards(arm, v_c), 2j * omega * (v_b - v_c)
    plan = VectorPlan(pins, max(abs(n_c), abs(coriolis)), 1.5)
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
