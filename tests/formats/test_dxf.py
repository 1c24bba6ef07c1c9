"""Plates for cutting: their outlines, and the DXF file where ezdxf is installed."""

import io
from math import atan, cos, hypot, pi, sin, sqrt
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gruebler import files
from gruebler.analysis.plates import plates_of, whole_motion
from gruebler.catalog import entry
from gruebler.errors import GrueblerError
from gruebler.formats.dxf import dxf_from_linkage, plate_outline
from gruebler.formats.pin_drawings import lower_linkage
from gruebler.fourbar import FourBar, SliderCrank

FOLDER = Path(__file__).parent / "files"
spots = st.lists(st.tuples(st.integers(-50, 50), st.integers(-50, 50)), min_size=1, max_size=7, unique=True)


def edge(outline, parts=24):
    """Places on the edge; the arcs by their bulges."""
    for (x, y, bulge), (to_x, to_y, _) in zip(outline, outline[1:] + outline[:1], strict=True):
        a, b = complex(x, y), complex(to_x, to_y)
        for k in range(parts):
            t = k / parts
            if not bulge:
                yield a + t * (b - a)
                continue
            centre = (a + b) / 2 + 1j * (b - a) * (1 - bulge**2) / (4 * bulge)
            angle = 4 * atan(bulge) * t
            yield centre + (a - centre) * complex(cos(angle), sin(angle))


@given(places=spots, margin=st.floats(0.5, 5))
def test_a_plate_keeps_its_margin_around_every_hole(places, margin):
    outline = plate_outline(places, margin)
    gaps = [min(abs(z - complex(*place)) for z in edge(outline)) for place in places]
    assert all(gap > margin * 0.99 - 1e-6 for gap in gaps)
    # an arc about each corner of the hull: the edge comes as near as the margin
    assert min(gaps) < margin * 1.05
    # the arcs turn once in all
    turns = sum(4 * atan(bulge) for _, _, bulge in outline)
    assert turns == pytest.approx(2 * pi, abs=1e-6)


LINKAGES = {
    "four-bar": FourBar(25, 70, 40, 70).linkage({"K": (45, 40)}),
    "slider-crank": SliderCrank(25, 70, 5).linkage({"K": (45, 40)}, unit="cm"),
    "jansen": files.read(FOLDER / "jansen.linkage2", left_out=[]),
    "shaper": files.read(FOLDER / "shaper.pmks", left_out=[]),
}


@pytest.mark.parametrize("name", LINKAGES)
def test_a_drawing_opens_without_complaint(name):
    ezdxf = pytest.importorskip("ezdxf")
    linkage = LINKAGES[name]
    document = ezdxf.read(io.StringIO(dxf_from_linkage(linkage, [], hole=2.0, margin=3.0)))
    assert not document.audit().has_errors
    assert document.dxfversion == "AC1015"
    assert document.header["$INSUNITS"] == {"mm": 4, "cm": 5}[linkage.unit]
    space = document.modelspace()
    circles = space.query("CIRCLE")
    assert all(circle.dxf.radius == 1.0 for circle in circles)
    assert any(hypot(*circle.dxf.center.vec2) < 1e-12 for circle in circles)  # a fixed pin is the origin
    curves = space.query('LWPOLYLINE[layer=="CURVES"]')
    assert len(curves) == len(linkage.points)
    edges = [line for line in space.query("LWPOLYLINE") if line.dxf.layer != "CURVES"]
    plates = plates_of(whole_motion(lower_linkage(linkage)))
    assert len(edges) == sum(1 + len(plate.slots) for plate in plates.plates.values())
    assert all(line.closed for line in edges)


def test_holes_are_as_far_apart_as_the_pins_of_the_link():
    ezdxf = pytest.importorskip("ezdxf")
    linkage = LINKAGES["four-bar"]
    document = ezdxf.read(io.StringIO(dxf_from_linkage(linkage, [])))
    for link, length in {"crank": 25, "coupler": 70, "rocker": 40, "frame": 70}.items():
        one, other = (c.dxf.center for c in document.modelspace().query(f'CIRCLE[layer=="{link}"]'))
        assert one.distance(other) == pytest.approx(length, abs=1e-9)


def width_and_length(edge):
    """Of a slot: the distance of its sides, and that of the middles of its round ends."""
    corners = [complex(x, y) for x, y in edge.get_points("xy")]
    sides = sorted(abs(a - b) for a, b in zip(corners, corners[1:] + corners[:1], strict=True))
    return sides[0], sides[-1]


def test_a_slot_is_as_long_as_its_pin_moves():
    """The stroke of a slider-crank is √((b + a)² - e²) - √((b - a)² - e²)."""
    ezdxf = pytest.importorskip("ezdxf")
    document = ezdxf.read(io.StringIO(dxf_from_linkage(LINKAGES["slider-crank"], [], hole=2.0, margin=3.0)))
    _, slot = document.modelspace().query('LWPOLYLINE[layer=="frame"]')
    stroke = sqrt(95**2 - 25) - sqrt(45**2 - 25)
    assert width_and_length(slot) == pytest.approx((2.0, stroke), rel=5e-6)  # half a degree from pose to pose


def test_layers_name_planes():
    ezdxf = pytest.importorskip("ezdxf")
    document = ezdxf.read(io.StringIO(dxf_from_linkage(LINKAGES["four-bar"], [])))
    found = {link: document.layers.get(link).description for link in ("frame", "crank", "coupler", "rocker")}
    assert found == {"frame": "plane 1", "crank": "plane 2", "coupler": "plane 3", "rocker": "plane 2"}


def test_a_file_for_each_link(tmp_path):
    ezdxf = pytest.importorskip("ezdxf")
    left_out = []
    folder = files.write(LINKAGES["four-bar"], tmp_path / "plates", "dxf-links", left_out=left_out)
    assert sorted(path.name for path in folder.iterdir()) == [
        "1 frame.dxf",
        "2 crank.dxf",
        "2 rocker.dxf",
        "3 coupler.dxf",
    ]
    for path in folder.iterdir():
        document = ezdxf.readfile(path)
        assert not document.audit().has_errors
        first, second = (circle.dxf.center for circle in document.modelspace().query("CIRCLE"))
        length = {"frame": 70, "crank": 25, "coupler": 70, "rocker": 40}[path.stem[2:]]
        assert (first.x, first.y) == (0, 0)
        assert (second.x, second.y) == pytest.approx((length, 0), abs=1e-9)
    assert "paths of points" in map(str, left_out)


def test_what_has_several_drives_is_drawn_in_its_position():
    ezdxf = pytest.importorskip("ezdxf")
    left_out = []
    document = ezdxf.read(io.StringIO(dxf_from_linkage(entry("excavator").linkage(), left_out)))
    assert not document.audit().has_errors
    assert any("planes" in str(note) and "one drive" in str(note) for note in left_out)


def test_what_collides_is_said():
    pytest.importorskip("ezdxf")
    left_out = []
    dxf_from_linkage(entry("scottrussell").linkage(), left_out)
    assert any("frame, crank, conrod are in each other's way" in str(note) for note in left_out)


def test_a_hole_needs_a_margin():
    pytest.importorskip("ezdxf")
    with pytest.raises(GrueblerError, match="needs a margin"):
        dxf_from_linkage(LINKAGES["four-bar"], [], hole=5, margin=2)
