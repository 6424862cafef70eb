// SPDX-License-Identifier: BSD-3-Clause
// Which stretches of samples are lines and arcs, on curves that are known.
#include "runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ridgemap::test
{
namespace
{
constexpr double spacing = 0.1, error = 0.01;

/** Samples of a curve that goes on where it stopped, with a curvature of its own in each piece. */
class Course
{
 public:
	Course& piece(int count, double curvature)
	{
		for (int i = 0; i < count; i++)
		{
			// An even wiggle of a third of the error, so that fits have something to do.
			const double off = (samples_.size() % 2 == 0 ? 1 : -1) * error / 3;
			samples_.push_back({p_ + off * Vec2{-std::sin(angle_), std::cos(angle_)}, spacing * double(samples_.size()),
								error * error});
			const double middle = angle_ + 0.5 * spacing * curvature;
			const double chord = curvature == 0 ? spacing : 2 / curvature * std::sin(0.5 * spacing * curvature);
			p_ = p_ + chord * Vec2{std::cos(middle), std::sin(middle)};
			angle_ += spacing * curvature;
		}
		return *this;
	}
	const std::vector<WallSample>& samples() const { return samples_; }

 private:
	std::vector<WallSample> samples_;
	Vec2 p_{3, -1};
	double angle_ = 0.3;
};

std::vector<WallShape> shapesOf(const std::vector<Run>& runs)
{
	std::vector<WallShape> shapes;
	for (const Run& r : runs) shapes.push_back(r.shape);
	return shapes;
}

using Shapes = std::vector<WallShape>;
}  // namespace

TEST(Runs, ALineIsOneRun)
{
	const auto samples = Course().piece(100, 0).samples();
	const auto runs = findRuns(samples, {});
	ASSERT_EQ(shapesOf(runs), Shapes{WallShape::line});
	EXPECT_EQ(runs[0].from, 0u);
	EXPECT_EQ(runs[0].to, 100u);
	EXPECT_EQ(runs[0].curve.curvature, 0);
	for (const WallSample& s : samples) EXPECT_LT(std::abs(runs[0].curve.distance(s.p)), 0.5 * error);
}

TEST(Runs, ACircleIsAnArcUnlessItBendsTooMuch)
{
	const auto samples = Course().piece(100, -0.2).samples();
	RunRules rules;
	const auto runs = findRuns(samples, rules);
	ASSERT_EQ(shapesOf(runs), Shapes{WallShape::arc});
	EXPECT_NEAR(runs[0].curve.curvature, -0.2, 0.001);
	rules.largestCurvature = 0.21;
	EXPECT_EQ(shapesOf(findRuns(samples, rules)), Shapes{WallShape::arc});
	rules.largestCurvature = 0.19;
	EXPECT_EQ(shapesOf(findRuns(samples, rules)), Shapes{WallShape::curve});
}

TEST(Runs, ABendThatTheErrorsExplainIsALine)
{
	// A sagitta of 1/8 * 0.004 * 10^2 = 0.05 is five errors of one sample; with errors ten times as large it is
	// nothing.
	auto samples = Course().piece(100, 0.004).samples();
	EXPECT_EQ(shapesOf(findRuns(samples, {})), Shapes{WallShape::arc});
	for (WallSample& s : samples) s.variance *= 100;
	EXPECT_EQ(shapesOf(findRuns(samples, {})), Shapes{WallShape::line});
}

TEST(Runs, LineArcLineArePartedWhereTheyMeet)
{
	const auto samples = Course().piece(70, 0).piece(80, 0.25).piece(70, 0).samples();
	const auto runs = findRuns(samples, {});
	ASSERT_EQ(shapesOf(runs), (Shapes{WallShape::line, WallShape::arc, WallShape::line}));
	EXPECT_NEAR(double(runs[1].from), 70, 5);
	EXPECT_NEAR(double(runs[1].to), 150, 5);
	EXPECT_NEAR(runs[1].curve.curvature, 0.25, 0.005);
}

TEST(Runs, CoverTheSamplesInOrderWithoutGaps)
{
	for (const double bend : {0.0, 0.1, -0.3, 0.9, 3.0})
		for (const int count : {3, 31, 33, 90})
		{
			const auto samples = Course().piece(count, 0).piece(count, bend).piece(40, -bend).samples();
			const auto runs = findRuns(samples, {});
			std::size_t at = 0;
			for (const auto& r : runs)
			{
				EXPECT_EQ(r.from, at);
				EXPECT_GT(r.to, r.from);
				at = r.to;
				if (r.shape == WallShape::curve) continue;
				for (std::size_t i = r.from; i < r.to; i++)
					ASSERT_LE(std::abs(r.curve.distance(samples[i].p)), 3.001 * error) << bend << " " << count;
			}
			EXPECT_EQ(at, samples.size());
		}
}

TEST(Runs, HaveALeastLengthThatIsShorterBetweenCorners)
{
	RunRules rules;
	EXPECT_EQ(shapesOf(findRuns(Course().piece(32, 0).samples(), rules)), Shapes{WallShape::line});
	EXPECT_EQ(shapesOf(findRuns(Course().piece(31, 0).samples(), rules)), Shapes{WallShape::curve});
	rules.bounded = true;
	EXPECT_EQ(shapesOf(findRuns(Course().piece(31, 0).samples(), rules)), Shapes{WallShape::line});
	EXPECT_EQ(shapesOf(findRuns(Course().piece(4, 0).samples(), rules)), Shapes{WallShape::line});
	EXPECT_EQ(shapesOf(findRuns(Course().piece(3, 0).samples(), rules)), Shapes{WallShape::curve});
}

}  // namespace ridgemap::test
