"""The principal frame: the same motion as in the frame that is given, with fewer operations."""

import json
import subprocess

import numpy as np
import pytest

from derive import compile as compiled
from derive import derive
from derive.code.emit import EmitError
from derive.code.languages import LANGUAGES
from derive.code.program import LoweringError
from derive.pipeline import program, walk
from derive.problem.principal import principal
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from tests.code.test_options import drawn as state_of_any
from tests.code.test_options import state
from tests.problems import MIXED, SKEWED
from tests.support.emitted import BUILDS, compile_c, import_python
from tests.support.needs import CC, needs, present
from tests.support.walks import own_verdicts

FREE = ["1/2", "g", "-1/3"]


def pushed(group, gravity):
    """A problem of :func:`pushed_data`."""
    return problem_of(pushed_data(group, gravity))


def pushed_data(group, gravity):
    """Four points with all that can act on them: springs of all kinds, inputs, damping, gravity."""
    points = [[1, 0, 0], ["1/3", 1, 0], [0, "1/4", 1], [-1, "-1/2", "-2/3"]]
    return {
        "name": "test",
        "group": group,
        "parameters": {"m1": 1.3, "k": 2.0, "g": 0.7, "b": 0.9},
        "point": [{"mass": m, "at": at} for m, at in zip(["m1", 1, 2, 1], points, strict=True)],
        "potential": [
            {"kind": "gravity", "g": gravity},
            {"kind": "spring", "between": [1, 2], "stiffness": "k"},
            {"kind": "spring", "between": [2, 3], "stiffness": "k^2"},
            {"kind": "spring", "between": [1, 4], "stiffness": "k", "length": "1/2"},
            {"kind": "spring", "at": [0, "b", 1], "anchor": ["b", 1, 2], "stiffness": "k/3"},
            {"kind": "attraction", "strength": 2, "centre": [3, "b", -2]},
        ],
        "input": [
            {"kind": "covector", "name": "u"},
            {"kind": "force", "name": "F", "on": 3},
            {"kind": "force", "name": "B", "at": [1, "b", 0], "frame": "body"},
        ],
        "damping": [{"coefficient": "1/5", "on": [1, 3]}],
    }


def small(group, *springs):
    """Three points of the plane and gravity."""
    return problem_of(
        {
            "name": "test",
            "group": group,
            "point": [
                {"mass": m, "at": at}
                for m, at in zip([1, 2, 3], [[1, 0], ["1/3", 1], [-1, "1/4"]], strict=True)
            ],
            "potential": [
                {"kind": "gravity", "g": ["1/2", -1]},
                *springs,
            ],
        }
    )


INSIDE = {"kind": "spring", "between": [1, 3], "stiffness": 2}

GROUPS = ("SO(3)", "SE(3)", "SL(3)", "SAff(3)", "GL(3)", "Aff(3)")
OWN = {"so(3) skewed": ("linear", SKEWED), "se(3) mixed": ("affine", MIXED)}


def own(name):
    """so(3) or se(3) in a basis of one's own."""
    action, basis = OWN[name]
    table = {"name": "Own", "action": action, "basis": json.loads(f"[{basis}]")}
    return pushed(table, FREE)


PROBLEMS = {
    **{name: (lambda name=name: own(name)) for name in OWN},
    **{name: (lambda name=name: pushed(name, FREE)) for name in GROUPS},
    "upright SE(3)": lambda: pushed("SE(3)", [0, 0, "-g"]),
    "upright SL(3)": lambda: pushed("SL(3)", [0, "-g", 0]),
    **{
        name: (lambda name=name: small(name, INSIDE))
        for name in ("SE(2)", "SL(2)", "SO(2)", "SAff(2)")
    },
    "free GL(2)": lambda: small("GL(2)"),
    **{name: (lambda name=name: derive(name).problem) for name in ("so3", "se3", "sl3", "so4")},
    **{name: (lambda name=name: derive(name).problem) for name in ("comet", "saff3", "gl3", "top")},
}
CHOICES = {
    "plain": {},
    "tangent": {"velocity": "tangent"},
    "columns": {"layout": "col"},
    "quaternion": {"attitude": "quaternion"},
}
CASES = [(name, "plain") for name in PROBLEMS] + [
    (name, form)
    for name in ("SO(3)", "SE(3)", "SAff(3)", "se(3) mixed")
    for form in ("tangent", "columns", "quaternion")
    if form != "quaternion" or name != "SAff(3)"
]
CASES.append(("top", "quaternion"))


