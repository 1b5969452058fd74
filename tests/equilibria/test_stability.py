"""Equilibria and what is said of their stability, in numbers and in letters, beside linearisations
by hand."""

from dataclasses import replace
from fractions import Fraction
from random import Random

import numpy as np
import pytest

from derive import ProblemError, derive
from derive.command.cli import main
from derive.problem.toml import problem_of
from derive.record.as_json import from_json
from derive.record.prose import message
from derive.record.sentence import Sentence, english
from derive.search.equilibria.energy_casimir import between_roots, diagonalised
from derive.search.equilibria.stability import polynomial, roots_of_squares
from tests.support.lagrangians import (
    LINE,
    heavy,
    heisenberg,
    lagrangian,
    nilpotent,
    squares,
    two_algebras,
)
from tests.support.walks import repeated


def test_a_free_solid_turns_about_its_axes():
    """Stable about the least and the largest moment, unstable about the middle one (Euler)."""
    found = derive("euler_top").equilibria()
    assert [x.verdict for x in found] == ["stable", "unstable", "stable"]
    assert [x.signature for x in found] == [(0, 2), (1, 1), (2, 0)]
    moments = [float(derive("euler_top").problem.parameters[f"I{a}"].default) for a in (1, 2, 3)]
    a, b, c = moments
    assert found[1].growth == pytest.approx(np.sqrt((b - a) * (c - b) / (a * c)) / b)


def test_a_leaf_that_is_a_point_says_nothing():
    found = nilpotent().equilibria({"Pi_1": 1})
    ((x,), step) = found, found.record.steps[-1]
    assert (x.verdict, x.signature) == ("open", (0, 0))
    said = english(step.prose)
    assert "is this point alone" in said
    assert not any(x in said for x in ("characteristic", "not definite"))


def test_momenta_leave_a_leaf_that_is_a_point():
    """On the affine maps of a line Π̇₁ = −Π₂², Π̇₂ = Π₁Π₂: by hand 1 and 0 at Π₁ = 1."""
    found = derive(lagrangian("(zeta_1^2 + zeta_2^2)/2", LINE)).equilibria({"Pi_1": 1})
    (x,) = found
    assert (x.verdict, x.growth) == ("unstable", pytest.approx(1))
    assert "is unstable (Lyapunov)" in english(found.record.steps[-1].prose)
    assert all(v.holds for v in found.check(1))
    resting = derive(lagrangian("(zeta_1^2 + zeta_2^2)/2", LINE)).equilibria({"Pi_1": -1})
    assert resting[0].verdict == "open"
    assert all(v.holds for v in resting.check(1))


def test_advected_coordinates_leave_a_leaf_too():
    """Of [e_1, e_2] = e_3, [e_4, e_1] = e_1, [e_4, e_2] = −e_2, ℓ with 2ζ_4, on the right: at rest
    ζ_4 = −2, by hand Π̇_1 = 2Π_1 + … and Π̇_2 = −2Π_2 + …, whatever Γ_3 is."""
    problem = {
        "name": "drifting",
        "algebra": {"brackets": [[1, 2, 3, 1], [4, 1, 1, 1], [4, 2, 2, -1]]},
        "advected": [{"name": "u", "representation": "coadjoint"}],
        "lagrangian": {
            "L": "3*(zeta_1^2 + zeta_2^2)/2 + (zeta_3^2 + zeta_4^2)/2 + 2*zeta_4 - 5*u_3",
            "trivialisation": "right",
        },
    }
    found = derive(problem_of(problem)).equilibria({"Gamma_3": 1})
    (x,) = found
    same = derive(problem_of(problem)).equilibria({"u_3": 1})
    assert same.record.steps == found.record.steps
    assert (x.verdict, x.growth) == ("unstable", pytest.approx(2))
    assert all(v.holds for v in found.check(1))


def test_rest_at_one_where_other_entries_never_vary():
    found = derive(heisenberg()).equilibria()
    assert [x.verdict for x in found] == ["stable", "stable"]
    assert not any(found[0].at)
    assert all(v.holds for v in found.check(1))


