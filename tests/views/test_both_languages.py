"""The two languages of a sentence have the same formulas, numbers and places, in the same order,
and claim the same: the negations of an entry, and its terms."""

import re
import unicodedata
from collections.abc import Iterable, Iterator
from pathlib import Path

from derive import lecture
from derive.record.prose import unmarked
from derive.views.language import catalogue_entries
from tests.support.capabilities import about_options

ENTRIES = [(unmarked(x["en"]), unmarked(x["fr"])) for x in catalogue_entries()]

MARKS = r"[\u0300-\u036f]"
LETTER = rf"(?:[A-Za-zÀ-ÖØ-öø-ÿœŒ](?!{MARKS}))"
WORD = re.compile(rf"{LETTER}+(?:[-–’']{LETTER}+)*")
ELISION = re.compile(r"\b(?:[dlnscjmt]|(?:jusqu|lorsqu|puisqu|qu))[’'](?=\S)", re.I)
ARTICLES = ("a", "y", "à", "À")
"""Words of one letter; each other letter is a formula, but for A where a sentence begins."""
NAMES = ("Tr", "det", "dm")
PUNCTUATION = "«»“”‘’\"'$.,;:!?"
ZERO = r"\bzero\b"
NUL = r"\b(?<!est )nul\b|(?:(?<=trace )|(?<=vide ))nulle\b"
"""How English and French say 0 in words."""

REORDERED = {
    "An element g = A of the group G moves the body": (3, 0, 1, 2),
    "An element g = (A, T) of the group G moves the body": (4, 0, 1, 2, 3),
    "The Lagrangian L of the points is pulled back": (1, 0, 2, 3),
    "Between two elements of the Lie algebra C drops out: A keeps": (0,),
}
"""Beginning of a sentence → the places in English of the formulas of the French."""

NUMBERS = {
    **{"two": "deux", "three": "trois", "four": "quatre", "fourth": "quatre"},
    **{"six": "six", "seven": "sept", "eight": "huit", "nine": "neuf", "ten": "dix"},
}
BOTH = r"\b(?:tous|toutes|aux) deux\b"


def formulas(text: str) -> Iterator[str]:
    """What is no word between spaces, without the punctuation of the sentence."""
    whole = re.sub(r"(?:^|(?<=\. ))A ", "", unicodedata.normalize("NFC", text))
    for piece in ELISION.sub("", whole).split():
        x = piece.strip(PUNCTUATION)
        for left, right in ("()", "[]"):
            if x.count(left) > x.count(right):
                x = x.removeprefix(left)
            if x.count(right) > x.count(left):
                x = x.removesuffix(right)
        x = x.strip(PUNCTUATION)
        x = inner[1] if (inner := re.fullmatch(r"\((\{\w+\}|[^()]{3,})\)", x)) else x
        alone = x in NAMES or (len(x) == 1 and x not in ARTICLES) or re.search("[a-z][A-Z]", x)
        if alone or (x and not WORD.fullmatch(x)):
            yield x


def in_order(english: str) -> list[str]:
    """The formulas of an English sentence in the order of the French."""
    found = [*formulas(re.sub(ZERO, "0", english))]
    for beginning, order in REORDERED.items():
        if english.startswith(beginning):
            return [found[i] for i in order]
    return found


def numbers(words: str, table: dict[str, str]) -> list[str]:
    """The numbers that a sentence says in words, in French and in order."""
    return [table[x] for x in re.findall(r"\w+", words.lower()) if x in table]


def wrong(english: str, french: str) -> list[str]:
    """What one language states and the other does not."""
    same = in_order(english) == [*formulas(re.sub(NUL, "0", french))]
    said = numbers(re.sub(BOTH, "", french), {x: x for x in NUMBERS.values()})
    return ["formulas"] * (not same) + ["numbers"] * (numbers(english, NUMBERS) != said)


def test_both_languages_have_the_same_formulas():
    told = [(english, french) for english, french in ENTRIES if english not in about_options()]
    assert [(english, x) for english, french in told for x in wrong(english, french)] == []


def test_what_stands_in_another_order_is_listed():
    assert all(any(e.startswith(x) for e, _ in ENTRIES) for x in REORDERED)


# -- claims ---------------------------------------------------------------------------------------

DENIED = re.compile(r"\b(?:not|no|none|never|nothing|neither|nor|without|cannot)\b", re.I)
NE = r"\b(?:ne |n[’'])"
ONLY = re.compile(
    NE + r"(?:(?!\b(?:pas|aucune?|ni)\b|\bne |\bn[’']|[.;:]).)*?\bqu(?:e |[’'])", re.I
)
NE_PAS = re.compile(NE + r"(?:(?!\bne |\bn[’']|[.;:]).)*?\bpas\b", re.I)
SAYING_NO = re.compile(r"\b(?:non|absence|sans(?! empattement)|(?<!trace )(?<!vide )nulle)\b", re.I)

