"""Every form of the emitted code is the same equations: the rates of one form are those of another,
carried along by the map between their states, by a complex step; and derivatives of all kinds."""

import json
import tomllib
from functools import cache

import numpy as np
import pytest

from derive import compile as compiled
from derive import derive
from derive.problem.toml import problem_of
from tests.code.test_charts import FORMS as CHARTS
from tests.problems import MIXED, SKEWED
from tests.support.library import module_of
from tests.support.needs import needs
from tests.support.states import charted, drawn, element, element_names, hat, state

GROUPS = ("so3", "se3", "sl3", "saff3", "two_tops", "screw", "jelly", "heisenberg", "so4")
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

OF_SPACE = ("SO(3)", "SE(3)", "SL(3)", "SAff(3)", "GL(3)", "Aff(3)")
OWN = {"so(3) skewed": ("linear", SKEWED), "se(3) mixed": ("affine", MIXED)}


def own(name):
    """so(3) or se(3) in a basis of one's own."""
    action, basis = OWN[name]
    table = {"name": "Own", "action": action, "basis": json.loads(f"[{basis}]")}
    return pushed(table, FREE)


IN_FRAMES = {
    **{name: (lambda name=name: own(name)) for name in OWN},
    **{name: (lambda name=name: pushed(name, FREE)) for name in OF_SPACE},
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


SHIFTS = [[[0] * 3 + [int(k == i)] for k in range(4)] for i in range(3)]
TURN = [[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]]
PLANE = [[0, -1, 0], [1, 0, 0], [0, 0, 0]]
POINTS = [{"mass": 1.5, "at": [1, 0.5, 0, 1]}, {"mass": 0.5, "at": [0, 1, 2, 1]}]
SPRING = {
    "kind": "spring",
    "at": [1, 0.5, 0, 1],
    "anchor": [1, 0, 3, 1],
    "stiffness": 2,
    "length": 0.5,
}
MOVING = {
    "shifts": {"group": {"name": "R3", "basis": SHIFTS}, "point": POINTS, "potential": [SPRING]},
    "crane": {
        "group": {"name": "Crane", "basis": [TURN, SHIFTS[2]]},
        "point": POINTS,
        "potential": [SPRING],
    },
    "engel": {
        "group": "UT(4)",
        "lagrangian": {
            "L": "(" + " + ".join(f"zeta_{a}^2" for a in range(1, 7)) + ")/2 - A_13*A_24 - A_14^2"
        },
    },
    "pair": {
        "group": "SE(2) x UT(3)",
        "point": [{"mass": 1, "at": [1, 0], "block": 1}, {"mass": 2, "at": [0, 1], "block": 1}]
        + [{"mass": 1, "at": [0, 2 - k, k - 1], "block": 2} for k in (1, 2)]
        + [{"mass": 3, "at": [1, 1, 1], "block": 2}],
    },
    "turned": {
        "group": {
            "name": "T3",
            "action": "affine",
            "basis": [[[*row, 0] for row in PLANE] + [[0] * 4], *SHIFTS],
        },
        "point": [{"mass": 1, "at": [1, 0, 0]}, {"mass": 2, "at": [0, 1, 1]}],
        "potential": [{"kind": "gravity", "g": [0, 1, -9]}],
    },
    "screw": "screw",
    "heisenberg": "heisenberg",
}

TANGENT, COLUMNS = {"velocity": "tangent"}, {"layout": "col"}
QUATERNION, FRAMED = {"attitude": "quaternion"}, {"frame": "principal"}
VARYING = {"state": "moving"}
FORMS = {
    "columns": ({}, COLUMNS),
    "tangent": ({}, TANGENT),
    "quaternion": ({}, QUATERNION),
    "moving": ({}, VARYING),
    "moving_columns": (COLUMNS, VARYING),
    "moving_tangent": (TANGENT, VARYING),
    "principal": ({}, FRAMED),
    "principal_columns": (COLUMNS, FRAMED),
    "principal_tangent": (TANGENT, FRAMED),
    "principal_quaternion": (QUATERNION, FRAMED),
}
"""Options of one form, and what another has besides."""
TURNED = ("SO(3)", "SE(3)", "SAff(3)", "se(3) mixed")
CASES = [(form, name) for form in ("columns", "tangent") for name in GROUPS]
CASES += [("quaternion", name) for name in ("so3", "se3")]
CASES += [(form, name) for form in FORMS if form.startswith("moving") for name in MOVING]
CASES += [("principal", name) for name in IN_FRAMES]
CASES += [(f"principal_{x}", name) for x in ("columns", "tangent") for name in TURNED]
CASES += [("chart", name) for name in CHARTS]
CASES += [("principal_quaternion", name) for name in ("SO(3)", "SE(3)", "se(3) mixed", "top")]
H = 1e-30
"""A complex step, of functions that are made of real operations: exact."""


@cache
def given(name):
    """A problem by its name in one of the tables, or of a ready-made one."""
    if name in IN_FRAMES and not isinstance(IN_FRAMES[name], str):
        return IN_FRAMES[name]()
    own = MOVING.get(name, CHARTS.get(name, (name,))[0])
    return own if isinstance(own, str) else problem_of({"name": name, **own})


@cache
def module(name, **options):
    """The Python of a problem; with the jacobians that there are where these are compared."""
    plain = module_of(given(name))
    small = name in CHARTS and CHARTS[name][2] < 20
    if not (small or name in (*GROUPS, *MOVING)) or "frame" in options:
        return module_of(given(name), **options)
    there = {"inputs": plain.INPUTS, "parameters": plain.PARAMETERS} if not options else {}
    jacobian = ("state", "raw", *(x for x, names in there.items() if names))
    kept = name not in ("jelly", "pair", *CHARTS)
    return module_of(given(name), jacobian=jacobian, conserved=kept, **options)


def quaternion_matrix(q):
    """Rodrigues' parameters by the vector product: v + 2s(a×v) + 2a×(a×v)."""
    s, a = q[0], q[1:]
    return np.array(
        [v + 2 * s * np.cross(a, v) + 2 * np.cross(a, np.cross(a, v)) for v in np.eye(3)]
    ).T


def selected(ours, theirs, k):
    """The numbers of the same names."""
    order = [ours.STATE.index(x) for x in theirs.STATE]
    return lambda x: x[order]


def with_rates(ours, theirs, k):
    """A and dA/dt = AZ."""
    places = element_names(ours)
    count, rest = len(places), element(ours, np.random.default_rng(1))
    assert (*ours.STATE[:count], *(y + "_dot" for y in places)) == theirs.STATE

    def carried(x):
        g = rest.astype(x.dtype)
        for name, value in zip(ours.STATE[:count], x[:count], strict=True):
            g[places[name]] = value
        speed = g @ hat(ours, x[-len(ours.BASIS) :])
        return np.concatenate([x[:count], [speed[places[y]] for y in ours.STATE[:count]]])

    return carried


def into_frame(ours, theirs, k):
    """By the function that is emitted, whose inverse is emitted, too."""
    return lambda x: theirs.into_frame(x, k.astype(x.dtype))


MAPS = {"layout": selected, "state": selected, "velocity": with_rates, "frame": into_frame}
"""From a state of one form to that of another that has this option besides."""


def started(name, options, seed):
    """p, a state in a form, inputs, from a state with a matrix by rows and velocities."""
    plain = module(name)
    p, x, u, *_ = state(plain, seed)
    if options == QUATERNION:
        q = np.random.default_rng(seed).normal(size=4)
        return p, np.concatenate([q / np.linalg.norm(q), x[9:]]), u
    for option in options:
        k = plain.constants(p)
        x = MAPS[option](plain, module(name, **options), k)(x)
    return p, x, u


def along(carried, x, dx):
    """The derivative of a map along dx."""
    return carried(x + 1j * H * dx).imag / H


def near(found, expected, close=1e-11):
    """Equal to rounding, of their size."""
    scale = np.abs(expected).max(initial=1e-300)
    return np.allclose(found, expected, rtol=close, atol=close * scale)


SMALL = ("so3", "screw", "heisenberg", *CHARTS)
QUICK = {f"{x}: {y}": (x, y) for x, y in CASES if y in SMALL}
OTHERS = {f"{x}: {y}": (x, y) for x, y in CASES if y not in SMALL}


@pytest.mark.parametrize("case", QUICK)
def test_a_form_of_a_small_problem_moves_as_another(case):
    moves_as_another(*QUICK[case])


@pytest.mark.parametrize("case", OTHERS)
def test_a_form_moves_as_another(case):
    moves_as_another(*OTHERS[case])


def moves_as_another(form, name):
    """Rates are carried along, the energy is the same; the raw jacobian is the derivative by the
    numbers of the state, off the group as well, that along the group is the same in each."""
    options, more = FORMS.get(form) or ({}, {"attitude": CHARTS[name][1]})
    ours, theirs = module(name, **options), module(name, **options, **more)
    for seed in (1, 2):
        if form == "chart":
            (p, _, u, _), y = drawn(ours, seed), charted(theirs, seed)
            x = theirs.to_matrix(y)
        else:
            p, x, u = started(name, options, seed)
        k0, k = ours.constants(p), theirs.constants(p)
        if more == QUATERNION and form != "chart":
            y = started(name, more, seed)[1]
            x[:9] = quaternion_matrix(y[:4]).ravel()
            assert np.allclose(theirs.to_matrix(y), x, rtol=0, atol=1e-14)
        elif form != "chart":
            y = MAPS[next(iter(more))](ours, theirs, k)(x)
        v = theirs.inputs_into_frame(u, k) if more == FRAMED and len(u) else u
        dx, dy = ours.rhs(0.3, x, k0, u), theirs.rhs(0.3, y, k, v)
        if "attitude" in more:  # the matrix is a polynomial in q
            assert near(along(theirs.to_matrix, y, dy), dx, 1e-12)
            assert form == "chart" or abs(y[:4] @ dy[:4]) < 1e-13
        else:
            assert near(dy, along(MAPS[next(iter(more))](ours, theirs, k), x, dx))
        assert np.isclose(theirs.energy(0.3, y, k), ours.energy(0.3, x, k0), rtol=1e-11, atol=1e-11)
        if more == FRAMED:
            assert np.allclose(theirs.out_of_frame(y, k), x, rtol=0, atol=1e-11)
            if len(u):
                assert np.allclose(theirs.inputs_out_of_frame(v, k), u, rtol=0, atol=1e-11)
        if not hasattr(theirs, "jacobian_raw"):
            continue
        moved, (rates, D) = y, theirs.jacobian(0.3, y, k, u)
        assert near(rates, dy, 1e-13)
        assert near(D, ours.jacobian(0.3, x, k0, u)[1], 1e-10)
        y = np.random.default_rng(5).normal(size=len(y))
        slopes = [along(lambda y: theirs.rhs(0.3, y, k, u), y, e) for e in np.eye(len(y))]  # noqa: B023
        assert near(theirs.jacobian_raw(0.3, y, k, u), np.transpose(slopes), 1e-9)
        if "CONSERVED" in vars(ours):
            assert theirs.CONSERVED == ours.CONSERVED
            assert near(theirs.conserved(0.3, moved, k), ours.conserved(0.3, x, k0))


@pytest.mark.parametrize("name", GROUPS)
def test_the_jacobian_is_the_derivative(name):
    """Against complex steps of rhs along the group; the matrix of ad_Z by the brackets; by inputs,
    and by parameters against differences."""
    m = module(name)
    p, x, u, g, zeta = state(m)
    d, k, places = len(zeta), m.constants(p), element_names(m)
    _, D = m.jacobian(0.3, x, k, u)
    assert D.shape == (2 * d, 2 * d)
    Z = hat(m, zeta)

    def slope(change):
        return along(lambda x: m.rhs(0.3, x, k, u), x, change)[-d:]

    for a, e in enumerate(m.BASIS):
        assert np.allclose(hat(m, D[:d, a]), -(Z @ e - e @ Z), atol=1e-13)
        moved = [(g @ e)[places[z]] for z in m.STATE[:-d]]
        assert near(D[d:, a], slope(np.concatenate([moved, np.zeros(d)])), 1e-9)
        assert near(D[d:, d + a], slope(np.eye(len(x))[len(places) + a]), 1e-9)
    assert np.array_equal(D[:d, d:], np.eye(d))
    if m.INPUTS:
        found = m.jacobian_inputs(0.3, x, k, u)
        slopes = [along(lambda u: m.rhs(0.3, x, k, u), u, e)[-d:] for e in np.eye(len(u))]
        assert near(found[d:], np.transpose(slopes), 1e-9)
        assert not found[:d].any()
    if m.PARAMETERS:
        found = m.jacobian_parameters(0.3, x, p, u)[d:]
        for i, e in enumerate(np.eye(len(p))):
            step = 1e-6 * max(abs(p[i]), 1)
            ends = [m.rhs(0.3, x, m.constants(p + s * step * e), u)[-d:] for s in (1, -1)]
            difference = (ends[0] - ends[1]) / (2 * step)
            assert np.allclose(found[:, i], difference, rtol=1e-5, atol=1e-5 * np.abs(found).max())


DRAG = """
name = "test"
group = "SE(3)"
point = [
  { mass = 1, at = [1, 0, 0] }, { mass = 2, at = [0, 1, 0] },
  { mass = 1, at = [0, 0, 1] }, { mass = 3, at = [1, -1, 2] },
]
damping = [{ kind = "quadratic", coefficient = 0.4 }]
[[force]]
at = [1, 2, 3]
force = ["-hypot(v_1, v_2, v_3)*v_1", "-2*hypot(v_1, v_2, v_3)*v_2", "-abs(v_3)*v_3"]
"""


def test_at_rest_a_quadratic_drag_has_the_derivative_zero():
    """||v|| has none there, and ||v||v has; beside rest the derivative is as it was."""
    m = module_of(problem_of(tomllib.loads(DRAG)), jacobian=("state",))
    x, k = np.zeros(len(m.STATE)), m.constants(m.DEFAULTS)
    x[[0, 4, 8]] = 1
    _, D = m.jacobian(0.0, x, k)
    assert np.array_equal(D[6:], np.zeros((6, 12)))
    x[12:] = 1e-9 * np.arange(1, 7)
    _, D = m.jacobian(0.0, x, k)
    ends = [[m.rhs(0.0, x + h * e, k)[-6:] for h in (1e-14, -1e-14)] for e in np.eye(18)[12:]]
    slopes = [(a - b) / 2e-14 for a, b in ends]  # not a complex step: |v| is not analytic
    assert near(D[6:, 6:], np.transpose(slopes), 1e-8)


SIZED = DRAG.replace("hypot(v_1, v_2, v_3)", "abs(2*v_2)").replace("damping", "# damping")


@needs("the module jax")
def test_jax_differentiates_a_drag_at_rest():
    import jax

    jax.config.update("jax_enable_x64", True)
    m = module_of(problem_of(tomllib.loads(SIZED)))
    x, k = np.zeros(len(m.STATE)), m.constants(m.DEFAULTS)
    x[[0, 4, 8]] = 1
    D = jax.jacfwd(lambda x: m.rhs(0.0, x, k))(jax.numpy.array(x))
    assert np.array_equal(D[12:, 12:], np.zeros((6, 6)))


@pytest.mark.parametrize("name", MOVING)
def test_what_never_varies_is_left_out(name):
    """And nothing else is."""
    whole, moving = module(name), module(name, **VARYING)
    drawn = np.array([state(whole, seed)[1] for seed in range(4)])
    at = [whole.STATE.index(x) for x in moving.STATE]
    still = [k for k in range(len(whole.STATE)) if k not in at]
    assert at == sorted(at)
    assert np.ptp(drawn[:, still], axis=0).max(initial=0) < 1e-12
    assert np.ptp(drawn[:, at], axis=0).min() > 1e-6


def test_states_are_in_a_frame_of_their_own():
    """Else the laws above could hold for a frame that is not changed."""
    for name in ("SO(3)", "SE(3)", "SL(3)"):
        framed = module(name, **FRAMED)
        p, x, _ = started(name, {}, 1)
        assert np.abs(framed.into_frame(x, framed.constants(p)) - x).max() > 0.1


def test_compiled_in_its_frame():
    f, g = compiled("sl3", frame="principal"), compiled("sl3")
    x = np.concatenate([np.eye(3).ravel(), np.linspace(-1, 1, 8)])
    y = f.into_frame(x)
    assert np.allclose(f.out_of_frame(f(0.0, y)), g(0.0, x), atol=1e-11)
    with pytest.raises(ValueError, match="frame='principal'"):
        g.into_frame(x)
