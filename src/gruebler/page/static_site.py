"""The page as a static site: one HTML file, and beside it files with the answers to all that needs no search.

Any server of files will do, and where browsers let a page load scripts from its own folder, none. What a file holds is
the answer that a server would give, packed; docs/theory/explorer.md has the list.
"""

from __future__ import annotations

import base64
import gzip
import json
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import suppress
from itertools import islice
from pathlib import Path
from typing import Any, NamedTuple

from gruebler.base.atomic_files import write_whole
from gruebler.base.errors import GrueblerError
from gruebler.base.text import LANGUAGES
from gruebler.page.page import static_page
from gruebler.page.requests import answer
from gruebler.page.structures import listed_chains, listed_number
from gruebler.structure.chain.pairs import PAIRS, Alphabet
from gruebler.structure.chain.spaces import Space
from gruebler.structure.enumeration.worker_pool import run_work
from gruebler.structure.mechanism import Mechanism

LISTED = {"links": {"min": 3, "max": 10}, "mobility": {"min": 1, "max": 6}}
"""The chains that stand in the site."""
TASKS = 8
"""Tasks of a kind and level."""

_MOVED = 6  # links of the largest chains whose mechanisms get dimensions: others take too long
_TOGETHER = 8  # chains in a piece of work
_DATA = "data"


class FileGroup(NamedTuple):
    """Files that are written together: a row of `_PACKS`, and what is given to it."""

    kind: str
    given: tuple[Any, ...] = ()


def write_site(
    folder: Path,
    model: Mapping[str, Any],
    *,
    lang: str = "",
    executor: Callable[[], Executor] | None = None,
    progress: Callable[[Iterable[int], int], Iterable[int]] = lambda items, _: items,
    groups: Sequence[FileGroup] | None = None,
) -> int:
    """Write the site that opens with a model (`gruebler.page.model.model_of`).

    Args:
        folder: is made if it is not there.
        model: what is shown first.
        lang: the language in which it opens, the browser's if empty.
        executor: what creates an executor for the work; this process alone if None.
        progress: is given what is counted and how much that is, and passes it on.
        groups: what is written beside the page; everything if None.

    Returns the bytes that the site has. Raises `GrueblerError` for a folder that holds anything else.
    """
    data = folder / _DATA
    if folder.is_dir() and any(folder.iterdir()) and not data.is_dir():
        raise GrueblerError("{path}: this folder holds something else; expected a new or an empty one", path=folder)
    data.mkdir(parents=True, exist_ok=True)
    work = [(str(data), group) for group in (_all_groups() if groups is None else groups)]
    size = sum(progress(run_work(_written, work, executor), len(work)))
    return size + _write(folder / "index.html", static_page(model, LISTED, _classes(), lang).encode("utf-8"))


def _classes() -> list[tuple[int, int]]:
    """Links and mobility of the chains, the largest first."""
    ranges = [range(LISTED[what]["min"], LISTED[what]["max"] + 1) for what in ("links", "mobility")]
    return [(n, mobility) for n in reversed(ranges[0]) for mobility in ranges[1] if listed_number(n, mobility)]


def _all_groups() -> Iterator[FileGroup]:
    """Everything, what takes long first."""
    from gruebler.teaching.catalog import entries
    from gruebler.teaching.exercises import KINDS

    for links, mobility in _classes():
        for first in range(0, listed_number(links, mobility), _TOGETHER):
            yield FileGroup("structures", (links, mobility, first))
        yield FileGroup("chains", (links, mobility))
    ids = tuple(sorted(entries()))
    yield FileGroup("space", tuple(id for id in ids if entries()[id].in_space))
    yield from (FileGroup("machine", (id,)) for id in ids)
    yield FileGroup("catalog", ids)
    yield from (FileGroup("tasks", (kind, level, TASKS)) for kind in KINDS for level in (1, 2, 3))
    yield FileGroup("exercises")
    yield FileGroup("common")
    yield FileGroup("points")


def _written(work: tuple[str, FileGroup]) -> int:
    """Write the files of a group; how many bytes they have."""
    folder, group = work
    if group.kind == "space":
        return sum(_write_in_space(Path(folder).parent, id) for id in group.given)
    return sum(_write_pack(Path(folder), name, content) for name, content in _PACKS[group.kind](*group.given))


def _write_in_space(folder: Path, id: str) -> int:
    """The page of a machine in space."""
    (folder / "space").mkdir(exist_ok=True)
    return _write(folder / "space" / f"{id}.html", answer("space", {"id": id}, LANGUAGES[0], _nothing).encode("utf-8"))