# each English term with its French, both as patterns of words
TERMS = {
    r"(?<!non-)invertible": r"inversible",
    r"skew": r"antisymétriques?",
    r"diagonal(?:ise)?s?": r"diagona\w*",
    r"orthogonal": r"orthogona\w+",
    r"constant": r"constante?s?",
    r"positive": r"positi(?:f|ve)s?",
    r"negative": r"négati(?:f|ve)s?",
    r"kernel": r"noyau",
    r"tensor": r"tenseur",
    r"inertia": r"inertie",
    r"first moment": r"moment d’ordre un",
    r"kinetic": r"(?<!moment )cinétiques?",
    r"angular momentum": r"moment cinétique",
    r"potentials?": r"potentiel(?:s|le)?",
    r"energy": r"énergie",
    r"brackets?": r"crochets?",
    r"volumes?": r"volume|volumes",
    r"rotations?": r"rotations?",
    r"matri(?:x|ces)": r"matrices?",
    r"Lie algebra": r"algèbre de Lie",
    r"spans?": r"engendrent|engendre",
    r"springs?": r"ressorts?",
    r"damp(?:ing|ed)": r"amorti(?:ssement|s)?",
    r"manifold": r"variété",
    r"symplectic": r"symplectiques?",
    r"extremals?": r"extrémales?",
    r"commut(?:e|es|ative)": r"commut(?:ent|e|atif)",
    r"nilpotent": r"nilpotentes?",
    r"hyperplane": r"hyperplan",
    r"geodesics?": r"géodésiques?",
    r"multiplier": r"multiplicateur",
    r"Cartan": r"Cartan",
    r"Noether": r"Noether",
    r"left-invariant": r"invariante? à gauche",
    r"eliminated": r"éliminée?",
    r"(?<!\{)entr(?:y|ies)|coefficients?": r"coefficients?",
    r"inputs?(?! forces)": r"commandes?",
    r"loads?": r"forces? généralisées?",
    r"if and only if": r"si et seulement si",
    r"at least": r"au moins",
    r"at most": r"au plus",
    r"dimension": r"dimension",
    r"drops? out": r"disparaît|disparaisse",
}


A_STEP = re.compile(r"\b(?:un(?: même)?|du|des|les?|deux|par|à) pas\b", re.I)


def negations(french):
    """How often a French sentence says no; *ne … que* says *only*, *un pas* is a step."""
    french = A_STEP.sub("", french)
    alone = len(re.findall(r"\bpas\b", french, re.I)) - len(NE_PAS.findall(french))
    denied = len(re.findall(NE, french, re.I)) - len(ONLY.findall(french))
    return denied + alone + len(SAYING_NO.findall(french))


def has(term, text):
    return re.search(rf"(?<!\w)(?:{term})(?!\w)", text, re.I) is not None


def misclaimed(english, french):
    """What one language claims and the other does not."""
    found = [] if len(DENIED.findall(english)) == negations(french) else ["a negation"]
    return found + [e for e, f in TERMS.items() if has(e, english) != has(f, french)]


def test_both_languages_claim_the_same():
    assert [(english, x) for english, french in ENTRIES for x in misclaimed(english, french)] == []


# -- words that the French texts do not use -------------------------------------------------------

AVOIDED = (
    *(r"premiers? moments?", r"quantités? de mouvement", r"entrées?", r"réétiquet\w*"),
    *(r"zigzags?", r"anneaux?", r"en les", r"en celles?(?:-ci)? et", r"demeurent?"),
    *(r"dans les lettres de", r"corps à l’identité", r"(?:son|leur) contour est libre"),
    *(r"l’impulsion sur le", r"l’énergie sur le temps", r"le long de la pesanteur"),
    r"mis(?:e|es)? dans dϖ",
    *(r"(?:meut|meuvent|tournent?) (?:celui|celle|le|la|les)\b", r"charges le long"),
)
"""One French term each, that of the table above, and sentences that are French: no calques."""
CHAPTERS = Path(lecture.__file__).parent / "chapters"


def calques(texts: Iterable[str]) -> list[str]:
    """The French texts in which a word stands that they do not use."""
    return [x for x in texts if any(has(word, x) for word in AVOIDED)]


def test_french_texts_use_the_terms_of_the_table():
    chapters = [x for path in CHAPTERS.glob("*.txt") for x in path.read_text("utf-8").split("\n")]
    assert min(len(ENTRIES), len(chapters)) > 500
    assert calques([french for _, french in ENTRIES] + chapters) == []


def test_calques_are_found():
    assert calques(("Un polynôme en les coefficients.", "Un polynôme des coefficients.")) == [
        "Un polynôme en les coefficients."
    ]
