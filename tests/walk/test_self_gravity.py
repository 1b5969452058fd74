"""Self-gravity of an ellipsoid beside plain sums, and beside the known figures of equilibrium."""

import math
import subprocess
from collections import Counter

import mpmath
import numpy as np
import pytest
from scipy.integrate import solve_ivp

import derive
from derive import Problem, Solid, programs, searches
from derive.code.emit import emit
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from derive.search.symmetries.scalar_lagrangian import Integrand
from derive.validate.chart import Chart
from derive.validate.emission import EmittedFiles
from tests.oracles import ellipsoids, sampling
from tests.support.gauss import agrees
from tests.support.library import arrange, emission, library, module_of
from tests.support.needs import CC, need, present
from tests.support.walks import SEED, problem, record
from tests.walk.test_dirichlet import about_z, state

NAME, RAW = "riemann_ellipsoid", {"jacobian": ("raw",)}
BALL = {"rho": 1.0, "a": 1.0, "b": 1.0, "c": 1.0, "G": 1.0}
RATIOS = [
    *((1, 1, 1), (1, 1, 1 + 1e-9), (1, 1 - 1e-7, 1 + 1e-8), (1, 0.9, 0.8), (3, 2, 1)),
    *((1, 1, 1e-4), (1, 1e-4, 1e-4), (1, 1e-2, 1e-4), (1e3, 1, 0.1), (1, 1e-6, 1e-6)),
]


def invariants(axes):
    x, y, z = (mpmath.mpf(a) ** 2 for a in axes)
    return [float(t) for t in (x + y + z, x * y + y * z + z * x, x * y * z)]


def integrals(I1, I2, I3):
    """The nine integrals to 30 digits, by the trapezoidal rule in log u, of analytic functions."""
    with mpmath.workdps(40):
        I1, I2, I3 = map(mpmath.mpf, (I1, I2, I3))
        h, total = mpmath.mpf(1) / 8, [mpmath.mpf(0)] * 9
        for k in range(-1400, 1800):
            u = mpmath.exp(k * h)
            P = ((u + I1) * u + I2) * u + I3
            whole = u / mpmath.sqrt(P)
            parts = [whole, *(whole * u**j / P for j in range(3))]
            parts += (whole * u**j / P**2 for j in range(5))
            total = [x + h * y for x, y in zip(total, parts, strict=True)]
        return total


def test_the_integrals_to_rounding(tmp_path):
    """Also where axes are equal, and where they are in ratios of 10^4 and more; those of the second
    derivatives are the last five."""
    need("cc")
    for name, text in emission(NAME, ("c",), **RAW)[1].items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    source = tmp_path / "integrals.c"
    source.write_text(
        f'#include "{NAME}.c"\n#include <stdio.h>\nint main(void)\n{{\n    double a, b, c;\n'
        '    while (scanf("%lf %lf %lf", &a, &b, &c) == 3) {\n'
        f"        const {NAME}_integrals r = {NAME}_ellipsoid(a, b, c),\n"
        f"                               s = {NAME}_ellipsoid_slopes(a, b, c);\n"
        "        for (int i = 0; i < 9; ++i) {\n"
        '            printf("%.17g ", i < 4 ? r.v[i] : s.v[i - 4]);\n        }\n'
        '        printf("\\n");\n    }\n    return 0;\n}\n'
    )
    program = tmp_path / "integrals"
    subprocess.run([CC, "-O2", "-o", program, source, "-lm"], check=True)
    given = [invariants(x) for x in RATIOS]
    text = "\n".join(" ".join(map(repr, x)) for x in given)
    out = subprocess.run([program], input=text, capture_output=True, text=True, check=True).stdout
    for x, line in zip(given, out.splitlines(), strict=True):
        wanted = integrals(*x)
        m = module_of(NAME, **RAW)
        python = (*m._ellipsoid(math, *x), *m._ellipsoid_slopes(math, *x))
        for found in (map(float, line.split()), python):
            for k, (a, b) in enumerate(zip(found, wanted, strict=True)):
                assert abs(a - b) < (5e-15 if k < 4 else 1e-14) * b


