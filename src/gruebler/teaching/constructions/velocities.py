"""Polygons of velocities, drawn from a pole beside the linkage.

The arrows of a polygon are to scale: its first step says what length stands for how much. There is one linkage for each
kind of dyad that a crank or lever drives: RRR the four-bar, RRP the slider-crank, RPR the inverted slider-crank, RPP
the Scotch yoke, PRP the tangent mechanism.
"""

from __future__ import annotations

import cmath
from dataclasses import dataclass
from math import radians

from gruebler.base.text import Message, message
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
    """A polygon beside the linkage: its pole, its scale and what its arrows are; vectors count from the pole."""

    def __init__(
        self, board: Board, pins: tuple[complex, ...], longest: float, down: float = 0.0, style: str = "velocity"
    ) -> None:
        self.board, self.pins, self.style = board, pins, style
        low, high = min(z.real for z in pins), max(z.real for z in pins)
        size = max(high - low, max(z.imag for z in pins) - min(z.imag for z in pins))
        self.scale = _LONG * size / longest
        self.pole = complex(high + 1.6 * size, max(z.imag for z in pins) / 2 - down * size)

    def at(self, vector: complex) -> complex:
        """The tip of a vector from the pole."""
        return self.pole + self.scale * vector

    def draw(
        self,
        text: str | Message,
        *arrows: tuple[str, complex, complex],
        pole: str = "",
        tip: str = "",
        **values: object,
    ) -> None:
        """A step: arrows by name, from vector to vector; the pole and the tip of the first arrow may get names."""
        self.board.step(
            text,
            *([Dot(self.pole, pole)] if pole else []),
            *(Arrow(self.at(begin), self.at(end), name, self.style) for name, begin, end in arrows),
            *([Dot(self.at(arrows[0][2]), tip)] if tip else []),
            **values,
        )

    def meet(self, text: Message, first: complex, along: complex, second: complex, other: complex) -> complex:
        """A step: two lines through the tips of two vectors, each in a direction; the vector to where they meet."""
        self.board.step(text, DrawnLine(self.at(first), along), DrawnLine(self.at(second), other))
        return (lines_meet(self.at(first), along, self.at(second), other) - self.pole) / self.scale


@dataclass(frozen=True)
class VelocityPolygon:
    """A construction whose polygon of velocities is drawn, with two of the velocities and the names of all three."""

    plan: VectorPlan
    known: complex
    """That of the crank's pin A, or of the lever's point C."""
    sought: complex
    """That of B, or of the point C under A."""
    names: tuple[str, str, str]
    """Of the known, the sought and the relative one."""

    def done(self, **values: float) -> Construction:
        """The construction, if nothing is drawn any more, with the velocities by their names."""
        speeds = map(abs, (self.known, self.sought, self.sought - self.known))
        return self.plan.board.done(**dict(zip(self.names, speeds, strict=True)), **values)


def velocities_of_four_bar(
    a: float = 25, b: float = 70, c: float = 40, d: float = 70, phi: float = 55, omega: float = 10
) -> Construction:
    """The triangle v_B = v_A + v_BA: v_B across the rocker, v_BA across the coupler."""
    return four_bar_velocities(message("Velocities of a four-bar"), a, b, c, d, phi, omega).done()


def four_bar_velocities(
    title: Message, a: float, b: float, c: float, d: float, phi: float, omega: float, down: float = 0.0
) -> VelocityPolygon:
    """The four-bar and its polygon of velocities."""
    board = Board(title)
    pins = four_bar_given(board, a, b, c, d, phi)
    _, pin, joint, b0 = pins
    plan, v_a = _crank(board, pins, a, omega, down)
    text = message(
        "v_BA is perpendicular to AB: its line goes through the tip a. v_B is perpendicular to B₀B: its line goes "
        "through the pole p_v."
    )
    v_b = plan.meet(text, v_a, 1j * (joint - pin), 0, 1j * (joint - b0))
    return _coupler_triangle(plan, v_a, v_b)


