"""Masses, springs and forces in pictures: where they lie, by the kinematics and by hand."""

import numpy as np
import pytest

from gruebler.base.errors import LinkageError
from gruebler.mechanics.forces import Gas, Loads, RigidBody, Spring, TorsionSpring
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.linkages import LinkPoint
from gruebler.pictures.linkage.animation import animated_svg, scene
from gruebler.pictures.linkage.load_pictures import load_lines, mass_parts
from gruebler.pictures.linkage.picture import draw_linkage
from gruebler.pictures.linkage.posed_linkage import posed_linkage
from tests.commands import run_command

LINKAGE = FourBar(25, 70, 40, 70).linkage({"K": (35, 20)})
PULLS = {
    "zigzag": Spring(("frame:20,90", "K"), stiffness=0.5),
    "gas": Spring(("frame:20,90", "K"), law=Gas(force=100.0, extended=120.0, stroke=90.0)),
    "damper": Spring(("frame:20,90", "K"), damping=0.2),
}


def places(points):
    return np.array([complex(p.x, -p.y) for p in points])


@pytest.mark.parametrize("kind", PULLS)
def test_a_spring_joins_its_points_in_every_pose(kind):
    posed = posed_linkage(LINKAGE)
    rows = load_lines(posed, posed.path, Loads(springs=(PULLS[kind],)), None)
    assert len(rows) == len(posed.path)
    for row, lines in enumerate(rows):
        ends = places([lines[0].parts[0][0], lines[0].parts[-1][-1]]) / posed.scale
        assert ends == pytest.approx([20 + 90j, posed.path.complex_point("K")[row]], abs=1e-9)
        dots = np.array([places(dot.parts[0]) / posed.scale for dot in lines[1:]])
        assert dots.mean(1) == pytest.approx(ends, abs=1e-9)  # a dot where the spring is fastened
        assert [len(part) for part in lines[0].parts] == [len(part) for part in rows[0][0].parts]


def test_what_is_no_loads_is_refused():
    with pytest.raises(LinkageError, match="loads: expected Loads, but found 5"):
        draw_linkage(LINKAGE, loads=5)


def test_a_zigzag_is_seven_coils_wide_as_said():
    posed = posed_linkage(LINKAGE)
    line, *_ = load_lines(posed, posed.pose, Loads(springs=(PULLS["zigzag"],)), None)[0]
    z = places(line.parts[0])
    across = (np.conj(z[-1] - z[0]) * (z - z[0])).imag / abs(z[-1] - z[0])
    assert np.abs(across).max() == pytest.approx(6)
    assert np.isclose(np.abs(across), 6).sum() == 2 * 7 - 1


def test_a_spiral_is_wound_by_the_angle_of_its_links():
    """The angle of the crank is the drive's; the turns are counted along the drawn line."""
    posed = posed_linkage(LINKAGE)
    pinned, loose = (TorsionSpring(("frame", link), stiffness=1.0, free_angle=0.5) for link in ("crank", "coupler"))
    drives = posed.path.drives[:, 0]
    rows = load_lines(posed, posed.path, Loads(torsion_springs=(pinned, loose)), None)
    for row, lines in enumerate(rows):
        assert len(lines) == 1  # coupler and frame have no pin
        z = places(lines[0].parts[0])  # about the origin, where the crank is pinned
        assert len(z) == len(rows[0][0].parts[0])
        assert np.angle(z[1:] / z[:-1]).sum() == pytest.approx(4 * np.pi + drives[row] - 0.5)
        assert np.exp(1j * np.angle(z[-2:])) == pytest.approx(
            np.exp(1j * drives[row] * np.ones(2))
        )  # the leg lies on it


def test_centres_of_mass_lie_where_the_loads_say():
    posed = posed_linkage(LINKAGE)
    loads = Loads(bodies={"coupler": RigidBody(1.0, (35, 8))}, masses={LinkPoint("crank", -5.0, 0.0): 2.0})
    centres = [complex(part.shapes[0].at.x, -part.shapes[0].at.y) / posed.scale for part in mass_parts(posed, loads)]
    assert centres == pytest.approx([-5 + 0j, 35 + 8j], abs=1e-9)  # in coordinates of the links


def test_arrows_are_the_forces():
    """100 N on the slider at 90°: 125 N in both pins of the coupler, 75 N on the guide, since sin a = 3/5."""
    press = SliderCrank(3, 5).linkage()
    posed = posed_linkage(press, np.pi / 2)
    loads = Loads(forces={"R(coupler-slider)": (-100.0, 0.0)}, gravity=(0, 0))
    lines = [line for line in load_lines(posed, posed.pose, loads, 0.0)[0] if line.style == "velocity-head"]
    at = posed.scale * posed.pose.complex_point("R(crank-coupler)")[0]
    heads = places([line.parts[0][0] for line in lines])
    assert abs(heads[1] - at) == pytest.approx(74)  # the longest
    assert heads[1] - at == pytest.approx(74 * (4 - 3j) / 5 * np.sign((heads[1] - at).real), abs=1e-6)
    pin = posed.scale * posed.pose.complex_point("R(coupler-slider)")[0]
    assert heads[4] - pin == pytest.approx(-74 * 100 / 125, abs=1e-6)  # the load comes last
    assert abs(heads[3].imag - pin.imag) == pytest.approx(74 * 75 / 125, abs=1e-6)


def test_an_animation_moves_them():
    loads = Loads(springs=(PULLS["zigzag"],), bodies={"coupler": RigidBody(1.0, (35, 8))})
    shown = scene(LINKAGE, loads=loads, speed=10.0)
    text = animated_svg(LINKAGE, loads=loads, speed=10.0)
    assert text.count('attributeName="d"') == len(shown.changing[0]) == 3 + 2 * 4  # spring and ends, arrows at joints
    assert all(values.count(";") == len(shown.rows) - 1 for values in text.split('attributeName="d"')[1:2])
    assert len(draw_linkage(LINKAGE, loads=loads).shapes) == len(draw_linkage(LINKAGE).shapes) + 3 + 3


def test_commands(capsys):
    status, out, _ = run_command(capsys, "draw", "hood", "--loads")
    assert status == 0
    assert 'class="gr-velocity-head"' in out
    status, out, _ = run_command(capsys, "animate", "compressor", "--loads")
    assert status == 0
    assert out.count('attributeName="d"') > 8
    _, _, err = run_command(capsys, "draw", "jansen", "--loads")
    assert "has no masses and no loads" in err
    for command in ("draw", "animate"):
        _, _, err = run_command(capsys, command, "universal_joint", "--loads")
        assert "--loads does not go with a linkage in space" in err
