"""Right-hand sides by Pinocchio: bodies on its joints, and what acts on them as joint forces."""

import numpy as np
import pinocchio as pin

ORIGIN = pin.SE3.Identity()


def hung(joints, gravity, *inertias):
    """A model of bodies that hang on joints of the world, and its data."""
    made = pin.Model()
    for i, (joint, inertia) in enumerate(zip(joints, inertias, strict=True)):
        index = made.addJoint(0, joint, ORIGIN, f"joint_{i}")
        made.appendBodyToJoint(index, inertia, ORIGIN)
    made.gravity.linear = np.array(gravity, float)
    return made, made.createData()


def of_points(*points):
    """The inertia of points: (mass, place), …"""
    m = sum(x for x, _ in points)
    c = sum(x * np.array(r, float) for x, r in points) / m
    central = np.zeros((3, 3))
    for x, r in points:
        s = np.array(r) - c
        central += x * (s @ s * np.eye(3) - np.outer(s, s))
    return pin.Inertia(m, c, central)


# a drone: x is place, quaternion (x, y, z, w), velocity and angular velocity in the body
C = np.array([0.02, -0.05, 0.11])
TENSOR = np.array([[0.31, 0.012, -0.023], [0.012, 0.42, 0.017], [-0.023, 0.017, 0.55]])
DRONE = hung([pin.JointModelFreeFlyer()], [0, 0, -9.81], pin.Inertia(1.3, C, TENSOR))


def loads(x, u):
    """Forces and moments of rotors and drag, about the body's origin."""
    v, w = x[7:10], x[10:]
    total = pin.Force.Zero()
    damped = np.array([0.07, 0.03, -0.13])
    for at, force in (
        ([0.23, 0.04, -0.3], [0, 0, u[0]]),
        ([0.1, -0.2, 0.15], [0, u[1], 0]),
        (damped, -0.17 * (v + np.cross(w, damped))),
    ):
        force = pin.Force(np.array(force, float), np.zeros(3))
        total = total + pin.SE3(np.eye(3), np.array(at, float)).act(force)
    return total.vector


def drone(x, u):
    model, data = DRONE
    q, v = x[:7], x[7:]
    R = pin.Quaternion(q[3:] / np.linalg.norm(q[3:])).matrix()
    a = pin.aba(model, data, q, v, loads(x, u))
    spin = pin.Quaternion(0.0, *v[3:])
    dq = (pin.Quaternion(q[3:]) * spin).coeffs() / 2
    return np.concatenate([R @ v[:3], dq, a])


def drone_mass(x):
    model, data = DRONE
    M = np.triu(pin.crba(model, data, x[:7]))
    return M + np.triu(M, 1).T


def drone_bias(x, u):
    model, data = DRONE
    return pin.nonLinearEffects(model, data, x[:7], x[7:]) - loads(x, u)


# a heavy top about a fixed point: x is a quaternion (x, y, z, w) and the angular velocity
TOP = hung(
    [pin.JointModelSpherical()],
    [0, 0, -9.81],
    pin.Inertia(
        1.3,
        np.array([0.1, 0.05, 0.4]),
        np.array([[0.3, 0.01, 0], [0.01, 0.4, 0], [0, 0, 0.5]]),
    ),
)


def top(x):
    model, data = TOP
    a = pin.aba(model, data, x[:4], x[4:], np.zeros(3))
    spin = (pin.Quaternion(x[:4]) * pin.Quaternion(0.0, *x[4:])).coeffs() / 2
    return np.concatenate([spin, a])


# two masses on a rod in the plane, on springs: x is A by rows, the place, the turning, the velocity
BAR = hung([pin.JointModelPlanar()], [0, -9.81, 0], of_points((1, [-0.5, 0, 0]), (1, [0.5, 0, 0])))


def bar(x):
    model, data = BAR
    A, T, turn, v = x[:4].reshape(2, 2), x[4:6], x[6], x[7:]
    tau = np.zeros(3)
    for end in ([-0.5, 0.0], [0.5, 0.0]):
        reach = T + A @ end - end
        length = np.linalg.norm(reach)
        pull = A.T @ (-40.0 * (length - 0.4) / length * reach)
        tau += [*pull, end[0] * pull[1] - end[1] * pull[0]]
    q = np.array([*T, A[0, 0], A[1, 0]])
    a = pin.aba(model, data, q, np.array([*v, turn]), tau)
    dA = A @ np.array([[0, -turn], [turn, 0]])
    return np.concatenate([dA.ravel(), A @ v, [a[2], a[0], a[1]]])


# a pendulum: x is A by rows and the rate of the angle; the axis is the third, gravity along −y
PENDULUM = hung([pin.JointModelRUBZ()], [0, -9.81, 0], of_points((1, [0, -0.8, 0])))


def pendulum(x):
    model, data = PENDULUM
    a = pin.aba(model, data, np.array([x[0], x[2]]), x[4:], np.zeros(1))
    return np.concatenate([x[4] * np.array([x[1], -x[0], x[3], -x[2]]), a])


# two solids of points on one pivot, and a spring: x is both matrices by rows, and both rates
TOPS = hung(
    [pin.JointModelSpherical(), pin.JointModelSpherical()],
    [0, 0, 0],
    of_points((1, [1, 0, 0]), (1, [0, 1, 0])),
    of_points((1, [1, 0, 0.5]), (2, [0, 1, 0])),
)


def two_tops(x):
    model, data = TOPS
    A, B, w = x[:9].reshape(3, 3), x[9:18].reshape(3, 3), x[18:]
    one, other = np.array([1.0, 0, 0]), np.array([1.0, 0, 0.5])
    reach = A @ one - B @ other
    length = np.linalg.norm(reach)
    pull = -2.0 * (length - 0.5) / length * reach
    tau = np.concatenate([np.cross(one, A.T @ pull), np.cross(other, -B.T @ pull)])
    q = np.concatenate([pin.Quaternion(R).coeffs() for R in (A, B)])
    a = pin.aba(model, data, q, w, tau)
    return np.concatenate([(R @ pin.skew(s)).ravel() for R, s in ((A, w[:3]), (B, w[3:]))] + [a])
