"""Names: words that one must not be, names that a wrong one may stand for, Greek, suffixes."""

from __future__ import annotations

import difflib
import keyword
import re
import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from itertools import takewhile
from typing import Any

# Words that a name of the user must not be: keywords of C, C++ and Python, names of math.h.

_C = """
    auto bool break case char const constexpr continue default do double else enum extern false
    float for goto if inline int long nullptr register restrict return short signed sizeof static
    static_assert struct switch thread_local true typedef typeof union unsigned void volatile while
    """
_CPP = """
    alignas alignof and and_eq asm bitand bitor catch class compl concept consteval constinit
    const_cast co_await co_return co_yield decltype delete dynamic_cast explicit export friend
    mutable namespace new noexcept not not_eq operator or or_eq private protected public
    reinterpret_cast requires static_cast template this throw try typeid typename using virtual
    wchar_t xor xor_eq
    """
_MATH = """
    acos asin atan atan2 cos sin tan acosh asinh atanh cosh sinh tanh exp exp2 expm1 frexp ilogb
    ldexp log log10 log1p log2 logb modf scalbn scalbln cbrt fabs hypot pow sqrt erf erfc lgamma
    tgamma ceil floor nearbyint rint lrint llrint round lround llround trunc fmod remainder remquo
    copysign nan nextafter nexttoward fdim fmax fmin fma
    """
_MACROS = """
    isfinite isinf isnan isnormal signbit fpclassify isgreater isless isunordered signgam
    M_E M_LOG2E M_LOG10E M_LN2 M_LN10 M_PI M_PI_2 M_PI_4 M_1_PI M_2_PI M_2_SQRTPI M_SQRT2 M_SQRT1_2
    NULL HUGE_VAL INFINITY NAN FP_NAN FP_INFINITE FP_ZERO FP_NORMAL FP_SUBNORMAL math_errhandling
    """

STANDARD_MACROS = {
    "I",
    "EOF",
    "assert",
    "complex",
    "errno",
    "imaginary",
    "stderr",
    "stdin",
    "stdout",
}
"""Macros of complex.h, stdio.h, errno.h and assert.h, in lower case or of few letters."""

_FUNCTIONS = [name + suffix for name in _MATH.split() for suffix in ("", "f", "l")]

WORDS: dict[str, str] = (
    dict.fromkeys(("linux", "unix"), "a macro of C compilers")
    | dict.fromkeys([*_FUNCTIONS, *_MACROS.split()], "a name of C's math.h")
    | dict.fromkeys(keyword.kwlist, "a keyword of Python")
    | dict.fromkeys(_CPP.split(), "a keyword of C++")
    | dict.fromkeys(_C.split(), "a keyword of C")
)
"""The words that no emitted name may be, each with what it is."""

PLACE = re.compile(r"r(0|[1-9][0-9]{0,3})_(?:([xyz])|([0-9]))")
"""A coordinate of a point in space, as an expression names it: r1_x, r2_1."""
CONSTANTS = {"t": "the time", "pi": "the number π"}
"""Names with a meaning of their own in every expression."""


def taken(name: str) -> str:
    """What a name means in every expression, so that no parameter may have it; "" for a free
    one."""
    return CONSTANTS.get(name, "a place of a point" if PLACE.fullmatch(name) else "")


# Near names: the known name that a wrong one may stand for, and the question that asks so.

LONGEST = 40
"""So many letters of a wrong name are compared."""


def near_name(word: str, known: Iterable[str], alike: float = 0.6) -> str:
    """The known name nearest to a word, ``alike`` from 0 (any) to 1 (the same), and of those as
    near the last that begins as it does for longest; "" if none is."""
    listed, word = [*known], word[:LONGEST]
    close = {*difflib.get_close_matches(word, listed, len(listed) or 1, alike)}

    def nearness(name: str) -> tuple[float, int]:
        alike = (a == b for a, b in zip(name, word, strict=False))
        return difflib.SequenceMatcher(None, name, word).ratio(), sum(takewhile(bool, alike))

    return max((x for x in reversed(listed) if x in close), key=nearness, default="")


def did_you_mean(name: str, before: str = "", after: str = "") -> str:
    """``did you mean 'spring'?`` between the texts ``before`` and ``after``; "" for no name."""
    return f"{before}did you mean {name!r}?{after}" if name else ""


# Greek letters by their English names: LaTeX has these as commands, emitted names as words.

GREEK = {
    name: unicodedata.lookup(f"GREEK {case} LETTER {name.upper()}")
    for case, names in (
        ("SMALL", "alpha beta gamma delta epsilon zeta eta theta iota kappa mu nu xi pi rho "
         "sigma tau upsilon phi chi psi omega"),
        ("CAPITAL", "Gamma Delta Theta Xi Pi Sigma Upsilon Phi Psi Omega"),
    )
    for name in names.split()
}  # fmt: skip
"""Name → letter; without λ: no parameter is called as a word of Python is."""

SPELT = {letter: name for name, letter in GREEK.items()} | {"λ": "lambda", "Λ": "Lambda"}
"""Letter → name."""


