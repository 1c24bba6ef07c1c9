"""Measures and events do not depend on the unit, nor on where and how a linkage lies, nor on its being mirrored.

`GRUEBLER_LINKAGES=10000 pytest -m slow tests/kinematics/test_same_measures.py` tries so many random linkages.
"""

from __future__ import annotations

import math
import os
from cmath import rect

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from gruebler.analysis import measures
from gruebler.analysis.measures import Measures
from gruebler.catalog import entries
from gruebler.errors import LinkageError
from gruebler.linkages import CamDisc, Circle, Linkage, Wheel
from gruebler.linkages.elements import Element, Pin
from gruebler.mechanism import Mechanism

TURN = 2 * math.pi
SCALES = [1e-6, 1e6, 3.7, 2.54]
CLOSE = 1e-6  # of the natural size: multiple zeros are known to some 1e-8
PLACE = 1e-5  # the same for places: poses next to a change point have half their digits


def laid(linkage: Linkage, turn: float, shift: complex) -> Linkage:
    """The same linkage in other coordinates: those of every link are turned by one angle, and shifted."""
    by, links = rect(1, turn), linkage.mechanism.chain.links

    def own(link: str) -> complex:
        return shift * (1 + links.index(link))

    def element(link: str, e: Element) -> Element:
        z = complex(e.x, e.y) * by + own(link)
        if isinstance(e, Pin | Wheel | Circle):
            return e._replace(x=z.real, y=z.imag)
        return e._replace(x=z.real, y=z.imag, angle=e.angle + turn)

    home = None
    if linkage.reference_pose is not None:
        places = {
            link: complex(p.x, p.y) * by + own(linkage.mechanism.frame) - rect(1, p.angle) * own(link)
            for link, p in linkage.reference_pose.items()
        }
        home = {link: (z.real, z.imag, linkage.reference_pose[link].angle) for link, z in places.items()}
    elements: dict[str, dict[str | int, object]] = {link: {} for link in links}
    for (number, link), e in linkage.elements.items():
        elements[link][number] = element(link, e)
    return Linkage(linkage.mechanism, elements, unit=linkage.unit, reference_pose=home, outputs=linkage.outputs)


def facts(found: Measures, *, mirrored: bool = False, plain: bool = False) -> dict[str, object]:
    """What must be the same: lengths in sizes, angles as they are, of a mirror image with the other sign."""
    size = found.linkage.size
    drive = (-1 if mirrored else 1) if found.turning_drive else 1 / size
    out = (-1 if mirrored else 1) if found.output.turning else 1 / size
    span = found.span

    def at(value: float) -> float:
        return value * drive

    def rate(order: int) -> float:
        return out / drive**order

    def kind(word: str, order: int) -> str:
        """What is a maximum of a derivative, or rises, is a minimum where its sign is the other one."""
        swap = {"maximum": "minimum", "minimum": "maximum", "rising": "falling", "falling": "rising"}
        return swap.get(word, word) if rate(order) < 0 else word

    def rows(items: object, order: int) -> list[tuple[float, float, str]]:
        values = [getattr(i, "output", getattr(i, "value", 0.0)) * rate(order) for i in items]
        return [(at(i.drive), value, kind(i.kind, order)) for i, value in zip(items, values, strict=True)]

    transfer, mu = found.transfer, found.transmission
    dwells = [(at(d.drive), d.output * out, kind(d.kind, 0) + d.side) for d in found.dwells]
    ways = [found.phi_forward, found.phi_back]
    return {
        "full": (span.full, span.turns),
        "range": [] if span.full else sorted((at(span.low), at(span.high))),
        "dead centres": rows(found.dead_centres, 0),
        # where nothing else decides, the larger angle is the inner dead centre: of a mirror image the other one
        "sides": [] if mirrored or plain else [(at(c.drive), 0.0, c.side) for c in found.dead_centres],
        "dwells": [(*row[:2], "") for row in dwells] if mirrored or plain else dwells,
        "durations": [(at(d.drive), d.duration * abs(drive), "") for d in found.dwells],
        "turns": abs(found.output_turns),
        "travel": None if found.travel is None else found.travel * abs(out),
        "ways": None if None in ways else sorted(ways),
        "ratio": found.time_ratio,
        "change points": [(at(c.drive), 0.0, c.form + " ".join(c.links)) for c in found.change_points],
        "still": (transfer.still, transfer.uniform),
        "zeros": rows(transfer.zeros, 1),
        "velocity": rows(transfer.velocity, 1),
        "acceleration": rows(transfer.acceleration, 2),
        "transmission": [] if mu is None else [(at(e.drive), e.mu, " ".join(e.links)) for e in mu.extremes],
    }


