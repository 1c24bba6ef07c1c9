"""The mobility report in words, in English and German.

Each sentence stands once in each language, side by side. A test checks that both have the same gaps to fill.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from gruebler.chain.pairs import Alphabet
from gruebler.errors import GrueblerError
from gruebler.mobility.circuits import Overconstrained
from gruebler.mobility.idle import IdleCondition
from gruebler.mobility.report import MobilityReport, Verdict

__all__ = ["LANGUAGES", "explain_mobility", "verdict_word"]

LANGUAGES = ("en", "de")

Say = Callable[..., str]
"""A sentence's key and the words for its gaps give the sentence."""

_KINDS = {
    "en": {1: "singular", 2: "binary", 3: "ternary", 4: "quaternary"},
    "de": {1: "singuläre", 2: "binäre", 3: "ternäre", 4: "quaternäre"},
}

_VERDICTS = {
    Verdict.OVERCONSTRAINED: ("overconstrained", "übergeschlossen"),
    Verdict.RIGID: ("rigid", "starr"),
    Verdict.PARTLY_RIGID: ("partly rigid", "teilweise starr"),
    Verdict.CONSTRAINED: ("constrained", "zwangläufig"),
    Verdict.MOVABLE: ("movable", "beweglich"),
}

# sentence: (English, German)
SENTENCES: dict[str, tuple[str, str]] = {
    "chain": ("Chain: {text}", "Kette: {text}"),
    "links": ("Links: n = {n} ({kinds})", "Glieder: n = {n} ({kinds})"),
    "kind": ("{number} {kind}", "{number} {kind}"),
    "kind_many": ("{number} with {kind} joints", "{number} mit {kind} Gelenken"),
    "joints": (
        "Joints: {counts}, {loops}",
        "Gelenke: {counts}, {loops}",
    ),
    "loop": ("one independent loop", "eine unabhängige Masche"),
    "loops": ("{number} independent loops", "{number} unabhängige Maschen"),
    "multiple": (
        "The joint {joint} carries {k} links and counts {count} times.",
        "Das Gelenk {joint} trägt {k} Glieder und zählt {count}-fach.",
    ),
    "count": ("Count: {formula}", "Zählung: {formula}"),
    "group": (
        "The count takes b = {b} motions of a free link instead of the {space} chain's {own}.",
        "Gezählt ist mit b = {b} Bewegungen des freien Gliedes statt mit den {own} der {space} Kette.",
    ),
    "criterion_holds": (
        "Criterion of constrained motion: {criterion}. It holds.",
        "Zwangslaufkriterium: {criterion}. Es ist erfüllt.",
    ),
    "criterion_fails": (
        "Criterion of constrained motion: {criterion}. It does not hold.",
        "Zwangslaufkriterium: {criterion}. Es ist nicht erfüllt.",
    ),
    "generic": (
        "Generic mobility (almost all sizes): {generic}, {proof}.",
        "Generischer Laufgrad (fast alle Abmessungen): {generic}, {proof}.",
    ),
    "proved": ("proved", "bewiesen"),
    "probable": (
        "by rank at two random placements (chance of error below {bound:.0e})",
        "nach dem Rang an zwei zufälligen Lagen (Irrtum mit Wahrscheinlichkeit unter {bound:.0e})",
    ),
    "agrees": ("The count is true.", "Die Zählung stimmt."),
    "hidden": (
        "The sum is right, but the chain is not sound: see below.",
        "Die Summe stimmt, aber die Kette ist nicht in Ordnung: siehe unten.",
    ),
    "differs": (
        "The count is off by {difference}: so many constraints are redundant.",
        "Die Zählung irrt um {difference}: So viele Bindungen sind überzählig.",
    ),
    "verdict": ("Verdict: {verdict}. {meaning}", "Urteil: {verdict}. {meaning}"),
    "overconstrained": (
        "Some links hold more constraints than they need; such a machine runs only with exact or special dimensions.",
        "Einige Glieder tragen mehr Bindungen als nötig; so läuft das nur bei genauen oder besonderen Abmessungen.",
    ),
    "rigid": (
        "Nothing moves for almost all dimensions; only special dimensions (equal and parallel cranks, a contact on "
        "the line of centres) can set it free, and then one constraint is redundant.",
        "Bei fast allen Abmessungen bewegt sich nichts; nur besondere (gleiche und parallele Kurbeln, Berührung auf "
        "der Mittenlinie) machen beweglich, und dann ist eine Bindung überzählig.",
    ),
    "partly_rigid": (
        "It moves, but some of its links stay rigid against each other and act as one link.",
        "Es bewegt sich, aber einige Glieder bleiben gegeneinander starr und wirken wie ein einziges.",
    ),
    "constrained": (
        "One drive moves every link in one definite way.",
        "Ein Antrieb bewegt jedes Glied in bestimmter Weise.",
    ),
    "movable": (
        "It takes {number} drives to fix the motion.",
        "Für eine bestimmte Bewegung sind {number} Antriebe nötig.",
    ),
    "circuit": (
        "Overconstrained: links {links} by {redundancy}, at the joints {joints}.",
        "Übergeschlossen: Glieder {links}, um {redundancy}, an den Gelenken {joints}.",
    ),
    "region": (
        "Overconstrained as a whole, not taken apart further: links {links} by {redundancy}.",
        "Im Ganzen übergeschlossen, nicht weiter zerlegt: Glieder {links}, um {redundancy}.",
    ),
    "free_any": (
        "One more freedom at any one of these joints mends it, and so does removing any one of them.",
        "Ein Freiheitsgrad mehr an einem dieser Gelenke behebt es, ebenso das Entfernen eines von ihnen.",
    ),
    "remove_any": (
        "Removing any one of these joints mends it.",
        "Das Entfernen eines dieser Gelenke behebt es.",
    ),
    "remove_some": (
        "Removing one of {joints} mends it.",
        "Das Entfernen eines der Gelenke {joints} behebt es.",
    ),
    "no_single": (
        "No single joint mends it: {redundancy} freedoms are missing.",
        "Kein einzelnes Gelenk behebt es: Es fehlen {redundancy} Freiheitsgrade.",
    ),
    "cluster": ("Rigid against each other: {links}.", "Gegeneinander starr: {links}."),
    "everything": ("Rigid against each other: all links.", "Gegeneinander starr: alle Glieder."),
    "immobile": ("Joints that cannot move: {joints}.", "Gelenke, die sich nicht bewegen können: {joints}."),
    "all_immobile": ("None of the joints can move.", "Kein Gelenk kann sich bewegen."),
    "idle_always": (
        "Idle: {link} has {freedoms} of the {generic} freedoms for itself alone; it changes nothing else.",
        "Identisch: {link} hat {freedoms} der {generic} Freiheitsgrade für sich allein; sonst ändert sich nichts.",
    ),
    "idle_part": (
        "Idle: {link} turn as one body about the line through their two ball joints; it changes nothing else.",
        "Identisch: {link} drehen sich als ein Körper um die Gerade durch ihre beiden Kugelgelenke; sonst ändert sich "
        "nichts.",
    ),
    "idle_round": (
        "Idle if round: {link} spins without effect when its contour is a circle about its pin.",
        "Identisch, falls rund: {link} dreht ohne Wirkung, wenn seine Kontur ein Kreis um den Zapfen ist.",
    ),
    "singular": (
        "{link} hangs on a single joint; its freedom there belongs to it alone.",
        "{link} hängt an einem einzigen Gelenk; dessen Freiheit gehört ihm allein.",
    ),
}

