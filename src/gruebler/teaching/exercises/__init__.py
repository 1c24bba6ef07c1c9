"""Exercises solved step by step, generated tasks with solutions, graded answers, and tables for teaching.

A *solution* is a function of the given quantities (`methods`, one module for each theory). The same function solves
the exercises of the teaching documents, the worked examples and generated tasks; printed results are compared with it
and never stored as results. docs/theory/exercises.md has the conventions and the misprints with the computed values.
"""

from gruebler.teaching.exercises.generation import KINDS, LEVELS, generate
from gruebler.teaching.exercises.grading import Grade, Mark, ascii_key, grade, plain_name
from gruebler.teaching.exercises.loader import all_exercises, exercise
from gruebler.teaching.exercises.messages import faults, lines_of_table, solution_text, task_text, value_text
from gruebler.teaching.exercises.serialisation import grades_as_list, solution_as_dict, table_as_dict, task_as_dict
from gruebler.teaching.exercises.solution import (
    Check,
    Mistake,
    PartHeading,
    Result,
    Solution,
    SolutionStep,
    TeachingTable,
)
from gruebler.teaching.exercises.solving import Comparison, compare, methods, solve, with_values
from gruebler.teaching.exercises.tables import TABLES, forms_of_chain, smallest_lengths, teaching_table

__all__ = [
    "KINDS",
    "LEVELS",
    "TABLES",
    "Check",
    "Comparison",
    "Grade",
    "Mark",
    "Mistake",
    "PartHeading",
    "Result",
    "Solution",
    "SolutionStep",
    "TeachingTable",
    "all_exercises",
    "ascii_key",
    "compare",
    "exercise",
    "faults",
    "forms_of_chain",
    "generate",
    "grade",
    "grades_as_list",
    "lines_of_table",
    "methods",
    "plain_name",
    "smallest_lengths",
    "solution_as_dict",
    "solution_text",
    "solve",
    "table_as_dict",
    "task_as_dict",
    "task_text",
    "teaching_table",
    "value_text",
    "with_values",
]
