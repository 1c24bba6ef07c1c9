"""The built front end is what its sources give; its German is complete; its lock file names no registry."""

import gzip
import importlib.util
import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SOURCES = ROOT / "explorer"
BUILT = ROOT / "src/gruebler/page/static/explorer.js"

pytestmark = pytest.mark.skipif(not SOURCES.is_dir(), reason="the sources of the front end are not here")


def run(program: str, *arguments: str) -> None:
    command = (shutil.which(program) or program, *arguments)  # a script has another name on Windows
    done = subprocess.run(command, cwd=SOURCES, capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.fixture(scope="module")
def tools() -> None:
    if shutil.which("npm") is None:
        pytest.skip("building the front end needs node and npm")
    wanted = (".bin/biome", ".bin/tsc", "@gfx/zopfli", "axe-core")
    if not all((SOURCES / "node_modules" / tool).exists() for tool in wanted):
        run("npm", "ci", "--no-audit", "--no-fund", "--ignore-scripts")


@pytest.mark.usefixtures("tools")
def test_types_linter_and_formatter_find_nothing():
    run("npm", "run", "--silent", "check")  # no circle of imports either


@pytest.mark.usefixtures("tools")
def test_the_parts_of_the_front_end():
    run("npm", "test")  # explorer/test


@pytest.mark.usefixtures("tools")
def test_the_built_file_is_what_the_sources_give(tmp_path):
    run("node", "build.mjs", str(tmp_path))
    assert (tmp_path / "explorer.js").read_text(encoding="utf-8") == BUILT.read_text(encoding="utf-8"), (
        "run `npm ci && npm run build` in explorer/ and commit src/gruebler/page/static/explorer.js"
    )
    for name in ("explorer.css", "motion.txt", "points.js", "site.js", "space.css", "space.js", "texts.txt"):
        assert (tmp_path / name).read_bytes() == (BUILT.parent / name).read_bytes(), name


SIGNS = "".join(chr(code) for code in range(1, 128) if chr(code) not in '"<\\\n\r')


def bytes_of(text: str) -> bytes:
    """What stands in a text of 122 signs, as `written` of build.mjs makes it: 97 bytes in 112 of them."""
    out = b""
    for start in range(0, len(text), 112):
        value = 0
        for sign in text[start : start + 112]:
            value = len(SIGNS) * value + SIGNS.index(sign)
        out += value.to_bytes(len(text[start : start + 112]) - 15, "big")
    return out


def test_the_modules_of_the_kernels_are_made_of_these_sources():
    """They are committed, as the built page is, since compiling them takes a compiler of its own."""
    spec = importlib.util.spec_from_file_location("page_build", ROOT / "core/page/build.py")
    assert spec is not None
    assert spec.loader is not None
    build = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(build)
    texts = re.findall('"([^"<\\\\]{9000,})"', (BUILT.parent / "points.js").read_text(encoding="utf-8"))
    for each in build.MODULES:
        packed = each.target.read_bytes()
        module = gzip.decompress(packed)
        assert module.startswith(b"\0asm\1\0\0\0")
        assert module.endswith(build.SECTION + build.digest(each)), "run `make page` and commit what it makes"
        assert packed in [bytes_of(text) for text in texts]
        assert b"wasi_snapshot" not in module  # it asks nothing of its host


def test_the_page_stays_small():
    assert len(BUILT.read_bytes()) <= 220_000
    assert len(BUILT.with_name("texts.txt").read_bytes()) <= 10_000  # both languages
    assert len(gzip.compress(BUILT.with_suffix(".css").read_bytes(), 9)) <= 7_000


def test_the_lock_file_names_no_address():
    lock = json.loads((SOURCES / "package-lock.json").read_text(encoding="utf-8"))
    assert "http" not in json.dumps(lock["packages"])
    assert all("integrity" in package for name, package in lock["packages"].items() if name)


def test_no_line_is_longer_than_120():
    files = [*SOURCES.glob("*.mjs"), *SOURCES.glob("src/**/*.ts"), *SOURCES.glob("test/*.ts")]
    longest = {file.name: max(map(len, file.read_text(encoding="utf-8").splitlines())) for file in files}
    assert {name: long for name, long in longest.items() if long > 120} == {}  # the formatter leaves texts as they are


def test_every_text_has_its_german():
    said = set()
    for source in SOURCES.glob("src/**/*.ts"):
        text = re.sub(r'" \+\n *"', "", source.read_text(encoding="utf-8"))  # texts of more than one line
        said |= {json.loads(f'"{one}"') for one in re.findall(r'\bt\(\s*"((?:[^"\\]|\\.)*)"', text)}
    german = json.loads((SOURCES / "src/de.json").read_text(encoding="utf-8"))
    assert set(german) == said
    for english, other in german.items():
        assert sorted(re.findall(r"\{\w+\}", english)) == sorted(re.findall(r"\{\w+\}", other)), english


def test_the_module_asks_for_nothing():
    built = BUILT.read_text(encoding="utf-8")
    assert set(re.findall(r"https?://[^\"'`\s)]+", built)) <= {"http://www.w3.org/2000/svg"}
    assert not re.search(r"\bimport\s*\(|\bimport\s*[\"']|\beval\(|new Function", built)
