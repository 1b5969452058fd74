"""The fluid on the torus: its vorticity at the last instant, the spectrum of enstrophy."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..language.suffixed import by_letter, letter_and_suffix
from ..motion.run import Array, Run
from .plot_sheet import COLOURS

ROUNDING = 1e-32
"""What the enstrophy of a mode is, relative, where its coefficient is nothing but rounding."""


def amplitudes(run: Run) -> tuple[Array, Array]:
    """The waves n, (count, 2), and ω_n at the last instant, of the columns re_n, im_n; ``m1``
    stands for −1."""
    names = [letter_and_suffix(x)[1] for x in by_letter(run.of_kind("state"))["re"]]
    waves = [[int(k.replace("m", "-")) for k in x.split("_")] for x in names]
    return np.array(waves), np.array([run[f"re_{x}"][-1] + 1j * run[f"im_{x}"][-1] for x in names])


def vorticity(figure: Any, run: Run, word: Any) -> None:
    """ω(x, y) = Σ ω_n e^{in·x}, with ω_−n the conjugate; the enstrophy Σ |ω_n|², its sum over the n
    whose |n| is nearest to each whole number, but for what is rounding alone."""
    waves, amplitude = amplitudes(run)
    grid = np.linspace(0, 2 * np.pi, 129)
    along = [np.exp(1j * np.outer(waves[:, k], grid)) for k in (0, 1)]
    field = 2 * np.einsum("n,nx,ny->yx", amplitude, *along).real
    left, right = figure.subplots(1, 2)
    most = float(np.abs(field).max()) or 1.0
    image = left.pcolormesh(grid, grid, field, cmap="RdBu_r", vmin=-most, vmax=most,
                            rasterized=True)  # fmt: skip
    left.set(aspect="equal", xlabel="$x$", ylabel="$y$", title=f"$t = {run.t[-1]:g}$")
    figure.colorbar(image, ax=left, label=word("vorticity"))
    shell = np.rint(np.hypot(*waves.T)).astype(int)
    spectrum = 2 * np.bincount(shell, np.abs(amplitude) ** 2)
    seen = np.flatnonzero(spectrum > ROUNDING * spectrum.max())
    right.loglog(seen, spectrum[seen], "o-", c=COLOURS[0], ms=3)
    right.set(xlabel="$|n|$", ylabel=word("enstrophy"))
