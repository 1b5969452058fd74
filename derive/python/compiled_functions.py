"""The functions of a compiled problem, by the C that is loaded: of its state, in momenta, of its
group."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from ..code.group_functions import GroupFunctions
from ..code.options import ADDED
from ..code.program import Block, Program
from ..motion.native import Array, CSource, pointer
from ..motion.trajectory import reflection


class Names(NamedTuple):
    """The names of a program's numbers, and the counts of constants and of coordinates of 𝔤."""

    state: tuple[str, ...]
    inputs: tuple[str, ...]
    conserved: tuple[str, ...]
    outputs: tuple[str, ...]
    events: tuple[str, ...]
    defaults: dict[str, float | None]
    steps: tuple[str, ...]
    constants: int
    algebra: int
    reduced: int
    varied: int
    unread: tuple[str, ...]
    blocks: tuple[Block, ...]
    matrix_state: tuple[str, ...]
    matrix_blocks: tuple[Block, ...]
    group: GroupFunctions | None

    @classmethod
    def of(
        cls, program: Program, steps: tuple[str, ...] = (), declared: Sequence[str] = ()
    ) -> Names:
        """The names of a program, of the steps that are emitted with it, and of the parameters
        that a problem has ``declared`` and the program does not read."""
        defaults = {x[0]: x[1] for x in program.parameters}
        sizes = len(program.constants), program.dimension, program.reduced, program.varied
        events = tuple(x.name for x in program.events)
        named = program.state, program.inputs, program.conserved, program.outputs, events
        unread = tuple(x for x in declared if x not in defaults)
        matrices = program.matrix_state, program.matrix_blocks
        group = program.group_functions
        return cls(*named, defaults, steps, *sizes, unread, program.blocks, *matrices, group)


class CompiledValues(NamedTuple):
    """The numbers that stay from call to call: parameters, constants, inputs. They are replaced as
    a whole: a call under way keeps those that it has."""

    p: Array
    k: Array
    u: Array
    ready: bool


