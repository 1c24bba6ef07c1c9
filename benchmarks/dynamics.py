"""Inverse dynamics beside kinematics, and five machines moving freely beside MuJoCo and Exudyn in one run.

Both are optional: pip install mujoco exudyn. Each of them gets shorter steps until it is within 1e-5 rad of our motion
at 1e-12; loops of MuJoCo are closed by stiff `connect`, those of Exudyn by its plane joints (trapezoidal rule of index
2).
"""

import time
from collections.abc import Callable, Iterator
from importlib import import_module
from typing import NamedTuple

import numpy as np

from gruebler import Mechanism
from gruebler.mechanics.dynamics import Simulation, inverse_dynamics, simulate
from gruebler.mechanics.forces import Loads, RigidBody
from gruebler.mechanics.kinematics import Motion, move
from gruebler.mechanics.linkages import Linkage

SPANS = 2.0, 20.0  # seconds: a fall from the start, and one that has become usual
WANTED, OURS, REFERENCE = 1e-5, 1e-9, 1e-12
STEPS = tuple(1e-2 / 2**k for k in range(15))
PATIENCE = 20.0  # processor seconds for one machine
G = 9.81

PLACES: dict[str, tuple[str, list[tuple[float, ...]]]] = {
    "four-bar": ("R(0-1) R(1-2) R(2-3) R(0-3)", [(0, 0), (0.1, 0.2), (0.7, 0.5), (0.7, 0)]),
    "slider-crank": ("R(0-1) R(1-2) R(2-3) P(0-3)", [(0, 0), (0.1, 0.2), (0.7, 0.05), (0.7, 0.05, 0)]),
    "double rocker": ("R(0-1) R(1-2) R(2-3) R(0-3)", [(0, 0), (0.33, 0.23), (0.63, 0.36), (0.9, 0)]),
    "six-bar": (
        "R(0-1) R(1-2) R(2-3) R(0-3) R(3-4) R(4-5) R(0-5)",
        [(0, 0), (0.1, 0.2), (0.7, 0.5), (0.7, 0), (0.8, 0.4), (1.3, 0.5), (1.3, 0)],
    ),
    "eight-bar": (
        "R(0-1) R(1-2) R(2-3) R(0-3) R(3-4) R(4-5) R(0-5) R(5-6) R(6-7) R(0-7)",
        [
            (0, 0), (0.1, 0.2), (0.7, 0.5), (0.7, 0), (0.8, 0.4),
            (1.3, 0.5), (1.3, 0), (1.4, 0.3), (1.9, 0.4), (1.9, 0),
        ],
    ),
}  # fmt: skip


class Machine(NamedTuple):
    """A linkage with bodies of 1 kg at the middle of the joints of each link."""

    linkage: Linkage
    loads: Loads


def machine(name: str) -> Machine:
    joints, places = PLACES[name]
    mechanism = Mechanism.parse(f"{joints}; frame=0; drive=R(0-1)")
    linkage = Linkage.from_drawing(mechanism, dict(zip(mechanism.chain.joint_names(), places, strict=True)), unit="m")
    bodies = {}
    for link in mechanism.chain.links[1:]:
        ends = np.array([(e.x, e.y) for (_, owner), e in linkage.elements.items() if owner == link])
        bodies[link] = RigidBody(1.0, tuple(ends.mean(axis=0).tolist()), 0.01)
    return Machine(linkage, Loads(bodies=bodies, gravity=(0.0, -G)))


class Body(NamedTuple):
    """A link at the start, in the plane: its centre of mass, speed there, angular speed, mass, inertia."""

    centre: complex
    speed: complex
    rate: float
    mass: float
    inertia: float


def bodies_at_start(given: Machine, start: Simulation) -> dict[str, Body]:
    found = {}
    for link, body in given.loads.bodies.items():
        at, speed = (complex(start.complex_point((link, *body.centre), order=k)[0]) for k in (0, 1))
        found[link] = Body(at, speed, float(start.angular(link)[0]), body.mass, body.inertia)
    return found


class Contact(NamedTuple):
    """A joint at the start: its links, its place, the direction of a slide."""

    links: tuple[str, str]
    at: complex
    along: complex | None


def contacts(name: str) -> list[Contact]:
    joints, places = PLACES[name]
    chain = Mechanism.parse(f"{joints}; frame=0; drive=R(0-1)").chain
    return [
        Contact(
            (joint.links[0], joint.links[1]),
            complex(*place[:2]),
            None if joint.pair.is_turning else complex(np.exp(1j * place[2])),
        )
        for joint, place in zip(chain.joints, places, strict=True)
    ]


