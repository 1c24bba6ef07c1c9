"""Run all benchmarks, or those named."""

import sys
from importlib import import_module
from pathlib import Path

HERE = Path(__file__).parent


def main() -> int:
    names = sorted(path.stem for path in HERE.glob("*.py") if not path.stem.startswith("_") and path.stem != "tables")
    wanted = sys.argv[1:] or names
    strange = [name for name in wanted if name not in names]
    if strange:
        print(f"benchmarks: unknown benchmark {strange[0]!r}: expected {', '.join(names)}", file=sys.stderr)
        return 2
    for name in wanted:
        print(f"== {name}")
        import_module(f"benchmarks.{name}").main()
        print()
    return 0


sys.exit(main())
