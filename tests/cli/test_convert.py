"""`gruebler convert`: files of other programs on the command line."""

import re
import shutil
from pathlib import Path

import pytest

from gruebler.cli import main
from gruebler.cli.linkage_inputs import linkage_of_word
from gruebler.files.linkages import read_loaded
from gruebler.files.load_writing import loads_to_json
from gruebler.files.values import FORMATS, FormatWarning, read, write
from gruebler.mechanics.fourbar import FourBar
from gruebler.structure.isomorphism import code
from gruebler.teaching.catalog import entry

FILES = Path(__file__).parents[1] / "files" / "samples"


def test_a_leg_goes_through_three_programs(tmp_path, capsys):
    assert main(["convert", str(FILES / "klann.linkage2"), str(tmp_path / "klann.toml")]) == 0
    said = capsys.readouterr().err
    assert "Left out" not in said
    assert 'speed = "1.5707963267949 rad/s"' in (tmp_path / "klann.toml").read_text()  # 15 rpm
    assert main(["convert", str(tmp_path / "klann.toml"), str(tmp_path / "klann.json"), "--to", "pylinkage"]) == 0
    assert main(["convert", str(tmp_path / "klann.json"), str(tmp_path / "klann.pyslvs")]) == 0
    leg, other = read(tmp_path / "klann.toml", left_out=[]), read(tmp_path / "klann.pyslvs", left_out=[])
    assert other.mechanism.code() == leg.mechanism.code()


def test_the_formats_are_listed(capsys):
    assert main(["convert", "--formats"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == len(FORMATS) + 1
    assert [line.split()[0] for line in lines[1:]] == [form.name for form in FORMATS]


@pytest.mark.parametrize(
    ("word", "lost"),
    [
        ("compressor", ["loads", "masses", "the speed of the drive"]),
        ("hood", ["loads", "masses"]),  # no speed is known
        ("wiper", ["loads", "masses", "the speed of the drive"]),
    ],
)
def test_loads_go_with_the_linkage(word, lost, tmp_path, monkeypatch, capsys):
    """Curves and a speed, gas springs, bars: from the catalog and from file to file; other programs lack them."""
    monkeypatch.chdir(tmp_path)
    assert main(["convert", word, "a.toml"]) == main(["convert", "a.toml", "b.json"]) == 0
    assert "Left out" not in capsys.readouterr().err
    with pytest.warns(FormatWarning, match="a.toml: not read: loads, masses"):
        read("a.toml")
    expected = entry(word).loaded()
    for name in ("a.toml", "b.json"):
        found = read_loaded(name)
        assert [found[0], found[2]] == [expected[0], expected[2]]
        assert loads_to_json(found[1], found[0]) == loads_to_json(expected[1], expected[0])
    for source in (word, "a.toml"):
        assert main(["convert", source, "c.mjcf"]) == 0
        said = re.findall("^Left out: (.*)$", capsys.readouterr().err, re.M)
        assert [what for what in said if "outputs" not in what] == lost


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["a.linkage2"], "name the file to read and the file to write"),
        (["wiper", "b.toml", "-o", "c.toml"], "name the file to read and the file to write"),
        (["a.linkage2", "b.toml"], "cannot be read"),
        (["a.bmp", "b.toml"], "expected .toml"),
        (["a.toml", "b.toml", "--from", "pyslv"], "did you mean 'pyslvs'?"),
        (["wipper", "b.toml"], "did you mean wiper?"),
        (["four-bars:1,2,3,4", "b.toml"], "did you mean 'four-bar'?"),
        (["four-bar:1,2,3", "b.toml"], "expected a,b,c,d"),
    ],
)
def test_wrong_usage_is_one_sentence(words, said, capsys):
    assert main(["convert", *words]) == 2
    assert said in capsys.readouterr().err


