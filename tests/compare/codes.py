"""Right-hand sides as people write them, and the faults of such code."""

import tomllib
from itertools import product
from pathlib import Path

from derive.command.cli import main

LISTED = tomllib.loads(Path(__file__).with_name("right_codes.toml").read_text(encoding="utf-8"))
"""What is right, and how it is called."""


def compared(capsys, folder, problem, code, table, *changes):
    """The exit code and what is printed of a code with some of its text changed."""
    for old, new in changes:
        assert old in code
        code = code.replace(old, new)
    file = folder / ("users.c" if "#include" in code else "users.py")
    for path, text in ((file, code), ("problem.toml", problem), ("as.toml", table)):
        (folder / path).write_text(text, encoding="utf-8")
    words = ["compare", str(folder / "problem.toml"), "--with", str(file)]
    return main([*words, "--as", str(folder / "as.toml")]), capsys.readouterr()


SATELLITE = """
name = "satellite"
group = "SE(3)"
parameters = { mu = 3.7 }
[body]
given = { m = 1.3, centre = [0, 0, 0], I_centre = [[0.3, 0, 0], [0, 0.4, 0], [0, 0, 0.6]] }
[[potential]]
kind = "far_centre"
strength = "mu"
"""

SATELLITE_CODE = """
import numpy as np

mu, m, I, N = 3.7, 1.3, np.diag([0.3, 0.4, 0.6]), 5


def f(x):
    A, T, w, v = x[:9].reshape(3, 3), A_T(x), x[12:15], x[15:]
    r = np.linalg.norm(T)
    n = A.T @ T / r
    J = np.trace(I) / 2 * np.eye(3) - I
    pull = -mu * m / r**2 * n
    pull += mu / r**4 * (3 * J @ n + 1.5 * np.trace(J) * n - 7.5 * (n @ J @ n) * n)
    moment = 3 * mu / r**(N - 2) * np.cross(n, I @ n)
    dw = np.linalg.solve(I, moment - np.cross(w, I @ w))
    dv = pull / m - np.cross(w, v)
    return np.concatenate([(A @ hat(w)).ravel(), A @ v, dw, dv])


def A_T(x):
    return x[9:12]


def hat(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
"""

VEHICLE = """
name = "vehicle"
group = "SE(3)"
[parameters]
a = { default = 1.7, unit = "kg" }
[inertia]
operator = [
  [1.1, 0, 0, 0, 0.2, 0], [0, 1.5, 0, -0.2, 0, 0], [0, 0, 2.1, 0, 0, 0],
  [0, -0.2, 0, "2 + a", 0, 0], [0.2, 0, 0, 0, 3.9, 0], [0, 0, 0, 0, 0, 4.3],
]
"""

VEHICLE_CODE = """
import numpy as np

M = np.array([[1.1, 0, 0, 0, 0.2, 0], [0, 1.5, 0, -0.2, 0, 0], [0, 0, 2.1, 0, 0, 0],
              [0, -0.2, 0, 3.7, 0, 0], [0.2, 0, 0, 0, 3.9, 0], [0, 0, 0, 0, 0, 4.3]])


def hat(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def mass(x):
    return M


def bias(x):
    w, v = x[12:15], x[15:]
    p = M @ x[12:]
    moment = np.cross(w, p[:3]) + np.cross(v, p[3:])
    return np.concatenate([moment, np.cross(w, p[3:])])
"""

HULL = """
name = "hull"
group = "SE(3)"
[inertia]
operator = [
  [0.6, 0, -0.1, 0, -0.6, 0], [0, 7, 0, 0.6, 0, -4.7], [-0.1, 0, 7.7, 0, 4.5, 0],
  [0, 0.6, 0, 32, 0, 0], [-0.6, 0, 4.5, 0, 55, 0], [0, -4.7, 0, 0, 0, 66],
]
[[input]]
name = "push"
kind = "force"
at = [-1, 0.5, 0.1]
frame = "body"
direction = [1, 0, 0]
[[force]]
at = [0.2, 0, 0.1]
frame = "body"
force = ["-12*v_1", "-90*v_2", "-110*v_3"]
"""

