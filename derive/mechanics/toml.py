"""Problem files: TOML read into :class:`Problem`, every key checked, errors in one line."""

from __future__ import annotations

import keyword
import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..algebra.families import group
from ..algebra.tree import Tree
from .expression import ExpressionError, names, parse
from .problem import (
    Body,
    CovectorInput,
    Gravity,
    MomentBody,
    Parameter,
    PointBody,
    Potential,
    Problem,
    ProblemError,
    Spring,
)

NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,63}")
TOP = {"name", "title", "group", "action", "parameters", "point", "body", "potential", "input"}
LARGEST_FILE = 1_000_000


def load(path: Path) -> Problem:
    """Read a problem file; :class:`ProblemError` names file, key and remedy."""
    try:
        if path.stat().st_size > LARGEST_FILE:
            raise ProblemError(f"{path}: larger than {LARGEST_FILE} bytes")
        data = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise ProblemError(f"{path}: {error.strerror}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, RecursionError) as error:
        raise ProblemError(f"{path}: not TOML: {error}") from None
    try:
        return problem_of(data)
    except ProblemError as error:
        raise ProblemError(f"{path}: {error}") from None


def problem_of(data: Mapping[str, Any]) -> Problem:
    """A problem from the plain data of a file."""
    _known(data, TOP, "file")
    name = _text(data, "name", "file")
    if not NAME.fullmatch(name) or keyword.iskeyword(name):
        raise ProblemError("key 'name': letters, digits and _ only, starting with a letter")
    which = _text(data, "group", "file")
    try:
        moved = None if which == "any" else group(which)
    except ValueError as error:
        raise ProblemError(f"key 'group': {error}") from None
    action = _choice(data, "action", ("linear", "affine"), "file", moved.action if moved else "")
    if moved and action != moved.action:
        raise ProblemError(f"key 'action': {moved.name} acts by {moved.action} maps")
    parameters = _parameters(data.get("parameters", {}))
    body = _body(data, moved.n if moved else 0)
    if moved and body is None:
        raise ProblemError('no body: give [[point]] tables, or [body] with moments = "symbolic"')
    if isinstance(body, MomentBody):
        own = {x: parameters.get(x, p) for x, p in body.parameters().items()}
        parameters = {**own, **{k: p for k, p in parameters.items() if k not in own}}
    points = len(body.masses) if isinstance(body, PointBody) else 0
    if _tables(data, "input") and moved and "orthogonal" not in moved.relations:
        raise ProblemError(f"key 'input': there are no inputs on {moved.name} yet; leave it out")
    potentials = tuple(
        _potential(p, f"potential {k}", moved.n if moved else 0, points)
        for k, p in enumerate(_tables(data, "potential"), 1)
    )
    inputs = tuple(_input(i, f"input {k}") for k, i in enumerate(_tables(data, "input"), 1))
    if len(inputs) > 1:
        raise ProblemError("key 'input': one covector holds every component; give one table")
    title = _text(data, "title", "file") if "title" in data else name
    problem = Problem(name, moved, action, title, parameters, body, potentials, inputs)
    _declared(problem)
    return problem


def _known(data: Mapping[str, Any], keys: set[str], where: str) -> None:
    for key in data:
        if key not in keys:
            raise ProblemError(
                f"{where}: unknown key {key[:40]!r}; known: {', '.join(sorted(keys))}"
            )


def _text(data: Mapping[str, Any], key: str, where: str) -> str:
    if key not in data:
        raise ProblemError(f"{where}: key {key!r} is missing")
    if not isinstance(data[key], str):
        raise ProblemError(f"{where}: key {key!r} must be a string")
    return str(data[key])


def _choice(
    data: Mapping[str, Any], key: str, allowed: tuple[str, ...], where: str, default: str = ""
) -> str:
    if default and key not in data:
        return default
    value = _text(data, key, where)
    if value not in allowed:
        raise ProblemError(f"{where}: key {key!r} must be one of {', '.join(allowed)}")
    return value


def _tables(data: Mapping[str, Any], key: str) -> list[Mapping[str, Any]]:
    tables = data.get(key, [])
    if not isinstance(tables, list) or not all(isinstance(t, dict) for t in tables):
        raise ProblemError(f"key {key!r} must be written [[{key}]]")
    return tables


def _expression(value: Any, where: str) -> Tree:
    """A number or a string of the grammar."""
    if isinstance(value, bool) or not isinstance(value, (int, float, str)):
        raise ProblemError(f"{where}: expected a number or an expression in quotes")
    try:
        return parse(value if isinstance(value, str) else repr(value))
    except ExpressionError as error:
        raise ProblemError(f"{where}: {error}") from None


def _vector(value: Any, n: int, where: str) -> tuple[Tree, ...]:
    if not isinstance(value, list) or len(value) != n:
        raise ProblemError(f"{where}: expected a list of {n} expressions")
    return tuple(_expression(x, where) for x in value)


def _parameters(data: Any) -> dict[str, Parameter]:
    if not isinstance(data, dict):
        raise ProblemError("key 'parameters' must be a table")
    found = {}
    for name, value in data.items():
        where = f"parameter {name[:40]!r}"
        if not NAME.fullmatch(name):
            raise ProblemError(f"{where}: letters, digits and _ only, starting with a letter")
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            value = {"default": value}
        if not isinstance(value, dict):
            raise ProblemError(f"{where}: expected a number or a table")
        _known(value, {"default", "unit", "meaning"}, where)
        default = value.get("default")
        if default is not None and (
            isinstance(default, bool) or not isinstance(default, (int, float))
        ):
            raise ProblemError(f"{where}: key 'default' must be a number")
        texts = {k: _text(value, k, where) for k in ("unit", "meaning") if k in value}
        found[name] = Parameter(None if default is None else float(default), **texts)
    return found


def _body(data: Mapping[str, Any], n: int) -> Body | None:
    points = _tables(data, "point")
    if "body" in data:
        body = data["body"]
        if points or not isinstance(body, dict):
            raise ProblemError("give either [[point]] tables or one [body] table")
        _known(body, {"moments"}, "body")
        _choice(body, "moments", ("symbolic",), "body")
        return MomentBody(n)
    if not points:
        return None
    masses, positions = [], []
    for k, p in enumerate(points, 1):
        where = f"point {k}"
        _known(p, {"mass", "at"}, where)
        for key in ("mass", "at"):
            if key not in p:
                raise ProblemError(f"{where}: key {key!r} is missing")
        masses.append(_expression(p["mass"], f"{where}, mass"))
        positions.append(_vector(p["at"], n, f"{where}, at"))
    return PointBody(tuple(masses), tuple(positions))


def _potential(data: Mapping[str, Any], where: str, n: int, points: int) -> Potential:
    kind = _choice(data, "kind", ("gravity", "spring"), where)
    if kind == "gravity":
        _known(data, {"kind", "g"}, where)
        return Gravity(_vector(data.get("g"), n, f"{where}, g"))
    _known(data, {"kind", "between", "stiffness", "length"}, where)
    ends = data.get("between")
    if not points:
        raise ProblemError(f"{where}: a spring needs [[point]] tables to act between")
    integers = isinstance(ends, list) and all(type(i) is int for i in ends)
    if not integers or len(ends or []) != 2 or not all(1 <= i <= points for i in ends or []):
        raise ProblemError(f"{where}: key 'between' must be two points from 1 to {points}")
    if ends and ends[0] == ends[1]:
        raise ProblemError(f"{where}: key 'between' names one point twice")
    if data.get("length", 0) != 0:
        raise ProblemError(f"{where}: key 'length': only natural length 0 is known")
    if "stiffness" not in data:
        raise ProblemError(f"{where}: key 'stiffness' is missing")
    assert ends is not None
    return Spring((ends[0], ends[1]), _expression(data["stiffness"], f"{where}, stiffness"))


def _input(data: Mapping[str, Any], where: str) -> CovectorInput:
    _known(data, {"name", "kind"}, where)
    _choice(data, "kind", ("covector",), where)
    name = _text(data, "name", where)
    if not NAME.fullmatch(name):
        raise ProblemError(f"{where}: key 'name': letters, digits and _ only")
    return CovectorInput(name)


def _declared(problem: Problem) -> None:
    """Every name that is used is a parameter."""
    trees: list[Tree] = []
    if isinstance(problem.body, PointBody):
        trees += [*problem.body.masses, *(x for r in problem.body.positions for x in r)]
    trees += list(problem.gravity or ())
    trees += [s.stiffness for s in problem.springs]
    for name in (x for t in trees for x in names(t)):
        if name not in problem.parameters:
            raise ProblemError(f"{name!r} is used but not declared; add it to [parameters]")
