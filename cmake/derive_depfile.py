"""What the emitted code of a problem is made from: a depfile for ninja, or a stamp for make.

    python derive_depfile.py FILE.d OUTPUT PROBLEM
    python derive_depfile.py --stamp FILE PROBLEM       # written when any of it has changed

These are the files of derive, and for a problem file of one's own that file and its meshes.
"""

import hashlib
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import derive
from derive.code.languages import LANGUAGES
from derive.language.templating import folder


def sources(problem: str) -> Iterator[Path]:
    """The files that the emitted code of a problem is made from."""
    package = Path(derive.__file__).parent
    yield from package.rglob("*.py")
    for name in LANGUAGES:
        yield from folder(name).iterdir()
    # named by the version: gone after an upgrade, whatever the times of the new files are
    yield from package.parent.glob("derive_mechanics-*.dist-info/METADATA")
    if not problem.endswith(".toml"):
        yield package / "problems" / f"{problem}.toml"
        return
    path = Path(problem)
    yield path
    try:
        data = tomllib.loads(path.read_text(encoding="utf-8"))
    except ValueError:
        return  # derive says what is wrong with it
    for name in meshes(data):
        yield path.parent / name


def meshes(data: Any) -> Iterator[str]:
    """Every ``file = "…"`` of a problem file."""
    values = data.items() if isinstance(data, dict) else enumerate(data)
    for key, value in values:
        if isinstance(value, dict | list):
            yield from meshes(value)
        elif key == "file":
            yield str(value)


def escaped(path: Path | str) -> str:
    """A path as depfiles write it."""
    text = Path(path).absolute().as_posix()
    return text.replace("$", "$$").replace("#", "\\#").replace(" ", "\\ ")


def write_depfile(depfile: str, output: str, problem: str) -> None:
    """Write the depfile of an output."""
    lines = " \\\n  ".join(sorted(map(escaped, sources(problem))))
    Path(depfile).write_text(f"{escaped(output)}: \\\n  {lines}\n", encoding="utf-8")


def write_stamp(stamp: str, problem: str) -> None:
    """Write a hash of the names and the times of the files, unless it is there already."""
    files = sorted(path for path in sources(problem) if path.is_file())
    text = "\n".join(f"{path} {path.stat().st_mtime_ns}" for path in files)
    digest, path = hashlib.sha256(text.encode()).hexdigest(), Path(stamp)
    if not path.is_file() or path.read_text(encoding="utf-8") != digest:
        path.write_text(digest, encoding="utf-8")


if __name__ == "__main__":
    if sys.argv[1] == "--stamp":
        write_stamp(*sys.argv[2:])
    else:
        write_depfile(*sys.argv[1:])
