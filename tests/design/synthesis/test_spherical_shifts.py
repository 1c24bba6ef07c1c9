"""How far four-bars on the sphere give way to wrong arcs: against changed ones, the plane, and random linkages."""

import numpy as np
import pytest

from gruebler.cli import main
from gruebler.design.synthesis import Demands, synthesise_orientations, synthesise_spherical_function
from gruebler.design.synthesis.sensitivity import length_sensitivity
from gruebler.design.synthesis.spherical_shifts import largest_turn, spherical_sensitivity
from gruebler.design.synthesis.targets import Probe
from gruebler.files.orientations import rotation
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.space.spherical_four_bar import SphericalFourBar

ARCS = np.array([0.5, 1.4, 1.1, 1.2])
STEP = 1e-6


def about(axis, angle):
    return rotation(*axis, angle)


def axes_of(arcs, phi):
    """(4, 3) A0 along z, B0 in the plane of x and z; B by the output's angle."""
    a, _, c, d = arcs
    psi = float(SphericalFourBar(*arcs).motion(np.array([phi])).output.value[0])
    pin = np.array([np.sin(a) * np.cos(phi), np.sin(a) * np.sin(phi), np.cos(a)])
    b0 = np.array([np.sin(d), 0, np.cos(d)])
    # As the crank's pin lies about z, the output's lies about B0, turned there with the arc d about y.
    far = about((0, 1, 0), d) @ np.array([np.sin(c) * np.cos(psi), np.sin(c) * np.sin(psi), np.cos(c)])
    return np.array([[0, 0, 1], pin, far, b0]), psi


def body(axes):
    """The coupler's own directions: along A, and across the arc to B."""
    across = np.cross(axes[1], axes[2])
    across /= np.linalg.norm(across)
    return np.stack([axes[1], across, np.cross(axes[1], across)], axis=1)


@pytest.mark.parametrize("phi", [0.3, 1.1, 2.4, 4.0])
def test_arcs_against_changed_four_bars(phi):
    axes, _ = axes_of(ARCS, phi)
    assert np.arccos(axes[1] @ axes[2]) == pytest.approx(ARCS[1], abs=1e-12)
    output, coupler = (spherical_sensitivity(axes[None], ARCS, coordinates=flag) for flag in (True, False))
    for k in range(4):
        ends = [axes_of(ARCS * (1 + sign * STEP * (np.arange(4) == k)), phi) for sign in (1, -1)]
        assert output.moves[0, k, 0] == pytest.approx(1e-3 * (ends[0][1] - ends[1][1]) / (2 * STEP), abs=2e-9)
        turn = body(ends[0][0]) @ body(ends[1][0]).T
        small = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2
        assert coupler.moves[0, k] == pytest.approx(1e-3 * small / (2 * STEP), abs=2e-9)


def test_small_caps_are_the_plane():
    lengths, phi, small = np.array([1.0, 3.0, 2.5, 3.5]), 0.9, 1e-4
    linkage = FourBar(*lengths).linkage()
    plane = length_sensitivity(linkage, (Probe(link="rocker"),), np.array([[phi]]))
    order = [("crank", "coupler", "rocker", "frame").index(row.link) for row in plane.lengths]
    axes, _ = axes_of(small * lengths, phi)
    sphere = spherical_sensitivity(axes[None], small * lengths, coordinates=True)
    assert np.abs(sphere.moves[0, order, 0]) == pytest.approx(np.abs(plane.moves[0, 0]), rel=1e-5)


@pytest.mark.parametrize("joint", range(4))
def test_play_turns_what_follows_a_joint(joint):
    """Each joint's axis tilted by itself: the loop is closed again by Newton's method on its three turns."""
    axes, _ = axes_of(ARCS, 1.1)
    found = spherical_sensitivity(axes[None], ARCS, coordinates=False)
    axis = axes[joint]
    first = np.cross(axis, axes[(3, 0, 1, 0)[joint]])
    first /= np.linalg.norm(first)
    for k, tilt in enumerate((first, np.cross(axis, first))):
        turns = np.zeros(3)

        def chain(turns, tilt=tilt):
            """Rotations of the coupler seen over A0 and A, and seen over B0 and B."""
            tilts = [about(tilt, 1e-5) if joint == n else np.eye(3) for n in range(4)]
            left = tilts[0] @ tilts[1] @ about(axes[1], turns[0])
            right = tilts[3] @ about(axes[3], turns[2]) @ tilts[2] @ about(axes[2], turns[1])
            return left, right

        for _ in range(6):
            left, right = chain(turns)
            gap = left.T @ right
            value = np.array([gap[2, 1] - gap[1, 2], gap[0, 2] - gap[2, 0], gap[1, 0] - gap[0, 1]]) / 2
            matrix = np.stack([-axes[1], axes[2], axes[3]], axis=1)
            turns = turns - np.linalg.solve(matrix, value)
        left, _ = chain(turns)
        small = np.array([left[2, 1] - left[1, 2], left[0, 2] - left[2, 0], left[1, 0] - left[0, 1]]) / 2
        assert found.plays[0, joint, k] == pytest.approx(small / 1e-5, abs=1e-4)


