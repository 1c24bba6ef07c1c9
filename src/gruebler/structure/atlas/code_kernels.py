"""The canonical texts of a chain: its code, and its graph6 form."""

from gruebler._numeric.compiling import njit
from gruebler._numeric.counting.chain_lists import add_graph6_edge, begin_graph6
from gruebler._numeric.labelling.label_workspace import LABELLING
from gruebler.structure.atlas.chain_memory import DIGIT, MOST_MEMBERS, ChainMemory, UInt8


@njit(cache=True)
def sort_joints(n: int, joints: int, desk: ChainMemory) -> None:
    """Ranks of the links, digits of the joints, and the canonical order of the joints."""
    for v in range(n):
        desk.rank[v] = desk.workspace.rows[LABELLING, v]
    for j in range(joints):
        ranks = 0
        for v in range(n):
            if desk.members[j] >> v & 1:
                ranks |= 1 << desk.rank[v]
        key = 0
        free = MOST_MEMBERS
        r = 0
        while ranks:
            if ranks & 1:
                free -= 1
                key |= (r + 1) << (DIGIT * free)
            ranks >>= 1
            r += 1
        desk.keys[j] = key
        i = j
        while i > 0 and desk.keys[desk.order[i - 1]] > key:
            desk.order[i] = desk.order[i - 1]
            i -= 1
        desk.order[i] = j


@njit(cache=True)
def write_code(joints: int, letters: UInt8, at: int, desk: ChainMemory, text: UInt8) -> int:
    """The canonical code, such as gr1:R(0-1)R(0-2)...; returns where the next one begins."""
    for letter in (103, 114, 49, 58):
        text[at] = letter
        at += 1
    for k in range(joints):
        j = desk.order[k]
        text[at] = letters[desk.kinds[j]]
        text[at + 1] = 40
        at += 2
        for i in range(MOST_MEMBERS):
            digit = desk.keys[j] >> (DIGIT * (MOST_MEMBERS - 1 - i)) & ((1 << DIGIT) - 1)
            if digit == 0:
                break
            if i:
                text[at] = 45
                at += 1
            if digit > 10:
                text[at] = 48 + (digit - 1) // 10
                at += 1
            text[at] = 48 + (digit - 1) % 10
            at += 1
        text[at] = 41
        at += 1
    return at


@njit(cache=True)
def write_graph6(n: int, joints: int, desk: ChainMemory, line: UInt8) -> None:
    """The graph6 form with the links in canonical order, without a line end."""
    head = begin_graph6(n, line)
    for j in range(joints):
        key = desk.keys[j] >> (DIGIT * (MOST_MEMBERS - 2))
        u, v = (key >> DIGIT) - 1, (key & ((1 << DIGIT) - 1)) - 1
        add_graph6_edge(u, v, head, line)
