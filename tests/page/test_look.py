"""What meets the eye: a machine that moves, measures as figures, plots that are read, names beside their links."""

import json
from math import acos, degrees

import numpy as np
import pytest

from gruebler.cli import main
from gruebler.files import linkage_to_json
from gruebler.mechanics.fourbar import InvertedSliderCrank


@pytest.fixture(scope="module")
def crank_rocker(tmp_path_factory):
    path = tmp_path_factory.mktemp("look") / "crank-rocker.html"
    assert main(["explore", "crankrocker", "-o", str(path)]) == 0
    return path.as_uri()


def test_the_page_begins_with_a_machine_that_moves_unless_motion_is_unwelcome(tab, tmp_path):
    path = tmp_path / "first.html"
    assert main(["explore", "-o", str(path)]) == 0
    page = tab()
    page.page.emulate_media(reduced_motion="reduce")
    page.open(path.as_uri())
    assert page.page.evaluate("gruebler.motion.transport.player.playing") is False
    page = tab().open(path.as_uri())
    page.until("window.gruebler?.motion?.transport.player?.playing")
    before = page.page.evaluate("gruebler.motion.linkage.drives[0]")
    page.until(f"Math.abs(gruebler.motion.linkage.drives[0] - {before}) > 0.1")
    assert page.page.evaluate("gruebler.motion.linkage.sizes.points.length") > 0  # and draws a curve


def test_swing_and_time_ratio_are_figures(tab, crank_rocker):
    """Crank 25, coupler 70, rocker 40, frame 70: at the dead centres the triangle has the sides 95 or 45, 70 and 40."""

    def angle(one: float, two: float, opposite: float) -> float:
        return degrees(acos((one**2 + two**2 - opposite**2) / (2 * one * two)))

    swing = angle(70, 40, 95) - angle(70, 40, 45)
    part = angle(45, 70, 40) + 180 - angle(95, 70, 40)
    ratio = max(part, 360 - part) / min(part, 360 - part)
    page = tab().open(crank_rocker)
    facts = dict(
        page.page.locator(".facts > div").evaluate_all(
            "all => all.map((one) => ['dt', 'dd'].map((part) => one.querySelector(part).firstChild.textContent))"
        )
    )
    assert facts["Swing"] == f"{swing:.4g}°"
    assert facts["Time ratio"] == f"{ratio:.4g}"
    assert facts["Smallest μ"] == f"{angle(70, 40, 45):.4g}°"
    assert len(facts) == 8


def test_machines_with_two_drives_show_what_both_of_them_move(tab, server):
    """The link of a five-bar that no drive turns by itself; of a lamp whose head stays level how far that goes, on
    arms of 250 mm: with the lower one between 60° and 150° the chord of 90°."""
    page = tab().open(server.address).machine("pent")
    facts = """Object.fromEntries([...gruebler.root.querySelectorAll(".facts > div")].map((one) =>
        ["dt", "dd"].map((part) => one.querySelector(part).firstChild.textContent)))"""
    told = set(page.page.evaluate(facts))
    assert "Output\xa04" in told
    for name in ("Swing", "Transfer function ψ′", "Range of the drive"):
        assert f"{name}:\xa01\xa0–\xa02" in told  # of the drive that is shown
    assert page.page.locator(".plot:visible").count() == 3
    # the frame, of which there is a size, has its number as the others
    assert sorted(page.page.locator(".stage text.name").all_text_contents()) == ["1", "2", "3", "4", "5"]
    page.machine("lamp")
    shown = page.page.evaluate(facts)
    assert shown["Output head"] == "106.3°"
    assert [value for name, value in shown.items() if name.startswith("Transfer function ψ′: ")] == ["0"]
    assert float(shown["Travel of its points"].removesuffix(" mm")) == pytest.approx(250 * np.sqrt(2), abs=0.1)
    assert page.page.locator("[data-note=still]").inner_text() == "Output head does not turn."
    path = page.page.locator(".stage path.spring-path").get_attribute("d")  # before its forces were asked for
    assert path.count("M") == 6  # two coils with a ring at each end


def test_a_drive_is_called_as_what_it_moves(tab, server):
    """Of a cylinder its barrel; links that are only numbered do not say which joint it is."""
    page = tab().open(server.address)
    names = """[...gruebler.root.querySelectorAll(".transport option")].map((one) => one.textContent)"""
    for machine, drives in {
        "excavator": ["boom cylinder", "stick cylinder", "bucket cylinder"],
        "lamp": ["arm 1", "arm 2"],
        "diff": ["sun", "ring gear"],
        "pent": ["1 – 2", "1 – 5"],
    }.items():
        assert page.machine(machine).page.evaluate(names) == drives
    page = tab(locale="de-DE").open(server.address).machine("excavator")
    assert page.page.evaluate(names) == ["Auslegerzylinder", "Stielzylinder", "Löffelzylinder"]
    assert page.page.locator(".facts").get_by_text("Bereich des Antriebs: Stielzylinder").count() == 1


@pytest.mark.parametrize("width", [1440, 390])
def test_a_ring_gear_has_its_name_at_its_rim_and_turns_visibly(tab, server, width):
    """Its pitch radius is 60 mm; of a rim of 2 mm the eight lines are seen to turn."""
    page = tab(width=width, height=844).open(server.address).machine("diff")
    far, half, scale = page.page.evaluate("""() => {
        const { root, motion } = gruebler;
        const { viewport } = motion.stage;
        const names = [...root.querySelectorAll("text.name")];
        const name = names.find((one) => ["ring gear", "3"].includes(one.textContent));
        const [x, y] = name.getAttribute("transform").match(/[-\\d.]+/g).map(Number);
        const [u, v] = viewport.screen(0, 0);
        return [Math.hypot(x - u, y - v), name.getComputedTextLength() / 2, viewport.scale];
    }""")
    assert 60 * scale < far < 63 * scale + half + 24
    lines = page.page.locator("[data-link=ring_gear] .hatch").get_attribute("d")
    ends = [[float(one) for one in line.replace("L", " ").split()] for line in lines.split("M")[1:]]
    assert len(ends) == 8
    for x, y, u, v in ends:
        assert np.hypot(x, y) == pytest.approx(60 * scale, abs=0.05)
        assert np.hypot(u, v) > 60 * scale + 1
        assert np.angle((u + 1j * v) / (x + 1j * y)) == pytest.approx(0, abs=1e-3)
    sizes = page.page.locator(".rows.sizes > *").all_inner_texts()
    assert sizes[:4] == ["planet, teeth", "15", "", ""]
    assert [one for one in sizes if "axis" in one] == [
        "planet\u00a0– sun, axis distance"
    ]  # the ring has the sun's axis
    assert page.page.locator(".stage .hint").inner_text() == "Drag an axis to shift it, a link to turn it."
    page.machine("excavator")  # eleven links, of which most have no room beside them on a phone
    names, joints = page.page.evaluate("""() => {
        const box = (one) => one.getBoundingClientRect();
        const { root } = gruebler;
        const names = [...root.querySelectorAll(".stage text.name")].map(box);
        return [names.map((one) => [one.x, one.y + 3, one.right, one.bottom - 3]).filter((one) => one[2] > one[0]),
            [...root.querySelectorAll(".stage circle.joint")].map(box).map((one) => [one.x + 5, one.y + 5])];
    }""")
    assert len(names) == 11
    for k, (left, top, right, bottom) in enumerate(names):
        assert not [one for one in joints if left < one[0] < right and top < one[1] < bottom]
        others = names[:k]
        assert not [o for o in others if left < o[2] and o[0] < right and top < o[3] and o[1] < bottom]
    if width > 500:
        return
    # there numbers stand at the links and the names below them, also in a saved picture
    entries = page.page.locator(".stage [data-entry]")
    assert entries.first.text_content() == "2 boom"
    assert [one.split()[0] for one in entries.all_text_contents()] == [str(one) for one in range(2, 13)]
    assert entries.first.bounding_box()["y"] > max(y for _, y in joints)
    boxes = [one.bounding_box() for one in entries.all()]
    below = page.page.locator(".stage .hint").bounding_box()["y"]
    assert max(box["y"] + box["height"] for box in boxes) <= below
    ends = page.page.locator(".stage [data-entry] tspan").evaluate_all(
        "all => all.map((one) => Math.round(one.getBoundingClientRect().right))"
    )
    assert len(set(ends)) < len(ends) / 2  # numbers of one and of two digits end below one another
    # two rows, in which the slider is below the choice; each driven cylinder has an arrow in its barrel
    assert page.page.locator(".transport").bounding_box()["height"] < 125
    assert page.page.locator(".stage path.driven").count() == 3
    entries.first.hover()
    assert page.page.locator(".stage .hovered").get_attribute("data-link") == "boom"
    assert page.page.evaluate("gruebler.motion.picture()").count("</tspan> bucket cylinder") == 1
    lines = page.page.locator(".stage text.name").first.locator("xpath=../*[1]").get_attribute("d")
    ends = [[float(one) for one in line.split("M")[0].replace("L", " ").split()] for line in lines.split("M")[1::2]]
    assert max(np.hypot(u - x, v - y) for x, y, u, v in ends) < 48
    page.page.locator('[data-panel="show"]').scroll_into_view_if_needed()  # the low picture is left to the machine
    page.until("gruebler.root.querySelector('.motion .stage').getBoundingClientRect().height < 250")
    page.until("gruebler.root.querySelector('.motion .bodies').getBoundingClientRect().height > 60")
    assert entries.count() == 0
    assert page.page.locator('.stage text.name:not([display="none"])').count() == 0  # no number without the list
    # the way of a block is drawn from where it is measured while the value is pointed at
    page.machine("slidercrank")
    way = page.page.locator(".stage .ruler")
    assert not way.get_attribute("d")
    page.page.locator(".facts > div").first.hover()
    assert way.get_attribute("d").startswith("M")
    assert "from the dot" in page.page.locator(".facts > div").first.get_attribute("title")


