"""Exercises on the page: figures, choices, hints by the likely mistake, the linkage to try, the score."""

import re

import pytest

from gruebler.base.text import Readable
from gruebler.page.tasks import marked_task, signed, task_kinds, task_record, tried_task
from gruebler.teaching.exercises import KINDS, ascii_key, exercise, solve

KIND = "gruebler.views.exercises"


def begin(page, kind: str, seed: int, level: int = 1) -> None:
    """Open a certain task."""
    page.page.evaluate(f"Object.assign({KIND}, {{kind: '{kind}', seed: {seed}, level: {level}}})")
    page.page.evaluate(f"{KIND}.fresh()")
    page.until(f"{KIND}.task.id === '{kind}-{level}-{seed}'")


@pytest.fixture
def exercises(tab, server):
    def opened(**settings):
        page = tab(**settings).open(server.address)
        page.page.click('[data-view="exercises"]')
        page.page.locator("[data-answer]").first.wait_for()
        return page

    return opened


def size_of(svg: str) -> tuple[float, float]:
    """Width and height of a figure, in its own units: pixels at the size in which it is drawn."""
    _, _, width, height = map(float, re.search(r'viewBox="([^"]*)"', svg)[1].split())
    return width, height


@pytest.mark.parametrize("level", [1, 2, 3])
@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_has_a_figure_and_wrong_answers_a_hint(kind, level):
    task = task_record(f"{kind}-{level}-5", "en")
    assert min(size_of(task["figures"][0]["picture"])) > 60
    numbers = [one["key"] for one in task["asked"] if not one["choices"]]
    marks = marked_task(task["id"], dict.fromkeys(numbers, "123456.789"), "en")["marks"]
    assert numbers
    assert [mark["key"] for mark in marks if mark["mark"] == "wrong"] == numbers
    assert all(mark["hint"].count(" ") >= 2 for mark in marks)


@pytest.mark.parametrize(
    ("id", "key", "hint"),
    [
        # a five-bar, then a dyad or a coupler on it: both from the text of the task
        ("dyad-1-7", "F_after", "Put n = 5 + 2 and g_1 = 5 + 3 into F′ = 3(n − 1) − 2 g_1."),
        ("exercise-4", "F_before", "Put n = 5 and g_1 = 5 into F = 3(n − 1) − 2 g_1."),
        ("exercise-4", "F_after", "Put n = 5 + 1 and g_1 = 5 + 2 into F′ = 3(n − 1) − 2 g_1."),
        ("mobility-1-7", "F", "Check n, g_1 and g_2 first, then put them into F = 3(n − 1) − 2 g_1 − g_2."),
    ],
)
def test_a_wrong_mobility_is_helped_by_what_is_put_into_its_formula(id, key, hint):
    assert marked_task(id, {key: "123"}, "en")["marks"][0]["hint"] == hint


def test_what_a_hint_and_a_figure_name_is_told():
    """The quantities of a formula that are found on the way have their names, and e stands in the figure."""
    hints = marked_task("dead-centre-2-7", {"H": "1", "phi_max": "1"}, "en")["marks"]
    assert [one["hint"] for one in hints] == [
        "The formula is H = l_a − l_i. l_a: outer dead centre, crank and coupler stretched; "
        "l_i: inner dead centre, crank and coupler overlapping.",
        "The formula is φ_max = 180° + Δφ. Δφ: deviation from half a turn.",
    ]
    assert "B_0" in marked_task("velocity-3-7", {"a_B": "1"}, "en")["marks"][0]["hint"]
    for id, has in (("dead-centre-1-7", False), ("dead-centre-2-7", True), ("velocity-2-7", True)):
        letters = re.findall(r">(\w)</t", task_record(id, "en")["figures"][0]["picture"])
        assert ("e" in letters) is has, id
    for id in ("transmission-angle-3-5", "dead-centre-3-5", "spherical-grashof-3-5", "exercise-12", "exercise-16"):
        letters = re.findall(r"<text.*?</text>", task_record(id, "en")["figures"][0]["picture"])
        assert {"A", "B", "A0", "B0"} <= {re.sub("<.*?>", "", letter) for letter in letters}, id


def test_numbered_exercises_say_what_they_ask_for():
    """Drawing alone was told, and a number asked for."""
    wanted = {"1": "slope", "2": "stroke", "17": "ratio", "19": "width"}
    assert all(word in task_record(f"exercise-{number}", "en")["task"] for number, word in wanted.items())


