"""Steps and derivations in words, English and German."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gruebler.chain.pairs import Alphabet, pair
from gruebler.isomorphism import code
from gruebler.mobility import counted

if TYPE_CHECKING:
    from gruebler.transformations.derivations import Derivation
    from gruebler.transformations.growth import Growth
    from gruebler.transformations.places import Attachment
    from gruebler.transformations.steps import Step

__all__ = ["explain_derivation", "explain_growth", "explain_step"]

_STEPS = {
    "en": {
        "insert_dyad": "Dyad {form} of the links {links} between {places}.",
        "remove_dyad": "The dyad of {links} taken away.",
        "insert_coupler": "Coupler {link} with joints {pairs} between {places}.",
        "remove_coupler": "The coupler {link} taken away.",
        "insert_group": "Assur group {group} as the links {links} at {places}.",
        "remove_group": "The Assur group of {links} taken away.",
        "contract": "{kept} and {gone} made one link at {joint}.",
        "expand": "{link} split: the new link {new} takes {joints}; the two are joined {how}.",
        "replace_roll_slide": "{joint} replaced by the binary link {link} with joints {pairs}.",
        "restore_roll_slide": "The binary link {link} replaced by a roll-slide joint.",
        "nothing": "nothing",
        "by": "by a {pair} joint",
        "at": "at {joint}",
        "place": "the joint {joint}",
        "and": " and ",
    },
    "de": {
        "insert_dyad": "Zweischlag {form} aus den Gliedern {links} zwischen {places}.",
        "remove_dyad": "Zweischlag aus {links} entfernt.",
        "insert_coupler": "Koppel {link} mit den Gelenken {pairs} zwischen {places}.",
        "remove_coupler": "Koppel {link} entfernt.",
        "insert_group": "Assur-Gruppe {group} als Glieder {links} an {places}.",
        "remove_group": "Assur-Gruppe aus {links} entfernt.",
        "contract": "{kept} und {gone} an {joint} zu einem Glied zusammengezogen.",
        "expand": "{link} geteilt: Das neue Glied {new} übernimmt {joints}; verbunden sind beide {how}.",
        "replace_roll_slide": "{joint} durch das binäre Glied {link} mit den Gelenken {pairs} ersetzt.",
        "restore_roll_slide": "Das binäre Glied {link} durch ein Gleitwälzgelenk ersetzt.",
        "nothing": "nichts",
        "by": "durch ein {pair}",
        "at": "in {joint}",
        "place": "dem Gelenk {joint}",
        "and": " und ",
    },
}

_GROWTH = {
    "en": {
        "start": "Start: {chain}.",
        "end": "The chain: {chain}.",
        "loop": "The chain is one closed loop of {n} links.",
        "grows": "The chain grows from the closed loop of {n} links {loop} by {dyads}.",
        "one": "one dyad",
        "many": "{k} dyads",
        "core": "The chain does not grow from a closed loop by dyads: {core} is left ({n} links: {links}; F = {F}), in "
        "which no dyad can be taken away.",
        "none": "The chain does not grow by dyads: there is none in it to take away ({n} links: {links}; F = {F}).",
        "onward": "From there it grows by {dyads}.",
        "code": "Code of the core: {code}",
        "cut": "The search was cut short: another order of the dyads might lead to a loop.",
    },
    "de": {
        "start": "Anfang: {chain}.",
        "end": "Die Kette: {chain}.",
        "loop": "Die Kette ist selbst eine geschlossene Schleife aus {n} Gliedern.",
        "grows": "Die Kette entsteht aus der geschlossenen Schleife von {n} Gliedern {loop} durch {dyads}.",
        "one": "einen Zweischlag",
        "many": "{k} Zweischläge",
        "core": "Die Kette entsteht nicht aus einer geschlossenen Schleife durch Zweischläge: Übrig bleibt {core} "
        "({n} Glieder: {links}; F = {F}), worin sich kein Zweischlag entfernen lässt.",
        "none": "Die Kette entsteht nicht durch Zweischläge: Es lässt sich keiner entfernen ({n} Glieder: {links}; "
        "F = {F}).",
        "onward": "Von dort entsteht sie durch {dyads}.",
        "code": "Code des Kerns: {code}",
        "cut": "Die Suche wurde abgebrochen: Eine andere Reihenfolge der Zweischläge könnte zu einer Schleife führen.",
    },
}

_GERMAN_LETTERS = str.maketrans("RP", "DS")


def explain_step(step: Step, lang: str) -> str:
    """The step in a sentence."""
    words, where = _STEPS[lang], dict(step.where)
    names = step.before.joint_names(_alphabet(lang))

    def said(place: Attachment) -> str:
        return place if isinstance(place, str) else words["place"].format(joint=names[place])

    values = {key: str(value) for key, value in where.items()}
    for key in ("form", "pairs"):
        if key in values and lang == "de":
            values[key] = values[key].translate(_GERMAN_LETTERS)
    places = where.get("between") or where.get("at")
    if isinstance(places, list):
        values["places"] = words["and"].join(map(said, places))
    if step.kind == "contract":
        values["kept"], values["gone"] = where["links"]
    if step.kind == "expand":
        values["joints"] = ", ".join(names[k] for k in where["joints"]) or words["nothing"]
        values["how"] = (
            words["at"].format(joint=names[where["at"]])
            if "at" in where
            else words["by"].format(pair=pair(where["pair"]).german if lang == "de" else where["pair"])
        )
    elif "links" in where:
        values["links"] = ", ".join(where["links"])
    if "joint" in where:
        values["joint"] = names[where["joint"]]
    return words[step.kind].format(**values)


def explain_derivation(derivation: Derivation, lang: str) -> str:
    """A line for the start, for each step, and for the chain at the end."""
    words, alphabet = _GROWTH[lang], _alphabet(lang)
    lines = [words["start"].format(chain=derivation.start.text(alphabet))]
    lines += [f"{number}. {step.explain(lang)}" for number, step in enumerate(derivation.steps, 1)]
    if derivation.steps:
        lines.append(words["end"].format(chain=derivation.chain.text(alphabet)))
    return "\n".join(lines)


def explain_growth(growth: Growth, lang: str) -> str:
    """The verdict, then the derivation."""
    words, core = _GROWTH[lang], growth.core
    k = len(growth.derivation.steps)
    dyads = words["one"] if k == 1 else words["many"].format(k=k)
    text = core.text(_alphabet(lang))
    values = {
        "n": core.n,
        "links": ", ".join(core.links),
        "F": counted(core),
        "core": text,
        "loop": text,
        "dyads": dyads,
    }
    if growth.from_loop:
        lines = [words["grows" if k else "loop"].format(**values)]
    else:
        lines = [words["core" if k else "none"].format(**values), words["code"].format(code=code(core))]
        if k:
            lines.append(words["onward"].format(**values))
        if not growth.exact:
            lines.append(words["cut"])
    if k:
        lines.append(growth.derivation.explain(lang))
    return "\n".join(lines)


def _alphabet(lang: str) -> Alphabet:
    return Alphabet.GERMAN if lang == "de" else Alphabet.INTERNATIONAL
