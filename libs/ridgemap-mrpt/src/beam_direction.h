// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <ridgemap/types.h>

#include <cmath>

namespace ridgemap
{
/** Unit vector of a beam in the frame of the sensor; spacing aperture/(N-1) as in MRPT's points maps. */
inline Point2 beamDirection(const mrpt::obs::CObservation2DRangeScan& scan, std::size_t i)
{
	const std::size_t n = scan.getScanSize();
	const double step = n > 1 ? double(scan.aperture) / double(n - 1) : 0;
	const double angle = (n > 1 ? -0.5 * double(scan.aperture) : 0) + step * double(i);
	return {std::cos(angle), scan.rightToLeft ? std::sin(angle) : -std::sin(angle)};
}

}  // namespace ridgemap
