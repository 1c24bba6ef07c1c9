"""All derived properties of a machine: mobility, freedoms, features, drives, measures, paths of its points."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from math import degrees, pi
from typing import TYPE_CHECKING, Any

import numpy as np

from gruebler.base.arrays import compared_by_value
from gruebler.base.errors import LinkageError
from gruebler.base.notebook import brief
from gruebler.base.plain_data import plain
from gruebler.base.text import LANGUAGES, message
from gruebler.files.catalog_records import Entry, source_text
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.mechanism import DriveReport, Mechanism, check_drives
from gruebler.structure.mobility import MobilityReport, mobility_report
from gruebler.teaching.catalog.feature_query import entry_features, entry_mechanism, features_to_json
from gruebler.teaching.catalog.features import AccessFeatures, guided_links

if TYPE_CHECKING:
    from gruebler.mechanics.analysis.measuring import Measures
    from gruebler.mechanics.geometry import CouplerCurve
    from gruebler.mechanics.screws import Freedoms, SpatialLinkage

_ROWS = 361
_ROUNDING = 1e-9
# A partial derivative far below one length of the machine, or one radian, for each of the same is rounding: an output
# at rest computes to some 1e-15, the slowest gear of a machine that anybody draws is a thousandth.


@dataclass(frozen=True, slots=True)
class Partial:
    """The partial transfer function of an output for one of several drives, in the drawn position."""

    output: str
    drive: str
    at: float
    """The drive's value there, in radians or the unit."""
    value: float


@dataclass(frozen=True, slots=True, kw_only=True)
class GuidedPoint:
    """The path of a named point over the whole motion of the drive, in the unit of the machine."""

    name: str
    link: str
    closed: bool
    length: float
    width: float
    """Its extent along x."""
    height: float
    """Its extent along y."""


@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class MachineReport:
    """The result of `machine_report`. `explain` returns it as text."""

    entry: Entry
    mechanism: Mechanism
    mobility: MobilityReport
    freedoms: Freedoms | None
    """The freedoms at the dimensions; None without dimensions."""
    features: AccessFeatures
    drives: DriveReport | None
    """Whether the drives fix the motion; None for a machine without drives."""
    measures: Measures | None
    """Those of a planar linkage with one drive."""
    partials: tuple[Partial, ...]
    """Those of a planar linkage with several drives."""
    points: tuple[GuidedPoint, ...]
    shown_mu: tuple[float, float] | None
    """The smallest and largest transmission angle in the range that the entry states, on a grid."""

    @property
    def moves(self) -> int:
        """The mobility at the dimensions if there are any, else as claimed, else at almost all dimensions."""
        if self.freedoms is not None:
            return self.freedoms.mobility
        claimed = self.entry.claims.mobility
        return self.mobility.generic if claimed is None else claimed

    @property
    def guiding_and_guided(self) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """The moving links that guide and the outputs that they guide; both empty if the machine transmits a motion."""
        chain, guided = self.mechanism.chain, guided_links(self.mechanism, self.entry.outputs)
        beside = {link for j in chain.joints if {*j.links} & {*guided} for link in j.links}
        return tuple(link for link in chain.links if link in beside and link not in guided), guided

    def explain(self, lang: str = "en") -> str:
        """The report as a text with titled sections, in English (``en``) or German (``de``)."""
        sections = ((_TITLES[key].in_language(lang), list(lines)) for key, lines in _sections(self, lang))
        return "\n\n".join("\n".join([f"{title}:", *(f"  {line}" for line in lines)]) for title, lines in sections)

    def to_json(self) -> dict[str, Any]:
        """Plain data for `json.dumps`."""
        sizes = self.entry.dimensions or self.entry.screws
        return {
            "id": self.entry.id,
            "name": {lang: self.entry.name.in_language(lang) for lang in LANGUAGES},
            **plain(self, "mechanism freedoms measures partials points"),
            "mobility": self.mobility.to_json() | {"formula": self.mobility.count.formula(), "moves": self.moves},
            "features": features_to_json(self.features),
            "drives_fix_the_motion": None if self.drives is None else self.drives.fixed,
            "dimensions": None
            if sizes is None
            else {"assumed": sizes.assumed, "source": source_text(sizes.source, LANGUAGES[0])},
            "transmission_angle_shown": None if self.shown_mu is None else [degrees(mu) for mu in self.shown_mu],
        }


