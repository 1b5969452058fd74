"""Reductions: every step holds and one that is wrong is refused; what is told, and what is refused
in one line; against oracles: Euler's angles, the least energy on a level, trajectories."""

import operator
from dataclasses import replace
from functools import cache, reduce

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from derive.check.checker import Checker, check
from derive.command.cli import main
from derive.language.show import show
from derive.language.tree import mul
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from derive.python.derived import derive
from derive.record.sentence import Claim, english
from tests.oracles import routh
from tests.readers.read import PAGES, faults
from tests.support.reduced import reduced
from tests.support.walks import SEED


@pytest.mark.parametrize("kind", PAGES)
@pytest.mark.parametrize("name", ["lagrange_top", "charged_body"])
def test_every_page_says_what_its_record_says(name, kind):
    assert [*faults(reduced(name).record, kind)] == []


def test_what_is_0_by_the_choice_of_horizontal_velocities_does_not_stand_in_the_routhian():
    """b(A₃₁ζ_h₁ + A₃₂ζ_h₂) is 0 where ζ_h is orthogonal to a turn about the vertical."""
    (own,) = [
        s for s in reduced("turned").record.since("momentum_1") if s.label.endswith(".effective")
    ]
    *_, whole = own.equations
    assert show(whole.rhs) == "ζ_h₁² + ζ_h₂² − 𝒱"


def test_other_fields_are_refused():
    own = reduced("lagrange_top").record
    first, second = own.problem["symmetries"]
    for fields in ([second, first], [first], [first, first], [["mul", "A", "Z"]]):
        wrong = replace(own, problem={**own.problem, "symmetries": fields})
        assert not all(v.holds for v in check(wrong, SEED))


def test_a_false_potential_is_refused():
    own = reduced("gyrostat").record
    step = own["effective"]
    wrong = replace(step.equations[0], rhs=mul(2, step.equations[0].rhs))
    checker = Checker(own.problem, SEED)
    assert all(checker.check(x).holds for x in own.since("momentum_1"))
    assert not checker.check(replace(step, equations=(wrong, *step.equations[1:]))).holds


def said(capsys, *words, code=0):
    assert main(["reduction", *words]) == code
    return capsys.readouterr()


def test_the_effective_potential_of_a_top(capsys):
    words = said(capsys, "lagrange_top").out
    assert "𝒱 = mgl·A₃₃ + (𝒥₁ − A₃₃ 𝒥₂)²/(2 I1(1 − A₃₃²)) + 𝒥₂²/(2 I3)" in words
    assert "degree 3: the integral is elliptic" in " ".join(words.split())


def test_a_parameter_is_told_from_the_element_of_the_group(capsys):
    """By quotes, where both stand: not where the element is in no formula of what is shown."""
    assert "𝒱 = mlg A₃₃ + " in said(capsys, "spherical_pendulum").out
    assert main(["walk", "spherical_pendulum"]) == 0
    assert "m‘g’l A₃₃" in capsys.readouterr().out


def stated(L, group="SO(3)"):
    return derive(problem_of({"name": "own", "group": group, "lagrangian": {"L": L}}))


@pytest.mark.parametrize(
    ("L", "why"),
    [
        ("zeta_1^2 + zeta_2^2 + zeta_3^2 + zeta_3^4", "not quadratic"),
        ("zeta_1^2 + 2*zeta_2^2 + 3*zeta_3^2 - A_33 - A_12", "no symmetry of L but of the time"),
        ("zeta_1^2 + zeta_2^2 - zeta_3^2 + A_11*A_22", "no symmetry of L but of the time"),
    ],
)
def test_what_is_not_reduced(L, why):
    with pytest.raises(ProblemError, match=why):
        stated(L).reduction()


def test_which_symmetries_are_taken():
    """Of three rotations of space, that about the third axis; of translations all."""
    found = derive("euler_top").reduction()
    assert found.kinds == ("rotation_space",)
    assert "their number is 1." in " ".join(str(found).split())
    assert derive("kirchhoff").reduction().kinds == ("translation_space",) * 3
    assert reduced("free").routhian.freedom == 1


