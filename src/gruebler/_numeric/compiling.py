"""Kernels in two tiers: the same source interpreted for little work, compiled by numba for much.

`njit` leaves a kernel as it is, a plain Python function, and notes how to compile it. Kernels that call one another
call plain functions, so that a debugger steps through all of them. Who calls a kernel from outside asks `for_work`
for the tier that pays; only there numba is imported.

numba reuses a compiled function from its cache on disk while the file that defines it is unchanged. Our kernels call
kernels of other files, whose code is compiled into them; an upgrade that changes only the callee would silently keep
the old code. So the folder of the cache is named after a digest of all kernel sources: any change compiles anew.
`kernel_cache` says which folder may be used at all.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache, wraps
from pathlib import Path
from threading import RLock
from types import FunctionType
from typing import Any, NamedTuple, TypeVar

from gruebler._numeric.kernel_cache import is_cached, prepared_folder

Kernel = TypeVar("Kernel", bound=Callable[..., Any])
Progress = Callable[[str, int, int], None]
"""Called before each kernel is compiled: its name, how many are done, how many there are; with an empty name at the
end."""

# Seconds of CPU, measured on one core (benchmarks/README.md, "Start"). Only the order of magnitude matters: if one is
# off by a factor, some call takes that much longer than it need.
_LOADING_NUMBA = 0.55  # and what it makes ready before its first kernel
_LOADING_KERNEL = 0.05  # from the cache
_FIRST_COMPILING = 2.0  # what numba makes ready before it compiles
_COMPILING = 2e-3  # for each instruction of a kernel and of the kernels that it calls: 4 s to 70 s in all
_RUNS = 10  # A compiled kernel is kept: so many runs are taken to share the cost of compiling it.


class _Recipe(NamedTuple):
    """How to compile a kernel."""

    signature: tuple[Callable[[], Any], ...]
    options: dict[str, Any]
    make: Callable[[], Any] | None  # makes what stands for the kernel in compiled code


_recipes: dict[Callable[..., Any], _Recipe] = {}
_dispatchers: dict[Callable[..., Any], Any] = {}
_spent: dict[Callable[..., Any], float] = {}
_lock = RLock()
_progress: list[Progress] = []  # none or one


def njit(*signature: Callable[[], Any], **options: Any) -> Callable[[Kernel], Kernel]:
    """Note that a function is a kernel, with the options of `numba.njit`, and leave it as it is.

    A signature is given as a function that returns it, so that the sources can be read without numba.
    """

    def noted(function: Kernel) -> Kernel:
        _recipes[function] = _Recipe(signature, options, None)
        return function

    return noted


def instead(make: Callable[[], Any]) -> Callable[[Kernel], Kernel]:
    """Note that `make()` stands for a function in compiled code, where its own source would be slow or not compile."""

    def noted(function: Kernel) -> Kernel:
        _recipes[function] = _Recipe((), {}, make)
        return function

    return noted


def kernels() -> list[Callable[..., Any]]:
    """All kernels of the modules that are loaded."""
    return [function for function, recipe in _recipes.items() if recipe.make is None]


def on_compiling(progress: Progress | None) -> None:
    """Have a function called before each kernel that is compiled (not loaded); None: silence, as at first."""
    _progress[:] = [] if progress is None else [progress]


def for_work(kernel: Kernel, seconds: float) -> Kernel:
    """The kernel in the tier that pays for a call that would take so many seconds if it were interpreted.

    The seconds of earlier calls count too: once a kernel has been interpreted for as long as it takes to load or to
    compile (a tenth of that, since the result is kept), it is compiled. The environment variable GRUEBLER_KERNELS
    (`auto`, `interpreted`, `compiled`) overrides it, and NUMBA_DISABLE_JIT=1 means interpreted.

    Raises:
        ValueError: GRUEBLER_KERNELS has another value.
    """
    asked = wanted_tier()
    if asked == "auto":
        spent = _spent.get(kernel, 0.0) + seconds
        asked = "compiled" if spent >= price(kernel) else "interpreted"
        _spent[kernel] = spent
    return compiled(kernel) if asked == "compiled" else interpreted(kernel)


def wanted_tier() -> str:
    """The tier that the environment asks for: `auto`, `interpreted` or `compiled`; ValueError if it is none of them."""
    if os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0"):
        return "interpreted"
    asked = os.environ.get("GRUEBLER_KERNELS") or "auto"
    if asked not in ("auto", "compiled", "interpreted"):
        raise ValueError(f"GRUEBLER_KERNELS: expected auto, interpreted or compiled, but found {asked[:40]!r}")
    return asked


def price(kernel: Callable[..., Any]) -> float:
    """About how many seconds of interpreting make up for loading or compiling a kernel."""
    ready = _dispatchers.get(kernel)
    if ready is not None and ready.overloads:  # `signatures` makes a list at each call: 5 to 20 us
        return 0.0
    loading = _LOADING_KERNEL + (0.0 if "numba" in sys.modules else _LOADING_NUMBA)
    if is_cached(kernel):
        return loading
    missing = [called for called in _called(kernel) if called not in _dispatchers or not _dispatchers[called].overloads]
    instructions = sum(len(called.__code__.co_code) // 2 for called in missing if not is_cached(called))
    return loading + (_FIRST_COMPILING + _COMPILING * instructions) / _RUNS


@cache
def interpreted(kernel: Kernel) -> Kernel:
    """The kernel as Python runs it; whole numbers of numpy wrap around, and NaN is not remarked on, as if compiled."""
    from numpy import errstate

    @wraps(kernel)
    def run(*arguments: Any) -> Any:
        with errstate(all="ignore"):
            return kernel(*arguments)

    return run  # type: ignore[return-value]


def compiled(kernel: Kernel) -> Kernel:
    """The kernel as numba compiles it, for each combination of types at the first call with them."""
    ready: Kernel | None = _dispatchers.get(kernel)
    if ready is None:
        with _lock, _listener().together(kernel):
            ready = _dispatcher(kernel)
    return ready


def _names(kernel: Callable[..., Any]) -> Iterator[tuple[str, Any]]:
    """The names of its module that a kernel uses."""
    for name in kernel.__code__.co_names:
        if name in kernel.__globals__:
            yield name, kernel.__globals__[name]


def _is_kernel(value: Any) -> bool:
    return isinstance(value, FunctionType) and value in _recipes


def _called(kernel: Callable[..., Any]) -> list[Callable[..., Any]]:
    """A kernel and all kernels that it calls, itself or through others."""
    called = {kernel: None}
    waiting = [kernel]
    while waiting:
        for _, value in _names(waiting.pop()):
            if _is_kernel(value) and _recipes[value].make is None and value not in called:
                called[value] = None
                waiting.append(value)
    return list(called)


def _dispatcher(kernel: Callable[..., Any]) -> Any:
    """The compiled form of a kernel: of a copy in whose module all kernels are the compiled ones."""
    if kernel in _dispatchers:
        return _dispatchers[kernel]
    recipe = _recipes[kernel]
    if recipe.make is not None:
        _dispatchers[kernel] = recipe.make()
        return _dispatchers[kernel]
    names = dict(_names(kernel))
    namespace: dict[str, Any] = {"__name__": kernel.__module__, "__builtins__": __builtins__}
    copy = FunctionType(kernel.__code__, namespace, kernel.__name__, kernel.__defaults__)
    copy.__doc__ = kernel.__doc__
    for name, value in names.items():
        if value is not kernel:
            namespace[name] = _dispatcher(value) if _is_kernel(value) else value
    dispatcher = _jitted(copy, recipe)
    for name, value in names.items():
        if value is kernel:
            namespace[name] = dispatcher
    _dispatchers[kernel] = dispatcher
    return dispatcher


def _jitted(function: Callable[..., Any], recipe: _Recipe) -> Any:
    """The dispatcher of numba, with its cache in the folder of `kernel_cache`."""
    import numba
    from numba.core import caching

    options = dict(recipe.options)
    signature = [make() for make in recipe.signature]
    folder = prepared_folder()
    if folder is None:
        options.pop("cache", None)
    numba_cache: Any = caching.CacheImpl  # it asks a list of classes where a function is kept
    before = numba_cache._locator_classes
    numba_cache._locator_classes = [_KernelLocator, *before]
    try:
        return numba.njit(*signature, **options)(function)
    finally:
        numba_cache._locator_classes = before


class _KernelLocator:
    """Where numba keeps a kernel: in the folder of `kernel_cache`, by names that are the same in every installation.

    The folder is named after the sources, so that nothing else has to say whether what lies there is fresh.
    """

    def __init__(self, folder: Path, line: int) -> None:
        self.folder = folder
        self.line = line

    @classmethod
    def from_function(cls, function: Callable[..., Any], file: str) -> _KernelLocator | None:
        folder = prepared_folder()
        return None if folder is None else cls(folder / Path(file).parent.name, function.__code__.co_firstlineno)

    def ensure_cache_path(self) -> None:
        self.folder.mkdir(mode=0o700, exist_ok=True)

    def get_cache_path(self) -> str:
        return str(self.folder)

    def get_source_stamp(self) -> str:
        return self.folder.parent.name

    def get_disambiguator(self) -> str:
        return str(self.line)


class _Listener:
    """Tells `on_compiling` what numba compiles; kernels compile the kernels that they call on their way."""

    def __init__(self) -> None:
        self.open: list[Any] = []
        self.done: set[int] = set()
        self.wanted: set[Callable[..., Any]] = set()
        self.depth = 0

    @contextmanager
    def together(self, kernel: Callable[..., Any]) -> Iterator[None]:
        """What is compiled here for a kernel is reported as one."""
        self.wanted.update(_called(kernel))
        self.depth += 1
        count = len(self.done)
        try:
            yield
        finally:
            self.depth -= 1
            if len(self.done) > count:
                self._report()

    def notify(self, event: Any) -> None:
        """Called when numba begins to compile something, or has done so."""
        if event.is_start:
            self.open.append(event.data["dispatcher"])
        else:
            self.done.add(id(self.open.pop()))
        self._report()

    def _report(self) -> None:
        if not _progress:
            return
        name = self.open[-1].py_func.__name__ if self.open else ""
        if name or not self.depth:
            done = sum(id(_dispatchers.get(kernel)) in self.done for kernel in self.wanted)
            _progress[0](name, done, len(self.wanted))


@cache
def _listener() -> _Listener:
    from numba.core import event

    listener = _Listener()
    event.Listener.register(_Listener)
    event.register("numba:compile", listener)  # type: ignore[no-untyped-call, unused-ignore]
    return listener
