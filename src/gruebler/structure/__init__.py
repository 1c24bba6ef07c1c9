"""Structure: chains, mobility, isomorphism, mechanisms, enumeration, Assur groups, variants, the atlas, counts."""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
