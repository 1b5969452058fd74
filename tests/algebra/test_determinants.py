"""Determinants and adjugates of words, beside those of NumPy at random matrices."""

import numpy as np
import pytest

from derive.algebra.calculus import adjugate, determinant, determinant_letter, power_of
from derive.algebra.words import Letter, one, trace, word

X, Y, U = Letter("X", 3, 3), Letter("Y", 3, 3), Letter("u")
AT = dict(zip("XY", np.random.default_rng(3).normal(size=(2, 3, 3)), strict=True)) | {"u": 0.7}


def value(e):
    """The matrix of a 3 x 3 expression, or a number."""

    def of(w):
        total = np.eye(3)
        for letter, bar in w:
            x = np.atleast_2d(AT.get(letter.name, 0))
            total = x[0, 0] * total if x.size == 1 else total @ (x.T if bar else x)
        return total

    total = np.zeros((3, 3))
    for (traces, w), c in e.terms.items():
        scalars = [of(t)[0, 0] if t[0][0].rows == 1 else np.trace(of(t)) for t in traces]
        total = total + float(c) * np.prod(scalars) * of(w)
    return total[0, 0] if e.is_scalar else total


def test_the_determinant_of_a_product():
    e = 2 * word(U) * trace(word(Y)) * word(X, Y, X).bar
    found = determinant(e)
    names = {determinant_letter(x).name: np.linalg.det(AT[x.name]) for x in (X, Y)}
    AT.update(names)
    assert value(found) == pytest.approx(np.linalg.det(value(e)))
    with pytest.raises(ValueError, match="of a sum"):
        determinant(word(X) + word(Y))


def test_a_skew_one_of_odd_size():
    for n in (2, 3, 4, 5):
        skew = word(Letter("S", n, n, -1))
        assert (determinant(skew) == determinant(skew.bar)) == (n % 2 == 0)


def test_the_adjugate_in_powers():
    shifted = adjugate(word(X) * word(Y).bar + word(U) * one(3))
    matrix = AT["X"] @ AT["Y"].T + AT["u"] * np.eye(3)
    wanted = np.linalg.det(matrix) * np.linalg.inv(matrix)
    assert pytest.approx(value(shifted)) == wanted
    parts = (value(power_of(shifted, U, k)) * AT["u"] ** k for k in range(3))
    assert sum(parts) == pytest.approx(wanted)
    with pytest.raises(ValueError, match="3 × 3"):
        adjugate(word(Letter("Z", 2, 2)))
