"""The record: a derivation as data, and its JSON.

``Derivation`` = the problem, the declared symbols and the ordered steps.  A step names the rule it
used and the earlier steps it rests on; its equations are pairs of trees.  Nothing here computes.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Set
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from pathlib import Path
from typing import Any

from ..algebra.tree import OPERATORS, Tree
from ..limits import RECORD_BYTES, TREE
from . import sentence
from .rules import RULES
from .sentence import Prose, english
from .shape import ShapeError, deepest, problem_shape, tree_shape
from .strict import loads
from .vocabulary import ANY_GROUP, GIVENS


class RecordError(ValueError):
    """A record that is not well formed: the message says where."""


@dataclass(frozen=True)
class Equation:
    """lhs = rhs, for every value of the names in ``for_all``."""

    lhs: Tree
    rhs: Tree
    for_all: tuple[str, ...] = ()


@dataclass(frozen=True)
class Step:
    """One step of the walk.

    ``scope`` is ``"any group"`` or the name of the group on which the equations hold; ``given``
    lists further assumptions (``"principal axes"``, ``"input"``).
    """

    label: str
    rule: str
    uses: tuple[str, ...]
    equations: tuple[Equation, ...]
    prose: Prose
    paper: tuple[int, ...] = ()
    scope: str = ANY_GROUP
    given: tuple[str, ...] = ()

    def number(self, equation: Equation) -> int:
        """The place of an equation in the step, counted from 1."""
        return self._numbers[equation]

    @cached_property
    def _numbers(self) -> dict[Equation, int]:
        return {e: k for k, e in reversed([*enumerate(self.equations, 1)])}


@dataclass(frozen=True)
class Symbol:
    """A declared name: what it means and how LaTeX writes it."""

    name: str
    meaning: Prose
    latex: str


@dataclass(frozen=True)
class Derivation:
    """The whole record of one problem."""

    problem: Mapping[str, Any]
    symbols: tuple[Symbol, ...]
    steps: tuple[Step, ...]

    @property
    def name(self) -> str:
        """The problem's name, which prefixes its labels."""
        return str(self.problem["name"])

    def __getitem__(self, label: str) -> Step:
        """A step by its label, with or without the problem's name."""
        wanted = {label, f"{self.name}.{label}"}
        for step in self.steps:
            if step.label in wanted:
                return step
        raise KeyError(label)

    def definition(self, lhs: Tree) -> tuple[Step, Equation] | None:
        """The last equation with that left side, in the axes of the record, and its step."""
        return self._definitions.get(lhs)

    @cached_property
    def _definitions(self) -> dict[Tree, tuple[Step, Equation]]:
        own = (step for step in self.steps if "principal axes" not in step.given)
        return {equation.lhs: (step, equation) for step in own for equation in step.equations}


def encode(t: Tree) -> Any:
    """A tree for JSON: names, integers, fractions as strings, lists."""
    if isinstance(t, Fraction):
        return f"{t.numerator}/{t.denominator}"
    return [t[0], *(encode(x) for x in t[1:])] if isinstance(t, tuple) else t


def decode(data: Any, where: str, depth: int = 0) -> Tree:
    """The inverse of :func:`encode`; :class:`RecordError` for anything that is not a tree."""
    if depth > TREE:
        raise RecordError(f"{where}: tree deeper than {TREE}")
    if isinstance(data, str):
        if re.fullmatch(r"-?[0-9]{1,4000}/0*[1-9][0-9]{0,4000}", data):
            return Fraction(data)
        if not data or not data.isprintable():
            raise RecordError(f"{where}: a name may not be {ascii(data)[:40]}")
        return data
    if isinstance(data, int) and not isinstance(data, bool):
        return data
    if isinstance(data, list) and data and isinstance(data[0], str):
        arity = OPERATORS.get(data[0])
        if arity is None:
            raise RecordError(f"{where}: unknown operator {data[0][:20]!r}")
        least, most = arity
        if len(data) - 1 < least or (most is not None and len(data) - 1 > most):
            raise RecordError(f"{where}: {data[0]!r} with {len(data) - 1} operands")
        found = (data[0], *(decode(x, where, depth + 1) for x in data[1:]))
        if wrong := tree_shape(found):
            raise RecordError(f"{where}: {data[0]!r}: {wrong}")
        return found
    raise RecordError(f"{where}: not an operator tree: {type(data).__name__}")


def to_data(d: Derivation) -> dict[str, Any]:
    """The record as plain data."""
    return {
        "problem": dict(d.problem),
        "symbols": [_symbol_data(s) for s in d.symbols],
        "steps": [_step_data(s) for s in d.steps],
    }


def _symbol_data(s: Symbol) -> dict[str, Any]:
    data: dict[str, Any] = {"name": s.name, "meaning": english(s.meaning), "latex": s.latex}
    return data if sentence.plain(s.meaning) else data | {"sentences": sentence.to_data(s.meaning)}


def _step_data(s: Step) -> dict[str, Any]:
    return {
        "label": s.label,
        "rule": s.rule,
        "uses": list(s.uses),
        "paper": list(s.paper),
        "scope": s.scope,
        "given": list(s.given),
        "prose": english(s.prose),
        "sentences": sentence.to_data(s.prose),
        "equations": [_equation_data(e) for e in s.equations],
    }


def _equation_data(e: Equation) -> dict[str, Any]:
    data: dict[str, Any] = {"lhs": encode(e.lhs), "rhs": encode(e.rhs)}
    if e.for_all:
        data["for_all"] = list(e.for_all)
    return data


