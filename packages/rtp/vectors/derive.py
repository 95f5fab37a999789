#!/usr/bin/env python3
"""Writes transport-feedback.json from draft-holmer-rmcat-transport-wide-cc-extensions-01, section 3.1.

Shares no code with the tested parser. Standard library only.
"""
import json
import os
import struct


def run(symbol, count):
    return struct.pack(">H", symbol << 13 | count)


def bits1(symbols):
    value = 0x8000
    for i, s in enumerate(symbols):
        value |= s << (13 - i)
    return struct.pack(">H", value)


def bits2(symbols):
    value = 0xC000
    for i, s in enumerate(symbols):
        value |= s << (12 - 2 * i)
    return struct.pack(">H", value)


def packet(base, count, reference, number, content, *, padding=0, fmt=15, pt=205, version=2, words=None,
           sender=0x11223344, media=0x55667788, last_pad=None):
    body = struct.pack(">IIHH", sender, media, base, count)
    body += struct.pack(">i", reference)[1:] + bytes([number]) + content
    if padding:
        body += bytes(padding - 1) + bytes([padding if last_pad is None else last_pad])
    first = version << 6 | (0x20 if padding else 0) | fmt
    if words is None:
        assert len(body) % 4 == 0, len(body)
        words = len(body) // 4
    return struct.pack(">BBH", first, pt, words) + body


def small(*deltas):
    return bytes(deltas)


def large(*deltas):
    return b"".join(struct.pack(">h", d) for d in deltas)


def good(name, data, base, reference_us, number, arrivals):
    return {
        "name": name, "hex": data.hex(), "senderSsrc": 0x11223344, "mediaSsrc": 0x55667788, "baseSequence": base,
        "referenceTimeUs": reference_us, "feedbackCount": number, "arrivalsUs": arrivals,
    }


def times(start, *ticks):
    out, t = [], start
    for d in ticks:
        if d is None:
            out.append(None)
        else:
            t += d * 250
            out.append(t)
    return out


valid = [
    good("run of received packets, small deltas", packet(100, 4, 1, 7, run(1, 4) + small(0, 4, 8, 255) + b"\0\0", padding=0),
         100, 64000, 7, times(64000, 0, 4, 8, 255)),
    good("run of lost packets between two received", packet(65534, 5, 2, 255, run(1, 1) + run(0, 3) + run(1, 1) + small(10, 20)),
         65534, 128000, 255, times(128000, 10, None, None, None, 20)),
    good("one-bit vector, padded chunk", packet(0, 3, 0, 0, bits1([1, 0, 1]) + small(1, 2)),
         0, 0, 0, times(0, 1, None, 2)),
    good("two-bit vector with large and negative deltas", packet(9, 7, 3, 1, bits2([1, 2, 0, 2, 1, 0, 2]) + small(5) + large(-3)
         + large(32767) + small(0) + large(-32768) + b"\0\0"),
         9, 192000, 1, times(192000, 5, -3, None, 32767, 0, None, -32768)),
    good("run of large deltas", packet(1, 3, 10, 2, run(2, 3) + large(256, -256, 1000)),
         1, 640000, 2, times(640000, 256, -256, 1000)),
    good("negative reference time", packet(5, 1, -1, 3, run(1, 1) + small(4) + b"\0"),
         5, -64000, 3, times(-64000, 4)),
    good("smallest reference time", packet(5, 1, -(2 ** 23), 3, run(1, 1) + small(4) + b"\0"),
         5, -(2 ** 23) * 64000, 3, times(-(2 ** 23) * 64000, 4)),
    good("largest reference time", packet(5, 1, 2 ** 23 - 1, 3, run(1, 1) + small(4) + b"\0"),
         5, (2 ** 23 - 1) * 64000, 3, times((2 ** 23 - 1) * 64000, 4)),
    good("all lost", packet(40000, 300, 4, 9, run(0, 300) + b"\0\0"), 40000, 256000, 9, [None] * 300),
    good("padding bit set", packet(7, 1, 1, 4, run(1, 1) + small(2), padding=1), 7, 64000, 4, times(64000, 2)),
    good("padding of five bytes", packet(7, 1, 1, 4, run(1, 1) + small(2), padding=5), 7, 64000, 4, times(64000, 2)),
    good("run longer than the packets reported", packet(7, 2, 1, 4, run(1, 5) + small(2, 3)), 7, 64000, 4, times(64000, 2, 3)),
    good("run of length zero is stepped over", packet(7, 1, 1, 4, run(1, 0) + run(1, 1) + small(2) + b"\0\0\0"),
         7, 64000, 4, times(64000, 2)),
    good("one-bit vector over two chunks", packet(50, 16, 1, 5, bits1([1] * 14) + bits1([0, 1]) + small(*range(15)) + b"\0"),
         50, 64000, 5, times(64000, *range(14), None, 14)),
]


def bad(name, data, code):
    return {"name": name, "hex": data.hex(), "error": code}


whole = packet(100, 4, 1, 7, run(1, 4) + small(0, 4, 8, 255) + b"\0\0")
invalid = [
    bad("nothing", b"", "truncated"),
    bad("nineteen bytes", whole[:19], "truncated"),
    bad("length field larger than the bytes", whole[:-4], "bad-length"),
    bad("length field smaller than the bytes", whole + b"\0\0\0\0", "bad-length"),
    bad("no chunk", packet(1, 1, 1, 1, b""), "truncated"),
    bad("chunks cover too few", packet(1, 30, 1, 1, bits1([0] * 14) + bits1([0] * 14)), "truncated"),
    bad("a small delta missing", packet(1, 3, 1, 1, run(1, 3) + small(1, 2)), "truncated"),
    bad("half a large delta", packet(1, 2, 1, 1, bits2([1, 2]) + small(1) + b"\0"), "truncated"),
    bad("delta inside the padding", packet(1, 3, 1, 1, run(1, 3) + small(1, 2), padding=4), "truncated"),
    bad("no packet reported", packet(1, 0, 1, 1, run(1, 0) + b"\0\0"), "empty"),
    bad("reserved symbol in a run", packet(1, 1, 1, 1, run(3, 1) + b"\0\0"), "reserved-status"),
    bad("reserved symbol in a vector", packet(1, 2, 1, 1, bits2([0, 3]) + b"\0\0"), "reserved-status"),
    bad("generic NACK", packet(1, 4, 1, 7, run(1, 4) + small(0, 4, 8, 255) + b"\0\0", fmt=1), "not-transport-feedback"),
    bad("receiver report", packet(1, 4, 1, 7, run(1, 4) + small(0, 4, 8, 255) + b"\0\0", pt=201), "not-transport-feedback"),
    bad("version 1", packet(1, 4, 1, 7, run(1, 4) + small(0, 4, 8, 255) + b"\0\0", version=1), "not-transport-feedback"),
    bad("padding of zero", packet(7, 1, 1, 4, run(1, 1) + small(2), padding=1, last_pad=0), "bad-padding"),
    bad("padding into the header", packet(7, 1, 1, 4, run(1, 1) + small(2), padding=1, last_pad=5), "bad-padding"),
]

with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "transport-feedback.json"), "w") as out:
    # One vector per line.
    lines = lambda vectors: ",\n".join("    " + json.dumps(v) for v in vectors)
    out.write('{\n  "valid": [\n%s\n  ],\n  "invalid": [\n%s\n  ]\n}\n' % (lines(valid), lines(invalid)))
