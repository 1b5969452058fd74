"""The JSON of a record.

``commentary``, the fields that are words for people; ``problem``, with the dimension ``n`` of its
space, a number or "any"; ``symbols``, each a name with its first use, ``type``, ``role`` and the
key of the equation that says first what it is, ``defined``, and ``also``, its other uses; and
``steps``, each of a ``kind`` that follows from its rule, each of their equations with its ``key``.
"""

from __future__ import annotations

import json
from typing import Any

from . import sentence
from .claims import Claim
from .contract import COMMENTARY
from .hypotheses import Hypothesis
from .name_types import Use
from .record import Derivation, Equation, Step, Symbol
from .sentence import english
from .tree_data import encode


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
        data["claims"] = [_claim_data(x) for x in s.claims]
    return data | {"driven": True} if s.driven else data


def _claim_data(x: Claim) -> dict[str, Any]:
    return {"says": x.kind} | {name: encode(value) for name, value in x.values}


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
