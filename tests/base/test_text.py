"""Texts in the reader's language: gaps, numbers, lists, and the German catalog is complete."""

import ast
import re
from io import BytesIO
from string import Formatter

import numpy as np
import pytest
from babel.messages.mofile import read_mo

from gruebler.base import errors
from gruebler.base.errors import ChainError, GrueblerError, nearest
from gruebler.base.text import (
    LANGUAGES,
    Message,
    arity,
    error_in_language,
    in_every_language,
    listed,
    message,
    number,
    plural,
    reason_of,
    translate,
)
from tests.messages import (
    LOCALE,
    SOURCES,
    Found,
    Unreadable,
    catalog_path,
    compiled,
    is_translated,
    messages,
    read,
    updated,
)

OTHERS = LANGUAGES[1:]


def gaps(text: str) -> set[tuple[str, str]]:
    """The gaps of a text, each with its conversion."""
    return {(name, conversion or "") for _, name, _, conversion in Formatter().parse(text) if name is not None}


def test_every_folder_is_a_language():
    assert sorted(path.name for path in LOCALE.iterdir()) == sorted(OTHERS)


@pytest.mark.parametrize("lang", OTHERS)
def test_no_message_is_missing_and_none_is_left_over(lang):
    catalog = read(lang)
    wanted = {entry.text for entry in messages() if isinstance(entry, Found)}
    known = {entry.id if isinstance(entry.id, str) else entry.id[0] for entry in catalog if entry.id}
    assert known == wanted
    assert [entry.id for entry in catalog if entry.id and (not is_translated(entry) or entry.fuzzy)] == []


@pytest.mark.parametrize("lang", OTHERS)
def test_translations_have_the_gaps_of_the_text(lang):
    entries = [entry for entry in read(lang) if entry.id]
    assert len(entries) > 500
    for entry in entries:
        if isinstance(entry.id, str):
            assert {name for name, _ in gaps(entry.string)} == {name for name, _ in gaps(entry.id)}, entry.id
        else:
            assert all(gaps(string) <= gaps(entry.id[1]) for string in entry.string), entry.id


@pytest.mark.parametrize("lang", OTHERS)
def test_the_compiled_catalog_is_that_of_the_text(lang):
    """But for the header, which names the version of Babel that wrote it."""

    def texts(file):
        return sorted((entry.context or "", str(entry.id), entry.string) for entry in read_mo(file) if entry.id)

    with catalog_path(lang).with_suffix(".mo").open("rb") as file:
        assert texts(file) == texts(BytesIO(compiled(updated(read(lang), lang)))), "make messages"


ONE_WORD = re.compile(r"\bViergelenk(e|en|s)?\b|Genaupunkt|\(Vorgabe: |\bGebiets?\b|(mit|nach) kleinsten Quadraten")
"""Other words for what is called Viergelenkgetriebe, Genauigkeitspunkt, Standard, Bereich, Methode der kleinsten ..."""


def test_one_german_word_stands_for_one_thing():
    texts = [
        text for entry in read("de") for text in ([entry.string] if isinstance(entry.string, str) else entry.string)
    ]
    assert [text for text in texts if ONE_WORD.search(text)] == []


def test_errors_are_raised_with_plain_texts():
    assert [entry for entry in messages() if isinstance(entry, Unreadable)] == []


NOTATION = {"pairs.py", "notation.py"}  # German words that a user may write are part of the notation
GERMAN = re.compile(r"[äöüÄÖÜß]|\b(?:der|die|das|und|nicht|kein|keine|ist|sind|wird|mit|von|ein|eine|einem|für)\b")


def test_no_german_sentence_stands_in_the_code():
    german = []
    for path in sorted(SOURCES.rglob("*.py")):
        if path.name in NOTATION:
            continue
        text = path.read_text(encoding="utf-8")
        if not GERMAN.search(text) and not re.search(r"\\[uxN]", text):  # in no string, then
            continue
        tree = ast.parse(text)
        documented = ast.Module | ast.ClassDef | ast.FunctionDef
        docstrings = {
            id(statement.value)
            for node in ast.walk(tree)
            if isinstance(node, documented)
            for statement in node.body
            if isinstance(statement, ast.Expr)
        }
        german += [
            (path.name, node.lineno, node.value)
            for node in ast.walk(tree)
            if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in docstrings
            if GERMAN.search(node.value)
        ]
    assert german == []


