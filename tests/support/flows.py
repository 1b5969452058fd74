"""Motions of emitted code, followed as closely as doubles allow."""

from itertools import pairwise

import numpy as np
from scipy.integrate import solve_ivp

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