# The names of the entries of an array, as files and emitted code have them.


def suffixed(name: str, *index: int) -> str:
    """The name of an entry: ``I_12``; where an index is above 9, ``I_1_12``."""
    digits = "".join(map(str, index)) if max(index) < 10 else "_".join(map(str, index))
    return f"{name}_{digits}"


def advected_entries(problem: Mapping[str, Any]) -> list[str]:
    """The names of the entries of Γ, all that an algebra carries along, in a record's problem."""
    carried = problem.get("advected") or ()
    return [suffixed(x["name"], i) for x in carried for i in range(1, x["size"] + 1)]


def stored_masses(problem: Mapping[str, Any]) -> list[str]:
    """The masses that the flows of a record's problem say to be numbers of the state, in order."""
    return [*dict.fromkeys(x["mass"] for x in problem.get("flows", ()) if "mass" in x)]


def rate_of_mass(name: str) -> str:
    """The name of the rate of a mass that is a number of the state."""
    return f"{name}_dot"


def block_of(problem: Mapping[str, Any], told: Mapping[str, Any]) -> int:
    """The block of a product, from 1, on which acts what is ``told`` as in a record's problem, or
    at which it is read; massless places come after the points."""
    listed = [*problem.get("body", {}).get("points", ()), *problem.get("places", ())]
    return int((listed[told["on"] - 1] if "on" in told else told).get("block", 1))


def numbers_of_input(told: Mapping[str, Any], dimension: int) -> list[str]:
    """The names of the numbers of an input, which is ``told`` as in a record: as many as the
    ``dimension``, of 𝔤 or of the space of a force; one where there is a direction, of a torque in
    the plane and of a scalar."""
    name = told["name"]
    scalar = told["kind"] == "scalar" or (told["kind"], dimension) == ("torque", 2)
    if "direction" in told or scalar:
        return [name]
    return [suffixed(name, k) for k in range(1, dimension + 1)]


UNNAMED_FORCE, UNNAMED_DAMPING = "force", "damping"
"""What forces of the state and damping are called in sums, where they have no names."""


def acting_names(inputs: Mapping[str, str], forces: Iterable[str], *, damped: bool) -> list[str]:
    """What acts, by names: ``inputs``: name → kind; ``forces``: their names, "" of what has none;
    ``damped``: is there a damping?"""
    names = [name for name, kind in inputs.items() if kind != "scalar"]
    names += [x or UNNAMED_FORCE for x in forces]
    return [*dict.fromkeys(names + [UNNAMED_DAMPING] * damped)]


def acting_in(problem: Mapping[str, Any]) -> list[str]:
    """The same of a problem that is told as in a record."""
    told = (*problem.get("forces", ()), *problem.get("flows", ()))
    forces = [str(x.get("name", "")) for x in told]
    forces += [""] * bool(problem.get("flows"))  # what flows inside
    inputs = {x["name"]: x["kind"] for x in problem.get("inputs", ())}
    return acting_names(inputs, forces, damped=bool(problem.get("damping")))


def numbers_of_output(told: Mapping[str, Any], dimension: int) -> list[str]:
    """The names of the numbers of an output, which is ``told`` as in a record, in a space of so
    many dimensions: of a vector, of a number, or of expressions."""
    kind, name = told["kind"], told["name"]
    size = 1 if kind in ("distance", "tension", "power") else dimension
    if kind == "rate":
        size = 3 if dimension == 3 else 1
    size = len(told["y"]) if kind == "expression" else size
    return one_or_more(name, size)


def one_or_more(name: str, size: int) -> list[str]:
    """The names of so many numbers of an output, or of a force of the state: of one the name."""
    return [name] if size == 1 else [suffixed(name, k) for k in range(1, size + 1)]


COLUMNS = (
    *("energy", "defect", "multiplier", "momentum", "angular_momentum", "body_momentum"),
    *("body_angular_momentum", "circulation", "centre", "integral"),
)
"""Columns of a run beside its state: the energy, what is off the group, what is conserved."""


def letter_and_suffix(name: str) -> tuple[str, str]:
    """What such a name is of, and the rest: ``("zeta", "1")``, ``("re", "m1_2")``."""
    letter, _, suffix = name.partition("_")
    return letter, suffix


def waves(names: Sequence[str]) -> list[list[int]]:
    """Of the coefficients re_n, im_n of a fluid on the torus: n₁, n₂, the places of the real part
    and of the imaginary one; ``m1`` stands for −1."""
    at = {x: k for k, x in enumerate(names)}
    modes = [letter_and_suffix(x)[1] for x in by_letter(names).get("re", ())]
    numbers = ([int(k.replace("m", "-")) for k in x.split("_")] for x in modes)
    return [[*n, at[f"re_{x}"], at[f"im_{x}"]] for n, x in zip(numbers, modes, strict=True)]


def by_letter(names: Iterable[str]) -> dict[str, list[str]]:
    """The names of each letter."""
    found: dict[str, list[str]] = {}
    for name in names:
        found.setdefault(letter_and_suffix(name)[0], []).append(name)
    return found
