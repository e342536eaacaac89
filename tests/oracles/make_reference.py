"""Write reference.json: the oracle's results in full double precision, each with its error bound.

Run `python tests/oracles/make_reference.py` from anywhere; `... make_reference.py albedo extreme` recomputes only the
named sections and keeps the others.  Every section is saved as soon as it is complete.  It takes about an hour.
"""

from __future__ import annotations

import json
import math
import sys
import time
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from tests.oracles.albedo import HALF_VECTOR_MODELS, MODELS, PHONG_MODELS, albedo  # noqa: E402
from tests.oracles.mean import mean_albedo, mean_closed_form, mean_reduced  # noqa: E402
from tests.oracles.supremum import supremum  # noqa: E402
from tests.oracles.witness import witness  # noqa: E402

TARGET = HERE / "reference.json"
THETA_DEG = (0.0, 30.0, 60.0, 80.0, 89.0, 89.9, 89.999)
Entry = dict[str, Any]


def parameter_sets(model: str) -> list[dict[str, float]]:
    """The three parameter sets of every model (five for the Ward models, two of them anisotropic)."""
    if model == "lambert":
        return [{"albedo": value} for value in (1.0, 0.5, 0.18)]
    if model == "p_phong":
        return [{"n": n, "p": p} for n, p in ((1.0, 0.5), (20.0, 0.25), (1000.0, 0.9))]
    if model in ("ward", "modified_ward"):
        pairs = ((0.4, 0.4), (0.1, 0.1), (0.01, 0.01), (0.1, 0.3), (0.05, 0.5))
        return [{"m_x": m_x, "m_y": m_y} for m_x, m_y in pairs]
    if model == "schlick_isotropic":
        return [{"r": r} for r in (0.5, 0.1, 0.001)]
    return [{"n": n} for n in (1.0, 20.0, 1000.0)]


def extreme_sets(model: str) -> list[dict[str, float]]:
    """Parameters at the ends of their domains."""
    if model == "lambert":
        return []
    if model == "p_phong":
        return [{"n": n, "p": 0.5} for n in (0.0, 1e8)]
    if model in ("ward", "modified_ward"):
        return [{"m_x": m, "m_y": m} for m in (1e-4, 1.0)]
    if model == "schlick_isotropic":
        return [{"r": r} for r in (1e-6, 1.0)]
    return [{"n": n} for n in (0.0, 1e8)]


def orders(model: str) -> tuple[str, ...]:
    """Both orders of integration where they differ."""
    return ("wi", "wo") if model == "phong_original" else ("wi",)


def albedo_section() -> list[Entry]:
    """All models at the seven angles."""
    entries = []
    for model in MODELS:
        for par in parameter_sets(model):
            azimuths = (0.0, 30.0, 90.0) if par.get("m_x") != par.get("m_y") else (0.0,)
            for order in orders(model):
                for phi_deg in azimuths:
                    for theta_deg in THETA_DEG:
                        mu = math.cos(math.radians(theta_deg))
                        value, error = albedo(model, mu, math.radians(phi_deg), order, **par)
                        entries.append(
                            {
                                "model": model,
                                "parameters": par,
                                "order": order,
                                "theta_deg": theta_deg,
                                "phi_deg": phi_deg,
                                "mu": mu,
                                "value": value,
                                "error": error,
                            }
                        )
        print(f"albedo {model} done", file=sys.stderr, flush=True)
    return entries


def extreme_section() -> list[Entry]:
    """The ends of the parameter domains, down to mu = 1e-9."""
    entries = []
    for model in (*PHONG_MODELS, *HALF_VECTOR_MODELS):
        for par in extreme_sets(model):
            for order in orders(model):
                for mu in (1.0, 0.5, 1e-4, 1e-9):
                    value, error = albedo(model, mu, 0.0, order, **par)
                    entries.append({"model": model, "parameters": par, "order": order, "mu": mu, "value": value, "error": error})
        print(f"extreme {model} done", file=sys.stderr, flush=True)
    return entries


POWERS = tuple(2.0**k for k in range(10))


