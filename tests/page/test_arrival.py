"""How the page is arrived at: damaged links, a slow start, a phone."""

import pytest

from gruebler.cli import main

ROOT = "document.querySelector('.gruebler-explorer').shadowRoot"


@pytest.mark.parametrize(
    ("link", "words"),
    [
        ("#1.AAAA.00000000", "damaged"),
        ("#2.AAAA.00000000", "newer"),
        ("#rubbish", "not complete"),
    ],
)
def test_a_link_that_cannot_be_read_stays_in_the_address(tab, server, link, words):
    page = tab().open(server.address + link)
    page.until("gruebler.model.socket?.readyState === 1")
    page.page.wait_for_timeout(500)
    assert words in page.page.locator(".message").inner_text()
    assert page.page.evaluate("location.hash") == link
    page.drag(page.middle('[data-joint="R(coupler-rocker)"] .joint'), (25, -15))
    page.until("location.hash.startsWith('#1.') && location.hash.length > 100")
    page.page.reload()
    page.until("window.gruebler?.motion?.linkage !== undefined")
    page.page.wait_for_timeout(300)
    assert page.page.evaluate("gruebler.message.hidden") is True


def test_forces_have_an_address(tab, server):
    page = tab(locale="de-DE").open(server.address + "#en/forces")
    panel = page.page.locator('[data-panel="forces"]')
    panel.get_by_text("Masses, loads").wait_for()
    assert page.page.locator('[aria-selected="true"]').inner_text() == "Motion"
    assert page.page.evaluate("gruebler.message.hidden") is True


def test_the_catalog_tells_that_it_searches(tab, server):
    page = tab().open(server.address)
    view = page.page
    view.click('[data-view="catalog"]')
    view.locator("[data-list=catalog] .card svg").first.wait_for()
    page.hold()
    view.locator('[data-field="words"]').fill("klann")
    view.locator(".note", has_text="Searching").wait_for()
    assert float(view.locator("[data-list=catalog]").evaluate("one => getComputedStyle(one).opacity")) < 1
    page.until("held.some((one) => one.method === 'catalog')")
    view.evaluate(
        "held.splice(0).forEach((one) => Object.getPrototypeOf(gruebler.model).send.call(gruebler.model, one))"
    )
    view.locator(".note", has_text="One machine").wait_for()
    assert view.locator("[data-list=catalog]").evaluate("one => getComputedStyle(one).opacity") == "1"
    # a chip is one search; what is typed while it goes on waits for its end
    view.locator('[data-value="cam"]').click()
    page.until("held.some((one) => one.method === 'catalog')")
    for words in ("klan", "kla", "j", "jansen"):
        view.locator('[data-field="words"]').fill(words)
        view.wait_for_timeout(300)
    searches = "held.filter((one) => one.method === 'catalog').map((one) => one.params.words)"
    assert view.evaluate(searches) == ["klann"]
    release = "held.splice(0).forEach((one) => Object.getPrototypeOf(gruebler.model).send.call(gruebler.model, one))"
    view.evaluate(release)
    page.until("held.some((one) => one.method === 'catalog')")
    assert view.evaluate(searches) == ["jansen"]


@pytest.mark.parametrize(("locale", "words"), [("en-US", "This page needs"), ("de-DE", "Diese Seite braucht")])
def test_a_browser_without_webassembly_is_told_so(tab, server, locale, words):
    page = tab(locale=locale)
    page.page.add_init_script("delete window.WebAssembly")
    page.page.goto(server.address)
    page.page.locator(".message").get_by_text(words).wait_for()


def test_a_link_without_a_mechanism_is_refused_in_a_sentence(tab, server):
    page = tab().open(server.address)
    link = page.page.evaluate("(async () => { await gruebler.write(); return gruebler.hash; })()")
    assert link.startswith("#1.")
    packed = """(async () => {
        const bytes = new TextEncoder().encode('{"name": "empty"}');
        const stream = new Blob([bytes]).stream().pipeThrough(new CompressionStream("deflate-raw"));
        return [...new Uint8Array(await new Response(stream).arrayBuffer())];
    })()"""
    import base64
    import zlib

    raw = bytes(page.page.evaluate(packed))
    data = base64.urlsafe_b64encode(raw).rstrip(b"=").decode()
    other = tab().open(f"{server.address}#1.{data}.{zlib.crc32(raw):08x}")
    other.until("!gruebler.message.hidden")
    assert "no mechanism" in other.page.locator(".message").inner_text()


