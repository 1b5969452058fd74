"""Emitted names kept apart from the identifiers that a language's templates use themselves.

The words of a template are not listed anywhere: a program of the same form, but with nothing in it,
is emitted, and what identifiers that text has are its own.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Any

from ..language.reserved import STANDARD_MACROS
from .languages import TargetLanguage
from .program import Assignment, Check, EmittedFunction, Expression, Framing, Program, Section

NAMELESS = "·"
"""Stands for every name of the empty program: no identifier of any language."""

_STRING = r'(?<![A-Za-z])"(?:[^"\\\n]|\\.)*"'
"""A string literal; not one with a letter before it, as an f-string holds names."""
_OF_C = re.compile(rf"/\*(?s:.*?)\*/|//.*|#\s*include.*|{_STRING}")
"""Comments, strings and includes of a language whose comments are those of C or C++."""
_IDENTIFIER = re.compile(r"(?<!\w)(?<!(?<!\.)\.)[^\W\d]\w*")
"""A name; not after a single dot (a member is no name by itself), but after ``...``."""

ONE = Fraction(1)


def identifiers(text: str, language: TargetLanguage) -> set[str]:
    """The reserved words of a language, and what names a text of it has beside comments, strings.

    For C also the macros of the standard headers that a user may include before the emitted one.
    """
    own = {*_IDENTIFIER.findall(_silent(language).sub(" ", text)), *language.reserved.split()}
    return own | STANDARD_MACROS if "c" in (language.name, language.needs) else own


def _silent(language: TargetLanguage) -> re.Pattern[str]:
    """What no name is read in: comments, strings, includes."""
    sign = language.comment[0].strip()
    if sign in ("/*", "//"):
        return _OF_C
    return re.compile(rf'"""(?s:.*?)"""|{_STRING}|{re.escape(sign)}.*')


def hollowed(p: Program) -> Program:
    """The program with its names replaced by NAMELESS and its statements dropped: its text is the
    templates' own. Each function still reads the same arrays, calls the same elementary functions
    and has as many results."""
    called = sorted({name for f in p.all_functions() for name in f.calls()})
    calls: list[Expression] = [("fun", name, ONE) for name in called]
    first: Expression = ("add", ("abs", ONE), *calls)

    def emptied(f: EmittedFunction) -> EmittedFunction:
        arrays = {x.array: replace(x, name=NAMELESS) for x in f.loads}
        return EmittedFunction(
            tuple(arrays.values()),
            (Section("", "", (Assignment(NAMELESS, first),)),) * bool(f.sections),
            (ONE,) * len(f.outputs),
            tuple(Check(ONE, None if c.scale is None else ONE) for c in f.checks),
        )

    return replace(
        _each(p, emptied),
        title="",
        conventions=(),
        state=(NAMELESS,) * len(p.state),
        inputs=(NAMELESS,) * len(p.inputs),
        constants=(NAMELESS,) * len(p.constants),
        parameters=tuple((NAMELESS, x[1], "", "") for x in p.parameters),
    )


def without_collisions(p: Program, words: Iterable[str], *, caseless: bool = False) -> Program:
    """The program with an underscore added to every loaded or computed name in ``words``.

    ``caseless``: names that differ by capitals alone are the same; the later one gets underscores.
    """
    key = str.lower if caseless else str
    functions = p.all_functions()
    # the time is an argument, whose name the templates give
    own = dict.fromkeys(x.name for f in functions for x in f.loads if x.array != "t")
    own |= dict.fromkeys(v.name for f in functions for s in f.sections for v in s.values)
    taken, clash = {*map(key, words)}, []
    for name in own:
        if key(name) in taken:
            clash.append(name)
        elif caseless:
            taken.add(key(name))
    taken |= {*map(key, own)}
    new = {}
    for name in clash:
        other = name
        while key(other) in taken:
            other += "_"
        taken.add(key(other))
        new[name] = other
    return _each(p, lambda f: _renamed(f, new)) if new else p


def _each(p: Program, change: Any) -> Program:
    """The program with ``change(f)`` in place of each of its functions f."""
    framing = p.framing and Framing(
        tuple((n, change(f)) for n, f in p.framing.matrices), change(p.framing.numbers)
    )
    changed = {name: change(f) for name, f in p.functions.items()}
    return replace(p, functions=changed, framing=framing)


def _renamed(f: EmittedFunction, new: Mapping[str, str]) -> EmittedFunction:
    """The function with its names replaced by ``new``, in loads, sections, outputs, checks."""

    def expression(e: Expression) -> Expression:
        if isinstance(e, str):
            return new.get(e, e)
        if not isinstance(e, tuple):
            return e
        head = 2 if e[0] == "fun" else 1
        return (*e[:head], *map(expression, e[head:]))

    def check(c: Check) -> Check:
        return Check(expression(c.value), None if c.scale is None else expression(c.scale))

    def section(s: Section) -> Section:
        values = (Assignment(new.get(v.name, v.name), expression(v.expression)) for v in s.values)
        return replace(s, values=tuple(values))

    return replace(
        f,
        loads=tuple(replace(x, name=new.get(x.name, x.name)) for x in f.loads),
        sections=tuple(map(section, f.sections)),
        outputs=tuple(map(expression, f.outputs)),
        checks=tuple(map(check, f.checks)),
    )
