"""Laws of dynamics that hold for whatever machine, on machines drawn by chance: pins, slides, one drive or two."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.polynomial import chebyshev

from gruebler.base.errors import LinkageError
from gruebler.mechanics.dynamics import InverseDynamics, inverse_dynamics, simulate
from gruebler.mechanics.dynamics.starts import starting_pose
from gruebler.mechanics.forces import Gas, Loads, RigidBody, Spring, TorsionSpring
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics import Motion, move
from gruebler.mechanics.kinematics.solve import cached_plan
from gruebler.mechanics.linkages import CamDisc, Linkage, LinkPoint
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entries, entry

DRAWN = {
    "R(0-1) R(1-2) R(2-3) R(0-3); drive=R(0-1)": [(0, 0), (0, 2), (5, 4), (6, 0)],
    "R(0-1) R(1-2) R(2-3) P(0-3); drive=R(0-1)": [(0, 0), (1, 2), (6, 1), (6, 1, 0.1)],
    "R(0-1) R(1-2) P(2-3) R(0-3); drive=R(0-1)": [(0, 0), (1, 2), (3, 1, -0.4), (5, 0)],
    "R(0-1) P(1-2) R(2-3) R(0-3); drive=P(1-2)": [(0, 0), (2, 1, 0.5), (4, 2), (5, 0)],
    "R(0-1) R(1-2) R(2-3) R(0-3) R(2-4) R(4-5) R(0-5); drive=R(0-1)": [
        (0, 0), (0, 2), (5, 4), (6, 0), (3, 6), (8, 7), (9, 2),
    ],
    "R(0-1) R(1-2) R(2-3) R(0-3) R(3-4) R(4-5) P(0-5); drive=R(0-1)": [
        (0, 0), (0, 2), (5, 4), (6, 0), (7, 3), (11, 2), (11, 2, 0.2),
    ],
    "R(0-1) R(1-2) R(2-3) R(3-4) R(0-4); drive=R(0-1); drive=R(0-4)": [(0, 0), (-1, 4), (3, 8), (7, 4), (6, 0)],
}  # fmt: skip
FEW = settings(max_examples=settings().max_examples // 3)
TIMES = np.linspace(-0.2, 0.2, 5)


@dataclass(frozen=True)
class Case:
    """A machine, what acts on it, and how its drives move in the time: begin + speed t + bend t²/2."""

    linkage: Linkage
    loads: Loads
    begin: np.ndarray
    speed: np.ndarray
    bend: np.ndarray

    @property
    def turning(self):
        return np.array([drive.turning for drive in self.linkage.mechanism.drives])

    def motion(self, backward=False) -> Motion:
        """Five rows; backward with all speeds turned round."""
        sign = -1.0 if backward else 1.0
        t = TIMES[:, None]
        q, v = self.begin + t * (self.speed + t * self.bend / 2), self.speed + t * self.bend
        return move(self.linkage, q, speed=sign * v, acceleration=np.broadcast_to(self.bend, v.shape))

    def sound(self) -> bool:
        """Away from limits, where efforts are infinite."""
        motion = self.motion()
        return motion.complete and (np.abs(motion.roots) > 0.1).all()

    def run(self, backward=False) -> InverseDynamics:
        return inverse_dynamics(self.motion(backward), self.loads)


@st.composite
def cases(draw, damped=True):
    text = draw(st.sampled_from(list(DRAWN)))
    dice = np.random.default_rng(draw(st.integers(0, 10**6)))
    mechanism = Mechanism.parse(text + "; frame=0")
    joints = mechanism.chain.joint_names()
    links = [link for link in mechanism.chain.links if link != "0"]
    moved = [dice.uniform(-0.5, 0.5, 2) for _ in joints]
    places = {
        joint: (*(np.array(place[:2]) + by), *place[2:])
        for joint, place, by in zip(joints, DRAWN[text], moved, strict=True)
    }
    points = {"G": ("0", 3.0, 9.0)} | {f"K{link}": (link, *dice.uniform(0, 6, 2)) for link in links}
    linkage = Linkage.from_drawing(mechanism, places, points=points, unit="m")
    loads = loads_by_chance(linkage, dice, damping=damped * dice.uniform(0, 0.5, 2))
    start = starting_pose(cached_plan(linkage), None, None)[0]
    count = len(mechanism.drives)
    case = Case(linkage, loads, start, dice.uniform(-1, 1, count), dice.uniform(-2, 2, count))
    assume(case.sound())
    return case


def loads_by_chance(linkage, dice, damping=(0.0, 0.0), size=1.0):
    """Masses on all links, a point mass and a spring at one of them, a torsion spring on the frame."""
    links = [link for link in linkage.mechanism.chain.links if link != linkage.mechanism.frame]
    first, last = links[len(links) > 1], links[-1]
    return Loads(
        bodies={
            k: RigidBody(dice.uniform(0.5, 2), tuple(size * dice.uniform(-1, 3, 2)), size**2 * dice.uniform(0, 4))
            for k in links
        },
        masses={f"K{first}": 0.5},
        gravity=(2.0, -9.0),
        springs=(Spring(("G", f"K{first}"), stiffness=7.0, free_length=2.0 * size, preload=3.0, damping=damping[0]),),
        torsion_springs=(
            TorsionSpring((linkage.mechanism.frame, last), stiffness=5.0 * size, free_angle=0.3, damping=damping[1]),
        ),
    )


def point_of(linkage, joint, link):
    element = linkage.element(joint, link)
    return LinkPoint(link, element.x, element.y)


def close(found, wanted, scale, within=1e-10):
    assert (np.abs(np.asarray(found) - wanted) / scale).max() <= within


def equilibrium_as_free_bodies(case):
    """Forces of all its joints, of the drives, loads and inertia: sums and moments, places by the motion."""
    run = case.run()
    assert run.disagreement < 1e-10  # with the equations of motion, which know nothing of joints
    motion, held, mechanism = run.motion, run.statics, case.linkage.mechanism
    at = {link: (np.zeros(len(TIMES), complex), np.zeros(len(TIMES))) for link in mechanism.chain.links}

    def act(link, force, place, moment=0.0):
        total, turning = at[link]
        at[link] = total + force, turning + moment + (np.conj(place) * force).imag

    for number, joint in enumerate(mechanism.chain.joints):
        later = joint.links[-1]  # a slide's force acts at the point of the later link
        place = motion.complex_point(point_of(case.linkage, number, later))
        for link in joint.links:
            act(link, held.force(number, link=link) @ [1, 1j], place, held.couple(number, link=link))
    for k, drive in enumerate(mechanism.drives):
        first, second = drive.between
        along = np.exp(1j * (motion.angle(first) + case.linkage.element(drive.joint, first).direction))
        for link, effort in ((second, run.drive[:, k]), (first, -run.drive[:, k])):
            place = motion.complex_point(point_of(case.linkage, drive.joint, second))
            act(link, 0 if drive.turning else effort * along, place, effort if drive.turning else 0.0)
    for wrench in held.wrenches:
        act(wrench.place.link, wrench.force, motion.complex_point(wrench.place), wrench.moment)
    for link in mechanism.chain.links:
        if link != mechanism.frame:
            force, moment = at[link]
            close(force, 0, held.load[0])
            close(moment, 0, held.load[0] * case.linkage.size)
    # and the linkage as a whole: what the frame feels from joints and drives
    everything = sum(at[link][0] for link in mechanism.chain.links)
    close(everything, sum(w.force for w in held.wrenches), held.load[0])


def longer_heavier_slower(case, length, mass, time):
    """Lengths, masses, times by a factor each: forces by m l / t², torques by m l² / t²."""
    loads = case.loads
    force = mass * length / time**2
    ways = np.where(case.turning, 1.0, length)
    other = replace(
        case,
        linkage=case.linkage.scaled(length),
        loads=Loads(
            bodies={
                k: RigidBody(b.mass * mass, tuple(np.multiply(b.centre, length)), b.inertia * mass * length**2)
                for k, b in loads.bodies.items()
            },
            masses={k: m * mass for k, m in loads.masses.items()},
            gravity=tuple(np.multiply(loads.gravity, length / time**2)),
            springs=tuple(
                replace(
                    s,
                    stiffness=s.stiffness * force / length,
                    free_length=s.free_length * length,
                    preload=s.preload * force,
                    damping=s.damping * force * time / length,
                )
                for s in loads.springs
            ),
            torsion_springs=tuple(
                replace(s, stiffness=s.stiffness * force * length, damping=s.damping * force * length * time)
                for s in loads.torsion_springs
            ),
        ),
    )
    run = case.run()
    motion = move(
        other.linkage,
        run.motion.drives * ways,
        speed=run.motion.speeds[0] * ways / time,
        acceleration=run.motion.speeds[1] * ways / time**2,
    )
    efforts = np.where(case.turning, force * length, force)
    close(inverse_dynamics(motion, other.loads).drive / efforts, run.drive, run.statics.load)


def mirror_image(case):
    loads, run = case.loads, case.run()
    sign = np.where(case.turning, -1.0, 1.0)
    mirrored = replace(
        case,
        linkage=case.linkage.mirrored(),
        loads=replace(
            loads,
            bodies={k: RigidBody(b.mass, (b.centre[0], -b.centre[1]), b.inertia) for k, b in loads.bodies.items()},
            gravity=(loads.gravity[0], -loads.gravity[1]),
            torsion_springs=tuple(replace(s, free_angle=-s.free_angle) for s in loads.torsion_springs),
        ),
        begin=sign * case.begin,
        speed=sign * case.speed,
        bend=sign * case.bend,
    )
    other = mirrored.run()
    close(sign * other.drive, run.drive, run.statics.load)
    close(other.shaking_force * [1, -1], run.shaking_force, run.statics.load[0])


def backward_in_time(case):
    """Without dampers the efforts are the same."""
    run, back = case.run(), case.run(backward=True)
    close(back.drive, run.drive, run.statics.load)
    close(back.power, -run.power, np.abs(run.power).max() or 1.0)


def forward_undoes_inverse(case):
    """Motors that give the found efforts accelerate the free linkage as the motion was accelerated."""
    run = case.run()
    mechanism, row = case.linkage.mechanism, 0  # where angles are counted from the same turn
    motors = {
        drive.joint: (lambda state, effort=float(effort): np.full(state.time.shape, effort))
        for drive, effort in zip(mechanism.drives, run.drive[row], strict=True)
    }
    names = mechanism.drive_names()
    loads = replace(case.loads, motors={name: motors[d.joint] for name, d in zip(names, mechanism.drives, strict=True)})
    q, v = run.motion.drives[row], run.motion.speeds[0, row]
    free = simulate(case.linkage, loads, at=q, speed=v, until=1e-3, times=[0.0])
    wanted = case.bend
    # an effort that is wrong by 1e-10 of the load is an acceleration so wrong by the least inertia
    least = np.linalg.eigvalsh(run.equations.mass[row]).min()
    close(free.accelerations[0], wanted, np.abs(run.statics.load).max() / least)


@given(cases())
def test_every_link_is_in_equilibrium_as_a_free_body(case):
    equilibrium_as_free_bodies(case)


@FEW
@given(cases(), st.floats(0.1, 10), st.floats(0.1, 10), st.floats(0.1, 10))
def test_longer_heavier_slower(case, length, mass, time):
    longer_heavier_slower(case, length, mass, time)


@FEW
@given(cases())
def test_a_mirror_image_needs_the_mirrored_efforts(case):
    mirror_image(case)


@FEW
@given(cases(damped=False))
def test_backward_in_time_needs_the_same_efforts(case):
    backward_in_time(case)


@FEW
@given(cases())
def test_forward_undoes_inverse(case):
    forward_undoes_inverse(case)


UNDETERMINED = {
    **dict.fromkeys(("cam_rocker", "cam_roller"), "free to spin"),
    **dict.fromkeys(("diff2p", "loco3", "loco4", "toolbox2"), "overconstrained"),
    "mzc": "how long",
}
"""Entries that have no dynamics, and why."""


@pytest.mark.slow
@pytest.mark.parametrize("id", [id for id, record in entries().items() if record.dimensions])
def test_the_laws_hold_for_the_machines_of_the_catalog(id):
    """Wheels, belts, cams, slots, cylinders, groups of any class: with masses and springs by chance."""
    dice, linkage = np.random.default_rng([*map(ord, id)]), entry(id).linkage()
    size, mechanism = linkage.size, linkage.mechanism
    if not mechanism.drives:
        pytest.skip("no drives")
    points = {f"K{link}": (link, *dice.uniform(0, size / 2, 2)) for link in mechanism.chain.links}
    linkage = linkage.with_points(points | {"G": (mechanism.frame, 0.3 * size, size)})
    turning = np.array([drive.turning for drive in mechanism.drives])
    at = None if linkage.reference_pose else np.ones(len(turning))
    start = starting_pose(cached_plan(linkage), None, at)[0]
    ways = 0.01 * np.where(turning, 1.0, size)
    speed, bend = ways * dice.uniform(-1, 1, len(ways)), ways * dice.uniform(-2, 2, len(ways))
    case = Case(linkage, loads_by_chance(linkage, dice, size=size / 5), start, speed, bend)
    assert case.motion().complete
    if id in UNDETERMINED:
        with pytest.raises(LinkageError, match=UNDETERMINED[id]):
            case.run()
        return
    lower = {joint.pair.name for joint in mechanism.chain.joints} <= {"R", "P"}
    if lower:
        equilibrium_as_free_bodies(case)
    assert case.run().disagreement < 1e-10
    longer_heavier_slower(case, 3.0, 2.0, 0.7)
    if not any(isinstance(element, CamDisc) for element in linkage.elements.values()):
        mirror_image(case)
    backward_in_time(case)
    forward_undoes_inverse(case)


CRANK_ROCKER = FourBar(25, 70, 40, 70)
BODIES = {
    "crank": RigidBody(1.0, (10.0, 3.0), 300.0),
    "coupler": RigidBody(0.8, (30.0, 12.0), 400.0),
    "rocker": RigidBody(0.6, (18.0, -5.0), 200.0),
}


def test_a_free_linkage_follows_the_efforts_of_its_motion():
    """The drive goes 0.5 + 8 t + 0.3 sin 5t; a motor with the found efforts, a series in the time, takes it there."""
    nodes = chebyshev.chebpts1(48)
    t = 0.1 * (nodes + 1)
    loads = Loads(bodies=BODIES, springs=(Spring(("frame:20,90", "R(coupler-rocker)"), stiffness=0.2, damping=0.01),))
    motion = move(
        CRANK_ROCKER,
        0.5 + 8 * t + 0.3 * np.sin(5 * t),
        speed=8 + 1.5 * np.cos(5 * t),
        acceleration=-7.5 * np.sin(5 * t),
        branch="+",
    )
    effort = chebyshev.chebfit(nodes, inverse_dynamics(motion, loads).drive[:, 0], 40)
    motor = {"R(frame-crank)": lambda state: chebyshev.chebval(state.time / 0.1 - 1, effort)}
    free = simulate(
        CRANK_ROCKER,
        replace(loads, motors=motor),
        at=0.5,
        speed=9.5,
        branch="+",
        until=0.2,
        times=[0.1, 0.2],
        tolerance=1e-11,
    )
    at = free.times
    close(free.drives[:, 0], 0.5 + 8 * at + 0.3 * np.sin(5 * at), 1.0, 1e-8)
    close(free.accelerations[:, 0], -7.5 * np.sin(5 * at), 8.0, 1e-6)


def test_series_of_the_forces_and_sums_over_the_bodies_move_alike():
    """Loads that are numbers are taken from series along the drive, laws from each pose: a force is given as both."""
    springs = (
        Spring(("frame:20,90", "R(coupler-rocker)"), stiffness=0.2, free_length=30.0, damping=0.01),
        Spring(("frame:0,-80", "R(crank-coupler)"), law=Gas(force=5.0, extended=150.0, stroke=120.0)),
    )
    ends = [
        simulate(
            CRANK_ROCKER,
            Loads({"R(coupler-rocker)": force}, bodies=BODIES, springs=springs, moments={"crank": 40.0}),
            at=0.5,
            speed=5.0,
            branch="+",
            until=0.1,
            times=[0.05, 0.1],
            tolerance=1e-11,
        )
        for force in ((3.0, -5.0), ("3 + 0*time", -5.0))
    ]
    for name, scale in (("drives", 1.0), ("speeds", 10.0), ("work", np.ptp(ends[0].kinetic))):
        close(getattr(ends[0], name), getattr(ends[1], name), scale, 1e-9)
    assert max(run.defect for run in ends) < 1e-9


@pytest.mark.slow
def test_energy_over_a_thousand_turns():
    loads = Loads(bodies=BODIES | {"crank": RigidBody(3.0, (4.0, 1.0), 3000.0)})
    end = 50 * np.pi
    run = simulate(
        CRANK_ROCKER, loads, at=0.0, speed=40.0, branch="+", until=end, times=[0, end / 2, end], tolerance=1e-13
    )
    assert run.drives[-1, 0] > 2000 * np.pi
    assert run.defect < 1e-9
