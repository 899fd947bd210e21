#!/usr/bin/env python3
"""Dependencies point one way: reads every #include and names those that point the other way.

The rules are those of CONTRIBUTING.md: core <- mechanics <- format <- interchange, the runtime on core and mechanics
alone, programs on the public headers alone, and each outside library in its one place."""
import re
import sys

from repo_files import ROOT, conclude, project_files, read_text

BASE = ["libsbfmt/base"]
MODEL = BASE + ["libsbfmt/model", "libsbfmt/generated"]  # the schema's tables are the model's own
CORE = MODEL + ["libsbfmt/packed", "libsbfmt/gltf"]
MECHANICS = MODEL + ["libsbfmt/mechanics"]
MOTION = MECHANICS + ["libsbfmt/motion"]
FORMAT = CORE + ["libsbfmt/mechanics", "libsbfmt/motion", "libsbfmt/xml", "libsbfmt/validate", "libsbfmt/build"]
# Folders of the runtime, each with those below it that it may use; check_calls.py holds its calls to the same.
RUNTIME = {
    "math": [],
    "shapes": ["math"],
    "animation/ik": ["math"],
    "animation/skeleton": ["math", "animation/ik"],
    "animation/gait": ["math", "shapes", "animation/ik", "animation/skeleton"],
    "model": ["math", "shapes", "animation/ik", "animation/skeleton"],
    "contact": ["math", "shapes", "model"],
    "skin": ["math", "model"],
    "rigid": ["math", "shapes", "animation/ik", "model"],
    "state": ["math", "shapes", "animation/gait", "model", "rigid"],
    "state/pose": ["math", "shapes", "animation/gait", "state"],
    "soft/solvers": ["math", "shapes", "model", "contact", "skin"],
    "soft/kernels": ["math", "model", "skin", "soft/solvers"],
    "soft/tear": ["math", "model", "state"],
    "soft": ["math", "shapes", "animation/gait", "model", "contact", "skin", "state", "state/pose", "soft/solvers", "soft/tear"],
    "prepare": ["math", "shapes", "animation/skeleton", "model", "skin", "soft/solvers"],
    "coupling/ragdoll": ["math", "animation/gait", "rigid", "state", "state/pose", "soft/solvers", "soft/tear", "soft"],
    "coupling/body_contact": ["math", "shapes", "model", "rigid", "state", "soft/solvers", "coupling/ragdoll"],
    "world/detail": ["math", "animation/gait", "skin", "state", "state/pose", "soft", "coupling/ragdoll"],
    "world": ["math", "shapes", "animation/gait", "rigid", "state", "state/pose", "soft/solvers", "soft/tear", "soft",
              "coupling/ragdoll", "coupling/body_contact", "world/detail"],
    "world/api": ["math", "shapes", "animation/gait", "model", "rigid", "state", "state/pose", "soft/solvers", "soft/kernels",
                  "soft", "prepare", "coupling/ragdoll", "coupling/body_contact", "world/detail", "world"],
    "world/query": ["math", "shapes", "animation/skeleton", "animation/gait", "model", "skin", "rigid", "state", "state/pose",
                    "soft", "coupling/ragdoll", "world/detail"],
    "world/debug": ["math", "shapes", "animation/gait", "model", "skin", "rigid", "state", "state/pose", "soft",
                    "coupling/ragdoll", "coupling/body_contact"],
}

