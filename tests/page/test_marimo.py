"""The widget in a real marimo app: a joint dragged there runs the cells that read the linkage."""

import os
import socket
import subprocess
import sys
import time
from importlib.util import find_spec
from urllib.error import URLError
from urllib.request import urlopen

import pytest

APP = """
import marimo

app = marimo.App()


@app.cell
def _():
    import marimo as mo

    import gruebler as gr

    widget = mo.ui.anywidget(gr.explore(gr.FourBar(25, 70, 40, 70).linkage()))
    widget
    return mo, widget


@app.cell
def _(mo, widget):
    widget.value
    length = widget.widget.linkage.length("rocker", "R(coupler-rocker)", "R(frame-rocker)")
    mo.md(f"The rocker is {length:.6f} long")
    return
"""


@pytest.fixture
def app(tmp_path):
    """The app on a free port, nothing of the user's own settings."""
    if not find_spec("marimo") or not find_spec("anywidget"):
        pytest.skip("marimo or anywidget is not installed")
    (tmp_path / "app.py").write_text(APP, encoding="utf-8")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    command = [sys.executable, "-m", "marimo", "--log-level", "warn", "run", "app.py", "--headless", "--no-token"]
    with (tmp_path / "marimo.log").open("w") as log:
        server = subprocess.Popen(
            [*command, "--port", str(port), "--host", "127.0.0.1"],
            cwd=tmp_path,
            env=os.environ | {"HOME": str(tmp_path)},
            stdout=log,
            stderr=subprocess.STDOUT,
        )
    try:
        for _ in range(600):
            try:
                with urlopen(f"http://127.0.0.1:{port}/health", timeout=5):
                    break
            except (URLError, OSError):
                assert server.poll() is None, (tmp_path / "marimo.log").read_text()
                time.sleep(0.1)
        yield f"http://127.0.0.1:{port}/"
    finally:
        server.terminate()
        server.wait()


@pytest.mark.slow
def test_a_joint_that_is_dragged_runs_the_next_cell(browser, app):
    context = browser.new_context(viewport={"width": 1200, "height": 1400})
    page = context.new_page()
    page.set_default_timeout(60_000)
    page.goto(app)
    page.get_by_text("The rocker is 40.000000 long").wait_for()
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
    page.get_by_text("The rocker is 40.000000 long").wait_for(state="detached")
    told = float(page.get_by_text("The rocker is").inner_text().split()[3])
    assert 1 < abs(told - 40) < 100
    context.close()
