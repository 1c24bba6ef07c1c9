"""The page of a linkage in space: it moves, is gone round and pulled, without a server and without the network."""

import json
import math
import re
from functools import cache
from urllib.error import HTTPError
from urllib.request import Request, urlopen

import numpy as np
import pytest

import gruebler as gr
from gruebler.base.errors import GrueblerError
from gruebler.cli import main
from gruebler.files.screws import screws_to_json, spatial_from_json
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.screws.link_sizes import link_sizes
from gruebler.mechanics.screws.resizing import resized
from gruebler.mechanics.space import RSSR, Bennett, drive_range, move
from gruebler.page.requests import answer
from gruebler.page.space_page import machine_model, space_file, space_model
from gruebler.page.static_site import FileGroup, write_site
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entries, entry
from tests.page.test_access import AXE


def test_poses_of_the_page_are_those_of_the_motion():
    linkage = entry("sarrus").placed()
    model = space_model(linkage, between=(-0.5, 0.6))
    (motion,) = model["motions"]
    assert (motion["drive"], motion["round"], motion["unit"]) == (0, False, "°")
    assert motion["values"] == pytest.approx(np.degrees(np.linspace(-0.5, 0.6, 73)), rel=1e-5)
    poses = np.array(motion["poses"]).reshape(73, 6, 3, 4)
    there = move(linkage, [0.0, 0.6]).poses[0, -1, :, :3]
    assert poses[-1] == pytest.approx(there, abs=1e-3)
    assert model["points"] == [{"name": "C", "link": 5, "at": (0.0, 0.0, 96.0)}]
    assert model["texts"]["de"]["words"]["drives"] == "Antriebe"


def test_every_drive_of_a_delta_robot_has_a_motion():
    model = space_model(entry("delta").placed())
    moved = [drive.between[1] for drive in entry("delta").placed().mechanism.drives]  # of the frame and an arm
    assert [model["texts"]["en"]["drives"][each["drive"]] for each in model["motions"]] == [
        f"arm {link.removeprefix('arm')}" for link in moved
    ]


def test_a_joint_that_the_page_does_not_solve_is_named():
    """Two cranks and their couplers on one pin with a rod to a slide: two drives, a joint of three links."""
    mechanism = Mechanism.parse("R(0-1) R(0-2) R(1-3) R(2-4) R(3-4-5) R(5-6) P(0-6); frame=0")
    points = [(0, 0), (4, 0), (-1, 1), (5, 1), (2, 3), (6, 4)]
    linkage = SpatialLinkage(mechanism, dict(enumerate(points)) | {6: {"at": (6, 4), "x": (1, 0)}})
    model = space_model(linkage.with_drives(["R(0-1)", "R(0-2)"]))
    assert model["live"] is None
    assert len(model["motions"]) == 2
    texts = {lang: model["texts"][lang]["words"]["alone"] for lang in ("en", "de")}
    assert texts["en"] == ("The drives move one at a time here, since the page does not solve R(3-4-5).")
    assert texts["de"] == ("Die Antriebe bewegen sich hier einzeln, da die Seite D(3-4-5) nicht löst.")
    assert "alone" not in space_model(entry("delta").placed())["texts"]["en"]["words"]


def test_the_file_loads_nothing():
    text = space_file(space_model(entry("bennett").placed()))
    assert "default-src 'none'" in text
    names = ('http-equiv="Content-Security-Policy"', "http://www.w3.org/2000/svg")
    assert "http" not in text.replace(names[0], "").replace(names[1], "")  # a name, not an address


def test_a_machine_of_the_catalog_has_its_names_in_both_languages():
    texts = machine_model("wiper_rssr")["texts"]
    assert texts["de"]["title"].startswith("Scheibenwischerantrieb")
    assert texts["de"]["drives"] == ["D(Karosserie-Motorkurbel)"]
    assert texts["en"]["drives"] == ["R(body-crank)"]
    with pytest.raises(GrueblerError, match="no linkage in space"):
        machine_model("quad")


def test_a_nameless_linkage_has_a_title_of_words():
    texts = space_model(RSSR(a=1, b=4, c=3, d=4, twist=1.0).linkage())["texts"]
    assert (texts["en"]["title"], texts["de"]["title"]) == ("RSSR linkage", "D-D3-D3-D-Getriebe")


def test_a_page_is_called_by_the_file_that_it_shows(tmp_path):
    path, page = tmp_path / "my loop.toml", tmp_path / "page.html"
    gr.write(entry("bennett").placed(), path)
    assert main(["explore", str(path), "-o", str(page)]) == 0
    assert "<title>my loop</title>" in page.read_text(encoding="utf-8")


def test_the_server_has_a_page_for_each_machine_in_space(server):
    with urlopen(server.address + "space/universal_joint.html", timeout=60) as page:
        assert "Kreuzgelenk" in page.read().decode("utf-8")
        assert "script-src" not in page.headers["Content-Security-Policy"]  # the page brings its own policy
    for name, reason in (("quad", "'quad'"), ("lambda", "lambda"), ("opened", "Open the address"), ("../ws", "Open")):
        with pytest.raises(HTTPError, match="404") as refused:
            urlopen(f"{server.address}space/{name}.html", timeout=60)
        assert reason in refused.value.read().decode("utf-8")


def test_a_reason_is_in_the_language_that_the_browser_asks_for(server):
    """This server has no language of its own."""
    for asked, reason in (("de-CH,de;q=0.9,en;q=0.8", "hat kein"), ("fr-DE, en;q=0.5", "has no"), ("", "has no")):
        with pytest.raises(HTTPError, match="404") as refused:
            urlopen(Request(server.address + "space/quad.html", headers={"Accept-Language": asked}), timeout=60)
        assert reason in refused.value.read().decode("utf-8")
    with pytest.raises(HTTPError, match="404") as refused:
        urlopen(server.address + "nothing", timeout=60)
    assert "Öffnen Sie die Adresse" in refused.value.read().decode("utf-8")


