"""The paper: all its numbers come from docs/tables, its figures from a command."""

import re

import pytest

from paper import fill


def test_no_number_of_a_table_is_typed():
    """Outside what is filled in and the references no number has five digits, nor a separator of thousands."""
    text, _, references = fill.MANUSCRIPT.read_text(encoding="utf-8").partition("## References")
    assert references
    assert re.findall(r"\d[\d,]*,\d{3}|\d{5,}", fill.NUMBER.sub("", text).replace("A233288", "")) == []


def test_every_number_is_that_of_a_table():
    """Some of them as they stand in print: A233288, Peisach 2007, Rojas and Thomas 2011."""
    text = fill.filled(fill.MANUSCRIPT.read_text(encoding="utf-8"))
    assert "{{" not in text
    for row in ("| 14 | 318,162 |", "| 18 | 1,535,380,884 |", "| 8 | 173 |", "| 7 | 3 | 14 | 18 | 48 |"):
        assert row in text
    with pytest.raises(ValueError, match="no row of chains"):
        fill.filled("{{chains mobility=1 links=21 | chains}}")


def test_the_paper_is_made_with_its_figures(tmp_path):
    fill.main(tmp_path)
    text = (tmp_path / "paper.md").read_text(encoding="utf-8")
    named = re.findall(r"\]\((\d\.svg)\)", text)
    assert named == sorted(path.name for path in tmp_path.glob("*.svg")) == ["1.svg", "2.svg"]
    assert all((tmp_path / name).read_text(encoding="utf-8").startswith("<svg") for name in named)
