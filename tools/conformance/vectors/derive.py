"""Writes frames.json from docs/protocol.md alone: RTP payloads in order of arrival, and the messages that a bridge
makes from them.

Python 3, standard library; shares no code with the implementations. Run it in this folder.
"""

import json
import struct

PAYLOAD = 1216


def point(frame, place):
    """x, y, z in mm and the colour's 16 bits, different for every frame and place."""
    return (frame * 100 + 1, place - 200, 32767 - place, (place * 37 + frame * 11) & 0xFFFF)


def packet(frame, total, first, count):
    points = [point(frame, first + i) for i in range(count)]
    head = struct.pack("<4I", frame, total * 8, first * 8, count * 8)
    data = b"".join(struct.pack("<3h", *p[:3]) for p in points) + b"".join(struct.pack("<H", p[3]) for p in points)
    return (head + data).ljust(PAYLOAD, b"\0")


def packets(frame, total):
    return [packet(frame, total, first, min(150, total - first)) for first in range(0, total, 150)]


def message(frame, places):
    points = [point(frame, place) for place in places]
    return b"".join(struct.pack("<3h", *p[:3]) for p in points) + b"".join(struct.pack("<H", p[3]) for p in points)


def whole(frame, total):
    return message(frame, range(total))


a, b, c = packets(1, 450)
d, e = packets(2, 300)
lie = bytearray(e)
struct.pack_into("<I", lie, 4, 300 * 8 + 1)
beyond = bytearray(e)
struct.pack_into("<I", beyond, 8, 300 * 8)

VECTORS = [
    ("a whole frame is given out without the next", [a, b, c], [whole(1, 450)]),
    ("a last packet that is partial keeps its points", packets(1, 152), [whole(1, 152)]),
    ("packets of one frame in any order", [c, a, b], [whole(1, 450)]),
    ("packets that come twice", [a, a, b, b, c], [whole(1, 450)]),
    ("a lost packet costs its own points", [a, c, d, e], [message(1, [*range(150), *range(300, 450)]), whole(2, 300)]),
    ("packets of two frames between each other", [a, d, b, e, c], [message(1, range(300)), whole(2, 300)]),
    ("a packet that comes after its frame is in no other", [a, c, d, e, b], [message(1, [*range(150), *range(300, 450)]), whole(2, 300)]),
    ("packets that cannot be are passed over", [b"", a[:15], bytes(PAYLOAD), bytes(lie), bytes(beyond), d, e], [whole(2, 300)]),
]

with open("frames.json", "w", encoding="utf-8") as out:
    json.dump(
        {
            "frames": [
                {"name": name, "payloads": [p.hex() for p in payloads], "messages": [m.hex() for m in messages]}
                for name, payloads, messages in VECTORS
            ]
        },
        out,
        indent=1,
    )
    out.write("\n")
