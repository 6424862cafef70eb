# shellcheck shell=bash
# Functions that the scripts share; to be sourced.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# Debian packages, by what needs them.
# shellcheck disable=SC2034
{
	build_packages=(g++ cmake make ninja-build ccache libmrpt-dev libmrpt-tclap-dev libopencv-dev zlib1g-dev
		libgdal-dev libtinyxml2-dev libgtest-dev)
	test_packages=(libbenchmark-dev mrpt-common mrpt-apps gdal-bin clang-format shellcheck git
		xvfb xdotool imagemagick)
	demo_packages=(mrpt-common)
	paper_packages=(gnuplot-nox)
}

say() { printf '%s\n' "== $*"; }

die()
{
	printf '%s\n' "$*" >&2
	exit 1
}

as_root()
{
	if [ "$(id -u)" -eq 0 ]; then
		"$@"
	else
		command -v sudo >/dev/null || die "'$*' needs root: install sudo, or run this script as root once"
		sudo "$@"
	fi
}

apt()
{
	as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300 -o Acquire::Retries=3 "$@" </dev/null
}

is_installed() { [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

# install_missing <package>...: asks apt only when a package is not there.
install_missing()
{
	local package missing=()
	if ! command -v dpkg-query >/dev/null; then
		say "not a Debian system: nothing is installed; needed are what Debian calls $*"
		return
	fi
	for package in "$@"; do
		is_installed "$package" || missing+=("$package")
	done
	[ ${#missing[@]} -gt 0 ] || return 0
	say "installing ${missing[*]}"
	apt update || say "the package lists could not be updated; trying with those at hand"
	apt install --no-install-recommends "${missing[@]}"
}

# build <preset> [<target>...]: configures where needed and builds, all targets if none is named.
build()
{
	local preset=$1
	local directory="$root/build"
	shift
	[ "$preset" = release ] || directory="$root/build-$preset"
	if [ ! -e "$directory/CMakeCache.txt" ] && command -v ninja >/dev/null; then
		export CMAKE_GENERATOR=Ninja
	fi
	(cd "$root" && cmake --preset "$preset" && cmake --build "$directory" --parallel "$(nproc)" ${1:+--target "$@"})
}
