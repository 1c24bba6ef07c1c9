"""The machines: links, joints and F of each, printed lengths, and how the documents say that they move."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import acos, asin, degrees, radians, sqrt
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler.files import Entry
from gruebler.mechanics.analysis import drive_range, measures
from gruebler.mechanics.kinematics import Motion, move
from gruebler.structure.mobility import count_freedoms
from gruebler.teaching.catalog import check_entry, entry
from tests.documents import independent as own
from tests.documents.fact import Fact


class Structure(NamedTuple):
    """What is counted by hand on a machine."""

    id: str
    place: str
    n: int
    joints: dict[int, int]
    """Number of joints with each freedom, a joint of k links counted k - 1 times."""
    moves: int | None = None
    """The mobility that special dimensions give, where it is not the counted one (0 at least)."""
    printed: str = ""
    """F as the documents print it."""
    b: int = 3


# Counted by hand. Where the figure is lost, so is what could be counted there: the structure is that which
# the entry states as assumed.
STRUCTURES = (
    Structure("belt", "003, chapter 1", 3, {1: 2, 2: 1}),
    Structure("bennett", "not in the documents", 4, {1: 4}, 1, b=6),
    Structure("bolt_cutter", "not in the documents", 4, {1: 4}),
    Structure("cam", "figure 1.4", 3, {1: 2, 2: 1}),
    Structure("cam_rocker", "figure 1.4, variant", 4, {1: 3, 2: 1}),
    Structure("cam_rocker_flat", "figure 1.4, variant", 3, {1: 2, 2: 1}),
    Structure("cam_roller", "figure 1.4, variant", 4, {1: 3, 2: 1}),
    Structure("car_door", "not in the documents", 4, {1: 5}, 1, b=6),
    Structure("cardan_shaft", "not in the documents", 4, {1: 2, 2: 2}, 1, b=6),
    Structure("cargo_bike", "not in the documents", 4, {1: 2, 3: 2}, b=6),
    Structure("chebyshev", "not in the documents", 4, {1: 4}),
    Structure("compressor", "figure 1.3", 4, {1: 4}, printed="1"),
    Structure("conchoid", "section 3.5.4", 4, {1: 4}),
    Structure("crane", "figure 3.3", 4, {1: 4}),
    Structure("crane_cyl", "figure 3.3, variant", 6, {1: 7}),
    Structure("crankrocker", "section 2.2", 4, {1: 4}),
    Structure("delta", "not in the documents", 11, {1: 3, 3: 12}, b=6),
    Structure("diff", "second exercise 5", 5, {1: 4, 2: 2}, printed="2"),
    Structure("diff2p", "second exercise 5, variant", 6, {1: 5, 2: 4}, 2),
    Structure("diff_bevel", "second exercise 5, variant", 5, {1: 4, 2: 2}),
    Structure("diff_bevel2p", "second exercise 5, variant", 6, {1: 5, 2: 4}, 2),
    Structure("diff_lever", "second exercise 5, variant", 7, {1: 8}),
    Structure("double_rocker", "section 3.1", 6, {1: 7}),
    Structure("drafting", "figure 6.12", 7, {1: 8}),
    Structure("drafting3", "figure 6.12, variant", 8, {1: 9}),
    Structure("e3_steph", "exercise 3", 6, {1: 7}),
    Structure("e3_watt", "exercise 3", 6, {1: 7}),
    Structure("e4", "exercise 4", 6, {1: 7}),
    Structure("elliptic_gears", "not in the documents", 3, {1: 2, 2: 1}),
    Structure("evans", "section 3.5.4", 4, {1: 4}),
    Structure("excavator", "not in the documents", 12, {1: 15}),
    Structure("filmclaw", "exercise 5", 4, {1: 4}),
    Structure("filmclaw_ks", "exercise 5, variant", 4, {1: 4}),
    Structure("filmclaw_slot", "exercise 5, variant", 3, {1: 2, 2: 1}),
    Structure("folding_chair", "not in the documents", 3, {1: 2, 2: 1}),
    Structure("friction_forced", "section 2.6", 4, {1: 4}, printed="1"),
    Structure("friction_rigid", "section 2.6", 3, {1: 3}, 1, printed="0"),
    Structure("garage_norail", "exercise 5", 4, {1: 4}),
    Structure("garage_rail", "exercise 5", 4, {1: 4}),
    Structure("garage_rail_g", "exercise 5, variant", 3, {1: 2, 2: 1}),
    Structure("geartrain", "figure 1.1", 3, {1: 2, 2: 1}, printed="1"),
    Structure("geneva", "figure 1.5", 3, {1: 2, 2: 1}),
    Structure("gough", "not in the documents", 14, {1: 6, 2: 6, 3: 6}, b=6),
    Structure("hart", "not in the documents", 6, {1: 7}),
    Structure("hoecken", "not in the documents", 4, {1: 4}),
    Structure("hood", "003, section 3.1", 4, {1: 4}),
    Structure("hubpodium", "exercise 5", 4, {1: 3, 2: 2}),
    Structure("hubpodium_blocks", "exercise 5, variant", 8, {1: 10}),
    Structure("hubpodium_par", "exercise 5, variant", 4, {1: 4}),
    Structure("jansen", "not in the documents", 8, {1: 10}),
    Structure("klann", "not in the documents", 6, {1: 7}),
    Structure("kneader", "figure 3.8", 4, {1: 4}),
    Structure("knee", "not in the documents", 4, {1: 4}),
    Structure("kurbelschleife", "section 2.6", 4, {1: 4}, printed="1"),
    Structure("lambda", "section 3.5.4", 4, {1: 4}),
    Structure("lamp", "not in the documents", 7, {1: 8}),
    Structure("loader", "figure 1.7", 6, {1: 7}),
    Structure("loader_full", "figure 1.7", 9, {1: 11}),
    Structure("loco2", "section 3.4", 4, {1: 4}),
    Structure("loco3", "figure 6.11", 5, {1: 6}, 1),
    Structure("loco4", "figure 6.11, variant", 6, {1: 8}, 1),
    Structure("mzc", "001", 4, {1: 4}),
    Structure("pantograph", "not in the documents", 5, {1: 5}),
    Structure("peaucellier", "not in the documents", 8, {1: 10}),
    Structure("pent", "section 2.3", 5, {1: 5}, printed="2"),
    Structure("pliers", "not in the documents", 4, {1: 4}),
    Structure("pumpjack", "figure 1.6a", 6, {1: 7}),
    Structure("pumpjack_link", "figure 1.6a, variant", 8, {1: 10}),
    Structure("pumpjack_rod", "figure 1.6a, variant", 7, {1: 9}),
    Structure("quad", "section 2.3", 4, {1: 4}, printed="1"),
    Structure("quad_double", "section 2.6", 5, {1: 6}, printed="0"),
    Structure("quad_strut", "section 2.6", 5, {1: 6}, printed="0"),
    Structure("roberts", "not in the documents", 4, {1: 4}),
    Structure("sarrus", "not in the documents", 6, {1: 6}, 1, b=6),
    Structure("schatz", "not in the documents", 6, {1: 6}, 1, b=6),
    Structure("scissor2", "figure 1.6", 6, {1: 6, 2: 2}),
    Structure("scissor2_cyl", "figure 1.6", 8, {1: 9, 2: 2}),
    Structure("scissor_lr", "figure 1.6, variant", 6, {1: 6, 2: 4}, 1),
    Structure("scissor_tandem", "figure 1.6", 6, {1: 6, 2: 4}, 1),
    Structure("scottrussell", "section 3.5.4", 4, {1: 4}),
    Structure("sewing", "section 3.4", 4, {1: 4}),
    Structure("slidercrank", "section 2.6", 4, {1: 4}, printed="1"),
    Structure("steering", "003, section 3.1", 4, {1: 4}),
    Structure("stephenson_gear", "not in the documents", 9, {1: 11}),
    Structure("strider", "not in the documents", 10, {1: 13}),
    Structure("susp_5link", "003, figure 3.2, variant", 7, {3: 10}, b=6),
    Structure("susp_5link_lift", "figure 3.2, variant", 8, {1: 1, 3: 10, 5: 1}, b=6),
    Structure("susp_planar", "003, figure 3.2", 4, {1: 4}),
    Structure("susp_rack", "figure 3.2, variant", 6, {1: 3, 3: 4}, b=6),
    Structure("susp_spatial", "003, figure 3.2", 5, {1: 2, 3: 4}, b=6),
    Structure("toggle_press", "not in the documents", 6, {1: 7}),
    Structure("toolbox", "figure 3.5", 4, {1: 4}),
    Structure("toolbox2", "figure 3.5, variant", 5, {1: 6}, 1),
    Structure("tri", "section 2.3", 3, {1: 3}, printed="0"),
    Structure("umbrella", "not in the documents", 6, {1: 7}),
    Structure("universal_joint", "not in the documents", 4, {1: 4}),
    Structure("vcomp", "exercise 6", 6, {1: 7}, printed="1"),
    Structure("walschaerts_gear", "not in the documents", 13, {1: 17}),
    Structure("watt_axle", "exercise 18", 4, {1: 4}),
    Structure("watt_engine", "not in the documents", 6, {1: 7}),
    Structure("whitworth", "not in the documents", 6, {1: 7}),
    Structure("winch_plane", "figure 1.2", 3, {1: 2, 2: 1}),
    Structure("winch_screw", "figure 1.2", 3, {1: 3}, 1, b=6),
    Structure("wiper", "figure 3.4", 6, {1: 7}),
    Structure("wiper_opposed", "not in the documents", 6, {1: 7}),
    Structure("wiper_rssr", "not in the documents", 4, {1: 2, 3: 2}, b=6),
    Structure("wobble_plate", "not in the documents", 9, {1: 5, 3: 6, 5: 1}, b=6),
)


def _counts(id: str) -> list[Any]:
    """n and the joints of the chain and of the claims, and F of the claims."""
    record = entry(id)
    count = count_freedoms(record.chain())
    claims = record.claims
    claimed = {f: g for f in range(1, 6) if (g := getattr(claims, f"g{f}"))}
    return [count.n, dict(count.by_freedom), claims.n, claimed, claims.counted]


def _special(id: str) -> list[Any]:
    """The mobility at the machine's own dimensions, claimed and derived where it has any."""
    checked = check_entry(entry(id))
    derived = checked.report.generic if checked.freedoms is None else checked.freedoms.mobility
    claimed = checked.claims.mobility
    return [derived if claimed is None or checked.freedoms is not None else claimed, checked.holds]


