"""Print the lowest versions that pyproject.toml allows, one `package==version` a line, as constraints for pip."""

import tomllib
from pathlib import Path

project = tomllib.loads((Path(__file__).parents[1] / "pyproject.toml").read_text(encoding="utf-8"))["project"]
extras = project["optional-dependencies"]
needed = [*project["dependencies"]]
for extra in ("atlas", "cad", "cluster", "notebook", "plot", "web"):
    needed += extras[extra]
tests = [line for line in extras["test"] if line.split(">=")[0] in {"hypothesis", "igraph", "pytest", "pytest-xdist"}]
print("\n".join(line.replace(">=", "==") for line in dict.fromkeys([*needed, *tests])))
