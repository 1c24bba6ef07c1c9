# The front door: every name that `import gruebler as gr` gives, and where it comes from. This list is the only one;
# names are loaded when they are first used.

from . import (
    assur,
    atlas,
    cams,
    catalog,
    chain,
    drawing,
    enumeration,
    errors,
    explorer,
    forces,
    formats,
    fourbar,
    gears,
    geneva,
    geometry,
    isomorphism,
    kinematics,
    linkages,
    mechanism,
    mobility,
    notebook,
    realisation,
    screws,
    synthesis,
    teaching,
    text,
    transformations,
    type_synthesis,
)
from .analysis import drive_range, motion_roles
from .analysis.measures import Measures, measures
from .analysis.rotatability import rotatability
from .assur import assur_groups, decompose
from .cams import Cam
from .chain import Chain, Joint
from .enumeration import chains, count_chains
from .errors import GrueblerError, UnitWarning
from .explorer.notebook import explore
from .files import read, write
from .forces import Loads, Statics, statics
from .fourbar import FourBar, InvertedSliderCrank, SliderCrank
from .gears import Train
from .geneva import Geneva
from .geometry import coupler_curve
from .isomorphism import code, decode, is_isomorphic, symmetry
from .kinematics import Circuit, Motion, circuit, from_degrees, move, move_many
from .kinematics.solve import assembly_modes
from .linkages import Linkage
from .mechanism import Mechanism
from .mechanism.inversion import driven_mechanisms, inversions
from .mobility import mobility_report
from .pictures import animate, draw, plot
from .realisation.realise import realise
from .screws import SpatialLinkage, freedoms
from .synthesis import synthesise
from .transformations import derive, extend
from .type_synthesis import Requirements, variants

__version__: str

__all__ = [
    "Cam",
    "Chain",
    "Circuit",
    "FourBar",
    "Geneva",
    "GrueblerError",
    "InvertedSliderCrank",
    "Joint",
    "Linkage",
    "Loads",
    "Measures",
    "Mechanism",
    "Motion",
    "Requirements",
    "SliderCrank",
    "SpatialLinkage",
    "Statics",
    "Train",
    "UnitWarning",
    "animate",
    "assembly_modes",
    "assur",
    "assur_groups",
    "atlas",
    "cams",
    "catalog",
    "chain",
    "chains",
    "circuit",
    "code",
    "count_chains",
    "coupler_curve",
    "decode",
    "decompose",
    "derive",
    "draw",
    "drawing",
    "drive_range",
    "driven_mechanisms",
    "enumeration",
    "errors",
    "explore",
    "explorer",
    "extend",
    "forces",
    "formats",
    "fourbar",
    "freedoms",
    "from_degrees",
    "gears",
    "geneva",
    "geometry",
    "inversions",
    "is_isomorphic",
    "isomorphism",
    "kinematics",
    "linkages",
    "measures",
    "mechanism",
    "mobility",
    "mobility_report",
    "motion_roles",
    "move",
    "move_many",
    "notebook",
    "plot",
    "read",
    "realisation",
    "realise",
    "rotatability",
    "screws",
    "statics",
    "symmetry",
    "synthesis",
    "synthesise",
    "teaching",
    "text",
    "transformations",
    "type_synthesis",
    "variants",
    "write",
]