def test_a_plot_says_the_value_at_the_pointer(tab, crank_rocker):
    page = tab().open(crank_rocker)
    plot = page.page.locator(".plot").first
    read = plot.locator("text.read")
    here = read.text_content()
    assert plot.locator(".title").text_content() == "Output rocker [°]"
    assert plot.get_by_text("Drive [°]", exact=True).count() == 1
    assert float(here) == pytest.approx(float(page.page.locator(".facts dd").first.text_content().strip("°")), abs=0.02)
    assert plot.locator("g text").all_text_contents() == [
        "60",
        "90",
        "120",
        "0",
        "90",
        "180",
        "270",
        "360",
    ]
    box = plot.bounding_box()
    page.page.mouse.move(box["x"] + box["width"] * 0.6, box["y"] + box["height"] / 2)
    place, value = read.text_content().split("°: ")
    drives, values = page.page.evaluate(
        "(({ drives, series }) => [[...drives], [...series.values]])(gruebler.motion.plots.parts[0].plot)"
    )
    assert float(value) == pytest.approx(np.interp(np.radians(float(place)), drives, values), abs=0.1)
    page.page.mouse.move(5, 300)
    assert read.text_content() == here
    domains = "gruebler.motion.plots.parts.map(({ plot }) => plot.domain.map((one) => (one * 180) / Math.PI))"
    for _ in range(2):
        page.page.locator("[data-plots=more]").click()
    drive = float(page.page.locator(".transport .value").input_value().strip("°"))
    for first, last in page.page.evaluate(domains):  # all of them, about the drive
        assert [first, last] == pytest.approx([0.75 * drive, 0.75 * drive + 90], abs=0.1)
    assert read.text_content() == here
    page.page.mouse.move(box["x"] + box["width"] * 0.6, plot.bounding_box()["y"] + box["height"] / 2)
    page.page.keyboard.down("Control")
    page.page.mouse.wheel(0, -200)
    page.page.keyboard.up("Control")
    page.page.wait_for_timeout(50)
    assert np.ptp(page.page.evaluate(domains)[0]) == pytest.approx(90 / np.e, rel=1e-6)
    plot.dblclick()
    assert page.page.evaluate(domains)[0] == pytest.approx([0, 360])


def test_names_stand_beside_their_links(tab, crank_rocker):
    page = tab().open(crank_rocker)
    near = """(() => {
        const { linkage, stage } = gruebler.motion;
        const hull = (link) => linkage.model.elements.filter((e) => e.link === link)
            .map((e) => stage.viewport.screen(...linkage.jointAt(e.joint)));
        const names = [...stage.root.querySelectorAll("text.name")];
        return [1, 2, 3].map((link, k) => {
            const ends = hull(link);
            const [[ax, ay], [bx, by]] = ends;
            const box = names[k].getBBox();
            const { e, f } = names[k].transform.baseVal[0].matrix;
            const corners = [[0, 0], [1, 0], [0, 1], [1, 1]].map(([u, v]) =>
                [e + box.x + u * box.width, f + box.y + (0.25 + 0.5 * v) * box.height]);
            const sides = corners.map(([x, y]) =>
                ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / Math.hypot(bx - ax, by - ay));
            return Math.min(...sides.map(Math.abs)) * (new Set(sides.map(Math.sign)).size === 1 ? 1 : -1);
        });
    })()"""
    for drive in np.linspace(0, 6, 9):
        page.page.evaluate(f"gruebler.motion.transport.pick({drive})")
        assert min(page.page.evaluate(near)) > 2, drive


@pytest.mark.parametrize("locale", ["en-US", "de-DE"])
def test_names_of_a_phone_are_nearer_to_their_own_bar_than_to_another(tab, crank_rocker, locale):
    """Where two bars do not lie on each other, at any drive: the middle and both ends of each name."""
    page = tab(width=390, height=844, touch=True, locale=locale).open(crank_rocker)
    distances = """(() => {
        const { linkage, stage } = gruebler.motion;
        const hull = (link) => linkage.model.elements.filter((e) => e.link === link)
            .map((e) => stage.viewport.screen(...linkage.jointAt(e.joint)));
        const bars = [1, 2, 3].map(hull);
        const names = [...stage.root.querySelectorAll("text.name")];
        return [bars, names.map((name) => {
            const box = name.getBBox(), { e, f } = name.transform.baseVal[0].matrix;
            return [0, 0.5, 1].map((part) => [e + box.x + part * box.width, f + box.y + box.height / 2]);
        })];
    })()"""

    def away(place, bar) -> float:
        (x, y), (u, v) = (np.subtract(end, bar[0]) for end in (place, bar[1]))
        part = np.clip((x * u + y * v) / (u * u + v * v), 0, 1)
        return float(np.hypot(x - part * u, y - part * v))

    sharpest = 180.0
    for drive in range(0, 360, 10):
        page.page.evaluate(f"gruebler.motion.transport.pick({np.radians(drive)})")
        bars, names = page.page.evaluate(distances)
        angles = [np.degrees(np.angle(complex(*np.subtract(*bar)))) for bar in bars]
        apart = min(abs((one - other + 90) % 180 - 90) for k, one in enumerate(angles) for other in angles[:k])
        if apart < 15:
            continue
        sharpest = min(apart, sharpest)
        for k, places in enumerate(names):
            for place in places:
                own, *others = (away(place, bars[(k + shift) % 3]) for shift in range(3))
                assert own < min(others), (drive, k)
    assert sharpest < 30


