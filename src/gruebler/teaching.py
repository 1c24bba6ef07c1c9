"""Teaching: exercises solved and marked, fresh tasks, tables, collection sheets, exact expressions."""

from gruebler.exercises import (
    all_exercises,
    exercise,
    generate,
    grade,
    lines_of_table,
    solution_text,
    solve,
    task_text,
    teaching_table,
)
from gruebler.sheets import Sheet, sheet, sheets
from gruebler.sheets.expressions import Expression

__all__ = [
    "Expression",
    "Sheet",
    "all_exercises",
    "exercise",
    "generate",
    "grade",
    "lines_of_table",
    "sheet",
    "sheets",
    "solution_text",
    "solve",
    "task_text",
    "teaching_table",
]
