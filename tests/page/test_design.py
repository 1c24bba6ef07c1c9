"""Design on the page: positions with pivots, dead centres; designs play over their targets, which stay in Motion."""

import json
import re

import numpy as np
import pytest

from gruebler.base.errors import GrueblerError
from gruebler.design.synthesis.judging import distances_of_pins
from gruebler.files import linkage_from_json
from gruebler.mechanics.analysis.measuring import measures
from gruebler.mechanics.kinematics import move
from gruebler.page.links import read_link

VIEW = "gruebler.views.synthesis"
MARKS = ("circle", ".tip")
POINTED = "(one) => (({ e, f }) => [e, f])(one.getScreenCTM())"
"""Where a mark of a position lies on the screen, unrounded."""


@pytest.fixture
def design(tab, server):
    page = tab().open(server.address)
    page.page.click('[data-view="synthesis"]')
    return page


def opened(page):
    """The linkage of the first design, once it is open."""
    page.page.locator('[data-list="designs"] .card').first.click()
    page.until("gruebler.view === 'motion'")
    return linkage_from_json(json.loads(page.page.evaluate("JSON.stringify(gruebler.motion.document())")))


def undo_and_redo(design):
    """Three positions are removed; that is undone, and what was typed before."""
    view = design.page
    rows = view.evaluate(f"{VIEW}.rows.positions")
    for number in (3, 2, 1):  # the cross of the last row first
        view.locator(".points button").nth(number - 1).click()
    back, forth = (view.locator(f'header [data-icon="{icon}"]') for icon in ("undo", "redo"))
    for _ in range(2):
        view.keyboard.press("Control+z")
    back.click()
    assert view.evaluate(f"{VIEW}.rows.positions") == rows
    back.click()  # the angle of the third
    assert view.evaluate(f"{VIEW}.rows.positions[2][2]") == -25
    view.click('[data-value="points"]')
    view.click('[data-value="curve"]')
    forth.click()  # where the change was made
    assert view.evaluate(f"[{VIEW}.kind, {VIEW}.rows.positions]") == ["positions", rows]
    assert view.locator('[data-value=""]').get_attribute("aria-pressed") == "true"


def found_designs(view):
    """The cards of designs that are looked for by the button, which stays where it is."""
    key = view.locator('[data-act="synthesise"]')
    before = key.bounding_box()
    key.click()
    cards = view.locator('[data-list="designs"] .card')
    cards.first.wait_for(timeout=60_000)
    assert key.bounding_box() == before
    return cards


def shows_the_first_card(view, lengths: list[str]) -> None:
    """How many of its kind there are, its lengths, three positions; curves have the blue that they have in Motion."""
    counts = view.locator(".designs h2, .designs select").evaluate_all(
        "all => all.flatMap((one) => (one.selectedOptions?.[0] ?? one).textContent.match(/\\d+/g) ?? [])"
    )
    assert str(view.locator(".designs .card").count()) in counts
    shown = [one.split()[0] for one in view.locator(".designs .lengths i").all_inner_texts()]
    assert max(len(re.sub(r"\D", "", one).lstrip("0")) for one in shown) == 4  # of the longest, and no more of another
    assert len({*counts}) == len(counts)  # each is said once
    card = view.locator('[data-list="designs"] .card').first
    assert card.locator(".lengths").inner_text().split()[: len(lengths)] == lengths
    assert card.locator("svg .gr-target-head").count() == 3
    stroke = "(one) => getComputedStyle(one).stroke"
    curves = [view.locator(f"{where} [class$=curve]").first.evaluate(stroke) for where in ("[data-ghost]", ".card")]
    assert curves == ["rgb(0, 114, 178)"] * 2


def test_a_four_bar_on_two_pivots_carries_its_coupler_through_three_positions(design):
    view = design.page
    view.click('[data-value="positions"]')
    view.mouse.click(*design.target(-40, 0))
    design.drag(design.target(0, 25), (40, 40), steps=3)
    view.mouse.click(*design.target(35, 10))
    design.drag(design.middle('[data-point="0"] .tip'), (0, -10), steps=3)
    (x, y), (u, v) = (view.locator(f'[data-point="0"] > {mark}').evaluate(POINTED) for mark in MARKS)
    assert v < y - 5
    assert view.evaluate(f"{VIEW}.rows.positions[0][2]") == pytest.approx(np.degrees(np.arctan2(y - v, u - x)), abs=1)
    # each new position is turned further than the last one; the second was dragged to where its arrow points
    assert [row[2] for row in view.evaluate(f"{VIEW}.rows.positions")[1:]] == [-45, -25]
    for number, angle in enumerate((12, 35, 70), 1):
        field = view.locator(f'[aria-label="Position {number} φ [°]"]')
        field.fill(str(angle))
        field.press("Enter")
    undo_and_redo(design)
    view.click('[data-value="pivot"]')
    for pivot in ((-30, -40), (30, -40)):
        view.mouse.click(*design.target(*pivot))
    assert view.locator("[data-pivot]").count() == 2
    view.locator('[data-field="crank"]').uncheck()
    view.locator('[data-field="least"]').fill("0")
    found_designs(view)
    shows_the_first_card(view, lengths=["frame", "60.00"])  # from pivot to pivot
    assert view.locator(".designs h2").inner_text() == "1 design"
    # it plays over the targets: three moving links, one curve
    assert view.locator("[data-ghost] .bar").count() == 3
    assert view.locator("[data-ghost] .support").count() == 2
    crank = view.locator("[data-ghost] .bar").first
    before = crank.get_attribute("d")
    view.wait_for_timeout(300)
    assert crank.get_attribute("d") != before
    targets = view.evaluate(f"{VIEW}.targets")
    linkage = opened(design)
    assert view.evaluate("gruebler.motion.linkage.beside.targets") == targets
    purple = """([x, y]) => {
        const { viewport } = gruebler.motion.stage;
        const canvas = gruebler.root.querySelector(".stage canvas");
        const [u, v] = viewport.screen(x, y);
        const { data } = canvas.getContext("2d").getImageData(Math.round(u) - 9, Math.round(v) - 9, 18, 18);
        const pixels = Array.from({ length: 324 }, (_, k) => data.slice(4 * k, 4 * k + 3).join());
        return pixels.filter((colour) => colour === "155,79,131").length;
    }"""
    assert all(view.evaluate(purple, target[:2]) > 4 for target in targets)
    # a link has them, and undoing and doing again
    view.evaluate("gruebler.write()")  # it is not written at once
    assert read_link(view.evaluate("gruebler.hash")).document["page"] == {"targets": targets}
    view.keyboard.press("Control+z")
    assert view.evaluate("gruebler.motion.linkage.beside") == {}
    view.keyboard.press("Control+y")
    assert view.evaluate("gruebler.motion.linkage.beside.targets") == targets
    # the library moves it through the three places, and its coupler turns as the arrows do
    low, high = view.evaluate("[gruebler.motion.linkage.cycle.low, gruebler.motion.linkage.cycle.high]")
    motion = move(linkage, np.linspace(low, high, 20_001)[1:-1])
    (name,) = linkage.points
    path = motion.point(name)
    row = [int(np.argmin(np.hypot(*(path - target[:2]).T))) for target in targets]
    np.testing.assert_allclose(path[row], [target[:2] for target in targets], atol=0.05)
    joint = motion.point(next(one for one in linkage.mechanism.chain.joint_names() if "frame" not in one))
    arms = np.degrees(np.unwrap(np.angle([complex(*(joint[k] - path[k])) for k in row])))
    np.testing.assert_allclose(np.diff(arms), [23, 35], atol=0.2)


def drawn_by_hand(design, along, up):
    """A curve through places of the plane in one stroke; where they are seen."""
    x, y = np.transpose([design.target(*place) for place in zip(along, up, strict=True)])
    mouse = design.page.mouse
    mouse.move(x[0], y[0])
    mouse.down()
    for place in zip(x, y, strict=True):
        mouse.move(*place)
    mouse.up()
    return x, y


