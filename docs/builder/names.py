"""The reference of the public names: every name where it is defined, its docstring as Markdown."""

from __future__ import annotations

import ast
import builtins
import enum
import inspect
import re
import textwrap
from collections.abc import Iterator
from dataclasses import is_dataclass
from functools import cache
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

from sphinx.addnodes import pending_xref

import gruebler

_STUB = Path(gruebler.__file__).with_suffix(".pyi")
_STABILITY = Path(__file__).parents[1] / "reference" / "stability.md"
_DOCSTRING_SECTIONS = {"Args:": "Arguments", "Returns:": "Returns", "Raises:": "Raises", "Yields:": "Yields"}
_UNLISTED = ":no-contents-entry:"  # members: the contents of a page list classes and functions
_FURTHER = {  # modules whose names are public though no room lists them
    "pictures": (
        "structure.picture",
        "linkage.picture",
        "linkage.animation",
        "linkage.motion_plots",
        "linkage.curve_plots",
        "machines.cam_picture",
        "machines.geneva_picture",
        "machines.train_picture",
    ),
    "page": ("notebook",),
}
_FOR_THE_LIBRARY = {
    "pictures": None,
    "base": {"columns", "errors", "text"},
}  # other rooms of these wings are not public


@cache
def _imports() -> tuple[ast.ImportFrom, ...]:
    tree = ast.parse(_STUB.read_text(encoding="utf-8"))
    return tuple(node for node in tree.body if isinstance(node, ast.ImportFrom))


def _rooms_of(wing: str) -> list[str]:
    """The rooms that a wing opens, by its own list of names."""
    stub = _STUB.parent / wing / "__init__.pyi"
    if not stub.exists():
        return []
    nodes = [node for node in ast.parse(stub.read_text(encoding="utf-8")).body if isinstance(node, ast.ImportFrom)]
    rooms = {alias.name for node in nodes if node.module is None for alias in node.names}
    return sorted(rooms & (_FOR_THE_LIBRARY[wing] or set()) if wing in _FOR_THE_LIBRARY else rooms)


@cache
def documented_rooms() -> tuple[str, ...]:
    """The wings that the front door opens, and their rooms, as mechanics.geometry."""
    wings = sorted(alias.name for node in _imports() if node.module is None for alias in node.names)
    return tuple(name for wing in wings for name in (wing, *(f"{wing}.{room}" for room in _rooms_of(wing))))


def _room_of(module: str) -> str:
    """The documented wing or room in which a module lies."""
    parts = module.split(".")
    names = [".".join(parts[:k]) for k in range(len(parts), 0, -1)]
    return next(name for name in names if name in documented_rooms())


def _names_of(module: ModuleType) -> list[str]:
    """What a door lists, else what a file defines without an underscore."""
    own = (name for name, value in vars(module).items() if getattr(value, "__module__", None) == module.__name__)
    return list(getattr(module, "__all__", ())) or [name for name in own if not name.startswith("_")]


def _is_of_a_room_of(wing: str, value: Any) -> bool:
    """Whether a name that a wing opens is documented in one of its rooms."""
    home = getattr(value, "__module__", None) or ""
    return home.startswith(f"gruebler.{wing}.") and _room_of(home.removeprefix("gruebler.")) != wing


@cache
def _public() -> dict[str, dict[str, Any]]:
    """For each room its public names and what they stand for."""
    found: dict[str, dict[str, Any]] = {}
    for room in documented_rooms():
        modules = [import_module(f"gruebler.{room}")]
        modules += [import_module(f"gruebler.{room}.{each}") for each in _FURTHER.get(room, ())]
        names = {name: getattr(module, name) for module in modules for name in _names_of(module)}
        names = {name: value for name, value in names.items() if not _is_of_a_room_of(room, value)}
        for node in _imports():
            if node.module and _room_of(node.module) == room:
                names |= {alias.name: getattr(gruebler, alias.name) for alias in node.names}
        found[room] = names
    return found


def _place_of(name: str) -> str:
    """The full name under which a name of the front door is documented."""
    for node in _imports():
        if name in [alias.name for alias in node.names]:
            return f"gruebler.{_room_of(node.module)}.{name}" if node.module else f"gruebler.{name}"
    raise KeyError(name)


def stability() -> dict[str, str]:
    """For each name of the front door `stable` or `provisional`, as the page says."""
    text = _STABILITY.read_text(encoding="utf-8")
    return dict(re.findall(r"^\| `(\w+)` \| (stable|provisional) \|", text, re.MULTILINE))


