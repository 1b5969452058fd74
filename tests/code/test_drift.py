"""project and defect: back to the group by one Newton step, in every form and language."""

import ctypes
from functools import cache, partial

import numpy as np
import pytest
from scipy.linalg import expm

import derive
from derive import derive as walked
from derive.algebra.families import FAMILIES, group, on_homogeneous, turning_about_a_point
from derive.algebra.relations import relations
from derive.code.languages import LANGUAGES
from tests.problems import GROUPS, PROBLEMS
from tests.support.library import emission, library, module_of
from tests.support.needs import needs, present
from tests.support.states import element_names, hat

KEPT = [x for x in (*GROUPS, "SO(3)", "SE(3)", "SU(3)") if not x.startswith(("GL", "Aff"))]
FORMS = {
    "plain": {},
    "columns": {"layout": "col"},
    "tangent": {"velocity": "tangent"},
    "tangent columns": {"velocity": "tangent", "layout": "col"},
}


@pytest.mark.parametrize("name", FAMILIES)
def test_the_relations_of_a_family_single_it_out(name):
    """Their tangent space has the dimension of the group."""
    family = FAMILIES[name]
    for n in range(family.least, family.most + 1, family.step):
        g = group(f"{name}({n})")
        assert relations(g).dimension == g.dimension
        assert relations(g).none == (name in ("GL", "Aff"))


def test_groups_of_a_basis_are_kept_as_far_as_is_known():
    about = on_homogeneous(turning_about_a_point()).factors[0]
    assert relations(about).dimension == about.dimension == 3  # T = (1 - A) p is in the hull
    screw = walked("screw").problem.group.factors[0]
    # no polynomial ties T_3 to the angle
    assert (screw.dimension, relations(screw).dimension) == (1, 2)


# -- the emitted functions ----------------------------------------------------------------------


@cache
def text(name):
    """A problem on a named group."""
    if name in PROBLEMS:
        return PROBLEMS[name]
    n = int(name[-2]) * (2 if "U" in name else 1)
    rows = [[float(i == j) + 0.1 * (i + j) for j in range(n)] for i in range(n)]
    points = "".join(f"[[point]]\nmass = 1.0\nat = {row}\n" for row in rows)
    return f'name = "test"\ngroup = "{name}"\n{points}'


def element(name, seed=3):
    """The group, and the product of exponentials of its basis, not far from 1."""
    g, rng = group(name), np.random.default_rng(seed)
    found = np.eye(g.size)
    for e in g.basis:
        found = found @ expm(rng.uniform(-0.5, 0.5) * np.array(e, float))
    return g, found


def state_of(m, A, seed=4):
    """The numbers of a state at A with a random velocity in the group."""
    zeta = np.random.default_rng(seed).normal(size=len(m.BASIS))
    at = element_names(m).values()
    tangent = any(x.endswith("_dot") for x in m.STATE)
    rate = A @ hat(m, zeta)
    return np.array([*(A[x] for x in at), *([rate[x] for x in at] if tangent else zeta)])


def matrices(m, g, x):
    """A, as a matrix of the group's size, and its rate where the state has it."""
    at = element_names(m)
    A, V = np.zeros((g.size, g.size)), np.zeros((g.size, g.size))
    A[-1, -1] = g.affine or A[-1, -1]
    for offset, factor in g.places:
        if g.factors and factor.affine:
            A[offset + factor.n, offset + factor.n] = 1
    for k, place in enumerate(at.values()):
        A[place] = x[k]
        V[place] = x[len(at) + k] if len(x) == 2 * len(at) else 0
    return A, V


