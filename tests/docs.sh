#!/usr/bin/env bash
# docs.sh [<ridgemap-build>]: what the documentation says is what the code says. Without a program, the checks that need
# one are left out.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=${1:-}

fail()
{
	printf '%s\n' "$*" >&2
	exit 1
}

# block <page> <language> <number>: the fenced blocks of that language in a page, counted from 1.
block()
{
	awk -v fence="\`\`\`$2" -v wanted="$3" '
		$0 == "```" { inside = 0 }
		inside && n == wanted { print }
		$0 == fence { inside = 1; n++ }' "$1"
}

# The C++ examples are those that the consumer test compiles and runs.
while read -r page number file; do
	diff <(block "$page" cpp "$number") <(tail -n +2 "tests/consumer/$file.cpp") ||
		fail "block $number of $page and tests/consumer/$file.cpp differ"
done <<-END
	README.md 1 main
	doc/cpp.md 1 match_scan
	doc/cpp.md 2 correct_poses
END

# One version everywhere.
version=$(sed -n 's/^project(ridgemap VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
grep -qx "  <version>$version</version>" package.xml || fail "package.xml is not of version $version"
grep -qx "version: $version" CITATION.cff || fail "CITATION.cff is not of version $version"

# Links between files lead somewhere.
for page in *.md doc/*.md; do
	while IFS= read -r link; do
		[ -e "$(dirname "$page")/$link" ] || fail "$page links to $link, which does not exist"
	done < <(grep -oE '\]\([^)#]+' "$page" | sed 's/^](//' | grep -vE '^[a-z]+:')
done

[ -n "$program" ] || exit 0

# The table of options is what the program says.
diff doc/options.md <(scripts/options-page.sh "$program") ||
	fail "doc/options.md is out of date; renew it with: scripts/options-page.sh '$program' >doc/options.md"

# Every setting of the INI example of the README is understood and taken over.
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
block README.md ini 1 >"$scratch/example.ini"
"$program" --config "$scratch/example.ini" --dump-config >"$scratch/dump.ini"
# settings <file>: section and key = value, without comments and padding.
settings() { sed -E 's|[[:space:]]*//.*||; s/[[:space:]]*=[[:space:]]*/=/' "$1" | awk '/^\[/ { section = $0; next } /=/ { print section $0 }' | sort; }
missing=$(comm -23 <(settings "$scratch/example.ini") <(settings "$scratch/dump.ini"))
[ -z "$missing" ] || fail "the INI example of README.md is not taken over: $missing"
