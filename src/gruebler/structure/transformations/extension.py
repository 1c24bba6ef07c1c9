"""All extensions of a chain by one dyad or one coupler, each structure once."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import permutations

from gruebler.base.doors import door
from gruebler.base.errors import TransformationError
from gruebler.structure.chain import Chain
from gruebler.structure.isomorphism import code
from gruebler.structure.transformations.dyads import insert_coupler, insert_dyad
from gruebler.structure.transformations.places import Attachment, links_at
from gruebler.structure.transformations.steps import Step


@dataclass(frozen=True)
class Extension:
    """One structure that results from an extension, and all pairs of places that lead to it."""

    code: str
    step: Step
    """The first of the steps that lead to it."""
    places: tuple[tuple[Attachment, Attachment], ...]

    @property
    def chain(self) -> Chain:
        """The new chain."""
        return self.step.chain


@door
def extend(
    chain: Chain, *, dyad: str | None = None, coupler: str | None = None, at_joints: bool = False
) -> list[Extension]:
    """All different extensions of a chain by one dyad of this form, or by one coupler with these joints.

    Different up to isomorphism, by canonical code, in the order of their first places.

    Args:
        chain: a planar or spherical chain.
        dyad: the form, RRR, RRP, RPR, PRP or RPP; or
        coupler: the joints, such as RR.
        at_joints: whether new links may also join existing joints, which become multiple joints.

    Returns:
        A list of `Extension`: ``chain`` and ``places``; different up to isomorphism, in the order of their first
        places.

    Raises:
        ChainError: neither or both of dyad and coupler, an unknown form, a spatial chain.

    Cost:
        One canonical code for each pair of places.

    Example:
        >>> four_bar = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)")
        >>> [len(extension.places) for extension in extend(four_bar, dyad="RRR")]  # Watt between neighbours, Stephenson
        [4, 2]

    See Also:
        `derive`, `chains`

    Theory:
        docs/theory/transformations.md
    """
    if (dyad is None) == (coupler is None):
        raise TransformationError("say what extends the chain: a dyad of some form, or a coupler")
    letters = (dyad or coupler or "").upper()
    places: list[Attachment] = [*chain.links]
    if at_joints:
        places += [k for k, joint in enumerate(chain.joints) if joint.pair.is_group]
    structures: dict[str, tuple[Step, list[tuple[Attachment, Attachment]]]] = {}
    number = {place: k for k, place in enumerate(places)}
    for start, end in permutations(places, 2):
        if (letters == letters[::-1] and number[start] > number[end]) or _share_a_link(chain, start, end):
            continue
        try:
            step = (
                insert_coupler(chain, [start, end], letters)
                if dyad is None
                else insert_dyad(chain, letters, [start, end])
            )
        except TransformationError:
            if isinstance(start, str) and isinstance(end, str):
                raise  # the form is wrong, not the place: only a joint can reject a pair
            continue
        structures.setdefault(code(step.chain), (step, []))[1].append((start, end))
    return [Extension(key, step, tuple(where)) for key, (step, where) in structures.items()]


def _share_a_link(chain: Chain, start: Attachment, end: Attachment) -> bool:
    return not set(links_at(chain, start)).isdisjoint(links_at(chain, end))
