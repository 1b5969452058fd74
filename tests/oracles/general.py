"""Gauss's principle of least constraint for any problem file, from the plain data that TOML gives.

The points move with accelerations ``a_i = G (dZ/dt + Z^2) r_i``, Z = G^-1 dG/dt in the algebra.
Among all dZ/dt the true one makes ``sum m_i |a_i - F_i / m_i|^2 - 2 <u, dzeta/dt>`` least.  F is
-grad U, by complex steps, with damping and force inputs; u is the covector of the inputs.

Sizes: d coordinates zeta, matrices s x s, M coordinates of all places together.  A place is where a
force may act: a point, or a massless one to which a spring or an input is attached.  ``basis`` is
(d, s, s); ``p`` maps parameters to numbers; a state is the group element (A row-major, then T where
the group translates, factor after factor) and then zeta.
"""

import re
from typing import NamedTuple

import numpy as np

from tests.oracles import ellipsoids

STEP = 1e-30
FAMILIES = dict.fromkeys(("SO", "SL", "GL", "Sp", "UT"), (1, False))
FAMILIES |= dict.fromkeys(("SE", "SAff", "Aff", "Sim", "R"), (1, True))
FAMILIES |= dict.fromkeys(("U", "SU"), (2, False))
TOKEN = re.compile(r"\s*(?:((?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|([A-Za-z]\w*)|(\S))")
SUM = {"+": (1, 1, np.add), "-": (1, 1, np.subtract)}
BINARY = SUM | {"*": (2, 2, np.multiply), "/": (2, 2, np.divide), "^": (4, 3, np.power)}
NAMES = ("sqrt", "sin", "cos", "tan", "exp", "log", "sinh", "cosh", "tanh")
OF_FRAMES = {"torsion", "far_centre", "volume", "self_gravity"}
FUNCTIONS = {"atan": np.arctan, **{name: getattr(np, name) for name in NAMES}}
FUNCTIONS |= {"abs": lambda x: x * np.sign(np.real(x)), "sign": lambda x: np.sign(np.real(x))}


def angle(y, x):
    """atan2 with the derivative of a complex step."""
    a, b = np.real(y), np.real(x)
    return np.arctan2(a, b) + 1j * (b * np.imag(y) - a * np.imag(x)) / (a * a + b * b)


OF_TWO = {
    "min": lambda a, b: np.where(np.real(a) < np.real(b), a, b),
    "max": lambda a, b: np.where(np.real(a) < np.real(b), b, a),
    "hypot": lambda a, b: np.sqrt(a * a + b * b),
    "atan2": lambda y, x: angle(y, x) if np.iscomplexobj(y + x) else np.arctan2(y, x),
}


def _read(tokens, env, level):
    """The value of the longest run of tokens whose operators bind more tightly than ``level``."""
    token = tokens.pop(0)
    if token in SUM:
        value = BINARY[token][2](0.0, _read(tokens, env, 3))
    elif token[:1].isdigit() or token[:1] == ".":
        value = np.float64(token)
    elif token == "(":
        value = _read(tokens, env, 0)
        if tokens.pop(0) != ")":
            raise ValueError("a parenthesis is not closed")
    elif token in OF_TWO:
        parts = []
        for end in ",)":
            tokens.pop(0)
            parts.append(_read(tokens, env, 0))
            if tokens[0] != end:
                raise ValueError(f"{token} is of two expressions")
        tokens.pop(0)
        value = OF_TWO[token](*parts)
    elif tokens[0] == "(":
        value = FUNCTIONS[token](_read(tokens, env, 5))
    else:
        value = np.multiply(np.pi if token == "pi" else env[token], 1.0)
    if tokens[:1] == ["^"] and tokens[1:2] == ["("] and level < 4:
        tokens.pop(0)
        value = np.power(value, _read(tokens, env, 5))
    while BINARY.get(tokens[0], (0,))[0] > level:
        _, right, operation = BINARY[tokens.pop(0)]
        value = operation(value, _read(tokens, env, right))
    return value


def evaluate(value, env):
    """A number, or an expression in the names of ``env``, at real or complex numbers or arrays."""
    tokens = [*map("".join, TOKEN.findall(str(value))), "end of text", ""]
    result = _read(tokens, env, 0)
    if len(tokens) > 2:
        raise ValueError(f"unexpected {tokens[0]!r}")
    return result


