"""Measures, events and refusals do not depend on unit, place, orientation or reflection.

Linkages with several drives have no measures; their poses are compared.
`GRUEBLER_LINKAGES=10000 pytest -m slow tests/mechanics/kinematics/test_same_measures.py` tries so many random linkages.
"""

from __future__ import annotations

import math
import os
import re
from cmath import phase, rect
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.mechanics.analysis import measures
from gruebler.mechanics.analysis.measuring import Measures
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.kinematics.reference_pose import pose_at_reference
from gruebler.mechanics.kinematics.solve import cached_plan
from gruebler.mechanics.linkages import CamDisc, Circle, Linkage, Wheel
from gruebler.mechanics.linkages.elements import Element, Pin, Pose2D
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entries

TURN = 2 * math.pi
SCALES = [1e-6, 1e6, 3.7, 2.54]
CLOSE = 1e-6  # of the natural size: multiple zeros are known to some 1e-8
NEAR = 1e-5  # the same for drive values: poses next to a change point have half their digits
POSE = 1e-9  # of the size: poses away from change points


def in_other_coordinates(linkage: Linkage, angle: float, shift: complex) -> Linkage:
    """The same linkage in other coordinates: those of every link are turned by one angle, and shifted."""
    turn = rect(1, angle)

    def element(link: str, e: Element) -> Element:
        z = complex(e.x, e.y) * turn + shift_of(linkage, link, shift)
        if isinstance(e, Pin | Wheel | Circle):
            return replace(e, x=z.real, y=z.imag)
        return replace(e, x=z.real, y=z.imag, angle=e.angle + angle)

    def pose(link: str, p: Pose2D) -> tuple[float, float, float]:
        z = complex(p.x, p.y) * turn + shift_of(linkage, linkage.mechanism.frame, shift)
        z -= rect(1, p.angle) * shift_of(linkage, link, shift)
        return z.real, z.imag, p.angle

    return rebuilt(linkage, element, pose)


def shift_of(linkage: Linkage, link: str, shift: complex) -> complex:
    """By how much the coordinates of a link are shifted."""
    return shift * (1 + linkage.mechanism.chain.links.index(link))


def mirrored(linkage: Linkage) -> Linkage:
    """The mirror image in the x axis, with cams: their lifts are reversed, their followers change sides."""

    def element(_: str, e: Element) -> Element:
        if isinstance(e, Pin | Wheel | Circle):
            return replace(e, y=-e.y)
        if not isinstance(e, CamDisc):
            return replace(e, y=-e.y, angle=-e.angle)
        # Offset and pivot change sides by a reflection in the y axis: that in the x axis, turned by 180 degrees.
        lift = reversed_lift(e.lift)
        return replace(e, y=-e.y, angle=math.pi - e.angle, lift=lift, offset=-e.offset, distance=-e.distance)

    return rebuilt(linkage, element, lambda _, p: (p.x, -p.y, -p.angle))


def reversed_lift(text: str) -> str:
    """The lift L(-a) of parts whose laws are symmetrical."""
    other = {"rise": "fall", "fall": "rise", "dwell": "dwell"}
    parts = [part.split() for part in text.split(";")]
    return "; ".join(" ".join([other[word], *rest]) for word, *rest in reversed(parts))


def rebuilt(
    linkage: Linkage,
    element: Callable[[str, Element], Element],
    pose: Callable[[str, Pose2D], tuple[float, float, float]],
) -> Linkage:
    """A linkage with other elements and another reference pose, without named points."""
    elements: dict[str, dict[str | int, object]] = {link: {} for link in linkage.mechanism.chain.links}
    for (number, link), e in linkage.elements.items():
        elements[link][number] = element(link, e)
    poses = linkage.reference_pose
    return Linkage(
        linkage.mechanism,
        elements,
        unit=linkage.unit,
        reference_pose=None if poses is None else {link: pose(link, p) for link, p in poses.items()},
        outputs=linkage.outputs,
    )


