"""Linkages in space as glTF 2.0 with their motion, and as STL, a file for each link.

Sources: the specification of glTF 2.0, Khronos Group, 2021 (ISO/IEC 12113:2022); StereoLithography Interface
Specification, 3D Systems, 1989, for binary STL: 80 bytes of header, a count, and 50 bytes a triangle.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, message
from gruebler.base.units import MILLIMETRES
from gruebler.files.link_solids import link_solids
from gruebler.files.solids import Solid
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.space.drive_ranges import followed, spatial_range
from gruebler.mechanics.space.motion import SpatialMotion
from gruebler.mechanics.space.sleeves import plane_travels, sleeve_travels
from gruebler.structure.chain.spaces import Space

_FRAMES = 73
_SECONDS = 4.0
_FLOAT, _UINT = 5126, 5125
_FRAME = (0.75, 0.72, 0.65)
_COLOURS = (
    (0.24, 0.50, 0.76),
    (0.87, 0.44, 0.12),
    (0.20, 0.62, 0.42),
    (0.62, 0.42, 0.72),
    (0.84, 0.66, 0.20),
    (0.40, 0.68, 0.82),
    (0.76, 0.27, 0.32),
    (0.47, 0.56, 0.22),
    (0.90, 0.56, 0.66),
    (0.33, 0.38, 0.64),
    (0.58, 0.42, 0.30),
    (0.24, 0.60, 0.62),
    (0.70, 0.30, 0.55),
)
_UP = [-(0.5**0.5), 0.0, 0.0, 0.5**0.5]  # glTF has y upwards, the linkage z: a quarter turn about x


@dataclass(frozen=True, eq=False, kw_only=True)
class MovingSolids:
    """The bodies of a linkage and where its links go, for viewers."""

    linkage: SpatialLinkage
    solids: Mapping[str, tuple[Solid, ...]]
    motions: tuple[SpatialMotion, ...]
    """One for each drive that moves alone, to and fro or round; none for a linkage that drives do not move."""
    round: tuple[bool, ...]
    """Whether the drive of each motion turns fully."""

    def named(self) -> list[tuple[str, int, SpatialMotion, bool]]:
        """The name and number of the drive of each motion, the motion, whether the drive turns fully."""
        names = self.linkage.mechanism.drive_names()
        moving = [int(np.argmax(np.ptp(motion.drives, axis=0))) for motion in self.motions]
        return [(names[k], k, motion, full) for k, motion, full in zip(moving, self.motions, self.round, strict=True)]


def moving_solids(
    linkage: SpatialLinkage, frames: int = _FRAMES, between: tuple[float, float] | None = None
) -> MovingSolids:
    """Bodies and motions: of each drive over its whole range while the others rest in the reference pose.

    ``between`` are other values of the drives, of all that turn or slide as the first one does and come so far.

    Cost: a second.
    """
    motions, full = [], []
    drives = linkage.mechanism.drives
    for number, drive in enumerate(drives):
        values = np.zeros((frames, len(drives)))
        if between is not None and drive.turning == drives[0].turning:
            values[:, number] = np.linspace(*between, frames)
            with suppress(LinkageError):
                motions.append(followed(linkage, values))
                full.append(False)
                continue
        with suppress(LinkageError):
            span = spatial_range(linkage, number)
            values[:, number] = span.inside(frames)
            motions.append(followed(linkage, values))
            full.append(span.full)
    still = np.tile(np.eye(4), (1, linkage.mechanism.chain.n, 1, 1))
    poses = np.concatenate([still, *(motion.poses[0] for motion in motions)])
    return MovingSolids(
        linkage=linkage,
        solids=link_solids(linkage, sleeve_travels(linkage, poses), plane_travels(linkage, poses)),
        motions=tuple(motions),
        round=tuple(full),
    )


def metres_a_unit(linkage: SpatialLinkage) -> float:
    """The length of the linkage's unit; a sphere is shown with a radius of 100 mm."""
    if linkage.mechanism.chain.space is Space.SPHERICAL:
        return 0.1
    return MILLIMETRES.get(linkage.unit, 1000.0) / 1000


def united(solids: Sequence[Solid]) -> Solid:
    """Several bodies as one list of triangles."""
    starts = np.cumsum([0, *(len(solid.vertices) for solid in solids[:-1])])
    return Solid(
        np.concatenate([solid.vertices for solid in solids]),
        np.concatenate([solid.triangles + start for solid, start in zip(solids, starts, strict=True)]),
    )


# --- glTF --------------------------------------------------------------------------------------------


def glb_from_linkage(
    linkage: SpatialLinkage, left_out: list[Message], between: tuple[float, float] | None = None
) -> bytes:
    """The bytes of a ``.glb`` file: bodies of links in metres, an animation for each drive.

    ``between`` are values over which the drives move one by one, in place of all that they can reach.
    """
    if linkage.unit and linkage.unit not in MILLIMETRES and linkage.mechanism.chain.space is not Space.SPHERICAL:
        left_out.append(message("the unit {unit}", unit=linkage.unit))
    moving = moving_solids(linkage, between=between)
    if not moving.motions:
        left_out.append(message("a motion: the drives do not move the linkage"))
    document = _Document(metres_a_unit(linkage))
    chain = linkage.mechanism.chain
    for link in chain.links:
        document.add_link(link, moving.solids[link], link_colour(linkage, link))
    for name, _, motion, full in moving.named():
        document.add_animation(name, motion, full)
    return document.written()