def front_door_table(lang: str, _: str) -> str:
    """The names of the front door with a sentence each."""
    heads = {"en": "| name | what it is | |", "de": "| Name | Bedeutung | |"}[lang]
    state = stability()
    words = {"stable": {"en": "stable", "de": "stabil"}, "provisional": {"en": "provisional", "de": "vorläufig"}}
    lines = [heads, "|---|---|---|"]
    for name in sorted(gruebler.__all__, key=lambda each: (each in documented_rooms(), each.lower())):
        if name not in state:
            raise ValueError(f"{_STABILITY}: expected a row for the name {name}")
        value = getattr(gruebler, name)
        link = f"{{py:obj}}`gr.{name} <{_place_of(name)}>`"
        if inspect.ismodule(value):
            link = f"[`gr.{name}`](api/{name}.md)"
        lines.append(f"| {link} | {_cell(_first_sentence(value))} | {words[state[name]][lang]} |")
    return "\n".join(lines)


def _first_sentence(value: Any) -> str:
    text = (inspect.getdoc(value) or "").split("\n\n")[0]
    return " ".join(text.split())


def _cell(text: str) -> str:
    return _markdown_line(text).replace("|", "\\|")


def room_page(lang: str, room: str) -> str:
    """The page of a room: its docstring, then every public name."""
    del lang
    module = import_module(f"gruebler.{room}")
    lines = [f"# gruebler.{room}", "", *_markdown(inspect.getdoc(module) or ""), ""]
    for inner in documented_rooms():
        if inner.startswith(f"{room}."):
            sentence = _cell(_first_sentence(import_module(f"gruebler.{inner}")))
            lines.append(f"- [`gr.{inner}`]({inner}.md): {sentence}")
    lines.append("")
    for name, value in sorted(
        _public()[room].items(), key=lambda item: (not inspect.isclass(item[1]), item[0].lower())
    ):
        if inspect.ismodule(value):
            continue
        lines += _object(f"gruebler.{room}.{name}", value)
    return "\n".join(lines) + "\n"


def _object(name: str, value: Any) -> Iterator[str]:
    if inspect.isclass(value):
        yield from _class(name, value)
    elif callable(value):
        yield from _directive("py:function", name + _signature(value), _markdown(inspect.getdoc(value) or ""))
    else:
        yield from _directive("py:data", name, [])


def _directive(kind: str, head: str, body: list[str], fence: str = "::::::") -> Iterator[str]:
    yield f"{fence}{{{kind}}} {head}"
    yield from body
    yield fence
    yield ""


def _class(name: str, kind: type) -> Iterator[str]:
    error = issubclass(kind, BaseException)
    signature = "" if error or issubclass(kind, enum.Enum) else _signature(kind).removesuffix(" -> None")
    body = [*_markdown(inspect.getdoc(kind) or ""), ""]
    fields = {field: (text, type_) for field, text, type_ in _fields(kind)}
    for field, (text, type_) in fields.items():
        body += _directive("py:attribute", field, [_UNLISTED, f":type: {type_}", "", *_markdown(text)], ":::::")
    if not error:
        for member, value in _members(kind):
            if member in fields:
                continue
            if isinstance(value, property):
                text = _markdown(inspect.getdoc(value) or "")
                body += _directive("py:property", member, [_UNLISTED, "", *text], ":::::")
            else:
                body += _method(kind, member, value)
    yield from _directive("py:exception" if error else "py:class", name + signature, body)


def _method(kind: type, name: str, value: Any) -> Iterator[str]:
    option = {classmethod: [":classmethod:"], staticmethod: [":staticmethod:"]}.get(type(value), [])
    text = _markdown(inspect.getdoc(getattr(kind, name)) or "")
    yield from _directive("py:method", name + _signature(getattr(kind, name)), [*option, _UNLISTED, "", *text], ":::::")


def _members(kind: type) -> Iterator[tuple[str, Any]]:
    """Public methods and properties of a class of ours, those of its bases included."""
    seen = set()
    for base in kind.__mro__:
        if not base.__module__.startswith("gruebler"):
            continue
        for name, value in vars(base).items():
            if name.startswith("_") or name in seen:
                continue
            seen.add(name)
            ours = isinstance(value, classmethod | staticmethod | property) or inspect.isfunction(value)
            if ours and inspect.getdoc(value if isinstance(value, property) else getattr(kind, name)):
                yield name, value


