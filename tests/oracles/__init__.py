"""Oracles for numbers: roads to the equations of motion that share nothing with the derivation.

* ``sampling``     bodies made of points, group elements and states, from a seeded generator;
* ``multipliers``  Newton's law for every point, with Lagrange multipliers for the constraints;
* ``general``      Gauss's principle of least constraint for any problem file;
* ``solids``       moments of solids by quadrature;
* ``free_top``, ``lagrange_top``, ``geodesics``: motions in closed form;
* ``sympy_mechanics``: Kane's method of SymPy on one solid, for tests/compare/right.
"""

import numpy as np


def relative_error(found, expected):
    """Largest difference of two arrays of one shape, over the largest entry of either.

    Zero for two arrays of zeros, NaN (which no bound accepts) where an entry is NaN.
    """
    found, expected = np.asarray(found, float), np.asarray(expected, float)
    if found.shape != expected.shape:
        raise ValueError(f"shapes differ: {found.shape} and {expected.shape}")
    gap = np.max(np.abs(found - expected))
    return 0.0 if gap == 0 else gap / max(np.max(np.abs(found)), np.max(np.abs(expected)))
