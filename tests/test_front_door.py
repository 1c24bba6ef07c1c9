"""What `import gruebler as gr` gives: every name opens, shorthands are taken everywhere, mistakes are one sentence."""

import ast
import importlib
import inspect
import re
from graphlib import TopologicalSorter
from itertools import pairwise
from operator import attrgetter
from pathlib import Path

import numpy as np
import pytest

import gruebler as gr
from gruebler.base.text import error_in_language
from gruebler.cli.commands import GROUPS
from gruebler.design.synthesis import DeadCentreTask, PathTask
from gruebler.teaching.catalog import entry
from gruebler.teaching.sheets.layout import page

CRANK_ROCKER = gr.FourBar(25, 70, 40, 70)
SHORTHANDS = [CRANK_ROCKER, gr.SliderCrank(20, 70, 8), gr.InvertedSliderCrank(30, 50)]


def documented_functions():
    """Every function of the library with a docstring: its file, its node, the docstring."""
    for path in sorted(Path(gr.__file__).parent.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.FunctionDef) and (text := ast.get_docstring(node)):
                yield path, node, text


def test_arguments_in_docstrings_exist():
    checked = 0
    for path, node, text in documented_functions():
        section = re.search(r"^Args:\n((?: +.*(?:\n|\Z)|\n)*)", text, re.MULTILINE)
        rows = re.findall(r"^ {4}((?:\*{0,2}\w+(?:, )?)+):", section[1] if section else "", re.MULTILINE)
        named = {name.lstrip("*") for row in rows for name in row.split(", ")}
        given = node.args
        known = {a.arg for a in (*given.posonlyargs, *given.args, *given.kwonlyargs, given.vararg, given.kwarg) if a}
        assert named <= known, f"{path.name} {node.name}: {named - known}"
        checked += len(named)
    assert checked > 300


def names_by_room():
    stub = ast.parse(Path(gr.__file__).with_suffix(".pyi").read_text(encoding="utf-8"))
    return [node for node in stub.body if isinstance(node, ast.ImportFrom)]


def test_every_name_opens_and_is_listed_once():
    listed = [alias.name for node in names_by_room() for alias in node.names]
    assert sorted(listed) == sorted(set(listed)) == sorted(gr.__all__)
    assert all(getattr(gr, name) is not None for name in listed)
    assert len([name for node in names_by_room() if node.module for name in node.names]) <= 64


def test_every_name_of_a_wing_and_a_room_opens():
    folder = Path(gr.__file__).parent
    stubs = sorted(path for path in folder.rglob("__init__.pyi") if path.parent != folder)
    assert len(stubs) > 9
    for stub in stubs:
        module = importlib.import_module(".".join(["gruebler", *stub.parent.relative_to(folder).parts]))
        assert [name for name in module.__all__ if getattr(module, name, None) is None] == [], module.__name__


def test_another_name_says_which_was_meant():
    for wrong, meant in {"synthesize": "synthesise", "mov": "move", "Fourbar": "FourBar"}.items():
        with pytest.raises(AttributeError) as caught:
            getattr(gr, wrong)
        assert str(caught.value) == f"gruebler has no attribute {wrong!r} (did you mean {meant!r}?)"
        assert caught.value.obj is None  # else Python adds its own suggestion
    assert not hasattr(gr, "__wrapped__")


def test_the_text_of_a_long_chain_is_read():
    text = " ".join(f"R(link{k}-link{(k + 1) % 40})" for k in range(40))
    assert len(text) > 255  # longer than the name of a file may be
    assert gr.read(text) == gr.Chain.parse(text)


@pytest.mark.parametrize("lengths", SHORTHANDS, ids=lambda lengths: type(lengths).__name__)
def test_lengths_are_taken_wherever_a_linkage_is(lengths, tmp_path):
    linkage = lengths.linkage()
    assert (gr.move(lengths, [1.0]).places == gr.move(linkage, [1.0]).places).all()
    assert gr.measures(lengths).travel == gr.measures(linkage).travel
    assert gr.circuit(lengths).closed == gr.circuit(linkage).closed
    assert gr.drive_range(lengths).full == gr.drive_range(linkage).full
    assert [row.joint for row in gr.rotatability(lengths)] == [row.joint for row in gr.rotatability(linkage)]
    assert gr.freedoms(lengths).mobility == 1
    assert gr.assembly_modes(lengths, 1.0) == gr.assembly_modes(linkage, 1.0)
    without_unit = lengths.linkage(unit="")
    assert gr.draw(lengths).svg() == gr.draw(without_unit).svg()
    assert gr.plot(lengths, "transfer").svg() == gr.plot(without_unit, "transfer").svg()
    assert " in mm" not in gr.plot(lengths, "transfer").svg()
    gr.write(lengths, tmp_path / "a.toml")
    assert gr.read(tmp_path / "a.toml").mechanism == linkage.mechanism


