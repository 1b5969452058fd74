"""so(3) ≅ R³: the vector form (31)–(34) of the equations of SO(3) and SE(3)."""

from __future__ import annotations

from dataclasses import dataclass

from ..algebra.calculus import PairRule, gradient, reduce, substitute, without
from ..algebra.notation import Notation, metrics, tree_of
from ..algebra.space import antisymmetry, double, fold_inertia, hat, normal_form
from ..algebra.tree import Tree
from ..algebra.words import Expr, Factor, Letter, inner, number, trace, word, zero
from ..record.record import Equation, Step
from ..record.sentence import listed, phrase, say
from .chapter import Chapter
from .contraction import AND, Contraction, NoKernelError, rate, steps_of
from .exterior import DOMEGA
from .gather import gathered
from .isometry import Isometry
from .supposed import told
from .wedge import vector_sum


def _vector(name: str) -> Letter:
    return Letter(name, 3)


ZETA, OMEGA, OMEGA_P = _vector("ζ"), _vector("Ω"), _vector("Ω′")
D_ZETA, DP_ZETA, ZETA_DOT = _vector("δζ"), _vector("δ′ζ"), _vector("ζ̇")
PHI, MU, BRACKET = _vector("φ"), _vector("μ"), _vector("Ω′ ∧ Ω")
SPIN, SPIN_RATE = _vector("ℓ_b"), _vector("ℓ̇_b")
INERTIA = Letter("I", 3, 3, 1)
AXES = {"Z": ZETA, "ξ": OMEGA, "ξ′": OMEGA_P, "δZ": D_ZETA, "δ′Z": DP_ZETA, "f": PHI}
AXES |= {x.name: x for x in (SPIN, SPIN_RATE)}


@dataclass(frozen=True)
class VectorForm:
    """The kernel in vectors: ``balance[v]`` = 0 for each free v of δ′; ``inertia`` = I by J."""

    balance: dict[Letter, Expr]
    inertia: Expr
    steps: tuple[Step, ...]


def identified(stage: Isometry, chapter: Chapter) -> tuple[Reader, tuple[Step, Step]]:
    """so(3) read by vectors: j and the tensor of inertia."""
    naming, weighing = _identification(stage, chapter), _inertia(stage, chapter)
    return Reader(stage, naming.label, weighing.label), (naming, weighing)


def vector_form(stage: Isometry, read: Reader, chapter: Chapter) -> VectorForm:
    """Write ϖ's derivative by vectors and read the kernel off it."""
    b = stage.letters
    domega = read.scalar(stage.exterior.form)
    images = {axis(x): _flat(read.matrix(y)) for x, y in stage.exterior.images.items()}
    display = {BRACKET: tree_of(axis_of_bracket(stage))}
    if b.affine:
        display[b.bracket_w] = tree_of(_bracket_w(stage))
    notation = metrics("I", display=display)
    draft = chapter.draft("exterior_vector", "identification")
    flat = gathered(draft, domega, without(domega, b.dt, b.dpt), images, notation)
    written = draft.step(
        (Equation(DOMEGA, flat),),
        say("The exterior derivative in vectors."),
        () if b.affine else (31,),
    )
    c = _contraction(
        draft.said(domega), {x: draft.said(y) for x, y in images.items()}, notation, stage
    )
    known = [x for x in c.velocity if x.axis is None]
    c, steps = steps_of(
        c,
        known,
        phrase(AND, first="Ω, η, δζ", second="δw")
        if b.affine
        else phrase(AND, first="Ω", second="δζ"),
        listed(AND, [rate("ζ̇", "δζ"), *([rate("ẇ", "δw")] if b.affine else [])]),
        b,
        chapter,
        () if b.affine else (34,),
        *told(f"metric of a {'displacement' if b.affine else 'rotation'}", b.signed),
    )
    bracket = {BRACKET: substitute(axis_of_bracket(stage), c.velocity).marked()}
    opened = substitute(without(c.second_order, b.dpt), bracket)
    opened = opened.marked(chapter.label("second_order"))
    balance = {
        v: normal_form(gradient(reduce(opened, isolate(v)), v))
        for v in ((OMEGA_P, b.w.xi_prime) if b.affine else (OMEGA_P,))
    }
    motion = _kernel(balance, stage, chapter)
    said = {v: e.marked(motion.label) for v, e in balance.items()}
    return VectorForm(
        said,
        inertia_of(b.J).marked(read.inertia),
        (written, *steps, motion),
    )


