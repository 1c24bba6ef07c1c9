"""The machines of the numeric mobility checks, and the classical paradoxical linkages, with dimensions."""

from math import cos, inf, pi, sin

import numpy as np

from gruebler.mechanics.screws import SpatialLinkage, exponential
from gruebler.structure.mechanism import Mechanism

Z = (0.0, 0.0, 1.0)


def planar(text, joints):
    return SpatialLinkage(Mechanism.parse(text), joints)


def locomotive(cranks, angle=0.7, error=0.0):
    """Cranks on one rod, the last one longer by an error."""
    crank = np.array([cos(angle), sin(angle)])
    text, places = [], []
    for k in range(cranks):
        text += [f"R(0-w{k})", f"R(w{k}-rod)"]
        foot = np.array([3.0 * k, 0.0])
        places += [foot, foot + crank * (1 + error * (k == cranks - 1))]
    return planar(" ".join(text), dict(enumerate(places)))


def strut(shift=0.0):
    """A parallelogram with a strut parallel to its coupler, its end moved along the rocker by a shift."""
    a, c = np.array([0.5, 1.2]), np.array([4.0, 0.0])
    places = [(0, 0), a, a + c, c, 0.4 * a, (0.4 + shift) * a + c]
    return planar("R(0-1) R(1-2) R(2-3) R(0-3) R(1-4) R(3-4)", dict(enumerate(places)))


def toolbox(error=0.0):
    a, c = np.array([0.3, 2.0]), np.array([3.0, 0.2])
    places = [(0, 0), c, 0.6 * a, 0.6 * a + c, a, a + c + (error, 0)]
    return planar("R(0-1) R(0-2) R(1-3) R(2-3) R(1-4) R(2-4)", dict(enumerate(places)))


def friction():
    contact = {"at": (3, 0), "y": (1, 0), "radii": (3, 2)}
    return planar("R(0-1) R(0-2) W(1-2)", {0: (0, 0), 1: (5, 0), 2: contact})


def friction_arm(pivot=(6.0, -3.0)):
    contact = {"at": (3, 0), "y": (1, 0), "radii": (3, 2)}
    return planar("R(0-1) W(1-2) R(2-3) R(0-3)", {0: (0, 0), 1: contact, 2: (5, 0), 3: pivot})


def gears():
    teeth = {"at": (3, 0), "y": (1, 0), "radii": (3, 2), "pressure": 0.35}
    return planar("R(0-1) R(0-2) G(1-2)", {0: (0, 0), 1: (5, 0), 2: teeth})


def geneva():
    """A pin on the driver in a slot of the wheel."""
    slot = {"at": (1.5, 1.2), "x": (-2.5, 1.2), "radii": (0, inf)}
    return planar("R(0-1) R(0-2) G(1-2)", {0: (0, 0), 1: (4, 0), 2: slot})


def geneva_dwell():
    """Two points of the locking disc, which turns about the driver's axis, in the wheel's arc."""
    arc = {
        k + 2: {"at": (1.5 * cos(t), 1.5 * sin(t)), "y": (cos(t), sin(t)), "radii": (1.5, -1.5 - 1e-3)}
        for k, t in enumerate((0.4, -0.4))
    }
    for place in arc.values():
        place["radii"] = (0.0, -1.5)
        place["at"] = (0.0, 0.0)
    return planar("R(0-1) R(0-2) G(1-2) G(1-2)", {0: (0, 0), 1: (4, 0)} | arc)


def slot(point, on_first=True):
    return {"at": point, "x": (1, 0), "radii": (inf, 0) if on_first else (0, inf)}


def lift():
    """A single scissor."""
    return planar(
        "R(0-1) G(0-2) R(1-2) R(2-3) G(1-3)",
        {0: (0, 0), 1: slot((8, 0)), 2: (4, 3), 3: (0, 6), 4: slot((8, 6), False)},
    )


def two_stage():
    return planar(
        "R(0-1) G(0-2) R(1-2) R(2-3) R(1-4) R(3-4) G(3-5) R(4-5)",
        {
            0: (0, 0),
            1: slot((8, 0)),
            2: (4, 3),
            3: (0, 6),
            4: (8, 6),
            5: (4, 9),
            6: slot((8, 12), False),
            7: (0, 12),
        },
    )


