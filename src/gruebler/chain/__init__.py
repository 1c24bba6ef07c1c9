"""Kinematic chains and their joints."""

from gruebler.chain.joint import Joint
from gruebler.chain.model import Chain

__all__ = ["Chain", "Joint"]
