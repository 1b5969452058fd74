"""The Python of the playground, asked here as its worker asks it in the browser."""

import base64
import importlib
import io
import json
import pickle
import sys
import zipfile
from functools import cache

from derive.command.showing import READY
from derive.record.record import AMENDED
from playground.site import OWN

PENDULUM = """name = "mine"
group = "SO(3)"
[parameters]
m = { default = 1 }
l = { default = 2 }
g = { default = 9.81 }
[[point]]
mass = "m"
at = ["l", 0, 0]
[[point]]
mass = "m"
at = [0, "l", 0]
[[point]]
mass = "m"
at = [0, 0, "l"]
[[potential]]
kind = "gravity"
g = [0, 0, "-g"]
"""
UNKNOWN_KEY = PENDULUM.replace('g = [0, 0, "-g"]', 'h = [0, 0, "-g"]')
"""Refused at line 18."""


def text_of(name):
    """The text of a ready-made problem; of what is a text, that."""
    return name if "\n" in name else (READY / f"{name}.toml").read_text(encoding="utf-8")


@cache
def module():
    """``playground/python/play.py``."""
    folder = str(OWN / "python")
    sys.path.insert(0, folder)
    try:
        return importlib.import_module("play")
    finally:
        sys.path.remove(folder)


@cache
def amendments():
    """What :mod:`playground.python.pack` writes when the playground is built."""
    from derive.views.paper.findings import amendments as found

    return pickle.dumps(found(AMENDED))


class Played:
    """The questions of one page, and what it is told."""

    def __init__(self, folder, monkeypatch):
        monkeypatch.setattr(module(), "FOLDER", folder / "problem")
        stored = folder / "amendments.pickle"
        stored.write_bytes(amendments())
        monkeypatch.setattr(module(), "STORED", stored)
        self.heard = []
        self.play = module().Play(lambda kind, news: self.heard.append((kind, json.loads(news))))

    def asked(self, ask, **more):
        """What is told of a question, in its order; of files the zip as well."""
        self.heard.clear()
        made = getattr(self.play, ask)(**more)
        return [*self.heard, *([("zip", unzipped(made))] if made else [])]


def unzipped(packed):
    """The files of a zip, as bytes or in base 64."""
    packed = base64.b64decode(packed) if isinstance(packed, str) else packed
    with zipfile.ZipFile(io.BytesIO(packed)) as archive:
        return {x: archive.read(x) for x in archive.namelist()}
