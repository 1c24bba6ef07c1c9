"""Linkages of a crank and dyads: slopes by differences, tops by many angles, wrong calls."""

import numpy as np
import pytest

# Watt I and Stephenson III drawn: joints in turn, then the point and the number of its link among those placed.
WATT = (
    np.array([0, 1, 0, 0]),
    np.array([[0, 2, 3, 1, 0, 1, 3, 1, 3, 2, 2], [0, 4, 5, 2, 3, 4, 6, 4, 6, 5, 5]]),
    np.array([[0j, -0.9 + 0.5j, -2.3 - 1.9j, 0.8 - 2.4j, -1.6 - 3.7j, -1.4 + 3.7j, 1.2 - 0.6j, -4 + 5.3j]]),
)
STEPHENSON = (
    np.array([0, 1, 0, 0]),
    np.array([[0, 2, 3, 1, 0, 1, 3, 1, 3, 2, 2], [0, 4, 5, 1, 2, 4, 6, 4, 6, 5, 5]]),
    np.array([[0j, 0.2 + 1j, -1.4 - 1.3j, 1.4 - 0.9j, 0.5 + 2.4j, -1.8 + 4.5j, 0.1 + 4j, -0.9 + 4.2j]]),
)
NO_LINES, POINT = np.zeros((0, 0), complex), 5
TURN = np.linspace(0, 2 * np.pi, 7, endpoint=False)[None]
EVERY = np.arange(2)


def sides(structure):
    """On which side each dyad is drawn."""
    _, dyads, (places,) = structure
    rows = []
    for dyad in dyads:
        own, far, inner = places[dyad[5]], places[dyad[6]], places[dyad[9]]
        rows.append([np.sign(np.imag(np.conj(far - own) * (inner - own)))])
    return np.array(rows)


