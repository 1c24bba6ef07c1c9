"""What a synthesis returns: designs with their verdicts, and how complete the list is."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import degrees, isnan

import numpy as np

from gruebler.base.arrays import compared_by_value
from gruebler.base.errors import LinkageError, SynthesisError
from gruebler.base.notebook import brief, html_table, text_table
from gruebler.base.text import Message, joined, joined_by_and, message, number, plural, translate
from gruebler.design.synthesis.coordination import Minimax
from gruebler.design.synthesis.dead_centre_shifts import dead_centre_sensitivity
from gruebler.design.synthesis.sensitivity import Sensitivity, length_sensitivity
from gruebler.design.synthesis.target_orders import TargetOrder
from gruebler.design.synthesis.targets import Probe, Targets
from gruebler.design.synthesis.tasks import PathTask, PositionTask, Task, gives_lengths
from gruebler.mechanics.analysis.drive_cycles import drive_cycle
from gruebler.mechanics.analysis.outputs import find_output
from gruebler.mechanics.analysis.transmission import measure_transmission
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.chain.pairs import PAIRS, Alphabet, SymbolText, in_alphabets


@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class DesignVerdict:
    """What a design does when it moves. ``reasons`` is empty for an accepted design.

    Of a rejected one what was no longer asked is False or NaN.
    """

    assembles: bool = False
    """Whether it reaches every target of the task on some circuit of its own."""
    one_circuit: bool = False
    """Whether it reaches all targets without being taken apart."""
    one_branch: bool = False
    """Whether the drive carries it through all targets without turning back."""
    in_order: bool = False
    """Whether it meets the targets in the order of the task."""
    turns_fully: bool = False
    """Whether the drive turns fully; known of every linkage that was followed, whatever became of its targets."""
    transmission: float = float("nan")
    """The minimum transmission angle on the way through the targets, in radians; NaN where there is none."""
    size_ratio: float = float("nan")
    """The longest length of a link by the shortest."""
    inside: bool = True
    """Whether the fixed pivots lie in the region."""
    pivot_distance: float = float("nan")
    """How far the fixed pivots lie from those that are preferred: the root of the sum of squares; NaN without any."""
    error: float = float("nan")
    """The largest deviation from a target, relative to the size of the task."""
    over_interval: float = float("nan")
    """Of a function: the largest deviation over its whole interval, in radians or the unit of length."""
    between: float = float("nan")
    """Of a curve: how far its point lies from the line between two targets on the way, relative to the size."""
    reasons: tuple[Message, ...] = ()

    @property
    def accepted(self) -> bool:
        """Whether nothing speaks against it."""
        return not self.reasons

    @property
    def largest_error(self) -> float:
        """Over the interval of a function, else at the targets."""
        return self.error if isnan(self.over_interval) else self.over_interval

    def explain(self, lang: str = "en") -> str:
        """What it comes to, in English or German (``de``).

        >>> print(DesignVerdict(turns_fully=True, transmission=0.75, error=1e-12, size_ratio=2.5))
        Accepted. The drive turns fully. Smallest transmission angle on the way: 42.97°. Longest length by the shortest:
        2.5. Largest deviation: 1e-12 of the size of the task.
        """
        parts = [
            message("Accepted.") if self.accepted else message("Rejected: {reasons}", reasons=joined(self.reasons))
        ]
        if self.turns_fully:
            parts.append(message("The drive turns fully."))
        if not isnan(self.transmission):
            parts.append(_TRANSMISSION.filled(angle=degrees(self.transmission)))
        if not isnan(self.size_ratio):
            parts.append(message("Longest length by the shortest: {ratio:.4g}.", ratio=self.size_ratio))
        if not isnan(self.error):
            parts.append(message("Largest deviation: {error:.2g} of the size of the task.", error=self.error))
        return joined(parts, " ").in_language(lang)


PASSED = DesignVerdict(assembles=True, one_circuit=True, one_branch=True, in_order=True)
"""Of a linkage that passes all targets in order on one branch."""


_TRANSMISSION = message("Smallest transmission angle on the way: {angle:.4g}°.")
TOO_SLENDER = message("its lengths differ too much (ratio {ratio:.3g})")
Progress = Callable[[int, int], None]
"""Called with how much is done, and of how much."""
MOST_DESIGNS = 10_000
"""Of a family: more are no choice."""
FITTED = "fitted structure"
"""The form of a design whose structure is neither that of a four-bar nor of a slider-crank."""
_FORMS = {
    "four-bar": message("four-bar"),
    "slider-crank": message("slider-crank"),
    "inverted-slider-crank": message("inverted slider-crank"),
    "six-bar": message("six-bar"),
}


_PAIRS = {p.symbol(): p for p in PAIRS if p.is_basic}


def _symbol(letter: str, alphabet: Alphabet) -> str:
    """A letter of a form such as ``RR-PR`` in an alphabet."""
    return _PAIRS[letter].symbol(alphabet) if letter in _PAIRS else letter


def form_symbols(form: str) -> SymbolText:
    """A form such as ``RR-PR`` in the letters of the reader's language."""
    return in_alphabets(lambda alphabet: "".join(_symbol(letter, alphabet) for letter in form))


