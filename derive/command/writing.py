"""Files whole or not at all, standard output, the bounds of a command and its progress; and what a
person at a terminal sees: weight and colour of a text, a pager, that work goes on.
"""

from __future__ import annotations

import codecs
import errno
import io
import os
import re
import shutil
import signal
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from itertools import zip_longest
from pathlib import Path
from typing import IO, TypeVar

from ..language.limits import MESSAGE, Refused

# Writing files whole or not at all: under a temporary name, then renamed.
#
# A folder is locked while it is written to, so that the files of two emissions are not mixed;
# what an emission that was killed left over is removed by the next one.

try:
    import fcntl
except ImportError:  # Windows: no lock
    fcntl = None  # type: ignore[assignment]

STDOUT = "-"
"""The name of standard output among files, as programs of Unix have it; a file is ``./-``."""

PREFIX, SUFFIX = ".derive-", ".part"
"""The first and the last letters of the names of temporary files."""

PATIENCE = 60.0
"""Seconds to wait for a locked folder; others lock it for as long as it takes to write a few
files."""


class WriteError(Refused, OSError):
    """Output that cannot be written: the message says where and why."""


def write(files: Mapping[str, str | bytes], out: Path, *, links: bool = False) -> list[Path]:
    """Write every file, name → content, under a temporary name, then rename them all; their paths.

    ``links``: may a file be a link that leads out of the folder, because the user named that file?
    A device or a pipe is written to at once. ``WriteError`` when that fails: then no file has been
    touched, unless a rename fails.
    """
    place = out
    ready: list[tuple[Path, Path]] = []
    try:
        out.mkdir(parents=True, exist_ok=True)
        paths, whole = [], {}
        for name, content in files.items():
            place = out / name
            if not links and not inside(place, out):
                raise WriteError(f"{place}: a link that leads out of the folder; remove it")
            data = content.encode("utf-8") if isinstance(content, str) else content
            paths.append(_target(place))
            if paths[-1].exists() and not paths[-1].is_file():
                if not links:
                    raise WriteError(f"{place}: a pipe or a device; remove it")
                paths[-1].write_bytes(data)  # before the lock: a pipe may wait for its reader
            else:
                whole[paths[-1]] = data
        place = out
        with _locked({path.parent.resolve() for path in whole}):
            for place, data in whole.items():
                ready.append((place, _temporary(place.parent)))
                ready[-1][1].write_bytes(data)
                os.chmod(ready[-1][1], 0o644)
            for place, temporary in ready:
                os.replace(temporary, place)
        return paths
    except WriteError:
        raise
    except OSError as error:
        raise WriteError(f"{place}: {error.strerror}; choose another --out") from None
    finally:
        for _, temporary in ready:
            temporary.unlink(missing_ok=True)


def require_place(path: Path) -> None:
    """``WriteError`` where no file of a name can be written, nor a folder made for it; nothing is
    left there."""
    try:
        target = _target(path)
        if not target.exists() or target.is_file():
            folder = next(x for x in target.absolute().parents if os.path.lexists(x))
            _temporary(folder).unlink()
    except OSError as error:
        raise WriteError(f"{path}: {error.strerror}; choose another --out") from None


@contextmanager
def growing(path: Path) -> Iterator[IO[bytes]]:
    """A file that is written part by part under a temporary name, and then renamed; ``WriteError``
    when that fails: then it has not been touched."""
    temporary = None
    try:
        target = _target(path)
        if target.exists() and not target.is_file():
            raise WriteError(f"{path}: a pipe or a device; name a file")
        target.parent.mkdir(parents=True, exist_ok=True)
        temporary = _temporary(target.parent, ".grows")
        with temporary.open("w+b") as file:
            yield file
        os.chmod(temporary, 0o644)
        os.replace(temporary, target)
    except WriteError:
        raise
    except OSError as error:
        raise WriteError(f"{path}: {error.strerror}; choose another --out") from None
    finally:
        if temporary:
            temporary.unlink(missing_ok=True)


def inside(path: Path, folder: Path) -> bool:
    """Is a path in a folder, wherever links lead?"""
    try:
        return path.resolve().is_relative_to(folder.resolve())
    except RuntimeError:  # a link to itself
        return False


REMEDY = "run the same command without --check"


def stale(
    files: Mapping[str, str | bytes],
    out: Path,
    foreign: Iterable[str] = (),
    remedy: str = REMEDY,
) -> dict[Path, str]:
    """The files of a folder that are not these, and how; ``OSError`` for unreadable ones.

    ``foreign``: names of files that must not be beside them; ``remedy``: what makes them.
    """
    found = {}
    for name, content in files.items():
        path = out / name
        wanted = content.encode("utf-8") if isinstance(content, str) else content
        if not path.is_file():
            found[path] = f"missing; {remedy}"
        elif isinstance(content, bytes):
            if path.read_bytes() != wanted:
                found[path] = f"not current; {remedy}"
        elif (old := path.read_bytes()) != wanted:
            lines = zip_longest(old.split(b"\n"), wanted.split(b"\n"))
            first = next(k for k, (a, b) in enumerate(lines, 1) if a != b)
            found[path] = f"not current from line {first} on; {remedy}"
    for path in (out / x for x in foreign):
        if path.exists():
            found[path] = "would be read in place of the compiler's own; remove it"
    return found


