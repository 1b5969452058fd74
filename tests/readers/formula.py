"""What a formula says, whatever it is printed in: tokens → tree, by the precedence of the paper.

A tree is a name, a number, or ``(operator, …)``: ``sub`` is anything with indices, ``par`` a
parameter.  Tr and Σ reach to the end of their product, / divides the product before it by one
factor, ∧ joins products.  The readers of the formats make the tokens:

    ("name", letter) ("number", q) ("par", text) ("prime", n) ("bar", tokens)
    ("sub", tokens) ("sup", tokens) ("root", tokens) ("open" or "close", mark) ("norm", "")
    ("size", "") ("op", mark) ("word", Tr det Σ ∫ dm d ∂ or a function) ("tree", already read)
"""

import re
import unicodedata
from dataclasses import dataclass, field
from fractions import Fraction

from derive.language.tree import nodes
from derive.record.vocabulary import VOCABULARY

OF_FIELDS = ("grad", "div", "Δ", "∇", "∂ₙ")
"""Functions that stand before one letter without brackets."""
WORDS = ("Tr", "det", "Σ", "∫", "dm", "d", "∂")
FUNCTION = {
    name
    for name, known in VOCABULARY.items()
    if known.uses and all(u.type[0] == "function" for u in known.uses)
}
FUNCTION |= {
    name
    for name, known in VOCABULARY.items()
    if known.uses and all(u.type[2:] and u.type[2][0] == "function" for u in known.uses)
}
"""Names that are nothing but functions, or families of them: brackets after them hold arguments."""
RATES = {"h̃̇": "ḣ"}
MARKS = {"~": "\u0303", "˙": "\u0307", "¨": "\u0308", "^": "\u0302"}
SMALL = """alpha beta gamma delta epsilon zeta eta theta iota kappa mu nu xi pi rho sigma tau
    upsilon chi psi omega"""
LARGE = "Gamma Delta Theta Xi Pi Sigma Upsilon Phi Psi Omega"
GREEK = {"lambda": "λ", "phi": "ϕ", "Lambda": "Λ"} | {
    name: unicodedata.lookup(f"GREEK {case} LETTER {name.upper()}")
    for case, names in (("SMALL", SMALL), ("CAPITAL", LARGE))
    for name in names.split()
}


class UnreadableError(ValueError):
    """No formula, or one that can be read in several ways."""


def accented(letter, mark):
    """A letter with ~, ˙ or ¨ over it, as the record spells it."""
    text = unicodedata.normalize("NFD", letter) + MARKS.get(mark, mark)
    return RATES.get(text, unicodedata.normalize("NFC", text))


@dataclass
class Letters:
    """The names that a page may use: the walk's, the parameters, those that are both."""

    letters: set
    parameters: set = field(default_factory=set)
    moments: set = field(default_factory=set)
    """Parameters that are the entries of letters, m and J₁₁ of symbolic moments."""

    def __post_init__(self):
        self.letters = {unicodedata.normalize("NFC", x) for x in self.letters}

    def parameter(self, base, index=""):
        """The parameter that is so written; x₁ is x_1, or x1 where there is no such."""
        found = [f"{base}_{index}", f"{base}{index}"] if index else [base]
        for name in found:
            if name in self.parameters:
                return ("par", name)
        raise UnreadableError(f"no parameter {found[0]}")

    def indexed(self, base, index):
        """A name with an index: I_c is one name, c₁ of symbolic moments a parameter."""
        if isinstance(base, tuple) and base[0] == "T":
            return ("T", self.indexed(base[1], index))
        if isinstance(base, str):
            whole = f"{base}_{index}"
            if whole in self.letters:
                return whole
            greek = next((x for x, letter in GREEK.items() if letter == base), base)
            for name in (whole, f"{greek}_{index}", f"{greek}{index}"):
                free = base not in self.letters and name in self.parameters
                if free or name in self.moments:
                    return ("par", name)
        return ("sub", base, index)

    def bare(self, name):
        """May text have this parameter without quotes?  Else it reads as something else."""
        if name in self.moments:
            return True
        known = self.letters | self.parameters
        product = len(name) > 1 and known.issuperset(name)
        base, stroke, index = name.partition("_")
        base = name if stroke and not index else base
        indexed = index.isdigit() or (len(index) < 3 and set("abeijn").issuperset(index))
        return not product and name != "j" and not (base in self.letters and indexed)

    def alone(self, letter):
        """A letter by itself, of the walk or of the user."""
        if letter in self.moments:
            return ("par", letter)
        greek = next((x for x, y in GREEK.items() if y == letter), letter)
        for name in (letter, greek):
            if letter not in self.letters and name in self.parameters:
                return ("par", name)
        return letter


