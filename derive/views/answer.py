"""The answer of a record: the equations of motion of its problem, with what their letters are."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from fractions import Fraction
from functools import partial
from unicodedata import normalize

from ..algebra.families import group
from ..language.reserved import advected_entries, by_letter
from ..language.show import show
from ..language.tree import Tree, add, coefficient, mul, names, neg, nodes, replaced
from ..record.record import Derivation, Equation, Step
from ..record.sentence import Prose, Sentence
from .gathered import Gathering, decimal
from .language import ENGLISH, Language
from .layout import Reading
from .outline import Letter, headline, latex_names, parameters
from .printing.letters import standard
from .printing.sentences import dollars, prose
from .printing.signs import OVERDOT, Notation, markdown_text
from .printing.tex import formula as of_tree
from .printing.tex import latex_tree
from .printing.typeset import WIDTH, literal
from .text import (
    EQUATION,
    clashing,
    equation_lines,
    formula,
    letter_lines,
    page,
    paragraph,
    with_quotes,
)

SOLVED = ("kinematics", "coadjoint", "kernel", "equations", "motion")
"""The steps that may tell the motion, the better ones later."""
EXPANDED = ("components", "explicit")
"""The steps that tell it entry by entry."""


def steps_of_answer(d: Derivation) -> tuple[Step, ...]:
    """The steps in which the equations of motion stand: solved, then entry by entry."""
    there = {s.label.removeprefix(f"{d.name}."): s for s in d.steps}
    solved = [there[x] for x in SOLVED if x in there]
    return (*solved[-1:], *(there[x] for x in EXPANDED if x in there))


def equations_of_motion(d: Derivation) -> tuple[Equation, ...]:
    """The equations of the answer, without those of a vector whose entries are told."""
    solved, *expanded = steps_of_answer(d)
    rates = {"ζ̇", *(x for e in solved.equations for x in names(e.lhs))}
    both = [e for step in expanded for e in step.equations if rates & {*names(e.lhs)}]
    told = [*{e.lhs: e for e in both}.values()]  # by the step that says most, where both tell it
    parts = [x for e in told for x in nodes(e.lhs) if isinstance(x, tuple)]
    in_entries = {x[1] for x in parts if x[0] == "entry"}
    if "ζ̇" in in_entries:
        in_entries |= {"ψ", "Ż"}  # what ζ̇ is read off
    return (*(e for e in solved.equations if e.lhs not in in_entries), *told)


# What is said of the letters: by an equation of the record, else in words.


def definitions(d: Derivation, equations: Sequence[Equation]) -> tuple[Equation, ...]:
    """What the record says of the letters of equations, and of those in it, by its own steps, or as
    it defines moments for any body; of a family, what it says of all members or of each."""
    own = [s for s in d.steps if s.label.startswith(f"{d.name}.") and not s.given]
    members: dict[Tree, list[Equation]] = {}
    for e in (e for s in own if s.rule not in ("evaluation", "inversion") for e in s.equations):
        if isinstance(e.lhs, tuple) and e.lhs[0] in ("at", "entry") and not e.for_all:
            members.setdefault(e.lhs[1], []).append(e)
    known: dict[Equation, None] = {}
    told = _told(equations)
    seen: set[Tree] = {*told}
    left = [x for e in equations for x in _sides(e)]
    while left:
        x = left.pop(0)
        if x in seen:
            continue
        seen.add(x)
        whole, *of_member = _any_member(x)
        step, equation = d.definition(x) or d.definition(whole) or (None, None)
        mine = step and (step in own or step.rule == "definition")
        if mine and equation and not equation.for_all:
            found = [] if equation.rhs == ("par", x) and x not in clashing(d) else [equation]
        elif isinstance(x, tuple) and x[0] == "par":
            continue
        else:
            inside = x if isinstance(x, tuple) else ()
            family, *others = inside[1:] if inside[:1] == ("at",) else (x, *inside[1:])
            found = members.get(family, []) if family not in told else []
            left += others
        known |= dict.fromkeys(found)
        left += (replaced(e.rhs, "i", of_member[0]) if of_member else e.rhs for e in found)
    return tuple(known)


def _any_member(x: Tree) -> tuple[Tree, ...]:
    """A function of one member of a family as that of any, r₁(t) as r_i(t), and which member it
    is; of another tree it alone."""
    if isinstance(x, tuple) and x[0] == "call" and isinstance(x[1], tuple) and x[1][0] == "at":
        return ("call", ("at", x[1][1], "i"), *x[2:]), x[1][2]
    return (x,)


def _told(equations: Sequence[Equation]) -> set[Tree]:
    """What the equations tell: left sides, and the rates in them with their entries."""
    inside = [x for e in equations for x in nodes(e.lhs)]
    rates = {x for x in inside if isinstance(x, str) and OVERDOT in normalize("NFD", x)}
    entries = {x for x in inside if isinstance(x, tuple) and x[1] in rates}
    return rates | entries | {e.lhs for e in equations if _sides(e) == (e.rhs,)}


def _sides(e: Equation) -> tuple[Tree, ...]:
    """The sides of an equation that have letters to explain: the left one where it is a formula."""
    lhs = e.lhs
    alone = not isinstance(lhs, tuple) or lhs[0] in ("at", "entry", "call")
    return (e.rhs,) if alone else (lhs, e.rhs)


MOVING = {
    "linear part of g": "linear part of the map that moves the body",
    "translation of g": "translation of the map that moves the body",
}
"""What is said of parts of g where that is not among the letters."""


def letters(d: Derivation, equations: Sequence[Equation], language: Language) -> Iterator[Letter]:
    """The names, the inputs and the parameters that occur in equations, with their meaning."""
    there = {x for e in equations for side in _sides(e) for x in nodes(side)}
    families = {x[1] for x in there if isinstance(x, tuple) and x[0] == "at"}
    equated = {x[1] for x in (e.lhs for e in equations) if isinstance(x, tuple) and x[0] == "at"}
    plain = {x for e in equations for side in _sides(e) for x in _plain(side)}
    numbers = {x[1] for x in there if isinstance(x, tuple) and x[0] == "par"}
    plain |= {"Γ"} if numbers & {*advected_entries(d.problem)} else set()
    told = {y for x in _told(equations_of_motion(d)) for y in names(x)}
    for s in d.symbols:
        family = s.name in families and not (s.name in equated and d.definition(s.name))
        if (s.name in plain or family) and s.name not in numbers - clashing(d):
            meaning = language.of(s.meaning)
            if "g" not in plain and (moving := MOVING.get("".join(map(str, s.meaning)))):
                meaning = language.word(moving)
            if s.name in told:
                meaning = language.word("{meaning}, by its equation above", meaning=meaning)
            yield Letter((s.name,), meaning)
    for name, about in _inputs(d):
        if name in numbers | {x.rpartition("_")[0] for x in numbers}:
            said = language.sentence(about).partition(", ")[2] if about else ""
            said = language.word("input: {meaning}", meaning=said) if said else ""
            yield Letter((("par", name),), said or language.word("input"))
    for x in parameters(d, language):
        if occurring := tuple(y for y in x.names if {y} & there):
            yield replace(x, names=occurring)


def _plain(t: Tree) -> Iterator[str]:
    """The names in a tree, but those of families whose members stand there."""
    if isinstance(t, str):
        yield t
    elif isinstance(t, tuple) and t[0] != "par":
        for x in t[2:] if t[0] == "at" else t[1:]:
            yield from _plain(x)


def _inputs(d: Derivation) -> Iterator[tuple[str, Sentence | None]]:
    """The inputs of a problem, with what the steps say of each."""
    said = dict(x for s in d.steps if s.driven for x in _named(s.prose))
    kinematics = d.problem.get("kinematics") or {}
    listed = [str(x["name"]) for x in d.problem.get("inputs") or ()]
    for name in (*listed, *map(str, kinematics.get("inputs", ()))):
        yield name, said.get(name)


def _named(prose: Prose) -> Iterator[tuple[str, Sentence]]:
    """The parts of sentences that say of a name what it is."""
    for s in prose:
        places = dict(s.places)
        if s.message.startswith("{name}, "):
            yield str(places["name"]).strip("‘’"), s
        yield from _named(tuple(x for x in places.values() if isinstance(x, Sentence)))


def _runs(names: Iterable[str], of: Mapping[str, str]) -> tuple[str, str]:
    """The coordinates of the velocity, first and last of each letter and block, and the same by
    the names of the blocks."""
    first = {own: name for name, own in of.items()}
    spans = [(found[0], found[-1]) for found in by_letter(names).values()]

    def listed(pairs: Iterable[tuple[str, str]]) -> str:
        return ", ".join(a if a == b else f"{a} … {b}" for a, b in pairs)

    return listed((first[a], first[b]) for a, b in spans), listed(spans)


# The answer as every format shows it.


@dataclass(frozen=True)
class Summary:
    """The answer of a record; ``blocks``: its equations, and what defines their letters, as steps,
    with the word before each; ``source``: in which steps the motion stands."""

    record: Derivation
    language: Language
    blocks: tuple[tuple[str, Step], ...]
    letters: tuple[Letter, ...]
    source: str


def summary(
    d: Derivation, language: Language = ENGLISH, by_block: Mapping[str, str] | None = None
) -> Summary:
    """The answer of a record in a language; ``by_block``: names of the velocity → by the blocks."""

    def shown(e: Equation) -> Equation:
        e = as_written(d, e)
        return replace(e, rhs=in_decimals(e.rhs, language))

    told, motion = steps_of_answer(d), equations_of_motion(d)
    where = definitions(d, motion)
    label = f"{d.name}.answer", f"{d.name}.where"
    whole, defined = (
        replace(told[-1], label=x, equations=tuple(shown(e) for e in y))
        for x, y in zip(label, (motion, where), strict=True)
    )
    blocks = (("", whole), (language.word("where"), defined))
    source = language.word("From {labels}.", labels=", ".join(s.label for s in told))
    if by_block:
        own, also = _runs(by_block.values(), by_block)
        source += " " + language.word("In code {names} are {also}.", names=own, also=also)
    listed = tuple(letters(d, (*motion, *where), language))
    return Summary(d, language, blocks if where else blocks[:1], listed, source)


FIRST = ("kg", "m/s^2")
"""Units of what stands first in a product, before lengths and angles: mgl."""


def as_written(d: Derivation, e: Equation) -> Equation:
    """An equation as a person writes it, its right side gathered."""
    return replace(e, rhs=_gathering(d).tree(e.rhs))


def _gathering(d: Derivation) -> Gathering:
    """What gathers sums of numbers, by the problem of a record."""
    name, about = str(d.problem.get("group")), d.problem.get("parameters") or {}
    units = {x: str((y or {}).get("unit", "")) for x, y in about.items()}
    ranked = sorted(about, key=lambda x: [not units[x].startswith(y) for y in FIRST])
    try:
        known = group(name).places
    except ValueError:  # a group of the problem's own
        known = ()
    sizes: dict[Tree, int] = {("at", "A", k): x.n for k, (_, x) in enumerate(known, 1)}
    if len(known) == 1:
        n = known[0][1].n
        sizes = {"A": n} if d.problem.get("n") == n else {}
    return Gathering({x: k for k, x in enumerate(ranked)}, sizes, name in PLANE)


def in_decimals(t: Tree, language: Language) -> Tree:
    """A tree with 9.81 for 981/100."""

    def shown(x: int | Fraction) -> Tree:
        if not decimal(x):
            return x
        size = language.decimal(abs(float(x)))
        return neg(size) if x < 0 else size

    return _with_numbers(t, shown)


def _with_numbers(t: Tree, shown: Callable[[int | Fraction], Tree]) -> Tree:
    """A tree with its numbers as they are shown."""
    if isinstance(t, (int, Fraction)):
        return shown(t)
    if not isinstance(t, tuple) or t[0] == "par":
        return t
    parts = [_with_numbers(x, shown) for x in t[1:]]
    return mul(*parts) if t[0] == "mul" else (t[0], *parts)


def answer_text(x: Summary, width: int = WIDTH) -> str:
    """The answer as text, no line longer than ``width`` columns (at least 40)."""
    sides = [t for _, step in x.blocks for e in step.equations for t in (e.lhs, e.rhs)]
    width, quoted = max(width, 40), clashing(x.record, {name for t in sides for name in names(t)})
    blocks = [[*paragraph(headline(x.record, x.language), 0, width)]]
    for said, step in x.blocks:
        equations = with_quotes(step.equations, quoted)
        lines = equation_lines(equations, width - EQUATION, x.language)
        blocks.append([*filter(None, (said,)), *lines])
    if x.letters:
        blocks.append([z for y in x.letters for z in letter_lines(y, quoted, x.language, width)])
    if any(y[1] in quoted for x in x.letters for y in x.names if isinstance(y, tuple)):
        why = "A parameter stands in ‘quotes’ where its name would be read as something else."
        blocks.append([*paragraph(x.language.word(why), 0, width)])
    blocks.append([*paragraph(x.source, 0, width)])
    return page(blocks)


def answer_markdown(x: Summary) -> str:
    """The answer in Markdown, its formulas between dollars."""
    names = latex_names(x.record)
    parts = [f"# {markdown_text(headline(x.record, x.language))}"]
    for said, step in x.blocks:
        shown = formula(step.equations, x.record.symbols, language=x.language)
        parts += [said, f"$$\n{shown}\n$$"]
    lines = []
    for y in x.letters:
        own = partial(dollars, names=names)
        told = markdown_text(y.meaning) if y.own else prose(y.meaning, markdown_text, own)
        about = y.after(x.language, lambda unit: markdown_text(f"[{unit}]"))
        shown = ", ".join(f"${standard(latex_tree(name, names))}$" for name in y.names)
        lines.append(f"* {shown}: {told}{about}")
    return "\n\n".join(filter(None, (*parts, "\n".join(lines), markdown_text(x.source)))) + "\n"


PLANE = {"SO(2)", "SE(2)"}
"""The groups in which A turns a plane."""
ANGLE = {"θ": r"\theta", "θ̇": r"\dot{\theta}"}
COSINE, SINE = ("fun", "cos", "θ"), ("fun", "sin", "θ")
TURN = ((COSINE, neg(SINE)), (SINE, COSINE))
"""A by its angle."""


def by_angle(d: Derivation) -> Callable[[Tree], Tree]:
    """What writes the entries of A in a tree by its angle, where A turns a plane."""
    entries = {("entry", "A", i + 1, j + 1): x for i, y in enumerate(TURN) for j, x in enumerate(y)}

    def written(t: Tree) -> Tree:
        if t in entries or not isinstance(t, tuple) or t[0] == "par":
            return entries.get(t, t) if isinstance(t, tuple) else t
        parts = [*map(written, t[1:])]
        if t[0] in ("add", "mul"):
            return (add if t[0] == "add" else mul)(*parts)
        if t[0] == "div" and coefficient(parts[0])[0] < 0:
            return neg(("div", neg(parts[0]), parts[1]))
        return (t[0], *parts)

    return written if d.problem.get("group") in PLANE else lambda t: t


def _of_angle(d: Derivation) -> Iterator[Equation]:
    """What stands for the rate of A, where that turns a plane by its angle."""
    for k, E in enumerate(d.problem["basis"], 1):
        if [[int(x) for x in row[:2]] for row in E[:2]] == [[0, -1], [1, 0]]:
            yield Equation("A", ("matrix", *(("row", *row) for row in TURN)))
            yield Equation("θ̇", ("entry", "ζ", k))


LONG = 10**9
"""A number with a numerator or denominator above it is rounded where it is seen at a glance."""


def rounded(t: Tree, language: Language) -> Tree:
    """A tree with its long numbers, as those of a mesh, to five digits."""

    def shown(x: int | Fraction) -> Tree:
        if max(abs(x.numerator), x.denominator) <= LONG:
            return x
        quotient = Decimal(abs(x.numerator)) / Decimal(x.denominator)  # beyond floats, too
        digits, _, power = f"{quotient:.4e}".partition("e")
        near = -4 < int(power) < 5
        size = language.decimal(float(f"{digits}e{power if near else 0}"))
        size += "" if near else f"·{show(('pow', 10, int(power)))}"
        return neg(size) if x < 0 else size

    return _with_numbers(t, shown)


ARROW = re.compile('data-arrow="[0-9]+"')
"""A mark as it is written."""


def answer_mathml(
    d: Derivation, marks: Mapping[Tree, str] | None = None, language: Language = ENGLISH
) -> tuple[tuple[str, str], ...]:
    """The equations of motion as they are read: of each the label of the step that tells it, and
    its MathML, with ≈ where a long number in it is rounded.

    ``marks``: tree → the ``data-arrow`` that it has where it stands; the equation of a vector whose
    entries are told stands among them, too, where a term of it is marked. Sums are gathered, but
    where a mark would be lost or numbers are rounded. In the plane A is told by its angle.
    """
    angle, apart, reading = by_angle(d), Reading(d.problem, marks or ()), Reading(d.problem)

    def turned(t: Tree) -> Tree:
        return in_decimals(rounded(angle(apart.tree(t)), language), language)

    def gathered(t: Tree) -> Tree:
        return in_decimals(angle(_gathering(d).tree(reading.tree(t))), language)

    marked = {y: x for t, x in (marks or {}).items() for y in (gathered(t), turned(t))}
    marked |= {neg(t): x for t, x in marked.items() if coefficient(t)[0] < 0}
    typeset = partial(of_tree, names=latex_names(d) | ANGLE, notation=Notation(), marks=marked)
    told, steps = equations_of_motion(d), steps_of_answer(d)

    def marked_term(e: Equation) -> bool:
        inside = nodes(turned(e.rhs))
        terms = {"β", *(x for x in inside if isinstance(x, tuple) and x[0] != "entry")}
        return any(x in marked for x in inside if x in terms)

    def shown(e: Equation) -> Iterator[str]:
        planar = d.problem.get("group") in PLANE and e.lhs == "Ȧ"
        for x in ([*_of_angle(d)] if planar else []) or [e]:
            near = rounded(x.rhs, language) != x.rhs
            head = typeset(turned(x.lhs)) + literal(r" \approx " if near else " = ")
            own, plain = ((head + typeset(f(x.rhs))).plain().mathml() for f in (gathered, turned))
            lost = {*ARROW.findall(plain)} - {*ARROW.findall(own)}
            yield plain if near or lost else own

    listed = (*(e for e in steps[0].equations if e in told or marked_term(e)), *told)
    return tuple(
        (next(s.label for s in reversed(steps) if e in s.equations), x)
        for e in dict.fromkeys(listed)
        for x in shown(e)
    )
