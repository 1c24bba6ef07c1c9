"""`gruebler plot`: what a linkage with one drive does, as curves over axes."""

from __future__ import annotations

import argparse
import cmath
import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from gruebler.cli.draw import entry_of, german, linkage_and_range, picture_suffix, told_picture
from gruebler.cli.parser import Parser
from gruebler.drawing.canvas import Figure
from gruebler.drawing.canvas.panels import ratio_diagram
from gruebler.drawing.linkage.curve_plots import coupler_plot, family_plot, hodograph
from gruebler.drawing.linkage.motion_plots import transfer_plot, transmission_plot
from gruebler.errors import GrueblerError
from gruebler.linkages import Linkage
from gruebler.text import joined_by_or

__all__ = ["add", "run"]

_LEAST, _MOST = 1e-6, 0.02  # Q_G that are shown
_STEP, _WINDOWS = math.radians(3.0), 120  # of the windows in which the range is sought; how many are shown then
_RATIO_TITLES = {"en": "{name}: relative deviation of {point}", "de": "{name}: bezogene Abweichung von {point}"}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Plots of a linkage with one drive. transfer: the output and its derivatives of order 1 and 2, "
        "with dead centres. transmission: the transmission angle, with the band below 40 degrees. hodograph: the tips "
        "of velocity vectors. curves: paths of points. family: paths of points on a line of one link. ratio: Q_G and "
        "L/l1 of a straight-line guidance over its crank angle.",
        epilog="Examples: gruebler plot four-bar:25,70,40,70 --kind transmission -o mu.svg; gruebler plot lambda "
        "--kind family --count 7; gruebler plot mzc --kind ratio --ratio 0.005. Without -o the SVG goes to standard "
        "output. PNG and PDF need matplotlib: pip install 'gruebler[plot]'.",
    )
    parser.add_argument(
        "linkage", metavar="FILE|ID|LENGTHS", help="a file, a catalog entry, or lengths such as four-bar:25,70,40,70"
    )
    parser.add_argument(
        "--kind",
        choices=("transfer", "transmission", "hodograph", "curves", "family", "ratio"),
        default="transfer",
        help="what is plotted (default: transfer)",
    )
    parser.add_argument("--output", metavar="LINK", help="transfer, transmission: the link or sliding joint looked at")
    parser.add_argument(
        "--point",
        action="append",
        default=[],
        metavar="K",
        help="hodograph, curves, ratio: a named point or joint (default: all named points, for ratio the first); "
        "repeatable",
    )
    parser.add_argument("--speed", type=float, metavar="N", help="hodograph: turns a minute; of a slide, lengths by s")
    parser.add_argument("--link", metavar="LINK", help="family: the link that carries the points (default: a coupler)")
    parser.add_argument("--from", dest="start", metavar="U,V", help="family: the first point, write --from=-10,5")
    parser.add_argument(
        "--to", dest="end", metavar="U,V", help="family: the last point (default: on a line of two pins)"
    )
    parser.add_argument("--count", type=int, default=5, metavar="K", help="family: points, 2 to 8 (default: 5)")
    parser.add_argument(
        "--centre", type=float, default=180.0, metavar="DEG", help="ratio: the middle of the windows (default: 180)"
    )
    parser.add_argument("--ratio", type=float, metavar="Q", help="ratio: mark the window with this Q_G")
    parser.add_argument("--branch", metavar="LABELS", help="the assembly mode, such as +- (write --branch=-+)")
    parser.add_argument("--dark", action="store_true", help="PNG and PDF on dark ground; an SVG is on the reader's")
    parser.add_argument("-o", dest="file", type=Path, metavar="FILE", help="a file .svg, .png or .pdf")


def run(arguments: argparse.Namespace) -> int:
    """Plot into a file, or as SVG on standard output."""
    suffix = picture_suffix(arguments.file, arguments.dark)
    _check(arguments)
    linkage, between = linkage_and_range(arguments.linkage)
    record = entry_of(arguments.linkage)
    name = "" if record is None else record.name.in_language(arguments.lang)
    figure = _KINDS[arguments.kind](_Asked(linkage, between, name, german(record, arguments.lang), arguments))
    told_picture(figure, arguments.file, suffix, arguments.dark, arguments.lang)
    return 0


