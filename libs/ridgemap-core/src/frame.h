// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/options.h>
#include <ridgemap/types.h>

#include <cmath>
#include <cstdint>

#include "vec2.h"

namespace ridgemap
{
/** std::floor for what fits an int. */
inline int roundDown(double v)
{
	const int i = int(v);
	return i - (double(i) > v);
}
/** std::ceil for what fits an int. */
inline int roundUp(double v)
{
	return -roundDown(-v);
}

/** Integer division that rounds towards minus infinity: the one way from a coordinate to an index. */
inline std::int64_t floorDiv(std::int64_t a, std::int64_t b)
{
	return a / b - ((a % b != 0) && ((a % b < 0) != (b < 0)));
}

/** A position on the measurement lattice, in quanta of sigma * 2^-20. */
struct LatticePoint
{
	std::int64_t u = 0;
	std::int64_t v = 0;
};

/** The lattice frame: the map frame rotated and shifted by irrational amounts, so that walls parallel to the axes do
 * not run along tile borders, in units of sigma. Only +, -, *, / and sqrt are used from here on to the polylines, so
 * that the result depends on no mathematics library. */
class Frame
{
 public:
	static constexpr std::int64_t quantaPerSigma = std::int64_t(1) << 20;
	static constexpr std::int64_t blockEdge = 4;  ///< edge of a block of cells [sigma]
	static constexpr std::int64_t quantaPerBlock = blockEdge * quantaPerSigma;

	explicit Frame(double sigma) : sigma_(sigma) {}

	Vec2 toLattice(const Point2& p) const
	{
		return {(cosine * p.x + sine * p.y) / sigma_ + offsetX, (cosine * p.y - sine * p.x) / sigma_ + offsetY};
	}

	Point2 toMap(Vec2 q) const
	{
		const double x = (q.x - offsetX) * sigma_, y = (q.y - offsetY) * sigma_;
		return {cosine * x - sine * y, sine * x + cosine * y};
	}

	/** Largest coordinate of the map frame [sigma]. */
	double largestCoordinate() const { return maxCoordinate / sigma_ + 16; }

	/** Rotates a vector of the map frame into the lattice frame, without scaling. */
	static Vec2 rotateToLattice(Vec2 d) { return {cosine * d.x + sine * d.y, cosine * d.y - sine * d.x}; }

	LatticePoint quantise(const Point2& p) const
	{
		const Vec2 q = toLattice(p);
		return {std::int64_t(std::floor(q.x * double(quantaPerSigma) + 0.5)),
				std::int64_t(std::floor(q.y * double(quantaPerSigma) + 0.5))};
	}

 private:
	// Cosine and sine of 0.6180339887 rad.
	static constexpr double cosine = 0.8150192047167896, sine = 0.5794339444171457;
	static constexpr double offsetX = 5.8309518948453007, offsetY = 11.224972160321824;
	double sigma_;
};

}  // namespace ridgemap
