"""The count of Grübler and Kutzbach: F = b(n - 1) - sum (b - f)."""

from __future__ import annotations

from dataclasses import dataclass

from gruebler.base.errors import ChainError
from gruebler.structure.chain import Chain


@dataclass(frozen=True, slots=True)
class Count:
    """The numbers that enter the formula, and its value."""

    n: int
    b: int
    by_freedom: tuple[tuple[int, int], ...]
    """(f, number of joints with f freedoms), a joint of k links counted k - 1 times."""

    @property
    def value(self) -> int:
        """F."""
        return self.b * (self.n - 1) - sum((self.b - f) * g for f, g in self.by_freedom)

    @property
    def terms(self) -> tuple[tuple[int, int, int], ...]:
        """(u, f, g) for each kind of joint that appears in the formula: u = b - f motions taken away by each of g."""
        return tuple((self.b - f, f, g) for f, g in self.by_freedom)

    def formula(self) -> str:
        """The formula with its numbers.

        >>> count_freedoms(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)")).formula()
        'F = 3(n - 1) - 2 g1 = 3(4 - 1) - 2·4 = 1'
        """
        symbols = "".join(f" - {_factor(u)}g{f}" for u, f, _ in self.terms)
        numbers = "".join(f" - {u}·{g}" if u != 1 else f" - {g}" for u, _, g in self.terms)
        return f"F = {self.b}(n - 1){symbols} = {self.b}({self.n} - 1){numbers} = {self.value}"

    def criterion(self) -> str:
        """The criterion of constrained motion, F = 1 written as a sum that must be 0.

        >>> count_freedoms(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)")).criterion()
        '3n - 4 - 2 g1 = 12 - 4 - 8 = 0'
        """
        symbols = "".join(f" - {_factor(u)}g{f}" for u, f, _ in self.terms)
        numbers = "".join(f" - {u * g}" for u, _, g in self.terms)
        return f"{self.b}n - {self.b + 1}{symbols} = {self.b * self.n} - {self.b + 1}{numbers} = {self.value - 1}"


def _factor(u: int) -> str:
    return "" if u == 1 else f"{u} "


def count_freedoms(chain: Chain, b: int | None = None) -> Count:
    """The count with all its terms.

    Args:
        chain: any chain.
        b: the motions of a free link, where the chain moves in a smaller group than its space: 2 for screws
            on one axis (turn and shift), 3 for translations in space. By default the b of the space.

    Raises `ChainError` if a joint has more freedoms than b leaves room for, or b is not 1 to 6.
    """
    motions = chain.space.b if b is None else b
    if not 1 <= motions <= 6:
        raise ChainError("b is the number of motions of a free link, 1 to 6, not {b}", b=b)
    by_freedom = chain.joints_by_freedom
    too_free = max(by_freedom)
    if too_free >= motions:
        joint = next(j for j in chain.joints if j.pair.f(chain.space) == too_free)
        raise ChainError(
            "the joint {joint} has f = {too_free}, which leaves nothing to constrain when b = {motions}",
            joint=joint,
            too_free=too_free,
            motions=motions,
        )
    return Count(chain.n, motions, tuple(by_freedom.items()))


def counted(chain: Chain, b: int | None = None) -> int:
    """F by the formula alone.

    >>> counted(Chain.parse("spatial: R(frame-spindle) H(spindle-nut) P(nut-frame)"))
    -3
    >>> counted(Chain.parse("spatial: R(frame-spindle) H(spindle-nut) P(nut-frame)"), b=2)
    1
    """
    return count_freedoms(chain, b).value
