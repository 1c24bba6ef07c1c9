"""Any plane linkage of pins and slides, followed by another hand: Newton's method in small steps along its circuit.

Nothing of `circuit`, `move`, plans or closed forms is used: closing conditions are written here once more, for all
links at once, in plain NumPy. The step is halved until the direction of the curve turns little and Newton's method
comes to rest at once, so that no other assembly mode is reached.
"""

from dataclasses import dataclass, field
from functools import lru_cache
from itertools import pairwise

import numpy as np

STEP = 0.04
"""Along the circuit, in sizes and radians."""
TURN = 0.06
"""Radians by which the direction of the curve may turn within a step."""
AT_REST = 1e-8
"""A step of Newton's method so short leaves an error of the order of its square."""
LAP = 2 * np.pi


class LostError(Exception):
    """The curve could not be followed."""


class Closing:
    """The closing conditions of a linkage, lengths in its size; poses are (rows, links * 3), without the frame."""

    def __init__(self, linkage):
        mechanism = linkage.mechanism
        self.linkage = linkage
        self.frame = mechanism.frame
        self.links = [link for link in mechanism.chain.links if link != self.frame]
        self.column = {link: 3 * k for k, link in enumerate(self.links)}
        pose = linkage.required_pose
        places = [complex(*pose[link].put(e.x, e.y)) for (_, link), e in linkage.elements.items()]
        self.middle = np.mean(places)
        self.size = float(np.abs(np.array(places) - self.middle).max())
        fixed = pose[self.frame]
        self.fixed = (complex(fixed.x, fixed.y) - self.middle) / self.size, fixed.angle
        places = [(complex(pose[link].x, pose[link].y) - self.middle) / self.size for link in self.links]
        rows = [(z.real, z.imag, pose[link].angle) for link, z in zip(self.links, places, strict=True)]
        self.start = np.concatenate(rows)
        number = {**{link: k for k, link in enumerate(self.links)}, self.frame: len(self.links)}
        pins, slides = [], []
        for joint, links in enumerate(joint.links for joint in mechanism.chain.joints):
            own = linkage.elements[joint, links[0]]
            for link in links[1:]:
                other = linkage.elements[joint, link]
                assert own.form == other.form != "round", "pins and slides only"
                (pins if own.is_pin else slides).append((number[links[0]], own, number[link], other))
        every = [*pins, *slides]
        self.pins = len(pins)
        self.ends = np.array([[first, second] for first, _, second, _ in every])
        self.arms = np.array([[complex(e.x, e.y), complex(f.x, f.y)] for _, e, _, f in every]) / self.size
        self.lines = np.array([[e.angle, f.angle] for _, e, _, f in slides]).reshape(-1, 2)
        (drive,) = mechanism.drives
        assert self.frame in drive.between
        (self.crank,) = set(drive.between) - {self.frame}

    def put(self, q, link, x=0.0, y=0.0):
        """Where a point of a link lies, in its size, and its derivative when the link turns; x and y in lengths."""
        arm = complex(x, y) / self.size
        if link == self.frame:
            return np.broadcast_to(self.fixed[0] + arm * np.exp(1j * self.fixed[1]), len(q)), None
        c = self.column[link]
        turned = arm * np.exp(1j * q[:, c + 2])
        return q[:, c] + 1j * q[:, c + 1] + turned, 1j * turned

    def angle(self, q, link):
        return np.full(len(q), self.fixed[1]) if link == self.frame else q[:, self.column[link] + 2]

    def conditions(self, q):
        """(rows, conditions) and their derivatives (rows, conditions, numbers)."""
        rows, count, pins = len(q), len(self.ends), self.pins
        poses = np.empty((rows, len(self.links) + 1, 3))
        poses[:, :-1] = q.reshape(rows, len(self.links), 3)
        poses[:, -1] = self.fixed[0].real, self.fixed[0].imag, self.fixed[1]
        turned = self.arms * np.exp(1j * poses[:, self.ends, 2])  # (rows, pairs, 2)
        ends = poses[:, self.ends, 0] + 1j * poses[:, self.ends, 1] + turned
        gap = ends[..., 1] - ends[..., 0]
        across = np.ones((rows, count), complex)  # what each pair does not allow, besides the second row
        angles = poses[:, self.ends[pins:], 2] + self.lines
        across[:, pins:] = 1j * np.exp(1j * angles[..., 0])
        apart = angles[..., 1] - angles[..., 0]
        values = np.concatenate([np.real(gap * np.conj(across)), gap.imag[:, :pins], np.sin(apart)], axis=1)
        slopes = np.zeros((rows, 2 * count, len(self.links) + 1, 3))
        k, pin, slide = np.arange(count), np.arange(pins), np.arange(pins, count)
        for side, sign in ((1, 1.0), (0, -1.0)):
            link = self.ends[:, side]
            slopes[:, k, link, 0] = sign * across.real
            slopes[:, k, link, 1] = sign * across.imag
            slopes[:, k, link, 2] = sign * np.real(1j * turned[..., side] * np.conj(across))
            slopes[:, count + pin, link[:pins], 1] = sign
            slopes[:, count + pin, link[:pins], 2] = sign * turned[:, :pins, side].real
            slopes[:, count + slide, link[pins:], 2] = sign * np.cos(apart)
        slopes[:, slide, self.ends[pins:, 0], 2] += np.real(gap[:, pins:] * np.conj(1j * across[:, pins:]))
        return values, slopes[:, :, :-1].reshape(rows, 2 * count, q.shape[1])

    def settled(self, q, across):
        """Rows brought to the circuit at right angles to directions (rows, numbers)."""
        for _ in range(8):
            values, slopes = self.conditions(q)
            matrix = np.concatenate([slopes, across[:, None]], axis=1)
            change = np.linalg.solve(matrix, np.append(values, np.zeros((len(q), 1)), axis=1)[..., None])[..., 0]
            q = q - change
            if np.abs(change).max(initial=0.0) < AT_REST:
                return q
        raise LostError

    def direction(self, q, before):
        """Unit vectors along the circuit, each on the side of another vector."""
        _, slopes = self.conditions(q)
        matrix = np.concatenate([slopes, before[:, None]], axis=1)
        end = np.zeros((len(q), len(self.start), 1))
        end[:, -1] = 1
        tangent = np.linalg.solve(matrix, end)[..., 0]
        return tangent / np.linalg.norm(tangent, axis=1, keepdims=True)

    def first_direction(self):
        _, slopes = self.conditions(self.start[None])
        return np.linalg.svd(slopes[0])[2][-1]


