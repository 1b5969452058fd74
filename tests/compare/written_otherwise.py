"""Our equations, in any of our languages, in another's conventions, by formulas that share nothing
with derive's: a module whose ``f(t, x, u)`` takes and gives what ``CHOICES`` says."""

import numpy as np
from choices import BUILD, CHOICES, DEFAULTS, PROBLEM
from scipy.spatial.transform import Rotation

from tests.support.library import library

OURS = library(BUILD, PROBLEM, **CHOICES["options"])
_, K = OURS.constants(DEFAULTS)
ATTITUDES = ("quaternion", "euler", "matrix")


def rotation(name, numbers):
    said, kind = CHOICES["said"].get(name, {}), name.rstrip("12")
    if kind == "quaternion":
        R = Rotation.from_quat(np.roll(numbers, -1) if said["order"] == "wxyz" else numbers)
        R = R.as_matrix()
    elif kind == "euler":
        R = Rotation.from_euler(said["sequence"], numbers).as_matrix()
    else:
        R = np.reshape(numbers, (3, 3))
        R = R if said["order"] == "row" else R.T
    return R if said["sense"] == "body to space" else R.T


def rates(name, numbers, R, w):
    """Of what says the rotation R, from the angular velocity in the body."""
    said, kind = CHOICES["said"][name], name.rstrip("12")
    turned = said["sense"] == "space to body"
    # the rotation that is said turns by w, its transpose by −R w
    w, S = (-R @ w, R.T) if turned else (w, R)
    if kind == "matrix":
        found = np.stack([np.cross(row, w) for row in S])
        return (found if said["order"] == "row" else found.T).ravel()
    if kind == "quaternion":
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


def f(t, x, u):
    """dx/dt of the state that CHOICES says."""
    given, first = {}, 0
    for name, size in CHOICES["state"]:
        given[name] = x[first : first + size] / CHOICES["units"].get(name, 1.0)
        first += size
    u = np.array([u[CHOICES["inputs"].index(i)] for i in range(len(u))])
    turned = {x.rstrip("12") for x in given} & {*ATTITUDES}
    made = in_blocks if turned and not CHOICES["options"] else in_names
    found = made(t, given, u)
    return np.concatenate([found[x] * CHOICES["units"].get(x, 1.0) for x, _ in CHOICES["state"]])


def rhs(t, x, u):
    return OURS.said("rhs", x, t, k=K, u=u, p=DEFAULTS)[: len(x)]


def in_names(t, given, u):
    """Of our own names, in another order."""
    names = CHOICES["names"]
    dx = rhs(t, np.concatenate([given[x] for x in names]), u)
    places = np.cumsum([len(given[x]) for x in names])[:-1]
    return dict(zip(names, np.split(dx, places), strict=True))


def in_blocks(t, given, u):
    """Of an attitude, a place and velocities of each factor."""
    marks = ("1", "2") if "omega1" in given else ("",)
    bodies = [body(mark, given) for mark in marks]
    places = [np.concatenate([R.ravel(), *place]) for R, place, _ in bodies]
    dx = rhs(t, np.concatenate([*places, *(np.concatenate(x) for *_, x in bodies)]), u)
    sizes = [x for _, place, _ in bodies for x in [9] + [3] * len(place)]
    sizes += [3 for *_, vectors in bodies for _ in vectors]
    parts = iter(np.split(dx, np.cumsum(sizes)[:-1]))
    found = {}
    for mark, (R, place, (w, *_)) in zip(marks, bodies, strict=True):
        next(parts)  # Ṙ, by the formulas of the chart
        turned = next(x for x in given if x in [y + mark for y in ATTITUDES])
        found[turned] = rates(turned, given[turned], R, w)
        found |= {f"position{mark}": next(parts) for _ in place}
    for mark, (R, _, (w, *v)) in zip(marks, bodies, strict=True):
        name = f"omega{mark}"
        dw = next(parts)
        found[name] = dw if CHOICES["said"][name]["frame"] == "body" else R @ dw
        for x in v:
            name, dv = f"velocity{mark}", next(parts)
            moved = CHOICES["said"][name]["frame"] == "body"
            found[name] = dv if moved else R @ (dv + np.cross(w, x))
    return found


def body(mark, given):
    """The rotation of a factor, its place and its velocities in the body."""
    turned = next(x for x in given if x in [y + mark for y in ATTITUDES])
    R = rotation(turned, given[turned])
    vectors = [x + mark for x in ("omega", "velocity") if x + mark in given]
    frames = {name: CHOICES["said"][name]["frame"] for name in vectors}
    own = [given[x] if frames[x] == "body" else R.T @ given[x] for x in vectors]
    return R, [given[f"position{mark}"]] if len(own) > 1 else [], own
