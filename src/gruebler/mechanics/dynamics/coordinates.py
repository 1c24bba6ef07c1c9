"""The coordinates of a free motion: the drives of a linkage, exchanged for other joints where they stand still.

docs/theory/free-motion.md.
"""

from __future__ import annotations

from cmath import rect
from dataclasses import KW_ONLY, dataclass
from itertools import combinations
from typing import Any

import numpy as np
from scipy.linalg import qr

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import LinkageError
from gruebler.base.jets import turn_derivative, turned_derivative
from gruebler.mechanics.dynamics.charts import Blocked, Chart, Charts, Jets
from gruebler.mechanics.kinematics.kernel_calls import run_rows
from gruebler.mechanics.kinematics.plan import Plan, plan
from gruebler.mechanics.kinematics.reference_pose import ReferencePose, pose_at_reference
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Drive, Mechanism

_SOUND = 1e-2  # a pose with a smaller root is not walked on from
_ANYWHERE = 1e4  # radians or sizes: no step leads so far, but it would be walked there
_SLOW = 0.4  # coordinates whose volume is less than this part of that of other joints are exchanged for those
_LOOKS, _CALM = 9, 0.8  # places of a chart, and the part of that volume: below it no place is looked at again
_HERE = 1e-6  # in sizes: a branch that was known before is taken if it lies so near to the pose


class Coordinates:
    """Where all links are at values of the drives near the last ones asked for, on one branch."""

    def __init__(self, plan: Plan, start: ReferencePose) -> None:
        self.plan = plan
        self.links = plan.lower.mechanism.chain.links
        self.count = len(plan.linkage.mechanism.drives)
        self.charts = Charts(plan, start) if self.count == 1 else None
        self._state = start
        self._branching = plan.branching

    @property
    def scale(self) -> Reals:
        """What is usual for each: a radian, or the size of the linkage."""
        turning = [drive.turning for drive in self.plan.linkage.mechanism.drives]
        return np.where(turning, 1.0, self.plan.lower.size)

    @property
    def near(self) -> Reals:
        """Values of the drives at which the branch is known."""
        return self._state.drives

    def jets(self, q: Reals, v: Reals) -> Jets:
        """For unit speeds of each drive, and with several drives in one row more for the speeds given."""
        if self.charts is not None:
            return self.charts.jets(float(q[0]))
        if not (np.isfinite(q).all() and np.isfinite(v).all()):
            raise Blocked
        speeds = np.vstack([np.eye(self.count), v])
        drives, signs, unknowns = self._state
        if (np.abs(q - drives) > _ANYWHERE * self.scale).any():
            raise Blocked
        path = np.vstack([drives, np.repeat(q[None], len(speeds), 0)])
        fast = np.zeros((2, *path.shape))
        fast[0, 1:] = speeds
        rows = run_rows(self.plan, path, fast, signs.copy(), unknowns.copy())
        if rows.reached < len(path) or not np.isfinite(rows.rates[:, 1:]).all():
            raise Blocked
        if np.abs(rows.roots[1, self._branching]).min(initial=1.0) > _SOUND:
            self._state = ReferencePose(q.copy(), np.where(rows.roots[1] < 0, -1.0, 1.0), rows.unknowns[1])
        return Jets(rows.places[:, 1:], rows.turns[1], rows.rates[:, 1:])

    def jets_at(self, q: Reals, v: Reals) -> Jets:
        """The same at many values (rows, drives): (3, speeds, rows, links), (rows, links), (2, speeds, rows, links)."""
        if self.charts is not None:
            places, turns, rates = self.charts.jets_at(q[:, 0])
            return Jets(places[:, None], turns, rates[:, None])
        places_, turns_, rates_ = zip(*map(self.jets, q, v), strict=True)
        return Jets(np.stack(places_, axis=2), np.array(turns_), np.stack(rates_, axis=2))


@dataclass(frozen=True, slots=True)
class JointFreedom:
    """A freedom of a joint that may serve as a coordinate: how far its second link has moved against the first."""

    drive: Drive
    _: KW_ONLY
    first: int
    second: int
    line: complex = 0j
    """Of a slide the direction on the first link; 0 of a pin."""
    near: complex = 0j
    far: complex = 0j
    """Of a slide the points on the first link and on the second."""

    def value(self, jets: Jets) -> Any:
        """Angle in (-pi, pi], or way along the line."""
        if not self.line:
            return np.angle(jets.turns[..., self.second] / jets.turns[..., self.first])
        return self.derivative(jets.places[:, 0], jets.turns, jets.rates[:, 0], 0)

    def speeds(self, jets: Jets) -> Reals:
        """The speed in each row; (rows,)."""
        return np.asarray(self.derivative(jets.places, jets.turns, jets.rates, 1))

    def derivative(self, places: Complexes, turns: Complexes, rates: Reals, order: int) -> Any:
        """The value (of slides), speed or acceleration at origins (3, ..., links) and rates (2, ..., links)."""
        if not self.line:
            return rates[order - 1][..., self.second] - rates[order - 1][..., self.first]
        ends = [
            [
                places[k][..., link] + turn_derivative(rates[..., link], k) * turns[..., link] * arm
                for k in range(order + 1)
            ]
            for link, arm in ((self.first, self.near), (self.second, self.far))
        ]
        gaps = [far - near for near, far in zip(*ends, strict=True)]
        seen = turned_derivative(-rates[..., self.first], gaps, order)
        return (np.conj(self.line * turns[..., self.first]) * seen).real


