"""Run where the site is built, by the very Python that runs it: what the browser loads, compiled,
in parts as .tar.gz, the same bytes on any day.

``first``: what a walk needs, found by walking every ready-made problem; ``rest``: the other modules
of the package; then the libraries that little asks for, each by its name.
"""

import ast
import compileall
import gzip
import io
import os
import re
import sys
import tarfile
import zipfile
from importlib._bootstrap_external import _code_to_hash_pyc
from pathlib import Path
from py_compile import PycInvalidationMode

FIRST, LATER = Path("/first"), Path("/later")
NEEDED = (
    "derive/templates/html/",
    "derive/problems/",
    "derive/record/prose/",
    "derive/schema/",
    "derive/views/",
    "amendments.pickle",
)
"""Of files that are no modules, those that a walk reads."""
LEFT_OUT = re.compile(
    r"(unittest|xml|xmlrpc|_pyrepl|multiprocessing|pydoc_data|ensurepip|idlelib|lib2to3|wsgiref|email"
    r"|http|ctypes|sqlite3|curses|dbm|tkinter|turtledemo|venv|test|profiling|distutils)/"
    r"|encodings/(?!(__init__|aliases|utf_8|utf_8_sig|utf_16|utf_32|ascii|latin_1|cp437|idna|charmap"
    r"|raw_unicode_escape|unicode_escape)\.py)"
    r"|(pdb|bdb|doctest|pydoc|turtle|smtplib|ftplib|imaplib|poplib|cProfile|pstats|mailbox|ssl|uuid"
    r"|webbrowser|tracemalloc|trace|cgi|cgitb|pickletools|_pyio|antigravity|this|optparse|wave"
    r"|configparser|statistics|plistlib|modulefinder|mimetypes|_strptime)\.py"
)


def undocumented(path: Path) -> None:
    """Take the docstrings out of a module, but where a program reads them."""
    if "command" in path.parts:
        return
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for x in ast.walk(tree):
        if isinstance(x, ast.Module | ast.FunctionDef | ast.AsyncFunctionDef):
            x.body = [y for y in x.body if not is_text(y)] or [ast.Pass()]
        elif isinstance(x, ast.ClassDef):  # a dataclass without one would make its own
            x.body = [ast.Expr(ast.Constant("-")), *(y for y in x.body if not is_text(y))]
    path.write_text(ast.unparse(ast.fix_missing_locations(tree)), encoding="utf-8")


def is_text(x: ast.stmt) -> bool:
    """Is it a string that says what it stands in, or behind?"""
    constant = isinstance(x, ast.Expr) and isinstance(x.value, ast.Constant)
    return constant and isinstance(x.value.value, str)


READ = re.compile("routines/algorithms/")
"""Sources that are read as text, and are never run."""


def compiled(folder: Path, optimize: int = 0) -> None:
    """The modules of a folder as code, beside what else there is; ``optimize``: as Python's option
    -O or -OO has it, which then takes the docstrings out."""
    modules = [x for x in sorted(folder.rglob("*.py")) if not READ.search(str(x))]
    for path in modules if not optimize else ():
        undocumented(path)
    os.chdir(folder)
    chosen = {"legacy": True, "optimize": optimize, "rx": READ}
    mode = PycInvalidationMode.UNCHECKED_HASH
    assert compileall.compile_dir(".", quiet=1, invalidation_mode=mode, **chosen)
    for path in modules:
        path.unlink()


def walked() -> set[str]:
    """The files that walks load."""
    sys.path.insert(0, str(FIRST))
    import play

    own = play.Play(lambda kind, news: None)
    for path in sorted((FIRST / "derive" / "problems").glob("*.toml")):
        own.walk(path.read_text(encoding="utf-8"), "fr")
        assert own.record is not None, path
    places = (getattr(x, "__file__", None) for x in [*sys.modules.values()])
    return {str(Path(x).relative_to(FIRST)) for x in places if x and x.startswith(f"{FIRST}/")}


def packed(folder: Path, names: list[str]) -> bytes:
    """Some files of a folder."""
    tar = io.BytesIO()
    with tarfile.open(fileobj=tar, mode="w", format=tarfile.USTAR_FORMAT) as archive:
        for name in names:
            content = (folder / name).read_bytes()
            about = tarfile.TarInfo(name)
            about.size = len(content)
            archive.addfile(about, io.BytesIO(content))
    return gzip.compress(tar.getvalue(), 9, mtime=0)


def listed(folder: Path) -> list[str]:
    """The files of a folder, without what running it left."""
    found = (x.relative_to(folder) for x in folder.rglob("*") if x.is_file())
    return sorted(str(x) for x in found if "__pycache__" not in x.parts)


def with_ctypes(folder: Path) -> None:
    """The package ctypes of the standard library, which :func:`library` leaves out, beside the
    library that asks for the sizes of numbers in C."""
    with zipfile.ZipFile(standard()) as source:
        source.extractall(folder, [f"ctypes/{x}.py" for x in ("__init__", "_endian")])


def standard() -> str:
    """The place of the standard library that Pyodide brings."""
    (place,) = [x for x in sys.path if x.endswith(".zip")]
    return place


def library() -> bytes:
    """The standard library that Pyodide brings, compiled as by ``python -OO``, without what no
    program asks for that has no terminal, no processes and no network."""
    out = io.BytesIO()
    with zipfile.ZipFile(standard()) as source, zipfile.ZipFile(out, "w") as target:
        for name in sorted(source.namelist()):
            if name.endswith("/") or LEFT_OUT.match(name):
                continue
            content = source.read(name)
            if name.endswith(".py"):
                code = compile(content, name, "exec", dont_inherit=True, optimize=2)
                name, content = f"{name}c", _code_to_hash_pyc(code, bytes(8), checked=False)
            target.writestr(zipfile.ZipInfo(name), content, zipfile.ZIP_DEFLATED, 9)
    return out.getvalue()


def packs() -> dict[str, bytes]:
    """Name → bytes, of the parts."""
    sys.dont_write_bytecode = True
    compiled(FIRST)
    later = sorted(LATER.iterdir())
    with_ctypes(LATER / "sympy")
    for folder in later:
        compiled(folder, 2)
    needed = walked()
    every = listed(FIRST)
    first = [x for x in every if x in needed or (x.startswith(NEEDED) and not x.endswith(".pyc"))]
    rest = [x for x in every if x not in {*first}]
    return {
        "first": packed(FIRST, first),
        "rest": packed(FIRST, rest),
        **{folder.name: packed(folder, listed(folder)) for folder in later},
        "library": library(),
    }


packs()
