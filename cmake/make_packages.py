#!/usr/bin/env python3
"""Makes all packages for users from built trees, and lists their SHA-256 in SHA256SUMS.

Usage: make_packages.py --static DIR [--shared DIR] [--self-contained DIR] [--node DIR] [--windows DIR] --out DIR [NAME...]

    debian    libsbfmt_*.deb libsbfmt-dev_*.deb sbfmt_*.deb   from the tree of shared libraries (needs dpkg-shlibdeps and file)
    tarball   sbfmt-VERSION-SYSTEM.tar.gz         relocatable: static libraries, headers, CMake package, pkg-config files, the program
    linux     sbfmt-program-VERSION-SYSTEM.tar.gz the program for any Linux, from the tree of self-contained libraries
    windows   sbfmt-VERSION-windows-x86_64.zip    the program, and the SDK as a DLL with headers and CMake package, from the tree of --windows
    npm       sbfmt-npm-VERSION.tgz               the runtime as WebAssembly with its module (needs clang, lld, wasi-libc and npm)
    program   sbfmt-cli-VERSION.tgz               the program as WebAssembly for Node.js, from the tree of --node
    studio    sbfmt-studio-VERSION.zip            the page where a mesh becomes a character, from the trees of --static and --node
    blender   sbfmt-blender-VERSION.zip           the add-on for Blender, with its libraries; from the tree of self-contained libraries if
                                                  there is one: then it needs only the system's C library. Else for this SYSTEM alone
    godot     sbfmt-godot-VERSION-SYSTEM.zip      addons/sbfmt for a Godot project (needs Godot 4.6)

Makes the named packages, or all if none is named. Prints a table of the packages, with the reason if one was not made; then the exit
status is 1. The output folder is replaced and holds only these packages."""
import argparse
import glob
import gzip
import hashlib
import json
import os
import platform
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import zipfile

HERE = os.path.dirname(os.path.abspath(__file__))
STAMP = (2026, 1, 1, 0, 0, 0)  # a fixed date: the same files give the same bytes
STAMP_S = 1767225600


class CommandError(Exception):
    """A command failed. The text holds the command and the end of its output."""


