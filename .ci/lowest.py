"""Print the lowest versions that pyproject.toml allows, one `package==version` a line, as constraints for pip.

What only the tests need stands there too; of it those that the tests are written for have their lowest version.
"""

import tomllib
from pathlib import Path

project = tomllib.loads((Path(__file__).parents[1] / "pyproject.toml").read_text(encoding="utf-8"))["project"]
extras = project["optional-dependencies"]
needed = [*project["dependencies"]]
for extra in ("atlas", "cad", "cluster", "notebook", "plot", "web"):
    needed += extras[extra]
lowest = {line.split(">=")[0] for line in needed} | {"hypothesis", "igraph", "pytest", "pytest-xdist"}
for line in dict.fromkeys([*needed, *extras["test"]]):
    print(line.replace(">=", "==") if line.split(">=")[0] in lowest else line)
