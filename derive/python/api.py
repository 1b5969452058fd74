"""The same as problem files, from Python: a few words that build the tables of a file."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from inspect import Parameter, Signature, signature
from typing import Any, TypeVar

from ..algebra.families import FAMILIES
from ..language.limits import Refused
from ..problem import problem as mechanics
from ..problem.toml import problem_of
from ..schema import table as schema
from ..schema.kind import SECTIONS
from ..schema.python_words import words
from ..schema.table import Number, hint
from . import quoted
from .quoted import warned

F = TypeVar("F", bound=Callable[..., Any])


@dataclass(frozen=True)
class Group:
    """A group by its name, ``Group("SO(3)")``, or by a basis of its Lie algebra over Q.

    ``a * b`` is the product, on blocks of points.
    """

    name: str
    basis: Sequence[Sequence[Sequence[Number]]] | None = None
    action: str = "linear"

    def __mul__(self, other: Group) -> Group:
        return Group(f"{self.name} x {other.name}")

    def table(self) -> Any:
        """The value of ``group`` in a problem file: a name, or a table with a basis."""
        if self.basis is None:
            return self.name
        basis = _plain(self.basis, "group, basis")
        return {"name": self.name, "action": self.action, "basis": basis}


class Table:
    """A table of a problem file: its key and its fields."""

    def __init__(self, key: str, **fields: Any):
        self.key = key
        self.fields = {k: _plain(x, f"{key}, {k}") for k, x in fields.items() if x is not None}

    def __repr__(self) -> str:
        shown = f"<{self.key}: {', '.join(f'{k}={x!r}' for k, x in self.fields.items())}"
        return f"{shown}>" if len(shown) < 79 else f"{shown[:77]}…>"


def __getattr__(name: str) -> Any:
    """The word of a table, and that of a family of groups."""
    if name in FAMILIES:
        return _family(name)
    if name in words():
        return _word(name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


@cache
def _family(name: str) -> Callable[[int], Group]:
    def group(n: int) -> Group:
        return Group(f"{name}({n})")

    return _called(group, name, f"The group {name}(n): {FAMILIES[name].meaning}.")


@cache
def _word(name: str) -> Callable[..., Table | list[Table]]:
    """What builds a table from arguments: those of its ``word``, or the keys of a file."""
    own = words()[name]
    kind = {"kind": own.kind} if own.kind else {}
    taken = _arguments(own)

    def build(*given: Any, **named: Any) -> Table | list[Table]:
        keys = [*taken.parameters]
        where = [
            f"{name}, {keys[min(k, len(keys) - 1)]}" if keys else name for k in range(len(given))
        ]
        said = _said(
            name,
            own,
            [*map(_plain, given, where)],
            {k: _plain(x, f"{name}, {k}") for k, x in named.items()},
        )
        if isinstance(said, list):
            return [Table(own.section, **x) for x in said]
        return Table(own.section, **kind | said)

    vars(build)["__signature__"] = taken
    return _called(build, name, (own.word or own).__doc__)


def _arguments(own: type[schema.Table]) -> Signature:
    """Those of a word: its own, or else the keys of its table."""
    if own.word:
        return signature(own.word)
    kind = Parameter.POSITIONAL_OR_KEYWORD
    return Signature([Parameter(x, kind, default=None) for x in own.names()])


def _said(name: str, own: type[schema.Table], given: list[Any], named: dict[str, Any]) -> Any:
    """The keys that the arguments of a word say; ``ProblemError`` for what is none of them."""
    taken, keys = _arguments(own), (*own.names(), "kind")
    mine = {k: p for k, p in taken.parameters.items() if p.kind is p.POSITIONAL_OR_KEYWORD}
    known = ", ".join(dict.fromkeys((*mine, *keys[:-1])))
    is_open = any(p.kind is p.VAR_KEYWORD for p in taken.parameters.values())
    others = {k: x for k, x in named.items() if k not in mine and not is_open}
    if strange := next((k for k in others if k not in keys[:-1]), ""):
        told = hint(strange, known.split(", "))
        raise mechanics.ProblemError(f"{name}: unknown {strange!r}{told}; it takes {known}")
    try:
        bound = taken.bind_partial(*given, **{k: x for k, x in named.items() if k not in others})
    except TypeError:
        raise mechanics.ProblemError(f"{name}: it takes {known}, each of them once") from None
    said = bound.arguments
    missing = [k for k, p in mine.items() if p.default is p.empty and k not in said]
    if own.word and not others and not missing:
        return own.word(*bound.args, **bound.kwargs)
    if others and any(k not in keys or k in others for k in said):
        file = ", ".join(keys[:-1])
        why = f"{next(iter(others))!r} goes with the keys of a file: give all by those, {file}"
        raise mechanics.ProblemError(f"{name}: {why}")
    if any(k not in keys for k in said):
        raise mechanics.ProblemError(f"{name}: {missing[0]!r} is missing; it takes {known}")
    return [said | others] if own.section in OF_A_BODY else said | others


OF_A_BODY = ("point", "body", "solid")
"""The sections of what a body is a sum of: their words make lists."""


def _called(function: F, name: str, doc: str | None) -> F:
    function.__name__ = function.__qualname__ = name
    function.__doc__ = doc
    return function


def Problem(
    name: str,
    group: Group | str | Table,
    body: Sequence[Table] | Table = (),
    forces: Sequence[Table] | Table = (),
    parameters: Mapping[Any, Any] | None = None,
    title: str | None = None,
    negative_mass: bool = False,
    negative_stiffness: bool = False,
    initial: Mapping[str, Any] | None = None,
) -> mechanics.Problem:
    """A problem from its tables; ``ProblemError`` says what is wrong, and a warning what may be
    meant otherwise, as moments by default that no masses have.

    ``group``: or an algebra that moves no points, or a fluid, which has nothing else. ``body``:
    points, moments, solids; or a Lagrangian that no points give, with what an algebra carries
    along; or kinematics of first order.

    ``negative_mass``, ``negative_stiffness``: may a mass, or the stiffness of a spring and the
    coefficient of a damping, be given as a negative number?  ``initial``: where motions start, by
    the names of the state and inputs, and ``exp``; events of motions stand among the ``forces``.
    """
    data: dict[str, Any] = {"name": name}
    if isinstance(group, Table):
        data[group.key] = group.fields
    else:
        data["group"] = (Group(group) if isinstance(group, str) else group).table()
    data["parameters"] = dict(_parameter(k, x) for k, x in (parameters or {}).items())
    if title is not None:
        data["title"] = title
    if initial is not None:
        data["initial"] = {k: _plain(x, f"initial, {k}") for k, x in initial.items()}
    for table in (*_tables(body), *_tables(forces)):
        if table.key in ("body", "kinematics", *SECTIONS):
            data[table.key] = table.fields
        else:
            data.setdefault(table.key, []).append(table.fields)
    read = problem_of(data, negative_mass=negative_mass, negative_stiffness=negative_stiffness)
    return warned(read)


def _tables(parts: Any) -> list[Table]:
    """The tables in nested lists of tables, or in one alone; ``ProblemError`` for anything else."""
    if isinstance(parts, Table):
        return [parts]
    if not isinstance(parts, (list, tuple)):
        raise mechanics.ProblemError(f"expected Points(…), Gravity(…) and so on, not {parts!r:.40}")
    return [table for part in parts for table in _tables(part)]


def _parameter(key: Any, about: Any) -> tuple[str, Any]:
    """The name of a parameter, of which SymPy has a Symbol, and what is said of it."""
    try:
        name = quoted.name(key) if quoted.is_sympy(key) else str(key)
        if isinstance(about, Mapping):
            return name, {k: _number(x) for k, x in about.items()}
        return name, _number(about)
    except quoted.NoExpressionError as error:
        raise mechanics.ProblemError(f"parameter {str(key)[:40]!r}: {error}") from None


def _number(x: Any) -> Any:
    return quoted.value(x) if quoted.is_sympy(x) else _plain(x, "parameters")


def _plain(x: Any, where: str) -> Any:
    """Plain data as a problem file has it: tuples and arrays as lists, fractions and expressions of
    SymPy as text; ``ProblemError`` says ``where`` one has no meaning."""
    if quoted.is_sympy(x):
        try:
            return quoted.quoted(x)
        except quoted.NoExpressionError as error:
            raise mechanics.ProblemError(f"{where}: {error}") from None
    if hasattr(x, "tolist"):
        x = x.tolist()
    if isinstance(x, Fraction):
        return str(x)
    if isinstance(x, (list, tuple)):
        return [_plain(y, where) for y in x]
    return {k: _plain(y, f"{where}, {k}") for k, y in x.items()} if isinstance(x, dict) else x


# Messages that the command line shares, in the words of Python: keywords in place of options.

KEYWORDS = {"set": "start", "lang": "languages", "column": "columns"}
"""Option → its keyword, where that has another name."""


@contextmanager
def in_keywords() -> Iterator[None]:
    """What is refused inside is told with ``dt`` for ``--dt``, ``at_defaults`` for
    ``--at-defaults``."""
    try:
        yield
    except Refused as error:
        told = re.sub(r"(?<![\w-])--([a-z]+(?:-[a-z]+)*)", _keyword, str(error))
        raise type(error)(told) from None


def _keyword(option: re.Match[str]) -> str:
    """What an option of the command line is called in Python."""
    return KEYWORDS.get(option[1], option[1].replace("-", "_"))
