"""The playground as a static folder, ``build/site/play``, made anew where the tree is another.

``python -m playground.site [--serve]``
"""

import argparse
import hashlib
import subprocess
import sys
from contextlib import suppress
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

ROOT = Path(__file__).parents[1]
OWN, SITE = ROOT / "playground", ROOT / "build" / "site" / "play"
STAMP = ROOT / "build" / "playground" / "stamp"
SOURCES = ("derive", "templates", "playground")


def signature() -> str:
    """The hash of all that the playground is made of."""
    made = hashlib.sha256()
    for folder in SOURCES:
        for path in sorted((ROOT / folder).rglob("*")):
            parts = {"node_modules", "__pycache__"} & {*path.parts}
            if path.is_file() and not parts:
                made.update(str(path.relative_to(ROOT)).encode() + path.read_bytes())
    return made.hexdigest()


def built() -> Path:
    """The folder of the playground as it is now; one process builds it."""
    import fcntl

    STAMP.parent.mkdir(parents=True, exist_ok=True)
    with STAMP.with_suffix(".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        now = signature()
        if not (STAMP.is_file() and STAMP.read_text() == now and SITE.is_dir()):
            if not (OWN / "node_modules").is_dir():
                command = ["npm", "ci", "--no-audit", "--no-fund"]
                subprocess.run(command, cwd=OWN, check=True, capture_output=True)
            stage = STAMP.with_name("stage")
            subprocess.run([sys.executable, "-m", "playground.stage", stage], cwd=ROOT, check=True)
            subprocess.run(["node", OWN / "build.mjs", stage, SITE], cwd=ROOT, check=True)
            STAMP.write_text(now)
    return SITE


class Handler(SimpleHTTPRequestHandler):
    """Files, without a line for each on the terminal."""

    def log_message(self, format: str, *args: object) -> None:
        """Say nothing."""


def server(folder: Path, port: int = 0) -> ThreadingHTTPServer:
    """A server of a folder at a port, or a free one."""
    return ThreadingHTTPServer(("127.0.0.1", port), partial(Handler, directory=str(folder)))


def serve(port: int = 8000) -> None:
    """Serve it, beside the documentation where that is there, until Ctrl-C."""
    folder = built().parent
    try:
        serving = server(folder, port)
    except OSError:
        serving = server(folder)
    with serving:
        print(f"http://127.0.0.1:{serving.server_port}/play/  (Ctrl-C ends)", flush=True)
        with suppress(KeyboardInterrupt):
            serving.serve_forever()


if __name__ == "__main__":
    asked = argparse.ArgumentParser("python -m playground.site", description=__doc__)
    asked.add_argument("--serve", action="store_true", help="on 127.0.0.1, for this machine alone")
    (serve if asked.parse_args().serve else built)()