def sleeping(spin):
    """The Lagrange top upright: its verdict at a momentum about the vertical."""
    (x,) = derive("lagrange_top").equilibria({"Pi_3": spin, "A_33": 1})
    return x


def test_a_sleeping_top_wakes_where_it_spins_slowly():
    """Stable above Π₃² = 4 I₁ mgl, unstable below."""
    p = derive("lagrange_top").problem.parameters
    least = np.sqrt(4 * p["I1"].default * p["mgl"].default)
    above, below = (Fraction(str(round(least + x, 6))) for x in (0.01, -0.01))
    assert sleeping(above).verdict == "stable"
    assert sleeping(below).verdict == "unstable"


def rates(x, moments, weight):
    """Euler–Poisson by hand: weight along the first axis of the body, of the kovalevskaya_top."""
    pi, gamma = x[:3], x[3:]
    omega = pi / moments
    push = np.cross(gamma, [0, 0, 0]) + np.cross([weight, 0, 0], gamma)
    return np.concatenate([np.cross(pi, omega) - push, np.cross(gamma, omega)])


@pytest.mark.parametrize("at", [1, -1])
def test_a_top_hangs_or_stands(at):
    p = derive("kovalevskaya_top").problem.parameters
    moments = np.array([2, 2, 1]) * p["I"].default
    (found,) = derive("kovalevskaya_top").equilibria({"A_31": at})
    x = np.array([0, 0, 0, at, 0, 0], float)
    assert not rates(x, moments, p["mgl"].default).any()
    step, weight = 1e-6, p["mgl"].default
    pairs = [[rates(x + s * step * e, moments, weight) for s in (1, -1)] for e in np.eye(6)]
    slopes = [(up - down) / (2 * step) for up, down in pairs]
    growth = np.linalg.eigvals(np.array(slopes).T).real.max()
    assert found.growth == pytest.approx(growth, abs=1e-6)
    assert found.verdict == ("unstable" if growth > 1e-6 else "stable")


RECORDS = ("euler_top", "lagrange_top", "kovalevskaya_top", "euler_poisson", "kirchhoff", "manakov")


@pytest.mark.parametrize("name", repeated(RECORDS, 2))
def test_every_step_is_checked(name):
    found = derive(name).equilibria()
    new = [v for v in found.check() if ".equilibrium" in v.label or ".energy_casimir" in v.label]
    assert len(new) >= len(found) > 0
    assert [v.reason for v in new if not v.holds] == []


def test_points_and_solids_too():
    (found,) = derive("su2").equilibria({"Pi_1": 1})
    assert found.at == {"Pi_1": 1}


def test_numbers_are_needed():
    with pytest.raises(ProblemError, match="has no default"):
        derive(heavy("123", "m*A_31", "m")).equilibria()


@pytest.mark.parametrize(
    ("potential", "said"),
    [
        ("pi*A_33", "and π is none"),
        ("b*pi*A_33", "and b has no default"),
        ("cos(pi/3)*A_33", "has cos of π or parameters"),
    ],
)
def test_pi_is_no_number_here(potential, said):
    """“b, π has no default”; “cos of its parameters” where there is none."""
    with pytest.raises(ValueError, match=said):
        derive(heavy("123", potential, "b" if "b" in potential else "")).equilibria()


def test_pi_stays_a_letter_in_a_command(tmp_path, capsys):
    """The cone of ``top``: what is told of it holds, and is stable where it spins fast enough."""
    assert main(["equilibria", "top", "--format", "json"]) == 0
    told, said = capsys.readouterr()
    assert "have π, which is no fraction and stays a letter" in said
    record = from_json(told)
    upright = next(s for s in record.steps if s.label == "top.energy_casimir_2")
    assert "are stable" in english(upright.prose)
    assert "‘g’" not in english(upright.prose)
    (tmp_path / "found.json").write_text(told, encoding="utf-8")
    assert main(["check", str(tmp_path / "found.json")]) == 0


