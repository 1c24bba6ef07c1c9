"""Files that the page opens and saves: those of other programs, tables, films."""

import base64
import csv
import io
import json
import math
import re
from pathlib import Path

import numpy as np
import pytest

from gruebler.base.errors import GrueblerError
from gruebler.cli import main
from gruebler.files import linkage_from_json, linkage_to_json
from gruebler.files.values import write
from gruebler.mechanics.analysis import motion_table
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics import move
from gruebler.page.requests import answer
from gruebler.teaching.catalog import entries

BAR = FourBar(25, 70, 40, 70)


def test_what_is_saved_in_a_format_of_another_program_is_opened_again():
    document = linkage_to_json(BAR.linkage())
    models = {}
    listed = [kind["name"] for kind in answer("saved_kinds", {}, "en", print)]
    for kind in [*listed, "toml", "json", "dxf", "mjcf", "urdf"]:
        saved = answer("export", {"document": document, "kind": kind}, "en", print)
        assert len(base64.b64decode(saved["base64"])) > 1
        asked = {"name": f"my file{saved['ending']}", "base64": saved["base64"]}
        if kind in ("dxf", "mjcf", "urdf"):
            with pytest.raises(GrueblerError, match=f"^my file.{kind}: .* written only"):
                answer("open_file", asked, "en", print)
            continue
        opened = answer("open_file", asked, "en", print)
        if "model" in opened:
            models[kind] = opened["model"]["document"]
        else:
            assert opened["text"].count("R(") == 4
    assert {"toml", "json", "linkage2", "pmks", "pyslvs", "motiongen", "pylinkage", "four-bar-rs"} == set(models)
    for name, found in models.items():
        assert ratios(linkage_from_json(found)) == pytest.approx([1, 40 / 25, 70 / 25, 70 / 25], rel=1e-4), name


@pytest.mark.parametrize("name", ["leg.bmp", "leg.stl", "leg.gltf"])
def test_the_endings_told_for_an_unknown_file_are_those_that_can_be_opened(name):
    asked = {"name": name, "base64": base64.b64encode(b"BM").decode()}
    with pytest.raises(GrueblerError, match=f"^{name}: expected .*linkage2") as told:
        answer("open_file", asked, "en", print)
    assert len(re.findall(r"\.\w+", str(told.value))) <= 7  # the usual ones, and how many more there are
    for written_only in (".dxf", ".mjcf", ".urdf", ".glb", ".parquet"):
        assert written_only not in str(told.value)


@pytest.mark.parametrize("kind", ["toml", "json"])
def test_our_own_files_keep_what_the_page_shows_beside_a_linkage(kind, tmp_path):
    from gruebler.cli.explore import _model

    page = {"targets": [[k / 7, 0.1 * k, 30.5] for k in range(60)]}  # more points than a line of TOML may have dots
    document = linkage_to_json(BAR.linkage()) | {"page": page}
    saved = answer("export", {"document": document, "kind": kind}, "en", print)
    opened = answer("open_file", {"name": f"x.{kind}", "base64": saved["base64"]}, "en", print)
    assert opened["model"]["document"] == document
    file = tmp_path / f"x.{kind}"
    file.write_bytes(base64.b64decode(saved["base64"]))
    assert _model(str(file), "en")["document"] == document
    assert linkage_to_json(linkage_from_json(document)) == linkage_to_json(
        BAR.linkage()
    )  # the linkage has nothing of it


def ratios(linkage) -> list[float]:
    """The distances of the two pins of each link, by the shortest of them."""
    pins: dict[str, list] = {}
    for (_, link), pin in linkage.elements.items():
        pins.setdefault(link, []).append(pin)
    lengths = sorted(math.dist((one.x, one.y), (two.x, two.y)) for one, two in pins.values())
    return [length / lengths[0] for length in lengths]


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("x.toml", b"joints = 3", "x.toml"),
        ("../../etc/x.json", b"[", ".json"),
        ("no ending", b"", "no ending"),
        ("x.txt", b"R(0-1", "x.txt"),
        ("x.json", b"\xff\xfe\x00", "x.json"),
        ("...", b"", "file"),
    ],
)
def test_a_file_that_cannot_be_read_is_named_without_a_folder(name, content, words):
    asked = {"name": name, "base64": base64.b64encode(content).decode()}
    with pytest.raises(GrueblerError) as refused:
        answer("open_file", asked, "en", print)
    assert words in str(refused.value)
    assert "/tmp" not in str(refused.value)


def broken(name, change):
    """What the page says of the file of a linkage in which something is changed."""
    document = linkage_to_json(BAR.linkage())
    change(document)
    asked = {"name": name, "base64": base64.b64encode(json.dumps(document).encode()).decode()}
    with pytest.raises(GrueblerError) as refused:
        answer("open_file", asked, "en", print)
    return str(refused.value)


