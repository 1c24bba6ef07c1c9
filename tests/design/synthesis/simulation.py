"""A simulation of one-loop linkages by another hand: the crank goes in small steps, what it leads follows.

Nothing of `circuit`, `move` or a closed form is used: a linkage is its pin, and two places for what it leads, as
circles, lines and cones cut each other. No sign, limit, branch or order is known by a theorem. Places are complex
numbers, on the sphere unit vectors along a last axis.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

STEP = np.radians(0.05)
"""Of the crank; shorter where its pin would go by more than `SHARE` of a short link, so that no fold is jumped."""
SHARE = 0.02
MET = 1e-9
"""Sizes, by which a target may be missed, divided by the sine of the angle at which the last group transmits there."""
LAP = 2 * np.pi


def gap(first, second):
    """Distances of places."""
    between = np.asarray(first) - second
    return np.abs(between) if np.iscomplexobj(between) else np.linalg.norm(between, axis=-1)


@dataclass(frozen=True, kw_only=True)
class Loop:
    """A linkage: what its crank leads, and where the targets want both."""

    pin: Any
    """From crank angles, counted from the first target, to places of the crank's pin."""
    both: Any
    """From pins to both places of what is led, not a number where there are none, and the sines of transmission."""
    led: Any
    """At the first target."""
    due: Any
    """(targets,) the crank angle at each target, between 0 and a lap; none where only a point is known."""
    wanted: Any
    """(targets, ...) what is led there; or the points."""
    size: float
    arm: float
    """The shortest length by which the pin is led, beside the length of the crank."""
    crank: float
    pins: Any = None
    """(targets, ...) where the crank's pin is wanted."""
    point: Any = None
    """From pin and what is led to the point whose places are wanted; none where whole poses are."""


@dataclass(frozen=True)
class Way:
    """What the crank passes in one sense, from the first target on."""

    turned: Any
    led: Any
    sines: Any
    full: bool
    """Whether it comes to a whole lap."""


def followed(loop, sense, other=False):
    """The way of a loop, begun at the first target on its own side or on the other one."""
    step = min(STEP, SHARE * loop.arm / loop.crank)
    turned = np.append(np.arange(0, LAP, step), LAP)
    places, sines = loop.both(loop.pin(sense * turned))
    for _ in range(14):  # near a fold the other place is near, and the way quick: steps as the square of the sine
        least = np.fmin(sines[1:], sines[:-1])
        long = np.flatnonzero(np.diff(turned) > 0.1 * loop.arm / loop.crank * least**2)
        if not len(long):
            break
        turned = np.insert(turned, long + 1, (turned[long] + turned[long + 1]) / 2)
        places, sines = loop.both(loop.pin(sense * turned))
    known = ~np.isnan(sines)
    end = len(turned) if known.all() else int(np.argmin(known))
    if end < len(turned):  # the last piece in ever shorter steps, to the limit
        low, high = turned[max(end - 1, 0)], turned[end]
        for _ in range(60):
            middle = (low + high) / 2
            _, there = loop.both(loop.pin(sense * np.array([middle])))
            low, high = (low, middle) if np.isnan(there[0]) else (middle, high)
        tail = low - (low - turned[max(end - 1, 0)]) * (1 - np.arange(1, 65) / 64) ** 2
        more, fine = loop.both(loop.pin(sense * tail))
        good = ~np.isnan(fine)
        turned = np.append(turned[:end], tail[good])
        places = [np.concatenate([old[:end], new[good]]) for old, new in zip(places, more, strict=True)]
        sines = np.append(sines[:end], fine[good])
    count = len(turned)
    pairs = np.stack(places, axis=1)  # (rows, 2, ...)
    gaps = [gap(pairs[1:, k], pairs[:-1, m]) for k, m in ((0, 0), (1, 0), (0, 1), (1, 1))]
    at = int(gap(pairs[0, 1], loop.led) < gap(pairs[0, 0], loop.led)) ^ other
    chosen = np.empty(count, int)
    chosen[0] = at
    stays = [gaps[0] <= gaps[1], gaps[3] <= gaps[2]]
    for k in range(count - 1):
        at = at if stays[at][k] else 1 - at
        chosen[k + 1] = at
    led = pairs[np.arange(count), chosen]
    return Way(turned, led, sines, full=end == len(places[0]) and turned[-1] == LAP)


def at_turn(loop, way, sense, turn):
    """What is led at a crank angle between two rows: the place that is nearer to the line between these."""
    k = min(int(np.searchsorted(way.turned, turn, side="right")) - 1, len(way.turned) - 2)
    share = (turn - way.turned[k]) / (way.turned[k + 1] - way.turned[k])
    near = way.led[k] + share * (way.led[k + 1] - way.led[k])
    places, sines = loop.both(loop.pin(sense * np.array([turn])))
    first, second = (place[0] for place in places)
    return (first if gap(first, near) <= gap(second, near) else second), float(sines[0])


