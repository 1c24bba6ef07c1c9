"""Decompositions in words."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from gruebler.assur.forms import roman
from gruebler.chain.pairs import Alphabet
from gruebler.mobility import generic, overconstrained
from gruebler.text import Message, message, plural, translate

if TYPE_CHECKING:
    from gruebler.assur.decomposition import Decomposition, SolvedGroup

__all__ = ["decomposition_formula", "explain_decomposition", "open_groups_message"]


def decomposition_formula(decomposition: Decomposition, lang: str) -> str:
    """The structural formula."""
    alphabet, frame = Alphabet.of_language(lang), decomposition.mechanism.frame
    drives = decomposition.mechanism.drive_names(alphabet)
    formula = [translate("drive {joints}", lang, joints=_names(drives)) if drives else translate("no drive", lang)]
    for group in decomposition.groups:
        base = "" if frame in group.base else f"; {_base(group, lang)}"
        formula.append(f"{group.form(alphabet)}{{{_bodies(group)}{base}}}")
    if decomposition.rest:
        formula.append(f"?{{{_names(decomposition.rest)}}}")
    return " -> ".join(formula)


def explain_decomposition(decomposition: Decomposition, lang: str) -> str:
    """The whole decomposition, a line for each part."""
    mechanism, alphabet = decomposition.mechanism, Alphabet.of_language(lang)
    names = mechanism.chain.joint_names(alphabet)
    lines = [decomposition_formula(decomposition, lang)]
    if decomposition.driven:
        drives, links = mechanism.drive_names(alphabet), _names(decomposition.driven)
        lines.append(
            plural(
                "Drive {joints}: moves {links} directly.",
                "Drives {joints}: moves {links} directly.",
                len(drives),
                lang,
                joints=_names(drives),
                links=links,
            )
        )
    for k, group in enumerate(decomposition.groups, 1):
        values = {
            "k": k,
            "form": group.form(alphabet),
            "links": _bodies(group) + ("" if mechanism.frame in group.base else f" ({_base(group, lang)})"),
            "outer": _names([names[j] for j in group.outer]),
            "group_class": roman(group.class_number),
            "order": group.order,
        }
        if group.inner:
            inner = _names([names[j] for j in group.inner])
            lines.append(
                translate(
                    "{k}. {form}: links {links}; outer joints {outer}; inner joints {inner}. Class {group_class}, "
                    "order {order}.",
                    lang,
                    inner=inner,
                    **values,
                )
            )
        else:
            lines.append(
                translate(
                    "{k}. {form}: links {links}; outer joints {outer}. Class {group_class}, order {order}.",
                    lang,
                    **values,
                )
            )
    if decomposition.complete and decomposition.groups:
        highest = roman(decomposition.class_number)
        lines.append(translate("The mechanism has class {group_class}.", lang, group_class=highest))
    elif decomposition.complete:
        lines.append(translate("The drives are all there is.", lang))
    lines += [line.in_language(lang) for line in open_groups_message(decomposition)]
    return "\n".join(lines)


def open_groups_message(decomposition: Decomposition) -> list[Message]:
    """What keeps the decomposition from being complete, a sentence or two a line; nothing if it is."""
    if decomposition.report is None:
        return []
    lines = [message("Not determined: {links}.", links=_names(decomposition.rest))]
    if decomposition.overconstrained:
        lines = [message("Constraints or drives work against one another: there are no Assur groups.")]
        text = message("Overconstrained: {links} (constraints too many: {count}).")
        lines += [
            text.filled(links=_names(part.links), count=part.redundancy)
            for part in overconstrained(generic(decomposition.mechanism.chain))
        ]
    if decomposition.report.remaining or decomposition.report.redundant_drives:
        lines.append(decomposition.report.message)
    return lines


def _bodies(group: SolvedGroup) -> str:
    """The bodies of a group, each with what it carries in square brackets."""
    return ", ".join(
        "+".join(body) + (f"[{_names(carried)}]" if carried else "")
        for body, carried in zip(group.bodies, group.carried, strict=True)
    )


def _base(group: SolvedGroup, lang: str) -> str:
    return translate("on {base}", lang, base="+".join(group.base))


def _names(names: Sequence[str]) -> str:
    return ", ".join(names)
