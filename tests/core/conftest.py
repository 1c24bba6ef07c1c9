"""The module of `core/` as it is installed."""

from types import ModuleType

import pytest

from gruebler import _core


@pytest.fixture(scope="session")
def core() -> ModuleType:
    """The module."""
    return _core
