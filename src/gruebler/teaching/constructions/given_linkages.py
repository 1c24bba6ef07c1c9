"""The linkages that constructions begin with, each in a pose: pins found with circles and lines, as the first step."""

from __future__ import annotations

import cmath
from math import radians

from gruebler.base.errors import LinkageError
from gruebler.mechanics.fourbar import FourBar
from gruebler.pictures.canvas.construction import Dot, Segment
from gruebler.teaching.constructions.compass import Board, line_meets_circle, lines_meet, meet_left, segments


def check_that_crank_turns(a: float, b: float, c: float, d: float) -> None:
    """Raise `LinkageError` for a four-bar whose crank does not turn."""
    if "a" not in FourBar(a, b, c, d).turning:
        raise LinkageError(
            "the crank of the four-bar a = {a:g}, b = {b:g}, c = {c:g}, d = {d:g} does not turn", a=a, b=b, c=c, d=d
        )


def four_bar_given(
    board: Board, a: float, b: float, c: float, d: float, phi: float
) -> tuple[complex, complex, complex, complex]:
    """The pins A0, A, B, B0 in a pose, found with circles."""
    a0, b0 = 0j, complex(d)
    pin = cmath.rect(a, radians(phi))
    joint = meet_left(pin, b, b0, c)
    board.step(
        "Given: the four-bar a = {a:g}, b = {b:g}, c = {c:g}, d = {d:g} in the pose φ = {phi:g}°. B is where the "
        "circles about A and B₀ with b and c meet.",
        *(Dot(z, name) for z, name in ((a0, "A₀"), (b0, "B₀"), (pin, "A"), (joint, "B"))),
        Segment(a0, b0, "dead"),
        *segments("edge", a0, pin, joint, b0),
        a=a,
        b=b,
        c=c,
        d=d,
        phi=phi,
    )
    return a0, pin, joint, b0


def slider_crank_given(board: Board, a: float, b: float, e: float, phi: float) -> tuple[complex, complex, complex]:
    """The pins A0, A, B in a pose."""
    pin = cmath.rect(a, radians(phi))
    _, joint = line_meets_circle(complex(0, e), 1 + 0j, pin, b)
    board.step(
        "Given: the slider-crank a = {a:g}, b = {b:g}, e = {e:g} in the pose φ = {phi:g}°. B is where the circle "
        "about A with b meets the line of the slider.",
        *(Dot(z, name) for z, name in ((0j, "A₀"), (pin, "A"), (joint, "B"))),
        *segments("edge", 0j, pin, joint),
        Segment(joint - 0.6 * a, joint + 0.6 * a, "given"),
        a=a,
        b=b,
        e=e,
        phi=phi,
    )
    return 0j, pin, joint


def lever_given(board: Board, a: float, d: float, phi: float) -> tuple[complex, complex, complex]:
    """A0, the block A on the lever, B0, in a pose."""
    pin, b0 = cmath.rect(a, radians(phi)), complex(d)
    end = b0 + 1.25 * (pin - b0)
    board.step(
        "Given: the crank a = {a:g} about A₀ drives the lever about B₀, A₀B₀ = d = {d:g}, by a block at its pin A, "
        "in the pose φ = {phi:g}°.",
        *(Dot(z, name) for z, name in ((0j, "A₀"), (b0, "B₀"), (pin, "A"))),
        Segment(0j, b0, "dead"),
        Segment(0j, pin, "edge"),
        Segment(b0, end, "given"),
        a=a,
        d=d,
        phi=phi,
    )
    return 0j, pin, b0


def scotch_yoke_given(board: Board, a: float, slot: float, phi: float) -> tuple[complex, complex, complex]:
    """A0, the block A in the slot of the yoke, and the yoke's end, in a pose."""
    pin, direction = cmath.rect(a, radians(phi)), cmath.rect(1.0, radians(slot))
    foot = lines_meet(pin, direction, 0j, 1 + 0j)
    board.step(
        "Given: the crank a = {a:g} about A₀ drives a yoke by a block at its pin A, in the pose φ = {phi:g}°. The "
        "slot of the yoke stands at {slot:g}° to its guide.",
        Dot(0j, "A₀"),
        Dot(pin, "A"),
        Segment(0j, pin, "edge"),
        Segment(foot - 1.3 * a * direction, foot + 1.3 * a * direction, "given"),
        Segment(foot, foot + a, "given"),
        Segment(foot + (0.4 + 0.08j) * a, foot + (1 + 0.08j) * a, "dead"),
        Segment(foot + (0.4 - 0.08j) * a, foot + (1 - 0.08j) * a, "dead"),
        a=a,
        phi=phi,
        slot=slot,
    )
    return 0j, pin, foot + a


def tangent_mechanism_given(board: Board, d: float, phi: float) -> tuple[complex, complex]:
    """A0 of the lever and the slider's pin B, in a pose."""
    direction = cmath.rect(1.0, radians(phi))
    pin = lines_meet(0j, direction, complex(0, d), 1 + 0j)
    if (pin / direction).real <= 0:
        raise LinkageError("the lever does not reach the guide of the slider: phi must lie between 0° and 180°")
    board.step(
        "Given: a lever about A₀ drives a slider by a block that slides along it and turns about the slider's pin "
        "B, in the pose φ = {phi:g}°. The guide of B has the distance d = {d:g} from A₀.",
        Dot(0j, "A₀"),
        Dot(pin, "B"),
        Segment(0j, 1.25 * pin, "given"),
        Segment(pin - 0.5 * d, pin + 0.5 * d, "edge"),
        Segment(pin - 0.5 * d - 0.06j * d, pin + 0.5 * d - 0.06j * d, "dead"),
        phi=phi,
        d=d,
    )
    return 0j, pin