def test_other_symmetries_are_taken_where_the_first_lead_to_no_quadrature():
    """On the half plane a > 0 of r ↦ ar + b, dilations of space come first; by translations
    ȧ² = 2a²h − a⁴𝒥², as L̃ = ½(ȧ² + ḃ²)/a² and 𝒥 = ḃ/a²."""
    group = {"name": "Half", "basis": [[[1, 0], [0, 0]], [[0, 1], [0, 0]]]}
    found = stated("(zeta_1^2 + zeta_2^2)/2", group).reduction()
    assert all(v.holds for v in found.check())
    assert found.quadrature is not None
    whole = found.quadrature.sympy().rhs
    rng = np.random.default_rng(3)
    for a, fall, momentum in rng.uniform(0.5, 2, (5, 3)):
        h = (fall**2 + (a**2 * momentum) ** 2) / (2 * a**2)
        values = {"A[0, 0]": a, "h̃": h, "𝒥_1": momentum}
        there = whole.replace(lambda x, v=values: str(x) in v, lambda x, v=values: v[str(x)])
        assert np.isclose(float(there), fall**2)


@pytest.mark.parametrize(
    ("name", "word"),
    [
        ("flat", "elementary"),
        ("grown", "elementary"),
        ("lagrange_top", "elliptic"),
        ("steep", "hyperelliptic"),
    ],
)
def test_what_is_said_of_the_integral(name, word):
    step = reduced(name).record["quadrature"]
    assert word in str(step.prose)


def test_without_freedom_the_energy_is_the_potential():
    record = reduced("wheel").record
    energy = next(e for e in record["effective"].equations if e.lhs == "h̃")
    assert energy.rhs == "𝒱"


def test_every_equation_is_one_of_sympy():
    found = derive("charged_body").reduction()
    assert all(found[s.label].sympy() for s in found.record.steps)
    assert found.quadrature is None


@pytest.mark.parametrize(
    ("name", "left"),
    [("top", True), ("spherical_pendulum", True), ("charged_body", False), ("two_tops", False)],
)
def test_where_a_configuration_is_left_as_it_is(capsys, name, left):
    """Upright, by a turn of space and one of the body; by turns of space alone never."""
    words = " ".join(said(capsys, name, "effective").out.split())
    assert ("is positive a motion along the symmetries leaves" in words) == left
    assert ("No motion along the symmetries leaves" in words) != left


def test_a_null_field_is_not_said_to_vanish(capsys, tmp_path):
    """A boost on its light cone: 𝕀 = A₂₃² − A₁₃² is 0 there, and the field (A₂₃, A₁₃) is not."""
    shifts = [[[0, 0, int(i == 0)], [0, 0, int(i == 1)], [0, 0, 0]] for i in range(2)]
    file = tmp_path / "boost.toml"
    file.write_text(
        f'name = "boost"\n[group]\nname = "R2"\naction = "affine"\nbasis = {shifts}\n'
        '[lagrangian]\nL = "(zeta_1^2 - zeta_2^2)/2 - (T_1^2 - T_2^2)^2"\n'
    )
    words = " ".join(said(capsys, str(file)).out.split())
    assert "𝒥₁ = Π₁ A₂₃ + Π₂ A₁₃" in words
    assert "where the kinetic energy is positive a motion along the symmetries leaves" in words
    assert "elsewhere a motion" not in words


