"""What interrupts an emission: killed, crowded, interrupted by a key, out of room, unread."""

import os
import signal
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

import pytest

from derive.command.writing import PREFIX, SUFFIX, write
from tests.support.processes import environment

pytestmark = pytest.mark.skipif(os.name != "posix", reason="this is no POSIX")
ROOT = Path(__file__).parents[2]

# killed by itself when it asks the system for the n-th time for something about the folder
KILLED = """\
import os, signal, sys
from pathlib import Path
from derive.command.writing import write
out, count, name, size = Path(sys.argv[1]), int(sys.argv[2]), sys.argv[3], int(sys.argv[4])
files = {f"{name}.h": "new " * size, f"{name}.c": "new " * size}
def hook(event, told):
    global count
    if told and str(told[0]).startswith(str(out)) or event == "fcntl.flock":
        count -= 1
        if count == 0:
            os.kill(os.getpid(), signal.SIGKILL)
sys.addaudithook(hook)
write(files, out)
"""


def python(code, *arguments, **options):
    command = [sys.executable, "-c", code, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, cwd=ROOT, **options)


def left_over(folder):
    return [*folder.rglob(f"{PREFIX}*{SUFFIX}")]


def test_killed_at_every_step_of_writing(tmp_path):
    """Each file is the old one or the new one; the next run clears up and is whole."""
    old, steps, seen = {"a.h": "old", "a.c": "old", "mine": "mine"}, 0, set()
    while True:
        for name, text in old.items():
            (tmp_path / name).write_text(text)
        steps += 1
        done = python(KILLED, tmp_path, steps, "a", 5000)
        found = {x.name: x.read_text() for x in tmp_path.iterdir() if x not in left_over(tmp_path)}
        assert set(found) == set(old)
        assert found["mine"] == "mine"
        assert {found["a.h"], found["a.c"]} <= {"old", "new " * 5000}
        seen.add((found["a.h"][:3], found["a.c"][:3], len(left_over(tmp_path))))
        if done.returncode == 0:
            break
        assert done.returncode == -signal.SIGKILL
        assert write({"b": "another"}, tmp_path) == [tmp_path / "b"]
        assert not left_over(tmp_path)
        (tmp_path / "b").unlink()
    assert steps > 9
    assert {("old", "old", 2), ("new", "old", 1), ("new", "new", 0)} <= seen


def files_of(folder):
    return {str(x.relative_to(folder)): x.read_bytes() for x in folder.rglob("*") if not x.is_dir()}


def sweep(folder, moments):
    """Kill builds after fractions of the time they take: the counts of old and of new files."""
    command = [sys.executable, "-m", "derive", "build", "--out", folder]
    start = time.monotonic()
    subprocess.run(command, check=True, capture_output=True, cwd=ROOT)
    takes, new, counts = time.monotonic() - start, files_of(folder), {"old": 0, "new": 0}
    for moment in moments:
        for name in new:
            (folder / name).write_bytes(b"old")
        run = subprocess.Popen(command, stderr=subprocess.DEVNULL, cwd=ROOT)
        time.sleep(moment * takes)
        run.kill()
        run.wait()
        left = left_over(folder)
        for name, data in files_of(folder).items():
            if folder / name not in left:
                assert data in (b"old", new[name]), name
                counts["old" if data == b"old" else "new"] += 1
    subprocess.run(command, check=True, capture_output=True, cwd=ROOT)
    assert files_of(folder) == new
    return counts


def test_builds_killed_at_any_moment(tmp_path):
    counts = sweep(tmp_path, [0.5, 0.75, 1.0])
    assert counts["old"]


WRITER = """\
import sys
from pathlib import Path
from derive.command.writing import write
out, end, tag = Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3]
while not end.exists():
    write({"a.h": tag * 2000, "a.c": tag * 3000}, out)
"""


LOOKS = 300


def test_two_at_once_do_not_mix(tmp_path):
    """Whoever holds the folder sees the .h and .c of one emission, until those of all were seen."""
    import fcntl

    out, end = tmp_path / "out", tmp_path / "end"
    write({"a.h": "w", "a.c": "w"}, out)
    command = [sys.executable, "-c", WRITER, out, end]
    writers = [subprocess.Popen([*command, tag], cwd=ROOT) for tag in "xyz"]
    seen, handle = Counter(), os.open(out, os.O_RDONLY)
    try:
        while len(seen) < 4 or seen.total() < LOOKS:
            fcntl.flock(handle, fcntl.LOCK_EX)
            letters = {(out / name).read_text()[0] for name in ("a.h", "a.c")}
            assert not left_over(out)
            fcntl.flock(handle, fcntl.LOCK_UN)
            assert len(letters) == 1
            seen.update(letters)
            assert all(each.poll() is None for each in writers)
            time.sleep(0.001)
    finally:
        os.close(handle)
        end.touch()
    assert [each.wait() for each in writers] == [0, 0, 0]
    assert not left_over(out)