def test_a_point_is_named_as_on_the_command_line():
    motion = gr.move(CRANK_ROCKER.linkage({"K": (45, 40)}), gr.from_degrees(0, 360, 30))
    np.testing.assert_allclose(motion.point("coupler:45,40"), motion.point("K"), atol=1e-12)
    with pytest.raises(gr.GrueblerError, match=r"there is no link 'couple' .did you mean 'coupler'"):
        motion.point("couple:45,40")


def test_assembly_modes_are_those_of_one_pose():
    with pytest.raises(gr.GrueblerError, match="expected a value for each drive, but found 2 rows of values"):
        gr.assembly_modes(CRANK_ROCKER, [1, 5])
    with pytest.raises(gr.GrueblerError, match="expected a value for each drive, but found 2 rows of values"):
        gr.assembly_modes(gr.read("cardan_shaft"), [1, 5])


def test_assembly_modes_are_branches():
    modes = gr.assembly_modes(entry("wiper").linkage(), 0.4)
    assert len(modes) == len(set(modes)) > 1
    for mode in modes:
        pose = gr.move(entry("wiper").linkage(), [0.4], branch=mode)
        assert pose.complete
        assert "".join(pose.branch) == mode.replace(",", "")


def test_counting_takes_what_listing_takes():
    for request in ({}, {"fractionated": "all"}, {"multiple_joints": "any"}, {"assortment": (4, 4)}):
        assert gr.count_chains(8, **request).chains == len(list(gr.chains(8, **request)))


@pytest.mark.parametrize("suffix", ["json", "txt", "g6"])
def test_chains_come_back_from_files(suffix, tmp_path):
    chains = list(gr.chains(8))
    path = gr.write(chains, tmp_path / f"chains.{suffix}")
    assert [gr.code(chain) for chain in gr.read(path)] == [gr.code(chain) for chain in chains]


@pytest.mark.parametrize("task", [DeadCentreTask(stroke=50, time_ratio=1.2), PathTask([(0, 0), (1, 2), (3, 1)])])
def test_tasks_come_back_from_files(task, tmp_path):
    assert gr.read(gr.write(task, tmp_path / "task.toml")) == task


def test_trains_and_joint_screws_are_read(tmp_path):
    path = tmp_path / "train.toml"
    path.write_text('train = "sun:24 planet:18 ring:-60 on arm"\nhold = ["ring"]\ndrive.sun = 1000\n', encoding="utf-8")
    assert gr.read(path).train.mobility == 2


@pytest.mark.parametrize("suffix", ["svg", "html", "png"])
@pytest.mark.parametrize("value", [CRANK_ROCKER, gr.Geneva(4)], ids=["linkage", "geneva"])
def test_animations_are_saved_by_their_ending(value, suffix, tmp_path):
    path = gr.animate(value, seconds=0.2).save(tmp_path / f"a.{suffix}")
    begin = {"svg": b"<svg", "html": b"<!doctype html>", "png": b"\x89PNG"}[suffix]
    assert path.read_bytes()[:15].lower().startswith(begin.lower())


CHAIN = gr.Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)")
TASK = DeadCentreTask(stroke=50, time_ratio=1.2)
MECHANISM = gr.Mechanism(CHAIN, "0", [0])


