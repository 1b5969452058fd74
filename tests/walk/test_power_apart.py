"""The powers of what acts, each by its name, and ∂ₜŨ written out, beside forces on points in NumPy:
what a flight gains is their integral, and a forged one is refused."""

import math
from dataclasses import replace
from functools import cache, reduce

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import derive
from derive.check.checker import Checker
from derive.language.tree import mul
from derive.problem.toml import problem_of
from tests.support.library import arrange, module_of
from tests.support.walks import own_verdicts

MASS, INERTIA, CENTRE = 1.3, np.diag([0.02, 0.03, 0.04]), np.array([0.01, -0.02, 0.03])
ROTOR, KAPPA, LOAD = np.array([0.2, 0.1, 0.05]), 0.3, np.array([0, 0.1, -0.2])
HULL, FLAP, HOOK = np.array([0.1, 0, 0.02]), np.array([-0.1, 0.05, 0]), np.array([0, 0, -0.1])
C, K, STIFF, G = 0.4, 0.15, 2.5, 9.81
DRONE = {
    "name": "drone",
    "group": "SE(3)",
    "parameters": {"c": C, "k": K, "s": STIFF, "P_thrust": G},
    "body": {
        "given": {"m": MASS, "centre": CENTRE.tolist(), "I_centre": INERTIA.tolist()},
    },
    "potential": [
        {"kind": "gravity", "g": ["sin(t)", 0, "-P_thrust*(1 + t/3)"]},
        {
            "kind": "spring",
            "at": HOOK.tolist(),
            "anchor": ["cos(t)", "t^2", 2],
            "stiffness": "s*(2 + sin(3*t))",
            "length": "1 + t/5",
        },
    ],
    "input": [
        {
            "name": "thrust",
            "kind": "force",
            "at": ROTOR.tolist(),
            "frame": "body",
            "direction": [0, 0, 1],
            "moment": [0, 0, KAPPA],
        },
        {"name": "line", "kind": "force", "at": LOAD.tolist(), "frame": "space"},
        {"name": "twist", "kind": "torque", "frame": "space"},
        {"name": "u", "kind": "covector"},
    ],
    "force": [
        {
            "name": "drag",
            "at": HULL.tolist(),
            "force": [f"-c*sqrt(v_1^2 + v_2^2 + v_3^2)*v_{i}" for i in (1, 2, 3)],
        },
    ],
    "damping": [{"coefficient": "k", "at": FLAP.tolist()}],
}
GIVEN = {
    "thrust": 14.0,
    **{f"line_{i}": x for i, x in enumerate((0.3, -0.2, 0.5), 1)},
    **{f"twist_{i}": x for i, x in enumerate((0.02, 0.01, -0.03), 1)},
    **{f"u_{i}": x for i, x in enumerate((0.01, -0.02, 0.03, 0.2, 0.1, -0.3), 1)},
}
NAMES = {
    "P__thrust": "thrust",  # P_thrust is a parameter
    **{f"P_{x}": x for x in ("line", "twist", "u", "drag", "damping")},
}


@cache
def derived():
    return derive.derive(problem_of(DRONE))


@cache
def power():
    return next(s for s in derived().record.steps if s.label == "drone.power")


def entries(name):
    return np.array([GIVEN[f"{name}_{i}"] for i in (1, 2, 3)])


def split(x):
    return x[:9].reshape(3, 3), x[9:12], x[12:15], x[15:18]


def powers(x):
    """Each as ⟨force, velocity of its point⟩ in space, ⟨torque, ω⟩, and the covector on Z."""
    A, _, zeta, w = split(x)

    def velocity(r):
        return A @ (np.cross(zeta, r) + w)

    v = velocity(HULL)
    covector = np.array([GIVEN[f"u_{i}"] for i in range(1, 7)])
    return {
        "thrust": GIVEN["thrust"] * (A[:, 2] @ velocity(ROTOR) + KAPPA * zeta[2]),
        "line": entries("line") @ velocity(LOAD),
        "twist": entries("twist") @ (A @ zeta),
        "u": covector @ np.concatenate([zeta, w]),
        "drag": -C * np.linalg.norm(v) ** 3,
        "damping": -K * velocity(FLAP) @ velocity(FLAP),
    }


def potential(t, x):
    A, T, *_ = split(x)
    fall = np.array([math.sin(t), 0, -G * (1 + t / 3)])
    apart = A @ HOOK + T - np.array([math.cos(t), t**2, 2])
    stretch = np.linalg.norm(apart) - (1 + t / 5)
    return STIFF * (2 + math.sin(3 * t)) / 2 * stretch**2 - MASS * fall @ (A @ CENTRE + T)


