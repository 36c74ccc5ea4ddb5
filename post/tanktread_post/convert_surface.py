"""Surfaces of other programs as the .vtu that `mesh = { file = ... }` of a case reads, and back."""

import math

import numpy

from . import surface_files, whole_file
from .observables import InputError
from .surface import MERGE_TOLERANCE
from .surface_repair import repaired

LARGEST_TOLERANCE = 0.01


def convert(source, target, scale=1.0, merge_tolerance=MERGE_TOLERANCE, body=None, ascii=False, gmsh_version="4.1", force=False):
    """Reads, repairs, checks and writes a surface; the lines to print. Without a target it only checks.

    @throws InputError; nothing is written then
    """
    _require_options(scale, merge_tolerance)
    suffix = None if target is None else _target_suffix(target, ascii, force)
    surface, notes = surface_files.read_surface(source)
    lines = [f"{source}: {len(surface.points)} nodes, {int(surface.faces[-1]) + 1} faces"] + notes
    surface, notes = repaired(surface, source, merge_tolerance, body)
    surface.points = surface.points * scale
    lines += notes
    counts = f"{len(surface.points)} nodes, {len(surface.triangles)} triangles, volume {surface.volume():.10g}"
    if target is None:
        return lines + [f"a membrane can be made of it: {counts}"]
    with whole_file.writing(target) as temporary:
        surface_files.write_surface(temporary, suffix, surface, ascii, gmsh_version)
    if suffix == ".stl" and not ascii:
        moved = numpy.abs(surface.points.astype(numpy.float32) - surface.points).max()
        lines.append(f"single precision moved coordinates by up to {moved:.2g}; --ascii keeps all digits")
    return lines + [f"{target}: {counts}"]


def _require_options(scale, merge_tolerance):
    if not (math.isfinite(scale) and scale > 0):
        raise InputError(f"--scale {scale:g}: it must be a positive number")
    if not 0 <= merge_tolerance <= LARGEST_TOLERANCE:
        allowed = f"from 0 to {LARGEST_TOLERANCE:g}, a fraction of the surface's size"
        raise InputError(f"--merge-tolerance {merge_tolerance:g}: it must lie {allowed}")


def _target_suffix(target, ascii, force):
    suffix = surface_files.suffix_of(target, surface_files.WRITTEN)
    if ascii and suffix not in surface_files.HAVE_TEXT_AND_BINARY:
        forms = ", ".join(surface_files.HAVE_TEXT_AND_BINARY)
        raise InputError(f"{target}: --ascii is for {forms} only; .obj and .off are always text, a .vtu never (it would lose digits)")
    whole_file.require_place(target, force)
    return suffix
