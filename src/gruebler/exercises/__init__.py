"""Exercises solved step by step, fresh tasks with solutions, answers marked, and tables for teaching.

A *solution* is a function of the given quantities (`methods`, one module for each theory), so that it solves the
exercises of the seeds, the worked examples and fresh tasks alike; what is printed is compared with it and never stored
as a result. docs/theory/exercises.md has the conventions and the misprints with the computed values.
"""

from gruebler.exercises.generation import KINDS, LEVELS, fresh
from gruebler.exercises.grading import Mark, Marked, mark, plain_key, plain_name
from gruebler.exercises.loader import all_exercises, exercise
from gruebler.exercises.messages import lines_of_table, said_source, said_value, solution_text, task_text
from gruebler.exercises.serialisation import plain_marks, plain_solution, plain_table, plain_task
from gruebler.exercises.solution import Check, Heading, Mistake, Result, Solution, Step, Table
from gruebler.exercises.solving import Comparison, compare, methods, solve
from gruebler.exercises.tables import TABLES, teaching_table

__all__ = [
    "KINDS",
    "LEVELS",
    "TABLES",
    "Check",
    "Comparison",
    "Heading",
    "Mark",
    "Marked",
    "Mistake",
    "Result",
    "Solution",
    "Step",
    "Table",
    "all_exercises",
    "compare",
    "exercise",
    "fresh",
    "lines_of_table",
    "mark",
    "methods",
    "plain_key",
    "plain_marks",
    "plain_name",
    "plain_solution",
    "plain_table",
    "plain_task",
    "said_source",
    "said_value",
    "solution_text",
    "solve",
    "task_text",
    "teaching_table",
]