def rate_in_time(t, x, h=1e-5):
    """∂ₜŨ at a state, by differences of the energy in t alone."""
    ends = [potential(t + s * h, x) for s in (-2, -1, 1, 2)]
    return (ends[0] - 8 * ends[1] + 8 * ends[2] - ends[3]) / (12 * h)


@cache
def flight():
    """(t, states, energies, work) of a motion, followed by the emitted code; the work is that of
    the forces in NumPy and of the time."""
    module = module_of(problem_of(DRONE))
    k = module.constants(arrange(module, DRONE["parameters"]))
    u = np.array([GIVEN[name] for name in module.INPUTS], float)
    x = np.concatenate([np.eye(3).ravel(), [0.1, 0.2, 0.3, 0.4, -0.7, 1.1, 0.9, 0.4, -0.6]])
    times = np.linspace(0, 1, 6)

    def rates(t, y):
        work = sum(powers(y[:18]).values()) + rate_in_time(t, y[:18])
        return np.append(module.rhs(t, y[:18], k, u), work)

    told = solve_ivp(rates, (0, 1), np.append(x, 0), "DOP853", times, rtol=1e-10, atol=1e-10)
    states = told.y[:18].T
    energies = [module.energy(t, x, k) for t, x in zip(times, states, strict=True)]
    return times, states, np.array(energies), told.y[18]


def test_a_flight_gains_the_integral_of_all_powers():
    _, _, energies, work = flight()
    assert abs(work[-1]) > 1
    assert np.allclose(energies - energies[0], work, rtol=1e-7, atol=1e-7)


# -- what the record says, in numbers -------------------------------------------------------------


def names_at(t, x):
    """What the names of ∂ₜŨ mean, from the body."""
    A, T, *_ = split(x)
    return {
        **{"t": t, "A": A, "T": T, "c": MASS * CENTRE, "m": MASS},
        ("at", "d", 1): A @ HOOK + T - np.array([math.cos(t), t**2, 2]),
        **{("par", name): y for name, y in DRONE["parameters"].items()},
    }


def value(t, known):
    """A tree in floats."""
    if isinstance(t, (str, tuple)) and t in known:
        return known[t]
    if not isinstance(t, tuple):
        return float(t)
    if t[0] == "fun":
        return {"sin": math.sin, "cos": math.cos, "sqrt": math.sqrt}[t[1]](value(t[2], known))
    if t[0] == "pow":
        return value(t[1], known) ** t[2]
    parts = [value(x, known) for x in t[1:]]
    match t[0]:
        case "add":
            return sum(parts)
        case "mul":
            return reduce(np.dot, parts)
        case "div":
            return parts[0] / parts[1]
        case "inner":
            return parts[0] @ parts[1]
        case "wedge":
            return np.cross(*parts)
        case "T":
            return parts[0].T
        case "tr":
            return np.trace(parts[0])
        case "norm2":
            return parts[0] @ parts[0]
        case "row":
            return parts[0]
        case "matrix":
            return np.array(parts)
    raise ValueError(t)


def test_the_sum_of_all_is_the_rate_of_the_energy():
    whole = [e.rhs for e in power().equations if e.lhs == "ḣ"]
    assert len(whole) == 2
    assert {*whole[1][1:]} == {*(("par", x) for x in NAMES), "∂ₜŨ"}


def test_what_the_time_does_is_written_out():
    (tree,) = (e.rhs for e in power().equations if e.lhs == "∂ₜŨ")
    times, states, *_ = flight()
    for t, x in zip(times, states, strict=True):
        wanted = rate_in_time(t, x)
        assert math.isclose(value(tree, names_at(t, x)), wanted, rel_tol=1e-7), (t, wanted)


def test_a_stiffness_inside_the_body_is_told_apart_from_another():
    """Both springs of natural length 0 are in K, and one alone knows the time."""
    points = [{"mass": 1, "at": [int(i == k) for k in range(3)]} for i in range(4)]
    springs = [
        {"kind": "spring", "between": [1, 2], "stiffness": "1 + t^3", "length": 0},
        {"kind": "spring", "between": [2, 4], "stiffness": 3, "length": 0},
    ]
    data = {"name": "soft", "group": "SL(3)", "point": points, "potential": springs}
    record = derive.derive(problem_of(data)).record
    step = next(s for s in record.steps if s.label == "soft.power")
    A, apart = np.array([[1.0, 2, 0], [0, 1, 3], [1, 0, 1]]), np.array([1.0, -1, 0])
    known = {"t": 0.7, "A": A, ("at", "s", 1): apart[:, None]}
    wanted = 3 * 0.7**2 / 2 * (A @ apart) @ (A @ apart)
    assert math.isclose(value(step.equations[0].rhs, known), wanted, rel_tol=1e-12)
    assert all(x.holds for x in own_verdicts(record))


