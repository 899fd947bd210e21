#!/usr/bin/env python3
"""The same bits on every machine: one program (state_hashes.c), built by gcc and by clang, for debugging and for speed, and for
64-bit ARM (NEON, which qemu-user runs), steps the same scenes and files; then the runtime's own tests for lanes, sums and angles run
as ARM code.

Usage: check_machines.py --source DIR --build DIR [--scenes N] [--file PACKED ...]
Builds core, mechanics, runtime and their tests below --build. Fails where a line of one build differs from that of the first.
Skips (77), after all that could be compared, where a compiler, the emulator or ARM's packages of zlib and check are not there;
the packages are unpacked below --build and change nothing in the system."""
import argparse
import glob
import os
import shutil
import subprocess
import sys
import time

SKIPPED = 77
ARM_PACKAGES = ("zlib1g-dev", "check", "libsubunit-dev")
ARM_RUN = ("qemu-aarch64", "-L", "/usr/aarch64-linux-gnu")
# Run as ARM code beside the hashes: what the same bits rest on.
ARM_TESTS = ("test_wide", "test_reduce", "test_trig", "test_quat", "test_hash64", "test_packed_save", "test_neo_hookean")


def run(*command, must=True, **options):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, **options)
    if must and done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{(done.stdout + done.stderr)[-4000:]}")
    return done


class Missing(Exception):
    """What this machine lacks for one build."""


class Machine:
    """One way to build, and what runs it."""

    def __init__(self, name, compiler, build_type, arm=False, flags=""):
        self.name, self.compiler, self.build_type, self.arm, self.flags = name, compiler, build_type, arm, flags
        self.runner = ARM_RUN if arm else ()

    def build(self, source, folder, root, targets):
        for command in (self.compiler, *self.runner[:1]):
            if not shutil.which(command):
                raise Missing(f"no {command}")
        settings = [f"-DCMAKE_TOOLCHAIN_FILE={source}/cmake/aarch64.cmake", f"-DSBFMT_AARCH64_ROOT={root}"] if self.arm \
            else [f"-DCMAKE_C_COMPILER={self.compiler}"]
        if shutil.which("ccache"):
            settings.append("-DCMAKE_C_COMPILER_LAUNCHER=ccache")
        tree = os.path.join(folder, self.name)
        run("cmake", "-S", source, "-B", tree, "-G", "Ninja", f"-DCMAKE_BUILD_TYPE={self.build_type}",
            f"-DCMAKE_C_FLAGS={self.flags}", "-DSBFMT_RUNTIME_ONLY=ON", "-DSBFMT_BENCH=OFF", *settings)
        known = run("ninja", "-C", tree, "-t", "targets", "all").stdout
        run("ninja", "-C", tree, *(target for target in targets if f"\n{target}: " in known))
        return tree


MACHINES = (Machine("gcc-fast", "gcc", "Release"), Machine("gcc-debug", "gcc", "Debug"),
            Machine("gcc-native", "gcc", "Release", flags="-march=native"), Machine("clang-fast", "clang", "Release"),
            Machine("aarch64", "aarch64-linux-gnu-gcc", "Release", arm=True))


def arm_root(folder):
    """The folder with ARM's archives and headers, made by apt with lists of its own."""
    root = os.path.join(folder, "aarch64-root")
    if glob.glob(root + "/usr/lib/*/libcheck_pic.a"):
        return root
    if not shutil.which("apt-get") or not shutil.which("dpkg"):
        raise Missing("no apt-get to fetch ARM's zlib and check with")
    state = os.path.abspath(os.path.join(folder, "aarch64-apt"))
    for part in ("lists/partial", "cache/archives/partial"):
        os.makedirs(os.path.join(state, part), exist_ok=True)
    open(os.path.join(state, "status"), "w", encoding="utf-8").close()
    apt = ["apt-get", "-q", "-o", "APT::Architecture=arm64", "-o", "APT::Architectures=arm64",
           "-o", f"Dir::State::lists={state}/lists", "-o", f"Dir::Cache={state}/cache", "-o", f"Dir::State::status={state}/status"]
    run(*apt, "update", must=False)  # some of the system's sources may have nothing for ARM
    done = run(*apt, "download", *ARM_PACKAGES, must=False, cwd=state)
    packages = glob.glob(state + "/*.deb")
    if done.returncode != 0 or len(packages) < len(ARM_PACKAGES):
        raise Missing("apt-get could not fetch ARM's " + ", ".join(ARM_PACKAGES) + ": " + (done.stderr.strip() or "?").splitlines()[-1])
    for package in packages:
        run("dpkg", "-x", package, root)
    for shared in glob.glob(root + "/**/*.so*", recursive=True):
        os.remove(shared)  # archives alone, so that the emulator needs nothing but the C library
    return root


def hashes(machine, tree, arguments):
    done = run(*machine.runner, os.path.join(tree, "tests", "state_hashes"), *arguments)
    return [line for line in done.stdout.splitlines() if line.startswith(("scene ", "file "))]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--source", required=True)
    parser.add_argument("--build", required=True)
    parser.add_argument("--scenes", type=int, default=24)
    parser.add_argument("--file", action="append", default=[])
    arguments = parser.parse_args()
    source, folder = os.path.abspath(arguments.source), os.path.abspath(arguments.build)
    os.makedirs(folder, exist_ok=True)
    expected, skipped, wrong = None, [], []
    for machine in MACHINES:
        began = time.monotonic()
        try:
            root = arm_root(folder) if machine.arm else None
            tree = machine.build(source, folder, root, ("state_hashes", *(ARM_TESTS if machine.arm else ())))
        except Missing as missing:
            print(f"SKIP {machine.name}: {missing}")
            skipped.append(machine.name)
            continue
        found = hashes(machine, tree, (1, arguments.scenes, *arguments.file))
        if len(found) != arguments.scenes + len(arguments.file):
            sys.exit(f"{machine.name}: {len(found)} hashes")
        if expected is None:
            first, expected = machine.name, found
        differing = [f"{machine.name}: {here}, {first}: {there}" for here, there in zip(found, expected) if here != there]
        wrong += differing
        tests = [path for name in ARM_TESTS if machine.arm and os.path.exists(path := os.path.join(tree, "tests", name))]
        for path in tests:
            done = run(*machine.runner, path, must=False, cwd=source, env={**os.environ, "SBFMT_SOURCE_DIR": source,
                                                                            "SBFMT_BUILD_DIR": tree})
            if done.returncode != 0:
                wrong.append(f"{machine.name}: {os.path.basename(path)}\n{(done.stdout + done.stderr)[-2000:]}")
        print(f"{machine.name}: {len(found) - len(differing)} of {len(found)} hashes as {first}, {len(tests)} test programs, "
              f"{time.monotonic() - began:.0f} s", flush=True)
    if wrong:
        sys.exit("\n".join(wrong))
    if expected is None or skipped:
        sys.exit(SKIPPED)


if __name__ == "__main__":
    main()
