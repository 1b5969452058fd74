"""A command in this process, watched: what it opens, starts and compiles, how long it takes.

Python tells an audit hook of every file that is opened, every process that is started and all
source that is compiled.
"""

import contextlib
import io
import os
import resource
import signal
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

from derive.command.cli import main
from derive.language.limits import MESSAGE

SECONDS, MEMORY = 2.0, 1 << 30
HANG = 60
"""Seconds after which a case is stopped."""
ROOT = Path(__file__).parents[2]
WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND
STARTS = ("subprocess.", "os.system", "os.exec", "os.posix_spawn", "os.fork", "os.spawn", "pty.")
STARTS += ("socket.connect", "socket.bind", "ctypes.dlopen", "webbrowser.", "urllib.", "ftplib.")
TOUCHES = ("os.mkdir", "os.remove", "os.rename", "os.rmdir", "os.symlink", "os.link", "os.chmod")
TOUCHES += ("os.truncate", "os.chown", "os.mknod", "os.mkfifo", "shutil.")
KNOWN = tuple(str(Path(x).resolve()) + os.sep for x in (ROOT / "derive", ROOT / "templates"))
KNOWN += tuple({os.path.realpath(x) + os.sep for x in (sys.prefix, sys.base_prefix)})
KNOWN += ("/usr/lib/", "/usr/share/zoneinfo", "/proc/", "/sys/", "/dev/urandom", "/etc/localtime")


class HangError(BaseException):
    """A case that does not end."""


@dataclass
class Watch:
    """Where files may be written, ``out``, and read, ``folder``; what was done elsewhere."""

    folder: str = ""
    out: str = ""
    on: bool = False
    faults: list[str] = field(default_factory=list)

    def hook(self, event, args):
        """Python calls this before the event; what must not be is stopped."""
        if not self.on:
            return
        wrong = ""
        if event == "open":
            wrong = self.opened(args[0], args[2] or 0)
        elif event.startswith(STARTS):
            wrong = f"{event} {args!r:.200}"
        elif event.startswith(TOUCHES):
            wrong = "" if self.within(args[0], self.out) else f"{event} {args!r:.200}"
        elif event == "compile":
            source, name = args
            wrong = (
                "" if source is None or self.known(name) else f"compiled {name!r}: {source!r:.200}"
            )
        if wrong:
            self.faults.append(wrong)
            raise PermissionError(1, f"watched: {wrong}")

    def opened(self, path, flags):
        """What is wrong with opening a file."""
        if isinstance(path, int):
            return ""
        if flags & WRITING:
            return "" if self.within(path, self.out) else f"wrote to {path!r}"
        fine = self.within(path, self.folder) or self.known(path)
        return "" if fine else f"read {path!r}"

    def within(self, path, folder):
        """Is a path in a folder, wherever links lead?"""
        real = os.path.realpath(os.fsdecode(path))
        return real == folder or real.startswith(folder + os.sep)

    def known(self, path):
        """Is it a part of Python, of this program or of its templates?"""
        return os.path.realpath(os.fsdecode(path)).startswith(KNOWN)


WATCH = Watch()
HOOKED = []


@contextlib.contextmanager
def watched(folder, out):
    """What is done inside; the faults are in the list that this gives."""
    if not HOOKED:
        HOOKED.append(True)
        sys.addaudithook(WATCH.hook)
    WATCH.folder, WATCH.out = (os.path.realpath(x) for x in (folder, out))
    WATCH.faults, WATCH.on = [], True
    try:
        yield WATCH.faults
    finally:
        WATCH.on = False


@dataclass
class Result:
    """The end of a command."""

    status: object
    out: str
    err: str
    seconds: float
    faults: list[str]


def run(arguments, folder, out, watch=True):
    """A command line, in the folder of the case; an exception is its status, in words.

    Untraced where it may be stopped: that could be where coverage holds its own lock, for ever.
    """

    def hang(*_):
        raise HangError

    stdout, stderr, status = io.StringIO(), io.StringIO(), None
    before, here = signal.signal(signal.SIGALRM, hang), os.getcwd()
    os.chdir(folder)
    tracer = sys.gettrace()
    sys.settrace(None if "--seconds" in arguments else tracer)
    start = time.process_time()
    with watched(folder, out) if watch else contextlib.nullcontext([]) as faults:
        try:
            signal.setitimer(signal.ITIMER_REAL, HANG, 5)
            with contextlib.redirect_stdout(stdout), contextlib.redirect_stderr(stderr):
                status = main([str(x) for x in arguments])
        except SystemExit as end:
            status = f"argparse: {end.code}"
        except BaseException as error:
            status = uncaught(error)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            sys.settrace(tracer)
    seconds = time.process_time() - start
    os.chdir(here)
    signal.signal(signal.SIGALRM, before)
    return Result(status, stdout.getvalue(), stderr.getvalue(), seconds, faults)


def uncaught(error):
    """An exception with the place in this program where it was raised."""
    place, at = "", error.__traceback__
    while at is not None:
        name = at.tb_frame.f_code.co_filename
        if "/derive/" in name:
            place = f"{name.rpartition('/derive/')[2]}:{at.tb_lineno}"
        at = at.tb_next
    return f"{type(error).__name__} at {place}: {str(error)[:200]}"


def judged(result, slack=1.0, *, record=False):
    """What is wrong with the end of a command, in words; empty when all is as promised."""
    found = [*result.faults]
    if result.status not in ((0, 1, 2) if record else (0, 2)):
        found.append(
            f"status {result.status}" + (f": {fails(result)}" if result.status == 1 else "")
        )
    if result.seconds > SECONDS * slack:
        found.append(f"{result.seconds:.1f} s")
    if "Traceback" in result.err or "out of memory" in result.err or "too deeply" in result.err:
        found.append(f"stderr {result.err[:300]!r}")
    if result.status == 2:
        lines = result.err.splitlines()
        if len(lines) != 1 or not lines[0].startswith("derive: ") or len(lines[0]) > MESSAGE + 20:
            found.append(f"stderr {result.err[:300]!r}, {len(result.err)} letters")
        if not result.err.rstrip("\n").isprintable():
            found.append(f"stderr {result.err[:300]!r}")
    return found


def fails(result):
    """The first verdict that is none of the record's own fault."""
    return next((x[:200] for x in result.out.splitlines() if x.startswith("FAILS")), "")


def limited(memory=MEMORY):
    """This process gets no more memory; for those that run nothing else."""
    resource.setrlimit(resource.RLIMIT_DATA, (memory, memory))


def slack():
    """How many times slower than usual this machine is: it may have other work, or be measured."""
    start = time.process_time()
    sum(i * i for i in range(2_000_000))
    return max(1.0, (time.process_time() - start) / 0.2) * (3 if sys.gettrace() else 1)
