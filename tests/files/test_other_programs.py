"""Files of other programs: read, they move at once, and as there; written and read again, they are the same."""

import json
import re
from itertools import combinations
from math import atan2, cos, hypot, pi, sin
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gruebler.base.errors import GrueblerError
from gruebler.base.text import error_in_language
from gruebler.base.units import MILLIMETRES
from gruebler.files import values as files
from gruebler.files.drawing_linkages import linkage_of_drawing
from gruebler.files.four_bar_rs import drawing_from_ron, ron_from_drawing
from gruebler.files.linkage2 import drawing_from_linkage2, linkage2_from_drawing
from gruebler.files.linkage_drawings import drawing_of
from gruebler.files.linkages import read_loaded
from gruebler.files.motiongen import drawing_from_motiongen, motiongen_from_drawing
from gruebler.files.pin_drawings import DrawnDrive, DrawnJoint, PinDrawing
from gruebler.files.pmks import drawing_from_pmks, pmks_from_drawing
from gruebler.files.pylinkage import drawing_from_pylinkage, pylinkage_from_drawing
from gruebler.files.pyslvs import drawing_from_pyslvs, pyslvs_from_drawing
from gruebler.mechanics.analysis import measures
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.linkages import Linkage, Wheel
from gruebler.structure.chain import Chain
from gruebler.structure.mechanism import Mechanism

FOLDER = Path(__file__).parent / "samples"
REAL = sorted(path for path in FOLDER.iterdir() if path.suffix != ".md")

TEXTS = {
    "linkage2": (drawing_from_linkage2, linkage2_from_drawing),
    "pyslvs": (drawing_from_pyslvs, pyslvs_from_drawing),
    "pmks": (drawing_from_pmks, pmks_from_drawing),
    "motiongen": (drawing_from_motiongen, motiongen_from_drawing),
    "pylinkage": (drawing_from_pylinkage, pylinkage_from_drawing),
    "four-bar-rs": (drawing_from_ron, ron_from_drawing),
}


def again(linkage, program, left_out=None):
    """A linkage after a round trip, its lengths in the unit that it had."""
    read, write = TEXTS[program]
    other = linkage_of_drawing(read(write(drawing_of(linkage, []), [] if left_out is None else left_out), []), [])
    return other.scaled(MILLIMETRES[other.unit] / MILLIMETRES[linkage.unit])


def start(linkage):
    """The drive values of the reference pose."""
    pose = linkage.reference_pose
    values = []
    for k, drive in enumerate(linkage.mechanism.drives):
        one, other = linkage.reference(k)
        if drive.turning:
            values.append(pose[other].angle - pose[one].angle)
            continue
        line, block = linkage.element(drive.joint, one), linkage.element(drive.joint, other)
        (x, y), (to_x, to_y) = pose[one].put(line.x, line.y), pose[other].put(block.x, block.y)
        turn = pose[one].angle + line.angle
        values.append((to_x - x) * cos(turn) + (to_y - y) * sin(turn))
    return np.array(values)


def size(linkage):
    places = np.array([(joint.x, joint.y) for joint in drawing_of(linkage, []).joints])
    return float(np.ptp(places, axis=0).max())


def moved(linkage, step):
    """The places of all joints after a step of the drives from the drawn position; None if it cannot be done."""
    motion = move(linkage, start(linkage) + np.array(step))
    if not motion.complete:
        return None
    drawing = drawing_of(linkage.with_reference_pose(motion.pose()), [])
    return np.array([(joint.x, joint.y) for joint in drawing.joints if len(joint.links) > 1])


def gap(one, other):
    """The largest distance of a place from the nearest one of the others, both ways."""
    distances = np.hypot(*(one[:, None] - other[None]).transpose(2, 0, 1))
    return max(distances.min(axis=0).max(), distances.min(axis=1).max())


def steps(linkage, part):
    """A step of each drive: so many radians, or this part of the size."""
    return np.array([part if drive.turning else part * size(linkage) for drive in linkage.mechanism.drives])


def assert_same(linkage, other, tolerance):
    """The same mechanism, drawn in the same place, that moves alike."""
    assert other.mechanism.code() == linkage.mechanism.code()
    for part in (0.0, 0.01, -0.02):
        step = steps(linkage, part)
        one = moved(linkage, step)
        if one is not None:  # slides may be counted in the other sense
            gaps = [gap(one, each) for each in (moved(other, step), moved(other, -step)) if each is not None]
            assert min(gaps) <= tolerance * size(linkage)


# --- files as they are found -------------------------------------------------------------------------


def test_there_are_twenty_files_at_least():
    assert len(REAL) >= 20


