"""Gear trains: meshes, one linear system for all speeds, exact ratios, torques and power, assembly of planets."""

from gruebler.gears.assembly import Assembly, assembly
from gruebler.gears.messages import explain_train
from gruebler.gears.motion import Balance, Contradiction, Speeds, balance, influence, ratio, speeds
from gruebler.gears.ratio_search import PlanetaryDesign, search_ratio
from gruebler.gears.reading import TrainReading, read_toml, read_train
from gruebler.gears.train import KINDS, GearError, Mesh, Train, Unit

__all__ = [
    "KINDS",
    "Assembly",
    "Balance",
    "Contradiction",
    "GearError",
    "Mesh",
    "PlanetaryDesign",
    "Speeds",
    "Train",
    "TrainReading",
    "Unit",
    "assembly",
    "balance",
    "explain_train",
    "influence",
    "ratio",
    "read_toml",
    "read_train",
    "search_ratio",
    "speeds",
]
