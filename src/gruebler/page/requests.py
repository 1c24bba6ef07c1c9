"""What the page may ask of the library: each request has a name, typed parameters and plain data as its answer."""

from __future__ import annotations

import base64
import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache, partial
from itertools import islice
from math import tau
from typing import Any

import msgspec

from gruebler.base.errors import GrueblerError, LinkageError
from gruebler.base.text import LANGUAGES, error_in_language, translate
from gruebler.page.params import (
    CatalogId,
    DescribeDrawing,
    DescribeStructure,
    Export,
    ExportInSpace,
    ListCatalog,
    ListChains,
    ListModes,
    LoadedLinkage,
    MarkAnswers,
    MeasureLinkage,
    Nothing,
    OpenDocument,
    OpenFile,
    Params,
    Realise,
    ResizeLinks,
    SynthesiseTask,
    TryExercise,
)

Progress = Callable[[str], None]
_PAGE = 60  # pictures in one answer
_MOST_MODES = 64


def answer(method: str, params: Mapping[str, Any], lang: str, progress: Progress) -> Any:
    """The answer to a request as plain data.

    Args:
        method: a name in `REQUESTS`.
        params: its parameters, as JSON gives them.
        lang: the language of all texts.
        progress: is called with a sentence now and then while work goes on.

    Raises `GrueblerError` for what cannot be answered, wrong parameters included.

    >>> answer("structure", {"text": "R(0-1) R(1-2) R(2-3) R(3-0)"}, "en", print)["counted"]
    1
    """
    if method not in REQUESTS:
        raise GrueblerError("there is no request {method!r}", method=method[:40])
    kind, work = REQUESTS[method]
    try:
        typed = msgspec.convert(params, kind)
    except msgspec.ValidationError as error:
        raise GrueblerError("{method}: {problem}", method=method, problem=str(error)) from None
    return work(typed, lang, progress)


def error_on_page(error: GrueblerError, lang: str) -> str:
    """What an error says to a reader of the page: a sentence, without commands that nobody can give there.

    >>> error_on_page(GrueblerError("the loops are open; `gruebler check --explain` shows what they allow."), "en")
    'The loops are open.'
    """
    parts = re.split(r"(?<=[.;]) ", error_in_language(error, lang))
    text = re.sub(";$", ".", " ".join(part for part in parts if "`gruebler " not in part))
    word = re.match(r"[^\W\d_]+(?= )", text)
    return text[:1].upper() + text[1:] if word else text


def _list_catalog(asked: ListCatalog, lang: str, _: Progress) -> list[dict[str, Any]]:
    from gruebler.structure.mechanism import Mechanism
    from gruebler.structure.mobility import counted, mobility_report
    from gruebler.teaching.catalog.feature_query import FeatureQuery, entry_features, entry_mechanism, read_pairs
    from gruebler.teaching.catalog.kinds import machine_kinds
    from gruebler.teaching.catalog.loader import Query, search

    kinds = ((2, asked.binary), (3, asked.ternary))
    query = FeatureQuery(
        links=asked.links,
        mobility=asked.mobility,
        drive_joints=asked.drive_joints,
        drive_joints_at_frame=asked.drive_joints_at_frame,
        output_links=asked.output_links,
        output_links_at_frame=asked.output_links_at_frame,
        pairs=read_pairs(asked.joints) if asked.joints.strip() else (),
        kinds=tuple((k, number) for k, number in kinds if number is not None),
        multiple_joints=asked.multiple_joints,
    )
    named = search(Query(words=tuple(asked.words.split()), pairs=tuple(asked.pairs.split())))
    fitting = [candidate for candidate in named if query.fits(entry_mechanism(candidate), entry_features(candidate))]
    return [
        {
            "id": candidate.id,
            "name": candidate.name.in_language(lang),
            "kinds": list(machine_kinds(candidate)),
            "links": candidate.chain().n,
            "counted": counted(candidate.chain()),
            "special": candidate.claims.mobility,
            "idle": sum(freedom.freedoms for freedom in mobility_report(candidate.chain()).idle_freedoms)
            if candidate.claims.idle  # names all of them
            else 0,
            "moves": candidate.dimensions is not None and candidate.space == "planar",
            "space": candidate.in_space,
            "text": Mechanism(
                candidate.chain(), candidate.frame or candidate.chain().links[0], candidate.drives
            ).text(),
        }
        for candidate in fitting
    ]


