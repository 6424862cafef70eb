#!/usr/bin/env python3
"""Makes libs/ridgemap-core/src/interpolation_table.h.

The continuous occupancy is kept at nodes of a quarter of sigma. Between them it is a weighted sum of eight nodes along
each axis. The weights are those of least mean square error for sums of Gaussians of unit width in random places
(kriging with their covariance, a Gaussian of width REACH), given as polynomials of the place between the two middle
nodes. Plain polynomial interpolation, the limit of a large REACH, is ten times less exact.

Usage: scripts/interpolation_table.py > libs/ridgemap-core/src/interpolation_table.h
"""
from decimal import Decimal as D, getcontext

getcontext().prec = 70
TAPS, DEGREE, SPACING, REACH = 8, 9, D(1) / 4, D("1.55")


def solve(a, b):
    """Gaussian elimination with partial pivoting; overwrites its arguments."""
    n = len(b)
    for c in range(n):
        p = max(range(c, n), key=lambda r: abs(a[r][c]))
        a[c], a[p], b[c], b[p] = a[p], a[c], b[p], b[c]
        for r in range(c + 1, n):
            f = a[r][c] / a[c][c]
            for k in range(c, n):
                a[r][k] -= f * a[c][k]
            b[r] -= f * b[c]
    for r in reversed(range(n)):
        b[r] = (b[r] - sum(a[r][k] * b[k] for k in range(r + 1, n))) / a[r][r]
    return b


def covariance(distance):
    return (-(distance / REACH) ** 2 / 2).exp()


def weights(t):
    """Weights of the taps at t nodes to the right of tap number TAPS/2 - 1."""
    place = [SPACING * (j - TAPS // 2 + 1) for j in range(TAPS)]
    return solve([[covariance(x - y) for y in place] for x in place], [covariance(x - SPACING * t) for x in place])


def cosine(x):
    term = total = D(1)
    for k in range(1, 60):
        term *= -x * x / ((2 * k - 1) * (2 * k))
        total += term
    return total


def main():
    pi = D("3.14159265358979323846264338327950288419716939937510582097494459")
    # Through Chebyshev points of [0, 1], as polynomials of u = t - 1/2.
    points = [cosine(pi * (2 * k + 1) / (2 * (DEGREE + 1))) / 2 for k in range(DEGREE + 1)]
    values = [weights(u + D(1) / 2) for u in points]
    columns = [solve([[u**k for k in range(DEGREE + 1)] for u in points], [v[j] for v in values]) for j in range(TAPS)]
    print("// SPDX-License-Identifier: BSD-3-Clause")
    print("// Made by scripts/interpolation_table.py, which tells what it is.")
    print("#pragma once\n\nnamespace ridgemap\n{")
    print("constexpr int interpolationDegree = %d;" % DEGREE)
    print("/** Coefficients of u^k, u = t - 1/2 in node spacings, of the weights of the eight nodes around. */")
    print("constexpr double interpolationTable[interpolationDegree + 1][%d] = {" % TAPS)
    for k in range(DEGREE + 1):
        print("\t{%s}," % ", ".join("%.17g" % float(c[k]) for c in columns))
    print("};\n}  // namespace ridgemap")


main()
