"""A machine in space beside the other views: room for it, what is said of it, its files, its structure."""

import numpy as np
import pytest

import gruebler as gr
from gruebler.mechanics.screws.link_sizes import link_sizes
from gruebler.mechanics.screws.resizing import resized
from gruebler.structure.chain.pairs import Alphabet
from gruebler.teaching.catalog import entry
from tests.page.test_space import PIXELS, browsed_at, drive_to

DRAWN = f"""boxes => {{
    {PIXELS}
    const ratio = c.width / c.clientWidth;
    const paper = [...p.subarray(4 * (c.width - 1), 4 * c.width)].join();
    let [left, right] = [c.width, 0];
    for (let y = 0; y < c.height; y++)
        for (let x = 0; x < c.width; x++) {{
            const at = 4 * (y * c.width + x);
            if ([...p.subarray(at, at + 4)].join() === paper) continue;
            [left, right] = [Math.min(left, x), Math.max(right, x)];
            const [across, up] = [x / ratio, y / ratio];
            if (boxes.some((b) => across > b.x && across < b.x + b.width && up > b.y && up < b.y + b.height))
                return null;
        }}
    return [left / ratio, right / ratio];
}}"""
"""From where to where across something is drawn; nothing if it is in one of the boxes."""
ENDS = "all => all.map((one) => ['x1', 'x2', 'y1', 'y2'].map((key) => Number(one.getAttribute(key))))"


def test_a_machine_is_seen_from_the_same_side_while_one_reads(server, chromium):
    """On a phone the picture is low then, much wider than high."""

    def axes(page):
        return [line.evaluate("line => line.outerHTML") for line in page.locator("line.axis").all()]

    browser, page, errors = browsed_at(chromium, server.address + "space/bennett.html", touch=True)
    page.set_viewport_size({"width": 390, "height": 844})
    page.locator("line.axis").first.wait_for(state="attached")
    page.wait_for_timeout(100)
    before, high = axes(page), page.locator(".stage").bounding_box()["height"]
    page.evaluate("scrollTo(0, 600)")
    while page.locator(".stage").bounding_box()["height"] > 0.6 * high:
        page.wait_for_timeout(50)
    page.wait_for_timeout(100)
    assert axes(page) == before
    assert errors == []
    browser.close()


@pytest.mark.parametrize(
    ("id", "touch"),
    [
        ("bennett", False),
        ("bennett", True),
        pytest.param("cardan_shaft", True, marks=pytest.mark.slow),
        pytest.param("gough", False, marks=pytest.mark.slow),
    ],
)
def test_a_machine_keeps_clear_of_buttons_and_words_all_the_way(server, chromium, id, touch):
    """On a phone, over the whole range of its drive; buttons that are touched are larger."""
    browser, page, errors = browsed_at(chromium, f"{server.address}space/{id}.html", touch=touch)
    page.set_viewport_size({"width": 390, "height": 844})
    page.get_by_role("button", name="Pause").click()
    page.evaluate("gruebler.scene.shown.floor = false")  # a click would scroll the page, and the picture be low
    picture = page.locator(".stage").bounding_box()
    boxes = [page.locator(place).first.bounding_box() for place in (".stage .tools", ".stage .hint")]
    for box in boxes:  # from the lower left corner of the picture
        box["y"] = picture["y"] + picture["height"] - box["y"] - box["height"]
        box["x"] -= picture["x"]
    assert min(min(box["width"], box["height"]) for box in boxes) > 30
    track, value = (page.locator(f".transport {part}").bounding_box() for part in (".track", "input.value"))
    if id != "gough":  # whose drive is chosen there
        assert value["y"] >= track["y"] + track["height"]  # below, as for machines in the plane
    low, high = page.evaluate("[gruebler.linkage.cycle.low, gruebler.linkage.cycle.high]")
    ends = []
    for part in np.linspace(0, 1, 13):
        page.evaluate("value => gruebler.transport.pick(value)", low + part * (high - low))
        ends.append(page.evaluate(DRAWN, boxes))
        assert ends[-1], part
    page.locator(".stage > svg").focus()
    for key in ("ArrowLeft", "ArrowUp", "ArrowRight"):  # from whatever side
        for _ in range(8):
            page.keyboard.press(key)
        ends.append(page.evaluate(DRAWN, boxes))
        assert ends[-1], key
        left, right = ends.pop()
        assert 3 < left < right < picture["width"] - 3, key
    if id == "bennett" and not touch:  # it lies below the buttons, not beside them
        assert max(right for _, right in ends) - min(left for left, _ in ends) > 0.8 * picture["width"]
    assert errors == []
    browser.close()