HULL_CODE = """
import numpy as np


def S(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


m, rg = 30, np.array([0.1, 0, 0.02])
I0 = np.array([[0.5, 0, -0.1], [0, 4, 0], [-0.1, 0, 4.5]])
M_RB = np.block([[m * np.eye(3), -m * S(rg)], [m * S(rg), I0]])
M_A = np.diag([2, 25, 36, 0.1, 3, 3.2])
M_A[1, 5] = M_A[5, 1] = 1.5
M_A[2, 4] = M_A[4, 2] = -1.7
D = np.diag([12, 90, 110])


def coriolis(M, nu):
    linear, angular = np.split(M @ nu, 2)
    return np.block([[np.zeros((3, 3)), -S(linear)], [-S(linear), -S(angular)]])


def f(x, u):
    R, nu = x[3:12].reshape(3, 3), x[12:]
    force = np.array([u[0], 0, 0])
    through = nu[:3] + np.cross(nu[3:], [0.2, 0, 0.1])
    drag = -D @ through
    moment = np.cross([-1, 0.5, 0.1], force) + np.cross([0.2, 0, 0.1], drag)
    tau = np.concatenate([force + drag, moment])
    C_RB, C_A = coriolis(M_RB, nu), coriolis(M_A, nu)
    dnu = np.linalg.solve(M_RB + M_A, tau - C_RB @ nu - C_A @ nu)
    return np.concatenate([R @ nu[:3], (R @ S(nu[3:])).ravel(), dnu])
"""
"""In the form of Fossen's book, velocities before angular ones."""

SLED = HULL.replace(
    '"-90*v_2", "-110*v_3"]',
    """"-90*v_2*abs(v_2)", "-110*v_3*abs(v_3)"]
moment = ["-2*zeta_1", "-3*zeta_2", "-4*zeta_3"]""",
)
SLED_CODE = HULL_CODE.replace("-D @ through", "-D @ through * [1, *np.abs(through[1:])]").replace(
    "0.1], drag)", "0.1], drag) - [2, 3, 4] * nu[3:]"
)
"""With drag by axes and a moment of its own."""

TOP = """
name = "heavy"
group = "SO(3)"
parameters = { m = 1.3 }
[body]
given = { m = "m", centre = [0.1, 0.05, 0.4], I_centre = [
  [0.3, 0.01, 0], [0.01, 0.4, 0], [0, 0, 0.5]] }
[[potential]]
kind = "gravity"
g = [0, 0, -9.81]
"""

TOP_CODE = """
#include <math.h>

void top(const double *x, double *dx)
{
    const double m = 1.3, c[3] = {0.1, 0.05, 0.4}, g = 9.81;
    double I[3][3] = {{0.3, 0.01, 0}, {0.01, 0.4, 0}, {0, 0, 0.5}};
    const double *A = x, *w = x + 9;
    double L[3], n[3], det, r[3], cc = c[0]*c[0] + c[1]*c[1] + c[2]*c[2];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            I[i][j] += STEINER * m * ((i == j) * cc - c[i]*c[j]);
    for (int i = 0; i < 3; ++i) {
        const double *R = A + 3*i;
        dx[3*i] = R[1]*w[2] - R[2]*w[1];
        dx[3*i + 1] = R[2]*w[0] - R[0]*w[2];
        dx[3*i + 2] = R[0]*w[1] - R[1]*w[0];
        L[i] = I[i][0]*w[0] + I[i][1]*w[1] + I[i][2]*w[2];
    }
    for (int i = 0; i < 3; ++i) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        n[i] = L[j]*w[k] - L[k]*w[j] - m*g*(c[j]*A[6 + k] - c[k]*A[6 + j]);
    }
    det = 0;
    for (int j = 0; j < 3; ++j)
        det += I[0][j]*(I[1][(j+1)%3]*I[2][(j+2)%3] - I[1][(j+2)%3]*I[2][(j+1)%3]);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            r[j] = I[(i+1)%3][(j+1)%3]*I[(i+2)%3][(j+2)%3]
                 - I[(i+1)%3][(j+2)%3]*I[(i+2)%3][(j+1)%3];
        dx[9 + i] = (r[0]*n[0] + r[1]*n[1] + r[2]*n[2])/det;
    }
}
"""

