"""Sizes and points are changed in a browser: what was typed or dragged can be taken back, and nothing jumps."""

import io
import json
import math
import re

import numpy as np
import pytest

from gruebler.cli import main
from gruebler.files import linkage_from_json
from gruebler.mechanics.analysis.drive_cycles import drive_cycle
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.linkages import Linkage
from gruebler.page.model import model_of
from gruebler.page.page import single_file
from gruebler.structure.mechanism import Mechanism

ROOT = "document.querySelector('.gruebler-explorer').shadowRoot"
ACTIVE = f"{ROOT}.activeElement"
SIZES = "gruebler.motion.dragging.lengths().map((one) => one.value)"
POINTS = "gruebler.motion.linkage.sizes.points"
UNDOABLE = "gruebler.motion.undoable[0]"


@pytest.fixture(scope="module")
def crank_rocker(tmp_path_factory):
    path = tmp_path_factory.mktemp("page") / "crank-rocker.html"
    assert main(["explore", "crankrocker", "-o", str(path)]) == 0
    return path.as_uri()


def test_a_point_beside_the_coupler_is_put_dragged_typed_and_named(tab, crank_rocker):
    page = tab().open(crank_rocker)
    x, y = page.middle('[data-link="coupler"] .bar')
    page.page.mouse.dblclick(x, y - 70)
    coupler = "gruebler.motion.linkage.model.links.indexOf('coupler')"
    assert page.page.evaluate(f"[{POINTS}.length, {POINTS}[0].link === {coupler}]") == [1, True]
    assert page.middle('[data-mark="K1"] .dot') == pytest.approx((x, y - 70), abs=1.5)
    before = page.page.evaluate(SIZES)
    page.drag((x, y - 70), (40, -20))
    assert page.middle('[data-mark="K1"] .dot') == pytest.approx((x + 40, y - 90), abs=1.5)
    assert page.page.evaluate(SIZES) == before
    page.page.keyboard.press("Control+z")
    assert page.middle('[data-mark="K1"] .dot') == pytest.approx((x, y - 70), abs=1.5)
    page.page.locator('[data-field="point-x-0"]').fill("45")
    page.page.locator('[data-field="point-x-0"]').press("Tab")
    page.until(f"{ACTIVE}?.dataset.field === 'point-y-0'")
    page.until(f"{POINTS}[0].at[0] === 45")
    page.page.locator('[data-field="point-y-0"]').fill("40.5")
    page.page.locator('[data-field="point-y-0"]').press("Enter")
    page.until(f"{POINTS}[0].at[1] === 40.5")
    page.page.locator('[data-field="point-name-0"]').fill("coupler")
    page.page.locator('[data-field="point-name-0"]').press("Enter")
    page.until("!gruebler.message.hidden")  # a link has this name
    page.page.locator('[data-field="point-name-0"]').fill("tip")
    page.page.locator('[data-field="point-name-0"]').press("Enter")
    page.until(f"{POINTS}[0].name === 'tip'")
    document = json.loads(page.page.evaluate("JSON.stringify(gruebler.motion.document())"))
    point = linkage_from_json(document).points["tip"]
    assert (point.link, point.x, point.y) == ("coupler", 45, 40.5)


def test_a_point_without_a_mouse(tab, crank_rocker):
    page = tab().open(crank_rocker)
    page.page.locator('[data-panel="points"] summary').press("Enter")
    page.page.locator('[data-act="add-point"]').press("Enter")
    assert page.page.evaluate(f"{POINTS}.length") == 1
    field = page.page.locator('[data-field="point-name-0"]').bounding_box()
    assert 0 < field["y"] < 600  # in sight, though a plot more pushes its panel down
    before = page.middle('[data-mark="K1"] .dot')
    page.page.locator('[data-mark="K1"]').press("ArrowUp")
    after = page.middle('[data-mark="K1"] .dot')
    assert after[1] < before[1]
    assert after[0] == pytest.approx(before[0], abs=0.1)


def test_clicks_make_points_until_escape(tab, crank_rocker):
    page = tab().open(crank_rocker)
    adder = page.page.locator(".stage .tools [aria-pressed]")
    hint = page.page.locator(".stage .hint")
    x, y = page.middle('[data-link="coupler"] .bar')
    adder.click()
    assert adder.get_attribute("aria-pressed") == "true"
    page.page.mouse.click(x, y - 60)  # no link is there, and none is chosen
    assert page.page.evaluate(f"{POINTS}.length") == 0
    page.page.mouse.move(x, y)
    page.page.locator('[data-link="coupler"].hovered').wait_for(state="attached")
    page.page.mouse.click(x, y)
    assert "coupler" in hint.inner_text()
    assert page.page.evaluate(f"{POINTS}.length") == 0
    page.page.mouse.click(x, y - 60)
    assert page.middle('[data-mark="K1"] .dot') == pytest.approx((x, y - 60), abs=1.5)
    assert page.page.evaluate(f"gruebler.motion.linkage.model.links[{POINTS}[0].link]") == "coupler"
    page.page.keyboard.press("Escape")
    assert adder.get_attribute("aria-pressed") == "false"
    joint = page.middle('[data-joint="R(coupler-rocker)"] .joint')
    page.drag(joint, (8, 5))
    assert page.page.evaluate(f"{POINTS}.length") == 1


