"""Collection sheet 001: every printed number, and the laws behind it."""

from __future__ import annotations

import re
from math import acos, degrees, sqrt

import numpy as np

from gruebler.mechanics.geometry import cognate_sizes
from gruebler.mechanics.geometry.meyer_zur_capellen import lambdas_for, symmetric_rocker
from gruebler.mechanics.kinematics import move
from gruebler.teaching.catalog import entry
from gruebler.teaching.sheets import sheet
from tests.documents import independent as own
from tests.documents.fact import Fact, on_sheet

KAPPA = degrees(acos(5 * sqrt(3) / 9))
LEVER = own.lever(5 / 6)
PHI_G, PHI_A, RATIO, UNIT = own.sheet_example()
ROOT = sqrt(2) * sqrt(3) / 4


def cosine_at_frame(phi: float) -> float:
    """The cosine of the angle A B0 B."""
    a, b = own.four_bar(1, 2.5 * sqrt(3), 2.5 * sqrt(3), 4, phi)
    return float(np.cos(np.angle((a - 4) / (b - 4))))


def _features() -> list[int]:
    page = sheet("mzc").features
    return [
        page.drive_joints,
        page.drive_joints_at_frame,
        page.output_links,
        page.output_links_at_frame,
        page.links,
        dict(page.links_by_joints)[2],
        page.joints,
        dict(page.by_symbol("german"))["D"],
    ]


PHASES = range(0, 360, 24)


def _path_of_k() -> list[complex]:
    motion = move(entry("mzc").linkage(), np.radians(PHASES))
    return [complex(*place) for place in motion.point("K")]


def _mirrored_path() -> list[complex]:
    """The path mirrored at the axis: at crank angles phi and 360 - phi K stands on both sides of it."""
    axis = complex(np.exp(1j * np.radians(90 + KAPPA)))
    return [4 + axis * ((place - 4) / axis).conjugate() for place in _path_of_k()]


def _similarity() -> list[float]:
    by_id = {row.id: row.derived for row in sheet("mzc").quantities}
    pairs = (("l1_star", "l1_prime"), ("l2_star", "l2_prime"), ("l4_star", "l4_prime"), ("k_star", "k_prime"))
    return [by_id[star] / by_id[prime] for star, prime in pairs]


def _second_cognate() -> list[float]:
    """a, b, c, d of the third four-bar of Roberts, crank where the original has its rocker."""
    long = 2.5 * sqrt(3)
    kappa = np.radians(KAPPA)
    sizes = cognate_sizes(1, long, long, 4, 25 / 3 * np.cos(kappa), 25 / 3 * np.sin(kappa))
    return [float(letter[2]) for letter in (sizes.a, sizes.b, sizes.c, sizes.d)]


def _lever(ratio: float) -> list[float]:
    """phi0, l1', l2', l4', k' and kappa of Meyer zur Capellen's linkage for D = 1."""
    rocker = symmetric_rocker(ratio)
    lever = rocker.lever
    size = lever.size
    return [degrees(rocker.phi0), size.a, size.b, size.d, lever.k, degrees(lever.kappa)]


