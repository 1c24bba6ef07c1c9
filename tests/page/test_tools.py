"""Tests of the page are skipped where a tool is missing; in CI none may be."""

import os
import shutil
from importlib.util import find_spec

import pytest

from tests.page.conftest import find_browser


@pytest.mark.skipif("CI" not in os.environ, reason="elsewhere a missing tool skips the tests that need it")
def test_nothing_that_the_page_is_tested_with_is_missing(request):
    programs = [name for name in ("node", "npm") if shutil.which(name) is None]
    packages = [
        name for name in ("starlette", "uvicorn", "websockets", "anywidget", "playwright") if not find_spec(name)
    ]
    assert (programs, packages) == ([], [])
    # Asked for only now: the fixture would skip the test where playwright is missing.
    assert find_browser(request.getfixturevalue("chromium"))
