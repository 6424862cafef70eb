// SPDX-License-Identifier: BSD-3-Clause
#include "field_nodes.h"

#include <algorithm>
#include <cmath>

#include "exp_series.h"

namespace ridgemap
{
namespace
{
/** exp(-x^2 / (2 variance)) at `count` places a node spacing apart: outwards from the middle by repeated
 * multiplication, each ratio being the last one times a constant. */
void gaussian(double firstPlace, int count, double variance, double* values)
{
	constexpr double h = 1.0 / nodesPerSigma;
	const int middle = std::max(0, std::min(count - 1, int(std::floor(0.5 - firstPlace / h))));
	const double x = firstPlace + middle * h, scale = 0.5 / variance;
	const auto expMinus = [](double t) { return t < 0 ? 1 / expMinusShort(-t) : expMinusShort(t); };
	const double peak = expMinusShort(x * x * scale), bend = expMinusShort(2 * h * h * scale);
	double up = expMinus((2 * x + h) * h * scale), down = expMinus((h - 2 * x) * h * scale);
	values[middle] = peak;
	double value = peak;
	for (int i = middle + 1; i < count; i++)
	{
		values[i] = value *= up;
		up *= bend;
	}
	value = peak;
	for (int i = middle - 1; i >= 0; i--)
	{
		values[i] = value *= down;
		down *= bend;
	}
}

int roundDownToFour(double x)
{
	return int(floorDiv(std::int64_t(std::floor(x)), 4)) * 4;
}
}  // namespace

KernelSpreader::KernelSpreader(const CellGrid& grid, double cutoff)
	: grid_(grid), radius_((cutoff + grid.halfExtent()) * nodesPerSigma)
{
	reach_ = int(std::ceil(radius_ / nodesPerBlock));
	for (int k = 0; 0.25 * k <= radius_; k++) halfWidths_.push_back(std::sqrt(radius_ * radius_ - 0.0625 * k * k));
}

KernelSpreader::Place KernelSpreader::fill(const Cell& cell, int sign, KernelWindow& w) const
{
	const CellMoments m = momentsOf(cell, grid_);
	const double quantaPerNode = double(Frame::quantaPerSigma) / nodesPerSigma;
	const double cx = double(grid_.centre(cellColumn(cell.key))) / quantaPerNode,
				 cy = double(grid_.centre(cellRow(cell.key))) / quantaPerNode;
	Place p;
	p.x0 = roundDownToFour(cx - radius_);
	p.x1 = roundDownToFour(cx + radius_) + 4;
	p.y0 = int(std::ceil(cy - radius_));
	p.y1 = int(std::floor(cy + radius_)) + 1;
	const double half = 0.5 * double(Frame::blockEdge), h = 1.0 / nodesPerSigma;
	const double x0 = h * p.x0 - half - m.mean.x, y0 = h * p.y0 - half - m.mean.y;
	const double vx = 1 + m.xx, vy = 1 + m.yy;
	const double weight = sign * nodesPerKernel * m.n / std::sqrt(vx * vy);
	gaussian(x0, p.x1 - p.x0, vx, w.x);
	gaussian(y0, p.y1 - p.y0, vy, w.y);
	// The covariance tilts the kernel to first order: + xy times its mixed derivative.
	for (int i = 0; i < p.x1 - p.x0; i++) w.dx[i] = -(x0 + h * i) / vx * w.x[i];
	for (int j = 0; j < p.y1 - p.y0; j++)
	{
		const double y = y0 + h * j;
		w.y[j] *= weight;
		w.dy[j] = -m.xy * y / vy * w.y[j];
		const double reach = halfWidths_[std::size_t(4 * std::abs(p.y0 + j - cy))];
		w.first[j] = roundDownToFour(cx - reach) - p.x0;
		w.last[j] = roundDownToFour(cx + reach) + 4 - p.x0;
	}
	return p;
}

}  // namespace ridgemap