def supremum_section() -> list[Entry]:
    """Suprema of the albedo and the maximum constants 1/supremum; theta_peak is in radians."""
    cases: list[tuple[str, dict[str, float]]] = [(name, {"n": n}) for name in ("blinn", "stretched_blinn") for n in POWERS]
    cases += [("modified_ward", {"m_x": m, "m_y": m}) for m in (0.4, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005)]
    cases += [("schlick_isotropic", {"r": r}) for r in (0.5, 0.1, 0.01, 0.001)]
    cases += [("phong", {"n": n}) for n in (1.0, 20.0, 100.0)]
    cases += [("stretched_phong", {"n": n}) for n in (1.0, 2.0, 4.0, 20.0, 100.0)]
    cases += [("retro_phong", {"n": n}) for n in (1.0, 20.0)]
    cases += [("p_phong", {"n": n, "p": p}) for n, p in ((1.0, 0.5), (1.0, 0.9), (20.0, 0.25))]
    cases += [("plus_phong", {"n": n}) for n in (1.0, 20.0, 100.0)]
    cases += [("plus_blinn", {"n": n}) for n in (1.0, 20.0, 100.0)]
    entries = []
    for model, par in cases:
        value, error, peak = supremum(model, **par)
        entries.append(
            {
                "model": model,
                "parameters": par,
                "supremum": value,
                "error": error,
                "theta_peak": peak,
                "constant": 1.0 / value,
            }
        )
        print(f"supremum {model} {par} done", file=sys.stderr, flush=True)
    return entries


def mean_section() -> list[Entry]:
    """Mean albedos: the direct triple quadrature, the reduction to one integral, the closed form where there is one."""
    cases: list[tuple[str, str, dict[str, float]]] = [
        (model, "wi", {"n": n}) for model in ("phong", "stretched_phong", "blinn", "stretched_blinn") for n in POWERS
    ]
    cases += [(model, "wi", {"n": 20.0}) for model in ("plus_phong", "product_phong", "sqrt_phong", "plus_blinn")]
    cases += [("phong_original", order, {"n": 20.0}) for order in ("wi", "wo")]
    cases += [("p_phong", "wi", {"n": 20.0, "p": 0.25})]
    cases += [(model, "wi", {"m_x": 0.1, "m_y": 0.1}) for model in ("ward", "modified_ward")]
    cases += [("schlick_isotropic", "wi", {"r": r}) for r in (0.5, 0.1, 0.001)]
    entries = []
    for model, order, par in cases:
        value, error = mean_albedo(model, order, **par)
        reduced = None if model == "schlick_isotropic" else mean_reduced(model, **par)[0]
        entries.append(
            {
                "model": model,
                "parameters": par,
                "order": order,
                "value": value,
                "error": error,
                "reduced": reduced,
                "closed_form": mean_closed_form(model, **par),
            }
        )
        print(f"mean {model} {par} {value} {error:.1e} {reduced}", file=sys.stderr, flush=True)
    return entries


def witness_section() -> list[Entry]:
    """Extreme points by literal formulas in 50 digits, next to the double precision oracle."""
    cases: list[tuple[str, dict[str, float], float]] = [
        ("phong", {"n": 1e8}, 0.5),
        ("phong", {"n": 1e8}, 1e-9),
        ("stretched_phong", {"n": 1e8}, 0.5),
        ("stretched_phong", {"n": 1e8}, 1e-4),
        ("stretched_phong", {"n": 1e8}, 1e-9),
        ("sqrt_phong", {"n": 1e8}, 1e-9),
        ("plus_phong", {"n": 1000.0}, 1e-9),
        ("retro_phong", {"n": 1000.0}, 0.01),
        ("stretched_blinn", {"n": 1e8}, 0.5),
        ("blinn", {"n": 1e8}, 1e-9),
        ("modified_ward", {"m_x": 1e-4, "m_y": 1e-4}, 0.5),
        ("modified_ward", {"m_x": 1e-4, "m_y": 1e-4}, 1e-9),
        ("ward", {"m_x": 1e-4, "m_y": 1e-4}, 1e-4),
        ("ward", {"m_x": 1e-4, "m_y": 1e-4}, 1e-9),
    ]
    entries = []
    for model, par, mu in cases:
        value, error = albedo(model, mu, **par)
        entries.append(
            {
                "model": model,
                "parameters": par,
                "mu": mu,
                "value": value,
                "error": error,
                "witness": witness(model, mu, **par),
            }
        )
        print(f"witness {entries[-1]}", file=sys.stderr, flush=True)
    return entries


SECTIONS = {
    "albedo": albedo_section,
    "extreme": extreme_section,
    "supremum": supremum_section,
    "mean": mean_section,
    "witness": witness_section,
}


def main(names: list[str]) -> None:
    """Compute the named sections (all by default) and save after each."""
    for name in names or list(SECTIONS):
        start = time.time()
        entries = SECTIONS[name]()
        store = json.loads(TARGET.read_text()) if TARGET.exists() else {}
        store[name] = entries
        ordered = {key: store[key] for key in SECTIONS if key in store}
        body = ",\n".join(
            f'"{key}": [\n' + ",\n".join(json.dumps(entry) for entry in rows) + "\n]" for key, rows in ordered.items()
        )
        TARGET.write_text("{\n" + body + "\n}\n")
        print(f"{name}: {len(entries)} entries, {time.time() - start:.0f} s", file=sys.stderr, flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
