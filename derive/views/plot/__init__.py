"""Pictures of runs: each kind a function of a run, drawn with matplotlib as vectors."""
