"""Searches by access features: matching entries, contradictory queries, and all matching structures.

docs/theory/access-features.md has the definitions, and the laws that a query may contradict.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import count, groupby
from typing import TYPE_CHECKING, Any

from gruebler.base.errors import GrueblerError, PairError
from gruebler.base.text import Text, arity, in_every_language
from gruebler.files.catalog_records import Entry
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import Pair
from gruebler.structure.chain.spaces import Space
from gruebler.structure.chain.symbols import read_symbols
from gruebler.structure.mechanism import Mechanism, check_drives
from gruebler.structure.mechanism.inversion import DrivenMechanism, driven_mechanisms, inversions
from gruebler.structure.mobility import counted
from gruebler.structure.type_synthesis import Requirements, expected_seconds_of_variants, typed_chains
from gruebler.teaching.catalog.features import AccessFeatures, access_features

if TYPE_CHECKING:
    from gruebler.structure.atlas import Atlas

_SAME = ("links", "drive_joints", "drive_joints_at_frame", "output_links", "output_links_at_frame")
_EXCHANGED = ("prismatic", "rolling", "roll_slide")  # the pairs with which the enumeration replaces revolutes


@dataclass(frozen=True, slots=True, kw_only=True)
class FeatureQuery:
    """Required access features; None and empty mean no requirement.

    Raises `GrueblerError` for features that contradict each other.
    """

    links: int | None = None
    mobility: int | None = None
    """F by the count."""
    drive_joints: int | None = None
    drive_joints_at_frame: int | None = None
    output_links: int | None = None
    output_links_at_frame: int | None = None
    pairs: tuple[tuple[Pair, int], ...] = ()
    """The exact numbers of joints of these kinds, a joint of k links counted k - 1 times."""
    kinds: tuple[tuple[int, int], ...] = ()
    """Number of joints on a link, exact number of such links."""
    multiple_joints: int | None = None

    def __post_init__(self) -> None:
        for name in (*_SAME, "multiple_joints"):
            if (value := getattr(self, name)) is not None and value < 0:
                raise GrueblerError(
                    "{feature}: expected 0 or more, but found {number}", feature=name.replace("_", " "), number=value
                )
        for name in ("drive_joints", "output_links"):
            total, part = getattr(self, name), getattr(self, f"{name}_at_frame")
            if total is not None and part is not None and part > total:
                raise GrueblerError(
                    "{total} drive joints cannot be {part} at the frame"
                    if name == "drive_joints"
                    else "{total} output links cannot be {part} at the frame",
                    total=total,
                    part=part,
                )
        for k, number in self.kinds:
            if number < 0:
                raise GrueblerError(
                    "the number of links with {joints} joints is 0 or more, not {number}", joints=k, number=number
                )
        total = sum(number for _, number in self.kinds)
        if self.links is not None and total > self.links:
            raise GrueblerError(
                "{links} links cannot be {kinds} links: those are {total}",
                links=self.links,
                kinds=_in_words(self.kinds),
                total=total,
            )

    def fits(self, mechanism: Mechanism, features: AccessFeatures) -> bool:
        """Whether the mechanism with these features satisfies the query."""
        chain = mechanism.chain
        for name in ("drive_joints", "output_links"):
            if (
                getattr(self, f"{name}_at_frame") is not None
                and getattr(self, name) is None
                and not getattr(features, name)
            ):
                return False
        by_pair, by_joints = dict(features.joints_by_pair), dict(features.links_by_joints)
        multiple = sum(joint.count > 1 for joint in chain.joints)
        return (
            all(getattr(self, name) in (None, getattr(features, name)) for name in _SAME)
            and all(by_pair.get(kind, 0) == number for kind, number in self.pairs)
            and all(by_joints.get(k, 0) == number for k, number in self.kinds)
            and self.multiple_joints in (None, multiple)
            and self.mobility in (None, counted(chain))
        )


def read_pairs(text: str) -> tuple[tuple[Pair, int], ...]:
    """Kinds of joints with their numbers, in one alphabet.

    >>> read_pairs("D:4,S:0")
    ((<pair revolute>, 4), (<pair prismatic>, 0))
    """
    numbers = {}
    for part in text.split(","):
        symbol, colon, number = (piece.strip() for piece in part.partition(":"))
        if not symbol or not colon or not number.isdecimal():
            raise GrueblerError(
                "{query!r}: expected joints with their numbers such as R:4,P:0, but found {part!r}",
                query=text,
                part=part,
            )
        if symbol in numbers:
            raise GrueblerError("{query!r}: {symbol} is given twice", query=text, symbol=symbol)
        numbers[symbol] = int(number)
    try:
        read = read_symbols(numbers, Space.PLANAR)
    except PairError:
        read = read_symbols(numbers, Space.SPATIAL)
    return tuple((read[symbol], number) for symbol, number in numbers.items())


# --- entries of the catalog --------------------------------------------------------------------------


def entry_mechanism(entry: Entry) -> Mechanism:
    """The mechanism of an entry; for a machine without a drive with the drive of its dimensions."""
    chain = entry.chain()
    shown = () if entry.dimensions is None else entry.dimensions.shown_drives
    return Mechanism(chain, entry.frame or chain.links[0], entry.drives or shown)


def entry_features(entry: Entry) -> AccessFeatures:
    """The access features of an entry."""
    return access_features(entry_mechanism(entry), entry.outputs)


def features_to_json(features: AccessFeatures) -> dict[str, Any]:
    """Access features as plain data; kinds of joints by name."""
    return {name: getattr(features, name) for name in (*_SAME, "joints")} | {
        "links_by_joints": {str(k): number for k, number in features.links_by_joints},
        "joints_by_pair": {kind.name: number for kind, number in features.joints_by_pair},
    }


# --- every structure ---------------------------------------------------------------------------------


def structures(query: FeatureQuery, atlas: Atlas | None = None, where: str = "") -> Iterator[DrivenMechanism]:
    """Every planar mechanism that satisfies the query, each once, lazily.

    Inversions if the query has no requirement on drives and outputs; else mechanisms with as many drives as their
    mobility (1 by default) that fix the motion, and with an output link if the query has one. Only revolutes and the
    kinds of joints named in the query occur, and joints of more than two links only if the query has them.

    Args:
        query: the features.
        atlas: where to take the chains from; without one they are enumerated. The structures are the same,
            with links numbered as in the canonical codes of the chains.
        where: a condition in SQL on the columns of the atlas: of its chains and its mechanisms, or of its driven
            mechanisms if the drives of the query are at the frame.

    Raises `GrueblerError` with the reason if no mechanism can satisfy the query, if the atlas does not have all these
    chains, and for a condition without an atlas.

    >>> query = FeatureQuery(links=4, drive_joints=1, output_links=1, output_links_at_frame=0, pairs=read_pairs("D:4"))
    >>> [str(driven.mechanism.chain) for driven in structures(query)]
    ['R(0-1) R(1-2) R(2-3) R(3-0)', 'R(0-1) R(1-2) R(2-3) R(3-0)']
    """
    requirements = _requirements(query)
    _check_roles(query, requirements.mobility)
    if atlas is not None:
        return _structures_of_atlas(query, requirements, atlas, where)
    if where:
        raise GrueblerError("a condition on columns needs an atlas")
    return (driven for chain in typed_chains(requirements) for driven in _fitting(chain, query, requirements.mobility))


def _fitting(chain: Chain, query: FeatureQuery, mobility: int) -> Iterator[DrivenMechanism]:
    """The mechanisms of a chain that satisfy the query."""
    for driven in _mechanisms(chain, query, mobility):
        if query.fits(driven.mechanism, access_features(driven.mechanism, _outputs(driven))):
            yield driven


def _structures_of_atlas(
    query: FeatureQuery, requirements: Requirements, atlas: Atlas, where: str
) -> Iterator[DrivenMechanism]:
    links, mobility = requirements.links, requirements.mobility
    numbers = (links, mobility, requirements.prismatic, requirements.multiple_joints)
    if requirements.rolling or requirements.roll_slide or not atlas.covers(*numbers):
        raise GrueblerError("the atlas in {directory} does not have all these chains", directory=atlas.directory)
    columns = ("links", "mobility", "prismatic", "multiple_joints")
    conditions = [f"chains.{name} = {number}" for name, number in zip(columns, numbers, strict=True)]
    if requirements.assortment is not None:
        conditions.append(f"assortment = '{','.join(map(str, requirements.assortment))}'")
    if where:
        conditions.append(f"({where}\n)")
    text = " and ".join(conditions)
    table = _mechanisms_in(atlas, query, requirements)
    if not where or table is None:
        for chain in atlas.chains(text):
            yield from _fitting(chain, query, mobility)
        return
    # which mechanisms of a chain meet the condition: the atlas and `_mechanisms` take the same one of each orbit
    drives = ", drives" if table == "driven" else ""
    sql = (
        f"select chain, frame{drives} from (select code as chain, * exclude (drives) from chains) as chains "
        f"join {table} using (chain, links, mobility) where {text} order by chain"
    )
    rows = (each.mechanism for each in atlas.structures(sql) if isinstance(each, DrivenMechanism))
    for chain, mechanisms in groupby(rows, key=lambda mechanism: mechanism.chain):
        wanted = set(mechanisms)
        for driven in _fitting(chain, query, mobility):
            if driven.mechanism in wanted:
                yield driven


def _mechanisms_in(atlas: Atlas, query: FeatureQuery, requirements: Requirements) -> str | None:
    """The table of the atlas that has all mechanisms of the query, or None."""
    table = "driven" if _about_drives(query) else "mechanisms"
    if table not in atlas.tables or (table == "driven" and query.drive_joints_at_frame != requirements.mobility):
        return None
    partitions = atlas.manifest["tables"][table]["partitions"]
    numbers = (requirements.links, requirements.mobility)
    return table if any((row["links"], row["mobility"]) == numbers for row in partitions) else None


def structures_time(query: FeatureQuery) -> float:
    """The estimated time of `structures` for all results, in seconds."""
    requirements = _requirements(query)
    return expected_seconds_of_variants(requirements, mechanisms=True, drives=_about_drives(query))


def _about_output(query: FeatureQuery) -> bool:
    return query.output_links == 1 or query.output_links_at_frame is not None


def _about_drives(query: FeatureQuery) -> bool:
    about = bool(query.drive_joints) or query.drive_joints_at_frame is not None or _about_output(query)
    return about and query.drive_joints != 0


def _outputs(driven: DrivenMechanism) -> tuple[str, ...]:
    return () if driven.output is None else (driven.output,)


def _mechanisms(chain: Chain, query: FeatureQuery, mobility: int) -> Iterator[DrivenMechanism]:
    if not _about_drives(query):
        yield from (DrivenMechanism(mechanism) for mechanism in inversions(chain))
        return
    at_frame = query.drive_joints_at_frame == mobility
    fixed: dict[Mechanism, bool] = {}
    for driven in driven_mechanisms(chain, drives=mobility, at_frame=at_frame, output=_about_output(query)):
        mechanism = driven.mechanism
        if mechanism not in fixed:
            fixed[mechanism] = check_drives(mechanism).fixed
        if fixed[mechanism]:
            yield driven


def _check_roles(query: FeatureQuery, mobility: int) -> None:
    if query.drive_joints not in (None, 0, mobility):
        raise GrueblerError(
            "mobility {mobility} needs as many drives, not {drive_joints} drive joints",
            mobility=mobility,
            drive_joints=query.drive_joints,
        )
    if (query.drive_joints_at_frame or 0) > mobility:
        raise GrueblerError(
            "mobility {mobility} needs as many drives; {drive_joints} are too many",
            mobility=mobility,
            drive_joints=query.drive_joints_at_frame,
        )
    if max(query.output_links or 0, query.output_links_at_frame or 0) > 1:
        raise GrueblerError("mechanisms are enumerated with one output link at most")
    if query.drive_joints == 0 and (query.output_links or query.output_links_at_frame is not None):
        raise GrueblerError("an output link takes a drive; 0 drive joints leave it without one")


def _requirements(query: FeatureQuery) -> Requirements:
    """The requirements for the enumeration; raises for contradictory links, mobility, joints and kinds of links."""
    if query.links is None:
        raise GrueblerError("to enumerate mechanisms, the number of links is needed")
    links, mobility = query.links, 1 if query.mobility is None else query.mobility
    if links < 3 or mobility < 0:
        raise GrueblerError(
            "mechanisms are enumerated from 3 links and F = 0, not with {links} links and F = {mobility}",
            links=links,
            mobility=mobility,
        )
    numbers = {kind.name: number for kind, number in query.pairs}
    for name, number in numbers.items():
        if number and name not in ("revolute", *_EXCHANGED):
            raise GrueblerError(
                "planar mechanisms are enumerated with R, P, W and G joints, not with {name}", name=name
            )
    contacts = numbers.get("roll_slide", 0)
    constraints = 3 * (links - 1) - mobility  # 2 g1 + g2
    request = {"links": links, "mobility": mobility, "contacts": contacts}
    if (constraints - contacts) % 2:
        raise GrueblerError(
            "{links} links with F = {mobility}: 3(n - 1) - F = 2 g1 + g2 = {taken}, which no g1 gives with g2 "
            "= {contacts} roll-slide joints",
            taken=constraints,
            **request,
        )
    g1 = (constraints - contacts) // 2
    exchanged = sum(numbers.get(name, 0) for name in ("prismatic", "rolling"))
    if g1 < exchanged or numbers.get("revolute", g1 - exchanged) != g1 - exchanged:
        requested = exchanged + numbers.get("revolute", 0)
        raise GrueblerError(
            "{links} links with F = {mobility} and {contacts} roll-slide joints have g1 = {g1}, but {given} "
            "such joints are asked for: name the kinds of the other {missing}"
            if requested < g1
            else "{links} links with F = {mobility} and {contacts} roll-slide joints have g1 = {g1}, but {given} such "
            "joints are asked for",
            g1=g1,
            given=requested,
            missing=g1 - requested,
            **request,
        )
    _check_kinds(query, g1 + contacts)
    complete = sum(number for _, number in query.kinds) == links
    return Requirements(
        links=links,
        mobility=mobility,
        prismatic=numbers.get("prismatic", 0),
        rolling=numbers.get("rolling", 0),
        roll_slide=contacts,
        assortment=_assortment(query.kinds) if complete else None,
        multiple_joints=query.multiple_joints or 0,
    )


def _check_kinds(query: FeatureQuery, joints: int) -> None:
    """2 g = sum of i n_i, if every joint joins two links."""
    if query.links is None or query.multiple_joints or not query.kinds:
        return
    others = query.links - sum(number for _, number in query.kinds)
    fewest = next(k for k in count(2) if k not in dict(query.kinds))
    elements = fewest * others + sum(k * number for k, number in query.kinds)
    if elements > 2 * joints or (not others and elements != 2 * joints):
        raise GrueblerError(
            "{kinds} links and {others} more with at least {fewest} joints have {elements} joint elements, but {links} "
            "links take {joints} joints, so 2 g = {twice}"
            if others
            else "{kinds} links have {elements} joint elements, but {links} links take {joints} joints, so 2 g = "
            "{twice}",
            kinds=_in_words(query.kinds),
            others=others,
            fewest=fewest,
            elements=elements,
            links=query.links,
            joints=joints,
            twice=2 * joints,
        )


def _in_words(kinds: tuple[tuple[int, int], ...]) -> Text:
    """The numbers of links of each kind: 4 binary, 2 ternary."""
    return in_every_language(lambda lang: ", ".join(f"{count} {arity(k, lang)}" for k, count in kinds))


def _assortment(kinds: tuple[tuple[int, int], ...]) -> tuple[int, ...]:
    numbers = dict(kinds)
    return tuple(numbers.get(k, 0) for k in range(2, max(k for k, n in kinds if n) + 1))