def _passed_by_pose(loop, way, sense):
    """(turn, target) where the way meets targets whose poses are known."""
    for target, (angle, wanted) in enumerate(zip(loop.due, loop.wanted, strict=True)):
        turn = (sense * angle) % LAP
        if LAP - turn < 1e-12:
            turn = 0.0
        if turn <= way.turned[-1]:
            led, sine = at_turn(loop, way, sense, turn)
            pin_off = 0.0 if loop.pins is None else gap(loop.pin(np.array([angle]))[0], loop.pins[target])
            if gap(led, wanted) <= MET * loop.size / max(sine, 1e-12) and pin_off <= MET * loop.size:
                yield turn, target


def _passed_by_point(loop, way, sense):
    """(turn, target) where the point of the way meets places: where it is nearest to them, by golden sections."""

    def at(turn):
        return loop.point(loop.pin(sense * np.array([turn]))[0], at_turn(loop, way, sense, turn)[0])

    points = loop.point(loop.pin(sense * way.turned), way.led)
    for target, wanted in enumerate(loop.wanted):
        far = gap(points, wanted)
        reach = np.append(gap(points[1:], points[:-1]), 0)
        reach = np.maximum(reach, np.roll(reach, 1)) + 1e-12
        least = np.flatnonzero(
            (far <= np.append(np.inf, far[:-1])) & (far <= np.append(far[1:], np.inf)) & (far < 3 * reach)
        )
        for k in least:
            low, high = way.turned[max(k - 1, 0)], way.turned[min(k + 1, len(far) - 1)]
            ratio = (np.sqrt(5) - 1) / 2
            for _ in range(70):
                first, second = high - ratio * (high - low), low + ratio * (high - low)
                nearer = gap(at(first), wanted) < gap(at(second), wanted)
                low, high = (low, second) if nearer else (first, high)
            turn = (low + high) / 2
            _, sine = at_turn(loop, way, sense, turn)
            if gap(at(turn), wanted) <= 10 * MET * loop.size / max(sine, 1e-12):
                yield turn, target


@dataclass(frozen=True)
class Simulated:
    """What came of a simulation."""

    circuit: bool
    """All targets are reached without taking the linkage apart."""
    passes: bool
    """All are passed without a turn of the drive, in order if that is asked."""
    turns: bool
    transmission: float
    """The least one on the way, in radians; not a number where the way is not in order."""


def simulated(loop, *, in_order=True):
    """The verdict on a loop."""
    count = len(loop.wanted)
    met, best, full = set(), None, False
    for other in (False, True):
        ways = {sense: followed(loop, sense, other) for sense in (1, -1)}
        full = all(way.full for way in ways.values())
        if other and full:
            break  # no limit leads to the other side
        passed = _passed_by_pose if loop.point is None else _passed_by_point
        events = [(sense * turn, target) for sense, way in ways.items() for turn, target in passed(loop, way, sense)]
        met |= {target for _, target in events}
        best = _best_way(loop, ways, events, count, full, in_order) or best
    return Simulated(
        circuit=len(met) == count, passes=best is not None, turns=full, transmission=np.nan if best is None else best[0]
    )


def _best_way(loop, ways, events, count, full, in_order):
    """The least transmission angle of the shortest way through all targets, in a row; none if there is no way."""
    if full:  # what the crank passes within two laps, from one lap on
        events = sorted({(round(turn % LAP, 9), target) for turn, target in events})
        events = [(turn + lap * LAP, target) for lap in (-1, 0, 1) for turn, target in events]
    ways_through = []
    for sense in (1, -1):
        along = sorted((sense * turn, target) for turn, target in events)
        for k, (begin, first) in enumerate(along):
            if in_order and first != 0:
                continue
            found = _end_in_order(along[k:], count) if in_order else _end_of_all(along[k:], count)
            if found is not None and (not full or found - begin < LAP - 1e-9):
                ways_through.append((found - begin, sense * begin, sense * found))
    if not ways_through:
        return None
    shortest = min(way[0] for way in ways_through)
    angles = [least_angle(loop, ways, *sorted(way[1:])) for way in ways_through if way[0] < shortest + 1e-7]
    return (max(angles),)


def _end_in_order(along, count):
    """Where the last of all targets is passed, each after the one before; at one place two may be."""
    due = 0
    for turn, target in along:
        if target == due:
            due += 1
            if due == count:
                return turn
    return None


def _end_of_all(along, count):
    seen = set()
    for turn, target in along:
        seen.add(target)
        if len(seen) == count:
            return turn
    return None


