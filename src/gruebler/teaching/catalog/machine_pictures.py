"""The picture of a machine of the catalog: to scale in the plane or in space, standing still, else its structure."""

from __future__ import annotations

from gruebler.files.catalog_records import Entry
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.pictures.canvas.figure import Figure
from gruebler.structure.mechanism import Mechanism


def draw_machine(record: Entry, *, labels: bool = False, structure: bool = False, lang: str = "en") -> Figure:
    """The machine as far as the entry gives its sizes; with ``structure`` its mechanism without them.

    >>> from gruebler.teaching.catalog import entry
    >>> draw_machine(entry("scissor_lr")).description.partition(".")[0], draw_machine(entry("quad")).title
    ('Links: 6 (ternary: 4, quaternary: 2)', 'Four-bar chain')
    """
    from gruebler.pictures.linkage.element_pictures import contact_shapes
    from gruebler.pictures.linkage.picture import draw_linkage
    from gruebler.pictures.space import draw_spatial
    from gruebler.pictures.structure import draw_structure

    shown, name = record.in_language(lang), record.name.in_language(lang)
    if not structure:
        if record.dimensions is not None:
            return draw_linkage(shown.linkage(), between=record.between, labels=labels, lang=lang, name=name)
        if (still := shown.pictured()) is not None:
            return draw_linkage(still, labels=labels, lang=lang, name=name)
        if record.in_space and isinstance(placed := shown.placed(), SpatialLinkage):
            return draw_spatial(placed, symbols=False, labels=labels, lang=lang, name=name)
    contacts = None if record.dimensions is None else contact_shapes(shown.linkage())
    mechanism = Mechanism(shown.chain(), shown.frame or shown.chain().links[0], shown.drives)
    return draw_structure(
        mechanism if record.frame is not None else shown.chain(), labels=labels, contacts=contacts, lang=lang, name=name
    )
