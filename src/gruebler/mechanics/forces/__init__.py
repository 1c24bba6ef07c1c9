"""The static side of a linkage: what the drive and the joints carry when loads act, without masses in motion.

`Loads` are what acts, for statics and dynamics alike: forces, moments, `RigidBody`s, `Spring`s, `Motor`s.
`statics` solves the equilibrium of all links at every row of a motion, with Coulomb friction if asked, and sets the
drive's effort against the one that virtual work gives; `statics_table` has them as columns. docs/theory/statics.md.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
