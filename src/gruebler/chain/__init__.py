"""Kinematic chains, joints and pairs: the values on which all other rooms build."""

from gruebler.chain.joint import Joint
from gruebler.chain.model import Chain

__all__ = ["Chain", "Joint"]
