"""Task sheets, collection sheets, the book and posters: what they show is what the library computes."""

import base64
import re
import shutil
import subprocess
from html import unescape
from pathlib import Path
from xml.etree import ElementTree

import pytest

from gruebler import FourBar
from gruebler.base.errors import GrueblerError
from gruebler.cli import main
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.shapes import TextShape
from gruebler.structure.assur import assur_groups
from gruebler.structure.chain.pairs import PAIRS
from gruebler.structure.chain.spaces import Space
from gruebler.structure.enumeration import count_chains
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entries
from gruebler.teaching.exercises import KINDS, exercise, grade, solve
from gruebler.teaching.sheets.page import HorizontalRule, PlacedLogo, PlacedPicture, TextLine
from gruebler.teaching.worksheets import (
    catalog_book,
    document_bytes,
    machine_document,
    poster,
    solution_document,
    worksheet,
)
from gruebler.teaching.worksheets.blocks import AnswerLines, Contents, Document, Heading, Paragraph, Pictures, Rows
from gruebler.teaching.worksheets.joint_pictures import joint_pictures
from gruebler.teaching.worksheets.paged import document_pages
from gruebler.teaching.worksheets.tasks import construction_of, exercise_figure

ROOT = Path(__file__).parents[3]


@pytest.fixture(scope="module")
def sheet():
    return worksheet(list(KINDS), len(KINDS), level=2, seed=7, lang="de")


def blocks_of(document, kind):
    return [block for block in document.blocks if isinstance(block, kind)]


def test_one_task_of_each_kind(sheet):
    assert sheet.ids == tuple(f"{kind}-2-{7 + k}" for k, kind in enumerate(KINDS))
    assert len(blocks_of(sheet.tasks, AnswerLines)) == len(KINDS)
    figures = [exercise_figure(exercise(id)) for id in sheet.ids]
    assert len(blocks_of(sheet.tasks, Pictures)) == sum(figure is not None for figure in figures) == len(KINDS)


def test_answers_are_marked_by_the_names_that_are_printed(sheet):
    for id, lines in zip(sheet.ids, blocks_of(sheet.tasks, AnswerLines), strict=True):
        task = exercise(id)
        names = [text.partition(":")[0] for text in lines.asked]
        results = [solve(task).results[question.key] for question in task.asked]
        answers = {
            name: "yes" if result.value is True else "no" if result.value is False else str(result.value)
            for name, result in zip(names, results, strict=True)
        }
        assert [each.mark.value for each in grade(task, answers)] == ["right"] * len(names), id


def test_no_two_tasks_have_the_same_answers_and_ids_stand_on_the_solutions():
    chosen = worksheet(["mobility"], 5, seed=7, heading="Getriebelehre 1")
    answers = [tuple(str(result.value) for result in solve(exercise(id)).results.values()) for id in chosen.ids]
    assert len(set(answers)) == 5  # as many as level 1 has
    text, solved = (document_bytes(each, "md").decode("utf-8") for each in (chosen.tasks, chosen.solutions))
    assert "Getriebelehre 1" in text
    assert chosen.ids[0] not in text
    assert "seed" not in text
    assert all(id in solved for id in chosen.ids)
    assert "seed 7" in solved