def _structure_facts(row: Structure) -> list[Fact]:
    f = own.freedoms(row.n, row.joints, row.b)
    moves = max(f, 0) if row.moves is None else row.moves
    place = row.place if row.place.startswith(("003", "001", "not")) else f"000/003, {row.place}"
    return [
        Fact(
            place=place,
            states=f"{row.id}: n = {row.n}, joints by f {row.joints}, F = {f}",
            derive=lambda: _counts(row.id),
            value=[row.n, row.joints, row.n, row.joints, f],
            subject=row.id,
        ),
        Fact(
            place=place,
            states=f"{row.id}: F",
            derive=lambda: count_freedoms(entry(row.id).chain()).value,
            printed=row.printed,
            value=f,
            subject=row.id,
        ),
        Fact(
            place=place,
            states=f"{row.id}: moves with {moves} at its dimensions, and every claim holds",
            derive=lambda: _special(row.id),
            value=[moves, True],
            subject=row.id,
        ),
    ]


# --- lengths that are printed ------------------------------------------------------------------------


def _length(id: str, link: str, *joints: str) -> float:
    """The distance of two joints, or of a joint and a named point, on a link of a machine."""
    linkage = entry(id).linkage()
    places = []
    for name in joints:
        if name in linkage.points:
            point = linkage.points[name]
            assert point.link == link
            places.append(complex(point.x, point.y))
        else:
            number = linkage.mechanism.chain.find_joint(name)
            assert number is not None
            places.append(complex(*np.array(_place(linkage, link, number))))
    return abs(places[0] - places[1])


