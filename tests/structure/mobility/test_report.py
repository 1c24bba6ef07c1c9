"""What the report says of known chains, and that it says it in both languages."""

import json

import pytest
from hypothesis import given, settings

from gruebler import Chain, GrueblerError
from gruebler.base.errors import ChainError
from gruebler.base.text import error_in_language
from gruebler.cli.check import explanation
from gruebler.structure.mobility import mobility_report
from gruebler.structure.mobility.idle import IdleCondition
from gruebler.structure.mobility.report import _MEANINGS, _VERDICTS, Verdict
from gruebler.teaching.catalog import check_entry, entry
from tests.strategies import SPATIAL, chains

VEE = "R(frame-crank) R(crank-conrod1-conrod2) R(conrod1-piston1) R(conrod2-piston2) P(frame-piston1) P(frame-piston2)"

# text, counted, generic, verdict
KNOWN = [
    (VEE, 1, 1, "constrained"),
    ("R(0-1) R(0-2) R(0-3) R(3-4) G(1-4) G(2-4)", 2, 2, "movable"),
    ("spherical: R(0-1) R(0-2) R(0-3) R(3-4) G(1-4) G(2-4)", 2, 2, "movable"),
    ("R(0-1) R(1-2) R(2-0)", 0, 0, "rigid"),
    ("P(0-1) P(1-2) P(2-0)", 0, 1, "overconstrained"),
    ("R(0-1) R(1-2) R(2-3) P(3-0)", 1, 1, "constrained"),
    ("R(0-1) P(1-2) P(2-3) R(3-0)", 1, 1, "constrained"),
    ("R(0-1) P(1-2) P(2-3) P(3-0)", 1, 1, "partly_rigid"),
    # a braced four-bar with a pentagon hung on it: the sum is 1, and a constraint is redundant
    ("R(0-1) R(1-2) R(2-3) R(3-0) R(0-2) R(3-4) R(4-5) R(5-6) R(6-7) R(7-3)", 1, 2, "overconstrained"),
    # a triangle in a five-bar: the sum is 1, nothing is redundant, three links are one body
    ("R(0-1) R(1-2) R(2-0) R(0-3) R(3-4) R(4-1)", 0, 0, "rigid"),
    ("R(0-1) R(1-2) R(2-0) R(0-3) R(3-4) R(4-5) R(5-1)", 1, 1, "partly_rigid"),
    ("spatial: R(0-1) R(1-2) R(2-3) R(3-4) R(4-5) R(5-6) R(6-0)", 1, 1, "constrained"),
    ("spatial: R(0-1) R(1-2) R(2-3) R(3-0)", -2, 0, "overconstrained"),
    # three rods end to end between balls: every freedom is a spin
    ("spatial: spherical(a-b) spherical(b-c) spherical(c-a)", 3, 3, "movable"),
]


@pytest.mark.parametrize(("text", "counted", "generic", "verdict"), KNOWN)
def test_known_chains(text, counted, generic, verdict):
    report = mobility_report(Chain.parse(text))
    assert (report.counted, report.generic, str(report.verdict)) == (counted, generic, verdict)
    json.dumps(report.to_json())


def test_a_sum_that_is_right_by_accident_is_not_passed():
    braced = mobility_report(Chain.parse(KNOWN[8][0]))
    assert braced.counted == 1
    (part,) = braced.overconstrained
    assert part.links == ("0", "1", "2", "3")
    assert part.redundancy == 1
    assert part.resolved_by_freeing == part.resolved_by_removing == part.joints == (0, 1, 2, 3, 4)
    assert braced.rigid_clusters == (("0", "1", "2", "3"),)
    assert braced.immobile_joints == (0, 1, 2, 3, 4)
    hidden = mobility_report(Chain.parse(KNOWN[10][0]))
    assert hidden.counted == hidden.generic == 1
    assert hidden.rigid_clusters == (("0", "1", "2"),)
    assert "The sum is right, but the chain is not sound" in hidden.explain()


