"""Random problems that are valid: the record holds, and C = Python = Gauss's principle."""

import os

import numpy as np
from hypothesis import HealthCheck, assume, given, settings

from derive.code.assemble import assemble
from derive.code.emit import emit
from derive.mechanics.problem import ProblemError
from derive.mechanics.toml import problem_of
from derive.pipeline import walk
from derive.record.check import Checker
from derive.record.record import from_json, to_json
from derive.record.vocabulary import ANY_GROUP
from tests.emitted import compile_c, present
from tests.oracles import general, relative_error
from tests.random_problems import of_points, of_solids

EXAMPLES = int(os.environ.get("EXAMPLES", "16"))
"""`make fuzz` takes more."""
STATES = 3
COMPILED = 5
"""One in so many problems is compiled as C, too."""
RANDOM = settings(
    max_examples=EXAMPLES,
    derandomize=True,
    database=None,
    deadline=None,
    suppress_health_check=[*HealthCheck],
)
FEWER = settings(RANDOM, max_examples=max(EXAMPLES // 3, 1))


def derived(data):
    """The problem of a file and its record, which holds; degenerate bodies are left out."""
    try:
        problem = problem_of(data)
    except ProblemError as error:
        assume("moves no mass" not in str(error))
        raise
    record = walk(problem)
    again = from_json(to_json(record))
    assert again == record
    checker = Checker(again.problem)
    verdicts = [checker.check(step) for step in again.steps if step.scope != ANY_GROUP]
    assert [f"{v.label}: {v.reason}" for v in verdicts if not v.holds] == []
    assert max(v.bound for v in verdicts) < 1e-30
    return problem, record


def agree(problem, record, data, folder, p):
    """The emitted code against the oracle, which gets ``data``; C once in a while."""
    files = emit(assemble(record, problem.group), record, ("c", "python"), "test")
    space = {}
    exec(compile(files["test.py"], "test.py", "exec"), space)
    rng = np.random.default_rng(len(files["test.py"]))
    values = [{**general.parameters(data), **p}[name] for name in space["PARAMETERS"]]
    k, basis, library = space["constants"](values), space["BASIS"], None
    if len(files["test.py"]) % COMPILED == 0 and present("gcc"):
        for name, text in files.items():
            (folder / name).write_text(text, encoding="utf-8")
        library = compile_c("gcc", "test", folder, folder)
    for _ in range(STATES):
        x = general.random_state(data, basis, rng)
        t, u = rng.normal(), rng.normal(size=len(space["INPUTS"]))
        try:
            expected = general.rhs(data, basis, general.parameters(data), t, x, u)
        except np.linalg.LinAlgError:  # the points are nearly on a plane
            assume(False)
        found = space["rhs"](t, x, k, u)
        assert relative_error(found, expected) < 1e-8
        energy = general.energy(data, basis, general.parameters(data), t, x)
        assert abs(space["energy"](t, x, k) - energy) < 1e-9 * max(1, abs(energy))
        if library is not None:
            assert relative_error(library.rhs(t, x, library.constants(values)[1], u), found) < 1e-11


@RANDOM
@given(data=of_points())
def test_points(tmp_path_factory, data):
    problem, record = derived(data)
    agree(problem, record, data, tmp_path_factory.mktemp("random"), {})


@FEWER
@given(data=of_solids())
def test_solids(tmp_path_factory, data):
    """The oracle gets the moments of the solids by quadrature."""
    problem, record = derived(data)
    moments = gridded(data)
    other = {k: x for k, x in data.items() if k != "solid"}
    other |= {"parameters": data["parameters"] | moments, "body": {"moments": "symbolic"}}
    agree(problem, record, other, tmp_path_factory.mktemp("random"), data["parameters"])


def gridded(data):
    """m, c_1 …, J_11 … of solids by Gauss–Legendre quadrature, exact for their polynomials."""
    total = np.zeros((4, 4))
    for solid in data["solid"]:
        env = data["parameters"]
        weights, points = nodes(solid, env)
        turn, shift = np.eye(3), np.zeros((3, 1))
        if "rotation" in solid:
            axis = np.array(solid["rotation"]["axis"], float)
            angle = general.evaluate(solid["rotation"]["angle"], env)
            x, y, z = axis / np.linalg.norm(axis)
            turn = general.expm(angle * np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]]))
        if "shift" in solid:
            shift = np.array([[general.evaluate(s, env)] for s in solid["shift"]])
        r = np.vstack([turn @ points + shift, np.ones(points.shape[1])])
        total += general.evaluate(solid["density"], env) * (r * weights) @ r.T
    found = {"m": total[3, 3]} | {f"c_{i + 1}": total[i, 3] for i in range(3)}
    found |= {f"J_{i + 1}{j + 1}": total[i, j] for i in range(3) for j in range(i, 3)}
    return {k: float(x) for k, x in found.items()}


def nodes(solid, env):
    """Weights (k,) and points (3, k) of a quadrature over a solid in its own frame."""
    kind = solid["kind"]
    lengths = {"radius", "height", "sides", "semi_axes", "outer", "inner"} & {*solid}
    given_sizes = {k: solid[k] if isinstance(solid[k], list) else [solid[k]] for k in lengths}
    sizes = {k: np.array([general.evaluate(y, env) for y in x]) for k, x in given_sizes.items()}
    x, w = np.polynomial.legendre.leggauss(6)
    unit, half = (x + 1) / 2, w / 2
    angle = np.arange(12) * np.pi / 6
    if kind == "box":
        X = np.array(np.meshgrid(x / 2, x / 2, x / 2)).reshape(3, -1)
        W = np.einsum("i,j,k->ijk", half, half, half).ravel()
        return W * sizes["sides"].prod(), X * sizes["sides"][:, None]
    if kind in ("cylinder", "cone"):
        z, s, a = np.meshgrid(unit, unit, angle, indexing="ij")
        wide = 1 - z if kind == "cone" else np.ones_like(z)
        W = np.einsum("i,j->ij", half, half)[..., None] * s * wide**2 * np.pi / 6
        radius, height = sizes["radius"][0], sizes["height"][0]
        up = z - (0.5 if kind == "cylinder" else 0)
        X = np.stack([radius * wide * s * np.cos(a), radius * wide * s * np.sin(a), height * up])
        return (W * radius**2 * height).ravel(), X.reshape(3, -1)
    r, c, a = np.meshgrid(unit, x, angle, indexing="ij")
    side = np.sqrt(1 - c**2)
    X = np.stack([r * side * np.cos(a), r * side * np.sin(a), r * c]).reshape(3, -1)
    W = (np.einsum("i,j->ij", half, w)[..., None] * r**2 * np.pi / 6).ravel()
    if kind == "hollow_ball":
        outer, inner = sizes["outer"][0], sizes["inner"][0]
        return np.concatenate([W * outer**3, -W * inner**3]), np.hstack([X * outer, X * inner])
    axes = sizes["semi_axes"] if kind == "ellipsoid" else np.repeat(sizes["radius"], 3)
    return W * axes.prod(), X * axes[:, None]