def link_colour(linkage: SpatialLinkage, link: str) -> tuple[float, float, float]:
    """Red, green and blue of a link: the frame is grey."""
    mechanism = linkage.mechanism
    moving = [each for each in mechanism.chain.links if each != mechanism.frame]
    return _FRAME if link == mechanism.frame else _COLOURS[moving.index(link) % len(_COLOURS)]


class _Document:
    """A glTF document as it grows: one buffer, views, accessors."""

    def __init__(self, scale: float) -> None:
        self.scale = scale
        self.data = bytearray()
        self.json: dict[str, Any] = {
            "asset": {"version": "2.0", "generator": "gruebler"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": [{"name": "linkage", "rotation": _UP, "children": []}],
            "meshes": [],
            "materials": [],
            "animations": [],
            "accessors": [],
            "bufferViews": [],
        }

    def _accessor(self, values: NDArray[Any], kind: str, target: int | None = None) -> int:
        rows = values.astype("<f4" if values.dtype.kind == "f" else "<u4")
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": rows.nbytes}
        self.data += rows.tobytes()
        self.json["bufferViews"].append(view if target is None else view | {"target": target})
        accessor: dict[str, Any] = {
            "bufferView": len(self.json["bufferViews"]) - 1,
            "componentType": _FLOAT if rows.dtype.kind == "f" else _UINT,
            "count": len(rows) if kind != "SCALAR" else rows.size,
            "type": kind,
        }
        if rows.dtype.kind == "f" and kind in ("SCALAR", "VEC3"):
            columns = rows.reshape(accessor["count"], -1)
            accessor |= {"min": columns.min(axis=0).tolist(), "max": columns.max(axis=0).tolist()}
        self.json["accessors"].append(accessor)
        return len(self.json["accessors"]) - 1

    def add_link(self, link: str, solids: Sequence[Solid], colour: tuple[float, float, float]) -> None:
        """A node with a mesh: flat faces, so every triangle has its own corners and normal."""
        node: dict[str, Any] = {"name": link}
        if solids:
            whole = united(solids)
            corners = whole.vertices[whole.triangles] * self.scale
            normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            normals /= np.linalg.norm(normals, axis=1)[:, None]
            attributes = {
                "POSITION": self._accessor(corners.reshape(-1, 3), "VEC3", 34962),
                "NORMAL": self._accessor(np.repeat(normals, 3, axis=0), "VEC3", 34962),
            }
            surface = {"baseColorFactor": [*colour, 1.0], "metallicFactor": 0.1, "roughnessFactor": 0.7}
            self.json["materials"].append({"name": link, "pbrMetallicRoughness": surface})
            primitive = {"attributes": attributes, "material": len(self.json["materials"]) - 1}
            self.json["meshes"].append({"name": link, "primitives": [primitive]})
            node["mesh"] = len(self.json["meshes"]) - 1
        self.json["nodes"].append(node)
        self.json["nodes"][0]["children"].append(len(self.json["nodes"]) - 1)

    def add_animation(self, name: str, motion: SpatialMotion, full: bool) -> None:
        """A turn, or there and back."""
        rows = np.arange(len(motion))
        if not full:
            rows = np.concatenate([rows, rows[-2::-1]])
        times = self._accessor(_SECONDS * np.linspace(0, 1, len(rows)), "SCALAR")
        animation: dict[str, Any] = {"name": name, "channels": [], "samplers": []}
        for number, link in enumerate(motion.linkage.mechanism.chain.links):
            turns = motion.quaternion(link)[rows][:, [1, 2, 3, 0]]
            places = motion.pose(link)[rows, :3, 3] * self.scale
            for path, values in (("rotation", turns), ("translation", places)):
                sampler = {"input": times, "output": self._accessor(values, "VEC4" if path == "rotation" else "VEC3")}
                animation["samplers"].append(sampler | {"interpolation": "LINEAR"})
                target = {"node": number + 1, "path": path}
                animation["channels"].append({"sampler": len(animation["samplers"]) - 1, "target": target})
        self.json["animations"].append(animation)

    def written(self) -> bytes:
        """The header and both chunks, padded to four bytes."""
        self.json["buffers"] = [{"byteLength": len(self.data)}]
        document = {key: value for key, value in self.json.items() if value != []}
        text = json.dumps(document, separators=(",", ":")).encode("utf-8")
        text += b" " * (-len(text) % 4)
        data = bytes(self.data) + b"\0" * (-len(self.data) % 4)
        length = 12 + 8 + len(text) + 8 + len(data)
        head = b"glTF" + np.array([2, length], "<u4").tobytes()
        chunks = [(len(text), b"JSON", text), (len(data), b"BIN\0", data)]
        return head + b"".join(np.array([size], "<u4").tobytes() + kind + content for size, kind, content in chunks)


# --- STL ---------------------------------------------------------------------------------------------


def stl_of_links(linkage: SpatialLinkage, left_out: list[Message]) -> dict[str, bytes]:
    """A binary STL for each link with bodies, in the linkage's unit and reference pose.

    The format says no unit: programs take it for millimetres.
    """
    left_out.append(message("motion, colours and the unit"))
    return {link: stl(united(solids)) for link, solids in moving_solids(linkage).solids.items() if solids}


def stl(solid: Solid) -> bytes:
    """The bytes of a binary STL."""
    corners = solid.vertices[solid.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths: Reals = np.linalg.norm(normals, axis=1)[:, None]
    rows = np.zeros(len(corners), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    rows["normal"], rows["corners"] = normals / np.maximum(lengths, np.finfo(float).tiny), corners
    return b"gruebler".ljust(80) + np.array([len(rows)], "<u4").tobytes() + rows.tobytes()