def test_what_a_user_guesses_first_works(tmp_path):
    assert gr.read("wiper").mechanism == entry("wiper").linkage().mechanism
    assert gr.read("bennett").mechanism == entry("bennett").placed().mechanism  # in space, by its screws
    assert gr.read("four-bar:25,70,40,70") == gr.read("25,70,40,70") == CRANK_ROCKER.linkage()
    assert gr.read(str(CHAIN)) == CHAIN
    assert gr.read("sun:24 planet:18 ring:-60 on arm").train.mobility == 2
    assert gr.read(str(MECHANISM)) == MECHANISM
    motion = gr.move(CRANK_ROCKER.linkage({"K": (45, 40)}), gr.from_degrees(0, 360, 1), speed=gr.rpm(60))
    steps = np.gradient(motion.point("K"), 1 / 360, axis=0)[5:-5]  # a turn a second, by differences
    np.testing.assert_allclose(motion.velocity("K")[5:-5], steps, rtol=0, atol=0.1)
    steps = np.gradient(motion.velocity("K"), 1 / 360, axis=0)[5:-5]
    np.testing.assert_allclose(motion.acceleration("K")[5:-5], steps, rtol=0, atol=2)
    frame = motion.to_dataframe()
    assert len(frame) == 361
    assert gr.plot(motion).svg() == gr.plot(motion.linkage, between=(0, 2 * np.pi)).svg()
    assert gr.draw(CHAIN).save(tmp_path / "x.png").read_bytes()[:4] == b"\x89PNG"
    assert gr.Chain.from_networkx(CHAIN.to_networkx()) == CHAIN
    assert gr.Mechanism.from_networkx(MECHANISM.to_networkx()) == MECHANISM