@pytest.mark.parametrize(("locale", "name"), [("en-US", "crank"), ("de-DE", "Kurbel")])
def test_the_name_of_a_short_crank_does_not_lie_on_the_hatching_of_its_ground(tab, tmp_path, locale, name):
    """The lambda mechanism on a phone: with its crank along the ground there is room below that."""
    from gruebler.cli import main

    path = tmp_path / "lambda.html"
    assert main(["explore", "lambda", "-o", str(path), "--lang", locale[:2]]) == 0
    page = tab(width=390, height=844, touch=True, locale=locale).open(path.as_uri())
    overlap = """(name) => {
        const texts = [...gruebler.motion.stage.root.querySelectorAll("text.name")];
        const box = texts.find((one) => one.textContent === name).getBoundingClientRect();
        return [...gruebler.root.querySelectorAll(".stage path.support")].map((one) => one.getBoundingClientRect())
            .some((g) => box.left < g.right && g.left < box.right && box.top + 3 < g.bottom && g.top < box.bottom - 3);
    }"""
    for drive in (0, np.pi):
        page.page.evaluate(f"gruebler.motion.transport.pick({drive})")
        assert not page.page.evaluate(overlap, name), drive


def test_arrows_say_how_much_the_longest_of_them_is(tab, crank_rocker):
    """The end of the crank, 25 mm long, has 25 mm/rad; nothing of a rocker of 40 mm that swings 80 degrees has more at
    90 degrees of the crank."""
    page = tab().open(crank_rocker)
    page.page.evaluate("gruebler.motion.transport.pick(1.5)")
    values = page.page.locator(".stage [data-arrow]")
    assert values.all_text_contents() == []
    page.page.locator("[data-panel=show] summary").click()
    page.page.get_by_label("Velocities").check()
    rate = 40 * page.page.evaluate("gruebler.motion.linkage.pose.rates[3]")  # rocker: length by angular velocity
    assert values.all_text_contents() == [f"{max(25, rate):.3g} mm/rad"]


def test_lengths_without_a_unit_leave_no_empty_brackets(tab, tmp_path):
    from gruebler.mechanics.fourbar import SliderCrank
    from gruebler.page.model import model_of
    from gruebler.page.page import single_file

    path = tmp_path / "plain.html"
    path.write_text(single_file(model_of(SliderCrank(25, 70).linkage(unit=""), name="plain")), encoding="utf-8")
    page = tab().open(path.as_uri())
    titles = page.page.locator(".plot").evaluate_all("all => all.map((one) => one.ariaLabel)")
    assert any("[length]" in title for title in titles)
    assert not any(sign in page.page.locator(".side").inner_text() for sign in ("[]", "[/", "·\n", "/]"))


def test_the_grid_has_numbers(tab, crank_rocker):
    """Where their places lie; drawn again only where they come to lie elsewhere."""
    page = tab().open(crank_rocker)
    ticks = page.page.locator(".stage .grid .tick")
    written = ticks.all_text_contents()
    assert written[0] == page.page.evaluate("gruebler.motion.linkage.model.unit")
    foot = page.page.evaluate("gruebler.motion.stage.viewport.height") - 8
    lower = [tick for tick in ticks.all() if float(tick.get_attribute("y")) == foot][1:]
    assert len(lower) > 3
    for tick in lower:
        value = tick.text_content().replace("−", "-")
        expected = page.page.evaluate(f"gruebler.motion.stage.viewport.screen({value}, 0)[0]")
        assert abs(float(tick.get_attribute("x")) - 3 - expected) <= 1
    page.page.evaluate("gruebler.motion.transport.pick(1)")
    assert page.page.evaluate("(old) => old.isConnected", lower[0].element_handle())
    page.page.evaluate("gruebler.motion.stage.zoom(0.3)")
    assert ticks.all_text_contents() != written
    page.page.evaluate("gruebler.motion.shown.grid = false, gruebler.motion.redraw()")
    assert ticks.count() == 0


def test_lines_of_the_picture_are_named_in_their_colours(tab, crank_rocker):
    """Each colour of the legend is one that its lines are drawn in; a hodograph without a point draws nothing."""
    page = tab().open(crank_rocker)
    page.page.evaluate("gruebler.motion.transport.pick(1)")
    page.page.locator('summary:text("Show")').last.click()
    colours = """(texts) => texts.map((text) => {
        const lines = [...gruebler.root.querySelectorAll(".options small")];
        return getComputedStyle(lines.find((one) => one.textContent.includes(text))).color;
    })"""
    fixed, moving = page.page.evaluate(colours, ["fixed", "moving"])
    painted = """(() => {
        const canvas = gruebler.root.querySelector(".motion canvas");
        const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
        const found = new Set();
        for (let k = 0; k < data.length; k += 4)
            if (data[k + 3] === 255) found.add(`rgb(${data.slice(k, k + 3).join(", ")})`);
        return [...found];
    })()"""
    page.page.get_by_label("Coupler curves").uncheck()
    page.page.get_by_label("Hodographs").check()
    assert page.page.evaluate(painted) == []
    page.page.get_by_label("Pole and centrodes").check()
    assert {fixed, moving} <= set(page.page.evaluate(painted))
    assert fixed != moving
    page.page.get_by_label("Inflection circle").check()
    assert page.page.locator(".inflection").evaluate("(one) => getComputedStyle(one).stroke") == fixed
    arrow = page.page.locator("path.acceleration").evaluate("(one) => getComputedStyle(one).stroke")
    assert arrow not in (fixed, moving)
    assert page.page.get_by_text("⇢").evaluate("(one) => getComputedStyle(one).color") == arrow


def test_a_pole_outside_of_the_picture_is_told(tab, crank_rocker):
    """Where the lines of crank and rocker meet: with the crank at 180° in the right bearing, at 57.3° far above."""
    page = tab().open(crank_rocker)
    hint = page.page.locator(".stage .hint").last
    said = "The pole lies outside of the picture."
    assert said not in hint.inner_text()
    page.page.evaluate("gruebler.motion.shown.poles = true")
    page.page.evaluate("gruebler.motion.transport.pick(1)")
    assert said in hint.inner_text()
    page.page.evaluate("gruebler.motion.transport.pick(Math.PI)")
    assert said not in hint.inner_text()


def test_the_header_has_room_for_its_name_and_its_language_in_german(tab, server):
    page = tab(width=1024, height=768, locale="de-DE").open(server.address)
    name, language = (page.page.locator(f"header {tag}").bounding_box() for tag in ("h1", "select"))
    assert name["width"] > 111
    assert language["x"] + language["width"] <= 1024
    assert abs(name["y"] + name["height"] / 2 - language["y"] - language["height"] / 2) < 6  # one row


def test_the_header_of_a_phone_is_not_cut(tab, server):
    page = tab(width=390, height=844, locale="de-DE", touch=True).open(server.address)
    for part in ("h1", "h1 small"):
        cut = "(e) => e.scrollWidth > e.clientWidth + 1 || e.scrollHeight > e.clientHeight + 1"
        assert page.page.locator(f"header {part}").evaluate(cut) is False
    assert page.page.locator("header h1").inner_text().split() == ["gruebler", "Kurbelschwinge"]
    page.page.tap('[data-view="catalog"]')
    page.page.tap('[data-id="walschaerts_gear"]')  # a name with another one in brackets
    page.until("gruebler.view === 'motion' && gruebler.motion.linkage.model.source === 'walschaerts_gear'")
    assert page.page.locator("header small").evaluate(cut) is False
    assert page.page.locator("header small").inner_text() == "Heusinger-Steuerung"
    assert page.page.locator("header").bounding_box()["height"] < 110
    wide = "(() => { const { right, left } = gruebler.root.querySelector('.stage .bodies').getBoundingClientRect();"
    assert page.page.evaluate(f"{wide} return right - left; }})()") > 260  # the buttons stand in a row above it


