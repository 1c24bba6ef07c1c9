"""A length has the same true size on both sides of every file, whatever unit the numbers of the format are in.

Round trips hide a factor that is wrong both ways. So files as the other programs write them, of which the sizes are
known, are read; and what is written is read by a plain parser that knows only the unit of the format:

- linkage2: 1/96 inch. Linkage: linkageDoc.h, GetBaseUnitsPerInch() is 96; linkageDoc.cpp, SetUnits, shows 25.4/96 mm or
  1/96 in (24.5/96 by a slip that a later version mends); a name that is not known is millimetres.
- pmks: in, cm or m. PMKS+: model/utils.ts, LengthUnit has INCH 0, CM 1, METER 2; the first of the enumerated settings.
- PMKS-Refactor: no unit; its state.service.ts starts with cm.
- pyslvs, motiongen, four-bar-rs, pylinkage: no unit (grammar and SolveSpace export; BSIdict_468.json; mech; the
  serialization modules). Millimetres by this library's choice, both ways, and said.
- dxf: $INSUNITS, in the DXF reference of Autodesk 1 in, 2 ft, 4 mm, 5 cm, 6 m, 14 dm.
- mjcf, urdf: metres. MuJoCo names no unit, its default gravity is 9.81; ROS REP 103.
"""

import json
import re
from math import hypot
from xml.etree import ElementTree

import pytest

from gruebler.base.errors import GrueblerError
from gruebler.files import values as files
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.linkages import Linkage

MM = {"mm": 1.0, "cm": 10.0, "dm": 100.0, "m": 1000.0, "in": 25.4, "ft": 304.8}

# --- files of the other programs with known sizes --------------------------------------------------------

LINKAGE2 = """<linkage2>
	<program zoom="1" xoffset="0" yoffset="0" scalefactor="1" {units}/>
	<connector anchor="true" input="true" rpm="15" x="0" y="0" id="0"/>
	<connector x="{a}" y="0" id="1"/>
	<connector x="{c}" y="{b}" id="2"/>
	<connector anchor="true" x="{c}" y="0" id="3"/>
	<Link id="4" name="crank"><connector id="0"/><connector id="1"/></Link>
	<Link id="5" name="rod"><connector id="1"/><connector id="2"/></Link>
	<Link id="6" name="rocker"><connector id="2"/><connector id="3"/></Link>
</linkage2>
"""
MILLIMETRES = {
    "a": 37.795276,
    "b": 132.283465,
    "c": 188.976378,
}  # a drawing of 10, 35 and 50 mm, as the program saved it
INCHES = {"a": 96, "b": 144, "c": 480}  # 1, 1.5 and 5 in
PMKS = (
    "2v.Ay,1E8.5,0.{unit}011.6A,A,0,0,0.0B,B,Fe,0,0.0C,C,1E8,S8,0.4D,D,1E8,0,0..YRAB,AB,Fe,Fe,0,0,c5cae9,A,B,,."
    "YRBC,BC,Fe,Fe,0,0,c5cae9,B,C,,.YRCD,CD,Fe,Fe,0,0,c5cae9,C,D,,...N_"
)
DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"
VERSION_1 = (
    "j=A,0,0,AB,R,t,0,0.1,t,%0AB,1,0,AB%7CBC,R,f,0,0.1,f,%0AC,5,1.5,BC%7CCD,R,f,0,0.1,f,%0AD,5,0,CD,R,t,0,0.1,f,%0A"
    "&l=AB,1,1,0,0,A%7CB,%0ABC,1,1,0,0,B%7CC,%0ACD,1,1,0,0,C%7CD,%0A&s=10,false,false,{unit}"
)


def pmks(unit):
    """An address of lengths 1 (Fe: 15 * 64 + 40 thousandths), 1.8 (S8) and 5 (1E8), and the check of its length."""
    text = PMKS.format(unit=unit)
    return text + DIGITS[len(text) % 62]


