"""The static site: what a server answers stands in its files, from a server of files and from the disk alone."""

import base64
import gzip
import http.server
import json
import re
import threading
from functools import partial

import numpy as np
import pytest

from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics import move
from gruebler.page.model import model_of
from gruebler.page.page import module_text
from gruebler.page.requests import answer
from gruebler.page.site_structures import structure_pack
from gruebler.page.static_site import FileGroup, write_site
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry
from gruebler.teaching.exercises import exercise

GROUPS = [
    FileGroup("chains", (4, 1)),
    FileGroup("chains", (6, 1)),  # with which the view begins
    FileGroup("chains", (7, 2)),
    FileGroup("structures", (4, 1, 0)),
    FileGroup("machine", ("crankrocker",)),
    FileGroup("machine", ("universal_joint",)),
    FileGroup("catalog", ("bennett", "crankrocker", "lambda")),
    FileGroup("tasks", ("grashof", 1, 1)),
    FileGroup("tasks", ("mobility", 1, 1)),
    FileGroup("tasks", ("universal-joint", 1, 1)),
    FileGroup("common"),
    FileGroup("points"),
]


def nothing(_):
    return None


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    made = tmp_path_factory.mktemp("site")
    record = entry("crankrocker")
    size = write_site(made, model_of(record.linkage(), name=record.name, source=record.id), groups=GROUPS)
    assert size == sum(path.stat().st_size for path in made.rglob("*") if path.is_file())
    return made


@pytest.fixture(scope="module")
def address(folder):
    class Quiet(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *_):
            pass

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=folder))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}/"
    server.shutdown()
    server.server_close()


def content(folder, name):
    text = (folder / "data" / f"{name}.js").read_text(encoding="ascii")
    return json.loads(gzip.decompress(base64.b64decode(text.split('"')[3])))


def plain(found):
    """An answer as it is sent."""
    return json.loads(json.dumps(found))


def asked(page, method, params, lang="en"):
    """What the site answers to a request of the page."""
    return page.page.evaluate("([m, p, l]) => gruebler.backend.ask(m, p, l)", [method, params, lang])


def test_a_folder_with_other_things_is_refused(tmp_path):
    from gruebler.base.errors import GrueblerError

    (tmp_path / "thesis.tex").write_text("years of work", encoding="utf-8")
    with pytest.raises(GrueblerError, match="holds something else"):
        write_site(tmp_path, {"name": ""}, groups=[])
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.tex"]


