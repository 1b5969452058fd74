"""The JSON of a record, which is read from strangers too: what is wrong is said, and where.

``commentary``, the fields that are words for people; ``problem``, with the dimension ``n`` of its
space, a number or "any"; ``symbols``, each a name with its first use, ``type``, ``role`` and the
key of the equation that says first what it is, ``defined``, and ``also``, its other uses; and
``steps``, each of a ``kind`` that follows from its rule, each of their equations with its ``key``.
What the rest says already (commentary, kind, key) may be absent; if it is there, it must be right.
"""

from __future__ import annotations

import json
import re
from collections.abc import Set
from fractions import Fraction
from pathlib import Path
from typing import Any

from ..language.derivatives import DERIVATIVES
from ..language.limits import RECORD_BYTES, TREE
from ..language.tree import OPERATORS, Tree
from . import sentence
from .record import (
    ANY_GROUP,
    CHAPTERS,
    COMMENTARY,
    PROPERTIES,
    SPACES,
    Derivation,
    Equation,
    Hypothesis,
    RecordError,
    Step,
    Symbol,
    equation_key,
    step_of,
)
from .sentence import CLAIMS, Claim, Prose, english
from .shape import ShapeError, problem_shape
from .vocabulary import ROLES, RULES, VOCABULARY, Type, Use


def loads(text: str) -> Any:
    """The data of a text; ``ValueError`` says in one line what cannot be read."""
    try:
        return json.loads(text, parse_constant=_no_constant, object_pairs_hook=_object)
    except RecursionError:
        raise ValueError("nested deeper than can be read") from None
    except ValueError as error:  # Python reads no integer of thousands of digits
        if "set_int_max_str_digits" in str(error):
            raise ValueError("an integer of thousands of digits") from None
        raise


def _no_constant(name: str) -> Any:
    """``ValueError`` for NaN and the infinities, which are no JSON."""
    raise ValueError(f"{name} is no number of JSON")


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """An object from its keys and values; ``ValueError`` for a key that occurs twice."""
    found = dict(pairs)
    if len(found) < len(pairs):
        twice = next(key for k, (key, _) in enumerate(pairs) if key in dict(pairs[:k]))
        raise ValueError(f"key {twice[:40]!r} stands twice")
    return found


# Trees as plain data: names, integers, fractions as strings, operators as lists.


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


# The JSON of a record, written.


def to_data(d: Derivation) -> dict[str, Any]:
    """The record as plain data, in the layout of its JSON."""
    return {
        "commentary": list(COMMENTARY),
        "problem": dict(d.problem),
        "symbols": [_symbol_data(s) for s in d.symbols],
        "steps": [
            step_data(s) | ({"remark": True} if s.label in d.remarks else {}) for s in d.steps
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


def step_data(s: Step) -> dict[str, Any]:
    """A step as it stands in the JSON of its record."""
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
    if s.claims:
        told = ((x.kind, {name: encode(y) for name, y in x.values}) for x in s.claims)
        data["claims"] = [{"says": kind} | values for kind, values in told]
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


# A record from its JSON.

DEEPEST_TYPE = 4
"""How deep lists may lie in one another in the type of a symbol."""


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
        text = json.dumps(right, ensure_ascii=False)  # in one line, whatever a name of it is
        raise RecordError(f"{where}: key {key!r} must be {text}")


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
    scope = ANY_GROUP if label.partition(".")[0] in CHAPTERS else group
    _require_implied(data, "scope", scope, where)
    prose = _prose(data, "prose", where)
    given = _equations(data, "given", where, quantified=False) if "given" in data else ()
    driven = bool(_field(data, "driven", bool, where)) if "driven" in data else False
    supposed = _hypotheses(data, where) if "hypotheses" in data else ()
    claims = _claims(data, where) if "claims" in data else ()
    return Step(label, rule, uses, equations, prose, paper, scope, given, driven, supposed, claims)


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


def _claims(data: Any, where: str) -> tuple[Claim, ...]:
    found = []
    for k, item in enumerate(_field(data, "claims", list, where), 1):
        place = f"{where}, claim {k}"
        kind = _field(item, "says", str, place)
        if kind not in CLAIMS:
            raise RecordError(f"{place}: unknown claim {kind[:40]!r}")
        values = (x for x in item.items() if x[0] != "says")
        found.append(Claim(kind, tuple((name, decode(x, place)) for name, x in values)))
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
    prefixes, steps = (problem["name"], *CHAPTERS), dict[str, Step]()
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


def tree_shape(t: tuple[Any, ...]) -> str:
    """What is wrong with the operands of an operator that takes names or numbers; else empty."""
    if t[0] == "fun":
        return "" if isinstance(t[1], str) and t[1] in DERIVATIVES else "unknown function"
    if t[0] == "pow":
        return "" if type(t[2]) is int else "an exponent must be an integer"
    if t[0] in ("par", "sum", "at"):
        named = isinstance(t[1], str) and all(isinstance(i, (str, int)) for i in t[2:3])
        return "" if named or (t[0] == "sum" and isinstance(t[1], str)) else "expected a name"
    if t[0] == "entry":
        return "" if all(isinstance(i, (str, int)) for i in t[2:]) else "expected indices"
    if t[0] == "matrix":
        lengths = {len(x) if isinstance(x, tuple) and x[0] == "row" else 0 for x in t[1:]}
        return "" if len(lengths) == 1 and 0 not in lengths else "expected rows of one length"
    return ""


def deepest(data: Any) -> int:
    """How many lists and objects lie in one another at most; found without recursion."""
    level, inside = 0, [data]
    while inside := [
        x
        for y in inside
        if isinstance(y, (list, dict))
        for x in (y.values() if isinstance(y, dict) else y)
    ]:
        level += 1
    return level
