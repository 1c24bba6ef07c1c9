"""Loops of the package rational-linkages, whose couplers move on rational curves of dual quaternions."""

import numpy as np
import pytest

from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.space import move
from gruebler.structure.mechanism import Mechanism


@pytest.mark.parametrize("model", ["bennett_ark24", "collisions_free_6r"])
def test_couplers_move_on_the_curves_of_rational_linkages(model):
    """Its curve is the identity at infinity; two factorisations are the two ways from the frame to the coupler."""
    models = pytest.importorskip("rational_linkages.models", reason="loops are compared with rational-linkages")
    mechanism = getattr(models, model)()
    one, other = (factors.dq_axes for factors in mechanism.factorizations)
    axes = [np.array([float(x) for x in factor.array()]) for factor in (*one, *other[::-1])]
    count = len(axes)
    places = {}
    for k, axis in enumerate(axes):
        way, moment = axis[1:4], -axis[5:]
        places[k] = {"at": np.cross(way, moment) / (way @ way), "z": way}
    text = " ".join(f"R({k}-{(k + 1) % count})" for k in range(count))
    linkage = SpatialLinkage(Mechanism.parse(f"spatial: {text}; drive=R(0-1)"), places)
    turns = -np.linspace(0.1, 1.5, 15)
    parameters = axes[0][0] - np.linalg.norm(axes[0][1:4]) / np.tan(turns / 2)
    motion = move(linkage, turns)
    assert motion.complete
    for pose, parameter in zip(motion.pose(str(len(one))), parameters, strict=True):
        wanted = np.array(type(one[0])(mechanism.evaluate(parameter).tolist()).dq2matrix(), float)
        assert pose[:3, :3] == pytest.approx(wanted[1:, 1:], abs=1e-9)
        assert pose[:3, 3] == pytest.approx(wanted[1:, 0], abs=1e-9 * linkage.size)
