"""The kinds of potentials: the problems of their pages."""

import re
import tomllib
from functools import cache
from pathlib import Path

from derive.problem.toml import problem_of

PAGES = Path(__file__).parents[2] / "docs" / "potentials"
BLOCK = re.compile(r"^```toml\n(.*?)^```$", re.M | re.S)


def pages():
    """The problem files in the pages, by kind and number."""
    return {
        f"{page.stem} {k}": text
        for page in sorted(PAGES.glob("*.md"))
        for k, text in enumerate(BLOCK.findall(page.read_text(encoding="utf-8")), 1)
    }


@cache
def examples():
    """Their problems."""
    return {name: problem_of(tomllib.loads(text)) for name, text in pages().items()}
