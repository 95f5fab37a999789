"""Section "Packet": one packet, decoded by itself."""
from __future__ import annotations

from typing import List, NamedTuple, Optional

from .arithmetic import crc16
from .check_value import CheckValue
from .colour_blocks import BlockDecoder, BlockSides, Sign, set_sign, signs_of
from .colour_points import PointColourDecoder
from .colours import PURE_GREEN, Colour, block_colours, point_colours
from .entropy_decoder import EntropyDecoder
from .errors import BadPacket
from .planes import PlaneDecoder, Side
from .points import Point, tile_points
from .stream_header import TILE_SIZE, StreamHeader
from .tables import ANCHOR, DEPTH, PLANE_CONTEXTS, Tables
from .tile import (EMPTY, FULL, KIND_UNKNOWN, PATTERN_UNKNOWN, Tile, kept_pixels, read_kind, read_mask,
                   read_pattern)

NO_COLOUR, HALF_CHROMA, FULL_CHROMA, PALETTE = range(4)
LAST_PATTERN_OF_BLOCKS = 2
SIGNS_IN_STATES = 60
LONGEST = 1200


def decode_packet(header: StreamHeader, tables: Tables, data: bytes) -> List[Point]:
    """The packet's points, in its order. Raises BadPacket for one that is refused or corrupt."""
    return PacketDecoder(header, tables, data).decode()


class LeftTile(NamedTuple):
    """What a tile's left neighbour hands on: None for all that is unknown."""
    kind: int
    depths: Optional[Side] = None
    indices: Optional[Side] = None
    blocks: Optional[BlockSides] = None


UNKNOWN = LeftTile(KIND_UNKNOWN)


class PacketDecoder:
    def __init__(self, header: StreamHeader, tables: Tables, data: bytes) -> None:
        if len(data) < 2:
            raise BadPacket('too short')
        if len(data) > LONGEST:
            raise BadPacket(f'longer than {LONGEST} bytes')
        if data[0] != header.stream_id:
            raise BadPacket(f'of stream {data[0]}, not {header.stream_id}')
        self._header = header
        self._data = data
        self._geometry = tables.geometry[data[1] & 7]
        self._depth_level = data[1] >> 3 & 7
        self._mode = data[1] >> 6
        self._quality = 0
        words_start = 2
        if self._has_chroma():
            words_start = 5
            if len(data) < words_start:
                raise BadPacket('too short')
            if data[2] & 0x80:
                raise BadPacket('bit 7 of byte 2 is not 0')
            if int.from_bytes(data[3:5], 'little') != crc16(data[:3] + data[5:]):
                raise BadPacket('wrong CRC')
            self._quality = data[2] & 31
        if self._mode == PALETTE and not header.palette:
            raise BadPacket('palette indices in a stream without a palette')

        self._decoder = decoder = EntropyDecoder(data, words_start)
        depth_contexts = self._geometry[DEPTH:DEPTH + PLANE_CONTEXTS]
        self._depths = PlaneDecoder(decoder, depth_contexts, self._geometry[ANCHOR])
        self._indices = PlaneDecoder(decoder, header.index_contexts, None)
        if self._has_chroma():
            colour = tables.colour[data[2] >> 5 & 3]
            self._blocks = BlockDecoder(decoder, colour, self._mode == HALF_CHROMA)
            self._point_colours = PointColourDecoder(decoder, colour)
        self._last_pattern = PATTERN_UNKNOWN
        self._signs_in_states: List[Sign] = []

    def _has_chroma(self) -> bool:
        return self._mode in (HALF_CHROMA, FULL_CHROMA)

    def decode(self) -> List[Point]:
        tile_count = self._header.tile_count
        first = self._decoder.bits((tile_count - 1).bit_length())
        count = self._decoder.octaves()
        if first + count > tile_count:
            raise BadPacket("tiles beyond the image's last")

        tiles: List[Tile] = []
        left = UNKNOWN
        for number in range(first, first + count):
            if number % self._header.tile_columns == 0:
                left = UNKNOWN
            left = self._read_tile(number, left, number == first + count - 1, tiles)

        held = self._decoder.finish()
        if self._has_chroma():
            for i, sign in enumerate(self._signs_in_states):
                set_sign(sign, held >> i & 1)
            if held >> len(self._signs_in_states):
                raise BadPacket('bits that no sign needs are not 0')
        else:
            check = CheckValue()
            for tile in tiles:
                check.add_tile(tile)
            if check.finish(self._data[:2], first, count) != held:
                raise BadPacket('wrong check value')
        return [point for tile in tiles
                for point in tile_points(self._header, self._depth_level, tile, self._colours(tile))]

    def _read_tile(self, number: int, left: LeftTile, last: bool, tiles: List[Tile]) -> LeftTile:
        """Adds a tile that is not empty to the tiles; returns what the tile on its right goes by."""
        decoder = self._decoder
        decoder.start_turns()
        kind = read_kind(decoder, self._geometry, left.kind)
        if kind == EMPTY:
            return LeftTile(EMPTY)
        pattern = self._last_pattern = read_pattern(decoder, self._geometry, self._last_pattern)
        row, column = divmod(number, self._header.tile_columns)
        pixels = kept_pixels(pattern, TILE_SIZE * column, TILE_SIZE * row)
        height, width = len(pixels), len(pixels[0])
        if kind == FULL:
            mask = [[1] * width for _ in range(height)]
        else:
            mask = read_mask(decoder, self._geometry, width, height)
        tile = Tile(number, pattern, mask, pixels)
        tiles.append(tile)
        self._check_within_image(tile)

        tile.depths, depth_side = self._depths.read(mask, left.depths)
        index_side = block_sides = None
        if self._mode == PALETTE:
            tile.indices, index_side = self._indices.read(mask, left.indices)
            self._check_within_palette(tile)
        elif self._has_chroma() and pattern <= LAST_PATTERN_OF_BLOCKS:
            tile.blocks, block_sides = self._blocks.read(mask, left.blocks)
            self._read_signs(tile, last)
        elif self._has_chroma():
            tile.point_levels = self._point_colours.read(len(tile.valid_pixels()))
        return LeftTile(kind, depth_side, index_side, block_sides)

    def _check_within_image(self, tile: Tile) -> None:
        for x, y in tile.valid_pixels():
            u, v = tile.pixels[y][x]
            if u >= self._header.width or v >= self._header.height:
                raise BadPacket('a valid pixel outside the image')

    def _check_within_palette(self, tile: Tile) -> None:
        if any(tile.indices[y][x] > len(self._header.palette) for x, y in tile.valid_pixels()):
            raise BadPacket("an index beyond the palette's end")

    def _read_signs(self, tile: Tile, last: bool) -> None:
        signs = signs_of(tile.blocks)
        if last:
            self._signs_in_states, signs = signs[:SIGNS_IN_STATES], signs[SIGNS_IN_STATES:]
        for sign in signs:
            set_sign(sign, self._decoder.bits(1))

    def _colours(self, tile: Tile) -> List[Colour]:
        """Of the valid pixels, row by row."""
        if self._mode == NO_COLOUR:
            return [PURE_GREEN for _ in tile.valid_pixels()]
        if self._mode == PALETTE:
            return [self._header.palette[tile.indices[y][x] - 1] for x, y in tile.valid_pixels()]
        if tile.pattern <= LAST_PATTERN_OF_BLOCKS:
            return block_colours(tile, self._quality, self._mode == HALF_CHROMA)
        return point_colours(tile, self._quality)
