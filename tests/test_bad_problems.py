"""What is wrong in a file of one's own: one line that names the file, the key, the remedy."""

import pytest

from derive.cli import main

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
    "negative mass": (TOP + "[[point]]\nmass = -1\nat = [1, 0, 0]", "negative"),
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

SINGULAR = {
    "aligned": TOP + "[[point]]\nmass = 1\nat = [1, 0, 0]\n[[point]]\nmass = 1\nat = [2, 0, 0]\n",
    "coplanar": TWO.replace("SO(3)", "GL(3)"),
    "coplanar for SL": TWO.replace("SO(3)", "SL(3)"),
    "a line in four dimensions": 'name = "p4"\ngroup = "SO(4)"\n' + FOUR,
    "one point for Sp": 'name = "p4"\ngroup = "Sp(4)"\n' + FOUR,
    "one point for SE": 'name = "p2"\ngroup = "SE(2)"\n[[point]]\nmass = 1\nat = [1, 0]\n',
}  # fmt: skip


@pytest.mark.parametrize("case", SINGULAR)
def test_a_direction_without_inertia(case, tmp_path, capsys):
    path = tmp_path / "bad.toml"
    path.write_text(SINGULAR[case], encoding="utf-8")
    assert main(["emit", str(path), "--out", str(tmp_path / "out")]) == 2
    assert "moves no mass" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()
