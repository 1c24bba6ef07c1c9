"""The paper with its numbers and figures: `python -m paper.fill [FOLDER]`, by default build/paper.

No number of the manuscript is typed. `{{chains mobility=1 links=20 | chains}}` stands for a value of docs/tables,
several columns or rows for a table of them; `[draw truss_modes links=11 modes=200]` for the picture of that chain.
"""

import re
import sys
from pathlib import Path

from gruebler.cli import main as gruebler
from gruebler.structure.count_tables import count_table

MANUSCRIPT = Path(__file__).with_name("manuscript.md")
NUMBER = re.compile(r"\{\{(\w+)((?: \w+=\d+)*) \| ([\w, ]+)\}\}")
FIGURE = re.compile(r"\[draw (\w+)((?: \w+=\d+)*)\]")


def rows_of(table: str, conditions: str) -> list[dict[str, object]]:
    """The rows of a table of docs/tables that have these values."""
    wanted = [condition.split("=") for condition in conditions.split()]
    rows = count_table(table).to_json()["rows"]
    found = [row for row in rows if all(row[column] == int(value) for column, value in wanted)]
    if not found:
        raise ValueError(f"no row of {table} has{conditions}")
    return found


def filled(text: str) -> str:
    """The text with the numbers of the tables."""
    return NUMBER.sub(lambda match: _numbers(*match.groups()), text)


def _numbers(table: str, conditions: str, columns: str) -> str:
    names = columns.split(", ")
    rows = [[_cell(row[name]) for name in names] for row in rows_of(table, conditions)]
    if len(rows) == len(names) == 1:
        return rows[0][0]
    head = [name.replace("_", " ") for name in names]
    return "\n".join(f"| {' | '.join(line)} |" for line in (head, ["--:"] * len(names), *rows))


def _cell(value: object) -> str:
    if isinstance(value, float):
        return f"{value:,g}" if value < 1e6 else f"{value:,.0f}"
    return f"{value:,}" if isinstance(value, int) else str(value)


def main(folder: Path) -> None:
    """Write paper.md and its figures."""
    folder.mkdir(parents=True, exist_ok=True)
    text = filled(MANUSCRIPT.read_text(encoding="utf-8"))
    for number, match in enumerate(FIGURE.finditer(text), 1):
        joints = str(rows_of(match[1], match[2])[0]["joints"])
        gruebler(["draw", " ".join(f"R({joint})" for joint in joints.split()), "-o", str(folder / f"{number}.svg")])
        text = text.replace(match[0], f"({number}.svg)", 1)
    (folder / "paper.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1] if sys.argv[1:] else "build/paper"))
