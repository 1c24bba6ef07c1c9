"""The page in a real browser: every view is walked through, machines are played, dragged, shared."""

import base64
import json
import re
import zlib

import numpy as np
import pytest
from msgspec import to_builtins

from gruebler.cli import main
from gruebler.files import linkage_from_json, linkage_to_json
from gruebler.mechanics.analysis.measuring import measures
from gruebler.mechanics.fourbar import FourBar
from gruebler.page.links import VERSION, read_link
from gruebler.page.model import model_of
from gruebler.teaching.catalog import entries

LEAST = "gruebler.motion.found.least.mu"
FOUND = "JSON.stringify([gruebler.motion.found.least?.mu, gruebler.motion.found.travel, gruebler.motion.found.dead])"
CURVE = "JSON.stringify(Array.from(gruebler.motion.linkage.cycle.rows.places.slice(0, 4000)))"


def link_of(shared):
    """The text behind # of a linkage: version, packed document, checksum."""
    packer = zlib.compressobj(9, wbits=-15)
    packed = packer.compress(json.dumps(shared).encode()) + packer.flush()
    data = base64.urlsafe_b64encode(packed).rstrip(b"=").decode("ascii")
    return f"{VERSION}.{data}.{zlib.crc32(packed):08x}"


@pytest.fixture(scope="module")
def single_file(tmp_path_factory):
    path = tmp_path_factory.mktemp("page") / "lambda.html"
    assert main(["explore", "lambda", "-o", str(path)]) == 0
    return path


def test_the_single_file_is_small_moves_and_asks_for_nothing(tab, single_file):
    assert single_file.stat().st_size < 320_000  # the script has a limit of its own
    page = tab().open(single_file.as_uri())
    assert page.requests == [single_file.as_uri()]
    drive = page.page.evaluate("gruebler.motion.linkage.drives[0]")
    page.page.keyboard.press("Space")
    page.page.wait_for_timeout(500)
    page.page.keyboard.press("Space")
    assert abs(page.page.evaluate("gruebler.motion.linkage.drives[0]") - drive) > 0.05
    before, curve = page.page.evaluate(LEAST), page.page.evaluate(CURVE)
    place = page.middle('[data-joint="R(coupler-rocker)"] .joint')
    page.drag(place, (-60, 20), (-140, 10))
    after = page.page.evaluate(LEAST)
    assert abs(after - before) > 0.01
    assert page.page.evaluate(CURVE) != curve
    end = page.middle('[data-joint="R(coupler-rocker)"] .joint')
    assert end == pytest.approx((place[0] - 200, place[1] + 30), abs=2)
    # what the page shows of the dragged linkage is what the library finds of it
    dragged = linkage_from_json(json.loads(page.page.evaluate("JSON.stringify(gruebler.motion.document())")))
    found = measures(dragged).transmission
    assert found is not None
    assert found.smallest.mu == pytest.approx(after, abs=1e-6)
    page.page.keyboard.press("Control+z")
    assert page.page.evaluate(LEAST) == pytest.approx(before, abs=1e-9)
    page.page.keyboard.press("Control+y")
    assert page.page.evaluate(LEAST) == pytest.approx(after, abs=1e-9)
    assert page.requests == [single_file.as_uri()]


def test_joints_lengths_and_points_without_a_mouse(tab, single_file):
    page = tab(width=360, height=740, locale="de-DE", scheme="dark").open(single_file.as_uri())
    assert page.page.evaluate("document.documentElement.scrollWidth") <= 360
    assert "Kenngrößen" in page.page.locator("summary").first.inner_text()
    before = page.page.evaluate(LEAST)
    page.page.locator('[data-joint="R(coupler-rocker)"]').focus()
    for _ in range(4):
        page.page.keyboard.press("ArrowUp")
    assert page.page.evaluate(LEAST) != pytest.approx(before, abs=1e-4)
    field = page.page.locator('[data-panel="sizes"] input').nth(1)
    field.fill("22,5")
    field.press("Enter")
    crank = page.page.evaluate("gruebler.motion.dragging.lengths()[1].value")
    assert crank == pytest.approx(22.5)
    field.fill("-3")
    field.press("Enter")
    assert field.get_attribute("aria-invalid") == "true"
    field.fill("500")
    field.press("Enter")
    assert "in keiner Stellung des Antriebs" in page.page.locator(".message").inner_text()
    assert page.page.evaluate("gruebler.motion.dragging.lengths()[1].value") == pytest.approx(22.5)
    page.page.locator('[aria-label^="Koppelpunkt"]').click()
    for _ in range(2):  # the link, then the place
        page.page.mouse.click(*page.middle('[data-joint="R(crank-coupler)"] .joint'))
    assert page.page.evaluate("gruebler.motion.linkage.sizes.points.length") == 2