def test_a_logo_stands_on_every_page_and_in_every_format(tmp_path, capsys):
    """A PNG that matplotlib writes, 60 by 20 pixels; at most 26 high in the head, never across the line below it."""
    pytest.importorskip("matplotlib.image").imsave(tmp_path / "own.png", [[[0.0, 0.3, 0.6]] * 60] * 20)
    chosen = worksheet(["mobility"], 3, seed=7, logo=tmp_path / "own.png")
    for document in (chosen.tasks, chosen.solutions):
        for page in document_pages(document):
            (logo,) = (item for item in page.items if isinstance(item, PlacedLogo))
            rule = min(item.y for item in page.items if isinstance(item, HorizontalRule))
            assert (logo.width, logo.height) == pytest.approx((78, 26))
            assert logo.y + logo.height < rule
            assert ElementTree.fromstring(page.svg()).find("{http://www.w3.org/2000/svg}image") is not None
    data = base64.b64encode((tmp_path / "own.png").read_bytes()).decode("ascii")
    assert all(data in document_bytes(chosen.tasks, ending).decode("utf-8") for ending in ("html", "md"))
    assert r"\includegraphics[height=10mm]{own.png}" in document_bytes(chosen.tasks, "tex").decode("utf-8")
    assert document_bytes(chosen.tasks, "pdf").count(b"/Subtype /Image") >= 1
    (tmp_path / "own.svg").write_text("<svg/>", encoding="utf-8")
    sheet_of = ["exercise", "sheet", "--kind", "mobility", "-o", str(tmp_path / "x.md"), "--logo"]
    assert main([*sheet_of, str(tmp_path / "own.svg")]) == 2
    assert "own.svg: expected a logo as a PNG picture" in capsys.readouterr().err
    assert main([*sheet_of, str(tmp_path / "none.png")]) == 2
    assert "cannot be read" in capsys.readouterr().err


def test_a_picture_that_nearly_fits_is_made_smaller_but_stays_legible():
    """Half a page is full; a picture a little too high for the rest stands there, one far too high begins a page."""
    lines = (Paragraph("line\n" * 30),)

    def pages(height):
        picture = Pictures((Figure((), width=500, height=height, title="", description=""),), height=height)
        return [
            [(k, item.scale) for item in page.items if isinstance(item, PlacedPicture)]
            for k, page in enumerate(document_pages(Document("x", (*lines, picture))))
        ]

    assert pages(400)[0] == [(0, 1.0)]
    (little,) = pages(500)
    assert 0.62 < little[0][1] < 1.0
    assert pages(900)[0] == []


def test_moodle_marks_as_grade_does(sheet):
    """The elements that Moodle documents; each answer there has the mark that `grade` gives it."""
    quiz = ElementTree.fromstring(sheet.moodle())
    assert quiz.tag == "quiz"
    asked = [(exercise(id), question.key) for id in sheet.ids for question in exercise(id).asked]
    questions = quiz.findall("question")
    assert len(questions) == len(asked)
    for question, (task, key) in zip(questions, asked, strict=True):
        assert question.findtext("name/text").startswith(task.id)
        body = question.findtext("questiontext/text")
        files = question.findall("questiontext/file")
        assert len(files) == body.count("@@PLUGINFILE@@/figure.svg") == (exercise_figure(task) is not None)
        assert all(base64.b64decode(file.text).startswith(b"<svg") for file in files)
        assert not any(b"Glieder" in base64.b64decode(file.text) for file in files)  # nothing gives the answer away
        assert question.get("type") in {"numerical", "truefalse", "shortanswer"}
        # What import_numerical of Moodle's question/format/xml/format.php takes as default: a unit may be given (0)
        # where there is one, else there is none (3). With 3 an answer such as "130 mm" is no number.
        shown = {True: "0", False: "3"}[question.find("units/unit") is not None]
        assert question.findtext("showunits") == (shown if question.get("type") == "numerical" else None)
        for answer in question.findall("answer"):
            text, fraction = answer.findtext("text"), answer.get("fraction")
            if question.get("type") == "numerical" and fraction == "50":
                text = repr(float(text) + 0.6 * float(answer.findtext("tolerance")))
            word = {"true": "yes", "false": "no"}.get(text, text)
            (graded,) = grade(task, {key: word})
            assert graded.mark.value == {"100": "right", "50": "near", "0": "wrong"}[fraction], (task.id, key, text)


