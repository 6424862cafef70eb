// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <ridgemap/CRidgeMap2D.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>

using namespace ridgemap;

namespace
{
/** The message of the exception that the call throws; "" if it throws none. Programs of MRPT tear messages that hold a
 * ']' apart, as what precedes it would be the place in a source. */
template <class F>
std::string messageOf(F&& call)
{
	try
	{
		call();
	}
	catch (const std::exception& e)
	{
		EXPECT_EQ(std::string(e.what()).find(']'), std::string::npos) << e.what();
		return e.what();
	}
	return {};
}

MapOptions unusualOptions()
{
	MapOptions o;
	o.creation.sigma = 0.1 + 0.2;  // no short decimal
	o.creation.eps = 1.0 / 3000;
	o.creation.cell = 0.25;
	o.creation.stepRule = StepRule::paper;
	o.creation.seedRule = SeedRule::maximum;
	o.creation.prune = false;
	o.insertion.minZ = -1.25;
	o.insertion.minDistBetweenPoints = 1e-3;
	o.likelihood.decimation = 7;
	o.likelihood.target = LikelihoodTarget::walls;
	o.render.showMeasurements = true;
	o.render.wallColor = mrpt::img::TColor(1, 2, 3, 4);
	o.render.ridgeColor = mrpt::img::TColor(250, 0, 16);
	return o;
}

void expectEqual(const MapOptions& a, const MapOptions& b)
{
	for (const auto& key : MapOptions::keys()) EXPECT_EQ(a.getOption(key), b.getOption(key)) << key;
	EXPECT_TRUE(static_cast<const Options&>(a.creation) == static_cast<const Options&>(b.creation));
}
}  // namespace

TEST(MapOptions, KeysAreUniqueWithoutCaseAndUnderscores)
{
	std::set<std::string> seen;
	for (std::string key : MapOptions::keys())
	{
		key.erase(std::remove(key.begin(), key.end(), '_'), key.end());
		std::transform(key.begin(), key.end(), key.begin(), ::tolower);
		EXPECT_TRUE(seen.insert(key).second) << key;
	}
	EXPECT_GE(seen.size(), 35u);
}

TEST(MapOptions, EveryFieldOfTheCoreIsInTheTable)
{
	// The table is compared with operator== of the core: a field that is not in the table would not survive.
	Options all;
	all.sigma = 0.07, all.eps = 0.001, all.lTol = 2.5, all.dTol = 3.5, all.cell = 0.5, all.cutoff = 6,
	all.tileEdge = 20;
	all.maxStep = 1.5, all.minCurvature = 0.25, all.maxSensitivity = 40, all.stepRule = StepRule::paper;
	all.sides = false, all.mergeDistance = 0.3, all.seedRule = SeedRule::maximum, all.prune = false,
	all.pruneLength = 4, all.attach = false, all.attachDistance = 1, all.sharpen = false, all.trim = false,
	all.straighten = false, all.correctBends = false;
	all.freeSpace = false, all.freeSpaceTau = 0.4, all.freeSpaceWindow = 1, all.freeSpaceLeast = 3,
	all.freeSpaceMargin = 2;
	MapOptions from, to;
	from.creation = TCreationOptions(all);
	for (const auto& key : MapOptions::keys()) to.setOption(key, from.getOption(key));
	EXPECT_TRUE(static_cast<const Options&>(to.creation) == all);
	EXPECT_EQ(sizeof(Options), 21 * sizeof(double)) << "a field was added: add it to option_fields.h and above";
}

TEST(MapOptions, IniRoundTripIsExact)
{
	const MapOptions saved = unusualOptions();
	mrpt::config::CConfigFileMemory ini(saved.toIniText("abc"));
	MapOptions loaded;
	loaded.loadFromConfigFile(ini, "abc");
	expectEqual(saved, loaded);
	// A second trip through the sections' own loaders.
	TCreationOptions creation;
	creation.loadFromConfigFile(ini, "abc_creationOpts");
	EXPECT_TRUE(static_cast<const Options&>(creation) == static_cast<const Options&>(saved.creation));
}