def to_json(d: Derivation) -> str:
    """The record as JSON text: objects over several lines, trees in one."""
    return _laid_out(to_data(d), "") + "\n"


def _laid_out(data: Any, indent: str) -> str:
    inner = indent + " "
    if isinstance(data, dict) and data:
        items = (f"{inner}{_laid_out(k, inner)}: {_laid_out(v, inner)}" for k, v in data.items())
        return "{\n" + ",\n".join(items) + f"\n{indent}}}"
    if isinstance(data, list) and data and isinstance(data[0], dict):
        return "[\n" + ",\n".join(inner + _laid_out(x, inner) for x in data) + f"\n{indent}]"
    text = json.dumps(data, ensure_ascii=False)
    if text.isprintable():
        return text
    # what moves a terminal's cursor or turns the direction of its text
    return "".join(c if c.isprintable() else json.dumps(c)[1:-1] for c in text)


def _field(data: Any, key: str, kind: type, where: str) -> Any:
    if not isinstance(data, dict):
        raise RecordError(f"{where}: expected an object")
    if key not in data:
        raise RecordError(f"{where}: key {key!r} is missing")
    if not isinstance(data[key], kind):
        raise RecordError(f"{where}: key {key!r} must be a {kind.__name__}")
    return data[key]


def _strings(data: Any, key: str, where: str) -> tuple[str, ...]:
    items = _field(data, key, list, where)
    if not all(isinstance(x, str) for x in items):
        raise RecordError(f"{where}: key {key!r} must list strings")
    return tuple(items)


def _prose(data: Any, key: str, where: str) -> Prose:
    """The sentences of an object, whose English stands beside them; or that English as one."""
    words = str(_field(data, key, str, where))
    if "sentences" not in data:
        return sentence.say(words)
    try:
        prose = sentence.of_data(data["sentences"], where)
    except ValueError as error:
        raise RecordError(str(error)) from None
    if english(prose) != words:
        raise RecordError(f"{where}: the English of 'sentences' is not {key!r}")
    return prose


def _symbol(data: Any, where: str) -> Symbol:
    name, latex = (_field(data, key, str, where) for key in ("name", "latex"))
    return Symbol(name, _prose(data, "meaning", where), latex)


def _step(data: Any, where: str, earlier: Set[str]) -> Step:
    label = _field(data, "label", str, where)
    if not re.fullmatch(r"[A-Za-z][A-Za-z0-9_.]{0,99}", label):
        raise RecordError(f"{where}: key 'label' must be letters, digits, _ and dots")
    where = f"{where} ({label})"
    rule = _field(data, "rule", str, where)
    if rule not in RULES:
        raise RecordError(f"{where}: unknown rule {rule[:40]!r}")
    uses = _strings(data, "uses", where)
    missing = [u for u in uses if u not in earlier]
    if missing:
        raise RecordError(f"{where}: uses {missing[0][:40]!r}, which is no earlier step")
    given = _strings(data, "given", where) if "given" in data else ()
    if not set(given) <= set(GIVENS):
        raise RecordError(f"{where}: 'given' may list {', '.join(GIVENS)}")
    equations = []
    for k, item in enumerate(_field(data, "equations", list, where)):
        place = f"{where}, equation {k + 1}"
        _field(item, "lhs", object, place), _field(item, "rhs", object, place)
        for_all = _strings(item, "for_all", place) if "for_all" in item else ()
        equations.append(Equation(decode(item["lhs"], place), decode(item["rhs"], place), for_all))
    if not equations:
        raise RecordError(f"{where}: no equation")
    paper = tuple(x for x in _field(data, "paper", list, where) if isinstance(x, int))
    scope = str(data.get("scope", ANY_GROUP))
    prose = _prose(data, "prose", where)
    return Step(label, rule, uses, tuple(equations), prose, paper, scope, given)


def from_json(text: str) -> Derivation:
    """Read a record; :class:`RecordError` says what is wrong and where."""
    try:
        data = loads(text)
    except ValueError as error:
        raise RecordError(f"not JSON that can be read: {error}") from None
    problem = _field(data, "problem", dict, "record")
    if deepest(problem) > TREE:
        raise RecordError(f"record, problem: nested deeper than {TREE}")
    try:
        problem_shape(problem, decode)
    except ShapeError as error:
        raise RecordError(f"record, problem: {error}") from None
    listed = _field(data, "symbols", list, "record")
    symbols = [_symbol(item, f"symbol {k}") for k, item in enumerate(listed, 1)]
    steps: dict[str, Step] = {}
    for k, item in enumerate(_field(data, "steps", list, "record"), 1):
        step = _step(item, f"step {k}", steps.keys())
        if step.label in steps:
            raise RecordError(f"step {k}: label {step.label[:40]!r} stands twice")
        steps[step.label] = step
    if not steps:
        raise RecordError("record: no step")
    return Derivation(problem, tuple(symbols), tuple(steps.values()))


def read(path: Path) -> Derivation:
    """A record from a file; :class:`RecordError` names it."""
    try:
        with path.open("rb") as file:
            raw = file.read(RECORD_BYTES + 1)
        if len(raw) > RECORD_BYTES:
            raise RecordError(f"larger than {RECORD_BYTES} bytes")
        return from_json(raw.decode("utf-8"))
    except OSError as error:
        raise RecordError(f"{path}: {error.strerror}") from None
    except UnicodeDecodeError:
        raise RecordError(f"{path}: not UTF-8 text") from None
    except RecordError as error:
        raise RecordError(f"{path}: {error}") from None
