"""How a value shows itself in a notebook: the front door puts the drawing here, so that no value imports upward."""

from __future__ import annotations

from collections.abc import Callable

__all__ = ["picture"]

picture: Callable[[object], str] | None = None
"""Makes the SVG of a chain, mechanism, linkage or motion; None until the front door has set it."""
