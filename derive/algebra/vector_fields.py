"""Vector fields as vectors: letters ∇_c for the derivative of fields along a field c.

∇_c is linear in c.  On fields c that are divergence-free and tangent to the boundary it is skew,
by Stokes' theorem: ⟨∇_c a, b⟩ + ⟨a, ∇_c b⟩ is the integral of the divergence of ⟨a, b⟩c.
"""

from __future__ import annotations

from collections.abc import Mapping

from .words import Expr, Letter, Terms


def along(field: Letter) -> Letter:
    """The operator ∇_c of a letter c for a field that is divergence-free and tangent to the
    boundary."""
    return Letter(f"∇_{field.name}", field.rows, field.rows, symmetry=-1, along=field)


def derivative_along(field: Expr) -> Expr:
    """∇_c of a sum c of scalar multiples of letters; ``ValueError`` for another expression."""
    terms: Terms = {}
    for (traces, w), coefficient in field.terms.items():
        if len(w) != 1 or w[0][1]:
            raise ValueError("∇ is linear in letters of fields alone")
        terms[traces, ((along(w[0][0]), False),)] = coefficient
    return Expr(field.rows, field.rows, terms, field.lineage)


def with_derivatives(images: Mapping[Letter, Expr]) -> dict[Letter, Expr]:
    """Images of letters for fields, and with them those of the operators along these."""
    return {**images, **{along(x): derivative_along(e) for x, e in images.items()}}
