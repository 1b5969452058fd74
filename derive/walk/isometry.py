"""SO(n) and SE(n): where ĀA = 1 the metric is left-invariant, (28) and (29)."""

from __future__ import annotations

from dataclasses import dataclass

from ..algebra import forms
from ..algebra.calculus import gradient, without
from ..algebra.notation import Notation
from ..algebra.words import Expr, Letter, word
from ..record.record import Equation, Step
from ..record.sentence import say
from .alphabet import Alphabet
from .cartan import Cartan, form_equation
from .chapter import Chapter
from .exterior import (
    DOMEGA,
    Exterior,
    brackets_of,
    primed,
    primes,
    shown_brackets,
    trivial_variations,
)
from .gather import gathered, solve_for


@dataclass(frozen=True)
class Isometry:
    """ϖ and dϖ in skew letters; ``gram``: ĀA = 1; ``brackets``: their letters' values."""

    letters: Alphabet
    gram: Expr
    cartan: Cartan
    exterior: Exterior
    brackets: dict[Letter, Expr]
    steps: tuple[Step, ...]


def isometry(stage: Cartan, a: Alphabet, n: int, c: Chapter) -> Isometry:
    """Specialise the trivialised form of any group to isometries, and differentiate it."""
    b = Alphabet(n, affine=a.affine, skew=True, signed=a.signed)
    relating, writing = c.draft("relation", "relation"), c.draft("cartan", "relation")
    gram = relating.said(b.unit)
    momentum, energy = (b.respell(e, gram).of(gram) for e in (stage.momentum, stage.energy))
    work = b.respell(stage.work, gram)
    whole = writing.said(momentum - energy * word(b.dt))
    form = Cartan(writing.said(momentum), writing.said(energy), whole, work, ())
    relation = relating.step(
        (
            Equation("C", ("one",)),
            Equation(("T", "Z"), ("mul", -1, "Z")),
            Equation(("T", "ξ"), ("mul", -1, "ξ")),
        ),
        say(
            "For isometries ĀA = 𝟏, so that C drops out, and Z and ξ are skew; w and η are "
            "any vectors."
        )
        if a.affine
        else say("For isometries ĀA = 𝟏, so that C drops out, and Z and ξ are skew."),
    )
    cartan = writing.step(
        (form_equation(writing, momentum, energy, Notation()),),
        say("The Cartan form, trivialised."),
        () if a.affine else (28,),
    )
    exterior, brackets, step = _exterior(form, gram, b, c)
    return Isometry(b, gram, form, exterior, brackets, (relation, cartan, step))


def _exterior(
    form: Cartan, gram: Expr, b: Alphabet, c: Chapter
) -> tuple[Exterior, dict[Letter, Expr], Step]:
    derived = brackets_of(b)
    abbreviation = {b.Z.xi_prime: b.bracket, b.w.xi_prime: b.bracket_w}
    brackets = {x: word(abbreviation[x]).of(derived[x]) for x in derived}
    draft = c.draft("exterior", "exterior derivative")
    delta, delta_prime = trivial_variations(b, brackets, form.work)
    domega = forms.exterior(form.form, primes(b), delta, delta_prime).of(gram)
    images = horizontal(domega, b)
    letters = (abbreviation[x] for x in derived)
    display = Notation(display=dict(zip(letters, shown_brackets(b), strict=True)))
    shown = gathered(draft, domega, without(domega, b.dt, b.dpt), images, display)
    step = draft.step(
        (Equation(DOMEGA, shown),),
        say("Its exterior derivative; the bracket comes from the structure equation.")
        + say(
            "It is the general form with C = 𝟏: as ξ and Z are skew and J is symmetric, the "
            "terms in ξ′ξZ gather into a bracket and those in Z² cancel."
        ),
        () if b.affine else (29,),
    )
    values = {abbreviation[x]: e for x, e in derived.items()}
    said = {x: draft.said(y) for x, y in images.items()}
    return Exterior(draft.said(domega), said, ()), values, step


def horizontal(domega: Expr, b: Alphabet) -> dict[Letter, Expr]:
    """ξ ↦ ξ − Z δt, and δZ ↦ δZ − f δt where the force has a letter of its own."""
    images: dict[Letter, Expr] = {}
    flat = without(domega, b.bracket, b.bracket_w)
    for f in b.frames:
        for g in b.frames:
            solution = solve_for(gradient(domega, g.dp_velocity), f.xi)
            if solution is not None and solution:
                images[f.xi] = word(f.xi) - solution
                break
    if not b.affine:
        solution = solve_for(gradient(flat, b.Z.xi_prime), b.Z.d_velocity)
        if solution is not None and solution:
            images[b.Z.d_velocity] = word(b.Z.d_velocity) - solution
    table = primes(b)
    return images | {table[x]: primed(y, b) for x, y in images.items()}
