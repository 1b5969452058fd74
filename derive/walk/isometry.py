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
from .cartan import Cartan, form_equation, frame_rule
from .exterior import DOMEGA, Exterior, primed, primes, structure, trivial_variations
from .gather import gathered, solve_for


@dataclass(frozen=True)
class Isometry:
    """ϖ and dϖ in skew letters; ``brackets``: their letters' values."""

    letters: Alphabet
    cartan: Cartan
    exterior: Exterior
    brackets: dict[Letter, Expr]
    steps: tuple[Step, ...]


def isometry(stage: Cartan, a: Alphabet, n: int, prefix: str, general: str, scope: str) -> Isometry:
    """Specialise the trivialised form of any group to isometries, and differentiate it."""
    b = Alphabet(n, affine=a.affine, skew=True)
    momentum, energy = (b.respell(e, b.unit) for e in (stage.momentum, stage.energy))
    form = Cartan(momentum, energy, ())
    relation = Step(
        f"{prefix}.relation",
        "relation",
        (f"{general}.trivialisation",),
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
        scope=scope,
    )
    cartan = Step(
        f"{prefix}.cartan",
        "relation",
        (f"{general}.cartan_trivialised", f"{prefix}.relation"),
        (form_equation(momentum, energy, Notation()),),
        say("The Cartan form, trivialised."),
        () if a.affine else (28,),
        scope,
    )
    exterior, brackets, step = _exterior(form, b, prefix, general, scope)
    return Isometry(b, form, exterior, brackets, (relation, cartan, step))


def _exterior(
    form: Cartan, b: Alphabet, prefix: str, general: str, scope: str
) -> tuple[Exterior, dict[Letter, Expr], Step]:
    derived, recorded = structure(b, prefix)
    abbreviation = {b.Z.xi_prime: b.bracket, b.w.xi_prime: b.bracket_w}
    brackets = {x: word(abbreviation[x]) for x in derived}
    delta, delta_prime = trivial_variations(b, brackets, (frame_rule(b, b.unit),))
    domega = forms.exterior(form.form(b), primes(b), delta, delta_prime)
    images = horizontal(domega, b)
    letters = (abbreviation[x] for x in derived)
    shown_as = (e.rhs for e in recorded.equations)
    display = Notation(display=dict(zip(letters, shown_as, strict=True)))
    shown = gathered(domega, without(domega, b.dt, b.dpt), images, display)
    step = Step(
        f"{prefix}.exterior",
        "exterior derivative",
        (
            f"{prefix}.cartan",
            f"{general}.structure",
            f"{general}.force" if b.affine else f"{general}.gradient",
            f"{general}.trivialisation",
        ),
        (Equation(DOMEGA, shown),),
        say("Its exterior derivative; the bracket comes from the structure equation.")
        + say(
            "It is the general form with C = 𝟏: as ξ and Z are skew and J is symmetric, the "
            "terms in ξ′ξZ gather into a bracket and those in Z² cancel."
        ),
        () if b.affine else (29,),
        scope,
    )
    values = {abbreviation[x]: e for x, e in derived.items()}
    return Exterior(domega, images, ()), values, step


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
