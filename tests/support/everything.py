"""All that derive writes, into one folder: tests/project/test_dist.py runs it everywhere.

    python everything.py FOLDER [pdf] [checked]

With the notes as a PDF, and with a record that is checked: each takes as long as much of the rest.
It needs nothing but derive, which may be installed or beside it, and prints where derive is.
"""

import contextlib
import functools
import io
import os
import sys

WALKS = {"so3": ("en", "fr"), "se3": ("en", "fr"), "two_tops": ("en",), "affine": ("en",)}
FORMS = {
    "plain": ["so3", "se3", "sl3", "saff3", "comet", "top", "two_tops"],
    "principal": ["so3", "saff3"],
}


def commands(further):
    """The arguments of every run, and the file for its output."""
    from derive.code.languages import LANGUAGES
    from derive.views.rendering import FORMATS

    able = [name for name, x in LANGUAGES.items() if x.framed and name != "cvode"]
    yield "list", ["list"]
    yield "build", ["build", "--print"]
    yield "symmetries", ["symmetries", "se3", "--format", "json"]
    for name, languages in WALKS.items():
        for form in FORMATS:
            for lang in languages if form != "json" else ("en",):
                yield f"{name}.{lang}.{form}", ["walk", name, "--format", form, "--lang", lang]
    for form, names in FORMS.items():
        for name in names:
            written = LANGUAGES if form == "plain" else able
            chosen = [x for each in written for x in ("--lang", each)]
            chosen += ["--jacobian", "state"] if form == "plain" else ["--frame", form]
            out = f"{form}/{name}"
            yield f"{form}.{name}.emitted", ["emit", name, *chosen, "--out", out]
    yield "quaternion", ["emit", "se3", "--attitude", "quaternion", "--layout", "row", "--out", "q"]
    yield "tangent", ["emit", "sl3", "--velocity", "tangent", "--real", "float", "--out", "t"]
    if "checked" in further:
        yield "checked", ["check", "heisenberg", "--seed", "20"]
    for end in (".tex", ".html", *([".pdf"] if "pdf" in further else [])):
        yield f"notes{end}.told", ["notes", "so3", "sl3", "--out", f"notes{end}"]
    yield "paper", ["paper", "--format", "json"]


def main(folder, *further):
    """Run all of them there."""
    import derive
    from derive.command import showing

    showing.derive = functools.cache(showing.derive)  # one walk for all that is made of it
    from derive.command import cli

    os.makedirs(folder, exist_ok=True)
    os.chdir(folder)
    for name, arguments in commands(further):
        text = io.StringIO()
        with contextlib.redirect_stdout(text):
            status = cli.main(arguments)
        assert status == 0, arguments
        with open(f"{name}.out", "w", encoding="utf-8", newline="") as stream:
            stream.write(text.getvalue())
    print(os.path.dirname(derive.__file__))


if __name__ == "__main__":
    main(*sys.argv[1:])