def _contraction(
    domega: Expr, images: dict[Letter, Expr], notation: Notation, stage: Isometry
) -> Contraction:
    """dϖ(X, δ′) in vectors, with Ω(X) (and η(X)) read off the horizontal variations."""
    b = stage.letters
    unknown = (OMEGA, b.w.xi) if b.affine else (OMEGA,)
    if any(x not in images for x in unknown):
        raise NoKernelError("the velocity of the kernel cannot be read off dϖ")
    velocity = {x: substitute(word(x) - images[x], {b.dt: number(1)}) for x in unknown}
    (turning,) = velocity[OMEGA].letters()
    velocity[hat(OMEGA)] = word(hat(turning))
    rates = {D_ZETA: ZETA_DOT, hat(D_ZETA): hat(ZETA_DOT)}
    vertical: tuple[Letter, ...] = (DP_ZETA, hat(DP_ZETA))
    brackets = {}
    if b.affine:
        rates[b.w.d_velocity] = b.w.acceleration
        vertical = (*vertical, b.w.dp_velocity)
        brackets[b.bracket_w] = substitute(_bracket_w(stage), velocity).marked()
    resting = {DP_ZETA: OMEGA_P, **({b.w.dp_velocity: b.w.xi_prime} if b.affine else {})}
    display = {BRACKET: tree_of(substitute(axis_of_bracket(stage), velocity))}
    core, times = without(domega, b.dt, b.dpt), (b.dt, b.dpt)
    return Contraction(
        domega,
        core,
        images,
        velocity,
        rates,
        vertical,
        times,
        notation,
        display,
        lambda e: reduce(substitute(e, brackets), antisymmetry),
        resting,
    )


def isolate(v: Letter) -> PairRule:
    """``v ∧ y = −y ∧ v``: carry the vector v out of every j(v)."""

    def rule(left: Factor, right: Factor) -> Expr | None:
        (a, a_bar), (b, b_bar) = left, right
        if a.axis == v and b.cols == 1 and not b_bar:
            return -(word(hat(b)) * word(v))
        if b.axis == v and a.cols == 1 and a_bar:
            return -(word(v).bar * word(hat(a)))
        return None

    return rule


@dataclass(frozen=True)
class Reader:
    """Reads so(3) by vectors; the labels of the steps that say Z = j(ζ) and I."""

    stage: Isometry
    hat: str
    inertia: str

    def scalar(self, e: Expr) -> Expr:
        """Z → j(ζ), traces with J by the inertia, N_b by the moment μ."""
        b = self.stage.letters
        images = self._hats(e) | {b.bracket: self.hatted(BRACKET)}
        work = fold_inertia(substitute(e, images), b.J, word(INERTIA).marked(self.inertia))
        return normal_form(_fold_moment(work, b.N_body))

    def matrix(self, e: Expr) -> Expr:
        """A combination of skew letters as the combination of their hats (vectors stay)."""
        images = self._hats(e)
        return substitute(e, images) if images else e

    def hatted(self, x: Letter) -> Expr:
        """j(x)."""
        return word(hat(x)).marked(self.hat)

    def _hats(self, e: Expr) -> dict[Letter, Expr]:
        return {x: self.hatted(axis(x)) for x in e.letters() if x.name in AXES}


def axis(x: Letter) -> Letter:
    """The vector X of a skew letter j(X); any other letter itself."""
    return AXES.get(x.name, x)


def _flat(e: Expr) -> Expr:
    """j(a) + j(b) ↦ a + b for a sum of single hats; sums of vectors stay."""
    terms = {}
    for (traces, w), c in e.terms.items():
        axis = w[0][0].axis
        terms[traces, w if axis is None else ((axis, False),)] = c
    return Expr(e.rows, 1, terms, e.lineage)


def _fold_moment(e: Expr, moment: Letter) -> Expr:
    """``Tr N_b j(x)‾ = ⟨μ, x⟩``: what defines the moment of the forces."""
    total = e.like({})
    for (traces, _), c in e.terms.items():
        term = number(c)
        for cycle in traces:
            axes = [x.axis for x, _ in cycle if x.axis is not None]
            if len(cycle) == 2 and axes and any(x == moment for x, _ in cycle):
                barred = any(bar for x, bar in cycle if x == moment)
                folded = inner(word(MU), word(axes[0])) * (1 if barred else -1)
            else:
                folded = Expr(1, 1, {((cycle,), ()): number(1).terms[(), ()]})
            term = term * folded
        total = total + term
    return total


def axis_of_bracket(stage: Isometry) -> Expr:
    """The vector of the bracket [ξ′, ξ], from the structure equation with ξ = j(Ω), ξ′ = j(Ω′)."""
    bracket = _hatted_bracket(stage, stage.letters.bracket)
    return reduce(axial(normal_form(bracket)), isolate(OMEGA))


def _hatted_bracket(stage: Isometry, x: Letter) -> Expr:
    value = stage.brackets[x]
    return substitute(value, {y: word(hat(axis(y))) for y in value.letters() if y.name in AXES})


