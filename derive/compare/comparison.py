"""A user's code beside our equations: do they agree at random states, and if not, by what?"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import chain, product
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from ..code.naming import own_prefix
from ..code.program import Program
from ..language.limits import Refused
from ..motion.first_numbers import first_numbers
from ..problem.fields import known_in_lagrangian
from ..problem.problem import Problem
from .balance import Balance, Made
from .faults import Explanation, best, explained
from .opened import Opened, opened
from .own_coordinates import own_coordinates
from .pairs import of_two
from .products import rows_of, within_blocks
from .told import NEAR, Hypothesis, told
from .user_states import (
    ATTITUDES,
    RATES,
    Item,
    Table,
    beside,
    drawn,
    kind_of,
    ours,
    own_blocks,
    rates,
    read,
)
from .users_code import Array, Call, CompareError, values

AGREES = 1e-9
"""The largest difference, relative to the size of the numbers, of what agrees."""
STATES, MOST = 24, 10_000
"""At so many states, unless others are asked for; and the most."""
TRIES = 20
"""So often states are drawn anew in place of those at which our equations have no value."""
SHOWN = 6
"""So many changes are told at most."""


@dataclass
class Comparison:
    """What is compared: our Python, the user's table, both sides' states and rates."""

    problem: Problem
    program: Program
    code: ModuleType
    table: Table
    blocks: Mapping[str, tuple[str, ...]]
    parameters: Mapping[str, float]
    given: Mapping[str, Array]
    dx: Array

    @property
    def k(self) -> Array:
        """The constants of our code."""
        try:
            found: Array = self.code.constants([self.parameters[x] for x in self.code.PARAMETERS])
        except ValueError as error:
            given = ", ".join(f"{x} = {self.parameters[x]:.6g}" for x in self.table.parameters)
            raise CompareError(f"no body has these parameters ({given}): {error}") from None
        return found

    @property
    def u(self) -> Array:
        """Our inputs at each state."""
        places = [self.table.inputs.index(x) for x in self.program.inputs]
        found: Array = self.given["u"][:, places]
        return found

    def ours(self, table: Table) -> Callable[[Any], Any]:
        """What takes a state as a table means it to ours."""
        return lambda x: ours(table, x, self.program.state, self.blocks)

    def rates(self, x: Array) -> Array:
        """Our dx/dt at states of ours."""
        found: Array = self.code.rhs(self.given["t"], x, self.k, self.u)
        return found

    def differences(self, table: Table) -> tuple[Array, Array]:
        """Our dx/dt, and by how much the user's is another, in our numbers, as a table means it."""
        to, x = self.ours(table), self.given["x"]
        known = self.rates(to(x))
        return known, rates(to, x, self.dx) - known

    def in_the_users(self, difference: Array) -> Array:
        """A difference in our numbers as the smallest one in the user's, (N, size)."""
        items = self.table.items
        if not any(x.kind or x.coordinates for x in items):
            places = [self.program.state.index(x.name) for x in items]
            units: Array = np.array([x.unit for x in items])
            return np.asarray(difference[:, places] * units)
        to, x = self.ours(self.table), self.given["x"]
        each = np.eye(x.shape[1])
        D = np.stack([rates(to, x, np.broadcast_to(e, x.shape)) for e in each], axis=-1)
        found: Array = np.einsum("nij,nj->ni", np.linalg.pinv(D), difference)
        return found


