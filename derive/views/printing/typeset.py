"""A formula spelt twice, in LaTeX and in MathML Core, and the parts that it is put together from.

The LaTeX has marks where a line may break, control characters that stand before an operator or
after a comma; the MathML has the same marks among its elements.  MathML Core as browsers have it:
no ``mathvariant`` but normal, so an upright d and a bold 1 are styled, and nothing stretches but
the parentheses of matrices.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from html import escape
from typing import NamedTuple

from .line_breaking import COMMA, FACTOR, WEDGE
from .line_breaking import SUM as TERM
from .signs import LETTERS, SYMBOLS, Notation

BREAKS = {"\x01": COMMA, "\x02": TERM, "\x03": WEDGE, "\x04": FACTOR}
AFTER_COMMA, BEFORE_TERM, BEFORE_WEDGE, BEFORE_FACTOR = BREAKS
MARKS = "".join(BREAKS)
UNMARKED = dict.fromkeys(map(ord, MARKS))
OPERATORS = {SYMBOLS[c]: c for c in "∧×→↦∈≤≥≅≠≈±∘⊤−√"} | {c: c for c in "+=<>,/.:;|"}
OPERATORS |= {r"\cdot": "·", r"\int": "∫"}
FENCES = {SYMBOLS[c]: c for c in "⟨⟩‖"} | {r"\lVert": "‖", r"\rVert": "‖"}
FENCES |= {r"\lvert": "|", r"\rvert": "|"}
FENCES |= {c: c for c in "()[]"}
SPACES = {r"\quad": "1em", r"\qquad": "2em", r"\,": "0.17em", "\\ ": "0.3em"}
ACCENTS = {"dot": "˙", "tilde": "~", "hat": "^"}
LITERAL = re.compile(rf"\\[A-Za-z]+|\\.|[0-9]+|[{MARKS}]|\S")
TOP = "<mo>⊤</mo>"
OPENED: dict[object, str] = {f'<mo stretchy="false">{c}</mo>': c for c in "(["}
PREFIXED = ("=", "(", "[", ",", "{")


class Sign(NamedTuple):
    """An operator of MathML, a prefix or an infix by what stands before it."""

    shown: str


class Scripted(NamedTuple):
    """An element of MathML with the markup of its index and exponent; maybe transposed by a ⊤."""

    base: str
    below: str = ""
    above: str = ""
    transposed: bool = False

    def markup(self) -> str:
        """The element with index and exponent; the index of a letter stands before its ⊤."""
        base, above = self.base, self.above
        if self.transposed:
            above, base = (above, f"<msup>{base}{TOP}</msup>") if above else (TOP, base)
        if base.startswith('<mo movablelimits="false">') and self.below:
            return f"<munder>{base}{one(self.below)}</munder>"
        if above and self.below:
            return f"<msubsup>{base}{one(self.below)}{one(above)}</msubsup>"
        if above:
            return f"<msup>{base}{one(above)}</msup>"
        return f"<msub>{base}{one(self.below)}</msub>" if self.below else base


Item = str | Sign | Scripted


@dataclass(frozen=True)
class Formula:
    """A formula: its LaTeX, with marks where a line may break, and its elements of MathML."""

    tex: str
    items: tuple[Item, ...] = ()

    def __add__(self, other: Formula) -> Formula:
        return Formula(self.tex + other.tex, self.items + other.items)

    def plain(self) -> Formula:
        """The formula without marks: inside braces nothing breaks."""
        if not any(x in self.tex for x in MARKS):
            return self
        return Formula(plain(self.tex), tuple(x for x in self.items if x not in BREAKS))

    def row(self) -> str:
        """The MathML of the formula as it stands in braces."""
        return markup(self.items, before="{")

    def mathml(self, *, follows: bool = False) -> str:
        """The formula as one MathML element ``math``.

        ``follows``: it continues another, whose operator it starts with.
        """
        return f"<math>{markup(self.items, follows=follows)}</math>"


def plain(tex: str) -> str:
    """LaTeX without its marks."""
    return tex.translate(UNMARKED)


def markup(items: Sequence[Item], *, before: str = "", follows: bool = False) -> str:
    """Elements of MathML in a row; a + or − after a relation or parenthesis is a prefix."""
    found: list[str] = []
    for x in items:
        if x in BREAKS:
            continue
        if isinstance(x, Sign):
            form = "infix" if follows and not found else ""
            form = "prefix" if not form and x.shown in "+−±" and before in PREFIXED else form
            found.append(f'<mo form="{form}">' if form else "<mo>")
            found[-1] += f"{escape(x.shown)}</mo>"
        else:
            found.append(element(x))
        before = x.shown if isinstance(x, Sign) else OPENED.get(x, "")
    return "".join(found)


def element(x: Item) -> str:
    """The MathML of one element by itself."""
    if isinstance(x, Sign):
        return f"<mo>{escape(x.shown)}</mo>"
    return x if isinstance(x, str) else x.markup()


def one(inside: str) -> str:
    """Markup as one child, in an ``mrow``."""
    return f"<mrow>{inside}</mrow>"


# -- parts ---------------------------------------------------------------------------------------


@lru_cache(1024)
def literal(tex: str) -> Formula:
    """The formula of signs, brackets, spaces, numbers and letters, as LaTeX has them."""
    return Formula(tex, tuple(_item(x) for x in LITERAL.findall(tex)))


def _item(token: str) -> Item:
    """The element of MathML of one token of LaTeX."""
    if token in OPERATORS:
        return Sign(OPERATORS[token])
    if token in FENCES:
        return f'<mo stretchy="false">{FENCES[token]}</mo>'
    if token in SPACES:
        return f'<mspace width="{SPACES[token]}"></mspace>'
    if token in BREAKS:
        return token
    if token.isdigit():
        return f"<mn>{token}</mn>"
    letter = LETTERS.get(token[1:], token) if token[0] == "\\" else token
    return '<mi mathvariant="normal">∂</mi>' if letter == "∂" else f"<mi>{escape(letter)}</mi>"


def word(tex: str, shown: str) -> Formula:
    """An upright word, as det."""
    return Formula(tex, (f"<mi>{escape(shown)}</mi>",))


FUNCTIONS = ("arctan", "cos", "cosh", "exp", "log", "sin", "sinh", "tan", "tanh")
"""The functions that LaTeX has by their names."""


def operator(name: str, *, near: bool) -> Formula:
    """The name of a function, as Tr or sin.

    ``near``: it is followed by a bracket or a script, and needs no gap.
    """
    gap = () if near else ('<mspace width="0.17em"></mspace>',)
    tex = rf"\{name}" if name in FUNCTIONS else rf"\operatorname{{{name}}}"
    return Formula(tex, (f"<mi>{escape(name)}</mi>", *gap))


def upright(letter: str) -> Formula:
    """An upright letter, as the d of a differential."""
    return Formula(rf"\mathrm{{{letter}}}", (f'<mi mathvariant="normal">{letter}</mi>',))


def sans(tex: str, shown: str) -> Formula:
    """A parameter of the user, sans serif."""
    markup = f'<mi mathvariant="normal" class="parameter">{escape(shown)}</mi>'
    return Formula(rf"\mathsf{{{tex}}}", (markup,))


IDENTITY = Formula(r"\mathbf{1}", ('<mn class="bold">1</mn>',))
SUM_SIGN = Formula(r"\sum", ('<mo movablelimits="false">∑</mo>',))


def group(f: Formula) -> Formula:
    """The formula in braces: one element."""
    return Formula(f"{{{f.tex}}}", (one(f.row()),))


def tagged(f: Formula, mark: str, *, term: bool) -> Formula:
    """The formula with the number of its arrow; is it a ``term``, more than a letter?"""
    f = f.plain()
    kind = ' class="vector"' if term else ""
    return Formula(f.tex, (f'<mrow data-arrow="{mark}"{kind}>{f.row()}</mrow>',))


def lowered(f: Formula, index: Formula) -> Formula:
    """The formula with an index at its last element."""
    index, last = index.plain(), _last(f)
    items = (*f.items[:-1], last._replace(below=last.below + index.row()))
    return Formula(f"{f.tex}_{{{index.tex}}}", items)


def raised(f: Formula, exponent: Formula) -> Formula:
    """The formula with an exponent at its last element."""
    exponent, last = exponent.plain(), _last(f)
    items = (*f.items[:-1], last._replace(above=last.above + exponent.row()))
    return Formula(f"{f.tex}^{{{exponent.tex}}}", items)


def primed(f: Formula, count: int = 1) -> Formula:
    """The formula with primes: ′ is a raised letter, which fonts raise again in an exponent."""
    if not count:
        return f
    last = _last(f)
    base = f'<mrow>{last.base}<mo lspace="0" rspace="0">{"′" * count}</mo></mrow>'
    return Formula(f.tex + "'" * count, (*f.items[:-1], last._replace(base=base)))


def _last(f: Formula) -> Scripted:
    """The last element of a formula, which is to bear a script."""
    last = f.items[-1]
    return last if isinstance(last, Scripted) else Scripted(element(last))


def accented(name: str, f: Formula, tex: str) -> Formula:
    """The formula with an accent over it: ``name`` of ACCENTS; ``tex``: the LaTeX of the whole."""
    mark = f'<mo stretchy="false">{ACCENTS[name]}</mo>'
    return Formula(tex, (f'<mover accent="true">{one(f.row())}{mark}</mover>',))


def barred(f: Formula, tex: str, notation: Notation, *, letter: bool) -> Formula:
    """The transpose of a letter or of an expression, with a bar or a ⊤; ``tex``: its LaTeX."""
    inside = f.plain().row()
    if notation.transpose == "bar":
        # fonts stretch no bar over an expression, and set that of a letter on its stroke
        return Formula(tex, (f'<mrow class="overline">{inside}</mrow>',))
    return Formula(tex, (Scripted(one(inside if letter else fenced(inside)), transposed=True),))


def hat(f: Formula, notation: Notation) -> Formula:
    """The skew matrix of a vector, as j(x) or as x with a raised wedge."""
    f = f.plain()
    inside = fenced(f.row())
    markup = f"<mrow><mi>j</mi>{inside}</mrow>"
    if notation.hat != "j":
        markup = f"<msup>{one(inside)}<mo>∧</mo></msup>"
    return Formula(rf"\hatmap{{{f.tex}}}", (markup,))


def fenced(inside: str) -> str:
    """Markup in parentheses."""
    return f'<mo stretchy="false">(</mo>{inside}<mo stretchy="false">)</mo>'


def fraction(a: Formula, b: Formula, tex: str = "") -> Formula:
    """The fraction a over b; ``tex``: its LaTeX where that is not a plain ``frac``."""
    a, b = a.plain(), b.plain()
    shown = f"<mfrac>{one(a.row())}{one(b.row())}</mfrac>"
    return Formula(tex or rf"\frac{{{a.tex}}}{{{b.tex}}}", (shown,))


def root(f: Formula) -> Formula:
    """The square root of a formula."""
    f = f.plain()
    return Formula(rf"\sqrt{{{f.tex}}}", (f"<msqrt>{f.row()}</msqrt>",))


def matrix(rows: Sequence[Sequence[Formula]]) -> Formula:
    """A matrix of entries, in parentheses."""
    shown = [" & ".join(x.tex for x in row) for row in rows]
    gap = "[2pt]" if any("frac" in x for x in shown) else ""
    cells = ("".join(f"<mtd>{markup(x.items)}</mtd>" for x in row) for row in rows)
    body = "".join(f"<mtr>{x}</mtr>" for x in cells)
    joined = rf" \\{gap} ".join(shown)
    return Formula(
        rf"\begin{{pmatrix}} {joined} \end{{pmatrix}}",
        (f"<mrow><mo>(</mo><mtable>{body}</mtable><mo>)</mo></mrow>",),
    )


def stacked(lines: Sequence[Formula]) -> Formula:
    """The lines of a matrix entry that is too long for one, below each other."""
    body = "".join(f"<mtr><mtd>{markup(x.items)}</mtd></mtr>" for x in lines)
    tex = r" \\ ".join(x.tex for x in lines)
    return Formula(
        rf"\begin{{array}}{{@{{}}l@{{}}}} {tex} \end{{array}}",
        (f'<mtable class="lines">{body}</mtable>',),
    )


def text(tex: str, words: str) -> Formula:
    """Words in a formula; ``tex``: their LaTeX."""
    return Formula(tex, (f"<mtext>{escape(words).replace(' ', chr(160))}</mtext>",))


def cut(f: Formula) -> list[Formula]:
    """The formula cut at its marks, which stay at the heads of the pieces."""
    texts = re.split(f"(?=[{MARKS}])", f.tex)
    pieces: list[list[Item]] = [[]]
    for x in f.items:
        if x in BREAKS:
            pieces.append([])
        pieces[-1].append(x)
    return [Formula(a, tuple(b)) for a, b in zip(texts, pieces, strict=True)]
