"""The tables of statics, their columns named in a language."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.columns import Column, Table
from gruebler.base.text import translate
from gruebler.base.units import moment_unit
from gruebler.mechanics.forces.friction import FrictionForces
from gruebler.mechanics.forces.solution import Statics
from gruebler.structure.chain.pairs import Alphabet

_NOISE = 1e-13  # of the loads: a smaller effort is none


def statics_table(statics: Statics, *, lang: str = "en") -> Table:
    """Columns of drive values, drive efforts and the sizes of joint forces, over the rows.

    With friction the efforts follow without and with it, then the efficiency (of one drive) and the factor of safety
    against self-locking; joint forces are those with friction, and behind them stand the friction forces of slides and
    friction moments of pins.

    >>> from gruebler.mechanics.forces import Loads, statics
    >>> from gruebler.mechanics.fourbar import SliderCrank
    >>> from gruebler.mechanics.kinematics import move
    >>> press = move(SliderCrank(3, 5).linkage(), np.radians([90.0]))
    >>> table = statics_table(statics(press, Loads(forces={"R(coupler-slider)": (-100, 0)})))
    >>> table["torque R(frame-crank)"].round(9).tolist(), table.columns[1].unit
    ([-300.0], 'N·mm')
    """
    linkage, motion = statics.motion.linkage, statics.motion
    mechanism = linkage.mechanism
    drives, efforts, with_friction, forces = list[Column](), list[Column](), list[Column](), list[Column]()
    rubbing = statics.friction
    for k, (name, drive) in enumerate(
        zip(mechanism.drive_names(Alphabet.of_language(lang)), mechanism.drives, strict=True)
    ):
        values = motion.drives[:, k]
        if drive.turning:
            drives.append(Column(name, unit="°", values=np.degrees(values)))
            effort, unit = translate("torque {joint}", lang, joint=name), moment_unit(linkage.unit, lang)
        else:
            drives.append(Column(name, unit=linkage.unit, values=values))
            effort, unit = translate("force {joint}", lang, joint=name), "N"
        if rubbing is None:
            efforts.append(Column(effort, unit=unit, values=_without_noise(statics, statics.work, k)))
        else:
            efforts.append(Column(effort, unit=unit, values=_without_noise(statics, rubbing.frictionless, k)))
            header = translate("{effort} with friction", lang, effort=effort)
            with_friction.append(Column(header, unit=unit, values=_without_noise(statics, statics.work, k)))
    if rubbing is not None:
        if len(drives) == 1:
            with_friction.append(Column(translate("efficiency", lang), unit="", values=statics.efficiency))
        with_friction.append(
            Column(translate("safety against self-locking", lang), unit="", values=rubbing.locking_factor)
        )
    names, largest = mechanism.chain.joint_names(Alphabet.of_language(lang)), _largest_force(statics)
    for number, joint in enumerate(mechanism.chain.joints):
        for link in joint.links[1:] if len(joint.links) > 2 else [_moving(joint.links, mechanism.frame)]:
            size = np.hypot(*statics.force(number, link=link).T)
            header = translate("force of {joint} on {link}", lang, joint=names[number], link=link)
            forces.append(Column(header, unit="N", values=size, natural=largest))
    if rubbing is not None:
        forces += _friction_columns(statics, rubbing, names, lang)
    return Table((*drives, *efforts, *with_friction, *forces))


def _without_noise(statics: Statics, efforts: Reals, drive: int) -> Reals:
    column = efforts[:, drive]
    return np.where(np.abs(column) <= _NOISE * statics.load[drive], 0.0, column)


def _friction_columns(statics: Statics, rubbing: FrictionForces, names: Sequence[str], lang: str) -> list[Column]:
    """The friction of every contact; that of a joint with several is told apart by the link."""
    columns = []
    kinds = [(contact.joint, contact.slides) for contact in rubbing.contacts]
    for k, contact in enumerate(rubbing.contacts):
        name, several = names[contact.joint], kinds.count(kinds[k]) > 1
        place = translate("{joint} on {link}", lang, joint=name, link=contact.link) if several else name
        if contact.slides:
            header, unit = translate("friction {joint}", lang, joint=place), "N"
        else:
            header, unit = (
                translate("friction moment {joint}", lang, joint=place),
                moment_unit(statics.motion.linkage.unit, lang),
            )
        columns.append(Column(header, unit=unit, values=rubbing.friction[:, k]))
    return columns


def component_table(statics: Statics, lang: str = "en", *, reactions: bool = True) -> Table:
    """Columns of the components of all joint forces, and the moments of slides and of pins that rub, over the rows.

    Forces of a joint are those on all its links; without ``reactions`` of two links only on one, not on the frame.
    """
    linkage = statics.motion.linkage
    mechanism, largest = linkage.mechanism, _largest_force(statics)
    columns, names = [], mechanism.chain.joint_names(Alphabet.of_language(lang))
    contacts = () if statics.friction is None else statics.friction.contacts
    rubbing_pins = {contact.joint for contact in contacts if not contact.slides}
    for number, (joint, name) in enumerate(zip(mechanism.chain.joints, names, strict=True)):
        single = not reactions and len(joint.links) == 2
        for link in (_moving(joint.links, mechanism.frame),) if single else joint.links:
            header = translate("force of {joint} on {link}", lang, joint=name, link=link)
            force = statics.force(number, link=link)
            columns += [
                Column(f"{header} {axis}", unit="N", values=force[:, k], natural=largest) for k, axis in enumerate("xy")
            ]
            if joint.pair.keeps_directions or number in rubbing_pins:
                header = translate("moment of {joint} on {link}", lang, joint=name, link=link)
                moment = statics.couple(number, link=link)
                columns.append(
                    Column(header, unit=moment_unit(linkage.unit, lang), values=moment, natural=largest * linkage.size)
                )
    return Table(tuple(columns))


def _largest_force(statics: Statics) -> float:
    """The largest force of a joint over all rows: what rounding leaves of other forces is as small against it."""
    joints = enumerate(statics.motion.linkage.mechanism.chain.joints)
    sizes = [np.abs(statics.force(number, link=link)) for number, joint in joints for link in joint.links]
    return max(float(np.where(np.isfinite(size), size, 0.0).max(initial=0.0)) for size in sizes)


def _moving(links: Sequence[str], frame: str) -> str:
    return next(link for link in reversed(links) if link != frame)
