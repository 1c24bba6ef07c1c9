"""Complete force balance: counterweights that keep the centre of all masses still, or why there are none."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from gruebler.base.arrays import Complexes
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.notebook import brief, explained
from gruebler.base.text import Message, joined, message
from gruebler.mechanics.dynamics.mass_moments import MassMoments, mass_moments
from gruebler.mechanics.forces.loads import Loads
from gruebler.mechanics.linkages import Linkage, LinkPoint
from gruebler.mechanics.linkages.conversion import LinkageLike, as_linkage

_NONE = 1e-12  # of the largest product of mass and radius: less needs no weight
_SOLVES = 1e-9  # of the largest: what is left of an equation that has no solution is more
_ROUNDS = 60

_STILL = message("The centre of all masses stays still: no counterweight is needed.")
_WEIGHT = message("{link}: {mass:n} kg at ({x:n}, {y:n}), {product:n} kg·{unit}")
_POSSIBLE = message("With these counterweights the centre of all masses stays still:")
_BLOCKED = message(
    "A complete balance of forces is impossible: no path of turning joints leads from {link} to the frame, only over "
    "{joints}."
)
_TOO_FEW = message("Counterweights on {links} alone cannot balance the forces; on {others} they can.")
_RUNAWAY = message(
    "Counterweights on {links} grow without end, since each must carry the others; take a longer radius."
)


@explained
@dataclass(frozen=True, kw_only=True)
class Counterweight:
    """A point mass on a link."""

    link: str
    mass: float
    """kg."""
    place: tuple[float, float]
    """In the link's coordinates."""
    product: float
    """Mass times the distance from the pin that joins the link towards the frame: what the balance needs."""
    unit: str

    def explain(self, lang: str = "en") -> str:
        """Link, mass, place, product in one line, in English or German (``de``)."""
        x, y = self.place
        text = _WEIGHT.filled(link=self.link, mass=self.mass, x=x, y=y, product=self.product, unit=self.unit)
        return text.in_language(lang)


@brief
@dataclass(frozen=True, repr=False, kw_only=True)
class ForceBalance:
    """Counterweights with which the shaking force is 0 in every motion, or the reason why there are none."""

    linkage: Linkage
    loads: Loads
    """As given."""
    counterweights: tuple[Counterweight, ...]
    reason: Message | None
    """Why there is no balance; None if there is."""
    blocked: tuple[str, ...]
    """Links with mass from which no path of turning joints leads to the frame."""

    @property
    def possible(self) -> bool:
        """Whether the forces are balanced."""
        return self.reason is None

    @cached_property
    def balanced(self) -> Loads:
        """The loads with the counterweights added to their masses."""
        masses = dict(self.loads.masses)
        for each in self.counterweights:
            point = LinkPoint(each.link, *each.place)
            masses[point] = np.add(masses.get(point, 0.0), each.mass)
        return replace(self.loads, masses=masses)

    def explain(self, lang: str = "en") -> str:
        """The counterweights, or why there are none, in English or German (``de``)."""
        if self.reason is not None:
            return self.reason.in_language(lang)
        if not self.counterweights:
            return _STILL.in_language(lang)
        return "\n".join([_POSSIBLE.in_language(lang), *(each.explain(lang) for each in self.counterweights)])


