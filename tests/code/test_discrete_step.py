"""The emitted discrete step: the motion that the record tells, its order, what it keeps, what it
tells.  Steps have their orders: of the explicit methods every condition of every rooted tree, in 40
digits; of compositions every condition in the free algebra, in 24.

A symmetric step h is the exponential of h X_1 + h³ X_3 + h⁵ X_5 + …, with X that do not commute; a
composition of parts γ_i h has the order p where its product is exp(h X_1) in all words up to h^p.
"""

import tomllib
from decimal import Decimal, localcontext
from functools import cache
from math import factorial, log2

import mpmath
import numpy as np
import pytest

import derive
from derive.code.step.tableaux import rk4, vern9, weights
from derive.language import rational as q
from derive.pipeline import discrete
from derive.problem.toml import problem_of
from tests.oracles.rooted_trees import Weights, trees
from tests.problems import thrown
from tests.support.corpus import DRIVEN_ON, driven
from tests.support.discrete_maps import DiscreteMap, real
from tests.support.library import module_of
from tests.support.needs import need

SLOW = pytest.mark.dist
BODY = {"m": 2, "J_11": 1.3, "J_12": 0.1, "J_13": 0, "J_22": 0.9, "J_23": 0.05, "J_33": 0.4}
BODY |= {"c_1": 0.1, "c_2": 0.2, "c_3": 0.3, "g_1": 0.5, "g_2": 1, "g_3": -2}


@cache
def walked(name):
    """A problem by its name, or on a group one with inputs and damping."""
    if name == "thrown":
        text = thrown.TEXT
    elif name == "tied":
        text = driven("SE(3)", 0).partition("damping")[0]
    elif "(" in name:
        text = driven(name.removeprefix("free "), 0)
        lines = text.splitlines()
        if name.startswith("free "):
            lines = [x for x in lines if not x.startswith("potential")]
        text = "\n".join(lines)
    else:
        return derive.derive(name)
    return derive.derive(problem_of(tomllib.loads(text)))


@cache
def compiled(name, order=2, **further):
    need("cc")
    flags = ("-std=c99", "-O1", "-fPIC", "-shared")
    both = {"step": ("discrete", "gauss"), "order": order, "flags": flags}
    f = derive.compile(walked(name), **both, **further)
    known = walked(name).problem.parameters
    values = {x: 1.0 if known[x].default is None else known[x].default for x in f.PARAMETERS}
    f.use(values | {x: y for x, y in BODY.items() if x in values and known[x].default is None})
    f.u = np.linspace(-0.3, 0.5, len(f.INPUTS))
    return f


def start(f, scale=0.5, seed=2):
    """A state at 1 with a velocity, by the names of its numbers."""
    x = np.array([float(s[0] == "A" and s[2] == s[-1]) for s in f.STATE])
    group = sum(s[0] in "AT" for s in f.STATE)
    x[group:] = scale * np.random.default_rng(seed).normal(size=len(x) - group)
    return x


def element(names, x, size):
    """The matrix of a state."""
    g = np.eye(size)
    for name, value in zip(names, x, strict=True):
        letter, *place = name.split("_")
        if letter in "AT":
            i, j = (*map(int, place[0]), size)[:2]
            g[i - 1, j - 1] = value
    return tuple(tuple(map(mpmath.mpf, row)) for row in g)


# ---------------------------------------------------------------- the record's motion

QUICK = ("so3", "gl3", "heisenberg", "screw", "free SO(3)", "free GL(3)")
THOROUGH = ("se3", "sl3", "so4", "sp4", "free SL(3)")


@pytest.mark.parametrize(
    "name",
    [*QUICK, *(pytest.param(x, marks=SLOW) for x in THOROUGH)],
)
def test_it_is_the_motion_that_the_record_tells(name):
    """Two steps between three elements: what the last equations of the record give for the third,
    with inputs and damping."""
    f, problem, h = compiled(name), walked(name).problem, 0.1
    m, states = f.begin(start(f)).move(h), []
    for _ in range(3):
        states.append(element(f.STATE, m.x, problem.group.size))
        m.move(h)
    values = dict(zip(f.PARAMETERS, f._in_use().p, strict=True))
    with mpmath.workdps(30):
        known = DiscreteMap(discrete(problem), problem.group, values, h, real, mpmath.mpf("1e-10"))
        u = iter(map(real, f.u))
        for given in problem.inputs:
            known.parameters |= {x: next(u) for x in problem.numbers_of(given)}
        found, _ = known.next(*states[:2])
        off = (abs(x) for row in q.minus(found, states[2]) for x in row)
        assert max(off) < 1e-14


