"""The contours of a Geneva drive in units of the distance of its axes, with a lock clear of the turning wheel."""

from __future__ import annotations

import cmath
import math

import numpy as np

from gruebler.base.arrays import Complexes
from gruebler.machines.geneva import Geneva

_RIM = 0.16  # around the slots of an internal wheel
_PIN = 0.13  # of the crank: the radius of a pin, if there is space for it between the slots
_WALL = 1.1  # pin radii: the wall of a slot at its mouth
_LUG = 0.8  # pin radii: the thickness of the lug of an internal drive
_DEEP = 0.9  # of the distance that the mouth of a slot leaves


class GenevaShape:
    """The driver's axis is 0, the wheel's at 1, or at -1 for an internal wheel.

    >>> shape = GenevaShape(Geneva(4))
    >>> round(shape.crank, 4), round(shape.lock / shape.crank, 2), len(shape.wheel()) % 4
    (0.7071, 0.73, 0)
    """

    def __init__(self, geneva: Geneva) -> None:
        self.geneva = geneva
        self.crank, self.mouth, self.end, _ = geneva.sizes(1.0)
        self.sign = 1 if geneva.internal else -1
        self.axis = -float(self.sign)
        self.pin = min(_PIN * self.crank, 0.6 * self.end * math.sin(math.pi / geneva.slots))
        self.lock = self.crank - (1 + _WALL) * self.pin
        """The radius of the locking disc."""
        self.rim = self.end + self.pin + _RIM
        """The radius of an internal wheel."""

    def sector(self) -> Complexes:
        """The wheel's contour about one slot, which lies along x from the wheel's axis; counter-clockwise.

        From the middle of a locking arc (about the driver's axis in a dwell) over the slot to the middle of the next.
        """
        far, p = (0.0, self.pin) if self.geneva.internal else (math.pi, self.pin)
        corner = math.acos((self.mouth**2 - 1 - self.lock**2) / (2 * self.lock))
        side = cmath.exp(-1j * math.pi / self.geneva.slots)
        locking = side * (1 + self.lock * np.exp(1j * np.linspace(far, corner, 24)))
        land = np.linspace(cmath.phase(complex(locking[-1])), -math.asin(p / self.mouth), 6)
        lower = np.concatenate([locking, self.mouth * np.exp(1j * land[1:])])
        bottom = self.end + p * np.exp(1j * (-math.pi / 2 + self.sign * np.linspace(0, math.pi, 13)))
        contour: Complexes = np.concatenate([lower, bottom, np.conj(lower[::-1])])
        return contour

    def wheel(self) -> Complexes:
        """The full contour, the first slot towards the driver (external) or along x (internal)."""
        turns = np.exp(1j * self.geneva.step * np.arange(self.geneva.slots))
        contour: Complexes = np.concatenate([self.sign * turn * self.sector() for turn in turns])
        return contour

    def locking(self) -> list[Complexes]:
        """The contours that lock the wheel, the first pin along x: a disc with hollows, or a lug inside."""
        free = self.geneva.engaged
        if self.geneva.internal:
            turn = np.linspace(free, math.tau - free, 61)
            inner = self.lock - _LUG * self.pin * min(1.0, (self.geneva.slots - 2) / 2)
            return [np.concatenate([self.lock * np.exp(1j * turn), inner * np.exp(1j * turn[::-1])])]
        hollow = self._hollow()
        pitch = math.tau / self.geneva.pins
        arc = self.lock * np.exp(1j * np.linspace(free, pitch - free, 61)) if pitch - 2 * free > 1e-9 else hollow[:0]
        sector = np.concatenate([hollow, arc])
        return [np.concatenate([sector * np.exp(1j * k * pitch) for k in range(self.geneva.pins)])]

    def _hollow(self) -> Complexes:
        """A circle's arc between two locking arcs, deep enough for the mouth of a slot on the line of centres."""
        free, deep = self.geneva.engaged, _DEEP * (1 - self.mouth)
        end = self.lock * cmath.exp(1j * free)
        # The circle through the point (deep, 0) and both ends, its centre on the x axis.
        middle = (abs(end) ** 2 - deep**2) / (2 * (end.real - deep))
        half = cmath.phase(middle - end.conjugate())
        arc: Complexes = middle - (middle - deep) * np.exp(1j * np.linspace(half, -half, 41))
        return arc
