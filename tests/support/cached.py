"""What the engine makes, once for each state of its sources: kept on the disk."""

import os
import pickle
import shutil
from collections.abc import Callable
from functools import cache, wraps
from hashlib import sha256
from pathlib import Path

ROOT = Path(__file__).parents[2]
PLACE = ROOT / "build" / "tests"
READ = ("derive", "templates", "tests/problems", "tests/support")
"""What the results depend on: programs, templates, problems."""


@cache
def folder() -> Path:
    """The folder of results of these sources; those of others are removed."""
    digest = sha256()
    files = (x for top in READ for x in (ROOT / top).rglob("*") if x.suffix != ".pyc")
    for path in sorted(x for x in files if x.is_file()):
        digest.update(f"{path.relative_to(ROOT)}\0".encode() + path.read_bytes())
    found = PLACE / digest.hexdigest()[:32]
    found.mkdir(parents=True, exist_ok=True)
    for other in {*PLACE.iterdir()} - {found}:
        shutil.rmtree(other, ignore_errors=True)
    return found


def place(*names: str) -> Path:
    """The file of what has these names."""
    return folder() / sha256(repr(names).encode()).hexdigest()[:32]


def write(path: Path, made: object) -> None:
    """Into a file that other processes see whole or not at all."""
    unfinished = path.with_suffix(f".{os.getpid()}")
    unfinished.write_bytes(pickle.dumps(made))
    unfinished.replace(path)


def read(path: Path) -> object:
    """What was written."""
    return pickle.loads(path.read_bytes())


def on_disk(make: Callable) -> Callable:
    """A function of names whose results are plain data: those of its file, of these sources."""
    own = sha256(Path(make.__code__.co_filename).read_bytes()).hexdigest()

    @cache
    @wraps(make)
    def found(*names: str):
        path = place(own, make.__qualname__, *names)
        if not path.is_file():
            write(path, make(*names))
        return read(path)

    return found


class DictOnDisk(dict):
    """A dictionary from texts to plain data that all processes of these sources have in common."""

    def get(self, key, default=None):
        if key not in self and (path := place("entry", key)).is_file():
            super().__setitem__(key, read(path))
        return super().get(key, default)

    def __setitem__(self, key, value):
        super().__setitem__(key, value)
        write(place("entry", key), value)