FACTS = [
    Fact(
        place="001",
        states="1 drive joint, 1 at the frame; 1 output link, 0 there; 4 links, 4 binary; 4 joints, 4 turning",
        derive=_features,
        value=[1, 1, 1, 0, 4, 4, 4, 4],
        subject="mzc",
    ),
    *(
        on_sheet(key, f"length {key}", value=value)
        for key, value in (
            ("l₁", 1.0),
            ("l₂", 2.5 * sqrt(3)),
            ("l₃", 2.5 * sqrt(3)),
            ("l₄", 4.0),
            ("k", 25 / 3),
            ("l", 2.5 * sqrt(3)),
        )
    ),
    on_sheet("kappa", "κ = angle BAK", "15.79", KAPPA),
    on_sheet("cos_kappa", "cos κ = 5/9 √3", value=5 / 9 * sqrt(3)),
    on_sheet("near", "B0 K_I = 10/3 √6", "8.165", 10 / 3 * sqrt(6)),
    Fact(
        place="001",
        states="the path of K",
        derive=_path_of_k,
        value=[own.replacement_point(phi) for phi in PHASES],
        subject="mzc",
    ),
    Fact(
        place="001",
        states="the path of K is symmetric to an axis through B0 that leans by κ against the perpendicular",
        derive=_mirrored_path,
        value=[own.replacement_point(360 - phi) for phi in PHASES],
        subject="mzc",
    ),
    on_sheet("h", "h = 1/3 √2 (5 √11 - 9 √3)", "0.469", sqrt(2) / 3 * (5 * sqrt(11) - 9 * sqrt(3))),
    on_sheet("cos_psi_near", "cos ψ_I = √3/3, printed as ψ_II", value=cosine_at_frame(180)),
    on_sheet("cos_psi_far", "cos ψ_II = √3/5", value=cosine_at_frame(0)),
    on_sheet("contact", "the tangent in K_I meets the curve in six points", "6", 6.0),
    on_sheet("phi_G", "φ_G for Q_G = 0.005", "163.3", PHI_G, near=1e-7),
    on_sheet("phi_A", "φ_A for Q_G = 0.005", "98.3", PHI_A, near=1e-7),
    on_sheet("ratio", "L/l1 for Q_G = 0.005", "3.91", RATIO, near=1e-7),
    on_sheet("scale", "l1 in cm for L = 15 cm", "3.84", UNIT, near=1e-7),
    on_sheet("l1_star", "first cognate: l1* = l3* = 25/3", value=25 / 3),
    on_sheet("l2_star", "first cognate: l2* = 10/9 √3", value=10 / 9 * sqrt(3)),
    on_sheet("k_star", "first cognate: k* = l* = 1", value=1.0),
    on_sheet(
        "l4_star",
        "first cognate: l4* is printed as 40/3 √3",
        "23.094",
        40 / 9 * sqrt(3),
        misprint="40/3 √3 = 23.094 is longer than the other three links together; 40/9 √3 closes and is similar to l4'",
    ),
    Fact(
        place="001",
        states="the second cognate is a crank-rocker of the same sizes, driven at the other pivot",
        derive=_second_cognate,
        value=[2.5 * sqrt(3), 2.5 * sqrt(3), 1.0, 4.0],
    ),
    Fact(
        place="001",
        states="literature: two papers with year and issue",
        derive=lambda: [re.search(r"(\d{4})\) (\d+)", line).groups() for line in sheet("mzc").record.literature],  # type: ignore[union-attr]
        value=[("1992", "11"), ("1956", "12")],
        subject="mzc",
    ),
    Fact(
        place="001",
        states="the cognate is similar to the linkage of λ = 5/6",
        derive=_similarity,
        value=[25 / 3 / LEVER["l1"]] * 4,
        subject="mzc",
    ),
    on_sheet("phi0_prime", "φ0 for λ = 5/6", "54.74", LEVER["phi0"]),
    on_sheet("sin_phi0", "sin φ0 = √(2/3)", value=sqrt(2 / 3)),
    on_sheet("l1_prime", "l1' = 25/3 · 1/4 √2 √3 D", value=25 / 3 * ROOT),
    on_sheet("l2_prime", "l2' = 10/9 √3 · 1/4 √2 √3 D", value=10 / 9 * sqrt(3) * ROOT),
    on_sheet("l4_prime", "l4' = 40/9 √3 · 1/4 √2 √3 D", value=40 / 9 * sqrt(3) * ROOT),
    on_sheet("k_prime", "k' = l' = 1/4 √2 √3 D", value=ROOT),
    on_sheet("tan_kappa", "tan κ = √2/5", value=sqrt(2) / 5),
    *(
        Fact(
            place="001",
            states=f"l1', l2', l4', k', κ from λ = {ratio:g} and sin² φ0 = (1 + 2 λ)/4 by Euler and Savary",
            derive=lambda ratio=ratio: _lever(ratio),
            value=list(own.lever(ratio).values()),
        )
        for ratio in (0.7, 0.75, 5 / 6, 1.2)
    ),
    *(
        Fact(
            place="001",
            states=f"λ for κ = {kappa}° from λ² (3 - 2 λ) = 1/(1 + tan² κ)",
            derive=lambda kappa=kappa: sorted(lambdas_for(np.radians(kappa))),
            value=own.lambdas(kappa),
        )
        for kappa in (5, 20, 30)
    ),
]
