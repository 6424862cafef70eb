// SPDX-License-Identifier: BSD-3-Clause
// How far chance may have moved a ridge: the statistical part of the error of a map, beside the deterministic eps.
#pragma once

#include <ridgemap/types.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ridgemap
{
/** What a vertex of a ridge tells about its own place. */
struct RidgeUncertainty
{
	double noise = 0;          ///< estimated standard deviation s of the measurements across the wall [m]
	double kernels = 0;        ///< number of measurements that carry the vertex: (sum of kernels)^2 / sum of squares
	double standardError = 0;  ///< of the place across the wall [m]; infinite where it cannot be told
	double halfWidth95 = 0;    ///< half width of the 95 % interval [m]; infinite where it cannot be told
};

/** Two-sided 95 % quantile of Student's t distribution with any number of degrees of freedom above 0.5: the expansion
 * of Cornish and Fisher from 2.5 on, within 0.5 % there; below, the closed form of a Cauchy distribution leads over. */
inline double studentQuantile95(double dof)
{
	const double z = 1.959963984540054, z2 = z * z, n = dof < 2.5 ? 2.5 : dof;
	const double g1 = z * (z2 + 1) / 4, g2 = z * ((5 * z2 + 16) * z2 + 3) / 96;
	const double g3 = z * (((3 * z2 + 19) * z2 + 17) * z2 - 15) / 384;
	const double g4 = z * ((((79 * z2 + 776) * z2 + 1482) * z2 - 1920) * z2 - 945) / 92160;
	const double t = z + (g1 + (g2 + (g3 + g4 / n) / n) / n) / n;
	return dof < 2.5 ? t * std::pow(2.5 / dof, 1.2) : t;
}

/** Variance of the offset of a ridge on a straight wall with `density` measurements per metre (a Poisson process) and
 * normal noise s across it, to first order in 1/density:
 *
 *   Var(offset) = Var(f) / (df/dy)^2 with f = <grad L, v1> = sum of -(y - y_i)/sigma^2 K_i, K = exp(-r^2/(2 sigma^2)),
 *   Var(f)      = density * integral of (y^2/sigma^4) K^2 = density sqrt(pi) s^2 / (sigma^2 + 2 s^2)^(3/2),
 *   df/dy       = -L / (sigma^2 + s^2),   L = density sqrt(2 pi) sigma^2 / sqrt(sigma^2 + s^2),
 *
 * and so, with q = s^2/sigma^2, Var(offset) = s^2 / (sqrt(2) L) * (1 + q)^(5/2) / (1 + 2 q)^(3/2). */
inline double offsetVariance(double occupancy, double noise, double sigma)
{
	const double q = noise * noise / (sigma * sigma);
	return noise * noise / (std::sqrt(2.0) * occupancy) * std::pow(1 + q, 2.5) / std::pow(1 + 2 * q, 1.5);
}

/** Number of measurements that carry a ridge of this occupancy: (sum of kernels)^2 / (sum of their squares). */
inline double effectiveMeasurements(double occupancy, double noise, double sigma)
{
	const double q = noise * noise / (sigma * sigma);
	return occupancy * std::sqrt(2 * (1 + 2 * q) / (1 + q));
}

/** Standard error and 95 % interval of the place of a ridge across the wall, from the vertex alone. On a straight wall
 * the curvature is 1/(1 + s^2/sigma^2), which gives the noise s. As that is estimated from the same measurements, some
 * of them count as used up, one for the place and about half a one for the direction (confirmed by simulation down to 5
 * kernels), and the interval is Student's.
 *
 * Holds for independent measurements of one smooth wall that bends little over sigma; corners, walls nearer than about
 * 2 sqrt(sigma^2 + s^2), outliers and errors of the poses are not in it. */
inline RidgeUncertainty ridgeUncertainty(const VertexInfo& vertex, double sigma)
{
	RidgeUncertainty u;
	const double infinite = std::numeric_limits<double>::infinity();
	u.standardError = u.halfWidth95 = infinite;
	if (!(vertex.occupancy > 0 && vertex.curvature > 0)) return u;
	const double q = std::max(0.0, 1.0 / double(vertex.curvature) - 1);
	u.noise = sigma * std::sqrt(q);
	u.kernels = effectiveMeasurements(vertex.occupancy, u.noise, sigma);
	const double dof = u.kernels - 1.5;
	if (!(dof > 0.5)) return u;
	u.standardError = std::sqrt(offsetVariance(vertex.occupancy, u.noise, sigma) * u.kernels / dof);
	u.halfWidth95 = studentQuantile95(dof) * u.standardError;
	return u;
}

}  // namespace ridgemap