WITHOUT_UNIT = {
    "a.pyslvs": "M[J[R, P[0, 0], L[ground, crank]], J[R, P[1, 0], L[crank, rod]], J[R, P[5, 1.5], L[rod, rocker]], "
    "J[R, P[5, 0], L[ground, rocker]]]",
    "a.ron": "(l1: 5.0, l2: 1.0, l3: 4.272001872658765, l4: 1.5, stat: c1b1)",
    "motiongen.json": json.dumps(
        {
            "B": [[1, 0, 0, 1], [1, 1, 0, 0], [0, 1, 1, 0], [0, 0, 1, 1]],
            "S": [],
            "I": [[3, 0, 1, 0]],
            "p": [[0, 0], [1, 0], [5, 1.5], [5, 0]],
            "c": [0, 0, 0, 0],
        }
    ),
    "pylinkage.json": json.dumps(
        {
            "joints": [
                {"id": "A", "type": "ground", "position": [0, 0]},
                {"id": "B", "type": "revolute", "position": [1, 0]},
                {"id": "C", "type": "revolute", "position": [5, 1.5]},
                {"id": "D", "type": "ground", "position": [5, 0]},
            ],
            "links": [
                {"id": "crank", "type": "driver", "joints": ["A", "B"], "motor_joint": "A"},
                {"id": "rod", "type": "link", "joints": ["B", "C"]},
                {"id": "rocker", "type": "link", "joints": ["C", "D"]},
            ],
        }
    ),
}
MADE_ELSEWHERE = {  # name of the file: its text, the unit, crank, rocker and frame in it
    "mm.linkage2": (LINKAGE2.format(units='units="Millimeters"', **MILLIMETRES), "mm", (10, 35, 50)),
    "no-unit.linkage2": (LINKAGE2.format(units="", **MILLIMETRES), "mm", (10, 35, 50)),
    "in.linkage2": (LINKAGE2.format(units='units="Inches"', **INCHES), "in", (1, 1.5, 5)),
    "in.pmks": (pmks("0"), "in", (1, 1.8, 5)),
    "cm.pmks": (pmks("1"), "cm", (1, 1.8, 5)),
    "m.pmks": (pmks("2"), "m", (1, 1.8, 5)),
    "cm-1.pmks": (VERSION_1.format(unit="cm"), "cm", (1, 1.5, 5)),
    "in-1.pmks": (VERSION_1.format(unit="in"), "in", (1, 1.5, 5)),
    "m-1.pmks": (VERSION_1.format(unit="m"), "m", (1, 1.5, 5)),
} | {name: (text, "mm", (1, 1.5, 5)) for name, text in WITHOUT_UNIT.items()}


def sides(linkage):
    """Crank, rocker and frame of a four-bar whose crank is driven."""
    chain, frame = linkage.mechanism.chain, linkage.mechanism.frame
    (drive,) = linkage.mechanism.drives
    crank = next(link for link in chain.joints[drive.joint].links if link != frame)
    (rocker,) = {
        link for joint in chain.joints if frame in joint.links for link in joint.links if link not in (frame, crank)
    }
    return [
        linkage.length(link, *(k for k, joint in enumerate(chain.joints) if link in joint.links))
        for link in (crank, rocker, frame)
    ]


@pytest.mark.parametrize("name", MADE_ELSEWHERE)
def test_a_file_made_elsewhere_has_its_true_size(name, tmp_path):
    text, unit, lengths = MADE_ELSEWHERE[name]
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    left_out = []
    linkage = files.read(path, left_out=left_out)
    assert linkage.unit == unit
    assert sides(linkage) == pytest.approx(lengths, rel=2e-8)  # the program saves six decimals
    says = any("a unit, which the file does not have" in str(note) for note in left_out)
    assert says == (name in WITHOUT_UNIT)


def test_numbers_of_pmks_without_a_unit_are_said_to_be_cm(tmp_path):
    for text in (pmks("3"), VERSION_1.format(unit="")):
        (tmp_path / "a.pmks").write_text(text, encoding="utf-8")
        left_out = []
        linkage = files.read(tmp_path / "a.pmks", left_out=left_out)
        assert linkage.unit == "cm"
        assert sum("its numbers are taken for cm" in str(note) for note in left_out) == 1


# --- what is written, read by a plain parser --------------------------------------------------------------
# Each returns the length of the crank in millimetres: the distance of the two places that the file has of it.


