"""What the metric of a group of matrices is: left-invariant, independent of C, or Manakov's."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from ...algebra.calculus import gradient, map_traces, substitute, without
from ...algebra.word_trees import WordNotation, tree_of
from ...algebra.words import Expr, Letter, Word, expr_of_word, trace, word
from ...language.tree import Tree, add
from ...problem.inertia import EVERY, Bodies
from ...record.record import Equation, Step, stated
from ...record.sentence import Prose
from ..chapter import Chapter, Draft, say
from ..spine.alphabet import Alphabet
from ..spine.cartan import DOMEGA, Cartan, form_equation, primed, primes, shown_brackets
from ..spine.kernel import MomentumForm, contact, fibre, restrict, restricted_prose
from .coordinates import factored_tree, solve_for

# Where C is not 𝟏, and drops out of the metric nevertheless: Tr ξJZ̄C = Tr ξJZ̄ on 𝔤.
#
# For every body, where ξ̄CZ = ξ̄Z on 𝔤: products of groups with skew linear parts, on (r, 1). Or
# for some: the points of a flat body under a shear. The forces of a potential keep their C.


def without_cauchy_green(e: Expr, bodies: Bodies, a: Alphabet) -> Expr:
    """A scalar with 1 for each C that drops out of the metric: those between a barred letter of 𝔤
    and a plain one."""
    algebra = {x.name for f in a.algebra_parts for x in (f.velocity, f.xi, f.xi_prime)}
    algebra |= {
        x.name for f in a.algebra_parts for x in (f.d_velocity, f.dp_velocity, f.acceleration)
    }

    def drops(cycle: Word, k: int) -> bool:
        before, after = cycle[k - 1], cycle[(k + 1) % len(cycle)]
        between = before[0].name in algebra and before[1]
        between = between and after[0].name in algebra and not after[1]
        return between and (bodies == EVERY or {x.name for x, _ in cycle} - algebra == {"C", "J"})

    def left(cycle: Word) -> Expr:
        kept = tuple(x for k, x in enumerate(cycle) if x[0] != a.C or not drops(cycle, k))
        return trace(expr_of_word(kept))

    return map_traces(e, left)


def metric_equations(bodies: Bodies) -> list[Equation]:
    """The equation by which C drops out of the metric on 𝔤: for every body, or for this one."""
    return stated("ξ̄CZ = ξ̄Z" if bodies == EVERY else "Tr ξJZ̄C = Tr ξJZ̄")


def metric_prose(bodies: Bodies, draft: Draft) -> Prose:
    """The sentence of a step for :func:`metric_equations`."""
    if bodies == EVERY:
        return say("relation.lengths")
    return draft.claim("relation.left_invariant")


# Where the linear parts of 𝔤 are all skew matrices: Euler–Manakov's equations.
#
# On so(n) only the skew part of Π counts, the angular momentum in the body ℓ_b = Π − Π̄:
#
# ℓ̇_b = [ℓ_b, Z] + w p̄_b − p_b w̄ + moments, ṗ_b = −Z p_b + F_b.
#
# In R³ it is ``vectors.euler`` that makes the steps ``momenta`` and ``coadjoint``.


def halved(values: Mapping[Letter, Expr], b: Alphabet) -> dict[Letter, Expr]:
    """The values Π = ½ ℓ_b, δΠ = ½ δℓ_b, δ′Π = ½ δ′ℓ_b, Π̇ = ½ ℓ̇_b, and that of Φ.

    On so(n) ⟨Π, ξ⟩ = ½ Tr ξℓ̄_b, so that a skew ℓ_b says as much as any Π.
    """
    pairs = zip(b.Pi.letters[:4], b.spin.letters[:4], strict=True)
    return {x: Fraction(1, 2) * word(y) for x, y in pairs} | {b.Pi.force: values[b.Pi.force]}


def coadjoint_steps(stage: MomentumForm, b: Alphabet, C: Expr, c: Chapter) -> tuple[Step, ...]:
    """The steps ``momenta`` and ``coadjoint``: ℓ_b (and p_b) and their rates in matrices,
    Euler–Manakov's equations; ``C``: ĀA."""
    stating, moving = c.draft("momenta", "relation"), c.draft("coadjoint", "kernel")
    own = {b.letters()[x.name]: b.respell(e, C).of(C) for x, e in stage.values.items()}
    momentum = own[b.Pi.momentum]
    values = {b.spin.momentum: momentum - momentum.bar}
    if b.affine:
        values[b.p_b.momentum] = own[b.p_b.momentum]
    momenta = stating.step(
        [Equation(x.name, stating.tree(e)) for x, e in values.items()], momenta_prose(b)
    )
    balance = substitute(b.respell(stage.balance), halved(own, b)).of(stating.mark(C))
    rates = {b.spin.rate: word(b.spin.rate) - 2 * gradient(balance, b.Z.xi_prime)}
    if b.affine:
        rates[b.p_b.rate] = word(b.p_b.rate) - gradient(balance, b.w.xi_prime)
    moving.depends_on(*rates.values())
    equations = [Equation(x.name, _commuted(e, b)) for x, e in rates.items()]
    return momenta, moving.step(equations, motion_prose(b))


