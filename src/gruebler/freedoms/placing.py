"""A linkage in a pose: its closing conditions and where its links are."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import cos, inf, sin

import numpy as np
from numpy.typing import NDArray

from gruebler.errors import LinkageError
from gruebler.linkages import Line, Linkage, Pin
from gruebler.screws import Closing, JointPlace, SpatialLinkage
from gruebler.screws.closing import Tie
from gruebler.screws.following import followed, joint_value
from gruebler.screws.motions import inverse

__all__ = ["known", "placed"]

Reals = NDArray[np.float64]

_CLOSED = 1e-9  # joints that are open by more could not be closed
_NEAR = 0.05  # a closed position farther away, in radians or sizes, is not the one that was meant
_STARTS = 60  # random poses from which a linkage without a home is assembled
_ENOUGH = 6  # closed poses among which the best is taken
_GOOD = 0.01  # a smallest singular value, for each unknown, with which the search for a pose stops


def placed(
    linkage: Linkage | SpatialLinkage, at: Sequence[float] | None = None, branch: str | Iterable[str] | None = None
) -> tuple[Closing, Reals]:
    """The closing conditions of a linkage and a pose: at drive values, else its home, else one that is regular.

    Raises `LinkageError` if there is no such pose.
    """
    if isinstance(linkage, SpatialLinkage):
        if branch is not None:
            raise LinkageError("a linkage that is given by its home has no assembly mode to choose")
        closing = Closing.of(linkage)
        return closing, closing.home if at is None else _driven(closing, closing.home, at, linkage.size)
    closing = _planar(linkage)
    if at is not None or branch is not None:
        return closing, _at(linkage, closing, at, branch)
    if linkage.home is None:
        return closing, _assembled(closing)
    return closing, _centred(closing, _settled(closing, _home(linkage)))


def known(linkage: Linkage) -> bool:
    """Whether all its joints are pins and lines; others are given by their screws."""
    return all(isinstance(element, Pin | Line) for element in linkage.elements.values())


def _planar(linkage: Linkage) -> Closing:
    chain, size = linkage.mechanism.chain, linkage.size
    ties = []
    for number, joint in enumerate(chain.joints):
        first = joint.links[0]
        for other in joint.links[1:]:
            one, two = linkage.elements[number, first], linkage.elements[number, other]
            radii = (inf if isinstance(one, Line) else 0.0, inf if isinstance(two, Line) else 0.0)
            place = JointPlace(radii=radii if joint.pair.name == "roll_slide" else None)
            ends = _frame(one, size), _frame(two, size)
            ties.append(Tie(number, chain.index(first), chain.index(other), ends[0], ends[1], place))
    return Closing(linkage.mechanism, ties, np.tile(np.eye(4), (chain.n, 1, 1)))


def _frame(element: object, size: float) -> Reals:
    if not isinstance(element, Pin | Line):
        raise LinkageError(f"mobility with dimensions knows pins and lines, not {element!r}; give the joints' screws")
    return _matrix(element.x / size, element.y / size, element.angle if isinstance(element, Line) else 0.0)


def _matrix(x: float, y: float, angle: float) -> Reals:
    c, s = cos(angle), sin(angle)
    return np.array([[c, -s, 0, x], [s, c, 0, y], [0, 0, 1, 0], [0, 0, 0, 1.0]])


def _home(linkage: Linkage) -> Reals:
    assert linkage.home is not None
    places = [linkage.home[link] for link in linkage.mechanism.chain.links]
    return np.array([_matrix(p.x / linkage.size, p.y / linkage.size, p.angle) for p in places])


def _settled(closing: Closing, home: Reals) -> Reals:
    """The pose near home in which the joints are closed."""
    pose = closing.settled(home)
    if abs(closing.residual(pose)).max() > _CLOSED or abs(pose - home).max() > _NEAR:
        gap = abs(closing.residual(home)).max()
        raise LinkageError(f"the joints cannot be closed there: they are open by {gap:.1e} of the linkage's size")
    return pose


def _centred(closing: Closing, pose: Reals) -> Reals:
    """The same pose with the mean of the joints' points at the origin, so that no frame is preferred."""
    points = [(pose[tie.first] @ tie.on_first)[:3, 3] for tie in closing.ties]
    moved = pose.copy()
    moved[:, :3, 3] -= np.mean(points, axis=0)
    return moved