@pytest.mark.parametrize("id_", ["crankrocker", "slidercrank"])
def test_the_knob_of_the_drive_stays_in_its_track(tab, server, id_):
    """At both ends of it, on a phone: knob and numbers are within the track, which is within the bar."""
    page = tab(width=390, height=844, touch=True).open(server.address).machine(id_)
    for drive in (0, 359.9):
        page.page.evaluate(f"gruebler.motion.transport.pick({np.radians(drive)})")
        boxes = page.page.locator(".track, .track svg *").evaluate_all(
            "all => all.map((e) => e.getBoundingClientRect()).map(({ left, right, width }) => [left, right, width])"
        )
        (left, right, _), *parts = boxes
        assert right < 390 - 9
        assert all(left <= a and b <= right for a, b, width in parts if width), drive


@pytest.mark.parametrize(("id_", "follower", "lower"), [("cam", "valve", ".block"), ("cam_roller", "roller", "circle")])
def test_the_stem_of_a_follower_stays_in_a_guide_that_touches_nothing(tab, server, id_, follower, lower):
    page = tab().open(server.address).machine(id_)
    boxes = """(lower) => [".ground .rail", ".bodies .bar", lower].map((what) => {
        const { top, bottom } = gruebler.root.querySelector(what).getBoundingClientRect();
        return [top, bottom];
    }).concat([[...gruebler.root.querySelectorAll("text.name")].filter((e) => e.textContent === "cam")
        .map((e) => e.getAttribute("transform"))])"""
    names = set()
    for drive in range(0, 360, 45):
        page.page.evaluate(f"gruebler.motion.transport.pick({np.radians(drive)})")
        rail, stem, plate, (name,) = page.page.evaluate(boxes, f"[data-link={follower}] {lower}")
        assert stem[0] < rail[0] < rail[1] < plate[0] < stem[1], drive
        names.add(name)
    assert len(names) == 1  # that of the cam keeps still
    if id_ == "cam":
        return
    base = "gruebler.motion.linkage.model.document.elements.cam['G(cam-roller)'].base"
    page.page.get_by_label("cam, radius of the base circle").fill("55")
    page.page.keyboard.press("Enter")
    page.page.get_by_text("Cam with roller follower, changed").wait_for()
    assert page.page.evaluate(base) == 55
    assert np.sin(page.page.evaluate("gruebler.motion.linkage.drives[0]")) == pytest.approx(np.sin(np.radians(315)))
    assert page.page.evaluate("gruebler.motion.linkage.jointAt(2)") == pytest.approx([0, 65])
    page.page.get_by_label("cam, rise").fill("400")
    page.page.keyboard.press("Enter")
    page.page.get_by_text("Expected a number from 0.001 to 360.").wait_for()
    page.page.get_by_label("cam, rise").fill("5")
    page.page.keyboard.press("Enter")
    page.page.get_by_text("the profile crosses itself").wait_for()
    page.page.evaluate("gruebler.motion.undo()")
    assert page.page.evaluate(base) == 40


def test_names_of_a_six_bar_do_not_lie_on_each_other(tab, server):
    page = tab(width=390, height=844, locale="de-DE", touch=True).open(server.address)
    page.page.click('[data-view="catalog"]')
    page.page.locator('[data-id="klann"]').click()
    page.until("gruebler.view === 'motion' && gruebler.motion.linkage.model.source === 'klann'")
    overlaps = """(() => {
        const boxes = [...gruebler.motion.stage.root.querySelectorAll("text.name")].map((one) => {
            const { left, right, top, bottom } = one.getBoundingClientRect();
            return { left, right, top: top + 3, bottom: bottom - 3 };
        });
        const over = (a, b, low, high) => Math.min(a[high], b[high]) - Math.max(a[low], b[low]);
        return boxes.flatMap((a, k) => boxes.slice(k + 1).map((b) =>
            Math.min(over(a, b, "left", "right"), over(a, b, "top", "bottom")))).filter((one) => one > 0.5);
    })()"""
    for drive in np.linspace(0, 6, 13):
        page.page.evaluate(f"gruebler.motion.transport.pick({drive})")
        assert page.page.evaluate(overlaps) == [], drive


def test_no_name_lies_on_the_hatching_of_a_rail(tab, server):
    page = tab(width=390, height=844, locale="de-DE", touch=True).open(server.address)
    page.page.click('[data-view="catalog"]')
    page.page.locator('[data-id="slidercrank"]').click()
    page.until("gruebler.view === 'motion' && gruebler.motion.linkage.model.source === 'slidercrank'")
    gaps = """(() => {
        const box = (one) => one.getBoundingClientRect();
        const { left, right, top, bottom } = box(gruebler.root.querySelector(".ground .rail-hatch"));
        const middle = (top + bottom) / 2;
        return [...gruebler.root.querySelectorAll("text.name")].map(box).map((one) =>
            Math.max(middle - 4.5 - one.bottom, one.top - middle - 4.5, left - one.right, one.left - right));
    })()"""
    for drive in np.linspace(0, 6, 13):
        page.page.evaluate(f"gruebler.motion.transport.pick({drive})")
        assert min(page.page.evaluate(gaps)) > 0, drive


@pytest.mark.parametrize("id_", ["crankrocker", "crane", "excavator"])
def test_names_of_a_phone_are_not_cut_and_not_under_buttons(tab, server, id_):
    page = tab(width=390, height=844, locale="de-DE", touch=True).open(server.address)
    page.page.click('[data-view="catalog"]')
    page.page.locator(f'[data-id="{id_}"]').click()
    page.until(f"gruebler.view === 'motion' && gruebler.motion.linkage.model.source === '{id_}'")
    page.page.evaluate("gruebler.motion.transport.pause()")
    page.page.evaluate("scrollTo(0, 0)")
    hidden = """(() => {
        const box = (one) => one.getBoundingClientRect();
        const buttons = [...gruebler.root.querySelectorAll(".motion .stage .tools button")].map(box);
        return [...gruebler.root.querySelectorAll(".motion text.name")].filter((one) => {
            const { left, right, top, bottom } = box(one);
            return left < 0 || right > 390 || buttons.some((other) => other.left < right && other.right > left
                && other.top < bottom && other.bottom > top);
        }).map((one) => one.textContent);
    })()"""
    low, high = page.page.evaluate("[gruebler.motion.linkage.cycle.low, gruebler.motion.linkage.cycle.high]")
    for drive in np.linspace(low, high, 13):
        page.page.evaluate(f"gruebler.motion.transport.pick({drive})")
        assert page.page.evaluate(hidden) == [], drive


