"""Exercise 1 for any Lagrangian L̃(t, g, Z) on the left or right: its forms, momenta, orbits."""

from __future__ import annotations

from dataclasses import dataclass

from ...algebra import calculus
from ...algebra.calculus import Trivialisation, derivation, reduce, substitute, substitute_trace
from ...algebra.word_trees import WordNotation, tree_of
from ...algebra.words import Expr, Letter, inner, number, word
from ...language.read import read
from ...language.tree import Tree, add, neg
from ...record.record import Equation, Hypothesis, Step, stated
from ..chapter import Chapter, say
from ..matrices.coordinates import at_constant_time
from ..spine.alphabet import Alphabet, cancelling, inverse_letter, inverse_tree
from ..spine.cartan import DOMEGA
from ..spine.kernel import any_lagrangian_forms, contact
from ..spine.principle import Contraction, put_in

# Exercise 1 for any Lagrangian: what holds whatever L̃(t, g, Z) is, on the left or on the right.
#
# δL̃ = ⟨Π, δZ⟩ + ⟨Φ, ξ⟩ + ∂ₜL̃ δt,  h̃ = ⟨Π, Z⟩ − L̃,  ϖ = ⟨Π, ξ⟩ − h̃ δt,  Π̇ = Φ + ε ad*_Z Π
#
# The sign ε is that of the bracket in the structure equation, which follows from δg = gξ, or ξg.
# Makes the steps of the chapters ``left`` and ``right``.

SIDES: dict[str, Trivialisation] = {"left": calculus.left, "right": calculus.right}
REGULAR = Hypothesis("nondegenerate", read("M̃(ξ, ξ′)"), "𝔤")


@dataclass(frozen=True)
class AnyLagrangian:
    """``epsilon``: the sign in ⟨Π̇ − Φ, ξ′⟩ − ε⟨Π, [Z, ξ′]⟩, which vanishes on the kernel for every
    ξ′; ``velocity``: Ȧ by Z, as AZ or ZA."""

    epsilon: int
    velocity: Tree
    steps: tuple[Step, ...]

    def __getitem__(self, label: str) -> Step:
        """A step by its label, without the chapter."""
        return next(x for x in self.steps if x.label.endswith(f".{label}"))


def structure(a: Alphabet, moved: Trivialisation) -> Expr:
    """δξ′ − δ′ξ, from δ(δ′g) = δ′(δg)."""
    xi, xi_prime = a.Z.xi, a.Z.xi_prime
    return calculus.structure_equation(a.A.position, xi, xi_prime, xi, xi_prime, moved)


def by_bracket(e: Expr, a: Alphabet) -> Expr:
    """An expression in ξ′ξ and ξξ′ by the letter of [ξ′, ξ]; ``ValueError`` if it is none."""
    xi, xi_prime = word(a.Z.xi), word(a.Z.xi_prime)
    return (sign_of(e, xi_prime * xi - xi * xi_prime) * word(a.bracket)).of(e)


def any_lagrangian(a: Alphabet, side: str, c: Chapter) -> AnyLagrangian:
    """The forms of any Lagrangian, and its kernel."""
    moved = SIDES[side]
    crossed = by_bracket(structure(a, moved).marked(c.label("structure")), a)
    second_order = c.label("second_order")
    form, balance, told = any_lagrangian_forms(a, c, {a.Z.xi_prime: crossed}, second_order)
    written, derived, motion = told
    momenta, energy = _momenta(c), _energy(c)
    first = (_trivialised(a, side, c), momenta, energy, _structure(a, crossed, c), written)
    other = moment_map(balance, a, moved, c)
    orbit = orbit_form(form, a, moved, other, c)
    steps = (*first, derived, *_kernel(form, a, c), motion, other, orbit)
    velocity = tree_of(moved(word(a.A.position), word(a.Z.velocity)))
    return AnyLagrangian(_epsilon(balance, a), velocity, steps)


def _epsilon(balance: Expr, a: Alphabet) -> int:
    """The sign of the bracket in the balance, where Π̇ and Φ are 0."""
    Z, xi_prime = word(a.Z.velocity), word(a.Z.xi_prime)
    turning = substitute(balance, dict.fromkeys((a.Pi.rate, a.Pi.force), number(0)))
    return -sign_of(turning, inner(word(a.Pi.momentum), Z * xi_prime - xi_prime * Z))