def test_what_is_said_of_a_machine_in_space_is_so(server, chromium):
    """Angles are called so, wheels on a sphere turn, what rests is at 0, and so are ends of a range."""
    browser, page, errors = browsed_at(chromium, server.address + "space/universal_joint.html")
    links = ("frame", "input", "cross", "output")
    assert page.locator('[data-panel="sizes"] label').all_inner_texts() == [f"{link}, angle" for link in links]
    page.goto(server.address + "space/diff_bevel.html?de#de")
    measures = page.locator('[data-panel="measures"]')
    measures.get_by_text("Drehung").first.wait_for()
    assert "Verschiebung" not in measures.inner_text()
    measures.get_by_text("Ausgleichskegelrad gegen Steg", exact=True).wait_for()  # the carrier has two names
    for id, low in (("winch_screw", "0°"), ("sarrus", "−30°")):
        page.goto(f"{server.address}space/{id}.html")
        page.get_by_role("button", name="Pause").click()
        drive_to(page, "0")
        assert measures.locator("dd").first.inner_text() == "0 mm"
        assert page.locator(".track text").first.text_content() == low
    assert errors == []
    browser.close()


def test_files_of_a_machine_in_space_come_from_the_server(server, chromium, tmp_path):
    """With the sizes that were typed; what a format leaves out is said."""
    browser, page, errors = browsed_at(chromium, server.address + "space/wiper_rssr.html")
    crank = page.locator("#size-1-0")
    crank.fill("50")
    crank.press("Enter")
    page.locator("header small", has_text="changed").wait_for(state="attached")
    page.locator('[data-icon="save"]').click()
    assert page.locator("dialog").get_by_text("Continue here").count() == 0  # the page opens linkages in the plane
    saved = {}
    for name in ("TOML", "glTF", "HTML", "URDF"):
        with page.expect_download() as taken:
            page.get_by_role("button", name=name, exact=True).click()
        saved[name] = taken.value.path().read_bytes()
    assert "the loops: the model is cut" in page.locator(".told").inner_text()
    (tmp_path / "a.toml").write_bytes(saved["TOML"])
    wanted = link_sizes(resized(entry("wiper_rssr").placed(), {"crank": (50.0, None)}))
    found = link_sizes(gr.read(tmp_path / "a.toml"))
    assert [size.distance for size in found] == pytest.approx([size.distance for size in wanted])
    assert saved["glTF"][:4] == b"glTF"
    assert b"<robot" in saved["URDF"]
    assert b"Content-Security-Policy" in saved["HTML"]
    assert errors == []
    browser.close()


def test_header_structure_and_save_are_of_the_machine_in_space(server, chromium):
    """In the other views, too, as long as Motion shows it."""
    browser, page, errors = browsed_at(chromium, server.address + "space/universal_joint.html#de")
    name = entry("universal_joint").name.in_language("de")
    page.get_by_role("link", name="Struktur").click()
    page.locator(".described").get_by_text("Gelenke:").wait_for()
    assert page.locator("header small").text_content() == name
    text = entry("universal_joint").placed().mechanism.text(Alphabet.GERMAN)
    assert page.locator('[data-field="chain"]').input_value() == text
    assert "Antriebsgabel" in page.locator(".chain-picture").text_content()
    card = page.locator('[data-list="chains"] .card, .chains .card')
    assert card.count() == 1
    assert page.get_by_label("Laufgrad", exact=True).count() == 0  # the lists are of the plane
    page.locator('[data-act="plane"]').click()
    page.get_by_text("eine Kette", exact=True).wait_for()
    card.first.click()
    page.locator('[data-act="plane"]').wait_for()
    assert card.count() == 1
    assert page.locator('[data-act="realise"]').count() == 0  # dimensions are found in the plane
    page.locator('[data-icon="save"]').click()
    page.locator("dialog").get_by_role("button", name="glTF").wait_for()
    assert page.locator("header small").text_content() == name
    assert errors == []
    browser.close()


def test_the_way_back_from_space_keeps_the_name_in_the_language_of_the_page(server, tab):
    """And a panel that was scrolled begins at its top for another machine."""
    page = tab(width=1440, height=500, locale="de-DE").open(server.address).machine("umbrella")
    side = page.page.locator(".motion .side")
    side.evaluate("panel => (panel.scrollTop = 200)")
    page.machine("lambda")
    assert side.evaluate("panel => panel.scrollTop") == 0
    address = page.page.evaluate("location.hash")
    page.machine("umbrella")
    page.until(f"location.hash !== '{address}'")  # it is kept
    page.page.wait_for_timeout(500)
    name = entry("umbrella").name.in_language("de")
    page.page.click('[data-view="catalog"]')
    page.page.locator('[data-id="bennett"]').click()
    page.page.get_by_role("link", name="Zeichnen").click()
    card = page.page.locator('[data-begin="hand"]')
    card.wait_for()
    assert card.inner_text() == f"{name} bearbeiten"
    card.click()  # all joints of the stick lie on the axis x = 0
    places = page.page.evaluate("gruebler.views.build.drawing.knots.map(({ at }) => at[0])")
    assert sorted(map(abs, places))[:3] == [0, 0, 0]


