"""What the documents print of time and cost, and who is measured to judge it; the sentences stand in `cost_claims`.

A time belongs to a machine, and the documents' machines are gone. What is judged here are ratios, on the machine that measures:
its verdicts are no errata, and may be others elsewhere.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass

from albedo_lab.analysis.clock import Ratio, Times, interleave, ratio, timed
from albedo_lab.analysis.timing import ROUNDS, Contender, evaluation, nanoseconds, operations_of, spectrum

SCHLICK = {"p": 1.0, "spectral": "fresnel"}
CONTENDERS: dict[str, Contender] = {
    "lambert": Contender("lambert", {}),
    "phong": Contender("phong", {"n": 20.0}),
    "phong_original": Contender("phong_original", {"n": 20.0}),
    "stretched_phong": Contender("stretched_phong", {"n": 20.0}),
    "blinn": Contender("blinn", {"n": 20.0}),
    "stretched_blinn": Contender("stretched_blinn", {"n": 20.0}),
    "ward": Contender("ward", {"m": 0.2}),
    "modified_ward": Contender("modified_ward", {"m": 0.2}),
    "ward_half_vector": Contender("ward", {"form": "half_vector", "m_x": 0.2, "m_y": 0.4}),
    "cook_torrance": Contender("cook_torrance", {"m": 0.2}, "fresnel"),
    "cook_torrance_exact": Contender("cook_torrance", {"m": 0.2, "fresnel": "exact"}),
    "cook_torrance_losasso": Contender("cook_torrance", {"m": 0.2, "fresnel": "exact", "as_printed": "losasso"}),
    "cook_torrance_cheap": Contender("cook_torrance", {"m": 0.2, "fresnel": "schlick"}),
    "blinn_facets": Contender("blinn_trowbridge_reitz", {"c": 0.2}),
    "he_torrance": Contender("he_torrance", {}, "all"),
    "oren_nayar": Contender("oren_nayar", {}),
    "oren_nayar_full": Contender("oren_nayar", {"form": "full"}),
    "minnaert": Contender("minnaert", {"as_printed": "yes"}),
    "metal_tabulated": Contender("metal", {"angle": "tabulated"}),
    "plastic": Contender("plastic", {"fresnel": "one"}),
    "schlick_isotropic": Contender("schlick_isotropic", {}),
    "schlick_eq12": Contender("schlick", SCHLICK | {"directional": "eq12"}),
    "schlick_eq15": Contender("schlick", SCHLICK | {"directional": "eq15"}),
    "schlick_eq17": Contender("schlick", SCHLICK | {"directional": "eq17"}),
    "schlick_eq18": Contender("schlick", SCHLICK | {"directional": "eq18"}),
    "facets_beckmann": Contender("microfacet", {"D": "beckmann", "G": "v_cavity"}),
    "facets_ggx": Contender("microfacet", {"D": "ggx", "G": "v_cavity"}),
}
"""Everything that is measured, by name; parameters do not change what an evaluation costs."""


@dataclass(frozen=True)
class Row:
    """A line of a table of costs: its name in the document, who stands for it, and the printed figure."""

    label: str
    contender: str
    printed: str = ""


@dataclass(frozen=True)
class Timing:
    """A table of costs. `wavelengths` is 1 or 8; printed figures, in `unit`, are judged relative to that of the row `base`."""

    name: str
    title: str
    place: str
    rows: tuple[Row, ...]
    base: str
    wavelengths: int = 1
    unit: str = ""
    note: str = ""


@dataclass(frozen=True)
class Costs:
    """What was measured: times of all contenders at one and at eight wavelengths, and the operations of one evaluation."""

    one: Times
    eight: Times
    operations: Mapping[str, Counter[str]]

    def times(self, wavelengths: int) -> Times:
        """At so many wavelengths, 1 or 8."""
        return self.one if wavelengths == 1 else self.eight

    def ratio(self, slower: str, faster: str, wavelengths: int = 1) -> Ratio:
        """How many times longer one takes than another."""
        return ratio(self.times(wavelengths), slower, faster)

    def nanoseconds(self, name: str, wavelengths: int = 1) -> float:
        """Of one pair of directions."""
        return nanoseconds(self.times(wavelengths), name)


def measure(rounds: int = ROUNDS, names: tuple[str, ...] = tuple(CONTENDERS)) -> Costs:
    """Measures contenders, all of them by default."""
    some = {name: CONTENDERS[name] for name in names}
    one = interleave({name: timed(evaluation(contender)) for name, contender in some.items()}, rounds)
    eight = interleave({name: timed(spectrum(contender)) for name, contender in some.items()}, rounds)
    return Costs(one, eight, {name: operations_of(contender) for name, contender in some.items()})


TABLE_1 = Timing(
    "neumann1999_table_1",
    "Comparison of existing BRDF models: relative computation time",
    "neumann1999, table 1",
    (
        Row("recip. Phong", "phong", "1"),
        Row("recip. Blinn", "blinn", "1.8"),
        Row("Cook-Torrance", "cook_torrance_exact", "4.2"),
        Row("Ward", "ward", "4.0"),
        Row("He-Torrance", "he_torrance", "320"),
    ),
    "phong",
    note="One wavelength; Cook-Torrance with V-cavities and the exact Fresnel term. The print's 4.2, 4.0 and 320 are "
    "not the ratios of "
    "its own table 5: 21 / 5.4 = 3.9, 19 / 5.4 = 3.5, 1516 / 5.4 = 281; its 1.8 is.",
)
TABLE_5 = Timing(
    "neumann1999_table_5",
    "Computation time of different BRDF models",
    "neumann1999, table 5",
    (
        Row("Phong", "phong", "5.4"),
        Row("Blinn", "blinn", "9.7"),
        Row("Ward", "ward", "19"),
        Row("Oren-Nayar", "oren_nayar_full", "35"),
        Row("Cook-Torrance", "cook_torrance", "21"),
        Row("He-Torrance", "he_torrance", "1516"),
        Row("stretched Phong", "stretched_phong", "5.8"),
        Row("stretched Blinn", "stretched_blinn", "10.5"),
        Row("modified Ward", "modified_ward", "17.6"),
    ),
    "phong",
    8,
    "min",
    "Eight wavelengths for each pair of directions. A shape that has no wavelength in it is evaluated once and "
    "multiplied by eight "
    "reflectances; Cook-Torrance computes D and G once and the Fresnel term of a metal eight times; He-Torrance "
    "everything eight times. "
    "Minutes as printed are of 8·10⁸ pairs, 1000 × 1000 pixels, 200 samples each, paths of 4: Phong's 5.4 are 405 ns a pair.",
)
APPENDIX_B = Timing(
    "losasso_appendix_b",
    "Relative costs of the different lighting models",
    "losasso, appendix B",
    (
        Row("Lambert", "lambert"),
        Row("Phong", "phong_original"),
        Row("Cook-Torrance, exact F", "cook_torrance_losasso"),
        Row("Cook-Torrance, cheap F", "cook_torrance_cheap"),
        Row("Blinn, F = 1", "blinn_facets"),
        Row("Oren-Nayar, simplified", "oren_nayar"),
        Row("Oren-Nayar, full", "oren_nayar_full"),
        Row("Minnaert", "minnaert"),
        Row("Ward", "ward_half_vector"),
    ),
    "phong_original",
    note="The document's table is missing from its text beyond the caption (“the relative costs of the different "
    "lighting models in terms of "
    "vertex shaders, pixel shaders, and texture lookups”): there is no printed figure to judge. These costs are of "
    "one evaluation on a "
    "processor, relative to Phong's specular term. None of the models needs a texture lookup. Environment maps are "
    "no model, and are "
    "not measured.",
)
TIMINGS = (TABLE_1, TABLE_5, APPENDIX_B)
