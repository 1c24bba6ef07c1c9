"""The structure view tells higher pairs apart: gears, belts, cams, Geneva drives have pictures of their own."""

import re
from itertools import islice

import pytest

from gruebler.base.errors import GrueblerError
from gruebler.files import linkage_to_json
from gruebler.files.screws import screws_to_json
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.screws.mobility_report import freedoms
from gruebler.page.requests import answer
from gruebler.page.site_structures import structure_pack
from gruebler.page.structures import listed_chains, structure_record
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entries

MACHINES = ("geartrain", "belt", "cam", "geneva")


def test_pictures_of_higher_pairs_differ():
    linkages = {id: entries()[id].linkage() for id in MACHINES}
    same = "R(frame-a) R(frame-b) G(a-b); frame=frame; drive=R(frame-a)"
    bare = {structure_record(same, "en")["picture"]}
    pictures = set(bare)
    for linkage in linkages.values():
        asked = {"text": linkage.mechanism.text(), "document": linkage_to_json(linkage)}
        found = answer("structure", asked, "en", print)
        pictures.add(found["picture"])
        assert any(
            each["picture"] != structure_record(asked["text"], "en")["inversions"][0]["picture"]
            for each in found["inversions"]
        )
    assert len(pictures) == len(MACHINES) + 1


def test_drives_are_arrows_over_the_picture_of_their_frame():
    """Six links of Watt's chain: a picture that takes account of the drive may be the mirrored one."""
    chain = "R(0-1) R(1-2) R(2-3) R(3-0) R(1-4) R(4-5) R(5-2)"
    frames = {each["frame"]: each["picture"] for each in structure_record(chain, "en")["inversions"]}
    driven = [each for frame in frames for each in structure_record(f"{chain}; frame={frame}", "en")["driven"]]
    assert len(driven) == 4
    for each in driven:
        assert re.sub(r"<g transform.*?</g>", "", each["picture"], flags=re.DOTALL) == frames[each["frame"]]
        assert each["picture"] != frames[each["frame"]]


def test_the_frame_and_drive_that_are_chosen_are_those_of_the_list_that_are_like_them():
    """A four-bar has one frame and one drive but for symmetry: whatever is chosen, or nothing, is marked on them."""
    chain = "R(0-1) R(1-2) R(2-3) R(3-0)"
    for rest in ("", "; frame=2", "; frame=3; drive=R(2-3)"):
        record = structure_record(chain + rest, "en")
        assert (record["chosen"], record["driver"]) == ("0", f"{chain}; frame=0; drive=R(0-1)")
        assert record["drives"] == "Mobility 1 and one drive: the motion is determined."
    assert structure_record(f"{chain}; frame=0; drive=R(1-2)", "en")["driver"] == ""  # not at the frame


@pytest.mark.parametrize("id", ["excavator", "crane_cyl", "e3_watt"])
def test_the_drives_of_a_machine_stand_first(id):
    """Those of an excavator are the 70th of its list or so, those of a crane are not at the frame."""
    linkage = entries()[id].placed()
    text = linkage.mechanism.text()
    names = {link: link for link in linkage.mechanism.chain.links}
    record = answer("structure", {"text": text, "document": linkage_to_json(linkage), "names": names}, "en", print)
    first = record["driven"][0]
    assert first["text"] == record["driver"]
    assert Mechanism.parse(first["text"]).code() == linkage.mechanism.code()
    assert record["anywhere"] == (id == "excavator")
    (_, _, _, said, listed), *_ = structure_pack(linkage.mechanism, ["en"], called=names)["driven"]
    assert (listed, said["en"][0]) == (first["text"], first["drives"])
    if id == "excavator":
        assert first["brief"] == ["P(5-6)", "P(7-8)", "P(9-10)"]


def test_all_frames_of_a_chain_are_drawn_alike():
    """Each joint is in one place whatever link is the frame."""
    for chain in islice(listed_chains(8, 1), 3, 6):
        places = set()
        for frame in chain.links:
            at = [joint["at"] for joint in structure_record(f"{chain.text()}; frame={frame}", "en")["joints"]]
            places.add(tuple((round(x - at[0][0]), round(y - at[0][1])) for x, y in at))
        assert len(places) == 1


def test_a_text_has_the_letters_of_the_language_and_its_marks_end_with_their_lines():
    text = "R(0-1) R(1-2) R(2-3) R(3-0); frame=0\ndrive=R(0-1)"
    assert structure_record(text, "de")["read"] == "D(0-1) D(1-2) D(2-3) D(3-0); frame=0; drive=D(0-1)"
    with pytest.raises(GrueblerError, match="'hello' is not a mark of a mechanism"):
        structure_record(f"{text}\nhello", "en")


def test_frames_with_numbers_are_in_their_order():
    """Of the third chain of eight links the links are met in the order 1, 2, 4, 5, 8, 3 (a text as the list has it)."""
    for chain in islice(listed_chains(8, 1), 7):
        frames = [int(each["frame"]) for each in structure_record(chain.text(), "en")["inversions"]]
        assert frames == sorted(frames)
    named = "R(b-a) R(a-2) R(2-1) R(1-b)"
    assert [each["frame"] for each in structure_record(named, "en")["inversions"]] == ["b"]  # all are alike


