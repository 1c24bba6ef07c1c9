from .catalog_records import Case, ClaimedGroup, Claims, Entry, Exercise, read_entry, read_exercise
from .linkages import linkage_from_json, linkage_to_json, linkage_to_toml, read_linkage, read_loads, write_linkage
from .load_reading import loads_from_json
from .load_writing import loads_to_json
from .tasks import read_task, task_from_json, task_to_json, write_task
from .values import convert, read, write

__all__ = [
    "Case",
    "ClaimedGroup",
    "Claims",
    "Entry",
    "Exercise",
    "convert",
    "linkage_from_json",
    "linkage_to_json",
    "linkage_to_toml",
    "loads_from_json",
    "loads_to_json",
    "read",
    "read_entry",
    "read_exercise",
    "read_linkage",
    "read_loads",
    "read_task",
    "task_from_json",
    "task_to_json",
    "write",
    "write_linkage",
    "write_task",
]
