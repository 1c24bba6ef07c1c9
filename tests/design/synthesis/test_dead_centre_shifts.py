"""How far dead centres move with wrong lengths: against closed forms, and motions of changed links."""

import numpy as np
import pytest

from gruebler.cli import main
from gruebler.design.synthesis import DeadCentreTask, synthesise
from gruebler.design.synthesis.dead_centre_shifts import dead_centre_sensitivity
from gruebler.design.synthesis.dead_centres import dead_centre_family
from gruebler.mechanics.analysis.drive_cycles import drive_cycle
from gruebler.mechanics.analysis.events import stops
from gruebler.mechanics.analysis.outputs import find_output
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism


def rocker(a, b, c, d):
    """Swing and crank angle by the triangles of the stretched and the folded position."""
    reaches = b + a, b - a
    psi = [np.arccos((c * c + d * d - r * r) / (2 * c * d)) for r in reaches]
    outer, inner = (np.arccos((r * r + d * d - c * c) / (2 * r * d)) for r in reaches)
    return np.array([psi[0] - psi[1], np.pi + inner - outer])


def slider(a, b, e):
    """Stroke and crank angle: the pin lies b + a and b - a away on the line at e."""
    outer, inner = np.sqrt((b + a) ** 2 - e * e), np.sqrt((b - a) ** 2 - e * e)
    return np.array([outer - inner, np.pi + np.arcsin(e / (b - a)) - np.arcsin(e / (b + a))])


def slopes(closed_form, lengths):
    """(quantities, lengths) by steps into the complex plane, without rounding, for a thousandth of each length."""
    step = 1e-30
    return np.stack(
        [
            closed_form(*(length * (1 + 1j * step * (k == n)) for n, length in enumerate(lengths))).imag / step * 1e-3
            for k in range(len(lengths))
        ],
        axis=1,
    )


@pytest.mark.parametrize("lengths", [(1, 3, 2.5, 3.5), (0.4783, 1.13, 1, 1.222), (25, 70, 40, 70), (1, 4, 1.5, 4.2)])
def test_crank_rockers(lengths):
    bar = FourBar(*lengths)
    linkage, centres = bar.linkage(), bar.dead_centres
    ends = centres.outer.drive, centres.inner.drive
    found = dead_centre_sensitivity(linkage, find_output(linkage), ends, 1.0)
    links = [row.link for row in found.lengths]
    expected = slopes(rocker, lengths)[:, [("crank", "coupler", "rocker", "frame").index(link) for link in links]]
    assert len(links) == 4
    assert np.abs(np.abs(found.moves[0]) - np.abs(expected)).max() <= 1e-12
    assert found.worst[0] == pytest.approx(np.abs(expected).sum(axis=1), rel=1e-9)


@pytest.mark.parametrize("lengths", [(1, 3, 0.5), (28.23, 76.75, 23.92), (1, 2.2, 1.1)])
def test_slider_cranks(lengths):
    crank = SliderCrank(*lengths)
    linkage, centres = crank.linkage(), crank.dead_centres
    ends = centres.outer.drive, centres.inner.drive
    found = dead_centre_sensitivity(linkage, find_output(linkage), ends, 7.0)
    expected = slopes(slider, lengths)[:, [("crank", "coupler", "frame").index(row.link) for row in found.lengths]]
    expected[1] *= 7.0
    assert expected.shape == (2, 3)
    assert np.abs(np.abs(found.moves[0]) - np.abs(expected)).max() <= 1e-11


