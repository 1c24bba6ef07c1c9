"""The usual lengths put on any mechanism of the same structure, its links named and ordered as they may be."""

from __future__ import annotations

from itertools import pairwise

from gruebler.base.errors import LinkageError
from gruebler.mechanics.fourbar.length_texts import ClosedForm
from gruebler.mechanics.linkages.branch import Branch, branch_side
from gruebler.mechanics.linkages.model import Linkage
from gruebler.structure.mechanism import Mechanism


def linkage_on_mechanism(
    form: str,
    lengths: ClosedForm,
    branch: Branch,
    mechanism: Mechanism | None,
    *,
    unit: str,
    outputs: tuple[str, ...] | None,
) -> Linkage:
    """The linkage of a door on a mechanism, or as the door brings it if there is none.

    The crank of a four-bar is the link driven at the frame, else the one that the chain joins to the frame first; that
    of the others is the link between two turning joints. Raises `LinkageError` for another structure.
    """
    own = lengths.linkage(unit=unit)
    if mechanism is None:
        mechanism, loop = own.mechanism, own.mechanism.chain.links
        outputs = own.outputs if outputs is None else outputs
    else:
        loop = _loop(mechanism, own.mechanism, form)
    rank = dict(zip(own.mechanism.chain.links, loop, strict=True))
    elements: dict[str, dict[str | int, object]] = {link: {} for link in loop}
    for (number, link), element in own.elements.items():
        sides = {rank[side] for side in own.mechanism.chain.joints[number].links}
        joint_number = next(k for k, joint in enumerate(mechanism.chain.joints) if set(joint.links) == sides)
        elements[rank[link]][joint_number] = element
    places = None if mechanism is own.mechanism and branch_side(branch) == 1 else _home(lengths, branch)
    reference_pose = None if places is None else dict(zip(loop, places, strict=True))
    return Linkage(mechanism, elements, unit=unit, reference_pose=reference_pose, outputs=outputs or ())


def _loop(mechanism: Mechanism, usual: Mechanism, form: str) -> tuple[str, ...]:
    """The four links in the order of the usual mechanism, from the frame over the crank."""
    chain, frame = mechanism.chain, mechanism.frame
    pairs = {frozenset(joint.links): joint.pair for joint in chain.joints}
    wanted = [joint.pair for joint in usual.chain.joints]
    driven = [drive.joint for drive in mechanism.drives]
    firsts = sorted((n not in driven, n) for n, joint in enumerate(chain.joints) if frame in joint.links)
    for _, number in firsts:
        loop = [frame]
        step = chain.joints[number].links
        while len(loop) < 5 and len(step) == 2:
            loop.append(step[0] if step[1] == loop[-1] else step[1])
            further = [joint.links for joint in chain.joints if loop[-1] in joint.links and joint.links != step]
            step = further[0] if len(further) == 1 else ()
        sides = [frozenset(pair) for pair in pairwise(loop)]
        if chain.n == len(pairs) == 4 and loop[-1] == frame and [pairs[side] for side in sides] == wanted:
            return tuple(loop[:-1])
    text = chain.text()
    shown = text if len(text) < 120 else text[:117] + "..."
    raise LinkageError(
        "{form} needs four links in a loop with joints {loops}, from the frame over the crank; found {shown}",
        form=form,
        loops="".join(pair.symbol() for pair in wanted),
        shown=shown,
    )


def _home(door: ClosedForm, branch: Branch) -> tuple[tuple[float, float, float], ...] | None:
    """Where frame, crank, coupler and output lie in one position, away from dead centres; None if there is none."""
    if not door.limits:
        return None
    arc = door.limits[0]
    phi = 1.0 if arc.full else arc.start + 0.4 * arc.width
    pose = door.motion(phi, branch=branch)
    a = [float(v) for v in pose.A.value]
    theta = float(pose.coupler.value)
    return (0.0, 0.0, 0.0), (0.0, 0.0, phi), (a[0], a[1], theta), door.output_place(pose)