def text_on_disk(path: Path) -> str:
    """The text of a file, whatever its line ends and wrong bytes; empty where there is none."""
    if not path.is_file():
        return ""
    return path.read_bytes().decode("utf-8", "replace").replace("\r\n", "\n")


def _target(path: Path) -> Path:
    """The path to which a file is written, links followed; ``IsADirectoryError`` for a folder."""
    path = path.resolve() if path.is_symlink() else path
    if path.is_dir():
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
    return path


def _temporary(folder: Path, suffix: str = SUFFIX) -> Path:
    """The path of a new, empty file with a name of its own."""
    handle, name = tempfile.mkstemp(suffix, PREFIX, folder)
    os.close(handle)
    return Path(name)


@contextmanager
def _locked(folders: Iterable[Path]) -> Iterator[None]:
    """A context in which this process alone holds some folders, locked in one order by all
    processes and cleared of temporary files left over.

    The lock is on the folder itself: no file remains, and the system frees it when a process ends.
    """
    with ExitStack() as stack:
        for folder in sorted(folders):
            if fcntl is not None and _lock(folder, stack):
                for left in folder.glob(f"{PREFIX}*{SUFFIX}"):
                    with suppress(OSError):
                        left.unlink()
        yield


def _lock(folder: Path, stack: ExitStack) -> bool:
    """Lock a folder until ``stack`` is closed, if it has locks; ``OSError`` after PATIENCE."""
    try:
        handle = os.open(folder, os.O_RDONLY)
    except OSError:  # writing will tell
        return False
    stack.callback(os.close, handle)
    end = time.monotonic() + PATIENCE
    while True:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            return True
        except BlockingIOError:
            if time.monotonic() > end:
                reason = "another process writes to it and does not end"
                raise OSError(errno.EAGAIN, reason, str(folder)) from None
            time.sleep(0.01)
        except OSError:
            return False


# Standard output in an encoding that lacks letters: they become ?, and stderr says so once.

HANDLER = "derive.lost"


@contextmanager
def replacing_unencodable() -> Iterator[None]:
    """A context in which stdout writes ? for letters that it lacks; stderr says so at its end."""
    lost: set[str] = set()

    def shown(error: UnicodeError) -> tuple[str, int]:
        if not isinstance(error, UnicodeEncodeError):
            raise error
        lost.update(error.object[error.start : error.end])
        return "?" * (error.end - error.start), error.end

    out = sys.stdout
    if isinstance(out, io.TextIOWrapper):
        codecs.register_error(HANDLER, shown)
        out.reconfigure(errors=HANDLER)
    try:
        yield
    finally:
        if lost:
            count = f"{len(lost)} letter{'s' * (len(lost) != 1)}"
            print(
                f"derive: warning: the encoding of standard output, {out.encoding}, lacks {count}, "
                "shown as ?; where UTF-8 is read set PYTHONIOENCODING=utf-8; files of --out are "
                "in UTF-8",
                file=sys.stderr,
            )


def as_in_a_file() -> None:
    """Write stdout in UTF-8 from here on, as formats that name their encoding, but to a
    terminal."""
    out = sys.stdout
    if isinstance(out, io.TextIOWrapper) and not out.isatty():
        out.reconfigure(encoding="utf-8", errors=out.errors)


# The bounds of a command: a limit on its processor time, and one printable line for a message.

AGAIN = 0.1
"""After so many seconds it is raised again: Python drops what is raised while it collects garbage,
and at the end of an import."""


class StoppedError(BaseException):
    """The time is over. Not an ``Exception``, so that nothing on the way catches it."""


@contextmanager
def time_limit(seconds: float | None) -> Iterator[None]:
    """A context that raises ``StoppedError`` after so many seconds of processor time; no limit for
    ``None``.

    It is raised at once where there are no such timers, or outside the main thread.
    """
    if seconds is None:
        yield
        return
    main = threading.current_thread() is threading.main_thread()
    if not (main and hasattr(signal, "setitimer")):
        raise StoppedError("--seconds needs the timers of Unix and the main thread")

    over = StoppedError(f"stopped after {seconds:g} s of processor time (--seconds)")
    rung = False

    def stop(*_: object) -> None:
        nonlocal rung
        rung = True
        raise over

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds, AGAIN)
    try:
        yield
    except Exception as error:
        if rung:  # what is raised within a library of C may come out of it as another error
            raise over from error
        raise
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


