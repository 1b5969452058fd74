"""LaTeX, typeset."""

import subprocess

from tests.support.needs import need


def compiled(source, folder, runs=1):
    """The log of pdflatex in one line, after as many runs as references need: three, for all."""
    need("pdflatex")
    (folder / "typeset.tex").write_text(source, encoding="utf-8")
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "typeset.tex"]
    for _ in range(runs):
        done = subprocess.run(command, cwd=folder, capture_output=True, timeout=300, check=False)
        assert done.returncode == 0, done.stdout.decode(errors="replace")[-2000:]
    return (folder / "typeset.log").read_text(errors="replace").replace("\n", " ")
