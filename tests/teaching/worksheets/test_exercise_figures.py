"""The figure of an exercise is the linkage of its text: moved, it gives the table of the solution."""

import re

import numpy as np
import pytest

from gruebler.mechanics.kinematics import move
from gruebler.pictures.canvas.shapes import CircleShape, Polylines, TextShape
from gruebler.teaching.exercises import exercise, solve
from gruebler.teaching.sheets.page import PlacedPicture, TextLine
from gruebler.teaching.worksheets.blocks import Document, Heading, Paragraph, Pictures, Rows
from gruebler.teaching.worksheets.exercise_figures import exercise_linkage
from gruebler.teaching.worksheets.files import document_bytes
from gruebler.teaching.worksheets.paged import document_pages
from gruebler.teaching.worksheets.solution_figures import solution_figures
from gruebler.teaching.worksheets.tasks import exercise_figure, solution_document


def points_of(shape):
    if isinstance(shape, Polylines):
        return [point for part in shape.parts for point in part]
    return [shape.at] if isinstance(shape, TextShape | CircleShape) else []


@pytest.mark.parametrize("id", ["grashof-1-1", "grashof-1-7", "dead-centre-3-1", "velocity-3-1"])
def test_the_frame_is_a_line_between_its_pivots_with_its_letter(id):
    """As long as d to the scale of crank a, which is drawn from pin to pin; its letter is nearest to it."""
    given, figure = exercise(id).given, exercise_figure(exercise(id))
    (line,) = [shape for shape in figure.shapes if isinstance(shape, Polylines) and shape.style == "measure"]
    first, last = line.parts[0]
    pins = [shape.at for shape in figure.shapes if isinstance(shape, CircleShape) and shape.style == "joint"]
    assert all(any(pin.minus(end).length < 0.01 for pin in pins) for end in (first, last))
    crank = float(given["a"]) / float(given["d"]) * last.minus(first).length
    assert any(abs(pin.minus(first).length - crank) < 0.01 * crank for pin in pins)
    (letter,) = [shape for shape in figure.shapes if isinstance(shape, TextShape) and shape.text == "d"]
    assert min(first.x, last.x) < letter.at.x < max(first.x, last.x)
    assert abs(letter.at.y - first.y) < 25


@pytest.mark.parametrize("id", ["universal-joint-1-1", "universal-joint-2-2", "universal-joint-3-1"])
@pytest.mark.parametrize("lang", ["en", "de"])
def test_a_universal_joint_has_its_angle_and_its_speeds(id, lang):
    """Four letters R of its joints stood there, and not what the task gives and asks for."""
    shapes = exercise_figure(exercise(id), lang).shapes
    letters = [shape for shape in shapes if isinstance(shape, TextShape)]
    drawn = [point for shape in shapes if not isinstance(shape, TextShape) for point in points_of(shape)]
    assert [shape.text for shape in letters] == ["β", "n₁", "n₂"]
    assert all(min(point.minus(letter.at).length for point in drawn) < 25 for letter in letters)