# -- the checker --------------------------------------------------------------------------------


def test_the_record_holds():
    record = derived().record
    checker = Checker(record.problem, 7)
    told = [s for s in record.steps if s.label in ("drone.input", "drone.power")]
    assert len(told) == 2
    assert all(checker.check(x).holds for x in told)
    assert checker.symbols(record).holds


@pytest.mark.parametrize("factor", [-1, 2])
@pytest.mark.parametrize("name", [*NAMES, "∂ₜŨ"])
def test_a_forged_power_is_refused(name, factor):
    equations = [
        replace(e, rhs=mul(factor, e.rhs)) if e.lhs in (name, ("par", name)) else e
        for e in power().equations
    ]
    assert tuple(equations) != power().equations
    forged = replace(power(), equations=tuple(equations))
    verdict = Checker(derived().record.problem, 7).check(forged)
    assert not verdict.holds
    assert f"‘{name}’" in verdict.reason or name in verdict.reason


def test_nothing_acts_by_a_name_that_nothing_has():
    step = power()
    last = replace(step.equations[-2], lhs=("par", "P_wind"), rhs=0)
    forged = replace(step, equations=(*step.equations, last))
    assert not Checker(derived().record.problem, 7).check(forged).holds


# -- read off by the code ------------------------------------------------------------------------


def read_by(data):
    """The outputs of a problem by its emitted code, with the parameters and inputs of arguments."""
    module = module_of(problem_of(data))

    def read(x, inputs):
        k = module.constants(arrange(module, data.get("parameters", {})))
        u = np.array([inputs[name] for name in module.INPUTS], float)
        return module.outputs(0.3, x, k, u)

    return read


def test_the_code_reads_each_power():
    told = [{"name": f"of_{x}", "kind": "power", "of": x} for x in NAMES.values()]
    read = read_by(DRONE | {"output": [*told, {"name": "whole", "kind": "power"}]})
    _, states, *_ = flight()
    for x in states:
        wanted = [powers(x)[name] for name in NAMES.values()]
        assert np.allclose(read(x, GIVEN), [*wanted, sum(wanted)], rtol=1e-8, atol=1e-12)


OUTPUT = {"name": "power", "kind": "power"}
SPEEDS = [f"zeta_{i}" for i in range(1, 7)]
PUSHED = {"name": "f", "kind": "force", "on": 2}
FEW = {
    "a torque in the plane": (
        {"group": "SO(2)", "point": [{"mass": 2, "at": [0, -1]}]},
        {"input": [{"name": "u", "kind": "torque"}], "output": [OUTPUT | {"of": "u"}]},
    ),
    "a force on a point of what stretches": (
        {
            "group": "SL(3)",
            "point": [{"mass": 1 + i, "at": [int(i == k) for k in range(3)]} for i in range(4)],
        },
        {"input": [PUSHED], "damping": [{"coefficient": 3, "on": 1}], "output": [OUTPUT]},
    ),
    "beside a Lagrangian": (
        {
            "group": "SE(3)",
            "lagrangian": {
                "L": "(" + "+".join(f"{i}*{x}^2" for i, x in enumerate(SPEEDS, 1)) + ")/2"
            },
        },
        {"input": [{"name": "f", "kind": "force", "at": [1, 2, 3]}], "output": [OUTPUT]},
    ),
}


def wanted_power(name, x):
    """Force by velocity, from the numbers of the state."""
    f = np.array([0.3, -0.2, 0.5])
    if name == "a torque in the plane":
        return 0.7 * x[4]
    if name == "beside a Lagrangian":
        A, _, zeta, w = split(x)
        return f @ A @ (np.cross(zeta, [1, 2, 3]) + w)
    A, zeta = x[:9].reshape(3, 3), x[9:]
    basis = module_of(problem_of(problem_named(name))).BASIS
    moved = A @ np.tensordot(zeta, np.array(basis, float), 1)
    return f @ moved[:, 1] - 3 * moved[:, 0] @ moved[:, 0]


def problem_named(name):
    body, acting = FEW[name]
    return {"name": "acted"} | body | acting


@pytest.mark.parametrize("name", [*FEW])
def test_it_is_read_where_other_things_act(name):
    read, rng = read_by(problem_named(name)), np.random.default_rng(4)
    size = len(module_of(problem_of(problem_named(name))).STATE)
    x, inputs = rng.normal(size=size), {"u": 0.7, "f_1": 0.3, "f_2": -0.2, "f_3": 0.5}
    assert math.isclose(read(x, inputs)[0], wanted_power(name, x), rel_tol=1e-12)
    assert all(v.holds for v in own_verdicts(derive.derive(problem_of(problem_named(name))).record))