def test_a_drive_turns_round_and_one_at_its_limit_says_so(tmp_path, chromium):
    """Both in the page: a wheel's differential has no limits; two pistons push a platform to where it cannot go."""
    path = tmp_path / "train.html"
    assert main(["explore", "diff_bevel", "-o", str(path)]) == 0
    browser, page, errors = browsed(chromium, path)
    page.get_by_role("button", name="Pause").click()
    carrier = page.locator("#drive-1")
    start = page.evaluate("gruebler.linkage.drives")[1]
    for part in (1, 3, math.tau - 1.5, 0.5):
        carrier.fill(str(part))
    shift = page.evaluate("gruebler.linkage.drives")[1] - 0.5
    assert shift / (2 * np.pi) == pytest.approx(round(shift / (2 * np.pi)), abs=1e-6)
    assert abs(start) < 7
    model = machine_model("diff_bevel")["live"]
    assert [drive["round"] for drive in model["drives"]] == [True, True]
    assert [drive["high"] for drive in model["drives"]] == pytest.approx([np.pi] * 2)
    path = tmp_path / "platform.html"
    gr.write(entry("gough").placed(), tmp_path / "platform.toml")
    assert main(["explore", str(tmp_path / "platform.toml"), "-o", str(path)]) == 0
    page.goto(path.as_uri() + "#de")
    sliders = page.locator('[data-panel="drives"] input').all()
    low, high = (float(sliders[0].get_attribute(end)) for end in ("min", "max"))
    alone = drive_range(entry("gough").placed(), drive=0)
    assert [low, high] == pytest.approx([alone.lowest, alone.highest], rel=3e-3)
    for number, slider in enumerate(sliders):
        slider.fill(str(high if number % 2 else low))
    assert "nicht weiter, solange" in page.locator(".message").inner_text()
    assert errors == []
    browser.close()


def test_a_site_has_the_machines_in_space(tmp_path):
    write_site(
        tmp_path / "site", {"name": "", "names": {}, "source": ""}, groups=[FileGroup("space", ("universal_joint",))]
    )
    assert "default-src 'none'" in (tmp_path / "site" / "space" / "universal_joint.html").read_text(encoding="utf-8")


def test_a_site_opens_in_the_plane(capsys, tmp_path):
    assert main(["explore", "gough", "--site", str(tmp_path / "site")]) == 2
    assert "opens with a linkage in the plane" in capsys.readouterr().err


def test_the_list_of_machines_says_which_move_in_space():
    by_id = {each["id"]: each for each in answer("catalog", {}, "en", print)}
    assert by_id["gough"]["space"]
    assert not by_id["quad"]["space"]
    picture = answer("picture", {"id": "wiper_rssr"}, "de", print)["picture"]
    assert "Isometri" in picture
    for id in ("wiper_rssr", "diff_bevel"):  # of two drives the first one moves
        moving = answer("moving", {"id": id}, "de", print)["picture"]
        assert moving.count("<animate ") == moving.count("<g visibility") == 18
    with pytest.raises(GrueblerError, match="drive"):
        answer("moving", {"id": "susp_5link"}, "en", print)


def browsed(chromium, path, wanted="canvas"):
    """A page of a machine in space, and what went wrong on it."""
    return browsed_at(chromium, path.as_uri(), wanted)


@cache
def space_browser(chromium):
    """One browser that draws in space, for all tests of a process; Playwright's session ends it."""
    from tests.page.conftest import find_browser

    if not (found := find_browser(chromium)):
        pytest.skip("no browser")
    options = ["--disable-gpu", "--enable-unsafe-swiftshader"]  # else the whole page is drawn by it, four times as long
    return chromium.launch(executable_path=found, args=options)


def browsed_at(chromium, address, wanted="canvas", *, touch=False):
    """The same at an address, for fingers if it is touched; a browser of its own in all but its process."""
    browser = space_browser(chromium).new_context(viewport={"width": 900, "height": 700}, has_touch=touch)
    page = browser.new_page()
    errors = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.on("console", lambda line: errors.append(line.text) if line.type == "error" else None)
    page.goto(address)
    page.wait_for_selector(wanted)
    return browser, page, errors


@pytest.mark.parametrize("id", [pytest.param("gough", marks=pytest.mark.slow), "diff_bevel2p"])
def test_several_drives_move_together(tmp_path, chromium, id):
    """The page's own solver against that of the library, along the same ways; rods may spin as they like."""
    path = tmp_path / "machine.html"
    assert main(["explore", id, "-o", str(path)]) == 0
    browser, page, errors = browsed(chromium, path)
    page.get_by_role("button", name="Pause").click()
    sliders = page.locator('[data-panel="drives"] input').all()
    linkage = entry(id).placed()
    drives = linkage.mechanism.drives
    assert len(sliders) == len(drives)
    values = [(0.2 if drive.turning else 12.0) * (-1) ** k for k, drive in enumerate(drives)]
    for slider, value, drive in zip(sliders, values, drives, strict=True):
        slider.fill(str(value % (2 * np.pi) if drive.turning else value))
    reached = page.evaluate("gruebler.linkage.drives")  # a drive that has turned since the start keeps its whole turns
    turns = np.round((np.array(reached) - values) / (2 * np.pi)) * [drive.turning for drive in drives]
    assert reached == pytest.approx(values + 2 * np.pi * turns)
    motion = move(linkage, np.linspace(np.zeros(len(drives)), reached, 64))
    poses = np.array(page.evaluate("gruebler.linkage.poses")).reshape(-1, 3, 4)
    for k, link in enumerate(linkage.mechanism.chain.links):
        if link not in motion.idle:
            assert poses[k] == pytest.approx(motion.poses[0, -1, k, :3], abs=1e-6 * linkage.size)
    assert errors == []
    browser.close()


def test_a_platform_that_only_shifts_is_said_to_shift(tmp_path, chromium):
    """Three equal angles of a delta robot: up or down. The page solves it, and it does not say that it is turned."""
    path = tmp_path / "delta.html"
    assert main(["explore", "delta", "-o", str(path)]) == 0
    browser, page, errors = browsed(chromium, path)
    named = len(entry("delta").placed().points)
    assert page.locator("text.mark").count() == named
    assert page.get_by_label("Names of points").count() == min(named, 1)
    page.get_by_role("button", name="Pause").click()
    for slider in page.locator('[data-panel="drives"] input').all():
        slider.fill("0.2")
    linkage = entry("delta").placed()
    pose = move(linkage, [np.zeros(3), np.full(3, 0.2)]).poses[0, -1, linkage.mechanism.chain.index("platform")]
    value = known(page, "platform: shift from the reference pose")
    assert abs(number_in(value)) == pytest.approx(np.linalg.norm(pose[:3, 3]), rel=1e-3)
    assert errors == []
    browser.close()


