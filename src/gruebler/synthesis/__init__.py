"""Dimensional synthesis: linkages for a wanted motion.

Tasks are positions of a body, points of a path, a function, dead centres; every answer is a `SynthesisResult`: all
designs with their verdicts, and how many solutions there are by theorem, found and real. docs/theory/synthesis.md has
the definitions, theorems and methods.
"""

from gruebler.synthesis.dead_centres import synthesise_dead_centres
from gruebler.synthesis.formulas import FunctionLaw
from gruebler.synthesis.functions import synthesise_function
from gruebler.synthesis.judging import Demands
from gruebler.synthesis.minimax_search import minimax
from gruebler.synthesis.paths import synthesise_path
from gruebler.synthesis.positions import synthesise_positions
from gruebler.synthesis.results import Design, DesignVerdict, SolutionCount, SynthesisResult, pareto
from gruebler.synthesis.structural_error import structural_error
from gruebler.synthesis.structures import synthesise_structures
from gruebler.synthesis.synthesise import synthesise
from gruebler.synthesis.task_files import read_task, task_from_json, task_to_json, write_task
from gruebler.synthesis.tasks import DeadCentreTask, FunctionTask, PathTask, PositionTask, Task, function_task

__all__ = [
    "DeadCentreTask",
    "Demands",
    "Design",
    "DesignVerdict",
    "FunctionLaw",
    "FunctionTask",
    "PathTask",
    "PositionTask",
    "SolutionCount",
    "SynthesisResult",
    "Task",
    "function_task",
    "minimax",
    "pareto",
    "read_task",
    "structural_error",
    "synthesise",
    "synthesise_dead_centres",
    "synthesise_function",
    "synthesise_path",
    "synthesise_positions",
    "synthesise_structures",
    "task_from_json",
    "task_to_json",
    "write_task",
]
