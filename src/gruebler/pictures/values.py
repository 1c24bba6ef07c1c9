"""Pictures of everything that has one: `draw`, `animate` and `plot`, and how values show themselves in notebooks."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from gruebler.base.atomic_files import write_whole
from gruebler.base.doors import door
from gruebler.base.errors import GrueblerError, to_be_read, unknown
from gruebler.base.text import Message, message, translate
from gruebler.mechanics.forces.loads import Loads
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.files import picture_bytes, suffix_of
from gruebler.pictures.canvas.textbook import textbook

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from gruebler.mechanics.dynamics.inverse import InverseDynamics
    from gruebler.mechanics.dynamics.simulation import Simulation
    from gruebler.mechanics.kinematics.motion import Motion
    from gruebler.mechanics.linkages import Linkage
    from gruebler.mechanics.linkages.branch import Branch
    from gruebler.mechanics.linkages.conversion import LinkageLike
    from gruebler.mechanics.linkages.points import PointLike
    from gruebler.mechanics.screws.conversion import SpatialLike
    from gruebler.pictures.canvas.moving_frames import FramePicture
    from gruebler.pictures.canvas.moving_picture import MovingPicture
    from gruebler.structure.mechanism import Mechanism

_MOVING = ("svg", "html", "gif", "webp", "png")


@dataclass(frozen=True, slots=True)
class Picture:
    """A picture that shows itself in a notebook and can be saved."""

    figure: Figure

    def svg(self) -> str:
        """The picture as SVG."""
        return self.figure.svg()

    def textbook(self) -> Picture:
        """The picture in black, one line of 0.7 mm a link, all others 0.35 mm wide."""
        return Picture(textbook(self.figure))

    def save(self, path: Path | str, *, dark: bool = False) -> Path:
        """Write it into a ``.svg``, ``.png``, ``.pdf`` or ``.tex`` file (TikZ), or not at all; returns the path.

        Raises `GrueblerError` for another ending, or if PNG or PDF need matplotlib and it is missing.
        """
        return _saved(path, partial(picture_bytes, self.figure, dark=dark), suffix_of(Path(path)))

    def __repr__(self) -> str:
        return f"<Picture {self.figure.title!r}, {self.figure.width:.0f} x {self.figure.height:.0f}>"

    def _repr_svg_(self) -> str:
        return self.svg()


@dataclass(frozen=True, slots=True)
class Animation:
    """A moving picture that shows itself in a notebook and can be saved."""

    title: str
    _content: Callable[..., bytes]

    def svg(self) -> str:
        """The moving picture as SVG without script."""
        return self._content("svg").decode("utf-8")

    def html(self) -> str:
        """One HTML page with play, pause and a slider for the drive."""
        return self._content("html").decode("utf-8")

    def save(self, path: Path | str, *, dark: bool = False) -> Path:
        """Write it into a ``.svg``, ``.html``, ``.gif``, ``.webp`` or ``.png`` (APNG) file; returns the path.

        Raises `GrueblerError` for another ending, or if matplotlib is needed and missing.
        """
        return _saved(path, partial(self._content, dark=dark), suffix_of(Path(path), _MOVING))

    def __repr__(self) -> str:
        return f"<Animation {self.title!r}>"

    def _repr_svg_(self) -> str:
        return self.svg()


def _saved(path: Path | str, content: Callable[[str], bytes], suffix: str) -> Path:
    write_whole(Path(path), content(suffix))
    return Path(path)


class _Kind(NamedTuple):
    """Where a class of values is drawn."""

    module: str
    still: str
    moving: str = ""


_KINDS: Mapping[str, _Kind] = {
    "Chain": _Kind("structure.picture", "draw_structure"),
    "Mechanism": _Kind("structure.picture", "draw_structure"),
    "Linkage": _Kind("linkage.picture", "draw_linkage", "linkage"),
    "SpatialLinkage": _Kind("space", "draw_spatial", "animate_spatial"),
    "Motion": _Kind("linkage.motion_picture", "draw_motion"),
    "Cam": _Kind("machines.cam_picture", "draw_cam", "animate_cam"),
    "Geneva": _Kind("machines.geneva_picture", "draw_geneva", "animate_geneva"),
    "Train": _Kind("machines.train_picture", "draw_train", "animate_train"),
}
_PLOTS = {
    "transfer": ("linkage.motion_plots", "transfer_plot"),
    "transmission": ("linkage.motion_plots", "transmission_plot"),
    "hodograph": ("linkage.curve_plots", "hodograph"),
    "curves": ("linkage.curve_plots", "coupler_plot"),
    "family": ("linkage.curve_plots", "family_plot"),
}
_FORCE_PLOTS = {
    "torque": ("linkage.force_plots", "effort_plot"),
    "forces": ("linkage.force_plots", "force_plot"),
}
_PHASE_PLOTS = {"phase": ("linkage.force_plots", "phase_plot")}
_SPATIAL_PLOTS = {"transfer": ("space", "plot_spatial")}
_PLOTS_OF = {"InverseDynamics": _FORCE_PLOTS, "Simulation": _PHASE_PLOTS, "SpatialLinkage": _SPATIAL_PLOTS}
"""Diagrams of other values than linkages and motions, the usual one first."""

_OF_PICTURE = message("the picture of a {kind} has no option {word!r}{suggestion}; it has {known}")
_OF_ANIMATION = message("the moving picture of a {kind} has no option {word!r}{suggestion}; it has {known}")
_OF_DIAGRAM = message("the diagram {kind!r} has no option {word!r}{suggestion}; it has {known}")


@door
def draw(
    value: object,
    *,
    loads: Loads | None = None,
    branch: Branch = None,
    at: float | Sequence[float] | None = None,
    between: tuple[float, float] | None = None,
    speed: float | None = None,
    curves: Sequence[PointLike] | None = None,
    show: Sequence[str] | None = None,
    output: str | None = None,
    outputs: Collection[str] | None = None,
    ghost: int | None = None,
    labels: bool | None = None,
    symbols: bool | None = None,
    contacts: Mapping[tuple[int, str], str] | None = None,
    planets: Mapping[str, int] | None = None,
    teeth: bool | None = None,
    plot: bool | None = None,
    view: str | None = None,
    names: Mapping[str, str] | None = None,
    letters: Sequence[str] | None = None,
    name: str | None = None,
    lang: str | None = None,
) -> Picture:
    """A picture of a chain, mechanism, linkage, motion, cam, Geneva drive or gear train.

    Every kind of value takes ``name`` and ``lang``; which further options it takes stands with each.

    Args:
        value: what is drawn; also a `FourBar`, `SliderCrank` or `InvertedSliderCrank`.
        loads: of a linkage: whose centres of mass and springs are drawn.
        branch: of a linkage: the assembly mode, such as ``"+-"``.
        at: of a linkage: the values of its drives (radians, or lengths); of a cam or Geneva drive: the driver's angle
            in radians. By default a suitable position.
        between: of a linkage: drive values of its range, for curves and the size of the picture.
        speed: of a linkage with loads: the even speed of its drive at which forces of joints and loads are drawn as
            arrows.
        curves: of a linkage: points or joints whose paths are drawn.
        show: of a linkage: ``dead-centres``, ``transmission``, ``velocities``, ``accelerations``, ``poles``,
            ``centrodes``, ``inflection``, ``planes``, ``dimensions``, ``scale``; as letters ``joints``, ``angles``,
            ``lengths``.
        output: of a linkage: the link of dead centres and transmission angle.
        outputs: of a chain or mechanism: links that get a double arrow.
        ghost: of a linkage: the number of thinly drawn positions, at most 60.
        labels: of a chain, mechanism or linkage: whether to name the links.
        symbols: of a chain or mechanism: whether to write the symbols of pairs without a sign of their own; of a
            `SpatialLinkage`: whether to write the symbols of its joints.
        contacts: of a chain or mechanism: what the bodies of higher pairs are, by joint number and link.
        planets: of a train: the numbers of equal planets by name.
        teeth: of a train: whether gears have involute teeth.
        plot: of a cam or Geneva drive: whether diagrams stand below.
        view: of a `SpatialLinkage`: ``isometric`` or ``oblique``; without it oblique for bevel wheels, else isometric.
        names: of a chain, mechanism or linkage: other names for links in the picture.
        letters: of a linkage: names of its turning joints in their order, for ``joints``; by default A₀, A, B, B₀.
        name: the title; by default the kind.
        lang: language of title and description, ``en`` or ``de``.

    Returns:
        A `Picture`: it shows itself in a notebook; `Picture.svg` is a text, `Picture.save` writes a file.

    Raises:
        GrueblerError: a value without a picture, an option that this kind of value does not take.
        LinkageError: a pose that cannot be reached, unknown points or links.

    Cost:
        1 to 30 ms; with curves or ``between`` that of the drive cycle, 10 to 500 ms.

    Example:
        >>> import gruebler as gr
        >>> gr.draw(gr.FourBar(25, 70, 40, 70))
        <Picture 'four-bar linkage', 328 x 195>

    See Also:
        `animate`, `plot`, `explore`, `write`

    Theory:
        docs/theory/drawing.md
    """
    given = _given(locals())
    drawn, kind = _drawn(value)
    if drawn is not value and lang is not None:  # of lengths, whose links have the names of their roles
        given.setdefault("names", {link: translate(link, lang) for link in drawn.mechanism.chain.links})
    return Picture(_called(_OF_PICTURE, type(value).__name__, _function(kind.module, kind.still), drawn, given))


@door
def animate(
    value: object,
    *,
    loads: Loads | None = None,
    drives: ArrayLike | Mapping[str, object] | None = None,
    branch: Branch = None,
    between: tuple[float, float] | None = None,
    speed: float | None = None,
    curves: Sequence[PointLike] | None = None,
    planets: Mapping[str, int] | None = None,
    teeth: bool | None = None,
    plot: bool | None = None,
    view: str | None = None,
    most: int | None = None,
    seconds: float = 4.0,
    name: str | None = None,
    lang: str | None = None,
) -> Animation:
    """A moving picture of a linkage, cam, Geneva drive or gear train, one turn of the drive in the given time.

    Args:
        value: what moves; also a `FourBar`, `SliderCrank` or `InvertedSliderCrank`.
        loads: of a linkage: whose centres of mass and springs are drawn.
        drives: of a linkage: (rows, drives) a piecewise straight path of its drives; of a train: speeds or turns by
            link.
        branch: of a linkage: the assembly mode, such as ``"+-"``.
        between: of a linkage: drive values (radians, or lengths) between which it moves; by default the full range.
        speed: of a linkage with loads: the even speed of its drive at which forces of joints and loads are drawn as
            arrows.
        curves: of a linkage: points or joints whose paths are drawn.
        planets: of a train: the numbers of equal planets by name.
        teeth: of a train: whether gears have involute teeth.
        plot: of a cam or Geneva drive: whether the diagram with a cursor stands below.
        view: of a `SpatialLinkage`: ``isometric`` or ``oblique``; without it oblique for bevel wheels, else isometric.
        most: of a train: the number of turns after which the picture may begin again though it does not repeat.
        seconds: for a turn of the drive, or for there and back.
        name: the title; by default the kind.
        lang: language of title and description, ``en`` or ``de``.

    Returns:
        An `Animation`: it shows itself in a notebook; `Animation.save` writes SVG, HTML, GIF, WebP or APNG.

    Raises:
        GrueblerError: a value that has no moving picture, an option that this kind of value does not take.
        LinkageError: a linkage that does not move.

    Cost:
        Some 50 ms for a linkage, 3 s for one in space; files of pictures (GIF, WebP, APNG) some 50 ms a frame.

    Example:
        >>> import gruebler as gr
        >>> gr.animate(gr.Geneva(4))
        <Animation 'External Geneva drive with 4 slots'>

    See Also:
        `draw`, `plot`, `explore`

    Theory:
        docs/theory/drawing.md
    """
    given = _given(locals())
    drawn, kind = _drawn(value)
    if not kind.moving:
        raise GrueblerError(
            "values of type {kind} have no moving picture: animate a linkage, cam, Geneva drive or train",
            kind=type(value).__name__,
        )
    if kind.moving == "linkage":
        _check_options(_OF_ANIMATION, type(value).__name__, _function("linkage.animation", "scene"), given)
        return Animation(given.get("name") or _title(drawn.mechanism), partial(_linkage_content, drawn, given))
    function = _function(kind.module, kind.moving)
    shown: MovingPicture | FramePicture = _called(_OF_ANIMATION, type(value).__name__, function, drawn, given)
    return Animation(shown.page.title, partial(_machine_content, shown, lang or "en"))


@door
def plot(
    linkage: LinkageLike | SpatialLike | Motion | InverseDynamics | Simulation,
    kind: str = "transfer",
    *,
    branch: Branch = None,
    between: tuple[float, float] | None = None,
    speed: float | None = None,
    drive: str | None = None,
    output: str | None = None,
    points: Sequence[PointLike] | None = None,
    link: str | None = None,
    start: complex | None = None,
    end: complex | None = None,
    count: int | None = None,
    names: Mapping[str, str] | None = None,
    name: str | None = None,
    lang: str | None = None,
) -> Picture:
    """A diagram of a linkage with one drive, of forces in its motion, or of its free motion.

    Every diagram takes ``branch``, ``between``, ``name`` and ``lang``; which further options it takes stands with each.

    Args:
        linkage: also a `FourBar`, `SliderCrank` or `InvertedSliderCrank`; a `Motion` stands for its linkage on its
            branch, between its smallest and largest drive value. What `inverse_dynamics` returns has diagrams of its
            own, ``torque`` (with the power; the usual one) and ``forces`` (of joints, in polar form); what `simulate`
            returns has ``phase`` (speed over drive); a `SpatialLinkage`, or what makes one, has ``transfer``.
        kind: ``transfer`` (the output and its derivatives), ``transmission`` (transmission angle), ``hodograph``,
            ``curves`` (paths of points) or ``family`` (paths of points on a line of one link).
        branch: the assembly mode, such as ``"+-"``.
        between: drive values between which it is plotted (radians, or lengths); by default the full range.
        speed: of ``hodograph``: that of the drive, in rad/s or lengths a second; without it velocities are by drive.
        drive: of a `SpatialLinkage` with several drives: the joint that moves while the others stay; by default the
            first.
        output: of ``transfer`` and ``transmission``: a link or sliding joint, in space a joint; by default the
            linkage's own output.
        points: of ``hodograph``, ``curves`` and ``forces``: names of points or joints, at most eight.
        link: of ``family``: the link of the points.
        start: of ``family``: one end of the line, x + iy in coordinates of the link.
        end: of ``family``: the other end.
        count: of ``family``: how many points, 2 to 8.
        names: of ``transfer`` and ``transmission``: other names for links.
        name: of the linkage; by default its kind.
        lang: language of the labels, ``en`` or ``de``.

    Returns:
        A `Picture`: it shows itself in a notebook; `Picture.svg` is a text, `Picture.save` writes a file.

    Raises:
        GrueblerError: no such diagram, an option that it does not take.
        LinkageError: several drives, unknown points or links, a linkage that cannot be assembled.

    Cost:
        That of the drive cycle, 10 to 500 ms; in space 1 to 2 s.

    Example:
        >>> import gruebler as gr
        >>> gr.plot(gr.FourBar(25, 70, 40, 70), "transmission")
        <Picture 'four-bar linkage: transmission angle of rocker', 705 x 410>

    See Also:
        `draw`, `animate`, `measures`, `coupler_curve`

    Theory:
        docs/theory/events.md
    """
    given = _given(locals())
    from gruebler.mechanics.linkages.conversion import linkage_made

    linkage = linkage_made(linkage, unit="")
    own = _PLOTS_OF.get(type(linkage).__name__)
    known = own or _PLOTS
    if own and kind == "transfer":
        kind = next(iter(own))
    if kind not in known:
        raise GrueblerError("there is no plot {word!r}{suggestion}; there are {known}", **unknown(kind, known))
    plotted = (linkage, given) if own else _plotted(linkage, given)
    return Picture(_called(_OF_DIAGRAM, kind, _function(*known[kind]), *plotted))


def _plotted(linkage: Any, given: dict[str, Any]) -> tuple[Linkage, dict[str, Any]]:
    """The linkage that is plotted, with the branch and the range of a motion."""
    from gruebler.mechanics.kinematics.motion import Motion
    from gruebler.mechanics.linkages.conversion import as_linkage

    if not isinstance(linkage, Motion):
        return as_linkage(linkage, unit=""), given
    if len(linkage) < 2:
        raise GrueblerError("this motion has {count} rows, and no diagram: plot its linkage", count=len(linkage))
    low, high = float(linkage.drives[:, 0].min()), float(linkage.drives[:, 0].max())
    return linkage.linkage, {"branch": linkage.branch, "between": (low, high), **given}


def picture_of(value: object) -> str:
    """The SVG of a value for a notebook; of a linkage that cannot be placed, its structure and the reason."""
    value, kind = _drawn(value)
    match type(value).__name__:
        case "Linkage":
            figure = _function(kind.module, "shown_linkage")(value)
        case "Chain" | "Mechanism":
            figure = _function(kind.module, kind.still)(value, labels=True)
        case _:
            figure = _function(kind.module, kind.still)(value)
    return str(figure.svg())


def _drawn(value: Any) -> tuple[Any, _Kind]:
    """The value that is drawn, and how: a linkage for lengths that make one."""
    from gruebler.mechanics.linkages.conversion import linkage_made

    if type(value).__name__ not in _KINDS:
        value = linkage_made(value, unit="")
    kind = _KINDS.get(type(value).__name__)
    if kind is None and isinstance(value, str):
        raise GrueblerError("a text has no picture; {call} reads what it stands for", call=to_be_read(value))
    if kind is None:
        raise GrueblerError(
            "values of type {kind} have no picture; these have: {known}, FourBar, SliderCrank, InvertedSliderCrank",
            kind=type(value).__name__,
            known=", ".join(_KINDS),
        )
    return value, kind


def _function(module: str, name: str) -> Callable[..., Any]:
    function: Callable[..., Any] = getattr(import_module(f"gruebler.pictures.{module}"), name)
    return function


def _given(arguments: Mapping[str, Any]) -> dict[str, Any]:
    """The options that were given; None is none."""
    return {
        name: value
        for name, value in arguments.items()
        if value is not None and name not in ("value", "linkage", "kind")
    }


def _called(text: Message, kind: str, function: Callable[..., Any], value: object, given: Mapping[str, Any]) -> Any:
    """The function's answer; options that it does not take are refused."""
    _check_options(text, kind, function, given)
    return function(value, **given)


def _check_options(text: Message, kind: str, function: Callable[..., Any], given: Mapping[str, Any]) -> None:
    from inspect import signature

    known = [p.name for p in list(signature(function).parameters.values())[1:]]
    for option in given:
        if option not in known:
            raise GrueblerError(text.filled(kind=kind, **unknown(option, known)))


def _title(mechanism: Mechanism) -> str:
    from gruebler.pictures.structure.messages import title

    return title(mechanism, "en")


def _linkage_content(linkage: Linkage, options: dict[str, Any], kind: str, *, dark: bool = False) -> bytes:
    if kind == "svg":
        return str(_function("linkage.animation", "animated_svg")(linkage, **options)).encode("utf-8")
    if kind == "html":
        return str(_function("linkage.animation_page", "animated_page")(linkage, **options)).encode("utf-8")
    content: bytes = _function("linkage.animation_frames", "animated_frames")(linkage, kind, dark=dark, **options)
    return content


def _machine_content(shown: MovingPicture | FramePicture, lang: str, kind: str, *, dark: bool = False) -> bytes:
    from gruebler.pictures.canvas.moving_files import moving_bytes

    return moving_bytes(shown, kind, dark=dark, lang=lang)