def _place(linkage: Any, link: str, joint: int) -> tuple[float, float]:
    element = linkage.elements[joint, link]
    return element.x, element.y


def _at(id: str, values: Sequence[float]) -> Motion:
    """The poses of a machine for drive values in degrees, or in its unit for a slide."""
    linkage = entry(id).linkage()
    turning = linkage.mechanism.drives[0].turning
    return move(linkage, np.radians(values) if turning else np.asarray(values, float))


def _path(id: str, point: str, values: Sequence[float]) -> NDArray[np.complex128]:
    places = _at(id, values).point(point)
    return places[..., 0] + 1j * places[..., 1]


def length(place: str, id: str, name: str, link: str, joints: tuple[str, str], printed: str) -> Fact:
    """A printed length of a machine; all are whole numbers of its unit, and the entry has them without rounding."""
    return Fact(
        place=place,
        states=f"{id}: {name}",
        derive=lambda: _length(id, link, *joints),
        printed=printed,
        value=float(printed),
        subject=id,
    )


def four_bar_lengths(
    place: str, id: str, lengths: str, links: Sequence[str] = ("crank", "coupler", "rocker")
) -> list[Fact]:
    """a, b, c, d of a four-bar as printed."""
    crank, coupler, rocker = links
    frame = entry(id).frame or ""
    joints = f"R({frame}-{crank})", f"R({crank}-{coupler})", f"R({coupler}-{rocker})", f"R({frame}-{rocker})"
    sides = ((crank, 0, 1), (coupler, 1, 2), (rocker, 2, 3), (frame, 0, 3))
    return [
        length(place, id, letter, link, (joints[k], joints[m]), printed)
        for letter, (link, k, m), printed in zip("abcd", sides, lengths.split(), strict=True)
    ]