def least_angle(loop, ways, begin, end):
    """The least transmission angle from one crank angle to another one."""
    least = np.pi / 2
    for sense, way in ways.items():
        for lap in (-1, 0, 1) if way.full else (0,):
            low, high = sorted((sense * (begin + lap * LAP), sense * (end + lap * LAP)))
            low, high = max(low, 0.0), min(high, way.turned[-1])
            if low >= high:
                continue
            within = way.turned[(way.turned > low) & (way.turned < high)]
            rows = np.concatenate([[low], within, [high]])
            for _ in range(3):  # about the least one again, a hundred times as fine
                sines = loop.both(loop.pin(sense * rows))[1]
                k = int(np.nanargmin(sines))
                least = min(least, float(np.arcsin(min(1.0, sines[k]))))
                rows = np.linspace(rows[max(k - 1, 0)], rows[min(k + 1, len(rows) - 1)], 201)
    return least


# --- what the linkages are -----------------------------------------------------------------------------------------


def cut(pin, coupler, centre, rocker):
    """Both places of a rocker's end, and how its coupler transmits: circles about pin and centre."""
    line = centre - pin
    distance = np.abs(line)
    with np.errstate(invalid="ignore", divide="ignore"):
        along = (coupler**2 - rocker**2 + distance**2) / (2 * distance)
        across = np.sqrt(coupler**2 - along**2)
        places = [pin + line / distance * (along + side * 1j * across) for side in (1, -1)]
    sine = np.abs(np.imag(np.conj(places[0] - pin) * (places[0] - centre))) / (coupler * rocker)
    return places, sine


def on_line(pin, coupler, through, along):
    """Both places of a slider's pin: a circle about the pin and a line; transmitted is at right angles to the line."""
    seen = (pin - through) * np.conj(along)
    with np.errstate(invalid="ignore"):
        way = np.sqrt(coupler**2 - seen.imag**2)
    return [through + along * (seen.real + side * way) for side in (1, -1)], way / coupler


def through_point(pin, offset, pivot, reach):
    """Both directions, as places so far from the pin, of a line that passes a pivot and the pin at an offset."""
    gone = pivot - pin
    with np.errstate(invalid="ignore", divide="ignore"):
        way = np.sqrt(np.abs(gone) ** 2 - offset**2)
        directions = [reach * gone / (side * way + 1j * offset) for side in (1, -1)]
        return [pin + each for each in directions], way / np.abs(gone)


def cones(pin, coupler, centre, rocker):
    """Both axes at given angles from two, on the sphere, and the sine of the angle between the planes of the links."""
    cosine = pin @ centre
    square = 1 - cosine**2
    with np.errstate(invalid="ignore", divide="ignore"):
        x = (np.cos(coupler) - cosine * np.cos(rocker)) / square
        y = (np.cos(rocker) - cosine * np.cos(coupler)) / square
        flat = x[..., None] * pin + y[..., None] * centre
        height = np.sqrt(1 - np.sum(flat**2, axis=-1))
        normal = np.cross(pin, centre) / np.sqrt(square)[..., None]
        places = [flat + side * height[..., None] * normal for side in (1, -1)]
        sine = height * np.sqrt(square) / (np.sin(coupler) * np.sin(rocker))
    return places, sine


def placed(linkage, joint, link):
    """Where a pin or line of a link lies in the first position, and the direction of a line."""
    element, pose = linkage.elements[joint, link], linkage.required_pose[link]
    turn = np.exp(1j * pose.angle)
    return complex(pose.x, pose.y) + turn * complex(element.x, element.y), turn * np.exp(
        1j * getattr(element, "angle", 0.0)
    )