def _catalog_picture(asked: CatalogId, lang: str, _: Progress) -> dict[str, str]:
    return {"picture": _machine_picture(asked.id, lang)}


@cache
def _machine_picture(id: str, lang: str) -> str:
    from gruebler.teaching.catalog import entry
    from gruebler.teaching.catalog.machine_pictures import draw_machine

    return draw_machine(entry(id), lang=lang).svg(styled=False)


def _moving(asked: CatalogId, lang: str, _: Progress) -> dict[str, str]:
    from gruebler.pictures.linkage.animation import scene, svg_of
    from gruebler.teaching.catalog import entry

    record = entry(asked.id)
    if record.in_space:
        return {"picture": _moving_in_space(asked.id, lang)}
    shown = scene(record.linkage(), between=record.between, lang=lang, name=record.name.in_language(lang))
    return {"picture": svg_of(shown, styled=False)}


@cache
def _moving_in_space(id: str, lang: str) -> str:
    """Few frames, since each one is drawn anew: of several drives the first one moves.

    Raises `LinkageError` for a machine without a drive.
    """
    from gruebler.mechanics.screws import SpatialLinkage
    from gruebler.pictures.space.animation import animate_spatial
    from gruebler.teaching.catalog import entry

    record = entry(id)
    linkage = record.placed()
    assert isinstance(linkage, SpatialLinkage)
    between = record.between or ((0.0, tau) if len(linkage.mechanism.drives) > 1 else None)
    picture = animate_spatial(linkage, between=between, seconds=1.2, lang=lang, name=record.name.in_language(lang))
    return replace(picture, clock=replace(picture.clock, seconds=2.0)).svg(styled=False)


def _in_space(asked: CatalogId, lang: str, _: Progress) -> str:
    from gruebler.page.space_page import machine_model, space_file

    return space_file(machine_model(asked.id, home=True, asks=True), lang)


def _resized(asked: ResizeLinks, lang: str, _: Progress) -> dict[str, Any]:
    from gruebler.files.screws import spatial_from_json
    from gruebler.mechanics.screws.resizing import resized
    from gruebler.page.space_page import space_model

    linkage = spatial_from_json(asked.document)
    called = dict(zip(linkage.mechanism.chain.links, asked.links.get(lang, ()), strict=False))
    try:
        changed = resized(linkage, asked.sizes, in_proportion=True)
    except LinkageError as error:
        link = error.values.get("link")
        raise LinkageError(error, **({} if link is None else {"link": called.get(link, link)})) from None
    model = space_model(changed, **_shown_in_space(asked), home=True, asks=True)
    if not model["motions"]:
        raise LinkageError("with these sizes the joints can be closed, but no drive moves it; change others as well")
    return model


def _shown_in_space(asked: ResizeLinks | ExportInSpace) -> dict[str, Any]:
    called = {"titles": asked.titles, "drives": asked.drives, "links": asked.links, "letters": asked.letters}
    return called | {"between": asked.between}


def _export_in_space(asked: ExportInSpace, lang: str, _: Progress) -> dict[str, str]:
    from gruebler.files.screws import spatial_from_json
    from gruebler.page.exchange import saved_file
    from gruebler.page.space_page import space_file, space_model

    linkage = spatial_from_json(asked.document)
    if asked.kind != "html":
        return saved_file(linkage, asked.kind, lang, {})
    model = space_model(linkage, **_shown_in_space(asked))
    return _file(space_file(model, lang).encode("utf-8"), "text/html")


def _open(asked: CatalogId, _: str, __: Progress) -> dict[str, Any]:
    from gruebler.page.model import model_of
    from gruebler.teaching.catalog import entry

    record = entry(asked.id)
    linkage = record.linkage()  # an entry without dimensions is refused in one sentence
    return model_of(linkage, name=record.name, source=record.id, between=record.between, stops=record.stops)


def _open_document(asked: OpenDocument, _: str, __: Progress) -> dict[str, Any]:
    from gruebler.files import linkage_from_json
    from gruebler.page.model import model_of, with_document

    linkage = linkage_from_json(asked.document)
    if (other := asked.resized) is not None:
        from gruebler.page.round_sizes import with_round_sizes

        linkage = with_round_sizes(linkage, other.joint, other.link, other.sizes, other.drives)
    model = with_document(model_of(linkage, name=asked.name, source=asked.source), linkage, asked.document)
    if asked.before is None:
        return model
    from gruebler.page.carried_loads import with_loads_before

    return with_loads_before(model, linkage, asked.before)


