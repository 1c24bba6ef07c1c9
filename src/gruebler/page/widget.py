"""The page in a notebook cell: a linkage that is dragged there and read back as a `Linkage`."""

from __future__ import annotations

from typing import Any

import anywidget
import traitlets

from gruebler.base.errors import GrueblerError
from gruebler.base.text import LANGUAGES, Message, message, translate
from gruebler.files import linkage_from_json
from gruebler.mechanics.linkages import Linkage
from gruebler.page.model import model_of
from gruebler.page.page import LISTED_CHAINS, module_text, packed_text, page_styles
from gruebler.page.requests import answer, error_on_page
from gruebler.pictures.linkage.picture import draw_linkage

_UNREADABLE: Message = message("this is not a request of the page")


class Explorer(anywidget.AnyWidget):
    """A linkage in a notebook cell, to be dragged; `linkage` is what it has become.

    Args:
        linkage: a planar linkage whose drives fix its motion.
        lang: the language of the page; that of the browser if empty.
        height: of the cell, in pixels.
    """

    _esm = module_text()
    host = traitlets.Unicode("notebook").tag(sync=True)
    lang = traitlets.Unicode("").tag(sync=True)
    height = traitlets.Int(640).tag(sync=True)
    motion = traitlets.Unicode(packed_text("motion")).tag(sync=True)
    texts = traitlets.Unicode(packed_text("texts")).tag(sync=True)
    styles = traitlets.Unicode("").tag(sync=True)
    limits = traitlets.Dict(LISTED_CHAINS).tag(sync=True)
    machine = traitlets.Dict().tag(sync=True)
    document = traitlets.Dict().tag(sync=True)

    def __init__(self, linkage: Linkage, *, lang: str = "", height: int = 640) -> None:
        model = model_of(linkage)
        super().__init__(machine=model, document=model["document"], lang=lang, height=height, styles=page_styles())
        self.on_msg(self._asked)

    def __repr__(self) -> str:
        return f"<Explorer of {self.linkage.mechanism.chain}>"

    def _repr_mimebundle_(self, **kwargs: Any) -> tuple[dict[str, Any], dict[str, Any]] | None:
        """The widget, with a picture for saved notebooks that are shown without its state, as on GitHub."""
        bundle = super()._repr_mimebundle_(**kwargs)
        if bundle is None:
            return None
        linkage = self.linkage
        picture = draw_linkage(linkage, curves=[*linkage.points], labels=True, lang=self.lang or "en")
        return bundle[0] | {"image/svg+xml": picture.svg()}, bundle[1]

    @property
    def linkage(self) -> Linkage:
        """The linkage as it stands in the page now, with the pose that is shown as its reference pose."""
        return linkage_from_json(self.document)

    def _asked(self, _: object, content: Any, __: object) -> None:
        """Answer a request of the page; here nothing is cancelled, since the kernel does one thing at a time."""
        if not isinstance(content, dict) or content.get("cancel"):
            return
        number, lang = content.get("id"), content.get("lang")
        lang = lang if lang in LANGUAGES else LANGUAGES[0]
        method, params = content.get("method"), content.get("params", {})
        if not isinstance(method, str) or not isinstance(params, dict):
            self.send({"id": number, "error": translate(_UNREADABLE.text, lang)})
            return
        try:
            result = answer(method, params, lang, lambda text: self.send({"id": number, "progress": text}))
        except GrueblerError as error:
            self.send({"id": number, "error": error_on_page(error, lang)})
            return
        self.send({"id": number, "result": result})
