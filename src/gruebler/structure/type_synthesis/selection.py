"""All variants: every typed chain, or every mechanism, that satisfies a set of requirements, each once."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from functools import partial
from itertools import chain as chain_of
from zlib import compress, decompress

from gruebler.base.doors import door
from gruebler.base.errors import GrueblerError
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import pair
from gruebler.structure.enumeration.worker_pool import run_work
from gruebler.structure.mechanism import Mechanism, check_drives
from gruebler.structure.mechanism.inversion import DrivenMechanism, driven_mechanisms, inversions
from gruebler.structure.type_synthesis.assignment import assignments, every_joint_moves
from gruebler.structure.type_synthesis.contacts import with_contacts
from gruebler.structure.type_synthesis.requirements import JointLocation, Requirements


def typed_chains(requirements: Requirements) -> Iterator[Chain]:
    """All typed chains with the required links, mobility and pairs, in which every joint moves.

    The chains of revolutes with one more link for each contact are enumerated, contacts replace binary links, and the
    other pairs replace revolutes among the remaining ones; each chain once. Different chains of revolutes give
    different chains with contacts (the inverse of a contact is unique), so no isomorphism test is needed.
    """
    return chain_of.from_iterable(_typed(chain, requirements) for chain in _turning_chains(requirements))


def _turning_chains(requirements: Requirements) -> Iterator[Chain]:
    """The chains of revolutes from which the typed chains are made."""
    from gruebler.structure.enumeration import chains

    if requirements.links < 3:
        raise GrueblerError("a chain has at least three links, not {links}", links=requirements.links)
    return chains(
        requirements.links + requirements.roll_slide,
        requirements.mobility,
        fractionated="all",
        multiple_joints=requirements.multiple_joints,
    )


def _typed(chain: Chain, requirements: Requirements) -> Iterator[Chain]:
    """The typed chains that one chain of revolutes gives."""
    kinds = {pair("prismatic"): requirements.prismatic, pair("rolling"): requirements.rolling}
    for touching in with_contacts(chain, requirements.roll_slide):
        if sum(kinds.values()) > sum(j.pair.is_turning and j.count == 1 for j in touching.joints):
            continue
        for typed in assignments(touching, {k: number for k, number in kinds.items() if number}):
            if requirements.assortment in (None, typed.assortment) and (
                not requirements.prismatic or every_joint_moves(typed, requirements.mobility)
            ):
                yield typed


@door
def variants(
    requirements: Requirements, *, executor: Executor | Callable[[], Executor] | None = None
) -> Iterator[Chain | DrivenMechanism]:
    """All results that satisfy the requirements: typed chains, or mechanisms where frame, drive or output matter.

    Drives fix the motion: as many as the mobility, none of them in conflict.

    Args:
        requirements: what is required.
        executor: see `enumeration.worker_pool.run_work`; a piece of work is what one chain of revolutes gives. The
            results and their order are the same.

    Returns:
        An iterator of chains, or of `DrivenMechanism` where frame, drive or output matter; drives fix the motion.

    Raises:
        GrueblerError: requirements that contradict themselves.

    Cost:
        That of the chains, times the choices of joint types.

    Example:
        >>> from gruebler.structure.type_synthesis import Requirements
        >>> len(list(variants(Requirements(4))))>0
        True

    See Also:
        `Requirements`, `chains`, `synthesise`

    Theory:
        docs/theory/joint-types.md
    """
    turning = _turning_chains(requirements)
    if executor is None:
        return chain_of.from_iterable(_variants(chain, requirements) for chain in turning)
    packed = run_work(partial(_packed_variants, requirements), turning, executor)
    return chain_of.from_iterable(pickle.loads(decompress(each)) for each in packed)


def _packed_variants(requirements: Requirements, chain: Chain) -> bytes:
    """What one chain gives, small enough to be sent between processes."""
    return compress(pickle.dumps(list(_variants(chain, requirements))))


def _variants(turning: Chain, requirements: Requirements) -> Iterator[Chain | DrivenMechanism]:
    """The results that one chain of revolutes gives."""
    for chain in _typed(turning, requirements):
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
