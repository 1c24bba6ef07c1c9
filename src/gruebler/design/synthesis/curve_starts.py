"""Where the fitting of curves begins: coupler curves of an atlas that are like a target, placed on it.

The atlas holds curves of linkages whose crank turns fully. docs/theory/synthesis-curves.md.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.design.synthesis.curve_matching import (
    PLACES,
    CurveMatch,
    best_matches,
    drive_angles,
    evenly_along,
)
from gruebler.design.synthesis.fit_limits import FourBarLimits, crank_turns
from gruebler.design.synthesis.four_bar_curves import curve_points
from gruebler.design.synthesis.four_bar_kinds import FourBarKind
from gruebler.design.synthesis.pivot_starts import given_pivots_starts

_CANDIDATES = 1500  # neighbours that are placed to see which of them keep within limits


@dataclass(frozen=True, slots=True, kw_only=True)
class CurveAtlas:
    """Coupler curves of linkages whose crank turns fully: crank 1, its pivot at the origin."""

    kind: FourBarKind
    rows: Reals
    """(unknowns, linkages)"""
    side: Reals
    phi: Reals
    """(linkages, places) crank angles of places evenly along the curve."""
    z: Complexes
    """(linkages, places)"""


def _halton(count: int, base: int) -> Reals:
    """Van der Corput's numbers: spread evenly, the same everywhere."""
    n = np.arange(1, count + 1)
    values, part = np.zeros(count), 1.0
    while n.any():
        part /= base
        values += part * (n % base)
        n = n // base
    return values


@cache
def atlas(kind: FourBarKind, count: int = 0) -> CurveAtlas:
    """The atlas, made at its first use from so many trials, else as many as its kind wants. Cost: 1 s."""
    *three, fourth, fifth = (_halton(count or kind.trials, base) for base in (2, 3, 5, 7, 11))
    rows = kind.scattered(three)
    reach = np.maximum(rows[kind.unknowns.index("b")], 1.0)
    w = reach * (0.5 + 2.0 * np.sqrt(fourth) * np.exp(2j * np.pi * fifth))
    rows[kind.unknowns.index("u")], rows[kind.unknowns.index("v")] = w.real, w.imag
    rows = rows[:, crank_turns(kind, rows)]
    side = np.where(np.arange(rows.shape[1]) % 2, 1.0, -1.0)
    phi = np.linspace(0, 2 * np.pi, 2 * PLACES + 1)
    z = curve_points(kind, rows[:, :, None], phi[None, :], side[:, None]).z
    good = np.isfinite(z).all(axis=1)
    rows, side, z = rows[:, good], side[good], z[good]
    at = evenly_along(z, phi)
    return CurveAtlas(
        kind=kind, rows=rows, side=side, phi=at, z=curve_points(kind, rows[:, :, None], at, side[:, None]).z
    )


class CurveStart(NamedTuple):
    """A neighbour of the target, placed on it."""

    gap: float
    """What the best similarity leaves, relative to the target's spread."""
    row: Reals
    side: float
    phi: Reals
    """(points,) crank angles of the target's points, in the plane."""


def neighbours(
    z: Complexes, limits: FourBarLimits, *, closed: bool, number: int, passed: Callable[[], object] | None = None
) -> list[CurveStart]:
    """The nearest curves of the atlas, or pieces of them, up to a similarity that leaves a given pivot where it is.

    With both pivots given, four-bars on them of which crank and coupler point are gone through. Of those that pass
    limits the ones come first that are both alike and hardly beyond.
    """
    own, far = limits.pivots
    both = own is not None and far is not None
    narrow = limits.narrow or (both and limits.turning)  # those of the atlas turn fully
    most = _CANDIDATES if narrow else number
    if own is not None and far is not None:
        most = min(most, 4 * number)  # of which those that keep to limits come first
        miss, rows, side, phi = given_pivots_starts(z, own, far, most, closed=closed)
        starts = [
            CurveStart(float(m) ** 2, row, float(s), at) for m, row, s, at in zip(miss, rows.T, side, phi, strict=True)
        ]
    else:
        starts = _similar(z, limits, most, closed=closed, passed=passed)
    if not narrow:
        return starts
    rows, phi = np.array([start.row for start in starts]).T, np.array([start.phi for start in starts])
    order = np.argsort(np.sqrt([start.gap for start in starts]) + limits.passed(rows, phi), kind="stable")
    return [starts[k] for k in order[:number]]


