"""Everything derived of one machine, in both languages and as data."""

import json
from math import degrees

import numpy as np
import pytest

from gruebler.mechanics.kinematics import move
from gruebler.teaching.catalog import entries, entry
from gruebler.teaching.catalog.machine_report import machine_report


@pytest.mark.parametrize("id", entries())
def test_every_entry_has_one(id):
    record = entry(id)
    found = machine_report(record)
    claimed = record.claims.mobility
    assert found.moves == (found.mobility.generic if claimed is None else claimed)
    for lang, titles in (
        ("en", ("Mobility:", "What really moves:", "Access features:", "Drive:")),
        ("de", ("Laufgrad:", "Was sich wirklich bewegt:", "Zugriffsmerkmale:", "Antrieb:")),
    ):
        text = found.explain(lang)
        assert all(title in text.splitlines() for title in titles)
        assert text.count(found.mobility.count.formula()) == 1
    document = json.loads(json.dumps(found.to_json(), allow_nan=False))
    assert document["mobility"]["counted"] == found.mobility.counted
    one_drive = record.dimensions is not None and len(found.mechanism.drives) == 1
    assert (document["measures"] is not None) == one_drive
    assert len(document["points"]) == (len(record.dimensions.points) if one_drive else 0)


def test_the_path_of_a_point_against_a_polygon():
    """Length and extents of a path between limits, and of a closed one, against 20,000 poses."""
    for id, full in (("lambda", True), ("watt_axle", False)):
        report = machine_report(entry(id))
        (point,) = report.points
        span = report.measures.span
        assert point.closed == full == span.full
        rows = np.linspace(0, 2 * np.pi, 20001) if full else span.low + span.width * _dense(20001)
        z = move(entry(id).linkage(), rows).complex_point(point.name)
        assert point.length == pytest.approx(abs(np.diff(z)).sum(), rel=1e-5)
        assert (point.width, point.height) == pytest.approx((np.ptp(z.real), np.ptp(z.imag)), rel=1e-5)


def _dense(rows):
    """From 0 to 1, close at both ends, not on them."""
    return np.sin(np.linspace(1e-5, np.pi - 1e-5, rows) / 2) ** 2


def test_figures_of_the_reference():
    """REFERENCE B4: the lambda linkage reaches x from -7.036141 to 87.036141, y from 80 to 97.979590."""
    (point,) = machine_report(entry("lambda")).points
    assert (point.width, point.height) == pytest.approx((94.072282, 17.979590), abs=2e-6)


def test_special_dimensions_are_told():
    report = machine_report(entry("loco3"))
    assert (report.mobility.counted, report.moves) == (0, 1)
    assert "3 equal and parallel cranks" in report.explain()
    assert "almost all other dimensions would give another mobility than 1" in report.explain()
    shaky = machine_report(entry("pumpjack_rod"))
    assert shaky.moves == 0
    assert "only shaky" in shaky.explain()


def test_the_transmission_angle_in_the_range_shown():
    report = machine_report(entry("crane"))
    assert degrees(report.measures.transmission.smallest.mu) == pytest.approx(0, abs=1e-6)  # at the ends of all motion
    small, large = report.shown_mu
    assert 40 < degrees(small) < degrees(large) <= 90
    assert machine_report(entry("wiper")).shown_mu is None  # it turns fully


def test_several_drives():
    """A lever on three slides adds: 2 s1 - s2, where it lies level."""
    partials = machine_report(entry("diff_lever")).partials
    assert [one.value for one in partials] == pytest.approx([2, -1], abs=1e-12)
    assert {one.output for one in partials} == {"slider3"}
    linkage, step = entry("excavator").linkage(), 1e-4
    for k, one in enumerate(machine_report(entry("excavator")).partials):  # against differences
        home = np.array([other.at for other in machine_report(entry("excavator")).partials])
        rows = [home - step * np.eye(3)[k], home + step * np.eye(3)[k]]
        assert one.value == pytest.approx(np.diff(move(linkage, rows).angle("bucket"))[0] / (2 * step), rel=1e-6)
    assert "moves by 2 for each unit of P(frame-slider1)" in machine_report(entry("diff_lever")).explain()


@pytest.mark.parametrize("id", ["drafting", "drafting3"])
def test_an_output_at_rest_does_not_show_rounding(id):
    """The head of a drafting machine stays parallel to the board."""
    report = machine_report(entry(id))
    assert 0.0 in [partial.value for partial in report.partials]
    assert all(partial.value == 0 or abs(partial.value) > 1e-3 for partial in report.partials)
    assert "rests while" in report.explain()
    assert "e-" not in " ".join(line for line in report.explain().splitlines() if line.startswith("  As drawn"))