def test_the_site_answers_as_the_library_does(tab, folder, address):
    page = tab().open(address)
    assert "<animate" in asked(page, "moving", {"id": "universal_joint"})["picture"]  # of a card in space
    for lang in ("en", "de"):
        chains = asked(page, "chains", {"links": 4, "mobility": 1, "start": 0}, lang)
        assert [item["text"] for item in chains["items"]] == ["R(1-2) R(2-3) R(3-4) R(4-1)"]
        for assortment in (None, [5, 2], [6, 0, 1], [7]):
            params = {"links": 7, "mobility": 2, "start": 0, "assortment": assortment}
            of_site, of_library = (
                found | {"items": [item | {"picture": ""} for item in found["items"]]}
                for found in (asked(page, "chains", params, lang), plain(answer("chains", params, lang, nothing)))
            )
            assert of_site == of_library
        for text in ("R(1-2) R(2-3) R(3-4) R(4-1)", "R(1-2) R(2-3) R(3-4) R(4-1); frame=1; drive=R(1-2)"):
            of_site = asked(page, "structure", {"text": text}, lang)
            of_library = answer("structure", {"text": text}, lang, nothing)
            for key in (
                "code",
                "size",
                "name",
                "kinds",
                "text",
                "chosen",
                "driver",
                "frame",
                "counted",
                "generic",
                "verdict",
                "lines",
                "drives",
            ):
                assert of_site[key] == of_library[key], (key, lang)
            for key in ("inversions", "driven"):
                for one, other in zip(of_site[key], of_library[key], strict=True):
                    assert {k: v for k, v in one.items() if k != "picture"} == {
                        k: v for k, v in other.items() if k != "picture"
                    }
            for one, other in zip(of_site["joints"], of_library["joints"], strict=True):
                chains_alone = [kind | {"text": kind["text"].partition(";")[0]} for kind in other["types"]]
                assert one["types"] == chains_alone
            assert [j["name"] for j in of_site["joints"]] == [j["name"] for j in of_library["joints"]]
        for params in (
            {},
            {"words": "Kurbel four-BAR"},
            {"words": "viergelenk Lámbda"},
            {"words": "crank"},
            {"pairs": "G"},
            {"links": 4},
            {"joints": "R:4,P:0"},
            {"ternary": 1},
        ):
            of_library = answer("catalog", params, lang, nothing)
            here = [one for one in of_library if one["id"] in ("crankrocker", "bennett", "lambda")]
            assert asked(page, "catalog", params, lang) == here, params
    assert asked(page, "open", {"id": "crankrocker"}) == json.loads(
        json.dumps(answer("open", {"id": "crankrocker"}, "en", nothing))
    )
    moved = asked(page, "realise", {"text": "R(1-2) R(2-3) R(3-4) R(4-1); frame=1; drive=R(1-2)"})
    assert moved["links"][:4] == ["frame", "crank", "coupler", "rocker"]
    assert moved["linkNames"]["de"][:4] == ["Gestell", "Kurbel", "Koppel", "Schwinge"]
    six = "R(0-1) R(1-2) R(2-3) R(0-3) R(3-4) R(4-5) R(0-5); frame=0; drive=R(0-1)"
    of_library = answer("realise", {"text": six}, "de", nothing)
    assert of_library["linkNames"]["de"][:6] == [
        "Gestell",
        "Kurbel",
        "Koppel1",
        "Schwinge1",
        "Koppel2",
        "Schwinge2",
    ]


ANSWERS = [
    "1",
    "7,5",
    "75",
    "75.0",
    "7.5 cm",
    "0,0751 m",
    "75,04",
    "76",
    "-75",
    "150",
    "37.5",
    "750",
    "75 kg",
    "many",
    "4",
]


def test_answers_are_marked_as_the_library_marks_them(tab, folder, address):
    page = tab().open(address)
    for kind, level in (("grashof", 1), ("mobility", 1)):
        for task in content(folder, f"tasks-{kind}-{level}")["tasks"]:
            given = {one["key"]: one["choices"] for one in task["records"]["de"]["asked"]}
            for k, text in enumerate(ANSWERS):
                answers = {key: words[k % len(words)] if words else text for key, words in given.items()}
                params = {"id": task["records"]["de"]["id"], "answers": answers}
                expected = answer("mark", params, "de", nothing)
                found = asked(page, "mark", params, "de")
                assert found["solution"] == expected["solution"]
                for one, other in zip(found["marks"], expected["marks"], strict=True):
                    assert one["mark"] == other["mark"], (one, other)
                    if not other["hint"].startswith("Erwartet"):  # of what is no number, in the language of the page
                        assert one["hint"] == other["hint"]