def body_momenta(stage: Isometry, read: Reader) -> tuple[Expr, Expr]:
    """The angular momentum and the momentum in the body: the coefficients of Ω and η in p̃."""
    momentum = read.scalar(stage.cartan.momentum)
    spin = gradient(reduce(normal_form(momentum), isolate(OMEGA)), OMEGA)
    return spin, gradient(momentum, stage.letters.w.xi)


def axial(e: Expr) -> Expr:
    """X with j(X) the given skew sum of words y x̄: from  j(x ∧ y) = y x̄ − x ȳ."""
    total = zero(3, 1).of(e)
    for (traces, w), c in e.terms.items():
        (y, _), (x, _) = w
        term = Expr(1, 1, {(traces, ()): c / 2})
        total = total + term * (word(hat(x)) * word(y))
    return normal_form(total)


def _bracket_w(stage: Isometry) -> Expr:
    """The translation part of the bracket in vectors."""
    return normal_form(_hatted_bracket(stage, stage.letters.bracket_w))


def _identification(stage: Isometry, c: Chapter) -> Step:
    affine = stage.letters.affine
    draft = c.draft("hat", "identification")
    pairs = [("Z", "ζ"), ("ξ", "Ω"), ("ξ′", "Ω′")] + ([] if affine else [("f", "φ")])
    equations = [Equation(x, ("hat", y)) for x, y in pairs]
    draft.read(stage.gram)  # only a skew matrix is a j(X)
    cross = draft.tree(axis_of_bracket(stage))
    equations.append(Equation(("bracket", "ξ′", "ξ"), ("hat", cross)))
    if affine:
        pairing: Tree = ("tr", ("mul", "N_b", ("T", ("hat", "Ω′"))))
        equations.append(Equation(pairing, ("inner", "μ", "Ω′"), ("Ω′",)))
    return draft.step(
        equations,
        say(
            "The linear part 𝔰𝔬(3) of the Lie algebra is identified with R³ by j(X)Y = X ∧ "
            "Y; the bracket is the vector product."
        )
        if affine
        else say(
            "The Lie algebra 𝔰𝔬(3) is identified with R³ by j(X)Y = X ∧ Y; the bracket is "
            "the vector product."
        ),
        () if affine else (33,),
    )


def _inertia(stage: Isometry, c: Chapter) -> Step:
    draft = c.draft("inertia", "identification")
    tensor = inertia_of(stage.letters.J)
    traced: Tree = ("tr", ("mul", ("hat", "ζ"), "J", ("T", ("hat", "Ω"))))
    return draft.step(
        (Equation(traced, ("metric", "I", "ζ", "Ω")), Equation("I", draft.tree(tensor))),
        say("The metric of J on 𝔰𝔬(3) is that of the tensor of inertia on R³."),
        () if stage.letters.affine else (32,),
    )


def inertia_of(J: Letter) -> Expr:
    """I with  Tr j(ζ) J j(Ω)‾ = ⟨ζ, IΩ⟩,  by the double vector product under the trace."""
    pairing = reduce(trace(word(hat(ZETA)) * word(J) * word(hat(OMEGA)).bar), double)
    return strip_right(gradient(pairing, ZETA), OMEGA)


def strip_right(e: Expr, vector: Letter) -> Expr:
    """The matrix M with e = M x, for a last letter x common to every term."""
    terms = {}
    for (traces, w), c in e.terms.items():
        if not w or w[-1] != (vector, False):
            raise ValueError(f"{vector.name} is not a common right factor")
        terms[traces, w[:-1]] = c
    return Expr(e.rows, vector.rows, terms, e.lineage)


def _kernel(balance: dict[Letter, Expr], stage: Isometry, c: Chapter) -> Step:
    b, draft = stage.letters, c.draft("kernel", "kernel")
    inertial = {OMEGA_P: word(INERTIA) * word(ZETA_DOT)}
    equations = []
    for v, e in balance.items():
        left = inertial[v] if not b.affine else _accelerations(e, b.w.acceleration)
        draft.read(e)
        equations.append(Equation(tree_of(left), vector_sum(left - e)))
    motion = say("The coefficient of Ω′ must vanish: the equations of motion.")
    if b.affine:
        motion = say("The coefficients of Ω′ and of η′ must vanish: the equations of motion.")
    return draft.step(
        equations,
        motion
        + say(
            "That of δ′t then vanishes as well: it is the opposite of what the rest gives for "
            "{motion}.",
            motion="Ω′ = ζ, η′ = w" if b.affine else "Ω′ = ζ",
        )
        + told("line", b.signed),
        () if b.affine else (34,),
    )


def _accelerations(e: Expr, w_dot: Letter) -> Expr:
    terms = {
        key: c
        for key, c in e.terms.items()
        if any(x in (ZETA_DOT, hat(ZETA_DOT), w_dot) for part in (*key[0], key[1]) for x, _ in part)
    }
    return e.like(terms)
