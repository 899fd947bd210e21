#!/usr/bin/env python3
"""The program for any Linux, unpacked: it needs no library but the C library's, in a version that older systems have, and does what the program of this
build does, to the byte.

Usage: check_program.py --native DIR [--newest-glibc VERSION] TARBALL"""
import argparse
import os
import sys
import tarfile
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, os.pardir, "support"))
import program_calls  # noqa: E402
from check_self_contained import faults_of_needs  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--native", required=True)
    parser.add_argument("--newest-glibc", default="2.36")
    parser.add_argument("tarball")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="sbfmt with spaces, ü ") as folder:
        with tarfile.open(arguments.tarball) as archive:
            archive.extractall(folder)
        package = os.path.join(folder, os.path.basename(arguments.tarball)[:-len(".tar.gz")])
        programs = [os.path.join(package, "bin", "sbfmt"), os.path.join(package, "libexec", "sbfmt", "sbfmt-import")]
        faults = [f"{program}: {fault}" for program in programs for fault in faults_of_needs(program, arguments.newest_glibc)]
        faults += program_calls.compare(programs[:1], [os.path.join(os.path.abspath(arguments.native), "tools", "sbfmt")], folder, name="the package")
    if faults:
        sys.exit("\n\n".join(faults))
    print(f"{len(program_calls.CALLS)} calls: the same words, statuses and bytes")


if __name__ == "__main__":
    main()