def _trivialised(a: Alphabet, side: str, c: Chapter) -> Step:
    """Z, ξ and ξ′, by the velocity and the variations of g."""
    definitions = {
        "left": "Z = A⁻¹α,  ξ = A⁻¹δA,  ξ′ = A⁻¹δ′A",
        "right": "Z = αA⁻¹,  ξ = δAA⁻¹,  ξ′ = δ′AA⁻¹",
    }
    told = say(f"trivialisation.{side}") + say("trivialisation.matrices")
    return c.draft("trivialisation", "trivialisation").step(
        stated(definitions[side]), told, (27,) if side == "left" else ()
    )


def _momenta(c: Chapter) -> Step:
    """Π and Φ: the derivatives of L̃ along Z and along the group."""
    return c.draft("momenta", "fibre derivative").step(
        stated("δ(L̃) = ⟨Π, δZ⟩ + ⟨Φ, ξ⟩ + ∂ₜL̃ δt"), say("momenta.any_lagrangian")
    )


def _energy(c: Chapter) -> Step:
    """h̃ = ⟨Π, Z⟩ − L̃."""
    draft = c.draft("energy", "Legendre transform")
    return draft.step(stated("h̃ = ⟨Π, Z⟩ − L̃"), say("energy.any_lagrangian"), (16,))


def _structure(a: Alphabet, crossed: Expr, c: Chapter) -> Step:
    """The structure equation, with the sign of its bracket."""
    shown = tree_of(crossed, _notation(a))
    draft = c.draft("structure", "structure equation")
    return draft.step((Equation(read("δ(ξ′) − δ′(ξ)"), shown),), say("structure.crossed"))


def _kernel(form: Expr, a: Alphabet, c: Chapter) -> tuple[Step, ...]:
    """X in dϖ, its vertical part, and the velocity that X has where ∂²L̃/∂Z² is invertible."""
    notation = _notation(a)
    contraction = Contraction(
        form,
        at_constant_time(form, a.dt, a.dpt),
        contact([(a.Pi, a.Z)], a, {}),
        {a.Z.xi: word(a.Z.velocity)},
        {a.Pi.d_momentum: a.Pi.rate},
        (a.Pi.dp_momentum,),
        notation,
        resting={a.Pi.dp_momentum: a.Z.xi_prime},
    )
    _, first, second = put_in([contraction], "ξ, δΠ", c, stated("⟨δ′Π, ξ⟩ = M̃(ξ, δ′Z)"))
    along = stated("ξ(X) = Z")
    third = c.draft("second_order", "kernel", second).step(
        along, say("second_order.any_lagrangian"), where=along, hypotheses=(REGULAR,)
    )
    return first, second, third


def _notation(a: Alphabet, *others: Letter) -> WordNotation:
    """Pairings with 𝔤* as ⟨·, ·⟩, and the letters of the bracket, and others, written out."""
    display = {a.bracket: read("[ξ′, ξ]")} | {x: read(x.name) for x in others}
    return WordNotation(display=display, covectors=frozenset(a.Pi.letters))


# The other momentum: Π carried by g to the other side, the moment map; its rate, and the
# energy's.
#
# On the left, Z = g⁻¹ġ stays when g becomes hg, and δg = ηg has ϖ(δy) = ⟨Π, A⁻¹ηA⟩ = ⟨Π_o, η⟩; on
# the right g becomes gh, and ⟨Π_o, η⟩ = ⟨Π, AηA⁻¹⟩. Along the motion the coadjoint term cancels:
#
# ⟨Π̇_o, η⟩ = ⟨Φ, A⁻¹ηA⟩,  ḣ = −∂ₜL̃.
#
# Makes the step ``moment_map`` of the chapters ``left`` and ``right``.


