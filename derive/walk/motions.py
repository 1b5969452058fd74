"""The motions as a whole: a symplectic manifold (26); curves in the space of all matrices.

dϖ vanishes on the tangent X of a motion, so of a variation it sees only what crosses the motions.
"""

from __future__ import annotations

from ..algebra import forms
from ..algebra.calculus import gradient, substitute, without
from ..algebra.word_trees import PLAIN, metrics, tree_of
from ..algebra.words import Expr, inner, word
from ..record.record import Equation, Step
from .alphabet import Alphabet
from .cartan import Cartan
from .chapter import Chapter
from .exterior import DOMEGA, natural_variations, primed, primes
from .factorisation import at_constant_time, factored_tree
from .kernel import Kernel
from .wording import say


def motions(form: Cartan, law: Kernel, a: Alphabet, c: Chapter) -> Step:
    """The step that writes dϖ by what crosses the motions: there the forces do the work of the
    acceleration."""
    draft = c.draft("motions", "kernel")
    along = {p.dp_position: word(p.d_position) for p in a.parts}
    work = substitute(law.balance, along) + form.work
    derivative = forms.exterior(form.form, primes(a), *natural_variations(work, a))
    images = {}
    for p in a.parts:
        images[p.d_position] = word(p.d_position) - word(p.velocity) * word(a.dt)
        images[p.d_velocity] = word(p.d_velocity) - word(p.acceleration) * word(a.dt)
    images |= {primes(a)[x]: primed(e, a) for x, e in images.items()}
    core = at_constant_time(derivative, a.dt, a.dpt)
    notation = metrics() if a.affine else metrics("J")
    return draft.step(
        (Equation(DOMEGA, factored_tree(draft, derivative, core, images, notation)),),
        say("motions.manifold") + say("motions.complete"),
        (26,),
    )


def held(law: Kernel, C: Expr, n: int, c: Chapter) -> Step:
    """The step about SO(n) in the space of all matrices: what the constraint adds is orthogonal to
    the group."""
    draft, b = c.draft("geodesics", "multiplier"), Alphabet(n, affine=False, skew=True)
    any_matrix, rate = b.freed().Z.xi_prime, b.A.acceleration
    along = {b.A.dp_position: word(b.A.position) * word(any_matrix)}
    added = gradient(substitute(b.respell(law.balance), along), any_matrix).of(C)
    core = {rate: word(rate) - word(b.F_group)}
    left, right = (
        factored_tree(draft, e, without(e, b.F_group), core, PLAIN) for e in (added, added.bar)
    )
    Z, tested = word(b.Z.velocity), word(b.Z.xi_prime)
    seen = inner(tested, word(b.A.position).bar * word(rate))
    carried = inner(tested, Z * Z + word(b.Z.acceleration))
    return draft.step(
        (
            Equation(left, right),
            Equation(tree_of(seen), tree_of(carried)),
        ),
        say("geodesics.held") + say("geodesics.free"),
    )
