"""A mechanism is drawn on an empty plane in a browser, and what is said of it while it grows."""

import base64
import itertools
import json
import math

import numpy as np
import pytest

from gruebler.files import linkage_from_json, linkage_to_json
from gruebler.files.load_reading import loads_of_document
from gruebler.mechanics.analysis.measuring import measures
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics import move
from gruebler.page.drawings import drawing_record
from gruebler.page.model import model_of
from gruebler.page.requests import answer
from gruebler.structure.chain import Chain
from gruebler.structure.mobility import mobility_report
from gruebler.teaching import catalog

FOUR_BAR = "R(0-1) R(1-2) R(2-3) R(3-0)"
MOVES = "Mobility 1 and one drive: the motion is determined."
FREEDOMS = '[data-fact="freedoms"]'


def test_what_is_offered_mends_it():
    """The mobility beside each offer is that of the chain which it leads to, written by hand."""
    # an open chain of three links has F = 3; its end on the ground makes a four-bar, that of link 2 a rigid triangle
    first = drawing_record("R(0-1) R(1-2) R(2-3)", "0", [], "en", ends={"3": "D"})["offers"]
    assert first[0] == {"kind": "ground", "links": ["3"], "generic": 1, "text": "Ground at D: F = 1"}
    assert len({str(offer) for offer in first}) == len(first)
    rigid = drawing_record("R(0-1) R(1-2)", "0", [], "en", ends={"1": "B", "2": "C"})["offers"]
    assert "ground" not in {offer["kind"] for offer in rigid}
    assert [offer["joint"] for offer in drawing_record(FOUR_BAR, "0", [], "en")["offers"]] == [0, 3]
    assert drawing_record(FOUR_BAR, "0", [0], "en")["offers"] == []
    assert [offer["kind"] for offer in drawing_record(FOUR_BAR, "0", [0, 3], "en")["offers"]] == ["undrive", "undrive"]
    # a link on two grounds does not move: its joints are no drives, neither offered nor taken
    # what drives a lever on a cylinder is the cylinder; of a slider-crank, whose slide is on the ground, the crank
    lever = "R(0-1) R(0-2) R(1-3) P(2-3)"
    assert [offer["joint"] for offer in drawing_record(lever, "0", [], "en", cylinders=[3])["offers"]] == [3, 0, 1]
    # drawn with a block on a rod the same chain is an inverted slider-crank
    assert [offer["joint"] for offer in drawing_record(lever, "0", [], "en")["offers"]] == [0, 1]
    assert drawing_record("R(0-1) R(1-2) R(2-3) P(0-3)", "0", [], "en")["offers"][0]["joint"] == 0
    held = "R(0-1) R(0-1) R(0-2)"
    assert [offer["joint"] for offer in drawing_record(held, "0", [], "en")["offers"]] == [2]
    shared = drawing_record("R(0-1-4) R(1-2) R(2-3) R(3-0) R(4-5) R(5-3)", "0", [0], "en")
    assert (shared["reason"], shared["fixed"]) == (
        "Mobility 1 and one drive: the motion is determined.",
        True,
    )  # the drive moves link 1
    stuck = drawing_record(held, "0", [0], "en")
    assert not stuck["fixed"]
    assert "still moving: 2" in stuck["reason"]
    assert [(offer["kind"], offer["joint"]) for offer in stuck["offers"]] == [("undrive", 0)]
    assert drawing_record(held, "0", [2], "en")["fixed"]
    five = drawing_record("R(0-1) R(1-2) R(2-3) R(3-4) R(4-0)", "0", [0], "en")
    assert five["generic"] == 2
    bar = next(offer for offer in five["offers"] if offer["kind"] == "bar")
    one, other = bar["links"]
    closed = Chain.parse(f"R(0-1) R(1-2) R(2-3) R(3-4) R(4-0) R({one}-9) R(9-{other})")
    assert bar["generic"] == mobility_report(closed).generic == 1
    stiff = drawing_record(FOUR_BAR + " R(1-4) R(4-3)", "0", [0], "de")
    assert stiff["generic"] == 0
    removed = {offer["links"][0]: offer["generic"] for offer in stiff["offers"]}
    assert removed["4"] == 1  # the four-bar again
    assert set(stiff["offers"][0]) == {"kind", "links", "generic", "text"}
    # a link on two pins holds both of them; of joints with equal links the second is no longer the first with a sign
    for lang in ("en", "de"):
        called = " ".join(drawing_record(held, "0", [], lang, ["A", "B", "C"])["lines"])
        assert " A, B." in called
        assert "(0-1)" not in called


def test_what_is_offered_leaves_a_machine_that_its_drives_move():
    """A bar between coupler and ground would hold the four-bar fast: 3(6 - 1) - 2·7 = 1 is the freedom of link 4."""
    hung = FOUR_BAR + " R(2-4)"
    bars = [o["links"] for o in drawing_record(hung, "0", [0], "en", "ABCDE")["offers"] if o["kind"] == "bar"]
    assert bars[0] == ["4", "0"]
    assert ["2", "0"] not in bars
    for one, other in bars:
        report = mobility_report(Chain.parse(f"{hung} R({one}-9) R(9-{other})"))
        assert (report.generic, report.rigid_clusters) == (1, ())
    held = hung + " R(2-5) R(5-0)"
    for lang, reason in (
        ("en", "A cannot be driven: at almost all sizes it does not move."),
        ("de", "A lässt sich nicht antreiben"),
    ):
        stuck = drawing_record(held, "0", [0], lang, "ABCDEFG")
        assert reason in stuck["reason"]
    assert stuck["offers"][0] == {"kind": "remove", "links": ["5"], "generic": 2, "text": "Glied 5 entfernen: F = 2"}
    assert stuck["offers"][-1]["text"] == "Antrieb an A entfernen"
    two = drawing_record(FOUR_BAR, "0", [0, 3], "en", "ABCD")
    assert two["reason"].endswith("Drives that conflict: A, D.")
    # of a five-bar with a drive no other one is offered that works against it: a triangle on the ground stays as it is
    truss = drawing_record("R(0-1) R(1-2) R(2-0) R(0-3) R(3-4)", "0", [], "en")["offers"]
    assert {offer["joint"] for offer in truss if offer["kind"] == "drive"} == {3}


def drawn_again(**more):
    """A four-bar with loads, in place of which links 1, 2 and the rocker are drawn: the answer of the library."""
    old = FourBar(25, 70, 40, 70).linkage().with_reference_pose(move(FourBar(25, 70, 40, 70).linkage(), [1.0]).pose())
    loads = {
        "speed": "10 rad/s",
        "bodies": {"coupler": {"mass": "2 kg", "centre": [35, 7], "inertia": "700 kg mm2"}, "crank": {"mass": "1 kg"}},
        "forces": {"R(coupler-rocker)": ["0 N", "-10 N"], "R(frame-crank)": ["1 N", "0 N"]},
        "moments": {"rocker": "5 N mm"},
        "springs": [{"between": ["frame:0,0", "R(coupler-rocker)"], "stiffness": "2 N/mm"}],
    }
    names = [*old.mechanism.chain.joint_names()]
    letters = {"R(frame-crank)": "A", "R(crank-coupler)": "B", "R(coupler-rocker)": "C", "R(frame-rocker)": "D"}
    numbers = {"crank": "1", "coupler": "2", "rocker": "3", "frame": "frame"}
    document = {
        "unit": "mm",
        "joints": "R(frame-1) R(1-2) R(2-lever) R(frame-lever)",
        "frame": "frame",
        "drives": ["R(frame-1)"],
        "page": {"letters": "A B C D"},
        "places": {
            "R(frame-1)": [0, 0],
            "R(1-2)": [0, 25],
            "R(2-lever)": [0, 165],
            "R(frame-lever)": [90, 0],
        },
    }
    before = {
        "document": linkage_to_json(old) | {"loads": loads, "page": {"bars": [old.mechanism.chain.index("crank")]}},
        "letters": [letters[name] for name in names],
        "links": [numbers[link] for link in old.mechanism.chain.links],
    }
    return answer("open_document", {"document": document | more, "before": before}, "en", print)["document"]


