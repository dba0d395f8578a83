#!/usr/bin/env python3
"""A capture by another program: spheres on a plane, ray cast, in the format of docs/captures.md.

    python3 spheres.py FOLDER [WIDTH HEIGHT [SIDE]]

writes capture.json, color.exr, depth.exr, normal.exr and reference.exr (SIDE x SIDE samples a pixel, 256 by default) into
FOLDER, which must not exist. It needs nothing but Python's own library: the EXR files are written by hand, in one part,
with the layers in the channels' names, compressed by ZIP.
"""

import json
import math
import os
import struct
import sys
import zlib

# Offsets from the pixel's centre, in pixels, y down: the pattern `latin4`.
SAMPLES = [(-0.125, -0.375), (0.375, -0.125), (-0.375, 0.125), (0.125, 0.375)]
SKY_DEPTH = 1.0e6
CAMERA = {
    "position": [0.0, 1.6, 6.0],
    "target": [0.0, 0.9, 0.0],
    "up": [0.0, 1.0, 0.0],
    "vertical_fov": 0.7,
    "near": 0.1,
}
# Centre, radius, colour.
SPHERES = [
    ((-1.5, 0.8, 0.0), 0.8, (0.75, 0.18, 0.12)),
    ((0.35, 0.55, 0.9), 0.55, (0.85, 0.80, 0.70)),
    ((1.5, 1.1, -1.2), 1.1, (0.15, 0.30, 0.65)),
    ((2.3, 0.3, 1.4), 0.3, (0.20, 0.55, 0.20)),
    ((-0.4, 2.1, -2.5), 0.12, (0.90, 0.75, 0.15)),
]
SPHERES += [((-3.2 + 0.45 * k, 0.12, 2.0 - 0.9 * k), 0.12, (0.9, 0.9, 0.9)) for k in range(9)]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def minus(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def unit(a):
    length = math.sqrt(dot(a, a))
    return (a[0] / length, a[1] / length, a[2] / length)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


EYE = tuple(CAMERA["position"])
BACK = unit(minus(EYE, CAMERA["target"]))
RIGHT = unit(cross(CAMERA["up"], BACK))
UP = cross(BACK, RIGHT)
SUN = unit((0.5, 0.8, 0.45))


def nearest(origin, towards):
    """Distance in units of `towards`, world normal and colour of the nearest surface; None for the sky."""
    best, found = math.inf, None
    a = dot(towards, towards)
    for sphere in SPHERES:
        centre, radius, _ = sphere
        out = minus(origin, centre)
        b = dot(out, towards)
        below = b * b - a * (dot(out, out) - radius * radius)
        if below > 0.0:
            distance = (-b - math.sqrt(below)) / a
            if 1.0e-4 < distance < best:
                best, found = distance, sphere
    if towards[1] < 0.0 and 1.0e-4 < -origin[1] / towards[1] < best:
        return -origin[1] / towards[1], (0.0, 1.0, 0.0), (0.42, 0.40, 0.36)
    if found is None:
        return None
    centre, radius, color = found
    at = tuple(origin[k] + best * towards[k] for k in range(3))
    return best, tuple((at[k] - centre[k]) / radius for k in range(3)), color


def see(x, y, width, height):
    """Linear colour, linear depth and view-space normal at a place of the picture, in pixels from its upper left."""
    extent = math.tan(0.5 * CAMERA["vertical_fov"])
    across = (2.0 * x / width - 1.0) * extent * width / height
    upwards = (1.0 - 2.0 * y / height) * extent
    # At depth 1, so that a distance in units of it is linear depth.
    ray = tuple(across * RIGHT[k] + upwards * UP[k] - BACK[k] for k in range(3))
    hit = nearest(EYE, ray)
    if hit is None:
        return (0.35, 0.50, 0.75), SKY_DEPTH, (0.0, 0.0, 1.0)
    depth, normal, color = hit
    place = tuple(EYE[k] + depth * ray[k] + 1.0e-3 * normal[k] for k in range(3))
    facing = max(dot(normal, SUN), 0.0)
    if facing > 0.0 and nearest(place, SUN) is not None:
        facing = 0.0
    light = 0.25 + 0.1 * normal[1] + 0.9 * facing
    seen = (dot(normal, RIGHT), dot(normal, UP), dot(normal, BACK))
    return tuple(light * c for c in color), depth, seen


def attribute(name, kind, value):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value


def compressed(data):
    """ZIP as EXR has it: even and odd bytes apart, differences of neighbours, deflated."""
    apart = data[0::2] + data[1::2]
    steps = bytes([apart[0]]) + bytes((apart[k] - apart[k - 1] + 128) & 255 for k in range(1, len(apart)))
    packed = zlib.compress(steps, 9)
    return packed if len(packed) < len(data) else data


def write_exr(path, width, height, channels):
    """`channels`: by name, "half" or "float" and the values, row by row from the top."""
    kinds = {"half": (1, "e"), "float": (2, "f")}
    names = sorted(channels)
    listed = b"".join(name.encode() + b"\0" + struct.pack("<iiii", kinds[channels[name][0]][0], 0, 1, 1) for name in names)
    window = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    header = struct.pack("<ii", 20000630, 2)
    header += attribute("channels", "chlist", listed + b"\0")
    header += attribute("compression", "compression", b"\3")
    header += attribute("dataWindow", "box2i", window)
    header += attribute("displayWindow", "box2i", window)
    header += attribute("lineOrder", "lineOrder", b"\0")
    header += attribute("pixelAspectRatio", "float", struct.pack("<f", 1.0))
    header += attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0.0, 0.0))
    header += attribute("screenWindowWidth", "float", struct.pack("<f", 1.0))
    header += b"\0"
    chunks = []
    for top in range(0, height, 16):
        data = b""
        for row in range(top, min(top + 16, height)):
            for name in names:
                kind, values = channels[name]
                data += struct.pack(f"<{width}{kinds[kind][1]}", *values[row * width : (row + 1) * width])
        packed = compressed(data)
        chunks.append(struct.pack("<ii", top, len(packed)) + packed)
    place = len(header) + 8 * len(chunks)
    with open(path, "wb") as file:
        file.write(header)
        for chunk in chunks:
            file.write(struct.pack("<Q", place))
            place += len(chunk)
        file.write(b"".join(chunks))