FOUND_A_MECHANISM = "expected Chain, but found Mechanism: take its chain"
MISTAKES = [
    (lambda: gr.Chain.parse(5), "text: expected a text, but found 5"),
    (lambda: gr.draw(CRANK_ROCKER, curvs=["K"]), "no option 'curvs' (did you mean 'curves'?)"),
    (lambda: gr.move(CHAIN, [0.0]), "a Chain has no dimensions: realise(mechanism) finds some"),
    (lambda: gr.move(gr.FourBar, [0.0]), "expected a linkage, a FourBar"),
    (lambda: gr.motion_roles(entry("loco3").placed()), "expected a planar linkage, but found a SpatialLinkage"),
    (lambda: gr.inversions(CRANK_ROCKER), "but found FourBar: take its linkage().mechanism.chain"),
    (lambda: gr.code(CRANK_ROCKER.linkage()), "but found Linkage: take its mechanism.chain"),
    (lambda: gr.decompose(CRANK_ROCKER.linkage()), "but found Linkage: take its mechanism"),
    (lambda: gr.move(CRANK_ROCKER, None), "drives: expected numbers (radians, or lengths), but found None"),
    (lambda: gr.move(CRANK_ROCKER, "30"), "drives: expected numbers (radians, or lengths), but found '30'"),
    (lambda: gr.move(CRANK_ROCKER, True), "drives: expected numbers (radians, or lengths), but found True"),
    (lambda: gr.Chain([("R", ["a", "b"])]), "unknown pair 'R': expected a full name such as 'revolute'"),
    (lambda: gr.read("wipr"), "'wipr' is no file and no entry of the catalog (did you mean 'wiper'?)"),
    (lambda: gr.read("four-bar:25,70"), "four-bar: expected a,b,c,d, but found 2 numbers"),
    (
        lambda: gr.move("wiper", [0.0]),
        "InvertedSliderCrank, but found 'wiper'; gr.read('wiper') reads what it stands for",
    ),
    (lambda: gr.draw("wiper"), "a text has no picture; gr.read('wiper') reads what it stands for"),
    (lambda: gr.code("wiper"), "expected Chain, but found 'wiper'; gr.read('wiper') reads what it stands for"),
    (lambda: gr.Train("sun:24 planet:18"), "; gr.read('sun:24 planet:18') reads what it stands for"),
    (lambda: gr.move(CRANK_ROCKER, 1.0, speed="10"), "speed: expected finite numbers, but found '10'"),
    (lambda: gr.move(CRANK_ROCKER, 1.0, speed=1, jerk=["1"]), "jerk: expected finite numbers, but found ['1']"),
    (lambda: gr.move_many([CRANK_ROCKER.linkage()], 1.0, speed="10"), "speed: expected finite numbers, but found '10'"),
    (lambda: gr.measures(CRANK_ROCKER, speed="10"), "speed: expected a number, but found '10'"),
    (lambda: gr.draw(7), "values of type int have no picture"),
    (lambda: gr.draw(CRANK_ROCKER, poses=3), "draw has no option 'poses'"),
    (
        lambda: gr.draw(CRANK_ROCKER, teeth=True),
        "the picture of a FourBar has no option 'teeth'; it has loads, branch, ",
    ),
    (lambda: gr.animate(gr.Geneva(4), curves=["K"]), "the moving picture of a Geneva has no option 'curves'"),
    (lambda: gr.plot(CRANK_ROCKER, points=["K"]), "the diagram 'transfer' has no option 'points'; it has output"),
    (
        lambda: gr.synthesise(DeadCentreTask(stroke=1, time_ratio=1.2), minimax=True),
        "has no option 'minimax'; it has number",
    ),
    (lambda: gr.measures(CRANK_ROCKER, sped=1), "measures has no option 'sped' (did you mean 'speed'?)"),
    (lambda: gr.animate(CHAIN), "values of type Chain have no moving picture"),
    (lambda: gr.plot(CRANK_ROCKER, "transmision"), "there is no plot 'transmision' (did you mean 'transmission'?)"),
    (lambda: gr.draw(CRANK_ROCKER).save("x.bmp"), "end it with .svg, .png, .pdf or .tex"),
    (lambda: gr.write("x.toml", CRANK_ROCKER), "the value comes first, then 'x.toml'"),
    (lambda: gr.write(CRANK_ROCKER, 7), "path: expected a text or PathLike, but found 7"),
    (lambda: gr.write(7, "x.toml"), "values of type int cannot be written"),
    (lambda: gr.write(CHAIN, "x.toml"), "chains go to .json, .txt or .g6, not '.toml'"),
    (lambda: gr.read("four-bar:25,70,40,70:3"), "four-bar: expected numbers a,b,c,d, but found '25,70,40,70:3'"),
    (lambda: gr.read("four-bar"), "'four-bar' is no file and no entry of the catalog; lengths are written"),
    (lambda: gr.read(""), "no file is named; expected a file, a catalog entry"),
    (lambda: gr.read(".."), ".. is a folder; expected a file"),
    (lambda: gr.read(Path()), ". is a folder; expected a file"),
    (lambda: gr.write(CRANK_ROCKER, Path.cwd()), " is a folder; expected a file"),
    (lambda: gr.read("a" * 5000), "is no file and no entry of the catalog"),
    (lambda: gr.read(7), "path: expected a text or PathLike, but found 7"),
    (lambda: gr.read("x.bmp"), "x.bmp: expected .toml, .json, .csv, .txt, .g6,"),
    (lambda: gr.read("missing.g6"), "missing.g6: cannot be read"),
    (
        lambda: gr.synthesise(7),
        "task: expected PositionTask, PathTask, FunctionTask, DeadCentreTask or DwellTask, but found 7",
    ),
    (lambda: gr.mobility_report("R(0-1)"), "expected Chain, but found 'R(0-1)'"),
    *(
        (lambda function=function: function(MECHANISM), FOUND_A_MECHANISM)
        for function in (gr.mobility_report, gr.code, gr.symmetry, gr.inversions, gr.derive, gr.extend)
    ),
    (lambda: list(gr.driven_mechanisms(MECHANISM)), FOUND_A_MECHANISM),
    (lambda: gr.is_isomorphic(CHAIN, MECHANISM), FOUND_A_MECHANISM),
    (lambda: gr.decompose(CHAIN), "expected Mechanism, but found Chain"),
    (lambda: gr.realise(CHAIN), "expected Mechanism, but found Chain"),
    (lambda: gr.statics(CRANK_ROCKER, gr.Loads(moments={"rocker": 1})), "expected Motion, but found FourBar"),
    (lambda: gr.statics(gr.move(CRANK_ROCKER, [0.0]), None), "loads: expected Loads, but found None"),
    (lambda: list(gr.variants(4)), "requirements: expected Requirements, but found 4"),
]


@pytest.mark.parametrize(("call", "words"), MISTAKES, ids=[words for _, words in MISTAKES])
def test_mistakes_are_one_sentence(call, words):
    with pytest.raises(gr.GrueblerError) as caught:
        call()
    assert words in str(caught.value)
    assert error_in_language(caught.value, "de")


@pytest.mark.parametrize(
    "call",
    [
        lambda: gr.Geneva(4, 100),
        lambda: gr.Requirements(8, 1, 2),
        lambda: gr.measures(CRANK_ROCKER, 60, "+"),
        lambda: gr.Loads({}, {}, {"K": 1}),
    ],
    ids=["Geneva", "Requirements", "measures", "Loads"],
)
def test_what_is_easily_misplaced_has_its_name(call):
    with pytest.raises(TypeError, match="positional"):
        call()


