"""Structure pictures say what touches: wheels, belts, cams, rollers, Geneva drives, pins in slots."""

import pytest

from gruebler.base.errors import ChainError
from gruebler.pictures.canvas.shapes import CircleShape, Polylines, TextShape
from gruebler.pictures.canvas.symbols import CONTACTS
from gruebler.pictures.linkage.element_pictures import contact_shapes
from gruebler.pictures.structure import draw_structure
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
