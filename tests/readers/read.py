"""Does a page say the equations of its record, and a formula its tree?"""

from functools import partial
from itertools import zip_longest

from derive.language.show import show
from derive.views import html
from derive.views import latex as latex_view
from derive.views import text as markdown_view
from derive.views import text as text_view
from derive.views.language import language
from derive.views.outline import assumed, latex_names
from derive.views.printing.letters import standard, styled
from derive.views.printing.sentences import FORMULA, dollars, prose
from derive.views.printing.signs import Notation, markdown_text, tex_text
from derive.views.printing.tex import formula, latex_tree
from tests.readers import latex, markdown, mathml, sentence, text
from tests.readers.formula import Letters, UnreadableError, canonical, letters_of
from tests.support import random_trees

TOP = Notation(transpose="top")
FRENCH = language("fr")
PAGES = {
    "text": lambda d: text_view.text(d),
    "narrow text": lambda d: text_view.text(d, 60),
    "latex": lambda d: latex_view.latex(d),
    "markdown": lambda d: markdown_view.markdown(d),
    "html": lambda d: html.html([d]),
    "html, top": lambda d: html.html([d], TOP),
    "text, fr": lambda d: text_view.text(d, language=FRENCH),
    "latex, fr": lambda d: latex_view.latex(d, language=FRENCH),
}
READERS = {"text": text, "latex": latex, "markdown": markdown, "html": mathml}


def faults(d, kind):
    """What of a record its page does not say, or says otherwise: a line for each step."""
    reader = READERS[kind.removeprefix("narrow ").partition(",")[0]]
    known = letters_of(d)
    plain = reader is text
    try:
        said = reader.page(PAGES[kind](d), known, {s.label for s in d.steps})
    except (UnreadableError, ValueError) as error:
        return [f"{d.name}, {kind}: {error}"]
    return [
        f"{d.name}, {kind}, {step.label}: {wrong}"
        for step in d.steps
        if (wrong := missing(step.equations, said.get(step.label, []), known, plain))
    ]


BOLD = "𝐦"
"""A mass beside a parameter m; elsewhere a point of a lattice."""


def unbold(tree):
    """A tree with the letter of masses as the record has it."""
    if isinstance(tree, tuple):
        return tuple(map(unbold, tree))
    return "m" if tree == BOLD else tree


def missing(equations, said, known, plain):
    """The first equation that is not there in its place; empty where all are.

    That a parameter is itself may be left out, and entries of a matrix may be letters that the
    next equations explain.
    """
    bold = "m" in known.parameters and BOLD not in known.letters
    left = [tuple(canonical(unbold(x) if bold else x, known, plain) for x in e) for e in said]
    for e in equations:
        want = tuple(canonical(x, known, plain) for x in (e.lhs, e.rhs))
        have = left.pop(0) if left and left[0][0] == want[0] else None
        if have is None and want[1] in (want[0], ("par", "_".join(want[0][1:]))):
            continue
        while have and have != want and left and letter_of(left[0][0], want[0]):
            letter, meaning = left.pop(0)
            have = (have[0], _put(have[1], letter, meaning))
        if have != want:
            return f"{want} is {have}"
    return f"too much: {left}" if left else ""


def letter_of(x, matrix):
    """Is it an entry of the matrix?"""
    return isinstance(x, tuple) and x[0] == "sub" and x[1] == matrix


def _put(t, old, new):
    if t == old:
        return new
    return (t[0], *(_put(x, old, new) for x in t[1:])) if isinstance(t, tuple) else t


# -- sentences -----------------------------------------------------------------------------------


def said(d, words):
    """The sentences of a record in a language, as its steps and names have them."""
    for step in d.steps:
        yield from (words.of(step.prose), *assumed(step, words))
    for s in d.symbols:
        yield words.of(s.meaning)


def misread_sentences(d, words):
    """What a format shows as something else: the format, what is said, what is shown, of a whole
    sentence as its letters, numbers and signs, and of each of its formulas as a tree."""
    known, names = letters_of(d), latex_names(d)
    own = partial(dollars, names=names)
    for x in dict.fromkeys(said(d, words.marked)):
        known = sentence.with_quoted(known, x)
        want, trees = sentence.plain(x.replace(FORMULA, ""), known), [*formulas(x, "text", known)]
        for kind, shown in (
            ("latex", styled(prose(x, tex_text, own))),
            ("markdown", standard(prose(x, markdown_text, own))),
            ("html", html.words(x, Notation(), names)),
        ):
            line = SENTENCES[kind](shown, known)
            if line != want:
                yield kind, want, line
            read = [*formulas(shown, kind, known)]
            yield from ((kind, a, b) for a, b in zip_longest(trees, read) if a != b)


SENTENCES = {
    "latex": sentence.of_latex,
    "markdown": sentence.of_markdown,
    "html": sentence.of_html,
}


def formulas(shown, kind, known):
    """The trees of the formulas of a sentence, as a format has them."""
    for tokens in sentence.formulas(shown, kind, known):
        yield canonical(sentence.statement(tokens, known, raw=kind != "text"), known, True)


# -- formulas ------------------------------------------------------------------------------------

FORMULAS = {
    "text": lambda t, known: text.formula(show(t), known),
    "latex": lambda t, known: latex.formula(latex_tree(t), known),
    "macros": lambda t, known: latex.formula(styled(latex_tree(t)), known),
    "mathml": lambda t, known: mathml.formula(formula(t).mathml(), known),
    "mathml, top": lambda t, known: mathml.formula(formula(t, None, TOP).mathml(), known),
}
KNOWN = Letters(random_trees.OWN | {"δ"}, {*random_trees.PARAMETERS})


def misread(t, known=KNOWN):
    """The formats whose reader does not find the tree again."""
    for kind, read in FORMULAS.items():
        plain = kind == "text"
        try:
            found = canonical(read(t, known), known, plain)
        except (UnreadableError, ValueError) as error:
            found = error
        if found != canonical(t, known, plain):
            yield kind, t, found