@dataclass(eq=False)
class Traced:
    """A circuit: poses along it with its directions there, the first one again at the end of a closed one."""

    closing: Closing
    arcs: np.ndarray
    q: np.ndarray
    directions: np.ndarray
    closed: bool
    origin: float = 0.0
    """The arc of the pose from which it was followed."""
    _limits: list = field(default_factory=list)

    @property
    def length(self):
        return self.arcs[-1]

    @property
    def drive(self):
        return self.closing.angle(self.q, self.closing.crank)

    def between(self, k, share):
        """Poses and directions at shares of steps, (rows,): a cubic, then Newton's method at right angles."""
        h = (self.arcs[k + 1] - self.arcs[k])[:, None]
        t = share[:, None]
        q0, q1, m0, m1 = self.q[k], self.q[k + 1], h * self.directions[k], h * self.directions[k + 1]
        guess = q0 + t * (m0 + t * (3 * (q1 - q0) - 2 * m0 - m1 + t * (2 * (q0 - q1) + m0 + m1)))
        q = self.closing.settled(guess, q1 - q0)
        return q, self.closing.direction(q, q1 - q0)

    def at(self, arcs):
        """Poses and directions at arcs of the circuit, a closed one going on for ever."""
        arcs = np.atleast_1d(np.asarray(arcs, float))
        laps = np.floor(arcs / self.length) if self.closed else np.zeros(len(arcs))
        rest = arcs - laps * self.length
        k = np.clip(np.searchsorted(self.arcs, rest, side="right") - 1, 0, len(self.arcs) - 2)
        share = np.clip((rest - self.arcs[k]) / (self.arcs[k + 1] - self.arcs[k]), 0, 1)
        q, along = self.between(k, share)
        return q + laps[:, None] * (self.q[-1] - self.q[0]), along

    @property
    def limits(self):
        """The arcs at which the drive turns back."""
        if not self._limits:
            c = self.closing.column[self.closing.crank] + 2
            rate = self.directions[:, c]
            k = np.flatnonzero(np.sign(rate[1:]) != np.sign(rate[:-1]))
            self._limits.append(self._zeros(k, lambda _, along: along[:, c]))
        return self._limits[0]

    def _zeros(self, k, of):
        """The arcs of zeros of a function of pose and direction in steps with a change of sign, by halving."""
        if not len(k):
            return np.zeros(0)
        begin = np.sign(of(self.q[k], self.directions[k]))
        low, high = np.zeros(len(k)), np.ones(len(k))
        for _ in range(44):
            middle = (low + high) / 2
            same = np.sign(of(*self.between(k, middle))) == begin
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        return self.arcs[k] + (low + high) / 2 * (self.arcs[k + 1] - self.arcs[k])

    @property
    def turns(self):
        """Whether the drive turns fully."""
        return self.closed and not len(self.limits) and bool(abs(self.drive[-1] - self.drive[0]) > 1)

    @property
    def pieces(self):
        """From which arc to which the drive goes one way; None for the whole of a closed circuit without limits."""
        if not len(self.limits):
            return [None] if self.closed else [(0.0, self.length)]
        if self.closed:
            ends = np.append(self.limits, self.limits[0] + self.length)
        else:
            ends = np.concatenate([[0.0], self.limits, [self.length]])
        return list(pairwise(ends))


