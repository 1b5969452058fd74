"""An operator tree as LaTeX, in the notation of the paper, with marks where a line may break.

A mark is a control character that stands before an operator or after a comma; :func:`plain` takes
the marks away, :func:`pieces` cuts at them.  Inside braces (bars, fractions, matrices) nothing
breaks, so no mark survives there.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from fractions import Fraction

from ..language.show import ATOM, PRODUCT, SUM, has_norm, signed, swallows
from ..language.tree import Tree
from .escape import formula_ok, math_text, tex_text
from .juxtaposition import glue, number, outside
from .letters import NAMES, bar, parameter, paren
from .measure import measure
from .wrap import COMMA, FACTOR, WEDGE, Piece, fill
from .wrap import SUM as TERM

BREAKS = {"\x01": COMMA, "\x02": TERM, "\x03": WEDGE, "\x04": FACTOR}
AFTER_COMMA, BEFORE_TERM, BEFORE_WEDGE, BEFORE_FACTOR = BREAKS
MARKS = "".join(BREAKS)
SCRIPTED = re.compile(r"\^|'.*_")
OPENING = re.compile(r"\(|\[|\\(?:langle|lVert)(?![A-Za-z])")
CLOSING = re.compile(r"\)|\]|\\(?:rangle|rVert)(?![A-Za-z])")
VARIATIONS = ("δ", "δ′")
ENTRY_WIDTH = 24.0
"""An entry of a matrix wider than this (in em) is set on several lines."""

BARS = (r"\bar{", r"\overline{")

Shown = tuple[str, int]


def latex_tree(t: Tree, names: Mapping[str, str] | None = None) -> str:
    """A tree as the inside of a LaTeX formula; ``names`` says how names are written."""
    return plain(marked(t, names))


def marked(t: Tree, names: Mapping[str, str] | None = None) -> str:
    """The same with marks where a line may break."""
    return Printer(NAMES if names is None else names).show(t)[0]


def plain(tex: str) -> str:
    """Without marks."""
    return re.sub(f"[{MARKS}]", "", tex)


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


class Printer:
    """Trees to LaTeX: each method gives the text and how tightly it holds together."""

    def __init__(self, names: Mapping[str, str]):
        self.names = names

    def show(self, t: Tree) -> Shown:
        """A tree: marked LaTeX and SUM, PRODUCT or ATOM."""
        if isinstance(t, str):
            return self.name(t), ATOM
        if isinstance(t, (int, Fraction)):
            return number(t)
        if t[0] in ("add", "mul"):
            return self.sum(t)
        method = getattr(self, f"op_{t[0]}")
        shown: str | Shown = method(*t[1:])
        return (shown, ATOM) if isinstance(shown, str) else shown

    def name(self, name: str) -> str:
        """A name of the record; one that it does not declare is spelt safely."""
        if name in self.names:
            return self.names[name]
        return math_text(name) if formula_ok(name) else rf"\text{{{tex_text(name)}}}"

    def bare(self, t: Tree) -> str:
        """Inside brackets of its own."""
        return self.show(t)[0]

    def atom(self, t: Tree) -> str:
        """With parentheses where it is a sum or a product."""
        tex, level = self.show(t)
        return tex if level == ATOM else paren(tex)

    def base(self, t: Tree) -> str:
        """What may bear an exponent."""
        tex = self.atom(t)
        fraction = isinstance(t, Fraction) or (isinstance(t, tuple) and t[0] == "div")
        return paren(tex) if SCRIPTED.search(outside(tex)) or (fraction and tex[0] != "(") else tex

    def sum(self, t: Tree) -> Shown:
        """Terms with their signs."""
        terms = signed(t)
        out = ""
        for k, (sign, term) in enumerate(terms):
            tex, level = self.product(term)
            lead = "-" if sign == "−" else ""
            if k:
                lead = f"{BEFORE_TERM} - " if lead else f"{BEFORE_TERM} + "
            out += lead + (paren(tex) if level == SUM else tex)
        return out, PRODUCT if len(terms) == 1 and terms[0][0] == "+" else SUM

    def product(self, t: Tree) -> Shown:
        """Factors side by side; what reaches further than its neighbour is put in parentheses."""
        if not isinstance(t, tuple) or t[0] != "mul":
            return self.show(t)
        factors: tuple[Tree, ...] = t[1:]
        out = ""
        for k, f in enumerate(factors):
            tex, level = self.show(f)
            last = k == len(factors) - 1
            reaches = isinstance(f, tuple) and f[0] in ("tr", "sum", "wedge")
            inside = level == PRODUCT and not last and (k > 0 or reaches)
            wedge = k > 0 and isinstance(f, tuple) and f[0] == "wedge"
            if level == SUM or inside or wedge:
                tex = paren(tex)
            out += (glue(factors[k - 1], f) if k else "") + tex
        return out, PRODUCT

    def op_T(self, a: Tree) -> str:
        """A bar: over a letter, or over the whole."""
        if isinstance(a, str):
            return bar(self.name(a))
        if isinstance(a, tuple) and a[0] in ("at", "entry") and isinstance(a[1], str):
            letter = bar(self.name(a[1]))
            if "_" not in letter:
                return letter + self.indices(a[2:])
        return rf"\overline{{{plain(self.bare(a))}}}"

    def op_tr(self, a: Tree) -> Shown:
        """Tr of a word reaches to its end."""
        tex, level = self.show(a)
        space = r"\," if tex[:1] in "([" else " "
        return rf"\operatorname{{Tr}}{paren(tex) if level == SUM else space + tex}", PRODUCT

    def op_det(self, a: Tree) -> Shown:
        """det of a letter or of an expression."""
        inside = f" {self.name(a)}" if isinstance(a, str) else paren(self.bare(a))
        return rf"\det{inside}", PRODUCT

    def op_inv(self, a: Tree) -> str:
        """Inverse; braces, for a preamble may write a transpose as an exponent."""
        base = self.base(a)
        return (f"{{{base}}}" if base.startswith(BARS) else base) + "^{-1}"

    def op_pow(self, a: Tree, n: Tree) -> str:
        """Power; that of a function stands at its name."""
        named = isinstance(a, tuple) and a[0] == "fun" and a[1] != "sqrt"
        if named and isinstance(n, int) and n > 0:
            head, argument = self.show(a)[0].split("(", 1)
            return f"{head}^{{{n}}}({argument}"
        return f"{self.base(a)}^{{{plain(self.bare(n))}}}"

    def op_one(self) -> str:
        """Identity matrix."""
        return r"\mathbf{1}"

    def op_div(self, a: Tree, b: Tree) -> Shown | str:
        """A fraction; one too wide for its line is written with a stroke."""
        above, below = self.bare(a), self.bare(b)
        if max(measure(plain(above)), measure(plain(below))) > ENTRY_WIDTH:
            return f"{self.atom(a)}{BEFORE_FACTOR} / {self.atom(b)}", PRODUCT
        return rf"\frac{{{plain(above)}}}{{{plain(below)}}}"

    def op_inner(self, a: Tree, b: Tree) -> str:
        """Scalar product."""
        return rf"\langle {self.bare(a)},{AFTER_COMMA} {self.bare(b)}\rangle"

    def op_metric(self, m: Tree, a: Tree, b: Tree) -> str:
        """Scalar product of a metric."""
        return f"{self.op_inner(a, b)}_{{{plain(self.bare(m))}}}"

    def op_norm2(self, *a: Tree) -> str:
        """Square of a norm."""
        metric = f"_{{{plain(self.bare(a[0]))}}}" if len(a) == 2 else ""
        return rf"{self.norm(a[-1])}{metric}^{{2}}"

    def norm(self, a: Tree) -> str:
        """What has such strokes in itself is in brackets between them."""
        return rf"\lVert {paren(self.bare(a)) if has_norm(a) else self.bare(a)}\rVert"

    def op_fun(self, name: str, a: Tree) -> Shown | str:
        """An elementary function; the root of ‖a‖² is ‖a‖."""
        if name == "sqrt" and isinstance(a, tuple) and a[0] == "norm2" and len(a) == 2:
            return self.norm(a[1])
        if name == "sqrt":
            return rf"\sqrt{{{plain(self.bare(a))}}}"
        shown = {"atan": "arctan"}.get(name, name)
        return rf"\operatorname{{{shown if shown.isalpha() else ''}}}({self.bare(a)})", PRODUCT

    def op_bracket(self, a: Tree, b: Tree) -> str:
        """Bracket of matrices."""
        return f"[{self.bare(a)},{AFTER_COMMA} {self.bare(b)}]"

    def op_wedge(self, a: Tree, b: Tree) -> Shown:
        """Vector product."""
        sides = []
        for x in (a, b):
            tex, level = self.show(x)
            sides.append(paren(tex) if level == SUM or swallows(x) else tex)
        return rf"{sides[0]}{BEFORE_WEDGE} \wedge {sides[1]}", PRODUCT

    def op_hat(self, a: Tree) -> str:
        """The operator j."""
        return rf"\hatmap{{{plain(self.bare(a))}}}"

    def op_sum(self, index: Tree, body: Tree) -> Shown:
        """A sum over an index."""
        tex, level = self.show(body)
        lead = rf"\sum_{{{plain(self.bare(index))}}} "
        return lead + (paren(tex) if level == SUM else tex), PRODUCT

    def indices(self, indices: tuple[Tree, ...]) -> str:
        """Indices below."""
        shown = [plain(self.bare(i)) for i in indices]
        return f"_{{{(',' if any(len(i) > 1 for i in shown) else '').join(shown)}}}"

    def op_at(self, a: Tree, *indices: Tree) -> str:
        """A member of a family."""
        tex, level = self.show(a)
        return (paren(tex) if level != ATOM or re.search("[_^]", tex) else tex) + self.indices(
            indices
        )

    op_entry = op_at

    def op_call(self, f: Tree, *arguments: Tree) -> Shown | str:
        """A function at its arguments; a variation of one thing needs no parentheses."""
        if f == "∫":
            body = "" if arguments[0] == 1 else f"{self.bare(arguments[0])}"
            return rf"\int {body}\,\mathrm{{d}}m", PRODUCT
        lead = self.atom(f)
        simple = len(arguments) == 1 and self.show(arguments[0])[1] == ATOM
        if f in VARIATIONS and simple:
            return f"{lead} {self.bare(arguments[0])}"
        inside = f",{AFTER_COMMA} ".join(map(self.bare, arguments))
        return f"{lead}({inside})"

    def op_par(self, name: Tree) -> str:
        """A parameter, by its own name."""
        return parameter(name, self.names) if isinstance(name, str) else self.bare(name)

    def op_matrix(self, *rows: Tree) -> str:
        """A matrix."""
        shown = [" & ".join(self.cells(r)) for r in rows]
        gap = "[2pt]" if any("frac" in x for x in shown) else ""
        body = rf" \\{gap} ".join(shown)
        return rf"\begin{{pmatrix}} {body} \end{{pmatrix}}"

    def cells(self, row: Tree) -> list[str]:
        """The entries of a row."""
        if isinstance(row, tuple) and row[0] == "row":
            return [_stacked(self.bare(x)) for x in row[1:]]
        return [_stacked(self.bare(row))]

    def op_row(self, *entries: Tree) -> str:
        """A row that stands alone."""
        return rf"\begin{{pmatrix}} {' & '.join(self.cells(('row', *entries)))} \end{{pmatrix}}"


def _stacked(tex: str) -> str:
    """An entry of a matrix, on several lines where it is long."""
    if measure(plain(tex)) <= ENTRY_WIDTH:
        return guarded(plain(tex))
    lines = [guarded(x.text) for x in fill(pieces(tex), ENTRY_WIDTH, measure)]
    body = r" \\ ".join(lines)
    return rf"\begin{{array}}{{@{{}}l@{{}}}} {body} \end{{array}}"


def guarded(tex: str) -> str:
    r"""A line that may follow ``\\`` or start with a sign: no option, and a binary sign."""
    return "{}" + tex if tex[:1] in ("[", "*", "+", "-") and tex[:2] != "-\\" else tex
