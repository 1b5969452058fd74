"""False records made by rule, of kinds that passed once: none is accepted.

Fluids with a claim that holds in fewer directions, in the plane or for the volume 1; equations of
the torus that are wrong at some points of the lattice; masses that are negative by default;
equations of motion under the rules of identities.
"""

import json
from dataclasses import replace
from functools import cache
from itertools import combinations_with_replacement, product

import pytest

from derive.check.checker import Checker
from derive.language.expression import parse
from derive.language.show import show
from derive.language.tree import mul, nodes
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.record.as_json import from_json, to_data
from derive.record.mass_signs import SUPPOSED
from derive.record.record import ANY_GROUP, Equation, Hypothesis
from derive.record.vocabulary import OFF_MOTION, RULES
from tests.support import corpus
from tests.support.walks import FLUIDS, SEED, record


def checker(name):
    return corpus.checker(f"{'fluid' if name in FLUIDS else 'ready'} {name}")


# -- fluids ---------------------------------------------------------------------------------------

FIELDS = ("u", "η", "δu", "η′")


def jacobian(a):
    return ("call", "∇", a)


def along(*fields):
    """∇_a b, ∇_(∇_a b) c …"""
    first, *rest = fields
    for x in rest:
        first = mul(("nabla", first), x)
    return first


def one_after_another(*fields):
    """∇_a ∇_b … c."""
    *operators, last = fields
    return mul(*(("nabla", x) for x in operators), last)


def traces(count):
    for fields in combinations_with_replacement(FIELDS, count):
        yield Equation(("tr", mul(*map(jacobian, fields))), 0)


def local():
    """Of products of derivatives at a place: 0 where all fields vary in the same plane."""
    yield from (*traces(3), *traces(4))
    for a, b, c in combinations_with_replacement(FIELDS, 3):
        both = (("tr", mul(*map(jacobian, order))) for order in ((a, b, c), (a, c, b)))
        yield Equation(("add", *both), 0)


def integrals():
    """Of products that are 0 on tori and in the plane: a flux through the boundary of a ball."""
    for equation in traces(3):
        yield Equation(("inner", 1, equation.lhs), 0)
    for order in (1, 2):
        harmonic = "p"
        for _ in range(order):
            harmonic = ("call", "Δ", harmonic)
        yield Equation(("inner", 1, harmonic), 0)


def normals():
    """Of what has the normal: 0 in a plane disc."""
    for fields in product(("u", "η"), repeat=3):
        yield Equation(("inner", along(*fields), "n"), 0)
        yield Equation(("inner", one_after_another(*fields), "n"), 0)
    yield Equation(("call", "∂ₙ", ("call", "Δ", "p")), 0)


def volumes():
    for k in (1, 2, 3):
        yield Equation(("inner", k, 1), k)
        yield Equation(("inner", k, ("inner", 1, 1)), mul(k, ("inner", 1, 1)))


OF_FLUIDS = [
    (name, equation)
    for name in FLUIDS
    for made in (local, integrals, normals, volumes)
    for equation in made()
]


def shown(x):
    return x if isinstance(x, str) else f"{show(x.lhs)} = {show(x.rhs)}"


@pytest.mark.parametrize(("name", "equation"), OF_FLUIDS, ids=shown)
def test_a_fluid_in_few_directions(name, equation):
    step = record(name)[f"{name}.boundary"]
    found = checker(name).check(replace(step, equations=(equation,), hypotheses=()))
    assert not found.holds
    assert found.reason


# -- the torus ------------------------------------------------------------------------------------

SIZES = (7, 9)
PLACE = ("add", "𝐦", "𝐧")


