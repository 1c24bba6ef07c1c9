"""The motion kernels: every row against plain Python and print, equal bits from all levels."""

import math
import signal
from copy import deepcopy
from math import cos, sin

import numpy as np
import pytest

import gruebler as gr
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.kinematics import kernel_records as records
from gruebler.mechanics.kinematics.assembly_modes import GroupSolver, conditions
from gruebler.mechanics.kinematics.batch import four_bars, move_many
from gruebler.mechanics.kinematics.circuits import circuit
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry
from tests.core.plain import closure
from tests.core.plain.closure_rates import RateScratch, closing_rates
from tests.core.plain.dyads import dyad_place, dyad_rates, dyad_square, meeting
from tests.core.plain.planar_jets import BodyJets, ElementJets, carry, rotated_derivative, set_element_jet
from tests.samples import CLASS_III, CYLINDER, parallel_legs

STEADY = {"speed": 1.0, "acceleration": 2.0, "jerk": 3.0, "order": 3}
SLIDING = [
    ("R(0-1) P(1-2) R(2-3) P(0-3); frame=0; drive=R(0-1)", [(0, 0), (2, 1, 0.5), (4, 2), (4, 2.2, 1.4)]),
    ("R(0-1) R(1-2) P(2-3) P(0-3); frame=0; drive=R(0-1)", [(0, 0), (1, 1), (3, 1.5, 1.3), (6, 2, 0.2)]),
]
FIVE_BAR = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(0-4); frame=0; drive=R(0-1); drive=R(0-4)")


def five_bar():
    return Linkage.from_drawing(FIVE_BAR, {0: (0, 0), 1: (1, 0.5), 2: (2.5, 7), 3: (4, 0.6), 4: (5, 0)})


def sliding(text, places):
    return Linkage.from_drawing(Mechanism.parse(text), dict(enumerate(places)))


# Turning drives and dyads over many rows (swept) and few (walked), limits, change points, pushes, carried links, larger
# groups, wheels, belts and cams.
MOTIONS = {
    "crank-rocker": lambda: gr.move(FourBar(25, 70, 40, 70).linkage(), gr.from_degrees(-3, 723, 2), **STEADY),
    "crank-rocker, position": lambda: gr.move(FourBar(25, 70, 40, 70).linkage(), gr.from_degrees(0, 360, 3), order=0),
    "crank-rocker, other mode": lambda: gr.move(
        FourBar(25, 70, 40, 70).linkage(), gr.from_degrees(0, 360, 7), branch="-", speed=2.0, order=1
    ),
    "limit": lambda: gr.move(FourBar(50, 70, 40, 70).linkage(), gr.from_degrees(60, 360, 3), speed=1.0),
    "parallelogram": lambda: gr.move(FourBar(25, 70, 25, 70).linkage(), gr.from_degrees(0, 400, 3), **STEADY),
    "kite": lambda: gr.move(FourBar(30, 50, 50, 30).linkage(), gr.from_degrees(-30, 400, 10), **STEADY),
    "rhombus": lambda: gr.move(FourBar(20, 20, 20, 20).linkage(), np.radians([64.0, 104, 144, 184, 144, 104, 64])),
    "slider-crank": lambda: gr.move(SliderCrank(20, 70, 8).linkage(), gr.from_degrees(0, 400, 2), **STEADY),
    "turning block": lambda: gr.move(InvertedSliderCrank(50, 30, 3).linkage(), gr.from_degrees(0, 400, 2), **STEADY),
    "swinging block": lambda: gr.move(InvertedSliderCrank(30, 50, -4).linkage(), gr.from_degrees(0, 400, 9), **STEADY),
    "PRP": lambda: gr.move(sliding(*SLIDING[0]), gr.from_degrees(0, 20, 2), **STEADY),
    "RPP": lambda: gr.move(sliding(*SLIDING[1]), gr.from_degrees(0, 20, 2), **STEADY),
    "cylinder": lambda: gr.move(CYLINDER, np.linspace(3.0, 4.0, 12), **STEADY),
    "two drives": lambda: gr.move(
        five_bar(), np.stack([np.linspace(0.5, 3, 200), np.linspace(2.5, 6, 200)], axis=1), speed=[1, 2]
    ),
    "class III": lambda: gr.move(CLASS_III, gr.from_degrees(40, 140, 5), **STEADY),
    "three parallel cranks": lambda: gr.move(parallel_legs(), np.radians([53.13, 100, 180 + 1e-5, 250]), order=0),
    "row in a change point": lambda: gr.move(parallel_legs(), np.radians([150, 180, 210]), speed=1.0),
    **{
        name: lambda name=name: gr.move(entry(name).linkage(), gr.from_degrees(0, 30, 5), **STEADY)
        for name in ("cam", "cam_roller", "geneva", "belt", "friction_forced", "winch_plane")
    },
    "crane": lambda: gr.move(entry("crane_cyl").linkage(), np.linspace(34.5, 47, 6), **STEADY),
}
CHANGE = 1e-4  # below this root, or this determinant beside its largest, rates have lost too many digits to be compared


