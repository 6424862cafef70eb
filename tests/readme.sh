#!/usr/bin/env bash
# The C++ example of the README is the one that the consumer test compiles and runs.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# block <language>: the first fenced block of that language in the README.
block() { awk -v fence="\`\`\`$1" '$0 == "```" && inside { exit } inside { print } $0 == fence { inside = 1 }' README.md; }

diff <(block cpp) <(tail -n +2 tests/consumer/main.cpp) ||
	{
		echo "the C++ example of README.md differs from tests/consumer/main.cpp"
		exit 1
	}
