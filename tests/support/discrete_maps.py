"""The map (g₀, g₁) ↦ (g₁, g₂) of the discrete motion, from the equations of its record alone, in
any real numbers: floats, or mpmath's.

A record is read top down: what a name is said to be is its value; the last equations of the motion
are solved for g₂ by Newton's method, with differences for derivatives.
"""

from fractions import Fraction

import mpmath

from derive.algebra.groups import Group
from derive.language import rational as q
from derive.language.tree import add, replaced
from derive.language.values import value

SUMMED = {"i": ("m", "r", "κ"), "e": ("s", "k")}


def real(x):
    """A number of mpmath."""
    return mpmath.mpf(x.numerator) / x.denominator if isinstance(x, Fraction) else mpmath.mpf(x)


def solve(a, b):
    """The X with a X = b, by elimination with the largest pivot; a may have more rows than columns,
    of which those that are left then say 0 = 0."""
    rows, width = [[*x, *y] for x, y in zip(a, b, strict=True)], len(a[0])
    for k in range(width):
        pivot = max(range(k, len(rows)), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [x / rows[k][k] for x in rows[k]]
        for i in range(len(rows)):
            if i != k:
                rows[i] = [x - rows[i][k] * y for x, y in zip(rows[i], rows[k], strict=True)]
    return tuple(tuple(row[width:]) for row in rows[:width])


class DiscreteMap:
    """The equations of a record with values for its parameters and h; ``number``: of the ring;
    ``tiny``: the step of differences."""

    def __init__(self, record, group: Group, parameters, h, number, tiny):
        self.record, self.group, self.number, self.tiny = record, group, number, tiny
        self.parameters = {k: number(x) for k, x in parameters.items()}
        self.h, self.n, self.size = number(h), group.n, group.size
        self.counts = {
            x: max((e.lhs[2] for e in self.equations() if self._member(e, of)), default=0)
            for x, of in SUMMED.items()
        }
        damped = {self.flat(e.lhs) for e in self.equations()}
        self.basis = [self.matrix(e) for e in group.basis]
        self.given = {"h": self.h, "𝟏": self.matrix(q.identity(group.n))}
        undamped = (f"κ_{i}" for i in range(1, self.counts["i"] + 1))
        self.given |= {x: number(0) for x in undamped if x not in damped}
        if group.affine:
            one = self.matrix(q.identity(group.size))
            self.given |= {"ι": tuple(r[:-1] for r in one), "o": tuple(r[-1:] for r in one)}

    def matrix(self, x):
        """A matrix in the numbers of the ring."""
        return tuple(tuple(self.number(y) for y in row) for row in x)

    def equations(self):
        """The equations of the record, in order."""
        return (e for step in self.record.steps for e in step.equations)

    @staticmethod
    def _member(e, families):
        member = isinstance(e.lhs, tuple) and e.lhs[0] == "at" and e.lhs[1] in families
        return member and isinstance(e.lhs[2], int)

    def flat(self, t):
        """A tree without sums and families: members are names, and the entries of a column."""
        if not isinstance(t, tuple):
            return t
        if t[0] == "sum" and self.counts.get(t[1]):
            members = range(1, self.counts[t[1]] + 1)
            return self.flat(add(*(replaced(t[2], t[1], k) for k in members)))
        if t == ("one",):
            return "𝟏"
        if t[0] == "at" or (t[0] == "entry" and isinstance(t[1], str) and len(t) == 3):
            return f"{t[1]}_{t[2]}"
        return (t[0], *map(self.flat, t[1:]))

    def of(self, t, names):
        """The value of a tree; ``ValueError`` where it has none."""
        inverses = {}

        def opened(t):
            """The tree with names for inverse matrices."""
            if not isinstance(t, tuple):
                return t
            if t[0] == "inv" and isinstance(x := self.of(t[1], names), tuple):
                name = f"inverse {len(inverses)}"
                inverses[name] = self.inverse(x)
                return name
            return (t[0], *map(opened, t[1:]))

        tree = opened(self.flat(t))
        return value(tree, {**names, **inverses}, self.parameters, number=self.number)

    def inverse(self, x):
        """The inverse of a matrix."""
        return solve(x, self.matrix(q.identity(len(x))))

    def names(self, *elements, **further):
        """The values of all names that the record says, at three elements."""
        found = {**self.given, **{f"g_{k}": g for k, g in enumerate(elements)}, **further}
        while True:  # what is any group's is said before the numbers of the body
            before = len(found)
            for e in self.equations():
                name = self.flat(e.lhs)
                if isinstance(name, str) and name not in found:
                    try:
                        found[name] = self.of(e.rhs, found)
                    except (ValueError, KeyError, TypeError, IndexError):
                        continue
            if len(found) == before:
                return found

    def step(self, label):
        """The step of the problem's own chapter with a label."""
        own = f"{self.record.name}.{label}"
        return next((s for s in self.record.steps if s.label == own), None)

    def residue(self, g_0, g_1, g_2, theta):
        """What the last equations leave: of M₁ (and R₂), of g₂ with θ, or on the basis."""
        names = self.names(g_0, g_1, g_2, θ=theta)
        motion, found = self.step("motion"), []
        if self.step("step"):
            told = [*motion.equations]
            rest = q.minus(self.of(told[0].lhs, names), self.of(told[0].rhs, names))
            found += [rest[i][j] for i in range(self.n) for j in range(i)]
        elif isinstance(motion.equations[-1].lhs, str):
            e = motion.equations[-1]
            found += q.flatten(q.minus(self.of(e.lhs, names), self.of(e.rhs, names)))
        else:
            (e,) = motion.equations
            found += [self.of(e.lhs, {**names, "E_a": E}) for E in self.basis]
        if self.step("translation"):
            (e,) = self.step("translation").equations
            found += q.flatten(q.minus(self.of(e.lhs, names), self.of(e.rhs, names)))
        return found

    @property
    def multiplied(self):
        """Is there a multiplier of the volume?"""
        return self.step("relation") is not None

    def moved(self, g, zeta):
        """g exp(Σ ζ_a E_a), by the series."""
        x = q.combine(zeta, self.basis)
        term = total = self.matrix(q.identity(self.size))
        for k in range(1, 80):
            term = q.scaled(self.number(1) / k, q.times(term, x))
            total = q.plus(total, term)
            if max(map(abs, q.flatten(term))) < self.tiny**3:
                break
        return q.times(g, total)

    def slopes(self, f, at):
        """The derivatives of a list of functions by central differences, a row for each."""
        columns = []
        for k in range(len(at)):
            up, down = ([x + s * self.tiny * (j == k) for j, x in enumerate(at)] for s in (1, -1))
            columns.append([(a - b) / (2 * self.tiny) for a, b in zip(f(up), f(down), strict=True)])
        return q.transposed(tuple(map(tuple, columns)))

    def next(self, g_0, g_1):
        """g₂ and θ by Newton's method from g₁(g₀⁻¹g₁)."""
        g_2 = q.times(g_1, q.times(self.inverse(g_0), g_1))
        theta, d = self.number(0), self.group.dimension
        for _ in range(60):
            here, was = g_2, theta

            def rest(x, here=here, was=was):
                theta = was + x[d] if self.multiplied else was
                return self.residue(g_0, g_1, self.moved(here, x[:d]), theta)

            zero = [self.number(0)] * (d + self.multiplied)
            off = rest(zero)
            x = [y for (y,) in solve(self.slopes(rest, zero), q.column([-y for y in off]))]
            g_2 = self.moved(g_2, x[:d])
            theta = theta + x[d] if self.multiplied else theta
            if max(map(abs, x)) < self.tiny * self.tiny * 100:
                return g_2, theta
        raise AssertionError("Newton's method has not converged")

    def tangent(self, g_0, g_1, g_2, theta):
        """The matrix of the map in coordinates g exp(ζ), 2d × 2d, by the implicit function
        theorem."""
        d, zero = self.group.dimension, self.number(0)

        def rest(x):
            moved = [self.moved(g, x[k * d : (k + 1) * d]) for k, g in enumerate((g_0, g_1, g_2))]
            return self.residue(*moved, theta + x[3 * d] if self.multiplied else theta)

        rows = self.slopes(rest, [zero] * (3 * d + self.multiplied))
        before = tuple(tuple(-x for x in row[: 2 * d]) for row in rows)
        after = solve(tuple(row[2 * d :] for row in rows), before)
        one = [[self.number(i == j) for j in range(d)] for i in range(d)]
        shift = [[*[zero] * d, *row] for row in one]
        return (*map(tuple, shift), *after[:d])

    def form(self, g_0, g_1):
        """The matrix of dΘ⁺ on the displacements gE_a of g₀ and of g₁."""
        step = next(s for s in self.record.steps if s.label.endswith(".exterior"))
        d = self.group.dimension
        nothing = q.scaled(self.number(0), g_0)
        sides = [(q.times(g_0, E), nothing) for E in self.basis]
        sides += [(nothing, q.times(g_1, E)) for E in self.basis]
        names = self.names(g_0, g_1)
        rows = []
        for a in sides:
            first = {f"δg_{k}": x for k, x in enumerate(a)}
            row = []
            for b in sides:
                second = {f"δ′g_{k}": x for k, x in enumerate(b)}
                row.append(self.of(step.equations[0].rhs, {**names, **first, **second}))
            rows.append(tuple(row))
        assert len(rows) == 2 * d
        return tuple(rows)