def _vector(values, n, env):
    """The column (n, 1) of n expressions."""
    if len(values) != n:
        raise ValueError(f"{len(values)} entries instead of {n}")
    return np.array([[evaluate(value, env)] for value in values])


class Places(NamedTuple):
    """Points, then massless places; ``masses`` and ``row`` of G are (M,), ``r`` is (M, s).

    ``at`` says which of the M coordinates are those of ("point", i), or of a point that realises
    given moments, ("realised", i), or of ("potential", k), ("input", k); of the origin and the ends
    of the axes of the body, ("frame", 0), ("frame", j), where a potential is one of A and T.
    """

    at: dict
    masses: np.ndarray
    row: np.ndarray
    r: np.ndarray

    def moved(self, matrix):
        """The rows (M,) of ``matrix r``."""
        return np.sum(matrix[self.row] * self.r, axis=1)

    def points(self):
        """The keys of the points of the file; refused where only moments are known."""
        if ("realised", 1) in self.at:
            raise ValueError("this is not defined by the moments of a body")
        return [key for key in self.at if key[0] == "point"]


def blocks(data):
    """The factors of the group as (first row, n, whether they translate), and the size s."""
    group, found, size = data["group"], [], 0
    if isinstance(group, dict):
        size, affine = len(group["basis"][0]), group.get("action", "linear") == "affine"
        return [(0, size - affine, affine)], size
    for part in re.split("[x×]", group):
        family, n = part.strip(" )").split("(")
        factor, affine = FAMILIES[family]
        found.append((size, factor * int(n), affine))
        size += factor * int(n) + affine
    return found, size


def parameters(data):
    """The defaults of the parameters that have one."""
    given = data.get("parameters", {}).items()
    values = {name: x.get("default") if isinstance(x, dict) else x for name, x in given}
    return {name: float(x) for name, x in values.items() if x is not None}


def _entries(data):
    """Where the numbers of a group element are in G: rows and columns."""
    parts, rows, columns = blocks(data)[0], [], []
    names = re.split("[x×]", data["group"]) if isinstance(data["group"], str) else [""]
    for (first, n, affine), name in zip(parts, names, strict=True):
        span = range(first, first + n)
        turned = [] if name.strip().startswith("R(") else span
        rows += [i for i in turned for _ in span] + [i for i in span if affine]
        columns += [j for _ in turned for j in span] + [first + n for _ in span if affine]
    return rows, columns


def split(data, x, d):
    """A state as G (s, s) and zeta (d,); complex where x is."""
    entries = _entries(data)
    if len(x) != len(entries[0]) + d:
        raise ValueError(f"a state of {len(x)} numbers instead of {len(entries[0])} + {d}")
    G = np.eye(blocks(data)[1], dtype=np.result_type(x, float))
    G[entries] = x[:-d]
    return G, x[-d:]


def join(data, G, zeta):
    """A state from G (s, s), or its velocity from dG/dt, and zeta (d,)."""
    return np.concatenate([G[_entries(data)], zeta])


def realised(p, n, affine):
    """Masses (n + 1,) and points (n + 1, n) whose moments are the m, c, J of ``p``.

    The columns of R, where R R^T = [[J, c], [c^T, m]], are sqrt(m_i) (r_i, 1), turned so that the
    masses are equal.  Linear maps do not see m: there it is any number that is large enough.
    """
    span = range(1, n + 1)
    J = np.array([[p[f"J_{min(i, j)}{max(i, j)}"] for j in span] for i in span])
    c = np.array([p[f"c_{i}"] if affine else p.get(f"c_{i}", 0) for i in span])
    m = p["m"] if affine else 2 * c @ np.linalg.pinv(J) @ c + np.trace(J) / n
    scale = np.sqrt(abs(np.trace(J) / m))  # of the last row and column: that of the others
    sizes, axes = np.linalg.eigh(np.block([[J, c[:, None] * scale], [c * scale, m * scale**2]]))
    if not (m > 0 and sizes[0] >= -1e-13 * sizes[-1]):
        raise ValueError("no masses have these moments")
    R, root = axes * np.sqrt(np.maximum(sizes, 0)), np.sqrt(m / (n + 1))
    mirror = R[n] - root * scale
    R = R - np.outer(R @ mirror, mirror) * (2 / (mirror @ mirror or 1))
    return np.full(n + 1, root**2), (R[:n] / root).T


