// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/ridge_map.h>

#include <cmath>
#include <iostream>

int main()
{
	ridgemap::Options options;
	options.sigma = 0.05;  // metres; 2.5 to 3 times the noise of the sensor
	ridgemap::RidgeMap map(options);
	std::vector<ridgemap::Measurement> scan;
	for (int i = 0; i < 1000; i++) scan.push_back({0.002 * i, 0.01 * std::sin(7 * i)});
	map.insert(scan);
	for (const auto& wall : map.walls()) std::cout << wall.points.size() << " points, " << wall.length() << " m\n";
}