def _structure(asked: DescribeStructure, lang: str, _: Progress) -> dict[str, Any]:
    from gruebler.files.screws import any_linkage_from_json
    from gruebler.page.structures import structure_record

    linkage = any_linkage_from_json(asked.document) if asked.document else None
    return structure_record(asked.text, lang, at_frame=asked.at_frame, linkage=linkage, names=asked.names)


def _drawing(asked: DescribeDrawing, lang: str, _: Progress) -> dict[str, Any]:
    from gruebler.page.drawings import drawing_record

    return drawing_record(asked.joints, asked.frame, asked.drives, lang, asked.names, asked.ends, asked.cylinders)


def _modes(asked: ListModes, _: str, __: Progress) -> list[dict[str, Any]]:
    """Every assembly mode with the linkage in it."""
    from gruebler.files import linkage_from_json, linkage_to_json
    from gruebler.mechanics.kinematics.solve import assembly_modes, move_quietly

    linkage = linkage_from_json(asked.document)
    modes = []
    for label in assembly_modes(linkage, asked.drives)[:_MOST_MODES]:
        motion = move_quietly(linkage, [asked.drives], branch=label)
        if motion.complete:
            modes.append({"label": label, "document": linkage_to_json(linkage.with_reference_pose(motion.pose()))})
    return modes


def _chains(asked: ListChains, lang: str, progress: Progress) -> dict[str, Any]:
    from gruebler.page.structures import kinds_as_read, kinds_in_words, listed_chains, listed_numbers
    from gruebler.pictures.structure import draw_structure
    from gruebler.pictures.structure.messages import chain_name
    from gruebler.structure.isomorphism import code

    def said(text: Callable[[str], str]) -> dict[str, str]:
        return {language: text(language) for language in LANGUAGES}

    numbers = listed_numbers(asked.links, asked.mobility)
    total = sum(numbers.values()) if asked.assortment is None else numbers.get(tuple(asked.assortment), 0)
    listed = listed_chains(asked.links, asked.mobility, asked.assortment) if total else iter(())
    items = []
    for chain in islice(listed, asked.start, asked.start + _PAGE):
        picture = draw_structure(chain, lang=lang).svg(styled=False)
        item = {"code": code(chain), "text": chain.text(), "assortment": chain.assortment, "picture": picture}
        items.append(item | {"name": said(partial(chain_name, chain)), "kinds": said(partial(kinds_as_read, chain))})
        if len(items) % 10 == 0:
            progress(translate("{done} of {total} chains", lang, done=asked.start + len(items), total=total))
    assortments = [
        {"links": links, "kinds": said(partial(kinds_in_words, dict(enumerate(links, 2)))), "chains": count}
        for links, count in numbers.items()
    ]
    return {"total": total, "start": asked.start, "assortments": assortments, "items": items}


def _realise(asked: Realise, lang: str, progress: Progress) -> dict[str, Any]:
    from gruebler.page.realised import realised

    progress(translate("Looking for dimensions with which it moves", lang))
    return realised(asked.text, asked.seed)


def _synthesise(asked: SynthesiseTask, lang: str, progress: Progress) -> dict[str, Any]:
    from gruebler.page.designs import design_records, task_of

    task = task_of(asked.kind, asked.rows, closed=asked.closed, pivots=asked.pivots, order=asked.order)
    return design_records(task, asked.crank, asked.transmission, lang, progress, asked.reach, asked.longest_link)


def _measures(asked: MeasureLinkage, lang: str, _: Progress) -> dict[str, Any]:
    from gruebler.files import linkage_from_json
    from gruebler.mechanics.analysis.drive_cycles import drive_cycle, part_of_cycle
    from gruebler.mechanics.analysis.measuring import measures_of
    from gruebler.mechanics.analysis.outputs import find_output
    from gruebler.mechanics.analysis.several_drives import several_drives_lines
    from gruebler.page.given_sizes import given_sizes
    from gruebler.page.model import link_names, names_of_points, spaced
    from gruebler.teaching.catalog import entries

    linkage = linkage_from_json(asked.document)
    if not linkage.mechanism.drives:
        return {"lines": []}
    names = link_names(linkage, asked.source, lang).items()
    named = linkage.renamed({link: spaced(name) for link, name in names})
    given = list(given_sizes(named, names_of_points(linkage, asked.source, lang), lang))
    if len(linkage.mechanism.drives) > 1:
        record = entries().get(asked.source)
        lines = several_drives_lines(named, record.stops if record else ())
        return {"lines": [*(line.in_language(lang) for line in lines), *given]}
    cycle = drive_cycle(named)
    if len(asked.between) == 2:
        cycle = part_of_cycle(cycle, *asked.between)
    return {"lines": [*measures_of(cycle, named, find_output(named, None)).explain(lang).splitlines(), *given]}


