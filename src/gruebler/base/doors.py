"""Doors: what users call checks the kinds of its arguments by its own annotations, before anything else happens.

A wrong kind is refused in one sentence that names the parameter, what was expected and what was found. The annotation
is the only statement of what is taken; what it cannot say (ranges, names, shapes) the function checks itself.
"""

from __future__ import annotations

import functools
import inspect
import reprlib
import sys
import types
import typing
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence, Set
from numbers import Integral, Real
from typing import Annotated, Any, NamedTuple, TypeGuard, TypeVar

from gruebler.base.errors import GrueblerError, to_be_read, unknown
from gruebler.base.text import Message, joined_by_or, message

F = TypeVar("F", bound=Callable[..., Any])
Fits = Callable[[object], bool]


class _Check(NamedTuple):
    """A parameter: its name, whether a value fits, its annotation, whether it is taken by place."""

    name: str
    fits: Fits | None
    hint: Any
    by_place: bool


def door(function: F) -> F:
    """The function (or a class, whose constructor is meant) with the kinds of its arguments checked.

    Checks are made when it is first called. Of an annotation whose names are not there at run time, or that is
    `Annotated`, nothing is checked, of elements only those that can be looked at without using them up. Cost: about a
    microsecond an argument.

    >>> @door
    ... def shifted(values: Sequence[float], by: int = 1) -> list[float]:
    ...     return [value + by for value in values]
    >>> shifted([1, 2.5])
    [2, 3.5]
    >>> shifted([1, "x"])
    Traceback (most recent call last):
    gruebler.base.errors.GrueblerError: values: expected a list, each part a number, but found [1, 'x']
    """
    return door_that_raises(GrueblerError)(function)


def door_that_raises(kind: type[GrueblerError]) -> Callable[[F], F]:
    """`door` with errors of a kind of its own."""

    def with_checks(function: F) -> F:
        if isinstance(function, type):
            function.__init__ = with_checks(function.__init__)  # type: ignore[misc]
            return function
        checks: list[_Check] = []

        @functools.wraps(function)
        def checked(*args: Any, **named: Any) -> Any:
            if not checks:
                checks.extend(_checks(function))
            for (name, fits, hint, by_place), value in zip(checks, args, strict=False):
                if by_place and fits is not None and not fits(value):
                    raise _refusal(kind, name, hint, value)
            if named:
                _check_names(kind, function, named, checks)
                for name, fits, hint, _ in checks:
                    if fits is not None and name in named and not fits(named[name]):
                        raise _refusal(kind, name, hint, named[name])
            return function(*args, **named)

        return typing.cast(F, checked)

    return with_checks


def _check_names(
    error: type[GrueblerError], function: Callable[..., Any], named: Collection[str], checks: list[_Check]
) -> None:
    """Names that the function does not have are refused with those that it has."""
    known = [name for name, *_ in checks if name != "self"]
    other = next((name for name in named if name not in known), None)
    if other is not None and not _takes_any(function):
        raise error(
            "{function} has no option {word!r}{suggestion}; it has {known}",
            function=function.__qualname__.removesuffix(".__init__"),
            **unknown(other, known),
        )


def _takes_any(function: Callable[..., Any]) -> bool:
    return any(p.kind is p.VAR_KEYWORD for p in inspect.signature(function).parameters.values())


def _checks(function: Callable[..., Any]) -> list[_Check]:
    """Each parameter with what its annotation says, in their order."""
    space = {**vars(typing), **getattr(function, "__globals__", {})}
    checks: list[_Check] = []
    for parameter in inspect.signature(function).parameters.values():
        hint = parameter.annotation
        if isinstance(hint, str):
            try:
                hint = eval(hint, space)  # the text stands in our own source
            except NameError:
                hint = Any
        if parameter.kind in (parameter.VAR_KEYWORD, parameter.VAR_POSITIONAL) or hint is parameter.empty:
            hint = Any
        checks.append(_Check(parameter.name, _fits(hint), hint, parameter.kind is not parameter.KEYWORD_ONLY))
    return checks


def _fits(hint: Any) -> Fits | None:
    """Whether a value is of a kind; None for a kind of which nothing is checked."""
    origin, parts = typing.get_origin(hint), typing.get_args(hint)
    if hint in _PLAIN:
        return _PLAIN[hint][0]
    if origin in (typing.Union, types.UnionType):
        kinds = [kind for kind in map(_fits, parts) if kind is not None]
        return (lambda value: any(kind(value) for kind in kinds)) if len(kinds) == len(parts) else None
    if origin in _LISTS:
        return _fits_list(origin, parts)
    if origin is Mapping:
        key, content = map(_fits, parts)
        return lambda value: isinstance(value, Mapping) and _all(value, key) and _all(value.values(), content)
    return _fits_class(origin or hint)


