"""Every equation of a walk as SymPy's: both sides have the values that the checker gives them, and
those handed to users as expressions are those of the emitted code.

At an exact random point of the checker, all names, functions of variations and members of families
are put into the SymPy objects, and what comes out is what the checker's own evaluator finds.
"""

from fractions import Fraction
from pathlib import Path
from random import Random

import numpy as np
import pytest
import sympy
from sympy.core.function import AppliedUndef

import derive
from derive.check.form.function_signatures import POINT
from derive.check.trials.trial_points import group_of, groups_with_relations, model_at, names_at
from derive.check.values.arithmetic import EvaluationError, is_matrix
from derive.check.values.draws import index_bindings, locus_of
from derive.check.values.evaluate import _range, evaluate
from derive.language.derivatives import DERIVATIVES
from derive.language.expression import parse
from derive.python.as_sympy import Translation
from derive.python.expressions import FunctionValue
from tests.support.library import module_of
from tests.support.walks import NAMES, OTHERS, record

ROOT = Path(__file__).parents[2]
N = sympy.Symbol("N", integer=True, positive=True)


class Exact(Translation):
    """Elementary functions are numbers that the checker draws: symbols here."""

    def op_fun(self, name, x):
        return sympy.Symbol(f"{name}<{x}>")


def exact(v):
    if is_matrix(v):
        return sympy.ImmutableMatrix([[exact(x) for x in row] for row in v])
    return sympy.Rational(Fraction(v).numerator, Fraction(v).denominator)


def members(body, index, env):
    """The values of an index with those that it has in SymPy, where each copy of a point has its
    own."""
    counted, found = _range(body, index, env)
    often = env.copies if counted == POINT else ()
    return [*enumerate((i for i in found for _ in range(int(often[i - 1]) if often else 1)), 1)]


def values(t, env, own, at):
    """SymPy object → value, for what stands in a tree; ``at``: the indices in SymPy."""
    if isinstance(t, str) or (isinstance(t, tuple) and t[0] in ("at", "call", "par", "fun")):
        try:
            yield own.of(t).subs(at), exact(evaluate(t, env))
        except ValueError:  # the argument of a function
            assert t in ("δy", "δ′y", "δx", "δ′x", "X") or t[0] in ("call", "at"), t
    if not isinstance(t, tuple):
        return
    if t[0] == "sum":
        for j, i in members(t[2], t[1], env):
            yield from values(t[2], env.with_index(t[1], i), own, at | {own.index(t[1]): j})
    parts = {"at": (), "par": (), "sum": (), "call": t[2:], "entry": t[1:2], "fun": t[2:]}
    for x in parts.get(t[0], t[1:2] if t[0] == "pow" else t[1:]):
        yield from values(x, env, own, at)


def compared(side, tree, env, own):
    try:
        expected = exact(evaluate(tree, env))
    except EvaluationError as error:  # what is said of any group, with J⁻¹, of masses on a line
        if "inverse of a singular matrix" in str(error):
            return
        raise
    at = {own.index(i): k for i, k in env.indices.items()}
    size = {own.n: env.size, N: sum(map(int, env.copies)) or len(env.families.get("r", ()))}
    known = {x.subs(size): y for x, y in values(tree, env, own, at)}
    found = side.subs(at).subs(size).doit().xreplace(known).doit()
    if getattr(found, "is_Matrix", False):
        found = sympy.ImmutableMatrix(found.as_explicit())
    assert found == expected, (tree, side)


@pytest.mark.parametrize("name", [x for x in (*NAMES, *OTHERS) if x != "zeitlin"])
def test_values(name):
    d = derive.derive(name)
    problem, own, points = d.record.problem, Exact(d.record), {}
    g = group_of(problem)
    for step in d.record.steps:
        for e in step.equations:
            at = locus_of(step, e)
            if at not in points:
                tried = g or groups_with_relations(problem["action"])[0]
                random = Random(at.as_text)
                points[at] = names_at(model_at(problem, tried, random, 99, at, generic=g is None))
            eq = own.equation(e)
            assert isinstance(eq, sympy.Eq)
            for env in index_bindings(("add", e.lhs, e.rhs), points[at]):
                for side, tree in ((eq.lhs, e.lhs), (eq.rhs, e.rhs)):
                    if tree != 0:
                        compared(side, tree, env, own)