def _forces(asked: LoadedLinkage, lang: str, _: Progress) -> dict[str, Any]:
    from gruebler.page.forces import forces_record

    return forces_record(asked, lang)


def _fall(asked: LoadedLinkage, lang: str, _: Progress) -> dict[str, Any]:
    from gruebler.page.forces import fall_record

    return fall_record(asked, lang)


def _export(asked: Export, lang: str, _: Progress) -> dict[str, str]:
    from gruebler.files import linkage_from_json

    linkage = linkage_from_json(asked.document)
    if asked.kind == "html":
        from gruebler.page.model import model_of, with_document
        from gruebler.page.page import single_file

        model = with_document(model_of(linkage, name=asked.name), linkage, asked.document)
        return _file(single_file(model, lang).encode("utf-8"), "text/html")
    if asked.kind == "gif":
        from gruebler.pictures.linkage.animation_frames import animated_frames

        return _file(animated_frames(linkage, "gif", zoom=asked.zoom, lang=lang, name=asked.name), "image/gif")
    if asked.kind != "pdf":
        from gruebler.page.exchange import saved_file

        return saved_file(linkage, asked.kind, lang, asked.document)
    from gruebler.pictures.canvas.files import picture_bytes
    from gruebler.pictures.linkage.picture import draw_linkage

    return _file(picture_bytes(draw_linkage(linkage, lang=lang, name=asked.name), "pdf"), "application/pdf")


def _file(content: bytes, kind: str) -> dict[str, str]:
    return {"base64": base64.b64encode(content).decode("ascii"), "type": kind}


def _open_file(asked: OpenFile, lang: str, _: Progress) -> dict[str, Any]:
    from gruebler.page.exchange import opened_file

    return opened_file(asked.name, asked.base64, lang)


def _saved_kinds(_: Nothing, lang: str, __: Progress) -> list[dict[str, str]]:
    from gruebler.page.exchange import saved_kinds

    return saved_kinds(lang)


def _task_kinds(_: Nothing, lang: str, __: Progress) -> list[dict[str, str]]:
    from gruebler.page.tasks import task_kinds

    return task_kinds(lang)


def _task(asked: CatalogId, lang: str, _: Progress) -> dict[str, Any]:
    from gruebler.page.tasks import task_record

    return task_record(asked.id, lang)


def _marked_task(asked: MarkAnswers, lang: str, _: Progress) -> dict[str, Any]:
    from gruebler.page.tasks import marked_task

    return marked_task(asked.id, asked.answers, lang)


def _tried_task(asked: TryExercise, _: str, __: Progress) -> dict[str, Any]:
    from gruebler.page.tasks import tried_task

    return tried_task(asked.id)[asked.part]


REQUESTS: dict[str, tuple[type[Params], Callable[[Any, str, Progress], Any]]] = {
    "catalog": (ListCatalog, _list_catalog),
    "picture": (CatalogId, _catalog_picture),
    "space": (CatalogId, _in_space),
    "resize": (ResizeLinks, _resized),
    "export_in_space": (ExportInSpace, _export_in_space),
    "moving": (CatalogId, _moving),
    "open": (CatalogId, _open),
    "open_document": (OpenDocument, _open_document),
    "structure": (DescribeStructure, _structure),
    "drawing": (DescribeDrawing, _drawing),
    "modes": (ListModes, _modes),
    "chains": (ListChains, _chains),
    "realise": (Realise, _realise),
    "synthesise": (SynthesiseTask, _synthesise),
    "measures": (MeasureLinkage, _measures),
    "forces": (LoadedLinkage, _forces),
    "fall": (LoadedLinkage, _fall),
    "export": (Export, _export),
    "open_file": (OpenFile, _open_file),
    "saved_kinds": (Nothing, _saved_kinds),
    "exercise_kinds": (Nothing, _task_kinds),
    "exercise": (CatalogId, _task),
    "mark": (MarkAnswers, _marked_task),
    "try": (TryExercise, _tried_task),
}
"""Name, parameters, work."""
