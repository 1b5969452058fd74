"""Names in emitted files.  A parameter may be called as anything is that stands in the emitted text
of a language: each word is refused with a reason, or the code that has it gives the numbers of the
same problem under plain names.  A name of the form a_plus_b, a_minus_b or a_times_b is the value
that it says: every form of every ready-made problem is emitted, its statements are computed in
random numbers, and what such a name says is computed from its parts.
"""

import ast
import math
import random
import re
from dataclasses import replace
from functools import cache

import pytest

from derive import SE, SL, Gravity, Moments, Points, Potential, Problem, Spring, derive
from derive.code.languages import LANGUAGES, Statements
from derive.code.program import LoweringError
from derive.code.requests import identifiers, without_collisions
from derive.command.showing import ready_made
from derive.problem.problem import ProblemError
from derive.programs import program
from tests.support.exercise import FORMS
from tests.support.languages import Case
from tests.support.library import BUILDS, ONE_BUILD
from tests.support.needs import needs
from tests.support.walks import FLUIDS

LINEARISED = ("state", "inputs", "parameters")
pytestmark = pytest.mark.no_cover
PARTS = 3
"""One problem has not room for all of them."""
SPOKEN = (
    "become box crate dyn fn gen impl let loop macro match mod move mut priv pub ref self Self "
    "super trait type unsafe use where Some Ok Err begin end function module local quote isa "
    "elseif nothing undef eltype Vector Float64 arguments debugger eval extends instanceof null "
    "package var Math Float64Array Number RangeError char8_t N_STATE N_CONSTANTS ZERO_INPUTS "
    "Singular DEFAULTS length STATE rhs energy constants jacobian project defect out "
    "conserved CONSERVED N_CONSERVED Conserved"
)
RESERVED = SPOKEN.split()
"""Of any language, and what templates need: these stand in each problem."""
PLACES = ([1, 0], ["1/3", 1], [-1, "1/4"])


@cache
def words(language, part, *, framed=False):
    """A part of what stands in the files of a language, and the same with an underscore, as names
    go."""
    chosen = {"frame": "principal", "jacobian": LINEARISED[:2]} if framed else {}
    made = derive("so3").emit(None, (language,), **({"jacobian": LINEARISED} | chosen))
    found = sorted(set(re.findall(r"[A-Za-z][A-Za-z0-9_]{0,30}", "\n".join(made.values()))))
    both = [w for x in found for w in ((x,) if re.search(r"\d", x) else (x, x + "_"))]
    return [w for w in both[part::PARTS] if accepted(w, framed)]


def accepted(name, framed):
    """Whether it may be a parameter; a refusal says what the name is."""
    try:
        if framed:
            spring = Spring([1, 0, 0], [1, 2, 0], name)
            Problem("named", SL(3), Moments(), spring, {name: 1})
        else:
            points, force = Points((name, [1, 0]), (1, [0, 1])), Potential(f"{name}*r1_x")
            Problem("named", SE(2), points, force, {name: 1})
        told = repr(name)
    except ProblemError as error:
        told = f"refused: {error}"
    assert repr(name) in told
    return not told.startswith("refused: ")


def problem(names, own="worded"):
    """Names that stand in masses and in a potential, so in every function."""
    terms = [f"{w}*r{1 + i % 3}_x^{2 - (i % 7 > 0)}" for i, w in enumerate(names)]
    forces = [Potential("+".join(["r1_y^2", *terms[i::9]])) for i in range(9)]
    masses = ["3" + "".join(f"+{w}" for w in names[i::3]) for i in range(3)]
    values = {w: round(0.7 + 0.01 * (i % 40), 2) for i, w in enumerate(names)}
    return Problem(own, SE(2), Points(*zip(masses, PLACES, strict=True)), forces, values)


