"""What every view says of a record, whatever its markup: title, system, sections, notes."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Any

from ..language.reserved import advected_entries
from ..language.show import in_sentence
from ..language.tree import Tree, names, nodes
from ..language.tree import names as names_in
from ..record.as_json import decode
from ..record.record import AMENDED, ANY_GROUP, FIELDS, Derivation, Equation, Step
from ..record.sentence import Sentence, enumerated, phrase
from ..schema.potential_kinds import kinds
from .language import ENGLISH, Language, entries, told
from .printing.letters import names_of

CONVENTIONS, FORMULAS_CONVENTIONS = told("conventions"), told("conventions.formulas")
DISCRETE_CONVENTIONS = told("conventions.discrete")
DISCRETE_FORMULAS_CONVENTIONS = told("conventions.discrete_formulas")
FLUID_CONVENTIONS = told("conventions.fluid")
TRANSPOSES = {x: told(f"transposes.{x}") for x in ("bar", "top")}
"""The first sentence of the conventions, in each notation of transposes."""
ROAD, ROAD_GIVEN, ROAD_BOTH = told("road"), told("road.given"), told("road.both")
ROAD_DISCRETE, ROAD_OF_ERRORS = told("road.discrete"), told("road.errors")
PAPER = told("paper")

WORKS = Path(__file__).with_name("works.txt")


def works(*keys: str) -> tuple[tuple[str, ...], ...]:
    """The works of these keys: key, authors, title, where."""
    lines = (x.split("|") for x in WORKS.read_text(encoding="utf-8").split("\n") if "|" in x)
    known = {x[0]: x for x in (tuple(map(str.strip, y)) for y in lines)}
    return tuple(known[x] for x in keys)


ON_FLUIDS, ON_STEPS_OF_TIME = works("Arn", "EM", "AK"), works("MV")
"""Where more is said of fluids, and of motions in steps of time."""
REFERENCES = works("paper", "Aud", "Igl")
"""The paper and what it refers to."""

DIAGONAL = tuple(
    ("row", *(("entry", "λ", i) if i == j else 0 for j in (1, 2, 3))) for i in (1, 2, 3)
)
STILL = (("δ′A",), ("ξ′",), ("Ω′",), ("η′",), ("δ′A", "δ′T"), ("ξ′", "η′"), ("Ω′", "η′"))
ASSUMPTIONS: tuple[tuple[frozenset[Equation], str], ...] = (
    (frozenset({Equation("I", ("matrix", *DIAGONAL))}), "in principal axes"),
    (frozenset({Equation("δt", 1)}), "for any X with δt = 1"),
    (frozenset({Equation("δt", 0), Equation("δ′t", 0)}), "for δt = 0, δ′t = 0"),
    *(
        (frozenset(Equation(x, 0) for x in ("δ′t", *parts)), "for δ′t = 0, δ′g = 0")
        for parts in reversed(STILL)
    ),
)
"""Equations that a step assumes, and how that is said in words."""
ACCELERATIONS = ("α̇", "τ̇", "Ż", "ẇ", "ζ̇", "ℓ̇_b", "ṗ_b", "u̇", "ν̇")


def latex_names(d: Derivation) -> dict[str, str]:
    """Name → LaTeX, of a record with its problem's parameters."""
    parameters, body = named_numbers(d), d.problem.get("body")
    symbolic = isinstance(body, Mapping) and body.get("kind") == "moments"
    return names_of(d.symbols, parameters) | (BOLD if "m" in parameters and not symbolic else {})


def named_numbers(d: Derivation) -> list[str]:
    """The numbers that the problem has names for: its parameters, what an algebra carries along,
    and what inputs give, as far as equations have them."""
    sides = (x for s in d.steps if s.driven for e in s.equations for x in (e.lhs, e.rhs))
    given = (x[1] for t in sides for x in nodes(t) if isinstance(x, tuple) and x[0] == "par")
    stated = (*(d.problem.get("parameters") or ()), *advected_entries(d.problem))
    return [*dict.fromkeys(map(str, (*stated, *given)))]


