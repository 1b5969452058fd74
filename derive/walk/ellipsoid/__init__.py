"""A body of fluid in the form of an ellipsoid, moved by linear maps."""
