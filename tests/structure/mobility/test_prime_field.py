import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from gruebler.structure.mobility import prime_field
from gruebler.structure.mobility.prime_field import (
    CoreTooLarge,
    P,
    echelon,
    left_null_space,
    modular_inverse,
    modular_product,
    null_space,
    null_space_by_column,
    random_solutions,
    reduced_echelon,
    transposed,
)


@st.composite
def matrices(draw, largest=60):
    """Matrices of low rank, sparse or dense, so that both the head and the core of the elimination are met."""
    m, n = draw(st.integers(1, largest)), draw(st.integers(1, largest))
    rank = draw(st.integers(1, min(m, n)))
    share = draw(st.sampled_from([0.05, 0.3, 1.0]))
    random = np.random.default_rng(draw(st.integers(0, 2**32)))
    left = random.integers(0, P, (m, rank)) * (random.random((m, rank)) < share)
    right = random.integers(0, P, (rank, n)) * (random.random((rank, n)) < share)
    return modular_product(left, right)


def sparse(matrix):
    return [{k: int(v) for k, v in enumerate(row) if v} for row in matrix]


def plain_rank(matrix):
    rows = [[int(v) for v in row] for row in matrix]
    done = 0
    for column in range(matrix.shape[1]):
        pivot = next((i for i in range(done, len(rows)) if rows[i][column]), None)
        if pivot is None:
            continue
        rows[done], rows[pivot] = rows[pivot], rows[done]
        scale = modular_inverse(rows[done][column])
        for i in range(done + 1, len(rows)):
            factor = rows[i][column] * scale % P
            if factor:
                rows[i] = [(a - factor * b) % P for a, b in zip(rows[i], rows[done], strict=True)]
        done += 1
    return done


@given(matrices())
@settings(max_examples=60)
def test_rank_null_spaces_and_reduced_form(matrix):
    m, n = matrix.shape
    form = echelon(sparse(matrix), n)
    assert form.rank == plain_rank(matrix) == len(reduced_echelon(matrix))
    basis = null_space(form)
    assert basis.shape == (n - form.rank, n)
    assert not modular_product(matrix, basis.T).any()
    assert len(reduced_echelon(basis)) == len(basis)
    turned = null_space(echelon(transposed(sparse(matrix), n), m))
    left = left_null_space(matrix)
    assert not modular_product(left, matrix).any()
    assert np.array_equal(reduced_echelon(turned), reduced_echelon(left))


@given(st.integers(1, P - 1))
def test_inverse(a):
    assert a * modular_inverse(a) % P == 1


@pytest.mark.parametrize("size", [1, 7, 300])
def test_product_against_python_integers(size):
    random = np.random.default_rng(size)
    a, b = random.integers(0, P, (3, size)), random.integers(0, P, (size, 2))
    want = [[sum(int(x) * int(y) for x, y in zip(row, column, strict=True)) % P for column in b.T] for row in a]
    assert modular_product(a, b).tolist() == want


def test_a_large_product_of_the_largest_residues():
    """Sums of products of doubles stay exact: every entry is n (P - 1)^2 = n modulo P."""
    n = 5000
    a = np.full((150, n), P - 1)
    assert (modular_product(a, a.T) == n).all()
    random = np.random.default_rng(4)
    a, b = random.integers(0, P, (90, 200)), random.integers(0, P, (200, 60))
    assert (modular_product(a, b) == (a.astype(object) @ b.astype(object) % P).astype(np.int64)).all()


@pytest.mark.parametrize(
    ("m", "n", "rank"), [(230, 250, 230), (250, 230, 230), (260, 260, 131), (110, 300, 97), (300, 96, 96)]
)
def test_a_core_of_several_panels(m, n, rank):
    """Low ranks leave panels without a pivot and pivots apart; a shuffled block of zeros makes rows change places."""
    random = np.random.default_rng(m + n)
    left, right = random.integers(0, P, (m, rank)), random.integers(0, P, (rank, n))
    right[:, 3:110] *= random.random(right[:, 3:110].shape) < 0.02
    matrix = modular_product(left, right)
    form = echelon(sparse(matrix), n)
    assert form.rank == plain_rank(matrix)
    basis = null_space(form)
    assert len(basis) == n - form.rank
    assert not modular_product(matrix, basis.T).any()


@pytest.mark.parametrize("dense", [True, False])
@given(matrices())
@settings(max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_null_spaces_by_column_and_random_solutions(monkeypatch, dense, matrix):
    monkeypatch.setattr(prime_field, "_DENSE_BASIS", 10**9 if dense else -1)
    form = echelon(sparse(matrix), matrix.shape[1])
    basis = null_space(form)
    by_column = null_space_by_column(form)
    written = np.zeros_like(basis)
    for column, (members, values) in by_column.items():
        assert len(members)
        assert (np.diff(members) > 0).all()
        written[members, column] = values
    assert np.array_equal(written, basis)
    some = random_solutions(form, 3)
    assert not modular_product(matrix, some).any()
    assert np.array_equal(some.any(axis=1), basis.any(axis=0))
    assert len(reduced_echelon(some.T)) == min(3, len(basis))


def test_a_basis_with_too_many_entries_is_not_written_down(monkeypatch):
    rows = [{0: 1, 1: 1, 2: 1}, {3: 1, 4: 1, 5: 1}]
    monkeypatch.setattr(prime_field, "_DENSE_BASIS", 0)
    assert len(null_space_by_column(echelon(rows, 6))) == 6
    monkeypatch.setattr(prime_field, "_SPARSE_STEPS", 3)
    assert null_space_by_column(echelon(rows, 6)) is None


def test_what_is_long_or_large_is_refused_unless_it_is_wanted(monkeypatch):
    random = np.random.default_rng(2)
    matrix = random.integers(0, P, (60, 70))
    monkeypatch.setattr(prime_field, "_LARGE", 1000)
    with pytest.raises(CoreTooLarge, match=r"60 equations"):
        echelon(sparse(matrix), 70)
    assert echelon(sparse(matrix), 70, large=True).rank == 60
