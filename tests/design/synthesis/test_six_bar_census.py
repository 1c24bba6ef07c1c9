"""How many six-bars there are, estimated: against numbers that are known, interrupted, by one process or several."""

import os

import numpy as np
import pytest

from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis import FunctionTask, PositionTask, SixBarType, synthesise
from gruebler.design.synthesis.six_bar_census import ELEVEN, Census, kept_census
from gruebler.design.synthesis.six_bar_functions import NINE_PAIRS
from gruebler.structure.enumeration.schedulers import DaskScheduler


def grow(census, pieces, executor=None):
    """So many pieces more."""
    more = census.pieces_followed(executor)
    for _ in range(pieces):
        next(more)
    more.close()


def census_of(numbers):
    """A census in which these were met."""
    census = Census(ELEVEN["Stephenson III"], 1)
    census.met = np.unique(numbers, return_counts=True)[1]
    return census.estimate()


def test_as_many_are_estimated_as_there_are():
    """Of 3,000 numbers 600 are drawn, two hundred times: 190 intervals hold the number, as 95 % says, up to 8."""
    rng = np.random.default_rng(1)
    worlds = [census_of(rng.integers(3000, size=600)) for _ in range(200)]
    assert 182 <= sum(world.least <= 3000 <= world.most for world in worlds) <= 199
    assert np.mean([3000 / world.number for world in worlds]) == pytest.approx(1, abs=0.03)
    # Half of the numbers three times as likely: two alike 1.25 times as often, three alike 1.75 / 1.25 ** 2 - 1.
    uneven = census_of(np.concatenate([rng.integers(3000, size=10_000), rng.integers(1500, size=10_000)]))
    assert uneven.number == pytest.approx(3000 / 1.25, rel=0.02)
    assert uneven.unlike == pytest.approx(0.12, abs=0.02)


def test_a_census_goes_on_where_it_was_interrupted(tmp_path, monkeypatch):
    monkeypatch.setattr("gruebler.design.synthesis.six_bar_census._PIECE", 6)
    whole, part, rest = (Census(ELEVEN["Stephenson II"], 5) for _ in range(3))
    grow(whole, 2)
    grow(part, 1)
    part.save(tmp_path / "census.npz")
    rest.load(tmp_path / "census.npz")
    grow(rest, 1)
    assert rest.count == whole.count > 8
    assert rest.z == pytest.approx(whole.z, rel=1e-12)
    other = Census(ELEVEN["Stephenson III"], 5)
    with pytest.raises(ValueError, match="no census"):
        other.load(tmp_path / "census.npz")
    assert other.count == 0


def test_a_damaged_census_begins_anew_and_says_so(tmp_path, monkeypatch):
    def pieces(census, executor):
        census.z, census.met = np.ones((2, census.problem.unknowns), complex), np.array([2, 1])
        yield

    monkeypatch.setattr("gruebler.design.synthesis.six_bar_census.private_folder", lambda: tmp_path)
    monkeypatch.setattr(Census, "pieces_followed", pieces)
    assert kept_census(ELEVEN["Stephenson III"], 2).damaged is None
    (file,) = tmp_path.iterdir()
    file.write_bytes(b"no census")
    assert kept_census(ELEVEN["Stephenson III"], 2).damaged == file


@pytest.mark.parametrize("usable", [True, False])
def test_an_interrupt_says_where_a_census_goes_on_only_if_something_is_kept(usable, tmp_path, monkeypatch):
    def pieces(census, executor):
        raise KeyboardInterrupt
        yield

    monkeypatch.setattr("gruebler.design.synthesis.six_bar_census.private_folder", lambda: tmp_path)
    monkeypatch.setattr(Census, "pieces_followed", pieces)
    file = tmp_path / "six_bars_Stephenson_III_eleven.npz"
    Census(ELEVEN["Stephenson III"], 1).save(file)
    if not usable:
        file.write_bytes(b"no census")
    with pytest.raises(KeyboardInterrupt) as stop:
        kept_census(ELEVEN["Stephenson III"], 2)
    assert stop.value.args == ((file,) if usable else ())


@pytest.mark.slow
def test_the_number_that_monodromy_lists_is_estimated():
    """Of Watt's second kind through nine pairs: 26,370."""
    census = Census(NINE_PAIRS, 2)
    grow(census, 3)
    estimate = census.estimate()
    assert estimate.least < NINE_PAIRS.classes < estimate.most
    assert estimate.most - estimate.least < 0.2 * estimate.number


def test_dask_estimates_the_same(tmp_path, monkeypatch):
    """Workers of a local cluster, interrupted and resumed: the same to the last bit as of one process."""
    pytest.importorskip("distributed")
    monkeypatch.setattr("gruebler.design.synthesis.six_bar_census._PIECE", 24)
    monkeypatch.setattr(os, "cpu_count", lambda: 2)
    alone, shared, resumed = (Census(ELEVEN["Stephenson III"], 5) for _ in range(3))
    grow(alone, 5)
    scheduler = DaskScheduler("local")
    grow(shared, 2, scheduler)
    shared.save(tmp_path / "census.npz")
    resumed.load(tmp_path / "census.npz")
    grow(resumed, 3, scheduler)
    assert resumed.count > 100
    assert (resumed.pieces, resumed.lost) == (alone.pieces, alone.lost)
    assert resumed.z.tobytes() == alone.z.tobytes()
    assert resumed.met.tolist() == alone.met.tolist()


def test_what_has_no_census_takes_no_executor():
    pairs = FunctionTask(np.linspace(0, 1, 9), outputs=np.linspace(0, 2, 9), start_input=False, start_output=False)
    places = PositionTask([(x, x**2, 0.3 * x) for x in range(6)], fixed_pivots=[(0, -1), (2, -1)])
    for task, words in ((pairs, "executor: only of eleven pairs"), (places, "executor: only of seven and eight")):
        with pytest.raises(SynthesisError, match=words):
            synthesise(task, six_bars=True, executor=DaskScheduler("local"))


def test_the_census_of_an_answer_is_shared(tmp_path, monkeypatch):
    """The executor of `synthesise` follows the random six-bars."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    used = []

    def refused():
        used.append(True)
        raise KeyboardInterrupt

    task = FunctionTask(np.linspace(0, 1, 11), outputs=np.linspace(0, 2, 11), start_input=False, start_output=False)
    with pytest.raises(KeyboardInterrupt):
        synthesise(task, six_bars=SixBarType(family="Stephenson III"), executor=refused)
    assert used == [True]
