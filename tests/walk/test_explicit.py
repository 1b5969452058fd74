"""The answer: equations in coordinates with a problem's own numbers, beside other roads."""

import math
from functools import reduce
from random import Random

import numpy as np
import pytest

from derive.algebra.families import group
from derive.algebra.groups import affine_entries
from derive.check.checker import check
from derive.language.show import show
from derive.language.tree import nodes
from derive.pipeline import walk
from derive.problem.toml import problem_of
from tests.support.corpus import record
from tests.support.walks import record as ready

SHIFTS = [[[0, 0, 1], [0, 0, 0], [0, 0, 0]], [[0, 0, 0], [0, 0, 1], [0, 0, 0]]]
TRANSLATIONS = {
    "name": "shifted",
    "group": {"name": "R2", "action": "affine", "basis": SHIFTS},
    "parameters": {"m": 1.0, "k": 2.0, "g": 9.81},
    "point": [{"mass": "m", "at": [0, 0]}],
    "potential": [
        {"kind": "spring", "on": 1, "anchor": [2, 3], "stiffness": "k"},
        {"kind": "gravity", "g": [0, "-g"]},
    ],
}


def heavy(*places):
    """Equal points about a fixed one, with their weight."""
    return {
        "name": "balanced",
        "group": "SO(3)",
        "parameters": {"m": 1.0, "g": 9.81},
        "point": [{"mass": "m", "at": [*x]} for x in places],
        "potential": [{"kind": "gravity", "g": [0, 0, "-g"]}],
    }


def answer(d):
    return d[f"{d.name}.explicit"]


def told(d):
    return [f"{show(e.lhs)} = {show(e.rhs)}" for e in answer(d).equations]


def said(d):
    return " ".join(s.message for s in answer(d).prose)


def value(t, known):
    """A tree in floats."""
    if isinstance(t, (str, tuple)) and t in known:
        return known[t]
    if not isinstance(t, tuple):
        return float(t)
    if t[0] == "fun":
        return {"sin": math.sin, "cos": math.cos, "sqrt": math.sqrt}[t[1]](value(t[2], known))
    if t[0] == "pow":
        return value(t[1], known) ** t[2]
    parts = [value(x, known) for x in t[1:]]
    match t[0]:
        case "add":
            return sum(parts)
        case "mul":
            return reduce(np.dot, parts)
        case "div":
            return parts[0] / parts[1]
        case "inner":
            return parts[0] @ parts[1]
        case "wedge":
            return np.cross(*parts)
        case "T":
            return parts[0].T
        case "tr":
            return np.trace(parts[0])
        case "norm2":
            return parts[0] @ parts[0]
        case "row":
            return parts[0]
        case "matrix":
            return np.array(parts)
    raise ValueError(t)


def test_a_nut_on_a_screw_falls_with_a_constant():
    """m(1 + h²) ζ̇ = −m g h for h = 1/10."""
    assert told(ready("screw")) == ["ζ̇₁ = −10/101 g"]
    assert "affine functions of the time" in said(ready("screw"))


def test_a_spring_that_cannot_act():
    d = ready("su2")
    assert told(d) == ["dŨ(Aξ′) = 0", "ζ̇₁ = 0", "ζ̇₂ = 0", "ζ̇₃ = 0"]
    assert "cannot act" in said(d)
    assert "g₀ exp(tZ)" in said(d)


@pytest.mark.parametrize(("side", "motion"), [("left", "g₀ exp(tZ)"), ("right", "exp(tZ) g₀")])
def test_a_motion_by_a_one_parameter_group(side, motion):
    d = record(f"lagrangian free {side}")
    assert told(d) == [f"ζ̇{x} = 0" for x in "₁₂₃"]
    assert motion in said(d)


def test_springs_on_translations_are_linear():
    d = walk(problem_of(TRANSLATIONS))
    assert told(d) == ["ζ̇₁ = 2k/m − k A₁₃/m", "ζ̇₂ = (3k − gm)/m − k A₂₃/m"]
    assert "linear" in said(d)


def dragged(group, places, force):
    """Unit masses, and a force of the velocity at the first."""
    force_at = {"at": [*places[0]], "force": force}
    points = [{"mass": 1, "at": [*x]} for x in places]
    own = {"name": "dragged", "group": group, "parameters": {"c": 0.2}}
    return walk(problem_of({**own, "point": points, "force": [force_at]}))


def test_a_drag_at_a_place_has_no_factor_that_is_1():
    """−c v at a place is, on every orthogonal group, a covector without A; the factor that a drag
    along one axis has is none of these."""
    assert told(dragged("SO(2)", [(0, -1)], ["-c*v_1", "-c*v_2"])) == ["ζ̇₁ = −c ζ₁"]
    assert told(dragged("SO(2)", [(0, -1)], ["-c*v_1", 0])) == ["ζ̇₁ = −c A₁₁² ζ₁"]
    solid = dragged("SO(3)", PLACES, [f"-c*v_{i}" for i in (1, 2, 3)])
    plane = dragged("SE(2)", [(0, -1), (0, 1)], ["-c*v_1", "-c*v_2"])
    for d in (solid, plane):
        assert not any("A" in nodes(e.rhs) for e in answer(d).equations)
        assert all(v.holds for v in check(d, seed=3))


def test_a_body_without_a_first_moment_feels_no_gravity():
    d = walk(problem_of(heavy((1, 0, 0), (0, 1, 1), (-1, -1, -1))))
    assert "cannot act" in said(d)


PLACES = ((1, 0, 0), (0, 1, 1), (1, 0, 1))


