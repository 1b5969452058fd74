"""How the languages of the emitted code write what is read of it, and its words, one by one.

One grammar serves all: names, numbers, + − * /, calls and brackets.  A table says how a language
writes comments, declarations, functions and arrays; heads of functions are made from their contract
and compared word by word.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import NamedTuple

from .terms import plain_text

CONTRACT = {
    "constants": ("p", "k"),
    "inertia": ("p", "value"),
    "rhs": ("t x k u", "dx"),
    "rhs_batch": ("n t x k u", "dx"),
    "energy": ("t x k", ""),
    "multiplier": ("t x k u", ""),
    "conserved": ("t x k", "out"),
    "outputs": ("t x k u", "out"),
    "step_momentum": ("x k", "out"),
    "step_force": ("t x k u", "out"),
    "step_velocity": ("x k q", "out"),
    "step_guess": ("x k q", "out"),
    "step_begin": ("x k q", "out"),
    "step_newton": ("x k b q v", "out"),
    "step_turn": ("v s", "out"),
    "step_turn_little": ("v s", "out"),
    "step_end": ("x k q v", "out"),
    "mass_matrix": ("t x k", "D"),
    "bias": ("t x k u", "out"),
    "inverse": ("t x k dzeta", "Q"),
    "project": ("x", "out"),
    "defect": ("x", ""),
    "to_matrix": ("x", "out"),
    "from_matrix": ("z", "out"),
    "jacobian": ("t x k u", "dx D"),
    "jacobian_inputs": ("t x k u", "D"),
    "error_generator": ("t x k u", "D"),
    "error_noise": ("t x k u", "D"),
    "jacobian_raw": ("t x k u", "D"),
    "jacobian_parameters": ("t x p u", "D"),
    "jacobian_raw_inputs": ("t x k u", "D"),
    "jacobian_project": ("x", "D"),
    "variations": ("x", "D"),
    "jacobian_outputs": ("t x k u", "D"),
    "jacobian_outputs_inputs": ("t x k u", "D"),
    "jacobian_outputs_raw": ("t x k u", "D"),
    "momentum": ("t x k", "out"),
    "velocity": ("t y k", "out"),
    "velocity_step": ("t x y k", "out"),
    "momentum_rhs": ("t y k u", "dy"),
    "momentum_rates": ("t x y k u", "dy"),
    "poisson": ("t y k", "out"),
}
"""Function → what it takes, in order, and the arrays that it writes, or one number is returned."""

Heads = Callable[[str, str, list[str], list[str]], list[str]]
"""(function, prefix of the file, what it takes, what it writes) → its possible heads.