CANVAS = "document.querySelector('.gruebler-explorer').shadowRoot.querySelector('canvas')"
PIXELS = (
    f"const c = {CANVAS}, g = c.getContext('webgl2'), p = new Uint8Array(4 * c.width * c.height);"
    "g.readPixels(0, 0, c.width, c.height, g.RGBA, g.UNSIGNED_BYTE, p);"
)


def known(page, name):
    """What is read off as soon as the whole course is solved, which tells its sign."""
    for _ in range(600):
        if (text := read_off(page)[name]) != "…":
            return text
        page.wait_for_timeout(50)
    raise AssertionError(f"{name}: {text}")


def drive_to(page, text):
    """Type a value of the drive."""
    field = page.locator(".transport .value")
    field.fill(text)
    field.press("Enter")
    return field


def check_sizes_plots_and_files(page):
    """Of the wiper with a crank and a rocker in space."""
    # the axes of the body: z through the origin, and (0, -4, 6) through (300, 40, 80); they are crossed by arctan 4/6
    sizes = page.locator('[data-panel="sizes"]').inner_text().split("\n")
    assert "300 mm · 33.69°" in sizes
    assert "45 mm" in sizes  # the crank
    # without the server they are there to read
    assert "connect-src" not in page.content()
    assert page.locator('[data-panel="sizes"] dd').count() == 4
    assert page.locator('[data-panel="sizes"] input').count() == 0
    assert page.locator("#joint-1-at").get_attribute("readonly") is not None
    swing = next(each for each in entry("wiper_rssr").quantities if each.kind == "swing")
    told = page.locator('[data-panel="measures"] dt:text-is("rocker: swing") + dd')
    assert told.inner_text() == f"{swing.degrees:.4g}°"
    drive_to(page, "90")
    turned = page.locator('[data-panel="measures"] dd').first.inner_text()
    assert page.locator(".plot .read").first.text_content().lstrip("−") + "°" == turned
    page.locator('[data-icon="save"]').click()
    saved = {}
    for kind in ("STL", "JSON"):
        with page.expect_download() as taken:
            page.get_by_role("button", name=kind, exact=True).click()
        saved[kind] = taken.value.path().read_bytes()
    linkage = entry("wiper_rssr").placed()
    assert spatial_from_json(json.loads(saved["JSON"])) == linkage
    # the crank, the second link, turns about z by 90°
    bodies = space_model(linkage)["bodies"]
    faces = np.frombuffer(saved["STL"][84:], np.dtype([("corners", "<f4", (4, 3)), ("end", "<u2")]))["corners"][:, 1:]
    frame, crank = (len(body["triangles"]) // 3 for body in bodies[:2])
    assert len(faces) == sum(len(body["triangles"]) for body in bodies) // 3
    there = np.reshape(bodies[1]["vertices"], (-1, 3))[bodies[1]["triangles"]].reshape(-1, 3, 3)
    turn = 1j
    assert (there[..., 0] + 1j * there[..., 1]) * turn == pytest.approx(
        faces[frame : frame + crank, :, 0] + 1j * faces[frame : frame + crank, :, 1], abs=1e-3
    )


def test_a_machine_plays_turns_and_is_pulled_in_a_browser(tmp_path, chromium):
    path = tmp_path / "wiper.html"
    assert main(["explore", "wiper_rssr", "-o", str(path)]) == 0
    browser, page, errors = browsed(chromium, path)
    field = page.locator(".transport .value")
    first = field.input_value()
    shown = "document.querySelector('.gruebler-explorer').shadowRoot.querySelector('.transport .value').value"
    page.wait_for_function(f"old => {shown} !== old", arg=first)
    page.get_by_role("button", name="Pause").click()
    assert drive_to(page, "90").input_value() == "90°"
    german = browser.new_page()
    german.goto(f"{path.as_uri()}#de")
    german.get_by_role("button", name="Anhalten").click()
    assert drive_to(german, "90,5").input_value() == "90,5°"
    german.get_by_label("Sprache").select_option("en")
    assert field.input_value() == "90°"
    assert german.get_by_text("Range of the drive").count() == 1
    german.close()

    def picture():
        return page.evaluate(f"{CANVAS}.toDataURL()")

    still = picture()
    drive_to(page, "180")
    assert (turned := picture()) != still
    stage = page.locator(".stage > svg")
    box = stage.bounding_box()
    x, y = box["x"] + 20, box["y"] + box["height"] - 60  # beside the bodies
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 120, y, steps=4)
    page.mouse.up()
    assert (gone_round := picture()) != turned
    assert field.input_value() == "180°"
    stage.focus()
    page.keyboard.press("ArrowLeft")
    assert picture() != gone_round
    assert field.input_value() == "180°"
    page.keyboard.press("Escape")
    field.blur()
    page.keyboard.press("0")
    spot = page.evaluate(
        "() => {" + PIXELS + "const r = c.width / c.clientWidth, found = [];"
        "for (let k = 0; k < p.length; k += 4)"  # the crank: blue
        "  if (p[k + 2] > p[k] + 60 && p[k + 2] > 90) found.push(k / 4);"
        "const k = found[found.length >> 1];"
        "return [(k % c.width) / r, c.clientHeight - Math.floor(k / c.width) / r]; }"
    )
    page.mouse.move(box["x"] + spot[0], box["y"] + spot[1])
    assert page.locator(".stage").get_attribute("title") == "crank"
    assert page.locator('[data-panel="links"] .chip.on').all_inner_texts() == ["crank"]
    assert page.get_by_label("Paths of points").count() == 0  # no point has one yet
    page.mouse.down()
    assert page.get_by_label("Paths of points").is_checked()
    for step in range(12):
        page.mouse.move(box["x"] + spot[0] + 4 * step, box["y"] + spot[1] - 5 * step)
    page.mouse.up()
    assert field.input_value() != "180°"
    check_sizes_plots_and_files(page)
    assert errors == []
    browser.close()