@brief
@dataclass(frozen=True, repr=False, kw_only=True)
class Design:
    """A linkage made for a task, with what it really does."""

    linkage: Linkage
    verdict: DesignVerdict
    form: str
    """The two connections of coupler and frame, such as ``RR-RR``, or the kind of linkage, such as ``four-bar``."""
    drives: tuple[float, ...] = ()
    """The drive value at each target; empty with several drives."""
    drive_rows: tuple[tuple[float, ...], ...] = ()
    """With several drives their values at each target."""
    optimum: Minimax | None = None
    """Of a function that is followed as well as possible: lengths, starts and largest error."""
    targets: Targets | None = field(default=None, compare=False)
    """What it was judged by; None of dead centres, which no drive value keeps."""
    reach: float | None = field(default=None, compare=False)
    """Of dead centres: the swing in radians, or the stroke."""

    def _repr_svg_(self) -> str | None:
        """The linkage to scale, for notebooks."""
        return self.linkage._repr_svg_()

    @property
    def links(self) -> int:
        """The number of links, the frame included."""
        return len(self.linkage.mechanism.chain.links)

    @cached_property
    def transmission_over_range(self) -> float:
        """The minimum transmission angle over the whole range of the drive, in radians; NaN where there is none.

        It is what `analyse` prints, and at most the one on the way through the targets. Cost: 70 ms, once.
        """
        try:
            return float(measure_transmission(drive_cycle(self.linkage), find_output(self.linkage, None)).smallest.mu)
        except LinkageError:
            return float("nan")

    @cached_property
    def sensitivity(self) -> Sensitivity | None:
        """How far each target moves per 0.1 % of each length while the drives keep their values at the targets.

        Of dead centres how far these move. None where the drives do not lead through the targets. Cost: 5 ms, once.
        """
        rows = self.drive_rows or tuple((value,) for value in self.drives)
        try:
            if self.reach is not None and len(self.drives) == 2:
                low, high = self.drives
                return dead_centre_sensitivity(self.linkage, find_output(self.linkage), (low, high), self.task_size)
            if self.targets is None or not rows:
                return None
            return length_sensitivity(self.linkage, self.targets.probes, np.array(rows))
        except (SynthesisError, np.linalg.LinAlgError):  # the latter: a drive that stands still while the linkage moves
            return None

    @property
    def relative_sensitivity(self) -> float:
        """How far the most sensitive target moves at most if every length is wrong by up to 0.1 %, by the task's size.

        Place and angle of a target count together as in its error; NaN where there is no sensitivity.
        """
        if (found := self.sensitivity) is None:
            return float("nan")
        free = False if self.targets is None else np.isnan(self.targets.values)
        moved = np.sqrt(np.sum(np.where(free, 0, found.worst) ** 2, axis=1))
        return float(moved.max() / self.task_size)

    @property
    def task_size(self) -> float:
        """The size by which deviations count; 1 where only angles are wanted."""
        if self.targets is not None:
            return self.targets.size
        return self.reach if self.reach is not None and not find_output(self.linkage).turning else 1.0

    @property
    def probes(self) -> tuple[Probe, ...]:
        """The quantities whose sensitivity is told; of dead centres reach and angle of the drive."""
        if self.targets is not None:
            return self.targets.probes
        output = find_output(self.linkage)
        reach = Probe(link=output.link) if output.joint is None else Probe(joint=output.joint)
        return reach, Probe(link=self.linkage.mechanism.drives[0].between[-1], length=self.task_size)

    def explain(self, lang: str = "en") -> str:
        """Its form, its mechanism and the verdict, a line each, in English or German (``de``)."""
        text = self.linkage.mechanism.text(Alphabet.of_language(lang))
        return "\n".join([self.form_in_language(lang), text, self.verdict.explain(lang)])

    def form_in_language(self, lang: str = "en") -> str:
        """The form in words, that of a fitted structure by its number of links."""
        if self.form == FITTED:
            return plural("{count} link", "{count} links", self.links, lang)
        if self.form in _FORMS:
            return _FORMS[self.form].in_language(lang)
        return form_symbols(self.form).in_language(lang)