def test_a_wrong_number_after_a_dyad_has_a_hint_of_its_own():
    """F' and the number of chains are not sent to the solution."""
    for level in (1, 2, 3):
        task = task_record(f"dyad-{level}-5", "en")
        wrong = {one["key"]: "123" for one in task["asked"] if not one["choices"]}
        hints = {mark["key"]: mark["hint"] for mark in marked_task(task["id"], wrong, "en")["marks"]}
        assert not [hint for hint in hints.values() if "See the steps" in hint]


def test_the_page_shows_kinds_figure_and_hints(exercises):
    page = exercises()
    kinds = page.page.locator('[aria-label="Topic"] button')
    assert kinds.count() == len(KINDS) + 1
    rows = page.page.locator('[data-page="exercises"] .choice').evaluate_all("all => all.map((e) => e.innerText[0])")
    assert rows[:2] == ["T", "L"]  # each says what is chosen in it: topic, level
    page.page.locator('[aria-label="Level"] button').nth(1).click()
    kinds.nth(5).click()
    page.page.locator('[aria-busy="true"].faded').wait_for()  # the task before, at once
    page.until(f"{KIND}.task.id.startsWith({KIND}.kind + '-2-')")
    page.page.locator('[aria-busy="false"]:not(.faded)').wait_for()
    box = page.page.locator('[aria-label="The figure of the task"]').bounding_box()
    assert min(box["width"], box["height"]) > 60
    for field in page.page.locator("input[data-answer]").all():
        field.fill("123456.789")
    page.page.click('[data-act="mark"]')
    wrong = page.page.locator('[data-mark="wrong"]')
    wrong.first.wait_for()
    assert page.page.locator("[id^=hint-]").count() == wrong.count() == page.page.locator("input[data-answer]").count()
    assert page.page.locator("h2 + .note").text_content() == "0 of 1 solved"  # said once, beside the title
    letters = page.page.locator(".task figure text").all_text_contents()
    assert {"a", "b", "A", "B", "φ", "β"} <= set(letters)  # of which text and solution speak
    slanted = page.page.locator(".solution .formula i").all_text_contents()
    assert "ω" in slanted
    assert "s" not in slanted  # of mm/s
    assert page.page.locator(".solution td", has_text="by the general solver").all_text_contents() == [
        f"{rate}B by the general solver" for rate in "va"
    ]
    tops = [button.bounding_box()["y"] for button in kinds.all()]
    assert tops == [tops[0]] * 5 + [tops[5]] * 5  # two rows below each other


@pytest.mark.parametrize("level", [1, 2, 3])
def test_the_figure_has_the_numbers_that_the_text_names(level):
    task = task_record(f"mobility-{level}-5", "en")
    joints = re.findall(r"[A-Z]\((\d+(?:-\d+)+)\)", task["task"])
    assert len(joints) > 4
    written = re.findall(r"<text[^>]*>(?:<tspan[^>]*>)?(\d+)<", task["figures"][0]["picture"])
    assert sorted(written) == sorted({link for joint in joints for link in joint.split("-")})


OF_THE_TEXT = [task["id"] for task in task_kinds("en")[-1]["tasks"]]


@pytest.mark.parametrize("id", OF_THE_TEXT)
def test_every_exercise_of_the_text_has_figures_to_try_and_hints_by_the_likely_mistake(id):
    """All that it asks has a likely mistake of its own, which is marked wrong and named by its hint."""
    task, solution = task_record(id, "en"), solve(exercise(id))
    assert len(OF_THE_TEXT) == 22
    assert len(task["figures"]) == len(tried_task(id)) >= 1
    for asked in task["asked"]:
        mistakes = [one for one in solution.mistakes if ascii_key(one.key) == asked["key"].partition(" ")[0]]
        assert mistakes, asked["key"]
        for mistake in mistakes:
            said = mistake.value.in_language("en") if isinstance(mistake.value, Readable) else repr(mistake.value)
            if asked["choices"] and isinstance(mistake.value, bool):
                said = "yes" if mistake.value else "no"
            (mark,) = marked_task(id, {asked["key"]: said}, "en")["marks"]
            hints = [signed(one.hint.in_language("en")) for one in mistakes]
            assert mark["mark"] == "wrong", (asked["key"], said)
            assert mark["hint"] in hints, (asked["key"], said, mark["hint"])


