"""Section "Colour of patterns 0–2": blocks of 8 × 8 in the planes Y, Co, Cg."""
from __future__ import annotations

from dataclasses import dataclass, field
from typing import List, NamedTuple, Optional, Sequence, Tuple

from .arithmetic import bin_of, clamp, unfold
from .entropy_decoder import EntropyDecoder
from .tables import COEFFICIENT, DC, LAST, LEAD, ContextSet

PLANES = 3  # Y, Co, Cg
BLOCK = 8
AC_LEVELS = 63
LARGEST_DC = 16383
LARGEST_LEVEL = 4095

COUNT_BINS = (0, 4, 12, 28)
COUNT_UNKNOWN = 5
# Symbols 8 to 15 of a count: its lowest value, and how many raw bits follow.
COUNT_RANGES = ((8, 1), (10, 1), (12, 2), (16, 2), (20, 3), (28, 3), (36, 4), (52, 4))
BANDS = (1, 4, 8, 13, 19, 26, 40)
MAGNITUDE_BINS = (0, 1, 2, 4)


class Head(NamedTuple):
    """What a block's neighbours go by."""
    dc: int
    ac_count: int  # of AC levels up to the last that is not 0


@dataclass
class Block:
    plane: int
    row: int
    column: int
    head: Head
    levels: List[int] = field(default_factory=lambda: [0] * AC_LEVELS)  # in zigzag order


# Of each plane the heads of the last column in two rows; None for those that are unknown.
BlockSides = List[List[Optional[Head]]]
Sign = Tuple[Block, int]  # which level of which block it is the sign of


class BlockDecoder:
    """What goes on from tile to tile of a packet."""

    def __init__(self, decoder: EntropyDecoder, contexts: ContextSet, one_chroma_block: bool) -> None:
        self._decoder = decoder
        self._contexts = contexts
        self._one_chroma_block = one_chroma_block
        self._last_dc: List[Optional[int]] = [None] * PLANES

    def read(self, mask: Sequence[Sequence[int]],
             left: Optional[BlockSides]) -> Tuple[List[Block], BlockSides]:
        """A tile's blocks with their levels' magnitudes, and what the tile on its right goes by."""
        blocks: List[Block] = []
        sides: BlockSides = []
        pair: List[Block] = []
        for plane in range(PLANES):
            of_luma = (len(mask) // BLOCK, len(mask[0]) // BLOCK)
            rows, columns = (1, 1) if plane > 0 and self._one_chroma_block else of_luma
            always_coded = (rows, columns) != of_luma
            heads: List[List[Optional[Head]]] = [[None] * columns for _ in range(rows)]
            for row in range(rows):
                for column in range(columns):
                    if column:
                        left_head = heads[row][column - 1]
                    else:
                        left_head = left[plane][row] if left else None
                    upper_head = heads[row - 1][column] if row else None
                    if not always_coded and not has_valid_pixel(mask, row, column):
                        heads[row][column] = left_head or upper_head
                        continue
                    head = self._read_head(plane, [h for h in (left_head, upper_head) if h])
                    heads[row][column] = head
                    pair.append(Block(plane, row, column, head))
                    if len(pair) == 2:
                        self._read_magnitudes(pair)
                        blocks += pair
                        pair = []
            side = [row_heads[-1] for row_heads in heads]
            sides.append(side if rows == 2 else 2 * side)
        self._read_magnitudes(pair)
        return blocks + pair, sides

    def _read_head(self, plane: int, neighbours: List[Head]) -> Head:
        chroma = int(plane > 0)
        last_dc = self._last_dc[plane]
        if neighbours:
            known = len(neighbours)
            prediction = sum(head.dc for head in neighbours) // known
            counts = sum(head.ac_count for head in neighbours)
            count_bin = bin_of(counts if known == 2 else 2 * counts, COUNT_BINS)
        else:
            known = 0 if last_dc is None else 1
            prediction = last_dc or 0
            count_bin = COUNT_UNKNOWN
        difference = unfold(self._decoder.number(self._contexts[DC + 3 * chroma + known]))
        dc = clamp(prediction + difference, -LARGEST_DC, LARGEST_DC)
        self._last_dc[plane] = dc

        count = self._decoder.symbol(self._contexts[LAST + 6 * chroma + count_bin])
        if count >= 8:
            lowest, raw_bits = COUNT_RANGES[count - 8]
            count = min(lowest + self._decoder.bits(raw_bits), AC_LEVELS)
        return Head(dc, count)

    def _read_magnitudes(self, blocks: List[Block]) -> None:
        """The levels of a pair, one of each in turn as long as both have some; or those of a last block."""
        for i in range(max((block.head.ac_count for block in blocks), default=0)):
            for block in blocks:
                if i < block.head.ac_count:
                    self._read_magnitude(block, block.head.ac_count - 1 - i)

    def _read_magnitude(self, block: Block, position: int) -> None:
        chroma = int(block.plane > 0)
        band = bin_of(position, BANDS)
        if position == block.head.ac_count - 1:
            context, least = LEAD + 8 * chroma + band, 1
        else:
            before = sum(block.levels[position + 1:position + 3])
            context, least = COEFFICIENT + 40 * chroma + 5 * band + bin_of(before, MAGNITUDE_BINS), 0
        symbol = self._decoder.symbol(self._contexts[context])
        if symbol == 15:
            symbol = self._decoder.rest_of_number(symbol) - 70
        block.levels[position] = min(symbol + least, LARGEST_LEVEL)


def has_valid_pixel(mask: Sequence[Sequence[int]], row: int, column: int) -> bool:
    """Whether a block of luma's size has one."""
    first = BLOCK * column
    return any(any(pixels[first:first + BLOCK]) for pixels in mask[BLOCK * row:BLOCK * (row + 1)])


def signs_of(blocks: List[Block]) -> List[Sign]:
    """The signs of all AC levels that are not 0, in the order in which they come."""
    return [(block, position) for block in blocks for position in reversed(range(AC_LEVELS))
            if block.levels[position]]


def set_sign(sign: Sign, negative: int) -> None:
    block, position = sign
    if negative:
        block.levels[position] = -block.levels[position]
