"""``python -m derive``, and the command ``derive``: the command line as a process of its own."""

from __future__ import annotations

import os
import signal
import sys
from types import FrameType
from typing import Any

INTERRUPTED = 130


def main() -> int:
    """Run the command line; when it is interrupted, quietly exit 130, also in the imports."""
    if signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        from .command.cli import main as run  # who started us has it ignored, or handles it

        return run()
    asked = []

    def heed(number: int, frame: FrameType | None) -> None:
        asked.append(number)
        raise KeyboardInterrupt

    def unraisable(told: Any) -> None:
        """In a callback of the interpreter, which would go on."""
        if asked:
            os._exit(INTERRUPTED)
        sys.__unraisablehook__(told)

    sys.unraisablehook = unraisable
    signal.signal(signal.SIGINT, heed)
    try:
        from .command.cli import main as run

        status = run()
    except BaseException:  # an import may make another error of the interruption
        if not asked:
            raise
    finally:
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # the end of the interpreter would tell of it
    return INTERRUPTED if asked else status


if __name__ == "__main__":
    sys.exit(main())
