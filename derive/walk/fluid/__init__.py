"""An incompressible fluid, by the words of the affine groups; on the torus; in an ellipsoid."""