@pytest.mark.parametrize(
    ("L", "group", "condition"),
    [
        ("(zeta_1^2 + zeta_2^2 - zeta_3^2)/2", "SE(2)", "A₁₁² − A₁₂² ≠ 0, by which"),
        (
            "(zeta_1^2 + zeta_2^2 + 2*zeta_3^2 + zeta_4^2 + zeta_5^2 - zeta_6^2)/2 - A_33 - T_3^2",
            "SE(3)",
            "where 1 − 2 A₁₃² − 2 A₂₃² ≠ 0, 1 − 2 A₁₃² ≠ 0, by which",
        ),
    ],
)
def test_a_pivot_is_not_said_to_be_the_determinant(L, group, condition):
    """At the third column (1/√2, ½, ½) of a rotation 𝕀 has an inverse, and 1 − 2A₁₃² is 0."""
    words = english(stated(L, group).reduction().record["effective"].prose)
    assert condition in words
    assert "elsewhere the locked inertia" not in words


@pytest.mark.parametrize(
    ("metric", "bent"),
    [
        ("sin(T_1)", "cos(A₁₄)(ξ₁₄ ξ′₂₄ − ξ₂₄ ξ′₁₄)/2"),
        ("exp(T_1)", "exp(A₁₄)(ξ₁₄ ξ′₂₄ − ξ₂₄ ξ′₁₄)/2"),
        ("T_1^2", "A₁₄(ξ₁₄ ξ′₂₄ − ξ₂₄ ξ′₁₄)"),
        ("atan(T_1)", ""),
    ],
)
def test_the_curvature_where_the_metric_has_functions_of_the_element(metric, bent):
    """𝒜 = dT₃ + ½ f(T₁) dT₂: d𝒜 = ½ f′ dT₁ ∧ dT₂; where f′ is no polynomial it is not told."""
    L = f"(zeta_1^2 + zeta_2^2)/2 + zeta_3^2 + {metric}*zeta_2*zeta_3 - T_2^2"
    found = stated(L, "R(3)").reduction()
    assert all(v.holds for v in found.check())
    told = [e for s in found.record.steps if s.label == "own.curvature" for e in s.equations]
    assert [show(e.rhs) for e in told] == ([bent] if bent else [])


def test_a_function_of_the_coordinate_is_no_polynomial_in_it():
    """u̇² = 2(h − u − ½𝒥²)/(2 + sin u): no kind of integral is told, and none that is claimed
    holds; a pivot with functions of g alone is a condition."""
    found = stated("((2 + sin(T_1))*zeta_1^2 + zeta_2^2)/2 - T_1", "R(2)").reduction()
    step = found.record["quadrature"]
    assert [c.kind for c in step.claims] == ["reduction.quadrature"]
    assert all(v.holds for v in found.check())
    claimed = Claim("reduction.elementary", (("degree", 1),))
    wrong = replace(step, claims=(*step.claims, claimed))
    steps = tuple(x if x is not step else wrong for x in found.record.steps)
    checked = check(replace(found.record, steps=steps), SEED)
    assert [v.label for v in checked if not v.holds] == [step.label]
    pivot = stated("(zeta_1^2 + (2 + sin(T_1))*zeta_2^2)/2", "R(2)").reduction()
    assert "This holds where sin(A₁₃) + 2 ≠ 0" in english(pivot.record["effective"].prose)


def test_a_curvature_that_is_long_is_not_sought():
    """A turn of space, and one of a dipole in a field, on SE(3): minutes, of divisors alone."""
    dipole = "A_33*(1 + T_3) - A_13*T_1/2 - A_23*T_2/2"
    L = f"zeta_1^2 + zeta_2^2 + 2*zeta_3^2 + 3*(zeta_4^2 + zeta_5^2 + zeta_6^2) - T_3 + {dipole}"
    found = stated(L, "SE(3)").reduction()
    assert found.found.curvature is None
    assert found.found.forms is not None


RNG = np.random.default_rng(11)
FIRST = RNG.bit_generator.state


@pytest.fixture(autouse=True)
def afresh():
    """The same numbers whatever ran before: a start by chance may pass where sin θ is near 0."""
    RNG.bit_generator.state = FIRST