def declared(d: Derivation | None, language: Language) -> Iterator[tuple[str, str, str, str]]:
    """The parameters of a problem: name, meaning, unit and default; the last two may be empty."""
    parameters = d.problem.get("parameters") if d else None
    for name, about in parameters.items() if isinstance(parameters, Mapping) else ():
        about = about if isinstance(about, Mapping) else {}
        default = about.get("default")
        number = language.decimal(default) if isinstance(default, (int, float)) else ""
        meaning = language.word(str(about.get("meaning") or "parameter"))
        yield str(name), meaning, str(about.get("unit") or ""), number


@dataclass(frozen=True)
class Letter:
    """Letters and what they mean: a sentence, or parameters' ``own`` words, unit and default."""

    names: tuple[Tree, ...]
    meaning: str
    own: bool = False
    unit: str = ""
    default: str = ""

    def after(self, language: Language, unit: Callable[[str], str]) -> str:
        """What follows the meaning: the unit as ``unit`` shows it, and the default."""
        default = language.word("default {value}", value=self.default) if self.default else ""
        shown = f" {unit(self.unit)}" if self.unit else ""
        return shown + (f", {default}" if default else "")


def parameters(
    d: Derivation | None, language: Language, *, defaults: bool = True
) -> Iterator[Letter]:
    """The parameters of a problem in runs of which all is the same, with their defaults or not."""
    told = ((name, (x, True, y, z if defaults else "")) for name, x, y, z in declared(d, language))
    for said, run in groupby(told, lambda x: x[1]):
        yield Letter(tuple(("par", name) for name, _ in run), *said)


BOLD = {"m": r"\mathbf m"}
"""Masses beside a parameter m that is another mass: in one product with the total mass it would
differ by its serifs alone."""


def title(d: Derivation, language: Language = ENGLISH) -> str:
    """The title of the problem, or its name."""
    name, titled = (" ".join(str(x or d.name).split()) for x in (d.name, d.problem.get("title")))
    return titled if titled == name else language.word(titled)


def group(d: Derivation) -> str:
    """The name of the group of a record."""
    return product(" ".join(str(d.problem.get("group", ANY_GROUP)).split()))


def road(records: Sequence[Derivation]) -> str:
    """What the walk of some records does: their Lagrangians are those of points, or given; or in
    steps of time."""
    if all(map(discrete, records)):
        return ROAD_DISCRETE
    if all("kinematics" in d.problem for d in records):
        return ROAD_OF_ERRORS
    stated = {given(d.problem) for d in records}
    return ROAD_BOTH if len(stated) > 1 else ROAD_GIVEN if True in stated else ROAD


def conventions(records: Sequence[Derivation]) -> str:
    """What formulas mean in all of some records, with formulas between dollars."""
    if records and all(map(of_fluid, records)):
        return FLUID_CONVENTIONS
    whole = records and all(map(discrete, records))
    return DISCRETE_FORMULAS_CONVENTIONS if whole else FORMULAS_CONVENTIONS


def plain_conventions(d: Derivation, language: Language = ENGLISH) -> str:
    """The conventions of a record as plain text, with that of transposes."""
    if not of_fluid(d):
        return language.word(DISCRETE_CONVENTIONS if discrete(d) else CONVENTIONS)
    both = f"{language.word(TRANSPOSES['bar'])} {language.word(FLUID_CONVENTIONS)}"
    return both.replace("$", "").replace("𝟏", "1")


def references(records: Sequence[Derivation]) -> tuple[tuple[str, ...], ...]:
    """The works that notes of some records end with."""
    more = (of_fluid, ON_FLUIDS), (discrete, ON_STEPS_OF_TIME)
    return REFERENCES + sum((works for of, works in more if any(map(of, records))), start=())


def of_fluid(d: Derivation) -> bool:
    """Is a record that of a fluid whose group has no matrices?"""
    return "fluid" in d.problem


def discrete(d: Derivation) -> bool:
    """Is a record that of a discrete motion?"""
    return "discrete" in d.problem


def given(problem: Mapping[str, Any]) -> bool:
    """Does a problem say its Lagrangian, and move no body?"""
    return isinstance(problem.get("lagrangian"), Mapping)


def product(name: str) -> str:
    """The name of a group with × between its factors."""
    return name.replace(" x ", " × ")


def subtitle(d: Derivation, language: Language = ENGLISH) -> str:
    """The name of the group, unless the title says it."""
    if group(d).casefold() in title(d).casefold():
        return ""
    return language.word(ANY_GROUP) if group(d) == ANY_GROUP else group(d)


