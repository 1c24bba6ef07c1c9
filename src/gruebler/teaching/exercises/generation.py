"""Generated tasks, from the enumeration of chains and from random sensible dimensions; each id gives a fixed task."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from functools import lru_cache
from itertools import count as counting
from math import degrees, radians
from random import Random
from typing import NamedTuple

from gruebler.base.errors import GrueblerError
from gruebler.base.text import Message, in_every_language, joined, joined_by_and, message
from gruebler.files import Exercise
from gruebler.files.catalog_records import Question
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.space import SphericalFourBar
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import in_alphabets, pair
from gruebler.structure.enumeration import chains
from gruebler.structure.mobility import counted, mobility_report
from gruebler.teaching.exercises.solution import figure
from gruebler.teaching.exercises.solving import solve

LEVELS = (1, 2, 3)
Given = dict[str, float | str]


class _Draft(NamedTuple):
    """A task in draft: method, given quantities, keys of the results, the text."""

    method: str
    given: Given
    asked: tuple[str, ...]
    task: Message


def generate(kind: str, seed: int, level: int = 1) -> Exercise:
    """A task of a kind and a level from 1 (easy) to 3; its id names all three.

    Raises `GrueblerError` for an unknown kind or level, or a seed below 0.

    >>> task = generate("dead-centre", seed=7)
    >>> task.id, task.given
    ('dead-centre-1-7', {'a': 30, 'b': 100, 'unit': 'mm'})
    """
    if kind not in KINDS:
        raise GrueblerError("the kinds of fresh tasks are {kinds}, not {kind!r}", kinds=", ".join(KINDS), kind=kind)
    if level not in LEVELS:
        raise GrueblerError("the level is 1, 2 or 3, not {level!r}", level=level)
    if not isinstance(seed, int) or not 0 <= seed < 10**9:
        raise GrueblerError("the seed is a whole number from 0 to 999999999, not {seed!r}", seed=seed)
    name, maker = KINDS[kind]
    random = Random(f"gruebler {kind} {level} {seed}")
    title = in_every_language(message("{kind}, level {level}", kind=name, level=level).in_language)
    id = f"{kind}-{level}-{seed}"
    while True:
        method, given, keys, text = maker(random, level)
        questions = tuple(Question(key) for key in keys)
        task_text = in_every_language(text.in_language)
        task = Exercise(id=id, name=title, source="", task=task_text, method=method, given=given, asked=questions)
        if kind not in _MEASURED or _distinguishes_mistakes(task):
            return task


_MEASURED = ("dead-centre", "transmission-angle", "velocity", "universal-joint", "differential")
_APART = 5e-3  # relative, of a likely mistake from the right answer


def _distinguishes_mistakes(task: Exercise) -> bool:
    """Whether no likely mistake is so near the right answer that it would count as right."""
    solution = solve(task)
    keys = {question.key for question in task.asked}
    pairs = [(m.value, solution[m.key]) for m in solution.mistakes if m.key in keys]
    return all(
        abs(wrong - correct) > _APART * abs(correct)
        for wrong, correct in pairs
        if isinstance(wrong, float) and isinstance(correct, float)
    )


_GENERATED = re.compile(r"([a-z-]+)-(\d)-(\d{1,9})")


def is_generated(text: str) -> bool:
    """Whether a text is the id of a generated task."""
    match = _GENERATED.fullmatch(text)
    return match is not None and match[1] in KINDS


def generated_from_id(id: str) -> Exercise:
    """The generated task of an id."""
    match = _GENERATED.fullmatch(id)
    if match is None:
        raise GrueblerError("a fresh task is named KIND-LEVEL-SEED, such as grashof-1-7, not {id!r}", id=id)
    return generate(match[1], int(match[3]), int(match[2]))


# --- chains -----------------------------------------------------------------------------------------


def _mobility(random: Random, level: int) -> _Draft:
    chain = _typed(random, level)
    while mobility_report(chain).generic != max(counted(chain), 0):
        chain = _typed(random, level)
    shuffled = _shuffled(random, chain)
    kinds = {joint.pair for joint in shuffled.joints}
    task = message(
        "Count links and joints of the planar chain {chain} ({letters}; the numbers name the links) and "
        "find its mobility F.",
        chain=in_alphabets(shuffled.text),
        letters=joined(text for name, text in _LETTERS.items() if pair(name) in kinds),
    )
    return _Draft("mobility.chain", {"chain": str(shuffled)}, ("n", "g1", "g2", "F"), task)


def _shuffled(random: Random, chain: Chain) -> Chain:
    """The chain with its links renumbered at random."""
    names = random.sample(range(1, chain.n + 1), chain.n)
    return chain.renamed({link: str(name) for link, name in zip(chain.links, names, strict=True)})


def _typed(random: Random, level: int) -> Chain:
    chain = random.choice(_structures(level))
    if level > 1:
        chain = _with_pairs(random, chain, "prismatic", random.choice((1, 1, 2)))
    return _with_pairs(random, chain, "roll_slide", random.choice((1, 2))) if level > 2 else chain


_LETTERS = {
    "revolute": message("R: revolute joint"),
    "prismatic": message("P: prismatic joint"),
    "roll_slide": message("G: rolling and sliding joint"),
}


@lru_cache
def _structures(level: int) -> list[Chain]:
    sizes = ((4, 1), (5, 2), (5, 0), (6, 1), (7, 2)) if level == 1 else ((6, 1), (7, 2), (8, 1))
    joints = 0 if level == 1 else "1-2"
    return [chain for n, mobility in sizes for chain in chains(n, mobility, multiple_joints=joints)]


def _with_pairs(random: Random, chain: Chain, kind: str, number_: int) -> Chain:
    """The chain with some of its simple revolutes replaced by another pair."""
    places = [k for k, joint in enumerate(chain.joints) if joint.pair.is_turning and joint.count == 1]
    chosen = set(random.sample(places, min(number_, len(places))))
    joints = [(kind if k in chosen else joint.pair.name, joint.links) for k, joint in enumerate(chain.joints)]
    return Chain(joints, links=chain.links)


def _dyad(random: Random, level: int) -> _Draft:
    is_dyad = random.random() < 0.6
    sizes = {1: ((4, 1), (5, 2)), 2: ((5, 2), (6, 3)), 3: ((6, 1),)}[level]
    size = random.choice(sizes if is_dyad or level == 3 else ((5, 2), (6, 3)))
    start = _shuffled(random, random.choice(list(chains(*size))))
    given: Given = {"chain": str(start)}
    chain = in_alphabets(start.text)
    keys: tuple[str, ...] = ("F_before", "F_after")
    more = [message("How does F change?")]
    if level > 1:
        keys += ("chains",)
        more.append(message("How many essentially different chains can result (names of the links aside)?"))
    if is_dyad or level == 3:
        given["form"], kind = random.choice(_DYADS if level > 1 else _DYADS[:1])
        method = "dyads.dyad"
        task = message(
            "Extend the chain {chain} by a dyad of {joints} between two of its links.", chain=chain, joints=kind
        )
    else:
        method = "dyads.coupler"
        task = message(
            "Connect two links of the chain {chain} by a coupler with two revolute joints, so that no rigid "
            "triangle results.",
            chain=chain,
        )
    return _Draft(method, given, keys, joined([task, *more], " "))


_DYADS = (
    ("RRR", message("three revolute joints")),
    ("RPR", message("two revolute joints and a prismatic one between them")),
    ("RRP", message("two revolute joints and a prismatic one at one end")),
)
"""Forms of dyads and their descriptions."""


# --- dimensions -------------------------------------------------------------------------------------


def _until(make: Callable[[], Given], is_good: Callable[[Given], bool]) -> Given:
    for tried in counting():
        given = make()
        if is_good(given):
            return given
        if tried > 100_000:
            raise AssertionError("no sensible dimensions found")
    raise AssertionError


def _lengths(random: Random, **ranges: tuple[int, int]) -> Iterator[tuple[str, int]]:
    for name, (low, high) in ranges.items():
        yield name, 5 * random.randint(low, high)


def _given_lengths(given: Given, names: str = "abcde") -> Message:
    """The lengths as a task states them."""
    lengths = {name: abs(float(given[name])) for name in names if given.get(name)}
    return joined_by_and([message("{name} = {length} mm", name=k, length=figure(v)) for k, v in lengths.items()])


def _four_bar(given: Given) -> FourBar:
    return FourBar(**{name: float(given[name]) for name in "abcd"})


def _any_four_bar(random: Random) -> Given:
    return dict(_lengths(random, a=(3, 12), b=(6, 25), c=(5, 22), d=(6, 25)))


def _change_point(random: Random) -> Given:
    """With a + d = b + c, d the longest."""
    given = _any_four_bar(random)
    return given | {"d": max(5.0, float(given["b"]) + float(given["c"]) - float(given["a"]))}


def _good_rocker(given: Given) -> bool:
    """Whether it is a crank-rocker without change point and with a good transmission angle."""
    size = _four_bar(given)
    return size.type.key == "crank_rocker" and size.transmission_angle.smallest.mu > 0.35


def _grashof(random: Random, level: int) -> _Draft:
    if level == 1:
        type_key = random.choice(_TYPES)
        make = _change_point if type_key.startswith("change") else _any_four_bar
        given = _until(lambda: make(random), lambda g: _four_bar(g).type.key == type_key)
        task = message(
            "A four-bar has the crank, coupler, rocker and frame {lengths}. Does the crank a turn fully, and "
            "what kind of mechanism is it?",
            lengths=_given_lengths(given),
        )
        return _Draft("grashof.condition", given | {"unit": "mm"}, ("sum_ends", "sum_others", "turns", "type"), task)
    free = random.choice("bcd") if level == 2 else "d"
    given = _until(lambda: _any_four_bar(random), lambda g: _range_worth_asking(g, free, level))
    del given[free]
    task = message(
        "A four-bar has {lengths} (a crank, b coupler, c rocker, d frame). Within which limits may the "
        "length {free} lie for a crank-rocker with the rotating crank a?",
        lengths=_given_lengths(given),
        free=free,
    )
    keys: tuple[str, ...] = (f"{free}_min", f"{free}_max")
    if level == 3:
        keys += ("shortest_upper",)
        more = message("Up to which length of the frame does a turn fully with the frame as the shortest link?")
        task = joined([task, more], " ")
    return _Draft("grashof.length_range", given | {"free": free, "unit": "mm"}, keys, task)


_TYPES = (
    "crank_rocker",
    "crank_rocker",
    "double_crank",
    "grashof_double_rocker",
    "triple_rocker",
    "change_point_crank_rocker",
)
"""The types of four-bars of the first level."""


def _range_worth_asking(given: Given, free: str, level: int) -> bool:
    a, *others = sorted(float(given[name]) for name in "abcd" if name != free)
    if a != given["a"] or len({a, *others}) < 3:
        return False
    short, long = others
    return level == 2 or a + short > long


def _slider(random: Random, eccentric: bool) -> Given:
    def make() -> Given:
        given: Given = dict(_lengths(random, a=(3, 12), b=(8, 30)))
        return given | ({"e": random.choice((5, 10, 15, 20, 25))} if eccentric else {})

    def is_good(given: Given) -> bool:
        a, b, e = float(given["a"]), float(given["b"]), float(given.get("e", 0))
        size = SliderCrank(a, b, e)
        return size.turning == ("a",) and (a + e) / b < 0.85 and b >= 1.6 * a and e != a

    return _until(make, is_good)


def _dead_centre(random: Random, level: int) -> _Draft:
    if level < 3:
        given = _slider(random, level == 2)
        keys: tuple[str, ...] = ("l_a", "l_i", "H") if level == 1 else ("H", "φ_max", "time_ratio")
        task = message(
            "A central slider-crank has {lengths}. Find the dead centres and the stroke H."
            if level == 1
            else "An eccentric slider-crank has {lengths}. Find the dead centres and the stroke H, the larger crank "
            "angle between the dead centres and the ratio of times.",
            lengths=_given_lengths(given),
        )
        return _Draft("dead_centres.slider_crank", given | {"unit": "mm"}, keys, task)
    given = _until(lambda: _any_four_bar(random), lambda g: _good_rocker(g) and not _four_bar(g).is_central)
    rpm = random.choice((60, 120, 150, 200, 240, 300, 400))
    task = message(
        "A crank-rocker has {lengths}; the crank makes {rpm} revolutions per minute. Find the "
        "directions φ_i and φ_a of the coupler's line in the inner and the outer dead centre, the larger crank angle "
        "between them, the swing of the rocker and the times of both strokes.",
        lengths=_given_lengths(given),
        rpm=rpm,
    )
    keys = ("φ_i", "φ_a", "φ_max", "ψ_H", "T_max", "T_min")
    return _Draft("dead_centres.crank_rocker", given | {"rpm": rpm, "unit": "mm"}, keys, task)


def _transmission(random: Random, level: int) -> _Draft:
    if level < 3:
        given = _slider(random, level == 2)
        task = message(
            "A central slider-crank has {lengths}. Find the largest deviation angle and the smallest "
            "transmission angle."
            if level == 1
            else "An eccentric slider-crank has {lengths}. Find the largest deviation angle and the smallest "
            "transmission angle.",
            lengths=_given_lengths(given),
        )
        return _Draft("transmission_angle.slider_crank", given | {"unit": "mm"}, ("α_max", "μ_min"), task)
    given = _until(lambda: _any_four_bar(random), _good_rocker)
    task = message(
        "A crank-rocker has {lengths}. Find the transmission angle in both frame positions and the smallest one. Is it "
        "at least 40°?",
        lengths=_given_lengths(given),
    )
    keys = ("μ_I*", "μ_II*", "μ_min", "good")
    return _Draft("transmission_angle.four_bar", given | {"unit": "mm"}, keys, task)


def _velocity(random: Random, level: int) -> _Draft:
    omega, phi = random.choice((5, 8, 10, 12, 20)), 5 * random.randint(4, 31)
    if level < 3:
        given = _slider(random, level == 2) | {"phi": phi, "omega": omega, "unit": "mm"}
        task = message(
            "A central slider-crank has {lengths}. The crank turns counter-clockwise at ω = {omega} 1/s and "
            "stands at φ = {phi}° to the slider's path. Find the velocity of the slider."
            if level == 1
            else "An eccentric slider-crank has {lengths} (e above the crank's pivot). The crank turns "
            "counter-clockwise at ω = {omega} 1/s and stands at φ = {phi}° to the slider's path. Find the "
            "velocity and acceleration of the slider.",
            lengths=_given_lengths(given, "abe"),
            omega=omega,
            phi=phi,
        )
        return _Draft("velocities.slider_crank", given, ("v_B",) if level == 1 else ("v_B", "a_B"), task)
    given = _until(lambda: _any_four_bar(random), _good_rocker)
    task = message(
        "A crank-rocker has {lengths}, B above the line A-B0. The crank turns counter-clockwise at ω = {omega} 1/s "
        "and stands at φ = {phi}° to the frame. Find the velocity of B, the transmission ratio and the "
        "acceleration of B.",
        lengths=_given_lengths(given),
        omega=omega,
        phi=phi,
    )
    return _Draft("velocities.four_bar", given | {"phi": phi, "omega": omega, "unit": "mm"}, ("v_B", "i", "a_B"), task)


# --- in space ---------------------------------------------------------------------------------------


def _universal_joint(random: Random, level: int) -> _Draft:
    beta, n = random.choice((15, 18, 20, 24, 25, 28, 30, 32, 35, 40)), 50 * random.randint(6, 40)
    given: Given = {"beta": beta, "n": n}
    task = message(
        "Two shafts with the bend angle β = {beta}° between them are joined by a universal joint; the input turns "
        "evenly at n_1 = {n} 1/min. Between which speeds does the output turn?",
        beta=beta,
        n=n,
    )
    if level == 1:
        return _Draft("in_space.universal_joint", given, ("n_min", "n_max"), task)
    more = message(
        "How large is the irregularity U = (n_max - n_min)/n_1, and by how much does the output lead at most?"
    )
    if level == 2:
        keys: tuple[str, ...] = ("n_min", "n_max", "U", "ε_max")
        return _Draft("in_space.universal_joint", given, keys, joined([task, more], " "))
    phi = 5 * random.randint(4, 14)
    more = message(
        "Find the angle and the speed of the output where the input has turned by φ = {phi}° from the position in "
        "which its fork lies in the plane of both shafts.",
        phi=phi,
    )
    keys = ("n_min", "n_max", "ψ", "n_2")
    return _Draft("in_space.universal_joint", given | {"phi": phi}, keys, joined([task, more], " "))


def _arcs(given: Given) -> SphericalFourBar:
    return SphericalFourBar(*(radians(float(given[name])) for name in "abcd"))


def _spherical_grashof(random: Random, level: int) -> _Draft:
    wanted = "crank_rocker" if level == 3 else random.choice(_TYPES[:5])
    highest = 17 if level == 1 else 30

    def is_good(given: Given) -> bool:
        size, total = _arcs(given), sum(float(given[name]) for name in "abcd")
        long_enough = (total > 360) == (level == 2)
        if not long_enough or size.type.key != wanted or len({given[name] for name in "abcd"}) < 4:
            return False
        return level < 3 or degrees(size.transmission_angle.smallest.mu) > 20

    given = _until(
        lambda: dict(_lengths(random, a=(4, highest), b=(4, highest), c=(4, highest), d=(4, highest))), is_good
    )
    task = message(
        "The axes of a four-bar meet in one point. Crank, coupler, rocker and frame have the arcs {arcs}. Does the "
        "crank a turn fully, and what kind of mechanism is it?",
        arcs=joined_by_and([message("{name} = {arc}°", name=k, arc=figure(float(given[k]))) for k in "abcd"]),
    )
    keys: tuple[str, ...] = ("sum_ends", "sum_others", "turns", "type") if level == 1 else ("total", "turns", "type")
    if level == 3:
        more = message("Find the swing of the rocker and the smallest transmission angle.")
        task, keys = joined([task, more], " "), ("turns", "type", "ψ_H", "μ_min")
    return _Draft("in_space.spherical_grashof", given, keys, task)


def _differential(random: Random, level: int) -> _Draft:
    if level == 3:
        v, radius = 5 * random.randint(3, 10), random.choice((6, 8, 9, 10, 12, 15, 20))
        diameter, track = 10 * random.randint(52, 70), random.randint(130, 165) / 100
        task = message(
            "A car goes at v = {v} km/h through a curve whose radius is R = {radius} m in the middle of the driven "
            "axle; the track is s = {track} m, the wheels have the diameter D = {diameter} mm. Find the speeds of the "
            "carrier of the differential and of both axle shafts.",
            v=v,
            radius=radius,
            track=figure(track),
            diameter=diameter,
        )
        given: Given = {"v": v, "diameter": diameter, "radius": radius, "track": track}
        return _Draft("in_space.differential_in_a_curve", given, ("n_C", "n_1", "n_2"), task)
    n_c = 10 * random.randint(10, 60)
    n_1 = 0 if level == 2 and random.random() < 0.3 else n_c + 5 * random.choice((-9, -7, -5, -3, 3, 5, 7, 9))
    given = {"n_C": n_c, "n_1": n_1}
    task = message(
        "The carrier of a bevel differential turns at n_C = {carrier} 1/min, one axle shaft at n_1 = {shaft} 1/min. "
        "Find the speed n_2 of the other one.",
        carrier=n_c,
        shaft=n_1,
    )
    if level == 1:
        return _Draft("in_space.differential", given, ("n_2",), task)
    teeth: Given = {"z_s": random.choice((14, 16, 18, 20)), "z_p": random.choice((9, 10, 11, 12))}
    more = message(
        "The axle wheels have z_s = {sun} teeth, the planets z_p = {planet}. How fast do the planets turn against the "
        "carrier?",
        sun=teeth["z_s"],
        planet=teeth["z_p"],
    )
    return _Draft("in_space.differential", given | teeth, ("n_2", "n_p"), joined([task, more], " "))


KINDS: dict[str, tuple[Message, Callable[[Random, int], _Draft]]] = {
    "mobility": (message("Mobility"), _mobility),
    "grashof": (message("Grashof's theorem"), _grashof),
    "dead-centre": (message("Dead centres"), _dead_centre),
    "transmission-angle": (message("Transmission angle"), _transmission),
    "dyad": (message("Dyad and coupler"), _dyad),
    "velocity": (message("Velocities"), _velocity),
    "universal-joint": (message("Universal joint"), _universal_joint),
    "spherical-grashof": (message("Grashof on the sphere"), _spherical_grashof),
    "differential": (message("Bevel differential"), _differential),
}
"""Name and generator of each kind."""