EXACT = 1e-9
"""A target is met if it is missed by less than this part of the task's size."""


def _error(design: Design) -> float:
    """Errors of exact designs are rounding, which orders nothing."""
    error = design.verdict.largest_error
    return 0.0 if error < EXACT else error


NEAR_PIVOTS = "near-pivots"
"""The order of designs by the distance of their pivots from those that are preferred."""
ORDERS: Mapping[str, Callable[[Design], float]] = {
    "error": _error,
    "transmission": lambda design: -design.verdict.transmission,
    "range-transmission": lambda design: -design.transmission_over_range,
    "size": lambda design: design.linkage.size,
    "size-ratio": lambda design: design.verdict.size_ratio,
    "sensitivity": lambda design: design.relative_sensitivity,
    NEAR_PIVOTS: lambda design: design.verdict.pivot_distance,
    "links": lambda design: float(design.links),
    "full-turn": lambda design: float(not design.verdict.turns_fully),
}
"""What designs can be sorted by, the better first: the smaller value."""

MEASURES: Mapping[str, Message] = {
    "transmission": message("the transmission angle on the way"),
    "range-transmission": message("the transmission angle of the whole range"),
    "size": message("the size"),
    "size-ratio": message("the size ratio"),
    "sensitivity": message("the sensitivity to wrong lengths"),
    NEAR_PIVOTS: message("the distance from the preferred pivots"),
}
"""What the best of a family is sought by, in words."""
_RESOLUTION = message(
    "The best by {measure} are improved in steps down to {step:.1g} sizes of the task; that no other is better is not "
    "proved."
)
_SAMPLE_SORTED = message(
    "By {measure} the designs that were found are sorted only: the family between them was not searched by it."
)


def resolution(orders: Sequence[str], step: float, said: Message = _RESOLUTION) -> list[Message]:
    """How finely the best by what is asked for are sought, where nothing is proved of it.

    Args:
        orders: the names of `ORDERS` that are asked for.
        step: the last one.
        said: with measure and step.
    """
    measures = [MEASURES[name] for name in orders if name in MEASURES]
    return [said.filled(measure=joined_by_and(measures), step=step)] if measures else []


