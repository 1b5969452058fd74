"""The checker's account of a fluid: exact fields on tori and on the disc, no rule of the walk."""
