"""Counts the operations of straight C or C++: what stands right of = in the body of a function."""

from __future__ import annotations

import re
from collections import Counter

TOKEN = re.compile(r"[A-Za-z_]\w*(?:::\w+)*|(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|[-+*/()?:,]|\S")
NAMES = {"*": "mul", "+": "add", "-": "add", "/": "div"}
CALLS = {"casadi_sq": "mul"}


def body(source: str, name: str) -> str:
    """The body of the function, between its braces."""
    source = re.sub(r"/\*.*?\*/|//[^\n]*", "", source, flags=re.S)
    start = re.search(rf"\b{name}\s*\([^;{{]*\)\s*(?:const\s*)?\{{", source)
    if start is None:
        raise ValueError(f"no function {name}")
    depth, i = 1, start.end()
    while depth:
        depth += {"{": 1, "}": -1}.get(source[i], 0)
        i += 1
    return source[start.end() : i]


def right_sides(text: str) -> list[str]:
    """What is assigned, subscripts left out."""
    while re.search(r"\[[^\[\]]*\]", text):
        text = re.sub(r"\[[^\[\]]*\]", "", text)
    text = re.sub(r"\b(\w*res|_?dx|[A-Za-z]\w*)\(\s*\d+,\s*\d+\s*\)", r"\1", text)
    parts = re.split(r"[;{}]|,\s*(?=[A-Za-z]\w*\s*=)", text)
    return [part.partition("=")[2] for part in parts if "=" in part]


def operations(source: str, name: str) -> str:
    """Multiplications, additions with subtractions, and divisions, as our headers say them."""
    found: Counter[str] = Counter()
    for side in right_sides(body(source, name)):
        before = ""
        for token in TOKEN.findall(side):
            operand = before and (before[-1].isalnum() or before[-1] in "_)" or before[-1] == ".")
            if token in NAMES and operand:
                found[NAMES[token]] += 1
            if token in CALLS:
                found[CALLS[token]] += 1
            before = token
    return ", ".join(f"{found[n]} {n}" for n in ("mul", "add", "div") if found[n])


def number(text: str, name: str) -> int:
    """One of the counts of such a text."""
    found = re.search(rf"(\d+) {name}", text)
    return int(found[1]) if found else 0
