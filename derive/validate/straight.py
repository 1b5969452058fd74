"""What a proof at random points needs: one rational function everywhere.

A size |x| or a comparison may serve the checks of ``constants``, nothing else: it could be one
thing at the points that are tried and another elsewhere.
"""

from __future__ import annotations

from typing import Any

from .terms import Body, CodeError, Function

REFUSED = (1, 2)
"""What ``constants`` returns of a body that is singular, or not finite."""
UNSMOOTH = ("abs", "gt", "lt", "le", "eq", "not")


def straight(f: Function) -> None:
    """``CodeError`` unless what is written and returned depends on no size and no condition."""
    tainted: set[str] = set()
    _body(f, f.body, tainted, [])


def _body(f: Function, body: Body, tainted: set[str], checks: list[str]) -> None:
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
    if not isinstance(e, tuple) or not e:
        return False
    if e[0] in UNSMOOTH or (e[0] == "var" and e[1] in tainted):
        return True
    return any(_unsmooth(x, tainted) for x in e)
