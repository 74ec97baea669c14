#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""usage: scripts/fit_polynomials.py [--check]

Fits the polynomials of Module/Volume/Optics/MediumConstants.h, and measures the errors of those
that stand there. --check leaves out the slow fits. Fails if an error is larger than the header
says, or if the fits of the absorption give other numbers than the header.

Absorbed, (1 - exp(-t)) / t:
  Thick  the polynomial through the function's values at the seven Chebyshev points of [0, 1];
  Thin   least squares over 8001 equidistant points of [0, 1/8].
Both give the numbers of the header as single-precision numbers.

Mean, the integral over x in [0, 1] of 1 - exp(-(a x + (t - a) x^2)), for t up to 1/8 or 1 and a in
[0, 2 t]: the polynomial of total degree 3 or 5 without a constant term whose largest error is
least, by Lawson's algorithm. Thick has the exact terms of first order, t / 3 and a / 6. The numbers
of the header were fitted to the same end by a program that has not been kept. Their largest errors
are the same to 6 %, but near the optimum many polynomials are as good, so the digits differ.
"""
import math
import os
import re
import struct
import sys
from decimal import Decimal, getcontext

getcontext().prec = 40
HEADER = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "Module",
                      "Volume", "Optics", "MediumConstants.h")
PI = Decimal("3.1415926535897932384626433832795028841972")


def to_float(number):
    """The nearest single-precision number."""
    return struct.unpack("f", struct.pack("f", float(number)))[0]


def read_tables():
    """The numbers of the header, by name: a list, or a list of rows."""
    with open(HEADER, encoding="ascii") as file:
        text = file.read()
    tables = {}
    pattern = r"constexpr float (\w+)((?:\[\d+\])+) = \{([^;]*)\};"
    for name, sizes, body in re.findall(pattern, text):
        numbers = [to_float(x) for x in re.findall(r"(-?[\d.]+(?:e[+-]?\d+)?)f", body)]
        size = [int(x) for x in re.findall(r"\d+", sizes)]
        if len(size) == 2:
            numbers = [numbers[i : i + size[1]] for i in range(0, len(numbers), size[1])]
        tables[name] = numbers
    return tables


def solve(matrix, right):
    """Gauss' elimination."""
    rows = [row[:] + [value] for row, value in zip(matrix, right)]
    size = len(rows)
    for i in range(size):
        pivot = max(range(i, size), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for k in range(i + 1, size):
            factor = rows[k][i] / rows[i][i]
            for j in range(i, size + 1):
                rows[k][j] -= factor * rows[i][j]
    result = [0] * size
    for i in reversed(range(size)):
        known = sum(rows[i][j] * result[j] for j in range(i + 1, size))
        result[i] = (rows[i][size] - known) / rows[i][i]
    return result


# (1 - exp(-t)) / t -------------------------------------------------------------------------------


def absorbed_per_depth(t):
    return (1 - (-t).exp()) / t if t > 0 else Decimal(1)


def cosine(x):
    """By its series, in decimal digits."""
    total = term = Decimal(1)
    k = 0
    while abs(term) > Decimal(10) ** -38:
        term = -term * x * x / ((2 * k + 1) * (2 * k + 2))
        total += term
        k += 1
    return total


def interpolate_absorbed(size):
    """Through the Chebyshev points of [0, 1]."""
    points = [(1 - cosine(PI * (2 * i + 1) / (2 * size))) / 2 for i in range(size)]
    powers = [[t**k for k in range(size)] for t in points]
    return solve(powers, [absorbed_per_depth(t) for t in points])


def least_squares_absorbed(size, end, count):
    """Over equidistant points of [0, end]."""
    moments = [Decimal(0)] * (2 * size - 1)
    right = [Decimal(0)] * size
    for i in range(count):
        t = end * i / (count - 1)
        value = absorbed_per_depth(t)
        power = Decimal(1)
        for k in range(2 * size - 1):
            moments[k] += power
            if k < size:
                right[k] += power * value
            power *= t
    return solve([[moments[i + j] for j in range(size)] for i in range(size)], right)


def absorbed_error(table, end):
    """Largest error of t times the polynomial."""
    largest = 0.0
    for i in range(2001):
        t = end * i / 2000
        value = sum(c * t**k for k, c in enumerate(table)) * t
        largest = max(largest, abs(value + math.expm1(-t)))
    return largest


# The mean ----------------------------------------------------------------------------------------


def gauss_rule(size):
    """Points and weights of Gauss' rule on [0, 1]."""
    points = []
    weights = []
    for i in range(size):
        x = math.cos(math.pi * (i + 0.75) / (size + 0.5))
        for _ in range(50):
            before, now = 1.0, x
            for k in range(2, size + 1):
                before, now = now, ((2 * k - 1) * x * now - (k - 1) * before) / k
            slope = size * (x * now - before) / (x * x - 1.0)
            x -= now / slope
        points.append(0.5 + 0.5 * x)
        weights.append(1.0 / ((1.0 - x * x) * slope * slope))
    return points, weights


POINTS, WEIGHTS = gauss_rule(12)  # exact to rounding for exponents up to 2


def mean_absorbed(t, a):
    return sum(
        w * -math.expm1(-(a * x + (t - a) * x * x)) for x, w in zip(POINTS, WEIGHTS)
    )


def evaluate_mean(table, t, a):
    total = 0.0
    for power in reversed(range(len(table))):
        row = sum(c * t**k for k, c in enumerate(table[power]))
        total = total * a + (row * t if power == 0 else row)
    return total


def places(end, count):
    """Chebyshev points of [0, end] and of [0, 2 t], with the ends."""
    share = [0.5 - 0.5 * math.cos(math.pi * i / (count - 1)) for i in range(count)]
    return [(end * x, 2.0 * end * x * y) for x in share[1:] for y in share]


def mean_error(table, end):
    return max(abs(mean_absorbed(t, a) - evaluate_mean(table, t, a)) for t, a in places(end, 81))


def weighted_least_squares(columns, right, weights):
    """By Gram and Schmidt's method, twice for precision."""
    roots = [math.sqrt(w) for w in weights]
    basis = [[r * x for r, x in zip(roots, column)] for column in columns]
    target = [r * x for r, x in zip(roots, right)]
    size = len(basis)
    triangle = [[0.0] * size for _ in range(size)]
    projected = [0.0] * size
    for j in range(size):
        for _ in range(2):
            for i in range(j):
                part = math.fsum(x * y for x, y in zip(basis[i], basis[j]))
                triangle[i][j] += part
                basis[j] = [y - part * x for x, y in zip(basis[i], basis[j])]
        triangle[j][j] = math.sqrt(math.fsum(x * x for x in basis[j]))
        basis[j] = [x / triangle[j][j] for x in basis[j]]
        projected[j] = math.fsum(x * y for x, y in zip(basis[j], target))
        target = [y - projected[j] * x for x, y in zip(basis[j], target)]
    return solve(triangle, projected)


def fit_mean(degree, end, known, turns):
    """Lawson's algorithm. known: coefficients that are given, by powers of t and a."""
    grid = places(end, 17)
    terms = [(i, j) for j in range(degree + 1) for i in range(degree + 1 - j)]
    free = [term for term in terms if term != (0, 0) and term not in known]
    columns = [[(t / end) ** i * (a / end) ** j for t, a in grid] for i, j in free]
    right = [
        mean_absorbed(t, a) - sum(c * t**i * a**j for (i, j), c in known.items()) for t, a in grid
    ]
    weights = [1.0 / len(grid)] * len(grid)
    for _ in range(turns):
        found = weighted_least_squares(columns, right, weights)
        errors = [
            abs(y - sum(c * column[n] for c, column in zip(found, columns)))
            for n, y in enumerate(right)
        ]
        weights = [w * e for w, e in zip(weights, errors)]
        total = sum(weights)
        weights = [w / total for w in weights]
    values = dict(known)
    values.update({(i, j): c / end ** (i + j) for (i, j), c in zip(free, found)})
    return [
        [values[(i, j)] for i in range(1 if j == 0 else 0, degree + 1 - j)]
        for j in range(degree + 1)
    ]


# Report ------------------------------------------------------------------------------------------


def main(only_check):
    tables = read_tables()
    eighth = Decimal("0.125")
    # The bounds that MediumConstants.h states.
    errors = {
        "ThinAbsorbed": (absorbed_error(tables["ThinAbsorbed"], 0.125), 4.1e-9),
        "ThinMean": (mean_error(tables["ThinMean"], 0.125), 3.8e-8),
        "ThickAbsorbed": (absorbed_error(tables["ThickAbsorbed"], 1.0), 1.6e-8),
        "ThickMean": (mean_error(tables["ThickMean"], 1.0), 2.9e-7),
    }
    good = True
    for name, (error, bound) in errors.items():
        good = good and error <= bound
        print(f"{name}: largest error {error:.3e}, stated {bound:.1e}")

    def compare(name, fitted):
        nonlocal good
        same = [to_float(x) for x in fitted] == tables[name]
        good = good and same
        print(f"{name}: the fit gives {'the same floats' if same else 'OTHER NUMBERS'}")

    compare("ThickAbsorbed", interpolate_absorbed(7))
    if not only_check:
        compare("ThinAbsorbed", least_squares_absorbed(4, eighth, 8001))
        for name, degree, end, known in (
            ("ThinMean", 3, 0.125, {}),
            ("ThickMean", 5, 1.0, {(1, 0): 1.0 / 3.0, (0, 1): 1.0 / 6.0}),
        ):
            fitted = fit_mean(degree, end, known, 60)
            print(f"{name}: a fit with a largest error of {mean_error(fitted, end):.3e}")
            for row in fitted:
                print("  " + " ".join(f"{x:.10f}" for x in row))
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main("--check" in sys.argv[1:]))
