"""Mobility with dimensions: at a pose, and finite, beside the count and what almost all sizes give.

`freedoms` takes a planar `Linkage` or a `SpatialLinkage`. docs/theory/freedoms.md has the theorems and what may err.
"""

from gruebler.freedoms.finite import Evidence, Finite
from gruebler.freedoms.instant import Instant
from gruebler.freedoms.placing import known
from gruebler.freedoms.reasons import Reason
from gruebler.freedoms.report import Freedoms, freedom_report, freedoms

__all__ = ["Evidence", "Finite", "Freedoms", "Instant", "Reason", "freedom_report", "freedoms", "known"]
