"""The record: a derivation as data, and its JSON.

``Derivation`` = the problem, the declared symbols and the ordered steps.  A step names the rule it
used and the earlier steps it rests on; its equations are pairs of trees.  Nothing here computes.

In JSON: ``commentary``, the fields that are words for people; ``problem``, with the dimension ``n``
of its space, a number or "any"; ``symbols``, each a name with its first use, ``type``, ``role`` and
the key of the equation that says first what it is, ``defined``, and ``also``, its other uses; and
``steps``, each of a ``kind`` that follows from its rule, each of their equations with its ``key``.
What the rest says already (commentary, kind, key) may be absent; if it is there, it must be right.
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

from ..language.limits import RECORD_BYTES, TREE
from ..language.refused import Refused
from ..language.tree import OPERATORS, Tree
from . import sentence
from .hypotheses import PROPERTIES, SPACES, Hypothesis
from .rules import RULES
from .sentence import Prose, english
from .shape import ShapeError, deepest, problem_shape, tree_shape
from .strict_json import loads
from .vocabulary import ACTIONS, ANY_GROUP, COMMENTARY, ROLES, VOCABULARY, Type, Use

DEEPEST_TYPE = 4
"""How deep lists may lie in one another in the type of a symbol."""


class RecordError(Refused, ValueError):
    """A record that is not well formed: the message says where, and what is wrong."""


def equation_key(label: str, place: int) -> str:
    """The key of an equation in all outputs, by its step and place there: ``so3.kernel.2``."""
    return f"{label}.{place}"


def step_of(key: str) -> str:
    """The label of the step that an equation's key belongs to."""
    return key.rpartition(".")[0]


@dataclass(frozen=True)
class Equation:
    """lhs = rhs, for every value of the names in ``for_all`` and some of those in ``exists``."""

    lhs: Tree
    rhs: Tree
    for_all: tuple[str, ...] = ()
    exists: tuple[str, ...] = ()


@dataclass(frozen=True)
class Step:
    """One step of the walk.

    ``scope`` is ``"any group"`` or the name of the group on which the equations hold; ``given``:
    equations that are supposed to hold; ``driven``: inputs and damping act; ``hypotheses``: what
    is inverted, or tells the velocity of X, can be.
    """

    label: str
    rule: str
    uses: tuple[str, ...]
    equations: tuple[Equation, ...]
    prose: Prose
    paper: tuple[int, ...] = ()
    scope: str = ANY_GROUP
    given: tuple[Equation, ...] = ()
    driven: bool = False
    hypotheses: tuple[Hypothesis, ...] = ()

    @property
    def kind(self) -> str:
        """What the step's equations are, by its rule: a definition, an identity, …"""
        return RULES[self.rule].kind

    @cached_property
    def keys(self) -> tuple[str, ...]:
        """The keys of the step's equations, in order."""
        return tuple(equation_key(self.label, k) for k, _ in enumerate(self.equations, 1))

    def key(self, equation: Equation) -> str:
        """The key of an equation of the step; of two equal equations, that of the first."""
        return self._keys[equation]

    @cached_property
    def _keys(self) -> dict[Equation, str]:
        return dict(reversed([*zip(self.equations, self.keys, strict=True)]))


@dataclass(frozen=True)
class Symbol:
    """A declared name: what it means, how LaTeX writes it, in which ways the steps use it."""

    name: str
    meaning: Prose
    latex: str
    uses: tuple[Use, ...] = ()


@dataclass(frozen=True)
class Derivation:
    """The record of one problem: the problem as data, the declared symbols, the steps in order."""

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

    @cached_property
    def remarks(self) -> frozenset[str]:
        """The labels of the steps that ``motion`` does not rest on; none without that step."""
        uses = {s.label: s.uses for s in self.steps}
        left = [f"{self.name}.motion"]
        if left[0] not in uses:
            return frozenset()
        found = set(left)
        while left:
            new = {*uses[left.pop()]} - found
            found |= new
            left += new
        return frozenset({*uses} - found)

    def definition(self, lhs: Tree) -> tuple[Step, Equation] | None:
        """The last equation with that left side, with its step, among steps without hypotheses in
        ``given``; ``None`` if there is none."""
        return self._definitions.get(lhs)

    @cached_property
    def _definitions(self) -> dict[Tree, tuple[Step, Equation]]:
        own = (step for step in self.steps if not step.given)
        return {equation.lhs: (step, equation) for step in own for equation in step.equations}


def encode(t: Tree) -> Any:
    """A tree as plain data: names, integers, fractions as strings "p/q", operators as lists."""
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
    """The record as plain data, in the layout of its JSON."""
    return {
        "commentary": list(COMMENTARY),
        "problem": dict(d.problem),
        "symbols": [_symbol_data(s) for s in d.symbols],
        "steps": [
            _step_data(s) | ({"remark": True} if s.label in d.remarks else {}) for s in d.steps
        ],
    }


