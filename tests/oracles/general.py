"""Gauss's principle of least constraint for any problem file, from the plain data that TOML gives.

The points move with accelerations ``a_i = G (dZ/dt + Z^2) r_i``, Z = G^-1 dG/dt in the algebra.
Among all dZ/dt the true one makes ``sum m_i |a_i - F_i / m_i|^2 - 2 <u, dzeta/dt>`` least.  F is
-grad U, by complex steps, with damping and force inputs; u is the covector of the inputs.

Sizes: d coordinates zeta, matrices s x s, M coordinates of all places together.  A place is where a
force may act: a point, or a massless point to which a spring or an input is attached.  ``basis`` is
(d, s, s); ``p`` maps parameters to numbers; a state is the group element (A row-major, then T where
the group translates, factor after factor) and then zeta.
"""

import re
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

STEP = 1e-30
AFFINE, DOUBLED = ("SE", "SAff", "Aff", "Sim"), ("U", "SU")
FAMILIES = ("SO", "SL", "GL", "Sp", "UT", *AFFINE, *DOUBLED)
TOKEN = re.compile(r"\s*(?:(\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?)|([A-Za-z]\w*)|(\S))")
SUMS, PRODUCTS = {"+": np.add, "-": np.subtract}, {"*": np.multiply, "/": np.divide}
FUNCTIONS = {x: getattr(np, x) for x in "sqrt sin cos tan exp log sinh cosh tanh".split()}
FUNCTIONS["atan"] = np.arctan


class _Parser:
    """Recursive descent; every rule returns a function of the environment."""

    def __init__(self, text):
        self.tokens = [number or name or other for number, name, other in TOKEN.findall(text)]

    def whole(self):
        value = self.chain(SUMS)
        if self.tokens:
            raise ValueError(f"unexpected {self.tokens[0]!r}")
        return value

    def take(self, *wanted):
        """The next token; if any are wanted, only one of these, else None."""
        if wanted and (not self.tokens or self.tokens[0] not in wanted):
            return None
        return self.tokens.pop(0) if self.tokens else ""

    def chain(self, operators):
        """``a + b - c``, or ``a * b / c``, from the left."""
        part = self.signed if operators is PRODUCTS else lambda: self.chain(PRODUCTS)
        first, rest = part(), []
        while operator := self.take(*operators):
            rest.append((operators[operator], part()))

        def value(env):
            total = first(env)
            for operation, other in rest:
                total = operation(total, other(env))
            return total

        return value

    def signed(self):
        if sign := self.take("+", "-"):
            inside = self.signed()
            return inside if sign == "+" else lambda env: -inside(env)
        base = self.atom()
        if not self.take("^"):
            return base
        exponent = self.signed()
        return lambda env: np.power(base(env), exponent(env))

    def atom(self):
        token = self.take()
        if token[:1].isdigit() or token[:1] == ".":
            return lambda env: np.float64(token)
        if not (token == "(" or token[:1].isalpha()):
            raise ValueError(f"unexpected {token!r}")
        if token != "(" and not self.take("("):
            return lambda env: np.multiply(np.pi if token == "pi" else env[token], 1.0)
        inside = self.chain(SUMS)
        if not self.take(")") or (token != "(" and token not in FUNCTIONS):
            raise ValueError(f"{token!r}: not a function, or not closed")
        return inside if token == "(" else lambda env: FUNCTIONS[token](inside(env))


@lru_cache(maxsize=4096)
def parse(text):
    """The function of an environment {name: number or array} that the expression is."""
    return _Parser(text).whole()


def evaluate(value, env):
    """A number, or an expression in the names of ``env``, at real or complex numbers or arrays."""
    return parse(value)(env) if isinstance(value, str) else np.float64(value)


def _vector(values, n, env):
    """The column (n, 1) of n expressions."""
    if len(values) != n:
        raise ValueError(f"{len(values)} entries instead of {n}")
    return np.array([[evaluate(value, env)] for value in values])


