"""Dimensions with which a mechanism of the structure view moves, as plain data."""

from __future__ import annotations

from typing import Any

from gruebler.base.errors import GrueblerError
from gruebler.design.realisation.realising import realise
from gruebler.page.model import model_of
from gruebler.page.structures import mechanism_of_text
from gruebler.structure.mechanism.link_roles import named_by_roles


def realised(text: str, seed: int = 0) -> dict[str, Any]:
    """The model of a linkage for the mechanism of a text, which moves.

    Links that have only numbers are named by their roles, with the drives that were found where the text has none.
    Raises `GrueblerError` where no dimensions are found.

    >>> realised("R(0-1) R(1-2) R(2-3) R(3-0)")["links"][:4]
    ['frame', 'crank', 'coupler', 'rocker']
    """
    realisation = realise(mechanism_of_text(text), seed=seed)
    if realisation.linkage is None:
        raise GrueblerError("{message}", message=realisation.explain())
    named = named_by_roles(realisation.mechanism)
    linkage = realisation.linkage.renamed(dict(zip(realisation.mechanism.chain.links, named.chain.links, strict=True)))
    return model_of(linkage)