def _symbol_data(s: Symbol) -> dict[str, Any]:
    data: dict[str, Any] = {"name": s.name, "meaning": english(s.meaning), "latex": s.latex}
    if not sentence.plain(s.meaning):
        data["sentences"] = sentence.to_data(s.meaning)
    first, *also = [*map(_use_data, s.uses)] or [{}]
    return data | first | ({"also": also} if also else {})


def _use_data(use: Use) -> dict[str, Any]:
    data = {"type": use.type, "role": use.role}
    return data | ({"defined": use.defined} if use.defined else {})


def _step_data(s: Step) -> dict[str, Any]:
    data: dict[str, Any] = {
        "label": s.label,
        "rule": s.rule,
        "kind": s.kind,
        "uses": list(s.uses),
        "paper": list(s.paper),
        "scope": s.scope,
        "given": [_equation_data(e) for e in s.given],
        "hypotheses": [_hypothesis_data(x) for x in s.hypotheses],
        "prose": english(s.prose),
        "sentences": sentence.to_data(s.prose),
        "equations": [
            {"key": key} | _equation_data(e) for key, e in zip(s.keys, s.equations, strict=True)
        ],
    }
    return data | {"driven": True} if s.driven else data


def _hypothesis_data(x: Hypothesis) -> dict[str, Any]:
    data: dict[str, Any] = {"is": x.property, "of": encode(x.of)}
    return data | {"on": x.space} if x.space else data


def _equation_data(e: Equation) -> dict[str, Any]:
    data: dict[str, Any] = {"lhs": encode(e.lhs), "rhs": encode(e.rhs)}
    for key, names in (("for_all", e.for_all), ("exists", e.exists)):
        if names:
            data[key] = list(names)
    return data


def to_json(d: Derivation) -> str:
    """The record as JSON text: objects over several lines, trees in one."""
    return _laid_out(to_data(d), "") + "\n"


def _laid_out(data: Any, indent: str) -> str:
    """JSON text: objects over several lines, trees in one line."""
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
    """The value of a key of an object; ``RecordError`` where it is missing or of another kind."""
    if not isinstance(data, dict):
        raise RecordError(f"{where}: expected an object")
    if key not in data:
        raise RecordError(f"{where}: key {key!r} is missing")
    if not isinstance(data[key], kind):
        raise RecordError(f"{where}: key {key!r} must be a {kind.__name__}")
    return data[key]


def _strings(data: Any, key: str, where: str) -> tuple[str, ...]:
    """The list of strings under a key of an object; ``RecordError`` for anything else."""
    items = _field(data, key, list, where)
    if not all(isinstance(x, str) for x in items):
        raise RecordError(f"{where}: key {key!r} must list strings")
    return tuple(items)


def _prose(data: Any, key: str, where: str) -> Prose:
    """The sentences of an object, which must say the same in English as the text under ``key``; or
    that text as one sentence, where there is no key 'sentences'."""
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


def _require_implied(data: dict[str, Any], key: str, right: Any, where: str) -> None:
    """``RecordError`` where a key that follows from the rest of the record has another value than
    ``right``; it may be absent."""
    if key in data and data[key] != right:
        said = right if isinstance(right, str) else json.dumps(right)
        raise RecordError(f"{where}: key {key!r} must be {said}")


def _symbol(data: Any, where: str) -> Symbol:
    name, latex = (_field(data, key, str, where) for key in ("name", "latex"))
    if name not in VOCABULARY or latex != VOCABULARY[name].latex:
        raise RecordError(f"{where}: {ascii(name)[:40]} is no name of the walk, or not so in LaTeX")
    where = f"{where} ({name})"
    uses = [_use(data, where)]
    if "also" in data:
        uses += [_use(x, where) for x in _field(data, "also", list, where)]
    return Symbol(name, _prose(data, "meaning", where), latex, tuple(uses))


def _use(data: Any, where: str) -> Use:
    kind, role = _type(_field(data, "type", object, where), where), _field(data, "role", str, where)
    if role not in ROLES:
        raise RecordError(f"{where}: key 'role' must be one of {', '.join(ROLES)}")
    return Use(kind, role, _field(data, "defined", str, where) if "defined" in data else "")


def _type(data: Any, where: str, depth: int = 0) -> Type:
    """The type of a symbol, names and sizes in nested lists; only its form is read here, the
    checker judges what it means."""
    if isinstance(data, str) or type(data) is int:
        return data  # type: ignore[return-value]
    if not isinstance(data, list) or not data or depth > DEEPEST_TYPE:
        raise RecordError(f"{where}: key 'type' must be a name, or lists of names and sizes")
    return tuple(_type(x, where, depth + 1) for x in data)


