"""The degree of a bound is of what is computed."""

import tomllib
from dataclasses import replace
from fractions import Fraction

import pytest

from derive.check.checker import Checker
from derive.check.values.arithmetic import scalar
from derive.check.values.residue import Graded
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.record.record import Equation

BITS = 64
"""Of the random integers: a number of degree d in them has d times as many."""
HEAD = 'name = "large"\ngroup = "{group}"\n[parameters]\na = 1.0\n'
POINTS = """
[[point]]
mass = "{mass}"
at = ["{at}", 1]
[[point]]
mass = 2
at = [0, 1]
[[point]]
mass = 3
at = [1, 3]
"""
PLAIN = POINTS.format(mass=1, at=1)
SPRING = '[[potential]]\nkind = "spring"\n{what}\nanchor = [3, 1]\nstiffness = "{k}"\n'
LARGE = "(a^50)^12"
SOLID = "".join(
    f"[[point]]\nmass = 1\nat = {at}\n" for at in ([1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1])
)
PARTS = {
    "body": POINTS.format(mass=LARGE, at=LARGE),
    "potentials": PLAIN + SPRING.format(what="on = 1", k=LARGE),
    "places": PLAIN + SPRING.format(what=f'at = ["{LARGE}", 1]', k=1),
    "damping": f'{PLAIN}[[damping]]\ncoefficient = "{LARGE}"\non = [1]\n',
    "given": '[body]\ngiven = { m = "(a^50)^4", c = ["a", 1], J = [["a", 0], [0, "3*a"]] }',
}


def walked(text, group="SE(2)"):
    return walk(problem_of(tomllib.loads(HEAD.format(group=group) + text)))


def claims(env):
    """Every name that has a value, every member of a family: that it is zero; and its values."""
    for name, value in env.names.items():
        yield Equation(name, 0), [value]
    for name, members in env.families.items():
        indices = ("i", "j")[: len(next(iter(members)))]
        yield Equation(("at", name, *indices), 0), members.values()


def height(value):
    """The least degree in the random integers that an exact number can be of, its numerator."""
    value = scalar(value)
    entries = [x for row in value for x in row] if isinstance(value, tuple) else [value]
    return max(Fraction(x).numerator.bit_length() // (BITS + 1) for x in entries)


def exceeding(d, **supposed):
    """The false claims whose degree is beyond what the checker's bound rests on."""
    checker = Checker(d.problem)
    step = replace(d["large.motion"], **{"driven": False, "hypotheses": (), **supposed})
    (group,) = checker.groups(step.scope, driven=step.driven)
    env = checker.environment(group, step, 2**BITS)
    for claim, values in claims(env):
        if max(map(height, values)) > checker.bound(replace(step, equations=(claim,))):
            yield claim.lhs


def forgetful(self, other):
    """A product that forgets the degree of a factor."""
    return self if other else Fraction(0)


@pytest.mark.parametrize("part", PARTS)
def test_no_degree_is_larger_than_that_of_the_bound(part, monkeypatch):
    """And it would be, for some name, if a product forgot a factor."""
    d, driven = walked(PARTS[part]), part == "damping"
    assert [*exceeding(d, driven=driven)] == []
    monkeypatch.setattr(Graded, "__mul__", forgetful)
    assert [*exceeding(d, driven=driven)]


def test_the_degree_of_a_body_in_principal_axes_counts(monkeypatch):
    """Points that make J diagonal are quotients of large degree."""
    d = walked(SOLID.replace("mass = 1", 'mass = "a"'), "SO(3)")
    given = d["large.principal"].given
    assert [*exceeding(d, given=given)] == []
    monkeypatch.setattr(Graded, "__mul__", forgetful)
    assert ("at", "m", "i") in [*exceeding(d, given=given)]
