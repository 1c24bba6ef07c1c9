"""What the page finds by itself (range, dead centres, transmission angle, dragged sizes) against the library."""

import json
import shutil
import subprocess
from math import pi
from pathlib import Path

import msgspec
import numpy as np
import pytest

from gruebler.files import linkage_from_json
from gruebler.mechanics.analysis.measuring import Measures, measures
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.elements import Wheel
from gruebler.page.model import model_of
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entries
from tests.mechanics.analysis.test_transmission import WATT

BUILT = Path(__file__).parents[2] / "src/gruebler/page/static/explorer.js"
NODE = pytest.mark.skipif(shutil.which("node") is None, reason="the page's kernel needs node to be executed here")


def measured(linkages: list[Linkage], tmp_path: Path) -> list[dict]:
    file = tmp_path / "models.jsonl"
    file.write_bytes(b"".join(msgspec.json.encode(model_of(one)) + b"\n" for one in linkages))
    command = ["node", str(Path(__file__).parent / "measures.mjs"), str(BUILT), str(file)]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=300)
    found = [json.loads(line) for line in done.stdout.splitlines()]
    assert len(found) == len(linkages)
    return found


def check(name: str, found: dict, wanted: Measures, size: float) -> None:
    span, links = wanted.span, wanted.linkage.mechanism.chain.links
    assert (found["full"], found["turns"]) == (span.full, span.turns), name
    if not span.full:
        assert found["low"] == pytest.approx(span.low, abs=1e-6 * max(1, size)), name
        assert found["high"] == pytest.approx(span.high, abs=1e-6 * max(1, size)), name
    period = 2 * pi * max(1, found["turns"])
    values = [one["value"] % period if span.full else one["value"] for one in found["deadCentres"]]
    assert sorted(values) == pytest.approx(sorted(one.drive for one in wanted.dead_centres), abs=1e-7), name
    if wanted.travel is None:
        assert found["travel"] is None, name
    else:
        assert found["travel"] == pytest.approx(wanted.travel, abs=1e-6 * max(1, size)), name
    if wanted.transmission is None:
        assert found["least"] is None, name
    else:
        assert found["least"]["mu"] == pytest.approx(wanted.transmission.smallest.mu, abs=1e-7), name
        leg, value = found["least"]["leg"], found["least"]["value"]
        lap = period if span.full else float("inf")
        alike = {
            one.links
            for one in wanted.transmission.extremes
            if one.mu < wanted.transmission.smallest.mu + 1e-6
            and min(abs(value - one.drive) % lap, abs(lap - abs(value - one.drive) % lap)) < 1e-3
        }  # limits of symmetric machines are equal but for rounding
        assert leg is None or tuple(links[k] for k in leg["links"] if k < len(links)) in alike, name


@NODE
def test_every_planar_machine_is_measured_and_dragged_as_the_library_does_it(tmp_path):
    machines = {e.id: e.linkage() for e in entries().values() if e.dimensions is not None and e.space == "planar"}
    dragged, compared = 0, 0
    for (name, linkage), found in zip(machines.items(), measured(list(machines.values()), tmp_path), strict=True):
        for drag in found["drags"]:
            assert "refused" not in drag, (name, drag)
            assert drag["missed"] < 1e-9, (name, drag["joint"])
            assert drag["moved"] < 1e-9, (name, drag["joint"])
            dragged += 1
        assert linkage_from_json(found["document"]).mechanism == linkage.mechanism
        if len(linkage.mechanism.drives) != 1:
            continue
        check(name, found, measures(linkage), linkage.size)
        for drag in found["drags"][:1]:
            other = linkage_from_json(drag["document"])
            if cached_is_overconstrained(linkage):
                continue
            wanted = measures(other)
            assert drag["full"] == wanted.span.full, (name, drag["joint"])
            if wanted.transmission is not None:
                # the ends of a range are known to half the digits of the sizes, which went through degrees
                assert drag["least"]["mu"] == pytest.approx(wanted.transmission.smallest.mu, abs=1e-6), name
            compared += 1
    assert dragged > 150
    assert compared > 25


@NODE
def test_an_angle_that_is_the_same_but_for_rounded_lengths_has_no_place(tmp_path):
    """The block of an inverted slider-crank pushes across its lever. With the eccentricity e at the distance r of its
    pin the angle is 90 degrees less asin(e/r): between 3e-7 and 1e-7 of a radian here."""
    linkage = InvertedSliderCrank(30, 60, 9e-6).linkage()
    (found,) = measured([linkage], tmp_path)
    assert found["least"]["leg"] is None  # throughout
    assert found["least"]["mu"] == pytest.approx(pi / 2, abs=1e-6)


def cached_is_overconstrained(linkage: Linkage) -> bool:
    from gruebler.mechanics.kinematics.solve import cached_plan

    return bool(cached_plan(linkage).released)


