"""The tables of dynamics, their columns named in a language."""

from __future__ import annotations

import numpy as np

from gruebler.base.columns import Column, Table
from gruebler.base.text import translate
from gruebler.base.units import metres_of
from gruebler.mechanics.analysis.table import motion_table
from gruebler.mechanics.dynamics.inverse import InverseDynamics
from gruebler.mechanics.dynamics.simulation import Simulation
from gruebler.mechanics.forces.tables import statics_table
from gruebler.structure.chain.pairs import Alphabet


def dynamics_table(run: InverseDynamics, *, lang: str = "en") -> Table:
    """Columns of drive values, efforts and joint forces, as of statics, then power, shaking force and moment.

    Power is in watts; the shaking moment is about the origin of the frame.

    >>> from gruebler.mechanics.dynamics import inverse_dynamics
    >>> from gruebler.mechanics.forces import Loads, RigidBody
    >>> from gruebler.mechanics.fourbar import SliderCrank
    >>> from gruebler.mechanics.kinematics import move
    >>> engine = move(SliderCrank(30, 50).linkage(), np.radians([0.0]), speed=100.0)
    >>> table = dynamics_table(inverse_dynamics(engine, Loads(bodies={"slider": RigidBody(2.0)})))
    >>> table["shaking force x"].round(6).tolist()
    [960.0]
    """
    linkage = run.motion.linkage
    names = linkage.mechanism.drive_names(Alphabet.of_language(lang))
    watts = metres_of(linkage.unit) * run.power
    powers = [
        Column(translate("power {joint}", lang, joint=name), unit="W", values=watts[:, drive])
        for drive, name in enumerate(names)
    ]
    force = translate("shaking force", lang)
    largest = float(np.abs(run.shaking_force).max(initial=0.0))
    shaking = [
        Column(f"{force} {axis}", unit="N", values=run.shaking_force[:, k], natural=largest)
        for k, axis in enumerate("xy")
    ]
    moment = Column(
        translate("shaking moment", lang),
        unit=f"N·{linkage.unit}",
        values=run.shaking_moment(),
        natural=largest * linkage.size,
    )
    return Table((*statics_table(run.statics, lang=lang), *powers, *shaking, moment))


def simulation_table(run: Simulation, *, lang: str = "en") -> Table:
    """Columns of time, then those of the motion's table, then the energies in joules."""
    joule, energy = metres_of(run.linkage.unit), float(run.kinetic.max(initial=0.0)) + float(np.ptp(run.potential))
    energies = (
        (translate("kinetic energy", lang), run.kinetic),
        (translate("potential energy", lang), run.potential),
        (translate("work done", lang), run.work),
    )
    return Table(
        (
            Column(translate("time", lang), unit="s", values=run.times),
            *motion_table(run.motion, lang=lang),
            *(Column(name, unit="J", values=joule * values, natural=joule * energy) for name, values in energies),
        )
    )