def places(data, p):
    """All :class:`Places`: the points, then what springs and inputs are attached to."""
    parts, size = blocks(data)
    if "body" in data:
        ((_, n, affine),) = parts
        pairs = zip(*realised(p, n, affine), strict=True)
        tables = {("realised", i): {"mass": m, "at": r} for i, (m, r) in enumerate(pairs, 1)}
    else:
        tables = {("point", i): x for i, x in enumerate(data["point"], 1)}
    for kind in ("potential", "input", "force", "damping", "output"):
        tables |= {(kind, k): x for k, x in enumerate(data.get(kind, ())) if "at" in x}
    if {x["kind"] for x in data.get("potential", ())} & OF_FRAMES:
        ((_, n, affine),) = parts
        axes = [[0] * n] * affine + [*np.eye(n)]
        tables |= {("frame", j): {"at": r} for j, r in enumerate(axes, 1 - affine)}
    at, entries = {}, []
    for key, table in tables.items():
        first, n, affine = parts[table.get("block", 1) - 1]
        mass, r = evaluate(table.get("mass", 0), p), np.zeros(size)
        if not mass >= 0:
            raise ValueError(f"{key}: the mass is {mass}")
        r[first : first + n + affine] = [*_vector(table["at"], n, p)[:, 0], *[1] * affine]
        at[key] = slice(len(entries), len(entries) + n)
        entries += [(mass, row, r) for row in range(first, first + n)]
    return Places(at, *map(np.array, zip(*entries, strict=True)))


def positions(data, p, G):
    """The positions (n_k,) of the points, those that realise given moments included."""
    found = places(data, p)
    return [found.moved(G)[x] for key, x in found.at.items() if key[0] in ("point", "realised")]


def _key(kind, k, table):
    """The key of the place on which table k of [[potential]] or [[input]] acts."""
    return (kind, k) if "at" in table else ("point", table["on"])


def _norm(q, centre, env):
    """The distances (B,) of ``q`` (n, B) from ``centre``, n expressions or (n, B); analytic."""
    gap = q - (centre if isinstance(centre, np.ndarray) else _vector(centre, len(q), env))
    return np.sqrt(np.sum(gap * gap, axis=0))


def turn(given, n, env):
    """A rotation (n, n): none, rows, or an axis of any length with an angle."""
    if not isinstance(given, dict):
        return np.array([[evaluate(x, env) for x in row] for row in given or np.eye(n).tolist()])
    axis = _vector(given["axis"], 3, env)[:, 0]
    e, angle = axis / np.linalg.norm(axis), evaluate(given["angle"], env)
    across = np.array([[0, -e[2], e[1]], [e[2], 0, -e[0]], [-e[1], e[0], 0]])
    return np.eye(3) + np.sin(angle) * across + (1 - np.cos(angle)) * across @ across


def _torsion(table, env, q):
    """Half the stiffness times the sum of the squares of A - R, halved: for a rotation A."""
    n = len(q["frame", 1])
    rest = turn(table.get("rest"), n, env)
    gaps = [q["frame", j + 1] - q.get(("frame", 0), 0) - rest[:, [j]] for j in range(n)]
    return evaluate(table["stiffness"], env) / 4 * sum(np.sum(x * x, 0) for x in gaps)


def _far_centre(table, env, mass, q):
    """-GM sum m / |T + a|, T from the centre, a = A r, up to the second order in a."""
    T = q["frame", 0] - _vector(table.get("centre", [0, 0, 0]), 3, env)
    R = np.sqrt(np.sum(T * T, 0))
    total = 0
    for key, m in mass.items():
        a = q[key] - q["frame", 0]
        small = (2 * np.sum(T * a, 0) + np.sum(a * a, 0)) / R**2  # |T + a|^2 = R^2 (1 + small)
        along = 2 * np.sum(T * a, 0) / R**2
        total = total + m / R * (1 - small / 2 + 3 * along**2 / 8)
    return -evaluate(table["strength"], env) * total


