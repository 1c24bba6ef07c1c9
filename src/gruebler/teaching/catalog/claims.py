"""The check of an entry's claims: printed values against derived ones."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from gruebler.base.errors import LinkageError
from gruebler.base.text import message, translate
from gruebler.files.catalog_records import Claims
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.structure.chain import Chain
from gruebler.structure.mobility import Count, MobilityReport, counted, mobility_report

if TYPE_CHECKING:
    from gruebler.mechanics.screws import Freedoms

_NONE = message("none")


@dataclass(frozen=True, slots=True)
class WrongClaim:
    """A claim that does not hold."""

    key: str
    printed: object
    derived: object

    def in_language(self, lang: str) -> str:
        """What is printed and what is derived, in a language."""
        return translate(
            "{key}: printed {printed}, derived {derived}",
            lang,
            key=self.key,
            printed=self.printed,
            derived=self.derived,
        )

    def __str__(self) -> str:
        return self.in_language("en")


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckedEntry:
    """A chain with its report and its claims."""

    id: str
    origin: str
    """The file with the claims, for messages; empty if there is none."""
    report: MobilityReport
    claims: Claims
    wrong: tuple[WrongClaim, ...]
    freedoms: Freedoms | None = None
    """The freedoms at the entry's dimensions, if it has any."""

    @property
    def holds(self) -> bool:
        """Whether every claim holds."""
        return not self.wrong


def check_claims(
    chain: Chain,
    claims: Claims,
    *,
    id: str,
    frame: str | None = None,
    origin: str = "",
    linkage: Linkage | SpatialLinkage | None = None,
) -> CheckedEntry:
    """Compare every claim with the derived value.

    A claimed mobility is that at special dimensions. With dimensions it is derived: it must be the finite mobility,
    and where none is claimed the dimensions must not be special. The structure alone only shows that it must not be
    less than the generic one. A claim that differs from the generic mobility needs a reason.

    >>> four_bar = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)")
    >>> [str(w) for w in check_claims(four_bar, Claims(n=4, counted=2), id="four-bar").wrong]
    ['claims.counted: printed 2, derived 1']
    """
    report = mobility_report(chain, frame=frame)
    derived: dict[str, object] = {"n": chain.n, "counted": report.counted} | _joint_counts(report.count)
    wrong = [
        WrongClaim(f"claims.{key}", getattr(claims, key), value)
        for key, value in derived.items()
        if getattr(claims, key) is not None and getattr(claims, key) != value
    ]
    derived_freedoms: Freedoms | None = None
    if linkage is not None:
        from gruebler.mechanics.screws import freedoms  # loaded for what has dimensions

        try:
            derived_freedoms = freedoms(linkage)
        except LinkageError as error:
            wrong.append(WrongClaim("dimensions", message("a linkage that can be assembled"), error))
    if derived_freedoms is not None and derived_freedoms.mobility != (
        report.generic if claims.mobility is None else claims.mobility
    ):
        wrong.append(WrongClaim("claims.mobility", claims.mobility, derived_freedoms.mobility))
    elif claims.mobility is not None and claims.mobility < report.generic:
        wrong.append(
            WrongClaim("claims.mobility", claims.mobility, message("at least {mobility}", mobility=report.generic))
        )
    if claims.mobility is not None and claims.mobility != report.generic and claims.reason is None:
        wrong.append(
            WrongClaim("claims.reason", _NONE, message("a mobility other than the generic one needs a reason"))
        )
    if claims.group is not None and (f := counted(chain, claims.group.b)) != claims.group.counted:
        wrong.append(WrongClaim("claims.group.counted", claims.group.counted, f))
    idle = tuple(link for freedom in report.idle_freedoms for link in freedom.links)
    if claims.idle and set(claims.idle) != set(idle):
        wrong.append(WrongClaim("claims.idle", ", ".join(claims.idle), ", ".join(idle) or _NONE))
    return CheckedEntry(
        id=id, origin=origin, report=report, claims=claims, wrong=tuple(wrong), freedoms=derived_freedoms
    )


def _joint_counts(count: Count) -> dict[str, object]:
    by_freedom = dict(count.by_freedom)
    return {f"g{f}": by_freedom.get(f, 0) for f in range(1, 6)}