def machine_report(entry: Entry) -> MachineReport:
    """The report of an entry.

    Cost: mobility in milliseconds; measures and paths some tenths of a second.

    >>> from gruebler.teaching.catalog import entry
    >>> report = machine_report(entry("lambda"))
    >>> report.moves, report.points[0].name, round(report.points[0].height, 6)
    (1, 'C', 17.97959)
    """
    mechanism, placed = entry_mechanism(entry), entry.placed()
    linkage = None if entry.dimensions is None else entry.linkage()
    single, several = (linkage, None) if len(mechanism.drives) == 1 else (None, linkage if mechanism.drives else None)
    measures, points = (None, ()) if single is None else _moving(single)
    return MachineReport(
        entry=entry,
        mechanism=mechanism,
        mobility=mobility_report(mechanism.chain, frame=mechanism.frame),
        freedoms=None if placed is None else _freedoms(placed),
        features=entry_features(entry),
        drives=check_drives(mechanism) if mechanism.drives else None,
        measures=measures,
        partials=() if several is None else _partials(several),
        points=points,
        shown_mu=_shown_transmission(entry, measures),
    )


def _freedoms(placed: Linkage | SpatialLinkage) -> Freedoms:
    from gruebler.mechanics.screws import freedoms

    return freedoms(placed)


def _moving(linkage: Linkage) -> tuple[Measures | None, tuple[GuidedPoint, ...]]:
    """Measures and paths; None where the drive does not move the linkage."""
    from gruebler.mechanics.analysis.measuring import measures
    from gruebler.mechanics.geometry import coupler_curve

    try:
        result = measures(linkage)
    except LinkageError:
        return None, ()
    points = []
    for name, place in linkage.points.items():
        curve = coupler_curve(linkage, name)
        points.append(
            GuidedPoint(
                name=name,
                link=place.link,
                closed=curve.closed,
                length=curve.length,
                width=_extent(curve, 0.0),
                height=_extent(curve, pi / 2),
            )
        )
    return result, tuple(points)


def _partials(linkage: Linkage) -> tuple[Partial, ...]:
    """Transfer functions of order 1 by each drive, in the reference pose."""
    from gruebler.mechanics.analysis.outputs import find_output
    from gruebler.mechanics.kinematics.reference_pose import pose_at_reference
    from gruebler.mechanics.kinematics.solve import cached_plan, move_quietly

    names, plan = linkage.mechanism.drive_names(), cached_plan(linkage)
    if plan.lower.reference_pose is None:
        return ()
    reference = pose_at_reference(plan, np.zeros(len(names))).drives
    output = find_output(linkage)
    far = 1.0 if output.turning else linkage.size
    each = [1.0 if drive.turning else linkage.size for drive in linkage.mechanism.drives]
    values = [
        output.values(move_quietly(linkage, [reference], speed=[unit], order=1), 1)[0] for unit in np.eye(len(names))
    ]
    rest = [abs(value) * drive <= _ROUNDING * far for value, drive in zip(values, each, strict=True)]
    rates = [0.0 if still else float(value) for value, still in zip(values, rest, strict=True)]
    return tuple(Partial(output.name, *row) for row in zip(names, reference.tolist(), rates, strict=True))


def _shown_transmission(entry: Entry, measured: Measures | None) -> tuple[float, float] | None:
    """The extremes over the stated range; the full motion often begins and ends where the angle is 0."""
    if measured is None or measured.transmission is None or entry.dimensions is None or entry.dimensions.range is None:
        return None
    from gruebler.mechanics.analysis.transmission import transmission_angle
    from gruebler.mechanics.kinematics.solve import move_quietly

    rows = np.linspace(*entry.dimensions.range, _ROWS)
    motion = move_quietly(measured.linkage, np.radians(rows) if measured.turning_drive else rows, speed=1.0)
    angles = transmission_angle(motion, measured.output.name)
    return float(angles.min()), float(angles.max())


def _extent(curve: CouplerCurve, direction: float) -> float:
    """The extent of a path along a direction: between two of its turning points in that direction, or its ends."""
    along = np.exp(-1j * direction)
    ends = [] if curve.closed else [complex(curve.points[0]), complex(curve.points[-1])]
    positions = [(along * complex(z)).real for z in [*ends, *(turn.at for turn in curve.turning_points(direction))]]
    return float(max(positions) - min(positions)) if positions else 0.0


# --- in words --------------------------------------------------------------------------------------

