"""Slow, independent oracles for the albedos of the models of neumann1999.  They share no code with albedo_lab.

Modules
-------
quadrature      Gauss-Legendre panels graded geometrically to every break point; nodes as distances from both ends.
albedo          `albedo(model, mu, phi=0.0, order="wi", **parameters) -> (value, error)`: albedo of the SHAPE
                (without c_n, C_n, C_max), by two quadratures in two coordinate systems.  mu = 0 is the limit mu -> 0+.
mean            `mean_albedo(model, order="wi", **parameters) -> (value, error)`, plain triple quadrature;
                `mean_reduced` and `mean_closed_form`, derived by averaging over the normal instead of the directions.
supremum        `supremum(model, **parameters) -> (value, error, theta_peak)` over mu in (0, 1]; constant = 1/value.
witness         the printed formulas, literally, in 50-digit arithmetic, for narrow lobes.
make_reference  writes reference.json.

formulas           the other models of the catalogue, written in angles from the papers: one file a family.
catalogue_albedo   `albedo(model, parameters, mu, phi=0.0, order="wi") -> (value, error)` for them, Dirac part included.
make_catalogue     writes catalogue.json (three minutes): model, parameters and choices, order, mu, phi (radians), value, error.

reference.json
--------------
albedo    all 15 models, three parameter sets each (five for the Ward models, the anisotropic ones at three azimuths) at
          theta = 0, 30, 60, 80, 89, 89.9, 89.999 degrees.  Use the stored `mu`, the exact double the value belongs to.
extreme   n = 0 and 1e8, m = 1e-4 and 1, r = 1e-6 and 1, at mu = 1, 0.5, 1e-4, 1e-9.
supremum  suprema, angles of the peak (radians; flat maxima, good to 1e-6 only), constants.
mean      mean albedos: direct quadrature with its error, the reduction to one integral (good to 1e-13), closed forms.
witness   some extreme points next to their 50-digit value.

What is integrated: L = light (wi), V = viewer (wo); order "wi" fixes V and integrates f c_L over L, "wo" fixes L and
integrates f c_V over V; only `phong_original` (1/c_L) tells them apart.  n = 0 of the Phong family is the indicator
R.V > 0 (L.V > 0 for `retro_phong`).  Ward takes m_x, m_y or m; its azimuth phi is that of the fixed direction from x.

The error bound is the difference of the two coordinate systems, plus the difference of two orders in one of them, plus
1e-13 for rounding.  In the stored tables it is below 4e-12 (relative) for the albedos, 1e-12 for the suprema and 4e-11 for
the directly integrated means.

Closed forms used by the tests (derivations: `mean` and `test_oracles`)
    mu = 1      phong, stretched, retro, p: 2 pi/(n+2); product: 2 pi/(n+1); sqrt: 2 pi/(n+3/2);
                blinn and stretched blinn: 8 pi [2 (1 - 2^{-(n+4)/2})/(n+4) - (1 - 2^{-(n+2)/2})/(n+2)]
    mu -> 0     stretched phong, original (wi): pi/(n+1); plus phong: 2 pi/(n+1); blinn: 8 pi/((n+2)(n+4));
                stretched blinn: 8 W_n/(n+2), plus blinn: twice that, W_n the Wallis integral of cos^n;
                ward: a sqrt(mu) -> constant, m^{3/2} Gamma(5/4)/sqrt(2 pi) for small m
    any mu      phong n = 0: pi/2 (1 + cos theta); n = 1: 2/3 (sin theta + (pi - theta) cos theta)
"""