def letters_of(d):
    """Those of a record."""
    own = {s.name for s in d.symbols} | {"g", "δ", "δ′", "∫", "d/dt"}
    given = {*map(str, d.problem.get("parameters") or ())}
    inputs = "|".join(x["name"] for x in d.problem.get("inputs") or ())
    sides = (x for s in d.steps for e in s.equations for t in (e.lhs, e.rhs) for x in nodes(t))
    named = (x[1] for x in sides if isinstance(x, tuple) and x[0] == "par")
    given |= {x for x in named if inputs and re.fullmatch(rf"({inputs})_\d+", x)}
    given |= {*d.problem.get("kinematics", {}).get("inputs", ())}
    body = d.problem.get("body") or {}
    n = range(1, 10)
    entries = {"m", *(f"c_{i}" for i in n), *(f"J_{i}{j}" for i in n for j in n if i <= j)}
    return Letters(own, given, given & entries if body.get("kind") == "moments" else set())


def joined(tokens, known):
    """δ and A as δA, d and Ũ as dŨ, primes and bars with their letters."""
    found = []
    for kind, value in tokens:
        if kind == "sub" and found and found[-1][0] == "sup" and found[-1][1] != [("op", "⊤")]:
            found.insert(-1, (kind, value))  # one above the other, whichever was written first
            continue
        if (kind, value) == ("sub", [("name", "n")]) and found[-1:] == [("word", "∂")]:
            found[-1] = ("name", "∂ₙ")
            continue
        if (kind, value) == ("sub", [("name", "s")]) and found[-1:] == [("word", "∂")]:
            found[-1] = ("name", "∂")  # along a curve
        if kind == "bar":
            inner = [("name", "∂")] if value == [("word", "∂")] else joined(value, known)
            alone = len(inner) == 1 and inner[0][0] == "name"
            value = ("T", inner[0][1] if alone else parsed(inner, known, raw=False))
            kind = "barred" if alone else "tree"
        if kind == "prime" and found and found[-1][0] in ("name", "barred"):
            last, old = found.pop()
            primed = old + "′" * value if last == "name" else ("T", old[1] + "′" * value)
            kind, value = last, primed
        if kind in ("name", "barred"):
            kind, value = _prefixed(found, kind, value, known)
        found.append((kind, value))
    return found


def _prefixed(found, kind, value, known):
    """A letter with the δ, d or ∂ₜ before it, where they are one name."""
    letter = value if kind == "name" else value[1]
    before = found[-1] if found else ("", "")
    lead, count = "", 0
    if before in (("name", "δ"), ("name", "δ′")):
        lead, count = before[1], 1
    elif before == ("word", "d"):
        lead, count = "d", 1
    elif before[0] == "sub" and found[-2:-1] == [("word", "∂")]:
        lead, count = "∂ₜ", 2
    whole = lead + letter
    if lead and any(x == whole or x.startswith(f"{whole}_") for x in known.letters):
        del found[-count:]
        return kind, whole if kind == "name" else ("T", whole)
    if (lead, letter) == ("d", "m"):
        found.pop()
        return "word", "dm"
    return kind, value


