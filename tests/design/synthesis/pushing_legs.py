"""The transmission angle of any plane linkage by another hand, after its definition in docs/theory/events.md.

The groups behind it are found by trying all sets of links, smallest first.
"""

from dataclasses import dataclass
from itertools import combinations

import numpy as np


def groups_of(linkage):
    """Links that move together, in solving order: the smallest sets whose joints hold them."""
    mechanism = linkage.mechanism
    known = {mechanism.frame, *mechanism.drives[0].between}
    rest, groups = [link for link in mechanism.chain.links if link not in known], []

    def conditions(some):
        total = 0
        for joint in mechanism.chain.joints:
            bodies = sum(link in some for link in joint.links)
            total += 2 * (bodies + any(link in known for link in joint.links) - 1) if bodies else 0
        return total

    while rest:
        group = next(
            some for n in range(1, len(rest) + 1) for some in combinations(rest, n) if conditions(set(some)) == 3 * n
        )
        groups.append(group)
        known |= set(group)
        rest = [link for link in rest if link not in group]
    return groups


@dataclass(frozen=True)
class Leg:
    """A link that pushes another one: joints as (number, link)."""

    link: str
    outer: int
    inner: int
    pushed: str
    guide: int | None
    holder: str | None


def legs_of(linkage, output):
    """The links on the way from the drive to an output that push the next ones."""
    mechanism, groups = linkage.mechanism, groups_of(linkage)
    chain, frame = mechanism.chain, mechanism.frame
    joints = list(enumerate(chain.joints))

    def outer(link, group):
        before = {mechanism.frame, *mechanism.drives[0].between, *(x for g in groups[: groups.index(group)] for x in g)}
        return [n for n, j in joints if link in j.links and set(j.links) & before]

    def inner(link, group):
        return [n for n, j in joints if link in j.links and set(j.links) & set(group) - {link}]

    def holders(n, group):
        later = {link for own in groups[groups.index(group) :] for link in own}
        return set(chain.joints[n].links) - later

    own = next(k for k, group in enumerate(groups) if output in group)
    loaded, legs = {output}, []
    for number in range(own, -1, -1):
        group = groups[number]
        if not loaded & set(group):
            continue
        legs_of_group = [link for link in group if len(outer(link, group)) == len(inner(link, group)) == 1]
        pushing = [link for link in legs_of_group if frame not in holders(outer(link, group)[0], group)]
        pushing = [link for link in pushing if link not in loaded] or pushing
        for link in pushing:
            (n,), (m,) = outer(link, group), inner(link, group)
            pushed = next(other for other in chain.joints[m].links if other != link and other in group)
            held = outer(pushed, group)
            guide = holder = None
            if len(held) == 1 and (frame in holders(held[0], group) or len(group) == 2):
                guide, holder = held[0], next(iter(holders(held[0], group)))
            legs.append(Leg(link, n, m, pushed, guide, holder))
        loaded |= {h for link in group for n in outer(link, group) for h in holders(n, group)} - {frame}
    return legs


def transmission(closing, legs, q, along):
    """(rows,) the least angle between the force of a leg and the way on which it pushes, folded to a right one."""
    elements = closing.linkage.elements
    angles = []

    def place(joint, link):
        e = elements[joint, link]
        return closing.put(q, link, e.x, e.y)[0]

    def normal(joint, link):
        return 1j * np.exp(1j * (closing.angle(q, link) + elements[joint, link].angle))

    for leg in legs:
        slide = next((n for n in (leg.outer, leg.inner) if not elements[n, leg.link].is_pin), None)
        pin = leg.outer if slide == leg.inner else leg.inner
        point = place(pin, leg.link)
        force = place(leg.inner, leg.link) - place(leg.outer, leg.link) if slide is None else normal(slide, leg.link)
        if leg.guide is None:
            c = closing.column[leg.pushed]
            arm = point - q[:, c] - 1j * q[:, c + 1]
            way = along[:, c] + 1j * along[:, c + 1] + 1j * along[:, c + 2] * arm
        elif elements[leg.guide, leg.pushed].is_pin:
            way = 1j * (point - place(leg.guide, leg.pushed))
        else:
            way = -1j * normal(leg.guide, leg.pushed)
        product = np.conj(force) * way
        angles.append(np.arctan2(np.abs(product.real), np.abs(product.imag)))
    return np.min(angles, axis=0)


def least_transmission(course, legs, low, high):
    """The least transmission angle from one arc to another."""
    laps = np.arange(-2, 3) if course.closed else np.zeros(1)
    arcs = (course.arcs[:, None] + course.length * laps).ravel()
    arcs = np.unique(np.concatenate([[low], arcs[(arcs > low) & (arcs < high)], [high]]))
    least = np.inf
    for _ in range(6):
        angles = transmission(course.closing, legs, *course.at(arcs))
        k = int(np.argmin(angles))
        least = min(least, float(angles[k]))
        arcs = np.linspace(arcs[max(k - 1, 0)], arcs[min(k + 1, len(arcs) - 1)], 41)
    return least