def test_where_the_range_ends_the_page_says_why(tab, tmp_path):
    path = tmp_path / "rocker.html"
    assert main(["explore", "four-bar:50,70,40,70", "-o", str(path)]) == 0
    page = tab().open(path.as_uri())
    low, high = page.page.evaluate("[gruebler.motion.linkage.cycle.low, gruebler.motion.linkage.cycle.high]")
    from gruebler.mechanics.kinematics import move

    end = move(FourBar(50, 70, 40, 70).linkage(), np.radians(np.arange(60, 361)))
    assert end.stop is not None
    assert high == pytest.approx(end.stop.drives[0], abs=1e-9)
    assert low == pytest.approx(measures(FourBar(50, 70, 40, 70).linkage()).span.low, abs=1e-9)
    box = page.page.locator(".track").bounding_box()
    page.drag((box["x"] + 40, box["y"] + 17), (box["width"] - 50, 0))
    said = f"The motion ends at {np.degrees(high):.4g}°: there the joints of coupler and driven crank no longer meet."
    assert page.page.locator(".message span").inner_text() == said


PLOTTED = """(() => {
    const { drives, series } = gruebler.motion.plots.parts[0].plot;
    return { drives: [...drives], values: [...series.values] };
})()"""
OUTPUT = "gruebler.root.querySelector('.facts dd').textContent"


@pytest.mark.parametrize(("lengths", "start"), [("25,70,40,70", 45), ("25,70,40,70", 200), ("70,70,60,70", 30)])
def test_output_angles_are_told_in_the_lap_in_which_they_are_plotted(tab, tmp_path, lengths, start):
    """After every change the value beside the plot is on it, and dead centres and range are those of the library."""
    path = tmp_path / "quad.html"
    assert main(["explore", f"four-bar:{lengths}", "-o", str(path)]) == 0
    page = tab().open(path.as_uri())
    for way in ((-120, -160), (-60, 260), (250, 120)):
        page.page.evaluate(f"gruebler.motion.transport.pick({np.radians(start)})")
        page.drag(page.middle('[data-joint="R(frame-rocker)"] .joint'), way)
        plotted = page.page.evaluate(PLOTTED)
        drives, values = np.array(plotted["drives"]), np.array(plotted["values"])
        cycle = "gruebler.motion.linkage.cycle"
        document = json.loads(
            page.page.evaluate(f"JSON.stringify(gruebler.motion.document({cycle}.rows, {cycle}.home))")
        )
        found = measures(linkage_from_json(document))
        full, *ends = page.page.evaluate(f"[{cycle}.full, {cycle}.low, {cycle}.high]")
        assert full == found.span.full
        if not found.span.full:
            assert ends == pytest.approx([found.span.low, found.span.high], abs=1e-5)
        for centre in found.dead_centres:
            assert np.interp(centre.drive, drives, values) == pytest.approx(np.degrees(centre.output), abs=0.5)
        low, high = drives[0], drives[-1]
        for part in (0.1, 0.35, 0.6, 0.85):
            drive = low + part * (high - low)
            page.page.evaluate(f"gruebler.motion.transport.pick({drive})")
            told = float(page.page.evaluate(OUTPUT).strip("°").replace("−", "-"))
            assert told == pytest.approx(np.interp(drive, drives, values), abs=1), (way, part)


