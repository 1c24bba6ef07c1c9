"""Teaching: the catalog of machines, exercises solved and marked, constructions, collection sheets, task sheets."""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