def test_the_ratio_of_an_external_pair_is_asked_for_as_a_magnitude():
    """With signs i = ω_in/ω_out is negative (docs/theory/events.md), as in Motion; the answer -0.5 is told so."""
    for lang, word in (("en", "magnitude"), ("de", "Betrag")):
        task = task_record("exercise-1", lang)
        assert "|i| = 2" in task["task"]
        (asked,) = task["asked"]
        assert word in asked["name"]
        marks = {each: marked_task("exercise-1", {asked["key"]: each}, lang)["marks"][0] for each in ("0.5", "-0.5")}
        assert [mark["mark"] for mark in marks.values()] == ["right", "wrong"]
        assert word in marks["-0.5"]["hint"]


def test_names_of_answers_have_indices(exercises):
    """Exercise 18 asks for a stroke with |F_x| ≤ 0.1 mm."""
    view = exercises().page
    view.locator('[data-value="exercise"]').click()
    view.locator('[data-page="exercises"] select').select_option("exercise-18")
    name = view.locator(".answer label", has_text="stroke with")
    name.wait_for()
    assert "|F<sub>x</sub>|" in name.inner_html()


def test_an_exercise_of_the_text_is_chosen_and_each_of_its_machines_tried(exercises):
    """Exercise 5: F = 1 for all five; with n = 4 instead of n - 1 = 3 free links it would be 4."""
    page = exercises(locale="de-DE")
    view = page.page
    view.locator('[data-value="exercise"]').click()
    view.locator('[data-page="exercises"] select').select_option("exercise-5")
    page.until(f"{KIND}.task.id === 'exercise-5'")
    captions = view.locator(".task figcaption").all_text_contents()
    asked = view.locator(".answer label").all_text_contents()
    assert [f"{name}: Laufgrad" for name in captions] == asked  # figures and fields have the same names
    assert view.locator(".task figure text").count() == 0  # letters of small figures are not read
    fields = view.locator("input[data-answer]")
    for k, answer in enumerate("11114"):
        fields.nth(k).fill(answer)
    view.click('[data-act="mark"]')
    view.locator("[data-result]").wait_for()
    assert view.locator("[data-result]").inner_text() == "4 von 5 richtig"
    assert "Das Gestell bewegt sich nicht" in view.locator("[id^=hint-]").inner_text()
    tries = view.locator('[data-act="try"]')
    assert tries.count() == 5
    tries.nth(3).click()
    page.until("gruebler.view === 'motion' && gruebler.motion.linkage.model.source === 'filmclaw'")
    assert view.locator(".stage text.mark").last.text_content() == "Spitze"  # the point "tip" of the catalog
    view.go_back()
    page.until("gruebler.view === 'exercises'")
    view.click('[data-act="next"]')
    page.until(f"{KIND}.task.id === 'exercise-5b'")


def test_a_task_is_chosen_marked_mended_and_tried(exercises):
    """a = 45, b = 80, c = 80, d = 30 mm: 30 + 80 = 110 < 125 = 45 + 80, and the frame is the shortest."""
    page = exercises()
    view = page.page
    begin(page, "grashof", 3)
    assert "a = 45 mm, b = 80 mm, c = 80 mm and d = 30 mm" in view.locator(".task").inner_text().replace("\xa0", " ")
    view.click('[data-act="mark"]')
    assert "at least one answer" in view.locator("[data-result]").inner_text()
    view.locator('[data-answer="sum_ends"]').fill("abc")
    view.locator('[data-answer="sum_others"]').fill("12")
    view.click('[data-act="mark"]')
    view.locator("[data-mark]").first.wait_for()
    said = view.locator("[data-mark] > b").all_inner_texts()[:2]
    assert said == ["✗ not a number", "✗ wrong"]
    view.locator('[data-answer="sum_ends"]').fill("110")
    view.locator('[data-answer="sum_others"]').fill("12,5 cm")
    view.locator('[data-answer="turns"] [data-value="yes"]').click()
    view.click('[data-act="mark"]')
    marks = view.locator("[data-mark]")
    view.locator('[data-mark="right"]').first.wait_for()
    seen = "all => all.map((e) => e.dataset.mark)"
    assert marks.evaluate_all(seen) == ["right", "right", "right", "missing"]
    assert marks.last.locator("b").inner_text() == "missing"
    view.locator('[data-answer="type"] [data-value="crank-rocker"]').click()
    view.click('[data-act="mark"]')
    view.locator('[data-mark="wrong"]').wait_for()
    assert marks.evaluate_all(seen) == ["right", "right", "right", "wrong"]
    assert "which link is the shortest" in view.locator("[id=hint-type]").inner_text()
    assert view.locator('[data-answer="type"] [aria-pressed="true"]').all_text_contents() == ["crank-rocker"]
    view.locator('[data-answer="type"] [data-value="double crank"]').press("Enter")
    view.locator('[data-answer="sum_ends"]').press("Enter")
    view.locator("[data-result]", has_text="4 of 4 right").wait_for()
    assert view.locator("h2 + .note").inner_text() == "1 of 1 solved"
    view.click('[data-act="try"]')
    page.until("gruebler.view === 'motion'")
    lengths = view.evaluate("gruebler.motion.dragging.lengths().map((one) => one.value)")
    assert sorted(lengths) == pytest.approx([30, 45, 80, 80])
    assert view.evaluate("gruebler.motion.linkage.cycle.full") is True  # the crank does turn
    view.go_back()
    page.until("gruebler.view === 'exercises'")
    view.click('[data-act="next"]')
    page.until(f"{KIND}.task.id === 'grashof-1-4'")
    assert view.locator("[data-result]").inner_text() == ""