TURN = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 0]])
DEFAULTS = {
    "lagrange_top": {"I1": 1.0, "I3": 0.4, "mgl": 1.5},
    "gyrostat": {"I1": 1.0, "I2": 1.6, "I3": 2.2, "h1": 0.3, "h3": 0.8, "mgl": 1.5},
    "charged_body": {"I1": 1.0, "I2": 1.4, "I3": 1.9, "K1": 0.5, "K2": 0.2, "K3": 0.6, "b": 0.7},
    "spherical_pendulum": {"m": 1.0, "l": 0.8, "g": 9.81},
}


@cache
def found(name):
    return derive(name).reduction()


def value(t, **known):
    """The value of a tree of numbers."""
    if isinstance(t, str):
        return known[t]
    if not isinstance(t, tuple):
        return float(t)
    if t[0] == "par":
        return known["p"][t[1]]
    if t[0] == "entry":
        return known[t[1]][tuple(i - 1 for i in t[2:])]
    if t[0] in ("at", "call"):
        return known["𝒥" if t[0] == "at" else "𝒜"][(t if t[0] == "at" else t[1])[2] - 1]
    if t[0] == "pow":
        return value(t[1], **known) ** t[2]
    a = [value(x, **known) for x in t[1:]]
    if t[0] == "div":
        return a[0] / a[1]
    return reduce({"add": operator.add, "mul": operator.mul}[t[0]], a)


def rotation():
    q, _ = np.linalg.qr(RNG.normal(size=(3, 3)))
    return q * np.sign(np.linalg.det(q))


def test_lagranges_top_in_eulers_angles():
    """The potential and the cubic are those that SymPy finds from the angles."""
    r = found("lagrange_top")
    for u, one, two, h in RNG.uniform(-0.9, 0.9, (20, 4)):
        p = dict(zip(("I1", "I3", "mgl"), RNG.uniform(0.5, 2, 3), strict=True))
        A = np.zeros((3, 3))
        A[2, 2] = u
        known = {"p": p, "A": A, "𝒥": (one, two), "h̃": h}
        V, cubic = routh.lagrange_top(u, one, two, *p.values(), h)
        assert value(r.effective_potential.rhs, **known) == pytest.approx(V, rel=1e-11)
        across, own = p["I1"], p["I3"]  # the vertical has the share u of the axis
        rows = [[value(x, **known) for x in row[1:]] for row in r.locked_inertia.rhs[1:]]
        wanted = [[across * (1 - u**2) + own * u**2, own * u], [own * u, own]]
        assert np.array(rows, float) == pytest.approx(np.array(wanted), rel=1e-12)
        assert value(r.quadrature.rhs, **known) == pytest.approx(cubic, rel=1e-10, abs=1e-11)


def bodies(name, g, p):
    """M, b, U and the fields of a problem, typed once more."""
    above = g[2]
    fields = [routh.turned(g, TURN)]
    if name == "lagrange_top":
        spin = np.array([0, 0, 1.0])
        return (
            np.diag([p["I1"], p["I1"], p["I3"]]),
            np.zeros(3),
            p["mgl"] * above[2],
            [
                *fields,
                spin,
            ],
        )
    if name == "gyrostat":
        b = np.array([p["h1"], 0, p["h3"]])
        return np.diag([p["I1"], p["I2"], p["I3"]]), b, p["mgl"] * above[2], fields
    if name == "charged_body":
        b = p["b"] / 2 * np.array([p["K1"], p["K2"], p["K3"]]) * above
        return np.diag([p["I1"], p["I2"], p["I3"]]), b, 0.0, fields
    inertia = p["m"] * p["l"] ** 2
    U = p["m"] * p["g"] * p["l"] * above[2]
    return np.diag([inertia, inertia, 0]), np.zeros(3), U, fields


@pytest.mark.parametrize("name", DEFAULTS)
def test_the_effective_potential_is_the_least_energy_on_a_level(name):
    r, p = found(name), DEFAULTS[name]
    for _ in range(10):
        g, mu = rotation(), RNG.normal(size=len(r.kinds))
        body = bodies(name, g, p)
        wanted = routh.least_energy(*body, mu)
        mine = value(r.effective_potential.rhs, p=p, A=g, **{"𝒥": mu})
        assert mine == pytest.approx(wanted, rel=1e-9)


