"""What is truly wrong with the models of the catalogue, for the first parameters of `trial.SPECIMENS`."""

from __future__ import annotations

TRUE_FINDINGS: dict[str, dict[str, str]] = {
    "phong_original": {
        "energy": "n = 0: a(1) = 2 over the light; over the viewer it grows like 1/mu",
        "reciprocity": "over the cosine of the light alone",
    },
    "stretched_phong": {"energy": "n = 0: a = 1.0858 at theta = 45 deg; the paper claims energy balance for n >= 1 only"},
    "retro_phong": {"energy": "n = 0: as stretched_phong, whose image it is"},
    "plus_phong": {"energy": "n = 0: a(1) = 1.227, and 2 at grazing; the paper's constant is for another lobe"},
    "product_phong": {"energy": "grows like 1/mu, for which the paper rejects it"},
    "sqrt_phong": {"energy": "grows like mu^-1/2, for which the paper rejects it"},
    "ward": {
        "energy": "grows like mu^-1/2; for m = 1e-4 above 1 from mu = 1e-13 on",
        "claims": "neumann1999 §6.2, citing Ward, has it conserve energy for m < 0.2",
    },
    "ward_duer": {"energy": "grows like 1/mu; for m = 1e-4 above 1 from mu = 8.6e-5 on"},
    "schlick": {"energy": "r = 1e-6: a = 499 at mu = 1e-9", "claims": "schlick1993 section 7 has it conserve energy"},
    "disney_diffuse": {"energy": "roughness = 1: a = 1 + 11/21 + 1/84 + 11/504 = 1.5575 at grazing incidence"},
    "cook_torrance": {"claims": "neumann1999 figure 5 has it diverge at grazing angles; V-cavities keep it at most 1"},
    "charlie": {
        "energy": "the fit of Lambda stays below exp(21), so that 1/mu is left of it: above 1 from mu = 1.15e-6 on for r = 0.3",
        "reciprocity": "the masking of the light is softened, that of the viewer is not",
    },
    "disney": {"energy": "white, rough, with everything on it: 1.734 at grazing; the body alone has 1.558"},
}
"""By model and check, the convictions that are right, with the reason; every other check acquits, of every other model all do."""

UNDECIDED: dict[str, dict[str, str]] = {
    "schlick_isotropic": {
        "energy": "r = 1e-6: the albedo is still rising at mu = 1e-12, and its limit is known within 2e-4",
        "claims": "the same claim of energy balance",
    },
}
"""What is left open at the default budget, and why."""
