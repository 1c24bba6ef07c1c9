"""What the commands of synthesis say beside the tables, in both languages, as a user reads it."""

import pytest

from gruebler.cli import main

ROWS = ("0,0,0", "2.1,0.9,20", "3.2,1,46", "4,0.2,86")


@pytest.fixture
def said(tmp_path, capsys):
    """What a synthesis of positions, so many of the usual ones or those given, prints, or the sentence of its error."""

    def of(positions, words="", lang="en", *, action="positions"):
        rows = ROWS[:positions] if isinstance(positions, int) else positions
        task = tmp_path / "task.csv"
        task.write_text("\n".join(("x,y,angle", *rows)), encoding="utf-8")
        main(["synthesise", action, str(task), *words.split(), "--lang", lang])
        printed = capsys.readouterr()
        return printed.out + printed.err

    return of


@pytest.mark.parametrize(
    ("lang", "improved", "pairs"),
    [
        ("en", "The best are then improved: their pivots are moved", "Linkages of a crank and a dyad PR: "),
        (
            "de",
            "Die besten werden danach verbessert: Ihre Gelenkpunkte",
            "Getriebe aus einer Kurbel und einem Zweischlag",
        ),
    ],
)
def test_that_designs_are_improved_is_said_once(said, lang, improved, pairs):
    out = said(4, lang=lang)
    assert out.count(improved) == 1
    assert pairs in out


@pytest.mark.parametrize(
    ("demands", "english", "german"),
    [
        ("", "has a larger transmission angle than the best here.", "als das beste hier."),
        ("--crank --transmission 30", "with the given pivot meets all demands.", "alle Forderungen erfüllt."),
    ],
)
def test_a_bound_that_is_not_proved_beside_a_given_pivot_is_not_that_of_a_dyad(said, demands, english, german):
    for lang, begin, end in (
        ("en", "whether a four-bar with", english),
        ("de", "ob ein Viergelenkgetriebe mit", german),
    ):
        (line,) = [line for line in said(3, f"--moving-pivot -8.1 -0.9 {demands}", lang).splitlines() if begin in line]
        assert line.endswith(end)