def motion(name, t):
    """A trajectory of the emitted code at these times: its attitudes, ζ and its energy."""
    d, space = derive(name), {}
    exec(d.emit(languages=("python",))[f"{name}.py"], space)
    k = space["constants"](space["DEFAULTS"])
    start = np.concatenate([rotation().ravel(), RNG.normal(size=len(space["STATE"]) - 9)])
    given = {"t_eval": t, "method": "DOP853", "rtol": 1e-12, "atol": 1e-12}
    x = solve_ivp(lambda t, x: space["rhs"](t, x, k), (t[0], t[-1]), start, **given).y.T
    return x[:, :9].reshape(-1, 3, 3), x[:, 9:], space["energy"](t, x, k)


def momenta(name, g, z, p):
    """Those of the fields, by the metric typed above."""
    M, b, _, fields = bodies(name, g, p)
    z = np.append(z, 0) if len(z) == 2 else z
    return np.array([(M @ z + b) @ eta for eta in fields])


@pytest.mark.parametrize("name", DEFAULTS)
def test_along_trajectories(name):
    """The momenta are kept, and the horizontal kinetic energy with the potential is the energy."""
    r, p = found(name), DEFAULTS[name]
    attitudes, speeds, energy = motion(name, np.linspace(0, 10, 60))
    own = [momenta(name, g, z, p) for g, z in zip(attitudes, speeds, strict=True)]
    assert np.ptp(own, axis=0).max() < 1e-9
    steps = {e.lhs: e.rhs for x in ("connection", "effective") for e in r[x].equations}
    kinetic = next(e.rhs for e in r["effective"].equations if e.lhs == "h̃")
    for g, z, mu, h in zip(attitudes, speeds, own, energy, strict=True):
        z = np.append(z, 0) if len(z) == 2 else z
        known = {"p": p, "A": g, "𝒥": mu, "ζ": z, "𝒜": np.zeros(len(mu))}
        told = [k for k in steps if isinstance(k, tuple) and k[0] == "call"]
        for k in told:
            known["𝒜"][k[1][2] - 1] = value(steps[k], **known)
        flat = np.zeros(3)
        for k in steps:
            if isinstance(k, tuple) and k[0] == "entry":
                flat[k[2] - 1] = value(steps[k], **known)
        V = value(r.effective_potential.rhs, **known)
        total = value(kinetic, **known, **{"ζ_h": flat, "𝒱": V})
        assert total == pytest.approx(h, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("name", ["lagrange_top", "spherical_pendulum"])
def test_the_reduced_equation_moves_as_the_full_one(name):
    """u of ü = ½ df/du, integrated alone, is A₃₃ of the full motion."""
    r, p = found(name), DEFAULTS[name]
    t = np.linspace(0, 10, 200)
    attitudes, speeds, energy = motion(name, t)
    mu = momenta(name, attitudes[0], speeds[0], p)

    def f(u):
        A = np.zeros((3, 3))
        A[2, 2] = u
        return value(r.quadrature.rhs, p=p, A=A, **{"𝒥": mu, "h̃": energy[0]})

    nodes = np.linspace(-1, 1, 7)
    slope = np.polyder(np.polyfit(nodes, [f(u) for u in nodes], 3))
    u0, z = attitudes[0, 2], np.append(speeds[0], 0)[:3]
    rate = u0[0] * z[1] - u0[1] * z[0]
    assert rate**2 == pytest.approx(f(u0[2]), rel=1e-9)
    given = {"t_eval": t, "method": "DOP853", "rtol": 1e-12, "atol": 1e-12}
    alone = solve_ivp(
        lambda _, y: [y[1], np.polyval(slope, y[0]) / 2], (0, 10), [u0[2], rate], **given
    )
    assert np.abs(alone.y[0] - attitudes[:, 2, 2]).max() < 1e-7
