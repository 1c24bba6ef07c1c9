"""Exact dimensions: read, kept, valued."""

import math
from decimal import Decimal, localcontext
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.teaching.sheets.expressions import Expression

# The collection sheet 001: what it prints in exact form, and the figures that belong to it.
SHEET = [
    ("5/2*sqrt(3)", 4.330127018922194, "5/2·√3"),
    ("25/3", 25 / 3, "25/3"),
    ("5/9*sqrt(3)", math.cos(math.radians(15.79316904826399)), "5/9·√3"),
    ("10/3*sqrt(6)", 8.16496580927726, "10/3·√6"),
    ("1/3*sqrt(2)*(5*sqrt(11)-9*sqrt(3))", 0.4688903713561814, "5/3·√22 − 3·√6"),
    ("10/9*sqrt(3)", 1.9245008972987525, "10/9·√3"),
    ("40/9*sqrt(3)", 7.69800358919501, "40/9·√3"),
    ("1/4*sqrt(2)*sqrt(3)", 0.6123724356957945, "1/4·√6"),
    ("sqrt(2/3)", math.sin(math.radians(54.735610317245346)), "1/3·√6"),
]


@pytest.mark.parametrize(("text", "value", "printed"), SHEET)
def test_figures_of_the_sheet(text, value, printed):
    found = Expression(text)
    assert math.isclose(float(found), value, rel_tol=1e-14)
    assert found.printed == printed
    assert str(found) == text
    assert found.same(Expression(printed))


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("-2**2", -4),
        ("2**3**2", 512),
        ("(-2)**-2", 0.25),
        ("8-4-2", 2),
        ("8/4/2", 1),
        ("--3", 3),
        (".5+1.", 1.5),
        ("2−3·√4×2", -10),
        ("√(1+3)", 2),
        ("sqrt(2)*sqrt(3)-sqrt(6)", 0),
        ("sqrt(3+2*sqrt(2))-1-sqrt(2)", 0),
        ("1/(1-1+sqrt(2)-1)", 2**0.5 + 1),
    ],
)
def test_rules_of_calculation(text, value):
    assert math.isclose(float(Expression(text)), value, rel_tol=1e-15)
    assert math.copysign(1, float(Expression(text))) == math.copysign(1, value)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "column 1: expected a number, but the text ends"),
        ("3 4", "column 3: expected an operator, but found '4'"),
        ("(1+2", "column 5: expected a closing parenthesis"),
        ("__import__('os')", "column 1: unknown name '__import__'"),
        ("2^3", r"powers are written \*\*"),
        ("2**10**9", r"column 2: an exponent is a whole number from -64 to 64"),
        ("2**(1/2)", "whole number"),
        ("2**sqrt(2)", "whole number"),
        ("2**pi", "column 2: an exponent is a whole number"),
        ("2**(1-1+pi-pi)", "whole number"),
        ("2**sqrt(-1)", "column 4: the root of a negative number"),
        ("2**(1/0)", "column 6: a division by zero"),
        ("2**(0**-1)", "column 6: a division by zero"),
        (".", "column 1: expected a number, but found '.'"),
        ("1+.", "column 3: expected a number"),
        ("1/0", "column 2: a division by zero"),
        ("1+2/(sqrt(2)*sqrt(3)-sqrt(6))", "column 4: a division by zero"),
        ("sqrt(1-2)", "column 1: the root of a negative number"),
        ("(" * 10_000, "at most 300 characters, not one of 10000"),
        ("(" * 100 + "1" + ")" * 100, "more than 30 nested levels"),
        ("-" * 200 + "1", "more than 30 nested levels"),
        ("(((9**64)**64)**64)**64", r"beyond 2\^900"),
        ("9" * 299, r"beyond 2\^900"),
        ("1e3", "found 'e3'"),
        ("٣", "expected a number"),
        ("nan", "unknown name"),
        (None, "text of at most 300 characters"),
        (3.0, "text of at most 300 characters"),
    ],
)
def test_what_is_no_number_is_refused(text, words):
    with pytest.raises(LinkageError, match=words):
        Expression(text)


def rationals():
    return st.fractions(-50, 50, max_denominator=12)


@settings(max_examples=40)
@given(st.lists(st.tuples(rationals(), st.integers(0, 40)), min_size=1, max_size=4), rationals())
def test_exact_values_are_true(terms, divisor):
    """Rival: the same in 60 decimal digits; law: x/x = 1, x - x = 0, (x)^2 = x*x."""
    text = "+".join(f"({q})*sqrt({d})" for q, d in terms)
    found = Expression(text)
    with localcontext(prec=60):
        value = sum(Decimal(q.numerator) / q.denominator * Decimal(d).sqrt() for q, d in terms)
        assert abs(Decimal(float(found)) - value) <= Decimal(math.ulp(float(value))) / 2 * (1 + Decimal("1e-20"))
    assert Expression(f"({text})-({text})").exact == {}
    assert Expression(f"({text})**2").same(Expression(f"({text})*({text})"))
    if found.exact:
        assert Expression(f"({text})/({text})").exact == {1: Fraction(1)}
        assert Expression(f"1/({text})").same(Expression(f"({text})**-1"))


@settings(max_examples=25)
@given(rationals(), rationals())
def test_values_that_are_no_sums_of_roots(a, b):
    text = f"sqrt(({a})**2+sqrt(({b})**2+2))*pi"
    found = Expression(text)
    assert found.exact is None
    assert found.printed == text
    assert math.isclose(float(found), math.sqrt(a * a + math.sqrt(b * b + 2)) * math.pi, rel_tol=1e-14)
    assert found.same(Expression(f"pi*({text})/pi"))
    assert not found.same(Expression(f"{text}+2**-64"))


def test_equality_is_of_the_writing():
    assert Expression("1/2") == Expression("1/2")
    assert Expression("1/2") != Expression("2/4")
    assert Expression("1/2").same(Expression("2/4"))
    assert len({Expression("1/2"), Expression("1/2"), Expression("0.5")}) == 2
    assert eval(repr(Expression("sqrt(2)"))) == Expression("sqrt(2)")
