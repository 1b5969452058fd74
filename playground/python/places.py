"""At which line of a problem file is what a message tells?"""

from __future__ import annotations

import re

LINE = re.compile(r"\(at line (\d+)")
TABLE = re.compile(r"(?:derive: )?\S+\.toml: (?:in )?\[*(\w+)\]* (\d+|'[^']*')")
SECTION = re.compile(r"(?:derive: )?\S+\.toml: (\w+), ")
LONG = 40
"""Of a longer name messages show so many letters."""
KEYS = (
    re.compile(r"(?:unknown )?key '([^']{1,80})'"),
    re.compile(r"(?:\d+|'[^']*'), (\w+):"),
    re.compile(r"\.toml: \w+, (\w+)\b"),
    re.compile(r"\.toml: \[?(\w+)\]?[,:]"),
)


def line_of(message: str, text: str) -> int:
    """The line, from 1; 1 where the message is of the whole file."""
    if found := LINE.search(message):
        return int(found[1])
    lines = text.splitlines()
    first, last = span(message, lines)
    for pattern in KEYS:
        if found := pattern.search(message):
            key = named(found[1])
            alone = rf"\s*(?:[\"']?{key}[\"']?\s*=|\[+[\w.]*\b{key}\]+)"
            wanted = re.compile(rf"{alone}|.*[{{,]\s*{key}\s*=")
            for k in range(first, last):
                if wanted.match(lines[k]):
                    return k + 1
    return min(first, max(len(lines) - 1, 0)) + 1


def span(message: str, lines: list[str]) -> tuple[int, int]:
    """The lines, from 0, of the table that a message names; all where it names none."""
    found = TABLE.search(message)
    if not found:
        return alone(message, lines)
    word, which = found.groups()
    if which.isdecimal():
        header = re.compile(rf"\s*\[\[\s*(?:\w+\.)?{re.escape(word)}s?\s*\]\]")
        at = [k for k, line in enumerate(lines) if header.match(line)]
        number = int(which) - 1
        if not 0 <= number < len(at):
            return 0, len(lines)
        return at[number], end(at[number], lines)
    name = named(which.strip("'"))
    entry = re.compile(rf"\s*[\"']?{name}[\"']?\s*=|\s*\[\w+\.{name}\]")
    start = next((k for k, line in enumerate(lines) if entry.match(line)), 0)
    return start, len(lines)


def alone(message: str, lines: list[str]) -> tuple[int, int]:
    """The same of a table that stands once; all where there is none."""
    found = SECTION.search(message)
    header = re.compile(rf"\s*\[\s*{re.escape(found[1])}\s*\]" if found else "$^")
    start = next((k for k, line in enumerate(lines) if header.match(line)), None)
    return (0, len(lines)) if start is None else (start, end(start, lines))


def end(start: int, lines: list[str]) -> int:
    """Where a table ends that begins at a line."""
    ends = (k for k in range(start + 1, len(lines)) if lines[k].lstrip().startswith("["))
    return next(ends, len(lines))


def named(name: str) -> str:
    """What matches a name of which a message shows the beginning."""
    return re.escape(name) + (r"\w*" if len(name) == LONG else "")