def test_a_curve_is_drawn_by_hand(design):
    view = design.page
    view.click('[data-value="curve"]')
    angles = np.linspace(0, 6.1, 40)
    x, y = drawn_by_hand(design, 40 * np.cos(angles), 25 * np.sin(angles))
    points = np.array(view.evaluate(f"{VIEW}.points"))
    assert view.locator('[data-field="closed"]').is_checked()
    np.testing.assert_allclose(np.hypot(points[:, 0] / 40, points[:, 1] / 25), 1, atol=0.04)  # an ellipse
    sides = np.hypot(*np.diff(points, axis=0).T)
    assert np.ptp(sides) < 1.5
    view.mouse.move(x[0], y[0])  # another one takes its place
    view.mouse.down()
    view.mouse.move(x[9], y[9], steps=5)
    assert (view.locator(".plane .arm").count(), view.locator("[data-point]").count()) == (1, 0)  # as it is drawn
    view.mouse.up()
    assert not view.locator('[data-field="closed"]').is_checked()
    assert len(view.evaluate(f"{VIEW}.points")) == len(points)


def test_a_drawn_curve_is_met_by_a_linkage_of_its_size(design):
    """The nearest curve to an ellipse of 100 mm belongs to links of 740 mm; those wanted have room beside it."""
    view = design.page
    view.click('[data-value="curve"]')
    assert view.locator(".two .note").first.inner_text().startswith("Draw the curve in one stroke")
    angles = np.linspace(0, 2 * np.pi, 60)
    drawn_by_hand(design, 50 * np.cos(angles), 30 * np.sin(angles))
    assert view.locator('[data-field="reach"]').get_attribute("placeholder") == "100"
    assert view.locator('[data-field="order"]').count() == 0  # it is passed as it is drawn
    assert not view.locator(".points").is_visible()
    numbers = [text for text in view.locator("[data-point] text").all_text_contents() if text]
    assert numbers == ["1", "6", "11", "16"]
    drawn = np.array(view.evaluate(f"{VIEW}.points"))
    found_designs(view)
    # no plate covers the curve that is reached or the one that is wanted
    order = view.locator(".plane :is([data-ghost] .bar, [data-ghost] .curve, .polygon)").evaluate_all(
        "all => all.map((one) => one.classList[0])"
    )
    *bars, reached, wanted = order
    assert ({*bars}, reached, wanted) == ({"bar"}, "curve", "polygon")
    told = float(values_of(view, "deviation")[0].removesuffix(" mm"))
    assert told < 1.5
    linkage = opened(design)
    assert linkage.size < np.hypot(300, 260)
    frame = linkage.mechanism.frame
    for joint, name in zip(linkage.mechanism.chain.joints, linkage.mechanism.chain.joint_names(), strict=True):
        if frame in joint.links and joint.pair.is_turning:
            pivot = np.abs(move(linkage, [0.0]).point(name)[0])
            assert pivot[0] <= 150.1
            assert pivot[1] <= 130.1
    # what the card tells is the largest distance of a point from the curve
    (name,) = linkage.points
    path = move(linkage, np.linspace(0, 2 * np.pi, 7_201)).point(name)
    far = [np.hypot(*(path - point).T).min() for point in drawn]
    assert max(far) == pytest.approx(told, rel=0.06, abs=0.01)  # it has two digits


def test_points_of_a_file_are_seen_whatever_their_size(design, tmp_path):
    view = design.page
    for far in (0.4, 900):
        path = tmp_path / "points.csv"
        path.write_text("x,y\n" + "".join(f"{x * far},{y * far}\n" for x, y in ((-1, 0), (0, 1), (1, 0.2), (0.3, -1))))
        view.click('[data-value="positions"]')
        view.click('[data-value="pivot"]')
        view.locator('header input[type="file"]').set_input_files(path)
        design.until(f"Math.abs({VIEW}.points[0]?.[0] + {far}) < 1e-9")
        assert view.locator('[data-value=""]').get_attribute("aria-pressed") == "true"  # pivots are of positions
        box = view.locator(".plane").bounding_box()
        spots = [design.middle(f'[data-point="{k}"] circle') for k in range(4)]
        assert all(0 < x - box["x"] < box["width"] and 0 < y - box["y"] < box["height"] for x, y in spots)
        assert spots[2][0] - spots[0][0] > box["width"] / 3
        design.drag(spots[1], (0, 12))
        moved = view.evaluate(f"{VIEW}.points[1][1]")
        assert moved == pytest.approx(far - 12 * 2 * far / (spots[2][0] - spots[0][0]), rel=0.01)


def test_a_finger_takes_a_point_of_the_plane(tab, server):
    page = tab(width=390, height=844, touch=True).open(server.address)
    page.page.tap('[data-view="synthesis"]')
    box = page.page.locator(".plane").bounding_box()
    assert box["height"] > 300  # nearest a square
    assert box["y"] < 215  # header and two rows of buttons
    key = page.page.locator('[data-act="synthesise"]')
    assert (key.is_disabled(), key.get_attribute("title")) == (True, "0 set, at least 5 needed")
    assert key.bounding_box()["y"] > box["y"] + box["height"]  # not over the plane, nor under it
    page.page.touchscreen.tap(*page.target(10, 20))
    x, y = page.target(10, 20)
    page.page.touchscreen.tap(x + 18, y)  # the same point: it is not put twice
    assert page.page.locator("[data-point]").count() == 1
    ticks = page.page.locator(".plane .tick").all_text_contents()
    assert ticks[0] == "mm"
    assert ticks.count("0") == 2  # both axes have numbers
    # while it looks for linkages, what gives that up stands over the button that began it
    for x, y in ((20, -20), (0, -30), (-20, -20), (-20, 10)):
        page.page.touchscreen.tap(*page.target(x, y))
    page.page.set_viewport_size({"width": 390, "height": 700})  # the plane goes farther down
    assert page.page.evaluate("""() => {
        const { root } = gruebler;
        root.querySelector('[data-act="synthesise"]').click();
        const cancel = root.querySelector('[data-act="cancel"]');
        const { x, y, width, height } = cancel.getBoundingClientRect();
        const there = root.getRootNode().elementFromPoint(x + width / 2, y + height / 2);
        cancel.click();
        return there === cancel && x + width <= innerWidth;
    }""")


def scaled_in_millimetres(view) -> None:
    ticks = view.locator(".plane .tick").all_text_contents()
    assert ticks[0] == "mm"
    assert {"0", "20", "40", "60", "80"} < {*ticks}


def test_the_chart_of_a_function_stays_beside_its_design(design):
    view = design.page
    view.click('[data-value="function"]')
    design.drag(design.middle('[data-point="1"] circle'), (0, -10))
    x, y = zip(*(design.middle(f'[data-point="{k}"] circle') for k in range(3)), strict=True)
    pairs = view.evaluate(f"{VIEW}.rows.function")
    degree = (x[2] - x[0]) / 90  # across as upward
    assert pairs[1] == pytest.approx([45, 25 + 10 / degree], abs=0.2)
    assert y[0] - y[1] == pytest.approx(pairs[1][1] * degree, abs=1)
    cards = found_designs(view)
    assert cards.first.get_attribute("aria-current") is not None
    cards.nth(1).hover()
    # the chart stays beside the design, with the curve of the rocker over the crank through all pairs
    assert view.locator(".plane").count() == 2
    curve = view.locator(".plane:nth-last-child(2) .curve").get_attribute("d")
    u, v = np.reshape([float(value) for value in re.findall(r"-?[\d.]+", curve)], (-1, 2)).T
    assert np.interp([pair[0] for pair in pairs], u, -v) == pytest.approx([pair[1] for pair in pairs], abs=0.1)
    here = view.locator(".plane:nth-last-child(2) > g > .joint")
    before = here.get_attribute("cx")
    view.wait_for_timeout(100)
    assert here.get_attribute("cx") != before