@pytest.mark.parametrize("path", REAL, ids=lambda path: path.name)
def test_files_of_other_programs_move_at_once(path):
    left_out = []
    linkage = files.read(path, left_out=left_out)
    assert isinstance(linkage, Linkage)
    assert linkage.mechanism.drives
    motion = move(linkage, start(linkage)[None, :] + np.zeros((2, 1)))
    assert motion.complete
    assert motion.closure_error < 1e-12
    for link, pose in linkage.reference_pose.items():  # the drawn position is the solved one
        np.testing.assert_allclose(motion.pose()[link][:2], pose[:2], atol=1e-6 * size(linkage))
    assert any(moved(linkage, steps(linkage, part)) is not None for part in (0.01, -0.01))
    assert all(str(note) and note.in_language("de") for note in left_out)


# A pin of the frame in the slot of another link; two drives at one joint, cylinders and driven blocks, which other
# programs do not have.
SLOTS_OF_LINKS = {"motiongen-prpr.json", "two-sliders.linkage2"}
DRIVES_LEFT_OUT = {
    "linkage2": {"arm.pyslvs", "cylinder-driven-boom.pmks", "motiongen-prpr.json"},
    "pmks": {"arm.pyslvs"},
}


@pytest.mark.parametrize("program", ["linkage2", "pyslvs", "motiongen", "pmks"])
@pytest.mark.parametrize("path", REAL, ids=lambda path: path.name)
def test_files_survive_other_programs(path, program):
    linkage = files.read(path, left_out=[])
    left_out = []
    if program == "pmks" and path.name in SLOTS_OF_LINKS:
        with pytest.raises(GrueblerError, match="no pin of the frame in the slot"):
            again(linkage, program)
        return
    other = again(linkage, program, left_out)
    lost = any("drive" in str(note) for note in left_out)
    assert lost == (path.name in DRIVES_LEFT_OUT.get(program, ()))
    assert other.mechanism.chain.n == linkage.mechanism.chain.n
    if not lost:
        assert_same(linkage, other, 1e-9)


def test_jansens_leg_stands_where_pyslvs_has_it():
    """The program gives (-43.170055, -91.753226) for the foot with the crank at 0 (module/slove_test.py of a user)."""
    leg = files.read(FOLDER / "jansen.pyslvs", left_out=[])
    motion = move(leg, [[start(leg)[0]], [0.0]])
    np.testing.assert_allclose(motion.point("J7")[-1], (-43.170055, -91.753226), atol=2e-6)


def test_jansens_leg_moves_as_in_pylinkage():
    """The leg of the Linkage program, written for pylinkage: what pylinkage 1.3.0 gives for it after 0.1 and 0.4.

    In the numbers of the file, which are 1/96 inch.
    """
    leg = files.read(FOLDER / "jansen.linkage2", left_out=[])
    begin = start(leg)[0]
    motion = move(leg, [begin, begin + 0.1, begin + 0.4])
    foot = motion.point("6") * 96 / 25.4
    np.testing.assert_allclose(foot[1], (321.82946611867465, -387.2837883137836), atol=1e-6)
    np.testing.assert_allclose(foot[2], (304.15867758574126, -388.49504454939836), atol=1e-6)


def test_links_of_pylinkage_move_as_there():
    """Positions after one and three steps, as pylinkage 1.3.0 gives them."""
    step = 0.06283185307179587
    four_bar = files.read(FOLDER / "pylinkage-four-bar.json", left_out=[])
    rocker = move(four_bar, [0.0, step, 3 * step]).point("R(coupler-rocker)")
    np.testing.assert_allclose(rocker[1], (2.76290840715691, 2.4887321223070846), atol=1e-12)
    np.testing.assert_allclose(rocker[2], (2.895876434933332, 2.497830715480496), atol=1e-12)
    slider = files.read(FOLDER / "pylinkage-slider-crank.json", left_out=[])
    pin = next(name for name in slider.mechanism.chain.joint_names() if "rod" in name and "block" in name)
    np.testing.assert_allclose(
        move(slider, [0.0, step, 3 * step]).point(pin)[1:],
        [(-2.0013160913669648, 0), (-2.011855071029602, 0)],
        atol=1e-12,
    )


@pytest.mark.parametrize("name", ["jansen", "klann"])
def test_the_foot_of_a_leg_is_below(name):
    """The y axis of Linkage points upwards: both legs stand on their feet."""
    leg = files.read(FOLDER / f"{name}.linkage2", left_out=[])
    places = {joint.name: joint.y for joint in drawing_of(leg, []).joints}
    assert min(places, key=places.get) in leg.points


