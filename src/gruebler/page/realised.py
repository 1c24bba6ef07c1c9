"""Dimensions with which a mechanism of the structure view moves, as plain data."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from gruebler.base.errors import GrueblerError
from gruebler.base.text import LANGUAGES
from gruebler.design.realisation.realising import realise
from gruebler.page.model import link_names, model_of
from gruebler.page.structures import mechanism_of_text
from gruebler.structure.mechanism.link_roles import named_by_roles


def realised(text: str, seed: int = 0) -> dict[str, Any]:
    """The model of a linkage for the mechanism of a text, and how far its drives go in each language.

    Links that have only numbers are named by their roles, with the drives that were found where the text has none.
    Raises `GrueblerError` where no dimensions are found.

    >>> answer = realised("R(0-1) R(1-2) R(2-3) R(3-0)")
    >>> answer["model"]["links"][:4], answer["message"]["de"]
    (['frame', 'crank', 'coupler', 'rocker'], 'D(Gestell-Kurbel) läuft um.')
    """
    realisation = realise(mechanism_of_text(text), seed=seed)
    if realisation.linkage is None:
        raise GrueblerError("{message}", message=realisation.explain())
    named = named_by_roles(realisation.mechanism)
    linkage = realisation.linkage.renamed(dict(zip(realisation.mechanism.chain.links, named.chain.links, strict=True)))
    said = {
        lang: replace(realisation, mechanism=named.renamed(link_names(linkage, "", lang))).ranges_text(lang)
        for lang in LANGUAGES
    }
    return {"model": model_of(linkage), "message": said}
