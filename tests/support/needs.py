"""What some tests need beside Python, make and a C compiler, and what brings it.

A test without it is left out by :func:`needs` or :func:`need`, and the end of a run says so in one
line. ``python -m tests.support.needs`` prints the packages of Debian that are missing here.
"""

import os
import re
import shutil
import subprocess
from collections.abc import Callable, Iterable
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import pytest

CC = next(filter(shutil.which, ("cc", "gcc", "clang")), "cc")
"""The C compiler, for what any of them will do."""

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
TEX = "texlive-latex-base texlive-latex-recommended texlive-latex-extra texlive-pictures lmodern"
PACKAGES = {
    "cc": "gcc libc6-dev",
    "gcc": "gcc",
    "g++": "g++",
    "clang": "clang",
    "clang++": "clang",
    "sanitizers of gcc": "gcc",
    "sanitizers of clang": "libclang-rt-dev",
    "clang-tidy": "clang-tidy",
    "cppcheck": "cppcheck",
    "ar": "binutils",
    "nm": "binutils",
    "objdump": "binutils",
    "arm-none-eabi-gcc": "gcc-arm-none-eabi libnewlib-arm-none-eabi",
    "qemu-arm": "qemu-user",
    "SUNDIALS": "libsundials-dev",
    "cmake": "cmake",
    "make": "make",
    "meson": "meson",
    "ninja": "ninja-build",
    "pkg-config": "pkg-config",
    "node": "nodejs",
    "npm": "npm",
    "rustc": "rustc-web",
    "Rust 2024": "rustc-web",
    "pdflatex": TEX,
    "the TeX of the lecture": f"{TEX} texlive-fonts-recommended texlive-lang-french",
    "pdftoppm": "poppler-utils",
    "chromium": "chromium",
    "git": "git",
    "faketime": "faketime",
    "the locale fr_FR": "locales",
}
"""What comes from Debian, and its packages."""

ELSEWHERE = {
    f"the module {module}": f"pip install {project}"
    for module, project in {
        "array_api_compat": "array-api-compat",
        "array_api_strict": "array-api-strict",
        "casadi": "casadi",
        "distributed": "distributed",
        "ipykernel": "ipykernel",
        "jax": "jax",
        "marimo": "marimo",
        "mujoco": "mujoco",
        "nbclient": "nbclient",
        "nbformat": "nbformat",
        "pinocchio": "pin",
        "playwright": "playwright",
        "scipy": "scipy",
        "sksundae": "scikit-sundae",
        "fmpy": "fmpy",
        "torch": "torch",
        "matplotlib": "matplotlib",
        "pyarrow": "pyarrow",
        "trimesh": "trimesh",
    }.items()
} | {"nvcc": "pip install nvidia-cuda-nvcc nvidia-cuda-runtime"}
"""What does not, and where it is to be had."""


def has_sanitizers(compiler: str) -> bool:
    """Whether this compiler is here, and links what finds wrong addresses."""
    if shutil.which(compiler) is None:
        return False
    command = [compiler, "-fsanitize=address,undefined", "-x", "c", "-", "-o", os.devnull]
    return not subprocess.run(command, input=b"int main(void){return 0;}", stderr=-3).returncode


def has_edition(year: str) -> bool:
    """Whether Rust is here and knows an edition."""
    command = ["rustc", f"--edition={year}", "--print=cfg"]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    return shutil.which("rustc") is not None and not subprocess.run(command, **quiet).returncode


def has_tex(*files: str) -> bool:
    """Whether LaTeX is here with these files of its own."""
    both = all(map(shutil.which, ("pdflatex", "kpsewhich")))
    commands = (["kpsewhich", x] for x in files)
    return both and not any(subprocess.run(x, stdout=-3).returncode for x in commands)


def has_nvcc() -> bool:
    """Whether the compiler of CUDA is on the path or in its Python package."""
    from derive.motion.native import nvcc  # which needs NumPy

    return nvcc() is not None


FOUND: dict[str, Callable[[], bool]] = {
    "cc": lambda: shutil.which(CC) is not None,
    "sanitizers of gcc": lambda: has_sanitizers("gcc"),
    "sanitizers of clang": lambda: has_sanitizers("clang"),
    "SUNDIALS": lambda: Path("/usr/include/cvode/cvode.h").is_file(),
    "chromium": lambda: any(map(shutil.which, BROWSERS)),
    "pdflatex": lambda: has_tex("tikz.sty"),
    "the TeX of the lecture": lambda: has_tex("tikz.sty", "french.ldf", "fplrc8a.pfb"),
    "nvcc": has_nvcc,
    "Rust 2024": lambda: has_edition("2024"),
    "the locale fr_FR": lambda: Path("/usr/share/i18n/locales/fr_FR").is_file(),
}
"""How to see what is not a program of that name."""


@cache
def present(name: str) -> bool:
    """Whether this is here."""
    if name not in PACKAGES and name not in ELSEWHERE:
        raise KeyError(f"{name}: tests/support/needs.py does not say what brings it")
    if name.startswith("the module "):
        return find_spec(name.removeprefix("the module ")) is not None
    return FOUND.get(name, lambda: shutil.which(name) is not None)()


def missing(names: Iterable[str]) -> list[str]:
    """Those that are not here."""
    return [name for name in names if not present(name)]


def reason(names: Iterable[str]) -> str:
    """Why a test is left out, for :func:`left_out` to read."""
    return f"needs {'; '.join(names)}"


def needs(*names: str) -> pytest.MarkDecorator:
    """The mark of a test that is left out where one of these is missing."""
    absent = missing(names)
    return pytest.mark.skipif(bool(absent), reason=reason(absent))


def need(*names: str) -> None:
    """Leave out the test that is running, or a whole module, where one of these is missing."""
    if absent := missing(names):
        pytest.skip(reason(absent), allow_module_level=True)


def left_out(reasons: list[str]) -> str:
    """The line about tests that were left out, by the reasons that pytest reports."""
    plain = [x.removeprefix("Skipped: ") for x in reasons]
    names = {name for x in plain if x.startswith("needs ") for name in x[6:].split("; ")}
    told = [f"{x} (Debian: {PACKAGES[x]})" for x in PACKAGES if x in names]
    told += [f"{x} ({ELSEWHERE[x]})" for x in ELSEWHERE if x in names]
    others = sorted({x for x in plain if not x.startswith("needs ")})
    why = [f"which need {', '.join(told)}"] if told else []
    why += [f"because {', '.join(others)}"] if others else []
    number = f"{len(reasons)} test{'s' * (len(reasons) != 1)}"
    return f"left out: {number}, {'; '.join(why)}" if why else ""


if __name__ == "__main__":
    print(*dict.fromkeys(re.findall(r"\S+", " ".join(PACKAGES[x] for x in missing(PACKAGES)))))
