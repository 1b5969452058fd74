"""Motions of emitted code, followed as closely as doubles allow."""

import tomllib
from functools import cache
from itertools import pairwise
from types import ModuleType

import numpy as np
from scipy.integrate import solve_ivp

import derive
from derive.problem.toml import problem_of
from tests.support.walks import derived

# The least relative tolerance that SciPy takes; the absolute one is for entries that vanish.
CLOSE = {"method": "DOP853", "rtol": 2.3e-14, "atol": 1e-16}


@cache
def emitted(problem, **choices):
    """The Python module of a ready-made problem, or of the text of a problem file."""
    own = "\n" in problem
    made = derive.derive(problem_of(tomllib.loads(problem))) if own else derived(problem)
    name = f"{made.problem.name}.py"
    module = ModuleType(made.problem.name)
    exec(compile(made.emit(languages=["python"], **choices)[name], name, "exec"), module.__dict__)
    return module


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
