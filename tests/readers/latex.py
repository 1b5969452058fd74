"""LaTeX read: formulas in standard commands or in the macros of derive.sty, and whole documents."""

import re
from fractions import Fraction

from tests.readers.formula import GREEK, MARKS, UnreadableError, accented, equation, parsed

TOKEN = re.compile(
    r"\\begin\{[a-z]+\}(?:\{@\{\}l@\{\}\})?|\\end\{[a-z]+\}|\\[A-Za-z]+|\\.|\d|'+|\S"
)
LETTERS = {rf"\{x}": letter for x, letter in GREEK.items()} | {
    r"\varphi": "φ", r"\varpi": "ϖ", r"\Cartanform": "ϖ", r"\ell": "ℓ", r"\delta": "δ",
    r"\nabla": "∇", r"\vartheta": "ϑ", r"\varsigma": "ς",
    r"\variation": "δ",
}  # fmt: skip
WORDS = {r"\Tr": "Tr", r"\sum": "Σ", r"\int": "∫", r"\det": "det", r"\dd": "d", r"\partial": "∂"}
WORDS |= {rf"\{x}": x for x in ("cos", "cosh", "exp", "log", "sin", "sinh", "tan", "tanh")}
WORDS |= {r"\arctan": "atan"}
OPERATORS = {r"\wedge": "∧", r"\cdot": "·", r"\top": "⊤"}
OPERATORS |= {r"\neq": "≠", r"\le": "≤", r"\ge": "≥", r"\cong": "≅", r"\approx": "≈", r"\pm": "±"}
OPERATORS |= {
    r"\in": "∈",
    r"\to": "→",
    r"\times": "×",
    r"\circ": "∘",
    r"\surd": "√",
    r"\mapsto": "↦",
    r"\infty": "∞",
}
OPERATORS |= {c: c for c in "+-=/,;<>:.|*"}
BRACKETS = {r"\langle": "⟨", r"\rangle": "⟩"} | {c: c for c in "()[]"}
ACCENTS = {r"\tilde": "~", r"\pulled": "~", r"\dot": "˙", r"\rate": "˙", r"\hat": "^"}
ACCENTS[r"\ddot"] = "¨"
SPACES = (r"\,", r"\quad", r"\qquad", r"\ ", r"\;")


STYLES = {
    r"\mathbb": {"J": "𝕁", "I": "𝕀", "R": "ℝ"},
    r"\mathcal": {"J": "𝒥", "A": "𝒜", "R": "ℛ", "V": "𝒱", "F": "ℱ"},
    r"\mathfrak": {"g": "𝔤", "s": "𝔰", "o": "𝔬"},
}
STYLES[r"\algebraof"] = STYLES[r"\mathfrak"]


class _Lexer:
    """Commands with their arguments → the tokens of a formula."""

    def __init__(self, raw, known):
        self.raw, self.known, self.at = raw, known, 0

    def peek(self):
        return self.raw[self.at] if self.at < len(self.raw) else ""

    def take(self):
        self.at += 1
        return self.raw[self.at - 1] if self.at <= len(self.raw) else ""

    def group(self):
        """What is in braces, as it stands; or one token."""
        if self.peek() != "{":
            return [self.take()]
        self.take()
        start, depth = self.at, 1
        while depth:
            token = self.take()
            if not token:
                raise UnreadableError("a brace is open")
            depth += (token == "{") - (token == "}")
        return self.raw[start : self.at - 1]

    def inside(self):
        """The tokens of an argument."""
        return _Lexer(self.group(), self.known).all()

    def tree(self):
        return parsed(self.inside(), self.known)

    def words(self):
        return "".join(self.group()).replace(r"\_", "_")

    def all(self):
        found = []
        while self.peek():
            found += self.next()
        return found

    def next(self):
        token = self.take()
        if token in LETTERS:
            return [("name", LETTERS[token] + self.prime() if LETTERS[token] == "δ" else
                     LETTERS[token])]  # fmt: skip
        if token in WORDS:
            return [("word", WORDS[token])]
        if token in OPERATORS:
            return [("op", OPERATORS[token])]
        if token in BRACKETS:
            return [("close" if token in r")]\rangle" else "open", BRACKETS[token])]
        if token in (r"\lVert", r"\rVert", r"\Vert"):
            return [("norm", "")]
        if token in (r"\lvert", r"\rvert"):
            return [("size", "")]
        if token in SPACES:
            return []
        if token.isdigit():
            while self.peek().isdigit():
                token += self.take()
            rest = "".join(self.raw[self.at :])
            if decimals := re.match(r"\.(\d+)|\{,\}(\d+)", rest):
                self.at += decimals.end()
                return [("number", Fraction(f"{token}.{decimals[1] or decimals[2]}"))]
            return [("number", int(token))]
        if token.isalpha():
            return [("name", token)]
        if token[0] == "'":
            return [("prime", len(token))]
        return self.command(token)

    def prime(self):
        return "′" if self.peek() == "'" and self.take() else ""

    def command(self, token):
        if token in ACCENTS:
            ((kind, letter),) = self.inside()
            return [(kind, accented(letter, ACCENTS[token]))]
        if token in "_^":
            return [("sub" if token == "_" else "sup", self.inside())]
        if token == "{":
            self.at -= 1
            return self.inside()
        if token in (r"\frac", r"\tfrac"):
            return self.fraction()
        if token in (r"\bar", r"\overline", r"\transposeof"):
            return [("bar", self.inside())]
        if token == r"\transpose":
            letter = self.inside()
            return [("bar", letter), *self.inside()]
        if token == r"\hatmap":
            return [("tree", ("hat", self.tree()))]
        if token == r"\sqrt":
            return [("root", self.inside())]
        if token == r"\operatorname":
            word = self.words()
            return [("word", {"arctan": "atan"}.get(word, word))]
        if token in (r"\mathsf", r"\parameter"):
            word = self.words()
            return [("par", "ell" if word == r"\ell" else word)]
        if token in (r"\unitmatrix", r"\mathbf"):
            bold = self.words() if token == r"\mathbf" else "1"
            return [("tree", ("one",)) if bold == "1" else ("name", {"m": "𝐦", "n": "𝐧"}[bold])]
        if token == r"\Liealgebra":
            return [("name", "𝔤")]
        if token in STYLES:
            return [("name", STYLES[token][self.words()])]
        if token == r"\mathrm" and self.words() == "d":
            return [("word", "d")]
        if token.startswith(r"\begin{pmatrix"):
            return [("tree", ("matrix", *self.rows()))]
        if token.startswith(r"\begin{array"):
            return self.lines()
        raise UnreadableError(f"{token} in {''.join(self.raw)}")

    def fraction(self):
        above, below = self.group(), self.group()
        if below[-1:] == ["t"] and "".join(above) in (r"\mathrm{d}", r"\dd"):
            return [("name", "d/dt")]
        above, below = (_Lexer(x, self.known).all() for x in (above, below))
        if [x[0][0] for x in (above, below)] == ["number"] * 2 and len(above) == len(below) == 1:
            return [("number", Fraction(above[0][1], below[0][1]))]
        if above[-2:] == [("word", "d"), ("name", "u")]:  # under an integral
            return [*above, ("op", "/"), *below]
        return [("tree", ("div", parsed(above, self.known), parsed(below, self.known)))]

    def cells(self):
        """What stands between & and \\\\ up to the end, as it stands."""
        rows, cell, depth = [[]], [], 0
        while True:
            token = self.take()
            depth += token.startswith((r"\begin", "{")) - token.startswith((r"\end", "}"))
            if depth < 0 or not token:
                rows[-1].append(cell)
                return rows
            if token in ("&", r"\\") and not depth:
                rows[-1].append(cell)
                cell = []
                if token == r"\\":
                    rows.append([])
                    if self.raw[self.at : self.at + 5] == [*"[2pt]"]:
                        self.at += 5
            else:
                cell.append(token)

    def rows(self):
        for row in self.cells():
            yield ("row", *(parsed(_Lexer(x, self.known).all(), self.known) for x in row))

    def lines(self):
        return [x for row in self.cells() for cell in row for x in _Lexer(cell, self.known).all()]


