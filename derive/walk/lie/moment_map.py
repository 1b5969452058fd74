"""The other momentum: Π carried by g to the other side, the moment map; its rate, and the energy's.

On the left, Z = g⁻¹ġ stays when g becomes hg, and δg = ηg has ϖ(δy) = ⟨Π, A⁻¹ηA⟩ = ⟨Π_o, η⟩; on the
right g becomes gh, and ⟨Π_o, η⟩ = ⟨Π, AηA⁻¹⟩.  Along the motion the coadjoint term cancels:

    ⟨Π̇_o, η⟩ = ⟨Φ, A⁻¹ηA⟩,  ḣ = −∂ₜL̃.

Makes the step ``moment_map`` of the chapters ``left`` and ``right``.
"""

from __future__ import annotations

from ...algebra import forms
from ...algebra.calculus import derivation, reduce, substitute, substitute_trace
from ...algebra.forms import Trivialisation
from ...algebra.word_trees import WordNotation, tree_of
from ...algebra.words import Expr, Letter, inner, word
from ...language.read import read
from ...language.tree import Tree
from ...record.record import Equation, Step
from ..alphabet import Alphabet
from ..chapter import Chapter
from ..inverse import cancelling, inverse_letter, inverse_tree
from ..wording import say


def moment_map(balance: Expr, a: Alphabet, moved: Trivialisation, c: Chapter) -> Step:
    """Π_o, its rate and that of the energy.

    ``balance``: ⟨Π̇ − Φ, ξ′⟩ − ε⟨Π, [Z, ξ′]⟩, which vanishes on the motion for every ξ′.
    """
    draft = c.draft("moment_map", "conservation")
    A, any_of = word(a.A.position), (a.Z.xi_prime.name,)
    back, along = word(inverse_letter(a.A.position)), moved(A, word(a.Z.velocity))
    on_left, xi_prime = moved is forms.left, word(a.Z.xi_prime)
    carried = back * xi_prime * A if on_left else A * xi_prime * back
    images = {
        **{a.A.position: along, inverse_letter(a.A.position): -(back * along * back)},
        **{a.Pi.momentum: word(a.Pi.rate), a.Z.velocity: word(a.Z.acceleration)},
    }
    lagrangian, momenta = Letter("L̃"), c.label("momenta")
    varied = inner(word(a.Pi.momentum), word(a.Z.acceleration)) + word(Letter("∂ₜL̃"))
    images[lagrangian] = varied + inner(word(a.Pi.force), word(a.Z.velocity))

    def rate(e: Expr, along: Expr) -> Expr:
        """The rate of a scalar, less the balance on ``along``, which is 0."""
        less = derivation(e, images.get) - substitute(balance, {a.Z.xi_prime: along})
        return reduce(less, cancelling(a.A.position)).of(balance)

    momentum = inner(word(a.Pi.momentum).marked(momenta), carried)
    energy = inner(word(a.Pi.momentum), word(a.Z.velocity)) - word(lagrangian)
    whole = Letter("A⁻¹ξ′A", a.n, a.n)
    display = {inverse_letter(a.A.position): inverse_tree(a.A.position)}
    notation = WordNotation(
        display={whole: tree_of(carried, WordNotation(display=display))},
        covectors=frozenset(a.Pi.letters),
    )

    def paired(e: Expr, covector: Letter) -> Tree:
        """The tree of ⟨P, A⁻¹ξ′A⟩."""
        by_letter = (inner(word(covector), x) for x in (carried, word(whole)))
        return draft.tree(substitute_trace(e, *by_letter).of(e), notation)

    moving = rate(momentum, carried)
    equations = [
        Equation(read("⟨Π_o, ξ′⟩"), paired(momentum, a.Pi.momentum), any_of),
        Equation(read("⟨Π̇_o, ξ′⟩"), paired(moving, a.Pi.force), any_of),
        Equation("ḣ", draft.tree(rate(energy.marked(c.label("energy")), word(a.Z.velocity)))),
    ]
    return draft.step(equations, say(f"moment_map.{'left' if on_left else 'right'}"))
