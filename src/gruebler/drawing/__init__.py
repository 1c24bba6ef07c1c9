"""Pictures, in four folders.

canvas: figures and files; machines: cams, Geneva drives, gears; structure: chains and mechanisms; linkage: linkages to
scale, animations, plots.
"""
