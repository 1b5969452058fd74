"""The Python of the playground, without a browser: what it derives, checks, moves and gives is what
the command line does; what is typed wrong is told at its line."""

import json
import random

import pytest

from derive import derive as derived
from derive.code.emit import emit
from derive.code.options import Options
from derive.command.cli import main
from derive.motion.simulate import beginning
from derive.programs import motion_of
from derive.views.arrows import arrows, with_arrows
from derive.views.language import language
from derive.views.page.motion_page import data
from tests.fuzz.corpus import problems
from tests.support.played import PENDULUM, UNKNOWN_KEY, Played, text_of, unzipped
from tests.support.playground_site import asked

FAULTS = [
    (PENDULUM.replace('at = [0, "l", 0]', "at = [0, 1]"), 12, "point 2, at"),
    (UNKNOWN_KEY, 18, "unknown key 'h'"),
    (PENDULUM.replace("SO(3)", "SOO(3)"), 2, "unknown group 'SOO(3)'"),
    (PENDULUM.replace('group = "SO(3)"', 'group = "SO(3)'), 2, "not TOML"),
    (PENDULUM.replace("l = { default = 2 }", 'l = { default = "x" }'), 5, "parameter 'l'"),
    (PENDULUM.replace("g = { default = 9.81 }\n", ""), 17, "potential 1, key 'g'"),
    ("", 1, "key 'group' is missing"),
    (PENDULUM.replace('"mine"', "mine"), 1, 'stands in quotes: "mine"'),
    (PENDULUM.replace("default = 2 ", "default = 2,5 "), 5, "not a comma: 2.5"),
    (PENDULUM + "\n[ini", 20, "a table is written [name]"),
    (PENDULUM.replace("l =", f"{'q' * 70} ="), 5, "parameter 'qqq"),
    (PENDULUM + "[initial]\nzeta = [1, 2, 3]\n", 20, "zeta_1 = …, zeta_2 = …"),
]
MESH = 'name = "cube"\ngroup = "SO(3)"\n[body]\nsolid = "mesh"\nfile = "cube.off"\ndensity = 1\n'
C_AND_JAVASCRIPT = "--lang c --lang javascript"
COMMANDS = [
    (PENDULUM, f"emit FILE {C_AND_JAVASCRIPT} --lang rust --real float --out out"),
    (PENDULUM, "notes FILE --out out/mine.tex"),
    (PENDULUM, "walk FILE --format json --out out/mine.json"),
    (PENDULUM, f"emit FILE {C_AND_JAVASCRIPT} --step gauss --out out"),
    (PENDULUM, f"emit FILE {C_AND_JAVASCRIPT} --step gauss --conserved --out out"),
    ("kovalevskaya_top", f"emit FILE {C_AND_JAVASCRIPT} --conserved --out out"),
    ("se3", f"emit FILE {C_AND_JAVASCRIPT} --lang python --step gauss --conserved --out out"),
    ("gas_cloud", f"emit FILE {C_AND_JAVASCRIPT} --step gauss --conserved --out out"),
]


def changed(name):
    """A ready-made problem as a text of one's own, which Python derives: others are stored."""
    return f"{text_of(name)}\n"


ROADS = ("top", "so4", "two_tops", "kirchhoff", "imu", "zeitlin", "ideal_fluid", "dirichlet")
TOLD = [
    ("walk", {"text": changed("sl3"), "lang": "fr"}),
    ("check", {"text": text_of("so3")}),
    ("motion", {"text": changed("top"), "lang": "en"}),
    ("kept", {"text": changed("kovalevskaya_top"), "lang": "fr"}),
    ("refused", {"text": PENDULUM, "words": "--lang c --step gauss"}),
    ("files", {"text": PENDULUM, "words": COMMANDS[0][1]}),
    ("walk", {"text": UNKNOWN_KEY, "lang": "en"}),
    *(("walk", {"text": changed(x), "lang": "en"}) for x in ROADS),
]


@pytest.fixture
def played(tmp_path, monkeypatch):
    return Played(tmp_path, monkeypatch)


def said(capsys, *words):
    assert main([*words]) == 0
    return capsys.readouterr().out


def errors(heard):
    return [news for kind, news in heard if kind == "error"]


@pytest.mark.parametrize("name", ["so3", "sl3", "two_tops", "zeitlin", "ideal_fluid"])
def test_a_ready_made_problem_is_walked_as_by_the_command(played, capsys, name):
    lang = "fr" if len(name) % 2 else "en"
    heard = played.asked("walk", text=text_of(name), lang=lang)
    assert not errors(heard)
    shown = "".join(news for kind, news in heard if kind == "piece")
    assert shown == said(capsys, "walk", name, "--format", "html", "--fragment", "--lang", lang)


@pytest.mark.parametrize("name", ["so3", "ideal_fluid"])
def test_a_ready_made_problem_is_checked(played, name):
    heard = played.asked("check", text=text_of(name))
    verdicts = [news for kind, news in heard if kind == "verdict"]
    assert ("checked", {}) in heard
    assert len(verdicts) > 10
    assert all(x["holds"] and float(x["bound"]) < 1e-30 for x in verdicts)


