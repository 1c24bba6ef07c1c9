"""A server of the page in a process of its own, and a browser that looks at it."""

import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from playwright.sync_api import BrowserType

# Those without windows first: others draw one that nobody sees around each page, which takes longer than most pages.
SHELLS = ("chromium-headless-shell", "chrome-headless-shell")
BROWSERS = (*SHELLS, "chromium", "chromium-browser", "google-chrome", "chrome")


def find_browser(chromium: "BrowserType") -> str | None:
    """The path of a browser: one that is installed, otherwise what `playwright install chromium` brought."""
    installed = next((found for name in BROWSERS if (found := shutil.which(name))), None)
    return installed or (chromium.executable_path if Path(chromium.executable_path).exists() else None)


class Server:
    """`gruebler explore` on a free port; it can be killed and started again at the same address."""

    def __init__(self, folder: Path, word: str = "crankrocker") -> None:
        self.folder, self.word, self.port = folder, word, 0
        self.start()

    def start(self) -> None:
        log = self.folder / "server.log"
        with log.open("w") as out:
            command = [sys.executable, "-m", "gruebler", "explore", self.word, "--no-browser", "--port", str(self.port)]
            env = os.environ | {"XDG_CACHE_HOME": str(self.folder / "cache"), "PYTHONUNBUFFERED": "1"}
            self.process = subprocess.Popen(command, stdout=out, stderr=subprocess.STDOUT, env=env)
        for _ in range(600):
            found = re.search(r"http://127\.0\.0\.1:(\d+)/\S+", log.read_text())
            if found and self.answers(found[0]):
                self.address, self.port = found[0], int(found[1])
                return
            assert self.process.poll() is None, log.read_text()
            time.sleep(0.1)
        raise AssertionError("the server does not answer: " + log.read_text())

    @staticmethod
    def answers(address: str) -> bool:
        from urllib.error import URLError
        from urllib.request import urlopen

        try:
            with urlopen(address, timeout=5) as answer:
                return answer.status == 200
        except (URLError, OSError):
            return False

    def kill(self) -> None:
        self.process.kill()
        self.process.wait()


@pytest.fixture(scope="session")
def server(tmp_path_factory) -> Iterator[Server]:
    for name in ("starlette", "uvicorn", "websockets"):
        pytest.importorskip(name, reason=f"the server of the page needs {name}")
    made = Server(tmp_path_factory.mktemp("server"))
    yield made
    made.kill()


@pytest.fixture(scope="session")
def chromium() -> Iterator["BrowserType"]:
    """Playwright's one session of a test process: a second one beside it would be refused."""
    playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    with playwright.sync_playwright() as play:
        yield play.chromium


@pytest.fixture(scope="session")
def browser(chromium):
    path = find_browser(chromium)
    if path is None:
        pytest.skip(f"no browser is here: {', '.join(BROWSERS)}, or that of `playwright install chromium`")
    made = chromium.launch(executable_path=path, args=["--no-sandbox", "--disable-gpu"])
    yield made
    made.close()


class Tab:
    """A page with what went wrong in it and what it asked for."""

    def __init__(self, browser, *, width=1280, height=860, scheme="light", locale="en-US", touch=False) -> None:
        self.context = browser.new_context(
            viewport={"width": width, "height": height}, color_scheme=scheme, locale=locale, has_touch=touch
        )
        self.page = self.context.new_page()
        self.page.set_default_timeout(15_000)
        self.errors: list[str] = []
        self.requests: list[str] = []
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.on("console", lambda m: m.type == "error" and self.errors.append(m.text))
        self.page.on("request", lambda request: self.requests.append(request.url))

    def until(self, expression: str, seconds: float = 30.0):
        """The value of an expression of the page as soon as it is true (its policy forbids waiting within the page)."""
        for _ in range(int(seconds * 20)):
            found = self.page.evaluate(expression)
            if found:
                return found
            self.page.wait_for_timeout(50)
        raise AssertionError(f"{expression} stays false; {self.errors}")

    def open(self, address: str) -> "Tab":
        self.page.goto(address)
        self.until("window.gruebler?.motion?.linkage !== undefined")
        return self

    def machine(self, id_: str) -> "Tab":
        """Let Motion show a machine of the catalog, at rest."""
        self.page.click('[data-view="catalog"]')
        self.page.locator(f'.card[data-id="{id_}"]').click()
        self.until(f"gruebler.view === 'motion' && gruebler.motion.linkage.model.source === '{id_}'")
        self.page.evaluate("gruebler.motion.transport.pause()")
        return self

    def hold(self) -> None:
        """What the page asks of the library waits in `held`."""
        self.page.evaluate("() => { window.held = []; gruebler.model.send = (content) => held.push(content); }")

    def target(self, x: float, y: float) -> tuple[float, float]:
        """Where a place of the plane of the synthesis is seen."""
        matrix = "(({ a, d, e, f }) => [a, d, e, f])(gruebler.root.querySelector('.plane > g').getScreenCTM())"
        a, d, e, f = self.page.evaluate(matrix)
        return e + a * x, f - d * y

    def middle(self, selector: str) -> tuple[float, float]:
        box = self.page.locator(selector).bounding_box()
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def drag(self, start: tuple[float, float], *ways: tuple[float, float], steps: int = 10) -> None:
        """Press the pointer at a place and take it along."""
        x, y = start
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        for dx, dy in ways:
            x, y = x + dx, y + dy
            self.page.mouse.move(x, y, steps=steps)
        self.page.mouse.up()
        self.page.wait_for_timeout(50)

    def close(self) -> None:
        self.context.close()


@pytest.fixture
def tab(browser):
    made: list[Tab] = []

    def make(**settings) -> Tab:
        made.append(Tab(browser, **settings))
        return made[-1]

    yield make
    errors = [error for one in made for error in one.errors]
    for one in made:
        one.close()
    assert errors == []
