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
    """The model of a linkage for the mechanism of a text, and what was found in each language.

    Links that have only numbers are named by their roles. Raises `GrueblerError` where no dimensions are found.

    >>> found = realised("R(0-1) R(1-2) R(2-3) R(3-0); drive=R(0-1)")
    >>> found["model"]["links"][:4], found["message"]["de"][:30]
    (['frame', 'crank', 'coupler', 'rocker'], 'D(Gestell-Kurbel) läuft um. Kl')
    """
    realisation = realise(named_by_roles(mechanism_of_text(text)), seed=seed)
    if realisation.linkage is None:
        raise GrueblerError("{message}", message=realisation.explain())
    names = {lang: link_names(realisation.linkage, "", lang) for lang in LANGUAGES}
    said = {
        lang: replace(realisation, mechanism=realisation.mechanism.renamed(names[lang])).explain(lang) for lang in names
    }
    return {"model": model_of(realisation.linkage), "message": said}