def test_a_solid_with_products_of_inertia_is_solved():
    """Beside Euler's equations in floating point, with the tensor from the points."""
    d = walk(problem_of(heavy(*PLACES)))
    random = np.random.default_rng(3)
    A, _ = np.linalg.qr(random.normal(size=(3, 3)))
    zeta, m, g = random.normal(size=3), 1.7, 9.81
    r = np.array(PLACES)
    inertia = m * sum((x @ x) * np.eye(3) - np.outer(x, x) for x in r)
    torque = m * np.cross(r.sum(axis=0), A.T @ [0, 0, -g])
    expected = np.linalg.solve(inertia, torque + np.cross(inertia @ zeta, zeta))
    known = {("par", "m"): m, ("par", "g"): g}
    known |= {("entry", "A", i + 1, j + 1): A[i, j] for i in range(3) for j in range(3)}
    known |= {("entry", "ζ", i + 1): zeta[i] for i in range(3)}
    found = [value(e.rhs, known) for e in answer(d).equations]
    assert np.allclose(found, expected, rtol=1e-12)


def test_a_body_and_its_load_on_a_spring_are_solved():
    """Beside Newton's and Euler's laws, in floating point: four equal points, a thrust, and a load
    that hangs on a spring."""
    corners = [{"mass": "m", "at": x, "block": 1} for x in ([1, 0, 0], [-1, 0, 0], [0, 0, 1])]
    hung = {"group": "SE(3) x R(3)", "parameters": {"m": 1.0, "M": 2.0, "k": 3.0, "g": 9.81}}
    hung["point"] = [*corners, {"mass": "m", "at": [0, 0, -1], "block": 1}]
    hung["point"] += [{"mass": "M", "at": [0, 0, 0], "block": 2}]
    spring = {"kind": "spring", "between": [4, 5], "stiffness": "k", "length": 1}
    hung["potential"] = [{"kind": "gravity", "g": [0, 0, "-g"]}, spring]
    thrust = {"name": "f", "kind": "force", "at": [1, 0, 0], "block": 1, "frame": "body"}
    hung["input"] = [thrust | {"direction": [0, 0, 1]}]
    d = walk(problem_of({"name": "hung"} | hung))
    random = np.random.default_rng(5)
    A, _ = np.linalg.qr(random.normal(size=(3, 3)))
    A *= np.linalg.det(A)
    omega, v, rate, T, place = random.normal(size=(5, 3))
    m, M, k, g, f = 1.3, 0.7, 2.1, 9.81, 0.4
    inertia = m * np.diag([2.0, 4, 2])
    hook = np.array([0, 0, -1.0])
    ends = A @ hook + T - place
    length = np.linalg.norm(ends)
    pull, weight = -k * (length - 1) / length * ends, np.array([0, 0, -g])
    moment = np.cross(hook, A.T @ pull) + np.cross([1, 0, 0], [0, 0, f])
    turning = np.linalg.solve(inertia, moment - np.cross(omega, inertia @ omega))
    moving = A.T @ (pull / (4 * m) + weight) + np.array([0, 0, f / (4 * m)]) - np.cross(omega, v)
    expected = [*turning, *moving, *(weight - pull / M)]
    known = {("par", x): y for x, y in (("m", m), ("M", M), ("k", k), ("g", g))}
    known[("entry", ("at", "f_u", 1), 1)] = known["par", "f"] = f
    known["at", "σ", 1] = -k * (length - 1) / length
    for i in range(3):
        known |= {("entry", "A", i + 1, j + 1): A[i, j] for j in range(3)}
        known["entry", ("at", "d", 1), i + 1] = ends[i]
        known |= {("entry", "A", i + 1, 4): T[i], ("entry", "A", i + 5, 8): place[i]}
    for i, x in enumerate((*omega, *v, *rate), 1):
        known["entry", "ζ", i] = x
    found = [value(e.rhs, known) for e in answer(d).equations]
    assert np.allclose(found, expected, rtol=1e-12)
    assert all(x.holds for x in check(d, seed=3))


def test_no_answer_names_what_it_solves_for():
    for name in ("gyrostat", "heisenberg", "rod", "su2"):
        for e in answer(ready(name)).equations:
            assert "ζ̇" not in {x for x in nodes(e.rhs) if isinstance(x, str)}


@pytest.mark.parametrize("name", ["SO(2)", "SE(2)", "UT(3)", "SU(2)", "Sim(2)", "SO(3) x SE(2)"])
def test_entries_are_told_by_the_free_ones(name):
    g = group(name)
    told_by = affine_entries(g)
    random = Random(5)
    for _ in range(3):
        A = g.sample(random)
        for i, row in enumerate(told_by):
            for j, (constant, weights) in enumerate(row):
                assert A[i][j] == constant + sum(w * A[k][m] for (k, m), w in weights.items())


@pytest.mark.parametrize(("name", "free"), [("SO(2)", 2), ("UT(3)", 3), ("SU(2)", 4), ("SO(3)", 9)])
def test_as_few_entries_are_free_as_can_be(name, free):
    assert len({x for row in affine_entries(group(name)) for _, w in row for x in w}) == free


@pytest.mark.parametrize(
    "U", ["(a + r1_x)^60", "a*" + "*".join(f"(r{i}_x + {i})" for i in range(1, 40))]
)
def test_what_is_too_long_is_not_multiplied_out(U):
    """Else there are more terms than memory; left out as any long answer."""
    data = {"name": "p", "group": "SO(3)", "parameters": {"a": 1.0}}
    data["point"] = [{"mass": i, "at": [i, 1, i * i % 9]} for i in range(1, 41)]
    d = walk(problem_of(data | {"potential": [{"kind": "expression", "U": U}]}))
    assert "p.explicit" not in {s.label for s in d.steps}
