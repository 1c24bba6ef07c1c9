"""The four-bar, the slider-crank and the inverted slider-crank in closed form.

Types (`grashof`), dead centres, transmission angles, motion: docs/theory/four-bar.md.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