WHEEL = """
name = "wheel"
group = "SO(3)"
[parameters]
A = { default = 1.1, unit = "kg m^2" }
B = { default = 1.7, unit = "kg m^2" }
C = { default = 2.3, unit = "kg m^2" }
R = { default = 0.31, unit = "kg m^2" }
h = { default = 0.8, unit = "kg m^2/s" }
[lagrangian]
L = "(A*zeta_1^2 + B*zeta_2^2 + (C + R)*zeta_3^2)/2 + h*zeta_3"
"""

WHEEL_CODE = """
import numpy as np

R, H = 0.31, 0.8
I = np.diag([1.1, 1.7, 2.3 + R])


def f(t, q, dx):
    print("called")
    w, x, y, z = q[:4]
    o = q[4:]
    L = I @ o + [0, 0, H]
    dx[:4] = 0.5 * np.array([-x*o[0] - y*o[1] - z*o[2], w*o[0] + y*o[2] - z*o[1],
                             w*o[1] + z*o[0] - x*o[2], w*o[2] + x*o[1] - y*o[0]])
    dx[4:] = np.linalg.solve(I, np.cross(L, o))
"""

DRONE = """
name = "drone"
group = "SE(3)"
[parameters]
m = 1.3
g = 9.81
kappa = 0.17
arm = 0.23
[body]
given = { m = "m", centre = [0.02, -0.05, 0.11], I_centre = [
  [0.31, 0.012, -0.023], [0.012, 0.42, 0.017], [-0.023, 0.017, 0.55]] }
[[potential]]
kind = "gravity"
g = [0, 0, "-g"]
[[input]]
name = "thrust"
kind = "force"
at = ["arm", 0.04, -0.3]
frame = "body"
direction = [0, 0, 1]
[[input]]
name = "side"
kind = "force"
at = [0.1, -0.2, 0.15]
frame = "body"
direction = [0, 1, 0]
[[damping]]
coefficient = "kappa"
at = [0.07, 0.03, -0.13]
"""

DRONE_CODE = """
import numpy as np

m, g, kappa = 1.3, 9.81, 0.17
c = np.array([0.02, -0.05, 0.11])
I = np.array([[0.31, 0.012, -0.023], [0.012, 0.42, 0.017], [-0.023, 0.017, 0.55]])
ARM = {"thrust": np.array([0.23, 0.04, -0.3]), "side": np.array([0.1, -0.2, 0.15])}
DIRECTION = {"thrust": np.array([0, 0, 1.0]), "side": np.array([0, 1.0, 0])}
DAMPED = np.array([0.07, 0.03, -0.13])
GYRO = np.ones(3)


def hat(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def f(x, u):
    A, w, v = x[:9].reshape(3, 3), x[12:15], x[15:]
    force = m * A.T @ [0, 0, -g]
    moment = np.cross(c, force)
    for name, number in zip(ARM, u):
        push = number * DIRECTION[name]
        force, moment = force + push, moment + np.cross(ARM[name], push)
    drag = -kappa * (v + np.cross(w, DAMPED))
    force, moment = force + drag, moment + np.cross(DAMPED, drag)
    moment = moment - np.cross(c, force)
    dw = np.linalg.solve(I, moment - GYRO * np.cross(w, I @ w))
    dv = force / m - np.cross(w, v + np.cross(w, c)) - np.cross(dw, c)
    return np.concatenate([(A @ hat(w)).ravel(), A @ v, dw, dv])
"""

