"""What can be wrong with a question, each kind with a name of its own.

Every message says what was expected, what was found and, where there is one, the way out. A wrong call
raises; an honest failure (a budget spent, a proof not found) is a result and never one of these.
"""


class GrueblerError(ValueError):
    """The common parent: catching it catches every refusal of this library, and nothing else."""


class PairError(GrueblerError):
    """A kind of joint that is unknown, ambiguous, or not possible in the space."""


class NotationError(GrueblerError):
    """A text, code or JSON document that does not describe a chain."""


class ChainError(GrueblerError):
    """Links and joints that do not make a sound chain."""


class CatalogError(GrueblerError):
    """A catalog file or key that cannot be used; the message names both."""
