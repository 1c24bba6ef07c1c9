"""Task sheets: generated tasks with figures and space for answers; solutions with constructions; a marking key."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape
from itertools import cycle, islice
from pathlib import Path

from gruebler.base.errors import GrueblerError
from gruebler.base.text import joined, message, plural, translate
from gruebler.files import Exercise
from gruebler.files.catalog_records import source_text
from gruebler.pictures.canvas.construction import Construction
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.structure import draw_structure
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import Alphabet
from gruebler.teaching.constructions import construction
from gruebler.teaching.exercises import (
    KINDS,
    PartHeading,
    Result,
    Solution,
    TeachingTable,
    ascii_key,
    compare,
    exercise,
    generate,
    solve,
    value_text,
)
from gruebler.teaching.exercises.grading import key_in_language
from gruebler.teaching.exercises.messages import (
    asked_text,
    cells_of_table,
    check_text,
    printed_note,
    result_text,
    step_lines,
)
from gruebler.teaching.sheets.page import read_logo
from gruebler.teaching.worksheets.blocks import (
    AnswerLines,
    Block,
    Document,
    Heading,
    PageBreak,
    Paragraph,
    Pictures,
    Rows,
)
from gruebler.teaching.worksheets.exercise_figures import linkage_figure
from gruebler.teaching.worksheets.files import document_bytes
from gruebler.teaching.worksheets.moodle import Task, gift, moodle_xml
from gruebler.teaching.worksheets.solution_figures import SolutionFigure, solution_figures

_MOST = 60
_TRIES = 20  # seeds, for a task with other answers
_SPACE = {"mobility": 60.0, "grashof": 80.0, "dyad": 60.0}


@dataclass(frozen=True, slots=True, repr=False)
class TaskSheet:
    """A sheet with its tasks, and the sheet of their solutions with the marking key."""

    tasks: Document
    solutions: Document
    ids: tuple[str, ...]

    def __repr__(self) -> str:
        return f"<TaskSheet {', '.join(self.ids)}>"

    def _repr_html_(self) -> str:
        """The sheet in a frame, for notebooks."""
        page = escape(document_bytes(self.tasks, "html").decode("utf-8"))
        return f'<iframe srcdoc="{page}" sandbox style="width: 100%; height: 480px; border: 0"></iframe>'

    def moodle(self) -> bytes:
        """The tasks as questions of Moodle, marked there by the same rule (Moodle XML)."""
        return moodle_xml(self._questions(), self.tasks.lang)

    def gift(self) -> bytes:
        """The same questions as GIFT, a text format of Moodle that other programs read too; it has no units."""
        return gift(self._questions(), self.tasks.lang)

    def _questions(self) -> list[Task]:
        lang = self.tasks.lang
        exercises = [exercise(id) for id in self.ids]
        return [(each, _text(each, lang), exercise_figure(each, lang)) for each in exercises]


def worksheet(
    kinds: Sequence[str],
    count: int,
    *,
    level: int = 1,
    seed: int = 0,
    heading: str = "",
    logo: str | Path | None = None,
    lang: str = "en",
) -> TaskSheet:
    """So many tasks of the kinds in turn, with seeds from ``seed`` on; kinds may stand in the plural.

    No two tasks have the same answers as long as there are others. Seeds and ids stand on the solutions only. The
    heading is that of the tasks, such as the name of a course; ``logo`` is a PNG file for the heads of all pages.

    Cost: some tenths of a second a task. Raises `GrueblerError` for unknown kinds, levels and counts, and a logo that
    cannot be read.

    >>> worksheet(["grashof", "dead-centres"], 3, seed=7).ids
    ('grashof-1-7', 'dead-centre-1-8', 'grashof-1-9')
    """
    if not kinds:
        raise GrueblerError("expected at least one kind of task among {kinds}", kinds=", ".join(KINDS))
    kinds = [kind if kind in KINDS else kind.removesuffix("s") for kind in kinds]
    if not 1 <= count <= _MOST:
        raise GrueblerError("--count is a number from 1 to {most}, not {count}", most=_MOST, count=count)
    exercises = _distinct(list(islice(cycle(kinds), count)), level, seed)
    names = joined([KINDS[kind][0] for kind in dict.fromkeys(kinds)]).in_language(lang)
    title = heading or translate("Tasks: {kinds}", lang, kinds=names)
    subtitle = translate("level {level}, seed {seed}", lang, level=level, seed=seed)
    tasks = [block for k, each in enumerate(exercises, 1) for block in _task_blocks(each, k, lang)]
    name_line = translate("Name: {line}   Date: {short}", lang, line="_" * 34, short="_" * 14)
    solutions: list[Block] = []
    for k, each in enumerate(exercises, 1):
        solutions += _solution_blocks(each, k, lang)
    solutions += [PageBreak(), *_marking_key(exercises, lang)]
    own = None if logo is None else read_logo(logo)
    easy = translate("level {level}", lang, level=level)
    sheet = Document(title, (Paragraph(name_line), *tasks), subtitle=easy, lang=lang, logo=own)
    solved_title = translate("Solutions: {kinds}", lang, kinds=names)
    solved = Document(solved_title, tuple(solutions), subtitle=subtitle, lang=lang, logo=own)
    return TaskSheet(
        sheet.typeset(),
        solved.typeset(),
        tuple(each.id for each in exercises),
    )


def _distinct(kinds: Sequence[str], level: int, seed: int) -> list[Exercise]:
    """A task of each kind, whose answers no other one has if some seeds later there is such a task."""
    chosen: list[Exercise] = []
    answers = set()
    for kind in kinds:
        for _ in range(_TRIES):
            task = generate(kind, seed, level)
            seed += 1
            results = solve(task).results
            answer = (kind, *(str(results[question.key].value) for question in task.asked))
            if answer not in answers:
                break
        answers.add(answer)
        chosen.append(task)
    return chosen


# --- tasks -------------------------------------------------------------------------------------------


def _task_blocks(exercise: Exercise, number: int, lang: str) -> Iterator[Block]:
    solution = solve(exercise)
    yield Heading(translate("Task {number}", lang, number=number))
    yield Paragraph(_text(exercise, lang))
    figure = exercise_figure(exercise, lang)
    if figure is not None:
        yield Pictures((figure,), height=170.0)
    asked = [solution.results[question.key] for question in exercise.asked]
    names = tuple(_named(_symbol(solution, result, lang), asked_text(result, lang)) for result in asked)
    yield AnswerLines(names, _SPACE.get(_kind(exercise), 110.0))


def _kind(exercise: Exercise) -> str:
    return next(kind for kind in KINDS if exercise.id.startswith(f"{kind}-"))


def _text(exercise: Exercise, lang: str) -> str:
    """The task; where the chain is drawn, without the list of its joints."""
    if exercise.method != "mobility.chain":
        return exercise.task.in_language(lang)
    symbols = {joint.pair.symbol(Alphabet.of_language(lang)) for joint in _chain(exercise).joints}
    return translate(
        "Count the links and the joints ({symbols}) of the drawn chain, a joint of k links k - 1 times, and find its "
        "mobility F.",
        lang,
        symbols=", ".join(sorted(symbols)),
    )


def _chain(exercise: Exercise) -> Chain:
    return Chain.parse(str(exercise.given["chain"]))


def exercise_figure(exercise: Exercise, lang: str = "en", *, named: bool = False) -> Figure | None:
    """The figure of a task: the drawn chain, or the linkage to scale with the letters of its lengths; None without.

    Names of links would give away how many are to be counted: they stand there if they are ``named`` in the text too.

    >>> from gruebler.teaching.exercises import exercise
    >>> exercise_figure(exercise("mobility-1-7")).title
    "Watt's chain"
    """
    given = exercise.given
    if isinstance(given.get("chain"), str):
        # A dyad is put between named links.
        return draw_structure(_chain(exercise), labels=named or exercise.method != "mobility.chain", lang=lang)
    return linkage_figure(exercise, lang)


# --- solutions ---------------------------------------------------------------------------------------

_CONSTRUCTIONS = {
    "dead_centres.slider_crank": (("dead-centres", "slider-crank", "abe"),),
    "dead_centres.stroke_table": (("dead-centres", "slider-crank", "abe"),),
    "dead_centres.crank_rocker": (("dead-centres", "four-bar", "abcd"),),
    "dead_centres.central_crank_rocker": (("central-crank-rocker", "", "abc"),),
    "transmission_angle.slider_crank": (("transmission-angle", "slider-crank", "abe"),),
    "transmission_angle.four_bar": (("transmission-angle", "four-bar", "abcd"),),
    "velocities.slider_crank": (("accelerations", "slider-crank", "abe"),),
    "velocities.four_bar": (("accelerations", "four-bar", "abcd"),),
    "grashof.length_range": (("permissible-frame", "", "abc"),),
}
"""The construction that solves an exercise graphically: name, form, the given lengths that it takes."""


def construction_of(exercise: Exercise) -> Construction | None:
    """The graphical way of an exercise, with its quantities; None if there is none.

    >>> from gruebler.teaching.exercises import exercise
    >>> round(construction_of(exercise("12")).values["d"], 1)
    91.2
    """
    given = exercise.given
    for name, form, keys in _CONSTRUCTIONS.get(exercise.method or "", ()):
        values: dict[str, float | str] = {key: float(given[key]) for key in keys if key in given}
        if "e" in keys and "e" not in given:
            values["e"] = 0.0
        if "b" in keys and "b" not in given and "ratio" in given:
            values["b"] = float(given["a"]) / float(given["ratio"])
        if not {*keys} - {"e"} <= {*values}:
            continue
        values |= {key: float(given[key]) for key in ("phi", "omega") if key in given and name == "accelerations"}
        return construction(name, form, **values)
    return None


def solution_document(exercises: Sequence[Exercise], *, lang: str = "en") -> Document:
    """The solutions of exercises with figures, and with the constructions that give the same.

    >>> from gruebler.teaching.exercises import exercise
    >>> len([block for block in solution_document([exercise("12")]).blocks if isinstance(block, Pictures)])
    2
    """
    blocks = [block for each in exercises for block in _solution_blocks(each, 0, lang)]
    title = plural("Solution", "Solutions of {count} exercises", len(exercises), lang)
    return Document(title, tuple(blocks), lang=lang).typeset()


def _solution_blocks(exercise: Exercise, number: int, lang: str) -> Iterator[Block]:
    """A solution; its heading has the number of the task, or for the number 0 its name and where it stands in print."""
    solution = solve(exercise)
    heading = translate("Task {number}: {id}", lang, number=number, id=exercise.id)
    place = source_text(exercise.source, lang) if exercise.source else exercise.id
    yield Heading(heading if number else f"{exercise.name.in_language(lang)} ({place})")
    yield Paragraph(exercise.task.in_language(lang))
    if number == 0 and (figure := exercise_figure(exercise, lang)) is not None:
        yield Pictures((figure,), height=170.0)
    drawings = list(solution_figures(exercise, solution, lang))
    count = 0
    for before, part in enumerate(solution.parts):
        yield from _drawings_before(before, drawings)
        if isinstance(part, PartHeading):
            count = 0
            yield Heading(part.text.in_language(lang), 3)
        elif isinstance(part, TeachingTable):
            head, *rows = cells_of_table(part, lang)
            yield Paragraph(part.title.in_language(lang))
            yield Rows(tuple(head), tuple(map(tuple, rows)))
        else:
            count += 1
            yield Paragraph("\n".join(line.strip() for line in step_lines(part, count, lang)))
    yield from _drawings_before(len(solution.parts), drawings)
    if exercise.asked:
        yield _answers(exercise, solution, lang)
    if exercise.remark is not None:
        yield Paragraph(translate("Remark: {remark}", lang, remark=exercise.remark))
    if solution.checks:
        checks = (check_text(check, lang) for check in solution.checks)
        yield Paragraph("\n".join([translate("Check by a second method:", lang), *checks]))
    if number and isinstance(exercise.given.get("chain"), str):
        yield Pictures((draw_structure(_chain(exercise), labels=True, lang=lang),), height=170.0)
    whole = construction_of(exercise)
    if whole is not None:
        yield Pictures((whole.figures(lang, captions=False)[-1],), height=340.0)
        yield Paragraph("\n".join(f"{k}. {step.text.in_language(lang)}" for k, step in enumerate(whole.steps, 1)))


def _drawings_before(part: int, drawings: Sequence[SolutionFigure]) -> Iterator[Block]:
    """The drawings of one place, two side by side."""
    here = [drawing for drawing in drawings if drawing.before == part]
    for pair in (here[k : k + 2] for k in range(0, len(here), 2)):
        yield Pictures(tuple(each.figure for each in pair), tuple(each.caption for each in pair), height=200.0)


def _answers(exercise: Exercise, solution: Solution, lang: str) -> Rows:
    """The results, and beside them what the source prints where it prints anything."""
    comparisons = compare(exercise, solution)
    rows = tuple(
        (
            _named(_symbol(solution, each.result, lang), each.result.name.in_language(lang)),
            result_text(each.result, lang),
            printed_note(each, lang),
        )
        for each in comparisons
    )
    headers = (translate("answer", lang), translate("value", lang), translate("printed answer", lang))
    width = 3 if any(note for *_, note in rows) else 2
    return Rows(headers[:width], tuple(row[:width] for row in rows))


def _symbol(solution: Solution, result: Result, lang: str) -> str:
    """The name under which an answer is marked: its symbol, or its key where other results have the same symbol."""
    alone = sum(other.symbol == result.symbol for other in solution.results.values()) == 1
    return key_in_language(result.symbol if alone else ascii_key(result.key), lang)


def _named(symbol: str, name: str) -> str:
    """Symbol and name; the name alone where they are the same word.

    >>> _named("H", "stroke"), _named("type", "Type")
    ('H: stroke', 'Type')
    """
    return name if name.casefold() == symbol.casefold() else f"{symbol}: {name}"


def _marking_key(exercises: Sequence[Exercise], lang: str) -> Iterator[Block]:
    """What is right, and its points: one for each answer, one for each way."""
    rows, total = [], 0
    for k, task in enumerate(exercises, 1):
        solution = solve(task)
        for question in task.asked:
            result = solution.results[question.key]
            rows.append((str(k), _symbol(solution, result, lang), value_text(result.value, result.unit, lang), "1"))
        rows.append((str(k), translate("solution steps", lang), "", "1"))
        total += len(task.asked) + 1
    rows.append(("", translate("sum", lang), "", str(total)))
    yield Heading(translate("Marking key", lang), 1)
    rule = message(
        "A number is right within half a unit of its last digit or a thousandth, nearly right within two in a hundred "
        "unless the result is whole. "
        "gruebler exercise check ID KEY=ANSWER marks by the same rule."
    )
    yield Paragraph(rule.in_language(lang))
    headers = (message("task"), message("answer"), message("value"), message("points"))
    yield Rows(tuple(header.in_language(lang) for header in headers), tuple(rows))
    yield Paragraph(translate("Tasks: {ids}", lang, ids=", ".join(each.id for each in exercises)), small=True)