@pytest.mark.parametrize(("text", "words"), COMMANDS)
def test_files_are_those_of_the_command(played, capsys, tmp_path, text, words):
    file, out = tmp_path / "mine.toml", tmp_path / "out"
    file.write_text(text_of(text), encoding="utf-8")
    added = json.dumps({"added.c": "é"})
    heard = dict(played.asked("files", text=text_of(text), words=words, added=added))
    files = heard["zip"]
    assert files.pop("added.c") == "é".encode()
    assert {x: y.encode() for x, y in heard["files"].items()} == files
    out.mkdir()
    place = words.replace("FILE", str(file)).rpartition(" out")
    said(capsys, *f"{place[0]} {out}{place[2]}".split())
    assert files == {x.name: x.read_bytes() for x in out.iterdir()}


@pytest.mark.parametrize("name", ["so3", "kovalevskaya_top", "sl3", "riemann_ellipsoid"])
def test_a_motion_has_what_the_page_of_the_command_has(played, name):
    text = text_of(name)
    ((_, shown),) = played.asked("motion", text=text, lang="fr")
    ((_, told),) = played.asked("kept", text=text, lang="fr")
    own = derived(name)
    code = motion_of(own.problem, own.record)
    begin = beginning(code, own.problem, given={})
    there = json.loads(json.dumps(data(code, own.problem, own.record, begin, language("fr"))))
    assert told["kept"] == there["kept"] != {}
    assert shown["page"]["kept"] == {}
    different = {x for x in shown["page"] if shown["page"][x] != there.get(x)}
    # the legend of a picture that is saved is the playground's alone
    assert different <= {"kept", "x", "t", "tol", "names", "pushed", "arrows", "meanings"}
    chosen = Options(step=("gauss",))
    seen = with_arrows(own.record, arrows(own.record))  # its code has the numbers of these, too
    made = motion_of(own.problem, seen).program
    (source,) = emit(made, seen, ("javascript",), name, chosen).values()
    assert told["source"] == source


@pytest.mark.parametrize(("text", "line", "message"), FAULTS, ids=range(len(FAULTS)))
def test_what_is_wrong_is_told_at_its_line(played, text, line, message):
    (error,) = errors(played.asked("walk", text=text, lang="en"))
    assert message in error["message"]
    assert error["message"].startswith("derive: ")
    assert error["line"] == line


def test_a_name_that_the_state_has_not_is_a_warning_at_its_line(played):
    text = PENDULUM + "[initial]\nzeta_1 = 1\nomega_3 = 2\n"
    heard = played.asked("walk", text=text, lang="en")
    (warning,) = [news for kind, news in heard if kind == "warning"]
    assert warning["line"] == 21
    assert "omega_3: the state has no such number" in warning["message"]
    assert "zeta_1 … zeta_3" in warning["message"]
    right = PENDULUM + "[initial]\nzeta_1 = 1\nA_33 = 1\n"
    assert not [x for x in played.asked("walk", text=right, lang="en") if x[0] == "warning"]


@pytest.mark.parametrize("part", range(20))
def test_files_of_strangers_end_in_a_line(played, part):
    for name, content in random.Random(22).sample([*problems()], 200)[part::20]:
        text = content if isinstance(content, str) else content.decode("utf-8", "replace")
        heard = played.asked("walk", text=text, lang="en")
        assert errors(heard) or "walked" in {kind for kind, _ in heard}, name
        for news in errors(heard):
            assert news["message"].startswith("derive: "), name
            assert "Traceback" not in news["message"], name


@pytest.mark.parametrize("name", ["top", "sl3", "ideal_fluid"])
def test_what_is_stored_is_what_is_told(page, played, name):
    """The code of a motion once, that with all it keeps."""
    for ask in ("walk", "motion", "kept"):
        more = {"text": text_of(name), "lang": "en"}
        how, heard = asked(page, ask, **more)
        assert how == "end"
        mine = played.asked(ask, **more)
        for told in (heard, mine):
            for kind, news in told:
                if kind == "motion":
                    news.pop("source")
                if kind == "derived":  # what is stored has its verdicts with it
                    ticks = [(x.pop("holds", None), float(x.pop("bound", 1))) for x in news["road"]]
                    assert told is mine or all(y and z < 1e-30 for y, z in ticks)
        assert heard == mine


@pytest.mark.parametrize(("ask", "more"), TOLD)
def test_the_browser_is_told_the_same(page, played, ask, more):
    """By another Python, without NumPy, with SymPy when asked for; packing it walks the others."""
    how, heard = asked(page, ask, **more)
    assert how == "end"
    heard = [(kind, unzipped(x) if kind == "zip" else x) for kind, x in heard]
    assert heard == played.asked(ask, **more)


def test_what_needs_arrays_is_refused_in_the_browser(page):
    how, heard = asked(page, "walk", text=MESH, lang="en")
    (error,) = errors(heard)
    assert how == "end"
    assert "NumPy" in error["message"]