def test_a_link_is_the_same_linkage_elsewhere(tab, single_file):
    page = tab().open(single_file.as_uri())
    page.drag(page.middle('[data-joint="R(crank-coupler)"] .joint'), (30, -25))
    page.page.wait_for_timeout(400)
    address = page.page.evaluate("location.href")
    assert re.search(r"#1\.[\w-]+\.[0-9a-f]{8}$", address)
    other = tab().open(address)
    other.until("gruebler.motion.document().elements !== undefined")
    other.page.wait_for_timeout(300)
    sizes = "gruebler.motion.dragging.lengths().map((one) => one.value)"
    assert other.page.evaluate(sizes) == pytest.approx(page.page.evaluate(sizes), rel=1e-12)
    assert other.page.evaluate("gruebler.motion.linkage.drives[0]") == pytest.approx(
        page.page.evaluate("gruebler.motion.linkage.drives[0]"), abs=1e-9
    )
    # Python reads it, and writes what the page reads
    shared = read_link(address)
    linkage = linkage_from_json(shared.document)
    assert linkage.length("crank", 0, 1) == pytest.approx(page.page.evaluate(sizes)[1], rel=1e-12)
    again = link_of({**to_builtins(shared), "document": linkage_to_json(linkage)})
    third = tab().open(f"{single_file.as_uri()}#{again}")
    third.page.wait_for_timeout(400)
    assert third.page.evaluate(sizes) == pytest.approx(page.page.evaluate(sizes), rel=1e-12)
    for wrong, words in (
        (address[:-1] + ("0" if address[-1] != "0" else "1"), "damaged"),
        (address.replace("#1.", "#2."), "newer"),
        (address[:-9], "not complete"),
    ):
        page.page.goto("about:blank")
        page.page.goto(wrong)
        page.until("window.gruebler?.motion?.linkage !== undefined")
        page.page.wait_for_timeout(300)
        assert words in page.page.locator(".message").inner_text()


def test_from_a_chain_to_a_moving_mechanism(tab, server):
    """The Watt chain out of the six-link ones, a slider in it, dimensions, a drag, the link in a new page."""
    page = tab().open(server.address)
    view = page.page
    view.click('[data-view="structure"]')
    view.locator("[data-chain]").wait_for()  # that of the four-bar at hand
    view.locator('[data-page="structure"] input[type="number"]').first.fill("6")
    view.locator('[data-page="structure"] input[type="number"]').first.press("Enter")
    view.locator("[data-chain]").nth(1).wait_for()
    assert view.locator("[data-chain]").count() == 2
    view.locator('[data-list="inversions"] .card span:text-is("Watt II")').wait_for()  # the first chain is chosen
    assert view.locator("[data-chain]").evaluate_all("all => all.map((e) => e.ariaPressed)") == ["true", "false"]
    assert "n\N{NO-BREAK SPACE}=\N{NO-BREAK SPACE}6" in view.locator(".described").inner_text()
    # Watt's chain: a ternary or a binary frame, each with two joints that no symmetry exchanges
    frames, drives = (view.locator(f'[data-list="{key}"] .card') for key in ("inversions", "driven"))
    assert frames.locator("b").all_text_contents() == ["Frame 1", "Frame 3"]
    # the page chooses the first of each, and marks it
    pressed = "all => all.map((e) => e.ariaPressed)"
    assert [cards.evaluate_all(pressed) for cards in (frames, drives)] == [["true", "false"]] * 2
    for number in (1, 0):
        frames.nth(number).click()
        view.locator(f'[data-list="inversions"] .card:nth-child({number + 1})[aria-pressed="true"]').wait_for()
        assert drives.count() == 2
        numbers = frames.nth(number).locator("svg text").all_text_contents()
        assert sorted(numbers) == list("123456")
        assert frames.locator("b").nth(number).inner_text().removeprefix("Frame ") in numbers
    drives.nth(1).click()
    page.until("gruebler.views.structure.text.includes('drive=')")
    view.locator('[data-list="driven"] [aria-pressed="true"]').wait_for()
    assert [frame.get_attribute("aria-pressed") for frame in frames.all()] == ["true", "false"]
    names = view.locator(".chain-picture [data-joint]").evaluate_all("all => all.map((e) => e.dataset.joint)")
    frame = re.search(r"frame=(\w+)", view.locator('[data-field="chain"]').input_value())[1]
    driven = re.search(r"drive=(\S+)", view.locator('[data-field="chain"]').input_value())[1]
    joint = next(name for name in names if name != driven and re.search(rf"\b{frame}\b", name))
    view.locator(f'.chain-picture [data-joint="{joint}"]').click()
    view.locator('[data-type="P"]').click()
    view.locator('.chain-picture [data-joint^="P("]').first.wait_for()
    assert view.locator('[data-fact="counted"]').inner_text() == "F = 1"
    view.locator('[data-act="realise"]').click()
    page.until("gruebler.motion.linkage.model.joints.some((joint) => joint.pair.sliding)", 60)
    view.wait_for_timeout(300)
    before, curve = view.evaluate(FOUND), view.evaluate(CURVE)
    joints = view.evaluate(
        "gruebler.motion.linkage.model.joints.flatMap((j, k) => gruebler.motion.dragging.draggable(k) ? [j.name] : [])"
    )
    page.drag(page.middle(f'.stage [data-joint="{joints[-1]}"] .joint'), (0, -20), (8, -10))
    assert view.evaluate(CURVE) != curve
    after = view.evaluate(FOUND)
    assert after != before
    view.wait_for_timeout(400)
    other = tab().open(view.evaluate("location.href"))
    other.until("gruebler.motion.linkage.model.joints.some((joint) => joint.pair.sliding)", 60)
    sizes = "gruebler.motion.dragging.lengths().map((one) => one.value)"
    assert other.page.evaluate(sizes) == pytest.approx(view.evaluate(sizes), rel=1e-9)