def test_dead_centres_are_those_that_were_asked_for(design):
    view = design.page
    view.click('[data-value="dead-centres"]')
    for name, value in (("Swing [°]", "48"), ("Time ratio", "1.25")):
        field = view.locator(f'[aria-label="Dead centres {name}"]')
        field.fill(value)
        field.press("Enter")
    assert view.locator('[data-field="crank"]').count() == 0  # it turns fully in any case
    arm = view.locator(".plane .arm").get_attribute("d")
    (a, b), (c, d) = (map(float, end.split()) for end in arm.removeprefix("M").split("L0 0L"))
    # as long as the longest link of what will be found, and the words stand beside the axis
    assert np.hypot(a, b) == pytest.approx(100)
    scaled_in_millimetres(view)
    beside = view.locator(".plane text").last.bounding_box()["x"]
    assert beside > view.locator(".plane .axis").first.bounding_box()["x"]
    assert np.degrees(np.arccos((a * c + b * d) / np.hypot(a, b) / np.hypot(c, d))) == pytest.approx(48)
    cards = found_designs(view)
    words = view.locator(".plane text").all_text_contents()[-4:]
    assert [*words[:2], *sorted(words[2:])] == ["Time ratio 1.25", "48°", "extended", "folded"]
    # of each link both positions, faint, and the one that moves; the rocker stands at the ends of the swing
    assert (view.locator(".faded .bar").count(), view.locator("[data-ghost] .bar").count()) == (6, 3)
    rockers = [view.locator(".faded .bar").nth(k).get_attribute("d") for k in (2, 5)]
    (a, b), (c, d) = (np.reshape([float(x) for x in re.findall(r"-?[\d.]+", one)], (2, 2)) for one in rockers)
    arms = [complex(*(a - b)), complex(*(c - d))]
    assert abs(np.degrees(np.angle(arms[1] / arms[0]))) == pytest.approx(48, abs=0.01)
    cards.last.hover()  # the plane stays in sight beside all of them
    plane = view.locator(".plane").bounding_box()
    assert plane["y"] >= 0
    assert plane["y"] + plane["height"] <= view.viewport_size["height"]
    scaled_in_millimetres(view)
    # their longest link is as long in all, and all turn fully: the angle and the sensitivity tell them apart
    orders = view.locator('[data-field="sorted"] option').evaluate_all("all => all.map((one) => one.value)")
    assert orders == ["range", "shift", "balanced"]
    view.locator('[data-field="sorted"]').select_option("range")
    angles = [float(text.strip("≥ °")) for text in values_of(view, "μ in all positions", '[data-list="designs"]')]
    assert len(angles) > 2
    assert angles == sorted(angles, reverse=True)
    found = measures(opened(design))
    first, second = (centre.output for centre in found.dead_centres)
    assert abs(np.degrees(first - second)) == pytest.approx(48, abs=1e-6)
    assert found.transmission is not None
    assert np.degrees(found.transmission.smallest.mu) == pytest.approx(angles[0], abs=0.06)
    facts = view.locator(".facts").inner_text()
    assert "48°" in facts
    assert "1.25" in facts
    # only ratios count: the longest distance is 100 mm
    assert max(view.evaluate("gruebler.motion.dragging.lengths().map((one) => one.value)")) == pytest.approx(100)


def test_pairs_of_angles_are_ringed_in_the_plot_of_the_output(design):
    """Where the library moves the design to, in the turns that were asked for."""
    from gruebler.page.designs import design_records, task_of
    from gruebler.page.requests import answer

    item = design_records(task_of("function", [[0, 0], [45, 25], [90, 60]]), True, 30.0, "en", lambda _: None)["items"][
        0
    ]
    drive, output = np.array(item["pairs"]).T
    assert np.diff(drive) == pytest.approx([45, 45], abs=1e-5)
    assert np.diff(output) % 360 == pytest.approx([25, 35], abs=1e-5)
    moved = np.degrees(move(linkage_from_json(item["document"]), np.radians(drive)).angle("rocker"))
    assert moved % 360 == pytest.approx(output, abs=1e-4)  # as it is plotted, since it turns fully
    model = answer("open_document", {"document": item["document"] | {"page": {"pairs": item["pairs"]}}}, "en", print)
    design.page.evaluate("(model) => { gruebler.open(model); gruebler.motion.transport.pause(); }", model)
    rings = design.page.locator('[data-panel="plots"] .plot').first.locator("path[stroke]").get_attribute("d")
    across = [float(x) for x in re.findall(r"M([\d.]+)", rings)]
    assert np.array(across) == pytest.approx(44 + 246 * drive / 360, abs=0.01)  # the axis lies from 44 to 290
    notes = design.page.locator('[data-panel="plots"] .note').all_text_contents()
    assert any(f"{drive[1]:.4g}° → " in note for note in notes)
    with pytest.raises(GrueblerError, match="pairs: expected 2 numbers in each row"):
        answer("open_document", {"document": item["document"] | {"page": {"pairs": [[1, "x"]]}}}, "en", print)


def test_the_transmission_angle_asked_for_says_where_it_holds(design):
    """Between the targets, as designs are judged; of dead centres over the whole turn."""
    view = design.page
    least = view.locator('label[for="least"]')
    for kind in ("points", "positions", "function"):
        view.click(f'[data-value="{kind}"]')
        assert least.inner_text().startswith("Minimum transmission angle between targets")
    view.click('[data-act="synthesise"]')
    view.locator('[data-list="designs"] .card:has-text("μ between targets")').first.wait_for(timeout=60_000)
    view.click(".designs summary")
    told = view.locator(".designs details").first.inner_text()
    assert "between targets: on the way from the first to the last." in told
    assert "Sensitivity: how far a target is off" in told
    view.click('[data-value="dead-centres"]')
    assert least.inner_text().startswith("Minimum transmission angle")


def order_of(view, key: str) -> list[str]:
    view.locator('[data-field="sorted"]').select_option(key)
    return view.locator(".designs .card b").all_text_contents()


def values_of(view, name: str, where: str = ".designs") -> list[str]:
    """What cards tell of themselves under a name."""
    values = view.locator(f"{where} .card > span", has_text=name).locator("> :last-child")
    return values.all_text_contents()


def test_each_order_is_another_one_by_a_value_on_the_cards(design):
    view = design.page
    view.evaluate(f"{VIEW}.rows.positions = [[-40, 0, 0], [0, 25, 20], [35, 10, 50]]")
    view.click('[data-value="positions"]')
    found_designs(view)
    view.locator('[data-field="form"]').select_option("")
    keys = view.locator('[data-field="sorted"] option').evaluate_all("all => all.map((one) => one.value)")
    orders = [tuple(order_of(view, key)) for key in keys]
    assert len({*orders}) == len(keys) > 3
    order_of(view, "size")
    for where in ("designs", "variants"):
        sizes = [float(text.removesuffix(" mm")) for text in values_of(view, "longest link", f'[data-list="{where}"]')]
        assert sizes
        assert sizes == sorted(sizes)
    # the one that plays is marked
    current = view.locator('.card[aria-current="true"], .card[aria-current=""]')
    for number in (1, 2):
        card = view.locator('[data-list="designs"] .card').nth(number)
        card.hover()
        assert current.all_inner_texts() == [card.inner_text()]


