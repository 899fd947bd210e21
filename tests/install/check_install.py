#!/usr/bin/env python3
"""The installed package, used as its users do: find_package and pkg-config, C11 and C++17, moved to another place.

Usage: check_install.py --source DIR --scratch DIR --cc CC [--cxx CXX] --build DIR
       check_install.py ... --tarball FILE             (what `./run package` packs, unpacked)"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tarfile

CORE_HEADERS = {"sbfmt/base.h", "sbfmt/codes.h", "sbfmt/model.h", "sbfmt/asset.h", "sbfmt/packed.h", "sbfmt/gltf.h",
                "sbfmt/mechanics.h"}
# What an engine's program may need at run time.
ENGINE_NEEDS = re.compile(r"^(lib(z|m|c)\.so\.\d+|ld-linux.*|libsbrun\.so\..*|libsbfmt-(core|mechanics)\.so\..*)$")


class Trouble(Exception):
    pass


def say(text):
    print(text, flush=True)


def run(*command, environment=None, must=True):
    """Output of a command; raises an error with the output if it fails."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True,
                          env={**os.environ, **(environment or {})})
    if must and done.returncode:
        raise Trouble(f"{' '.join(map(str, command))}\n{done.stdout[-4000:]}{done.stderr[-4000:]}")
    return done.stdout if must else (done.returncode, done.stdout + done.stderr)


def expect(condition, complaint):
    if not condition:
        raise Trouble(complaint)


def files_below(folder):
    return {os.path.relpath(os.path.join(position, name), folder) for position, _, names in os.walk(folder) for name in names}