@pytest.mark.parametrize("name", ["yu1", "mkh1", "c-shape"])
def test_coupler_points_of_four_bar_rs(name):
    """The program's closed form, written down anew: point = A + l5 at g against the coupler."""
    values = dict(line.strip(" ,").split(": ") for line in (FOLDER / f"{name}.ron").read_text().splitlines()[1:-1])
    state = values.pop("stat")
    v = {key: float(value) for key, value in values.items()}
    linkage = files.read(FOLDER / f"{name}.ron", left_out=[])
    begin = start(linkage)[0]
    angles = begin + np.linspace(-0.3, 0.3, 7)
    motion = move(linkage, angles)
    pivot = complex(v["p1x"], v["p1y"])
    pin = pivot + v["l2"] * np.exp(1j * angles)
    gap = pivot + v["l1"] * np.exp(1j * v["a"]) - pin
    along = (v["l3"] ** 2 - v["l4"] ** 2 + abs(gap) ** 2) / (2 * abs(gap))
    up = np.sqrt(v["l3"] ** 2 - along**2) * (1 if state.startswith("c1") else -1)
    coupler = gap / abs(gap) * (along + 1j * up)
    point = pin + v["l5"] * coupler / abs(coupler) * np.exp(1j * v["g"])
    np.testing.assert_allclose(motion.complex_point("P5"), point, atol=1e-12 * v["l1"])


def test_the_targets_of_a_published_four_bar_lie_near_its_curve():
    """Yu's 20 points, and the answer that four-bar-rs gives for them."""
    target = np.array([-27 + 1j, -11.571 - 11.642j, 3.857 - 24.285j, 20 - 30j, 29.2 - 20j, 15 + 10.6j, -10 + 19.6j])
    linkage = files.read(FOLDER / "yu1.ron", left_out=[])
    curve = move(linkage, start(linkage)[0] + np.linspace(0, 2 * pi, 2001)).complex_point("P5")
    assert max(np.abs(curve - point).min() for point in target) < 0.05 * np.ptp(curve.real)


# --- laws --------------------------------------------------------------------------------------------

number = st.floats(-100, 100).map(lambda value: round(value, 3))
spot = st.tuples(number, number)


def apart(*places):
    return all(hypot(a[0] - b[0], a[1] - b[1]) > 5 for k, a in enumerate(places) for b in places[:k])


def bent(a, b, c):
    """Whether three places are not nearly on a line."""
    first, second = complex(b[0] - a[0], b[1] - a[1]), complex(c[0] - a[0], c[1] - a[1])
    return abs((first.conjugate() * second).imag) > 0.02 * abs(first) * abs(second)


@st.composite
def linkages(draw, *, slides=True, moving_slots=True):
    """A drawn four-bar, a Jansen-like chain with a multiple joint, slider-cranks, inverted ones, a cylinder."""
    kinds = ["four-bar", "double"] + ["slider", "slide", "pushed"] * slides + ["inverted", "cylinder"] * moving_slots
    kind = draw(st.sampled_from(kinds))
    a, b, c, d, e, f = (draw(spot) for _ in range(6))
    assume(apart(a, b, c, d, e, f))
    angle = draw(st.floats(-1.5, 1.5).map(lambda value: round(value, 3)))
    pins = [DrawnJoint("a", *a, ("0", "1")), DrawnJoint("b", *b, ("1", "2"))]
    drive = DrawnDrive("a", "0", "1")
    match kind:
        case "four-bar":
            pins += [DrawnJoint("c", *c, ("2", "3")), DrawnJoint("d", *d, ("0", "3")), DrawnJoint("pen", *e, ("2",))]
        case "double":
            pins[1] = DrawnJoint("b", *b, ("1", "2", "4"))
            pins += [DrawnJoint("c", *c, ("2", "3")), DrawnJoint("d", *d, ("0", "3", "5"))]
            pins += [DrawnJoint("e", *e, ("4", "5")), DrawnJoint("pen", *f, ("5",))]
        case "slider":
            pins += [DrawnJoint("c", *c, ("0", "2"), slot=angle)]
        case "slide":
            pins += [DrawnJoint("c", *c, ("2", "3")), DrawnJoint("d", *d, ("0", "3"), slot=angle, turns=False)]
            pins += [DrawnJoint("pen", *e, ("3",))]
        case "pushed":
            pins = [DrawnJoint("a", *a, ("0", "1"), slot=angle, turns=False), DrawnJoint("b", *b, ("1", "2"))]
            pins += [DrawnJoint("c", *c, ("2", "3")), DrawnJoint("d", *d, ("0", "3"))]
        case "inverted":
            turn = atan2(b[1] - d[1], b[0] - d[0])
            pins[1:] = [DrawnJoint("b", *b, ("3", "1"), slot=turn), DrawnJoint("d", *d, ("0", "3"))]
        case "cylinder":
            turn = atan2(b[1] - d[1], b[0] - d[0])
            pins = [
                DrawnJoint("a", *a, ("0", "1")),
                DrawnJoint("d", *d, ("0", "3")),
                DrawnJoint("b", *b, ("3", "1"), slot=turn),
            ]
            drive = DrawnDrive("b", "3", "1")
    assume(all(bent(*three) for three in combinations((a, b, c, d, e), 3)))  # else assembly modes may meet
    linkage = linkage_of_drawing(PinDrawing(frame="0", joints=tuple(pins), drives=(drive,)), [])
    assume(all(moved(linkage, steps(linkage, part)) is not None for part in (0.0, 0.01, -0.02)))
    return linkage


