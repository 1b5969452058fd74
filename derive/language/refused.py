"""Errors for people: their message is one line, which says what is wrong, where, what to do."""

from __future__ import annotations


class Refused(Exception):  # noqa: N818
    """Bad input, or something missing on the machine; on the command line exit 2, no traceback."""
