"""An atlas as files: interrupted and resumed, damaged, foreign, too new; opened and queried."""

import csv
import json
import os
import random
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import fields
from pathlib import Path

import pyarrow.compute as pc
import pyarrow.parquet as pq
import pytest

import gruebler as gr
from gruebler.base.errors import GrueblerError, RunError
from gruebler.cli import main
from gruebler.structure.atlas import AtlasTask, build
from gruebler.structure.atlas.reading import SMALL
from gruebler.structure.enumeration.worker_pool import ProcessPools
from gruebler.structure.isomorphism import decode
from tests.structure.atlas.making_small import make_small_atlas

TASK = AtlasTask(links="4-8", inversions=True, drives="frame")


def contents(directory):
    return {
        str(path.relative_to(directory)): path.read_bytes() for path in sorted(directory.rglob("*")) if path.is_file()
    }


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    directory = tmp_path_factory.mktemp("atlas") / "whole"
    build(TASK, directory)
    return directory


@pytest.mark.parametrize("most", [8, pytest.param(10, marks=pytest.mark.slow)])
def test_the_small_atlas_is_the_one_that_the_script_makes(tmp_path, most):
    """Row by row: the bytes depend on the version of pyarrow as well."""
    make_small_atlas(tmp_path, most)
    assert {path.name for path in tmp_path.iterdir()} == {path.name for path in SMALL.iterdir()}
    for table in gr.structure.atlas.open().tables:
        made, shipped = (pq.read_table(folder / f"{table}.parquet") for folder in (tmp_path, SMALL))
        shipped = shipped.filter(pc.field("links") <= most)
        assert made.num_rows
        assert made.equals(shipped)
        assert made.schema.equals(shipped.schema)
    assert sum(path.stat().st_size for path in SMALL.iterdir()) < 1_000_000


def test_any_executor_makes_the_same_files(whole, tmp_path):
    with ThreadPoolExecutor(2) as pool:
        build(TASK, tmp_path / "threads", executor=pool)
    build(TASK, tmp_path / "processes", executor=ProcessPools(2))
    assert contents(tmp_path / "threads") == contents(tmp_path / "processes") == contents(whole)


def test_a_build_goes_on_with_what_is_there(whole, tmp_path):
    """Missing and damaged files are made again, and nothing else."""
    build(TASK, tmp_path)
    parts = sorted(tmp_path.rglob("*.parquet"))
    parts[0].unlink()
    damaged = bytearray(parts[-1].read_bytes())
    damaged[len(damaged) // 3] ^= 0xFF
    parts[-1].write_bytes(bytes(damaged))
    parts[2].write_bytes(parts[2].read_bytes()[:-100])
    kept = {path: path.stat().st_mtime_ns for path in parts[4:-1]}
    build(TASK, tmp_path)
    assert contents(tmp_path) == contents(whole)
    assert sum(path.stat().st_mtime_ns == before for path, before in kept.items()) >= len(kept) - 3


def _killed_and_resumed(task, directory, moments):
    command = [sys.executable, "-m", "gruebler", *task.command().split()[1:-1], str(directory), "--yes"]
    for moment in moments:
        running = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(moment)
        running.kill()
        running.wait()
    subprocess.run(command, check=True, capture_output=True)


def test_a_killed_build_ends_as_an_undisturbed_one(whole, tmp_path):
    moments = random.Random(4)
    _killed_and_resumed(TASK, tmp_path / "killed", [moments.uniform(0.3, 2.0) for _ in range(2)])
    assert contents(tmp_path / "killed") == contents(whole)


@pytest.mark.slow
def test_a_hundred_kills(tmp_path):
    task = AtlasTask(links="12-13", mobility="1-2")
    build(task, tmp_path / "whole")
    moments = random.Random(5)
    _killed_and_resumed(task, tmp_path / "killed", [moments.uniform(0.5, 4.0) for _ in range(100)])
    assert contents(tmp_path / "killed") == contents(tmp_path / "whole")


def test_other_directories_are_left_alone(whole, tmp_path):
    (tmp_path / "letter.txt").write_text("dear", encoding="utf-8")
    with pytest.raises(RunError, match=r"holds other files, such as letter\.txt"):
        build(TASK, tmp_path)
    assert contents(tmp_path) == {"letter.txt": b"dear"}
    before = contents(whole)
    with pytest.raises(RunError, match="holds another atlas"):
        build(AtlasTask(links="4-6"), whole)
    assert contents(whole) == before


def test_a_file_of_another_atlas_is_refused(whole, tmp_path):
    build(AtlasTask(links="4-8"), tmp_path)
    path = "chains/mobility=1/links=8/part-00000.parquet"
    (tmp_path / path).write_bytes((whole / path).read_bytes())
    with pytest.raises(RunError, match="is not a file of this atlas"):
        build(AtlasTask(links="4-8"), tmp_path)


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        (lambda m: m | {"schema": 99}, "made by a newer version of gruebler: its schema is 99"),
        (lambda m: m | {"complete": False}, "is not complete; `gruebler atlas build --links 4-8"),
        (lambda m: m | {"kind": "letter"}, "is not the manifest of an atlas"),
        (lambda m: [m], "is not the manifest of an atlas"),
        (lambda m: m | {"tables": {"letters": {}}}, "is not the manifest of an atlas"),
    ],
)
def test_manifests_that_cannot_be_used(whole, tmp_path, change, problem):
    (tmp_path / "manifest.json").write_text(
        json.dumps(change(json.loads((whole / "manifest.json").read_bytes()))), encoding="utf-8"
    )
    with pytest.raises(RunError, match=problem):
        gr.structure.atlas.open(tmp_path)


