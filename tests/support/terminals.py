"""What a program writes to a terminal of its own."""

import os


def read_to_end(ours):
    """All that comes from the other end of a terminal, until that is closed."""
    shown = b""
    try:
        while part := os.read(ours, 4096):
            shown += part
    except OSError:  # the other end is closed
        pass
    os.close(ours)
    return shown.decode()
