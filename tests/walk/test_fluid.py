"""An incompressible fluid: known flows, what a wrong rule or field does, bad input."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import sympy

from derive.algebra import calculus
from derive.algebra.calculus import reduce
from derive.algebra.words import word
from derive.check.checker import checker_of
from derive.check.fluid.fluid_spaces import FlatTorus
from derive.command.showing import load_problem
from derive.language.tree import names as names_in
from derive.pipeline import walk
from derive.walk.chapter import WalkError
from derive.walk.fluid import circulation
from derive.walk.fluid.fluid_kernel import GRADIENT
from tests.support import corpus
from tests.support.refusals import equations
from tests.support.walks import FLUIDS, SEED, record

ELLIPTIC = "pressure_equation"
x, y = sympy.symbols("x y")
PLACE = (x, y)


def flow(tree, names):
    """A tree in the fields of a plane flow, by SymPy: no code of derive but its trees."""
    if isinstance(tree, str):
        return names[tree]
    if not isinstance(tree, tuple):
        return sympy.Rational(tree)
    op, *parts = tree
    if op == "mul" and isinstance(parts[-2], tuple) and parts[-2][0] == "nabla":
        along, field = flow(parts[-2][1], names), flow(parts[-1], names)
        before = sympy.prod([flow(z, names) for z in parts[:-2]])
        return before * field.jacobian(PLACE) * along
    if op == "call":
        field = flow(parts[1], names)
        return {
            "grad": lambda: sympy.Matrix([field.diff(z) for z in PLACE]),
            "div": lambda: sum(f.diff(z) for f, z in zip(field, PLACE, strict=True)),
            "Δ": lambda: sum(field.diff(z, 2) for z in PLACE),
            "∇": lambda: field.jacobian(PLACE),
            "∂ₙ": lambda: sum(field.diff(z) * n for z, n in zip(PLACE, names["n"], strict=True)),
        }[parts[0]]()
    if op in ("pow", "inv"):
        return flow(parts[0], names) ** (parts[1] if op == "pow" else -1)
    values = [flow(z, names) for z in parts]
    if op == "add":
        return sum(values[1:], values[0])
    if op == "mul":
        return sympy.prod(values)
    return {"tr": lambda a: a.trace(), "inner": lambda a, b: a.dot(b)}[op](*values)


def vanishes(found):
    entries = found if isinstance(found, sympy.MatrixBase) else [found]
    return all(sympy.simplify(z) == 0 for z in entries)


TAYLOR_GREEN = {
    "u": sympy.Matrix([sympy.sin(x) * sympy.cos(y), -sympy.cos(x) * sympy.sin(y)]),
    "u̇": sympy.zeros(2, 1),
    "p": (sympy.cos(2 * x) + sympy.cos(2 * y)) / 4,
}
TURNING = {  # as a solid, in a disc of any radius
    "u": sympy.Matrix([-y, x]),
    "u̇": sympy.zeros(2, 1),
    "p": (x**2 + y**2) / 2,
    "n": sympy.Matrix([x, y]),
}
FALLING = {"V": x * (x**2 - 3 * y), "f": sympy.Matrix([3 * y - 3 * x**2, 3 * x])}
"""A force on the disc that turns, which its pressure bears."""
BORNE = {"p": TURNING["p"] - FALLING["V"]}
HANGING = {"V": (x**2 + y**2) ** 2, "p": (x**2 + y**2) / 2 + (x**2 + y**2) ** 2 / 4}
HANGING["p"] -= (x**2 + y**2) ** 2 + 2 * (x**2 + y**2) ** 3 / 3
t, s = sympy.symbols("t s")
SPUN = {  # as a solid, faster and faster, by a force that is no gradient
    "u": t * TURNING["u"],
    "u̇": TURNING["u"],
    "n": TURNING["n"],
    "f": TURNING["u"] - FALLING["f"],
    "p": t**2 * TURNING["p"] + FALLING["V"],
    "angle": t**2 / 2,
}
WHIRLED = SPUN | {"ρ": 1 + x**2 + y**2, "f": TURNING["u"] + 2 * TURNING["n"]}
WHIRLED["p"] = (t**2 + 2) * ((x**2 + y**2) / 2 + (x**2 + y**2) ** 2 / 4)


@cache
def of(name):
    """The record of a ready-made problem, or of a fluid in a field of force."""
    return corpus.record(f"fluid {name}")


STRATIFIED = {"ρ": 1 + x**2 + y**2, "p": (x**2 + y**2) / 2 + (x**2 + y**2) ** 2 / 4}


@pytest.mark.parametrize(
    ("name", "names", "keys"),
    [
        ("ideal_fluid", TAYLOR_GREEN, ["pressure.3", "divergence_along.1", f"{ELLIPTIC}.2"]),
        (
            "ideal_fluid",
            TURNING,
            ["pressure.3", "divergence_along.1", f"{ELLIPTIC}.2", "boundary.2"],
        ),
        (
            "inhomogeneous_fluid",
            TURNING | STRATIFIED,
            ["pressure.3", f"{ELLIPTIC}.1", "boundary.2"],
        ),
        (
            "well",
            TURNING | FALLING | BORNE,
            ["force.2", "pressure.3", "absorbed.3", f"{ELLIPTIC}.3", "boundary.2"],
        ),
        (
            "stratified_fluid",
            TURNING | STRATIFIED | HANGING,
            ["pressure.3", f"{ELLIPTIC}.1", f"{ELLIPTIC}.2", "boundary.2"],
        ),
        ("blown", SPUN, ["pressure.3", f"{ELLIPTIC}.2", "boundary.2"]),
        ("wind", WHIRLED, ["pressure.3", f"{ELLIPTIC}.1", "boundary.2"]),
    ],
)
def test_known_flows(name, names, keys):
    for key in keys:
        label, k = key.split(".")
        equation = of(name)[label].equations[int(k) - 1]
        both = [flow(z, names) for z in (equation.lhs, equation.rhs)]
        assert vanishes(both[0] - both[1]), key


CIRCLE = sympy.Matrix([2 * sympy.cos(s), 2 * sympy.sin(s)])
ELLIPSE = sympy.Matrix([1 + sympy.cos(s), 3 * sympy.sin(s) - sympy.cos(s)])


def on_curve(tree, names, start):
    """The value of a tree in what is along a curve that turns with the fluid."""
    a = names.get("angle", t)
    place = sympy.Matrix([[sympy.cos(a), -sympy.sin(a)], [sympy.sin(a), sympy.cos(a)]]) * start

    def along(f):
        return sympy.sympify(f).subs(dict(zip(PLACE, place, strict=True)), simultaneous=True)

    def value(tree):
        if tree in ("χ_s", "χ̇", "κ", 0, -1):
            density = along(names.get("ρ", 1))
            known = {"χ_s": place.diff(s), "χ̇": place.diff(t), "κ": density}
            return known.get(tree, tree)
        op, *parts = tree
        if op == "call":
            assert parts[0] == "d/dt"
            return value(parts[1]).diff(t)
        if op == "inner":
            a, b = map(value, parts)
            return sympy.integrate(sympy.expand(a.dot(b)), (s, 0, 2 * sympy.pi))
        if op == "add":
            return sum(map(value, parts[1:]), value(parts[0]))
        k = parts.index("Γ")
        found = along(
            flow(parts[k + 1] if len(parts) == k + 2 else ("mul", *parts[k + 1 :]), names)
        )
        for x in reversed(parts[:k]):
            found = found.diff(s) if x == "∂_s" else value(x) * found
        return found

    return value(tree)


@pytest.mark.parametrize(
    ("name", "names", "start"),
    [
        ("ideal_fluid", TURNING, ELLIPSE),
        ("well", TURNING | FALLING | BORNE, ELLIPSE),
        ("inhomogeneous_fluid", TURNING | STRATIFIED, CIRCLE),
        ("stratified_fluid", TURNING | STRATIFIED | HANGING, CIRCLE),
        ("blown", SPUN, ELLIPSE),
        ("wind", WHIRLED, CIRCLE),
    ],
)
def test_circulation_along_a_known_curve(name, names, start):
    steps = [("curve", 2), ("closed_curve", 2), ("closed_curve", 3)]
    for label, k in [*steps, *(("kelvin", k) for k in range(5))]:
        equation = of(name)[label].equations[k]
        left, right = (on_curve(z, names, start) for z in (equation.lhs, equation.rhs))
        assert vanishes(left - right), (label, k)


def sheared():
    """Of a fluid on T² that two shears move in turn: its fields, and what is integrated for h̃ and Ũ
    and for dŨ(ν), by the points."""
    a, b = t + t**2 / 2, 2 * t - t**2
    second = y + b * sympy.sin(x)
    g = sympy.Matrix([x + a * sympy.sin(second), second])
    first = x - a * sympy.sin(y)
    back = {x: first, y: y - b * sympy.sin(first)}
    body = 2 + sympy.sin(x - y) + sympy.cos(x + 2 * y + 1) / 2
    V = sympy.sin(x + 2) + sympy.cos(x + y)
    u, rho = (z.subs(back, simultaneous=True) for z in (g.diff(t), body))
    fall = body * V.subs({x: g[0], y: g[1]}, simultaneous=True)
    energy = body * g.diff(t).dot(g.diff(t)) / 2 + fall
    force = -sympy.Matrix([V.diff(z) for z in PLACE])
    names = {"u": u, "u̇": u.diff(t), "ρ": rho, "ρ̇": rho.diff(t), "f": force}
    return names | {"h̃": energy, "Ũ": fall, "dŨ": fall.diff(t)}


def over_the_torus(tree, names):
    """The mean at one time of what a scalar of a record integrates, by the trapezoidal rule."""
    if tree in ("h̃", "Ũ", ("call", "dŨ", "ν")):
        found = names[tree if isinstance(tree, str) else "dŨ"]
    elif tree == ("call", "d/dt", "h̃"):
        found = names["h̃"].diff(t)
    elif tree[0] == "add":
        return sum(over_the_torus(z, names) for z in tree[1:])
    elif tree[0] == "mul":
        return float(tree[1]) * over_the_torus(tree[2], names)
    else:
        *metric, left, right = tree[1:] if tree[0] != "norm2" else (*tree[1:], tree[-1])
        found = flow(("inner", left, right), names) * sympy.prod([names[z] for z in metric])
    angles = 2 * np.pi * np.arange(64) / 64
    value = sympy.lambdify((x, y), found.subs(t, sympy.Rational(1, 3)), "numpy")
    return np.mean(value(*np.meshgrid(angles, angles)))


def test_density_and_energy_of_a_known_motion():
    """A motion of no force: what holds for any acceleration holds of it, and is not 0 = 0."""
    names, d = sheared(), of("stratified_fluid")
    assert vanishes(sympy.expand(flow(d["advection"].equations[-1].lhs, names)))
    for e in d["energy_kept"].equations[:4]:
        left, right = (over_the_torus(z, names) for z in (e.lhs, e.rhs))
        assert abs(left) > 1e-3
        assert left == pytest.approx(right, rel=1e-12)


def test_a_force_that_is_given_works():
    """One that is the acceleration of the points, without a pressure."""
    names = sheared()
    names["h̃"] -= names["Ũ"]
    names["f"] = names["u̇"] + names["u"].jacobian(PLACE) * names["u"]
    last = of("wind")["energy_kept"].equations[-1]
    rate, power = (over_the_torus(z, names) for z in (last.lhs, last.rhs))
    assert abs(rate) > 1e-3
    assert rate == pytest.approx(power, rel=1e-12)


@pytest.mark.parametrize(
    ("where", "what", "words"),
    [
        (circulation, "varied_cauchy_green", "not carried along with the volume"),
        (circulation, "rate_of_density", "not what the kernel pairs with u"),
    ],
)
def test_what_the_density_and_the_energy_need(where, what, words, monkeypatch):
    """One rate of the density by both roads; and that it is this one."""
    right = getattr(where, what)
    monkeypatch.setattr(where, what, lambda *a: -right(*a))
    walk(load_problem("ideal_fluid"))
    for name in FLUIDS[1:]:
        with pytest.raises(WalkError, match=words):
            walk(load_problem(name))


@pytest.mark.parametrize("name", FLUIDS)
def test_what_kelvin_needs(name, monkeypatch):
    """That the curve is closed, and with a density that it is in a level surface."""
    monkeypatch.setattr(circulation, "ALONG", replace(circulation.ALONG, symmetry=0))
    with pytest.raises(WalkError, match="circulation along a curve"):
        walk(load_problem(name))
    monkeypatch.undo()
    monkeypatch.setattr(circulation, "on_level", lambda a: lambda x, y: None)
    if name == "ideal_fluid":
        walk(load_problem(name))
        return
    with pytest.raises(WalkError, match="the density on the curve"):
        walk(load_problem(name))


FORCE_AT_WORK = {
    *("force", "exterior", "dalembert", "exterior_trivialised"),
    *("contraction", "second_order", "kernel"),
}


def test_where_the_density_is_the_same_the_pressure_alone_sees_a_force():
    """There f is orthogonal to all that it is paired with: what is changed and holds is of f."""
    passed = {label for (label, *_), held in equations("fluid well") if held()}
    for label in passed:
        said = of("well")[label].equations
        assert any("f" in (*names_in(e.lhs), *names_in(e.rhs)) for e in said)
    assert {x.partition(".")[2] for x in passed} == FORCE_AT_WORK


@pytest.mark.parametrize("name", [*FLUIDS, *corpus.IN_FIELDS])
def test_a_wrong_structure_equation_leads_nowhere(name, monkeypatch):
    right = calculus.structure_equation
    monkeypatch.setattr(calculus, "structure_equation", lambda *a: -right(*a))
    with pytest.raises(WalkError, match="divergence of the acceleration"):
        corpus.in_a_field(name) if name in corpus.IN_FIELDS else walk(load_problem(name))


def test_a_pair_along_a_curve_is_read_either_way():
    """What ⟨Γ grad p, χ_s⟩ becomes is what its transpose does, transposed."""
    pushed = word(circulation.CURVE) * word(GRADIENT)
    rule = circulation.along_curve(GRADIENT)
    assert reduce(pushed, rule) not in (pushed, pushed.bar)
    assert reduce(pushed.bar, rule) == reduce(pushed, rule).bar


def test_fields_with_a_divergence_break_what_rests_on_it(monkeypatch):
    """So that each of these steps is tried where it needs its hypothesis."""
    monkeypatch.setattr(FlatTorus, "solenoidal", lambda self, draw: self.any_field(draw))
    d = record("ideal_fluid")
    checker = checker_of(d.problem, SEED)
    broken = {s.label.partition(".")[2] for s in d.steps if not checker.check(s).holds}
    assert {"skew", "divergence", "kernel", "divergence_along", "pressure_equation"} <= broken
    assert "structure" not in broken
    assert "chain" not in broken