def test_a_wrong_file_is_told_what_is_wrong_with_it_not_which_keys_there_are():
    newer = 'This version of gruebler does not know "hinges" in the file a.json; a newer one may have written it.'
    assert broken("a.json", lambda document: document.update(hinges=1)) == newer
    assert broken("a.json", lambda document: document.pop("elements")) == (
        "The file a.json has links and joints, but no sizes."
    )
    assert broken("a.json", lambda document: document.pop("joints")) == "The file a.json has sizes, but no joints."
    assert broken("a.json", lambda document: document["elements"].pop("coupler")) == (
        "The file a.json cannot be opened: the place of R(crank-coupler) on 'coupler' is missing."
    )
    assert broken("a.json", lambda document: document["elements"].update(crank=5)) == (
        "In the file a.json, elements.crank is wrong: expected a table of joints, but found 5."
    )
    foreign = "The file a.json holds no linkage, nor a chain or points of a path."
    for other in ({"name": "a"}, [1, 2]):
        asked = {"name": "a.json", "base64": base64.b64encode(json.dumps(other).encode()).decode()}
        with pytest.raises(GrueblerError, match=f"^{foreign}$"):
            answer("open_file", asked, "en", print)
    for content, words in (
        (b"\n", "The file a.toml is empty."),
        (b"frame = 3\njoints = = 3", "cannot be read as TOML from line 2 on"),
        (b"\xff\xfe", "The file a.toml cannot be read as TOML; it is damaged or something else."),
    ):
        with pytest.raises(GrueblerError, match=words):
            answer("open_file", {"name": "a.toml", "base64": base64.b64encode(content).decode()}, "en", print)


def dropped(page, name: str, content: bytes) -> None:
    """Let a file fall on the page."""
    text = base64.b64encode(content).decode()
    page.page.evaluate(
        """([name, text]) => {
        const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
        const dataTransfer = new DataTransfer();
        dataTransfer.items.add(new File([bytes], name));
        gruebler.host.dispatchEvent(new DragEvent("drop", { dataTransfer, cancelable: true }));
        }""",
        [name, text],
    )


def test_what_is_saved_is_told_between_title_and_cross_on_a_phone(tab, server):
    view = tab(width=390, height=844, locale="de-DE", touch=True).open(server.address).page
    view.click('[data-icon="save"]')
    with view.expect_download():
        view.locator('dialog button:text-is("JSON")').click()
    places = "one => [...one.querySelectorAll('h2, .told, .quiet')].map((e) => e.getBoundingClientRect().toJSON())"
    title, told, cross = view.locator(".sheet-head").evaluate(places)
    assert title["right"] <= told["left"] < told["right"] <= cross["left"]
    assert told["width"] > 100


SIZE_BELOW_TITLE = "(one) => one.querySelector('h2').checkVisibility() && [one.offsetWidth, one.offsetHeight]"


