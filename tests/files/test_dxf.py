"""Plates for cutting: their outlines, and the DXF file where ezdxf is installed."""

import io
from cmath import phase, rect
from math import atan, cos, pi, sin, sqrt
from pathlib import Path

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from gruebler.base.errors import GrueblerError
from gruebler.files import values as files
from gruebler.files.drawing_linkages import linkage_of_drawing
from gruebler.files.dxf import cut_outs, dxf_from_linkage, dxf_of_links, plate_outline
from gruebler.files.linkage_drawings import lower_linkage
from gruebler.files.pmks import drawing_from_pmks
from gruebler.mechanics.analysis.plates import Plate, plates_of, whole_motion
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.teaching.catalog import entry

FOLDER = Path(__file__).parent / "samples"
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


@pytest.mark.parametrize(
    ("unit", "drawn", "long"),
    [("mm", 4, 25), ("cm", 4, 250), ("m", 4, 25_000), ("in", 1, 25), ("ft", 1, 300), ("", 0, 25)],
)
def test_drawings_are_in_millimetres_or_inches(unit, drawn, long):
    """A crank of 25 of the unit, between its two holes; 4 and 1 are the codes of $INSUNITS."""
    ezdxf = pytest.importorskip("ezdxf")
    linkage = FourBar(25, 70, 40, 70).linkage(unit=unit)
    alone = dxf_of_links(linkage, [], hole=2.0)
    texts = [dxf_from_linkage(linkage, [], hole=2.0), next(text for name, text in alone.items() if "crank" in name)]
    for document in (ezdxf.read(io.StringIO(text)) for text in texts):
        assert (document.header["$INSUNITS"], document.header["$MEASUREMENT"]) == (drawn, int(drawn != 1))
        first, second = (one.dxf.center for one in document.modelspace().query('CIRCLE[layer=="crank"]'))
        assert (first - second).magnitude == pytest.approx(long)
        for circle in document.modelspace().query("CIRCLE"):
            assert circle.dxf.radius == pytest.approx(long / 25)


@pytest.mark.parametrize("name", LINKAGES)
def test_a_drawing_opens_without_complaint(name):
    ezdxf = pytest.importorskip("ezdxf")
    linkage = LINKAGES[name]
    document = ezdxf.read(io.StringIO(dxf_from_linkage(linkage, [], hole=2.0, margin=3.0)))
    assert not document.audit().has_errors
    assert document.dxfversion == "AC1015"
    assert document.header["$INSUNITS"] == 4  # millimetres
    space = document.modelspace()
    circles = space.query("CIRCLE")
    millimetres = {"mm": 1, "cm": 10}[linkage.unit]
    assert all(circle.dxf.radius == millimetres for circle in circles)
    curves = space.query('LWPOLYLINE[layer=="CURVES"]')
    assert len(curves) == len(linkage.points)
    edges = [line for line in space.query("LWPOLYLINE") if line.dxf.layer != "CURVES"]
    plates = plates_of(whole_motion(lower_linkage(linkage.scaled(millimetres))))
    assert len(edges) == sum(1 + len(cut_outs(plate, 2.0 * millimetres).slots) for plate in plates.plates.values())
    assert all(line.closed for line in edges)
    corners = [corner for line in space.query("LWPOLYLINE") for corner in line.get_points("xy")]
    for axis in (0, 1):  # what a program shows first; arcs of the edges reach beyond their ends, by the margin at most
        values = [corner[axis] for corner in corners]
        assert min(values) - 3.0 * millimetres <= document.header["$EXTMIN"][axis] <= min(values) + 1e-9
        assert max(values) - 1e-9 <= document.header["$EXTMAX"][axis] <= max(values) + 3.0 * millimetres


