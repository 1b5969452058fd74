"""The two rows that are always there: our emitted C and the expert's."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .cases import HERE, Array, Case, Emitted, emit
from .count import operations
from .native import Native, compile_shared, copy, pointer

EXPERT_CONSTANTS = {"p1": 16, "p2": 26, "p3": 14}
EXPERT_OPERATIONS = {
    "p1": "55 mul, 35 add",
    "p2": "94 mul, 74 add",
    "p3": "104 mul, 88 add, 1 div",
}
BATCH = "(size_t n, double t, const double *x, const double *k, const double *u, double *dx);"
MANY = "(size_t n, const double *x, const double *k, double *dx);"
SIGNATURE = "(double t, const double *x, const double *k, const double *u, double *dx);"


def ours(case: Case, states: Array, folder: Path) -> tuple[Emitted, Native]:
    """What ``derive emit`` writes."""
    emitted = emit(case, folder)
    k = np.asarray(emitted.module.constants(emitted.parameters), dtype=float)
    return emitted, _native("derive (ours)", case.name, emitted, k, states)


def _native(label: str, name: str, emitted: Emitted, k: Array, states: Array) -> Native:
    return Native(
        name=label,
        sources=[emitted.folder / f"{name}.c"],
        function=f"{name}_rhs",
        constants=k,
        states=states,
        outputs=states.shape[1],
        operations=emitted.operations(),
        prototype=f"void {name}_rhs{SIGNATURE}",
        call=f"{name}_rhs(0.0, xi, k, 0, di)",
        many=(f"void {name}_rhs_batch{BATCH}", f"{name}_rhs_batch(n, 0.0, x, k, 0, dx)"),
    )


def framed(case: Case, states: Array, wanted: Array, folder: Path) -> list[tuple[Native, Array]]:
    """Ours in the principal frame, for P3 also with dA/dt as velocity, and what is right there."""
    found = []
    for velocity in ("body", "tangent") if case.name == "p3" else ("body",):
        name = f"{case.name}_{velocity}"
        emitted = emit(case, folder, name, "--frame", "principal", "--velocity", velocity)
        module = emitted.module
        k = np.asarray(module.constants(emitted.parameters), dtype=float)
        pairs = [states, wanted]
        if velocity == "tangent":
            pairs = list(_tangent(states, wanted, module.BASIS))
        x, dx = (np.asarray(module.into_frame(y, k)) for y in pairs)
        label = "derive, principal frame" + (", dA/dt" if velocity == "tangent" else "")
        found.append((_native(label, name, emitted, k, x), dx))
    return found


def _tangent(x: Array, dx: Array, basis: Array) -> tuple[Array, Array]:
    """(A, AZ) and its rate (AZ, A(Z' + Z²)), from (A, ζ) and its rate."""
    A = x[:, :9].reshape(-1, 3, 3)
    Z, rate = (np.einsum("sa,aij->sij", y[:, 9:], basis) for y in (x, dx))
    parts = (A, A @ Z, A @ (rate + Z @ Z))
    flat = [y.reshape(-1, 9) for y in parts]
    return np.hstack(flat[:2]), np.hstack(flat[1:])


def expert(case: Case, states: Array, folder: Path, parameters: Array) -> Native:
    """The code written by hand, its count of operations checked."""
    function = f"expert_{case.name}"
    source = copy(HERE / f"{function}.c", folder)
    counted = operations(source.read_text(encoding="utf-8"), "core")
    if counted != EXPERT_OPERATIONS[case.name]:
        raise RuntimeError(f"{function} has {counted}")
    constants = np.zeros(EXPERT_CONSTANTS[case.name])
    library = compile_shared([source], [], folder)
    library[f"{function}_constants"](pointer(parameters), pointer(constants))
    many = (f"void {function}_batch{MANY}", f"{function}_batch(n, x, k, dx)")
    return Native("expert", [source], function, constants, states, case.size, counted, many=many)
