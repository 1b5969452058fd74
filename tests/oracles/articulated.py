"""Featherstone's articulated-body algorithm on one solid, by Pinocchio where it is installed.

A spherical joint (quaternion x, y, z, w and angular velocity in the body) for so3; a free flyer
(place, quaternion; linear, then angular velocity in the body) for se3.
"""

import numpy as np

from tests.oracles import sampling


def model(pin, name, body):
    """The model of a body that hangs on one joint."""
    m, c, _ = sampling.moments(body)
    s = c / m
    central = sampling.inertia(body) - m * (s @ s * np.eye(3) - np.outer(s, s))
    joint = pin.JointModelSpherical() if name == "so3" else pin.JointModelFreeFlyer()
    made = pin.Model()
    index = made.addJoint(0, joint, pin.SE3.Identity(), "joint")
    made.appendBodyToJoint(index, pin.Inertia(m, s, central), pin.SE3.Identity())
    made.gravity.linear = body.gravity
    return made


def acceleration(pin, name, x, body, u):
    """dzeta/dt (and dw/dt) in the state ``x``; ``u`` as the emitted code takes it."""
    made = model(pin, name, body)
    turned = np.roll(sampling.quaternion(x[:9].reshape(3, 3)), -1)
    if name == "so3":
        return pin.aba(made, made.createData(), turned, x[9:], np.asarray(u, float))
    swap = np.r_[3:6, 0:3]
    q = np.concatenate([x[9:12], turned])
    return pin.aba(made, made.createData(), q, x[12:][swap], np.asarray(u, float)[swap])[swap]