def test_squares_by_lagrange():
    rng = np.random.default_rng(3)
    for n in (1, 3, 5):
        a = rng.integers(-4, 5, size=(n, n))
        q = [[Fraction(int(x)) for x in row] for row in a + a.T - 2 * np.diag(np.diag(a))]
        squares = diagonalised(q)
        whole = sum(
            (float(d) * np.outer([*map(float, r)], [*map(float, r)]) for d, r in squares),
            np.zeros((n, n)),
        )
        assert whole == pytest.approx(np.array(q, float))
        positive = sum(np.linalg.eigvalsh(np.array(q, float)) > 1e-9)
        assert positive == sum(d > 0 for d, _ in squares)


def test_roots_and_what_is_between():
    one, two = ([[Fraction(x), 0], [0, Fraction(y)]] for x, y in ((-1, -4), (1, 1)))
    low, middle, high = sorted(between_roots(one, two))
    assert low < 1 < middle < 4 < high


@pytest.mark.parametrize(
    ("matrix", "expected"),
    [([[0, 1], [-1, 0]], False), ([[0, 1], [1, 0]], True), ([[0, 1], [0, 0]], False)],
)
def test_growth(matrix, expected):
    found = roots_of_squares(polynomial([[Fraction(x) for x in row] for row in matrix]))
    assert (found.negative < found.distinct) is expected


def test_a_leaf_of_lower_rank_is_said():
    """A free top at rest in space but for nothing: on so(3)* the origin is a leaf by itself."""
    found = derive(lagrangian("zeta_1^2 + 2*zeta_2^2 + 3*zeta_3^2")).equilibria({"Pi_1": 2})
    assert found[0].verdict == "stable"


def test_the_degree_of_what_is_kept_is_an_option(capsys):
    """The Casimir of a top is of degree 2: of degree 1 nothing is known but the energy."""
    for degree, known in (("1", False), ("2", True)):
        assert main(["equilibria", "euler_top", "--at", "Pi_3=1", "--degree", degree]) == 0
        assert ("No multiples" not in capsys.readouterr().out) == known
    weighted = derive("lagrange_top").equilibria({"A_33": 1}, degree=1).record
    assert "degrees are weighted" in str(weighted["poisson"].prose)


def test_entries_of_a_product_have_the_names_of_the_file():
    """A2_33 was no coordinate: the text has the one matrix A, whose entry that is A_66."""
    L = f"({' + '.join(f'{1 + a % 3}*zeta_{a}^2' for a in range(1, 7))})/2 - A1_33 - A2_33"
    own = {"name": "own", "group": "SO(3) x SO(3)", "lagrangian": {"L": L}}
    d = derive(problem_of(own))
    (x,), (y,) = (d.equilibria(at) for at in ({"A1_33": 1, "A2_33": 1}, {"A_33": 1, "A_66": 1}))
    assert x.at == y.at == {"A_33": 1, "A_66": 1}


MOMENTS = [Fraction(k, 4) for k in range(1, 30)]


def solid(text, **more):
    return problem_of({"name": "own", "group": "SO(3)", **more, "lagrangian": {"L": text}})


def swimming():
    names = [f"{x}{k}" for x in "Ic" for k in (1, 2, 3)]
    rows = [[x if i == j else 0 for j in range(6)] for i, x in enumerate(names)]
    parameters = {x: {} for x in names}
    own = {"name": "swim", "group": "SE(3)", "parameters": parameters}
    return derive(problem_of(own | {"inertia": {"operator": rows}}))


def trees(found, cases):
    """The same by trees: for each case its pairs of sides."""
    from derive.search.equilibria.stability_in_letters import inequality

    algebra = found.about.algebra
    return [[inequality(algebra, *x) for x in case.beyond(found.known)] for case in cases]


def at(t, numbers):
    if isinstance(t, tuple) and t[0] == "par":
        return numbers[t[1]]
    if not isinstance(t, tuple):
        return Fraction(t)
    parts = [at(x, numbers) for x in t[1:]]
    if t[0] == "pow":
        return parts[0] ** int(parts[1])
    if t[0] == "add":
        return sum(parts)
    assert t[0] == "mul"
    product = Fraction(1)
    for x in parts:
        product *= x
    return product


def true(found, cases, numbers):
    return any(
        all(at(a, numbers) > at(b, numbers) for a, b in case) for case in trees(found, cases)
    )