def test_the_chain_of_a_task_that_is_tried_is_the_marked_card(exercises):
    """Watt's chain, whose links of three joints are jointed to each other; one with a slide, which is in no list."""
    page = exercises()
    view = page.page
    cards = view.locator('[data-list="chains"] .card')
    named = "all => all.map((e) => [e.querySelector('b').textContent, e.ariaPressed])"

    def tried(seed, level, text):
        begin(page, "mobility", seed, level)
        assert tried_task(f"mobility-{level}-{seed}")[0]["text"] == text
        view.locator("input[data-answer]").first.fill("1")
        view.click('[data-act="mark"]')
        view.click('[data-act="try"]')
        page.until(f"gruebler.view === 'structure' && gruebler.views.structure.text === '{text}'")
        view.locator('[data-list="chains"] .card[aria-pressed="true"]').wait_for()
        found = cards.evaluate_all(named)
        view.go_back()
        page.until("gruebler.view === 'exercises'")
        return found

    watt = "R(5-2) R(5-3) R(3-6) R(6-2) R(5-4) R(4-1) R(1-2)"
    assert tried(7, 1, watt) == [["Watt's chain", "true"], ["Stephenson's chain", "false"]]
    slide = "R(3-6) R(4-6-7) R(3-5-2) P(5-7) R(2-1) R(4-1)"
    first, *others = tried(2, 2, slide)
    assert first == ["Chosen", "true"]
    assert {pressed for _, pressed in others} <= {"false"}
    four = "R(2-3) R(3-4) R(4-1) R(1-2)"  # that of the machine at hand
    assert tried(3, 1, four) == [["four-bar chain", "true"]]


def test_answers_and_hints_in_german_on_a_phone(exercises):
    """A central slider-crank of 30 and 100 mm: the dead centres at 130 and 70, the stroke twice the crank."""
    page = exercises(width=390, height=844, locale="de-DE")
    begin(page, "dead-centre", 7)
    for key, answer in (("l_a", "130,0"), ("l_i", "0,07 m"), ("H", "30")):
        page.page.locator(f'[data-answer="{key}"]').fill(answer)
    page.page.click('[data-act="mark"]')
    page.page.locator("[data-result]").wait_for()
    assert page.page.locator("[data-result]").inner_text() == "2 von 3 richtig"
    assert page.page.locator("[id=hint-H]").inner_text() == "Der Hub ist zweimal die Kurbellänge, nicht einmal."
    page.page.locator(".solution summary").click()
    formulas = page.page.locator(".solution .formula")
    assert formulas.all_inner_texts() == [  # they break before a sign, and never before a unit
        "la =\xa0a +\xa0b =\xa030 +\xa0100 =\xa0130\xa0mm",
        "li =\xa0b −\xa0a =\xa0100 −\xa030 =\xa070\xa0mm",
        "H =\xa0la −\xa0li =\xa0130 −\xa070 =\xa060\xa0mm",
    ]
    assert formulas.first.locator("i").all_inner_texts() == ["la", "a", "b"]
    assert formulas.first.locator("sub").first.inner_text() == "a"
    assert page.page.evaluate("document.documentElement.scrollWidth") <= 390
    own = page.page.locator('[role="tab"][aria-selected="true"]').bounding_box()
    assert 0 <= own["x"] < own["x"] + own["width"] <= 390  # the tabs are moved to the last one
    page.page.fill('[data-answer="H"]', "6o")
    page.page.click('[data-act="mark"]')
    page.until("gruebler.root.querySelector('#hint-H').textContent.includes('6o')")
    assert page.page.locator("[id=hint-H]").inner_text() == "Erwartet wird eine Zahl in mm, nicht 6o"
    figure, field = (page.page.locator(part).bounding_box() for part in (".task svg", '[data-answer="l_a"]'))
    assert figure["y"] + figure["height"] < field["y"]