@pytest.mark.parametrize(
    ("id", "generic", "own", "why"),
    [
        # Bennett 1903: opposite links of one length and one twist, in one ratio: one freedom, where Grübler has -2
        ("bennett", 0, 1, "Bennett's linkage: opposite links are equal"),
        # a parallel crank more than a parallelogram needs (Grübler: 0)
        ("toolbox2", 0, 1, "equal and parallel cranks between lever 1 and lever 2"),
        # two planets of a differential where one would do: two freedoms, for two drives
        ("diff2p", 1, 2, "equal wheels on one carrier"),
    ],
)
def test_sizes_that_give_another_mobility_are_told(id, generic, own, why):
    linkage = entries()[id].placed()
    document = screws_to_json(linkage) if isinstance(linkage, SpatialLinkage) else linkage_to_json(linkage)
    text = linkage.mechanism.text()
    record = answer("structure", {"text": text, "document": document}, "en", print)
    assert (record["generic"], record["own"]) == (generic, own)
    assert f"the mobility is {own}, not {generic}" in record["drives"]
    assert why in record["drives"]
    assert record["drives"].endswith(
        "Mobility 1 and one drive: the motion is determined."
        if own == 1
        else "Mobility 2 and 2 drives: the motion is determined."
    )
    bare = answer("structure", {"text": text}, "en", print)
    assert bare["own"] is None
    if generic == 0:  # of the chain alone, it is so at almost all sizes
        assert "cannot be driven: at almost all sizes it does not move." in bare["drives"]
        assert "none of the joints can move." in [line.split(": ")[-1] for line in bare["lines"]]


PENTAGON = "R(0-1) R(1-2) R(2-3) R(3-4) R(4-0)"
HEXAGON = "R(0-1) R(1-2) R(2-3) R(3-4) R(4-5) R(5-0)"
FOUR_BAR_AND_PENTAGON = "R(0-1) R(1-2) R(2-3) R(3-0) R(0-4) R(4-5) R(5-6) R(6-7) R(7-0)"


@pytest.mark.parametrize(
    ("chain", "at_frame", "drives"),
    [
        # two freedoms take two drives; a link of a pentagon has two joints
        (PENTAGON, True, ["R(0-1), R(4-0)"]),
        (PENTAGON, False, None),
        # three freedoms, and two joints at each link: the third drive is anywhere
        (HEXAGON, True, None),
        # a drive in the loop of four links, two in that of five
        (FOUR_BAR_AND_PENTAGON, True, ["R(0-1), R(0-4), R(7-0)"]),
    ],
)
def test_as_many_drives_are_chosen_together_as_there_are_freedoms(chain, at_frame, drives):
    record = structure_record(chain, "en", at_frame=at_frame)
    found = [", ".join(each["drives"]) for each in record["driven"]]
    if drives is not None:
        assert found == drives
    assert record["driver"] in [each["text"] for each in record["driven"]]  # which is the one without a choice
    assert {len(each["drives"]) for each in record["driven"]} == {record["generic"]}
    for each in record["driven"]:
        chosen = structure_record(each["text"], "en")
        assert chosen["drives"].endswith("drives: the motion is determined.")
        assert chosen["frame"] == record["chosen"]


def test_pairs_of_drives_are_listed_once_but_for_symmetry():
    """Pentagon: of the 10 pairs two are their own mirror image (both at the frame, both next to those), so 6."""
    assert len(structure_record(PENTAGON, "en", at_frame=False)["driven"]) == 6
    # hexagon: 20 triples; mirrored in the line through the middle of the frame 3 pairs of joints change places: none
    # of the triples is its own image
    assert len(structure_record(HEXAGON, "en", at_frame=False)["driven"]) == 10


def test_drives_are_listed_of_the_chosen_frame():
    """The Stephenson chain has three frames; before, those of all stood in one list that ended somewhere."""
    chain = "R(0-1) R(1-2) R(2-3) R(3-0) R(0-4) R(4-5) R(5-2)"
    for frame in "014":
        record = structure_record(f"{chain}; frame={frame}", "en")
        assert {each["frame"] for each in record["driven"]} == {frame} == {record["chosen"]}
        # said of the drive that is shown, too, where the text has none
        assert record["drives"] == "Mobility 1 and one drive: the motion is determined."


@pytest.mark.parametrize(("lang", "said"), [("en", ["", "double-slide"]), ("de", ["S2", "Doppelschubgelenk"])])
def test_a_type_of_joint_without_a_symbol_has_its_name_alone(lang, said):
    types = structure_record(PENTAGON, lang)["joints"][0]["types"]
    assert said in [[each["symbol"], each["name"]] for each in types]
    assert not any("_" in each["symbol"] + each["name"] for each in types)


def test_a_chain_in_space_has_drives_to_choose_and_none_is_chosen():
    """A spherical four-bar without a drive: one freedom, one drive at the frame but for symmetry."""
    record = structure_record("spherical: R(0-1) R(1-2) R(2-3) R(3-0)", "en")
    assert (record["generic"], record["driver"]) == (1, "")
    assert [each["drives"] for each in record["driven"]] == [["R(0-1)"]]


def test_usual_sizes_say_nothing_of_their_own():
    linkage = entries()["crankrocker"].placed()
    asked = {"text": linkage.mechanism.text(), "document": linkage_to_json(linkage)}
    assert answer("structure", asked, "en", print)["own"] is None


