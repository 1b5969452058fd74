"""Files are written whole or not at all: under a temporary name, then renamed."""

from __future__ import annotations

import errno
import os
import tempfile
from collections.abc import Mapping
from pathlib import Path


class WriteError(OSError):
    """Output that cannot be written: the message says where and why."""


def write(files: Mapping[str, str], out: Path) -> list[Path]:
    """Write each file under a temporary name, then rename; ``WriteError`` when that fails."""
    place = out
    try:
        out.mkdir(parents=True, exist_ok=True)
        written = []
        for name, text in files.items():
            place = out / name
            written.append(write_file(place, text))
        return written
    except OSError as error:
        raise WriteError(f"{place}: {error.strerror}; choose another --out") from None


def stale(files: Mapping[str, str], out: Path) -> list[Path]:
    """The files of a folder that are missing or are not these; ``OSError`` for unreadable ones."""
    found = []
    for name, text in files.items():
        path = out / name
        if not path.is_file() or path.read_bytes() != text.encode("utf-8"):
            found.append(path)
    return found


def write_file(path: Path, text: str) -> Path:
    """One file, whole or not at all; a link is followed, a device or a pipe is written to."""
    path = path.resolve() if path.is_symlink() else path
    if path.exists() and not path.is_file() and not path.is_dir():
        path.write_text(text, encoding="utf-8")
        return path
    if path.is_dir():
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
    handle, temporary = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    try:
        with os.fdopen(handle, "w", encoding="utf-8", newline="\n") as stream:
            stream.write(text)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise
    return path
