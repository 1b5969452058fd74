"""The functions of an emitted program as data: what each takes and writes, and what it gives.

Every language loops over them.  Arrays are x, the state; k, the constants; p, the parameters; u,
the inputs; y, the state with momenta in place of the velocity; z, that with matrices in place of
quaternions and angles; dx and dy, the rates; dzeta, rates of the velocity, and Q, a covector, of N
numbers each; D, a matrix by rows: of variations V of a state, of inputs, parameters, N the
dimension of the group; out, of the size of what is taken, or as its function says; of a discrete
step q, h times its momentum, then h, v, its unknowns, b, what is computed before these, and s,
coordinates of what it turns by.
"""

from __future__ import annotations

import re
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


ARRAYS = {"q": "LOADED", "b": "BEGUN", "v": "UNKNOWNS", "s": "TURNS"}
"""The arrays of a discrete step and their sizes."""
SIZES = {"t": (), "n": (), "x": ("STATE",), "dx": ("STATE",), "y": ("STATE",), "dy": ("STATE",)}
SIZES |= {"k": ("CONSTANTS",), "p": ("PARAMETERS",), "u": ("INPUTS",), "z": ("MATRIX",)}
SIZES |= {"dzeta": ("ALGEBRA",), "Q": ("ALGEBRA",)}
SIZES |= {name: (size,) for name, size in ARRAYS.items()}
"""The sizes of the arguments that have the same in all functions."""
GIVEN, PRINCIPAL = "the frame of the parameters", "the principal frame that k holds"
TABLE = """
constants(p) -> k: all that depends on the parameters alone
rhs(t, x, k, u) -> dx: dx/dt at time t
rhs_batch(n, t, x, k, u) -> dx: the same for n states at once
energy(t, x, k): kinetic plus potential energy
multiplier(t, x, k, u): the multiplier theta of the volume, in a fluid the integral of the pressure
conserved(t, x, k) -> out[CONSERVED]: what the motion keeps where no input acts, one number for each
    of its names
outputs(t, x, k, u) -> out[OUTPUTS]: what is read off the motion, one number for each of its names
events(t, x, k, u) -> out[EVENTS]: what changes its sign at each event; what only touches 0 is one
    by rounding alone
project(x) -> out[STATE]: the state x taken back to the group by one Newton step
defect(x): how far x is off the group: the sum of the sizes of what its relations leave, 0 on the
    group
to_matrix(x) -> out[MATRIX]: the state x with matrices, row by row, in place of quaternions and
    angles
from_matrix(z) -> out[STATE]: the state z, with quaternions in place of its rotations, their scalars
    not negative
into_frame(x, k) -> out[STATE]: the state x taken from {given} to {principal}
out_of_frame(x, k) -> out[STATE]: the state x taken from {principal} to {given}
inputs_into_frame(u, k) -> out[INPUTS]: the inputs u taken from {given} to {principal}
inputs_out_of_frame(u, k) -> out[INPUTS]: the inputs u taken from {principal} to {given}
jacobian(t, x, k, u) -> dx, D[VARIATIONS VARIATIONS]: the rates dx/dt, and D, by rows: dV/dt = D V
    for the variations V that the head of the file tells
jacobian_inputs(t, x, k, u) -> D[VARIATIONS INPUTS]: the derivative of dV/dt by the inputs u, by
    rows
jacobian_parameters(t, x, p, u) -> D[VARIATIONS PARAMETERS]: the derivative of dV/dt by the
    parameters p, which it takes, not k, by rows
jacobian_raw(t, x, k, u) -> D[STATE STATE]: the derivative of dx/dt by x as it is stored, by rows,
    on the group and off it
jacobian_raw_inputs(t, x, k, u) -> D[STATE INPUTS]: the derivative of dx/dt by u, by rows
jacobian_project(x) -> D[STATE STATE]: the derivative of what project gives by x as it is stored, by
    rows
variations(x) -> D[STATE MOVES]: what x, as it is stored, changes by along variations V, on a
    quotient then along its symmetries, by rows
jacobian_outputs(t, x, k, u) -> D[OUTPUTS VARIATIONS]: the derivative of the outputs by V, by rows
jacobian_outputs_inputs(t, x, k, u) -> D[OUTPUTS INPUTS]: the derivative of the outputs by u, by
    rows
jacobian_outputs_raw(t, x, k, u) -> D[OUTPUTS STATE]: the derivative of the outputs by x as it is
    stored, by rows
mass_matrix(t, x, k) -> D[ALGEBRA ALGEBRA]: the mass matrix M, by rows
bias(t, x, k, u) -> out[ALGEBRA]: b: M a + b is the covector to be added to what acts, so that the
    velocity has the rates a
inverse(t, x, k, dzeta) -> Q: the covector Q that the inputs must supply for the velocity to have
    the rates dzeta
error_generator(t, x, k, u) -> D[ALGEBRA ALGEBRA]: the matrix A of d xi/dt = A xi, of the logarithm
    xi of the error, by rows
error_noise(t, x, k, u) -> D[ALGEBRA INPUTS]: the matrix G by which noise on the inputs adds to d
    xi/dt, by rows
momentum(t, x, k) -> out[STATE]: the state x with its momenta in place of the velocity
velocity(t, y, k) -> out[STATE]: the state y with its velocity in place of the momenta
velocity_step(t, x, y, k) -> out[STATE]: the state y with the velocity that Newton's step from that
    of x gives for its momenta
momentum_rhs(t, y, k, u) -> dy: dy/dt at time t, y the state with momenta
momentum_rates(t, x, y, k, u) -> dy: dy/dt at time t, y the state with momenta, x with the velocity
    that they have
poisson(t, y, k) -> out[REDUCED REDUCED]: the Poisson tensor at y, by rows
step_momentum(x, k) -> out[MOMENTA]: the momentum at x, that a discrete step takes
step_force(t, x, k, u) -> out[MOMENTA]: what the forces add to it in a unit of time
step_velocity(x, k, q) -> out[ALGEBRA]: the velocity of a momentum q
step_guess(x, k, q) -> out[TURNS]: about what a discrete step of h times the momentum, q, turns by
step_begin(x, k, q) -> out[BEGUN]: what a discrete step needs of x and q alone
step_newton(x, k, b, q, v) -> out[CORRECTED]: Newton's step for a discrete step v: what is to be
    taken away, and the determinant
step_turn(v, s) -> out[UNKNOWNS]: a discrete step v and a turn by s after it
step_turn_little(v, s) -> out[UNKNOWNS]: the same for an s of at most 1e-8
step_end(x, k, q, v) -> out[MOVED]: what a discrete step v adds to the element of x, and h times the
    momentum after it
inertia(p) -> I[6]: the tensor of inertia about the body's origin
"""
"""Each function, what it takes, what it writes with the sizes that are its own, and its doc, which
goes on in indented lines."""
MORE: dict[str, dict[str, Any]] = {
    "rhs_batch": {"of": "rhs", "only": "c"},
    "project": {"in_place": True},
    "inertia": {"only": "python"},
}
"""What else is said of some of them."""


