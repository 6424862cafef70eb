// SPDX-License-Identifier: BSD-3-Clause
#include "ratio_reporter.h"

#include <benchmark/benchmark.h>

#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace ridgemap::benchmarks
{
namespace
{
class RatioReporter : public benchmark::ConsoleReporter
{
 public:
	RatioReporter() : ConsoleReporter(OO_Tabular) {}

	void ReportRuns(const std::vector<Run>& runs) override
	{
		ConsoleReporter::ReportRuns(runs);
		for (const Run& r : runs)
		{
			if (r.error_occurred || r.run_type != Run::RT_Iteration) continue;
			const std::string name = r.run_name.function_name;
			const std::size_t slash = name.rfind('/');
			if (slash == std::string::npos) continue;
			const std::string group = name.substr(0, slash);
			if (groups_.find(group) == groups_.end()) order_.push_back(group);
			groups_[group].push_back(
				{name.substr(slash + 1), r.real_accumulated_time / double(r.iterations), r.counters});
		}
	}

	void Finalize() override
	{
		if (order_.empty()) return;
		std::printf("\n| what | by | time | times as long as the ridge map |\n|---|---|---:|---:|\n");
		for (const std::string& group : order_)
		{
			double ours = 0;
			for (const Result& r : groups_[group])
			{
				if (ours == 0 && r.name.compare(0, 9, "ridge map") == 0) ours = r.seconds;
				std::printf("| %s | %s | %s |", group.c_str(), r.name.c_str(), readable(r.seconds).c_str());
				if (ours > 0)
					std::printf(" %.2f |\n", r.seconds / ours);
				else
					std::printf(" |\n");
			}
		}
		for (const std::string& group : order_)
			if (!groups_[group].front().counters.empty()) printCounters(group);
	}

 private:
	struct Result
	{
		std::string name;
		double seconds;
		benchmark::UserCounters counters;
	};

	void printCounters(const std::string& group) const
	{
		const std::vector<Result>& results = groups_.at(group);
		std::printf("\n| %s |", group.c_str());
		for (const auto& [name, value] : results.front().counters) std::printf(" %s |", name.c_str());
		std::printf("\n|---|");
		for (std::size_t i = 0; i < results.front().counters.size(); i++) std::printf("---:|");
		for (const Result& r : results)
		{
			std::printf("\n| %s |", r.name.c_str());
			for (const auto& [name, value] : r.counters) std::printf(" %.*f |", value.value < 100 ? 2 : 0, value.value);
		}
		std::printf("\n");
	}

	static std::string readable(double seconds)
	{
		char text[40];
		if (seconds < 1e-6)
			std::snprintf(text, sizeof text, "%.1f ns", seconds * 1e9);
		else if (seconds < 1e-3)
			std::snprintf(text, sizeof text, "%.1f us", seconds * 1e6);
		else
			std::snprintf(text, sizeof text, "%.2f ms", seconds * 1e3);
		return text;
	}

	std::vector<std::string> order_;
	std::map<std::string, std::vector<Result>> groups_;
};
}  // namespace

int runWithRatios(int argc, char** argv)
{
	benchmark::Initialize(&argc, argv);
	if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
	RatioReporter reporter;
	benchmark::RunSpecifiedBenchmarks(&reporter);
	return 0;
}

}  // namespace ridgemap::benchmarks
