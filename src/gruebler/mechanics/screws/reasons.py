"""Known geometric reasons for more mobility than almost all sizes give.

Each recogniser looks at the joints of a pose and says what it found; it proves nothing by itself, for it sees one pose.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.mechanics.screws.instant_mobility import InstantMobility
from gruebler.mechanics.screws.joint_geometry import SAME, JointGeometry, Reason
from gruebler.mechanics.screws.loops import bennett, bricard, cardan, sarrus, schatz
from gruebler.mechanics.screws.motion_groups import MotionGroupKind, common_group, screws_of
from gruebler.mechanics.screws.rigid_motions import adjoint
from gruebler.structure.chain.spaces import Space
from gruebler.structure.mobility import counted

_ROUNDING = 1e-14  # of a point, in sizes

Recogniser = Callable[[JointGeometry], Iterator[Reason]]


def reasons(instant: InstantMobility) -> tuple[Reason, ...]:
    """What is known about the redundant constraints of a pose; empty if none is redundant or nothing was recognised."""
    if not instant.redundancy:
        return ()
    geometry = JointGeometry(instant)
    recognised = tuple(reason for recogniser in _RECOGNISERS for reason in recogniser(geometry))
    return recognised or tuple(_coaxial(geometry))


def _group(s: JointGeometry) -> Iterator[Reason]:
    """All pairs generate motions of a smaller group."""
    kind, dimension = common_group(s.closing, s.instant.pose)
    if s.chain.space is not Space.SPATIAL or kind in (MotionGroupKind.SPACE, MotionGroupKind.OTHER):
        return
    if max(s.chain.joints_by_freedom) < dimension:
        yield Reason(f"group_{kind}", (), (), dimension)


def group_count(reason: Reason, instant: InstantMobility) -> int:
    """The count with the b of the group that a reason names."""
    return counted(instant.closing.mechanism.chain, reason.number)


def _parts(s: JointGeometry, ends: tuple[str, ...]) -> list[tuple[str, ...]]:
    """What the chain falls into when these links are taken away."""
    root = {link: link for link in s.chain.links if link not in ends}
    for joint in s.chain.joints:
        left = [link for link in joint.links if link in root]
        for link_of_part in left[1:]:
            here, there = root[left[0]], root[link_of_part]
            root = {link: here if old_root == there else old_root for link, old_root in root.items()}
    return [
        tuple(link for link, old_root in root.items() if old_root == group_root)
        for group_root in dict.fromkeys(root.values())
    ]


def _copies(s: JointGeometry) -> Iterator[Reason]:
    """Between two links the same parts several times: equal and parallel cranks, the same scissors twice."""
    if len(s.chain.links) > 40:
        return
    for ends in itertools.combinations(s.chain.links, 2):
        parts = [p for p in _parts(s, ends) if {e for k in _joints(s, p) for e in s.chain.joints[k].links} >= set(ends)]
        for alike in _classes(s, parts, ends):
            joints = [k for part in alike for k in _joints(s, part)]
            cranks = all(_is_bar(s, part[0], ends) for part in alike if len(part) == 1) and len(alike[0]) == 1
            if len(alike) < (3 if cranks else 2) or not s.stressed(joints) or not _ties(s, alike[0]):
                continue
            kind = "cranks" if cranks and s.chain.space is Space.PLANAR else "copies"
            yield Reason(kind, (*ends, *(link for part in alike for link in part)), tuple(joints), len(alike))


def _pole(s: JointGeometry) -> Iterator[Reason]:
    """Three or more bars between two links whose lines pass through one point, or are parallel, in this pose."""
    if s.chain.space is not Space.PLANAR:
        return
    for ends in itertools.combinations(s.chain.links, 2):
        bars = [bar for bar in s.chain.links if bar not in ends and _is_bar(s, bar, ends)]
        if len(bars) < 3 or not s.stressed([k for bar in bars for k in _joints(s, (bar,))]):
            continue
        pins = [[s.at(k) for k in _joints(s, (bar,))] for bar in bars]
        if min(np.linalg.norm(b - a) for a, b in pins) < SAME:
            continue
        ways = [(b - a) / np.linalg.norm(b - a) for a, b in pins]
        lines = np.array(
            [[*direction[:2], float(np.cross(a, direction)[2])] for direction, (a, _) in zip(ways, pins, strict=True)]
        )
        if np.linalg.svd(lines, compute_uv=False)[2] > SAME or len(_classes(s, [(b,) for b in bars], ends)) == 1:
            continue
        parallel = all(np.linalg.norm(np.cross(ways[0], direction)) < SAME for direction in ways)
        yield Reason("parallel" if parallel else "concurrent", (*ends, *bars), (), len(bars))


def _is_bar(s: JointGeometry, link: str, ends: tuple[str, ...]) -> bool:
    """Whether a link has two turning joints of two links, one with each of the ends."""
    joints = [s.chain.joints[k] for k in _joints(s, (link,))]
    turning = all(j.pair.is_turning and len(j.links) == 2 for j in joints)
    return turning and sorted(name for j in joints for name in j.links if name != link) == sorted(ends)


def _coaxial(s: JointGeometry) -> Iterator[Reason]:
    """Turning joints of one link, among those with redundant constraints, that lie on each other."""
    turning = [k for k in s.turning if k in s.instant.redundant and s.chain.space is Space.PLANAR]
    for k, j in itertools.combinations(turning, 2):
        shared = set(s.chain.joints[k].links) & set(s.chain.joints[j].links)
        if shared and np.linalg.norm(s.at(k) - s.at(j)) < SAME:
            yield Reason("coaxial", (), (k, j))


def _joints(s: JointGeometry, part: tuple[str, ...]) -> list[int]:
    return [k for k, joint in enumerate(s.chain.joints) if set(joint.links) & set(part)]


def _ties(s: JointGeometry, part: tuple[str, ...]) -> bool:
    """Whether a part, by count, takes anything away from the links that it joins."""
    space = s.chain.space
    taken = sum(s.chain.joints[k].pair.u(space) * s.chain.joints[k].count for k in _joints(s, part))
    return taken > space.b * len(part)


def _classes(s: JointGeometry, parts: list[tuple[str, ...]], ends: tuple[str, ...]) -> list[list[tuple[str, ...]]]:
    """The parts by congruence: shifted copies of one another."""
    classes: list[list[tuple[str, ...]]] = []
    for part in parts:
        for alike in classes:
            if _congruent(s, alike[0], part, ends):
                alike.append(part)
                break
        else:
            classes.append([part])
    return classes


def _congruent(s: JointGeometry, first: tuple[str, ...], second: tuple[str, ...], ends: tuple[str, ...]) -> bool:
    """Whether two parts are alike but for a shift, measured against the first one's own extent."""
    extent = _extent(s, first)
    traits, other_traits = _traits(s, first, ends, extent), _traits(s, second, ends, extent)
    if len(traits) != len(other_traits):
        return False
    same = max(SAME, _ROUNDING / extent)
    for key, screws in traits:
        fitting = next((t for t in other_traits if t[0] == key and abs(t[1] - screws).max() < same), None)
        if fitting is None:
            return False
        other_traits = [t for t in other_traits if t is not fitting]
    return True


