"""MathML of the LaTeX that the other views print: a small closed language, read by descent.

MathML Core as browsers have it: no ``mathvariant`` but normal, so an upright d and a bold 1 are
styled, and nothing stretches but the parentheses of matrices.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from html import escape

from .escape import GREEK
from .notation import Notation

TOKEN = re.compile(
    r"\\text\{(?:[^{}]|\{[^{}]*\})*\}"
    r"|\\begin\{[a-z]+\}(?:\{@\{\}l@\{\}\})?|\\end\{[a-z]+\}|\\[A-Za-z]+|\\.|[0-9]+(?:\.[0-9]+)?|'+|\S"
)
LETTERS = GREEK | {
    "varphi": "φ", "phi": "ϕ", "varpi": "ϖ", "lambda": "λ", "Lambda": "Λ", "partial": "∂",
    "nabla": "∇", "ell": "ℓ",
}  # fmt: skip
OPERATORS = {
    "wedge": "∧", "cdot": "·", "times": "×", "to": "→", "in": "∈", "le": "≤", "ge": "≥",
    "cong": "≅", "neq": "≠", "circ": "∘", "ll": "≪", "gg": "≫", "int": "∫", "mapsto": "↦",
    "ltimes": "⋉",
}  # fmt: skip
FENCES = {"langle": "⟨", "rangle": "⟩", "lVert": "‖", "rVert": "‖", "Vert": "‖"}
ACCENTS = {"dot": "˙", "tilde": "~", "hat": "^"}
SPACES = {"quad": "1em", "qquad": "2em", ",": "0.17em", " ": "0.3em", ";": "0.28em"}
SIGNS = {"-": "−", "*": "∗"}
TOP = "<mo>⊤</mo>"
RAISED = f"{TOP}</msup>"
ENDS = {"}", "&", "\\\\"}
PREFIXED = ("=", "(", "[", ",", "{")


def mathml(tex: str, notation: Notation | None = None, *, follows: bool = False) -> str:
    """A formula as an element; ``follows``: it continues another, whose operator it starts with."""
    parser = _Parser(TOKEN.findall(tex), notation or Notation())
    parser.infix = follows
    return f"<math>{parser.row()}</math>"


@dataclass
class _Parser:
    """Reads tokens from the left; each method returns markup."""

    tokens: list[str]
    notation: Notation
    at: int = 0
    infix: bool = False

    def peek(self) -> str:
        """The next token, empty at the end."""
        return self.tokens[self.at] if self.at < len(self.tokens) else ""

    def take(self) -> str:
        """The next token, which is passed."""
        token = self.peek()
        self.at += 1
        return token

    def row(self) -> str:
        """Atoms with their scripts, up to what ends a group or a cell."""
        out = []
        while self.peek() and self.peek() not in ENDS and not self.peek().startswith("\\end{"):
            out.append(self.scripted())
        return "".join(out)

    def scripted(self) -> str:
        """An atom with primes, an exponent and an index."""
        base = self.atom()
        self.infix = False
        above, below = "", ""
        raised = base.startswith("<msup>") and base.endswith(RAISED)
        base = base.removeprefix("<msup>").removesuffix(RAISED) if raised else base
        while self.peek()[:1] in ("^", "_", "'") and self.peek():
            token = self.take()
            if token == "^":
                above += self.argument()
            elif token == "_":
                below += self.argument()
            else:
                # ′ is a raised letter, which fonts raise again in an exponent
                base = f'<mrow>{base}<mo lspace="0" rspace="0">{"′" * len(token)}</mo></mrow>'
        if raised:  # the index and the prime of a letter stand before its ⊤
            above, base = (above, f"<msup>{base}{RAISED}") if above else (TOP, base)
        if base.startswith('<mo movablelimits="false">') and below:
            return f"<munder>{base}{_one(below)}</munder>"
        if above and below:
            return f"<msubsup>{base}{_one(below)}{_one(above)}</msubsup>"
        if above:
            return f"<msup>{base}{_one(above)}</msup>"
        return f"<msub>{base}{_one(below)}</msub>" if below else base

    def argument(self) -> str:
        """What stands in braces, or one token; of a number one digit."""
        token = self.take()
        if token == "{":
            inside = self.row()
            self.take()
            return inside
        if token[:1].isdigit() and len(token) > 1:
            self.at -= 1
            self.tokens[self.at] = token[1:]
            token = token[0]
        return self.symbol(token)

    def words(self) -> str:
        """The plain text in the braces that follow."""
        depth, found = 0, []
        while token := self.take():
            depth += (token == "{") - (token == "}")
            if depth == 0:
                break
            if token not in "{}":
                found.append(" " if token == "\\ " else token)
        return "".join(found)

    def atom(self) -> str:
        """A letter, a number, a group, or a command with its arguments."""
        token = self.take()
        if token == "{":
            inside = self.row()
            self.take()
            return f"<mrow>{inside}</mrow>" if inside else ""
        if token.startswith("\\begin{"):
            return self.table(token)
        if token.startswith("\\text{"):
            words = re.sub(r"\\[a-z]+\{\}|\\[a-z]+|[\\{}]", "", token[6:-1])
            return f"<mtext>{escape(words).replace(' ', chr(160))}</mtext>"
        return self.symbol(token)

    def symbol(self, token: str) -> str:
        """One token with the arguments it takes."""
        name = token[1:]
        if not token.startswith("\\"):
            return self.character(token)
        if name in LETTERS:
            upright = ' mathvariant="normal"' if name == "partial" else ""
            return f"<mi{upright}>{LETTERS[name]}</mi>"
        if name in OPERATORS:
            return f"<mo{self.form()}>{OPERATORS[name]}</mo>"
        if name in FENCES:
            return f'<mo stretchy="false">{FENCES[name]}</mo>'
        if name in ACCENTS:
            return _over(self.argument(), ACCENTS[name])
        if name in SPACES:
            return f'<mspace width="{SPACES[name]}"></mspace>'
        method = getattr(self, f"do_{name}", None)
        return str(method()) if method else f"<mtext>{escape(name)}</mtext>"

    def form(self, token: str = "") -> str:
        """A sign after a relation or a parenthesis is a prefix; what continues a formula is not."""
        if self.infix:
            return ' form="infix"'
        before = self.tokens[self.at - 2] if self.at > 1 else ""
        return ' form="prefix"' if token in "+-" and before in PREFIXED and token else ""

    def character(self, token: str) -> str:
        """A letter, a number or a sign."""
        if token[:1].isdigit():
            return f"<mn>{token}</mn>"
        if token.isalpha():
            return f"<mi>{escape(token)}</mi>"
        if token in "()[]":
            return f'<mo stretchy="false">{token}</mo>'
        return f"<mo{self.form(token)}>{SIGNS.get(token, escape(token))}</mo>"

    def table(self, token: str) -> str:
        """A matrix in parentheses, or lines under each other."""
        rows, cells = [], []
        while True:
            cells.append(f"<mtd>{self.row()}</mtd>")
            end = self.take()
            if end == "&":
                continue
            rows.append(f"<mtr>{''.join(cells)}</mtr>")
            cells = []
            if end != "\\\\":
                break
            if self.tokens[self.at : self.at + 4] == ["[", "2", "p", "t"]:
                self.at += 5
        body = "".join(rows)
        if "array" in token:
            return f'<mtable class="lines">{body}</mtable>'
        return f"<mrow><mo>(</mo><mtable>{body}</mtable><mo>)</mo></mrow>"

    # -- commands ----------------------------------------------------------------------------

    def do_bar(self) -> str:
        """The transpose of a letter."""
        return self.transpose(self.argument(), letter=True)

    def do_overline(self) -> str:
        """The transpose of an expression."""
        return self.transpose(self.argument(), letter=False)

    def transpose(self, inside: str, *, letter: bool) -> str:
        """With a bar or a ⊤."""
        if self.notation.transpose == "bar":
            # fonts stretch no bar over an expression, and set that of a letter on its stroke
            return f'<mrow class="overline">{inside}</mrow>'
        base = inside if letter else _fenced(inside)
        return f"<msup><mrow>{base}</mrow>{RAISED}"

    def do_hatmap(self) -> str:
        """The skew matrix of a vector."""
        inside = self.argument()
        if self.notation.hat == "j":
            return f"<mrow><mi>j</mi>{_fenced(inside)}</mrow>"
        return f"<msup><mrow>{_fenced(inside)}</mrow><mo>∧</mo></msup>"

    def do_operatorname(self) -> str:
        """Tr, sin, …: upright, apart from what follows."""
        word = f"<mi>{escape(self.words())}</mi>"
        near = self.peek() in ("(", "^", "_", "")
        return word if near else f'{word}<mspace width="0.17em"></mspace>'

    def do_det(self) -> str:
        """det."""
        return "<mi>det</mi>" + ("" if self.peek() == "(" else '<mspace width="0.17em"></mspace>')

    def do_frac(self) -> str:
        """A fraction."""
        above, below = self.argument(), self.argument()
        return f"<mfrac>{_one(above)}{_one(below)}</mfrac>"

    do_tfrac = do_dfrac = do_frac

    def do_sqrt(self) -> str:
        """A root."""
        return f"<msqrt>{self.argument()}</msqrt>"

    def do_sum(self) -> str:
        """A sum, its index below."""
        return '<mo movablelimits="false">∑</mo>'

    def do_mathrm(self) -> str:
        """Upright, as the d of a differential."""
        return f'<mi mathvariant="normal">{escape(self.words())}</mi>'

    def do_mathbf(self) -> str:
        """Bold, as the identity."""
        return f'<mn class="bold">{escape(self.words())}</mn>'

    def do_mathsf(self) -> str:
        """A parameter of the user."""
        shown = self.words().replace("\\_", "_")
        return f'<mi mathvariant="normal" class="parameter">{escape(shown)}</mi>'

    def do_mathfrak(self) -> str:
        """𝔤."""
        return "<mi>" + "".join(chr(0x1D51E + ord(c) - ord("a")) for c in self.words()) + "</mi>"

    def do_ensuremath(self) -> str:
        """Nothing but its argument."""
        return f"<mrow>{self.argument()}</mrow>"


def _one(markup: str) -> str:
    """As one child."""
    return f"<mrow>{markup}</mrow>"


def _over(inside: str, mark: str) -> str:
    return f'<mover accent="true">{_one(inside)}<mo stretchy="false">{mark}</mo></mover>'


def _fenced(inside: str) -> str:
    return f'<mo stretchy="false">(</mo>{inside}<mo stretchy="false">)</mo>'
