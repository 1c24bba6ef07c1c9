"""Straight-line linkages named after their finders, with their proportions; what they are worth is computed.

One row of `GUIDANCES` each: proportions as a drawing of one position or the usual lengths, the window of the drive in
which it is used, the line. Exact or approximate, length, band and order of contact are answers.
"""

from __future__ import annotations

from cmath import phase
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import atan2, degrees, pi, radians, sqrt

from gruebler.base.errors import LinkageError, unknown
from gruebler.base.text import Message, message
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.geometry.lever_contact import LeverContact, lever_contact, lever_pose
from gruebler.mechanics.geometry.meyer_zur_capellen import symmetric_rocker
from gruebler.mechanics.geometry.sizing import RatioCurve, Sizing, Window, ratio_curve, scale_for
from gruebler.mechanics.geometry.straight import Path, PathPiece, linkage_path, path_piece
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism

_EXACT = 1e-12  # deviation by length over the whole window
_POINT = "K"


@dataclass(frozen=True, kw_only=True)
class Guidance:
    """A linkage with a point K that runs straight, the smallest length being its unit."""

    key: str
    name: Message
    proportions: Message
    build: Callable[[], Linkage]
    degrees: tuple[float, float, float]
    """Drive values: beginning, position of reference, end."""
    direction: float
    """Of the line, in radians."""

    @cached_property
    def linkage(self) -> Linkage:
        """The linkage with the point K."""
        return self.build()

    @property
    def path(self) -> Path:
        """The path of K over the drive's values."""
        return linkage_path(self.linkage, _POINT)

    @property
    def window(self) -> Window:
        """The drive values in which it is used, and the line."""
        start, centre, end = (radians(angle) for angle in self.degrees)
        return Window(start, centre, end, self.direction)

    @cached_property
    def piece(self) -> PathPiece:
        """Length and band over the whole window."""
        return path_piece(self.path, self.window.start, self.window.end, self.direction)

    @property
    def is_exact(self) -> bool:
        """Whether K stays on the line over the whole window, but for roundings."""
        return self.piece.ratio < _EXACT

    @cached_property
    def contact(self) -> LeverContact | None:
        """How the path touches the line in the position of reference; None if it is the line, or no four-bar's path."""
        if self.is_exact:
            return None
        size, u, v, phi, branch = lever_pose(self.linkage, _POINT, self.window.centre)
        return lever_contact(size, u, v, phi, branch=branch)

    def curve(self) -> RatioCurve:
        """Q_G and the length over the windows up to the whole."""
        return ratio_curve(self.path, self.window)

    def sized(self, length: float, tolerance: float) -> Sizing:
        """The factor that makes K straight over a length within a tolerance, both in one unit.

        >>> round(guidance("lambda").sized(120, 0.6).factor, 6)
        30.0
        """
        return scale_for(self.path, self.window, length, tolerance)


def guidance(key: str) -> Guidance:
    """The straight-line linkage of this key.

    Raises `LinkageError` for another word, with the nearest key.

    >>> watt = guidance("watt")
    >>> watt.is_exact, watt.contact.points
    (False, 5)
    """
    for row in GUIDANCES:
        if row.key == key:
            return row
    keys = [row.key for row in GUIDANCES]
    raise LinkageError(
        "there is no straight-line linkage {word!r}{suggestion}; known are {known}", **unknown(key, keys)
    )


# --- the table --------------------------------------------------------------------------------------

_FOUR_BAR = "R(frame-crank) R(crank-coupler) R(coupler-rocker) R(frame-rocker); drive="


def _four_bar(*pins: complex, drive: str = "R(frame-crank)") -> Callable[[], Linkage]:
    """A four-bar drawn in one position: A0, A, B, B0, K; driven at A where its crank would get into a dead centre."""

    def build() -> Linkage:
        mechanism = Mechanism.parse(_FOUR_BAR + drive)
        names = mechanism.chain.joint_names()
        places: dict[str | int, object] = {n: (z.real, z.imag) for n, z in zip(names, pins, strict=False)}
        return Linkage.from_drawing(
            mechanism, places, points={_POINT: ("coupler", pins[4].real, pins[4].imag)}, unit="LE"
        )

    return build


def _sized(size: FourBar | SliderCrank | InvertedSliderCrank, u: float, v: float = 0.0) -> Callable[[], Linkage]:
    return lambda: size.linkage({_POINT: (u, v)}, unit="LE")


def _peaucellier() -> Linkage:
    """Inversor: arms 3 from the fixed pivot to a rhombus of sides 1.5, whose near corner a crank guides on a circle."""
    mechanism = Mechanism.parse(
        "R(frame-crank) R(frame-arm1-arm2) R(crank-bar1-bar2) R(arm1-bar1-bar3) R(arm2-bar2-bar4) R(bar3-bar4); "
        "drive=R(frame-crank)"
    )
    half = 1.2  # of the rhombus, across; the corners of a 3-4-5 triangle: 1.5, 0.9, 1.2
    middle = sqrt(9 - half**2)
    near, far = middle - 0.9, middle + 0.9
    places: dict[str | int, object] = {
        "R(frame-crank)": (near / 2, 0),
        "R(frame-arm1-arm2)": (0, 0),
        "R(crank-bar1-bar2)": (near, 0),
        "R(arm1-bar1-bar3)": (middle, half),
        "R(arm2-bar2-bar4)": (middle, -half),
        "R(bar3-bar4)": (far, 0),
    }
    return Linkage.from_drawing(mechanism, places, points={_POINT: ("bar4", far, 0)}, unit="LE")