@pytest.fixture(scope="module")
def derived():
    kept = {}
    return lambda name: kept.setdefault(name, derive(PROBLEMS[name]()))


@pytest.fixture(scope="module")
def modules(derived, tmp_path_factory):
    """A function (problem, form) → the module in the given frame and that in the principal one."""
    kept = {}

    def get(name, form):
        if (name, form) not in kept:
            folder = tmp_path_factory.mktemp("frame")
            d = derived(name)
            for frame in ("given", "principal"):
                d.emit(folder, ("python", "c"), frame, frame=frame, **CHOICES[form])
            kept[name, form] = folder, *(import_python(x, folder) for x in ("given", "principal"))
        return kept[name, form]

    return get


def drawn(module, form, seed=1):
    """p of some masses, a state in the group, and inputs."""
    p, x, u, *_ = state(module, seed) if form == "plain" else loose(module, seed)
    return p, x, u


def loose(module, seed):
    """Any state: the equations are polynomial in what its relations would bind."""
    rng = np.random.default_rng(seed)
    p = state_of_any(module, seed)[0]
    x = rng.normal(size=len(module.STATE))
    if "q_0" in module.STATE:
        x[:4] /= np.linalg.norm(x[:4])
    else:
        row = next(x for x in module.STATE if x.startswith("A_1"))
        places = [module.STATE.index(row[:2] + f"{i}{j}") for i in "123" for j in "123"]
        a = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        x[places] = (a * np.linalg.det(a)).ravel()
        if module.STATE[-1].endswith("_dot"):
            z = rng.normal(size=(3, 3))
            z = z - z.T
            x[[module.STATE.index(module.STATE[i] + "_dot") for i in places]] = (
                a * np.linalg.det(a) @ z
            ).ravel()
    return p, x, rng.normal(size=len(module.INPUTS))


@pytest.mark.parametrize(("name", "form"), CASES)
def test_the_motion_is_the_same(name, form, modules):
    """x ↦ x″ carries the rates, keeps the energy, and has the inverse that is emitted."""
    _, given, framed = modules(name, form)
    for seed in range(1, 4):
        p, x, u = drawn(given, form, seed)
        k0, k = given.constants(p), framed.constants(p)
        y = framed.into_frame(x, k)
        assert np.allclose(framed.out_of_frame(y, k), x, rtol=0, atol=1e-12)
        energy = given.energy(0.3, x, k0)
        assert np.isclose(framed.energy(0.3, y, k), energy, rtol=1e-11, atol=1e-11)
        dx = given.rhs(0.3, x, k0, u)
        v = framed.inputs_into_frame(u, k) if given.INPUTS else None
        if given.INPUTS:
            assert np.allclose(framed.inputs_out_of_frame(v, k), u, rtol=0, atol=1e-12)
        step = 1e-30
        moved = framed.into_frame(x + 1j * step * dx, k.astype(complex)).imag / step
        size = np.abs(moved).max()
        assert np.allclose(framed.rhs(0.3, y, k, v), moved, rtol=0, atol=2e-12 * size)


def test_states_are_in_a_frame_of_their_own(modules):
    """Else the tests above could hold for a frame that is not changed."""
    for name in ("SO(3)", "SE(3)", "SL(3)"):
        _, given, framed = modules(name, "plain")
        p, x, _ = drawn(given, "plain")
        assert np.abs(framed.into_frame(x, framed.constants(p)) - x).max() > 0.1


@pytest.mark.parametrize("build", BUILDS)
@pytest.mark.parametrize("name", ["SO(3)", "SE(3)", "SL(3)", "Aff(3)"])
def test_the_c_moves_alike(name, build, derived, modules, tmp_path):
    """C finds its own axes, and the same."""
    folder, given, framed = modules(name, "plain")
    c = compile_c(build, "principal", tmp_path, folder)
    p, x, u = drawn(given, "plain")
    status, k = c.constants(p)
    assert status == 0
    y = c.carried("into_frame", k, x)
    v = c.carried("inputs_into_frame", k, u)
    assert np.allclose(c.carried("out_of_frame", k, y), x, rtol=0, atol=1e-12)
    assert np.allclose(c.carried("inputs_out_of_frame", k, v), u, rtol=0, atol=1e-12)
    assert np.allclose(k, framed.constants(p), rtol=1e-9, atol=1e-9)
    expected = given.rhs(0.3, x, given.constants(p), u)
    # the map is linear in the state where A is a matrix
    back = c.carried("out_of_frame", k, c.rhs(0.3, y, k, v))
    assert np.allclose(back, expected, rtol=0, atol=1e-11 * np.abs(expected).max())
    assert np.isclose(c.energy(0.3, y, k), given.energy(0.3, x, given.constants(p)), rtol=1e-11)


