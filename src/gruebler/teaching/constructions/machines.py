"""The Geneva drive; the profile of a cam from its lift diagram."""

from __future__ import annotations

import cmath
from math import pi, radians, tau

import numpy as np

from gruebler.base.text import message
from gruebler.machines.cams import CamError, read_lift
from gruebler.machines.geneva import Geneva, GenevaError
from gruebler.pictures.canvas.construction import (
    Angle,
    Construction,
    Dot,
    DrawnCircle,
    DrawnCurve,
    DrawnLine,
    Segment,
    quantity,
)
from gruebler.teaching.constructions.compass import Board, degrees_between, lines_meet


def geneva_drive(slots: float = 4, distance: float = 100) -> Construction:
    """An outer Geneva drive: the pin enters the slot at a right angle to the crank."""
    if slots != int(slots):
        raise GenevaError("expected a whole number of slots, not {slots:g}", slots=slots)
    count = int(slots)
    Geneva(count)
    board = Board(message("Geneva drive"))
    driver, wheel = 0j, complex(distance)
    board.step(
        "Given: the distance of the axes {distance:g}, {slots} slots. The wheel turns by 360°/{slots} in a step.",
        Dot(driver, "O₁"),
        Dot(wheel, "O₂"),
        Segment(driver, wheel, "dead"),
        distance=distance,
        slots=count,
    )
    direction = cmath.rect(1.0, pi - pi / count)
    board.step(
        "The slot that the pin enters makes half a step with the line of the axes, 180°/{slots} = {angle:g}°.",
        DrawnLine(wheel, direction),
        DrawnLine(wheel, direction.conjugate()),
        Angle(wheel, begin=pi, turn=-pi / count, text=quantity("ψ₀", 180 / count, "°"), radius=44),
        slots=count,
        angle=180 / count,
    )
    pin = lines_meet(driver, 1j * direction, wheel, direction)
    crank = abs(pin - driver)
    board.step(
        "To enter without impact, the pin moves along the slot: the crank is perpendicular to it. The foot of the "
        "perpendicular "
        "from O₁ is the pin; crank r₁ = {crank:.4g}, mouth of the slot r₂ = {wheel:.4g}.",
        Segment(driver, pin, "edge", quantity("r₁", crank)),
        Segment(pin, wheel, "help", quantity("r₂", abs(pin - wheel))),
        Dot(pin, "A"),
        DrawnCircle(driver, crank, "curve-rest"),
        DrawnCircle(wheel, abs(pin - wheel), "curve-rest"),
        crank=crank,
        wheel=abs(pin - wheel),
    )
    deepest = abs(wheel - crank)
    board.step(
        "On the line of the axes the pin is deepest, r₂ᵢ = {deep:.4g} from O₂. The slots go from there to the "
        "mouth, "
        "every {step:g}°.",
        DrawnCircle(wheel, deepest),
        *(
            Segment(
                wheel + cmath.rect(deepest, pi - pi / count + tau * k / count),
                wheel + cmath.rect(abs(pin - wheel), pi - pi / count + tau * k / count),
                "given",
            )
            for k in range(count)
        ),
        deep=deepest,
        step=360 / count,
    )
    engaged = 2 * degrees_between(pin - driver, wheel - driver)
    board.step(
        "Measured: while the driver turns by {engaged:.4g}° the wheel moves, for the other {rest:.4g}° the locking "
        "disc holds it.",
        Segment(driver, pin.conjugate(), "ghost"),
        Angle(
            driver,
            begin=cmath.phase(pin.conjugate()),
            turn=radians(engaged),
            text=quantity("φ", engaged, "°"),
            radius=40,
        ),
        engaged=engaged,
        rest=360 - engaged,
    )
    return board.done(crank=crank, wheel=abs(pin - wheel), slot_end=deepest, engaged=engaged)


def cam_profile(
    lift: str = "rise 20 120 3-4-5; dwell 60; fall 20 90 cycloidal; dwell",
    base: float = 30,
    roller: float = 8,
    step: float = 15,
) -> Construction:
    """The profile of a disc cam with a central roller follower from its lift diagram."""
    if not base > 0 or not roller > 0:
        raise CamError("base and roller are positive, not {base:g} and {roller:g}", base=base, roller=roller)
    if not 5 <= step <= 60 or abs(360 / step - round(360 / step)) > 1e-9:
        raise CamError("step must divide 360° and lie from 5 to 60, not {step!r}", step=step)
    law = read_lift(lift)
    board = Board(message("Cam profile from its lift diagram"))
    count = round(360 / step)
    fine = np.linspace(0, tau, 721)
    values = law.at(fine)
    least, height = float(values.min()), float(np.ptp(values))
    start = base + roller
    low = complex(1.6 * (start + height), -0.5 * height)
    wide = 3.2 * start / tau
    board.step(
        "Given: the lift s(φ), the base circle r_b = {base:g}, the roller r_r = {roller:g}.",
        DrawnCurve(tuple(low + complex(wide * x, s) for x, s in zip(fine.tolist(), values.tolist(), strict=True))),
        Segment(low, low + wide * tau, "axis"),
        Segment(low, low + 1j * (height + least), "axis", "s"),
        Dot(0j, "O"),
        DrawnCircle(0j, base, "curve-rest"),
        base=base,
        roller=roller,
    )
    angles = [tau * k / count for k in range(count)]
    lifts = [float(law.at(x)) for x in angles]
    board.step(
        "The diagram and the circle are divided into {count} parts of {step:g}°.",
        *(Segment(low + wide * x, low + complex(wide * x, s)) for x, s in zip(angles, lifts, strict=True)),
        *(Segment(0j, cmath.rect(start + height, pi / 2 - x)) for x in angles),
        count=count,
        step=step,
    )
    # The cam turns counter-clockwise: the follower goes round clockwise against it.
    centres = [cmath.rect(start + s, pi / 2 - x) for x, s in zip(angles, lifts, strict=True)]
    board.step(
        "The cam is held, the follower turns against it. On every ray r_b + r_r + s is laid off: the centres of "
        "the "
        "roller, on the pitch curve.",
        *(Dot(z) for z in centres),
        DrawnCurve(
            tuple(cmath.rect(start + s, pi / 2 - x) for x, s in zip(fine.tolist(), values.tolist(), strict=True)),
            "dead",
        ),
    )
    board.step("Circles of the roller about these centres.", *(DrawnCircle(z, roller, "ghost") for z in centres))
    slope = law.at(fine, 1)
    along = np.exp(1j * (pi / 2 - fine))
    pitch = (start + values) * along
    tangent = (slope - 1j * (start + values)) * along
    inward = -1j * tangent / np.abs(tangent)
    inward = np.where((inward / along).real < 0, inward, -inward)
    profile = pitch + roller * inward
    board.step(
        "The curve that touches all of them inside is the profile of the cam.",
        DrawnCurve(tuple(complex(z) for z in profile), "given"),
    )
    measured = {f"r{k}": abs(z) for k, z in enumerate(centres)}
    places = profile[:: 720 // count][:count]
    return board.done(
        **measured,
        **{f"x{k}": float(z.real) for k, z in enumerate(places)},
        **{f"y{k}": float(z.imag) for k, z in enumerate(places)},
    )
