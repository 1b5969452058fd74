"""A folder on 127.0.0.1, for this machine alone: ``python -m playground.serve DIR [PORT]``."""

import argparse
from contextlib import suppress
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path


class Handler(SimpleHTTPRequestHandler):
    """Files, without a line for each on the terminal."""

    def log_message(self, format: str, *args: object) -> None:
        """Say nothing."""


def server(folder: Path, port: int = 0) -> ThreadingHTTPServer:
    """A server of a folder at a port, or a free one."""
    return ThreadingHTTPServer(("127.0.0.1", port), partial(Handler, directory=str(folder)))


def main(folder: Path, port: int = 8000) -> None:
    """Serve until Ctrl-C."""
    try:
        serving = server(folder, port)
    except OSError:
        serving = server(folder)
    with serving:
        print(f"http://127.0.0.1:{serving.server_port}/play/  (Ctrl-C ends)", flush=True)
        with suppress(KeyboardInterrupt):
            serving.serve_forever()


if __name__ == "__main__":
    asked = argparse.ArgumentParser("python -m playground.serve", description=__doc__)
    asked.add_argument("folder", metavar="DIR", type=Path)
    asked.add_argument("port", metavar="PORT", type=int, nargs="?", default=8000)
    main(**vars(asked.parse_args()))
