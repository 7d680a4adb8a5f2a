"""Parts that a user brings: CAD files and meshes, read and meshed in a process of its own."""
