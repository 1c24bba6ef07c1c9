"""Four notebooks of docs (`tests/page` has the fifth): every cell runs, every value it ends with shows itself."""

import ast
import json
from html import escape

import pytest

import gruebler as gr
from tests.docs_session import DOCS

NOTEBOOKS = [DOCS / "notebooks" / f"{name}.ipynb" for name in ("lesson", "design", "research", "forces")]
RICH = ("_repr_html_", "_repr_svg_", "_repr_markdown_", "_repr_mimebundle_")


def cells(path):
    document = json.loads(path.read_text(encoding="utf-8"))
    assert document["nbformat"] == 4
    return [("".join(cell["source"]), cell) for cell in document["cells"] if cell["cell_type"] == "code"]


def shown(value):
    """What Jupyter shows of a value: its richest form, else its `repr`."""
    for name in RICH:
        made = getattr(value, name, None)
        if callable(made) and isinstance(text := made(), str):
            return text
    return repr(value)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_cells_run_and_values_show_themselves(path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names, pictures = {}, 0
    for source, cell in cells(path):
        assert cell["outputs"] == [], "notebooks are kept without outputs"
        tree = ast.parse(source)
        last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, path.name, "exec"), names)
        value = eval(compile(ast.Expression(last.value), path.name, "eval"), names) if last else None
        if value is not None:
            text = shown(value)
            pictures += text.startswith(("<svg", "<table"))
            assert " object at 0x" not in text, source
            assert len(text) < 200_000, source
            if not text.startswith("<"):
                assert len(text) < 2_000, source
    assert pictures >= 3


@pytest.mark.slow
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_jupyter_runs_them(path, tmp_path):
    nbclient, nbformat = pytest.importorskip("nbclient"), pytest.importorskip("nbformat")
    pytest.importorskip("ipykernel")
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    nbclient.NotebookClient(notebook, timeout=600, resources={"metadata": {"path": str(tmp_path)}}).execute()
    kinds = {kind for cell in notebook.cells for output in cell.get("outputs", []) for kind in output.get("data", {})}
    assert "image/svg+xml" in kinds


def test_what_is_explained_in_words_shows_them_in_a_cell():
    """IPython's own formatter: a picture, or the words of `explain`; never the line of `repr` alone."""
    formatters = pytest.importorskip("IPython.core.formatters")
    size = gr.FourBar(25, 70, 40, 70)
    motion = gr.move(size, gr.from_degrees(0, 360, 10))
    values = [
        gr.measures(size),
        gr.freedoms(size),
        gr.circuit(size),
        gr.statics(motion, gr.Loads()),
        gr.decompose(size.linkage().mechanism),
        gr.teaching.worksheet(["grashof"], 1),
    ]
    for value in values:
        shown, _ = formatters.DisplayFormatter().format(value)
        assert "text/html" in shown, type(value)
        assert "\n" not in shown["text/plain"]
        assert len(shown["text/plain"]) < 1500
    shown, _ = formatters.DisplayFormatter().format(values[0])
    assert shown["text/html"] == f"<pre>{escape(values[0].explain())}</pre>"
