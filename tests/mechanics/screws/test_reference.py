"""The list of numeric mobility checks: REFERENCE A3, by twist-space rank, computed independently of this project."""

import pytest

from gruebler.mechanics.screws import Evidence, freedoms
from tests.mechanics.screws import machines as m

# [mobility, rank, constraints] at the pose; then what really moves
REFERENCE = [
    ("loco k=2", m.locomotive(2), [1, 8, 8], 1, None),
    ("loco k=3", m.locomotive(3), [1, 11, 12], 1, "cranks"),
    ("loco k=4", m.locomotive(4), [1, 14, 16], 1, "cranks"),
    ("loco k=3 with 1% crank error", m.locomotive(3, error=0.01), [1, 11, 12], 0, "parallel"),
    ("loco k=2 at phi=0 (collinear)", m.locomotive(2, angle=0.0), [2, 7, 8], 1, "line"),
    ("strut parallel", m.strut(), [1, 11, 12], 1, "cranks"),
    ("strut generic", m.strut(0.1), [0, 12, 12], 0, None),
    ("friction rigid (centre on line)", m.friction(), [1, 5, 6], 1, "centres"),
    ("friction forced", m.friction_arm(), [1, 8, 8], 1, None),
    ("friction forced (arm pivot off)", m.friction_arm((1.0, -2.0)), [1, 8, 8], 1, None),
    ("gear", m.gears(), [1, 5, 5], 1, None),
    ("geneva", m.geneva(), [1, 5, 5], 1, None),
    ("geneva dwell (locking arc, 2 contact points)", m.geneva_dwell(), [1, 5, 6], 1, "locking"),
    ("hubpodium", m.lift(), [1, 8, 8], 1, None),
    ("scissor2", m.two_stage(), [1, 14, 14], 1, None),
    ("scissor_tandem", m.two_scissors(12.0), [1, 14, 16], 1, "copies"),
    ("scissor_lr (same plane positions)", m.two_scissors(0.0), [1, 14, 16], 1, "copies"),
    ("toolbox2 parallel", m.toolbox(), [1, 11, 12], 1, "cranks"),
    ("toolbox2 detuned", m.toolbox(0.05), [0, 12, 12], 0, None),
    ("diff planets=1", m.differential(1), [2, 10, 10], 2, None),
    ("diff planets=2", m.differential(2), [2, 13, 14], 2, "planets"),
    ("diff planets=3", m.differential(3), [2, 16, 18], 2, "planets"),
    ("drafting", m.drafting(), [2, 16, 16], 2, None),
    ("winch screw (spatial)", m.winch(), [1, 11, 15], 1, "group_cylinder"),
    ("bevel diff planets=1", m.bevel_in_space(1), [2, 22, 22], 2, None),
    ("bevel diff planets=2", m.bevel_in_space(2), [2, 28, 29], 2, None),
    # the paradoxical linkages and the loops they are told from, with the ranks that their kinds of loop have
    ("bennett", m.bennett()[0], [1, 17, 20], 1, "bennett"),
    ("bennett detuned", m.bennett(error=0.01)[0], [0, 18, 20], 0, None),
    ("bricard, line-symmetric", m.bricard("line"), [1, 29, 30], 1, "line_symmetric"),
    ("bricard, plane-symmetric", m.bricard("plane"), [1, 29, 30], 1, "plane_symmetric"),
    ("bricard off", m.bricard("line", 0.01), [0, 30, 30], 0, None),
    ("sarrus", m.sarrus(), [1, 29, 30], 1, "sarrus"),
    ("schatz", m.schatz(-0.4), [1, 29, 30], 1, "schatz"),
    ("schatz, a fork 1 % longer", m.schatz(-0.4, lengths=(1.01, 1, 1)), [0, 30, 30], 0, None),
    ("hooke", m.hooke(), [1, 17, 20], 1, "group_sphere"),
    ("hooke, axes apart", m.hooke(apart=0.1), [0, 18, 20], 0, None),
    ("double cardan", m.cardan(), [1, 17, 18], 1, "cardan"),
    ("double cardan, bearing off", m.cardan(aside=0.1), [0, 18, 18], 0, None),
    ("oldham", m.oldham(), [1, 17, 20], 1, "group_plane"),
    ("oldham in its plane", m.oldham("planar"), [1, 8, 8], 1, None),
    ("bevel on the sphere, two planets", m.bevel(2), [2, 13, 14], 2, "planets"),
    ("generic 4R", m.loop(4), [0, 18, 20], 0, None),
    ("generic 6R", m.loop(6), [0, 30, 30], 0, None),
    ("generic 7R", m.loop(7), [1, 35, 35], 1, None),
]


@pytest.mark.parametrize(
    ("name", "linkage", "instant", "finite", "reason"), REFERENCE, ids=[row[0] for row in REFERENCE]
)
def test_the_reference(name, linkage, instant, finite, reason):
    found = freedoms(linkage)
    assert [found.instant.mobility, found.instant.rank, found.instant.constraints] == instant
    assert found.mobility == finite
    assert found.instant.redundancy == instant[2] - instant[1]
    above, below = found.instant.gap
    assert above > 1e-6
    assert below < 1e-14  # the rank is never a matter of the tolerance here
    assert reason is None or reason in [r.kind for r in found.reasons]
    if found.instant.redundancy == 0:
        assert found.finite.evidence is (Evidence.REGULAR if finite else Evidence.RIGID)


@pytest.mark.parametrize("name", ["bevel diff planets=2", "strut generic", "gear"])
def test_no_reason_is_invented(name):
    found = freedoms(next(row[1] for row in REFERENCE if row[0] == name))
    assert found.reasons == ()
