"""Static balance: springs of free length 0 that hold the weights of a linkage in every position."""

from __future__ import annotations

from collections.abc import Mapping

from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.text import joined
from gruebler.mechanics.dynamics.balancing import counter_products
from gruebler.mechanics.dynamics.mass_moments import frame_pin, mass_moments
from gruebler.mechanics.forces.loads import Loads
from gruebler.mechanics.forces.springs import Spring
from gruebler.mechanics.linkages import LinkPoint
from gruebler.mechanics.linkages.conversion import LinkageLike, as_linkage

_NONE = 1e-12


@door_that_raises(LinkageError)
def balance_weights(
    linkage: LinkageLike, loads: Loads, *, height: float, radius: float | Mapping[str, float] | None = None
) -> tuple[Spring, ...]:
    """Springs of free length 0 that hold all weights in every position, exactly.

    Each hangs a link that is pinned to the frame at a place of the frame above its pin.

    Args:
        linkage: Any planar linkage.
        loads: Its masses and gravity.
        height: Of the places on the frame above the pins, against gravity, in the linkage's unit.
        radius: Distance of the springs from the pins on the links, for all or by link; by default ``height``.

    Returns:
        The springs, to be added to the loads; none if the weights hold each other.

    Raises:
        LinkageError: links with mass that only slide to the frame, weights that links pinned to the frame cannot hold,
            lengths that are not positive.

    Example:
        >>> from gruebler.mechanics.forces import RigidBody
        >>> from gruebler.mechanics.fourbar import FourBar
        >>> loads = Loads(bodies={"crank": RigidBody(2.0, (15, 0))}, gravity=(0, -10))
        >>> spring = balance_weights(FourBar(25, 70, 40, 70), loads, height=20, radius=10)[0]
        >>> spring.stiffness, spring.free_length  # m g s / (height radius) = 300 / 200
        (1.5, 0.0)

    See Also:
        `balance_forces`, `equilibria`

    Theory:
        docs/theory/balancing.md
    """
    linkage = as_linkage(linkage)
    moments = mass_moments(linkage, loads)
    if moments.blocked:
        raise LinkageError(
            "springs cannot hold {links}: no path of turning joints leads to the frame", links=joined(moments.blocked)
        )
    ground, given = linkage.mechanism.frame, linkage.mechanism.chain.links
    pinned = {
        link: frame_pin(moments.lower, link)
        for joint in moments.lower.mechanism.chain.joints
        if joint.pair.is_turning and ground in joint.links
        for link in joint.links
        if link != ground and link in given
    }
    needed = counter_products(moments, moments.total, list(pinned))
    if needed is None:
        raise LinkageError(
            "springs at the links pinned to the frame, {links}, cannot hold all weights", links=joined(list(pinned))
        )
    radii = radius if isinstance(radius, Mapping) else dict.fromkeys(pinned, height if radius is None else radius)
    gravity = complex(*loads.gravity)
    springs = []
    for link, product in zip(pinned, -needed, strict=True):
        if abs(gravity) * abs(product) <= _NONE * abs(gravity) * moments.scale:
            continue
        arm = radii.get(link, height)
        for value in (height, arm):
            if not 0 < value < 1e100:
                raise LinkageError("a spring is hung at positive distances from the pin, not {value!r}", value=value)
        above, on_link = pinned[link]
        top, end = above - height * gravity / abs(gravity), on_link + arm * product / abs(product)
        between = (_point(ground, top, height), _point(link, end, arm))
        springs.append(Spring(between, stiffness=float(abs(gravity * product)) / (height * arm), free_length=0.0))
    return tuple(springs)


def _point(link: str, at: complex, size: float) -> LinkPoint:
    x, y = (0.0 if abs(part) < _NONE * size else float(part) for part in (at.real, at.imag))
    return LinkPoint(link, x, y)
