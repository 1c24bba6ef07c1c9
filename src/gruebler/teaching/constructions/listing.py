"""All constructions by name: one row for each, with one function for each form of linkage."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import radians

from gruebler.base.errors import GrueblerError, unknown
from gruebler.base.text import Message, joined_by_or, message
from gruebler.design.synthesis.dead_centres import dead_centre_family
from gruebler.design.synthesis.tasks import DeadCentreTask
from gruebler.mechanics.linkages.quantities import as_positive
from gruebler.pictures.canvas.construction import Construction
from gruebler.pictures.designs.alt_construction import alt_steps
from gruebler.teaching.constructions.accelerations import (
    accelerations_of_four_bar,
    accelerations_of_inverted_slider_crank,
    accelerations_of_scotch_yoke,
    accelerations_of_slider_crank,
    accelerations_of_tangent_mechanism,
)
from gruebler.teaching.constructions.curves import (
    bobillier,
    coupler_curve_by_points,
    inflection_circle,
    meyer_zur_capellen,
    roberts_cognates,
)
from gruebler.teaching.constructions.dead_centres import (
    central_crank_rocker,
    dead_centres_of_crank_rocker,
    dead_centres_of_slider_crank,
    permissible_frame,
    transmission_of_crank_rocker,
    transmission_of_slider_crank,
)
from gruebler.teaching.constructions.instant_centres import instant_centres_of_four_bar, instant_centres_of_slider_crank
from gruebler.teaching.constructions.machines import cam_profile, geneva_drive
from gruebler.teaching.constructions.positions import three_positions, two_positions
from gruebler.teaching.constructions.two_views import (
    dead_centres_of_rssr,
    rssr_in_two_views,
    universal_joint_in_two_views,
)
from gruebler.teaching.constructions.velocities import (
    velocities_of_four_bar,
    velocities_of_inverted_slider_crank,
    velocities_of_scotch_yoke,
    velocities_of_slider_crank,
    velocities_of_tangent_mechanism,
)

_LENGTHS = frozenset("abcd")  # of links; an offset e may have either sign
Value = float | str
Maker = Callable[..., Construction]


@dataclass(frozen=True, slots=True)
class ConstructionRow:
    """A construction: its name, what it gives, its chapter, and who makes it for which form of linkage."""

    name: str
    title: Message
    chapter: str
    makers: Mapping[str, Maker]


def alt(swing: float = 60, crank_angle: float = 200) -> Construction:
    """Alt's construction of the crank-rocker with a swing and a crank angle between the dead centres, in degrees."""
    task = DeadCentreTask(swing=radians(swing), crank_angle=radians(crank_angle))
    return alt_steps(task, dead_centre_family(task).best)


