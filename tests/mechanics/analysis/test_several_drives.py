"""What several drives do to the output: Willis by hand, and each drive alone by the linkage with that drive only."""

from __future__ import annotations

import re

import numpy as np
import pytest

from gruebler.files import linkage_to_json
from gruebler.mechanics.analysis.outputs import find_output
from gruebler.mechanics.analysis.several_drives import several_drives_lines, speed_relation
from gruebler.mechanics.kinematics.solve import cached_plan
from gruebler.mechanics.linkages import Linkage
from gruebler.page.model import model_of
from gruebler.page.requests import answer
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry


def told(name: str, lang: str) -> str:
    """What the page says of a machine of the catalog in words."""
    asked = {"document": linkage_to_json(entry(name).linkage()), "source": name, "between": []}
    return "\n".join(answer("measures", asked, lang, print)["lines"])


@pytest.mark.parametrize("name", ["diff", "diff2p"])
def test_a_differential_by_willis(name: str) -> None:
    """30 teeth outside, 60 inside: (ω1 - ωs) / (ω2 - ωs) = -60/30, so that 3 ωs = ω1 + 2 ω2."""
    linkage = entry(name).linkage()
    assert speed_relation(cached_plan(linkage), find_output(linkage)) == pytest.approx((1 / 3, 2 / 3), abs=1e-12)
    assert "ω(carrier) = 0.3333 ω(sun) + 0.6667 ω(ring gear)." in told(name, "en")
    assert "ω(Steg) = 0,3333 ω(Sonnenrad) + 0,6667 ω(Hohlrad)." in told(name, "de")


def test_angles_of_an_arm_add() -> None:
    """The second drive turns the pen arm against the long one."""
    assert "ω(pen arm) = ω(long arm) + ω(R(long arm-pen arm))." in told("pantograph", "en")


def test_the_output_of_a_five_bar_is_moved_by_both_drives() -> None:
    """With link 5 held the others are a crank-rocker, whose rocker 4 swings between the crank along and against 3."""
    crank, coupler, rocker, ground = abs(-30 + 52j), abs(70 + 71j), abs(70 - 71j), abs(110 + 52j)
    ends = [
        np.arccos((rocker**2 + ground**2 - reach**2) / (2 * rocker * ground))
        for reach in (coupler + crank, coupler - crank)
    ]
    linkage = entry("pent").linkage()
    assert find_output(linkage).name == "4"
    first, second = list(several_drives_lines(linkage))[1:]
    swing = f"The output 4 swings through {np.degrees(ends[0] - ends[1]):.2f}°."
    assert first.in_language("en").endswith(swing)
    assert second.in_language("en").endswith(swing)  # it is symmetric


def test_the_output_of_an_arm_is_its_last_link() -> None:
    mechanism = Mechanism.parse("R(0-1) R(1-2) R(2-3); frame=0; drive=R(0-1); drive=R(1-2); drive=R(2-3)")
    places = {0: (0, 0), 1: (0, 2), 2: (2, 2)}
    assert find_output(Linkage.from_drawing(mechanism, places)).name == "3"


def test_a_link_that_only_travels_is_told_with_its_way() -> None:
    """The head of the desk lamp stays level, while each arm of 250 mm takes it along a chord: of 90° and of 100°."""
    first, second = told("lamp", "en").splitlines()[1:3]
    assert first.endswith("The output head does not turn; its points travel 353.6 mm.")
    assert second.endswith("The output head does not turn; its points travel 383 mm.")


def test_the_stroke_of_a_valve_with_the_reverser_held() -> None:
    """A linear relation is none of a valve gear; each drive is told with the value at which the other one is held.

    The stroke is compared with 3600 poses of one turn.
    """
    from math import tau

    from gruebler.mechanics.kinematics import move

    linkage = entry("stephenson_gear").linkage()
    assert speed_relation(cached_plan(linkage), find_output(linkage)) is None
    first, second = list(several_drives_lines(linkage))[1:]
    held = np.full(3601, np.pi)
    places = find_output(linkage).values(move(linkage, np.stack([np.linspace(0, tau, 3601), held], axis=1)))
    english = first.in_language("en")
    assert english.startswith("With R(frame-reverser) at 180° held, R(frame-axle) drives. The drive turns fully.")
    stroke = re.search(r"stroke of ([\d.]+) mm", english)
    assert stroke
    assert float(stroke[1]) == pytest.approx(np.ptp(places), abs=0.01)
    assert second.in_language("de").startswith("Festgehalten: D(frame-axle) bei 110°; Antrieb: D(frame-reverser).")


def test_sizes_without_a_field_are_told() -> None:
    """Teeth of wheels, radii and law of a cam; the foot of Jansen's leg has sides of 49 and 65.7 (Jansen's numbers)."""
    assert "sun [mm]: pitch radius 30, teeth 30." in told("diff", "en")
    assert "Rolle [mm]: Radius 10." in told("cam_roller", "de")
    assert "F [cm]: 49 to lower rod – rocker, 65.7 to link." in told("jansen", "en")


def test_the_stops_of_a_machine_bound_its_drives() -> None:
    """The catalog gives the first cylinder of the excavator 240 to 330 cm."""
    assert "The drive moves from 240 cm to 330 cm." in told("excavator", "en")


def test_the_page_has_the_output_of_several_drives() -> None:
    """So that it shows how far the output goes while one drive moves, with its plots."""
    model = model_of(entry("walschaerts_gear").linkage())
    (output,) = model["outputs"]
    assert model["links"][output["link"]] == "valve"
    assert output["legs"] == []
