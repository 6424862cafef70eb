// SPDX-License-Identifier: BSD-3-Clause
// How far chance may have moved a ridge: the statistical part of the error of a map, beside the deterministic eps.
#pragma once

#include <ridgemap/types.h>

#include <limits>

namespace ridgemap
{
/** What a vertex of a ridge tells about its own place. */
struct RidgeUncertainty
{
	double noise = 0;    ///< estimated standard deviation s of the measurements across the wall [m]
	double kernels = 0;  ///< number of measurements that carry the vertex: (sum of kernels)^2 / sum of squares
	/** Of the place across the wall [m]; infinite where it cannot be told. */
	double standardError = std::numeric_limits<double>::infinity();
	/** Half width of the 95 % interval of the place across the wall [m]; infinite where it cannot be told. */
	double halfWidth95 = std::numeric_limits<double>::infinity();
};

/** Two-sided 95 % quantile of Student's t distribution with any number of degrees of freedom above 0.5: the expansion
 * of Cornish and Fisher from 2.5 on, within 0.6 % there; below, a power of the degrees of freedom leads on to wider
 * intervals. */
double studentQuantile95(double dof);

/** Noise across a straight wall [m] from the curvature of the density there, which is 1/(1 + (s/sigma)^2); the
 * curvature must be above 0. 0 for a density as narrow as one kernel. */
double noiseAcross(double curvature, double sigma);

/** Variance [m^2] of the offset across the wall of a ridge with occupancy L [kernels, > 0] on a straight wall with
 * normal noise s across it [m]: measurements are a Poisson process along the wall, the variance is of first order in
 * 1/L. With `density` measurements per metre
 *
 *   Var(offset) = Var(f) / (df/dy)^2 with f = <grad L, v1> = sum of -(y - y_i)/sigma^2 K_i, K = exp(-r^2/(2 sigma^2)),
 *   Var(f)      = density * integral of (y^2/sigma^4) K^2 = density sqrt(pi) s^2 / (sigma^2 + 2 s^2)^(3/2),
 *   df/dy       = -L / (sigma^2 + s^2),   L = density sqrt(2 pi) sigma^2 / sqrt(sigma^2 + s^2),
 *
 * and so, with q = s^2/sigma^2, Var(offset) = s^2 / (sqrt(2) L) * (1 + q)^(5/2) / (1 + 2 q)^(3/2). */
double offsetVariance(double occupancy, double noise, double sigma);

/** Number of measurements that carry a ridge of this occupancy: (sum of kernels)^2 / (sum of their squares). */
double effectiveMeasurements(double occupancy, double noise, double sigma);

/** Standard error and 95 % interval of the place of a ridge across the wall, from occupancy and curvature of the vertex
 * alone. As the noise is estimated from the same measurements, some of them count as used up, one for the place and
 * about half a one for the direction (confirmed by simulation down to 5 kernels), and the interval is Student's.
 *
 * Holds for independent measurements of one smooth wall that bends little over sigma; corners, walls nearer than about
 * 2 sqrt(sigma^2 + s^2), outliers and errors of the poses are not in it. Vertices that a wall pass added have none:
 * infinite. O(1); safe to call from any thread. Like all of the map it uses + - * / and sqrt only. */
RidgeUncertainty ridgeUncertainty(const VertexInfo& vertex, double sigma);

}  // namespace ridgemap