def test_loads_stay_where_links_and_joints_are_still_there():
    """The rocker has another name, the coupler is twice as long as its 70, and upright: its body goes along."""
    document = drawn_again()
    linkage = linkage_from_json(document)
    loads, speed = loads_of_document(document, linkage)
    assert speed == pytest.approx(10)
    assert loads.forces == {"R(2-lever)": (0.0, -10.0), "R(frame-1)": (1.0, 0.0)}
    assert loads.moments == {"lever": 5.0}
    body = loads.bodies["2"]
    assert (body.mass, body.inertia) == pytest.approx((2, 700 * 4))
    # 70 of 140 along the coupler, 14 to its left
    assert linkage.reference_pose["2"].put(*body.centre) == pytest.approx((-14, 25 + 70))
    assert loads.bodies["1"].mass == 1
    assert document["page"]["bars"] == [linkage.mechanism.chain.index("1")]
    (spring,) = loads.springs
    assert spring.between[1] == "R(2-lever)"
    assert spring.stiffness == 2


def test_loads_on_what_is_gone_are_left_out():
    """A five-bar: the coupler with joint B alone is left of it, and joint C is of other links."""
    document = drawn_again(
        joints="R(frame-1) R(1-2) R(4-5) R(frame-5) R(2-4)",
        page={"letters": "A B C E F"},
        drives=["R(frame-1)", "R(frame-5)"],
        places={
            "R(frame-1)": [0, 0],
            "R(1-2)": [0, 25],
            "R(4-5)": [80, 60],
            "R(frame-5)": [90, 0],
            "R(2-4)": [40, 70],
        },
    )
    loads = document["loads"]
    assert list(loads["forces"]) == ["R(frame-1)"]
    assert sorted(loads["bodies"]) == ["1", "2"]
    assert "moments" not in loads
    assert "springs" not in loads
    assert "speed" not in loads  # there are two drives


@pytest.fixture
def plane(tab, server):
    page = tab().open(server.address)
    page.page.click('[data-view="build"]')
    page.page.locator(".drawing").wait_for()
    return page


def click(page, *places: tuple[float, float]) -> None:
    """Click at places of the plane."""
    for x, y in places:
        u, v = page.page.evaluate(f"gruebler.views.build.viewport.screen({x}, {y})")
        box = page.page.locator(".drawing").bounding_box()
        page.page.mouse.click(box["x"] + u, box["y"] + v)


def check_that_it_is_kept(plane):
    """A drawing of seven knots, four before its dyad, is loaded again at once."""
    view = plane.page
    view.keyboard.press("c")
    view.reload()
    plane.until("window.gruebler?.views?.build?.drawing.knots.length === 7")
    assert view.locator('.palette [aria-pressed="true"]').get_attribute("data-tool") == "cylinder"
    view.keyboard.press("Control+z")
    assert view.evaluate("gruebler.views.build.drawing.knots.length") == 4
    view.evaluate("localStorage.clear()")


def test_a_four_bar_and_then_a_watt_six_bar_are_drawn_and_moved(plane):
    view = plane.page
    assert "ground" in view.locator('[data-place="mobility"]').inner_text()
    view.click('[data-tool="slider"]')
    view.keyboard.press("g")  # keys work wherever the focus is
    click(plane, (0, 0))
    view.keyboard.press("l")
    click(plane, (0, 0), (0, 20))
    assert view.locator('[data-fact="drawn"]').count() == 0  # two links are no chain that has a mobility
    view.keyboard.press("d")
    click(plane, (0, 20), (60, 40), (70, 0))
    view.locator(FREEDOMS).wait_for()
    # 3(4 - 1) - 2·3: an open chain
    assert view.locator('[data-fact="drawn"], [data-offer]').all_inner_texts()[:2] == [
        "F = 3",
        "Ground at D: F\xa0=\xa01",
    ]
    view.click('[data-offer="ground"]')
    view.locator('[data-offer="drive"]').nth(1).wait_for()  # of the open chain one was offered
    assert view.locator('[data-fact="drawn"]').inner_text() == "F = 1"
    # joints have letters on the plane and beside it, links numbers
    assert view.locator(".drawing text.name").all_text_contents() == ["1", "2", "3", "A", "B", "C", "D"]
    assert view.locator("tr td:first-child").all_inner_texts()[:4] == ["A", "B", "C", "D"]
    assert view.locator('[data-offer="drive"]').all_inner_texts() == ["Drive A", "Drive D"]
    view.locator('[data-offer="drive"]').first.click()
    view.locator('[data-act="move"]').wait_for()
    view.keyboard.press("v")
    assert view.locator('.palette [aria-pressed="true"]').get_attribute("data-tool") == "move"
    view.click('[data-view="motion"]')  # it shows what is drawn, as "Move it" does
    plane.until("gruebler.motion.linkage.model.links.includes('3') && gruebler.view === 'motion'")
    assert view.locator("h1 small").inner_text().startswith("New drawing")  # as while it was drawn
    linkage = linkage_from_json(json.loads(view.evaluate("JSON.stringify(gruebler.motion.document())")))
    assert linkage.mechanism.chain.text() == "R(frame-1) R(1-2) R(2-3) R(frame-3)"
    assert linkage.length("1", 0, 1) == pytest.approx(20, abs=1e-9)
    assert measures(linkage).span.full  # 20 + 70 < 63.2 + 41.2
    assert view.evaluate("gruebler.motion.transport.player.playing")
    # a point of the coupler, which is not on the frame, has a curve; it is not drawn
    assert view.evaluate("gruebler.motion.linkage.sizes.points.map(({ link }) => link)") == [
        view.evaluate("gruebler.motion.linkage.model.links.indexOf('2')")
    ]
    drawing = "JSON.stringify(gruebler.views.build.drawing)"
    drawn = view.evaluate(drawing)
    view.keyboard.press("Control+z")  # back to what it was drawn as, and the machine before it is in motion again
    assert view.evaluate("[gruebler.view, gruebler.motion.linkage.model.source]") == ["build", "crankrocker"]
    assert view.evaluate(drawing) == drawn
    view.click('[data-tool="dyad"]')
    click(plane, (30, 30), (40, 80), (110, 60))  # from the coupler
    view.keyboard.press("g")
    click(plane, (110, 60))
    plane.until(f"gruebler.root.querySelector('[data-place=mobility]').textContent.includes('{MOVES}')")
    view.locator('[data-act="move"]').click()
    plane.until("gruebler.motion.linkage.model.joints.length === 7")
    view.go_back()
    plane.until("gruebler.view === 'build'")
    view.keyboard.press("Control+z")
    assert view.evaluate("gruebler.views.build.drawing.knots.length") == 7
    check_that_it_is_kept(plane)


def test_what_is_offered_stands_clear_and_moves(plane):
    """A bar hangs on the coupler of a driven four-bar: the pivot of the link offered is on no bar, the tool is free."""
    view = plane.page
    view.click('[data-begin="four-bar"]')
    view.locator('[data-act="move"]').wait_for()
    view.keyboard.press("l")
    click(plane, (30, 30), (62, 58))
    view.mouse.move(700, 500)  # the next link would begin at its end
    assert view.locator(".drawing .pending").count() == 1
    offer = view.locator('[data-offer="bar"]').first
    offer.wait_for()
    assert offer.inner_text().replace("\xa0", " ") == "Add a link between 4 and frame: F = 1"
    assert view.locator('[data-offer="bar"]', has_text="between 2 and frame").count() == 0
    offer.click()
    view.mouse.move(700, 500)
    assert view.locator(".drawing .pending").count() == 0
    view.locator('[data-act="move"]').wait_for()
    assert view.locator(FREEDOMS).inner_text() == MOVES
    knots = view.evaluate("gruebler.views.build.drawing.knots")
    pivot = knots[-1]
    assert set(pivot["links"]) == {"frame", "5"}
    bars = {}
    for knot in knots:
        for link in set(knot["links"]) - {"frame", "5"}:
            bars.setdefault(link, []).append(complex(*knot["at"]))
    place = complex(*pivot["at"])
    for one, other in (bar for ends in bars.values() for bar in itertools.combinations(ends, 2)):
        part = ((place - one) / (other - one)).real
        assert abs(place - one - min(max(part, 0), 1) * (other - one)) > 10  # mm; links are 20 to 63 long
    box = view.locator(".drawing").bounding_box()
    x, y = view.evaluate(f"gruebler.views.build.viewport.screen({place.real}, {place.imag})")
    assert 0 < x < box["width"]
    assert 0 < y < box["height"]
    view.locator('[data-act="move"]').click()
    plane.until("gruebler.view === 'motion' && gruebler.motion.transport.player.playing")
    view.evaluate("localStorage.clear()")


