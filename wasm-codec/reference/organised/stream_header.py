"""Section "Stream header"."""
from __future__ import annotations

import struct
from typing import List, NamedTuple, Tuple

from .arithmetic import crc16, f32
from .errors import BadHeader
from .tables import CONTEXT_BYTES, PLANE_CONTEXTS, ContextSet, read_contexts

FIXED = struct.Struct('<4sBBBBHH4ffH')  # all before the palette
TILE_SIZE = 16


class StreamHeader(NamedTuple):
    stream_id: int
    width: int
    height: int
    fx: float
    fy: float
    cx: float
    cy: float
    depth_unit: float
    palette: List[Tuple[int, int, int]]
    index_contexts: ContextSet  # empty where there is no palette

    @property
    def tile_columns(self) -> int:
        return -(-self.width // TILE_SIZE)

    @property
    def tile_count(self) -> int:
        return self.tile_columns * -(-self.height // TILE_SIZE)


def read_stream_header(data: bytes) -> StreamHeader:
    """Raises BadHeader for whatever is not a header of this version."""
    if len(data) < FIXED.size:
        raise BadHeader('too short')
    (magic, format_version, tables_version, stream_id, zero, width, height,
     fx, fy, cx, cy, depth_unit, colours) = FIXED.unpack_from(data)
    if magic != b'FPOC':
        raise BadHeader('not a stream header')
    if (format_version, tables_version) != (3, 2):
        raise BadHeader(f'version {format_version} with tables {tables_version}, not 3 with 2')
    if zero != 0:
        raise BadHeader('byte 7 is not 0')
    if colours > 256:
        raise BadHeader(f'{colours} colours in the palette')
    palette_end = FIXED.size + 3 * colours
    contexts_end = palette_end + (PLANE_CONTEXTS * CONTEXT_BYTES if colours else 0)
    if len(data) != contexts_end + 2:
        raise BadHeader(f'{len(data)} bytes, not {contexts_end + 2}')
    if int.from_bytes(data[contexts_end:], 'little') != crc16(data[:contexts_end]):
        raise BadHeader('wrong CRC')
    if not (1 <= width <= 4080 and 1 <= height <= 4080):
        raise BadHeader(f'an image of {width} × {height} pixels')
    # Written so that what is not a number is refused too.
    if not (1 <= fx <= 1e6 and 1 <= fy <= 1e6):
        raise BadHeader(f'focal lengths {fx}, {fy}')
    if not (abs(cx) <= 1e6 and abs(cy) <= 1e6):
        raise BadHeader(f'centre {cx}, {cy}')
    if not f32(1e-6) <= depth_unit <= f32(0.1):
        raise BadHeader(f'depth unit {depth_unit}')
    palette = [(data[i], data[i + 1], data[i + 2]) for i in range(FIXED.size, palette_end, 3)]
    try:
        index_contexts = read_contexts(data[palette_end:contexts_end])
    except ValueError as error:
        raise BadHeader(f'palette indices: {error}') from error
    if any(0 in context.frequencies for context in index_contexts):
        raise BadHeader('palette indices: a frequency is 0')
    return StreamHeader(stream_id, width, height, fx, fy, cx, cy, depth_unit, palette, index_contexts)
