from .assemblies import Assembly, assembly
from .mesh_kinds import KINDS, MeshKind, Unit
from .motion import Balance, Contradiction, Speeds, balance, influence, ratio, speeds
from .ratio_search import PlanetaryDesign, search_ratio
from .reading import TrainReading, read_toml, read_train
from .train import GearError, Mesh, Train

__all__ = [
    "KINDS",
    "Assembly",
    "Balance",
    "Contradiction",
    "GearError",
    "Mesh",
    "MeshKind",
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
