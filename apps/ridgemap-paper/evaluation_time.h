// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace ridgemap::apps
{
/** Time of one evaluation of the continuous occupancy with its derivatives, between nodes that are in the cache, over
 * and over [ms]: what an update cannot do without. */
double evaluationTime();

/** Time that the calling thread has computed [ms]: other programs do not count. */
double msOfThread();

}  // namespace ridgemap::apps
