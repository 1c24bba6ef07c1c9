"""Gear trains from the side: every axis, shaft, wheel and carrier is there, and no shaft lies on another one."""

from itertools import combinations

import pytest

from gruebler.base.errors import GrueblerError
from gruebler.cli import main
from gruebler.pictures.canvas.shapes import CircleShape, Polylines, TextShape
from gruebler.pictures.structure import draw_side_view
from gruebler.structure.chain import Chain
from gruebler.structure.enumeration import epicyclic_trains
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entries

TRAINS = [train for links in (4, 5, 6) for train in list(epicyclic_trains(links))[::2]]


def lines(figure, style):
    return [
        part for shape in figure.shapes if isinstance(shape, Polylines) and shape.style == style for part in shape.parts
    ]


def test_everything_of_a_train_is_drawn():
    for train in TRAINS:
        chain = train.chain()
        figure = draw_side_view(chain)
        carriers = [link for link in range(train.links) if sum(link in axis for axis in train.axes) > 1]
        hubs = sum(sum(link in axis for axis in train.axes) for link in carriers)
        axes = lines(figure, "pitch")
        assert len({start.y for start, _ in axes}) == len(axes) == len(train.axes)
        assert len(lines(figure, "rail")) == len({*wheel_places(train)} | {*carrier_places(train)})
        assert len(lines(figure, "edge")) == 4 * len(train.gears) + len(carriers)
        dots = [shape.at for shape in figure.shapes if isinstance(shape, CircleShape)]
        assert len(dots) == len(set(dots)) == 2 * len(train.gears) + hubs
        names = sorted(shape.text for shape in figure.shapes if isinstance(shape, TextShape))
        expected = [str(link) for a, b, _ in train.gears for link in (a, b)] + [str(link) for link in carriers]
        assert names == sorted(expected)


def carrier_places(train):
    """Links on two axes or more, with each of these."""
    return [
        (link, axis) for link in range(train.links) for axis in train.axes
        if link in axis and sum(link in each for each in train.axes) > 1
    ]  # fmt: skip


def wheel_places(train):
    """The wheels of all pairs with their axes: that which holds the carrier too."""
    return [
        (wheel, next(axis for axis in train.axes if {wheel, carrier} <= set(axis)))
        for a, b, carrier in train.gears
        for wheel in (a, b)
    ]


def test_shafts_and_wheels_keep_apart():
    for train in TRAINS:
        figure = draw_side_view(train.chain())
        shafts = [(start.y, start.x, end.x) for start, end in lines(figure, "rail")]
        for (y, left, right), (other, low, high) in combinations(shafts, 2):
            assert y != other or right < low or high < left
        rims = [part for part in lines(figure, "edge") if part[0].y == part[1].y]
        assert len(rims) == 2 * len(train.gears)
        upper = sorted((start.x, start.y) for start, _ in rims)
        for (x, y), (to_x, to_y) in zip(upper[::2], upper[1::2], strict=True):
            assert (to_x, to_y) == pytest.approx((x, y + 3.6))  # the two rims of a pair lie beside each other


def test_long_names_have_room_and_the_frame_is_hatched():
    chain = Chain.parse("R(sun-ring-carrier) R(carrier-planet) G(sun-planet) G(planet-ring)")
    narrow = draw_side_view(chain.renamed({"sun": "s", "ring": "r", "carrier": "c", "planet": "p"}))
    wide = draw_side_view(Mechanism(chain, "ring"))
    assert wide.width > narrow.width
    assert lines(wide, "hatch")
    assert not lines(narrow, "hatch")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("R(0-1) R(1-2) R(2-3) R(3-0)", "a side view shows planar gear trains"),
        ("R(0-1) R(0-2) R(0-3) P(1-2) G(2-3)", "a side view shows planar gear trains"),
        ("spherical: R(0-1) R(0-2) G(1-2)", "a side view shows planar gear trains"),
        ("R(0-1) R(1-2) R(2-3) R(3-4) G(0-4)", "the wheels 0 and 4 of .* have no common carrier"),
    ],
)
def test_what_is_no_train_is_refused(text, words):
    with pytest.raises(GrueblerError, match=words):
        draw_side_view(Chain.parse(text))


def test_bearings_of_one_axis_are_drawn_as_one():
    """Central wheels and carrier in bearings of their own: the distances of the wheels make these coaxial."""
    for id, together in (
        ("diff", "R(frame-sun-ring_gear-carrier) R(carrier-planet) G(sun-planet) G(ring_gear-planet)"),
        ("diff2p", "R(frame-sun-ring_gear-carrier) R(carrier-planet1) R(carrier-planet2) G(sun-planet1) "
         "G(ring_gear-planet1) G(sun-planet2) G(ring_gear-planet2)"),
    ):  # fmt: skip
        apart = draw_side_view(Mechanism(entries()[id].chain(), "frame"))
        assert len(lines(apart, "pitch")) == 1 + together.count("(carrier-")
        assert len(lines(apart, "edge")) == 4 * together.count("G(") + 1
        expected = draw_side_view(Mechanism(Chain.parse(together), "frame"))
        assert sorted(map(str, lines(apart, "edge"))) == sorted(map(str, lines(expected, "edge")))
    swapped = draw_side_view(Chain.parse("R(0-1) R(0-2) R(2-3) R(0-4) G(1-3) G(3-4)"))
    assert len(lines(swapped, "pitch")) == 2


def test_commands(tmp_path, capsys):
    train = "R(0-1-3) R(2-3) G(0-2) G(1-2)"
    assert main(["draw", train, "--side", "--frame", "0", "-o", str(tmp_path / "train.svg")]) == 0
    assert main(["gallery", "--side", train, "geartrain", "-o", str(tmp_path / "trains.html")]) == 0
    assert (tmp_path / "trains.html").read_text(encoding="utf-8").count("<svg") == 2
    capsys.readouterr()
    for words in (["gallery", "--side", "--links", "6"], ["gallery", "--side", "--labels", train]):
        assert main([*words, "-o", str(tmp_path / "x.html")]) == 2
        assert "--side" in capsys.readouterr().err