def growth(rates, x):
    """The largest real part of an eigenvalue of the rates by central differences."""
    step = 1e-5
    pairs = [[rates(x + s * step * e) for s in (1, -1)] for e in np.eye(len(x))]
    slopes = np.array([(up - down) / (2 * step) for up, down in pairs]).T
    return float(np.linalg.eigvals(slopes).real.max())


@pytest.mark.parametrize("axis", [1, 2, 3])
def test_a_free_solid_in_letters(axis):
    """Stable about the largest and the smallest moment, unstable about the middle one (Euler)."""
    (x,) = [x for x in derive("euler_top").families() if f"Pi_{axis}" in x.at]
    random = Random(axis)
    for _ in range(12):
        moments = random.sample(MOMENTS, 3)
        numbers = {f"I{k}": m for k, m in enumerate(moments, 1)} | {f"ell_{axis}": Fraction(2)}
        middle = sorted(moments)[1] == moments[axis - 1]
        assert true(x.found, x.found.stable, numbers) is not middle
        assert true(x.found, x.found.unstable, numbers) is middle
        m, pi = np.array(moments, float), 2 * np.eye(3)[axis - 1]
        assert (growth(lambda y, m=m: np.cross(y, y / m), pi) > 1e-6) is middle


def test_a_sleeping_top_in_letters():
    """Stable above ℓ² = 4 I₁ mgl, unstable below; open where they are equal."""
    found = derive("lagrange_top").families()
    (x,) = [x for x in found if x.at == {"Pi_3": "ell₃", "A_33": "1"}]
    (((more, less),),) = trees(x.found, x.found.stable)
    assert trees(x.found, x.found.unstable) == [[(less, more)]]
    random = Random(7)
    for _ in range(12):
        I1, I3, mgl, ell = random.sample(MOMENTS, 4)
        numbers = {"I1": I1, "I3": I3, "mgl": mgl, "ell_3": ell}
        assert at(more, numbers) * 4 * I1 * mgl == at(less, numbers) * ell**2
        above = ell**2 > 4 * I1 * mgl
        assert true(x.found, x.found.stable, numbers) is above

        def rates(y, moments=(I1, I1, I3), mgl=float(mgl)):
            omega, gamma = y[:3] / np.array(moments, float), y[3:]
            push = np.cross([0, 0, mgl], gamma)
            return np.concatenate([np.cross(y[:3], omega) - push, np.cross(gamma, omega)])

        grown = growth(rates, np.array([0, 0, float(ell), 0, 0, 1]))
        if abs(float(ell**2 / (4 * I1 * mgl)) - 1) > 0.05:
            assert (grown > 1e-4) is not above


def test_the_search_in_numbers_says_the_same():
    (x,) = [x for x in derive("lagrange_top").families() if x.at == {"Pi_3": "ell₃", "A_33": "1"}]
    random = Random(2)
    for _ in range(4):
        I1, I3, mgl, ell = random.sample(MOMENTS, 4)
        L = f"({I1}*(zeta_1^2 + zeta_2^2) + {I3}*zeta_3^2)/2 - {mgl}*A_33"
        (there,) = derive(solid(L)).equilibria({"Pi_3": ell, "A_33": 1})
        numbers = {"I1": I1, "I3": I3, "mgl": mgl, "ell_3": ell}
        assert (there.verdict == "stable") is true(x.found, x.found.stable, numbers)
        assert (there.verdict == "unstable") is true(x.found, x.found.unstable, numbers)


def test_a_solid_that_swims_broadside_in_letters():
    """Along axis 3: stable where c₃ is the largest added mass, unstable if it is less than one."""
    (x,) = [x for x in swimming().families() if x.at == {"Pi_6": "ell₆"}]
    random = Random(3)
    for _ in range(12):
        several = random.sample(MOMENTS, 6)
        names = ("I1", "I2", "I3", "c1", "c2", "c3")
        numbers = dict(zip(names, several, strict=True)) | {"ell_6": Fraction(3)}
        largest = several[5] == max(several[3:])
        assert true(x.found, x.found.stable, numbers) is largest
        assert true(x.found, x.found.unstable, numbers) is not largest
        m = np.array(several, float)

        def rates(y, m=m):
            turn, go = y[:3] / m[:3], y[3:] / m[3:]
            moment = np.cross(y[:3], turn) + np.cross(y[3:], go)
            return np.concatenate([moment, np.cross(y[3:], turn)])

        assert (growth(rates, np.array([0, 0, 0, 0, 0, 3.0])) > 1e-4) is not largest