@lru_cache(maxsize=8)
def traced(linkage, *, far=50.0, most=20_000, step=STEP):
    """The circuit of a linkage from its reference pose."""
    closing = Closing(linkage)
    start = closing.settled(closing.start[None], closing.first_direction()[None])[0]
    if np.abs(start - closing.start).max() > 1e-6:
        raise LostError
    along = closing.first_direction()
    q, directions, closed = _followed(closing, start, along, far, most, step)
    if not closed:
        back, turned, _ = _followed(closing, start, -along, far, most, step)
        before = len(back) - 1
        q, directions = np.concatenate([back[:0:-1], q]), np.concatenate([-turned[:0:-1], directions])
    turn = np.arccos(np.clip(np.sum(directions[1:] * directions[:-1], axis=1), -1, 1))
    arcs = np.append(0, np.cumsum(np.linalg.norm(np.diff(q, axis=0), axis=1) * (1 + turn**2 / 24)))
    return Traced(closing, arcs, q, directions, closed, origin=0.0 if closed else float(arcs[before]))


def _followed(closing, start, along, far, most, step):
    angles = np.arange(2, len(start), 3)
    q, directions, h, bend = [start], [along], step, 0 * start
    while len(q) < most:
        here, towards = q[-1], directions[-1]
        try:
            guess = here + h * towards
            there = closing.settled((guess + h**2 / 2 * bend)[None], towards[None])[0]
            follows = closing.direction(there[None], towards[None])[0]
            good = np.linalg.norm(there - guess) < TURN * h and follows @ towards > np.cos(TURN)
        except (LostError, np.linalg.LinAlgError):
            good = False
        if not good:
            h /= 2
            if h < 1e-9:
                raise LostError
            continue
        gap = there - start
        gap[angles] -= LAP * np.round(gap[angles] / LAP)
        last = here - start
        last[angles] -= LAP * np.round(last[angles] / LAP)
        close = np.linalg.norm(gap) < 1.5 * h and np.linalg.norm(last) < 1.5 * h
        if len(q) > 2 and close and last @ along < 0 <= gap @ along and towards @ along > 0.9:
            end = start.copy()
            end[angles] += LAP * np.round((there - start)[angles] / LAP)
            if np.linalg.norm(end - here) < 1e-3 * h:  # a step of nothing
                q[-1], directions[-1] = end, along
            else:
                q.append(end)
                directions.append(along)
            return np.array(q), np.array(directions), True
        q.append(there)
        directions.append(follows)
        bend = (follows - towards) / h
        if np.abs(np.delete(there, angles)).max() > far:
            break
        h = min(1.4 * h, step)
    return np.array(q), np.array(directions), False


# --- what is looked at ---------------------------------------------------------------------------------------------


def values_of(closing, probes, q, along):
    """(rows, probes) complex values of quantities, and their derivatives by the arc."""
    values, rates = [], []

    def motion(link, x, y):
        place, turned = closing.put(q, link, x, y)
        if link == closing.frame:
            return place, np.zeros(len(q))
        c = closing.column[link]
        return place, along[:, c] + 1j * along[:, c + 1] + along[:, c + 2] * turned

    for probe in probes:
        if probe.point:
            point = closing.linkage.points[probe.point]
            place, rate = motion(point.link, point.x, point.y)
            values.append(closing.middle + closing.size * place)
            rates.append(closing.size * rate)
        elif probe.joint >= 0:
            first, second = closing.linkage.mechanism.chain.joints[probe.joint].links
            own, other = (closing.linkage.elements[probe.joint, link] for link in (first, second))
            if first != closing.frame:
                first, second, own, other = second, first, other, own
            assert first == closing.frame
            direction = np.exp(1j * (closing.fixed[1] + own.angle))
            (p, _), (r, rate) = motion(first, own.x, own.y), motion(second, other.x, other.y)
            values.append(closing.size * np.real((r - p) * np.conj(direction)) + 0j)
            rates.append(closing.size * np.real(rate * np.conj(direction)) + 0j)
        else:
            angle = closing.angle(q, probe.link)
            turned = probe.length * np.exp(1j * angle)
            values.append(turned)
            rates.append(1j * turned * along[:, closing.column[probe.link] + 2])
    return np.stack(values, axis=1), np.stack(rates, axis=1)