def _crank(board: Board, pins: tuple[complex, ...], a: float, omega: float, down: float) -> tuple[VectorPlan, complex]:
    """The polygon of a linkage with a crank, begun with the velocity of its pin."""
    plan = VectorPlan(board, pins, abs(a * omega), down)
    v_a = 1j * omega * (pins[1] - pins[0])
    plan.draw(
        "The crank turns with ω = {omega:g} 1/s: v_A = a ω = {speed:.4g}, perpendicular to A₀A. It is drawn from "
        "the pole p_v; 1 mm of the linkage's scale stands for {scale:.4g} mm/s.",
        ("v_A", 0, v_a),
        pole="p_v",
        tip="a",
        omega=omega,
        speed=abs(v_a),
        scale=1 / plan.scale,
    )
    return plan, v_a


def _coupler_triangle(plan: VectorPlan, v_a: complex, v_b: complex) -> VelocityPolygon:
    """The polygon with the velocity of a coupler's pin B, which its lines gave."""
    plan.draw(
        "The lines meet in b: v_B = {v_b:.4g} from p_v to b, v_BA = {v_ba:.4g} from a to b.",
        ("v_B", 0, v_b),
        ("v_BA", v_a, v_b),
        tip="b",
        v_b=abs(v_b),
        v_ba=abs(v_b - v_a),
    )
    return VelocityPolygon(plan, v_a, v_b, ("v_A", "v_B", "v_BA"))


def _sliding_triangle(plan: VectorPlan, text: Message, v_a: complex, v_c: complex) -> VelocityPolygon:
    """The polygon with the velocity of the point C under the block A, which its lines gave."""
    plan.draw(text, ("v_C", 0, v_c), ("v_rel", v_c, v_a), tip="c")
    return VelocityPolygon(plan, v_a, v_c, ("v_A", "v_C", "v_rel"))


def velocities_of_slider_crank(
    a: float = 20, b: float = 50, e: float = 0, phi: float = 60, omega: float = 10
) -> Construction:
    """The triangle v_B = v_A + v_BA: v_B along the line of the slider, v_BA across the coupler."""
    return slider_crank_velocities(message("Velocities of a slider-crank"), a, b, e, phi, omega).done()


def slider_crank_velocities(
    title: Message, a: float, b: float, e: float, phi: float, omega: float, down: float = 0.0
) -> VelocityPolygon:
    """The slider-crank and its polygon of velocities."""
    board = Board(title)
    pins = slider_crank_given(board, a, b, e, phi)
    _, pin, joint = pins
    plan, v_a = _crank(board, pins, a, omega, down)
    text = message(
        "v_BA is perpendicular to AB: its line goes through the tip a. v_B lies along the line of the slider, "
        "through the pole p_v."
    )
    v_b = plan.meet(text, v_a, 1j * (joint - pin), 0, 1 + 0j)
    return _coupler_triangle(plan, v_a, v_b)


def velocities_of_inverted_slider_crank(
    a: float = 30, d: float = 50, phi: float = 70, omega: float = 10
) -> Construction:
    """The triangle v_A = v_C + v_rel: the point C of the lever under A goes across the lever, the block along it."""
    polygon = lever_velocities(message("Velocities of an inverted slider-crank"), a, d, phi, omega)
    _, pin, b0 = polygon.plan.pins
    return polygon.done(omega_lever=abs(polygon.sought) / abs(pin - b0))


