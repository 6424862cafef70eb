#!/usr/bin/env bash
# options-page.sh <ridgemap-build>: writes doc/options.md, made from the commented INI file that the program prints.
set -euo pipefail

[ $# -eq 1 ] || {
	echo "usage: scripts/options-page.sh <ridgemap-build>" >&2
	exit 1
}

cat <<'END'
# Options

Setting only `sigma` gives a good map. This page is made by `scripts/options-page.sh` from what
`ridgemap-build --dump-config` prints; a test compares the two. That output is a complete INI file, for
`ridgemap-build --config` as well as for MRPT programs; `ridgemap-build --set KEY=VALUE` sets a single option.
END

"$1" --dump-config | awk '
	/^\[/ {
		section = $0
		next
	}
	/=/ && section ~ /Opts\]$/ {
		split_at = index($0, "=")
		key = substr($0, 1, split_at - 1)
		rest = substr($0, split_at + 1)
		comment_at = index(rest, "//")
		value = comment_at ? substr(rest, 1, comment_at - 1) : rest
		comment = comment_at ? substr(rest, comment_at + 2) : ""
		gsub(/^[ \t]+|[ \t\r]+$/, "", key)
		gsub(/^[ \t]+|[ \t\r]+$/, "", value)
		gsub(/^[ \t]+|[ \t\r]+$/, "", comment)
		gsub(/\|/, "\\|", comment)
		if (section != shown) {
			printf "\n## `%s`\n\n| key | default | meaning |\n|---|---|---|\n", section
			shown = section
		}
		printf "| `%s` | `%s` | %s |\n", key, value, comment
	}'