@pytest.mark.parametrize(("width", "height"), [(390, 844), (1024, 768)])
def test_the_verdict_is_in_sight_and_read_out(exercises, width, height):
    """Below four answers with their hints; a reader of the screen is told what changes in a place that is there."""
    page = exercises(width=width, height=height, touch=width < 500)
    view = page.page
    begin(page, "mobility", 7)
    view.locator("input[data-answer]").first.fill("5")
    verdict = view.locator("[data-result]")
    assert verdict.get_attribute("role") == "status"
    assert verdict.text_content() == ""
    said = """gruebler.root.querySelector("[data-result]"), new MutationObserver((found) => {
        window.told = found.map(({ target }) => target.isConnected); })"""
    view.evaluate(f"(([place, watch]) => watch.observe(place, {{ childList: true }}))([{said}])")
    view.locator('[data-act="mark"]').focus()
    view.keyboard.press("Enter")
    page.until("gruebler.root.querySelector('[data-result]').textContent")
    assert verdict.inner_text() == "0 of 4 right"
    assert view.evaluate("told").pop() is True
    box = verdict.bounding_box()
    assert box["y"] > height / 2
    assert box["y"] + box["height"] <= height
    assert (
        view.evaluate(
            "gruebler.root.activeElement?.dataset.act ?? gruebler.root.getRootNode().activeElement.dataset.act"
        )
        == "mark"
    )
    view.evaluate("gruebler.root.querySelector('.solution').scrollIntoView({ block: 'end' })")
    last, box = (part.bounding_box() for part in (view.locator(".answer").last, verdict))
    assert last["y"] + last["height"] + 4 <= box["y"]
    view.locator('[data-answer="F"]').focus()  # what is typed into is not under the bar
    field, bar = (view.locator(part).bounding_box() for part in ('[data-answer="F"]', ".shown .go"))
    assert field["y"] + field["height"] <= bar["y"]


@pytest.mark.parametrize(("width", "height"), [(1440, 900), (390, 844)])
def test_that_an_answer_is_missing_is_said_beside_the_button_and_hides_nothing(exercises, width, height):
    page = exercises(width=width, height=height, touch=width < 500)
    begin(page, "mobility", 7)
    page.page.click('[data-act="mark"]')
    said = page.page.locator("[data-result]")
    assert said.inner_text() == "Give at least one answer."
    assert page.page.locator(".message").is_hidden()
    box = said.bounding_box()
    assert 0 < box["x"] < box["x"] + box["width"] <= width
    assert box["y"] + box["height"] <= height
    for act in ("mark", "next"):
        button = page.page.locator(f'[data-act="{act}"]').bounding_box()
        apart = button["x"] + button["width"] <= box["x"] or button["y"] + button["height"] <= box["y"]
        assert apart or box["y"] + box["height"] <= button["y"]


@pytest.mark.parametrize("lang", ["en", "de"])
@pytest.mark.parametrize("id", ["velocity-2-1", "grashof-1-1", "dyad-1-1", "spherical-grashof-1-1", "differential-3-1"])
def test_formulas_have_minus_signs_and_primes(id, lang):
    """No hyphen before a quantity or between two, no quotation marks after one: -ω·a, l' + l''."""
    task = task_record(id, lang)
    wrong = marked_task(id, {each["key"]: (each["choices"] or ["12345"])[0] for each in task["asked"]}, lang)
    texts = [task["task"], task["remark"], *(each["name"] for each in task["asked"])]
    texts += [mark["hint"] for mark in wrong["marks"]]
    for part in wrong["solution"]:
        texts += [part["text"], part["formula"], *(cell for row in part["rows"] for cell in row)]
    typed = re.compile(r"(?<![\w)])-|(?<= )-(?= )|(?<!\w)\w'(?!\w)|''")
    assert not [text for text in texts if typed.search(text)]
    assert any("−" in text or "′" in text for text in texts)