def facts(result: Measures, *, mirrored: bool = False, with_sides: bool = True) -> dict[str, object]:
    """What must be the same: lengths in sizes, angles as they are, of a mirror image with the other sign."""
    size = result.linkage.size
    drive = (-1 if mirrored else 1) if result.turning_drive else 1 / size
    output = (-1 if mirrored else 1) if result.output.turning else 1 / size
    span = result.span

    def drive_value(value: float) -> float:
        return value * drive

    def rate(order: int) -> float:
        return output / drive**order

    def kind(word: str, order: int) -> str:
        """What is a maximum of a derivative, or rises, is a minimum where its sign is the other one."""
        opposite = {"maximum": "minimum", "minimum": "maximum", "rising": "falling", "falling": "rising"}
        return opposite.get(word, word) if rate(order) < 0 else word

    def rows(items: object, order: int) -> list[tuple[float, float, str]]:
        values = [getattr(i, "output", getattr(i, "value", 0.0)) * rate(order) for i in items]
        return [(drive_value(i.drive), value, kind(i.kind, order)) for i, value in zip(items, values, strict=True)]

    transfer, mu = result.transfer, result.transmission
    dwells = [(drive_value(d.drive), d.output * output, kind(d.kind, 0) + d.side) for d in result.dwells]
    phases = [result.phi_forward, result.phi_back]
    return {
        "full": (span.full, span.turns),
        "range": [] if span.full else sorted((drive_value(span.low), drive_value(span.high))),
        "dead centres": rows(result.dead_centres, 0),
        # where nothing else decides, the larger angle is the inner dead centre: of a mirror image the other one
        "sides": [(drive_value(c.drive), 0.0, c.side) for c in result.dead_centres] if with_sides else [],
        "dwells": dwells if with_sides else [(*row[:2], "") for row in dwells],
        "durations": [(drive_value(d.drive), d.duration * abs(drive), "") for d in result.dwells],
        "turns": abs(result.output_turns),
        "travel": None if result.travel is None else result.travel * abs(output),
        "phases": None if None in phases else sorted(phases),
        "ratio": result.time_ratio,
        "change points": [(drive_value(c.drive), 0.0, c.form + " ".join(c.links)) for c in result.change_points],
        "still": (transfer.still, transfer.uniform),
        "zeros": rows(transfer.zeros, 1),
        "velocity": rows(transfer.velocity, 1),
        "acceleration": rows(transfer.acceleration, 2),
        "transmission": [] if mu is None else [(drive_value(e.drive), e.mu, " ".join(e.links)) for e in mu.extremes],
    }


def assert_same(actual: dict[str, object], expected: dict[str, object], result: Measures) -> None:
    """All facts agree, those with a drive value in any order, by the nearest of the same kind."""
    period = result.span.period if result.span.full else None
    whole = TURN if result.output.turning and result.output_turns else None
    assert actual.keys() == expected.keys()
    for key, wanted in expected.items():
        value = actual[key]
        if not isinstance(value, list) or not value or not isinstance(value[0], tuple):
            assert value == (
                wanted if value is None or wanted is None else pytest.approx(wanted, rel=CLOSE, abs=CLOSE)
            ), key
            continue
        assert len(value) == len(wanted), (key, value, wanted)
        left = list(wanted)
        modulus = whole if key in ("dead centres", "dwells") else None
        for drive, level, word in value:
            near = [row for row in left if row[2] == word and gap(row[0] - drive, period) < NEAR]
            near.sort(key=lambda row, level=level, modulus=modulus: gap(row[1] - level, modulus))
            assert near, (key, (drive, level, word), left)
            assert gap(near[0][1] - level, modulus) <= CLOSE * max(1.0, abs(level)), (key, drive, level, near)
            left.remove(near[0])


def gap(x: float, period: float | None) -> float:
    return abs(x) if period is None else abs((x + period / 2) % period - period / 2)


def measured(linkage: Linkage) -> Measures | str:
    """The measures; or the refusal, without its numbers."""
    try:
        return measures(linkage)
    except LinkageError as error:
        return re.sub(r"-?[0-9][-+.0-9e]*", "#", str(error))


def check(linkage: Linkage, scale: float, angle: float, shift: complex) -> Measures | str:
    """Measures, or the refusal, are the same in another unit, in other coordinates, and mirrored."""
    result = measured(linkage)
    same = [linkage.scaled(scale), in_other_coordinates(linkage, angle, shift * linkage.size)]
    others = [measured(other) for other in same]
    image = measured(mirrored(linkage))
    if isinstance(result, str):
        assert [*others, image] == [result] * (len(others) + 1)
        return result
    for other in others:
        assert isinstance(other, Measures), other
        assert_same(facts(other), facts(result), result)
    assert isinstance(image, Measures), image
    assert_same(facts(image, mirrored=True, with_sides=False), facts(result, with_sides=False), result)
    return result


# --- random linkages ---------------------------------------------------------------------------------

