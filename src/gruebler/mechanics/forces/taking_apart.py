"""The joint forces of a linkage of dyads, found link by link: what was assembled last is taken off first.

docs/theory/statics.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Flags, Reals
from gruebler.mechanics.linkages import Linkage

GROWTH = 1e6  # joint forces larger than this by what they hold (lengths in sizes): the links are not held in this pose


@dataclass(frozen=True, kw_only=True)
class HeldLink:
    """A link on one driven joint."""

    link: int
    joint: int
    onto: int
    """The other link there."""
    drive: int


@dataclass(frozen=True, kw_only=True)
class HeldDyad:
    """Two links on one joint, each on one further joint."""

    links: tuple[int, int]
    inner: int
    outer: tuple[int, int]
    onto: tuple[int, int]
    """The other links at the outer joints."""


class JointPlaces(NamedTuple):
    """The joints of a linkage in poses, in sizes."""

    slides: list[bool]
    at: list[Complexes]
    """By joint (rows,): its point."""
    lines: list[Complexes]
    """By joint (rows,): the direction in which it slides."""


class LinkLoads(NamedTuple):
    """What acts on each link: a force, and a moment about a place."""

    force: Complexes
    """(..., links, rows)."""
    moment: Reals
    """(..., links, rows)."""


@lru_cache(maxsize=64)
def removal_steps(linkage: Linkage) -> tuple[HeldLink | HeldDyad, ...] | None:
    """The steps by which links are taken off a linkage with lower pairs until its frame is left; None for others."""
    mechanism = linkage.mechanism
    number = {link: k for k, link in enumerate(mechanism.chain.links)}
    left = [{number[link] for link in joint.links} for joint in mechanism.chain.joints]
    joints = mechanism.chain.joints
    if any(not joint.pair.is_basic or (joint.pair.is_sliding and len(joint.links) > 2) for joint in joints):
        return None
    drives = [(drive.joint, {number[link] for link in drive.between}) for drive in mechanism.drives]
    moving = set(number.values()) - {number[mechanism.frame]}
    steps = list[HeldLink | HeldDyad]()
    while moving:
        step = _next(moving, left, drives)
        if step is None:
            return None
        off = {step.link} if isinstance(step, HeldLink) else set(step.links)
        moving -= off
        for links in left:
            links.difference_update(off)
        steps.append(step)
    return tuple(steps)


def _next(
    moving: set[int], left: Sequence[set[int]], drives: Sequence[tuple[int, set[int]]]
) -> HeldLink | HeldDyad | None:
    on = {link: [k for k, links in enumerate(left) if link in links and len(links) > 1] for link in moving}
    driven = {k: joint for k, (joint, pair) in enumerate(drives) if pair <= left[joint]}
    free = [link for link in moving if not any(link in drives[k][1] for k in driven)]
    for k, joint in driven.items():
        for link in drives[k][1] & moving:
            if on[link] == [joint]:
                return HeldLink(link=link, joint=joint, onto=min(drives[k][1] - {link}), drive=k)
    for link in free:
        for inner in on[link]:
            other = min(left[inner] - {link})
            if left[inner] == {link, other} and other in free and len(on[link]) == len(on[other]) == 2:
                first, second = (next(joint for joint in on[k] if joint != inner) for k in (link, other))
                if first != second:
                    onto = min(left[first] - {link}), min(left[second] - {other})
                    return HeldDyad(links=(link, other), inner=inner, outer=(first, second), onto=onto)
    return None


class JointForces:
    """Joint forces that are found while links are taken off."""

    def __init__(self, joints: JointPlaces, loads: LinkLoads) -> None:
        """Moments are about the origin of the joints' places, by the size."""
        self.joints, self.loads = joints, loads
        rows = loads.force.shape[-1]
        self.held: Flags = np.ones(rows, bool)
        """(rows,): whether the links are held."""
        self.forces = dict[tuple[int, int], Complexes]()
        """By joint and link, (..., rows): on the link; at a driven slide without the drive's own force."""
        self.couples = dict[tuple[int, int], Reals]()
        """By slide and link, (..., rows): on the link about the joint's point, by the size."""

    def take_off(self, step: HeldLink | HeldDyad) -> LinkLoads:
        """Find the forces that hold links; returns what acts on a link alone, or at the inner joint of a dyad."""
        if isinstance(step, HeldLink):
            whole = self._on(step.link)
            self._pass_on(step.link, step.joint, step.onto, whole)
            return whole
        loads = self._on(step.links[0]), self._on(step.links[1])
        needed = self._through(step, *loads)
        for k, sign in enumerate((-1, 1)):
            self._add(step.inner, step.links[k], needed, sign)
            whole = LinkLoads(loads[k].force + sign * needed.force, loads[k].moment + sign * needed.moment)
            self._pass_on(step.links[k], step.outer[k], step.onto[k], whole)
        return needed

    def _through(self, dyad: HeldDyad, first: LinkLoads, second: LinkLoads) -> LinkLoads:
        """What the inner joint of a dyad exerts on the second link.

        Each outer joint leaves one freedom, in which it does no work: there the inner joint holds the loads. Two
        freedoms, two unknowns.
        """
        at = self.joints.at[dyad.inner]
        freedoms = [self._freedom(joint, at) for joint in dyad.outer]
        (travel, turning), (other_travel, other_turning) = freedoms
        held = self._power(dyad.outer[0], first), -self._power(dyad.outer[1], second)
        if not self.joints.slides[dyad.inner]:
            across = (np.conj(travel) * other_travel).imag
            self._check(across, np.maximum(np.abs(travel), np.abs(other_travel)))
            force = 1j * (held[1] * travel - held[0] * other_travel) / across
            return LinkLoads(force, (np.conj(at) * force).imag)
        normal = 1j * self.joints.lines[dyad.inner]
        lever, other_lever = ((np.conj(w) * normal).real for w in (travel, other_travel))
        across = lever * other_turning - other_lever * turning
        self._check(across, np.maximum(np.maximum(np.abs(lever), np.abs(other_lever)), 1.0))
        force = normal * (held[0] * other_turning - held[1] * turning) / across
        couple = (lever * held[1] - other_lever * held[0]) / across
        return LinkLoads(force, (np.conj(at) * force).imag + couple)

    def _freedom(self, joint: int, seen: Complexes) -> tuple[Complexes, float]:
        """The velocity of a place, and the turning, that a joint leaves to its link."""
        if self.joints.slides[joint]:
            return self.joints.lines[joint], 0.0
        return 1j * (seen - self.joints.at[joint]), 1.0

    def _power(self, joint: int, load: LinkLoads) -> Reals:
        """What a load does in the freedom that a joint leaves to its link."""
        if self.joints.slides[joint]:
            return np.asarray((np.conj(self.joints.lines[joint]) * load.force).real)
        return self.moment_at(joint, load)

    def moment_at(self, joint: int, load: LinkLoads) -> Reals:
        """The moment of a load about a joint's point."""
        return np.asarray(load.moment - (np.conj(self.joints.at[joint]) * load.force).imag)

    def _check(self, across: Reals, size: Reals) -> None:
        self.held &= np.abs(across) * GROWTH > size

    def _on(self, link: int) -> LinkLoads:
        return LinkLoads(self.loads.force[..., link, :], self.loads.moment[..., link, :])

    def _pass_on(self, link: int, joint: int, onto: int, whole: LinkLoads) -> None:
        """A joint that holds a link hands on what acts on it."""
        self._add(joint, link, whole, -1)
        self._add(joint, onto, whole, 1)
        self.loads.force[..., onto, :] += whole.force
        self.loads.moment[..., onto, :] += whole.moment

    def _add(self, joint: int, link: int, load: LinkLoads, sign: int) -> None:
        force = load.force
        if self.joints.slides[joint]:
            normal = 1j * self.joints.lines[joint]
            force = normal * (np.conj(normal) * force).real
            self.couples[joint, link] = sign * self.moment_at(joint, load)
        force = force if sign > 0 else -force
        known = self.forces.get((joint, link))
        self.forces[joint, link] = force if known is None else known + force
