#!/usr/bin/env bash
# Rules for the repository that no compiler checks. Prints every breach; exits 1 if there is one.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1

max_lines=400
allowed='CMakeLists.txt CMakePresets.json libs apps datasets tests doc scripts README.md CHANGELOG.md LICENSE CITATION.cff
package.xml .ci .clang-format .gitignore'
breaches=0

# breach <what> [<line>...]: one breach, unless there is no line to show.
breach()
{
	[ -n "$2" ] || return 0
	printf '%s:\n%s\n' "$1" "$2"
	breaches=$((breaches + 1))
}

files=$(git ls-files)
if [ -z "$files" ]; then
	echo "git lists no files here"
	exit 1
fi
sources=$(grep -E '\.(h|cpp)$' <<<"$files")

breach "entries that do not belong at the top" \
	"$(cut -d/ -f1 <<<"$files" | sort -u | grep -vxF -f <(tr -s ' \n' '\n' <<<"$allowed"))"

breach "paths that exist on one machine only" \
	"$(git grep -nIE '(^|[^[:alnum:]_.-])/(w[o]rk|h[o]me|r[o]ot|mn[t])/|\.\./shared')"

breach "package servers" \
	"$(git grep -nIE '(deb|https?)[ +:/]+[^ ]*(pack[a]ges\.|m[i]rror|artif[a]ct|proxy\.)')"

breach "work left open" \
	"$(git grep -nIE '\b(TO[D]O|FIX[M]E|X[X]X)\b' -- '*.h' '*.cpp' '*.sh' '*.cmake' 'CMakeLists.txt' '*/CMakeLists.txt' '*.md')"

breach "sources without an SPDX line at the top" \
	"$(for file in $sources; do head -n 1 "$file" | grep -q 'SPDX-License-Identifier: BSD-3-Clause' || echo "$file"; done)"

breach "sources above $max_lines lines" \
	"$(grep -E '^(libs|apps)/' <<<"$sources" | xargs -r wc -l | awk -v max=$max_lines '$2 != "total" && $1 > max')"

if [ "$breaches" -gt 0 ]; then
	echo "$breaches kinds of breach"
	exit 1
fi
echo "nothing to complain about in $(wc -l <<<"$files") files"