def test_a_task_is_solved_and_tried_on_a_phone_from_the_disk(tab, folder):
    """Its chain has other names of links than those of the lists: it is shown nevertheless."""
    page = tab(width=390, height=844, locale="de-DE", touch=True).open((folder / "index.html").as_uri())
    view = page.page
    view.tap('[data-view="exercises"]')
    view.locator("[data-answer]").first.wait_for()
    given = exercise("mobility-1-1").given["chain"]
    joints = re.findall(r"(\w+)\(([^)]*)\)", given)
    links = {link for _, names in joints for link in names.split("-")}
    freedoms = {"R": 1, "P": 1, "G": 2}
    counts = [(freedoms[sign], len(names.split("-")) - 1) for sign, names in joints]
    right = {
        "n": len(links),
        "g1": sum(count for f, count in counts if f == 1),
        "g2": sum(count for f, count in counts if f == 2),
        "F": 3 * (len(links) - 1) - sum((3 - f) * count for f, count in counts),
    }
    view.fill('[data-answer="F"]', "7")
    view.tap('[data-act="mark"]')
    assert view.locator("#hint-F").inner_text()
    for key, value in right.items():
        view.fill(f'[data-answer="{key}"]', str(value))
    view.tap('[data-act="mark"]')
    page.until("gruebler.views.exercises.record.get('mobility-1-1')")
    assert view.locator('[data-mark="right"]').count() == len(right)
    assert view.evaluate("document.documentElement.scrollWidth") == 390
    view.tap('[data-act="try"]')
    page.until("gruebler.view === 'structure'")
    view.locator('[data-fact="counted"]').wait_for()
    assert view.locator('[data-fact="counted"]').inner_text().endswith(str(right["F"]))
    assert "".join(view.locator('[data-page="structure"] .error').all_inner_texts()) == ""
    # a task in space has nothing that moves in the plane: it offers no trial
    view.tap('[data-view="exercises"]')
    view.locator('[data-value="universal-joint"]').tap()
    page.until("gruebler.views.exercises.task.id.startsWith('universal-joint')")
    view.locator("input[data-answer]").first.fill("1")
    view.tap('[data-act="mark"]')
    view.locator("[data-result]").wait_for()
    assert view.locator('[data-act="try"]').count() == 0


def test_a_link_made_there_opens_there_for_everyone(tab, address):
    page = tab().open(address)
    page.page.click('[data-view="structure"]')
    links = page.page.locator('[data-page="structure"]').get_by_label("Links", exact=True)
    links.fill("4")
    links.press("Enter")
    page.page.locator("[data-chain]", has_text="Your machine: 4").wait_for()
    page.page.evaluate("gruebler.describe('R(1-2) R(2-3) R(3-4) R(4-1)')")
    page.until("gruebler.views.structure.structure?.text.startsWith('R(1-2)')")
    page.page.click('[data-list="driven"] .card')
    page.page.click('[data-act="realise"]')
    page.until("gruebler.shown.name.startsWith('four-bar linkage')")
    page.page.evaluate("gruebler.motion.transport.toggle(), gruebler.share()")  # what runs stands still
    link = page.until("location.hash.length > 200 && location.href")
    other = tab().open(address + "#" + link.partition("#")[2])
    other.until("gruebler.shown.name.startsWith('four-bar linkage')")
    places = "gruebler.motion.linkage.jointAt(2).map((value) => value.toFixed(6))"
    assert other.page.evaluate(places) == page.page.evaluate(places)


def test_the_disk_alone_is_enough_and_the_rest_says_how(tab, folder):
    page = tab(locale="de-DE").open((folder / "index.html").as_uri())
    page.page.click('[data-view="catalog"]')
    page.until("gruebler.root.querySelectorAll('[data-page=catalog] .card svg').length === 3")
    page.page.click('.card[data-id="crankrocker"]')
    page.until("gruebler.view === 'motion'")
    page.page.click('[data-view="structure"]')
    assert page.page.locator('[data-fact="generic"]').text_content() == "F = 1"
    page.page.click('[data-view="build"]')
    assert "gruebler explore" in page.page.locator('[data-page="build"]').text_content()
    page.page.click('[data-view="synthesis"]')
    note = page.page.locator('[data-page="synthesis"] p.note', has_text="gruebler explore")
    assert (
        note.text_content()
        == "Hier werden Viergelenkgetriebe durch neun Punkte gesucht; für alles andere: gruebler explore"
    )
    page.page.click('[data-view="structure"]')
    page.page.evaluate("gruebler.describe('R(a-b) P(b-c) R(c-a)')")
    assert 'gruebler explore "R(a-b)' in page.page.locator('[data-page="structure"] .error').text_content()


KNOWN = FourBar(25, 70, 40, 70).linkage({"P": (45, 40)})
ROWS = move(KNOWN, np.radians([10.0, 45, 80, 120, 155, 195, 240, 280, 330])).point("P").tolist()


def searching(page, rows=ROWS):
    page.page.click('[data-view="synthesis"]')
    page.page.evaluate("(rows) => gruebler.views.synthesis.take(rows, false)", rows)
    page.page.click('[data-act="synthesise"]')


