"""Parts in the order in which they are painted: what is nearer covers what is behind; bars in a ring are cut.

docs/theory/pictures-in-space.md has the rule and when it is right.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import groupby, pairwise

import numpy as np

from gruebler.base.arrays import Flags, Reals
from gruebler.pictures.canvas.shapes import Shape
from gruebler.pictures.space.parts import LOOKS, SpatialPart

_SAME = 1e-3  # pixels: nearer depths do not decide
_MEET = 0.1  # pixels
_ROUNDS = 4  # of cutting; then what is left is painted by its depth


def painted_parts(parts: Sequence[SpatialPart]) -> list[Shape]:
    """The shapes of parts on paper, those behind first; bars of one link that follow each other become one body."""
    shapes: list[Shape] = []
    for _, run in groupby(covering_order(parts), key=lambda part: (part.link, part.look == "bar")):
        looks = [LOOKS[part.look](part) for part in _joined(list(run))]
        shapes += [shape for below, _ in looks for shape in below]
        shapes += [shape for _, above in looks for shape in above]
    return shapes


def _joined(run: Sequence[SpatialPart]) -> list[SpatialPart]:
    """Bars that are painted together meet without a gap in their outlines, which in textbooks are the bars."""
    ends = np.array([part.points[:2, :2] for part in run])

    def goes_on(k: int, end: int) -> bool:
        others = np.delete(ends, k, axis=0).reshape(-1, 2)
        return bool(len(others) and np.linalg.norm(others - ends[k, end], axis=1).min() < _MEET)

    return [
        replace(part, cut=(part.cut[0] and not goes_on(k, 0), part.cut[1] and not goes_on(k, 1)))
        for k, part in enumerate(run)
    ]


def covering_order(parts: Sequence[SpatialPart]) -> list[SpatialPart]:
    """Parts on paper, those behind first; bars that cover each other in a ring are cut between their crossings."""
    left = list(parts)
    for _ in range(_ROUNDS):
        behind, places = _relations(left)
        order = _sorted(left, behind)
        if len(order) == len(left):
            return [left[k] for k in order]
        ring = _in_rings(behind)
        if not any(left[k].look == "bar" for k in ring):
            break
        left = [
            piece
            for k, part in enumerate(left)
            for piece in (_cut(part, places[k, sorted(ring - {k})]) if k in ring and part.look == "bar" else [part])
        ]
    behind, _ = _relations(left)
    return [left[k] for k in _sorted(left, behind, force=True)]


def _relations(parts: Sequence[SpatialPart]) -> tuple[Flags, Reals]:
    """Which part lies behind which where they meet on paper, and where on the first's spine (0 to 1) that is."""
    spines = np.array([part.points[:2] for part in parts])
    reach = np.array([part.reach for part in parts])
    t, u, apart = _nearest(spines[:, :, :2])
    depth = spines[:, 0, 2, None] + t * (spines[:, 1, 2] - spines[:, 0, 2])[:, None]
    difference = depth - (spines[None, :, 0, 2] + u * (spines[:, 1, 2] - spines[:, 0, 2])[None, :])
    middle = spines[:, :, 2].mean(axis=1)
    difference = np.where(abs(difference) > _SAME, difference, middle[:, None] - middle)
    meets = apart < reach[:, None] + reach
    np.fill_diagonal(meets, False)
    return meets & (difference < -_SAME), t


def _nearest(lines: Reals) -> tuple[Reals, Reals, Reals]:
    """Where each two of the lines (lines, 2, 2) are nearest on paper: on the first, on the second; how far apart."""
    start, along = lines[:, 0], lines[:, 1] - lines[:, 0]
    length2 = np.maximum((along**2).sum(axis=1), 1e-12)
    between = start[None, :] - start[:, None]
    turn = _cross(along[:, None], along[None, :])
    steep = abs(turn) > 1e-9 * np.sqrt(length2[:, None] * length2)
    safe = np.where(steep, turn, 1.0)
    t, u = _cross(between, along[None, :]) / safe, _cross(between, along[:, None]) / safe
    crossing = steep & (t >= 0) & (t <= 1) & (u >= 0) & (u <= 1)

    def foot(point: Reals, of: Reals, lengths: Reals, begin: Reals) -> Reals:
        return np.asarray(np.clip(((point - begin) * of).sum(axis=-1) / lengths, 0.0, 1.0))

    best_t, best_u, best = t, u, np.where(crossing, 0.0, np.inf)
    for end in (0.0, 1.0):
        first_end, other = start + end * along, start + end * along
        for a, b in (
            (np.full_like(t, end), foot(first_end[:, None], along[None, :], length2[None, :], start[None, :])),
            (foot(other[None, :], along[:, None], length2[:, None], start[:, None]), np.full_like(t, end)),
        ):
            gap = np.linalg.norm(between + b[..., None] * along[None, :] - a[..., None] * along[:, None], axis=-1)
            nearer = gap < best - 1e-9
            best_t, best_u, best = np.where(nearer, a, best_t), np.where(nearer, b, best_u), np.where(nearer, gap, best)
    return best_t, best_u, best


def _cross(a: Reals, b: Reals) -> Reals:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


def _sorted(parts: Sequence[SpatialPart], behind: Flags, force: bool = False) -> list[int]:
    """Those behind first, bars of one link after each other where that is possible; without those of a ring."""
    waiting = behind.sum(axis=0)
    depth = [float(np.round(part.points[:2, 2].mean(), 3)) for part in parts]
    left, order = set(range(len(parts))), []
    last: SpatialPart | None = None
    while left:
        free = [k for k in left if not waiting[k]] or (list(left) if force else [])
        if not free:
            break
        following = [k for k in free if last is not None and last.look == parts[k].look and last.link == parts[k].link]
        chosen = min(following or free, key=lambda k: (depth[k], k))
        order.append(chosen)
        left.discard(chosen)
        waiting = waiting - behind[chosen]
        last = parts[chosen]
    return order


def _in_rings(behind: Flags) -> set[int]:
    """The parts of which some lie between two others that both wait."""
    left = np.ones(len(behind), bool)
    while True:
        kept = left & behind[left].any(axis=0) & behind[:, left].any(axis=1)
        if (kept == left).all():
            return set(np.flatnonzero(left).tolist())
        left = kept


def _cut(part: SpatialPart, places: Reals) -> list[SpatialPart]:
    """The bar in pieces, each with one of these places of its spine."""
    crossings = np.unique(np.round(places, 6))
    ends = [0.0, *(float(a + b) / 2 for a, b in pairwise(crossings.tolist())), 1.0]
    a, b = part.points
    return [
        SpatialPart(
            link=part.link,
            look=part.look,
            points=np.array([a + low * (b - a), a + high * (b - a)]),
            reach=part.reach,
            fixed=part.fixed,
            cut=(low > 0 or part.cut[0], high < 1 or part.cut[1]),
        )
        for low, high in pairwise(ends)
    ]
