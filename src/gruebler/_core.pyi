"""The kernels in C++ (`core/`): arrays in, arrays out, C-contiguous; each door says at runtime what it takes."""

import numpy as np
from numpy.typing import NDArray

# counting
def level_names() -> list[str]: ...
def take_census(
    graphs: NDArray[np.int64], loops: int, mobility: int, orbits: bool, *, level: str = ""
) -> NDArray[np.int64]: ...
def add_loop(parents: NDArray[np.int64], loops: int, first: int, enough: int) -> tuple[NDArray[np.int64], int]: ...
def list_chains(graphs: NDArray[np.int64], loops: int, mobility: int) -> NDArray[np.uint8]: ...
def list_graph6(graphs: NDArray[np.int64], loops: int, mobility: int) -> NDArray[np.uint8]: ...
def write_graph6(edges: NDArray[np.uint8], links: int) -> NDArray[np.uint8]: ...
def canonical_rows(rows: NDArray[np.int64]) -> NDArray[np.int64]: ...
def find_automorphisms(rows: NDArray[np.int64]) -> NDArray[np.int64]: ...

# labelling
def canonical_form(
    n: int, vertex_colour: NDArray[np.int64], edges: NDArray[np.int32], edge_colour: NDArray[np.int32]
) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.int32], NDArray[np.int64]]: ...
def canonical_bulk(n: int, edges: NDArray[np.int32], bounds: NDArray[np.int64]) -> NDArray[np.int32]: ...

# motion: a tuple holds the fields that are named
def run_path(
    program: tuple[object, ...],
    path: NDArray[np.float64],
    speeds: NDArray[np.float64],
    signs: NDArray[np.float64],
    start: NDArray[np.float64],
    poses: tuple[object, ...],
    *,
    level: str = "",
) -> tuple[int, int, float, int]: ...
def run_designs(
    program: tuple[object, ...],
    designs: tuple[object, ...],
    path: NDArray[np.float64],
    speeds: NDArray[np.float64],
    kept: NDArray[np.int64],
    poses: tuple[object, ...],
    part: tuple[int, int],
    *,
    level: str = "",
) -> None: ...
def closing(
    conditions: tuple[object, ...],
    x: NDArray[np.float64],
    residual: NDArray[np.float64],
    jacobian: NDArray[np.float64],
) -> float: ...
def newton(conditions: tuple[object, ...], x: NDArray[np.float64], steps: int) -> tuple[int, float]: ...
def close_near_singular(conditions: tuple[object, ...], x: NDArray[np.float64]) -> None: ...
def jacobian(
    conditions: tuple[object, ...], x: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
def settle_on_curve(
    conditions: tuple[object, ...], x: NDArray[np.float64], tangent: NDArray[np.float64]
) -> tuple[bool, float, float, int, NDArray[np.int64]]: ...
def trace_curve(
    conditions: tuple[object, ...],
    samples: tuple[object, ...],
    count: int,
    step: float,
    longest: float,
    most: float,
) -> tuple[int, int, float]: ...
def evaluate_pose(
    conditions: tuple[object, ...],
    samples: tuple[object, ...],
    at: NDArray[np.float64],
    segments: NDArray[np.int64],
    poses: NDArray[np.float64],
    tangents: NDArray[np.float64],
) -> int: ...

# design: drive and dyads of `CrankDyads`
def move_planes(
    drive: NDArray[np.int64],
    dyads: NDArray[np.int64],
    points: NDArray[np.complex128],
    lines: NDArray[np.complex128],
    sides: NDArray[np.float64],
    turned: NDArray[np.float64],
    level: str = "",
) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]: ...
def find_tops(
    drive: NDArray[np.int64],
    dyads: NDArray[np.int64],
    points: NDArray[np.complex128],
    lines: NDArray[np.complex128],
    sides: NDArray[np.float64],
    turned: NDArray[np.float64],
    watched: NDArray[np.int64],
    between: bool,
) -> NDArray[np.float64]: ...
def find_cosines(
    drive: NDArray[np.int64],
    dyads: NDArray[np.int64],
    points: NDArray[np.complex128],
    lines: NDArray[np.complex128],
    sides: NDArray[np.float64],
    turned: NDArray[np.float64],
    watched: NDArray[np.int64],
) -> NDArray[np.float64]: ...
def cosine_slopes(
    drive: NDArray[np.int64],
    dyads: NDArray[np.int64],
    places: NDArray[np.complex128],
    sides: NDArray[np.float64],
    turned: NDArray[np.float64],
    watched: NDArray[np.int64],
) -> NDArray[np.float64]: ...
def trace_point(
    drive: NDArray[np.int64],
    dyads: NDArray[np.int64],
    places: NDArray[np.complex128],
    sides: NDArray[np.float64],
    turned: NDArray[np.float64],
    link: int,
) -> NDArray[np.complex128]: ...
def trace_slopes(
    drive: NDArray[np.int64],
    dyads: NDArray[np.int64],
    places: NDArray[np.complex128],
    sides: NDArray[np.float64],
    turned: NDArray[np.float64],
    link: int,
    by_places: bool,
) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]: ...

