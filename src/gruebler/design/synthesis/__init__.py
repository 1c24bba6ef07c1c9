"""Dimensional synthesis: linkages for a wanted motion.

Tasks are positions of a body, points of a path, a function, dead centres, a rest; every answer is a `SynthesisResult`:
all designs with their verdicts, and how many solutions there are by theorem, found and real. docs/theory/synthesis.md
has the definitions, theorems and methods.
"""

from gruebler.design.synthesis.dead_centres import synthesise_dead_centres
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.dwells import synthesise_dwells
from gruebler.design.synthesis.formulas import FunctionLaw
from gruebler.design.synthesis.functions import synthesise_function
from gruebler.design.synthesis.minimax_search import minimax
from gruebler.design.synthesis.paths import synthesise_path
from gruebler.design.synthesis.positions import synthesise_positions
from gruebler.design.synthesis.results import Design, DesignVerdict, SolutionCount, SynthesisResult, pareto
from gruebler.design.synthesis.six_bar_functions import SixBarType, synthesise_six_bars
from gruebler.design.synthesis.six_bar_positions import synthesise_guiding_six_bars
from gruebler.design.synthesis.spherical import synthesise_orientations
from gruebler.design.synthesis.spherical_functions import synthesise_spherical_function
from gruebler.design.synthesis.structural_errors import structural_error
from gruebler.design.synthesis.structures import synthesise_structures
from gruebler.design.synthesis.synthesising import synthesise
from gruebler.design.synthesis.tasks import (
    DeadCentreTask,
    DwellTask,
    FunctionTask,
    PathTask,
    PositionTask,
    Task,
    function_task,
)

__all__ = [
    "DeadCentreTask",
    "Demands",
    "Design",
    "DesignVerdict",
    "DwellTask",
    "FunctionLaw",
    "FunctionTask",
    "PathTask",
    "PositionTask",
    "SixBarType",
    "SolutionCount",
    "SynthesisResult",
    "Task",
    "function_task",
    "minimax",
    "pareto",
    "structural_error",
    "synthesise",
    "synthesise_dead_centres",
    "synthesise_dwells",
    "synthesise_function",
    "synthesise_guiding_six_bars",
    "synthesise_orientations",
    "synthesise_path",
    "synthesise_positions",
    "synthesise_six_bars",
    "synthesise_spherical_function",
    "synthesise_structures",
]
