"""A tree as one line of text, as the paper prints: Tr, bars, ⟨·, ·⟩_J, ∧."""

from __future__ import annotations

import re
from collections.abc import Collection, Container
from fractions import Fraction

from .derivatives import DERIVATIVES
from .tree import Tree, coefficient, mul, neg, nodes, sized

SUBSCRIPTS = str.maketrans("0123456789ije", "₀₁₂₃₄₅₆₇₈₉ᵢⱼₑ")
SUPERSCRIPTS = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
FRACTIONS = {Fraction(1, 2): "½"}
"""The one fraction that has a sign of its own; others are 1/3, 4/15."""
TAKEN = ("Tr", "det", "dm", "dt", "j", "G")
"""Words of the notation, which are no names of C, and the group, which is one of no equation."""
WORD = re.compile(rf"(?:{'|'.join((*DERIVATIVES, 'Tr', 'det', 'dm', 'dŨ'))})$")
SUM, PRODUCT, ATOM = 1, 2, 3
FIELD_OPERATORS = ("grad", "div", "Δ", "∇", "∂ₙ")
"""Functions of fields, which are written before one letter without brackets: grad p, Δp."""


def show(t: Tree) -> str:
    """The text of a tree, in one line."""
    return _show(t)[0]


def parts(t: Tree) -> list[tuple[str, str]]:
    """The terms of a sum as (sign, text) pairs, signs + and −; any other tree is one term."""
    shown = []
    for sign, term in signed(t):
        text, level = _show(term)
        shown.append((sign, f"({text})" if level == SUM else text))
    return shown


def signed(t: Tree) -> list[tuple[str, Tree]]:
    """The terms of a sum as (sign, tree) pairs, the trees without their sign; any other tree is one
    term."""
    terms = t[1:] if isinstance(t, tuple) and t[0] == "add" else (t,)
    found: list[tuple[str, Tree]] = []
    for term in terms:
        if isinstance(term, tuple) and term[0] == "div" and coefficient(term[1])[0] < 0:
            found.append(("−", ("div", neg(term[1]), term[2])))
            continue
        c, rest = coefficient(term)
        found.append(("−", mul(-c, rest)) if c < 0 else ("+", term))
    return found


def show_name(name: str) -> str:
    """The text of a name: ``J_11`` as ``J₁₁``, ``I_c`` as it is."""
    base, _, index = name.partition("_")
    return base + index.translate(SUBSCRIPTS) if re.fullmatch(r"[0-9]+", index) else name


MOMENT = re.compile(r"m|c_[0-9]|J_[0-9]{2}")
"""The entries of the letters of symbolic moments, parameters of the same name."""
ENTRY = re.compile(r"\([^()]+\)[₀-₉]")
"""The entry of a member of a family, (A₂)₁₁."""
INDEX = re.compile(r"_?[0-9]+$|_[abeijn]{1,2}$")
"""What is taken for an index at the end of a name."""


def unclear(letters: Container[str], parameters: Collection[str], symbolic: bool) -> frozenset[str]:
    """The parameters that would be read as letters of the walk, a product, or a word.

    ``symbolic``: the moments of the body are parameters, m and c₁ in both meanings the same.
    """

    def single(c: str) -> bool:
        return c in letters or c in parameters

    return frozenset(
        p
        for p in parameters
        if (
            not (symbolic and MOMENT.fullmatch(p))
            and (INDEX.sub("", p) in letters or p in letters or p in TAKEN)
        )
        or (len(p) > 1 and all(map(single, p)))
    )


def in_quotes(t: Tree, names: Container[str] | None = None) -> Tree:
    """The tree with its parameters, or those of these names, in quotes: so text has those like its
    letters, and sentences have all, which views then tell from other words."""
    if not isinstance(t, tuple):
        return t
    if t[0] == "par":
        return ("par", f"‘{show_name(t[1])}’") if names is None or t[1] in names else t
    return (t[0], *(in_quotes(x, names) for x in t[1:]))


def in_sentence(t: Tree) -> str:
    """The text of a tree in a sentence, its parameters in quotes."""
    return show(in_quotes(t))


def _indices(indices: tuple[object, ...]) -> str:
    """The text of indices, as in r_i, M_ab, M_1,11: subscripts where there are such letters."""
    comma = "," if len(indices) > 1 and any(len(str(i)) > 1 for i in indices) else ""
    plain = comma.join(map(str, indices))
    shown = plain.translate(SUBSCRIPTS)
    return shown if not re.search(r"[A-Za-z]", shown) else f"_{plain}"


def _indexed(t: Tree, indices: tuple[object, ...]) -> str:
    """The text of a member of a family or of an entry; (d₁)₂ for an entry of a member."""
    inner = t[1] if isinstance(t, tuple) and t[0] == "T" else t
    scripted = isinstance(inner, tuple) and inner[0] in ("at", "entry", "inv", "pow")
    return (f"({show(t)})" if scripted else _atom(t)) + _indices(indices)


