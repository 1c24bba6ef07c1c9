"""`gruebler plot`: what a linkage with one drive does, as curves over axes."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from gruebler.base.errors import GrueblerError
from gruebler.base.text import joined_by_or, translate
from gruebler.cli.draw import called, entry_of, linkage_and_range, picture_path, picture_suffix, write_picture
from gruebler.cli.drive_rows import given_speeds, turning_drives
from gruebler.cli.linkage_inputs import SpatialWord, loaded_linkage, spatial_of_word, with_points
from gruebler.cli.parser import Parser
from gruebler.mechanics.dynamics import InverseDynamics, inverse_dynamics
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages import Linkage
from gruebler.pictures.canvas import Figure
from gruebler.pictures.canvas.panels import ratio_diagram
from gruebler.pictures.linkage.curve_plots import coupler_plot, family_plot, hodograph
from gruebler.pictures.linkage.force_plots import effort_plot, force_plot
from gruebler.pictures.linkage.motion_plots import transfer_plot, transmission_plot
from gruebler.pictures.linkage.piecewise_curves import plot_run


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Diagrams of a linkage with one drive. transfer: the output and its derivatives of order 1 and 2, "
        "with dead centres, also in space. transmission: the transmission angle, "
        "with the range below 40 degrees. hodograph: the tips "
        "of velocity vectors. curves: paths of points. family: paths of points on a line of one link. ratio: Q_G and "
        "L/l1 of a straight-line linkage over its crank angle. Of a linkage with loads, at constant speed, torque: the "
        "effort of the drive and its power; forces: those of joints, as curves of the tips of their arrows.",
        epilog="Examples: gruebler plot four-bar:25,70,40,70 --kind transmission -o mu.svg; gruebler plot lambda "
        "--kind family --count 7; gruebler plot mzc --kind ratio --ratio 0.005; gruebler plot compressor --kind "
        "torque. Without -o the SVG goes to standard output. PNG and PDF need matplotlib: pip install "
        "'gruebler[plot]'.",
    )
    parser.take(
        """
        linkage
        --kind {transfer,transmission,hodograph,curves,family,ratio,torque,forces} =transfer  the kind of diagram
            (default: transfer)
        --output LINK  transfer, transmission: the link or sliding joint observed, in space a joint
        --point POINT ...  hodograph, curves, ratio: a named point, a joint, or LINK:X,Y (default: all named points,
            for ratio the first); forces: a joint (default: the pins on the frame); repeatable
        --speed N float  hodograph, torque, forces: drive speed in turns per minute, or in lengths per second
        --link LINK  family: the link that carries the points (default: a coupler)
        --from X,Y >start  family: the first point; write --from=-10,5
        --to X,Y >end  family: the last point (default: through two pins)
        --count K int =5  family: 2 to 8 points (default: 5)
        --centre DEG float =180  ratio: the middle of the windows (default: 180)
        --ratio Q float  ratio: mark the window with this Q_G
        --branch
        --dark  dark background for PNG and PDF; SVG follows the viewer
        """
    )
    parser.add_out(help="a file: .svg, .png or .pdf", endings=("svg", "png", "pdf"))


def run(arguments: argparse.Namespace) -> int:
    """Plot into a file, or as SVG on standard output."""
    arguments.out = picture_path(arguments.out, arguments.linkage, arguments.kind)
    suffix = picture_suffix(arguments.out, arguments.dark)
    _check(arguments)
    spatial = spatial_of_word(arguments.linkage, arguments.lang)
    if spatial is not None:
        figure = _in_space(arguments, spatial)
        write_picture(figure, arguments.out, suffix, arguments.dark, arguments.lang)
        return 0
    linkage, between = linkage_and_range(arguments.linkage, arguments.lang)
    linkage = with_points(linkage, arguments.point)
    name, names = called(entry_of(arguments.linkage, arguments.lang), arguments.lang)
    figure = _KINDS[arguments.kind](
        _Asked(linkage=linkage, between=between, name=name, names=names, arguments=arguments)
    )
    write_picture(figure, arguments.out, suffix, arguments.dark, arguments.lang)
    return 0


def _in_space(arguments: argparse.Namespace, spatial: SpatialWord) -> Figure:
    """The transfer functions of a linkage in space, which has no other diagram."""
    from gruebler.pictures.space import plot_spatial

    kind = arguments.kind
    for option, given in ((f"kind {kind}", kind != "transfer"), ("branch", arguments.branch)):
        if given:
            raise GrueblerError("--{option} does not go with a linkage in space", option=option)
    name, _ = called(entry_of(arguments.linkage, arguments.lang), arguments.lang)
    return plot_spatial(spatial.linkage, arguments.output, between=spatial.range, lang=arguments.lang, name=name)


_ONLY: Mapping[str, tuple[Any, tuple[str, ...]]] = {
    "output": (None, ("transfer", "transmission")),
    "point": ([], ("hodograph", "curves", "ratio", "forces")),
    "speed": (None, ("hodograph", "torque", "forces")),
    "link": (None, ("family",)),
    "start": (None, ("family",)),
    "end": (None, ("family",)),
    "count": (5, ("family",)),
    "centre": (180.0, ("ratio",)),
    "ratio": (None, ("ratio",)),
}
"""Options that only some kinds have, with the value that means they were not given."""
_WRITTEN = {"start": "from", "end": "to"}


def _check(arguments: argparse.Namespace) -> None:
    """An option that its kind does not have is an error, not ignored; numbers are finite."""
    for key, (none, kinds) in _ONLY.items():
        value, option = getattr(arguments, key), f"--{_WRITTEN.get(key, key)}"
        if value != none and arguments.kind not in kinds:
            raise GrueblerError(
                "{option} goes with --kind {kinds}, not with {kind}",
                option=option,
                kinds=joined_by_or(kinds),
                kind=arguments.kind,
            )
        if isinstance(value, float) and not math.isfinite(value):
            raise GrueblerError("{option}: expected a finite number, but found {value}", option=option, value=value)
    if arguments.kind == "ratio" and len(arguments.point) > 1:
        raise GrueblerError("--kind ratio shows one point, but found {point}", point=", ".join(arguments.point))


@dataclass(frozen=True, kw_only=True)
class _Asked:
    """The linkage and what is to be plotted of it."""

    linkage: Linkage
    between: tuple[float, float] | None
    name: str
    names: Mapping[str, str]
    arguments: argparse.Namespace

    @property
    def common(self) -> dict[str, Any]:
        """What all kinds are told."""
        given = self.arguments
        return {"branch": given.branch, "between": self.between, "lang": given.lang, "name": self.name}

    @property
    def points(self) -> list[str]:
        """Those asked for, else all named ones."""
        names = self.arguments.point or list(self.linkage.points)
        if not names:
            joints = ", ".join(self.linkage.mechanism.chain.joint_names())
            raise GrueblerError(
                "this linkage has no named points; name one of its joints with --point: {joints}", joints=joints
            )
        return names


def _transfer(asked: _Asked) -> Figure:
    return transfer_plot(asked.linkage, asked.arguments.output, names=asked.names, **asked.common)


def _transmission(asked: _Asked) -> Figure:
    return transmission_plot(asked.linkage, asked.arguments.output, names=asked.names, **asked.common)


def _hodograph(asked: _Asked) -> Figure:
    speed, drives = asked.arguments.speed, asked.linkage.mechanism.drives
    if speed is not None and drives and drives[0].turning:
        speed *= 2 * math.pi / 60
    return hodograph(asked.linkage, asked.points, speed=speed, **asked.common)


def _curves(asked: _Asked) -> Figure:
    return coupler_plot(asked.linkage, asked.points, **asked.common)


def _family(asked: _Asked) -> Figure:
    given = asked.arguments
    start, end = (_place(key, getattr(given, key)) for key in ("start", "end"))
    if (start is None) != (end is None):
        raise GrueblerError("--from and --to go together: the two ends of the line of points")
    return family_plot(asked.linkage, given.link, start=start, end=end, count=given.count, **asked.common)


def _place(key: str, text: str | None) -> complex | None:
    if text is None:
        return None
    try:
        u, v = (float(part) for part in text.split(","))
    except ValueError:
        raise GrueblerError(
            "--{option}: expected two numbers X,Y, but found {found!r}", option=_WRITTEN[key], found=text
        ) from None
    return complex(u, v)


def _torque(asked: _Asked) -> Figure:
    return effort_plot(_inverse_dynamics(asked), lang=asked.arguments.lang, name=asked.name)


def _forces(asked: _Asked) -> Figure:
    joints = asked.arguments.point or None
    return force_plot(_inverse_dynamics(asked), joints, lang=asked.arguments.lang, name=asked.name)


def _inverse_dynamics(asked: _Asked) -> InverseDynamics:
    """Forces at constant speed, from the loads of the file or of the entry."""
    given = asked.arguments
    linkage, loads, usual, _ = loaded_linkage(given.linkage, given.lang)
    speeds = given_speeds([] if given.speed is None else [given.speed], turning_drives(linkage))
    speed = speeds[0] if speeds else usual
    if speed is None:
        raise GrueblerError("--speed is missing: the forces of inertia grow with its square")
    course = plot_run(linkage, 0, given.branch, asked.between, given.lang, "")
    motion = move_quietly(linkage, course.drives[:, None], branch=given.branch, speed=[speed], order=2)
    return inverse_dynamics(motion, loads, times=(course.drives - course.drives[0]) / speed)


def _ratio(asked: _Asked) -> Figure:
    """Q_G and L/l1 of windows about a crank angle, against the tangent there."""
    from gruebler.mechanics.geometry.sizing import crank_length, tangent_windows
    from gruebler.mechanics.geometry.straight import linkage_path, piece_of_ratio
    from gruebler.pictures.structure.messages import title

    given, linkage, point = asked.arguments, asked.linkage, asked.points[0]
    crank, centre = crank_length(linkage), math.radians(given.centre)
    curve = tangent_windows(linkage, point, centre, branch=given.branch)
    marked = None
    if given.ratio is not None:
        piece = piece_of_ratio(linkage_path(linkage, point, branch=given.branch), centre, given.ratio)
        if piece is None:
            raise GrueblerError(
                "every window about {centre:g} degrees is straighter than Q_G = {ratio:g}",
                centre=given.centre,
                ratio=given.ratio,
            )
        marked = piece.end - piece.start, piece.ratio, piece.length / crank
    name = title(linkage.mechanism, given.lang, asked.name)
    return ratio_diagram(
        curve.widths,
        curve.ratios,
        curve.lengths / crank,
        at=marked,
        lang=given.lang,
        title=translate("{name}: relative deviation of {point}", given.lang, name=name, point=point),
    )


_KINDS: Mapping[str, Callable[[_Asked], Figure]] = {
    "transfer": _transfer,
    "transmission": _transmission,
    "hodograph": _hodograph,
    "curves": _curves,
    "family": _family,
    "ratio": _ratio,
    "torque": _torque,
    "forces": _forces,
}