class Package:
    """An installed tree and the ways to use it."""

    def __init__(self, arguments, build):
        self.arguments = arguments
        self.build = build
        self.source = arguments.source
        self.scratch = arguments.scratch
        self.prefix = os.path.join(self.scratch, "moved", "here")
        cache = self.cache()
        self.shared = "BUILD_SHARED_LIBS:BOOL=ON" in cache
        self.runtime_only = "SBFMT_RUNTIME_ONLY:BOOL=ON" in cache
        self.has_program = not build or os.path.exists(os.path.join(build, "tools", "sbfmt"))

    def cache(self):
        """Of the tree it was built in; a tarball has none, and holds static libraries and the program."""
        if not self.build:
            return ""
        with open(os.path.join(self.build, "CMakeCache.txt"), encoding="utf-8") as file:
            return file.read()

    def install(self):
        first = os.path.join(self.scratch, "first")
        if self.build:
            run("cmake", "--install", self.build, "--prefix", first)
        else:
            self.unpack(first)
        os.makedirs(os.path.dirname(self.prefix))
        os.rename(first, self.prefix)
        found = re.search(r"CMAKE_INSTALL_LIBDIR:\w+=(.*)", self.cache())
        self.libraries = os.path.join(self.prefix, found.group(1) if found else "lib")

    def unpack(self, folder):
        """The tarball holds one folder of its own name."""
        with tarfile.open(self.arguments.tarball) as archive:
            archive.extractall(folder + "_unpacked")
        inside = os.listdir(folder + "_unpacked")
        expect(inside == [os.path.basename(self.arguments.tarball)[:-len(".tar.gz")]], f"the tarball holds {inside}")
        os.rename(os.path.join(folder + "_unpacked", inside[0]), folder)

    def check_tree(self):
        files = files_below(self.prefix)
        headers = {name[len("include/"):] for name in files if name.startswith("include/")}
        public, runtime = (files_below(os.path.join(self.source, folder, "include")) for folder in ("libsbfmt", "runtime"))
        core = CORE_HEADERS | {name for name in public if name.startswith("sbfmt/model_")}  # the chapters of model.h
        expect(headers == runtime | (core if self.runtime_only else public), f"headers installed: {sorted(headers)}")
        names = ["sbfmt-core", "sbfmt-mechanics", "sbrun"]
        if not self.runtime_only:
            names += ["sbfmt-format", "sbfmt-interchange"]
            expect("libexec/sbfmt/sbfmt-import" in files, "libexec/sbfmt/sbfmt-import is not installed")
        ending = "so" if self.shared else "a"
        installed = {re.match(r"lib(.*?)\.(a|so)", os.path.basename(name)).group(1)
                     for name in files if re.search(r"/lib[^/]*\.(a|so)$", name)}
        expect(installed == set(names), f"libraries installed: {sorted(installed)}")
        expect(all(os.path.exists(os.path.join(self.libraries, f"lib{name}.{ending}")) for name in names),
               f"libraries are not .{ending} in {self.libraries}")
        if self.has_program:
            expect("bin/sbfmt" in files, "bin/sbfmt is not installed")
            self.check_desktop(files)
        for name in files:
            if name.endswith((".cmake", ".pc", ".h")):
                with open(os.path.join(self.prefix, name), encoding="utf-8") as file:
                    text = file.read()
                for folder in (self.source, self.build, self.scratch):
                    expect(not folder or folder not in text, f"{name} speaks of {folder}: it would not survive a move")

    def check_desktop(self, files):
        """Desktops find the program for the types of its files, and the pictures that its thumbnailer draws."""
        texts = {}
        for name in ("applications/sbfmt.desktop", "mime/packages/sbfmt.xml", "thumbnailers/sbfmt.thumbnailer",
                     "icons/hicolor/scalable/mimetypes/application-x-sbf.svg"):
            expect(f"share/{name}" in files, f"share/{name} is not installed")
            with open(os.path.join(self.prefix, "share", name), encoding="utf-8") as file:
                texts[name] = file.read()
        types = set(re.findall(r'mime-type type="(.*)"', texts["mime/packages/sbfmt.xml"]))
        for name in ("applications/sbfmt.desktop", "thumbnailers/sbfmt.thumbnailer"):
            named = set(re.search(r"^MimeType=(.*);$", texts[name], re.MULTILINE).group(1).split(";"))
            expect(named == types, f"{name} is for {sorted(named)}, the types are {sorted(types)}")
        command = re.search(r"^Exec=(.*)", texts["thumbnailers/sbfmt.thumbnailer"], re.MULTILINE).group(1)
        picture = os.path.join(self.scratch, "thumbnail.png")
        values = {"%i": os.path.join(self.source, "examples", "bones", "figure.sbf"), "%o": picture, "%sx%s": "128x128"}
        words = [values.get(word, word) for word in command.split()]
        status, printed = run(os.path.join(self.prefix, "bin", words[0]), *words[1:], must=False)
        expect(status == 0 or "NO_OPENGL" in printed, f"the thumbnailer's command fails: {printed}")
        if status == 0:
            with open(picture, "rb") as file:
                head = file.read(24)
            expect(head[12:] == b"IHDR" + bytes([0, 0, 0, 128, 0, 0, 0, 128]), "the thumbnail has another size")

    def check_exports(self):
        """Shared libraries show the public calls, and their insides under a version that promises nothing."""
        for name in os.listdir(self.libraries):
            if name.startswith("lib") and name.endswith(".so"):
                table = run("nm", "-D", "--defined-only", "--with-symbol-versions", os.path.join(self.libraries, name))
                symbols = [line.split()[-1] for line in table.splitlines()]
                strange = [one for one in symbols if not re.match(
                    r"^((sbf|sbr)_\w+@@SBFMT_0|(sbfi|sbri)_\w+@@SBFMT_PRIVATE|SBFMT_(0|PRIVATE)(@.*)?)$", one)]
                expect(not strange, f"{name} exports {strange[:5]}")
                expect(len(symbols) > 3, f"{name} exports next to nothing")

    def environment(self):
        return {"PKG_CONFIG_PATH": os.path.join(self.libraries, "pkgconfig")}

    def with_cmake(self, project, *options):
        """Builds a project that uses find_package; its build folder."""
        folder = os.path.join(self.scratch, os.path.basename(project))
        run("cmake", "-G", "Ninja", "-S", project, "-B", folder, f"-DCMAKE_PREFIX_PATH={self.prefix}",
            f"-DCMAKE_C_COMPILER={self.arguments.cc}", "-DCMAKE_BUILD_TYPE=Release", *options)
        run("cmake", "--build", folder)
        return folder

    def with_pkg_config(self, module, compiler, source, *options):
        """Compiles one source with what pkg-config says; the program."""
        program = os.path.join(self.scratch, f"{os.path.basename(source)}-{os.path.basename(compiler)}")
        flags = run("pkg-config", "--cflags", "--libs", module, environment=self.environment()).split()
        run(compiler, "-Wall", "-Wextra", "-Werror", *options, source, "-x", "none", "-o", program, *flags,
            f"-Wl,-rpath,{self.libraries}")
        return program

    def check_engine(self, program):
        """An engine's program needs neither an XML parser nor assimp."""
        needs = re.findall(r"\(NEEDED\).*\[(.*)\]", run("readelf", "-d", program))
        strange = [name for name in needs if not ENGINE_NEEDS.match(name)]
        expect(needs and not strange, f"{program} needs {strange}")
        table = run("nm", program)
        foreign = re.findall(r"\b(?:xml[A-Z]|ai[A-Z]|qh_)\w+", table)
        expect(not foreign, f"{program} holds {foreign[:5]}")

    def check_page(self):
        """The installed program has all parts of a page, where this build could make them."""
        if self.build and not os.path.exists(os.path.join(self.build, "web", "sbfmt.wasm")):
            return
        page = os.path.join(self.scratch, "page.html")
        run(os.path.join(self.prefix, "bin", "sbfmt"), "export", self.bundle(), "-o", page)
        expect(os.path.getsize(page) > 200000, "the exported page is too small to hold the runtime")

    def bundle(self):
        """A packed lizard, by the installed program."""
        lizard = os.path.join(self.source, "examples", "lizard", "lizard")
        program = os.path.join(self.prefix, "bin", "sbfmt")
        packed = os.path.join(self.scratch, "lizard.sbfz")
        run(program, "convert", lizard + ".obj", "--rig", lizard + ".glb", "-o", packed)
        expect(os.path.getsize(packed) > 0, "the bundle is empty")
        return packed