_SPACES = {
    "planar": ("planar", "ebenen"),
    "spherical": ("spherical", "sphärischen"),
    "spatial": ("spatial", "räumlichen"),
}


def _column(lang: str) -> int:
    if lang not in LANGUAGES:
        raise GrueblerError("unknown language {lang_!r}: expected en or de", lang_=lang)
    return LANGUAGES.index(lang)


def verdict_word(verdict: Verdict, lang: str) -> str:
    """The verdict in one or two words.

    >>> verdict_word(Verdict.CONSTRAINED, "de")
    'zwangläufig'
    """
    return _VERDICTS[verdict][_column(lang)]


def explain_mobility(report: MobilityReport, lang: str = "en") -> str:
    """The whole report as lines of text.

    >>> from gruebler.mobility.report import mobility_report
    >>> from gruebler.chain import Chain
    >>> print(explain_mobility(mobility_report(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)"))))
    Chain: R(0-1) R(1-2) R(2-3) R(3-0)
    Links: n = 4 (4 binary)
    Joints: g1 = 4, one independent loop
    Count: F = 3(n - 1) - 2 g1 = 3(4 - 1) - 2·4 = 1
    Criterion of constrained motion: 3n - 4 - 2 g1 = 12 - 4 - 8 = 0. It holds.
    Generic mobility (almost all sizes): 1, proved. The count is true.
    Verdict: constrained. One drive moves every link in one definite way.
    """
    column = _column(lang)

    def say(key: str, **gaps: object) -> str:
        return SENTENCES[key][column].format(**gaps)

    lines = [*_structure(report, lang, say), *_numbers(report, lang, say), *_findings(report, lang, say)]
    return "\n".join(lines)


