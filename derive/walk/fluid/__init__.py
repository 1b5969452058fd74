"""An incompressible fluid: the note's last paragraph, by the words of the affine groups."""
