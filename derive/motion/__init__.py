"""Motion: from emitted code to a trajectory, with what it keeps, and its file."""
