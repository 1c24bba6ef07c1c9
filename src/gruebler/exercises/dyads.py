"""Chains extended by a dyad or a coupler: how F changes, and how many different chains there are, step by step."""

from __future__ import annotations

from collections.abc import Mapping

from gruebler.chain import Chain
from gruebler.exercises.solution import Solution, SolutionBuilder, SolutionStep, Value
from gruebler.mechanism import Mechanism
from gruebler.mechanism.inversion import family
from gruebler.mobility import count_freedoms, counted, mobility_report
from gruebler.text import Text
from gruebler.transformations import Extension, extend

__all__ = ["coupler", "dyad"]

_BEFORE = Text("degree of freedom before", "Freiheitsgrad vorher")
_AFTER = Text("degree of freedom after", "Freiheitsgrad nachher")

_CHANGES = {0: Text("unchanged", "unverändert"), -1: Text("lowered by one", "um eins erniedrigt")}


def dyad(chain: str, form: str = "RRR") -> Solution:
    """A chain extended by a dyad in every essentially different way.

    >>> dyad("R(1-2) R(2-3) R(3-4) R(1-4)")["chains"]
    2
    """
    builder = SolutionBuilder()
    start = Chain.parse(chain)
    before = _add_before(builder, start)
    builder.say(
        "A dyad brings two links and three joints with f = 1:",
        "Ein Zweischlag bringt zwei Glieder und drei Gelenke mit f = 1:",
        "ΔF = 3·2 - 2·3 = 0",
    )
    extensions = extend(start, dyad=form)
    _add_after(builder, start, extensions)
    builder.say("A dyad leaves F unchanged.", "Ein Zweischlag lässt F unverändert.")
    hint = (
        "Besides the two links three joints are added: 3·2 - 2·3 = 0.",
        "Zu den zwei Gliedern kommen drei Gelenke: 3·2 - 2·3 = 0.",
    )
    builder.mistake(
        "F_after",
        before - 2,
        "Two links without a joint between them are two couplers; in a dyad they are joined.",
        "Zwei Glieder ohne gemeinsames Gelenk sind zwei Koppeln; im Zweischlag sind sie verbunden.",
    )
    builder.mistake("F_after", before + 2, *hint)
    builder.mistake("F_after", before + 6, *hint)
    _add_places(builder, extensions)
    return builder.done()


def coupler(chain: str) -> Solution:
    """A chain extended by a coupler in every essentially different way; those that lock a loop are told apart.

    >>> coupler("R(1-2) R(2-3) R(3-4) R(4-5) R(1-5)")["F_after"]
    1
    """
    builder = SolutionBuilder()
    start = Chain.parse(chain)
    before = _add_before(builder, start)
    builder.say(
        "A coupler brings one link and two joints with f = 1:",
        "Eine Koppel bringt ein Glied und zwei Gelenke mit f = 1:",
        "ΔF = 3·1 - 2·2 = -1",
    )
    extensions = extend(start, coupler="RR")
    sound = [extension for extension in extensions if not mobility_report(extension.chain).rigid_clusters]
    _add_after(builder, start, sound)
    builder.say("A coupler lowers F by one.", "Eine Koppel erniedrigt F um eins.")
    for one in extensions:
        if one not in sound:
            builder.say(
                f"Between {' and '.join(map(str, one.places[0]))} it makes a rigid triangle: these links become one.",
                f"Zwischen {' und '.join(map(str, one.places[0]))} entsteht ein starres Dreieck: Die Glieder werden "
                "zu einem.",
            )
    builder.mistake(
        "F_after",
        before,
        "That holds for a dyad; a coupler takes one away.",
        "Das gilt für den Zweischlag; eine Koppel nimmt einen Freiheitsgrad weg.",
    )
    builder.mistake(
        "F_after",
        before + 1,
        "The coupler has two joints, and each takes two freedoms: 3 - 4 = -1.",
        "Die Koppel hat zwei Gelenke, jedes nimmt zwei Freiheiten: 3 - 4 = -1.",
    )
    _add_places(builder, sound)
    return builder.done()


