"""Settings that all tests share."""

from hypothesis import HealthCheck, settings

# Compilation and the machine's load make single examples slow now and then; slowness is not what these tests judge.
settings.register_profile(
    "gruebler",
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much],  # both depend on load and on luck
)
settings.load_profile("gruebler")
