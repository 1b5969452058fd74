"""An operator tree as a formula in the notation of the paper, in LaTeX and in MathML at once.

Inside braces (bars, fractions, matrices) nothing breaks, so no mark survives there.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from operator import add

from ...language.show import (
    ATOM,
    FIELD_OPERATORS,
    PRODUCT,
    SUM,
    has_norm,
    has_size,
    signed,
    swallows,
)
from ...language.tree import Tree, sized
from .letters import NAMES, named, number, outside, parameter, separator, transposed
from .sentences import formula_ok, spelt
from .signs import Notation, tex_text
from .typeset import (
    AFTER_COMMA,
    BEFORE_FACTOR,
    BEFORE_TERM,
    BEFORE_WEDGE,
    BREAKS,
    IDENTITY,
    MARKS,
    SUM_SIGN,
    Formula,
    Piece,
    barred,
    cut,
    fill,
    fraction,
    group,
    hat,
    literal,
    lowered,
    matrix,
    measure,
    operator,
    plain,
    raised,
    root,
    stacked,
    tagged,
    text,
    upright,
    word,
)

SCRIPTED = re.compile(r"\^|'.*_")
OPENING = re.compile(r"\(|\[|\\(?:langle|lVert|lvert)(?![A-Za-z])")
CLOSING = re.compile(r"\)|\]|\\(?:rangle|rVert|rvert)(?![A-Za-z])")
VARIATIONS = ("δ", "δ′")
ENTRY_WIDTH = 24.0
"""The width, in em, above which an entry of a matrix is set on several lines."""

BARS = (r"\bar{", r"\overline{")

Shown = tuple[Formula, int]
"""A formula, and how tightly it holds together: SUM, PRODUCT or ATOM."""


def latex_tree(t: Tree, names: Mapping[str, str] | None = None) -> str:
    """A tree as the inside of a LaTeX formula; ``names`` says how names are written."""
    return plain(marked(t, names))


def marked(t: Tree, names: Mapping[str, str] | None = None) -> str:
    """A tree as LaTeX with marks where a line may break; ``names``: as in latex_tree."""
    return formula(t, names).tex


def formula(
    t: Tree,
    names: Mapping[str, str] | None = None,
    notation: Notation | None = None,
    marks: Mapping[Tree, str] | None = None,
) -> Formula:
    """A tree as a formula, LaTeX and MathML; ``names`` says how names are written, ``marks`` which
    trees have a mark in the MathML."""
    known = NAMES if names is None else names
    return FormulaPrinter(known, notation or Notation(), marks or {}).bare(t)


def pieces(tex: str) -> list[Piece]:
    """Marked LaTeX cut at its marks, with the depth of brackets at each."""
    found, depth, strength = [], 0, 0.0
    for chunk in re.split(f"([{MARKS}])", tex):
        if chunk in BREAKS:
            strength = depth + BREAKS[chunk]
            continue
        found.append(Piece(chunk, strength))
        depth += len(OPENING.findall(chunk)) - len(CLOSING.findall(chunk))
    return found


@dataclass(frozen=True)
class Cut(Piece):
    """A piece of a formula: its LaTeX, the depth of the break before it, and the formula itself."""

    formula: Formula


def cut_up(f: Formula) -> list[Cut]:
    """The pieces of a formula, cut where a line may break."""
    both = zip(pieces(f.tex), cut(f), strict=True)
    return [Cut(x.text, x.depth, part) for x, part in both]


def paren(f: Formula) -> Formula:
    """The formula in parentheses."""
    return literal("(") + f + literal(")")


def joined(parts: list[Formula], between: Formula) -> Formula:
    """The formulas one after the other, with ``between`` between them."""
    return reduce(lambda a, b: a + between + b, parts)


def as_factor(shown: Shown) -> Formula:
    """A formula as a factor, in parentheses where it is a sum or a product."""
    f, level = shown
    return f if level == ATOM else paren(f)


COMMA_SPACE = literal(f",{AFTER_COMMA} ")


class FormulaPrinter:
    """Trees to formulas; ``op_X`` is the formula of the operator X of its operands."""

    def __init__(self, names: Mapping[str, str], notation: Notation, marks: Mapping[Tree, str]):
        self.names, self.notation, self.marks = names, notation, marks

    def show(self, t: Tree) -> Shown:
        """The formula of a tree, and SUM, PRODUCT or ATOM: how tightly it holds together."""
        if isinstance(t, (int, Fraction)):
            return number(t)
        if isinstance(t, tuple) and t[0] in ("add", "mul"):
            return self.sum(t)
        if isinstance(t, str):
            return self.marked(t, self.name(t)), ATOM
        method = getattr(self, f"op_{t[0]}")
        shown: Formula | Shown = method(*t[1:])
        f, level = shown if isinstance(shown, tuple) else (shown, ATOM)
        return self.marked(t, f), level

    def marked(self, t: Tree, f: Formula) -> Formula:
        """The formula of a tree with the mark that it has, if any."""
        if t not in self.marks:
            return f
        term = isinstance(t, tuple) and t[0] != "entry"
        return tagged(f, self.marks[t], term=term)

    def name(self, name: str) -> Formula:
        """The formula of a name of the record; one that it does not declare is spelt safely."""
        if name in self.names:
            return named(self.names[name])
        return spelt(name) if formula_ok(name) else text(rf"\text{{{tex_text(name)}}}", name)

    def bare(self, t: Tree) -> Formula:
        """The formula of a tree that stands in brackets already."""
        return self.show(t)[0]

    def atom(self, t: Tree) -> Formula:
        """The formula of a tree as a factor, in parentheses where it is a sum or a product."""
        return as_factor(self.show(t))

    def base(self, t: Tree) -> Formula:
        """The formula of a tree that is to bear an exponent."""
        f = self.atom(t)
        over = isinstance(t, Fraction) or (isinstance(t, tuple) and t[0] == "div")
        return paren(f) if SCRIPTED.search(outside(f.tex)) or (over and f.tex[0] != "(") else f

    def sum(self, t: Tree) -> Shown:
        """A sum: its terms with their signs."""
        terms = signed(t)
        out = Formula("")
        for k, (sign, term) in enumerate(terms):
            f, level = self.product(term)
            mark = "-" if sign == "−" else "+"
            lead = f"{BEFORE_TERM} {mark} " if k else mark.strip("+")
            out += literal(lead) + (paren(f) if level == SUM else f)
        return out, PRODUCT if len(terms) == 1 and terms[0][0] == "+" else SUM

    def product(self, t: Tree) -> Shown:
        """A product: factors side by side; those that reach too far are in parentheses."""
        if not isinstance(t, tuple) or t[0] != "mul":
            return self.show(t)
        factors: tuple[Tree, ...] = t[1:]
        out = Formula("")
        for k, x in enumerate(factors):
            f, level = self.show(x)
            last = k == len(factors) - 1
            reaches = isinstance(x, tuple) and x[0] in ("tr", "det", "sum", "wedge")
            inside = level == PRODUCT and not last and (k > 0 or reaches)
            wedge = k > 0 and isinstance(x, tuple) and x[0] == "wedge"
            if level == SUM or inside or wedge:
                f = paren(f)
            out += (separator(factors[k - 1], x) if k else Formula("")) + f
        return self.marked(t, out), PRODUCT

    def op_T(self, a: Tree) -> Formula:
        """The transpose: a bar over a letter, or over the whole."""
        if isinstance(a, str):
            return self.transposed(a)
        if isinstance(a, tuple) and a[0] in ("at", "entry") and isinstance(a[1], str):
            letter = self.transposed(a[1])
            if "_" not in letter.tex:
                return self.indexed(letter, a[2:])
        inside = self.bare(a).plain()
        return barred(inside, rf"\overline{{{inside.tex}}}", self.notation, letter=False)

    def transposed(self, name: str) -> Formula:
        """The transpose of a name."""
        return transposed(self.name(name).tex, self.notation)

    def op_tr(self, a: Tree) -> Shown:
        """The trace, which reaches to the end of a word; a sum is in parentheses."""
        f, level = self.show(a)
        trace = operator("Tr", near=level == SUM)
        if level == SUM:
            return trace + paren(f), PRODUCT
        return trace + (literal(r"\,") if f.tex[:1] in "([" else Formula(" ")) + f, PRODUCT

    def op_det(self, a: Tree) -> Shown:
        """The determinant of a letter or of an expression."""
        det = word(r"\det", "det")
        if not isinstance(a, str):
            return det + paren(self.bare(a)), PRODUCT
        gap = Formula(" ", literal(r"\,").items)
        return det + gap + self.name(a), PRODUCT

    def op_inv(self, a: Tree) -> Formula:
        """The inverse; a barred base is in braces: a preamble may write ⊤ as an exponent."""
        base = self.base(a)
        return raised(group(base) if base.tex.startswith(BARS) else base, literal("-1"))

    def op_pow(self, a: Tree, n: Tree) -> Formula:
        """A power; that of a function stands at its name."""
        named = isinstance(a, tuple) and a[0] == "fun" and a[1] != "sqrt"
        if named and isinstance(n, int) and n > 0:
            return self.function(a[1], self.bare(a[2]), literal(str(n)))  # type: ignore[index]
        return raised(self.base(a), self.bare(n))

    def op_one(self) -> Formula:
        """The identity matrix."""
        return IDENTITY

    def op_div(self, a: Tree, b: Tree) -> Shown | Formula:
        """A fraction; one too wide for its line is written with a stroke."""
        shown = self.show(a), self.show(b)
        above, below = (f.plain() for f, _ in shown)
        if max(measure(above.tex), measure(below.tex)) > ENTRY_WIDTH:
            stroke = literal(f"{BEFORE_FACTOR} / ")
            return joined([as_factor(x) for x in shown], stroke), PRODUCT
        return fraction(above, below)

    def op_inner(self, a: Tree, b: Tree) -> Formula:
        """The scalar product ⟨a, b⟩."""
        both = self.bare(a) + COMMA_SPACE + self.bare(b)
        return literal(r"\langle ") + both + literal(r"\rangle")

    def op_metric(self, m: Tree, a: Tree, b: Tree) -> Formula:
        """The scalar product ⟨a, b⟩_m of a metric."""
        return lowered(self.op_inner(a, b), self.bare(m))

    def op_norm2(self, *a: Tree) -> Formula:
        """The square of a norm, ‖a‖², or ‖a‖²_m of a metric."""
        norm = self.norm(a[-1])
        return raised(lowered(norm, self.bare(a[0])) if len(a) == 2 else norm, literal("2"))

    def norm(self, a: Tree) -> Formula:
        """The norm ‖a‖; where a has such strokes in itself, it is in parentheses."""
        inside = paren(self.bare(a)) if has_norm(a) else self.bare(a)
        return literal(r"\lVert ") + inside + literal(r"\rVert")

    def op_fun(self, name: str, a: Tree) -> Shown | Formula:
        """An elementary function; the root of ‖a‖² is ‖a‖, that of x² is |x|."""
        if (x := sized(("fun", name, a))) is not None:
            inside = paren(self.bare(x)) if has_size(x) else self.bare(x)
            return literal(r"\lvert ") + inside + literal(r"\rvert")
        if name == "sqrt" and isinstance(a, tuple) and a[0] == "norm2" and len(a) == 2:
            return self.norm(a[1])
        if name == "sqrt":
            return root(self.bare(a))
        return self.function(name, self.bare(a))

    def function(self, name: str, a: Formula, power: Formula | None = None) -> Formula:
        """An elementary function by its name; ``power``: its exponent."""
        shown = {"atan": "arctan"}.get(name, name)
        head = operator(shown if shown.isalpha() else "", near=True)
        return (head if power is None else raised(head, power)) + paren(a)

    def op_bracket(self, a: Tree, b: Tree) -> Formula:
        """The bracket [a, b] of matrices."""
        return literal("[") + self.bare(a) + COMMA_SPACE + self.bare(b) + literal("]")

    def op_wedge(self, a: Tree, b: Tree) -> Shown:
        """The vector product a ∧ b."""
        sides = []
        for x in (a, b):
            f, level = self.show(x)
            sides.append(paren(f) if level == SUM or swallows(x) else f)
        return joined(sides, literal(rf"{BEFORE_WEDGE} \wedge ")), PRODUCT

    def op_hat(self, a: Tree) -> Formula:
        """The skew matrix j(a) of a vector."""
        return hat(self.bare(a), self.notation)

    def op_nabla(self, a: Tree) -> Formula:
        """The derivative ∇_a along a field."""
        return lowered(literal(r"\nabla"), self.bare(a))

    def op_sum(self, index: Tree, body: Tree) -> Shown:
        """The sum of ``body`` over an index."""
        f, level = self.show(body)
        lead = lowered(SUM_SIGN, self.bare(index)) + Formula(" ")
        return lead + (paren(f) if level == SUM else f), PRODUCT

    def indexed(self, f: Formula, indices: tuple[Tree, ...]) -> Formula:
        """A formula with indices below it."""
        shown = [self.bare(i).plain() for i in indices]
        apart = literal("," if any(len(i.tex) > 1 for i in shown) else "")
        if not apart.tex and all(i.tex.isdigit() for i in shown):  # one number of all digits
            return lowered(f, literal("".join(i.tex for i in shown)))
        return lowered(f, joined(shown, apart))

    def op_at(self, a: Tree, *indices: Tree) -> Formula:
        """A member of a family, or an entry, by its indices."""
        f, level = (self.name(a), ATOM) if isinstance(a, str) else self.show(a)
        scripted = level != ATOM or re.search("[_^]", f.tex)
        return self.indexed(paren(f) if scripted else f, indices)

    op_entry = op_at

    def op_call(self, f: Tree, *arguments: Tree) -> Shown | Formula:
        """A function at its arguments; a variation of one thing needs no parentheses."""
        if f == "∫":
            body = Formula("") if arguments[0] == 1 else self.bare(arguments[0])
            end = literal(r"\,") + upright("d") + literal("m")
            return literal(r"\int ") + body + end, PRODUCT
        lead = self.atom(f)
        simple = len(arguments) == 1 and self.show(arguments[0])[1] == ATOM
        if f in FIELD_OPERATORS and isinstance(arguments[0], str):
            gap = Formula(" ") if f in ("Δ", "∇") else literal(r"\,")
            return lead + gap + self.name(arguments[0]), PRODUCT
        if f in VARIATIONS and simple:
            return lead + Formula(" ") + self.bare(arguments[0])
        return lead + paren(joined([*map(self.bare, arguments)], COMMA_SPACE))

    def op_par(self, name: Tree) -> Formula:
        """A parameter, by its own name."""
        return parameter(name, self.names) if isinstance(name, str) else self.bare(name)

    def op_matrix(self, *rows: Tree) -> Formula:
        """A matrix of rows; a row that is no ``row`` is one entry."""
        return matrix([self.cells(r) for r in rows])

    def cells(self, row: Tree) -> list[Formula]:
        """The entries of a row of a matrix."""
        if isinstance(row, tuple) and row[0] == "row":
            return [_stacked(self.bare(x)) for x in row[1:]]
        return [_stacked(self.bare(row))]

    def op_row(self, *entries: Tree) -> Formula:
        """A row that stands alone, as a matrix."""
        return matrix([self.cells(("row", *entries))])


def _stacked(f: Formula) -> Formula:
    """An entry of a matrix, on several lines where it is wider than ENTRY_WIDTH."""
    whole = f.plain()
    if measure(whole.tex) <= ENTRY_WIDTH:
        return Formula(guarded(whole.tex), whole.items)
    parts = cut(f)
    lines, at = [], 0
    for line in fill(pieces(f.tex), ENTRY_WIDTH, measure):
        start, text = at, ""
        while text.strip() != line.text:
            text += plain(parts[at].tex)
            at += 1
        items = reduce(add, parts[start:at]).plain().items
        lines.append(Formula(guarded(line.text), items))
    return stacked(lines)


def guarded(tex: str) -> str:
    r"""LaTeX that may follow ``\\`` or start with a sign: ``{}`` keeps it from being read
    otherwise."""
    return "{}" + tex if tex[:1] in ("[", "*", "+", "-") and tex[:2] != "-\\" else tex
