"""How far each of several targets may be missed: exactly met, within a band, or as nearly as possible.

docs/theory/synthesis-points.md, "Targets of several kinds".
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gruebler.base.arrays import Flags, Reals, compared_by_value
from gruebler.design.synthesis.tasks import PathTask

STAGES = (10.0, 1e3, 1e5)
"""Weights, one fit after the other, of what is met exactly or within its band, by that of what is met nearly."""
_INSIDE = 1 - 1e-6  # of a band: least squares end a little outside of what they keep to


def numbers_or(values: Sequence[float | None], free: float, count: int) -> Reals:
    """So many numbers of a task, another one where there is none."""
    return np.array([free if value is None else value for value in values] or [free] * count, np.float64)


@compared_by_value
@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class TargetBands:
    """Bands and weights of targets, in one unit of length.

    >>> bands = TargetBands.of(PathTask([(0, 0), (2, 0)], tolerances=[0.5, None]), 2.0)
    >>> bands.band.tolist(), bands.weighed(np.array([[3.0], [3.0]]), np.ones((2, 1, 1)))[0].round(3).tolist()
    ([0.25, inf], [[27.5], [3.0]])
    """

    band: Reals
    """(targets,) how far each may be missed; infinite where it is met as nearly as possible."""
    weight: Reals
    """(targets,) of those that are met as nearly as possible."""
    hard: float = STAGES[0]
    """The weight of the others."""

    @classmethod
    def of(cls, task: PathTask, unit: float) -> TargetBands:
        """Those of a task, by a length."""
        count = len(task)
        return cls(band=numbers_or(task.tolerances, np.inf, count) / unit, weight=numbers_or(task.weights, 1.0, count))

    @property
    def exact(self) -> Flags:
        """(targets,) which ones are met exactly."""
        return np.asarray(self.band == 0)

    def weighed(self, errors: Reals, slopes: Reals) -> tuple[Reals, Reals]:
        """Errors with their derivatives: within a band they count nothing, beyond it by how much they pass it.

        Args:
            errors: (..., targets, parts) of each target, its length being held against the band.
            slopes: (..., targets, parts, numbers)
        """
        length = np.maximum(np.sqrt(np.sum(errors**2, axis=-1)), 1e-100)
        hard = np.isfinite(self.band)
        band = np.where(hard, _INSIDE * self.band, 0)
        share = np.maximum(1 - band / length, 0)[..., None]
        bent = np.where(share > 0, (band / length**3)[..., None], 0) * errors
        along = np.einsum("...p,...pn->...n", errors, slopes)
        weight = np.where(hard, self.hard, self.weight)[:, None]
        return weight * share * errors, weight[..., None] * (
            share[..., None] * slopes + bent[..., None] * along[..., None, :]
        )

    def tolerance(self, demanded: float, exactly: float, nearly: float) -> float:
        """How far a design may miss targets by their size, which is the unit here.

        Args:
            demanded: of all targets.
            exactly: up to which tolerance targets are met exactly.
            nearly: that of targets which are met as nearly as possible, if no larger one is demanded.
        """
        if self.exact.all():
            return demanded
        least = demanded if demanded > exactly else nearly
        return max(least, float(self.band[np.isfinite(self.band)].max(initial=0.0)))