def _pins(s: JointGeometry, part: tuple[str, ...]) -> Reals:
    """The points of a part's pins and balls, else of all its joints; (points, 3)."""
    joints = _joints(s, part)
    pins = [k for k in joints if s.chain.joints[k].pair.is_turning or s.chain.joints[k].pair.is_ball] or joints
    return np.array([s.at(k) for k in pins])


def _extent(s: JointGeometry, part: tuple[str, ...]) -> float:
    """How far a part reaches from its middle; 1 if it has one point only."""
    pins = _pins(s, part)
    return float(np.linalg.norm(pins - pins.mean(axis=0), axis=1).max()) or 1.0


def _traits(s: JointGeometry, part: tuple[str, ...], ends: tuple[str, ...], unit: float) -> list[tuple[object, Reals]]:
    """For each joint of a part what it is, whom it meets, and the space of its screws from the middle of the part."""
    shift = np.eye(4)
    shift[:3, 3] = -_pins(s, part).mean(axis=0)
    scale = np.repeat([1.0, 1 / unit], 3)[:, None]
    traits: list[tuple[object, Reals]] = []
    for k in _joints(s, part):
        joint = s.chain.joints[k]
        basis = np.linalg.qr(scale * (adjoint(shift) @ screws_of(s.closing, s.instant.pose, k).T))[0]
        met = tuple(end in joint.links for end in ends)
        traits.append(((joint.pair.name, met, s.places[k].radii), basis @ basis.T))
    return traits


