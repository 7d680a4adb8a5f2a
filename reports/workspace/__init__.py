"""Pictures of a sweep over the workspace of a manipulator: slices and isosurfaces, from its folder alone."""
