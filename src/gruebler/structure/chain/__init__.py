"""Kinematic chains, joints and pairs: the values on which all other rooms build."""

from gruebler.structure.chain.joint import Joint
from gruebler.structure.chain.model import Chain

__all__ = ["Chain", "Joint"]