def test_errors_of_a_text_stand_at_their_place(tab, server):
    page = tab(locale="de-DE").open(server.address)
    page.page.click('[data-view="structure"]')
    page.page.locator('[data-fact="counted"]').wait_for()
    page.page.locator('[data-page="structure"] summary').click()
    field = page.page.locator('[data-field="chain"]')
    field.fill("R(0-1) R(1-2")
    page.page.locator(".error .place").wait_for()
    assert field.get_attribute("aria-invalid") == "true"
    before = page.page.locator('.described, [data-act="realise"]')  # of the text before, not of what is typed
    assert all("asking" in names for names in before.evaluate_all("all => all.map((e) => e.className)"))
    field.fill("R(0-1) R(1-2) R(2-3) R(3-0) R(0-2) R(3-4) R(4-5) R(5-6) R(6-7) R(7-3)")
    page.page.locator("[data-strained]").first.wait_for()
    strained = page.page.locator("[data-strained]").evaluate_all("all => all.map((e) => e.dataset.strained)")
    assert set(strained) >= {"0", "1", "2", "3"}
    assert not page.page.locator(".described.asking").count()
    numbers = page.page.locator('[data-page="structure"] input[type="number"]')
    field.fill("R(0-1) R(0-2) R(0-3) R(1-4) R(2-4) R(3-4)")  # three links between two: n = 5, F = 3·4 - 2·6 = 0
    page.page.locator('.facts [data-fact="counted"]', has_text="F = 0").wait_for()
    assert numbers.evaluate_all("all => all.map((e) => e.value)") == ["5", "0"]
    page.page.locator('[data-of][aria-pressed="true"]').wait_for()
    assert "Viergelenk" not in page.page.locator(".chains").inner_text()


@pytest.mark.parametrize("step", [pytest.param(1, marks=pytest.mark.slow), 5])
def test_every_planar_machine_plays_without_an_error(tab, single_file, step):
    page = tab().open(single_file.as_uri())
    machines = [e for e in entries().values() if e.dimensions is not None and e.space == "planar"][::step]
    pose = "JSON.stringify([...gruebler.motion.linkage.pose.turns, ...gruebler.motion.linkage.pose.places])"
    for machine in machines:
        page.page.evaluate("(model) => gruebler.open(model)", model_of(machine.linkage(), name=machine.name))
        page.page.evaluate(f"window.before = {pose}")
        if machine.linkage().mechanism.drives:
            page.until(f"{pose} !== window.before")
        else:
            page.page.wait_for_timeout(120)
            assert page.page.evaluate(f"{pose} === window.before"), machine.id
        page.page.evaluate("gruebler.motion.transport.pause()")
        assert page.errors == [], machine.id
    assert len(machines) * step >= 61


def test_a_ring_is_filled_between_its_lines(tab, single_file):
    page = tab().open(single_file.as_uri())
    page.page.evaluate("(model) => gruebler.open(model)", model_of(entries()["diff"].linkage()))
    filled = page.page.evaluate(
        """() => {
        const ring = gruebler.root.querySelector('.stage [data-link="ring_gear"] .shape.area');
        const { x, y, width, height } = ring.getBBox();
        // radii 60 and 62.08: the rim is 1.7 % of the width
        const at = (part) => ring.isPointInFill(new DOMPoint(x + part * width, y + height / 2));
        return [at(0.5), at(0.008), getComputedStyle(ring).fillRule, gruebler.motion.picture().includes('"evenodd"')];
        }"""
    )
    assert filled == [False, True, "evenodd", True]


def test_machines_with_the_word_in_their_name_come_first(tab, server):
    """The other description alone has it: Hart's inversor was first for Peaucellier."""
    page = tab().open(server.address)
    page.page.click('[data-view="catalog"]')
    for words, ids in (("peaucellier", ["peaucellier", "hart"]), ("slotted lever", ["kurbelschleife", "conchoid"])):
        page.page.locator('[data-field="words"]').fill(words)
        shown = (
            "[...gruebler.root.querySelectorAll('[data-list=catalog] .card')].slice(0, 2).map((one) => one.dataset.id)"
        )
        page.until(f"{shown}.join() === '{','.join(ids)}'")


