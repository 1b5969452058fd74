"""What the note says beside its numbered equations: Newton's equations, uniqueness of g_t, the
volume of four points, on numbers; the principle, integrated along polynomial curves.

Nothing is of the code of the walk. Real polynomial curves of rotations are constant, so the groups
of the principle are GL, SL and unipotent ones; integrals are exact, and what dϖ is on a lift is
read from the record.
"""

import pytest
import sympy as sp

from derive.check.values.evaluate import Environment, evaluate
from tests.support.walks import record

t, e = sp.symbols("t e")
MASSES = (2, 3, 1)
POINTS = {2: ((1, 0), (0, 1), (1, 1)), 3: ((1, 0, 2), (0, 1, 1), (1, 1, 0))}
STIFFNESS = sp.Rational(1, 2)


def shear(n, i, j, p):
    """1 + p E_ij, an element of SL(n)."""
    return sp.eye(n) + p * sp.Matrix(n, n, lambda a, b: int((a, b) == (i, j)))


def general(s):
    """Of GL(2) as long as it is invertible: its inverse is not needed."""
    return sp.Matrix([[1 + t, s], [t**2 - s, 3 + s * t]])


def special(s):
    """Of SL(2)."""
    return shear(2, 0, 1, t + s) * shear(2, 1, 0, 2 - t**2 + s * t) * shear(2, 0, 1, 1 + s)


def heisenberg(s):
    """Upper triangular, with 1 on the diagonal."""
    return sp.Matrix([[1, t + s, t**3 - s * t], [0, 1, 2 * t + s**2], [0, 0, 1]])


CURVES = {"GL": general, "SL": special, "Heisenberg": heisenberg}


def lagrangian(A, force):
    """Equation (3) for the points moved by A(t), with U = ½ k Σ |r_i(t)|²."""
    total = 0
    for m, r in zip(MASSES, POINTS[A.rows], strict=True):
        place = A * sp.Matrix(r)
        speed = sp.diff(place, t)
        total += sp.Rational(m, 2) * speed.dot(speed) - force * place.dot(place) / 2
    return sp.expand(total)


def varied(curve, s):
    """A, Ȧ, Ä and δA along the curve, where s(t, e) is the variation."""
    there = curve(s).subs(e, 0)
    return [
        x.applyfunc(sp.expand)
        for x in (there, there.diff(t), there.diff(t, 2), curve(s).diff(e).subs(e, 0))
    ]


def across(A, speed, acceleration, delta, force):
    """dϖ(δy, X), δt being 0, by the equation of the record."""
    *_, equation = record("linear")["linear.dalembert"].equations
    rows = {"α̇": acceleration, "α": speed, "δA": delta, "A": A}
    names = {x: tuple(map(tuple, M.tolist())) for x, M in rows.items()} | {"δt": sp.Integer(0)}
    points = [sp.Matrix(r) for r in POINTS[A.rows]]

    def family(vectors):
        return {(i,): tuple((x,) for x in v) for i, v in enumerate(vectors, 1)}

    families = {
        "m": {(i,): sp.Integer(m) for i, m in enumerate(MASSES, 1)},
        "r": family(points),
        "v": family([speed * r for r in points]),
        "F": family([-force * A * r for r in points]),
    }
    moved = family([delta * r for r in points])
    functions = {"δ": lambda _, a, env: moved[env.indices[a[0][1][2]],]}
    env = Environment(A.rows, names, families, functions)
    return sp.expand(evaluate(equation.rhs, env))


def momentum(A, speed, delta):
    """p̃(δA) = Σ m_i ⟨v_i, δr_i⟩."""
    pairs = zip(MASSES, map(sp.Matrix, POINTS[A.rows]), strict=True)
    return sum(m * (speed * r).dot(delta * r) for m, r in pairs)


def change(curve, s, force):
    """The coefficient of e in the action from 0 to 1."""
    action = sp.integrate(lagrangian(curve(s), force), (t, 0, 1))
    return sp.diff(sp.expand(action), e).subs(e, 0)


@pytest.mark.parametrize("force", [0, STIFFNESS])
@pytest.mark.parametrize("name", CURVES)
def test_the_action_changes_by_what_dϖ_is_on_the_lift(name, force):
    curve, s = CURVES[name], e * t * (1 - t) * (1 + 2 * t)
    found = change(curve, s, force)
    assert found == sp.integrate(across(*varied(curve, s), force), (t, 0, 1))
    assert found != 0  # the curve is no motion


@pytest.mark.parametrize("name", CURVES)
def test_where_the_ends_move_their_momentum_remains(name):
    curve, s = CURVES[name], e * (1 + t)
    A, speed, acceleration, delta = varied(curve, s)
    inside = sp.integrate(across(A, speed, acceleration, delta, STIFFNESS), (t, 0, 1))
    ends = momentum(A, speed, delta)
    assert change(curve, s, STIFFNESS) == inside + ends.subs(t, 1) - ends.subs(t, 0)
    assert ends.subs(t, 1) != ends.subs(t, 0)


STRAIGHT = {
    "GL": lambda s: sp.Matrix([[1 + t + s, 2 * t], [s * t, 3 - t]]),
    "SL": lambda s: shear(2, 0, 1, t) * shear(2, 1, 0, s) * shear(2, 0, 1, s * t),
    "Heisenberg": lambda s: sp.Matrix([[1, t + s, 3 * t - s], [0, 1, s - t], [0, 0, 1]]),
}
"""For s = 0 straight lines in the matrices that stay in the group: motions without forces."""


@pytest.mark.parametrize("name", STRAIGHT)
def test_a_motion_is_an_extremal(name):
    curve, s = STRAIGHT[name], e * t * (1 - t)
    A, speed, acceleration, delta = varied(curve, s)
    assert across(A, speed, acceleration, delta, 0) == 0 == change(curve, s, 0)
    assert change(curve, s, STIFFNESS) != 0
