"""The discrete motion of an affine group in blocks, of SO(3) in a unit quaternion."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ...algebra.calculus import gradient, reduce, substitute
from ...algebra.word_trees import WordNotation, double, fold_inertia, hat, normal_form, tree_of
from ...algebra.words import Dim, Expr, Factor, Letter, inner, number, one, word, zero
from ...language.tree import Tree
from ...record.record import Equation, Step
from ..chapter import Chapter, say
from ..matrices.isomorphism import anticommute, inertia_of, vector_sum
from ..matrices.separation import central_moments
from ..spine.alphabet import Alphabet, cancel_scalar, inverse_letter, inverse_tree
from .discrete_road import DiscreteAlphabet, DiscreteMotion, bend, rewritten, stepped

# An affine group in blocks: g = ιAῑ + (ιT + o)ō, for ι: r ↦ (r, 0) and o = (0, 1).
#
# The parts of the motion on ξ and on η are read off by the relations ῑι = 1, ῑo = 0, ōo = 1.


class Blocks:
    """The letters of the blocks of affine maps of Rⁿ, and of the matrices of their ``size``."""

    def __init__(self, n: Dim, size: Dim):
        self.n = n
        self.inside, self.origin = Letter("ι", size, n), Letter("o", size)
        self.A = tuple(Letter(f"A_{k}", n, n) for k in range(3))
        self.T = tuple(Letter(f"T_{k}", n) for k in range(3))
        self.R = tuple(Letter(f"R_{k}", n) for k in range(3))
        self.m, self.c, self.J = Letter("m"), Letter("c", n), Letter("J", n, n, 1)
        self.N, self.F = Letter("N_1", n, n), Letter("f_1", n)
        self.xi, self.eta, self.h = Letter("ξ", n, n), Letter("η", n), Letter("h")

    @property
    def letters(self) -> tuple[Letter, ...]:
        """The letters of the motion in blocks."""
        bends = (bend(x) for x in (self.A, self.T))
        own = (self.m, self.c, self.J, self.N, self.F, self.xi, self.eta, self.h)
        return (*self.A, *self.T, *bends, *own)

    def in_one_matrix(self, linear: Expr, shift: Expr) -> Expr:
        """ι linear ῑ + ι shift ō."""
        into, origin = word(self.inside), word(self.origin)
        return into * linear * into.bar + into * shift * origin.bar

    def images(self, a: DiscreteAlphabet) -> dict[Letter, Expr]:
        """The letters of ``a`` in blocks."""
        into, origin, first = word(self.inside), word(self.origin), word(self.c)
        corner = origin * origin.bar
        moments = into * word(self.J) * into.bar + into * first * origin.bar
        moments = moments + origin * first.bar * into.bar + word(self.m) * corner
        found = {
            a.J: moments,
            a.N[1]: self.in_one_matrix(word(self.N), word(self.F)),
            a.xi: self.in_one_matrix(word(self.xi), word(self.eta)),
            bend(a.g): self.in_one_matrix(word(bend(self.A)), word(bend(self.T))),
        }
        elements = zip(a.g, self.A, self.T, strict=True)
        return found | {g: self.in_one_matrix(word(A), word(T)) + corner for g, A, T in elements}

    def relation(self, x: Factor, y: Factor) -> Expr | None:
        """ῑι = 1, ῑo = 0, ōι = 0, ōo = 1."""
        if x[0] not in (self.inside, self.origin) or not x[1] or y[1]:
            return None
        if x[0] == y[0]:
            return one(self.n) if x[0] == self.inside else number(1)
        return zero(x[0].cols, y[0].cols) if y[0] in (self.inside, self.origin) else None

    def parts(self, e: Expr) -> tuple[Expr, Expr]:
        """The linear part ῑeι and the translation ῑeo of a matrix, by the relations."""
        into = word(self.inside)
        columns = (into, word(self.origin))
        linear, shift = (reduce(into.bar * e * x, self.relation) for x in columns)
        return linear, shift

    @property
    def notation(self) -> WordNotation:
        """How words in the blocks are written."""
        display: dict[Letter, Tree] = {inverse_letter(self.m): inverse_tree(self.m)}
        for x in (self.A, self.T, self.R):
            display |= stepped(x, self.h).display
        return WordNotation(display=display)


@dataclass(frozen=True)
class BlockMotion:
    """What vanishes paired with A₁ξ, ``linear``, and with A₁η, ``shift``; ``letters`` of both."""

    linear: Expr
    shift: Expr
    letters: Blocks
    steps: tuple[Step, ...]


def in_blocks(stage: DiscreteMotion, a: DiscreteAlphabet, c: Chapter) -> BlockMotion:
    """The motion of any affine group, its linear part and its translation apart."""
    b = Blocks("n", a.n)
    naming, parting = c.draft("blocks", "definition"), c.draft("apart", "kernel")
    images = {x: naming.mark(e) for x, e in b.images(a).items()}
    named = naming.step(_definitions(a, b), say("blocks.discrete"))
    linear, shift = b.parts(substitute(stage.balance, images))
    tested = inner(linear, word(b.A[1]) * word(b.xi)) + inner(shift, word(b.A[1]) * word(b.eta))
    told = Equation(parting.tree(tested, b.notation), 0, (b.xi.name, b.eta.name))
    apart = parting.step((told,), say("apart.discrete"))
    return BlockMotion(parting.mark(linear), parting.mark(shift), b, (named, apart))


def _definitions(a: DiscreteAlphabet, b: Blocks) -> list[Equation]:
    """The blocks of r̂, g_k, Ĵ, N̂₁ and ξ̂, each as ῑ…ι and ῑ…o; and Ĵ by its blocks."""
    into: Tree = ("T", "ι")
    pairs = [(a.g[k], b.A[k], b.T[k]) for k in range(3)]
    pairs += [(a.J, b.J, b.c), (a.N[1], b.N, b.F), (a.xi, b.xi, b.eta)]
    found = [Equation(("at", "r", "i"), ("mul", into, a.place))]
    for whole, linear, shift in pairs:
        found.append(Equation(linear.name, ("mul", into, whole.name, "ι")))
        found.append(Equation(shift.name, ("mul", into, whole.name, "o")))
    found.append(Equation("m", ("inner", "o", ("mul", a.J.name, "o"))))
    return [*found, Equation(a.J.name, tree_of(b.images(a)[a.J], b.notation))]


@dataclass(frozen=True)
class BarycentricPart:
    """The linear parts about the centre of mass: what vanishes paired with A₁ξ, with the moments
    ``metric``."""

    balance: Expr
    metric: Letter
    steps: tuple[Step, ...]


def about_the_centre(
    stage: BlockMotion, a: Alphabet, resultant: Expr, c: Chapter
) -> BarycentricPart:
    """H ⋉ Rⁿ: the centre of mass R moves by itself, and the linear parts about it.

    A displacement (ξ, η − m⁻¹ξc) leaves the centre where it is for η = 0; ``resultant``: f₁.
    """
    b = Blocks(a.n, a.n + 1)  # type: ignore[operator]
    linear, shift = (rewritten(e, b.letters, a.n) for e in (stage.linear, stage.shift))
    light, first = word(inverse_letter(b.m)), word(b.c)
    metric, value = central_moments(a)
    naming, moving = c.draft("centre", "definition"), c.draft("translation", "solution")
    from_centre = {
        bend(b.T): word(bend(b.R)) - light * word(bend(b.A)) * first,
        b.J: word(metric) + word(b.J) - value,
    }
    from_centre = {x: naming.mark(e) for x, e in from_centre.items()}

    def tidy(e: Expr) -> Expr:
        return cancel_scalar(substitute(e, from_centre), b.m)

    shift, linear = tidy(shift), tidy(linear - shift * light * first.bar)
    onward = word(b.h) * light * shift  # R₂ − 2R₁ + R₀ − h²m⁻¹f₁
    onward = cancel_scalar(cancel_scalar(onward, b.m), b.h)
    found = 2 * word(b.R[1]) - word(b.R[0]) + word(bend(b.R)) - onward
    where = (
        Equation(R.name, tree_of(word(T) + light * word(A) * first, b.notation))
        for R, T, A in zip(b.R, b.T, b.A, strict=True)
    )
    named = naming.step(
        (*where, Equation(metric.name, tree_of(value, b.notation))), say("centre.discrete")
    )
    solved = cancel_scalar(substitute(found, {b.F: resultant}), b.m)
    goes = moving.step(
        (Equation(b.R[2].name, moving.tree(solved, b.notation)),), say("translation.discrete")
    )
    return BarycentricPart(naming.mark(linear).of(stage.linear), metric, (named, goes))


# SO(3) in a unit quaternion: W = 1 + 2q j(x) + 2 j(x)² for a step of (q, x), and hM in it.
#
# A skew M is read as a vector by Tr j(u) j(y)‾ = 2⟨u, y⟩: what it has on j(y) tells its axis.

TESTED = Letter("y", 3)
SCALE = Letter("Tr J")
HALF = Fraction(1, 2)


@dataclass(frozen=True)
class QuaternionTurning:
    """Two steps W and their momenta M by the moments ``metric``: ``momentum``: that of W₁,
    ``before``: that of W₀ after it, ``force``: what the forces add; all three skew."""

    W: tuple[Letter, ...]
    M: tuple[Letter, ...]
    momentum: Expr
    before: Expr
    force: Expr
    metric: Letter


def in_quaternions(t: QuaternionTurning, notation: WordNotation, c: Chapter) -> tuple[Step, ...]:
    """The quaternions of the steps W, their momenta and the motion in them."""
    inertia = Letter("I" + t.metric.name.removeprefix("J"), 3, 3, 1)
    q, x = ([Letter(f"{s}_{k}", *size) for k in range(2)] for s, size in (("q", ()), ("x", (3,))))
    h = Letter("h")
    naming, telling = c.draft("quaternion", "identification"), c.draft("turning", "kernel")

    def turned(e: Expr, k: int) -> Expr:
        """The axis of a skew sum, with W in the quaternion of the k-th step."""
        return axis_of(substitute(e, {y: unit(q[k], x[k]) for y in t.W}), t.metric, inertia)

    equations = [Equation(inertia.name, naming.tree(inertia_of(t.metric)))]
    for k, (W, M) in enumerate(zip(t.W, t.M, strict=True)):
        square = word(q[k]) * word(q[k]) + inner(word(x[k]), word(x[k]))
        found = (q[k].name, x[k].name)
        equations.append(Equation(W.name, tree_of(unit(q[k], x[k])), (), found))
        equations.append(Equation(tree_of(square), 1))
        axis = vector_sum(turned(t.momentum, k), notation)
        equations.append(Equation(M.name, ("hat", axis)))
    naming.depends_on(t.momentum)
    named = naming.step(equations, say("quaternion.steps"))
    telling.depends_on(named)
    total, momenta = turned(t.before, 0), list[Equation]()
    if t.force:
        free = cancel_scalar(word(inverse_letter(h)) * t.force, h)
        momenta.append(Equation(("hat", "μ_1"), telling.tree(free, notation)))
        total = total + word(h) * word(Letter("μ_1", 3))
    after = Equation(t.M[1].name, ("hat", vector_sum(total, notation)))
    return named, telling.step((*momenta, after), say("turning.quaternion"))


def unit(q: Letter, x: Letter) -> Expr:
    """The rotation 1 + 2q j(x) + 2 j(x)² of a unit quaternion (q, x)."""
    j = word(hat(x))
    return one(3) + 2 * word(q) * j + 2 * j * j


def axis_of(e: Expr, metric: Letter, inertia: Letter) -> Expr:
    """The axis of a skew matrix in j's and the moments J, with the tensor J = (Tr J) 1 − I."""
    paired = fold_inertia(inner(e, word(hat(TESTED))), metric, word(inertia))
    tensor = word(SCALE) * one(3) - word(inertia)
    paired = normal_form(substitute(reduce(paired, double), {metric: tensor}))
    return normal_form(HALF * gradient(reduce(paired, anticommute(TESTED)), TESTED))
