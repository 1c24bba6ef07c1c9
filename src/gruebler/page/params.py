"""What each request of the page is given, with its limits: types by which parameters are checked as they are read."""

from __future__ import annotations

from math import pi
from typing import Annotated, Any, Literal

import msgspec

from gruebler.page.page import LISTED_CHAINS

Word = Annotated[str, msgspec.Meta(max_length=200)]
ChainText = Annotated[str, msgspec.Meta(max_length=5_000)]
Number = Annotated[int, msgspec.Meta(ge=0, le=100)]


class Params(msgspec.Struct, forbid_unknown_fields=True):
    """Parameters of a request; others are refused."""


class Nothing(Params):
    """No parameters."""


def _within(what: str) -> msgspec.Meta:
    """What a number of chains that are listed may be."""
    return msgspec.Meta(ge=LISTED_CHAINS[what]["min"], le=LISTED_CHAINS[what]["max"])


Row = Annotated[list[float], msgspec.Meta(min_length=2, max_length=3)]


class ListCatalog(Params):
    """Words that must all occur in a machine's name, remark, source or links, in either language; access features."""

    words: Word = ""
    pairs: Word = ""
    """Symbols or names of joint types that must occur."""
    joints: Word = ""
    """Numbers of joints by type, such as ``R:4,P:0``."""
    links: Number | None = None
    mobility: Annotated[int, msgspec.Meta(ge=-100, le=100)] | None = None
    drive_joints: Number | None = None
    drive_joints_at_frame: Number | None = None
    output_links: Number | None = None
    output_links_at_frame: Number | None = None
    binary: Number | None = None
    ternary: Number | None = None
    multiple_joints: Number | None = None


class CatalogId(Params):
    """A machine of the catalog, or an exercise."""

    id: Word


class DrawnBefore(Params):
    """A linkage out of which another one was drawn, and what the drawing called its links and joints."""

    document: dict[str, Any]
    links: Annotated[list[Word], msgspec.Meta(max_length=200)]
    letters: Annotated[list[Word], msgspec.Meta(max_length=400)]
    source: Word = ""


class RoundSizes(Params):
    """Other sizes of a round element at values of the drives.

    A cam has ``base`` and ``lift``, a roller ``circle``.
    """

    joint: Word
    link: Word
    sizes: dict[Word, float | ChainText]
    drives: Annotated[list[float], msgspec.Meta(max_length=100)]


class OpenDocument(Params):
    """A linkage as plain data (`gruebler.files.linkage_to_json`), with the loads of one that it was before.

    Or with other sizes of a cam or roller of it.
    """

    document: dict[str, Any]
    name: Word = ""
    source: Word = ""
    before: DrawnBefore | None = None
    resized: RoundSizes | None = None


class MeasureLinkage(Params):
    """A linkage as plain data, and the drive values between which it is measured; none for its whole range."""

    document: dict[str, Any]
    source: Word = ""
    between: Annotated[list[float], msgspec.Meta(max_length=2)] = []


class ResizeLinks(Params):
    """A linkage in space that is to have other sizes, and how its page calls it and its parts by language."""

    document: dict[str, Any]
    sizes: dict[Word, tuple[float | None, float | None]]
    """Distance and angle in degrees of a link, as far as they change."""
    titles: dict[str, Word] = {}
    drives: dict[str, list[Word]] = {}
    links: dict[str, list[Word]] = {}
    letters: dict[str, dict[Word, Word]] = {}
    between: tuple[float, float] | None = None
    """Values of the drives over which the page moves it, in place of all that they can reach."""


class ExportInSpace(Params):
    """A linkage in space of which a file is wanted, and how its page calls it and its parts by language."""

    document: dict[str, Any]
    kind: Word
    """``html``, or the name of a format of `gruebler.files`."""
    titles: dict[str, Word] = {}
    drives: dict[str, list[Word]] = {}
    links: dict[str, list[Word]] = {}
    letters: dict[str, dict[Word, Word]] = {}
    between: tuple[float, float] | None = None
    """Values of the drives over which the page moves it, in place of all that they can reach."""


class DescribeStructure(Params):
    """A chain or mechanism as text."""

    text: ChainText
    at_frame: bool = True
    """Whether only drives at the frame are listed."""
    document: dict[str, Any] = {}
    """A linkage of this chain, which says what its higher pairs are and what its sizes give."""
    names: dict[str, Word] = {}
    """How a reader calls the links, as far as they are in the chain."""


class DescribeDrawing(Params):
    """A chain that is drawn: joints as text and their names, frame, driven joints, open ends by links."""

    joints: ChainText
    frame: Word
    drives: Annotated[list[Number], msgspec.Meta(max_length=20)] = []
    names: Annotated[list[Word], msgspec.Meta(max_length=200)] = []
    ends: Annotated[dict[Word, Word], msgspec.Meta(max_length=200)] = {}
    cylinders: Annotated[list[Number], msgspec.Meta(max_length=200)] = []
    """Joints that are drawn as cylinders."""


class ListModes(Params):
    """A linkage at values of its drives, in radians or lengths."""

    document: dict[str, Any]
    drives: Annotated[list[float], msgspec.Meta(min_length=1, max_length=20)]