def run(*command, folder=None):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, cwd=folder, check=False)
    if done.returncode:
        raise CommandError(f"{' '.join(map(str, command))}\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
    return done.stdout


def cache_of(build):
    path = os.path.join(build, "CMakeCache.txt")
    if not os.path.exists(path):
        sys.exit(f"{build} is not a build tree of CMake: ./run package makes both trees that are needed")
    with open(path, encoding="utf-8") as file:
        return dict(re.match(r"([^:]+):\w+=(.*)", line).groups() for line in file if re.match(r"\w[^:]*:\w+=", line))


def has_target(build, name):
    return re.search(rf"^{name}: ", run("cmake", "--build", build, "--target", "help"), re.MULTILINE) is not None


def files_below(folder):
    for base, folders, names in os.walk(folder):
        folders.sort()
        for name in sorted(names):
            path = os.path.join(base, name)
            yield path, os.path.relpath(path, folder)


def write_tar(folder, top, out):
    def plain(entry):
        entry.mtime, entry.uid, entry.gid, entry.uname, entry.gname = STAMP_S, 0, 0, "root", "root"
        return entry
    with open(out, "wb") as file, gzip.GzipFile("", "wb", fileobj=file, mtime=STAMP_S) as packed, \
            tarfile.open(fileobj=packed, mode="w") as archive:
        for path, name in files_below(folder):
            archive.add(path, f"{top}/{name}", filter=plain)


def write_zip(folder, out):
    with zipfile.ZipFile(out, "w") as archive:
        for path, name in files_below(folder):
            entry = zipfile.ZipInfo(name, STAMP)
            entry.external_attr = (os.stat(path).st_mode & 0o777) << 16  # keep the executable bit
            entry.compress_type = zipfile.ZIP_DEFLATED
            with open(path, "rb") as file:
                archive.writestr(entry, file.read())


class Packages:
    """One method per package. Each writes files to `out`, or returns the reason why it cannot."""

    def __init__(self, static, shared, self_contained, node, windows, out):
        self.static, self.shared, self.self_contained, self.node, self.windows_tree, self.out = static, shared, self_contained, node, windows, out
        cache = cache_of(static)
        if cache.get("BUILD_SHARED_LIBS") == "ON":
            sys.exit(f"{static} is a tree of shared libraries; --static wants one without BUILD_SHARED_LIBS")
        if shared and cache_of(shared).get("BUILD_SHARED_LIBS") != "ON":
            sys.exit(f"{shared} is a tree of static libraries; --shared wants one with BUILD_SHARED_LIBS")
        self.version = cache["CMAKE_PROJECT_VERSION"]
        self.system = f"{platform.system().lower()}-{platform.machine()}"

    def path(self, kind, ending, native=True):
        middle = f"-{self.system}" if native else ""
        return os.path.join(self.out, f"sbfmt{'-' + kind if kind else ''}-{self.version}{middle}{ending}")

    def debian(self):
        if not self.shared:
            return "no tree of shared libraries was given"
        for command, package in (("dpkg-shlibdeps", "dpkg-dev"), ("file", "file")):
            if not shutil.which(command):
                return f"{command} is not installed (package {package})"
        with tempfile.TemporaryDirectory() as scratch:
            run("cpack", "-G", "DEB", "-B", scratch, folder=self.shared)
            made = glob.glob(os.path.join(scratch, "*.deb"))
            names = sorted(os.path.basename(path).split("_")[0] for path in made)
            if names != ["libsbfmt", "libsbfmt-dev", "sbfmt"]:
                return f"cpack made {names}"
            for path in made:
                shutil.copy(path, self.out)
        return None

    def tarball(self):
        with tempfile.TemporaryDirectory() as scratch:
            run("cmake", "--install", self.static, "--strip", "--prefix", scratch)
            out = self.path("", ".tar.gz")
            write_tar(scratch, os.path.basename(out)[:-len(".tar.gz")], out)
        return None

    def linux(self):
        if not self.self_contained or not has_target(self.self_contained, "sbfmt"):
            return "the libraries that a program for any Linux is linked with were not built"
        with tempfile.TemporaryDirectory() as scratch:
            run("cmake", "--install", self.self_contained, "--strip", "--component", "tools", "--prefix", scratch)
            shutil.copytree(os.path.join(self.static, "web"), os.path.join(scratch, "share", "sbfmt", "web"), dirs_exist_ok=True)
            self.add_licences(self.self_contained, scratch)
            out = self.path("program", ".tar.gz")
            write_tar(scratch, os.path.basename(out)[:-len(".tar.gz")], out)
        return None

    def windows(self):
        if not self.windows_tree:
            return "no tree for Windows was named: ./run package windows makes one where Debian's mingw-w64 is"
        with tempfile.TemporaryDirectory() as scratch:
            out = os.path.join(self.out, f"sbfmt-{self.version}-windows-x86_64.zip")
            inside = os.path.join(scratch, os.path.basename(out)[:-len(".zip")])
            for component in ("tools", "sdk"):
                run("cmake", "--install", self.windows_tree, "--strip", "--component", component, "--prefix", inside)
            shutil.copytree(os.path.join(self.static, "web"), os.path.join(inside, "share", "sbfmt", "web"), dirs_exist_ok=True)
            self.add_licences(self.windows_tree, inside)
            write_zip(scratch, out)
        return None

    def add_licences(self, tree, folder):
        """Of this project, and of the libraries that are linked into its programs."""
        shutil.copytree(os.path.join(cache_of(tree)["SBFMT_STATIC_LIBRARIES"], "licences"), os.path.join(folder, "licences"))
        shutil.copyfile(os.path.join(HERE, "..", "LICENSE"), os.path.join(folder, "licences", "sbfmt.txt"))

    def tree_of(self, name):
        """The build tree whose static libraries are inside a package."""
        return {"linux": self.self_contained, "blender": self.self_contained, "windows": self.windows_tree, "program": self.node,
                "studio": self.node}.get(name)

    def npm(self):
        if not has_target(self.static, "sbfmt-npm"):
            return "the tree has no WebAssembly or npm: install clang, lld, wasi-libc, libclang-rt-VERSION-dev-wasm32 and npm"
        run("cmake", "--build", self.static, "--target", "sbfmt-npm")
        shutil.copyfile(os.path.join(self.static, f"sbfmt-{self.version}.tgz"), self.path("npm", ".tgz", native=False))
        return None

    def program(self):
        if not self.node:
            return "no tree for Node.js was named: ./run package program makes one where Debian's emscripten is"
        run("cmake", "--build", self.node, "--target", "sbfmt-program")
        shutil.copyfile(os.path.join(self.node, f"sbfmt-cli-{self.version}.tgz"), self.path("cli", ".tgz", native=False))
        return None

    def studio(self):
        if not self.node:
            return "no tree for Node.js was named: ./run package studio makes one where Debian's emscripten is"
        run("cmake", "--build", self.node, "--target", "sbfmt-workers")
        with tempfile.TemporaryDirectory() as scratch:
            run(sys.executable, "-B", os.path.join(HERE, "..", "runtime", "hosts", "studio", "make_studio.py"), "--web", os.path.join(self.static, "web"),
                "--worker", self.node, "--program", os.path.join(self.static, "tools", "sbfmt"), "--out", os.path.join(scratch, "sbfmt-studio"))
            write_zip(scratch, self.path("studio", ".zip", native=False))
        return None

    def blender(self):
        tree = self.self_contained or self.static
        run("cmake", "--build", tree, "--target", "blender-addon")
        shutil.copyfile(os.path.join(tree, "soft_body_format.zip"), self.path("blender", ".zip", native=not self.self_contained))
        return None

    def godot(self):
        if not has_target(self.static, "sbfmt-godot"):
            return "there is no Godot 4.6: tests/other_system.sh build/other-system fetches one, then configure anew"
        with tempfile.TemporaryDirectory() as scratch:
            run("cmake", "--build", self.static, "--target", "sbfmt-godot")
            run("cmake", "--install", self.static, "--strip", "--component", "godot", "--prefix", scratch)
            write_zip(scratch, self.path("godot", ".zip"))
        return None


NAMES = ("debian", "tarball", "linux", "windows", "npm", "program", "studio", "blender", "godot")


# Of the libraries that cmake/static_libraries.sh builds; those of the SDK alone come first.
LICENCES = {"zlib": "Zlib", "libxml2": "MIT", "qhull": "Qhull", "meshoptimizer": "MIT", "jansson": "MIT", "libpng1.6": "libpng-2.0",
            "libjpeg-turbo": "IJG AND BSD-3-Clause AND Zlib", "libwebp": "BSD-3-Clause", "minizip": "Zlib", "assimp": "BSD-3-Clause", "libsdl2": "Zlib"}
LIBRARIES_OF_SDK = ("zlib", "libxml2", "qhull", "meshoptimizer")


def spdx_package(name, identifier, version, licence, sum_of):
    return {"name": name, "SPDXID": f"SPDXRef-{identifier}", "versionInfo": version, "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
            "licenseConcluded": "NOASSERTION", "licenseDeclared": licence, "copyrightText": "NOASSERTION",
            "checksums": [{"algorithm": "SHA256", "checksumValue": sum_of}]}


def write_bill(packages, made, folder):
    """The software bill of materials: SPDX 2.3. `made`: the new files of each package by its name."""
    listed, relations = {}, []
    for name, files in made.items():
        tree = packages.tree_of(name)
        sources = os.path.join(cache_of(tree)["SBFMT_STATIC_LIBRARIES"], "licences", "sources") if tree else ""
        inside = [line.split() for line in open(sources, encoding="utf-8")] if sources and os.path.exists(sources) else []
        for file in sorted(files):
            identifier = re.sub(r"[^A-Za-z0-9.-]", "-", file)
            with open(os.path.join(folder, file), "rb") as stream:
                listed[identifier] = spdx_package(file, identifier, packages.version, "MIT", hashlib.sha256(stream.read()).hexdigest())
            relations.append(("SPDXRef-DOCUMENT", "DESCRIBES", f"SPDXRef-{identifier}"))
            for library, version, sum_of in inside:
                if name == "blender" and library not in LIBRARIES_OF_SDK:
                    continue
                listed[library] = spdx_package(library, library, version, LICENCES[library], sum_of)
                relations.append((f"SPDXRef-{identifier}", "CONTAINS", f"SPDXRef-{library}"))
    bill = {"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"sbfmt-{packages.version}",
            "documentNamespace": f"urn:sbfmt:{packages.version}", "creationInfo": {"created": "2026-01-01T00:00:00Z", "creators": ["Tool: make_packages.py"]},
            "packages": [listed[key] for key in sorted(listed)],
            "relationships": [{"spdxElementId": one, "relationshipType": kind, "relatedSpdxElement": other} for one, kind, other in relations]}
    with open(os.path.join(folder, f"sbfmt-{packages.version}.spdx.json"), "w", encoding="utf-8") as file:
        json.dump(bill, file, indent=1)
        file.write("\n")


def write_sums(folder):
    lines = []
    for path, name in files_below(folder):
        with open(path, "rb") as file:
            lines.append(f"{hashlib.sha256(file.read()).hexdigest()}  {name}\n")
    with open(os.path.join(folder, "SHA256SUMS"), "w", encoding="utf-8") as file:
        file.writelines(lines)


def make_each(packages, names):
    """Makes the packages and prints a row of the table for each. Returns how many could not be made, and the files of the others by package."""
    missing, made = 0, {}
    for name in names:
        before = set(os.listdir(packages.out))
        try:
            reason = getattr(packages, name)()
        except CommandError as error:
            print(error, file=sys.stderr)
            reason = "a command failed; see its output above"
        print(f"{name:8}  {'NOT MADE: ' + reason if reason else 'made'}", flush=True)
        missing += bool(reason)
        made[name] = set(os.listdir(packages.out)) - before
    return missing, made


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--static", required=True)
    parser.add_argument("--shared", default="")
    parser.add_argument("--self-contained", default="")
    parser.add_argument("--node", default="")
    parser.add_argument("--windows", default="")
    parser.add_argument("--out", required=True)
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(NAMES))
    arguments = parser.parse_args()
    unknown = [name for name in arguments.names if name not in NAMES]
    if unknown:
        parser.error(f"no package {', '.join(unknown)}; there are {', '.join(NAMES)}")
    out = os.path.abspath(arguments.out)
    os.makedirs(os.path.dirname(out), exist_ok=True)
    beside = tempfile.mkdtemp(prefix=os.path.basename(out) + ".", dir=os.path.dirname(out))
    try:
        packages = Packages(os.path.abspath(arguments.static), arguments.shared and os.path.abspath(arguments.shared),
                            arguments.self_contained and os.path.abspath(arguments.self_contained),
                            arguments.node and os.path.abspath(arguments.node), arguments.windows and os.path.abspath(arguments.windows),
                            beside)
        missing, made = make_each(packages, arguments.names or NAMES)
        write_bill(packages, made, beside)
        write_sums(beside)
        os.chmod(beside, 0o755)
        shutil.rmtree(out, ignore_errors=True)
        os.rename(beside, out)
    finally:
        shutil.rmtree(beside, ignore_errors=True)
    for path, name in files_below(out):
        print(f"{os.path.getsize(path):>10}  {name}")
    sys.exit(1 if missing else 0)


if __name__ == "__main__":
    main()
