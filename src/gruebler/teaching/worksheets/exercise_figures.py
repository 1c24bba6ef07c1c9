"""The figure of an exercise: the linkage of its text, with its letters and the points whose paths are asked for."""

from __future__ import annotations

import re
from cmath import rect
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from itertools import combinations, product
from math import cos, inf, pi, radians, sin

import numpy as np

from gruebler.base.text import Text, translate
from gruebler.files import Exercise
from gruebler.machines.gears import read_train
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.gear_trains import linkage_of_train
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.space import SphericalFourBar
from gruebler.pictures.canvas.figure import MARGIN, Figure, figure_of
from gruebler.pictures.canvas.labels import note_near
from gruebler.pictures.canvas.moving_picture import Body, still_picture
from gruebler.pictures.canvas.shapes import Point, Polylines, TextShape
from gruebler.pictures.linkage.picture import draw_linkage
from gruebler.pictures.linkage.posed_linkage import posed_linkage
from gruebler.pictures.machines.bevel_views import bevel_shapes
from gruebler.pictures.machines.train_layout import gear_stages
from gruebler.pictures.space import draw_spatial
from gruebler.pictures.space.parts import points_on_paper
from gruebler.pictures.space.scene import scene_of
from gruebler.pictures.space.views import usual_view, view_named
from gruebler.pictures.structure.messages import describe, title
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry
from gruebler.teaching.exercises import solve
from gruebler.teaching.exercises.coupler_points import read_points

_PARTS = (0.3, 0.1, 0.2, 0.4, 0.6, 0.7, 0.8, 0.9)
"""Of the range of a crank on the sphere: the positions of which the clearest is drawn."""
_TWO_ROCKERS = "R(frame-first) R(first-coupler) R(coupler-second) R(frame-second); frame=frame; drive=R(frame-first)"


@dataclass(frozen=True, slots=True, kw_only=True)
class DrawnLinkage:
    """What is drawn: a linkage, the letters of its links, the driven joint's value and range, points with paths."""

    linkage: Linkage
    letters: Mapping[str, str]
    drive: float | None = None
    between: tuple[float, float] | None = None
    curves: tuple[str, ...] = ()
    show: tuple[str, ...] = ("joints",)
    """Layers of the picture, of one with letters."""
    name: Text | None = None
    """What distinguishes it from the other linkages of the exercise."""
    source: str = ""
    """The machine of the catalog that it is."""
    largest: float = inf
    """The most pixels to a unit."""

    def figure(self, lang: str) -> Figure:
        """Its picture, to scale; points with a number have it as an index."""
        figure = draw_linkage(
            self.linkage,
            at=self.drive,
            between=self.between,
            curves=self.curves,
            show=self.show if self.letters else (),
            labels=bool(self.letters),
            lang=lang,
            names=self.letters,
            largest=self.largest,
        )
        indexed = (
            replace(shape, text=re.sub(r"^K(?=\d)", "K_", shape.text)) if isinstance(shape, TextShape) else shape
            for shape in figure.shapes
        )
        return replace(figure, shapes=tuple(indexed))


def linkage_figure(exercise: Exercise, lang: str) -> Figure | None:
    """The linkage of an exercise to scale; None if its lengths are not all given or cannot be assembled."""
    in_space = _IN_SPACE.get(exercise.method or "")
    if in_space is not None:
        return in_space(exercise, lang)
    drawn = exercise_linkage(exercise)
    return None if drawn is None else drawn.figure(lang)


def exercise_linkages(exercise: Exercise) -> list[DrawnLinkage]:
    """All linkages of which an exercise speaks.

    >>> from gruebler.teaching.exercises import exercise
    >>> [drawn.name.in_language("en") for drawn in exercise_linkages(exercise("13"))]
    ['b = 37.5 mm', 'b = 75 mm']
    """
    if exercise.method == "mobility.machines":
        machines = [entry(case.machine) for case in exercise.cases]
        return [
            DrawnLinkage(
                linkage=machine.linkage(),
                letters={},
                between=machine.between,
                name=machine.name if machines[1:] else None,
                source=machine.id,
            )
            for machine in machines
            if machine.dimensions is not None
        ]
    if exercise.method == "transmission_angle.compare_rods":
        number = _numbers(exercise)
        compared = {number[b]: SliderCrank(number["a"], number[b]).linkage() for b in ("b1", "b2")}
        return [
            DrawnLinkage(
                linkage=linkage,
                letters=_LETTERS | {"frame": " "},
                name=Text(f"b = {b:g} mm", f"b = {b:g} mm".replace(".", ",")),
                largest=min(posed_linkage(each, None).scale for each in compared.values()),
            )
            for b, linkage in compared.items()
        ]
    drawn = exercise_linkage(exercise)
    return [drawn] if drawn else []


