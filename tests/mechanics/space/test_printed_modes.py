"""Systems of equations with all their solutions in print, put into linkages: the modes are those solutions.

Systems and solutions as PHCpack prints them (src/Demo/rbpl24, kinema, ipp2, puma, assur44). The dimensions were read
off the coefficients: a leg's equation, for example, is |α p1 + β p2 + γ p3 + c (p2 - p1) x (p3 - p1) - A|² = L² with
the squares of the first six equations put in.
"""

from math import sqrt

import numpy as np
import pytest

from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.space import assembly_modes
from gruebler.mechanics.space.generic_modes import ComplexDimensions, structure_of
from gruebler.mechanics.space.modes import _all_ends, _generic, _held
from gruebler.structure.mechanism import Mechanism
from tests.mechanics.space.test_modes import loop, platform

# rbpl24, the "parallel robot with 24 real solutions" of F. Rouillier: the platform's first ball in those.
RBPL24 = [
    (-0.868845003, -0.377102100, 0.543476188), (0.980796179, 0.403173200, -0.260680314),
    (-0.753351901, 0.582986827, -0.533901931), (0.924832556, -0.561397427, -0.148262176),
    (-0.513765914, -0.402040339, 0.875712368), (0.947847986, 0.518234841, 0.159627206),
    (-0.631242531, 0.211799614, -0.865527464), (0.645762201, -0.167451146, -0.864531835),
    (-0.859361305, -0.114536036, 0.663960574), (-0.206924880, 0.112822208, -1.066263215),
    (-0.449613996, -0.808220016, -0.580595952), (-0.470249860, -0.267972395, -0.948430211),
    (1.024658799, 0.035629126, 0.375857568), (0.820201863, 0.650130739, 0.311549235),
    (0.424033337, -0.684488004, -0.737655680), (1.059893352, -0.244995778, -0.095221585),
    (-0.796340608, 0.645101520, -0.377027406), (-0.853729870, 0.556043843, -0.392968897),
    (-0.455699780, -0.690618194, 0.712634703), (0.993052560, 0.434015781, -0.133943704),
    (-0.835155706, 0.591094684, 0.381557363), (-0.817377439, 0.330749511, 0.644176127),
    (-0.842970868, 0.608348453, -0.334329592), (0.739531071, -0.729179211, 0.337424767),
]  # fmt: skip
# kinema: a platform whose base and body lie in planes (A.-M. Bellido, Numerical Algorithms 6, 1992); likewise.
KINEMA = [
    (5.536413299, -4.872940360, 8.946481969), (12, 8, 2), (2.726507808, 2.582476182, 9.306721530),
    (4.058697941, 7.235458590, 6.919500365), (4, 0, 10), (5.142260497, 8.319021146, 5.835937809),
    (15.058419319, 4.649065660, -0.575524051), (9.391666168, 9.247634542, 2.641563170),
]  # fmt: skip


@pytest.mark.parametrize(
    ("base", "body", "lengths", "first"),
    [
        (
            [(0, 0, 0), (1, 0, 0), (-0.1, 1.799, 0), (0.544, -0.0177, 1.818), (-1.036, 1.37, -1.812), (2, 0, 0)],
            np.array([(0, 0, 0), (2.507, 0, 0), (0.333, 0.591, 0), (0.195, -0.906, -0.569), (0.923, 0.169, 1.944),
                      (2.507, 0, 0)]),
            [1.092, 2.28, 2.031, 2.524, 3.135, sqrt(359711 / 40000)],
            RBPL24,
        ),
        (
            [(6, 0, 0), (0, 6, 0), (0, 12, 6), (6, 12, 12), (12, 6, 12), (12, 0, 6)],
            # p1, p2, p3, p2 + p3 - p1, p1 + p2 - p3, p1 + p3 - p2
            sqrt(2) * np.array([(0, 0, 0), (4, 0, 0), (6, sqrt(12), 0), (10, sqrt(12), 0), (-2, -sqrt(12), 0),
                                (2, sqrt(12), 0)]),
            np.sqrt([104, 104, 80, 104, 200, 144]),
            KINEMA,
        ),
    ],
    ids=["rbpl24", "kinema"],
)  # fmt: skip
def test_platforms_have_the_forty_solutions_of_their_equations_the_real_ones_as_printed(base, body, lengths, first):
    size = max(lengths)
    shift = np.array([0.1, 0.08, 0.9]) * size
    linkage, reference = platform(base, body + shift, "SSSSSS")
    modes = assembly_modes(linkage, [lengths - reference])
    assert (len(modes), modes.number, modes.exact) == (len(first), 40, True)
    balls = (modes.pose("platform") @ np.append(shift, 1))[:, :3]
    apart = abs(balls[:, None] - np.array(first)).max(axis=2)
    assert max(apart.min(axis=0).max(), apart.min(axis=1).max()) < 1e-8