def test_a_message_is_closed_and_does_not_follow_into_other_views(tab, server):
    page = tab().open(server.address + "#rubbish")
    page.until("!gruebler.message.hidden")
    page.page.locator('.message [aria-label="Close"]').click()
    assert page.page.evaluate("gruebler.message.hidden") is True
    page.page.evaluate("gruebler.say('something went wrong')")
    page.page.click('[data-view="catalog"]')
    assert page.page.evaluate("gruebler.message.hidden") is True


def test_a_view_that_waits_says_so(tab, server):
    """Until the first answer is there, which on a busy machine takes seconds."""
    page = tab().open(server.address)
    page.page.evaluate("gruebler.model.send = () => undefined")  # nobody answers
    for view in ("structure", "catalog", "exercises"):
        page.page.click(f'[data-view="{view}"]')
        page.page.locator(f'[data-page="{view}"] [data-waiting]').first.wait_for(timeout=2000)


def test_cards_of_the_catalog_come_to_places_of_their_size(tab, server):
    page = tab().open(server.address)
    page.hold()
    size = """(() => {
        const card = gruebler.root.querySelector('[data-page=catalog] .card');
        const { x, y, width, height } = card.getBoundingClientRect();
        return [x, y, width, height];
    })()"""
    page.page.click('[data-view="catalog"]')
    assert page.page.locator("[data-waiting] > .card").count() > 12
    empty = page.page.evaluate(size)
    # the list comes, no picture yet
    answer = """(method) => held.splice(0).filter((one) => one.method === method)
        .forEach((one) => Object.getPrototypeOf(gruebler.model).send.call(gruebler.model, one))"""
    page.until("held.length > 0")
    page.page.evaluate(answer, "catalog")
    page.until("gruebler.root.querySelector('[data-page=catalog] [data-waiting]') === null")
    assert page.page.evaluate(size) == empty
    page.until("held.some((one) => one.method === 'picture')")
    page.page.evaluate(answer, "picture")
    page.page.locator(".card svg").first.wait_for()
    assert page.page.evaluate(size) == empty


@pytest.fixture(scope="module")
def crank_rocker(tmp_path_factory):
    path = tmp_path_factory.mktemp("page") / "crank-rocker.html"
    assert main(["explore", "crankrocker", "-o", str(path)]) == 0
    return path.as_uri()


def touches(tab):
    """Send fingers at places: each call is one event with all that are down."""
    session = tab.context.new_cdp_session(tab.page)

    def send(kind: str, *places: tuple[float, float]) -> None:
        points = [{"x": x, "y": y, "id": k} for k, (x, y) in enumerate(places)]
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    return send


def test_two_fingers_enlarge_the_picture(tab, crank_rocker):
    page = tab(width=390, height=844, touch=True).open(crank_rocker)
    box = page.page.locator(".stage").bounding_box()
    x, y = box["x"] + 60, box["y"] + box["height"] - 40
    scale = "gruebler.motion.stage.viewport.scale"
    before, sizes = page.page.evaluate(f"[{scale}, JSON.stringify(gruebler.motion.linkage.sizes.snapshot())]")
    send = touches(page)
    send("touchStart", (x, y))
    send("touchStart", (x, y), (x + 60, y))
    for k in range(1, 7):
        send("touchMove", (x, y), (x + 60 + 10 * k, y))
    send("touchEnd")
    page.page.wait_for_timeout(100)
    after, same = page.page.evaluate(f"[{scale}, JSON.stringify(gruebler.motion.linkage.sizes.snapshot())]")
    assert after == pytest.approx(2 * before, rel=0.02)
    assert same == sizes


