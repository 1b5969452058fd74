"""A fluid: exact fields on tori and on the disc, su(N) over a prime field; no rule of the walk."""
