"""The page for everyone: axe-core finds no serious fault in any view; tabs are walked through by arrows."""

import pytest

from tests.page.test_front_end import SOURCES

AXE = SOURCES / "node_modules/axe-core/axe.min.js"
VIEWS = {
    "motion": ".facts dd",
    "build": "[data-place=mobility]",
    "structure": "[data-fact=counted]",
    "synthesis": ".plane",
    "catalog": "[data-list=catalog] .card",
    "exercises": "[data-answer]",
}
FAULTS = """axe.run(document, { resultTypes: ["violations"] }).then(({ violations }) =>
    violations.map(({ impact, id, nodes }) => `${impact} ${id} ${nodes[0].html.slice(0, 200)}`))"""


@pytest.fixture(scope="module")
def axe() -> str:
    if not AXE.exists():
        pytest.skip("axe-core is not installed: npm ci in explorer/")
    return AXE.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("locale", "scheme", "width"),
    [("en-US", "light", 1280), pytest.param("de-DE", "dark", 390, marks=pytest.mark.slow)],
)
def test_no_view_has_a_serious_fault(tab, server, axe, locale, scheme, width):
    page = tab(locale=locale, scheme=scheme, width=width).open(server.address)
    page.page.set_default_timeout(60_000)
    page.page.evaluate(f"{axe};0")
    found = {}
    for view, part in VIEWS.items():
        page.page.evaluate(f"gruebler.show('{view}')")
        page.page.locator(part).first.wait_for()
        if view == "motion":
            page.page.evaluate("gruebler.root.querySelectorAll('.side details').forEach((one) => { one.open = true; })")
        found[view] = [fault for fault in page.page.evaluate(FAULTS) if not fault.startswith(("minor", "moderate"))]
        assert page.page.locator("main").count() == 1
    assert found == {key: [] for key in VIEWS}
    # and it does find what is one
    page.page.evaluate("gruebler.root.append(document.createElement('button'))")
    assert any("button-name" in fault for fault in page.page.evaluate(FAULTS))


def test_arrows_lead_from_tab_to_tab(tab, server):
    page = tab().open(server.address)
    drive = page.page.evaluate("gruebler.motion.linkage.drives[0]")
    page.page.locator('[data-view="motion"]').focus()
    here = "document.querySelector('.gruebler-explorer').shadowRoot.activeElement.dataset.view"
    for key, view in (("ArrowRight", "synthesis"), ("End", "exercises"), ("ArrowRight", "build"), ("Home", "build")):
        page.page.keyboard.press(key)
        assert (page.page.evaluate("gruebler.view"), page.page.evaluate(here)) == (view, view)
    assert page.page.locator('[role="tabpanel"]:visible').get_attribute("aria-label") == "Draw"
    assert page.page.evaluate("gruebler.motion.linkage.drives[0]") == drive
