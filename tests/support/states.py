"""States of emitted code of any group: parameters, an element of the group, velocities, inputs; and
its motions, followed as closely as doubles allow."""

from itertools import pairwise

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import expm


def some_body(names, seed=1):
    """Moments of six masses in R³ for the parameters that are moments: m, c_i, J_ij → value."""
    random = np.random.default_rng(seed)
    mass, r = random.uniform(0.5, 1.5, 6), random.normal(size=(6, 3))
    values = {"m": mass.sum()} | {f"c_{i + 1}": mass @ r[:, i] for i in range(3)}
    values |= {
        f"J_{i + 1}{j + 1}": mass @ (r[:, i] * r[:, j]) for i in range(3) for j in range(i, 3)
    }
    return {name: values[name] for name in names if name in values} if "J_33" in names else {}


def drawn(module, seed=1):
    """Parameters, a group element near 1 as names → numbers, ζ (and w), inputs."""
    rng = np.random.default_rng(seed)
    own = some_body(module.PARAMETERS, seed)
    p = np.array(
        [own.get(x, module.DEFAULTS.get(x)) or rng.uniform(0.5, 1.5) for x in module.PARAMETERS]
    )
    x = dict(zip(module.STATE, rng.normal(size=len(module.STATE)), strict=True))
    return p, x, rng.normal(size=len(module.INPUTS)), rng


def element(module, rng):
    """A matrix of the group with the body's matrices: a product of exponentials of the basis."""
    g = np.eye(len(module.BASIS[0]))
    for e in module.BASIS:
        g = g @ expm(rng.normal() / 2 * e)
    return g


def element_names(module):
    """The names of the group element in the state, with their places in the matrix."""
    size, places = len(module.BASIS[0]), {}
    listed = [x for x in module.STATE if not x.endswith("_dot")]
    marks = sorted({x[1:].split("_")[0] for x in listed if x[0] in "AT"})
    offset = 0
    for mark in marks:
        rows = max(int(x[-1]) for x in listed if x.startswith(f"A{mark}_"))
        for name in listed:
            if name.startswith(f"A{mark}_"):
                places[name] = (offset + int(name[-2]) - 1, offset + int(name[-1]) - 1)
            elif name.startswith(f"T{mark}_"):
                places[name] = (offset + int(name[-1]) - 1, offset + rows)
        offset += rows + any(x.startswith(f"T{mark}_") for x in listed)
    assert offset == size
    return places


def state(module, seed=1):
    """p, x, u, the matrix g and the coordinates of Z."""
    p, x, u, rng = drawn(module, seed)
    g = element(module, rng)
    x |= {name: g[place] for name, place in element_names(module).items()}
    zeta = np.array([x[name] for name in module.STATE[-len(module.BASIS) :]])
    return p, np.array([x[name] for name in module.STATE]), u, g, zeta


def hat(module, coordinates):
    return np.einsum("a,aij->ij", coordinates, module.BASIS)


def loose(module, seed):
    """Any state: the equations are polynomial in what its relations would bind."""
    rng = np.random.default_rng(seed)
    p = drawn(module, seed)[0]
    x = rng.normal(size=len(module.STATE))
    if "q_0" in module.STATE:
        x[:4] /= np.linalg.norm(x[:4])
    else:
        row = next(x for x in module.STATE if x.startswith("A_1"))
        places = [module.STATE.index(row[:2] + f"{i}{j}") for i in "123" for j in "123"]
        a = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        x[places] = (a * np.linalg.det(a)).ravel()
        if module.STATE[-1].endswith("_dot"):
            z = rng.normal(size=(3, 3))
            z = z - z.T
            x[[module.STATE.index(module.STATE[i] + "_dot") for i in places]] = (
                a * np.linalg.det(a) @ z
            ).ravel()
    return p, x, rng.normal(size=len(module.INPUTS))


def charted(module, seed=3):
    """A state on the group, of code whose factors have charts: quaternions of length 1, matrices
    of other factors 1."""
    x = np.random.default_rng(seed).normal(size=len(module.STATE)) / 2
    for k, name in enumerate(module.STATE):
        if name.startswith("q") and name.endswith("_0"):
            x[k : k + 4] /= np.linalg.norm(x[k : k + 4])
        if name.startswith("A"):
            x[k] = name[-1] == name[-2]
    return x


# The least relative tolerance that SciPy takes; the absolute one is for entries that vanish.
CLOSE = {"method": "DOP853", "rtol": 2.3e-14, "atol": 1e-16}


def flow(code, k, x, times):
    """The states (len(times), N) of ``code``, a module or a library, that starts at times[0].

    From one time to the next: interpolation inside a step is less exact than the steps.
    """
    states = [np.asarray(x, float)]
    for start, end in pairwise(times):
        found = solve_ivp(code.rhs, (start, end), states[-1], args=(k,), **CLOSE)
        assert found.success, found.message
        states.append(found.y[:, -1])
    return np.array(states)