Run = Callable[[float, float], tuple[float, float]]
"""From the step and a span to how far the crank has turned after it, and the processor seconds."""


def in_mujoco(name: str, bodies: dict[str, Body]) -> Run:
    """Bodies nested from the frame, slides (on the frame) before pins; what is left closes the loops."""
    mujoco = import_module("mujoco")
    inner: dict[str, list[tuple[str, Contact]]] = {"0": []}
    left, loops = sorted(contacts(name), key=lambda c: c.along is None), list[Contact]()
    while left:
        contact = next(c for c in left if set(c.links) & inner.keys())
        left.remove(contact)
        near, far = contact.links if contact.links[0] in inner else contact.links[::-1]
        if far in inner:
            loops.append(contact)
        else:
            inner[near].append((far, contact))
            inner[far] = []

    def text(link: str, origin: complex) -> Iterator[str]:
        for child, contact in inner[link]:
            body, at = bodies[child], contact.at - origin
            centre = body.centre - contact.at
            axis = "0 0 1" if contact.along is None else f"{contact.along.real} {contact.along.imag} 0"
            kind = "hinge" if contact.along is None else "slide"
            yield f'<body name="L{child}" pos="{at.real!r} {at.imag!r} 0">'
            yield f'<joint name="J{child}" type="{kind}" axis="{axis}"/>'
            yield f'<inertial pos="{centre.real!r} {centre.imag!r} 0" mass="{body.mass}" '
            yield f'diaginertia="1 1 {body.inertia}"/>'
            yield from text(child, contact.at)
            yield "</body>"

    def origin_of(link: str) -> complex:
        return next((c.at for children in inner.values() for child, c in children if child == link), 0j)

    def run(step: float, span: float) -> tuple[float, float]:
        pins = ""
        for contact in loops:
            first, second = contact.links if contact.links[0] != "0" else contact.links[::-1]
            anchor = contact.at - origin_of(first)
            other = "" if second == "0" else f' body2="L{second}"'
            pins += f'<connect body1="L{first}"{other} anchor="{anchor.real!r} {anchor.imag!r} 0"/>'
        model = mujoco.MjModel.from_xml_string(
            f'<mujoco><compiler inertiafromgeom="false" balanceinertia="true"/>'
            f'<option timestep="{step!r}" gravity="0 {-G} 0" integrator="RK4" tolerance="1e-14"/>'
            f'<default><equality solref="{2 * step!r} 1" solimp="0.9999 0.9999 0.001 0.5 2"/></default>'
            f"<worldbody>{''.join(text('0', 0j))}</worldbody><equality>{pins}</equality></mujoco>"
        )
        data = mujoco.MjData(model)
        for near, children in inner.items():
            for child, contact in children:
                body, rate = bodies[child], 0.0 if near == "0" else bodies[near].rate
                way = None if contact.along is None else (contact.along.conjugate() * body.speed).real
                data.joint(f"J{child}").qvel = body.rate - rate if way is None else way
        begin = time.process_time()
        mujoco.mj_step(model, data, round(span / step))
        return float(data.joint("J1").qpos[0]), time.process_time() - begin

    return run


