"""Text for a terminal, read: a formula, or the equations of a page by the labels of its steps."""

import re
import unicodedata
from fractions import Fraction

from tests.readers.formula import FUNCTION, UnreadableError, equation, parsed

SUBSCRIPTS = dict(zip("₀₁₂₃₄₅₆₇₈₉ᵢⱼₑ", "0123456789ije", strict=True))
SUPERSCRIPTS = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-", strict=True))
FRACTIONS = {"½": Fraction(1, 2), "⅓": Fraction(1, 3), "¼": Fraction(1, 4), "⅔": Fraction(2, 3)}
OPERATORS = {"−": "-", "⊤": "⊤"} | {c: c for c in "+∧·/,;=<>≤≥≈±∈∘×↦→:"}
FUNCTIONS = ("sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "log",
             "asinh", "acosh", "atanh", "sqrt")  # fmt: skip
BAR = "\u0304"
LETTER = re.compile(rf"([^\W\d_])((?:(?!{BAR})[\u0300-\u036f])*)({BAR}?)(′?)")
UNEQUAL = "=\u0338"
PAIRS = {"(": ")", "[": "]", "⟨": "⟩"}
HEADING = re.compile(r"(\S+)  ·  (.+)")


def tokens(text, known):
    """Those of a line or more; what lies between two spaces is nothing."""
    text = unicodedata.normalize("NFD", " ".join(text.split()))
    names = _names(known)
    found, at = [], 0
    while at < len(text):
        match = re.compile(r"‘([^’]*)’").match(text, at)
        if text[at] == " ":
            at += 1
        elif match:
            found.append(("tree", ("par", _spelt(match[1], known))))
            at = match.end()
        else:
            at = _token(text, at, names, known, found)
    return found


def _spelt(shown, known):
    """The parameter that is shown so: an index below comes after _."""
    plain = "".join(SUBSCRIPTS.get(c, c) for c in shown)
    lowered = next((k for k, c in enumerate(shown) if c in SUBSCRIPTS), None)
    name = shown if lowered is None else f"{plain[:lowered]}_{plain[lowered:]}"
    if name not in known.parameters:
        raise UnreadableError(f"no parameter ‘{shown}’")
    return name


def _names(known):
    """What is spelt with more than one letter → its tokens, the longest first."""
    spelt = {word: ("word", word) for word in ("Tr", "det", "dm", "Ric", "const", *FUNCTIONS)}
    spelt["√"], spelt["∫"], spelt["Σ"] = ("word", "sqrt"), ("word", "∫"), ("word", "Σ")
    for name in {*known.letters, *FUNCTION} - {"∫"}:
        name = unicodedata.normalize("NFD", name)
        spelt[name] = ("name", unicodedata.normalize("NFC", name))
        lead, letter, rest = re.fullmatch(r"((?:δ′?)?)(.[\u0300-\u036f]*|)(.*)", name).groups()
        if letter and "_" not in rest:
            spelt[f"{lead}{letter}{BAR}{rest}"] = ("barred", ("T", spelt[name][1]))
    for name in filter(known.bare, known.parameters):
        base, _, index = name.partition("_")
        shown = (
            base + "".join({v: k for k, v in SUBSCRIPTS.items()}[c] for c in index)
            if (index.isdigit())
            else name
        )
        spelt.setdefault(shown, ("tree", ("par", name)))
    return sorted(spelt.items(), key=lambda x: -len(x[0]))


