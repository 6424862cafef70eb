#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Changes the core in one place at a time and looks whether its tests notice.

A seeded sample of comparisons, signs, logical operators and constants of libs/ridgemap-core/src (all units, and headers
of one unit) is changed in a copy of the sources; for each, the core and its tests are built anew and run until the first one fails. What no test notices is
listed, with the reason where tests/core/mutants.txt gives one. Ends with an error if there is one without."""
import argparse
import os
import pathlib
import random
import re
import resource
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
CORE = "libs/ridgemap-core/src"
KNOWN = ROOT / "tests/core/mutants.txt"
MEMORY = 8 << 30  # a changed size may ask for any

# clang-format puts blanks around operators, but not around the brackets of templates.
OPERATORS = [(r" < ", [" <= ", " > "]), (r" <= ", [" < ", " >= "]), (r" > ", [" >= ", " < "]),
             (r" >= ", [" > ", " <= "]), (r" == ", [" != "]), (r" != ", [" == "]), (r" \+ ", [" - "]),
             (r" - ", [" + "]), (r" \* ", [" / "]), (r" / ", [" * "]), (r" && ", [" || "]), (r" \|\| ", [" && "]),
             (r" \+= ", [" -= "]), (r" -= ", [" += "]), (r"std::min\(", ["std::max("]), (r"std::max\(", ["std::min("]),
             (r"\btrue\b", ["false"]), (r"\bfalse\b", ["true"])]
NUMBER = re.compile(r"(?<![\w.\"'])(\d+\.?\d*(?:e[+-]?\d+)?)(f?)(?![\w.\"'x])")


def code_of(line):
    """The line without what is behind //, and nothing of directives, comments and messages."""
    text = line.split("//")[0].rstrip()
    if re.match(r"\s*(#|/?\*|using |namespace |template|static_assert)", text) or '"' in text:
        return ""
    return text


def changes_of(line):
    """All lines that one change makes of a line."""
    code = code_of(line)
    rest = line[len(code):]
    for pattern, replacements in OPERATORS:
        for match in re.finditer(pattern, code):
            for new in replacements:
                yield code[:match.start()] + new + code[match.end():] + rest
    for match in NUMBER.finditer(code):
        value, suffix = match.groups()
        # Powers of two and whole numbers are counts; everything else is a quantity.
        new = str(int(value) + 1) if value.isdigit() else repr(float(value) * 1.1)
        yield code[:match.start()] + new + suffix + code[match.end():] + rest


def all_mutants(source):
    # Other headers are in so many units that a change of one takes minutes to build.
    for path in sorted(source.glob("*.cpp")) + sorted(source.glob("*_impl.h")):
        lines = path.read_text().split("\n")
        for number, line in enumerate(lines):
            for new in changes_of(line):
                yield path.name, number, line, new


def known_reasons():
    """(file, old line, new line) -> reason, from blocks of such lines."""
    reasons = {}
    text = KNOWN.read_text() if KNOWN.exists() else ""
    for block in re.split(r"\n\s*\n", text):
        lines = [line for line in block.split("\n") if line and not line.startswith("#")]
        if len(lines) >= 4:
            reasons[(lines[0].strip(), lines[1].strip(), lines[2].strip())] = " ".join(x.strip() for x in lines[3:])
    return reasons


def copy_sources(to):
    files = subprocess.run(["git", "ls-files", "--cached", "--others", "CMakeLists.txt", "scripts/cmake", "libs/ridgemap-core", "tests/core",
                            "tests/CMakeLists.txt", "tests/fuzz"],
                           cwd=ROOT, check=True, capture_output=True, text=True).stdout.split()
    for name in files:
        target = to / name
        target.parent.mkdir(parents=True, exist_ok=True)
        content = (ROOT / name).read_bytes()
        if not target.exists() or target.read_bytes() != content:
            target.write_bytes(content)


