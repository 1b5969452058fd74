"""Files of strangers: no traceback, no harm, within 2 s and 1 GB; see SECURITY.md, tests/fuzz."""

import itertools
import os
import re
import subprocess
import sys
from pathlib import Path
from time import process_time

import pytest

from derive.code.languages import comment
from derive.command.cli import main
from derive.command.writing import StoppedError, one_line, time_limit
from derive.language import limits
from derive.views.rendering import FORMATS
from tests.fuzz.cases import problem_files
from tests.fuzz.corpus import TOP, TURNED, bombs, meanings
from tests.fuzz.hostile import STRINGS
from tests.fuzz.mutate import case, mesh, quoted
from tests.support.needs import CC, needs

ROOT = Path(__file__).parents[2]
LIMITED = """
import resource, sys
resource.setrlimit(resource.RLIMIT_DATA, (1 << 30, 1 << 30))
resource.setrlimit(resource.RLIMIT_CPU, (30, 30))
from derive.command.cli import main
from derive.code.languages import comment
sys.exit(main(sys.argv[1:]))
"""


def python(*arguments, **options):
    """Another process of Python in the checkout."""
    environment = os.environ | {"OPENBLAS_NUM_THREADS": "1"}
    command = [sys.executable, *map(str, arguments)]
    options |= {"capture_output": True, "text": True, "timeout": 800}
    return subprocess.run(command, env=environment, **options)


def test_the_corpus():
    """All that tests/fuzz/corpus.py makes, and some cases by mutation, watched, in a process of 1
    GB."""
    done = python("-m", "tests.fuzz.corpus", cwd=ROOT)
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]


def test_a_case_is_the_same_each_time():
    assert case(3, 14)[:2] == case(3, 14)[:2]


LARGE = ("keys.toml", "closed.toml", "dots.toml", "closed.json")
LARGE += ("sum.toml", "brackets.toml", "power.toml", "hole.off")


@pytest.mark.parametrize("name", LARGE)
def test_in_a_process_of_its_own(name, tmp_path):
    """Under limits of the system, and without anything imported before."""
    files, first = problem_files(name, bombs()[name])
    for file, text in files.items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    done = python("-c", LIMITED, "check", first, cwd=tmp_path)
    assert done.returncode == 2, done.stderr[-300:]
    assert done.stderr.startswith(f"derive: {first}: ")
    assert done.stderr.count("\n") == 1
    assert {*os.listdir(tmp_path)} == {*files}


@needs("cc")
def test_comments_of_strangers_compile(tmp_path):
    """A title, a unit and a meaning that close comments, strings, lines."""
    told = [*map(quoted, STRINGS)]
    declared = "".join(
        f"k{i} = {{ default = 1, unit = {x}, meaning = {x} }}\n" for i, x in enumerate(told)
    )
    mass = "+".join(["k", *(f"k{i}" for i in range(len(told)))])
    for k, title in enumerate(told[::6]):
        path = tmp_path / "top.toml"
        text = TURNED.format(title).replace('"k"', f'"{mass}"')
        path.write_text(text.replace("[[point]]", f"{declared}[[point]]"), encoding="utf-8")
        choices = ["--lang", "c", "--lang", "python", "--prefix", f"top{k}", "--out", str(tmp_path)]
        assert main(["emit", str(path), *choices]) == 0
        compile((tmp_path / f"top{k}.py").read_text(encoding="utf-8"), "top.py", "exec")
    flags = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-trigraphs", "-fsyntax-only"]
    sources = sorted(map(str, tmp_path.glob("*.c")))
    done = subprocess.run([CC, *flags, *sources], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[:2000]


@needs("pdflatex")
def test_notes_of_strangers_are_set(tmp_path, monkeypatch, capsys):
    """TeX gets through all of it, and opens and starts nothing."""
    monkeypatch.chdir(tmp_path)
    Path("meaning.toml").write_text(meanings(), encoding="utf-8")
    assert main(["notes", "meaning.toml", "--out", "notes.pdf"]) == 0, capsys.readouterr().err
    assert sorted(os.listdir()) == ["meaning.toml", "notes.pdf"]


STOPPED = """
import signal, sys
from derive.command.cli import main
main(["emit", "so3", "--names"])  # what is loaded late is there, not half of it
status = main(["emit", "so3", "--seconds", "0.01", "--out", sys.argv[1]])
assert signal.getitimer(signal.ITIMER_PROF) == (0, 0)
assert main(["list", "--seconds", "60"]) == 0
sys.exit(status)
"""


def test_time_is_over(tmp_path):
    """One line, exit 2, nothing written; in a process of its own, as half an import would stay."""
    out = tmp_path / "out"
    command = [sys.executable, "-c", STOPPED, str(out)]
    ended = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, check=False)
    assert ended.returncode == 2, ended.stderr
    assert "stopped after 0.01 s of processor time (--seconds)" in ended.stderr
    assert not out.exists()


