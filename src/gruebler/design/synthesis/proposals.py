"""From a specification to machines: the types of mechanism that can do it, each made and judged, and the best of all.

docs/theory/synthesis-types.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor
from dataclasses import dataclass, replace

from gruebler.base.errors import SynthesisError
from gruebler.base.notebook import brief
from gruebler.base.text import Message, message
from gruebler.design.synthesis.clearances import stays_clear
from gruebler.design.synthesis.demands import WITHOUT, Demands
from gruebler.design.synthesis.fitting import links_moved_by_all, output_links
from gruebler.design.synthesis.given_lengths import missing_length
from gruebler.design.synthesis.paths import synthesise_path
from gruebler.design.synthesis.results import Design, ParetoRow, Progress, SolutionCount, SynthesisResult, pareto
from gruebler.design.synthesis.special_tasks import NoFourBarError
from gruebler.design.synthesis.specification import COMMON_LINKS, Specification
from gruebler.design.synthesis.structures import synthesise_structures, unheld_pivots
from gruebler.design.synthesis.synthesising import synthesise
from gruebler.design.synthesis.tasks import DwellTask, PathTask, output_travels
from gruebler.structure.mechanism import Mechanism
from gruebler.structure.mechanism.inversion import DrivenMechanism
from gruebler.structure.type_synthesis import JointRequirement, Requirements, variants

_FOUR, _MORE = 4, 2  # links of the mechanisms with methods of their own; starts of each of the others


@brief
@dataclass(frozen=True, repr=False, kw_only=True)
class TriedType:
    """A type of mechanism, and what came of it."""

    mechanism: Mechanism | None
    """None: all four-bars and slider-cranks, by the method that belongs to the task."""
    result: SynthesisResult
    """With the designs that meet task and demands and stay clear, best first."""

    @property
    def reason(self) -> Message | None:
        """Why there is no design: the tightest demand, else the first fault of the design with the fewest."""
        if self.result.designs:
            return None
        if (tight := next((note for note in self.result.notes if note.text == WITHOUT.text), None)) is not None:
            return tight
        closest = min(self.result.rejected, key=lambda design: len(design.verdict.reasons), default=None)
        return closest.verdict.reasons[0] if closest else next(iter(self.result.notes), None)


@brief
@dataclass(frozen=True, repr=False, kw_only=True)
class Proposals:
    """What was tried for a specification, and the designs that no other one beats."""

    specification: Specification
    tried: tuple[TriedType, ...]

    @property
    def designs(self) -> tuple[Design, ...]:
        """All accepted designs, type by type."""
        return tuple(design for each in self.tried for design in each.result.designs)

    @property
    def best(self) -> tuple[ParetoRow, ...]:
        """Those that none beats in error, transmission angle, size and number of links at once."""
        return pareto(self._all)

    @property
    def result(self) -> SynthesisResult:
        """The best ones as a result, to be drawn, printed or written like any other."""
        return replace(self._all, designs=tuple(row.design for row in self.best))

    @property
    def _all(self) -> SynthesisResult:
        rejected = tuple(design for each in self.tried for design in each.result.rejected)
        count = len(self.designs) + len(rejected)
        return SynthesisResult(
            task=self.specification.task,
            designs=self.designs,
            rejected=rejected,
            count=SolutionCount(what=message("linkages"), theorem=0, found=count, real=count),
        )


def candidate_types(specification: Specification) -> tuple[Mechanism, ...]:
    """The mechanisms of more than four links that can do it: driven at the frame, with an output of the right kind.

    A guided body has no joint at the frame; an output turns or slides at it. Each mechanism once, those with fewer
    sliding joints first; none of which no such link needs all others. A rest has six-bars of its own.

    >>> from gruebler.design.synthesis import DeadCentreTask
    >>> len(candidate_types(Specification(DeadCentreTask(swing=1.0, time_ratio=1.2))))
    5
    """
    task = specification.task
    if isinstance(task, DwellTask):
        return ()
    travels = output_travels(specification.task)
    place = "@moving" if specification.guides else "P@frame" if travels else "R@frame"
    types: dict[Mechanism, None] = {}
    for links in range(_FOUR + 2, specification.links + 1, 2):
        for slides in range(int(travels), specification.slides + 1):
            requirements = Requirements(
                links,
                prismatic=slides,
                drives=(JointRequirement.parse("R@frame"),),
                output=JointRequirement.parse(place),
            )
            driven = (each for each in variants(requirements) if isinstance(each, DrivenMechanism))
            types.update(dict.fromkeys(each.mechanism for each in driven))
    if isinstance(task, PathTask) and task.output_angles:
        return tuple(mechanism for mechanism in types if output_links(mechanism, travel=False))
    return tuple(mechanism for mechanism in types if _works_whole(mechanism, specification))


def _works_whole(mechanism: Mechanism, specification: Specification) -> bool:
    """Whether a link that may do the task needs all others: else a smaller mechanism does it, and the rest is idle."""
    whole = links_moved_by_all(mechanism)
    if not specification.guides:
        return any(link in whole for link in output_links(mechanism, output_travels(specification.task)))
    held = {link for joint in mechanism.chain.joints if mechanism.frame in joint.links for link in joint.links}
    return any(link not in held for link in whole)


def propose(
    specification: Specification,
    *,
    starts: int = _MORE,
    executor: Executor | Callable[[], Executor] | None = None,
    progress: Progress | None = None,
) -> Proposals:
    """Machines for a specification: every type that can do it is made for the task and judged by its motion.

    Args:
        specification: what is wanted, of which mechanisms.
        starts: how many initial designs of each mechanism of more than four links are improved.
        executor: see `enumeration.worker_pool.run_work`; the answer is the same with any.
        progress: called with the types done and their number.

    Returns:
        `Proposals`: what was tried with its reasons, all designs, and the ones that none beats.

    Raises:
        SynthesisError: a specification that contradicts itself.

    Cost:
        Four links: that of `synthesise`; more: 1 to 5 s for each start of each mechanism.

    Example:
        >>> from gruebler.design.synthesis import DeadCentreTask
        >>> proposals = propose(Specification(DeadCentreTask(swing=1.0, time_ratio=1.2), links=4))
        >>> [row.design.form for row in proposals.best][:1]
        ['four-bar']

    See Also:
        `synthesise`, `variants`

    Theory:
        docs/theory/synthesis-types.md
    """
    if starts < 1:
        raise SynthesisError("starts: expected at least 1, but found {count}", count=starts)
    types = candidate_types(specification)
    tried = []
    for mechanism, result in _made(specification, types, starts, executor):
        tried.append(TriedType(mechanism=mechanism, result=_kept_clear(result, specification)))
        if progress is not None:
            progress(len(tried), 1 + len(types))
    return Proposals(specification=specification, tried=tuple(tried))


def _made(
    specification: Specification,
    types: Iterable[Mechanism],
    starts: int,
    executor: Executor | Callable[[], Executor] | None,
) -> Iterator[tuple[Mechanism | None, SynthesisResult]]:
    task, demands = specification.task, specification.demands
    none = SolutionCount(what=message("linkages"), theorem=0, found=0, real=0)
    try:
        if isinstance(task, PathTask):
            sliders = specification.slides > 0
            four_links = synthesise_path(task, demands, sliders=sliders, sort=demands.orders(()))
        else:
            four_links = synthesise(task, demands=demands)
    except NoFourBarError as error:
        reason = Message(error.text, error.values)
        four_links = SynthesisResult(task=task, designs=(), rejected=(), count=none, notes=(reason,))
    yield None, _with_so_many_slides(four_links, specification)
    for mechanism in types:
        own = _by_own_names(demands, mechanism)
        unheld = unheld_pivots(task) or missing_length(mechanism, own)
        yield (
            mechanism,
            synthesise_structures(task, [mechanism], own, starts=starts, executor=executor)
            if unheld is None
            else SynthesisResult(task=task, designs=(), rejected=(), count=none, notes=(unheld,)),
        )


def _by_own_names(demands: Demands, mechanism: Mechanism) -> Demands:
    """The demands with the lengths of crank and frame by the names of a mechanism that is driven at its frame."""
    crank = next(link for link in mechanism.drives[0].between if link != mechanism.frame)
    names = dict(zip(COMMON_LINKS, (crank, mechanism.frame), strict=True))
    return replace(demands, lengths=tuple((names[link], length) for link, length in demands.lengths))


def _with_so_many_slides(result: SynthesisResult, specification: Specification) -> SynthesisResult:
    """Without the designs that have more sliding joints than are allowed."""

    def allowed(design: Design) -> bool:
        joints = design.linkage.mechanism.chain.joints
        return sum(joint.pair.is_sliding for joint in joints) <= specification.slides

    return replace(
        result, designs=tuple(filter(allowed, result.designs)), rejected=tuple(filter(allowed, result.rejected))
    )


def _kept_clear(result: SynthesisResult, specification: Specification) -> SynthesisResult:
    """The designs whose body touches nothing on its way; the others are rejected for it."""
    clear, touching = [], []
    for design in result.designs:
        hit = next((k for k, each in enumerate(specification.clear, 1) if not stays_clear(design, each)), None)
        if hit is None:
            clear.append(design)
            continue
        reason = message("the body comes too near to obstacle {number}", number=hit)
        touching.append(replace(design, verdict=replace(design.verdict, reasons=(reason,))))
    return replace(result, designs=tuple(clear), rejected=(*touching, *result.rejected))