CHAINS = (
    "R(0-1) R(1-2) R(2-3) R(3-0); frame=0; drive=R(0-1)",
    "R(0-1) R(1-2) R(2-3) P(3-0); frame=0; drive=R(0-1)",
    "R(0-1) R(1-2) P(2-3) R(3-0); frame=0; drive=R(0-1)",
    "R(0-1) R(0-3) R(1-2) P(2-3); frame=0; drive=P(2-3)",
    "R(0-1) R(1-2) R(2-3) R(3-0) R(3-4) R(4-5) R(5-0); frame=0; drive=R(0-1)",
    "R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) P(5-0); frame=0; drive=R(0-1)",
    "R(0-1) R(1-2) R(2-h) R(0-3) R(3-h) R(0-4) R(4-h); frame=0; drive=R(0-1)",
)


def random_linkage(seed: int) -> Linkage:
    """A linkage of one of the chains, drawn in a square of side 4."""
    rng = np.random.default_rng(seed)
    mechanism = Mechanism.parse(CHAINS[rng.integers(len(CHAINS))])
    places = {
        k: (*rng.uniform(0, 4, 2), rng.uniform(-3, 3))[: 2 if joint.pair.name == "revolute" else 3]
        for k, joint in enumerate(mechanism.chain.joints)
    }
    return Linkage.from_drawing(mechanism, places)


def well_placed(seed: int) -> Linkage | None:
    """None for a drawing that lies next to a limit or change point, where events are not decided by double numbers."""
    linkage = random_linkage(seed)
    result = measured(linkage)
    if isinstance(result, str):
        return linkage
    narrow = 1e-3 * (1 if result.turning_drive else linkage.size)
    return linkage if result.span.width > narrow else None


@settings(max_examples=12)
@given(
    st.integers(0, 2**32 - 1),
    st.floats(-6, 6).map(lambda x: 10**x),
    st.floats(-3, 3),
    st.complex_numbers(max_magnitude=2),
)
def test_random_linkages(seed: int, scale: float, angle: float, shift: complex) -> None:
    linkage = well_placed(seed)
    assume(linkage is not None)
    check(linkage, scale, angle, shift)


def test_offset_coordinates_do_not_move_the_ends_of_a_larger_group() -> None:
    """In them its limit is known to 2e-10; without a correction the output's angle there is 3e-6 off."""
    linkage = random_linkage(86)
    result, other = measures(linkage), measures(in_other_coordinates(linkage, 2.2, 1.4 * linkage.size))
    assert other.travel == pytest.approx(result.travel, rel=0, abs=1e-8)


@pytest.mark.parametrize("seed", [392, 1809, 3007])
def test_transmission_angle_at_sharp_limits_of_a_larger_group(seed: int) -> None:
    """At a limit the output can move while the drive stands, so that the leg pushes across its way: the angle is 0."""
    linkage = random_linkage(seed)
    for other in (linkage, in_other_coordinates(linkage, 2.2, 1.4 * linkage.size)):
        found = measures(other)
        ends = [e.mu for e in found.transmission.extremes if e.drive in (found.span.low, found.span.high)]
        assert ends == pytest.approx([0, 0], rel=0, abs=2e-7)


@pytest.mark.parametrize("gap", [1e-1, 1e-2, 1e-3, 1e-4, 1e-5])
def test_output_at_the_limits_of_a_crank_that_all_but_goes_round(gap: float) -> None:
    """At the limit coupler and rocker are in line, along the line from the crank pin to the rocker's pivot."""
    pin, pivot, coupler = rect(3, math.pi - gap), 4, 2.9
    found = measures(FourBar(a=3, b=coupler, c=abs(pin - pivot) - coupler, d=pivot).linkage())
    (lowest,) = found.dead_centres
    assert found.span.high == pytest.approx(math.pi - gap, rel=0, abs=1e-9)
    assert lowest.output + found.travel == pytest.approx(phase(pin - pivot), rel=0, abs=1e-8)


@pytest.mark.parametrize("seed", [1523, 1566])
def test_extremes_of_the_acceleration_between_limits(seed: int) -> None:
    """The output of a cylinder that passes its middle is even there: one extremum of psi'' there, and two about it.

    Towards both limits its derivative grows like the power -5/2 of the distance, and the samples become dense.
    """
    found = measures(random_linkage(seed)).transfer.acceleration
    assert len(found) == 3
    assert [c.drive for c in found] == pytest.approx([-found[2].drive, 0.0, found[2].drive], rel=1e-9, abs=1e-9)
    assert [c.value for c in found] == pytest.approx([c.value for c in reversed(found)])
    assert found[0].kind == found[2].kind != found[1].kind


