"""The conventions of a user's state: a list of names and blocks, and what takes it to our own.

All that is computed here is analytic in the state, so that a rate goes along in the imaginary
part: ``rates(f, x, dx)`` is Df(x) dx to rounding.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import product
from pathlib import Path
from string import digits
from typing import Any

import numpy as np

from ..language.reserved import did_you_mean, near_name
from .own_coordinates import Coordinates
from .users_code import Array, Call, CompareError

SEQUENCES = tuple(
    word
    for case in ("XYZ", "xyz")
    for word in map("".join, product(case, repeat=3))
    if word[0] != word[1] != word[2]
)
"""Angles about axes: of the body, in capitals, each as the one before has left it; or of space."""
SENSES = ("body to space", "space to body")
WORDS: dict[str, dict[str, tuple[str, ...]]] = {
    "position": {},
    "quaternion": {"order": ("wxyz", "xyzw"), "sense": SENSES},
    "euler": {"sequence": SEQUENCES, "sense": SENSES},
    "matrix": {"order": ("row", "column"), "sense": SENSES},
    "omega": {"frame": ("body", "space")},
    "velocity": {"frame": ("body", "space")},
}
"""A block of a state → what may be said of it; the first is meant where nothing is."""
"""Those of a product have the number of the factor at their end, as ``omega2``."""
SIZES = {"quaternion": 4, "matrix": 9}
UNITS = {"degrees": math.degrees(1), "turns": 1 / math.tau, "a minute": 60.0}
UNITS |= {"milli": 1000.0, "kilo": 0.001}
"""A unit in words → how many of it one of ours is."""
RATES = ("omega", "velocity")
ATTITUDES = ("quaternion", "euler", "matrix")
AXES = {"X": 0, "Y": 1, "Z": 2}
TINY = 1e-200
"""The size of an imaginary part of which no square is left."""


def kind_of(name: str) -> str:
    """Of WORDS what a block of a state is, "" for a name that is none."""
    found = name.rstrip(digits)
    return found if found in WORDS else ""


def beside(name: str, kind: str) -> str:
    """The block of a ``kind`` of the same factor."""
    return kind + name.removeprefix(kind_of(name))


@dataclass(frozen=True)
class Item:
    """A name or a block of a state, ``said`` by one of each of WORDS; a number of the user's is
    ours times ``unit``; of one of several ``coordinates``, all; ``called``: as the user has it."""

    name: str
    said: Mapping[str, str] = field(default_factory=dict)
    unit: float = 1.0
    coordinates: Coordinates | None = None
    called: str = ""

    def __str__(self) -> str:
        return self.called or self.name

    @property
    def size(self) -> int:
        """How many numbers it has."""
        return SIZES.get(self.kind, 3) if self.kind else 1

    @property
    def kind(self) -> str:
        """Of WORDS what it is, "" for a number."""
        return kind_of(self.name)

    def others(self) -> Iterator[tuple[str, Item]]:
        """The same by other words, one of them changed, or in another unit: in words."""
        for key, choices in WORDS.get(self.kind, {}).items():
            for x in choices:
                if x != self.said[key]:
                    yield f"{key} {x!r}", replace(self, said={**self.said, key: x})
        for words, unit in UNITS.items() if self.kind not in SIZES else ():
            yield f"the unit {unit:.17g}, {words}", replace(self, unit=unit * self.unit)


@dataclass(frozen=True)
class Table:
    """What a user's code means: its calls, the items of its state, the order of its inputs, the
    values of parameters that are not those of the problem."""

    calls: tuple[Call, ...]
    items: tuple[Item, ...]
    inputs: tuple[str, ...]
    parameters: Mapping[str, float]

    @property
    def size(self) -> int:
        """How many numbers the state has."""
        return sum(x.size for x in self.items)

    def places(self) -> Iterator[tuple[Item, slice]]:
        """Each item with where it is in the state."""
        first = 0
        for x in self.items:
            yield x, slice(first, first + x.size)
            first += x.size

    def called(self) -> list[str]:
        """The numbers of the state in words."""
        return [
            str(x) if x.size == 1 else f"{x} {i + 1}" for x in self.items for i in range(x.size)
        ]

    def others(self) -> Iterator[tuple[str, Table]]:
        """The same with one convention changed, in words."""
        for i, item in enumerate(self.items):
            for words, other in item.others():
                items = (*self.items[:i], other, *self.items[i + 1 :])
                yield f"{item} has {words}", replace(self, items=items)
        every = self._turning()
        apart = [x for x in every.values() if len(x) > 1]
        whole = [x for own in every.values() for x in own]
        for turning, word in product([*apart, *[whole] * (len(every) > 1)], ("degrees", "turns")):
            unit = UNITS[word]
            items = tuple(replace(x, unit=unit * x.unit) if x in turning else x for x in self.items)
            listed = " and ".join(map(str, turning))
            yield f"{listed} have the unit {unit:.17g}, {word}", replace(self, items=items)

    def _turning(self) -> dict[str, list[Item]]:
        """Angles and their rates, by what they turn."""
        found: dict[str, list[Item]] = {}
        for x in self.items:
            if x.kind in ("euler", "omega"):
                found.setdefault(beside(x.name, "matrix"), []).append(x)
            elif (own := x.coordinates) and own.block.turn:
                rates = (y for y in self.items if y.name in own.rates)
                found[x.name] = [x, *rates]
        return found


def own_blocks(
    state: Sequence[str], velocity: Sequence[str], mark: str = ""
) -> dict[str, tuple[str, ...]]:
    """The blocks of our own state on SO(3) or SE(3), or of such a factor by its ``mark`` → their
    names; ``velocity``: those of ζ, w."""
    A = tuple(x for x in state if x.startswith(f"A{mark}_"))
    T = tuple(x for x in state if x.startswith(f"T{mark}_"))
    kinds = {"matrix": A, "position": T}
    kinds |= {"omega": tuple(velocity[:3]), "velocity": tuple(velocity[3:])}
    return {f"{kind}{mark}": x for kind, x in kinds.items() if x}


def read(
    path: Path | None,
    default: Table,
    blocks: Mapping[str, tuple[str, ...]],
    parameters: Any,
    coordinates: Mapping[str, Coordinates],
    by_block: Mapping[str, str],
) -> Table:
    """The table of a TOML file, or what is meant without one; names that follow one another as in
    a block of our own are that block.  ``coordinates`` stand for entries, names ``by_block`` for
    those of the state.  ``CompareError`` says which key is wrong."""
    state = tuple(x.name for x in default.items)
    default = replace(default, items=_in_blocks(default.items, blocks))
    if path is None:
        return default
    try:
        told = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise CompareError(f"{path}: {error.strerror}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise CompareError(f"{path}: {error}") from None
    words = _words(blocks)
    known = ("call", "state", "inputs", "units", "parameters", *(words or WORDS))
    _require_known(told, known, str(path))
    listed = _texts(told.get("state", [x.name for x in default.items]), f"{path}: state")
    named = (*coordinates, *state, *by_block)
    if not blocks and any(map(kind_of, listed)):
        told_of = "blocks are of SO(3) and SE(3); give names"
        raise CompareError(f"{path}: state: {told_of}: {', '.join(named)}")
    _require_known(listed, (*named, *words), f"{path}: state")
    _require_known([*filter(kind_of, told)], listed, f"{path}: tables of the state")
    units = _numbers(told.get("units", {}), f"{path}: units")
    _require_known(units, [x for x in listed if kind_of(x) not in SIZES], f"{path}: units")
    if not all(units.values()):
        raise CompareError(f"{path}: units: a unit is not 0")
    items = []
    for name in listed:
        said = _said(told.get(name, {}), name, f"{path}: [{name}]") if name in words else {}
        own = by_block.get(name, name)
        items.append(Item(own, said, units.get(name, 1.0), coordinates.get(name), name))
    inputs = _texts(told.get("inputs", [*default.inputs]), f"{path}: inputs")
    if sorted(inputs) != sorted(default.inputs):
        raise CompareError(f"{path}: inputs: expected {', '.join(default.inputs)} in an order")
    values = _numbers(told.get("parameters", {}), f"{path}: parameters")
    _require_known(values, [*parameters], f"{path}: parameters")
    calls = told.get("call")
    listed_calls = [calls] if isinstance(calls, str) else _texts(calls or [], f"{path}: call")
    if len(listed_calls) > 2:
        raise CompareError(f"{path}: call: expected one function, or M(x) and bias(x)")
    found = Table(
        tuple(map(Call.read, listed_calls)) or default.calls,
        _in_blocks(tuple(items), blocks),
        tuple(inputs),
        values,
    )
    _require_whole(found, state, blocks, str(path))
    return found


def _words(blocks: Mapping[str, tuple[str, ...]]) -> list[str]:
    """The blocks by which a state may be said where our own are these."""
    attitudes = ("quaternion", "euler")
    turned = [beside(x, kind) for x in blocks if kind_of(x) == "matrix" for kind in attitudes]
    return [*turned, *blocks]


def _said(table: Any, name: str, where: str) -> dict[str, str]:
    """What a table says of a block, and what is meant where it says nothing."""
    if not isinstance(table, dict):
        raise CompareError(f"{where}: expected a table")
    known = WORDS[kind_of(name)]
    _require_known(table, known, where)
    words = {key: table.get(key, x[0]) for key, x in known.items()}
    for key, word in words.items():
        _require_known([word], known[key], f"{where}: {key}")
    return words


def _in_blocks(items: tuple[Item, ...], blocks: Mapping[str, tuple[str, ...]]) -> tuple[Item, ...]:
    """Names of a block that stand together, in order and in one unit, are the block."""
    found: list[Item] = []
    while items:
        for name, own in blocks.items():
            first = items[: len(own)]
            if tuple(x.name for x in first) == own and len({x.unit for x in first}) == 1:
                said = {key: words[0] for key, words in WORDS[kind_of(name)].items()}
                found.append(Item(name, said, first[0].unit))
                items = items[len(own) :]
                break
        else:
            found.append(items[0])
            items = items[1:]
    return tuple(found)


def _require_whole(
    table: Table, state: Sequence[str], blocks: Mapping[str, tuple[str, ...]], where: str
) -> None:
    """``CompareError`` where the items do not say every number of our state once."""
    turned = {x: blocks.get(x) or blocks[beside(x, "matrix")] for x in _words(blocks)}
    used = {x.coordinates.names: x.coordinates for x in table.items if x.coordinates}
    given = [y for x in table.items for y in turned.get(x.name, (x.name,))]
    given += [y for x in used.values() for y in x.covered]
    for name in (*state, *(y for names in used for y in names)):
        if given.count(name) != 1:
            how = "says twice" if name in given else "does not say"
            raise CompareError(f"{where}: the state {how} {name}")


def _require_known(given: Any, known: Any, where: str) -> None:
    for name in given:
        if name not in known:
            near = did_you_mean(near_name(str(name), known), after=" ")
            raise CompareError(
                f"{where}: {str(name)[:40]!r} means nothing here; {near}known: {', '.join(known)}"
            )


def _texts(given: Any, where: str) -> list[str]:
    if not isinstance(given, list) or not all(isinstance(x, str) for x in given):
        raise CompareError(f"{where}: expected a list of texts")
    return given


def _numbers(given: Any, where: str) -> dict[str, float]:
    good = isinstance(given, dict) and all(type(x) in (int, float) for x in given.values())
    if not good:
        raise CompareError(f"{where}: expected a table of numbers")
    return {name: float(x) for name, x in given.items()}


# From the user's numbers to ours, and rates along.


def ours(table: Table, x: Any, state: Sequence[str], blocks: Mapping[str, Any]) -> Any:
    """Our states (N, len(state)) of a user's (N, size), which may be complex."""
    given = {item.name: x[:, place] / item.unit for item, place in table.places()}
    found: dict[str, Any] = {}
    for item in table.items:
        name, kind, numbers = item.name, item.kind, given[item.name]
        if item.coordinates:
            if name == item.coordinates.names[0]:
                own = [given[y][:, 0] for y in item.coordinates.names]
                found |= item.coordinates.at(np.stack(own, axis=-1))
        elif not kind:
            found[name] = numbers[:, 0]
        elif kind in ATTITUDES:
            A = ROTATIONS[kind](numbers, item.said)
            A = A if item.said["sense"] == SENSES[0] else np.swapaxes(A, 1, 2)
            found |= _named(blocks[beside(name, "matrix")], A.reshape(-1, 9))
        elif kind == "position":
            found |= _named(blocks[name], numbers)
    for item in table.items:
        if item.kind in RATES:
            vector = given[item.name]
            if item.said["frame"] == "space":
                entries = blocks[beside(item.name, "matrix")]
                A = np.stack([found[y] for y in entries], axis=-1).reshape(-1, 3, 3)
                vector = np.einsum("nji,nj->ni", A, vector)
            found |= _named(blocks[item.name], vector)
    return np.stack([found[name] for name in state], axis=-1)