def test_idle_freedoms():
    rod = mobility_report(Chain.parse("spatial: R(body-arm) S(arm-knuckle) R(knuckle-body) S(body-rod) S(rod-knuckle)"))
    assert [(i.links, i.freedoms, i.when) for i in rod.idle_freedoms] == [(("rod",), 1, IdleCondition.ALWAYS)]
    cam = Chain.parse("R(frame-cam) P(frame-tappet) R(tappet-roller) G(cam-roller)")
    assert [(i.links, i.when) for i in mobility_report(cam).idle_freedoms] == [(("roller",), IdleCondition.ROUND)]
    assert [(i.links, i.when) for i in mobility_report(cam, frame="tappet").idle_freedoms] == [
        (("cam",), IdleCondition.ROUND)
    ]
    gears = Chain.parse("R(frame-gear1) R(frame-gear2) G(gear1-gear2)")
    assert mobility_report(gears).idle_freedoms == ()
    with pytest.raises(ChainError, match=r"no link 'rame' \(did you mean 'frame'"):
        mobility_report(gears, frame="rame")


def test_every_verdict_has_its_sentence():
    assert _MEANINGS.keys() | {Verdict.OVERCONSTRAINED} == _VERDICTS.keys() == set(Verdict)


# What a verdict may say, by words of each language; nothing else in it speaks of sizes or drives.
EXACT = {"en": "fit together only with exact dimensions", "de": "passen nur bei exakten Maßen oder mit Spiel zusammen"}
SPECIAL = {"en": "special", "de": "Sonder"}
STILL = {"en": "othing moves", "de": "nichts"}
ONE_DRIVE = {"en": "One drive", "de": "Ein Antrieb"}


def said_in_the_verdict(report, lang):
    (line,) = (line for line in report.explain(lang).splitlines() if line.startswith(("Verdict:", "Urteil:")))
    return line


def contradictions(report, lang):
    """Where the sentence of the verdict and the numbers of the report exclude one another.

    The numbers decide: redundant constraints are equations between the sizes, which the assembly must meet; a generic
    mobility that is positive is a motion for almost all sizes (docs/theory/mobility.md, theorem of assembling).
    """
    line, redundant = said_in_the_verdict(report, lang), report.generic - report.counted
    expected = {
        EXACT[lang]: redundant > 0,
        SPECIAL[lang]: report.generic == 0,
        STILL[lang]: report.generic == 0,
        ONE_DRIVE[lang]: report.generic == 1 and not redundant and not report.rigid_clusters,
    }
    return [words for words, said in expected.items() if (words in line) != said]


@pytest.mark.parametrize("lang", ["en", "de"])
@pytest.mark.parametrize("text", [row[0] for row in KNOWN])
def test_the_verdict_says_what_the_numbers_say(text, lang):
    assert contradictions(mobility_report(Chain.parse(text)), lang) == []


@given(chains(most_links=6) | chains(most_links=5, pairs=SPATIAL, space="spatial"))
@settings(max_examples=60)
def test_no_verdict_contradicts_its_numbers(chain):
    assert contradictions(mobility_report(chain), "en") == contradictions(mobility_report(chain), "de") == []


# counted, generic and finite by hand; loco4 and winch_screw move by special sizes, the others by none
@pytest.mark.parametrize(
    ("name", "counted", "generic", "finite"),
    [("loco3", 0, 0, 1), ("loco4", -1, 0, 1), ("winch_screw", -3, 0, 1), ("quad", 1, 1, 1), ("diff", 2, 2, 2)],
)
def test_what_moves_only_by_special_sizes_is_said_to(name, counted, generic, finite):
    checked = check_entry(entry(name))
    assert checked.freedoms is not None
    assert (checked.report.counted, checked.report.generic, checked.freedoms.mobility) == (counted, generic, finite)
    line = said_in_the_verdict(checked.report, "en")
    assert (SPECIAL["en"] in line) == (finite > generic)
    assert ("Dimensions decide" in explanation(checked, "en")) == (finite > generic)


