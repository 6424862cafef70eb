// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/standard_error.h>

#include <algorithm>
#include <cmath>

namespace ridgemap
{
double studentQuantile95(double dof)
{
	const double z = 1.959963984540054, z2 = z * z, n = dof < 2.5 ? 2.5 : dof;
	const double g1 = z * (z2 + 1) / 4, g2 = z * ((5 * z2 + 16) * z2 + 3) / 96;
	const double g3 = z * (((3 * z2 + 19) * z2 + 17) * z2 - 15) / 384;
	const double g4 = z * ((((79 * z2 + 776) * z2 + 1482) * z2 - 1920) * z2 - 945) / 92160;
	const double t = z + (g1 + (g2 + (g3 + g4 / n) / n) / n) / n;
	if (dof >= 2.5) return t;
	const double few = 2.5 / dof;
	return t * few * std::sqrt(std::sqrt(few));
}

double noiseAcross(double curvature, double sigma)
{
	return sigma * std::sqrt(std::max(0.0, 1 / curvature - 1));
}

double offsetVariance(double occupancy, double noise, double sigma)
{
	const double q = noise * noise / (sigma * sigma), a = 1 + q, b = 1 + 2 * q;
	return noise * noise / (std::sqrt(2.0) * occupancy) * (a * a * std::sqrt(a)) / (b * std::sqrt(b));
}

double effectiveMeasurements(double occupancy, double noise, double sigma)
{
	const double q = noise * noise / (sigma * sigma);
	return occupancy * std::sqrt(2 * (1 + 2 * q) / (1 + q));
}

RidgeUncertainty ridgeUncertainty(const VertexInfo& vertex, double sigma)
{
	RidgeUncertainty u;
	if (!(vertex.occupancy > 0 && vertex.curvature > 0)) return u;
	u.noise = noiseAcross(double(vertex.curvature), sigma);
	u.kernels = effectiveMeasurements(double(vertex.occupancy), u.noise, sigma);
	const double dof = u.kernels - 1.5;
	if (!(dof > 0.5)) return u;
	u.standardError = std::sqrt(offsetVariance(double(vertex.occupancy), u.noise, sigma) * u.kernels / dof);
	u.halfWidth95 = studentQuantile95(dof) * u.standardError;
	return u;
}

}  // namespace ridgemap