# ipp2, the inverse of a 6R arm with complex dimensions: C. Wampler, A. Morgan, Mechanism and Machine Theory 26 (1991)
# 91-106. z1 is (0, 0, 1); the first component of the second axis in the solutions.
IPP2 = [
    0.681970587 - 0.301278760j, -2.299888148 + 0.717373477j, 2.319004940 + 1.030599233j,
    2.183658966 + 1.809666302j, 0.771134077 - 1.603106263j, -0.500298739 + 0.728569554j,
    0.437283248 - 0.889867543j, -0.499555732 - 0.199352719j, -0.693496078 + 0.447800547j,
    0.266481908 + 1.034685421j, -0.424372483 - 0.255077954j, 0.487850966 - 0.272293660j,
    -0.590559816 + 0.258616898j, 0.534143440 - 1.185953773j, 0.472424480 + 0.128627012j,
    -0.486620351 + 1.379390237j,
]  # fmt: skip


def test_a_complex_arm_has_the_sixteen_printed_solutions():
    """Axes z1 .. z6: cosines between neighbours, Σ d_k z_k + a_k z_k x z_(k+1) = p."""
    cosines = np.array([
        0.642935654806 + 0.819555356316j, 0.266880023988 + 0.452565255666j, 0.26425551745 + 0.342483846503j,
        0.126010863922 + 0.864590917688j, 0.179560356712 + 0.8709166566j,
    ])  # fmt: skip
    products = np.array([
        0.496254299764 + 0.546020011741j, 0.958341609741 + 0.847442419999j, 0.964759562277 + 0.71397074519j,
        0.706319991205 + 0.120097702053j, (0.148939301127 + 0.182393186752j) / (0.391154215376 + 0.128900893182j),
    ])  # fmt: skip
    offsets = np.array([
        0, 0.984138451804 + 0.414967172346j, 0.353268870498 + 0.389909226888j, 0.204379350351 + 0.00374294529684j,
        0.907681632783 + 0.405209293447j,
    ])  # fmt: skip
    sixth = np.array([
        0.352598136811 + 0.116888144319j, 0.539042485525 + 0.687058436892j, 0.391154215376 + 0.128900893182j,
    ])  # fmt: skip
    place = np.array([
        0.437312713588 + 0.914780691357j, 0.719086796333 + 0.691791591267j,
        0.64863071126 - 0.983034576618j + offsets[1] * cosines[0],
    ])  # fmt: skip
    norm = np.sqrt(sixth @ sixth)  # the print's sixth axis is no unit vector
    sixth, cosines[4], products[4] = sixth / norm, cosines[4] / norm, products[4] * norm

    def link(offset, product, cosine):
        sine, frame = np.sqrt(1 - cosine**2), np.eye(4, dtype=complex)
        frame[1:3, 1:3] = [[cosine, -sine], [sine, cosine]]
        frame[0, 3], frame[2, 3] = product * sine, offset
        return frame

    hand = np.eye(4, dtype=complex)
    across = np.cross(sixth, [1, 2, 3])
    across /= np.sqrt(across @ across)
    hand[:3] = np.column_stack([across, np.cross(sixth, across), sixth, place])
    tree, held, _ = _held(loop("RRRRRRR"), np.zeros(1))
    structure, real = structure_of(tree, held)
    frames = {(k + 2, k + 2): link(*row) for k, row in enumerate(zip(offsets, products, cosines, strict=True))}
    frames[6, 0] = hand
    dimensions = np.array([frames.get(what, np.eye(4)) for what in structure.dimension])
    ends, _ = _all_ends(structure, _generic(structure, 16), ComplexDimensions(dimensions, real.lengths, real.given))
    assert ends.number == len(IPP2) == 16
    second = ends.frames[:, structure.dimension.index((2, 2)), 0, 2]
    apart = abs(second[:, None] - IPP2)
    assert max(apart.min(axis=0).max(), apart.min(axis=1).max()) < 1e-8


# puma: A. Morgan, V. Shapiro, ACM Transactions on Mathematical Software 13 (1987) 152-167; cosines and sines of the
# turns 1, 2 and 5 and the sine of turn 4 in 4 of 16 solutions. In the others the pair of sines 4 and 5 has the other
# sign; and the cosine of turn 4, which stands in no equation but its square, has both signs.
PUMA = [
    (0.164431666, -0.986388477, 0.239616017, -0.970867738, 0.068728540, -0.615508407, -0.788130320),
    (0.164431666, -0.986388477, -0.954728434, 0.297478766, -0.412064240, 0.991322415, 0.131452917),
    (0.671554262, 0.740955379, -0.239611659, -0.970868813, -0.287044989, -0.527909026, 0.849300924),
    (0.671554262, 0.740955379, 0.954729770, 0.297474481, 0.991673416, 0.969311808, -0.245834536),
]


