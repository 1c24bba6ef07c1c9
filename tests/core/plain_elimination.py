"""Elimination modulo a prime in plain Python, with the pivots that the core is to take."""

P = 2**31 - 1


def eliminate(rows, share=0.1, fewest=40):
    """The pivot columns in order, and each row divided by its pivot, without it.

    A shortest row, the first of them, in it the rarest column, the first of them; where at least so many rows are left
    and have more than this share of entries, columns in ascending order, each with the first row that has it.
    """
    left = {i: {c: v % P for c, v in row.items() if v % P} for i, row in enumerate(rows)}
    left = {i: row for i, row in left.items() if row}
    pivots, reduced = [], []

    def take(i, pivot):
        row = left.pop(i)
        scale = pow(row.pop(pivot), -1, P)
        row = {c: v * scale % P for c, v in row.items()}
        for k, other in list(left.items()):
            if factor := other.pop(pivot, 0):
                merged = {c: (other.get(c, 0) - factor * row.get(c, 0)) % P for c in {*other, *row}}
                left[k] = {c: v for c, v in merged.items() if v}
            if not left[k]:
                del left[k]
        pivots.append(pivot)
        reduced.append(row)

    while left:
        met = {c for row in left.values() for c in row}
        if len(left) >= fewest and sum(map(len, left.values())) > share * len(left) * len(met):
            break
        i = min(left, key=lambda i: (len(left[i]), i))
        others = [row for k, row in left.items() if k != i]
        take(i, min(left[i], key=lambda c: (sum(c in row for row in others), c)))
    order = sorted(left)  # rows change places when the first of them has a zero
    while left:
        column = min(c for row in left.values() for c in row)
        order = [i for i in order if i in left]
        first = next(place for place, i in enumerate(order) if column in left[i])
        order[0], order[first] = order[first], order[0]
        take(order[0], column)
    return pivots, reduced