def test_a_link_is_chosen_by_a_click_and_shows_its_length(tab, crank_rocker):
    page = tab().open(crank_rocker)
    chosen = page.page.locator(".rows.sizes .chosen")
    page.page.mouse.click(*page.middle('[data-link="rocker"] .bar'))
    assert page.page.locator(".stage .hint").inner_text() == "rocker: 40 mm"
    assert chosen.all_inner_texts() == ["rocker"]
    assert page.page.locator(".link.chosen").get_attribute("data-link") == "rocker"
    page.page.keyboard.press("Escape")
    assert chosen.count() == page.page.locator(".link.chosen").count() == 0


def test_a_drag_is_given_up(tab, crank_rocker):
    page = tab().open(crank_rocker)
    sizes = page.page.evaluate(SIZES)
    joint = '[data-joint="R(coupler-rocker)"] .joint'
    for keys in ("Escape", "Control+z"):
        x, y = page.middle(joint)
        page.page.mouse.move(x, y)
        page.page.mouse.down()
        page.page.mouse.move(x + 30, y - 20, steps=4)
        page.until(f"JSON.stringify({SIZES}) !== '{json.dumps(sizes, separators=(',', ':'))}'")
        page.page.keyboard.press(keys)
        page.page.mouse.move(x + 60, y - 40, steps=4)
        page.page.mouse.up()
        page.page.wait_for_timeout(50)
        assert page.page.evaluate(SIZES) == sizes
        assert page.page.evaluate(UNDOABLE) is False
    page.drag(page.middle(joint), (20, -10))
    changed = page.page.evaluate(SIZES)
    assert changed != sizes
    x, y = page.middle(joint)
    page.page.mouse.move(x, y)
    page.page.mouse.down()
    page.page.mouse.move(x + 30, y + 20, steps=4)
    page.page.keyboard.press("Control+z")  # gives up this drag, not the one before
    page.page.mouse.up()
    assert page.page.evaluate(SIZES) == changed
    page.page.keyboard.press("Control+z")
    assert page.page.evaluate(SIZES) == sizes


def test_lengths_and_joints_are_kept_while_others_are_dragged(tab, crank_rocker):
    page = tab().open(crank_rocker)
    for number in (1, 2):  # crank and coupler
        page.page.locator('[data-lock="length"]').nth(number).click()
    page.page.mouse.dblclick(*page.middle('[data-joint="R(frame-crank)"] .joint'))
    page.page.locator('[data-joint="R(frame-rocker)"]').press("Enter")
    held = page.page.locator('[aria-pressed="true"][data-joint]')
    assert held.count() == 2
    joints = "[0, 3].map((joint) => gruebler.motion.linkage.jointAt(joint))"
    before = page.page.evaluate(joints)
    page.drag(page.middle('[data-joint="R(coupler-rocker)"] .joint'), (-40, -30))
    frame, crank, coupler, rocker = page.page.evaluate(SIZES)
    assert (frame, crank, coupler) == (70, 25, 70)
    assert rocker > 41
    assert page.page.evaluate(joints) == before
    page.page.keyboard.press("Control+z")
    assert page.page.evaluate(SIZES) == [70, 25, 70, 40]
    assert held.count() == 2


def test_a_direction_that_is_kept_stays_in_the_link_and_is_undone(tab, crank_rocker):
    page = tab().open(crank_rocker)
    page.page.locator('[data-lock="direction"]').first.click()
    page.page.locator('[data-joint="R(frame-crank)"]').press("Enter")
    locks = [["direction", "frame", "R(frame-crank)", "R(frame-rocker)"], ["joint", "R(frame-crank)"]]
    assert page.page.evaluate("gruebler.motion.document().page.locks") == locks
    page.page.keyboard.press("Control+z")
    assert page.page.evaluate("gruebler.motion.document().page.locks") == locks[:1]
    page.page.keyboard.press("Control+y")
    page.page.reload()  # at once, before the address is written
    page.until("window.gruebler?.motion?.linkage?.beside.locks")
    page.until(f"{ROOT}.querySelector('[data-lock=direction][aria-pressed=true]')")
    page.drag(page.middle('[data-joint="R(frame-rocker)"] .joint'), (40, -60))
    ends = page.page.evaluate("[0, 3].map((joint) => gruebler.motion.linkage.jointAt(joint))")
    assert ends[0] == [0, 0]
    scale = page.page.evaluate("gruebler.motion.stage.viewport.scale")
    assert ends[1] == pytest.approx([70 + 40 / scale, 0], rel=0.1, abs=1e-9)


def lengths(page) -> list[float]:
    return page.page.evaluate("gruebler.motion.dragging.lengths().map(({ value }) => value)")