def _fits_class(kind: Any) -> Fits | None:
    if kind is Callable:
        return callable
    if not isinstance(kind, type) or kind in (_numpy("ndarray"), Annotated) or getattr(kind, "_is_protocol", False):
        return None
    return lambda value: isinstance(value, kind)


def _fits_list(origin: Any, parts: tuple[Any, ...]) -> Fits:
    if origin is tuple and parts[1:] != (...,):
        each = [_fits(part) for part in parts]
        return lambda value: (
            _is_list(value, Sequence) and len(list(value)) == len(each) and all(map(_fits_part, each, value))
        )
    wanted, content = Sequence if origin in (tuple, list) else origin, _fits(parts[0])
    return lambda value: _is_list(value, wanted) and (isinstance(value, Iterator) or _all(value, content))


def _fits_part(kind: Fits | None, value: object) -> bool:
    return kind is None or kind(value)


def _is_list(value: object, wanted: type) -> TypeGuard[Iterable[object]]:
    if isinstance(value, _numpy("ndarray")):
        return bool(value.ndim)  # type: ignore[attr-defined]
    return isinstance(value, wanted) and not isinstance(value, str | bytes)


def _numpy(name: str) -> type:
    """A class of NumPy; one without values where NumPy is not loaded, so that chains are read without it."""
    return getattr(sys.modules.get("numpy"), name, _Nothing)


class _Nothing:
    """Has no values."""


def _all(values: Iterable[object], fits: Fits | None) -> bool:
    return fits is None or all(map(fits, values))


def _is_whole(value: object) -> bool:
    return isinstance(value, Integral) and not isinstance(value, bool)


def _is_number(value: object) -> bool:
    """A real number that a double can hold."""
    if not isinstance(value, Real) or isinstance(value, bool):
        return False
    return not isinstance(value, int) or abs(value) <= 10**308


_LISTS = (tuple, list, Sequence, Iterable, Collection, Set)
_PLAIN: dict[Any, tuple[Fits | None, Message]] = {
    Any: (None, message("anything")),
    object: (None, message("anything")),
    None: (lambda value: value is None, message("None")),
    types.NoneType: (lambda value: value is None, message("None")),
    str: (lambda value: isinstance(value, str), message("a text")),
    int: (_is_whole, message("a whole number")),
    float: (_is_number, message("a number")),
    bool: (lambda value: isinstance(value, (bool, _numpy("bool_"))), message("True or False")),
}


def _refusal(error: type[GrueblerError], name: str, hint: Any, value: object) -> GrueblerError:
    """One sentence; where an attribute of the value is what was wanted, with it."""
    plain = isinstance(value, str | bytes | Real | types.NoneType | list | tuple | dict | set)
    shown = reprlib.repr(value) if plain else type(value).__name__
    wanted = joined_by_or(list({str(kind): kind for kind in _wanted(hint)}.values()))
    said = message("{name}: expected {wanted}, but found {found}", name=name, wanted=wanted, found=shown)
    parts = typing.get_args(hint) or (hint,)
    if isinstance(value, str) and any(getattr(part, "__module__", "").startswith("gruebler.") for part in parts):
        return error(message("{said}; {call} reads what it stands for", said=said, call=to_be_read(value)))
    for part in parts:
        if isinstance(part, type) and part not in _PLAIN and (path := _path_to(part, value)):
            return error(message("{said}: take its {attribute}", said=said, attribute=path))
    return error(said)


def _path_to(kind: type, value: object) -> str:
    """The attributes that lead from a value to what was wanted, such as mechanism.chain; empty if none do."""
    name = kind.__name__.lower()
    called = "linkage()", f"linkage().{name}", f"linkage().mechanism.{name}"
    for path in (name, f"mechanism.{name}", f"linkage.mechanism.{name}", *called):
        reached: object = value
        for word in path.split("."):
            reached = getattr(reached, word.removesuffix("()"), None)
            if word.endswith("()"):
                reached = reached() if callable(reached) else None
        if isinstance(reached, kind) and not isinstance(value, type):
            return path
    return ""


def _wanted(hint: Any) -> Iterator[Message | str]:
    """What an annotation takes, in words."""
    origin, parts = typing.get_origin(hint), typing.get_args(hint)
    if origin in (typing.Union, types.UnionType):
        for part in parts:
            if part is not types.NoneType:
                yield from _wanted(part)
    elif hint in _PLAIN:
        yield _PLAIN[hint][1]
    elif origin is Mapping:
        content = joined_by_or(list(_wanted(parts[1])))
        yield message("a dict, each value {content}", content=content) if _fits(parts[1]) else message("a dict")
    elif origin is tuple and parts[1:] != (...,):
        yield message("a list of {count}", count=len(parts))
    elif origin in _LISTS:
        content = joined_by_or(list(_wanted(parts[0])))
        yield message("a list, each part {content}", content=content) if _fits(parts[0]) else message("a list")
    elif (origin or hint) is Callable:
        yield message("a function")
    else:
        yield getattr(origin or hint, "__name__", str(hint))
