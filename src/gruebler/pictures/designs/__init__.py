"""Pictures of designs: the linkage at its targets, plots of the search, Alt's construction."""