def test_a_phone_sees_all_of_a_machine_and_two_fingers_come_nearer(tmp_path, chromium):
    path = tmp_path / "bennett.html"
    assert main(["explore", "bennett", "-o", str(path)]) == 0
    browser, page, errors = browsed(chromium, path)
    page.set_viewport_size({"width": 390, "height": 844})
    page.get_by_role("button", name="Pause").click()
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    header = [box for each in page.locator("header > *:visible").all() if (box := each.bounding_box())]
    assert max(box["y"] for box in header) < min(box["y"] + box["height"] for box in header)  # one row
    for scheme in ("dark", "light"):
        page.emulate_media(color_scheme=scheme)
        page.reload()
        assert page.locator("header select").evaluate("e => getComputedStyle(e).colorScheme") == scheme
    page.get_by_role("button", name="Light or dark").click()
    page.reload()  # what is chosen is kept, whatever the system asks for
    page.get_by_role("button", name="Pause").click()
    assert page.evaluate("document.querySelector('.gruebler-explorer').dataset.theme") == "dark"
    page.get_by_label("Grid").uncheck()
    extent = (
        "() => {"
        + PIXELS
        + (
            "const drawn = [];"
            "for (let k = 0; k < c.width * c.height; k++)"
            "  if ([0, 1, 2].some((n) => p[4 * k + n] !== p[n])) drawn.push(k % c.width);"
            "return [Math.min(...drawn) / c.width, Math.max(...drawn) / c.width]; }"
        )
    )
    sizes = []
    for degrees in range(0, 360, 40):
        drive_to(page, str(degrees))
        low, high = page.evaluate(extent)
        assert low > 0.02, degrees
        assert high < 0.98, degrees
        sizes.append(high - low)
    assert max(sizes) > 0.4  # nor is it small
    fingers = """([gap, kind]) => { const c = document.querySelector('.gruebler-explorer').shadowRoot
            .querySelector('.stage > svg');
        c.setPointerCapture = () => {};
        for (const [pointerId, x] of [[7, 200 - gap / 2], [8, 200 + gap / 2]])
            c.dispatchEvent(new PointerEvent(kind, { pointerId, pointerType: "touch", clientX: x, clientY: 440 })); }"""
    for gap, kind in ((60, "pointerdown"), (75, "pointermove"), (75, "pointerup")):
        page.evaluate(fingers, [gap, kind])
    low, high = page.evaluate(extent)
    assert high - low == pytest.approx(1.25 * sizes[-1], rel=0.15)
    assert errors == []
    browser.close()


@pytest.mark.parametrize(("id", "width"), [pytest.param("gough", 1280, marks=pytest.mark.slow), ("schatz", 390)])
def test_a_machine_in_space_is_accessible(tmp_path, chromium, id, width):
    """Nothing serious by axe-core, light and dark; whatever a finger meets is 44 pixels high."""
    if not AXE.exists():
        pytest.skip("axe-core is not installed: npm ci in explorer/")
    path = tmp_path / "machine.html"
    assert main(["explore", id, "-o", str(path)]) == 0
    errors = []
    for scheme in ("light", "dark"):
        context = space_browser(chromium).new_context(
            viewport={"width": width, "height": 844}, color_scheme=scheme, has_touch=True, reduced_motion="reduce"
        )
        page = context.new_page()
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.goto(path.as_uri())
        page.get_by_role("button", name="Play").wait_for()  # it does not begin by itself
        for button in page.locator("button:visible, header select, summary").all():
            assert button.bounding_box()["height"] >= 42, button.inner_text()
        page.evaluate(AXE.read_text(encoding="utf-8") + "; 0")
        found = page.evaluate("axe.run({resultTypes: ['violations']})")["violations"]
        assert [each["id"] for each in found if each["impact"] in ("serious", "critical")] == []
        context.close()
    assert errors == []


def test_several_drives_have_short_names_and_the_bar_one_row(tmp_path, chromium):
    """Six legs: each is driven between its cylinder and its rod, and the rod names it."""
    path = tmp_path / "machine.html"
    assert main(["explore", "gough", "-o", str(path)]) == 0
    browser = space_browser(chromium).new_context(viewport={"width": 1024, "height": 800}, reduced_motion="reduce")
    page = browser.new_page()
    errors = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(path.as_uri() + "#de")
    page.locator('[data-panel="drives"] input').first.wait_for()
    labels = page.locator('[data-panel="drives"] label')
    names = [f"Kolbenstange {k}" for k in range(1, 7)]
    assert labels.all_inner_texts() == names == page.locator(".transport option").all_text_contents()
    assert max(label.bounding_box()["height"] for label in labels.all()) < 20
    middles = page.locator(".transport > *").evaluate_all(
        "all => all.map((one) => one.getBoundingClientRect()).map(({ top, bottom }) => (top + bottom) / 2)"
    )
    assert len(middles) == 5
    assert max(middles) - min(middles) < 5
    assert errors == []
    browser.close()


IN_SPACE = [id for id, record in entries().items() if record.in_space]


@pytest.mark.parametrize("id", IN_SPACE)
def test_the_arrow_of_a_drive_goes_the_way_that_it_grows(id):
    """Against the poses of its motion: a turn about the arrow's direction, or a shift along it."""
    linkage = entry(id).placed()
    chain, drives = linkage.mechanism.chain, linkage.mechanism.drives
    ways = []
    motions = space_model(linkage)["motions"]
    for motion in motions:
        still, along = motion["arrow"]["link"], np.array(motion["arrow"]["along"])
        (moved,) = {chain.index(link) for link in chain.joints[drives[motion["drive"]].joint].links} - {still}
        values = np.zeros((2, len(drives)))
        values[1, motion["drive"]] = 0.01
        poses = move(linkage, values).poses[0, -1]
        seen = np.linalg.inv(poses[still]) @ poses[moved]
        turn = np.array([seen[2, 1] - seen[1, 2], seen[0, 2] - seen[2, 0], seen[1, 0] - seen[0, 1]]) / 2
        ways.append(((turn if motion["unit"] == "°" else seen[:3, 3]) / 0.01) @ along)
    assert ways == pytest.approx([1.0] * len(motions), rel=1e-3)


TYPED = "document.querySelector('.gruebler-explorer').shadowRoot.querySelectorAll('[data-panel=sizes] input')"