def _crane_lengths() -> list[float]:
    """Coupler, frame, the rockers by their lengths, and how far C is from the farther joint of the coupler."""
    pivots = "R(frame-front_rocker)", "R(frame-rear_rocker)"
    pins = "R(front_rocker-jib)", "R(jib-rear_rocker)"
    rockers = (
        _length("crane", link, *ends)
        for link, ends in zip(("front_rocker", "rear_rocker"), zip(pivots, pins, strict=True), strict=True)
    )
    return [
        _length("crane", "jib", *pins),
        _length("crane", "frame", *pivots),
        *sorted(rockers),
        max(_length("crane", "jib", pin, "C") for pin in pins),
    ]


TURN = tuple(range(0, 360, 24))
LENGTHS = [
    *four_bar_lengths("000/003, section 3.6.2.1", "crankrocker", "25 70 40 70"),
    *four_bar_lengths("000/003, exercise 20", "lambda", "20 50 50 40"),
    length("000/003, exercise 20", "lambda", "e = BC", "coupler", ("R(coupler-rocker)", "C"), "50"),
    length("000/003, exercise 21", "slidercrank", "a", "crank", ("R(frame-crank)", "R(crank-conrod)"), "25"),
    length("000/003, exercise 21", "slidercrank", "b", "conrod", ("R(crank-conrod)", "R(conrod-slider)"), "70"),
    length("000/003, exercise 17", "conchoid", "a", "crank", ("R(frame-crank)", "R(crank-coupler)"), "30"),
    length("000/003, exercise 17", "conchoid", "A0B0", "frame", ("R(frame-crank)", "R(frame-block)"), "50"),
    length("000/003, exercise 17", "conchoid", "b = AC", "coupler", ("R(crank-coupler)", "C"), "90"),
    length("000/003, exercise 17", "kurbelschleife", "a", "crank", ("R(frame-crank)", "R(crank-block)"), "30"),
    length("000/003, exercise 17", "kurbelschleife", "d", "frame", ("R(frame-crank)", "R(frame-slotted_lever)"), "50"),
    length("000/003, exercise 18", "watt_axle", "a", "rocker1", ("R(body-rocker1)", "R(rocker1-coupler)"), "60"),
    length("000/003, exercise 18", "watt_axle", "b", "rocker2", ("R(body-rocker2)", "R(coupler-rocker2)"), "60"),
    length("000/003, exercise 18", "watt_axle", "c", "coupler", ("R(rocker1-coupler)", "R(coupler-rocker2)"), "30"),
    Fact(
        place="000/003, exercise 19",
        states="crane: a = 30, c = 60, b and d = 80 and 100, AC = 60",
        derive=_crane_lengths,
        value=[30.0, 60.0, 80.0, 100.0, 60.0],
        subject="crane",
    ),
    *(
        Fact(
            place="001",
            states=f"mzc: {name}",
            derive=lambda link=link, joints=joints: _length("mzc", link, *joints),
            value=value,
            subject="mzc",
        )
        for name, link, joints, value in (
            ("l1", "crank", ("R(frame-crank)", "R(crank-coupler)"), 1.0),
            ("l2", "coupler", ("R(crank-coupler)", "R(coupler-rocker)"), 2.5 * sqrt(3)),
            ("l3", "rocker", ("R(coupler-rocker)", "R(frame-rocker)"), 2.5 * sqrt(3)),
            ("l4", "frame", ("R(frame-crank)", "R(frame-rocker)"), 4.0),
            ("k", "coupler", ("R(crank-coupler)", "K"), 25 / 3),
            ("l", "coupler", ("R(coupler-rocker)", "K"), 2.5 * sqrt(3)),
        )
    ),
]