class Tests:
    """The core and its tests, built from the copy."""

    def __init__(self, work, jobs):
        self.source, self.build, self.jobs = work / "source", work / "build", jobs
        copy_sources(self.source)
        if not (self.build / "CMakeCache.txt").exists():
            generator = ["-G", "Ninja"] if shutil.which("ninja") else []
            subprocess.run(["cmake", "-S", self.source, "-B", self.build, *generator, "-DCMAKE_BUILD_TYPE=Release",
                            "-DRIDGEMAP_BUILD_MRPT=OFF", "-DRIDGEMAP_INSTALL=OFF", "-DCMAKE_CXX_FLAGS=-w"],
                           check=True, stdout=subprocess.DEVNULL)
        self.seconds = 3600  # of the processor

    def compiles(self):
        command = ["cmake", "--build", self.build, "--parallel", str(self.jobs), "--target", "core_all"]
        return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT).returncode == 0

    def first_failure(self):
        """Name of the first test that fails, or None."""
        def limit():
            resource.setrlimit(resource.RLIMIT_CPU, (self.seconds, self.seconds))
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))

        # Fewer random scenes in each test that has them than ctest takes; one test has need of all of them.
        command = [self.build / "bin/core_all", "--gtest_fail_fast",
                   "--gtest_filter=-Exactness.EveryTraceEndsForAReasonOfTheDensity"]
        environment = {**os.environ, "RIDGEMAP_SCENES": "10"}
        try:
            run = subprocess.run(command, env=environment, preexec_fn=limit, timeout=20 * self.seconds, cwd=self.build,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
        except subprocess.TimeoutExpired:
            return "no end"
        failed = re.search(r"\[  FAILED  \] ([^\s,]+)", run.stdout)
        return failed.group(1) if failed else (f"ended with {run.returncode}" if run.returncode else None)


def try_mutant(tests, name, number, new):
    """What became of it: `not built`, `survived`, or the test that noticed it."""
    path = tests.source / CORE / name
    original = path.read_text()
    lines = original.split("\n")
    lines[number] = new
    path.write_text("\n".join(lines))
    try:
        if not tests.compiles():
            return "not built"
        return tests.first_failure() or "survived"
    finally:
        path.write_text(original)


def limit_of(tests):
    """Three times what the tests take without any change [s of the processor]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    failure = tests.first_failure()
    if failure:
        sys.exit(f"the tests do not pass without any change: {failure}")
    return 10 + int(3 * (resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=60, help="mutants that are built and tested (default 60)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0, help="leave out so many of the sample, to go on with a run")
    parser.add_argument("--file", default="", help="of source files whose name contains this, only")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--limit", type=int, default=0,
                        help="seconds of the processor for the tests of one mutant (default: three times what they take)")
    parser.add_argument("--list", action="store_true", help="show the sample without building it")
    options = parser.parse_args()

    mutants = [m for m in all_mutants(ROOT / CORE) if options.file in m[0]]
    random.Random(options.seed).shuffle(mutants)
    print(f"{len(mutants)} possible changes, seed {options.seed}", flush=True)
    if options.list:
        for name, number, old, new in mutants[options.first:options.count]:
            print(f"{name}:{number + 1}\n    {old.strip()}\n    {new.strip()}")
        return 0

    tests = Tests(ROOT / "build-mutation", options.jobs)
    if not tests.compiles():
        sys.exit("the tests cannot be built")
    tests.seconds = options.limit or limit_of(tests)

    reasons = known_reasons()
    tried, caught, explained, unexplained = options.first, 0, [], []
    for name, number, old, new in mutants[options.first:]:
        if tried >= options.count:
            break
        result = try_mutant(tests, name, number, new)
        print(f"{name}:{number + 1}: {old.strip()}  ->  {new.strip()}: {result}", flush=True)
        if result == "not built":
            continue
        tried += 1
        reason = reasons.get((name, old.strip(), new.strip()))
        if result != "survived":
            caught += 1
        elif reason:
            explained.append(reason)
        else:
            unexplained.append(f"{name}:{number + 1}")
    print(f"{caught} caught, {len(explained)} survived for a known reason, {len(unexplained)} survived: "
          + ", ".join(unexplained))
    return 1 if unexplained else 0


sys.exit(main())