def test_sizes_are_typed_undone_and_refused_with_the_reason(server, chromium):
    """A longer crank of the wiper, against the library; a rod that is too short."""
    browser, page, errors = browsed_at(chromium, server.address + "space/wiper_rssr.html#de")
    page.get_by_role("button", name="Anhalten").click()
    undo, redo = (page.locator(f'[data-icon="{name}"]') for name in ("undo", "redo"))
    crank = page.locator("#size-1-0")
    assert crank.input_value() == "45"
    assert undo.is_disabled()
    crank.fill("50,5")
    crank.press("Enter")
    page.locator("header small", has_text="geändert").wait_for(state="attached")
    changed = resized(entry("wiper_rssr").placed(), {"crank": (50.5, None)})
    swing = np.degrees(gr.measures(changed).travel)
    told = page.locator('[data-panel="measures"] dt:text-is("Wischerhebel: Schwingwinkel") + dd')
    assert float(told.inner_text().rstrip("°").replace(",", ".")) == pytest.approx(swing, rel=1e-3)
    with page.expect_download() as taken:
        page.keyboard.press("Control+s")
    saved = spatial_from_json(json.loads(taken.value.path().read_text(encoding="utf-8")))
    assert {size.link: size.distance for size in link_sizes(saved)}["crank"] == pytest.approx(50.5)
    rod = page.locator("#size-2-0")
    rod.fill("100")
    rod.press("Enter")
    page.locator('[data-panel="sizes"] [role="alert"]', has_text="Schubstange: Die Gelenke lassen sich bis").wait_for()
    assert page.locator("#size-2-0").get_attribute("aria-invalid") == "true"
    rod.fill("abc")
    rod.press("Enter")  # what was said of 100 mm no longer stands there
    assert page.locator('[data-panel="sizes"] [role="alert"]').inner_text() == "Erwartet wird eine Zahl, etwa 302,572."
    undo.click()  # what was typed
    assert page.locator("#size-2-0").input_value() == "302,572"
    undo.click()
    assert page.locator("#size-1-0").input_value() == "45"
    assert undo.is_disabled()
    page.locator(".stage > svg").focus()
    page.keyboard.press("Control+y")
    assert page.locator("#size-1-0").input_value() == "50,5"
    assert redo.is_disabled()
    # places of the joints are typed as well; what stays has all its digits
    page.locator('[data-panel="joints"] summary').click()
    ball = page.locator("#joint-1-at")
    joint = "gruebler.linkage.data.document.screws.joints['S(crank-rod)'].at"
    before = page.evaluate(joint)
    typed = ball.input_value().split(" | ")
    ball.fill(" | ".join([*typed[:2], "7"]))
    ball.press("Enter")
    while page.evaluate(joint) == before:  # the policy forbids waiting within the page
        page.wait_for_timeout(50)
    assert page.evaluate(joint) == pytest.approx([*before[:2], 7], abs=1e-9)
    undo.click()
    assert ball.input_value().split(" | ") == typed
    assert errors == []
    browser.close()


def test_what_rounding_leaves_in_a_place_is_read_as_0(server, chromium):
    """With a twist angle of 80 degrees the crank's bearing lies at -7e-15 mm."""
    browser, page, errors = browsed_at(chromium, server.address + "space/wiper_rssr.html#en")
    page.locator('[data-panel="joints"] summary').click()
    ball = "gruebler.linkage.data.document.screws.joints['S(rod-rocker)'].at"
    before = page.evaluate(ball)
    twist = page.locator("#size-0-1")
    twist.fill("80")
    twist.press("Enter")
    while page.evaluate(ball) == before:
        page.wait_for_timeout(50)
    assert page.locator("#joint-0-at").input_value() == "0 | 0 | 0"
    assert errors == []
    browser.close()


def test_the_drive_stands_where_it_can_with_other_sizes(server, chromium):
    """With a crank of 80 mm the wiper's turns fully no more."""
    browser, page, errors = browsed_at(chromium, server.address + "space/wiper_rssr.html#en")
    page.get_by_role("button", name="Pause").click()
    drive_to(page, "180")
    crank = page.locator("#size-1-0")
    crank.fill("80")
    crank.press("Enter")
    page.locator('[data-panel="measures"]', has_text="…").wait_for()
    low, high = page.evaluate("[gruebler.linkage.cycle.low, gruebler.linkage.cycle.high]")
    assert high < np.pi
    assert low <= page.evaluate("gruebler.linkage.drives[0]") <= high
    delta = machine_model("delta")  # its arms reach farther than the catalog moves them
    asked = {key: delta[key] for key in ("document", "between")} | {"sizes": {"rod1": [230, None]}}
    for motion in answer("resize", asked, "en", print)["motions"]:
        assert [motion["values"][0], motion["values"][-1]] == [-20, 40]
    assert errors == []
    browser.close()


def test_sizes_that_go_together_are_taken_together(server, chromium):
    """Lengths of Bennett's linkage are as the sines of its twists: one takes the others along, unlike an angle."""
    browser, page, errors = browsed_at(chromium, server.address + "space/bennett.html#en")
    page.get_by_role("button", name="Pause").click()
    alert = page.locator('[data-panel="sizes"] [role="alert"]')
    undo = page.locator('[data-icon="undo"]')

    def typed(field, size, said):
        page.locator(f"#size-{field}").fill(size)
        page.locator(f"#size-{field}").press("Enter")
        page.locator('[data-panel="sizes"] [role="alert"]', has_text=said).wait_for()

    fields = f"[...{TYPED}].map((field) => field.value)"
    for field, size, said in (
        ("0-1", "80", "unless other sizes change as well. Not used yet"),
        ("1-1", "−5", "not −5°."),
    ):
        typed(field, size, said)
        assert undo.is_disabled()  # nothing has changed
    page.get_by_role("button", name="Put back").click()
    assert page.evaluate(fields) == ["120", "90", "60", "30"] * 2
    typed("0-0", "100", "all lengths have changed")
    page.locator("header small", has_text="changed").wait_for(state="attached")
    assert page.evaluate(fields) == ["100", "90", "50", "30"] * 2
    undo.click()
    assert (alert.inner_text(), page.evaluate(fields)) == ("", ["120", "90", "60", "30"] * 2)
    # sines of 90 and 45 degrees
    for field, size, said in (("1-1", "45", "Not used yet"), ("3-1", "45", "Not used yet"), ("1-0", "84.8528", "Not")):
        typed(field, size, said)
    page.locator("#size-3-0").fill("84.8528")
    page.locator("#size-3-0").press("Enter")
    page.locator("header small", has_text="changed").wait_for(state="attached")
    assert page.evaluate(fields) == ["120", "90", "84.8528", "45"] * 2
    assert errors == []
    browser.close()


