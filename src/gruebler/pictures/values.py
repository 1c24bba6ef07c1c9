"""Pictures of everything that has one: `draw`, `animate` and `plot`, and how values show themselves in notebooks."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from gruebler.base.atomic_files import atomic_file
from gruebler.base.doors import door
from gruebler.base.errors import GrueblerError, nearest
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.files import picture_bytes, suffix_of

if TYPE_CHECKING:
    from gruebler.mechanics.linkages import Linkage
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

    def save(self, path: Path | str, *, dark: bool = False) -> Path:
        """Write it into a ``.svg``, ``.png`` or ``.pdf`` file, complete or not at all; returns the path.

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
    data = content(suffix)
    with atomic_file(Path(path), durable=False) as file:
        file.write(data)
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


def draw(value: Any, **options: Any) -> Picture:
    """A picture of a chain, mechanism, linkage, motion, cam, Geneva drive or gear train.

    Args:
        value: also a `FourBar`, `SliderCrank` or `InvertedSliderCrank`.
        options: those of the function that draws such a value: `gruebler.pictures.structure.draw_structure`
            (``labels``), `gruebler.pictures.linkage.picture.draw_linkage` (``drive``, ``curves``, ``show``, ...),
            `draw_cam`, ...

    Raises `GrueblerError` for a value without a picture and for unknown options.

    >>> import gruebler as gr
    >>> gr.draw(gr.FourBar(25, 70, 40, 70))
    <Picture 'four-bar linkage', 328 x 195>
    """
    value, kind = _drawn(value)
    return Picture(_called(_function(kind.module, kind.still), value, options))


@door
def animate(value: Any, *, seconds: float = 4.0, **options: Any) -> Animation:
    """A moving picture of a linkage, cam, Geneva drive or gear train, one turn of the drive in the given time.

    Args:
        value: also a `FourBar`, `SliderCrank` or `InvertedSliderCrank`.
        seconds: for a turn of the drive, or for there and back.
        options: of `gruebler.pictures.linkage.animation.scene`, `animate_cam`, `animate_geneva` or `animate_train`.

    Raises `GrueblerError` for a value that has no moving picture, `LinkageError` for a linkage that does not move.
    """
    value, kind = _drawn(value)
    if not kind.moving:
        raise GrueblerError(
            "values of type {kind} have no moving picture: animate a linkage, cam, Geneva drive or train",
            kind=type(value).__name__,
        )
    if kind.moving == "linkage":
        return Animation(_title(value.mechanism), partial(_linkage_content, value, {"seconds": seconds, **options}))
    lang = options.get("lang", "en")
    shown: MovingPicture = _called(_function(kind.module, kind.moving), value, {"seconds": seconds, **options})
    return Animation(shown.page.title, partial(_machine_content, shown, lang))


@door
def plot(linkage: object, kind: str = "transfer", **options: Any) -> Picture:
    """A diagram of a linkage with one drive.

    Args:
        linkage: also a `FourBar`, `SliderCrank` or `InvertedSliderCrank`.
        kind: ``transfer`` (the output and its derivatives), ``transmission`` (transmission angle), ``hodograph``,
            ``curves`` (paths of points) or ``family`` (paths of points on a line of one link).
        options: of `transfer_plot`, `transmission_plot`, `hodograph`, `coupler_plot`, `family_plot`.

    >>> import gruebler as gr
    >>> gr.plot(gr.FourBar(25, 70, 40, 70), "transmission")
    <Picture 'four-bar linkage: transmission angle of rocker', 705 x 410>
    """
    from gruebler.mechanics.linkages.conversion import as_linkage

    if kind not in _PLOTS:
        raise GrueblerError(
            "there is no plot {kind!r}{suggestion}; there are {known}",
            kind=kind,
            suggestion=nearest(str(kind), _PLOTS),
            known=", ".join(_PLOTS),
        )
    return Picture(_called(_function(*_PLOTS[kind]), as_linkage(linkage), options))


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
    from gruebler.mechanics.linkages.conversion import makes_linkage

    if type(value).__name__ not in _KINDS and makes_linkage(value):
        value = value.linkage()
    kind = _KINDS.get(type(value).__name__)
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


def _called(function: Callable[..., Any], value: object, options: Mapping[str, Any]) -> Any:
    """The function's answer; unknown options are refused with those that there are."""
    from inspect import signature

    known = [p.name for p in list(signature(function).parameters.values())[1:]]
    for option in options:
        if option not in known and "options" not in known:
            raise GrueblerError(
                "{function} has no option {option!r}{suggestion}; it has {known}",
                function=function.__name__,
                option=option,
                suggestion=nearest(option, known),
                known=", ".join(known),
            )
    return function(value, **options)


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


def _machine_content(shown: MovingPicture, lang: str, kind: str, *, dark: bool = False) -> bytes:
    from gruebler.pictures.canvas.moving_files import moving_bytes

    return moving_bytes(shown, kind, dark=dark, lang=lang)