def off(g, A):
    """How far a matrix is off a named group, from what the group is by definition."""
    total = 0.0
    for offset, f in g.places:
        B, n = A[offset : offset + f.n, offset : offset + f.n], f.n
        family, gram = f.name.partition("(")[0], B.T @ B
        if family in ("SO", "SE", "U", "SU"):
            total += abs(gram - np.eye(n)).max()
        if family in ("U", "SU"):
            K = np.kron([[0, -1], [1, 0]], np.eye(n // 2))
            total += abs(B @ K - K @ B).max()
        if family == "SU":
            total += abs(np.linalg.det(B[: n // 2, : n // 2] + 1j * B[n // 2 :, : n // 2]) - 1)
        if family in ("SL", "SAff"):
            total += abs(np.linalg.det(B) - 1)
        if family == "Sp":
            W = np.kron([[0, 1], [-1, 0]], np.eye(n // 2))
            total += abs(B.T @ W @ B - W).max()
        if family == "Sim":
            total += abs(gram / abs(np.linalg.det(B)) ** (2 / n) - np.eye(n)).max()
        if family == "UT":
            total += abs(np.tril(B) - np.eye(n)).max()
    return total


def leaves(m, A, V):
    """How far a velocity is off the tangent space at A: what of A⁻¹V is not in the algebra."""
    Z = np.linalg.solve(A, V).ravel()
    E = m.BASIS.reshape(len(m.BASIS), -1).T
    return np.abs(E @ np.linalg.lstsq(E, Z, rcond=None)[0] - Z).max()


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("name", [*KEPT, "SO(3) x SO(3)", "SE(3) x SO(3)"])
def test_one_step_squares_the_error(name, form):
    """By oracles that know each group by its definition, not by the emitted relations."""
    m = module_of(text(name), **FORMS[form])
    g, A = element(name)
    x = state_of(m, A)
    assert m.defect(x) <= 1e-13
    assert np.abs(m.project(x) - x).max() <= 1e-14
    rng = np.random.default_rng(6)
    way, worst = rng.normal(size=len(x)), []
    for size in (1e-3, 1e-4, 1e-5):
        beside = x + size * way
        there = m.project(beside)
        (A0, _), (A1, V1) = matrices(m, g, beside), matrices(m, g, there)
        assert off(g, A0) > size / 100
        assert m.defect(beside) > size / 100
        total = off(g, A1) + (leaves(m, A1, V1) if "tangent" in form else 0)
        worst.append(total + m.defect(there))
    for size, total in zip((1e-3, 1e-4, 1e-5), worst, strict=True):
        assert total <= 500 * size**2 + 1e-13


@pytest.mark.parametrize("name", [x for x in KEPT if not x.startswith("UT")])
def test_a_velocity_that_leaves_the_group_is_made_tangent(name):
    """On the group itself the tangent part of a velocity stays and no other."""
    m = module_of(text(name), velocity="tangent")
    g, A = element(name)
    x = state_of(m, A)
    half = len(x) // 2
    wild = x + np.concatenate([np.zeros(half), np.random.default_rng(8).normal(size=half)])
    there = m.project(wild)
    B, V = matrices(m, g, there)
    assert np.allclose(there[:half], x[:half], rtol=0, atol=1e-14)
    assert leaves(m, B, V) <= 1e-13
    assert np.allclose(m.project(there), there, rtol=0, atol=1e-13)
    assert m.defect(wild) > 1e-2


def test_where_nothing_keeps_the_group_there_is_nothing_to_project():
    _, files = emission("gl3", (*LANGUAGES,))
    for path, what in files.items():
        assert "project(" not in what, path
        assert "defect(" not in what, path
    if present("cc"):
        f = derive.compile("gl3")
        with pytest.raises(
            ValueError, match="nothing keeps the states of gl3: there is no project"
        ):
            f.project(np.zeros(18))


@needs("cc")
@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("name", ["SU(3)", "Sim(3)", "Sp(4)", "SAff(2)", "SE(3) x SO(3)", "U(2)"])
def test_c_does_as_python_and_in_place(name, form):
    m, c = (f(text(name), **FORMS[form]) for f in (module_of, partial(library, "c")))
    x = np.random.default_rng(3).normal(size=len(m.STATE))
    out = c.said("project", x)
    assert np.allclose(out, m.project(x), rtol=1e-14, atol=1e-14 * np.abs(out).max())
    assert np.isclose(c.said("defect", x), m.defect(x), rtol=1e-14)
    own = x.copy()
    c.shared.test_project(*[ctypes.c_void_p(own.ctypes.data)] * 2)
    assert np.array_equal(own, out)
