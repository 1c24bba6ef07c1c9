"""Generic mobility: the mobility at almost all dimensions of a chain, by exact rank at a random placement.

A rank modulo a prime never exceeds the generic rank, so an error has only one direction: mobility and
redundancy would be too large, never too small. The answer is proved (`exact`) when the rank reaches the
number of constraints or of unknowns, or when a theorem lets the pebble game confirm it. Otherwise two
independent placements are compared and the bound on the probability of error is given.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from gruebler.base.errors import GrueblerError
from gruebler.structure.chain import Chain
from gruebler.structure.mobility.placement import LockedFreedom, Placement, random_placement
from gruebler.structure.mobility.prime_field import (
    CoreTooLarge,
    Echelon,
    Row,
    echelon,
    null_space,
    random_solutions,
    transposed,
)
from gruebler.structure.mobility.sparsity import pebble_mobility, theorem

_FIRST_SEED = 20_261_121
_SAMPLES = 3  # random motions or stresses that represent all of them
_LARGEST = 1e9  # bytes accepted without ``large``
_SECONDS_A_ROW = 1e-4
_BYTES_A_ROW = 2800  # of the process, measured with 20,000 links (benchmarks/README.md)
_BYTES_WITH_STRESSES = 3500  # the same where some constraints depend on others: the transpose is eliminated, too
_TRIES = 4  # placements tried before a rank below the theorem's is an internal error


class TooLargeError(GrueblerError):
    """The rank of this chain takes more than about a minute or 1 GB; raised before the elimination starts."""


@dataclass(frozen=True, kw_only=True)
class Generic:
    """The rank at one random placement, and the spaces of motions and stresses that come with it."""

    chain: Chain
    placement: Placement
    form: Echelon
    exact: bool
    error_bound: float
    """0 if exact; else an upper bound of the probability that mobility and redundancy are too large."""
    large: bool = False
    """Whether to start eliminations that take more than about a minute or 1 GB."""

    @property
    def mobility(self) -> int:
        """The dimension of the motions when the first link is fixed."""
        return self.placement.columns - self.form.rank

    @property
    def redundancy(self) -> int:
        """How many constraints follow from the others: constraints minus rank."""
        return len(self.placement.rows) - self.form.rank

    @cached_property
    def motions(self) -> NDArray[np.int64]:
        """A basis of the motions, shape (mobility, n, b): a twist modulo P for each link, zero for the first."""
        basis = null_space(self.form)
        b = self.chain.space.b
        still = np.zeros((len(basis), b), np.int64)
        return np.hstack([still, basis]).reshape(len(basis), self.chain.n, b)

    @cached_property
    def some_motions(self) -> NDArray[np.int64]:
        """Three random motions side by side, shape (n, 3 b); they represent all motions.

        Two links that move relative to each other in some motion agree in all three with probability 1/P^3.
        """
        b = self.chain.space.b
        moving = random_solutions(self.form, _SAMPLES).reshape(self.chain.n - 1, b * _SAMPLES)
        return np.vstack([np.zeros((1, b * _SAMPLES), np.int64), moving])

    @cached_property
    def clusters(self) -> list[tuple[str, ...]]:
        """The links grouped by equal twists in every motion: no relative motion within a group."""
        clusters: dict[bytes, list[str]] = {}
        for link, twists in zip(self.chain.links, self.some_motions, strict=True):
            clusters.setdefault(twists.tobytes(), []).append(link)
        return [tuple(cluster) for cluster in clusters.values()]

    @cached_property
    def stress_form(self) -> Echelon:
        """The equations of the self-stresses, the dependencies among the constraints, in echelon form."""
        count = len(self.placement.rows)
        _check_size(count, stresses=True, large=self.large)
        return _eliminated(transposed(self.placement.rows, self.placement.columns), count, large=self.large)

    @cached_property
    def some_stresses(self) -> NDArray[np.int64]:
        """Three random self-stresses, shape (constraints, 3); they represent all self-stresses."""
        return random_solutions(self.stress_form, _SAMPLES)


def generic(chain: Chain, locks: Sequence[LockedFreedom] = (), *, large: bool = False) -> Generic:
    """The generic rank of a chain, with its certificate, optionally with locked freedoms.

    Cost: about linear for chains that grow dyad by dyad, cubic in the dense core of others; see
    benchmarks/README.md. Raises `TooLargeError` where that core takes more than about a minute or 1 GB, unless
    ``large``.
    """
    rows = len(locks) + sum(joint.count * joint.pair.u(chain.space) for joint in chain.joints)
    _check_size(rows, stresses=rows > chain.space.b * (chain.n - 1), large=large)
    licensed = bool(theorem(chain)) and not locks
    known = None
    best: tuple[Placement, Echelon] | None = None
    for attempt in range(_TRIES):
        placement = random_placement(chain, _FIRST_SEED + attempt, locks)
        form = _eliminated(placement.rows, placement.columns, large=large)
        if form.rank == min(len(placement.rows), placement.columns):
            return Generic(chain=chain, placement=placement, form=form, exact=True, error_bound=0.0, large=large)
        if licensed:
            known = pebble_mobility(chain) if known is None else known
            if placement.columns - form.rank == known:
                return Generic(chain=chain, placement=placement, form=form, exact=True, error_bound=0.0, large=large)
        elif best is None:
            best = placement, form
        else:
            placement, form = max(best, (placement, form), key=lambda pair: pair[1].rank)
            return Generic(
                chain=chain,
                placement=placement,
                form=form,
                exact=False,
                error_bound=placement.error_bound(form.rank) ** 2,
                large=large,
            )
    raise AssertionError(f"{_TRIES} random placements stay below the rank that theory gives for {chain!r}")


def _check_size(rows: int, *, stresses: bool, large: bool) -> None:
    size = rows * (_BYTES_WITH_STRESSES if stresses else _BYTES_A_ROW)
    if size > _LARGEST and not large:
        raise _too_large(CoreTooLarge(rows, rows * _SECONDS_A_ROW, size))


def _eliminated(rows: Iterable[Row], columns: int, *, large: bool) -> Echelon:
    try:
        return echelon(rows, columns, large=large)
    except CoreTooLarge as core:
        raise _too_large(core) from None


def _too_large(core: CoreTooLarge) -> TooLargeError:
    numbers = f"{core.seconds / 60:.1f} min, {core.size / 1e9:.1f} GB"
    return TooLargeError(
        "the chain leaves {rows:,} equations to be solved at once: about {numbers}; `gruebler check "
        "--yes` and mobility_report(..., large=True) begin it nevertheless",
        rows=core.rows,
        numbers=numbers,
    )


def generic_mobility(chain: Chain) -> int:
    """The generic mobility by exact rank over a prime field.

    >>> generic_mobility(Chain.parse("P(0-1) P(1-2) P(2-0)"))  # counted 0: three sliders cannot turn the links
    1
    """
    return generic(chain).mobility