def _commuted(e: Expr, b: Alphabet) -> Tree:
    """The tree of an expression, with the bracket [ℓ_b, Z] for its two terms ℓ_b Z − Zℓ_b."""
    spin, Z = word(b.spin.momentum), word(b.Z.velocity)
    commutator = spin * Z - Z * spin
    if not {*commutator.terms.items()} <= {*e.terms.items()}:
        return tree_of(e)
    rest = e - commutator
    return add(("bracket", b.spin.momentum.name, b.Z.velocity.name), tree_of(rest))


def momenta_prose(b: Alphabet) -> Prose:
    """The sentence that says what ℓ_b (and p_b) are."""
    if b.affine:
        return say("momenta.affine")
    return say("momenta.linear")


def motion_prose(b: Alphabet) -> Prose:
    """The sentence for the rates of ℓ_b (and p_b): Euler's equations, or Kirchhoff's."""
    if b.affine:
        return say("coadjoint.kirchhoff")
    return say("coadjoint.euler")


# SO(3) and SE(3): where ĀA = 1 the metric is left-invariant, (28) and (29).


@dataclass(frozen=True)
class Isometry:
    """The forms where ĀA = 1: ϖ in skew letters, the ``values`` of P and F, and dϖ = ``form``;
    ``C``: 1, as a step says it.

    ``images``: the horizontal variations with which dϖ is written.
    """

    letters: Alphabet
    C: Expr
    cartan: Cartan
    values: Mapping[Letter, Expr]
    form: Expr
    images: Mapping[Letter, Expr]
    steps: tuple[Step, ...]


def isometry(general: Cartan, momenta: MomentumForm, a: Alphabet, n: int, c: Chapter) -> Isometry:
    """The forms of any group restricted to isometries, with the steps ``relation``, ``cartan`` and
    ``exterior``."""
    b = Alphabet(n, affine=a.affine, skew=True, signed=a.signed)
    relating, writing = c.draft("relation", "relation"), c.draft("cartan", "relation")
    C = relating.mark(b.unit)
    momentum, energy = (b.respell(e, C).of(C) for e in (general.momentum, general.energy))
    work = b.respell(general.work, C)
    form = Cartan(
        writing.mark(momentum),
        writing.mark(energy),
        writing.mark(momentum - energy * word(b.dt)),
        work,
        (),
    )
    relation = relating.step(
        stated("C = 𝟏,  Z̄ = −Z,  ξ̄ = −ξ"),
        say("relation.displacements") if a.affine else say("relation.isometries"),
    )
    cartan = writing.step(
        (form_equation(writing, momentum, energy, WordNotation()),),
        say("cartan.trivialised"),
        () if a.affine else (28,),
    )
    values = fibre(form.momentum, form.energy, {b.U: -work}, b)
    domega = restrict(momenta.form, values, b).of(C)
    images = _images(domega, b)
    exterior = _exterior(domega, images, b, c)
    domega = domega.marked(exterior.label)
    return Isometry(b, C, form, values, domega, images, (relation, cartan, exterior))


def _exterior(domega: Expr, images: Mapping[Letter, Expr], b: Alphabet, c: Chapter) -> Step:
    draft = c.draft("exterior", "relation")
    shown = bracketed(draft, domega, images, b)
    return draft.step((Equation(DOMEGA, shown),), restricted_prose(b), () if b.affine else (29,))


def bracketed(d: Draft, domega: Expr, images: Mapping[Letter, Expr], b: Alphabet) -> Tree:
    """The tree of dϖ, with [ξ′, ξ] and ξ′η − ξη′ written where their letters stand."""
    display = dict(zip((b.bracket, b.bracket_w), shown_brackets(b), strict=False))
    return factored_tree(
        d, domega, without(domega, b.dt, b.dpt), images, WordNotation(display=display)
    )


def resting(b: Alphabet) -> dict[Letter, Expr]:
    """The contact displacements: ξ ↦ ξ − Z δt and η ↦ η − w δt, and the same for δ′."""
    found = contact(zip(b.duals, b.algebra_parts, strict=True), b, {})
    return {x: found[x] for f in b.algebra_parts for x in (f.xi, f.xi_prime)}


def _images(domega: Expr, b: Alphabet) -> dict[Letter, Expr]:
    """The contact variations: displacements, and δZ ↦ δZ − f δt where the force has a letter of
    its own."""
    images = resting(b)
    if not b.affine:
        flat = without(domega, b.bracket)
        solution = solve_for(gradient(flat, b.Z.xi_prime), b.Z.d_velocity)
        if solution is not None and solution:
            shift = word(b.Z.d_velocity) - solution
            images |= {b.Z.d_velocity: shift, primes(b)[b.Z.d_velocity]: primed(shift, b)}
    return images
