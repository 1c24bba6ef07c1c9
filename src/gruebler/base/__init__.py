"""What every wing stands on: arrays, errors, texts in two languages, documents, files that appear whole, tables."""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
