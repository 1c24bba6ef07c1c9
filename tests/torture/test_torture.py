"""The torture itself: the same seed gives the same inputs, faults are noticed, and a few inputs and kills are well."""

import signal
from collections import Counter

import pytest

pytest.importorskip("resource", reason="limits of time and memory are those of POSIX systems")

from tests.torture import processes
from tests.torture.inputs import GROUPS, SLOW, VALID, Case, case, size, try_all, try_one
from tests.torture.interrupts import interrupt_all
from tests.torture.kills import kill_all
from tests.torture.processes import Outcome


@pytest.fixture
def folder(tmp_path):
    made = tmp_path / "work"
    made.mkdir()
    return made


@pytest.mark.parametrize("group", [group for group in VALID if group != "checkpoints"])
def test_the_same_seed_gives_the_same_inputs(group):
    made = [case(group, number, 1) for number in range(30)]
    assert made == [case(group, number, 1) for number in range(30)]
    assert made != [case(group, number, 2) for number in range(30)]
    assert len({(one.arguments, *one.files.values()) for one in made}) > 20


def ended(status=0, err="", seconds=0.0, memory=0, out=b""):
    return Outcome(status, out, err, seconds, memory)


@pytest.mark.parametrize(
    ("outcome", "fault"),
    [
        (ended(), None),
        (ended(out=b'{"a": 1}'), None),
        (ended(2, "gruebler check: no\n"), None),
        (ended(70, "Traceback (most recent call last):\n  File\nKeyError: 'a'\n"), "traceback: KeyError: 'a'"),
        (ended(-signal.SIGXCPU), "more than 10 s"),
        (ended(seconds=10.1), "more than 10 s"),
        (ended(memory=10**9 + 1), "more than 1 GB"),
        (ended(2, "gruebler check: this needs more memory than there is\n"), "more than 1 GB"),
        (ended(-signal.SIGSEGV), f"ended with status {-signal.SIGSEGV}"),
        (ended(2), "a message of 0 characters"),
        (ended(2, "a\nb\n"), "2 lines of message: 'a\\nb\\n'"),
        (ended(2, "a" * 1300), "a message of 1,300 characters"),
        (ended(0, "x.py:3: RuntimeWarning: overflow"), "a warning: 'x.py:3: RuntimeWarning: overflow'"),
        (ended(1, "\x1b[31m"), "control characters: '\\x1b[31m'"),
        (ended(out=b'{"a": NaN}'), "not JSON: b'{\"a\": NaN}'"),
    ],
)
def test_faults_are_noticed(outcome, fault):
    assert outcome.fault(["check", "--json"] if outcome.out else ["check"]) == fault


def test_a_real_crash_and_a_real_loop_are_noticed(folder, monkeypatch):
    def crash(_):
        raise KeyError("somewhere")

    def loop(_):
        while True:
            pass

    monkeypatch.setattr(processes, "main", crash)
    assert try_one(Case(("check",)), folder)[1] == "traceback: KeyError: 'somewhere'"
    monkeypatch.setattr(processes, "main", loop)
    outcome = processes.run(["check"], folder, seconds=1)
    assert outcome.status == -signal.SIGXCPU


def test_another_answer_is_noticed(folder):
    assert try_one(Case(("enumerate", "--links", "4", "--assortments", "--json"), answer=b"{}"), folder)[1].startswith(
        "another answer"
    )


@pytest.mark.slow
def test_a_few_inputs_of_every_kind(folder):
    seen = Counter()
    groups = [group for group in GROUPS if group != SLOW]
    for group, number, one, _, fault in try_all(220, 7, folder, groups):
        assert fault is None, f"{group}/{number}: {one.arguments}"
        seen[group] += 1
    assert seen == {group: size(group, 220) for group in groups}


def test_a_few_interrupts(tmp_path):
    told = interrupt_all(6, 7, tmp_path)
    assert sum(told.values()) == 6


@pytest.mark.slow
def test_a_few_kills(tmp_path):
    told = kill_all(5, 7, tmp_path)
    assert told["kills"] == 5
    assert told["finished runs, same bytes"] >= 1
