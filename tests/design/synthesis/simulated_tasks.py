"""Random tasks with designs, for verdicts to be compared with a simulation: six-bars, structures, curves, bands.

Where the way from a task to its designs is long, the design is there first: a random linkage, whose circuit, followed
by another hand, gives the targets. Some are then moved, permuted or taken of another assembly mode.
"""

from contextlib import suppress
from dataclasses import replace

import numpy as np

from gruebler.base.errors import LinkageError, SynthesisError
from gruebler.design.realisation import realise
from gruebler.design.synthesis import (
    Demands,
    FunctionTask,
    PathTask,
    PositionTask,
    SixBarType,
    synthesise_path,
    synthesise_structures,
)
from gruebler.design.synthesis import six_bar_functions as functions
from gruebler.design.synthesis import six_bar_positions as positions
from gruebler.design.synthesis.judging import judge_design
from gruebler.design.synthesis.results import FITTED
from gruebler.design.synthesis.targets import GuidedCurve, Probe, Targets
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism

from .simulation import cut, on_line
from .traced_linkage import LAP, LostError, traced, values_of

EXACT = 1e-9
WATT = "R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-3); frame=0; drive=R(0-1)"
WATT_TWO = "R(0-1) R(1-2) R(2-3) R(3-0) R(3-4) R(4-5) R(5-0); frame=0; drive=R(0-1)"
STEPHENSON = "R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-0); frame=0; drive=R(0-1)"
SLIDING = "R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) P(5-0); frame=0; drive=R(0-1)"
CLASS_THREE = "R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-0); frame=0; drive=R(5-0)"
SLIDING_CLASS_THREE = "R(0-1) R(1-2) R(2-3) P(3-0) R(2-4) R(4-5) R(5-0); frame=0; drive=R(5-0)"
GUIDING = {WATT: "45", STEPHENSON: "24", SLIDING: "24", CLASS_THREE: "24", SLIDING_CLASS_THREE: "24"}
"""Links that carry a point, of each structure."""
TURNING = {WATT: "345", WATT_TWO: "45", STEPHENSON: "45", SLIDING: "4", CLASS_THREE: "3124", SLIDING_CLASS_THREE: "124"}
"""Links whose turning is an output, at the frame or off it."""


def some_demands(rng, **more):
    chosen = rng.integers(0, 5)
    return Demands(
        size_ratio=float(rng.choice([20.0, 200.0])),
        crank=bool(chosen == 1),
        transmission=np.radians(20.0) if chosen == 2 else 0.0,
        in_order=bool(chosen != 3),
        **more,
    )


def some_poses(rng, course, count):
    """Poses of a linkage, the first one where it is drawn: of one branch, of its circuit, or in any order."""
    origin, length = course.origin, course.length
    style = rng.integers(0, 4)
    if style < 2:
        low, high = origin, origin
        for piece in course.pieces:
            if piece is None:
                low, high = origin - length, origin + length
            for lap in (-length, 0, length) if course.closed and piece else (0,):
                if piece and piece[0] <= origin + lap <= piece[1]:
                    low, high = piece[0] - lap, piece[1] - lap
        end = low if rng.integers(0, 2) else high
        share = np.sort(rng.uniform(0.05, 0.9, count - 1))
        arcs = np.append(origin, origin + share * (end - origin))
    else:
        arcs = origin + np.append(0, np.sort(rng.uniform(0.02, 0.95, count - 1))) * (length if course.closed else 0)
        if not course.closed:
            arcs = np.append(origin, np.sort(rng.uniform(0, length, count - 1)))
        if style == 3:
            arcs[1:] = rng.permutation(arcs[1:])
    arcs = arcs if course.closed else np.clip(arcs, 0, length * (1 - 1e-12))
    return course.at(arcs)[0]


