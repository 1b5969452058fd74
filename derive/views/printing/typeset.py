"""A formula spelt twice, in LaTeX and in MathML Core, the parts that it is put together from, and
the lines that a long one is broken into, by estimates of their width.

The LaTeX has marks where a line may break, control characters that stand before an operator or
after a comma; the MathML has the same marks among its elements.  MathML Core as browsers have it:
no ``mathvariant`` but normal, so an upright d and a bold 1 are styled, and nothing stretches but
the parentheses of matrices.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from html import escape
from typing import NamedTuple, TypeVar

from .signs import LETTERS, SYMBOLS, Notation

# The width of a LaTeX formula, estimated well enough to choose where its lines break.

WIDTHLESS = "bar|overline|tilde|d?dot|hat|mathrm|mathsf|mathbf|operatorname|text|textsf|ensuremath"
WIDTHS = (
    (r"\\(?:begin|end)\{[a-z]+\}(?:\{[^{}]*\{\}[^{}]*\{\}\})?", 0.6),
    (rf"\\(?:{WIDTHLESS})(?![A-Za-z])", 0),
    (r"\\[td]?frac(?![A-Za-z])", 0.3),
    (r"\\(?:langle|rangle)(?![A-Za-z])|[()\[\]]", 0.4),
    (r"\\[lr]?Vert(?![A-Za-z])", 0.52),
    (r"\\wedge(?![A-Za-z])|\\cdot(?![A-Za-z])", 1.15),
    (r"\\sum(?![A-Za-z])", 1.7),
    (r"\\(?:quad|qquad)(?![A-Za-z])", 1.5),
    (r"\\,", 0.17),
    (r"\\(?:det|hatmap|sin|cos|tan|exp|log)(?![A-Za-z])", 1.5),
    (r"\\(?:sinh|cosh|tanh|arctan)(?![A-Za-z])", 2.2),
    (r"\\[a-z]+", 0.62),
    (r"\\[A-Z][A-Za-z]*|\\\\|[A-Z]", 0.78),
    (r"[mw]", 0.85),
    (r"[a-z0-9]", 0.53),
    (r" [+-] |[+-](?=[^}])", 1.25),
    (r"[=&]", 1.35),
    (r"[,;]", 0.46),
    (r"[']", 0.32),
    (r"[{}\s^_]", 0),
    (r".", 0.7),
)  # fmt: skip
WIDTH_PATTERN = re.compile("|".join(f"({pattern})" for pattern, _ in WIDTHS), re.S)
SCRIPT = re.compile(r"[_^](?:\{((?:[^{}]|\{[^{}]*\})*)\}|(\\[A-Za-z]+|[^{\\]))")


MATRIX = re.compile(r"\\begin\{pmatrix\}(.*?)\\end\{pmatrix\}", re.S)


@lru_cache(4096)  # terms in terms are measured again at every depth
def measure(tex: str) -> float:
    """The estimated width of a formula in em; rather too wide than too narrow."""
    wide = sum(
        1.8 + max(map(measure, re.split(r" \\\\(?:\[2pt\])? ", m[1]))) for m in MATRIX.finditer(tex)
    )
    tex = MATRIX.sub("", tex)
    small = sum(measure(m[1] or m[2] or "") for m in SCRIPT.finditer(tex))
    tex = SCRIPT.sub("", tex)
    rest = sum(WIDTHS[(m.lastindex or 1) - 1][1] for m in WIDTH_PATTERN.finditer(tex))
    return wide + 0.72 * small + rest


ROW, COMMA, SUM, WEDGE, FACTOR = -0.125, 0.0, 0.25, 0.5, 0.75
"""Depth added to a break by the operator it stands before: the less, the sooner."""

WIDTH = 100
"""The columns of a text, where nothing else is said."""

MARK = re.compile("[\u0300-\u036f]")
SIGN = re.compile(r"(?:\s|\{\})*[+−=-]")
"""What begins a term, not a factor."""


@dataclass(frozen=True)
class Piece:
    """A stretch of a formula that is not broken, and how deep the break before it would be."""

    text: str
    depth: float


START = 0.12
"""The part of a line that the beginning of a term takes which shares it with what is broken."""

P = TypeVar("P", bound=Piece)


@dataclass(frozen=True)
class Line:
    """One line, and how many times its break went inside a term."""

    text: str
    inside: int


def display_width(text: str) -> int:
    """The columns of a text in a terminal: combining marks take none."""
    return len(MARK.sub("", text))


def fill(
    pieces: Sequence[Piece], room: float, measure: Callable[[str], float], indent: float = 0
) -> list[Line]:
    """Lines no wider than ``room`` as far as the pieces allow; an inner line loses ``indent``."""
    whole = "".join(p.text for p in pieces).strip()
    if len(pieces) == 1 or measure(whole) <= room:
        return [Line(whole, 0)]
    lines: list[Line] = []
    current = ""
    for group in groups(pieces):
        text = "".join(p.text for p in group)
        if lines and not current and lines[-1].inside and not SIGN.match(text):
            closed = lines[-1].text + text.rstrip()  # a factor behind a bracket, as δt
            if measure(closed) <= room - indent * lines[-1].inside:
                lines[-1] = replace(lines[-1], text=closed)
                continue
        if measure((current + text).strip()) <= room:
            current += text
            continue
        if current and len(group) > 1 and measure(current.strip()) <= START * room:
            head, *rest = group  # a factor before a bracket, as k: not alone on its line
            group = [replace(head, text=current + head.text), *rest]
            text, current = current + text, ""
        if current:
            lines.append(Line(current.strip(), 0))
        if len(group) == 1 or measure(text.strip()) <= room:
            current = text
        else:
            first, *others = fill(group, room - indent, measure, indent)
            lines += [first, *(Line(line.text, line.inside + 1) for line in others)]
            current = ""
    return [*lines, Line(current.strip(), 0)] if current else lines


def groups(pieces: Sequence[P]) -> list[list[P]]:
    """The pieces in runs, cut at the shallowest breaks."""
    if len(pieces) == 1:
        return [[*pieces]]
    shallow = min(p.depth for p in pieces[1:])
    groups = [[pieces[0]]]
    for piece in pieces[1:]:
        if piece.depth == shallow:
            groups.append([])
        groups[-1].append(piece)
    return groups


BREAKS = {"\x01": COMMA, "\x02": SUM, "\x03": WEDGE, "\x04": FACTOR}
AFTER_COMMA, BEFORE_TERM, BEFORE_WEDGE, BEFORE_FACTOR = BREAKS
MARKS = "".join(BREAKS)
UNMARKED = dict.fromkeys(map(ord, MARKS))
OPERATORS = {SYMBOLS[c]: c for c in "∧×→↦∈≤≥≅≠≈±∘⊤−√"} | {c: c for c in "+=<>,/.:;|"}
OPERATORS |= {r"\cdot": "·", r"\int": "∫"}
FENCES = {SYMBOLS[c]: c for c in "⟨⟩‖"} | {r"\lVert": "‖", r"\rVert": "‖"}
FENCES |= {r"\lvert": "|", r"\rvert": "|"}
FENCES |= {c: c for c in "()[]"}
SPACES = {r"\quad": "1em", r"\qquad": "2em", r"\,": "0.17em", "\\ ": "0.3em"}
ACCENTS = {"dot": "˙", "tilde": "~", "hat": "^", "ddot": "¨"}
LITERAL = re.compile(rf"\\[A-Za-z]+|\\.|[0-9]+|[{MARKS}]|\S")
TOP = "<mo>⊤</mo>"
OPENED: dict[object, str] = {f'<mo stretchy="false">{c}</mo>': c for c in "(["}
PREFIXED = tuple("=≠≈≅<>≤≥([,{")


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
