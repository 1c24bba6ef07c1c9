"""The page of a linkage in space as one HTML file: bodies that move, seen from all sides, without a server."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from math import pi
from pathlib import Path
from typing import Any

import numpy as np

from gruebler.base.atomic_files import write_whole
from gruebler.base.errors import GrueblerError
from gruebler.base.text import LANGUAGES, message
from gruebler.files.gltf import MovingSolids, link_colour, moving_solids, united
from gruebler.files.link_solids import round_solid
from gruebler.files.screws import screws_to_json
from gruebler.files.solids import Solid
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.screws.link_sizes import link_sizes
from gruebler.mechanics.screws.mobility_report import freedoms
from gruebler.mechanics.screws.resizing import can_be_resized
from gruebler.mechanics.screws.wheels import gear_rows
from gruebler.mechanics.space.outputs import against_frame, valued_freedoms
from gruebler.page.model import spaced
from gruebler.page.page import WHOLE_WINDOW, data_page, module_text, packed_element, page_styles, shadow_tree
from gruebler.pictures.canvas.page_policy import policy_element, script_element
from gruebler.pictures.structure.messages import title
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.chain.spaces import Freedom, Space
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entries, entry

_WORDS = {
    "hint": message("Drag a body to move the machine or the background to turn the view."),
    "turn": message("Drag the background to turn the view."),
    "pull": message("Drag a body"),
    "pulled": message("move the machine; the point that you drag draws its path"),
    "round": message("Drag the background, arrow keys on the picture"),
    "rounded": message("turn the view"),
    "near": message("Wheel, two fingers"),
    "nearer": message("zoom in and out"),
    "drives": message("Drives"),
    "turned": message("{link}: turn from the reference pose"),
    "total": message("{link}: total turn from the reference pose"),
    "all": message("{link}: total turn"),
    "shifted": message("{link}: shift from the reference pose"),
    "swing": message("{link}: swing"),
    "travel": message("{link}: travel"),
    "traced": message("{link}: dragged point"),
    "paths": message("Paths of points"),
    "spotted": message("Names of points"),
    "grid": message("Grid"),
    "view": message("View"),
    "oblique": message("Oblique"),
    "front": message("Front"),
    "side": message("Side"),
    "top": message("Top"),
    "none": message("No drive moves this linkage."),
    "driven": message("With a drive:"),
    "end": message("{drive} goes no farther while the other drives stand here."),
    "together": message("Not used yet: type the sizes that go with it as well, they are tried together."),
    "back": message("Put back"),
    "scaled": message("It does not fit alone: all lengths have changed in the same ratio."),
    "sign": message("Positive in the direction in which it goes farther."),
    "angle": message("Twist angle"),
    "crossed": message("angle"),
    "lost": message("The connection to gruebler is lost."),
    "axes": message("Distance and twist angle between the two axes of a link."),
    "mixed": message("Between two axes their distance and twist angle, otherwise the distance alone."),
    "apart": message("Distance between the two joints of a link."),
    "tilted": message("Angle between the two axes of a link."),
    "joints": message("Joints"),
    "placed": message("In the reference pose; coordinates x | y | z."),
    "place": message("place"),
    "axis": message("axis"),
    "x-axis": message("x axis"),
    "y-axis": message("y axis"),
    "z-axis": message("z axis"),
    "file": message("File"),
    "document": message("As gruebler reads it: gruebler explore FILE"),
    "bodied": message("Bodies"),
    "bodies": message("STL: bodies in the position that is shown; glTF: with its motion"),
    "stl": message("STL: bodies in the position that is shown"),
    "convert": message("With its motion, as glTF, and for other programs: gruebler convert FILE OUT"),
    "copied": message("The link is copied."),
    "without": message("It leads to the machine without the sizes that were changed here."),
    "flat": message("This browser cannot draw in space: it has no WebGL 2."),
}
_UNDRIVEN = message("It can move, but has no drive here.")
_AGAINST = message("{moved} relative to {still}")
_ALONE = message("The drives move one at a time here, since the page does not solve {joint}.")


@dataclass(frozen=True, slots=True)
class SpacePage:
    """The page of a linkage in space, which shows itself in a notebook cell and can be saved."""

    html: str
    height: int = 640
    """Of the cell, in pixels."""

    def save(self, path: Path | str) -> Path:
        """Write it as one HTML file, or not at all; returns the path."""
        write_whole(Path(path), self.html)
        return Path(path)

    def __repr__(self) -> str:
        return f"<SpacePage of {len(self.html) // 1000} kB>"

    def _repr_html_(self) -> str:
        style = f"width: 100%; height: {self.height}px; border: 0"
        return f'<iframe srcdoc="{escape(self.html)}" sandbox="allow-scripts" style="{style}"></iframe>'


def space_model(
    linkage: SpatialLinkage,
    *,
    titles: Mapping[str, str] | None = None,
    drives: Mapping[str, Sequence[str]] | None = None,
    links: Mapping[str, Sequence[str]] | None = None,
    letters: Mapping[str, Mapping[str, str]] | None = None,
    between: tuple[float, float] | None = None,
    driven: dict[str, Any] | None = None,
    home: bool = False,
    asks: bool = False,
) -> dict[str, Any]:
    """What the page shows: bodies, named points, and the poses of all links over the range of the one drive.

    With several drives the page moves them itself, from joints, ranges of the drives and rows of wheels. ``between``
    are values of the drives in place of all that they can reach.

    ``driven`` is the machine of the catalog that has a drive, by id and titles, where this one has none.

    ``titles`` and names of ``drives`` and ``links`` by language are those of the linkage unless they are given;
    ``letters`` tell by language what points are. With
    ``home`` the page with the other views lies above this one, in a server or a site. A page that ``asks``
    has other sizes and files from the server.
    """
    moving = moving_solids(linkage, between=between)
    live = _live(moving)
    chain, mechanism = linkage.mechanism.chain, linkage.mechanism
    words, unsolved = dict(_WORDS), _unsolved(linkage)
    if len(moving.motions) > 1 and unsolved is not None:
        words["alone"] = _ALONE.filled(joint=chain.joint_title(unsolved))
    if not mechanism.drives and freedoms(linkage).useful:
        words["none"] = _UNDRIVEN
    bodies = []
    for link in chain.links:
        round_ones = sum(body.link == link for body in linkage.round_bodies.values())  # they are its last
        solids = moving.solids[link][: len(moving.solids[link]) - round_ones]
        bodies.append(_body(link_colour(linkage, link), solids))
    glass = [
        _body(link_colour(linkage, body.link), (round_solid(body),)) | {"link": chain.index(body.link)}
        for body in linkage.round_bodies.values()
    ]
    spherical = chain.space is Space.SPHERICAL
    turning = [drive.turning for drive in mechanism.drives]
    read = list(_read_joints(linkage))
    return {
        "texts": {
            lang: {
                "title": (titles or {}).get(lang) or title(mechanism, lang),
                "drives": _short(mechanism, names)
                or [
                    spaced(name) for name in (drives or {}).get(lang, mechanism.drive_names(Alphabet.of_language(lang)))
                ],
                "links": [*names],
                "letters": dict((letters or {}).get(lang, {})),
                "joints": [_titled(linkage, names, joint, lang) for joint, _ in read],
                "words": {key: text.in_language(lang) for key, text in words.items()},
            }
            for lang in LANGUAGES
            for names in [[spaced(name) for name in (links or {}).get(lang, chain.links)]]
        },
        "home": home,
        "asks": asks,
        "resizable": asks and can_be_resized(linkage),
        "text": mechanism.text(),
        "names": list(chain.links),
        "ends": [[chain.index(link) for link in joint.links] for joint in chain.joints],
        "unit": "" if spherical else linkage.unit,
        "document": screws_to_json(linkage),
        "driven": driven,
        "between": between,
        "sizes": [
            {
                "link": chain.index(size.link),
                "distance": _rounded(size.distance) if size.distance else None,  # axes that meet have none
                "angle": None if size.angle is None else _rounded(size.angle),
            }
            for size in link_sizes(linkage)
            if size.distance or size.angle  # nothing lies between joints on one axis
        ],
        "outputs": [
            {"link": chain.index(link), "joint": joint and _read_joint(linkage, *joint)}
            for link in linkage.outputs
            for joint in _output_joints(linkage, link)
        ],
        "joints": [_read_joint(linkage, joint, freedom) for joint, freedom in read],
        "middle": [0.0, 0.0, 0.0] if spherical else linkage.centre.tolist(),
        "size": 1.0 if spherical else linkage.size,
        "bodies": bodies,
        "glass": glass,
        "points": [{"name": key, "link": chain.index(link), "at": at} for key, (link, at) in linkage.points.items()],
        "motions": [
            {
                "drive": k,
                "arrow": _arrow(linkage, k),
                "round": full,
                "unit": "°" if turning[k] else f" {linkage.unit}",
                "values": _numbers(np.degrees(motion.drives[:, k]) if turning[k] else motion.drives[:, k]),
                "poses": [] if live else [[_numbers(pose[:3], 9) for pose in row] for row in motion.poses[0]],
            }
            for _, k, motion, full in moving.named()
        ],
        "live": live,
    }


def _axial_joints(linkage: SpatialLinkage) -> Iterator[tuple[int, Freedom]]:
    """Turns and shifts in joints about or along one axis; not those of drives."""
    driven = {drive.joint for drive in linkage.mechanism.drives}
    freedoms: dict[int, list[Freedom]] = {}
    for number, freedom in valued_freedoms(linkage):
        freedoms.setdefault(number, []).append(Freedom(freedom))
    for number, own in freedoms.items():
        if number not in driven and len({each.axis for each in own}) == 1:
            yield from ((number, each) for each in own)


def _read_joints(linkage: SpatialLinkage) -> Iterator[tuple[int, Freedom]]:
    """Joints about or along one axis, but those of outputs against the frame."""
    ends = {linkage.mechanism.frame, *linkage.outputs}
    for number, freedom in _axial_joints(linkage):
        if not ends >= set(linkage.mechanism.chain.joints[number].links):
            yield number, freedom


def _output_joints(linkage: SpatialLinkage, link: str) -> list[tuple[int, Freedom]] | list[None]:
    """How an output turns about an axis of the frame, or shifts along it; one None if it has no such axis.

    Nothing of one that is driven itself.
    """
    mechanism = linkage.mechanism
    ends = {mechanism.frame, link}
    own = [each for each in _axial_joints(linkage) if ends == set(mechanism.chain.joints[each[0]].links)]
    driven = any(ends == set(mechanism.chain.joints[drive.joint].links) for drive in mechanism.drives)
    return own or ([] if driven else [None])


def _read_joint(linkage: SpatialLinkage, number: int, freedom: Freedom) -> dict[str, Any]:
    """What the page reads a joint by; positive as in tables of a motion, and right-handed about its axis."""
    chain = linkage.mechanism.chain
    return {
        "links": [chain.index(link) for link in chain.joints[number].links],
        "frame": linkage.frames[number, :3].ravel().tolist(),
        "axis": "xyz".index(freedom.axis),
        "turns": freedom.turns,
        "sign": against_frame(linkage, number),
        "number": _solved(linkage).index(number),
    }


def _solved(linkage: SpatialLinkage) -> list[int]:
    """The joints among those that the page solves: all but wheels."""
    return [k for k, joint in enumerate(linkage.mechanism.chain.joints) if not joint.pair.has_contours]


def _titled(linkage: SpatialLinkage, names: Sequence[str], number: int, lang: str) -> str:
    """Which link is measured against which in a joint, as its sign has it, without what names have in brackets."""
    first, second = linkage.mechanism.chain.joints[number].links[:2]
    if against_frame(linkage, number) < 0:
        first, second = second, first
    still, moved = (_bare(names[linkage.mechanism.chain.index(link)]) for link in (first, second))
    return _AGAINST.filled(still=still, moved=moved).in_language(lang)


def _arrow(linkage: SpatialLinkage, drive: int) -> dict[str, Any]:
    """Where the arrow of a drive stands: a place and a direction of a link, about or along which another one moves."""
    driven, chain = linkage.mechanism.drives[drive], linkage.mechanism.chain
    frame, links = linkage.mechanism.frame, chain.joints[driven.joint].links
    place = linkage.frames[driven.joint]
    along = place[:3, "xyz".index(driven.direction[-1])]
    return {
        "link": chain.index(frame if frame in links else links[0]),
        "at": _numbers(along if chain.space is Space.SPHERICAL else place[:3, 3]),
        "along": _numbers(along),
    }


def _body(colour: tuple[float, float, float], solids: Sequence[Solid]) -> dict[str, Any]:
    whole = united(solids) if solids else None
    return {
        "colour": colour,
        "vertices": [] if whole is None else _numbers(whole.vertices),
        "triangles": [] if whole is None else whole.triangles.ravel().tolist(),
    }


def _live(moving: MovingSolids) -> dict[str, Any] | None:
    """What moves several drives together: joints with frames and freedoms, ranges of the drives, rows of wheels.

    None for one drive, whose motion is there already, and for joints that the page does not solve.
    """
    linkage, mechanism = moving.linkage, moving.linkage.mechanism
    chain = mechanism.chain
    ranges = {
        k: (-pi, pi, True) if full else (float(motion.drives[0, k]), float(motion.drives[-1, k]), False)
        for _, k, motion, full in moving.named()
    }
    if len(ranges) < 2 or _unsolved(linkage) is not None:
        return None
    numbers = _solved(linkage)
    joints = []
    for k in numbers:
        joint = chain.joints[k]
        freedoms = joint.pair.freedoms[chain.space]
        joints.append(
            {
                "links": [chain.index(link) for link in joint.links],
                "frame": linkage.frames[k, :3].ravel().tolist(),
                "turns": "".join(sorted(f.axis for f in freedoms if f.turns)),
                "slides": "".join(sorted(f.axis for f in freedoms if f.travels)),
                "pitch": linkage.places[k].pitch,
            }
        )
    return {
        "frame": chain.index(mechanism.frame),
        "joints": joints,
        "drives": [
            {
                "joint": numbers.index(drive.joint),
                "axis": "xyz".index(drive.direction[-1]),
                "turns": drive.turning,
                "sign": against_frame(linkage, drive.joint),
                **dict(zip(("low", "high", "round"), ranges.get(k, (0.0, 0.0, False)), strict=True)),
            }
            for k, drive in enumerate(mechanism.drives)
        ],
        "gears": [[[numbers.index(joint), weight] for joint, weight in row.turns] for row in gear_rows(linkage)],
    }


def _unsolved(linkage: SpatialLinkage) -> int | None:
    """The first joint that the page does not solve: with a body between its links, or of more than two links."""
    joints = linkage.mechanism.chain.joints
    return next((k for k, each in enumerate(joints) if each.pair.has_body_between or len(each.links) > 2), None)


def _short(mechanism: Mechanism, names: Sequence[str]) -> list[str]:
    """Several drives by the links that they move, where these tell them apart; otherwise nothing."""
    moved = [next(link for link in reversed(each.between) if link != mechanism.frame) for each in mechanism.drives]
    apart = 1 < len(moved) == len(set(moved))
    whole = [names[mechanism.chain.index(link)] for link in moved] if apart else []
    short = [_bare(name) for name in whole]
    return short if len(set(short)) == len(whole) else whole


def _bare(name: str) -> str:
    """A name without what it has in brackets."""
    return re.sub(r" \(.*\)", "", name)


def machine_model(id: str, *, home: bool = False, asks: bool = False) -> dict[str, Any]:
    """The model of a machine of the catalog in space; `GrueblerError` for another one."""
    record = entry(id)
    if not record.in_space:
        raise GrueblerError("the catalog entry {id!r} has no linkage in space", id=id)
    placed = {lang: record.in_language(lang).placed() for lang in LANGUAGES}
    linkage = placed[LANGUAGES[0]]
    assert isinstance(linkage, SpatialLinkage)
    return space_model(
        linkage,
        titles={lang: record.name.in_language(lang) for lang in LANGUAGES},
        drives={
            lang: each.mechanism.drive_names(Alphabet.of_language(lang))
            for lang, each in placed.items()
            if each is not None
        },
        links={lang: list(record.link_names(lang).values()) for lang in LANGUAGES},
        letters=record.letters,
        between=record.between,
        driven=None if linkage.mechanism.drives else _driven(id),
        home=home,
        asks=asks,
    )


def _driven(id: str) -> dict[str, Any] | None:
    """The machine that is another one with something that drives it: its id goes on from that of the other one."""
    other = next((each for each in entries() if each.startswith(f"{id}_") and entry(each).drives), None)
    if other is None:
        return None
    return {"id": other, "titles": {lang: entry(other).name.in_language(lang) for lang in LANGUAGES}}


def _numbers(values: Any, digits: int = 6) -> list[float]:
    """Poses of a motion have more of them: its slopes are differences of rows."""
    return [_rounded(value, digits) for value in np.asarray(values).ravel().tolist()]


def _rounded(value: float, digits: int = 6) -> float:
    return float(f"{value:.{digits}g}")


def space_file(model: dict[str, Any], lang: str = "en") -> str:
    """One HTML file that loads nothing: its policy allows its own script only.

    It opens in the language, or in the one that an address names behind ``#``.
    """
    script, sheet = module_text("space"), page_styles("space")
    policy = policy_element(script, sheets=(WHOLE_WINDOW, sheet), asks=model["asks"])
    name = str(model["texts"][lang]["title"])
    element = packed_element("texts") + script_element(script, "module")
    return data_page(name, lang, model, element, policy, shadow_tree(sheet))
