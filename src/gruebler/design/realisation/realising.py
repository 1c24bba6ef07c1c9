"""Dimensions for any planar mechanism."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor
from functools import partial
from itertools import combinations

from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.text import message
from gruebler.design.realisation.finishing import finish_linkage
from gruebler.design.realisation.layout_program import check_drawable, layout_program
from gruebler.design.realisation.result import Realisation
from gruebler.design.realisation.search import search_layouts
from gruebler.structure.assur import decompose
from gruebler.structure.enumeration.worker_pool import run_work
from gruebler.structure.mechanism import Drive, Mechanism
from gruebler.structure.mobility import generic

_NOTHING_TO_DRIVE = message("There is nothing to drive: the chain has no mobility.")
_AGAIN = 3  # searches with other random numbers if the first finds no full turn


@door_that_raises(LinkageError)
def realise(
    mechanism: Mechanism, *, seed: int = 0, budget: int = 1500, target_quality: float = 0.5, unit: str = "mm"
) -> Realisation:
    """Dimensions with which a mechanism assembles and its drives turn fully, or at least move over a wide range.

    Args:
        mechanism: a planar mechanism of turning and sliding joints and pins in slots; without drives, `with_drives`
            chooses them.
        seed: of the random numbers; the same seed gives the same linkage.
        budget: the number of drawings to try; up to three times as many if nothing turns fully.
        target_quality: the measure of conditioning at which the search stops; 0.5 is a transmission angle of 30
            degrees.
        unit: the name of the unit of lengths; the largest length on a link is about 100.

    Returns:
        `Realisation`: ``linkage``, ``quality``, ``full``; a failure (drives that do not fix the motion, nothing found)
        has ``found`` False and a ``message``.

    Raises:
        LinkageError: joints whose dimensions are not known (rolling pairs), other spaces, numbers out of range.

    Cost:
        About 0.3 ms a drawing, 1 to 3 ms with groups beyond dyads.

    Example:
        >>> result = realise(Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-0); drive=R(0-1)"), seed=1)
        >>> result.full, result.quality > 0.4
        (True, True)

    See Also:
        `synthesise`, `move`, `driven_mechanisms`

    Theory:
        docs/theory/realisation.md
    """
    _check("seed", seed, 0)
    _check("budget", budget, 1)
    if isinstance(target_quality, bool) or not isinstance(target_quality, int | float) or not 0 < target_quality <= 1:
        raise LinkageError("target_quality lies between 0 and 1, not {target_quality!r}", target_quality=target_quality)
    check_drawable(mechanism.chain)
    driven = mechanism if mechanism.drives else with_drives(mechanism)
    parts = decompose(driven)
    if not (driven.drives and parts.complete):
        reason = parts.reason if driven.drives else _NOTHING_TO_DRIVE
        return Realisation(
            mechanism=driven, linkage=None, ranges=(), full=False, quality=0.0, tries=0, seed=seed, reason=reason
        )
    drawn = layout_program(driven)
    turning = all(drive.turning for drive in driven.drives)
    best, tries = None, 0
    for attempt in range(_AGAIN):
        result = search_layouts(drawn, seed=seed + (attempt << 32), budget=budget, target_quality=target_quality)
        tries += result.tries
        finished = finish_linkage(drawn, result.drawing, result.trial, unit) if result.trial.score else None
        if finished is not None and (best is None or result.trial.score > best[1].score):
            best = finished, result.trial
        if best is not None and (best[1].full or not turning):
            break
    if best is None:
        return Realisation(mechanism=driven, linkage=None, ranges=(), full=False, quality=0.0, tries=tries, seed=seed)
    finished, trial = best
    return Realisation(
        mechanism=driven,
        linkage=finished.linkage,
        ranges=finished.ranges,
        full=trial.full,
        quality=finished.quality,
        tries=tries,
        seed=seed,
    )


def realise_all(
    mechanisms: Iterable[Mechanism],
    *,
    executor: Executor | Callable[[], Executor] | None = None,
    seed: int = 0,
    budget: int = 1500,
    target_quality: float = 0.5,
    unit: str = "mm",
) -> Iterator[Realisation]:
    """`realise` for each of several mechanisms, in their order.

    Args:
        mechanisms: taken as they are needed.
        executor: see `enumeration.worker_pool.run_work`; the results are the same with any.
        seed: as for `realise`; likewise the others.
        budget: see there.
        target_quality: see there.
        unit: see there.

    Raises as `realise`, during the iteration.

    >>> [each.full for each in realise_all([Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-0); drive=R(0-1)")])]
    [True]
    """
    search = partial(realise, seed=seed, budget=budget, target_quality=target_quality, unit=unit)
    return run_work(search, mechanisms, executor)


def with_drives(mechanism: Mechanism) -> Mechanism:
    """The mechanism with as many drives as its mobility: turning joints at the frame if possible, else any.

    If no choice of drives fixes the motion, it has the first ones.

    >>> with_drives(Mechanism.parse("P(0-1) R(1-2) R(2-3) R(3-0)")).drive_names()
    ('R(3-0)',)
    """
    chain, frame = mechanism.chain, mechanism.frame
    number = generic(chain).mobility
    freedoms = [
        Drive(k, direction, (first, other))
        for k, joint in enumerate(chain.joints)
        for direction in joint.pair.freedoms[chain.space]
        for first, other in combinations(joint.links, 2)
    ]
    if number < 1 or not freedoms:
        return mechanism
    freedoms.sort(key=lambda d: (frame not in d.between, not d.turning))
    trials = [Mechanism(chain, frame, chosen) for chosen in combinations(freedoms, number)]
    return next((m for m in trials if decompose(m).complete), trials[0] if trials else mechanism)


def _check(name: str, value: object, least: int) -> None:
    if isinstance(value, bool) or not isinstance(value, int) or not least <= value < 2**32:
        raise LinkageError(
            "{name} is a whole number of at least {least}, not {found!r}", name=name, least=least, found=value
        )