def test_in_floats_as_well(tmp_path):
    need("cc")
    derive.derive(NAME).emit(tmp_path, ("c",), real="float", form="header")
    source = tmp_path / "m.c"
    x = invariants((3, 2, 1))
    source.write_text(
        f'#include "{NAME}.h"\n#include <stdio.h>\nint main(void)\n{{\n'
        f"    const {NAME}_integrals r = {NAME}_ellipsoid({x[0]!r}f, {x[1]!r}f, {x[2]!r}f);\n"
        '    for (int i = 0; i < 4; ++i) {\n        printf("%.9g\\n", (double)r.v[i]);\n    }\n'
        "    return 0;\n}\n"
    )
    program = tmp_path / "m"
    strict = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-Wno-unused-function"]
    subprocess.run([CC, *strict, "-Wdouble-promotion", "-o", program, source, "-lm"], check=True)
    out = subprocess.run([program], capture_output=True, text=True, check=True).stdout
    for a, b in zip(map(float, out.split()), integrals(*x)[:4], strict=True):
        assert abs(a - b) < 2e-6 * b


@pytest.mark.parametrize("axes", [(1, 1, 1), (1.3, 1.3, 0.7), (1.5, 1.1, 0.6)])
def test_the_energy_is_that_of_newtons_law(axes):
    by_rays = ellipsoids.energy_by_rays(axes, 2.0, 3.0)
    assert abs(ellipsoids.energy(np.diag(np.square(axes)), 2.0, 3.0) / by_rays - 1) < 1e-12
    m = module_of(NAME, **RAW)
    density = 2.0 / (4 / 3 * math.pi * np.prod(axes))
    p = arrange(m, dict(zip("abc", axes, strict=True)) | {"rho": density, "G": 3.0})
    x = np.concatenate([np.eye(3).ravel(), np.zeros(8)])
    assert abs(m.energy(0.0, x, m.constants(p)) / by_rays - 1) < 1e-12


@pytest.mark.parametrize("group", ["SL(3)", "GL(3)", "SAff(3)", "Aff(3)", "Sim(3)"])
def test_motion_is_that_of_points_under_gauss_principle(group):
    """A turned ellipsoid with three unequal axes, by six points of the same moments."""
    turned = {"axis": [1, 2, 2], "angle": "pi/3"}
    solid = {
        "kind": "ellipsoid",
        "density": "rho",
        "rotation": turned,
        "semi_axes": ["a", 1.2, 0.7],
    }
    data = {"name": "free", "group": group, "parameters": {"rho": 0.9, "a": 1.6, "G": 2.0}}
    data |= {"potential": [{"kind": "self_gravity", "G": "G"}]}
    axes, mass = np.array([1.6, 1.2, 0.7]), 0.9 * 4 / 3 * math.pi * 1.6 * 1.2 * 0.7
    ends = math.sqrt(3 / 5) * sampling.turn([1, 2, 2], math.pi / 3) * axes
    points = [{"mass": mass / 6, "at": at} for at in (*ends.T.tolist(), *(-ends.T).tolist())]
    problem = problem_of(data | {"solid": [solid]})
    c = library("c", problem) if present("cc") else None
    agrees(module_of(problem), c, data | {"point": points}, {})


# -- figures of equilibrium ----------------------------------------------------------------------


def hat(x):
    return np.array([[0, -x[2], x[1]], [x[2], 0, -x[0]], [-x[1], x[0], 0]])


def follows(axes, square, moved):
    """The emitted motion beside ``moved(t)`` = A, where A = D at t = 0, over two turns."""
    need("cc")
    m, c = module_of(NAME, **RAW), library("c", NAME, **RAW)
    D = np.diag(axes / np.cbrt(np.prod(axes)))
    rate = math.sqrt(square * math.pi)
    status, k = c.constants(arrange(m, BALL))
    assert status == 0
    A, Z = moved(D, rate, 0.0)
    end = 4 * math.pi / rate
    at = np.linspace(0, end, 9)
    found = solve_ivp(
        lambda t, x: c.rhs(t, x, k),
        (0, end), state(m, A, Z), method="DOP853", rtol=1e-13, atol=1e-14, t_eval=at,
    )  # fmt: skip
    for t, x in zip(at, found.y.T, strict=True):
        wanted = state(m, *moved(D, rate, t))
        assert np.max(np.abs(x - wanted)) < 1e-9