def test_a_folder_that_stays_locked(tmp_path, monkeypatch):
    import fcntl

    monkeypatch.setattr("derive.command.writing.PATIENCE", 0.05)
    handle = os.open(tmp_path, os.O_RDONLY)
    fcntl.flock(handle, fcntl.LOCK_EX)
    with pytest.raises(OSError, match="another process writes to it"):
        write({"a": "a"}, tmp_path)
    os.close(handle)
    assert write({"a": "a"}, tmp_path)


def test_a_folder_by_two_names(tmp_path):
    """A link beside a file leads to the folder itself: that is one lock."""
    (tmp_path / "real").mkdir()
    (tmp_path / "alias").symlink_to("real")
    (tmp_path / "real" / "a.c").symlink_to(tmp_path / "real" / "there.c")
    write({"a.h": "1", "a.c": "2"}, tmp_path / "alias")
    assert (tmp_path / "real" / "there.c").read_text() == "2"


# SIGINT some seconds after the command has begun to heed it, before it imports anything; a shell
# ignores it for what runs in its background, these tests perhaps
INTERRUPTED = """\
import atexit, os, signal, sys
from derive.__main__ import main
signal.signal(signal.SIGINT, signal.default_int_handler)
after, install = float(sys.argv.pop(1)), signal.signal
def heeded(*arguments):
    install(*arguments)
    signal.signal = install
    signal.setitimer(signal.ITIMER_REAL, after)
signal.signal(signal.SIGALRM, lambda *_: os.kill(os.getpid(), signal.SIGINT))
atexit.register(lambda: signal.setitimer(signal.ITIMER_REAL, 0))
signal.signal = heeded
sys.exit(main())
"""


@pytest.mark.parametrize("command", [["list"], ["emit", "so3"]], ids=" ".join)
def test_an_interruption_is_quiet(command, tmp_path):
    """In imports and in the work: 130 and not a word, or done before."""
    start = time.monotonic()
    where = ["--out", tmp_path] if command[0] == "emit" else []
    python(INTERRUPTED, 100, *command, *where, env=environment())
    takes, moments = time.monotonic() - start, 6
    statuses = []
    for i in range(moments):
        after = max(takes * i / moments, 1e-3)
        done = python(INTERRUPTED, after, *command, *where, env=environment())
        assert done.returncode in (0, 130)
        assert done.stderr == ""
        statuses.append(done.returncode)
    assert 130 in statuses
    assert not left_over(tmp_path)


def shell(line, **options):
    return subprocess.run(
        ["sh", "-c", line.replace("derive", f"{sys.executable} -m derive")],
        capture_output=True, text=True, cwd=ROOT, **options,
    )  # fmt: skip


@pytest.mark.parametrize("command", ["walk se3", "list", "--help"])
def test_nobody_reads(command):
    """The pipe is closed at once or after a line, or there was no stdout at all."""
    for end in ("| true", "| head -n 1 >/dev/null", ">&-"):
        done = shell(f"{{ {{ derive {command}; echo $? >&3; }} {end}; }} 3>&1")
        assert (done.stdout, done.stderr) == ("0\n", ""), end


def test_what_nobody_reads_is_in_the_files(tmp_path):
    """A run and its page are whole, though the pipe is closed before the first line."""
    run, page = tmp_path / "run.csv", tmp_path / "page.html"
    simulate = f"derive simulate top --t 0.1 --points 10 --out {run} --html {page}"
    read, unread = os.pipe()
    os.close(read)
    line = simulate.replace("derive", f"{sys.executable} -u -m derive", 1)
    done = subprocess.run(
        ["sh", "-c", f"exec {line}"], stdout=unread, stderr=subprocess.PIPE, text=True, cwd=ROOT
    )
    os.close(unread)
    assert (done.returncode, done.stderr) == (0, "")
    assert len(run.read_text().splitlines()) > 10
    assert page.read_text().endswith("</html>\n")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full")
def test_output_without_room():
    done = shell("derive walk so3 >/dev/full")
    assert done.returncode == 2
    assert done.stderr == "derive: standard output: No space left on device\n"
