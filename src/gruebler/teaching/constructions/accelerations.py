"""Polygons of accelerations, drawn from a pole beside the linkage, behind those of velocities.

A polygon begins with the parts that are known, a = v²/r towards the centre and, on a lever, 2 ω v_rel across it
(Coriolis); the linkages are those of `velocities`.
"""

from __future__ import annotations

import cmath
from math import radians

from gruebler.base.text import message
from gruebler.pictures.canvas.construction import Construction
from gruebler.teaching.constructions.velocities import (
    VectorPlan,
    VelocityPolygon,
    four_bar_velocities,
    lever_velocities,
    slider_crank_velocities,
    tangent_velocities,
    yoke_velocities,
)


def _towards(arm: complex, v: complex) -> complex:
    """The normal acceleration v²/r, from the tip of the arm to its foot."""
    return -arm / abs(arm) * abs(v) ** 2 / abs(arm)


def accelerations_of_four_bar(
    a: float = 25, b: float = 70, c: float = 40, d: float = 70, phi: float = 55, omega: float = 10
) -> Construction:
    """The polygon a_B = a_A + a_BAn + a_BAt = a_Bn + a_Bt, the crank turning evenly."""
    polygon = four_bar_velocities(message("Accelerations of a four-bar"), a, b, c, d, phi, omega, 0.2)
    _, pin, joint, b0 = polygon.plan.pins
    plan, a_a, n_ba = _coupler_plan(polygon)
    n_b = _towards(joint - b0, polygon.sought)
    plan.draw("From the pole p_a: a_Bn = v_B²/c = {n:.5g} towards B₀.", ("a_Bn", 0, n_b), n=abs(n_b))
    text = message(
        "The tangential parts are perpendicular to AB, through the tip of a_BAn, and perpendicular to B₀B, "
        "through the tip of a_Bn."
    )
    a_b = plan.meet(text, a_a + n_ba, 1j * (joint - pin), n_b, 1j * (joint - b0))
    t_ba, t_b = a_b - a_a - n_ba, a_b - n_b
    plan.draw(
        "They meet in b: a_B = {a_b:.5g}, a_BAt = {t_ba:.5g}, a_Bt = {t_b:.5g}.",
        ("a_BAt", a_a + n_ba, a_b),
        ("a_Bt", n_b, a_b),
        ("a_B", 0, a_b),
        tip="b",
        a_b=abs(a_b),
        t_ba=abs(t_ba),
        t_b=abs(t_b),
    )
    return plan.board.done(
        a_A=abs(a_a),
        a_B=abs(a_b),
        a_BAn=abs(n_ba),
        a_BAt=abs(t_ba),
        a_Bn=abs(n_b),
        a_Bt=abs(t_b),
        v_B=abs(polygon.sought),
    )


def _plan(polygon: VelocityPolygon, longest: float) -> VectorPlan:
    """A polygon of accelerations below that of the velocities."""
    return VectorPlan(polygon.plan.board, polygon.plan.pins, longest, 1.5, "acceleration")


def _coupler_plan(polygon: VelocityPolygon) -> tuple[VectorPlan, complex, complex]:
    """The polygon with the parts that are known of a coupler: a_A and a_BAn."""
    a0, pin, joint, *_ = polygon.plan.pins
    a_a, n_ba = _towards(pin - a0, polygon.known), _towards(joint - pin, polygon.sought - polygon.known)
    plan = _plan(polygon, abs(a_a))
    plan.draw(
        "Accelerations: a_A = a ω² = {a_a:.5g} towards A₀, from the pole p_a, 1 mm for {scale:.4g} mm/s²; from its "
        "tip a_BAn = v_BA²/b = {n:.5g}, from B towards A.",
        ("a_A", 0, a_a),
        ("a_BAn", a_a, a_a + n_ba),
        pole="p_a",
        a_a=abs(a_a),
        scale=1 / plan.scale,
        n=abs(n_ba),
    )
    return plan, a_a, n_ba


def _crank_plan(polygon: VelocityPolygon) -> tuple[VectorPlan, complex]:
    """The polygon with the acceleration of the crank's pin."""
    a0, pin, *_ = polygon.plan.pins
    a_a = _towards(pin - a0, polygon.known)
    plan = _plan(polygon, abs(a_a))
    plan.draw(
        "Accelerations: a_A = a ω² = {a_a:.5g} towards A₀, from the pole p_a, 1 mm for {scale:.4g} mm/s².",
        ("a_A", 0, a_a),
        pole="p_a",
        tip="a",
        a_a=abs(a_a),
        scale=1 / plan.scale,
    )
    return plan, a_a


def accelerations_of_slider_crank(
    a: float = 20, b: float = 50, e: float = 0, phi: float = 60, omega: float = 10
) -> Construction:
    """The polygon a_B = a_A + a_BAn + a_BAt, a_B along the line of the slider, the crank turning evenly."""
    polygon = slider_crank_velocities(message("Accelerations of a slider-crank"), a, b, e, phi, omega, 0.2)
    _, pin, joint = polygon.plan.pins
    plan, a_a, n_ba = _coupler_plan(polygon)
    text = message(
        "a_BAt is perpendicular to AB, through the tip of a_BAn; a_B lies along the line of the slider, through p_a."
    )
    a_b = plan.meet(text, a_a + n_ba, 1j * (joint - pin), 0, 1 + 0j)
    t_ba = a_b - a_a - n_ba
    plan.draw(
        "They meet in b: a_B = {a_b:.5g}, a_BAt = {t_ba:.5g}.",
        ("a_BAt", a_a + n_ba, a_b),
        ("a_B", 0, a_b),
        tip="b",
        a_b=abs(a_b),
        t_ba=abs(t_ba),
    )
    return plan.board.done(a_A=abs(a_a), a_B=abs(a_b), a_BAn=abs(n_ba), a_BAt=abs(t_ba), v_B=abs(polygon.sought))