def test_the_frame_of_a_spherical_four_bar_is_an_arc_with_its_letter():
    shapes = exercise_figure(exercise("spherical-grashof-3-1")).shapes
    (arc,) = [shape for shape in shapes if isinstance(shape, Polylines) and shape.style == "measure"]
    (letter,) = [shape for shape in shapes if isinstance(shape, TextShape) and shape.text == "d"]
    (points,) = arc.parts
    middle = points[len(points) // 2]
    assert middle.minus(letter.at).length < 40


WITH_PATHS = ["exercise-16", "exercise-17", "exercise-18", "exercise-19", "exercise-20", "example-3.5.4-lambda",
              "example-3.5.4-scott-russell"]  # fmt: skip


@pytest.mark.parametrize("id", WITH_PATHS)
def test_the_drawn_linkage_gives_the_table_of_the_solution(id):
    drawn, table = exercise_linkage(exercise(id)), solve(exercise(id)).tables[0]
    rows = np.array([[float(value) for value in row] for row in table.rows])
    motion = move(drawn.linkage, np.radians(rows[:, 0]))
    assert motion.complete, motion.message()
    names = [re.fullmatch(r"(\w+)_x", str(column)) for column in table.headers]
    places = {found[1]: k for k, found in enumerate(names) if found}
    compared = {*places} & {*drawn.linkage.points}
    assert compared >= set(drawn.curves)
    for name in compared:
        wanted = rows[:, places[name]] + 1j * rows[:, places[name] + 1]
        assert abs(motion.complex_point(name) - wanted).max() < 1e-9 * drawn.linkage.size, name


def test_exercise_19_draws_the_lengths_of_its_text():
    """Coupler a, rockers b and d, frame c; C on the line A-D with AC = 60: 000/003, exercise 19."""
    drawn = exercise_linkage(exercise("19"))
    linkage = drawn.linkage
    letters = {drawn.letters[link]: link for link in linkage.mechanism.chain.links}
    for letter, length in {"a": 30, "b": 80, "c": 60, "d": 100}.items():
        joints = [k for k, joint in enumerate(linkage.mechanism.chain.joints) if letters[letter] in joint.links]
        assert linkage.length(letters[letter], *joints) == pytest.approx(length)
    a, c, d = (linkage.points[name] for name in "ACD")
    assert np.hypot(c.x - a.x, c.y - a.y) == pytest.approx(60)
    assert np.hypot(d.x - a.x, d.y - a.y) == pytest.approx(30)
    assert linkage.mechanism.drive_names() == ("R(frame-first)",)
    words = [shape.text for shape in exercise_figure(exercise("19")).shapes if hasattr(shape, "text")]
    assert sorted(words) == ["A", "C", "D", "a", "b", "c", "d"]


@pytest.mark.parametrize(
    ("id", "count"), [("1", 1), ("2", 1), ("15", 1), ("3", 2), ("4", 1), ("5", 5), ("5b", 1), ("6", 1)]
)
def test_solutions_contain_the_drawings_asked_for(id, count):
    task = exercise(id)
    drawn = list(solution_figures(task, solve(task)))
    assert len(drawn) == count
    assert len({each.caption for each in drawn}) == count
    pictures = [block for block in solution_document([task]).blocks if isinstance(block, Pictures)]
    assert {each.figure.title for each in drawn} <= {figure.title for each in pictures for figure in each.figures}


@pytest.mark.parametrize(("suffix", "mark"), [("html", "<svg"), ("md", "!["), ("tex", r"\begin{tikzpicture}")])
def test_each_machine_is_drawn_beside_its_own_count(suffix, mark):
    """In exercise 5 drawings and counts of links take turns."""
    text = document_bytes(solution_document([exercise("5")]), suffix).decode("utf-8")
    assert re.findall(f"{re.escape(mark)}|1. Links: ", text) == 5 * [mark, "1. Links: "]


@pytest.mark.parametrize("id", ["5", "5b", "6"])
def test_the_drawing_stands_below_its_heading_on_the_page(id):
    document = solution_document([exercise(id)])
    level = 3 if id == "5" else 2
    headings = [block.text for block in document.blocks if isinstance(block, Heading) and block.level == level]
    pages = document_pages(document)
    for text in headings:
        ((page, y),) = (
            (page, item.y)
            for page in pages
            for item in page.items
            if isinstance(item, TextLine) and item.bold and item.text == text
        )
        assert any(0 < item.y - y < 80 for item in page.items if isinstance(item, PlacedPicture)), text


def test_a_title_stays_with_its_table():
    """However many lines stand before them."""
    for before in range(40):
        filling = tuple(Paragraph(f"line {k}") for k in range(before))
        document = Document("a", (*filling, Paragraph("the title"), Rows(("letter",), (("a",), ("b",)))))
        for page in document_pages(document):
            texts = [item.text for item in page.items if isinstance(item, TextLine)]
            assert ("the title" in texts) == ("letter" in texts)


@pytest.mark.parametrize("id", ["2", "15"])
def test_the_plotted_stroke_is_that_of_the_table(id):
    """Each dot of the plot lies on the drawn line: rows by trigonometry, the line by complex numbers."""
    (drawn,) = solution_figures(exercise(id), solve(exercise(id)))
    figure = drawn.figure
    (line,) = (shape for shape in figure.shapes if shape.style == "line-1")
    dots = [shape.at for shape in figure.shapes if shape.style == "dot"]
    assert len(dots) == 13
    places = np.array([complex(*point) for part in line.parts for point in part])
    for dot in dots:
        assert abs(np.interp(dot.x, places.real, places.imag) - dot.y) < 0.3  # pixels


def test_the_eccentricity_of_scott_russell_is_none():
    """There e is the length beyond A, and the slide passes through A0."""
    linkage = exercise_linkage(exercise("3.5.4-scott-russell")).linkage
    assert linkage.length("crank", 0, 1) == linkage.length("coupler", 1, 2) == 1
    assert move(linkage, [1.0]).point("C")[0] == pytest.approx([0, 2 * np.sin(1.0)], abs=1e-12)
