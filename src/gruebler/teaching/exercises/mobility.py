"""Counting freedoms: links, joints, F, and the count checked by the rank of the constraints, step by step."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from typing import NamedTuple

from gruebler.base.text import Message, Text, in_every_language, joined, message, plural, translate
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.mobility import count_freedoms, mobility_report
from gruebler.structure.mobility.report import verdict_word
from gruebler.teaching.catalog import entry
from gruebler.teaching.exercises.solution import PartHeading, Solution, SolutionBuilder, SolutionStep

_LINKS = message("number of links, the frame included")
_FREEDOM = message("mobility")
_BY_RANK = message("F (at least 0) by the rank of the constraints at random sizes")
_CRITERION = {
    True: message("Criterion of constrained motion holds (0)"),
    False: message("Criterion of constrained motion does not hold (not 0)"),
}
_FRAME_COUNTS = message("The frame is a link too: n counts it.")
_TIMES = {2: message("twice"), 3: message("three times")}


def chain(chain: str, space: str = "planar") -> Solution:
    """The count of a chain written as text.

    >>> chain("R(0-1) R(1-2-3) R(2-4) R(3-5) P(0-4) P(0-5)")["F"]
    1
    """
    builder = SolutionBuilder()
    _add_count(builder, Chain.parse(chain, space=space), _Mark("", None), {})
    return builder.done()


def machines(machines: str) -> Solution:
    """The counts of machines of the catalog, ids with blanks between; keys end in ``.id`` if there are several.

    >>> machines("vcomp")["g1"]
    7
    """
    ids = machines.split()
    builder = SolutionBuilder()
    for id in ids:
        record = entry(id)
        if len(ids) > 1:
            builder.parts.append(PartHeading(record.name))
        mark = _Mark(f".{id}", record.name) if len(ids) > 1 else _Mark("", None)
        _add_count(builder, record.chain(), mark, record.link_names("de"))
    return builder.done()


class _Mark(NamedTuple):
    """The suffix that distinguishes the results of one of several machines."""

    key: str
    machine: Text | None

    def named(self, quantity: Message) -> Message:
        return quantity if self.machine is None else joined([self.machine, quantity], ": ")

    def __str__(self) -> str:
        return self.key


def _add_count(builder: SolutionBuilder, structure: Chain, mark: _Mark, german: Mapping[str, str]) -> None:
    numbered = all(link.isdigit() for link in structure.links)
    links = sorted(structure.links, key=int) if numbered else structure.links
    names = Text(", ".join(links), ", ".join(german.get(link, link) for link in links))
    builder.parts.append(
        SolutionStep(text=message("Links: {links}.", links=names), formula="n", numbers="", value=structure.n)
    )
    builder.keep(f"n{mark}", mark.named(_LINKS), structure.n, symbol="n")
    _add_joints(builder, structure, mark, german)
    count = count_freedoms(structure)
    formula = replace(count, by_freedom=tuple(_by_freedom(structure).items()))
    parts = formula.formula().removeprefix("F = ").split(" = ")
    builder.parts.append(SolutionStep(text=_FREEDOM, formula=f"F = {parts[0]}", numbers=parts[1], value=formula.value))
    builder.keep(f"F{mark}", mark.named(_FREEDOM), formula.value, symbol="F")
    sides = formula.criterion().split(" = ")
    builder.parts.append(
        SolutionStep(
            text=_CRITERION[formula.value == 1], formula=" = ".join(sides[:2]), numbers="", value=float(sides[2])
        )
    )
    report = mobility_report(structure)
    verdict = in_every_language(lambda lang: verdict_word(report.verdict, lang))
    if report.generic > 0:
        drives = in_every_language(
            lambda lang: plural("one drive is needed", "{count} drives are needed", report.generic, lang)
        )
        builder.say("The chain is {verdict}: {drives}.", verdict=verdict, drives=drives)
    else:
        builder.say("The chain is {verdict}.", verdict=verdict)
    builder.check(mark.named(_BY_RANK), float(max(formula.value, 0)), float(report.generic), "")
    _add_mistakes(builder, structure, mark)


def _by_freedom(structure: Chain) -> dict[int, int]:
    """The numbers of joints that are asked for, those with f = 2 though there are none."""
    return {1: 0, 2: 0} | structure.joints_by_freedom


def _add_joints(builder: SolutionBuilder, structure: Chain, mark: _Mark, german: Mapping[str, str]) -> None:
    short = structure.renamed(_short(structure, german)) if german else structure
    for f, number in _by_freedom(structure).items():
        which = [k for k, joint in enumerate(structure.joints) if joint.pair.f(structure.space) == f]
        names = Text(
            ", ".join(structure.joint_names(Alphabet.INTERNATIONAL)[k] for k in which),
            ", ".join(short.joint_names(Alphabet.GERMAN)[k] for k in which),
        )
        text = message("Joints with f = {f}: {joints}.", f=f, joints=names if which else message("none"))
        builder.parts.append(SolutionStep(text=text, formula=f"g{f}", numbers="", value=number))
        name = message("number of joints with f = {f}", f=f)
        builder.keep(f"g{f}{mark}", mark.named(name), number, symbol=f"g{f}")
    for joint, named in zip(structure.multiple_joints, short.multiple_joints, strict=True):
        k = len(joint.links)
        builder.say(
            "The joint {joint} connects {links} links and counts {times}.",
            joint=Text("-".join(joint.links), "-".join(named.links)),
            links=k,
            times=_TIMES.get(k - 1, message("{count} times", count=k - 1)),
        )


def _short(structure: Chain, german: Mapping[str, str]) -> dict[str, str]:
    """The German names of the links shortened to one word, where they remain different."""
    left_out = rf"^{translate('link', 'de')} | \(.*| {translate('with', 'de')} .*| "
    names = {link: re.sub(left_out, "", german.get(link, link)) for link in structure.links}
    return names if len(set(names.values())) == len(names) else {link: german.get(link, link) for link in names}


def _add_mistakes(builder: SolutionBuilder, structure: Chain, mark: _Mark) -> None:
    b, n = structure.space.b, structure.n
    correct = count_freedoms(structure).value
    extra = [(joint, joint.count - 1) for joint in structure.multiple_joints]
    lost = sum((b - joint.pair.f(structure.space)) * more for joint, more in extra)
    if extra:
        hint = message("A joint of three links is a double joint and counts twice, one of four three times.")
        builder.mistake(f"F{mark}", correct + lost, hint)
        simple = sum(1 for joint in structure.joints if joint.pair.f(structure.space) == 1)
        builder.mistake(f"g1{mark}", simple, hint)
    builder.mistake(f"n{mark}", n - 1, _FRAME_COUNTS)
    add_frame_mistakes(builder, f"F{mark}", structure)
    higher = structure.joints_by_freedom.get(2, 0)
    if b == 3 and higher:
        hint = message("A joint that rolls and slides has f = 2 and takes away one motion only.")
        builder.mistake(f"F{mark}", correct - higher, hint)
        builder.mistake(f"g2{mark}", 0, hint)


def add_frame_mistakes(builder: SolutionBuilder, key: str, structure: Chain) -> None:
    """What F becomes if the frame is left out of n, or counted as a link that moves."""
    correct, b = count_freedoms(structure).value, structure.space.b
    builder.mistake(key, correct - b, _FRAME_COUNTS)
    builder.mistake(key, correct + b, message("The frame does not move: the formula has n - 1 free links, not n."))
