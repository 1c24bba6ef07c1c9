"""A document for any machine: pictures, access features, dimensions, main diagram, values; the book of the catalog."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from math import hypot, radians

from gruebler.base.errors import GrueblerError
from gruebler.base.text import message, number, translate
from gruebler.files import Entry
from gruebler.files.catalog_records import source_text
from gruebler.mechanics.analysis.measuring import measures
from gruebler.mechanics.linkages import Linkage, Pin
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.linkage.curve_plots import coupler_plot
from gruebler.pictures.linkage.element_pictures import contact_shapes
from gruebler.pictures.linkage.motion_plots import transfer_plot, transmission_plot
from gruebler.pictures.linkage.picture import draw_linkage, picture_notes
from gruebler.pictures.linkage.posed_linkage import posed_linkage
from gruebler.pictures.space import draw_spatial
from gruebler.pictures.structure import draw_structure
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.mechanism import Mechanism
from gruebler.structure.mechanism.inversion import family
from gruebler.structure.mobility import mobility_report
from gruebler.teaching.catalog import entries
from gruebler.teaching.catalog.feature_query import entry_mechanism
from gruebler.teaching.catalog.features import access_features, purpose
from gruebler.teaching.worksheets.blocks import Block, Contents, Document, Heading, PageBreak, Paragraph, Pictures, Rows
from gruebler.teaching.worksheets.machines_in_space import blocks_in_space
from gruebler.teaching.worksheets.places import headers, places

_POINTS = 3  # paths in one diagram


def machine_document(
    machine: Entry | Linkage | SpatialLinkage | Mechanism,
    *,
    lang: str = "en",
    between: tuple[float, float] | None = None,
    name: str = "",
) -> Document:
    """The collection sheet of a machine: a catalog entry, a linkage (also in space), a mechanism without dimensions.

    ``between`` are the drive values, in degrees or the unit, between which a linkage is shown. Cost: a second.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> made = machine_document(FourBar(25, 70, 40, 70).linkage())
    >>> made.title, sum(len(block.figures) for block in made.blocks if isinstance(block, Pictures))
    ('four-bar linkage', 3)
    """
    if isinstance(machine, Entry):
        title = machine.name.in_language(lang)
        return Document(title, tuple(_entry_blocks(machine, lang)), subtitle=machine.id, lang=lang)
    linkage = None if isinstance(machine, Mechanism) else machine
    mechanism = machine if isinstance(machine, Mechanism) else machine.mechanism
    title = name or family(mechanism, lang) or translate("mechanism", lang)
    blocks = _machine_blocks(mechanism, linkage, lang, between, () if linkage is None else linkage.outputs)
    return Document(title, (Heading(title, 1), *blocks), lang=lang)


def _entry_blocks(entry: Entry, lang: str) -> Iterator[Block]:
    shown = entry.in_language(lang)
    yield Heading(entry.name.in_language(lang), 1, entry.id)
    if entry.remark is not None:
        yield Paragraph(entry.remark.in_language(lang))
    source = source_text(entry.source, lang)
    yield Paragraph(translate("Source: {source}", lang, source=source), small=True)
    linkage: Linkage | SpatialLinkage | None = None if shown.dimensions is None else shown.linkage()
    if shown.in_space:
        linkage = shown.placed()
    sizes = shown.dimensions or shown.screws
    mechanism = entry_mechanism(shown) if linkage is None else linkage.mechanism
    yield from _machine_blocks(
        mechanism, linkage, lang, None if sizes is None else sizes.range, shown.outputs, shown.pictured()
    )


def _machine_blocks(
    mechanism: Mechanism,
    linkage: Linkage | SpatialLinkage | None,
    lang: str,
    between: tuple[float, float] | None,
    outputs: Sequence[str],
    still: Linkage | None = None,
) -> Iterator[Block]:
    shown = between
    if between is not None and mechanism.drives and mechanism.drives[0].turning:
        shown = radians(between[0]), radians(between[1])
    yield _pictures(mechanism, linkage or still, lang, outputs, shown)
    yield Heading(translate("Access features", lang))
    yield Rows(
        (translate("feature", lang), translate("value", lang)), access_features(mechanism, outputs).described(lang)
    )
    report = mobility_report(mechanism.chain, frame=mechanism.frame)
    yield Paragraph(
        f"{report.count.formula()}. {translate('Generic mobility: {mobility}.', lang, mobility=report.generic)}"
    )
    if isinstance(linkage, SpatialLinkage):
        yield from blocks_in_space(linkage, lang, shown)
    elif linkage is not None:
        yield from _blocks_in_plane(linkage, lang, shown, outputs)


def _blocks_in_plane(
    linkage: Linkage, lang: str, shown: tuple[float, float] | None, outputs: Sequence[str]
) -> Iterator[Block]:
    """Values, lengths, the position of the picture, the main diagram."""
    values = _values(linkage, outputs, lang)
    if values:
        yield Heading(translate("Values", lang))
        yield Paragraph(values)
    rows = tuple(_lengths(linkage, lang))
    if rows:
        sizes = message("Dimensions in {unit}", unit=linkage.unit) if linkage.unit else message("Dimensions")
        yield Heading(sizes.in_language(lang))
        yield Rows((translate("link", lang), translate("joints or points", lang), translate("distance", lang)), rows)
    yield from _position(linkage, lang, shown)
    diagrams = _diagrams(linkage, outputs, lang, shown)
    if diagrams:
        yield Heading(translate("Main diagram", lang))
        names, figures = tuple(diagrams), tuple(diagrams.values())
        for k in range(0, len(names), 2):  # two side by side
            yield Pictures(figures[k : k + 2], names[k : k + 2] if len(names) > 1 else (), 420.0)


def _pictures(
    mechanism: Mechanism,
    linkage: Linkage | SpatialLinkage | None,
    lang: str,
    outputs: Sequence[str],
    between: tuple[float, float] | None,
) -> Pictures:
    """The linkage to scale, if there are dimensions, and the structure with the symbols of the joints."""
    contacts = contact_shapes(linkage) if isinstance(linkage, Linkage) else None
    structure = draw_structure(mechanism, labels=True, symbols=True, contacts=contacts, outputs=outputs, lang=lang)
    caption = translate("Structure: symbols of the joints, curved arrow driven joint, double arrow output", lang)
    if linkage is not None:
        try:
            curves = [*linkage.points][:_POINTS] if len(linkage.mechanism.drives) == 1 else []
            if isinstance(linkage, SpatialLinkage):
                scheme = draw_spatial(linkage, between=between, curves=curves, labels=True, lang=lang)
            else:
                scheme = draw_linkage(linkage, between=between, curves=curves, labels=True, lang=lang)
        except GrueblerError:
            return Pictures((structure,), (caption,))
        return Pictures((scheme, structure), (translate("To scale", lang), caption), 260.0)
    return Pictures((structure,), (caption,))


def _lengths(linkage: Linkage, lang: str) -> Iterator[tuple[str, str, str]]:
    """The distances of the pins of every link, and of its named points from each of them."""
    chain = linkage.mechanism.chain
    alphabet = Alphabet.of_language(lang)
    names = [f"{joint.pair.symbol(alphabet)} {' / '.join(joint.links)}" for joint in chain.joints]
    for link in chain.links:
        pins = [(names[k], e) for (k, holder), e in linkage.elements.items() if holder == link and e.is_pin]
        points = [(name, Pin(point.x, point.y)) for name, point in linkage.points.items() if point.link == link]
        for k, (first, pin) in enumerate(pins):
            for second, other_pin in [*pins[k + 1 :], *points]:
                distance = hypot(other_pin.x - pin.x, other_pin.y - pin.y)
                yield link, f"{first} – {second}", number(distance, lang, ".6g")


def _position(linkage: Linkage, lang: str, between: tuple[float, float] | None) -> Iterator[Block]:
    """The position of the picture, from which the machine can be built again."""
    try:
        posed = posed_linkage(linkage, between=between)
    except GrueblerError:
        return
    with_unit = message("Places in the position shown, in {unit} and degrees", unit=linkage.unit)
    without = message("Places in the position shown, angles in degrees")
    yield Heading((with_unit if linkage.unit else without).in_language(lang))
    yield Paragraph(" ".join(picture_notes(posed, (), {}, lang)[0]))
    yield Rows(headers(lang), tuple(places(linkage, posed.pose, lang)))


def _diagrams(
    linkage: Linkage, outputs: Sequence[str], lang: str, between: tuple[float, float] | None
) -> dict[str, Figure]:
    """The paths of named points, else the transfer function of every output, else the transmission angle."""
    ways: list[dict[str, Callable[[], Figure]]] = [
        {
            output or "": partial(transfer_plot, linkage, output, between=between, lang=lang)
            for output in outputs or (None,)
        },
        {"": partial(transmission_plot, linkage, between=between, lang=lang)},
    ]
    if linkage.points:
        ways.insert(0, {"": partial(coupler_plot, linkage, [*linkage.points][:_POINTS], between=between, lang=lang)})
    drawn = ({key: figure for key, plot in each.items() if (figure := _drawn(plot)) is not None} for each in ways)
    return next((figures for figures in drawn if figures), {})


def _drawn(plot: Callable[[], Figure]) -> Figure | None:
    try:
        return plot()
    except GrueblerError:
        return None


def _values(linkage: Linkage, outputs: Sequence[str], lang: str) -> str:
    """What the measures of a linkage with one drive say, of every output; each line once."""
    if len(linkage.mechanism.drives) != 1:
        return ""
    lines: dict[str, None] = {}
    for output in outputs or (None,):
        try:
            lines |= dict.fromkeys(measures(linkage, output=output).explain(lang).splitlines())
        except GrueblerError:
            continue
    return "\n".join(lines)


# --- the book ----------------------------------------------------------------------------------------


def catalog_book(*, lang: str = "en", ids: Sequence[str] = ()) -> Document:
    """All machines of the catalog, each on pages of its own, with an index by feature; or the named ones.

    Cost: about a second for each machine.
    """
    known = entries()
    chosen: Mapping[str, Entry] = {id: known[id] for id in ids} if ids else known
    blocks: list[Block] = [Heading(translate("Contents", lang), 1)]
    names = message("machine"), message("name"), message("source"), message("page")
    headers = tuple(name.in_language(lang) for name in names)
    rows = tuple((id, entry.name.in_language(lang), source_text(entry.source, lang)) for id, entry in chosen.items())
    blocks.append(Contents(headers, rows))
    for entry in chosen.values():
        blocks += [PageBreak(), *_entry_blocks(entry, lang)]
    blocks += [PageBreak(), *_index(chosen, lang)]
    title = translate("Collection of mechanisms", lang)
    counted = translate("{count} machines", lang, count=len(chosen))
    return Document(title, tuple(blocks), subtitle=counted, lang=lang)


def _index(chosen: Mapping[str, Entry], lang: str) -> Iterator[Block]:
    """The machines by what they have: number of links, joints, drives, kind of output, mobility."""
    ids_by_feature: dict[tuple[str, str], list[str]] = {}
    for id, entry in chosen.items():
        mechanism = entry_mechanism(entry)
        features = access_features(mechanism, entry.outputs)
        space = mechanism.chain.space.adjective.in_language(lang)
        marks = [
            (translate("space", lang), space),
            (translate("links", lang), str(features.links)),
            (translate("drives", lang), str(features.drive_joints)),
            (translate("mobility", lang), str(mobility_report(mechanism.chain, frame=mechanism.frame).generic)),
            *(
                (translate("joint", lang), pair.full_name(lang).replace("_", " "))
                for pair, _ in features.joints_by_pair
            ),
        ]
        marks.append((translate("purpose", lang), purpose(mechanism, entry.outputs).in_language(lang)))
        for mark in marks:
            ids_by_feature.setdefault(mark, []).append(id)
    yield Heading(translate("Index by feature", lang), 1)
    headers = translate("feature", lang), translate("value", lang), translate("machines", lang)
    yield Rows(
        headers, tuple((*mark, ", ".join(ids_by_feature[mark])) for mark in sorted(ids_by_feature, key=_natural))
    )


def _natural(mark: tuple[str, str]) -> tuple[str, int, str]:
    return mark[0], int(mark[1]) if mark[1].isdigit() else 0, mark[1]