def test_a_drive_that_does_not_move_fixes_nothing():
    """A parallelogram with a third crank and a loose rocker-free dyad: locking the rigid part leaves its motion."""
    linkage = entries()["toolbox2"].placed()
    found = freedoms(linkage)
    assert found.instant.stands_with({0})
    assert not found.instant.stands_with(set())


def test_a_linkage_of_another_chain_says_nothing():
    text = "R(0-1) R(1-2) G(2-0); frame=0; drive=R(0-1)"
    alone = structure_record(text, "en")
    assert structure_record(text, "en", linkage=entries()["geneva"].linkage())["picture"] == alone["picture"]


def test_one_bar_tells_that_the_structure_waits(tab, server):
    page = tab().open(server.address)
    page.hold()
    page.page.click('[data-view="structure"]')
    page.page.locator('[data-page="structure"] progress').first.wait_for()
    assert page.page.locator('[data-page="structure"] progress').count() == 1


def held_back(page):
    """The structure view of a page that opens, whose questions wait until they are answered by their names."""
    page.hold()
    page.page.click('[data-view="structure"]')
    page.page.evaluate("""() => {
        const send = Object.getPrototypeOf(gruebler.model).send.bind(gruebler.model);
        window.asked = (method) => held.findIndex((content) => content.method === method);
        window.answered = (method) => asked(method) >= 0 && (send(held.splice(asked(method), 1)[0]), true);
    }""")
    return page.page.locator('[data-page="structure"]').get_by_label("Links", exact=True)


def test_a_size_that_is_being_typed_is_not_written_over(tab, server):
    """What is said of the machine at hand comes a moment later: the field is not filled anew."""
    page = tab().open(server.address)
    links = held_back(page)
    links.fill("6")  # not taken yet
    page.until("answered('structure')")
    page.until("gruebler.views.structure.structure !== null")
    assert links.input_value() == "6"
    page.until("answered('chains')")  # of four links
    page.page.locator('[data-list="chains"] .card', has_text="Your machine").wait_for()
    links.press("Enter")
    page.until("answered('chains')")
    page.until("answered('structure')")
    page.until("gruebler.views.structure.structure.size === 6")
    assert links.input_value() == "6"
    assert page.page.locator('[data-list="chains"] .card').count() == 2  # Watt's and Stephenson's


def test_an_answer_about_the_machine_at_hand_does_not_turn_back_a_size_that_was_taken(tab, server):
    page = tab().open(server.address)
    links = held_back(page)
    page.until("asked('structure') >= 0")
    links.fill("6")
    links.press("Enter")
    page.until("asked('chains') >= 0")
    page.until("answered('structure')")  # of four links
    page.until("gruebler.views.structure.structure !== null")
    page.until("answered('chains')")
    page.until("answered('structure')")
    page.until("gruebler.views.structure.structure.size === 6")
    assert links.input_value() == "6"
    assert page.page.locator('[data-list="chains"] .card').count() == 2


def test_the_list_of_the_size_before_is_faded_while_another_one_is_counted(tab, server):
    page = tab().open(server.address)
    view = page.page
    view.click('[data-view="structure"]')
    view.locator('[data-list="chains"] .card').first.wait_for()
    count = view.locator('[data-page="structure"] .form .note').first
    assert count.inner_text() == "one chain"
    page.hold()
    links = view.locator('[data-page="structure"]').get_by_label("Links", exact=True)
    links.fill("8")
    links.press("Enter")
    page.until("held.some(({ method }) => method === 'chains')")
    assert count.is_visible()
    assert count.inner_text() == "counting …"
    assert view.locator('[data-page="structure"] .go').evaluate("bar => getComputedStyle(bar).opacity") == "1"
    for faded in (".chains", ".described", '[data-page="structure"] .go .key'):  # all of it is of the four-bar
        assert view.locator(faded).evaluate("(part) => Number(getComputedStyle(part).opacity)") < 0.9, faded
    cancel = view.locator('[data-page="structure"]').get_by_text("Cancel")
    assert cancel.is_visible()
    links.fill("10")  # the one before is given up, or it would be counted to its end first
    links.press("Enter")
    page.until("held.filter(({ method }) => method === 'chains').length === 2")
    first = view.evaluate("held.find(({ method }) => method === 'chains').id")
    assert view.evaluate(f"held.some(({{ id, cancel }}) => cancel && id === {first})")
    assert view.get_by_text("Cancelled.").count() == 0
    links.fill("99")  # of which there is no list: nothing is left of the one that was asked for
    links.press("Enter")
    view.get_by_text("Chains are listed with").wait_for()
    cancel.wait_for(state="hidden")
    assert view.locator('[data-list="chains"] .card').count() == 0
    assert float(view.locator(".described").evaluate("(part) => getComputedStyle(part).opacity")) == 1


def test_of_another_machine_nothing_is_said_before_its_structure_is_known(tab, server):
    page = tab().open(server.address)
    view = page.page
    view.click('[data-view="structure"]')
    view.locator('[data-act="move"]').wait_for()
    page.machine("slidercrank")
    page.hold()
    view.click('[data-view="structure"]')
    page.until("held.some(({ method }) => method === 'structure')")
    said = view.locator('[data-page="structure"] .facts')
    waiting = view.locator('[data-page="structure"] .described [data-waiting]')
    assert (said.count(), waiting.count()) == (0, 1)
    assert view.locator('[data-act="move"], [data-list="driven"] .card').count() == 0
    view.evaluate("""() => {
        const asked = held.find(({ method }) => method === "structure");
        const wrong = { ...asked, params: { ...asked.params, text: "R(" } };
        Object.getPrototypeOf(gruebler.model).send.call(gruebler.model, wrong);
    }""")
    page.until("gruebler.root.querySelector('[data-page=structure] .error').textContent")
    assert (said.count(), waiting.count()) == (0, 0)


