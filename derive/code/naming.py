"""Names for emitted values: what the paper calls them, in letters that every language has; and
what a problem file says, in comments of emitted files: plain ASCII, by the names typed there.
"""

from __future__ import annotations

import keyword
import re
import sys
import unicodedata
from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import Any

from ..algebra.groups import Group, names_by_block
from ..language.reserved import SPELT, WORDS, suffixed
from ..language.show import show
from ..language.tree import Tree, mul, plain, sized
from ..record.as_json import decode

MEANINGS = {
    "Ω": "omega", "θ": "multiplier", "γ": "gravity", "μ": "moment", "β": "load", "σ": "tension",
    "χ": "reach", "κ": "damping", "Π": "momentum", "Φ": "force", "𝕁": "poisson", "ℓ": "spin",
}  # fmt: skip
"""What letters of the walk stand for; other Greek letters have their names."""
WORD_OF = SPELT | MEANINGS | {"\u0307": "_dot", "\u0303": "_tilde", "′": "_prime"}
"""Letter or mark → its word in a name."""
_LOCAL = "D axes dx frame i k n out p s t u x xp"
_EMITTED = """
    abs all importlib numpy math regular std NULL STATE PARAMETERS INPUTS CONSTANTS DEFAULTS BASIS
    ZERO_INPUTS ZEROS Singular NotFinite Refused N_STATE N_ALGEBRA N_PARAMETERS N_CONSTANTS N_INPUTS
    core Base Core Main constants energy driven project defect iszero
    """
_RUST = """
    abstract as async await become box break const continue crate do dyn else enum extern false
    final fn for gen if impl in let loop macro match mod move mut override priv pub ref return self
    Self static struct super trait true try type typeof unsafe unsized use virtual where while yield
    Some Ok Err
    """
_JULIA = """
    abstract baremodule begin break catch const continue do else elseif end export false finally for
    function global if import isa let local macro module outer primitive quote return struct true
    try type using while
    nothing undef eltype promote_type Vector Float64 Float32 DomainError
    """
_JAVASCRIPT = """
    arguments debugger eval extends function implements instanceof interface let null package super
    var Math Float64Array Float32Array Number RangeError
    """
_CHARACTERS = "char8_t char16_t char32_t"
_WORDS = {*WORDS, *f"{_RUST} {_JULIA} {_JAVASCRIPT} {_CHARACTERS}".split()}
RESERVED = _WORDS | set(_LOCAL.split())
"""Names that no value of a program has: words of some language, arrays and loops of all.

What else the text of one language uses, ``collisions.py`` finds there.
"""
_HEADERS = """
    assert complex ctype errno features fenv float inttypes iso646 limits locale malloc math memory
    sched setjmp signal stdalign stdarg stdatomic stdbool stddef stdint stdio stdlib stdnoreturn
    string strings tgmath threads time uchar unistd wchar wctype
    """
_PYTHON = "a keyword of Python"
PREFIXES = {
    "c": dict.fromkeys(_HEADERS.split(), "a header of C")
    | dict.fromkeys(_CHARACTERS.split(), "a keyword of C++")
    | {x: what for x, what in WORDS.items() if what != _PYTHON},
    "python": dict.fromkeys(sys.stdlib_module_names, "a module of Python")
    | dict.fromkeys(keyword.kwlist, _PYTHON),
    "rust": dict.fromkeys(_RUST.split(), "a word of Rust"),
    "julia": dict.fromkeys(_JULIA.split(), "a word of Julia"),
}
"""Language → names that no prefix is there, and what they are: words, and headers of C or modules
of Python, before which the emitted file would stand."""


def taken_prefix(prefix: str, languages: Iterable[str] = tuple(PREFIXES)) -> str:
    """What a prefix is in some language, so that it cannot be used there; "" for a free one."""
    if prefix in _EMITTED.split():
        return "a name of the emitted code itself"
    return next((what[prefix] for x in languages if prefix in (what := PREFIXES.get(x, {}))), "")


def own_prefix(name: str) -> str:
    """The prefix of code that is emitted to be run at once, whatever the problem is called."""
    return f"{name}_" if taken_prefix(name) else name


def ascii_name(name: str) -> str:
    """The name in ASCII: ``ζ̇`` as ``zeta_dot``, ``I_c`` as ``I_c``; signs are dropped."""
    out = ""
    for ch in unicodedata.normalize("NFD", name):
        kept = ch if ch.isascii() and (ch.isalnum() or ch == "_") else ""
        out += WORD_OF.get(ch, kept)
    return out


def name_of(t: Tree) -> str:
    """A name for an unnamed value, from the tree that makes it: ``inv_J``, ``A_T_gravity``."""
    if isinstance(t, str):
        return ascii_name(t)
    if not isinstance(t, tuple):
        return ""
    if t[0] == "at":
        return "_".join(ascii_name(str(x)) for x in t[1:])
    if t[0] == "add":
        return "sum"
    if (measured := sized(t)) is not None:
        return f"size_{name_of(measured)}".rstrip("_")
    if t[0] == "fun":
        return f"{t[1]}_{name_of(t[2])}".rstrip("_")
    if t[0] in ("par", "entry"):
        return "_".join(name_of(x) or str(x) for x in t[1:])
    op = "inner" if t[0] == "metric" else t[0]
    prefix = [op] * (op in ("inv", "tr", "hat", "inner", "norm2"))
    suffix = ["T"] if t[0] == "T" else [str(t[2])] if t[0] == "pow" else []
    inside = [name_of(x) for x in t[1:] if not (t[0] == "pow" and x == t[2])]
    sign = ["x"] * (t[0] == "wedge")
    body = [inside[0], *sign, *inside[1:]] if inside else []
    return "_".join(x for x in (*prefix, *body, *suffix) if x)


