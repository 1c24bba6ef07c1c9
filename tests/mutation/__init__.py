"""Mutants: one line of a room is changed at a time, and its tests should notice."""
