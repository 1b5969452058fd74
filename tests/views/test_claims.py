"""What a sentence claims it claims in both languages: the negations of an entry, and its terms."""

import re

from derive.views.language import catalogue_entries

ENTRIES = [(x["en"], x["fr"]) for x in catalogue_entries()]
DENIED = re.compile(r"\b(?:not|no|none|never|nothing|neither|nor|without|cannot)\b", re.I)
NE = r"\b(?:ne |n[’'])"
ONLY = re.compile(
    NE + r"(?:(?!\b(?:pas|aucune?|ni)\b|\bne |\bn[’']|[.;:]).)*?\bqu(?:e |[’'])", re.I
)
NE_PAS = re.compile(NE + r"(?:(?!\bne |\bn[’']|[.;:]).)*?\bpas\b", re.I)
OTHERS = re.compile(r"\b(?:non|absence|sans(?! empattement)|(?<!trace )(?<!vide )nulle)\b", re.I)

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
    r"first moment": r"premier moment",
    r"kinetic": r"(?<!moment )cinétiques?",
    r"angular momentum": r"moment cinétique",
    r"potentials?": r"potentiels?",
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
    r"inputs?(?! forces)": r"commandes?|entrées?",
    r"if and only if": r"si et seulement si",
    r"at least": r"au moins",
    r"at most": r"au plus",
    r"dimension": r"dimension",
    r"drops? out": r"disparaît|disparaisse",
}


def negations(french):
    """How often a French sentence says no; *ne … que* says *only*."""
    alone = len(re.findall(r"\bpas\b", french, re.I)) - len(NE_PAS.findall(french))
    denied = len(re.findall(NE, french, re.I)) - len(ONLY.findall(french))
    return denied + alone + len(OTHERS.findall(french))


def has(term, text):
    return re.search(rf"(?<!\w)(?:{term})(?!\w)", text, re.I) is not None


def wrong(english, french):
    """What one language claims and the other does not."""
    found = [] if len(DENIED.findall(english)) == negations(french) else ["a negation"]
    return found + [e for e, f in TERMS.items() if has(e, english) != has(f, french)]


def test_both_languages_claim_the_same():
    assert [(english, x) for english, french in ENTRIES for x in wrong(english, french)] == []
