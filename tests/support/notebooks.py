"""The example notebooks: python -m tests.support.notebooks runs examples/top.ipynb and keeps in it
what its cells show, and makes of it the one of marimo, examples/top_marimo.py."""

import subprocess
import sys
from pathlib import Path

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
JUPYTER, MARIMO = EXAMPLES / "top.ipynb", EXAMPLES / "top_marimo.py"


def executed():
    """The notebook with what its cells show now."""
    import nbclient
    import nbformat

    notebook = nbformat.read(JUPYTER, as_version=4)
    nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
    for cell in notebook.cells:
        cell.metadata.pop("execution", None)
    notebook.metadata["language_info"] = {"name": "python"}
    return notebook


def converted(folder):
    """The text of the notebook for marimo."""
    out = Path(folder) / MARIMO.name
    words = ["-m", "marimo", "--yes", "convert", str(JUPYTER), "--output", str(out)]
    subprocess.run([sys.executable, *words], check=True, capture_output=True)
    return out.read_text(encoding="utf-8")


def cells_of(text):
    """Of a notebook of marimo all but the version that made it."""
    return [x for x in text.splitlines() if not x.startswith("__generated_with")]


if __name__ == "__main__":
    import tempfile

    import nbformat

    nbformat.write(executed(), JUPYTER)
    with tempfile.TemporaryDirectory() as folder:
        MARIMO.write_text(converted(folder), encoding="utf-8")
