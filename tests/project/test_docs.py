"""README and docs/ are true: commands run, programs compile, what is shown is printed or there."""

import re
import runpy
import subprocess
import sys
import tomllib
from types import SimpleNamespace

import pytest

import derive
from derive.code.languages import LANGUAGES
from derive.command.arguments import parser
from derive.command.cli import COMMANDS, main
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from derive.schema.body_kinds import SOLIDS
from derive.schema.potential_kinds import kinds
from derive.schema.python_words import words
from derive.views.rendering import FORMATS
from tests.project.test_layers import ALLOWED, FILES, room_of
from tests.support.needs import need, needs
from tests.support.pages import FENCE, PAGES, ROOT, TARGETS, Reader, blocks


@pytest.mark.no_cover
@pytest.mark.parametrize("page", [x for x in PAGES if blocks(x)])
def test_a_page_runs(page, tmp_path, monkeypatch, capsys):
    def typed(words, code):
        with monkeypatch.context() as m:
            m.chdir(tmp_path)
            assert main(words) == code, words
        return capsys.readouterr()

    reader = Reader(tmp_path, derive=typed, environment={"derive_DIR": str(ROOT / "cmake")})
    reader.read(page)
    need(*sorted(reader.absent))


# -- what is said between the blocks ------------------------------------------------------------

PROSE = {page: FENCE.sub("", text) for page, text in PAGES.items()}
SPANS = [(page, x) for page, text in PROSE.items() for x in re.findall(r"`([^`\n]+)`", text)]
PATH = re.compile(r"((?:derive|templates|cmake|generated|tests|benchmarks|examples|docs)/[\w./-]*)")
OPTIONS = {x for _, span in SPANS for x in re.findall(r"(?<![\w-])--[a-z][a-z-]+", span)}
OF_OTHERS = {"--upgrade", "--quick"}


def test_languages_and_formats_are_named():
    assert re.findall(r"^\| `(\w+)` \| `so3", PAGES["docs/code.md"], re.M) == [*LANGUAGES]
    line = re.search(r"--format (\w+) .*or (.*):", PAGES["docs/commands.md"])
    assert {"text", line[1], *line[2].split(", ")} == {*FORMATS}


@pytest.mark.parametrize("page", [x for x in PAGES if any(y.kind == "toml" for y in blocks(x))])
def test_every_problem_is_one(page):
    for kind, text in blocks(page):
        if kind == "toml":
            found = problem_of(tomllib.loads(text))
            assert found.group or found.torus or found.fluid


@pytest.mark.parametrize("page", PAGES)
def test_what_a_page_names_is_there(page):
    """Files by their paths, labels of links too, and the targets of make."""
    text = PAGES[page]
    for path in PATH.findall(" ".join(x for where, x in SPANS if where == page)):
        assert (ROOT / path).exists() or "LANGUAGE" in path or "KIND" in path, path
    for target, anchor in re.findall(r"\]\(([\w./-]+?\.(?:md|png|svg))?(#[\w-]+)?\)", text):
        file = (ROOT / page).parent / target if target else ROOT / page
        assert file.is_file(), target
        if anchor:
            heads = re.findall(r"^#+ (.*)$", file.read_text(encoding="utf-8"), flags=re.M)
            slugs = {re.sub(r"[^\w -]", "", h).strip().lower().replace(" ", "-") for h in heads}
            assert anchor[1:] in slugs, (target, anchor)
    for target in re.findall(r"`make ([a-z]+)", text):
        assert target in TARGETS, target


def test_every_option_that_is_named_is_one():
    known = set()
    for command in COMMANDS:
        sub = parser(COMMANDS, None)._subparsers._group_actions[0].choices[command]
        known |= {*sub._option_string_actions}
    named = OPTIONS - OF_OTHERS
    assert named <= known, named - known
    emit = PAGES["docs/options.md"]
    sub = parser(COMMANDS, None)._subparsers._group_actions[0].choices["emit"]
    missing = [x for x in sub._option_string_actions if x.startswith("--") and f"`{x}" not in emit]
    assert missing == ["--help"]


def typed(span):
    """The words of a command in a sentence, where nothing of it is left open."""
    words = span.replace("PROBLEM", "so3").replace("NAME", "x").replace(" N", " 1").split()
    return [] if "…" in span or "COMMAND" in span else words[1:]


@pytest.mark.parametrize("span", sorted({x for _, x in SPANS if x.startswith("derive ")}))
def test_a_command_in_a_sentence_is_one(span):
    words = typed(span)
    if len(words) == 1 and words[0] in COMMANDS:
        return  # it is named, not typed
    if words:
        assert parser(COMMANDS, None).parse_args(words).command in COMMANDS


