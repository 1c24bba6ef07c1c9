"""In which order a traced circuit meets targets, or comes near to them, by another hand than the library's.

Within its bound each target is near along intervals of the circuit, and one sweep from every end of these tells whether
places in order can be chosen from them. An exact target is one with a bound of 1e-9.
"""

import numpy as np

from .traced_linkage import LAP, values_of


class Distances:
    """Squares of the distances of a circuit from targets: cubics between arcs, with their least values."""

    def __init__(self, course, probes, wanted):
        self.course = course
        arcs = np.sort(np.append(course.arcs, (course.arcs[1:] + course.arcs[:-1]) / 2))
        q, along = course.at(np.append(arcs[:-1], course.length * (1 - 1e-15)))
        values, rates = values_of(course.closing, probes, q, along)
        free = np.isnan(wanted)[:, None]  # (targets, rows, probes)
        known = np.where(free, 0, wanted[:, None])
        gaps = np.where(free, 0, values - known)
        square = np.sum(np.abs(gaps) ** 2, axis=2)
        slope = 2 * np.sum(np.where(free, 0, np.real(np.conj(gaps) * rates)), axis=2)
        target, k = np.nonzero((slope[:, :-1] < 0) & (slope[:, 1:] >= 0))
        low, high = arcs[k], arcs[k + 1]
        for _ in range(42):  # where the distance is least, all of all targets at once
            at = (low + high) / 2
            here, rate = values_of(course.closing, probes, *course.at(at))
            gap = np.where(free[target, 0], 0, here - known[target, 0])
            level = 2 * np.sum(np.where(free[target, 0], 0, np.real(np.conj(gap) * rate)), axis=1)
            low, high = np.where(level < 0, at, low), np.where(level < 0, high, at)
        best = np.sum(np.abs(gap) ** 2, axis=1)
        self.parts = []
        for row in range(len(wanted)):
            own = target == row
            order = np.argsort(np.append(arcs, at[own]), kind="stable")
            pairs = (arcs, at[own]), (square[row], best[own]), (slope[row], level[own])
            self.parts.append([np.append(a, b)[order] for a, b in pairs])

    @property
    def nearest(self):
        """(targets,) the least distance of each."""
        return np.sqrt([part[1].min() for part in self.parts])

    def intervals(self, target, bound):
        """(intervals, 2) where a target is no farther than a bound; laps of a closed circuit side by side."""
        arcs, square, slope = self.parts[target]
        inside = square <= bound**2
        k = np.flatnonzero(inside[1:] != inside[:-1])
        h, low, high = arcs[k + 1] - arcs[k], np.zeros(len(k)), np.ones(len(k))
        a, b, m, n = square[k], square[k + 1], h * slope[k], h * slope[k + 1]
        for _ in range(44):
            t = (low + high) / 2
            here = a + t * (m + t * (3 * (b - a) - 2 * m - n + t * (2 * (a - b) + m + n)))
            same = (here <= bound**2) == inside[k]
            low, high = np.where(same, t, low), np.where(same, high, t)
        ends = [*(arcs[k] + h * (low + high) / 2)]
        ends = [0.0] * bool(inside[0]) + ends + [self.course.length] * bool(inside[-1])
        rows = np.array(ends, float).reshape(-1, 2)
        if not self.course.closed:
            return rows
        length = self.course.length
        rows = (rows + length * np.arange(-2, 4)[:, None, None]).reshape(-1, 2)
        joined = [list(rows[0])] if len(rows) else []
        for low, high in rows[1:]:
            if low - joined[-1][1] < 1e-12 * length:
                joined[-1][1] = high
            else:
                joined.append([low, high])
        return np.array(joined).reshape(-1, 2)

    def in_order(self, bounds, groups, free=(), *, limits=True):
        """Whether places no farther from the targets than their bounds lie in order, without a limit of the drive."""
        every = [self.intervals(k, bound) for k, bound in enumerate(bounds)]
        if not all(map(len, every)):
            return False
        course = self.course
        pieces = course.pieces if limits else [None] if course.closed else [(0.0, course.length)]
        return any(
            _piece_in_order(course, every, order, free, piece) for piece in pieces for order in (groups, groups[::-1])
        )


def _piece_in_order(course, every, order, free, piece):
    """Whether one sweep succeeds, begun at any end of an interval on a piece; None is a lap from anywhere."""
    length = course.length
    tiny = 1e-10 * length
    if piece is None:
        starts = np.unique(np.concatenate([rows.ravel() for rows in every]))
        windows = [(s, s + length) for s in starts[(starts >= 0) & (starts <= length)]]
    else:
        windows = [piece]
    for begin, end in windows:
        at, last = begin, begin
        for group in order:
            places = []
            for k in group:
                row = int(np.searchsorted(every[k][:, 1], at - tiny))
                places.append(max(at, every[k][row, 0]) if row < len(every[k]) else np.inf)
            at = last = max([at, *places])
            if last > end + tiny:
                break
        if last > end + tiny:
            continue
        if all(((every[k][:, 1] >= begin - tiny) & (every[k][:, 0] <= end + tiny)).any() for k in free):
            return True
    return False


def places_of_drives(course, drives, probes, wanted, size):
    """The arcs where the drive has values, one after the other on one piece of the circuit; none if there are not.

    Of several pieces, and places on them, those that miss the targets least, and how far each target is missed.
    """
    c = course.closing.column[course.closing.crank] + 2
    turned = np.asarray(drives) - drives[0]
    laps = course.length * np.arange(-3, 4) if course.closed else np.zeros(1)
    grow = course.q[-1, c] - course.q[0, c]
    best = None
    for piece in course.pieces:
        low, high = (-2 * course.length, 3 * course.length) if piece is None else piece
        arcs = (course.arcs[:-1] + laps[:, None]).ravel()
        values = (course.q[:-1, c] + (grow * np.arange(-3, 4) if course.closed else np.zeros(1))[:, None]).ravel()
        rows = (arcs > low) & (arcs < high)
        ends = np.array([low, high])
        inner = np.clip(ends, arcs[0], course.length * (1 - 1e-15) if not course.closed else np.inf)
        at_ends = course.at(inner)[0][:, c]
        arcs, values = (
            np.concatenate([[low], arcs[rows], [high]]),
            np.concatenate([at_ends[:1], values[rows], at_ends[1:]]),
        )
        if values[-1] < values[0]:
            arcs, values = arcs[::-1], values[::-1]
        first = drives[0] + LAP * np.arange(
            np.ceil((values[0] - drives[0] - 1e-9) / LAP), (values[-1] - drives[0]) / LAP + 1
        )
        for start in first:
            goals = start + turned
            if goals.min() < values[0] - 1e-9 or goals.max() > values[-1] + 1e-9:
                continue
            k = np.clip(np.searchsorted(values, goals, side="right") - 1, 0, len(values) - 2)
            below, above = arcs[k], arcs[k + 1]
            for _ in range(50):
                middle = (below + above) / 2
                less = course.at(middle)[0][:, c] < goals
                below, above = np.where(less, middle, below), np.where(less, above, middle)
            found = (below + above) / 2
            here, _ = values_of(course.closing, probes, *course.at(found))
            misses = np.sqrt(np.nansum(np.abs(here - wanted) ** 2, axis=1)) / size
            if best is None or misses.max() < best[1].max() - 1e-12:
                best = found, misses
    return best
