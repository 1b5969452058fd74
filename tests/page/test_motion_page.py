"""The page in which a body moves: its bytes, its words, what it escapes."""

import re

import pytest

import derive
from derive.command.cli import main
from derive.command.showing import ready_made
from derive.language.templating import folder
from derive.views.page.motion_page import DEFINED, SCRIPTS, plain
from tests.support.motion_pages import BAD, FAST, page, told
from tests.support.walks import derived

MOST = 74_700  # some 25 000 as a server packs them; the longest has 74 611
LONGEST = "se3"
PAGELESS = ("affine", "linear", "ideal_fluid", "inhomogeneous_fluid", "stratified_fluid")
PAGELESS += ("imu",)


@pytest.mark.parametrize("name", sorted(ready_made(), key=lambda x: x not in ("sl3", LONGEST)))
def test_every_page_is_small(name):
    if name in PAGELESS:
        with pytest.raises(ValueError, match=r"no numeric code|not simulated"):
            derived(name).motion_page(5.0)
        return
    for language in ("en", "fr"):
        assert len(page(name, language).encode()) <= MOST


def test_it_is_alone_always_the_same_and_says_where_its_script_is_from():
    whole = page("top")
    assert not re.search(r"https?:|@import|url\(|src=|<link|fetch|XMLHttp|import\(|eval\(", whole)
    assert whole == derive.derive("top").motion_page(10.0, **FAST)
    for name in ("top", "sl3"):
        (script,) = re.findall(r"<script>(.*?)</script>", page(name), re.DOTALL)
        (comment,) = re.findall(r"/\*.*?\*/", script)
        assert f'"derive emit {name} --lang javascript --step gauss"' in comment
        assert "templates/html/motion" in comment


def test_what_a_body_has_not_is_not_in_its_page():
    """An ellipsoid of the velocity, a spring, a mouse that turns."""
    marks = {
        "polhode": "ζ${",
        "spring": "0.14 + 0.72 *",
        "camera": "azimuth",
        "ball": "32, 16,",
    }
    for name in ("top", "so3", "sl3", "two_tops", "euler_poisson"):
        body = told(page(name))["body"]
        parts = body["parts"]
        turned = any(part["moments"] or "turning" in part for part in parts)
        has = {
            "polhode": body["polhode"],
            "spring": body["springs"] or any(part["anchors"] for part in parts),
            "camera": parts,
            "ball": turned or any("ball" in str(part["solids"]) for part in parts),
        }
        bare = page(name).replace(" ", "")
        shown = {x: mark.replace(" ", "") in bare for x, mark in marks.items()}
        assert shown == {x: bool(y) for x, y in has.items()}, name


def test_both_languages():
    english, french = (told(page("top", x)) for x in ("en", "fr"))
    assert english["words"]["energy"] == "energy"
    assert french["words"]["energy"] == "énergie"
    assert french["kept"]["angular_momentum_3"] == ["moment cinétique 3", "kg m²/s"]
    assert french["labels"]["rho"] == ["masse volumique", "kg/m³"]
    assert french["labels"]["zeta_1"] == ["vitesse angulaire dans le corps", "rad/s"]
    assert '<html lang="fr">' in page("top", "fr")
    assert english["kept"]["body_angular_momentum_3"][0] == "angular momentum in the body 3"
    untold = {x for x, y in english["words"].items() if y == french["words"][x]}
    assert untold == {"pause"}


def test_nothing_of_a_stranger_is_markup_or_code(hostile):
    tags = re.findall(r"<(\w+)", re.sub(r"<script.*?</script>", "<script>", hostile, flags=re.S))
    assert tags.count("script") == 2
    assert "img" not in tags
    assert "alert" not in re.findall(r"<script>(.*?)</script>", hostile, re.DOTALL)[0]
    assert told(hostile)["labels"]["a"] == [BAD, BAD]


