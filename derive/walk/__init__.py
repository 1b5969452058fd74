"""The road and its steps, an idea a file; :mod:`derive.pipeline` has them in order."""
