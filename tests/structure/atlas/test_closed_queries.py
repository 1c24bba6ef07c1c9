"""A query reads the files of its atlas and nothing else, and takes a bounded amount of memory."""

import shutil

import pytest

pytest.importorskip("duckdb")

import gruebler.structure.atlas
from gruebler.base.errors import GrueblerError
from gruebler.cli import main
from gruebler.structure.atlas import reading


@pytest.fixture
def atlas(tmp_path):
    """An atlas beside a file that its queries must not read."""
    (tmp_path / "secret.csv").write_text("word\nhidden-word\n")
    shutil.copytree(reading.SMALL, tmp_path / "atlas's")
    return gruebler.structure.atlas.open(tmp_path / "atlas's")


@pytest.mark.parametrize(
    "query",
    [
        "select * from read_csv('{folder}/secret.csv')",
        "select * from read_text('{folder}/secret.csv')",
        "select * from '{folder}/secret.csv'",
        "select * from read_text('{folder}/atlas''s/../secret.csv')",
        "select * from glob('{folder}/*')",
        "select * from read_csv('http://localhost:9/x.csv')",
        "select * from read_csv('s3://bucket/x.csv')",
        "select * from hidden_table",
        "select current_setting('x') from chains; install httpfs",
        "from (values (1)) t, read_blob('{folder}/secret.csv')",
    ],
)
def test_nothing_else_is_read(atlas, query):
    hidden_table = atlas.query("select 'hidden-word' as word")  # variables of the program are not its tables
    assert hidden_table.num_rows == 1
    with pytest.raises(GrueblerError) as refused:
        atlas.query(query.format(folder=atlas.directory.parent))
    assert "hidden-word" not in str(refused.value)


def test_settings_cannot_be_opened_again(atlas):
    for wish in ("set enable_external_access = true", "set memory_limit = '10GB'", "load httpfs", "pragma threads = 1"):
        with pytest.raises(GrueblerError, match="one statement that begins with select"):
            atlas.query(wish)
    asked = "enable_external_access autoload_known_extensions autoinstall_known_extensions python_enable_replacements"
    for name in asked.split():
        rows = atlas.query(f"select value from duckdb_settings() where name = '{name}'").to_pylist()
        assert rows == [{"value": "false"}], name
    assert atlas.query("select value from duckdb_settings() where name = 'lock_configuration'").to_pylist() == [
        {"value": "true"}
    ]


def test_the_tables_of_the_atlas_are_read_all_the_same(atlas):
    assert atlas.query("select count(*) as n from chains where links = 10 and mobility = 1").to_pylist() == [{"n": 230}]


def test_large_answers_and_large_work_are_refused(atlas, monkeypatch):
    monkeypatch.setattr(reading, "LARGEST_ANSWER", 1_000_000)
    assert atlas.query("select * from range(100000)").num_rows == 100_000
    with pytest.raises(GrueblerError, match="larger than 1 MB"):
        atlas.query("select * from range(100000000000)")
    with pytest.raises(GrueblerError, match="needs more than 800 MB of memory"):
        atlas.query("select * from range(100000000000) order by range desc")


def test_cells_that_are_formulas(tmp_path, capsys):
    """In CSV a spreadsheet takes what begins with = + - @ for a formula; numbers and other files stay as they are."""
    query = "select '=1+1' as \"=h\", -5 as n, '@x' as z, '-a' as d, 'R(0-1)' as j"
    sheet, text = tmp_path / "a.csv", tmp_path / "a.txt"
    assert main(["atlas", "query", query, "-o", str(sheet)]) == 0
    assert sheet.read_text() == "'=h,n,z,d,j\n'=1+1,-5,'@x,'-a,R(0-1)\n"
    assert main(["atlas", "query", query, "-o", str(text)]) == 0
    assert text.read_text() == "=h,n,z,d,j\n=1+1,-5,@x,-a,R(0-1)\n"
    assert main(["atlas", "query", "select chr(27) || '[31m' as word"]) == 0
    assert capsys.readouterr().out == "\\x1b[31m\n"
