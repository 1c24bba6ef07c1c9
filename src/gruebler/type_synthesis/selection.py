"""All variants: every typed chain, or every mechanism, that answers a set of requirements, each once."""

from __future__ import annotations

from collections.abc import Iterator

from gruebler.chain import Chain
from gruebler.chain.pairs import pair
from gruebler.errors import GrueblerError
from gruebler.mechanism import Mechanism, check_drives
from gruebler.mechanism.inversion import DrivenMechanism, driven_mechanisms, inversions
from gruebler.type_synthesis.assignment import assignments, every_joint_moves
from gruebler.type_synthesis.contacts import with_contacts
from gruebler.type_synthesis.requirements import JointLocation, Requirements

__all__ = ["typed_chains", "variants"]


def typed_chains(wanted: Requirements) -> Iterator[Chain]:
    """All typed chains with the wanted links, mobility and pairs, in which every joint moves.

    The chains of revolutes with one more link for each contact are enumerated, contacts are put in the place of binary
    links, and the other pairs on the revolutes that are left; each chain once. Different chains of revolutes give
    different chains with contacts (a contact is undone in one way), so no isomorphism test is needed.
    """
    from gruebler.enumeration import chains

    if wanted.links < 3:
        raise GrueblerError(f"a chain has at least three links, not {wanted.links}")
    kinds = {pair("prismatic"): wanted.prismatic, pair("rolling"): wanted.rolling}
    base = chains(
        wanted.links + wanted.roll_slide, wanted.mobility, fractionated="all", multiple_joints=wanted.multiple_joints
    )
    for chain in base:
        for touching in with_contacts(chain, wanted.roll_slide):
            if sum(kinds.values()) > sum(j.pair.name == "revolute" and j.count == 1 for j in touching.joints):
                continue
            for typed in assignments(touching, {k: number for k, number in kinds.items() if number}):
                if wanted.assortment in (None, typed.assortment) and (
                    not wanted.prismatic or every_joint_moves(typed, wanted.mobility)
                ):
                    yield typed


def variants(wanted: Requirements) -> Iterator[Chain | DrivenMechanism]:
    """Everything that answers the requirements: typed chains, or mechanisms where frame, drive or output matter.

    Drives fix the motion: as many as the mobility, none against another.
    """
    for chain in typed_chains(wanted):
        if not wanted.about_mechanisms:
            yield chain
        elif not wanted.about_drives:
            yield from (DrivenMechanism(m) for m in inversions(chain) if wanted.fits_frame(chain, m.frame))
        else:
            yield from _driven(chain, wanted)


def _driven(chain: Chain, wanted: Requirements) -> Iterator[DrivenMechanism]:
    if wanted.drives and len(wanted.drives) != wanted.mobility:
        raise GrueblerError(f"mobility {wanted.mobility} takes as many drives, not {len(wanted.drives)}")
    at_frame = all(d.place is JointLocation.FRAME for d in wanted.drives)
    with_output = wanted.output is not None or wanted.output_at_drive is not None
    fixed: dict[Mechanism, bool] = {}
    for driven in driven_mechanisms(chain, drives=wanted.mobility, at_frame=at_frame, output=with_output):
        mechanism = driven.mechanism
        if wanted.fits_frame(chain, mechanism.frame) and wanted.fits_driven(driven):
            if mechanism not in fixed:
                fixed[mechanism] = check_drives(mechanism).fixed
            if fixed[mechanism]:
                yield driven