def _similar(
    z: Complexes, limits: FourBarLimits, number: int, *, closed: bool, passed: Callable[[], object] | None
) -> list[CurveStart]:
    """From the atlas; a given pivot is the origin."""
    kind, (own, far) = limits.kind, limits.pivots
    book = atlas(kind)
    frame = kind.frame(kind.named(book.rows))
    origin = np.zeros(len(frame)) if far is None else frame
    shift = own if own is not None else far if far is not None else 0j
    matches = best_matches(
        np.asarray(book.z - origin[:, None], np.complex128),
        z - shift,
        number,
        closed=closed,
        about_origin=own is not None or far is not None,
        passed=passed,
    )[:_CANDIDATES]
    placed = (replace(each, shift=each.shift - each.turn * float(origin[each.number])) for each in matches)
    return [_moved(kind, _placed(book, each), 1 + 0j, shift) for each in placed]


def _placed(book: CurveAtlas, match: CurveMatch) -> CurveStart:
    """A curve of the atlas turned, scaled and shifted onto the target."""
    n = match.number
    start = CurveStart(match.gap, book.rows[:, n], float(book.side[n]), drive_angles(book.phi[n], match.at))
    start = _moved(book.kind, start, match.turn, match.shift)
    if match.mirrored:
        row, side = mirror_image(book.kind, start.row, start.side)
        return CurveStart(match.gap, row, side, -start.phi)
    return start


def _moved(kind: FourBarKind, start: CurveStart, turn: complex, shift: complex) -> CurveStart:
    return start._replace(row=transformed(kind, start.row, turn, shift), phi=start.phi + float(np.angle(turn)))


def transformed(kind: FourBarKind, rows: Reals, turn: Complexes | complex, shift: Complexes | complex) -> Reals:
    """The numbers of linkages that are turned, scaled and shifted, each by its own similarity or all by one."""
    r = kind.named(rows)
    own = turn * (r["a0x"] + 1j * r["a0y"]) + shift
    r |= {"a0x": own.real, "a0y": own.imag, **kind.moved_guide(r, turn, shift)}
    for name in ("a", "b", "c", "u", "v"):
        if name in r:
            r[name] = r[name] * np.abs(turn)
    return np.array([r[name] for name in kind.unknowns])


def mirror_image(kind: FourBarKind, row: Reals, side: float) -> tuple[Reals, float]:
    """The numbers and the branch of the mirror image in the x axis, whose crank turns to the other side."""
    r = kind.named(row)
    for name in ("a0y", "b0y", "v", "h", "angle"):
        if name in r:
            r[name] = -r[name]
    return np.array([r[name] for name in kind.unknowns]), kind.mirrored_side * side


def timed_neighbours(kind: FourBarKind, z: Complexes, timing: Reals, number: int) -> list[CurveStart]:
    """Curves of the atlas whose points at these crank angles are similar to the target."""
    book = atlas(kind, 12000)
    starts = []
    target = z - z.mean()
    energy = float(np.sum(np.abs(target) ** 2))
    for mirrored in (False, True):
        wanted, turned = (np.conj(target), -(timing - timing[0])) if mirrored else (target, timing - timing[0])
        for begin in 2 * np.pi * np.arange(24) / 24:
            angles = begin + turned
            w = curve_points(kind, book.rows[:, :, None], angles[None, :], book.side[:, None]).z
            mean = w.mean(axis=1)
            inner = np.conj(w - mean[:, None]) @ wanted
            spread = np.sum(np.abs(w - mean[:, None]) ** 2, axis=1)
            likeness = np.abs(inner) ** 2 / (spread * energy)
            for n in np.argsort(-likeness)[: max(3, number // 8)]:
                turn = complex(inner[n] / spread[n])
                middle = np.conj(z.mean()) if mirrored else z.mean()
                row = transformed(kind, book.rows[:, n], turn, complex(middle - turn * mean[n]))
                phi, side = angles + float(np.angle(turn)), float(book.side[n])
                if mirrored:
                    row, side = mirror_image(kind, row, side)
                    phi = -phi
                starts.append(CurveStart(1 - float(likeness[n]), row, side, phi))
    starts.sort(key=lambda start: start.gap)
    return starts[:number]