def test_the_catalog_and_the_exercises(tab, server):
    page = tab(locale="de-DE").open(server.address)
    view = page.page
    view.click('[data-view="catalog"]')
    view.locator('[data-list="catalog"] .card svg').first.wait_for()
    view.locator('[data-field="words"]').fill("wiper")
    view.locator('[data-id="wiper"]').wait_for()
    page.until("gruebler.root.querySelectorAll('[data-page=catalog] .card').length === 3")
    card = view.locator('[data-id="wiper"]')
    card.locator("svg").wait_for()
    for begin, end in ((card.hover, lambda: view.mouse.move(5, 400)), (card.focus, card.blur)):
        begin()
        card.locator("animateTransform").first.wait_for(state="attached")
        link = card.locator("g:has(> animateTransform)").first
        before = link.bounding_box()
        view.wait_for_timeout(300)
        assert link.bounding_box() != before
        end()
        card.locator("animateTransform").first.wait_for(state="detached")
        assert card.locator("svg").count() == 1
    card.click()
    page.until("gruebler.motion.linkage.model.source === 'wiper'")
    assert "Scheibenwischer" in view.locator("header h1").inner_text().replace("\xad", "")
    view.go_back()
    view.locator('[data-field="words"]').fill("")
    view.locator('[data-value="cam"]').click()
    page.until("gruebler.root.querySelectorAll('[data-page=catalog] .card').length === 4")
    assert all("Kurve" in name for name in view.locator('[data-list="catalog"] b').all_text_contents())
    assert view.locator('[data-value="cam"]').get_attribute("aria-pressed") == "true"
    view.click('[data-view="exercises"]')
    view.locator("[data-answer]").first.wait_for()
    from gruebler.teaching.exercises import ascii_key, generate, solve

    kind, level, seed = view.evaluate("(({kind, level, seed}) => [kind, level, seed])(gruebler.views.exercises)")
    task = generate(kind, seed, level)
    answers = [str(solve(task).results[asked.key].value) for asked in task.asked]
    keys = [ascii_key(asked.key) for asked in task.asked]
    for key, answer in zip(keys, answers, strict=True):
        view.locator(f'[data-answer="{key}"]').fill(answer)
    view.locator(f'[data-answer="{keys[0]}"]').fill("1000")
    view.locator('[data-act="mark"]').click()
    view.locator("[data-mark]").nth(len(keys) - 1).wait_for()
    marks = view.locator("[data-mark]").evaluate_all("all => all.map((e) => e.dataset.mark)")
    assert marks == ["wrong"] + ["right"] * (len(keys) - 1)


def opened(tab, server, id_):
    """The page with a machine of the catalog in motion."""
    page = tab().open(server.address)
    page.page.click('[data-view="catalog"]')
    page.page.locator(f'[data-id="{id_}"]').click()
    page.until(f"gruebler.view === 'motion' && gruebler.motion.linkage.model.source === '{id_}'")
    return page


@pytest.mark.parametrize(("id_", "range_"), [("crane", "from 60° to 80°"), ("bolt_cutter", "from 46° to 82°")])
def test_what_is_said_in_words_holds_for_the_range_in_which_a_machine_is_used(tab, server, id_, range_):
    """As their entries have it, although the crane could turn from 54° to 115°, the handle of the cutter fully."""
    page = opened(tab, server, id_)
    page.page.locator('[data-panel="measures"] summary:text-is("In words")').click()
    words = page.page.locator('[data-panel="measures"] .note')
    words.filter(has_text=range_).wait_for()
    facts = page.page.locator(".facts > div").evaluate_all(
        "all => all.map((one) => ['dt', 'dd'].map((part) => one.querySelector(part).firstChild.textContent))"
    )
    said = words.first.inner_text()
    assert " ".join(dict(facts)["Range of the drive"].split(" … ")) == range_[5:].replace(" to", "")
    for name in ("Swing", "Smallest μ"):  # as the page measures them by itself
        assert f" {dict(facts)[name]}" in said


