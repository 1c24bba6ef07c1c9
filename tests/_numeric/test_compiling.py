"""The choice of the tier, the cache of compiled kernels, and what is said while they are compiled."""

import ast
import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

import gruebler
from gruebler._numeric import compiling, kernel_cache
from gruebler._numeric.compiling import compiled, for_work, interpreted, njit, on_compiling, price
from gruebler._numeric.lanes import choose, complex_number, dot, give_back, lanes, square_root, subtract, taken, tally

NUMERIC = Path(gruebler.__file__).parent / "_numeric"


@pytest.fixture
def kernel_tier(monkeypatch: pytest.MonkeyPatch) -> None:
    """These tests choose for themselves."""
    monkeypatch.delenv("GRUEBLER_KERNELS", raising=False)
    monkeypatch.delenv("NUMBA_DISABLE_JIT", raising=False)


def test_every_kernel_is_compiled_by_our_decorator() -> None:
    for path in NUMERIC.rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        if path.name != "compiling.py":
            assert not re.search(r"^from numba|^import numba|numba\.njit", text, re.MULTILINE), path.name
        assert "@njit" not in text or "cache=True" in text or path.name == "lanes.py", path.name


# --- the tier ----------------------------------------------------------------------------------------


@njit(cache=True)
def _tripled(n: int) -> int:
    return 3 * n


@njit(cache=True)
def _both(n: int) -> int:
    """Calls another kernel, and itself."""
    return _tripled(n) if n < 5 else _both(n - 5) + 15


def test_a_kernel_is_a_plain_function() -> None:
    assert _both(7) == 21
    assert type(_both) is type(test_a_kernel_is_a_plain_function)
    assert compiled(_both)(7) == 21
    assert compiled(_both) is compiled(_both)
    assert compiled(_both).signatures  # type: ignore[attr-defined]


def test_little_work_is_interpreted_and_much_is_compiled(monkeypatch: pytest.MonkeyPatch) -> None:
    @njit()
    def kernel(n: int) -> int:
        return n

    monkeypatch.setattr(compiling, "price", lambda _: 1.0)
    assert for_work(kernel, 0.4) is interpreted(kernel)
    assert for_work(kernel, 0.4) is interpreted(kernel)
    assert for_work(kernel, 0.4) is compiled(kernel)  # together they are worth it
    assert for_work(_tripled, 2.0) is compiled(_tripled)


def test_the_price_falls_when_a_kernel_lies_in_the_cache_or_is_there(monkeypatch: pytest.MonkeyPatch) -> None:
    from gruebler._numeric.motion.newton import factor
    from gruebler._numeric.motion.path import walk_path

    monkeypatch.setattr(compiling, "_dispatchers", {})
    monkeypatch.setattr(compiling, "is_cached", lambda _: False)
    fresh = price(factor)
    assert price(walk_path) > 2 * fresh
    monkeypatch.setattr(compiling, "is_cached", lambda _: True)
    assert price(factor) == price(walk_path) < fresh
    monkeypatch.undo()
    compiled(_tripled)(1)
    assert price(_tripled) == 0