def test_a_cone_of_a_density_in_letters():
    """Π = ℓ upright: of a mass m = πρR²h/3 at 3h/4, with I₁ = 3m(R² + 4h²)/20."""
    found = derive("top").families()
    (x,) = [x for x in found if x.at == {"Pi_3": "ell₃", "A_33": "1"}]
    (((more, less),),) = trees(x.found, x.found.stable)
    values = {"rho": Fraction(3), "R": Fraction(2, 3), "h": Fraction(5, 4), "g": Fraction(7)}

    def weighed(t, pi):
        from derive.language.tree import replaced

        return at(replaced(t, "π", pi), values | {"ell_3": Fraction(11)})

    pi = Fraction(22, 7)
    m = pi * values["rho"] * values["R"] ** 2 * values["h"] / 3
    I1 = 3 * m * (values["R"] ** 2 + 4 * values["h"] ** 2) / 20
    threshold = 4 * I1 * m * values["g"] * 3 * values["h"] / 4
    assert weighed(more, pi) * threshold == weighed(less, pi) * 121


BRACED = lagrangian(
    "(a*zeta_1^2 + b*zeta_2^2 + c*zeta_3^2)/2 + k*zeta_1*zeta_3 - (A_12^2 + A_23^2)/2",
    "UT(3)",
    "a b c k",
)
"""A particle in a magnetic field, its two masses joined: k² < ac."""
IN_LETTERS = {
    "euler_top": lambda: "euler_top",
    "lagrange_top": lambda: "lagrange_top",
    "braced": lambda: BRACED,
    "two algebras": lambda: two_algebras("k", k={}),
    "two algebras in numbers": lambda: two_algebras("1"),
}


@pytest.mark.parametrize("name", IN_LETTERS)
def test_every_family_is_checked(name):
    found = derive(IN_LETTERS[name]()).families()
    assert [v.reason for v in found.check(1) if not v.holds] == []


def test_what_cannot_be_is_no_case():
    """By hand: a > 0, as ac > k², and (a − c)² + 4k² < 0 nowhere."""
    rest, turning = derive(BRACED).families()
    assert (rest.unstable, turning.unstable) == ((), ())
    (case,) = rest.stable
    assert case[1:] == ("k² > 0",)
    assert len(turning.stable) == 1
    said = " ".join(english(s.prose) for s in derive(BRACED).families().record.steps)
    assert said.count("no eigenvalue has a positive real part") == 2
    (hanging,) = [x for x in derive("kovalevskaya_top").families() if "A_31" in x.at][-1:]
    assert hanging.stable == (("mgl > 0",),)


@pytest.mark.parametrize("seed", repeated(range(6)))
def test_what_is_shown_to_be_positive_is(seed):
    """Of polynomials in a letter that is positive, one that does not vanish, and any other."""
    from sympy import QQ, ring

    from derive.search.equilibria.stability_in_letters import Case

    R, x, y, z = ring("x y z", QQ)
    known = Case(((1, frozenset([x])),), frozenset([x, y]))
    draw, shown = Random(seed), []
    for _ in range(400):
        parts = [draw.randint(-2, 2) * p for p in (x, y, z, x * y, R(1))]
        f = sum(p**2 for p in draw.sample(parts, 3)) + (parts[0] + parts[1] - parts[2]) ** 2
        f += draw.choice([1, 0, -1]) * x * draw.choice([1, y**2, x * z**2])
        shown += [(f, x) for x in (True, False) if known.shows(f, strictly=x)]
    assert len(shown) > 100
    for f, strictly in shown:
        for _ in range(30):
            at = [Fraction(draw.randint(1, 60), draw.randint(1, 40)) for _ in "xyz"]
            at = [at[0], at[1] * draw.choice([1, -1]), at[2] * draw.choice([0, 1, -1])]
            value = f.evaluate([*zip((x, y, z), map(QQ.convert, at), strict=True)])
            assert value > 0 or (value == 0 and not strictly), f