def test_no_name_lies_on_the_edge_of_its_link(tab, server):
    """Klann's leg has links with three joints in a thin triangle: names stand within their link, or beside it."""
    page = tab(width=1024, height=768).open(server.address)
    page.page.click('[data-view="catalog"]')
    page.page.locator('[data-id="klann"]').click()
    page.until("gruebler.view === 'motion' && gruebler.motion.linkage.model.source === 'klann'")
    crossed = """(() => {
        const { linkage, stage } = gruebler.motion;
        const hull = (link) => linkage.model.elements.filter((e) => e.link === link)
            .map((e) => stage.viewport.screen(...linkage.jointAt(e.joint)));
        const names = [...stage.root.querySelectorAll("text.name")];
        const links = linkage.model.links.map((_, link) => link).filter((link) => link !== linkage.model.frame);
        return links.filter((link, number) => {
            const box = names[number].getBBox();
            const { e, f } = names[number].transform.baseVal[0].matrix;
            const within = ([x, y]) => Math.abs(x - e - box.x - box.width / 2) < box.width / 2
                && Math.abs(y - f - box.y - box.height / 2) < box.height / 2 - 3;
            const ends = hull(link);
            return ends.some(([x, y]) => ends.some(([u, v]) =>
                [...Array(101).keys()].some((k) => within([x + (u - x) * k / 100, y + (v - y) * k / 100]))));
        }).map((link) => linkage.model.links[link]);
    })()"""
    for drive in np.linspace(0, 6, 13):
        page.page.evaluate(f"gruebler.motion.transport.pick({drive})")
        assert page.page.evaluate(crossed) == [], drive


def test_tools_of_a_phone_stand_in_one_row(tab, server):
    page = tab(width=390, height=844, locale="de-DE", touch=True).open(server.address)
    page.page.click('[data-view="build"]')
    tools = page.page.locator("[data-tool]")
    boxes = tools.evaluate_all("all => all.map((e) => e.getBoundingClientRect().toJSON())")
    assert len({box["y"] for box in boxes}) == 1
    assert min(box["height"] for box in boxes) >= 44
    assert all(0 <= box["left"] < box["right"] <= 390 for box in boxes)
    page.page.locator('[data-tool="gears"]').click()
    hint = page.page.locator("[data-page] .hint, .drawing + .hint").first
    assert hint.inner_text().startswith("Räder: Beide Mitten")


def test_tools_stand_in_one_row_on_a_small_desk(tab, server):
    page = tab(width=1024, height=768, locale="de-DE").open(server.address)
    page.page.click('[data-view="build"]')
    boxes = page.page.locator("[data-tool]").evaluate_all("all => all.map((e) => e.getBoundingClientRect().toJSON())")
    assert np.ptp([box["y"] for box in boxes]) < min(box["height"] for box in boxes) / 2
    assert max(box["right"] for box in boxes) < page.page.locator('[data-page="build"] .side').bounding_box()["x"]


def test_a_machine_that_moves_by_its_dimensions_says_so_beside_the_count(tab, server):
    """Sarrus 1853: the count gives 6(6 - 1) - 6·5 = 0, the platform moves with one freedom."""
    page = tab().open(server.address)
    page.page.click('[data-view="catalog"]')
    page.page.locator('.card[data-id="sarrus"]').wait_for(timeout=60_000)
    sarrus, rocker, delta = (
        page.page.locator(f'.card[data-id="{name}"]').inner_text().replace("\xa0", " ")
        for name in ("sarrus", "crankrocker", "delta")
    )
    assert "6 links, F = 1, Grübler: 0" in sarrus
    assert rocker.endswith("4 links, F = 1")
    # 6(11 - 1) - 3·5 - 12·3 = 9, of which each of the six rods has its spin: a platform that shifts in space
    assert delta.endswith("11 links, F = 3, freely spinning parts: 6, in space")  # a dot would begin or end a line
    page.page.locator(".card svg").first.evaluate("one => one.setAttribute('data-drawn', '')")
    page.page.click('.palette [data-value="space"]')
    page.page.locator('.card[data-id="crankrocker"]').wait_for(state="detached")
    page.page.click('.palette [data-value=""]')
    page.page.locator('.card[data-id="crankrocker"]').wait_for()
    assert page.page.locator(".card svg[data-drawn]").count() == 1  # it is not drawn anew


def test_a_phone_shows_all_tabs_or_that_they_scroll_and_cards_have_one_height(tab, server):
    page = tab(width=390, height=844, locale="de-DE", touch=True).open(server.address)
    nav = page.page.locator("header nav")
    assert nav.evaluate("(e) => e.scrollWidth <= e.clientWidth")
    page.page.set_viewport_size({"width": 320, "height": 700})
    assert nav.evaluate("(e) => e.scrollWidth > e.clientWidth")  # six tabs do not fit
    assert nav.evaluate("(e) => getComputedStyle(e).maskImage").startswith("linear-gradient")
    wide = tab(width=1440, height=900).open(server.address)
    wide.page.click('[data-view="catalog"]')
    wide.page.locator('[data-list="catalog"] .card svg').first.wait_for()
    cards = wide.page.locator('[data-list="catalog"] .card')
    heights = cards.evaluate_all("all => all.slice(0, 14).map((e) => e.offsetHeight)")
    assert max(heights[:7]) == min(heights[:7])
    cut = "all => all.filter((e) => e.scrollHeight > e.clientHeight || getComputedStyle(e).overflow === 'hidden')"
    assert cards.locator("b").evaluate_all(f"all => ({cut})(all).length") == 0
    wide.page.click('[data-view="synthesis"]')
    plane = wide.page.locator(".page .plane").bounding_box()
    assert plane["width"] > 850  # of 1440


SHIFTS = """
    window.shifts = [];
    new PerformanceObserver((list) => list.getEntries().forEach(({ value, sources }) => shifts.push([value,
        ...sources.map(({ previousRect: a, currentRect: b }) => [a.y, a.height, b.y, b.height])])))
        .observe({ type: "layout-shift", buffered: true });
"""
FILLED = {
    "build": "[data-place=mobility], .mobility, [data-page=build] .note",
    "structure": "[data-fact=counted]",
    "synthesis": ".plane",
    "exercises": "[data-answer]",
    "catalog": "[data-list=catalog] .card svg",
}


def test_what_is_chosen_looks_so_under_the_pointer_and_moves_nothing(tab, server):
    page = tab(width=1440, height=900).open(server.address)
    view = page.page
    colour = "gruebler.root.querySelector('[aria-selected=true]').computedStyleMap().get('background-color').toString()"
    before = view.evaluate(colour)
    view.hover('[data-view="motion"]')
    assert view.evaluate(colour) == before
    view.click('[data-view="build"]')
    places = []
    for tool in ("ground", "link"):
        view.click(f'[data-tool="{tool}"]')
        places.append([button.bounding_box() for button in view.locator(".palette button").all()])
    assert places[0] == places[1]
    view.click('[data-view="motion"]')
    view.keyboard.press("?")
    heights = {key.bounding_box()["height"] for key in view.locator("dialog kbd").all()}
    assert len(heights) == 1  # no box is torn over two lines


@pytest.mark.parametrize(("width", "locale"), [(1440, "en-US"), (390, "en-US"), (390, "de-DE")])
def test_nothing_moves_while_a_view_is_filled(tab, server, width, locale):
    """What stands on the screen stays there when the answers come: the layout does not shift, in no view."""
    page = tab(width=width, height=844, locale=locale, touch=width < 500)
    page.page.set_default_timeout(60_000)
    page.page.add_init_script(SHIFTS)
    page.open(server.address)
    for view, part in FILLED.items():
        page.page.evaluate(f"gruebler.show('{view}')")
        page.page.locator(part).first.wait_for()
        if view == "structure":
            page.page.locator("[data-chain]").first.wait_for()
        page.page.wait_for_timeout(100)
    assert page.page.evaluate("shifts") == []
    # and a shift would be seen
    page.page.evaluate("gruebler.root.prepend(Object.assign(document.createElement('p'), { textContent: 'p' }))")
    page.until("shifts.length > 0")


