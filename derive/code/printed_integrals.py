"""Integrals over an ellipsoid in the code: Carlson's duplication, and the fields of their
templates.

The last term of Ψ, and the way back from it to derivatives.  With P(u) = u³ + I₁u² + I₂u + I₃ and
its roots −x, −y, −z, Ψ = 2 R_F(x, y, z) is invariant under (x, y, z) ↦ ¼(x + λ, y + λ, z + λ), λ =
√xy + √yz + √zx.  On I₁, I₂ and s = √I₃ = √xyz that is

    (I₁ + 3λ)/4,    (I₂ + 2λI₁ + 3λ²)/16,    (eλ − s)/8,    e² = I₁ + 2λ,    λ² = I₂ + 2es,

e = √x + √y + √z, without roots.  The derivatives, first and second, go back by the chain rule.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from math import factorial, prod
from typing import Any

from ..routines import PRINTERS, printer_of, text_of
from ..routines.printer import Printer
from ..routines.source import Type
from .ellipsoid import BUNDLES, SLOPES
from .graph import Graph, Node
from .languages import Statements, TargetLanguage
from .naming import ClaimedNames
from .program import EmittedFunction
from .schedule import Directional, Scheduler

DUPLICATIONS, NEWTON_STEPS, ORDER = 6, 3, 11
"""What leaves an error below the rounding of doubles for semi-axes of ratios up to 1e8; of the
order of the series, a derivative by z takes three, which it has more."""
SMALL_Y, CONVERGED = Fraction(1, 5000), Fraction(1, 10**16)
"""Where a step can be the last: |y| of the series, and the square of a relative change in Newton's
method, whose next change is below rounding."""
AXES = range(3)
"""I₁, I₂ and s = √I₃."""

Terms = dict[tuple[int, int], Fraction]
"""A polynomial in y and z: exponents → coefficient."""


def series(order: int) -> Terms:
    """Ψ √μ / 2 = Σ (−1)^i (½)_{i+j} y^i z^j / (i! j! (4i + 6j + 1)), for μ = I₁/3 and the
    elementary symmetric functions y, z of 1 − x/μ, …, which are of the orders two and three."""
    return {
        (i, j): (-1) ** i
        * prod(Fraction(2 * k + 1, 2) for k in range(i + j))
        / (factorial(i) * factorial(j) * (4 * i + 6 * j + 1))
        for i in range(order // 2 + 1)
        for j in range((order - 2 * i) // 3 + 1)
    }


def by_y(terms: Terms) -> Terms:
    """The derivative of a polynomial by y."""
    return {(i - 1, j): i * c for (i, j), c in terms.items() if i}


def by_z(terms: Terms) -> Terms:
    """The derivative of a polynomial by z."""
    return {(i, j - 1): j * c for (i, j), c in terms.items() if j}


READ = (
    *("first", "second", "product", "mean", "ratio", "y", "z", "e", "pairs", "value"),
    *(f"g_{i}" for i in range(1, 4)),
    *(f"h_{i}{j}" for i in range(1, 4) for j in range(i, 4)),
)
"""What the loop has names for: I₁, I₂, √I₃; μ, I₂/μ², y, z; e and λ; Ψ, and its derivatives."""

Seeds = dict[Node, Node]
"""Node → its derivative by one of I₁, I₂, s."""


@dataclass(frozen=True)
class Duplication:
    """What the function that gives the integrals has besides its loop; ``second``: are they those
    with P^(−5/2), by second derivatives, and not Ψ and those with P^(−3/2)?"""

    second: bool
    g: Graph = field(default_factory=Graph)

    def functions(self) -> dict[str, EmittedFunction]:
        """``end``: Ψ and its derivatives by the series; ``back``: the derivatives before a step by
        those after it; ``whole``: the integrals."""
        names = ClaimedNames()
        leaves = {self._leaf(x): (names.claim(x, x), ("x", 0)) for x in READ}
        roots = {"end": self.end(), "back": self.back(), "whole": self.integrals()}
        scheduler = Scheduler(names, {})
        return {x: scheduler.function(found, leaves) for x, found in roots.items()}

    def end(self) -> list[Node]:
        """Ψ and its derivatives where the series is its value."""
        g = self.g
        mean, ratio, y, z, s = map(self._leaf, ("mean", "ratio", "y", "z", "product"))
        inverse, terms = g.value(g.recip(mean), "inverse"), series(ORDER + 3 * self.second)
        square, part = g.value(inverse**2, "square"), g.value(s * inverse**2, "part")
        scale = g.value(2 * g.recip(g.function("sqrt", mean)), "scale")
        along: list[Seeds] = []
        for i in AXES:
            of_mean, of_s = Fraction(int(i == 0), 3), int(i == 2)
            of_square = -2 * of_mean * square * inverse
            of_ratio = int(i == 1) * square - 2 * of_mean * ratio * inverse
            of_z = of_ratio - 2 * of_s * part * inverse + 3 * of_mean * part**2
            of_part = of_s * square - 2 * of_mean * part * inverse
            own = {s: g.num(of_s), mean: g.num(of_mean), inverse: -of_mean * square}
            own |= {square: of_square, part: of_part, scale: -of_mean / 2 * scale * inverse}
            along.append(own | {ratio: of_ratio, y: of_ratio, z: of_z})
        by, polynomials = (("y", by_y, y), ("z", by_z, z)), {"": terms}
        if self.second:
            polynomials |= {name: slope(terms) for name, slope, _ in by}
        for own in along:
            for k, x in polynomials.items():
                slopes = (self._polynomial(k + name, slope(x)) * own[v] for name, slope, v in by)
                own[self._polynomial(k, x)] = g.sum(slopes)
        value = scale * self._polynomial("", terms)
        gradient = [g.value(self._by(x, value), f"along_{i}") for i, x in enumerate(along, 1)]
        return [value, *gradient, *self._hessian(gradient, along)]

    def back(self) -> list[Node]:
        """The derivatives of Ψ in I₁, I₂, s by those in the next I₁, I₂, s."""
        g = self.g
        a, b, s, e, pairs = map(self._leaf, ("first", "second", "product", "e", "pairs"))
        over = g.value(g.recip(2 * (e * pairs - s)), "over")
        roots = {e: (pairs, g.num(1), 2 * e), pairs: (s, e, 2 * e * e)}
        after = (
            Fraction(1, 4) * (a + 3 * pairs),
            Fraction(1, 16) * (b + 2 * pairs * a + 3 * pairs * pairs),
            Fraction(1, 8) * (e * pairs - s),
        )
        along: list[Seeds] = [
            {x: g.num(1)}
            | {y: g.value(over * z[i], f"{y.data[1]}_{i + 1}") for y, z in roots.items()}
            for i, x in enumerate((a, b, s))
        ]
        slopes = self._slopes()
        whole = Node.dot(slopes, after)
        by = {x: g.value(self._by({x: g.num(1)}, whole), f"by_{x.data[1]}") for x in roots}
        gradient = [
            self._by({x: g.num(1)}, whole) + g.sum(by[y] * own[y] for y in roots)
            for x, own in zip((a, b, s), along, strict=True)
        ]
        if self.second:
            for i, own in enumerate(along, 1):
                moved = [g.value(self._by(own, x), f"after_{k}{i}") for k, x in enumerate(after, 1)]
                for k, x in enumerate(slopes):
                    slope = Node.dot((self._second(k, j) for j in AXES), moved)
                    own[x] = g.value(slope, f"g_{k + 1}_by_{i}")
        return [*gradient, *self._hessian(gradient, along)]

    def integrals(self) -> list[Node]:
        """Ψ, Ψ_0, Ψ_1, Ψ_2; or ∫ u^k P^(−5/2) du for k = 0, …, 4: ∂²Ψ/∂I_i∂I_j is ¾ of it for
        k = 6 − i − j."""
        g, (one, two, three) = self.g, self._slopes()
        back = g.value(g.recip(self._leaf("product")), "over_product")
        if not self.second:
            return [self._leaf("value"), -three * back, -2 * two, -2 * one]
        h = [[self._second(i, j) for j in AXES] for i in AXES]
        last = (h[2][2] - three * back) * back * back
        found = last, 2 * h[1][2] * back, 4 * h[1][1], 4 * h[0][1], 4 * h[0][0]
        return [Fraction(1, 3) * x for x in found]

    # -- nodes -----------------------------------------------------------------------------------

    def _leaf(self, name: str) -> Node:
        return self.g.leaf(name, "state")

    def _slopes(self) -> list[Node]:
        return [self._leaf(f"g_{i + 1}") for i in AXES]

    def _second(self, i: int, j: int) -> Node:
        return self._leaf(f"h_{min(i, j) + 1}{max(i, j) + 1}")

    def _by(self, seeds: Seeds, x: Node) -> Node:
        return Directional(self.g, seeds, "").of(x)

    def _hessian(self, gradient: list[Node], along: list[Seeds]) -> list[Node]:
        """The second derivatives, where they are asked for."""
        pairs = [(i, j) for i in AXES for j in AXES[i:]] if self.second else []
        return [self._by(along[j], gradient[i]) for i, j in pairs]

    def _polynomial(self, by: str, terms: Terms) -> Node:
        """The series, or a derivative of it, by nested products, in y inside."""
        y, z = self._leaf("y"), self._leaf("z")

        def nested(x: Node, coefficients: list[Node]) -> Node:
            *lower, total = coefficients
            for c in reversed(lower):
                total = c + x * total
            return total

        most = max(j for _, j in terms)
        rows = [[self.g.num(terms[k]) for k in sorted(terms) if k[1] == j] for j in range(most + 1)]
        return self.g.value(
            nested(z, [nested(y, row) for row in rows]), f"by_{by}" if by else "series"
        )


REAL = Type("real")


def integrals(
    written: Statements, language: TargetLanguage, prefix: str, called: Sequence[str]
) -> dict[str, Any] | None:
    """The template fields of these functions; ``None`` without any."""
    if not called:
        return None
    found: list[dict[str, Any]] = []
    for name in called:
        d = Duplication(second=name == SLOPES)
        parts: dict[str, Any] = {x: written.part(f) for x, f in d.functions().items()}
        carried = READ[10:] if d.second else READ[10:13]  # the derivatives that go back
        parts |= {"name": name, "of": BUNDLES[name], "second": d.second, "carried": carried}
        if language.name in PRINTERS:
            parts |= _printed(parts, language, prefix, written.real)
        found.append(parts)
    most = max(len(f["whole"]["outputs"]) for f in found)
    return {
        "duplications": DUPLICATIONS,
        "newton": NEWTON_STEPS,
        "most": most,
        "functions": found,
    }


def _printed(
    f: Mapping[str, Any], language: TargetLanguage, prefix: str, real: str
) -> dict[str, Any]:
    """What stands before a function, and its body."""
    lines: dict[str, list[str]] = {}
    given = {
        "DUPLICATIONS": DUPLICATIONS,
        "NEWTON_STEPS": NEWTON_STEPS,
        "SMALL_Y": float(-SMALL_Y),
        "CONVERGED": float(CONVERGED),
        "written": lines,
    }
    text = text_of("carlson").replace("METHOD", f["name"])
    printer = printer_of(language.name, [text], given, prefix, language.reals[real])
    lines |= {part: [*_lines(f, part, printer)] for part in ("end", "back", "whole")}
    body = printer.body(printer.source.routines[f["name"]])
    return {"before": printer.before, "body": "\n".join(body)}


def _lines(f: Mapping[str, Any], part: str, printer: Printer) -> Iterator[str]:
    """The statements of a part, and what is kept of what it computes."""
    yield from f[part]["statements"]
    outputs = f[part]["outputs"]
    if part == "end":
        value, *slopes = outputs
        if not f["second"]:
            yield printer.declared("value", REAL, value) + printer.end
        for name, x in zip(f["carried"], slopes, strict=True):
            yield printer.declared(name, Type("real", (), True), x) + printer.end
    elif part == "back":
        for name, x in zip(f["carried"], outputs, strict=True):
            yield printer.declared(f"next_{name}", REAL, x) + printer.end
        for name in f["carried"]:
            yield f"{name} = next_{name}{printer.end}"