def test_how_many_need_no_function():
    """The figures of docs/sympy.md: functions are those that SymPy does not know, as ϖ(δy)."""
    names = [x for x in (*NAMES, *OTHERS) if x != "zeitlin"]  # sums over a lattice
    found, made = [], {}  # what is said of any group, once for all records
    for d in map(record, names):
        own = Exact(d)
        for scope, e in ((s.scope, e) for s in d.steps for e in s.equations):
            found.append((scope, e.lhs, e.rhs))
            if found[-1] not in made:
                made[found[-1]] = own.equation(e)
    assert all(isinstance(eq, sympy.Eq) for eq in made.values())
    plain = [x for x in found if not made[x].atoms(AppliedUndef, FunctionValue)]
    page = (ROOT / "docs" / "sympy.md").read_text(encoding="utf-8")
    assert f"all {len(found)} equations" in page.replace("\n", " ")
    assert f"{len(plain)} of them" in page.replace("\n", " ")


def equations_of(d):
    return [eq for label in d.labels for eq in d[label].sympy()]


def test_every_equation_is_text_and_latex():
    for eq in equations_of(derive.derive("top"))[::5]:
        assert str(eq).startswith("Eq(")
        assert sympy.latex(eq)
        assert sympy.pretty(eq)


def test_euler_s_equation_runs_on_as_code_does():
    """ζ̇ of a free solid, from its step through lambdify, and from the emitted file."""
    d, code, rng = derive.derive("so3"), module_of("so3"), np.random.default_rng(4)
    p = np.array([code.DEFAULTS.get(x, 1.5) for x in code.PARAMETERS])
    zeta, own = rng.normal(size=3), dict(zip(code.PARAMETERS, p, strict=True))
    J = np.array([[own[f"J_{min(i, j)}{max(i, j)}"] for j in (1, 2, 3)] for i in (1, 2, 3)])
    given = {
        "A": np.eye(3),
        "I": np.trace(J) * np.eye(3) - J,
        "ζ": zeta[:, None],
        "c": np.array([[own[f"c_{i}"]] for i in (1, 2, 3)]),
        "γ": np.array([[own[f"g_{i}"]] for i in (1, 2, 3)]),
        "u": np.zeros((3, 1)),
    }
    eq = d["motion"].sympy()[1]
    names = [d.sympy(x) for x in given]
    assert eq.lhs == d.sympy("ζ̇")
    assert eq.rhs.free_symbols <= {*names}
    found = sympy.lambdify(names, eq.rhs.doit())(*given.values())
    x = np.concatenate([np.eye(3).ravel(), zeta])
    expected = code.rhs(0.0, x, code.constants(p), np.zeros(3))[9:]
    np.testing.assert_allclose(np.ravel(found), expected, rtol=1e-12)


def test_a_traces_derivative():
    """∂/∂Z of ½ Tr ZJZ̄ is ½ Z(J + J̄): Π of a rotating body, where J is symmetric."""
    d = derive.derive("so3")
    J, Z = d.sympy("J"), d.sympy("Z")
    found = d.sympy("½ Tr ZJZ̄").diff(Z)
    one, other = (sympy.ImmutableMatrix(3, 3, lambda i, j, k=k: k + 3 * i + j**2) for k in (1, 2))
    values = found.subs({J: one, Z: other}).doit()
    assert values == other * (one + one.T) / 2


@pytest.mark.parametrize("name", DERIVATIVES)
def test_elementary_functions(name):
    d = derive.derive("so3")
    x = sympy.Symbol("g_1", real=True)
    assert d.translation.of(parse(f"{name}(g_1)")) == getattr(sympy, name)(x)