def _step(data: Any, where: str, earlier: Set[str], group: str) -> Step:
    """A step from its data; ``earlier``: the labels of the steps before it. Its scope follows from
    its label: ``group``, or any group."""
    label = _field(data, "label", str, where)
    if not re.fullmatch(r"[A-Za-z][A-Za-z0-9_.]{0,99}", label):
        raise RecordError(f"{where}: key 'label' must be letters, digits, _ and dots")
    if step_of(label) and label.rpartition(".")[2].isdecimal():
        raise RecordError(f"{where}: {label!r} would be the key of an equation, not of a step")
    where = f"{where} ({label})"
    rule = _field(data, "rule", str, where)
    if rule not in RULES:
        raise RecordError(f"{where}: unknown rule {rule[:40]!r}")
    _require_implied(data, "kind", RULES[rule].kind, where)
    uses = _strings(data, "uses", where)
    missing = [u for u in uses if u not in earlier]
    if missing:
        raise RecordError(f"{where}: uses {missing[0][:40]!r}, which is no earlier step")
    equations = _equations(data, "equations", where)
    if not equations:
        raise RecordError(f"{where}: no equation")
    for k, item in enumerate(data["equations"], 1):
        _require_implied(item, "key", equation_key(label, k), f"{where}, equation {k}")
    paper = tuple(x for x in _field(data, "paper", list, where) if isinstance(x, int))
    scope = ANY_GROUP if label.partition(".")[0] in ACTIONS else group
    _require_implied(data, "scope", scope, where)
    prose = _prose(data, "prose", where)
    given = _equations(data, "given", where, quantified=False) if "given" in data else ()
    driven = bool(_field(data, "driven", bool, where)) if "driven" in data else False
    supposed = _hypotheses(data, where) if "hypotheses" in data else ()
    return Step(label, rule, uses, equations, prose, paper, scope, given, driven, supposed)


def _equations(data: Any, key: str, where: str, *, quantified: bool = True) -> tuple[Equation, ...]:
    """The equations under a key; ``quantified``: may they have quantifiers?"""
    found = []
    for k, item in enumerate(_field(data, key, list, where), 1):
        place = f"{where}, {'equation' if quantified else key} {k}"
        lhs, rhs = (decode(_field(item, side, object, place), place) for side in ("lhs", "rhs"))
        names = (_strings(item, x, place) if x in item else () for x in ("for_all", "exists"))
        found.append(Equation(lhs, rhs, *names))
        if not quantified and (found[-1].for_all or found[-1].exists):
            raise RecordError(f"{place}: what is given has no quantifiers")
    return tuple(found)


def _hypotheses(data: Any, where: str) -> tuple[Hypothesis, ...]:
    found = []
    for k, item in enumerate(_field(data, "hypotheses", list, where), 1):
        place = f"{where}, hypothesis {k}"
        what = _field(item, "is", str, place)
        if what not in PROPERTIES:
            raise RecordError(f"{place}: key 'is' must be one of {', '.join(PROPERTIES)}")
        space = _field(item, "on", str, place) if "on" in item else ""
        if (space in SPACES) != (what == "nondegenerate") or (space and space not in SPACES):
            raise RecordError(f"{place}: key 'on' is of a form: one of {', '.join(SPACES)}")
        found.append(Hypothesis(what, decode(_field(item, "of", object, place), place), space))
    return tuple(found)


def from_json(text: str) -> Derivation:
    """A record from JSON text; :class:`RecordError` says what is wrong and where."""
    try:
        data = loads(text)
    except ValueError as error:
        raise RecordError(f"not JSON that can be read: {error}") from None
    problem = _field(data, "problem", dict, "record")
    _require_implied(data, "commentary", [*COMMENTARY], "record")
    if deepest(problem) > TREE:
        raise RecordError(f"record, problem: nested deeper than {TREE}")
    try:
        problem_shape(problem, decode)
    except ShapeError as error:
        raise RecordError(f"record, problem: {error}") from None
    listed = _field(data, "symbols", list, "record")
    symbols = [_symbol(item, f"symbol {k}") for k, item in enumerate(listed, 1)]
    prefixes, steps = (problem["name"], *ACTIONS), dict[str, Step]()
    for k, item in enumerate(_field(data, "steps", list, "record"), 1):
        step = _step(item, f"step {k}", steps.keys(), problem["group"])
        if step.label.partition(".")[0] not in prefixes:
            raise RecordError(
                f"step {k} ({step.label}): key 'label' must begin with the problem's name"
            )
        if step.label in steps:
            raise RecordError(f"step {k}: label {step.label[:40]!r} stands twice")
        steps[step.label] = step
    if not steps:
        raise RecordError("record: no step")
    found = Derivation(problem, tuple(symbols), tuple(steps.values()))
    for k, (item, label) in enumerate(zip(data["steps"], steps, strict=True), 1):
        _require_implied(item, "remark", label in found.remarks, f"step {k} ({label})")
    return found


def read(path: Path) -> Derivation:
    """The record in a JSON file; :class:`RecordError` names the file and what is wrong."""
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