def comparison(
    problem: Problem, make: Made, path: Path, function: str, as_: Path | None, seed: int, n: int
) -> Comparison:
    """The user's code called at n states; ``CompareError`` says why this cannot be."""
    program, code = make(problem, False)
    default = _default(problem, program, path, function)
    blocks = _blocks(problem, program, code)
    coordinates = {}
    if problem.group:
        velocity = program.state[_moving(problem, program)]
        coordinates = own_coordinates(problem.group.in_user_basis, program.state, velocity)
    table = read(as_, default, blocks, problem.parameters, coordinates, program.by_block)
    if function and len(table.calls) == 1:
        table = replace(table, calls=(replace(table.calls[0], name=function),))
    known = {name: x.default for name, x in problem.parameters.items()} | dict(table.parameters)
    needed = [*(x[0] for x in program.parameters), *problem.stored]
    if missing := [x for x in needed if known[x] is None]:
        raise CompareError(
            f"{problem.name}: no value for {', '.join(missing)}: give it in [parameters] of a "
            "table for --as"
        )
    parameters = {name: float(x) for name, x in known.items() if x is not None}
    made = Comparison(problem, program, code, table, blocks, parameters, {}, np.zeros(0))
    random = np.random.default_rng(seed)
    k, own = made.k, np.zeros((0, len(program.state)))
    for _ in range(TRIES):
        drawn_too = np.array([_state(made, random) for _ in range(n - len(own))])
        with np.errstate(all="ignore"):
            known = code.rhs(0.0, drawn_too, k, np.zeros(len(program.inputs)))
        # a state may be one that no motion has, as a volume below 0
        own = np.concatenate([own, drawn_too[np.isfinite(known).all(axis=1)]])
        if len(own) == n:
            break
    else:
        raise CompareError(f"{problem.name}: its equations have no value at states at random")
    arguments = {a for x in table.calls for a in x.arguments}
    sizes = (n, len(program.inputs))
    made.given = {
        "x": drawn(table, own, program.state, blocks, seed),
        "t": random.uniform(size=n) if "t" in arguments else np.zeros(n),
        "u": random.normal(size=sizes) if "u" in arguments else np.zeros(sizes),
        "k": np.broadcast_to(k, (n, len(k))),
        "p": np.broadcast_to(
            [parameters[x[0]] for x in program.parameters], (n, len(program.parameters))
        ),
    }
    made.dx = _rates_of(made, path)
    return made


def _state(c: Comparison, random: np.random.Generator) -> Array:
    """One of our states at random."""
    program = c.program
    exponent = random.normal(size=program.dimension if program.blocks else 0).tolist()
    # where a group moves matrices, exp says where they are
    kept = program.state[_moving(c.problem, program)] if program.blocks else program.state
    moving = dict(zip(kept, random.normal(size=len(kept)).tolist(), strict=True))
    moving |= {x[0]: c.parameters[x[0]] for x in program.parameters}
    moving |= {x: c.parameters[x] * random.uniform(0.5, 1.5) for x in c.problem.stored}
    return np.asarray(first_numbers(program, c.problem, moving, exponent).x)


def _moving(problem: Problem, program: Program) -> slice:
    """Where the velocity stands in our state, beside entries of g, what is advected and masses."""
    known = known_in_lagrangian(problem.own_group, problem.advected) if problem.group else {}
    others = {x for x, t in known.items() if isinstance(t, tuple) and t[1] in ("A", "Γ")}
    own = [k for k, x in enumerate(program.state) if x not in others and x not in problem.stored]
    return slice(own[0], own[-1] + 1)


def _default(problem: Problem, program: Program, path: Path, function: str) -> Table:
    """Our own state, and the signature of our own code."""
    in_c = path.suffix != ".py"
    name = function or (f"{own_prefix(problem.name)}_rhs" if in_c else "rhs")
    call = Call(name, ("t", "x", "k", "u", *(["dx"] if in_c else [])), not in_c)
    return Table((call,), tuple(Item(x) for x in program.state), program.inputs, {})


def _blocks(problem: Problem, program: Program, code: ModuleType) -> dict[str, tuple[str, ...]]:
    """The blocks of a state on SO(3) and SE(3), or of such factors of a product, whose velocity is
    in the body, in the usual basis; none of others."""
    group, found, first = problem.group, dict[str, tuple[str, ...]](), 0
    if group is None or problem.advected is not None:
        return found
    velocity = program.state[_moving(problem, program)]
    if len(velocity) < group.dimension:
        return found
    if problem.lagrangian and problem.lagrangian.trivialisation != "left":
        return found
    for k, (offset, factor) in enumerate(group.places, 1):
        own = slice(first, first + factor.dimension)
        first = own.stop
        if factor.name not in ("SO(3)", "SE(3)"):
            continue
        usual = np.zeros((factor.dimension, *code.BASIS.shape[1:]))
        for i in range(3):
            j, m = ((i + x) % 3 + offset for x in (1, 2))
            usual[i, m, j], usual[i, j, m] = 1, -1
            if factor.affine:
                usual[3 + i, offset + i, offset + 3] = 1
        if (usual == code.BASIS[own]).all():
            mark = str(k) if len(group.places) > 1 else ""
            found |= own_blocks(program.state, velocity[own], mark)
    return found


