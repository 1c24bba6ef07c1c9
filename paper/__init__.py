"""The paper on what was counted: manuscript and what fills in its numbers."""