def test_the_types_of_a_joint_are_in_sight(tab, server):
    """With eight links the picture ends under the bar at the lower edge, and the keys would be below it."""
    page = tab(width=1440, height=900).open(server.address)
    view = page.page
    view.click('[data-view="structure"]')
    view.evaluate("gruebler.describe('R(0-1) R(1-2) R(2-3) R(3-0) R(1-4) R(4-5) R(5-2) R(4-6) R(6-7) R(7-5)')")
    page.until("gruebler.views.structure.text.endsWith('R(7-5)')")
    view.locator("[data-joint]").first.press("Enter")
    bar = view.locator('[data-page="structure"] .go').bounding_box()
    for key in view.locator("[data-type]").all():
        box = key.bounding_box()
        assert 0 < box["y"] < box["y"] + box["height"] <= bar["y"]


def test_numbers_without_chains_and_colours_are_explained(tab, server):
    page = tab().open(server.address)
    view = page.page
    view.click('[data-view="structure"]')
    view.locator('[data-list="chains"] .card').first.wait_for()
    assert "g<sub>1</sub>&nbsp;=&nbsp;4" in view.locator(".said", has_text="g1 = 4").first.inner_html()
    links = view.locator('[data-page="structure"]').get_by_label("Links", exact=True)
    # it begins with the machine at hand, a four-bar, in the place of the only chain of four links
    assert links.input_value() == "4"
    cards = view.locator('[data-list="chains"] .card')
    assert cards.evaluate_all("all => all.map((e) => [e.querySelector('b').textContent, e.ariaPressed])") == [
        ["four-bar chain", "true"],
    ]
    # of a chain no link is the frame yet; the mechanism beside it has one
    assert cards.locator("span").inner_text() == "Your machine: 4\xa0binary"
    for name, hatched in (("chains", 0), ("inversions", 1)):
        assert view.locator(f'[data-list="{name}"] .card [class^="gr-hatch"]').count() == hatched, name
    view.evaluate("gruebler.describe('R(0-1) R(1-2) R(2-3) R(3-0) R(1-4) R(4-5) R(5-2)')")  # begins as a four-bar
    page.until("gruebler.views.structure.text.endsWith('R(5-2)')")
    view.locator('[data-list="chains"] .card', has_text="Stephenson").wait_for()  # the list turns to its size
    assert links.input_value() == "6"
    assert cards.evaluate_all("all => all.map((e) => e.ariaPressed)") == ["true", "false"]
    links.fill("40")
    links.press("Enter")
    assert links.get_attribute("aria-invalid") == "true"
    assert cards.count() == 2  # the list stays, and what is said of the chain
    assert view.locator(".described .facts").count() == 1
    refused = view.get_by_text(f"Chains are listed with 3 … {links.get_attribute('max')} links")  # none is asked for
    refused.wait_for()
    links.fill("")
    links.press("Enter")
    refused.wait_for()
    links.fill("7")  # F = 3·6 - 2g is even
    links.press("Enter")
    assert links.get_attribute("aria-invalid") == "false"
    refused.wait_for(state="hidden")
    page.until("gruebler.root.textContent.includes('is odd for even n and even for odd n')")
    parts = '[data-list="driven"] .card, .described .facts, [data-act="realise"]'
    assert view.locator(parts).count() == 0  # nothing is shown of the chain before
    keys = view.locator('[data-page="structure"] .chains .plain')
    assert keys.all_inner_texts() == ["F = 0", "F = 2", "n = 6", "n = 8"]  # with which there are some
    links.fill("6")
    links.press("Enter")
    view.locator('[data-act="realise"]').wait_for()
    assert view.locator(".described .facts").count() == 1
    view.evaluate("gruebler.describe('R(a-b) R(b-c) R(c-a)')")
    page.until("gruebler.root.textContent.includes('Purple: links rigid')")
    assert view.locator('[data-act="realise"]').count() == 0  # nothing would move
    view.evaluate("gruebler.describe('R(a-b) R(b-c) R(c-d) R(d-a) R(a-c)')")  # all of it is overconstrained
    page.until("gruebler.root.textContent.includes('Orange: overconstrained')")
    assert "Purple" not in view.locator(".described").inner_text()


