"""The mobility of a chain with all its evidence: the count, whether it is true, and the faults with their places."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from html import escape
from typing import Any

from gruebler.base import notebook
from gruebler.base.doors import door
from gruebler.base.errors import ChainError, check_method
from gruebler.base.notebook import brief
from gruebler.base.plain_data import plain
from gruebler.base.text import Message, arity, joined, message
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.chain.spaces import Space
from gruebler.structure.mobility.circuits import Overconstrained, overconstrained
from gruebler.structure.mobility.counting import Count, count_freedoms
from gruebler.structure.mobility.idle import IdleCondition, IdleFreedom, idle_freedoms
from gruebler.structure.mobility.rank import generic
from gruebler.structure.mobility.sparsity import pebble_mobility


class Verdict(StrEnum):
    """The conclusion from the evidence: the first of these that applies."""

    OVERCONSTRAINED = "overconstrained"
    """Some subchain has more constraints than it needs, whatever the count of the entire chain is."""
    RIGID = "rigid"
    """Nothing moves, and nothing is redundant: F = 0."""
    PARTLY_RIGID = "partly_rigid"
    """The chain moves, but some of its links do not move against each other."""
    CONSTRAINED = "constrained"
    """F = 1: one drive moves everything."""
    MOVABLE = "movable"
    """F > 1: as many drives are needed."""


_VERDICTS = {
    Verdict.OVERCONSTRAINED: message("overconstrained"),
    Verdict.RIGID: message("rigid"),
    Verdict.PARTLY_RIGID: message("partly rigid"),
    Verdict.CONSTRAINED: message("constrained"),
    Verdict.MOVABLE: message("movable"),
}
_OVERCONSTRAINED = message(
    "Some links have more constraints than they need: these links fit together only with exact dimensions, or with "
    "play."
)
"""Redundancy is the number of equations between the dimensions (docs/theory/mobility.md, "Assembling")."""
_CRANKS, _CONTACT = message("equal and parallel cranks"), message("a contact on the line of centres")
_AXIS = message("joints on one axis")
_ASSEMBLED = {
    True: message("Once assembled, the chain moves at almost all sizes."),
    False: message(
        "Once assembled, nothing moves at almost all sizes; only special dimensions (equal and parallel cranks, one "
        "common axis, Bennett's ratio) can set it free."
    ),
}
"""What an overconstrained chain does, by whether its generic mobility is positive."""
_MEANINGS = {
    Verdict.RIGID: message(
        "Nothing moves for almost all dimensions; only special dimensions ({examples}) can set it free, and then "
        "constraints are redundant."
    ),
    Verdict.PARTLY_RIGID: message("It moves, but some of its links stay rigid against each other and act as one link."),
    Verdict.CONSTRAINED: message("One drive moves every link in one definite way."),
    Verdict.MOVABLE: message("{mobility} drives move every link in one definite way."),
}
_OTHER_COUNTS = {
    Space.PLANAR: message("The count takes b = {b} motions of a free link instead of the planar chain's {own}."),
    Space.SPHERICAL: message("The count takes b = {b} motions of a free link instead of the spherical chain's {own}."),
    Space.SPATIAL: message("The count takes b = {b} motions of a free link instead of the spatial chain's {own}."),
}


@brief
@dataclass(frozen=True, repr=False, kw_only=True)
class MobilityReport:
    """The result of `mobility_report`. `explain` returns it as text."""

    chain: Chain
    frame: str
    count: Count
    generic: int
    """The mobility at almost all dimensions."""
    redundancy: int
    """Redundant constraints in all: generic mobility minus the count with the space's own b."""
    exact: bool
    """Whether the generic mobility is proved; otherwise `error_bound` bounds the probability of an error."""
    error_bound: float
    overconstrained: tuple[Overconstrained, ...]
    rigid_clusters: tuple[tuple[str, ...], ...]
    """The maximal sets of two or more links that do not move against each other."""
    immobile_joints: tuple[int, ...]
    idle_freedoms: tuple[IdleFreedom, ...]
    method: str = "rank"
    """What the generic mobility comes from: ``rank``, ``pebble``, or ``both`` where the two agree."""

    @property
    def counted(self) -> int:
        """F by the formula."""
        return self.count.value

    @property
    def verdict(self) -> Verdict:
        """The conclusion from the evidence."""
        if self.redundancy:
            return Verdict.OVERCONSTRAINED
        if self.generic == 0:
            return Verdict.RIGID
        if self.rigid_clusters:
            return Verdict.PARTLY_RIGID
        return Verdict.CONSTRAINED if self.generic == 1 else Verdict.MOVABLE

    def explain(self, lang: str = "en") -> str:
        """The report as a text of a few lines, in English (``en``) or German (``de``).

        >>> from gruebler.structure.chain import Chain
        >>> print(mobility_report(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)")).explain())
        Chain: R(0-1) R(1-2) R(2-3) R(3-0)
        Links: n = 4 (4 binary)
        Joints: g1 = 4, one independent loop
        Count: F = 3(n - 1) - 2 g1 = 3(4 - 1) - 2·4 = 1
        Criterion of constrained motion: 3n - 4 - 2 g1 = 12 - 4 - 8 = 0. It holds.
        Generic mobility (almost all sizes): 1, proved. The count is correct.
        Verdict: constrained. One drive moves every link in one definite way.
        """
        names = self.chain.joint_names(Alphabet.of_language(lang))
        lines = [*_structure(self, names, lang), *_numbers(self), *_details(self, names)]
        return "\n".join(line.in_language(lang) for line in lines)

    def _repr_html_(self) -> str:
        """The structure picture and the report as text, for notebooks."""
        picture = notebook.svg_of(self.chain) if notebook.svg_of else ""
        return f"{picture}<pre>{escape(self.explain())}</pre>"

    def to_json(self) -> dict[str, Any]:
        """Plain data for `json.dumps`; the joints as unique texts."""
        names = self.chain.joint_names()
        listed = ("joints", "resolved_by_removing", "resolved_by_freeing", "immobile_joints")
        keys = "counted generic method verdict exact overconstrained rigid_clusters immobile_joints idle_freedoms"
        return {
            **plain(self.chain, "links space"),
            "joints": list(names),
            **plain(self, keys, units=dict.fromkeys(listed, names.__getitem__)),
        }


