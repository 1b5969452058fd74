"""What is said to be kept is kept: along trajectories of the emitted Python code."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from derive.command.showing import ready_made
from derive.python.derived import derive
from tests.oracles import general
from tests.support.walks import FLUIDS, repeated

REFUSED = ("zeitlin", "euler_poisson", "jelly", "linear", "affine", "rod", "spherical_pendulum")
REFUSED += ("riemann_ellipsoid", *FLUIDS)
"""Without symmetries, or with states of other numbers than the oracle has."""
SHORT = {
    "gl3": 0.2,
    "se3": 5.0,
    "hammer": 5.0,
    "screw": 5.0,
    "heisenberg": 5.0,
    "sl3": 10.0,
    "sp4": 5.0,
    "saff3": 5.0,
    "sim3": 5.0,
    "dirichlet": 5.0,
}
"""Falls and other motions without bounds, and one through a collapse of the body."""
NAMES = [x for x in ready_made() if x not in REFUSED]


def start(d, space):
    data = dict(d.problem_data)
    if "(" not in data["group"]:
        data["group"] = {"basis": data["basis"], "action": "affine"}
    return general.random_state(data, np.array(space["BASIS"], float), np.random.default_rng(7))


class Motion:
    """A trajectory of a problem by its emitted code."""

    def __init__(self, name):
        self.derived = derive(name)
        self.problem_data = self.derived.record.problem
        space = {}
        exec(self.derived.emit(languages=("python",))[f"{name}.py"], space)
        k = space["constants"](space["DEFAULTS"])
        given = (np.zeros(len(space["INPUTS"])),) if space["INPUTS"] else ()
        found = solve_ivp(
            lambda t, x: space["rhs"](t, x, k, *given),
            (0, SHORT.get(name, 50.0)),
            start(self, space),
            method="DOP853",
            rtol=1e-12,
            atol=1e-12,
        )
        assert found.success
        self.t, self.x = found.t, found.y.T
        self.energy = space["energy"](self.t, self.x, k)


@pytest.mark.parametrize("name", repeated(NAMES, 2))
def test_conserved(name):
    motion = Motion(name)
    quantities = motion.derived.symmetries()
    values = quantities.values(motion.t, motion.x)
    scale = 1 + np.abs(values).max(axis=0)
    assert (np.abs(values - values[0]).max(axis=0) / scale).max() < 1e-9


def test_the_first_is_the_energy():
    motion = Motion("so3")
    values = motion.derived.symmetries().values(motion.t, motion.x)
    assert values[:, 0] == pytest.approx(motion.energy, rel=1e-12)


def test_what_is_no_symmetry_moves():
    """A heavy top that is not symmetric about its axis: no other momentum is kept."""
    motion = Motion("so3")
    quantities = motion.derived.symmetries()
    assert len(quantities) == 2
    x = motion.x
    spin = x[:, 9:12]
    assert np.ptp(spin, axis=0).min() > 0.1


def test_expressions_are_the_values():
    import sympy

    motion = Motion("se3")
    quantities = motion.derived.symmetries()
    values = quantities.values(motion.t[:3], motion.x[:3])
    program = motion.derived.expressions()
    defaults = {p: motion.derived.problem.parameters[p.name].default for p in program.p}
    for k, quantity in enumerate(quantities):
        numbers = quantity.sympy().subs(defaults)
        f = sympy.lambdify([sympy.Symbol("t", real=True), program.x], numbers)
        for t, x, value in zip(motion.t, motion.x, values[:, k], strict=False):
            assert f(t, x) == pytest.approx(value, rel=1e-9, abs=1e-9)
