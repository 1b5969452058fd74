"""The options of an emission, as every file states them and as they are read back from it."""

from __future__ import annotations

import re
import textwrap
from dataclasses import dataclass, field

from .languages import LANGUAGES
from .options import CHOICES, Options

_STATED = re.compile(r"; do not edit\.\n[\s*#/]*Options: (\w+)((?:[\s*#/]+--[a-z-]+(?: \w+)?)+)")
_OPTION = re.compile(r"--([a-z-]+)(?: (\w+))?")


@dataclass(frozen=True)
class EmissionRequest:
    """What ``derive emit`` was asked for; ``allowed``: what may be negative, as its flags say."""

    problem: str
    prefix: str
    languages: tuple[str, ...]
    options: Options = field(default_factory=Options)
    allowed: tuple[str, ...] = ()

    @property
    def words(self) -> list[str]:
        """The options as words of a command line, each with its value."""
        found = [("lang", x) for x in self.languages] + [("prefix", self.prefix)]
        found += [(name, getattr(self.options, name)) for name in CHOICES]
        found += [("jacobian", x) for x in self.options.jacobian]
        flags = ["--momenta"] * self.options.momenta
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
        one = {name: found[name][0] for name in CHOICES}
        options = Options(
            **one, jacobian=tuple(found.get("jacobian", ())), momenta="momenta" in found
        )
        prefix, languages = found["prefix"][0], tuple(found["lang"])
    except (KeyError, ValueError):
        return None
    if not {*languages} <= {*LANGUAGES}:
        return None
    return EmissionRequest(stated[1], prefix, languages, options, allowed)