def two_scissors(apart):
    one = [(0, 0), slot((8, 0)), (4, 3), slot((8, 6), False), (0, 6)]

    def shifted(place):
        if isinstance(place, dict):
            return place | {"at": (place["at"][0] + apart, place["at"][1])}
        return (place[0] + apart, place[1])

    return planar(
        "R(0-1) G(0-2) R(1-2) G(1-5) R(2-5) R(0-3) G(0-4) R(3-4) G(3-5) R(4-5)",
        dict(enumerate([*one, *map(shifted, one)])),
    )


def differential(planets, sun=3.0, other=2.0, planet=1.0):
    """Suns outside and planets between them and an inner wheel: radii such that both mesh with every planet."""
    text = ["R(0-s1) R(0-s2) R(0-c)"]
    places = [(0, 0)] * 3
    for k in range(planets):
        t = 0.3 + 2 * pi * k / planets
        out = np.array([cos(t), sin(t)])
        axis = (sun + planet) * out
        text.append(f"R(c-p{k}) G(s1-p{k}) G(s2-p{k})")
        places += [
            tuple(axis),
            {"at": tuple(sun * out), "y": tuple(out), "radii": (sun, planet), "pressure": 0.35},
            {
                "at": tuple((sun + 2 * planet) * out),
                "y": tuple(-out),
                "radii": (-sun - 2 * planet, planet),
                "pressure": 0.35,
            },
        ]
    return planar(" ".join(text), dict(enumerate(places)))


def drafting():
    a, b, c, d = np.array([1.0, 3.0]), np.array([1.0, 0.2]), np.array([2.5, -1.0]), np.array([0.3, 1.0])
    places = [(0, 0), b, a, a + b, a, a + d, a + c, a + d + c]
    return planar("R(0-1) R(0-2) R(1-3) R(2-3) R(3-4) R(3-5) R(4-6) R(5-6)", dict(enumerate(places)))


def winch(tilt=0.0):
    text = "spatial: R(frame-spindle) H(spindle-nut) P(frame-nut)"
    slide = {"at": (0, 5, 0), "x": (sin(tilt), 0, cos(tilt))}
    return planar(text, {0: {"z": Z}, 1: {"z": Z, "pitch": 0.8}, 2: slide})


def bevel_in_space(planets):
    """A bevel differential with bodies in space: teeth as points that touch along the tangent of the pitch cones."""
    text, places = ["R(0-s1) R(0-s2) R(0-c)"], [{"z": (1, 0, 0)}] * 3
    for k in range(planets):
        t = 2 * pi * k / max(planets, 2)
        out, across = np.array([0, cos(t), sin(t)]), np.array([0, -sin(t), cos(t)])
        text.append(f"R(c-p{k}) ball_plane(s1-p{k}) ball_plane(s2-p{k})")
        places.append({"at": tuple(2 * out), "z": tuple(out)})
        places += [{"at": tuple(2 * out + side * np.array([2, 0, 0])), "y": tuple(across)} for side in (1, -1)]
    return planar("spatial: " + " ".join(text), dict(enumerate(places)))


def bevel(planets):
    """The same on a sphere, with rolling pitch cones of 45 degrees."""
    text, places = ["R(0-s1) R(0-s2) R(0-c)"], [{"z": (1, 0, 0)}] * 3
    for k in range(planets):
        t = 2 * pi * k / max(planets, 2)
        out = np.array([0, cos(t), sin(t)])
        text.append(f"R(c-p{k}) G(s1-p{k}) G(s2-p{k})")
        places.append({"z": tuple(out)})
        for side in (1, -1):
            sun = np.array([side, 0.0, 0.0])
            places.append({"z": tuple(out + sun), "y": tuple(out - sun), "radii": (pi / 4, pi / 4), "pressure": 0.0})
    return planar("spherical: " + " ".join(text), dict(enumerate(places)))


# --- the paradoxical linkages --------------------------------------------------------------------------------------


def along(*screws):
    """Joint axes of a loop by Denavit and Hartenberg's rows (turn, offset, length, twist), the last one closing it."""
    frame, out = np.eye(4), []
    for turn, offset, length, twist in screws:
        out.append({"at": tuple(frame[:3, 3]), "z": tuple(frame[:3, 2])})
        frame = frame @ exponential([0, 0, turn, 0, 0, offset]) @ exponential([twist, 0, 0, length, 0, 0])
    return out, frame


