"""The printers made wrong, one change of their source at a time: which do the readers not see?

python -m tests.support.printing_mutations
"""

import importlib
import inspect
import random
import sys
import types
from contextlib import contextmanager
from dataclasses import replace
from fractions import Fraction

from derive.record.record import Equation, Step, Symbol
from derive.record.sentence import say
from derive.views.language import ENGLISH
from tests.readers.read import PAGES, faults, misread, misread_sentences
from tests.support import random_trees
from tests.support.walks import record

SHOW, TREES, TYPESET = "language.show", "views.printing.tex", "views.printing.typeset"
LETTERS, TEXT, LAYOUT, HTML = "views.printing.letters", "views.text", "views.layout", "views.html"
NAMES, INLINE, SIGNS = "views.printing.letters", "views.printing.sentences", "views.printing.signs"
GLUE, MACROS, ENTRIES = "views.printing.letters", "views.printing.letters", "views.language"

MUTATIONS = {
    "text: Σ of a sum without brackets": (
        SHOW, 'return f"Σ{_index(arguments[0])} " + (f"({text})" if level == SUM else text)',
        'return f"Σ{_index(arguments[0])} " + text'),
    "text: a long left side loses its first lines": (TEXT, "        yield from before\n", ""),
    "LaTeX: a long left side loses its continuation": (
        LAYOUT, '"&" + guarded(first.text), *("&" + indented(x, 1) for x in others)]',
        '"&" + guarded(first.text)]'),
    "text: x_123 shown as x_12": (
        SHOW, "return base + index.translate(SUBSCRIPTS)",
        "return base + index[:2].translate(SUBSCRIPTS)"),
    "LaTeX: x_123 shown as x_12": (
        LETTERS, "sans(match[2], match[2])", "sans(match[2][:2], match[2])"),
    "text: a sum as a factor without brackets": (
        SHOW, "if level == SUM or inside or (text and _spread(f)) else shown",
        "if inside or (text and _spread(f)) else shown"),
    "text: the terms of a sum all with +": (SHOW, 'f" {sign} {term}"', 'f" + {term}"'),
    "text: the sign of the first term lost": (
        SHOW, 'text = ("−" if first[0] == "−" else "") + first[1]', "text = first[1]"),
    "text: no bar": (SHOW, r'{match[2]}\u0304{match[3]}', "{match[2]}{match[3]}"),
    "text: the bar over the wrong letter": (
        SHOW, r'f"{match[1]}{match[2]}\u0304{match[3]}" if match',
        r'f"{match[1]}\u0304{match[2]}{match[3]}" if match'),
    "text: what is divided by in no brackets": (
        SHOW, "raised or isinstance(t, Fraction) else _atom(t)", "raised else show(t)"),
    "text: |x| as x": (SHOW, 'else f"|{show(t)}|"', "else show(t)"),
    "trees: |x| as ‖x‖": (TREES, r'literal(r"\lvert ")', r'literal(r"\lVert ")'),
    "text: a quotient upside down": (
        SHOW, 'text = f"{above}/{_base(arguments[1])}"',
        'text = f"{_base(arguments[1])}/{above}"'),
    "text: Tr of a sum without brackets": (
        SHOW, 'f"Tr {text}" if level >= PRODUCT else f"Tr({text})"', 'f"Tr {text}"'),
    "text: a ∧ (b ∧ c) without brackets": (
        SHOW, 'return f"({text})" if level == SUM or swallows(t) else text',
        'return f"({text})" if level == SUM else text'),
    "text: an exponent dropped": (
        SHOW, "return base + str(a[1])", "return base + str(2)"),
    "text: letters of a product run together with names": (
        SHOW, 'return " " if WORD.search(text + piece) else ""', 'return ""'),
    "text: the metric of a norm left out": (
        SHOW, '(f"_{_below(a[0])}" if len(a) == 2 else "")', '""'),
    "text: rows and entries with one mark": (SHOW, '"; ".join(show(row)', '", ".join(show(row)'),
    "text: no quotes": (TEXT, "return unclear(own, named_numbers(d), symbolic)",
                        "return frozenset()"),
    "text: continued lines lost": (
        TEXT, 'lines = [f"{lead} = {first[indent:]}", *others]',
        'lines = [f"{lead} = {first[indent:]}"]'),
    "LaTeX: x1 and x_1 alike": (
        LETTERS, 'if f"par {name}" in names:', "if False:"),
    "LaTeX: continued lines lost": (
        LAYOUT, '*("&" + indented(x, 1) for x in lines[1:])]', "]"),
    "macros: the index of a barred letter lost": (
        MACROS, r'"\\transpose{\1\2}{\3}"'.replace('"', 'r"', 1), 'r"\\\\transpose{\\1\\2}{}"'),
    "HTML: terms lost": (
        HTML, "inside = (self.nested(x, follows or k > 0) for k, x in enumerate(groups(parts)))",
        "inside = (self.nested(x, follows or k > 0) for k, x in enumerate(groups(parts)[:1]))"),
    "trees: Σ of a sum without brackets": (
        TREES, "return lead + (paren(f) if level == SUM else f), PRODUCT",
        "return lead + f, PRODUCT"),
    "trees: a wide fraction upside down": (
        TREES, "joined([as_factor(x) for x in shown], stroke)",
        "joined([as_factor(x) for x in shown[::-1]], stroke)"),
    "trees: a minus lost": (
        TREES, 'mark = "-" if sign == "−" else "+"', 'mark = "+"'),
    "trees: a sum as a factor without brackets": (
        TREES, "if level == SUM or inside or wedge:", "if inside or wedge:"),
    "trees: a trace that takes in the next factor": (
        TREES, 'reaches = isinstance(x, tuple) and x[0] in ("tr", "det", "sum", "wedge")',
        "reaches = False"),
    "trees: the bar over the first factor alone": (
        TREES, "inside = self.bare(a).plain()\n        return barred(",
        'inside = self.bare(a[1] if a[0] == "mul" else a).plain()\n        return barred('),
    "trees: two indices as one": (
        TREES, 'literal("," if any(len(i.tex) > 1 for i in shown) else "")', 'literal("")'),
    "trees: powers without brackets": (
        TREES, 'return paren(f) if SCRIPTED.search(outside(f.tex)) or (over and f.tex[0] != "(") '
        "else f", "return f"),
    "trees: ∧ turned round": (
        TREES, "return joined(sides, literal(", "return joined(sides[::-1], literal("),
    "trees: the wrong power of a function": (TREES, "literal(str(n)))", 'literal("2"))'),
    "trees: an entry of a matrix lost": (
        TREES, "return [_stacked(self.bare(x)) for x in row[1:]]",
        "return [_stacked(self.bare(x)) for x in row[1:3]]"),
    "trees: the last line of a long entry lost": (
        TREES, "return stacked(lines)", "return stacked(lines[:-1])"),
    "trees: (A⁻¹)₁₂ and (A₁₂)⁻¹ alike": (
        TREES, 'scripted = level != ATOM or re.search("[_^]", f.tex)', "scripted = level != ATOM"),
    "trees: numbers side by side": (GLUE, "        return DOT\n", "        return SPACE\n"),
    "LaTeX: a fraction upside down": (
        TYPESET, r"\frac{{{a.tex}}}{{{b.tex}}}", r"\frac{{{b.tex}}}{{{a.tex}}}"),
    "LaTeX: an exponent lost": (
        TYPESET, 'f"{f.tex}^{{{exponent.tex}}}"', "f.tex"),
    "LaTeX: a root of nothing": (TYPESET, r"\sqrt{{{f.tex}}}", r"\sqrt{{}}"),
    "MathML: index and exponent exchanged": (
        TYPESET, "{one(self.below)}{one(above)}</msubsup>",
        "{one(above)}{one(self.below)}</msubsup>"),
    "MathML: an infix minus printed as plus": (
        TYPESET, 'found[-1] += f"{escape(x.shown)}</mo>"',
        """found[-1] += f"{'+' if form == 'infix' else escape(x.shown)}</mo>\""""),
    "MathML: a fraction upside down": (
        TYPESET, "<mfrac>{one(a.row())}{one(b.row())}</mfrac>",
        "<mfrac>{one(b.row())}{one(a.row())}</mfrac>"),
    "MathML: no bar": (
        TYPESET, """f'<mrow class="overline">{inside}</mrow>'""", "inside"),
    "MathML: primes lost": (TYPESET, """{"′" * count}""", '{""}'),
    "MathML: a digit of a number lost": (
        TYPESET, 'return f"<mn>{token}</mn>"', 'return f"<mn>{token[:1]}</mn>"'),
    "MathML: accents exchanged": (
        TYPESET, 'ACCENTS = {"dot": "˙", "tilde": "~"', 'ACCENTS = {"dot": "~", "tilde": "˙"'),
    "MathML: a parameter like a letter": (
        TYPESET, '<mi mathvariant="normal" class="parameter">{escape(shown)}</mi>',
        "<mi>{escape(shown)}</mi>"),
    "MathML: rows run together": (
        TYPESET, 'body = "".join(f"<mtr>{x}</mtr>" for x in cells)', 'body = "".join(cells)'),
    "names: the prefix of a variation lost": (
        NAMES, 'whole = _letter_in_full(tex, found["lead"], letter',
        'whole = _letter_in_full(tex, "", letter'),
    "names: an index lost under a bar": (
        NAMES, "return _letter_in_full(whole, lead, letter, primes, below)",
        'return _letter_in_full(whole, lead, letter, primes, "")'),
    "sentences: a relation without its stroke": (
        SIGNS, "x if x[0].isalpha() else c for", "x for"),
    "sentences: ≤ as ≥": (SIGNS, r'"≤": r"\le"', r'"≤": r"\ge"'),
    "sentences: a prime lost": (INLINE, 'primed(_open(found, "\'"))', 'found'),
    "sentences: the prime of an index lost": (
        INLINE, 'primed(shown, letters.count("′"))', "shown"),
    "sentences: a parameter like a letter": (
        INLINE, "found += quoted(own, names)", "found += literal(own)"),
    "sentences: a decimal cut": (INLINE, 'number.replace(",", "{,}")', "number[:1]"),
    "sentences: an exponent lost": (
        INLINE, 'raised(_open(found, "^"), spelt(exponent, notation, names))', "found"),
    "sentences: a root of nothing": (
        INLINE, "root(spelt(inside or called, notation, names))", 'Formula("")'),
    "sentences: one dot for two": (SIGNS, r'"\u0308": r"\ddot"', r'"\u0308": r"\dot"'),
    "sentences: an accent for another": (SIGNS, r'"\u0303": r"\tilde"', r'"\u0303": r"\hat"'),
}  # fmt: skip
"""What is changed → the module, its source, and what stands there instead."""


