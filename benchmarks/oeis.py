"""Sequences for the OEIS out of docs/tables: `python -m benchmarks.oeis`.

docs/oeis has a b-file for each and drafts.txt, the texts of the entries.
"""

import csv
import textwrap
from collections.abc import Iterator
from typing import NamedTuple

from benchmarks.tables import FOLDER

OEIS = FOLDER.parent / "oeis"

_CHAIN = (
    "A chain is a connected simple graph, vertices links, edges turning joints, each link with two joints or more; "
    "with n links and m joints F = 3(n-1) - 2m, and 3(|S|-1) - 2e(S) >= 1 for every proper set S of two links or "
    "more with e(S) joints among them. Not fractionated: the graph has no cut vertex."
)
_BURNSIDE = (
    "Counted by Burnside's lemma on weighted contracted graphs, whose list agrees with generating functions; "
    "docs/tables/README.md says what else was counted twice."
)
_MODES = (
    "A Baranov truss is a planar chain of simple turning joints with F = 0 in which no smaller part is rigid. "
    "Modes are the ways to assemble it with complex coordinates and almost all dimensions, bodies not mirrored "
    "(docs/theory/counting-modes.md, with proofs and second methods). "
)
_PLANE = (
    "To 11 links every truss was counted by the program lnumber, too (Laman number over 2^(sum of k-2), k joints on "
    "a link); 13 links rest on one kernel but for a sample."
)
_SPHERE = (
    "To 9 links every truss was counted by the program lnumber, too, to 11 links by a second program (cross-ratio "
    "degrees); 13 links rest on one kernel but for a sample."
)
_TRAINS = "Links turn about axes, gear pairs have a carrier; docs/theory/epicyclic-trains.md has the definition. "
_TWICE = "Every term was confirmed by a second method."
_PRINT = (
    " Print (J. Mech. Des. 141(4) 043301) has 71837 displacement and 8654 rotation graphs of nine links; the numbers "
    "here, 71833 and 8652, come from three programs."
)


class Sequence(NamedTuple):
    """One entry; its terms are sums of a column over the rows of a table with these values and the same links."""

    file: str
    name: str
    table: str
    column: str
    where: dict[str, str]
    comment: str

    def terms(self) -> dict[int, int]:
        """By the number of links."""
        terms: dict[int, int] = {}
        for row in csv.DictReader((FOLDER / f"{self.table}.csv").read_text(encoding="utf-8").splitlines()):
            if all(row[key] == value for key, value in self.where.items()):
                links = int(row["links"])
                terms[links] = terms.get(links, 0) + int(row[self.column])
        return terms

    def index(self) -> str:
        """The number of links as a formula of n."""
        terms = self.terms()
        if min(terms) + 1 in terms:
            return "n links"
        shift = min(terms) - 2
        return f"2n{f' + {shift}' if shift else ''} links"

    def b_file(self) -> str:
        """One line a term: index and value."""
        terms = self.terms()
        first = min(terms)
        whole = self.index() == "n links"
        return "".join(
            f"{links if whole else (links - first) // 2 + 1} {value}\n" for links, value in sorted(terms.items())
        )

    def draft(self) -> str:
        """Name, terms and comments as they are typed into the form."""
        terms = self.terms()
        name = self.name.format(links=self.index())
        parts = (
            f"NAME: {name}.",
            f"DATA: {', '.join(str(value) for _, value in sorted(terms.items()))}",
            f"OFFSET: {self.b_file().split()[0]}",
            f"COMMENTS: {self.comment}",
            f"LINKS: {self.file}, b-file; docs/tables/{self.table}.csv, command and time in docs/tables/records.json",
            "KEYWORD: nonn,hard,more",
        )
        return "\n".join(textwrap.fill(part, 110, subsequent_indent="  ") for part in parts) + "\n"


def sequences() -> Iterator[Sequence]:
    """All entries."""
    for freedoms in range(8):
        yield Sequence(
            f"b_chains_{freedoms}.txt",
            f"Number of planar kinematic chains with {{links}}, F = {freedoms}, not fractionated",
            "chains",
            "chains",
            {"mobility": str(freedoms)},
            f"{_CHAIN} {_BURNSIDE}"
            + (" This is A233288, which has the terms to 18 links." if freedoms == 1 else "")
            + (" These are the Baranov trusses." if freedoms == 0 else ""),
        )
    for freedoms in (0, 1):
        yield Sequence(
            f"b_multiple_joints_{freedoms}.txt",
            f"Number of planar kinematic chains with {{links}}, F = {freedoms}, simple and multiple turning joints",
            "multiple_joints",
            "chains",
            {"mobility": str(freedoms)},
            "A joint of k links counts k - 1 joints; no two joints share two links; fractionated chains included "
            "(docs/theory/multiple-joints.md).",
        )
    yield Sequence(
        "b_sliding.txt",
        "Number of planar kinematic chains with {links}, F = 1, turning and sliding joints",
        "sliding",
        "chains",
        {"mobility": "1"},
        "Each joint turns or slides, all joints move at almost all dimensions; fractionated chains included. To 8 "
        "links compared with a list whose mobility is an exact rank (docs/tables/README.md).",
    )
    yield Sequence(
        "b_assur_groups.txt",
        "Number of Assur groups of simple turning joints with {links}",
        "assur_groups",
        "groups",
        {},
        "Minimal sets of links that are determined when their outer joints are given: orbits of links of the Baranov "
        "trusses with one link more. 1, 2, 10, 173 stand in print (Peisach 2007).",
    )
    for freedoms in (1, 2, 3):
        for kind in ("displacement", "rotation"):
            yield Sequence(
                f"b_trains_{kind}_{freedoms}.txt",
                f"Number of epicyclic gear trains with {{links}} and F = {freedoms}, as {kind} graphs",
                "epicyclic_trains",
                f"{kind}_graphs",
                {"mobility": str(freedoms)},
                _TRAINS + _TWICE + (_PRINT if freedoms == 1 else ""),
            )
    for where, prefix, second in (("plane", "", _PLANE), ("sphere", "spherical_", _SPHERE)):
        for value, words in (
            ("most", "Largest number of assembly modes of a Baranov truss"),
            ("sum", "Sum of the numbers of assembly modes of all Baranov trusses"),
        ):
            yield Sequence(
                f"b_modes_{where}_{value}.txt",
                f"{words} with {{links}}, {'in' if where == 'plane' else 'on'} the {where}",
                "assembly_modes",
                prefix + value,
                {},
                _MODES + second,
            )


def files() -> dict[str, str]:
    """The content of docs/oeis by the name of the file."""
    entries = list(sequences())
    head = (
        "Drafts of entries for the OEIS, made from docs/tables by `python -m benchmarks.oeis`. None is sent. Before "
        "one is, its first terms must be searched in the OEIS. A233288 is known to be there; for the trusses and the "
        "Assur groups a search by their terms in stored pages of the OEIS found nothing; no others were searched."
    )
    drafts = "\n".join([textwrap.fill(head, 110) + "\n", *(entry.draft() for entry in entries)])
    return {entry.file: entry.b_file() for entry in entries} | {"drafts.txt": drafts}


def main() -> None:
    OEIS.mkdir(exist_ok=True)
    for name, text in files().items():
        (OEIS / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
