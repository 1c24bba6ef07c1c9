"""Decompositions in words, English and German."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from gruebler.assur.forms import roman
from gruebler.chain.pairs import Alphabet
from gruebler.mobility import generic, overconstrained

if TYPE_CHECKING:
    from gruebler.assur.decomposition import Decomposition, SolvedGroup

__all__ = ["decomposition_formula", "explain_decomposition", "open_groups_message"]

_WORDS = {
    "en": {
        "drive": "drive",
        "drives": "drives",
        "none": "no drive",
        "moves": "moves {links} directly",
        "group": "{k}. {form}: links {links}; outer joints {outer}{inner}. Class {number}, order {order}.",
        "on": "on {base}",
        "inner": "; inner joints {joints}",
        "class": "The mechanism has class {number}.",
        "only": "The drives are all there is.",
        "rest": "Not determined: {links}.",
        "over": "Constraints or drives work against one another: there are no Assur groups.",
        "part": "Overconstrained: {links} (constraints too many: {k}).",
    },
    "de": {
        "drive": "Antrieb",
        "drives": "Antriebe",
        "none": "kein Antrieb",
        "moves": "bewegt {links} unmittelbar",
        "group": "{k}. {form}: Glieder {links}; äußere Gelenke {outer}{inner}. Klasse {number}, Ordnung {order}.",
        "on": "auf {base}",
        "inner": "; innere Gelenke {joints}",
        "class": "Das Getriebe hat die Klasse {number}.",
        "only": "Die Antriebe sind alles, was sich bewegt.",
        "rest": "Nicht bestimmt: {links}.",
        "over": "Bindungen oder Antriebe arbeiten gegeneinander: Es gibt keine Assur-Gruppen.",
        "part": "Überbestimmt: {links} (Bindungen zu viel: {k}).",
    },
}


def _alphabet(lang: str) -> Alphabet:
    return Alphabet.GERMAN if lang == "de" else Alphabet.INTERNATIONAL


def decomposition_formula(decomposition: Decomposition, lang: str) -> str:
    """The structural formula."""
    words, alphabet = _WORDS[lang], _alphabet(lang)
    drives = decomposition.mechanism.drive_names(alphabet)
    head = f"{words['drive']} {', '.join(drives)}" if drives else words["none"]
    frame = decomposition.mechanism.frame
    groups = [
        f"{group.form(alphabet)}{{{_bodies(group)}{'' if frame in group.base else '; ' + _base(group, words)}}}"
        for group in decomposition.groups
    ]
    rest = [f"?{{{', '.join(decomposition.rest)}}}"] if decomposition.rest else []
    return " -> ".join([head, *groups, *rest])


def explain_decomposition(found: Decomposition, lang: str) -> str:
    """The whole decomposition, a line for each part."""
    words, alphabet = _WORDS[lang], _alphabet(lang)
    names = found.mechanism.chain.joint_names(alphabet)
    lines = [decomposition_formula(found, lang)]
    if found.driven:
        drives = found.mechanism.drive_names(alphabet)
        word = words["drive"] if len(drives) == 1 else words["drives"]
        lines.append(
            f"{word[0].upper()}{word[1:]} {', '.join(drives)}: {words['moves'].format(links=_some(found.driven))}."
        )
    for k, group in enumerate(found.groups, 1):
        inner = words["inner"].format(joints=_some([names[j] for j in group.inner])) if group.inner else ""
        lines.append(
            words["group"].format(
                k=k,
                form=group.form(alphabet),
                links=_bodies(group) + ("" if found.mechanism.frame in group.base else f" ({_base(group, words)})"),
                outer=_some([names[j] for j in group.outer]),
                inner=inner,
                number=roman(group.class_number),
                order=group.order,
            )
        )
    if found.complete:
        lines.append(words["class"].format(number=roman(found.class_number)) if found.groups else words["only"])
    return "\n".join([*lines, *open_groups_message(found, lang)])


def open_groups_message(decomposition: Decomposition, lang: str) -> list[str]:
    """What keeps the decomposition from being complete, a sentence or two a line; nothing if it is."""
    words = _WORDS[lang]
    if decomposition.report is None:
        return []
    lines = [words["rest"].format(links=_some(decomposition.rest))]
    if decomposition.overconstrained:
        lines = [words["over"]]
        lines += [
            words["part"].format(links=_some(part.links), k=part.redundancy)
            for part in overconstrained(generic(decomposition.mechanism.chain))
        ]
    if decomposition.report.remaining or decomposition.report.redundant_drives:
        lines.append(decomposition.report.explain(lang))
    return lines


def _bodies(group: SolvedGroup) -> str:
    """The bodies of a group, each with what it carries in square brackets."""
    return ", ".join(
        "+".join(body) + (f"[{_some(carried)}]" if carried else "")
        for body, carried in zip(group.bodies, group.carried, strict=True)
    )


def _base(group: SolvedGroup, words: dict[str, str]) -> str:
    return words["on"].format(base="+".join(group.base))


def _some(names: Sequence[str]) -> str:
    return ", ".join(names)