BRAKED = (
    DRONE.replace("[[damping]]", '[[damping]]\nkind = "quadratic"')
    + """
[[damping]]
kind = "rotational"
coefficient = 0.19
"""
)
BRAKED_CODE = DRONE_CODE.replace(
    "-kappa * (v + np.cross(w, DAMPED))",
    "v + np.cross(w, DAMPED)\n    drag = -kappa * np.linalg.norm(drag) * drag",
).replace("(DAMPED, drag)", "(DAMPED, drag) - 0.19 * w")

LANDER = """
name = "lander"
group = "SE(3)"
[parameters]
fuel = 6
b = 1.5
[[point]]
mass = "fuel"
at = [0, 0, -0.5]
[[point]]
mass = 2
at = [0.3, 0.1, 0]
[[point]]
mass = 2
at = [-0.3, 0, 0.2]
[[point]]
mass = 3
at = [0, 0, 2]
[[input]]
name = "throttle"
kind = "scalar"
[[flow]]
on = 1
mass = "fuel"
rate = "-b*throttle"
velocity = [1, 0, -25]
[[potential]]
kind = "gravity"
g = [0, 0, -1.62]
"""

LANDER_CODE = """
import numpy as np

AT = np.array([[0, 0, -0.5], [0.3, 0.1, 0], [-0.3, 0, 0.2], [0, 0, 2]])


def hat(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def f(x, u):
    A, w, v, fuel = x[:9].reshape(3, 3), x[12:15], x[15:18], x[18]
    points = np.array([fuel, 2, 2, 3])
    rate = -1.5 * u[0]
    forces = np.outer(points, A.T @ [0, 0, -1.62])
    forces[0] += rate * np.array([1, 0, -25])
    M, load = np.zeros((6, 6)), np.zeros(6)
    for m, r, force in zip(points, AT, forces):
        D = np.hstack([-hat(r), np.eye(3)])  # its velocity is D (w, v)
        M += m * D.T @ D
        load += D.T @ (force - m * np.cross(w, v))
    gyroscopic = np.concatenate([np.cross(w, M[:3, :3] @ w), np.cross(w, np.cross(w, points @ AT))])
    return np.concatenate(
        [(A @ hat(w)).ravel(), A @ v, np.linalg.solve(M, load - gyroscopic), [rate]]
    )
"""
"""Its fuel is a number of the state."""

DAMPED_AS_A_WHOLE = [
    [1, 0.2, 0.1, 0.3, -0.2, 0.1], [0.2, 1.2, 0.1, 0, 0.4, 0.1], [0.1, 0.1, 0.9, 0.2, 0, -0.3],
    [0.3, 0, 0.2, 2, 0.3, 0.4], [-0.2, 0.4, 0, 0.3, 3, -0.5], [0.1, 0.1, -0.3, 0.4, -0.5, 1.5],
]  # fmt: skip
SLOWED = f"""{LANDER}
[[force]]
covector = {[
    "-(" + " + ".join(
        f"({d})*{x}_{k}" for d, (x, k) in zip(row, product(("zeta", "w"), (1, 2, 3)), strict=True)
    ) + ")"
    for row in DAMPED_AS_A_WHOLE
]}
"""  # fmt: skip
SLOWED_CODE = LANDER_CODE.replace(
    "    gyroscopic =",
    f"""    D_hat, Z = np.array({DAMPED_AS_A_WHOLE}), np.zeros((3, 3))
    turn, nu = np.block([[A, Z], [Z, A]]), np.concatenate([w, v])
    half = np.block([[np.eye(3), Z], [Z, A]])
    load -= D_hat @ nu
    gyroscopic =""",
)
"""The lander with a damping by a tensor of all velocities, as in water."""

