// SPDX-License-Identifier: BSD-3-Clause
// How far the ridge of a bent surface lies inside it.
#pragma once

#include "run_fit.h"

namespace ridgemap
{
/** I1(z)/I0(z), the ratio of modified Bessel functions, to about twelve digits; z >= 0. In arithmetic that gives the
 * same bits everywhere. */
double besselRatio(double z);

/** Radius of a circle whose ridge has this radius [both m]: the density of an evenly measured circle of radius r at
 * distance R from its centre is I0(R r/sigma^2) exp(-(R^2 + r^2)/(2 sigma^2)), so its ridge has R/r = I1/I0(R
 * r/sigma^2). Holds for R > 0.9 sigma; smaller circles do not come out as ridges. */
double trueRadius(double ridgeRadius, double sigma);

/** How far the surface lies to the left of an arc fitted to its ridge [m]; 0 where it cannot be told. */
double bendCorrection(const FittedCurve& arc, double sigma);

/** The arc of the surface whose ridge this arc was fitted to. */
FittedCurve unbent(const FittedCurve& arc, double sigma);

}  // namespace ridgemap
