"""All variants: every typed chain, or every mechanism, that satisfies a set of requirements, each once."""

from __future__ import annotations

from collections.abc import Iterator

from gruebler.chain import Chain
from gruebler.chain.pairs import pair
from gruebler.errors import GrueblerError, expect
from gruebler.mechanism import Mechanism, check_drives
from gruebler.mechanism.inversion import DrivenMechanism, driven_mechanisms, inversions
from gruebler.type_synthesis.assignment import assignments, every_joint_moves
from gruebler.type_synthesis.contacts import with_contacts
from gruebler.type_synthesis.requirements import JointLocation, Requirements

__all__ = ["typed_chains", "variants"]


def typed_chains(requirements: Requirements) -> Iterator[Chain]:
    """All typed chains with the required links, mobility and pairs, in which every joint moves.

    The chains of revolutes with one more link for each contact are enumerated, contacts replace binary links, and the
    other pairs replace revolutes among the remaining ones; each chain once. Different chains of revolutes give
    different chains with contacts (the inverse of a contact is unique), so no isomorphism test is needed.
    """
    from gruebler.enumeration import chains

    if requirements.links < 3:
        raise GrueblerError("a chain has at least three links, not {links}", links=requirements.links)
    kinds = {pair("prismatic"): requirements.prismatic, pair("rolling"): requirements.rolling}
    base = chains(
        requirements.links + requirements.roll_slide,
        requirements.mobility,
        fractionated="all",
        multiple_joints=requirements.multiple_joints,
    )
    for chain in base:
        for touching in with_contacts(chain, requirements.roll_slide):
            if sum(kinds.values()) > sum(j.pair.is_revolute and j.count == 1 for j in touching.joints):
                continue
            for typed in assignments(touching, {k: number for k, number in kinds.items() if number}):
                if requirements.assortment in (None, typed.assortment) and (
                    not requirements.prismatic or every_joint_moves(typed, requirements.mobility)
                ):
                    yield typed


def variants(requirements: Requirements) -> Iterator[Chain | DrivenMechanism]:
    """All results that satisfy the requirements: typed chains, or mechanisms where frame, drive or output matter.

    Drives fix the motion: as many as the mobility, none of them in conflict.
    """
    expect(requirements, Requirements)
    for chain in typed_chains(requirements):
        if not requirements.about_mechanisms:
            yield chain
        elif not requirements.about_drives:
            yield from (DrivenMechanism(m) for m in inversions(chain) if requirements.fits_frame(chain, m.frame))
        else:
            yield from _driven(chain, requirements)


def _driven(chain: Chain, requirements: Requirements) -> Iterator[DrivenMechanism]:
    if requirements.drives and len(requirements.drives) != requirements.mobility:
        raise GrueblerError(
            "mobility {mobility} needs as many drives, not {count}",
            mobility=requirements.mobility,
            count=len(requirements.drives),
        )
    at_frame = all(d.place is JointLocation.FRAME for d in requirements.drives)
    with_output = requirements.output is not None or requirements.output_at_drive is not None
    fixed: dict[Mechanism, bool] = {}
    for driven in driven_mechanisms(chain, drives=requirements.mobility, at_frame=at_frame, output=with_output):
        mechanism = driven.mechanism
        if requirements.fits_frame(chain, mechanism.frame) and requirements.fits_driven(driven):
            if mechanism not in fixed:
                fixed[mechanism] = check_drives(mechanism).fixed
            if fixed[mechanism]:
                yield driven
