"""M, h and Q of one freedom as series of its coordinate, chart by chart: what loads without laws need of a pose.

docs/theory/free-motion.md.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from gruebler._core import reduced_forces
from gruebler.base.arrays import Reals, angles_of_turns
from gruebler.mechanics.dynamics.charts import Chart, Charts
from gruebler.mechanics.dynamics.equations import EquationsOfMotion, Influences

_NODES = 40  # products of two series of a chart have degree 34
_ZEROS = np.cos(np.pi * (np.arange(_NODES) + 0.5) / _NODES)
_TO_SERIES = chebyshev.chebvander(_ZEROS, _NODES - 1).T * (2 / _NODES)
_TO_SERIES[0] /= 2
_TAIL = 4  # the last coefficients, which tell whether a series has ended
_ENDED = 1e-13  # of the largest mass or force


class SeriesTable(NamedTuple):
    """The series of all charts that are known, in order, as the kernels take them."""

    ends: Reals
    """(charts, 4): where each is used, from and to, its middle and half width."""
    coefficients: Reals
    """(charts, nodes, 6)."""
    closed: float
    """From where a whole turn of the drive leads back; NaN if none does."""


class ReducedSeries:
    """M, dM/dq / 2, Q and the power by speed of one freedom, without the poses."""

    def __init__(
        self,
        charts: Charts,
        equations: EquationsOfMotion,
        lossy: EquationsOfMotion,
        is_calm: Callable[[Charts, Chart], bool],
    ) -> None:
        self.charts, self._equations, self._lossy, self._is_calm = charts, equations, lossy, is_calm
        self._known = dict[Chart, Reals | None]()
        self.table = self._tabled()

    def at(self, q: float, v: float) -> tuple[float, float, float] | None:
        """M, Q - h and what loads without potential do, all at a value and speed of the coordinate.

        None where forces are no short series: a spring whose ends meet.
        """
        reduced = reduced_forces(*self.table, q, v)
        if reduced is not None:
            return reduced
        chart, _ = self.charts.chart(q)
        if chart not in self._known:
            self._known[chart] = self._found(chart)
        self.table = self._tabled()
        return reduced_forces(*self.table, q, v)

    def smooth(self, q: float) -> tuple[SeriesTable, NDArray[np.uint8]]:
        """The table and its calm charts between the seams of laws that lie round a value."""
        seams = self.charts.seams
        if not seams:
            return self.table, self.calm
        low = max((seam for seam in seams if seam <= q), default=-np.inf)
        high = min((seam for seam in seams if seam > q), default=np.inf)
        ends = self.table.ends
        here = (ends[:, 0] >= low) & (ends[:, 1] <= high)
        return self.table._replace(ends=ends[here], coefficients=self.table.coefficients[here]), self.calm[here]

    def _tabled(self) -> SeriesTable:
        known = [(chart, series) for chart in self.charts.known if (series := self._known.get(chart)) is not None]
        self.calm: NDArray[np.uint8] = np.array([self._is_calm(self.charts, chart) for chart, _ in known], np.uint8)
        """Of each chart in the table, whether coordinates are never exchanged there."""
        return SeriesTable(
            np.array([(chart.low, chart.high, chart.middle, chart.half) for chart, _ in known]).reshape(-1, 4),
            np.array([series for _, series in known]).reshape(-1, _NODES, 6),
            np.nan if self.charts.closed is None else self.charts.closed,
        )

    def _found(self, chart: Chart) -> Reals | None:
        """(nodes, 6): Chebyshev coefficients; forces are linear in the speed, since dampers are."""
        jets = self.charts.jets_on(chart, _ZEROS)
        influences = Influences(
            places=jets.places[0],
            turns=jets.turns,
            angles=angles_of_turns(jets.turns),
            unit_places=jets.places[1:2],
            unit_rates=jets.rates[:1],
            drift_places=jets.places[2],
            drift_rates=jets.rates[1],
        )
        drives = (chart.middle + chart.half * _ZEROS)[:, None]
        still, unit = (influences.moving(0.0, drives, np.full_like(drives, speed)) for speed in (0.0, 1.0))
        mass, bias = self._equations.inertia(influences, unit)
        forces = list[Reals]()
        for equations in (self._equations, self._lossy):
            held, damped = np.zeros((2, _NODES))
            if equations is self._equations or not self._equations.acting.conservative:
                held = equations.generalised(influences, still)[:, 0]
            if any(spring.damping for spring in equations.loads.springs):
                damped = equations.generalised(influences, unit)[:, 0] - held
            forces += [held, damped]
        values = np.stack([mass[:, 0, 0], bias[:, 0], *forces], axis=1)
        series = np.asarray(_TO_SERIES @ values, np.float64)
        sizes = np.abs(values).max(axis=0)
        sizes[:2], sizes[2:] = sizes[0], sizes[2:].max()  # what is small beside its like is rounding
        return series if (np.abs(series[-_TAIL:]) <= _ENDED * sizes).all() else None