def _hart() -> Linkage:
    """Inversor: a crossed parallelogram of sides 4 and 2; points half-way on three sides lie on one line."""
    mechanism = Mechanism.parse(
        "R(frame-crank) R(frame-long1) R(crank-short1) R(long1-short1) R(long1-short2) R(short2-long2) "
        "R(long2-short1); drive=R(frame-crank)"
    )
    p, q = 2.5, 1.2  # halves of the diagonals, 4pq = 4^2 - 2^2
    h = sqrt(4 - (p - q) ** 2)
    corner = {"a": (-p, 0), "b": (q, h), "c": (p, 0), "d": (-q, h)}
    places: dict[str | int, object] = {
        "R(frame-crank)": ((q - p) / 2 - q / 2, h / 2),
        "R(frame-long1)": ((q - p) / 2, h / 2),
        "R(crank-short1)": (-(p + q) / 2, h / 2),
        "R(long1-short1)": corner["a"],
        "R(long1-short2)": corner["b"],
        "R(short2-long2)": corner["c"],
        "R(long2-short1)": corner["d"],
    }
    return Linkage.from_drawing(mechanism, places, points={_POINT: ("short2", (p + q) / 2, h / 2)}, unit="LE")


_LEG = 1.2
_ROBERTS = complex(0.5, sqrt(_LEG**2 - 0.25))
_ROCKER = symmetric_rocker(5 / 6)
_ROCKER_PINS = [(z - _ROCKER.pins[0]) / -_ROCKER.lever.k for z in (*_ROCKER.pins, _ROCKER.point)]
_CAPELLEN = _ROCKER.replacement()
_INFLECTION, _ITS_TANGENT = 80.55616065499164, 2.2732018534280565  # of the conchoid: degrees of the crank, radians

GUIDANCES: tuple[Guidance, ...] = (
    Guidance(
        key="watt",
        name=message("Watt"),
        proportions=message("rockers 2, coupler 1; middle of the coupler"),
        build=_four_bar(-2 + 0.5j, 0.5j, -0.5j, 2 - 0.5j, 0j),
        degrees=(-20, 0, 20),
        direction=pi / 2,
    ),
    Guidance(
        key="evans",
        name=message("Evans"),
        proportions=message(
            "crank = coupler = its extension = 1, long rocker 3 upright with crank and coupler stretched"
        ),
        build=_four_bar(0j, 1 + 0j, 2 + 0j, 2 - 3j, 0j),
        degrees=(-35, 0, 35),
        direction=pi / 2,
    ),
    Guidance(
        key="chebyshev",
        name=message("Chebyshev"),
        proportions=message("frame 4, crossed rockers 5, coupler 2; its middle"),
        build=_four_bar(0j, 3 + 4j, 1 + 4j, 4 + 0j, 2 + 4j, drive="R(crank-coupler)"),
        degrees=(-90 - degrees(atan2(3, 4)), -degrees(atan2(4, 3)), 0),
        direction=0.0,
    ),
    Guidance(
        key="roberts",
        name=message("Roberts"),
        proportions=message("frame 2, coupler 1, rockers and legs of the coupler triangle 1.2"),
        build=_four_bar(0j, _ROBERTS, _ROBERTS + 1, 2 + 0j, 1 + 0j, drive="R(crank-coupler)"),
        degrees=(65.4, 180 - degrees(phase(_ROBERTS)), 178),
        direction=0.0,
    ),
    Guidance(
        key="lambda",
        name=message("Chebyshev's lambda, Hoecken"),
        proportions=message("crank 1, coupler = rocker = extension = 2.5, frame 2"),
        build=_sized(FourBar(1, 2.5, 2.5, 2), 5),
        degrees=(90, 180, 270),
        direction=0.0,
    ),
    Guidance(
        key="scott-russell",
        name=message("Scott Russell"),
        proportions=message("crank = rod = its extension = 1, central slider"),
        build=_sized(SliderCrank(1, 1), -1),
        degrees=(-60, 0, 60),
        direction=pi / 2,
    ),
    Guidance(
        key="conchoid",
        name=message("conchoid linkage"),
        proportions=message("crank 3, frame 5, AK = 9; about an inflection"),
        build=_sized(InvertedSliderCrank(3, 5), 9),
        degrees=(60, _INFLECTION, 120),
        direction=_ITS_TANGENT,
    ),
    Guidance(
        key="peaucellier",
        name=message("Peaucellier, Lipkin"),
        proportions=message("arms 3, rhombus 1.5, crank = half of the distance of pivot and near corner"),
        build=_peaucellier,
        degrees=(-60, 0, 60),
        direction=pi / 2,
    ),
    Guidance(
        key="hart",
        name=message("Hart"),
        proportions=message("crossed parallelogram 4 : 2, points half-way, crank 0.6"),
        build=_hart,
        degrees=(120, 180, 240),
        direction=pi / 2,
    ),
    Guidance(
        key="meyer-zur-capellen",
        name=message("Meyer zur Capellen"),
        proportions=message("symmetric double rocker, λ = 5/6, AK = 1"),
        build=_four_bar(*_ROCKER_PINS, drive="R(crank-coupler)"),
        degrees=(0, degrees(_ROCKER.phi0), 120),
        direction=0.0,
    ),
    Guidance(
        key="isosceles",
        name=message("Meyer zur Capellen, crank-rocker"),
        proportions=message("1 : 5/2 sqrt 3 : 5/2 sqrt 3 : 4, AK = 25/3"),
        build=_sized(_CAPELLEN.size, _CAPELLEN.u, _CAPELLEN.v),
        degrees=(90, 180, 270),
        direction=_CAPELLEN.kappa,
    ),
)