@pytest.mark.parametrize("last", ["R(5-0)", "P(0-5)"])
def test_six_bars_by_motions_of_changed_ones(last):
    """Each pin moved by itself: dead centres of the motion, found by its own events."""
    text = f"R(0-1) R(1-2) R(2-3) R(3-0) R(3-4) R(4-5) {last}; frame=0; drive=R(0-1)"
    end = (8.5, -1.5) if last[0] == "R" else (8.5, 2.4, 0.3)
    drawing = [(0, 0), (0, 1), (3, 2.5), (3.5, 0), (4.2, 2.2), (8.5, 2.4), end]
    linkage = Linkage.from_drawing(Mechanism.parse(text), dict(enumerate(drawing)), outputs=["5"])
    linkage = linkage.with_reference_pose(linkage.required_pose)

    def centres(of):
        events = [event for event in stops(drive_cycle(of), find_output(of))[0] if event.kind != "flat"]
        low, high = sorted(events, key=lambda event: event.output)
        return low, high

    low, high = centres(linkage)
    found = dead_centre_sensitivity(linkage, find_output(linkage), (low.drive, high.drive), 1.0)
    step = 1e-5
    for k, row in enumerate(found.lengths):
        seen = []
        for sign in (1, -1):
            elements = {link: {} for link in linkage.mechanism.chain.links}
            for (joint, owner), element in linkage.elements.items():
                elements[owner][joint] = element.place
            moved = elements[row.link]
            if int(row.other) in moved and len(moved[int(row.other)]) == 2:
                first, other = (complex(*moved[int(n)][:2]) for n in (row.first, row.other))
                arm = other - first
                end = other + sign * step * arm * (1j if row.across else 1)
                moved[int(row.other)] = (end.real, end.imag)
            else:  # the offset of the slide
                x, y, angle = moved[int(row.other)]
                first = complex(*moved[int(row.first)][:2])
                normal = 1j * np.exp(1j * angle)
                offset = ((complex(x, y) - first) / np.exp(1j * angle)).imag
                end = complex(x, y) + sign * step * offset * normal
                moved[int(row.other)] = (end.real, end.imag, angle)
            changed = Linkage(linkage.mechanism, elements, reference_pose=linkage.required_pose, outputs=["5"])
            a, b = centres(changed.with_reference_pose(assembled(changed)))
            seen.append((b.output - a.output, (b.drive - a.drive) % (2 * np.pi)))
        expected = 1e-3 * (np.array(seen[0]) - np.array(seen[1])) / (2 * step)
        assert found.moves[0, :, k].real == pytest.approx(expected, abs=2e-8), (row, expected)


def assembled(linkage):
    """The pose near that of the drawing, closed by Newton's method."""
    from gruebler.design.synthesis.closure import DesignClosure

    closure = DesignClosure(linkage)
    q = np.array([[value for link in closure.links for value in linkage.required_pose[link]]])
    q, good = closure.closed(q, closure.sizes, size=linkage.size)
    assert good.all()
    pose = {link: tuple(q[0, c : c + 3]) for link, c in closure.column.items()}
    return pose | {linkage.mechanism.frame: (0.0, 0.0, 0.0)}


@pytest.mark.parametrize(("reach", "closed_form"), [("swing", rocker), ("stroke", slider)])
def test_the_least_sensitive_dead_centres_are_sought(reach, closed_form):
    """Against the closed forms along the whole family, 720 members, and nothing else of the package."""
    task = DeadCentreTask(**{reach: 50.0 if reach == "stroke" else np.radians(60)}, time_ratio=1.2)

    def relative(lengths):
        worst = np.abs(slopes(closed_form, lengths)).sum(axis=1)
        return np.hypot(worst[0] / (50.0 if reach == "stroke" else 1.0), worst[1])

    found = synthesise(task, sort="sensitivity", number=3)
    scale = 50.0 if reach == "stroke" else 1.0
    every = [
        relative([scale * abs(length) for length in member.linkage.named.values()])
        for member in dead_centre_family(task).members
        if max(map(abs, member.linkage.named.values())) < 20 * min(map(abs, member.linkage.named.values()))
    ]
    first = found.designs[0]
    assert first.relative_sensitivity <= min(every) * (1 + 1e-9)
    assert first.relative_sensitivity < synthesise(task).designs[0].relative_sensitivity
    assert first.relative_sensitivity > 0.9 * min(every)


def test_play_counts_in_each_dead_centre():
    """A pin of the crank moved outwards in one dead centre and inwards in the other: the stroke changes by both."""
    crank = SliderCrank(1, 3)
    ends = crank.dead_centres.outer.drive, crank.dead_centres.inner.drive
    found = dead_centre_sensitivity(crank.linkage(), find_output(crank.linkage()), ends, 1.0)
    # In line each of the three pins moves the slider as far as itself, in both dead centres; the guide does not.
    assert found.of_errors(0.0, 0.01)[0, 0] == pytest.approx(6 * 0.01, rel=1e-9)
    assert found.sampled(0.0, 0.01)[:, 0, 0].max() <= 6 * 0.01 + 1e-12


def test_tables_tell_what_dead_centres_do(capsys):
    options = ["--stroke", "50", "--time-ratio", "1.2", "--sort", "sensitivity", "--clearance", "0.05", "--number", "2"]
    assert main(["synthesise", "dead-centres", *options]) == 0
    said = capsys.readouterr().out
    assert "swing or stroke and the crank angle between the dead centres change" in said
    assert "in each dead centre they may lie in another direction" in said
