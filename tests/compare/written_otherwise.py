"""Our equations in another's conventions, by formulas that share nothing with derive's: a module
whose ``f(x, u)`` takes and gives what ``CHOICES`` says."""

import numpy as np
import ours
from scipy.spatial.transform import Rotation

CHOICES = None
K = ours.constants(ours.DEFAULTS)


def rotation(name, numbers):
    said = CHOICES["said"].get(name, {})
    if name == "quaternion":
        R = Rotation.from_quat(np.roll(numbers, -1) if said["order"] == "wxyz" else numbers)
        R = R.as_matrix()
    elif name == "euler":
        R = Rotation.from_euler(said["sequence"], numbers).as_matrix()
    else:
        R = np.reshape(numbers, (3, 3))
        R = R if said["order"] == "row" else R.T
    return R if said["sense"] == "body to space" else R.T


def rates(name, numbers, R, w):
    """Of what says the rotation R, from the angular velocity in the body."""
    said = CHOICES["said"][name]
    turned = said["sense"] == "space to body"
    # the rotation that is said turns by w, its transpose by −R w
    w, S = (-R @ w, R.T) if turned else (w, R)
    if name == "matrix":
        found = np.stack([np.cross(row, w) for row in S])
        return (found if said["order"] == "row" else found.T).ravel()
    if name == "quaternion":
        a, b = (numbers[0], numbers[1:]) if said["order"] == "wxyz" else (numbers[3], numbers[:3])
        scalar, vector = -b @ w / 2, (a * w + np.cross(b, w)) / 2
        return np.array([scalar, *vector] if said["order"] == "wxyz" else [*vector, scalar])
    sequence, axes, columns = said["sequence"], np.eye(3), []
    for i, axis in enumerate(sequence):
        later = [*zip(sequence, numbers, strict=True)]
        later = later[i + 1 :] if sequence.isupper() else later[:i][::-1]
        e = axes["XYZ".index(axis.upper())]
        for other, angle in later:
            e = Rotation.from_rotvec(-angle * axes["XYZ".index(other.upper())]).apply(e)
        columns.append(e)
    return np.linalg.solve(np.stack(columns, axis=1), w)


def f(x, u):
    """dx/dt of the state that CHOICES says."""
    given, first = {}, 0
    for name, size in CHOICES["state"]:
        given[name] = x[first : first + size] / CHOICES["units"].get(name, 1.0)
        first += size
    turned = next(x for x in given if x in ("quaternion", "euler", "matrix"))
    R = rotation(turned, given[turned])
    frames = {name: CHOICES["said"][name]["frame"] for name in ("omega", "velocity")}
    w, v = (given[x] if frames[x] == "body" else R.T @ given[x] for x in frames)
    dx = ours.rhs(0.0, np.concatenate([R.ravel(), given["position"], w, v]), K, np.asarray(u))
    dw, dv = dx[12:15], dx[15:]
    made = {
        turned: rates(turned, given[turned], R, w),
        "position": dx[9:12],
        "omega": dw if frames["omega"] == "body" else R @ dw,
        "velocity": dv if frames["velocity"] == "body" else R @ (dv + np.cross(w, v)),
    }
    return np.concatenate([made[x] * CHOICES["units"].get(x, 1.0) for x, _ in CHOICES["state"]])
