"""`gruebler synthesise`: linkages for positions, functions, points, dead centres, rests."""

from __future__ import annotations

import argparse
import cmath
import math
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from math import radians
from pathlib import Path
from typing import Any

from gruebler.base.errors import SynthesisError, UnitWarning
from gruebler.base.text import Message, joined_by_and, message, translate
from gruebler.cli import synthesise_sphere
from gruebler.cli.design_files import check_demands, check_picture, design_to_write, draw_designs
from gruebler.cli.design_tables import print_clearance, print_designs, print_optimum
from gruebler.cli.executors import executor_of
from gruebler.cli.long_work import count_line
from gruebler.cli.output import print_json, say_written
from gruebler.cli.parser import Parser
from gruebler.design.synthesis import (
    DeadCentreTask,
    Demands,
    DwellTask,
    FunctionLaw,
    FunctionTask,
    PathTask,
    PositionTask,
    SixBarType,
    SynthesisResult,
    Task,
    synthesise_dead_centres,
    synthesise_dwells,
    synthesise_function,
    synthesise_guiding_six_bars,
    synthesise_path,
    synthesise_positions,
    synthesise_six_bars,
    synthesise_structures,
)
from gruebler.design.synthesis.results import Progress
from gruebler.design.synthesis.six_bar_monodromy import LOOPS
from gruebler.files.designs import result_to_json
from gruebler.files.linkages import write_linkage
from gruebler.files.tasks import read_task