def test_the_button_that_finds_stays_while_positions_are_added(tab, server):
    page = tab(width=1440, height=900).open(server.address)
    page.page.click('[data-view="synthesis"]')
    page.page.click('[data-value="positions"]')
    before = page.page.locator('[data-act="synthesise"]').bounding_box()
    for x, y in ((-40, 0), (0, 25), (35, 10)):
        page.page.mouse.click(*page.target(x, y))
    assert page.page.locator(".points tr").count() == 4
    assert page.page.locator('[data-act="synthesise"]').bounding_box() == before
    page.page.locator('[aria-label="Position 2 φ [°]"]').fill("30")
    page.page.locator('[aria-label="Position 2 φ [°]"]').press("Enter")
    assert page.page.locator(".points ~ .note").count() == 0


def test_a_screen_that_is_touched_is_not_told_of_keys(tab, server):
    for touch in (True, False):
        page = tab(width=1280, height=768, touch=touch).open(server.address)
        page.page.click('[data-view="build"]')
        assert ("(G)" in page.page.locator('[data-tool="ground"]').inner_text()) is not touch
        assert page.page.locator('[data-icon="keys"]').is_visible() is not touch


def test_a_press_of_no_length_opens_the_choice_of_a_file(tab, server):
    page = tab().open(server.address)
    pressed = (
        "addEventListener('click', (event) => { if (event.composedPath()[0].type === 'file') window.chosen = 1; })"
    )
    page.page.evaluate(pressed)
    page.page.on("filechooser", lambda _: None)  # else a browser without a screen has nothing to open
    page.page.mouse.click(*page.middle('[data-icon="open"]'))
    page.until("window.chosen")


def test_what_is_chosen_among_drives_stays_where_it_is(tab, server):
    """On a phone the cards under the finger would go down with what is said above them."""
    page = tab(width=390, height=844, touch=True).open(server.address)
    page.page.set_default_timeout(60_000)
    page.page.locator('[data-view="structure"]').tap()
    page.page.locator("[data-chain]").first.wait_for()
    page.page.evaluate("gruebler.describe('R(0-1) R(1-2) R(2-3) R(3-0)')")
    chosen = "gruebler.views.structure.structure?.inversions.some(({ frame }) => frame === '0')"
    page.until(chosen)
    page.page.locator('[data-list="inversions"] .card').first.tap()
    page.until("gruebler.views.structure.text.includes('frame=0')")
    card = page.page.locator('[data-list="driven"] .card').first
    card.scroll_into_view_if_needed()
    said = page.page.locator(".said").count()
    top = "gruebler.root.querySelector('[data-list=driven] .card')?.getBoundingClientRect().top"  # cards are made anew
    before = page.until(top)
    card.tap()
    page.until("gruebler.views.structure.structure.drives")
    page.page.locator('[data-list="driven"] .card[aria-pressed="true"]').wait_for()
    assert page.page.locator(".said").count() == said  # it had the sentence of the drive that the picture marks
    assert abs(page.until(top) - before) < 1


@pytest.mark.parametrize("locale", ["en-US", "de-DE"])
def test_on_a_phone_a_finger_meets_the_search_of_the_catalog_which_says_what_it_is(tab, server, locale):
    """Beside the order; its words stand in it, not before it, and need less room than it has."""
    page = tab(width=390, height=844, touch=True, locale=locale).open(server.address)
    page.page.locator('[data-view="catalog"]').tap()
    field = page.page.locator('[data-field="words"]')
    page.page.locator('[data-page="catalog"] [data-id]').first.wait_for()
    box, order = (one.bounding_box() for one in (field, page.page.locator('[data-field="order"]')))
    assert box["height"] >= 44
    assert box["y"] == pytest.approx(order["y"], abs=1)
    assert field.get_attribute("aria-label") == ("Wörter" if locale == "de-DE" else "Words")
    words = """field => { const pen = document.createElement("canvas").getContext("2d");
        pen.font = getComputedStyle(field).font;
        return pen.measureText(field.placeholder).width; }"""
    assert field.evaluate(words) <= box["width"] - 20
    assert page.page.evaluate("document.documentElement.scrollWidth") == 390


@pytest.mark.parametrize("width", [1440, 1024])
def test_search_and_order_of_the_catalog_are_in_line(tab, server, width):
    page = tab(width=width).open(server.address)
    page.page.click('[data-view="catalog"]')
    page.page.locator('[data-page="catalog"] [data-id]').first.wait_for()
    field, order = (page.page.locator(f'[data-field="{key}"]').bounding_box() for key in ("words", "order"))
    assert [field["y"], field["height"]] == pytest.approx([order["y"], order["height"]], abs=0.5)


def test_the_distance_of_a_slide_from_the_pivot_is_called_eccentricity(tab, server):
    page = tab(locale="de-DE").open(server.address)
    page.page.click('[data-view="catalog"]')
    page.page.locator('[data-id="slidercrank"]').click()
    page.until("gruebler.view === 'motion' && gruebler.motion.linkage.model.source === 'slidercrank'")
    names = page.page.locator('.motion [data-panel="sizes"] label').all_inner_texts()
    assert sorted(names) == ["Exzentrizität", "Kurbel", "Pleuel"]


def test_the_value_of_each_plot_stands_beside_its_title_in_english(tab, server):
    """Where the curve is not, and with some room between them."""
    page = tab(locale="en-US").open(server.address)
    page.page.click('[data-view="catalog"]')
    page.page.locator('[data-id="slidercrank"]').click()
    page.until("gruebler.view === 'motion' && gruebler.motion.linkage.model.source === 'slidercrank'")
    page.until("gruebler.root.querySelectorAll('.plot .read').length > 2")
    page.until("[...gruebler.root.querySelectorAll('.plot .read')].every((one) => one.textContent)")
    boxes = page.page.locator(".side .plot:not(.polar)").evaluate_all(
        """all => all.map((one) => [".title", ".read"].map((name) => one.querySelector(name).getBBox()))
            .map(([title, read]) => [title.x + title.width, title.y + title.height, read.x, read.y])"""
    )
    assert len(boxes) > 2
    for right, bottom, left, top in boxes:
        assert top < bottom
        assert right + 3 < left


def test_letters_of_a_phone_stay_at_their_joints_and_points_clear_of_bars_and_rails(tab, server):
    """Of a slider-crank, over its turn: the letter of its crank's pivot, the name of the point of its coupler."""
    page = tab(width=390, height=844, touch=True).open(server.address)
    page.page.tap('[data-view="build"]')
    page.page.tap('[data-begin="slider-crank"]')
    page.page.tap('[data-act="move"]')
    page.until("gruebler.view === 'motion'")
    page.page.evaluate("gruebler.motion.transport.pause()")
    seen = """(() => {
        const { linkage, stage } = gruebler.motion;
        const at = (joint) => stage.viewport.screen(...linkage.jointAt(joint));
        const middle = (text) => {
            const name = [...stage.root.querySelectorAll("text")].find((one) => one.textContent === text);
            const { e, f } = name.transform.baseVal[0].matrix;
            return [e, f - 4];
        };
        return [at(0), at(1), at(2), middle("A"), middle("K1")];
    })()"""
    arrow = np.array([(9.5, -9.5), (0, -13.4), (-9, -10), (-12.5, -5)])  # of the drive, about its joint
    far, gaps, off = [], [], []
    for drive in range(0, 360, 10):
        page.page.evaluate(f"gruebler.motion.transport.pick({np.radians(drive)})")
        a, b, c, letter, mark = map(np.array, page.page.evaluate(seen))
        far.append(np.hypot(*(letter - a)))
        gaps.append(min(np.hypot(*(letter - a - at)) for at in arrow))
        x, y = (c - b) / np.hypot(*(c - b))
        rail = c[1] + 11  # on which its block stands
        off.append(min(abs(x * (mark - b)[1] - y * (mark - b)[0]), abs(mark[1] - rail)))  # from its bar, from the rail
    assert np.mean(np.array(far) < 21) > 0.8
    assert min(gaps) > 8
    assert np.mean(np.array(off) > 9) > 0.8
    page.page.evaluate("localStorage.clear()")


