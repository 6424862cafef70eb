// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "report.h"

namespace ridgemap::apps
{
/** @name The experiments of the paper, and those that its claims ask for. Each writes its pictures and data into the
 * directory of the setting.
 * @{ */
Finding constructionFigure(const Setting& setting);  ///< Fig. 1
Finding hallwayFigure(const Setting& setting);       ///< Fig. 2
Finding straightWall(const Setting& setting);        ///< Fig. 3
Finding cornerError(const Setting& setting);         ///< Fig. 4
Finding cornerFigure(const Setting& setting);        ///< Fig. 5
Finding runTime(const Setting& setting);             ///< Fig. 6
Finding permutations(const Setting& setting);
Finding corrections(const Setting& setting);
Finding changes(const Setting& setting);
Finding convergence(const Setting& setting);
Finding stepRules(const Setting& setting);
Finding outlierShares(const Setting& setting);
Finding standardErrors(const Setting& setting);
/** @} */

}  // namespace ridgemap::apps