@pytest.mark.parametrize("name", ["SO(3)", "SE(3)", "SL(3)", "SAff(3)", "GL(3)"])
def test_the_frame_is_principal(name):
    """In the new parameters J is diagonal, c = 0 where there are translations: few numbers."""
    framed = principal(PROBLEMS[name]())
    body = framed.body
    assert all(x == 0 for i, row in enumerate(body.given.J) for j, x in enumerate(row) if i != j)
    if framed.affine:
        assert body.given.c == (0, 0, 0)


@pytest.mark.parametrize("name", ["SO(3)", "SL(3)", "SAff(3)", "SE(2)", "comet"])
def test_the_problem_in_the_frame_is_checked_like_any_other(name):
    record = walk(principal(PROBLEMS[name]()))
    assert all(v.holds for v in own_verdicts(record))


@pytest.mark.parametrize(
    ("name", "given", "framed"), [("p1", 91, 45), ("p2", 169, 102), ("p3", 196, 145)]
)
def test_what_the_frame_saves(name, given, framed):
    """An upper bound on the operations of rhs, as measured when this was written."""
    d = derive(f"benchmarks/problems/{name}.toml")
    from derive.code.options import Options

    for frame, most in (("given", given), ("principal", framed)):
        found = program(d.problem, d.record, Options(frame=frame))
        assert sum(found.functions["rhs"].operations().values()) <= most


def test_bodies_without_a_frame_are_refused_by_the_code(modules, tmp_path):
    """All mass on a line: no moment about it."""
    folder, given, framed = modules("so3", "plain")
    p, _, _ = drawn(given, "plain")
    r = np.array([0.3, -2.0, 0.7])
    at = {name: i for i, name in enumerate(given.PARAMETERS)}
    for i in range(3):
        for j in range(i, 3):
            p[at[f"J_{i + 1}{j + 1}"]] = r[i] * r[j]
    with pytest.raises(ValueError, match="singular"):
        framed.constants(p)
    if present("cc"):
        c = compile_c("cc", "principal", tmp_path, folder)
        assert (c.constants(p)[0], c.constants(np.full_like(p, np.nan))[0]) == (1, 2)


@pytest.mark.parametrize("bad", [np.nan, np.inf])
@pytest.mark.parametrize("name", ["SO(3)", "SL(3)", "GL(3)"])
def test_numbers_that_are_not_finite_are_refused(name, bad, modules, tmp_path):
    """Also where they only tell the frame: a stiffness, gravity."""
    folder, given, framed = modules(name, "plain")
    for which in ("k", "g"):
        p = drawn(given, "plain")[0]
        p[given.PARAMETERS.index(which)] = bad
        with pytest.raises(ValueError, match="not finite"):
            framed.constants(p)
        if present("cc"):
            assert compile_c("cc", "principal", tmp_path, folder).constants(p)[0] == 2


@pytest.mark.parametrize("gravity", [0.0, 1e-9, 1e200])
def test_gravity_of_any_size(gravity, tmp_path):
    p = problem_of(
        {
            "name": "top",
            "group": "SO(3)",
            "parameters": {"g": 1.0},
            "body": {"given": {"m": 1, "c": [0, 0, 1], "J": [[2, 0, 0], [0, 1, 0], [0, 0, 4]]}},
            "potential": [{"kind": "gravity", "g": ["g", "2*g", "-g"]}],
        }
    )
    d = derive(p)
    d.emit(tmp_path, ("python",), "given")
    d.emit(tmp_path, ("python",), "framed", frame="principal")
    given, framed = import_python("given", tmp_path), import_python("framed", tmp_path)
    _, x, *_ = state(given)
    k0, k = given.constants({"g": gravity}), framed.constants({"g": gravity})
    expected = framed.into_frame(given.rhs(0.0, x, k0), k)
    found = framed.rhs(0.0, framed.into_frame(x, k), k)
    assert np.allclose(found, expected, rtol=1e-11, atol=1e-12 * np.abs(expected).max())