def parsed(tokens, known, raw=True):
    """The tree of all the tokens."""
    reader = _Reader(joined(tokens, known) if raw else tokens, known)
    tree = reader.sum()
    if reader.at < len(reader.tokens):
        raise UnreadableError(f"left over: {reader.tokens[reader.at :][:4]}")
    return tree


def equation(tokens, known):
    """Both sides, as trees."""
    at = [k for k, token in enumerate(tokens) if token == ("op", "=")]
    if len(at) != 1:
        raise UnreadableError(f"{len(at)} signs of equality")
    return parsed(tokens[: at[0]], known), parsed(tokens[at[0] + 1 :], known)


class _Reader:
    """Descends: sum, term, product, factor."""

    def __init__(self, tokens, known):
        self.tokens, self.known, self.at = tokens, known, 0
        self.strokes = ""  # are we between ‖ and ‖, or | and |, in no brackets there?

    def peek(self):
        return self.tokens[self.at] if self.at < len(self.tokens) else ("end", "")

    def take(self, *wanted):
        token = self.peek()
        if wanted and token not in wanted:
            raise UnreadableError(f"{token} where {wanted} should be")
        self.at += 1
        return token

    def passed(self, token):
        if self.peek() == token:
            self.at += 1
            return True
        return False

    def sum(self):
        terms, sign = [], -1 if self.passed(("op", "-")) else 1
        while True:
            term = self.term()
            terms.append(("mul", -1, term) if sign < 0 else term)
            if self.passed(("op", "+")):
                sign = 1
            elif self.passed(("op", "-")):
                sign = -1
            else:
                return ("add", *terms) if len(terms) > 1 else terms[0]

    def term(self):
        left = self.product()
        if self.passed(("op", "∧")):
            left = ("wedge", left, self.product())
            if self.peek() == ("op", "∧"):
                raise UnreadableError("a ∧ b ∧ c")
        return left

    def product(self):
        factors = []
        while self.peek()[0] not in ("end", "close"):
            kind, value = self.peek()
            if factors and kind == self.strokes:
                break
            if self.passed(("op", "/")):
                factors = [("div", self.whole(factors), self.factor())]
            elif kind == "op" and value == "·":
                self.take()
            elif kind == "op" or (kind, value) == ("word", "dm"):
                break
            else:
                factors.append(self.factor())
        return self.whole(factors)

    @staticmethod
    def whole(factors):
        if not factors:
            raise UnreadableError("a factor is missing")
        return ("mul", *factors) if len(factors) > 1 else factors[0]

    def factor(self):
        tree = self.primary()
        while True:
            kind, value = self.peek()
            if isinstance(tree, str) and kind != "sub":
                tree = self.known.alone(tree)
            if kind == "sub":
                self.take()
                tree = self.index(tree, value)
            elif kind == "sup":
                self.take()
                tree = self.raised(tree, value)
            elif (kind, value) == ("open", "(") and self.called(tree):
                tree = ("call", tree, *self.listed(")"))
            else:
                return tree

    def index(self, tree, tokens):
        if any(kind not in ("name", "number", "par", "op") for kind, _ in tokens):
            raise UnreadableError(f"an index of {tokens}")
        index = "".join(str(value) for _, value in tokens)
        if isinstance(tree, tuple) and tree[0] == "user":
            return self.known.parameter(tree[1], index)
        if tokens[0][0] == "par" and isinstance(tree, str):
            greek = next((x for x, letter in GREEK.items() if letter == tree), tree)
            return self.known.parameter(greek, index)
        return self.known.indexed(tree, index)

    def raised(self, tree, tokens):
        if tokens == [("op", "⊤")]:
            return ("T", tree)
        n = parsed(tokens, self.known) if isinstance(tokens, list) else tokens
        n = -n[2] if isinstance(n, tuple) and n[:2] == ("mul", -1) else n
        return ("inv", tree) if n == -1 else ("pow", tree, n)

    def called(self, tree):
        """Do these brackets hold arguments?  A name by itself is put in none as a factor."""
        base = tree[1] if isinstance(tree, tuple) and tree[0] == "sub" else tree
        if base in FUNCTION:
            return True
        inside = [x[1] for x in self.tokens[self.at + 1 : self.at + 3]]
        if base in ("T", "ζ") and ("𝐦" in inside or "𝐧" in inside):
            return True
        uses = VOCABULARY[base].uses if isinstance(base, str) and base in VOCABULARY else ()
        lone = inside in (["t", ")"], ["X", ")"])  # another name there may be a transposed factor
        return lone and any("function" in (u.type[0], *u.type[2][:1]) for u in uses if u.type[2:])

    def listed(self, end):
        self.take()
        found = [self.inner()]
        while self.passed(("op", ",")):
            found.append(self.inner())
        self.take(("close", end))
        return found

    def inner(self, strokes=""):
        """A sum in brackets, or between the strokes of a norm or a size."""
        outer, self.strokes = self.strokes, strokes
        tree = self.sum()
        self.strokes = outer
        return tree

    def primary(self):
        kind, value = self.take()
        method = getattr(self, f"of_{kind}", None)
        if method is None:
            raise UnreadableError(f"{kind} {value!r} where something should start")
        return method(value)

    def of_name(self, name):
        if name in ("δ", "δ′") and self.peek() != ("open", "("):
            return ("call", name, self.factor())
        if name == "∇" and self.peek()[0] == "sub":
            return ("nabla", parsed(self.take()[1], self.known))
        if name in OF_FIELDS and self.peek() != ("open", "("):
            kind, letter = self.take()
            if kind != "name":
                raise UnreadableError(f"{name} before {letter}")
            return ("call", name, letter)
        if name == "j" and self.peek() == ("open", "("):
            return ("hat", *self.listed(")"))
        return name

    def factor_of(self, name):
        """A function of fields, with brackets or without."""
        if self.peek() == ("open", "("):
            return ("call", name, *self.listed(")"))
        return self.of_name(name)

    def of_barred(self, tree):
        return tree

    of_tree = of_number = of_barred

    def of_root(self, tokens):
        return ("fun", "sqrt", parsed(tokens, self.known))

    def of_par(self, text):
        """One that is shown as such; its index may follow."""
        return ("user", text) if self.peek()[0] == "sub" else self.known.parameter(text)

    def of_word(self, word):
        if word == "Tr":
            return ("tr", self.product())
        if word == "Σ":
            kind, tokens = self.take()
            index = parsed(tokens, Letters(set())) if kind == "sub" else kind
            return ("sum", index, self.term())
        if word == "∫":
            body = 1 if self.peek() == ("word", "dm") else self.sum()
            self.take(("word", "dm"))
            return ("call", "∫", body)
        if word == "det":
            inside = self.listed(")") if self.peek() == ("open", "(") else [self.factor()]
            return ("det", *inside)
        if word in OF_FIELDS:
            return self.factor_of(word)
        if word in WORDS:
            raise UnreadableError(f"{word} by itself")
        raised = self.take()[1] if self.peek()[0] == "sup" else None
        tree = ("fun", word, *self.listed(")"))
        return tree if raised is None else self.raised(tree, raised)

    def of_open(self, mark):
        if mark == "(":
            self.at -= 1
            (tree,) = self.listed(")")
            return tree
        if mark == "⟨":
            self.at -= 1
            a, b = self.listed("⟩")
            if self.peek()[0] == "sub":
                return ("metric", parsed(self.take()[1], self.known), a, b)
            return ("inner", a, b)
        rows = [[self.inner()]]
        while self.peek() in (("op", ","), ("op", ";")):
            if self.take() == ("op", ";"):
                if self.peek() == ("close", "]"):
                    break
                rows.append([])
            rows[-1].append(self.inner())
        ended = self.tokens[self.at - 1] == ("op", ";")
        self.take(("close", "]"))
        if len(rows) == 1 and len(rows[0]) == 2 and not ended:
            return ("bracket", *rows[0])
        return ("matrix", *(("row", *row) for row in rows))

    def of_size(self, _):
        inside = self.inner("size")
        self.take(("size", ""))
        return ("size", inside)

    def of_norm(self, _):
        inside, metric, square = self.inner("norm"), (), False
        self.take(("norm", ""))
        while self.peek()[0] in ("sub", "sup"):
            kind, tokens = self.peek()
            if kind == "sub":
                metric = (parsed(tokens, self.known),)
            elif square or tokens not in ([("number", 2)], 2):
                break
            square = square or kind == "sup"
            self.take()
        if metric and not square:
            raise UnreadableError("a norm of a metric without its square")
        return ("norm2", *metric, inside) if square else ("norm", inside)