# Where a file lies -> the folders whose inside it may use. The longest folder that fits counts.
MAY_USE = {
    "libsbfmt/base": BASE,
    "libsbfmt/model": MODEL,
    "libsbfmt/generated": MODEL,
    "libsbfmt/packed": MODEL + ["libsbfmt/packed"],
    "libsbfmt/gltf": MODEL + ["libsbfmt/packed", "libsbfmt/gltf"],
    "libsbfmt/mechanics": MECHANICS,
    "libsbfmt/motion": MOTION,
    "libsbfmt/xml": MODEL + ["libsbfmt/xml"],
    "libsbfmt/build": MECHANICS + ["libsbfmt/xml", "libsbfmt/build"],
    "libsbfmt/validate": CORE + ["libsbfmt/mechanics", "libsbfmt/build", "libsbfmt/validate"],
    "libsbfmt/interchange": FORMAT + ["libsbfmt/interchange"],  # what import and export share
    "libsbfmt/import": FORMAT + ["libsbfmt/interchange", "libsbfmt/import"],
    "libsbfmt/export": FORMAT + ["libsbfmt/interchange", "libsbfmt/export"],
    "libsbfmt/include": [],
    **{"runtime/" + folder: MOTION + ["runtime/" + one for one in [folder, *below]] for folder, below in RUNTIME.items()},
    "runtime/include": [],
    "runtime/hosts": ["runtime/hosts"],
    "tools": ["tools"],
    "bench": ["bench", "tools", "examples", "runtime/math", "runtime/animation/ik", "libsbfmt/base", "libsbfmt/build/weights",
              "libsbfmt/motion"],  # a thread pool, a crowd; solvers, weights and poses alone are not public
    "examples": ["examples"],
    "tests": None,  # anything: tests look inside
}

# Public header -> its box, and which boxes may use it.
HEADER_BOX = {
    "sbfmt/base.h": "core", "sbfmt/codes.h": "core", "sbfmt/model.h": "core", "sbfmt/asset.h": "core",
    "sbfmt/packed.h": "core", "sbfmt/gltf.h": "core", "sbfmt/io.h": "format", "sbfmt/mechanics.h": "mechanics", "sbfmt/validate.h": "format",
    "sbfmt/build.h": "format", "sbfmt/materials.h": "format", "sbfmt/convert.h": "interchange", "sbfmt/export.h": "interchange",
    "sbrun/sbrun.h": "runtime", "sbrun/animation.h": "runtime", "sbrun/record.h": "runtime", "sbrun/collision.h": "runtime",
    "sbrun/detail.h": "runtime", "sbrun/rigid.h": "runtime", "sbrun/terrain.h": "runtime",
    "sbrun/soft_body.h": "runtime", "sbrun/debug.h": "runtime", "sbrun/events.h": "runtime",
    "sbrun/query.h": "runtime",
}
BOX_USES = {
    "core": {"core"},
    "mechanics": {"core", "mechanics"},
    "format": {"core", "mechanics", "format"},
    "interchange": {"core", "mechanics", "format", "interchange"},
    "runtime": {"core", "mechanics", "runtime"},
    "program": {"core", "mechanics", "format", "interchange", "runtime"},
}
FOLDER_BOX = {
    "libsbfmt/base": "core", "libsbfmt/model": "core", "libsbfmt/generated": "core", "libsbfmt/packed": "core",
    "libsbfmt/gltf": "core",
    "libsbfmt/mechanics": "mechanics", "libsbfmt/motion": "mechanics", "libsbfmt/xml": "format", "libsbfmt/validate": "format",
    "libsbfmt/build": "format", "libsbfmt/interchange": "interchange", "libsbfmt/import": "interchange", "libsbfmt/export": "interchange",
    "runtime": "runtime",
}