def colors(pixels):
    return {name: ("half", [pixel[k] for pixel in pixels]) for k, name in enumerate("RGB")}


def main():
    if len(sys.argv) not in (2, 4, 5):
        sys.exit(__doc__)
    folder = sys.argv[1]
    width, height = (int(sys.argv[2]), int(sys.argv[3])) if len(sys.argv) > 3 else (320, 180)
    side = int(sys.argv[4]) if len(sys.argv) > 4 else 16
    os.makedirs(folder)
    pixels = [(x + 0.5, y + 0.5) for y in range(height) for x in range(width)]
    depth, normal, shaded = {}, {}, []
    layers = [(f"sample{k}", offset) for k, offset in enumerate(SAMPLES)] + [("centre", (0.0, 0.0))]
    for layer, (dx, dy) in layers:
        seen = [see(x + dx, y + dy, width, height) for x, y in pixels]
        depth[f"{layer}.Z"] = ("float", [z for _, z, _ in seen])
        for k, axis in enumerate("XYZ"):
            normal[f"{layer}.{axis}"] = ("half", [n[k] for _, _, n in seen])
        shaded = [color for color, _, _ in seen]
    offsets = [(k + 0.5) / side - 0.5 for k in range(side)]
    perfect = []
    for x, y in pixels:
        found = [see(x + dx, y + dy, width, height)[0] for dy in offsets for dx in offsets]
        perfect.append(tuple(sum(color[k] for color in found) / len(found) for k in range(3)))
    write_exr(f"{folder}/color.exr", width, height, colors(shaded))
    write_exr(f"{folder}/depth.exr", width, height, depth)
    write_exr(f"{folder}/normal.exr", width, height, normal)
    write_exr(f"{folder}/reference.exr", width, height, colors(perfect))
    description = {
        "schema": 1,
        "size": [width, height],
        "samples": SAMPLES,
        "shading": "centre",
        "depth": "linear",
        "camera": CAMERA,
    }
    with open(f"{folder}/capture.json", "w") as file:
        json.dump(description, file, indent=2)
        file.write("\n")


main()
