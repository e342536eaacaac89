"""The reflectance models of the catalogue, written in angles from the papers, for the slow oracle only.

One file a family; every function takes a `Pair` (the angles of one pair of directions, as arrays) and plain numbers, and
returns f_r without the cosine.  Nothing here is shared with albedo_lab.

pair        the angles: v' = n.wi, v = n.wo, t = n.h, u = wo.h, the azimuth of the half vector, the mirror cosine.
fresnel     one, Schlick, exact for a complex index.
facets      D and G of microfacet models; exact Smith masking, by closed form or by quadrature of its definition.
microfacet  `microfacet`, `ggx`, `beckmann`, `cook_torrance`, `blinn_trowbridge_reitz`.
schlick     `schlick`, `phong_blend` (schlick1993).
descendants `ward_duer`, `ward_bounded`, `ashikhmin_shirley`, `kelemen`.
diffuse     `oren_nayar_fujii`, `eon`, `disney_diffuse`.
volume      `lommel_seeliger`, `hapke`, `hanrahan_krueger`.
rough       `oren_nayar`, `minnaert`, `he_torrance`, `ward` (half-vector form).
compensated `ggx_multiscatter`.
disney      `disney`, lobe by lobe.
sheen       `charlie`.
lobes       `lafortune`, `stretched_lafortune`, `metal`, `plastic` (neumann1999).
"""