@dataclass(frozen=True)
class Block:
    """The rows of one factor: it moves R^n, from row ``first`` on, and may translate."""

    first: int
    n: int
    affine: bool

    @property
    def rows(self):
        return slice(self.first, self.first + self.n)

    @property
    def last(self):
        """The row of the ones of an affine factor, which is also the end of the linear part."""
        return self.first + self.n


@dataclass(frozen=True)
class Place:
    """A point or a massless place: ``r`` (s,) is what G moves; ``key`` says whose it is."""

    key: tuple
    block: Block
    mass: float
    r: np.ndarray


def blocks(data):
    """The factors of the group, as :class:`Block`."""
    group = data["group"]
    if isinstance(group, dict):
        affine = group.get("action", "linear") == "affine"
        return [Block(0, len(group["basis"][0]) - affine, affine)]
    found, first = [], 0
    for part in re.split(r"\s*[x×]\s*", group.strip()):
        match = re.fullmatch(r"(\w+)\(\s*(\d+)\s*\)", part)
        if not match or match[1] not in FAMILIES:
            raise ValueError(f"unknown group {part!r}")
        n, affine = int(match[2]) * (2 if match[1] in DOUBLED else 1), match[1] in AFFINE
        found.append(Block(first, n, affine))
        first += n + affine
    return found


def parameters(data):
    """The defaults of the parameters that have one."""
    given = data.get("parameters", {}).items()
    values = {name: x.get("default") if isinstance(x, dict) else x for name, x in given}
    return {name: float(x) for name, x in values.items() if x is not None}


def split(data, x, d):
    """A state as G (s, s) and zeta (d,); complex where x is."""
    x, parts, at = np.asarray(x), blocks(data), 0
    G = np.zeros((parts[-1].last + parts[-1].affine,) * 2, np.result_type(x, float))
    for b in parts:
        G[b.rows, b.rows], at = x[at : at + b.n**2].reshape(b.n, b.n), at + b.n**2
        if b.affine:
            G[b.rows, b.last], G[b.last, b.last], at = x[at : at + b.n], 1, at + b.n
    if len(x) != at + d:
        raise ValueError(f"a state of {len(x)} numbers instead of {at + d}")
    return G, x[at:]


def join(data, G, zeta):
    """A state from G (s, s), or its velocity from dG/dt, and zeta (d,)."""
    parts = []
    for b in blocks(data):
        parts.append(G[b.rows, b.rows].ravel())
        if b.affine:
            parts.append(G[b.rows, b.last])
    return np.concatenate([*parts, zeta])


def realised(p, n, affine):
    """Masses (n + 1,) and points (n + 1, n) whose moments are the m, c, J of ``p``.

    The columns of R, where R R^T = [[J, c], [c^T, m]], are sqrt(m_i) (r_i, 1), turned so that the
    masses are equal.  Linear maps do not see m: there it is any number that is large enough.
    """
    H, span = np.zeros((n + 1, n + 1)), range(n)
    H[:n, :n] = [[p[f"J_{min(i, j) + 1}{max(i, j) + 1}"] for j in span] for i in span]
    H[:n, n] = H[n, :n] = [p[f"c_{i + 1}"] if affine else p.get(f"c_{i + 1}", 0) for i in span]
    c, J = H[:n, n], H[:n, :n]
    H[n, n] = p["m"] if affine else 2 * c @ np.linalg.pinv(J) @ c + np.trace(J) / n
    sizes, axes = np.linalg.eigh(H)
    if sizes[0] < -1e-13 * abs(sizes[-1]) or H[n, n] <= 0:
        raise ValueError("no masses have these moments")
    R, root = axes * np.sqrt(np.maximum(sizes, 0)), np.sqrt(H[n, n] / (n + 1))
    mirror = R[n] - root
    if mirror @ mirror > 0:
        R = R - np.outer(R @ mirror, mirror) * (2 / (mirror @ mirror))
    return np.full(n + 1, root**2), (R[:n] / root).T