TEST(MapOptions, DefaultIniIsCommentedAndLoads)
{
	const std::string text = defaultIniText("map");
	for (const auto& key : MapOptions::keys()) EXPECT_NE(text.find(key), std::string::npos) << key;
	std::istringstream lines(text);
	for (std::string line; std::getline(lines, line);)
		EXPECT_TRUE(line.find('=') == std::string::npos || line.find("//") != std::string::npos) << line;
	EXPECT_NE(text.find("[m]"), std::string::npos);
	EXPECT_NE(text.find("error | paper"), std::string::npos);
	mrpt::config::CConfigFileMemory ini(text);
	EXPECT_EQ(ini.read_int("map", "ridgeMap_count", 0), 1);
	MapOptions loaded = unusualOptions();
	loaded.loadFromConfigFile(ini, "map_ridgeMap_00");
	expectEqual(MapOptions(), loaded);
}

TEST(MapOptions, KeysIgnoreCaseAndUnderscores)
{
	mrpt::config::CConfigFileMemory ini(
		std::string("[m_creationOpts]\nL_tol = 5 // five\nSIGMA=0.1\nstep_rule = Paper\n"));
	MapOptions o;
	o.loadFromConfigFile(ini, "m");
	EXPECT_EQ(o.creation.lTol, 5);
	EXPECT_EQ(o.creation.sigma, 0.1);
	EXPECT_EQ(o.creation.stepRule, StepRule::paper);
	o.setOption("D_TOL", "2");
	EXPECT_EQ(o.creation.dTol, 2);
}

TEST(MapOptions, WrongValuesNameKeyValueAndRange)
{
	struct Case
	{
		const char *key, *value, *allowed;
	};
	const Case cases[] = {{"sigma", "-1", "0.001"},
						  {"sigma", "abc", "number"},
						  {"sigma", "nan", "0.001"},
						  {"sigma", "0.05m", "number"},
						  {"sigma", "", "number"},
						  {"lTol", "0", "0.1"},
						  {"stepRule", "fast", "error | paper"},
						  {"seedRule", "1.5", "projection | maximum"},
						  {"prune", "maybe", "true or false"},
						  {"decimation", "0", "1 to"},
						  {"decimation", "2.5", "whole number"},
						  {"decimation", "-3", "whole number"},
						  {"zRand", "0", "1e-09"},
						  {"maxRange", "inf", "1000000"},
						  {"wallColor", "red", "RRGGBB"},
						  {"wallColor", "12345", "RRGGBB"},
						  {"planarityTolerance", "91", "90"},
						  {"target", "floors", "ridges | walls"}};
	for (const auto& c : cases)
	{
		MapOptions o;
		const std::string message = messageOf([&] { o.setOption(c.key, c.value); });
		EXPECT_NE(message.find(std::string("'") + c.key + "'"), std::string::npos) << c.key << ": " << message;
		EXPECT_NE(message.find(std::string("'") + c.value + "'"), std::string::npos) << c.key << ": " << message;
		EXPECT_NE(message.find(c.allowed), std::string::npos) << c.key << ": " << message;
		EXPECT_EQ(message.find('\n'), std::string::npos);
		expectEqual(o, MapOptions());
	}
}

TEST(MapOptions, RelationsAreCheckedByValidate)
{
	MapOptions o;
	o.setOption("eps", "0.2");
	EXPECT_NE(messageOf([&] { o.validate(); }).find("eps"), std::string::npos);
	o.setOption("sigma", "0.5");
	EXPECT_NO_THROW(o.validate());
	o.setOption("minZ", "3");
	EXPECT_NE(messageOf([&] { o.validate(); }).find("maxZ"), std::string::npos);
	EXPECT_ANY_THROW(CRidgeMap2D{o});
	o.setOption("maxZ", "4");
	EXPECT_NO_THROW(CRidgeMap2D{o});
	o.setOption("cell", "0.3");
	EXPECT_NE(messageOf([&] { CRidgeMap2D{o}; }).find("cell"), std::string::npos);
}