def test_a_file_of_another_program_is_dropped_and_saved_as_dxf(tab, server, tmp_path):
    path = write(BAR.linkage(), tmp_path / "leg.linkage2", left_out=[])
    page = tab(locale="de-DE").open(server.address)
    chosen = page.page.locator('[data-view="motion"]')
    place = chosen.bounding_box()
    dropped(page, path.name, path.read_bytes())
    page.until("gruebler.motion.linkage.model.name === 'leg'")
    assert chosen.bounding_box() == place  # whatever the name
    lengths = page.page.evaluate("gruebler.motion.dragging.lengths().map((one) => one.value)")
    assert sorted(lengths)[-4:] == pytest.approx([25, 40, 70, 70], abs=1e-3)
    # it plays; with the crank on the frame the end of the rocker is at x = 25 + (45² + 70² - 40²)/90 = 84.17, by hand,
    # and the rocker at arccos((84.17 - 70)/40) = 69.26° from its pivot to that end
    page.until("gruebler.motion.linkage.drives[0] !== gruebler.motion.linkage.model.start.drives[0]")
    page.page.evaluate("gruebler.motion.transport.pick(0)")
    assert page.page.locator('[data-panel="measures"] dd').first.text_content().strip() == "69,26°"
    panel = page.page.locator('[data-panel="export"]')
    page.page.locator('[data-icon="save"]').click()
    assert [title.split()[0] for title in panel.locator("[data-group] b").all_text_contents()] == [
        *("Hier", "Für", "Bild", "Bewegtes", "Zeichnung", "Simulation", "Daten", "Andere")  # by purpose
    ]
    buttons = panel.locator("[data-group] button").all_text_contents()
    assert buttons == [
        *("JSON", "TOML", "Link kopieren", "HTML", "PNG", "SVG", "PDF", "Video", "GIF", "DXF", "MuJoCo", "URDF", "CSV"),
        "Speichern",
    ]
    assert "1 : 1, mm" in panel.inner_text()
    assert (
        panel.locator("[data-group] b").evaluate_all("all => all.map((one) => one.getClientRects().length)") == [1] * 8
    )
    title = panel.locator("h2").evaluate("(one) => one.getBoundingClientRect().bottom")
    assert panel.locator("[data-group]").first.bounding_box()["y"] < title + 20  # no room is kept for what is said
    panel.locator('[data-field="kind"] option[value="pmks"]').wait_for(state="attached")
    sized = panel.evaluate(SIZE_BELOW_TITLE)
    kinds = panel.locator('[data-field="kind"] option').all_text_contents()
    assert len({*kinds, *buttons}) == len(kinds) + len(buttons)  # each once
    assert not [kind for kind in kinds if "DXF" in kind or "gruebler, JSON" in kind]
    with page.page.expect_download() as saved:
        panel.locator('button:text-is("DXF")').click()
    assert saved.value.suggested_filename == "leg.dxf"
    saved.value.save_as(tmp_path / "leg.dxf")
    ezdxf = pytest.importorskip("ezdxf", reason="drawings are audited with ezdxf")
    assert not ezdxf.readfile(tmp_path / "leg.dxf").audit().errors
    told = panel.get_by_role("status").inner_text()
    # it stands beside the title, and makes the sheet no wider
    assert panel.evaluate(SIZE_BELOW_TITLE) == sized
    assert re.fullmatch(r"Gespeichert: leg.dxf. Nicht übernommen: Antriebe(; [^;]*Abtrieb[^;]*)?", told.strip())
    # a chain goes to its view, points to that of the synthesis, rubbish nowhere
    dropped(page, "chain.txt", b"R(0-1) R(1-2) R(2-3) R(3-4) R(4-0)")
    page.page.locator('[data-page="structure"] [data-fact="counted"]:text-is("F = 2")').wait_for()
    points = "x,y,order\n0,0,1\n10,5,2\n20,8,2\n30,5,3\n40,0,\n"
    dropped(page, "path.csv", points.encode())
    page.until("gruebler.views.synthesis?.points.length === 5")
    assert page.page.locator('[data-field="order"]').input_value() == "1 2 2 3 –"
    dropped(page, "leg.xyz", b"?")
    page.page.locator(".message", has_text="leg.xyz").wait_for()


def test_the_sheet_says_what_is_saved_and_which_format_opens_here_again(tab, server):
    """Also over a view that shows something else than the machine."""
    page = tab().open(server.address)
    page.page.click('[data-view="exercises"]')
    page.page.click('[data-icon="save"]')
    panel = page.page.locator('[data-panel="export"]')
    assert panel.locator("h2").inner_text() == f"Save: {page.page.evaluate('gruebler.motion.linkage.title')}"
    assert panel.locator("button.key").all_text_contents() == ["JSON"]
    wide = panel.bounding_box()["width"]
    panel.locator('[data-field="kind"] option').first.wait_for(state="attached")
    assert panel.bounding_box()["width"] == wide


@pytest.mark.parametrize("lang", ["en", "de"])
def test_the_table_of_the_page_is_that_of_the_library_from_0_on(tab, server, lang, tmp_path):
    """Whatever pose is shown; by the library's own solver. A German spreadsheet has semicolons and decimal commas."""
    page = tab(locale=lang).open(server.address)
    page.page.evaluate("gruebler.motion.transport.pick(1)")
    page.page.locator('[data-icon="save"]').click()
    with page.page.expect_download() as saved:
        page.page.locator('[data-panel="export"] button:text-is("CSV")').click()
    saved.value.save_as(tmp_path / "table.csv")
    text = (tmp_path / "table.csv").read_text(encoding="utf-8")
    assert text.startswith("\ufeff") == (lang == "de")
    head, *rows = csv.reader(io.StringIO(text.removeprefix("\ufeff")), delimiter=";" if lang == "de" else ",")
    linkage = entries()["crankrocker"].in_language(lang).linkage()
    (rocker,) = linkage.outputs
    motion = move(linkage, np.radians(range(360)), speed=1.0, order=2)
    wanted = motion_table(motion, transmission=rocker, lang=lang)
    angle = {"en": "Transmission angle μ [°]", "de": "Übertragungswinkel μ [°]"}[lang]
    assert head == [*[column.header for column in wanted][:-1], angle]
    found = np.array([[float(cell.replace(",", ".")) for cell in row] for row in rows])
    expected = np.stack([column.values for column in wanted], axis=1)
    assert found == pytest.approx(expected, rel=1e-5, abs=1e-5)