def _volume(table, env, q):
    """U of the determinant of the axes of the body in space."""
    n = len(q["frame", 1])
    axes = [q["frame", j + 1] - q.get(("frame", 0), 0) for j in range(n)]
    return evaluate(table["U"], env | {"det_A": np.linalg.det(np.array(axes).T)})


def _self_gravity(table, env, mass, q):
    """The gravity of the homogeneous ellipsoid that has the moments of the points about T."""
    a = {key: q[key] - q.get(("frame", 0), 0) for key in mass}
    # linear maps do not see m, and points that realise moments have any
    total = env["m"] if ("realised", 1) in q else sum(mass.values())
    G = evaluate(table["G"], env)
    S = sum(m * np.einsum("ib,jb->bij", a[key], a[key]) for key, m in mass.items())
    return np.array([ellipsoids.energy(5 * x / total, total, G) for x in S])


def _term(k, table, env, found, q):
    """The k-th [[potential]] (B,) where the places are at the columns of ``q[key]`` (n_k, B)."""
    mass = {key: found.masses[x][0] for key, x in found.at.items() if found.masses[x][0]}
    if table["kind"] == "gravity":
        heights = {key: np.sum(_vector(table["g"], len(q[key]), env) * q[key], 0) for key in mass}
        return -sum(mass[key] * heights[key] for key in mass)
    if table["kind"] == "spring":
        ends = [q["point", i] for i in table.get("between", ())]
        ends = ends or [q[_key("potential", k, table)], table["anchor"]]
        stretch = _norm(*ends, env) - evaluate(table.get("length", 0), env)
        return evaluate(table["stiffness"], env) / 2 * stretch**2
    if table["kind"] == "attraction":
        away = {x: _norm(q[x], table.get("centre", [0] * len(q[x])), env) for x in found.points()}
        return -evaluate(table["strength"], env) * sum(mass[key] / away[key] for key in mass)
    if table["kind"] == "torsion":
        return _torsion(table, env, q)
    if table["kind"] == "harmonic":
        W = [[evaluate(x, env) for x in row] for row in table["W"]]
        pairs = [(m, q[key]) for key, m in mass.items()]
        return sum(m * np.sum(x * (np.array(W) @ x), 0) for m, x in pairs) / 2
    if table["kind"] == "volume":
        return _volume(table, env, q)
    if table["kind"] == "far_centre":
        return _far_centre(table, env, mass, q)
    if table["kind"] == "self_gravity":
        return _self_gravity(table, env, mass, q)
    if table["kind"] == "field":
        E = _vector(table["E"], len(q["point", 1]), env)
        charged = enumerate(table["charges"], 1)
        return -sum(evaluate(x, env) * np.sum(E * q["point", i], 0) for i, x in charged)
    names = {}
    for (_, i), rows in ((key, x) for key, x in q.items() if key[0] == "point"):
        for j, row in enumerate(rows):
            names |= {f"r{i}_{x}": row for x in (j + 1, "xyz"[j] if len(rows) <= 3 else j + 1)}
    return evaluate(table["U"], {**env, **names})


def potential(data, p, t, found, rows):
    """U (B,) where the places are at the columns of ``rows`` (M, B)."""
    env, q = {**p, "t": t}, {key: rows[x] for key, x in found.at.items()}
    terms = [_term(k, x, env, found, q) for k, x in enumerate(data.get("potential", ()))]
    return np.zeros(rows.shape[1]) + sum(terms)


def forces(data, p, t, found, rows):
    """-grad U (M,) where the places are at ``rows`` (M,); NaN outside the domain of U."""
    steps = rows[:, None] + 1j * STEP * np.eye(len(rows))
    change = potential(data, p, t, found, steps).imag
    return np.where(np.abs(change) < 1e-12, -change / STEP, np.nan)


def damping(data, p, t, found, v):
    """The forces (M,) of damping at the velocities ``v`` (M,)."""
    force = np.zeros(len(v))
    for k, table in enumerate(data.get("damping", ())):
        if table.get("kind") == "rotational":
            continue
        on = [("point", i) for i in table["on"]] if "on" in table else found.points()
        for x in map(found.at.get, [("damping", k)] if "at" in table else on):
            size = np.linalg.norm(v[x]) if table.get("kind") == "quadratic" else 1
            force[x] -= evaluate(table["coefficient"], {**p, "t": t}) * size * v[x]
    return force


