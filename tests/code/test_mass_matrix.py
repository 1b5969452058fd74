"""The mass matrix: that of the points; of any signs, what the emitted code divides by, beside a
dense solve; by --dynamics what is supplied gives the rates wanted, and the rates of a motion what
was supplied, in every language.
"""

import random
import tomllib

import numpy as np
import pytest

import derive
from derive.language.limits import LISTENER
from derive.problem.toml import problem_of
from tests.oracles import general, relative_error
from tests.problems import PROBLEMS
from tests.support.emitted_files import Emission
from tests.support.library import ONE_BUILD, emission, library, module_of

T = 0.4


@pytest.mark.parametrize("name", ["SE(3) outputs", "SL(2) outputs", "SE(3) torques"])
def test_it_is_the_metric_of_the_points(name):
    """Supplied by the covector input where there is one, M a + b gives the rates a."""
    data = tomllib.loads(PROBLEMS[name])
    space = vars(module_of(problem_of(data), dynamics=True))
    p, basis, rng = general.parameters(data), space["BASIS"], np.random.default_rng(3)
    k, d = space["constants"]([p[x] for x in space["PARAMETERS"]]), len(basis)
    x, u = general.random_state(data, basis, rng), rng.normal(size=len(space["INPUTS"]))
    found = general.places(data, p)
    G, _ = general.split(data, x, d)
    design = np.column_stack([found.moved(G @ E) for E in np.asarray(basis, float)])
    M = design.T @ (found.masses[:, None] * design)
    assert relative_error(space["mass_matrix"](T, x, k), M) < 1e-12
    rates = general.rhs(data, basis, p, T, x, u)[-d:]
    assert relative_error(space["bias"](T, x, k, u), -M @ rates) < 1e-11
    if any(y["kind"] == "covector" for y in data.get("input", ())):
        wanted, supplied = rng.normal(size=d), np.array(u)
        at = [i for i, y in enumerate(space["INPUTS"]) if y.startswith("u_")]
        supplied[at] += space["mass_matrix"](T, x, k) @ wanted + space["bias"](T, x, k, u)
        assert relative_error(space["rhs"](T, x, k, supplied)[-d:], wanted) < 1e-10


def body(group, n, *blocks, **more):
    """Heavy points, driven by a covector on each factor."""
    rng = np.random.default_rng(8)
    places = [rng.integers(-3, 4, size=n).tolist() for _ in range(n + 2)]
    on = [{"block": x} for x in blocks] or [{}]
    data = {
        "name": "test",
        "group": group,
        "point": [{"mass": i, "at": x} | y for y in on for i, x in enumerate(places, 1)],
        "potential": [{"kind": "gravity", "g": [1, -2, 3][:n]}],
        "input": [{"name": "u", "kind": "covector"}],
    }
    return data | more


DRIVEN = {
    "SO(3)": lambda: body("SO(3)", 3),
    "SE(3)": lambda: body("SE(3)", 3),
    "SL(3)": lambda: body("SL(3)", 3),
    "SO(3) x SE(3)": lambda: body("SO(3) x SE(3)", 3, 1, 2),
    "SO(2)": lambda: body("SO(2)", 2, damping=[{"kind": "quadratic", "coefficient": 1, "on": [1]}]),
}


@pytest.mark.parametrize("language", ONE_BUILD)
@pytest.mark.parametrize("name", DRIVEN)
def test_the_rates_of_a_motion_tell_what_drives_it(name, language):
    data, rng = DRIVEN[name](), np.random.default_rng(2)
    problem = problem_of(data)
    code = library(ONE_BUILD[language], problem, dynamics=True)
    _, k = code.constants(np.zeros(0))
    basis = np.array(problem.group.in_user_basis.basis, float)
    x, u = general.random_state(data, basis, rng), rng.normal(size=len(basis))
    rates = code.said("rhs", x, T, k=k, u=u)[-len(u) :]
    assert relative_error(code.said("inverse", x, T, k=k, dzeta=rates), u) < 1e-12
    if language == "c":
        f = derive.compile(problem, dynamics=True)
        assert relative_error(f.inverse(T, x, rates), u) < 1e-12