def exercise_linkage(exercise: Exercise) -> DrawnLinkage | None:
    """The linkage that the text of an exercise describes, from its given quantities."""
    if exercise.method in _IN_SPACE:
        return None
    own = _OWN.get(exercise.method or "")
    return _of_lengths(exercise) if own is None else own(exercise)


def _of_lengths(exercise: Exercise) -> DrawnLinkage | None:
    """a, b, c, d: crank, coupler, rocker, frame; a, b, e: crank, coupler, eccentricity."""
    given = exercise.given
    size: FourBar | SliderCrank
    lengths = {key: float(given[key]) for key in ("a", "b", "c", "d", "e") if isinstance(given.get(key), int | float)}
    if "b" not in lengths and {"a", "ratio"} <= {*given}:
        lengths["b"] = float(given["a"]) / float(given["ratio"])
    if isinstance(free := given.get("free"), str) and len(lengths) == len("abc"):  # one of those that are asked for
        solution = solve(exercise)
        lengths[free] = (solution.number(f"{free}_min") + solution.number(f"{free}_max")) / 2
    if {*"abcd"} <= {*lengths}:
        size, letters = FourBar(*(lengths[key] for key in "abcd")), _LETTERS
    elif {*"ab"} <= {*lengths} and not {*"cd"} & {*lengths} and "free" not in given:
        size = SliderCrank(lengths["a"], lengths["b"], lengths.get("e", 0.0))
        letters = _LETTERS | {"frame": " "}
    else:
        return None
    phi = radians(float(given["phi"])) if "phi" in given else None
    show = ("joints", *["offset"] * bool(lengths.get("e")), *["angles"] * (phi is not None))  # what the text names
    return DrawnLinkage(linkage=size.linkage(), letters=letters, drive=phi, show=show) if size.limits else None


_LETTERS = {"crank": "a", "coupler": "b", "rocker": "c", "frame": "d", "slider": " "}


def _numbers(exercise: Exercise) -> dict[str, float]:
    return {key: float(value) for key, value in exercise.given.items() if isinstance(value, int | float)}


def _rows(exercise: Exercise) -> list[list[float]]:
    """The numbers of the solution's first table."""
    rows = solve(exercise).tables[0].rows
    return [[float(value) for value in row if isinstance(value, int | float)] for row in rows]


def _drawn(places: Mapping[str, complex], points: Mapping[str, tuple[str, complex]]) -> Linkage:
    """Two rockers and a coupler, drawn with their joints in these places."""
    return Linkage.from_drawing(
        Mechanism.parse(_TWO_ROCKERS),
        {joint: (z.real, z.imag) for joint, z in places.items()},
        points={name: (link, z.real, z.imag) for name, (link, z) in points.items()},
    )


