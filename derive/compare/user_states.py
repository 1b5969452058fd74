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
from typing import Any

import numpy as np

from ..algebra.factor_charts import factor_charts
from ..algebra.groups import Group
from ..language.reserved import did_you_mean, near_name
from ..problem.fields import is_entry, state_names
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
SIZES = {"quaternion": 4, "matrix": 9}
UNITS = {"degrees": math.degrees(1), "turns": 1 / math.tau, "a minute": 60.0}
UNITS |= {"milli": 1000.0, "kilo": 0.001}
"""A unit in words → how many of it one of ours is."""
RATES = ("omega", "velocity")
AXES = {"X": 0, "Y": 1, "Z": 2}
TINY = 1e-200
"""The size of an imaginary part of which no square is left."""


@dataclass(frozen=True)
class Angle:
    """The entries ``names`` of a factor that one angle x turns: Σ ``parts`` · (1, x, cos wx,
    sin wx), the parts (4, names)."""

    names: tuple[str, ...]
    parts: Array
    w: float

    def entries(self, x: Any) -> dict[str, Any]:
        """The entries at angles (N,), which may be complex."""
        numbers = np.stack([np.ones_like(x), x, np.cos(self.w * x), np.sin(self.w * x)], axis=-1)
        return _named(self.names, numbers @ self.parts)


def own_angles(group: Group, state: Sequence[str]) -> dict[str, Angle]:
    """The angles of a group by their names in the code of ``--attitude angle``, of those factors
    that one angle tells, beside T."""
    entries = {x: t for x, t in state_names(group).items() if x in state and isinstance(t, tuple)}
    places = {(t[2] - 1, t[3] - 1): x for x, t in entries.items() if is_entry(t)}
    found = {}
    for chart in factor_charts(group, "angle").values():
        rows = range(chart.offset, chart.offset + chart.size)
        block = chart.blocks[0]
        if not block.turn or block.rows != tuple(rows):
            continue
        inside = [(i, j) for i in rows for j in rows if (i, j) in places]
        parts = [
            [float(P[i - rows[0]][j - rows[0]]) for i, j in inside] for P in block.parts_of_turn
        ]
        own = tuple(places[x] for x in inside)
        found[block.names[0]] = Angle(own, np.array(parts), float(block.turn))
    return found


@dataclass(frozen=True)
class Item:
    """A name or a block of a state, ``said`` by one of each of WORDS; a number of the user's is
    ours times ``unit``; of an ``angle``, what it turns; ``called``: as the user has it."""

    name: str
    said: Mapping[str, str] = field(default_factory=dict)
    unit: float = 1.0
    angle: Angle | None = None
    called: str = ""

    def __str__(self) -> str:
        return self.called or self.name

    @property
    def size(self) -> int:
        """How many numbers it has."""
        return SIZES.get(self.name, 3) if self.name in WORDS else 1

    def others(self) -> Iterator[tuple[str, Item]]:
        """The same by other words, one of them changed, or in another unit: in words."""
        for key, choices in WORDS.get(self.name, {}).items():
            for x in choices:
                if x != self.said[key]:
                    yield f"{key} {x!r}", replace(self, said={**self.said, key: x})
        for words, unit in UNITS.items() if self.name not in SIZES else ():
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
        turning = [x for x in self.items if x.name in ("euler", "omega")]
        for x in self.items:
            if x.angle:
                rate = x.name.replace("theta", "zeta")
                turning += [x, *(y for y in self.items if y.name == rate)]
        for word in ("degrees", "turns") if len(turning) > 1 else ():
            unit = UNITS[word]
            items = tuple(replace(x, unit=unit * x.unit) if x in turning else x for x in self.items)
            listed = " and ".join(map(str, turning))
            yield f"{listed} have the unit {unit:.17g}, {word}", replace(self, items=items)


def own_blocks(state: Sequence[str], rates: Sequence[str]) -> dict[str, tuple[str, ...]]:
    """The blocks of our own state on SO(3) or SE(3) → their names; ``rates``: those of ζ, w."""
    A = tuple(x for x in state if x.startswith("A_"))
    T = tuple(x for x in state if x.startswith("T_"))
    found = {"matrix": A, "position": T, "omega": tuple(rates[:3]), "velocity": tuple(rates[3:])}
    return {name: x for name, x in found.items() if x}