def test_what_acts_without_inputs_has_no_rates_where_one_is_divided_by():
    force = [{"at": [1, 0], "frame": "space", "force": ["1/s", 0]}]
    given = [{"name": "s", "kind": "force", "at": [0, 1], "frame": "body", "direction": [1, 0]}]
    problem = problem_of(body("SO(2)", 2, input=given, force=force))
    heard = list[str]()
    told = LISTENER.set(heard.append)
    _, texts = emission(problem, ("c",), dynamics=True)
    LISTENER.reset(told)
    assert heard[-1].endswith("no inverse is written, as an input is divided by")
    assert "test_bias(" in texts["test.h"]
    assert "test_inverse(" not in texts["test.h"]
    with pytest.raises(ValueError, match="an input is divided by"):
        derive.compile(problem, dynamics=True).inverse(T, np.zeros(5), [0])


# ---------------------------------------------------------------- any signs

DEFAULTS = {"p": 0.7, "q": -1.3, "r": 2.1}
ALGEBRAS = {"SL(2)": 3, "SO(4)": 6}
FIXED = {
    "pairs": [[0, 1, 0], [1, 0, 0], [0, 0, 2]],
    "a zero first": [[0, 1, 2], [1, 3, 1], [2, 1, 0]],
    "a corner": [["p", 1, 0], [1, 0, 0], [0, 0, 2]],
    "two parameters": [["p", "q", 0], ["q", 0, 0], [0, 0, 1]],
    "equal minors": [["p", "p", 1], ["p", "p", 2], [1, 2, 0]],
    "no diagonal": [[0, "p", "q"], ["p", 0, "r"], ["q", "r", 0]],
}


def drawn(seed, n=6):
    """A symmetric matrix of small numbers, many of them 0, and parameters."""
    some = random.Random(seed)
    entries = [0, 0, 0, 0, 1, -2, *DEFAULTS]
    m = [[some.choice(entries) for _ in range(n)] for _ in range(n)]
    return [[m[min(i, j)][max(i, j)] for j in range(n)] for i in range(n)]


def valued(m):
    return np.array([[DEFAULTS.get(x, x) for x in row] for row in m], float)


def typed(operator, name="test"):
    group = next(x for x, n in ALGEBRAS.items() if n == len(operator))
    used = {x: DEFAULTS[x] for row in operator for x in row if x in DEFAULTS}
    data = {"name": name, "group": group, "inertia": {"operator": operator}, "parameters": used}
    return problem_of(data | {"input": [{"name": "u", "kind": "covector"}]})


REGULAR = [m for m in map(drawn, range(40)) if abs(np.linalg.det(valued(m))) > 0.05][:4]


@pytest.mark.parametrize("m", [*FIXED.values(), *REGULAR])
def test_pushes_move_as_the_inverse_says(m):
    f, rng = derive.compile(typed(m), momenta=True), np.random.default_rng(1)
    u, zeta = rng.normal(size=(2, len(m)))
    x = np.zeros(len(f.STATE))
    x[-len(m) :] = zeta
    pushed = f.rhs(0.0, x, u) - f.rhs(0.0, x, np.zeros(len(m)))
    assert np.allclose(pushed[-len(m) :], np.linalg.solve(valued(m), u), rtol=1e-10, atol=1e-12)
    y = f.momentum(0.0, x)
    assert np.allclose(y[-len(m) :], valued(m) @ zeta)
    assert np.allclose(f.velocity(0.0, y), x)


@pytest.mark.parametrize(
    ("case", "regular", "singular"),
    [
        ("a corner", [0.0], None),
        ("two parameters", [0.0, 1.0], [1.0, 0.0]),
        ("equal minors", [1.0], [0.0]),
    ],
)
def test_what_constants_refuses(case, regular, singular):
    """Singular matrices alone, where a pivot is a number or of rows by themselves."""
    f = module_of(typed(FIXED[case]))
    assert np.isfinite(f.constants(regular)).all()
    if singular:
        with pytest.raises(ValueError, match=r"the mass matrix is singular"):
            f.constants(singular)


def test_the_emission_is_held_by_the_validator():
    brackets = [[1, 2, 3, 1], [4, 1, 2, 1], [4, 2, 1, -1]]
    L = {"L": "(zeta_1^2 + 2*zeta_2^2)/2 + zeta_3*zeta_4"}
    data = {"name": "plane", "algebra": {"brackets": brackets}, "lagrangian": L}
    made = Emission(data, momenta=True)
    assert all(x.holds and x.read for x in made.reports(fresh=made.files))