def freedom_of(linkage: Linkage, drive: Drive, links: tuple[str, ...]) -> JointFreedom:
    """The freedom of a drive, measured as its linkage measures it; `links` are those of the poses, in order."""
    frame = linkage.mechanism.frame
    first, second = drive.between if drive.between[1] != frame else drive.between[::-1]
    k, m = links.index(first), links.index(second)
    if drive.turning:
        return JointFreedom(drive, first=k, second=m)
    line, far = linkage.elements[drive.joint, first], linkage.elements[drive.joint, second]
    near, other = complex(line.x, line.y), complex(far.x, far.y)
    return JointFreedom(drive, first=k, second=m, line=rect(1, line.direction), near=near, far=other)


class CoordinateSets:
    """All coordinates that a free motion of a linkage has used, so that none is found twice."""

    def __init__(self, first: Coordinates) -> None:
        self._linkage = first.plan.linkage
        self._links, self._size = first.links, first.plan.lower.size
        drives = self._linkage.mechanism.drives
        self._freedoms = tuple(freedom_of(self._linkage, drive, first.links) for drive in _freedoms(self._linkage))
        self.drives = tuple(freedom_of(self._linkage, drive, first.links) for drive in drives)
        self._known: dict[tuple[Drive, ...], list[Coordinates]] = {drives: [first]}
        self._refused = set[tuple[Drive, ...]]()
        self._calm = dict[Chart, bool]()

    def exchanged(self, now: Coordinates, jets: Jets, v: Reals) -> tuple[Coordinates, Reals, Reals] | None:
        """Other coordinates for the same motion if the present ones move little beside other joints, else None."""
        charts = now.charts
        if charts is not None and charts.current is not None and self.is_calm(charts, charts.current):
            return None
        ways = self._ways(jets)[:, : now.count]
        alone = now.count == 1  # then the pivot is the largest
        chosen = np.abs(ways).argmax(axis=0) if alone else np.sort(qr(ways.T, pivoting=True, mode="r")[1][: now.count])
        if not abs(np.linalg.det(ways[chosen])) * np.prod(now.scale) * _SLOW > 1.0:
            return None
        freedoms = [self._freedoms[k] for k in chosen]
        drives = tuple(freedom.drive for freedom in freedoms)
        values = np.array([freedom.value(jets) for freedom in freedoms])
        speeds = np.array([freedom.speeds(jets)[: now.count] @ v for freedom in freedoms])
        return self._again(drives, values, speeds, jets) or self._other(drives, values, speeds, jets)

    def _ways(self, jets: Jets) -> Reals:
        """(freedoms, rows): how fast each moves, slides in sizes."""
        return np.array([f.speeds(jets) / (self._size if f.line else 1.0) for f in self._freedoms])

    def is_calm(self, charts: Charts, chart: Chart) -> bool:
        """Whether no joint moves so fast beside the drive on a chart that drives are exchanged."""
        if chart not in self._calm:
            fastest = np.abs(self._ways(charts.jets_on(chart, np.linspace(-1, 1, _LOOKS)))).max()
            self._calm[chart] = bool(fastest * charts.scale * _SLOW < _CALM)
        return self._calm[chart]

    def _again(
        self, drives: tuple[Drive, ...], values: Reals, speeds: Reals, jets: Jets
    ) -> tuple[Coordinates, Reals, Reals] | None:
        """Coordinates that were used before, if they lead to this pose."""
        for known in self._known.get(drives, ()):
            lap = 2 * np.pi * np.array([drive.turning for drive in drives])
            near = values + lap * np.round((known.near - values) / (2 * np.pi))
            for turns in (0, 1, -1):
                try:
                    there = known.jets(near + turns * lap, speeds)
                except Blocked:
                    continue
                gap = np.abs(there.places[0, 0] - jets.places[0, 0]).max() / known.plan.lower.size
                if max(gap, np.abs(there.turns - jets.turns).max()) < _HERE:
                    return known, near + turns * lap, speeds
        return None

    def _other(
        self, drives: tuple[Drive, ...], values: Reals, speeds: Reals, jets: Jets
    ) -> tuple[Coordinates, Reals, Reals] | None:
        """New coordinates; None if the linkage cannot be solved for them."""
        if drives in self._refused:
            return None
        linkage, links = self._linkage, self._links
        pose = {
            link: (z.real, z.imag, float(np.angle(turn)))
            for link, z, turn in zip(links, jets.places[0, 0].tolist(), jets.turns.tolist(), strict=True)
            if link in linkage.mechanism.chain.links
        }
        mechanism = Mechanism(linkage.mechanism.chain, linkage.mechanism.frame, drives)
        try:
            solving = plan(linkage.with_mechanism(mechanism).with_reference_pose(pose))
            if solving.lower.mechanism.chain.links != links:
                raise LinkageError("the links that stand for contacts differ")
            other = Coordinates(solving, pose_at_reference(solving, values))
            there = other.jets(values, speeds)
        except (LinkageError, Blocked):
            self._refused.add(drives)
            return None
        if np.abs(there.turns - jets.turns).max() > _HERE:
            return None
        self._known.setdefault(drives, []).append(other)
        return other, values, speeds


def _freedoms(linkage: Linkage) -> list[Drive]:
    """Every freedom of turning and sliding joints between two links, in the order of drives."""
    chain = linkage.mechanism.chain
    drives = [
        Drive(number, joint.pair.freedoms[chain.space][0], pair)
        for number, joint in enumerate(chain.joints)
        if joint.pair.is_basic
        for pair in combinations(joint.links, 2)
    ]
    return sorted(drives, key=lambda drive: (drive.joint, drive.direction, drive.between))
