"""Time to a given accuracy: scrambled Sobol points, plain Monte Carlo, quadrature, and SciPy's integrators."""

from __future__ import annotations

from collections.abc import Callable
from itertools import count
from statistics import median

from albedo_lab.analysis.clock import Times, interleave, ratio, timed
from albedo_lab.estimate.record import NORMAL_975, Estimate
from albedo_lab.estimate.sampling import monte_carlo, rqmc
from tests.benchmarks.baseline_scipy import by_cubature, by_dblquad
from tests.benchmarks.subjects import MU, SUBJECTS, Subject
from tests.benchmarks.tables import digits, seconds, table, verdict

ACCURACIES = (1e-4, 1e-5, 1e-6, 1e-9)
RANDOM = (1e-4, 1e-5, 1e-6)
"""The accuracies that sampling is asked for."""
MEASURED = 1e-4
"""Down to here plain Monte Carlo is run; beyond, its time follows from its measured variance and rate."""
TIGHTEST = 1e-14
SCIPY = {
    "dblquad, plain": (by_dblquad, False),
    "dblquad, careful": (by_dblquad, True),
    "cubature, plain": (by_cubature, False),
    "cubature, careful": (by_cubature, True),
}


def time_to_accuracy(quick: bool) -> str:
    return (
        "## Time to an accuracy at 60 degrees, one thread, CPU time\n\n"
        "Half-width of the 95 % interval (rqmc, mc) or bound (quadrature) of the albedo, constant included; for SciPy "
        "`epsabs`, tightened tenfold until the error is as small as asked. "
        "In brackets the error actually made, against quadrature to 1e-13. "
        "`plain`: whole hemisphere in spherical coordinates; `careful`: symmetry used, split at the kink of max(). "
        "`≈`: extrapolated from the measured variance and rate.\n\n"
        + "\n\n".join(one_subject(subject, quick) for subject in SUBJECTS)
    )


def one_subject(subject: Subject, quick: bool) -> str:
    runs = contenders(subject)
    errors = {key: abs(run() - subject.albedo) for key, run in runs.items()}
    random = subject.sampler(1 << (18 if quick else 21), generic=False)
    measures = {str(key): timed(run) for key, run in runs.items()} | {"rate": timed(random)}
    times = interleave(measures, 3 if quick else 7)
    moments = random()
    for tolerance in RANDOM:
        needed = (NORMAL_975 * moments.deviation * subject.scale / tolerance) ** 2
        times[f"mc {tolerance}"] = [t / moments.samples * needed for t in times["rate"]]

    def cell(method: str, tolerance: float) -> str:
        if (method, tolerance) in runs:
            return f"{seconds(median(times[str((method, tolerance))]))} ({errors[method, tolerance]:.0e})"
        return f"≈ {seconds(median(times[f'mc {tolerance}']))}" if (method, tolerance) in EXTRAPOLATED else ""

    methods = ["rqmc", "mc", "quadrature", *SCIPY]
    rows = [[method, *(cell(method, tolerance) for tolerance in ACCURACIES)] for method in methods]
    head = ["method", *(f"{tolerance:.0e}" for tolerance in ACCURACIES)]
    return "\n".join([f"### {subject}", "", table(head, rows), "", *ratios(times)])


EXTRAPOLATED = {("mc", tolerance) for tolerance in RANDOM if tolerance < MEASURED}


def contenders(subject: Subject) -> dict[tuple[str, float], Callable[[], float]]:
    """Whatever is really run, by method and accuracy. Sampling takes another seed at every call."""
    runs: dict[tuple[str, float], Callable[[], float]] = {}
    for tolerance in ACCURACIES:
        if tolerance in RANDOM:
            runs["rqmc", tolerance] = sampling(rqmc, subject, tolerance)
        if tolerance >= MEASURED:
            runs["mc", tolerance] = sampling(monte_carlo, subject, tolerance)
        runs["quadrature", tolerance] = subject.integral(tolerance)
        for method, (integrate, careful) in SCIPY.items():
            runs[method, tolerance] = accurate(integrate, careful, subject, tolerance)
    return runs


def sampling(estimator: Callable[..., Estimate], subject: Subject, tolerance: float) -> Callable[[], float]:
    seeds = count(1)

    def run() -> float:
        return estimator(subject.question, subject.tolerance(tolerance), next(seeds), 1).value * subject.scale

    return run


def accurate(integrate: Callable[..., float], careful: bool, subject: Subject, accuracy: float) -> Callable[[], float]:
    """The integrator with the loosest tolerance, from `accuracy` down in tens, whose error is within it."""
    asked = accuracy
    while abs(value(integrate, careful, subject, asked) - subject.albedo) > accuracy and asked > TIGHTEST:
        asked /= 10.0
    return lambda: value(integrate, careful, subject, asked)


def value(integrate: Callable[..., float], careful: bool, subject: Subject, tolerance: float) -> float:
    return integrate(subject.name, subject.value, MU, tolerance, careful)


def ratios(times: Times) -> list[str]:
    """What the table must show."""
    plain, fine = "dblquad, plain", 1e-9
    lines = [f"- plain Monte Carlo over rqmc at 1e-06: {verdict(ratio(times, 'mc 1e-06', str(('rqmc', 1e-6))).value, 10_000.0)}"]
    quadrature = str(("quadrature", fine))
    lines.append(f"- {plain} over quadrature at 1e-09: {verdict(ratio(times, str((plain, fine)), quadrature).value, 100.0)}")
    others = [method for method in SCIPY if method != plain]
    return lines + [
        f"- {method} over quadrature at 1e-09: {digits(ratio(times, str((method, fine)), quadrature).value)}x"
        for method in others
    ]