def squares(N):
    """‖𝐧‖² of the points of the lattice."""
    span = range(N // 2 + 1)
    return sorted({a * a + b * b for a in span for b in span} - {0})


def only_where(n, square, N):
    """A number that vanishes at all points with another ‖𝐧‖²."""
    return mul(*(("add", ("norm2", n), -x) for x in squares(N) if x != square))


@pytest.mark.parametrize(("N", "square"), [(N, x) for N in SIZES for x in squares(N)])
def test_the_torus_wrong_at_some_points(N, square):
    """Every equation about any point, where ‖𝐧‖² is one number alone; of two points, of both."""
    tried = 0
    for step in corpus.record(f"torus {N}").steps:
        for e in step.equations:
            letters = sorted({"𝐦", "𝐧"} & {*nodes(e.lhs)})
            if letters and step.scope != ANY_GROUP:
                extra = ("call", "T", PLACE) if "𝐦" in letters else ("call", "ω̂", "𝐧")
                where = (only_where(n, square, N) for n in letters)
                wrong = Equation(e.lhs, ("add", e.rhs, mul(*where, extra)))
                assert corpus.checker(f"torus {N}").check(replace(step, equations=(e,))).holds
                found = corpus.checker(f"torus {N}").check(replace(step, equations=(wrong,)))
                assert not found.holds
                assert "the sides differ" in found.reason
                tried += 1
    assert tried == 5


# -- masses and defaults --------------------------------------------------------------------------

GROUPS = {"SO(2)": 2, "SO(3)": 3, "SE(2)": 2, "SE(3)": 3, "SL(2)": 2, "SL(3)": 3, "GL(2)": 2}
OF_MASSES = [
    (group, name)
    for group, n in GROUPS.items()
    for name in ("m", *(f"J_{i}{i}" for i in range(1, n + 1)))
]


@cache
def symbolic(group):
    return walk(problem_of({"name": "body", "group": group, "body": {"moments": "symbolic"}}))


def with_defaults(d, **values):
    data = json.loads(json.dumps(to_data(d)))
    for name, value in values.items():
        data["problem"]["parameters"][name]["default"] = value
    return from_json(json.dumps(data))


@pytest.mark.parametrize(("group", "name"), OF_MASSES)
@pytest.mark.parametrize("value", [-1.0, -1.3, -1e-6])
def test_a_moment_that_is_negative_by_default(group, name, value):
    d = symbolic(group)
    introducing = [s for s in d.steps if any(x.property == "positive" for x in s.hypotheses)]
    assert introducing
    for step in introducing:
        assert Checker(d.problem, SEED).check(step).holds
        forged = with_defaults(d, **{name: value})
        assert SUPPOSED in Checker(forged.problem, SEED).check(forged[step.label]).reason


DEFAULTS = ("so3", "heisenberg", "top", "kovalevskaya_top", "euler_poisson")
FALSE = {
    "positive": lambda x, at: ("add", x, -at - 1),
    "nonzero": lambda x, at: ("add", x, -at),
    "invertible": lambda x, at: ("add", ("pow", x, 2), -at * at),
}
"""Of a parameter and its default: what is true of large numbers, and not of this."""


@pytest.mark.parametrize("name", DEFAULTS)
@pytest.mark.parametrize("rule", FALSE)
def test_what_is_false_by_default_is_said(name, rule):
    d = record(name)
    step = d.steps[-1]
    assert checker(name).check(step).note == ""
    parameters = d.problem["parameters"]
    known = {x: about["default"] for x, about in parameters.items() if about["default"]}
    assert known
    for x, at in known.items():
        false = Hypothesis(rule, FALSE[rule](("par", x), parse(str(at))))
        found = checker(name).check(replace(step, hypotheses=(*step.hypotheses, false)))
        assert not found.holds or "for the defaults of the parameters" in found.note


# -- kinds ----------------------------------------------------------------------------------------

ALONG = ("so3", "se3", "sl3", "heisenberg", "top", "zeitlin", "ideal_fluid", "stratified_fluid")
IDENTITIES = [next(x for x, rule in RULES.items() if rule.kind == kind) for kind in OFF_MOTION]


@pytest.mark.parametrize("rule", IDENTITIES)
@pytest.mark.parametrize("name", ALONG)
def test_an_equation_of_motion_is_no_identity(name, rule):
    """Of all steps about the motion but those that give X its velocity, whose equations hold for
    any acceleration."""
    tried = 0
    for step in record(name).steps:
        if step.kind not in OFF_MOTION and not step.given:
            found = checker(name).check(replace(step, rule=rule))
            assert not found.holds
            assert "differ" in found.reason
            tried += 1
    assert tried > 3