def test_kinds_of_the_catalog_are_what_machines_have_and_words_are_sought_among_them(tab, server):
    page = tab().open(server.address)
    view = page.page
    view.click('[data-view="catalog"]')
    lit = view.locator('[data-page="catalog"] .palette [aria-pressed="true"]')
    ids = "[...gruebler.root.querySelectorAll('[data-list=catalog] [data-id]')].map(({ dataset }) => dataset.id)"
    assert lit.all_inner_texts() == ["All"]
    view.click('[data-value="gear"]')
    assert lit.all_inner_texts() == ["Gears"]
    # no valve gear, and nothing that is "level"
    page.until(f"{ids}.sort().join() === 'diff,diff2p,diff_bevel,diff_bevel2p,elliptic_gears,geartrain,winch_plane'")
    view.locator('[data-page="catalog"] [data-field="words"]').fill("bevel")
    page.until(f"{ids}.sort().join() === 'diff_bevel,diff_bevel2p'")
    assert lit.all_inner_texts() == ["Gears"]
    view.click('[data-value="cylinder"]')
    view.locator('[data-act="clear"]').evaluate("(key) => key.click()")
    page.until(f"{ids}.length > 100")
    assert lit.all_inner_texts() == ["All"]


@pytest.mark.parametrize("locale", ["en-US", "de-DE"])
def test_features_to_search_for_are_in_line_on_a_phone(tab, server, locale):
    page = tab(width=390, height=844, locale=locale, touch=True).open(server.address)
    page.page.click('[data-view="catalog"]')
    page.page.click('[data-panel="features"] summary')
    fields = page.page.locator('[data-panel="features"] select')
    assert fields.count() == 14
    edges = "all => all.map((one) => one.getBoundingClientRect()).map(({ left, right }) => [left, right].join())"
    assert len(set(fields.evaluate_all(edges))) == 1
    # how many there are stays in sight below them, and leads there
    key = page.page.locator('[data-panel="features"] .go button')
    page.page.locator('[data-list="catalog"] .card').nth(60).wait_for()
    assert key.inner_text().split()[1] == page.page.locator('[data-page="catalog"] .note').inner_text().split()[0]
    assert key.bounding_box()["y"] < 844
    key.click()
    assert page.page.locator('[data-list="catalog"] .card').first.bounding_box()["y"] < 844 / 2
    for name, value in (("mobility", "-7"), ("links", "3")):  # no machine has both
        page.page.select_option(f'[data-panel="features"] [data-field="{name}"]', value)
    page.until("!gruebler.root.querySelector('[data-panel=features] .go button').textContent.startsWith('↓')")
    key.click()
    page.page.locator('[data-list="catalog"] .card').nth(60).wait_for()


def test_a_print_has_name_picture_measures_sizes_and_plots(tab, server):
    """On a sheet that is 190 mm wide: nothing to press, nothing that is folded, nothing beyond its right edge."""
    page = tab(width=1440, height=900).open(server.address).page
    page.emulate_media(media="print")
    page.set_viewport_size({"width": 718, "height": 1040})
    for part in ("header h1", ".stage svg", '[data-panel="measures"]', '[data-panel="sizes"]', '[data-panel="plots"]'):
        box = page.locator(part).first.bounding_box()
        assert 0 <= box["x"] < box["x"] + box["width"] <= 718, part
    for part in ("nav", "header button", ".transport", ".tools", '[data-panel="forces"]', ".plot-tools"):
        assert not page.locator(part).first.is_visible(), part


@pytest.mark.parametrize("points", [{}, {"C": (70, 10)}])
def test_the_rod_of_an_inverted_slider_crank_is_its_coupler(tab, tmp_path, points):
    """As its preview and its names have it: the block swivels about the fixed pivot. Its angle of 90 degrees between
    guide and block is the transmission angle everywhere, so there is no place at which it is smallest."""
    file, path = tmp_path / "guide.json", tmp_path / "page.html"
    file.write_text(json.dumps(linkage_to_json(InvertedSliderCrank(a=30, d=50).linkage(points))))
    assert main(["explore", str(file), "-o", str(path)]) == 0
    page = tab(width=1440, height=900).open(path.as_uri()).page
    assert page.locator('.stage [data-link="coupler"] .rod').count() == 1
    # with a point beside it a plate up to the nearest place of the rod, as on cards
    assert page.locator('.stage [data-link="coupler"] .bar.plate').count() == len(points)
    assert page.locator('.stage [data-link="block"] .block').count() == 1
    facts = page.locator(".side .facts div", has_text="Smallest μ")
    assert facts.locator("dd").inner_text() == "90° throughout"
    assert page.locator(".track .dead").count() == 2
    assert page.locator(".track .least").count() == 0


def test_a_piston_runs_in_its_cylinder(tab, tmp_path):
    """It is drawn once, between two walls; its bore, in the file, is 60 mm. The press hangs from its upper bearing."""
    path = tmp_path / "page.html"
    assert main(["explore", "compressor", "-o", str(path)]) == 0
    page = tab(width=1440, height=900).open(path.as_uri()).page
    assert page.locator(".stage .block").count() == 0
    assert page.locator('.stage [data-link="piston"] .shape').count() == 1
    scale = page.evaluate("gruebler.motion.stage.viewport.scale")
    walls = page.locator(".ground .rail").evaluate_all("all => all.map((one) => one.getBBox().y)")
    assert sorted(walls) == pytest.approx([-30 * scale - 2, 30 * scale + 2], abs=0.1)
    # of the head one line, of which the page draws the hatching
    assert page.locator(".ground .shape.hatch").count() == 1
    assert main(["explore", "toggle_press", "-o", str(path)]) == 0
    page = tab(width=1440, height=900).open(path.as_uri()).page
    turned = "all => all.map((one) => one.getAttribute('transform'))"
    assert page.locator(".pin .support").evaluate_all(turned) == ["rotate(0)", "rotate(180)"]
    # a block stands on one rail, beside it, not on its axis
    assert page.locator(".ground .rail").count() == 1
    block, rail = (page.locator(f".stage .{name}").bounding_box() for name in ("block", "rail"))
    assert rail["x"] >= block["x"] + block["width"] - 0.1


def test_cylinders_move_between_their_stops(tab, tmp_path):
    """Not to the dead centres of boom, stick and bucket."""
    path = tmp_path / "excavator.html"
    assert main(["explore", "excavator", "-o", str(path)]) == 0
    page = tab().open(path.as_uri())
    for drive, ends in enumerate([(240, 330), (160, 280), (190, 255)]):
        page.page.evaluate(f"gruebler.motion.linkage.choose({drive})")
        found = page.page.evaluate("(({ low, high }) => [low, high])(gruebler.motion.linkage.cycle)")
        assert found == pytest.approx(ends), drive
    page.page.evaluate("gruebler.motion.linkage.choose(0); gruebler.motion.chosen()")
    facts = page.page.locator(".facts").inner_text()
    assert "240" in facts
    assert "330" in facts