def told(page) -> str:
    return page.page.locator(".message").inner_text()


def test_joints_of_a_link_are_not_dragged_onto_each_other(tab, crank_rocker):
    page = tab().open(crank_rocker)
    x, y = page.middle('[data-joint="R(coupler-rocker)"] .joint')
    u, v = page.middle('[data-joint="R(frame-rocker)"] .joint')
    page.drag((x, y), (u - x, v - y), steps=20)
    assert "Two joints of a link cannot lie in one place." in told(page)
    assert min(lengths(page)) > 0.07  # a thousandth of the linkage
    page.page.keyboard.press("Control+z")
    assert lengths(page) == pytest.approx([70, 25, 70, 40])
    field = page.page.locator(".rows.sizes input").nth(3)
    field.fill("0")
    field.press("Enter")
    assert "Two joints of a link cannot lie in one place." in told(page)
    for wrong in ("1e9", "-1", "long"):
        field.fill(wrong)
        field.press("Enter")
        assert "Expected a length of at least 0 and below 10⁹" in told(page)
        assert field.get_attribute("aria-invalid") == "true"


def test_a_length_that_fits_elsewhere_only_is_offered_there(tab, crank_rocker):
    """With the crank at 0.9 (51.57°) its end is 57.9 from the right bearing: coupler 15 and rocker 40 do not reach it.

    At 0° it is 45 away, which they do. The crank is there near the end of a turn from 1; the angle is told as plotted.
    """
    page = tab().open(crank_rocker)
    page.page.evaluate("gruebler.motion.linkage.moveTo(0.9)")
    assert page.page.evaluate("gruebler.motion.linkage.drives[0]") == pytest.approx(0.9 + 2 * math.pi)
    field = page.page.locator(".rows.sizes input").nth(2)
    field.fill("15")
    field.press("Enter")
    assert "the joints of coupler and rocker do not meet at 51.57" in told(page)
    assert lengths(page) == pytest.approx([70, 25, 70, 40])
    page.page.click('[data-act="elsewhere"]')
    assert lengths(page) == pytest.approx([70, 25, 15, 40])
    drive = page.page.evaluate("gruebler.motion.linkage.drives[0]")
    away = math.hypot(70 - 25 * math.cos(drive), 25 * math.sin(drive))
    assert 25 <= away <= 55
    page.page.keyboard.press("Escape")
    page.page.locator("h1").click()
    page.page.keyboard.press("Control+z")
    assert lengths(page) == pytest.approx([70, 25, 70, 40])
    field.fill("200")  # longer than the three others together: nowhere, and nothing is offered
    field.press("Enter")
    text = told(page)
    assert text.startswith("coupler 200 mm fits at no position of the drive, but coupler ")
    most = float(re.search(r"but coupler ([\d.]+) mm", text)[1])
    assert 130 < most <= 135  # 70 + 25 + 40, all in one line
    assert page.page.locator('[data-act="elsewhere"]').count() == 0
    assert page.page.evaluate("gruebler.motion.linkage.drives[0]") == pytest.approx(0.9)
    field.fill(str(most))
    field.press("Enter")
    page.page.click('[data-act="elsewhere"]')
    assert lengths(page) == pytest.approx([70, 25, most, 40])


def test_with_a_typed_size_all_of_the_motion_stays_in_sight_and_its_curve_round(tab, tmp_path):
    """The crank of the lambda mechanism three times as long: twice as far down, with steps of 50 pixels."""
    path = tmp_path / "lambda.html"
    assert main(["explore", "lambda", "-o", str(path)]) == 0
    page = tab().open(path.as_uri())
    page.page.evaluate("""() => {
        const { prototype } = CanvasRenderingContext2D;
        let here = [0, 0];
        window.straight = 0;
        for (const name of ["moveTo", "lineTo", "quadraticCurveTo"]) {
            const old = prototype[name];
            prototype[name] = function (...at) {
                const [x, y] = at.slice(-2);
                const far = Math.hypot(x - here[0], y - here[1]);
                if (name === "lineTo") window.straight = Math.max(window.straight, far);
                here = [x, y];
                return old.apply(this, at);
            };
        }
    }""")
    field = page.page.locator(".rows.sizes input").nth(1)
    field.fill("60")
    field.press("Enter")
    page.page.evaluate("window.straight = 0, gruebler.motion.transport.pick(1)")
    assert 0 < page.page.evaluate("window.straight") < 9  # pixels
    seen = """(() => {
        const { linkage: { cycle: { rows, values }, model, jointAt }, linkage, stage: { viewport } } = gruebler.motion;
        const all = Array.from(values, (_, row) => model.joints.map((_, joint) => linkage.jointAt(joint, rows, row)));
        return all.flat().map((at) => viewport.screen(...at)).every(([x, y]) =>
            x > 0 && x < viewport.width && y > 0 && y < viewport.height);
    })()"""
    assert page.page.evaluate(seen)
    page.page.locator(".tools button").nth(1).click()  # another part was chosen: it stays
    scale = page.page.evaluate("gruebler.motion.stage.viewport.scale")
    field.fill("20")
    field.press("Enter")
    assert page.page.evaluate("gruebler.motion.stage.viewport.scale") == scale


