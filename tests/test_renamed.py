"""docs/renamed.md: whatever it gives as the present name is there."""

import re
from importlib import import_module
from pathlib import Path

import pytest

PAGE = Path(__file__).parents[1] / "docs" / "renamed.md"
ROWS = [
    [cell.strip().strip("`") for cell in line.strip().strip("|").split(" | ")]
    for line in PAGE.read_text(encoding="utf-8").splitlines()
    if line.startswith("| `")
]
NAMES = sorted({now for before, *rest in ROWS for now in rest[-1:] if len(rest) == 1 and re.fullmatch(r"[\w.]+", now)})
ATTRIBUTES = sorted(
    {
        f"{row[0]}.{row[2]}"
        for row in ROWS
        if len(row) == 3 and re.fullmatch(r"[\w.]+", row[0]) and re.fullmatch(r"\w+", row[2])
    }
)


def exists(name):
    """Whether a dotted name below gruebler leads to a module, a value, or a field of a class."""
    parts = re.sub(r"^(gr|gruebler)\.", "", name).split(".")
    parts = ["gruebler", *parts]
    for k in range(len(parts), 0, -1):
        try:
            value = import_module(".".join(parts[:k]))
        except ModuleNotFoundError:
            continue
        for part in parts[k:]:
            if not hasattr(value, part):
                return part in getattr(value, "__annotations__", {})  # a field of a class
            value = getattr(value, part)
        return True
    return False


def test_the_page_is_read():
    assert (len(NAMES) > 600, len(ATTRIBUTES) > 20) == (True, True)
    assert not exists("kinematics.motion.Motion.no_such_method")
    assert not exists("no_such_room.x")


@pytest.mark.parametrize("names", [NAMES, ATTRIBUTES], ids=["names", "attributes"])
def test_every_present_name_exists(names):
    assert [name for name in names if not exists(name)] == []