def test_a_text_without_values_is_taken_as_it_is():
    assert translate("{not a gap", "en") == "{not a gap"
    assert str(GrueblerError("{not a gap")) == "{not a gap"


def test_an_unknown_language_is_refused():
    with pytest.raises(GrueblerError, match=r"expected a language \(en, de\), but found 'fr'"):
        translate("and", "fr")


@pytest.mark.parametrize(
    ("value", "lang", "form", "written"),
    [
        (1234.5, "en", ",.1f", "1,234.5"),
        (1234.5, "de", ",.1f", "1.234,5"),
        (0.25, "de", ".3g", "0,25"),
        (7, "de", "", "7"),
        (-1e-9, "de", "g", "-1e-09"),
    ],
)
def test_numbers(value, lang, form, written):
    assert number(value, lang, form) == written
    assert translate("{x:" + form + "}", lang, x=value) == written


def test_texts_that_look_like_numbers_stay():
    assert translate("{version}", "de", version="1.2") == "1.2"
    assert translate("{yes}", "de", yes=True) == "True"


def test_messages_in_messages_are_translated_with_them():
    inner = message("and")
    assert translate("{a} {b}", "de", a=inner, b=1.5) == "und 1,5"
    error = ChainError("{why}: {where!r}", why=inner, where="x")
    assert error_in_language(error, "de") == "und: 'x'"
    assert error_in_language(GrueblerError("{cause}!", cause=error), "de") == "und: 'x'!"
    assert str(error) == "and: 'x'"


def test_an_error_can_be_raised_with_a_message():
    error = ChainError(message("{a} and {b}", a=message("and"), b=1.5))
    assert (type(error), str(error), error.text, error.values["b"]) == (ChainError, "and and 1.5", "{a} and {b}", 1.5)


def test_offered_words_are_translated():
    error = GrueblerError("{word!r}{suggestion}", word="cranck", suggestion=nearest("cranck", ["frame", "crank"]))
    assert str(error) == "'cranck' (did you mean 'crank'?)"
    assert error_in_language(error, "de") == "'cranck' (gemeint ist vielleicht 'crank')"


def test_whatever_is_read_in_a_language_fills_a_gap():
    words = in_every_language(lambda lang: arity(3, lang))
    assert (translate("{x}", "de", x=words), translate("{x}", "en", x=words)) == ("ternär", "ternary")
    assert str(GrueblerError("{x}", x=words)) == "ternary"


def test_lists_and_words():
    assert listed([message("binary"), "x"], "de") == "binär und x"
    assert [arity(k, "de") for k in (1, 2, 3, 4)] == ["singulär", "binär", "ternär", "quaternär"]
    assert plural("{count} joint", "{count} joints", 2) == "2 joints"


def test_errors_survive_a_way_between_processes():
    import pickle

    error = errors.LinkageError("no link {link!r}", link="a{b}")
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.text, again.values) == (str(error), error.text, error.values)
    assert isinstance(message("{a}", a=1), Message)


@pytest.mark.parametrize(
    ("value", "english", "german"),
    [
        (-1.5, "not -1.5", "nicht -1,5"),
        (-40.0, "not -40", "nicht -40"),
        (np.float64(0.25), "not 0.25", "nicht 0,25"),
        (float("nan"), "not nan", "nicht nan"),
        (1e300, "not 1e+300", "nicht 1e+300"),
        ("1.5", "not '1.5'", "nicht '1.5'"),
    ],
)
def test_a_wrong_number_is_quoted_in_the_language(value, english, german):
    error = GrueblerError("{name} must be positive, not {value!r}", name="a", value=value)
    assert error_in_language(error, "en").endswith(english)
    assert error_in_language(error, "de").endswith(german)


def test_reasons_of_the_system_are_translated(tmp_path):
    with pytest.raises(FileNotFoundError) as missing:
        (tmp_path / "none").read_bytes()
    assert str(reason_of(missing.value)) == "No such file or directory"
    assert translate("{why}", "de", why=reason_of(missing.value)) == "Datei oder Ordner nicht gefunden"
    assert reason_of(OSError("torn cable")) == "torn cable"
    with pytest.raises(UnicodeDecodeError) as bytes_only:
        b"\xff".decode()
    assert str(reason_of(bytes_only.value)) == "it is not UTF-8 text"
