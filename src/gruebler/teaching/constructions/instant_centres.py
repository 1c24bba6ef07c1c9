"""Instant centres of the four-bar and the slider-crank, by the theorem of three centres."""

from __future__ import annotations

from gruebler.base.text import message
from gruebler.pictures.canvas.construction import Construction, Dot, DrawnLine, Segment
from gruebler.teaching.constructions.compass import Board, lines_meet
from gruebler.teaching.constructions.given_linkages import four_bar_given, slider_crank_given


def instant_centres_of_four_bar(
    a: float = 25, b: float = 70, c: float = 40, d: float = 70, phi: float = 150
) -> Construction:
    """All six instant centres: four joints, and two by the theorem of three centres."""
    board = Board(message("Instant centres of a four-bar"))
    a0, pin, joint, b0 = four_bar_given(board, a, b, c, d, phi)
    board.step(
        "The joints are instant centres: P₁₂ = A₀, P₂₃ = A, P₃₄ = B, P₁₄ = B₀ (1 frame, 2 crank, 3 coupler, 4 rocker).",
        Dot(a0, "P₁₂"),
        Dot(pin, "P₂₃"),
        Dot(joint, "P₃₄"),
        Dot(b0, "P₁₄"),
    )
    board.step(
        "P₁₃ lies on one line with P₁₂ and P₂₃, the polar ray of A, and on one with P₁₄ and P₃₄, that of B.",
        DrawnLine(a0, pin - a0),
        DrawnLine(b0, joint - b0),
    )
    pole = lines_meet(a0, pin - a0, b0, joint - b0)
    board.step(
        "The polar rays meet in P₁₃ = ({x:.4g}, {y:.4g}), the velocity pole of the coupler.",
        Segment(a0, pole),
        Segment(b0, pole),
        Dot(pole, "P₁₃"),
        x=pole.real,
        y=pole.imag,
    )
    relative = lines_meet(a0, b0 - a0, pin, joint - pin)
    ratio = abs(relative - b0) / abs(relative - a0)
    board.step(
        "P₂₄ lies on A₀B₀ and on AB, at x = {x:.4g}. It divides the frame in the transmission ratio: "
        "i = ω₂/ω₄ = P₂₄B₀ / P₂₄A₀ = {ratio:.4g}.",
        DrawnLine(a0, b0 - a0),
        DrawnLine(pin, joint - pin),
        Dot(relative, "P₂₄"),
        x=relative.real,
        ratio=ratio,
    )
    return board.done(x13=pole.real, y13=pole.imag, x24=relative.real, ratio=ratio)


def instant_centres_of_slider_crank(a: float = 20, b: float = 50, e: float = 0, phi: float = 60) -> Construction:
    """The instant centres of a slider-crank: that of slider and frame lies at infinity."""
    board = Board(message("Instant centres of a slider-crank"))
    a0, pin, joint = slider_crank_given(board, a, b, e, phi)
    board.step(
        "P₁₂ = A₀, P₂₃ = A, P₃₄ = B; P₁₄ lies at infinity, across the line of the slider "
        "(1 frame, 2 crank, 3 coupler, 4 slider).",
        Dot(a0, "P₁₂"),
        Dot(pin, "P₂₃"),
        Dot(joint, "P₃₄"),
        DrawnLine(joint, 1j, "dead"),
    )
    pole = lines_meet(a0, pin - a0, joint, 1j)
    board.step(
        "The polar rays of A and of B meet in P₁₃ = ({x:.4g}, {y:.4g}), the velocity pole of the coupler.",
        Segment(a0, pole),
        Segment(joint, pole),
        Dot(pole, "P₁₃"),
        x=pole.real,
        y=pole.imag,
    )
    relative = lines_meet(a0, 1j, pin, joint - pin)
    board.step(
        "P₂₄ lies on AB and on the line through A₀ to the infinite P₁₄. The slider has the velocity of this point "
        "of "
        "the crank: v_B = ω · A₀P₂₄ = ω · {arm:.4g}.",
        DrawnLine(a0, 1j),
        DrawnLine(pin, joint - pin),
        Dot(relative, "P₂₄"),
        arm=abs(relative),
    )
    return board.done(x13=pole.real, y13=pole.imag, arm=abs(relative))