def test_a_rod_that_slides_stays_in_the_picture(tab, tmp_path):
    """Crank 51, frame 60: the rod about the second pivot swings by asin(51/60) = 58 degrees to either side and reaches
    as far as the crank, 111: it comes to 94, far above the circle of the crank."""
    file, path = tmp_path / "inverted.json", tmp_path / "inverted.html"
    file.write_text(json.dumps(linkage_to_json(InvertedSliderCrank(a=51, d=60).linkage())))
    assert main(["explore", str(file), "-o", str(path)]) == 0
    page = tab(width=1440, height=900).open(path.as_uri()).page
    page.evaluate("gruebler.motion.transport.pause()")
    stage = page.locator(".view.motion .stage").bounding_box()
    ends = "(({ top, bottom }) => [top, bottom])"
    read = f"{ends}(gruebler.root.querySelector('.bodies .rod').getBoundingClientRect())"
    heights = []
    for drive in range(0, 360, 15):
        page.evaluate(f"gruebler.motion.transport.pick({drive} * Math.PI / 180)")
        rod = page.evaluate(read)
        assert stage["y"] <= rod[0] <= rod[1] <= stage["y"] + stage["height"], drive
        heights.append(rod[1] - rod[0])
    assert max(heights) > 0.3 * stage["height"]  # it swings


def test_the_plate_of_a_follower_is_drawn_where_its_face_is(tab, server):
    page = tab().open(server.address)
    page.page.click('[data-view="catalog"]')
    page.page.locator('[data-id="cam_rocker_flat"]').click()
    page.until("gruebler.view === 'motion' && gruebler.motion.linkage.model.source === 'cam_rocker_flat'")
    page.page.get_by_label("rocker, eccentricity").fill("15")
    page.page.keyboard.press("Enter")
    page.until("""(() => {
        const { elements } = gruebler.motion.document();
        const [x, y, angle] = elements.rocker["G(cam-rocker)"];
        const [c, s] = [Math.cos(angle * Math.PI / 180), Math.sin(angle * Math.PI / 180)];
        const { links, shapes } = gruebler.motion.linkage.model;
        const plate = shapes.find((one) => links[one.link] === "rocker" && one.closed).lines[0];
        const off = plate.flatMap((u, k) => (k % 2 ? [] : [Math.abs(c * (plate[k + 1] - y) - s * (u - x))]));
        return Math.hypot(x, y) > 14 && off.filter((one) => one < 1e-6).length > 1;
    })()""")


def test_several_offsets_stand_at_the_end(tab, server):
    page = tab(width=1024, height=768).open(server.address)
    page.page.click('[data-view="catalog"]')
    page.page.locator('[data-id="vcomp"]').click()
    page.until("gruebler.view === 'motion' && gruebler.motion.linkage.model.source === 'vcomp'")
    labels = page.page.locator('.motion [data-panel="sizes"] label').all_inner_texts()
    offsets = ["eccentricity, crank – piston 1", "eccentricity, crank – piston 2"]
    assert [one.replace("\xa0", " ") for one in labels[-2:]] == offsets
    # there its links have room for their names
    names = page.page.locator(".stage text.name").all_text_contents()
    assert sorted(names) == ["conrod 1", "conrod 2", "crank", "piston 1", "piston 2"]


def test_offsets_of_slides_are_called_so_and_none_is_no_size(tab, tmp_path):
    file, path = tmp_path / "offset.json", tmp_path / "offset.html"
    for offset, told in ((10.0, ["coupler, eccentricity"]), (2e-8, [])):
        file.write_text(json.dumps(linkage_to_json(InvertedSliderCrank(a=30, d=50, e=offset).linkage())))
        assert main(["explore", str(file), "-o", str(path)]) == 0
        page = tab().open(path.as_uri()).page
        assert [name for name in page.locator(".rows label").all_inner_texts() if "ecc" in name] == told
        assert "coupler" not in page.locator(".rows label").all_inner_texts()


def test_the_last_number_of_an_axis_and_the_room_over_cards_are_whole(tab, server):
    """Four turns, 1440 degrees, stand at the very end of the axis; cards keep off the features as from each other."""
    page = tab(width=1440, height=900).open(server.address)
    page.page.click('[data-view="catalog"]')
    page.page.locator('[data-id="geneva"]').wait_for()
    bottom, top = page.page.evaluate("""() => {
        const [over, cards] = ["details", ".cards"].map((name) =>
            gruebler.root.querySelector(`[data-page=catalog] ${name}`).getBoundingClientRect());
        return [over.bottom, cards.top];
    }""")
    assert top - bottom >= 8
    page.page.click('[data-id="geneva"]')
    page.until("gruebler.view === 'motion' && gruebler.motion.linkage.model.source === 'geneva'")
    last = "[...gruebler.root.querySelectorAll('.plot text')].find((one) => one.textContent === '1440')"
    page.until(f"{last} !== undefined")
    right, end = page.page.evaluate(f"""(() => {{
        const last = {last};
        return [last, last.closest(".plot")].map((one) => one.getBoundingClientRect().right);
    }})()""")
    assert right <= end


def test_a_name_keeps_off_a_target(tab, crank_rocker):
    page = tab().open(crank_rocker).page
    page.evaluate("gruebler.motion.transport.pause()")
    page.evaluate("gruebler.motion.transport.pick(1)")
    place = """(() => {
        const all = [...gruebler.motion.stage.root.querySelectorAll("text.name")];
        const { e, f } = all.find((one) => one.textContent === "coupler").transform.baseVal[0].matrix;
        return [e, f - 4];
    })()"""
    x, y = page.evaluate(place)
    page.evaluate(f"""(() => {{
        const {{ linkage, stage }} = gruebler.motion;
        linkage.beside = {{ ...linkage.beside, targets: [stage.viewport.world({x}, {y})] }};
        stage.draw();
    }})()""")
    u, v = page.evaluate(place)
    assert abs(u - x) > 26 + 6 or abs(v - y) > 12  # half of "coupler" and a ring, of 6 pixels


def test_on_a_phone_a_pivot_stands_beside_the_numbers_of_the_grid(tab, server):
    page = tab(width=390, height=844, touch=True).open(server.address).page
    least = page.evaluate("""(() => {
        const { linkage, stage } = gruebler.motion, { rows, values } = linkage.cycle;
        const all = [...values.keys()].flatMap((row) => linkage.model.joints.map((_, k) =>
            stage.viewport.screen(...linkage.jointAt(k, rows, row))[0]));
        return Math.min(...all);
    })()""")
    numbers = page.locator(".view.motion:not([data-page]) .stage text.tick").evaluate_all(
        "all => all.map((one) => one.getBoundingClientRect()).filter(({ left }) => left < 10).map(({ right }) => right)"
    )
    assert max(numbers) < least - 6  # a joint has a radius of 5.5 pixels


def test_a_cylinder_that_closes_wholly_has_a_range_from_0(tab, tmp_path):
    """Lever and frame of 60: drawn in its ends meet, drawn out it is 120 long."""
    linkage = {
        "joints": "R(frame-1) R(1-3) R(frame-2) P(2-3)",
        "frame": "frame",
        "drives": ["P(2-3)"],
        "unit": "mm",
        "places": {"R(frame-1)": [60, 0], "R(1-3)": [90, 51.961524227066], "R(frame-2)": [0, 0], "P(2-3)": [0, 0, 30]},
    }
    file, path = tmp_path / "closing.json", tmp_path / "closing.html"
    file.write_text(json.dumps(linkage))
    assert main(["explore", str(file), "-o", str(path)]) == 0
    page = tab(locale="en-US").open(path.as_uri()).page
    fact = page.locator(".side .facts div", has_text="Range of the drive")
    assert fact.locator("dd").inner_text() == "0 … 120\u00a0mm"
