"""Files are written whole or not at all: under a temporary name, then renamed."""

from __future__ import annotations

import errno
import os
import tempfile
from collections.abc import Mapping
from pathlib import Path


class WriteError(OSError):
    """Output that cannot be written: the message says where and why."""


def write(files: Mapping[str, str | bytes], out: Path, *, links: bool = False) -> list[Path]:
    """Write every file under a temporary name, then rename them all.

    ``links``: may a file be a link that leads out of the folder, because the user named that file?
    ``WriteError`` when that fails: then no file has been touched, unless a rename fails.
    """
    place, ready = out, []
    try:
        out.mkdir(parents=True, exist_ok=True)
        for name, content in files.items():
            place = out / name
            if not links and not inside(place, out):
                raise WriteError(f"{place}: a link that leads out of the folder; remove it")
            ready.append(prepared(place, content))
        for place, temporary in ready:
            if temporary is not None:
                os.replace(temporary, place)
        return [path for path, _ in ready]
    except WriteError:
        raise
    except OSError as error:
        raise WriteError(f"{place}: {error.strerror}; choose another --out") from None
    finally:
        for _, temporary in ready:
            if temporary is not None:
                temporary.unlink(missing_ok=True)


def inside(path: Path, folder: Path) -> bool:
    """Is a file in the folder, wherever links lead?"""
    try:
        return path.resolve().is_relative_to(folder.resolve())
    except RuntimeError:  # a link to itself
        return False


def stale(files: Mapping[str, str], out: Path) -> list[Path]:
    """The files of a folder that are missing or are not these; ``OSError`` for unreadable ones."""
    found = []
    for name, text in files.items():
        path = out / name
        if not path.is_file() or path.read_bytes() != text.encode("utf-8"):
            found.append(path)
    return found


def prepared(path: Path, content: str | bytes) -> tuple[Path, Path | None]:
    """Where a file goes and the temporary one that holds it; none for a device or a pipe.

    A link is followed, to where it may lead; a device or a pipe is written to at once.
    """
    data = content.encode("utf-8") if isinstance(content, str) else content
    path = path.resolve() if path.is_symlink() else path
    if path.exists() and not path.is_file() and not path.is_dir():
        path.write_bytes(data)
        return path, None
    if path.is_dir():
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
    handle, name = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    temporary = Path(name)
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(data)
        os.chmod(temporary, 0o644)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
    return path, temporary
