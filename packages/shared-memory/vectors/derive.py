#!/usr/bin/env python3
"""Writes the conformance vectors of this folder from the layouts in docs/shared-memory.md.

Shares no code with the tested implementations. Standard library only.
"""
import json
import os
import struct

FOLDER = os.path.dirname(os.path.abspath(__file__))


def write(name, lists):
    """One vector per line, so that changes are readable."""
    parts = []
    for key, vectors in lists.items():
        rows = ",\n".join("    " + json.dumps(v) for v in vectors)
        parts.append('  "%s": [\n%s\n  ]' % (key, rows))
    with open(os.path.join(FOLDER, name), "w") as out:
        out.write("{\n" + ",\n".join(parts) + "\n}\n")


def f32(value):
    return struct.unpack("<f", struct.pack("<f", value))[0]


# The reference system's files ----------------------------------------------------------------------------------------

def flags(ready, latency, rate):
    return {"ready": ready, "latencyTest": latency, "bitsPerSecond": rate,
            "hex": struct.pack("<BBI", ready, latency, rate).hex()}


def packed(points):
    """Blocks of 150 points: all coordinates, then all colours."""
    out = b""
    for at in range(0, len(points), 150):
        block = points[at:at + 150]
        out += b"".join(struct.pack("<hhh", *p[:3]) for p in block) + b"".join(struct.pack("<H", p[3]) for p in block)
    return out


