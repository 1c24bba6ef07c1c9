"""Six machines against figures of the verification of PMKS: places, velocities, accelerations, torques, reactions.

The figures are those of its MATLAB programs (PMKS-Web/PMKS_Verification, reference-data/v1, cases/*/matlab), which
agree with a second program, the C# library of PMKS. Of each machine five samples stand in pmks_verification.json,
evenly spread over its motion, in metres, seconds, newtons; the machines are built here from the stated places.
Lengths are compared by the size of the machine, rates by size times speed, torques and reactions by the largest.
"""

import json
from pathlib import Path

import numpy as np
import pytest

import gruebler as gr
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism

MACHINES = {each["id"]: each for each in json.loads(Path(__file__).with_name("pmks_verification.json").read_text())}


def linkage_of(machine):
    """The linkage of the stated places; a pin on a guide is a block that turns about the pin."""
    joints, places = [], {}
    for joint in machine["joints"]:
        first, second = joint["links"]
        names = [f"R({first}-{second})"] if joint["type"] == "R" else [f"R({first}-block)", f"P(block-{second})"]
        joints += names
        for name in names:
            axis = joint["guide_axis"] if name.startswith("P") else None
            angle = [] if axis is None else [float(np.arctan2(axis[1], axis[0]))]
            places[name] = (*joint["initial"], *angle)
    drive = next(joint for joint in machine["joints"] if joint["id"] == machine["input"]["joint"])
    mechanism = Mechanism.parse(f"{' '.join(joints)}; frame=ground; drive=R({'-'.join(drive['links'])})")
    points = {point["id"]: (point["link"], *point["initial"]) for point in machine.get("points", ())}
    points |= {f"centre of {link}": (link, *mass["com_initial"]) for link, mass in machine.get("masses", {}).items()}
    points |= {f"{j['id']} on {j['links'][0]}": (j["links"][0], *j["initial"]) for j in machine["joints"]}
    return Linkage.from_drawing(mechanism, places, points=points, unit="m")


def size_of(machine):
    places = np.array([joint["initial"] for joint in machine["joints"]])
    return float(np.ptp(places, axis=0).max())


def followed(machine, row):
    """The motion from the drawn position to a row, with the rates of that row at its end."""
    first = machine["joints"][0]["initial"]
    other = next(j for j in machine["joints"] if j["id"] == "B")["initial"]
    begin = float(np.arctan2(other[1] - first[1], other[0] - first[0]))
    speed = row["direction"] * machine["input"]["speed_rad_s"]
    path = np.append(np.linspace(begin, row["angle"], 200), row["angle"])
    motion = gr.move(linkage_of(machine), path, speed=speed, order=2)
    assert motion.complete, motion.message()
    return motion


def name_of(machine, name):
    joint = next((j for j in machine["joints"] if j["id"] == name), None)
    return name if joint is None else f"{name} on {joint['links'][0]}"


@pytest.mark.parametrize("id", MACHINES)
def test_places_and_rates(id):
    machine = MACHINES[id]
    size, speed = size_of(machine), machine["input"]["speed_rad_s"]
    for row in machine["rows"]:
        motion = followed(machine, row)
        for name, figures in row["points"].items():
            for order in range(3):
                found = motion.point(name_of(machine, name), order=order)[-1]
                bound = 2e-11 * size * speed**order
                assert found == pytest.approx(figures[2 * order : 2 * order + 2], rel=0, abs=bound), (name, order)
        for link, (omega, alpha) in row["links"].items():
            assert motion.angular(link, order=1)[-1] == pytest.approx(omega, rel=0, abs=2e-11 * speed), link
            assert motion.angular(link, order=2)[-1] == pytest.approx(alpha, rel=0, abs=2e-11 * speed**2), link


@pytest.mark.parametrize("gravity", ["no_gravity", "gravity"])
@pytest.mark.parametrize("id", [id for id, machine in MACHINES.items() if "masses" in machine])
def test_torques_with_inertia(id, gravity):
    """The drive's torque that inertia, a constant force and weight need: -m a and -J alpha as loads."""
    machine = MACHINES[id]
    largest = max(abs(row["torque"][gravity]) for row in machine["rows"])
    weight = machine["gravity"] if gravity == "gravity" else [0.0, 0.0]
    load = machine["load"]
    for row in machine["rows"]:
        motion = followed(machine, row)
        forces, moments = {}, {}
        for link, mass in machine["masses"].items():
            centre = f"centre of {link}"
            forces[centre] = mass["mass"] * (np.array(weight) - motion.point(centre, order=2))
            moments[link] = -mass["inertia"] * motion.angular(link, order=2)
        # the force acts at the mean of three joints of a link, which is the centre of mass of that link
        corners = [j["initial"] for j in machine["joints"] if j["id"] in load["application_average"]]
        assert np.mean(corners, axis=0) == pytest.approx(machine["masses"][load["link"]]["com_initial"], abs=1e-9)
        centre = f"centre of {load['link']}"
        forces[centre] = forces[centre] + np.array(load["force"])
        held = gr.statics(motion, gr.Loads(forces, moments=moments))
        assert held.drive[-1, 0] == pytest.approx(row["torque"][gravity], rel=0, abs=2e-11 * largest)
        assert held.work[-1, 0] == pytest.approx(row["torque"][gravity], rel=0, abs=2e-11 * largest)


@pytest.mark.parametrize("gravity", ["no_gravity", "gravity"])
@pytest.mark.parametrize("id", [id for id, machine in MACHINES.items() if "masses" in machine])
def test_inverse_dynamics_has_the_torques_and_all_reactions(id, gravity):
    """The same machines with masses as bodies; a reaction acts on each link of its joint with the stated sign."""
    machine = MACHINES[id]
    torques = [row["torque"][gravity] for row in machine["rows"]]
    largest = max(np.hypot(*force) for row in machine["rows"] for force in row["reactions"][gravity].values())
    load, weight = machine["load"], machine["gravity"] if gravity == "gravity" else (0, 0)
    for row, torque in zip(machine["rows"], torques, strict=True):
        motion = followed(machine, row)
        points = motion.linkage.points
        at = {link: points[f"centre of {link}"] for link in machine["masses"]}
        bodies = {k: gr.RigidBody(m["mass"], (at[k].x, at[k].y), m["inertia"]) for k, m in machine["masses"].items()}
        loads = gr.Loads({f"centre of {load['link']}": load["force"]}, bodies=bodies, gravity=weight)
        run = gr.inverse_dynamics(motion, loads)
        for found in (run.drive, run.motion_effort):  # by equilibrium and by the equations of motion
            assert found[-1, 0] == pytest.approx(torque, rel=0, abs=1e-11 * np.abs(torques).max())
        names = {joint["id"]: f"R({'-'.join(joint['links'])})" for joint in machine["joints"]}
        for link, signs in machine["reaction_signs"].items():
            for joint, sign in signs.items():
                found = sign * run.statics.force(names[joint], link=link)[-1]
                assert found == pytest.approx(row["reactions"][gravity][joint], rel=0, abs=1e-11 * largest), (
                    joint,
                    link,
                )