def rigid(D, rate, t):
    """Turning as a whole: A = R(Ωt) D."""
    spin = rate * hat([0, 0, 1])
    return about_z(rate * t) @ D, np.linalg.inv(D) @ spin @ D


def circulating(D, rate, t):
    """Dedekind's: at rest in space, with the liquid inside turning: A = D R(Ωt)."""
    return D @ about_z(rate * t), rate * hat([0, 0, 1])


@pytest.mark.parametrize("e", [0.2, 0.6, 0.8])
def test_maclaurins_spheroids(e):
    axes = np.array([1, 1, math.sqrt(1 - e**2)])
    follows(axes, ellipsoids.maclaurin(e), rigid)


@pytest.mark.parametrize("moved", [rigid, circulating])
def test_jacobis_ellipsoid_and_dedekinds(moved):
    follows(*ellipsoids.jacobi(0.7), moved)


@pytest.mark.parametrize("axes", [(1.5, 1.1, 0.6), (1, 1, 1), (1.3, 1.3, 0.7), (1, 1, 1e-3)])
def test_the_jacobian_is_that_of_complex_steps(axes):
    """Where axes are equal, too: what is emitted is analytic.  (C says the same as Python.)"""
    m, step = module_of(NAME, **RAW), 1e-30
    k = m.constants(arrange(m, BALL | dict(zip("abc", axes, strict=True)) | {"G": 2.0}))
    Z = np.random.default_rng(8).normal(size=8)
    for A in (np.eye(3), np.array([[1.2, 0.3, 0], [0.1, 1, 0.4], [0, -0.2, 0.9]])):
        x = np.concatenate([(A / np.cbrt(np.linalg.det(A))).ravel(), Z])
        columns = [np.imag(m.rhs(0.0, x + 1j * step * e, k)) / step for e in np.eye(len(x))]
        wanted = np.transpose(columns)
        found = m.jacobian_raw(0.0, x, k)
        assert np.max(np.abs(found - wanted)) < 1e-12 * np.max(np.abs(wanted))


def rate_of_Z(axes, A, Z):
    """Ż of Euler's equation at each point of an ellipsoid of density 1, G = 1, in mpmath's numbers:
    the pull of its gravity by Carlson's R_D, the pressure by the trace."""
    shape = A * mpmath.diag([mpmath.mpf(a) ** 2 for a in axes]) * A.T
    found, R = mpmath.eigsy(shape)
    s = [*found]
    pulls = [mpmath.elliprd(s[i - 2], s[i - 1], s[i]) for i in range(3)]
    pull = R * mpmath.diag(pulls) * R.T * (4 * mpmath.pi / 3 * mpmath.sqrt(s[0] * s[1] * s[2]))
    quadric, trace = shape**-1, lambda x: sum(x[i, i] for i in range(3))
    pressure = (trace(Z * Z) + trace(pull)) / trace(quadric)
    return A**-1 * (pressure * quadric - pull) * A - Z * Z