@pytest.mark.parametrize("structure", [WATT, STEPHENSON], ids=["Watt I", "Stephenson III"])
def test_the_derivatives_of_a_point_against_differences(core, structure):
    drive, dyads, places = structure
    own, step = sides(structure), 1e-6

    def traced(some, turned):
        return core.trace_point(drive, dyads, some, own, turned, POINT)

    z, exact = core.trace_slopes(drive, dyads, places, own, TURN, POINT, True)
    assert np.array_equal(z, traced(places, TURN))
    for k, each in enumerate(exact[:-1]):
        change = np.zeros(places.shape, complex)
        change[0, k // 2] = step * (1, 1j)[k % 2]
        far, near = (traced(places + sign * change, TURN) for sign in (1, -1))
        assert np.abs((far - near) / (2 * step) - each).max() < 1e-7 * (1 + np.abs(each).max())
    far, near = (traced(places, TURN + sign * step) for sign in (1, -1))
    assert np.abs((far - near) / (2 * step) - exact[-1]).max() < 1e-7 * (1 + np.abs(exact[-1]).max())
    assert np.array_equal(core.trace_slopes(drive, dyads, places, own, TURN, POINT, False)[1][0], exact[-1])


def test_all_levels_of_the_processor_give_the_same_bits(core):
    """Angles beyond those that are reduced in lanes, and dyads that cannot be assembled, too."""
    places = np.concatenate([WATT[2], 1.5 * WATT[2] - 0.4j * WATT[2] ** 2])
    turned = np.stack([np.linspace(-4, 300, 77), np.linspace(-1e6, 2, 77)])
    call = *WATT[:2], places, NO_LINES, np.array([[1.0, -1], [-1, 1]]), turned
    first, *others = (core.move_planes(*call, level) for level in core.level_names())
    assert np.isnan(first[0]).any()
    spins = first[0][1]
    assert spins == pytest.approx(np.exp(1j * turned), abs=1e-9)
    for other in others:
        for own, far in zip(first, other, strict=True):
            assert np.array_equal(own.view(np.int64), far.view(np.int64))
    with pytest.raises(ValueError, match="no level v9"):
        core.move_planes(*call, "v9")


@pytest.mark.parametrize("structure", [WATT, STEPHENSON], ids=["Watt I", "Stephenson III"])
def test_cosines_are_those_of_arms_and_largest_at_their_tops(core, structure):
    """Second method: the arms of both links as their planes lie, at many angles."""
    drive, dyads, places = structure
    own, fine = sides(structure), np.linspace(0, 2 * np.pi, 40_001)[None]
    turns, _ = core.move_planes(drive, dyads, places, NO_LINES, own, fine)
    tops = core.find_tops(drive, dyads, places, NO_LINES, own, fine[:, :-1][:, ::400].copy(), EVERY, True)
    cosines = core.find_cosines(drive, dyads, places, NO_LINES, own, tops, EVERY)
    slopes = core.cosine_slopes(drive, dyads, places, own, tops, EVERY)
    for n, dyad in enumerate(dyads):
        arms = [turns[dyad[1 + k], 0] * (places[0, dyad[9]] - places[0, dyad[7 + k]]) for k in range(2)]
        by_arms = np.real(np.conj(arms[0]) * arms[1]) / np.abs(arms[0] * arms[1])
        assert cosines[n, :, 0] == pytest.approx([by_arms.max(), by_arms.min()], abs=1e-4)
        assert tops[0, 2 * n] == pytest.approx(fine[0, by_arms.argmax()], abs=2e-3)
        for k in range(places.shape[1]):
            for part, way in enumerate((1e-6, 1e-6j)):
                change = np.zeros(places.shape, complex)
                change[0, k] = way
                far, near = (
                    core.find_cosines(drive, dyads, places + sign * change, NO_LINES, own, tops, EVERY)[n, :, 0]
                    for sign in (1, -1)
                )
                assert slopes[n, :, 2 * k + part, 0] == pytest.approx((far - near) / 2e-6, abs=1e-6)


def test_a_dyad_that_cannot_be_assembled_has_a_cosine_and_no_place(core):
    """By hand: arms of 1, outer joints 2 apart as drawn, stretched, and 4 after half a turn: (1 + 1 - 16)/2."""
    places = np.array([[0j, 1.0, 2.0, 3.0, 0.5j, 9.0, 3j]])
    dyads = np.array([[0, 2, 3, 1, 0, 1, 3, 1, 3, 2, 2], [0, 4, 5, 2, 0, 4, 5, 4, 5, 6, 6]])
    linkages = WATT[0], dyads, places
    own, turned = np.ones((2, 1)), np.array([[0, np.pi, 0, np.pi]])
    cosines = core.find_cosines(*linkages, NO_LINES, own, turned, EVERY)
    assert cosines[0, :, 0] == pytest.approx([-1, -7])
    assert np.isnan(cosines[1, 1])
    assert np.isnan(core.trace_point(*linkages, own, turned, 1)[0, 1])  # though the crank itself has a place


@pytest.mark.parametrize(
    ("place", "wrong", "words"),
    [
        (0, np.array([0, 0, 0, 0]), "the crank is no link"),
        (0, np.array([0, 1, 0, 8]), "about an element that is none"),
        (1, WATT[1][::-1].copy(), "hangs on a link that is not placed"),
        (1, WATT[1] + 5 * (np.arange(11) == 0), "a form that is none"),
        (1, WATT[1] + (np.arange(11) == 0), "a sliding joint needs its line"),
        (1, WATT[1] + 8 * (np.arange(11) == 9), "an element that is none"),
        (1, np.array([WATT[1][0], WATT[1][0]]), "none or is placed"),
        (2, np.zeros((2, 8), complex), "sides must have"),
        (3, np.ones((1, 8), complex)[:, :4].copy(), "lines must be as many"),
        (4, np.ones((1, 1)), "sides must have"),
        (5, np.zeros((2, 7)), "turned must have"),
    ],
)
def test_wrong_linkages_are_refused(core, place, wrong, words):
    call = [*WATT, NO_LINES, sides(WATT), TURN]
    call[place] = wrong
    with pytest.raises(ValueError, match=words):
        core.move_planes(*call)


def test_wrong_calls_are_refused(core):
    own = sides(WATT)
    with pytest.raises(ValueError, match="a watched dyad is none"):
        core.find_tops(*WATT, NO_LINES, own, TURN, np.array([2]), True)
    with pytest.raises(ValueError, match="at one, at least"):
        core.find_tops(*WATT, NO_LINES, own, TURN[:, :1].copy(), EVERY, True)
    with pytest.raises(ValueError, match="two angles for each"):
        core.find_cosines(*WATT, NO_LINES, own, TURN, EVERY)
    with pytest.raises(ValueError, match="link of the point is none"):
        core.trace_point(*WATT, own, TURN, 6)
    apart = WATT[1].copy()
    apart[0, 7] = 0
    with pytest.raises(ValueError, match="each of one place"):
        core.trace_slopes(WATT[0], apart, WATT[2], own, TURN, POINT, True)