def test_other_sizes_are_made_for_pages_of_this_server_only(server):
    def ask(content, origin):
        asked = Request(server.address + "space/resize", data=content, headers={"Origin": origin})
        with urlopen(asked, timeout=60) as told:
            return json.loads(told.read())

    own = server.address.split("/", 3)
    own = f"{own[0]}//{own[2]}"
    document = screws_to_json(entry("universal_joint").placed())
    params = {"document": document, "sizes": {"frame": [None, 40]}}
    question = json.dumps({"id": 1, "lang": "de", "params": params}).encode()
    angles = [size["angle"] for size in ask(question, own)["result"]["sizes"]]
    assert angles == pytest.approx([40, 90, 90, 90])
    with pytest.raises(HTTPError, match="404"):
        ask(question, "http://example.org")
    assert "not a message" in ask(b"{", own)["error"]
    assert "at most 400,000" in ask(b"x" * 500_000, own)["error"]
    assert "resize" in ask(b'{"id": 1, "params": {"sizes": 1}}', own)["error"]


def test_a_view_that_is_turned_by_hand_has_no_name(tmp_path, chromium):
    path = tmp_path / "bennett.html"
    assert main(["explore", "bennett", "-o", str(path)]) == 0
    browser, page, errors = browsed(chromium, path)
    page.get_by_role("button", name="Pause").click()
    views = page.locator('[aria-label="View"] button')
    pressed = "all => all.map((one) => one.ariaPressed)"
    assert views.evaluate_all(pressed) == ["true", "false", "false", "false"]
    assert page.locator(".stage path.driven").count() == 1
    assert page.get_by_label("Names").count() == 1  # of the bodies: no point has one
    page.locator(".stage > svg").focus()
    page.keyboard.press("ArrowLeft")
    assert views.evaluate_all(pressed) == ["false"] * 4
    views.nth(2).click()
    assert views.evaluate_all(pressed) == ["false", "false", "true", "false"]
    page.get_by_label("Language").select_option("de")
    assert page.locator('[aria-label="Ansicht"] button').evaluate_all(pressed) == ["false", "false", "true", "false"]
    assert errors == []
    browser.close()


def test_the_way_back_leads_to_the_other_views(server, chromium):
    browser, page, errors = browsed_at(chromium, server.address + "space/universal_joint.html#de")
    page.set_viewport_size({"width": 1280, "height": 720})
    tabs = "() => [...gruebler.root.querySelectorAll('nav > *')].map((tab) => tab.getBoundingClientRect().x)"
    places = page.locator("nav > a").evaluate_all("(all) => all.map((tab) => tab.getBoundingClientRect().x)")
    page.get_by_role("link", name="Katalog").click()
    page.locator(".view.shown h2", has_text="Katalog").wait_for()
    assert page.evaluate(tabs) == pytest.approx(places, abs=0.5)  # they stay where they are
    chip = page.get_by_role("button", name="Im Raum", exact=True)
    chip.click()
    view = page.locator('[data-page="catalog"]')
    page.locator('[data-id="bennett"]').wait_for()
    view.evaluate("(view) => view.scrollTo(0, 90)")
    page.locator('[data-id="gough"]').click()
    page.locator("header small", has_text="Gough-Plattform").wait_for()
    page.get_by_role("button", name="Datei öffnen").click()  # on the page above
    page.locator('.motion.shown [data-panel="sizes"]').wait_for()
    page.go_back()
    page.locator("header small", has_text="Gough-Plattform").wait_for()
    page.go_back()
    page.locator('[data-id="bennett"]').wait_for()
    assert chip.get_attribute("aria-pressed") == "true"
    assert view.evaluate("(view) => view.scrollTop") >= 90
    assert errors == []
    browser.close()


def test_a_machine_in_space_stays_in_motion_and_the_one_before_is_not_lost(server, chromium):
    """Over another view and back, with the sizes that were typed; undoing leads to the machine in the plane."""
    browser, page, errors = browsed_at(chromium, server.address, wanted=".motion.shown")
    structure = page.locator('[data-view="structure"][aria-selected="true"]')
    title = page.locator("header small")
    plane, wiper = (entry(id).name.in_language("en") for id in ("quad", "wiper_rssr"))
    for id, name in (("quad", plane), ("wiper_rssr", wiper)):
        page.get_by_role("tab", name="Catalog").click()
        page.locator(f'[data-id="{id}"]').click()
        title.get_by_text(name).wait_for(state="attached")
    crank = page.locator("#size-1-0")
    crank.fill("50")
    crank.press("Enter")
    changed = title.get_by_text(f"{wiper}, changed")
    changed.wait_for(state="attached")
    assert page.get_by_role("button", name="Pause").count() == 1  # it plays on
    page.get_by_role("link", name="Structure").click()
    structure.wait_for()
    page.get_by_role("tab", name="Motion").click()
    changed.wait_for(state="attached")
    assert crank.input_value() == "50"
    assert page.locator('[data-icon="undo"]').is_enabled()
    page.go_back()
    structure.wait_for()
    page.locator('[data-icon="undo"]').click()
    page.locator(".motion.shown").wait_for()
    assert title.text_content() == plane
    page.go_back()
    page.get_by_role("tab", name="Motion").click()
    changed.wait_for(state="attached")
    assert errors == []
    browser.close()


def test_a_browser_that_cannot_draw_in_space_says_so(tmp_path, chromium):
    path = tmp_path / "bennett.html"
    assert main(["explore", "bennett", "-o", str(path)]) == 0
    browser, page, errors = browsed(chromium, path)
    page.add_init_script("HTMLCanvasElement.prototype.getContext = () => null")
    for lang, said in (
        ("en", "This browser cannot draw in space"),
        ("de", "Dieser Browser kann nicht räumlich zeichnen"),
    ):
        page.goto(f"{path.as_uri()}?{lang}#{lang}")
        page.get_by_text(said).wait_for(state="visible")
    assert not errors
    browser.close()


def test_a_cell_of_a_notebook_has_the_page(tmp_path, chromium):
    shown = gr.explore(Bennett(200, 1, 0.5), height=300, lang="de")
    assert shown.save(tmp_path / "a.html").read_text(encoding="utf-8") == shown.html
    cell = tmp_path / "cell.html"
    cell.write_text(f"<!doctype html><p>Before</p>{shown._repr_html_()}", encoding="utf-8")
    browser, page, errors = browsed(chromium, cell, wanted="iframe")
    frame = page.frame_locator("iframe")
    frame.get_by_role("button", name="Anhalten").click()
    assert drive_to(frame, "90").input_value() == "90°"
    assert page.locator("iframe").bounding_box()["height"] == 300
    assert errors == []
    browser.close()