def plane_loop(design, size, poses=None, *, points=None, point=None):
    """The loop of a linkage driven at its joint 0, whose coupler has the joints 1 and 2, and the frame 0 and 3.

    Args:
        design: with its linkage.
        size: of the task.
        poses: from the crank's pivot, its pin, the pivot of the output and what is led, all in the first position, to
            pins and what is led at the targets.
        points: (targets,) that the point of the coupler passes, in place of poses.
        point: where it lies in the first position.
    """
    linkage = design.linkage
    output = next(link for link in linkage.mechanism.chain.links if link not in ("frame", "crank", "coupler"))
    a0, _ = placed(linkage, 0, "frame")
    a, _ = placed(linkage, 1, "crank")
    end, along = placed(linkage, 2, "coupler")
    b0, frame_line = placed(linkage, 3, "frame")
    kinds = [linkage.elements[key].form for key in ((1, "crank"), (2, "coupler"), (3, "frame"))]
    crank, lengths = abs(a - a0), [abs(b0 - a0)]
    if kinds == ["pin", "pin", "pin"]:
        coupler, rocker = abs(end - a), abs(end - b0)
        led, arm = end, min(coupler, rocker)
        lengths += [coupler, rocker]

        def both(pin):
            return cut(pin, coupler, b0, rocker)
    elif kinds == ["pin", "pin", "line"]:
        coupler = abs(end - a)
        led, arm = end, coupler
        lengths = [coupler]

        def both(pin):
            return on_line(pin, coupler, end, frame_line)
    elif kinds == ["pin", "line", "pin"] and output == "block":  # a line of the coupler passes the pivot
        offset = float(np.imag((b0 - a) * np.conj(along)))
        reach = max(size, crank, *lengths)
        led, arm = a + reach * along, max(abs(offset), 1e-3 * abs(b0 - a0))

        def both(pin):
            return through_point(pin, offset, b0, reach)
    elif kinds == ["pin", "line", "pin"]:  # a line of the rocker passes the crank's pin
        offset = float(np.imag((a - b0) * np.conj(along)))
        reach = max(size, crank, *lengths)
        led, arm = b0 + reach * along, max(abs(offset), 1e-3 * abs(b0 - a0))

        def both(pin):
            return through_point(b0 + 0 * pin, offset, pin, reach)
    else:
        return None
    pins, wanted = (None, points) if poses is None else poses(a0, a, b0, led)
    carried = 0j if point is None else (point - a) / (led - a)
    return Loop(
        pin=lambda turned: a0 + (a - a0) * np.exp(1j * turned),
        both=both,
        led=led,
        due=None if pins is None else np.angle((pins - a0) / (a - a0)),
        wanted=wanted,
        pins=pins,
        size=max(size, crank, *lengths),
        arm=arm,
        crank=crank,
        point=None if point is None else lambda pin, place: pin + carried * (place - pin),
    )


def sphere_loop(axes, turns):
    """The loop of a four-bar on the sphere with axes A0, A, B, B0 in the first orientation, and rotations from it."""
    a0, a, b, b0 = axes
    arcs = [np.arccos(np.clip(p @ q, -1, 1)) for p, q in zip(axes, axes[[1, 2, 3, 0]], strict=True)]
    across = np.cross(a0, a)
    pins, led = (np.concatenate([axis[None], turns @ axis]) for axis in (a, b))

    def pin(turned):
        turned = np.asarray(turned)[..., None]
        return np.cos(turned) * a + np.sin(turned) * across + (1 - np.cos(turned)) * (a0 @ a) * a0

    return Loop(
        pin=pin,
        both=lambda pins: cones(pins, arcs[1], b0, arcs[2]),
        led=b,
        due=np.arctan2(pins @ across, pins @ (a - (a0 @ a) * a0)),
        wanted=led,
        pins=pins,
        size=1.0,
        arm=min(np.sin(arcs[1]), np.sin(arcs[2])),
        crank=np.sin(arcs[0]),
    )


def loop_of_lengths(a, b, c=None, d=None, *, eccentricity=0.0):
    """A four-bar, or without `c` and `d` a slider-crank along the x axis, begun with its crank over the frame."""

    def both(pin):
        return on_line(pin, b, 1j * eccentricity, 1) if c is None else cut(pin, b, d + 0j, c)

    lengths = [each for each in (a, b, c, d) if each is not None]
    return Loop(
        pin=lambda turned: a * np.exp(1j * turned),
        both=both,
        led=both(np.array([a + 0j]))[0][0][0],
        due=None,
        wanted=None,
        size=max(lengths),
        arm=min(lengths[1:]),
        crank=a,
    )


def dead_centres(loop, output):
    """The crank angles at which the output of a loop that turns fully turns back, and its values there, refined.

    Where a difference of five values is zero, which is the derivative up to the fourth power of its step.
    """
    way = followed(loop, 1)
    values = np.unwrap(output(way.led))
    steps = np.diff(values)
    back = np.flatnonzero(np.sign(steps[1:]) != np.sign(steps[:-1])) + 1
    if np.sign(steps[0]) != np.sign(steps[-1]):
        back = np.append(back, 0)
    found = []
    h = 2e-4

    def at(turn):
        turn %= LAP
        raw = float(output(np.array([at_turn(loop, way, 1, turn)[0]]))[0])
        return raw + LAP * round((float(np.interp(turn, way.turned, values)) - raw) / LAP)

    def slope(turn):
        return 8 * (at(turn + h) - at(turn - h)) - (at(turn + 2 * h) - at(turn - 2 * h))

    for k in back:
        middle = way.turned[k]
        low, high = middle - 1.5 * STEP, middle + 1.5 * STEP
        begin = np.sign(slope(low))
        for _ in range(60):
            between = (low + high) / 2
            low, high = (between, high) if np.sign(slope(between)) == begin else (low, between)
        found.append((low % LAP, at(low)))
    return sorted(found)
