"""An energy of the volume: U_V, a function of V_A = det A, and p_V = −V_A dU_V/dV_A.

By Jacobi's formula, δ log det A = Tr A⁻¹δA, and −dŨ(Aξ′) = p_V Tr ξ′.
"""

from __future__ import annotations

from ...algebra.words import Letter, trace, word
from ...language.derivatives import derivative, product
from ...language.tree import Tree, add, replaced
from ...problem.problem import Problem
from ...record.record import Equation
from ...schema.potential_kinds import Volume
from ...schema.table import DETERMINANT
from ..chapter import say
from ..given.potentials import FunctionLetter, Words
from ..spine.alphabet import Alphabet, cancelling, inverse_letter

KIND = Volume
V, U, P = "V_A", Letter("U_V"), Letter("p_V")


def words(problem: Problem, a: Alphabet, *, vectors: bool) -> Words | None:
    """Energies of the volume on words, U_V; ``None`` without any."""
    del vectors
    given = [p.U for p in problem.potentials if isinstance(p, Volume)]
    if not given:
        return None
    energy: Tree = add(*(replaced(x, DETERMINANT, V) for x in given))
    A = a.A.position
    logarithm = trace(word(inverse_letter(A)) * word(A))  # δ log det A, where A⁻¹ stays
    return Words(
        word(U),
        [
            Equation(V, DETERMINANT),
            Equation(U.name, energy),
            Equation(P.name, product(-1, V, derivative(energy, V))),
        ],
        [replaced(x, DETERMINANT, V) for x in given],
        say("potential.volume"),
        own=[FunctionLetter(U, logarithm, slope=-word(P), rules=(cancelling(A),))],
    )