def _index(i: object) -> str:
    shown = str(i).translate(SUBSCRIPTS)
    return f"_{i}" if shown == str(i) else shown


def _atom(t: Tree) -> str:
    text, level = _show(t)
    return text if level == ATOM else f"({text})"


def _base(t: Tree) -> str:
    """The text of what is raised to a power or divides: in brackets if a number stands above it,
    too."""
    raised = isinstance(t, tuple) and t[0] in ("pow", "inv", "norm2", "metric")
    return f"({_show(t)[0]})" if raised or isinstance(t, Fraction) else _atom(t)


def _under(t: Tree) -> str:
    """The text of a divisor: bare if it is a power of a letter or of a norm."""
    if isinstance(t, tuple) and t[0] == "pow" and t[2] > 0:
        text, level = _show(t)
        return text if level == ATOM else f"({text})"
    return _base(t)


def _below(t: Tree) -> str:
    """The text of a metric below a product, in brackets where its index would be read as the
    product's."""
    inner = t[1] if isinstance(t, tuple) and t[0] in ("T", "inv") else t
    return _atom(t) if isinstance(inner, str) else f"({show(t)})"


def _norm(t: Tree) -> str:
    """The text ‖a‖, with brackets between the strokes where a has such strokes in itself."""
    return f"‖({show(t)})‖" if has_norm(t) else f"‖{show(t)}‖"


def _size(t: Tree) -> str:
    """The text |a|, with brackets between the strokes where a has such strokes in itself."""
    return f"|({show(t)})|" if has_size(t) else f"|{show(t)}|"


def has_size(t: Tree) -> bool:
    """Is there a size |x| in a tree?"""
    return any(sized(x) is not None for x in nodes(t))


def has_norm(t: Tree) -> bool:
    """Is there a norm in a tree?"""
    return isinstance(t, tuple) and (t[0] == "norm2" or any(map(has_norm, t[1:])))


def _letter(text: str) -> bool:
    """Is a text one mathematical letter with its marks, so that a product needs no space?"""
    return re.fullmatch(r"(?:[^\W\d_][\u0300-\u036f]*′?|‘[^\W\d_]’)(⁻¹|²)?", text) is not None


def _spelt_out(t: Tree) -> bool:
    """Is it a parameter of several letters, or a power of one: mgl would be read as m g l?"""
    if isinstance(t, tuple) and t[0] in ("pow", "inv"):
        return _spelt_out(t[1])
    return isinstance(t, tuple) and t[0] == "par" and len(INDEX.sub("", t[1].strip("‘’"))) > 1


def bar(text: str) -> str:
    """The text of a transpose: of a letter with a bar over its base, of anything else with ‾ behind
    it."""
    match = re.fullmatch(r"(δ?′?)([^\W\d_][\u0300-\u036f]*)(′?)", text)
    return f"{match[1]}{match[2]}\u0304{match[3]}" if match else f"{text}‾"


def _product(factors: tuple[Tree, ...]) -> str:
    if len(factors) > 1 and factors[0] == -1:
        return "−" + _product(factors[1:])
    text, last, spelt = "", "", any(map(_spelt_out, factors))
    for k, f in enumerate(factors):
        shown, level = _show(f)
        inside = k < len(factors) - 1 and level == PRODUCT and (text or _spreads(f))
        piece = f"({shown})" if level == SUM or inside or (text and _spread(f)) else shown
        apart = spelt and k and not isinstance(factors[k - 1], (int, Fraction))
        text += ("·" if apart else _separator(text, last, piece)) + piece
        last = piece
    return text


def _spreads(f: Tree) -> bool:
    return isinstance(f, tuple) and f[0] in ("tr", "sum", "wedge")


def _spread(f: Tree) -> bool:
    return isinstance(f, tuple) and f[0] in ("wedge", "div")


def _separator(text: str, last: str, piece: str) -> str:
    if not last or piece.startswith("("):
        return " " if last and ENTRY.match(piece) else ""
    if _letter(last) and _letter(piece):
        return " " if WORD.search(text + piece) else ""
    if last in FRACTIONS.values() and _letter(piece):
        return ""
    if last.isdigit() and piece[0].isdigit():
        return "·"
    return "" if last.isdigit() and _letter(piece) else " "


def _show(t: Tree) -> tuple[str, int]:
    if isinstance(t, str):
        return show_name(t), ATOM
    if isinstance(t, int):
        return (str(t), ATOM) if t >= 0 else (f"−{-t}", SUM)
    if isinstance(t, Fraction):
        text = FRACTIONS.get(abs(t), f"{abs(t.numerator)}/{t.denominator}")
        return (text, ATOM) if t > 0 else (f"−{text}", SUM)
    return _node(t)


