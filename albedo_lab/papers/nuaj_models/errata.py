"""The page's errors."""

from __future__ import annotations

from albedo_lab.papers.record import Cause, Erratum

NO_SCAN = "The formula is the page's own LaTeX; nothing was scanned."
TWICE = "The same constant stands at both exponents, so it is no slip of the pen; and the formula is the page's own LaTeX."

ERRATA = (
    Erratum(
        "almost_half",
        "BRDF from Actual Materials",
        "almost half of the table contains invalid directions (φd = 0)",
        "a third",
        "Count of the cells, and ∫ t² dt with θh = 90° t².",
        Cause.FALSE,
        "True of a table with evenly spaced θh, which the file is not.",
    ),
    Erratum(
        "useless_share",
        "BRDF from Actual Materials",
        "40% of the table is useless",
        "25 %",
        "Count of the cells, and quadrature without cells.",
        Cause.FALSE,
        "An evenly spaced table would lose 38 %: the same oversight as with “almost half”.",
    ),
    Erratum(
        "d_phong_argument",
        "Specularity",
        "Dphong(θr)",
        "Dphong(θh)",
        "The right side has θh, as eq. 4 and every other distribution of the page.",
        Cause.MISPRINT,
        NO_SCAN,
    ),
    Erratum(
        "d_tr",
        "Specularity",
        "α² / π",
        "(1 − α²) / (2π ln(1/α))",
        "Integral of D cos over the hemisphere.",
        Cause.FALSE,
        TWICE,
    ),
    Erratum(
        "tr_exponent",
        "Specularity",
        "the Trowbridge-Reitz distribution, with the exponent 1",
        "Berry's distribution; Trowbridge and Reitz's has the exponent 2 and is the same as GGX",
        "Normals of an ellipsoid of revolution, counted by their area.",
        Cause.FALSE,
        "The warning beside it says that the exponent is meant; losasso prints Trowbridge and Reitz's with the square.",
    ),
    Erratum(
        "d_gtr",
        "Specularity",
        "α² / π",
        "(γ − 1)(1 − α²) / (π (α^(2 − 2γ) − 1))",
        "Integral of D cos over the hemisphere, for five exponents.",
        Cause.FALSE,
        TWICE,
    ),
    Erratum(
        "smooth_below_half",
        "Fresnel",
        "smooth materials: F0 < 0.5, rough materials: F0 > 0.5",
        "dielectrics: F0 < 0.5, most metals: F0 > 0.5, however rough",
        "Measured indices of four metals, which the page counts among the smooth materials.",
        Cause.FALSE,
        "The page itself doubts it: “I didn't notice that at all, I read it”.",
    ),
    Erratum(
        "complex_for_polarity",
        "Fresnel",
        "complex numbers to account for light polarity",
        "complex numbers to account for absorption",
        "Both polarisations at glass from real numbers alone.",
        Cause.FALSE,
    ),
    Erratum(
        "one_minus_fresnel",
        "Diffuse Part",
        "1 − F(θd)",
        "(1 − a(θi)) (1 − a(θo)) / (1 − ā), with the albedo a of the facets and its mean ā",
        "Largest albedo of facets and diffuse part together; with the corrected weight it is a + (1 − a) = 1.",
        Cause.FALSE,
        NO_SCAN,
    ),
    Erratum(
        "refracted",
        "Diffuse Part",
        "(ni/nt)² (1 − F(θd))",
        "as above: what enters is 1 − F of the light's own angle",
        "Largest albedo of facets and diffuse part together.",
        Cause.FALSE,
        NO_SCAN,
    ),
    Erratum(
        "transmitted",
        "Diffuse Part",
        "1 − (ni/nt)²",
        "(ni/nt)² within the cone; 1 − (ni/nt)² is totally reflected",
        "Share of light within the cone, in closed form and by samples.",
        Cause.FALSE,
        NO_SCAN,
    ),
    Erratum(
        "upper_bound",
        "Diffuse Part",
        "an upper bound on the subsurface reflectance of 1 − (ni/nt)², 0.44 for water",
        "1 − F̄, with the share F̄ of a white sky that the surface reflects: 0.93 for water",
        "All attempts of light to get out of a medium that absorbs nothing.",
        Cause.FALSE,
    ),
)
