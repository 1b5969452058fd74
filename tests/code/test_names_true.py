"""A name of the form a_plus_b, a_minus_b or a_times_b is the value that it says.

Every form of every ready-made problem is emitted, its statements are computed in random numbers,
and what such a name says is computed from its parts.
"""

import ast
import math
import random
import re

import pytest

from derive import derive
from derive.code.program import LoweringError
from derive.command.showing import ready_made
from derive.problem.problem import ProblemError
from tests.support.forms import FORMS
from tests.support.walks import FLUIDS

SAYS = re.compile("_(?:plus|minus|times)_")
ARRAYS = ("p", "u", "axes")
"""The last argument of the functions that compute."""
WITH_CODE = [name for name in ready_made() if name not in ("linear", "affine", *FLUIDS)]
pytestmark = pytest.mark.no_cover


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


@pytest.mark.parametrize(
    "statement",
    [
        "a_plus_b = b - a",
        "a_minus_b = b - a",
        "a_minus_b = a - 2.0*b",
        "a_minus_2_b = a - b",
        "a_times_b = a + b",
        "c_a_plus_b = c*(a + b)",
        "a_minus_b_plus_c = a - (b + c)",
        "a_minus_b_plus_c_ = a - (b + c)",
    ],
)
def test_a_lie_is_seen(statement):
    module = f"def _rhs(xp, t, x, k, u):\n    (a, b, c, ) = x\n    {statement}\n"
    assert list(lies(module)) == [statement.split()[0]]


@pytest.mark.parametrize(
    "statement",
    [
        "a_plus_b = b + a",
        "a_minus_2_b = a - 2.0*b",
        "a_times_b = a*b",
        "c_a_plus_b = c*a + b",
        "a_minus_b_plus_c_ = a - b + c",
    ],
)
def test_the_truth_is_told(statement):
    module = f"def _rhs(xp, t, x, k, u):\n    (a, b, c, ) = x\n    {statement}\n"
    assert not list(lies(module))