def test_joints_and_the_transfer_function_are_measured_and_plotted(server, chromium):
    """Of a universal joint the ratio of any textbook, cos b / (1 - sin² b cos² q) from where the fork of the input lies
    in the plane of the shafts; the joints of Bennett's linkage as the library has them.
    """
    browser, page, errors = browsed_at(chromium, server.address + "space/universal_joint.html#en")
    page.get_by_role("button", name="Pause").click()
    bend = math.radians(30)
    measured = page.locator('[data-panel="measures"]')
    ratios = []
    for degrees in (20, 70, 200):
        drive_to(page, str(degrees))
        told = measured.locator('dt:text-is("Transfer function ψ′") + dd').inner_text()
        ratios.append(float(told))
        assert page.locator(".plot .read").nth(1).text_content() == told
    wanted = np.cos(bend) / (1 - np.sin(bend) ** 2 * np.cos(np.radians((20, 70, 200))) ** 2)
    assert ratios == pytest.approx(wanted.tolist(), rel=2e-3)
    titles = page.locator(".plot .title").all_text_contents()
    joints = ["cross relative to input [°]", "output relative to cross [°]"]
    assert titles == ["output [°]", "Transfer function ψ′", *joints]
    browser.close()

    browser, page, more = browsed_at(chromium, server.address + "space/bennett.html#de")
    page.get_by_role("button", name="Anhalten").click()
    drive_to(page, "50")
    linkage = entry("bennett").placed()
    motion = move(linkage, [math.radians(50)])
    names = space_model(linkage)["texts"]["de"]["joints"]
    chain = linkage.mechanism.chain
    facts = read_off(page)
    found = [number_in(text.replace(",", ".")) for name, text in facts.items() if re.search(" gegen (?!die)", name)]
    wanted = [
        math.degrees(motion.joint(each, "Rz")[0])
        for each, joint in zip(chain.joint_names(), chain.joints, strict=True)
        if "frame" not in joint.links
    ]
    assert len(names) == len(found) == 2
    assert found == pytest.approx(wanted, abs=2e-2)
    output = math.degrees(motion.joint("R(frame-follower)", "Rz")[0])  # it turns against the drive
    assert number_in(next(iter(facts.values())).replace(",", ".")) == pytest.approx(output, abs=2e-2)
    assert errors == more == []
    browser.close()


def read_off(page):
    """What is measured, as texts by their names."""
    facts = page.locator('[data-panel="measures"] .facts > div')
    pairs = "all => all.map((one) => [one.querySelector('dt').textContent, one.querySelector('dd').textContent])"
    return dict(facts.evaluate_all(pairs))


def number_in(text):
    return float(text.split()[0].replace("−", "-").rstrip("°"))


def heights_of(plot):
    """Of the line of a plot, in its pixels downward."""
    line = plot.locator("path.curve").first.get_attribute("d")
    return [float(place.split()[1]) for place in line.replace("M", "L").split("L")[1:]]


def test_outputs_are_told_with_sign_and_full_turns(server, chromium):
    """As they are by hand: a universal joint, tan psi = tan phi / cos b, with b = 30 degrees; a right-handed screw that
    turns by phi and does not shift, so that its nut is drawn against the axis by the lead of 12 mm a turn; Willis for
    the bevel gear differential, of the two suns phi1 + phi2 = 2 phi of the carrier."""
    browser, page, errors = browsed_at(chromium, server.address + "space/universal_joint.html#en")
    page.get_by_role("button", name="Pause").click()
    for degrees in (20, 110, 200, 340):
        drive_to(page, str(degrees))
        bent = math.degrees(math.atan(math.tan(math.radians(degrees)) / math.cos(math.radians(30))))
        wanted = bent + 180 * round((degrees - bent) / 180)
        assert number_in(read_off(page)["output: turn from the reference pose"]) == pytest.approx(wanted, rel=6e-4)

    page.goto(server.address + "space/winch_screw.html#en")
    page.get_by_role("button", name="Pause").click()
    for degrees in ("0", "360"):  # at an end of the range too
        drive_to(page, degrees)
        assert number_in(read_off(page)["Transfer function s′"]) == pytest.approx(-12 / (2 * math.pi), abs=1e-3)
    assert read_off(page)["nut: travel"] == "12 mm"
    drive_to(page, "100")
    facts = read_off(page)
    assert number_in(facts["nut: shift from the reference pose"]) == pytest.approx(-12 * 100 / 360, abs=1e-3)
    assert number_in(facts["Transfer function s′"]) == pytest.approx(-12 / (2 * math.pi), abs=1e-3)
    slope = page.locator(".plot").nth(1)
    heights = heights_of(slope)
    assert len(heights) > 10
    assert max(heights) - min(heights) < 0.2  # a flat line
    assert len(set(slope.locator("g").first.locator("text").all_text_contents())) > 2

    page.goto(server.address + "space/diff_bevel.html#en")
    page.get_by_role("button", name="Pause").click()
    assert page.locator(".stage path.driven").count() == 1  # that of the other drive lies behind bodies, on the canvas
    carrier, sun = page.locator('[data-panel="drives"] input').all()
    name = "sun\xa02: turn from the reference pose"
    links = page.locator('[data-panel="links"]')
    before = links.bounding_box()["y"]
    assert "Transfer function ψ′" in read_off(page)  # its row is there while the plots are made
    page.locator(".plot").first.wait_for()
    assert abs(links.bounding_box()["y"] - before) < 6
    drive_to(page, "358.5")
    assert read_off(page)[name] == "717°"
    assert read_off(page)["Transfer function ψ′"] == "2"
    assert page.locator(".plot .read").first.text_content() == "717"
    assert math.degrees(float(carrier.input_value())) == pytest.approx(358.5)  # from 0 on, as it is told
    sun.fill(str(math.radians(260)))  # -100 degrees are nearer
    assert read_off(page)[name] == "457°"
    page.locator('[data-panel="measures"] dt:text-is("Transfer function ψ′") + dd:text-is("−1")').wait_for()
    for value in (3, -2, 2, -3, 3, -1):  # in small steps backwards round and round
        carrier.fill(str(value % math.tau))
    wanted = 2 * (360 - math.degrees(1)) - 260
    assert number_in(read_off(page)[name]) == pytest.approx(wanted, abs=0.06)
    assert errors == []
    browser.close()