def read(
    path: Path | None,
    default: Table,
    blocks: Mapping[str, tuple[str, ...]],
    parameters: Any,
    angles: Mapping[str, Angle],
    by_block: Mapping[str, str],
) -> Table:
    """The table of a TOML file, or what is meant without one; names that follow one another as in a
    block of our own are that block.  ``angles`` stand for entries, names ``by_block`` for those of
    the state.  ``CompareError`` says which key is wrong."""
    if path is None:
        return replace(default, items=_in_blocks(default.items, blocks))
    try:
        told = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise CompareError(f"{path}: {error.strerror}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise CompareError(f"{path}: {error}") from None
    known = ("call", "state", "inputs", "units", "parameters", *WORDS)
    _require_known(told, known, str(path))
    state = tuple(x.name for x in default.items)
    apart = [x for x in state if all(x not in own for own in blocks.values())]
    listed = _texts(told.get("state", [*blocks, *apart]), f"{path}: state")
    named = (*angles, *state, *by_block)
    if not blocks and any(x in WORDS for x in listed):
        told_of = "blocks are of SO(3) and SE(3); give names"
        raise CompareError(f"{path}: state: {told_of}: {', '.join(named)}")
    _require_known(listed, (*named, *(WORDS if blocks else ())), f"{path}: state")
    _require_known([x for x in told if x in WORDS], listed, f"{path}: tables of the state")
    units = _numbers(told.get("units", {}), f"{path}: units")
    _require_known(units, [x for x in listed if x not in SIZES], f"{path}: units")
    if not all(units.values()):
        raise CompareError(f"{path}: units: a unit is not 0")
    items = []
    for name in listed:
        words = _said(told.get(name, {}), name, f"{path}: [{name}]") if name in WORDS else {}
        own = by_block.get(name, name)
        items.append(Item(own, words, units.get(name, 1.0), angles.get(name), name))
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


def _said(table: Any, name: str, where: str) -> dict[str, str]:
    """What a table says of a block, and what is meant where it says nothing."""
    if not isinstance(table, dict):
        raise CompareError(f"{where}: expected a table")
    _require_known(table, WORDS[name], where)
    words = {key: table.get(key, x[0]) for key, x in WORDS[name].items()}
    for key, word in words.items():
        _require_known([word], WORDS[name][key], f"{where}: {key}")
    return words


def _in_blocks(items: tuple[Item, ...], blocks: Mapping[str, tuple[str, ...]]) -> tuple[Item, ...]:
    """Names of a block that stand together, in order and in one unit, are the block."""
    found: list[Item] = []
    while items:
        for name, own in blocks.items():
            first = items[: len(own)]
            if tuple(x.name for x in first) == own and len({x.unit for x in first}) == 1:
                said = {key: words[0] for key, words in WORDS[name].items()}
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
    turned = {**blocks, **dict.fromkeys(("quaternion", "euler"), blocks.get("matrix", ()))}
    turned |= {x.name: x.angle.names for x in table.items if x.angle}
    given = [y for x in table.items for y in turned.get(x.name, (x.name,))]
    for name in state:
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
    found: dict[str, Any] = {}
    given: dict[str, Any] = {}
    for item, place in table.places():
        given[item.name] = x[:, place] / item.unit
        if item.angle:
            found |= item.angle.entries(given[item.name][:, 0])
        elif item.name not in WORDS:
            found[item.name] = given[item.name][:, 0]
    said = {item.name: item.said for item in table.items}
    for name in ("quaternion", "euler", "matrix"):
        if name in given:
            A = ROTATIONS[name](given[name], said[name])
            A = A if said[name]["sense"] == SENSES[0] else np.swapaxes(A, 1, 2)
            found |= _named(blocks["matrix"], A.reshape(-1, 9))
    if "position" in given:
        found |= _named(blocks["position"], given["position"])
    for name in RATES:
        if name in given:
            vector = given[name]
            if said[name]["frame"] == "space":
                A = np.stack([found[y] for y in blocks["matrix"]], axis=-1).reshape(-1, 3, 3)
                vector = np.einsum("nji,nj->ni", A, vector)
            found |= _named(blocks[name], vector)
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
        if item.name == "quaternion":
            part = random.normal(size=(n, 4))
            part /= np.linalg.norm(part, axis=1)[:, None]
        elif item.name == "euler":
            part = random.uniform(0.2, 1.2, size=(n, 3))
        elif item.name == "matrix":
            part = np.stack([columns[x] for x in blocks["matrix"]], axis=-1)
        elif item.name in WORDS or item.angle:
            part = random.normal(size=(n, item.size))
        else:
            part = columns[item.name][:, None]
        scaled = item.unit if item.name not in ("quaternion", "matrix") else 1.0
        parts.append(part * scaled)
    return np.concatenate(parts, axis=1)