def test_cards_tell_the_same_in_the_same_places_and_mark_the_best(tab, server):
    """On a phone, in German: one row of lengths, of a driven crank, too; the picture stays in sight, and is low."""
    page = tab(width=390, height=844, locale="de-DE", touch=True).open(server.address)
    view = page.page
    view.click('[data-view="synthesis"]')
    view.click('[data-value="function"]')
    view.locator('[data-act="synthesise"]').click()
    cards = view.locator('[data-list="designs"] .card')
    cards.first.wait_for(timeout=60_000)
    assert view.locator(".lengths", has_text="Abtriebskurbel").count() > 0
    rows = cards.evaluate_all(
        """all => all.map((card) => [...card.querySelectorAll(".lengths i")].map((one) => {
            const { top, bottom } = one.getBoundingClientRect();
            return [top, bottom, one.scrollWidth <= one.clientWidth];
        }))"""
    )
    for row in rows:
        assert len(row) == 4
        assert len({top for top, *_ in row}) == len({bottom for _, bottom, _ in row}) == 1
    # no name is broken within a word
    lines = """all => all.map((one) => [one.firstChild.data.split(" ").length,
        new Set([...one.firstChild.data].map((_, k) => {
            const range = document.createRange();
            range.setStart(one.firstChild, k);
            range.setEnd(one.firstChild, k + 1);
            return Math.round(range.getBoundingClientRect().top);
        })).size])"""
    assert all(seen <= words for words, seen in view.locator(".lengths > span").evaluate_all(lines))
    names = [card.locator("> span:not(.lengths)").all_inner_texts() for card in cards.all()]
    assert len({tuple(text.split("\n")[0] for text in own) for own in names}) == 1
    right = view.locator(".designs .card > span:not(.lengths) > *").evaluate_all(
        "all => all.map((one) => Math.round(one.getBoundingClientRect().right))"
    )
    assert len({*right}) == 1
    for name, best in (("μ zwischen den Vorgaben", max), ("Empfindlichkeit", min)):
        numbers = [float(text.strip("≥ °").replace(",", ".")) for text in values_of(view, name)]
        marked = view.locator(".designs .card > span", has_text=name).locator("strong").all_text_contents()
        assert [float(text.strip("≥ °").replace(",", ".")) for text in marked] == [best(numbers)] * len(marked)
        assert len(marked) == numbers.count(best(numbers))  # all that read alike
    cards.last.scroll_into_view_if_needed()
    seen = view.locator(".doing .chain-picture").bounding_box()
    assert 0 <= seen["y"] < seen["y"] + seen["height"] < 844 / 3
    view.locator('[data-act="back"]').click()
    assert view.locator('[data-value="points"]').bounding_box()["y"] > 0


def test_the_bar_of_a_task_is_as_high_when_all_is_set(tab, server):
    page = tab(width=1024, height=768, locale="de-DE").open(server.address)
    view = page.page
    view.click('[data-view="synthesis"]')
    bar, plane = view.locator(".doing > .form"), view.locator(".plane")
    before = bar.bounding_box(), plane.bounding_box()
    assert "0 gesetzt, mindestens 5 nötig" in view.locator('[data-fact="set"]').inner_text()
    view.evaluate(f"{VIEW}.rows.points = [[-50, 0], [-25, 18], [0, 25], [25, 18], [45, 0]]")
    view.click('[data-value="positions"]')
    view.click('[data-value="points"]')
    assert view.locator('[data-fact="set"]').inner_text() == ""
    assert (bar.bounding_box(), plane.bounding_box()) == before
    view.click('[data-value="positions"]')  # whose tools are wider, and all in one row
    tops = [view.locator(one).bounding_box()["y"] for one in ('[data-value="pivot"]', '[data-act="synthesise"]')]
    assert tops[0] == pytest.approx(tops[1], abs=8)


def test_what_turns_fully_is_no_rocker_and_goes_from_0_to_360(tab, server):
    """By Grashof: the frame is the shortest, and with the longest shorter than the other two."""
    page = tab(locale="de-DE").open(server.address)
    view = page.page
    view.click('[data-view="synthesis"]')
    view.click('[data-value="function"]')
    card = found_designs(view).first
    names, lengths = zip(
        *(one.splitlines()[:2] for one in card.locator(".lengths > span").all_inner_texts()), strict=True
    )
    lengths = [one.split()[0] for one in lengths]
    shortest, second, third, longest = sorted(float(one.replace(",", ".")) for one in lengths)
    assert float(lengths[0].replace(",", ".")) == shortest
    assert shortest + longest < second + third
    assert names == ("Gestell", "Kurbel", "Koppel", "Abtriebskurbel")
    card.click()
    page.until("gruebler.view === 'motion'")
    plot = "gruebler.motion.side.plots.parts[0].plot.series"
    values = view.evaluate(f"[...{plot}.values]")
    assert min(values) >= 0
    assert max(values) <= 360
    assert max(values) - min(values) > 350
    curve = view.locator('[data-panel="plots"] .plot path.curve').first.get_attribute("d")
    assert curve.count("M") == 2  # it begins anew, without a line across
    view.evaluate("gruebler.motion.transport.pause()")
    for drive in range(20, 360, 20):
        view.evaluate(f"gruebler.motion.transport.pick({drive}.37 * Math.PI / 180)")
        plotted = view.locator('[data-panel="plots"] .plot .read').all_text_contents()[:2]
        told = view.locator(".facts dd").evaluate_all("all => all.slice(0, 2).map((one) => one.firstChild.data)")
        assert 0 <= float(told[0].rstrip("°").replace(",", ".")) < 360
        assert plotted == [told[0].rstrip("°"), told[1]]  # also between two poses of the curve


@pytest.mark.parametrize("locale", [pytest.param("en-US", marks=pytest.mark.slow), "de-DE"])
def test_a_search_moves_nothing_and_is_one(tab, server, locale):
    """Enter on the button does not begin another one; what is under way has room at 1024 pixels, too."""
    page = tab(width=1024, height=768, locale=locale).open(server.address)
    view = page.page
    view.click('[data-view="synthesis"]')
    clear = view.locator('[data-act="clear"]')
    assert clear.is_disabled()  # nothing is set
    curve, told = (view.locator(one).bounding_box() for one in ('[data-value="curve"]', '[data-fact="set"]'))
    assert told["x"] >= curve["x"] + curve["width"] + 4
    view.evaluate(f"{VIEW}.rows.points = [[20, -20], [0, -30], [-20, -20], [-20, 10], [10, 20]]")
    view.click('[data-value="points"]')
    assert clear.is_enabled()
    view.evaluate("""() => {
        const { backend } = gruebler, { ask } = backend;
        window.asked = 0;
        backend.ask = (...all) => { window.asked += all[0] === "synthesise"; return ask.apply(backend, all); };
    }""")
    plane = view.locator(".plane").bounding_box()
    key = view.locator('[data-act="synthesise"]')
    key.focus()
    for _ in range(3):
        view.keyboard.press("Enter")
    told = set()
    while text := view.evaluate(f"{VIEW}.status.textContent"):
        told.add(text)
        assert view.locator(".plane").bounding_box() == plane, text
    assert len(told) > 1
    view.locator('[data-list="designs"] .card').first.wait_for()
    assert view.evaluate("window.asked") == 1
    assert view.evaluate("gruebler.root.getRootNode().activeElement.dataset.act") == "synthesise"


def test_another_task_gives_up_what_is_looked_for(design):
    view = design.page
    view.click('[data-value="function"]')
    view.click('[data-act="synthesise"]')
    view.click('[data-value="dead-centres"]')
    view.wait_for_timeout(3000)
    assert view.locator(".designs .card").count() == 0
    assert view.evaluate(f"{VIEW}.status.textContent") == ""


def test_designs_of_former_targets_say_so(design):
    """As long as the targets are others than those that were asked for: undo makes them right again."""
    view = design.page
    view.click('[data-value="function"]')
    cards, told = found_designs(view), view.locator('[data-fact="set"]')
    count = cards.count()
    assert told.inner_text() == ""
    view.click(".targets summary")  # folded beside designs, with what is in it
    cell = view.locator(".points input").nth(3)
    cell.fill("31")
    cell.press("Enter")
    assert told.inner_text() == view.locator(".designs .error").inner_text() == "Designs for the former requirements"
    assert cards.count() == count
    assert view.locator(".designs .card[aria-current]").count() == 0  # none plays over other targets
    view.click('header [data-icon="undo"]')
    assert told.inner_text() == ""
    least = view.locator('[data-field="least"]')
    for angle, says in (("45", "Designs for the former requirements"), ("20", "")):
        least.fill(angle)
        least.press("Tab")
        assert told.inner_text() == says
    view.locator('[data-field="crank"]').uncheck()
    assert told.inner_text() == "Designs for the former requirements"


