"""What relabellings of a body keep is called circulation everywhere: Υ = Āα − ᾱA, as a vector."""

import numpy as np
import pytest

import derive
from derive import Problem, Solid
from derive.motion.emitted_code import KEPT
from derive.searches import conserved_quantities
from tests.support.walks import problem, record

LETTERS = {"a": 2.0, "b": 3.0, "c": 5.0}
BODIES = {
    "three_axes": ("SL(3)", [2, 3, 5]),
    "letters": ("SL(3)", ["a", "b", "c"]),
    "turns_about_the_first": ("SL(3)", ["c", "a", "a"]),
    "turns_about_the_last": ("GL(3)", [2, 2, 5]),
    "ball": ("SL(3)", ["a", "a", "a"]),
    "in_space": ("SAff(3)", [2, "b", 5]),
}


def body(name):
    group, axes = BODIES[name]
    known = {x: LETTERS[x] for x in axes if x in LETTERS}
    return Problem(name, group, Solid("ellipsoid", 1, semi_axes=axes), parameters=known)


@pytest.mark.parametrize("own", ["dirichlet", *BODIES])
def test_it_is_the_circulation_about_each_axis_of_the_body(own):
    own = body(own) if own in BODIES else own
    code = derive.compile(own, conserved=True)
    basis = np.array(derive.derive(own).problem.group.in_user_basis.basis, float)
    rng, ratios = np.random.default_rng(3), []
    for _ in range(2):
        A = np.eye(3) + 0.2 * rng.normal(size=(3, 3))
        A *= np.sign(np.linalg.det(A)) / np.cbrt(abs(np.linalg.det(A)))
        zeta = rng.normal(size=len(basis))
        alpha = A @ np.tensordot(zeta, basis, 1)[:3, :3]
        Y = A.T @ alpha - alpha.T @ A
        place = rng.normal(size=len(code.STATE) - 9 - len(basis))
        kept = code.conserved(0, np.concatenate([A.ravel(), place, zeta]))
        found = dict(zip(code.CONSERVED, kept, strict=True))
        told = [found.pop(f"circulation_{k}") for k in (1, 2, 3)]
        ratios.append(np.divide(told, [Y[2, 1], Y[0, 2], Y[1, 0]]))
        assert not any("body" in x for x in found)
    assert (ratios[0] > 0).all()
    assert ratios[1] == pytest.approx(ratios[0], rel=1e-10)


def test_one_name_in_columns_and_in_words():
    names = [*conserved_quantities(problem("riemann_ellipsoid"), record("riemann_ellipsoid"))]
    run = derive.derive("riemann_ellipsoid").simulate(0.1, points=2)
    columns = [x.name for x in run.columns]
    kept = [x for x in names if x.startswith("circulation")]
    assert kept == ["circulation_3", "circulation_2", "circulation_1"]
    assert [*reversed(kept)] == [x for x in columns if x.startswith("circulation")]
    assert KEPT["circulation"] == "circulation in the body"


def test_a_turn_of_a_body_that_keeps_its_shape_is_an_angular_momentum():
    names = conserved_quantities(problem("lagrange_top"), record("lagrange_top"))
    assert [*names] == ["energy", "angular_momentum_3", "body_angular_momentum_3"]


def test_what_no_points_are_relabelled_by_is_no_circulation():
    """Half of Tr Z², by which SL(2) moves no points: it is left alone by all of the group."""
    killing = derive.Lagrangian("zeta_1^2 + zeta_2*zeta_3")
    own = derive.derive(Problem("killing", "SL(2)", killing))
    assert "deformation_body" in {x.kind for x in own.symmetries()}
    names = conserved_quantities(own.problem, own.record)
    assert not any(x.startswith("circulation") for x in names)
    assert any(x.startswith("deformation_body") for x in names)