def _place(data, p, key, table):
    """The place of a [[point]], or of a spring or input with ``at``."""
    parts = blocks(data)
    b = parts[table.get("block", 1) - 1]
    r, mass = np.zeros(parts[-1].last + parts[-1].affine), evaluate(table.get("mass", 0), p)
    r[b.rows] = _vector(table["at"], b.n, p)[:, 0]
    if b.affine:
        r[b.last] = 1
    if not mass >= 0:
        raise ValueError(f"{key}: the mass is {mass}")
    return Place(key, b, mass, r)


def places(data, p):
    """All places: the points, then those to which springs and inputs are attached."""
    if "body" in data:
        b, *others = blocks(data)
        if others:
            raise ValueError("moments of a product are not defined")
        points = [{"mass": m, "at": r} for m, r in zip(*realised(p, b.n, b.affine), strict=True)]
        found = [_place(data, p, ("realised", i), x) for i, x in enumerate(points, 1)]
    else:
        found = [_place(data, p, ("point", i), x) for i, x in enumerate(data["point"], 1)]
    for kind in ("potential", "input"):
        for k, table in enumerate(data.get(kind, ())):
            if "at" in table:
                found.append(_place(data, p, (kind, k), table))
    return found


def positions(data, p, G):
    """The positions (n_k,) of the points, those that realise given moments included."""
    return [(G @ x.r)[x.block.rows] for x in places(data, p) if x.key[0] in ("point", "realised")]


def _stacked(found, matrix):
    """The rows of ``matrix r`` of all places, (M,)."""
    return np.concatenate([(matrix @ x.r)[x.block.rows] for x in found])


def _cut(found, rows):
    """Rows (M, ...) as {key of the place: its rows (n_k, ...)}."""
    ends = np.cumsum([x.block.n for x in found])
    return {x.key: rows[end - x.block.n : end] for x, end in zip(found, ends, strict=True)}


def _own(kind, k, table):
    """The key of the place on which table k of [[potential]] or [[input]] acts."""
    return (kind, k) if "at" in table else ("point", table["on"])


def _points(found):
    """The points that the file lists; refused where only moments are known."""
    if any(x.key[0] == "realised" for x in found):
        raise ValueError("this is not defined by the moments of a body")
    return [x for x in found if x.key[0] == "point"]


def _norm(gap):
    """The norms of the columns (n, B), analytic in complex numbers."""
    return np.sqrt(np.sum(gap * gap, axis=0))


def _gravity(k, table, env, found, q):
    return -sum(x.mass * np.sum(_vector(table["g"], x.block.n, env) * q[x.key], 0) for x in found)


def _spring(k, table, env, found, q):
    if "between" in table:
        one, other = (q["point", i] for i in table["between"])
    else:
        one = q[_own("potential", k, table)]
        other = _vector(table["anchor"], len(one), env)
    if len(one) != len(other):
        raise ValueError("a spring between spaces of two dimensions")
    stretch = _norm(one - other) - evaluate(table.get("length", 0), env)
    return evaluate(table["stiffness"], env) / 2 * stretch**2


def _attraction(k, table, env, found, q):
    total = 0
    for x in _points(found):
        centre = _vector(table.get("centre", [0] * x.block.n), x.block.n, env)
        total = total - x.mass / _norm(q[x.key] - centre)
    return evaluate(table["strength"], env) * total


def _expression(k, table, env, found, q):
    env = dict(env)
    for x in (x for x in found if x.key[0] == "point"):
        for j, row in enumerate(q[x.key]):
            env[f"r{x.key[1]}_{j + 1}"] = row
            if x.block.n <= 3:
                env[f"r{x.key[1]}_{'xyz'[j]}"] = row
    return evaluate(table["U"], env)


TERMS = {
    "gravity": _gravity,
    "spring": _spring,
    "attraction": _attraction,
    "expression": _expression,
}


def potential(data, p, t, found, rows):
    """U (B,) where the places are at the columns of ``rows`` (M, B)."""
    env, q, total = {**p, "t": t}, _cut(found, rows), np.zeros(rows.shape[1], rows.dtype)
    for k, table in enumerate(data.get("potential", ())):
        total = total + TERMS[table["kind"]](k, table, env, found, q)
    return total