def test_extremes_of_the_acceleration_beside_a_sharp_extreme_of_the_velocity() -> None:
    """The output's velocity has a peak of a width of 3e-4 radians, with an extreme of the acceleration on either side.

    The second derivative of the output is a derivative of the first: extremes of both kinds take turns.
    """
    linkage = random_linkage(4213)
    for other in (linkage, mirrored(linkage), in_other_coordinates(linkage, -2.6, 0.8 * linkage.size)):
        found = measures(other).transfer
        peak = max(found.velocity, key=lambda c: abs(c.value))
        near = [c for c in found.acceleration if abs(c.drive - peak.drive) < 1e-3]
        kinds = [c.kind for c in found.acceleration]
        assert [c.drive < peak.drive for c in near] == [True, False]
        assert near[0].value == pytest.approx(-near[1].value, rel=0.02)
        assert all(a != b for a, b in zip(kinds, [*kinds[1:], kinds[0]], strict=True))


@pytest.mark.slow
def test_many_random_linkages() -> None:
    wanted, first = int(os.environ.get("GRUEBLER_LINKAGES", "40")), int(os.environ.get("GRUEBLER_SEED", "0"))
    tried, refused, failed = 0, 0, []
    for seed in range(first, first + 100_000):
        linkage = well_placed(seed)
        if linkage is None:
            continue
        rng = np.random.default_rng(seed + 1)
        try:
            result = check(linkage, 10 ** rng.uniform(-6, 6), rng.uniform(-3, 3), complex(*rng.normal(size=2)))
            tried += isinstance(result, Measures)
            refused += isinstance(result, str)
        except (AssertionError, LinkageError) as error:
            tried += 1
            failed.append((seed, str(error)[:300]))
            print("seed", *failed[-1], flush=True)
        if tried % 100 == 0:
            print(f"{tried} linkages, {refused} refused, {len(failed)} failed; seed {seed}", flush=True)
        if tried == wanted:
            break
    assert tried == wanted
    assert not failed


# --- the machines of the catalog ---------------------------------------------------------------------

SIZED = [entry for entry in entries().values() if entry.dimensions is not None]
ONE_DRIVE = [entry.id for entry in SIZED if len(entry.linkage().mechanism.drives) == 1]
SEVERAL_DRIVES = [entry.id for entry in SIZED if len(entry.linkage().mechanism.drives) > 1]
TOUCHY = ["cam", "cam_roller", "geneva", "scissor2", "scissor2_cyl", "loco2", "quad"]


@pytest.mark.parametrize("id", [id for id in TOUCHY if id in ONE_DRIVE])
def test_machines_whose_events_touch(id: str) -> None:
    linkage = entries()[id].linkage()
    check(linkage, 2.54, 0.7, 0.3 + 0.4j)


@pytest.mark.slow
@pytest.mark.parametrize("id", ONE_DRIVE)
def test_machines_of_the_catalog(id: str) -> None:
    linkage = entries()[id].linkage()
    for scale in SCALES:
        check(linkage, scale, 0.7 * scale**0.1, 0.3 + 0.4j)


@pytest.mark.parametrize("id", SEVERAL_DRIVES)
def test_poses_of_machines_with_several_drives(id: str) -> None:
    linkage = entries()[id].linkage()
    turning = np.array([drive.direction.startswith("R") for drive in linkage.mechanism.drives])
    speed = np.where(turning, 1.0, linkage.size) * (1 + 0.3 * np.arange(len(turning)))
    reference = pose_at_reference(cached_plan(linkage), np.zeros(len(turning))).drives
    path = reference + np.linspace(0, 0.05, 11)[:, None] * speed

    def joints(other: Linkage, factor: object = 1.0) -> np.ndarray:
        """The places, velocities and accelerations of all joints in all poses: (orders, joints, poses)."""
        motion = move(other, path * factor, speed=speed * factor, order=2)
        assert motion.complete, motion.message()
        names = other.mechanism.chain.joint_names()
        return np.array([[motion.complex_point(name, order=order) for name in names] for order in range(3)])

    size, angle, shift = linkage.size, 0.7, (0.3 + 0.4j) * linkage.size
    origin = np.array([1.0, 0.0, 0.0])[:, None, None] * shift_of(linkage, linkage.mechanism.frame, shift)
    expected = joints(linkage)
    assert np.abs(expected[1]).max() > 0.1 * size  # it moves
    for scale in SCALES:
        scaled = joints(linkage.scaled(scale), np.where(turning, 1.0, scale))
        np.testing.assert_allclose(scaled / scale, expected, rtol=0, atol=POSE * size)
    turned = joints(in_other_coordinates(linkage, angle, shift))
    np.testing.assert_allclose(turned, expected * rect(1, angle) + origin, rtol=0, atol=POSE * size)
    image = joints(mirrored(linkage), np.where(turning, -1.0, 1.0))
    np.testing.assert_allclose(image, expected.conj(), rtol=0, atol=POSE * size)
