"""Stages of a train: meshes that share a carrier and hang together, and which of their links are central."""

from __future__ import annotations

from collections.abc import Iterable

from gruebler.machines.gears.train import FRAME, Mesh, Train


def wheels_of(mesh: Mesh) -> tuple[tuple[str, float], ...]:
    """Links with the sizes of their wheels; one only where the second link slides."""
    both = ((mesh.a, float(mesh.size_a)), (mesh.b, float(mesh.size_b)))
    return both if mesh.traits.wheels == 2 else both[:1]


def mesh_groups(meshes: Iterable[Mesh]) -> list[list[Mesh]]:
    """Meshes with the same carrier that hang together by their links; bevel gears apart from others.

    >>> from gruebler.machines.gears import read_train
    >>> train = read_train("in:20 sun:40; sun:24 planet:18 ring:-60 on arm").train
    >>> [[str(mesh) for mesh in group] for group in mesh_groups(train.meshes)]
    [['gear in:20 sun:40'], ['gear sun:24 planet:18 on arm', 'gear planet:18 ring:-60 on arm']]
    """
    groups: list[list[Mesh]] = []
    for mesh in dict.fromkeys(meshes):
        links, kind = {mesh.a, mesh.b} - {FRAME}, (mesh.carrier, mesh.traits.crossing)
        joined = [
            group
            for group in groups
            if (group[0].carrier, group[0].traits.crossing) == kind
            and any(links & {known.a, known.b} for known in group)
        ]
        spot = groups.index(joined[0]) if joined else len(groups)
        groups = [group for group in groups if group not in joined]
        groups.insert(spot, [known for group in joined for known in group] + [mesh])
    return groups


def central_links(meshes: list[Mesh], train: Train) -> set[str]:
    """The links of a stage whose axis is that of its moving carrier; none on the frame, and none of bevel gears.

    Central are the frame, internal wheels and links that take part in other stages, and what meshes with planets only.

    >>> from gruebler.machines.gears import read_train
    >>> train = read_train("sun:24 planet:18 ring:-60 on arm").train
    >>> sorted(central_links(list(train.meshes), train))
    ['ring', 'sun']
    """
    if meshes[0].carrier == FRAME or meshes[0].traits.crossing:
        return set()
    mates: dict[str, list[str]] = {}
    for mesh in meshes:
        mates.setdefault(mesh.a, []).append(mesh.b)
        mates.setdefault(mesh.b, []).append(mesh.a)
    others = [mesh for mesh in train.meshes if mesh not in meshes]
    sure = {FRAME, *(link for mesh in others for link in (mesh.a, mesh.b, mesh.carrier))}
    sure |= {link for mesh in meshes for link, size in wheels_of(mesh) if size < 0}
    planets = {mate for link in sure for mate in mates.get(link, ())} - sure
    central = sure & set(mates)
    central |= {
        link for link in mates if link not in planets and (len(mates[link]) == 1 or planets.issuperset(mates[link]))
    }
    for mesh in meshes:
        if {mesh.a, mesh.b} <= central:
            central.discard(mesh.a if mesh.b in sure and mesh.a not in sure else mesh.b)
    return central or {meshes[0].a}
