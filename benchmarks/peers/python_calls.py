"""One state at a time from Python: our emitted module, SymPy's lambdify, PyDy."""

from __future__ import annotations

import statistics
from collections.abc import Callable
from typing import Any

import numpy as np

from .cases import Array, Case, Emitted, library
from .equations import EQUATIONS, constants
from .limits import nanoseconds
from .mechanics import kane_method, solid
from .native import error

Call = Callable[[], Any]


def ours(case: Case, x: Array, emitted: Emitted) -> Call:
    """The emitted module."""
    k = emitted.module.constants(emitted.parameters)
    return lambda: emitted.module.rhs(0.0, x, k)


def lambdify(case: Case, x: Array, emitted: Emitted) -> Call:
    """The equations by hand through lambdify with cse."""
    sp = library("sympy")
    k = constants(case)
    x_, k_ = sp.symbols(f"x:{case.size}"), sp.symbols(f"k:{len(k)}")
    right = EQUATIONS[case.name](x_, k_)
    run = sp.lambdify([x_, k_], right, modules="math", cse=True)
    numbers = k.tolist()
    return lambda: np.array(run(x.tolist(), numbers))


def pydy(case: Case, x: Array, emitted: Emitted) -> Call:
    """Kane's equations through PyDy's lambdified right side."""
    generate = library("pydy.codegen.ode_function_generators").generate_ode_function
    k = solid(case)
    symbols, k_, method = kane_method(case.name == "p2", len(k))
    size = len(method.u)
    q, u = symbols[:-size], symbols[-size:]
    run = generate(
        method.forcing_full,
        q,
        u,
        constants=k_,
        mass_matrix=method.mass_matrix_full,
        generator="lambdify",
        constants_arg_type="array",
    )
    return lambda: run(x, 0.0, k)


MAKERS = {"derive (ours)": ours, "SymPy lambdify": lambdify, "PyDy lambdify": pydy}


def measure(case: Case, x: Array, wanted: Array, emitted: Emitted, rounds: int) -> dict[str, str]:
    """µs of a call, or why there is none."""
    calls: dict[str, Call] = {}
    found: dict[str, str] = {}
    for name, make in MAKERS.items():
        try:
            call = make(case, x, emitted)
            wrong = error(np.asarray(call(), dtype=float).reshape(1, -1), wanted[None])
        except ImportError:
            found[name] = "not installed"
        except Exception as problem:
            found[name] = f"{type(problem).__name__}: {str(problem).splitlines()[0][:100]}"
        else:
            calls[name] = call
            if not wrong < 1e-11:
                found[name] = f"wrong: {wrong:.1e}"
                del calls[name]
    times: dict[str, list[float]] = {name: [] for name in calls}
    for _ in range(rounds):
        for name, call in calls.items():

            def several(call: Call = call) -> None:
                for _ in range(200):
                    call()

            times[name].append(nanoseconds(several) / 200_000)
    found |= {name: f"{statistics.median(t):.2f} µs" for name, t in times.items()}
    return {name: found[name] for name in MAKERS}
