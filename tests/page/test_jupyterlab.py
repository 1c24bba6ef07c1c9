"""The widget in a real JupyterLab page: a notebook is run, a joint dragged, the linkage read back in the next cell."""

import ast
import io
import json
import os
import re
import socket
import subprocess
import sys
import time
from contextlib import redirect_stdout
from importlib.util import find_spec
from pathlib import Path
from urllib.error import URLError
from urllib.request import urlopen

import pytest

NOTEBOOK = Path(__file__).parents[2] / "docs" / "notebooks" / "explore.ipynb"
TRIALS = 600


def cells():
    return json.loads(NOTEBOOK.read_text(encoding="utf-8"))["cells"]


def text(cell):
    return "".join(cell["source"])


def test_the_saved_notebook_shows_what_its_cells_give():
    """Every cell is run again; the file has no path of a machine and nothing that changes from run to run."""
    pytest.importorskip("anywidget", reason="the widget needs anywidget")
    content = NOTEBOOK.read_text(encoding="utf-8")
    assert not re.search(r"/home/|/Users/|/tmp/|[A-Z]:\\\\| at 0x", content)
    names: dict[str, object] = {}
    for cell in cells():
        if cell["cell_type"] != "code":
            continue
        if cell["id"] == "install":
            assert cell["outputs"] == []
            continue
        *lines, last = ast.parse(text(cell)).body
        exec(compile(ast.Module(lines, []), "cell", "exec"), names)
        with redirect_stdout(io.StringIO()) as printed:
            value = eval(compile(ast.Expression(last.value), "cell", "eval"), names)
        for output in cell["outputs"]:
            if output["output_type"] == "stream":
                assert "".join(output["text"]) == printed.getvalue()
            elif "text/plain" in output["data"]:
                assert "".join(output["data"]["text/plain"]) == repr(value)
            assert not hasattr(value, "_repr_mimebundle_") or "image/svg+xml" in output["data"]
            if "image/svg+xml" in output.get("data", {}):
                picture = value.svg() if hasattr(value, "svg") else value._repr_mimebundle_()[0]["image/svg+xml"]
                assert "".join(output["data"]["image/svg+xml"]).strip() == picture.strip()


@pytest.fixture
def lab(tmp_path):
    """JupyterLab on a free port with the notebook, nothing of the user's own settings."""
    if not find_spec("jupyterlab") or not find_spec("anywidget"):
        pytest.skip("jupyterlab or anywidget is not installed")
    import anywidget

    extensions = Path(anywidget.__file__).parents[4] / "share" / "jupyter" / "labextensions"
    notebook = json.loads(NOTEBOOK.read_text(encoding="utf-8"))
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            cell |= {"outputs": [], "execution_count": None}
    (tmp_path / "explore.ipynb").write_text(json.dumps(notebook), encoding="utf-8")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    own = {"JUPYTER_CONFIG_DIR": "config", "JUPYTER_DATA_DIR": "data", "JUPYTER_RUNTIME_DIR": "run", "IPYTHONDIR": "ip"}
    environment = os.environ | {key: str(tmp_path / name) for key, name in own.items()}
    options = [
        "--no-browser",
        "--allow-root",
        f"--port={port}",
        "--IdentityProvider.token=token",
        f"--ServerApp.root_dir={tmp_path}",
        f"--LabApp.extra_labextensions_path={extensions}",
        "--LabApp.news_url=None",
        "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate",
    ]
    with (tmp_path / "lab.log").open("w") as log:
        server = subprocess.Popen(
            [sys.executable, "-m", "jupyterlab", *options], env=environment, stdout=log, stderr=subprocess.STDOUT
        )
    try:
        for _ in range(TRIALS):
            try:
                with urlopen(f"http://127.0.0.1:{port}/api?token=token", timeout=5):
                    break
            except (URLError, OSError):
                assert server.poll() is None, (tmp_path / "lab.log").read_text()
                time.sleep(0.1)
        yield f"http://127.0.0.1:{port}/lab/tree/explore.ipynb?token=token", tmp_path / "explore.ipynb"
    finally:
        server.terminate()
        server.wait()


@pytest.mark.slow
def test_a_joint_is_dragged_in_jupyterlab(browser, lab):
    address, path = lab
    context = browser.new_context(viewport={"width": 1400, "height": 1300})
    page = context.new_page()
    page.set_default_timeout(60_000)
    errors = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(address)
    page.locator(".jp-Notebook .jp-CodeCell").first.wait_for()
    # a page without settings may ask at any time which kernel is meant
    select = page.locator(".jp-Dialog button", has_text="Select").last
    page.add_locator_handler(select, lambda shown: shown.click())
    page.locator(".jp-Notebook-ExecutionIndicator[data-status='idle']").wait_for()
    for k in (0, 1):  # what installs gruebler where it is missing, then the widget
        page.locator(".jp-CodeCell .jp-InputArea-editor").nth(k).click()
        page.keyboard.press("Shift+Enter")
    joint = page.locator('[data-joint="R(coupler-rocker)"] .joint')
    joint.wait_for()
    joint.scroll_into_view_if_needed()
    page.wait_for_timeout(1000)
    box = joint.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 40, y - 30, steps=12)
    page.mouse.up()
    page.wait_for_timeout(1500)
    if folder := os.environ.get("GRUEBLER_SCREENSHOTS"):
        page.screenshot(path=str(Path(folder) / "jupyterlab.png"))
    for k in (2, 3):
        page.locator(".jp-CodeCell .jp-InputArea-editor").nth(k).click()
        page.keyboard.press("Shift+Enter")
        page.locator(".jp-CodeCell").nth(k).locator(".jp-OutputArea-output").first.wait_for()
    lengths = float(page.locator(".jp-CodeCell").nth(2).locator(".jp-OutputArea-output").last.inner_text())
    assert lengths != pytest.approx(40, abs=0.1)
    assert "dead centre" in page.locator(".jp-CodeCell").nth(3).locator(".jp-OutputArea-output").last.inner_text()
    page.keyboard.press("Control+s")
    page.wait_for_timeout(2500)
    saved = json.loads(path.read_text(encoding="utf-8"))
    shown = [output for cell in saved["cells"] for output in cell.get("outputs", []) if "data" in output]
    assert any("application/vnd.jupyter.widget-view+json" in output["data"] for output in shown)
    assert [error for error in errors if "gruebler" in error] == []
    context.close()