def in_exudyn(name: str, bodies: dict[str, Body]) -> Run:
    exu, item = import_module("exudyn"), import_module("exudyn.itemInterface")

    def run(step: float, span: float) -> tuple[float, float]:
        system = exu.SystemContainer().AddSystem()
        objects, nodes = {"0": system.AddObject(item.ObjectGround(referencePosition=[0, 0, 0]))}, {}
        for link, body in bodies.items():
            nodes[link] = system.AddNode(
                item.NodeRigidBody2D(
                    referenceCoordinates=[body.centre.real, body.centre.imag, 0],
                    initialVelocities=[body.speed.real, body.speed.imag, body.rate],
                )
            )
            objects[link] = system.AddObject(
                item.ObjectRigidBody2D(physicsMass=body.mass, physicsInertia=body.inertia, nodeNumber=nodes[link])
            )
            middle = system.AddMarker(item.MarkerBodyPosition(bodyNumber=objects[link], localPosition=[0, 0, 0]))
            system.AddLoad(item.LoadForceVector(markerNumber=middle, loadVector=[0, -G * body.mass, 0]))
        for contact in contacts(name):
            arms = [contact.at - (bodies[link].centre if link in bodies else 0) for link in contact.links]
            kind = item.MarkerBodyPosition if contact.along is None else item.MarkerBodyRigid
            ends = [
                system.AddMarker(kind(bodyNumber=objects[link], localPosition=[arm.real, arm.imag, 0]))
                for link, arm in zip(contact.links, arms, strict=True)
            ]
            if contact.along is None:
                system.AddObject(item.ObjectJointRevolute2D(markerNumbers=ends))
            else:
                along, across = contact.along, 1j * contact.along
                system.AddObject(
                    item.ObjectJointPrismatic2D(
                        markerNumbers=ends,
                        axisMarker0=[along.real, along.imag, 0],
                        normalMarker1=[across.real, across.imag, 0],
                    )
                )
        system.Assemble()
        settings = exu.SimulationSettings()
        settings.timeIntegration.numberOfSteps = round(span / step)
        settings.timeIntegration.endTime = span
        settings.timeIntegration.verboseMode = 0
        settings.solutionSettings.writeSolutionToFile = False
        begin = time.process_time()
        system.SolveDynamic(settings, solverType=exu.DynamicSolverType.TrapezoidalIndex2)
        took = time.process_time() - begin
        return float(system.GetNodeOutput(nodes["1"], exu.OutputVariableType.Coordinates)[2]), took

    return run


def until_near(run: Run, wanted: float, span: float) -> tuple[float, float, float] | None:
    """The first step that is near enough: the step, how far it is off, its processor seconds for a second."""
    begin = time.process_time()
    for step in STEPS:
        try:
            angle, took = run(step, span)
        except (ValueError, RuntimeError):  # Newton's method does not converge: the step is too long
            continue
        if abs(angle - wanted) < WANTED:
            return step, abs(angle - wanted), took / span
        if time.process_time() - begin > PATIENCE:
            return None
    return None


def free(given: Machine, tolerance: float, span: float) -> tuple[Simulation, float]:
    begin = time.process_time()
    run = simulate(given.linkage, given.loads, speed=3.0, until=span, times=[0, span], tolerance=tolerance)
    return run, (time.process_time() - begin) / span


def compare(name: str, span: float) -> None:
    given = machine(name)
    exact, _ = free(given, REFERENCE, span)
    turned = float(exact.drives[-1, 0] - exact.drives[0, 0])
    seconds = np.inf
    for _ in range(3):
        rough, took = free(given, OURS, span)
        seconds = min(seconds, took)
    off = abs(rough.drives[-1, 0] - exact.drives[-1, 0])
    print(
        f"{name:15} {span:3.0f} s, ours: {off:7.0e} rad, energy {rough.defect:7.0e}, {1e3 * seconds:7.1f} ms a second"
    )
    bodies = bodies_at_start(given, exact)
    for program, model in (("mujoco", in_mujoco), ("exudyn", in_exudyn)):
        try:
            found = until_near(model(name, bodies), turned, span)
        except ImportError:
            print(f"{'':15} {program}: not installed")
            continue
        if found is None:
            print(f"{'':15} {program}: not within {WANTED:.0e} rad")
        else:
            step, gap, took = found
            print(f"{'':15} {program}: {gap:7.0e} rad at h = {step:.1e} s, {took / seconds:6.2f} times our time")


def inverse_beside_kinematics(name: str, rows: int = 2000) -> None:
    given = machine(name)
    start = float(simulate(given.linkage, given.loads, until=1e-3, times=[0.0]).drives[0, 0])
    path = start + np.linspace(0, 0.3, rows)

    def motion() -> Motion:
        return move(given.linkage, path, speed=3.0)

    moved = motion()
    kinematics, dynamics = np.inf, np.inf
    for _ in range(15):
        begin = time.process_time()
        motion()
        middle = time.process_time()
        inverse_dynamics(moved, given.loads)
        kinematics, dynamics = (
            min(kinematics, middle - begin),
            min(dynamics, time.process_time() - middle),
        )
    print(
        f"{name:15} kinematics {1e6 * kinematics / rows:6.2f} us a pose, inverse dynamics "
        f"{1e6 * dynamics / rows:6.2f} us, {dynamics / kinematics:5.1f} times"
    )


def main() -> None:
    for name in PLACES:
        for span in SPANS:
            compare(name, span)
    for name in ("four-bar", "eight-bar"):
        inverse_beside_kinematics(name)


if __name__ == "__main__":
    main()