_METHODS = ("rank", "pebble", "both")


@door
def mobility_report(
    chain: Chain, *, b: int | None = None, frame: str | None = None, method: str = "rank", large: bool = False
) -> MobilityReport:
    """Count the freedoms of a chain and check the count.

    Args:
        chain: any chain.
        b: the motions of a free link for the count, if the chain moves in a smaller group than its space.
        frame: the fixed link; by default the first. It matters only for rollers
            (`gruebler.structure.mobility.idle`): mobility does not depend on it.
        method: what gives the generic mobility: ``rank`` (exact rank at a random placement, confirmed by a theorem
            where one applies), ``pebble`` (the pebble game, where a theorem licenses it), ``both``. What is
            overconstrained and what is rigid comes from the rank in any case.
        large: start even an elimination of more than about a minute or 1 GB, instead of raising `TooLargeError`.

    Returns:
        `MobilityReport`: ``counted`` by the formula, ``generic`` with its proof or bound of error, the verdict,
        overconstrained parts, rigid clusters, idle freedoms; ``method`` that answered.

    Raises:
        ChainError: an unknown frame, a chain that no theorem covers where the pebble game is asked for.
        TooLargeError: an elimination of more than about a minute or 1 GB, unless ``large``.

    Cost:
        About linear for chains that grow dyad by dyad, cubic in the dense core of others: some 10 ms for ten links.

    Example:
        >>> vee = Chain.parse("R(frame-crank) R(crank-conrod1-conrod2) R(conrod1-piston1) R(conrod2-piston2) "
        ...                   "P(frame-piston1) P(frame-piston2)")
        >>> report = mobility_report(vee)
        >>> report.counted, report.generic, str(report.verdict)
        (1, 1, 'constrained')

    See Also:
        `freedoms`, `derive`, `inversions`

    Theory:
        docs/theory/mobility.md
    """
    still = chain.links[0] if frame is None else frame
    chain.index(still)
    number = count_freedoms(chain, b)
    check_method(method, _METHODS, ChainError)
    game = None if method == "rank" else pebble_mobility(chain)
    rank = generic(chain, large=large)
    if method == "both" and game != rank.mobility:
        raise ChainError(
            "the methods differ: the rank gives the mobility {rank}, the pebble game {game}",
            rank=rank.mobility,
            game=game,
        )
    clusters = rank.clusters
    member = {link: k for k, cluster in enumerate(clusters) for link in cluster}
    immobile = tuple(k for k, joint in enumerate(chain.joints) if len({member[link] for link in joint.links}) == 1)
    return MobilityReport(
        chain=chain,
        frame=still,
        count=number,
        generic=rank.mobility if game is None else game,
        redundancy=rank.redundancy if game is None else rank.redundancy + game - rank.mobility,
        exact=rank.exact if game is None else True,
        error_bound=rank.error_bound if game is None else 0.0,
        overconstrained=overconstrained(rank),
        rigid_clusters=tuple(cluster for cluster in clusters if len(cluster) > 1),
        immobile_joints=immobile,
        idle_freedoms=idle_freedoms(rank, still),
        method=method,
    )