_OPTIONS = {
    "swing": "--swing",
    "stroke": "--stroke",
    "crank_angle": "--crank-angle",
    "time_ratio": "--time-ratio",
    "dwell": "--dwell",
    "interval": "--interval",
    "input_swing": "--swings",
    "output_swing": "--swings",
    "input_start": "--starts",
    "output_start": "--starts",
    "precision_points": "--points",
    "moving_pivots": "--moving-pivot",
    "fixed_pivots": "--fixed-pivot",
    "curve_parameters": "--curve-parameter",
    "region": "--region",
    "lengths": "--length",
    "frame_direction": "--frame-direction",
    "near_pivots": "--near-pivot",
    "tolerance": "--tolerance",
    "starts": "--start-solutions",
    "executor": "--jobs, --scheduler",
}
"""The options for keys of task files."""
_TASK_OPTIONS = {
    "function": ("--interval", "--swings", "--starts", "--points", "--travel"),
    "dead-centres": ("--swing", "--stroke", "--crank-angle", "--time-ratio"),
    "dwell": ("--dwell", "--swing", "--stroke"),
    "spherical-function": ("--interval", "--swings", "--starts", "--points"),
}
"""The options that are a task by themselves."""
_ALONE = ("--jobs", 1)
"""The default: this process does the work."""
_STRUCTURE_OPTIONS = ("--link", "--initial-designs")
"""The options that only --structure uses."""
_SHARING = ("--jobs", "--scheduler")
"""Those that --structure uses, and --six-bars where start solutions are made at random."""
_SIX_BARS_BESIDE = {
    "function": ("--minimax", "--travel", "--structure"),
    "positions": ("--curve-parameter", "--structure"),
}
"""The options that --six-bars does not take."""
_SIX_BAR_OPTIONS = {
    "function": ("--six-bar-type", "--arm", "--shape", "--start-solutions"),
    "positions": ("--start-solutions",),
}
"""The options that only --six-bars uses."""
_LEAST = {PositionTask: 16, FunctionTask: 16, PathTask: 6, DeadCentreTask: 12, DwellTask: 1}
"""How many dyads or designs of an infinite family are taken at least, so that the best are among them."""
_IMPROVED = message("initial designs improved: {done:,} of {count:,}")
_COUNTED = {
    "positions": message("designs judged: {done:,} of {count:,}"),
    "path": message("paths or designs: {done:,} of {count:,}"),
    "function": message("paths or start solutions: {done:,} of {count:,}"),
}
"""What is counted meanwhile; of the others initial designs."""
_TASKS: dict[str, type[Task]] = {
    "positions": PositionTask,
    "function": FunctionTask,
    "path": PathTask,
    "dead-centres": DeadCentreTask,
    "dwell": DwellTask,
    "spherical-function": FunctionTask,
}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Find all linkages for a task and judge each by its motion: one circuit, one branch, the order of "
        "the task, full turn of the drive, minimum transmission angle.",
        epilog="Example: gruebler synthesise positions five.csv -o best.toml --draw designs.html. Exit status: 0 there "
        "is a design, 1 there is none, 2 wrong usage or unreadable input.",
    )
    positions = parser.add_command(
        "positions",
        help="guide a body through positions",
        description="Four-bars, slider-cranks and inverted slider-cranks that guide a body through positions x, y, "
        "angle: up to five exactly, more by least squares; six-bars through five to eight exactly.",
    )
    positions.take(
        """
        task TASK  a .toml, .json or .csv file; CSV columns x,y,angle and order where wanted
        --moving-pivot X Y float ...  choose a pivot on the body in its first position, for two to four positions; with
            four the nearest point of Burmester's curve; repeatable
        --fixed-pivot X Y float ...  choose a pivot on the frame, likewise; repeatable; beside a single pivot the best
            others are sought
        --six-bars  six-bars of Watt's first kind: all through six positions with two fixed pivots, first that of the
            crank, then that of the ternary rocker; all through five with the pin of the body on the coupler as a
            moving pivot besides; some through seven with the rocker's pivot, or through eight with none
        --start-solutions N int  with --six-bars, of seven and eight positions: how many of the generic solutions are
            followed (default: 20000)
        --curve-parameter T float ...  choose a pivot of four positions by its place along the circle-point curve, 0 to
            1 as in the picture; repeatable
        """
    )
    function = parser.add_command(
        "function",
        help="coordinate input and output",
        description="Linkages whose output is a function of the crank angle: pairs of a table, or an expression.",
        epilog="Example: gruebler synthesise function 'log10(x)' --interval 1 2 --swings 60 60 --points 5 --minimax",
    )
    function.take(
        """
        task TASK|EXPRESSION  a .toml, .json or .csv file (CSV columns input,output or input,travel), or an expression
            such as 'log10(x)', its angles in radians
        --interval FROM TO float  interval of x
        --swings INPUT OUTPUT float  ranges in degrees (or the unit of a slider)
        --starts INPUT OUTPUT float  fixed start values (default: free)
        --points N int  number of precision points (default: 5, with fixed starts 3, of six-bars 9 or, of a
            type, 8; at most 11)
        --free-starts  count the pairs of a file from start values that are free
        --travel  the output is a slider
        --minimax  the linkages nearby with the least largest error over the interval
        --six-bars  all six-bars that meet nine pairs exactly (Watt II), or eight, or some that meet eleven;
            their starts are free
        --six-bar-type TYPE =  of eight pairs: Watt II (default), Stephenson II or Stephenson III; of eleven one of
            Stephenson's
        --arm LENGTH float  of eight pairs: an arm of the ternary link, by the frame (default: 0.8)
        --shape RATIO DEG float  of eight pairs by Stephenson's: the other arm, by this one (default: 1 60)
        --start-solutions N int  of eleven pairs: how many of about a million generic solutions are followed (default:
            20000)
        """
    )
    path = parser.add_command(
        "path",
        help="guide a coupler point through points or along a curve",
        description="Four-bars whose coupler point passes through points: nine points, five points and both fixed "
        "pivots, five points with crank angles, mixed tasks, each with all solutions; whole curves, and targets of "
        "several kinds with tolerances, by least squares.",
    )
    path.take(
        """
        task TASK  a .toml, .json or .csv file; CSV columns x,y and angle, crank, output, tolerance, weight,
            order where wanted
        --closed  the points are a closed curve
        --fixed-pivot X Y float ...  a given pivot on the frame; give it twice for both
        """
    )
    dead = parser.add_command(
        "dead-centres",
        help="crank-rockers and slider-cranks with given dead centres",
        description="Crank-rockers of a given swing, or slider-cranks of a given stroke, with a given crank angle "
        "between the dead centres; the one with the best transmission angle first.",
        epilog="Example: gruebler synthesise dead-centres --swing 60 --time-ratio 1.2",
    )
    dead.take(
        """
        task TASK ?  a .toml, .json or .csv file (or the options below)
        --swing DEG float  swing of the rocker
        --stroke H float  stroke of the slider
        --crank-angle DEG float  crank angle between the dead centres, in which rocker and crank turn the same way
        --time-ratio K float  time ratio of slow to quick travel
        """
    )
    dwell = parser.add_command(
        "dwell",
        help="six-bars whose output rests while the crank turns on",
        description="Six-bars with a crank that turns, whose output swings or slides and rests over a crank angle, the "
        "most exact rest first. The output may stray by --tolerance of its swing or stroke (default: 0.005); the "
        "transmission angles do not fall below 30 degrees unless --transmission says otherwise.",
        epilog="Example: gruebler synthesise dwell --swing 30 --dwell 90 -o rest.toml --draw rest.html",
    )
    dwell.take(
        """
        task TASK ?  a .toml, .json or .csv file (or the options below)
        --dwell DEG float  crank angle over which the output rests
        --swing DEG float  swing of an output that turns
        --stroke H float  stroke of an output that slides
        """
    )
    orientations = parser.add_command(
        "orientations",
        help="turn a body about a point through orientations",
        description="Four-bars on the sphere whose coupler takes three to five orientations: all of five, the best of "
        "the families of three and four.",
        epilog="Example: gruebler synthesise orientations turns.toml --crank -o best.toml",
    )
    orientations.take(
        """
        task TASK  a .toml or .json file: orientations = [[x, y, z, angle], ...], axis and angle in degrees
        """
    )
    spherical = parser.add_command(
        "spherical-function",
        help="coordinate two angles by a four-bar on the sphere",
        description="Four-bars on the sphere whose output is a function of the crank angle: four pairs, or three with "
        "--frame, exactly; with --frame and free starts all of five pairs, the best of the families of three and four.",
        epilog="Example: gruebler synthesise spherical-function 'x^2' --interval 0 1 --swings 60 60 --frame 90",
    )
    spherical.take(
        """
        task TASK|EXPRESSION  a .toml, .json or .csv file (CSV columns input,output), or an expression such as 'x^2',
            its angles in radians
        --interval FROM TO float  interval of x
        --swings INPUT OUTPUT float  ranges in degrees
        --starts INPUT OUTPUT float  fixed start values, counted from the arc of the frame (default: free)
        --points N int  number of precision points (default: 5, with fixed starts 4, with --frame as well 3)
        --free-starts  count the pairs of a file from start values that are free
        --frame DEG float  the angle between the fixed axes
        """
    )
    spherical.set_defaults(travel=False, six_bars=False)
    for kind in (orientations, spherical):
        synthesise_sphere.add(kind)
    for kind in (positions, function, path, dead, dwell):
        kind.take(
            """
            --region X1 Y1 X2 Y2 float  of positions and points: region for the fixed pivots
            --length LINK L ...  a given distance of the pins of crank, coupler, rocker, frame (or another link);
                repeatable
            --frame-direction DEG float  the angle of the line through two fixed pivots with the x axis
            --near-pivot X Y float ...  of positions and points: a place near which a fixed pivot is preferred; give it
                twice for both: designs are sorted by the distance of their pivots from it, unless --sort says
                otherwise; two to four positions and two to eight points are sought by it, too
            --structure MECHANISM ...  fit this mechanism instead: a text, a family such as "Watt I", or a catalog
                entry; several are compared
            --initial-designs N int  with --structure: improve N initial designs of each mechanism (default: 24 of an
                atlas, else 4)
            --link LINK =  with --structure: the link that is guided, or the output
            """
        )
        if kind in (positions, function):
            kind.take(
                """
                --jobs N int =1  with --structure, or where --six-bars takes --start-solutions: number of processes
                    (default: 1)
                """
            )
        else:
            kind.take("--jobs N int =1  with --structure: number of processes (default: 1)")
        kind.take(
            """
            --scheduler ADDRESS  likewise: send the work to a Dask scheduler, such as tcp://host:8786; local: one with
                a worker for each processor of this machine
            --crank
            --transmission
            --size-ratio
            --tolerance PART float  how far a target may be missed, as a part of the size of the task (default: nothing,
                or 0.05 where targets are approached)
            --any-order  the targets may be met in any order
            --sort KEY[,KEY] =  sort the designs by error, transmission, range-transmission, size, size-ratio,
                sensitivity, near-pivots, links, full-turn; of equal ones the second key decides. For two to four
                positions or pairs, two to eight points and dead centres the best is sought by it; others that were
                found are sorted
            --clearance C float  print how far targets move, lengths wrong by a thousandth and pins C beside their holes
            --number N int  give the N best designs only
            --rejected
            """
        )
        kind.add_json(help="print an object with all linkages")
        kind.add_out(help="write the best linkage to a file: .toml or .json", endings=("toml", "json"))
        kind.take(
            """
            --design
            --draw FILE path  draw the designs, or rejected ones if there are no others: .html all, moving; .svg, .png
                or .pdf the best six
            """
        )