@pytest.mark.parametrize("name", ["so4", "sp4"])
def test_a_turn_is_by_cayley_s_transform(name):
    """(1 + V′)(1 − ½X) = (1 + V)(1 + ½X) of any V and X, by the emitted Python: a step converges
    quickly, and stays in the group, by no other factor."""
    code, rng = module_of(name, step="discrete"), np.random.default_rng(3)
    one, basis = np.eye(4), np.array(code.BASIS)
    V, turn = rng.normal(size=(4, 4)), rng.normal(size=len(basis)) / 4
    X = np.tensordot(turn, basis, 1)
    found = np.reshape(code._step_turn(np, V.ravel(), turn), (4, 4))
    expected = (one + V) @ (one + X / 2)
    assert np.abs((one + found) @ (one - X / 2) - expected).max() < 1e-13


# ---------------------------------------------------------------- order


@pytest.mark.parametrize("order", [2, 4, 6, 8])
@pytest.mark.parametrize("name", ["so3", "sl3", "heisenberg", "se3", *DRIVEN_ON])
def test_it_has_its_order(name, order):
    """By halving, against Gauss's collocation, with inputs and damping too; and within a step."""
    f = compiled(name, order)
    driven = name in DRIVEN_ON
    T, n = (0.5, 8) if driven else (1.2, {2: 40, 4: 16, 6: 6, 8: 3}[order])
    x = start(f, 0.3 if driven else 0.9)
    errors = []
    end = f.begin(x).move_to(T, 1e-14, "gauss").x
    for count in (n, 2 * n):
        m = f.begin(x).move(T / count, count)
        errors.append(np.abs(m.x - end).max())
    assert errors[1] > 3e-15 or order == 8 or driven
    if errors[1] > 1e-12:
        assert order - 0.35 < log2(errors[0] / errors[1]) < order + 0.8, errors
    within = f.begin(x).move_to(T - T / count / 3, 1e-14, "gauss").x
    assert np.abs(m.dense(T - T / count / 3) - within).max() < 4 * errors[1] + 1e-13


def test_forces_are_those_of_the_time():
    """At order 2, which is of one part; of more, every language throws the body in test_steps."""
    f = compiled("thrown")
    f.u = np.array(thrown.PUSH)
    errors = [
        np.abs(f.begin(thrown.state(0)).move(1 / n, n).x - thrown.state(1)).max() for n in (40, 80)
    ]
    assert 1.8 < log2(errors[0] / errors[1]) < 2.2


# ---------------------------------------------------------------- what is kept


