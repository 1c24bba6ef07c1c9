"""Andrews' squeezing mechanism: seven moving links, published angles at the start and after 0.03 s.

Data, names of angles and solution: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II (Springer), section
VII.7; test set for initial value problem solvers (Bari, formerly CWI), "andrews". Lengths in metres. The angles at
0.03 s are those of that test set; the drive stands 2.5 turns on there.
"""

import numpy as np
import pytest

import gruebler as gr
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism

A, B = -0.06934 - 0.00227j, -0.03635 + 0.03273j
D, E, RR, SS, U, ZF, ZT = 0.028, 0.02, 0.007, 0.035, 0.04, 0.02, 0.04

NAMES = ("beta", "Theta", "gamma", "Phi", "delta", "Omega", "epsilon")
START = dict(
    zip(
        NAMES,
        (
            -0.0617138900142764496358948458001,
            0.0,
            0.455279819163070380255912382449,
            0.222668390165885884674473185609,
            0.487364979543842550225598953530,
            -0.222668390165885884674473185609,
            1.23054744454982119249735015568,
        ),
        strict=True,
    )
)
END = dict(
    zip(
        NAMES,
        (
            15.81077119629904,
            -15.75637105984298,
            0.04082224013073101,
            -0.5347301163226948,
            0.5244099658805304,
            0.5347301163226948,
            1.048080741042263,
        ),
        strict=True,
    )
)


def e(angle):
    return complex(np.cos(angle), np.sin(angle))


def places(q):
    """Joints in the plane for the seven angles; the common joint P by four chains, which must meet."""
    crank = RR * e(q["beta"])
    h = A - 1j * U * e(q["epsilon"])
    g = A + ZT * e(q["delta"])
    three = (
        crank - D * e(q["beta"] + q["Theta"]),
        B - 1j * SS * e(q["gamma"]),
        g - 1j * E * e(q["Phi"] + q["delta"]),
        h + ZF * e(q["Omega"] + q["epsilon"]),
    )
    return crank, three, g, h


@pytest.mark.parametrize("q", [START, END], ids=["start", "end"])
def test_the_published_angles_close(q):
    _, meeting, _, _ = places(q)
    assert max(abs(p - meeting[0]) for p in meeting) < 1e-15


def squeezer():
    crank, (p, *_), g, h = places(START)
    mechanism = Mechanism.parse(
        "R(0-K1) R(K1-K2) R(K2-K3-K4-K6) R(0-K3) R(K4-K5) R(K6-K7) R(0-K5-K7); frame=0; drive=R(0-K1)"
    )
    joints = {"R(0-K1)": 0j, "R(K1-K2)": crank, "R(K2-K3-K4-K6)": p, "R(0-K3)": B, "R(K4-K5)": g, "R(K6-K7)": h}
    joints["R(0-K5-K7)"] = A
    ends = {"P": ("K3", p), "crank": ("K1", crank), "G": ("K5", g), "H": ("K7", h)}
    return Linkage.from_drawing(
        mechanism,
        {name: (z.real, z.imag) for name, z in joints.items()},
        points={name: (link, z.real, z.imag) for name, (link, z) in ends.items()},
        unit="m",
    )


def angles(motion):
    """The seven angles of the last row, from the places of joints."""
    p, crank, g, h = (complex(*motion.point(name)[-1]) for name in ("P", "crank", "G", "H"))
    beta = motion.drives[-1, 0]
    delta, epsilon = np.angle(g - A), np.angle(1j * (h - A))
    return {
        "beta": beta,
        "Theta": np.angle(crank - p) - beta,
        "gamma": np.angle(1j * (p - B)),
        "Phi": np.angle(1j * (p - g)) - delta,
        "delta": delta,
        "Omega": np.angle(p - h) - epsilon,
        "epsilon": epsilon,
    }


@pytest.mark.parametrize("wanted", [START, END], ids=["start", "after 0.03 s"])
def test_the_published_angles_are_reached(wanted):
    path = np.linspace(START["beta"], wanted["beta"], 400)
    motion = gr.move(squeezer(), path)
    assert motion.complete, motion.message()
    for name, angle in angles(motion).items():
        turned = (angle - wanted[name] + np.pi) % (2 * np.pi) - np.pi
        assert abs(turned) < 1e-13, name


def test_rates_at_the_start():
    """From rest the accelerations of the links are in fixed ratios; those of the test set at the start.

    beta'' = 14222.4439199541 and Theta'' = -10666.8329399655 are printed there; the others are 0 at first order, since
    the mechanism begins in a position where P does not move.
    """
    motion = gr.move(squeezer(), [START["beta"]], speed=0.0, acceleration=14222.4439199541, order=2)
    theta = motion.angular("K2", order=2)[0] - motion.angular("K1", order=2)[0]
    assert theta == pytest.approx(-10666.8329399655, rel=1e-12)
    for link in ("K3", "K4", "K5", "K6", "K7"):
        assert abs(motion.angular(link, order=2)[0]) < 1e-8