def test_time_is_over_within():
    """What takes no lock is stopped under coverage too, more than once."""
    for _ in range(2):
        with pytest.raises(StoppedError, match=r"after 0\.01 s"), time_limit(0.01):
            all(True for _ in iter(int, 1))


@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
def test_what_is_dropped_while_an_object_goes_is_raised_again_soon():
    class Going:
        def __del__(self):
            until = process_time() + 0.03
            while process_time() < until:
                pass

    def busy(until):
        going = Going()
        del going
        while process_time() < until:
            pass

    begun = process_time()
    with pytest.raises(StoppedError), time_limit(0.01):
        busy(begun + 10)
    assert 0.03 < process_time() - begun < 0.5


def test_one_line():
    assert one_line("a\nb\x1b[2J\u202e\ud800c") == r"a\nb\x1b[2J\u202e\ud800c"
    assert len(one_line("x" * 10**6)) == limits.MESSAGE


def test_a_name_of_a_file_that_moves_the_cursor(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    name = "a\nderive: all is well\x1b[2J.toml"
    Path(name).write_text(TOP + "x = 1\n")
    assert main(["walk", name]) == 2
    err = capsys.readouterr().err
    assert err.count("\n") == 1
    assert err[:-1].isprintable()


def test_a_mesh_behind_a_link(tmp_path, capsys):
    """A link that leads out of the folder, or nowhere, is no mesh of the folder."""
    home = tmp_path / "home"
    home.mkdir()
    (tmp_path / "mesh.off").write_text(mesh("off"), encoding="utf-8")
    (home / "out.off").symlink_to("../mesh.off")
    (home / "loop.off").symlink_to("loop.off")
    (home / "null.off").symlink_to("/dev/zero")
    for name, says in {"out": "outside", "loop": "leads nowhere", "null": "outside"}.items():
        head = 'name = "a"\ngroup = "SO(3)"\n[body]\nsolid = "mesh"\ndensity = 1\n'
        (home / "a.toml").write_text(f'{head}file = "{name}.off"\n')
        assert main(["walk", str(home / "a.toml")]) == 2
        assert says in capsys.readouterr().err


def test_limits_are_told(tmp_path, capsys):
    """SECURITY.md has the numbers that the program has."""
    text = (ROOT / "SECURITY.md").read_text(encoding="utf-8").replace("\u00a0", "")
    numbers = {int(x) for x in re.findall(r"[0-9]+", text)}
    told = (limits.PROBLEM_BYTES, limits.TRIANGLES, limits.RECORD_BYTES, limits.EXPRESSION)
    told += (*limits.TABLES.values(), limits.PARAMETERS, limits.PULLS, limits.LEAVES, limits.DEPTH)
    told += (limits.STEPS_OF_A_MOTION,)
    assert {*told} <= numbers


def test_no_text_ends_a_comment_or_a_docstring():
    for length in range(8):
        for letters in itertools.product('*/\\"', repeat=length):
            shown = comment("".join(letters))
            assert not any(x in shown for x in ("*/", "/*", '"""', "\\"))


@pytest.mark.parametrize("number", ["0x" + "f" * 4000, "0b" + "1" * 20000, "9" * 5000])
def test_integers_that_no_message_could_show(number, tmp_path, capsys):
    path = tmp_path / "a.toml"
    path.write_text(TOP + f"[[point]]\nmass = {number}\nat = [1, 0, 0]\n")
    assert main(["walk", str(path)]) == 2
    assert capsys.readouterr().err == (
        f"derive: {path}: an integer of hundreds of digits; numbers go up to 1e300\n"
    )


def test_a_pipe_where_a_file_should_be(tmp_path, capsys):
    os.mkfifo(tmp_path / "so3.c")
    assert main(["emit", "so3", "--out", str(tmp_path)]) == 2
    assert "a pipe or a device; remove it" in capsys.readouterr().err
    assert os.listdir(tmp_path) == ["so3.c"]


@pytest.mark.parametrize("form", FORMATS)
def test_no_control_characters(form, tmp_path, capsys):
    path = tmp_path / "a.toml"
    words = r"a\u001b[31m\u202e\u0000\u009b31m\u0007 b"
    path.write_text(TURNED.format(f'"{words}"'), encoding="utf-8")
    assert main(["walk", str(path), "--format", form]) == 0
    out = capsys.readouterr().out
    assert not {*"\x1b\x00\x07\x9b\u202e"} & {*out}
