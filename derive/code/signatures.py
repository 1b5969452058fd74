"""The functions of an emitted program as data: what each takes and writes, and what it gives.

Every language loops over them.  Arrays are x, the state; k, the constants; p, the parameters; u,
the inputs; y, the state with momenta in place of the velocity; z, that with a matrix in place of
the quaternion; dx and dy, the rates; D, a matrix by rows: 2N × 2N, or with a column for each input
or parameter, N the dimension of the group; out, of the size of what is taken, or as its function
says; of a discrete step q, h times its momentum, then h, v, its unknowns, b, what is computed
before these, and s, coordinates of what it turns by.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import prod
from typing import Any

from .languages import Statements
from .program import Program


@dataclass(frozen=True)
class Argument:
    """An argument of an emitted function.

    An array of as many numbers as its sizes multiply to, or without sizes a number: ``t``, the
    time, or ``n``, a count.
    """

    name: str
    sizes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Signature:
    """An emitted function that writes arrays, or returns a number where it writes none.

    ``doc``: what it gives, as a part of a sentence. ``in_place``: may what is written be what is
    read? ``of``: the function of the program, where that has another name; ``only``: the language
    that has it, empty for all.
    """

    name: str
    takes: tuple[Argument, ...]
    writes: tuple[Argument, ...] = ()
    doc: str = ""
    in_place: bool = False
    of: str = ""
    only: str = ""


T, COUNT, DX = Argument("t"), Argument("n"), Argument("dx", ("STATE",))
X, K, P, U, Y = (
    Argument(name, (size,))
    for name, size in zip(
        "xkpuy", ("STATE", "CONSTANTS", "PARAMETERS", "INPUTS", "STATE"), strict=True
    )
)
DY, TENSOR = Argument("dy", ("STATE",)), Argument("out", ("REDUCED", "REDUCED"))
Z, Z_OUT = Argument("z", ("MATRIX",)), Argument("out", ("MATRIX",))
OUT, INPUTS_OUT = Argument("out", ("STATE",)), Argument("out", ("INPUTS",))


def _matrix(*columns: str) -> Argument:
    return Argument("D", ("2", "ALGEBRA", *columns))


ARRAYS = {"q": "LOADED", "b": "BEGUN", "v": "UNKNOWNS", "s": "TURNS"}
"""The arrays of a discrete step and their sizes."""

Q, B, V, S = (Argument(name, (size,)) for name, size in ARRAYS.items())


def _out(*sizes: str) -> Argument:
    return Argument("out", sizes)


GIVEN, PRINCIPAL = "the frame of the parameters", "the principal frame that k holds"
THERE, BACK = f"taken from {GIVEN} to {PRINCIPAL}", f"taken from {PRINCIPAL} to {GIVEN}"
SIGNATURES = (
    Signature("constants", (P,), (K,), "all that depends on the parameters alone"),
    Signature("rhs", (T, X, K, U), (DX,), "dx/dt at time t"),
    Signature(
        "rhs_batch", (COUNT, T, X, K, U), (DX,), "the same for n states at once", False, "rhs", "c"
    ),
    Signature("energy", (T, X, K), doc="kinetic plus potential energy"),
    Signature(
        "multiplier",
        (T, X, K, U),
        doc="the multiplier theta of the volume, in a fluid the integral of the pressure",
    ),
    Signature(
        "conserved",
        (T, X, K),
        (Argument("out", ("CONSERVED",)),),
        "what the motion keeps where no input acts, one number for each of its names",
    ),
    Signature(
        "outputs",
        (T, X, K, U),
        (Argument("out", ("OUTPUTS",)),),
        "what is read off the motion, one number for each of its names",
    ),
    Signature(
        "events",
        (T, X, K, U),
        (Argument("out", ("EVENTS",)),),
        "what changes its sign at each event; what only touches 0 is one by rounding alone",
    ),
    Signature(
        "project", (X,), (OUT,), "the state x taken back to the group by one Newton step", True
    ),
    Signature(
        "defect",
        (X,),
        doc="how far x is off the group: the sum of the sizes of what its relations leave, "
        "0 on the group",
    ),
    Signature(
        "to_matrix", (X,), (Z_OUT,), "the state x with A, row by row, in place of the quaternion"
    ),
    Signature(
        "from_matrix",
        (Z,),
        (OUT,),
        "the state z, which begins with a rotation A, with its quaternion instead, q_0 >= 0",
    ),
    Signature("into_frame", (X, K), (OUT,), f"the state x {THERE}"),
    Signature("out_of_frame", (X, K), (OUT,), f"the state x {BACK}"),
    Signature("inputs_into_frame", (U, K), (INPUTS_OUT,), f"the inputs u {THERE}"),
    Signature("inputs_out_of_frame", (U, K), (INPUTS_OUT,), f"the inputs u {BACK}"),
    Signature("jacobian", (T, X, K, U), (DX, _matrix("2", "ALGEBRA")), "dx/dt, and D"),
    Signature("jacobian_inputs", (T, X, K, U), (_matrix("INPUTS"),), "its derivative by u"),
    Signature("jacobian_parameters", (T, X, P, U), (_matrix("PARAMETERS"),), "that by p"),
    Signature(
        "jacobian_raw",
        (T, X, K, U),
        (Argument("D", ("STATE", "STATE")),),
        "that of dx/dt by x as it is stored, by rows",
    ),
    Signature(
        "jacobian_raw_inputs",
        (T, X, K, U),
        (Argument("D", ("STATE", "INPUTS")),),
        "the derivative of dx/dt by u, by rows",
    ),
    Signature(
        "jacobian_project",
        (X,),
        (Argument("D", ("STATE", "STATE")),),
        "the derivative of what project gives by x as it is stored, by rows",
    ),
    Signature(
        "variations",
        (X,),
        (Argument("D", ("STATE", "2", "ALGEBRA")),),
        "what x, as it is stored, changes by along (eta, delta zeta), by rows",
    ),
    Signature(
        "jacobian_outputs",
        (T, X, K, U),
        (Argument("D", ("OUTPUTS", "2", "ALGEBRA")),),
        "the derivative of the outputs by (eta, delta zeta), by rows",
    ),
    Signature(
        "jacobian_outputs_inputs",
        (T, X, K, U),
        (Argument("D", ("OUTPUTS", "INPUTS")),),
        "the derivative of the outputs by u, by rows",
    ),
    Signature(
        "jacobian_outputs_raw",
        (T, X, K, U),
        (Argument("D", ("OUTPUTS", "STATE")),),
        "the derivative of the outputs by x as it is stored, by rows",
    ),
    Signature(
        "mass_matrix",
        (T, X, K),
        (Argument("D", ("ALGEBRA", "ALGEBRA")),),
        "the mass matrix M, by rows",
    ),
    Signature(
        "bias",
        (T, X, K, U),
        (Argument("out", ("ALGEBRA",)),),
        "b: M a + b is the covector to be added to what acts, so that the velocity has the rates a",
    ),
    Signature(
        "error_generator",
        (T, X, K, U),
        (Argument("D", ("ALGEBRA", "ALGEBRA")),),
        "the matrix A of d xi/dt = A xi, of the logarithm xi of the error, by rows",
    ),
    Signature(
        "error_noise",
        (T, X, K, U),
        (Argument("D", ("ALGEBRA", "INPUTS")),),
        "the matrix G by which noise on the inputs adds to d xi/dt, by rows",
    ),
    Signature(
        "momentum", (T, X, K), (OUT,), "the state x with its momenta in place of the velocity"
    ),
    Signature(
        "velocity", (T, Y, K), (OUT,), "the state y with its velocity in place of the momenta"
    ),
    Signature(
        "velocity_step",
        (T, X, Y, K),
        (OUT,),
        "the state y with the velocity that Newton's step from that of x gives for its momenta",
    ),
    Signature("momentum_rhs", (T, Y, K, U), (DY,), "dy/dt at time t, y the state with momenta"),
    Signature(
        "momentum_rates",
        (T, X, Y, K, U),
        (DY,),
        "dy/dt at time t, y the state with momenta, x with the velocity that they have",
    ),
    Signature("poisson", (T, Y, K), (TENSOR,), "the Poisson tensor at y, by rows"),
    Signature(
        "step_momentum", (X, K), (_out("MOMENTA"),), "the momentum at x, that a discrete step takes"
    ),
    Signature(
        "step_force",
        (T, X, K, U),
        (_out("MOMENTA"),),
        "what the forces add to it in a unit of time",
    ),
    Signature("step_velocity", (X, K, Q), (_out("ALGEBRA"),), "the velocity of a momentum q"),
    Signature(
        "step_guess",
        (X, K, Q),
        (_out("TURNS"),),
        "about what a discrete step of h times the momentum, q, turns by",
    ),
    Signature(
        "step_begin", (X, K, Q), (_out("BEGUN"),), "what a discrete step needs of x and q alone"
    ),
    Signature(
        "step_newton",
        (X, K, B, Q, V),
        (_out("CORRECTED"),),
        "Newton's step for a discrete step v: what is to be taken away, and the determinant",
    ),
    Signature(
        "step_turn", (V, S), (_out("UNKNOWNS"),), "a discrete step v and a turn by s after it"
    ),
    Signature("step_turn_little", (V, S), (_out("UNKNOWNS"),), "the same for an s of at most 1e-8"),
    Signature(
        "step_end",
        (X, K, Q, V),
        (_out("MOVED"),),
        "what a discrete step v adds to the element of x, and h times the momentum after it",
    ),
    Signature(
        "inertia",
        (P,),
        (Argument("I", ("6",)),),
        "the tensor of inertia about the body's origin",
        only="python",
    ),
)
"""The functions in the order of the files; derivatives and frames are there when asked for."""


def functions(p: Program, written: Statements) -> dict[str, dict[str, Any]]:
    """Name → signature and statements, of the functions that a program has in a language.

    ``reads``: the letters of what it takes; ``counts``: how many numbers each array that is written
    has; ``rows``: those of D; ``stores``: the array, the index (from 0), the text and the title of
    each number.
    """
    sizes = {
        "STATE": len(p.state),
        "CONSTANTS": len(p.constants),
        "PARAMETERS": len(p.parameters),
        "INPUTS": len(p.inputs),
        "CONSERVED": len(p.conserved),
        "EVENTS": len(p.events),
        "OUTPUTS": len(p.outputs),
        "ALGEBRA": p.dimension,
        "REDUCED": p.reduced,
        **(p.discrete.sizes if p.discrete else {}),
        "MATRIX": len(p.matrix_state),
        "2": 2,
        "6": 6,
    }
    bodies = {name: written.function(f) for name, f in p.functions.items()}
    found = {s: bodies.get(s.of or s.name) for s in SIGNATURES}
    own = ("", written.language.name)
    told = {"doc": "kinetic energy, its mean over the torus"} if p.on_torus else {}
    return {
        s.name: _function(s, f, sizes) | (told if s.name == "energy" else {})
        for s, f in found.items()
        if f and s.only in own
    }


def _function(s: Signature, body: Mapping[str, Any], sizes: Mapping[str, int]) -> dict[str, Any]:
    counts = {a.name: prod(sizes[x] for x in a.sizes) for a in s.writes}
    places = [(a, i) for a, count in counts.items() for i in range(count)]
    texts = zip(places, body["outputs"], body["titles"], strict=True) if places else ()
    D = next((a for a in s.writes if a.name == "D"), None)
    rows = prod(sizes[x] for x in D.sizes[: 2 if D.sizes[0] == "2" else 1]) if D else 0
    return {
        **vars(s),
        **body,
        "rows": rows,
        "reads": "".join(a.name for a in s.takes),
        "counts": counts,
        "stores": [{"array": a, "index": i, "text": x, "title": t} for (a, i), x, t in texts],
    }