@pytest.mark.parametrize("axes", [(1.5, 1.1, 0.6), (1, 1, 1), (1, 1, 1e-2)])
def test_the_jacobian_along_the_group_to_many_digits(axes):
    """By differences of 50 digits, which share nothing with the emitted code."""
    m, rng, moved = module_of(NAME, **RAW), np.random.default_rng(8), mpmath.mpf(10) ** -18
    A = np.eye(3) + (0 if axes[0] == axes[2] else 0.2) * rng.normal(size=(3, 3))
    A /= np.cbrt(np.linalg.det(A))
    basis = np.array(m.BASIS, float)
    zeta, *along = rng.normal(size=(7, 8))
    D = m.jacobian_raw(
        0.0,
        np.concatenate([A.ravel(), zeta]),
        m.constants(arrange(m, BALL | dict(zip("abc", axes, strict=True)))),
    )
    with mpmath.workdps(50):
        at, Z, *fields = (
            mpmath.matrix(x.tolist()) for x in (A, *np.tensordot([zeta, *along], basis, 1))
        )
        for eta, speed in zip(fields[::2], fields[1::2], strict=True):
            ends = [
                rate_of_Z(axes, at * (mpmath.eye(3) + h * eta), Z + h * speed)
                for h in (moved, -moved)
            ]
            wanted = np.array(((ends[0] - ends[1]) / (2 * moved)).tolist(), float)
            change = [*(at * eta), *(speed[i // 3, i % 3] for i in range(8))]
            found = np.tensordot((D @ np.array(change, float))[9:], basis, 1)
            assert np.max(np.abs(found - wanted)) < 1e-12 * np.max(np.abs(wanted))


# -- the record and what is refused --------------------------------------------------------------


def test_the_angular_momentum_is_said_to_be_kept():
    step = record(NAME)[f"{NAME}.conserved"]
    assert {"ḣ", "ℓ̇"} <= {e.lhs for e in step.equations}


def test_what_is_not_sought():
    """An integral of the reduced motion of an integrand is none of that of the integral."""
    d = derive.derive(NAME)
    for seek in (searches.reduction, lambda p, _: searches.integrals(p, 2)):
        with pytest.raises(ProblemError, match="nothing else is sought"):
            seek(d.problem, d.record)
    with pytest.raises(ProblemError, match="derive emit --conserved"):
        d.symmetries().values(0.0, np.ones(17))
    with pytest.raises(ProblemError, match="derive emit --conserved"):
        d.symmetries()[0].sympy()


@pytest.mark.parametrize(
    ("group", "axes", "kinds"),
    [
        ("GL(3)", ["a", 1.2, 0.7], {"deformation_body": 3}),
        ("SAff(3)", ["a", 1.2, 0.7], {"deformation_body": 3, "translation_space": 3, "boost": 3}),
        ("SL(3)", ["a", "a", 0.7], {"rotation_body": 1, "deformation_body": 2}),
        ("SL(3)", ["a", "a", "a"], {"rotation_body": 3}),
    ],
)
def test_the_circulation_is_found(group, axes, kinds):
    """By the relabellings of the body; U is the same after them and after rotations of space, at
    random A, by another integral."""
    body = Solid("ellipsoid", 1, semi_axes=axes)
    gravity = derive.SelfGravity("node")
    problem = Problem("free", group, body, gravity, parameters={"node": 2.0, "a": 1.6})
    found = derive.derive(problem).symmetries()
    assert Counter(x.kind for x in found) == Counter({"time": 1, "rotation_space": 3} | kinds)
    assert {"node_", "weight_"} <= {*found.problem.parameters}
    assert all(v.holds for v in found.check(SEED))


def test_what_depends_on_the_place_of_the_integrand_is_refused():
    own = Integrand.with_free_names({"G"})
    with pytest.raises(ProblemError, match="not the same at all places"):
        own.require_unused([0, ("mul", 2, ("par", "node"))])


ITEMS = {"c": "integrals.v[2]", "py": "integrals[2]"}
CALLS = {"c": f"{NAME}_ellipsoid(I_1, I_2, I_3)", "py": "_ellipsoid(xp, I_1, I_2, I_3)"}
CHANGES = {  # Ψ_0 is no case: on SL(3) the multiplier takes it up
    "nothing": lambda end: ("", ""),
    "another integral": lambda end: (ITEMS[end], ITEMS[end].replace("2", "3")),
    "other arguments": lambda end: (CALLS[end], CALLS[end].replace("I_1, I_2", "I_2, I_1")),
    "another loop": lambda end: ("ratio - 3", "ratio - 4"),
}


@pytest.mark.parametrize("change", CHANGES)
@pytest.mark.parametrize("end", ITEMS)
def test_emitted_code_is_read_back_and_no_change_of_it_passes(end, change):
    compiled = programs.program(problem(NAME), record(NAME))
    files = emit(compiled, record(NAME), ("c", "python"), NAME)
    file, (old, new) = f"{NAME}.{end}", CHANGES[change](end)
    assert old in files[file]
    changed = files | {file: files[file].replace(old, new, 1)}
    given = EmittedFiles(changed, NAME, Chart(), compiled.numbers(), fresh=files)
    report = next(x for x in given.reports(record(NAME)) if file in x.files)
    assert report.holds == (change == "nothing")
    if change == "nothing":
        assert "not validated, for it is a loop: Carlson's duplication" in report.text
