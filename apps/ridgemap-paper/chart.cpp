// SPDX-License-Identifier: BSD-3-Clause
#include "chart.h"

#include <ridgemap/atomic_file.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../common/user_error.h"

namespace ridgemap::apps
{
void drawChart(const Setting& setting, const std::string& name, const std::string& script)
{
	AtomicFile file(setting.path(name + ".gp"));
	file.stream() << "set terminal pngcairo size 1400,900 font 'DejaVu Sans,20' lw 2\n"
				  << "set output '" << name << ".png'\n"
				  << "set datafile separator ','\n"
				  << "set grid lc rgb '#dddddd'\nset border lw 0.8\n"
				  << "set key samplen 2 spacing 1.2\n"
				  << script << "\n";
	file.commit();
	const pid_t child = fork();
	if (child == 0)
	{
		if (chdir(setting.directory.c_str()) == 0)
			execlp("gnuplot", "gnuplot", (name + ".gp").c_str(), static_cast<char*>(nullptr));
		_exit(127);
	}
	int status = 0;
	if (child < 0 || waitpid(child, &status, 0) < 0) throw UserError("cannot start gnuplot", "make room in memory");
	if (WIFEXITED(status) && WEXITSTATUS(status) == 127)
		throw UserError("gnuplot is missing", "install Debian's gnuplot-nox");
	if (status != 0) throw UserError("gnuplot failed on '" + file.path() + "'", "see its message above");
}

}  // namespace ridgemap::apps
