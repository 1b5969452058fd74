"""The options of an emission, as every file states them and as they are read back from it."""

from __future__ import annotations

import re
import textwrap
from dataclasses import dataclass, field
from typing import Any

from .languages import LANGUAGES
from .options import ADDED, CHOICES, DEPENDENT, REPEATED, Options

_STATED = re.compile(r"; do not edit\.\n[\s*#/]*Options: (\w+)((?:[\s*#/]+--[a-z-]+(?: \w+)?)+)")
_OPTION = re.compile(r"--([a-z-]+)(?: (\w+))?")


@dataclass(frozen=True)
class EmissionRequest:
    """What ``derive emit`` was asked for; ``allowed``: what may be negative, as its flags say;
    ``short``: for a page, where rates are not written a second time for the stages of a step."""

    problem: str
    prefix: str
    languages: tuple[str, ...]
    options: Options = field(default_factory=Options)
    allowed: tuple[str, ...] = ()
    short: bool = False

    @property
    def words(self) -> list[str]:
        """The options as words of a command line, each with its value."""
        found = [("lang", x) for x in self.languages] + [("prefix", self.prefix)]
        found += [(name, getattr(self.options, name)) for name in CHOICES]
        found += [(name, x) for name in REPEATED for x in getattr(self.options, name)]
        found += [(name, x) for name in DEPENDENT if (x := getattr(self.options, name))]
        flags = [f"--{x}" for x in ADDED if getattr(self.options, x)]
        flags += [f"--allow-negative-{x}" for x in self.allowed]
        return [f"--{name} {x}" for name, x in found] + flags

    @property
    def stated(self) -> list[str]:
        """Lines of a comment: the name of the problem and every option, given or by default."""
        words = (word.replace(" ", "\0") for word in self.words)
        text = " ".join(["Options:\0" + self.problem, *words])
        lines = textwrap.wrap(text, 92, subsequent_indent="  ", break_on_hyphens=False)
        return [line.replace("\0", " ") for line in lines]


def request_of(text: str) -> EmissionRequest | None:
    """What the head of a file says of its emission; ``None`` where it says nothing of the kind."""
    stated = _STATED.search(text)
    if stated is None:
        return None
    found: dict[str, list[str]] = {}
    for name, value in _OPTION.findall(stated[2]):
        found.setdefault(name, []).append(value)
    allowed = tuple(x for x in ("mass", "stiffness") if f"allow-negative-{x}" in found)
    try:
        one: dict[str, Any] = {name: found[name][0] for name in CHOICES}
        one |= {name: name in found for name in ADDED}
        one |= {name: tuple(found.get(name, ())) for name in REPEATED}
        one |= {name: found.get(name, [""])[0] for name in DEPENDENT}
        options = Options(**one)
        prefix, languages = found["prefix"][0], tuple(found["lang"])
    except (KeyError, ValueError):
        return None
    if not {*languages} <= {*LANGUAGES}:
        return None
    return EmissionRequest(stated[1], prefix, languages, options, allowed)
