"""Emitted C at work: compiled by the compiler at hand, loaded, called."""
