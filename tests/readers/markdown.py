"""Markdown read: formulas between dollars under the headings of their steps.

The formulas themselves are LaTeX in standard commands, which the reader of LaTeX knows.
"""

import re

from tests.readers.latex import equations

STEP = re.compile(r"^### .* — `([^`]*)`$", re.M)
BLOCK = re.compile(r"^\$\$\n\\begin\{aligned\}\n(.*?)\n\\end\{aligned\}\n\$\$$", re.M | re.S)


def page(text, known, labels):
    """The equations of every step, by its label."""
    _, *parts = STEP.split(text)
    steps = dict(zip(parts[::2], parts[1::2], strict=True))
    return {
        label: [e for block in BLOCK.findall(body) for e in equations(block, known)]
        for label, body in steps.items()
        if label in labels
    }