def moment_map(balance: Expr, a: Alphabet, moved: Trivialisation, c: Chapter) -> Step:
    """Π_o, its rate and that of the energy.

    ``balance``: ⟨Π̇ − Φ, ξ′⟩ − ε⟨Π, [Z, ξ′]⟩, which vanishes on the motion for every ξ′.
    """
    draft = c.draft("moment_map", "conservation")
    A, any_of = word(a.A.position), (a.Z.xi_prime.name,)
    back, along = word(inverse_letter(a.A.position)), moved(A, word(a.Z.velocity))
    on_left, xi_prime = moved is calculus.left, word(a.Z.xi_prime)
    transported = back * xi_prime * A if on_left else A * xi_prime * back
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

    momentum = inner(word(a.Pi.momentum).marked(momenta), transported)
    energy = inner(word(a.Pi.momentum), word(a.Z.velocity)) - word(lagrangian)
    whole = Letter("A⁻¹ξ′A", a.n, a.n)
    display = {inverse_letter(a.A.position): inverse_tree(a.A.position)}
    notation = WordNotation(
        display={whole: tree_of(transported, WordNotation(display=display))},
        covectors=frozenset(a.Pi.letters),
    )

    def paired(e: Expr, covector: Letter) -> Tree:
        """The tree of ⟨P, A⁻¹ξ′A⟩."""
        by_letter = (inner(word(covector), x) for x in (transported, word(whole)))
        return draft.tree(substitute_trace(e, *by_letter).of(e), notation)

    moving = rate(momentum, transported)
    equations = [
        Equation(read("⟨Π_o, ξ′⟩"), paired(momentum, a.Pi.momentum), any_of),
        Equation(read("⟨Π̇_o, ξ′⟩"), paired(moving, a.Pi.force), any_of),
        Equation("ḣ", draft.tree(rate(energy.marked(c.label("energy")), word(a.Z.velocity)))),
    ]
    return draft.step(equations, say(f"moment_map.{'left' if on_left else 'right'}"))


# Kirillov, Kostant, Souriau: dϖ at constant time, on a level of the other momentum.
#
# The other momentum pairs a constant η of 𝔤 as Π pairs what g carries it to, A⁻¹ηA on the left;
# on its level ⟨δΠ, ξ′⟩ = ε⟨Π, [ξ, ξ′]⟩, and dϖ is there ε⟨Π, [ξ, ξ′]⟩. Makes the step ``kks`` of
# the chapters ``left`` and ``right``.

CONSTANT_TIME = (Equation("δt", 0), Equation("δ′t", 0))


def orbit_form(form: Expr, a: Alphabet, moved: Trivialisation, other: Step, c: Chapter) -> Step:
    """dϖ at constant time, less what the variations of the other momentum are in it.

    ``form``: dϖ by Π and the letter of the bracket; ``other``: the step of the other momentum.
    ``ValueError`` where the rest is no bracket.
    """
    draft = c.draft("kks", "restriction", other)
    crossed = Letter("[ξ, ξ′]", a.n, a.n)
    notation = _notation(a, crossed)
    xi, xi_prime, Pi = word(a.Z.xi), word(a.Z.xi_prime), word(a.Pi.momentum)
    opened = {a.bracket: xi_prime * xi - xi * xi_prime, crossed: xi * xi_prime - xi_prime * xi}
    restricted = at_constant_time(form, a.dt, a.dpt)
    turn = transported(a, moved)
    sign = sign_of(turn, opened[crossed])
    here = inner(word(a.Pi.d_momentum), xi_prime) + sign * inner(Pi, word(crossed))
    there = inner(word(a.Pi.dp_momentum), xi) + sign * inner(Pi, word(a.bracket))
    rest = substitute(restricted - here + there, opened)
    left = sign_of(rest, inner(Pi, opened[crossed])) * inner(Pi, word(crossed))
    return draft.step(
        [
            Equation(DOMEGA, draft.tree(restricted, notation)),
            Equation(
                add(DOMEGA, neg(draft.tree(left, notation))),
                add(draft.tree(here, notation), neg(draft.tree(there, notation))),
            ),
        ],
        say("kks.level"),
        where=CONSTANT_TIME,
    )


def transported(a: Alphabet, moved: Trivialisation) -> Expr:
    """The variation along ξ, at g = 1, of what g carries a constant of 𝔤 to, which is ξ′ there."""
    g, back, constant = word(a.A.position), Letter("A⁻¹", a.n, a.n), Letter("η", a.n, a.n)
    xi, inverse, eta = word(a.Z.xi), word(back), word(constant)
    whole, undone = (
        (inverse * eta * g, xi * inverse)
        if moved is calculus.left
        else (g * eta * inverse, inverse * xi)
    )
    varied = derivation(whole, {a.A.position: moved(g, xi), back: -undone}.get)
    one = {a.A.position: a.unit, back: a.unit, constant: word(a.Z.xi_prime)}
    return substitute(varied, one)


def sign_of(e: Expr, unit: Expr) -> int:
    """ε of an expression ε · unit; ``ValueError`` where it is none."""
    for sign in (1, -1):
        if e == sign * unit:
            return sign
    raise ValueError("neither the expression nor its opposite")
