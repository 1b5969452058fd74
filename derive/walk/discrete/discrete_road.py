"""The discrete road of any group: L_d, its one-forms Θ⁺ and Θ⁻, dΘ⁺ = dΘ⁻, the motion."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction

from ...algebra import calculus
from ...algebra.calculus import derivation, gradient, substitute, terms_with
from ...algebra.word_trees import WordNotation, metrics, tree_of
from ...algebra.words import Dim, Expr, Letter, inner, word
from ...language.read import read
from ...language.tree import Tree, add, mul
from ...record.record import Equation, Step, stated
from ..chapter import Chapter, Draft, WalkError, say
from ..matrices.coordinates import factored_tree
from ..spine.alphabet import cancel_scalar, inverse_letter, inverse_tree, of_size
from ..spine.lagrangian import Moments, sum_over

# The letters of the discrete road: g₀, g₁, g₂, their variations, the step h.


class DiscreteAlphabet:
    """The letters of three elements of a group that moves points by n × n matrices; affine maps
    are those of r̂ = (r, 1), of size ``n`` = "size" where any, with a hat on what has that size."""

    def __init__(self, n: Dim, *, affine: bool = False):
        self.n, self.affine = n, affine
        hat = "\u0302" if affine else ""
        self.m_i, self.r_i = Letter("m_i"), Letter(f"r{hat}_i", n)
        self.h = Letter("h")
        self.J = Letter("Ĵ" if affine else "J", n, n, 1)
        self.g = tuple(Letter(f"g_{k}", n, n) for k in range(3))
        self.d_g = tuple(Letter(f"δg_{k}", n, n) for k in range(2))
        self.dp_g = tuple(Letter(f"δ′g_{k}", n, n) for k in range(2))
        self.second = tuple(Letter(f"δδ′g_{k}", n, n) for k in range(2))
        self.U = tuple(Letter(f"U_{k}") for k in range(2))
        self.d_U = tuple(Letter(f"δU_{k}") for k in range(2))
        self.dp_U = tuple(Letter(f"δ′U_{k}") for k in range(2))
        self.second_U = tuple(Letter(f"δδ′U_{k}") for k in range(2))
        self.N = tuple(Letter(f"N{hat}_{k}", n, n) for k in range(2))
        self.xi = Letter(f"ξ{hat}", n, n)
        self.difference = across(self.g)

    @property
    def chapter(self) -> str:
        """The name of the chapter about any group with this action."""
        return "discrete_affine" if self.affine else "discrete"

    @property
    def letters(self) -> tuple[Letter, ...]:
        """The letters of the motion."""
        return (*self.g, *self.N, *self.d_g, bend(self.g), self.J, self.xi, self.h)

    @property
    def place(self) -> Tree:
        """The tree of r_i."""
        return ("at", self.r_i.name.removesuffix("_i"), "i")

    @property
    def notation(self) -> WordNotation:
        """How words are written, without metrics."""
        return stepped(self.g, self.h)

    @property
    def step(self) -> Expr:
        """g₁ − g₀ on words."""
        return word(self.g[1]) - word(self.g[0])


def stepped(x: tuple[Letter, ...], h: Letter) -> WordNotation:
    """How words in x₀, x₁, x₂ are written: h⁻¹, x₁ − x₀ and x₂ − 2x₁ + x₀ as they are."""
    first, second, third = (y.name for y in x)
    display: dict[Letter, Tree] = {
        inverse_letter(h): inverse_tree(h),
        across(x): ("add", second, ("mul", -1, first)),
        bend(x): ("add", third, ("mul", -2, second), first),
    }
    return WordNotation(display=display)


def across(x: tuple[Letter, ...]) -> Letter:
    """The letter that stands for x₁ − x₀."""
    return Letter(f"{x[1].name} − {x[0].name}", x[0].rows, x[0].cols)


def bend(x: tuple[Letter, ...]) -> Letter:
    """The letter that stands for x₂ − 2x₁ + x₀."""
    first, second, third = (y.name for y in x)
    return Letter(f"{third} − 2{second} + {first}", x[0].rows, x[0].cols)


def opened(x: tuple[Letter, ...]) -> dict[Letter, Expr]:
    """x₂ − 2x₁ + x₀ for the letter that stands for it."""
    first, second, third = map(word, x)
    return {bend(x): third - 2 * second + first}


def rewritten(e: Expr, letters: Iterable[Letter], n: Dim) -> Expr:
    """An expression about any n in ``letters``, which have the same names."""
    mine = {x.name: word(x) for x in letters}
    return of_size(e, {x: mine[x.name] for x in e.letters() if x.name in mine}, n)


HALF = Fraction(1, 2)
PLUS, MINUS = "Θ⁺", "Θ⁻"


@dataclass(frozen=True)
class DiscreteLagrangian:
    """L_d on words: ``kinetic`` − ½h(U₀ + U₁)."""

    form: Expr
    steps: tuple[Step, ...]


@dataclass(frozen=True)
class OneForms:
    """Θ⁺ and Θ⁻ on words, with the forces as δU₀ and δU₁: ``plus`` − ``minus`` = δL_d; ``work``:
    the values of δU₀, δU₁."""

    plus: Expr
    minus: Expr
    work: dict[Letter, Expr]
    steps: tuple[Step, ...]


@dataclass(frozen=True)
class DiscreteMotion:
    """``balance``: what vanishes paired with each δg₁, (g₂ − 2g₁ + g₀)J/h − hN₁; ``tested``: its
    pairing with g₁ξ."""

    balance: Expr
    tested: Expr
    steps: tuple[Step, ...]


def trapezoid(energy: Expr, a: DiscreteAlphabet) -> Expr:
    """h (T − ½(U₀ + U₁)): the rule of the trapezoid for U, for a kinetic energy T that is that of
    a constant velocity."""
    return cancel_scalar(word(a.h) * energy, a.h) - HALF * word(a.h) * (word(a.U[0]) + word(a.U[1]))


def lagrangian(a: DiscreteAlphabet, c: Chapter) -> DiscreteLagrangian:
    """L_d of the points moved by g₀ and g₁, a time h apart; then by their moments J."""
    moments = c.draft("moments", "definition")
    own: Tree = ("mul", ("at", "m", "i"), a.place, ("T", a.place))
    about = "moments.discrete_affine" if a.affine else "moments.discrete"
    others = [] if a.affine else stated("m = Σᵢ mᵢ,  c = Σᵢ mᵢ rᵢ")
    first = moments.step((*others, Equation(a.J.name, ("sum", "i", own))), say(about))
    table: Moments = {(a.m_i, a.r_i, a.r_i): moments.mark(word(a.J))}
    defining, pulling = c.draft("lagrangian", "definition"), c.draft("pullback", "pull-back")
    velocity = word(inverse_letter(a.h)) * a.step * word(a.r_i)
    kinetic = HALF * word(a.m_i) * inner(velocity, velocity)
    speed = mul(("inv", "h"), ("add", ("mul", "g_1", a.place), mul(-1, "g_0", a.place)))
    points = mul(HALF, read("mᵢ"), ("norm2", speed))
    whole = mul("h", add(("sum", "i", points), mul(-HALF, ("add", "U_0", "U_1"))))
    form = trapezoid(sum_over(kinetic, {a.m_i, a.r_i}, table), a)
    across = {a.g[1]: word(a.difference), a.g[0]: word(a.difference) * 0}
    core = trapezoid(sum_over(substitute(kinetic, across), {a.m_i, a.r_i}, table), a)
    pulling.depends_on(form)
    if form != substitute(core, {a.difference: a.step}):
        raise WalkError("the discrete Lagrangian is not one of g_1 − g_0")
    steps = (
        first,
        defining.step((Equation("L_d", whole),), say("lagrangian.discrete")),
        pulling.step((Equation("L_d", tree_of(core, a.notation)),), say("pullback.discrete")),
    )
    return DiscreteLagrangian(pulling.mark(form), steps)


def one_forms(stage: DiscreteLagrangian, a: DiscreteAlphabet, c: Chapter) -> OneForms:
    """δL_d, and its parts at the two ends: Θ⁺ on δg₁, and the opposite of what δg₀ has, Θ⁻."""
    forcing = c.draft("force", "definition")
    work = {a.d_U[k]: forcing.mark(-inner(word(a.N[k]), word(a.d_g[k]))) for k in range(2)}
    pairs = (
        Equation(("inner", a.N[k].name, f"δg_{k}"), mul(-1, ("call", "δ", f"U_{k}")), (f"δg_{k}",))
        for k in range(2)
    )
    force = forcing.step(pairs, say("force.discrete"))
    images = {a.g[k]: word(a.d_g[k]) for k in range(2)}
    images |= {a.U[k]: word(a.d_U[k]) for k in range(2)}
    varied = derivation(stage.form, images.get)
    plus = terms_with(varied, a.d_g[1], a.d_U[1])
    minus = -terms_with(varied, a.d_g[0], a.d_U[0])
    if varied != plus - minus:
        raise WalkError("a variation of the discrete Lagrangian is not the sum of its two ends")
    writing = c.draft("one_forms", "variation")
    ends = ((PLUS, plus), (MINUS, minus))
    sides = (Equation(("call", x, "δy"), _at_end(writing, substitute(e, work), a)) for x, e in ends)
    both = add(("call", PLUS, "δy"), mul(-1, ("call", MINUS, "δy")))
    step = writing.step((*sides, Equation(("call", "δ", "L_d"), both)), say("one_forms.ends"))
    return OneForms(writing.mark(plus), writing.mark(minus), work, (force, step))


def _at_end(d: Draft, e: Expr, a: DiscreteAlphabet) -> Tree:
    """The tree of the part of a variation at one end, with g₁ − g₀ and the moments of forces."""
    moving = terms_with(e, a.g[1])
    rest = terms_with(e, *a.N[:2])
    core = substitute(moving, {a.g[1]: word(a.difference)}) + rest
    return factored_tree(d, e, core, {a.difference: a.step}, a.notation)


def exterior(stage: OneForms, a: DiscreteAlphabet, c: Chapter) -> Step:
    """dΘ⁺ = dΘ⁻, the symplectic form of two elements."""
    d: dict[Letter, Expr] = {a.g[k]: word(a.d_g[k]) for k in range(2)}
    dp: dict[Letter, Expr] = {a.g[k]: word(a.dp_g[k]) for k in range(2)}
    prime: dict[Letter, Letter] = {}
    for k in range(2):
        prime |= {a.d_g[k]: a.dp_g[k], a.d_U[k]: a.dp_U[k]}
        d |= {a.dp_g[k]: word(a.second[k]), a.dp_U[k]: word(a.second_U[k])}
        dp |= {a.d_g[k]: word(a.second[k]), a.d_U[k]: word(a.second_U[k])}
    plus, minus = (calculus.exterior(x, prime, d.get, dp.get) for x in (stage.plus, stage.minus))
    if plus != minus:
        raise WalkError("dΘ⁺ and dΘ⁻ differ")
    draft = c.draft("exterior", "exterior derivative")
    notation = WordNotation(metrics(a.J.name).metrics, a.notation.display)
    both = [("call", f"d{x}", "δy", "δ′y") for x in (PLUS, MINUS)]
    equations = (Equation(both[0], draft.tree(plus, notation)), Equation(both[0], both[1]))
    return draft.step(equations, say("exterior.discrete"))


def motion(stage: OneForms, a: DiscreteAlphabet, c: Chapter) -> DiscreteMotion:
    """Θ⁺(g₀, g₁) = Θ⁻(g₁, g₂) on every δg₁: what it says in space, and carried to 𝔤 by g₁."""
    onward = {a.g[1]: word(a.g[2]), a.g[0]: word(a.g[1]), a.d_g[0]: word(a.d_g[1])}
    onward |= {a.N[0]: word(a.N[1])}
    plus, minus = (substitute(e, stage.work) for e in (stage.plus, stage.minus))
    rest = substitute(minus, onward) - plus
    balance = gradient(rest, a.d_g[1])
    core = substitute(terms_with(balance, a.g[2]), {a.g[2]: word(bend(a.g))})
    core = core + terms_with(balance, a.N[1])
    moving = c.draft("motion", "kernel", rest)
    tested = inner(core, word(a.d_g[1]))
    if substitute(tested, opened(a.g)) != rest:
        raise WalkError("the discrete motion is not told by g_2 − 2g_1 + g_0")
    space = moving.step(
        (Equation(tree_of(tested, a.notation), 0, ("δg_1",)),), say("motion.discrete")
    )
    naming = c.draft("trivialisation", "definition")
    xi = naming.step(
        (Equation(a.xi.name, ("mul", ("inv", "g_1"), "δg_1")),), say("trivialisation.discrete")
    )
    carrying = c.draft("balance", "kernel", space, xi)
    carried = substitute(tested, {a.d_g[1]: word(a.g[1]) * word(a.xi)})
    last = carrying.step(
        (Equation(tree_of(carried, a.notation), 0, (a.xi.name,)),), say("balance.discrete")
    )
    return DiscreteMotion(moving.mark(core), carrying.mark(carried), (space, xi, last))
