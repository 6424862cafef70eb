// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ridgemap/options.h>

#include "field.h"
#include "kernel_sum.h"
#include "vec2.h"

namespace ridgemap
{
/** A place in the occupancy with everything the ridge criterion needs. Unit sigma, L in kernels. */
struct RidgePoint
{
	Vec2 p;
	double occupancy = 0;  ///< L
	Vec2 gradient;
	double lambda1 = 0, lambda2 = 0;  ///< eigenvalues of the Hessian, lambda1 <= lambda2
	Vec2 v1, v2;   ///< their unit eigenvectors, sign arbitrary; in a sided field v1 points to the viewer
	double f = 0;  ///< <grad L, v1>: zero on a ridge; its absolute value is the ridge function R, equation (8)
	/** In a sided field: by how much v1 turns per radian that the normal of the density turns. The closer to 1, the
	 * less the two determine each other. */
	double response = 0;
	Vec2 df;     ///< exact gradient of f for a v1 that is carried along continuously
	Vec2 third;  ///< T(v1, v2, .): third derivatives, how the Hessian turns v1

	/** Signed distance along `direction` to where f vanishes, to first order. */
	double newtonStep(Vec2 direction) const { return -f / dot(df, direction); }

	/** Unit tangent of the ridge, perpendicular to df, on the same side as `towards`. */
	Vec2 tangent(Vec2 towards) const
	{
		const Vec2 t = unit({-df.y, df.x});
		return dot(t, towards) < 0 ? -t : t;
	}
};

/** Eigenvectors, f and its gradient from the sums at p: equations (5)-(8), and
 * grad f = lambda1 v1 + <g, v2>/(lambda1 - lambda2) T(v1, v2, .), for a density that does not turn with v1. */
RidgePoint makeRidgePoint(Vec2 p, const KernelSums& s);

/** The point with the density of the surface that passes here with a normal near `normal`: in a sided field the normal
 * that the density is taken for must be the eigenvector v1 that comes out of it, found by iteration. Elsewhere `normal`
 * has no meaning. */
RidgePoint evaluateRidge(const TileField& field, Vec2 p, Vec2 normal);
/** The same at a point of a sided field. */
RidgePoint evaluateRidge(FieldPoint& point, Vec2 normal);

/** How far the ridge moves [sigma] per relative error of L and its derivatives: the fall of f across the ridge is what
 * resists, and an error of the Hessian turns v1 by its share of the eigen-gap. About 1.5 on a plain wall, without limit
 * at an umbilic point; infinite where f does not fall, so that the density does not lead towards the ridge. */
double sensitivity(const RidgePoint& r);

/** The ridge is attractive and its place is determined here: lambda1 < 0, sensitivity at most `slack` times what the
 * options allow. Says nothing of f. */
bool isRidgeLike(const RidgePoint& r, const Options& options, double slack = 1);

}  // namespace ridgemap