def headline(d: Derivation, language: Language = ENGLISH) -> str:
    """The title, and behind it the group where the title does not say it."""
    return " — ".join(filter(None, (title(d, language), subtitle(d, language))))


def heading(scope: str, language: Language = ENGLISH) -> str:
    """The heading of the steps that hold in a scope: any group, or one by name."""
    if scope == ANY_GROUP:
        return language.word("For any group of matrices")
    return language.word("For {group}", group=product(scope))


def sections(d: Derivation, language: Language = ENGLISH) -> Iterator[tuple[str, list[Step]]]:
    """The steps under headings: those of any group, then those of the group."""
    for scope, steps in groupby(d.steps, key=lambda step: step.scope):
        yield heading(scope, language), list(steps)


def printed(step: Step) -> str:
    """The numbers of the paper, runs of them as (11)–(13); a star where the print is false."""
    runs: list[list[int]] = []
    for n in step.paper:
        alone = n in AMENDED or not runs or runs[-1][-1] in AMENDED
        if alone or n != runs[-1][-1] + 1:
            runs.append([])
        runs[-1].append(n)
    return ", ".join(_run(run) for run in runs)


def _run(run: list[int]) -> str:
    """A run of numbers as (11)–(13), or one after the other where there are fewer than three."""
    if len(run) > 2:
        return f"({run[0]})–({run[-1]})"
    return ", ".join(f"({n})" + "*" * (n in AMENDED) for n in run)


def assumed(step: Step, language: Language = ENGLISH) -> list[str]:
    """What a step assumes further: in words where there are some, else as equations."""
    told = {e for e in step.equations if e.lhs in FIELDS}
    left = dict.fromkeys(e for e in step.given if e not in told)
    found = [language.word("with input")] if step.driven else []
    for equations, words in ASSUMPTIONS:
        if equations <= left.keys():
            found.append(language.word(words))
            left = {e: None for e in left if e not in equations}
    if any(map(_of_accelerations, step.equations)) and not moving(step.equations):
        found.append(language.word("for any acceleration"))
        left = {e: None for e in left if not _velocity(e)}
    others = (f"{in_sentence(e.lhs)} = {in_sentence(e.rhs)}" for e in left)
    return [*found, *map(language.formula, others)]


def _of_accelerations(e: Equation) -> bool:
    """Does an equation hold for every acceleration?"""
    return any(x in ACCELERATIONS for x in e.for_all)


def moving(equations: Sequence[Equation]) -> set[Equation]:
    """Of the equations of a step, some of which hold for any acceleration, those that hold along
    the motion alone: they say something of the acceleration, or of what the others say."""
    free = [e for e in equations if _of_accelerations(e)]
    rated = {e.lhs for e in free}
    others = (e for e in equations if free and not _of_accelerations(e))
    return {e for e in others if e.lhs in rated or _names(e).intersection(ACCELERATIONS)}


def _names(e: Equation) -> set[str]:
    """The names of both sides of an equation."""
    return {*names_in(e.lhs), *names_in(e.rhs)}


def _velocity(e: Equation) -> bool:
    """Is it an equation for the velocity of X, which goes with any acceleration?"""
    return isinstance(e.lhs, tuple) and e.lhs[0] == "call" and e.lhs[2:] == ("X",)


def notes(step: Step, language: Language = ENGLISH) -> list[str]:
    """The notes beside a rule where there is no margin: numbers of the paper, assumptions."""
    numbers = printed(step)
    paper = [language.word("paper {numbers}", numbers=numbers)] if numbers else []
    return [*paper, *assumed(step, language)]


DOMAINS = {"δA": "T_A G", "δ′A": "T_A G", "ξ′": "𝔤", "η′": "𝔤", "Ω′": "ℝ³"}
PAIRS = {"δ′A": "T_g G", "ξ′": "𝔤"}


def domain(for_all: tuple[str, ...]) -> str:
    """The space in which the names of "for every …" vary; empty when it is not known."""
    return (DOMAINS if len(for_all) == 1 else PAIRS).get(for_all[0], "")


def quantified(e: Equation, along: Collection[Equation]) -> tuple[str, ...]:
    """The names of "for every …"; accelerations among them where some equations of the step hold
    ``along`` the motion alone, by :func:`moving`: else they are spoken of beside the step."""
    return e.for_all if along else tuple(x for x in e.for_all if x not in ACCELERATIONS)