def test_the_drive_is_typed_and_walked_by_keys(tab, crank_rocker):
    page = tab().open(crank_rocker)
    drive = "gruebler.motion.linkage.drives[0] * 180 / Math.PI"
    field = page.page.locator(".transport .value")
    field.fill("123,5")
    field.press("Enter")
    assert page.page.evaluate(drive) == pytest.approx(123.5)
    assert field.input_value() == "123.5°"
    field.fill("far")
    field.press("Enter")
    assert field.input_value() == "123.5°"
    track = page.page.locator(".track")
    track.focus()
    page.page.keyboard.press("PageUp")
    assert page.page.evaluate(drive) == pytest.approx(153.5)
    assert track.get_attribute("aria-valuetext") == "153.5°"
    page.page.keyboard.press("ArrowDown")
    assert page.page.evaluate(drive) == pytest.approx(152.5)
    page.page.keyboard.press("Home")
    assert math.remainder(page.page.evaluate(drive), 360) == pytest.approx(0)  # perhaps a lap later
    page.page.keyboard.press("PageUp")
    page.page.keyboard.press("End")
    assert math.remainder(page.page.evaluate(drive), 360) == pytest.approx(0)
    # the row of the drive comes before the panel
    order = "[...gruebler.root.querySelector('.stage').parentElement.children].map((one) => one.className)"
    assert page.page.evaluate(order) == ["stage", "transport", "side"]


def test_a_page_that_is_loaded_again_shows_the_same_view(tab, server):
    page = tab(locale="de-DE").open(server.address)
    page.page.click('[data-view="catalog"]')
    page.page.locator('[data-list="catalog"] .card').first.wait_for()
    page.page.reload()
    page.until("window.gruebler?.view === 'catalog'")
    assert page.page.evaluate("document.documentElement.lang") == "de"
    assert page.page.evaluate("gruebler.motion.stage.root.getAttribute('aria-label')") == "Kurbelschwinge"


def test_what_was_done_is_undone_after_the_page_was_loaded_again(tab, server):
    page = tab().open(server.address)
    field = page.page.locator(".rows.sizes input").nth(1)
    for value in ("30", "35"):
        field.fill(value)
        field.press("Enter")
    page.page.locator(".lock").first.click()
    page.until("location.hash.length > 1 && sessionStorage.getItem('gruebler-undo')?.includes('[')")
    page.page.wait_for_timeout(300)
    page.page.reload()
    page.until(f"window.gruebler?.motion?.linkage && {UNDOABLE}")
    assert lengths(page) == pytest.approx([70, 35, 70, 40])
    page.page.locator("h1").click()
    for wanted in ([70, 35, 70, 40], [70, 30, 70, 40], [70, 25, 70, 40]):  # the lock, then the sizes
        page.page.keyboard.press("Control+z")
        assert lengths(page) == pytest.approx(wanted)
    assert page.page.evaluate(UNDOABLE) is False
    # another linkage does not take them
    page.page.goto("about:blank")
    page.open(server.address)
    assert page.page.evaluate(UNDOABLE) is False


def test_the_focus_stays_and_the_panel_does_not_jump(tab, server):
    page = tab(height=500).open(server.address)
    note = f"{ROOT}.querySelector('[data-panel=\"measures\"] .note').textContent"
    page.until(note)
    fields = page.page.locator('[data-panel="sizes"] input')
    fields.nth(1).evaluate("(field) => field.scrollIntoView({ block: 'center' })")  # the next one is in sight, too
    top = fields.nth(1).bounding_box()["y"]
    fields.nth(1).fill("26")
    fields.nth(1).press("Tab")
    assert page.page.evaluate(f"{ACTIVE}.id") == fields.nth(2).get_attribute("id")
    tops = [fields.nth(1).bounding_box()["y"]]
    for _ in range(12):
        page.page.wait_for_timeout(60)
        tops.append(fields.nth(1).bounding_box()["y"])
    assert max(abs(one - top) for one in tops) < 60, tops  # less than three lines: a sentence may be longer
    fields.nth(1).fill("27")
    fields.nth(1).press("Enter")
    assert page.page.evaluate(f"{ACTIVE}.id") == fields.nth(1).get_attribute("id")
    side = f"""{ROOT}.querySelector('[data-panel="sizes"]').closest('.side').scrollTop"""
    page.page.evaluate(f"{side} = 200")
    page.page.locator('[data-joint="R(coupler-rocker)"]').focus()
    scrolled = page.page.evaluate(side)
    assert scrolled > 50
    page.page.keyboard.press("Control+z")
    assert page.page.evaluate(f"{ACTIVE}.dataset.joint") == "R(coupler-rocker)"
    assert page.page.evaluate(side) == pytest.approx(scrolled, abs=40)
    page.page.locator('[data-view="catalog"]').press("Enter")
    assert page.page.evaluate(f"{ACTIVE}.dataset.view") == "catalog"


