"""The solver: poses, velocities, accelerations, jerks of linkages, along any path of the drives.

`move` solves the groups of the Assur decomposition one after another and returns a `Motion`. `circuit` follows
all positions that are connected, all joints at once and without regard to the drive. Conventions, theorems and
what may err: docs/theory/kinematics.md, circuits.md, assembly-modes.md.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
