"""The templates behind the check of a sampler: one draws directions and counts them by cell, one integrates over the cells.

A direction above the horizon is written by its chord e = sqrt(1 - mu) and its azimuth in turns: solid angle is 4 pi e de dturn,
a lobe at the normal is as smooth as any other, and neither coordinate loses digits to 1 - mu.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from math import atan2, cos, floor, pi, sin, sqrt
from typing import Any

import numpy as np

from albedo_lab.kernels.jit import Placeholder, specialise
from albedo_lab.kernels.uniforms import philox
from albedo_lab.model import Model
from albedo_lab.optics.frame import Direction
from albedo_lab.optics.lobes import sample_cosine

OWN, REDUCED, COSINE, UNIFORM, PILOT = range(5)
"""What is drawn: wi by the model, the weight reduced by hand, cosine and uniform sampling, and the model once more."""
REJECTED, CROOKED, BAD_DENSITY, BAD_WEIGHT, LARGEST_F, LARGEST_F_COS = range(6)
"""What is told of the draws: three faults, with a witness each, and the largest f and f cos that were met."""
TOLD = 6
FIRST_FAULT, LAST_FAULT = CROOKED, BAD_WEIGHT
LARGEST = 1.7976931348623157e308
UNIT = 1e-9
"""By how much the square of a direction's length may be off."""

LOW_E, HIGH_E, LOW_TURN, HIGH_TURN, START, FIRST, END = range(7)
MASS, MASS_ERROR, FLUX, FLUX_ERROR = range(4)
"""Integrals over a cell: of the density, and of f cos."""
NODES = np.array([-0.9604912687080203, -0.7745966692414834, -0.4342437493468026, 0.0])
NODES = np.concatenate([NODES, -NODES[2::-1]])
KRONROD = 0.5 * np.array([0.1046562260264673, 0.2684880898683334, 0.4013974147759622, 0.4509165386584741])
KRONROD = np.concatenate([KRONROD, KRONROD[2::-1]])
GAUSS = 0.5 * np.array([0.0, 5.0 / 9.0, 0.0, 8.0 / 9.0, 0.0, 5.0 / 9.0, 0.0])
POINTS = len(NODES)
PANELS = 512
"""Panels that a cell may cost: enough for a step of the density across it."""
FEW = 100.0
"""Samples in the count whose noise is the least that a panel's error is held against."""
DEEP = 200
NARROWEST = 1e-13
CROWD = 4
"""More of the pilot's points than that in one panel, and it is cut before anything else is known of it."""

Parameters = Placeholder("Parameters")
evaluate = Placeholder("evaluate")
sample = Placeholder("sample")
pdf = Placeholder("pdf")
weight = Placeholder("weight")


def no_weight(p, wo, u1, u2):
    """For a model without a weight reduced by hand: it is never asked for."""
    return 0.0


def sample_uniform(u1, u2):
    """A direction with density 1 / (2 pi)."""
    s = sqrt((1.0 - u1) * (1.0 + u1))
    return Direction(s * cos(2.0 * pi * u2), s * sin(2.0 * pi * u2), u1)


def place(edges, x):
    """The last index, of those that begin a cell, whose edge is not above x."""
    low, high = 0, len(edges) - 1
    while high - low > 1:
        middle = (low + high) // 2
        if edges[middle] <= x:
            low = middle
        else:
            high = middle
    return low