def _double_rocker(exercise: Exercise) -> DrawnLinkage:
    """The middle row of the solution's table: coupler a, rockers d (driven) and b, frame c at its angle."""
    number = _numbers(exercise)
    rows = _rows(exercise)
    phi, *xy = rows[len(rows) // 2]
    a, d, c = (complex(*xy[k : k + 2]) for k in (0, 2, 4))
    other = rect(number["c"], radians(number["frame"]))
    places = {"R(frame-first)": 0j, "R(first-coupler)": d, "R(coupler-second)": a, "R(frame-second)": other}
    points = {"A": ("coupler", a), "D": ("coupler", d), "C": ("coupler", c)}
    between = radians(rows[0][0]), radians(rows[-1][0])
    letters = {"first": "d", "coupler": "a", "second": "b", "frame": "c"}
    return DrawnLinkage(
        linkage=_drawn(places, points), letters=letters, drive=radians(phi), between=between, curves=("C",), show=()
    )


def _watt(exercise: Exercise) -> DrawnLinkage:
    """The middle position of the solution: both rockers level, the coupler upright; F as far as it runs straight."""
    number = _numbers(exercise)
    a, up = number["rocker"], number["coupler"] / 2 * 1j
    places = {"R(frame-first)": -a + up, "R(first-coupler)": up, "R(coupler-second)": -up, "R(frame-second)": a - up}
    solution = solve(exercise)
    between = radians(solution.number("t_low")), radians(solution.number("t_high"))
    letters = {"first": "a", "coupler": "c", "second": "b", "frame": " "}
    return DrawnLinkage(
        linkage=_drawn(places, {"F": ("coupler", 0j)}), letters=letters, drive=0.0, between=between, curves=("F",)
    )


def _lambda(exercise: Exercise) -> DrawnLinkage:
    a, b, c, d, e = (_numbers(exercise)[key] for key in "abcde")
    return DrawnLinkage(linkage=FourBar(a, b, c, d).linkage({"C": (b + e, 0)}), letters=_LETTERS, curves=("C",))


def _scott_russell(exercise: Exercise) -> DrawnLinkage:
    """C lies e beyond A on the line B-A; e is no eccentricity here."""
    a, b, e = (_numbers(exercise)[key] for key in "abe")
    letters = _LETTERS | {"frame": " "}
    return DrawnLinkage(linkage=SliderCrank(a, b).linkage({"C": (-e, 0)}), letters=letters, drive=pi / 4, curves=("C",))


def _conchoid(exercise: Exercise) -> DrawnLinkage:
    a, d, b = (_numbers(exercise)[key] for key in "adb")
    linkage = InvertedSliderCrank(a, d).linkage({"C": (b, 0)})
    letters = {"frame": "d", "crank": "a", "coupler": "b", "block": " "}
    return DrawnLinkage(linkage=linkage, letters=letters, drive=radians(60), curves=("C",))


def _coupler_points(exercise: Exercise) -> DrawnLinkage:
    a, b, c, d = (_numbers(exercise)[key] for key in "abcd")
    places = read_points(str(exercise.given["points"]))
    points = {f"K{k}" if len(places) > 1 else "K": place for k, place in enumerate(places, 1)}
    return DrawnLinkage(
        linkage=FourBar(a, b, c, d).linkage(points), letters=_LETTERS, drive=radians(60), curves=tuple(points)
    )


def _gear_pair(exercise: Exercise) -> DrawnLinkage:
    """A small wheel that drives a larger one with i times its teeth."""
    train = read_train(f"drive:20 wheel:{20 * _numbers(exercise)['i']:g}; drive=1").train
    return DrawnLinkage(linkage=linkage_of_train(train, ["drive"]), letters={})


def _central_crank_rocker(exercise: Exercise) -> DrawnLinkage:
    """With the frame that is asked for."""
    a, b, c = (_numbers(exercise)[key] for key in "abc")
    return DrawnLinkage(linkage=FourBar.central(a=a, b=b, c=c).linkage(), letters=_LETTERS)


_OWN: Mapping[str, Callable[[Exercise], DrawnLinkage]] = {
    "coupler_points.conchoid": _conchoid,
    "coupler_points.four_bar": _coupler_points,
    "dead_centres.central_crank_rocker": _central_crank_rocker,
    "straight_guides.double_rocker": _double_rocker,
    "straight_guides.lambda_linkage": _lambda,
    "straight_guides.scott_russell": _scott_russell,
    "straight_guides.watt_linkage": _watt,
    "transfer.gear_pair": _gear_pair,
}
"""Methods whose letters mean something else than those of `_of_lengths`, or that ask for paths of points."""


# --- in space ---------------------------------------------------------------------------------------


def _universal_joint(exercise: Exercise, lang: str) -> Figure:
    """Both shafts with their speeds and the cross, the output turned by the angle β between the shafts."""
    beta = radians(_numbers(exercise)["beta"])
    axes = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (cos(beta), sin(beta), 0.0))
    joint = entry("universal_joint").placed()
    assert joint is not None
    linkage = SpatialLinkage(joint.mechanism, {k: {"z": z} for k, z in enumerate(axes)})
    scene = scene_of(linkage, view_named(usual_view(linkage)))
    meet = -scene.scale * scene.middle
    ends = scene.joints[[0, 3]]
    driving, driven = ((end - meet) / np.linalg.norm(end - meet) for end in ends)
    reach = 0.8 * float(np.linalg.norm(ends[1] - meet))
    turns = np.linspace(0, beta, 25)[:, None]
    arc = meet + reach * (np.sin(beta - turns) * -driving + np.sin(turns) * driven) / sin(beta)
    straight = np.array([meet, meet - 1.15 * reach * driving])

    def points(places: np.ndarray) -> tuple[Point, ...]:
        return tuple(points_on_paper(scene.view.on_paper(places)))

    shapes = [*scene.shapes(), Polylines((points(straight),), "pitch"), Polylines((points(arc),), "measure")]
    for place, name in ((arc[12], "β"), (ends[0], "n₁"), (ends[1], "n₂")):
        shapes.append(note_near(points(place[None])[0], name, "letter", shapes))
    return figure_of(shapes, title(joint.mechanism, lang, ""), describe(joint.mechanism, lang), margin=MARGIN)


