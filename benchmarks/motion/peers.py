"""Integrators that are to be had, on the emitted equations: each a ``Run``, or an ImportError."""

from __future__ import annotations

import ctypes
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from ..peers.cases import Array, library
from ..peers.native import pointer
from .cases import Form
from .curves import Run
from .native import BUILDS, Steps, built


def system(form: Form) -> list[Any]:
    """The emitted equations as heyoka takes them, the constants as numbers."""
    hy = library("heyoka")
    variables = hy.make_vars(*form.module.STATE)
    rates = form.module.rhs(0.0, np.array(variables, dtype=object), form.k)
    return [(x, hy.expression(0.0) + r) for x, r in zip(variables, rates, strict=True)]


def heyoka(form: Form, steps: Steps) -> Run:
    """Taylor's series by heyoka, in double precision."""
    hy, equations = library("heyoka"), system(form)
    made: dict[float, Any] = {}

    def run(tol: float) -> tuple[float, Array]:
        if tol not in made:
            made[tol] = hy.taylor_adaptive(equations, form.x, tol=tol, fast_math=True)
        best = np.inf
        for _ in range(3):
            made[tol].time = 0.0
            made[tol].state[:] = form.x
            start = time.perf_counter()
            made[tol].propagate_until(form.motion.until)
            best = min(best, time.perf_counter() - start)
        return best, made[tol].state.copy()

    return run


def compiled_rhs(form: Form, steps: Steps) -> Callable[[float, Array], Array]:
    """dx/dt by the emitted C."""
    x, dx = np.zeros_like(form.x), np.zeros_like(form.x)
    addresses, zero = (pointer(x), pointer(dx), pointer(form.k)), ctypes.c_double(0.0)
    call = steps.library.rhs

    def rhs(t: float, y: Array) -> Array:
        x[:] = y
        call(zero, *addresses)
        return dx

    return rhs


def scipy(name: str) -> Callable[[Form, Steps], Run]:
    """The compiled integrators of SciPy that call Python for the rates."""

    def make(form: Form, steps: Steps) -> Run:
        ode, rhs = library("scipy.integrate").ode, compiled_rhs(form, steps)

        def run(tol: float) -> tuple[float, Array]:
            solver = ode(rhs).set_integrator(name, rtol=tol, atol=tol, nsteps=10**9)
            solver.set_initial_value(form.x, 0.0)
            start = time.perf_counter()
            end = solver.integrate(form.motion.until)
            seconds = time.perf_counter() - start
            return (seconds if solver.successful() else np.inf), np.array(end)

        return run

    return make


def numbalsoda(name: str) -> Callable[[Form, Steps], Run]:
    """LSODA and DOP853 compiled, on the emitted C."""

    def make(form: Form, steps: Steps) -> Run:
        solve = getattr(library("numbalsoda"), name)
        address = ctypes.cast(steps.library.rhs, ctypes.c_void_p).value
        times = np.array([0.0, form.motion.until])

        def run(tol: float) -> tuple[float, Array]:
            start = time.perf_counter()
            ends, right = solve(
                address, form.x, times, form.k if form.k.size else np.zeros(1), tol, tol, 10**9
            )
            seconds = time.perf_counter() - start
            return (seconds if right else np.inf), ends[-1]

        return run

    return make


def cvode(form: Form, steps: Steps) -> Run:
    """Adams's method of SUNDIALS in C, with the iteration that suits it."""
    places = ("/usr/include", "/usr/local/include")
    if not any(Path(place, "cvode/cvode.h").exists() for place in places):
        raise ImportError(name="SUNDIALS's headers")
    libraries = ("-lsundials_cvode", "-lsundials_sunnonlinsolfixedpoint", "-lsundials_nvecserial")
    own = str(form.folder / f"{form.name}.c")
    shared = built(form, "cvode.c", *BUILDS["native"], own, end=(*libraries, "-lm"))
    shared.run.restype = ctypes.c_double

    def run(tol: float) -> tuple[float, Array]:
        end = np.full_like(form.x, np.nan)
        numbers = (pointer(form.x), pointer(form.k), ctypes.c_double(form.motion.until))
        seconds = shared.run(*numbers, ctypes.c_double(tol), pointer(end))
        return (seconds if seconds > 0 else np.inf), end

    return run


def diffrax(form: Form, steps: Steps) -> Run:
    """Dormand and Prince's pair of order 8 in JAX, compiled, on the emitted Python."""
    jax, dfx = library("jax"), library("diffrax")
    jax.config.update("jax_enable_x64", True)
    np_like = jax.numpy
    k, x0 = np_like.asarray(form.k), np_like.asarray(form.x)
    term = dfx.ODETerm(lambda t, y, _: form.module.rhs(t, y, k))

    @jax.jit
    def solved(tol: Any) -> Any:
        control = dfx.PIDController(rtol=tol, atol=tol)
        found = dfx.diffeqsolve(
            *(term, dfx.Dopri8(), 0.0, form.motion.until, 0.01, x0),
            stepsize_controller=control,
            max_steps=10**8,
        )
        return found.ys[-1]

    return compiled_once(solved)


def gauss_in_jax(form: Form, steps: Steps) -> Run:
    """Our step in JAX, as it is emitted."""
    jax = library("jax")
    jax.config.update("jax_enable_x64", True)
    code, k = form.module, jax.numpy.asarray(form.k)

    @jax.jit
    def solved(tol: Any) -> Any:
        m = code.gauss_jax_to(code.begin_jax(0.0, form.x), k, None, form.motion.until, tol)
        return jax.numpy.where(m.status == code.OK, m.x, np.nan)

    return compiled_once(solved)


def compiled_once(solved: Callable[[float], Any]) -> Run:
    """The least of three runs of a function that JAX compiles."""
    solved(1e-3).block_until_ready()

    def run(tol: float) -> tuple[float, Array]:
        best = np.inf
        for _ in range(3):
            start = time.perf_counter()
            end = solved(tol).block_until_ready()
            best = min(best, time.perf_counter() - start)
        return best, np.array(end)

    return run


PEERS: dict[str, Callable[[Form, Steps], Run]] = {
    "heyoka": heyoka,
    "gauss in JAX": gauss_in_jax,
    "numbalsoda LSODA": numbalsoda("lsoda"),
    "numbalsoda DOP853": numbalsoda("dop853"),
    "SciPy DOP853": scipy("dop853"),
    "SciPy LSODA": scipy("lsoda"),
    "CVODE": cvode,
    "diffrax": diffrax,
}
FAST = ("heyoka", "gauss in JAX")
"""Those that are timed in every round, in every form."""