def linkage2_crank(text):
    root = ElementTree.fromstring(text)
    at = {c.get("id"): (float(c.get("x")), float(c.get("y"))) for c in root.iterfind("connector")}
    (x, y), (u, v) = [at[each.get("id")] for each in root.find("Link[@name='crank']").iterfind("connector")]
    return hypot(x - u, y - v) / 96 * 25.4


def base_64(word):
    value = 0
    for letter in word.removeprefix("0") if len(word) > 1 else word:
        value = value * 64 + DIGITS.index(letter)
    return -value if word[0] == "0" else value


def pmks_crank(text):
    body = text.partition("?")[2].strip().rpartition("*")[0][:-1]
    parts = body.split(".")
    unit = {"0": "in", "1": "cm", "2": "m"}[parts[3][0]]
    at = {}
    for record in parts[4 : parts.index("", 4)]:
        number, _, x, y, _ = record[1:].split(",")[:5]
        at[number] = [base_64(x) / 1000, base_64(y) / 1000]
    for number, field, value in re.findall(r"PJ(\w+)~([01])~([^,]+)", body):
        at[number][int(field)] = float(value)
    (pins,) = [part.split(",") for part in parts if part[:1] == "Y" and part.split(",")[1] == "crank"]
    (x, y), (u, v) = at[pins[7]], at[pins[8]]
    return hypot(x - u, y - v) * MM[unit]


def pyslvs_crank(text):
    places = re.findall(r"P\[(\S+), (\S+)\], L\[[^]]*\bcrank\b", text)
    (x, y), (u, v) = [(float(a), float(b)) for a, b in places]
    return hypot(x - u, y - v)


def motiongen_crank(text):
    document = json.loads(text)
    arm, pivot, pin, _ = document["I"][0]
    (row,) = [row for row in document["B"] if row[pivot] and row[pin]]
    assert not row[arm]
    (x, y), (u, v) = document["p"][pivot], document["p"][pin]
    return hypot(x - u, y - v)


def pylinkage_crank(text):
    document = json.loads(text)
    at = {joint["id"]: joint["position"] for joint in document["joints"]}
    (pins,) = [link["joints"] for link in document["links"] if link["type"] == "driver"]
    (x, y), (u, v) = at[pins[0]], at[pins[1]]
    return hypot(x - u, y - v)


def ron_crank(text):
    return float(re.search(r"\bl2: ([^,]+),", text)[1])


def dxf_crank(text):
    lines = [line.strip() for line in text.splitlines()]
    pairs = list(zip(lines[::2], lines[1::2], strict=True))
    unit = {1: "in", 2: "ft", 4: "mm", 5: "cm", 6: "m", 14: "dm"}[int(pairs[pairs.index(("9", "$INSUNITS")) + 1][1])]
    holes = []
    for k in [k for k, pair in enumerate(pairs) if pair == ("0", "CIRCLE")]:
        end = next(j for j in range(k + 1, len(pairs)) if pairs[j][0] == "0")
        fields = dict(pairs[k:end])
        if fields["8"] == "crank":
            holes.append((float(fields["10"]), float(fields["20"])))
    (x, y), (u, v) = holes
    return hypot(x - u, y - v) * MM[unit]


def mjcf_crank(text):
    (bar,) = ElementTree.fromstring(text).findall(".//body[@name='crank']/geom")
    x, y, _, u, v, _ = map(float, bar.get("fromto").split())
    return hypot(x - u, y - v) * MM["m"]


def urdf_crank(text):
    """The coupler hangs on the crank: the origin of its joint in the crank's frame, which is at the pivot."""
    root = ElementTree.fromstring(text)
    (joint,) = [each for each in root.findall("joint") if each.find("parent").get("link") == "crank"]
    x, y, _ = map(float, joint.find("origin").get("xyz").split())
    return hypot(x, y) * MM["m"]


WRITTEN = {
    "linkage2": linkage2_crank,
    "pmks": pmks_crank,
    "pyslvs": pyslvs_crank,
    "motiongen": motiongen_crank,
    "pylinkage": pylinkage_crank,
    "four-bar-rs": ron_crank,
    "dxf": dxf_crank,
    "mjcf": mjcf_crank,
    "urdf": urdf_crank,
}


