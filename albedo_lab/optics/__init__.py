"""What several models share: elementary functions, frame, lobes, microfacets, Fresnel, metals, colour. Imports no numba."""
