"""The overconstrained subchains and the clusters by whole bases of stresses and motions, written out densely."""

import numpy as np

from gruebler.structure.mobility.prime_field import (
    P,
    echelon,
    left_null_space,
    modular_product,
    null_space,
    reduced_echelon,
    transposed,
)

BUDGET = 200
LARGEST = 60


def clusters(rank):
    """The links by equal twists in every vector of a basis of the motions."""
    found = {}
    for i, link in enumerate(rank.chain.links):
        found.setdefault(rank.motions[:, i].tobytes(), []).append(link)
    return [tuple(cluster) for cluster in found.values()]


def supports(rank):
    """(links, joints, redundancy, minimal, removing, freeing) of each subchain, sorted as the library sorts them."""
    if rank.redundancy == 0:
        return []
    found = []
    for basis in _connected_parts(rank, _stresses(rank)):
        found += _Part(rank, basis).minimal_supports()
    return sorted(found, key=lambda part: (len(part[0]), part[1]))


def loaded(rank):
    """The links and the joints that some stress loads."""
    loads = [
        (rank.chain.links[link], joint)
        for joint, on_links in _loads(rank, _stresses(rank)).items()
        for link, load in on_links.items()
        if load.any()
    ]
    return {link for link, _ in loads}, {joint for _, joint in loads}


def _stresses(rank):
    rows = rank.placement.rows
    return null_space(echelon(transposed(rows, rank.placement.columns), len(rows)))


def _connected_parts(rank, stresses):
    root = list(range(len(stresses)))

    def find(i):
        while root[i] != i:
            root[i] = i = root[root[i]]
        return i

    multiple = {number for number, joint in enumerate(rank.chain.joints) if joint.count > 1}
    loaded = {}
    for row, (joint, *_) in enumerate(rank.placement.owners):
        place = (joint, 0) if joint in multiple else (-1, row)
        loaded.setdefault(place, []).extend(int(i) for i in np.flatnonzero(stresses[:, row]))
    for sharing in loaded.values():
        for other in sharing[1:]:
            root[find(other)] = find(sharing[0])
    parts = {}
    for i in range(len(stresses)):
        parts.setdefault(find(i), []).append(i)
    return [stresses[members] for members in parts.values()]


class _Part:
    def __init__(self, rank, basis):
        self.chain = rank.chain
        self.dimension = len(basis)
        on_links = {}
        on_joints = {}
        for joint, loads in _loads(rank, basis).items():
            for link, load in loads.items():
                if load.any():
                    on_links.setdefault(link, []).append(load)
                    on_joints.setdefault(joint, []).append(load)
        self.on_links = {link: np.hstack(loads) for link, loads in sorted(on_links.items())}
        self.on_joints = {joint: np.hstack(loads) for joint, loads in sorted(on_joints.items())}
        self.classes = {left_null_space(load).tobytes(): load for load in self.on_links.values()}

    def minimal_supports(self):
        whole = np.eye(self.dimension, dtype=np.int64)
        if self.dimension == 1:
            return [self._describe(whole, minimal=True)]
        if self.dimension > LARGEST:
            return [self._describe(whole, minimal=False)]
        found = []
        seen = {whole.tobytes()}
        todo = [whole]
        while todo:
            space = todo.pop()
            smaller = self._without_one_class(space)
            if not smaller:
                found.append(self._describe(space, minimal=True))
            todo += [sub for key, sub in smaller.items() if key not in seen]
            seen.update(smaller)
            if len(seen) > BUDGET:
                return [*found, self._describe(whole, minimal=False)]
        return found

    def _without_one_class(self, space):
        out = {}
        if len(space) > 1:
            for load in self.classes.values():
                kernel = left_null_space(modular_product(space, load))
                if 0 < len(kernel) < len(space):
                    smaller = reduced_echelon(modular_product(kernel, space))
                    out[smaller.tobytes()] = smaller
        return out

    def _describe(self, space, *, minimal):
        links = tuple(
            self.chain.links[link] for link, load in self.on_links.items() if modular_product(space, load).any()
        )
        joints, removing = [], []
        for joint, load in self.on_joints.items():
            loaded = modular_product(space, load)
            if loaded.any():
                joints.append(joint)
                if len(left_null_space(loaded)) == 0:
                    removing.append(joint)
        freeing = tuple(joints) if len(space) == 1 else ()
        return links, tuple(joints), len(space), minimal, tuple(removing), freeing


def _loads(rank, basis):
    out = {}
    width = {number: len(f) for number, f in enumerate(rank.placement.functionals)}
    for row, (joint, first, other, k) in enumerate(rank.placement.owners):
        column = basis[:, row]
        if not column.any():
            continue
        loads = out.setdefault(joint, {})
        for link, sign in ((first, -1), (other, 1)):
            load = loads.setdefault(link, np.zeros((len(basis), width[joint]), np.int64))
            load[:, k] = (load[:, k] + sign * column) % P
    return out
