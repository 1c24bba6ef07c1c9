"""Drives on a part of a joint in codes: one of several freedoms, two links of a multiple joint.

The oracle is the automorphism group acting on the choices of frame and drives themselves
(`gruebler.structure.mechanism.inversion`), and a search through all renamings of small mechanisms.
"""

from itertools import combinations, permutations

from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler.structure.isomorphism import decode, find_isomorphism
from gruebler.structure.mechanism import Drive, Mechanism
from gruebler.structure.mechanism.inversion import driven_mechanisms
from tests.strategies import PLANAR, SPATIAL, chains, renumbered

ANY = st.one_of(chains(pairs=PLANAR, most_links=6), chains(pairs=SPATIAL, space="spatial", most_links=5))


def choices(chain):
    """Every single drive of a chain."""
    return [
        Drive(number, direction, pair)
        for number, joint in enumerate(chain.joints)
        for direction in joint.pair.freedoms[chain.space]
        for pair in combinations(joint.links, 2)
    ]


def same_by_renaming(one, other):
    """Whether some renaming of the links makes two mechanisms equal."""
    if one.chain.n != other.chain.n:
        return False
    for names in permutations(other.chain.links):
        new = dict(zip(one.chain.links, names, strict=True))
        drives = [Drive(d.joint, d.direction, (new[d.between[0]], new[d.between[1]])) for d in one.drives]
        renamed = Mechanism(one.chain.renamed(new), new[one.frame], drives)
        if renamed == other:
            return True
    return False


@given(ANY, st.data())
def test_a_code_is_blind_to_numbering_and_decoded_again(chain, data):
    frame = data.draw(st.sampled_from(chain.links))
    drives = data.draw(st.lists(st.sampled_from(choices(chain)), max_size=3, unique=True))
    one = Mechanism(chain, frame, drives)
    text = one.code()
    back = Mechanism.parse(text)
    assert back.code() == text
    assert len(back.drives) == len(drives)
    assert len(decode(text).drives) == len(drives)
    other = data.draw(renumbered(chain))
    found = find_isomorphism(chain, other)
    moved = [
        Drive(found.joints[d.joint], d.direction, (found.links[d.between[0]], found.links[d.between[1]]))
        for d in one.drives
    ]
    assert Mechanism(other, found.links[frame], moved).code() == text


SMALL = st.one_of(
    chains(pairs=("revolute", "roll_slide"), most_links=4),
    chains(pairs=("cylindrical", "spherical", "revolute"), space="spatial", most_links=4),
)


@given(SMALL, st.data())
@settings(max_examples=50)
def test_equal_codes_exactly_if_a_renaming_exists(chain, data):
    one, other = (
        Mechanism(
            chain,
            data.draw(st.sampled_from(chain.links)),
            data.draw(st.lists(st.sampled_from(choices(chain)), min_size=1, max_size=2, unique=True)),
        )
        for _ in range(2)
    )
    assert (one.code() == other.code()) == same_by_renaming(one, other)


@given(SMALL, st.integers(1, 2))
@settings(max_examples=12)
def test_as_many_codes_as_orbits(chain, number):
    """Every orbit of frames and drives has a code of its own."""
    found = [driven.mechanism.code() for driven in driven_mechanisms(chain, drives=number, at_frame=False)]
    assert len(set(found)) == len(found)
    every = {
        Mechanism(chain, frame, drives).code()
        for frame in chain.links
        for drives in combinations(choices(chain), number)
    }
    assert every == set(found)


def test_by_hand():
    """The pin of a V-compressor, driven against either connecting rod or between both."""
    vee = "R(frame-crank) R(crank-rod1-rod2) R(rod1-piston1) R(rod2-piston2) P(frame-piston1) P(frame-piston2)"
    codes = {
        part: Mechanism.parse(f"{vee}; drive=R(crank-rod1-rod2):{part}").code()
        for part in ("crank-rod1", "rod1-crank", "crank-rod2", "rod1-rod2")
    }
    assert codes["crank-rod1"] == codes["rod1-crank"] == codes["crank-rod2"] != codes["rod1-rod2"]
    turned, pushed = (Mechanism.parse(f"spatial: C(a-b) S(b-c) R(c-a); drive=C(a-b):{d}").code() for d in ("Rz", "Tz"))
    assert turned != pushed
    assert pushed.endswith(";drives=0:Tz")


def test_mechanisms_with_one_and_with_two_of_two_equal_joints_driven_differ():
    one = Mechanism.parse("G(0-1) R(0-2) G(0-1); frame=1; drive=G(0-1):Tx")
    two = Mechanism.parse("G(0-1) R(0-2) G(0-1); frame=1; drive=G(0-1):Tx; drive=G(0-1)#2:Tx")
    assert one != two
    assert one.code() != two.code()
    same = Mechanism.parse("G(0-1) R(0-2) G(0-1); frame=0; drive=G(0-1):Rz; drive=G(0-1):Tx")
    apart = Mechanism.parse("G(0-1) R(0-2) G(0-1); frame=0; drive=G(0-1):Rz; drive=G(0-1)#2:Tx")
    assert same != apart
    assert same.code() != apart.code()