def verdict_word(verdict: Verdict, lang: str) -> str:
    """The name of the verdict.

    >>> verdict_word(Verdict.CONSTRAINED, "de")
    'zwangläufig'
    """
    return _VERDICTS[verdict].in_language(lang)


def kinds_of_links(chain: Chain, lang: str) -> str:
    """How many links of the chain are binary, ternary, ...

    >>> kinds_of_links(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(1-4) R(4-5) R(5-2)"), "de")
    '4 binär, 2 ternär'
    """
    return ", ".join(f"{count} {arity(joints, lang)}" for joints, count in chain.link_kinds.items())


def _structure(report: MobilityReport, names: Sequence[str], lang: str) -> Iterator[Message]:
    chain = report.chain
    yield message("Chain: {chain}", chain=chain.text(Alphabet.of_language(lang)))
    yield message("Links: n = {n} ({kinds})", n=chain.n, kinds=kinds_of_links(chain, lang))
    counts = ", ".join(f"g{freedom} = {count}" for freedom, count in chain.joints_by_freedom.items())
    if chain.loops == 1:
        yield message("Joints: {counts}, one independent loop", counts=counts)
    else:
        yield message("Joints: {counts}, {loops} independent loops", counts=counts, loops=chain.loops)
    for links in sorted({len(joint.links) for joint in chain.multiple_joints}):
        alike = [k for k, joint in enumerate(chain.joints) if len(joint.links) == links]
        gaps = {"joints": _list(names, alike), "links": links, "count": links - 1}
        if len(alike) > 1:
            yield message("The joints {joints} join {links} links each and count as {count} joints each.", **gaps)
        else:
            yield message("The joint {joints} joins {links} links and counts as {count} joints.", **gaps)


def _numbers(report: MobilityReport) -> Iterator[Message]:
    yield message("Count: {formula}", formula=report.count.formula())
    space = report.chain.space
    if report.count.b != space.b:
        yield _OTHER_COUNTS[space].filled(b=report.count.b, own=space.b)
    criterion = report.count.criterion()
    if report.counted == 1:
        yield message("Criterion of constrained motion: {criterion}. It holds.", criterion=criterion)
    else:
        yield message("Criterion of constrained motion: {criterion}, not 0.", criterion=criterion)
    if report.exact:
        line = message("Generic mobility (almost all sizes): {generic}, proved.", generic=report.generic)
    else:
        line = message(
            "Generic mobility (almost all sizes): {generic}, by rank at two random placements (chance of error below "
            "{bound:.0e}).",
            generic=report.generic,
            bound=report.error_bound,
        )
    yield joined([line, _count_and_rank(report)], " ") if report.count.b == space.b else line
    yield message("Verdict: {verdict}. {meaning}", verdict=_VERDICTS[report.verdict], meaning=_meaning(report))