def test_a_damaged_file_is_named_in_a_sentence(tmp_path):
    """The first file is read for its columns, the others with the query; building again restores them."""
    task = AtlasTask(links="4-6")
    build(task, tmp_path)
    parts = sorted(tmp_path.rglob("*.parquet"))
    for part in parts:
        content = part.read_bytes()
        part.write_bytes(b"dear")
        with pytest.raises(GrueblerError, match=f"{part.name}.*too small to be a Parquet file") as caught:
            gr.structure.atlas.open(tmp_path).query("select sum(links) from chains")
        assert "\n" not in str(caught.value)
        build(task, tmp_path)
        assert part.read_bytes() == content


def test_what_is_missing_is_named(whole, tmp_path):
    with pytest.raises(RunError, match="is not an atlas"):
        gr.structure.atlas.open(tmp_path)
    (tmp_path / "manifest.json").write_bytes((whole / "manifest.json").read_bytes())
    with pytest.raises(RunError, match=r"part-00000\.parquet is missing"):
        gr.structure.atlas.open(tmp_path).query("select 1")
    with pytest.raises(GrueblerError, match=r"no table 'chain' \(did you mean 'chains'\?\)"):
        gr.structure.atlas.open().files("chain")


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no limit for the size of files")
def test_a_full_disc_loses_nothing(whole, tmp_path):
    script = (
        "import resource, sys; resource.setrlimit(resource.RLIMIT_FSIZE, (8000, 8000)); "
        "from gruebler.cli import main; sys.exit(main(sys.argv[1:]))"
    )
    words = [*TASK.command().split()[1:-1], str(tmp_path / "full")]
    run = subprocess.run(
        [sys.executable, "-c", script, *words],
        check=False,
        capture_output=True,
        text=True,
        # a compiled module would be cut off as well, and stay so
        env=os.environ | {"PYTHONDONTWRITEBYTECODE": "1"},
    )
    assert run.returncode == 2
    assert run.stderr.count("\n") == 1
    assert "cannot be written: File too large" in run.stderr
    assert not list((tmp_path / "full").rglob("*.partial"))
    build(TASK, tmp_path / "full")
    assert contents(tmp_path / "full") == contents(whole)


@pytest.mark.parametrize(
    ("values", "problem"),
    [
        (("x",), "links: expected a number or a range such as 4-10, but found 'x'"),
        (("8-4",), "links: the range 8-4 ends before it begins"),
        (("5",), "there is no chain of 5 links with mobility 1"),
        (("6", "1", "all", "many"), "multiple joints are a number"),
        (("4-6", "1", "none", "0", "8-9"), "no chain of 4-6 links has 8 sliding joints"),
    ],
)
def test_tasks_that_make_no_sense(values, problem):
    names = [field.name for field in fields(AtlasTask)]
    with pytest.raises(GrueblerError, match=problem):
        AtlasTask(**dict(zip(names, values, strict=False)))


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--links", "999", "--mobility", "2"], "999 links with mobility 2 make 498 loops"),
        (["--links", "1000", "--mobility", "1"], "1000 links with mobility 1 make 499 loops"),
        (["--links", "8", "--prismatic", "0-999"], "this takes about"),
    ],
)
def test_sizes_without_measure_are_refused_in_a_sentence(options, sentence, tmp_path, capsys):
    status = main(["atlas", "build", *options, str(tmp_path / "atlas")])
    assert (status, sentence in capsys.readouterr().err) == (2, True)


# --- opened ------------------------------------------------------------------------------------------


def test_the_manifest_has_counts_and_checksums(whole):
    from hashlib import sha256

    atlas = gr.structure.atlas.open(whole)
    for table in atlas.tables:
        files = atlas.manifest["tables"][table]["files"]
        assert [sha256((whole / f["path"]).read_bytes()).hexdigest() for f in files] == [f["sha256"] for f in files]
        assert (
            sum(pq.read_metadata(whole / f["path"]).num_rows for f in files) == atlas.manifest["tables"][table]["rows"]
        )
    row = atlas.manifest["tables"]["chains"]["partitions"][-1]
    count = gr.count_chains(8, orbits=True)
    assert row == {
        "mobility": 1, "links": 8, "rows": count.chains,
        "inversions": count.inversions, "joint_orbits": count.joint_orbits, "drives": count.drives,
    }  # fmt: skip