def sorted_sample(orders: Sequence[str]) -> list[Message]:
    """That designs are only sorted by what is asked for, where it is not sought."""
    measures = [MEASURES[name] for name in orders if name in MEASURES]
    return [_SAMPLE_SORTED.filled(measure=joined_by_and(measures))] if measures else []


def in_order_of(designs: Iterable[Design], orders: Iterable[str]) -> tuple[Design, ...]:
    """Designs sorted by the first order, equal ones by the next; what has no value comes last.

    Values that agree to nine digits are equal, since rounding tells such designs apart.

    Raises `SynthesisError` for an order that there is not.
    """
    orders = tuple(orders)
    for name in orders:
        if name not in ORDERS:
            raise SynthesisError(
                "designs are sorted by {orders}, not by {name!r}", orders=", ".join(ORDERS), name=str(name)[:40]
            )

    def place(design: Design) -> list[tuple[bool, float]]:
        values = [ORDERS[name](design) for name in orders]
        return [(isnan(value), 0.0 if isnan(value) else float(f"{value:.9g}")) for value in values]

    return tuple(sorted(designs, key=place))


@dataclass(frozen=True, kw_only=True)
class SolutionCount:
    """How many solutions there are."""

    what: Message
    """What is counted, such as dyads or cognate triples."""
    theorem: int | None
    """How many complex solutions a general task has; None where there are infinitely many, 0 where it is unknown."""
    found: int
    """How many of them were found, those at infinity among them."""
    real: int
    """How many of those are real."""
    infinite: int = 0
    """How many of those found lie at infinity: they are no linkages."""

    @property
    def finite(self) -> int:
        """How many of those found are linkages, real or complex."""
        return self.found - self.infinite

    @property
    def complete(self) -> bool:
        """Whether none is missing."""
        return self.theorem is not None and self.found >= self.theorem


@brief
@dataclass(frozen=True, repr=False, kw_only=True)
class SynthesisResult:
    """All designs for a task: accepted ones, best first, and rejected ones with their reasons."""

    task: Task
    designs: tuple[Design, ...]
    rejected: tuple[Design, ...]
    count: SolutionCount
    notes: tuple[Message, ...] = field(default=())
    """What else has to be known: solutions at infinity, missing ones, families of infinitely many."""

    def __len__(self) -> int:
        return len(self.designs)

    def __getitem__(self, number: int) -> Design:
        return self.designs[number]

    @property
    def remarks(self) -> tuple[Message, ...]:
        """The order that is asked, the notes, how many designs would be accepted if their lengths might differ more."""
        task = self.task
        ranks = task.order if isinstance(task, PositionTask | PathTask) else ()
        order = (TargetOrder.of(ranks, len(ranks)).remark,) if ranks else ()
        beyond = sum([reason.text for reason in each.verdict.reasons] == [TOO_SLENDER.text] for each in self.rejected)
        more = message("Designs rejected only because their lengths differ too much: {count}.", count=beyond)
        return (*order, *self.notes, *((more,) if beyond else ()))

    def sorted_by(self, *orders: str) -> SynthesisResult:
        """The same result with its designs, accepted and rejected, in another order: the names of `ORDERS`.

        >>> from gruebler.design.synthesis import DeadCentreTask, synthesise
        >>> found = synthesise(DeadCentreTask(stroke=50, time_ratio=1.2), number=4)
        >>> [round(design.linkage.size, 1) for design in found.sorted_by("size").designs][:3]
        [64.0, 113.0, 151.1]
        """
        return replace(self, designs=in_order_of(self.designs, orders), rejected=in_order_of(self.rejected, orders))

    def explain(self, lang: str = "en") -> str:
        """How many designs there are and what has to be known, then the first ones, in English or German (``de``).

        >>> from gruebler.design.synthesis import DeadCentreTask, synthesise
        >>> synthesise(DeadCentreTask(stroke=50, time_ratio=1.2), number=2).explain().splitlines()[0]
        'Designs: 2 accepted, 0 rejected.'
        """
        totals = {"accepted": len(self.designs), "rejected": len(self.rejected)}
        lines = [message("Designs: {accepted} accepted, {rejected} rejected.", **totals), *self.remarks]
        lines += [each.verdict.reasons[0] for each in self.rejected[:1] if not self.designs]
        table = [text_table(*self._rows(lang), len(self))] if self.designs else []
        return "\n".join([*(line.in_language(lang) for line in lines), *table])

    def _repr_html_(self) -> str:
        """The accepted designs, for notebooks."""
        return html_table(*self._rows(), len(self)) + f"<p>{len(self)} accepted, {len(self.rejected)} rejected</p>"

    def _rows(self, lang: str = "en") -> tuple[list[str], list[list[str]]]:
        """Headers and a row for each accepted design, the angle that on the way through the targets."""
        headers = (message("design"), message("full turn"), message("transmission angle"), message("error"))
        rows = [
            [
                str(k),
                each.form_in_language(lang),
                translate("yes" if each.verdict.turns_fully else "no", lang),
                "–"
                if isnan(each.verdict.transmission)
                else f"{number(degrees(each.verdict.transmission), lang, '.1f')}°",
                number(each.verdict.error, lang, ".2g"),
            ]
            for k, each in enumerate(self.designs)
        ]
        return ["", *(header.in_language(lang) for header in headers)], rows