def test_what_is_drawn_on_links_is_in_the_picture(tab, server):
    """The handles of the pliers reach far beyond their joints."""
    page = opened(tab, server, "pliers")
    page.page.evaluate("gruebler.motion.transport.pause()")
    stage = page.page.locator(".motion > .stage").bounding_box()
    shapes = [shape.bounding_box() for shape in page.page.locator(".motion > .stage .shape").all()]
    assert len(shapes) > 1
    for shape in shapes:
        assert stage["x"] < shape["x"]
        assert shape["x"] + shape["width"] < stage["x"] + stage["width"]
        assert stage["y"] < shape["y"]
        assert shape["y"] + shape["height"] < stage["y"] + stage["height"]


@pytest.mark.parametrize("id_", ["peaucellier", "hart"])
def test_words_and_measures_name_one_link_where_several_are_as_bad(tab, server, id_):
    """By symmetry; both take the first by name."""
    page = opened(tab, server, id_)
    page.page.locator('[data-panel="measures"] summary:text-is("In words")').click()
    words = page.page.locator('[data-panel="measures"] .words .note')
    words.filter(has_text="ransmission").wait_for()
    measured = page.page.locator('.facts > div:has(dt:text-is("Smallest μ"))').inner_text()
    (link,) = re.findall(r"bar ?\d", measured.replace("\xa0", " "))
    assert f"(link {link}" in words.first.inner_text()


def test_words_of_another_machine_or_size_do_not_stand_as_if_they_held(tab, server):
    page = tab().open(server.address)
    page.page.locator('[data-panel="measures"] summary:text-is("In words")').click()
    words = page.page.locator('[data-panel="measures"] .words .note')
    words.filter(has_text="output").wait_for()
    page.until("!gruebler.root.querySelector('[data-panel=\"measures\"] .words .waiting')")
    page.page.evaluate(  # from now on there is no answer
        """() => {
            const { page } = gruebler.motion;
            const ask = page.ask.bind(page);
            page.ask = (method, ...more) => (method === "measures" ? new Promise(() => {}) : ask(method, ...more));
        }"""
    )
    page.page.evaluate("gruebler.motion.transport.pause()")
    x, y = page.middle('[data-joint="R(coupler-rocker)"] .joint')
    page.page.mouse.move(x, y)
    page.page.mouse.down()
    page.page.mouse.move(x + 10, y + 5, steps=4)
    page.until("gruebler.root.querySelector('[data-panel=\"measures\"] .words .waiting')")
    assert "output" in words.inner_text()  # it keeps its room
    page.page.mouse.up()
    page.page.click('[data-view="catalog"]')
    page.page.locator('[data-id="crane"]').click()
    page.until("gruebler.view === 'motion' && gruebler.motion.linkage.model.source === 'crane'")
    page.until("gruebler.root.querySelector('[data-panel=\"measures\"] .words .note')?.textContent === '…'")


def test_a_server_that_goes_and_comes_back(tab, server):
    page = tab().open(server.address)
    page.until("gruebler.model.socket !== null")
    server.kill()
    page.until("!gruebler.lost.hidden")
    assert "connection" in page.page.locator(".lost").inner_text()
    page.drag(page.middle('[data-joint="R(coupler-rocker)"] .joint'), (25, 10))
    sizes = page.page.evaluate("gruebler.motion.dragging.lengths().map((one) => one.value)")
    page.page.evaluate("void gruebler.ask('catalog', {words: 'wiper'}).then((found) => (window.late = found))")
    given_up = """() => {
        const request = gruebler.ask("catalog", {words: "hood"});
        request.catch(() => (window.given_up = true));
        request.cancel();
    }"""
    page.page.evaluate(given_up)
    page.until("window.given_up")  # though there is no server that could say so
    server.start()
    assert page.until("window.late")[0]["id"] == "wiper"
    page.until("gruebler.lost.hidden")
    assert page.page.evaluate("gruebler.motion.dragging.lengths().map((one) => one.value)") == sizes
    page.errors[:] = [e for e in page.errors if "WebSocket" not in e]