@door_that_raises(LinkageError)
def balance_forces(
    linkage: LinkageLike,
    loads: Loads,
    *,
    on: Sequence[str] | None = None,
    radius: float | Mapping[str, float] | None = None,
) -> ForceBalance:
    """Counterweights that keep the common centre of mass still in every motion, by linearly independent vectors.

    No position is solved: the conditions hold for all of them, also in other assembly modes.

    Args:
        linkage: Any planar linkage.
        loads: Its masses; forces and springs do not matter.
        on: The links that carry counterweights; by default as few as are needed, near the frame.
        radius: Distance of the weights from the pin that joins their link towards the frame, for all or by link; by
            default that of the link's farthest pin.

    Returns:
        `ForceBalance`: ``counterweights``, ``balanced`` loads that hold them; or ``reason`` and the ``blocked`` links.
        Special dimensions, such as those of a parallelogram, can do with fewer weights than are found here.

    Raises:
        LinkageError: no mass, unknown links, a radius that is not positive.

    Cost:
        An elimination of the size of the linkage; less than a millisecond for ten links.

    Example:
        >>> from gruebler.mechanics.forces import RigidBody
        >>> from gruebler.mechanics.fourbar import SliderCrank
        >>> loads = Loads(bodies={"slider": RigidBody(2.0)})
        >>> print(balance_forces(SliderCrank(30, 60), loads))  # behind the crank pin: 2 kg; then 4 kg behind the crank
        With these counterweights the centre of all masses stays still:
        crank: 4 kg at (-30, 0), 120 kg·mm
        coupler: 2 kg at (-60, 0), 120 kg·mm

    See Also:
        `balance_partly`, `inverse_dynamics`

    Theory:
        docs/theory/balancing.md
    """
    linkage = as_linkage(linkage)
    moments = mass_moments(linkage, loads)
    if moments.blocked:
        return _without(linkage, loads, _why_blocked(moments), moments.blocked)
    carriers = moments.carriers if on is None else _carriers(moments, on)
    radii = _radii(moments, carriers, radius)
    masses = np.zeros(len(carriers))
    products = np.zeros(len(carriers), np.complex128)
    for _ in range(_ROUNDS):
        needs = counter_products(moments, moments.with_weights(carriers, masses), carriers)
        if needs is None:
            return _without(linkage, loads, _TOO_FEW.filled(links=joined(carriers), others=joined(moments.carriers)))
        settled = np.abs(needs - products).max(initial=0.0) <= 1e-15 * np.abs(needs).max(initial=0.0)
        products, masses = needs, np.abs(needs) / radii
        if settled:
            break
    else:
        return _without(linkage, loads, _RUNAWAY.filled(links=joined(carriers)))
    least = _NONE * max(float(np.abs(products).max(initial=0.0)), moments.scale)
    weights = []
    for link, product, mass in zip(carriers, products, masses, strict=True):
        if abs(product) > least:
            place = moments.pins[link] + product / mass
            weights.append(
                Counterweight(
                    link=link,
                    mass=float(mass),
                    place=(_clean(place.real, abs(place)), _clean(place.imag, abs(place))),
                    product=float(abs(product)),
                    unit=linkage.unit,
                )
            )
    return ForceBalance(linkage=linkage, loads=loads, counterweights=tuple(weights), reason=None, blocked=())


def _clean(value: float, size: float) -> float:
    return 0.0 if abs(value) <= 1e-14 * size else float(value)


def counter_products(moments: MassMoments, total: Complexes, carriers: Sequence[str]) -> Complexes | None:
    """What each carrier needs: -C + a combination of the relations that leaves nothing to the other links."""
    taken = np.isin(moments.links, carriers)
    relations = moments.relations
    factors = np.linalg.lstsq(relations[:, ~taken].T, total[~taken], rcond=1e-10)[0]
    needed = factors @ relations - total
    if np.abs(needed[~taken]).max(initial=0.0) > _SOLVES * np.abs(total).max(initial=0.0):
        return None
    return np.array([needed[moments.links.index(link)] for link in carriers], np.complex128)


def _without(linkage: Linkage, loads: Loads, reason: Message, blocked: tuple[str, ...] = ()) -> ForceBalance:
    return ForceBalance(linkage=linkage, loads=loads, counterweights=(), reason=reason, blocked=blocked)


def _why_blocked(moments: MassMoments) -> Message:
    ways = [moments.lower.mechanism.chain.joint_title(joint) for joint in moments.ways_from(moments.blocked[0])]
    return _BLOCKED.filled(link=joined(moments.blocked), joints=joined(ways))


def _carriers(moments: MassMoments, on: Sequence[str]) -> tuple[str, ...]:
    for link in on:
        if link not in moments.pins:
            raise LinkageError(
                "a counterweight needs a link that moves and hangs on the frame by turning joints, such as {links}, "
                "not {link!r}",
                links=joined(list(moments.pins)),
                link=link,
            )
    return tuple(dict.fromkeys(on))


def _radii(
    moments: MassMoments, carriers: Sequence[str], radius: float | Mapping[str, float] | None
) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    given = radius if isinstance(radius, Mapping) else {} if radius is None else dict.fromkeys(carriers, radius)
    for link, value in given.items():
        if link not in carriers:
            raise LinkageError("{link!r} has a radius, but no counterweight", link=link)
        if not 0 < value < 1e100:
            raise LinkageError("the radius of a counterweight is a positive length, not {value!r}", value=value)
    return np.array([given.get(link, moments.reaches[link]) for link in carriers], np.float64)
