from . import (
    catalog,
    constructions,
    exercises,
    sheets,
    worksheets,
)
from .exercises import (
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
from .sheets import Sheet, all_sheets, sheet
from .sheets.expressions import Expression
from .worksheets import worksheet

__all__ = [
    "Expression",
    "Sheet",
    "all_exercises",
    "all_sheets",
    "catalog",
    "constructions",
    "exercise",
    "exercises",
    "generate",
    "grade",
    "lines_of_table",
    "sheet",
    "sheets",
    "solution_text",
    "solve",
    "task_text",
    "teaching_table",
    "worksheet",
    "worksheets",
]
