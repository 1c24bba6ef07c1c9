"""Mobility with dimensions in words, in English and German."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from gruebler.chain.pairs import Alphabet
from gruebler.errors import GrueblerError
from gruebler.screws.joint_geometry import Reason
from gruebler.screws.reasons import group_count

if TYPE_CHECKING:
    from gruebler.screws.mobility_report import Freedoms

__all__ = ["LANGUAGES", "SENTENCES", "explain_freedoms", "freedoms_summary", "reason_text"]

LANGUAGES = ("en", "de")

# sentence: (English, German)
SENTENCES: dict[str, tuple[str, str]] = {
    "table": (
        "Mobility: counted {counted}, generic {generic}, instant {instant}, finite {finite}.",
        "Laufgrad: gezählt {counted}, generisch {generic}, momentan {instant}, endlich {finite}.",
    ),
    "count": ("Count: {formula}", "Zählung: {formula}"),
    "instant": (
        "Instant: {constraints} constraints of rank {rank} on {unknowns} velocities leave {mobility} at this pose. "
        "Singular values against the largest: the smallest that counts is {above:.1e}, {rest} (tolerance "
        "{tolerance:g}).",
        "Momentan: {constraints} Bindungen vom Rang {rank} für {unknowns} Geschwindigkeiten lassen in dieser Lage "
        "{mobility}. Singulärwerte bezogen auf den größten: der kleinste, der zählt, ist {above:.1e}, {rest} "
        "(Toleranz {tolerance:g}).",
    ),
    "below": ("the next is {below:.1e}", "der nächste ist {below:.1e}"),
    "no_below": ("none counts as zero", "keiner zählt als null"),
    "redundant": (
        "Redundant at this pose: {number}. Joints whose constraints repeat others (how many): {joints}.",
        "In dieser Lage überzählig: {number}. Gelenke, deren Bindungen andere wiederholen (wie viele): {joints}.",
    ),
    "none_redundant": ("No constraint is redundant.", "Keine Bindung ist überzählig."),
    "immobile": ("Joints at rest: {joints}.", "Ruhende Gelenke: {joints}."),
    "finite_rigid": ("Finite: 0, for nothing moves even for an instant.", "Endlich: 0, denn auch momentan ruht alles."),
    "finite_regular": (
        "Finite: {finite}, proved, for no constraint is redundant (theorem of implicit functions).",
        "Endlich: {finite}, bewiesen, denn keine Bindung ist überzählig (Satz über implizite Funktionen).",
    ),
    "finite_blurred": (
        "Finite: not decided, perhaps {finite}. The smallest singular value that counts is no larger than the error of "
        "the pose makes it: there may be one velocity more, and none of them a motion.",
        "Endlich: nicht entschieden, vielleicht {finite}. Der kleinste Singulärwert, der zählt, ist nicht größer, als "
        "ihn der Fehler der Lage macht: Vielleicht gibt es eine Geschwindigkeit mehr, und keine gehört zu einer "
        "Bewegung.",
    ),
    "finite_followed": (
        "Finite: {finite}. Every velocity goes on as a motion; the joints stay closed as far as it was followed, up to "
        "{reach:g} (radians; lengths in sizes of the linkage).",
        "Endlich: {finite}. Jede Geschwindigkeit setzt sich als Bewegung fort; die Gelenke bleiben geschlossen, soweit "
        "verfolgt, bis {reach:g} (Bogenmaß; Längen in Größen des Getriebes).",
    ),
    "finite_stressed": (
        "Finite: 0. It is only shaky: the redundant constraints open by the square of the way, whichever velocity is "
        "followed ({open:.1e} of the size after {reach:g}).",
        "Endlich: 0. Es wackelt nur: Die überzähligen Bindungen klaffen mit dem Quadrat des Weges, welcher "
        "Geschwindigkeit man auch folgt ({open:.1e} der Getriebegröße nach {reach:g}).",
    ),
    "finite_shaky": (
        "Finite: 0. It is only shaky: along every velocity that was followed the joints open, by about the power "
        "{order} of the way ({open:.1e} of the size after {reach:g}).",
        "Endlich: 0. Es wackelt nur: Längs jeder verfolgten Geschwindigkeit klaffen die Gelenke, etwa mit der Potenz "
        "{order} des Weges ({open:.1e} der Getriebegröße nach {reach:g}).",
    ),
    "finite_branching": (
        "Finite: {finite}. Only some of the velocities belong to motions; {ways}.",
        "Endlich: {finite}. Nur manche der Geschwindigkeiten gehören zu Bewegungen; {ways}.",
    ),
    "finite_undecided": (
        "Finite: not decided. The velocities could not be followed, for the pose is all but singular in another way.",
        "Endlich: nicht entschieden. Die Geschwindigkeiten ließen sich nicht verfolgen, denn die Lage ist beinahe auf "
        "noch eine Weise singulär.",
    ),
    "ways": ("{number} ways meet in this pose", "in dieser Lage treffen sich {number} Wege"),
    "one_way": ("the pose is singular", "die Lage ist singulär"),
    "idle": (
        "Idle: {link} spins for itself alone; without idle freedoms the mobility is {useful}.",
        "Identisch: {link} dreht sich für sich allein; ohne identische Freiheitsgrade ist der Laufgrad {useful}.",
    ),
    "idles": (
        "Idle: {link} spin for themselves alone; without idle freedoms the mobility is {useful}.",
        "Identisch: {link} drehen sich für sich allein; ohne identische Freiheitsgrade ist der Laufgrad {useful}.",
    ),
    "unknown": (
        "Reason: special dimensions; no known geometric reason was recognised.",
        "Grund: besondere Abmessungen; ein bekannter geometrischer Grund wurde nicht erkannt.",
    ),
    "reason": ("Reason: {text}", "Grund: {text}"),
}

_REASONS: dict[str, tuple[str, str]] = {
    "group_screw": (
        "all joints have the same screw; with b = {number} the count gives {count}.",
        "alle Gelenke haben dieselbe Schraubung; mit b = {number} ergibt die Zählung {count}.",
    ),
    "group_translations": (
        "no link ever turns; with b = {number} the count gives {count}.",
        "kein Glied dreht sich je; mit b = {number} ergibt die Zählung {count}.",
    ),
    "group_cylinder": (
        "everything turns about one line and shifts along it; with b = {number} the count gives {count}.",
        "alles dreht sich um eine Gerade und schiebt sich längs dieser; mit b = {number} ergibt die Zählung {count}.",
    ),
    "group_plane": (
        "all turning axes are parallel and all slides at right angles to them: plane motion; with b = {number} the "
        "count gives {count}.",
        "alle Drehachsen sind parallel und alle Schiebungen rechtwinklig dazu: ebene Bewegung; mit b = {number} ergibt "
        "die Zählung {count}.",
    ),
    "group_screws": (
        "all axes are parallel and all screws have the same pitch: plane motion with a shift along the axes that goes "
        "with the turn; with b = {number} the count gives {count}.",
        "alle Achsen sind parallel und alle Schraubungen haben dieselbe Steigung: ebene Bewegung mit einer Schiebung "
        "längs der Achsen, die an die Drehung gebunden ist; mit b = {number} ergibt die Zählung {count}.",
    ),
    "group_sphere": (
        "all axes pass through one point: spherical motion; with b = {number} the count gives {count}.",
        "alle Achsen gehen durch einen Punkt: sphärische Bewegung; mit b = {number} ergibt die Zählung {count}.",
    ),
    "group_parallel": (
        "all turning axes are parallel; with b = {number} the count gives {count}.",
        "alle Drehachsen sind parallel; mit b = {number} ergibt die Zählung {count}.",
    ),
    "bennett": (
        "Bennett's linkage: opposite links are equal, and length and sine of the twist have the same ratio on all.",
        "Bennett-Getriebe: gegenüberliegende Glieder sind gleich, und Länge und Sinus der Schränkung haben überall "
        "dasselbe Verhältnis.",
    ),
    "line_symmetric": (
        "a half-turn takes the loop of six joints to itself: Bricard's line-symmetric linkage.",
        "eine Halbdrehung führt die Schleife aus sechs Gelenken in sich über: liniensymmetrisches Bricard-Getriebe.",
    ),
    "plane_symmetric": (
        "a mirror takes the loop of six joints to itself: Bricard's plane-symmetric linkage.",
        "eine Spiegelung führt die Schleife aus sechs Gelenken in sich über: ebenensymmetrisches Bricard-Getriebe.",
    ),
    "sarrus": (
        "Sarrus's linkage: three parallel axes and three others, parallel too; each three keep the plate parallel to "
        "itself.",
        "Sarrus-Getriebe: drei parallele Achsen und drei andere, ebenfalls parallele; beide halten die Platte parallel "
        "zu sich selbst.",
    ),
    "cardan": (
        "the centres of both cross joints lie on the axes of their bearings and stand still, so that {links} only "
        "turns about the line through them.",
        "die Mittelpunkte beider Kreuzgelenke liegen auf den Achsen ihrer Lager und ruhen; {links} dreht sich deshalb "
        "nur um die Gerade durch sie.",
    ),
    "cranks": (
        "{links} are {number} equal and parallel cranks between {first} and {second}; two of them say all.",
        "{links} sind {number} gleiche und parallele Kurbeln zwischen {first} und {second}; schon zwei sagen alles.",
    ),
    "copies": (
        "between {first} and {second} the same guidance is there {number} times, joint for joint: {links}.",
        "zwischen {first} und {second} ist dieselbe Führung {number}-mal da, Gelenk für Gelenk: {links}.",
    ),
    "planets": (
        "{links} are equal wheels on one carrier that mesh with the same wheels; one of them says all.",
        "{links} sind gleiche Räder auf einem Steg, die mit denselben Rädern kämmen; schon eines sagt alles.",
    ),
    "centres": (
        "{first} and {second} touch on the line of their centres, where their bearings on {links} already hold the "
        "distance.",
        "{first} und {second} berühren sich auf der Mittenlinie, längs der schon ihre Lager an {links} den Abstand "
        "halten.",
    ),
    "locking": (
        "the normals of {number} contacts of {first} with {second} pass through the bearing of {first} on {links}: "
        "they hold {second} and let {first} turn.",
        "die Normalen von {number} Berührungen von {first} mit {second} gehen durch das Lager von {first} an {links}: "
        "Sie halten {second} fest und lassen {first} drehen.",
    ),
    "parallel": (
        "{links} are {number} bars between {first} and {second} that are parallel in this pose, but not equal.",
        "{links} sind {number} Stäbe zwischen {first} und {second}, die in dieser Lage parallel sind, aber ungleich.",
    ),
    "concurrent": (
        "{links} are {number} bars between {first} and {second} whose lines pass through one point in this pose.",
        "{links} sind {number} Stäbe zwischen {first} und {second}, deren Geraden in dieser Lage durch einen Punkt "
        "gehen.",
    ),
    "coaxial": ("the axes of {joints} coincide.", "die Achsen von {joints} fallen zusammen."),
    "line": (
        "the joints {joints} lie on one line: a stretched or folded position.",
        "die Gelenke {joints} liegen auf einer Geraden: eine Streck- oder Decklage.",
    ),
}


def _column(lang: str) -> int:
    if lang not in LANGUAGES:
        raise GrueblerError("unknown language {lang_!r}: expected en or de", lang_=lang)
    return LANGUAGES.index(lang)


def explain_freedoms(freedoms: Freedoms, lang: str = "en") -> str:
    """The whole report as lines of text.

    >>> from gruebler.screws import freedoms
    >>> from gruebler.fourbar import FourBar
    >>> print(explain_freedoms(freedoms(FourBar(25, 70, 40, 70).linkage(), at=1.0)))
    Mobility: counted 1, generic 1, instant 1, finite 1.
    Count: F = 3(n - 1) - 2 g1 = 3(4 - 1) - 2·4 = 1
    Instant: 8 constraints of rank 8 on 9 velocities leave 1 at this pose. Singular values against the largest: the
    smallest that counts is 1.2e-01, none counts as zero (tolerance 1e-08).
    No constraint is redundant.
    Finite: 1, proved, for no constraint is redundant (theorem of implicit functions).
    """
    return "\n".join(_lines(freedoms, _column(lang)))


def freedoms_summary(freedoms: Freedoms, lang: str = "en") -> str:
    """The four numbers and the reasons.

    >>> from gruebler.screws import freedoms
    >>> from gruebler.fourbar import FourBar
    >>> print(freedoms_summary(freedoms(FourBar(25, 70, 40, 70).linkage()), "de"))
    Laufgrad: gezählt 1, generisch 1, momentan 1, endlich 1.
    """
    column = _column(lang)
    return "\n".join([_numbers(freedoms, column), *_reasons(freedoms, column)])


def _lines(freedoms: Freedoms, column: int) -> Iterator[str]:
    def say(key: str, **gaps: object) -> str:
        return SENTENCES[key][column].format(**gaps)

    instant, followed = freedoms.instant, freedoms.finite
    names = _names(freedoms, column)
    yield _numbers(freedoms, column)
    yield say("count", formula=freedoms.report.count.formula())
    above, below = instant.gap
    yield say(
        "instant",
        constraints=instant.constraints,
        rank=instant.rank,
        unknowns=instant.closing.unknowns,
        mobility=instant.mobility,
        above=above,
        rest=say("below", below=below) if instant.rank < len(instant.values) else say("no_below"),
        tolerance=instant.tolerance,
    )
    if instant.redundancy:
        joints = ", ".join(f"{names[k]} ({many})" for k, many in instant.redundant.items())
        yield say("redundant", number=instant.redundancy, joints=joints)
    else:
        yield say("none_redundant")
    if instant.mobility and instant.immobile:
        yield say("immobile", joints=", ".join(names[k] for k in instant.immobile))
    ways = say("ways", number=followed.ways) if followed.ways > 1 else say("one_way")
    yield say(
        f"finite_{followed.evidence}",
        finite=followed.mobility,
        reach=followed.reach,
        order=followed.order,
        open=followed.open,
        ways=ways,
    )
    spinning = [" + ".join(idle.links) for idle in freedoms.idle_parts]
    if spinning:
        yield say("idle" if len(spinning) == 1 else "idles", link=", ".join(spinning), useful=freedoms.useful)
    yield from _reasons(freedoms, column)


def _names(freedoms: Freedoms, column: int) -> tuple[str, ...]:
    return freedoms.report.chain.joint_names((Alphabet.INTERNATIONAL, Alphabet.GERMAN)[column])


def _numbers(freedoms: Freedoms, column: int) -> str:
    return SENTENCES["table"][column].format(
        counted=freedoms.counted, generic=freedoms.generic, instant=freedoms.instant.mobility, finite=freedoms.mobility
    )


def _reasons(freedoms: Freedoms, column: int) -> Iterator[str]:
    for reason in freedoms.reasons:
        text = reason_text(freedoms, reason, LANGUAGES[column], _names(freedoms, column))
        yield SENTENCES["reason"][column].format(text=text)
    if freedoms.mobility > freedoms.generic and not freedoms.reasons:
        yield SENTENCES["unknown"][column]


def reason_text(freedoms: Freedoms, reason: Reason, lang: str, names: Sequence[str]) -> str:
    """A reason as a sentence."""
    ends = 2 if reason.kind in ("cranks", "copies", "parallel", "concurrent", "centres", "locking") else 0
    return _REASONS[reason.kind][_column(lang)].format(
        first=reason.links[0] if ends else "",
        second=reason.links[1] if ends else "",
        links=", ".join(reason.links[ends:]),
        number=reason.number,
        joints=", ".join(names[k] for k in reason.joints),
        count=group_count(reason, freedoms.instant) if reason.kind.startswith("group") else "",
    )
