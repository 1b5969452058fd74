"""Calls a user's function at many states, in a process of its own: ``child.py FOLDER``.

Nothing of derive is imported: what the function does, to this process or to itself, ends here.
FOLDER has ``request.json`` and the arrays of ``given.npz``; ``found.npz`` or ``fault.txt``, one
line, is what is left there.
"""

from __future__ import annotations

import ctypes
import importlib.util
import json
import sys
import warnings
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

GUARD = 64
"""So many numbers behind an array are watched."""
UNTOUCHED = -1.234567890123e-300
"""What an array has where nothing has been written."""


class FaultError(Exception):
    """What is wrong with the function, in one line."""


def main(folder: Path) -> None:
    """Read the request, call, and leave the answer."""
    request = json.loads((folder / "request.json").read_text(encoding="utf-8"))
    given = dict(np.load(folder / "given.npz"))
    limit(request["seconds"], request["bytes"])
    try:
        found = {call["name"]: results(request, call, given) for call in request["calls"]}
        np.savez(folder / "found.npz", **found)  # type: ignore[arg-type]
    except FaultError as error:
        (folder / "fault.txt").write_text(" ".join(str(error).split()), encoding="utf-8")


def limit(seconds: int, size: int) -> None:
    """Limits of this process, before anything of the user's runs; of its threads together twice
    the time, which who has started it watches."""
    try:
        import resource
    except ImportError:  # Windows: the time alone
        return
    resource.setrlimit(resource.RLIMIT_AS, (size, size))
    resource.setrlimit(resource.RLIMIT_CPU, (2 * seconds, 2 * seconds))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def results(
    request: Mapping[str, Any], call: Mapping[str, Any], given: Mapping[str, Any]
) -> np.ndarray[Any, Any]:
    """What a function gives in each state, (states, size)."""
    at = in_c if request["path"].endswith(".so") else in_python
    evaluated = at(request["path"], call)
    rows = []
    for i in range(len(given["x"])):
        arguments = [np.array(given[a][i]) if a != "dx" else None for a in call["arguments"]]
        row = evaluated(arguments)
        if not np.isfinite(row).all():
            places = np.flatnonzero(~np.isfinite(row)).tolist()
            raise FaultError(f"{call['name']} gives a number that is not finite, at {places[:8]}")
        rows.append(row)
    return np.array(rows)


def in_python(path: str, call: Mapping[str, Any]) -> Callable[[Sequence[Any]], Any]:
    """A function of a module, which gives its result or writes it into an argument."""
    name, size = call["name"], call["size"]
    # the folder is the user's, and byte code of a file that is edited within a second is stale
    sys.dont_write_bytecode = True
    sys.path.insert(0, str(Path(path).parent))
    try:
        spec = importlib.util.spec_from_file_location(Path(path).stem, path)
        assert spec
        assert spec.loader
        module = importlib.util.module_from_spec(spec)
        sys.modules[spec.name] = module
        spec.loader.exec_module(module)
    except (Exception, SystemExit) as error:
        raise FaultError(f"importing it fails: {type(error).__name__}: {error}") from None
    if not callable(function := getattr(module, name, None)):
        raise FaultError(
            f"it has no function {name}; name it by --function, or 'call' in the table"
        )

    def evaluated(arguments: Sequence[Any]) -> Any:
        out = np.full(size, UNTOUCHED)
        try:
            with warnings.catch_warnings():
                if not call["returns"]:  # what is written into dx loses its imaginary part
                    warnings.simplefilter("error", np.exceptions.ComplexWarning)
                made = function(*(out if a is None else a[()] for a in arguments))
            found = _numbers(made if call["returns"] else out)
        except (Exception, SystemExit) as error:
            why = f"{name} fails: {type(error).__name__}: {error}"
            if "complex" in str(error):
                why = f"{name} gives complex numbers, and rates are real: give their real part"
                raise FaultError(why) from None
            if isinstance(error, TypeError):
                listed = ", ".join(call["arguments"])
                why += f"; it is called as {name}({listed}): 'call' in a table for --as says how"
            raise FaultError(why) from None
        if found.size != size:
            shape = f", an array {' × '.join(map(str, found.shape))}" * (found.ndim > 1)
            raise FaultError(f"{name} gives {found.size} numbers, not {size}{shape}")
        return _written(found.reshape(size), name)

    return evaluated


def _numbers(made: Any) -> Any:
    """What was made as one array: a column too, and numbers beside arrays of one."""
    try:
        found = np.asarray(made)
    except ValueError:
        found = np.concatenate([np.ravel(x) for x in made])
    if np.iscomplexobj(found):
        raise TypeError("complex")
    return found.astype(float)


def in_c(path: str, call: Mapping[str, Any]) -> Callable[[Sequence[Any]], Any]:
    """A function of a library: doubles and pointers to them, the result is written into dx."""
    name, size = call["name"], call["size"]
    try:
        function = getattr(ctypes.CDLL(path), name)
    except OSError as error:
        raise FaultError(f"it cannot be loaded: {error}") from None
    except AttributeError:
        raise FaultError(f"it has no function {name}") from None
    function.restype = None

    def evaluated(arguments: Sequence[Any]) -> Any:
        out = np.full(size + GUARD, UNTOUCHED)
        arrays = [out if a is None else np.append(a, np.zeros(GUARD)) for a in arguments]
        scalars = [a is not None and a.ndim == 0 for a in arguments]
        function(
            *(
                ctypes.c_double(a[0]) if scalar else ctypes.c_void_p(a.ctypes.data)
                for a, scalar in zip(arrays, scalars, strict=True)
            )
        )
        if (out[size:] != UNTOUCHED).any():
            raise FaultError(f"{name} writes more than {size} numbers")
        return _written(out[:size].copy(), name)

    return evaluated


def _written(found: Any, name: str) -> Any:
    if (found == UNTOUCHED).any():
        raise FaultError(f"{name} does not write {np.flatnonzero(found == UNTOUCHED).tolist()}")
    return found


if __name__ == "__main__":
    main(Path(sys.argv[1]))