def rgb(colour):
    """The centre of each channel's quantisation step."""
    return [colour // 1024 * 4 + 2, colour // 16 % 64 * 4 + 2, colour % 16 * 16 + 8]


def cloud(name, points):
    data = packed(points)
    return {"name": name, "hex": (len(data).to_bytes(3, "little") + data).hex(),
            "points": [[f32(f32(c) / f32(1000)) for c in p[:3]] + rgb(p[3]) for p in points],
            "green": len(points) > 0 and all(p[3] == 0x03F0 for p in points)}


def control(counter, linear, angular):
    return {"counter": counter, "linear": linear, "angular": angular,
            "hex": struct.pack("<i6d", counter, *linear, *angular).hex()}


ramp = [(i * 97 % 65536 - 32768, -i * 31 % 65536 - 32768, i * 211 % 65536 - 32768, i * 1009 % 65536) for i in range(301)]
write("reference.json", {
    "flags": [flags(0, 0, 0), flags(1, 0, 30_000_000), flags(0, 1, 1), flags(1, 1, 4294967295)],
    "clouds": [
        cloud("nothing", []),
        cloud("one point", [(1, -2, 3, 0xFFFF)]),
        cloud("one block", ramp[:150]),
        cloud("a block and one point", ramp[:151]),
        cloud("three blocks, the last with one point", ramp),
        cloud("green", [(i, i, i + 1, 0x03F0) for i in range(150)]),
        cloud("green but for one", [(i, i, i + 1, 0x03F0 if i != 149 else 0x03F1) for i in range(150)]),
        {"name": "no whole points", "hex": (1201).to_bytes(3, "little").hex(), "error": "bad-length"},
        {"name": "one point too many", "hex": (1843208).to_bytes(3, "little").hex(), "error": "bad-length"},
        {"name": "the longest length", "hex": "ffffff", "error": "bad-length"},
    ],
    "control": [
        control(0, [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
        control(7, [0.5, 0.0, 0.0], [0.0, 0.0, -0.25]),
        control(-2147483648, [1.0, 2.0, 3.0], [4.0, 5.0, 6.0]),
        control(2147483647, [-0.1, 1e-9, -1e9], [0.3, 0.2, 0.1]),
    ],
})


# Farpoint's layout ---------------------------------------------------------------------------------------------------

FORMATS = {"points": 1, "depth16": 2, "depth32": 3}


def up64(n):
    return (n + 63) // 64 * 64


def colour_offset(fmt, points):
    return up64(points * (2 if fmt == "depth16" else 4))


def payload(fmt, points):
    return points * 16 if fmt == "points" else colour_offset(fmt, points) + points * 4


def header_bytes(fmt, slots, max_points, fps, pid, magic=b"FARPOINT", version=1, header=4096, slot_bytes=None):
    slot_bytes = up64(128 + payload(fmt, max_points)) if slot_bytes is None else slot_bytes
    fmt = FORMATS[fmt]
    return struct.pack("<8sIIIIIIfI", magic, version, header, fmt, slots, slot_bytes, max_points, fps, pid).ljust(64, b"\0"), slot_bytes


def good_header(name, fmt, slots, max_points, fps, pid):
    data, slot_bytes = header_bytes(fmt, slots, max_points, fps, pid)
    return {"name": name, "hex": data.hex(), "size": 4096 + slots * slot_bytes,
            "header": {"format": fmt, "slots": slots, "slotBytes": slot_bytes, "maxPoints": max_points, "framesPerSecond": fps, "pid": pid}}


def bad_header(name, error, offset, size=None, edit=None, **more):
    data, slot_bytes = header_bytes("points", more.pop("slots", 4), more.pop("max_points", 1000), 30.0, 1, **more)
    if edit is not None:
        at, value = edit
        data = data[:at] + value + data[at + len(value):]
    return {"name": name, "hex": data.hex(), "size": 4096 + 4 * slot_bytes if size is None else size, "error": error, "offset": offset}


def frame_bytes(frame, ns, width, height, flags_, position=(0, 0, 0), q=(0, 0, 0, 0), lens=(0, 0, 0, 0), unit=0.0):
    return struct.pack("<IIQIIII3d4d4dfI", frame * 2 % 2**32, frame, ns, width, height, flags_, 0, *position, *q, *lens, unit, 0)


def good_frame(name, fmt, max_points, frame, ns, width, height, position=None, q=None, lens=None, unit=0.0, latency=False):
    bits = (1 if position is not None else 0) | (2 if lens is not None else 0) | (4 if latency else 0)
    data = frame_bytes(frame, ns, width, height, bits, position or (0, 0, 0), q or (0, 0, 0, 0), lens or (0, 0, 0, 0), unit)
    assert len(data) == 128
    return {"name": name, "format": fmt, "maxPoints": max_points, "hex": data.hex(), "frame": {
        "capturedAtMs": None if ns == 0 else ns / 1e6, "width": width, "height": height,
        "pose": None if position is None else {"position": dict(zip("xyz", position)), "orientation": dict(zip("xyzw", q))},
        "lens": None if lens is None else dict(zip(("fx", "fy", "cx", "cy"), lens)),
        "latencyTest": latency, "depthUnit": f32(unit)}}


def bad_frame(name, fmt, offset, **fields):
    given = {"frame": 5, "ns": 1000000, "width": 4, "height": 3, "flags_": 3, "q": (0, 0, 0, 1), "lens": (2, 2, 1, 1), "unit": 0.001}
    given.update(fields)
    return {"name": name, "format": fmt, "maxPoints": 12, "hex": frame_bytes(**given).hex(), "error": "bad-frame", "offset": offset}


nan, inf = float("nan"), float("inf")
write("cloud.json", {
    "headers": [
        good_header("a ZED cloud", "points", 4, 230400, 30.0, 4242),
        good_header("depth in 16 bits", "depth16", 8, 640 * 480, 15.0, 1),
        good_header("depth in 32 bits, the smallest", "depth32", 16, 1, 0.0, 0),
        bad_header("another magic", "bad-magic", 7, magic=b"FARPOINs"),
        bad_header("zeros", "bad-magic", 0, magic=b"\0" * 8),
        bad_header("version 2", "bad-version", 8, version=2),
        bad_header("a short header", "bad-header", 12, header=64),
        bad_header("format 0", "bad-header", 16, edit=(16, b"\0\0\0\0")),
        bad_header("format 4", "bad-header", 16, edit=(16, b"\4\0\0\0")),
        bad_header("five slots", "bad-header", 20, slots=5),
        bad_header("no points", "bad-header", 28, edit=(28, b"\0\0\0\0")),
        bad_header("too many points", "bad-header", 28, edit=(28, struct.pack("<I", 4194305))),
        bad_header("slots too small", "bad-header", 24, slot_bytes=16064),
        bad_header("slots not aligned", "bad-header", 24, slot_bytes=16200),
        bad_header("not a rate", "bad-header", 32, edit=(32, struct.pack("<f", nan))),
        bad_header("a file too short", "bad-header", 20, size=4096),
        bad_header("a file too long", "bad-header", 20, size=1 << 20),
        bad_header("no room for a header", "truncated", 64, size=64),
    ],
    "frames": [
        good_frame("a grid with everything", "points", 12, 1, 123456789, 4, 3, (1.5, -2.0, 0.25), (-0.5, 0.5, -0.5, 0.5), (525.0, 524.5, 319.5, 239.5)),
        good_frame("no more than points", "points", 12, 4294967295, 0, 7, 1),
        good_frame("no points", "points", 12, 2, 5, 0, 1),
        good_frame("a latency test", "points", 12, 3, 5, 12, 1, latency=True),
        good_frame("millimetres", "depth16", 12, 9, 10**15, 4, 3, None, None, (2.0, 2.0, 1.5, 1.0), unit=0.001),
        good_frame("metres", "depth32", 12, 9, 1, 4, 3, (0.0, 0.0, 1.0), (0.0, 0.0, 0.0, 1.0), (2.0, 3.0, 1.5, 1.0)),
        bad_frame("too many points", "points", 16, width=13, height=1),
        bad_frame("a product beyond 32 bits", "points", 16, width=65536, height=65536),
        bad_frame("no rows", "points", 16, height=0),
        bad_frame("a position nowhere", "points", 32, position=(0, inf, 0)),
        bad_frame("no unit quaternion", "points", 56, q=(0, 0, 0, 0.5)),
        bad_frame("not a quaternion", "points", 56, q=(0, 0, nan, 1)),
        bad_frame("no focal length", "points", 88, lens=(0, 2, 1, 1)),
        bad_frame("depth without a lens", "depth32", 24, flags_=1),
        bad_frame("depth without a unit", "depth16", 120, unit=0.0),
    ],
    "payloads": [{"format": fmt, "points": n, "bytes": payload(fmt, n), "colourOffset": colour_offset(fmt, n)}
                 for fmt in FORMATS for n in (1, 16, 33, 230400)],
})
