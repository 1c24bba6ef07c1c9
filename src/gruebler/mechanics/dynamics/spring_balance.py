"""Static balance by springs: those of free length 0 hold weights exactly, real ones as well as they can."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from gruebler.base.arrays import Reals, compared_by_value
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.notebook import brief
from gruebler.base.text import joined
from gruebler.mechanics.dynamics.balancing import counter_products
from gruebler.mechanics.dynamics.equations import reduced_equations
from gruebler.mechanics.dynamics.mass_moments import frame_pin, mass_moments
from gruebler.mechanics.forces.loads import Loads
from gruebler.mechanics.forces.springs import Spring
from gruebler.mechanics.kinematics import Motion
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


@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class SpringFit:
    """The best that springs at given places can do for the effort that holds a linkage."""

    springs: tuple[Spring, ...]
    """With their stiffnesses, in newtons by the linkage's unit; what does not help has 0."""
    before: Reals
    """(rows, drives): the efforts that hold the linkage without them, in newtons times the unit, of slides newtons."""
    after: Reals
    """(rows, drives): with them."""
    bound: float
    """No stiffnesses come below this: largest effort of `minimax`, else root mean square."""


@door_that_raises(LinkageError)
def fit_springs(motion: Motion, loads: Loads, springs: Sequence[Spring], *, minimax: bool = False) -> SpringFit:
    """The stiffnesses, not negative, with which springs at given places leave the drives the least effort.

    Places, free lengths and preloads are those given, so springs may be real ones. The problem is convex, and its dual
    bounds what can be reached: the bound differs from what is found by rounding alone.

    Args:
        motion: The poses that count, each alike; drives all turn or all slide, and their speeds do not matter.
        loads: Weights and loads to be held.
        springs: Their places, free lengths, preloads; stiffnesses are looked for.
        minimax: Least largest effort, in place of least mean square.

    Returns:
        `SpringFit`: the springs, efforts (rows, drives) before and after, the bound.

    Raises:
        LinkageError: drives that turn and others that slide, no springs, poses in which the effort is not determined.

    Cost:
        The motion once for each spring; 10 ms for 100 rows.

    Example:
        >>> from gruebler.mechanics.forces import RigidBody
        >>> from gruebler.mechanics.fourbar import FourBar
        >>> from gruebler.mechanics.kinematics import move
        >>> lid = move(FourBar(25, 70, 40, 70), np.linspace(0.2, 1.4, 25))
        >>> weight = Loads(bodies={"crank": RigidBody(2.0, (15, 0))}, gravity=(0, -10))
        >>> real = Spring(("frame:0,40", "crank:10,0"), free_length=15.0)
        >>> fit = fit_springs(lid, weight, [real])
        >>> round(fit.springs[0].stiffness, 2), round(float(np.abs(fit.after).max() / np.abs(fit.before).max()), 2)
        (1.29, 0.07)

    See Also:
        `balance_weights`, `equilibria`

    Theory:
        docs/theory/balancing.md
    """
    if len({drive.turning for drive in motion.linkage.mechanism.drives}) != 1 or not springs:
        raise LinkageError("springs, one at least, are fitted to the efforts of drives that all turn or all slide")
    none = tuple(replace(spring, stiffness=0.0) for spring in springs)
    alone = [replace(spring, stiffness=1.0, preload=0.0, law=None) for spring in springs]
    held = replace(loads, springs=(*loads.springs, *none))
    before, start = (-reduced_equations(motion, each).force for each in (loads, held))
    columns = -np.stack(
        [reduced_equations(motion, Loads(springs=(spring,), gravity=(0, 0))).force.ravel() for spring in alone], axis=1
    )
    if not (len(before) and np.isfinite(start).all() and np.isfinite(columns).all()):
        raise LinkageError("springs are fitted over poses in which the drives' efforts are determined")
    stiffness, bound = (_least_largest if minimax else _least_squares)(columns, start.ravel())
    fitted = tuple(replace(spring, stiffness=float(k)) for spring, k in zip(springs, stiffness, strict=True))
    return SpringFit(
        springs=fitted, before=before, after=start + (columns @ stiffness).reshape(start.shape), bound=bound
    )


def _least_squares(columns: Reals, start: Reals) -> tuple[Reals, float]:
    """X >= 0 with the least root mean square of r = start + columns x, and its bound by the dual: 2 r start - r²."""
    from scipy.optimize import nnls

    sizes = np.abs(columns).max(axis=0)
    sizes[sizes == 0] = 1.0
    x = nnls(columns / sizes, -start)[0] / sizes
    rest = start + columns @ x
    return x, float(np.sqrt(max(2 * rest @ start - rest @ rest, 0.0) / len(start)))


def _least_largest(columns: Reals, start: Reals) -> tuple[Reals, float]:
    """X >= 0 with the least largest |start + columns x|, and the optimum of the dual program."""
    from scipy.optimize import linprog

    sizes, scale = np.abs(columns).max(axis=0), float(np.abs(start).max()) or 1.0
    sizes[sizes == 0] = 1.0
    both = np.concatenate([columns, -columns]) / sizes
    rows = np.concatenate([both, np.full((len(both), 1), -1.0)], axis=1)
    limits = np.concatenate([-start, start]) / scale
    answer = linprog(np.eye(rows.shape[1])[-1], rows, limits, method="highs")
    return scale * answer.x[:-1] / sizes, scale * float(limits @ answer.ineqlin.marginals)


def _point(link: str, at: complex, size: float) -> LinkPoint:
    x, y = (0.0 if abs(part) < _NONE * size else float(part) for part in (at.real, at.imag))
    return LinkPoint(link, x, y)