def test_a_machine_beside_the_lists_has_its_size_and_its_card(tab, server):
    """Walschaerts' valve gear has 13 links and F = 2: lists end at 12 links, and 13 and 2 are odd and even."""
    page = tab().open(server.address)
    view = page.page
    view.click('[data-view="catalog"]')
    view.locator('[data-id="walschaerts_gear"]').click()
    page.until("gruebler.motion.linkage.model.source === 'walschaerts_gear'")
    view.click('[data-view="structure"]')
    first = view.locator('[data-page="structure"] .step').first
    own = first.locator(".card", has_text="Your machine")
    own.wait_for()
    links, mobility = first.locator("input").all()
    assert (links.input_value(), mobility.input_value()) == ("13", "2")
    assert links.evaluate("field => field.scrollWidth <= field.clientWidth")
    said = first.inner_text().replace("\N{NO-BREAK SPACE}", " ")
    assert "There is none" not in said
    assert "Chains are listed with 3 … 12 links and mobility 0 … 6." in said
    assert "0 chains" not in said
    # German names of its links are too long for the picture: they stand below it, as large as text
    view.locator("header select").select_option("de")
    drawn = view.locator('[data-page="structure"] .chain-picture')
    drawn.get_by_text("8\xa0Schieberschubstange").wait_for()
    assert drawn.locator("svg text", has_text="Schieberschubstange").count() == 0
    view.click('[data-view="motion"]')
    label = view.locator(".rows.sizes label", has_text="Schwingen\xadstange").first
    assert "Gestell\xa0– Schwingen\xadstange" in (label.text_content() or "")  # no line begins with a dash
    view.click('[data-view="structure"]')
    view.locator("header select").select_option("en")
    # nor is its card in a list of other chains
    links.fill("6")
    mobility.fill("1")
    mobility.press("Enter")
    first.locator(".card", has_text="Watt").wait_for()
    assert own.count() == 0


def test_a_machine_has_no_card_among_chains_of_another_mobility(tab, server):
    """A four-bar has F = 1: there is no chain of four links with F = 2, and the four-bar is none."""
    page = tab().open(server.address)
    view = page.page
    view.click('[data-view="structure"]')
    first = view.locator('[data-page="structure"] .step').first
    first.locator(".card", has_text="Your machine").wait_for()
    field = first.locator("input").nth(1)
    field.fill("2")
    field.press("Enter")
    first.get_by_text("No chain of revolute and prismatic joints").wait_for()
    assert first.locator(".card").count() == 0


def test_a_chain_has_the_code_of_its_card_however_it_is_numbered():
    """Stephenson's chain: its links of three joints, 3 and 5 here, have no joint with each other."""
    found = {
        item["name"]["en"]: item["code"] for item in answer("chains", {"links": 6, "mobility": 1}, "en", print)["items"]
    }
    text = "R(3-1) R(1-2) R(2-5) R(3-4) R(4-5) R(3-6) R(6-5)"
    assert structure_record(text, "en")["code"] == found["Stephenson's chain"] != found["Watt's chain"]
    assert structure_record(text.replace("R(6-5)", "P(6-5)"), "en")["code"] not in found.values()


@pytest.mark.parametrize(
    ("links", "mobility", "total", "apart"),
    [
        # Mruthyunjaya, Mech. Mach. Theory 38 (2003) 279: 4 and 40 chains of 7 and 9 links with F = 2, 7 of 8 with F = 3
        (7, 2, 4, ["6\xa0binary, 1\xa0quaternary; fractionated: it falls apart when one link is cut"]),
        (9, 2, 40, None),
        (8, 3, 7, None),
        (6, 1, 2, []),
    ],
)
def test_all_chains_are_listed_with_the_kinds_of_their_links(links, mobility, total, apart):
    """Those too that fall apart at a link, as two four-bars that share one."""
    found = answer("chains", {"links": links, "mobility": mobility}, "en", print)
    assert found["total"] == len(found["items"]) == total
    kinds = [each["kinds"]["en"] for each in found["items"]]
    assert all(sum(map(int, re.findall(r"\d+(?=\s\w+ary)", each))) == links for each in kinds)
    if apart is not None:
        assert [each for each in kinds if ";" in each] == apart
    else:
        assert any(each.endswith("; fractionated: it falls apart when one link is cut") for each in kinds)


# Woo, J. Eng. Ind. 89 (1967) 159: the 230 chains of ten links by their link assortments
TEN = {
    (4, 6): 50,
    (5, 4, 1): 95,
    (6, 2, 2): 57,
    (6, 3, 0, 1): 15,
    (7, 0, 3): 3,
    (7, 1, 1, 1): 8,
    (8, 0, 0, 2): 2,
}


def test_chains_are_listed_by_their_link_assortment():
    for assortment, count in TEN.items():
        found = answer("chains", {"links": 10, "mobility": 1, "start": 40, "assortment": assortment}, "en", print)
        assert {each["links"]: each["chains"] for each in found["assortments"]} == TEN
        assert found["total"] == count
        assert len(found["items"]) == max(0, min(60, count - 40))
        assert {each["assortment"] for each in found["items"]} <= {assortment}
    none = answer("chains", {"links": 10, "mobility": 1, "assortment": [9, 1]}, "en", print)
    assert (none["total"], none["items"]) == (0, [])