def test_the_energy_is_kept_where_nothing_moves_it():
    assert not told(page("so3")).get("lost", False)
    pushed = told(derived("so3").motion_page(1.0, start={"u_1": 0.5}))
    assert not pushed.get("lost", False)
    assert pushed["words"]["kept"] == "What is kept without inputs"
    assert told(page("top"))["words"]["kept"] == "What is kept"
    assert told(page("sl3"))["words"]["defect"] == "distance to the group |det A − 1|"
    assert told(page("top"))["words"]["defect"] == "distance to the group"


@pytest.mark.parametrize(
    ("more", "lost"),
    [
        ("", False),
        ('[[potential]]\nkind = "expression"\nU = "r1_z*cos(t)"\n', True),
        ('[[potential]]\nkind = "expression"\nU = "r1_z*cos(1)"\n', False),
        ("[[damping]]\ncoefficient = 1\n", True),
    ],
)
def test_what_makes_an_energy_change(more, lost, tmp_path):
    points = "".join(
        f"[[point]]\nmass = 1\nat = {at}\n" for at in ([1, 0, 0], [0, 1, 0], [0, 0, 1])
    )
    path = tmp_path / "three.toml"
    path.write_text(f'name = "three"\ngroup = "SO(3)"\n{points}{more}', encoding="utf-8")
    assert told(derive.derive(path).motion_page(1.0)).get("lost", False) == lost


@pytest.mark.parametrize("name", ["euler_top", "gyrostat", "top", "kovalevskaya_top"])
def test_a_path_is_said_to_be_on_the_ellipsoid_where_nothing_acts(name):
    caption = told(page(name))["words"]["polhode"]
    assert ("its path, the polhode, on" in caption) == (name == "euler_top")


# ---------------------------------------------------------------- the command


def test_the_command_writes_it_with_a_run_or_alone(tmp_path, capsys):
    page, out = tmp_path / "page.html", tmp_path / "run.csv"
    words = ["simulate", "top", "--t", "0.05", "--set", "zeta_3=100", "--html", str(page)]
    assert main(words) == 0
    assert capsys.readouterr().out == f"{page}\n"
    assert main([*words, "--out", str(out), "--lang", "fr"]) == 0
    assert out.exists()
    assert told(page.read_text(encoding="utf-8"))["comma"]


def test_notes_link_to_the_page_of_each_problem_in_each_language(tmp_path, capsys):
    """Notes in two languages have pages of their own."""

    def written(out, names, *more):
        words = ["notes", *names, "--motion", "5", "--out", str(tmp_path / out), *more]
        assert main(words) == 0
        shown = (tmp_path / out).read_text(encoding="utf-8")
        links = re.findall('<a href="([^#"]*)">(?:En mouvement|In motion)', shown)
        assert capsys.readouterr().out.split() == [str(tmp_path / x) for x in (out, *links)]
        return links, [(tmp_path / x).read_text(encoding="utf-8") for x in links]

    names = ("euler_top", "rod")
    english, (told_in_english,) = written("notes.html", names[:1])
    french, told_in_french = written("notes_fr.html", names, "--lang", "fr")
    assert english == ["notes_euler_top_motion.html"]
    assert french == [f"notes_fr_{x}_motion.html" for x in names]
    assert "comma" not in told(told_in_english)
    for name, text in zip(names, told_in_french, strict=True):
        assert told(text)["comma"]
        assert text == derived(name).motion_page(5.0, language="fr")


def test_every_definition_of_the_drawing_is_found_by_its_name():
    """A page has those that it needs, by their names: one that is not found is in none."""
    source = "".join(
        (folder("html") / "motion" / f"{x}.js").read_text(encoding="utf-8") for x in SCRIPTS
    )
    begun = re.findall(r"^(?:async )?(?:function|const|let) (\w+)", source, re.MULTILINE)
    found = [m[1] or m[2] for m in DEFINED.finditer(plain(source))]
    assert [x for x in begun if x not in found] == []
    assert not re.findall(r"^const \w+ = [^;({\[`]*, \w+ = ", source, re.MULTILINE)