def _structure(report: MobilityReport, lang: str, say: Say) -> Iterator[str]:
    chain = report.chain
    kinds = [
        say("kind", number=number, kind=_KINDS[lang][k])
        if k in _KINDS[lang]
        else say("kind_many", number=number, kind=k)
        for k, number in chain.link_kinds.items()
    ]
    yield say("chain", text=chain.text(_alphabet(lang)))
    yield say("links", n=chain.n, kinds=", ".join(kinds))
    counts = ", ".join(f"g{f} = {g}" for f, g in chain.joints_by_freedom.items())
    loops = say("loop") if chain.loops == 1 else say("loops", number=chain.loops)
    yield say("joints", counts=counts, loops=loops)
    for joint, name in zip(chain.joints, chain.joint_names(_alphabet(lang)), strict=True):
        if joint.count > 1:
            yield say("multiple", joint=name, k=len(joint.links), count=joint.count)


def _numbers(report: MobilityReport, lang: str, say: Say) -> Iterator[str]:
    yield say("count", formula=report.count.formula())
    own = report.chain.space.b
    if report.count.b != own:
        space = _SPACES[report.chain.space][_column(lang)]
        yield say("group", b=report.count.b, space=space, own=own)
    holds = "criterion_holds" if report.counted == 1 else "criterion_fails"
    yield say(holds, criterion=report.count.criterion())
    proof = say("proved") if report.exact else say("probable", bound=report.error_bound)
    line = say("generic", generic=report.generic, proof=proof)
    if report.count.b == own:
        sound = report.redundancy == 0 and (report.generic == 0 or not report.rigid_clusters)
        key = "differs" if report.redundancy else "agrees" if sound else "hidden"
        line += " " + say(key, difference=report.redundancy)
    yield line
    yield say(
        "verdict",
        verdict=verdict_word(report.verdict, lang),
        meaning=say(report.verdict.value, number=report.generic),
    )


def _findings(report: MobilityReport, lang: str, say: Say) -> Iterator[str]:
    chain = report.chain
    names = chain.joint_names(_alphabet(lang))
    for part in report.overconstrained:
        yield _overconstrained(part, names, say)
    if len(report.rigid_clusters) == 1 and len(report.rigid_clusters[0]) == chain.n:
        yield say("everything")
    else:
        for cluster in report.rigid_clusters:
            yield say("cluster", links=", ".join(cluster))
    if len(report.immobile_joints) == len(chain.joints):
        yield say("all_immobile")
    elif report.immobile_joints:
        yield say("immobile", joints=_list(names, report.immobile_joints))
    for idle in report.idle_freedoms:
        key = "idle_always" if idle.when is IdleCondition.ALWAYS else "idle_round"
        key = "idle_part" if len(idle.links) > 1 else key
        yield say(key, link=", ".join(idle.links), freedoms=idle.freedoms, generic=report.generic)
    for link, k in chain.degrees.items():
        if k == 1:
            yield say("singular", link=link)


def _overconstrained(part: Overconstrained, names: Sequence[str], say: Say) -> str:
    links = ", ".join(part.links)
    if not part.minimal:
        return say("region", links=links, redundancy=part.redundancy)
    line = say("circuit", links=links, redundancy=part.redundancy, joints=_list(names, part.joints))
    if part.mended_by_freeing == part.mended_by_removing == part.joints:
        return f"{line} {say('free_any')}"
    if part.mended_by_removing == part.joints:
        return f"{line} {say('remove_any')}"
    if part.mended_by_removing:
        return f"{line} {say('remove_some', joints=_list(names, part.mended_by_removing))}"
    return f"{line} {say('no_single', redundancy=part.redundancy)}"


def _list(names: Sequence[str], numbers: Sequence[int]) -> str:
    return ", ".join(names[k] for k in numbers)


def _alphabet(lang: str) -> Alphabet:
    return Alphabet.GERMAN if lang == "de" else Alphabet.INTERNATIONAL