def test_a_link_assortment_is_chosen(tab, server):
    page = tab(width=390, height=844, touch=True, locale="de-DE").open(server.address)
    view = page.page
    view.click('[data-view="structure"]')
    step = view.locator(".step").first
    step.locator(".card").first.wait_for()
    choice = step.locator("select")
    assert choice.count() == 0  # of four links there is one chain
    links = step.locator("input").first
    links.fill("8")
    links.press("Enter")
    choice.wait_for()
    # 9, 5 and 2 in every textbook
    assert choice.locator("option").all_inner_texts() == [
        "Alle Gliedersortimente · 16",
        "4\xa0binär, 4\xa0ternär · 9",
        "5\xa0binär, 2\xa0ternär, 1\xa0quaternär · 5",
        "6\xa0binär, 2\xa0quaternär · 2",
    ]
    box = choice.bounding_box()
    assert box["x"] + box["width"] <= 390 - 12
    page.until("gruebler.views.structure.structure.size === 8")
    choice.select_option("6,0,2")
    step.get_by_text("2 Ketten").wait_for()
    assert step.locator(".card span").all_inner_texts() == ["6\xa0binär, 2\xa0quaternär"] * 2
    page.until("gruebler.views.structure.structure.kinds === '6\xa0binär, 2\xa0quaternär'")
    # what is described stays where it is among those that are wanted
    card = step.locator(".card").nth(1)
    second = card.get_attribute("data-chain")
    card.click()
    page.until(f"gruebler.views.structure.structure.text.startsWith('{second}')")
    choice.select_option("")
    step.get_by_text("16 Ketten").wait_for()
    assert view.evaluate("gruebler.views.structure.structure.text").startswith(second)
    # a chain of another one turns the list back to all
    choice.select_option("4,4")
    step.get_by_text("9 Ketten").wait_for()
    page.until("gruebler.views.structure.structure.kinds === '4\xa0binär, 4\xa0ternär'")
    view.evaluate(f"gruebler.describe('{second}')")
    step.get_by_text("16 Ketten").wait_for()
    assert choice.input_value() == ""
    links.fill("6")
    links.press("Enter")
    step.get_by_text("2 Ketten").wait_for()
    assert choice.count() == 0


def test_the_page_scrolls_and_not_its_lists(tab, server):
    """Of 16 chains of eight links six are shown first, and the one that is chosen; no card is cut."""
    page = tab(width=1440, height=900).open(server.address)
    view = page.page
    view.click('[data-view="structure"]')
    # the last of the 16 but for its numbers
    view.evaluate("gruebler.describe('R(0-1) R(0-2) R(0-3) R(1-4) R(1-5) R(2-4) R(2-6) R(3-5) R(3-7) R(6-7)')")
    page.until("gruebler.views.structure.structure?.size === 8")
    view.locator('[data-more="chains"]').wait_for()
    cards = view.locator('[data-list="chains"] .card')
    chosen = view.locator('[data-list="chains"] .card[aria-pressed="true"]')
    assert chosen.count() == 1
    assert 6 <= cards.count() <= 7
    assert chosen.locator("span").inner_text() == "4\xa0binary, 4\xa0ternary"
    box = view.locator(".chain-picture").bounding_box()  # of the chosen one: beside the lists, in sight
    assert box["x"] > view.locator(".step").last.bounding_box()["x"] + view.locator(".few").last.bounding_box()["width"]
    assert box["y"] + box["height"] < view.locator(".go").bounding_box()["y"]
    sizes = "all => all.map((one) => one.getBoundingClientRect().height)"
    assert min(view.locator(".few text").evaluate_all(sizes)) > 9  # numbers on cards
    lists = view.locator(".few")
    assert lists.count() == 3
    assert lists.evaluate_all("all => all.every((one) => one.scrollHeight <= one.clientHeight)")
    view.click('[data-more="chains"]')
    assert cards.count() == 16
    cards.last.scroll_into_view_if_needed()
    view.locator('[data-list="driven"]').scroll_into_view_if_needed()
    assert view.locator(".chain-picture").bounding_box()["y"] > 0  # however far the lists are gone through
    assert view.locator('[data-more="chains"]').count() == 0


@pytest.mark.parametrize("lang", ["en", "de"])
def test_names_of_chains_are_not_broken_within_a_word(tab, server, lang):
    """A word is broken where it needs more room than its card has: then its letters stand in two lines."""
    page = tab(width=1024, height=768, locale=lang).open(server.address)
    view = page.page
    view.click('[data-view="structure"]')
    view.evaluate("gruebler.describe('R(0-1) R(1-2) R(2-3) R(3-0) R(1-4) R(4-5) R(5-2)')")
    name = view.locator('[data-list="chains"] .card b', has_text="Stephenson")
    name.wait_for()
    lines = """span => { const range = document.createRange(), text = span.firstChild, end = text.data.indexOf(" ");
        range.setStart(text, 0); range.setEnd(text, end);
        return range.getClientRects().length; }"""
    assert name.evaluate(lines) == 1


def test_the_button_that_finds_dimensions_is_in_sight_on_a_phone(tab, server):
    view = tab(width=390, height=844, touch=True).open(server.address).page
    view.click('[data-view="structure"]')
    box = view.locator('[data-act="realise"]').bounding_box()
    assert 422 < box["y"] < box["y"] + box["height"] <= 844
    assert view.evaluate("document.documentElement.scrollWidth") == 390
    # chain, what is said of it, then its frames and drives
    parts = (".chains", ".chain-picture", '[data-fact="generic"]', '[data-list="inversions"]', '[data-list="driven"]')
    tops = [view.locator(part).first.bounding_box()["y"] for part in parts]
    assert tops == sorted(tops)
    assert (
        view.locator(".described > p.note").first.inner_text() == "R\u00a0revolute. Choose a joint to change its type."
    )


def test_from_a_long_list_a_key_leads_to_the_picture_on_a_phone(tab, server):
    page = tab(width=390, height=844, touch=True).open(server.address)
    view = page.page
    view.click('[data-view="structure"]')
    view.locator('[data-list="driven"] .card').first.wait_for()
    links = view.locator('[data-page="structure"]').get_by_label("Links", exact=True)
    links.fill("8")
    links.press("Enter")
    page.until("gruebler.root.querySelectorAll('[data-list=chains] .card').length === 6", 90)
    view.locator(".chain-picture svg .gr-name", has_text="8").wait_for()
    picture = view.locator(".chain-picture")
    assert picture.bounding_box()["y"] > 844
    view.click('[data-act="down"]')
    page.until("gruebler.root.querySelector('.chain-picture').getBoundingClientRect().top < 60")
    assert picture.bounding_box()["y"] >= 0