def accelerations_of_inverted_slider_crank(
    a: float = 30, d: float = 50, phi: float = 70, omega: float = 10
) -> Construction:
    """The polygon a_A = a_Cn + a_Ct + a_Cor + a_rel with Coriolis' acceleration, the crank turning evenly."""
    title = message("Accelerations of an inverted slider-crank, with Coriolis")
    polygon = lever_velocities(title, a, d, phi, omega, 0.2)
    _, pin, b0 = polygon.plan.pins
    v_a, v_c, lever = polygon.known, polygon.sought, pin - b0
    n_c = _towards(lever, v_c)
    turn = (v_c / (1j * lever)).real
    coriolis = 2j * turn * (v_a - v_c)
    known = n_c + coriolis
    plan, a_a = _crank_plan(polygon)
    plan.draw(
        "a_Cn = v_C²/B₀A = {n:.5g} towards B₀, from p_a; from its tip Coriolis' acceleration 2 ω₄ v_rel = "
        "{cor:.5g}: v_rel turned by 90° in the sense of ω₄.",
        ("a_Cn", 0, n_c),
        ("a_Cor", n_c, known),
        n=abs(n_c),
        cor=abs(coriolis),
    )
    text = message(
        "a_Ct is perpendicular to the lever, through the tip of a_Cor; a_rel lies along the lever, through a."
    )
    tip = plan.meet(text, known, 1j * lever, a_a, lever)
    t_c, rel = abs(tip - known), abs(a_a - tip)
    plan.draw(
        "They meet: a_Ct = {t:.5g}, a_rel = {rel:.5g}. The lever's angular acceleration is α₄ = a_Ct / B₀A = "
        "{alpha:.4g} 1/s².",
        ("a_Ct", known, tip),
        ("a_rel", tip, a_a),
        t=t_c,
        rel=rel,
        alpha=t_c / abs(lever),
    )
    return plan.board.done(
        a_A=abs(a_a), a_Cor=abs(coriolis), a_Ct=t_c, a_rel=rel, alpha_lever=t_c / abs(lever), omega_lever=abs(turn)
    )


def accelerations_of_scotch_yoke(a: float = 25, slot: float = 70, phi: float = 55, omega: float = 10) -> Construction:
    """The polygon a_A = a_C + a_rel: the yoke does not turn, so there is no Coriolis' acceleration."""
    polygon = yoke_velocities(message("Accelerations of a Scotch yoke"), a, slot, phi, omega, 0.2)
    plan, a_a = _crank_plan(polygon)
    text = message(
        "a_C lies along the guide, through p_a; a_rel lies along the slot, through a. The yoke does not turn: "
        "there is no Coriolis' acceleration."
    )
    a_c = plan.meet(text, 0, 1 + 0j, a_a, cmath.rect(1.0, radians(slot)))
    plan.draw(
        "They meet in c: a_C = {a_c:.5g}, the acceleration of the whole yoke; a_rel = {rel:.5g}.",
        ("a_C", 0, a_c),
        ("a_rel", a_c, a_a),
        tip="c",
        a_c=abs(a_c),
        rel=abs(a_a - a_c),
    )
    return plan.board.done(a_A=abs(a_a), a_C=abs(a_c), a_rel=abs(a_a - a_c), v_C=abs(polygon.sought))


def accelerations_of_tangent_mechanism(d: float = 40, phi: float = 55, omega: float = 2) -> Construction:
    """The polygon a_B = a_Cn + a_Cor + a_rel with Coriolis' acceleration, the lever turning evenly."""
    polygon = tangent_velocities(message("Accelerations of a tangent mechanism, with Coriolis"), d, phi, omega, 0.2)
    arm = polygon.plan.pins[1] - polygon.plan.pins[0]
    n_c, coriolis = _towards(arm, polygon.known), 2j * omega * (polygon.sought - polygon.known)
    plan, known = _plan(polygon, max(abs(n_c), abs(coriolis))), n_c + coriolis
    plan.draw(
        "Accelerations: a_Cn = A₀B ω² = {n:.5g} towards A₀, from the pole p_a, 1 mm for {scale:.4g} mm/s²; from "
        "its tip Coriolis' acceleration 2 ω v_rel = {cor:.5g}: v_rel turned by 90° in the sense of ω.",
        ("a_Cn", 0, n_c),
        ("a_Cor", n_c, known),
        pole="p_a",
        n=abs(n_c),
        scale=1 / plan.scale,
        cor=abs(coriolis),
    )
    text = message("a_rel lies along the lever, through the tip of a_Cor; a_B lies along the guide, through p_a.")
    a_b = plan.meet(text, known, arm, 0, 1 + 0j)
    rel = abs(a_b - known)
    plan.draw(
        "They meet in b: a_B = {a_b:.5g}, a_rel = {rel:.5g}.",
        ("a_rel", known, a_b),
        ("a_B", 0, a_b),
        tip="b",
        a_b=abs(a_b),
        rel=rel,
    )
    return plan.board.done(a_Cn=abs(n_c), a_Cor=abs(coriolis), a_B=abs(a_b), a_rel=rel, v_B=abs(polygon.sought))
