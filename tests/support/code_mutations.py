"""Single changes of emitted code: signs, products, terms, names, indices, numbers.

Left alone are comments, the error checks of ``constants`` and what is computed for these alone.
"""

import math
import re

TOKEN = re.compile(r"[A-Za-z_]\w*|[0-9]+\.[0-9]*(?:e[+-]?[0-9]+)?f?|[0-9]+(?:e[+-]?[0-9]+)?|\S")
CHANGED = "constants|rhs|rhs_batch|energy|project|defect|to_matrix|from_matrix"
BODIES = {
    "c": r"^\w[^\n;]*?_({})\([^;{{]*?\)\n\{{\n(.*?)^\}}",
    "python": r"^def _({})\([^)]*\):\n(.*?)(?=^def |\Z)",
    "rust": r"^(?:pub )?fn ({})\([^{{]*\{{\n(.*?)^\}}",
    "javascript": r"^(?:export )?function ({})\(.*?\) \{{\n(.*?)^\}}",
    "julia": r"^function ({})!?\([^\n]*\)\n(.*?)^end",
}
FAILING = {
    "rust": r"    if [^\n]*\{$.*?^    \}$|    let _ = [^\n]*;$",
    "javascript": r"    if \(.*?^    \}$|    u \?\?= ZERO_INPUTS;$",
    "julia": r"    if .*?^    end$|^    (?:length|all)\(.*?throw\([^\n]*$|^    u = u [^\n]*$",
}
"""What of a function is an error check, or for inputs that are not given."""
CHECKS = {
    "c": r"    if \(.*",
    "python": r"    tests = \[.*?^    \]$|, tests$",
    "rust": r"    let margins: .*?^    \];$",
    "javascript": r"    const margins = .*?^    \];$",
    "julia": r"    margins = .*?^    \)$",
}
"""What of ``constants`` serves its error checks."""
COMMENTS = {
    "c": r"/\*.*?\*/|^#[^\n]*",
    "python": r"#[^\n]*",
    "rust": r"//[^\n]*",
    "javascript": r"//[^\n]*",
    "julia": r"#[^\n]*",
}
LINES = ("python", "julia")
"""Languages in which the end of a line ends a statement."""
WORDS = "const double float return int for void size_t xp fabs abs sqrt s n _ p x k u dx out t "
WORDS += "let f64 f32 Math of N_CONSTANTS Ok Float64Array end nothing"
DECLARING = ("double", "float", "const", "let")
KEPT = frozenset(WORDS.split(" "))


def blank(pattern, text):
    """The text with all that matches as spaces."""
    return re.sub(
        pattern, lambda m: re.sub(r"[^\n]", " ", m[0]), text, flags=re.MULTILINE | re.DOTALL
    )


def live(function):
    """The names that what a function gives depends on; none where it does so in a loop."""
    found, body = set(), list(function.body)
    for s in body:
        found |= names_in(s[1:] if s[0] in ("store", "return") else ())
        if s[0] == "for" and any(x[0] == "store" for x in s[3]):
            return None
    for s in reversed(body):
        if s[0] == "set" and s[1] in found:
            found |= names_in(s[2])
    return found


def names_in(e):
    if not isinstance(e, tuple):
        return set()
    own = {e[1]} if e[:1] == ("var",) else set()
    return own.union(*map(names_in, e))


def mutants(text, language, module, names=CHANGED):
    """(function, kind, position, changed text) for every change of functions of these names."""
    for found in re.finditer(BODIES[language].format(names), text, re.MULTILINE | re.DOTALL):
        function, (start, _) = found[1], found.span(2)
        body = blank(COMMENTS[language], found[2])
        body = blank(FAILING[language], body) if language in FAILING else body
        if function == "constants":
            body = blank(CHECKS[language], body)
        body = blank(r"\(void\)\w+;", body)
        used = live(module.functions[function])
        tokens = [(m[0], m.start()) for m in TOKEN.finditer(body)]
        names = [x for x, _ in tokens if x[0].isalpha() and x not in KEPT]
        for i, (_, place) in enumerate(tokens):
            if used is not None and statement(body, place, language) not in used | {""}:
                continue
            for kind, new, length in changes(body, tokens, i, names, language):
                at = start + place
                yield function, kind, at, text[:at] + new + text[at + length :]


def statement(body, place, language):
    """The name that the statement around a place sets; empty for other statements."""
    if language not in LINES:
        begin = max(body.rfind(";", 0, place), body.rfind("{", 0, place)) + 1
        found = re.match(r"\s*(?:const double|const float|const|let) (\w+)(: \w+)? =", body[begin:])
    else:
        found = [*re.finditer(r"^    (\w+) = |^    [(]", body[: place + 1], re.MULTILINE)][-1:]
        found = found[0] if found else None
        if found and re.search(r"^    [\w(]", body[found.end() : place + 1], re.MULTILINE):
            found = None
    return found[1] if found else ""


def changes(body, tokens, i, names, language):
    """(kind, new text, length of what it replaces) for one token."""
    token, place = tokens[i]
    before = tokens[i - 1][0] if i else ""
    binary = before not in ("", "(", "=", "return", "[", ",", "*", "+", "-")
    after = tokens[i + 1][0] if i + 1 < len(tokens) else ""
    if token in "+-" and after != token:
        yield "sign", {"+": "-", "-": "+" if binary else " "}[token], 1
        if binary:
            yield "term", "", term(body, place + 1) - place
    elif token == "*" and binary and before not in ("double", "float"):
        yield "product", "+", 1
    elif token == "/":
        yield "product", "*", 1
    elif re.fullmatch(r"[0-9]+\.[0-9]*(e[+-]?[0-9]+)?", token):
        yield "number", repr(2 * float(token)), len(token)
        yield "number", repr(math.nextafter(float(token), math.inf)), len(token)
    elif token.isdigit() and language != "python":
        yield "index", str(int(token) + 1), len(token)
    elif token in names and before not in DECLARING and after not in ("[", "=", ":"):
        other = names[names.index(token) - 1]  # one that stands before, so that it has a value
        if other != token:
            yield "name", other, len(token)
        turned = re.sub(r"([0-9])([0-9])$", r"\2\1", token)
        if turned != token and turned in names:
            yield "indices", turned, len(token)


def term(body, place):
    """Where the term that begins at a place ends: a long one is broken before a sign only."""
    depth = 0
    while depth or body[place] not in "+-);],\n":
        depth += (body[place] in "([") - (body[place] in ")]")
        place += 1
    return place