def test_gift_says_what_the_xml_says(sheet):
    """By the rules of the format: a backslash protects a sign, `=%marks%answer:tolerance#feedback` is an answer."""
    quiz = ElementTree.fromstring(sheet.moodle()).findall("question")
    questions = re.findall(
        r"::((?:[^\\:]|\\.)*)::\[html\]((?:[^\\{]|\\.)*)\{((?:[^\\}]|\\.)*)\}", sheet.gift().decode("utf-8")
    )
    assert len(questions) == len(quiz)

    def plain(text):
        return re.sub(r"\\(.)", r"\1", text)

    for (name, text, answers), question in zip(questions, quiz, strict=True):
        assert plain(name) == question.findtext("name/text")
        image = re.search(r"base64,([^\"]*)", plain(text))
        file = question.find("questiontext/file")
        assert (image and image[1]) == (file if file is None else file.text)
        expected = [
            (
                a.get("fraction"),
                a.findtext("text"),
                a.findtext("tolerance") or "",
                unescape(a.findtext("feedback/text") or ""),
            )
            for a in question.findall("answer")
        ]
        if question.get("type") == "truefalse":
            assert (answers.lower(), "100") in {(word, fraction) for fraction, word, *_ in expected}
            continue
        assert answers.startswith("#") == (question.get("type") == "numerical")
        found = re.findall(r"=%(\d+)%((?:[^\\:#\n]|\\.)*):?([^#\n]*)#?(.*)", answers)
        assert [
            (fraction, plain(word), tolerance, plain(hint)) for fraction, word, tolerance, hint in found
        ] == expected


def test_an_underscore_may_be_left_out():
    assert [each.mark.value for each in grade(exercise("dead-centre-1-7"), {"la": "130"})] == ["right"]  # b + a = 130


def test_a_task_of_mobility_shows_the_chain_and_not_its_joints(sheet):
    text = document_bytes(sheet.tasks, "md").decode("utf-8")
    chain = str(exercise(sheet.ids[0]).given["chain"])
    assert chain.split(maxsplit=1)[0] not in text
    assert "gezeichneten" in text or "drawn" in text
    labels = [s for s in exercise_figure(exercise(sheet.ids[0])).shapes if isinstance(s, TextShape)]
    assert labels == []  # names would give the number of links away


def test_the_marking_key_has_every_answer(sheet):
    key = blocks_of(sheet.solutions, Rows)[-1]
    asked = sum(len(exercise(id).asked) for id in sheet.ids)
    assert len(key.rows) == asked + len(KINDS) + 1  # and the way of each, and the sum
    assert key.rows[-1][-1] == str(asked + len(KINDS))


@pytest.mark.parametrize(("lang", "word", "other"), [("en", "good", "gut"), ("de", "gut", "good")])
def test_the_marking_key_names_answers_in_the_language(lang, word, other):
    sheet = worksheet(["transmission-angle"], 1, level=3, seed=1, lang=lang)
    names = {row[1] for row in blocks_of(sheet.solutions, Rows)[-1].rows}
    assert word in names
    assert other not in names


@pytest.mark.parametrize(("name", "answer"), [("good", "yes"), ("gut", "ja")])
def test_an_answer_is_marked_by_its_name_in_either_language(name, answer):
    task = exercise("transmission-angle-3-1")
    (mark,) = grade(task, {name: answer})
    assert mark.mark.value == ("right" if solve(task).results["good"].value else "wrong")


def test_constructions_give_the_results_of_the_solutions():
    for seed in range(2):
        for level in (1, 2, 3):
            for kind, key, value in (
                ("dead-centre", "H" if level < 3 else "φ_max", "stroke" if level < 3 else "phi_max"),
                ("transmission-angle", "μ_min", "mu_min"),
                ("velocity", "v_B", "v_B"),
            ):
                task = exercise(f"{kind}-{level}-{seed}")
                measured = construction_of(task).values[value]
                assert measured == pytest.approx(abs(solve(task).number(key)), rel=1e-6), task.id
    assert construction_of(exercise("12")).values["d"] == pytest.approx(solve(exercise("12")).number("d"))
    assert construction_of(exercise("8")).values["d_max"] == pytest.approx(solve(exercise("8")).number("d_max"))
    assert construction_of(exercise("15")).values["stroke"] == pytest.approx(solve(exercise("15")).number("H"))
    assert construction_of(exercise("6")) is None