def test_a_curve_that_is_drawn_takes_the_place_of_a_design(tab, server):
    """It goes with the first stroke; when that ends the plane is as wide as before anything was in it."""
    page = tab(width=390, height=844, locale="de-DE").open(server.address)
    view = page.page
    view.click('[data-view="synthesis"]')
    plane = view.locator(".plane").first
    width = plane.evaluate("(one) => one.viewBox.baseVal.width")
    view.evaluate(f"{VIEW}.rows.points = [[20, -20], [0, -30], [-20, -20], [-20, 10], [10, 20]]")
    view.click('[data-value="points"]')
    view.click('[data-act="synthesise"]')
    view.locator('[data-list="designs"] .card').first.wait_for(timeout=60_000)
    view.locator('[data-field="longest"]').fill("70")
    view.locator('[data-field="longest"]').press("Tab")
    told, up = (view.locator(one) for one in ('[data-fact="set"]', '[data-act="back"]'))
    assert told.inner_text() == "Entwürfe für die vorigen Vorgaben"
    note, button = told.bounding_box(), up.bounding_box()
    assert note["y"] + note["height"] <= button["y"] or note["x"] + note["width"] <= button["x"]
    view.click('[data-value="curve"]')
    assert view.locator("[data-ghost]").count() == 1
    (middle, _), (x, y) = page.target(0, 0), page.target(40, 0)
    page.drag((x, y), (middle - x, middle - x), (middle - x, x - middle))
    assert view.locator("[data-ghost]").count() == 0
    assert plane.evaluate("(one) => one.viewBox.baseVal.width") == width


def test_a_click_puts_whole_millimetres_where_a_pixel_is_as_large(design):
    view = design.page
    view.click('[data-value="positions"]')
    for place in ((0, 0), (40, 20)):
        x, y = design.target(*place)
        view.mouse.click(x + 0.4, y - 0.4)
    assert [row[:2] for row in view.evaluate(f"{VIEW}.rows.positions")] == [[0, 0], [40, 20]]


def test_rows_of_another_length_are_refused_in_a_sentence():
    from gruebler.page.requests import answer

    for kind, row in (("positions", [1, 2]), ("points", [1, 2, 3]), ("dead-centres", [1, 2, 3])):
        with pytest.raises(GrueblerError, match="numbers in each row"):
            answer("synthesise", {"kind": kind, "rows": [row] * 5}, "en", print)


def test_a_pair_that_lies_on_a_frame_to_rounding_is_no_fault():
    """Of these pairs one design has a frame of its motion a last digit beside the crank's angle of a pair."""
    from gruebler.page.designs import design_records, task_of

    found = design_records(task_of("function", [[0, 0], [45, 27], [90, 60]]), True, 20.0, "en", lambda _: None)
    assert len(found["items"]) > 10
    for item in found["items"]:
        drive, output = np.array(item["pairs"]).T
        assert np.diff(drive) % 360 == pytest.approx([45, 45], abs=1e-5)
        assert np.diff(output) % 360 == pytest.approx([27, 33], abs=1e-5)


def test_each_kind_of_rows_is_its_task():
    from gruebler.page.designs import task_of

    pairs = task_of("function", [[0, 0], [90, 45], [180, 60]])
    assert (pairs.inputs[1], pairs.outputs[1]) == pytest.approx((np.pi / 2, np.pi / 4))
    assert task_of("dead-centres", [[90, 1.5]]).swing == pytest.approx(np.pi / 2)
    assert task_of("positions", [[0, 0, 90], [1, 2, 0]], pivots=[[3, 4]]).fixed_pivots == ((3, 4),)
    assert task_of("points", [[k, k * k] for k in range(6)], closed=True).closed


def test_a_slide_of_a_design_has_its_block_on_its_guide():
    """The pin of the block, found by the motion, is the middle of the block and on the line between the rail's ends."""
    from gruebler.page.designs import design_records, task_of

    task = task_of("positions", [[-40, 0, 0], [0, 25, 20], [35, 10, 50]])
    items = design_records(task, True, 20.0, "en", lambda _: None)["items"]
    for design in items:  # the arrow that the point carries lies on that of each position when it is there
        away = np.abs(np.array(design["frames"])[:, design["joints"]] @ (1, 1j) - task.origins[:, None])
        turns = np.unwrap(design["turns"], period=360)
        for position, k in zip((0, 20, 50), away.argmin(axis=1), strict=True):
            near = [turns[other % len(turns)] for other in (k - 1, k, k + 1)]
            miss = (
                min((turn - position + 180) % 360 - 180 for turn in near),
                max((turn - position + 180) % 360 - 180 for turn in near),
            )
            assert miss[0] <= 0.02
            assert miss[1] >= -0.02
    for design in (
        next(item for item in items if item["form"] == form) for form in ("Slider-crank", "Inverted slider-crank")
    ):
        *_, (start, end) = design["members"]
        ((low, high),) = design["rails"]
        z = np.array(design["frames"]) @ (1, 1j)
        pin = z[:, [3 if design["form"].startswith("Inv") else 2]]
        for at in (pin, z[:, [start]], z[:, [end]]):
            part = (at[:, 0] - z[:, low]) / (z[:, high] - z[:, low])
            assert np.abs(part.imag).max() < 1e-3
            assert part.real.min() > -1e-3
            assert part.real.max() < 1 + 1e-3
        assert np.abs(z[:, start] + z[:, end] - 2 * pin[:, 0]).max() < 1e-3 * design["size"]
        # the coupler is one plate, of a rod up to its end, which a picture has somewhat farther out
        (plate,) = (own for own in design["members"] if len(own) > 2)
        assert design["joints"] in plate  # the point
        part = (z[:, plate[-1]] - z[:, low]) / (z[:, high] - z[:, low])
        on_rod = np.abs(part.imag).max() < 1e-3 and part.real.min() > -0.2 and part.real.max() < 1
        assert on_rod == design["form"].startswith("Inv")
        if design["form"] == "Slider-crank":  # at both dead centres a right triangle with crank and rod in line
            crank, rod, offset = design["lengths"]
            stroke = np.sqrt((rod + crank) ** 2 - offset**2) - np.sqrt((rod - crank) ** 2 - offset**2)
            assert np.abs(pin - pin.T).max() == pytest.approx(stroke, rel=2e-3)
        else:
            assert design["lengths"][2] == 0
        # the longest link is as long as its pins and its point lie apart, a rod as far as it slides
        moving = design["members"][:-1]
        far = [np.abs(z[0, k] - z[0, m]) for own in moving for k in own for m in own]
        apart = {(k, end): np.ptp(np.abs(z[:, k] - z[:, end])) for own in moving for k in own for end in (low, high)}
        rods = [own for own in moving if all(apart[k, end] < 5e-3 for k in own for end in (low, high))]
        assert len(rods) == (design["form"] == "Inverted slider-crank")
        far += [np.abs(z[:, k] - pin[:, 0]).max() for own in rods for k in own]
        still = [at[0] for at in z.T[: design["joints"]] if np.ptp(np.abs(at)) < 1e-4]
        far += [abs(one - other) for one in still for other in still]
        assert design["size"] == pytest.approx(max(far), rel=2e-3)


def test_after_all_four_bars_are_followed_it_is_said_that_they_are_judged():
    """Not that all of all were looked for, as long as the answer is not there."""
    from gruebler.page.requests import answer

    told = []
    rows = [[0, 0, 0], [40, 20, 20], [60, 50, 40]]
    answer("synthesise", {"kind": "positions", "rows": rows, "crank": True, "transmission": 30}, "en", told.append)
    assert told[0] == "Looking for four-bars: 0 %"
    assert any(text.startswith("Judging the linkages found") for text in told)


TABLE = [[0, 0], [20, 8], [45, 25], [60, 38], [75, 48], [90, 60]]


def test_what_more_than_five_pairs_miss_stands_as_stems():
    """Against the triangle of coupler and rocker."""
    from gruebler.page.requests import answer

    found = answer("synthesise", {"kind": "function", "rows": TABLE, "crank": False, "transmission": 0.0}, "en", print)
    for item in found["items"]:
        linkage = linkage_from_json(item["document"])
        d, a, b, c = (distances_of_pins(linkage, link)[0] for link in linkage.mechanism.chain.links)
        pin = a * np.exp(1j * np.radians([drive for drive, _ in item["pairs"]]))
        far = abs(d - pin)
        along = (b * b - c * c + far**2) / (2 * far)
        beside = np.sqrt(b * b - along**2)
        ends = np.array([end for _, end in item["stems"][2]])
        assert [start for start, _ in item["stems"][2]] == pytest.approx(np.radians([row[0] for row in TABLE]))
        reached = [np.unwrap(np.angle(pin + (d - pin) / far * (along + s * 1j * beside) - d)) for s in (1, -1)]
        misses = [np.array([row[1] for row in TABLE]) - np.degrees(one) for one in reached]
        # that of the first pair is free: all of them are shifted alike
        assert min(np.ptp(one - ends) for one in misses) < 5e-3  # pairs are rounded
        assert np.abs(ends).max() == pytest.approx(np.degrees(item["error"]), abs=1e-5)