def draw(kind, first, key, values, direction, rows, starts, edges, counts, weights, told, witness, record):
    """One weight per direction drawn, from number `first` on; counts, told and witness are added to.

    rows: edges in e. starts: the azimuth at which each row begins. edges: (rows, ...), edges in azimuth from there, padded with
    infinity. witness: (faults, 5): x, y, z, f, density of the first of each. record: (n, 2) or empty; of the pilot e and azimuth,
    left alone where rejected; of the others first the weight that the model's own sampler would have had there.
    """
    p = Parameters(*values)
    wo = Direction(direction[0], direction[1], direction[2])
    for j in range(len(weights)):
        u1, u2 = philox(np.uint32(first + j), np.uint32(kind), key)
        if kind == COSINE:
            wi = sample_cosine(u1, u2)
        elif kind == UNIFORM:
            wi = sample_uniform(u1, u2)
        else:
            wi = sample(p, wo, u1, u2)
        crooked = not abs(wi.x * wi.x + wi.y * wi.y + wi.z * wi.z - 1.0) <= UNIT
        above = wi.z > 0.0
        density = pdf(p, wi, wo)
        f = evaluate(p, wi, wo)
        w = f * wi.z / density if above else 0.0
        if kind == COSINE:
            w = pi * f
        elif kind == UNIFORM:
            w = 2.0 * pi * f * wi.z
        elif kind == REDUCED:
            w = weight(p, wo, u1, u2)
        weights[j] = w
        if len(record) > 0:
            record[j, 0] = f * wi.z / density
        own = kind == OWN or kind == PILOT
        bad_density = above and (not 0.0 <= density <= LARGEST or (own and density == 0.0))
        bad_weight = not abs(w) <= LARGEST
        told[REJECTED] += not above
        for fault in range(FIRST_FAULT, LAST_FAULT + 1):
            if (fault == CROOKED and crooked) or (fault == BAD_DENSITY and bad_density) or (fault == BAD_WEIGHT and bad_weight):
                if told[fault] == 0.0:
                    at = witness[fault - FIRST_FAULT]
                    at[0], at[1], at[2], at[3], at[4] = wi.x, wi.y, wi.z, f, density
                told[fault] += 1.0
        if above and not crooked:
            told[LARGEST_F] = max(told[LARGEST_F], abs(f))
            told[LARGEST_F_COS] = max(told[LARGEST_F_COS], abs(f) * wi.z)
            if own:
                e = sqrt((wi.x * wi.x + wi.y * wi.y) / (1.0 + wi.z))
                turn = atan2(wi.y, wi.x) / (2.0 * pi)
                row = place(rows, e)
                turn -= starts[row]
                turn -= floor(turn)
                counts[row, place(edges[row], turn)] += 1
                if len(record) > 0:
                    record[j, 0], record[j, 1] = e, turn


def panel(low_e, high_e, low_turn, high_turn, start, p, wo, answer):
    """Both integrals over a panel into answer: value and error of each, and 1 where it is the azimuth that errs more."""
    middle_e, half_e = 0.5 * (low_e + high_e), 0.5 * (high_e - low_e)
    middle, half = 0.5 * (low_turn + high_turn), 0.5 * (high_turn - low_turn)
    for k in range(5):
        answer[k] = 0.0
    mass_e, mass_turn, flux_e, flux_turn = 0.0, 0.0, 0.0, 0.0
    for j in range(POINTS):
        phi = 2.0 * pi * (start + middle + half * NODES[j])
        c, s = cos(phi), sin(phi)
        for i in range(POINTS):
            e = middle_e + half_e * NODES[i]
            z = (1.0 - e) * (1.0 + e)
            across = e * sqrt(1.0 + z)
            wi = Direction(across * c, across * s, z)
            density = e * pdf(p, wi, wo)
            flux = e * z * evaluate(p, wi, wo)
            answer[MASS] += KRONROD[i] * KRONROD[j] * density
            answer[FLUX] += KRONROD[i] * KRONROD[j] * flux
            mass_e += GAUSS[i] * KRONROD[j] * density
            flux_e += GAUSS[i] * KRONROD[j] * flux
            mass_turn += KRONROD[i] * GAUSS[j] * density
            flux_turn += KRONROD[i] * GAUSS[j] * flux
    area = 4.0 * pi * (high_e - low_e) * (high_turn - low_turn)
    by_e, by_turn = abs(answer[MASS] - mass_e), abs(answer[MASS] - mass_turn)
    flux_by_e, flux_by_turn = abs(answer[FLUX] - flux_e), abs(answer[FLUX] - flux_turn)
    answer[MASS_ERROR] = (by_e + by_turn) * area
    answer[FLUX_ERROR] = (flux_by_e + flux_by_turn) * area
    # each error as a share of its own integral: whichever of both is the harder says where to cut
    size, flux_size = abs(answer[MASS]) + 1e-300, abs(answer[FLUX]) + 1e-300
    answer[4] = by_turn / size + flux_by_turn / flux_size > by_e / size + flux_by_e / flux_size
    answer[MASS] *= area
    answer[FLUX] *= area