@settings(deadline=None, max_examples=25)
@given(linkage=linkages(), program=st.sampled_from(["linkage2", "pyslvs", "motiongen", "pmks"]))
def test_what_is_written_is_read_back(linkage, program):
    left_out = []
    other = again(linkage, program, left_out)
    assume(not left_out)  # linkage2 has no drive of a slide on the frame
    assert_same(linkage, other, 1e-8)


@settings(deadline=None, max_examples=15)
@given(linkage=linkages(moving_slots=False))
def test_what_is_written_for_pylinkage_is_read_back(linkage):
    try:
        other = again(linkage, "pylinkage")
    except GrueblerError as error:
        refused = "pins in slots of the frame" in str(error)
        assert refused
        assert any(joint.slot is not None for joint in drawing_of(linkage, []).joints)
        return
    assert_same(linkage, other, 1e-8)


@settings(deadline=None, max_examples=15)
@given(
    lengths=st.tuples(*[st.floats(1, 10)] * 4),
    turn=st.floats(-3, 3),
    point=st.tuples(st.floats(-9, 9), st.floats(1, 9)),
)
def test_four_bars_are_read_back(lengths, turn, point):
    a, b, c, d = lengths
    assume(2 * max(lengths) < 0.98 * sum(lengths))
    linkage = FourBar(a, b, c, d).linkage({"K": point})
    try:
        drawing = drawing_of(linkage, [])
    except GrueblerError:
        assume(False)
    del turn
    other = again(linkage, "four-bar-rs")
    for link, joints in (
        ("crank", ("R(frame-crank)", "R(crank-coupler)")),
        ("rocker", ("R(coupler-rocker)", "R(frame-rocker)")),
    ):
        assert other.length(link, *joints) == pytest.approx(linkage.length(link, *joints), rel=1e-9)
    pen = {joint.name: (joint.x, joint.y) for joint in drawing.joints}["K"]
    begin = next(drive for drive in np.arange(0, 2 * pi, 2 * pi / 72) if move(linkage, [drive]).complete)
    at = move(other, [start(other)[0], start(other)[0] + (begin - start(other)[0] + pi) % (2 * pi) - pi])
    if at.complete:
        np.testing.assert_allclose(at.point("P5")[-1], pen, atol=1e-6 * sum(lengths))


@pytest.mark.parametrize(
    "lengths",
    [FourBar(25, 70, 40, 70), SliderCrank(25, 70), SliderCrank(25, 70, 10)],
    ids=repr,
)
@pytest.mark.parametrize("suffix", [".linkage2", ".pyslvs", ".pmks"])
def test_usual_linkages_go_through_files(lengths, suffix, tmp_path):
    left_out = []
    path = files.write(lengths, tmp_path / f"a{suffix}", left_out=left_out)
    read = files.read(path, left_out=[])
    assert read.mechanism.chain.n == lengths.linkage().mechanism.chain.n
    assert len(read.mechanism.drives) == 1


def test_blanks_between_attributes_of_linkage2_may_be_missing(tmp_path):
    """As in two examples of the program itself (examples_xml.h): ``zoom="1"xoffset="3"``, ``layer="16"x="4"``.

    What stands within quotation marks stays as it is.
    """
    text = (FOLDER / "four-bar.linkage2").read_text()
    tight = re.sub(r'" (?=[a-z]+=)', '"', text)
    assert tight.count('"x="') == 2
    assert tight.count('"rpm="') == 1
    for name, content in {
        "a": tight,
        "b": tight.replace('"', "'"),
        "c": text.replace('id="1"', """id="1" name='u="x"y="z"'""", 1),
    }.items():
        (tmp_path / f"{name}.linkage2").write_text(content, encoding="utf-8")
    one, two, three, four = (
        files.read(path, left_out=[])
        for path in (FOLDER / "four-bar.linkage2", *(tmp_path / f"{name}.linkage2" for name in "abc"))
    )
    assert one == two == three
    assert four.reference_pose == one.reference_pose
    drawing = drawing_from_linkage2((tmp_path / "c.linkage2").read_text(), [])
    assert 'u="x"y="z"' in {joint.name for joint in drawing.joints}


