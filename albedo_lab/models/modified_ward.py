"""Modified Ward: Ward's Gaussian over the larger cosine, so that it stays bounded at grazing angles."""

from __future__ import annotations

from math import nan

from albedo_lab.model import MAXIMUM, EnergyConserving, Model, Reciprocal
from albedo_lab.models.ward import WIDTHS, Ward, gaussian, pdf, sample, sample_normal, widths
from albedo_lab.optics.coordinates import Axis, Coordinates, Kink
from albedo_lab.optics.frame import Direction, bisector
from albedo_lab.optics.profiles import GAUSS
from albedo_lab.sources import neumann1999


def evaluate(p: Ward, wi: Direction, wo: Direction) -> float:
    return gaussian(p, bisector(wi, wo)) / max(wi.z, wo.z)  # eq. 35


def weight(p: Ward, wo: Direction, u1: float, u2: float) -> float:
    """f cos / pdf = (wo.h) cos^3 wi.z / max(wi.z, wo.z)."""
    h = sample_normal(p, u1, u2)
    d = h.x * wo.x + h.y * wo.y + h.z * wo.z
    z = 2.0 * d * h.z - wo.z
    return d * h.z * h.z * h.z * z / max(z, wo.z) if z > 0.0 else 0.0


TABLE_4 = {0.4: 1.63, 0.2: 1.16, 0.1: 1.04, 0.05: 1.011, 0.02: 1.005, 0.01: 1.002, 0.005: 1.002}

MODEL = Model(
    "modified_ward",
    "C_max / (4 pi m^2) exp(-tan^2 delta / m^2) / max(N.L, N.V)",
    Ward,
    WIDTHS,
    evaluate,
    sample=sample,
    pdf=pdf,
    weight=weight,
    scale=MAXIMUM,
    scale_symbol="C_max",
    paper_constant=lambda p: TABLE_4.get(p.m_x, nan) if p.m_x == p.m_y else nan,
    smooth_in=Coordinates(Axis.HALF, GAUSS, ellipse=widths, kink=Kink.EQUAL_COSINES),
    isotropic=lambda p: p.m_x == p.m_y,
    source=neumann1999("eq. 35; constants: table 4"),
    claims=(Reciprocal("neumann1999 §6.2"), EnergyConserving("neumann1999 table 4")),
)