# Outside header -> the only places that may know it (tests aside).
OUTSIDE = [
    (r"libxml/", ["libsbfmt/xml/", "bench/"], "libxml2"),
    (r"zlib\.h|zconf\.h", ["libsbfmt/packed/", "bench/"], "zlib"),
    (r"assimp/", ["libsbfmt/import/assimp/", "bench/"], "assimp"),
    (r"(lib)?qhull", ["libsbfmt/build/"], "qhull"),
    (r"meshoptimizer", ["libsbfmt/build/"], "meshoptimizer"),
    (r"Bullet|btBullet", ["bench/"], "Bullet, to compare with"),
    (r"jansson", ["libsbfmt/import/assimp/", "tools/", "bench/"], "jansson"),
    (r"(EGL|GL|GLES\d|KHR)/|png\.h", ["tools/render/", "tools/view/"], "drawing"),
    (r"SDL2?/", ["tools/view/"], "SDL"),
    (r"(sys|linux)/.*|unistd\.h|fcntl\.h|signal\.h|spawn\.h|dlfcn\.h|poll\.h|windows\.h",
     [r"libsbfmt/base/\w+_(posix|windows|node)\.[ch]", "libsbfmt/import/assimp/", "tools/", "bench/", "runtime/hosts/"],
     "the operating system"),
    (r"pthread\.h|threads\.h", ["tools/", "bench/", "examples/", "runtime/hosts/"], "threads: they come from the host"),
    (r"locale\.h|xlocale\.h", [], "the locale: numbers and text do without"),
]

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.MULTILINE)


def header_box(name):
    """Of a public header; the chapters of model.h, which the schema makes, are the core's."""
    return "core" if name.startswith("sbfmt/model_") else HEADER_BOX.get(name)


def longest(table, path):
    fits = [folder for folder in table if path.startswith(folder + "/")]
    return max(fits, key=len) if fits else None


def box_of(path):
    for prefix in ("libsbfmt/include/", "runtime/include/"):
        if path.startswith(prefix):
            return header_box(path[len(prefix):])
    folder = longest(FOLDER_BOX, path)
    return FOLDER_BOX[folder] if folder else "program"


def resolve(path, name, files):
    """The project file that a quoted include names, seen from `path`; None where there is none."""
    candidates = [path.rsplit("/", 1)[0] + "/" + name]
    candidates += [root + name for root in ("libsbfmt/", "runtime/", "tools/", "tests/support/",
                                            "libsbfmt/include/", "runtime/include/")]
    return next((candidate for candidate in candidates if candidate in files), None)


def faults_of(path, text, files):
    """Errors in the includes of one file; `files` is the set of all files of the project."""
    if path.startswith("tests/"):
        return []
    faults = []
    if path.startswith(("libsbfmt/include/", "runtime/include/")) and box_of(path) is None:
        return [f"{path}: a public header without a place: add it to HEADER_BOX in tests/repo/check_includes.py"]
    for match in INCLUDE.finditer(text):
        line = text.count("\n", 0, match.start()) + 1
        name, where = match.group(2), f"{path}:{line}"
        public = name.startswith(("sbfmt/", "sbrun/"))
        if match.group(1) == "<" and not public:
            for pattern, positions, what in OUTSIDE:
                if re.match(pattern, name) and not any(re.match(position, path) for position in positions):
                    faults.append(f"{where}: <{name}>: {what} has no place in this folder")
        elif public:
            if header_box(name) not in BOX_USES[box_of(path)]:
                faults.append(f"{where}: \"{name}\" belongs to {header_box(name)}, which {box_of(path)} must not use")
        else:
            target = resolve(path, name, files)
            if target is None:
                if path.startswith(("libsbfmt/", "runtime/")):
                    faults.append(f"{where}: \"{name}\" is nowhere in the project")
                continue
            folder = longest(MAY_USE, path)
            allowed = MAY_USE[folder] if folder else []
            if allowed is not None and not any(target.startswith(one + "/") for one in allowed):
                faults.append(f"{where}: \"{name}\" lies in {target.rsplit('/', 1)[0]}, which {folder} must not use")
    return faults


def main():
    files = project_files()
    known, faults, read = set(files), [], 0
    for path in files:
        if path.endswith((".c", ".h", ".cpp")):
            faults += faults_of(path, read_text(path) or "", known)
            read += 1
    if read < 20:
        sys.exit(f"only {read} sources found below {ROOT}: the check would be empty")
    conclude(f"include directions of {read} files", faults)


if __name__ == "__main__":
    main()
