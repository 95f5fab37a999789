#!/usr/bin/env python3
"""Writes the conformance vectors of this folder from the layouts in docs/protocol.md.

Shares no code with the implementations that are tested against them. Standard library only.
"""
import base64
import copy
import json
import os
import struct
from fractions import Fraction

FOLDER = os.path.dirname(os.path.abspath(__file__))


def write(name, lists):
    """One vector a line, so that a change can be read."""
    parts = []
    for key, vectors in lists.items():
        rows = ",\n".join("    " + json.dumps(v, ensure_ascii=True) for v in vectors)
        parts.append('  "%s": [\n%s\n  ]' % (key, rows))
    with open(os.path.join(FOLDER, name), "w") as out:
        out.write("{\n" + ",\n".join(parts) + "\n}\n")


def f32(value):
    return struct.unpack("<f", struct.pack("<f", value))[0]


# points64 ------------------------------------------------------------------------------------------------------------

def millimetres(metres):
    """Exact: half away from zero, saturating."""
    exact = Fraction(metres) * 1000
    whole = int(abs(exact) + Fraction(1, 2))
    return min(whole, 32767) * (1 if exact >= 0 else -1)


def saturated(metres):
    return abs(Fraction(metres) * 1000) >= 32767 + Fraction(1, 2)


