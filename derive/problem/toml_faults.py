"""What is wrong with a text that is not TOML, at which line, and what to write instead."""

from __future__ import annotations

import re

AT = re.compile(r"at line ([0-9]+), column ([0-9]+)")
CURLY = "“”„‟«»‘’‚"
SPACES = "\u00a0\u1680\u2007\u202f\u3000\u200b\ufeff"
"""No-break and other spaces that TOML does not know."""
WORD = re.compile(r"[\w.*/^+()-]+")
DECIMAL = re.compile(r"=\s*([-+]?[0-9]+),([0-9]+)\s*$")
TEXT = re.compile(r""" "[^"]*" | '[^']*' | \#.* """, re.VERBOSE)
ENDS = {
    "Unclosed array": "a list ends with ], and its entries are parted by commas",
    "Unclosed inline": "{ … } ends with }, on the line where it begins",
    **dict.fromkeys(
        ("Unterminated", 'Expected "\'"', "Illegal character '\\n'"),
        "a text ends with the quote that it begins with",
    ),
}
"""The beginning of a message → what is missing."""
TWICE = ("Cannot overwrite", "Cannot declare", "Cannot mutate")


def unread(raw: bytes, error: ValueError) -> str:
    """The message of Python's reader, always with a line, and the remedy where it is known."""
    if isinstance(error, UnicodeDecodeError):
        line = raw[: error.start].count(b"\n") + 1
        return f"line {line} has a byte that is not UTF-8; save the file as UTF-8"
    lines = raw.decode("utf-8-sig", "replace").split("\n")
    last = max((k for k, x in enumerate(lines, 1) if x.strip()), default=1)
    end = f"at line {last}, column {len(lines[last - 1]) + 1}, the end"
    said = str(error).replace("at end of document", end)
    if said.startswith(TWICE):
        said += "; a key or a table stands twice, where a list of tables is written [[…]]"
    at = AT.search(said)
    if at is None:
        return said
    shown = lines[int(at[1]) - 1].rstrip("\r")
    told = remedy(said, shown, int(at[2]) - 1)
    return f"{said}; {told}" if told else said


def remedy(said: str, line: str, column: int) -> str:
    """What to write instead, from what stands about a column, from 0, of a line; "" if unknown."""
    before, here, key = line[:column], line[column : column + 1], line.partition("=")[0]
    if quote := next((x for x in TEXT.sub("", line) if x in CURLY), ""):
        return f'{quote} is a curly quote: text stands in straight ones, "…"'
    if here and here in SPACES:
        return f"a no-break space (U+{ord(here):04X}) stands here: write a plain one"
    if here == "−":
        return "− is not the minus sign of a number: write -"
    if not key.isascii():
        return "names have the letters A to Z, a to z, digits and _ only"
    if found := _decimal(line, column):
        return f"a decimal point, not a comma: {found}"
    if said.startswith("Invalid statement") and line.lstrip().startswith((";", "//")):
        return "a comment begins with #"
    if said.startswith("Expected '=' after a key") and here == ":":
        return "a key and its value are parted by =, not by :"
    if said.startswith("Expected ']"):
        return "a table is written [name], one of a list of tables [[name]]"
    bare = said.startswith(("Invalid value", "Expected newline", "Unclosed")) and "=" in before
    told = _unquoted(line, column) if bare else ""
    return told or next((x for begin, x in ENDS.items() if said.startswith(begin)), "")


def _decimal(line: str, column: int) -> str:
    """The number with a point, where one with a comma ends or has its comma at the column."""
    comma = re.match(r",[0-9]+", line[column:])
    found = DECIMAL.search(line[: column + comma.end()] if comma else line[:column])
    return f"{found[1]}.{found[2]}" if found else ""


def _unquoted(line: str, column: int) -> str:
    """That a text or an expression has no quotes, or a number no digit on one side of its point."""
    word = next((x for x in WORD.finditer(line) if x.start() <= column < x.end()), None)
    if word is None:
        nothing = not line[column:].split("#")[0].strip() and line[:column].rstrip().endswith("=")
        return "a value is missing" if nothing else ""
    told = word[0]
    if re.fullmatch(r"[-+]?(\.[0-9]+|[0-9]+\.)", told):
        return "a digit stands on both sides of the point: " + re.sub(
            r"^([-+]?)\.", r"\g<1>0.", told if told[-1] != "." else f"{told}0"
        )
    if re.search(r"[A-Za-z*/^+(]", told) and told[-1] != "(":
        return f'a text or an expression stands in quotes: "{told[:40]}"'
    return ""