@pytest.mark.parametrize("from_disk", [False, True])
def test_nine_points_are_met_without_python(tab, folder, address, from_disk):
    page = tab().open((folder / "index.html").as_uri() if from_disk else address)
    assert not any("points" in url for url in page.requests)  # what it takes is loaded when it is asked for
    page.page.click('[data-view="synthesis"]')
    page.page.evaluate("(rows) => gruebler.views.synthesis.take(rows, false)", ROWS[:5])
    set_already = page.page.locator('[data-fact="set"]')
    assert set_already.text_content() == "5 set, at least 9 needed"
    assert page.page.locator('[data-act="synthesise"]').is_disabled()
    page.page.evaluate("(rows) => gruebler.views.synthesis.take(rows, false)", ROWS)
    assert set_already.text_content() == ""
    searching(page)
    page.until("gruebler.views.synthesis.status.textContent.includes('of 1442 solutions followed')", 60)
    page.until("gruebler.root.querySelectorAll('[data-page=synthesis] .card svg .gr-curve').length === 4", 120)
    assert "Of the 1442 solutions of nine points" in page.page.locator('[data-page="synthesis"]').text_content()
    cards = page.page.locator('[data-page="synthesis"] .card')
    assert cards.locator("b").all_text_contents() == [f"Four-bar {number}" for number in (1, 2, 3, 4)]
    assert (
        "frame70.00crank25.00coupler70.00rocker40.00\xa0mm" in cards.locator(".lengths").all_text_contents()
    )  # that of the points
    assert "All meet the targets exactly." in page.page.locator(".designs").inner_text()
    cards.first.click()
    page.until("gruebler.view === 'motion'")
    assert page.page.evaluate("gruebler.shown.name") == "Points: Four-bar 1"
    assert page.page.evaluate("gruebler.motion.linkage.cycle.full")
    # the curve on the stage passes through all nine
    curve = page.page.evaluate(
        """() => { const { linkage } = gruebler.motion, { link, at } = linkage.sizes.points[0];
        return Array.from({ length: 3600 }, (_, k) => { linkage.moveTo(k * Math.PI / 1800);
          const [c, s] = linkage.pose.turns.slice(2 * link), [x, y] = linkage.pose.places.slice(2 * link);
          return [x + c * at[0] - s * at[1], y + s * at[0] + c * at[1]]; }); }"""
    )
    for row in ROWS:
        assert np.hypot(*(np.array(curve) - row).T).min() < 0.1
    if from_disk:
        return
    page.page.evaluate("gruebler.motion.transport.toggle(), gruebler.share()")  # what runs stands still
    link = page.until("location.hash.length > 200 && location.href")
    other = tab().open(address + "#" + link.partition("#")[2])
    other.until("gruebler.shown.name === 'Points: Four-bar 1'")


def test_the_search_for_nine_points_can_be_cancelled_and_says_what_it_does_not_do(tab, address):
    page = tab(locale="de-DE").open(address)
    searching(page)
    page.page.click('[data-act="cancel"]')
    page.until("gruebler.views.synthesis.status.textContent === 'Abgebrochen.'")
    searching(page, [[float(k), 0.5 * k] for k in range(9)])
    page.until("gruebler.message.textContent.startsWith('9 der Punkte liegen auf einer Geraden')", 60)
    searching(page, [*ROWS, (0.0, 0.0)])
    page.until("gruebler.message.textContent.includes('gruebler explore')")


def test_frames_and_drives_are_drawn_in_one_picture(folder):
    pack = structure_pack(Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(1-4) R(4-5) R(5-2)"), ["en"])
    assert [frame["text"][-1] for frame in pack["frames"] if frame["listed"]] == ["0", "1"]  # Watt: two inversions
    assert all(min(at) > 0 for frame in pack["frames"] for at in frame["at"])
    assert all("gr-drive" in arrow for _, _, arrow, *_ in pack["driven"])
    assert len(module_text("site")) < 9_000
    assert len(module_text("points")) < 110_000