def test_the_catalog_is_searched_by_access_features(tab, server):
    from gruebler.page.requests import answer

    page = tab(locale="de-DE").open(server.address)
    page.page.click('[data-view="catalog"]')
    page.page.locator('[data-list="catalog"] .card').nth(60).wait_for()
    page.page.locator('[data-panel="features"] summary').click()
    panel = page.page.locator('[data-panel="features"]')
    panel.get_by_label("ternär (3 Gelenke)").select_option("2")
    panel.get_by_label("Drehgelenke").select_option("7")
    assert panel.locator("summary").inner_text() == "Weitere Filter (2)"
    wanted = [one["id"] for one in answer("catalog", {"ternary": 2, "joints": "R:7"}, "en", print)]
    assert len(wanted) > 1
    root = "document.querySelector('.gruebler-explorer').shadowRoot"
    page.until(f"{root}.querySelectorAll('[data-id]').length === {len(wanted)}")
    cards = page.page.locator("[data-id]")
    assert sorted(cards.evaluate_all("all => all.map((e) => e.dataset.id)")) == sorted(wanted)
    names = cards.locator("b").all_text_contents()
    assert names == sorted(names)  # all begin with a capital letter without dots
    panel.get_by_label("ternär (3 Gelenke)").select_option("")
    panel.get_by_label("Drehgelenke").select_option(label="mindestens 1")
    panel.get_by_label("Kugelgelenke").select_option("2")
    ids = f"[...{root}.querySelectorAll('[data-id]')].map(({{ dataset }}) => dataset.id).sort().join()"
    page.until(f"{ids} === 'cargo_bike,wiper_rssr'")  # an RSSR each, the tie rod and the coupler between two balls
    # what is counted stands above how many of them are at the frame; all is cleared at once
    for whole in ("drive_joints", "output_links"):
        above, below = (
            page.page.locator(f'[data-field="{name}"]').bounding_box() for name in (whole, f"{whole}_at_frame")
        )
        assert below["x"] == above["x"]
        assert above["y"] < below["y"] < above["y"] + 60
    panel.get_by_label("Kugelgelenke").select_option("")
    panel.get_by_label("Drehgelenke").select_option("")
    panel.get_by_label("Laufgrad, gezählt").select_option(label="−7")
    page.until(f"{ids} === 'car_door'")
    page.page.click('[data-panel="features"] [data-act="clear"]')
    fields = page.page.locator('[data-page="catalog"] :is(input, select)')
    assert set(fields.evaluate_all("all => all.map((one) => one.value)")) == {""}
    assert panel.locator("summary").inner_text() == "Weitere Filter"
    page.page.locator('[data-field="words"]').fill("zzzz")
    page.page.get_by_role("button", name="Alle zeigen").click()
    page.until(f"{root}.querySelectorAll('[data-id]').length === {len(answer('catalog', {}, 'de', print))}")
    assert set(fields.evaluate_all("all => all.map((one) => one.value)")) == {""}


def test_a_four_bar_through_points_that_are_clicked(tab, server):
    """Points of a curve that a known four-bar traces; a design is opened and traces them too."""
    known = FourBar(25, 70, 40, 70).linkage({"K": (45, 40)})
    from gruebler.mechanics.kinematics import move

    traced = move(known, np.linspace(0, 2 * np.pi, 12, endpoint=False)).point("K") - (45, 55)
    page = tab().open(server.address)
    page.page.click('[data-view="synthesis"]')
    for x, y in traced:
        page.page.mouse.click(*page.target(x, y))
    assert page.page.locator("[data-point]").count() == 12
    page.page.locator(".points summary, summary:has-text('Points · 12')").first.click()  # many are folded
    field = page.page.locator('[aria-label="Point 1 x [mm]"]')
    assert float(field.input_value().replace("\N{MINUS SIGN}", "-")) == pytest.approx(traced[0, 0], abs=0.5)
    field.fill(f"{traced[0, 0]:.3f}")
    field.press("Enter")
    page.page.locator('[data-field="closed"]').check()
    page.page.locator('[data-field="least"]').fill("10")
    begin_and_cancel = """() => {
        const root = document.querySelector(".gruebler-explorer").shadowRoot;
        for (const act of ["synthesise", "cancel"]) root.querySelector(`[data-act="${act}"]`).click();
    }"""
    # The answer may be there before the wish to cancel is read: again then.
    for attempt in range(800):
        text = page.page.locator('[data-page="synthesis"]').text_content()
        if "Cancelled." in text:
            break
        if attempt % 200 == 0 or not page.page.evaluate("gruebler.model.pending.size"):
            page.page.evaluate(begin_and_cancel)
        page.page.wait_for_timeout(50)
    assert "Cancelled." in text, text
    page.page.click('[data-act="synthesise"]')
    page.page.locator('[data-list="designs"] .card').first.wait_for(timeout=100_000)
    page.page.locator('[data-list="designs"] .card').first.click()
    page.until("gruebler.motion.linkage.model.name.startsWith('Points: ')")
    document = json.loads(page.page.evaluate("JSON.stringify(gruebler.motion.document())"))
    design = linkage_from_json(document)
    (name,) = design.points
    path = move(design, np.linspace(0, 2 * np.pi, 721)).point(name)
    gaps = np.hypot(*(traced[:, None] - path[None]).transpose(2, 0, 1)).min(axis=1)
    assert gaps.max() < 2.0


