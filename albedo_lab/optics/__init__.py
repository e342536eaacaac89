"""What several models share: elementary functions, the local frame, lobes and microfacet normals. Plain Python, no numba."""