def _spherical_four_bar(exercise: Exercise, lang: str) -> Figure:
    size = SphericalFourBar(*(radians(_numbers(exercise)[key]) for key in "abcd"))
    arc = size.limits[0]
    drawn = [size.linkage(arc.start + part * (arc.end - arc.start)) for part in _PARTS]
    names = {link: letter for link, letter in _LETTERS.items() if letter.strip()}
    figure = draw_spatial(max(drawn, key=_room_between), labels=True, names=names, lang=lang)
    pins = zip(figure.shapes[-4:], ("A_0", "A", "B", "B_0"), strict=True)  # which have the letter of their pair
    letters = [replace(shape, text=pin) for shape, pin in pins if isinstance(shape, TextShape)]
    return replace(figure, shapes=(*figure.shapes[:-4], *letters))


def _room_between(linkage: SpatialLinkage) -> float:
    """How far opposite links of a four-bar on the sphere, and its joints, lie apart on paper where they are nearest."""
    scene = scene_of(linkage, view_named(usual_view(linkage)))
    middle = -scene.scale * scene.middle
    pins = scene.joints - middle
    size = np.linalg.norm(pins, axis=1).max()
    shares = np.linspace(0.1, 0.9, 9)[:, None]
    lines = [(1 - shares) * pin + shares * after for pin, after in zip(pins, np.roll(pins, -1, axis=0), strict=True)]
    arcs = [size * line / np.linalg.norm(line, axis=1)[:, None] for line in lines]
    first, second, third, fourth, joints = (scene.view.on_paper(z + middle)[:, :2] @ (1, 1j) for z in (*arcs, pins))
    pairs = [*product(first, third), *product(second, fourth), *combinations(joints, 2)]
    return float(min(abs(place - other) for place, other in pairs))


def _differential(exercise: Exercise, lang: str) -> Figure:
    """From the side and the front, the teeth of the task or equal wheels; named as the speeds are, by their indices."""
    number = _numbers(exercise)
    sun, planet = number.get("z_s", 16.0), number.get("z_p", 10.0)
    (stage,) = gear_stages(read_train(f"bevel 1:{sun:g} p:{planet:g} 2:-{sun:g} on C").train, {"p": 2})
    shapes = bevel_shapes(stage)
    assert shapes is not None
    about = translate("Shafts 1 and 2, planets p, carrier C, from the side and along the axis of the shafts.", lang)
    return still_picture([Body(tuple(shapes))], translate("Bevel differential", lang), about)


_IN_SPACE: Mapping[str, Callable[[Exercise, str], Figure]] = {
    "in_space.universal_joint": _universal_joint,
    "in_space.spherical_grashof": _spherical_four_bar,
    "in_space.differential": _differential,
    "in_space.differential_in_a_curve": _differential,
}
"""Methods whose machines do not lie in a plane."""
