"""What the pages of docs run with: `docs/builder/session.py`."""

import sys
from pathlib import Path

DOCS = Path(__file__).parents[1] / "docs"
sys.path.insert(0, str(DOCS))

from builder.session import Session, blocks_of  # noqa: E402  it stands in docs

__all__ = ["DOCS", "Session", "blocks_of"]