def test_the_puma_has_eight_poses_of_its_arm_all_of_them_in_print():
    """Upper arm and forearm 1, offset 0.3461; the print has four digits of the hand's place and direction."""
    hand, way, offset = np.array([0.2238, 0.7623, 0.6734]), np.array([0.004731, -0.3578, 0.9338]), 0.3461
    c1, s1, c2, s2 = PUMA[0][:4]
    shoulder, upper = np.array([-s1, c1, 0]), np.array([c1 * c2, s1 * c2, -s2])
    fore = hand - offset * shoulder - upper
    across = np.cross(fore, way)
    axes = [
        ((0, 0, 0), (0, 0, 1)), ((0, 0, 0), shoulder), (upper, shoulder), (hand, fore), (hand, across), (hand, way),
        ((2, 1, 0), (1, 2, 3)),
    ]  # fmt: skip
    text = "R(base-1) R(1-2) R(2-3) R(3-4) R(4-5) R(5-hand) R(base-hand); drive=R(base-hand)"
    places = {k: {"at": at, "z": z} for k, (at, z) in enumerate(axes)}
    modes = assembly_modes(SpatialLinkage(Mechanism.parse(f"spatial: {text}"), places), 0.0)
    assert (len(modes), modes.number, modes.far, modes.exact) == (8, 8, 8, True)
    turned = {
        link: modes.pose(link)[:, :3, :3] @ axis / np.linalg.norm(axis)
        for link, axis in (("1", shoulder), ("2", upper), ("3", fore), ("4", across))
    }
    (x, y, _), (a, b, c) = turned["1"].T, turned["2"].T
    third = np.cross(turned["4"], turned["3"])
    fourth = np.sum(third * turned["1"], axis=1)
    found = np.array([y, -x, a * y - b * x, -c, fourth, turned["3"] @ way, third @ way]).T
    printed = np.concatenate([PUMA, PUMA * np.array([1, 1, 1, 1, -1, 1, -1])])
    apart = abs(found[:, None] - printed).max(axis=2)
    assert max(apart.min(axis=0).max(), apart.min(axis=1).max()) < 5e-3


# assur44, the Assur group (4.4): S. Lösch, Computational Kinematics '95, 251-260; cosine and sine of the turns of the
# first leg and of the link on it in the real ones of 56 solutions.
ASSUR44 = [
    (-0.977860427, -0.209258181, 0.914737876, -0.404047792), (-0.979613920, 0.200889444, 0.257676872, -0.966231147),
    (0.358595713, 0.933492964, 0.999338734, -0.036360608), (0.528706473, 0.848804727, 0.911152958, -0.412068303),
    (0.183623523, 0.982996644, 0.997778851, -0.066613551), (-0.982669374, 0.185366937, 0.968751128, -0.248034781),
    (-0.779399916, 0.626526752, 0.615891154, -0.787831255), (0.284180623, -0.958770762, 0.528629679, -0.848852556),
    (-0.999997666, 0.002160637, 0.359180021, -0.933268296), (-0.043000904, -0.999075033, 0.598897409, -0.800825757),
]  # fmt: skip


def test_the_group_4_4_has_the_56_solutions_of_its_equations_the_real_ones_as_printed():
    """Four links in a ring and four legs; from the coefficients all dimensions are whole or half numbers.

    The reference pose is the first solution, its turns 3 and 4 with the digits of the print.
    """
    first, second = complex(-0.977860426545852, -0.209258180713597), complex(0.914737876096504, -0.404047791770301)
    third, fourth = complex(-0.758913082700779, 0.651191932463541), complex(0.981805885815237, 0.189887341807078)
    start = 2 * first
    left, right = start + second * (-4 + 3j), start + second * (2 + 3j)
    ring = left + 5 * second * third, right - 7 * second / fourth
    ends = [
        start, left + second * third * (2 + 2j), ring[0] + (5 + 10j) / 7 * (ring[1] - ring[0]),
        right + second / fourth * (-2 + 4j),
    ]  # fmt: skip
    feet = [0, -6, -4 + 9j, 7 + 7.5j]
    assert abs(ring[0] - ring[1]) == pytest.approx(3.5, abs=1e-14)
    assert abs(np.subtract(ends, feet)) == pytest.approx([2, 5, 3, 5.5], abs=1e-13)
    legs = " ".join(f"R(base-l{k})" for k in range(4)) + " " + " ".join(f"R(l{k}-m{k})" for k in range(4))
    mechanism = Mechanism.parse(f"planar: {legs} R(m0-m1) R(m1-m2) R(m2-m3) R(m3-m0); frame=base")
    places = {k: (z.real, z.imag) for k, z in enumerate(map(complex, [*feet, *ends, left, *ring, right]))}
    modes = assembly_modes(SpatialLinkage(mechanism, places), [])
    assert (len(modes), modes.number, modes.exact) == (10, 56, True)

    def turn(link, start):
        return modes.pose(link)[:, 0, :2] @ [1, -1j] * start

    found = np.stack([turn("l0", first), turn("m0", second)], axis=1).view(float)
    apart = abs(found[:, None] - ASSUR44).max(axis=2)
    assert max(apart.min(axis=0).max(), apart.min(axis=1).max()) < 1e-8
