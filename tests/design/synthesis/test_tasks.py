"""Tasks: sound or not constructed, and the same after a file."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis import (
    DeadCentreTask,
    FunctionLaw,
    FunctionTask,
    PathTask,
    PositionTask,
    function_task,
)
from gruebler.files.tasks import read_task, task_from_json, task_to_json, write_task

FIVE = [(k, k * k, 0.3 * k) for k in range(5)]
numbers = st.floats(-1e6, 1e6, allow_subnormal=False)
angles = st.floats(-math.pi, math.pi)
swings = st.floats(0.1, 2)


@st.composite
def tasks(draw):
    kind = draw(st.integers(0, 5))
    count = draw(st.integers(2, 6))
    xs = [k * 10 + draw(st.floats(-4, 4)) for k in range(count)]
    ys = draw(st.lists(numbers, min_size=count, max_size=count))
    turned = draw(st.lists(angles, min_size=count, max_size=count))
    points = list(zip(xs, ys, strict=True))
    if kind == 0:
        picks = {"moving_pivots": points[:1], "fixed_pivots": points[:2]} if count < 5 and draw(st.booleans()) else {}
        places = draw(st.lists(st.floats(0, 1), max_size=3)) if picks and count == 4 else []
        rows = [(x, y, a) for (x, y), a in zip(points, turned, strict=True)]
        return PositionTask(rows, **picks, curve_parameters=places)
    if kind == 1:
        return PathTask(points, angles=tuple(a if k % 2 else None for k, a in enumerate(turned)))
    if kind == 2:
        return PathTask(points, crank_angles=tuple(0.3 * k + 0.01 * draw(st.floats(0, 1)) for k in range(count)))
    if kind == 3:
        return FunctionTask([0.1 * k + 0.01 * draw(st.floats(0, 1)) for k in range(count)], outputs=turned)
    if kind == 4:
        starts = draw(st.tuples(*[st.none() | angles] * 2))
        law = FunctionLaw(
            "log10(x) + x^2",
            interval=(1, draw(st.floats(1.5, 3))),
            input_swing=draw(swings),
            output_swing=draw(swings),
            input_start=starts[0],
            output_start=starts[1],
        )
        return function_task(law, draw(st.integers(2, 5)), output=draw(st.sampled_from(["angle", "travel"])))
    return DeadCentreTask(swing=draw(st.floats(0.01, 3)), time_ratio=draw(st.floats(1, 5)))


@given(tasks(), st.sampled_from(["toml", "json", "csv"]))
def test_files_give_the_task_back(tmp_path_factory, task, form):
    path = tmp_path_factory.mktemp("task") / f"task.{form}"
    more = {"function"} & task_to_json(task).keys() | {"moving_pivots", "curve_parameters"} & task_to_json(task).keys()
    if form == "csv" and more:
        with pytest.raises(SynthesisError, match=f"a CSV file has no columns for .*{more.pop()}"):
            write_task(path, task)
        return
    write_task(path, task)
    assert read_task(path) == task
    assert task_from_json(task_to_json(task)) == task


def test_a_csv_file_with_semicolons_has_decimal_commas(tmp_path):
    commas, points = tmp_path / "commas.csv", tmp_path / "points.csv"
    commas.write_text("\ufeffx;y;angle\n0,0;0,0;0,0\n1,0;0,5;20\n2;-0,4;4,5e1\n", encoding="utf-8")
    points.write_text("x,y,angle\n0,0,0\n1,0.5,20\n2,-0.4,45\n", encoding="utf-8")
    assert read_task(commas) == read_task(points)
    commas.write_text("1,5;2\n2,5;3\n", encoding="utf-8")
    assert read_task(commas).points == ((1.5, 2.0), (2.5, 3.0))


def test_a_csv_file_without_a_header_is_points_or_positions(tmp_path):
    """Two columns are points, three positions; an empty angle is free."""
    for text, header in (
        ("0,1\n2,3\n5,4\n", "x,y"),
        ("0,1,0\n2,3,20\n", "x,y,angle"),
        ("0,1,0\n2,3,\n4,4,9\n", "x,y,angle"),
    ):
        bare, named = tmp_path / "bare.csv", tmp_path / "named.csv"
        bare.write_text(text, encoding="utf-8")
        named.write_text(f"{header}\n{text}", encoding="utf-8")
        assert read_task(bare) == read_task(named)
    assert isinstance(read_task(bare), PathTask)
    assert read_task(bare).angles[1] is None


def test_none_stands_for_what_is_not_given():
    points = [(0, 0), (1, 2), (3, 1)]
    assert PathTask(points, angles=None, crank_angles=None, fixed_pivots=None) == PathTask(points)
    plain = PositionTask(FIVE[:4], moving_pivots=None, fixed_pivots=None, curve_parameters=None)
    assert plain == PositionTask(FIVE[:4])


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: PositionTask([(0, 0, 0), (1, 1, 1), (0, 0, 2 * math.pi)]), "positions 1 and 3 are equal"),
        (lambda: PositionTask([(0, 0, 0)]), "at least two"),
        (lambda: PathTask([(0, 0), (1, 1), (0, 1e-12)]), "points 1 and 3 are equal"),
        (lambda: PositionTask(FIVE, moving_pivots=[(0, 0)]), "two to four positions, .* not these for 5"),
        (lambda: PositionTask(FIVE[:3], curve_parameters=[0.5]), "belong to four positions, not to 3"),
        (lambda: PositionTask(FIVE[:4], curve_parameters=[0.5, 1.5]), "curve_parameters 2: expected 0 to 1"),
        (lambda: PathTask([(0, 0), (1, 1), (2, 1)], crank_angles=(0, 0.5, 0.4)), "contradictory"),
        (lambda: PathTask([(0, 0), (1, 1), (2, 1)], crank_angles=(0, 4, 7)), "within one turn"),
        (lambda: PathTask([(0, 0), (1, 1)], fixed_pivots=[(1, 1), (1, 1)]), "coincide"),
        (lambda: FunctionTask([0, 0.5, 0.5], outputs=[1, 2, 3]), "inputs 2 and 3 are equal"),
        (lambda: FunctionTask([0, 0.5], outputs=[1, 2, 3]), "as many inputs as outputs"),
        (lambda: DeadCentreTask(swing=1, stroke=2, time_ratio=1), "one of swing and stroke"),
        (lambda: DeadCentreTask(swing=1, time_ratio=0.9), "at least 1"),
        (lambda: DeadCentreTask(swing=4, time_ratio=1), "between 0 and 180"),
        (lambda: PathTask([(0, 0), (1, float("nan"))]), "point 2"),
        (lambda: PathTask(5), "points: expected a list, but found '5'"),
        (lambda: PathTask([(0, 0), (1, 1)], angles="no"), "angles: expected a list"),
        (lambda: PathTask(None), "points: expected at least two, but found 0"),
        (lambda: FunctionTask([0, 0.5], outputs=1), "outputs: expected a list"),
        (
            lambda: function_task(FunctionLaw("x", interval=(0, 1), input_swing=1, output_swing=1), 12),
            "precision_points: expected 2 to 11",
        ),
        (
            lambda: FunctionTask(
                [0, 1], outputs=[0, 1], law=FunctionLaw("x", interval=(0, 1), input_swing=1, output_swing=1)
            ),
            "not those of the function",
        ),
    ],
)
def test_bad_tasks_are_refused_in_one_sentence(make, sentence):
    with pytest.raises(SynthesisError, match=sentence) as error:
        make()
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("name", "text", "sentence"),
    [
        ("a.csv", "x,y,angle\n0,0,0\n1,two,3\n", "line 3, y: expected a number, but found 'two'"),
        ("a.csv", "x,y,angle\n0,0\n", "line 2: expected 3 columns, but found 2"),
        ("a.csv", "x,y,rank\n1,2,3\n", "x,y with any of angle,crank,output,tolerance,weight,order, or input,output"),
        ("a.csv", "0,0,0,0\n1,2,3,4\n", "line 1: expected the names of the columns"),
        ("a.csv", "7\n8\n", "(positions) without them, but found 1 numbers"),
        ("a.csv", "0,0,0\n1,2\n", "line 2: expected 3 columns, but found 2"),
        ("a.csv", "0,0\n1,2\n2,x\n", "line 3, y: expected a number, but found 'x'"),
        ("a.toml", "position = [[0,0,0]]", "a task has positions, points"),
        ("a.toml", "positions = [[0,0,0],[1,1]]", "position 2: expected [x, y, degrees], but found 2 values"),
        ("a.toml", "points = [[0, 0], [1, 2]]\ntolerances = [0, true]", "tolerances 2: expected a number"),
        ("a.toml", "points = [[0, 0], [1, 'two']]", "point 2: expected a number, but found 'two'"),
        ("a.json", '{"points": [[0, 0], [1, 1]], "closd": true}', "did you mean 'closed'"),
        ("a.toml", 'function = "log10(y)"\ninterval = [1, 2]\ninput_swing = 60\noutput_swing = 60', "unknown name 'y'"),
        ("a.toml", 'function = "x"\ninterval = [1, 2, 3]\ninput_swing = 60\noutput_swing = 60', "interval"),
        (
            "a.toml",
            'function = "x"\ninterval = [1, 2]\ninput_swing = "wide"\noutput_swing = 60',
            "input_swing: expected",
        ),
        ("a.toml", 'function = "x"\ninterval = [1, 2]\noutput_swing = 60', "input_swing"),
        ("a.txt", "", ".toml, .json or .csv"),
    ],
)
def test_bad_files_are_refused_with_their_place(tmp_path, name, text, sentence):
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    with pytest.raises(SynthesisError) as error:
        read_task(path)
    assert sentence in str(error.value)
    assert str(path) in str(error.value)


def test_a_table_too_large_is_refused_rather_than_cut(tmp_path):
    path = tmp_path / "long.csv"
    path.write_text("x,y\n" + "1.5,2.5\n" * 300_000, encoding="utf-8")
    with pytest.raises(SynthesisError, match=r"long\.csv: larger than 2,000,000 bytes"):
        read_task(path)