@pytest.mark.parametrize(("width", "height", "locale"), [(1440, 900, "en"), (1024, 768, "de")])
def test_steps_of_one_card_each_stand_in_a_row_and_what_is_said_fits(tab, server, width, height, locale):
    page = tab(width=width, height=height, locale=locale).open(server.address)
    view = page.page
    view.click('[data-view="structure"]')
    view.locator('[data-list="driven"] .card').wait_for()
    page.until("!gruebler.root.querySelector('.chains progress')")
    heads, cards = (
        [one.bounding_box() for one in view.locator(f".steps {part}").all()] for part in ("h2", "button.card")
    )
    assert [len(heads), len(cards)] == [3, 3]
    for boxes, edge in ((heads, "top"), (cards, "bottom")):
        ends = [box["y"] + (box["height"] if edge == "bottom" else 0) for box in boxes]
        assert max(ends) - min(ends) < 1
        assert boxes[0]["x"] < boxes[1]["x"] < boxes[2]["x"]
    made = "gruebler.root.querySelector('.made')"
    assert view.evaluate(f"{made}.scrollHeight - {made}.clientHeight") <= 1
    links = view.locator('[data-page="structure"] input[type="number"]').first
    links.fill("6")
    links.press("Enter")
    page.until("gruebler.root.querySelectorAll('[data-list=chains] .card').length === 2")
    tops = [one.bounding_box()["y"] for one in view.locator(".steps h2").all()]
    assert tops[0] + 100 < tops[1] < tops[2] - 100


def test_a_window_that_becomes_wide_has_the_picture_beside_the_steps(tab, server):
    page = tab(width=800, height=900).open(server.address)
    view = page.page
    view.click('[data-view="structure"]')
    view.locator('[data-act="realise"]').wait_for()
    for width in (1440, 800):
        view.set_viewport_size({"width": width, "height": 900})
        steps = "gruebler.root.querySelector('.steps')"
        page.until(f"!!{steps}.querySelector('.made') === {str(width > 820).lower()}")
        page.until(f"!{steps}.querySelector('.asking')")  # the structure is asked for again, and shown anew
        picture, frames = (view.locator(part).bounding_box() for part in (".chain-picture", '[data-list="inversions"]'))
        assert (picture["x"] > frames["x"] + frames["width"]) == (width > 820)
        assert width > 820 or picture["y"] + picture["height"] < frames["y"]


def test_the_machine_at_hand_moves_with_its_own_sizes_and_other_structures_need_some(tab, server):
    page = tab().open(server.address)
    view = page.page
    page.machine("slidercrank")
    sizes = "gruebler.motion.dragging.lengths().map((one) => one.value)"
    before = view.evaluate(sizes)
    view.click('[data-view="structure"]')
    view.locator('[data-act="move"]').click()
    assert view.evaluate("[gruebler.view, gruebler.motion.transport.player.playing]") == ["motion", True]
    assert view.evaluate(sizes) == before
    view.go_back()
    page.until("gruebler.view === 'structure'")
    # another drive is another mechanism, whose sizes are to be found
    view.locator('[data-list="driven"] [aria-pressed="false"]').first.click()
    view.locator('.key[data-act="realise"]').wait_for()
    assert view.locator('[data-act="move"]').count() == 0
    # what was chosen beside a machine goes with it, and the next one is read from its beginning
    view.evaluate("gruebler.describe('R(1-2) R(2-3) R(3-4) R(4-5) R(5-6) R(6-1) R(1-4)')")
    view.locator('[aria-pressed="true"][data-chain]').wait_for()
    page.until("gruebler.views.structure.structure?.text.startsWith('R(1-2)')")
    view.evaluate("gruebler.root.querySelector('[data-page=structure]').scrollTop = 200")
    page.machine("e3_steph")
    view.click('[data-view="structure"]')
    view.locator('[data-act="move"]').wait_for()
    assert view.evaluate("gruebler.root.querySelector('[data-page=structure]').scrollTop") == 0
    assert view.locator("[data-chain] b", has_text="Chosen").count() == 0


def test_links_are_called_by_the_names_of_the_machine():
    """What is read has the German names; the texts, which the page sends back, keep those of the catalog."""
    text = "R(frame-crank) R(crank-coupler) R(coupler-rocker) R(frame-rocker); frame=frame; drive=R(frame-crank)"
    names = {"frame": "Gestell", "crank": "Kurbel", "coupler": "Koppel", "rocker": "Schwinge"}
    record = answer("structure", {"text": text, "names": names}, "de", print)
    assert [joint["name"] for joint in record["joints"]] == [
        *("D(Gestell-Kurbel)", "D(Kurbel-Koppel)", "D(Koppel-Schwinge)", "D(Gestell-Schwinge)")
    ]
    assert record["lines"][0] == f"Kette: {' '.join(joint['name'] for joint in record['joints'])}"
    assert {each["frame"] for each in record["inversions"]} <= set(names.values())
    assert {each["drives"][0].split("(")[0] for each in record["driven"]} == {"D"}
    assert record["text"] == text
    assert all(each["text"].startswith("R(frame-crank)") for each in record["inversions"])