def axial(W):
    """The angular velocity of a skew matrix of R^3 (3,), or of the plane (1,)."""
    return np.array([W[2, 1], W[0, 2], W[1, 0]] if len(W) == 3 else [W[1, 0]])


def work(torque, basis, turn, rows, in_body):
    """The work (d,) of a torque on the angular velocity of each member of the basis, which is
    turned into space unless the torque is in the body."""
    parts = [E[np.ix_(rows, rows)] for E in np.asarray(basis, float)]
    turned = parts if in_body else [turn @ W @ turn.T for W in parts]
    return np.array([torque @ axial(W) for W in turned])


def names_of_state(data, basis, G, zeta):
    """The numbers of a state by the names that expressions have for them."""
    parts, env, (d, n) = blocks(data)[0], {}, (len(zeta), len(G) - 1)
    for k, (first, size, affine) in enumerate(parts, 1):
        mark = k if len(parts) > 1 else ""
        for i in range(size):
            env |= {f"A{mark}_{i + 1}{j + 1}": G[first + i, first + j] for j in range(size)}
            env |= {f"T{mark}_{i + 1}": G[first + i, first + size]} if affine else {}
    shifts = len(parts) == 1 and parts[0][2] and d > n
    shifts = shifts and not np.any(np.asarray(basis, float)[-n:, :, :n])
    turns = d - n if shifts else d
    env |= {f"zeta_{a}": x for a, x in enumerate(zeta[:turns], 1)}
    return env | {f"w_{i}": x for i, x in enumerate(zeta[turns:], 1)}


def numbers_of_inputs(data, basis):
    """The name of each input, and of each of its numbers."""
    for table in data.get("input", ()):
        size = len(basis)
        if table["kind"] not in ("covector", "scalar"):
            size = blocks(data)[0][table.get("block", 1) - 1][1]
        single = "direction" in table or (table["kind"], size) == ("torque", 2)
        single = single or table["kind"] == "scalar"
        name = table["name"]
        yield from [(name, name)] if single else [(name, f"{name}_{i + 1}") for i in range(size)]


def environment(data, basis, p, t, G, zeta, u):
    """The numbers of parameters, the time, the state and the inputs by their names."""
    named = [] if u is None else zip(numbers_of_inputs(data, basis), u, strict=True)
    own = {name: x for (_, name), x in named}
    return {**p, "t": t, **names_of_state(data, basis, G, zeta), **own}


def stated(data, basis, p, t, found, G, zeta, u):
    """What the tables [[force]] give: forces (M,) and a covector (d,)."""
    force, covector = np.zeros(len(found.row)), np.zeros(len(basis))
    env = environment(data, basis, p, t, G, zeta, u)
    Z = np.tensordot(zeta, basis, 1)
    for k, table in enumerate(data.get("force", ())):
        if "covector" in table:
            covector += _vector(table["covector"], len(basis), env)[:, 0]
            continue
        x = found.at[_key("force", k, table)]
        rows, n = found.row[x], x.stop - x.start
        turn, in_body = G[np.ix_(rows, rows)], table.get("frame", "space") == "body"
        here = {f"r_{i}": y for i, y in enumerate(found.moved(G)[x], 1)}
        wind = _vector(table.get("relative_to", [0] * n), n, {**p, "t": t, **here})[:, 0]
        v = found.moved(G @ Z)[x] - wind
        here |= {f"v_{i}": y for i, y in enumerate(turn.T @ v if in_body else v, 1)}
        if "force" in table:
            F = _vector(table["force"], n, env | here)[:, 0]
            force[x] += turn @ F if in_body else F
        if "moment" in table:
            torque = _vector(table["moment"], len(table["moment"]), env | here)[:, 0]
            covector += work(torque, basis, turn, rows, in_body)
    for table in data.get("damping", ()):
        if table.get("kind") == "rotational":
            first, n, _ = blocks(data)[0][table.get("block", 1) - 1]
            rows = np.arange(first, first + n)
            spin = axial(Z[np.ix_(rows, rows)])
            torque = -evaluate(table["coefficient"], {**p, "t": t}) * spin
            covector += work(torque, basis, None, rows, True)
    return force, covector


