"""The functions of an emitted file on the torus against the record, at a random point of a prime
field.

The record's own sums over the lattice are evaluated there, for every point of the lattice.  C is
read, loops and all; Python, which must be what is emitted, word for word, is run with exact arrays.

The decimals of a file are residues: cosines, sines and what they are multiplied by.  A decimal that
is the double next to one of these irrational numbers stands for it; any other for itself.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Mapping, Sequence
from copy import copy
from dataclasses import replace
from fractions import Fraction
from functools import cached_property, reduce
from operator import mul
from pathlib import PurePath
from random import Random
from types import ModuleType
from typing import Any

import numpy as np

from ...algebra.structure import Place, TorusLattice
from ...check.fluid.torus_model import TorusModel, environment, torus_of
from ...check.values.arithmetic import EvaluationError, Varying, slopes_of
from ...check.values.evaluate import Environment, evaluate
from ...check.values.residue import Residue
from ...language import rational as q
from ...language.intervals import function, pi
from ...language.tree import Tree, nodes
from ...record.as_json import to_json
from ...record.record import Derivation
from ..compare import SIZE, Agreement
from ..read_file import LANGUAGES, Beside, unread_text, words
from ..straight_line import Measured
from ..syntax import SYNTAX, tokens
from ..terms import CodeError, DiffersError
from .loop_reader import LoopReader
from .loops_of_languages import CLoopReader, JuliaLoopReader
from .run_loops import Cells, ExactLibrary, LoopInterpreter

TABLE = 9
"""The largest N of which a file may have a table of the terms, with products as decimals."""


def cosine(turns: Fraction) -> Fraction:
    """cos 2π·turns, within 1e-50."""
    return function("cos", pi() * (2 * (turns % 1))).middle


class ExactNumbers:
    """The values of decimals at one point; ``rounded``: the texts that stood for another number.

    ``given``: the fractions that decimals may stand for.
    """

    def __init__(self, model: TorusModel, given: tuple[Fraction, ...] = ()):
        self.p, self.rounded = model.roots.p, set[str]()
        self.nearest: dict[float, int] = {}
        self.twofold: set[float] = set()
        for x in given:
            self._add(x, self.residue(x))
        waves = model.elementary.waves
        N, known = model.torus.N, pi().middle
        by_pi = self.residue(Fraction(1)) * pow(model.pi.n, -1, self.p)
        for k in range(N):
            self._add(cosine(Fraction(k, N)), int(waves["cos"][k]))
            self._add(cosine(Fraction(k, N) - Fraction(1, 4)), int(waves["sin"][k]))
        self._add(1 / (4 * known), by_pi * pow(4, -1, self.p))
        for weight in weights(model.torus) if N <= TABLE else ():
            for k in range(1, N):
                size = weight * Fraction(N, 2)
                sine = cosine(Fraction(k, N) - Fraction(1, 4))
                self._add(size * sine / known, self.residue(size) * int(waves["sin"][k]) * by_pi)

    def residue(self, x: Fraction) -> int:
        """Of a fraction."""
        return x.numerator * pow(x.denominator, -1, self.p) % self.p

    def _add(self, x: Fraction, value: int) -> None:
        """Let the double next to x, without sign, stand for a value."""
        size, value = abs(float(x)), (value if x > 0 else -value) % self.p
        if size < 2.0**-60:
            return
        if self.nearest.setdefault(size, value) != value:
            self.twofold.add(size)

    def __call__(self, text: str) -> int:
        """The value of a decimal without sign."""
        value = Fraction(text)
        size = float(value)
        if size not in self.nearest or size in self.twofold:
            return self.residue(value)
        found = self.nearest[size]
        if found != self.residue(value):
            self.rounded.add(text)
        return found


def weights(torus: TorusLattice) -> set[Fraction]:
    """1/|m|² − 1/|k|² for all m and k."""
    squares = {a * a + b * b for a, b in torus.places}
    return {Fraction(1, x) - Fraction(1, y) for x in squares for y in squares if x < y}


BOUND = 1e-30
"""A false pass must be less probable."""
POWERS = (2, 3, 4)
"""The k of Tr Wᵏ/N that ``conserved`` gives."""
DEGREE = 32
"""A bound on the degree, in what is drawn, of what the record says, and of what is emitted: four
numbers of the state are multiplied at most, over π.  The degree of C is measured."""


class TorusClaims:
    """What a record says at one point, the state ``x``, with the inputs ``u`` and the
    ``parameters`` by their names: ``rates``, ``energy``, ``traces``, and by ``slopes`` what the
    rates change by."""

    def __init__(self, d: Derivation, text: str, given: Iterable[Fraction] = ()):
        self.torus = torus_of(d.problem)
        drawn = hashlib.sha256((to_json(d) + text).encode("utf-8", "surrogatepass")).hexdigest()
        motion = d["motion"]
        self.model = TorusModel(
            self.torus, Random(drawn), SIZE, free=True, problem=d.problem, driven=motion.driven
        )
        self.motion: Tree = motion.equations[0].rhs
        self.p, env = self.model.roots.p, environment(self.model)
        self.number = ExactNumbers(self.model, tuple(given))
        self.x = self.parts(self.model.vorticity)
        numbers = self.parts(self.model.input) if self.model.input else []
        called = [f"{x['name']}_{y}" for x in d.problem["inputs"] for y in self.names]
        self.u = dict(zip(called, numbers, strict=True))
        read = {x[1] for x in nodes(self.motion) if isinstance(x, tuple) and x[0] == "par"}
        known = self.model.parameters.items()
        self.parameters = {x: self.residue(value) for x, value in known if x in read}
        self.rates = self.parts(self._at_places(self.motion, env))
        self.energy = self.residue(evaluate(d["energy"].equations[0].rhs, env))
        powers = (reduce(q.times, [self.model.W] * k) for k in POWERS)
        self.traces = [self.residue(q.trace(x) * Fraction(1, self.torus.N)) for x in powers]

    def _at_places(self, t: Tree, env: Environment) -> dict[Place, Any]:
        """What a tree is at all points."""
        places = enumerate(self.torus.places, 1)
        return {n: evaluate(t, env.with_index("𝐧", i)) for i, n in places}

    @cached_property
    def slopes(self) -> dict[str, tuple[list[int], list[int]]]:
        """By a Jacobian a random change of what it is by, and what the rates change by: another
        matrix takes the one to the other with probability 1/p."""
        model, env, here = self.model, environment(self.model), copy(self.model)
        grid, N = model.coefficients(model.rate), self.torus.N
        moved = {(a, b): grid[a % N][b % N] for a, b in self.torus.places}
        pushed = {n: model.draw() for n in self.torus.places}
        if model.input:
            here.input = {n: Varying(x, [pushed[n]]) for n, x in model.input.items()}
        turned = {x: model.draw() for x in self.parameters}
        known = {x: Varying(y, [turned.get(x, 0)]) for x, y in model.parameters.items()}
        zero = model.roots.i * 0
        by_inputs, by_parameters = (
            {n: zero + slopes_of(x, 1)[0] for n, x in self._at_places(self.motion, there).items()}
            for there in (environment(here), replace(environment(model), parameters=known))
        )
        by_state = self._at_places(("call", "d/dt", self.motion), env)
        return {
            "jacobian": (self.parts(moved), self.parts(by_state)),
            "jacobian_inputs": (self.parts(pushed), self.parts(by_inputs)),
            "jacobian_parameters": (
                [*map(self.residue, turned.values())],
                self.parts(by_parameters),
            ),
        }

    def residue(self, x: Any) -> int:
        """A number as an integer modulo p."""
        return int((x - self.model.roots.i * 0).n)

    def parts(self, a: Mapping[Place, Any]) -> list[int]:
        """Re and Im of a(n), of which that of −n is the conjugate, for one of n and −n."""
        found = []
        for n in self.torus.half_plane:
            here, there = a[n], a[-n[0], -n[1]]
            found += [(here + there) / 2, (here - there) / (2 * self.model.roots.i)]
        return [self.residue(x) for x in found]

    def elementary(self, name: str, x: int) -> int:
        """A function at a residue: sin and cos of angles of the torus, and arctan 1."""
        if name == "atan" and x == 1:
            return self.residue(self.model.pi / 4)
        try:
            return self.residue(self.model.elementary(name, Residue(x, self.p)))
        except EvaluationError as error:
            raise CodeError(str(error)) from None

    @property
    def names(self) -> tuple[str, ...]:
        """Those of the state."""
        return self.torus.coefficients


JACOBIANS = ("jacobian", "jacobian_inputs", "jacobian_parameters")
Call = Callable[[str, Sequence[int]], Sequence[int]]
"""The numbers that a function of a file gives at a state."""


def agreement(claims: TorusClaims, call: Call, has: Callable[[str], bool]) -> Agreement:
    """The verdict on functions that equal the record; ``DiffersError`` where one does not."""
    wanted = {"rhs": claims.rates, "energy": [claims.energy], "conserved": claims.traces}
    names = {
        "rhs": [f"the rate of {x}" for x in claims.names],
        "energy": ["the energy"],
        "conserved": [f"trace_{k}" for k in POWERS],
    }
    functions = [x for x in wanted if x != "conserved" or has(x)]
    linearised = [x for x in JACOBIANS if has(x)]
    for f in (*functions, *linearised):
        found = call(f, claims.x)
        if f in linearised:
            _require_matrix(f, found, claims)
            continue
        if len(found) != len(wanted[f]):
            raise DiffersError(f"{f}: {len(found)} numbers, the record has {len(wanted[f])}")
        for name, x, y in zip(names[f], found, wanted[f], strict=True):
            if x != y:
                raise DiffersError(f"{f}: {name} differs from the record's")
    rounded = tuple(sorted(claims.number.rounded))
    return Agreement(("constants", *functions, *linearised), 1, 2 * DEGREE / SIZE, rounded, ())


def _require_matrix(f: str, found: Sequence[int], claims: TorusClaims) -> None:
    """``DiffersError`` for a Jacobian that is not the record's; the rates stand before that of the
    state."""
    v, wanted = claims.slopes[f]
    rates = list(found[: len(wanted)]) if f == "jacobian" else []
    D = found[len(rates) :]
    if len(D) != len(wanted) * len(v) or (rates and rates != claims.rates):
        raise DiffersError(f"{f}: its rates, or its size, differ from the record's")
    for i, (name, y) in enumerate(zip(claims.names, wanted, strict=True)):
        row = D[i * len(v) : (i + 1) * len(v)]
        if (sum(map(mul, row, v)) - y) % claims.p:
            raise DiffersError(f"{f}: the derivatives of the rate of {name} differ")


# -- loops, read -------------------------------------------------------------------------------


def loops_of(name: str, files: Mapping[str, str], prefix: str) -> LoopReader:
    """The reader of a file with loops."""
    language = LANGUAGES[PurePath(name).suffix]
    if language == "c":
        return CLoopReader(language, words(name, files, prefix), prefix)
    reader = JuliaLoopReader if language == "julia" else LoopReader
    return reader(language, tokens(SYNTAX[language], files[name], name), prefix)


def unread_parts(name: str, files: Mapping[str, str], prefix: str) -> Beside:
    """What of a file is not read."""
    reader = loops_of(name, files, prefix)
    reader.module()
    return unread_text(reader, files[name])


def compare_loops(
    name: str, files: Mapping[str, str], prefix: str, claims: TorusClaims
) -> Agreement:
    """The verdict on a file, read with its loops."""
    text = loops_of(name, files, prefix)
    module = text.module()
    reader = LoopInterpreter(text, claims.p, claims.number, claims.elementary)
    dimension = len(claims.names)
    _require_lists([module.state, module.parameters, module.inputs], module.sizes, claims)
    size = max(module.sizes["CONSTANTS"], 0)
    k = Cells([size])
    if reader.call("constants", measured([*claims.parameters.values()]), k):
        raise DiffersError("constants: it refuses numbers that it has no reason to")
    reader.written(k, size, "k")
    t = Measured(Random(claims.p).randrange(claims.p), 1)

    p, u = measured([*claims.parameters.values()]), measured([*claims.u.values()])

    def call(f: str, x: Sequence[int]) -> Sequence[int]:
        given, acting = measured(x), [u] * (f != "conserved")
        if f == "energy":
            return reader.numbers([reader.call(f, t, given, k)])
        columns = len(claims.slopes[f][0]) if f in JACOBIANS else 0
        out = [Cells([len(POWERS) if f == "conserved" else dimension])]
        if columns:
            out = [*out * (f == "jacobian"), Cells([dimension * columns])]
        reader.call(f, t, given, p if f == "jacobian_parameters" else k, *acting, *out)
        *before, found = (reader.written(y, y.size, f) for y in out)
        if columns and text.by_columns:
            found = [found[i + dimension * j] for i in range(dimension) for j in range(columns)]
        return [y for x in (*before, found) for y in x]

    found = agreement(claims, call, lambda f: f in module.functions)
    if "rhs_batch" in module.functions:
        _compare_batch(reader, claims, t, k)
        found = replace(found, functions=(*found.functions, "rhs_batch"))
    if (bound := (DEGREE + reader.largest) / SIZE) > BOUND:
        raise CodeError("its degree is too large for a proof")
    return replace(found, bound=bound)


def measured(x: Sequence[int]) -> Cells:
    """Numbers that are drawn, by their places."""
    found = Cells([len(x)])
    found.update((i, Measured(y, 1)) for i, y in enumerate(x))
    return found


def _compare_batch(reader: LoopInterpreter, claims: TorusClaims, t: Any, k: Cells) -> None:
    """``rhs_batch`` on some states beside ``rhs``: an index is made of n and s by sums and products
    alone, so that three counts tell two apart.

    Where it calls ``rhs``, a random function stands there in its place, which takes less time.
    """
    p, random, size = claims.p, Random(claims.p), len(claims.x)
    weights = [random.randrange(p) for _ in claims.x]
    few = len(claims.u)

    def stand_in(t: Any, x: Any, k: Any, u: Any, dx: Any) -> None:
        for i, w in enumerate(weights):
            dx[i] = (w * x[i] * x[i] + t + (w * u[i % few] if few else 0)) % p

    def drawn(count: int, numbers: int) -> list[list[int]]:
        return [[random.randrange(p) for _ in range(numbers)] for _ in range(count)]

    def side_by_side(rows: list[list[int]]) -> Cells:
        return measured([x for row in zip(*rows, strict=True) for x in row])

    with reader.replaced("rhs", "rhs_batch", stand_in):
        for count in (1, 2, 3):
            states, inputs = drawn(count, size), drawn(count, few)
            out = Cells([count * size])
            both = side_by_side(states), k, side_by_side(inputs), out
            reader.call("rhs_batch", count, t, *both)
            rates = reader.written(out, count * size, "rhs_batch")
            for s, (x, u) in enumerate(zip(states, inputs, strict=True)):
                one = Cells([size])
                reader.call("rhs", t, measured(x), k, measured(u), one)
                if rates[s::count] != reader.written(one, size, "rhs"):
                    raise DiffersError("rhs_batch: a state of several has other rates than alone")


# -- Python --------------------------------------------------------------------------------------


def compare_python(text: str, claims: TorusClaims) -> Agreement:
    """The verdict on Python, run: the caller has seen that the text is what is emitted."""
    module = ModuleType("emitted")
    exec(compile(text, "<emitted Python>", "exec"), module.__dict__)
    return agreement_of_module(module, claims)


def agreement_of_module(module: Any, claims: TorusClaims) -> Agreement:
    """The verdict on a module that has been run; plain numbers go to the exact functions, too."""
    module._Functions = lambda library: library
    library = ExactLibrary(claims.p, claims.number, claims.elementary)

    _require_lists([module.STATE, module.PARAMETERS, module.INPUTS], {}, claims)
    u, p = (library.asarray([*x.values()], object) for x in (claims.u, claims.parameters))
    try:
        k = module.constants(p)

        def call(f: str, x: Sequence[int]) -> Sequence[int]:
            given = (library.asarray(y, object) for y in (x, [x[::-1], x]))
            acting = [u] if f not in ("energy", "conserved") and claims.u else []
            by = p if f == "jacobian_parameters" else k
            found, several = (
                library.asarray(_in_a_row(getattr(module, f)(0.0, y, by, *acting), y.shape[:-1]))
                for y in given
            )
            parts = [(z.re, z.im) for z in found.ravel()]
            if any(im for _, im in parts):
                raise DiffersError(f"{f}: it is not real")
            again = library.asarray(several[1])
            if found.shape != again.shape or parts != [(z.re, z.im) for z in again.ravel()]:
                raise DiffersError(f"{f}: a state of several gives other numbers than alone")
            return [re for re, _ in parts]

        return agreement(claims, call, lambda f: hasattr(module, f))
    except (TypeError, ValueError, IndexError, AttributeError) as error:
        if isinstance(error, CodeError):
            raise
        raise CodeError(f"it does not run with exact arrays: {error}") from None


def _in_a_row(found: Any, batch: tuple[int, ...]) -> Any:
    """The numbers of an array, or of several, for each state of a batch."""
    parts = found if isinstance(found, tuple) else (found,)
    return np.concatenate([np.reshape(x, (*batch, -1)) for x in parts], axis=-1)


def _require_lists(
    found: Sequence[Sequence[str] | None], sizes: Mapping[str, int], claims: TorusClaims
) -> None:
    """``DiffersError`` where the names of the state, the parameters, the inputs, or the sizes are
    others."""
    known = {
        "state": claims.names,
        "parameters": tuple(claims.parameters),
        "inputs": tuple(claims.u),
    }
    for (what, names), listed in zip(known.items(), found, strict=True):
        if listed is not None and tuple(listed) != names:
            raise DiffersError(f"the names of the {what} are not those of the record")
    wanted = {what.upper(): len(names) for what, names in known.items()}
    wanted |= {"ALGEBRA": len(claims.names)}
    for what, size in wanted.items():
        if sizes.get(what, size) != size:
            raise DiffersError(f"the size {what} is {sizes[what]}, not {size}")