# --- motions by circles ------------------------------------------------------------------------------


def motion(place: str, id: str, states: str, derive: Callable[[], Any], value: Any, near: float = 1e-9) -> Fact:
    """What a machine does, by an own computation."""
    return Fact(place=place, states=f"{id}: {states}", derive=derive, value=value, near=near, subject=id)


def _slides(id: str, joint: str, values: Sequence[float]) -> NDArray[np.float64]:
    way: NDArray[np.float64] = _at(id, values).displacement(joint)
    return way


# Sizes that no document prints: those that the entries state as assumed, written here once more, so that
# none changes unseen. vcomp: crank 30, rods 110, cylinders at 45 and 135 degrees.
MOTIONS = [
    motion(
        "000/003, exercise 6",
        "vcomp",
        "first cylinder at 45°: crank 30, rod 110",
        lambda: _slides("vcomp", "P(frame-piston1)", TURN),
        [own.slider(30, 110, 0, phi - 45) for phi in TURN],
    ),
    motion(
        "000/003, exercise 6",
        "vcomp",
        "second cylinder at 135°: crank 30, rod 110",
        lambda: _slides("vcomp", "P(frame-piston2)", TURN),
        [own.slider(30, 110, 0, phi - 135) for phi in TURN],
    ),
    motion(
        "000/003, exercise 21",
        "slidercrank",
        "s(φ)",
        lambda: _slides("slidercrank", "P(frame-slider)", TURN),
        [own.slider(25, 70, 0, phi) for phi in TURN],
    ),
    motion(
        "000/003, figure 1.3",
        "compressor",
        "s(φ), crank 30, rod 100",
        lambda: _slides("compressor", "P(frame-piston)", TURN),
        [own.slider(30, 100, 0, phi) for phi in TURN],
    ),
    motion(
        "000/003, exercise 17",
        "conchoid",
        "the path of C",
        lambda: _path("conchoid", "C", TURN),
        [own.conchoid_point(30, 50, 90, phi) for phi in TURN],
    ),
    motion(
        "000/003, exercise 20",
        "lambda",
        "the path of C",
        lambda: _path("lambda", "C", TURN),
        [own.lambda_point(20, phi) for phi in TURN],
    ),
    motion(
        "000/003, exercise 18",
        "watt_axle",
        "the path of F",
        lambda: _path("watt_axle", "F", range(-30, 26, 5)),
        [own.watt_point(60, 30, turn) for turn in range(-30, 26, 5)],
    ),
    motion(
        "001",
        "mzc",
        "the path of K",
        lambda: _path("mzc", "K", TURN),
        [own.replacement_point(phi) for phi in TURN],
    ),
    motion(
        "000/003, section 3.5.4",
        "scottrussell",
        "a = b = e = 50: C stands 2a sin φ up the line",
        lambda: _path("scottrussell", "C", range(-80, 81, 20)),
        [100j * np.sin(radians(phi)) for phi in range(-80, 81, 20)],
    ),
    motion(
        "000/003, figure 3.8",
        "kneader",
        "the path of K; a, b, c, d = 40, 110, 90, 120, K at (220, 30)",
        lambda: _path("kneader", "K", TURN),
        [own.on_coupler(*own.four_bar(40, 110, 90, 120, phi), 220, 30) for phi in TURN],
    ),
    motion(
        "000/003, exercise 5",
        "filmclaw",
        "the path of the tip; a, b, c, d = 10, 25, 44, 57, tip at (47, 14)",
        lambda: _path("filmclaw", "tip", TURN),
        [own.on_coupler(*own.four_bar(10, 25, 44, 57, phi), 47, 14) for phi in TURN],
    ),
]


