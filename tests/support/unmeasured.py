"""Processes whose coverage is not measured, since their time, memory or files are limited."""

import os


def environment(**more):
    """The variables of this process, but for those by which a new one measures its coverage."""
    return {k: x for k, x in os.environ.items() if not k.startswith("COV")} | more