def _numbered(start: Chain, extended: Chain) -> Chain:
    """With new links that go on counting, where the links are numbers."""
    if not all(link.isdigit() for link in start.links):
        return extended
    last = max(map(int, start.links))
    new = [link for link in extended.links if link not in start.links]
    return extended.renamed({link: str(last + k) for k, link in enumerate(new, 1)})


def _add_before(builder: SolutionBuilder, start: Chain) -> int:
    parts = count_freedoms(start).formula().removeprefix("F = ").split(" = ")
    builder.parts.append(
        SolutionStep(
            Text(f"Before: {start}", f"Vorher: {start.text('german')}"), f"F = {parts[0]}", parts[1], counted(start)
        )
    )
    builder.keep("F_before", _BEFORE, counted(start), symbol="F")
    return counted(start)


def _add_after(builder: SolutionBuilder, start: Chain, found: list[Extension]) -> None:
    first = found[0].chain
    parts = count_freedoms(first).formula().removeprefix("F = ").split(" = ")
    builder.parts.append(SolutionStep(_AFTER, f"F = {parts[0]}", parts[1], counted(first)))
    builder.keep("F_after", _AFTER, counted(first), symbol="F'")
    change = counted(first) - counted(start)
    builder.keep("change", Text("change of F", "Änderung von F"), _CHANGES.get(change, str(change)), symbol="ΔF")
    builder.keep("n", Text("links after", "Glieder nachher"), first.n)
    builder.keep("g1", Text("joints with f = 1 after", "Gelenke mit f = 1 nachher"), first.joints_by_freedom.get(1, 0))
    builder.keep(
        "chains", Text("essentially different chains", "wesentlich verschiedene Ketten"), len(found), symbol="k"
    )
    rows: list[tuple[Value, ...]] = []
    for extension in found:
        name = family(Mechanism(extension.chain, extension.chain.links[0]))
        shown = _numbered(start, extension.chain)
        rows.append((name.split()[0] if name else "", Text(str(shown), shown.text("german")), len(extension.places)))
    agreeing = sum(counted(one.chain) == mobility_report(one.chain).generic for one in found)
    builder.check(
        "Chains, and those whose F agrees with the rank of the constraints at random sizes",
        "Ketten, und solche, deren F mit dem Rang der Bindungen bei zufälligen Abmessungen übereinstimmt",
        float(len(found)),
        float(agreeing),
        "",
    )
    builder.check(
        "Different chains by canonical codes, and by comparing graphs pair by pair",
        "Verschiedene Ketten nach kanonischen Codes, und durch paarweisen Vergleich der Graphen",
        float(len(found)),
        float(_classes(found)),
        "",
    )
    headers = (Text("name", "Name"), Text("chain", "Kette"), Text("places", "Stellen"))
    builder.table(Text("The different chains", "Die verschiedenen Ketten"), headers, rows)


def _add_places(builder: SolutionBuilder, found: list[Extension]) -> None:
    builder.mistake(
        "chains",
        sum(len(extension.places) for extension in found),
        "Many places give the same chain up to the names of its links.",
        "Viele Stellen ergeben bis auf die Namen der Glieder dieselbe Kette.",
    )


def _same_pairs(some: Mapping[object, Mapping[str, str]], others: Mapping[object, Mapping[str, str]]) -> bool:
    """Whether the same kinds of joints lie between two links."""
    mine, theirs = (sorted(joint["pair"] for joint in joints.values()) for joints in (some, others))
    return mine == theirs


def _classes(found: list[Extension]) -> int:
    """How many of the chains are different, each compared with each."""
    import networkx as nx

    kept: list[nx.MultiGraph] = []
    for extension in found:
        graph = extension.chain.link_graph()
        if not any(nx.is_isomorphic(graph, other, edge_match=_same_pairs) for other in kept):
            kept.append(graph)
    return len(kept)