def _rates_of(c: Comparison, path: Path) -> Array:
    """The user's dx/dt; of M and bias, where M a + bias = 0, with our own rates of the place."""
    size, calls = c.table.size, c.table.calls
    if len(calls) == 1:
        return values(path, {calls[0]: size}, c.given)[0]
    moving = [place for item, place in c.table.places() if _is_rate(c, item)]
    places = np.concatenate([np.arange(x.start, x.stop) for x in moving])
    d = len(places)
    M, b = values(path, {calls[0]: d * d, calls[1]: d}, c.given)
    try:
        a = -np.linalg.solve(M.reshape(-1, d, d), b[:, :, None])[:, :, 0]
    except np.linalg.LinAlgError:
        raise CompareError(f"{path}: {calls[0].name} gives a matrix that is singular") from None
    dx = c.in_the_users(c.rates(c.ours(c.table)(c.given["x"])))
    dx[:, places] = a
    return dx


def _is_rate(c: Comparison, item: Item) -> bool:
    """Is an item of the state a velocity?"""
    return item.kind in RATES or item.name in c.program.state[_moving(c.problem, c.program)]


def reports(c: Comparison, make: Made) -> tuple[bool, Iterator[str]]:
    """Do both agree, and what is to be told, in lines, each as soon as it is known; a search that
    is stopped tells what it has before it ends."""
    known, difference = c.differences(c.table)
    off = c.in_the_users(difference)
    size = np.maximum(np.abs(c.dx).max(axis=0), np.abs(c.in_the_users(known)).max(axis=0))
    size = np.maximum(size, 1e-3 * size.max())
    worst = np.abs(off).max(axis=0) / size
    n = len(off)
    if (worst <= AGREES).all():
        return True, iter([f"agrees to {worst.max():.0e} at {n} states"])
    names = c.table.called()
    told_of = [f"{names[i]} ({worst[i]:.1g})" for i in np.flatnonzero(worst > AGREES)]
    first = f"differs at {n} states, relative to its size, in the rate of {', '.join(told_of)}"
    return False, chain([first], _causes(c, make, off, known, size))


def _causes(c: Comparison, make: Made, off: Array, known: Array, size: Array) -> Iterator[str]:
    """Why the rates differ, in lines: by ``off`` in the user's numbers, each of a ``size``, from
    our ``known`` ones."""
    if others := _other_conventions(c):
        yield from (f"  it agrees if {x}" for x in others)
        return
    yield from _of_places(c, off, known)
    for block in c.blocks:
        words, turning = _of_transport(c, off, block)
        if words:
            yield f"  {words}"
            c, off = replace(c, dx=c.dx - turning), off - turning
    worst = np.abs(off).max(axis=0) / size
    d = c.program.dimension
    if all(worst[place].max() <= AGREES for item, place in c.table.places() if _is_rate(c, item)):
        return
    found = _explained(c, make, off, d)
    link = "and" if found.together else "or"
    yield from (f"  {f'{link}: ' if i else ''}{x}" for i, x in enumerate(found.changes[:SHOWN]))
    if found.together and (more := len(found.changes) - SHOWN) > 0:
        yield f"  and: {more} more, without which these do not explain it"
    if not found.told_apart:
        yield "  these are not told apart by the numbers"
    if not found.changes:
        so_far = " so far" * bool(found.stopped)
        yield f"  no change of our equations that was tried{so_far} explains this"
        if found.nearest:
            yield f"  nearest{so_far}: {found.nearest}"
    if found.stopped:
        raise found.stopped


@np.errstate(all="ignore")
def _other_conventions(c: Comparison) -> list[str]:
    """The changes of one convention with which all agrees, in words."""
    found = []
    for words, table in c.table.others():
        known, difference = c.differences(table)
        on = np.abs(c.code.defect(c.ours(table)(c.given["x"]))) if hasattr(c.code, "defect") else 0
        size = np.abs(known).max(axis=0)
        size = np.maximum(size, 1e-3 * size.max())
        if np.max(on) < AGREES and (np.abs(difference) <= AGREES * size).all():
            found.append(words)
    return found


