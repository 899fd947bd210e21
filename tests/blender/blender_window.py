"""Runs Blender on a virtual screen and takes screenshots of it."""

import glob
import os
import resource
import shutil
import subprocess

from blender_process import skip

WIDTH, HEIGHT = 1300, 1250
MOST_CPU_S = 150  # of the processor: three times the usual, for busy machines
MOST_S = 560


class Screen:
    """An Xvfb on a free display number, so that two may start at once. Its picture is in the folder, as `Xvfb_screen0`; its
    socket, in /tmp, is linked into another system's folder too."""

    def __init__(self, folder, root):
        reads, writes = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(writes), "-screen", "0", f"{WIDTH}x{HEIGHT}x24", "-nocursor", "-nolisten",
                                        "tcp", "-fbdir", folder], pass_fds=[writes], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(writes)
        with os.fdopen(reads) as reported:
            self.number = reported.readline().strip()
        self.link = f"{root}/tmp/.X11-unix/X{self.number}" if root and self.number else ""

    def __enter__(self):
        if not self.number:
            self.__exit__()
            raise RuntimeError("Xvfb does not start: run it by hand to see why")
        if self.link:
            os.makedirs(os.path.dirname(self.link), exist_ok=True)
            if os.path.lexists(self.link):  # of a screen that is gone
                os.remove(self.link)
            try:
                os.link(f"/tmp/.X11-unix/X{self.number}", self.link)
            except OSError:
                self.link = ""
                self.__exit__()
                skip("the screen's socket can't be linked: the other system lies on another file system than /tmp")
        return self

    def __exit__(self, *_):
        if self.link and os.path.lexists(self.link):
            os.remove(self.link)
        self.server.terminate()
        self.server.wait()


def bound_the_processor():
    resource.setrlimit(resource.RLIMIT_CPU, (MOST_CPU_S, MOST_CPU_S + 5))


def run_in_window(blender, script, words):
    """Runs a script of this folder; the finished process. It ends when it has used its share of the processor."""
    if not shutil.which("Xvfb"):
        skip("there is no screen: install the package xvfb")
    if blender.root and not glob.glob(f"{blender.root}/usr/lib/*/libEGL.so.1"):
        skip(f"{blender.root} has nothing to draw with: install libegl1, libgl1 and libgl1-mesa-dri there")
    with Screen(blender.folder, blender.root) as screen:
        command = [*blender.command, "--factory-startup", "--enable-event-simulate", "--window-geometry", "0", "0", str(WIDTH), str(HEIGHT),
                   "--python", f"{blender.inside}/tests/{script}.py", "--", *words]
        return subprocess.run(command, env={**blender.environment(), "DISPLAY": f":{screen.number}"}, check=False, capture_output=True,
                              text=True, timeout=MOST_S, preexec_fn=bound_the_processor)