@pytest.mark.parametrize("suffix", ["pdf", "html", "tex", "md"])
def test_files(sheet, suffix):
    content = document_bytes(sheet.solutions, suffix)
    if suffix == "pdf":
        assert content.startswith(b"%PDF")
        assert content.count(b"/Type /Page\n") + content.count(b"/Type /Page ") == len(document_pages(sheet.solutions))
        return
    text = content.decode("utf-8")
    for id in sheet.ids:
        assert id.replace("_", r"\_") in text if suffix == "tex" else id in text
    pictures = sum(len(block.figures) for block in blocks_of(sheet.solutions, Pictures))
    if suffix == "html":
        assert text.count("<svg") == pictures
        assert "https://" not in text
    if suffix == "tex":
        assert text.count(r"\begin{tikzpicture}") == text.count(r"\end{tikzpicture}") == pictures
        assert text.count("{") == text.count("}")
        assert all(ord(sign) < 0x250 for sign in text), {sign for sign in text if ord(sign) >= 0x250}
    if suffix == "md":
        inside = re.findall(r"data:image/svg\+xml;base64,([\w+/=]+)\)", text)
        assert len(inside) == pictures
        assert all(base64.b64decode(data).startswith(b"<svg") for data in inside)


def test_latex_knows_every_sign_of_the_texts():
    """All signs of messages, of catalogs and of the code are letters that LaTeX takes, or have a command."""
    signs = set()
    for pattern in ("src/gruebler/**/*.py", "src/gruebler/base/locale/**/*.po", "catalogs/**/*.toml"):
        for path in ROOT.glob(pattern):
            signs |= set(path.read_text(encoding="utf-8"))
    written = document_bytes(Document("x", (Paragraph("".join(sorted(signs - {"_", chr(10)}))),)), "tex").decode()
    known = set("–—„“”‚‘’" + "".join(chr(k) for k in range(0xC0, 0x180)))  # letters and quotation marks of T1
    assert {sign for sign in written if ord(sign) > 0x7E} <= known


@pytest.mark.slow
@pytest.mark.parametrize("lang", ["en", "de"])
def test_latex_files_compile(lang, tmp_path):
    if shutil.which("pdflatex") is None:
        pytest.skip("pdflatex is not here")
    sheets = [worksheet(list(KINDS), len(KINDS), level=level, seed=3, lang=lang) for level in (1, 2, 3)]
    made = [
        *((sheet.tasks, sheet.solutions) for sheet in sheets),
        (machine_document(entries()["crankrocker"], lang=lang), machine_document(entries()["geartrain"], lang=lang)),
    ]
    for k, document in enumerate(document for pair in made for document in pair):
        (tmp_path / f"{k}.tex").write_bytes(document_bytes(document, "tex"))
        command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", f"{k}.tex"]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, timeout=300, check=False)
        log = done.stdout.decode("utf-8", "replace")
        assert done.returncode == 0, log[-2000:]
        assert "Missing character" not in log


def test_nothing_leaves_the_page(sheet):
    for document in (sheet.tasks, sheet.solutions):
        for page in document_pages(document):
            assert all(0 < item.y < 1122.5 for item in page.items)
            bottoms = [item.y + item.scale * item.figure.height for item in page.items if hasattr(item, "figure")]
            assert all(bottom < 1122.5 - 50 for bottom in bottoms)


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ((["gear"], 2), "the kinds of fresh tasks"),
        (([], 2), "at least one kind"),
        ((["dyad"], 0), "--count is a number"),
    ],
)
def test_wrong_sheets(arguments, says):
    with pytest.raises(GrueblerError, match=says):
        worksheet(*arguments)


def test_the_sheet_of_any_machine():
    document = machine_document(FourBar(25, 70, 40, 70).linkage({"K": (45, 40)}), lang="de")
    (lengths,) = [rows for rows in blocks_of(document, Rows) if rows.headers[-1] in ("Abstand", "distance")]
    distances = [float(row[-1].replace(",", ".")) for row in lengths.rows]
    assert distances[:4] == pytest.approx([70, 25, 70, 60.2080], abs=1e-4)
    structure = blocks_of(document, Pictures)[0].figures[1]
    texts = [shape.text for shape in structure.shapes if isinstance(shape, TextShape)]
    assert texts.count("D") == 4  # the letters of sheet 001
    assert any(shape.style == "velocity-head" for shape in machine_structure("crankrocker").shapes)
    bare = machine_document(Mechanism.parse("R(0-1) R(1-2) R(2-3) P(3-0); frame=0; drive=R(0-1)"))
    assert len(blocks_of(bare, Pictures)) == 1


