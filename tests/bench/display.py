"""A display for programs with windows."""

import contextlib
import os
import shutil
import subprocess
import sys


@contextlib.contextmanager
def display():
    """The environment of a viewer: the desktop there is, or a display in memory."""
    if os.environ.get("DISPLAY"):
        yield dict(os.environ)
        return
    if not shutil.which("Xvfb"):
        sys.exit("error: no display; install Debian's package xvfb")
    read_end, write_end = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write_end), "-screen", "0", "1400x900x24"],
        pass_fds=[write_end], stderr=subprocess.DEVNULL)
    os.close(write_end)
    with os.fdopen(read_end) as number:
        name = ":" + number.readline().strip()
    try:
        yield dict(os.environ, DISPLAY=name)
    finally:
        server.terminate()
        server.wait()
