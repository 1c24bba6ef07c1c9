"""HTML files run their own scripts and nothing else: what a browser says of them."""

import re

import pytest

from gruebler.cli import main

PAGES = {
    "animate": ("animate", "crankrocker"),
    "gallery": ("gallery", "--links", "6"),
    "construction": ("construct", "dead-centres"),
    "sheet": ("sheet", "draw", "crankrocker"),
    "worksheet": ("exercise", "sheet", "--kind", "mobility", "--seed", "7"),
    "explore": ("explore", "crankrocker"),
}


@pytest.fixture(params=PAGES)
def page(request, tmp_path):
    path = tmp_path / "page.html"
    assert main([*PAGES[request.param], "-o", str(path)]) == 0
    return request.param, path


def test_a_page_loads_nothing(page):
    name, path = page
    text = path.read_text()
    policy = re.search(r'<meta http-equiv="Content-Security-Policy" content="([^"]*)">', text)
    assert policy, name
    assert text.index(policy[0]) < text.index("<title>")
    rules = policy[1].split("; ")
    assert rules[0] == "default-src 'none'"
    unsafe = {word for rule in rules if not rule.startswith("style-src") for word in rule.split() if "unsafe" in word}
    assert unsafe == ({"'wasm-unsafe-eval'"} if name == "explore" else set())  # the kernels; texts are no code
    assert len(re.findall(r"<script(?! type=.(?:application/json|text/plain))", text)) == rules[1].count("'sha256-")
    assert rules[-2:] == ["base-uri 'none'", "form-action 'none'"]


def test_a_browser_runs_its_scripts_and_refuses_others(page, browser):
    name, path = page
    tab = browser.new_page()
    complaints = []
    tab.on("console", lambda message: complaints.append(message.text) if message.type == "error" else None)
    tab.on("pageerror", lambda error: complaints.append(str(error)))
    tab.goto(path.as_uri())
    if name == "animate":
        before = tab.get_by_role("button").inner_text()
        tab.get_by_role("button").click()
        assert {before, tab.get_by_role("button").inner_text()} == {"Play", "Pause"}
    assert complaints == []
    tab.evaluate(
        "() => { const s = document.createElement('script'); s.textContent = 'window.foreign = 1';"
        " document.head.append(s); const i = new Image(); i.src = 'https://x.invalid/x.png';"
        " document.body.append(i) }"
    )
    assert tab.evaluate("() => window.foreign === undefined")
    tab.wait_for_timeout(50)
    assert any("Content Security Policy" in text for text in complaints)
    tab.close()
