"""What is in the files that are made: text of strangers stays text, in every language."""

import ast
import json
import re
from html.parser import HTMLParser
from xml.etree import ElementTree

MARK = "PWNED"
C_TEXT = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:[^"\\\n]|\\.)*"', re.S)
NAMES = """
    a annotation article aside b body br button caption circle code col dd defs desc details div dl
    dt ellipse em figcaption figure footer g h1 h2 h3 h4 head header html i li line link main marker
    math meta mfrac mi mn mo mover mpadded mrow mspace msqrt mstyle msub msubsup msup mtable mtd
    mtext mtr munder munderover nav ol p path polygon polyline rect script section semantics small
    span cite strong style sub summary sup svg table tbody td text th thead title tr tspan ul
    """
TAGS = {*NAMES.split()}
TEX = "input include write openout openin immediate csname catcode directlua special read newread"
TEX += " newwrite verbatiminput lstinputlisting endinput PWNED scantokens InputIfFileExists"
TEX_COMMAND = re.compile(rf"\\({'|'.join(TEX.split())})(?![A-Za-z])")


def wrong_with(name, text):
    """What is wrong with a file or a walk, by the ending of its name; empty when nothing is."""
    ending = name.rpartition(".")[2]
    try:
        return VIEWS[ending](text) if ending in VIEWS else ""
    except (ValueError, SyntaxError) as error:
        return f"{name}: {type(error).__name__} {error}"


def _html(text):
    page = _Page()
    page.feed(text)
    page.close()
    return "; ".join(page.found[:3])


class _Page(HTMLParser):
    """Tags and attributes that this program does not write."""

    def __init__(self):
        super().__init__()
        self.found, self.scripts = [], 0

    def handle_starttag(self, tag, attrs):
        self.scripts += tag == "script"
        known = tag in TAGS and self.scripts < 2
        for key, value in attrs:
            known &= not key.startswith("on") and MARK not in key
            known &= not (key in ("href", "src") and not re.match("#|$", value or ""))
        if not known:
            self.found.append(f"<{tag} {attrs!r:.100}>")

    def handle_comment(self, data):
        if MARK in data:
            self.found.append(f"comment {data!r:.60}")

    handle_decl = handle_pi = unknown_decl = handle_comment

    def handle_data(self, data):
        if self.lasttag == "script" and MARK in data and self.get_starttag_text() == "<script>":
            self.found.append(f"script {data!r:.60}")


def _tex(text):
    preamble, _, body = text.partition(r"\begin{document}")
    found = TEX_COMMAND.search(body or preamble)
    twice = text.count(r"\end{document}") > 1 or "^^" in body
    return f"command {found[0]}" if found else "the end of the document" if twice else ""


def _c(text):
    code = C_TEXT.sub(" ", text.replace("\\\n", ""))
    lines = [x for x in re.findall("#include.*", code) if "/etc" in x]
    return f"code {code[code.index(MARK) - 60 :][:120]!r}" if MARK in code else "".join(lines)


def _python(text):
    for node in ast.walk(ast.parse(text)):
        named = [getattr(node, x, "") for x in ("id", "attr", "name", "arg", "module")]
        if MARK in map(str, named) or (isinstance(node, ast.Import) and MARK in ast.unparse(node)):
            return f"code {ast.unparse(node)[:100]!r}"
    return ""


def _json(text):
    json.loads(text, parse_constant=lambda x: 1 / 0)
    return ""


def _xml(text):
    """A name of the problem is data: neither an element nor an attribute's name."""
    for element in ElementTree.fromstring(text).iter():
        if MARK in "".join((element.tag, *element.attrib)):
            return f"element {element.tag!r:.60}"
    return ""


def _text(text):
    odd = {c for c in text if not c.isprintable() and c not in "\n\u00a0\u202f"}
    return f"letters {sorted(odd)!r}" if odd else ""


VIEWS = {
    "html": _html, "tex": _tex, "c": _c, "h": _c, "hpp": _c, "rs": _c, "mjs": _c, "py": _python,
    "json": _json, "xml": _xml, "txt": _text,
}  # fmt: skip
