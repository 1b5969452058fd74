"""The steps of the paper, one file each."""