_TITLES = {
    "mobility": message("Mobility"),
    "moves": message("What really moves"),
    "features": message("Access features"),
    "drive": message("Drive"),
    "dimensions": message("Dimensions"),
    "measures": message("Transfer function"),
    "guided": message("Motion of the guided link"),
    "points": message("Guided points"),
}
_TEXTS = {
    "claimed": message("{mobility}, as claimed. {reason}"),
    "generic": message("{mobility}, for almost all sizes."),
    "hand": message("Not driven at a joint."),
    "special": message(
        "The motion that special dimensions allow is described above; almost all other dimensions "
        "would give another mobility than {moves}."
    ),
    "assumed": message("Assumed; none are printed."),
    "source": message("From {source}."),
    "screws": message("The joints in one position; enough for the mobility."),
    "unit": message("Unit of length: {unit}."),
    "range": message("Shown between {low:g}{unit} and {high:g}{unit}."),
    "shown": message("In the range shown the transmission angle is {small:.4g}° to {large:.4g}°."),
    "partial": message("As drawn, {output} moves by {ratio:.6g} for each unit of {drive} (angles in radians)."),
    "guides": message("Guide mechanism. Guided link: {guided}; guiding links: {guides}."),
    "rest": message("As drawn, {output} rests while {drive} moves."),
    "closed": message("{name} on {link}: a closed path {length:.6g} {unit} long, {width:.6g} wide, {height:.6g} high."),
    "open": message(
        "{name} on {link}: a path {length:.6g} {unit} long between the limits, {width:.6g} wide, {height:.6g} high."
    ),
}


def _sections(report: MachineReport, lang: str) -> Iterator[tuple[str, list[str]]]:
    def say(key: str, **values: Any) -> str:
        return _TEXTS[key].filled(**values).in_language(lang).rstrip()

    yield "mobility", report.mobility.explain(lang).splitlines()
    yield "moves", _moves_lines(report, say, lang)
    yield "features", [f"{label}: {value}" for label, value in report.features.described(lang)]
    alphabet = Alphabet.of_language(lang)
    if report.drives is None:
        yield "drive", [say("hand")]
    else:
        names = ", ".join(report.mechanism.drive_names(alphabet))
        usual = report.moves == report.mobility.generic
        yield "drive", [names, report.drives.explain(lang) if usual else say("special", moves=report.moves)]
    if lines := _dimension_lines(report.entry, say, lang):
        yield "dimensions", lines
    guides, guided = report.guiding_and_guided
    title = "guided" if guided else "measures"
    if report.measures is not None:
        lines = report.measures.explain(lang).splitlines()
        if guided:
            lines.insert(0, say("guides", guides=", ".join(guides), guided=", ".join(guided)))
        if report.shown_mu is not None:
            small, large = (degrees(mu) for mu in report.shown_mu)
            lines.append(say("shown", small=small, large=large))
        yield title, lines
    elif report.partials:
        partials = zip(report.partials, report.mechanism.drive_names(alphabet), strict=True)
        yield (
            title,
            [
                say("partial" if partial.value else "rest", output=partial.output, ratio=partial.value, drive=name)
                for partial, name in partials
            ],
        )
    if report.measures is not None and report.points:
        unit = report.measures.linkage.unit
        yield "points", [say("closed" if p.closed else "open", unit=unit, **asdict(p)) for p in report.points]


def _moves_lines(report: MachineReport, say: Any, lang: str) -> list[str]:
    claims = report.entry.claims
    if report.freedoms is not None:
        formula = report.mobility.count.formula()
        return [line for line in report.freedoms.explain(lang).splitlines() if not line.endswith(formula)]
    if claims.mobility is None:
        return [say("generic", mobility=report.moves)]
    return [say("claimed", mobility=claims.mobility, reason=claims.reason or "")]


def _dimension_lines(entry: Entry, say: Any, lang: str) -> list[str]:
    sizes = entry.dimensions or entry.screws
    if sizes is None:
        return []
    lines = [
        say("source", source=source_text(sizes.source, lang)) if sizes.source else say("assumed"),
        say("unit", unit=sizes.unit),
    ]
    if entry.dimensions is None:
        return [*lines, say("screws")]
    if entry.dimensions.range is not None:
        low, high = entry.dimensions.range
        turning = entry_mechanism(entry).drives[0].turning
        lines.append(say("range", low=low, high=high, unit="°" if turning else f" {sizes.unit}"))
    return lines
