"""Settings that all tests share."""

import os
import signal
from collections.abc import Iterator
from types import FrameType

import pytest
from hypothesis import HealthCheck, settings

# The fast tests try the same examples on every machine, so that a failure is one of the change at hand; `make slow`
# draws new ones each time.
# Compilation and the machine's load make single examples slow now and then; slowness is not what these tests judge.
settings.register_profile(
    "gruebler",
    deadline=None,
    derandomize="GRUEBLER_NEW_EXAMPLES" not in os.environ,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much],  # both depend on load and on luck
)
settings.load_profile("gruebler")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--longest", type=float, metavar="SECONDS", help="skip a test once it has taken so long")


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item: pytest.Item) -> Iterator[None]:
    """With --longest: what would take too long in the interpreted tier is skipped, and counted as such."""
    longest = item.config.getoption("--longest")
    if longest is None:
        return (yield)

    def stop(_: int, frame: FrameType | None) -> None:
        while frame is not None:
            if frame.f_code.co_name in ("gc_callback", "__del__"):
                return  # exceptions are lost there; the next alarm comes soon
            frame = frame.f_back
        pytest.skip(f"takes more than {longest:g} s")

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, longest, 0.1)
    try:
        return (yield)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