def _planets(s: JointGeometry) -> Iterator[Reason]:
    """Equal wheels on one carrier that mesh with the same wheels."""
    sorts: dict[object, list[str]] = {}
    for link in s.chain.links:
        joints = _joints(s, (link,))
        if sum(k in s.contours for k in joints) >= 2:
            sorts.setdefault(tuple(sorted(_meeting(s, k, link) for k in joints)), []).append(link)
    frame = s.closing.mechanism.frame
    groups = [alike for alike in sorts.values() if len(alike) > 1]
    riding = [alike for alike in groups if not any(True for _ in s.between(s.turning, frame, alike[0]))]
    for alike in riding or groups:
        joints = [k for link in alike for k in _joints(s, (link,))]
        if any(k in s.instant.redundant for k in joints):
            yield Reason("planets", tuple(alike), tuple(joints), len(alike))


def _meeting(s: JointGeometry, joint: int, link: str) -> tuple[str, tuple[str, ...], tuple[float, ...]]:
    """What a link has at a joint: the pair, the other links, and the radii of a contact, its own first."""
    links, radii = s.chain.joints[joint].links, s.places[joint].radii or ()
    own_first = radii if links[0] == link else radii[::-1]
    others = tuple(sorted(name for name in links if name != link))
    return s.chain.joints[joint].pair.name, others, tuple(round(r, 7) for r in own_first)


def _centres(s: JointGeometry) -> Iterator[Reason]:
    """Wheels that roll on each other and touch on the line of their bearings' centres."""
    for k in s.rolling:
        a, b = s.chain.joints[k].links
        for c in s.chain.links:
            bearings = [next(s.between(s.turning, c, x), None) for x in (a, b)]
            if None in bearings or k not in s.instant.redundant or s.chain.space is not Space.PLANAR:
                continue
            if all(s.on_axis(k, s.at(j), "y") for j in bearings if j is not None):
                yield Reason("centres", (a, b, c), (k,))


def _locking(s: JointGeometry) -> Iterator[Reason]:
    """Several contacts of a link whose normals pass through its bearing: they hold the other link and not this one."""
    for a, b in itertools.permutations(s.chain.links, 2):
        contacts = [k for k in s.between(s.contours, a, b) if k not in s.rolling and s.places[k].pressure is None]
        for c in s.chain.links:
            bearing = next(s.between(s.turning, a, c), None) if c not in (a, b) else None
            if bearing is None or len(contacts) < 2 or not s.stressed(contacts):
                continue
            if all(s.on_axis(k, s.at(bearing), "y") for k in contacts):
                yield Reason("locking", (a, b, c), tuple(contacts), len(contacts))


def _line(s: JointGeometry) -> Iterator[Reason]:
    """All redundant joints on one line: a stretched or folded position."""
    joints = sorted(s.instant.redundant)
    if s.chain.space is not Space.PLANAR or any(not s.chain.joints[k].pair.is_turning for k in joints):
        return
    points = np.array([s.at(k) for k in joints])
    spread = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    if len(points) > 2 and spread[1] < SAME < spread[0]:
        yield Reason("line", (), tuple(joints))


_RECOGNISERS: tuple[Recogniser, ...] = (
    _group,
    bennett,
    bricard,
    sarrus,
    schatz,
    cardan,
    _copies,
    _pole,
    _planets,
    _centres,
    _locking,
    _line,
)
