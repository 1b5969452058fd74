"""Two entries of one Lagrangian meet: that of the points of a problem, typed as an expression in
the entries of g and the coordinates of Z, gives the numbers of the problem."""

import re
import tomllib
from itertools import permutations

import numpy as np
import pytest

from derive.language.values import approximate
from derive.problem.fields import state_names
from derive.problem.toml import problem_of
from tests.oracles import general, relative_error
from tests.problems import READY
from tests.support.library import module_of
from tests.support.walks import NAMES, OTHERS, problem, record

TYPED = [x for x in (*NAMES, *OTHERS) if problem(x).body and not problem(x).damping]
TYPED.remove("riemann_ellipsoid")
"""What acts on these are weights, springs, attraction and an energy of the volume."""


class Words:
    """Expressions of a problem as text, its parameters by their defaults."""

    def __init__(self, p, size):
        self.p, self.size = p, size
        self.values = {x: y.default or 0.0 for x, y in p.parameters.items()}
        if p.group.affine:
            from derive.algebra.families import on_homogeneous

            group = on_homogeneous(p.group)
        else:
            group = p.group
        self.group = group.in_user_basis
        self.names = {(t[2], t[3]): x for x, t in state_names(self.group).items() if len(t) == 4}

    def number(self, t):
        return float(approximate(t, self.values))

    def element(self, i, j):
        """An entry of g, from 0: a name, or the number that stands there."""
        return self.names.get((i + 1, j + 1), "1" if i == j else "0")

    def row(self, entries):
        return " + ".join(f"({float(x)!r})*{y}" for x, y in entries if x and y != "0") or "0"

    def velocity(self, i, j):
        """An entry of gZ."""
        terms = []
        for k in range(self.size):
            z = self.row((float(e[k][j]), f"zeta_{a}") for a, e in enumerate(self.group.basis, 1))
            if z != "0" and self.element(i, k) != "0":
                terms.append(f"{self.element(i, k)}*({z})")
        return " + ".join(terms) or "0"

    def place(self, r, i):
        return self.row((x, self.element(i, j)) for j, x in enumerate(r))


def moments(p, words):
    """The matrix of moments on (r, 1), or on the blocks of a product."""
    J = np.zeros((words.size, words.size))
    for m, r in points(p, words):
        J += m * np.outer(r, r)
    if p.points and len(p.points) and type(p.body).__name__ == "PointBody":
        return J
    given = p.body.moments()
    n = len(given.c)
    J = np.zeros((words.size, words.size))
    J[:n, :n] = [[words.number(x) for x in row] for row in given.J]
    if words.size > n:
        c = [words.number(x) for x in given.c]
        J[:n, n], J[n, :n], J[n, n] = c, c, words.number(given.m)
    return J


def points(p, words):
    found = []
    for x in (*p.points, *p.places):
        at = [words.number(t) for t in x.at]
        inside = words.group.in_block(x.block, at, 1) if words.group.factors else at
        found.append((words.number(x.mass) if hasattr(x, "mass") else 0.0, np.array(inside)))
    return found


def potential(x, p, words):
    """U of one potential as text."""
    listed = points(p, words)
    span = range(words.size)

    def square(parts):
        return " + ".join(f"({y})^2" for y in parts)

    if x.kind == "gravity":
        g = [words.number(t) for t in x.g]
        J = moments(p, words)
        if words.group.factors and not p.group.affine:
            terms = [
                f"-({float(m)!r})*({words.place(r, first + i)})*({float(y)!r})"
                for m, r in listed
                for first, factor in words.group.places
                if any(r[first : first + factor.size])
                for i, y in enumerate(g)
                if y
            ]
            return " + ".join(terms)
        c = J[:, -1] if p.group.affine else first_moment(p, words)
        return " + ".join(f"-({float(y)!r})*({words.place(c, i)})" for i, y in enumerate(g) if y)
    if x.kind == "attraction":
        mu = words.number(x.strength)
        n = p.group.n
        return " + ".join(
            f"-({float(m * mu)!r})/sqrt({square(words.place(r, i) for i in range(n))})"
            for m, r in listed
        )
    if x.kind == "volume":
        return of_volume(p, words)
    k, length = words.number(x.stiffness), words.number(x.length)
    if x.between:
        (_, a), (_, b) = (listed[i - 1] for i in x.between)
        rows = [words.place(a - b, i) for i in span]
        if words.group.factors and not p.group.affine:
            rows = across(words, x, a, b)
    else:
        _, a = listed[x.on - 1]
        anchor = [words.number(t) for t in x.anchor]
        rows = [f"{words.place(a, i)} - ({float(y)!r})" for i, y in enumerate(anchor)]
    rows = [y for y in rows if y != "0"]
    if not length:
        return f"({float(k)!r})*({square(rows)})/2"
    return f"({float(k)!r})*(sqrt({square(rows)}) - ({float(length)!r}))^2/2"