def test_opening_another_machine_loses_nothing(tab, server):
    page = tab().open(server.address)
    page.drag(page.middle('[data-joint="R(coupler-rocker)"] .joint'), (25, -15))
    sizes = page.page.evaluate(SIZES)
    page.page.wait_for_timeout(400)
    page.page.click('[data-view="catalog"]')
    page.page.locator('[data-id="wiper"]').click()
    page.until("gruebler.motion.linkage.model.source === 'wiper'")
    assert page.page.evaluate(UNDOABLE) is True
    page.page.keyboard.press("Control+z")
    assert page.page.evaluate("gruebler.motion.linkage.model.source") == "crankrocker"
    assert page.page.evaluate(SIZES) == sizes
    page.page.keyboard.press("Control+y")
    assert page.page.evaluate("gruebler.motion.linkage.model.source") == "wiper"
    page.page.wait_for_timeout(400)
    page.page.go_back()
    page.until("gruebler.view === 'catalog' && gruebler.motion.linkage.model.source === 'crankrocker'")
    assert page.page.evaluate(SIZES) == pytest.approx(sizes, rel=1e-9)
    page.page.go_back()
    page.until("gruebler.view === 'motion'")
    page.page.go_forward()
    page.page.go_forward()
    page.until("gruebler.motion.linkage.model.source === 'wiper'")


