"""The mechanism: a chain with one link fixed as frame and with drives.

A drive is a freedom of a joint, anywhere: a revolute at the frame, a cylinder between two moving links. Whether the
drives fix the motion is a question of generic rank with the drives locked (`check_drives`). `roles` names the links
(frame, crank, rocker, coupler, slider) as far as the structure determines them; whether a rocker turns fully depends
on the dimensions.
"""

from gruebler.structure.mechanism.drives import DriveReport, check_drives
from gruebler.structure.mechanism.inversion import DrivenMechanism, driven_mechanisms, inversions
from gruebler.structure.mechanism.link_roles import Role, roles
from gruebler.structure.mechanism.model import Drive, Mechanism

__all__ = [
    "Drive",
    "DriveReport",
    "DrivenMechanism",
    "Mechanism",
    "Role",
    "check_drives",
    "driven_mechanisms",
    "inversions",
    "roles",
]