def run(arguments: argparse.Namespace) -> int:
    """Solve the task, print designs, write and draw the best. Status 1: no design was accepted."""
    with warnings.catch_warnings(action="ignore", category=UnitWarning):  # angles of files and options are degrees
        return _run(arguments)


def _run(arguments: argparse.Namespace) -> int:
    if arguments.action == "orientations":
        return synthesise_sphere.turn_body(arguments)
    if arguments.action == "spherical-function":
        task = _task(arguments)
        assert isinstance(task, FunctionTask)
        return synthesise_sphere.coordinate(arguments, task)
    if arguments.draw is not None:
        check_picture(arguments.draw)
    demands = _demands(arguments)
    task = _task(arguments)
    with _keys_as_options():
        orders = demands.orders(_orders(arguments))
    result = _solved(arguments, task, demands, orders)
    if orders:
        result = result.sorted_by(*orders)
    shown = replace(result, designs=result.designs[: arguments.number])
    written = design_to_write(arguments, shown)
    drawn = arguments.draw is not None and bool(result.designs or result.rejected)
    if written is not None:
        write_linkage(arguments.out, written.linkage)
        say_written(arguments.out, arguments.lang)
    if drawn:
        draw_designs(arguments.draw, result, arguments.lang, most=len(shown.designs))
    if arguments.json:
        print_json(result_to_json(shown))
    else:
        print_designs(result, shown, arguments.rejected, arguments.lang)
        if arguments.clearance is not None:
            print_clearance(shown, arguments.clearance, arguments.lang)
        law = task.law if isinstance(task, FunctionTask) else None
        if law is not None and result.designs and (optimum := result.designs[0].optimum) is not None:
            print_optimum(optimum, law, arguments.lang)
        for path in (arguments.out if not result.designs else None, arguments.draw if not drawn else None):
            if path is not None:
                print(translate("{path} is not written: no design was accepted.", arguments.lang, path=path))
    return 0 if result.designs else 1