HARD = say(
    "Where {cases} and {other}, there is {that}.",
    cases="A₁₂² ≠ 0, δ′h̃ ≤ ½ + √(21), ‘x1’ ‘sn’ > −‘x₁’",
    other="∇_η′ u ≈ 4.58, P′ = 0, ψ̈ = S̈",
    that="g⁻¹δ′g",
)
"""A sentence that has what is rare in sentences."""


def hard():
    """A record of what is rare: long sides, wide fractions, long names, powers of members."""
    terms = (("mul", ("par", f"x_{k}"), ("entry", "ζ", k % 3 + 1)) for k in range(101, 131))
    long = ("add", *terms)
    left = ("inner", ("add", *(("mul", ("at", "m", k), "α", "c") for k in range(1, 30))), "w")
    wide = ("div", long, ("add", ("par", "x_101"), ("par", "x_99")))
    power = ("mul", ("pow", ("at", "m", "i"), 3), ("pow", ("fun", "cos", ("par", "x_1")), 3))
    total = ("sum", "i", ("add", ("at", "m", "i"), ("mul", -1, ("par", "x_1"))))
    word = ("mul", ("par", "s"), ("par", "i"), ("par", "n"), ("add", ("par", "s"), -2))
    two = ("add", ("mul", ("par", "x1"), 3, 5), ("mul", Fraction(-2, 3), ("par", "x_1")))
    barred = ("mul", ("T", "p_b"), ("T", "ℓ̇_b"), ("T", ("at", "E", "a")))
    equations = [
        *(Equation("h̃", t) for t in (long, wide, power, total, word, two, barred)),
        Equation(left, ("mul", 2, left)),
        Equation("t", ("tr", ("add", ("T", "J"), ("mul", -1, "J")))),
        Equation("c", ("mul", ("par", "w"), "w")),
        Equation(("at", "E", 1), ("matrix", ("row", long), ("row", ("par", "sn")))),
        Equation("J", ("matrix", ("row", wide, long, "t"), ("row", 1, 2, 3))),
    ]
    names = ("ζ", "m", "α", "c", "w", "h̃", "J", "p_b", "ℓ̇_b", "E", "t")
    named = ("x1", *"sinw", "sn", *(f"x_{k}" for k in (1, 99, *range(101, 131))))
    given = {x: {"default": None, "unit": "", "meaning": ""} for x in named}
    d = record("two_tops")
    scope = d.steps[-1].scope
    step = Step("hard.step", "definition", (), tuple(equations), HARD, (), scope=scope)
    problem = {**d.problem, "parameters": {**d.problem["parameters"], **given}}
    symbols = tuple(Symbol(x, say("a letter"), "") for x in names)
    return replace(d, problem=problem, symbols=symbols, steps=(step,))