def of_springs(names, own="worded"):
    """The same where the principal frame can be: names in masses and in stiffnesses."""
    sums = [f"1{''.join(f'+{w}^2' for w in names[i::3])}" for i in range(3)]
    at = [[1, 0, 0], ["1/3", 1, 0], [-1, "1/4", 1]]
    forces = [Gravity(0, 0, "-2"), *(Spring(at[i], [1, 2, i], k) for i, k in enumerate(sums))]
    masses = [*zip(sums, at, strict=True), (2, [0, -1, "1/2"])]
    values = {w: round(0.7 + 0.01 * (i % 40), 2) for i, w in enumerate(names)}
    return Problem(own, SL(3), Points(*masses), forces, values)


def plain(names):
    """As many names that no language has."""
    return [f"quantity_{i}_q" for i in range(len(names))]


LANGUAGES_OF = [(x, False) for x in ONE_BUILD.values()] + [("c", True), ("python", True)]


@needs("cc")
@pytest.mark.parametrize("part", range(PARTS))
@pytest.mark.parametrize(("build", "framed"), LANGUAGES_OF)
def test_in_a_language(build, framed, part):
    """Also what finds the principal frame; the numbers are those of C, and those of its words are
    the numbers of plain names."""
    language = BUILDS[build][0]
    names = [*dict.fromkeys([*words(language, part, framed=framed), *RESERVED])]
    assert len(names) > 100
    make, options = (of_springs, {"frame": "principal"}) if framed else (problem, {})
    worded = Case(make(names), options, tolerance=1e-12 if framed else 1e-13)
    assert tuple(names) == worded.parameters
    if build == "c":
        worded.reference = Case(make(plain(names), "neutral"), options).reference
    worded.agrees(build)


FORTRAN = replace(
    LANGUAGES["julia"],
    name="fortran",
    comment=("! ", "! ", ""),
    parenthesised=False,
    continued=" &",
    reserved="allocate where",
    caseless=True,
)
"""What an entry can say of a language with comments, words and lines of its own, without case."""


def made(named):
    d = derive(named)
    return program(d.problem, d.record)


def names_in(p):
    """What the functions of a program load and compute, each once."""
    own = (x for f in p.all_functions() for x in f.loads if x.array != "t")
    values = (v for f in p.all_functions() for s in f.sections for v in s.values)
    return [*dict.fromkeys(x.name for x in (*own, *values))]


def test_names_without_case_and_words_of_one_language():
    p = made(problem(["Ka", "ka", "Allocate", "allocate_", "pure"]))
    words = identifiers('x = PURE ! where not "string"\n', FORTRAN)
    assert words == {"x", "PURE", "allocate", "where"}
    own, apart = names_in(p), names_in(without_collisions(p, words, caseless=True))
    assert len({x.lower() for x in own}) < len(own)
    assert len({x.lower() for x in apart}) == len(apart) == len(own)
    assert not {x.lower() for x in apart} & {x.lower() for x in words}
    assert names_in(without_collisions(p, words)) == own  # none of these in so many letters


def test_a_line_that_goes_on_says_so():
    p = made("se3")
    sizes = {"x": len(p.state), "k": len(p.constants), "u": len(p.inputs), "p": len(p.parameters)}
    text = Statements(FORTRAN, "double", sizes).function(p.functions["rhs"])
    rows = [x.split("\n") for s in text["sections"] for x in s["statements"]] + [
        x.split("\n") for x in text["outputs"]
    ]
    assert any(len(x) > 1 for x in rows)
    assert all(line.endswith(" &") for x in rows for line in x[:-1])
    assert not any(x[-1].endswith("&") for x in rows)
    assert all(line.startswith("! ") for s in text["sections"] for line in s["comment"])


# ---------------------------------------------------------------- a name is the value that it says

SAYS = re.compile("_(?:plus|minus|times)_")
ARRAYS = ("p", "u", "axes")
"""The last argument of the functions that compute."""
WITH_CODE = [name for name in ready_made() if name not in ("linear", "affine", *FLUIDS)]


