"""Settings that all tests share."""

import gc
import os
from contextlib import suppress

import pytest
from hypothesis import HealthCheck, settings

# The fast tests try the same examples on every machine, so that a failure is one of the change at hand; `make slow`
# draws new ones each time, and more of them.
# The load of the machine makes single examples slow now and then; slowness is not what these tests judge.
new_examples = "GRUEBLER_NEW_EXAMPLES" in os.environ
settings.register_profile(
    "gruebler",
    deadline=None,
    derandomize=not new_examples,
    max_examples=100 if new_examples else 40,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much],  # both depend on load and on luck
)
settings.load_profile("gruebler")
# Hypothesis also tries numbers that stand in loaded modules; which are loaded depends on the tests run before.
with suppress(ImportError):  # versions that do not know this
    from hypothesis.internal.conjecture import providers

    if not new_examples and hasattr(providers, "_local_constants"):
        providers._get_local_constants = lambda: providers._local_constants

# What collecting makes stays until the end; looking through half a million such objects for garbage, again and again,
# took a third of the time of collecting.
gc.disable()


@pytest.hookimpl(tryfirst=True)
def pytest_runtestloop():
    gc.enable()  # not frozen: Hypothesis 6.100 then takes examples for flaky
    gc.set_threshold(20_000, 20, 20)  # all that was collected is looked through less often
