"""The kernel of the page against the kernel of the library: golden files for every planar machine of the catalog and
for 1,000 random linkages, executed by node."""

import json
import random
import shutil
import subprocess
from collections import Counter
from math import pi
from pathlib import Path

import numpy as np
import pytest

from gruebler.base.errors import GrueblerError
from gruebler.mechanics.kinematics.reference_pose import pose_at_reference
from gruebler.mechanics.kinematics.solve import cached_plan
from gruebler.mechanics.linkages import Linkage
from gruebler.pictures.linkage.posed_linkage import posed_linkage
from gruebler.structure.chain import Chain
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entries
from tests.page.golden_record import golden_record
from tests.strategies import GROUPS, parallelograms

BUILT = Path(__file__).parents[2] / "src/gruebler/page/static/explorer.js"

pytestmark = pytest.mark.skipif(shutil.which("node") is None, reason="the page's kernel needs node to be executed here")


def compared(records: list[dict], tmp_path: Path) -> list[dict]:
    file = tmp_path / "golden.jsonl"
    file.write_text("".join(json.dumps(record) + "\n" for record in records), encoding="utf-8")
    command = ["node", str(Path(__file__).parent / "golden.mjs"), str(BUILT), str(file)]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=300)
    found = [json.loads(line) for line in done.stdout.splitlines()]
    assert len(found) == len(records)
    return found


def check(name: str, record: dict, found: dict) -> None:
    """The same end and the same bits."""
    assert found["end"] == {what: record[what] for what in ("status", "reached", "at", "fault")}, name
    assert found["apart"] == {"places": 0, "rates": 0, "turns": 0}, name


def machines() -> list[str]:
    return [e.id for e in entries().values() if e.dimensions is not None and e.space == "planar"]


def test_every_planar_machine_of_the_catalog(tmp_path):
    names, records = [], []
    for name in machines():
        linkage = entries()[name].linkage()
        posed = posed_linkage(linkage)
        amounts = [2 * pi if drive.turning else 0.6 * posed.lower.size for drive in linkage.mechanism.drives]
        signs = np.where(posed.pose.roots[0] < 0, -1.0, 1.0)
        for way in (1, -1):
            steps = way * np.linspace(0, 1, 73)[:, None] / max(1, 3 * len(amounts) - 3)
            rows = posed.pose.drives[0] + steps * np.array(amounts)
            records.append(golden_record(linkage, rows, signs, posed.pose.unknowns[0].copy()))
            names.append(f"{name} {way:+}")
    found = compared(records, tmp_path)
    for name, record, one in zip(names, records, found, strict=True):
        check(name, record, one)
    assert len(machines()) >= 61
    assert sum(one["numbers"] for one in found) > 300_000


def built(rng: random.Random) -> Linkage:
    """A crank, then Assur groups attached anywhere, drawn at random places."""
    joints: list[tuple[str, list[str]]] = [("revolute", ["frame", "crank"])]
    links = ["frame", "crank"]
    for number in range(rng.randint(1, 3)):
        group = Chain.parse(rng.choice(GROUPS))
        names = {link: f"{number}.{link}" for link in group.links if link.isdigit()}
        for joint in group.joints:
            mine = [names[link] for link in joint.links if link in names]
            outside = [] if len(mine) == len(joint.links) else [rng.choice(links)]
            joints.append((joint.pair.name, [*outside, *mine]))
        links += names.values()
    mechanism = Mechanism(Chain(joints), "frame", [0])
    places: dict[int, object] = {}
    for number, (pair, members) in enumerate(joints):
        x, y = rng.uniform(-1, 1), rng.uniform(-1, 1)
        angle = rng.uniform(-pi, pi)
        if pair == "roll_slide":
            places[number] = (x, y, angle, rng.choice(members))
        else:
            places[number] = (x, y, angle) if pair == "prismatic" else (x, y)
    return Linkage.from_drawing(mechanism, places)


def test_four_hundred_random_linkages(tmp_path):
    rng = random.Random(16)
    records: list[dict] = []
    forms: Counter[str] = Counter()
    while len(records) < 400:
        try:
            linkage = built(rng)
            plan = cached_plan(linkage)
        except GrueblerError:
            continue
        begin = pose_at_reference(plan, np.zeros(1))
        rows = begin.drives + rng.choice((1, -1)) * np.linspace(0, pi / 3, 9)[:, None]
        records.append(golden_record(linkage, rows, begin.signs, begin.unknowns))
        forms.update(group.form() for group in plan.decomposition.groups)
    found = compared(records, tmp_path)
    for number, pair in enumerate(zip(records, found, strict=True)):
        check(f"random linkage {number}", *pair)
    assert {"RRR", "RRP", "RPR", "PRP", "RPP"} <= set(forms)
    assert sum(count for form, count in forms.items() if len(form) > 3) > 40
    stopped = sum(record["status"] != 0 for record in records)
    assert 40 < stopped < 360  # ranges that end are among them


def test_trains_of_parallelograms_pass_their_change_points_together(tmp_path):
    """Long rows and short ones, and change points at the same place, near one another or apart."""
    random = np.random.default_rng(20_261_122)
    records = []
    for bends in [(0, 0, 0), (1e-3, 0, 1e-3), (1e-2, 1.5, 0), (pi / 2, pi, 0.5)] * 10:
        linkage = parallelograms(random.uniform(0.5, 2, 4).tolist(), random.uniform(2.1, 4, 3).tolist(), list(bends))
        before, behind = 10 ** random.uniform(-6, -1, 2)
        rows = np.array([1, 2.5, 3, pi - before, pi + behind, pi + behind + 0.1, 5.5, 2 * pi + before, 7.5, 4, 1])
        begin = pose_at_reference(cached_plan(linkage), np.ones(1))
        records.append(golden_record(linkage, rows[:, None], begin.signs, begin.unknowns))
        assert records[-1]["status"] == 0
    for number, pair in enumerate(zip(records, compared(records, tmp_path), strict=True)):
        check(f"train {number}", *pair)