_ONLY: Mapping[str, tuple[Any, tuple[str, ...]]] = {
    "output": (None, ("transfer", "transmission")),
    "point": ([], ("hodograph", "curves", "ratio")),
    "speed": (None, ("hodograph",)),
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
        raise GrueblerError("--kind ratio is of one point, but found {point}", point=", ".join(arguments.point))


@dataclass(frozen=True)
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
        found = self.arguments.point or list(self.linkage.points)
        if not found:
            joints = ", ".join(self.linkage.mechanism.chain.joint_names())
            raise GrueblerError(
                "this linkage has no named points; name one of its joints with --point: {joints}", joints=joints
            )
        return found


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
            "--{written}: expected two numbers U,V, but found {text_!r}", written=_WRITTEN[key], text_=text
        ) from None
    return complex(u, v)


def _ratio(asked: _Asked) -> Figure:
    """Q_G and L/l1 of windows about a crank angle, against the tangent there."""
    from gruebler.drawing.structure.messages import title
    from gruebler.geometry.straight import PathPiece, linkage_path, path_piece, piece_of_ratio
    from gruebler.kinematics import move

    given, linkage = asked.arguments, asked.linkage
    crank = _crank(linkage)
    point, middle = asked.points[0], math.radians(given.centre)
    motion = move(linkage, [middle], speed=1.0, branch=given.branch)
    if not len(motion):
        raise GrueblerError("{reason}", reason=motion.reason)
    path = linkage_path(linkage, point, given.branch)
    tangent = cmath.phase(complex(motion.complex_point(point, 1)[0]))

    def within(windows: Iterable[float]) -> list[PathPiece]:
        pieces = (path_piece(path, middle - w / 2, middle + w / 2, tangent, samples=361) for w in windows)
        return [p for p in pieces if _LEAST <= p.ratio <= _MOST]

    rough = [p.end - p.start for p in within(_STEP * np.arange(1, round(2 * math.pi / _STEP) + 1))]
    ends = (rough[0] - _STEP, min(rough[-1] + _STEP, 2 * math.pi)) if rough else (0.0, 0.0)
    shown = within(np.linspace(*ends, _WINDOWS)[1:]) if rough else []
    if len(shown) < 2:
        raise GrueblerError(
            "the path of {point} about {centre:g} degrees has no windows with Q_G from {least:g} to {most:g}",
            point=point,
            centre=given.centre,
            least=_LEAST,
            most=_MOST,
        )
    marked = None
    if given.ratio is not None:
        piece = piece_of_ratio(path, middle, given.ratio, tangent)
        if piece is None:
            raise GrueblerError(
                "every window about {centre:g} degrees is straighter than Q_G = {ratio:g}",
                centre=given.centre,
                ratio=given.ratio,
            )
        marked = piece.end - piece.start, piece.ratio, piece.length / crank
    name = title(linkage.mechanism, given.lang, asked.name)
    return ratio_diagram(
        [p.end - p.start for p in shown],
        [p.ratio for p in shown],
        [p.length / crank for p in shown],
        at=marked,
        lang=given.lang,
        title=_RATIO_TITLES[given.lang].format(name=name, point=point),
    )


def _crank(linkage: Linkage) -> float:
    """The length of the driven link: from the driven joint to the next turning joint on it."""
    drives = linkage.mechanism.drives
    if len(drives) == 1 and drives[0].turning:
        number, link = drives[0].joint, linkage.reference(0)[1]
        joints = linkage.mechanism.chain.joints
        others = [
            n for n, joint in enumerate(joints) if n != number and link in joint.links and joint.pair.name == "revolute"
        ]
        if others and (length := linkage.length(link, number, others[0])) > 0:
            return length
    raise GrueblerError("L/l1 needs a linkage with one drive, a crank with two turning joints")


_KINDS: Mapping[str, Callable[[_Asked], Figure]] = {
    "transfer": _transfer,
    "transmission": _transmission,
    "hodograph": _hodograph,
    "curves": _curves,
    "family": _family,
    "ratio": _ratio,
}
