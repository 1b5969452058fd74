"""Many states at once: structure of arrays, in cache and out of it."""

from __future__ import annotations

import ctypes
import random
import statistics
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from .cases import Array, Case, Emitted, library, load
from .equations import EQUATIONS, constants
from .limits import nanoseconds
from .native import Native, aligned, error, pointer

JAX = {True: "stacked", False: "rows"}
SOURCE = Path(__file__).with_name("equations.py")


@dataclass
class Many:
    """A way to evaluate many states: ``action`` does it, ``result`` gives dx, one state a row."""

    name: str
    action: Callable[[], object]
    result: Callable[[], Array]
    note: str = ""
    inner: int = 1
    """How often an action does it."""
    times: list[float] = field(default_factory=list)


def loop(native: Native, x: Array) -> Many:
    """The function for one state in a loop, array of structures."""
    size, k = ctypes.c_size_t(len(x)), pointer(native.constants)
    kept, out = Native.place(x), aligned(x.shape)
    inner = again(x)
    arguments = (ctypes.c_long(inner), size, pointer(kept), k, pointer(out))

    def action() -> Array:
        native.library.repeat(*arguments)
        return kept

    note = "array of structures"
    return Many(f"{native.name}, loop of calls", action, lambda: out, note, inner)


def arrays(native: Native, x: Array) -> Many:
    """The function for many states."""
    size, k = ctypes.c_size_t(len(x)), pointer(native.constants)
    kept, out = Native.place(np.ascontiguousarray(x.T)), aligned(x.T.shape)
    inner = again(x)
    arguments = (ctypes.c_long(inner), size, pointer(kept), k, pointer(out))

    def action() -> Array:
        native.library.repeat_batch(*arguments)
        return kept

    return Many(f"{native.name}, batch", action, lambda: out.T, "", inner)


def again(x: Array) -> int:
    """How often few states are computed in one call: wide vectors take a while to run fast."""
    return max(1, 400_000 // len(x)) if len(x) < 10_000 else 1


def numba(case: Case, x: Array) -> Many:
    """A loop compiled by Numba; the equations inlined."""
    njit = library("numba").njit
    module = load(SOURCE, "benchmarks.peers.equations_numba")
    helpers = ("dot", "cross", "add", "less", "scale", "flip", "on", "times")
    for name in (*helpers, "three", "nine", "symmetric", case.name):
        setattr(module, name, njit(error_model="numpy")(getattr(module, name)))
    body, size = getattr(module, case.name), case.size

    def run(x: Array, k: Array, dx: Array) -> None:
        for s in range(x.shape[1]):
            right = body(x[:, s], k)
            for i in range(size):
                dx[i, s] = right[i]

    compiled = njit(error_model="numpy")(run)
    kept, k, out = np.ascontiguousarray(x.T), constants(case), aligned(x.T.shape)
    return Many("Numba", lambda: compiled(kept, k, out), lambda: out.T)


def jax(case: Case, x: Array, stacked: bool) -> Many:
    """jit of vmap, float64 on the CPU: dx as one array, written where the last was, or as rows."""
    jax, jnp = library("jax"), library("jax.numpy")
    jax.config.update("jax_enable_x64", True)
    kept, k = jnp.asarray(x.T), jnp.asarray(constants(case))
    out: list[Any] = [jnp.zeros_like(kept)]

    def one(x: Any, k: Any) -> Any:
        right = EQUATIONS[case.name](x, k)
        return jnp.stack(right) if stacked else right

    each = jax.vmap(one, in_axes=(1, None), out_axes=1 if stacked else 0)
    again = {"donate_argnums": 2, "keep_unused": True} if stacked else {}
    run = jax.jit(lambda x, k, out: each(x, k), **again)

    def action() -> None:
        out[0] = jax.block_until_ready(run(kept, k, out[0] if stacked else 0))

    return Many(f"JAX, {JAX[stacked]}", action, lambda: np.asarray(out[0]).T)


def measure(ways: list[Many], wanted: Array, rounds: int) -> dict[str, str]:
    """Check, then time them in a new order each round; why a way is not timed."""
    refused = {}
    for way in list(ways):
        way.action()
        wrong = error(way.result(), wanted)
        if not wrong < 1e-11:
            refused[way.name] = f"wrong: {wrong:.1e}"
            ways.remove(way)
    count = len(wanted)
    repeat = max(1, 20_000 // count)

    order = random.Random(1)
    for _ in range(rounds):
        for way in order.sample(ways, len(ways)):
            calls = max(1, repeat // way.inner)

            def several(action: Callable[[], object] = way.action, calls: int = calls) -> None:
                for _ in range(calls):
                    action()

            way.times.append(nanoseconds(several) / (calls * way.inner * count))
    return refused


def candidates(
    case: Case, x: Array, natives: dict[str, Native], emitted: Emitted
) -> tuple[list[Many], dict[str, str]]:
    """All ways there are here, and why others are not."""
    own, hand = natives["ours"], natives["expert"]
    name = f"{case.name}_rhs_batch"
    makers: dict[str, Callable[[], Many]] = {
        "derive (ours), loop of calls": lambda: loop(own, x),
        "derive (ours), batch": lambda: arrays(own, x),
        "expert, loop of calls": lambda: loop(hand, x),
        "expert, batch": lambda: arrays(hand, x),
        "Numba": lambda: numba(case, x),
        f"JAX, {JAX[True]}": lambda: jax(case, x, True),
        f"JAX, {JAX[False]}": lambda: jax(case, x, False),
    }
    refused = {}
    if name not in emitted.header:
        del makers["derive (ours), batch"]
        refused["derive (ours), batch"] = "not in the emitted header"
    ways = []
    for label, make in makers.items():
        try:
            ways.append(make())
        except ImportError:
            refused[label] = "not installed"
        except Exception as problem:
            refused[label] = f"{type(problem).__name__}: {str(problem).splitlines()[0][:100]}"
    return ways, refused


def medians(ways: list[Many]) -> dict[str, float]:
    """ns of a state."""
    return {way.name: statistics.median(way.times) for way in ways}
