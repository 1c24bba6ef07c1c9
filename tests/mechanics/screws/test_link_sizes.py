"""Sizes of links in space, against what was drawn."""

import pytest

from gruebler.mechanics.screws.link_sizes import link_sizes
from gruebler.teaching.catalog import entry


def test_axes_that_meet_in_a_drawing_with_twelve_digits_are_not_apart():
    """Both ends of the shaft of 300 mm are bent by 30 degrees to the same side: parallel, 300 sin 30 = 150 mm apart."""
    sizes = {size.link: size for size in link_sizes(entry("cardan_shaft").placed())}
    assert [sizes[link].distance for link in ("input", "output")] == [0.0, 0.0]
    assert sizes["shaft"].distance == pytest.approx(300)
    assert (sizes["frame"].distance, sizes["frame"].angle) == (pytest.approx(150), pytest.approx(0, abs=1e-6))
