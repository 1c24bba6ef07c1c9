"""What is said of a bad or special task: one sentence in each language; of infinitely many solutions, which family."""

import numpy as np
import pytest

from gruebler.base.errors import SynthesisError
from gruebler.base.text import error_in_language
from gruebler.design.synthesis import (
    DeadCentreTask,
    Demands,
    FunctionLaw,
    FunctionTask,
    PathTask,
    PositionTask,
    function_task,
    synthesise,
)
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics import move

CIRCLE = [(np.cos(k / 3), np.sin(k / 3), k / 3) for k in range(5)]
LINE = [(k, 2 * k, 0) for k in range(5)]
ON_A_CIRCLE = [(6, 2, 0.4), (1, 7, 0.4), (-4, 2, 0.4), (1, -3, 0.4)]


def equal_points():
    return PathTask([(0, 0), (1, 1), (0, 1e-12)])


def equal_positions():
    return PositionTask([(0, 0, 0), (1, 1, 1), (0, 0, 2 * np.pi)])


def turned_back():
    return PathTask([(0, 0), (1, 1), (2, 1)], crank_angles=(0, 0.5, 0.4))


def too_long():
    return PathTask([(0, 0), (1, 1), (2, 1)], crank_angles=(0, 4, 7))


@pytest.mark.parametrize(
    ("make", "english", "german"),
    [
        (equal_points, "points 1 and 3 are equal", "die Punkte 1 und 3 sind gleich"),
        (equal_positions, "positions 1 and 3 are equal", "die Lagen 1 und 3 sind gleich"),
        (
            lambda: synthesise(PositionTask(LINE[:3])),
            "inclined by 63.4349°: one slide there passes all positions",
            "auf einer um 63,4349° geneigten Geraden: Ein Schieber auf ihr durchläuft alle Lagen",
        ),
        (
            lambda: synthesise(PositionTask(CIRCLE), six_bars=True),
            "turns about (0, 0): a link on one pivot there passes them",
            "Drehungen um (0; 0): Ein dort drehbar gelagertes Glied durchläuft sie",
        ),
        (
            lambda: synthesise(PositionTask(ON_A_CIRCLE)),
            "on a circle about (1, 2): every parallelogram with cranks of length 5",
            "auf einem Kreis um (1; 2): Jedes Parallelogramm mit Kurbeln der Länge 5",
        ),
        (
            lambda: synthesise(PositionTask([*ON_A_CIRCLE, (0, 0, 0.4)])),
            "its places lie on no circle: no four-bar passes them",
            "doch seine Orte liegen auf keinem Kreis: Kein Viergelenkgetriebe durchläuft sie",
        ),
        (
            lambda: synthesise(PositionTask([*ON_A_CIRCLE[:2], (0, 0, 1), ON_A_CIRCLE[2]])),
            "positions 1, 2 and 4 have the same angle",
            "die Lagen 1, 2 und 4 haben denselben Winkel",
        ),
        (
            lambda: synthesise(PathTask([p[:2] for p in [*LINE, (5, 10, 0), (6, 12, 0), (7, 1, 0), (9, 2, 0)]])),
            "7 of the points lie on one line",
            "7 der Punkte liegen auf einer Geraden",
        ),
        (turned_back, "the timing is contradictory, the crank has to turn one way", "Die Zuordnung widerspricht sich"),
        (too_long, "all points lie within one turn", "innerhalb einer Umdrehung"),
        (
            lambda: FunctionLaw("log10(x", interval=(1, 2), input_swing=1, output_swing=1),
            "cannot be read",
            "ist nicht lesbar",
        ),
        (
            lambda: FunctionLaw("sine(x)", interval=(1, 2), input_swing=1, output_swing=1),
            "unknown name 'sine'",
            "unbekannter Name 'sine'",
        ),
        (
            lambda: FunctionLaw("log10(x)", interval=(-1, 1), input_swing=1, output_swing=1),
            "is not defined everywhere",
            "nicht überall definiert",
        ),
        (
            lambda: function_task(FunctionLaw("x", interval=(0, 1), input_swing=1, output_swing=1), 12),
            "expected 2 to 11",
            "2 bis 11 Genauigkeitspunkte",
        ),
        (lambda: FunctionTask([0, 0.5, 0.5], outputs=[1, 2, 3]), "inputs 2 and 3 are equal", "sind gleich"),
        (
            lambda: FunctionTask([0, 0.5], outputs=[1, 2, 3]),
            "as many inputs as outputs",
            "gleich viele Antriebs- und",
        ),
        (
            lambda: synthesise(FunctionTask([0, 0.1, 0.2, 0.3], outputs=[1, 2, 3, 4])),
            "leave a start free",
            "Anfangswert frei lassen",
        ),
        (
            lambda: DeadCentreTask(swing=1, stroke=2, time_ratio=1),
            "one of swing and stroke",
            "genau eine Angabe von swing und stroke",
        ),
        (lambda: DeadCentreTask(swing=1), "crank_angle and time_ratio, but found none", "aber keine gefunden"),
        (lambda: synthesise(DeadCentreTask(swing=1, crank_angle=1)), "no crank-rocker", "keine Kurbelschwinge"),
    ],
)
def test_bad_input_is_one_sentence_in_each_language(make, english, german):
    with pytest.raises(SynthesisError) as raised:
        make()
    for lang, sentence in (("en", english), ("de", german)):
        text = error_in_language(raised.value, lang)
        assert sentence in text
        assert "\n" not in text