def test_fields_follow_a_joint_that_is_dragged(plane):
    view = plane.page
    view.click('[data-begin="four-bar"]')
    knot = 2
    start = plane.middle(f'.drawing [data-knot="{knot}"]')
    view.mouse.move(*start)
    view.mouse.down()
    view.mouse.move(start[0] + 40, start[1] - 30, steps=8)
    x, y = view.evaluate(f"gruebler.views.build.drawing.knots[{knot}].at")
    for fields in (".choosing", '[data-page="build"] .side'):
        shown = view.locator(fields).locator("input").evaluate_all("all => all.map(({ value }) => value)")
        assert {f"{x:.6g}", f"{y:.6g}"} <= set(shown), fields
    before = view.evaluate("gruebler.views.build.undoable[0]")
    view.mouse.up()
    assert view.evaluate(f"gruebler.views.build.drawing.knots[{knot}].at") == [x, y]
    assert (before, view.evaluate("gruebler.views.build.undoable[0]")) == (True, True)
    view.keyboard.press("Control+z")
    assert view.evaluate(f"gruebler.views.build.drawing.knots[{knot}].at") != [x, y]


WATT = {
    "frame": "frame",
    "drives": [0],
    "knots": [
        {"at": at, "links": links}
        for at, links in (
            ([-30, -20], ["frame", "1"]),
            ([-30, 0], ["1", "2"]),
            ([20, 20], ["2", "3"]),
            ([30, -20], ["frame", "3"]),
            ([25, 0], ["3", "4"]),
            ([80, 20], ["4", "5"]),
            ([100, -20], ["frame", "5"]),
        )
    ],
}


def test_bars_stay_bars_and_names_stay_names(plane):
    """A point is added for its curve where it changes no link; one that was drawn keeps its letter, there and back."""
    view = plane.page
    view.evaluate(f"gruebler.views.build.begin({json.dumps(WATT)})")
    view.locator('[data-act="move"]').click()
    plane.until("gruebler.view === 'motion' && gruebler.motion.linkage.model.joints.length === 7")
    (point,) = view.evaluate("gruebler.motion.linkage.sizes.points")
    assert view.evaluate("gruebler.motion.linkage.model.links")[point["link"]] == "2"  # the crank drives it
    assert point["at"] == pytest.approx([math.hypot(50, 20) / 2, 0], abs=1e-9)  # on the line of its joints
    assert view.locator(".facts", has_text="Smallest μ").inner_text().count("47.5°") == 1  # by hand: test_machine.py
    assert "at 0°, link 2" in view.locator(".facts").first.inner_text().replace("\xa0", " ")
    view.click('[data-view="build"]')
    view.evaluate("gruebler.views.build.empty()")
    assert view.locator("th", has_text="Point").all_inner_texts() == []
    view.click('[data-begin="six-bar"]')
    assert view.locator("th").first.inner_text() == "Point"  # seven joints, and E
    view.locator('[data-act="move"]').click()
    plane.until("gruebler.view === 'motion' && gruebler.motion.linkage.sizes.points[0]?.name === 'E'")
    letters = "gruebler.motion.linkage.beside.letters"
    assert view.evaluate(letters) == "A B C D F G H"
    view.click('[data-view="build"]')
    view.evaluate("gruebler.views.build.empty()")
    view.click('[data-begin="hand"]')
    names = set(view.locator(".drawing text.name").all_text_contents())
    assert names == {*"ABCDEFGH", *"12345"}
    view.evaluate("localStorage.clear()")


def test_a_way_is_counted_from_the_pivot_of_the_crank(plane):
    view = plane.page
    # the picture has what the plane has
    signs = [view.locator(f'[data-begin="slider-crank"] .{name}').count() for name in ("block", "rail", "support")]
    assert signs == [1, 1, 1]
    view.click('[data-begin="slider-crank"]')
    assert [view.locator(f".drawing .{name}").count() for name in ("block", "rail", "support")] == signs
    view.locator('[data-act="move"]').click()
    plane.until("gruebler.motion.linkage.model.outputs[0]?.joint === 3")
    assert view.locator("label", has_text="eccentricity").all_inner_texts() == ["eccentricity"]
    linkage = linkage_from_json(json.loads(view.evaluate("JSON.stringify(gruebler.motion.document())")))
    # at 90 degrees the block is where it was drawn, 80 to the right; at 0 degrees 20 + 82.46
    ways = move(linkage, np.radians([90, 0])).displacement(3)
    assert ways == pytest.approx([80, 20 + math.hypot(80, 20)], abs=1e-9)
    view.evaluate("localStorage.clear()")


