"""Where C is not 1, and drops out of the metric nevertheless: what the record and the code lose.

What they say is checked with all problems (test_any_problem.py), against Gauss's principle.
"""

import tomllib
from fractions import Fraction
from random import Random

import numpy as np
import pytest

from derive import pipeline, programs
from derive.algebra.families import group, on_homogeneous
from derive.algebra.relations import changes, for_every_body
from derive.algebra.user_groups import group_of_basis, nilpotent
from derive.check.checker import check
from derive.language import rational as q
from derive.language.laurent import OverlongError, vanishes
from derive.language.tree import names
from derive.problem.inertia import EVERY, THIS, invariant
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from tests.problems import PROBLEMS, TRANSLATIONS, flat
from tests.support.walks import SEED

GRAVITY = '[[potential]]\nkind = "gravity"\ng = [0, 0, "-9.81"]\n'
PLACES = ([1, 0, 0.5], [0, 1, 0], [0, 0.3, 1], [-1, 0.2, -0.4])


def read(text, **allowed):
    return problem_of(tomllib.loads(text), **allowed)


def record(name):
    return pipeline.walk(read(PROBLEMS[name]))


def step_of(record, short):
    (found,) = (s for s in record.steps if s.label == f"{record.name}.{short}")
    return found


def said(record, short):
    return {x for e in step_of(record, short).equations for t in (e.lhs, e.rhs) for x in names(t)}


def operations(problem):
    rhs = programs.program(problem, pipeline.walk(problem)).functions["rhs"]
    return rhs.operations()


# -- the record ----------------------------------------------------------------------------------


def test_for_some_bodies_it_stays_in_the_potential_alone():
    found = record("a flat body")
    (metric,) = (e for e in step_of(found, "relation").equations if e.lhs == tr("C"))
    assert metric.rhs == tr()
    assert any(
        "left-invariant for this body" in s.message for s in step_of(found, "relation").prose
    )
    mass = step_of(found, "mass").equations[0]
    assert "C" not in {*names(mass.rhs)}
    assert "C" in said(found, "kernel")  # the work of the spring


def tr(*gram):
    return ("tr", ("mul", "ξ", "J", ("T", "Z"), *gram))


# -- how it is decided ---------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["SE(2) x SE(3)", "SO(2) x SE(2)", "SE(3) x SL(2)", "UT(3)"])
def test_every_body_by_random_elements(name):
    g = group(name)
    assert for_every_body(g) == ("SL" not in name and "UT" not in name)
    random = np.random.default_rng(3)
    weights = random.normal(size=(2, len(g.basis)))
    Y = [np.array(q.combine([*w], g.basis), float) for w in weights]
    A = np.array(g.sample(Random(1)), float)
    lost = np.allclose(Y[0].T @ A.T @ A @ Y[1], Y[0].T @ Y[1])
    assert lost == for_every_body(g)


def test_the_changes_of_C_span_what_it_reaches():
    g = group("UT(3)")
    found = [q.flatten(x) for x in changes(g)]
    assert q.rank(tuple(found)) == len(found) == 5  # C − 1 has no first entry
    random, one = Random(2), q.identity(3)
    for _ in range(9):
        a = g.sample(random)
        c = q.minus(q.times(q.transposed(a), a), one)
        assert q.rank((*found, q.flatten(c))) == len(found)


@pytest.mark.parametrize(
    ("change", "bodies"),
    [
        (("", ""), THIS),
        (("(b^2 - a^2)/(a + b)", "b + a"), THIS),  # (b² − a²)/(a + b) = b − a
        (("(b^2 - a^2)/(a + b)", "2*b + a"), None),
        (('"a", "b", 0', '"a", "b", "sin(a)^2 + cos(a)^2 - 1"'), None),  # functions are parameters
    ],
)
def test_this_body_exactly(change, bodies):
    text = flat().replace(*change) if change[0] else flat()
    if change[1] == "b + a":
        text = flat().replace("b - a - (b^2 - a^2)/(a + b)", "b - a + (a^2 - b^2)/(a + b)")
    assert invariant(read(text)) == bodies


def test_every_body_where_only_the_group_counts():
    assert invariant(read(PROBLEMS["shears"])) == EVERY
    assert invariant(read(PROBLEMS["SO(3) forces"])) is None  # C is 1


def test_a_rational_function_that_is_zero_for_no_other_reason_than_algebra():
    a, b = ("par", "a"), ("par", "b")
    total = ("add", a, b)
    whole = ("add", ("div", a, total), ("div", b, total), -1)
    assert vanishes(whole)
    assert vanishes(("add", ("pow", total, -1), ("mul", -1, ("div", 1, total))))
    assert not vanishes(("add", ("div", a, total), ("div", b, total)))
    long = tuple(("par", f"x{i}") for i in range(80))
    with pytest.raises(OverlongError):
        vanishes(("mul", ("add", *long), ("add", *long)))