class ListChains(Params):
    """Chains of turning joints."""

    links: Annotated[int, _within("links")]
    mobility: Annotated[int, _within("mobility")] = 1
    start: Annotated[int, msgspec.Meta(ge=0, le=10_000)] = 0
    assortment: Annotated[list[Number], msgspec.Meta(min_length=1, max_length=20)] | None = None
    """The numbers of binary, ternary, ... links that they have; any if None."""


class OuterLoad(Params):
    """A force in newtons on a joint or a point, by its number, or where a load acts; on a link a moment, x."""

    on: Literal["joint", "point", "link", "place"]
    number: Number
    x: float = 0.0
    y: float = 0.0
    known: Number | None = None
    """The number of the load of the document or the catalog entry of which it has the law, whatever x and y are."""


Amount = Annotated[float, msgspec.Meta(ge=-1e9, le=1e9)]
Rate = Annotated[float, msgspec.Meta(ge=0, le=1e9)]


class OwnSpring(Params):
    """A spring, or a damper, between two links; it draws or turns them together."""

    ends: tuple[tuple[Number, float, float], tuple[Number, float, float]]
    """Link and place there; of a torsion spring the places say nothing."""
    turning: bool = False
    stiffness: Rate = 0.0
    free: Amount = 0.0
    """The length or the angle, in radians, at which only the preload acts."""
    preload: Amount = 0.0
    damping: Rate = 0.0
    known: Number | None = None
    """The number of the spring of the document or the catalog entry of which it has the law."""


class LoadedLinkage(Params):
    """A linkage at values of its drives, what the reader changed of what acts on it, and what of its motion is asked.

    What is not given acts as in the document, or as in the catalog entry if that has no loads.
    """

    document: dict[str, Any]
    drives: Annotated[list[float], msgspec.Meta(min_length=1, max_length=20)]
    source: Word = ""
    masses: Annotated[list[Annotated[float, msgspec.Meta(ge=0, le=1e9)] | None], msgspec.Meta(max_length=200)] = []
    """Of each link, in kilograms."""
    bars: Annotated[list[Number], msgspec.Meta(max_length=200)] | Literal["steel"] = []
    """Links whose mass lies along their bars, however long these are; or all are of steel, if no masses are given."""
    gravity: bool | None = None
    loads: Annotated[list[OuterLoad], msgspec.Meta(max_length=20)] | None = None
    """Forces on one place add up, as do moments on one link."""
    springs: Annotated[list[OwnSpring], msgspec.Meta(max_length=20)] | None = None
    active: Number = 0
    """The drive that runs at constant speed."""
    called: Annotated[list[str], msgspec.Meta(max_length=20)] = []
    """What the drives are called, where there are several."""
    range: tuple[float, float] = (0.0, 2 * pi)
    full: bool = True
    """Whether its range is whole turns; else its ends are limits, next to which no drive keeps its speed."""
    speed: Annotated[float, msgspec.Meta(gt=0, le=1e6)] | None = None
    """In rad/s or lengths a second."""
    until: Annotated[float, msgspec.Meta(gt=0, le=20)] = 2.0
    """How long it moves by itself, in seconds."""


class Realise(Params):
    """A mechanism for which dimensions are wanted."""

    text: ChainText
    seed: Annotated[int, msgspec.Meta(ge=0, le=10**9)] = 0


class SynthesiseTask(Params):
    """What a linkage is to do: the rows of its targets, angles in degrees."""

    rows: Annotated[list[Row], msgspec.Meta(min_length=1, max_length=60)]
    kind: Literal["points", "positions", "function", "dead-centres"] = "points"
    pivots: Annotated[list[Row], msgspec.Meta(max_length=4)] = []
    """Fixed pivots of a linkage through positions."""
    order: Annotated[list[int | None], msgspec.Meta(max_length=60)] = []
    """Of each point or position its place in the order, nothing at any time."""
    closed: bool = False
    crank: bool = True
    """Whether the drive must turn fully."""
    transmission: Annotated[float, msgspec.Meta(ge=0, le=90)] = 0.0
    """The least transmission angle, in degrees."""
    reach: Annotated[float, msgspec.Meta(ge=0, le=1e9)] | None = None
    """How far fixed pivots lie outside the rectangle about all places at most; anywhere without one."""
    longest_link: Annotated[float, msgspec.Meta(ge=0, le=1e9)] | None = None
    """How long a link of a linkage through places is at most."""


class Export(Params):
    """A linkage and the kind of file that is wanted of it."""

    document: dict[str, Any]
    kind: Word
    """``gif``, ``html``, ``pdf``, or the name of a format of `gruebler.files`."""
    name: Word = ""
    zoom: Annotated[float, msgspec.Meta(ge=0.5, le=4)] = 1.25
    """Pixels of a moving picture for one of the drawing."""


class OpenFile(Params):
    """A file that the reader opens."""

    name: Annotated[str, msgspec.Meta(min_length=1, max_length=200)]
    base64: Annotated[str, msgspec.Meta(max_length=400_000)]


class TryExercise(Params):
    """One of the linkages of an exercise."""

    id: Word
    part: Annotated[int, msgspec.Meta(ge=0, le=20)] = 0


class MarkAnswers(Params):
    """Answers to a task by key."""

    id: Word
    answers: dict[Word, Word]
