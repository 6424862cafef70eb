#!/usr/bin/env bash
# Repeats the experiments of the paper: pictures, data and a page that puts each beside what the paper says.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage="usage: scripts/reproduce.sh [--quick] [--docs] [DIRECTORY]
  --quick    fewer repetitions: less than a minute in place of about ten
  --docs     renew doc/paper.md and its pictures, too
  DIRECTORY  where to write (default: paper-output)"

quick=()
docs=no
directory=
for argument in "$@"; do
	case $argument in
		--quick) quick=(--quick) ;;
		--docs) docs=yes ;;
		--help)
			printf '%s\n' "$usage"
			exit
			;;
		-*) die "$usage" ;;
		*) directory=$argument ;;
	esac
done
directory=${directory:-$root/paper-output}

install_missing "${build_packages[@]}" "${paper_packages[@]}"
say "building"
build release ridgemap-paper

commit=$(git -C "$root" rev-parse --short HEAD 2>/dev/null || echo unknown)
[ -z "$(git -C "$root" status --porcelain --untracked-files=no -- libs apps 2>/dev/null)" ] || commit="$commit with changes"
machine=$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo | head -n 1)
say "running the experiments"
"$root/build/bin/ridgemap-paper" -o "$directory" "${quick[@]}" \
	--note "Commit $commit, ${machine:-$(uname -m)} with $(nproc) cores, $(date +%F)."

if [ "$docs" = yes ]; then
	mkdir -p "$root/doc/images/paper"
	cp "$directory"/*.png "$root/doc/images/paper/"
	cp "$directory/paper.md" "$root/doc/paper.md"
fi
say "page: $directory/index.html"