def _orders(arguments: argparse.Namespace) -> list[str]:
    return [name.strip() for name in arguments.sort.split(",") if name.strip()]


def _demands(arguments: argparse.Namespace) -> Demands:
    region = None
    if arguments.region is not None:
        x1, y1, x2, y2 = arguments.region
        region = (min(x1, x2), min(y1, y2), max(x1, x2), max(y1, y2))
    check_demands(arguments)
    if arguments.action in _SIX_BARS_BESIDE and arguments.six_bars:
        other = _given(arguments, _SIX_BARS_BESIDE[arguments.action])
        if other:
            raise SynthesisError("{options}: not with --six-bars", options=joined_by_and(other))
    alone = _SIX_BAR_OPTIONS.get(arguments.action, ())
    if alone and not arguments.six_bars and (idle := _given(arguments, alone)):
        raise SynthesisError("{options}: only with --six-bars", options=joined_by_and(idle))
    if not arguments.structure:
        if idle := _given(arguments, _STRUCTURE_OPTIONS if alone else (*_STRUCTURE_OPTIONS, *_SHARING)):
            raise SynthesisError("{options}: only with --structure", options=joined_by_and(idle))
        if not (alone and arguments.six_bars) and (idle := _given(arguments, _SHARING)):
            raise SynthesisError(
                "{options}: only with --structure, or where --six-bars takes --start-solutions",
                options=joined_by_and(idle),
            )
    if arguments.clearance is not None and not 0 <= arguments.clearance < math.inf:
        raise SynthesisError("--clearance: expected at least 0, but found {clearance:g}", clearance=arguments.clearance)
    with _keys_as_options():
        return Demands(
            lengths=_lengths(arguments.length),
            frame_direction=None if arguments.frame_direction is None else radians(arguments.frame_direction),
            crank=arguments.crank,
            transmission=radians(arguments.transmission),
            size_ratio=arguments.size_ratio,
            region=region,
            near_pivots=tuple(map(tuple, arguments.near_pivot)),
            tolerance=Demands.tolerance if arguments.tolerance is None else arguments.tolerance,
            in_order=not arguments.any_order,
        )