def test_values_of_many_numbers_are_printed_in_a_line():
    motion = gr.move(CRANK_ROCKER, gr.from_degrees(0, 360, 1))
    for value in (motion, gr.circuit(CRANK_ROCKER), gr.draw(CRANK_ROCKER), gr.measures(CRANK_ROCKER)):
        assert "\n" not in repr(value)
        assert len(repr(value)) < 1500


@pytest.mark.parametrize(
    "size", [gr.FourBar(25, 70, 40, 70), gr.SliderCrank(25, 70), gr.InvertedSliderCrank(25, 70)], ids=repr
)
def test_lengths_show_themselves_in_notebooks_as_their_linkage(size):
    assert size._repr_svg_() == size.linkage()._repr_svg_()
    assert size._repr_svg_().startswith("<svg")


def test_reports_and_sheets_show_themselves_in_notebooks():
    report = gr.mobility_report(gr.Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)"))
    html = report._repr_html_()
    assert html.startswith(report.chain._repr_svg_())
    assert "F = 3(n - 1) - 2 g1 = 3(4 - 1) - 2·4 = 1" in html
    mzc = gr.teaching.sheet("mzc")
    assert mzc._repr_svg_() == page(mzc).svg()
    assert f"<title>{mzc.record.title}</title>" in mzc._repr_svg_()


# --- the form of the front door -------------------------------------------------------------------

FUNCTIONS = [name for name in gr.__all__ if inspect.isfunction(inspect.unwrap(getattr(gr, name)))]
COMMANDS = [command.name.replace("-", "_") for _, commands in GROUPS for command in commands]
# Optional arguments that are taken by place: a class of chains is (links, mobility), a diagram has its kind.
BY_PLACE = {
    "chains": {"mobility"},
    "count_chains": {"mobility"},
    "plot": {"kind"},
}
SECTIONS = ["Args", "Returns", "Raises", "Cost", "Example", "See Also", "Theory"]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_options_are_given_by_name_and_the_language_last(name):
    options = inspect.signature(getattr(gr, name)).parameters.values()
    placed = {p.name for p in options if p.kind is p.POSITIONAL_OR_KEYWORD and p.default is not p.empty}
    assert placed == BY_PLACE.get(name, set())
    assert all(p.kind in (p.POSITIONAL_OR_KEYWORD, p.KEYWORD_ONLY) for p in options)  # no names that an editor misses
    named = [p.name for p in options]
    assert "lang" not in named or named[-1] == "lang"


def test_two_names_of_arguments_follow_each_other_in_one_order_everywhere():
    """There is an order of all names, such that every function has its own in this order."""
    before = {}
    for function in FUNCTIONS:
        for first, second in pairwise(inspect.signature(getattr(gr, function)).parameters):
            before.setdefault(second, set()).add(first)
    order = [*TopologicalSorter(before).static_order()]
    assert len(order) > 60


@pytest.mark.parametrize("name", FUNCTIONS)
def test_docstrings_have_all_sections(name):
    text = inspect.getdoc(getattr(gr, name))
    assert text.split("\n")[0].endswith(".")
    assert re.findall(r"^(\w[\w ]+):\n", text, re.MULTILINE) == SECTIONS
    section = dict(zip(SECTIONS, re.split(r"^\w[\w ]+:\n", text, flags=re.MULTILINE)[1:], strict=True))
    parameters = inspect.signature(getattr(gr, name)).parameters
    described = re.findall(r"^ {4}((?:\w+(?:, )?)+):", section["Args"], re.MULTILINE)
    assert [word for words in described for word in words.split(", ")] == list(parameters)
    assert ">>>" in section["Example"]
    assert all(text for text in section.values())
    for other in re.findall(r"`([\w.]+)`", section["See Also"]):
        first, _, rest = other.partition(".")
        assert first != name
        assert hasattr(getattr(gr, first), rest) if rest else hasattr(gr, first)
    (page,) = re.findall(r"docs/theory/[\w-]+\.md", section["Theory"])
    assert (Path(__file__).parents[1] / page).is_file()


CLASSES = [name for name in gr.__all__ if inspect.isclass(getattr(gr, name))]