# -- one form for what is the same formula -------------------------------------------------------


def canonical(t, known, text=False):
    """Flat sums and products, the sign and the number of each first; 1 is 1 in ``text``."""
    if isinstance(t, str):
        letter = unicodedata.normalize("NFC", t)
        return ("par", letter) if letter in known.moments else letter
    if isinstance(t, (int, Fraction)):
        return Fraction(t)
    op = t[0]
    if op == "one":
        return Fraction(1) if text else ("one",)
    if op == "par":
        return ("par", t[1])
    if op == "sub":
        return ("sub", canonical(t[1], known, text), t[2])
    if op in ("at", "entry"):
        return _family(t, known, text)
    parts = [canonical(x, known, text) for x in t[1:]]
    if op == "add":
        return ("add", *(y for x in parts for y in (x[1:] if _is(x, "add") else (x,))))
    if op == "mul":
        return _times(parts)
    if op == "div":
        return _over(*parts)
    return _others(op, parts, known)


def _others(op, parts, known):
    if op == "pow" and parts[1] == -1:
        return ("inv", parts[0])
    if (op == "pow" and parts[1] == 2 and _is(parts[0], "norm")) or op == "norm2":
        return ("norm2", *(parts if op == "norm2" else parts[0][1:]))
    if op == "fun" and parts[0] == "sqrt" and _is(parts[1], "norm2") and len(parts[1]) == 2:
        return ("norm", parts[1][1])
    if op == "fun" and parts[0] == "sqrt" and _is(parts[1], "pow") and parts[1][2] == 2:
        return ("size", parts[1][1])
    if op == "size" and _is(parts[0], "norm"):
        return parts[0]
    if op == "T" and _is(parts[0], "sub"):
        return ("sub", _others("T", [parts[0][1]], known), parts[0][2])
    if op == "call" and parts[0] in ("δ", "δ′") and f"{parts[0]}{parts[1]}" in known.letters:
        return f"{parts[0]}{parts[1]}"
    if op == "matrix":
        return ("matrix", *(x if _is(x, "row") else ("row", x) for x in parts))
    return (op, *parts)


def _is(t, op):
    return isinstance(t, tuple) and t[0] == op


def _family(t, known, text):
    index = ("," if any(len(str(i)) > 1 for i in t[2:]) and len(t) > 3 else "").join(
        map(str, t[2:])
    )
    base = canonical(t[1], known, text)
    if isinstance(base, str) and f"{base}_{index}" in known.moments:
        return ("par", f"{base}_{index}")
    return ("sub", base, index)


def _times(factors):
    flat = [y for x in factors for y in (x[1:] if _is(x, "mul") else (x,))]
    number = Fraction(1)
    while flat and isinstance(flat[0], Fraction) and flat[0] != 1:
        number *= flat.pop(0)
    if flat in ([], [1]):
        return number
    if number == 1:
        return ("mul", *flat) if len(flat) > 1 else flat[0]
    return ("mul", number, *flat)


def _over(a, b):
    if isinstance(a, Fraction) and isinstance(b, Fraction):
        return a / b
    number, rest = (a, Fraction(1)) if isinstance(a, Fraction) else (Fraction(1), a)
    if _is(a, "mul") and isinstance(a[1], Fraction):
        number, rest = a[1], _times(a[2:])
    return ("div", rest, b) if number == 1 else _times([number, ("div", rest, b)])
