// SPDX-License-Identifier: BSD-3-Clause
// What the simulated sensors see of things that come and go, of glass and of posts, against closed forms.
#include "../../apps/common/simulator.h"

#include <gtest/gtest.h>

#include "../../apps/common/user_error.h"
#include "test_support.h"

namespace ridgemap::test
{
namespace
{
using namespace apps;

Scene sceneOf(const std::string& lines)
{
	const TempDir dir;
	writeFile(dir / "scene.txt", lines);
	return readScene(dir / "scene.txt");
}

/** Without noise; the middle beam looks along x. */
LidarSensor exactSensor(int beams = 1)
{
	LidarSensor sensor;
	sensor.beams = beams;
	sensor.range = {0, 0};
	return sensor;
}

double rangeAlong(Simulator& simulator, double phi, double time)
{
	return simulator.scan(exactSensor(), {0, 0, phi, time})[0];
}

double seenLength(const std::vector<Segment>& truth)
{
	double sum = 0;
	for (const Segment& s : truth) sum += s.seen ? s.length() : 0;
	return sum;
}
}  // namespace

TEST(Simulator, ThingsAreThereWhileTheSceneSaysSo)
{
	const Scene scene = sceneOf(
		"wall 8 -5 8 5\nduring 10 20 wall 4 -1 4 1\nduring 15 30 arc 3 0 1 0 360\nduring 30 40 mover 0.5 0 2 0 2 1\n"
		"during 50 1e6 glass 1 90 1 -1 1 1\npath 0 0\n");
	Simulator simulator(scene, 1);
	for (const auto& [time, range] : {std::pair(0.0, 8.0),
									  {9.99, 8.0},
									  {10.0, 4.0},
									  {14.99, 4.0},
									  {15.0, 2.0},
									  {20.0, 2.0},
									  {29.0, 2.0},
									  {30.0, 1.5},
									  {39.9, 1.5},
									  {40.0, 8.0},
									  {50.0, 1.0}})
		EXPECT_NEAR(rangeAlong(simulator, 0, time), range, 1e-4) << time;
	// What is not always there is not part of the truth.
	ASSERT_FALSE(simulator.truth().empty());
	for (const Segment& s : simulator.truth()) EXPECT_EQ(s.a.x, 8);
}

TEST(Simulator, GlassReturnsItsShareOfTheBeamsNearItsNormal)
{
	const Scene scene = sceneOf("glass 0.25 20 2 -4 2 4\nwall 6 -20 6 20\npath 0 0\n");
	Simulator simulator(scene, 3);
	const int rounds = 4000;
	int back = 0;
	for (int i = 0; i < rounds; i++)
	{
		const double r = rangeAlong(simulator, 0, 0);
		ASSERT_TRUE(std::abs(r - 2) < 1e-9 || std::abs(r - 6) < 1e-9) << r;
		back += r < 3 ? 1 : 0;
	}
	EXPECT_NEAR(double(back) / rounds, 0.25, 5 * std::sqrt(0.25 * 0.75 / rounds));
	const double degree = 0.017453292519943295;
	for (const double angle : {19.0, 21.0, -21.0, 45.0})
	{
		bool returned = false;
		for (int i = 0; i < 200; i++) returned = returned || rangeAlong(simulator, angle * degree, 0) < 3;
		EXPECT_EQ(returned, std::abs(angle) < 20) << angle;
	}
	// Of the pane, only what can be seen within that angle is truth that was seen.
	Simulator look(scene, 3);
	look.scan(exactSensor(), {0, 0, 0, 0});
	double pane = 0;
	for (const Segment& s : look.truth()) pane += s.a.x == 2 && s.seen ? s.length() : 0;
	EXPECT_NEAR(pane, 2 * 2 * std::tan(20 * degree), 0.05);
}

TEST(Simulator, ThePapersSensorSeesThroughGlassInTheSameShares)
{
	// Pane and wall have the same cross-section, as seen from the sensor.
	const Scene scene = sceneOf("glass 0.25 90 2 -1 2 1\nwall 3 -1.5 3 1.5\npath 0 0\n");
	Simulator simulator(scene, 4);
	PaperSensor sensor;
	sensor.rate = 20000;
	sensor.depth = sensor.transverse = {0, 0};
	double pane = 0, all = 0;
	for (const Measurement& m : simulator.measure(sensor, {0, 0, 0, 0}))
	{
		all++;
		pane += m.x < 2.5 ? 1 : 0;
	}
	// The wall is seen by the 3/4 that pass, but shows 3/2 of the length at 3/2 of the distance.
	const double share = 0.25 / (0.25 + 0.75 * 1.5);
	EXPECT_NEAR(pane / all, share, 5 * std::sqrt(share * (1 - share) / all));
}

TEST(Simulator, PostsStandInARow)
{
	const Scene scene = sceneOf("posts 0.05 0.5 2 -1 2 1.2\nwall 9 -20 9 20\npath 0 0\n");
	Simulator simulator(scene, 5);
	for (int i = 0; i <= 5; i++)
	{
		const double y = -1 + 0.5 * i, distance = std::hypot(2, y);
		EXPECT_NEAR(rangeAlong(simulator, std::atan2(y, 2), 0), i <= 4 ? distance - 0.05 : 9 * distance / 2, 1e-4) << i;
		const double beside = y + 0.25;
		EXPECT_NEAR(rangeAlong(simulator, std::atan2(beside, 2), 0), 9 * std::hypot(2, beside) / 2, 1e-9) << i;
	}
	// Nearly half of each post, less what is beyond its rim, can be seen from one place.
	double posts = 0;
	for (const Segment& s : simulator.truth()) posts += s.a.x < 5 && s.seen ? s.length() : 0;
	EXPECT_NEAR(posts, 5 * 3.14159 * 0.05, 0.1);
	EXPECT_GT(seenLength(simulator.truth()), posts);
}

TEST(Simulator, LinesThatMakeNoSenseAreRefused)
{
	for (const char* line : {"during 1", "during 1 2", "during 2 1 wall 0 0 1 0", "during 1 2 path 0 0 1 1",
							 "during 1 2 during 3 4 wall 0 0 1 0", "during a 2 wall 0 0 1 0", "glass 1.1 20 0 0 1 0",
							 "glass 0.5 0 0 0 1 0", "glass 0.5 20 0 0 1", "posts 0 1 0 0 1 0", "posts 0.1 0 0 0 1 0",
							 "posts 0.1 0.001 0 0 9 0", "posts 0.1 1 0 0 1"})
	{
		try
		{
			sceneOf(std::string("wall 0 0 1 0\npath 0 0 1 1\n") + line + "\n");
			ADD_FAILURE() << line;
		}
		catch (const UserError& e)
		{
			EXPECT_NE(std::string(e.what()).find("scene.txt:3"), std::string::npos) << e.what();
		}
	}
}

}  // namespace ridgemap::test