def _token(text, at, names, known, found):
    """Reads one; what follows it."""
    for shown, token in names:
        end = at + len(shown)
        mark = text[end : end + 1]
        if text.startswith(shown, at) and not unicodedata.combining(mark or " "):
            if shown == "d" and mark.isalpha():
                continue  # a differential
            if mark in SUBSCRIPTS and token[0] == "tree" and shown[-1:] not in SUBSCRIPTS:
                continue
            if token[0] == "tree" and shown[-1:].isdigit() and mark in [*"0123456789"]:
                continue
            found.append(token)
            return end
    c = text[at]
    if run := re.compile(r"[0-9]+(?:[.,](?=[0-9])[0-9]+)?").match(text, at):
        found.append(("number", Fraction(run[0].replace(",", "."))))
        return run.end()
    if text.startswith(UNEQUAL, at):
        found.append(("op", "≠"))
        return at + len(UNEQUAL)
    if run := re.compile(f"[{''.join(SUBSCRIPTS)},]*[{''.join(SUBSCRIPTS)}]").match(text, at):
        found.append(("sub", [("name", "".join(SUBSCRIPTS.get(x, x) for x in run[0]))]))
        return run.end()
    if run := re.compile(f"[{''.join(SUPERSCRIPTS)}]+").match(text, at):
        found.append(("sup", int("".join(SUPERSCRIPTS[x] for x in run[0]))))
        return run.end()
    if c == "^":
        end = text.find(")", at) if text[at + 1] == "(" else at + 1
        found.append(("sup", tokens(text[at + 1 : end + 1].strip("()"), known)))
        return end + 1
    if c == "d" and text[at + 1 : at + 2].isalpha():
        found.append(("word", "d"))
        return at + 1
    if c == "_":
        return _lowered(text, at + 1, names, known, found)
    simple = {"‖": ("norm", ""), "|": ("size", ""), "‾": ("sup", [("op", "⊤")])}
    simple |= {"𝟏": ("tree", ("one",)), "∂": ("word", "∂"), "∞": ("op", "∞")}
    simple |= {"*": ("sup", [("op", "*")])}
    if c in simple:
        found.append(simple[c])
    elif c in OPERATORS:
        found.append(("op", OPERATORS[c]))
    elif c in FRACTIONS:
        found.append(("number", FRACTIONS[c]))
    elif c in "([⟨)]⟩":
        found.append(("open" if c in "([⟨" else "close", c))
    elif run := LETTER.match(text, at):
        name = unicodedata.normalize("NFC", run[1] + run[2]) + run[4]
        found.append(("barred", ("T", name)) if run[3] else ("name", name))
        return run.end()
    else:
        raise UnreadableError(f"{c!r} in {text!r}")
    return at + 1


def _lowered(text, at, names, known, found):
    """After _: the metric of brackets, or the index of a letter."""
    if found[-1] in (("close", "⟩"), ("norm", "")) or found[-2:] == [("norm", ""), ("sup", 2)]:
        inside = []
        if text[at] == "(":
            depth, end = 0, at
            while end == at or depth:
                depth += (text[end] == "(") - (text[end] == ")")
                end += 1
            inside = tokens(text[at:end], known)
            at = end
        else:
            at = _token(text, at, names, known, inside)
            while at < len(text) and text[at] in f"⁻{''.join(SUPERSCRIPTS)}‾":
                at = _token(text, at, names, known, inside)
        found.append(("sub", inside))
        return at
    if found[-1] == ("name", "∇"):
        inside = []
        at = _token(text, at, names, known, inside)
        found.append(("sub", inside))
        return at
    run = re.compile(r"[A-Za-z0-9,]*[A-Za-z0-9𝐦𝐧]").match(text, at)
    if not run:
        raise UnreadableError(f"no index in {text[at - 9 : at + 9]!r}")
    found.append(("sub", [("name", run[0])]))
    return run.end()


def formula(text, known):
    """One formula."""
    return parsed(tokens(text, known), known, raw=False)


def page(text, known, labels):
    """The equations of every step, by its label, as pairs of trees."""
    found, label, lines, begun = {}, None, [], False
    for line in [*text.split("\n"), "end"]:
        head = HEADING.match(line)
        if label and begun and line and not line.startswith(" "):
            found[label] = [equation(tokens(x, known), known) for x in _equations(lines)]
            label, lines = None, []
        if head and head[1] in labels:
            label, begun = head[1], False
        begun = begun or line.startswith(" ")
        if label and line.startswith(" " * 6):
            lines.append(line[6:])
    return found


SAID = re.compile(
    r"(?:^|  |, )"
    r"(?:for every|for some|along the motion|pour tou|pour un|le long du|\((?:a|un) param).*$"
)


def _equations(lines):
    """What is one equation: a left side may fill lines of its own, a right side go on deeper."""
    said, found, begun = False, [], []
    for line in lines:
        inner = SAID.sub("", line).rstrip()
        if said and line.startswith(" ") and " = " not in line:
            continue
        said = inner != line.rstrip()
        if not inner.strip():
            continue
        cells = re.split(r" {4,}(?=\S)", inner.strip())
        if len(cells) > 1 and all(" = " in x for x in cells):
            found += cells
        elif " = " in inner:
            found.append(" ".join((*begun, inner)))
            begun = []
        elif begun or not inner.startswith(" "):
            begun.append(inner)
        else:
            found[-1] = f"{found[-1]} {inner.strip()}"
    if begun:
        raise UnreadableError(f"no equation: {begun}")
    return found