def test_every_format_of_a_linkage_has_its_parser():
    own = {"toml", "json"}  # the unit is a key of the file
    no_linkages = {"csv", "text", "graph6", "sparse6", "graphml", "gml", "dot", "edge-list", "matrix"}
    tables = {"spreadsheet", "parquet"}  # the unit is in the header of each column
    rest = {form.name for form in files.FORMATS} - own - no_linkages - tables - {"dxf-links"}  # dxf, in several files
    rest -= {"glb", "stl"}  # of linkages in space: test_gltf
    assert rest == set(WRITTEN)


@pytest.mark.parametrize("unit", MM)
@pytest.mark.parametrize("name", WRITTEN)
def test_what_is_written_has_its_true_size(name, unit, tmp_path):
    if name == "dxf":
        pytest.importorskip("ezdxf")
    path = files.write(FourBar(25, 70, 40, 70).linkage(unit=unit), tmp_path / "a", format_name=name, left_out=[])
    assert WRITTEN[name](path.read_text(encoding="utf-8")) == pytest.approx(25 * MM[unit], rel=1e-9)


@pytest.mark.parametrize("unit", MM)
@pytest.mark.parametrize("name", ["linkage2", "pmks", "pyslvs", "motiongen", "pylinkage", "four-bar-rs"])
def test_what_is_written_is_read_in_its_true_size(name, unit, tmp_path):
    path = files.write(FourBar(25, 70, 40, 70).linkage(unit=unit), tmp_path / "a.json", format_name=name, left_out=[])
    read = files.read(path, format_name=name, left_out=[])
    assert [length * MM[read.unit] for length in sides(read)] == pytest.approx([k * MM[unit] for k in (25, 40, 70)])


@pytest.mark.parametrize("name", WRITTEN)
def test_a_unit_that_nobody_knows_is_said(name, tmp_path):
    if name == "dxf":
        pytest.importorskip("ezdxf")
    left_out = []
    files.write(FourBar(25, 70, 40, 70).linkage(unit="furlong"), tmp_path / "a", format_name=name, left_out=left_out)
    assert any("furlong" in str(note) for note in left_out)


# --- the digits of PMKS+ ----------------------------------------------------------------------------------


def test_digits_behind_the_thousandths_are_read(tmp_path):
    """As the program writes them since it keeps exact values (precise-values.ts): J, id, number of the field."""
    body = pmks("1")[:-1] + ".PJB~0~1.0001234567,LJA,PJC~1~-1e-7,PLAB~0~1,PD~0~1,PJB~3~0.5"
    (tmp_path / "a.pmks").write_text(body + DIGITS[len(body) % 62], encoding="utf-8")
    left_out = []
    crank, rocker, frame = sides(files.read(tmp_path / "a.pmks", left_out=left_out))
    assert (crank, rocker, frame) == pytest.approx((1.0001234567, 1e-7, 5), rel=1e-12)
    assert "locks and notes of the drawing" in map(str, left_out)
    for wrong in ("PJX~0~1", "PJB~9~1", "PJB~0~nan", "PJB~0", "PX~0~1", "P"):
        body = f"{pmks('1')[:-1]}.{wrong}"
        (tmp_path / "a.pmks").write_text(body + DIGITS[len(body) % 62], encoding="utf-8")
        with pytest.raises(GrueblerError, match=r"exact number|expected a number"):
            files.read(tmp_path / "a.pmks", left_out=[])


@pytest.mark.parametrize(("x", "exact"), [(0.125, False), (1 / 3, True)])
def test_an_address_has_exact_numbers_only_where_it_needs_them(x, exact, tmp_path):
    """Thousandths hold an eighth but no third; without such records every version of the program opens the address."""
    places = {0: (0, 0), 1: (x, 1), 2: (5, 1.5), 3: (5, 0)}
    linkage = Linkage.from_drawing(FourBar(25, 70, 40, 70).linkage().mechanism, places, unit="cm")
    left_out = []
    path = files.write(linkage, tmp_path / "a.pmks", left_out=left_out)
    assert ("~" in path.read_text(encoding="utf-8")) == exact
    assert any("older versions of PMKS+" in str(note) for note in left_out) == exact
    assert sides(files.read(path, left_out=[])) == pytest.approx(sides(linkage), rel=1e-15)
