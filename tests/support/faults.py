"""Faults by hand, which a quick run of the tests must all see: ``faults.toml`` beside this file.

python -m tests.support.faults [WORD ...] makes those whose names have one of the words, or all, in
a copy of the working tree, one at a time, runs the tests that are named, each as ``make test`` has
it, and prints which sees it first; exit 1 when one is not seen.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[2]
FILES = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
FAULTS = [{"file": file, "name": x, **y} for file, own in FILES.items() for x, y in own.items()]
"""``name``, ``file``, what is ``old`` and stands there once, what is ``new``, and the ``tests``."""


def copied(folder):
    """What git knows of the working tree, or would, in a folder."""
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard", "-z"]
    listed = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout
    for name in filter(None, listed.split("\0")):
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)


def changed(fault):
    """The text of the file with the fault."""
    text = (ROOT / fault["file"]).read_text(encoding="utf-8")
    if text.count(fault["old"]) != 1:
        raise ValueError(f"{fault['name']}: what is old stands {text.count(fault['old'])} times")
    return text.replace(fault["old"], fault["new"])


def failed(tests, folder):
    """The first test that fails of some in a copy of the tree; "" where all pass."""
    command = [sys.executable, "-m", "pytest", "-x", "--quick", "-p", "no:cacheprovider"]
    done = subprocess.run(
        [*command, f"tests/{tests}"],
        **{"cwd": folder, "capture_output": True, "text": True},
        env=os.environ | {"PYTHONPATH": str(folder), "PYTHONDONTWRITEBYTECODE": "1"},
    )
    if done.returncode == 0:
        return ""
    if (found := re.search(r"^(?:FAILED|ERROR) (.+?)(?: - |$)", done.stdout, re.M)) is None:
        raise RuntimeError(done.stdout + done.stderr)
    return found[1]


def seen_by(fault, folder):
    """The first test that fails with a fault in a copy of the tree; "" where all pass."""
    place = folder / fault["file"]
    whole = place.read_bytes()
    place.write_text(changed(fault), encoding="utf-8")
    try:
        return next(filter(None, (failed(x, folder) for x in fault["tests"])), "")
    finally:
        place.write_bytes(whole)


def main(words=()):
    """A line for each fault; is every one of them seen?"""
    chosen = [x for x in FAULTS if not words or any(w in x["name"] for w in words)]
    wide, fine = max(len(x["name"]) for x in chosen), True
    with tempfile.TemporaryDirectory() as folder:
        copied(Path(folder))
        for fault in chosen:
            by = seen_by(fault, Path(folder))
            print(f"{fault['name']:{wide}}  {by or 'NOT SEEN'}", flush=True)
            fine = fine and bool(by)
    return fine


if __name__ == "__main__":
    sys.exit(not main(sys.argv[1:]))
