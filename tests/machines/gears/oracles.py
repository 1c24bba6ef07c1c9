"""Another hand: wheels as circles in the plane that roll on one another, their velocities found by least squares."""

import numpy as np


def rolling(meshes, drives):
    """Speeds of all links from equal velocities at the pitch points; wheels by radius, centres found by the meshes.

    All central wheels lie at the origin, planets on the x axis: meshes (a, b, radius_a, radius_b, carrier) with the
    planet as b, radius_a negative for a ring. Unknown: each link's angular speed, each planet centre's velocity.
    """
    links = list(dict.fromkeys(name for mesh in meshes for name in (mesh[0], mesh[1], mesh[4])))
    planets = list(dict.fromkeys(mesh[1] for mesh in meshes))
    column = {name: k for k, name in enumerate(links)}
    column |= {(planet, axis): len(links) + 2 * k + axis for k, planet in enumerate(planets) for axis in (0, 1)}
    rows, right = [], []

    def add(terms, value=0.0):
        row = np.zeros(len(column))
        for key, factor in terms:
            row[column[key]] += factor
        rows.append(row)
        right.append(value)

    for a, planet, radius_a, radius_b, carrier in meshes:
        centre = abs(radius_a + radius_b)
        pitch = abs(radius_a)
        # v = omega x r: a point at (x, 0) of a link about the origin has the velocity (0, omega x).
        add([((planet, 1), 1), (planet, pitch - centre), (a, -pitch)])
        add([((planet, 1), 1), (carrier, -centre)])
        add([((planet, 0), 1)])
    for link, speed in drives.items():
        add([(link, 1)], float(speed))
    found, _, rank, _ = np.linalg.lstsq(np.array(rows), np.array(right), rcond=None)
    assert rank == len(column)
    assert np.abs(np.array(rows) @ found - right).max() < 1e-9
    return {link: found[column[link]] for link in links}


def fits(sun, planet_sun, planet_ring, ring, turns):
    """Whether an equal planet fits at the old place after the carrier has turned so far: all rotations tried."""
    # The ring is held; the sun turns by turns * (1 + ratio), in parts of a tooth.
    moved = turns * (1 + ring * planet_sun / (sun * planet_ring)) * sun
    return any((moved + k * planet_sun / planet_ring) % 1 == 0 for k in range(int(planet_ring)))


def slow_echelon(rows, columns):
    """The reduced echelon form by Gauss and Jordan, row by row, every row against every other."""
    found = {}
    for row in rows:
        rest = slow_reduced(row, found)
        pivot = next((column for column in columns if column in rest), None)
        if pivot is None:
            continue
        rest = {column: value / rest[pivot] for column, value in rest.items()}
        for other, known in found.items():
            if pivot in known:
                found[other] = minus(known, known[pivot], rest)
        found[pivot] = rest
    return found


def slow_reduced(row, basis):
    rest = {column: value for column, value in row.items() if value}
    for pivot, known in basis.items():
        if pivot in rest:
            rest = minus(rest, rest[pivot], known)
    return rest


def minus(row, factor, other):
    sums = {column: row.get(column, 0) - factor * other.get(column, 0) for column in (*row, *other)}
    return {column: value for column, value in sums.items() if value}