def forces(data, p, t, found, rows):
    """-grad U (M,) where the places are at ``rows`` (M,); NaN outside the domain of U."""
    steps = rows[:, None] + 1j * STEP * np.eye(len(rows))
    change = potential(data, p, t, found, steps).imag
    return np.where(np.abs(change) < 1e-12, -change / STEP, np.nan)


def damping(data, p, t, found, v):
    """The forces (M,) of damping at the velocities ``v`` (M,)."""
    force = np.zeros(len(v))
    mine, speed = _cut(found, force), _cut(found, v)
    for table in data.get("damping", ()):
        for i in table.get("on", range(1, len(_points(found)) + 1)):
            mine["point", i] -= evaluate(table["coefficient"], {**p, "t": t}) * speed["point", i]
    return force


def inputs(data, found, d, G, u):
    """What ``u`` (all inputs in order, or None) gives: forces (M,) and a covector (d,)."""
    force, covector, at = np.zeros(sum(x.block.n for x in found)), np.zeros(d), 0
    mine, where = _cut(found, force), {x.key: x.block for x in found}
    for k, table in enumerate(data.get("input", ()) if u is not None else ()):
        if table["kind"] == "covector":
            target, turn, size = covector, np.eye(d), d
        else:
            b = where[key := _own("input", k, table)]
            in_body = table.get("frame", "space") == "body"
            target, turn, size = mine[key], G[b.rows, b.rows] if in_body else np.eye(b.n), b.n
        target += turn @ np.asarray(u[at : at + size], float)
        at += size
    if u is not None and len(u) != at:
        raise ValueError(f"{len(u)} inputs instead of {at}")
    return force, covector


def rhs(data, basis, p, t, x, u=None):
    """dx/dt in the state ``x``; numpy.linalg.LinAlgError where it is not determined."""
    basis, found = np.asarray(basis, float), places(data, p)
    G, zeta = split(data, np.asarray(x, float), len(basis))
    Z = np.tensordot(zeta, basis, 1)
    design = np.column_stack([_stacked(found, G @ E) for E in basis])
    force, covector = inputs(data, found, len(basis), G, u)
    force = force + damping(data, p, t, found, _stacked(found, G @ Z))
    force = force + forces(data, p, t, found, _stacked(found, G))
    masses = np.repeat([x.mass for x in found], [x.block.n for x in found])
    heavy, root = masses > 0, np.sqrt(masses[masses > 0])
    Q, R = np.linalg.qr(root[:, None] * design[heavy])
    if np.linalg.matrix_rank(R) < len(basis):
        raise np.linalg.LinAlgError("the points do not determine the acceleration")
    target = force[heavy] / root - root * _stacked(found, G @ Z @ Z)[heavy]
    covector = covector + design[~heavy].T @ force[~heavy]
    return join(data, G @ Z, np.linalg.solve(R, Q.T @ target + np.linalg.solve(R.T, covector)))


def energy(data, basis, p, t, x):
    """Kinetic and potential energy; analytic, for a complex state or time as well."""
    found = places(data, p)
    G, zeta = split(data, x, len(basis))
    v = _cut(found, _stacked(found, G @ np.tensordot(zeta, basis, 1)))
    kinetic = sum(x.mass * np.sum(v[x.key] ** 2) for x in found) / 2
    return kinetic + potential(data, p, t, found, _stacked(found, G)[:, None])[0]


def expm(Z):
    """The exponential of a matrix, by its Taylor series and squaring."""
    halvings = max(0, int(np.ceil(np.log2(max(np.linalg.norm(Z), 1e-300)))) + 1)
    term = total = np.eye(len(Z))
    for k in range(1, 20):
        term = term @ Z / (k * 2**halvings)
        total = total + term
    return np.linalg.matrix_power(total, 2**halvings)


def random_state(data, basis, rng):
    """A random group element, a product of exponentials, and normally distributed zeta (d,)."""
    G = np.eye(len(basis[0]))
    for _ in range(3):
        Z = np.tensordot(rng.normal(size=len(basis)), basis, 1)
        G = G @ expm(0.8 * Z / max(1, np.linalg.norm(Z, 2)))
    return join(data, G, rng.normal(size=len(basis)))
