"""What is wrong in a file of one's own: one line that names the file, the key, the remedy."""

import os
import resource
import subprocess
import sys

import pytest

from derive.command.cli import main

TOP = 'name = "top"\ngroup = "SO(3)"\n'
TWO = TOP + "[[point]]\nmass = 1\nat = [1, 0, 0]\n[[point]]\nmass = 1\nat = [0, 1, 0]\n"
U = TWO + '[[potential]]\nkind = "expression"\nU = '
OWN = 'name = "own"\n[[point]]\nmass = 1\nat = [1, 0]\n[group]\nname = "Own"\nbasis = '

FILES = {
    "unknown function": (U + '"sinn(r1_x)"', "unknown function 'sinn'"),
    "point that is not there": (U + '"r9_x"', "the points are r1 … r2"),
    "coordinate that is not there": (U + '"r1_4"', "point 1 has 3 coordinates"),
    "code": (U + "\"__import__('os')\"", "not part of an expression"),
    "half an expression": (U + '"sqrt(r1_x"', "not closed"),
    "kind": (TWO + '[[potential]]\nkind = "sprung"', "must be one of gravity, spring"),
    "no stiffness": (TWO + '[[potential]]\nkind = "spring"\nbetween = [1, 2]', "'stiffness'"),
    "no end": (TWO + '[[potential]]\nkind = "spring"\nstiffness = 1\non = 1', "'anchor'"),
    "misspelt table": (TWO + '[[potentail]]\nkind = "spring"', "did you mean 'potential'?"),
    "unused parameter": (TWO + "[parameters]\nq = 1", "'q' is declared but not used"),
    "damping": (TWO + "[[damping]]\ncoefficient = 1\non = [1, 1]", "names a point twice"),
    "force on nothing": (TWO + '[[input]]\nname = "F"\nkind = "force"\non = 7', "from 1 to 2"),
    "frame": (TWO + '[[input]]\nname = "F"\nkind = "force"\non = 1\nframe = "b"', "space, body"),
    "two covectors": (
        TWO + '[[input]]\nname = "u"\nkind = "covector"\n[[input]]\nname = "v"\nkind = "covector"',
        "one covector",
    ),
    "a group of no dimension": (TOP.replace("SO(3)", "SL(1)"), "group"),
    "a short vector": (TOP + "[[point]]\nmass = 1\nat = [1, 0]", "point 1"),
    "a name that is a number": (TWO.replace('"top"', '"4"'), "name"),
    "no mass": (TOP + "[[point]]\nat = [1, 0, 0]", "mass"),
    "a truth as mass": (TOP + "[[point]]\nmass = true\nat = [1, 0, 0]", "point 1"),
    "a spring to nothing": (
        TWO + '[[potential]]\nkind = "spring"\nstiffness = 1\nbetween = [1, 3]',
        "between",
    ),
    "a spring to itself": (
        TWO + '[[potential]]\nkind = "spring"\nstiffness = 1\nbetween = [1, 1]',
        "between",
    ),
    "negative mass": (TOP + "[[point]]\nmass = -1\nat = [1, 0, 0]", "--allow-negative-mass"),
    "keyword of Python": (TWO + "[parameters]\nlambda = 1", "'lambda' is a keyword of Python"),
    "keyword of C": (TWO + "[parameters]\ndouble = 1", "'double' is a keyword of C"),
    "name of math.h": (TWO + "[parameters]\ncosf = 1", "'cosf' is a name of C's math.h"),
    "keyword as input": (
        TWO + '[[input]]\nname = "class"\nkind = "force"\non = 1',
        "input 1, name: 'class' is a keyword",
    ),
    "keyword as name": ('name = "while"\n' + TWO.partition("\n")[2], "'while' is a keyword"),
    "not closed": (OWN + "[[[0, 1], [0, 0]], [[0, 0], [1, 0]]]", "[[1, 0], [0, -1]]"),
    "dependent": (OWN + "[[[0, 1], [0, 0]], [[0, 2], [0, 0]]]", "element 2 of the basis depends"),
    "not square": (OWN + "[[[0, 1]]]", "not a 1 × 1 matrix"),
    "not rational": (OWN + '[[[0, "pi"], [0, 0]]]', "rational numbers"),
    "empty basis": (OWN + "[]", "empty"),
    "radius": (TOP + '[body]\nsolid = "ball"\ndensity = 1\nradius = -1', "not positive"),
    "no radius": (TOP + '[body]\nsolid = "ball"\ndensity = 1', "'radius' is missing"),
    "mesh outside": (
        TOP + '[body]\nsolid = "mesh"\ndensity = 1\nfile = "../x.stl"',
        "outside the folder",
    ),
    "no mesh": (TOP + '[body]\nsolid = "mesh"\ndensity = 1\nfile = "x.stl"', "x.stl"),
    "skew moments": (
        TOP + "[body]\ngiven = { m = 1, c = [0, 0, 0], J = [[1, 2, 0], [0, 1, 0], [0, 0, 1]] }",
        "symmetric",
    ),
    "no rotation": (
        TOP + '[body]\nsolid = "ball"\ndensity = 1\nradius = 1\n'
        "rotation = [[1, 1, 0], [0, 1, 0], [0, 0, 1]]",
        "not orthogonal",
    ),
    "reflection": (
        TOP + '[body]\nsolid = "ball"\ndensity = 1\nradius = 1\n'
        "rotation = [[-1, 0, 0], [0, 1, 0], [0, 0, 1]]",
        "a reflection",
    ),
    "moments of no masses": (
        TOP + "[body]\ngiven = { m = 1, c = [10, 0, 0], J = [[1, 0, 0], [0, 1, 0], [0, 0, 1]] }",
        "no masses have these moments",
    ),
    "two inputs of one name": (
        TWO + 2 * '[[input]]\nname = "F"\nkind = "force"\non = 1\n',
        "input 2: a second input 'F'",
    ),
    "input named as a parameter": (
        TWO + '[parameters]\nF = 1\n[[input]]\nname = "F"\nkind = "force"\non = 1',
        "'F' is a parameter as well",
    ),
    "a number of an input named as a parameter": (
        TWO + '[parameters]\nF_2 = 1\n[[input]]\nname = "F"\nkind = "force"\non = 1',
        "'F_2' is one of its numbers, and a parameter as well",
    ),
    "a number of the state named as a parameter": (
        TWO + '[parameters]\nzeta_3 = 1\n[[damping]]\ncoefficient = "zeta_3"',
        "parameter 'zeta_3': a number of the state; choose another name",
    ),
    "a number of an input named as one of the state": (
        TWO.replace("SO", "SE") + '[[input]]\nname = "w"\nkind = "force"\non = 1',
        "input 1, 'w': 'w_1' is one of its numbers, and of the state as well; choose another name",
    ),
    "a number of an input named as one of the state in a Lagrangian": (
        TOP + "[inertia]\noperator = [[1, 0, 0], [0, 2, 0], [0, 0, 3]]\n"
        '[[input]]\nname = "zeta"\nkind = "covector"',
        "'zeta_1' is one of its numbers, and of the state as well",
    ),
    "parameter t": (TWO + "[parameters]\nt = 1", "this is the time"),
    "parameter r1_x": (TWO + "[parameters]\nr1_x = 1", "a place of a point"),
    "time in a mass": (
        U.replace("mass = 1", 'mass = "t"', 1) + '"t*r1_x"',
        "point 1, key 'mass': 't' is known in the 'U'",
    ),
    "not declared": (
        TWO + '[parameters]\nkappa = 1\n[[potential]]\nkind = "gravity"\ng = [0, "kapa*kappa", 0]',
        "potential 1, key 'g': 'kapa' is not declared; did you mean 'kappa'?",
    ),
    "not declared in a body": (
        TOP + '[body]\nsolid = "ball"\ndensity = 1\nradius = "R"',
        "body, key 'radius': 'R' is not declared; add it to [parameters]",
    ),
    "no gravity": (TWO + '[[potential]]\nkind = "gravity"', "potential 1: key 'g' is missing"),
    "decimals with a comma": (U + '"9,81*r1_x"', "decimals have a point, as 0.5"),
    "a unit": (U + '"9.81 N"', "units stand in [parameters] alone"),
    "name of the general text": (TWO.replace('"top"', '"linear"'), "'linear' names what is said"),
    "solid and moments": (
        TOP + '[body]\nmoments = "symbolic"\nsolid = "ball"\ndensity = 1\nradius = 1',
        "body: give either 'solid' or 'moments'",
    ),
    "solid without a table of its own": (
        TOP + '[body]\nsolid = "ball"\nradius = 1\nmass = 2',
        "body: unknown key 'mass'",
    ),
    "one table for a list": (
        TWO + '[potential]\nkind = "gravity"\n[[potential]]\nkind = "gravity"',
        "a list of tables is written [[…]]",
    ),
    "an accent": (TWO + "[parameters]\né = 1", "names have the letters A to Z, a to z"),
    "not declared in U": (U + '"R*r1_x"', "potential 1, key 'U': 'R' is not declared"),
    "infinite default": (TWO + "[parameters]\nk = inf", "finite"),
    "no damped point": (TWO + "[[damping]]\ncoefficient = 1\non = []", "list of points"),
    "hole outside": (
        TOP + '[body]\nsolid = "hollow_ball"\ndensity = 1\nouter = 1\ninner = -1',
        "inner: a length that is not positive",
    ),
    "negative sides": (
        TOP + '[body]\nsolid = "box"\ndensity = 1\nsides = [-1, -1, 1]',
        "sides: a length that is not positive",
    ),
    "negative by pi": (TOP + '[body]\nsolid = "ball"\ndensity = -1\nradius = 1', "negative"),
    "negative by default": (
        TOP + '[parameters]\nm = -2\n[[point]]\nmass = "m"\nat = [1, 0, 0]',
        "point 1: key 'mass' is negative",
    ),
    "power": (U + '"r1_x**2"', "a power is written ^"),
    "factor": (U + '"2r1_x"', "a product needs a *"),
    "zero in a basis": (OWN + "[[[0, 0], [0, 0]]]", "element 1 of the basis is zero"),
    "group with a letter": (TOP.replace("SO(3)", "SO(x)"), "unknown group 'SO(x)'"),
    "half a product": (TOP.replace("SO(3)", "SO(3) x"), "unknown group 'SO(3) x'"),
    "zero below": (U + '"1/((r1_x + r2_y)^2 - r1_x^2 - r2_y^2 - 2*r1_x*r2_y)"', "division by zero"),
    "root of nothing": (U + '"sqrt(r1_x - r1_x)"', "division by zero"),
    "point with a zero": (U + '"r01_x"', "a place in space is r1_x"),
    "no place to be at": (U + '"r0_x"', "the points are r1 … r2"),
    "place of another name": (U + '"r1_w"', "r1_1, r1_2"),
    "block": (
        'name = "two"\ngroup = "SO(3) x SO(3)"\n[[point]]\nmass = 1\nat = [1, 0, 0]\nblock = 3',
        "from 1 to 2",
    ),
    "product too large": ('name = "two"\ngroup = "SO(8) x SO(8)"', "at most 12"),
    "odd": ('name = "p"\ngroup = "Sp(3)"', "even"),
}


