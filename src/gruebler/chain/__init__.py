"""The waist of the house: chains and joints."""

from gruebler.chain.joint import Joint
from gruebler.chain.model import Chain

__all__ = ["Chain", "Joint"]