@pytest.mark.parametrize("tier", ["interpreted", "compiled"])
def test_the_environment_decides(tier: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GRUEBLER_KERNELS", tier)
    for seconds in (0.0, 1e9):
        assert for_work(_tripled, seconds) is getattr(compiling, tier)(_tripled)
    monkeypatch.setenv("NUMBA_DISABLE_JIT", "1")
    assert for_work(_tripled, 1e9) is interpreted(_tripled)
    monkeypatch.delenv("NUMBA_DISABLE_JIT")
    monkeypatch.setenv("GRUEBLER_KERNELS", "fast")
    with pytest.raises(ValueError, match="expected auto, interpreted or compiled, but found 'fast'"):
        for_work(_tripled, 1.0)


COMMANDS = [
    "analyse four-bar:25,70,40,70",
    "analyse crankrocker",
    "analyse wiper",
    "draw vcomp -o picture.svg",
    "enumerate --links 8 --count",
    "enumerate --links 10 --count",
    "inversions vcomp",
    "check wiper",
    "realise -o linkage.toml",
]


def loads_numba(words: list[str], folder: Path, **environment: str) -> bool:
    """Whether a command, run in a folder in a process of its own, loads numba; it says nothing but what is written."""
    ask = (
        "import sys; from gruebler.cli import main; status = main(sys.argv[1:]); print(status, 'numba' in sys.modules)"
    )
    inherited = {k: v for k, v in os.environ.items() if k not in ("GRUEBLER_KERNELS", "NUMBA_DISABLE_JIT")}
    done = subprocess.run(
        [sys.executable, "-c", ask, *words],
        cwd=folder,
        env=inherited | environment,
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stderr.removeprefix("Written: ").count("\n") <= 1
    status, loads = done.stdout.splitlines()[-1].split()
    assert status == "0"
    return loads == "True"


@pytest.mark.parametrize("command", COMMANDS)
def test_small_commands_do_not_load_numba(command: str, tmp_path: Path) -> None:
    """Neither cold nor with kernels in the cache; 200 poses and ten links are small."""
    words = command.split()
    if words[0] == "realise":
        words.insert(1, "R(0-1) R(1-2) R(2-3) R(3-0); frame=0; drive=R(0-1)")
    assert not loads_numba(words, tmp_path)


def test_a_cam_is_measured_without_compiling(tmp_path: Path) -> None:
    """That takes some seconds less than compiling; with kernels in the cache these are faster still, and loaded."""
    assert not loads_numba(["analyse", "cam"], tmp_path, NUMBA_CACHE_DIR=str(tmp_path))


# --- words that mean the same in both tiers ------------------------------------------------------------


@njit()
def _words(x: np.ndarray, out: np.ndarray) -> tuple[int, float]:
    count = 0
    for i in lanes(len(x)):
        root = square_root(x[i])
        count += tally(root >= 0)
        z = complex_number(x[i], 1.0)
        out[0, i] = choose(z.real > 2, root, -z.imag)
    rows = taken(out)
    subtract(rows[1], 2.0, rows[0])
    rows[2][0] = dot(rows[0], rows[0])
    give_back(out, rows)
    return count, rows[2][0]


def test_words_of_kernels_mean_the_same_in_both_tiers() -> None:
    x = np.array([4.0, -1.0, 9.0, 0.25])
    answers = []
    for tier in (interpreted, compiled):
        out = np.zeros((3, 4))
        result = tier(_words)(x, out)
        answers.append((result, out.tolist()))
    assert answers[0] == answers[1]
    assert answers[0][0][0] == 3
    assert answers[0][1] == [[2.0, -1.0, 3.0, -1.0], [-4.0, 2.0, -6.0, 2.0], [15.0, 0.0, 0.0, 0.0]]


# --- the cache -----------------------------------------------------------------------------------------


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A home of the user's own, sources that cannot be written to, and nothing known yet."""
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    for name in ("XDG_CACHE_HOME", "LOCALAPPDATA", "NUMBA_CACHE_DIR"):
        monkeypatch.delenv(name, raising=False)
    (tmp_path / "home").mkdir(mode=0o700)
    access = os.access
    monkeypatch.setattr(os, "access", lambda path, mode: not Path(path).is_relative_to(NUMERIC) and access(path, mode))
    kernel_cache.prepared_folder.cache_clear()
    yield tmp_path / "home"
    kernel_cache.prepared_folder.cache_clear()


def test_another_source_gives_another_folder(tmp_path: Path) -> None:
    """Changing any kernel file, even one that others only call, leads to a fresh cache."""
    shutil.copytree(NUMERIC.parent, tmp_path / "gruebler", ignore=shutil.ignore_patterns("__pycache__"))
    ask = "from gruebler._numeric.kernel_cache import cache_folder as f; print(f())"

    def folder() -> Path:
        done = subprocess.run([sys.executable, "-c", ask], cwd=tmp_path, capture_output=True, text=True, check=True)
        return Path(done.stdout.strip())

    first = folder()
    assert first == folder()
    assert first.name == kernel_cache._name()
    with (tmp_path / "gruebler" / "_numeric" / "labelling" / "partition.py").open("a", encoding="utf-8") as file:
        file.write("# changed\n")
    assert folder() != first


def test_the_sources_of_all_kernels_give_the_name() -> None:
    """So are the files from which kernels import: numba sees neither another number nor another kernel called."""
    package = NUMERIC.parent
    kernels = [path for path in package.rglob("*.py") if "\n@njit" in path.read_text(encoding="utf-8")]
    imported = {
        package.parent.joinpath(*node.module.split(".")).with_suffix(".py")
        for path in kernels
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.ImportFrom) and node.module and node.module.startswith("gruebler.")
    }
    assert len(kernels) > len(list(NUMERIC.rglob("*/*.py"))) // 2
    choice_of_tier = NUMERIC / "work_estimates.py"  # nothing of it is compiled
    assert {*kernels, *imported} - {choice_of_tier} <= set(kernel_cache.kernel_sources())


def test_a_second_process_loads_what_the_first_compiled(tmp_path: Path) -> None:
    shutil.copytree(NUMERIC.parent, tmp_path / "gruebler", ignore=shutil.ignore_patterns("__pycache__"))
    ask = """if True:
        import numpy as np
        from gruebler._numeric.compiling import compiled
        from gruebler._numeric.kernel_cache import is_cached
        from gruebler._numeric.motion.newton import factor
        before = is_cached(factor)
        kernel = compiled(factor)
        kernel(np.eye(2), 2, np.zeros(2, np.int64))
        print(before, sum(kernel.stats.cache_hits.values()), sum(kernel.stats.cache_misses.values()))
        """

    def run(folder: Path, kernels: Path | None) -> str:
        environment = {name: value for name, value in os.environ.items() if name != "NUMBA_CACHE_DIR"}
        if kernels is not None:
            environment["NUMBA_CACHE_DIR"] = str(kernels)
        command = [sys.executable, "-c", ask]
        return subprocess.run(
            command, cwd=folder, capture_output=True, text=True, check=True, env=environment
        ).stdout.strip()

    assert [run(tmp_path, None), run(tmp_path, None)] == ["False 0 1", "True 1 0"]
    other = tmp_path / "another installation of the same sources"
    shutil.copytree(tmp_path / "gruebler", other / "gruebler", ignore=shutil.ignore_patterns("__pycache__"))
    assert run(other, tmp_path / "gruebler" / "_numeric" / "__pycache__") == "True 1 0"


@pytest.mark.skipif(os.name != "posix", reason="elsewhere files have no owners and modes of POSIX")
@pytest.mark.usefixtures("home")
class TestTrust:
    """Loading a kernel runs code: only what nobody else can have written is loaded."""

    def test_a_new_folder_is_the_user_s_alone(self, home: Path) -> None:
        before = os.umask(0)
        try:
            folder = kernel_cache.prepared_folder()
        finally:
            os.umask(before)
        assert folder == home / ".cache" / "gruebler" / kernel_cache._name()
        for path in (folder, folder.parent, folder.parent.parent):
            assert path.stat().st_mode & 0o777 == 0o700

    def test_a_folder_that_others_can_read_is_closed_before_it_is_used(self) -> None:
        folder = kernel_cache.prepared_folder()
        assert folder is not None
        folder.chmod(0o755)
        kernel_cache.prepared_folder.cache_clear()
        assert kernel_cache.prepared_folder() == folder
        assert folder.stat().st_mode & 0o777 == 0o700

    @pytest.mark.parametrize("depth", [0, 1])
    @pytest.mark.parametrize("mode", [0o777, 0o770, 0o702])
    def test_a_folder_others_may_write_to_is_refused(self, depth: int, mode: int) -> None:
        folder = kernel_cache.prepared_folder()
        assert folder is not None
        (folder, folder.parent)[depth].chmod(mode)
        assert kernel_cache.cache_folder() is None

    def test_the_folder_of_numba_s_own_variable_comes_first(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "mine"))
        assert kernel_cache.prepared_folder() == tmp_path / "mine" / kernel_cache._name()
        (tmp_path / "mine").chmod(0o777)
        assert kernel_cache.cache_folder() == tmp_path / "home" / ".cache" / "gruebler" / kernel_cache._name()

    def test_a_link_is_refused(self, home: Path, tmp_path: Path) -> None:
        (tmp_path / "elsewhere").mkdir(mode=0o700)
        (home / ".cache").mkdir()
        (home / ".cache" / "gruebler").symlink_to(tmp_path / "elsewhere")
        assert kernel_cache.cache_folder() is None
        assert kernel_cache.prepared_folder() is None

    def test_a_folder_of_another_user_is_refused(self, monkeypatch: pytest.MonkeyPatch) -> None:
        assert kernel_cache.prepared_folder() is not None
        user = os.geteuid()
        monkeypatch.setattr(os, "geteuid", lambda: user + 1)
        assert kernel_cache.cache_folder() is None

    def test_a_folder_that_can_be_exchanged_is_refused(self, home: Path) -> None:
        home.chmod(0o777)
        assert kernel_cache.cache_folder() is None
        home.chmod(0o1777)  # sticky: others cannot move what is not theirs
        assert kernel_cache.cache_folder() is not None

    def test_without_home_nothing_lies_in_the_temporary_folder(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.setenv("HOME", "/nonexistent/nobody")
        monkeypatch.setenv("TMPDIR", str(tmp_path))
        assert kernel_cache.cache_folder() is None
        assert kernel_cache.prepared_folder() is None

    def test_a_home_that_cannot_be_written_to_is_no_error(self, monkeypatch: pytest.MonkeyPatch) -> None:
        def refuse(*_: object, **__: object) -> None:
            raise PermissionError(13, "Permission denied")

        monkeypatch.setattr(Path, "mkdir", refuse)
        assert kernel_cache.prepared_folder() is None

    def test_without_a_folder_kernels_are_compiled_in_memory(self, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setattr(compiling, "prepared_folder", lambda: None)

        @njit(cache=True)
        def kernel(n: int) -> int:
            return n + 1

        made = compiled(kernel)
        assert made(1) == 2
        assert not made.stats.cache_path  # type: ignore[attr-defined]


def test_kernels_of_other_versions_go_when_they_were_not_used_for_long(home: Path) -> None:
    place = home / ".cache" / "gruebler"
    old, recent, other = (place / name for name in ("kernels-0123", "kernels-4567", "notes"))
    for folder in (old, recent, other):
        folder.mkdir(parents=True, mode=0o700)
        (folder / "file").touch()
    long_ago = time.time() - 100 * 86400
    for folder in (old, other):
        os.utime(folder, (long_ago, long_ago))
    for folder in (place, place.parent):
        folder.chmod(0o700)
    kept = kernel_cache.prepared_folder()
    assert not old.exists()
    assert recent.exists()
    assert other.exists()
    assert kept is not None
    assert kept.exists()


# --- progress ------------------------------------------------------------------------------------------


@njit()
def _inner(n: int) -> int:
    return n + 1


@njit()
def _outer(n: int) -> int:
    return _inner(n) + 1


def test_what_is_compiled_is_told() -> None:
    told: list[tuple[str, int, int]] = []
    on_compiling(lambda *report: told.append(report))
    try:
        assert compiled(_outer)(1) == 3
        count = len(told)
        compiled(_outer)(2)
    finally:
        on_compiling(None)
    assert [name for name, _, _ in told][:2] == ["_outer", "_inner"]
    assert told[-1][0] == ""
    assert len(told) == count
    done = [before for _, before, _ in told]
    assert done == sorted(done)
    assert done[-1] - done[0] == 2


@pytest.mark.parametrize("terminal", [True, False])
def test_a_bar_is_drawn_on_terminals_only(
    terminal: bool, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from gruebler.cli.compiling_progress import show_compiling

    @njit()
    def kernel(n: int) -> int:
        return n + 1

    monkeypatch.setattr(sys.stderr, "isatty", lambda: terminal, raising=False)
    monkeypatch.setenv("TERM", "xterm")
    show_compiling("de")
    try:
        assert compiled(kernel)(1) == 2
    finally:
        on_compiling(None)
    out, err = capsys.readouterr()
    assert out == ""
    assert ("Wird übersetzt" in err) is terminal
