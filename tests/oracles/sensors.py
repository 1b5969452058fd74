"""What sensors read of a motion, from the points of the oracle alone."""

import numpy as np

from tests.oracles.general import (
    axial,
    blocks,
    environment,
    evaluate,
    numbers_of_inputs,
    places,
    pushes,
    rhs,
    split,
)


def power(data, basis, p, t, found, G, zeta, u, of=None):
    """That of all that acts beside the potential, or what is lost of it without ``of``."""
    force, covector = pushes(data, basis, p, t, found, G, zeta, u)
    whole = force @ found.moved(G @ np.tensordot(zeta, basis, 1)) + covector @ zeta
    if of is None:
        return whole

    def quiet(kind, table):
        said = {"coefficient", "force", "moment", "covector"} & {*table}
        if table.get("name", kind) != of:
            return table
        return table | {x: 0 if x == "coefficient" else [0] * len(table[x]) for x in said}

    others = {x: [quiet(x, y) for y in data.get(x, ())] for x in ("force", "damping")}
    numbers = zip(numbers_of_inputs(data, basis), u, strict=True)
    left = [0 if name == of else x for (name, _), x in numbers]
    return whole - power(data | others, basis, p, t, found, G, zeta, left)


def outputs(data, basis, p, t, x, u):
    """All numbers of the tables [[output]], in order."""
    found, d = places(data, p), len(basis)
    G, zeta = split(data, x, d)
    Z = np.tensordot(zeta, basis, 1)
    later = rhs(data, basis, p, t, x, u)[-d:]
    r, v = found.moved(G), found.moved(G @ Z)
    a = found.moved(G @ (Z @ Z + np.tensordot(later, basis, 1)))
    env = environment(data, basis, p, t, G, zeta, u)
    numbers = []
    for k, table in enumerate(data["output"]):
        at = found.at.get(("output", k)) or found.at.get(("point", table.get("on")))
        first, n, _ = blocks(data)[0][table.get("block", 1) - 1]
        rows = found.row[at] if at else np.arange(first, first + n)
        turn = G[np.ix_(rows, rows)]
        kind, in_body = table.get("kind"), table.get("frame", "space") == "body"
        vector = {"place": r, "velocity": v, "acceleration": a}.get(kind)
        if vector is not None:
            vector = vector[at]
        elif kind == "specific_force":
            weights = [x["g"] for x in data["potential"] if x["kind"] == "gravity"]
            falling = sum(np.array([evaluate(y, p) for y in w]) for w in weights)
            vector, in_body = a[at] - falling, True
        elif kind == "rate":
            vector, in_body = axial(Z[np.ix_(rows, rows)]), False
        elif kind == "direction":
            direction = np.array([evaluate(y, p) for y in table["direction"]])
            vector = direction if in_body else turn @ direction
        elif kind == "momentum":
            own = [found.at[key] for key in found.points()]
            own = [i for i in own if found.row[i][0] == rows[0]]
            vector = sum(found.masses[i] * v[i] for i in own)
        elif kind == "distance":
            to = table["to"]
            end = np.array([evaluate(y, p) for y in to]) if isinstance(to, list) else None
            end = r[found.at["point", to]] if end is None else end
            vector, in_body = [np.linalg.norm(r[at] - end)], False
        elif kind == "tension":
            spring = data["potential"][table["of"] - 1]
            i, j = (r[found.at["point", i]] for i in spring["between"])
            stretched = np.linalg.norm(i - j) - evaluate(spring.get("length", 0), p)
            vector, in_body = [evaluate(spring["stiffness"], p) * stretched], False
        elif kind == "power":
            given = data, basis, p, t, found, G, zeta, u
            vector, in_body = [power(*given, table.get("of"))], False
        else:
            here = {f"r_{i}": y for i, y in enumerate(r[at], 1)} if at else {}
            here |= {f"v_{i}": y for i, y in enumerate(v[at], 1)} if at else {}
            vector, in_body = [evaluate(y, env | here) for y in table["y"]], False
        numbers += [*(turn.T @ vector if in_body else vector)]
    return np.array(numbers)