# --- kinds of motion in words ------------------------------------------------------------------------


def _values(id: str) -> tuple[NDArray[np.float64], bool]:
    """Drive values of a machine with one drive: over a full turn, or the range that the entry states."""
    record = entry(id)
    assert record.dimensions is not None
    if record.dimensions.range is not None:
        low, high = record.dimensions.range
        turning = record.linkage().mechanism.drives[0].turning
        return np.linspace(radians(low), radians(high), 73) if turning else np.linspace(low, high, 73), False
    assert drive_range(record.linkage()).full
    return np.linspace(0, 2 * np.pi, 73), True


def words_of(record: Entry, words: str) -> list[str]:
    """Each statement of words such as "crank turns, rocker swings" that does not hold."""
    values, full = _values(record.id)
    moved = move(record.linkage(), values)
    wrong = []
    for statement in words.split(", "):
        subject, verb = statement.split(" ", 1)
        if not _VERBS[verb](record, moved, subject, full):
            wrong.append(statement)
    return wrong


def _net_turn(moved: Motion, link: str) -> tuple[float, float]:
    """By how much a link has turned at the end, and the range of its angle; degrees."""
    angle = np.degrees(np.unwrap(moved.angle(link)))
    return float(angle[-1] - angle[0]), float(np.ptp(angle))


def _turns(record: Entry, moved: Motion, link: str, full: bool) -> bool:
    """After some turns of the drive (several behind wheels) the link has made whole turns."""
    net, _ = _net_turn(moved, link)
    whole = (net / 360 * turns for turns in range(1, 13))
    return full and any(abs(number) > 0.5 and abs(number - round(number)) < 1e-8 for number in whole)


def _swings(record: Entry, moved: Motion, link: str, full: bool) -> bool:
    net, ptp = _net_turn(moved, link)
    return 0.1 < ptp < 360 and (not full or abs(net) < 1e-6)


def _slides_to_and_fro(record: Entry, moved: Motion, link: str, full: bool) -> bool:
    way = _way(record, moved, link)
    return float(np.ptp(way)) > 1e-3 and (not full or abs(way[-1] - way[0]) < 1e-6)


def _translates(record: Entry, moved: Motion, link: str, full: bool) -> bool:
    return float(np.ptp(_way(record, moved, link))) > 1e-3


def _way(record: Entry, moved: Motion, link: str) -> NDArray[np.float64]:
    """The way of a link that slides on the frame."""
    joints = record.chain().joints
    on_frame = (k for k, each in enumerate(joints) if each.pair.is_sliding and {link, record.frame} == {*each.links})
    way: NDArray[np.float64] = moved.displacement(next(on_frame))
    return way


def _keeps_direction(record: Entry, moved: Motion, link: str, full: bool) -> bool:
    return _net_turn(moved, link)[1] < 1e-6


def _uniform(record: Entry, moved: Motion, link: str, full: bool) -> bool:
    return measures(record.linkage(), output=link).transfer.uniform


def _rests(record: Entry, moved: Motion, link: str, full: bool) -> bool:
    return measures(record.linkage(), output=link).dwell_share > 0.1


def _exactly_straight(record: Entry, moved: Motion, point: str, full: bool) -> bool:
    return _straightness(moved, point) < 1e-9


def _nearly_straight(record: Entry, moved: Motion, point: str, full: bool) -> bool:
    return 1e-9 < _straightness(moved, point) < 0.02  # of the length; the documents print no number