@dataclass(frozen=True, kw_only=True)
class ParetoRow:
    """A design by what counts: the smaller error, size and number of links, the larger transmission angle."""

    structure: str
    error: float
    """Over the interval of a function, else at the targets."""
    transmission: float
    size: float
    """Its own; of a task of angles alone, which linkages of any size meet, the longest length by the shortest."""
    links: int
    pivot_distance: float
    """From the pivots that are preferred; NaN without any."""
    design: Design

    def dominates(self, other: ParetoRow) -> bool:
        """Whether it is nowhere worse and somewhere better, in the digits that are printed."""
        own, its = self._costs, other._costs
        return all(a <= b for a, b in zip(own, its, strict=True)) and own != its

    @property
    def _costs(self) -> tuple[float, ...]:
        mu = 0.0 if isnan(self.transmission) else self.transmission
        error = 0.0 if self.error < EXACT else self.error
        away = 0.0 if isnan(self.pivot_distance) else float(f"{self.pivot_distance:.3g}")
        return float(f"{error:.1e}"), -round(degrees(mu), 1), float(f"{self.size:.4g}"), float(self.links), away


def pareto(found: SynthesisResult) -> tuple[ParetoRow, ...]:
    """The accepted designs that no other one dominates, by error, transmission angle, size, number of links in turn.

    Where pivots are preferred, by the distance from them, too.
    """
    rows = [
        ParetoRow(
            structure=design.linkage.mechanism.text(),
            error=design.verdict.largest_error,
            transmission=design.verdict.transmission,
            size=design.linkage.size if gives_lengths(found.task) else design.verdict.size_ratio,
            links=design.links,
            pivot_distance=design.verdict.pivot_distance,
            design=design,
        )
        for design in found.designs
    ]
    best = [row for row in rows if not any(other.dominates(row) for other in rows)]
    once = {(row.structure, row._costs): row for row in reversed(best)}  # of those that are printed alike the first one
    return tuple(sorted(once.values(), key=lambda row: row._costs))


def ranked(candidates: Iterable[Design]) -> tuple[tuple[Design, ...], tuple[Design, ...]]:
    """Accepted designs, those with a full turn and the largest transmission angle first, and rejected ones."""
    usual = in_order_of(candidates, ("full-turn", "transmission", "size-ratio"))
    accepted = [design for design in usual if design.verdict.accepted]
    rejected = sorted((d for d in usual if not d.verdict.accepted), key=lambda design: len(design.verdict.reasons))
    return tuple(accepted), tuple(rejected)