TEST(MapOptions, UnknownKeysListNearOnes)
{
	MapOptions o;
	EXPECT_NE(messageOf([&] { o.setOption("sigm", "1"); }).find("sigma"), std::string::npos);
	EXPECT_NE(messageOf([&] { o.setOption("maxrnage", "1"); }).find("maxRange"), std::string::npos);
	EXPECT_NE(messageOf([&] { o.setOption("range", "1"); }).find("minRange"), std::string::npos);
	EXPECT_NE(messageOf([&] { o.setOption("qqqqqqqqqqq", "1"); }).find("attachDistance"), std::string::npos);
	EXPECT_FALSE(messageOf([&] { o.getOption("sigm"); }).empty());
}

TEST(MapOptions, MistakesInAnIniFileLeaveTheOptionsAsTheyWere)
{
	const char* mistakes[] = {
		"[m_creationOpts]\nsigma = 0.1\nlTol = -3\n", "[m_creationOpts]\nsigma = 0.1\nsigmma = 0.2\n",
		"[m_creationOpts]\nsigma = 0.1\n[m_likelihoodOpts]\nzHit = a lot\n",
		"[m_creationOpts]\nsigma = 0.1\n[m_insertionOpts]\nminZ = 0\n", "[m_insertOpts]\nminZ = 5\n"};
	for (const char* text : mistakes)
	{
		mrpt::config::CConfigFileMemory ini{std::string(text)};
		MapOptions o;
		const std::string message = messageOf([&] { o.loadFromConfigFile(ini, "m"); });
		EXPECT_NE(message.find("'m_"), std::string::npos) << text << message;
		expectEqual(o, MapOptions());
	}
}

TEST(MapOptions, GenericParametersOfMrptAreNoMistake)
{
	mrpt::config::CConfigFileMemory ini(
		std::string("[m_creationOpts]\nenableObservationLikelihood = false\nsigma=0.1\n"));
	MapOptions o;
	o.loadFromConfigFile(ini, "m");
	EXPECT_EQ(o.creation.sigma, 0.1);
}

TEST(MapOptions, RangesOfTheTableAreThoseOfTheCore)
{
	// What the table lets through, the core must not reject, and just outside both must reject.
	for (const char* key : {"sigma", "lTol", "dTol", "cutoff", "tileEdge", "maxStep", "maxSensitivity", "minCurvature",
							"pruneLength", "attachDistance", "mergeDistance"})
	{
		MapOptions o;
		const std::string message = messageOf([&] { o.setOption(key, "-1e30"); });
		const auto from = message.find("from ") + 5, to = message.find(" to ");
		ASSERT_LT(to, message.size()) << message;
		const std::string low = message.substr(from, to - from);
		const std::string high = message.substr(to + 4, message.find_first_of(" [", to + 4) - to - 4);
		for (const auto& bound : {low, high})
		{
			MapOptions inside;
			inside.setOption(key, bound);
			EXPECT_NO_THROW(inside.validate()) << key << " = " << bound;
		}
		Options beyond;
		const auto set = [&](double v)
		{
			double* fields[] = {&beyond.sigma,          &beyond.lTol,         &beyond.dTol,
								&beyond.cutoff,         &beyond.tileEdge,     &beyond.maxStep,
								&beyond.maxSensitivity, &beyond.minCurvature, &beyond.pruneLength,
								&beyond.attachDistance, &beyond.mergeDistance};
			const char* names[] = {"sigma",       "lTol",           "dTol",           "cutoff",
								   "tileEdge",    "maxStep",        "maxSensitivity", "minCurvature",
								   "pruneLength", "attachDistance", "mergeDistance"};
			beyond = Options();
			for (std::size_t i = 0; i < std::size(names); i++)
				if (std::string(names[i]) == key) *fields[i] = v;
		};
		set(std::nextafter(std::atof(low.c_str()), -1e300));
		EXPECT_ANY_THROW(beyond.validate()) << key << " below " << low;
		set(std::nextafter(std::atof(high.c_str()), 1e300));
		EXPECT_ANY_THROW(beyond.validate()) << key << " above " << high;
	}
}

TEST(MapOptions, DumpNamesEveryKey)
{
	std::ostringstream out;
	CRidgeMap2D::TMapDefinition definition;
	definition.dumpToTextStream(out);
	for (const auto& key : MapOptions::keys()) EXPECT_NE(out.str().find(key), std::string::npos) << key;
}