def _lengths(rows: Sequence[tuple[str, str]]) -> tuple[tuple[str, float], ...]:
    try:
        return tuple((link, float(length)) for link, length in rows)
    except ValueError:
        written = ", ".join(map(" ".join, rows))
        raise SynthesisError("--length: expected a link and its length, but found {found}", found=written) from None


def _dead_centres(arguments: argparse.Namespace) -> Task:
    return DeadCentreTask(
        swing=_radians(arguments.swing),
        stroke=arguments.stroke,
        crank_angle=_radians(arguments.crank_angle),
        time_ratio=arguments.time_ratio,
    )


def _rest(arguments: argparse.Namespace) -> Task:
    if arguments.dwell is None:
        raise SynthesisError("a rest needs {option}: see gruebler synthesise dwell --help", option="--dwell")
    return DwellTask(dwell=radians(arguments.dwell), swing=_radians(arguments.swing), stroke=arguments.stroke)


_OF_OPTIONS = {"dead-centres": _dead_centres, "dwell": _rest}
"""Tasks that options can give."""


def _task(arguments: argparse.Namespace) -> Task:
    """The task of the file or the options; `SynthesisError` for one of another kind."""
    if arguments.action in _OF_OPTIONS and arguments.task is None:
        with _keys_as_options():
            return _OF_OPTIONS[arguments.action](arguments)
    if arguments.action.endswith("function") and Path(arguments.task).suffix.lower() not in (".toml", ".json", ".csv"):
        with _keys_as_options():
            return _function_task(arguments)
    task = read_task(arguments.task)
    given = _given(arguments, _TASK_OPTIONS.get(arguments.action, ()))
    if given:
        raise SynthesisError(
            "{options}: the file {task} has the whole task", options=joined_by_and(given), task=arguments.task
        )
    if not isinstance(task, _TASKS[arguments.action]):
        kind = next(name for name, kind_of_task in _TASKS.items() if isinstance(task, kind_of_task))
        raise SynthesisError("{task}: this is a task for 'synthesise {kind}'", task=arguments.task, kind=kind)
    if isinstance(task, PathTask):
        with _keys_as_options():
            pivots = (*task.fixed_pivots, *arguments.fixed_pivot)
            closed, order = task.closed or arguments.closed, _ranks(arguments, task)
            return replace(task, closed=closed, fixed_pivots=pivots, order=order)
    if isinstance(task, PositionTask):
        with _keys_as_options():
            return replace(
                task,
                moving_pivots=(*task.moving_pivots, *arguments.moving_pivot),
                fixed_pivots=(*task.fixed_pivots, *arguments.fixed_pivot),
                curve_parameters=(*task.curve_parameters, *arguments.curve_parameter),
                order=_ranks(arguments, task),
            )
    if isinstance(task, FunctionTask) and task.law is None and arguments.free_starts:
        return replace(task, start_input=False, start_output=False)
    return task


def _ranks(arguments: argparse.Namespace, task: PositionTask | PathTask) -> tuple[int | None, ...]:
    """Those of a task that has some, all alike where any order will do."""
    return (1,) * len(task.order) if arguments.any_order else task.order


@contextmanager
def _keys_as_options() -> Iterator[None]:
    """What is wrong with a task made of options names these, not the keys of a task file."""
    try:
        yield
    except SynthesisError as error:
        values = {name: _with_option_names(value) for name, value in error.values.items()}
        raise SynthesisError(error.text, **values) from None


def _with_option_names(value: Any) -> Any:
    if isinstance(value, Message):
        return Message(value.text, {name: _with_option_names(part) for name, part in value.values.items()})
    return _OPTIONS.get(value, value) if isinstance(value, str) else value


def _given(arguments: argparse.Namespace, options: Sequence[str]) -> list[str]:
    """Which of these options were given."""
    values = {option: getattr(arguments, option.removeprefix("--").replace("-", "_")) for option in options}
    idle: tuple[object, ...] = (None, False, "", [])
    return [option for option, value in values.items() if value not in idle and (option, value) != _ALONE]


def _radians(value: float | None) -> float | None:
    return None if value is None else radians(value)


def _function_task(arguments: argparse.Namespace) -> FunctionTask:
    from gruebler.design.synthesis import function_task

    on_sphere = arguments.action == "spherical-function"
    fixed = 4 if on_sphere and arguments.frame is None else 3
    six = 8 if not on_sphere and _given(arguments, _SIX_BAR_OPTIONS["function"]) else 9
    usual = six if arguments.six_bars else 5 if arguments.starts is None else fixed
    points = usual if arguments.points is None else arguments.points
    return function_task(_law(arguments), points, output="travel" if arguments.travel else "angle")