def test_what_is_left_out_is_said(tmp_path):
    path = tmp_path / "a.pyslvs"
    with pytest.warns(files.FormatWarning, match="not written: .*the unit of the numbers, which are mm"):
        files.write(FourBar(25, 70, 40, 70).linkage(unit="cm"), path)
    notes = files.convert(FOLDER / "klann.linkage2", tmp_path / "klann.graphml")
    assert [str(note) for note in notes] == ["dimensions, frame and drives", "the speed of the drive"]


def test_wheels_and_cams_are_refused(tmp_path):
    chain = Chain([("revolute", ["0", "1"]), ("revolute", ["0", "2"]), ("rolling", ["1", "2"])])
    wheels = {"1": Wheel(0, 0, 1), "2": Wheel(3, 0, 2)}
    linkage = Linkage.from_drawing(Mechanism(chain, "0", [0]), {0: (0, 0), 1: (3, 0), 2: wheels})
    with pytest.raises(GrueblerError, match="turning and sliding joints only"):
        files.write(linkage, tmp_path / "a.pyslvs")


# --- drives ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("driven", ["A", "M"])
def test_two_blocks_on_one_rail_are_a_driven_slide(driven):
    """The gripper of PMKS+ without its redundancy (fixture-urls.md): one block more, the other one driven.

    The rod BG is as long as G and B are apart, the jaw turns about F: the carriage goes as far as B is reached,
    which is twice √((BG + FG)² - h²) where B runs at the height h below F.
    """
    flags = {"A": "5", "M": "5"} | {driven: "7"}
    body = (
        f"2v.Ay,1E8.5,0.1011.{flags['A']}A,A,0U5,0,0.{flags['M']}M,M,DZ,0,0.0B,B,0Hj,Fj,0.0C,C,0Hj,0FZ,0.4F,F,0V6,X9,0."
        "0G,G,A,X9,0.0K,K,_o,GS,0.4H,H,0V6,0X0,0.0I,I,A,0X0,0.0J,J,_d,0Bn,0..YRAMBC,AMBC,Fe,Fe,0C-,2,c5cae9,A,M,B,C,,."
        "YRBG,BG,Fe,Fe,08o,OR,303e9f,B,G,,.YRCI,CI,Fe,Fe,08o,0OH,0d125a,C,I,,.YRFGK,FGK,Fe,Fe,Ae,Rb,B2DFDB,F,G,K,,."
        "YRHIJ,HIJ,Fe,Fe,Aa,0Px,26A69A,H,I,J,,...N_"
    )
    digits = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
    left_out = []
    gripper = linkage_of_drawing(drawing_from_pmks(body + digits[len(body) % 62], left_out), left_out)
    assert not any("drive" in str(note) for note in left_out)
    assert gripper.mechanism.drive_names() == ("P(ground-AMBC)",)
    (b, g, f), h = ((-1.133, 1.005), (0.010, 2.121), (-1.990, 2.121)), 1.116
    way = 2 * np.sqrt((np.hypot(g[0] - b[0], g[1] - b[1]) + np.hypot(g[0] - f[0], g[1] - f[1])) ** 2 - h**2)
    assert measures(gripper).span.width == pytest.approx(way, rel=1e-6)


def test_a_ram_that_only_pushes_one_link_is_no_mechanism():
    """The hydraulic crosshead of PMKS+: barrel and frame are welded, rod and platen too; two links are what is left."""
    body = (
        "2v.Ay,Fe.5,0.1011.CA,A,0,0,0.0N,N,vD,0,0.hS,S,aZ,0,0,ANG,A,N.8B,B,1Tm,0,0.4G,G,0,0VG,0.0C,C,1Tm,S8,0"
        ".0D,D,1Tm,0S8,0..YRANG,Fixed frame,Fe,Fe,J4,0AR,0d125a,A,N,G,,AN,AG.YRSBCD,Press crosshead,Fe,Fe,1FT"
        ",0,00695C,S,B,C,D,,SB,BCD.NRAN,AN,Fe,Fe,Sd,0,c5cae9,A,N,,.NRAG,AG,Fe,Fe,0,0Fe,303e9f,A,G,,.NRSB,SB,F"
        "e,Fe,119,0,B2DFDB,S,B,,.NRBCD,BCD,Fe,Fe,1Tm,0,26A69A,B,C,D,,...N_t*1Tb9pN"
    )
    with pytest.raises(GrueblerError, match="at least three links, and here are only ground, SBCD"):
        linkage_of_drawing(drawing_from_pmks(body, []), [])