def test_the_frame_is_not_traced_and_a_click_leaves_no_ring(server, chromium):
    """What is pressed there turns the view, as beside the machine."""
    browser, page, errors = browsed_at(chromium, server.address + "space/bennett.html#en")
    page.get_by_role("button", name="Pause").click()
    drive_to(page, "60")  # every link is seen there
    moves = page.evaluate("gruebler.linkage.data.names.map((name, link) => [name, gruebler.linkage.moves(link)])")
    fixed = [name for name, moving in moves if not moving]
    assert fixed == [entry("bennett").placed().mechanism.frame]
    picture = page.locator(".stage > svg")
    box = picture.bounding_box()
    tips = {}
    for across in range(1, 30):
        for down in range(1, 20):
            x, y = box["x"] + across * box["width"] / 30, box["y"] + down * box["height"] / 20
            page.mouse.move(x, y)
            tips.setdefault(page.evaluate("gruebler.scene.marked"), (x, y))
        if len(tips) == 1 + len(moves):
            break
    wide = page.locator('[data-panel="measures"] .wide')
    frame = [moving for _, moving in moves].index(False)
    page.mouse.click(*tips[frame])
    assert wide.count() == 0
    assert picture.evaluate("e => e.matches(':focus') && getComputedStyle(e).outlineStyle") == "none"
    page.mouse.click(*tips[(frame + 1) % len(moves)])
    assert wide.count() == 1
    assert errors == []
    browser.close()


def test_a_machine_in_space_is_left_without_a_look_at_another_one(server, chromium):
    """Its structure was preceded by the machine with which the page begins, with buttons that could be pressed."""
    browser, page, errors = browsed_at(chromium, server.address + "space/bennett.html#en")
    seen = """window.seen = new Set();
        const look = () => {
            const root = document.querySelector(".gruebler-explorer")?.shadowRoot;
            for (const one of root?.querySelectorAll("h1 small, [aria-selected=true]") ?? [])
                if (getComputedStyle(one).visibility === "visible") window.seen.add(one.textContent);
            requestAnimationFrame(look);
        };
        look();"""
    page.add_init_script(seen)
    page.get_by_role("link", name="Structure").click()
    page.locator('[data-fact="own"]').wait_for()
    assert set(page.evaluate("[...seen]")) == {"Bennett's linkage", "Structure"}
    # what the library says of its sizes (Bennett 1903: F = 1), beside what almost all sizes give
    assert page.locator("[data-fact]").all_inner_texts() == ["F = −2", "F = 0", "F = 1"]
    assert "the mobility is 1, not 0" in page.locator(".described").inner_text()
    assert page.locator('[data-list="driven"] .card').count() == 1
    # the marks of strained links lie below links and letters
    over = "all => all.some((one) => one.parentNode.querySelector('.gr-letter').compareDocumentPosition(one) & 4)"
    assert page.locator("[data-strained]").count() == 4
    assert not page.locator("[data-strained]").evaluate_all(over)
    assert errors == []
    browser.close()


def test_words_on_the_picture_keep_apart_and_the_chosen_tab_is_marked_under_the_pointer(server, chromium):
    browser, page, errors = browsed_at(chromium, server.address + "space/bennett.html#de")
    colour = "one => one.computedStyleMap().get('background-color').toString()"
    tab = page.locator("nav [aria-current]")
    before = tab.evaluate(colour)
    tab.hover()
    assert tab.evaluate(colour) == before
    page.set_viewport_size({"width": 390, "height": 844})
    hint, grid = (page.locator(".stage .hint").nth(k).bounding_box() for k in (0, 1))
    assert hint["x"] + hint["width"] <= grid["x"]
    page.goto(server.address + "space/wobble_plate.html#de")  # long words of a name can be broken between their parts
    name = page.locator("header small").text_content()
    assert name.startswith("Taumel\u00adscheiben\u00adverdichter (Taumel\u00adscheiben\u00adkompressor)")
    assert errors == []
    browser.close()


HELD = """
const later = window.setTimeout;
let count = 0;
window.held = [];
window.setTimeout = (what, time, ...more) => (time || count++ < 12 ? later(what, time, ...more) : held.push(what));
let now = 0;
performance.now = () => (now += 60);
"""
"""A clock that goes on by 60 ms when it is read, and work in pieces that stops after a dozen of them."""