def test_equal_moments_have_a_frame_as_well(derived, tmp_path):
    """A ball: every axis is principal, and rounding may choose any."""
    p = problem_of(
        {
            "name": "ball",
            "group": "SE(3)",
            "body": {"solid": "ball", "density": 2, "radius": 1},
            "potential": [{"kind": "gravity", "g": [1, 2, 3]}],
        }
    )
    d = derive(p)
    d.emit(tmp_path, ("python",), "given")
    d.emit(tmp_path, ("python",), "framed", frame="principal")
    given, framed = import_python("given", tmp_path), import_python("framed", tmp_path)
    q, x, *_ = state(given)
    k, k0 = framed.constants(q), given.constants(q)
    found = framed.rhs(0.0, framed.into_frame(x, k), k)
    assert np.allclose(found, framed.into_frame(given.rhs(0.0, x, k0), k), atol=1e-12)


def test_a_batch_of_bodies(modules):
    _, given, framed = modules("SE(3)", "plain")
    rows = [drawn(given, "plain", seed) for seed in range(1, 5)]
    p, x = (np.array([row[i] for row in rows]) for i in (0, 1))
    p[:, 0] *= np.arange(1, 5)
    k = framed.constants(p)
    for i in range(4):
        alone = framed.constants(p[i])
        one = framed.rhs(0.0, framed.into_frame(x[i], alone), alone)
        many = framed.rhs(0.0, framed.into_frame(x, k), k)[i]
        assert np.allclose(
            framed.out_of_frame(one, alone), framed.out_of_frame(many, k[i]), atol=1e-11
        )


def test_compiled_in_its_frame():
    f = compiled("sl3", frame="principal")
    g = compiled("sl3")
    x = np.concatenate([np.eye(3).ravel(), np.linspace(-1, 1, 8)])
    y = f.into_frame(x)
    assert np.allclose(f.out_of_frame(f(0.0, y)), g(0.0, x), atol=1e-11)
    with pytest.raises(ValueError, match="frame='principal'"):
        g.into_frame(x)


def test_what_does_not_go_with_a_frame(derived, tmp_path):
    d = derived("so3")
    with pytest.raises(LoweringError, match="not smooth"):
        d.emit(tmp_path, frame="principal", jacobian=("parameters",))
    for name in (name for name, x in LANGUAGES.items() if not x.framed):
        with pytest.raises(EmitError, match=f"not in {name}"):
            d.emit(tmp_path, (name,), frame="principal")
    with pytest.raises(ProblemError, match="no principal frame"):
        principal(derive("two_tops").problem)


def test_the_jacobian_in_the_frame(derived, tmp_path):
    """d(ζ̇)/dζ along complex steps; the rest of the linearisation is tested without a frame."""
    d = derived("SE(3)")
    d.emit(tmp_path, ("python",), "m", frame="principal", jacobian=("state", "inputs"))
    m = import_python("m", tmp_path)
    p, x, u = drawn(m, "plain")
    k = m.constants(p)
    n = len(m.BASIS)
    _, D = m.jacobian(0.3, x, k, u)
    for a in range(n):
        y = x.astype(complex)
        y[-n + a] += 1e-30j
        slope = m.rhs(0.3, y, k.astype(complex), u).imag[-n:] / 1e-30
        assert np.allclose(D[n:, n + a], slope, rtol=1e-11, atol=1e-11)


@needs("cc")
@pytest.mark.parametrize("form", ["source", "header"])
def test_floats_for_small_machines(form, derived, tmp_path):
    derived("SE(3)").emit(tmp_path, ("c",), "m", frame="principal", real="float", form=form)
    (tmp_path / "use.c").write_text('#include "m.h"\nint main(void) { return 0; }\n')
    flags = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-Wdouble-promotion"]
    flags += ["-Wno-unused-function"]
    sources = [str(x) for x in tmp_path.glob("*.c")]
    subprocess.run(
        [CC, *flags, "-Wshadow", *sources, "-o", str(tmp_path / "use"), "-lm"], check=True
    )