def test_plates_lie_where_the_file_of_the_linkage_has_them():
    """Klann's leg in a file of Linkage: its anchors by hand, in pixels of 96 to an inch; the page shows the same."""
    ezdxf = pytest.importorskip("ezdxf")
    linkage = files.read(FOLDER / "klann.linkage2", left_out=[])
    document = ezdxf.read(io.StringIO(dxf_from_linkage(linkage, [])))
    holes = document.modelspace().query(f'CIRCLE[layer=="{linkage.mechanism.frame}"]')
    found = sorted(tuple(circle.dxf.center.vec2) for circle in holes)
    anchors = [(374.335829, -342.089810), (384.188120, -263.389741), (471.970983, -296.009544)]
    for place, anchor in zip(found, anchors, strict=True):
        assert place == pytest.approx([25.4 / 96 * value for value in anchor], abs=1e-5)


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
    """The stroke of a slider-crank, in cm, is √((b + a)² - e²) - √((b - a)² - e²)."""
    ezdxf = pytest.importorskip("ezdxf")
    document = ezdxf.read(io.StringIO(dxf_from_linkage(LINKAGES["slider-crank"], [], hole=2.0, margin=3.0)))
    _, slot = document.modelspace().query('LWPOLYLINE[layer=="frame"]')
    stroke = sqrt(95**2 - 25) - sqrt(45**2 - 25)
    assert width_and_length(slot) == pytest.approx((20.0, 10 * stroke), rel=5e-6)  # half a degree from pose to pose


def test_layers_name_planes():
    ezdxf = pytest.importorskip("ezdxf")
    document = ezdxf.read(io.StringIO(dxf_from_linkage(LINKAGES["four-bar"], [])))
    found = {link: document.layers.get(link).description for link in ("frame", "crank", "coupler", "rocker")}
    assert found == {"frame": "plane 1", "crank": "plane 2", "coupler": "plane 3", "rocker": "plane 2"}


def test_a_file_for_each_link(tmp_path):
    ezdxf = pytest.importorskip("ezdxf")
    left_out = []
    folder = files.write(LINKAGES["four-bar"], tmp_path / "plates", format_name="dxf-links", left_out=left_out)
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


# --- cut-outs that run into each other ----------------------------------------------------------------

PLUS = {  # verification mechanisms of PMKS+ (docs/fixture-urls.md), MIT: the plates whose cut-outs run into each other
    "slotted tool": (
        "2v.Ay,1E8.A,0.1011.6A,A,0,0,0.0B,B,Fe,0,0.0C,C,d4,ec,0.4D,D,_W,0,0.4E,E,VG,7q,0.1F,F,bo,cO,0,BCX,B,X"
        ".0X,X,tU,151,0..YRAB,Input crank,Fe,Fe,7q,0,c5cae9,A,B,,.YRBCX,Tool carrier,Fe,Fe,ak,aY,303e9f,B,C,X"
        ",,.YRCD,Return rocker,Fe,Fe,oo,KJ,0d125a,C,D,,.YREF,Loaded output,Fe,Fe,YX,N6,B2DFDB,E,F,,..3F1,BCX,"
        "F1,d4,ec,PY,mQ,EfW.2F2,EF,F2,bo,cO,bo,Mm,OQW..N_c*2jYZFR",
        {"BCX"},
    ),
    "scissor lift": (
        "2v.Ay,Fe.5,0.1011.4A,A,2SG,0,0.0B,B,1fl,a3,0.hC,C,1wL,OD,0,AB,A,B.0D,D,17q,yH,0.4G,G,0,0,0.0M,M,1Vm,"
        "1GM,0.1K,K,2-X,2Wj,0,TU,T,U.5S,S,2-X,0,0.0T,T,0,2Wj,0.0U,U,3_1,2Wj,0..YRAB,AB,Fe,Fe,230,I2,c5cae9,A,"
        "B,,.YRCD,CD,Fe,Fe,1X5,gF,303e9f,C,D,,.YRGDMK,GDMK,Fe,Fe,1Pn,1BL,0d125a,G,D,M,K,,.YRSMT,SMT,Fe,Fe,1Vm"
        ",1GM,B2DFDB,S,M,T,,.YRTU,TU,Fe,Fe,1-0,2Wj,26A69A,T,U,,...N_n*4OPua2",
        {"ground", "TU"},
    ),
}