def test_the_names_of_letters_and_parameters_stay_apart():
    """In ‘screw’ a parameter is called m, as the letter for the mass."""
    d = derive.derive("screw")
    assert "m" in d.problem.parameters
    assert d.translation.of(("par", "m")) in d.expressions().p
    assert d.sympy("m") == sympy.Symbol("m_", real=True)
    assert d.sympy("‘m’") == sympy.Symbol("m", real=True)
    so3 = derive.derive("so3")  # where both are the same
    assert so3.sympy("m") == sympy.Symbol("m", real=True)


def test_members_and_sums():
    """c = Σ m_i r_i of three listed points, written out."""
    d = derive.derive("sl3")
    (eq,) = [x for x in d["linear.moments"].sympy() if x.lhs == d.sympy("c")]
    m, r = ([d.sympy(f"{x}{i}") for i in "₁₂₃₄"] for x in "mr")
    terms = [x * y for x, y in zip(m, r, strict=True)]
    assert eq.rhs.doit() == sympy.MatAdd(*terms).doit()
    assert d.sympy("r_i").subs(d.translation.index("i"), 2) == sympy.MatrixSymbol("r_2", 3, 1)


@pytest.mark.parametrize("text", ["Q_", "+", "ϖ", "nonsense", "", "‘m’", "Tr"])
def test_no_formula(text):
    with pytest.raises(ValueError, match=r"\w"):
        derive.derive("so3").sympy(text)


PROBLEMS = ("so3", "se3", "top", "gl3", "saff3", "comet", "two_tops")


@pytest.mark.parametrize("name", PROBLEMS)
def test_the_same_numbers(name):
    code, e = module_of(name), derive.derive(name).expressions()
    assert [str(x) for x in (*e.x, *e.p, *e.u)] == [*code.STATE, *code.PARAMETERS, *code.INPUTS]
    rng = np.random.default_rng(5)
    p = np.array([code.DEFAULTS.get(x, rng.uniform(0.5, 1.5)) for x in code.PARAMETERS])
    x, u, t = rng.normal(size=len(e.x)), rng.normal(size=len(e.u)), 0.3
    k = code.constants(p)
    rhs = sympy.lambdify([e.t, e.x, e.p, e.u], e.rhs.subs(e.k), cse=True)(t, x, p, u)
    energy = sympy.lambdify([e.t, e.x, e.p], e.energy.subs(e.k), cse=True)(t, x, p)
    np.testing.assert_allclose(np.ravel(rhs), code.rhs(t, x, k, u), rtol=1e-11, atol=1e-11)
    assert energy == pytest.approx(code.energy(t, x, k), rel=1e-11)


def test_principal_axes_of_a_free_body():
    """I ω̇ = Iω ∧ ω in principal axes: J is diagonal, there are no other terms (Euler)."""
    e = derive.derive("so3").expressions()
    named = {s.name: s for s in (*e.p, *e.u, *e.x)}
    still = {named[x]: 0 for x in ("c_1", "c_2", "c_3", "J_12", "J_13", "J_23", "u_1")}
    found = sympy.factor(e.rhs[9].subs(e.k).subs(still))
    J2, J3, y, z = (named[x] for x in ("J_22", "J_33", "zeta_2", "zeta_3"))
    I2, I3 = named["J_11"] + J3, named["J_11"] + J2
    assert sympy.simplify(found - (I2 - I3) / (J2 + J3) * y * z) == 0


def test_pi_is_a_symbol():
    """The mass of an ellipsoid is ⁴⁄₃π ρ a b c."""
    e = derive.derive("ellipsoid").expressions()
    text = str([*e.k.values(), *e.rhs])
    assert "pi" in text
    assert not any(x.is_Float for y in (*e.k.values(), *e.rhs) for x in sympy.preorder_traversal(y))