def test_bounds_hold_for_random_linkages():
    axes = np.array([axes_of(ARCS, phi)[0] for phi in (0.3, 1.1, 2.4)])
    found = spherical_sensitivity(axes, ARCS, coordinates=False)
    sampled, bound = found.sampled(clearance=0.01), found.of_errors(clearance=0.01)
    assert (sampled.max(axis=0) <= bound + 1e-12).all()
    assert (sampled.max(axis=0) > 0.5 * bound).all()
    signs = np.array(np.meshgrid(*[[1, -1]] * 4)).reshape(4, -1)
    every = np.linalg.norm(np.einsum("as,tax->tsx", signs, found.moves), axis=2).max(axis=1)
    assert largest_turn(found.moves) == pytest.approx(every, rel=1e-12)


def test_the_axes_of_a_random_linkage_lie_at_one_place_of_their_bearings():
    """All round the crank neighbouring poses are missed nearly alike: the direction of a tilt moves with its link."""
    axes = np.array([axes_of(ARCS, phi)[0] for phi in np.radians(np.arange(0, 361))])
    seen = spherical_sensitivity(axes, ARCS, coordinates=False).sampled(0.0, 0.01, samples=200)
    assert np.abs(np.diff(seen, axis=1)).max() < 0.1 * seen.max()
    assert seen[:, 0] == pytest.approx(seen[:, -1], rel=1e-9)


TURNS = [rotation(0, 0, 1, 0), rotation(1, 0.5, 2, 0.4), rotation(0.4, 0.2, 1, 0.8), rotation(0, -0.3, 1, 1.2)]


@pytest.mark.parametrize("count", [3, 4])
def test_the_least_sensitive_orientations_are_sought(count):
    demands = Demands(transmission=np.radians(30))
    usual, sought = (synthesise_orientations(TURNS[:count], demands, sort=sort) for sort in ((), ["sensitivity"]))
    shifts = [design.relative_sensitivity for design in sought.designs]
    assert shifts == sorted(shifts)
    assert shifts[0] < 0.95 * min(design.relative_sensitivity for design in usual.designs)


def test_the_least_sensitive_function_is_sought():
    phi, psi = np.radians([0, 25, 60]), np.radians([0, 10, 60])
    options = {"frame": np.radians(90), "free_starts": True}
    demands = Demands(transmission=np.radians(30))
    usual = synthesise_spherical_function(phi, psi, demands, **options)
    sought = synthesise_spherical_function(phi, psi, demands, sort=["sensitivity"], **options)
    shifts = [design.relative_sensitivity for design in sought.designs]
    assert shifts == sorted(shifts)
    assert shifts[0] <= min(design.relative_sensitivity for design in usual.designs) * (1 + 1e-9)
    first = sought.designs[0]
    arcs = np.array([getattr(first.four_bar, arc) for arc in "abcd"])
    worst = 0.0
    for angle in first.drives:  # by changed four-bars on the same branch
        moved = 0.0
        for k in range(4):
            ends = [
                float(
                    SphericalFourBar(*(arcs * (1 + sign * STEP * (np.arange(4) == k))))
                    .motion(np.array([angle]), branch=first.branch)
                    .output.value[0]
                )
                for sign in (1, -1)
            ]
            moved += abs(ends[0] - ends[1]) / (2 * STEP) * 1e-3
        worst = max(worst, moved)
    assert first.relative_sensitivity == pytest.approx(worst, rel=1e-6)


def test_tables_tell_how_far_targets_turn(tmp_path, capsys):
    path = tmp_path / "turns.toml"
    path.write_text("orientations = [[0, 0, 1, 0], [1, 0.5, 2, 20], [0.4, 0.2, 1, 45], [0, -0.3, 1, 70]]\n")
    command = ["synthesise", "orientations", str(path), "--number", "2", "--sort", "sensitivity", "--clearance", "0.1"]
    assert main(command) == 0
    said = capsys.readouterr().out
    assert "how far the most sensitive target turns if all arcs are wrong by 0.1 %" in " ".join(said.split())
    assert "99 % of random linkages" in said
    assert main([*command[:-1], "90"]) == 2
    assert main([*command[:5], "--sort", "size"]) == 2
    assert "designs are sorted by transmission, size-ratio, sensitivity, full-turn" in capsys.readouterr().err