def tokens(tex, known):
    """Those of a formula."""
    return _Lexer(TOKEN.findall(tex), known).all()


def formula(tex, known):
    """One formula."""
    return parsed(tokens(tex, known), known)


LAYOUT = re.compile(r"\\(?:begin|end)\{\w+\}|\[2pt\]|\\(?:mathsf|mathrm|mathbf|operatorname)")
OVER = {command: MARKS[mark] for command, mark in ACCENTS.items()}


def letters_in(tex):
    """The letters and digits of formulas, each with the marks over it, but bars."""
    found, over, style = "", "", {}
    for token in TOKEN.findall(LAYOUT.sub("", tex)):
        if token in (r"\text", r"\ensuremath"):
            raise UnreadableError(f"words in a formula: {tex}")
        over += OVER.get(token, "")
        style = STYLES.get(token, style)
        letters = "j" if token == r"\hatmap" else LETTERS.get(token) or WORDS.get(token, token)
        if letters.isalnum():
            found += style.get(letters, letters) + over
            over, style = "", {}
    return found.replace("h\u0307\u0303", "h\u0307")  # the rate of h̃, as records spell it


CLAUSE = re.compile(r"(?:\\quad|\\ )?\s*\\text\{[^}]*\}.*|\\in\b.*")
BLOCK = re.compile(r"\\begin\{align\}(.*?)\\end\{align\}", re.S)
LABEL = re.compile(r"\\label\{(.*?)\}(?:\\walkalso\{(.*?)\}\{.*?\})?")


def rows(block):
    """The lines of an alignment, cut where no matrix is open."""
    found, depth = [""], 0
    for token in re.findall(
        r"\\begin\{\w+\}|\\end\{\w+\}|\\\\\*?|(?:[^\\]|\\(?!begin|end|\\))+", block
    ):
        depth += token.startswith(r"\begin") - token.startswith(r"\end")
        if token.startswith(r"\\") and not depth:
            found.append("")
        else:
            found[-1] += token
    return found


def equations(block, known):
    """The equations of an alignment: one starts in a row that has a left side, or a first line."""
    found = []
    for row in rows(block):
        tex = CLAUSE.sub("", LABEL.sub("", row).replace(r"\notag", ""), count=1).strip()
        left, sep, right = tex.partition("&")
        if not sep:
            raise UnreadableError(f"no alignment in {row}")
        starts = left.strip() or not right.lstrip().startswith(r"\quad")
        if starts and not (left.strip() or right.strip()):
            continue
        if starts:
            found.append(f"{left} {right}")
        else:
            # a product that goes on in a new line has its sign there
            found[-1] += re.sub(r"^\s*((?:\\quad)+) \\times", r" \1", right)
    for tex in found:
        for one in tex.split(r",\qquad "):
            yield equation(tokens(one, known), known)


def page(tex, known, labels):
    """The equations of every step, by its label."""
    found = {}
    for block in BLOCK.findall(tex):
        label = LABEL.search(block)[1]
        step = next(x for x in (label, label.rpartition(".")[0]) if x in labels)
        found.setdefault(step, []).extend(equations(block, known))
    return found