@pytest.mark.parametrize("program", ["pyslvs", "motiongen", "pmks"])
def test_a_driven_slide_survives(program):
    joints = (
        DrawnJoint(name="a", x=0.0, y=0.0, links=("0", "1"), slot=0.25, turns=False),
        DrawnJoint(name="b", x=1.0, y=0.5, links=("1", "2")),
        DrawnJoint(name="c", x=4.0, y=3.5, links=("2", "3")),
        DrawnJoint(name="d", x=7.0, y=0.0, links=("0", "3")),
    )
    linkage = linkage_of_drawing(PinDrawing(frame="0", joints=joints, drives=(DrawnDrive("a", "0", "1"),)), [])
    left_out = []
    assert_same(linkage, again(linkage, program, left_out), 1e-9)
    assert not any("drive" in str(note) for note in left_out)


# --- files that do not fit ---------------------------------------------------------------------------

BOMB = (
    '<!DOCTYPE l [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;">]><linkage2><connector id="&b;"/></linkage2>'
)
HOSTILE = {
    "a.linkage2": [
        ("", "is empty"),
        ("<linkage2>", "is not XML"),
        ("<linkage>", "is not XML"),
        ("<other/>", "expected the element <linkage2>"),
        (BOMB, "DOCTYPE"),
        ('<!DOCTYPE l SYSTEM "file:///etc/passwd"><linkage2/>', "DOCTYPE"),
        ("<linkage2>" + "<a>" * 500 + "</a>" * 500 + "</linkage2>", "nested too deeply"),
        ('<linkage2><connector id="1" x="nan" y="0"/></linkage2>', "expected a number, but found 'nan'"),
        ('<linkage2><connector id="1" x="1e999" y="0"/></linkage2>', "expected a number"),
        ('<linkage2><connector id="1" x="0" y="0"/><connector id="1" x="0" y="0"/></linkage2>', "two connectors"),
        ('<linkage2><connector id="1" slider="true" anchor="true" x="0" y="0"/></linkage2>', "needs two limits"),
        ('<linkage2><Link id="1" gear="true"/></linkage2>', "gears are not read"),
        ("<linkage2/>", "no mechanism on the frame"),
        (b"\xff\xfe\x00", "is not"),
        ("é".encode("latin-1"), "is not UTF-8"),
    ],
    "a.pyslvs": [
        ("M[", "expected 'J', but found ''"),
        ("M[J[R, P[0, nan], L[a]]]", "expected a number, but found 'nan'"),
        ("M[J[X, P[0, 0], L[a]]]", "expected the joint type R, P or RP"),
        ("M[J[R, P[0, 0], L[a, a]]]", "names a link twice"),
        ("M[J[R, P[0, 0], L[ground, a]]", "found ''"),
        ("M[]", "no mechanism on the frame"),
        ("M[" + "J[R, P[0, 0], L[a]]," * 4000 + "]", "more than 600"),
        ("M[] x", "expected the end"),
    ],
    "a.pmks": [
        ("https://app.pmksplus.com/?", "check character"),
        (
            "2v.Ay,1E8.5,0.1011.6A,A,0,VG,0.0B,B,Fe,VG,0.5C,C,oa,0,0..YRAB,AB,Fe,Fe,7q,VG,c5cae9,A,B,,...N_3*000000",
            "digest",
        ),
        ("a\nb", "one line"),
        ("j=A,0,0,AB,R,t,0,0.1", "expected nine values"),
        ("j=A,inf,0,AB,R,t,0,0.1,t", "expected a number"),
        ("j=A,0,0,AB,R,t,0,0.1,t&l=AB,1,1,0,0,A|B,", "which is not there"),
    ],
    "a.ron": [
        ("(l1: 1, l2: 1, l3: 1)", "'l4' is missing"),
        ("(l1: 1, l2: 1, l3: 1, l4: nan)", "expected a number"),
        ("(l1: 1, l2: 1, l3: 1, l4: 9)", "close in no position"),
        ("(l1: 1, l2: 1, l3: 1, l4: -1)", "positive length"),
        ("(l1: 1, l1: 1)", "twice"),
        ("(l1: 1, x: 2, l3: 1, l4: 1)", "unknown key 'x'"),
        ("l1: 1", "expected (p1x"),
    ],
    "a.json": [
        ('{"B": [], "p": [[0, 0]]}', "rows of 0 and 1"),
        ('{"B": [[2]], "p": [[0, 0]]}', "rows of 0 and 1"),
        ('{"B": [[1]], "p": [[0, 0]], "S": [[0, 7, 0, 0]]}', "is not there"),
        ('{"B": [[1]], "p": [["a", 0]]}', "not a mechanism of MotionGen"),
        ('{"solutions": []}', "at least one"),
        ('{"joints": [{"type": "Crank"}]}', "expected a name"),
        ('{"joints": [{"type": "Revolute", "name": "a", "joint0": {"ref": "a"}}]}', "is missing"),
        ('{"joints": [{"type": "ground", "id": "a", "position": [0]}], "links": []}', "position [x, y]"),
        ('{"joints": [{"type": "ground", "id": "a", "position": [0, true]}], "links": []}', "expected a number"),
        ("[" * 100_000, "is nested too deeply"),
        ('{"B": [[NaN]]}', "NaN is not a number"),
    ],
}


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [(name, content, words) for name, cases in HOSTILE.items() for content, words in cases],
    ids=lambda value: str(value)[:40],
)
def test_what_does_not_fit_is_one_sentence(name, content, words, tmp_path):
    path = tmp_path / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(GrueblerError) as caught:
        files.read(path, left_out=[])
    text = str(caught.value)
    assert words in text
    assert str(path) in text
    assert "\n" not in text
    assert error_in_language(caught.value, "de")


