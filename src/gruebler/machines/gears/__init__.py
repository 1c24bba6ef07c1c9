"""Gear trains: meshes, one linear system for all speeds, exact ratios, torques and power, assembly of planets."""

from gruebler.machines.gears.assemblies import Assembly, assembly
from gruebler.machines.gears.motion import Balance, Contradiction, Speeds, balance, influence, ratio, speeds
from gruebler.machines.gears.ratio_search import PlanetaryDesign, search_ratio
from gruebler.machines.gears.reading import TrainReading, read_toml, read_train
from gruebler.machines.gears.train import KINDS, GearError, Mesh, Train, Unit

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
    "influence",
    "ratio",
    "read_toml",
    "read_train",
    "search_ratio",
    "speeds",
]
