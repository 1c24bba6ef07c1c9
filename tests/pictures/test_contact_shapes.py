"""Structure pictures say what touches: wheels, belts, cams, rollers, Geneva drives, pins in slots."""

import pytest

from gruebler.base.errors import ChainError
from gruebler.pictures.canvas.contacts import CONTACTS
from gruebler.pictures.canvas.shapes import CircleShape, Polylines, TextShape
from gruebler.pictures.linkage.element_pictures import contact_shapes
from gruebler.pictures.structure import draw_structure, place_joints
from gruebler.teaching.catalog import entries
from gruebler.teaching.catalog.feature_query import entry_mechanism

EXPECTED = {
    "geartrain": {"gear"},
    "belt": {"belt"},
    "friction_forced": {"wheel"},
    "geneva": {"geneva-driver", "geneva-wheel"},
    "cam": {"cam", "flat"},
    "cam_roller": {"cam", "roller"},
    "cam_rocker_flat": {"cam", "flat"},
    "diff": {"gear", "ring"},
    "elliptic_gears": {"oval"},
    "hubpodium": {"pin", "slot"},
    "winch_plane": {"rack", "gear"},
}


def picture(id, **options):
    entry = entries()[id]
    return draw_structure(entry_mechanism(entry), contacts=contact_shapes(entry.linkage()), **options)


@pytest.mark.parametrize("id", EXPECTED)
def test_what_touches(id):
    assert {*contact_shapes(entries()[id].linkage()).values()} == EXPECTED[id] <= {*CONTACTS}


def test_gears_geneva_and_cam_are_told_apart():
    # The same chain: without contacts four pictures are equal but for their names.
    plain = {
        id: draw_structure(entry_mechanism(entries()[id])).shapes
        for id in ("geartrain", "geneva", "cam_rocker_flat", "belt")
    }
    assert len({len(shapes) for shapes in plain.values()}) == 1
    shown = {id: picture(id).svg().partition("</desc>")[2] for id in plain}
    assert len(set(shown.values())) == len(plain)


def test_gear_pairs_show_pitch_circles_that_touch():
    circles = [s for s in picture("geartrain").shapes if isinstance(s, CircleShape) and s.style == "pitch"]
    first, second = circles
    assert second.at.minus(first.at).length == pytest.approx(first.radius + second.radius)
    ring, *others = sorted(
        (s for s in picture("diff").shapes if isinstance(s, CircleShape) and s.style == "pitch"),
        key=lambda s: -s.radius,
    )
    inside = [s for s in others if abs(ring.at.minus(s.at).length - (ring.radius - s.radius)) < 1e-6]
    assert len(inside) == 1  # the planet runs within the ring


def test_round_bodies_are_centred_on_their_bearings_and_touch():
    found = 0
    for entry in entries().values():
        if entry.space == "planar" and entry.dimensions is not None:
            mechanism, contacts = entry_mechanism(entry), contact_shapes(entry.linkage())
            placed = place_joints(mechanism, contacts)
            chain = placed.chain
            bearings = {
                link: [placed.joints[k] for k, j in enumerate(chain.joints) if j.pair.is_turning and link in j.links]
                for link in chain.links
            }
            for (joint, link), wheel in placed.wheels.items():
                found += 1
                assert wheel.centre in bearings[link], (entry.id, link)
                assert wheel.radius == pytest.approx(wheel.centre.minus(placed.joints[joint]).length), (entry.id, link)
            for number, joint in enumerate(chain.joints):
                pair = [placed.wheels[number, link] for link in joint.links if (number, link) in placed.wheels]
                if len(pair) == 2:
                    apart = pair[1].centre.minus(pair[0].centre).length
                    inside = "ring" in {placed.contacts[number, link] for link in joint.links}
                    assert apart == pytest.approx(abs(pair[0].radius + (-1 if inside else 1) * pair[1].radius)), (
                        entry.id
                    )
    assert found > 20


def test_coaxial_wheels_have_one_bearing_and_one_size_each():
    """Of the differential with two planets: the suns and the carrier turn about one axis, the ring encloses all."""
    entry = entries()["diff2p"]
    placed = place_joints(entry_mechanism(entry), contact_shapes(entry.linkage()))
    sizes = {
        link: {round(w.radius, 6) for (_, owner), w in placed.wheels.items() if owner == link} for link in placed.bare
    }
    assert {link: len(radii) for link, radii in sizes.items() if radii} == dict.fromkeys(
        ("sun", "ring_gear", "planet1", "planet2"), 1
    )
    centres = {w.centre for (_, owner), w in placed.wheels.items() if owner in ("sun", "ring_gear")}
    assert len(centres) == 1
    assert {placed.joints[k] for k, joint in enumerate(placed.chain.joints) if "frame" in joint.links} == centres


def test_the_bar_of_a_geneva_drive_lies_under_its_pin():
    shapes = picture("geneva").shapes
    bar = max(k for k, shape in enumerate(shapes) if isinstance(shape, Polylines) and "frame" in shape.style)
    (pin,) = (k for k, s in enumerate(shapes) if isinstance(s, CircleShape) and s.style == "joint" and s.radius == 4.5)
    assert bar < pin


def test_a_belt_has_two_strands():
    (strands,) = [s for s in picture("belt").shapes if isinstance(s, Polylines) and s.style == "edge"]
    assert len(strands.parts) == 2


def test_symbols_and_outputs():
    figure = picture("cam_roller", symbols=True, outputs=entries()["cam_roller"].outputs, lang="de")
    letters = sorted(s.text for s in figure.shapes if isinstance(s, TextShape))
    assert letters == ["D", "D", "G", "S"]
    assert sum(shape.style == "velocity-head" for shape in figure.shapes) == 2
    with pytest.raises(ChainError, match="handle"):
        picture("cam", outputs=["handle"])
