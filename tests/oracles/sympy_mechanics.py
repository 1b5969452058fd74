"""SymPy's mechanics on one solid: Kane's method.

The coordinates are a quaternion (and the origin's place), the speeds the body components of the
angular velocity (and of the origin's velocity).  The load ``u`` is a torque, and for a free solid
the force on the body's origin, in body components.  SymPy forms M and f of ``M x = f``; only
numbers go in here.
"""

from functools import cache

import numpy as np
import sympy as sp
from sympy.physics import mechanics as me

from tests.oracles import sampling

BODY = sp.symbols("m s:3 I11 I22 I33 I12 I23 I13 g:3")
LOAD = sp.symbols("u:6")


def numbers(body):
    """The values of ``BODY``: mass, centre of mass, inertia about it, gravity."""
    m, c, _ = sampling.moments(body)
    s = c / m
    central = sampling.inertia(body) - m * (s @ s * np.eye(3) - np.outer(s, s))
    entries = [central[i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))]
    return [m, *s, *entries, *body.gravity]


def _vector(frame, entries):
    return sum((e * d for e, d in zip(entries, frame, strict=True)), me.Vector(0))


def _solid(N, B, velocity):
    """The body's origin, its centre of mass, the solid, and what acts on it."""
    origin = me.Point("O")
    origin.set_vel(N, _vector(B, velocity))
    centre = origin.locatenew("G", _vector(B, BODY[1:4]))
    centre.v2pt_theory(origin, N, B)
    solid = me.RigidBody("body", centre, B, BODY[0], (me.inertia(B, *BODY[4:10]), centre))
    loads = [(centre, BODY[0] * _vector(N, BODY[10:])), (B, _vector(B, LOAD[:3]))]
    return origin, solid, loads


@cache
def _kane(free):
    """M and f of Kane's method, as functions of q, w (and v), BODY, LOAD."""
    e, T, w, v = (me.dynamicsymbols(x) for x in ("e:4", "T:3", "w:3", "v:3"))
    N, B = me.ReferenceFrame("N"), me.ReferenceFrame("B")
    B.orient_quaternion(N, e)
    B.set_ang_vel(N, _vector(B, w))
    origin, solid, loads = _solid(N, B, v if free else (0, 0, 0))
    vector, turning = sp.Matrix(e[1:]), sp.Matrix(w)
    whole = [-vector.dot(turning), *(e[0] * turning + vector.cross(turning))]
    rates = [a.diff() - b / 2 for a, b in zip(e, whole, strict=True)]
    q, speeds = list(e), list(w)
    if free:
        loads.append((origin, _vector(B, LOAD[3:])))
        rates += list(sp.Matrix(T).diff() - N.dcm(B) * sp.Matrix(v))
        q, speeds = q + T, speeds + v
    method = me.KanesMethod(N, q_ind=q, u_ind=speeds, kd_eqs=rates)
    method.kanes_equations([solid], loads)
    values = (method.mass_matrix, method.forcing)
    return sp.lambdify([[*e], [*speeds], BODY, LOAD], values, cse=True)


def kane(name, x, body, u):
    """dzeta/dt (and dw/dt) in the state ``x`` of so3 or se3."""
    d = sampling.DIMENSION[name]
    e, load = sampling.quaternion(x[:9].reshape(3, 3)), [*u, 0, 0, 0][:6]
    M, f = _kane(name == "se3")(e, x[-d:], numbers(body), load)
    return np.linalg.solve(M, f)[:, 0]