_FOUR, _SLIDER, _INVERTED = "four-bar", "slider-crank", "inverted-slider-crank"
_YOKE, _TANGENT = "scotch-yoke", "tangent-mechanism"
_ROWS = (
    ConstructionRow(
        "dead-centres",
        message("dead centres of crank-rocker and slider-crank"),
        "3.2",
        {_FOUR: dead_centres_of_crank_rocker, _SLIDER: dead_centres_of_slider_crank},
    ),
    ConstructionRow(
        "transmission-angle",
        message("extremes of the transmission angle"),
        "3.4",
        {_FOUR: transmission_of_crank_rocker, _SLIDER: transmission_of_slider_crank},
    ),
    ConstructionRow(
        "central-crank-rocker", message("frame of a central crank-rocker"), "3.2.2", {"": central_crank_rocker}
    ),
    ConstructionRow(
        "permissible-frame", message("lengths of the frame for which the crank turns"), "3.1", {"": permissible_frame}
    ),
    ConstructionRow("alt", message("Alt's crank-rocker from swing and crank angle"), "", {"": alt}),
    ConstructionRow(
        "instant-centres",
        message("instant centres and polar rays"),
        "3.6.1",
        {_FOUR: instant_centres_of_four_bar, _SLIDER: instant_centres_of_slider_crank},
    ),
    ConstructionRow(
        "velocities",
        message("polygon of velocities"),
        "3.6.2",
        {
            _FOUR: velocities_of_four_bar,
            _SLIDER: velocities_of_slider_crank,
            _INVERTED: velocities_of_inverted_slider_crank,
            _YOKE: velocities_of_scotch_yoke,
            _TANGENT: velocities_of_tangent_mechanism,
        },
    ),
    ConstructionRow(
        "accelerations",
        message("polygon of accelerations, with Coriolis on a lever"),
        "3.6.2",
        {
            _FOUR: accelerations_of_four_bar,
            _SLIDER: accelerations_of_slider_crank,
            _INVERTED: accelerations_of_inverted_slider_crank,
            _YOKE: accelerations_of_scotch_yoke,
            _TANGENT: accelerations_of_tangent_mechanism,
        },
    ),
    ConstructionRow(
        "coupler-curve", message("coupler curve point by point"), "3.5.2", {_FOUR: coupler_curve_by_points}
    ),
    ConstructionRow(
        "inflection-circle", message("inflection circle by Euler and Savary"), "", {_FOUR: inflection_circle}
    ),
    ConstructionRow("bobillier", message("pole tangent and centre of curvature by Bobillier"), "", {_FOUR: bobillier}),
    ConstructionRow("roberts", message("Roberts' cognates"), "001", {_FOUR: roberts_cognates}),
    ConstructionRow(
        "meyer-zur-capellen", message("six-point straight line of Meyer zur Capellen"), "001", {"": meyer_zur_capellen}
    ),
    ConstructionRow("two-positions", message("linkage for two positions of a body"), "", {"": two_positions}),
    ConstructionRow("three-positions", message("linkage for three positions of a body"), "", {"": three_positions}),
    ConstructionRow(
        "universal-joint", message("angle of a universal joint in two views"), "", {"": universal_joint_in_two_views}
    ),
    ConstructionRow("rssr", message("position of an RSSR linkage in two views"), "", {"": rssr_in_two_views}),
    ConstructionRow(
        "rssr-dead-centres", message("dead centres of an RSSR linkage in two views"), "", {"": dead_centres_of_rssr}
    ),
    ConstructionRow("geneva", message("Geneva drive"), "1", {"": geneva_drive}),
    ConstructionRow("cam", message("cam profile from its lift diagram"), "1", {"": cam_profile}),
)
CONSTRUCTIONS: Mapping[str, ConstructionRow] = {row.name: row for row in _ROWS}
"""The constructions by name."""


def construction_forms(name: str) -> dict[str, dict[str, Value]]:
    """The forms of a construction, each with its quantities and what they are where they are not given.

    >>> construction_forms("central-crank-rocker")
    {'': {'a': 30, 'b': 75, 'c': 60}}
    """
    return {form: _defaults(make) for form, make in _row(name).makers.items()}


def construction(name: str, form: str = "", **values: Value) -> Construction:
    """A construction with the quantities given; the others are those of the teaching documents. Angles in degrees.

    Raises `GrueblerError` for an unknown name, form or quantity, and for lengths with which it is impossible.

    >>> made = construction("central-crank-rocker", a=30, b=75, c=60)
    >>> len(made.steps), round(made.values["d"], 4)
    (4, 91.2414)
    """
    makers = _row(name).makers
    if form and form not in makers:
        raise GrueblerError(
            "{name}: the form is {forms}, not {form!r}",
            name=name,
            forms=joined_by_or([*makers]) if [*makers] != [""] else "-",
            form=form,
        )
    make = makers[form] if form in makers else next(iter(makers.values()))
    known = _defaults(make)
    sound = {key: _checked(name, key, value, known) for key, value in values.items()}
    return make(**sound)


def _row(name: str) -> ConstructionRow:
    if name not in CONSTRUCTIONS:
        raise GrueblerError(
            "there is no construction {word!r}{suggestion}; there are {known}", **unknown(name, CONSTRUCTIONS)
        )
    return CONSTRUCTIONS[name]


def _defaults(make: Maker) -> dict[str, Value]:
    return {key: parameter.default for key, parameter in inspect.signature(make).parameters.items()}


def _checked(name: str, key: str, value: Value, known: Mapping[str, Value]) -> Value:
    """A quantity as the construction takes it."""
    if key not in known:
        raise GrueblerError(
            "{name} has no quantity {word!r}{suggestion}; it has {known}", name=name, **unknown(key, known)
        )
    if isinstance(known[key], str):
        return value
    try:
        number = float(value.replace(",", ".")) if isinstance(value, str) else value
    except ValueError:
        raise GrueblerError("{key}: expected a number, but found {value!r}", key=key, value=value) from None
    return as_positive(key, number) if key in _LENGTHS else number