class CompiledFunctions:
    """The functions of a problem in C: d is the dimension of its group G, g an element as in the
    state x, which has N numbers, M of them those of g."""

    STATE: tuple[str, ...]
    PARAMETERS: tuple[str, ...]
    INPUTS: tuple[str, ...]
    CONSERVED: tuple[str, ...]
    OUTPUTS: tuple[str, ...]
    REDUCED: int
    """The variables of the Poisson tensor."""
    _names: Names
    _source: CSource
    _library: ctypes.CDLL
    _values: CompiledValues

    def _in_use(self) -> CompiledValues:
        """The numbers in use; ``ValueError`` where parameters have no value yet."""
        values = self._values
        if not values.ready:
            missing = [name for name, value in self._names.defaults.items() if value is None]
            which = ", ".join(missing)
            raise ValueError(f"no value for the parameters {which}: call use() first")
        return values

    def energy(self, t: float, x: Any) -> float:
        """The energy at time t in state x: kinetic plus potential."""
        return float(self._call_at("energy", ctypes.c_double, t, x, self._in_use().k))

    def multiplier(self, t: float, x: Any, u: Any = None) -> float:
        """The multiplier θ of the volume; needs ``multiplier=True``."""
        k = self._in_use().k
        return float(self._call_at("multiplier", ctypes.c_double, t, x, k, self._inputs(u)))

    def conserved(self, t: float, x: Any) -> Array:
        """What the motion keeps where no input acts, by the names of ``CONSERVED``."""
        return self._written("conserved", (len(self.CONSERVED),), t, x)

    def outputs(self, t: float, x: Any, u: Any = None) -> Array:
        """What is read off the motion, by the names of ``OUTPUTS``."""
        return self._written("outputs", (len(self.OUTPUTS),), t, x, self._inputs(u))

    def jacobian(self, t: float, x: Any, u: Any = None) -> tuple[Array, Array]:
        """dx/dt, and the (2d, 2d) matrix D of the equations linearised in the state."""
        dx = np.zeros(len(self.STATE))
        return dx, self._written("jacobian", self._linear(), t, x, self._inputs(u), dx)

    def jacobian_inputs(self, t: float, x: Any, u: Any = None) -> Array:
        """The (2d, inputs) matrix D of the linearised equations in the inputs."""
        shape = self._linear(len(self.INPUTS))
        return self._written("jacobian_inputs", shape, t, x, self._inputs(u))

    def jacobian_parameters(self, t: float, x: Any, u: Any = None) -> Array:
        """The (2d, parameters) matrix D of the linearised equations in the parameters."""
        D = np.zeros(self._linear(len(self.PARAMETERS)))
        self._call_at("jacobian_parameters", None, t, x, self._in_use().p, self._inputs(u), D)
        return D

    def jacobian_raw(self, t: float, x: Any, u: Any = None) -> Array:
        """The derivative of dx/dt by x as it is stored, (len(STATE), len(STATE)), for the
        ``jac`` of ``solve_ivp``."""
        return self._written("jacobian_raw", (len(self.STATE),) * 2, t, x, self._inputs(u))

    def mass_matrix(self, t: float, x: Any) -> Array:
        """The mass matrix, (d, d) in the basis of the velocity; needs ``dynamics=True``."""
        return self._written("mass_matrix", (self._names.algebra,) * 2, t, x)

    def inverse(self, t: float, x: Any, rates: Any) -> Array:
        """The covector Q, (d,), that the inputs must supply for the velocity to have these rates,
        (d,); needs ``dynamics=True``."""
        d = self._names.algebra
        return self._written("inverse", (d,), t, x, as_array(rates, d))

    def jacobian_outputs(self, t: float, x: Any, u: Any = None) -> tuple[Array, Array]:
        """C and D: the derivatives of the outputs, (len(OUTPUTS), 2d) by (η, δζ), and
        (len(OUTPUTS), len(INPUTS)) by the inputs; needs ``jacobian="outputs"``."""
        count, held = len(self.OUTPUTS), self._inputs(u)
        C = self._written("jacobian_outputs", (count, self._names.varied), t, x, held)
        if not self.INPUTS:
            return C, np.zeros((count, 0))
        return C, self._written("jacobian_outputs_inputs", (count, len(self.INPUTS)), t, x, held)

    def project(self, x: Any) -> Array:
        """The state x taken back to the group by one Newton step; see the emitted header."""
        return self._made("project", x, len(self.STATE))

    def defect(self, x: Any) -> float:
        """How far the state x is off the group: 0 on it."""
        function = self._function("defect", ctypes.c_double)
        return float(function(pointer(as_array(x, len(self.STATE)))))

    def to_matrix(self, x: Any) -> Array:
        """The state x with matrices, row by row, for its quaternions and angles; needs an
        ``attitude``, as ``attitude="quaternion"``."""
        return self._made("to_matrix", x, len(self.STATE), len(self._names.matrix_state))

    def from_matrix(self, z: Any) -> Array:
        """The state z with the quaternions of its rotations, their scalars not negative; where x
        has an angle, how often it went round is not in z, and there is no such function."""
        size, blocks = len(self._names.matrix_state), self._names.matrix_blocks
        if self._has("from_matrix") and (fault := reflection(blocks, as_array(z, size))):
            raise ValueError(fault)
        return self._made("from_matrix", z, size, len(self.STATE))

    def into_frame(self, x: Any) -> Array:
        """The state x taken to the principal frame; needs ``frame="principal"``."""
        return self._change_frame("into_frame", x, len(self.STATE))

    def out_of_frame(self, x: Any) -> Array:
        """The state x taken back from the principal frame."""
        return self._change_frame("out_of_frame", x, len(self.STATE))

    def inputs_into_frame(self, u: Any) -> Array:
        """The inputs u taken to the principal frame."""
        return self._change_frame("inputs_into_frame", u, len(self.INPUTS))

    def inputs_out_of_frame(self, u: Any) -> Array:
        """The inputs u taken back from the principal frame."""
        return self._change_frame("inputs_out_of_frame", u, len(self.INPUTS))

    # -- in momenta, by ``momenta=True`` -----------------------------------------------------------
    def momentum(self, t: float, x: Any) -> Array:
        """The state x with its momenta in the place of the velocity; needs ``momenta=True``."""
        return self._written("momentum", (len(self.STATE),), t, x)

    def velocity(self, t: float, y: Any) -> Array:
        """The state y, with momenta, with its velocity in their place; ``ArithmeticError`` where
        Newton's method does not find it."""
        return self._written("velocity", (len(self.STATE),), t, y)

    def momentum_rhs(self, t: float, y: Any, u: Any = None) -> Array:
        """dy/dt, y the state with momenta; ``ArithmeticError`` as that of :meth:`velocity`."""
        return self._written("momentum_rhs", (len(self.STATE),), t, y, self._inputs(u))

    def poisson(self, t: float, y: Any) -> Array:
        """The matrix of the Poisson brackets of the momenta, and of what is carried along."""
        return self._written("poisson", (self.REDUCED,) * 2, t, y)

    # -- of the group, by ``exponential=True`` -----------------------------------------------------
    def exp(self, eta: Any) -> Array:
        """The element g, (M,), the exponential of Σ η_a E_a, η (d,)."""
        return self._on_the_group("exp", eta)

    def log(self, g: Any) -> Array:
        """The η, (d,), with exp η = g that turns by at most π; at π one of two. On groups that do
        more than turn and shift that of eigenvalues a + bi with −π < b < π; nan where one of g is
        negative or 0."""
        return self._on_the_group("log", g)

    def exp_jacobian(self, eta: Any) -> Array:
        """J, (d, d): exp(η + δ) = exp(η) exp(J δ) for small δ; exp(J δ) exp(η) where Z = ġ g⁻¹."""
        return self._on_the_group("exp_jacobian", eta)

    def log_jacobian(self, g: Any) -> Array:
        """The inverse of :meth:`exp_jacobian` at log g, (d, d)."""
        return self._on_the_group("log_jacobian", g)

    def retract(self, x: Any, eta: Any) -> Array:
        """The state, (N,), with g exp(η) in place of g and δζ added to the velocity, of (η, δζ),
        (2d,): the coordinates of :meth:`Compiled.jacobian`."""
        return self._on_the_group("retract", x, eta)

    def local(self, x: Any, y: Any) -> Array:
        """The (η, δζ), (2d,), that :meth:`retract` takes x to y by, η as :meth:`log` has it."""
        return self._on_the_group("local", x, y)

    def update_left(self, x: Any, o: Any, Y: Any, N: Any) -> Array:
        """The state, (N,), an estimate and the covariance of its error, after an observation of
        what varies of A o + V: Y, (m,), V a noise of the covariance N, (m, m)."""
        return self._on_the_group("update_left", x, o, Y, np.reshape(N, -1))

    def update_right(self, x: Any, o: Any, Y: Any, N: Any) -> Array:
        """The same for A⁻¹ o + V."""
        return self._on_the_group("update_right", x, o, Y, np.reshape(N, -1))

    def update(self, x: Any, z: Any, H: Any, N: Any) -> Array:
        """The same for any observation h: z, (m,), is what is observed less h(g), H, (m, d), its
        derivative, h(g exp ξ) = h(g) + H ξ, on the right h(exp(ξ) g).  With fewer than m numbers
        the others of z and H are 0, and 1 on the diagonal of N."""
        flat = (np.reshape(y, -1) for y in (H, N))
        return self._on_the_group("update", x, z, *flat)

    def _on_the_group(self, what: str, *given: Any) -> Array:
        function = getattr(self._library, f"derive_{what}", None)
        known, d = self._names.group, self._names.algebra
        if known is None or function is None:
            raise ValueError("not compiled: ask for it by compile(..., exponential=True)")
        takes, writes = known.functions[what]
        out = np.zeros((d, d) if writes == "J" else known.count(what, writes))
        arrays = [as_array(x, known.count(what, a)) for a, x in zip(takes, given, strict=True)]
        function(*map(pointer, (*arrays, out)))
        return out

    # -- calls of C --------------------------------------------------------------------------------
    def _has(self, what: str) -> bool:
        return hasattr(self._library, f"{self._source.name}_{what}")

    def _inputs(self, u: Any) -> Array:
        return self._values.u if u is None else as_array(u, len(self.INPUTS))

    def _linear(self, columns: int | None = None) -> tuple[int, int]:
        """The shape of a matrix of the linearised equations."""
        rows = self._names.varied
        return rows, rows if columns is None else columns

    def _written(self, what: str, shape: tuple[int, ...], t: float, x: Any, *given: Array) -> Array:
        """What a C function of the time, a state, the constants and arrays writes to the last;
        ``ArithmeticError`` where Newton's method finds nothing."""
        out = np.zeros(shape)
        by_newton = what in ("velocity", "momentum_rhs") and self._has("velocity_step")
        result = ctypes.c_int if by_newton else None
        if self._call_at(what, result, t, x, self._in_use().k, *given, out):
            raise ArithmeticError("no velocity is found that has these momenta")
        return out

    def _made(self, what: str, x: Any, size: int, found: int = 0, *given: Array) -> Array:
        """What the C function ``what`` makes of so many numbers, as many or others."""
        function, array, out = (
            self._function(what, None),
            as_array(x, size),
            np.zeros(found or size),
        )
        function(*map(pointer, (array, *given, out)))
        return out

    def _change_frame(self, what: str, x: Any, size: int) -> Array:
        """A state or an input taken from one frame to another by the C function ``what``."""
        return self._made(what, x, size, size, self._in_use().k)

    def _call_at(self, what: str, result: Any, t: float, x: Any, *arrays: Array) -> Any:
        """The result of a C function of the time, the state and more arrays."""
        state, function = as_array(x, len(self.STATE)), self._function(what, result)
        return function(ctypes.c_double(t), *map(pointer, (state, *arrays)))

    def _function(self, what: str, result: Any) -> Any:
        """A C function of the library; ``ValueError`` says how to have it compiled."""
        function = getattr(self._library, f"{self._source.name}_{what}", None)
        if function is None:
            raise ValueError(self._reason(what))
        function.restype = result
        return function

    def _reason(self, what: str) -> str:
        """Why the library has not this function, and what to do."""
        name = self._source.name
        if what == "inverse" and self._has("bias"):
            return "an input is divided by: there are no rates without it to start from"
        if "outputs" in what and not self.OUTPUTS:
            return f"{name} has no [[output]] tables: nothing is read off it"
        if what == "from_matrix" and self._names.matrix_state:
            return "an angle counts turns, which a matrix does not tell: give x yourself"
        if what in ("project", "defect"):
            return f"nothing keeps the states of {name}: there is no {what}"
        kind = what.removeprefix("jacobian").removeprefix("_") or "state"
        asked = f"jacobian=[{kind!r}]"
        if what.endswith("_frame"):
            asked = "frame='principal'"
        elif what in ("mass_matrix", "inverse"):
            asked = "dynamics=True"
        elif what.startswith("jacobian_outputs"):
            asked = "jacobian=['outputs']"
        elif what.endswith("_matrix"):
            asked = "attitude='quaternion'"
        elif what in ("momentum", "velocity", "momentum_rhs", "poisson"):
            asked = "momenta=True"
        elif what in ADDED:
            asked = f"{what}=True"
        return f"not compiled: ask for it by compile(..., {asked})"


def as_array(values: Any, size: int) -> Array:
    """A new array of ``size`` numbers; ``ValueError`` for others."""
    made = np.array(values, dtype=float)
    if made.shape != (size,) and (size, made.shape) != (1, ()):
        found = f"an array {made.shape}" if made.ndim > 1 else f"{made.size}"
        raise ValueError(f"expected {size} numbers, not {found}")
    return made.reshape(size)


def binding(name: str, group: GroupFunctions) -> str:
    """C that is compiled beside the emitted one: the functions of its header, to be called."""
    lines = [f'#include "{name}_group.h"']
    for function, (takes, writes) in group.functions.items():
        given = ", ".join(f"const double *{x}" for x in takes)
        head = f"void derive_{function}({given}, double *{writes})"
        lines += [f"{head};", f"{head} {{ {name}_{function}({', '.join((*takes, writes))}); }}"]
    return "\n".join(lines) + "\n"