def said(result):
    """All notes and reasons of a result, by language."""
    texts = [*result.notes, *(reason for design in result.rejected for reason in design.verdict.reasons)]
    return {lang: " ".join(text.in_language(lang) for text in texts) for lang in ("en", "de")}


@pytest.mark.parametrize(
    ("count", "english", "german"),
    [
        (2, "Every point of the body and every point of the frame", "jeder Punkt des Gestells"),
        (3, "Every point of the body is the pivot of one dyad", "Gelenkpunkt eines Zweischlags"),
        (4, "Burmester's cubics", "Kreispunkt- und Mittelpunktkurve"),
    ],
)
def test_families_of_infinitely_many_solutions_are_named(count, english, german):
    rows = [(0, 0, 0), (1, 0.5, 0.3), (2, 0.4, 0.8), (2.5, -0.2, 1.1)][:count]
    texts = said(synthesise(PositionTask(rows), number=4))
    assert english in texts["en"]
    assert german in texts["de"]


@pytest.mark.parametrize(
    ("count", "free", "theorem", "sentence"),
    [
        (2, 0, 1, "infinitely many four-bars besides, a family of dimension 1: 3 pairs determine them"),
        (2, 1, None, "a family of dimension 2: give more pairs"),
        (2, 2, None, "a family of dimension 3"),
        (3, 1, 1, "infinitely many four-bars besides, a family of dimension 1: 4 pairs determine them"),
        (3, 2, None, "one for each point of the plane"),
        (4, 2, None, "one for each point of a curve"),
    ],
)
def test_families_of_functions_are_named(count, free, theorem, sentence):
    task = FunctionTask(
        (0.3, 0.7, 1.2, 1.5)[:count],
        outputs=(0.4, 0.9, 1.1, 1.3)[:count],
        output="angle",
        start_input=free < 1,
        start_output=free < 2,
    )
    result = synthesise(task, number=4)
    assert result.count.theorem == theorem
    assert sentence in said(result)["en"]


def test_a_region_without_solutions_gives_the_reason_in_each_language():
    motion = move(FourBar(1, 3, 2.5, 3.5).linkage({"P": (1.2, 0.8)}), np.radians([10.0, 35, 60, 85, 110]))
    rows = [(*p, a) for p, a in zip(motion.point("P"), motion.angle("coupler"), strict=True)]
    result = synthesise(PositionTask(rows), demands=Demands(region=(10, 10, 20, 20)))
    assert not result.designs
    (design,) = result.rejected
    assert [reason.in_language("en") for reason in design.verdict.reasons] == ["a fixed pivot lies outside the region"]
    assert said(result)["de"].endswith("ein Gestellpunkt liegt außerhalb des Bereichs")
    reasons = {"en": "a fixed pivot lies outside the region", "de": "ein Gestellpunkt liegt außerhalb des Bereichs"}
    assert {lang: text.endswith(reasons[lang]) for lang, text in said(result).items()} == {"en": True, "de": True}


def test_points_that_are_added_are_named_beside_their_count():
    """The count and the note agree: no number by theorem, the points that were added, the solutions with them."""
    result = synthesise(PathTask([(0, 0), (1, 0.6), (2, 0.8), (3, 0.6)], angles=[0, 0.2, None, 0.5]))
    assert result.count.theorem is None
    added = "points on a smooth curve through the given ones were added (3); with them there are 201"
    assert added in said(result)["en"]
