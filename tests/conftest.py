"""Settings that all tests share."""

from hypothesis import settings

# Compilation and the machine's load make single examples slow now and then; slowness is not what these tests judge.
settings.register_profile("gruebler", deadline=None)
settings.load_profile("gruebler")