def test_stems_are_drawn_beside_the_designs(design):
    view = design.page
    view.evaluate(f"(rows) => {{ {VIEW}.rows.function = rows; }}", TABLE)
    view.click('[data-value="function"]')
    view.locator('[data-field="crank"]').uncheck()
    view.locator('[data-field="least"]').fill("0")
    cards = found_designs(view)
    plot = view.locator(".designs .plot")
    assert plot.get_attribute("aria-label") == "Wanted − reached [°]"
    assert plot.locator("path[stroke]").get_attribute("d").count("M") == len(TABLE)
    assert values_of(view, "deviation")[0] == "0.96°"
    assert "difference between the output wanted and that reached" in view.locator(".designs .note").first.inner_text()
    before = plot.locator("path.curve").first.get_attribute("d")
    cards.last.hover()
    design.until(f"gruebler.root.querySelector('.designs .plot path.curve').getAttribute('d') !== '{before}'")


def test_a_large_design_leaves_its_targets_in_sight(design):
    """A four-bar of 100 mm over points that are 5 mm apart; of many points some have their numbers."""
    view = design.page
    view.evaluate(f"(rows) => {VIEW}.take(rows, true)", [[k, k % 3] for k in range(20)])
    numbers = view.locator("[data-point] text").all_text_contents()
    assert [one for one in numbers if one] == ["1", "6", "11", "16"]
    asked = {"kind": "dead-centres", "rows": [[60, 1.2]], "pivots": [], "closed": False}
    asked |= {"order": [], "crank": True, "transmission": 20}
    view.evaluate(
        f"""async (asked) => {{
            const found = await gruebler.ask("synthesise", asked);
            {VIEW}.take([[0, 0], [3, 4], [5, 0]], false);
            {VIEW}.designs.show(found);
        }}""",
        asked,
    )
    view.locator('[data-list="designs"] .card').last.hover()
    view.locator("[data-ghost] .joint").first.wait_for()
    wide = float(view.locator(".plane").get_attribute("viewBox").split()[2])
    assert 5 < wide < 6 * 5
    view.evaluate(f"{VIEW}.take([[0, 0], [12, 16], [20, 0]], false)")  # one of five times their width is seen whole
    view.evaluate(f"async (asked) => {VIEW}.designs.show(await gruebler.ask('synthesise', asked))", asked)
    view.locator('[data-list="designs"] .card').last.hover()
    pivots = view.locator("[data-ghost] .support")
    pivots.first.wait_for()
    plane = view.locator(".plane").bounding_box()
    for place in (pivots.nth(k).bounding_box() for k in range(2)):
        assert plane["x"] < place["x"] < place["x"] + place["width"] < plane["x"] + plane["width"]


def test_deviation_and_sensitivity_are_lengths(design):
    """Of positions 50 mm apart, of which the library tells parts."""
    from gruebler.design.synthesis import Demands, synthesise
    from gruebler.page.designs import task_of

    rows = [[0, 0, 0], [30, 40, 30], [20, 10, 50]]
    demands = Demands(crank=True, transmission=np.radians(20))
    found = synthesise(task_of("positions", rows), demands=demands, sort=["range-transmission"])
    parts = [one.relative_sensitivity for one in found.designs if one.verdict.accepted]
    view = design.page
    view.evaluate(f"(rows) => {{ {VIEW}.rows.positions = rows; }}", rows)
    view.click('[data-value="function"]')
    view.click('[data-value="positions"]')
    found_designs(view)
    shown = [text.removesuffix(" mm") for text in values_of(view, "sensitivity")[:3]]
    assert {float(one) for one in shown} <= {float(f"{50 * part:.2g}") for part in parts}


def test_a_design_begins_to_play_in_the_pose_of_its_picture(design):
    """That is its reference pose, in which its joints lie where its document has them."""
    from gruebler.page.designs import design_records, task_of

    found = design_records(task_of("function", [[0, 0], [45, 25], [90, 60]]), True, 20.0, "en", lambda _: None)
    for item in found["items"][:4]:
        linkage = linkage_from_json(item["document"])
        mechanism, poses = linkage.mechanism, linkage.required_pose
        seen = item["frames"][item["first"]]
        for k, joint in enumerate(mechanism.chain.joints):
            link = joint.links[0]
            own = linkage.elements[k, link]
            place = complex(poses[link].x, poses[link].y) + np.exp(1j * poses[link].angle) * complex(own.x, own.y)
            assert abs(complex(*seen[k]) - place) < 4.5  # of 100 mm: a frame is 2.5 degrees from the next one
    view = design.page
    view.click('[data-value="function"]')
    found_designs(view)
    start = """() => {
        const { prototype } = Element, { setAttribute } = prototype, ways = [];
        prototype.setAttribute = function (name, value) {
            if (name === "cx" && this.matches("[data-ghost] .joint")) ways.push(Number(value));
            return setAttribute.call(this, name, value);
        };
        gruebler.root.querySelectorAll(".designs .card")[1].focus();
        prototype.setAttribute = setAttribute;
        return ways;
    }"""
    shown = view.evaluate(start)
    begun = [sorted(x for x, _ in item["frames"][item["first"]][:4]) for item in found["items"]]
    assert any(sorted(shown) == pytest.approx(places, abs=0.01) for places in begun)


def test_what_goes_on_is_told_while_designs_are_looked_for():
    """Six points: curves that are alike, then what was found, then the cards; it never says that it looks again."""
    from gruebler.page.designs import design_records, task_of

    said: list[str] = []
    rows = [[-40, 0], [-20, 14], [0, 20], [20, 16], [38, 5], [44, -10]]
    design_records(task_of("points", rows), True, 20.0, "en", said.append)
    phases, parts = zip(*(text.split(": ") for text in said), strict=True)
    stages = ["Looking for four-bars", "Judging the linkages found", "Drawing the designs"]
    assert list(dict.fromkeys(phases)) == stages
    assert phases == tuple(sorted(phases, key=stages.index))
    counted = [int(part.removesuffix(" %")) for part in parts]
    assert counted == sorted(counted)  # it never falls back
    assert counted[-1] < 100  # as long as it is under way


def test_of_five_positions_without_a_design_it_is_said_what_is_wanting():
    """There is one linkage, whose crank does not turn and whose angle is small; who asks for that gets it."""
    from gruebler.page.requests import answer

    rows = [[-40, 0, 10], [-15, 18, 20], [5, 24, 32], [22, 20, 48], [35, 10, 65]]
    asked = {"kind": "positions", "rows": rows, "crank": True, "transmission": 20}
    nearest = answer("synthesise", asked, "en", print)
    assert "these meet all but a drive that turns fully and a transmission angle of 20°." in nearest["note"]
    assert (nearest["total"], nearest["nearest"]) == (1, True)
    angle = nearest["items"][0]["transmission"]
    assert 1 < angle < 19
    for least, missed in ((angle - 0.1, False), (angle + 0.1, True)):
        found = answer("synthesise", asked | {"crank": False, "transmission": least}, "en", print)
        assert (found["total"], found["nearest"]) == (1, missed)
        assert found["items"][0]["transmission"] == pytest.approx(angle, abs=0.06)
    said = answer("synthesise", asked, "de", print)["note"]
    assert "diese erfüllen alle bis auf: umlaufender Antrieb und Übertragungswinkel 20°" in said