def _at(linkage: Linkage, closing: Closing, at: Sequence[float] | None, branch: str | Iterable[str] | None) -> Reals:
    """The pose at drive values, as `move` finds it; with redundant constraints followed from home."""
    drives = linkage.mechanism.drives
    if at is None:
        raise LinkageError("an assembly mode is one of several at a drive value, which is missing")
    if not drives:
        raise LinkageError("the linkage has no drive; a pose at a drive value needs one")
    if len(at) != len(drives):
        raise LinkageError(f"expected {len(drives)} drive values, but found {len(at)}")
    if linkage.home is not None and branch is None and len(drives) == 1:
        home = _settled(closing, _home(linkage))
        return _centred(closing, _driven(closing, home, [_sided(linkage, at[0])], linkage.size))
    from gruebler.kinematics import move

    motion = move(linkage, [tuple(at)], branch=branch)
    if not len(motion):
        raise LinkageError(motion.message())
    chain = linkage.mechanism.chain
    rows = []
    for link in chain.links:
        k = motion.plan.lower.mechanism.chain.index(link)
        z, turn = motion.places[0, 0, k] / linkage.size, motion.turns[0, k]
        rows.append(_matrix(z.real, z.imag, float(np.angle(turn))))
    return _centred(closing, _settled(closing, np.array(rows)))


def _sided(linkage: Linkage, value: float) -> float:
    """The drive value with the first link of the joint as the one that is measured against."""
    first, _ = linkage.reference(0)
    return value if first == linkage.mechanism.chain.joints[linkage.mechanism.drives[0].joint].links[0] else -value


def _driven(closing: Closing, home: Reals, at: Sequence[float], size: float) -> Reals:
    drives = closing.mechanism.drives
    if len(drives) != 1 or len(at) != 1:
        raise LinkageError(f"a pose is followed from home with one drive; here are {len(drives)} and {len(at)} values")
    value, joint = float(at[0]), drives[0].joint
    if closing.mechanism.chain.joints[joint].pair.name == "revolute":
        now = joint_value(closing, home, joint)
        value = now + (value - now + np.pi) % (2 * np.pi) - np.pi
    else:
        value /= size
    out: Reals = followed(closing, home, joint, np.array([value]))[0]
    return out


def _assembled(closing: Closing) -> Reals:
    """A pose with closed joints: of some the most movable, and of those the one farthest from singular."""
    random = np.random.default_rng(20_261_121)
    found: list[tuple[int, float, Reals]] = []
    least = np.inf
    frame = closing.mechanism.chain.index(closing.mechanism.frame)
    for _ in range(_STARTS):
        start = np.array([_matrix(x, y, np.pi * t) for x, y, t in random.uniform(-1, 1, (len(closing.home), 3))])
        pose = closing.settled(inverse(start[frame]) @ start)
        least = min(least, float(abs(closing.residual(pose)).max()))
        if abs(closing.residual(pose)).max() > 1e-12:
            continue
        values = np.linalg.svd(closing.linearised(pose)[1], compute_uv=False) / closing.unknowns
        rank = int(np.sum(values > 1e-9))
        found.append((closing.unknowns - rank, float(values[rank - 1]), pose))
        if len(found) >= _ENOUGH or (rank == closing.equations and values[-1] > _GOOD):
            break
    if not found:
        raise LinkageError(
            f"no position was found in which the joints can be closed: they stay open by {least:.1e} of the linkage's "
            "size at least"
        )
    return _centred(closing, max(found, key=lambda one: one[:2])[2])
