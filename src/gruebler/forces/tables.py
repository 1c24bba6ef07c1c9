"""The tables of statics, their columns named in a language."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gruebler.chain.pairs import Alphabet
from gruebler.columns import Column, Table
from gruebler.forces.friction import as_friction, slide_friction
from gruebler.forces.solution import Statics
from gruebler.text import translate

__all__ = ["component_table", "statics_table"]

_NOISE = 1e-13  # of the loads: a smaller effort is none


def statics_table(statics: Statics, friction: float | None = None, lang: str = "en") -> Table:
    """Columns of drive values, drive efforts and the sizes of joint forces, over the rows.

    Args:
        statics: The forces.
        friction: A coefficient adds the friction of slides and the efforts with it, as an estimate; for one drive.
        lang: Of the names of the columns.

    >>> from gruebler.forces import Loads, statics
    >>> from gruebler.fourbar import SliderCrank
    >>> from gruebler.kinematics import move
    >>> press = move(SliderCrank(3, 5).linkage(), np.radians([90.0]))
    >>> table = statics_table(statics(press, Loads(forces={"R(coupler-slider)": (-100, 0)})))
    >>> table["torque R(frame-crank)"].round(9).tolist(), table.columns[1].unit
    ([-300.0], 'N·mm')
    """
    linkage, motion = statics.motion.linkage, statics.motion
    mechanism = linkage.mechanism
    if friction is not None:
        friction = as_friction(friction)
    drives, efforts, forces = list[Column](), list[Column](), list[Column]()
    for k, (name, drive) in enumerate(
        zip(mechanism.drive_names(Alphabet.of_language(lang)), mechanism.drives, strict=True)
    ):
        values, work = motion.drives[:, k], statics.work[:, k]
        work = np.where(np.abs(work) <= _NOISE * statics.load[k], 0.0, work)
        if drive.turning:
            drives.append(Column(name, "°", np.degrees(values)))
            efforts.append(Column(translate("torque {joint}", lang, joint=name), f"N·{linkage.unit}", work))
        else:
            drives.append(Column(name, linkage.unit, values))
            efforts.append(Column(translate("force {joint}", lang, joint=name), "N", work))
    names, largest = mechanism.chain.joint_names(Alphabet.of_language(lang)), _largest_force(statics)
    for number, joint in enumerate(mechanism.chain.joints):
        for link in joint.links[1:] if len(joint.links) > 2 else [_moving(joint.links, mechanism.frame)]:
            size = np.hypot(*statics.force(number, link).T)
            header = translate("force of {joint} on {link}", lang, joint=names[number], link=link)
            forces.append(Column(header, "N", size, largest))
    for number, joint in enumerate(mechanism.chain.joints if friction is not None else ()):
        if friction is not None and joint.pair.slides_along_one_line:
            slide, effort = slide_friction(statics, number, friction), efforts[0]
            rubbing = translate("friction {joint}", lang, joint=names[number])
            with_friction = translate("with friction {effort}", lang, effort=effort.name)
            forces.append(Column(rubbing, "N", slide.friction, largest))
            forces.append(Column(with_friction, effort.unit, effort.values + slide.effort))
    return Table((*drives, *efforts, *forces))


def component_table(statics: Statics, lang: str = "en", *, reactions: bool = True) -> Table:
    """Columns of the components of all joint forces and the moments of slides, over the rows.

    Args:
        statics: The forces.
        lang: Of the names of the columns.
        reactions: On all links of a joint; otherwise of two links only on one, not on the frame.
    """
    linkage = statics.motion.linkage
    mechanism, largest = linkage.mechanism, _largest_force(statics)
    columns, names = [], mechanism.chain.joint_names(Alphabet.of_language(lang))
    for number, (joint, name) in enumerate(zip(mechanism.chain.joints, names, strict=True)):
        single = not reactions and len(joint.links) == 2
        for link in (_moving(joint.links, mechanism.frame),) if single else joint.links:
            header = translate("force of {joint} on {link}", lang, joint=name, link=link)
            force = statics.force(number, link)
            columns += [Column(f"{header} {axis}", "N", force[:, k], largest) for k, axis in enumerate("xy")]
            if joint.pair.keeps_directions:
                header = translate("moment of {joint} on {link}", lang, joint=name, link=link)
                moment = statics.couple(number, link)
                columns.append(Column(header, f"N·{linkage.unit}", moment, largest * linkage.size))
    return Table(tuple(columns))


def _largest_force(statics: Statics) -> float:
    """The largest force of a joint over all rows: what rounding leaves of other forces is as small against it."""
    joints = enumerate(statics.motion.linkage.mechanism.chain.joints)
    sizes = [np.abs(statics.force(number, link)) for number, joint in joints for link in joint.links]
    return max(float(np.where(np.isfinite(size), size, 0.0).max(initial=0.0)) for size in sizes)


def _moving(links: Sequence[str], frame: str) -> str:
    return next(link for link in reversed(links) if link != frame)
