"""An entry that gives its machine twice, by dimensions and by screws, gives the same machine."""

from math import cos, pi, sin

import numpy as np
import pytest

from gruebler.mechanics.kinematics.noncircular import transfer_of
from gruebler.mechanics.linkages.elements import GenevaDriver, GenevaWheel, NonCircular, Pin, Wheel
from gruebler.teaching.catalog import entries, entry

BOTH = [id for id, record in entries().items() if record.dimensions is not None and record.screws is not None]


def of_dimensions(linkage):
    """Link -> joint -> centre on the link; joint -> radius for each link."""
    centres, radii = {}, {}
    for (number, link), element in linkage.elements.items():
        assert isinstance(element, Pin | Wheel | GenevaDriver | GenevaWheel | NonCircular), element
        centres.setdefault(link, {})[number] = np.array([element.x, element.y])
        if isinstance(element, NonCircular):
            beyond, radii[number, link] = of_ellipse(linkage, number, link)
            centres[link][number] += beyond * np.array([cos(element.angle), sin(element.angle)])
        if isinstance(element, Wheel):
            radii[number, link] = element.radius
    return centres, radii


def of_ellipse(linkage, number, link):
    """The circle of curvature at the end of the major axis of an elliptic wheel: centre from the focus, and radius.

    The radius is the ordinate at the focus, the harmonic mean of the least and the greatest distance from it.
    """
    links = linkage.mechanism.chain.joints[number].links
    curve = transfer_of(*(linkage.elements[number, one] for one in links)).curves()[links.index(link)]
    far = np.abs(100 * curve)
    radius = 2 / (1 / far.min() + 1 / far.max())
    return far[0] - radius, radius


def of_screws(spatial):
    """The same of the position that the screws describe; the centre of a contact is that of the contour's circle."""
    centres, radii = {}, {}
    for number, (joint, place) in enumerate(zip(spatial.mechanism.chain.joints, spatial.places, strict=True)):
        for k, link in enumerate(joint.links):
            at = np.array(place.at[:2])
            if place.pressure is not None or joint.pair.name == "rolling":
                radii[number, link] = place.radii[k]
                at = at + (-1 if k == 0 else 1) * place.radii[k] * np.array(place.y[:2])
            centres.setdefault(link, {})[number] = at
    return centres, radii


def distances(centres):
    return {
        (link, a, b): np.linalg.norm(mine[a] - mine[b]) for link, mine in centres.items() for a in mine for b in mine
    }


def test_some_entries_have_both():
    assert {"diff", "geartrain", "geneva", "friction_rigid", "friction_forced"} <= set(BOTH)


@pytest.mark.parametrize("id", BOTH)
def test_dimensions_and_screws_agree(id):
    record = entry(id)
    linkage, spatial = record.linkage(), record.placed()
    (centres, radii), (there, measured) = of_dimensions(linkage), of_screws(spatial)
    assert measured == pytest.approx(radii, rel=1e-12)
    slots = {number: e.slots for (number, _), e in linkage.elements.items() if isinstance(e, GenevaWheel)}
    for number, many in slots.items():  # the pin: on the circle about the driver's axis, and in the slot
        driver, cross = linkage.mechanism.chain.joints[number].links
        axes = [
            next(k for k, j in enumerate(linkage.mechanism.chain.joints) if set(j.links) == {"frame", link})
            for link in (driver, cross)
        ]
        span = np.linalg.norm(there["frame"][axes[0]] - there["frame"][axes[1]])
        pin = there[driver].pop(number)
        assert np.linalg.norm(pin - there[driver][axes[0]]) == pytest.approx(span * sin(pi / many), rel=1e-12)
        along = np.array(spatial.places[number].x[:2])
        to_centre = there[cross][axes[1]] - there[cross].pop(number)
        assert along[0] * to_centre[1] - along[1] * to_centre[0] == pytest.approx(0, abs=1e-9 * span**2)
        for link in (driver, cross):
            del centres[link][number]
    assert distances(there) == pytest.approx(distances(centres), rel=1e-12, abs=1e-12)
