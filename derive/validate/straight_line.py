"""The requirement that emitted functions are straight-line programs.

A proof at random points needs one rational function everywhere; a branch could be one thing at the
points that are tried and another elsewhere. A size |x| or a comparison may serve the checks of
``constants``, ``defect`` is a sum of sizes, and ``from_matrix`` asks for signs.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from .terms import Body, CodeError, CodeFunction

REFUSED = (1, 2)
"""What ``constants`` returns of a body with a singular mass matrix, or with numbers that are not
finite."""
SIGNED = "from_matrix"
"""The function that may ask for signs: it is tried with each choice of them."""
UNSMOOTH = ("abs", "gt", "lt", "le", "eq", "not")


def require_straight_line(f: CodeFunction) -> None:
    """``CodeError`` unless what a function gives depends on no size and no condition."""
    tainted: set[str] = set()
    body = f.body
    if f.name == SIGNED:
        if any(s[0] in ("if", "for") for s in body):
            raise CodeError(f"{f.name}: what it computes is under a condition")
        return
    if f.name == "defect":
        body = summands(f).body
    if f.name == "project":
        stored = [s[0] == "store" for s in body]
        if stored != sorted(stored) or any(_read(s[3]) for s in body if s[0] == "store"):
            raise CodeError("project: it reads after it has written, so it cannot work in place")
    _body(f, body, tainted, [])


def _read(e: Any) -> bool:
    """Does an expression read an array?"""
    return isinstance(e, tuple) and (e[:1] == ("at",) or any(map(_read, e)))


def tested_parameters(f: CodeFunction) -> set[int]:
    """The places in p of the parameters that a function tests for being 0, a branch that is tried
    separately.

    ``CodeError`` where it tests anything else.
    """
    if f.name == SIGNED:
        return set()
    places: dict[str, int] = {}
    found: set[int] = set()

    def visit(e: Any) -> None:
        if isinstance(e, tuple) and e:
            if e[0] == "none":
                if e[1][0] != "var" or e[1][1] not in places:
                    raise CodeError(f"{f.name}: it asks whether something is 0, and no parameter")
                found.add(places[e[1][1]])
            for x in e:
                visit(x)

    for s in f.body:
        if s[0] == "set" and s[2][:2] == ("at", "p") and s[2][2][0] == "int":
            places[s[1]] = s[2][2][1]
        elif s[0] == "unpack" and s[2] == "p":
            places |= {name: i for i, name in enumerate(s[1])}
        visit(s)
    return found


def summands(f: CodeFunction) -> CodeFunction:
    """The function that returns a, b, … in the place of |a| + |b| + …, so that none can hide
    another; ``CodeError`` where it returns no such sum."""
    body, last = f.body[:-1], f.body[-1:]
    if not last or last[0][0] != "return":
        raise CodeError(f"{f.name}: it does not end with a sum of sizes")
    return replace(f, body=(*body, ("return", ("list", *_sizes(f, last[0][1])))))


def _sizes(f: CodeFunction, e: Any) -> list[Any]:
    """The operands a, b, … of a sum |a| + |b| + …."""
    if e[0] == "list" and len(e) == 2:
        return _sizes(f, e[1])
    if e[0] == "add":
        return [x for y in e[1:] for x in _sizes(f, y)]
    if e[0] != "abs":
        raise CodeError(f"{f.name}: it is no sum of sizes")
    return [e[1]]


def error_checks(f: CodeFunction) -> Body:
    """What in a function serves its checks alone: conditions, what depends on sizes, and what is
    named when all results are stored."""
    tainted: set[str] = set()
    stored = [i for i, s in enumerate(f.body) if s[0] == "store"]
    found = []
    for i, s in enumerate(f.body):
        if s[0] == "set" and _unsmooth(s[2], tainted):
            tainted.add(s[1])
        named = s[0] == "set" and (s[1] in tainted or i > max(stored, default=-1))
        if named or s[0] in ("if", "for", "return"):
            found.append(s)
    return tuple(found)


def _body(f: CodeFunction, body: Body, tainted: set[str], checks: list[str]) -> None:
    """Check statements; ``tainted``: the names that depend on a size or a condition, ``checks``:
    the conditions met so far."""
    for s in body:
        if s[0] == "if":
            refused = [(("return", ("int", code)),) for code in REFUSED]
            if f.name != "constants" or s[2] not in refused:
                raise CodeError(f"{f.name}: what it computes is under a condition")
            checks.append(s[0])
        elif s[0] == "for":
            _body(f, s[3], tainted, checks)
        elif s[0] == "set" and _unsmooth(s[2], tainted):
            tainted.add(s[1])
        elif s[0] == "store" and (checks or _unsmooth(s[2:], tainted)):
            raise CodeError(f"{f.name}: {s[1]} depends on a size or on a condition")
        elif s[0] == "return" and _unsmooth(s[1:], tainted):
            raise CodeError(f"{f.name}: what it returns depends on a size or on a condition")


def _unsmooth(e: Any, tainted: set[str]) -> bool:
    """Does an expression depend on a size or on a condition?"""
    if not isinstance(e, tuple) or not e:
        return False
    if e[0] in UNSMOOTH or (e[0] == "var" and e[1] in tainted):
        return True
    return any(_unsmooth(x, tainted) for x in e)