def test_off_the_leaf_by_a_form_that_is_definite_there():
    """h̃ + ½k|u|² of a top that hangs at rest, on a leaf that is smaller than others."""
    weighed = derive(two_algebras("k", k={})).families()
    hanging = next(x for x in weighed if x.at == {"u_3": "−1"})
    assert hanging.stable == (("k > 0",),)
    told = {c.kind for s in weighed.record.steps for c in s.claims}
    assert {"family.stable_beyond", "family.on_the_leaf_always"} <= told
    from derive.check.checker import check

    record = derive(two_algebras("1")).families().record
    wrong = renamed(record, "family.on_the_leaf_always", "family.stable_beyond_always")
    bad = [v for v in check(wrong, 1) if not v.holds]
    assert [v.label[2:] for v in bad] == ["equilibrium_1", "equilibrium_3", "energy_casimir_9"]
    assert all("what follows is: on_the_leaf" in v.reason for v in bad)


def renamed(record, old, new):
    """A record that says another sentence, without places, in the place of one."""
    steps = []
    for s in record.steps:
        claims = tuple(replace(c, kind=new) if c.kind == old else c for c in s.claims)
        prose = tuple(Sentence(message(new)) if x.message == message(old) else x for x in s.prose)
        steps.append(replace(s, claims=claims, prose=prose))
    return replace(record, steps=tuple(steps))


def corrupted(record, old, new):
    """The claims of a record with other inequalities, and its sentences made of them."""
    from derive.record.sentence import rendered

    def changed(t):
        if t == old:
            return new
        return (t[0], *map(changed, t[1:])) if isinstance(t, tuple) else t

    steps = []
    for s in record.steps:
        claims, prose = [], [*s.prose]
        for c in s.claims:
            values = tuple((k, changed(v)) for k, v in c.values if c.kind.startswith("family"))
            other = replace(c, values=values) if c.kind.startswith("family") else c
            prose = [rendered(other) if x == rendered(c) else x for x in prose]
            claims.append(other)
        steps.append(replace(s, claims=tuple(claims), prose=tuple(prose)))
    return replace(record, steps=tuple(steps))


def test_another_threshold_is_refused():
    """4 I₁ mgl is 4, not 4 + 1/10⁶, in both inequalities."""
    from derive.check.checker import check

    record = derive("lagrange_top").families().record
    old = ("mul", 4, ("par", "I1"), ("par", "mgl"))
    near = ("mul", Fraction(4000001, 1000000), ("par", "I1"), ("par", "mgl"))
    bad = [v for v in check(corrupted(record, old, near), 1) if not v.holds]
    assert {v.label.rpartition(".")[2] for v in bad} >= {"energy_casimir_2", "energy_casimir_4"}


TURNS = [
    [[0, 0, 0], [0, 0, -1], [0, 1, 0]],
    [[0, 0, 1], [0, 0, 0], [-1, 0, 0]],
    [[0, -1, 0], [1, 0, 0], [0, 0, 0]],
]
"""j(e₁), j(e₂), j(e₃)."""


def test_where_a_body_points_is_said_of_a_group_by_its_basis():
    """As of the one with the name, unless it is not turned by all rotations."""
    own, axis = ({"name": "Own", "action": "linear", "basis": x} for x in (TURNS, TURNS[:1]))

    def said(kinetic, group):
        found = derive(lagrangian(f"({kinetic})/2 + A_33", group)).equilibria({"A_33": 1})
        assert all(x.holds for x in found.check(1))
        claims = (x for step in found.record.steps for x in step.claims)
        return [x for x in claims if x.kind.startswith("position.")]

    assert said(squares(1, 1, 2), own) == said(squares(1, 1, 2), "SO(3)") != []
    assert said("zeta_1^2", axis) == []
