"""Estimates with confidence intervals from a few independent runs.

Errors of renderings are positive and spread over powers of ten, so means and intervals are those of logarithms; with few runs
the quantiles are Student's. Nothing here knows of files or scenes.
"""

import math
from dataclasses import dataclass

import numpy


def t_limit(chance, freedom):
    """The number that |t| exceeds with probability `chance`, of whole degrees of freedom (Abramowitz and Stegun 26.7.3 and
    26.7.4, solved by bisection over the angle)."""

    def inside(angle):
        term, total, odd = 1.0, 0.0, freedom % 2
        for k in range(2 + odd, freedom + 1, 2):
            total += term
            term *= (k - 1) / k * math.cos(angle) ** 2
        if not odd:
            return math.sin(angle) * total
        return 2 / math.pi * (angle + math.sin(angle) * math.cos(angle) * total)

    low, high = 0.0, math.pi / 2
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if inside(middle) < 1 - chance else (low, middle)
    return math.sqrt(freedom) * math.tan(low)


@dataclass(frozen=True)
class Estimate:
    """A value with the ends of its confidence interval, of 95 % if nothing else is said; the ends are None if one run alone was made."""

    value: float
    low: float | None
    high: float | None

    def as_json(self):
        return {"value": self.value, "low": self.low, "high": self.high}


def mean(values, chance=0.05):
    """Arithmetic mean of runs; `chance`: that the interval misses the truth."""
    values = numpy.asarray(values, float)
    centre = float(values.mean())
    if len(values) < 2:
        return Estimate(centre, None, None)
    half = t_limit(chance, len(values) - 1) * float(values.std(ddof=1)) / math.sqrt(len(values))
    return Estimate(centre, centre - half, centre + half)


def geometric_mean(values, chance=0.05):
    """Geometric mean of runs, all above 0."""
    e = mean(numpy.log(values), chance)
    return Estimate(*(None if x is None else math.exp(x) for x in (e.value, e.low, e.high)))


def paired_ratio(values, baseline, chance=0.05):
    """Geometric mean of the ratios of runs that were made one after the other: what slowed both, as other work on the machine
    did, is no part of their spread."""
    return geometric_mean(numpy.asarray(values, float) / numpy.asarray(baseline, float), chance)


def slope(curves):
    """Slope of log(error) over log(work), fitted to each run by least squares, then averaged: the points of one run hold the
    same samples and depend on each other, runs do not."""
    slopes = [numpy.polyfit(numpy.log(work), numpy.log(error), 1)[0] for work, error in curves]
    return mean(slopes)


def error_at(work, error, at):
    """A run's error at a given amount of work, on straight lines between its points in logarithms; None beyond them."""
    if not work[0] <= at <= work[-1]:
        return None
    return math.exp(numpy.interp(math.log(at), numpy.log(work), numpy.log(error)))


def work_to_reach(work, error, target):
    """Work at which a run's error first is `target`, and whether it was reached: if not, its last point goes on with the error
    as one over the work, as for independent samples."""
    for i, e in enumerate(error):
        if e > target:
            continue
        if i == 0:
            return work[0], True
        part = math.log(error[i - 1] / target) / math.log(error[i - 1] / e)
        return work[i - 1] * (work[i] / work[i - 1]) ** part, True
    return work[-1] * error[-1] / target, False
