"""The synthesis that the page does by itself, executed by node, against that of the library."""

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis import Demands, PathTask
from gruebler.design.synthesis.paths import synthesise_path
from gruebler.files import linkage_from_json
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics import move
from gruebler.page.model import model_of
from gruebler.page.site_points import point_packs
from tests.design.synthesis.test_points import REAL_TRIPLES, WAMPLER

BUILT = Path(__file__).parents[2] / "src/gruebler/page/static/points.js"
KNOWN = FourBar(25, 70, 40, 70).linkage({"P": (45, 40)})
TURNS = (10.0, 45, 80, 120, 155, 195, 240, 280, 330)

pytestmark = pytest.mark.skipif(shutil.which("node") is None, reason="the page needs node to be executed here")


def places(angles) -> list[list[float]]:
    return move(KNOWN, np.radians(angles)).point("P").tolist()


def found(tmp_path, tasks, *, crank=False, transmission=0.0):
    packs = dict(point_packs())
    question = {
        "tasks": tasks,
        "crank": crank,
        "transmission": transmission,
        "template": packs["points"]["template"],
        **packs["nine_points"],
    }
    file = tmp_path / "question.json"
    file.write_text(json.dumps(question), encoding="utf-8")
    command = ["node", str(Path(__file__).parent / "points.mjs"), str(BUILT), str(file)]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=300)
    return [json.loads(line) for line in done.stdout.splitlines()]


def lengths(linkage) -> list[float]:
    rows = (("crank", 0, 1), ("coupler", 1, 2), ("rocker", 2, 3), ("frame", 0, 3))
    point = linkage.points["P"]
    return [*(linkage.length(*row) for row in rows), point.x, point.y]


def test_the_designs_are_those_of_the_library(tmp_path):
    """Points of a known four-bar all round, and of a part of its turn the other way round."""
    tasks = [places(TURNS), places(range(10, 140, 15))[::-1]]
    for rows, said in zip(tasks, found(tmp_path, tasks), strict=True):
        library = synthesise_path(PathTask([tuple(row) for row in rows]))
        assert said["missing"] == 0
        assert said["real"] == library.count.real
        assert said["told"][-1] == [1442, 1442]
        assert said["found"]["total"] == len(library.designs) > 0
        here = [linkage_from_json(item["document"]) for item in said["found"]["items"]]
        for design in library.designs:
            wanted = lengths(design.linkage)
            gaps = [np.abs(np.subtract(lengths(one), wanted)).max() / design.linkage.size for one in here]
            item = said["found"]["items"][int(np.argmin(gaps))]
            assert min(gaps) < 1e-9
            # the library looks at poses on the way, the page where the crank is in line with the frame, too
            assert item["transmission"] == pytest.approx(np.degrees(design.verdict.transmission), abs=0.05)
            assert bool(item["model"]["span"]["turns"]) == design.verdict.turns_fully
    turning = found(tmp_path, tasks[:1], crank=True, transmission=30.0)[0]
    library = synthesise_path(
        PathTask([tuple(row) for row in tasks[0]]), Demands(crank=True, transmission=np.radians(30))
    )
    assert turning["found"]["total"] == len(library.designs) > 0


def test_each_design_is_carried_through_its_points_by_the_library(tmp_path):
    rows = places(TURNS)
    (said,) = found(tmp_path, [rows])
    # the four-bar that the points are of is among them
    assert any(
        np.allclose(lengths(linkage_from_json(i["document"])), [25, 70, 40, 70, 45, 40]) for i in said["found"]["items"]
    )
    for item in said["found"]["items"]:
        linkage = linkage_from_json(item["document"])
        poses = move(linkage, np.linspace(0, 2 * np.pi, 7201) + item["model"]["start"]["drives"][0])
        curve = poses.complex_point("P")
        for x, y in rows:
            assert np.abs(curve - complex(x, y)).min() < 0.1  # between two poses
        model = model_of(linkage)
        assert item["names"] == item["model"]["linkNames"]
        for key in ("elements", "points", "sources", "joints", "groups", "links", "linkNames"):
            assert json.loads(json.dumps(model[key])) == item["model"][key], key
        assert item["model"]["program"]["size"] == pytest.approx(model["program"]["size"])
        assert item["model"]["program"]["points"] == pytest.approx(model["program"]["points"])
        assert item["model"]["start"]["signs"] == model["start"]["signs"]


def test_a_published_task_has_its_real_solutions(tmp_path):
    (said,) = found(tmp_path, [WAMPLER])
    assert said["missing"] == 0
    assert said["real"] == REAL_TRIPLES


def test_points_that_no_curve_meets_are_refused(tmp_path):
    on_circle = [[np.cos(t), np.sin(t)] for t in np.linspace(0, 6, 8)]
    tasks = [
        [[float(k), 0.5 * k] for k in range(9)],
        [*on_circle, [3.0, 3.0]],
        [*places(TURNS[:8]), places(TURNS)[2]],
    ]
    for rows, said in zip(tasks, found(tmp_path, tasks), strict=True):
        with pytest.raises(SynthesisError) as refused:
            synthesise_path(PathTask([tuple(row) for row in rows]))
        ((what, number),) = said["fault"].items()
        text = {
            "line": f"{number} of the points lie on one line",
            "circle": f"{number} of the points lie on one circle",
        }
        equal = f"points {number[0]} and {number[1]} are equal" if what == "equal" else ""
        assert str(refused.value).startswith(text.get(what, equal))