def inputs(data, basis, p, found, G, u):
    """What ``u``, all inputs in order, gives: forces (M,) and a covector (d,).

    The work of a torque is that on the angular velocity of each member of the basis.
    """
    d, left = len(basis), [*np.asarray(u, float)]
    force, covector = np.zeros(len(found.row)), np.zeros(d)

    def taken(count):
        """The next numbers of ``u``."""
        values = [left.pop(0) for _ in range(count)]
        return np.array(values)

    for k, table in enumerate(data.get("input", ())):
        if table["kind"] == "covector":
            covector += taken(d)
            continue
        if table["kind"] == "scalar":
            taken(1)  # functions of the state know it
            continue
        first, n, _ = blocks(data)[0][table.get("block", 1) - 1]
        x, rows = None, np.arange(first, first + n)
        if table["kind"] == "force":
            x = found.at[_key("input", k, table)]
            rows = found.row[x]
        in_body = table.get("frame", "space") == "body"
        turn = G[np.ix_(rows, rows)]
        plane = table["kind"] == "torque" and len(rows) == 2
        if "direction" in table:
            (number,) = taken(1)
            vector = number * _vector(table["direction"], len(rows), p)[:, 0]
        else:
            vector = taken(1 if plane else len(rows))
        torque = vector if x is None else None
        if x is not None:
            force[x] += turn @ vector if in_body else vector
        if "moment" in table:
            torque = number * _vector(table["moment"], len(table["moment"]), p)[:, 0]
        if torque is not None:
            covector += work(torque, basis, turn, rows, in_body)
    if left:
        raise ValueError(f"{len(left)} inputs are too many")
    return force, covector


def pushes(data, basis, p, t, found, G, zeta, u):
    """What acts beside the potential: forces (M,) and a covector (d,)."""
    v = found.moved(G @ np.tensordot(zeta, basis, 1))
    none = 0, np.zeros(len(basis))
    force, covector = none if u is None else inputs(data, basis, p, found, G, u)
    more = stated(data, basis, p, t, found, G, zeta, u)
    return force + damping(data, p, t, found, v) + more[0], covector + more[1]


def rhs(data, basis, p, t, x, u=None):
    """dx/dt in the state ``x``; numpy.linalg.LinAlgError where it is not determined."""
    found = places(data, p)
    G, zeta = split(data, x, len(basis))
    Z = np.tensordot(zeta, basis, 1)
    design = np.column_stack([found.moved(G @ E) for E in np.asarray(basis, float)])
    force, covector = pushes(data, basis, p, t, found, G, zeta, u)
    force = force + forces(data, p, t, found, found.moved(G))
    heavy, root = found.masses > 0, np.sqrt(found.masses[found.masses > 0])
    Q, R = np.linalg.qr(root[:, None] * design[heavy])
    if np.linalg.cond(R) > 1e13:
        raise np.linalg.LinAlgError("the points do not determine the acceleration")
    target = force[heavy] / root - root * found.moved(G @ Z @ Z)[heavy]
    covector = covector + design[~heavy].T @ force[~heavy]
    return join(data, G @ Z, np.linalg.solve(R, Q.T @ target + np.linalg.solve(R.T, covector)))


def energy(data, basis, p, t, x):
    """Kinetic and potential energy; analytic, for a complex state or time as well."""
    found = places(data, p)
    G, zeta = split(data, x, len(basis))
    v = found.moved(G @ np.tensordot(zeta, basis, 1))
    return found.masses @ v**2 / 2 + potential(data, p, t, found, found.moved(G)[:, None])[0]


def expm(Z):
    """The exponential of a matrix, by its Taylor series and squaring."""
    halvings = int(np.ceil(np.log2(1 + np.linalg.norm(Z)))) + 1
    total = np.eye(len(Z))
    for k in range(20, 0, -1):
        total = np.eye(len(Z)) + Z @ total / (k * 2**halvings)
    return np.linalg.matrix_power(total, 2**halvings)


def random_state(data, basis, rng):
    """A random group element, a product of exponentials, and normally distributed zeta (d,)."""
    G = np.eye(len(basis[0]))
    for _ in range(3):
        Z = np.tensordot(rng.normal(size=len(basis)), basis, 1)
        G = G @ expm(0.8 * Z / max(1, np.linalg.norm(Z, 2)))
    return join(data, G, rng.normal(size=len(basis)))
