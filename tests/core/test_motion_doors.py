"""Wrong calls of the motion kernels raise; nothing that stands in an array makes them crash."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import gruebler as gr
from gruebler import _core
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics.kernel_records import Conditions
from tests.samples import CLASS_III

ROWS = 12


def call_of(linkage):
    """The arguments of a short motion."""
    calls = []
    with pytest.MonkeyPatch.context() as patch:
        kernel = _core.run_path
        patch.setattr(_core, "run_path", lambda *arguments: calls.append(arguments) or kernel(*arguments))
        gr.move(linkage, np.linspace(0.8, 1.0, ROWS), speed=1.0)
    return [np.ascontiguousarray(a) if isinstance(a, np.ndarray) else a for a in calls[0]]


FOUR_BAR = call_of(FourBar(25, 70, 40, 70).linkage())
GROUP = call_of(CLASS_III)
PIN = Conditions(
    np.zeros(1, np.int64),
    np.zeros((1, 8)),
    np.zeros((0, 14)),
    np.array([-1, 0]),
    np.zeros((2, 1), complex),
    np.ones(2, complex),
    np.zeros((0, 3)),
    1.0,
)


def changed(call, place, value):
    return [value if k == place else argument for k, argument in enumerate(call)]


@pytest.mark.parametrize(
    ("place", "value"),
    [
        (0, None),
        (0, list(FOUR_BAR[0])),
        (1, FOUR_BAR[1].astype(np.float32)),
        (1, FOUR_BAR[1].ravel()),
        (1, np.asfortranarray(np.tile(FOUR_BAR[1], 2))),
        (1, FOUR_BAR[1].tolist()),
        (2, FOUR_BAR[2][0]),
        (3, FOUR_BAR[3].astype(np.int64)),
        (4, None),
        (5, None),
        (5, tuple(a.astype(np.complex64) for a in FOUR_BAR[5])),
    ],
)
def test_wrong_kinds(core, place, value):
    with pytest.raises(TypeError):
        core.run_path(*changed(FOUR_BAR, place, value))


@pytest.mark.parametrize("field", FOUR_BAR[0]._fields)
def test_wrong_fields(core, field):
    with pytest.raises(TypeError, match=rf"program\.{field} is not"):
        core.run_path(*changed(FOUR_BAR, 0, FOUR_BAR[0]._replace(**{field: None})))


@pytest.mark.parametrize(
    ("place", "value", "words"),
    [
        (0, tuple(FOUR_BAR[0])[:14], "15 fields"),
        (0, FOUR_BAR[0]._replace(points=np.zeros(3, complex)), "program.points must have the length"),
        (0, FOUR_BAR[0]._replace(links=FOUR_BAR[0].links + 9), "element 0: there is no link"),
        (0, FOUR_BAR[0]._replace(links=-1 - FOUR_BAR[0].links), "element 0: there is no link"),
        (0, FOUR_BAR[0]._replace(operations=FOUR_BAR[0].operations + 99), "operation 0: there is no kind"),
        (0, FOUR_BAR[0]._replace(conditions=np.array([1])), "do not ascend"),
        (1, np.full((ROWS, 1), np.nan), "finite"),
        (1, FOUR_BAR[1][:0], "at least one row|shapes of one motion"),
        (1, np.zeros((ROWS, 2)), "a row of the path must have the length 1"),
        (2, FOUR_BAR[2][:, :0].copy(), "speeds must have the shape"),
        (2, FOUR_BAR[2][:1], "speeds for the order"),
        (3, np.ones(2), "shapes of one motion"),
        (4, np.ones(2), "shapes of one motion"),
        (5, FOUR_BAR[5][:5], "6 fields"),
        (5, (*FOUR_BAR[5][:5], np.zeros((3, ROWS))), "shapes of one motion"),
    ],
)
def test_wrong_values(core, place, value, words):
    with pytest.raises(ValueError, match=words):
        core.run_path(*changed(FOUR_BAR, place, value))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"owners": GROUP[0].owners + 9}, "body that is not there"),
        ({"kinds": GROUP[0].kinds + 99}, "of no known kind"),
        ({"kinds": GROUP[0].kinds + 9}, "rates are not known"),
        ({"kinds": GROUP[0].kinds + 2}, "as many equations"),
        ({"roots": GROUP[0].roots + 99}, "there is no link"),
        ({"values": GROUP[0].values + 1}, "a law of pieces"),
        ({"values": GROUP[0].values * np.nan}, "a law of pieces"),
        ({"windings": GROUP[0].windings + 2**40}, "pair of unknowns"),
        ({"bodies": np.array([0, 1])}, "do not ascend"),
        ({"bodies": np.array([0, 2**62])}, "do not ascend"),
    ],
)
def test_wrong_groups(core, change, words):
    with pytest.raises(ValueError, match=words):
        core.run_path(*changed(GROUP, 0, GROUP[0]._replace(**change)))


@given(st.data())
def test_any_number_anywhere(core, data):
    """A number of the program is changed: it is refused, or the motion ends somehow."""
    call = data.draw(st.sampled_from([FOUR_BAR, GROUP]))
    field = data.draw(st.sampled_from([name for name in call[0]._fields if name not in ("size", "most")]))
    array = getattr(call[0], field).copy()
    assume(array.size > 0)
    place = data.draw(st.integers(0, array.size - 1))
    if array.dtype.kind == "i":
        array.ravel()[place] = data.draw(st.integers(-2, 9) | st.integers(-(2**63), 2**63 - 1))
    else:
        array.ravel()[place] = data.draw(st.floats())
    try:
        status, reached, _, _ = core.run_path(*changed(call, 0, call[0]._replace(**{field: array})))
    except ValueError:
        status, reached = 0, 0
    assert 0 <= status <= 3
    assert 0 <= reached <= ROWS


@pytest.mark.parametrize("value", [0.0, -0.0, 1e-320, 1e300, -1e308, np.inf, np.nan])
@pytest.mark.parametrize("place", [1, 2, 3, 4])
def test_any_value(core, place, value):
    for call in FOUR_BAR, GROUP:
        array = np.full_like(call[place], value)
        try:
            _, reached, _, _ = core.run_path(*changed(call, place, array))
        except ValueError:
            assert place == 1
            assert not np.isfinite(value)
        else:
            assert 0 <= reached <= ROWS


def test_wrong_conditions(core):
    x = np.zeros(3)
    for changes, words in [
        ({"kinds": np.array([10])}, "of no known kind"),
        ({"owners": np.array([0, 1])}, "a body that is not there"),
        ({"owners": np.array([0, -2])}, "a body that is not there"),
        ({"values": np.ones((1, 8))}, "a law of pieces"),
        ({"values": np.zeros((2, 8))}, "must have the length 1"),
        ({"points": np.zeros((1, 1), complex)}, "must have the length 2"),
        ({"points": np.zeros((2, 0), complex)}, "holds the points"),
        ({"kinds": np.array([8]), "values": np.array([[0, 0, 0, 0.5, 0, 0, 0, 0]])}, "an arm"),
    ]:
        with pytest.raises(ValueError, match=words):
            core.jacobian(PIN._replace(**changes), x)
    with pytest.raises(ValueError, match="three unknowns"):
        core.jacobian(PIN, np.zeros(4))
    with pytest.raises(ValueError, match="as many equations"):
        core.newton(PIN, x, 5)
    with pytest.raises(ValueError, match="the tangent"):
        core.settle_on_curve(PIN, x, np.zeros(2))
    with pytest.raises(TypeError, match=r"conditions\.kinds is not"):
        core.jacobian(PIN._replace(kinds=[0]), x)
    read_only = np.zeros(3)
    read_only.setflags(write=False)
    with pytest.raises(TypeError):
        core.settle_on_curve(PIN, read_only, np.zeros(3))


def test_wrong_samples(core):
    curve = np.zeros(4), np.zeros((4, 3)), np.zeros((4, 3)), np.zeros(4)
    for count in 0, 5, -1:
        with pytest.raises(ValueError, match="a first sample"):
            core.trace_curve(PIN, curve, count, 0.1, 0.2, 1.0)
    with pytest.raises(ValueError, match="shapes of one curve"):
        core.trace_curve(PIN, (*curve[:3], np.zeros(3)), 1, 0.1, 0.2, 1.0)
    at, room = np.zeros(1), np.zeros((1, 3))
    for segment in -1, 3, 2**62:
        with pytest.raises(ValueError, match="between two samples"):
            core.evaluate_pose(PIN, curve, at, np.array([segment]), room, room.copy())
    for step in np.nan, np.inf:
        with pytest.raises(ValueError, match="finite"):
            core.trace_curve(PIN, curve, 1, step, 0.2, 1.0)
    for step in 0.0, -1.0:
        assert core.trace_curve(PIN, curve, 1, step, 0.2, 1.0)[0] == 3