def test_values_of_rows():
    atlas = gr.structure.atlas.open()
    known = {gr.code(chain) for chain in gr.chains(8)}
    assert {gr.code(chain) for chain in atlas.chains("links = 8 and mobility = 1")} == known
    mechanisms = list(atlas.mechanisms("links = 6 and mobility = 1"))
    assert len(mechanisms) == 5
    driven = list(atlas.driven_mechanisms("links = 10 and not dyads_only limit 5"))
    assert all(gr.decompose(each.mechanism).groups[-1].class_number >= 2 for each in driven)
    assert all(max(g.class_number for g in gr.decompose(each.mechanism).groups) > 2 for each in driven)
    assert atlas.dataset("mechanisms").count_rows() == atlas.manifest["tables"]["mechanisms"]["rows"]


def test_rows_as_structures(tmp_path, capsys):
    """Every driven mechanism of six links with groups above class 2, and what the gallery makes of the lines."""
    sql = "select chain, frame, drives from driven where links = 6 and highest_class > 2"
    assert main(["atlas", "query", sql, "--structures"]) == 0
    lines = capsys.readouterr().out.splitlines()
    read = [gr.Mechanism.parse(line) for line in lines]
    assert lines
    known = {
        driven.mechanism.code()
        for chain in gr.chains(6)
        for driven in gr.driven_mechanisms(chain, fixed_only=True)
        if max(group.class_number for group in gr.decompose(driven.mechanism).groups) > 2
    }
    assert {mechanism.code() for mechanism in read} == known
    (tmp_path / "lines.txt").write_text("\n".join(lines), encoding="utf-8")
    page = tmp_path / "page.html"
    assert main(["gallery", str(tmp_path / "lines.txt"), "-o", str(page)]) == 0
    assert page.read_text(encoding="utf-8").count("<svg") >= len(lines)
    rows = list(gr.structure.atlas.open().structures("select code, links from chains where links = 6 and mobility = 1"))
    assert [gr.code(chain) for chain in rows] == [gr.code(chain) for chain in gr.chains(6)]
    capsys.readouterr()
    assert main(["atlas", "query", "select links from chains", "--structures"]) == 2
    assert "a query selects code, or chain" in capsys.readouterr().err


def test_commands_that_make_no_atlas():
    task = AtlasTask(
        links="4-8",
        mobility="1-2",
        fractionated="link",
        multiple_joints="any",
        prismatic="0-1",
        inversions=True,
        drives="any",
    )
    assert AtlasTask.of_command(task.command()) == task
    for text in ("", "gruebler atlas build DIR", "gruebler atlas build --links 4 --colour 3 DIR", "None"):
        with pytest.raises(GrueblerError, match="is not a command that builds an atlas"):
            AtlasTask.of_command(text)


def test_questions_of_the_small_atlas():
    atlas = gr.structure.atlas.open()
    from gruebler.structure.enumeration import contracted_graphs

    planar = {k for k, graph in enumerate(contracted_graphs(4)) if graph.is_planar}
    non_planar = atlas.query(
        "select code, contracted_graph from chains where links = 10 and mobility = 1 and not planar"
    )
    assert non_planar.num_rows == sum(
        row["contracted_graph"] not in planar
        for row in atlas.query("select * from chains where links = 10 and mobility = 1").to_pylist()
    )
    assert non_planar.num_rows
    dyads = atlas.query("select distinct chain from driven where links = 10 and dyads_only")
    grown = atlas.query("select code from chains where links = 10 and mobility = 1 and dyadic")
    assert set(dyads["chain"].to_pylist()) == set(grown["code"].to_pylist())
    assert grown.num_rows == 140
    largest = atlas.query("select max(group_order) g from chains where links = 8 and mobility = 1").to_pylist()[0]["g"]
    assert largest == max(gr.symmetry(chain).order for chain in gr.chains(8))


def test_a_wrong_query_is_answered_in_a_sentence():
    atlas = gr.structure.atlas.open()
    with pytest.raises(GrueblerError, match=r'cannot be answered: .*"colour" not found.*Candidate') as caught:
        atlas.query("select colour from chains")
    assert "\n" not in str(caught.value)
    with pytest.raises(GrueblerError, match="chains"):
        atlas.query("select * from chain")
    for statement in ("drop view chains", "copy (select 1) to 'x.csv'", "select 1; select 2", ""):
        with pytest.raises(GrueblerError, match="one statement that begins with select"):
            atlas.query(statement)


