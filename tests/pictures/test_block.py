"""The block picture: what goes in and what comes out agrees with the access features of every machine."""

import pytest

from gruebler.pictures.canvas.shapes import Point, Polylines, TextShape
from gruebler.pictures.structure import draw_block
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entries
from gruebler.teaching.catalog.feature_query import entry_mechanism
from gruebler.teaching.catalog.features import access_features


def texts(figure):
    return [shape.text for shape in figure.shapes if isinstance(shape, TextShape)]


@pytest.mark.parametrize("id", [id for id, entry in entries().items() if entry.frame is not None])
def test_every_machine(id):
    entry = entries()[id]
    mechanism = entry_mechanism(entry)
    figure = draw_block(mechanism, outputs=entry.outputs, name=entry.name.en)
    words = texts(figure)
    features = access_features(mechanism, entry.outputs)
    assert entry.name.en in words
    turning = sum(drive.turning for drive in mechanism.drives)
    assert any(("φ" in word and "=" not in word) for word in words) is (turning > 0)
    assert any(("s_e" in word and "=" not in word) for word in words) is (turning < len(mechanism.drives))
    guided = features.output_links > features.output_links_at_frame
    assert any("guided motion" in word for word in words) is guided
    boxes = [shape for shape in figure.shapes if isinstance(shape, Polylines) and shape.style == "area"]
    assert len(boxes) == 3
    for shape in figure.shapes:  # nothing lies outside
        for part in shape.parts if isinstance(shape, Polylines) else [[shape.at]]:
            assert all(0 <= at.x <= figure.width and 0 <= at.y <= figure.height for at in map(Point._make, part))


def test_without_outputs_and_with_two_drives():
    five = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(4-0); frame=0; drive=R(0-1); drive=R(4-0)")
    words = texts(draw_block(five, outputs=["2"], lang="de"))
    assert "φ₁, φ₂" in words
    assert "1 und 4" in words
    assert texts(draw_block(five))[:1] == ["drive"]