@pytest.mark.parametrize("form", [form for form in files.FORMATS if form.read is not None], ids=lambda form: form.name)
def test_a_file_of_a_hundred_megabytes_is_refused_unread(form, tmp_path):
    path = tmp_path / f"a{next(iter(form.suffixes), '.json')}"
    with path.open("wb") as file:
        file.write(b"<a>")
        file.seek(100_000_000)
        file.write(b"x")  # a hole: the disk holds two blocks
    with pytest.raises(GrueblerError) as caught:
        files.read(path, format_name=form.name)
    assert str(path) in str(caught.value)
    assert len(str(caught.value)) < 700


@pytest.mark.parametrize("path", REAL, ids=lambda path: path.name)
def test_a_file_that_is_cut_off_is_refused(path, tmp_path):
    whole = path.read_bytes()
    joint_by_joint = path.name == "six-bar-version-1.pmks"  # an address: what is left of it is one, too
    for part in (0.2, 0.5) if joint_by_joint else (0.2, 0.5, 0.9, 0.99):
        cut = tmp_path / path.name
        cut.write_bytes(whole[: int(len(whole) * part)])
        with pytest.raises(GrueblerError) as caught:
            files.read(cut, left_out=[])
        assert str(cut) in str(caught.value)


def test_links_that_are_welded_in_a_ring_are_one():
    ring = [DrawnJoint(name=f"j{k}", x=cos(k), y=sin(k), links=(f"l{k}", f"l{(k + 1) % 5}")) for k in range(5)]
    with pytest.raises(GrueblerError, match="no mechanism on the frame"):
        linkage_of_drawing(
            PinDrawing(
                frame="l0", joints=tuple(ring), drives=(), rigid=tuple((f"l{k}", f"l{(k + 1) % 5}") for k in range(5))
            ),
            [],
        )


def test_json_of_others_is_named_by_its_format(tmp_path):
    path = tmp_path / "leg.json"
    files.write(FourBar(25, 70, 40, 70), path, format_name="pylinkage", left_out=[])
    assert json.loads(path.read_text())["ground"] == "frame"
    assert files.read(path, left_out=[]).length("crank", 0, 1) == pytest.approx(25)


def test_curves_of_four_bar_rs_are_tasks(tmp_path):
    """Bulatovic's points of 2016, and the first poses of Hsieh 2017, as four-bar-rs has them."""
    path = tmp_path / "mkh1.closed.csv"
    path.write_text("# a source\n0.5,1.1\n0.4,1.1\n0,0.5\n0.03,.3\n.6,1.\n", encoding="utf-8")
    task = files.read(path)
    assert task.closed
    assert task.points == ((0.5, 1.1), (0.4, 1.1), (0, 0.5), (0.03, 0.3), (0.6, 1.0))
    path = tmp_path / "hsieh1.open.csv"
    path.write_text("18.8,12.1,0.62161,-0.783327\n13.3,18.1,1.0,0.0\n6.3,19.8,0.764842,0.644218\n", encoding="utf-8")
    assert [round(angle, 3) for _, _, angle in files.read(path).positions] == [-0.9, 0.0, 0.7]
    path.write_text("1,2\n3\n", encoding="utf-8")
    with pytest.raises(GrueblerError, match="csv: expected rows of two or four numbers"):
        files.read(path)
    path.write_text("1,2\n3,nan\n", encoding="utf-8")
    with pytest.raises(GrueblerError, match="csv: coordinate: expected a number"):
        files.read(path)