def keys(step: Step) -> list[str]:
    """The keys of a step's numbered entries, in order: of a row, that of its first equation."""
    return [step.keys[x.first] for x in entries(step.equations)]


def capitalised(text: str) -> str:
    """The text with a capital first letter, the rest as it is."""
    return text[:1].upper() + text[1:]


# The system of a record in words: its group, its body, and what acts on it.


def system(d: Derivation, language: Language) -> str:
    """What moves, by which group, or where a Lagrangian is given, and what acts; empty where the
    record has neither."""
    stated = given(d.problem)
    moved = language.sentence(_given_lagrangian(d)) if stated else _action_of(d, language)
    acting = [*_acting(d.problem)] if moved else []
    if acting:
        forces = language.sentence(enumerated(acting))
        return " ".join((moved, language.word("What acts: {forces}.", forces=forces)))
    if stated or not moved:
        return moved
    return " ".join((moved, language.word("Nothing acts.")))


def _action_of(d: Derivation, language: Language) -> str:
    """What moves, by which group; empty where the record has no body."""
    basis, body = d.problem.get("basis"), d.problem.get("body")
    if not isinstance(basis, list) or not basis or not isinstance(body, Mapping):
        return ""
    return language.word(
        "The group {group}, of dimension {d}, moves {body}.",
        group=group(d),
        d=str(len(basis)),
        body=language.sentence(_body(body)),
    )


def _given_lagrangian(d: Derivation) -> Sentence:
    """Where the Lagrangian is given, and what it depends on."""
    torus, basis = d.problem.get("torus"), d.problem.get("basis")
    if isinstance(torus, Mapping):
        return phrase(
            "The group {group}, of dimension {d}, stands for the maps of the torus that keep the "
            "area. Its Lagrangian is given: the kinetic energy of a fluid.",
            group=group(d),
            d=str(torus["N"] ** 2 - 1),
        )
    what = enumerated([*_depends(d.problem)])
    dimension = str(_many(basis))
    if d.problem.get("advected") is not None:
        return phrase(
            "The Lagrangian is given on a Lie algebra of dimension {d}, and depends {what}; "
            "the state has no element of a group.",
            d=dimension,
            what=what,
        )
    return phrase(
        "The Lagrangian is given on the group {group}, of dimension {d}, and depends {what}.",
        group=group(d),
        d=dimension,
        what=what,
    )


def _depends(problem: Mapping[str, Any]) -> Iterator[Sentence]:
    used = {*names(decode(problem["lagrangian"]["L"], "lagrangian"))}
    yield phrase("on the velocity")
    if used - {"ζ", "t", "Γ"}:
        yield phrase("on the element of the group")
    if "Γ" in used:
        yield phrase("on what the algebra carries along")
    if "t" in used:
        yield phrase("on the time")


def _body(body: Mapping[str, Any]) -> Sentence:
    points, solids = _many(body.get("points")), _many(body.get("solids"))
    if points and solids:
        return phrase("a body of points and solids")
    if points:
        return phrase("{n} points", n=str(points)) if points > 1 else phrase("one point")
    if solids == 1 and body["solids"][0].get("kind") == "ellipsoid":
        return phrase("a homogeneous ellipsoid")
    if solids:
        return phrase("a body of {n} solids", n=str(solids)) if solids > 1 else phrase("a solid")
    return phrase("a body given by its moments")


def _acting(problem: Mapping[str, Any]) -> Iterator[Sentence]:
    potentials, inputs = problem.get("potentials"), problem.get("inputs")
    present = [p.get("kind") for p in potentials] if isinstance(potentials, list) else []
    for kind, about in kinds().items():
        count = present.count(kind)
        if count > 1 and about.several:
            yield phrase(about.several, n=str(count))
        elif count:
            yield phrase(about.phrase)
    if _many(problem.get("damping")):
        yield phrase("viscous damping")
    if _many(problem.get("forces")):
        yield phrase("forces of the state")
    if _many(problem.get("flows")):
        yield phrase("mass that flows")
    for x in inputs if isinstance(inputs, list) else []:
        yield phrase("the input {name}", name=str(x.get("name")))


def _many(x: Any) -> int:
    """The length of a list; 0 for anything else."""
    return len(x) if isinstance(x, list) else 0
