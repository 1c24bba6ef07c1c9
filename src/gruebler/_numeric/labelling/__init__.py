"""Canonical labelling of coloured multigraphs."""