def _fields(kind: type) -> Iterator[tuple[str, str, str]]:
    """Fields of a dataclass or a named tuple with the texts below them in the source."""
    if not (is_dataclass(kind) or hasattr(kind, "_fields") or issubclass(kind, enum.Enum)):
        return
    for base in reversed(kind.__mro__):
        if base.__module__.startswith("gruebler"):
            try:
                tree = ast.parse(textwrap.dedent(inspect.getsource(base)))
            except (OSError, TypeError):
                continue
            for node, after in zip(tree.body[0].body, [*tree.body[0].body[1:], None], strict=True):  # type: ignore[attr-defined]
                target = node.target if isinstance(node, ast.AnnAssign) else None
                if isinstance(target, ast.Name) and not target.id.startswith("_"):
                    text = after.value.value if _is_text(after) else ""
                    yield target.id, inspect.cleandoc(text), ast.unparse(node.annotation)


def _is_text(node: Any) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)


def _signature(value: Any) -> str:
    try:
        signature = inspect.signature(value)
    except (TypeError, ValueError):
        return "(...)"
    parts, star = [], False
    for k, each in enumerate(signature.parameters.values()):
        if k == 0 and each.name in {"self", "cls"}:
            continue
        text = each.name
        if each.kind is each.VAR_POSITIONAL:
            text, star = f"*{text}", True
        elif each.kind is each.VAR_KEYWORD:
            text = f"**{text}"
        elif each.kind is each.KEYWORD_ONLY and not star:
            parts.append("*")
            star = True
        text += _annotation(each.annotation, ": ")
        if each.default is not each.empty:
            text += f" = {_default(each.default)}"
        parts.append(text)
    return f"({', '.join(parts)}){_annotation(signature.return_annotation, ' -> ')}"


def _annotation(kind: Any, sign: str) -> str:
    return f"{sign}{kind}" if isinstance(kind, str) and kind != "None" else ""


def _default(value: Any) -> str:
    if isinstance(value, str | int | float | bool | None):
        return repr(value)
    return repr(value) if value in ((), [], {}) else "..."


def _markdown(text: str) -> list[str]:
    """A docstring as Markdown: examples and argument lists become blocks."""
    lines: list[str] = []
    rows = iter([*text.splitlines(), ""])
    for row in rows:
        title = _DOCSTRING_SECTIONS.get(row.strip())
        if title:
            lines += [f"**{title}**", ""]
            lines += _arguments(rows)
        elif row.lstrip().startswith(">>>"):
            indent = len(row) - len(row.lstrip())
            block = [row[indent:]]
            for following in rows:
                if not following.strip():
                    break
                block.append(following[indent:])
            lines += ["```pycon", *(each for each in block), "```", ""]
        else:
            lines.append(_markdown_line(row))
    return lines


def _arguments(rows: Iterator[str]) -> list[str]:
    lines: list[str] = []
    for row in rows:
        if not row.strip():
            break
        indent = len(row) - len(row.lstrip())
        name = re.match(r"\s*([\w*, ]+?)(?: \([^)]*\))?: (.*)", row)
        if indent <= 4 and name:
            lines.append(f"- `{name[1]}`: {_markdown_line(name[2])}")
        elif lines:
            lines[-1] += " " + _markdown_line(row.strip())
        else:
            lines.append(_markdown_line(row.strip()))
    return [*lines, ""]


def _markdown_line(text: str) -> str:
    """A line of a docstring: code stays, other signs of Markdown are made plain."""
    parts = re.split(r"(`+[^`]*`+|`?docs/[\w/-]+\.md`?)", text)
    return "".join(
        f"[](/{part.strip('`').removeprefix('docs/')})"
        if part.strip("`").startswith("docs/") and part.strip("`").endswith(".md")
        else part
        if k % 2
        else re.sub(r"([*\[\]{}<>$|~]|(?<=\w)_(?=\W|$)|(?<!\w)_)", r"\\\1", part)
        for k, part in enumerate(parts)
    )


def _unlink_builtins(_: Any, tree: Any) -> None:
    """A built-in name such as `type` in a signature leads nowhere, least of all to an attribute of that name."""
    for link in list(tree.findall(pending_xref)):
        if link.get("refdomain") == "py" and hasattr(builtins, link.get("reftarget", "")):
            link.replace_self(link.children)


def setup(app: Any) -> None:
    """The event."""
    app.connect("doctree-read", _unlink_builtins)