@pytest.mark.parametrize("lang", ["en", "de"])
@pytest.mark.parametrize("text", [row[0] for row in KNOWN])
def test_explanations_are_complete(text, lang):
    said = mobility_report(Chain.parse(text)).explain(lang)
    assert "{" not in said
    assert len(said.splitlines()) >= 6


def test_explanations_of_the_seeds_two_chains():
    vee = mobility_report(Chain.parse(VEE)).explain("de")
    assert "F = 3(n - 1) - 2 g1 = 3(6 - 1) - 2·7 = 1" in vee
    assert "verbindet 3 Glieder und zählt als 2 Gelenke" in vee
    triangle = Chain.parse("R(1-2) R(2-3-4) R(2-5-6) R(4-5-3) R(6-1)")
    said = mobility_report(triangle).explain()
    assert "join 3 links each and count as 2 joints each." in said  # three joints, one sentence
    assert "zwangläufig" in vee
    differential = mobility_report(Chain.parse(KNOWN[1][0])).explain()
    assert "F = 3(n - 1) - 2 g1 - g2 = 3(5 - 1) - 2·4 - 2 = 2" in differential
    with pytest.raises(GrueblerError, match=r"expected a language \(en, de\)"):
        mobility_report(Chain.parse(VEE)).explain("fr")


def test_a_part_too_large_to_decompose_is_returned_undivided():
    import networkx as nx

    report = mobility_report(Chain.from_edges(nx.complete_graph(20).edges))
    assert report.redundancy == 2 * 190 - 57
    assert [part.minimal for part in report.overconstrained] == [False]
    assert "not decomposed" in report.explain()


def test_a_chain_of_very_many_links_is_refused_with_its_size_unless_it_is_wanted(monkeypatch):
    from gruebler.structure.mobility import TooLargeError, rank

    ring = Chain.from_edges([(k, (k + 1) % 20) for k in range(20)])
    monkeypatch.setattr(rank, "_LARGEST", 40 * rank._BYTES_A_ROW - 1)
    with pytest.raises(TooLargeError, match="40 equations") as refused:
        mobility_report(ring)
    assert "40 Gleichungen" in error_in_language(refused.value, "de")
    assert mobility_report(ring, large=True).generic == 17


@pytest.mark.parametrize(
    "text",
    [
        "R(0-1) R(1-2) R(2-0) R(0-3) R(3-1)",  # more constraints than unknowns
        "P(0-1) P(1-2) P(2-0) R(2-3) R(3-4) R(4-5)",  # not more, but sliders have one too many
    ],
)
def test_constraints_that_depend_on_others_are_estimated_with_their_stresses(monkeypatch, text):
    from gruebler.structure.mobility import TooLargeError, rank

    chain = Chain.parse(text)
    rows = 2 * len(chain.joints)
    monkeypatch.setattr(rank, "_LARGEST", rows * rank._BYTES_WITH_STRESSES - 1)
    with pytest.raises(TooLargeError, match=f"{rows} equations"):
        mobility_report(chain)
    assert mobility_report(chain, large=True).redundancy == 1
    monkeypatch.setattr(rank, "_LARGEST", rows * rank._BYTES_WITH_STRESSES)
    assert mobility_report(chain).redundancy == 1


def test_an_overconstrained_chain_takes_no_more_memory_than_estimated():
    import tracemalloc

    from gruebler.structure.mobility import rank
    from gruebler.structure.mobility.rank import generic

    edges = [(0, 1), (1, 2), (2, 0)]
    for k in range(3, 1500, 2):  # dyads in a row, and a joint too many
        edges += [(k - 2, k), (k, k + 1), (k + 1, k - 1)]
    chain = Chain.from_edges([*edges, (0, 1500), (1, 1499)])
    rows = 2 * len(chain.joints)
    tracemalloc.start()
    try:
        assert generic(chain).stress_form.rank < rows
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < rows * rank._BYTES_WITH_STRESSES