def test_on_a_phone_what_is_chosen_stands_beside_the_table(tab, server):
    page = tab(width=390, height=844, touch=True).open(server.address)
    view = page.page
    view.click('[data-view="build"]')
    picture = view.locator('[data-begin="four-bar"] svg').bounding_box()
    assert picture["width"] >= 80  # a four-bar is told from a six-bar
    assert picture["height"] >= 44
    view.click('[data-begin="four-bar"]')
    view.locator("table input").first.wait_for()
    # beside an upright bar, too
    assert {"1", "2", "3"} <= set(view.locator(".drawing text.name").all_text_contents())
    plane = "gruebler.views.build.viewport"
    view.evaluate(f"{plane}.fit({{left: -60, right: 160, bottom: -80, top: 90}}, 1e-9)")
    shown = view.evaluate(f"[{plane}.scale, ...{plane}.screen(0, 0)]")
    view.evaluate("scrollTo(0, 400)")
    page.until("gruebler.root.querySelector('.view.shown .stage').classList.contains('low')")
    assert view.locator(".drawing + .hint").is_visible()
    box = view.locator('.drawing [data-knot="1"]').bounding_box()
    view.touchscreen.tap(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    choice = view.locator(".choosing")
    choice.get_by_text("B: 1 – 2").wait_for()
    assert choice.get_by_text("Remove").is_visible()
    height = view.evaluate("gruebler.views.build.viewport.height")
    for k in range(5):  # all of the drawing is in the low picture
        box = view.locator(f'.drawing [data-knot="{k}"]').bounding_box()
        assert 0 <= box["y"] <= height - box["height"]
        assert box["y"] + box["height"] <= choice.bounding_box()["y"]
    view.evaluate("scrollTo(0, 0)")
    page.until("!gruebler.root.querySelector('.view.shown .stage').classList.contains('low')")
    page.until(f"{plane}.scale === {shown[0]}")  # what was seen before is seen again
    assert view.evaluate(f"{plane}.screen(0, 0)") == shown[1:]
    view.evaluate("localStorage.clear()")


def test_an_empty_plane_begins_with_the_ground_and_ends_stay_on_axes(plane):
    view = plane.page
    assert view.locator('.palette [aria-pressed="true"]').get_attribute("data-tool") == "ground"
    assert view.locator(".drawing + .hint").inner_text().startswith("Ground")
    assert "ground" in view.locator('[data-place="mobility"]').inner_text()
    for key in ("four-bar", "slider-crank", "six-bar"):
        view.click(f'[data-begin="{key}"]')
        view.locator('[data-act="move"]').wait_for()  # its mobility is 1, and a joint drives it
        assert not view.locator("[data-begin]").count()
        view.keyboard.press("Control+z")
    scale = "gruebler.views.build.viewport.scale"
    seen = []
    for sign in ("0", "+", "0"):
        view.locator(".drawing").press(sign)
        seen.append(view.evaluate(scale))
    assert seen == pytest.approx([seen[0], 1.25 * seen[0], seen[0]])
    for number in (1, 2):
        view.click(f".stage:has(.drawing) .tools button:nth-child({number})")
    assert view.evaluate(scale) == pytest.approx(seen[0])  # 1.25 · 0.8
    view.keyboard.press("g")
    view.click('[data-tool="ground"]')
    click(plane, (0, 0))
    assert "at least three links" in view.locator('[data-place="mobility"]').inner_text()
    view.keyboard.press("l")
    assert view.locator(".drawing + .hint").inner_text().startswith("Link")
    click(plane, (0, 0), (60, 35))  # 69.46 long: as near to 70 as the pointer is
    last = "gruebler.views.build.drawing.knots.at(-1).at"
    assert view.evaluate(last) == [60, 35]
    click(plane, (0, 0), (69.6, 0.5))
    assert view.evaluate(last) == [70, 0]
    guides = view.locator(".guide")
    assert guides.get_attribute("d") == ""  # the click is over
    plane.page.mouse.move(*plane.middle('[data-tool="move"]'), steps=8)
    assert guides.get_attribute("d") == ""  # nor does one stay where the pointer left
    drawn = view.evaluate("gruebler.views.build.drawing.knots.length")
    view.click('[data-act="empty"]')
    assert view.locator('.palette [aria-pressed="true"]').get_attribute("data-tool") == "ground"
    assert not view.locator('[data-act="empty"]').count()
    view.click('[data-icon="undo"]')
    assert view.evaluate("gruebler.views.build.drawing.knots.length") == drawn > 0


def test_a_plate_lies_below_bars(plane):
    """A point beside the rod of a slider-crank makes it a triangle, over which the crank goes on; in Motion, too."""
    view = plane.page
    view.click('[data-begin="slider-crank"]')
    order = "[...gruebler.root.querySelectorAll('.drawing [data-link]')].map((one) => one.dataset.link)"
    assert view.evaluate(order).index("1") < view.evaluate(order).index("2")  # two bars, as they were drawn
    view.evaluate("""() => {
        const { build } = gruebler.views;
        build.change({ ...build.drawing, knots: [...build.drawing.knots, { at: [20, -30], links: ["2"] }] });
    }""")
    assert view.evaluate(order)[0] == "2"
    view.locator('[data-act="move"]').click()
    plane.until("gruebler.view === 'motion'")
    bodies = "[...gruebler.root.querySelectorAll('.bodies > .link')].map((one) => one.dataset.link)"
    assert view.evaluate(bodies)[0] == "2"
    # its point is taken onto the line of its joints: it is a bar, and none lies below another
    view.evaluate("""() => {
        const { linkage } = gruebler.motion;
        const { at } = linkage.model.elements.find(({ link }) => linkage.model.links[link] === "2");
        gruebler.motion.attempt(() => { linkage.sizes.points[0].at = [...at]; });
    }""")
    assert view.evaluate(bodies) == ["1", "2", "3"]


def test_a_link_without_a_joint_is_named_and_nothing_moves_before_it_has_one(plane):
    view = plane.page
    view.click('[data-begin="four-bar"]')
    view.locator('[data-act="move"]').wait_for()
    view.keyboard.press("l")
    click(plane, (0, 45), (10, 58))  # beside the others: 3(5 - 1) - 2·4 = 4
    assert view.locator('[data-fact="drawn"]').inner_text() == "F = 4"
    assert view.locator('[data-place="mobility"]').inner_text().endswith("Link 4 has no joint yet.")
    assert not view.locator('[data-act="move"]').count()
    view.keyboard.press("Escape")
    view.keyboard.press("g")
    click(plane, (0, 45))
    view.locator(FREEDOMS).wait_for()


def test_what_is_done_with_the_chosen_takes_one_row_of_a_phone_and_leaves_it_in_sight(tab, server):
    page = tab(width=390, height=844, locale="de-DE", touch=True).open(server.address)
    view = page.page
    view.click('[data-view="build"]')
    view.click('[data-begin="slider-crank"]')
    view.locator('[data-act="move"]').wait_for()
    stage = view.locator(".stage:has(.drawing)").bounding_box()
    sheet = view.locator(".choosing")
    for down in range(0, 240, 60):  # the crank pin is seen lower and lower
        view.evaluate(
            f"gruebler.views.build.viewport.fit({{left: -60, right: 140, bottom: {down - 160}, top: {down}}}, 1e-9)"
        )
        box = view.locator(".drawing").bounding_box()
        x, y = view.evaluate("gruebler.views.build.viewport.screen(0, 20)")
        view.mouse.click(box["x"] + x, box["y"] + y)
        if not 0 < y < box["height"]:
            continue
        shown = sheet.bounding_box()
        assert shown["height"] < 0.16 * stage["height"]
        joint = view.locator(".drawing .chosen .joint").bounding_box()
        assert joint["y"] > shown["y"] + shown["height"] or joint["y"] + joint["height"] < shown["y"]
    assert view.locator(".drawing + .hint").is_hidden()
    view.evaluate("gruebler.views.build.viewport.fit({left: -10, right: 90, bottom: -60, top: 30}, 1e-9)")
    box = view.locator(".drawing").bounding_box()
    x, y = view.evaluate("gruebler.views.build.viewport.screen(0, 10)")
    view.mouse.click(box["x"] + x, box["y"] + y)  # a link
    sheet.locator('[data-act="frame"]').wait_for()
    assert sheet.bounding_box()["height"] < 0.16 * stage["height"]
    sheet.locator('[data-act="remove"]').click()  # the last one is reached
    assert sheet.is_hidden()


def test_a_slider_crank_is_drawn_by_keys_alone(plane):
    view = plane.page
    view.locator(".drawing").focus()
    view.keyboard.press("?")
    keys = view.locator("dialog")
    assert "V G L S D C W P" in keys.inner_text()
    view.keyboard.press("v")  # behind a sheet it does nothing
    view.keyboard.press("Escape")
    keys.wait_for(state="detached")
    assert view.locator('.palette [aria-pressed="true"]').get_attribute("data-tool") == "ground"
    view.locator(".drawing").focus()
    view.keyboard.press("g")
    view.keyboard.press("Enter")
    view.keyboard.press("l")
    view.keyboard.press("Enter")
    view.keyboard.press("ArrowUp")
    view.keyboard.press("Enter")
    view.keyboard.press("Enter")
    for _ in range(4):
        view.keyboard.press("ArrowRight")
    view.keyboard.press("ArrowDown")
    view.keyboard.press("Enter")
    view.keyboard.press("s")
    view.keyboard.press("Enter")
    plane.until("gruebler.root.querySelector('[data-place=mobility]').textContent.includes('One drive is needed')")
    focused = "gruebler.root.getRootNode().activeElement"
    for _ in range(30):  # beside the plane
        view.keyboard.press("Tab")
        if view.evaluate(f"{focused}?.dataset.offer") == "drive":
            break
    view.keyboard.press("Enter")
    plane.until(f"{focused}?.dataset.act === 'move'")  # the offer is gone, what it makes possible has the focus
    assert view.evaluate("gruebler.views.build.drawing.knots.map((knot) => knot.links.join('-'))") == [
        "frame-1",
        "1-2",
        "2-3",
        "frame-3",
    ]
    view.keyboard.press("Enter")
    plane.until(f"gruebler.view === 'motion' && {focused}?.matches('.play')")


def test_the_library_takes_cylinders_and_gears_as_they_are_drawn():
    """The documents of explorer/test/drawing.test.ts; a cylinder is as long as its drive says."""
    lever = {
        "unit": "mm",
        "joints": "R(frame-1) R(1-3) R(frame-2) P(2-3)",
        "frame": "frame",
        "drives": ["P(2-3)"],
        "places": {
            "R(frame-1)": [0, 0],
            "R(1-3)": [10, 40],
            "R(frame-2)": [60, 0],
            "P(2-3)": [60, 0, math.degrees(math.atan2(40, -50))],
        },
    }
    lengths = [60.0, 64.0]  # from end to end
    ends = move(linkage_from_json(lever), lengths).point("R(1-3)")
    assert [math.dist(end, (60, 0)) for end in ends] == pytest.approx(lengths, abs=1e-9)
    gears = {
        "unit": "mm",
        "joints": "R(frame-1) R(frame-2) G(1-2)",
        "frame": "frame",
        "drives": ["R(frame-1)"],
        "places": {
            "R(frame-1)": [0, 0],
            "R(frame-2)": [60, 0],
            "G(1-2)": {"1": {"at": [0, 0], "radius": 20}, "2": {"at": [60, 0], "radius": 40}},
        },
    }
    turns = move(linkage_from_json(gears), [0.0, 1.0]).angle("2")
    assert turns[1] - turns[0] == pytest.approx(-0.5, abs=1e-12)
    gears["places"]["G(1-2)"] = {"1": {"at": [0, 0], "radius": -90}, "2": {"at": [60, 0], "radius": 30}}
    turns = move(linkage_from_json(gears), [0.0, 1.0]).angle("2")  # in a ring both turn in one sense
    assert turns[1] - turns[0] == pytest.approx(3, abs=1e-12)


def test_a_drawn_cylinder_is_one_in_motion_however_far_it_is_drawn_out(plane):
    """From 60 - 51 to 60 + 51 mm, difference and sum of A-B and B-C: no rod is drawn in by so much, it telescopes."""
    view = plane.page
    view.click('[data-tool="ground"]')
    click(plane, (0, 0), (60, 0))
    view.keyboard.press("l")
    click(plane, (60, 0), (70, 50))
    view.keyboard.press("c")
    click(plane, (0, 0), (70, 50))
    view.keyboard.press("v")
    click(plane, (35, 25))
    view.locator(FREEDOMS).wait_for()
    view.click('[data-act="drive"]')
    view.click('[data-act="move"]')
    plane.until("gruebler.view === 'motion' && gruebler.motion.linkage.model.drives[0]?.name === 'P(2-3)'")
    view.evaluate("gruebler.motion.transport.pause()")
    assert view.locator(".bodies .block").count() == 0
    read = """([part]) => {
        const { linkage, stage, transport } = gruebler.motion, all = linkage.cycle.values;
        transport.pick(all[Math.floor(part * (all.length - 1))]);
        const ends = (name) => {
            const path = gruebler.root.querySelector(`.bodies ${name}`);
            const found = path.getAttribute("d").match(/[-.\\d]+/g).map(Number);
            const { a, b, c, d, e, f } = path.parentElement.transform.baseVal[0].matrix;
            return [0, 2].map((k) => [a * found[k] + c * found[k + 1] + e, b * found[k] + d * found[k + 1] + f]);
        };
        const pins = [[0, 0], linkage.jointAt(2)].map((at) => stage.viewport.screen(...at));
        const at = ([u, v]) => { // of the way from A to C
            const [[x, y], [p, q]] = pins;
            return ((u - x) * (p - x) + (v - y) * (q - y)) / ((p - x) ** 2 + (q - y) ** 2);
        };
        const letter = [...stage.root.querySelectorAll("text.name")].find((one) => one.textContent === "D");
        const { e, f } = letter.transform.baseVal[0].matrix;
        return [...ends(".slot"), ...ends(".rod"), [e, f]].map(at);
    }"""
    for part in (0.02, 0.3, 0.6, 0.98):
        foot, top, end, inner, letter = view.evaluate(read, [part])
        assert [foot, end] == pytest.approx([0, 1], abs=0.01)  # barrel at A, rod at C
        assert 0 < inner < top < 1, part  # the rod ends in the barrel
        assert part == 0.02 or 0.3 < letter < 0.7, part  # D is the slide


def test_a_cylinder_is_drawn_over_a_picture_and_driven(plane, tmp_path):
    view = plane.page
    view.click('[data-tool="ground"]')
    click(plane, (0, 0), (60, 0))
    view.keyboard.press("l")
    click(plane, (0, 0), (10, 40))
    view.keyboard.press("c")
    click(plane, (60, 0), (10, 40))
    screen, drawing = "gruebler.views.build.viewport.screen", view.locator(".drawing")
    (x, y), box = view.evaluate(f"{screen}(91, 40.6)"), drawing.bounding_box()
    view.mouse.move(box["x"] + x, box["y"] + y)
    assert view.evaluate("gruebler.views.build.cursor[1]") == 40  # in line with the end of the lever, with a guideline
    assert view.locator(".guide").get_attribute("d") != ""
    view.keyboard.press("v")
    click(plane, (35, 20))  # the middle of the cylinder
    view.click('[data-act="drive"]')
    view.locator('[aria-label="Point C y [mm]"]').fill("44")  # the end of the lever
    view.keyboard.press("Enter")
    arrows = view.locator(".drawing g:has(> .rod):has(> .slot) > .driven").count()
    # the cylinder goes along, and so does the arrow in its barrel
    assert (view.evaluate("gruebler.views.build.drawing.knots.at(-1).at"), arrows) == ([35, 22], 1)
    view.locator(".drawing").screenshot(path=tmp_path / "sketch.png")
    view.locator("input[accept]").set_input_files(tmp_path / "sketch.png")
    view.locator('[data-field="keeps"]').check()
    angle = view.locator('[aria-label="Picture φ [°]"]')
    angle.fill("30")
    angle.press("Enter")
    ends = view.locator("td input").evaluate_all("all => all.map(field => field.getBoundingClientRect().right)")
    assert max(ends) < view.viewport_size["width"]  # the fields stay within the panel
    assert "rotate(-30)" in view.locator(".drawing .backdrop").get_attribute("transform")
    whole = "all => all.map((one) => one.scrollWidth <= one.clientWidth)"
    assert all(view.locator('input[aria-label^="Picture"]').evaluate_all(whole))
    left, top, wide, turned = view.evaluate("gruebler.views.build.drawing.picture.at")
    x, y = view.evaluate(f"{screen}({left} + 20, {top} - 30)")  # on the picture, beside all else
    spot = (box["x"] + x, box["y"] + y)
    view.mouse.click(*spot)
    plane.drag(spot, (30, 20))
    moved = view.evaluate("gruebler.views.build.drawing.picture.at")
    scale = view.evaluate("gruebler.views.build.viewport.scale")
    assert moved == pytest.approx([left + 30 / scale, top - 20 / scale, wide, turned], abs=1e-9)
    plane.drag(plane.middle('[data-grip="turn"]'), (-40, 90))
    assert view.evaluate("gruebler.views.build.drawing.picture.at[3]") < turned
    plane.drag(plane.middle('[data-grip="size"]'), (-20, -10))
    assert view.evaluate("gruebler.views.build.drawing.picture.at[2]") < wide
    view.locator('[aria-label="Picture φ [°]"]').fill("30")
    view.locator('[aria-label="Picture φ [°]"]').press("Enter")
    view.locator('[data-act="move"]').click()
    plane.until("gruebler.view === 'motion' && gruebler.motion.linkage.model.drives[0]?.name === 'P(2-3)'")
    assert view.evaluate("gruebler.motion.linkage.drive.turning") is False
    assert "rotate(-30)" in view.locator(".stage .backdrop").last.get_attribute("transform")
    assert view.evaluate("gruebler.motion.document().page.picture.href.slice(0, 11)") == "data:image/"
    view.evaluate("localStorage.clear()")


@pytest.mark.parametrize("touch", [False, True])
def test_a_picture_gets_its_scale_by_two_points(tab, server, touch, tmp_path):
    """Of 400 by 200 pixels, two marked ones at (50, 50) and (350, 150): the place of the first one stays."""
    page = tab(width=1024, height=768, touch=touch).open(server.address)
    view = page.page
    view.click('[data-view="build"]')
    view.evaluate("gruebler.views.build.empty()")
    data = view.evaluate("""() => {
        const canvas = Object.assign(document.createElement("canvas"), { width: 400, height: 200 });
        canvas.getContext("2d").fillRect(50, 50, 300, 100);
        return canvas.toDataURL("image/png").split(",")[1];
    }""")
    (tmp_path / "marked.png").write_bytes(base64.b64decode(data))
    view.locator("input[accept]").set_input_files(tmp_path / "marked.png")
    view.locator('[aria-label="Picture φ [°]"]').fill("30")
    view.locator('[aria-label="Picture φ [°]"]').press("Enter")
    across = view.locator('[aria-label="Picture x"]')
    middle = across.input_value()
    across.fill("−123.456")
    assert [
        across.evaluate("(one) => one.scrollWidth <= one.clientWidth"),
        *(view.locator(f".side {one}").inner_text() for one in ("[data-act=picture]", "th:has-text('Width')")),
    ] == [True, "Replace picture", "Width [mm]"]
    across.fill(middle)
    across.press("Enter")
    picture = "gruebler.views.build.drawing.picture.at"
    before = view.evaluate(picture)

    def place(column, row):
        """Of a pixel of the picture, in the plane."""
        x, y, wide, turned = view.evaluate(picture)
        u, v = (column - 200) / 400 * wide, (100 - row) / 400 * wide
        c, s = math.cos(math.radians(turned)), math.sin(math.radians(turned))
        return x + c * u - s * v, y + s * u + c * v

    def put(x, y):
        u, v = view.evaluate(f"gruebler.views.build.viewport.screen({x}, {y})")
        (view.touchscreen.tap if touch else view.mouse.click)(box["x"] + u, box["y"] + v)

    box = view.locator(".drawing").bounding_box()
    marks = [place(50, 50), place(350, 150)]
    view.click('[data-act="scale"]')
    assert view.locator(".drawing + .hint").bounding_box()["height"] < 25  # one line
    put(*marks[1])
    assert view.locator('[data-tool="move"]').get_attribute("aria-pressed") == "false"
    view.keyboard.press("Escape")  # given up
    assert view.locator('[data-tool="move"]').get_attribute("aria-pressed") == "true"
    view.click('[data-act="scale"]')
    put(*marks[0])
    put(*marks[1])
    field = view.locator('[data-field="distance"]')
    assert field.evaluate("(one) => one.getRootNode().activeElement === one")
    field.fill("0")
    field.press("Enter")
    assert view.evaluate(picture) == before
    field.fill("240")
    field.press("Enter")
    assert math.dist(place(50, 50), place(350, 150)) == pytest.approx(240, rel=0.01)  # a click is in whole pixels
    assert place(50, 50) == pytest.approx(marks[0], abs=2)
    assert view.evaluate(picture)[3] == 30
    assert field.count() == 0
    view.evaluate("gruebler.views.build.undo()")
    assert view.evaluate(picture) == before


def test_links_are_drawn_in_a_row_or_by_dragging_and_the_drawing_is_saved(plane, tmp_path):
    view = plane.page
    view.click('[data-tool="link"]')
    screen = "gruebler.views.build.viewport.screen"
    corners = [(0, 0), (0, 20), (60, 40), (70, 0)]
    box = view.locator(".drawing").bounding_box()
    pixels = [(box["x"] + u, box["y"] + v) for u, v in (view.evaluate(f"{screen}({x}, {y})") for x, y in corners)]
    for start, end in itertools.pairwise(pixels):  # as fast as it goes
        view.mouse.move(*start)
        view.mouse.down()
        view.mouse.move(*end)
        view.mouse.up()
    drawn = "gruebler.views.build.drawing.knots.map((knot) => [knot.links.join('-'), knot.at])"
    row = [["1", [0, 0]], ["1-2", [0, 20]], ["2-3", [60, 40]], ["3", [70, 0]]]
    assert view.evaluate(drawn) == row
    view.click('[data-act="empty"]')
    view.click('[data-tool="link"]')
    click(plane, *corners)
    assert view.evaluate(drawn) == row
    click(plane, (60, 40), (30, 60))  # not a second link between the joints of link 3, but another one away from it
    assert view.evaluate(drawn) == [*row[:2], ["2-3-4", [60, 40]], row[3], ["4", [30, 60]]]
    click(plane, (0, 0), (-30, 20))  # the row ends in a joint that was there
    assert view.evaluate(drawn)[0] == ["1-5", [0, 0]]
    assert view.evaluate(drawn)[4:] == [["4-5", [30, 60]]]
    all_of_it = view.evaluate(drawn)
    view.keyboard.press("Escape")
    click(plane, (0, 20), (0, 0))  # over link 1
    assert view.locator(".message").inner_text().startswith("1 joins them already.")
    assert not view.locator(".drawing .pending").count()
    assert view.evaluate(drawn) == all_of_it
    assert view.locator("h1 small").inner_text() == "New drawing"
    kept = view.evaluate("JSON.stringify(gruebler.views.build.drawing)")
    with view.expect_download() as saved:
        view.click('[data-icon="save"]')
    assert saved.value.suggested_filename == "New_drawing.json"
    saved.value.save_as(tmp_path / "drawing.json")
    view.click('[data-act="empty"]')
    view.click('[data-view="motion"]')
    view.locator("header input[type=file]").set_input_files(tmp_path / "drawing.json")
    plane.until("gruebler.view === 'build' && gruebler.views.build.drawing.knots.length")
    assert view.evaluate("JSON.stringify(gruebler.views.build.drawing)") == kept
    view.evaluate("localStorage.clear()")


def check_that_a_length_is_kept(plane, joint: str) -> None:
    """The length of the chosen link stands at a dimension line, is typed in a list, stays while its end is dragged."""
    view, screen = plane.page, "gruebler.views.build.viewport.screen"
    box = view.locator(".drawing").bounding_box()
    assert view.locator(".drawing [data-span]").get_attribute("data-span") == "A–B"
    view.locator(".drawing [data-span]").click()
    assert view.evaluate("gruebler.root.getRootNode().activeElement.id") == "length-A–B"
    view.keyboard.type("40")
    view.keyboard.press("Enter")
    assert view.evaluate(joint) == pytest.approx([24, 32])
    view.locator('[data-page="build"] [data-lock="length"]').first.click()
    (x, y), (u, v) = view.evaluate(f"[{screen}(24, 32), {screen}(32, 24)]")
    plane.drag((box["x"] + x, box["y"] + y), (u - x, v - y))
    start = view.evaluate("gruebler.views.build.drawing.knots[0].at")  # it stands on no ground, and goes along
    assert math.dist(view.evaluate(joint), start) == pytest.approx(40, abs=1e-9)
    for _ in range(3):
        view.keyboard.press("Control+z")


def check_that_points_and_slides_are_pulled(plane) -> None:
    view, screen = plane.page, "gruebler.views.build.viewport.screen"
    box = view.locator(".drawing").bounding_box()
    ends = view.evaluate("gruebler.views.build.drawing.knots.map((knot) => knot.at)")
    middle = [sum(pair) / 2 for pair in zip(*ends, strict=True)]
    for tool, start, end in (("p", middle, (40, 60)), ("s", (0, -20), (20, 0))):
        view.keyboard.press(tool)
        (x, y), (u, v) = view.evaluate(f"[{screen}(...{list(start)}), {screen}(...{list(end)})]")
        plane.drag((box["x"] + x, box["y"] + y), (u - x, v - y))
    (point,) = [knot for knot in view.evaluate("gruebler.views.build.drawing.knots") if knot["at"] == [40, 60]]
    assert point["links"] == ["2"]
    assert view.evaluate("gruebler.views.build.drawing.knots.at(-1).slide") == 45


def check_that_little_is_read_as_zero(plane, joint: str) -> None:
    """As 0.0036 of a pose beside 100 mm; what is typed so stays, and no place is changed."""
    field = plane.page.locator('.choosing [data-field="x"]')
    for typed, read in (("0.0036127", "0"), ("0.005", "0.005"), ("30", "30")):
        field.fill(typed)
        field.press("Enter")
        field.blur()  # else all digits are shown
        assert field.input_value() == read
        assert plane.page.evaluate(joint)[0] == float(typed)


def test_joints_are_joined_split_named_and_removed(plane):
    view = plane.page
    view.click('[data-tool="link"]')
    click(plane, (0, 0), (40, 0))
    view.keyboard.press("Escape")  # else the next link begins there
    click(plane, (60, 20), (100, 20))
    view.keyboard.press("v")
    screen = "gruebler.views.build.viewport.screen"
    (x, y), (u, v) = view.evaluate(f"[{screen}(60, 20), {screen}(40, 0)]")
    box = view.locator(".drawing").bounding_box()
    plane.drag((box["x"] + x, box["y"] + y), (u - x, v - y))
    knots = "gruebler.views.build.drawing.knots.map((knot) => knot.links.join('-')).sort()"
    assert view.evaluate(knots) == ["1", "1-2", "2"]
    assert "hold it as frame" in view.locator('[data-place="mobility"]').inner_text()
    places = ".palette button, .side > *, .drawing"
    before = [one.bounding_box() for one in view.locator(places).all()]
    click(plane, (40, 0))
    assert [one.bounding_box() for one in view.locator(places).all()] == before  # what is chosen moves nothing
    view.click('[data-act="split"]')
    assert view.evaluate(knots) == ["1", "1", "2", "2"]
    view.keyboard.press("Control+z")
    assert view.evaluate(knots) == ["1", "1-2", "2"]
    click(plane, (20, 0))
    typed = {"length": (50, [50, 0]), "x": (30, [30, 0]), "y": (40, [30, 40])}  # of link 1, then of its joint
    for field, (value, place) in typed.items():
        if field == "x":
            click(plane, (50, 0))
        view.locator(f'.choosing [data-field="{field}"]').fill(str(value))
        view.locator(f'.choosing [data-field="{field}"]').press("Enter")
        joint = "gruebler.views.build.drawing.knots.find((knot) => knot.links.length === 2).at"
        assert view.evaluate(joint) == pytest.approx(place)
    check_that_little_is_read_as_zero(plane, joint)
    click(plane, (15, 20))
    check_that_a_length_is_kept(plane, joint)
    click(plane, (15, 20))
    view.locator('.choosing [data-field="length"]').fill("0")
    view.locator('.choosing [data-field="length"]').press("Enter")
    assert view.locator('.choosing [aria-invalid="true"]').count() == 1
    view.locator('[data-field="link-name"]').fill("crank")
    view.locator('[data-field="link-name"]').press("Enter")
    assert view.evaluate(knots) == ["2", "crank", "crank-2"]
    click(plane, (15, 20))
    view.click('[data-act="remove"]')
    assert view.evaluate(knots) == ["2", "2"]
    check_that_points_and_slides_are_pulled(plane)


def test_a_joint_is_removed_with_the_links_that_only_it_held_and_letters_stay(plane):
    view = plane.page
    view.click('[data-begin="six-bar"]')
    view.locator('.drawing [data-knot="6"]').wait_for()
    names = ".drawing text.name"
    assert sorted(view.locator(names).all_text_contents()) == [*"12345", *"ABCDEFGH"]
    click(plane, view.evaluate("gruebler.views.build.drawing.knots[6].at"))  # of links 4 and 5
    view.locator(".choosing b", has_text="G: 4 – 5").wait_for()
    view.keyboard.press("Delete")
    assert sorted(view.locator(names).all_text_contents()) == [*"123", *"ABCDEFH"]
    plane.until(f"gruebler.root.querySelector('[data-place=mobility]').textContent.includes('{MOVES}')")
    view.keyboard.press("Control+z")
    assert sorted(view.locator(names).all_text_contents()) == [*"12345", *"ABCDEFGH"]
    view.evaluate("localStorage.clear()")


def test_points_are_drawn_as_their_reader_calls_them_with_what_acts_on_them(tab, server):
    """The tip of a film claw, on which the film acts with a force."""
    page = tab(locale="de-DE").open(server.address)
    view = page.page
    view.evaluate("""async () => {
        gruebler.open(await gruebler.ask("open", { id: "filmclaw" }));
        gruebler.show("build");
    }""")
    view.click('[data-begin="hand"]')
    view.locator(".drawing text.name", has_text="Spitze").wait_for()
    view.locator('[data-act="move"]').click()
    page.until("gruebler.view === 'motion' && gruebler.motion.linkage.sizes.points[0]?.name === 'Spitze'")
    document = json.loads(view.evaluate("JSON.stringify(gruebler.motion.document())"))
    forces = loads_of_document(document, linkage_from_json(document))[0].forces
    assert list(forces) == ["Spitze"]
    assert "tanh" in str(forces["Spitze"])


@pytest.mark.parametrize("machine", ["crane_cyl", "geartrain", "toggle_press"])
def test_the_machine_at_hand_is_taken_over(plane, machine):
    """Cylinder, gears, slide and double joint: where a drawing of the machine moves to is where the machine does."""
    view = plane.page
    shown = """() => {
        const { linkage } = gruebler.motion;
        return JSON.stringify([gruebler.motion.document(), linkage.drives[0], linkage.size, linkage.drive.turning]);
    }"""
    taken = """async (id) => {
        gruebler.open(await gruebler.ask("open", { id }));
        gruebler.motion.edit(() => gruebler.motion.linkage.sizes.points.push({ name: "tip", link: 1, at: [30, 40] }));
        gruebler.show("build");
    }"""
    view.evaluate(taken, machine)
    first = json.loads(view.evaluate(shown))
    if machine == "geartrain":  # its wheels are as in Motion, in the card, too
        filled = view.locator("[data-begin=hand] path.shape").evaluate_all(
            "all => all.map((one) => getComputedStyle(one).fillOpacity)"
        )
        assert filled == ["0.75", "0.75"]
    view.click('[data-begin="hand"]')
    turned = view.locator(".drawing .driven").get_attribute("transform")
    assert bool(turned) == (machine == "crane_cyl")  # along the cylinder; what turns has its arc
    assert not view.locator("[data-begin]").count()  # taken over, it is offered no more
    view.locator('[data-act="move"]').click()
    plane.until("gruebler.view === 'motion'")
    view.evaluate("gruebler.motion.transport.pause()")
    name = view.locator("h1 small").inner_text()
    view.evaluate("gruebler.motion.linkage.moveTo(gruebler.motion.linkage.model.start.drives[0])")
    second = json.loads(view.evaluate(shown))
    assert name == f"{catalog.entry(machine).name.en}, changed"
    paths = []
    for document, drive, size, turning in (first, second):
        linkage = linkage_from_json(document)
        motion = move(linkage, drive + np.linspace(0, 0.1, 5) * (1 if turning else size))
        joints = [motion.point(joint) for joint in linkage.mechanism.chain.joint_names() if joint[0] == "R"]
        turns = [motion.angle(link) - motion.angle(link)[0] for link in sorted(linkage.mechanism.chain.links)]
        paths.append((joints, turns, motion.point("tip")))
    for one, other in zip(*paths, strict=True):
        np.testing.assert_allclose(one, other, atol=1e-8)


def test_beside_its_table_a_drawing_is_low_on_a_phone_and_not_covered_by_the_tools(tab, server):
    page = tab(width=390, height=844, touch=True).open(server.address)
    page.page.click('[data-view="build"]')
    page.page.locator(".starters button").first.click()
    page.until("document.documentElement.scrollHeight > 1100")
    page.page.evaluate("scrollTo(0, 9999)")
    stage = "gruebler.root.querySelector('[data-page=build] > .stage')"
    page.until(f"scrollY > 99 && {stage}.style.getPropertyValue('--scrolled')")
    page.page.wait_for_timeout(100)
    stage, tools = (page.page.locator(f"[data-page=build] > {part}").bounding_box() for part in (".stage", ".palette"))
    assert 0 <= stage["y"] < 1
    assert stage["y"] + stage["height"] <= tools["y"] + 1


@pytest.mark.parametrize("locale", ["en-US", "de-DE"])
def test_a_phone_shows_all_beginnings_all_tools_and_all_that_is_done_with_a_joint(tab, server, locale):
    page = tab(width=390, height=844, touch=True, locale=locale).open(server.address)
    view = page.page
    view.tap('[data-view="build"]')
    view.locator("[data-begin]").first.wait_for()

    def in_sight(selector: str) -> int:
        boxes = [one.bounding_box() for one in view.locator(selector).all() if one.is_visible()]
        assert all(0 <= box["x"] < box["x"] + box["width"] <= 390 for box in boxes), selector
        return len(boxes)

    assert in_sight("[data-begin]") == 4
    assert in_sight(".starters h2") == 1
    assert in_sight("[data-tool]") == 8
    assert not in_sight(".stage:has(.drawing) .tools button")  # nothing is to be enlarged yet
    view.tap('[data-begin="six-bar"]')
    assert in_sight(".stage:has(.drawing) .tools button") == 3
    x, y = page.middle('.drawing [data-knot="2"]')
    view.touchscreen.tap(x, y)
    view.locator(".choosing b").wait_for()
    assert in_sight(".choosing button") == 3
    view.evaluate("localStorage.clear()")


def test_a_click_frames_nothing_and_keys_do(tab, server):
    page = tab().open(server.address)
    page.page.goto(server.address + "#en/build")
    page.page.reload()
    page.until("window.gruebler?.root?.querySelector('.view.shown .drawing')?.clientWidth")
    frame = "getComputedStyle(gruebler.root.querySelector('.drawing')).outlineStyle"
    x, y = page.middle(".drawing")
    page.page.mouse.click(x, y)
    assert page.page.evaluate(frame) == "none"
    page.page.keyboard.press("ArrowLeft")  # the drawing has the focus
    assert page.page.evaluate(frame) == "solid"
    page.page.evaluate("localStorage.clear()")


def test_classes_of_joints_are_indices_and_a_count_breaks_before_an_equals_sign_alone(plane):
    view = plane.page
    view.click('[data-begin="four-bar"]')
    view.locator('[data-act="move"]').wait_for()
    view.locator('[data-place="mobility"] summary').click()
    count = view.locator('[data-place="mobility"] details').inner_html()
    formula = "F\xa0=\xa03(n\xa0−\xa01)\xa0−\xa02\xa0g<sub>1</sub> \u200b=\xa03(4\xa0−\xa01)\xa0−\xa02·4\xa0=\xa01"
    assert formula.replace("\xa0", "&nbsp;") in count
    click(plane, (40, 30))  # beside bars
    view.evaluate("""() => {
        const { build } = gruebler.views;
        const more = [{ at: [30, 80], links: ["2", "4"] }, { at: [60, 90], links: ["4"] }];
        build.change({ ...build.drawing, knots: [...build.drawing.knots, ...more] });
    }""")
    offer = view.locator("[data-offer=bar]").first
    offer.wait_for()
    assert "F\xa0=\xa01" in offer.text_content()
    assert view.locator('[data-place="mobility"] details').get_attribute("open") is not None  # as it was


def test_loads_of_motion_stay_while_the_drawing_is_changed(plane):
    view = plane.page
    view.click('[data-begin="six-bar"]')
    view.locator('[data-act="move"]').click()
    plane.until("gruebler.view === 'motion'")
    forces = {"R(4-5)": ["0 N", "-7 N"], "R(2-3)": ["3 N", "0 N"]}
    view.evaluate(
        f"gruebler.motion.linkage.loads = {json.dumps({'forces': forces, 'bodies': {'2': {'mass': '2 kg'}}})}"
    )
    view.click('[data-view="build"]')
    view.keyboard.press("v")
    click(plane, view.evaluate("gruebler.views.build.drawing.knots[6].at"))
    view.keyboard.press("Delete")  # with links 4 and 5
    view.locator('[data-act="move"]').click()
    plane.until("gruebler.view === 'motion' && gruebler.motion.linkage.model.links.length === 4")
    loads = view.evaluate("gruebler.motion.linkage.loads")
    assert loads["forces"] == {"R(2-3)": ["3.0 N", "0.0 N"]}
    assert loads["bodies"]["2"]["mass"] == "2.0 kg"
    view.evaluate("localStorage.clear()")


def test_the_name_of_the_machine_at_hand_is_cut_between_words(plane):
    model = model_of(catalog.entry("crankrocker").linkage(), name="Kurbelschwinge als angenäherte Geradführung")
    plane.page.evaluate("(model) => gruebler.open(model)", model)
    plane.page.click('[data-view="build"]')
    card = plane.page.locator("[data-begin=hand]", has_text="Kurbelschwinge")
    assert card.inner_text().strip() == "Edit Kurbelschwinge als …"


def test_what_is_opened_beside_a_drawing_is_offered_and_guides_are_as_in_motion(plane):
    """A block that slides on a link is on a rod, over it; only guides of the frame are hatched."""
    view = plane.page
    opened = "async (id) => { gruebler.open(await gruebler.ask('open', { id })); gruebler.show('build'); }"
    view.click('[data-begin="four-bar"]')
    instead = view.locator('[data-place="instead"] > *')
    assert not instead.count()
    view.evaluate(opened, "walschaerts_gear")
    assert instead.all_inner_texts() == ["Edit Walschaerts valve gear instead"]
    assert not view.locator(".starters > *").count()  # it covers nothing of what is drawn
    view.click('[data-begin="hand"]')
    assert not instead.count()
    assert not view.get_by_text("Last step").count()  # to another machine leads no step
    marks = ("rail", "rail-hatch", "block")
    assert [view.locator(f".drawing path.{one}").count() for one in marks] == [2, 2, 3]
    after = "(one) => !(one.compareDocumentPosition(gruebler.root.querySelector('.drawing path.block')) & 2)"
    assert all(view.locator(".drawing path.bar").evaluate_all(f"all => all.map({after})"))
    assert "P, Q" in view.locator(".drawing text.name").all_text_contents()
    # the direction of a slide is typed beside the lengths
    assert view.locator('[data-span^="φ"]').evaluate_all("all => all.map((one) => one.value)")[0] == "0"
    view.locator('[data-span^="φ"]').first.fill("10")
    view.keyboard.press("Enter")
    assert view.evaluate("gruebler.views.build.drawing.knots.find((knot) => 'slide' in knot).slide") == 10
    view.evaluate(opened, "cam_roller")
    assert "cannot be edited here: no tool for joints like cam – roller yet" in instead.inner_text()
    view.evaluate("localStorage.clear()")


@pytest.mark.parametrize(("width", "height"), [(1440, 900), (390, 844)])
def test_a_letter_stands_nearest_to_its_own_joint(tab, server, width, height):
    view = tab(width=width, height=height).open(server.address).page
    view.evaluate("async () => gruebler.open(await gruebler.ask('open', { id: 'excavator' }))")
    view.click('[data-view="build"]')
    view.click('[data-begin="hand"]')
    found = view.evaluate("""() => {
        const { drawing, viewport } = gruebler.views.build;
        const texts = [...gruebler.root.querySelectorAll('.drawing text.name')];
        return texts.filter((one) => /^[A-Z]$/.test(one.textContent)).map((one) => [
            one.textContent,
            drawing.knots.map(({ at }) => viewport.screen(...at)).map(([x, y]) =>
                Math.hypot(x - one.getAttribute('x'), y + 4 - one.getAttribute('y'))),
        ]);
    }""")
    assert len(found) > 8
    assert [letter for letter, far in found if far.index(min(far)) != ord(letter) - ord("A")] == []
    # a piston that lies upon a plate has its name there, on a phone once it is chosen
    assert view.locator(".drawing text.name", has_text="boom piston").count() == (width > 390)


@pytest.mark.parametrize(("width", "height"), [(1440, 900), (390, 844)])
def test_a_gear_pair_has_its_radii_and_a_letter_clear_of_the_rims(tab, server, width, height):
    page = tab(width=width, height=height, locale="de-DE").open(server.address)
    page.page.click('[data-view="build"]')
    page.page.click('[data-tool="gears"]')
    click(page, (0, 0), (60, 0), (20, 0))
    boxes = page.page.locator(".drawing text.name").evaluate_all(
        """all => all.map((one) => one.getBBox()).map(({ x, y, width, height }) => [x, y, width, height])"""
    )
    texts = page.page.locator(".drawing text.name").all_text_contents()
    scale = page.page.evaluate("gruebler.views.build.viewport.scale")
    at = next(k for k, text in enumerate(texts) if text.startswith("C"))
    assert texts[at] == "C 20 : 40"
    assert page.page.get_by_text("C: Radien 20, 40 mm").count() == 1
    x, y, wide, high = boxes[at]
    for centre, radius in ((0, 20), (60, 40)):
        u, v = page.page.evaluate(f"gruebler.views.build.viewport.screen({centre}, 0)")
        far = [math.hypot(p - u, q - v) for p in (x, x + wide) for q in (y, y + high)]
        assert all(one < radius * scale for one in far) or all(one > radius * scale for one in far)
    for k, (p, q, other, tall) in enumerate(boxes):
        assert k == at or p > x + wide or p + other < x or q > y + high or q + tall < y, texts[k]
    # the ruler alone tells the scale
    assert page.page.locator(".drawing text.tick").get_by_text("mm").count() == 1


def test_no_tool_of_a_german_phone_touches_its_border(tab, server):
    page = tab(width=390, height=844, touch=True, locale="de-DE").open(server.address)
    page.page.tap('[data-view="build"]')
    gaps = page.page.locator("[data-tool]").evaluate_all(
        """all => all.map((one) => {
            const range = document.createRange();
            range.selectNodeContents(one);
            const [text, box] = [range.getBoundingClientRect(), one.getBoundingClientRect()];
            return Math.min(text.left - box.left, box.right - text.right);
        })"""
    )
    assert len(gaps) == 8
    assert min(gaps) >= 4