def _of_places(c: Comparison, off: Array, known: Array) -> list[str]:
    """What is wrong with the rates of places, not with the equations of motion, in lines."""
    lines, right = [], c.in_the_users(known)
    for item, place in c.table.places():
        if _is_rate(c, item) or np.abs(off[:, place]).max() <= AGREES * np.abs(right).max():
            continue
        square = float((right[:, place] ** 2).sum())
        factor = 1 + float((off[:, place] * right[:, place]).sum()) / square if square else 1.0
        rest = off[:, place] - (factor - 1) * right[:, place]
        if np.abs(rest).max() <= NEAR * np.abs(right).max():
            lines.append(f"  {told(f'the rate of {item}', 1.0, factor, {})[0]}")
            continue
        for words, table in c.table.others():
            to, x = c.ours(table), c.given["x"]
            # what this item says, by the same kinematics in other words
            taken = rates(to, x, c.dx) - c.rates(to(x))
            own = [c.program.state.index(y) for y in c.blocks.get(_block_of(item), ())]
            if own and np.abs(taken[:, own]).max() <= AGREES * np.abs(known).max():
                lines.append(f"  the rate of {item} is right if {words}")
                break
        else:
            of = "flow" if item.name in c.problem.stored else "velocity"
            lines.append(f"  the rate of {item} is not that of its {of}")
    return lines


def _of_transport(c: Comparison, off: Array, block: str) -> tuple[str, Array]:
    """A term ω × v in the rate of a velocity, as axes that turn have it, that is one too many or
    along other axes: in words, and what is too much; "" where there is none."""
    more, named = np.zeros_like(off), c.blocks[block]
    there = [(x, y) for x, y in c.table.places() if x.name == block or x.name in named]
    place = [i for _, y in there for i in range(y.start, y.stop)]
    if kind_of(block) != "velocity" or len(place) < 3:
        return "", more
    x, state = c.ours(c.table)(c.given["x"]), c.program.state
    sides = (c.blocks[beside(block, kind)] for kind in ("matrix", "omega", "velocity"))
    A, w, v = (x[:, [state.index(y) for y in names]] for names in sides)
    A = A.reshape(-1, 3, 3)
    turned = {"the body": (w, v), "space": tuple(np.einsum("nij,nj->ni", A, y) for y in (w, v))}
    in_space = there[0][0].said.get("frame") == "space"
    own = 0 * v if in_space else -np.cross(w, v)
    for of_w, of_v, sign in product(turned, turned, (-1, 1)):
        term = sign * np.cross(turned[of_w][0], turned[of_v][1])
        more[:, place] = (term - own) * [x.unit for x, y in there for _ in range(y.start, y.stop)]
        same = np.abs(off - more)[:, place].max() <= AGREES * np.abs(more[:, place]).max()
        if same and (in_space or not of_w == of_v == "the body"):
            axes = f"ω along the axes of {of_w} and v along those of {of_v}"
            called = f"{'−' * (sign < 0)}ω × v, {axes},"
            end = "too many: of a velocity along the axes of space there is none"
            if not in_space:
                end = "where −ω × v along the axes of the body is meant"
            return f"the rate of {block} has {called} {end}", more
    return "", 0 * more


def _block_of(item: Item) -> str:
    return beside(item.name, "matrix") if item.kind in ATTITUDES else item.name


@np.errstate(all="ignore")
def _explained(c: Comparison, make: Made, off: Array, d: int) -> Explanation:
    """What explains that the rates of the velocity differ, with our own rates of places."""
    own = np.array(c.dx)
    for item, place in c.table.places():
        if not _is_rate(c, item):
            own[:, place] -= off[:, place]
    to, x = c.ours(c.table), c.given["x"]
    moving = _moving(c.problem, c.program)
    a = rates(to, x, own)[:, moving]
    # what has a mass of the state in it is no number
    parameters = {name: x for name, x in c.parameters.items() if name not in c.problem.stored}
    whole = opened(c.problem, parameters)
    for part in (whole, Opened(whole.given, (), whole.given)):
        try:
            _, code = make(part.problem, True)
            break
        except Refused:
            continue
    else:
        return Explanation()
    if not hasattr(code, "bias"):
        return Explanation()
    E = np.asarray(code.BASIS)[:d]
    rows = rows_of(c.program.group, E, E.shape[1] - 1)
    b = Balance(code, part, make, parameters, c.given["t"], to(x), c.u, a, rows, moving)
    tried: list[Hypothesis] = []
    found = None
    try:
        terms = list(b.terms())
        found = explained(b, terms, tried, lambda: within_blocks(b))
        return found if found.changes and found.telling else of_two(b, terms) or found
    except BaseException as error:  # its time is over, or Ctrl-C
        if isinstance(error, Exception):
            raise
        return replace(found or best(b, tried), stopped=error)