def _straightness(moved: Motion, point: str) -> float:
    places = moved.point(point)
    centred = places - places.mean(axis=0)
    axes = np.linalg.svd(centred, full_matrices=False)[2]
    along, across = centred @ axes[0], centred @ axes[1]
    return float(np.ptp(across) / np.ptp(along))


_VERBS: dict[str, Callable[[Entry, Motion, str, bool], bool]] = {
    "turns": _turns,
    "swings": _swings,
    "slides": _slides_to_and_fro,
    "translates": _translates,
    "keeps its direction": _keeps_direction,
    "follows uniformly": _uniform,
    "rests": _rests,
    "runs straight": _exactly_straight,
    "runs nearly straight": _nearly_straight,
}

# What the documents say of the motion, with the names that the entry gives its links.
WORDS = (
    ("003, chapter 1", "belt", "pulley1 turns, pulley2 turns, pulley2 follows uniformly"),
    ("000/003, figure 1.1", "geartrain", "gear1 turns, gear2 turns, gear2 follows uniformly"),
    ("003, chapter 1", "friction_rigid", "wheel1 turns, wheel2 turns, wheel2 follows uniformly"),
    ("000/003, figure 1.2", "winch_plane", "spindle turns, rope_guide translates, rope_guide follows uniformly"),
    ("000/003, figure 1.3", "compressor", "crank turns, piston slides"),
    ("000/003, figure 1.4", "cam", "cam turns, valve slides, valve rests"),
    ("000/003, figure 1.5", "geneva", "driver turns, cross turns, cross rests"),
    ("000/003, figure 1.6", "scissor2", "platform keeps its direction"),
    ("000/003, figure 1.6", "scissor2_cyl", "platform keeps its direction"),
    ("000/003, figure 1.6a", "pumpjack", "crank turns, beam swings, C runs nearly straight"),
    ("000/003, figure 1.7", "loader", "bucket swings"),
    ("000/003, section 2.2", "crankrocker", "crank turns, rocker swings"),
    ("000/003, section 2.2", "slidercrank", "crank turns, slider slides"),
    ("000/003, section 2.2", "kurbelschleife", "crank turns, slotted_lever swings"),
    ("000, figure 6.11", "loco3", "jackshaft turns, wheel1 turns, wheel2 turns, rod keeps its direction"),
    ("000/003, section 3.4", "loco2", "wheel1 turns, wheel2 turns, rod keeps its direction"),
    ("000/003, section 3.1", "double_rocker", "crank turns, rocker1 swings, rocker2 swings"),
    ("003, figure 3.3", "crane", "front_rocker swings, rear_rocker swings, C runs nearly straight"),
    ("000/003, figure 3.4", "wiper", "crank turns, rocker1 swings, rocker2 swings, blade keeps its direction"),
    ("000/003, figure 3.5", "toolbox", "tray keeps its direction"),
    ("000/003, figure 3.5", "toolbox2", "tray1 keeps its direction, tray2 keeps its direction"),
    ("000/003, section 3.4", "sewing", "treadle swings"),
    ("000/003, figure 3.8", "kneader", "crank turns, rocker swings, arm swings"),
    ("000/003, section 3.5.4", "conchoid", "crank turns, block swings"),
    ("000/003, section 3.5.4", "lambda", "crank turns, rocker swings"),
    ("000/003, section 3.5.4", "scottrussell", "C runs straight"),
    ("000/003, section 3.5.4", "evans", "C runs nearly straight"),
    ("000/003, exercise 6", "vcomp", "crank turns, piston1 slides, piston2 slides"),
    ("001", "mzc", "crank turns, rocker swings"),
)


def _said(place: str, id: str, words: str) -> Fact:
    return Fact(place=place, states=f"{id}: {words}", derive=lambda: words_of(entry(id), words), value=[], subject=id)


def _drafting_head() -> list[float]:
    """How far the head turns while each drive turns by 20 degrees about the position drawn."""
    linkage = entry("drafting").linkage()
    pose = linkage.required_pose
    start = [pose[link].angle - pose[of].angle for of, link in (linkage.reference(k) for k in (0, 1))]
    turned = []
    for k in (0, 1):
        rows = np.repeat([start], 9, axis=0)
        rows[:, k] += np.radians(np.linspace(-10, 10, 9))
        moved = move(linkage, rows)
        assert np.ptp(moved.angle("link3" if k else "link1")) > 0.3
        turned.append(float(np.ptp(moved.angle("head"))))
    return turned