def recorded(core, name, work):
    """The calls of a kernel: its arguments before and after, and what it returned."""
    calls = []
    kernel = getattr(core, name)

    def record(*arguments):
        before = deepcopy(arguments)
        result = kernel(*arguments)
        calls.append((before, deepcopy(arguments), result))
        return result

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(core, name, record)
        work()
    assert calls
    return calls


def same(one, other):
    return np.array_equal(one, other, equal_nan=one.dtype.kind in "fc")


def within_an_ulp(one, other):
    """The same but for the last bit of cosines, which the core computes itself."""
    return np.abs(one - other).max() <= 4e-16 * (1 + np.abs(other).max())


class Plain:
    """A program, one pose after the other in plain Python, from signed roots and unknowns that are given."""

    def __init__(self, program, links, order):
        self.program, self.order = program, order
        self.links = BodyJets(np.zeros((links, 4), complex), np.ones(links, complex), np.zeros((links, 3)))
        self.known = True  # whether the rates have digits enough

    def element(self, e, slot, elements):
        program = self.program
        link = program.links[e]
        set_element_jet(self.order, link, program.points[e], program.lines[e], self.links, slot, elements)

    def pose(self, drives, roots, unknowns, turns):
        """Place the links; `drives` (order + 1, drives), `turns` where outer joints of a dyad meet."""
        self.links.places[:], self.links.turns[:], self.links.rates[:] = 0, 1, 0
        self.known = True
        for operation in self.program.operations:
            kind = operation[0]
            if kind < records.RRR:
                self.drive(operation, drives)
            elif kind < records.GROUP:
                self.dyad(operation, roots[operation[9]], turns)
            elif kind == records.GROUP:
                self.group(operation[1], unknowns)
            else:
                carry(self.order, operation[1], operation[2], self.links)

    def drive(self, operation, drives):
        jets = ElementJets(np.zeros((1, 4), complex), np.ones(1, complex), np.zeros((1, 3)))
        _, d, near, far, sign = operation[:5]
        self.element(near, 0, jets)
        link, other, point = self.program.links[far], self.program.links[near], self.program.points[far]
        places, turns, rates = self.links
        value = [drives[k, d] * sign if k <= self.order else 0.0 for k in range(4)]
        spins = rates[other].copy()
        if operation[0] == records.TURN:
            turns[link] = turns[other] * complex(cos(value[0]), sin(value[0]))
            spins[: self.order] += value[1 : self.order + 1]
            way = [0j] * 4
        else:
            turns[link] = jets.lines[0] * self.program.lines[far].conjugate()
            way = [complex(x) for x in value]
        rates[link] = spins
        for k in range(self.order + 1):
            along = rotated_derivative(k, jets.lines[0], *rates[other], *way)
            places[link, k] = jets.points[0, k] + along - rotated_derivative(k, turns[link], *spins, point, 0j, 0j, 0j)

    def dyad(self, operation, root, turns):
        elements = ElementJets(np.zeros((6, 4), complex), np.ones(6, complex), np.zeros((6, 3)))
        for slot in range(6):
            self.element(operation[1 + slot], slot, elements)
        kind, size, links = operation[0], self.program.size, self.program.links
        driven = kind == records.RRP and links[operation[2]] != links[operation[3]]
        square = dyad_square(kind, elements, size, driven)
        assert (root if kind in (records.PRP, records.RPP) else root * root) == pytest.approx(
            square, rel=1e-9, abs=1e-11
        )
        self.known &= abs(root) > CHANGE
        if meeting(kind, elements, size):
            self.links.turns[operation[7]] = turns[operation[7]]
        dyad_place(kind, root, elements, operation[7], operation[8], self.links, size, driven)
        if self.known:
            dyad_rates(kind, self.order, elements, operation[7], operation[8], self.links)

    def group(self, number, unknowns):
        p = self.program
        conditions, bodies = (slice(*part[number : number + 2]) for part in (p.conditions, p.bodies))
        count, n = conditions.stop - conditions.start, 3 * (bodies.stop - bodies.start)
        sides = ElementJets(np.zeros((2 * count, 4), complex), np.ones(2 * count, complex), np.zeros((2 * count, 3)))
        ends = slice(2 * conditions.start, 2 * conditions.stop)
        for slot, e in enumerate(p.sides[ends]):
            self.element(e, slot, sides)
        values = np.zeros((count, 8))
        values[:, [0, 1, 2, 5, 6, 7]] = p.values[conditions]
        for c, first in enumerate(p.windings[conditions]):
            if first >= 0:
                values[c, 3:5] = unknowns[first : first + 2]
        given = records.Conditions(p.kinds[conditions], values, p.pieces, p.owners[ends], *sides, p.size)
        x, residual, slopes = unknowns[3 * bodies.start :][:n], np.zeros(n), np.zeros((n, n))
        assert closure.closing(given, x, residual, slopes) < 1e-11 * p.size
        turns = np.exp(1j * x[2::3])
        jets = BodyJets(np.zeros((n // 3, 4), complex), turns, np.zeros((n // 3, 3)))
        jets.places[:, 0] = x[0::3] + 1j * x[1::3]
        scaled = slopes * np.where(np.arange(n) % 3 == 2, 1 / p.size, 1)
        self.known &= bool(np.linalg.cond(scaled) < 1 / CHANGE)
        for k in range(1, self.order + 1) if self.known else ():
            target = np.zeros(n)
            closing_rates(k, given, jets, RateScratch(np.zeros(4, complex), np.zeros((2, 3))), target)
            rates = np.linalg.solve(slopes, target)
            jets.places[:, k], jets.rates[:, k - 1] = rates[0::3] + 1j * rates[1::3], rates[2::3]
        for b, link in enumerate(p.roots[bodies]):
            for mine, theirs in zip(self.links, jets, strict=True):
                mine[link] = theirs[b]


@pytest.mark.parametrize("name", MOTIONS)
def test_every_row_is_what_plain_python_finds(core, name):
    compared = 0
    for before, (*_, out), (_, reached, _, _) in recorded(core, "run_path", MOTIONS[name]):
        program, path, speeds = before[:3]
        order = len(out[2])
        plain = Plain(program, len(out[1]), order)
        places, turns, rates, whole, roots, unknowns = out
        drives = np.concatenate([path[None], speeds[:order]])
        for row in range(reached):
            plain.pose(drives[:, row], roots[:, row], unknowns[:, row], turns[:, row])
            known = order if plain.known else 0
            large = program.size + np.abs(plain.links.places).max(axis=0)[: known + 1]
            fast = 1 + np.abs(plain.links.rates).max()
            assert (np.abs(plain.links.turns - turns[:, row]) < (1e-10 if plain.known else 1e-6)).all()
            missed = np.abs(plain.links.places[:, : known + 1].T - places[: known + 1, :, row])
            assert (missed < (1e-9 if plain.known else 1e-6) * large[:, None]).all()
            assert (np.abs(plain.links.rates[:, :known].T - rates[:known, :, row]) < 1e-9 * fast**3).all()
            compared += plain.known
        angles = np.angle(turns[:, :reached]) + 2 * np.pi * (whole[:, :reached] - whole[:, :1])
        if reached > 30:  # rows are close then
            assert np.abs(np.diff(angles, axis=1)).max() < 0.5
    assert compared


@pytest.mark.parametrize("name", ["crank-rocker", "slider-crank", "turning block", "two drives", "limit"])
def test_levels_give_the_same_bits(core, name):
    for before, after, end in recorded(core, "run_path", MOTIONS[name]):
        for level in core.level_names():
            out = tuple(np.full_like(array, 7) for array in after[5])
            assert core.run_path(*before[:5], out, level=level) == end
            for mine, best in zip(out, after[5], strict=True):
                assert same(mine[..., : end[1]], best[..., : end[1]])


def test_a_sweep_finds_what_a_walk_finds(core):
    """Eight rows are walked, more are swept."""
    linkage = FourBar(25, 70, 40, 70).linkage()
    ((before, after, _),) = recorded(core, "run_path", lambda: gr.move(linkage, gr.from_degrees(0, 400, 1), **STEADY))
    plan, drives, speeds, signs, start, _ = before
    for row in range(0, len(drives) - 8, 40):
        part = slice(row, row + 8)
        out = tuple(np.ascontiguousarray(array[..., part]) for array in after[5])
        for array in out:
            array[...] = 7
        assert core.run_path(plan, drives[part], np.ascontiguousarray(speeds[:, part]), signs, start, out)[1] == 8
        for walked, swept in zip(out[:3], after[5][:3], strict=True):
            assert np.allclose(walked, swept[..., part], rtol=1e-12, atol=1e-10)


def test_designs_move_as_each_alone(core):
    def work():
        move_many(
            four_bars([25, 30, 200], 70, 40, 70), gr.from_degrees(0, 60, 5), speed=1.0, threads=1, branch="+", order=2
        )

    ((before, after, _),) = recorded(core, "run_designs", work)
    plan, designs, path, speeds, kept, _, _ = before
    out = after[5]
    links, rows = 1 + int(plan.links.max()), len(path)
    for n in range(3):
        alone = plan._replace(
            points=designs.points[n], lines=designs.lines[n], most=designs.most[n], size=designs.sizes[n]
        )
        poses = records.PoseBuffer(
            np.empty((3, links, rows), complex),
            np.empty((links, rows), complex),
            np.empty((2, links, rows)),
            np.empty((links, rows), np.int32),
            np.empty((1, rows)),
            np.empty((0, rows)),
        )
        reached = core.run_path(alone, path, speeds, designs.signs[n], designs.starts[n], poses)[1]
        assert out.reached[n] == reached
        for mine, theirs in zip((out.places[:, n], out.turns[n], out.rates[:, n]), poses, strict=False):
            assert same(mine[..., :reached], theirs[..., kept, :reached])
            assert np.isnan(mine[..., reached:]).all()
    assert sorted(out.reached) == [0, rows, rows]


DYAD = [(0, -1, 0, 0j, 1, 0j, 1), (0, 0, 1, 1, 1, 0j, 1), (0, 1, -1, 1, 1, 1.2, 1)]
TRIAD = [  # a triangle on three bars, the last pin of which is said the other way round
    *((0, -1, k + 1, place, 1, 0j, 1) for k, place in enumerate((0.13 - 0.65j, 2.4 + 0.06j, 0.02 + 1.9j))),
    *((0, 0, k + 1, corner, 1, 1 + 0.2j, 1) for k, corner in enumerate((0j, 1 + 0j))),
    (0, 3, 0, 1 + 0.2j, 1, 0.4 + 0.8j, 1),
]


@pytest.mark.parametrize("joined", [DYAD, TRIAD], ids=["dyad", "triangle on bars"])
def test_newtons_method_closes_groups(core, joined):
    group = conditions(joined)
    kept = GroupSolver(group)._conditions
    n = 2 * len(joined)
    random = np.random.default_rng(1)
    arrived, signs = 0, set()
    for _ in range(50):
        x = random.normal(size=n)
        residual, slopes, expected, plain = np.zeros(n), np.zeros((n, n)), np.zeros(n), np.zeros((n, n))
        assert core.closing(kept, x, residual, slopes) == np.abs(residual).max()
        closure.closing(kept, x, expected, plain)
        assert within_an_ulp(residual, expected)
        assert within_an_ulp(slopes, plain)
        steps, determinant = core.newton(kept, x, 20)
        if steps > 0:
            arrived += 1
            assert closure.closing(kept, x, expected, plain) < 1e-14
            signs.add(math.copysign(1, determinant * np.linalg.det(plain)))
            assert abs(determinant) == pytest.approx(abs(np.linalg.det(plain)), rel=1e-6)
            x += 1e-3 * random.normal(size=n)
            core.close_near_singular(kept, x)
            assert closure.closing(kept, x, expected, plain) < 1e-10
    assert arrived > 9
    assert len(signs) == 1  # its sign against the whole determinant is that of the group


@pytest.mark.parametrize("name", ["crank-rocker", "class III", "cam_roller", "geneva", "belt", "friction_forced"])
def test_circuits_are_closed_by_plain_python(core, name):
    """Every kind of closing condition, traced."""
    given = {"crank-rocker": FourBar(25, 70, 40, 70).linkage(), "class III": CLASS_III}
    found = circuit(given[name] if name in given else entry(name).linkage())
    system, traced = found.system, found.traced
    m, n = system.equations, system.unknowns
    residual, slopes = np.zeros(m), np.zeros((m, n))
    lengths = np.linalg.norm(np.diff(traced.poses, axis=0), axis=1)
    assert (np.diff(traced.arcs) >= lengths * (1 - 1e-12)).all()
    for pose, tangent in list(zip(traced.poses, traced.tangents, strict=True))[:: max(1, len(traced.arcs) // 10)]:
        for mine, plain in zip(core.jacobian(system.conditions, pose), (residual, slopes), strict=True):
            assert closure.closing(system.conditions, pose, residual, slopes) < 1e-9
            assert within_an_ulp(mine, plain)
        assert np.linalg.norm(tangent) == pytest.approx(1, abs=1e-12)
        assert np.abs(slopes @ tangent).max() < 1e-5 * max(1, np.abs(slopes).max())


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="no signals here")
def test_an_interrupt_ends_a_long_way(core):
    ((before, after, _),) = recorded(
        core, "run_path", lambda: gr.move(FourBar(25, 70, 40, 70).linkage(), [0.3], order=0)
    )
    plan, _, _, signs, start, _ = before
    drives = np.array([[0.3], [3e10]])
    poses = tuple(np.zeros((*array.shape[:-1], 2), array.dtype) for array in after[5])

    def interrupt(*_):
        raise KeyboardInterrupt

    usual = signal.signal(signal.SIGALRM, interrupt)
    signal.setitimer(signal.ITIMER_REAL, 0.3)
    try:
        with pytest.raises(KeyboardInterrupt):
            core.run_path(plan, drives, np.zeros((0, 2, 1)), signs, start, poses)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, usual)