# design: joints of `DesignClosure`
def close_poses(
    joints: NDArray[np.int64], q: NDArray[np.float64], p: NDArray[np.float64], size: float, steps: int
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]: ...
def pose_slopes(
    joints: NDArray[np.int64], q: NDArray[np.float64], p: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
def move_poses(
    joints: NDArray[np.int64], q: NDArray[np.float64], p: NDArray[np.float64], size: float
) -> NDArray[np.float64]: ...
def pose_gradients(
    joints: NDArray[np.int64],
    q: NDArray[np.float64],
    p: NDArray[np.float64],
    size: float,
    by_pose: NDArray[np.float64],
) -> NDArray[np.float64]: ...
def settle_arcs(
    arcs: NDArray[np.float64],
    values: NDArray[np.complex128],
    rates: NDArray[np.complex128],
    closed: bool,
    targets: NDArray[np.complex128],
    target: NDArray[np.int64],
    low: NDArray[np.float64],
    high: NDArray[np.float64],
    start: NDArray[np.float64],
    levels: NDArray[np.float64],
    rises: float,
) -> NDArray[np.float64]: ...
def spread_evenly(z: NDArray[np.complex128], parameters: NDArray[np.float64], places: int) -> NDArray[np.float64]: ...
def limit_steps(
    gram: NDArray[np.float64],
    step: NDArray[np.float64],
    values: NDArray[np.float64],
    slopes: NDArray[np.float64],
    slack: float,
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]: ...

# structure
class MultipleJoints:
    def __init__(self, links: int, simple: NDArray[np.int64], fewest: int, most: int, largest: int) -> None: ...
    def next(self, many: int) -> NDArray[np.int64]: ...

def count_sliding(
    vectors: NDArray[np.int64], simple: int, joint: NDArray[np.int64], mobility: int, images: NDArray[np.int64]
) -> NDArray[np.int64]: ...
def describe_groups(n: int, trusses: NDArray[np.uint8]) -> NDArray[np.int64]: ...
def count_modes(n: int, trusses: NDArray[np.int64], spherical: bool) -> NDArray[np.int64]: ...

# algebra
def track(
    starts: NDArray[np.complex128],
    begin: NDArray[np.complex128],
    end: NDArray[np.complex128],
    positions: int,
    points: int,
    loose: float,
    *,
    family: str = "",
    level: str = "",
) -> tuple[NDArray[np.complex128], NDArray[np.int64], NDArray[np.int64]]: ...
def refine_solutions(
    z: NDArray[np.complex128],
    task: NDArray[np.complex128],
    positions: int,
    points: int,
    *,
    family: str = "",
    level: str = "",
) -> tuple[NDArray[np.complex128], NDArray[np.float64]]: ...
def certify(
    z: NDArray[np.complex128], task: NDArray[np.complex128], positions: int, points: int
) -> NDArray[np.bool_]: ...
def evaluate_equations(
    z: NDArray[np.complex128], task: NDArray[np.complex128], positions: int, points: int, *, sharp: bool = False
) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]: ...
def eliminate(
    start: NDArray[np.int64],
    column: NDArray[np.int64],
    value: NDArray[np.int64],
    columns: int,
    most_multiplications: float,
    most_entries: float,
) -> tuple[bool, int, int, NDArray[np.int64], NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]: ...
def solve_back(
    pivot: NDArray[np.int64],
    start: NDArray[np.int64],
    column: NDArray[np.int64],
    value: NDArray[np.int64],
    solutions: NDArray[np.int64],
) -> NDArray[np.int64]: ...
def reduce(matrix: NDArray[np.int64]) -> NDArray[np.int64]: ...