def _write_pack(folder: Path, name: str, content: Any) -> int:
    """A file that hands its content to the page: a script, since files next to a page may be loaded as such only."""
    text = json.dumps(content, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    data = base64.b64encode(gzip.compress(text.encode("utf-8"), 9, mtime=0)).decode("ascii")
    return _write(folder / f"{name}.js", f'grueblerPack("{name}","{data}")\n'.encode("ascii"))


def _write(path: Path, content: bytes) -> int:
    write_whole(path, content)
    return len(content)


_Packs = Iterator[tuple[str, Any]]


def _chain_packs(links: int, mobility: int) -> _Packs:
    asked = {"links": links, "mobility": mobility, "start": 0}
    items: list[dict[str, Any]] = []
    while len(items) < listed_number(links, mobility):
        page = answer("chains", asked | {"start": len(items)}, LANGUAGES[0], _nothing)
        items += [item | {"picture": _bare(item["picture"])} for item in page["items"]]
    yield f"chains-{links}-{mobility}", {"assortments": page["assortments"], "items": items}


def _structure_packs(links: int, mobility: int, first: int) -> _Packs:
    from gruebler.page.realised import realised
    from gruebler.page.site_structures import structure_pack

    for number, chain in enumerate(islice(listed_chains(links, mobility), first, first + _TOGETHER), first):
        name = f"{links}-{mobility}-{number}"
        pack = structure_pack(Mechanism(chain, chain.links[0]), LANGUAGES)
        yield f"structure-{name}", pack
        if mobility == 1 and links <= _MOVED:
            yield f"moving-{name}", {text: realised(text) for text, *_ in pack["driven"]}


def _machine_packs(id: str) -> _Packs:
    from gruebler.page.site_structures import structure_pack
    from gruebler.pictures.linkage.element_pictures import contact_shapes
    from gruebler.teaching.catalog import entry
    from gruebler.teaching.catalog.feature_query import entry_mechanism

    record = entry(id)
    mechanism = entry_mechanism(record)
    content: dict[str, Any] = {"structure": {}}
    contacts, base = {}, None
    if record.dimensions is not None and record.space == "planar":
        content["model"] = answer("open", {"id": id}, LANGUAGES[0], _nothing)
        contacts = contact_shapes(record.linkage())
        mechanism = base = record.linkage().mechanism
    if "model" in content or record.in_space:
        with suppress(GrueblerError):  # what has no single drive stands still
            content["moving"] = _bare(answer("moving", {"id": id}, LANGUAGES[0], _nothing)["picture"])
    for lang in LANGUAGES:
        called = dict(zip(mechanism.chain.links, record.in_language(lang).chain().links, strict=True))
        content["structure"][lang] = structure_pack(mechanism, [lang], contacts=contacts, called=called, base=base)
    yield f"machine-{id}", content


def _catalog_packs(*ids: str) -> _Packs:
    from gruebler.teaching.catalog import entry
    from gruebler.teaching.catalog.feature_query import entry_features, entry_mechanism, features_to_json
    from gruebler.teaching.catalog.loader import searched_text

    lists = {lang: {each["id"]: each for each in answer("catalog", {}, lang, _nothing)} for lang in LANGUAGES}
    rows = []
    for id in ids:
        record = entry(id)
        chain = record.chain()
        langs = LANGUAGES[:1] if lists[LANGUAGES[0]][id]["moves"] else LANGUAGES  # letters of joints differ
        rows.append(
            {
                "entries": {lang: lists[lang][id] for lang in LANGUAGES},
                "pictures": {lang: _bare(answer("picture", {"id": id}, lang, _nothing)["picture"]) for lang in langs},
                "text": searched_text(record),
                "pairs": sorted({joint.pair.name for joint in chain.joints}),
                "features": features_to_json(entry_features(record))
                | {
                    "mobility": lists[LANGUAGES[0]][id]["counted"],
                    "multiple_joints": sum(joint.count > 1 for joint in entry_mechanism(record).chain.joints),
                },
            }
        )
    planar_first = sorted(PAIRS, key=lambda pair: Space.PLANAR not in pair.freedoms)
    symbols = {pair.name: sorted({pair.name, *pair.symbols.values()}) for pair in planar_first}
    yield "catalog", {"machines": rows, "symbols": symbols}


def _task_packs(kind: str, level: int, number: int) -> _Packs:
    from gruebler.page.site_tasks import TOLERANCES, task_pack

    tasks = [task_pack(f"{kind}-{level}-{seed}", LANGUAGES) for seed in range(1, number + 1)]
    yield f"tasks-{kind}-{level}", {"tasks": tasks, **TOLERANCES}


def _exercise_packs() -> _Packs:
    """The exercises of the text."""
    from gruebler.page.site_tasks import TOLERANCES, task_pack
    from gruebler.page.tasks import task_kinds

    *_, text = task_kinds(LANGUAGES[0])
    yield "tasks-exercise", {"tasks": [task_pack(task["id"], LANGUAGES) for task in text["tasks"]], **TOLERANCES}


def _common_packs() -> _Packs:
    """The kinds of exercises, and the pairs that a joint may have in the plane."""
    pairs = [
        {
            "text": pair.symbols.get(Alphabet.INTERNATIONAL, pair.name),
            "group": pair.is_group,
            "said": {
                lang: [pair.symbols.get(Alphabet.of_language(lang), ""), pair.plain_name(lang)] for lang in LANGUAGES
            },
        }
        for pair in PAIRS
        if Space.PLANAR in pair.freedoms
    ]
    yield "pairs", pairs
    yield "kinds", {lang: answer("exercise_kinds", {}, lang, _nothing) for lang in LANGUAGES}


def _point_packs() -> _Packs:
    from gruebler.page.site_points import point_packs

    yield from point_packs()


_PACKS: dict[str, Callable[..., _Packs]] = {
    "chains": _chain_packs,
    "structures": _structure_packs,
    "machine": _machine_packs,
    "catalog": _catalog_packs,
    "tasks": _task_packs,
    "exercises": _exercise_packs,
    "common": _common_packs,
    "points": _point_packs,
}
"""What each kind of work writes: names of files with their contents."""


def _bare(picture: str) -> str:
    """A picture without its title, which is in one language; the page names its pictures."""
    return re.sub(r"<title>.*?</title>|<desc>.*?</desc>", "", picture, flags=re.DOTALL)


def _nothing(_: str) -> None:
    return None