@contextmanager
def changed(module, old, new):
    """With one change of the source of a module, in all who hold its functions."""
    module = importlib.import_module(f"derive.{module}")
    source = inspect.getsource(module)
    assert source.count(old) == 1, f"{module.__name__} has {source.count(old)} of {old}"
    fresh = types.ModuleType(module.__name__)
    fresh.__dict__.update(__package__=module.__package__, __file__=module.__file__)
    sys.modules[module.__name__] = fresh  # where dataclasses look
    exec(compile(source.replace(old, new), module.__file__, "exec"), fresh.__dict__)
    sys.modules[module.__name__] = module
    undo = [*_transplanted(vars(module), vars(fresh))]
    _forget()
    try:
        yield
    finally:
        for restore in undo:
            restore()
        _forget()


def _forget():
    """What functions of the printers remember."""
    for name, module in [*sys.modules.items()]:
        if name.startswith("derive.views.printing."):
            for x in vars(module).values():
                getattr(x, "cache_clear", int)()


def _transplanted(old, new):
    """The code of the new functions and methods put into the old; how to undo each."""
    for name, x in [*old.items()]:
        x, y = (getattr(f, "__wrapped__", f) for f in (x, new.get(name)))
        if isinstance(x, types.FunctionType) and isinstance(y, types.FunctionType):
            if x.__code__ != y.__code__:
                code, x.__code__ = x.__code__, y.__code__
                yield lambda x=x, code=code: setattr(x, "__code__", code)
        elif isinstance(x, type) and x.__module__ == old["__name__"]:
            yield from _transplanted({**vars(x), "__name__": ""}, vars(y))
        elif isinstance(x, dict) and x != y and not name.startswith("__") and type(y) is dict:
            kept = dict(x)
            x.update(y)
            yield lambda x=x, kept=kept: x.update(kept)


def seen(trees, records):
    """What the readers see of a change that is made."""
    for t in trees:
        yield from misread(t)
    for d in records:
        for kind in PAGES:
            yield from faults(d, kind)
        yield from misread_sentences(d, ENGLISH)


def material():
    """Trees and records that between them have all that is printed."""
    draw = random.Random(7)
    trees = [random_trees.tree(draw, k % 4) for k in range(250)]
    return trees, [hard(), record("two_tops"), record("sl3")]


def caught(name, trees, records):
    """Is this change seen?"""
    with changed(*MUTATIONS[name]):
        try:
            return next(iter(seen(trees, records)), None) is not None
        except (AssertionError, KeyError, TypeError, ValueError, IndexError):
            return True


def main():
    """A line for each; whether all are seen."""
    trees, records = material()
    assert not [*seen(trees, records)]
    held = {name: caught(name, trees, records) for name in MUTATIONS}
    for name, found in held.items():
        print(f"{'seen' if found else 'NOT SEEN':10}{name}")
    print(f"printers: {sum(held.values())} of {len(held)} changes are seen\n")
    return all(held.values())


if __name__ == "__main__":
    sys.exit(not main())