def _mu(id: str) -> list[float]:
    """The smallest and the largest transmission angle."""
    transmission = measures(entry(id).linkage()).transmission
    assert transmission is not None
    return [degrees(transmission.smallest.mu), degrees(transmission.largest.mu)]


def _platform_path() -> float:
    """How far the joint of the platform leaves a vertical line."""
    values, _ = _values("scissor2")
    moved = move(entry("scissor2").linkage(), values)
    places = moved.point("R(arm4-platform)")
    assert np.ptp(places[:, 1]) > 1.0
    return float(np.ptp(places[:, 0]))


_CLAIMED = {
    "turns": "turns",
    "swings": "swings",
    "slides": "slides",
    "translates": "slides",
    "keeps its direction": "parallel",
}


def _claimed(place: str, id: str, words: str) -> Fact:
    """The entry claims of its links what the document says, no less and no more."""
    statements = (statement.split(" ", 1) for statement in words.split(", "))
    said = {link: _CLAIMED[verb] for link, verb in statements if verb in _CLAIMED}
    return Fact(
        place=place,
        states=f"{id}: claims on its motion",
        derive=lambda: dict(entry(id).claims.motion),
        value=said,
        subject=id,
    )


def _stated_travels() -> list[list[float]]:
    """Travel and dead centres that entries claim, in the order of the own computations."""
    rows = (("vcomp", "piston1"), ("vcomp", "piston2"), ("compressor", "piston"), ("slidercrank", "slider"))
    rows += (("kurbelschleife", "slotted_lever"), ("conchoid", "block"))
    claims = ((entry(id).claims, link) for id, link in rows)
    return [[each.travel[link], *each.dead_centres[link]] for each, link in claims]


BLOCK = degrees(acos(0.6))
KINDS = [
    *(_said(*row) for row in WORDS),
    *(_claimed(*row) for row in WORDS if any(f" {verb}" in row[2] for verb in _CLAIMED)),
    Fact(
        place="000/003, section 3.2",
        states="claims: a slider moves 2a between rod and crank in line; a block swings 2 arcsin(a/d) between tangents",
        derive=_stated_travels,
        value=[
            [60, 45, 225],
            [60, 135, 315],
            [60, 0, 180],
            [50, 0, 180],
            *([[2 * degrees(asin(0.6)), BLOCK, 360 - BLOCK]] * 2),
        ],
        near=1e-9,
    ),
    Fact(
        place="000/003, section 3.6.2.1",
        states="crankrocker: claimed swing",
        derive=lambda: entry("crankrocker").claims.travel["rocker"],
        value=own.swing(25, 70, 40, 70),
        near=1e-9,
        subject="crankrocker",
    ),
    Fact(
        place="000, figure 6.12",
        states="drafting: the head keeps its direction in both motions",
        derive=_drafting_head,
        value=[0.0, 0.0],
        subject="drafting",
    ),
    Fact(
        place="000/003, section 3.4",
        states="sewing: μ = 0 in the dead centres",
        derive=lambda: _mu("sewing")[0],
        value=0.0,
        near=1e-6,
        subject="sewing",
    ),
    Fact(
        place="000/003, section 3.4",
        states="loco2: μ is 90 where the cranks stand across the rod and 0 where they lie along it",
        derive=lambda: _mu("loco2"),
        value=[0.0, 90.0],
        subject="loco2",
    ),
    Fact(
        place="000/003, figure 1.5",
        states="geneva: four slots, so that the cross rests for 3/4 of a turn",
        derive=lambda: measures(entry("geneva").linkage()).dwell_share,
        value=0.75,
        subject="geneva",
    ),
    Fact(
        place="000/003, figure 1.6",
        states="scissor2: a point of the platform rises along a straight line",
        derive=_platform_path,
        value=0.0,
        subject="scissor2",
    ),
]


FACTS = [*(fact for row in STRUCTURES for fact in _structure_facts(row)), *LENGTHS, *MOTIONS, *KINDS]
