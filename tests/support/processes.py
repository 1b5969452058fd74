"""Processes beside the tests: LaTeX, typeset; those whose coverage is not measured."""

import os
import subprocess

from tests.support.needs import need


def typeset(source, folder, runs=1):
    """The log of pdflatex in one line, after as many runs as references need: three, for all."""
    need("pdflatex")
    (folder / "typeset.tex").write_text(source, encoding="utf-8")
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "typeset.tex"]
    for _ in range(runs):
        done = subprocess.run(command, cwd=folder, capture_output=True, timeout=300, check=False)
        assert done.returncode == 0, done.stdout.decode(errors="replace")[-2000:]
    return (folder / "typeset.log").read_text(errors="replace").replace("\n", " ")


def environment(**more):
    """The variables of this process, but for those by which a new one measures its coverage: of
    one whose time, memory or files are limited."""
    return {k: x for k, x in os.environ.items() if not k.startswith("COV")} | more
