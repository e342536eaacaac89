"""The errors of the document."""

from __future__ import annotations

from albedo_lab.papers.losasso.blinn import BLINN
from albedo_lab.papers.losasso.cook_torrance import COOK_TORRANCE
from albedo_lab.papers.losasso.diffuse import MINNAERT, OREN_NAYAR
from albedo_lab.papers.losasso.terms import APPENDIX_A
from albedo_lab.papers.losasso.ward import WARD
from albedo_lab.papers.record import Cause, Erratum

CHEAP = "F = (1 − (1 − (N·E))^5) + n (1 − (N·E))^5"

ERRATA = (
    Erratum(
        "one_light_for_all_equations",
        "all equations",
        "k_d f_att (N·L) (Lambert, Phong, Ward), but … / (π (E·N)) (Cook-Torrance), ρ/π E₀ (Oren-Nayar)",
        "one convention: 1/π in every term for a light of irradiance 1, or in none for one of π",
        "The shares that white surfaces reflect at normal incidence differ by π between equations.",
        Cause.FALSE,
        "Each equation is right by itself for one of the two lights; Ward's 1 / (4 α_x α_y) is 1 / (4π α_x α_y) for the other.",
    ),
    Erratum(
        "ct_lambertian_facets",
        COOK_TORRANCE,
        "microscopic perfect Lambertian reflectors called microfacets",
        "microscopic perfect mirrors called microfacets",
        "Nearly flat facets send their light about R, as the document's own equation has it.",
        Cause.FALSE,
        "A word, not a symbol: no damage makes one of the other.",
    ),
    Erratum(
        "ct_diffuse_term",
        f"{COOK_TORRANCE}, equation",
        "k_d ρ (L·N), ρ = k_s f_att D G F_λ(θ_i) / (π (L·N)(E·N))",
        "k_d f_att (L·N), with ρ (L·N) as the specular term",
        "With ρ put in, the term with k_d is the specular term times k_d.",
        Cause.MISPRINT,
        "Lambert's, Phong's and Ward's equations have k_d f_att (N·L) in this place.",
    ),
    Erratum(
        "ct_attenuation",
        f"{COOK_TORRANCE}, equation",
        "k_s D G F_λ(θ_i) / (π (E·N))",
        "k_s f_att D G F_λ(θ_i) / (π (E·N))",
        "The term does not change with the light's distance.",
        Cause.MISPRINT,
        "ρ in the next line and Blinn's equation, said to be of the same form, have f_att.",
    ),
    Erratum(
        "blinn_k_s",
        f"{BLINN}, equation",
        "D = (c² / ((N·H)² (c² − 1) + 1))²",
        "D / (4 c²), for a light of irradiance π; D / (4π c²) for one of 1",
        "D is 1 at its peak whatever c is; the share reflected should be k_s and is 4 c² of it, less what the cavities hide.",
        Cause.FALSE,
        "Blinn himself has D so, scaled to 1 at its peak; but then k_s is not the fraction that appendix A says it is.",
    ),
    Erratum(
        "blinn_eccentricity",
        f"{APPENDIX_A}, c",
        "The eccentricity of the micro facets (0 for very shiny, 1 for very dull)",
        "The ratio of their axes (0 for very shiny, 1 for very dull); the eccentricity is √(1 − c²)",
        "D is the inverse curvature of a spheroid of axis ratio c.",
        Cause.FALSE,
        "The ends of its range are given right, for the ratio.",
    ),
    Erratum(
        "oren_nayar_needs_angles",
        OREN_NAYAR,
        "it requires the calculation of azimuth and zenith angles",
        "it needs no angle: cos(φ_r − φ_i) sin(α) tan(β) = (L·E − (N·L)(N·E)) / max(N·L, N·E)",
        "Both forms are the same function.",
        Cause.FALSE,
    ),
    Erratum(
        "minnaert_equation_reciprocal",
        f"{MINNAERT}, equation",
        "(1 − N·E)^(1−k)",
        "(N·E)^(k−1)",
        "Minnaert's law is symmetric in N·L and N·E but for the light's own cosine.",
        Cause.FALSE,
        "Not damage: “towards zero when the viewer looks onto the surface at perpendicular angles” is the same 1 − N·E in words.",
    ),
    Erratum(
        "minnaert_equation_lambert",
        f"{MINNAERT}, equation",
        "(N·L) * (N·L)^k",
        "(N·L)^k",
        "With one N·L less, and (N·E)^(k−1), k = 1 is Lambert's law; as printed no k is.",
        Cause.FALSE,
        "Not damage: “the first dot product can be combined with the second making the exponent k+1”.",
    ),
    Erratum(
        "minnaert_darkening_limbs",
        f"{MINNAERT}, first sentence",
        "darkening limbs",
        "true of Minnaert's own law with k > 1; the printed equation darkens the centre",
        "As printed the surface is brightest at its limb.",
        Cause.FALSE,
        "The error is the equation's (see 1 − N·E above), not that of the sentence.",
    ),
    Erratum(
        "ward_texture_axes",
        WARD,
        "the cosine of the angle between the surface normal and the light vector …, between the surface normal and the "
        "half angle vector",
        "… between the surface tangent and the light vector, between the surface tangent and the half angle vector",
        "N·L and N·H do not change when the surface turns about N: what they select is isotropic by the document's own "
        "definition.",
        Cause.FALSE,
    ),
    Erratum(
        "ward_standard_deviation",
        f"{WARD}, after its equation",
        "The α terms are the standard deviations of the slope in the X and Y direction",
        "√2 times these standard deviations",
        "e^(−(x/α)²) is a Gaussian of standard deviation α/√2.",
        Cause.FALSE,
        "The words are Ward's own; neumann1999 calls the m of the isotropic case the RMS slope, which it is, over all "
        "directions.",
    ),
    Erratum(
        "appendix_a_complete",
        f"{APPENDIX_A}, first sentence",
        "each symbol used in this paper",
        "some of the symbols; V, in H and G, is E",
        "The symbols of every equation were held against the table.",
        Cause.FALSE,
    ),
    Erratum(
        "appendix_a_one_meaning",
        f"{APPENDIX_A}, n, c, F",
        "n: Specular Exponent; c: Ellipsoid Eccentricity",
        "in F, n is the index of refraction and c = L·H",
        "F of a specular exponent means nothing; θ_i is an angle from H in F, from N in the Oren-Nayar equation.",
        Cause.FALSE,
    ),
    Erratum(
        "fresnel_glass",
        f"{APPENDIX_A}, F",
        "g = √(n² + c²) − 1",
        "g = √(n² + c² − 1)",
        "Glass must reflect 4 % at normal incidence, and n = 1 nothing.",
        Cause.UNKNOWN,
        "The bar of a root is easily read too short; that the first equation of F is right shows that the source was Fresnel's.",
    ),
    Erratum(
        "cheap_fresnel_approximates",
        f"{APPENDIX_A}, F",
        CHEAP,
        "F = F₀ (1 − (1 − c)^5) + (1 − c)^5, F₀ = ((n − 1)/(n + 1))²",
        "It must be F₀ at normal incidence and 1 at grazing angles; the factor stands at the wrong term, and n is no "
        "reflectance.",
        Cause.MISPRINT,
        "Reading does not move a factor from one term to another.",
    ),
    Erratum(
        "cheap_fresnel_reciprocal",
        f"{APPENDIX_A}, F",
        "(1 − (N·E))^5",
        "(1 − (L·H))^5",
        "With N·E the model is not reciprocal; the exact equation before has c = L·H.",
        Cause.MISPRINT,
        "Two different letters, in both terms alike.",
    ),
)
