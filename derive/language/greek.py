"""Greek letters by their English names: LaTeX has these as commands, emitted names as words."""

from __future__ import annotations

import unicodedata

GREEK = {
    name: unicodedata.lookup(f"GREEK {case} LETTER {name.upper()}")
    for case, names in (
        ("SMALL", "alpha beta gamma delta epsilon zeta eta theta iota kappa mu nu xi pi rho "
         "sigma tau upsilon phi chi psi omega"),
        ("CAPITAL", "Gamma Delta Theta Xi Pi Sigma Upsilon Phi Psi Omega"),
    )
    for name in names.split()
}  # fmt: skip
"""Name → letter; without λ: no parameter is called as a word of Python is."""

SPELT = {letter: name for name, letter in GREEK.items()} | {"λ": "lambda", "Λ": "Lambda"}
"""Letter → name."""