@pytest.mark.parametrize(
    ("word", "lengths"),
    [("four-bar:25,70,40,70.5", [25, 70, 40, 70.5]), ("25,70,40,70.5", [25, 70, 40, 70.5]), ("wiper", None)],
)
def test_lengths_and_entries_are_converted_as_files_are(word, lengths, tmp_path, monkeypatch):
    """Every command that takes the file of a linkage takes these."""
    monkeypatch.chdir(tmp_path)
    assert main(["convert", word, "a.toml"]) == main(["convert", word, "-o", "b.toml"]) == 0
    linkage = read("a.toml", left_out=[])
    assert read("b.toml", left_out=[]) == linkage
    assert linkage.mechanism.code() == linkage_of_word(word)[0].mechanism.code()
    if lengths is not None:
        sides = zip(["crank", "coupler", "rocker", "frame"], [(0, 1), (1, 2), (2, 3), (0, 3)], strict=True)
        assert [linkage.length(link, *pins) for link, pins in sides] == pytest.approx(lengths)
    assert main(["convert", word, "a.graphml"]) == 0
    assert code(read("a.graphml")) == code(linkage.mechanism.chain)


def test_a_chain_is_converted_into_a_graph(tmp_path, capsys):
    path = tmp_path / "a.graphml"
    for word, links in (("R(0-1) R(1-2) R(2-3) R(3-0)", 4), ("winch_screw", 3)):
        assert main(["convert", word, str(path)]) == 0
        assert read(path).n == links
    assert main(["convert", "R(0-1) R(1-2) R(2-3) R(3-0)", str(tmp_path / "a.mjcf")]) == 2
    assert "has no dimensions" in capsys.readouterr().err


def test_a_file_is_not_written_over_itself(tmp_path, capsys):
    path = tmp_path / "a.txt"
    path.write_text("R(0-1) R(1-2) R(2-3) R(3-0)\n", encoding="utf-8")
    assert main(["convert", str(path), str(path)]) == 2
    assert "overwrite itself" in capsys.readouterr().err
    assert path.read_text(encoding="utf-8").startswith("R(0-1)")


def test_a_linkage_with_points_is_no_task(tmp_path):
    """The key ``points`` is of tasks, too."""
    linkage = FourBar(25, 70, 40, 70).linkage({"K": (45, 40)})
    for suffix in (".toml", ".json"):
        assert read(write(linkage, tmp_path / f"a{suffix}")) == linkage


OTHERS = [
    "klann.linkage2",
    "jansen.pyslvs",
    "shaper.pmks",
    "mkh1.ron",
    "motiongen-rrpr.json",
    "pylinkage-four-bar.json",
]


@pytest.mark.parametrize("name", OTHERS)
@pytest.mark.parametrize("command", [["assur"], ["check", "--json"], ["analyse", "--json"], ["inversions"]])
def test_commands_read_files_of_other_programs_as_they_read_the_converted_file(command, name, tmp_path, capsys):
    """The same output, to the letter, apart from the name of the file."""
    shutil.copy(FILES / name, tmp_path / name)
    own = tmp_path / f"{Path(name).stem}.toml"
    write(read(tmp_path / name, left_out=[]), own)
    printed = []
    for path in (tmp_path / name, own):
        status = main([*command[:1], str(path), *command[1:]])
        captured = capsys.readouterr()
        printed.append((status, captured.out.replace(str(path), "FILE")))
        said = captured.err.splitlines()
        assert len(said) == len(set(said))
    assert printed[0] == printed[1]
    assert printed[0][1]


def test_a_file_of_chains_is_no_linkage(tmp_path, capsys):
    path = tmp_path / "chain.graphml"
    write(FourBar(25, 70, 40, 70).linkage().mechanism.chain, path)
    assert main(["check", str(path)]) == 0
    assert main(["inversions", str(path)]) == 0
    assert main(["analyse", str(path)]) == 2
    assert "has chains without dimensions" in capsys.readouterr().err