def imbalance(x, first, end, cut):
    """How many more of some numbers lie on one side of the cut than on the other."""
    below = 0
    for i in range(first, end):
        below += x[i] < cut
    return abs(2 * below - (end - first))


def parted(points, along, first, end, cut):
    """Brings the points below the cut to the front; where the others begin."""
    i, j = first, end
    while i < j:
        if points[along, i] < cut:
            i += 1
        else:
            j -= 1
            for k in range(2):
                points[k, i], points[k, j] = points[k, j], points[k, i]
    return i


def integrate(values, direction, cells, points, samples, precision, flux, integrals):
    """Mass and flux of every cell, with their errors.

    cells: (n, 7), box, azimuth of its row, and which of the points lie in it. points: (2, m), e and azimuth of a pilot, which are
    put into another order. A panel is cut in two until it holds no crowd of them, so that no lobe that is ever sampled slips
    through between the nodes, then until its error is under `precision` standard deviations of the count of `samples` samples in
    it, and under a thousandth of its flux or a millionth of `flux`.
    """
    p = Parameters(*values)
    wo = Direction(direction[0], direction[1], direction[2])
    stack = np.empty((DEEP, 6))
    found = np.empty(5)
    for cell in range(len(cells)):
        start = cells[cell, START]
        for k in range(4):
            stack[0, k] = cells[cell, k]
            integrals[cell, k] = 0.0
        stack[0, 4], stack[0, 5] = cells[cell, FIRST], cells[cell, END]
        depth, used = 1, 0
        while depth > 0:
            depth -= 1
            low_e, high_e, low, high = stack[depth, 0], stack[depth, 1], stack[depth, 2], stack[depth, 3]
            first, end = int(stack[depth, 4]), int(stack[depth, 5])
            wide = high_e - low_e > NARROWEST and high - low > NARROWEST and depth + 2 <= DEEP
            if end - first > CROWD and wide:
                # across the direction in which the points are the less evenly spread
                uneven = imbalance(points[0], first, end, 0.5 * (low_e + high_e))
                across = imbalance(points[1], first, end, 0.5 * (low + high)) >= uneven
            else:
                panel(low_e, high_e, low, high, start, p, wo, found)
                used += 1
                exact = not found[MASS_ERROR] > precision * sqrt(max(abs(found[MASS]), FEW / samples) / samples)
                exact_flux = not found[FLUX_ERROR] > 1e-3 * abs(found[FLUX]) + 1e-6 * flux
                if (exact and exact_flux) or used + depth >= PANELS or not wide:
                    integrals[cell, MASS] += found[MASS]
                    integrals[cell, FLUX] += found[FLUX]
                    integrals[cell, MASS_ERROR] += found[MASS_ERROR] * found[MASS_ERROR]
                    integrals[cell, FLUX_ERROR] += found[FLUX_ERROR] * found[FLUX_ERROR]
                    continue
                across = found[4] > 0.0
            cut = 0.5 * (low + high) if across else 0.5 * (low_e + high_e)
            middle = parted(points, 1 if across else 0, first, end, cut)
            for half in range(2):
                box = stack[depth]
                box[0], box[1], box[2], box[3] = low_e, high_e, low, high
                box[4], box[5] = (first, middle) if half == 0 else (middle, end)
                box[(2 if across else 0) + 1 - half] = cut
                depth += 1
        # where it is not small, along a step or a kink, a panel's error has either sign
        integrals[cell, MASS_ERROR] = sqrt(integrals[cell, MASS_ERROR])
        integrals[cell, FLUX_ERROR] = sqrt(integrals[cell, FLUX_ERROR])


@cache
def drawing_kernel(model: Model) -> Callable[..., Any]:
    """`draw` for one model."""
    return specialise(
        draw,
        Parameters=model.parameters_type,
        evaluate=model.evaluate,
        sample=model.sample,
        pdf=model.pdf,
        weight=model.weight or no_weight,
    )


@cache
def cell_kernel(model: Model) -> Callable[..., Any]:
    """`integrate` for one model."""
    return specialise(integrate, Parameters=model.parameters_type, evaluate=model.evaluate, pdf=model.pdf)