def same(one: dict[str, object], other: dict[str, object], found: Measures) -> None:
    period = found.span.period if found.span.full else None
    whole = TURN if found.output.turning and found.output_turns else None
    assert one.keys() == other.keys()
    for key, value in one.items():
        mine, yours = value, other[key]
        if not isinstance(mine, list) or not mine or not isinstance(mine[0], tuple):
            assert mine == (yours if mine is None or yours is None else pytest.approx(yours, rel=CLOSE, abs=CLOSE)), key
            continue
        assert len(mine) == len(yours), (key, mine, yours)
        left = list(yours)
        for at, level, word in mine:
            near = [row for row in left if row[2] == word and gap(row[0] - at, period) < PLACE]
            again = whole if key in ("dead centres", "dwells") else None
            near.sort(key=lambda row, level=level, again=again: gap(row[1] - level, again))
            assert near, (key, (at, level, word), left)
            assert gap(near[0][1] - level, again) <= CLOSE * max(1.0, abs(level)), (key, at, level, near)
            left.remove(near[0])


def gap(x: float, period: float | None) -> float:
    return abs(x) if period is None else abs((x + period / 2) % period - period / 2)


def check(linkage: Linkage, scale: float, turn: float, shift: complex) -> None:
    found = measures(linkage)
    plain = facts(found)
    same(facts(measures(linkage.scaled(scale))), plain, found)
    same(facts(measures(laid(linkage, turn, shift * linkage.size))), plain, found)
    if not any(isinstance(e, CamDisc) for e in linkage.elements.values()):
        same(facts(measures(linkage.mirrored()), mirrored=True), facts(found, plain=True), found)


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
    try:
        found = measures(linkage)
    except LinkageError:
        return None
    narrow = 1e-3 * (1 if found.turning_drive else linkage.size)
    return linkage if found.span.width > narrow else None


@settings(max_examples=6, deadline=None, suppress_health_check=[HealthCheck.filter_too_much, HealthCheck.too_slow])
@given(
    st.integers(0, 2**32 - 1),
    st.floats(-6, 6).map(lambda x: 10**x),
    st.floats(-3, 3),
    st.complex_numbers(max_magnitude=2),
)
def test_random_linkages(seed: int, scale: float, turn: float, shift: complex) -> None:
    linkage = well_placed(seed)
    assume(linkage is not None)
    check(linkage, scale, turn, shift)


@pytest.mark.slow
def test_many_random_linkages() -> None:
    wanted, tried, failed = int(os.environ.get("GRUEBLER_LINKAGES", "40")), 0, []
    for seed in range(100_000):
        linkage = well_placed(seed)
        if linkage is None:
            continue
        tried += 1
        rng = np.random.default_rng(seed + 1)
        try:
            check(linkage, 10 ** rng.uniform(-6, 6), rng.uniform(-3, 3), complex(*rng.normal(size=2)))
        except (AssertionError, LinkageError) as error:
            failed.append((seed, str(error)[:300]))
        if tried == wanted:
            break
    assert tried == wanted
    assert not failed


# --- the machines of the catalog ---------------------------------------------------------------------

SIZED = [one for one in entries().values() if one.dimensions is not None]
ONE_DRIVE = [one.id for one in SIZED if len(one.linkage().mechanism.drives) == 1]
TOUCHY = ["cam", "cam_roller", "geneva", "scissor2", "scissor2_cyl", "loco2", "quad"]


def check_machine(id: str) -> None:
    linkage = entries()[id].linkage()
    try:
        measures(linkage)
    except LinkageError as error:  # it cannot be moved by its drive, in no unit
        with pytest.raises(LinkageError, match=str(error)[:20].replace("(", r"\(").replace(")", r"\)")):
            measures(linkage.scaled(3.7))
        return
    for scale in SCALES:
        check(linkage, scale, 0.7 * scale**0.1, 0.3 + 0.4j)


@pytest.mark.parametrize("id", [id for id in TOUCHY if id in ONE_DRIVE])
def test_machines_whose_events_touch(id: str) -> None:
    linkage = entries()[id].linkage()
    check(linkage, 2.54, 0.7, 0.3 + 0.4j)


@pytest.mark.slow
@pytest.mark.parametrize("id", ONE_DRIVE)
def test_machines_of_the_catalog(id: str) -> None:
    check_machine(id)
