"""Inequalities of stability in letters, beside linearisations by hand and the search in numbers."""

from fractions import Fraction
from random import Random

import numpy as np
import pytest

from derive import derive
from derive.command.cli import main
from derive.problem.toml import problem_of

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


@pytest.mark.parametrize("name", ["euler_top", "lagrange_top"])
def test_every_family_is_checked(name):
    found = derive(name).families()
    assert [v.reason for v in found.check(1) if not v.holds] == []


def corrupted(record, old, new):
    """The claims of a record with other inequalities, and its sentences made of them."""
    from dataclasses import replace

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


def test_letters_need_no_coordinates(capsys):
    assert main(["equilibria", "lagrange_top", "--letters", "--at", "Pi_3=1"]) == 2
    assert "--letters" in capsys.readouterr().err
