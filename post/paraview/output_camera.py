"""Boxes in space, arrows in them, and where the camera stands to see them whole. Knows nothing of ParaView.

A box: x from, x to, y from, y to, z from, z to.
"""

import itertools
import math

VIEW_ANGLE = 22  # degrees, from the lower to the upper edge
# Shares of the picture that the boxes may fill: left and right stand the colour bars.
WIDTH, HEIGHT = 0.65, 0.94


def flat_box(bounds, axis, position):
    """The box of a slice through bounds."""
    box = list(bounds)
    box[2 * axis : 2 * axis + 2] = [position, position]
    return box


def union(boxes):
    """The smallest box around boxes."""
    return [(min, max)[k % 2](box[k] for box in boxes) for k in range(6)]


def middle(box):
    """The middle of a box."""
    return [0.5 * (box[2 * k] + box[2 * k + 1]) for k in range(3)]


def lattice(bounds, axis, position, n):
    """Places of arrows in the plane across an axis: n of them along its longer side, in squares, half a square from the sides.

    Returns (the corner, the corner at the end of the first side, of the second), (numbers along these sides), spacing. A side that
    is shorter than two squares has two.
    """
    sides = [k for k in range(3) if k != axis]
    extents = [bounds[2 * k + 1] - bounds[2 * k] for k in sides]
    spacing = max(extents) / n
    numbers = [max(2, round(extent / spacing)) for extent in extents]
    insets = [0.5 * extent / number for extent, number in zip(extents, numbers)]
    corner = [position] * 3
    for side, inset in zip(sides, insets):
        corner[side] = bounds[2 * side] + inset
    corners = [corner]
    for side, inset in zip(sides, insets):
        corners.append([bounds[2 * k + 1] - inset if k == side else corner[k] for k in range(3)])
    return corners, numbers, spacing


def view_axes(normal, axes):
    """(axis to the right, axis up) of a view along the normal of a slice; `axes`: of flow, vorticity and walls."""
    flow, vorticity, wall = axes
    return {vorticity: (flow, wall), wall: (flow, vorticity), flow: (vorticity, wall)}[normal]


def directions(right, up, azimuth, elevation):
    """Unit vectors to the right, up and to the camera, which is turned by two angles (degrees) out of the view along an axis."""
    azimuth, elevation = math.radians(azimuth), math.radians(elevation)
    # Straight ahead the camera stands where right x up points.
    ahead = 3 - right - up
    sign = 1.0 if (right + 1) % 3 == up else -1.0
    across, upwards, to_camera = ([0.0] * 3 for _ in range(3))
    across[right], across[ahead] = math.cos(azimuth), -sign * math.sin(azimuth)
    level = [0.0] * 3
    level[right], level[ahead] = math.sin(azimuth), sign * math.cos(azimuth)
    for k in range(3):
        to_camera[k] = math.cos(elevation) * level[k] + math.sin(elevation) * (k == up)
        upwards[k] = math.cos(elevation) * (k == up) - math.sin(elevation) * level[k]
    return across, upwards, to_camera


def place(boxes, right, up, aspect, oblique=False, zoom=1.0):
    """(position, focal point, direction up) of a camera that sees the boxes whole, a little from the side and from above.

    `oblique`: more so, as several slices need. `aspect`: width over height of the picture.
    """
    across, upwards, to_camera = directions(right, up, *((-38.0, 24.0) if oblique else (-24.0, 14.0)))
    centre = middle(union(boxes))
    tangent = math.tan(math.radians(0.5 * VIEW_ANGLE))
    distance = 0.0
    for box in boxes:
        for corner in itertools.product(box[0:2], box[2:4], box[4:6]):
            from_centre = [corner[k] - centre[k] for k in range(3)]
            x, y, z = (sum(a * b for a, b in zip(from_centre, direction)) for direction in (across, upwards, to_camera))
            # |x| and |y| must lie within their shares of the frustum at the depth of the corner.
            distance = max(distance, z + abs(x) / (WIDTH * aspect * tangent), z + abs(y) / (HEIGHT * tangent))
    distance = (distance or 1.0) / zoom
    return [centre[k] + distance * to_camera[k] for k in range(3)], centre, upwards