def bennett(a=2.0, alpha=0.7, beta=1.1, turn=1.0, error=0.0):
    """Bennett's linkage: opposite links equal, a / sin α = b / sin β; turn is the first joint angle."""
    b = a * sin(beta) / sin(alpha)
    # tan(θ1/2) tan(θ2/2) = sin((β + α)/2) / sin((β - α)/2)
    other = 2 * np.arctan2(sin((beta + alpha) / 2), sin((beta - alpha) / 2) * np.tan(turn / 2))
    rows = [(turn, 0, a, alpha), (other, 0, b, beta), (-turn, 0, a, alpha), (-other, 0, b, beta)]
    places, frame = along(*rows)
    places[2]["at"] = tuple(np.add(places[2]["at"], (error, 0, 0)))
    return planar("spatial: R(0-1) R(1-2) R(2-3) R(0-3)", dict(enumerate(places))), frame


def goldberg(bars, turn=1.1):
    """Five or six bars: Bennett linkages in a row, each on a link of the one before, which is left out, and the links
    beside it in one (M. Goldberg, Trans. ASME 65 (1943) 649-661).
    """

    def axes(a, alpha, b, turn):
        beta = np.arcsin(b / a * sin(alpha))
        other = 2 * np.arctan2(sin((alpha + beta) / 2), sin((beta - alpha) / 2) * np.tan(turn / 2))
        rows = [(turn, 0, a, alpha), (other, 0, b, beta), (-turn, 0, a, alpha), (-other, 0, b, beta)]
        frames = [np.eye(4)]
        for t, _, length, twist in rows[:3]:
            frames.append(frames[-1] @ exponential([0, 0, t, 0, 0, 0]) @ exponential([twist, 0, 0, length, 0, 0]))
        return [np.linalg.inv(frames[1]) @ frame for frame in frames], beta

    (one, _), (two, beta) = axes(1.2, 1.0, 0.9, turn), axes(1.2, 1.0, 0.6, turn)
    frames = [one[2], one[3], two[3], two[2], one[1]]
    if (
        bars == 6
    ):  # a third on the link from 1 to 2 of the second; its own angle at 1 is there -turn, that of the second
        beyond = np.arcsin(0.8 / 0.6 * sin(beta))
        start = 2 * np.arctan2(sin((beta + beyond) / 2), sin((beyond - beta) / 2) * np.tan(-turn / 2))
        three = [two[2] @ frame for frame in axes(0.6, beta, 0.8, start)[0]]
        frames[3:4] = three[2:]
    places = {k: {"at": tuple(g[:3, 3]), "z": tuple(g[:3, 2])} for k, g in enumerate(frames)}
    return planar("spatial: " + " ".join(f"R({k}-{(k + 1) % bars})" for k in range(bars)), places)


def bricard(kind, error=0.0, seed=3):
    """Three axes at random and their images by a half-turn about z; or two axes in a mirror, two beside it."""
    random = np.random.default_rng(seed)
    points, ways = random.normal(size=(2, 6, 3))
    if kind == "line":
        image = np.array([-1.0, -1.0, 1.0])
        points[3:], ways[3:] = points[:3] * image, ways[:3] * image
    else:
        image = np.array([1.0, 1.0, -1.0])
        points[[0, 3], 2] = ways[[0, 3], 2] = 0.0
        points[[5, 4]], ways[[5, 4]] = points[[1, 2]] * image, ways[[1, 2]] * image
    points[4, 0] += error
    text = "spatial: R(5-0) R(0-1) R(1-2) R(2-3) R(3-4) R(4-5)"
    return planar(text, {k: {"at": tuple(points[k]), "z": tuple(ways[k])} for k in range(6)})


def schatz(x, y=None, lengths=(1.0, 1.0, 1.0), offsets=(0.0, 0.0)):
    """Six axes at right angles but for two shafts, by the cosines of docs/theory/freedoms.md; Schatz's y if None.

    The shafts' distance and heights are what closes the loop; offsets of axes 3 and 4 lie between their links.
    """
    y = x / (x - 1) if y is None else y
    (first, middle, last), (sine, other) = lengths, np.sqrt(1 - np.square([x, y]))
    c, d = np.array([0, -offsets[0], 0]), np.array([middle, 0, offsets[1]])
    a, b = c + first * np.array([x, 0, sine]), d + last * np.array([-y, other, 0])
    second, fifth = (-sine, 0, x), (other, y, 0)
    shaft = tuple(np.cross(second, fifth))
    points, axes = [a, a, c, d, b, b], [shaft, second, (0, 1, 0), (0, 0, 1), fifth, shaft]
    text = "spatial: R(0-1) R(1-2) R(2-3) R(3-4) R(4-5) R(5-0)"
    return planar(text, {k: {"at": tuple(points[k]), "z": axes[k]} for k in range(6)})