def test_what_was_changed_is_not_called_by_its_old_name(tab, crank_rocker, tmp_path, monkeypatch, capsys):
    """The commands that the page shows find the linkage that it shows, after a drag too."""
    page = tab().open(crank_rocker)

    def commands(number: int) -> str:
        page.page.locator('[data-icon="save"]').click()
        page.page.locator('[data-panel="export"] summary').click()
        text = page.page.locator('[data-panel="export"] pre').nth(number).inner_text()
        page.page.keyboard.press("Escape")
        return text

    assert commands(1).startswith("gruebler analyse crankrocker\n")
    page.drag(page.middle('[data-joint="R(coupler-rocker)"] .joint'), (25, -15))
    assert page.page.locator("header h1").inner_text().endswith(", changed")
    assert page.page.title().startswith("Crank-rocker, changed")
    page.page.locator('[data-panel="sizes"] input').first.focus()  # which keeps other keys for itself
    with page.page.expect_download() as saved:
        page.page.keyboard.press("Control+s")
    saved.value.save_as(tmp_path / saved.value.suggested_filename)
    monkeypatch.chdir(tmp_path)
    program, *words = commands(1).splitlines()[0].split()
    assert program == "gruebler"
    capsys.readouterr()
    assert main([*words, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    least = page.page.evaluate("gruebler.motion.found.least.mu") * 180 / np.pi
    assert any(value == pytest.approx(least, abs=1e-6) for value in numbers_of(told)), told
    namespace: dict = {}
    exec(commands(2), namespace)
    wanted = page.page.evaluate(SIZES)
    assert namespace["linkage"].length("crank", 0, 1) == pytest.approx(wanted[1], rel=1e-12)
    page.page.locator("header h1").click()
    page.page.keyboard.press("Control+z")
    assert commands(1).startswith("gruebler analyse crankrocker\n")


def numbers_of(value) -> list[float]:
    if isinstance(value, dict):
        return [one for held in value.values() for one in numbers_of(held)]
    if isinstance(value, list):
        return [one for held in value for one in numbers_of(held)]
    return [value] if isinstance(value, (int, float)) else []


def test_names_are_readable_in_the_exported_picture(tab, crank_rocker, tmp_path):
    """As dark where a name stands as the page itself; without `paint-order` its outline covers the letters."""
    image = pytest.importorskip("PIL.Image", reason="pictures are compared with pillow")
    page = tab().open(crank_rocker)
    page.page.evaluate("gruebler.motion.shown.grid = false, gruebler.motion.redraw()")
    name = page.page.locator(".stage text.name").first
    box, board = name.bounding_box(), page.page.locator(".stage").bounding_box()
    file = tmp_path / "picture.svg"
    file.write_text(page.page.evaluate("gruebler.motion.picture()"), encoding="utf-8")
    other = tab()
    other.page.goto(file.as_uri())
    other.page.set_viewport_size({"width": 1280, "height": 860})

    def dark(tab, x: float, y: float) -> int:
        clip = {"x": x, "y": y, "width": box["width"], "height": box["height"]}
        pixels = image.open(io.BytesIO(tab.page.screenshot(clip=clip))).convert("L")
        return sum(pixels.histogram()[:90])

    shown = dark(page, box["x"], box["y"])
    assert shown > 40
    assert dark(other, box["x"] - board["x"], box["y"] - board["y"]) > 0.7 * shown


TRIAD = "R(0-1) R(1-2) R(2-3) R(3-4) R(0-4) R(3-5) R(0-5); drive=R(0-1)"
TRIANGLE = {0: (0, 0), 1: (0, 20), 2: (40, 60), 3: (90, 70), 4: (110, 0), 5: (70, 40), 6: (60, 0)}


def test_a_linkage_with_a_larger_group_is_exact_again_when_it_is_let_go(tab, tmp_path):
    """While the drag moves its limits are found to a billionth of a degree or so; then those of the library."""
    linkage = Linkage.from_drawing(Mechanism.parse(TRIAD), TRIANGLE, points={"K": ("3", 70.0, 90.0)})
    file = tmp_path / "triad.html"
    file.write_text(single_file(model_of(linkage)), encoding="utf-8")
    page = tab().open(file.as_uri())
    cycle = "(({ low, high, values }) => [low, high, values.length])(gruebler.motion.linkage.cycle)"
    rows = page.page.evaluate(cycle)[2]
    page.page.evaluate(PICTURES.format(seen=cycle))
    page.page.mouse.move(*page.middle('.stage [data-joint="R(3-4)"] .joint'))
    page.page.mouse.down()
    x, y = page.middle('.stage [data-joint="R(3-4)"] .joint')
    page.page.mouse.move(x + 6, y - 5, steps=5)  # every second step keeps the limits of the one before
    page.until("pictures.length && !gruebler.motion.linkage.quick && gruebler.motion.linkage.dragged")
    *quick, few = [seen for moves, seen in page.page.evaluate("pictures") if moves][-1]
    *exact, many = page.page.evaluate(cycle)
    page.page.mouse.up()
    page.until("!gruebler.motion.linkage.dragged")
    assert page.page.evaluate(cycle) == [*exact, many]
    assert few < 0.6 * rows < 1.2 * many
    assert quick == pytest.approx(exact, abs=1e-6)
    dragged = linkage_from_json(json.loads(page.page.evaluate("JSON.stringify(gruebler.motion.document())")))
    span = drive_cycle(dragged).span
    assert exact == pytest.approx([span.low, span.high], abs=1e-9)


# What is to be seen in each picture, and whether a drag moves then.
PICTURES = """() => {{ const {{ stage, linkage }} = gruebler.motion, {{ draw }} = stage; window.pictures = [];
  stage.draw = () => {{ window.strokes = []; draw.call(stage);
    pictures.push([linkage.quick && !linkage.late, {seen}]); }}; }}"""
STROKES = """() => {
  const { lineTo, quadraticCurveTo, stroke } = CanvasRenderingContext2D.prototype;
  let path = [];
  window.strokes = [];
  CanvasRenderingContext2D.prototype.lineTo = function (x, y) { path.push(x, y); lineTo.call(this, x, y); };
  CanvasRenderingContext2D.prototype.quadraticCurveTo = function (...all) { // the place before is its control point
    path.push(all[0], all[1]); quadraticCurveTo.apply(this, all); };
  CanvasRenderingContext2D.prototype.stroke = function () {
    window.strokes.push([this.strokeStyle, this.globalAlpha, path]); path = []; stroke.call(this); };
}"""


def mirrored_curve(bar, angles) -> list[list[float]]:
    """The curve of K where the coupler lies on the other side of the line from the crank's pin to the rocker's pivot.

    By the intersection of two circles, with the rocker's pivot on the x axis.
    """
    a, b, c, d = (bar.length(*row) for row in (("crank", 0, 1), ("coupler", 1, 2), ("rocker", 2, 3), ("frame", 0, 3)))
    side = np.sign(np.imag(np.conj(d - place_of(bar, 1)) * (place_of(bar, 2) - place_of(bar, 1))))
    pin = a * np.exp(1j * angles)
    way = d - pin
    far = np.abs(way)
    along = (far**2 + b**2 - c**2) / (2 * far)
    coupler = way / far * (along - 1j * side * np.sqrt(b**2 - along**2)) / b
    place = pin + coupler * complex(bar.points["K"].x, bar.points["K"].y)
    return np.stack([place.real, place.imag], axis=1).tolist()


def place_of(bar, joint: int) -> complex:
    """Where a joint lies in the reference pose, by the pose of the coupler."""
    pose, element = bar.required_pose["coupler"], bar.elements[joint, "coupler"]
    return complex(pose.x, pose.y) + complex(element.x, element.y) * np.exp(1j * pose.angle)


def test_all_curves_follow_a_drag_and_those_of_the_other_mode_shine_through(tab, tmp_path):
    """Those of the other mode are faint while it moves, since they may be a step old; where it rests they are not."""
    linkage = FourBar(25, 70, 40, 70).linkage({"K": (45, 40), "L": (20, -30)})
    file = tmp_path / "points.html"
    file.write_text(single_file(model_of(linkage)), encoding="utf-8")
    page = tab().open(file.as_uri())
    page.page.evaluate(STROKES)

    def drawn():
        """The strokes of the last picture that have the length of curves: colour, opacity, places."""
        page.page.evaluate("() => { window.strokes.length = 0; gruebler.motion.redraw(); }")
        return [(a, b, c) for a, b, c in page.page.evaluate("window.strokes") if len(c) > 200]

    still = drawn()
    assert [alpha for _, alpha, _ in still] == [1, 1]
    page.page.evaluate(PICTURES.format(seen="strokes.filter((one) => one[2].length > 150).map((one) => one[1])"))
    x, y = page.middle('.stage [data-joint="R(coupler-rocker)"] .joint')
    page.page.mouse.move(x, y)
    page.page.mouse.down()
    page.page.mouse.move(x + 8, y + 6, steps=6)
    page.until("pictures.length && !gruebler.motion.linkage.quick && gruebler.motion.linkage.dragged")
    moving = [[round(alpha, 2) for alpha in seen] for moves, seen in page.page.evaluate("pictures") if moves]
    assert moving
    assert all(seen in ([1, 1], [0.15, 0.15, 1, 1]) for seen in moving)
    moved = drawn()
    assert [round(alpha, 2) for _, alpha, _ in moved] == [0.3, 0.3, 1, 1]
    for before, now in zip(still, moved[2:], strict=True):
        assert before[0] == now[0]
        assert before[2] != now[2]
    dragged = linkage_from_json(json.loads(page.page.evaluate("JSON.stringify(gruebler.motion.document())")))
    expected = page.page.evaluate(
        "(places) => places.map(([x, y]) => gruebler.motion.stage.viewport.screen(x, y))",
        mirrored_curve(dragged, np.array(page.page.evaluate("[...gruebler.motion.linkage.cycle.values]"))[::3]),
    )
    gaps = np.hypot(*(np.array(expected)[:, None] - np.reshape(moved[0][2], (-1, 2))).transpose(2, 0, 1))
    assert gaps.min(axis=1)[1:].max() < 1e-6
    assert gaps.min(axis=0).max() < 1e-6
    page.page.mouse.up()
    page.until("!gruebler.motion.linkage.dragged")
    assert [alpha for _, alpha, _ in drawn()] == [1, 1]


def test_plots_and_measures_follow_where_a_drag_rests(tab, crank_rocker):
    """In each step one plot or the measures follow; all of them do before the joint is let go, and the lengths."""
    page = tab().open(crank_rocker)
    said = """() => [...gruebler.root.querySelectorAll(".plot"), gruebler.root.querySelector(".facts dd")].map(
        (one) => one.outerHTML)"""
    page.page.evaluate(f"window.before = ({said})()")
    x, y = page.middle('.stage [data-joint="R(coupler-rocker)"] .joint')
    page.page.mouse.move(x, y)
    page.page.mouse.down()
    page.page.mouse.move(x + 12, y - 9, steps=3)
    page.page.evaluate("new Promise((seen) => requestAnimationFrame(() => requestAnimationFrame(seen)))")
    resting = "(({ dragged, quick }) => dragged && !quick)(gruebler.motion.linkage)"
    page.until(f"{resting} && ({said})().every((now, k) => now !== before[k])")
    shown = [float(field.input_value()) for field in page.page.locator('[data-panel="sizes"] input').all()]
    lengths = page.page.evaluate("gruebler.motion.dragging.lengths().map(({ value }) => value)")
    assert shown == pytest.approx(lengths, rel=1e-3)
    rested = page.page.evaluate(said)
    page.page.mouse.up()
    page.until("!gruebler.motion.linkage.dragged")
    assert page.page.evaluate(said) == rested


def test_swing_and_transmission_follow_while_a_joint_is_dragged(tab, crank_rocker):
    """The right bearing goes to the left: with a shorter frame the swing is another one, known from triangles."""
    page = tab().open(crank_rocker)
    page.page.evaluate("""() => {
        window.seen = [];
        const told = () => {
            const { linkage, dragging } = gruebler.motion;
            const texts = [...gruebler.root.querySelectorAll(".facts > div")].map((one) =>
                ["dt", "dd"].map((part) => one.querySelector(part).firstChild.textContent));
            if (linkage.dragged && linkage.quick) seen.push(Object.fromEntries(texts));
        };
        const how = { subtree: true, childList: true, characterData: true };
        new MutationObserver(told).observe(gruebler.root.querySelector(".facts"), how);
    }""")
    before = page.page.evaluate(
        "[...gruebler.root.querySelectorAll('.facts dd')].map((one) => one.firstChild.textContent)"
    )
    x, y = page.middle('.stage [data-joint="R(frame-rocker)"] .joint')
    page.page.mouse.move(x, y)
    page.page.mouse.down()
    for step in range(40):
        page.page.mouse.move(x - step / 2, y)
    moving = page.page.evaluate("seen.at(-1)")
    for name in ("Swing", "Smallest μ", "Dead centres", "Time ratio"):
        assert moving[name] not in before, name
    page.until("!gruebler.motion.linkage.quick")
    frame, crank, coupler, rocker = page.page.evaluate(
        "['frame', 'crank', 'coupler', 'rocker'].map((name) => gruebler.motion.dragging.lengths().find(({ link }) => "
        "gruebler.motion.linkage.model.links[link] === name).value)"
    )

    def angle(reach: float) -> float:
        """That of the rocker against the frame where crank and coupler are in line."""
        return math.degrees(math.acos((frame**2 + rocker**2 - reach**2) / (2 * frame * rocker)))

    swing = page.page.locator(".facts > div", has_text="Swing").locator("dd").inner_text()
    assert swing == f"{angle(coupler + crank) - angle(coupler - crank):.4g}°"
    page.page.mouse.up()


def test_a_joint_snaps_while_it_is_dragged(tab, crank_rocker):
    """With the option, and with Shift: the right bearing, (70, 0), stops level with the left one."""
    page = tab().open(crank_rocker)
    scale = page.page.evaluate("gruebler.motion.stage.viewport.scale")
    bearing = page.page.evaluate(
        "gruebler.motion.linkage.model.joints.findIndex((one) => one.name === 'R(frame-rocker)')"
    )
    at = f"gruebler.motion.linkage.jointAt({bearing})"

    def dragged(*ends: tuple[float, float]) -> list[float]:
        x, y = page.page.evaluate(f"gruebler.motion.stage.viewport.screen(...{at})")
        box = page.page.locator(".stage").first.bounding_box()
        page.drag((box["x"] + x, box["y"] + y), *[(scale * u, -scale * v) for u, v in ends])
        return page.page.evaluate(at)

    free = dragged((3.3, 0.9))
    assert free[1] == pytest.approx(0.9, abs=0.3)
    page.page.keyboard.down("Shift")
    assert dragged((0.4, -0.4))[1] == 0
    page.page.keyboard.up("Shift")
    page.page.locator("[data-panel=show] summary").click()
    page.page.get_by_label("Snap").check()
    assert dragged((0.3, 0.7))[1] == 0
    assert dragged((0.3, 6.3))[1] != 0


def test_a_measurement_line_follows_the_motion(tab, crank_rocker):
    """From the crank's bearing, (0, 0), to the point K1, which gets another name: the law is that of two places."""
    page = tab().open(crank_rocker)
    page.page.get_by_label("Add a coupler point").click()
    box = page.page.locator(".stage").first.bounding_box()
    taken = (
        "[gruebler.motion.transport.player.playing, gruebler.motion.linkage.model.links[gruebler.motion.shown.chosen]]"
    )
    for beside, link in ((None, None), (30, "coupler")):
        page.page.evaluate("gruebler.motion.transport.toggle()")
        x, y = page.middle('[data-link="coupler"] .bar')
        page.page.mouse.click(*((x, y - beside) if beside else (box["x"] + 9, box["y"] + 9)))
        assert page.page.evaluate(taken) == [False, link]
        assert ("choose its link" in page.page.locator(".message").inner_text()) is (link is None)
    x, y = page.middle('[data-link="coupler"] .bar')
    page.page.mouse.click(x, y - 70)
    facts = page.page.locator(".facts")
    page.page.get_by_text("Measurement lines").click()
    page.page.get_by_label("to", exact=True).select_option(label="K1")
    page.page.locator("[data-act=measure]").click()
    for drive in (0.3, 2.0, 5.1):
        page.page.evaluate(f"gruebler.motion.transport.pick({drive})")
        x, y = page.page.evaluate(
            "(() => { const { pose, sizes } = gruebler.motion.linkage; const { link, at: [u, v] } = sizes.points[0];"
            "const [c, s] = [pose.turns[2 * link], pose.turns[2 * link + 1]];"
            "return [pose.places[2 * link] + c * u - s * v, pose.places[2 * link + 1] + s * u + c * v]; })()"
        )
        said = facts.locator("div", has_text="frame – crank ↔ K1").locator("dd").inner_text()
        length, unit, degrees = said.replace("−", "-").replace("°", "").replace(",", "").split()
        assert unit == "mm"
        assert float(length) == pytest.approx(math.hypot(x, y), rel=1e-4)
        assert float(degrees) == pytest.approx(math.degrees(math.atan2(y, x)), abs=1e-2)
    drawn = page.page.locator(".stage path.ruler").get_attribute("d")
    assert drawn.count("M") == 1
    assert not page.page.evaluate("gruebler.motion.stage.adding")  # one at a time, whose name and place are in sight
    field = page.page.locator("[data-field=point-name-0]")
    field.fill("tip")
    field.press("Enter")
    page.until(f"{ROOT}.querySelector('.facts').textContent.includes('↔ tip')")
    kept = page.page.evaluate("gruebler.motion.document().page.rulers")
    assert kept == [["R(frame-crank)", "tip"]]
    page.page.evaluate("gruebler.motion.undo(), gruebler.motion.undo()")
    assert page.page.locator(".stage path.ruler").get_attribute("d") == ""