def machine_structure(id):
    return blocks_of(machine_document(entries()[id]), Pictures)[0].figures[1]


def test_the_book_lists_every_machine_and_feature():
    book = catalog_book(ids=["quad", "crankrocker", "cam"])
    (contents,), index = blocks_of(book, Contents), blocks_of(book, Rows)[-1]
    assert [row[0] for row in contents.rows] == ["quad", "crankrocker", "cam"]
    found = {(row[0], row[1]): row[2] for row in index.rows}
    assert found["links", "4"] == "quad, crankrocker"
    assert found["joint", "roll slide"] == "cam"
    assert sum(block.level == 1 for block in blocks_of(book, Heading)) == 5


def test_the_contents_of_the_book_name_the_pages():
    """The number beside a machine is that of the page on which its name stands as a heading."""
    book = catalog_book(ids=["quad", "crankrocker", "cam"])
    (contents,) = blocks_of(book, Contents)
    pages = document_pages(book)
    lines = [[item for item in page.items if isinstance(item, TextLine)] for page in pages]
    for key, name, _ in contents.rows:
        (heading,) = (k for k, page in enumerate(lines, 1) if any(line.text == name and line.bold for line in page))
        (row,) = (line.y for line in lines[0] if line.text == key)
        assert str(heading) in [line.text for line in lines[0] if line.y == row]
    assert document_bytes(book, "html").decode("utf-8").count('<a href="#quad">quad</a>') == 1
    assert '<h2 id="quad">' in document_bytes(book, "html").decode("utf-8")
    latex = document_bytes(book, "tex").decode("utf-8")
    assert latex.count(r"\pageref{") == latex.count(r"\label{") == 3


def test_posters():
    for links in (4, 6, 8):
        _, sections = poster("chains", links)
        assert sum(len(section.items) for section in sections) == sum(
            count_chains(n, 1).chains for n in range(4, links + 1, 2)
        )
    _, sections = poster("assur", 6)
    assert [len(section.items) for section in sections] == [len(list(assur_groups(n))) for n in (2, 4, 6)]
    _, sections = poster("assur", 4, lang="de")
    assert [section.items[0].caption for section in sections] == ["2.1 DDD", "4.1 3-DD"]
    _, sections = poster("inversions", 6)
    assert [len(section.items) for section in sections] == [4, 10, 1, 2, 3]  # forms of the four-bar; Watt, Stephenson
    _, sections = poster("forms", lang="de")
    captions = [item.caption for item in sections[0].items]
    assert captions == [  # figure 2.4 of the seeds, with its lengths 2, 5, 4, 5
        "Gestell d: Kurbelschwinge",
        "Gestell c: Doppelschwinge mit umlaufender Koppel",
        "Gestell b: Kurbelschwinge",
        "Gestell a: Doppelkurbel",
    ]
    assert [len(section.items) for section in sections[1:]] == [10, 1, 4, 6, 2, 3]
    with pytest.raises(GrueblerError, match="did you mean 'joints'"):
        poster("joint")
    with pytest.raises(GrueblerError, match="up to 8 links"):
        poster("assur", 12)
    with pytest.raises(GrueblerError, match="has no number of links"):
        poster("joints", 4)


def test_every_kind_of_joint_is_drawn_with_its_motions():
    drawn = dict(joint_pictures("de"))
    assert {pair.name for pair in drawn} == {pair.name for pair in PAIRS if Space.SPATIAL in pair.freedoms}
    for pair, figure in drawn.items():
        freedoms = pair.freedoms[Space.SPATIAL]
        slides = sum(shape.style == "velocity-head" for shape in figure.shapes)
        turns = sum(shape.style == "head" for shape in figure.shapes)
        assert slides == 2 * sum(freedom[0] in "TH" for freedom in freedoms), pair
        assert turns == sum(freedom[0] in "RH" for freedom in freedoms), pair


