"""What is seen before the page is there, and that it comes in pieces without a jump."""

import pytest

from gruebler.cli import main
from gruebler.page.model import model_of
from gruebler.page.static_site import write_site
from gruebler.teaching.catalog import entry

SHADOW = "document.querySelector('.gruebler-explorer').shadowRoot"
BOXES = f"""['header', '.stage', 'h1'].map((name) => {{
    const {{ x, y, width, height }} = {SHADOW}.querySelector(name).getBoundingClientRect();
    return name === 'h1' ? [x, y] : [x, y, width, height];
}})"""
PAPER = f"getComputedStyle({SHADOW}.host).backgroundColor"
LOADING = f"{SHADOW}.querySelector('.loading') !== null"


@pytest.fixture(scope="module")
def addresses(server, tmp_path_factory):
    """The page of a linkage from each of its hosts."""
    folder = tmp_path_factory.mktemp("start")
    record = entry("lambda")
    assert main(["explore", "lambda", "-o", str(folder / "lambda.html"), "--lang", "de"]) == 0
    write_site(folder / "site", model_of(record.linkage(), name=record.name, source="lambda"), lang="de", groups=())
    return {
        "server": server.address,
        "file": (folder / "lambda.html").as_uri(),
        "site": (folder / "site/index.html").as_uri(),
    }


@pytest.mark.parametrize("host", ["server", "file", "site"])
@pytest.mark.parametrize(("width", "scheme"), [(1440, "light"), (1024, "dark"), (390, "dark")])
def test_the_page_comes_to_the_place_of_its_outline(tab, browser, addresses, host, width, scheme):
    """Without scripts a browser shows what it shows until they are there."""
    size, touch = {"width": width, "height": 844}, width < 500
    context = browser.new_context(
        viewport=size, color_scheme=scheme, locale="de-DE", has_touch=touch, java_script_enabled=False
    )
    outline = context.new_page()
    outline.goto(addresses[host])
    assert outline.evaluate(LOADING)
    assert outline.locator("progress").is_visible()
    before = outline.evaluate(BOXES)
    paper, name = outline.evaluate(PAPER), outline.locator("h1").text_content()
    assert outline.locator("h1 small").evaluate("one => getComputedStyle(one).visibility") == "hidden"
    context.close()
    page = tab(width=width, height=844, scheme=scheme, locale="de-DE", touch=touch).open(addresses[host])
    assert not page.page.evaluate(LOADING)
    for box, outlined in zip(page.page.evaluate(BOXES), before, strict=True):
        assert box == pytest.approx(outlined, abs=0.6)
    assert page.page.evaluate(PAPER) == paper == {"light": "rgb(255, 255, 255)", "dark": "rgb(22, 25, 29)"}[scheme]
    assert page.page.locator("h1").text_content() == name  # which is seen with the machine only


@pytest.mark.parametrize("width", [1440, 390])
def test_nothing_jumps_when_the_script_comes(tab, server, width):
    page = tab(width=width, height=844, touch=width < 500)
    page.page.add_init_script(
        """window.shifts = [];
        new PerformanceObserver((list) => shifts.push(...list.getEntries().map(({ value }) => value)))
            .observe({ type: 'layout-shift', buffered: true });"""
    )
    held = []

    def hold(route):
        held.append(route)

    page.page.route("**/explorer.js", hold)
    page.page.goto(server.address, wait_until="commit")
    page.page.locator(".loading progress").wait_for()
    page.page.wait_for_timeout(200)  # it is drawn
    assert len(held) == 1
    held[0].continue_()
    page.until("window.gruebler !== undefined")
    page.until("gruebler.root.querySelector('.facts dd')")
    page.page.wait_for_timeout(300)
    assert sum(page.page.evaluate("shifts")) == 0


def test_the_page_starts_in_pieces(tab, server):
    """What changes in one piece of work is told to an observer at once, after it."""
    page = tab()
    page.page.add_init_script(
        """window.seen = [];
        new MutationObserver(() => {
            const shadow = document.querySelector('.gruebler-explorer')?.shadowRoot;
            if (!shadow || shadow.seen) return;
            shadow.seen = true;
            const count = (names) => shadow.querySelectorAll(names).length;
            new MutationObserver(() => seen.push(
                [count('.stage .joint'), count('.facts dd'), count('.plot .curve[d]')].map((n) => n > 0).join(),
            )).observe(shadow, { childList: true, subtree: true, attributes: true });
        }).observe(document, { childList: true, subtree: true });"""
    )
    page.open(server.address)
    seen = page.page.evaluate("[...new Set(seen)]")
    for part in ("true,false,false", "true,true,false", "true,true,true"):  # picture, measures, plots
        assert part in seen


def test_an_older_browser_gets_its_style_sheet_too(tab, tmp_path):
    """One that leaves the template as it is."""
    path = tmp_path / "page.html"
    assert main(["explore", "lambda", "-o", str(path)]) == 0
    path.write_text(path.read_text(encoding="utf-8").replace(' shadowrootmode="open"', ""), encoding="utf-8")
    page = tab().open(path.as_uri())
    assert page.page.evaluate(f"getComputedStyle({SHADOW}.querySelector('header')).display") == "flex"
    assert not page.page.evaluate(LOADING)


@pytest.mark.parametrize("width", [1440, 390])
def test_light_or_dark_is_kept_for_the_next_page(tab, server, width):
    page = tab(width=width, height=844, touch=width < 500, scheme="light").open(server.address)
    theme = "document.querySelector('.gruebler-explorer').dataset.theme"
    page.page.get_by_role("button", name="Light or dark").click()
    page.page.reload()
    page.page.wait_for_selector("[data-icon=theme]")
    assert page.page.evaluate(theme) == "dark"
