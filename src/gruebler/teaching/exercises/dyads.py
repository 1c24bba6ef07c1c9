"""Chains extended by a dyad or a coupler: the change of F and the number of different chains, step by step."""

from __future__ import annotations

from collections.abc import Mapping

from gruebler.base.text import joined_by_and, message
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import in_alphabets
from gruebler.structure.mechanism import Mechanism
from gruebler.structure.mechanism.inversion import family
from gruebler.structure.mobility import count_freedoms, counted, mobility_report
from gruebler.structure.transformations import Extension, extend
from gruebler.teaching.exercises.mobility import add_frame_mistakes
from gruebler.teaching.exercises.solution import Solution, SolutionBuilder, SolutionStep, Value

_BEFORE = message("mobility before")
_AFTER = message("mobility after")

CHANGES = {0: message("unchanged"), -1: message("lowered by one"), 1: message("raised by one")}
"""What may become of F."""


def dyad(chain: str, form: str = "RRR") -> Solution:
    """All essentially different extensions of a chain by a dyad.

    >>> dyad("R(1-2) R(2-3) R(3-4) R(1-4)")["chains"]
    2
    """
    builder = SolutionBuilder()
    start = Chain.parse(chain)
    before = _add_before(builder, start)
    builder.say("A dyad brings two links and three joints with f = 1:", "ΔF = 3·2 - 2·3 = 0")
    extensions = extend(start, dyad=form)
    _add_after(builder, start, extensions)
    builder.say("A dyad leaves F unchanged.")
    hint = message("Besides the two links three joints are added: 3·2 - 2·3 = 0.")
    builder.mistake(
        "F_after",
        before - 2,
        message("Two links without a joint between them are two couplers; in a dyad they are joined."),
    )
    builder.mistake("F_after", before + 2, hint)
    builder.mistake("F_after", before + 6, hint)
    builder.mistake("change", CHANGES[-1], message("That holds for a coupler: one link, two joints, 3 - 4 = -1."))
    builder.mistake("change", CHANGES[1], hint)
    _add_places(builder, extensions)
    return builder.done()


def coupler(chain: str) -> Solution:
    """All essentially different extensions of a chain by a coupler; those that lock a loop are listed separately.

    >>> coupler("R(1-2) R(2-3) R(3-4) R(4-5) R(1-5)")["F_after"]
    1
    """
    builder = SolutionBuilder()
    start = Chain.parse(chain)
    before = _add_before(builder, start)
    builder.say("A coupler brings one link and two joints with f = 1:", "ΔF = 3·1 - 2·2 = -1")
    extensions = extend(start, coupler="RR")
    sound = [extension for extension in extensions if not mobility_report(extension.chain).rigid_clusters]
    _add_after(builder, start, sound)
    builder.say("A coupler lowers F by one.")
    for extension in extensions:
        if extension not in sound:
            links = joined_by_and(extension.places[0])
            builder.say("Between {links} it makes a rigid triangle: these links become one.", links=links)
    for key, by_dyad, more in (("F_after", before, before + 1), ("change", CHANGES[0], CHANGES[1])):
        builder.mistake(key, by_dyad, message("That holds for a dyad; a coupler takes one away."))
        builder.mistake(key, more, message("The coupler has two joints, and each removes two freedoms: 3 - 4 = -1."))
    _add_places(builder, sound)
    return builder.done()


def _numbered(start: Chain, extended: Chain) -> Chain:
    """The extended chain with the next numbers for its new links, where the links are numbers."""
    if not all(link.isdigit() for link in start.links):
        return extended
    last = max(map(int, start.links))
    new = [link for link in extended.links if link not in start.links]
    return extended.renamed({link: str(last + k) for k, link in enumerate(new, 1)})


def _add_before(builder: SolutionBuilder, start: Chain) -> int:
    parts = count_freedoms(start).formula().removeprefix("F = ").split(" = ")
    before = message("Before: {chain}", chain=in_alphabets(start.text))
    builder.parts.append(SolutionStep(text=before, formula=f"F = {parts[0]}", numbers=parts[1], value=counted(start)))
    builder.keep("F_before", _BEFORE, counted(start), symbol="F")
    add_frame_mistakes(builder, "F_before", start)
    return counted(start)


def _add_after(builder: SolutionBuilder, start: Chain, extensions: list[Extension]) -> None:
    first = extensions[0].chain
    parts = count_freedoms(first).formula().removeprefix("F = ").split(" = ")
    builder.parts.append(SolutionStep(text=_AFTER, formula=f"F' = {parts[0]}", numbers=parts[1], value=counted(first)))
    builder.keep("F_after", _AFTER, counted(first), symbol="F'")
    change = counted(first) - counted(start)
    builder.keep("change", message("change of F"), CHANGES.get(change, str(change)), symbol="ΔF")
    builder.keep("n", message("links after"), first.n)
    builder.keep("g1", message("joints with f = 1 after"), first.joints_by_freedom.get(1, 0))
    builder.keep("chains", message("essentially different chains"), len(extensions), symbol="k")
    rows: list[tuple[Value, ...]] = []
    for extension in extensions:
        name = family(Mechanism(extension.chain, extension.chain.links[0]))
        shown = _numbered(start, extension.chain)
        rows.append((name.split()[0] if name else "", in_alphabets(shown.text), len(extension.places)))
    agreeing = sum(counted(extension.chain) == mobility_report(extension.chain).generic for extension in extensions)
    builder.check(
        "Chains whose F agrees with the rank of the constraints at random sizes",
        float(len(extensions)),
        float(agreeing),
        "",
    )
    builder.check(
        "Different chains, by comparing graphs pair by pair",
        float(len(extensions)),
        float(_classes(extensions)),
        "",
    )
    headers = (message("name"), message("chain"), message("places"))
    builder.table(message("The different chains"), headers, rows)


def _add_places(builder: SolutionBuilder, extensions: list[Extension]) -> None:
    builder.mistake(
        "chains",
        sum(len(extension.places) for extension in extensions),
        message("Many places give the same chain up to the names of its links."),
    )


def _same_pairs(first: Mapping[object, Mapping[str, str]], second: Mapping[object, Mapping[str, str]]) -> bool:
    """Whether the same kinds of joints lie between two links."""
    first_pairs, second_pairs = (sorted(joint["pair"] for joint in joints.values()) for joints in (first, second))
    return first_pairs == second_pairs


def _classes(extensions: list[Extension]) -> int:
    """The number of different chains, by pairwise comparison."""
    import networkx as nx

    different: list[nx.MultiGraph] = []
    for extension in extensions:
        graph = extension.chain.link_graph()
        if not any(nx.is_isomorphic(graph, other, edge_match=_same_pairs) for other in different):
            different.append(graph)
    return len(different)