def test_the_drive_of_a_drawn_four_bar_comes_back_from_another_program():
    """Linkage has inputs: a crank on the frame, which the reader finds again."""
    drawn = {
        "unit": "mm",
        "joints": "R(Gestell-1) R(1-2) R(2-3) R(Gestell-3)",
        "frame": "Gestell",
        "drives": ["R(Gestell-1)"],
        "places": {"R(Gestell-1)": [0, 0], "R(1-2)": [0, 25], "R(2-3)": [60, 45], "R(Gestell-3)": [70, 0]},
    }
    saved = answer("export", {"document": drawn, "kind": "linkage2"}, "de", print)
    opened = answer("open_file", {"name": "bar.linkage2", "base64": saved["base64"]}, "de", print)
    assert (saved["note"], opened["note"]) == ("", "")
    assert [drive["name"] for drive in opened["model"]["drives"]] == ["R(frame-1)"]


def test_loads_and_speed_of_another_program_act_on_the_page():
    """The punch press of PMKS+: 10/min, 2 g and 3 g, 400 N up on the end of its rod, as its address says
    (tests/files/test_other_programs.py); the torque by the way of that end, as virtual work has it."""
    content = (Path(__file__).parents[1] / "files" / "samples" / "punch-press.pmks").read_bytes()
    asked = {"name": "press.pmks", "base64": base64.b64encode(content).decode()}
    opened = answer("open_file", asked, "en", print)
    assert opened["note"] == "Left out: colours; the sense of rotation of the drive"
    told = answer("forces", {"document": opened["model"]["document"], "drives": [1.0]}, "en", print)
    assert sorted(told["masses"])[-2:] == pytest.approx([0.002, 0.003])
    assert told["speed"] == pytest.approx(10 * 2 * math.pi / 60)
    assert told["facts"]
    linkage = linkage_from_json({key: value for key, value in opened["model"]["document"].items() if key != "loads"})
    drives = np.array(told["drives"])
    step = 1e-5
    ends = [move(linkage, drives + side * step).point(linkage.mechanism.chain.joint_names()[2]) for side in (1, -1)]
    wanted = -4 * (ends[0] - ends[1])[:, 1] / (2 * step)  # in N·m, the press is in cm
    assert told["effort"] == pytest.approx(wanted.tolist(), abs=1e-3 * abs(wanted).max())


def test_a_file_that_is_dropped_is_said_to_be_opened_at_once(tab, server):
    """The library may still start, or be busy."""
    page = tab().open(server.address)
    page.hold()
    dropped(page, "chain.txt", b"R(0-1) R(1-2) R(2-3) R(3-4) R(4-0)")
    page.page.locator(".message.done", has_text="Opening chain.txt").wait_for()
    page.until("held.length > 0")
    page.page.evaluate("() => { delete gruebler.model.send; held.forEach((one) => gruebler.model.send(one)); }")
    page.page.locator('[data-page="structure"] [data-fact="counted"]:text-is("F = 2")').wait_for()
    assert page.page.evaluate("gruebler.message.hidden")


def test_the_single_file_opens_its_own_document_and_records_a_film(tab, tmp_path):
    path = tmp_path / "bar.html"
    assert main(["explore", "four-bar:25,70,40,70", "-o", str(path)]) == 0
    page = tab().open(path.as_uri())
    other = FourBar(25, 70, 45, 70).linkage()
    other = other.with_reference_pose(move(other, [1.0]).pose())
    dropped(page, "other.json", json.dumps(linkage_to_json(other)).encode())
    page.until("gruebler.motion.dragging.lengths().some((one) => Math.abs(one.value - 45) < 1e-9)")
    dropped(page, "x.linkage2", b"<linkage2/>")
    page.until("gruebler.message.textContent.includes('gruebler explore FILE')")
    page.page.locator('[data-icon="save"]').click()
    page.page.evaluate("gruebler.motion.transport.speed = 60")  # a second
    page.page.locator('[data-panel="export"] select').select_option("640")
    drive = page.page.evaluate("gruebler.motion.linkage.drives[0]")
    assert not page.page.evaluate("gruebler.motion.transport.player.playing")
    with page.page.expect_download(timeout=30_000) as saved:
        page.page.locator('[data-panel="export"] button:text-is("Video")').click()
    saved.value.save_as(tmp_path / "film.webm")
    assert (tmp_path / "film.webm").read_bytes().startswith(b"\x1a\x45\xdf\xa3")  # EBML, the container of WebM
    assert (tmp_path / "film.webm").stat().st_size > 5_000
    assert page.page.evaluate("gruebler.motion.linkage.drives[0]") == drive  # it stands where it stood
    assert not page.page.evaluate("gruebler.motion.transport.player.playing")
    page.page.evaluate("gruebler.motion.transport.toggle()")
    with page.page.expect_download(timeout=30_000):
        page.page.locator('[data-panel="export"] button:text-is("Video")').click()
    assert page.page.evaluate("gruebler.motion.transport.player.playing")  # it goes on
