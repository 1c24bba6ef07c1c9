"""Messages: one line of bounded length, whatever they quote."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gruebler import Chain, FourBar, GrueblerError, circuit, draw, measures, move
from gruebler.base.errors import LONGEST, LinkageError, NotationError, near_words, shortened
from gruebler.base.text import error_in_language
from gruebler.files import linkage_from_json


@given(st.text(), st.integers(0, 3000), st.sampled_from(["a", "a ", "\n", "ä\n "]))
def test_messages_are_one_line_of_bounded_length(text, number, more):
    made = shortened(text + more * number + text)
    assert len(made) <= LONGEST
    assert "\n" not in made
    assert shortened(made) == made


@given(st.text(st.characters(blacklist_categories=["Z", "Cc", "Cf", "Cs"]), max_size=300))
def test_short_messages_are_left_as_they_are(text):
    assert str(GrueblerError(text)) == text


def test_the_ends_of_a_long_message_are_kept():
    error = GrueblerError("file.toml: unknown key {key!r}; did you mean 'unit'?", key="k" * 10_000)
    assert str(error).startswith("file.toml: unknown key 'kkk")
    assert str(error).endswith("kkk'; did you mean 'unit'?")
    assert "(10,003 characters)" in str(error)
    assert len(error_in_language(error, "de")) < 400


def test_long_input_is_quoted_in_short():
    with pytest.raises(NotationError) as caught:
        Chain.parse("g6:" + "C" * 10**6)
    assert len(str(caught.value)) < 400
    with pytest.raises(LinkageError) as caught:
        linkage_from_json({"k" * 10_000: 1})
    assert len(str(caught.value)) < 1000


def values():
    linkage = FourBar(a=25, b=70, c=40, d=70).linkage()
    motion = move(linkage, np.linspace(0, 6, 361), speed=1.0)
    found = circuit(linkage)
    yield from (motion, motion.plan, found, found.samples, measures(linkage), draw(linkage.mechanism))


@pytest.mark.parametrize("value", list(values()), ids=lambda value: type(value).__name__)
def test_large_values_are_printed_in_one_line(value):
    text = repr(value)
    assert text.startswith(f"<{type(value).__name__} ")
    assert "\n" not in text
    assert len(text) < 1200


def test_a_motion_in_an_error_is_one_line():
    motion = move(FourBar(a=25, b=70, c=40, d=70).linkage(), np.linspace(0, 6, 361))
    with pytest.raises(LinkageError, match=r"but found <Motion linkage=") as caught:
        circuit(motion)
    assert len(str(caught.value)) < 500


@pytest.mark.parametrize(
    ("word", "known", "near"),
    [
        ("foo", ["hood"], []),
        ("foo", ["food", "hood"], ["food"]),
        ("rid", ["rod"], ["rod"]),
        ("laed", ["lead"], ["lead"]),
        ("cat", ["cam"], ["cam"]),
        ("cat", ["dog"], []),
        ("cycloid", ["cycloidal"], ["cycloidal"]),
        ("dead", ["dead-centres"], ["dead-centres"]),
        ("HH", ["H"], ["H"]),
        ("sphere", ["spatial", "spherical"], ["spherical"]),
        ("", ["rod"], []),
    ],
)
def test_a_suggestion_differs_in_a_third_of_the_letters_at_most(word, known, near):
    assert near_words(word, known) == near
