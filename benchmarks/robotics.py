"""Linkages in space beside Pinocchio, a library of rigid bodies for robots: the same poses and rates, and their cost.

Optional: pip install pin. Pinocchio has a tree of the joints; what is left is closed by its constraints between points
(`PointAnchorConstraintModel`) with Newton's method; velocities and accelerations follow from their Jacobian. With
``figures`` the poses and rates that it finds are printed as JSON; tests/mechanics/space/pinocchio.json has them.
"""

import json
import sys
import time
from importlib import import_module
from typing import Any

import numpy as np

from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.space import move
from gruebler.teaching.catalog import entry

MACHINES = {  # where each drive goes to, in radians and in the linkage's unit, and its speed there
    "wiper_rssr": ([2.4], [3.0]),
    "bennett": ([1.9], [2.0]),
    "sarrus": ([0.35], [-1.5]),
    "schatz": ([2.2], [1.3]),
    "cardan_shaft": ([1.1], [4.0]),
    "susp_spatial": ([0.2], [2.0]),
    "susp_rack": ([0.15, 6.0], [-1.0, 40.0]),
    "delta": ([0.3, -0.2, 0.25], [1.0, 2.0, -1.5]),
    "gough": ([9.0, -7.0, 5.0, 8.0, -6.0, 4.0], [30.0, 20.0, -10.0, 5.0, -25.0, 40.0]),
    "cargo_bike": ([0.5], [1.2]),
}
ROWS = 361


class Tree:
    """The joints of a linkage as a model of Pinocchio; balls and, if there are none, turning joints are cut."""

    def __init__(self, linkage: SpatialLinkage) -> None:
        self.pin = pin = import_module("pinocchio")
        self.linkage, chain = linkage, linkage.mechanism.chain
        self.model = pin.Model()
        driven = [drive.joint for drive in linkage.mechanism.drives]
        order = sorted(range(len(chain.joints)), key=lambda k: (k not in driven, self._cost(k), k))
        sets = {link: link for link in chain.links}
        kept, cut = [], []
        for k in order:
            one, other = (sets[link] for link in chain.joints[k].links)
            (cut if one == other else kept).append(k)
            sets = {link: one if of == other else of for link, of in sets.items()}
        self.on = {linkage.mechanism.frame: (0, pin.SE3.Identity())}
        """The joint of each link, and the coordinates of the reference pose seen from it."""
        self.joints: dict[int, tuple[int, int]] = {}
        while kept:
            k = next(k for k in kept if any(link in self.on for link in chain.joints[k].links))
            kept.remove(k)
            upper, lower = sorted(chain.joints[k].links, key=lambda link: link not in self.on)
            joint, sign = self._model(k, 1 if chain.joints[k].links[0] == upper else -1)
            number, home = self.on[upper]
            place = pin.SE3(linkage.frames[k])
            mine = self.model.addJoint(number, joint, home * place, str(k))
            self.on[lower] = mine, place.inverse()
            self.joints[k] = mine, sign
        self.data = self.model.createData()
        self.closed = []
        for k in cut:
            ends = [0.0] if chain.joints[k].pair.is_ball else [-linkage.size, linkage.size]
            for along in ends:
                point = linkage.frames[k] @ (0, 0, along, 1)
                (a, on_a), (b, on_b) = (self.on[link] for link in chain.joints[k].links)
                at = pin.SE3(np.eye(3), point[:3])
                each = pin.PointAnchorConstraintModel(self.model, a, on_a * at, b, on_b * at)
                self.closed.append((each, each.createData()))
        self.free = np.ones(self.model.nv, bool)
        self.driven = []
        for drive in linkage.mechanism.drives:
            number, sign = self.joints[drive.joint]
            against = chain.joints[drive.joint].links[1] == linkage.mechanism.frame
            self.driven.append((number, sign * (-1 if against else 1)))
            self.free[self.model.joints[number].idx_v] = False
        self.q = pin.neutral(self.model)

    def _cost(self, k: int) -> int:
        pair = self.linkage.mechanism.chain.joints[k].pair
        return 2 if pair.is_ball else int(pair.is_turning)

    def _model(self, k: int, forward: int) -> tuple[Any, int]:
        pin, pair = self.pin, self.linkage.mechanism.chain.joints[k].pair
        if pair.is_turning:
            return pin.JointModelRZ(), forward
        if pair.is_ball:
            return pin.JointModelSpherical(), forward
        if pair.is_sliding:
            return pin.JointModelPX(), forward
        axes = np.eye(3)[:2] if forward > 0 else np.eye(3)[1::-1]
        return pin.JointModelUniversal(*axes), forward

    def _rows(self) -> Any:
        """The Jacobian of the constraints at the data that were worked out last."""
        self.pin.computeJointJacobians(self.model, self.data)
        return np.concatenate([each.jacobian(self.model, self.data, own) for each, own in self.closed])

    def _passive(self, rows: Any, values: Any) -> Any:
        whole = np.zeros(self.model.nv)
        whole[self.free] = np.linalg.lstsq(rows[:, self.free], values, rcond=1e-9)[0]
        return whole

    def go(self, drives: Any) -> int:
        """Close the loops at these values of the drives, from where they are; returns the turns of Newton's method."""
        for (number, sign), value in zip(self.driven, drives, strict=True):
            self.q[self.model.joints[number].idx_q] = sign * value
        for turn in range(20):
            self.pin.forwardKinematics(self.model, self.data, self.q)
            for each, own in self.closed:
                each.calc(self.model, self.data, own)
            gap = np.concatenate([own.constraint_position_error for _, own in self.closed])
            if abs(gap).max() < 1e-12 * self.linkage.size:
                return turn
            self.q = self.pin.integrate(self.model, self.q, self._passive(self._rows(), -gap))
        raise ArithmeticError(f"open by {abs(gap).max():.1e}")

    def rates(self, speeds: Any) -> None:
        """Velocities and accelerations of all joints, the drives at constant speeds."""
        v = np.zeros(self.model.nv)
        for (number, sign), value in zip(self.driven, speeds, strict=True):
            v[self.model.joints[number].idx_v] = sign * value
        rows = self._rows()
        v += self._passive(rows, -rows @ v)
        self.pin.forwardKinematics(self.model, self.data, self.q, v, np.zeros(self.model.nv))
        drift = np.concatenate([self._drift(each) for each, _ in self.closed])
        self.pin.forwardKinematics(self.model, self.data, self.q, v, self._passive(rows, -drift))

    def _drift(self, each: Any) -> Any:
        """Of a constraint between points, in its first frame: their accelerations without those of the joints."""
        ends = []
        for joint, at in ((each.joint1_id, each.joint1_placement), (each.joint2_id, each.joint2_placement)):
            velocity, drift = at.actInv(self.data.v[joint]), at.actInv(self.data.a[joint])
            turn = (self.data.oMi[joint] * at).rotation
            ends.append((turn, turn @ (drift.linear + np.cross(velocity.angular, velocity.linear))))
        (turn, first), (_, second) = ends
        return turn.T @ (second - first)

    def of(self, link: str, point: Any) -> dict[str, list[float]]:
        """Pose of a link against the reference pose, its angular rates, and those of a point of the reference pose."""
        joint, home = self.on[link]
        at = home * self.pin.SE3(np.eye(3), np.array(point, float))
        place = self.data.oMi[joint] * at
        velocity, acceleration = at.actInv(self.data.v[joint]), at.actInv(self.data.a[joint])
        turn = place.rotation
        classical = acceleration.linear + np.cross(velocity.angular, velocity.linear)
        found = {
            "turn": turn.ravel(),
            "place": place.translation,
            "angular velocity": turn @ velocity.angular,
            "velocity": turn @ velocity.linear,
            "angular acceleration": turn @ acceleration.angular,
            "acceleration": turn @ classical,
        }
        return {name: [float(f"{number:.14g}") for number in values] for name, values in found.items()}


