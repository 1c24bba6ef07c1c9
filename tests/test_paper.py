"""The paper: all its numbers come from docs/tables, its figures from a command."""

import re
import tomllib
from pathlib import Path

import pytest

import gruebler
from paper import fill

ROOT = Path(__file__).parents[1]


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


JOSS = ROOT / "paper" / "joss"


def test_the_paper_for_joss_cites_what_it_lists():
    """Every reference is cited and has its doi; the length is what the journal asks for, 750 to 1750 words."""
    head, text = (JOSS / "paper.md").read_text(encoding="utf-8").split("\n---\n")
    listed = re.findall(r"^@\w+\{(\w+),\n(.*?)^\}", (JOSS / "paper.bib").read_text(encoding="utf-8"), re.M | re.S)
    assert {key for key, _ in listed} == set(re.findall(r"@(\w+)", text))
    assert [key for key, record in listed if not re.search(r"doi\s+= \{10\.\d{4,}/\S+\}", record)] == []
    assert 750 <= len(text.split()) <= 1750
    assert "bibliography: paper.bib" in head
    sections = [line.removeprefix("# ") for line in text.splitlines() if line.startswith("# ")]
    assert {"Summary", "Statement of need", "State of the field", "Software design"} <= set(sections)


def test_the_recipe_for_conda_asks_for_what_the_package_asks_for():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    recipe = (ROOT / "recipe" / "meta.yaml").read_text(encoding="utf-8")
    asked = {line.strip().removeprefix("- ").replace(" ", "") for line in recipe.splitlines() if " >=" in line}
    needed = {*project["project"]["dependencies"], *project["build-system"]["requires"]}
    needed |= {need for need in project["project"]["optional-dependencies"]["core"] if not need.startswith("nanobind")}
    plots = {
        need.replace("matplotlib", "matplotlib-base") for need in project["project"]["optional-dependencies"]["plot"]
    }
    assert asked == needed | plots
    assert f'{{% set version = "{gruebler.__version__}" %}}' in recipe
    assert project["project"]["description"] in recipe
    assert f"- gruebler = {project['project']['scripts']['gruebler']}" in recipe