def energies(f, x, h, n, each=100):
    """The errors of the energy along n steps, relative to the kinetic energy at first."""
    m, e = f.begin(x), f.energy(0, x)
    still = np.where([s.startswith(("zeta", "w")) for s in f.STATE], 0, x)
    found = [f.energy(0, m.move(h, each).x) - e for _ in range(n // each)]
    return np.abs(found) / (e - f.energy(0, still))


@pytest.mark.parametrize("order", [2, 4, pytest.param(6, marks=SLOW)])
@pytest.mark.parametrize("name", ["so3", "tied", "sl3"])
def test_the_energy_does_not_drift(name, order):
    """Over 10^6 steps it errs at most twice as much as over the first 10^4."""
    f = compiled(name, order)
    f.u = np.zeros(len(f.INPUTS))
    x = start(f)
    h = {2: 0.02, 4: 0.05, 6: 0.1}[order]
    first = energies(f, x, h, 10_000, each=5).max()  # few numbers would miss the largest
    found = energies(f, x, h, 1_000_000).max()
    compiled.cache_clear()
    assert first > 1e-13  # it is no rounding that is measured
    assert found < 2 * first


def test_a_step_that_begins_on_the_last_ones_ends_where_it_should():
    """Long steps of a chaotic motion, which a polynomial through the last ones may lead far off:
    each ends at the solution that is near, not at another one."""
    f = compiled("so4", 6)
    found = energies(f, start(f), 0.06, 8000, 20)
    assert 1e-8 < found.max() < 1e-3


@pytest.mark.parametrize("order", [2, 6])
@pytest.mark.parametrize("name", ["top", "sl3", "so4"])
def test_momenta_are_kept_to_rounding(name, order):
    """What symmetries keep, in space and of the body."""
    f = compiled(name, order, conserved=True)
    x = start(f)
    m, before = f.begin(x), f.conserved(0, x)
    momenta = [i for i, s in enumerate(f.CONSERVED) if "momentum" in s]
    assert momenta
    for _ in range(10):
        after = f.conserved(0, m.move(0.02, 1000).x)
        errors = np.abs(after - before)[momenta]
        assert errors.max() < 1e-12 * max(np.abs(before).max(), 1)


# ---------------------------------------------------------------- what is told


@pytest.mark.parametrize(("name", "h"), [("so4", 10.0), ("sl3", 1.0), ("sp4", 10.0)])
def test_too_large_a_step_is_told_on_any_group(name, h):
    f = compiled(name)
    x = start(f, 5.0)
    m = f.begin(x)
    with pytest.raises(ArithmeticError, match="no discrete step"):
        m.move(h)
    assert np.array_equal(m.x, x)


# ---------------------------------------------------------------- orders by algebra

SMALL, CLEAR = Decimal(10) ** -40, Decimal(10) ** -9
"""What rounding may leave of a condition that holds, and the least of one that does not."""

METHODS = {"rk4": rk4(), "vern9": vern9()}


@pytest.fixture(autouse=True)
def digits():
    """The tableaux have 60 digits, whatever the context is in which they are asked for first."""
    with localcontext() as context:
        context.prec = 70
        yield


@pytest.fixture(params=METHODS)
def method(request):
    """Each method."""
    return METHODS[request.param]


def test_the_trees_are_all_there():
    """Their numbers are those of Cayley (OEIS A000081)."""
    assert [len(trees(n)) for n in range(1, 11)] == [1, 1, 2, 4, 9, 20, 48, 115, 286, 719]


def test_a_row_sums_to_its_node(method):
    """c_i = Σ_j a_ij, so that time may be a number of the state."""
    for c, row in zip(method.c, method.a, strict=True):
        assert abs(c - sum(row, Decimal(0))) < SMALL


def test_the_method_has_its_order_and_no_higher(method):
    """b, and b̂ where there is one."""
    conditions = Weights(method.a)
    for b, order in ((method.b, method.order), (method.embedded, method.embedded_order)):
        for n in range(1, order + 1):
            assert conditions.defect(b, n) < SMALL, n
        assert not b or conditions.defect(b, order + 1) > CLEAR


@pytest.mark.parametrize("theta", ["0.1", "0.5", "0.77", "1", "1.25"])
def test_the_polynomial_has_its_order_and_no_higher(method, theta):
    """b(θ), at times within the step and one after it."""
    conditions, x = Weights(method.a), Decimal(theta)
    b = [sum((d * x ** (k + 1) for k, d in enumerate(row)), Decimal(0)) for row in method.dense]
    for n in range(1, method.dense_order + 1):
        assert conditions.defect(b, n, x) < SMALL, n
    if x != 1:
        assert conditions.defect(b, method.dense_order + 1, x) > CLEAR / 100


def test_the_polynomial_ends_where_the_step_does(method):
    """b_i(1) = b_i, so that the trajectory is continuous."""
    for i, row in enumerate(method.dense):
        b = method.b[i] if i < method.stages else Decimal(0)
        assert abs(sum(row, Decimal(0)) - b) < SMALL


def test_the_conditions_see_a_wrong_digit():
    """One number of one row off by 1e-30."""
    method = vern9()
    rows = [list(row) for row in method.a]
    rows[13][8] += Decimal(10) ** -30
    assert max(Weights(rows).defect(method.b, n) for n in range(1, 10)) > SMALL


def test_the_pair_is_verner_s():
    """Some of the numbers that he published, in 40 digits."""
    method, close = vern9(), Decimal(10) ** -39
    published = {
        "0.6590650618730998549405331618649220295334": method.c[11],
        "0.7404185470631561083004100761798676215811": method.c[17],
        "-0.3915211862331339089410228267288242030810": method.b[7],
        "-13.93734253810777678786523664804936051203": method.a[14][5],
        "0.04834231373823958314376726739772871714902": -method.error[15],
        "0.09517712399458336651642257453589397190702": method.a[20][7],
    }
    for text, found in published.items():
        assert abs(Decimal(text) - found) < close * max(1, abs(found)) * 10, text


# ---------------------------------------------------------------- compositions

STAGES = {2: 1, 4: 5, 6: 9, 8: 17}
LEFT, SEEN = Decimal(10) ** -23, Decimal(10) ** -6
"""What the decimals may leave of a condition that holds, and the least of one that does not."""


def product(a, b, most):
    """The product of two sums of words up to a degree; a word is the degrees of its letters."""
    found = {}
    for v, x in a.items():
        for w, y in b.items():
            if sum(v) + sum(w) <= most:
                found[v + w] = found.get(v + w, Decimal(0)) + x * y
    return found


def exponential(letters, most):
    """exp of a sum of letters."""
    total, power = {(): Decimal(1)}, {(): Decimal(1)}
    for k in range(1, most + 1):
        power = product(power, letters, most)
        for w, x in power.items():
            total[w] = total.get(w, Decimal(0)) + x / factorial(k)
    return total


@pytest.mark.parametrize("order", STAGES)
def test_a_composition_has_its_order_and_no_higher(order):
    parts, most = weights(order), order + 1
    assert len(parts) == STAGES[order]
    assert parts == parts[::-1]
    whole = {(): Decimal(1)}
    for part in parts:
        step = {(k,): part**k for k in range(1, most + 1, 2)}
        whole = product(whole, exponential(step, most), most)
    wanted = exponential({(1,): Decimal(1)}, most)
    left = {w: abs(x - wanted.get(w, Decimal(0))) for w, x in whole.items()}
    assert len(left) > order
    assert max(x for w, x in left.items() if sum(w) <= order) < LEFT
    assert max(x for w, x in left.items() if sum(w) > order) > SEEN