@pytest.mark.parametrize(
    ("lang", "names", "joint", "drive"),
    [
        ("en", ["upper_rod", "lower_rod"], "R(crank-upper rod-lower rod)", "upper rod against crank"),
        ("de", ["obere Koppel", "untere Koppel"], "D(crank-obere Koppel-untere Koppel)", "obere Koppel gegen crank"),
    ],
)
def test_names_of_links_are_read_without_underscores_and_quotation_marks(lang, names, joint, drive):
    """The page would set what is after an underscore as an index; texts that are sent back keep both."""
    leg = entries()["jansen"].linkage().mechanism
    called = {link: link for link in leg.chain.links} | dict(zip(("upper_rod", "lower_rod"), names, strict=True))
    record = answer("structure", {"text": leg.text(), "names": called}, lang, print)
    assert joint in [each["name"] for each in record["joints"]]
    assert any(joint in line for line in record["lines"][1:])
    on_crank = answer("structure", {"text": f"{leg.chain.text()}; frame=crank", "names": called}, lang, print)
    assert [f"{joint}: {drive}"] in [each["drives"] for each in on_crank["driven"]]
    said = str([record["joints"][k]["name"] for k in range(len(record["joints"]))] + record["lines"])
    assert "_" not in said + record["drives"]
    assert '"' not in said
    assert "upper_rod" in record["text"]
    (pack,) = structure_pack(leg, [lang], called=called)["names"].values()
    assert joint in pack


def test_links_that_have_numbers_have_them_on_the_cards_of_frames_too():
    """Numbers of a list below the large picture, without this list; and those of a drawing, whose frame has a name."""

    def written(text: str, names: dict[str, str], document: dict[str, object]) -> list[list[str]]:
        record = answer("structure", {"text": text, "names": names, "document": document}, "en", print)
        numbered.append(record["numbered"])
        pictures = [record["picture"], *(each["picture"] for each in record["inversions"])]
        assert {each["frame"] for each in record["inversions"]} <= {name.replace("_", " ") for name in names.values()}
        return [sorted(re.findall(r"<text[^>]*>([^<]*)</text>", picture)) for picture in pictures]

    numbered: list[dict[str, str]] = []
    leg = entries()["klann"].linkage()
    mechanism = leg.mechanism
    large, *cards = written(mechanism.text(), {link: link for link in mechanism.chain.links}, linkage_to_json(leg))
    assert large == cards[0] == list("123456")
    assert numbered[0]["5"] == "upper rocker"
    watt = "R(0-1) R(1-2) R(2-3) R(3-0) R(1-4) R(4-5) R(5-2)"
    large, *cards = written(watt, {"0": "frame", **{str(k): str(k) for k in range(1, 6)}}, {})
    assert "frame" in large
    assert not numbered[1]
    assert cards == [list("12345")] * 2


def test_the_drives_of_an_excavator_are_marked_and_short(tab, server):
    page = tab().open(server.address)
    view = page.page
    view.click('[data-view="catalog"]')
    view.click('.card[data-id="excavator"]')
    page.until("gruebler.view === 'motion' && gruebler.shown.drives.length === 3")
    view.click('[data-view="structure"]')
    own = view.locator('[data-list="driven"] .card[aria-pressed="true"]:first-child')
    own.wait_for()
    assert own.locator("div").all_inner_texts() == ["P(5-6)", "P(7-8)", "P(9-10)"]
    assert own.get_attribute("title").startswith("P(boom cylinder-boom piston)")
    assert view.locator('[data-field="elsewhere"]').count() == 0
    assert "at the frame alone do not fix" in view.locator(".step", has=own).inner_text()


def test_mobility_is_no_good_news_where_nothing_moves(tab, server):
    """Two triangles with a common side count right, and do not move."""
    page = tab().open(server.address)
    page.page.click('[data-view="structure"]')
    facts = page.page.locator(".described dd")
    facts.first.wait_for()
    assert facts.evaluate_all("all => all.map((one) => one.className)") == ["", "good"]
    page.page.locator('[data-page="structure"] .words summary').click()
    page.page.locator('[data-field="chain"]').fill("R(0-1) R(1-2) R(2-0)")
    page.page.locator('[data-fact="generic"]', has_text="F = 0").wait_for()
    assert facts.evaluate_all("all => all.map((one) => one.className)") == ["", ""]


def test_names_of_another_chain_say_nothing():
    names = {"frame": "Gestell", "crank": "Kurbel"}
    assert structure_record("R(0-1) R(1-2) R(2-0)", "de", names=names)["frame"] == "0"


def test_a_long_german_name_of_a_machine_is_broken_between_its_parts(tab, server):
    """Viergelenk-getriebe: a browser without a German dictionary would break it at the last letter with room."""
    view = tab(width=1440, height=900, locale="de").open(server.address).page
    view.click('[data-view="structure"]')
    names = view.locator('[data-list="inversions"] .card span', has_text="gelenkgetriebe")
    names.first.wait_for()
    lines = """all => all.map((span) => { const range = document.createRange(), text = span.firstChild;
        const from = text.data.indexOf("etriebe");
        range.setStart(text, from); range.setEnd(text, from + 7);
        return range.getClientRects().length; })"""
    assert set(names.evaluate_all(lines)) == {1}