def check_walk(programs, bundle):
    """Every build of the example prints the same walk, to the last bit of its state."""
    printed = {run(program, bundle) for program in programs}
    expect(len(printed) == 1, f"the programs disagree: {printed}")
    text = printed.pop()
    say(text.rstrip())
    walked = re.findall(r"root at \S+ \S+ (\S+) m, (\d+) steps", text)
    expect(len(walked) == 5 and float(walked[-1][0]) > 1, "it did not walk a metre in five seconds")
    expect(int(walked[-1][1]) >= 8, "it took fewer than eight steps in five seconds")
    expect(re.search(r"^state [0-9a-f]{16}$", text, re.MULTILINE), "no state hash")
    code, _ = run(programs[0], bundle + ".absent", must=False)
    expect(code == 1 or code == 2, f"status {code} for a file that is not there")


def main():
    parser = argparse.ArgumentParser()
    for name in ("source", "scratch", "cc"):
        parser.add_argument("--" + name, required=True)
    parser.add_argument("--cxx")
    parser.add_argument("--build")
    parser.add_argument("--tarball")
    arguments = parser.parse_args()
    shutil.rmtree(arguments.scratch, ignore_errors=True)
    os.makedirs(arguments.scratch)

    package = Package(arguments, arguments.build or "")
    package.install()
    package.check_tree()
    say("tree: good")
    if package.shared:
        package.check_exports()
        say("exported names: good")

    example = os.path.join(arguments.source, "examples", "embed_c")
    with open(os.path.join(example, "walk.c"), encoding="utf-8") as file:
        expect(len(file.readlines()) < 60, "examples/embed_c/walk.c has grown to 60 lines")
    source = os.path.join(example, "walk.c")
    programs = [os.path.join(package.with_cmake(example), "walk"),
                package.with_pkg_config("sbrun", arguments.cc, source, "-std=c11", "-Wpedantic")]
    if arguments.cxx:
        programs.append(package.with_pkg_config("sbrun", arguments.cxx, source, "-x", "c++", "-std=c++17"))
    for program in programs:
        package.check_engine(program)
    say(f"{len(programs)} builds of the engine's example: good, without libxml2 and assimp")

    if package.runtime_only:
        code, printed = run("cmake", "-S", os.path.join(arguments.source, "tests/install/sdk_user"), "-B",
                         os.path.join(arguments.scratch, "refused"), f"-DCMAKE_PREFIX_PATH={package.prefix}",
                         "-DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF", must=False)
        expect(code != 0, "a project that needs sbfmt::interchange configured against the runtime alone")
    else:
        project = os.path.join(arguments.source, "tests", "install", "sdk_user")
        package.with_cmake(project)
        package.with_pkg_config("sbfmt", arguments.cc, os.path.join(project, "sdk_user.c"), "-std=c11")
        say("SDK by find_package and by pkg-config: good")

    if package.has_program:
        package.check_page()
        say(run(os.path.join(package.prefix, "bin", "sbfmt"), "--version").rstrip())
        check_walk(programs, package.bundle())
    else:
        say("the program sbfmt is not built here, so nothing was converted and walked")


if __name__ == "__main__":
    try:
        main()
    except Trouble as trouble:
        sys.exit(str(trouble))
