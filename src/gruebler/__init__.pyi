# The front door: every name that `import gruebler as gr` gives, and where it comes from. This list is the only one;
# names are loaded when they are first used.

from . import base, design, files, machines, mechanics, page, pictures, structure, teaching
from .base.errors import GrueblerError, UnitWarning
from .design.realisation.realising import realise
from .design.synthesis import synthesise
from .files.values import write
from .machines.cams import Cam
from .machines.gears import Train
from .machines.geneva import Geneva
from .mechanics.analysis import motion_roles
from .mechanics.analysis.measuring import Measures
from .mechanics.dynamics import equilibria, inverse_dynamics, linearised, simulate
from .mechanics.forces import Gas, Loads, Motor, RigidBody, Spring, Statics, TorsionSpring, statics
from .mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from .mechanics.geometry import coupler_curve
from .mechanics.kinematics import Circuit, Motion, from_degrees, move_many
from .mechanics.kinematics.drive_rows import rpm
from .mechanics.linkages import Linkage
from .mechanics.screws import SpatialLinkage, freedoms
from .mechanics.space import assembly_modes, circuit, drive_range, measures, move, rotatability
from .page.notebook import explore
from .pictures.values import animate, draw, plot
from .structure.assur import assur_groups, decompose
from .structure.chain import Chain, Joint
from .structure.enumeration import chains, count_chains
from .structure.isomorphism import code, decode, is_isomorphic, symmetry
from .structure.mechanism import Mechanism
from .structure.mechanism.inversion import driven_mechanisms, inversions
from .structure.mobility import mobility_report
from .structure.transformations import derive, extend
from .structure.type_synthesis import Requirements, variants
from .teaching.catalog.words import read

__version__: str

__all__ = [
    "Cam",
    "Chain",
    "Circuit",
    "FourBar",
    "Gas",
    "Geneva",
    "GrueblerError",
    "InvertedSliderCrank",
    "Joint",
    "Linkage",
    "Loads",
    "Measures",
    "Mechanism",
    "Motion",
    "Motor",
    "Requirements",
    "RigidBody",
    "SliderCrank",
    "SpatialLinkage",
    "Spring",
    "Statics",
    "TorsionSpring",
    "Train",
    "UnitWarning",
    "animate",
    "assembly_modes",
    "assur_groups",
    "base",
    "chains",
    "circuit",
    "code",
    "count_chains",
    "coupler_curve",
    "decode",
    "decompose",
    "derive",
    "design",
    "draw",
    "drive_range",
    "driven_mechanisms",
    "equilibria",
    "explore",
    "extend",
    "files",
    "freedoms",
    "from_degrees",
    "inverse_dynamics",
    "inversions",
    "is_isomorphic",
    "linearised",
    "machines",
    "measures",
    "mechanics",
    "mobility_report",
    "motion_roles",
    "move",
    "move_many",
    "page",
    "pictures",
    "plot",
    "read",
    "realise",
    "rotatability",
    "rpm",
    "simulate",
    "statics",
    "structure",
    "symmetry",
    "synthesise",
    "teaching",
    "variants",
    "write",
]
