"""All that the laboratory knows of a model, gathered: what every check finds, its albedo, and how well it is sampled.

Each figure is found twice, by quadrature and by samples of the model's own sampler, which share no integration.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from albedo_lab.analysis.albedo import shape_estimate
from albedo_lab.analysis.check import Models, everyone, run
from albedo_lab.analysis.grazing import GrazingLaw, law
from albedo_lab.analysis.request import Effort, effort, orders
from albedo_lab.analysis.rows import Progress, degrees_of
from albedo_lab.analysis.sampler import VIEWERS
from albedo_lab.analysis.supremum import supremum
from albedo_lab.analysis.verdict import Finding, Subject
from albedo_lab.estimate.quadrature import quadrature
from albedo_lab.estimate.record import Estimate, Question, Tolerance, bounded
from albedo_lab.estimate.sampling import rqmc
from albedo_lab.model import no_mirror

TOLERANCE = 1e-6
"""Of the mean albedo by quadrature."""
SAMPLED = Tolerance(1e-5, 1e-5)
SAMPLES = 1 << 20
"""Samples stop at that tolerance or that number, and their interval says how far they came."""
NEAR, NEARER = 1e-3, 1e-5
"""Cosines between which the albedo's exponent is measured both ways."""
STEEP, SAMPLED_STEEP = Tolerance(0.0, 1e-8), Tolerance(1e-12, 1e-4)
"""Of the albedos there; samples cannot be asked for a share of an albedo that is 0."""
LAST = 1e-6
"""The cosine at which samples look at the end: nearer to grazing incidence they cannot rule out what may be hidden from them."""


@dataclass(frozen=True, slots=True)
class Albedo:
    """What is known of the albedo, the constant and the Dirac part in it, for one order of integration.

    largest, mu, phi
        The supremum over all directions of incidence and where it lies: mu = 0 is the limit at grazing incidence. Infinite where
        the albedo diverges there.
    mean
        2 ∫ a(mu) mu dmu.
    grazing
        The law a ~ K mu^s as mu -> 0.
    slope
        The exponent of the albedo between mu = 1e-3 and 1e-5, which samples can reach and which need not be that of the limit;
        NaN where the albedo is 0 at either.
    last
        By samples, the albedo at mu = 1e-6.
    again
        By samples, the largest albedo (`last` where that is a limit), the mean and the slope.
    """

    order: str
    largest: Estimate
    mu: float
    phi: float
    mean: Estimate
    grazing: GrazingLaw
    slope: Estimate
    last: Estimate
    again: tuple[Estimate, Estimate, Estimate]


@dataclass(frozen=True)
class Facts:
    """A model at its parameters: its findings in the order of the checks, and its albedo for every order of integration.

    `mirror` holds the reflectance of the Dirac part, by the angles of incidence in degrees at which samplers are tried; it is
    empty for a model that has none.
    """

    subject: Subject
    findings: tuple[Finding, ...]
    albedos: tuple[Albedo, ...]
    mirror: tuple[tuple[float, float], ...] = ()

    @property
    def name(self) -> str:
        """The model's name in the catalogue."""
        return self.subject.model.name

    def of(self, check: str) -> list[Finding]:
        """The findings of one check."""
        return [finding for finding in self.findings if finding.check == check]


def facts(models: Models = (), *, seed: int = 0, threads: int | None = None, progress: Progress | None = None) -> list[Facts]:
    """The facts of several models at their default parameters; by default of the whole catalogue but what needs a file.

    The checks are those of one run over all of them, judged together as `albedo-lab check --all` judges. The same seed gives the
    same bits, whatever the number of threads. `progress` is called with the number of steps done and of all. Raises BadInput for
    an unknown model.
    """
    models = everyone() if isinstance(models, Sequence) and not models else models
    want = effort(TOLERANCE, "quadrature", seed, threads)
    told = run(models, {}, seed=seed, threads=threads, progress=progress)
    grouped = itertools.groupby(told, key=lambda pair: pair[0])
    return [_gathered(subject, [finding for _, finding in pairs], want) for subject, pairs in grouped]


def _gathered(subject: Subject, findings: Sequence[Finding], want: Effort) -> Facts:
    """The facts of one subject."""
    model, p = subject.model, subject.p
    mirror = [(degrees_of(mu), float(model.mirror(p, mu)) * subject.scale.value) for mu in VIEWERS]
    with np.errstate(all="ignore"):
        albedos = tuple(_albedo(subject, order, want) for order in orders(model))
    return Facts(subject, tuple(findings), albedos, () if model.mirror is no_mirror else tuple(mirror))


def _albedo(subject: Subject, order: str, want: Effort) -> Albedo:
    """All about the albedo in one order."""
    peak = supremum(subject.model, subject.p, order)
    everywhere = Question(subject.model, subject.p, None, order=order)
    at_last = replace(everywhere, mu=LAST, phi=peak.phi)
    near, nearer = (replace(everywhere, mu=mu) for mu in (NEAR, NEARER))
    last = _sampled(at_last, SAMPLED, want).scaled(subject.scale)
    return Albedo(
        order,
        peak.value.scaled(subject.scale),
        peak.mu,
        peak.phi,
        shape_estimate(everywhere, subject.scale, want).scaled(subject.scale),
        law(subject, order),
        _slope(quadrature(near, STEEP), quadrature(nearer, STEEP)),
        last,
        (
            _sampled(replace(at_last, mu=peak.mu), SAMPLED, want).scaled(subject.scale) if peak.mu else last,
            _sampled(everywhere, SAMPLED, want).scaled(subject.scale),
            _slope(_sampled(near, SAMPLED_STEEP, want), _sampled(nearer, SAMPLED_STEEP, want)),
        ),
    )


def _sampled(question: Question, within: Tolerance, want: Effort) -> Estimate:
    """The shape's albedo by samples."""
    return rqmc(question, within, want.seed, want.threads, SAMPLES)


def _slope(near: Estimate, nearer: Estimate) -> Estimate:
    """The exponent of the albedo between two cosines: that it scales with the constant does not matter."""
    samples = near.samples + nearer.samples
    if not (near.value > 0.0 and nearer.value > 0.0 and math.isfinite(near.value + nearer.value)):
        return bounded(math.nan, math.nan, samples, near.method)
    decades = math.log(NEAR / NEARER)
    bound = (near.half_width / near.value + nearer.half_width / nearer.value) / decades
    return bounded(math.log(near.value / nearer.value) / decades, bound, samples, near.method)
