"""A problem on a group of matrices: its metric, the kernel solved, in vectors too, the answer."""