def figures() -> dict[str, Any]:
    """What Pinocchio finds, half way and at the end: of every link that is no rod a point that is no joint's."""
    found: dict[str, Any] = {"source": f"Pinocchio {import_module('pinocchio').__version__}, benchmarks/robotics.py"}
    for name, (reach, speeds) in MACHINES.items():
        linkage = entry(name).placed()
        tree, rows = Tree(linkage), []
        idle = move(linkage, np.zeros((1, len(reach)))).idle
        for step in range(1, 41):
            drives = np.array(reach) * step / 40
            tree.go(drives)
            if step % 20 == 0:
                tree.rates(speeds)
                links = {
                    link: tree.of(link, linkage.centre + 0.1 * linkage.size)
                    for link in linkage.mechanism.chain.links
                    if link != linkage.mechanism.frame and link not in idle
                }
                rows.append({"drives": drives.tolist(), "links": links})
        found[name] = {"speeds": speeds, "rows": rows}
    return found


def microseconds(tree: Tree, path: Any, speeds: Any) -> tuple[float, float]:
    """For one pose, and for one with rates."""
    times = []
    for rated in (False, True):
        best = np.inf
        for _ in range(3):
            tree.q = tree.pin.neutral(tree.model)
            start = time.process_time()
            for drives in path:
                tree.go(drives)
                if rated:
                    tree.rates(speeds)
            best = min(best, time.process_time() - start)
        times.append(best / len(path) * 1e6)
    return times[0], times[1]


def main() -> None:
    try:
        print(f"Pinocchio {import_module('pinocchio').__version__}")
    except ImportError:
        print("pin is not installed")
        return
    print(
        f"{'microseconds for one pose':30} {'ours':>7} {'rates':>7} {'Pinocchio':>10} {'rates':>7} {'tree alone':>11}"
    )
    for name, (reach, speeds) in MACHINES.items():
        linkage = entry(name).placed()
        path = np.linspace(0, 1, ROWS)[:, None] * reach
        tree = Tree(linkage)
        ours = []
        for order in (0, 2):
            best = np.inf
            for _ in range(9):
                start = time.process_time()
                move(linkage, path, speed=speeds, order=order)
                best = min(best, time.process_time() - start)
            ours.append(best / len(path) * 1e6)
        theirs = microseconds(tree, path, speeds)
        v = np.zeros(tree.model.nv)
        start = time.process_time()
        for _ in range(20_000):
            tree.pin.forwardKinematics(tree.model, tree.data, tree.q, v, v)
        alone = (time.process_time() - start) / 20_000 * 1e6
        print(f"{name:30} {ours[0]:7.2f} {ours[1]:7.2f} {theirs[0]:10.0f} {theirs[1]:7.0f} {alone:11.2f}")


if __name__ == "__main__":
    if sys.argv[1:] == ["figures"]:
        print(json.dumps(figures()).replace('"links"', '\n"links"').replace('{"turn"', '\n{"turn"'))
    else:
        main()