def test_all_assembly_modes_of_a_larger_group(tab, server, tmp_path):
    """A six-bar of class III has six; each is taken by a click and is the library's."""
    from benchmarks.explorer import samples

    linkage = samples()["six-bar of class III"][0]
    page = tab().open(server.address)
    page.page.evaluate("(model) => { gruebler.open(model); gruebler.motion.transport.pause(); }", model_of(linkage))
    page.page.locator('[data-panel="modes"] summary').click()
    page.page.click('[data-act="modes"]')
    page.page.locator('[data-panel="modes"] [data-mode="1"]').wait_for()
    drive = page.page.evaluate("gruebler.motion.linkage.drives[0]")
    from gruebler.mechanics.kinematics import move
    from gruebler.mechanics.kinematics.solve import assembly_modes

    labels = assembly_modes(linkage, drive)
    shown = page.page.locator('[data-panel="modes"] [data-mode]')
    assert shown.evaluate_all("all => all.map((e) => e.dataset.mode)") == labels
    places = "gruebler.motion.linkage.model.joints.map((_, k) => gruebler.motion.linkage.jointAt(k))"
    for k, label in enumerate(labels):
        if k:
            page.page.click('[data-act="modes"]')
        page.page.locator(f'[data-panel="modes"] [data-mode="{label}"]').click()
        page.page.wait_for_timeout(200)
        motion = move(linkage, [drive], branch=label)
        wanted = [motion.point(name)[0] for name in linkage.mechanism.chain.joint_names()]
        np.testing.assert_allclose(page.page.evaluate(places), wanted, atol=1e-6 * linkage.size)


def test_drives_that_are_not_at_the_frame(tab, server):
    page = tab().open(server.address)
    page.page.click('[data-view="structure"]')
    page.page.locator('[data-list="driven"] .card').first.wait_for()
    assert page.page.locator('[data-list="driven"] .card').count() == 1
    page.page.locator('[data-field="elsewhere"]').check()
    page.page.locator('[data-list="driven"] .card').nth(1).wait_for()
    page.page.locator('[data-list="driven"] .card').nth(1).click()
    root = "document.querySelector('.gruebler-explorer').shadowRoot"
    page.until(f"{root}.querySelector('textarea').value.includes('drive=R(crank-coupler)')")
    page.page.click('[data-act="realise"]')
    page.until("gruebler.motion.linkage.drive?.name === 'R(crank-coupler)'", 60)


def test_links_have_the_names_of_the_language(tab, server):
    """In the picture, the sizes, what the library says and in messages; the document keeps its own."""
    page = tab(locale="de-DE").open(server.address)
    root = "document.querySelector('.gruebler-explorer').shadowRoot"
    side = f"""{root}.querySelector('[data-panel="sizes"]').closest('.side')"""
    page.until(f"{side}.textContent.includes('Der Abtrieb Schwinge schwingt')")
    names = page.page.locator(".stage text.name").all_text_contents()
    assert sorted(names) == ["Koppel", "Kurbel", "Schwinge"]
    rows = page.page.locator('[data-panel="sizes"] label')
    assert rows.nth(3).get_attribute("title") == "Schwinge: Koppel – Gestell"
    assert rows.all_inner_texts() == ["Gestell", "Kurbel", "Koppel", "Schwinge"]
    assert "rocker" in page.page.evaluate("JSON.stringify(gruebler.motion.document())")
    page.page.locator("header select").select_option("en")
    page.until(f"{side}.textContent.includes('The output rocker swings')")
    assert sorted(page.page.locator(".stage text.name").all_text_contents()) == ["coupler", "crank", "rocker"]


def test_the_commands_that_the_page_shows_run(tab, single_file, tmp_path, monkeypatch):
    page = tab().open(single_file.as_uri())
    page.page.locator('[data-icon="save"]').click()
    page.page.locator('[data-panel="export"] summary').click()
    commands = page.page.locator('[data-panel="export"] pre').nth(1).inner_text().splitlines()
    assert len(commands) == 2
    monkeypatch.chdir(tmp_path)
    for command in commands:
        program, *words = command.split()
        assert program == "gruebler"
        assert main(words) == 0
    assert list(tmp_path.glob("*.svg"))
