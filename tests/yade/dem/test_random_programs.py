"""Random programs, seventy short ones: see random_programs.py and random_programs_space.py, which run any number of
them.
"""
import pytest
import random_programs
import random_programs_space
from yade import O

pytestmark = pytest.mark.usefixtures("empty")


@pytest.mark.parametrize("number", range(30))
def test_a_program_does_the_same_in_every_way(number):
    wrong, left_out = random_programs.check(random_programs.Program(number))
    assert not wrong, wrong
    assert set(left_out) <= {"beside", "plain"}


def test_programs_are_of_many_kinds_and_end_in_different_scenes():
    """They do something: each kind comes up, bonds break, disks slip, and no two programs end alike."""
    programs = [random_programs.Program(number) for number in range(30)]
    assert len(random_programs.KINDS) >= 50
    assert {e.name for p in programs for e in p.events} == set(random_programs.KINDS)
    ends, broken, slipped, contacts = set(), 0, 0, 0
    for p in programs[:8]:
        last = p.run("stepped")[-1]
        ends.add(str(sorted(last.items(), key=str)))
        broken += sum(last[k] for k in ("brokenTension", "brokenShear", "brokenTorque", "brokenMixed"))
        slipped += sum(s != (0.0).hex() for k, v in last.items() if k.startswith("slip") for s in v)
        contacts += sum(k.startswith("contact") for k in last)
    assert len(ends) == 8 and broken > 10 and slipped > 5 and contacts > 50
    O.reset()


@pytest.mark.parametrize("number", range(40))
def test_a_program_of_spheres_does_the_same_in_every_way(number):
    wrong, left_out = random_programs.check(random_programs.Program(number, world=random_programs_space.Space))
    assert not wrong, wrong
    assert set(left_out) <= {"beside", "plain"}


def test_programs_of_spheres_are_of_many_kinds_and_end_in_different_scenes():
    programs = [random_programs.Program(number, world=random_programs_space.Space) for number in range(40)]
    assert {e.name for p in programs for e in p.events} == set(random_programs_space.KINDS)
    ends, broken, contacts = set(), 0, 0
    for p in programs[:8]:
        last = p.run("stepped")[-1]
        ends.add(str(sorted(last.items(), key=str)))
        broken += sum(last[k] for k in ("brokenTension", "brokenShear", "brokenTorque", "brokenMixed"))
        contacts += sum(k.startswith("contact") for k in last)
    assert len(ends) == 8 and broken > 10 and contacts > 50
    O.reset()