def lever_velocities(
    title: Message, a: float, d: float, phi: float, omega: float, down: float = 0.0
) -> VelocityPolygon:
    """The inverted slider-crank and its polygon of velocities."""
    board = Board(title)
    pins = lever_given(board, a, d, phi)
    plan, v_a = _crank(board, pins, a, omega, down)
    lever = pins[1] - pins[2]
    text = message(
        "C is the point of the lever under A. v_C is perpendicular to B₀A: its line goes through the pole p_v; the "
        "block slides along the lever: the line of v_rel goes through a."
    )
    v_c = plan.meet(text, 0, 1j * lever, v_a, lever)
    text = message(
        "The lines meet in c: v_C = {v_c:.4g} from p_v to c, v_rel = {v_rel:.4g} from c to a. The lever turns with "
        "ω₄ = v_C / B₀A = {omega:.4g} 1/s.",
        v_c=abs(v_c),
        v_rel=abs(v_a - v_c),
        omega=abs(v_c) / abs(lever),
    )
    return _sliding_triangle(plan, text, v_a, v_c)


def velocities_of_scotch_yoke(a: float = 25, slot: float = 70, phi: float = 55, omega: float = 10) -> Construction:
    """The triangle v_A = v_C + v_rel: the yoke moves along its guide, the block along the slot."""
    return yoke_velocities(message("Velocities of a Scotch yoke"), a, slot, phi, omega).done()


def yoke_velocities(
    title: Message, a: float, slot: float, phi: float, omega: float, down: float = 0.0
) -> VelocityPolygon:
    """The Scotch yoke and its polygon of velocities."""
    board = Board(title)
    pins = scotch_yoke_given(board, a, slot, phi)
    plan, v_a = _crank(board, pins, a, omega, down)
    text = message(
        "C is the point of the yoke under A. The yoke does not turn: v_C lies along its guide, through the pole "
        "p_v; the block slides along the slot: the line of v_rel goes through a."
    )
    v_c = plan.meet(text, 0, 1 + 0j, v_a, cmath.rect(1.0, radians(slot)))
    text = message(
        "The lines meet in c: v_C = {v_c:.4g} from p_v to c, v_rel = {v_rel:.4g} from c to a. The whole yoke has "
        "the velocity v_C.",
        v_c=abs(v_c),
        v_rel=abs(v_a - v_c),
    )
    return _sliding_triangle(plan, text, v_a, v_c)


def velocities_of_tangent_mechanism(d: float = 40, phi: float = 55, omega: float = 2) -> Construction:
    """The triangle v_B = v_C + v_rel: the lever's point C under B goes across the lever, the block along it."""
    return tangent_velocities(message("Velocities of a tangent mechanism"), d, phi, omega).done()


def tangent_velocities(title: Message, d: float, phi: float, omega: float, down: float = 0.0) -> VelocityPolygon:
    """The tangent mechanism and its polygon of velocities."""
    board = Board(title)
    pins = tangent_mechanism_given(board, d, phi)
    arm = pins[1] - pins[0]
    plan = VectorPlan(board, pins, abs(abs(arm) * omega), down)
    v_c = 1j * omega * arm
    plan.draw(
        "C is the point of the lever under B. The lever turns with ω = {omega:g} 1/s: v_C = A₀B ω = {speed:.4g}, "
        "perpendicular to the lever. It is drawn from the pole p_v; 1 mm of the linkage's scale stands for "
        "{scale:.4g} mm/s.",
        ("v_C", 0, v_c),
        pole="p_v",
        tip="c",
        omega=omega,
        speed=abs(v_c),
        scale=1 / plan.scale,
    )
    text = message(
        "The slider moves along its guide: the line of v_B goes through the pole p_v. The block slides along the "
        "lever: the line of v_rel goes through c."
    )
    v_b = plan.meet(text, 0, 1 + 0j, v_c, arm)
    plan.draw(
        "The lines meet in b: v_B = {v_b:.4g} from p_v to b, v_rel = {v_rel:.4g} from c to b.",
        ("v_B", 0, v_b),
        ("v_rel", v_c, v_b),
        tip="b",
        v_b=abs(v_b),
        v_rel=abs(v_b - v_c),
    )
    return VelocityPolygon(plan, v_c, v_b, ("v_C", "v_B", "v_rel"))