MOVED, TURNED = (
    [[2, 0.3, 0.4], [0.3, 3, -0.5], [0.4, -0.5, 1.5]],
    [[1, 0.2, 0.1], [0.2, 1.2, 0], [0.1, 0, 0.9]],
)
FINNED = f"""{LANDER}
[[force]]
at = [0.3, -0.2, 0.5]
frame = "body"
force = {[f"-({x})*v_1 - ({y})*v_2 - ({z})*v_3" for x, y, z in MOVED]}
moment = {[f"-({x})*zeta_1 - ({y})*zeta_2 - ({z})*zeta_3" for x, y, z in TURNED]}
"""
FINNED_CODE = LANDER_CODE.replace(
    "    gyroscopic =",
    f"""    at, moved, turned = np.array([0.3, -0.2, 0.5]), np.array({MOVED}), np.array({TURNED})
    drag = -moved @ (v + np.cross(w, at))
    load += np.concatenate([np.cross(at, drag) - turned @ w, drag])
    gyroscopic =""",
)
"""The lander with a drag at a place, and a moment of its own, each by a tensor."""
SPINNING = f"""{LANDER}
[[force]]
moment = {[f"-({x})*zeta_1 - ({y})*zeta_2 - ({z})*zeta_3" for x, y, z in TURNED]}
frame = "body"
"""
SPINNING_CODE = LANDER_CODE.replace(
    "    gyroscopic =", f"    load[:3] -= np.array({TURNED}) @ w\n    gyroscopic ="
)
"""The lander with a moment alone."""

SPRUNG = f"""{LANDER}
[[potential]]
kind = "spring"
at = [0.2, 0.1, 0.3]
anchor = [1, 2, 3]
stiffness = 2.5
length = 0.7
"""

SPRUNG_CODE = """
import numpy as np

AT = np.array([[0, 0, -0.5], [0.3, 0.1, 0], [-0.3, 0, 0.2], [0, 0, 2]])
HOOK, ANCHOR = np.array([0.2, 0.1, 0.3]), np.array([1, 2, 3])


def hat(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def f(x, u):
    A, T, w, v, fuel = x[:9].reshape(3, 3), x[9:12], x[12:15], x[15:18], x[18]
    masses = np.array([fuel, 2, 2, 3])
    m, rate = masses.sum(), -1.5 * u[0]
    r = masses @ AT / m
    inertia = sum(q * hat(p).T @ hat(p) for q, p in zip(masses, AT)) - m * hat(r).T @ hat(r)
    push = rate * np.array([1, 0, -25])
    d = ANCHOR - T - A @ HOOK
    pull = A.T @ d * 2.5 * (1 - 0.7 / np.linalg.norm(d))
    moment = np.cross(AT[0] - r, push) + np.cross(HOOK - r, pull)
    dw = np.linalg.solve(inertia, moment - np.cross(w, inertia @ w))
    dv = (push + pull) / m + A.T @ [0, 0, -1.62]
    dv -= np.cross(w, v) + np.cross(dw, r) + np.cross(w, np.cross(w, r))
    return np.concatenate([(A @ hat(w)).ravel(), A @ v, dw, dv, [rate]])
"""
"""The same on a spring, by Newton and Euler about the centre of mass, which moves with the fuel."""

BURNING = LANDER.partition("[[potential]]")[0].replace("fuel = 6\n", "")
BURNING = BURNING.replace('[[input]]\nname = "throttle"\nkind = "scalar"\n', "")
BURNING = BURNING.replace('mass = "fuel"\nrate = "-b*throttle"', 'rate = "-b"')
BURNING = BURNING.replace('mass = "fuel"', 'mass = "6 - b*t"')
BURNING += SPRUNG[SPRUNG.index("[[potential]]") :]
BURNING_CODE = (
    SPRUNG_CODE.replace("f(x, u)", "f(t, x)")
    .replace("x[15:18], x[18]", "x[15:18], 6 - 1.5 * t")
    .replace("-1.5 * u[0]", "-1.5")
    .replace(", [rate]]", "]")
)
"""The same, whose fuel burns by the time."""

