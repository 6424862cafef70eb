// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/options.h>

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <tuple>

namespace ridgemap
{
namespace
{
[[noreturn]] void reject(const char* name, double value, const std::string& allowed)
{
	std::ostringstream s;
	s << "ridge map option '" << name << "' is " << value << ", but must be " << allowed;
	throw std::invalid_argument(s.str());
}

void checkRange(const char* name, double value, double lowest, double highest, const char* unit)
{
	if (value >= lowest && value <= highest) return;
	std::ostringstream s;
	s << "from " << lowest << " to " << highest << unit;
	reject(name, value, s.str());
}

auto tie(const Options& o)
{
	return std::tie(o.sigma, o.eps, o.lTol, o.dTol, o.cell, o.cutoff, o.tileEdge, o.maxStep, o.maxSensitivity, o.sides,
					o.minCurvature, o.stepRule, o.seedRule, o.prune, o.pruneLength, o.attach, o.attachDistance,
					o.mergeDistance, o.sharpen, o.trim, o.straighten, o.correctBends, o.freeSpace, o.freeSpaceTau,
					o.freeSpaceWindow, o.freeSpaceLeast, o.freeSpaceMargin);
}
}  // namespace

bool Options::operator==(const Options& o) const
{
	return tie(*this) == tie(o);
}

void Options::validate() const
{
	checkRange("sigma", sigma, 1e-3, 1e3, " m");
	if (eps != 0 && !(eps >= sigma * 1e-4 && eps <= sigma * 0.5))
		reject("eps", eps, "0 (sigma/50) or from sigma/10000 to sigma/2");
	checkRange("lTol", lTol, 0.1, 1e9, " kernel peaks");
	checkRange("dTol", dTol, 0.5, 4, " sigma");
	if (cell != 0 && cell != 1 && cell != 0.5 && cell != 0.25 && cell != 0.125)
		reject("cell", cell, "1, 0.5, 0.25 or 0.125 sigma, or 0 to keep every measurement apart");
	checkRange("cutoff", cutoff, 4, 8, " sigma");
	checkRange("tileEdge", tileEdge, 12, 64, " sigma");
	if (std::fmod(tileEdge, 4) != 0) reject("tileEdge", tileEdge, "a multiple of 4 sigma");
	checkRange("maxStep", maxStep, 0.1, 4, " sigma");
	checkRange("maxSensitivity", maxSensitivity, 1, 1e6, "");
	if (stepRule != StepRule::error && stepRule != StepRule::paper)
		reject("stepRule", double(stepRule), "0 (error) or 1 (paper)");
	if (seedRule != SeedRule::projection && seedRule != SeedRule::maximum)
		reject("seedRule", double(seedRule), "0 (projection) or 1 (maximum)");
	checkRange("minCurvature", minCurvature, 0, 1, " per sigma^2");
	checkRange("pruneLength", pruneLength, 0, 100, " sigma");
	checkRange("attachDistance", attachDistance, 0, 5, " sigma");
	checkRange("mergeDistance", mergeDistance, 0, 1, " sigma");
	checkRange("freeSpaceTau", freeSpaceTau, 0, 1, "");
	checkRange("freeSpaceWindow", freeSpaceWindow, 0, 10, " sigma");
	checkRange("freeSpaceLeast", freeSpaceLeast, 0, 1e6, " passes");
	checkRange("freeSpaceMargin", freeSpaceMargin, 1, 20, " sigma");
}

}  // namespace ridgemap
