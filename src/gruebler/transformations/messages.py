"""Steps and derivations in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gruebler.chain.pairs import Alphabet, pair
from gruebler.isomorphism import code
from gruebler.mobility import counted
from gruebler.text import listed, message, plural, translate
from gruebler.transformations.places import pairs_from_letters

if TYPE_CHECKING:
    from gruebler.transformations.derivations import Derivation
    from gruebler.transformations.growth import Growth
    from gruebler.transformations.places import Attachment
    from gruebler.transformations.steps import Step

__all__ = ["explain_derivation", "explain_growth", "explain_step"]

_STEPS = {
    "insert_dyad": message("Dyad {form} of the links {links} between {places}."),
    "remove_dyad": message("Dyad of {links} removed."),
    "insert_coupler": message("Coupler {link} with joints {pairs} between {places}."),
    "remove_coupler": message("Coupler {link} removed."),
    "insert_group": message("Assur group {group} as the links {links} at {places}."),
    "remove_group": message("Assur group of {links} removed."),
    "contract": message("{kept} and {merged} joined to one link at {joint}."),
    "expand at": message("{link} split: the new link {new} takes {joints}; the two are joined at {joint}."),
    "expand by": message("{link} split: the new link {new} takes {joints}; the two are joined by a {pair} joint."),
    "expand at empty": message("{link} split: the new link {new} takes no other joint; the two are joined at {joint}."),
    "expand by empty": message(
        "{link} split: the new link {new} takes no other joint; the two are joined by a {pair} joint."
    ),
    "replace_roll_slide": message("{joint} replaced by the binary link {link} with joints {pairs}."),
    "restore_roll_slide": message("The binary link {link} replaced by a roll-slide joint."),
}


def explain_step(step: Step, lang: str) -> str:
    """The step in a sentence."""
    where, kind, alphabet = dict(step.where), step.kind, Alphabet.of_language(lang)
    names = step.before.joint_names(alphabet)

    def written(place: Attachment) -> str:
        return place if isinstance(place, str) else translate("the joint {joint}", lang, joint=names[place])

    values = {key: str(value) for key, value in where.items()}
    for key in {"form", "pairs"} & values.keys():
        pairs = pairs_from_letters(values[key], len(values[key]), message("dyad"))
        values[key] = "".join(p.symbol(alphabet) for p in pairs)
    places = where.get("between") or where.get("at")
    if isinstance(places, list):
        values["places"] = listed(map(written, places), lang)
    if kind == "contract":
        values["kept"], values["merged"] = where["links"]
    if kind == "expand":
        values["joints"] = ", ".join(names[k] for k in where["joints"])
        if "at" in where:
            values["joint"] = names[where["at"]]
        else:
            values["pair"] = pair(where["pair"]).full_name(lang)
        kind = f"expand {'at' if 'at' in where else 'by'}{'' if where['joints'] else ' empty'}"
    elif "links" in where:
        values["links"] = ", ".join(where["links"])
    if "joint" in where:
        values["joint"] = names[where["joint"]]
    return _STEPS[kind].filled(**values).in_language(lang)


def explain_derivation(derivation: Derivation, lang: str) -> str:
    """A line for the start, for each step, and for the chain at the end."""
    alphabet = Alphabet.of_language(lang)
    lines = [translate("Start: {chain}.", lang, chain=derivation.start.text(alphabet))]
    lines += [f"{number}. {step.explain(lang)}" for number, step in enumerate(derivation.steps, 1)]
    if derivation.steps:
        lines.append(translate("The chain: {chain}.", lang, chain=derivation.chain.text(alphabet)))
    return "\n".join(lines)


def explain_growth(growth: Growth, lang: str) -> str:
    """The verdict, then the derivation."""
    core, steps = growth.core, len(growth.derivation.steps)
    text, links = core.text(Alphabet.of_language(lang)), ", ".join(core.links)
    if growth.from_loop and not steps:
        return translate("The chain is one closed loop of {links} links.", lang, links=core.n)
    if growth.from_loop:
        lines = [
            plural(
                "The chain grows from the closed loop of {links} links {loop} by one dyad.",
                "The chain grows from the closed loop of {links} links {loop} by {count} dyads.",
                steps,
                lang,
                links=core.n,
                loop=text,
            )
        ]
    else:
        if steps:
            verdict = message(
                "The chain does not grow from a closed loop by dyads: {core} is left ({n} links: {links}; F = {F}), in "
                "which no dyad can be removed."
            )
        else:
            verdict = message(
                "The chain does not grow by dyads: none can be removed from it ({n} links: {links}; F = {F})."
            )
        lines = [verdict.filled(core=text, n=core.n, links=links, F=counted(core)).in_language(lang)]
        lines.append(translate("Code of the core: {code}", lang, code=code(core)))
        if steps:
            lines.append(
                plural("From there it grows by one dyad.", "From there it grows by {count} dyads.", steps, lang)
            )
        if not growth.exact:
            lines.append(translate("The search was cut short: another order of the dyads might lead to a loop.", lang))
    if steps:
        lines.append(growth.derivation.explain(lang))
    return "\n".join(lines)
