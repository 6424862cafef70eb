// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ridgemap/ridge_map.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace ridgemap::test
{
namespace
{
const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

/** One numeric option: which values are allowed and which are not, and what the message must name. */
struct NumberCase
{
	const char* name;
	double Options::*field;
	std::vector<double> good, bad;
	std::vector<const char*> range;  ///< texts that state the allowed range
};

const std::vector<NumberCase>& numberCases()
{
	static const std::vector<NumberCase> cases{
		{"sigma", &Options::sigma, {1e-3, 0.05, 1e3}, {0, -0.05, 9.9e-4, 1001}, {"0.001", "1000", "m"}},
		{"eps", &Options::eps, {0, 0.05 * 1e-4, 0.001, 0.025}, {-0.001, 4e-6, 0.0251, 1}, {"sigma/10000", "sigma/2"}},
		{"lTol", &Options::lTol, {0.1, 3, 1e9}, {0, -1, 0.09, 1.1e9}, {"0.1", "1e+09", "kernel"}},
		{"dTol", &Options::dTol, {0.5, 4}, {0, -1, 0.49, 4.01}, {"0.5", "4", "sigma"}},
		{"cell", &Options::cell, {0, 1, 0.5, 0.25, 0.125}, {-0.5, 0.3, 2, 0.0625}, {"1, 0.5, 0.25", "0 "}},
		{"cutoff", &Options::cutoff, {4, 5, 8}, {0, 3.99, 8.01, -5}, {"4", "8", "sigma"}},
		{"tileEdge", &Options::tileEdge, {12, 16, 20, 64}, {0, 8, 68, -16}, {"12", "64", "sigma"}},
		{"tileEdge", &Options::tileEdge, {16}, {14, 17, 16.5}, {"multiple of 4"}},
		{"maxStep", &Options::maxStep, {0.1, 2, 4}, {0, 0.09, 4.1, -1}, {"0.1", "4", "sigma"}},
		{"maxSensitivity", &Options::maxSensitivity, {1, 60, 1e6}, {0.99, 1.1e6, -1}, {"1", "1e+06"}},
		{"minCurvature", &Options::minCurvature, {0, 0.05, 1}, {-0.01, 1.01}, {"0", "1"}},
		{"pruneLength", &Options::pruneLength, {0, 3, 100}, {-1, 101}, {"0", "100", "sigma"}},
		{"attachDistance", &Options::attachDistance, {0, 2.2, 5}, {-1, 5.1}, {"0", "5", "sigma"}},
		{"freeSpaceTau", &Options::freeSpaceTau, {0, 0.5, 1}, {-0.1, 1.1}, {"0", "1"}},
		{"freeSpaceWindow", &Options::freeSpaceWindow, {0, 1.5, 10}, {-1, 10.1}, {"0", "10", "sigma"}},
		{"freeSpaceLeast", &Options::freeSpaceLeast, {0, 2, 1e6}, {-1, 1.1e6}, {"0", "1e+06", "passes"}},
		{"freeSpaceMargin", &Options::freeSpaceMargin, {1, 2.5, 20}, {0.9, 20.1}, {"1", "20", "sigma"}},
	};
	return cases;
}

/** The message with which options are turned down; empty if they are not. */
std::string refusal(const Options& o)
{
	try
	{
		o.validate();
	}
	catch (const std::invalid_argument& e)
	{
		return e.what();
	}
	return {};
}
}  // namespace

TEST(Options, DefaultsAreValidAndEqual)
{
	EXPECT_EQ(refusal(Options()), "");
	EXPECT_TRUE(Options() == Options());
	EXPECT_DOUBLE_EQ(Options().effectiveEps(), Options().sigma / 50);
}

TEST(Options, NumbersWithinTheirRangesAreAccepted)
{
	for (const NumberCase& c : numberCases())
		for (const double value : c.good)
		{
			Options o;
			o.*c.field = value;
			EXPECT_EQ(refusal(o), "") << c.name << " = " << value;
		}
}

TEST(Options, NumbersOutOfRangeAreNamedWithValueAndRange)
{
	for (const NumberCase& c : numberCases())
	{
		std::vector<double> bad = c.bad;
		bad.push_back(infinity);
		bad.push_back(-infinity);
		for (const double value : bad)
		{
			Options o;
			o.*c.field = value;
			const std::string message = refusal(o);
			ASSERT_NE(message, "") << c.name << " = " << value;
			EXPECT_NE(message.find("'" + std::string(c.name) + "'"), std::string::npos) << message;
			std::ostringstream text;
			text << " is " << value;
			EXPECT_NE(message.find(text.str()), std::string::npos) << message;
			if (std::isinf(value)) continue;  // may be caught by a wider check of the same field
			for (const char* part : c.range)
				EXPECT_NE(message.find(part), std::string::npos) << part << ": " << message;
		}
	}
}

TEST(Options, NotANumberIsNeverAccepted)
{
	for (const NumberCase& c : numberCases())
	{
		Options o;
		o.*c.field = nan;
		EXPECT_NE(refusal(o).find("'" + std::string(c.name) + "'"), std::string::npos) << c.name;
	}
}

TEST(Options, UnknownRulesAreNamed)
{
	Options o;
	o.stepRule = StepRule(2);
	EXPECT_NE(refusal(o).find("'stepRule' is 2"), std::string::npos) << refusal(o);
	EXPECT_NE(refusal(o).find("paper"), std::string::npos) << refusal(o);
	o = {};
	o.seedRule = SeedRule(200);
	EXPECT_NE(refusal(o).find("'seedRule' is 200"), std::string::npos) << refusal(o);
	EXPECT_NE(refusal(o).find("maximum"), std::string::npos) << refusal(o);
}

TEST(Options, TheBoundOfEpsFollowsSigma)
{
	Options o;
	o.sigma = 1;
	o.eps = 0.1;
	EXPECT_EQ(refusal(o), "");
	EXPECT_DOUBLE_EQ(o.effectiveEps(), 0.1);
	o.sigma = 0.1;
	EXPECT_NE(refusal(o), "");
}

TEST(Options, EveryFieldCountsForEquality)
{
	for (const NumberCase& c : numberCases())
	{
		Options o;
		o.*c.field += 0.5;
		EXPECT_TRUE(o != Options()) << c.name;
	}
	for (bool Options::*flag : {&Options::prune, &Options::attach})
	{
		Options o;
		o.*flag = !(o.*flag);
		EXPECT_TRUE(o != Options());
	}
	Options step, seed;
	step.stepRule = StepRule::paper;
	seed.seedRule = SeedRule::maximum;
	EXPECT_TRUE(step != Options());
	EXPECT_TRUE(seed != Options());
	EXPECT_TRUE(step != seed);
}

TEST(Options, AMapRefusesThem)
{
	Options o;
	o.sigma = nan;
	EXPECT_THROW(RidgeMap{o}, std::invalid_argument);
	o.sigma = -1;
	EXPECT_THROW(RidgeMap{o}, std::invalid_argument);
}

TEST(Options, MapsWithOtherOptionsDoNotMix)
{
	Options other;
	other.sigma = 0.06;
	RidgeMap a, b(other);
	b.insert({{1, 2}});
	EXPECT_THROW(a.merge(b), std::invalid_argument);
	EXPECT_THROW(a.subtract(b), std::invalid_argument);
	EXPECT_TRUE(a.empty());
}

TEST(StopReason, EveryReasonHasItsOwnName)
{
	std::vector<std::string> names;
	for (int i = 0; i < int(StopReason::count_); i++) names.push_back(toString(StopReason(i)));
	for (std::size_t i = 0; i < names.size(); i++)
	{
		EXPECT_NE(names[i], toString(StopReason::count_));
		for (std::size_t k = 0; k < i; k++) EXPECT_NE(names[i], names[k]);
	}
}

}  // namespace ridgemap::test