def test_the_hint_is_in_sight(exercises):
    """On a phone the last answer is wrong alone."""
    page = exercises(width=390, height=844, touch=True)
    view = page.page
    begin(page, "mobility", 7)
    for key, value in solve(exercise("mobility-1-7")).results.items():
        view.locator(f'[data-answer="{ascii_key(key)}"]').fill("9" if key == "F" else str(value.value))
    lower = "(part) => gruebler.root.querySelector(part).getBoundingClientRect()"
    gap = f"({lower})('.shown .go').top - ({lower})('[data-answer=F]').bottom"
    view.mouse.move(200, 300)
    view.mouse.wheel(0, 2 - view.evaluate(gap))  # the last answer just above the bar
    page.until(f"Math.abs({gap} - 2) < 3")
    view.locator('[data-answer="F"]').press("Enter")
    page.until("gruebler.root.querySelector('[data-result]').textContent")
    assert view.locator("[data-mark=wrong]").count() == 1
    hint, bar = (view.locator(part).bounding_box() for part in ("[id=hint-F]", ".shown .go"))
    assert hint["y"] + hint["height"] <= bar["y"]


@pytest.mark.parametrize(("width", "height"), [(1440, 900), (390, 844)])
def test_beside_a_long_solution_the_figure_stays_and_the_next_task_begins_at_its_heading(exercises, width, height):
    page = exercises(width=width, height=height, touch=width < 500)
    view = page.page
    begin(page, "velocity", 3, 3)
    view.locator('[data-answer="v_B"]').fill("1")
    view.click('[data-act="mark"]')
    view.click(".solution summary")
    view.locator(".solution > div").last.scroll_into_view_if_needed()
    assert (view.locator(".task figure").bounding_box()["y"] > 0) is (width > 500)
    view.click('[data-act="next"]')
    page.until(f"{KIND}.task.id === 'velocity-3-4'")
    assert 0 <= view.locator(".task h2").bounding_box()["y"] < height / 2


def test_the_velocity_is_asked_where_the_linkage_then_stands(exercises):
    page = exercises()
    begin(page, "velocity", 3)
    angle = page.page.locator(".task p").first.inner_text().replace("\xa0", " ").split("φ = ")[1].split("°")[0]
    page.page.locator('[data-answer="v_B"]').fill("1")
    page.page.click('[data-act="mark"]')
    page.page.click('[data-act="try"]')
    page.until("gruebler.view === 'motion'")
    assert page.page.evaluate("gruebler.motion.linkage.drives[0] * 180 / Math.PI") == pytest.approx(float(angle))


@pytest.mark.parametrize(("width", "height"), [(1440, 900), (390, 844)])
def test_marks_and_hints_move_no_button(exercises, width, height):
    """Hints stand beside what is typed and above a choice; on a phone the bar keeps its height in its place."""
    page = exercises(width=width, height=height, touch=width < 500)
    view = page.page
    bar = ".shown .go"
    for kind in ("mobility", "grashof"):
        begin(page, kind, 7)
        for field in view.locator("input[data-answer]").all():
            field.fill("9")
        for group in view.locator("div[data-answer]").all():
            group.locator("button").last.click()
        rows = "[...gruebler.root.querySelectorAll('.answer')].map((one) => one.offsetHeight)"
        before, place = view.evaluate(rows), view.locator(bar).bounding_box()
        view.click('[data-act="mark"]')
        view.locator("[id^=hint-]").first.wait_for()
        page.until("gruebler.root.querySelector('[data-result]').textContent")
        if width > 500:
            assert view.evaluate(rows) == pytest.approx(before, abs=13)  # a choice with two lines of a hint
        assert view.locator(bar).bounding_box()["height"] == place["height"]
        assert view.locator(".answer > [id^=hint-]").count() > 1


@pytest.mark.parametrize(("lang", "words"), [("en", ["Structure", "Motion"]), ("de", ["Struktur", "Bewegung"])])
def test_what_is_tried_says_where_it_opens(lang, words):
    ids = ["mobility-1-3", "grashof-1-3", "exercise-5"]
    tasks = [task_record(id, lang) for id in ids]
    tries = [task["tries"] for task in tasks]
    assert [len(one) for one in tries] == [len(tried_task(id)) for id in ids]
    assert words[0] in tries[0][0]
    assert words[1] in tries[1][0]
    assert words[1] in tasks[2]["trial"]  # once, before several
    assert tries[2] == [figure["name"] for figure in tasks[2]["figures"]]  # each says which one
    assert task_record("universal-joint-1-3", lang)["trial"] == ""  # nothing can be tried