def _named(names: Sequence[str], columns: Any) -> dict[str, Any]:
    return {name: columns[:, i] for i, name in enumerate(names)}


def _of_quaternion(q: Any, said: Mapping[str, str]) -> Any:
    """The rotation of a quaternion of any length."""
    w, x, y, z = np.moveaxis(q if said["order"] == "wxyz" else np.roll(q, 1, axis=1), 1, 0)
    rows = [
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]
    return np.moveaxis(np.array(rows), 2, 0) / (w * w + x * x + y * y + z * z)[:, None, None]


def _of_angles(angles: Any, said: Mapping[str, str]) -> Any:
    sequence = said["sequence"]
    turns = [_about(AXES[axis.upper()], angles[:, i]) for i, axis in enumerate(sequence)]
    first, second, third = turns if sequence.isupper() else turns[::-1]
    return first @ second @ third


def _about(axis: int, angle: Any) -> Any:
    """The rotations about an axis."""
    j, k = (axis + 1) % 3, (axis + 2) % 3
    R = np.zeros((len(angle), 3, 3), dtype=angle.dtype)
    R[:, axis, axis] = 1
    R[:, j, j] = R[:, k, k] = np.cos(angle)
    R[:, k, j] = np.sin(angle)
    R[:, j, k] = -np.sin(angle)
    return R


