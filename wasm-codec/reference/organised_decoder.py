#!/usr/bin/env python3
"""Decodes the packets of conformance vectors, each by itself, and compares their points with the vectors'.

    python3 organised_decoder.py organised.json

No packet may give other points with one byte changed, of its first and its last 40. A CRC is checked at once,
so all 255 changes of a byte are tried; packets of modes 0 and 3 are decoded to their end before they are
refused, so four changes of each byte are tried, or all with --every-change (which takes minutes).
"""
from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import Any, Dict, Iterable, List, Sequence

from organised import (BadHeader, BadPacket, Point, StreamHeader, Tables, decode_packet, load_tables,
                       read_stream_header)

TABLES = Path(__file__).resolve().parent.parent / 'crates' / 'organised-codec' / 'src' / 'tables.bin'
CHANGED_AT_EACH_END = 40
FEW_CHANGES = (0x01, 0x10, 0x80, 0xFF)


class Difference(Exception):
    """The first thing in a vector that is not as it should be."""


def check_points(points: Sequence[Point], expected: Sequence[Sequence[int]]) -> None:
    for i, (point, other) in enumerate(zip(points, expected)):
        if list(point) != list(other):
            raise Difference(f'point {i} (x, y, z, colour) is {list(point)}, not {list(other)}')
    if len(points) != len(expected):
        raise Difference(f'{len(points)} points, not {len(expected)}')


def changes_of(data: bytes, every_change: bool) -> Iterable[int]:
    """What each byte is XORed with, one after the other."""
    has_crc = data[1] >> 6 in (1, 2)
    return range(1, 256) if has_crc or every_change else FEW_CHANGES


def check_changes(header: StreamHeader, tables: Tables, data: bytes, points: List[Point],
                  every_change: bool) -> int:
    """Returns how many changed packets were decoded."""
    ends = {*range(len(data))[:CHANGED_AT_EACH_END], *range(len(data))[-CHANGED_AT_EACH_END:]}
    tried = 0
    for place in sorted(ends):
        for change in changes_of(data, every_change):
            changed = bytearray(data)
            changed[place] ^= change
            tried += 1
            try:
                same = decode_packet(header, tables, bytes(changed)) == points
            except BadPacket:
                continue
            if not same:
                raise Difference(f'with byte {place} XOR {change} it gives other points')
    return tried


def check_vector(vector: Dict[str, Any], tables: Tables, every_change: bool) -> str:
    """Returns what there was to check."""
    try:
        header = read_stream_header(bytes.fromhex(vector['streamHeader']))
    except BadHeader as error:
        raise Difference(f'stream header: {error}') from error
    points_in_all = tried = 0
    for i, packet in enumerate(vector['packets']):
        data = bytes.fromhex(packet['data'])
        try:
            points = decode_packet(header, tables, data)
            check_points(points, packet['points'])
            tried += check_changes(header, tables, data, points, every_change)
        except (BadPacket, Difference) as error:
            raise Difference(f'packet {i}: {error}') from error
        points_in_all += len(points)
    return f"{len(vector['packets'])} packets, {points_in_all} points, {tried} changed packets"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('vectors', type=Path, help='organised.json')
    parser.add_argument('--tables', type=Path, default=TABLES, help='tables.bin')
    parser.add_argument('--every-change', action='store_true', help='try all 255 changes of each byte')
    arguments = parser.parse_args()
    tables = load_tables(arguments.tables)
    for vector in json.loads(arguments.vectors.read_text(encoding='utf-8')):
        try:
            print(f"{vector['name']}: {check_vector(vector, tables, arguments.every_change)}", flush=True)
        except Difference as difference:
            print(f"{vector['name']}: DIFFERENT: {difference}")
            return 1
    return 0


if __name__ == '__main__':
    sys.exit(main())