@contextmanager
def heard() -> Iterator[Callable[[], bool]]:
    """A context in which the first Ctrl-C is noted, to be asked for, and the second one stops."""
    asked = False

    def note(*_: object) -> None:
        nonlocal asked
        if asked:
            raise KeyboardInterrupt
        asked = True

    if threading.current_thread() is not threading.main_thread():
        yield lambda: False
        return
    before = signal.signal(signal.SIGINT, note)
    try:
        yield lambda: asked
    finally:
        signal.signal(signal.SIGINT, before)


def one_line(words: object) -> str:
    """A message, which may quote a file, as one line that a terminal can only print."""
    shown = "".join(c if c.isprintable() else ascii(c)[1:-1] for c in str(words)[: 2 * MESSAGE])
    return shown if len(shown) <= MESSAGE else f"{shown[: MESSAGE - 1]}…"


# The progress of a long command: one line on stderr, where that is a terminal.

Item = TypeVar("Item")


def with_progress(items: Iterable[Item], total: int, what: str) -> Iterator[Item]:
    """The items unchanged; while each is made, stderr shows ``what: done of total``."""
    shown, left = sys.stderr is not None and sys.stderr.isatty(), iter(items)
    for done in range(total):
        line = f"{what}: {done} of {total}" if shown else ""
        try:
            if shown:
                print(line, end="\r", file=sys.stderr, flush=True)
            item = next(left)
        finally:  # also before an error is told
            if shown:
                print(" " * len(line), end="\r", file=sys.stderr, flush=True)
        yield item


PLAIN, BOLD, FAINT, BLUE = "\x1b[0m", "\x1b[1m", "\x1b[2m", "\x1b[1;34m"
LABEL = re.compile(r"(\S+)(  ·  .*)")
"""The first line of a step: its label, and its rule with notes."""


def coloured() -> bool:
    """Does standard output show weight and colour? Not where NO_COLOR is set (no-color.org)."""
    plain = os.environ.get("NO_COLOR") or os.environ.get("TERM", "dumb") == "dumb"
    return sys.stdout.isatty() and not plain


def emphasised(text: str) -> str:
    """A text of steps with headings, labels and equations in weight, rules faint."""
    from ..views.text import EQUATION

    lines, margin = text.split("\n"), " " * EQUATION
    return "\n".join(map(partial(_emphasised, margin), lines, [*lines[1:], ""]))


def _emphasised(margin: str, line: str, below: str) -> str:
    if label := LABEL.fullmatch(line):
        return f"{BLUE}{label[1]}{PLAIN}{FAINT}{label[2]}{PLAIN}"
    if line.startswith(margin) or (line and {*below} in ({"="}, {"-"})):
        return f"{BOLD}{line}{PLAIN}"
    return line


def show(text: str, *, paged: bool = True) -> None:
    """A text on standard output: at a terminal emphasised, and, ``paged``, by a pager (PAGER, else
    less) where it is longer than the screen."""
    if coloured():
        text = emphasised(text)
    if paged and sys.stdout.isatty() and text.count("\n") >= shutil.get_terminal_size().lines:
        import pydoc  # which a browser's Python has not

        os.environ.setdefault("LESS", "FRX")  # colours as they are, the text stays on the screen
        pydoc.pager(text)
    else:
        sys.stdout.write(text)


def filled(line: str, width: int) -> list[str]:
    """A line at the width of a terminal, or of COLUMNS, what is more below it, further in; else as
    it is."""
    from ..views.text import paragraph

    if not (sys.stdout.isatty() or os.environ.get("COLUMNS")):
        return [line]
    together = line.replace(" = ", "\N{NO-BREAK SPACE}=\N{NO-BREAK SPACE}")
    first, *rest = paragraph(together, 2 * line.startswith("  "), width)
    below = paragraph(" ".join(x.strip() for x in rest), 4, width) if rest else ()
    return [x.replace("\N{NO-BREAK SPACE}", " ") for x in (first, *below)]


QUIET = 1.0
"""After so many seconds it is said that work goes on."""


@contextmanager
def working(what: str) -> Iterator[None]:
    """While the body takes longer than a second, stderr says so, where that is a terminal."""
    if sys.stderr is None or not sys.stderr.isatty():
        yield
        return
    done, start = threading.Event(), time.monotonic()
    shown = ""

    def tell() -> None:
        nonlocal shown
        while not done.wait(QUIET):
            shown = f"{what}: {time.monotonic() - start:.0f} s"
            print(shown, end="\r", file=sys.stderr, flush=True)

    teller = threading.Thread(target=tell, daemon=True)
    teller.start()
    try:
        yield
    finally:
        done.set()
        teller.join()
        if shown:
            print(" " * len(shown), end="\r", file=sys.stderr, flush=True)