def sarrus(tilt=0.0):
    """Two pairs of plates, hinged about x on one side and about y on the other."""
    one = [{"at": (0, y, z), "x": (1, 0, 0), "z": (1, 0, 0)} for y, z in ((0, 0), (1.5, 1.0), (0, 2.0))]
    two = [{"at": (x, 3, z), "z": (tilt, 1, 0)} for x, z in ((2, 0), (3.5, 1.0), (2, 2.0))]
    one = [{"at": p["at"], "z": p["z"]} for p in one]
    text = "spatial: R(0-1) R(1-2) R(2-3) R(0-4) R(4-5) R(5-3)"
    return planar(text, dict(enumerate([*one, *two])))


def hooke(bend=0.5, apart=0.0):
    """A cross joint between shafts that enclose an angle: four axes through one point (or apart)."""
    shaft = (cos(bend), sin(bend), 0)
    places = [
        {"at": (-3, 0, 0), "z": (1, 0, 0)},
        {"z": (0, 1, 0)},
        {"z": (0, 0, 1)},
        {"at": tuple(3 * np.array(shaft) + (0, 0, apart)), "z": shaft},
    ]
    return planar("spatial: R(0-in) R(in-cross) R(cross-out) R(0-out); drive=R(0-in)", dict(enumerate(places)))


def cardan(bend=0.5, other=0.5, aside=0.0):
    """Two cross joints with a shaft between them, input and output in one plane with it."""
    ends = (cos(bend), sin(bend), 0), (cos(other), -sin(other), 0)
    first = {"at": (0, 0, 0), "x": (-sin(bend), cos(bend), 0), "y": Z}
    second = {"at": (4, 0, 0), "x": Z, "y": (sin(other), cos(other), 0)}
    places = [{"at": (0, 0, aside), "z": ends[0]}, first, second, {"at": (4, 0, 0), "z": ends[1]}]
    return planar("spatial: R(0-in) U(in-shaft) U(shaft-out) R(0-out); drive=R(0-in)", dict(enumerate(places)))


def oldham(space="spatial"):
    axis = {"z": Z} if space == "spatial" else {}
    turned = {"z": Z} if space == "spatial" else {}
    places = [
        {"at": (0, 0, 0)} | axis,
        {"at": (0, 0, 0), "x": (1, 0.3, 0)} | turned,
        {"at": (1, 0, 0), "x": (-0.3, 1, 0)} | turned,
        {"at": (1, 0, 0)} | axis,
    ]
    return planar(f"{space}: R(0-1) P(1-2) P(2-3) R(0-3); drive=R(0-1)", dict(enumerate(places)))


def loop(number, seed=1):
    """A loop of revolute joints at random places."""
    random = np.random.default_rng(seed)
    text = " ".join(f"R({k}-{(k + 1) % number})" for k in range(number))
    return planar(
        f"spatial: {text}",
        {k: {"at": tuple(random.normal(size=3)), "z": tuple(random.normal(size=3))} for k in range(number)},
    )


def elsewhere(linkage, seed=5):
    """Moved as a whole, at random as far as the space allows."""
    twist = np.random.default_rng(seed).normal(size=6)
    space = linkage.mechanism.chain.space
    if space == "planar":
        twist[[0, 1, 5]] = 0
    if space == "spherical":
        twist[3:] = 0
    return linkage.moved(exponential(twist))


def tied_body(text):
    """A body on a ball of a crank, tied to the frame by three rods; where these are on the body and on the frame."""
    body = [(1.2, 0.1, 0.2), (0.1, 1.1, -0.3), (0.2, 0.2, 1.3)]
    frame = [(1.4, 1.6, 0.5), (-1.3, 1.4, 0.6), (0.4, -1.2, 1.5)]
    rods = " ".join(f"S(body-r{k}) S(r{k}-frame)" for k in range(3))
    mechanism = Mechanism.parse(f"spatial: {text} {rods}; frame=frame")
    crank = 0 if text.startswith("R") else 1
    places = {crank: {"z": Z}, 1 - crank: (0.6, 0, 0)}
    places |= {2 + 2 * k: body[k] for k in range(3)} | {3 + 2 * k: frame[k] for k in range(3)}
    return SpatialLinkage(mechanism, places).with_drives([crank]), body, frame