def test_commands(tmp_path, capsys):
    file = tmp_path / "sheet.html"
    assert main(["exercise", "sheet", "--kind", "mobility,grashof", "--count", "2", "-o", str(file)]) == 0
    assert (tmp_path / "sheet-solutions.html").exists()
    assert main(["sheet", "draw", "four-bar:25,70,40,70", "-o", str(tmp_path / "m.tex")]) == 0
    assert main(["sheet", "draw", "R(0-1) R(1-2) R(2-3) R(3-0); frame=0; drive=R(0-1)"]) == 0
    assert capsys.readouterr().out.startswith("# four-bar linkage")
    assert main(["sheet", "book", "quad", "tri", "-o", str(tmp_path / "book.md")]) == 0
    assert main(["gallery", "--poster", "joints", "-o", str(tmp_path / "joints.html")]) == 0
    assert main(["sheet", "draw", "mzc", "-o", str(tmp_path / "mzc.md")]) == 2


def test_solutions_are_set_as_in_print():
    """Indices and minus signs as a textbook has them, ids of the program only where nothing is printed."""
    tasks = [exercise(id) for id in ("6", "11", "13", "exercise-5b", "exercise-4")]
    document = solution_document(tasks, lang="de")
    assert document.title == "Lösungen von 5 Aufgaben"
    assert blocks_of(document, Heading)[0].text == "Zwei-Zylinder-V-Kompressor (000/003, Aufgabe 6)"
    text = document_bytes(document, "md").decode("utf-8")
    words = re.sub(r"!\[[^\]]*\]\([^)]*\)", "", text)
    assert "F = 3(n − 1) − 2 g₁ − g₂ = 3(6 − 1) − 2·7 − 0 = 1" in words
    assert "φ<sub>iH2</sub> = 180° − φ<sub>H2</sub>" in words
    assert "α<sub>max1</sub>" in words
    assert "λ₁" in words
    assert "Das Dreieck A₀, A, B" in words
    assert "D(Gestell-Kurbel)" in words
    assert re.findall(r"exercise-| - |_|(?<!\w)-\d|\bg\d", words.replace("|---|", "")) == []


def test_a_table_is_divided_between_its_rows_only():
    """A short one not at all; of a long one the head stands above each part, never alone, and no row is alone."""
    for before in range(30, 60):
        filling = tuple(Paragraph(f"line {k}") for k in range(before))
        for count in (1, 5, 40):
            rows = Rows(("letter", "number"), tuple((f"row{k}", str(k)) for k in range(count)))
            pages = document_pages(Document("a table", (*filling, rows)))
            texts = [[item.text for item in page.items if isinstance(item, TextLine)] for page in pages]
            parts = [sum(text.startswith("row") for text in page) for page in texts]
            assert sum(parts) == count
            assert [page.count("letter") for page in texts] == [int(part > 0) for part in parts]
            assert sum(part > 0 for part in parts) == 1 or (count == 40 and min(part for part in parts if part) >= 2)


def test_an_empty_document_has_a_page():
    assert len(document_pages(Document("a", (), subtitle="b"))) == 1


def test_exercise_12_has_its_graphical_way(tmp_path):
    file = tmp_path / "12.html"
    assert main(["exercise", "solve", "12", "15", "8", "--lang", "de", "-o", str(file)]) == 0
    text = file.read_text(encoding="utf-8")
    assert "91,24" in text  # the frame, measured in the construction
    assert text.count("<svg") == 7  # three constructions, the linkages of 8, 12 and 15, s(φ) of 15
    assert "55 &lt; d &lt; 85" in text


def test_a_sheet_shows_every_output_and_the_machine_to_scale():
    """Both pistons of the compressor, each with its diagram; an arm with three drives."""
    pictures = blocks_of(machine_document(entries()["vcomp"], lang="de"), Pictures)
    assert [block.captions for block in pictures[1:]] == [("Kolben 1", "Kolben 2")]
    arm = blocks_of(machine_document(entries()["excavator"], lang="de"), Pictures)
    assert len(arm[0].figures) == 2
    assert "Zähne" in [shape.text for shape in arm[0].figures[0].shapes if isinstance(shape, TextShape)]