def _node(t: tuple[object, ...]) -> tuple[str, int]:
    op = t[0]
    arguments: tuple[Tree, ...] = t[1:]  # type: ignore[assignment]
    if op == "add":
        first, *others = parts(t)
        text = ("−" if first[0] == "−" else "") + first[1]
        return text + "".join(f" {sign} {term}" for sign, term in others), SUM
    if op == "mul":
        negative = coefficient(t)[0] < 0
        return _product(arguments) if not negative else _negative(t), SUM if negative else PRODUCT
    if op == "div":
        c, rest = coefficient(arguments[0])
        above, level = _show(mul(abs(c), rest))
        above = f"({above})" if level == SUM or swallows(rest) else above
        text = f"{above}/{_under(arguments[1])}"
        return (text, PRODUCT) if c >= 0 else (f"−{text}", SUM)
    if op == "wedge":
        return " ∧ ".join(_operand(a) for a in arguments), PRODUCT
    if op == "tr":
        text, level = _show(arguments[0])
        if isinstance(arguments[0], tuple) and arguments[0][0] == "bracket":
            return f"Tr {text}", PRODUCT
        return (f"Tr {text}" if level >= PRODUCT else f"Tr({text})"), PRODUCT
    if op == "sum":
        text, level = _show(arguments[1])
        return f"Σ{_index(arguments[0])} " + (f"({text})" if level == SUM else text), PRODUCT
    if op == "call" and arguments[0] in FIELD_OPERATORS and isinstance(arguments[1], str):
        head, field = arguments
        return f"{head}{' ' if head.isascii() else ''}{show(field)}", PRODUCT  # type: ignore[union-attr]
    return _atomic(op, arguments), ATOM


def _negative(t: Tree) -> str:
    sign, text = parts(t)[0]
    return sign + text


def _operand(t: Tree) -> str:
    """The text of an operand of ∧: products stay bare, sums and other wedges get parentheses."""
    text, level = _show(t)
    return f"({text})" if level == SUM or swallows(t) else text


def swallows(t: Tree) -> bool:
    """Would what follows be read into a tree, or only its last factor: Tr a, Σ a, a ∧ b?"""
    if not isinstance(t, tuple):
        return False
    if t[0] == "mul":  # in which a ∧ b has brackets
        return swallows(t[-1]) and t[-1][0] != "wedge"
    return t[0] in ("wedge", "sum", "tr")


def _barred(t: Tree) -> str:
    if isinstance(t, tuple) and t[0] == "at" and isinstance(t[1], str):
        return bar(show(t[1])) + _indices(t[2:])
    return bar(show(t)) if isinstance(t, str) else f"{_atom(t)}‾"


def _atomic(op: object, a: tuple[Tree, ...]) -> str:
    if op == "T":
        return _barred(a[0])
    if op == "inv":
        return f"{_base(a[0])}⁻¹"
    if op == "det":
        return f"det({show(a[0])})"
    if op == "one":
        return "1"
    if op == "pow":
        base = f"({show(a[0])})" if _spelt_out(a[0]) else _base(a[0])
        return base + str(a[1]).translate(SUPERSCRIPTS)
    if op == "inner":
        return f"⟨{show(a[0])}, {show(a[1])}⟩"
    if op == "metric":
        return f"⟨{show(a[1])}, {show(a[2])}⟩_{_below(a[0])}"
    if op == "norm2":
        return f"{_norm(a[-1])}²" + (f"_{_below(a[0])}" if len(a) == 2 else "")
    if op == "fun":
        if (measured := sized(("fun", *a))) is not None:
            return _size(measured)
        name, inside = a
        norm = name == "sqrt" and isinstance(inside, tuple) and inside[0] == "norm2"
        if norm and len(inside) == 2:  # type: ignore[arg-type]
            return _norm(inside[1])  # type: ignore[index]
        return f"√({show(inside)})" if name == "sqrt" else f"{name}({show(inside)})"
    if op == "bracket":
        return f"[{show(a[0])}, {show(a[1])}]"
    if op == "hat":
        return f"j({show(a[0])})"
    if op == "nabla":
        return f"∇_{show(a[0])}" if isinstance(a[0], str) else f"∇_({show(a[0])})"
    if op in ("at", "entry"):
        return _indexed(a[0], a[1:])
    if op == "par":
        return show(a[0])
    if op == "matrix":
        bracket = len(a) == 1 and isinstance(a[0], tuple) and a[0][0] == "row" and len(a[0]) == 3
        return "[" + "; ".join(show(row) for row in a) + (";]" if bracket else "]")
    if op == "row":
        return ", ".join(show(x) for x in a)
    if op == "call" and a[0] == "∫":
        return "∫ dm" if a[1] == 1 else f"∫ {show(a[1])} dm"
    if op == "call":
        return f"{_atom(a[0])}({', '.join(show(x) for x in a[1:])})"
    raise ValueError(f"unknown operator {op!r}")
