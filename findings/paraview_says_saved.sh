#!/usr/bin/env bash
# ParaView says that a picture is saved where nothing could be written.
#
# Packages: paraview and python3-paraview 5.11.0+dfsg-1+b1. Downloads some 80 MB. It needs xvfb-run.
#
# SaveScreenshot returns True, as after success, for a folder that does not exist, and on a full disk (here
# the device /dev/full, by a link); what went wrong is on the standard error only, and pvpython ends with exit code 0. SaveData, for
# a folder that does not exist, returns None as ever, throws nothing, and the script goes on.
#
# Seen:
# | SaveScreenshot, a good place: True, there is a file
# | SaveScreenshot, no such folder: True, there is no file
# | SaveScreenshot, full disk: True, there is no file
# | SaveData, a good place: None, there is a file
# | SaveData, no such folder: None, there is no file
# | exit code 0
#
# What we do: post/paraview/open_output.py looks whether the picture is there and new, and ends with exit code 3 if not.
source "$(dirname "$0")/packages.bash"
command -v xvfb-run >/dev/null || cannot_check "there is no xvfb-run"
need paraview=5.11.0+dfsg-1+b1 python3-paraview=5.11.0+dfsg-1+b1

cat >check.py <<'END'
import os

from paraview import simple

sphere = simple.Sphere()
view = simple.CreateView("RenderView")
view.ViewSize = [100, 100]
simple.Show(sphere, view)


def attempt(what, outcome, file):
    there = os.path.isfile(file) and os.path.getsize(file) > 0
    print(f"{what}: {outcome}, there is {'a' if there else 'no'} file", flush=True)


attempt("SaveScreenshot, a good place", simple.SaveScreenshot("a.png", view), "a.png")
attempt("SaveScreenshot, no such folder", simple.SaveScreenshot("absent/a.png", view), "absent/a.png")
os.symlink("/dev/full", "full.png")
attempt("SaveScreenshot, full disk", simple.SaveScreenshot("full.png", view), "full.png")
attempt("SaveData, a good place", simple.SaveData("a.vtp", proxy=sphere), "a.vtp")
attempt("SaveData, no such folder", simple.SaveData("absent/a.vtp", proxy=sphere), "absent/a.vtp")
END
check() {
  xvfb-run -a -s "-noreset -screen 0 640x480x24" pvpython --no-mpi check.py
  echo "exit code $?"
}
as_seen check
