"""Mitsuba 3, where it is installed: another model, for scale only.

Mitsuba has neither a stretched Phong nor a Ward model, so this times its own rough conductor (Beckmann, alpha 0.1,
normals drawn from the whole distribution) on one thread of its LLVM back end in float32. It runs in a process of its
own, since an LLVM that it cannot use aborts the process rather than raising.
"""

from __future__ import annotations

import subprocess
import sys
import time
from importlib.util import find_spec
from math import nan, pi, sin
from pathlib import Path

from albedo_lab.analysis.clock import Measure

KINDS = {
    "contract": "Mitsuba, Beckmann, contract (another model)",
    "reduced": "Mitsuba, Beckmann, sample() weight (another model)",
}


class Mitsuba:
    """The worker process; without Mitsuba, or when its back end does not start, it has nothing to measure."""

    def __init__(self, samples: int) -> None:
        self.samples = samples
        self.albedo = nan
        self.version = ""
        self.process: subprocess.Popen[str] | None = None
        if find_spec("mitsuba") is None:
            self.state = "Mitsuba is not installed."
            return
        self.process = subprocess.Popen(
            [sys.executable, "-m", "tests.benchmarks.baseline_mitsuba", str(samples)],
            cwd=Path(__file__).parents[2],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        ready = self._answer()
        self.state = f"Mitsuba {ready} llvm_ad_mono, float32, process CPU time."
        if not ready:
            self.state = "Mitsuba is installed, but its LLVM back end does not run here (too old an LLVM, or none)."
            self.close()

    def measures(self) -> dict[str, Measure]:
        if self.process is None:
            return {}
        return {label: lambda kind=kind: self._measure(kind) for kind, label in KINDS.items()}  # type: ignore[misc]

    def close(self) -> None:
        if self.process is not None:
            self.process.communicate()
            self.process = None

    def _answer(self) -> str:
        assert self.process is not None
        assert self.process.stdout is not None
        return self.process.stdout.readline().strip()

    def _measure(self, kind: str) -> float:
        assert self.process is not None
        assert self.process.stdin is not None
        self.process.stdin.write(f"{kind}\n")
        self.process.stdin.flush()
        seconds, albedo = self._answer().split()
        self.albedo = float(albedo)
        return float(seconds)


def work(samples: int) -> None:
    """Says its version when ready, then answers each line (contract, reduced) by its CPU time and the albedo."""
    import drjit as dr
    import mitsuba as mi

    mi.set_variant("llvm_ad_mono")
    dr.set_thread_count(1)
    bsdf = mi.load_dict(
        {
            "type": "roughconductor",
            "distribution": "beckmann",
            "alpha": 0.1,
            "material": "none",
            "sample_visible": False,
        }
    )

    def estimate(kind: str) -> float:
        random = mi.PCG32(size=samples)
        si = dr.zeros(mi.SurfaceInteraction3f, samples)
        si.wi = mi.Vector3f(sin(pi / 3.0), 0.0, 0.5)
        u1, u2 = random.next_float32(), mi.Point2f(random.next_float32(), random.next_float32())
        context = mi.BSDFContext()
        drawn, weight = bsdf.sample(context, si, u1, u2)
        if kind == "reduced":
            return float(dr.mean(weight[0]).numpy()[0])
        f, density = bsdf.eval(context, si, drawn.wo)[0], bsdf.pdf(context, si, drawn.wo)
        return float(dr.mean(dr.select(density > 0.0, f / density, 0.0)).numpy()[0])

    for kind in KINDS:
        estimate(kind)
    print(mi.__version__, flush=True)
    for line in sys.stdin:
        start = time.process_time()
        albedo = estimate(line.strip())
        print(time.process_time() - start, albedo, flush=True)


if __name__ == "__main__":
    work(int(sys.argv[1]))