def _signature(text: str) -> Signature:
    """The signature that an entry of the table tells."""
    head, doc = " ".join(text.split()).split(": ", 1)
    name, takes, _, writes = re.split(r"[()]|(?: -> )", f"{head} -> ")[:4]
    doc = doc.format(given=GIVEN, principal=PRINCIPAL)
    return Signature(name, _arguments(takes), _arguments(writes), doc, **MORE.get(name, {}))


def _arguments(text: str) -> tuple[Argument, ...]:
    """Arguments with commas between them, as ``t, x, D[STATE INPUTS]``."""
    found = re.findall(r"(\w+)(?:\[([^]]*)\])?", text)
    return tuple(Argument(x, tuple(sizes.split()) or SIZES[x]) for x, sizes in found)


SIGNATURES = tuple(map(_signature, re.split(r"\n(?! )", TABLE.strip())))
"""The functions in the order of the files; derivatives and frames are there when asked for."""


def functions(p: Program, written: Statements) -> dict[str, dict[str, Any]]:
    """Name → signature and statements, of the functions that a program has in a language.

    ``reads``: the letters of what it takes; ``given``, ``counts``: how many numbers each array has
    that is read, or written; ``rows``: those of D; ``stores``: the array, the index (from 0), the
    text and the title of each number.
    """
    sizes = p.sizes | {"6": 6}
    bodies = {name: written.function(f) for name, f in p.functions.items()}
    found = {s: bodies.get(s.of or s.name) for s in SIGNATURES}
    own = ("", written.language.name)
    told = {"doc": "kinetic energy, its mean over the torus"} if p.on_torus else {}

    def kinks(name: str) -> tuple[str, ...]:
        """What the comment of a Jacobian says of them."""
        kind = "outputs" if "outputs" in name else "rates"
        varied = name.startswith("jacobian") and name != "jacobian_project"
        return p.kinks.get(kind, ()) if varied else ()

    looped = p.loops.names if p.loops else ()
    return {
        s.name: _function(s, f, sizes, stored=s.name not in looped)
        | {"kinks": kinks(s.name)}
        | (told if s.name == "energy" else {})
        for s, f in found.items()
        if f and s.only in own
    }


def _function(
    s: Signature, body: Mapping[str, Any], sizes: Mapping[str, int], *, stored: bool
) -> dict[str, Any]:
    """``stored``: are its outputs what it writes, number by number?"""
    counts = {a.name: prod(sizes[x] for x in a.sizes) for a in s.writes}
    places = [(a, i) for a, count in counts.items() for i in range(count) if stored]
    texts = zip(places, body["outputs"], body["titles"], strict=True) if places else ()
    D = next((a for a in s.writes if a.name == "D"), None)
    rows = sizes[D.sizes[0]] if D else 0
    return {
        **vars(s),
        **body,
        "rows": rows,
        "reads": "".join(a.name for a in s.takes),
        "given": {a.name: prod(sizes[x] for x in a.sizes) for a in s.takes if a.sizes},
        "counts": counts,
        "stores": [{"array": a, "index": i, "text": x, "title": t} for (a, i), x, t in texts],
    }