def _law(arguments: argparse.Namespace) -> FunctionLaw:
    for option, value in (("--interval", arguments.interval), ("--swings", arguments.swings)):
        if value is None:
            raise SynthesisError(
                "an expression needs {option}: see gruebler synthesise {action} --help",
                option=option,
                action=arguments.action,
            )
    unit = 1.0 if arguments.travel else math.pi / 180
    starts = arguments.starts or (None, None)
    return FunctionLaw(
        arguments.task,
        interval=tuple(arguments.interval),
        input_swing=radians(arguments.swings[0]),
        output_swing=arguments.swings[1] * unit,
        input_start=_radians(starts[0]),
        output_start=None if starts[1] is None else starts[1] * unit,
    )


def _solved(arguments: argparse.Namespace, task: Task, demands: Demands, orders: Sequence[str]) -> SynthesisResult:
    progress = count_line(_COUNTED.get("" if arguments.structure else arguments.action, _IMPROVED), arguments.lang)
    more = {} if arguments.number is None else {"number": max(arguments.number, _LEAST[type(task)])}
    with _keys_as_options():
        if arguments.structure:
            return _fitted(arguments, task, demands, progress)
        if isinstance(task, PositionTask | FunctionTask) and arguments.six_bars:
            return _six_bars(arguments, task, demands, progress)
        if isinstance(task, PositionTask | PathTask):
            guided: Callable[..., SynthesisResult] = (
                synthesise_path if isinstance(task, PathTask) else synthesise_positions
            )
            return guided(task, demands, sort=orders, progress=progress, **more)
        if isinstance(task, FunctionTask):
            return synthesise_function(task, demands, minimax=arguments.minimax, sort=orders, **more)
        if isinstance(task, DeadCentreTask):
            return synthesise_dead_centres(task, demands, sort=orders, **more)
        return synthesise_dwells(task, demands, progress=progress, **more)


def _six_bars(
    arguments: argparse.Namespace, task: PositionTask | FunctionTask, demands: Demands, progress: Progress | None
) -> SynthesisResult:
    """Six-bars that meet the task exactly."""
    executor = executor_of(arguments)
    if isinstance(task, PositionTask):
        return synthesise_guiding_six_bars(
            task, demands, starts=arguments.start_solutions, executor=executor, progress=progress
        )
    return synthesise_six_bars(task, demands, kind=_six_bar_type(arguments), executor=executor, progress=progress)


def _six_bar_type(arguments: argparse.Namespace) -> SixBarType | None:
    """What the options say of a six-bar for eight or eleven pairs; None if they say nothing."""
    if not _given(arguments, _SIX_BAR_OPTIONS["function"]):
        return None
    usual = SixBarType()
    shape = usual.shape if arguments.shape is None else cmath.rect(arguments.shape[0], radians(arguments.shape[1]))
    arm = usual.arm if arguments.arm is None else arguments.arm
    starts = usual.start_solutions if arguments.start_solutions is None else arguments.start_solutions
    wanted = arguments.six_bar_type or usual.family
    family = next((known for known in LOOPS if known.lower() == wanted.lower()), wanted)
    if arguments.shape is not None and family == usual.family:
        raise SynthesisError("{options}: only with a type of Stephenson's", options="--shape")
    return SixBarType(family=family, arm=arm, shape=shape, start_solutions=starts)


def _fitted(
    arguments: argparse.Namespace, task: Task, demands: Demands, progress: Callable[[int, int], None] | None
) -> SynthesisResult:
    """Mechanisms of any structure, each from several starts."""
    from gruebler.cli.inputs import mechanism_of
    from gruebler.design.realisation.realising import with_drives

    if arguments.action == "function" and arguments.minimax:
        raise SynthesisError("--minimax improves four-bars and slider-cranks; --structure fits other mechanisms")
    mechanisms = [mechanism_of(text, None, []) for text in arguments.structure]
    driven = [mechanism if mechanism.drives else with_drives(mechanism) for mechanism in mechanisms]
    return synthesise_structures(
        task,
        driven,
        demands,
        starts=arguments.initial_designs,
        link=arguments.link,
        executor=executor_of(arguments),
        progress=progress,
    )
