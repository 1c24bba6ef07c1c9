"""The record of one transformation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from gruebler.base.immutable import settle
from gruebler.base.notebook import explained
from gruebler.base.text import listed, message, translate
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import Alphabet, pair
from gruebler.structure.transformations.places import Attachment, pairs_from_letters

_STEPS = {
    "insert_dyad": message("Dyad {form} of the links {links} between {places}."),
    "remove_dyad": message("Dyad of {links} removed."),
    "insert_coupler": message("Coupler {link} with joints {pairs} between {places}."),
    "remove_coupler": message("Coupler {link} removed."),
    "insert_group": message("Assur group {group} as the links {links} at {places}."),
    "remove_group": message("Assur group of {links} removed."),
    "contract": message("{kept} and {merged} joined to one link at {joint}."),
    "expand at": message("{link} split: the new link {new} takes {joints}; the two are joined at {joint}."),
    "expand by": message("{link} split: the new link {new} takes {joints}; the two are joined by a {pair} joint."),
    "expand at empty": message("{link} split: the new link {new} takes no other joint; the two are joined at {joint}."),
    "expand by empty": message(
        "{link} split: the new link {new} takes no other joint; the two are joined by a {pair} joint."
    ),
    "replace_roll_slide": message("{joint} replaced by the binary link {link} with joints {pairs}."),
    "restore_roll_slide": message("The binary link {link} replaced by a roll-slide joint."),
}


@explained
@dataclass(frozen=True)
class Step:
    """One transformation: its kind, its arguments, and the chains before and after.

    `where` holds the arguments of the function named `kind`, with all names explicit, as plain data, so that
    `gruebler.structure.transformations.replay` can apply the step again.
    """

    kind: str
    where: Mapping[str, Any]
    before: Chain
    chain: Chain
    """The new chain."""

    def __post_init__(self) -> None:
        settle(self, where=dict(self.where))

    def __hash__(self) -> int:
        return hash((self.kind, self.before, self.chain))

    def to_json(self) -> dict[str, Any]:
        """Plain data for `json.dumps`: kind, where, and the new chain as a text to compare with."""
        return {"kind": self.kind, "where": dict(self.where), "result": self.chain.text()}

    def explain(self, lang: str = "en") -> str:
        """The step in a sentence, in English (``en``) or German (``de``)."""
        where, kind, alphabet = dict(self.where), self.kind, Alphabet.of_language(lang)
        names = self.before.joint_names(alphabet)

        def written(place: Attachment) -> str:
            return place if isinstance(place, str) else translate("the joint {joint}", lang, joint=names[place])

        values = {key: str(value) for key, value in where.items()}
        for key in {"form", "pairs"} & values.keys():
            pairs = pairs_from_letters(values[key], len(values[key]), message("dyad"))
            values[key] = "".join(p.symbol(alphabet) for p in pairs)
        places = where.get("between") or where.get("at")
        if isinstance(places, list):
            values["places"] = listed(map(written, places), lang)
        if kind == "contract":
            values["kept"], values["merged"] = where["links"]
        if kind == "expand":
            values["joints"] = ", ".join(names[k] for k in where["joints"])
            if "at" in where:
                values["joint"] = names[where["at"]]
            else:
                values["pair"] = pair(where["pair"]).full_name(lang)
            kind = f"expand {'at' if 'at' in where else 'by'}{'' if where['joints'] else ' empty'}"
        elif "links" in where:
            values["links"] = ", ".join(where["links"])
        if "joint" in where:
            values["joint"] = names[where["joint"]]
        return _STEPS[kind].filled(**values).in_language(lang)
