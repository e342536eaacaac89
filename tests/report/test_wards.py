"""Ward's family side by side: closed forms of its limits, and the pages."""

from __future__ import annotations

import csv
import io
import math

import pytest
from scipy.integrate import quad

from albedo_lab.analysis import wards as analysis
from albedo_lab.report.wards import Wards, wards_csv, wards_files, wards_html

M = 0.3


@pytest.fixture(scope="module")
def family() -> Wards:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(analysis, "WIDTHS", (M,))
        return Wards(tuple(analysis.members()), {"svg": b"<svg></svg>", "png": b""})


def test_grazing_laws(family):
    """Modified Ward ends at (1/pi) ∫ 2 y^2 exp(-y^2) m / (1 + m^2 y^2)^2 dy times what its constant is over that of the print."""
    exponents = {member.name: member.grazing.exponent for member in family.members}
    for name, s in (("ward", -0.5), ("modified_ward", 0.0), ("ward_duer", -1.0), ("ward_bounded", 0.0)):
        assert exponents[name].low <= s <= exponents[name].high
    half = quad(lambda y: 2.0 * y * y * math.exp(-y * y) * M / (1.0 + M * M * y * y) ** 2, 0.0, 10.0)[0] / math.pi
    modified, bounded = (member for member in family.members if member.grazing.behaviour == "bounded")
    printed = 1.0 / modified.largest.value
    steep = quad(lambda t: math.exp(-t / M**2) / M**2 / (1.0 + t) ** 2 * (1.0 - t) / (1.0 + t), 0.0, 1.0, epsabs=1e-12)[0]
    assert modified.grazing.limit * printed * steep == pytest.approx(half, abs=1e-6)
    assert bounded.grazing.limit == pytest.approx(1.0, abs=1e-8)


def test_where_the_albedo_passes_one(family):
    """What diverges does, what is bounded by 1 never."""
    above = {member.name: member.above for member in family.members}
    assert math.isnan(above["modified_ward"])
    assert math.isnan(above["ward_bounded"])
    assert above["ward_duer"] == pytest.approx(82.1104, abs=1e-4)
    assert above["ward"] > above["ward_duer"]


def test_pages(family):
    page = wards_files(family)["wards.md"]
    assert isinstance(page, str)
    assert page.count("diverges") == 2
    rows = list(csv.DictReader(io.StringIO(wards_csv(family))))
    assert [row["model"] for row in rows] == list(analysis.FAMILY)
    assert 'href="#model-ward_duer"' in wards_html(family)