def test_plots_of_several_drives_grow_while_they_are_made(server, chromium):
    """What is known by then is there; how far an output goes is told when all is."""
    browser, page, errors = browsed_at(chromium, "about:blank", "body")
    page.emulate_media(reduced_motion="reduce")
    page.add_init_script(HELD)
    page.goto(server.address + "space/wobble_plate.html#en")  # with one drive: at once
    assert page.locator(".plot").count() == 7
    page.goto(server.address + "space/susp_rack.html#en")
    while not page.evaluate("held.length"):  # the policy forbids waiting within the page
        page.wait_for_timeout(50)
    total, curve = page.locator(".plot > svg > path.curve:first-child").all()[:2]
    assert total.get_attribute("d") == ""  # its sign is that of its farthest way
    assert page.locator('[data-panel="measures"]').get_by_text("…", exact=True).count() == 1
    wide = "d => { const x = d.match(/[ML][^ ]+/g).map((at) => +at.slice(1)); return x.at(-1) - x[0]; }"
    part = page.evaluate(wide, curve.get_attribute("d"))
    assert 10 < part < 200
    page.evaluate("async () => { for (let next; (next = held.shift()); ) next(); }")
    for whole in page.locator(".plot > svg > path.curve:first-child").all()[:2]:
        assert page.evaluate(wide, whole.get_attribute("d")) == pytest.approx(246, abs=7)  # of 300, beside the numbers
    arrow = page.locator(".stage path.driven")  # that of the drive that moves
    before = arrow.get_attribute("d")
    page.locator(".transport select").select_option(index=1)
    assert arrow.get_attribute("d") != before
    assert errors == []
    browser.close()


def test_a_machine_without_a_drive_leads_to_the_one_with_it(server, chromium):
    """And all have the header of the other views: what cannot be undone has its button too."""
    browser, page, errors = browsed_at(chromium, server.address + "space/susp_5link.html#de")
    page.get_by_text("Es ist beweglich, hat hier aber keinen Antrieb.").wait_for()
    page.get_by_role("link", name=entry("susp_5link_lift").name.in_language("de")).click()
    page.wait_for_url("**/space/susp_5link_lift.html#de")
    page.locator(".plot").first.wait_for()
    assert page.get_by_text("keinen Antrieb").count() == 0
    page.goto(server.address + "space/diff_bevel.html#en")
    for name in ("Undo", "Redo"):
        assert page.get_by_role("button", name=name).is_disabled()
    assert errors == []
    browser.close()


def test_what_has_no_size_is_not_offered_and_glass_is_a_body_too(server, chromium):
    browser, page, errors = browsed_at(chromium, server.address + "space/wobble_plate.html#en")
    labels = page.locator('[data-panel="sizes"] label').all_inner_texts()
    assert labels == ["shaft, angle", "rod 1", "rod 2", "rod 3"]  # not how far axes that meet are apart
    page.set_viewport_size({"width": 1440, "height": 900})
    page.goto(server.address + "space/cardan_shaft.html#en")
    labels = page.locator('[data-panel="sizes"] label').all_inner_texts()
    assert labels == ["frame", "Twist angle", "shaft"]  # the axes of the two ends go through the crosses
    said = page.locator('[data-panel="sizes"] .note')
    assert said.inner_text() == "Between two axes their distance and twist angle, otherwise the distance alone."
    page.evaluate("gruebler.scene.shown.floor = false")
    picture = page.locator(".stage").bounding_box()
    ends = np.array(page.locator("line.axis").evaluate_all(ENDS))
    corner = {  # from the lower left corner of the picture: its shaft ends in the upper left one
        "x": float(ends[:, :2].min()),
        "y": picture["height"] - float(ends[:, 2:].max()),
        "width": float(np.ptp(ends[:, :2])),
        "height": float(np.ptp(ends[:, 2:])),
    }
    assert page.evaluate(DRAWN, [corner])
    page.goto(server.address + "space/bennett.html#en")
    assert said.inner_text() == "Distance and twist angle between the two axes of a link."
    page.goto(server.address + "space/winch_screw.html#en")
    assert page.locator('[data-panel="sizes"]').count() == 0
    page.set_viewport_size({"width": 1024, "height": 768})
    page.emulate_media(reduced_motion="reduce")
    page.goto(server.address + "space/schatz.html#en")
    for step in range(100):  # until the picture is fitted
        page.mouse.move(430 + step % 2, 340)  # beside the bar in the vessel
        if page.locator(".stage").get_attribute("title") == "vessel":
            break
    else:
        raise AssertionError("the vessel is not found")
    assert errors == []
    browser.close()
