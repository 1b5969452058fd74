"""What is asked of an emission: options that exclude others, heads of files, names apart."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any

from ..algebra.factor_charts import QUATERNION, factor_charts
from ..algebra.groups import Group
from ..language.limits import SLOPES, SLOPES_BY_PARAMETERS
from ..language.reserved import STANDARD_MACROS
from ..record.record import Derivation
from . import group_functions, watched_functions
from .languages import LANGUAGES, TargetLanguage
from .momentum_state import refuse
from .options import ADDED, CHOICES, DEPENDENT, REPEATED, Options
from .program import (
    Assignment,
    Check,
    EmittedFunction,
    Expression,
    Framing,
    LoweringError,
    Program,
    Section,
    refuse_first,
)
from .step import discrete_step

# The options of an emission, as every file states them and as they are read back from it.

_STATED = re.compile(r"; do not edit\.\n[\s*#/]*Options: (\w+)((?:[\s*#/]+--[a-z-]+(?: \w+)?)+)")
_OPTION = re.compile(r"--([a-z-]+)(?: (\w+))?")


@dataclass(frozen=True)
class EmissionRequest:
    """What ``derive emit`` was asked for; ``allowed``: what may be negative, as its flags say;
    ``short``: for a page, where rates are not written a second time for the stages of a step."""

    problem: str
    prefix: str
    languages: tuple[str, ...]
    options: Options = field(default_factory=Options)
    allowed: tuple[str, ...] = ()
    short: bool = False

    @property
    def words(self) -> list[str]:
        """The options as words of a command line, each with its value."""
        found = [("lang", x) for x in self.languages] + [("prefix", self.prefix)]
        found += [(name, getattr(self.options, name)) for name in CHOICES]
        found += [(name, x) for name in REPEATED for x in getattr(self.options, name)]
        found += [(name, x) for name in DEPENDENT if (x := getattr(self.options, name))]
        flags = [f"--{x}" for x in ADDED if getattr(self.options, x)]
        flags += [f"--allow-negative-{x}" for x in self.allowed]
        return [f"--{name} {x}" for name, x in found] + flags

    @property
    def option_lines(self) -> list[str]:
        """Lines of a comment: the name of the problem and every option, given or by default."""
        words = (word.replace(" ", "\0") for word in self.words)
        text = " ".join(["Options:\0" + self.problem, *words])
        lines = textwrap.wrap(text, 92, subsequent_indent="  ", break_on_hyphens=False)
        return [line.replace("\0", " ") for line in lines]


def request_of(text: str) -> EmissionRequest | None:
    """What the head of a file says of its emission; ``None`` where it says nothing of the kind."""
    stated = _STATED.search(text)
    if stated is None:
        return None
    found: dict[str, list[str]] = {}
    for name, value in _OPTION.findall(stated[2]):
        found.setdefault(name, []).append(value)
    allowed = tuple(x for x in ("mass", "stiffness") if f"allow-negative-{x}" in found)
    try:
        one: dict[str, Any] = {name: found[name][0] for name in CHOICES}
        one |= {name: name in found for name in ADDED}
        one |= {name: tuple(found.get(name, ())) for name in REPEATED}
        one |= {name: found.get(name, [""])[0] for name in DEPENDENT}
        options = Options(**one)
        prefix, languages = found["prefix"][0], tuple(found["lang"])
    except (KeyError, ValueError):
        return None
    if not {*languages} <= {*LANGUAGES}:
        return None
    return EmissionRequest(stated[1], prefix, languages, options, allowed)


# Options of an emission that exclude one another, the group or the Lagrangian: one line each.


def require_options(d: Derivation, chosen: Options, where: str, *written: str) -> None:
    """``LoweringError`` for an option that is not written where a state is no motion of a body, in
    words; but for those, and values of --jacobian, that are ``written``."""
    forms = [x for x in CHOICES if x not in ("real", "form")]
    added = ("momenta", "dynamics", "exponential", "multiplier")
    given = [
        *((y != CHOICES[x][0][0], f"--{x} {y}") for x in forms for y in [getattr(chosen, x)]),
        *((x not in written, f"--jacobian {x}") for x in chosen.jacobian),
        ("discrete" in chosen.step, "--step discrete"),
        *((getattr(chosen, x), f"--{x}") for x in added if x not in written),
    ]
    refuse_first(d.name, *((on, f"{option} is not written {where}") for on, option in given))


def require_columns(d: Derivation, chosen: Options) -> None:
    """``LoweringError`` where there is nothing to linearise in, or nothing to linearise."""
    if "inputs" in chosen.jacobian and not d.problem.get("inputs"):
        raise LoweringError(f"{d.name}: there are no inputs to linearise in")
    if "outputs" in chosen.jacobian and not d.problem.get("outputs"):
        raise LoweringError(f"{d.name}: there are no outputs to linearise; give [[output]] tables")


def require_written(d: Derivation, group: Group, chosen: Options) -> None:
    """``LoweringError`` for options that exclude one another or the group, and for a Jacobian of
    more entries than compilers manage."""
    own = d.problem.get("advected")
    rows = group.dimension * (1 if own is not None else 2) + sum(x["size"] for x in own or ())
    columns = {
        "state": (rows, SLOPES),
        "parameters": (len(d.problem["parameters"]), SLOPES_BY_PARAMETERS),
    }
    for by, (width, most) in columns.items():
        if by in chosen.jacobian and rows * width > most:
            raise LoweringError(
                f"{d.name}: --jacobian {by} is a matrix of {rows * width} entries on {group.name}, "
                f"of dimension {group.dimension}; compilers manage {most}: leave it out"
            )
    require_columns(d, chosen)
    _refused_forms(d, group, chosen)
    if chosen.multiplier and d.definition("θ") is None:
        raise LoweringError(
            f"{d.name}: --multiplier is for a group with one relation, as SL(n) or SAff(n) that "
            f"keep volumes; {group.name} has none or several: leave it out"
        )
    if chosen.frame == "principal":
        _refused_in_frame(d, chosen)
    if chosen.momenta:
        refuse(d, group, chosen)
    if chosen.dynamics:
        watched_functions.refuse(d)
    if chosen.exponential:
        group_functions.refuse(d, group, chosen)
    if "discrete" in chosen.step:
        discrete_step.refuse(d, group, chosen)
    if chosen.attitude != "matrix":
        _refused_with_charts(d, group, chosen)


def _refused_in_frame(d: Derivation, chosen: Options) -> None:
    """What is written for a body as it is given."""
    if name := next((x for x in ("multiplier", "conserved") if getattr(chosen, x)), ""):
        raise LoweringError(
            f"{d.name}: --{name} is written in the frame of the parameters: leave out --frame"
        )
    if "parameters" in chosen.jacobian:
        raise LoweringError(
            f"{d.name}: the principal frame is not smooth in the parameters; "
            "linearise in them without --frame"
        )


NEEDED = {
    "quaternion": "a quaternion needs a factor SO(3) or SE(3)",
    "angle": "an angle needs a factor that turns a plane, or one of one parameter that turns, "
    "translates, or scales by rational eigenvalues, integer multiples of the least",
    "shortest": "--attitude shortest needs a factor SO(3), SE(3), SO(2), SE(2), or one of one "
    "parameter that turns, translates, or scales by integer multiples of one rational eigenvalue",
}
"""What there must be for a value of --attitude."""


def _refused_with_charts(d: Derivation, group: Group, chosen: Options) -> None:
    """What is written for a state with the entries of every factor."""
    charts = factor_charts(group.in_user_basis, chosen.attitude)
    if not charts:
        raise LoweringError(f"{d.name}: {NEEDED[chosen.attitude]}, not {group.name}")
    quaternions = all(x.kind == QUATERNION for x in charts.values())
    what = "a quaternion" if quaternions else "an angle"
    if chosen.velocity == "tangent":
        raise LoweringError(f"{d.name}: {what} goes with the velocity of the body, not tangent")
    if chosen.layout == "col" and len(charts) == len(group.places):
        raise LoweringError(f"{d.name}: with {what} there is no matrix to lay out by columns")
    if chosen.frame == "principal" and not quaternions:
        raise LoweringError(f"{d.name}: {what} is of the body as given: leave out --frame")


def _refused_forms(d: Derivation, group: Group, chosen: Options) -> None:
    """``LoweringError`` for an option that is not written for a state of this form."""
    lagrangian = d.problem.get("lagrangian", {})
    right = lagrangian.get("trivialisation") == "right"
    charts = factor_charts(group, chosen.attitude).values() if right else ()
    tangent = (chosen.velocity == "tangent", "--velocity tangent")
    attitude = f"--attitude {chosen.attitude}"
    of_element = (chosen.attitude != "matrix", attitude), (chosen.layout == "col", "--layout col")
    turned = (any(x.kind == QUATERNION for x in charts), attitude)
    forms: tuple[tuple[object, str, tuple[tuple[object, str], ...]], ...] = (
        (
            "advected" in d.problem,
            "a state with an element of the group, and [algebra] has none",
            (tangent, *of_element, (chosen.state == "moving", "--state moving")),
        ),
        (
            lagrangian.get("held"),
            "motions on the whole group, and these are on a quotient of it",
            (tangent,),
        ),
        (
            right,
            "Z = g^-1 dg/dt, and this Lagrangian is trivialised on the right",
            (tangent, turned),
        ),
    )
    for has_it, why, options in forms:
        refuse_first(d.name, *((has_it and on, f"{option} is for {why}") for on, option in options))


# Emitted names kept apart from the identifiers that a language's templates use themselves.
#
# The words of a template are not listed anywhere: a program of the same form, but with nothing in
# it, is emitted, and what identifiers that text has are its own.

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
