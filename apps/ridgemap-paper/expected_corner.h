// SPDX-License-Identifier: BSD-3-Clause
// The ridge at a corner without chance: what remains of its error at any density of measurements.
#pragma once

#include <ridgemap/types.h>

namespace ridgemap::apps
{
/** The ridge of the expected occupancy of two walls that meet at the origin at a right angle and lead along the axes x
 * and y from there, measured evenly and with normal noise in x and y. In closed form, sampled every 1/50 of its bend's
 * size, up to `reach` along both walls. No part of it comes from the code that traces ridges.
 * @param sigma smoothing parameter [m]
 * @param noise standard deviation of the measurements in x and in y [m]
 * @param arm length of each wall [m], greater than reach by some sigma */
Polyline expectedCornerRidge(double sigma, double noise, double arm, double reach);

}  // namespace ridgemap::apps
