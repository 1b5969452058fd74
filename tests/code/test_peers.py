"""Emitted code of one solid against other programs for mechanics: SymPy, and Pinocchio if here."""

import numpy as np
import pytest

from tests.oracles import articulated, relative_error, sampling, sympy_mechanics
from tests.support.library import arrange, module_of
from tests.support.needs import needs

SOLIDS = ("so3", "se3")
STATES = 100


def cases(name, seed):
    """Bodies with first moments, states, inputs, and what the emitted code makes of them."""
    code, rng = module_of(name), np.random.default_rng([seed, len(name), ord(name[1])])
    for _ in range(STATES):
        body, x = sampling.random_body(name, rng), sampling.random_state(name, rng)
        u = rng.normal(size=sampling.DIMENSION[name])
        k = code.constants(arrange(code, sampling.parameters(name, body)))
        yield body, x, u, code.rhs(0.0, x, k, u)[-len(u) :]


@pytest.mark.parametrize("name", SOLIDS)
def test_kanes_method_of_sympy(name):
    """By a quaternion and speeds in the body, with gravity, a torque and a force."""
    for body, x, u, found in cases(name, 1):
        # 2e-15 is found
        assert relative_error(found, sympy_mechanics.kane(name, x, body, u)) < 1e-12


def test_lagranges_method_of_sympy():
    """By Euler angles: their second derivatives, turned into those of so3."""
    code, rng = module_of("so3"), np.random.default_rng(2)
    worst = 0.0
    for _ in range(STATES):
        body, u = sampling.random_body("so3", rng), rng.normal(size=3)
        # away from 0 and pi of the second angle, where the angles are singular
        angles, rates = rng.uniform(0.4, 2.7, 3), rng.normal(size=3)
        A, W, change = sympy_mechanics.lagrange(angles, rates, body, u)
        k = code.constants(arrange(code, sampling.parameters("so3", body)))
        found = code.rhs(0.0, np.append(A, W), k, u)[9:]
        worst = max(worst, relative_error(found, change))
    assert worst < 1e-12


@needs("the module pinocchio")
@pytest.mark.parametrize("name", SOLIDS)
def test_pinocchio(name):
    """Featherstone's articulated-body algorithm on a spherical joint and on a free flyer."""
    import pinocchio as pin

    for body, x, u, found in cases(name, 3):
        # 4e-15 is found
        assert relative_error(found, articulated.acceleration(pin, name, x, body, u)) < 1e-12