def other_mode(rng, course, q):
    """Another assembly mode of a linkage where its drive stands as in a pose; the pose if none is found."""
    closing = course.closing
    drive = np.zeros(len(q))
    drive[closing.column[closing.crank] + 2] = 1
    for _ in range(8):
        guess = q + rng.normal(size=len(q)) * np.tile([0.6, 0.6, 1.5], len(q) // 3) * (drive == 0)
        with suppress(LostError, np.linalg.LinAlgError):
            found = closing.settled(guess[None], drive[None])[0]
            if np.abs(np.exp(1j * found[2::3]) - np.exp(1j * q[2::3])).max() > 0.1:
                return found
    return q


def disturbed(rng, course, probes, q, size):
    """What probes see in poses, (poses, probes); sometimes one pose of another mode, sometimes one target moved."""
    style, k = rng.integers(0, 5), int(rng.integers(1, len(q)))
    q = q.copy()
    if style == 0:
        q[k] = other_mode(rng, course, q[k])
    values = values_of(course.closing, probes, q, np.zeros_like(q))[0]
    if style == 1:
        off = size * 10 ** rng.uniform(-6, -1) * np.exp(1j * rng.uniform(0, LAP))
        values[k, 0] = values[k, 0] + off if probes[0].point else values[k, 0] * np.exp(1j * abs(off) / size)
    return values


# --- six-bars that meet their targets exactly -----------------------------------------------------------------------


def six_bar_functions(rng):
    """Six-bars of three types, for eight pairs of angles of their own."""
    family = str(rng.choice(["Watt II", "Stephenson II", "Stephenson III"]))
    kind = SixBarType(family=family, shape=complex(*rng.normal(size=2)))
    vectors = rng.normal(size=4) + 1j * rng.normal(size=4)
    mechanism, drawn = functions.drawn_six_bar(kind, vectors)
    places = {k: (z.real, z.imag) for k, z in enumerate(drawn)}
    with suppress(LinkageError, LostError):
        course = traced(Linkage.from_drawing(mechanism, places, outputs=["rocker"]))
        probes = Probe(link="crank"), Probe(link="rocker")
        for _ in range(3):
            values = disturbed(rng, course, probes, some_poses(rng, course, 8), 1.0)
            turns = values / values[0]
            demands = some_demands(rng)
            keeps = functions.keeps_modes(kind, vectors[None], turns)[0]
            yield functions._judged(_UNIT, demands, kind, vectors, turns), demands, EXACT, bool(keeps)


_UNIT = FunctionTask((0, 1, 2), outputs=(0, 1, 2))  # tells the unit, the turns tell the pairs
PINS = np.array([-1.5, -0.64 + 0.48j, 1.16 - 0.45j, 0, -0.46 - 0.77j, 1.2 - 0.94j, -0.32 - 1.45j])  # A C D B H G F


def six_bar_positions(rng):
    """Watt I six-bars for six positions of their body, driven at the crank or the rocker."""
    pins = PINS + rng.choice([0.1, 0.5]) * (rng.normal(size=7) + 1j * rng.normal(size=7)) * (PINS != 0)
    pair = (pins[0].real, pins[0].imag), (0.0, 0.0)
    first = PositionTask([(0.5, 0.25, 0.0), (1, 1, 1)])
    drive = positions.DRIVES[rng.integers(0, 2)]
    with suppress(LinkageError, LostError, SynthesisError):
        course = traced(positions.drawn_guide(first, pins, drive))
        body = course.closing.linkage.outputs[0]
        probes = Probe("P"), Probe(link=body)
        for _ in range(2):
            values = disturbed(rng, course, probes, some_poses(rng, course, 6), 2.0)
            turned = np.angle(values[:, 1] / values[0, 1])
            task = PositionTask(zip(values[:, 0].real, values[:, 0].imag, turned, strict=True), fixed_pivots=pair)
            place = positions._Place.of(task)
            demands = some_demands(rng)
            own = (pins - place.origin)[None] / place.size
            kept = positions.keeps_sides(own, place.turns, place.shifts)
            every = np.ones_like(kept)
            for design in positions._judged(task, place, own, every, demands):
                drives = design.linkage.mechanism.drives[0].between
                number = next(k for k, each in enumerate(positions.DRIVES) if set(drives) <= set(each[2:-1].split("-")))
                yield design, demands, EXACT, bool(kept[0, number])


# --- structures, class III among them -------------------------------------------------------------------------------


def structures(rng):
    """Realised structures for points, positions, timed points and outputs, met exactly or within tolerances."""
    text = str(rng.choice([*TURNING]))
    linkage = realise(Mechanism.parse(text), seed=int(rng.integers(0, 10**6)), budget=300).linkage
    if linkage is None:
        return
    carrier = str(rng.choice([*GUIDING.get(text, "")])) if text in GUIDING and rng.integers(0, 3) else ""
    output = carrier or str(rng.choice([*TURNING[text]]))
    if carrier:
        x, y = linkage.size * rng.normal(size=2) / 3
        linkage = linkage.with_points({"P": (carrier, x, y)})
    with suppress(LinkageError, LostError):
        linkage = linkage.with_outputs([output])
        course = traced(linkage)
        yield from _judged_targets(rng, course, _probes(rng, carrier, output, course.closing.crank, linkage.size))


def _probes(rng, carrier, output, crank, size):
    if not carrier:
        return Probe(link=crank), Probe(link=output)
    more = [(), (Probe(link=carrier, length=size),), (Probe(link=crank, length=size),)]
    return Probe("P"), *more[rng.integers(0, 3)]


def _judged_targets(rng, course, probes, form=FITTED):
    """Designs for targets of a circuit, exact, within one tolerance, or within a band each, some in any order."""
    linkage = course.closing.linkage
    for _ in range(2):
        count = int(rng.integers(3, 7))
        poses = some_poses(rng, course, count)
        size = (
            float(np.ptp(np.abs(values_of(course.closing, probes[:1], poses, 0 * poses)[0])))
            if probes[0].point
            else 1.0
        )
        values = disturbed(rng, course, probes, poses, size)
        tolerance, allowed = EXACT, None
        if rng.integers(0, 2):
            tolerance = float(10 ** rng.uniform(-3, -1))
            noise = rng.normal(size=values.shape) + 1j * rng.normal(size=values.shape)
            scale = rng.uniform(0, 1) * tolerance / np.sqrt(2)
            if rng.integers(0, 2):
                allowed = rng.choice([0.0, 0.3 * tolerance, tolerance, np.inf], count)
                noise[allowed == 0] = 0
            placed = bool(probes[0].point)
            values = values + scale * size * noise if placed else values * np.exp(1j * scale * noise.real)
        if len(probes) > 1 and probes[0].point and rng.integers(0, 2):  # some targets of fewer parts
            values[rng.uniform(size=count) < 0.4, 1] = np.nan
        ranks = ()
        if rng.integers(0, 3) == 0:
            ranks = tuple(None if k == 9 else int(k) for k in rng.choice([0, 1, 2, 3, 9], count))
        targets = Targets(probes, values, size, allowed=allowed, ranks=ranks)
        demands = some_demands(rng, tolerance=tolerance)
        yield judge_design(linkage, targets, demands, form), demands, tolerance, True


def fits(rng):
    """Structures fitted to tasks: positions, points, pairs of a function."""
    text = str(rng.choice([*GUIDING]))
    turn = np.cumsum(rng.uniform(0.2, 0.6, 5))
    z = 2 * np.cos(turn) + 1j * np.sin(turn) + 0.1 * (rng.normal(size=5) + 1j * rng.normal(size=5))
    points, link, chosen = [(w.real, w.imag) for w in z], "", rng.integers(0, 4)
    rising = np.cumsum(rng.uniform(-0.1, 0.5, 4))
    if chosen == 0:
        task = PositionTask([(*p, a) for p, a in zip(points[:4], rising, strict=True)])
    elif chosen == 1:
        task = PathTask(points, angles=(0, None, 0.2, None, None))
    elif chosen == 2:
        task = PathTask(points, crank_angles=tuple(turn))
    else:
        task = FunctionTask(tuple(turn), outputs=tuple(np.cumsum(rng.uniform(0.05, 0.3, 5))))
    if isinstance(task, FunctionTask):
        text = str(rng.choice([WATT, WATT_TWO, STEPHENSON, CLASS_THREE]))
        link = str(rng.choice([*TURNING[text]]))
    demands = some_demands(rng, tolerance=float(rng.choice([0.01, 0.05])))
    with suppress(SynthesisError):
        found = synthesise_structures(task, [Mechanism.parse(text)], demands, starts=1, link=link)
        for design in (*found.designs, *found.rejected):
            yield design, demands, demands.tolerance, True


# --- four-bars: mixed targets, whole curves, nine points ------------------------------------------------------------


def on_course(rng):
    """A random four-bar or slider-crank with a coupler point, and its circuit."""
    while True:
        a, b, c, d, angle, offset = rng.uniform([0.4, 1, 1, 1, 0, -0.3], [1.5, 3, 3, 3, LAP, 0.3])
        pin, slides = a * np.exp(1j * angle), rng.integers(0, 4) == 0
        places, _ = on_line(pin, b, 1j * offset, 1) if slides else cut(pin, b, d + 0j, c)
        end = complex(places[0])
        if np.isnan(end):
            continue
        point = ("coupler", *rng.normal(size=2))
        last = (end.real, end.imag, 0.0) if slides else (d, 0)
        drawn = dict(enumerate([(0, 0), (pin.real, pin.imag), (end.real, end.imag), last]))
        with suppress(LinkageError, LostError):
            kind, output = ("P", "slider") if slides else ("R", "rocker")
            text = f"R(frame-crank) R(crank-coupler) R(coupler-{output}) {kind}({output}-frame); frame=frame"
            mechanism = Mechanism.parse(f"{text}; drive=R(frame-crank)")
            return traced(Linkage.from_drawing(mechanism, drawn, points={"P": point}, outputs=[output]))


def mixed(rng):
    """Points, positions, angles and pairs in one task, within bands, in an order or none: by their verdicts."""
    course = on_course(rng)
    linkage = course.closing.linkage
    turning = [link for link in ("coupler", "crank", "rocker") if link in linkage.mechanism.chain.links]
    some = [link for link in turning if rng.integers(0, 2)]
    probes = Probe("P"), *(Probe(link=link, length=2.0) for link in some)
    yield from _judged_targets(rng, course, probes, "four-bar")


def mixed_fits(rng):
    """The same by the whole search."""
    course = on_course(rng)
    poses = some_poses(rng, course, int(rng.integers(3, 6)))
    count, closing = len(poses), course.closing
    z = values_of(closing, (Probe("P"),), poses, 0 * poses)[0][:, 0]
    z += 0.01 * (rng.normal(size=count) + 1j * rng.normal(size=count))
    angles = tuple(None if rng.integers(0, 2) else float(a) for a in closing.angle(poses, "coupler"))
    ranks = tuple(int(k) for k in rng.integers(0, 3, count)) if rng.integers(0, 2) else ()
    bands = tuple(rng.choice([0.0, 0.03, 0.1], count))
    task = PathTask([(w.real, w.imag) for w in z], angles=angles, tolerances=bands, order=ranks)
    demands = some_demands(rng)
    with suppress(SynthesisError):
        found = synthesise_path(task, demands, number=3)
        for design in (*found.designs, *found.rejected):
            limit = demands.tolerance if not any(bands) else max(0.05, max(bands) / task.size)
            yield design, demands, limit, True


def curves(rng):
    """Whole curves, closed and open: four-bars fitted to them, and four-bars whose curve they nearly are."""
    course = on_course(rng)
    closed = course.closed and bool(rng.integers(0, 2))
    arcs = course.length * (np.arange(14) / 14 if closed else np.linspace(0.02, 0.6, 14))
    poses = course.at(arcs)[0]
    z = values_of(course.closing, (Probe("P"),), poses, 0 * poses)[0][:, 0]
    size = float(np.ptp(z.real))
    z = z + size * 10 ** rng.uniform(-4, -1) * (rng.normal(size=14) + 1j * rng.normal(size=14)) / 2
    tolerance = float(10 ** rng.uniform(-3, -1))
    curve = GuidedCurve.CLOSED if closed else GuidedCurve.OPEN
    targets = Targets((Probe("P"),), z[:, None], float(np.abs(z - z[0]).max()), curve=curve)
    for _ in range(2):
        demands = replace(some_demands(rng, tolerance=tolerance), in_order=True)
        yield judge_design(course.closing.linkage, targets, demands, "four-bar"), demands, tolerance, True


def curve_fits(rng):
    """The same by the whole search."""
    turn = np.sort(rng.uniform(0, 5.5, 14))
    z = 2 * np.cos(turn) + 1j * np.sin(turn) + 0.3 * np.cos(2 * turn)
    z += 0.02 * (rng.normal(size=14) + 1j * rng.normal(size=14))
    demands = replace(some_demands(rng, tolerance=float(rng.choice([0.01, 0.03]))), in_order=True)
    with suppress(SynthesisError):
        found = synthesise_path(
            PathTask([(w.real, w.imag) for w in z], closed=bool(rng.integers(0, 2))), demands, number=3
        )
        for design in (*found.designs, *found.rejected):
            yield design, demands, demands.tolerance, True


def nine_points(rng):
    """Nine points of a four-bar on one branch, or of a wave: accepted designs, and the first of those rejected."""
    z = None
    if rng.integers(0, 2):
        course = on_course(rng)
        low, high = next((0.0, course.length) if piece is None else piece for piece in course.pieces)
        poses = course.at(low + (high - low) * np.sort(rng.uniform(0.05, 0.95, 9)))[0]
        z = values_of(course.closing, (Probe("P"),), poses, 0 * poses)[0][:, 0]
    else:
        turn = np.sort(rng.uniform(0, 5, 9))
        z = 2 * np.cos(turn) + 1j * np.sin(turn) + 0.1 * (rng.normal(size=9) + 1j * rng.normal(size=9))
    demands = replace(some_demands(rng), size_ratio=50.0)
    with suppress(SynthesisError):
        found = synthesise_path(PathTask([(w.real, w.imag) for w in z]), demands)
        rejected = [found.rejected[k] for k in rng.permutation(len(found.rejected))[:12]]
        for design in (*found.designs[:6], *rejected):
            yield design, demands, EXACT, True


KINDS = {
    "six-bars for eight pairs": six_bar_functions,
    "six-bars for six positions": six_bar_positions,
    "structures, class III, outputs off the frame": structures,
    "structures fitted": fits,
    "mixed targets, bands, orders": mixed,
    "mixed targets, by the search": mixed_fits,
    "whole curves": curves,
    "whole curves, by the search": curve_fits,
    "nine points": nine_points,
}