def test_arrows_of_near_positions_end_before_the_next_ones(design):
    """In the plane and in Motion: where two are nearer than an arrow is long, both are shorter."""
    view = design.page
    view.click('[data-value="positions"]')
    rows = [[0, 0, 0], [9, 0, 20], [60, 30, 40]]
    view.evaluate(f"{VIEW}.rows.positions = {rows}")
    view.click('[data-value="points"]')
    view.click('[data-value="positions"]')
    long, gap = view.evaluate("""() => {
        const middle = (one) => (({ left, right, top, bottom }) => [(left + right) / 2, (top + bottom) / 2])(
            one.getBoundingClientRect());
        const marks = [...gruebler.root.querySelectorAll(".plane [data-point]")];
        const [first, second] = marks.map((one) => middle(one.querySelector("circle:not(.tip)")));
        const tip = middle(marks[0].querySelector(".tip"));
        return [tip, second].map(([x, y]) => Math.hypot(x - first[0], y - first[1]));
    }""")
    assert 0.3 * gap < long < 0.75 * gap


def test_on_a_phone_a_linkage_has_most_of_the_picture_beside_its_chart(tab, server):
    page = tab(width=390, height=844, touch=True).open(server.address)
    view = page.page
    view.click('[data-view="synthesis"]')
    view.click('[data-value="function"]')
    view.locator('[data-act="synthesise"]').click()
    view.locator('[data-list="designs"] .card').first.wait_for(timeout=60_000)
    chart, linkage = (view.locator(".plane").nth(k).bounding_box() for k in range(2))
    assert chart["y"] == linkage["y"]
    assert linkage["width"] == pytest.approx(linkage["height"], rel=0.01)
    # of its longest link, which is 100 mm, in pixels
    scale = view.locator(".plane:last-child [data-ghost]").evaluate("(one) => one.getScreenCTM().a")
    assert 100 * scale > 0.25 * linkage["width"]


THREE = [[-40, 0, 0], [0, 25, 20], [35, 10, 40]]


@pytest.fixture(scope="module")
def found_for_three():
    from gruebler.page.requests import answer

    asked = {"kind": "positions", "rows": THREE, "crank": True, "transmission": 20}
    return answer("synthesise", asked, "en", lambda _: None)


def test_cards_tell_where_the_point_lies_and_the_drive_turns_the_way_of_the_targets(found_for_three):
    """By the places of joints in the frames of the motion, and by Grashof's sums."""
    items = found_for_three["items"]
    assert max(item["size"] for item in items) < 10 * np.hypot(75, 25)
    assert "Not shown: 2 with a link longer than 791 mm." in found_for_three["note"]
    for item in items:
        if item["form"] == "Four-bar":
            frame, *others = item["lengths"]
            low, *middle, high = sorted(item["lengths"])
            shortest = {frame: "double crank", others[0]: "crank-rocker"}.get(low, "")
            assert low + high < sum(middle)
            assert item["kind"] == shortest
        frames = np.array(item["frames"]) @ (1, 1j)
        passed = [int(np.abs(frames[:, 4] - complex(x, y)).argmin()) for x, y, _ in THREE]
        later = (np.array(passed) - passed[0]) * (-1 if item["backward"] else 1) % len(frames)
        assert list(later) == sorted(later)
        (own,) = [member for member in item["members"] if 4 in member]  # crank, coupler with its point, ...
        start, end = frames[:, own[0]], frames[:, own[1]]
        if "nverted" in item["form"]:  # along the guide, from the pin to where it lies
            low, high = frames[:, item["rails"][0]].T
            nearer = np.abs(low - start) < np.abs(high - start)
            end = start + np.where(nearer, high - low, low - high)
        along = (end - start) / np.abs(end - start)
        assert np.allclose(start + complex(*item["point"]) * along, frames[:, 4], atol=1e-3 * item["size"])
    assert {item["backward"] for item in items} == {False, True}


def test_demands_stay_in_their_range_and_the_region_of_the_pivots_is_seen(design):
    """An angle is 90° at most; the rectangle about the points is so much wider on every side."""
    view = design.page
    for place in ((-60, 0), (0, 45), (20, 20), (-30, -30), (55, -50)):
        view.mouse.click(*design.target(*place))
    for name, typed, shown in (
        ("least", "120", "90"),
        ("least", "-3", "0"),
        ("reach", "-5", "0"),
        ("reach", "10", "10"),
    ):
        field = view.locator(f'[data-field="{name}"]')
        field.fill(typed)
        field.press("Tab")
        assert field.input_value() == shown
    corners = re.findall(r"-?[\d.]+ -?[\d.]+", view.locator("[data-region]").get_attribute("d"))
    x, y = np.array([corner.split() for corner in corners], float).T
    assert [min(x), max(x), min(-y), max(-y)] == [-70, 65, -60, 55]
    # as long as a link is where nothing is typed: at most the diagonal of that space, ten times that of the points
    longest = view.locator('[data-field="longest"]')
    assert longest.get_attribute("placeholder") == f"{np.hypot(135, 115):.3g}"
    field.fill("")
    field.press("Tab")
    assert float(longest.get_attribute("placeholder")) == float(f"{10 * np.hypot(115, 95):.3g}")
    field.fill("0")  # none outside, which is not the same as no limit
    longest.fill("80")
    longest.press("Tab")
    design.hold()
    view.click('[data-act="synthesise"]')
    assert view.evaluate("(({ reach, longest_link }) => [reach, longest_link])(held.at(-1).params)") == [0, 80]


def test_no_link_is_longer_than_what_is_typed(found_for_three):
    """Those that are left are as they were; of the others it is said how many there are."""
    from gruebler.page.requests import answer

    asked = {"kind": "positions", "rows": THREE, "crank": True, "transmission": 20, "longest_link": 150}
    found = answer("synthesise", asked, "en", lambda _: None)
    sizes = sorted(item["size"] for item in found_for_three["items"])
    kept = [size for size in sizes if size <= 150]
    assert 0 < len(kept) < len(sizes) < 24
    assert sorted(item["size"] for item in found["items"]) == pytest.approx(kept)
    assert f"Not shown: {len(sizes) + 2 - len(kept)} with a link longer than 150 mm." in found["note"]


def test_what_is_no_number_is_told_with_one_that_is(design):
    view = design.page
    view.click('[data-value="dead-centres"]')
    field = view.locator(".targets input").first
    told = view.locator('[role="alert"], [role="status"]').filter(has_text="Expected a number, such as 60.")
    field.fill("abc")
    field.press("Tab")
    told.wait_for()
    assert view.evaluate(f"{VIEW}.rows['dead-centres']") == [[60, 1.2]]
    view.locator(".targets input").first.fill("70")
    view.locator(".targets input").first.press("Tab")
    assert view.evaluate(f"{VIEW}.rows['dead-centres']") == [[70, 1.2]]
    assert told.count() == 0
    view.locator(".targets input").first.fill("1e9")  # of a place: all others would fall into one
    view.locator(".targets input").first.press("Tab")
    view.get_by_text("Expected a number from −1000000 to 1000000.").wait_for()
    assert view.evaluate(f"{VIEW}.rows['dead-centres']") == [[70, 1.2]]


def test_how_far_a_rejected_linkage_misses_a_point_is_a_length():
    """Of a point 7 mm above a coupler curve; how near that comes to it by 40,001 of its places."""
    from gruebler.base.text import message
    from gruebler.design.synthesis import Demands, PathTask, SynthesisResult
    from gruebler.design.synthesis.judging import judge_design
    from gruebler.design.synthesis.results import SolutionCount
    from gruebler.design.synthesis.targets import point_targets
    from gruebler.mechanics.fourbar import FourBar
    from gruebler.page.design_words import notes

    bar = FourBar(30, 80, 70, 90).linkage({"K": (40, 35)})
    curve = move(bar, np.linspace(0, 2 * np.pi, 40_001)).complex_point("K")
    points = curve[[0, 4000, 8000, 12000, 16000]]
    points[2] += 7j
    nearest = np.abs(curve - points[2]).min()
    bar = bar.with_reference_pose(move(bar, [0.0]).pose(0))
    rejected = judge_design(bar, point_targets("K", points, 50.0), Demands(), "four-bar")
    task = PathTask(tuple((z.real, z.imag) for z in points))
    count = SolutionCount(what=message("four-bars"), theorem=None, found=1, real=1)
    told = [
        str(note) for note in notes(SynthesisResult(task=task, designs=(), rejected=(rejected,), count=count), [], 0)
    ]
    assert told[-1] == (
        f"Rejected (1): target 3 is missed by {nearest:.3g} mm, unless the linkage is taken apart and put together "
        "the other way."
    )


