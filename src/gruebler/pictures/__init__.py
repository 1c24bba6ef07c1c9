"""Pictures: figures and files (canvas), chains, linkages to scale and moving, machines, designs; `draw`, `plot`."""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