# space
def follow_modes(
    nodes: NDArray[np.int64],
    rows: NDArray[np.int64],
    frames: NDArray[np.complex128],
    twists: NDArray[np.complex128],
    lengths: NDArray[np.complex128],
    given: NDArray[np.complex128],
    starts: NDArray[np.complex128],
    turns: NDArray[np.complex128],
    loose: float,
) -> tuple[
    NDArray[np.complex128], NDArray[np.complex128], NDArray[np.complex128], NDArray[np.float64], NDArray[np.int64]
]: ...
def open_linkage(
    nodes: NDArray[np.int64],
    rows: NDArray[np.int64],
    frames: NDArray[np.float64],
    pitches: NDArray[np.float64],
    lengths: NDArray[np.float64],
    gears: NDArray[np.float64],
    at: NDArray[np.float64],
    turns: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
def follow_linkage(
    nodes: NDArray[np.int64],
    rows: NDArray[np.int64],
    frames: NDArray[np.float64],
    pitches: NDArray[np.float64],
    lengths: NDArray[np.float64],
    gears: NDArray[np.float64],
    start: NDArray[np.float64],
    turns: NDArray[np.float64],
    passive: NDArray[np.int64],
    drives: NDArray[np.int64],
    links: NDArray[np.int64],
    rods: NDArray[np.int64],
    balls_of_rods: NDArray[np.float64],
    unit: NDArray[np.float64],
    values: NDArray[np.float64],
    rates: NDArray[np.float64],
) -> tuple[
    NDArray[np.float64],
    NDArray[np.float64],
    NDArray[np.float64],
    NDArray[np.uint8],
    int,
    float,
    float,
    NDArray[np.float64],
    NDArray[np.float64],
]: ...
def place_rods(rods: NDArray[np.int64], balls: NDArray[np.float64], poses: NDArray[np.float64]) -> None: ...

# dynamics
def reduced_forces(
    ends: NDArray[np.float64], coefficients: NDArray[np.float64], closed: float, q: float, speed: float
) -> tuple[float, float, float] | None: ...
def free_step(
    ends: NDArray[np.float64],
    coefficients: NDArray[np.float64],
    closed: float,
    a: NDArray[np.float64],
    b: NDArray[np.float64],
    e3: NDArray[np.float64],
    e5: NDArray[np.float64],
    time: float,
    state: NDArray[np.float64],
    rate: NDArray[np.float64],
    length: float,
    until: float,
    relative: float,
    absolute: NDArray[np.float64],
) -> tuple[float, float, NDArray[np.float64], NDArray[np.float64], int] | None: ...
def free_run(
    ends: NDArray[np.float64],
    coefficients: NDArray[np.float64],
    closed: float,
    a: NDArray[np.float64],
    b: NDArray[np.float64],
    e3: NDArray[np.float64],
    e5: NDArray[np.float64],
    further: NDArray[np.float64],
    bend: NDArray[np.float64],
    calm: NDArray[np.uint8],
    time: float,
    state: NDArray[np.float64],
    rate: NDArray[np.float64],
    length: float,
    until: float,
    relative: float,
    absolute: NDArray[np.float64],
    most: int,
    stops: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], float, int]: ...

# layout
def relax(
    layout: NDArray[np.float64],
    segments: NDArray[np.int64],
    pull: NDArray[np.float64],
    watched: NDArray[np.int64],
    images: NDArray[np.int64],
    turns: NDArray[np.float64],
    power: int,
    rounds: int,
) -> tuple[NDArray[np.float64], float]: ...
def closest(layout: NDArray[np.float64], segments: NDArray[np.int64], watched: NDArray[np.int64]) -> float: ...
def crossing_segments(layout: NDArray[np.float64], segments: NDArray[np.int64]) -> NDArray[np.int64]: ...

# atlas
def describe_chains(
    n: int,
    mobility: int,
    loops: int,
    hubs: NDArray[np.int64],
    sizes: NDArray[np.int64],
    edges: NDArray[np.int32],
    pairs: NDArray[np.int32],
    letters: NDArray[np.uint8],
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.uint8], NDArray[np.uint8], NDArray[np.uint8]]: ...
def list_mechanisms(
    n: int, joints: int, text: NDArray[np.uint8], ends: NDArray[np.int64], driven: bool
) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.int16]]: ...
