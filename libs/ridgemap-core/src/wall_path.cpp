// SPDX-License-Identifier: BSD-3-Clause
#include "wall_path.h"

#include <ridgemap/standard_error.h>

#include <cmath>

namespace ridgemap
{
FittedLine fitLine(const Path& path, double a, double b, double step)
{
	const int n = std::max(3, int((b - a) / step) + 1);
	FittedLine line;
	std::vector<Vec2> p;
	for (int i = 0; i < n; i++) p.push_back(path.at(a + (b - a) * i / (n - 1)));
	for (const Vec2& q : p) line.mean = line.mean + (1.0 / n) * q;
	double xx = 0, xy = 0, yy = 0;
	for (const Vec2& q : p)
	{
		const Vec2 d = q - line.mean;
		xx += d.x * d.x / n;
		xy += d.x * d.y / n;
		yy += d.y * d.y / n;
	}
	const double half = 0.5 * (xx - yy), radius = std::sqrt(half * half + xy * xy);
	// The eigenvector of the larger eigenvalue, from whichever row is safer.
	line.direction = half >= 0 ? unit({half + radius, xy}) : unit({xy, radius - half});
	if (dot(line.direction, p.back() - p.front()) < 0) line.direction = -line.direction;
	line.rms = std::sqrt(std::max(0.0, 0.5 * (xx + yy) - radius));
	return line;
}

double densityWidth(const Polyline& line, double sigma)
{
	std::vector<float> curvatures;
	for (const VertexInfo& v : line.info)
		if (v.occupancy > 0 && v.curvature > 0) curvatures.push_back(v.curvature);
	if (curvatures.empty()) return sigma;
	const auto middle = curvatures.begin() + std::ptrdiff_t(curvatures.size() / 2);
	std::nth_element(curvatures.begin(), middle, curvatures.end());
	return sigma / std::sqrt(std::min(1.0, std::max(0.25, double(*middle))));
}

WallNoise wallNoise(const Polyline& line, double sigma)
{
	const double se = densityWidth(line, sigma);
	WallNoise result;
	result.noise = std::sqrt(std::max(0.0, se * se - sigma * sigma));
	// By length, as vertices are closer together where a wall is uneven.
	std::size_t count = 0;
	double all = 0, agreeing = 0;
	for (std::size_t k = 0; k < line.info.size(); k++)
	{
		const VertexInfo& v = line.info[k];
		if (!(v.occupancy > 0 && v.curvature > 0)) continue;
		const double noise = noiseAcross(double(v.curvature), sigma);
		const double length = (k > 0 ? norm(vertexAt(line, k) - vertexAt(line, k - 1)) : 0) +
							  (k + 1 < line.info.size() ? norm(vertexAt(line, k + 1) - vertexAt(line, k)) : 0);
		count++;
		all += length;
		if (noise <= 1.5 * result.noise && result.noise <= 1.5 * noise) agreeing += length;
	}
	result.supported = result.noise > 0 && count >= 5 && 2 * agreeing >= all;
	return result;
}

}  // namespace ridgemap