def statements(text):
    """(names, expression) in order; ``None`` for what is read from an array."""
    functions = [x for x in ast.parse(text).body if isinstance(x, ast.FunctionDef)]
    computing = [
        f
        for f in functions
        if f.name[0] == "_" and f.args.args[-1:] and f.args.args[-1].arg in ARRAYS
    ]
    for f in sorted(computing, key=lambda f: f.name != "_constants"):
        for x in f.body:
            if isinstance(x, ast.Assign) and isinstance(x.targets[0], ast.Tuple):
                yield [y.id for y in x.targets[0].elts if isinstance(y, ast.Name)], None
            elif isinstance(x, ast.Assign) and isinstance(x.targets[0], ast.Name):
                yield [x.targets[0].id], compile(ast.Expression(x.value), "", "eval")


def lies(text):
    """The names of a module that say something else than their value."""
    rng, known = random.Random(1), {}
    tools = {"xp": math, "_is_zero": lambda _, x: float(x == 0)}
    for names, expression in statements(text):
        for name in names:
            try:
                value = eval(expression, tools, known) if expression else None
            except (NameError, TypeError, ArithmeticError, ValueError, AttributeError):
                value = None  # a statement of the template, or no real number here
            if not isinstance(value, float):
                value = known.get(name, rng.uniform(0.5, 1.5))
            if SAYS.search(name) and not any(
                math.isclose(x, value, rel_tol=1e-9, abs_tol=1e-9) for x in said(name, known)
            ):
                yield name
            known[name] = value


def said(name, known):
    """What a name says: the sum of its terms; it may end in underscores that only tell it apart."""
    first, *rest = re.split("_(plus|minus)_", name)
    totals = list(product(first, known))
    for sign, term in zip(rest[::2], rest[1::2], strict=True):
        one = 1 if sign == "plus" else -1
        totals = [x + one * y for x in totals for y in product(term, known)]
    return totals


def product(name, known):
    """The values of a name, of a number before it, of names beside each other or with times."""
    yield from atom(name, known)
    for at in [m.start() for m in re.finditer("_", name)]:
        left, right = name[:at], name[at + 1 :].removeprefix("times_")
        for x in [float(left)] if left.isdigit() else atom(left, known):
            yield from (x * y for y in product(right, known))


def atom(name, known):
    """The value of a name; where there is none of it, of that which differs in last underscores."""
    alike = (name.rstrip("_") + "_" * k for k in range(3))
    yield from [known[x] for x in ([name] if name in known else alike) if x in known]


@pytest.mark.parametrize("name", WITH_CODE)
def test_no_name_lies(name):
    derived = derive(name)
    for form, choices in FORMS.items():
        chosen = dict(choices)
        if form == "jacobian" and not derived.problem.inputs:
            chosen["jacobian"] = ("state", "parameters")
        try:
            files = derived.emit(None, ("python",), name, **chosen)
        except (LoweringError, ProblemError):
            continue
        assert not list(lies(files[f"{name}.py"])), form


SAID = {
    "a_plus_b": ("b + a", "b - a"),
    "a_minus_b": ("a - b", "b - a", "a - 2.0*b"),
    "a_minus_2_b": ("a - 2.0*b", "a - b"),
    "a_times_b": ("a*b", "a + b"),
    "c_a_plus_b": ("c*a + b", "c*(a + b)"),
    "a_minus_b_plus_c": ("a - b + c", "a - (b + c)"),
    "a_minus_b_plus_c_": ("a - b + c", "a - (b + c)"),
}
"""A name → what it says, and what would be a lie."""


@pytest.mark.parametrize("name", SAID)
def test_a_lie_is_seen(name):
    for value in SAID[name]:
        module = f"def _rhs(xp, t, x, k, u):\n    (a, b, c, ) = x\n    {name} = {value}\n"
        assert list(lies(module)) == ([] if value == SAID[name][0] else [name])
