"""The notebook widget: its Python side, and its front end under a host that gives the interface of anywidget."""

import json
from pathlib import Path

import pytest

import gruebler as gr
from gruebler.base.errors import GrueblerError
from gruebler.mechanics.fourbar import FourBar
from gruebler.page.page import module_text, packed_text, page_styles

BAR = FourBar(25, 70, 40, 70)

# what a notebook gives to a front-end module: a model with get, set, save_changes, on, off, send; and an element
HOST = """<!doctype html><meta charset="utf-8"><div id="cell"></div><script type="module">
import widget from "./explorer.js";
const values = JSON.parse(document.getElementById("values").textContent), listeners = {};
window.sent = []; window.saved = [];
const model = {
  get: (name) => values[name],
  set: (name, value) => { values[name] = value; },
  save_changes: () => saved.push(values.document),
  on: (event, callback) => (listeners[event] ??= []).push(callback),
  off: (event) => { delete listeners[event]; },
  send: (content) => sent.push(content),
};
window.tell = (event, content) => listeners[event].forEach((callback) => callback(content));
window.values = values;
window.end = await widget.render({ model, el: document.getElementById("cell") });
</script><script type="application/json" id="values">VALUES</script>"""


@pytest.fixture
def widget():
    pytest.importorskip("anywidget", reason="the widget needs anywidget")
    return gr.explore(BAR.linkage({"K": (45, 40)}))


def answers(widget, *questions):
    said = []
    widget.send = said.append
    for question in questions:
        widget._handle_custom_msg(question, [])
    return said


def test_the_linkage_goes_in_and_comes_back(widget):
    assert widget.linkage.mechanism == BAR.linkage().mechanism
    assert widget.linkage.points == BAR.linkage({"K": (45, 40)}).points
    document = json.loads(json.dumps(widget.document))
    document["elements"]["crank"]["R(crank-coupler)"] = [30.0, 0.0]
    widget.document = document
    assert widget.linkage.length("crank", 0, 1) == 30
    assert "export" in widget._esm
    assert widget.get_state()["host"] == "notebook"


def test_requests_are_answered_or_refused_in_one_sentence(widget):
    said = answers(
        widget,
        {"id": 1, "method": "measures", "params": {"document": widget.document}, "lang": "de"},
        {"id": 2, "method": "nothing", "params": {}},
        {"id": 3, "method": 7},
        {"id": 4, "cancel": True},
        "nonsense",
    )
    assert [one["id"] for one in said] == [1, 2, 3]
    assert any("Übertragungswinkel" in line for line in said[0]["result"]["lines"])
    assert "There is no request 'nothing'" in said[1]["error"]
    assert "error" in said[2]


def test_only_linkages_are_explored():
    with pytest.raises(GrueblerError, match="expected a linkage"):
        gr.explore("lambda")


def test_the_front_end_in_a_cell(tab, tmp_path):
    from gruebler.page.model import model_of

    values = {"host": "notebook", "lang": "de", "height": 600, "styles": page_styles()}
    values |= {name: packed_text(name) for name in ("motion", "texts")}
    values["machine"] = model_of(BAR.linkage({"K": (45, 40)}))
    text = json.dumps(values).replace("<", "\\u003c")
    page = tab()
    for name, content, kind in (
        ("", HOST.replace("VALUES", text), "text/html"),
        ("explorer.js", module_text(), "text/javascript"),
    ):
        page.page.route(f"http://cell.test/{name}", served(content, kind))
    page.page.goto("http://cell.test/")
    page.page.locator('[data-joint="R(coupler-rocker)"]').wait_for()
    page.page.locator('[data-panel="sizes"] summary', has_text="Abmessungen").wait_for()
    page.drag(page.middle('[data-joint="R(coupler-rocker)"] .joint'), (40, -10))
    page.until("saved.length > 1")
    document = page.page.evaluate("saved.at(-1)")
    dragged = read(document)
    assert dragged.length("rocker", 2, 3) != pytest.approx(40)
    # the page asks for measures of what was dragged, and shows the answer
    question = page.until("sent.find((one) => one.method === 'measures')")
    page.page.evaluate("(answer) => tell('msg:custom', answer)", {"id": question["id"], "result": {"lines": ["Gut."]}})
    page.until("document.querySelector('.gruebler-explorer').shadowRoot.textContent.includes('Gut.')")
    # the notebook scrolls on over the picture, unless Ctrl is held
    wheel = """(ctrlKey) => {
        const { shadowRoot } = document.querySelector('.gruebler-explorer');
        const stage = shadowRoot.querySelector('.motion .stage > svg[role]');
        const event = new WheelEvent('wheel', { deltaY: 50, ctrlKey, cancelable: true });
        stage.dispatchEvent(event);
        return event.defaultPrevented;
    }"""
    assert [page.page.evaluate(wheel, ctrl) for ctrl in (False, True)] == [False, True]
    page.page.evaluate("end()")
    assert page.page.locator(".gruebler-explorer").count() == 0


def served(content: str, kind: str):
    return lambda route: route.fulfill(body=content, content_type=f"{kind}; charset=utf-8")


def read(document: dict):
    from gruebler.files import linkage_from_json

    return linkage_from_json(document)


def test_a_saved_notebook_has_a_picture(widget):
    """Where the state of the widget is not kept or not shown, its picture is."""
    data, _ = widget._repr_mimebundle_()
    assert "application/vnd.jupyter.widget-view+json" in data
    assert data["image/svg+xml"].startswith("<svg")
    assert data["image/svg+xml"] == gr.draw(BAR.linkage({"K": (45, 40)}), curves=["K"], labels=True).svg()


@pytest.mark.slow
def test_a_saved_notebook_shows_the_widget(tab):
    """The example is run and saved with the state of its widget; from the file alone the page is drawn and dragged."""
    nbclient, nbformat = pytest.importorskip("nbclient"), pytest.importorskip("nbformat")
    pytest.importorskip("ipykernel")
    pytest.importorskip("anywidget", reason="the widget needs anywidget")
    path = Path(__file__).parents[2] / "docs" / "notebooks" / "explore.ipynb"
    notebook = nbformat.read(path, as_version=4)
    nbclient.NotebookClient(notebook, timeout=300, store_widget_state=True).execute()
    saved = json.loads(nbformat.writes(notebook))
    outputs = [output.get("data", {}) for cell in saved["cells"] for output in cell.get("outputs", [])]
    shown = next(data for data in outputs if "application/vnd.jupyter.widget-view+json" in data)
    kept = saved["metadata"]["widgets"]["application/vnd.jupyter.widget-state+json"]["state"]
    state = kept[shown["application/vnd.jupyter.widget-view+json"]["model_id"]]["state"]
    text = json.dumps({key: value for key, value in state.items() if key != "_esm"}).replace("<", "\\u003c")
    page = tab()
    for name, content, kind in (
        ("", HOST.replace("VALUES", text), "text/html"),
        ("explorer.js", state["_esm"], "text/javascript"),
    ):
        page.page.route(f"http://cell.test/{name}", served(content, kind))
    page.page.goto("http://cell.test/")
    page.page.locator('[data-joint="R(coupler-rocker)"]').wait_for()
    page.drag(page.middle('[data-joint="R(coupler-rocker)"] .joint'), (40, -10))
    page.until("saved.length > 1")
    assert read(page.page.evaluate("saved.at(-1)")).length("rocker", 2, 3) != pytest.approx(40)