@pytest.mark.parametrize("name", CLASSES)
def test_classes_say_what_is_like_them_and_where_their_theory_stands(name):
    text = inspect.getdoc(getattr(gr, name))
    section = dict(re.findall(r"^(See Also|Theory):\n    (.+)$", text, re.MULTILINE))
    others = re.findall(r"`(\w+)`", section["See Also"])
    assert others
    assert set(others) <= {*gr.__all__} - {name}
    if not issubclass(getattr(gr, name), BaseException):
        assert (Path(__file__).parents[1] / section["Theory"]).is_file()


@pytest.mark.parametrize("name", CLASSES)
def test_methods_take_nothing_but_their_subject_by_place(name):
    """What may be left out and is not the first argument is given by name."""
    misplaced = [
        f"{name}.{method}({p.name})"
        for method, function in inspect.getmembers(getattr(gr, name), inspect.isroutine)
        if not method.startswith("_") and hasattr(function, "__annotations__")  # Python's own have none
        for k, p in enumerate(
            p for p in inspect.signature(function).parameters.values() if p.name not in ("self", "cls")
        )
        if k and p.kind is p.POSITIONAL_OR_KEYWORD and p.default is not p.empty
    ]
    assert misplaced == []


def test_names_of_commands_lead_to_names_of_the_library():
    for command in COMMANDS:
        if command not in {"completion", "demo", "gallery", "man"} | {
            *gr.__all__
        }:  # these have no function of their own
            with pytest.raises(AttributeError, match="did you mean") as caught:
                getattr(gr, command)
            meant = re.search(r"mean '(.*)'", str(caught.value))[1]
            assert attrgetter(meant)(gr) is not None
    for wrong, meant in {"analyze": "measures", "motion": "move", "load": "read"}.items():
        with pytest.raises(AttributeError, match=f"did you mean '{meant}'"):
            getattr(gr, wrong)


def test_the_method_is_chosen_and_said():
    for method in ("rank", "pebble", "both"):
        report = gr.mobility_report(CHAIN, method=method)
        assert (report.generic, report.method, report.exact) == (1, method, True)  # a four-bar
    slider = gr.Chain.parse("R(0-1) R(1-2) R(2-3) P(3-0)")
    assert gr.mobility_report(slider).generic == 1
    with pytest.raises(gr.GrueblerError, match="the pebble game cannot answer: no theorem covers prismatic joints"):
        gr.mobility_report(slider, method="both")
    with pytest.raises(gr.GrueblerError, match=r"no method 'pebbles' .did you mean 'pebble'"):
        gr.mobility_report(CHAIN, method="pebbles")


def test_a_linkage_without_a_unit_has_none_anywhere(tmp_path):
    """Columns, reports and files; inertia alone needs to know how long the unit is."""
    size = gr.FourBar(25, 70, 40, 70)
    linkage = size.linkage(unit="")
    motion = gr.move(linkage, gr.from_degrees(0, 360, 30))
    assert [column.unit for column in motion.table(points=["coupler:30,20"]).columns] == ["°", "°", "", ""]
    curve = gr.coupler_curve(size, "coupler:30,20")
    assert curve.explain().startswith("Closed path, 138.2 long, around an area of 1282.\n")
    gr.write(linkage, tmp_path / "a.toml")
    assert gr.read(tmp_path / "a.toml") == linkage
    with pytest.raises(gr.GrueblerError, match=r"inertia needs the unit of the lengths: FourBar\(.*unit='mm'\)"):
        gr.inverse_dynamics(gr.move(linkage, 1.0, speed=10), gr.Loads(bodies={"coupler": gr.RigidBody(1, (30, 0), 1)}))
    with pytest.raises(gr.GrueblerError, match=r"motions and tables go to .csv or .parquet, not '.json'"):
        gr.write(motion, tmp_path / "a.json")


@pytest.mark.parametrize(
    ("call", "hint"),
    [
        (gr.inversions, "linkage().mechanism.chain"),
        (gr.realise, "linkage().mechanism"),
        (gr.decompose, "linkage().mechanism"),
    ],
    ids=["inversions", "realise", "decompose"],
)
def test_what_is_asked_of_lengths_names_the_part_to_pass(call, hint):
    with pytest.raises(gr.GrueblerError, match=rf"found FourBar: take its {re.escape(hint)}$"):
        call(gr.FourBar(2, 5, 4, 5))
