"""Every test of kernels runs in both tiers: interpreted and compiled."""

from types import FunctionType

import pytest

from gruebler._numeric import compiling


@pytest.fixture(autouse=True, params=["interpreted", "compiled"])
def kernel_tier(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    """The tier of the test: for all that the library calls, and for the kernels that the test calls itself."""
    tier: str = request.param
    if tier == "interpreted" and request.node.get_closest_marker("large"):
        pytest.skip("too large to be interpreted")
    monkeypatch.setenv("GRUEBLER_KERNELS", tier)
    monkeypatch.delenv("NUMBA_DISABLE_JIT", raising=False)
    known = set(compiling.kernels())
    for name, value in vars(request.module).items():
        if isinstance(value, FunctionType) and value in known:
            monkeypatch.setattr(request.module, name, getattr(compiling, tier)(value))
    return tier
