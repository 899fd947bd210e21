"""A Blender with a screen of its own, which nobody sees, and what is on it."""

import glob
import os
import shutil
import subprocess

from blender_process import skip

WIDTH, HEIGHT = 1300, 1250
MOST_S = 500
# A screen's socket lies in /tmp: a Blender in another system's folder gets it there too. What it asks it asks within that folder.
LINKED = """
number=${DISPLAY#:}
socket=.X11-unix/X${number%%.*}
if [ -n "$ROOT" ]; then
  mkdir -p "$ROOT/tmp/.X11-unix"
  ln -f "/tmp/$socket" "$ROOT/tmp/$socket" || exit 77
  XAUTHORITY=${XAUTHORITY#"$ROOT"}
fi
"$@"
status=$?
[ -z "$ROOT" ] || rm -f "$ROOT/tmp/$socket"
exit $status
"""


def run_in_window(blender, script, words):
    """Runs a script of this folder; the finished process. What the screen shows lies in blender.folder as a file, `Xvfb_screen0`."""
    if not shutil.which("xvfb-run"):
        skip("there is no screen: install the package xvfb")
    if blender.root and not glob.glob(f"{blender.root}/usr/lib/*/libEGL.so.1"):
        skip(f"{blender.root} has nothing to draw with: install libegl1, libgl1 and libgl1-mesa-dri there")
    command = ["xvfb-run", "-a", "-f", os.path.join(blender.folder, "authority"),
               "-s", f"-nocursor -screen 0 {WIDTH}x{HEIGHT}x24 -fbdir {blender.folder}", "sh", "-c", LINKED, "sh", "timeout", str(MOST_S),
               *blender.command, "--factory-startup", "--window-geometry", "0", "0", str(WIDTH), str(HEIGHT),
               "--python", f"{blender.inside}/tests/{script}.py", "--", *words]
    run = subprocess.run(command, env={**blender.environment(), "ROOT": blender.root}, check=False, capture_output=True, text=True)
    if run.returncode == 77:
        skip(f"the screen's socket can't be linked into {blender.root}: it lies on another file system than /tmp")
    return run