@NODE
def test_the_centre_of_a_wheel_goes_around_those_that_it_meshes_with(tmp_path):
    """The distances of the wheels stay, and the dragged train moves on as the library moves its document."""
    machines = {id: entries()[id].linkage() for id in ("geartrain", "belt", "diff", "friction_rigid")}
    machines["geared crank"] = geared_crank()
    centres = {}
    for (name, linkage), found in zip(machines.items(), measured(list(machines.values()), tmp_path), strict=True):
        names = linkage.mechanism.chain.joint_names()
        for drag in found["drags"]:
            assert "refused" not in drag, (name, drag)
            assert max(drag["missed"], drag["moved"]) < 1e-9, name
            other = linkage_from_json(drag["document"])
            later = drag["later"]
            free = [k for k, _ in enumerate(linkage.mechanism.drives)]
            motion = move(other, [[later["drives"][k] for k in free]] if len(free) > 1 else [later["drives"][0]])
            for k, joint in enumerate(linkage.mechanism.chain.joints):
                if joint.pair.is_turning:
                    np.testing.assert_allclose(motion.point(names[k])[0], later["joints"][k], atol=1e-7 * other.size)
            for link, (x, y) in zip(linkage.mechanism.chain.links, later["turns"], strict=True):
                assert abs(np.exp(1j * motion.angle(link)[0]) - complex(x, y)) < 1e-7, (name, link)
            centres.setdefault(name, set()).add(names[drag["joint"]])
    both = {"R(frame-gear1)", "R(frame-gear2)"}
    assert centres["geartrain"] == both
    assert centres["belt"] == {"R(frame-pulley1)", "R(frame-pulley2)"}
    assert centres["diff"] == {"R(carrier-planet)"}
    assert centres["geared crank"] == {*both, "R(gear2-rod)", "R(rod-slider)"}


def geared_crank() -> Linkage:
    """A pair of gears, the second of which is the crank of a slider-crank."""
    chain = "R(frame-gear1) G(gear1-gear2) R(frame-gear2) R(gear2-rod) R(rod-slider) P(frame-slider)"
    places = {
        "R(frame-gear1)": (-50, 0),
        "G(gear1-gear2)": {"gear1": Wheel(-50, 0, 20.0, teeth=20), "gear2": Wheel(0, 0, 30.0, teeth=30)},
        "R(frame-gear2)": (0, 0),
        "R(gear2-rod)": (15, 15),
        "R(rod-slider)": (90, 5),
        "P(frame-slider)": (90, 5, 0),
    }
    return Linkage.from_drawing(Mechanism.parse(f"{chain}; frame=frame; drive=R(frame-gear1)"), places)


@NODE
def test_the_law_of_grashof(tmp_path):
    """An independent check without any machine of the catalog: which four-bars turn, and their transmission angles."""
    bars = [FourBar(25, 70, 40, 70), FourBar(50, 70, 40, 70), FourBar(30, 30, 60, 40), FourBar(10, 12, 15, 16)]
    for bar, found in zip(bars, measured([bar.linkage() for bar in bars], tmp_path), strict=True):
        sides = sorted((bar.a, bar.b, bar.c, bar.d))
        crank = sides[0] + sides[3] < sides[1] + sides[2] and sides[0] in (bar.a, bar.d)
        assert found["full"] == crank
        if crank:
            assert found["least"]["mu"] == pytest.approx(bar.transmission_angle.smallest.mu, abs=1e-9)


@NODE
def test_a_watt_linkage_is_as_good_as_the_worse_of_its_four_bars(tmp_path):
    """By hand, as in tests/mechanics/analysis/test_transmission.py: 47.5 degrees at 0, in the first four-bar."""
    (found,) = measured([WATT], tmp_path)
    coupler, rocker = np.hypot(50, 20), np.hypot(10, 40)
    worst = np.arccos((coupler**2 + rocker**2 - 40**2) / (2 * coupler * rocker))
    assert found["least"]["mu"] == pytest.approx(worst, abs=1e-9)
    assert np.cos(found["least"]["value"]) == pytest.approx(1, abs=1e-9)
    assert [WATT.mechanism.chain.links[k] for k in found["least"]["leg"]["links"]] == ["2"]


@NODE
def test_a_belt_goes_with_its_wheels(tmp_path):
    """Its runs touch the wheels wherever these are dragged to."""
    linkage = entries()["belt"].linkage()
    (found,) = measured([linkage], tmp_path)
    assert len(found["drags"]) == 2
    for drag in found["drags"]:
        other = linkage_from_json(drag["document"])
        centres = [complex(e.x, e.y) for (_, link), e in other.elements.items() if link == "frame"]
        radii = [e.radius for e in other.elements.values() if isinstance(e, Wheel)]
        for x, y, u, v in drag["belts"]:
            along = (complex(u, v) - complex(x, y)) / abs(complex(u, v) - complex(x, y))
            for centre, radius in zip(centres, radii, strict=True):
                assert abs(((centre - complex(x, y)) * along.conjugate()).imag) == pytest.approx(radius, rel=1e-5)
