"""Every format that is read or written: linkages, screws, catalog entries, tasks, chains, other programs."""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
