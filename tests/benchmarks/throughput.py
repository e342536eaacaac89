"""Samples a second: every model of the catalogue by itself, then two of them against NumPy, C++ and Mitsuba."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from statistics import median

from albedo_lab.analysis.clock import WALL, Measure, interleave, ratio, timed
from albedo_lab.catalogue import find, names
from tests.benchmarks import baseline_cpp, baseline_numpy
from tests.benchmarks.baseline_mitsuba import Mitsuba
from tests.benchmarks.moments import Moments
from tests.benchmarks.subjects import MU, SUBJECTS, THETA_DEG, Subject, averaging, processors
from tests.benchmarks.tables import digits, rate, table, verdict

METHODS = {"rqmc": True, "mc": False}
WEIGHTS = {"contract": True, "reduced": False}


def catalogue(quick: bool) -> str:
    """Samples/s per model, method and weight, on one thread (CPU time) and on all (wall time)."""
    samples = 1 << (18 if quick else 20)
    threads = processors()
    measures: dict[str, Measure] = {}
    with ThreadPoolExecutor(threads) as pool:
        for name in names():
            model = find(name)
            for method, scrambled in METHODS.items():
                for weight, generic in WEIGHTS.items():
                    if generic or model.weight is not None:
                        run = averaging(model, model.bind({}), samples, scrambled, generic)
                        measures[f"{name} {method} {weight} one"] = timed(run)
                        measures[f"{name} {method} {weight} all"] = timed(everywhere(run, pool, threads), WALL)
        times = interleave(measures, 3 if quick else 9)

    def cell(key: str, share: int) -> str:
        if key not in times:
            return ""
        return rate(samples * share, min(times[key]) if key.endswith("all") else median(times[key]))

    columns = [(m, w, t) for m in METHODS for w in WEIGHTS for t in ("one", "all")]
    head = ["model", *(f"{m} {w}, {1 if t == 'one' else threads} thr." for m, w, t in columns)]
    rows = [[name, *(cell(f"{name} {m} {w} {t}", 1 if t == "one" else threads) for m, w, t in columns)] for name in names()]
    return (
        f"## Samples a second, in millions, per model at {THETA_DEG} degrees, default parameters\n\n"
        "`contract`: sample, evaluate, pdf; `reduced`: the weight f cos / pdf reduced by hand, where a model has one. "
        "One thread: CPU time, median; all threads: wall time, the round that other programs disturbed least.\n\n"
        + table(head, rows)
    )


def everywhere(run: Callable[[], Moments], pool: ThreadPoolExecutor, threads: int) -> Callable[[], object]:
    """The same work once on every thread."""
    return lambda: [job.result() for job in [pool.submit(run) for _ in range(threads)]]


def against_others(quick: bool) -> str:
    """Samples/s against NumPy, C++ and Mitsuba, with every contender's albedo beside quadrature's."""
    mitsuba = Mitsuba(1 << (18 if quick else 22))
    try:
        parts = [one_subject(subject, mitsuba, quick) for subject in SUBJECTS]
    finally:
        mitsuba.close()
    return (
        f"## Samples a second against others at {THETA_DEG} degrees, float64, one thread\n\n"
        "All compute the mean of f cos / pdf with the same density and reject what falls below the horizon; "
        "z: how many of its standard errors a contender's albedo is off quadrature's. "
        "deviation: of one sample weight; the same estimator has the same. "
        f"C++: {baseline_cpp.compiler_version()}; {mitsuba.state}\n\n" + "\n\n".join(parts)
    )


def contenders(subject: Subject, quick: bool) -> dict[str, Callable[[], Moments]]:
    """Everything that estimates the same albedo by the same samples."""
    samples = 1 << (18 if quick else 20)
    arrays = 1_000_000  # a user's; not made smaller by --quick
    where = (subject.name, subject.value, MU)
    found: dict[str, Callable[[], Moments]] = {
        "albedo_lab mc, contract": subject.sampler(samples),
        "albedo_lab mc, reduced": subject.sampler(samples, generic=False),
        "albedo_lab rqmc, contract": subject.sampler(samples, scrambled=True),
        "albedo_lab rqmc, reduced": subject.sampler(samples, scrambled=True, generic=False),
        "NumPy, arrays of 1e6": lambda: baseline_numpy.estimate(*where, arrays, 1),
        "NumPy, arrays of 2^14": lambda: baseline_numpy.estimate(*where, samples, 1, 1 << 14),
    }
    if baseline_cpp.compiler() is None:
        return found

    def cpp(flags: tuple[str, ...], fast_random: bool, reduced: bool = False) -> Callable[[], Moments]:
        return lambda: baseline_cpp.estimate(*where, samples, 1, flags, fast_random, reduced)

    return found | {
        "C++ -O3, mt19937_64": cpp(baseline_cpp.PLAIN, False),
        "C++ -O3, xoshiro256+": cpp(baseline_cpp.PLAIN, True),
        "C++ -O3 -march=native, xoshiro256+": cpp(baseline_cpp.NATIVE, True),
        "C++ -Ofast -march=native, xoshiro256+": cpp(baseline_cpp.FAST, True),
        "C++ -O3, xoshiro256+, reduced": cpp(baseline_cpp.PLAIN, True, True),
    }


def one_subject(subject: Subject, mitsuba: Mitsuba, quick: bool) -> str:
    runs = contenders(subject, quick)
    answers = {name: run() for name, run in runs.items()}
    times = interleave({name: timed(run) for name, run in runs.items()} | mitsuba.measures(), 5 if quick else 15)
    samples = {name: answer.samples for name, answer in answers.items()} | dict.fromkeys(mitsuba.measures(), mitsuba.samples)
    per_sample = {name: [t / samples[name] for t in found] for name, found in times.items()}
    generic, reduced = "albedo_lab mc, contract", "albedo_lab mc, reduced"
    rows = []
    for name in times:
        answer = answers.get(name)
        z = ""  # scrambled Sobol points have another standard error than their deviation says
        if answer and "rqmc" not in name:
            z = f"{(answer.mean - subject.albedo / subject.scale) / answer.standard_error:+.1f}"
        rows.append(
            [
                name,
                rate(1, median(per_sample[name])),
                digits(ratio(per_sample, name, generic).value),
                digits(ratio(per_sample, name, reduced).value),
                f"{answer.mean * subject.scale:.5f}" if answer else digits(mitsuba.albedo, 5),
                f"{answer.standard_error * subject.scale:.1e}" if answer and z else "",
                z,
                f"{answer.deviation * subject.scale:.4f}" if answer else "",
            ]
        )
    head = [
        "contender",
        "M samples/s",
        "contract is faster by",
        "reduced by",
        "albedo",
        "standard error",
        "z",
        "deviation",
    ]
    # the fastest of the plain builds is the one to beat, whichever generator it uses
    plain = [name for name in ("C++ -O3, mt19937_64", "C++ -O3, xoshiro256+") if name in times]
    lines = [f"### {subject}; quadrature: {subject.albedo:.6f}", "", table(head, rows), ""]
    for label, against, wanted in (
        ("C++ -O3", plain, (2.0, 4.0)),
        ("NumPy", ["NumPy, arrays of 1e6"], (4.0, 8.0)),
    ):
        for ours, least in zip((generic, reduced), wanted, strict=True):
            if against:
                lines.append(f"- {ours} over {label}: {verdict(min(ratio(per_sample, n, ours).value for n in against), least)}")
    return "\n".join(lines)