def test_masses_and_the_speed_come_with_an_address(tmp_path):
    """The punch press, read off its address by hand, in base 64: 10/min (A), clockwise (2v is odd); crank 2 g (VG),
    0.05 kg cm² (o), centre (0, 0.6 cm) (9O); rod 3 g (ku), 0.4 kg cm² (6G), centre (0, -1.1 cm) (0HC)."""
    notes = files.convert(FOLDER / "punch-press.pmks", tmp_path / "press.toml")
    assert [str(note) for note in notes] == ["colours", "the sense of rotation of the drive"]
    linkage, loads, speed = read_loaded(tmp_path / "press.toml")
    assert speed == pytest.approx(10 * 2 * pi / 60, rel=1e-12)
    found = {link: (body.mass, body.inertia) for link, body in loads.bodies.items()}
    assert found == {"AB": (0.002, pytest.approx(0.05)), "BC": (0.003, pytest.approx(0.4))}
    for link, centre in {"AB": (0, 0.6), "BC": (0, -1.1)}.items():
        assert linkage.reference_pose[link].put(*loads.bodies[link].centre) == pytest.approx(centre, abs=1e-12)


@pytest.mark.parametrize(
    ("flags", "unit", "newtons"), [(2, "1", 400.0), (3, "1", 400.0), (3, "0", 400.0 * 4.4482216152605)]
)
def test_forces_come_with_an_address(flags, unit, newtons, tmp_path):
    """The punch press has 400 (1Xg0) in N, of inches in lbf, on its rod from (0, -3.4) (0r8) to (0, -2.4) (0bW); with
    bit 1 the force turns with the rod."""
    digits = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
    text = (FOLDER / "punch-press.pmks").read_text().partition("*")[0][:-1]
    assert text.count(".2F1,BC,") == text.count(".1011.") == 1
    body = text.replace(".2F1,BC,", f".{flags}F1,BC,").replace(".1011.", f".{unit}011.")
    (tmp_path / "a.pmks").write_text(body + digits[len(body) % 62])
    files.convert(tmp_path / "a.pmks", tmp_path / "a.toml")
    linkage, loads, _ = read_loaded(tmp_path / "a.toml")
    ((point, force),) = loads.forces.items()
    link, _, place = point.partition(":")
    pose = linkage.reference_pose[link]
    assert link == "BC"
    assert pose.put(*map(float, place.split(","))) == pytest.approx((0, -3.4), abs=1e-9)
    for turn in (0.0, 0.7):
        state = SimpleNamespace(angle=np.array([pose.angle + turn]))
        found = [part(state)[0] for part in force] if flags & 1 else force
        turned = turn * (flags & 1)
        assert found == pytest.approx((-newtons * sin(turned), newtons * cos(turned)), abs=1e-9 * newtons)


def test_forces_towards_where_they_act_are_left_out(tmp_path):
    """An arrow whose tip lies at the link (bit 2 is missing), one on no link, one without length."""
    digits = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
    text = (FOLDER / "punch-press.pmks").read_text().partition("*")[0][:-1]
    body = text.replace(".2F1,", ".2F4,XY,F4,0,0,0,Fe,Fe.2F3,BC,F3,0,0,0,0,Fe.0F1,")
    left_out = []
    assert "forces" not in drawing_from_pmks(body + digits[len(body) % 62], left_out).loads
    assert {"forces F4, F3", "forces F1: whether they push or pull is not known"} <= set(map(str, left_out))


@pytest.mark.parametrize(
    ("name", "rate"),
    [("cylinder-driven-boom.pmks", 1.0), ("klann.linkage2", pi / 2), ("two-sliders.linkage2", None)],
)
def test_a_speed_is_that_of_the_only_drive(name, rate, tmp_path):
    """A cylinder at 1 cm/s (Fe), a crank at 15 rpm; of two inputs each has its own, which is said."""
    notes = files.convert(FOLDER / name, tmp_path / "a.toml")
    assert read_loaded(tmp_path / "a.toml")[2] == (rate if rate is None else pytest.approx(rate, rel=1e-12))
    assert ("speeds of drives: 15, 15.7 rpm" in map(str, notes)) == (rate is None)