def sum_name(coefficients: Sequence[Fraction], names: Sequence[str]) -> str:
    """``a_plus_b``, ``a_minus_b``, ``a_minus_2_b`` for a sum of two; empty where none is true."""
    terms = sorted(zip(coefficients, names, strict=True), key=lambda term: term[0] != 1)
    if len(terms) != 2:
        return ""
    (first, a), (second, b) = terms
    if first != 1 or second.denominator != 1 or (second != 1 and is_sum(b)):
        return ""
    times = "" if abs(second) == 1 else f"{abs(second)}_"
    return f"{a}_{'plus' if second > 0 else 'minus'}_{times}{b}"


def is_sum(name: str) -> bool:
    """Is it the name of a sum, which a prefix or suffix would seem to apply to in part?"""
    return "_plus_" in name or "_minus_" in name


class ClaimedNames:
    """The names taken in one program; a second owner of one gets it with an underscore."""

    def __init__(self) -> None:
        self._taken = dict.fromkeys(RESERVED, "")

    def claim(self, wanted: str, owner: str) -> str:
        """The name for an owner (the same owner gets the same name)."""
        name = wanted
        while self._taken.setdefault(name, owner) != owner:
            name += "_"
        return name


LONGEST_LAW = 200
"""Letters of the law of a force in a head; where it has more, the head says that there is one."""


def plain_text(text: str) -> str:
    """An expression as it may stand in an ASCII comment: 1/4 for the one letter, pi, ^2, v_1."""
    text = re.sub("[₀-₉]+", r"_\g<0>", text)
    text = re.sub("[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+", lambda x: "^" + x[0].replace("⁻", "-"), text)
    spelt = str.maketrans(SPELT | {"\u2212": "-", "·": "*"})
    return unicodedata.normalize("NFKD", text.translate(spelt)).replace("\u2044", "/")


def law(components: Sequence[Any], group: Group | None = None) -> str:
    """The components of a vector, or of a force of the state, by the names of the problem file."""
    trees = [typed(decode(y, "law"), group) for y in components]
    text = ", ".join(plain_text(show(x)) for x in trees)
    return f" ({text})" if text.isascii() and len(text) <= LONGEST_LAW else ""


def typed(t: Tree, group: Group | None) -> Tree:
    """Entries as names: those of the velocity of the place as v_1, of A as A_12, in the second
    block of a product as A2_12 or T2_1, of Z as the coordinate that it is, zeta2_1 or w2_1."""
    if not isinstance(t, tuple):
        return t
    if t[0] != "entry":
        parts = [typed(x, group) for x in t[1:]]
        return mul(*parts) if t[0] == "mul" else (t[0], *parts)  # the signs of both are one
    letter, row, *more = t[1:]
    if isinstance(
        letter, tuple
    ):  # of a place: r of ("call", ("at", "r", i), "t"), v of ("at", "v", i)
        head = letter[1][1] if letter[0] == "call" else letter[1]
        return ("par", suffixed(plain_text(head), row_of_block(group, row)))
    if group and letter == "A" and group.factors:
        return ("par", _of_block(group, row, *more))
    if group and letter == "Z" and (found := _coordinate(group, row, *more)):
        return found
    name = suffixed(plain_text(letter), row, *more)
    return ("par", names_by_block(group).get(name, name) if group else name)


def _block(group: Group | None, row: int) -> tuple[int, int, Group | None]:
    """The block, from 1, in which a row is, how many rows are before it, and its factor."""
    places = group.places if group and group.factors else [(0, group)]
    return [(k, x, y) for k, (x, y) in enumerate(places, 1) if x < row][-1]


def row_of_block(group: Group | None, row: int) -> int:
    """A row of its block, from 1, for one of all of the space of a product."""
    return row - _block(group, row)[1]


def _of_block(group: Group, row: int, column: int) -> str:
    """An entry of g by the letters of its block."""
    k, before, factor = _block(group, row)
    mark = str(k) if len(group.factors) > 1 else ""
    if factor and factor.affine and column == before + factor.n + 1:
        return suffixed(f"T{mark}", row - before)
    return suffixed(f"A{mark}", row - before, column - before)


def _coordinate(group: Group, row: int, column: int) -> Tree | None:
    """The entry of Z by the only coordinate that is a multiple of it alone, if one is."""
    for a in range(group.dimension):
        for x, i, j in group.coordinate_terms(a)[:1]:
            if (i, j) == (row - 1, column - 1) and len(group.coordinate_terms(a)) == 1:
                name = suffixed("zeta", a + 1)
                name = names_by_block(group).get(name, name)
                return mul(plain(Fraction(1) / x), ("par", name))
    return None