def test_targets_last_when_the_page_is_loaded_again_and_none_is_left_when_cleared(design):
    view = design.page
    for place in ((-60, 0), (0, 45), (55, -50)):
        view.mouse.click(*design.target(*place))
    view.check('[data-field="closed"]')
    view.reload()
    design.until("window.gruebler?.motion?.linkage !== undefined")
    view.click('[data-view="synthesis"]')
    assert view.evaluate(f"{VIEW}.rows.points") == [[-60, 0], [0, 45], [55, -50]]
    assert view.is_checked('[data-field="closed"]')
    view.click('[data-act="clear"]')
    assert not view.is_checked('[data-field="closed"]')
    assert view.locator("[data-point]").count() == 0


def test_of_nearest_designs_that_are_too_long_none_is_said_to_meet_anything():
    from gruebler.page.requests import answer

    asked = {"kind": "positions", "rows": [[-40, 0, 12], [0, 25, 35], [35, 10, 70]], "crank": True, "transmission": 70}
    found = answer("synthesise", asked | {"pivots": [[-30, -40], [30, -40]], "longest_link": 30}, "en", print)
    assert not found["items"]
    assert "these meet" not in found["note"]
    assert "No linkage meets all demands" in found["note"]


def test_where_no_design_has_the_angle_those_that_come_nearest_are_shown():
    """Of the four-bars for a swing of 60° and a time ratio of 1.2 none passes 40.3°, over all that there are."""
    from gruebler.page.requests import answer

    asked = {"kind": "dead-centres", "rows": [[60, 1.2]], "crank": True}
    found = answer("synthesise", asked | {"transmission": 60}, "en", print)
    assert found["nearest"]
    assert "these meet all but a transmission angle of 60°." in found["note"]
    # by hand, for each crank on the circle of the pole: the rocker of unit length at 0 and 60 degrees
    swing, between = np.radians(60), np.pi * 0.2 / 2.2
    one, two = 1, np.exp(1j * swing)
    middle = (one + two) / 2 + (two - one) * 1j / 2 / np.tan(between) * np.array([[1], [-1]])
    pivot = middle + np.abs(one - middle) * np.exp(1j * np.linspace(0, 2 * np.pi, 100_001))
    near, far = np.sort(np.abs([pivot - one, pivot - two]), axis=0)
    crank, coupler, frame = (far - near) / 2, (far + near) / 2, np.abs(pivot)
    with np.errstate(invalid="ignore"):
        cosines = [(coupler**2 + 1 - (frame + sign * crank) ** 2) / (2 * coupler) for sign in (1, -1)]
        grashof = np.abs(np.angle((pivot - one) / (pivot - two)))
        least = np.min([np.arccos(np.abs(each)) for each in cosines], axis=0)
    real = np.isclose(grashof, between) & np.isfinite(least)
    best = np.degrees(least[real].max())
    assert best == pytest.approx(40.3, abs=0.1)
    assert max(item["transmission"] for item in found["items"]) == pytest.approx(best, abs=0.1)


def test_how_far_six_pairs_are_missed_is_an_angle():
    from gruebler.page.requests import answer

    rows = [[0, 0], [20, 10], [40, 15], [60, 40], [80, 42], [100, 70]]
    asked = {"kind": "function", "rows": rows, "crank": False, "transmission": 0}
    assert re.search(r"a target is missed by [\d.]+°\.", answer("synthesise", asked, "en", lambda _: None)["note"])


def test_near_misses_of_nine_points_are_shown():
    """The four-bar of which the points are is among the finitely many, whose angle is smaller than asked for."""
    from gruebler.mechanics.fourbar import FourBar
    from gruebler.page.requests import answer

    points = move(FourBar(30, 80, 70, 90).linkage({"K": (40, 35)}), np.linspace(0, 5.2, 9)).point("K")
    asked = {"kind": "points", "rows": points.tolist(), "crank": True, "transmission": 89}
    found = answer("synthesise", asked, "en", lambda _: None)
    assert found["nearest"]
    assert "these meet all but a transmission angle of 89°." in found["note"]
    own = [
        item for item in found["items"] if np.allclose(item["lengths"], [90, 30, 80, 70], rtol=1e-5)
    ]  # of five digits
    assert len(own) == 1
    assert own[0]["transmission"] < 89


def test_a_given_pivot_that_no_linkage_can_have_is_told():
    from gruebler.page.requests import answer

    rows = [[-50, 0, 0], [-20, 25, 20], [20, 30, 40], [50, 5, 60]]
    asked = {"kind": "positions", "rows": rows, "pivots": [[-20, -60]], "crank": False}
    found = answer("synthesise", asked, "en", print)
    told = r"its nearest point \((\S+) \| (\S+)\) mm is taken, (\S+) mm away"
    x, y, away = map(float, re.search(told, found["note"]).groups())
    assert away > 8
    assert np.hypot(x + 20, y + 60) == pytest.approx(away, abs=0.02)
    for item in found["items"]:
        frames = np.array(item["frames"])[:, : item["joints"]] - (x, y)
        assert np.abs(frames).max(axis=(0, 2)).min() < 1e-2  # one of its joints stays there


def test_a_finger_chooses_a_card_then_opens_it_and_the_drive_turns_clockwise(tab, server, found_for_three):
    page = tab(width=390, height=844, touch=True).open(server.address)
    view = page.page
    view.tap('[data-view="synthesis"]')  # a mouse would lie above a card in the end
    view.evaluate(f"(rows) => {{ {VIEW}.rows.positions = rows; }}", THREE)
    view.tap('[data-value="positions"]')
    view.tap('[data-act="synthesise"]')
    view.locator('[data-list="designs"] .card').first.wait_for(timeout=60_000)
    four_bars = [item for item in found_for_three["items"] if item["form"] == "Four-bar"]
    view.locator('[data-field="form"]').select_option(label=f"Four-bar · {len(four_bars)}")
    cards = view.locator('[data-list="designs"] .card')
    assert cards.first.get_attribute("aria-current") is not None
    assert view.locator("[data-ghost] .support").count() == 2  # crank and rocker
    up = view.locator('[data-act="back"]').bounding_box()
    for k in range(3):  # it does not lie over what is to be met
        x, y = page.middle(f'[data-point="{k}"] circle')
        assert x < up["x"] or y > up["y"] + up["height"]
    cards.nth(1).tap()
    assert cards.first.get_attribute("aria-current") is None
    assert view.evaluate("gruebler.view") == "synthesis"
    x, y = next(item["point"] for item in four_bars if item["backward"])
    last = cards.filter(has_text=f"{x:.1f}\xa0|\xa0{y:.1f}".replace("-", "−"))
    last.tap()
    assert view.evaluate("gruebler.view") == "synthesis"
    assert last.get_attribute("aria-current") is not None
    assert "scale(-1 1)" in view.locator("[data-ghost] .driven").get_attribute("transform")
    kinds = view.locator('[data-field="form"]')
    names = kinds.locator("option").all_inner_texts()
    kinds.select_option(index=next(k for k, name in enumerate(names) if "Inverted" in name))
    assert view.locator("[data-ghost] .support").count() == 2  # crank and swivel, on which the slide is, too
    kinds.select_option(label=f"Four-bar · {len(four_bars)}")
    last.tap()  # chosen again, as another played
    last.tap()
    page.until("gruebler.view === 'motion'")
    drive = "gruebler.motion.linkage.drives[0]"
    before = view.evaluate(drive)
    play = view.locator(".transport .play")
    if play.get_attribute("title") == "Play":
        play.tap()
    page.until(f"{drive} !== {before}")
    play.tap()
    assert 0 < (before - view.evaluate(drive)) % (2 * np.pi) < np.pi
    assert view.locator(".stage .driven").get_attribute("transform") == "rotate(0) scale(-1 1)"