def test_polars_and_pandas():
    polars = pytest.importorskip("polars")
    frame = gr.structure.atlas.open().polars("chains").filter(polars.col("links") == 6).collect()
    assert frame.height == len(gr.structure.atlas.open().query("select 1 from chains where links = 6"))


# --- command -----------------------------------------------------------------------------------------


def test_the_command(tmp_path, capsys):
    directory = str(tmp_path / "six")
    assert main(["atlas", "build", "--links", "6", "--inversions", directory]) == 0
    assert capsys.readouterr().err == f"Written: {directory}, 2 chains\n"
    assert main(["atlas", "query", directory, "select frame_joints j, family from mechanisms order by all"]) == 0
    rows = [line.split(maxsplit=1) for line in capsys.readouterr().out.splitlines()]
    assert rows == [
        ["j", "family"], ["2", "Stephenson I"], ["2", "Stephenson II"], ["2", "Watt I"],
        ["3", "Stephenson III"], ["3", "Watt II"],
    ]  # fmt: skip
    assert main(["atlas", "query", "select code from chains where links = 6 and mobility = 1"]) == 0
    codes = capsys.readouterr().out.split()
    assert codes == [gr.code(chain) for chain in gr.chains(6)]
    for ending in ("csv", "json", "parquet", "txt"):
        path = tmp_path / f"out.{ending}"
        assert main(["atlas", "query", "select code, links from chains where links = 6", "-o", str(path)]) == 0
        assert capsys.readouterr().err.startswith(f"Written: {path}, ")
    rows = pq.read_table(tmp_path / "out.parquet").to_pylist()
    assert json.loads((tmp_path / "out.json").read_text()) == rows
    lines = (tmp_path / "out.csv").read_text().splitlines()
    assert lines[0] == "code,links"
    assert [line.rsplit(",", 1) for line in lines[1:]] == [[row["code"], str(row["links"])] for row in rows]
    assert all(decode(row["code"]).chain.n == 6 for row in rows)


def test_cells_are_written_as_python_writes_them(tmp_path, capsys):
    """Arrow's text of the types of an atlas, quotes where they are needed, other types; against csv and str."""
    sql = (
        "select * from (values (1, true, 'plain', [3, 4], 1.5, ['a', NULL]), (NULL, NULL, NULL, NULL, NULL, NULL), "
        "(-7, false, 'with, \"both\"', [], 1e20, []), (0, true, '', [5], 0.1, ['b', 'c'])) t(a, b, c, d, e, f)"
    )
    path = tmp_path / "cells.csv"
    for chosen in (sql, f"select a, d, b from ({sql})", f"select c from ({sql})", f"select a from ({sql})"):
        assert main(["atlas", "query", chosen, "-o", str(path)]) == 0
        rows = gr.structure.atlas.open().query(chosen).to_pylist()

        def text(value):
            if isinstance(value, list):
                return " ".join(map(text, value))
            return (
                {None: "", True: "true", False: "false"}[value]
                if value is None or isinstance(value, bool)
                else str(value)
            )

        with path.open(newline="", encoding="utf-8") as file:
            header, *written = csv.reader(file)
        assert header == list(rows[0])
        assert written == [[text(value) for value in row.values()] for row in rows]
        capsys.readouterr()
    assert path.read_text(encoding="utf-8") == 'a\n1\n""\n-7\n0\n'
    assert main(["atlas", "query", f"select c from ({sql})"]) == 0
    assert capsys.readouterr().out == 'plain\n\nwith, "both"\n\n'
    assert main(["atlas", "query", "select c from (select 1 c) where c > 1"]) == 0
    assert capsys.readouterr().out == ""


def test_columns_are_listed(capsys):
    assert main(["atlas", "columns", "--json"]) == 0
    listed = json.loads(capsys.readouterr().out)
    page = (Path(__file__).parents[3] / "docs/theory/atlas.md").read_text(encoding="utf-8")
    for column in listed:
        row = f"| {column['name']} | {column['type']} | {column['unit']} | {column['definition']} |"
        assert row in page
        assert column["table"] in page


def test_without_the_extra_one_sentence_names_it(tmp_path):
    script = (
        "import sys; sys.modules['pyarrow'] = sys.modules['duckdb'] = None; from gruebler.cli import main; "
        "sys.exit(main(sys.argv[1:]))"
    )
    for words in (["build", "--links", "6", str(tmp_path / "a")], ["query", "select 1"]):
        run = subprocess.run(
            [sys.executable, "-c", script, "atlas", *words], check=False, capture_output=True, text=True
        )
        assert run.returncode == 2
        assert run.stderr.startswith("gruebler atlas: ")
        assert "pip install 'gruebler[atlas]'" in run.stderr
        assert run.stderr.count("\n") == 1
