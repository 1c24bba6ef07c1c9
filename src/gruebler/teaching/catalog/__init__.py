"""The machines and exercises of the teaching documents as data, with a check of every claim."""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