def colour(r, g, b):
    return (r // 4) * 1024 + (g // 4) * 16 + b // 16


quantise = []
for text in ["0", "-0.0", "1", "-1", "0.0004", "-0.0004", "0.0005", "-0.0005", "0.0015", "-0.0015", "0.0025", "1.2345",
             "-1.2345", "0.4995", "2.0005", "7.8125", "-7.8125", "0.0625", "0.1875", "0.3125", "12.9995", "32.766", "32.767",
             "-32.767", "32.7674", "32.7675", "-32.7675", "32.768", "-32.768", "100", "-1e9", "1e-30", "0.0312500", "0.0078125",
             "-0.0078125", "0.1484375", "-0.1484375"]:
    value = f32(float(text))
    quantise.append({"metres": value, "millimetres": millimetres(value), "saturated": saturated(value)})


def block(name, points):
    xyz = b"".join(struct.pack("<hhh", *(millimetres(f32(c)) for c in p[:3])) for p in points)
    colours = b"".join(struct.pack("<H", p[3]) for p in points)
    return {
        "name": name, "metres": [[f32(c) for c in p[:3]] for p in points], "colours": [p[3] for p in points],
        "saturated": sum(any(saturated(f32(c)) for c in p[:3]) for p in points), "hex": (xyz + colours).hex(),
    }


def scatter(n, seed):
    """Points without any pattern, from a 32-bit linear congruential generator (Numerical Recipes)."""
    state, out = seed, []
    for _ in range(n):
        row = []
        for _ in range(4):
            state = (state * 1664525 + 1013904223) % 2 ** 32
            row.append(state >> 16)
        out.append((row[0] / 4096 - 8, row[1] / 4096 - 8, row[2] / 4096 + 0.25, row[3]))
    return out


write("points64.json", {
    "quantise": quantise,
    "blocks": [
        block("one point", [(1.0, -2.0, 3.0, 0xABCD)]),
        block("two points: coordinates first, then colours", [(0.001, 0.002, 0.003, 1), (0.004, 0.005, 0.006, 0xFFFE)]),
        block("negative, and halves away from zero", [(-0.0625, 0.0625, 0.1875, 0), (-0.1875, -0.3125, 0.3125, 0x8000)]),
        block("beyond the range: saturates, and is counted once a point",
              [(40.0, -40.0, 50.0, 7), (32.767, -32.767, 1.0, 8), (0.0, 32.7675, 1.0, 9), (0.0, 1.0, 1e6, 10)]),
        block("latency test", [(0.1, 0.2, 0.3, 0x03F0), (0.4, 0.5, 0.6, 0x03F0)]),
        block("149 points", scatter(149, 1)),
        block("a full block of 150 points", scatter(150, 2)),
    ],
})

# colour664 -----------------------------------------------------------------------------------------------------------

write("colour664.json", {
    "pack": [{"rgb": list(rgb), "colour": colour(*rgb)} for rgb in [
        (0, 0, 0), (255, 255, 255), (255, 0, 0), (0, 255, 0), (0, 0, 255), (3, 3, 15), (4, 4, 16), (252, 252, 240), (251, 251, 239),
        (128, 64, 32), (1, 2, 3), (200, 100, 50)]],
    # The centre of each bin: 4 values wide for red and green, 16 for blue.
    "unpack": [{"colour": c, "rgb": [c // 1024 * 4 + 2, c // 16 % 64 * 4 + 2, c % 16 * 16 + 8]} for c in [
        0, 0xFFFF, 0x03F0, 0xFC00, 0x000F, 0x0010, 0x0400, 0x1234, 0xABCD]],
})

# point packet --------------------------------------------------------------------------------------------------------


def header(number, frame, offset, length):
    return struct.pack("<IIII", number, frame, offset, length)


def packet_case(name, number, frame, offset, length, payload=None, fault=None):
    case = {"name": name, "headerHex": header(number, frame, offset, length).hex(),
            "payloadBytes": 16 + length if payload is None else payload}
    if fault:
        case["fault"] = fault
    else:
        case["header"] = {"frameNumber": number, "frameLength": frame, "sequenceOffset": offset, "sequenceLength": length}
    return case


write("point-packet.json", {"payloads": [
    packet_case("first of a frame of 30,000 points", 0, 240000, 0, 1200),
    packet_case("in the middle", 41, 240000, 120000, 1200),
    packet_case("last, full", 41, 240000, 238800, 1200),
    packet_case("last, partial", 41, 240008, 240000, 8),
    packet_case("a frame of one point", 7, 8, 0, 8),
    packet_case("reference profile: partial, padded to 1216 bytes", 7, 808, 0, 808, 1216),
    packet_case("the largest numbers", 2 ** 32 - 1, 4194304 * 8, 4194304 * 8 - 1200, 1200),
    packet_case("a data block need not begin at a multiple of 1200", 1, 2400, 8, 1200),
    packet_case("nothing", 0, 8, 0, 8, 0, "too-short"),
    packet_case("half a header", 0, 8, 0, 8, 15, "too-short"),
    packet_case("header alone", 0, 8, 0, 8, 16, "too-short"),
    packet_case("a byte of data missing", 0, 1200, 0, 1200, 1215, "too-short"),
    packet_case("no data", 0, 1200, 0, 0, 1216, "bad-length"),
    packet_case("more than 150 points", 0, 2400, 0, 1208, 1224, "bad-length"),
    packet_case("half a point", 0, 1200, 0, 1196, 1216, "bad-length"),
    packet_case("length of all ones", 0, 1200, 0, 2 ** 32 - 1, 1216, "bad-length"),
    packet_case("frame of half a point", 0, 1204, 0, 1200, 1216, "bad-frame-length"),
    packet_case("frame over the limit", 0, 4194304 * 8 + 8, 0, 1200, 1216, "bad-frame-length"),
    packet_case("frame shorter than the block", 0, 1192, 0, 1200, 1216, "bad-offset"),
    packet_case("frame of nothing", 0, 0, 0, 8, 24, "bad-offset"),
    packet_case("offset inside a point", 0, 2400, 4, 1200, 1216, "bad-offset"),
    packet_case("offset beyond the frame", 0, 2400, 2400, 8, 24, "bad-offset"),
    packet_case("offset plus length wraps 32 bits", 0, 2400, 2 ** 32 - 8, 16, 32, "bad-offset"),
]})

# placement and cloud payload -----------------------------------------------------------------------------------------


def trailer(position=(0.0, 0.0, 0.0), quaternion=(0, 0, 0, 32767), stamp=0, flags=0, sensor=0, reserved=0, fmt=1):
    return struct.pack("<fff4hIBBBB", *position, *quaternion, stamp, flags, sensor, reserved, fmt)


FORMATS = ["points64", "organised", "unorganised"]


def placed(position, quaternion, stamp, flags, sensor, fmt=1):
    names = "xyzw"
    return {
        "position": {k: f32(v) for k, v in zip(names, position)},
        "orientation": {k: v / 32767 for k, v in zip(names, quaternion)},
        "captureTimeUs": stamp, "latencyTest": bool(flags & 1), "saturated": bool(flags & 2), "sensor": sensor,
        "format": FORMATS[fmt - 1],
    }


def placement_case(name, position=(0.0, 0.0, 0.0), quaternion=(0, 0, 0, 32767), stamp=0, flags=0, sensor=0, **more):
    return {"name": name, "hex": trailer(position, quaternion, stamp, flags, sensor, **more).hex(),
            "placement": placed(position, quaternion, stamp, flags, sensor, more.get("fmt", 1))}


def refused(name, data, fault):
    return {"name": name, "hex": data.hex(), "fault": fault}


half = 23170  # 32767 * sqrt(1/2) = 23169.77
write("placement.json", {
    "read": [
        placement_case("at the origin"),
        placement_case("somewhere", (1.5, -2.25, 0.75), (half, 0, -half, 0), 123456789, 0, 3),
        placement_case("latency test", flags=1),
        placement_case("saturated", flags=2),
        placement_case("both flags, last stamp, last sensor", stamp=2 ** 32 - 1, flags=3, sensor=255),
        placement_case("flags of a later version are passed over", flags=0xFC),
        placement_case("the reserved byte is passed over", reserved=9),
        placement_case("organised", fmt=2),
        placement_case("unorganised", fmt=3),
        placement_case("negative quaternion", quaternion=(0, 0, 0, -32767)),
        placement_case("a float that no decimal gives", (f32(0.1), f32(-1e-20), f32(3e8))),
        {"name": "read from the end of what comes before", "hex": "ffffffffff" + trailer(stamp=5).hex(),
         "placement": placed((0, 0, 0), (0, 0, 0, 32767), 5, 0, 0)},
        refused("nothing", b"", "too-short"),
        refused("a byte short", trailer()[1:], "too-short"),
        refused("format 0", trailer(fmt=0), "unknown-format"),
        refused("format 4", trailer(fmt=4), "unknown-format"),
        refused("position not a number", trailer((float("nan"), 0.0, 0.0)), "bad-pose"),
        refused("position infinite", trailer((0.0, float("inf"), 0.0)), "bad-pose"),
        refused("infinities that cancel", trailer((float("inf"), float("-inf"), 0.0)), "bad-pose"),
        refused("quaternion of nothing", trailer(quaternion=(0, 0, 0, 0)), "bad-pose"),
        refused("quaternion too short", trailer(quaternion=(0, 0, 0, 32400)), "bad-pose"),
        refused("quaternion too long", trailer(quaternion=(32767, 0, 0, 32767)), "bad-pose"),
    ],
    # Quaternion components may exceed 1 by what a pose may be off unit length: they saturate.
    "write": [
        {"name": "at the origin", "placement": placed((0, 0, 0), (0, 0, 0, 32767), 0, 0, 0), "hex": trailer().hex()},
        {"name": "everything", "placement": placed((1.5, -2.25, 0.75), (half, 0, -half, 0), 2 ** 32 - 1, 3, 7),
         "hex": trailer((1.5, -2.25, 0.75), (half, 0, -half, 0), 2 ** 32 - 1, 3, 7).hex()},
        {"name": "organised", "placement": placed((0, 0, 0), (0, 0, 0, 32767), 0, 0, 0, 2), "hex": trailer(fmt=2).hex()},
        {"name": "components beyond one", "placement": {**placed((0, 0, 0), (0, 0, 0, 0), 0, 0, 0),
                                                         "orientation": {"x": 0, "y": 0, "z": 0, "w": 1.005}},
         "hex": trailer().hex()},
        {"name": "components beyond minus one", "placement": {**placed((0, 0, 0), (0, 0, 0, 0), 0, 0, 0),
                                                               "orientation": {"x": 0, "y": -1.005, "z": 0, "w": 0}},
         "hex": trailer(quaternion=(0, -32767, 0, 0)).hex()},
    ],
})


def points(n):
    return bytes((i * 37 + 11) % 256 for i in range(8 * n))


def payload(n, frame=None, **more):
    return header(9, 8 * n if frame is None else frame, 0, 8 * n) + points(n) + trailer(stamp=77, **more)


def coded(n, data, frame=None, fmt=2):
    """A packet of n points in a coded format."""
    return header(9, 8 * n if frame is None else frame, 0, 8 * n) + points(150)[:data] + trailer(stamp=77, fmt=fmt)


def payload_case(name, data, frame, length, fmt=1):
    return {"name": name, "hex": data.hex(),
            "header": {"frameNumber": 9, "frameLength": frame, "sequenceOffset": 0, "sequenceLength": length},
            "placement": placed((0, 0, 0), (0, 0, 0, 32767), 77, 0, 0, fmt)}


write("cloud-payload.json", {"payloads": [
    payload_case("full", payload(150, 240000), 240000, 1200),
    payload_case("partial", payload(3), 24, 24),
    payload_case("one point", payload(1), 8, 8),
    payload_case("coded: more points than bytes", coded(4000, 1199, 240000), 240000, 32000, 2),
    payload_case("coded: full", coded(900, 1200, fmt=3), 7200, 7200, 3),
    payload_case("coded: one byte", coded(1, 1), 8, 8, 2),
    refused("coded: no data", coded(1, 0), "too-short"),
    refused("coded: a byte too many", (lambda d: d[:40] + b"\0" + d[40:])(coded(900, 1200)), "trailing-bytes"),
    refused("coded: no points", header(9, 8, 0, 0) + points(1) + trailer(fmt=2), "bad-length"),
    refused("coded: more points than the frame", coded(4, 20, 24), "bad-offset"),
    refused("coded: frame over the limit", coded(4, 20, 4194304 * 8 + 8), "bad-frame-length"),
    refused("nothing", b"", "too-short"),
    refused("a placement alone", trailer(), "bad-length"),
    refused("a byte of data missing", (lambda d: d[:20] + d[21:])(payload(3)), "too-short"),
    refused("a byte too many between data and placement", (lambda d: d[:40] + b"\0" + d[40:])(payload(3)), "trailing-bytes"),
    refused("reference profile: padding where the placement should be", header(9, 24, 0, 24) + points(3) + bytes(1176),
            "unknown-format"),
    refused("unknown format, whatever the header says", b"\xff" * 16 + points(3) + trailer(fmt=9), "unknown-format"),
    refused("bad pose", payload(3, quaternion=(0, 0, 0, 1)), "bad-pose"),
    refused("block longer than the frame", payload(3, 16), "bad-offset"),
    refused("frame of half a point", payload(3, 28), "bad-frame-length"),
]})

# bandwidth -----------------------------------------------------------------------------------------------------------

write("bandwidth.json", {
    "decode": [
        {"hex": struct.pack("<i", v).hex(), "bitsPerSecond": v} for v in [0, 1, 256, 40_000_000, 2 ** 31 - 1]
    ] + [
        {"hex": struct.pack("<i", -1).hex(), "error": "invalid"},
        {"hex": struct.pack("<i", -2 ** 31).hex(), "error": "invalid"},
        {"hex": "", "error": "too-short"}, {"hex": "010203", "error": "too-short"}, {"hex": "0102030405", "error": "too-large"},
    ],
    "encode": [{"bitsPerSecond": v, "hex": struct.pack("<i", min(max(int(v + 0.5), 0), 2 ** 31 - 1)).hex()}
               for v in [0, 40_000_000, 2 ** 31 - 1, 2 ** 31, 1e12, 1234.4, 1234.6]]
    + [{"bitsPerSecond": -5, "hex": "00000000"}],
})

# pictures ------------------------------------------------------------------------------------------------------------

PICTURE_FORMATS = ["jpeg", "png"]


def chunk(data, fmt=1, camera=0, width=640, height=480, index=0, count=1, reserved=0, picture=0, stamp=0):
    return struct.pack("<BBHHHHHII", fmt, camera, width, height, index, count, reserved, picture, stamp) + data


def chunk_case(name, data, fmt=1, camera=0, width=640, height=480, index=0, count=1, reserved=0, picture=0, stamp=0):
    return {"name": name, "hex": chunk(data, fmt, camera, width, height, index, count, reserved, picture, stamp).hex(),
            "header": {"format": PICTURE_FORMATS[fmt - 1], "camera": camera, "width": width, "height": height, "index": index,
                       "count": count, "pictureId": picture, "captureTimeUs": stamp},
            "dataBytes": len(data)}


full = bytes(i * 7 % 256 for i in range(1140))
write("picture-chunk.json", {
    "read": [
        chunk_case("a picture in one chunk", b"\xff\xd8\xff\xd9"),
        chunk_case("of one byte", b"\x01"),
        chunk_case("a full first chunk", full, count=3, picture=9, stamp=123456789),
        chunk_case("a full last chunk", full, index=2, count=3, picture=9, stamp=123456789),
        chunk_case("a short last chunk", full[:77], index=2, count=3),
        chunk_case("the largest of everything", full, 2, 7, 4096, 4096, 511, 512, 0, 2 ** 32 - 1, 2 ** 32 - 1),
        chunk_case("the reserved bytes are passed over", b"x", reserved=65535),
        refused("nothing", b"", "too-short"),
        refused("a header alone", chunk(b""), "too-short"),
        refused("a byte too long", chunk(full + b"x", count=2), "too-long"),
        refused("format 0", chunk(b"x", fmt=0), "unknown-format"),
        refused("format 3", chunk(b"x", fmt=3), "unknown-format"),
        refused("camera 8", chunk(b"x", camera=8), "bad-camera"),
        refused("no width", chunk(b"x", width=0), "bad-size"),
        refused("no height", chunk(b"x", height=0), "bad-size"),
        refused("too wide", chunk(b"x", width=4097), "bad-size"),
        refused("too high", chunk(b"x", height=65535), "bad-size"),
        refused("no chunks", chunk(b"x", count=0), "bad-index"),
        refused("too many chunks", chunk(full, count=513), "bad-index"),
        refused("an index beyond the last", chunk(b"x", index=1), "bad-index"),
        refused("a short chunk that is not the last", chunk(full[:1139], count=2), "bad-length"),
    ],
    "pictures": [
        {"name": "in %d chunks" % len(chunks), "pictureHex": picture.hex(),
         "header": {"format": "jpeg", "camera": 1, "width": 320, "height": 200, "pictureId": 5, "captureTimeUs": 70},
         "chunksHex": [chunk(c, camera=1, width=320, height=200, index=i, count=len(chunks), picture=5, stamp=70).hex()
                       for i, c in enumerate(chunks)]}
        for picture, chunks in [(b"abc", [b"abc"]), (full, [full]), (full + b"z", [full, b"z"])]
    ],
})

# capture stamp -------------------------------------------------------------------------------------------------------

UUID = bytes.fromhex("9c5ed147b8324f6aa17de35826cb94f5")
SPS = bytes.fromhex("0000000167 42c01f8c8d40".replace(" ", ""))
SLICE = bytes.fromhex("0000000165 888400".replace(" ", ""))


def stamp(nanoseconds):
    groups = [(nanoseconds >> (7 * i)) & 0x7F for i in reversed(range(10))]
    return UUID + bytes(0x80 | group for group in groups)


def sei(content):
    return bytes([0, 0, 0, 1, 6, 5, len(content)]) + content + b"\x80"


def stamped(name, nanoseconds):
    return {"name": name, "nanoseconds": str(nanoseconds), "hex": stamp(nanoseconds).hex()}


def picture(name, codec, data, nanoseconds=None):
    vector = {"name": name, "codec": codec, "hex": data.hex()}
    return vector if nanoseconds is None else {**vector, "nanoseconds": str(nanoseconds)}


write("capture-stamp.json", {
    "write": [stamped("zero", 0), stamped("one", 1), stamped("all ones", 2 ** 64 - 1), stamped("a day", 86400 * 10 ** 9),
              stamped("many zero bits", 2 ** 56 + 2 ** 24), stamped("ascending", 0x0123456789ABCDEF)],
    "read": [
        picture("H264: first", "H264", sei(stamp(86400123456789)) + SLICE, 86400123456789),
        picture("H264: after the parameter sets", "H264", SPS + sei(stamp(7)) + SLICE, 7),
        picture("H264: after another SEI message", "H264", sei(b"other" * 5) + sei(stamp(8)) + SLICE, 8),
        picture("H264: none", "H264", SPS + SLICE),
        picture("H264: another UUID", "H264", sei(bytes(15) + stamp(7)[15:]) + SLICE),
        picture("H264: at the end, where VP8 has it", "H264", SLICE + stamp(7)),
        picture("H264: cut short", "H264", (SPS + sei(stamp(7)))[:-2]),
        picture("H264: too far behind", "H264", SPS + bytes([0, 0, 0, 1, 8]) + b"\x55" * 512 + sei(stamp(7)) + SLICE),
        picture("VP8: last", "VP8", bytes.fromhex("9d012a") + stamp(2 ** 63), 2 ** 63),
        picture("VP8: alone", "VP8", stamp(2 ** 40), 2 ** 40),
        picture("VP8: none", "VP8", bytes(range(64))),
        picture("VP8: not last", "VP8", stamp(7) + b"\x80"),
        picture("VP8: too short", "VP8", stamp(7)[1:]),
        picture("VP8: a byte of the time without its highest bit", "VP8", stamp(7)[:-1] + b"\x07"),
        picture("VP8: more than 64 bits", "VP8", UUID + b"\x82" + b"\x80" * 9),
    ],
})

# latency barcode -----------------------------------------------------------------------------------------------------


def checksum(data):
    """CRC-16/CCITT-FALSE as a remainder: the polynomial x^16 + x^12 + x^5 + 1, the first 16 bits inverted."""
    value = (int.from_bytes(data, "big") << 16) ^ (0xFFFF << 8 * len(data))
    for bit in range(8 * len(data) + 15, 15, -1):
        if value >> bit & 1:
            value ^= 0x11021 << bit - 16
    return value


assert checksum(b"123456789") == 0x29B1


def squares(nanoseconds, damage=0):
    """The seven rows of 18 squares, 1 for white; damage inverts bits of the 80 that the frame surrounds."""
    data = nanoseconds.to_bytes(8, "big")
    bits = format(int.from_bytes(data + checksum(data).to_bytes(2, "big"), "big") ^ damage, "080b")
    inner = [bits[i:i + 16] for i in range(0, 80, 16)]
    rows = ["101010101010101010"]
    for i, row in enumerate(inner):
        rows.append("01"[i % 2] + row + "10"[i % 2])
    return rows + ["101010101010101010"]


def barcode(name, nanoseconds):
    return {"name": name, "hi": nanoseconds >> 32, "lo": nanoseconds % 2 ** 32, "squares": squares(nanoseconds)}


def seen(name, rows, black=16, white=235, time=None, fault=None):
    case = {"name": name, "squares": rows, "black": black, "white": white}
    if fault:
        return {**case, "fault": fault}
    return {**case, "hi": time >> 32, "lo": time % 2 ** 32}


def inverted(rows):
    return [row.translate(str.maketrans("01", "10")) for row in rows]


NOW = 1_795_413_600_123_456_789
write("latency-barcode.json", {
    "draw": [
        barcode("zero", 0), barcode("all ones", 2 ** 64 - 1), barcode("one", 1), barcode("the highest bit", 2 ** 63),
        barcode("the upper half", 2 ** 64 - 2 ** 32), barcode("ascending", 0x0123456789ABCDEF), barcode("a time of day", NOW),
    ],
    "read": [
        seen("as drawn", squares(NOW), time=NOW),
        seen("full range", squares(NOW), 0, 255, time=NOW),
        seen("dark", squares(NOW), 3, 60, time=NOW),
        seen("bright", squares(NOW), 190, 250, time=NOW),
        seen("nothing to see", squares(NOW), 128, 128, fault="no-barcode"),
        seen("too little contrast", squares(NOW), 120, 151, fault="no-barcode"),
        seen("black and white exchanged", squares(NOW), 235, 16, fault="no-barcode"),
        seen("all black", ["0" * 18] * 7, fault="no-barcode"),
        seen("a chessboard", [("10" * 9, "01" * 9)[i % 2] for i in range(7)], fault="bad-checksum"),
        seen("a square of the frame inverted", squares(NOW)[:6] + ["101010101110101010"], fault="no-barcode"),
        seen("the data inverted", [a[0] + b[1:17] + a[17] if 0 < i < 6 else a for i, (a, b) in
                                   enumerate(zip(squares(NOW), inverted(squares(NOW))))], fault="bad-checksum"),
        seen("the first bit inverted", squares(NOW, 1 << 79), fault="bad-checksum"),
        seen("the last bit inverted", squares(NOW, 1), fault="bad-checksum"),
        seen("a row of data exchanged with the next", (lambda r: [*r[:3], r[3][0] + r[4][1:17] + r[3][17],
                                                                  r[4][0] + r[3][1:17] + r[4][17], *r[5:]])(squares(NOW)),
             fault="bad-checksum"),
    ],
})

# JSON messages -------------------------------------------------------------------------------------------------------

ABSENT = object()


def changed(base, path, value):
    message = copy.deepcopy(base)
    at = message
    keys = path.split(".")
    for key in keys[:-1]:
        at = at[int(key)] if isinstance(at, list) else at[key]
    key = int(keys[-1]) if isinstance(at, list) else keys[-1]
    if value is ABSENT:
        del at[key]
    else:
        at[key] = value
    return message


class Messages:
    def __init__(self):
        self.valid, self.invalid = [], []

    def good(self, message, name=None):
        name = name or message.get("type", "message")
        self.valid.append({"name": name, "text": json.dumps(message, separators=(",", ":"))})
        return message

    def bad(self, name, text, code, path="", **more):
        text = text if isinstance(text, str) else json.dumps(text, separators=(",", ":"))
        self.invalid.append({"name": name, "text": text, "code": code, "path": path, **more})

    def spoil(self, base, *changes):
        """Each change: (path, value) makes the message wrong just there, or (path, value, where the error points)."""
        for path, value, *where in changes:
            shown = "absent" if value is ABSENT else json.dumps(value)
            shown = shown if len(shown) < 50 else shown[:40] + "..."
            name = "%s: %s %s" % (base.get("type", "message"), path, shown)
            self.bad(name, changed(base, path, value), "invalid", where[0] if where else path)

    def common(self, base, oversize):
        self.bad("empty", "", "not-json")
        self.bad("not JSON", "{", "not-json")
        self.bad("JSON and more", json.dumps(base) + "x", "not-json")
        self.bad("not a number that JSON has", '{"type":NaN}', "not-json")
        self.bad("null", "null", "invalid")
        self.bad("a number", "7", "invalid")
        self.bad("a string", '"stop"', "invalid")
        self.bad("an array", "[]", "invalid")
        self.bad("no type", "{}", "invalid", "type" if "type" in base else next(iter(base)))
        # The text, then as many spaces as make it one byte too long.
        self.bad("too long", json.dumps(base), "too-large", padTo=oversize + 1)
        self.invalid.append({"name": "not UTF-8", "hex": "7b22fffe", "code": "not-utf8", "path": ""})

    def lists(self):
        return {"valid": self.valid, "invalid": self.invalid}


def vector3(x=0, y=0, z=0):
    return {"x": x, "y": y, "z": z}


control = Messages()
command = control.good({"type": "command", "sequence": 17, "timeMs": 52311.5, "lease": "0f3a9c", "deadMan": True,
                        "twist": {"linear": vector3(0.5), "angular": vector3(0, 0, -0.25)}})
control.good({**command, "latencyTest": 4, "sequence": 2 ** 32 - 1, "timeMs": 0}, "command with a latency test, largest sequence")
control.good({**command, "seenUs": 2 ** 32 - 1}, "command that says what is seen")
control.good({**command, "unread": True}, "command of a hand that is not read")
control.good({**command, "twist": {"linear": vector3(0.3, -0.4), "angular": vector3()}}, "command to the right")
control.good({**command, "lease": "A-Za-z0-9_-" + "x" * 53, "deadMan": False}, "command with the longest lease")
probe = control.good({"type": "clockProbe", "id": 3, "sentMs": 1000.25})
report = control.good({"type": "receiverReport", "sequence": 9, "packetsReceived": 60000, "packetsLost": 12, "bytesReceived": 74640000})
press = control.good({"type": "estop", "press": 1})
control.good({"type": "estop", "press": 2 ** 32 - 1}, "estop: the largest number")
control.common(command, 1024)
control.spoil(command, ("unread", False), ("unread", 1), ("seenUs", -1), ("seenUs", 2 ** 32), ("seenUs", 0.5), ("sequence", -1), ("sequence", 2 ** 32), ("sequence", 1.5), ("sequence", "17"), ("sequence", ABSENT),
              ("timeMs", -0.1), ("timeMs", None), ("timeMs", 1e300), ("lease", ""), ("lease", "x" * 65), ("lease", "a b"), ("lease", ABSENT),
              ("deadMan", 1), ("deadMan", ABSENT), ("twist", None), ("twist.linear", ABSENT), ("twist.linear.x", "0.5"),
              ("twist.linear.x", None), ("twist.angular.z", ABSENT), ("latencyTest", -1), ("latencyTest", True),
              ("extra", 1, ""), ("twist.extra", 1, "twist"), ("twist.linear.w", 1, "twist.linear"), ("type", "Command"), ("type", 7))
control.bad("a number too large for a double", json.dumps(command).replace("0.5", "1e999"), "invalid", "twist.linear.x")
control.bad("a key of the prototype", json.dumps(command)[:-1] + ',"__proto__":{}}', "invalid")
control.spoil(probe, ("id", -1), ("sentMs", ABSENT), ("robotMs", 1, ""))
control.spoil(report, ("packetsLost", -1), ("packetsReceived", 0.5), ("bytesReceived", 2 ** 53))
control.spoil(press, ("press", -1), ("press", ABSENT), ("press", 1.5), ("press", "1"), ("latch", True, ""))
write("operator-control.json", control.lists())

answer = Messages()
base = answer.good({"type": "clockAnswer", "id": 3, "sentMs": 1000.25, "robotMs": 88123.75})
answer.common(base, 256)
answer.spoil(base, ("id", 2 ** 32), ("sentMs", -1), ("robotMs", "88123"), ("robotMs", ABSENT), ("type", "clockProbe"), ("extra", 0, ""))
write("clock-answer.json", answer.lists())

robot_control = Messages()
robot_control.good(base)
ack = robot_control.good({"type": "estopAck", "press": 1})
robot_control.good({"type": "estopAck", "press": 2 ** 32 - 1}, "estopAck: the largest number")
robot_control.common(ack, 256)
robot_control.spoil(base, ("robotMs", ABSENT))
robot_control.spoil(ack, ("press", ABSENT), ("press", -1), ("press", 0.5), ("type", "estop"), ("latched", True, ""))
write("robot-control.json", robot_control.lists())

robot_session = Messages()
limits = {"maxLinear": 1, "maxAngular": 1.5, "watchdogMs": 150, "maxCommandsPerSecond": 100}
welcome = robot_session.good({"type": "welcome", "protocol": 1, "robotId": "sim-1", "name": "Simulated robot", "limits": limits,
                              "stream": {"format": "points64", "width": 480, "height": 480, "framesPerSecond": 30}})
robot_session.good({**welcome, "resumeKey": "p5bGbAm3i8CqEIfnp0tqkg"}, "welcome with the key that resumes the session")
admitted = robot_session.good({**welcome, "access": {"role": "drive", "name": "Ada", "expiresInS": 3600}}, "welcome to the holder of a grant")
corners = [{"x": 0.35, "y": -0.28}, {"x": 0.35, "y": 0.28}, {"x": -0.25, "y": 0.28}, {"x": -0.25, "y": -0.28}]
embodied = robot_session.good({**welcome, "body": {"footprint": corners, "decelerationMps2": 2}}, "welcome from a robot that tells its outline")
robot_session.spoil(embodied, ("body.footprint", corners[:2]), ("body.footprint", corners * 17), ("body.footprint.0.x", 10.5), ("body.footprint.1.y", "0"),
                    ("body.decelerationMps2", 0), ("body.decelerationMps2", ABSENT), ("body.mass", 12, "body"))
ramped = robot_session.good({**welcome, "body": {"footprint": corners, "decelerationMps2": 2, "accelerationMps2": 1, "turnRadps2": 3}},
                            "welcome from a robot that tells its ramps")
robot_session.spoil(ramped, ("body.accelerationMps2", 0), ("body.accelerationMps2", "1"), ("body.turnRadps2", -3), ("body.turnRadps2", None))
heights = {"clearanceM": 0.04, "heightM": 1.1, "dropM": 0.15, "slope": 0.01}
tall = robot_session.good({**welcome, "body": {"footprint": corners, "decelerationMps2": 2, "heights": heights}},
                          "welcome from a robot that tells which heights matter to it")
robot_session.spoil(tall, ("body.heights.clearanceM", -0.01), ("body.heights.clearanceM", 1.1, "body.heights"), ("body.heights.heightM", 10.5),
                    ("body.heights.dropM", 0), ("body.heights.dropM", ABSENT), ("body.heights.slope", 1.5), ("body.heights.slope", "0.01"),
                    ("body.heights.widthM", 1, "body.heights"), ("body.heights", None))
for role in ["watch", "supervise"]:
    robot_session.good(changed(admitted, "access.role", role), "welcome, role: " + role)
about = robot_session.good({"type": "about", "drives": True, "shows": "sensors", "recorded": False})
robot_session.good({"type": "about", "drives": True, "shows": "simulation", "recorded": True}, "about a simulated robot")
robot_session.good({"type": "about", "drives": False, "shows": "files", "recorded": False}, "about a robot that plays files")
robot_session.spoil(about, ("drives", 1), ("drives", None), ("shows", "camera"), ("recorded", "no"))
caused = robot_session.good({"type": "estopCause", "latch": 7, "pressedBy": "Ada", "yours": True, "heldBy": ["gpio", "key"], "start": "was-latched", "release": "latcher"})
for start in "unclean-exit", "unreadable", "unwritable":
    robot_session.good({"type": "estopCause", "latch": 1, "yours": False, "start": start, "release": "driver"}, "estopCause: " + start)
robot_session.good({"type": "estopCause", "latch": 2 ** 32 - 1, "pressedBy": "Grace", "yours": False, "release": "supervisor"}, "estopCause: released by supervisors")
robot_session.good({"type": "estopCause", "latch": 3, "yours": False, "heldBy": ["topic", "shm"], "release": "driver"}, "estopCause: held at the robot")
robot_session.spoil(caused, ("latch", -1), ("latch", ABSENT), ("pressedBy", 3), ("pressedBy", ""), ("pressedBy", "x" * 65), ("pressedBy", "a\nb"), ("yours", "me"), ("heldBy", []),
                    ("heldBy", ["key"] * 5), ("heldBy.0", "button"), ("start", "crash"), ("release", "robot"), ("release", ABSENT), ("lease", "0f3a9c", ""))
expires = robot_session.good({"type": "expires", "inS": 60})
present = {"number": 4, "name": "Ada", "role": "drive", "drives": True, "you": True}
operators = robot_session.good({"type": "operators", "operators": [present, {"number": 7, "name": "Sue", "role": "supervise", "drives": False, "you": False}]})
robot_session.good({"type": "operators", "operators": [{**present, "number": 2 ** 32 - 1 - i, "name": '"' * 64} for i in range(16)], "more": 16},
                   "operators: as many and as long as there may be")
robot_session.spoil(operators, ("operators", ABSENT), ("operators", [present] * 17), ("operators.0.number", -1), ("operators.0.number", 2 ** 32),
                    ("operators.1.name", ""), ("operators.1.role", "root"), ("operators.1.drives", 1), ("operators.0.you", ABSENT),
                    ("operators.1.session", "s1", "operators.1"), ("more", 0), ("more", 0.5))
for reason in ["unknown-operator", "own-session", "rate-limited", "no-room", "newer-latch", "held-at-robot", "not-latcher", "not-driver", "nobody-drives",
               "only-watches", "already-open", "not-open", "estop"]:
    robot_session.good({"type": "fault", "message": "", "reason": reason}, "fault: " + reason)
robot_session.good({"type": "lease", "holder": "other", "driver": "Ada"}, "lease held by another, who is named")
robot_session.good({"type": "fault", "message": "your grant lets you watch", "reason": "not-permitted"}, "fault: not permitted")
lease = robot_session.good({"type": "lease", "holder": "you", "lease": "0f3a9c"}, "lease held by this operator")
robot_session.good({"type": "lease", "holder": "other"}, "lease held by another")
robot_session.good({"type": "lease", "holder": "nobody"}, "lease free")
rejected = robot_session.good({"type": "rejected", "sequence": 17, "reason": "out-of-range",
                               "detail": "twist.linear.x 3.2 m/s is beyond \u00b11 m/s", "count": 1})
for reason in ["malformed", "stale", "repeated", "not-permitted", "not-lease-holder", "dead-man-released", "let-go-first", "no-wheels", "estop-latched", "rate-limited"]:
    robot_session.good({"type": "rejected", "reason": reason, "detail": "", "count": 40}, "rejected: " + reason)
estop = robot_session.good({"type": "estop", "latched": True, "by": "operator"})
robot_session.good({"type": "estop", "latched": True, "by": "robot"}, "estop by the robot")
robot_session.good({"type": "estop", "latched": False}, "estop released")
robot_session.good({"type": "estop", "latched": False, "latch": 0}, "estop that was never latched")
held = robot_session.good({"type": "estop", "latched": True, "by": "robot", "releasedAt": "robot", "latch": 8}, "estop that is released at the robot only")
pressed = robot_session.good({"type": "estop", "latched": True, "by": "operator", "latch": 7, "press": 2}, "estop with its number, and this operator's press")
for after_gap in ["let-go", "resume"]:
    robot_session.good(changed(welcome, "limits.afterGap", after_gap), "welcome, after a gap: " + after_gap)
robot_session.good(changed(welcome, "limits.resumeWithinMs", 400), "welcome: moves on after a gap of less than 400 ms")
robot_session.good(changed(welcome, "limits.resumeWithinMs", 0), "welcome: never moves on after a gap")
for lateral in [0, 0.5, 10]:
    robot_session.good(changed(welcome, "limits.maxLateral", lateral), "welcome from a robot whose limit sideways is %s m/s" % lateral)
robot_session.spoil(welcome, ("limits.maxLateral", -0.1), ("limits.maxLateral", 10.5), ("limits.maxLateral", "0.5"), ("limits.maxLateral", None))
robot_session.spoil(welcome, ("limits.afterGap", "go"), ("limits.afterGap", True))
robot_session.spoil(welcome, ("limits.resumeWithinMs", -1), ("limits.resumeWithinMs", 1001), ("limits.resumeWithinMs", "400"))
robot_session.spoil(pressed, ("latch", -1), ("latch", 0.5), ("press", 2 ** 32), ("press", "2"))
latency = robot_session.good({"type": "latencyFrame", "id": 4, "frameNumber": 901, "points": 30000, "commandMs": 88120.5, "captureMs": 88131})
cloud_stream = robot_session.good({"type": "cloudStream", "format": "organised", "header": "RlBPQwEBAAA="})
cameras = robot_session.good({"type": "cameras", "cameras": [{"name": "Front"}, {"name": "/gripper/image_raw"}]})
robot_session.good({"type": "cloudStream", "format": "unorganised", "header": "RlBVQwEBAAA=", "sensor": 1}, "cloudStream: of the second sensor")
sensors = robot_session.good({"type": "sensors", "sensors": [{"name": "Camera"}, {"name": "LiDAR"}]})
rings = robot_session.good({"type": "rings", "sensor": 1, "elevations": [-0.2618, -0.08727, 0.08727, 0.2618]})
robot_session.good({"type": "rings", "sensor": 0, "elevations": [round(-0.4 + i * 0.003, 5) for i in range(256)]}, "rings: 256")
robot_session.good({"type": "cameras", "cameras": []}, "cameras: none")
videos = robot_session.good({"type": "videos", "videos": [{"name": "Front", "mid": "1", "codec": "H264"}, {"name": "Rear", "mid": "2", "codec": "VP8", "fault": "the camera is unplugged"}]})
robot_session.good({"type": "videos", "videos": []}, "videos: none")
of_sensor = robot_session.good({"type": "videos", "videos": [{"name": "Depth camera", "mid": "1", "codec": "H264", "ofSensor": 0}]}, "videos: a sensor's own picture")
sound = robot_session.good({"type": "sound", "mid": "3", "microphone": {"state": "failed", "detail": "the microphone is unplugged"}, "voice": {"state": "closed"}})
robot_session.good({"type": "sound", "mid": "3"}, "sound: neither")
for microphone in ["off", "starting", "live", "muted", "slow-link"]:
    robot_session.good({"type": "sound", "mid": "3", "microphone": {"state": microphone}}, "sound: microphone " + microphone)
for voice in ["open", "not-driving", "silent", "failed"]:
    robot_session.good({"type": "sound", "mid": "3", "voice": {"state": voice}}, "sound: voice " + voice)
fault = robot_session.good({"type": "fault", "message": "operator session message: latch: expected boolean"})
quantity = robot_session.good({"type": "quantity", "number": 0, "topic": "/gripper/temperature", "field": "data", "label": "Gripper", "unit": "\u00b0C"})
robot_session.good(changed(quantity, "unit", ""), "quantity without a unit")
alarm = robot_session.good({"type": "alarm", "number": 1, "level": "warn", "text": "The battery is low", "value": 19.5, "limit": 20, "unit": "%",
                            "sinceMs": 88131.25})
for level in ["error", "ok"]:
    robot_session.good(changed(alarm, "level", level), "alarm: " + level)
robot_session.good(changed(quantity, "recorded", True), "quantity of a recording")
robot_session.good(changed(alarm, "recorded", True), "alarm of a recording")
robot_session.spoil(quantity, ("recorded", False))
robot_session.spoil(alarm, ("recorded", "yes"))
robot_session.common(fault, 4096)
robot_session.spoil(quantity, ("number", 64), ("number", -1), ("topic", ""), ("field", "f" * 129), ("label", ""), ("unit", "u" * 13),
                    ("unit", ABSENT))
robot_session.spoil(alarm, ("number", 32), ("level", "stale"), ("text", ""), ("text", "x" * 121), ("value", None), ("limit", ABSENT),
                    ("unit", 1), ("sinceMs", -1))
robot_session.spoil(welcome, ("protocol", 0), ("protocol", 1.5), ("robotId", "Sim"), ("robotId", "-sim"), ("robotId", "x" * 65), ("name", ""),
                    ("name", "a\nb"), ("name", "x" * 65), ("limits.maxLinear", 0), ("limits.watchdogMs", -150),
                    ("limits.maxAngular", ABSENT), ("limits.extra", 1, "limits"), ("stream.format", "points32"), ("stream.width", 0),
                    ("stream.height", 1.5), ("stream.framesPerSecond", 0), ("resumeKey", ""), ("resumeKey", "a b"))
robot_session.spoil(admitted, ("access.role", "admin"), ("access.role", ABSENT), ("access.name", ""), ("access.expiresInS", -1),
                    ("access.expiresInS", 0.5), ("access.extra", 1, "access"))
robot_session.spoil(expires, ("inS", ABSENT), ("inS", -1), ("inS", 1.5))
robot_session.spoil(lease, ("holder", "me"), ("lease", "a b"), ("lease", 7), ("driver", ""), ("driver", "a\nb"))
robot_session.spoil(rejected, ("reason", "because"), ("detail", "x" * 513), ("count", 0), ("sequence", -1))
robot_session.spoil(estop, ("latched", "yes"), ("by", "me"))
robot_session.spoil(held, ("releasedAt", "operator"), ("releasedAt", True))
robot_session.spoil(latency, ("id", -1), ("frameNumber", 2 ** 32), ("points", -1), ("commandMs", ABSENT))
robot_session.spoil(cloud_stream, ("format", "points64"), ("format", "draco"), ("header", ""), ("header", "a b"), ("header", "A" * 3204))
robot_session.spoil(cloud_stream, ("sensor", 8), ("sensor", -1), ("sensor", "0"))
robot_session.spoil(sensors, ("sensors", ABSENT), ("sensors", [{"name": "x"}] * 9), ("sensors.0.name", ""), ("sensors.1.extra", 1, "sensors.1"))
robot_session.spoil(rings, ("sensor", 8), ("sensor", -1), ("sensor", ABSENT), ("elevations", ABSENT), ("elevations", []), ("elevations", [0.1]),
                    ("elevations", [0.1, 0.1]), ("elevations", [0.2, 0.1]), ("elevations.0", -1.6), ("elevations.3", 1.6),
                    ("elevations.0", "0"), ("elevations.0", None), ("elevations", [round(-0.4 + i * 0.003, 5) for i in range(257)]))
robot_session.spoil(cameras, ("cameras", ABSENT), ("cameras", [{"name": "x"}] * 9), ("cameras.0.name", ""), ("cameras.1.name", 7),
                    ("cameras.0.name", "a\nb"), ("cameras.0.extra", 1, "cameras.0"))
robot_session.spoil(sound, ("mid", ABSENT), ("mid", ""), ("microphone.state", "on"), ("microphone.state", ABSENT), ("microphone.detail", "x" * 257),
                    ("microphone", "live"), ("voice.state", "live"), ("voice.extra", 1, "voice"))
robot_session.spoil(videos, ("videos", ABSENT), ("videos", [{"name": "x", "mid": "1", "codec": "VP8"}] * 9), ("videos.0.name", ""), ("videos.0.mid", ""),
                    ("videos.0.mid", "a b"), ("videos.0.mid", "x" * 17), ("videos.0.mid", 1), ("videos.1.codec", "AV1"), ("videos.1.codec", ABSENT),
                    ("videos.1.fault", "x" * 257), ("videos.1.extra", 1, "videos.1"))
robot_session.spoil(of_sensor, ("videos.0.ofSensor", 8), ("videos.0.ofSensor", -1), ("videos.0.ofSensor", 0.5), ("videos.0.ofSensor", "0"))
robot_session.spoil(fault, ("message", "x" * 513), ("message", 1), ("reason", "because"))
LEVEL = [0, 0, 0, 1]
model = robot_session.good({"type": "robotModel", "number": 2, "count": 6, "at": 0, "parts": [
    {"part": "link", "parent": 0, "place": [0.1, 0.2, 0.05] + LEVEL, "moves": "turns", "axis": [0, 1, 0]},
    {"part": "link", "parent": 1, "place": [0, 0, 0.3, 0, 0, 0.7071, 0.7071], "moves": "slides", "axis": [0.6, 0, -0.8]},
    {"part": "shape", "link": 0, "place": [0, 0, 0.1] + LEVEL, "form": "box", "size": [0.4, 0.3, 0.1], "colour": 3360153},
    {"part": "shape", "link": 1, "place": [0, 0, 0, 0.7071, 0, 0, 0.7071], "form": "cylinder", "size": [0.05, 0.04], "colour": 0},
    {"part": "shape", "link": 2, "place": [0, 0, 0] + LEVEL, "form": "sphere", "size": [0.02], "colour": 16777215}]})
robot_session.good({**model, "at": 5, "parts": [model["parts"][2]]}, "robotModel: its last part")
robot_session.good({**model, "count": 0, "parts": []}, "robotModel: there is none any more")
robot_session.spoil(model, ("number", -1), ("number", 2 ** 32), ("count", 641), ("count", -1), ("count", 4, "parts"), ("count", ABSENT), ("at", -1), ("at", 2, "parts"),
                    ("parts", ABSENT), ("parts", [model["parts"][2]] * 33), ("parts.0.part", "joint"), ("parts.0.parent", -1), ("parts.0.parent", 128),
                    ("parts.0.place", [0, 0, 0]), ("parts.0.place", [0, 0, 0, 0, 0, 0, 0]), ("parts.0.place", [100.5, 0, 0] + LEVEL, "parts.0.place.0"),
                    ("parts.0.place", [0, 0, None] + LEVEL, "parts.0.place.2"), ("parts.0.moves", "floats"), ("parts.0.axis", [0, 0, 0]), ("parts.0.axis", [0, 1]),
                    ("parts.0.axis", ABSENT), ("parts.0.name", "wheel", "parts.0"), ("parts.2.link", 129), ("parts.2.link", 0.5), ("parts.2.form", "mesh"),
                    ("parts.2.size", [1, 1]), ("parts.2.size", [1, 1, 0], "parts.2.size.2"), ("parts.2.size", [1, 1, 101], "parts.2.size.2"), ("parts.3.size", [1]),
                    ("parts.4.size", []), ("parts.2.colour", 16777216), ("parts.2.colour", "red"), ("parts.2.mesh", "a.stl", "parts.2"), ("scale", 1, ""))
away = robot_session.good({**operators, "operators": [present, {"number": 7, "name": "Bob", "claimed": True, "role": "drive", "drives": False, "you": False,
                                                               "away": True}], "drivesForS": 0}, "operators: one is away, and nothing proves its name")
robot_session.spoil(away, ("drivesForS", -1), ("drivesForS", 0.5), ("operators.1.claimed", False), ("operators.1.away", False), ("operators.1.away", 1))
ada, bob = {"number": 4, "name": "Ada"}, {"number": 7, "name": "Bob", "claimed": True}
asked = robot_session.good({"type": "handover", "id": 3, "kind": "ask", "from": bob, "to": ada, "yours": False, "leftMs": 15000})
robot_session.good({"type": "handover", "id": 2 ** 32 - 1, "kind": "offer", "from": ada, "to": bob, "yours": True, "leftMs": 0}, "handover: an offer in its last moment")
for end in ["accepted", "refused", "withdrawn", "expired", "driver-changed", "left", "estop"]:
    over = robot_session.good({"type": "handover", "id": 0, "kind": "offer", "from": ada, "to": bob, "yours": True, "ended": end}, "handover: " + end)
robot_session.spoil(asked, ("id", -1), ("id", ABSENT), ("kind", "give"), ("kind", ABSENT), ("from", "Bob"), ("from", ABSENT), ("from.name", ""), ("to.number", -1),
                    ("to.role", "drive", "to"), ("yours", ABSENT), ("yours", 1), ("leftMs", -1), ("leftMs", 15001), ("leftMs", 0.5), ("leftMs", ABSENT, "ended"),
                    ("ended", "accepted"), ("lease", "0f3a9c", ""))
robot_session.spoil(over, ("ended", "given"), ("ended", ABSENT))
button = robot_session.good({"type": "robotCommand", "id": "dock", "label": "Dock", "group": "Power", "confirm": True, "cancel": True, "barred": "moving"})
robot_session.good({"type": "robotCommand", "id": "0", "label": "Lights"}, "robotCommand: the least")
for part in ["start", "stop", "bookmark"]:
    robot_session.good({"type": "robotCommand", "id": "record-" + part, "label": "Record", "recording": part}, "robotCommand: recording " + part)
for bar in ["not-permitted", "not-driver", "estop"]:
    robot_session.good({**button, "barred": bar}, "robotCommand: barred " + bar)
robot_session.spoil(button, ("id", ""), ("id", "Dock"), ("id", "-dock"), ("id", "d" * 33), ("id", ABSENT), ("label", ""), ("label", ABSENT), ("label", "a\nb"),
                    ("group", ""), ("confirm", False), ("cancel", 1), ("recording", "pause"), ("barred", "no"), ("topic", "/dock", ""))
run = robot_session.good({"type": "commandRun", "run": 3, "id": "dock", "by": ada, "request": 9, "state": "running", "progress": 0.25, "detail": "turning"})
robot_session.good({"type": "commandRun", "run": 2 ** 32 - 1, "id": "dock", "by": bob, "state": "done"}, "commandRun: for others")
for end in ["failed", "cancelled", "timed-out"]:
    robot_session.good({"type": "commandRun", "run": 3, "id": "dock", "by": ada, "state": end, "detail": "x" * 200}, "commandRun: " + end)
robot_session.spoil(run, ("run", -1), ("run", ABSENT), ("id", "/dock"), ("by", ABSENT), ("by.name", ""), ("request", 0.5), ("state", "refused"), ("state", ABSENT),
                    ("progress", -0.1), ("progress", 1.1), ("detail", ""), ("detail", "x" * 201), ("value", 1, ""))
no = robot_session.good({"type": "commandRefused", "request": 9, "reason": "moving"})
for why in ["not-permitted", "not-driver", "estop", "unknown", "too-often", "busy", "repeated", "stale", "no-text", "not-cancellable"]:
    robot_session.good({**no, "reason": why}, "commandRefused: " + why)
robot_session.spoil(no, ("request", -1), ("request", ABSENT), ("reason", "because"), ("reason", ABSENT), ("detail", "x", ""))
recorded = robot_session.good({"type": "recording", "on": True, "bytes": 48000000, "forS": 62})
robot_session.good({"type": "recording", "on": False, "bytes": 0, "forS": 0}, "recording: none")
robot_session.spoil(recorded, ("on", 1), ("on", ABSENT), ("bytes", -1), ("bytes", 0.5), ("bytes", ABSENT), ("forS", -1), ("forS", 0.5), ("path", "/tmp/a.mcap", ""))
spot = {"x": 1.5, "y": -2.25, "z": 0}
# Of a spot on the floor: too far, not a number, without a height, with a fourth, as a list.
no_spot = [({**spot, "x": 100001}, "at.x"), ({**spot, "y": None}, "at.y"), ({"x": 1, "y": 2}, "at.z"), ({**spot, "w": 1}, "at"), ([1, 2, 3], "at")]
may = robot_session.good({"type": "pointing", "may": True}, "pointing: may")
robot_session.good({"type": "pointing", "may": False}, "pointing: may not")
robot_session.good({"type": "pointed", "by": 2 ** 32 - 1, "at": spot})
robot_session.spoil({"type": "pointed", "by": 1, "at": spot}, *[("at", at, where) for at, where in no_spot], ("by", -1), ("by", ABSENT))
robot_session.spoil(may, ("may", 1))
write("robot-session.json", robot_session.lists())

operator_session = Messages()
request = operator_session.good({"type": "leaseRequest", "take": False})
operator_session.good({"type": "leaseRequest", "take": True}, "leaseRequest to take over")
operator_session.good({"type": "leaseRelease"})
stop = operator_session.good({"type": "estop", "latch": True})
operator_session.good({"type": "estop", "latch": False}, "estop release")
operator_session.good({"type": "estop", "latch": True, "press": 2}, "estop with the number of the press")
release = operator_session.good({"type": "estop", "latch": False, "of": 7}, "estop release of one latch")
operator_session.spoil(release, ("of", -1), ("of", "7"), ("of", 2 ** 32), ("press", 0.5))
asks = operator_session.good({"type": "driveAsk"})
offers = operator_session.good({"type": "driveOffer", "to": 7})
for accept in [True, False]:
    answers = operator_session.good({"type": "driveAnswer", "id": 3, "accept": accept}, "driveAnswer: " + ("accept" if accept else "refuse"))
withdraws = operator_session.good({"type": "driveWithdraw", "id": 3})
operator_session.spoil(asks, ("to", 7, ""), ("lease", "0f3a9c", ""))
operator_session.spoil(offers, ("to", -1), ("to", 2 ** 32), ("to", "Bob"), ("to", ABSENT), ("lease", "0f3a9c", ""))
operator_session.spoil(answers, ("id", -1), ("id", ABSENT), ("accept", ABSENT), ("accept", 1), ("from", 7, ""))
operator_session.spoil(withdraws, ("id", ABSENT), ("id", 0.5), ("kind", "ask", ""))
called = operator_session.good({"type": "callCommand", "id": "dock", "request": 9, "timeMs": 51042.25})
noted = operator_session.good({"type": "callCommand", "id": "bookmark", "request": 2 ** 32 - 1, "timeMs": 0, "text": "x" * 120}, "callCommand: with a text")
operator_session.spoil(called, ("id", ""), ("id", "/dock"), ("id", "d" * 33), ("id", ABSENT), ("request", -1), ("request", ABSENT), ("timeMs", -1), ("timeMs", "0"),
                       ("timeMs", ABSENT), ("topic", "/cmd_vel", ""), ("message", {}, ""))
operator_session.spoil(noted, ("text", ""), ("text", "x" * 121), ("text", "a\nb"), ("text", "a\u0007"), ("text", "a\u202eb"), ("text", 1))
cancels = operator_session.good({"type": "cancelCommand", "run": 3})
operator_session.spoil(cancels, ("run", -1), ("run", ABSENT), ("id", "dock", ""))
stream = operator_session.good({"type": "stream", "running": False})
formats = operator_session.good({"type": "cloudFormats", "formats": ["points64", "organised", "unorganised"]})
operator_session.good({"type": "cloudFormats", "formats": []}, "cloudFormats: none")
pictures = operator_session.good({"type": "pictures", "cameras": [0, 2]})
wanted = operator_session.good({"type": "sensors", "sensors": [0, 1]})
operator_session.good({"type": "sensors", "sensors": []}, "sensors: none")
operator_session.good({"type": "pictures", "cameras": []}, "pictures: none")
wanted_videos = operator_session.good({"type": "videos", "videos": [0, 1]})
operator_session.good({"type": "videos", "videos": []}, "videos: none")
operator_session.good({"type": "videos", "videos": [0], "barcode": True}, "videos: with the latency barcode")
shares = operator_session.good({"type": "shares", "cloud": 4, "videos": [2, 1, 100]})
operator_session.good({"type": "shares", "cloud": 1, "videos": []}, "shares: of the cloud only")
display = operator_session.good({"type": "display", "framesPerSecond": 12.5, "points": 15000})
operator_session.good({"type": "display", "framesPerSecond": 1, "points": 1000}, "display: the slowest")
operator_session.good({"type": "display", "framesPerSecond": 240, "points": 10 ** 8}, "display: the fastest")
operator_session.spoil(display, ("framesPerSecond", 0.5), ("framesPerSecond", 241), ("framesPerSecond", ABSENT), ("points", 999), ("points", 1500.5),
                       ("points", 10 ** 8 + 1), ("points", ABSENT), ("sensor", 1, ""))
measured = operator_session.good({"type": "latencyMeasured", "id": 4, "frameNumber": 902, "mtpMs": 98.5, "firstMs": 91.25})
operator_session.good(changed(measured, "mtpMs", 60000), "latencyMeasured: the longest")
operator_session.spoil(measured, ("id", -1), ("id", 2 ** 32), ("frameNumber", 1.5), ("frameNumber", ABSENT), ("mtpMs", 60000.5), ("mtpMs", -1),
                       ("firstMs", ABSENT), ("firstMs", "91"), ("points", 1, ""))
operator_session.spoil(wanted, ("sensors", ABSENT), ("sensors", [8], "sensors.0"), ("sensors", [-1], "sensors.0"), ("sensors", [0] * 9))
operator_session.spoil(shares, ("cloud", ABSENT), ("cloud", 0), ("cloud", 101), ("cloud", 1.5), ("videos", ABSENT), ("videos", [1] * 9), ("videos", [0], "videos.0"),
                       ("videos", ["1"], "videos.0"), ("sound", 1, ""))
end_session = operator_session.good({"type": "endSession", "operator": 7, "block": False})
operator_session.good({"type": "endSession", "operator": 4294967295, "block": True}, "endSession: and block the grant")
operator_session.spoil(end_session, ("operator", ABSENT), ("operator", -1), ("operator", 2 ** 32), ("operator", "Ada"), ("block", ABSENT),
                       ("block", 1), ("session", "s1", ""))
for on in [True, False]:
    listen = operator_session.good({"type": "listen", "on": on}, "listen: " + ("on" if on else "off"))
    speak = operator_session.good({"type": "speak", "held": on}, "speak: " + ("held" if on else "let go"))
operator_session.spoil(listen, ("on", ABSENT), ("on", 1), ("microphone", 0, ""))
operator_session.spoil(speak, ("held", ABSENT), ("held", "yes"))
operator_session.spoil(wanted_videos, ("videos", ABSENT), ("videos", [8], "videos.0"), ("videos", [-1], "videos.0"), ("videos", [0] * 9), ("barcode", 1))
operator_session.spoil(pictures, ("cameras", ABSENT), ("cameras", 0), ("cameras", [8], "cameras.0"), ("cameras", [-1], "cameras.0"),
                       ("cameras", [0.5], "cameras.0"), ("cameras", [0] * 9))
operator_session.spoil(formats, ("formats", ABSENT), ("formats", ["draco"], "formats.0"), ("formats", ["points64"] * 4))
operator_session.common(stop, 1024)
operator_session.spoil(request, ("take", ABSENT), ("take", 0), ("limits", limits, ""))
operator_session.spoil(stop, ("latch", "true"), ("latch", ABSENT), ("type", "eStop"))
operator_session.spoil(stream, ("running", None))
points = operator_session.good({"type": "point", "at": spot})
operator_session.good({"type": "point", "at": {"x": -100000, "y": 100000, "z": -0.5}}, "point: farthest")
operator_session.spoil(points, *[("at", at, where) for at, where in no_spot], ("by", 1, ""))
write("operator-session.json", operator_session.lists())

telemetry = Messages()
pose = {"position": vector3(1.5, -2, 0), "orientation": {"x": 0, "y": 0, "z": 0.6, "w": 0.8}}
state = telemetry.good({
    "type": "telemetry", "sequence": 40, "timeMs": 88131.25, "pose": pose,
    "twist": {"linear": vector3(0.5), "angular": vector3(0, 0, -0.25)}, "battery": {"voltage": 25.2, "percentage": 0.81},
    "drive": "driving", "stages": {"captureMs": 8.1, "sampleMs": 1.2, "packMs": 0.4, "sendMs": 20},
    "stream": {"frameNumber": 901, "framesPerSecond": 30, "pointsPerFrame": 30000, "validPoints": 201344, "bitsPerSecond": 6e7,
               "targetBitsPerSecond": 8e7, "droppedFrames": 0},
    "operators": 2})
telemetry.good(changed(state, "battery", ABSENT), "telemetry without a battery")
telemetry.good(changed(state, "battery.percentage", ABSENT), "telemetry: the battery's charge is unknown")
telemetry.good(changed(state, "battery.voltage", ABSENT), "telemetry: the battery's voltage is unknown")
telemetry.good({**state, "ageMs": 12.5}, "telemetry: pose and twist were measured earlier")
motion = {"factor": 0.25, "reasons": ["view-late", "blind-travel"], "mostLinear": 0.75, "viewAgeMs": 310}
telemetry.good({**state, "motion": motion}, "telemetry: the motion is bounded")
telemetry.good({**state, "motion": {"factor": 1, "reasons": [], "mostLinear": 0}}, "telemetry: the motion is not bounded")
for guard in ["on", "blind", "off"]:
    telemetry.good({**state, "motion": {**motion, "obstacleGuard": guard}}, "telemetry: obstacle guard " + guard)
for reason in ["view-unknown", "view-late", "view-lost", "blind-travel", "obstacle-near", "obstacle", "drop-off",
               "unseen-space", "sensor-silent", "collision-topic", "collision-silent", "fence-near", "fence"]:
    telemetry.good({**state, "motion": {**motion, "reasons": [reason]}}, "telemetry: " + reason)
for told in [{"phase": "announcing", "metres": 0}, {"phase": "returning", "metres": 2.75}]:
    telemetry.good({**state, "motion": {**motion, "return": told}}, "telemetry: return " + told["phase"])
for end in ["service-back", "estop", "track-end", "moved", "no-track", "off-track", "odometry-silent", "sensor-silent", "unseen", "blocked",
            "no-wheels", "too-long"]:
    telemetry.good({**state, "motion": {**motion, "return": {"phase": "ended", "metres": 4.5, "end": end}}}, "telemetry: return ended, " + end)
returned = {**state, "motion": {**motion, "return": {"phase": "ended", "metres": 4.5, "end": "blocked"}}}
telemetry.spoil(returned, ("motion.return.phase", "waiting"), ("motion.return.phase", "returning", "motion.return.end"),
                ("motion.return.end", ABSENT), ("motion.return.end", "fear"), ("motion.return.metres", -1),
                ("motion.return.metres", ABSENT), ("motion.return.more", 1, "motion.return"))
telemetry.spoil({**state, "motion": motion}, ("motion.factor", 1.01), ("motion.factor", -0.1), ("motion.reasons", ["fear"], "motion.reasons.0"),
                ("motion.reasons", ["fence"] * 40), ("motion.mostLinear", -1), ("motion.mostLinear", ABSENT), ("motion.viewAgeMs", -1), ("motion.letGoFirst", False),
                ("motion.obstacleGuard", "sleeping"), ("motion.more", 1, "motion"))
telemetry.good(changed(state, "stream.feedback", "reports"), "telemetry: the rate follows receiver reports")
for drive in ["idle", "watchdog", "estop", "blocked"]:
    telemetry.good(changed(state, "drive", drive), "telemetry: " + drive)
telemetry.common(state, 4096)
telemetry.spoil(state, ("sequence", -1), ("ageMs", -1), ("timeMs", -1), ("pose.position.x", None), ("pose.orientation.w", 2, "pose.orientation"),
                ("pose.orientation.z", ABSENT), ("twist.linear", ABSENT), ("battery.percentage", 1.01), ("battery.voltage", -1),
                ("drive", "parked"), ("stages.sendMs", -1), ("stages.extra", 1, "stages"), ("stream.validPoints", 1.5),
                ("stream.feedback", "none"),
                ("stream.frameNumber", 2 ** 32), ("operators", -1), ("operators", ABSENT))
# Three bytes for each of 72 sectors: 7 bits of distance in steps of 25 mm with the bit of a drop-off, and where the unseen floor begins and ends.
def near_field(sectors):
    return base64.b64encode(bytes(byte for sector in sectors for byte in sector)).decode()


OPEN = (127, 127, 127)
near = telemetry.good({"type": "nearField", "timeMs": 88131.25, "sectors": near_field([(12, 0, 20), (128 + 40, 127, 127)] + [OPEN] * 69 + [(0, 126, 127)])})
telemetry.good({**near, "sectors": near_field([OPEN] * 72)}, "nearField: nothing is near, and all is seen")
telemetry.good({**near, "sectors": near_field([(127, 0, 80)] * 72)}, "nearField: nothing is seen")
telemetry.spoil(near, ("timeMs", -1), ("timeMs", ABSENT), ("sectors", ABSENT), ("sectors", ""), ("sectors", 7), ("sectors", "*" * 288),
                ("sectors", near_field([OPEN] * 71)), ("sectors", near_field([OPEN] * 73)), ("sectors", near_field([(255, 127, 127)] + [OPEN] * 71)),
                ("sectors", near_field([OPEN] * 71 + [(0, 1, 128)])), ("sectors", near_field([OPEN] * 71 + [(0, 9, 9)])),
                ("sectors", near_field([OPEN] * 71 + [(0, 127, 80)])), ("sectors", near_field([OPEN] * 71 + [(0, 128, 127)])), ("reach", 3, ""))
path = telemetry.good({"type": "path", "topic": "/plan", "timeMs": 88131.25, "ageMs": 240, "points": [[1.5, -2], [1.75, -1.98], [4.2, 0]]})
telemetry.good(changed(path, "points", []), "path: there is none any more")
telemetry.good(changed(path, "points", [[i / 100, -1e6] for i in range(128)]), "path: the longest")
telemetry.spoil(path, ("topic", ""), ("topic", ABSENT), ("timeMs", -1), ("ageMs", -1), ("ageMs", ABSENT), ("points", ABSENT), ("points", [[0, 0]] * 129),
                ("points", [[0]], "points.0"), ("points", [[0, 0, 0]], "points.0"), ("points", [[0, "1"]], "points.0.1"), ("points", [[0, None]], "points.0.1"),
                ("points", [[1000000.5, 0]], "points.0.0"), ("goal", [0, 0], ""))


# Runs of equal cells, a byte each: the state in the upper two bits, the number of cells less one in the lower six.
def runs(*pairs):
    return base64.b64encode(bytes(state << 6 | cells - 1 for state, cells in pairs)).decode()


# 40 cells across and 33 up: tiles of 32 × 32, 8 × 32, 32 × 1 and 8 × 1 cells.
room = telemetry.good({"type": "map", "topic": "/map", "number": 3, "timeMs": 88131.25, "ageMs": 52000, "width": 40, "height": 33, "cellM": 0.05,
                       "origin": {"x": -1, "y": -2.5, "yaw": 0.5},
                       "tiles": [[0, runs(*[(1, 64)] * 15, (1, 32), (3, 32))], [3, runs((0, 1), (2, 3), (3, 4))]]})
telemetry.good(changed(room, "tiles", []), "map: no tile")
telemetry.good({**room, "width": 512, "height": 512, "tiles": [[255, runs(*[(i % 4, 1) for i in range(1024)])]]}, "map: the longest tile")
telemetry.spoil(room, ("topic", ""), ("number", -1), ("number", 2 ** 32), ("timeMs", -1), ("ageMs", ABSENT), ("width", 0), ("width", 513), ("height", 1.5),
                ("cellM", 0), ("cellM", 1001), ("origin.yaw", 3.2), ("origin.x", -1000001), ("origin.z", 0, "origin"), ("origin", ABSENT), ("tiles", ABSENT),
                ("tiles", [[4, runs((0, 8))]], "tiles"), ("tiles", [[-1, runs((0, 8))]], "tiles.0.0"), ("tiles", [[3, runs((0, 7))]], "tiles"),
                ("tiles", [[3, runs((0, 9))]], "tiles"), ("tiles", [[3, ""]], "tiles"), ("tiles", [[3, "BQ="]], "tiles"), ("tiles", [[3, "**=="]], "tiles"),
                ("tiles", [[3, 7]], "tiles.0.1"), ("tiles", [[3]], "tiles.0"), ("tiles", [[3, runs((0, 8))]] * 65), ("tiles", [[0, "A" * 1372]], "tiles.0.1"),
                ("cells", 1320, ""))
joints = telemetry.good({"type": "joints", "model": 2, "timeMs": 88131.25, "ageMs": 12, "positions": [-1.57, 0.25]})
telemetry.good(changed(joints, "positions", [-1000, 1000] * 64), "joints: the most")
telemetry.spoil(joints, ("model", -1), ("model", ABSENT), ("timeMs", -1), ("ageMs", ABSENT), ("positions", ABSENT), ("positions", [0] * 129), ("positions", [None], "positions.0"),
                ("positions", [1000.5], "positions.0"), ("positions", ["0"], "positions.0"), ("names", [], ""))
reading = telemetry.good({"type": "reading", "topic": "/battery", "label": "Battery", "level": "ok",
                          "values": [["", "87 %"], ["", "25.1 V"], ["cells", "[4.1, 4.2]"]], "ageMs": 120})
telemetry.good(changed(reading, "values", []), "reading without values")
telemetry.good({**reading, "timeMs": 88131.25}, "reading with its time")
samples = telemetry.good({"type": "samples", "timeMs": 88131.25, "samples": [[0, -20, 24.5], [0, 0, 24.75], [63, -0.5, -1e-300]]})
diagnostics = telemetry.good({"type": "diagnostics", "topic": "/diagnostics", "timeMs": 88131.25,
                              "counts": {"error": 1, "warn": 0, "stale": 1, "ok": 12},
                              "reports": [{"name": "lidar", "level": "error", "message": "no data", "sinceMs": 88000},
                                          {"name": "gripper", "level": "stale", "message": "", "sinceMs": 70000.5}]})
telemetry.good(changed(diagnostics, "reports", []), "diagnostics: only the counts")
for level in ["warn", "ok"]:
    telemetry.good(changed(diagnostics, "reports.0.level", level), "diagnostics: " + level)
telemetry.spoil(samples, ("timeMs", -1), ("samples", []), ("samples", [[0, 0, 1]] * 65), ("samples", [[64, 0, 1]], "samples.0.0"),
                ("samples", [[0, 1, 1]], "samples.0.1"), ("samples", [[0, 0, None]], "samples.0.2"), ("samples", [[0, 0]], "samples.0"))
telemetry.good(changed(diagnostics, "recorded", True), "diagnostics of a recording")
telemetry.spoil(diagnostics, ("recorded", 1), ("topic", ""), ("timeMs", ABSENT), ("counts.ok", -1), ("counts.fatal", 1, "counts"), ("counts.stale", ABSENT),
                ("reports", diagnostics["reports"] * 5), ("reports.0.name", "n" * 49), ("reports.0.level", "fatal"),
                ("reports.0.message", "m" * 73), ("reports.1.sinceMs", -1))
for level in ["warn", "error"]:
    telemetry.good(changed(reading, "level", level), "reading: " + level)
telemetry.spoil(reading, ("topic", ""), ("topic", "/" + "a" * 255), ("label", ""), ("label", "l" * 41), ("level", "fatal"),
                ("values", [["", "x"]] * 11), ("values", [["x"]], "values.0"), ("values", [["n" * 37, "x"]], "values.0.0"),
                ("values", [["", "x" * 61]], "values.0.1"), ("values", [["", 7]], "values.0.1"), ("ageMs", -1), ("timeMs", -1), ("unit", "V", ""))
stages = telemetry.good({"type": "stages", "frames": [[0, 901, 88131000, 4000, 31250, 32100, 58400], [1, 77, 88140500, 900, 900, 900, 900]],
                         "commands": [[17, 88120500, 40, 95], [18, 88145500, 38, None]]})
telemetry.good({"type": "stages", "frames": [], "commands": []}, "stages: none")
telemetry.good({"type": "stages", "frames": [[7] + [2 ** 32 - 1] * 2 + [60_000_000] * 4] * 32, "commands": [[2 ** 32 - 1] * 2 + [60_000_000] * 2] * 32},
                   "stages: as many and as long as there may be")
telemetry.spoil(stages, ("frames", ABSENT), ("commands", ABSENT), ("frames", [stages["frames"][1]] * 33), ("commands", [[1, 2, 3, 4]] * 33),
                    ("frames.0.0", 8), ("frames.0.1", -1), ("frames.0.2", 2 ** 32), ("frames.0.3", 0.5), ("frames.0.3", 31251, "frames.0"),
                    ("frames.0.4", 32101, "frames.0"), ("frames.0.5", 58401, "frames.0"), ("frames.0.6", 60_000_001), ("frames.1.6", None),
                    ("frames.1", [1, 77, 88140500, 900, 900, 900]), ("frames.1", [1, 77, 88140500, 900, 900, 900, 900, 900]),
                    ("commands.0.0", "17"), ("commands.0.1", -1), ("commands.0.2", 96, "commands.0"), ("commands.0.3", 39, "commands.0"),
                    ("commands.0.3", -1), ("commands.1.2", None), ("commands.1", [18]), ("from", 0, ""))
write("telemetry.json", telemetry.lists())

broadcast = Messages()
m_broadcast = broadcast.good({
    "type": "farpointBroadcast", "version": 1, "name": "Rover",
    "videos": [{"name": "Front", "mid": "v0", "codec": "H264"}, {"name": "Rear", "mid": "v1", "codec": "VP8", "fault": "the camera is unplugged"}],
    "clouds": {"mid": "cloud", "sensors": [{"name": "Camera"}, {"name": "LiDAR"}], "streams": [
        {"format": "organised", "header": "RlBPQwEBAAA=", "sensor": 0}, {"format": "unorganised", "header": "RlBVQwEBAAA=", "sensor": 1}]}},
    "videos and clouds")
broadcast.good({"type": "farpointBroadcast", "version": 1, "name": "Rover", "videos": []}, "nothing")
broadcast.common(m_broadcast, 65536)
broadcast.spoil(m_broadcast, ("type", "welcome"), ("version", 2), ("name", ""), ("videos", ABSENT), ("videos.0.mid", "a b"), ("videos.1.codec", "AV1"),
                ("videos.0.extra", 1, "videos.0"), ("clouds.mid", ABSENT), ("clouds.sensors", []), ("clouds.sensors.0.name", 7),
                ("clouds.streams.0.format", "points64"), ("clouds.streams.0.header", ""), ("clouds.streams.1.sensor", 8),
                ("clouds.streams.1.sensor", ABSENT), ("clouds.streams.1.type", "cloudStream", "clouds.streams.1"))
write("broadcast.json", broadcast.lists())

reference_control = Messages()
twist = reference_control.good({"linear": vector3(0.5), "angular": vector3(0, 0, -0.25)}, "twist")
reference_control.good({"linear": vector3(0, 0, 1), "angular": vector3()}, "asks for a latency-test frame")
reference_control.common(twist, 1024)
reference_control.spoil(twist, ("linear.x", "1"), ("linear.z", ABSENT), ("angular", None), ("angular.y", None))
write("reference-control.json", reference_control.lists())

# Signaling -----------------------------------------------------------------------------------------------------------

SDP = "v=0\r\no=- 1 1 IN IP4 0.0.0.0\r\ns=-\r\nt=0 0\r\n"
CANDIDATE = "candidate:1 1 udp 2113937151 192.0.2.7 50000 typ host"
ice = {"candidate": CANDIDATE, "sdpMid": "0", "sdpMLineIndex": 0}
offer = {"type": "session.offer", "session": "s1", "sdp": SDP}
session_answer = {"type": "session.answer", "session": "s1", "sdp": SDP}
granted_answer = {**session_answer, "grant": "a.b-_.", "proof": "A.B.9"}
GRANTED = "session.answer with a grant and a proof"
IDENTIFIED = "session.offer with an identity"
BAD_IDENTITIES = [("identity", ""), ("identity", "a b"), ("identity", "x" * 2049), ("identity", 7)]
BAD_GRANTS = [("grant", ""), ("grant", "a b"), ("grant", "x" * 4097), ("grant", 7), ("proof", ""), ("proof", "a\nb"), ("proof", "x" * 2049),
              ("token", "x", "")]
trickle = {"type": "session.candidate", "session": "s1", "candidate": ice}
close = {"type": "session.close", "session": "s1"}
closed = {"type": "session.closed", "session": "s1", "reason": "operator-left"}
ended = {"type": "session.closed", "session": "s1", "reason": "robot-left"}
refuse = {"type": "session.refuse", "session": "s1", "claim": "c1", "code": "wrong-resume-key"}
ROBOT_REASONS = ["robot-full", "bad-answer", "not-granted", "grant-expired", "grant-revoked", "ended-by-supervisor", "unproven-peer", "not-connected",
                 "connection-lost", "silent", "not-reading", "shutting-down"]
error = {"type": "error", "code": "unknown-robot", "message": "no robot 'sim-9' is here", "session": "s1"}
servers = [{"urls": "stun:stun.example.org"},
           {"urls": ["turn:turn.example.org", "turns:turn.example.org"], "username": "u", "credential": "c"}]

m = Messages()
hello = m.good({"type": "robot.hello", "protocol": 1, "id": "sim-1", "name": "Simulated robot", "key": "k_0-Z", "token": "secret"})
m.good(changed(hello, "token", ABSENT), "robot.hello without a token")
for message in [offer, trickle, close, refuse]:
    m.good(message)
m.good({**offer, "claim": "c1"}, "session.offer that answers a session.resume")
for reason in ROBOT_REASONS:
    m.good({**close, "reason": reason}, "session.close: " + reason)
full = m.good({**close, "reason": "robot-full", "maxOperators": 4}, "session.close: robot-full, with how many")
m.good({**close, "reason": "bad-answer", "detail": "no codec in common"}, "session.close with a detail")
for code in ["unknown-session", "resume-too-soon"]:
    m.good({**refuse, "code": code}, "session.refuse: " + code)
m.good({**trickle, "candidate": {"candidate": ""}}, "the end of the candidates")
m.good({**trickle, "candidate": {**ice, "sdpMid": None, "sdpMLineIndex": None, "usernameFragment": "abcd"}}, "candidate with nulls")
m.common(close, 65536)
m.spoil(hello, ("protocol", 0), ("id", "Robot 1"), ("id", ""), ("name", ""), ("name", "\u0000"), ("key", ""), ("key", "a.b"), ("key", ABSENT), ("token", ""),
        ("token", "x" * 4097), ("admin", True, ""))
identified = m.good({**offer, "identity": "a.b-_.C9"}, IDENTIFIED)
m.spoil(identified, *BAD_IDENTITIES)
m.spoil(offer, ("session", ""), ("session", "s 1"), ("sdp", ""), ("sdp", ABSENT), ("type", "session.answer"))
m.spoil(trickle, ("candidate", CANDIDATE), ("candidate.candidate", "x" * 1025), ("candidate.sdpMLineIndex", -1), ("candidate.extra", 1, "candidate"))
m.spoil(full, ("reason", "operator-left"), ("maxOperators", -1), ("maxOperators", "4"), ("detail", "x" * 301))
m.spoil(refuse, ("claim", ABSENT), ("code", "unauthorized"), ("session", ABSENT))
robot_status = {"state": "driven", "sinceMs": 1800000000000, "battery": 0.78, "driver": "Ada", "operators": 3, "watchers": 2, "maxOperators": 4, "alarms": 0,
                "version": "1.2.3-rc.1+a"}
no_status = [("battery", 1.01), ("battery", -0.01), ("battery", None), ("state", "asleep"), ("state", ABSENT), ("sinceMs", -1), ("sinceMs", 0.5),
             ("sinceMs", 8640000000000001), ("sinceMs", ABSENT), ("driver", ""), ("driver", "\0"), ("operators", 0.5), ("operators", -1), ("watchers", ABSENT),
             ("watchers", "2"), ("maxOperators", 1000001), ("alarms", ABSENT), ("version", ""), ("version", "a b"), ("version", "x" * 33), ("pose", [0, 0])]


def spoil_status(messages, base, place):
    """A status is wrong in each way. @param place: where it is in the message"""
    messages.spoil(base, *[(place + "." + key, value, place if key == "pose" else place + "." + key) for key, value in no_status])


told = m.good({"type": "robot.status", "status": robot_status}, "robot.status: everything")
for state in ["free", "driven", "stopped", "fault"]:
    m.good({"type": "robot.status", "status": {"state": state, "sinceMs": 0, "operators": 0, "watchers": 0, "maxOperators": 1000000, "alarms": 1000000}},
           "robot.status: %s, nothing optional" % state)
spoil_status(m, told, "status")
m.spoil(told, ("id", "r2", ""), ("status", ABSENT))
write("signaling-robot-to-service.json", m.lists())

m = Messages()
m_welcome = m.good({"type": "robot.welcome", "id": "sim-1", "iceServers": servers})
m_request = m.good({"type": "session.request", "session": "s1", "operator": "Ada"})
m_resume = m.good({"type": "session.resume", "session": "s1", "operator": "Ada", "claim": "c1", "resumeKey": "k_0-Z"})
for message in [session_answer, trickle, closed, error]:
    m.good(message)
m.good(granted_answer, GRANTED)
m.good({**granted_answer, "grant": "x" * 4096, "proof": "x" * 2048}, GRANTED + ", the longest")
m.spoil(granted_answer, *BAD_GRANTS)
revocations = m.good({"type": "revocations", "list": "a.b-_.C9"})
m.good({**revocations, "list": "x" * 60000}, "revocations, the longest")
m.spoil(revocations, ("list", ABSENT), ("list", ""), ("list", "a b"), ("list", "x" * 60001), ("list", ["a.b.c"]), ("lists", ["a.b.c"], ""))
m.good({**closed, "reason": "closed-by-operator"}, "session.closed: closed-by-operator")
for code in ["malformed", "too-large", "rate-limited", "hello-first", "unauthorized", "robot-id-taken", "unknown-session",
             "too-many-sessions", "wrong-resume-key", "resume-too-soon", "unsupported-protocol", "full", "shutting-down"]:
    m.good({"type": "error", "code": code, "message": ""}, "error: " + code)
m.common(m_request, 65536)
m.spoil(m_welcome, ("iceServers", ABSENT), ("iceServers.0.urls", 1), ("iceServers.1.password", "x", "iceServers.1"))
m.spoil(m_request, ("operator", ""), ("session", None), ("type", "session.offer"))
m.spoil(m_resume, ("operator", ABSENT), ("session", "../x"), ("claim", ABSENT), ("resumeKey", ABSENT))
m.spoil(closed, ("reason", "bored"), ("reason", "robot-left"))
m.spoil(error, ("code", "oops"), ("message", "x" * 1025))
write("signaling-service-to-robot.json", m.lists())

m = Messages()
hello = m.good({"type": "operator.hello", "protocol": 1, "name": "Ada", "token": "secret"})
m_open = m.good({"type": "session.open", "robotId": "sim-1"})
m_resume = m.good({"type": "session.resume", "session": "s1", "robotId": "sim-1", "resumeKey": "k_0-Z"})
for message in [session_answer, trickle, close]:
    m.good(message)
m.good(granted_answer, GRANTED)
m.spoil(granted_answer, *BAD_GRANTS)
m.common(m_open, 65536)
m.spoil(hello, ("protocol", "1"), ("name", ABSENT), ("token", 5))
m.spoil(m_resume, ("robotId", ABSENT), ("session", ABSENT), ("session", "a b"), ("resumeKey", ABSENT), ("resumeKey", "a.b"))
m.spoil(m_open, ("robotId", 0), ("robotId", "../x"), ("type", "session.offer"))
watches = m.good({"type": "statuses.watch", "on": True}, "statuses.watch: on")
m.good({"type": "statuses.watch", "on": False}, "statuses.watch: off")
m.spoil(watches, ("on", ABSENT), ("on", 1), ("robotId", "r", ""))
write("signaling-operator-to-service.json", m.lists())

GOOD_SIGN_IN_URLS = ["https://issuer.example/sign-in", "https://issuer.example:8443/a/sign-in",
                     "http://127.0.0.1:3010/sign-in", "http://localhost:3010/sign-in", "http://[::1]:3010/sign-in"]
BAD_SIGN_IN_URLS = ["http://issuer.example/sign-in", "https://issuer.example/sign-in?a=1", "https://issuer.example/#a",
                    "https://ada:secret@issuer.example/sign-in", "javascript:alert(1)", "issuer.example", "",
                    "https://issuer.example/" + "a" * 500]

# Sign-in: addresses, not messages.
A_KEY, BACK = "k" * 43, "https://teleop.example/?robot=r1"
BACK_IN_QUERY = "https%3A%2F%2Fteleop.example%2F%3Frobot%3Dr1"
write("sign-in.json", {
    "requests": [
        {"address": "https://issuer.example/sign-in?key=%s&return=%s&state=s-1_Z" % (A_KEY, BACK_IN_QUERY),
         "request": {"key": A_KEY, "return": BACK, "state": "s-1_Z"}},
        {"address": "https://issuer.example/sign-in?key=%s&return=%s" % (A_KEY, BACK_IN_QUERY),
         "request": {"key": A_KEY, "return": BACK, "state": None}},
    ],
    "faults": [
        {"query": "", "fault": "bad-return", "return": None},
        {"query": "key=%s" % A_KEY, "fault": "bad-return", "return": None},
        {"query": "key=%s&return=http%%3A%%2F%%2Fteleop.example" % A_KEY, "fault": "bad-return", "return": None},
        {"query": "key=%s&return=https%%3A%%2F%%2Fteleop.example%%2F%%23a" % A_KEY, "fault": "bad-return", "return": None},
        {"query": "key=%s&return=https%%3A%%2F%%2Fteleop.example%%2F%s" % (A_KEY, "a" * 2048), "fault": "bad-return", "return": None},
        {"query": "return=%s" % BACK_IN_QUERY, "fault": "bad-key", "return": BACK},
        {"query": "key=short&return=%s" % BACK_IN_QUERY, "fault": "bad-key", "return": BACK},
        {"query": "key=%s&return=%s&state=a%%20b" % (A_KEY, BACK_IN_QUERY), "fault": "bad-state", "return": BACK},
        {"query": "key=%s&return=%s&state=%s" % (A_KEY, BACK_IN_QUERY, "s" * 65), "fault": "bad-state", "return": BACK},
    ],
    "answers": [
        {"hash": "#grant=eyJ0eXAi.eyJpc3Mi.c2ln&state=s-1_Z", "answer": {"grant": "eyJ0eXAi.eyJpc3Mi.c2ln", "state": "s-1_Z"}},
        {"hash": "#grant=farpoint-ticket.abc", "answer": {"grant": "farpoint-ticket.abc", "state": None}},
        {"hash": "#sign-in-error=not-permitted&state=s1", "answer": {"error": "not-permitted", "state": "s1"}},
    ],
    "others": ["", "#", "#top", "#grants=x", "#sign-in-error=%3Cscript%3E", "#state=s1"],
    "good addresses": GOOD_SIGN_IN_URLS,
    "bad addresses": BAD_SIGN_IN_URLS,
})

m = Messages()
m.good({"type": "operator.welcome", "iceServers": []})
welcome = m.good({"type": "operator.welcome", "iceServers": [], "signIn": "https://issuer.example/sign-in"})
m.spoil(welcome, *[("signIn", url) for url in BAD_SIGN_IN_URLS], ("signIn", 5))
robots = m.good({"type": "robots", "robots": [{"id": "sim-1", "name": "Simulated robot"}, {"id": "r2", "name": "\u00d6rn"}]})
m.good({"type": "robots", "robots": []}, "no robots")
delta = m.good({"type": "robots.changed", "here": [{"id": "sim-2", "name": "Second robot"}], "gone": ["sim-1", "r2"]})
m.good({"type": "robots.changed", "here": [], "gone": []}, "nothing changed")
opened = m.good({"type": "session.opened", "session": "s1", "robotId": "sim-1"})
resuming = m.good({"type": "session.resuming", "session": "s1"})
for message in [offer, trickle, ended, error]:
    m.good(message)
m.spoil(m.good({**offer, "identity": "a.b-_.C9"}, IDENTIFIED), *BAD_IDENTITIES)
for reason in [*ROBOT_REASONS, "closed-by-robot", "unknown-session"]:
    m.good({**ended, "reason": reason}, "session.closed: " + reason)
m.good({**ended, "reason": "robot-full", "maxOperators": 4}, "session.closed: robot-full, with how many")
m.good({**ended, "reason": "bad-answer", "detail": "no codec in common"}, "session.closed with a detail")
m.common(opened, 3145728)
m.spoil(robots, ("robots", None), ("robots.0.id", "A"), ("robots.1.name", ABSENT), ("robots.1.key", "k", "robots.1"))
m.spoil(delta, ("here", ABSENT), ("here.0.name", ""), ("here.0.key", "k", "here.0"), ("gone", ABSENT), ("gone.1", "R 2"), ("gone.0", {"id": "sim-1"}), ("robots", [], ""))
m.spoil(opened, ("robotId", ABSENT), ("type", "session.answer"))
m.spoil(resuming, ("session", ABSENT), ("robotId", "sim-1", ""))
m.spoil(ended, ("reason", "closed-by-operator"), ("maxOperators", 0.5), ("detail", 7))
listed = {"id": "sim-1", "status": robot_status}
statuses = m.good({"type": "statuses", "statuses": [listed]})
m.good({"type": "statuses", "statuses": []}, "statuses: none")
changes = m.good({"type": "statuses.changed", "here": [listed], "gone": ["sim-2"]})
spoil_status(m, statuses, "statuses.0.status")
spoil_status(m, changes, "here.0.status")
m.spoil(statuses, ("statuses", ABSENT), ("statuses.0.id", "R 1"), ("statuses.0.name", "Rover", "statuses.0"))
m.spoil({"type": "statuses.changed", "here": [], "gone": ["sim-2"]}, ("gone", ABSENT), ("gone.0", "R 2"), ("here", ABSENT))
write("signaling-service-to-operator.json", m.lists())

# The reference system's signaling: unknown fields are let through, ids are numbers from 0.
m = Messages()
register = m.good({"type": "register", "name": "robot", "sdpOffer": SDP})
m.good({**register, "version": 3}, "register with a field unknown to us")
m_offer = m.good({"type": "offer", "robotId": 0, "sdpOffer": SDP})
m_candidate = m.good({"type": "candidate", "robotId": 0, "candidate": CANDIDATE})
gone = m.good({"type": "deregister", "robotId": 0})
m.common(gone, 65536)
m.spoil(register, ("name", ABSENT), ("name", "x" * 257), ("sdpOffer", 1), ("type", "hello"))
m.spoil(m_offer, ("robotId", -1), ("robotId", "0"), ("robotId", ABSENT))
m.spoil(m_candidate, ("candidate", {"candidate": CANDIDATE}), ("candidate", "x" * 1025))
write("reference-robot-to-service.json", m.lists())

m = Messages()
m_get = m.good({"type": "getRobots"})
m_answer = m.good({"type": "answer", "robotId": 0, "sdpAnswer": SDP})
m.good({"type": "candidate", "robotId": 0, "candidate": CANDIDATE})
m.common(m_get, 65536)
m.spoil(m_answer, ("robotId", None), ("sdpAnswer", ABSENT), ("type", "offer"))
write("reference-client-to-service.json", m.lists())

m = Messages()
registered = m.good({"type": "registered", "robotId": 0})
m_answer = m.good({"type": "sdpAnswer", "sdpAnswer": SDP})
m.good({"type": "candidate", "candidate": CANDIDATE})
m.common(registered, 65536)
m.spoil(registered, ("robotId", 0.5))
m.spoil(m_answer, ("sdpAnswer", None))
write("reference-service-to-robot.json", m.lists())

m = Messages()
record = {"id": 0, "name": "robot", "sdpOffer": SDP, "sdpAnswer": None, "robotCandidates": [CANDIDATE], "clientCandidates": []}
listing = m.good({"type": "robots", "robots": [record, {**record, "id": 1, "sdpAnswer": SDP}]})
pushed = m.good({"type": "register", "robot": record})
m.good({"type": "offer", "robotId": 0, "sdpOffer": SDP})
m.good({"type": "candidate", "robotId": 0, "candidate": CANDIDATE})
m.good({"type": "deregister", "robotId": 0})
m.good({"type": "deregister"}, "deregister as the reference service sends it")
away = m.good({"type": "deregistered", "robotId": 0})
m.common(away, 8388608)
m.spoil(listing, ("robots.0.id", "0"), ("robots.1.robotCandidates", [1], "robots.1.robotCandidates.0"))
m.spoil(pushed, ("robot", ABSENT), ("robot.sdpAnswer", 0))
m.spoil(away, ("robotId", ABSENT))
write("reference-service-to-client.json", m.lists())
