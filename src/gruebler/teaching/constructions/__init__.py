"""The classical constructions of linkages, cams and Geneva drives as pictures, step by step.

Every construction is made with compass and ruler alone: `compass` has what these do. The values of the last step are
measured in the drawing; the tests compare them with the solver's.
"""

from gruebler.teaching.constructions.listing import CONSTRUCTIONS, construction, construction_forms

__all__ = ["CONSTRUCTIONS", "construction", "construction_forms"]
