"""Coulomb friction on bare arrays: normal forces and friction together, by continuation in the coefficients.

All normal forces s of one row solve s = size(a + c M s), where a is what the loads bring into each contact, M what a
unit of each normal force brings there through its friction, and c a factor on all coefficients. What teeth and belts
transmit is such a contact too, whose column, what they press, has no factor. docs/theory/statics.md has the theorem on
existence and uniqueness.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import islice, product
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Flags, Reals
from gruebler.mechanics.forces.acting import Rows

_TOLERANCE = 1e-12  # of the largest force of a row: so far Newton's method goes
_STEPS = 12  # of Newton's method, which doubles the digits; a longer way is another solution
_SEARCH = 30  # steps of the search for other equilibria
_BENT = 0.002  # of a step: so far it may leave the tangents at its ends
_GROWTH = 0.5  # of the forces, at most, from one factor to the next
_NEAR = 1e-7  # of the factor: so near to a pole its place is that of the tangent
_FOLD = 1e-9  # of the factor: a smaller step that fails is a fold
_LOCKED = 1 + 1e-6  # a row with a smaller factor locks: forces would be a million times the loads
_BESIDE = 1e-5  # of the factor: so far from an end its vectors are taken
_ROUNDS = 3000  # of the continuation, to have an end
_STARTS = 512  # patterns of slides, at most, from which further equilibria are sought
_WITH_PINS = 64  # the same where pins rub: their forces have no pieces, so that no number is complete
_SAME = 1e-6  # of the forces: closer equilibria are one


@dataclass(frozen=True, kw_only=True)
class Contacts:
    """The contacts of many rows: what loads and friction bring into each, as two components.

    Of a pin they are those of its force; of a slide its normal force, and its couple by half the length of the guide.
    """

    loads: Reals
    """(rows, contacts, 2): a."""
    mutual: Reals
    """(rows, contacts, contacts, 2): M, what the second contact's friction brings into the first for each unit of its
    normal force."""
    leaning: Reals
    """(rows, contacts): what the friction on the faces of a guide adds to its couple, by the normal force."""
    round: Flags
    """(contacts,): pins, with forces of any direction; else slides, with two edges."""
    rubs: Flags
    """(contacts,): else what it brings is not friction and does not grow with the factor."""

    def __len__(self) -> int:
        return len(self.loads)

    def at(self, rows: Rows) -> Contacts:
        """Some rows."""
        return Contacts(
            loads=self.loads[rows],
            mutual=self.mutual[rows],
            leaning=self.leaning[rows],
            round=self.round,
            rubs=self.rubs,
        )

    def sizes(self, normal: Reals, factor: Reals) -> tuple[Reals, Reals, Reals]:
        """Normal forces that normal forces make, with their derivatives by these (rows, n, n) and by the factor."""
        weights = np.where(self.rubs, factor[:, None], 1.0)
        inside = self.loads + np.einsum("rijk,rj->rik", self.mutual, weights * normal)
        slopes = weights[:, None, :, None] * self.mutual
        brought = np.einsum("rijk,rj->rik", self.mutual, self.rubs * normal)
        lean = factor[:, None] * self.leaning
        by_factor = brought
        by_factor[..., 1] += self.leaning * inside[..., 0] + lean * brought[..., 0]
        inside[..., 1] += lean * inside[..., 0]
        slopes[..., 1] += lean[..., None] * slopes[..., 0]
        length = np.hypot(inside[..., 0], inside[..., 1])
        edge = np.abs(inside[..., 1]) > np.abs(inside[..., 0])
        one_sided = np.stack([np.where(edge, 0.0, np.sign(inside[..., 0])), edge * np.sign(inside[..., 1])], axis=2)
        along = np.where(self.round[:, None], inside / np.where(length > 0, length, 1.0)[..., None], one_sided)
        size = np.where(self.round, length, np.abs(inside).max(axis=2))
        return size, np.einsum("rik,rijk->rij", along, slopes), np.einsum("rik,rik->ri", along, by_factor)

    def bounds(self) -> Reals:
        """(rows,): the spectral radius of the matrix of the largest slopes at the given coefficients.

        Below 1 the map of normal forces is a contraction: there is one equilibrium, and no more.
        """
        mutual = self.mutual.copy()
        mutual[..., 1] += self.leaning[..., None] * mutual[..., 0]
        largest = np.where(self.round[:, None], np.hypot(mutual[..., 0], mutual[..., 1]), np.abs(mutual).max(axis=3))
        radius: Reals = np.abs(np.linalg.eigvals(largest)).max(axis=1, initial=0.0)
        return radius


class Branches(NamedTuple):
    """The equilibria that grow out of those without friction; all (rows,) but the first."""

    normal: Reals
    """(rows, contacts): normal forces at the given coefficients; NaN where the branch has ended."""
    factor: Reals
    """The factor on all coefficients at which the branch ends; infinite if beyond the limit."""
    culprit: Rows
    """The contact whose coefficient the end depends on most; -1 without an end."""
    equilibria: Rows
    """How many equilibria were found at the given coefficients; 1 is proved where `single` holds."""
    single: Flags
    """Whether there is one equilibrium and no more, by contraction."""


def continued(contacts: Contacts, limit: float) -> Branches:
    """Follow the equilibrium of each row from no friction to the given coefficients, and on to where it ends.

    Steps are taken along the tangent and corrected by Newton's method; a step is accepted if forces change by a half at
    most, the determinant stays positive, and the step is made of the tangents at its ends, else halved. Ends are met to
    1e-7 of the factor.

    Args:
        contacts: Those of all rows, finite.
        limit: The factor up to which ends are sought, above 1.

    Cost: some 0.5 ms a row with one contact, 2 to 3 ms with four; each row takes some 100 steps.
    """
    rows, count = contacts.loads.shape[:2]
    normal, factor, culprit = np.full((rows, count), np.nan), np.full(rows, np.inf), np.full(rows, -1)
    if not count:
        return Branches(normal, factor, culprit, np.ones(rows, np.int64), np.ones(rows, bool))
    bounds = contacts.bounds()
    ends, last = _follow(contacts, normal, limit, bounds)
    factor[ends] = last.factor[ends]
    if ends.size:
        culprit[ends] = _culprits(contacts.at(ends), last.normal[ends], factor[ends])
    locked = factor < _LOCKED
    normal[locked] = np.nan
    single = bounds < 1
    equilibria = np.where(locked, 0, 1)
    for row in np.flatnonzero(~single):
        equilibria[row] = len(_all_found(contacts.at(np.array([row])), normal[row]))
    return Branches(normal, factor, culprit, equilibria, single)


class _State(NamedTuple):
    normal: Reals
    factor: Reals


def _follow(contacts: Contacts, normal: Reals, limit: float, bounds: Reals) -> tuple[Rows, _State]:
    """Fill the normal forces at factor 1; which rows end before the limit, and the last state of all."""
    none = np.zeros(len(contacts))
    size = contacts.sizes(contacts.sizes(np.zeros(normal.shape), none)[0], none)[0]  # teeth press by what they transmit
    state = _State(size, none.copy())
    step = np.minimum(0.5 / np.maximum(bounds, 0.5 / limit), limit)
    active, ends = np.flatnonzero(size.max(axis=1, initial=0.0) > 0), list[int]()
    normal[size.max(axis=1, initial=0.0) == 0] = 0.0
    tangents, _ = _tangents(contacts, state)
    for _ in range(_ROUNDS):
        if not active.size:
            break
        here, at, now, tangent = contacts.at(active), state.factor[active], state.normal[active], tangents[active]
        goal = np.minimum(at + step[active], np.where(at < 1, 1.0, limit))
        corrected, sound = _newton(here, now + (goal - at)[:, None] * tangent, goal)
        after, _ = _tangents(here, _State(corrected, goal))
        largest = np.maximum(now.max(axis=1), size[active].max(axis=1))
        sound &= np.abs(corrected - now).max(axis=1) <= _GROWTH * largest
        sound &= _follows(corrected - now, (goal - at)[:, None] * tangent, (goal - at)[:, None] * after, largest)
        state.normal[active[sound]], state.factor[active[sound]] = corrected[sound], goal[sound]
        tangents[active[sound]] = after[sound]
        step[active] *= np.where(sound, 2.0, 0.5)
        reached = active[sound & (goal == 1.0)]
        normal[reached] = state.normal[reached]
        with np.errstate(divide="ignore", invalid="ignore"):
            left = largest / np.abs(tangent).max(axis=1)  # at a pole, the way to it
        pole = (left <= _NEAR * at) & (at > 0)
        over = pole | (step[active] <= _FOLD * at)
        state.factor[active[pole]] = (at + left)[pole]
        ends += active[over].tolist()
        active = active[~over & (state.factor[active] < limit)]
    return np.array(sorted(ends), np.int64), state


def _tangents(contacts: Contacts, state: _State) -> tuple[Reals, Reals]:
    """The derivatives of the normal forces by the factor, and the determinants."""
    _, slopes, by_factor = contacts.sizes(state.normal, state.factor)
    return _solved(slopes, by_factor)


def _follows(moved: Reals, before: Reals, after: Reals, largest: Reals) -> Flags:
    """Whether a step is, but for a part of it, one piece of the first tangent and then one of the second.

    So it is along a smooth branch and across one kink of it, but hardly on the way to another branch.
    """
    bend = before - after
    square = (bend * bend).sum(axis=1)
    part = ((moved - after) * bend).sum(axis=1) / np.where(square > 0, square, 1.0)
    rest = moved - after - np.clip(part, 0.0, 1.0)[:, None] * bend
    longest = np.maximum(np.abs(before).max(axis=1), np.abs(after).max(axis=1))
    near: Flags = np.abs(rest).max(axis=1) <= _BENT * longest + _TOLERANCE * largest
    return near


def _newton(contacts: Contacts, normal: Reals, factor: Reals) -> tuple[Reals, Flags]:
    """Normal forces that make themselves, from a start; sound where it converges with a positive determinant."""
    scale = np.abs(contacts.loads).max(axis=(1, 2), initial=0.0)
    normal, sound = normal.copy(), np.zeros(len(contacts), bool)
    active = np.arange(len(contacts))
    for _ in range(_STEPS):
        here, now = contacts.at(active), normal[active]
        size, slopes, _ = here.sizes(now, factor[active])
        move, determinant = _solved(slopes, now - size)
        done = np.abs(now - size).max(axis=1) <= _TOLERANCE * np.maximum(scale[active], np.abs(now).max(axis=1))
        normal[active] = np.where(done[:, None], size, now - move)
        sound[active] = done & (determinant > 0)
        active = active[~done & np.isfinite(move).all(axis=1)]
        if not active.size:
            break
    return normal, sound & np.isfinite(normal).all(axis=1)


def _solved(slopes: Reals, right: Reals) -> tuple[Reals, Reals]:
    """(1 - slopes)^-1 right, and the determinant; nothing where that is 0."""
    matrix = np.eye(slopes.shape[1]) - slopes
    determinant = np.linalg.det(matrix)
    regular = determinant != 0
    solution = np.zeros_like(right)
    if regular.any():
        solution[regular] = np.linalg.solve(matrix[regular], right[regular][..., None])[..., 0]
    return solution, determinant


def _culprits(contacts: Contacts, normal: Reals, factor: Reals) -> Rows:
    """The contact whose coefficient an end depends on most.

    At an end 1 - D is singular. By its vectors v and w on the right and on the left, contact j has the share w_j v_j of
    the derivative of the eigenvalue by the logarithms of all coefficients.
    """
    slopes = (1 - _BESIDE) * contacts.sizes(normal, factor)[1]  # at the end itself the determinant would be rounding
    right = left = np.ones_like(normal)
    for _ in range(4):  # inverse iteration
        right, left = _solved(slopes, right)[0], _solved(slopes.swapaxes(1, 2), left)[0]
        right, left = (v / np.maximum(np.abs(v).max(axis=1, keepdims=True), 1e-300) for v in (right, left))
    share = left * right / np.where((left * right).sum(axis=1) == 0, 1.0, (left * right).sum(axis=1))[:, None]
    return np.asarray(np.argmax(np.where(contacts.rubs, np.round(share, 6), -np.inf), axis=1))


def _all_found(contacts: Contacts, known: Reals) -> list[Reals]:
    """The equilibria of one row: the known one, and others from starts in all patterns of the contacts.

    Complete for slides (their pieces are linear) up to 512 patterns, such as nine long guides or four with edges; with
    pins some may be missed. None is listed that does not balance.
    """
    count = contacts.loads.shape[1]
    axes = np.array([(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)])
    choices = [range(4) if pin or contacts.loads[0, k, 1] or contacts.mutual[0, k, :, 1].any() else range(2)
               for k, pin in enumerate(contacts.round)]  # fmt: skip
    most = _WITH_PINS if contacts.round.any() else _STARTS
    patterns = list(islice(product(*choices), most + 1))
    if len(patterns) > most:
        draws = np.random.default_rng(0)
        patterns = [tuple(int(draws.integers(len(choice))) for choice in choices) for _ in range(most)]
    chosen = axes[np.array(patterns).reshape(-1, count)]  # (starts, contacts, 2)
    load, mutual = contacts.loads[0], contacts.mutual[0].copy()
    load = np.stack([load[:, 0], load[:, 1] + contacts.leaning[0] * load[:, 0]], axis=1)
    mutual[..., 1] += contacts.leaning[0][:, None] * mutual[..., 0]
    starts, _ = _solved(np.einsum("sik,ijk->sij", chosen, mutual), np.einsum("sik,ik->si", chosen, load))
    many = contacts.at(np.zeros(len(starts), np.int64))
    full = np.ones(len(starts))
    scale = np.abs(load).max(initial=0.0)
    equilibria = [] if np.isnan(known).any() else [known]
    normal = np.maximum(starts, 0.0)
    for _ in range(_SEARCH):
        size, slopes, _ = many.sizes(normal, full)
        normal = np.maximum(normal - _solved(slopes, normal - size)[0], 0.0)
    size, _, _ = many.sizes(normal, full)
    for start, value in zip(normal, size, strict=True):
        largest = max(scale, float(np.abs(start).max(initial=0.0)))
        balanced = np.isfinite(start).all() and np.abs(start - value).max(initial=0.0) <= 1e-10 * largest
        new = all(np.abs(value - other).max(initial=0.0) > _SAME * largest for other in equilibria)
        if balanced and new and largest < scale / _NEAR:
            equilibria.append(value)
    return equilibria