def inside(z, outline):
    """Whether a place lies in a closed line, by the turns of its places seen from there."""
    turns = [phase((b - z) / (a - z)) for a, b in zip(outline, outline[1:] + outline[:1], strict=True)]
    return abs(sum(turns)) > pi


@pytest.mark.parametrize("name", [*PLUS, *LINKAGES])
def test_plates_without_walls_between_cut_outs_are_named(name):
    """As drawn: a place of the edge of one cut-out lies in another one of the same layer."""
    ezdxf = pytest.importorskip("ezdxf")
    text, expected = PLUS.get(name, ("", set()))
    linkage = linkage_of_drawing(drawing_from_pmks(text, []), []) if text else LINKAGES[name]
    left_out = []
    document = ezdxf.read(io.StringIO(dxf_from_linkage(linkage, left_out)))
    found = set()
    for layer in {line.dxf.layer for line in document.modelspace().query("LWPOLYLINE")} - {"CURVES"}:
        circles = document.modelspace().query(f'CIRCLE[layer=="{layer}"]')
        cuts = [[complex(*c.dxf.center.vec2) + c.dxf.radius * rect(1, k / 10) for k in range(63)] for c in circles]
        _, *slots = document.modelspace().query(f'LWPOLYLINE[layer=="{layer}"]')
        cuts += [list(edge([tuple(corner) for corner in slot.get_points("xyb")])) for slot in slots]
        if any(inside(z, other) for one in cuts for other in cuts if one is not other for z in one):
            found.add(layer)
    said = {
        note.split("plate ")[1].split(":")[0] for note in map(str, left_out) if note.startswith("walls of the plate")
    }
    assert found == said == expected


@given(
    holes=st.lists(st.tuples(st.integers(0, 9), st.integers(0, 9)), max_size=3, unique=True),
    ends=st.lists(st.tuples(*[st.integers(0, 9)] * 4), max_size=2),
    hole=st.sampled_from([0.7, 1.3, 2.6]),
)
def test_cut_outs_run_into_each_other_where_their_middles_are_near(holes, ends, hole):
    """Against the distances of a hundred places on each; and what is united covers the same places."""
    slots = tuple((complex(a, b), complex(c, d)) for a, b, c, d in ends)
    places = tuple(complex(*each) for each in holes)
    cuts = cut_outs(Plate((*places, *(z for slot in slots for z in slot)), places, slots), hole)
    lines = [[z] for z in cuts.holes] + [[a + (b - a) * k / 200 for k in range(201)] for a, b in cuts.slots]
    near = min((abs(p - q) for k, one in enumerate(lines) for two in lines[:k] for p in one for q in two), default=99)
    assume(abs(near - hole) > 0.01)  # the places lie 0.06 apart at most
    assert bool(cuts.clashes) == (near < hole)
    for place in [*places, *(a + (b - a) * k / 10 for a, b in slots for k in range(11))]:
        assert min(abs(place - z) for line in lines for z in line) < 0.05


def test_what_is_one_is_cut_once():
    """Two pins at one place; both pins of a slide, whose ways on one line overlap; not slots with a wall between."""
    plate = Plate(
        (0j, 30 + 0j), (1 + 1j, 1 + 1.000000000001j), ((5 + 0j, 9 + 0j), (8 + 0j, 12 + 0j), (20 + 0j, 25 + 0j))
    )
    cuts = cut_outs(plate, 0.5)
    assert cuts.holes == (1 + 1j,)
    assert [tuple(sorted(slot, key=abs)) for slot in cuts.slots] == [(5, 12), (20, 25)]
    assert not cuts.clashes


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