CAR = """
name = "car"
group = "SE(2)"
[body]
given = { m = 3, centre = [0, 0], I = 2 }
[[force]]
at = [1, 0]
frame = "body"
force = [0, "-v_2/v_1"]
"""
"""Its force is no number where a term is told by states in which the body rests."""

CAR_CODE = """
def f(x):
    a, b, c, d, _, _, r, u, v = x
    F = -(v + r) / u
    moving = r * v, F / 3 - r * u
    return [b * r, -a * r, d * r, -c * r, a * u + b * v, c * u + d * v, F / 2, *moving]
"""

PLANE = """
name = "plane"
group = "SE(2)"
[parameters]
k = 0.7
[body]
given = { m = 3, centre = [0.2, 0.1], I_centre = 2 }
[[potential]]
kind = "gravity"
g = [1.3, -9.81]
[[force]]
name = "drag"
at = [0, 0]
relative_to = ["1.5*cos(t)", 0.4]
force = ["-k*sqrt(v_1^2 + v_2^2)*v_1", "-k*sqrt(v_1^2 + v_2^2)*v_2"]
moment = ["-0.3*zeta_1"]
"""

PLANE_CODE = """
import numpy as np

k, m, I, s = 0.7, 3, 2, np.array([0.2, 0.1])
WIND = 1


def f(t, x):
    A, w, v = x[[0, 1, 2, 3]].reshape(2, 2), x[6], x[7:]
    weight = m * A.T @ [1.3, -9.81]
    through = A @ v - WIND * np.array([1.5 * np.cos(t), 0.4])
    drag = A.T @ (-k * np.linalg.norm(through) * through)
    moment = s[1] * drag[0] - s[0] * drag[1] - 0.3 * w
    turn = np.array([[0, -1], [1, 0]])
    a = moment / I
    dv = (weight + drag) / m - w * turn @ (v + w * turn @ s) - a * turn @ s
    return np.concatenate([(w * A @ turn).ravel(), A @ v, [a], dv])
"""

ROCKET = """
name = "rocket"
group = "SE(3)"
[body]
given = { m = 2, centre = [0, 0, 0], I_centre = [[0.3, 0, 0], [0, 0.4, 0], [0, 0, 0.6]] }
[[potential]]
kind = "gravity"
g = [0, 0, -9.81]
[[input]]
name = "thrust"
kind = "force"
at = [0.1, 0, -0.5]
frame = "body"
direction = [0, 0, 1]
"""

ROCKET_CODE = """
#include <math.h>

void rocket(const double *x, const double *u, double *dx)
{
    const double I[3] = {0.3, 0.4, 0.6}, M[3] = {0, -0.1*u[0], 0};
    double a = x[3], b = x[4], c = x[5], d = x[6];
    const double *v = x + 7, *w = x + 10;
    double o[3] = {w[0], w[1], w[2]};
    double axis[3] = {2*(b*d + a*c), 2*(c*d - a*b), 1 - 2*(b*b + c*c)};
    dx[3] = (-b*o[0] - c*o[1] - d*o[2])/2;
    dx[4] = (a*o[0] + c*o[2] - d*o[1])/2;
    dx[5] = (a*o[1] - b*o[2] + d*o[0])/2;
    dx[6] = (a*o[2] + b*o[1] - c*o[0])/2;
    for (int i = 0; i < 3; ++i) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        dx[i] = v[i];
        dx[7 + i] = axis[i]*u[0]/2 - 9.81*(i == 2);
        dx[10 + i] = (M[i] - (I[k] - I[j])*w[j]*w[k])/I[i];
    }
}
"""
