"""The discrete road: its steps make the action stationary, and its notes are of it alone."""

import re
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from derive.check.checker import check
from derive.command.cli import main
from derive.views.rendering import render
from tests.support.corpus import record
from tests.support.walks import SEED

NAMES = ("so3", "se3", "sl3", "gl3", "saff3")


def test_a_discrete_record_holds_but_not_without_its_mark():
    d = record("discrete top")
    assert all(v.holds for v in check(d, SEED))
    plain = replace(d, problem={k: x for k, x in d.problem.items() if k != "discrete"})
    assert not all(v.holds for v in check(plain, SEED))


def points(seed):
    """Masses, places, h, and two rotations: numbers that share no code with derive."""
    random = np.random.default_rng(seed)
    turn = [np.linalg.qr(np.eye(3) + 0.1 * random.standard_normal((3, 3)))[0] for _ in range(2)]
    turn = [q @ np.diag(np.sign(np.diag(q))) for q in turn]
    return random.uniform(1, 2, 5), random.standard_normal((5, 3)), 0.05, turn


def action(m, r, h, elements):
    """The discrete action of free points: a sum over the points, nothing else."""
    pairs = pairwise(elements)
    return sum(m @ np.sum((r @ (b - a).T) ** 2, axis=1) / (2 * h) for a, b in pairs)


def hat(x):
    return np.array([[0, -x[2], x[1]], [x[2], 0, -x[0]], [-x[1], x[0], 0]])


def test_steps_of_moser_and_veselov_make_the_action_stationary():
    """W₁ from the momentum that the step of the record carries on, by Newton; then δ of the sum
    over the points, by complex steps."""
    m, r, h, (g_0, g_1) = points(1)
    J = r.T @ (m[:, None] * r)
    W = g_0.T @ g_1
    M = W.T @ ((W @ J - J @ W.T) / h) @ W
    V, basis = W.copy(), [hat(e) for e in np.eye(3)]
    for _ in range(30):
        rest = (V @ J - J @ V.T) / h - M
        slopes = [(V @ e @ J - J @ (V @ e).T) / h for e in basis]
        rows = np.array([[s[i, j] for s in slopes] for i, j in ((2, 1), (0, 2), (1, 0))])
        x = np.linalg.solve(rows, [-rest[2, 1], -rest[0, 2], -rest[1, 0]])
        u = hat(x) / 2  # Cayley's transform keeps the group
        V = V @ np.linalg.solve(np.eye(3) - u, np.eye(3) + u)
    g_2 = g_1 @ V
    assert np.abs(g_2.T @ g_2 - np.eye(3)).max() < 1e-13
    scale = action(m, r, h, [g_0, g_1])
    for e in basis:
        varied = action(m, r, h, [g_0, g_1 + 1e-20j * g_1 @ e, g_2])
        assert abs(varied.imag / 1e-20) < 1e-11 * scale
    space = [a @ ((a.T @ b @ J - J @ b.T @ a) / h) @ a.T for a, b in ((g_0, g_1), (g_1, g_2))]
    assert np.abs(space[0] - space[1]).max() < 1e-11 * scale


@pytest.mark.parametrize("name", NAMES)
def test_no_letter_is_lost_in_latex(name):
    for lang in ("en", "fr"):
        shown = render(record(f"discrete {name}"), "latex", lang)
        assert "?" not in re.sub(r"solides(~|\\,| |\\thinspace)*\?", "", shown)


@pytest.mark.parametrize("lang", ["en", "fr"])
def test_notes_are_of_discrete_motions(tmp_path, lang):
    """Of both actions in one text, each step once."""
    for end in (".tex", ".html"):
        out = tmp_path / f"notes{end}"
        assert main(["notes", "so3", "se3", "--discrete", "--lang", lang, "--out", str(out)]) == 0
        text = out.read_text(encoding="utf-8")
        label = r"\label{{{}}}" if end == ".tex" else 'id="{}"'
        for step in ("discrete.balance", "discrete_affine.blocks", "so3.turning", "se3.centre"):
            assert text.count(label.format(step)) == 1
        assert r"\Theta^" not in re.sub(r'data-tex="[^"]*"', "", text) or end == ".tex"