def _of_matrix(entries: Any, said: Mapping[str, str]) -> Any:
    A = entries.reshape(-1, 3, 3)
    return A if said["order"] == "row" else np.swapaxes(A, 1, 2)


ROTATIONS: dict[str, Callable[[Any, Mapping[str, str]], Any]] = {
    "quaternion": _of_quaternion,
    "euler": _of_angles,
    "matrix": _of_matrix,
}


def rates(f: Callable[[Any], Any], x: Array, dx: Array) -> Array:
    """Df(x) dx of an analytic function, to rounding."""
    found: Array = np.imag(f(x + 1j * TINY * dx)) / TINY
    return found


def drawn(
    table: Table, own: Array, state: Sequence[str], blocks: Mapping[str, Any], seed: int
) -> Array:
    """A user's states at random, from ``own`` ones of ours, (N, len(state)), on the group; what
    charts have singular points for stays away from them."""
    random = np.random.default_rng(seed)
    columns = _named(state, own)
    parts = []
    for item in table.items:
        n = len(own)
        if item.kind == "quaternion":
            part = random.normal(size=(n, 4))
            part /= np.linalg.norm(part, axis=1)[:, None]
        elif item.kind == "euler":
            part = random.uniform(0.2, 1.2, size=(n, 3))
        elif item.kind == "matrix":
            part = np.stack([columns[x] for x in blocks[item.name]], axis=-1)
        elif item.kind or item.coordinates:
            part = random.normal(size=(n, item.size))
        else:
            part = columns[item.name][:, None]
        scaled = item.unit if item.kind not in ("quaternion", "matrix") else 1.0
        parts.append(part * scaled)
    return np.concatenate(parts, axis=1)
