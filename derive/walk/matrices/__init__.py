"""A problem on a group of matrices: its metric, the solved kernel, coordinates, the answer."""
