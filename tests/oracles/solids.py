"""The moments of a body as numbers: solids by quadrature, exact for their polynomials; points with
them; and what a file gives."""

import numpy as np

from tests.oracles import general


def moments(data):
    """m, c_1 …, J_11 … of the whole body, from the plain data that TOML gives."""
    total, env, body = np.zeros((4, 4)), general.parameters(data), data.get("body", {})
    if "given" in body:
        total += given(body["given"], env)
    for point in data.get("point", ()):
        r = np.array([general.evaluate(x, env) for x in (*point["at"], 1)])
        total += general.evaluate(point["mass"], env) * np.outer(r, r)
    alone = [body | {"kind": body["solid"]}] if "solid" in body else []
    for solid in (*data.get("solid", ()), *alone):
        weights, points = nodes(solid, env)
        turn, shift = np.eye(3), np.zeros((3, 1))
        if "rotation" in solid:
            turn = general.turn(solid["rotation"], 3, env)
        if "shift" in solid:
            shift = np.array([[general.evaluate(s, env)] for s in solid["shift"]])
        r = np.vstack([turn @ points + shift, np.ones(points.shape[1])])
        total += general.evaluate(solid["density"], env) * (r * weights) @ r.T
    found = {"m": total[3, 3]} | {f"c_{i + 1}": total[i, 3] for i in range(3)}
    found |= {f"J_{i + 1}{j + 1}": total[i, j] for i in range(3) for j in range(i, 3)}
    return {k: float(x) for k, x in found.items()}


def given(table, env):
    """The moment matrix (4, 4) of { m, c, J } or { m, c, I }, J = (Tr I)/2 1 - I."""
    m, c = general.evaluate(table["m"], env), [general.evaluate(x, env) for x in table["c"]]
    name = "I" if "I" in table else "J"
    J = np.array([[general.evaluate(x, env) for x in row] for row in table[name]])
    if name == "I":
        J = np.trace(J) / 2 * np.eye(3) - J
    return np.block([[J, np.array(c)[:, None]], [np.array(c), np.array(m)]])


def by_moments(data):
    """The problem with its body replaced by its moments, as parameters."""
    other = {k: x for k, x in data.items() if k not in ("solid", "point")}
    known = general.parameters(data) | moments(data)
    return other | {"parameters": known, "body": {"moments": "symbolic"}}


def by_points(data):
    """The problem with its solids replaced by points of the same moments, after those it lists."""
    solids = moments({k: x for k, x in data.items() if k != "point"})
    masses, places = general.realised(solids, 3, True)
    more = [{"mass": m, "at": [*r]} for m, r in zip(masses.tolist(), places.tolist(), strict=True)]
    other = {k: x for k, x in data.items() if k != "solid"}
    return other | {"point": [*data["point"], *more]}


def nodes(solid, env):
    """Weights (k,) and points (3, k) of a quadrature over a solid in its own frame."""
    kind = solid["kind"]
    lengths = {"radius", "height", "sides", "semi_axes", "outer", "inner"} & {*solid}
    given_sizes = {k: solid[k] if isinstance(solid[k], list) else [solid[k]] for k in lengths}
    sizes = {k: np.array([general.evaluate(y, env) for y in x]) for k, x in given_sizes.items()}
    x, w = np.polynomial.legendre.leggauss(6)
    unit, half = (x + 1) / 2, w / 2
    angle = np.arange(12) * np.pi / 6
    if kind == "box":
        X = np.array(np.meshgrid(x / 2, x / 2, x / 2)).reshape(3, -1)
        W = np.einsum("i,j,k->ijk", half, half, half).ravel()
        return W * sizes["sides"].prod(), X * sizes["sides"][:, None]
    if kind == "tetrahedron":
        return simplex(np.array(solid["vertices"], float), unit, half)
    if kind in ("cylinder", "cone"):
        z, s, a = np.meshgrid(unit, unit, angle, indexing="ij")
        wide = 1 - z if kind == "cone" else np.ones_like(z)
        W = np.einsum("i,j->ij", half, half)[..., None] * s * wide**2 * np.pi / 6
        radius, height = sizes["radius"][0], sizes["height"][0]
        up = z - (0.5 if kind == "cylinder" else 0)
        X = np.stack([radius * wide * s * np.cos(a), radius * wide * s * np.sin(a), height * up])
        return (W * radius**2 * height).ravel(), X.reshape(3, -1)
    r, c, a = np.meshgrid(unit, x, angle, indexing="ij")
    side = np.sqrt(1 - c**2)
    X = np.stack([r * side * np.cos(a), r * side * np.sin(a), r * c]).reshape(3, -1)
    W = (np.einsum("i,j->ij", half, w)[..., None] * r**2 * np.pi / 6).ravel()
    if kind == "hollow_ball":
        outer, inner = sizes["outer"][0], sizes["inner"][0]
        return np.concatenate([W * outer**3, -W * inner**3]), np.hstack([X * outer, X * inner])
    if "quadric" in solid:
        Q = np.array([[general.evaluate(y, env) for y in row] for row in solid["quadric"]])
        return W / np.sqrt(np.linalg.det(Q)), np.linalg.solve(np.linalg.cholesky(Q).T, X)
    axes = sizes["semi_axes"] if kind == "ellipsoid" else np.repeat(sizes["radius"], 3)
    return W * axes.prod(), X * axes[:, None]


def simplex(corners, unit, half):
    """A quadrature over a tetrahedron (4, 3): the cube, one face and one edge drawn together."""
    a, b, c = (x.ravel() for x in np.meshgrid(unit, unit, unit, indexing="ij"))
    weights = np.einsum("i,j,k->ijk", half, half, half).ravel() * (1 - a) ** 2 * (1 - b)
    shares = np.stack([a, (1 - a) * b, (1 - a) * (1 - b) * c])
    edges = (corners[1:] - corners[0]).T
    return weights * abs(np.linalg.det(edges)), corners[0][:, None] + edges @ shares