@pytest.mark.parametrize("case", FILES)
def test_one_line(case, tmp_path, capsys):
    text, says = FILES[case]
    path = tmp_path / "bad.toml"
    path.write_text(text + "\n", encoding="utf-8")
    assert main(["walk", str(path)]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    assert err.startswith(f"derive: {path}: ")
    assert says in err


FOUR = "[[point]]\nmass = 1\nat = [1, 0, 0, 0]\n"
LINE = "[[point]]\nmass = 1\nat = [1, 2, 3]\n[[point]]\nmass = 1\nat = [1, 2, 5]\n"

SINGULAR = {
    "aligned": (
        TOP + "[[point]]\nmass = 1\nat = [1, 0, 0]\n[[point]]\nmass = 1\nat = [2, 0, 0]\n",
        "turning about the axis (1, 0, 0) moves no mass",
    ),
    "aligned in space": (
        'name = "p2"\ngroup = "SE(3)"\n' + LINE,
        "the axis through (1, 2, 0) along (0, 0, 1) moves no mass",
    ),
    "aligned whatever a and b": (
        TOP + '[[point]]\nmass = 1\nat = ["a", "b", 0]\n[parameters]\na = 1\nb = 1\n',
        "the axis (2, 3, 0) (at a = 2, b = 3) moves no mass",
    ),
    "coplanar": (TWO.replace("SO(3)", "GL(3)"), "Z = [[0, 0, 1], [0, 0, 0], [0, 0, 0]]"),
    "coplanar for SL": (TWO.replace("SO(3)", "SL(3)"), "Z = [[0, 0, 1], [0, 0, 0], [0, 0, 0]]"),
    "a line in four dimensions": ('name = "p4"\ngroup = "SO(4)"\n' + FOUR, "moves no mass"),
    "one point for Sp": ('name = "p4"\ngroup = "Sp(4)"\n' + FOUR, "moves no mass"),
    "one point for SE": (
        'name = "p2"\ngroup = "SE(2)"\n[[point]]\nmass = 1\nat = [1, 0]\n',
        "Z = [[0, -1, 0], [1, 0, -1], [0, 0, 0]]",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", SINGULAR)
@pytest.mark.parametrize("command", [["walk"], ["emit", "--out", "out"]], ids=["walk", "emit"])
def test_a_direction_without_inertia(case, command, tmp_path, capsys, monkeypatch):
    text, says = SINGULAR[case]
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bad.toml").write_text(text, encoding="utf-8")
    assert main([command[0], "bad.toml", *command[1:]]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("derive: bad.toml: ")
    assert says in err
    assert not (tmp_path / "out").exists()


def test_negative_mass_allowed(tmp_path, capsys):
    path = tmp_path / "top.toml"
    path.write_text(
        TOP + "[[point]]\nmass = -1\nat = [1, 0, 0]\n[[point]]\nmass = 3\nat = [2, 1, 0]\n"
    )
    assert main(["check", str(path), "--allow-negative-mass"]) == 0
    out, err = capsys.readouterr()
    assert "steps hold exactly" in out
    assert err == f"derive: warning: {path}: point 1: key 'mass' is negative\n"


HOSTILE = {
    "long": U + '"' + "1+" * 500_000 + '1"',
    "nested": U + '"' + "(" * 10_000 + "1" + ")" * 10_000 + '"',
    "powers": U + '"9^9^9^9"',
    "large power": U + '"(r1_x+1)^9^9"',
    "import": U + "\"__import__('os').system('true')\"",
    "nested arrays": TOP + "x = " + "[" * 100_000,
    "points": TOP + "[[point]]\nmass = 1\nat = [1, 0, 0]\n" * 30_000,
    "basis": 'name = "b"\n[group]\nname = "B"\nbasis = [' + "[[1]]," * 100_000 + "]",
    "mesh": TOP + '[body]\nsolid = "mesh"\ndensity = 1\nfile = "hole.off"\n',
}


def holed_sphere():
    """An OFF file of nearly the largest size, a grid on a sphere that lacks one triangle."""
    n = 141
    grid = [(i, j) for i in range(n) for j in range(n)]
    points = [f"{i} {j} {(i * j) % 7}" for i, j in grid]
    corners = [(i * n + j, i * n + j + 1, (i + 1) * n + j) for i, j in grid if max(i, j) < n - 1]
    faces = [f"3 {a} {b} {c}\n3 {b} {c + 1} {c}" for a, b, c in corners]
    count = 2 * len(faces)
    return "\n".join([f"OFF\n{len(points)} {count} 0", *points, *faces, ""])


@pytest.mark.parametrize("case", HOSTILE)
def test_hostile_files_cost_little(case, tmp_path):
    """One line, in a process of 500 MB; processor time, as the machine may be busy."""
    path = tmp_path / "bad.toml"
    path.write_text(HOSTILE[case], encoding="utf-8")
    if case == "mesh":
        (tmp_path / "hole.off").write_text(holed_sphere())
    limited = "import resource; resource.setrlimit(resource.RLIMIT_DATA, (500 << 20,) * 2);"
    limited += "from derive.command.cli import main; import sys; sys.exit(main(sys.argv[1:]))"
    command = [sys.executable, "-c", limited, "walk", str(path)]
    environment = os.environ | {"OPENBLAS_NUM_THREADS": "1"}
    start = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = subprocess.run(command, capture_output=True, text=True, env=environment)
    assert done.returncode == 2, done.stderr[-300:]
    assert done.stderr.count("\n") == 1
    assert len(done.stderr) < 500
    assert done.stdout == ""
    assert resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - start < 2 * SLACK


SLACK = 1.5
"""A busy machine is slower; by itself each case takes below 2 s."""