def test_elements_of_nilpotent_groups_are_exact():
    basis = [q.matrix([[0, 1, 0], [0, 0, 1], [0, 0, 0]])]
    g = group_of_basis("Jordan", "linear", [tuple(map(tuple, e)) for e in basis])
    for seed in range(5):
        a = g.sample(Random(seed))
        t = a[0][1]
        assert a == ((1, t, t * t / 2), (0, 1, t), (0, 0, 1))
        assert t.denominator == 1
    turning = (q.matrix([[Fraction(0), Fraction(-1)], [Fraction(1), Fraction(0)]]),)
    assert not nilpotent(turning)
    assert on_homogeneous(group("SE(2)")).larger is False


# -- what the code costs -------------------------------------------------------------------------


def bodies(count):
    lines = [f'name = "test"\ngroup = "{" x ".join(["SE(3)"] * count)}"\n[parameters]\n']
    lines += [f"m{k}{i} = {1 + i / 4}\n" for k in range(count) for i in range(4)]
    for k in range(count):
        for i, at in enumerate(PLACES):
            block = f"block = {k + 1}\n" if count > 1 else ""
            lines.append(f'[[point]]\nmass = "m{k}{i}"\nat = {at}\n{block}')
    return read("".join(lines) + GRAVITY)


def test_two_bodies_cost_about_twice_what_one_does():
    one, two = operations(bodies(1)), operations(bodies(2))
    assert two["div"] == one["div"] == 0
    assert two["mul"] <= 1.1 * 2 * one["mul"]
    assert two["add"] <= 1.15 * 2 * one["add"]


def test_a_falling_point_costs_its_velocity_and_its_weight():
    table = f'[group]\nname = "Own"\naction = "affine"\nbasis = [{TRANSLATIONS}]\n'
    point = '[parameters]\nm = 1.0\n[[point]]\nmass = "m"\nat = [1, 0, 0]\n'
    plain = 'name = "test"\n' + point + GRAVITY + table
    assert operations(read(plain)) == {"mul": 12, "add": 6, "div": 0, "call": 0}


def test_a_constant_mass_matrix_is_inverted_once():
    assert operations(read(PROBLEMS["a flat body"]))["div"] == 0
    assert operations(read(PROBLEMS["a solid body"]))["div"] == 1


# -- bodies without a centre ---------------------------------------------------------------------


def test_a_factor_without_mass_has_no_centre():
    """With skew H the translation along c has then no kinetic energy, so that S need not say it."""
    more = "[[point]]\nmass = 1.0\nat = [2, 1, 5]\nblock = 2\n[[point]]\nmass = -4.0"
    text = PROBLEMS["SE(3) x SE(3)"].replace("[[point]]\nmass = 3.0", more)
    with pytest.raises(ProblemError, match="in block 2, the translation along"):
        read(text, negative_mass=True)


# -- bases of one's own --------------------------------------------------------------------------


IN_THE_BASIS = ("test.coordinates", "test.explicit")
"""What is told by the coordinates of ζ, and of inputs, in the basis of the file."""


@pytest.mark.parametrize(
    ("name", "like"),
    [("so(3) skewed", "SO(3)"), ("se(3) mixed", "SE(3)"), ("se(3) apart", "SE(3)")],
)
def test_rotations_in_any_basis_have_the_record_of_rotations(name, like):
    text = PROBLEMS[name]
    table = text.index("[group]")
    standard = f'group = "{like}"\n' + text[:table]
    mine, other = pipeline.walk(read(text)), pipeline.walk(read(standard))
    own, standard = (
        [(s.label, s.equations, s.uses) for s in d.steps if s.label not in IN_THE_BASIS]
        for d in (mine, other)
    )
    assert own == standard
    assert all(v.holds for v in check(mine, SEED) if v.label in IN_THE_BASIS)


def test_their_state_is_in_the_basis_that_is_stated():
    """The same motion: ζ of the state x are the coordinates of the same Z."""
    text = PROBLEMS["se(3) mixed"]
    mine = read(text)
    assert mine.group.user_basis == mine.group.in_user_basis.basis != mine.group.basis
    program = programs.program(mine, pipeline.walk(mine))
    assert program.basis == mine.group.user_basis
    assert [x for x in program.state if x.startswith("zeta")] == [f"zeta_{i}" for i in range(1, 7)]
