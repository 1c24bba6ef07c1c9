"""A mechanism with locked drives: bodies instead of links, and the joints between them."""

from __future__ import annotations

from dataclasses import dataclass

from gruebler.base.disjoint_sets import DisjointSets
from gruebler.base.errors import GrueblerError
from gruebler.structure.assur.splitting import BodyJoint
from gruebler.structure.chain.spaces import Space
from gruebler.structure.mechanism import Drive, Mechanism
from gruebler.structure.mobility import generic, pebble_rank
from gruebler.structure.mobility.placement import LockedFreedom


class AssurError(GrueblerError):
    """An input without Assur groups: not planar, or not a group."""


@dataclass(frozen=True, slots=True)
class LockedMechanism:
    """The locked mechanism."""

    bodies: tuple[tuple[str, ...], ...]
    """The links that drives lock together, the frame's body first."""
    joints: tuple[BodyJoint, ...]
    clean: bool
    """Whether merging the links to bodies shows no redundant constraint."""

    @property
    def counted(self) -> int:
        """Freedoms minus constraints; 0 if the drives are as many as needed."""
        return 3 * (len(self.bodies) - 1) - sum(j.constraints * (len(j.bodies) - 1) for j in self.joints)


def lock_drives(mechanism: Mechanism) -> LockedMechanism:
    """The mechanism with its drives locked.

    Raises `AssurError` for a chain that is not planar, and for a driven single freedom of a double slide that more than
    two links share (write one joint for each two of them).
    """
    chain = mechanism.chain
    if chain.space is not Space.PLANAR:
        raise AssurError("Assur groups are made of planar chains; this one is {space}", space=chain.space)
    sets = DisjointSets(chain.links)
    effective, clean = [0] * len(chain.joints), True
    partial: dict[int, Drive] = {}
    for drive in whole_joint_locks(mechanism, partial):
        a, b = (sets.find(link) for link in drive.between)
        clean = clean and a != b
        effective[drive.joint] += a != b
        sets.unite(a, b)
    bodies: dict[str, list[str]] = {sets.find(mechanism.frame): []}
    for link in chain.links:
        bodies.setdefault(sets.find(link), []).append(link)
    place = {link: k for k, body in enumerate(bodies.values()) for link in body}
    joints = []
    for number, joint in enumerate(chain.joints):
        members = tuple(dict.fromkeys(place[link] for link in joint.links))
        clean = clean and joint.count - (len(members) - 1) == effective[number]
        if len(members) > 1:
            effective_pair = joint.pair
            if number in partial:
                effective_pair = joint.pair.left_without(partial[number].direction)
            joints.append(BodyJoint(number, effective_pair, members))
    return LockedMechanism(tuple(tuple(body) for body in bodies.values()), tuple(joints), clean)


def independent(mechanism: Mechanism, locked: LockedMechanism) -> bool:
    """Whether the constraints of the locked mechanism are generically independent.

    Simple turning, rolling and roll-slide joints: by the pebble game on bodies. Otherwise by exact rank.
    """
    if not locked.clean:
        return False
    if all(len(j.bodies) == 2 and (j.pair.turns_in_plane) for j in locked.joints):
        edges = [(j.bodies[0], j.bodies[1]) for j in locked.joints for _ in range(j.constraints)]
        return pebble_rank(len(locked.bodies), edges, 3, 3) == len(edges)
    locks = [LockedFreedom(d.joint, d.direction, d.between) for d in mechanism.drives]
    return generic(mechanism.chain, locks).redundancy == 0


def whole_joint_locks(mechanism: Mechanism, partial: dict[int, Drive]) -> list[Drive]:
    """One drive for each two links that their drives lock completely; the others go into `partial`."""
    chain = mechanism.chain
    together: dict[tuple[int, frozenset[str]], list[Drive]] = {}
    for drive in mechanism.drives:
        together.setdefault((drive.joint, frozenset(drive.between)), []).append(drive)
    whole = []
    for drives in together.values():
        joint = chain.joints[drives[0].joint]
        if len(drives) == joint.pair.f(chain.space):
            whole.append(drives[0])
        elif joint.count == 1:
            partial[drives[0].joint] = drives[0]
        else:
            raise AssurError(
                "one freedom of {joint} is driven between two of its {count} links: write a joint of its own for "
                "each two links",
                joint=joint,
                count=len(joint.links),
            )
    return whole
