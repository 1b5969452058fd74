"""What the note says beside its numbered equations: Newton's equations, uniqueness of g_t, the
volume of four points; evaluated here on numbers, by no code of the walk or of the checker."""

import numpy as np
import pytest

from tests.support.walks import record

RNG = np.random.default_rng(7)


class Points:
    """Points moved by any affine map: the values of r_k, r_k(t), δ(r_k(t)), A and ξ."""

    def __init__(self, linear):
        self.r, self.A, self.xi = RNG.normal(size=(5, 3)), *RNG.normal(size=(2, 3, 3))
        self.T, self.eta = (np.zeros(3),) * 2 if linear else RNG.normal(size=(2, 3))

    def place(self, k):
        return self.A @ self.r[k] + self.T

    def value(self, t):
        match t:
            case ("add", *terms):
                return sum(map(self.value, terms))
            case ("mul", *factors):
                return np.prod([self.value(x) for x in factors[:-1]], axis=0) * self.value(
                    factors[-1]
                )
            case ("inner", x, y):
                return self.value(x) @ self.value(y)
            case ("wedge", x, y):
                return np.cross(self.value(x), self.value(y))
            case ("at", "r", int(k)):
                return self.r[k]
            case ("call", ("at", "r", int(k)), "t"):
                return self.place(k)
            case ("call", "δ", ("call", ("at", "r", int(k)), "t")):
                return self.A @ (self.xi @ self.r[k] + self.eta)
        return t


def equations(name, label):
    (step,) = (s for s in record(name).steps if s.label == f"{name}.{label}")
    return step.equations


@pytest.mark.parametrize("name", ["sl3", "saff3"])
def test_the_volume_changes_by_det_a_and_its_variation_by_the_trace(name):
    """The sides of the two equations at every affine map: equal where det A = 1, where Tr ξ = 0."""
    volume, varied = equations(name, "tetrahedron")
    for _ in range(5):
        points = Points(linear=name == "sl3")
        first, *others = (4, 1, 2, 3) if name == "saff3" else (1, 2, 3, 4)
        points.r[first] *= name == "sl3"  # saff3 has its last point at the origin
        places = [points.place(k) - points.place(first) for k in others]
        assert np.isclose(points.value(volume.lhs), np.linalg.det(places))
        scale = np.linalg.det(points.A)
        assert np.isclose(points.value(volume.lhs), scale * points.value(volume.rhs))
        rate = np.trace(points.xi) * points.value(volume.lhs)
        assert np.isclose(points.value(varied.lhs), rate)
        assert varied.rhs == 0


@pytest.mark.parametrize(("name", "size"), [("saff3", 11), ("sl3", 8)])
def test_the_dimension_of_an_orbit_of_four_points(name, size):
    """That of the displacements of four points by the Lie algebra; those that keep the volume of
    the tetrahedron have dimension 11."""
    r = RNG.normal(size=(4, 3))
    units = [np.outer(a, b) for a in np.eye(3) for b in np.eye(3)]
    moved = [(r @ (e - np.trace(e) / 3 * np.eye(3)).T).ravel() for e in units]
    moved += [np.tile(e, 4) for e in np.eye(3)] if name == "saff3" else []
    assert np.linalg.matrix_rank(moved) == size
    (step,) = (s for s in record(name).steps if s.label == f"{name}.tetrahedron")
    words = " ".join(map(str, step.prose))
    assert "of dimension 11" in words
    assert f"are {size}, without" in words or size == 11


def test_not_all_aligned_is_enough_for_one_displacement():
    """Three points in a plane through the origin tell a displacement, two do not; A(x ∧ y) is the
    third image that is needed, and SO(3), SE(3) say so."""
    hats = [np.cross(e, np.eye(3)).T for e in np.eye(3)]

    def told(r):
        shifts = [np.tile(e, len(r)) for e in np.eye(3)]
        return np.linalg.matrix_rank([(r @ h.T).ravel() for h in hats] + shifts)

    flat = np.array([[1.0, 0, 0], [0, 2.0, 0], [-1.0, 1.0, 0]])
    assert (told(flat), told(flat[:2]), told(flat[[0, 0, 0]] * [[1], [2], [5]])) == (6, 5, 5)
    for name in ("so3", "se3"):
        (e,) = equations(name, "unaligned")
        assert (e.lhs[0], e.rhs[0], e.rhs[-1][0]) == ("wedge", "mul", "wedge")
    assert all(s.label != "so4.unaligned" for s in record("so4").steps)


@pytest.mark.parametrize("name", ["linear", "affine"])
def test_newton_s_equations_stand_in_the_record(name):
    d = record(name)
    force, balance = (
        next(s for s in d.steps if s.label == f"{name}.{x}") for x in ("force", "dalembert")
    )
    rates = {e.lhs: e.rhs for e in balance.equations}
    place = ("call", ("at", "r", "i"), "t")
    assert rates["call", "d/dt", place] == ("at", "v", "i")
    assert ("call", "d/dt", ("at", "v", "i")) in rates
    work = ("sum", "i", ("inner", ("at", "F", "i"), ("call", "δ", place)))
    assert ("mul", -1, work) in [e.rhs for e in force.equations]