def _meaning(report: MobilityReport) -> Message:
    if report.verdict is Verdict.OVERCONSTRAINED:
        return joined([_OVERCONSTRAINED, _ASSEMBLED[report.generic > 0]], " ")
    planar = report.chain.space is Space.PLANAR
    touching = planar and max(report.chain.joints_by_freedom, default=1) > 1
    examples = [_CRANKS] * (planar and report.chain.loops > 1) + [_CONTACT] * touching
    return _MEANINGS[report.verdict].filled(mobility=report.generic, examples=joined(examples or [_AXIS], ", "))


def _count_and_rank(report: MobilityReport) -> Message:
    if report.redundancy:
        text = message("The count is off by {difference}, the number of redundant constraints.")
        return text.filled(difference=report.redundancy)
    if report.generic and report.rigid_clusters:
        return message("The sum is right, but the chain is not sound: see below.")
    return message("The count is correct.")


def _details(report: MobilityReport, names: Sequence[str]) -> Iterator[Message]:
    chain = report.chain
    for part in report.overconstrained:
        yield _overconstrained(part, names)
    if len(report.rigid_clusters) == 1 and len(report.rigid_clusters[0]) == chain.n:
        yield message("At almost all sizes all links are rigid against each other: none of the joints can move.")
    else:
        for cluster in report.rigid_clusters:
            links = ", ".join(link for link in chain.links if link in cluster)
            yield message("Rigid against each other: {links}.", links=links)
        if report.immobile_joints:
            joints = _list(names, report.immobile_joints)
            yield message("Joints that cannot move at almost all sizes: {joints}.", joints=joints)
    for idle in report.idle_freedoms:
        yield _idle(idle, report.generic)
    for link, count in chain.degrees.items():
        if count == 1:
            yield message("{link} has a single joint; its freedom there affects no other link.", link=link)


def _idle(idle: IdleFreedom, generic: int) -> Message:
    if len(idle.links) > 1:
        text = message(
            "Idle: {links} turn as one body about the line through their two ball joints; it changes nothing else."
        )
        return text.filled(links=", ".join(idle.links))
    if idle.when is IdleCondition.ALWAYS:
        text = message(
            "Idle: {link} has {freedoms} of the {generic} freedoms for itself alone; it changes nothing else."
        )
        return text.filled(link=idle.links[0], freedoms=idle.freedoms, generic=generic)
    text = message("Idle if round: {link} spins without effect when its contour is a circle about its pin.")
    return text.filled(link=idle.links[0])


def _overconstrained(part: Overconstrained, names: Sequence[str]) -> Message:
    links = ", ".join(part.links)
    if not part.minimal:
        text = message("Overconstrained as a whole, not decomposed further: links {links} by {redundancy}.")
        return text.filled(links=links, redundancy=part.redundancy)
    line = message(
        "Overconstrained: links {links} by {redundancy}, at the joints {joints}.",
        links=links,
        redundancy=part.redundancy,
        joints=_list(names, part.joints),
    )
    if part.resolved_by_freeing == part.resolved_by_removing == part.joints:
        remedy = message(
            "One more freedom at any one of these joints resolves it, and so does removing any one of them."
        )
    elif part.resolved_by_removing == part.joints:
        remedy = message("Removing any one of these joints resolves it.")
    elif part.resolved_by_removing:
        remedy = message("Removing one of {joints} resolves it.", joints=_list(names, part.resolved_by_removing))
    else:
        remedy = message("No single joint resolves it: {redundancy} freedoms are missing.", redundancy=part.redundancy)
    return joined([line, remedy], " ")


def _list(names: Sequence[str], numbers: Sequence[int]) -> str:
    return ", ".join(names[k] for k in numbers)
