"""MathML read: one element, or the equations of a page by the anchors of its steps."""

import re
from fractions import Fraction
from xml.etree import ElementTree

from tests.readers.formula import UnreadableError, accented, equation, parsed

OPERATORS = {"−": "-", "∧": "∧", "·": "·", "⊤": "⊤"} | {c: c for c in "+=/,;<>:.≠≤≥≅≈±∈→↦×∘√*"}
ACCENTS = "˙¨~^"
BRACKETS = "([⟨)]⟩"
WORDS = {"∑": "Σ", "∫": "∫"}
ARTICLE = re.compile(r'<article id="(.*?)">(.*?)</article>', re.S)
EQUATION = re.compile(r'<div class="equation.*?<span class="number">', re.S)


def tokens(node, known):
    """Those of an element."""
    text, kind = (node.text or "").strip(), node.attrib.get("class", "")
    if node.tag == "mn":
        if kind == "bold":
            return [("tree", ("one",))]
        return [("number", Fraction(text.replace(",", ".")))]
    if node.tag == "mi":
        return _letter(text, kind, node.attrib.get("mathvariant") == "normal")
    if node.tag == "mo":
        return _operator(text)
    if node.tag == "mspace":
        return []
    if node.tag == "mtext":
        raise UnreadableError(f"{text} in a formula")
    if node.tag == "mtable":
        return _table(node, kind, known)
    inside = [tokens(x, known) for x in node]
    flat = [token for x in inside for token in x]
    if kind == "overline":
        return [("bar", flat)]
    if node.tag in ("math", "mrow"):
        return flat
    return _layout(node.tag, inside, known)


def _letter(text, kind, upright):
    if kind == "parameter":
        return [("par", "ell" if text == "ℓ" else text)]
    if upright:
        return [("word", text)]
    several = len(text) > 1 and text.isascii()
    return [("word" if several else "name", {"arctan": "atan"}.get(text, text))]


def _operator(text):
    if text and set(text) == {"′"}:
        return [("prime", len(text))]
    if text in WORDS:
        return [("word", WORDS[text])]
    if text == "‖":
        return [("norm", "")]
    if text == "|":
        return [("size", "")]
    if text in BRACKETS:
        return [("open" if BRACKETS.index(text) < 3 else "close", text)]
    if text in OPERATORS:
        return [("op", OPERATORS[text])]
    if text in ACCENTS:
        return [("accent", text)]
    raise UnreadableError(f"the operator {text!r}")


def _layout(tag, inside, known):
    """Scripts, fractions, roots, accents: each child in its place."""
    if tag in ("msub", "munder"):
        return [*inside[0], ("sub", inside[1])]
    if tag == "msup":
        return [*inside[0], ("sup", inside[1])]
    if tag == "msubsup":
        return [*inside[0], ("sub", inside[1]), ("sup", inside[2])]
    if tag == "mover":
        ((_, letter),) = inside[0]
        return [("name", accented(letter, inside[1][0][1]))]
    if tag == "mfrac":
        return _fraction(*inside, known)
    if tag == "msqrt":
        return [("root", [token for x in inside for token in x])]
    raise UnreadableError(f"<{tag}>")


def _fraction(above, below, known):
    if above == [("word", "d")] and below == [("word", "d"), ("name", "t")]:
        return [("name", "d/dt")]
    if [x[0][0] for x in (above, below)] == ["number"] * 2 and len(above) == len(below) == 1:
        return [("number", Fraction(above[0][1], below[0][1]))]
    if above[-2:] == [("word", "d"), ("name", "u")]:  # under an integral
        return [*above, ("op", "/"), *below]
    return [("tree", ("div", parsed(above, known), parsed(below, known)))]


def _table(node, kind, known):
    rows = [[[t for x in cell for t in tokens(x, known)] for cell in row] for row in node]
    if kind == "lines":
        return [token for row in rows for cell in row for token in cell]
    return [("tree", ("matrix", *(("row", *(parsed(c, known) for c in row)) for row in rows)))]


ONCE_MORE = re.compile(
    '<div class="equation"><div class="left"></div><div class="right"><math><mo form="infix">=</mo>'
)
"""Where the right side of an equation stands in another form, by the angle of the plane."""


def all_tokens(markup, known):
    """Those of all the elements in some markup, one after the other."""
    found = []
    for one in re.findall(r"<math>.*?</math>", markup, re.S):
        markup_of = ElementTree.fromstring(one)
        found += [token for x in markup_of for token in tokens(x, known)]
    return found


def formula(markup, known):
    """One formula."""
    return parsed(all_tokens(markup, known), known)


def page(html, known, labels):
    """The equations of every step, by its anchor."""
    return {
        label: [*_equations(re.split("<details>", body)[0], known)]
        for label, body in ARTICLE.findall(html)
        if label in labels
    }


def _equations(body, known):
    for one in EQUATION.findall(body):
        if ONCE_MORE.match(one):
            continue
        shown = re.sub(r'<span class="clause">.*', "", one)
        cells = (
            re.findall(r"<span>(.*?)</span>(?=<span>|</div>)", shown)
            if ('<div class="cells">' in shown)
            else [shown]
        )
        for cell in cells:
            yield equation(all_tokens(cell, known), known)