def test_every_command_is_described():
    for command in COMMANDS:
        assert f"derive {command}" in PAGES["docs/commands.md"]


def keys(table, **file):
    """The keys that a table may have, from the line that refuses another."""
    body = {"point": [{"mass": 1, "at": [1, 0, 0]}]}
    with pytest.raises(ProblemError) as refused:
        problem_of({"name": "x", "group": "SL(3)", **body, **table, **file})
    found = re.search(r"unknown key 'zz'.*\(known: (.*)\)", str(refused.value))
    assert found, refused.value
    return found[1].split(", ")


TABLES = [
    {"zz": 1},
    {"group": {"zz": 1}},
    {"parameters": {"k": {"zz": 1}}},
    {"point": [{"zz": 1}]},
    {"body": {"zz": 1}, "point": []},
    {"body": {"given": {"zz": 1}}, "point": []},
    {"damping": [{"zz": 1}]},
    {"force": [{"zz": 1}]},
    {"event": [{"zz": 1}]},
    {"input": [{"name": "u", "kind": "covector"}], "signal": [{"zz": 1}]},
    *({"damping": [{"kind": x, "zz": 1}]} for x in ("quadratic", "rotational")),
    *({"input": [{"name": "u", "kind": x, "zz": 1}]} for x in ("covector", "force", "torque")),
    *(
        {"potential": [{"kind": x, "zz": 1}]}
        for x in kinds()
        if "rotations" not in kinds()[x].needs
    ),
    *({"solid": [{"kind": x, "zz": 1}], "point": []} for x in SOLIDS),
]


@pytest.mark.parametrize("table", TABLES, ids=str)
def test_every_key_of_a_problem_file_is_described(table):
    spans = " ".join(x for page, x in SPANS if page == "docs/problem-file.md")
    for key in keys(table):
        assert re.search(rf"(?<!\w){key}(?!\w)", spans), key


def rooms():
    """Of each row of the table of rooms: the room, what it may import, its most lines."""
    row = r"^\| `([\w/]+)` \| .* \| (.*?) ?\| (\d+) \|$"
    return re.findall(row, PAGES["docs/architecture.md"], flags=re.M)


def test_the_table_of_rooms_is_that_of_the_imports():
    found = {room: {*re.findall(r"[\w/]+", imports)} for room, imports, _ in rooms()}
    assert found == {x: y - {x, "__init__"} for x, y in ALLOWED.items()}


def test_no_room_is_larger_than_its_budget():
    """Nor much smaller: who makes a room smaller takes the lines out of the table."""
    for room, _, most in rooms():
        own = [x for x in FILES if room_of(x.relative_to(ROOT / "derive").parts) == room]
        lines = sum(len(x.read_text(encoding="utf-8").splitlines()) for x in own)
        assert 0.95 * int(most) - 50 <= lines <= int(most), (room, lines)


def test_the_reference_has_every_public_name():
    named = re.findall(r":: derive\.(\w+)$", PAGES["docs/reference.md"], flags=re.M)
    assert sorted(named) == sorted({*derive.__all__, *words()})


WITHOUT_SYMPY = """
import sys
from derive.command.cli import main
from derive.command.showing import derive
from tests.support.walks import own_verdicts
assert main(["walk", "gyrostat"]) == 0
assert all(x.holds for x in own_verdicts(derive("gyrostat")[1]))
assert "sympy" not in sys.modules
"""


def test_walks_and_checks_do_without_sympy():
    subprocess.run([sys.executable, "-c", WITHOUT_SYMPY], cwd=ROOT, check=True, capture_output=True)


@needs("make")
def test_every_make_target_is_described():
    command = ["make", "help"]
    told = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert all(f"make {t}" in told for t in TARGETS)
    assert {"derive", "test", "bench", "docs", "help"} <= {*TARGETS}


@needs("make")
def test_the_site_leads_to_its_playground():
    """From every page, however deep, and only where there is one: make docs has none."""
    for target, told in (("site", True), ("docs", False)):
        command = ["make", "--dry-run", target]
        said = subprocess.run(command, cwd=ROOT, capture_output=True, text=True).stdout
        (build,) = [x for x in said.splitlines() if "sphinx-build" in x]
        tags = {build.split()[build.split().index("-t") + 1]} if "-t" in build.split() else set()
        app = SimpleNamespace(tags=SimpleNamespace(has=tags.__contains__))
        conf = runpy.run_path(str(ROOT / "docs" / "conf.py"))
        context = {"pathto": lambda path, resource: f"../{path}" if resource else ""}
        conf["contents_shown"](app, "docs/motion", "page.html", context, None)
        assert ('href="../play/index.html"' in context["furo_navigation_tree"]) is told