def of_volume(p, words):
    """The energy of the volume as the file has it, by the entries of g and the defaults."""
    data = tomllib.loads((READY / f"{p.name}.toml").read_text(encoding="utf-8"))
    (U,) = (x["U"] for x in data["potential"] if x["kind"] == "volume")
    terms = []
    for order in permutations(range(p.group.n)):
        sign = round(np.linalg.det(np.eye(p.group.n)[list(order)]))
        terms.append("*".join([f"({sign})", *(words.element(i, j) for i, j in enumerate(order))]))
    known = {x: repr(y) for x, y in words.values.items()} | {"det_A": f"({' + '.join(terms)})"}
    return re.sub(r"[A-Za-z_]\w*", lambda name: known.get(name[0], name[0]), U)


def across(words, x, a, b):
    """Differences of two places in different blocks."""
    (i, f), (j, _) = (words.group.places[words.p.block(k) - 1] for k in x.between)
    return [f"{words.place(a, i + k)} - ({words.place(b, j + k)})" for k in range(f.n)]


def first_moment(p, words):
    listed = points(p, words)
    if type(p.body).__name__ == "PointBody":
        return sum(m * r for m, r in listed)
    return np.array([words.number(x) for x in p.body.moments().c])


def typed(p):
    """The data of the file with the same Lagrangian as an expression."""
    size = p.group.n + p.group.affine
    words = Words(p, size)
    J, kinetic = moments(p, words), []
    for i in range(size):
        speeds = [words.velocity(i, j) for j in range(size)]
        for j in range(size):
            for k in range(j, size):
                weight = J[j, k] * (0.5 if j == k else 1)
                if weight and speeds[j] != "0" != speeds[k]:
                    kinetic.append(f"({float(weight)!r})*({speeds[j]})*({speeds[k]})")
    text = " + ".join(kinetic)
    for x in p.potentials:
        text += f" - ({potential(x, p, words)})"
    group = p.group.name
    if group == "Screw":
        rows = [[[str(x) for x in row] for row in e] for e in p.group.in_user_basis.basis]
        group = {"name": group, "action": "affine", "basis": rows}
    return {"name": "typed", "group": group, "lagrangian": {"L": text}}


def stated(data):
    """The problem of a record as a file has it: a group of one's own is a table."""
    if "(" in data["group"]:
        return data
    return data | {"group": {"basis": data["basis"], "action": "affine"}}


@pytest.mark.parametrize("name", TYPED)
def test_the_numbers_are_the_same(name):
    p, d = problem(name), record(name)
    own, other = module_of(name), module_of(problem_of(typed(p)))
    k, rng = own.constants(own.DEFAULTS), np.random.default_rng(4)
    assert (
        own.STATE[: len(other.STATE) - len(own.BASIS)]
        == other.STATE[: len(other.STATE) - len(own.BASIS)]
    )
    for _ in range(2):
        x = general.random_state(stated(d.problem), np.array(own.BASIS, float), rng)
        found = other.rhs(0.0, x, other.constants([]))
        u = np.zeros(len(own.INPUTS)) if own.INPUTS else None
        expected = own.rhs(0.0, x, k, u)
        assert relative_error(found, expected) < 1e-13
        energy = own.energy(0.0, x, k)
        assert other.energy(0.0, x, other.constants([])) == pytest.approx(energy, rel=1e-12)
