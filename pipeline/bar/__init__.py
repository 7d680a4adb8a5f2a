"""The command `bar`: one bar from a case, a CAD file or a mesh to K_b, K_g and its critical loads."""