def test_two_fingers_enlarge_the_plane_that_is_drawn_on_and_put_nothing(tab, server):
    page = tab(width=390, height=844, touch=True).open(server.address)
    page.page.tap('[data-view="build"]')
    page.page.tap('[data-tool="ground"]')
    box = page.page.locator(".drawing").bounding_box()
    x, y = box["x"] + 90, box["y"] + 250
    view = "gruebler.views.build"
    before = page.page.evaluate(f"{view}.viewport.scale")
    send = touches(page)
    send("touchStart", (x, y))
    send("touchStart", (x, y), (x + 60, y))
    for k in range(1, 7):
        send("touchMove", (x, y), (x + 60 + 10 * k, y))
    send("touchEnd")
    page.page.wait_for_timeout(100)
    assert page.page.evaluate(f"{view}.viewport.scale") == pytest.approx(2 * before, rel=0.02)
    assert page.page.evaluate(f"{view}.drawing.knots.length") == 0
    page.page.touchscreen.tap(x, y)  # one finger puts it
    assert page.page.evaluate(f"{view}.drawing.knots.length") == 1
    page.page.evaluate("localStorage.clear()")


def test_a_finger_on_a_plot_scrolls_the_page(tab, crank_rocker):
    page = tab(width=390, height=844, touch=True).open(crank_rocker)
    plot = page.page.locator(".plot").first
    plot.scroll_into_view_if_needed()
    box = plot.bounding_box()
    drive = page.page.evaluate("gruebler.motion.linkage.drives[0]")
    x, y = box["x"] + 200, box["y"] + 100
    send = touches(page)
    before = plot.bounding_box()["y"]
    send("touchStart", (x, y))
    for k in range(1, 11):
        send("touchMove", (x, y - 12 * k))
        page.page.wait_for_timeout(16)
    send("touchEnd")
    page.page.wait_for_timeout(300)
    assert plot.bounding_box()["y"] < before - 40
    assert page.page.evaluate("gruebler.motion.linkage.drives[0]") == drive
    plot.scroll_into_view_if_needed()
    box = plot.bounding_box()
    page.page.touchscreen.tap(box["x"] + 200, box["y"] + 60)
    assert page.page.evaluate("gruebler.motion.linkage.drives[0]") != drive


@pytest.mark.parametrize("width", [390, 1024])
def test_the_header_leaves_room(tab, server, width):
    page = tab(width=width, height=800, touch=width < 500).open(server.address)
    assert page.page.locator("header").bounding_box()["height"] < (115 if width < 500 else 60)
    assert page.page.evaluate("document.documentElement.scrollWidth") <= width
    if width < 500:
        for button in page.page.locator("header button:visible").all():
            assert button.bounding_box()["height"] >= 43.5


RELEASE = "held.splice(0).forEach((one) => Object.getPrototypeOf(gruebler.model).send.call(gruebler.model, one))"
SOURCE = "gruebler.motion.linkage.model.source"


def test_what_is_answered_after_the_reader_left_opens_nothing(tab, server):
    page = tab().open(server.address)
    view = page.page
    view.click('[data-view="catalog"]')
    crank = view.locator('.card[data-id="slidercrank"]')
    crank.wait_for()
    page.hold()
    crank.click()
    page.until("held.some((one) => one.method === 'open')")
    view.click('[data-view="motion"]')
    view.evaluate(RELEASE)
    view.click('[data-view="catalog"]')
    page.until("held.every((one) => one.method !== 'open')")
    # of two that are chosen the later one counts
    crank.click()
    view.locator('.card[data-id="lamp"]').click()
    page.until("held.filter((one) => one.method === 'open').length === 2")
    assert view.evaluate(SOURCE) == "crankrocker"
    view.evaluate(RELEASE)
    page.until("gruebler.view === 'motion'")
    assert view.evaluate(SOURCE) == "lamp"
    view.evaluate("delete gruebler.model.send")
    view.go_back()
    page.until("gruebler.view === 'catalog'")
    assert view.evaluate("gruebler.message.hidden") is True


def test_an_address_that_is_read_late_leads_to_the_view_that_was_left(tab, server):
    page = tab().open(server.address)
    view = page.page
    page.machine("slidercrank")
    page.until("location.hash.length > 1")
    view.click('[data-view="exercises"]')
    # the page does not wait for its address
    at_once = "window.setTimeout = (f, ms) => later(f, ms === 10000 ? 0 : ms)"
    view.add_init_script("{ const later = setTimeout; " + at_once + " }")
    view.reload()
    page.until(f"window.gruebler?.motion?.linkage && {SOURCE} === 'slidercrank'")
    page.until("gruebler.view === 'exercises'")
    view.wait_for_timeout(300)
    assert view.evaluate("gruebler.view") == "exercises"
