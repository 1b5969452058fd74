"""The command line, the files it writes, and the limits of a run."""