def test_a_link_that_turns_about_no_axis_has_a_total_turn_without_a_kink(server, chromium):
    """Against the poses of the library; a range says its unit once, as in the plane."""
    linkage = entry("susp_5link_lift").placed()
    poses = move(linkage, [0.0, 60.0]).poses[0]
    turn = math.degrees(math.acos((np.trace(poses[-1, linkage.mechanism.chain.index("knuckle"), :3, :3]) - 1) / 2))
    browser, page, errors = browsed_at(chromium, server.address + "space/susp_5link_lift.html#en")
    page.get_by_role("button", name="Pause").click()
    name = "knuckle: total turn from the reference pose"
    drive_to(page, "60")
    assert number_in(known(page, name)) == pytest.approx(turn, rel=1e-3)
    drive_to(page, "-60")
    assert number_in(read_off(page)[name]) < 0
    assert read_off(page)["Range of the drive"] == "−60 … 60\xa0mm"
    assert "T, tyre contact point" in read_off(page)
    plot = page.locator(".plot").first
    assert plot.locator(".title").text_content() == "knuckle: total turn [°]"
    heights = heights_of(plot)
    assert heights == sorted(heights, reverse=True)  # it goes on up through 0
    page.goto(server.address + "space/delta.html#en")  # its platform shifts along an arc
    page.get_by_role("button", name="Pause").click()
    page.locator(".plot").wait_for()
    ends = []
    for degrees in (-20, 40):
        drive_to(page, str(degrees))
        ends.append(number_in(known(page, "platform: shift from the reference pose")))
    drive_to(page, "-0.3")  # nearer to the reference pose than the rows of the plot
    assert number_in(read_off(page)["platform: shift from the reference pose"]) < 0
    delta = entry("delta").placed()
    platform = delta.mechanism.chain.index("platform")
    reached = [move(delta, [np.zeros(3), [math.radians(v), 0, 0]]).poses[0, -1, platform, :3, 3] for v in (-20, 40)]
    assert ends == pytest.approx([-np.linalg.norm(reached[0]), np.linalg.norm(reached[1])], rel=1e-3)
    heights = heights_of(page.locator(".plot"))
    assert heights == sorted(heights, reverse=True)
    page.goto(server.address + "space/schatz.html#de")
    page.get_by_role("button", name="Anhalten").click()
    drive_to(page, "359,9")
    assert float(read_off(page)["Behälter: Gesamtdrehung aus der Bezugslage"].replace(",", ".").rstrip("°")) > 350
    assert errors == []
    browser.close()


def test_a_body_that_is_taken_has_its_name_on_a_phone(server, chromium):
    """Beside the place that is taken, within the picture; nothing is said to move what has no drive."""
    browser, page, errors = browsed_at(chromium, server.address + "space/wiper_rssr.html#de", touch=True)
    page.set_viewport_size({"width": 390, "height": 844})
    page.get_by_role("button", name="Anhalten").click()
    drive_to(page, "30")
    box = page.locator(".stage > svg").bounding_box()
    page.locator("text.mark.body").nth(3).wait_for()  # all bodies, of so few
    name = page.locator("text.mark:not(.body)")
    for down in np.arange(0.3, 0.8, 0.02):  # the rod lies across the middle
        page.touchscreen.tap(box["x"] + box["width"] / 2, box["y"] + down * box["height"])
        if name.count():
            break
    assert name.text_content() == "Schubstange"
    drawn = name.bounding_box()
    assert 0 < drawn["x"] < drawn["x"] + drawn["width"] < 390
    page.goto(server.address + "space/susp_5link.html#en")
    assert page.locator("text.mark").count() == 0  # of seven the one that is pointed at
    page.evaluate("gruebler.scene.mark(3)")
    assert page.locator("text.mark").text_content() == "link 3"
    assert page.locator(".hint").first.text_content() == "Drag the background to turn the view."
    assert page.locator('[data-panel="measures"]').count() == 0
    assert errors == []
    browser.close()


def test_names_of_bodies_do_not_stand_on_others_that_hide_them(server, chromium):
    """The strap of a car door and its pillar are behind the door for the most part."""
    browser, page, errors = browsed_at(chromium, server.address + "space/car_door.html#en")
    page.get_by_role("button", name="Pause").click()
    drive_to(page, "14")
    page.wait_for_timeout(400)
    box = page.locator(".stage > svg").bounding_box()
    under = {}
    placed = "all => all.map((n) => [n.textContent, +n.getAttribute('x'), +n.getAttribute('y')])"
    for name, x, y in page.locator("text.mark.body").evaluate_all(placed):
        page.mouse.move(box["x"] + x, box["y"] + y)
        under[name] = page.locator(".stage").get_attribute("title")
    assert set(under) == {"pillar", "door", "strap", "pocket"}
    assert all(found in (name, "") for name, found in under.items()), under
    assert errors == []
    browser.close()


def test_a_transfer_function_of_one_is_a_flat_line_and_angles_have_ticks_of_quarter_turns(server, chromium):
    """Two universal joints in series turn their shafts alike, in any textbook: poses with six digits do not show."""
    browser, page, errors = browsed_at(chromium, server.address + "space/cardan_shaft.html#en")
    page.get_by_role("button", name="Pause").click()
    plots = page.locator(".plot")
    titles = plots.locator(".title").all_text_contents()
    ticks = [plot.locator("g").first.locator("text").all_text_contents() for plot in plots.all()]
    ratio = next(k for k, title in enumerate(titles) if title.startswith("Transfer function"))
    heights = heights_of(plots.nth(ratio))
    assert len(heights) > 10
    assert max(heights) - min(heights) < 0.2
    assert len(set(ticks[ratio])) == len(ticks[ratio]) > 2
    assert ticks[0][:3] == ["0", "90", "180"]
    one, two = (page.locator('[data-panel="measures"] dt').nth(k).bounding_box() for k in range(2))
    assert one["y"] == two["y"]  # in two columns
    drive_to(page, "6.048")
    assert page.locator('[data-panel="measures"] dd').first.inner_text() == "6.048°"
    assert errors == []
    browser.close()