In these and other patterns words are apart; ``real`` is a type of real numbers, ``size`` an
integer or the name of a size, ``…`` whatever stands up to the end of a bracket.
"""


@dataclass(frozen=True)
class Syntax:
    """How a language writes what is read.

    ``lines``: does the end of a line, outside of brackets, end a statement?
    ``body``: what stands around the statements of a function; an indent, where the second is empty.
    ``declaration``: what stands before the name of a constant, ``typed`` a type after it.
    ``reals``: the types of real numbers, double and float; ``suffix``: in the decimals of float.
    ``calls``: what stands before an elementary function; ``absolute``: what |x| is called.
    ``zero``: around an expression that is 1 where it is 0; ``integrals``: around the name of a
    function of integrals.  ``lists``: what begins a list of numbers.  ``ignored``: statements
    without effect, with ``argument`` for one that the function has.  ``first``: the index of the
    first entry.
    """

    heads: Heads
    comment: str
    body: tuple[str, str]
    reals: tuple[str, str]
    declaration: str = ""
    typed: str = ""
    suffix: str = ""
    lines: bool = False
    calls: str = ""
    absolute: str = "abs"
    zero: tuple[str, str] = ("", "")
    integrals: tuple[str, str] = ("", "(")
    lists: tuple[str, ...] = ("[",)
    ignored: tuple[str, ...] = ()
    first: int = 0


def _c_heads(f: str, prefix: str, takes: list[str], writes: list[str]) -> list[str]:
    kinds = {"t": "real t", "n": "size_t n"}
    arguments = [kinds.get(x, f"const real * {x}") for x in takes]
    arguments += [f"real * {x}" for x in writes]
    returned = "int" if f == "constants" else "void" if writes else "real"
    return [f"{returned} {prefix}_{f} ( {' , '.join(arguments)} )"]


def _python_heads(f: str, prefix: str, takes: list[str], writes: list[str]) -> list[str]:
    """Functions of the state have the arguments of ``rhs``, with y beside x or in its place."""
    del prefix, writes
    if "t" in takes or takes == ["x"]:
        state = [x for x in takes if x in "xy"]
        last = "dzeta" if "dzeta" in takes else "u"
        takes = ["t", *state, "p" if "p" in takes else "k", last]
    if f == "step_force":
        takes = [*"txku"]
    return [f"def _{f} ( {' , '.join(['xp', *takes])} )"]


def _rust_heads(f: str, prefix: str, takes: list[str], writes: list[str]) -> list[str]:
    del prefix
    plain = [f"{x} : real" if x == "t" else f"{x} : & [ real ; … ]" for x in takes]
    written = [*plain, *(f"{x} : & mut [ real ; … ]" for x in writes)]
    head = f"fn {f} ( {' , '.join(plain)} ) ->"
    if f == "constants":
        return [f"{head} Result < [ real ; … ] , Refused >"]
    if not writes:
        return [f"{head} real"]
    return [f"{head} [ real ; … ]", f"fn {f} ( {' , '.join(written)} )"]


def _julia_heads(f: str, prefix: str, takes: list[str], writes: list[str]) -> list[str]:
    """What is written stands first, the time last."""
    del prefix
    inputs = " ; u = nothing" if "u" in takes else ""
    takes = [x for x in takes if x != "u"]
    if writes and f != "constants":
        f, takes = f"{f}!", [*writes, *sorted(takes, key=lambda x: x == "t")]
    return [f"function {f} ( {' , '.join(takes)}{inputs} )"]


def _javascript_heads(f: str, prefix: str, takes: list[str], writes: list[str]) -> list[str]:
    del prefix
    arguments = ["u = null" if x == "u" else x for x in takes]
    arguments += [f"{x} = new real ( size )" for x in writes if f != "constants"]
    return [f"function {f} ( {' , '.join(arguments)} )"]


SLASHES = r"/\*.*?\*/|//[^\n]*"
SYNTAX: Mapping[str, Syntax] = {
    "c": Syntax(
        _c_heads,
        SLASHES,
        ("{", "}"),
        ("double", "float"),
        declaration="const real",
        suffix="f",
        absolute="fabs",
        integrals=("{prefix}_", "("),
        lists=(),
        ignored=("( void ) argument ;",),
    ),
    "python": Syntax(
        _python_heads,
        r"#[^\n]*",
        (":", ""),
        ("", ""),
        lines=True,
        calls="xp .",
        zero=("_is_zero ( xp ,", ")"),
        integrals=("_", "( xp ,"),
        lists=("[", "("),
    ),
    "rust": Syntax(
        _rust_heads,
        r"//[^\n]*",
        ("{", "}"),
        ("f64", "f32"),
        declaration="let",
        typed=": real",
        zero=("real :: from ( u8 :: from (", "== 0.0 ) )"),
        ignored=("let _ = argument ;",),
    ),
    "julia": Syntax(
        _julia_heads,
        r"#(?!=)[^\n]*",
        ("", "end"),
        ("", ""),
        suffix="f",
        lines=True,
        zero=("iszero (", ")"),
        lists=("(",),
        ignored=("u = u === nothing ? ZERO_INPUTS : u",),
        first=1,
    ),
    "javascript": Syntax(
        _javascript_heads,
        SLASHES,
        ("{", "}"),
        ("Float64Array", "Float32Array"),
        declaration="const",
        calls="Math .",
        absolute="Math . abs",
        zero=("Number (", "=== 0 )"),
        lists=("[", "real . of ("),
        ignored=("u ??= ZERO_INPUTS ;",),
    ),
}


class Token(NamedTuple):
    """A word, a number, a string, a sign, or the end of a line that ends a statement; ``column``:
    of the first in a line, else ``None``; ``line`` and ``file``: where it stands."""

    text: str
    column: int | None
    line: int
    file: str


END = "\n"
"""The text of a token that ends a statement."""
SIGNS = "??= === !== ... == != <= >= && || :: -> => += -= *= /= ++ -- ** .."
LEXEMES = "|".join(
    (
        r'"""(?:[^"\\]|\\.|"(?!""))*"""',
        r'"(?:[^"\\\n]|\\.)*"',
        r"\.?[0-9](?:[eEfFpP][+-](?=[0-9])|\w|\.(?!\.))*",
        r"[A-Za-z_]\w*(?:!(?!=))?",
        *map(re.escape, SIGNS.split()),
        r"\S",
    )
)
GOES_ON = ("=", ",", "&&", "||", "+", "-", "*", "/")
"""A line that ends so goes on, where lines end statements."""


def tokens(syntax: Syntax, text: str, file: str) -> Iterator[Token]:
    """The words of a file; ``CodeError`` for what not all readers take alike."""
    plain_text(text)
    found = re.compile(f"(?P<comment>{syntax.comment})|(?P<end>\n)|{LEXEMES}", re.DOTALL | re.ASCII)
    depth, start, line, last = 0, 0, 1, END
    for m in found.finditer(text):
        word = m[0]
        first = not text[start : m.start()].strip()
        if m["comment"] is None and m["end"] is None:
            yield Token(word, m.start() - start if first else None, line, file)
            depth += (word in ("(", "[", "{")) - (word in (")", "]", "}"))
            last = word
        elif m["end"] and syntax.lines and not depth and last not in (END, *GOES_ON):
            yield Token(END, None, line, file)
            last = END
        if lines := word.count("\n"):
            line, start = line + lines, m.end() - len(word) + word.rindex("\n") + 1
