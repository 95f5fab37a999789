"""The inverse transform of section "From symbols to points", Colour."""
from __future__ import annotations

from typing import List, Sequence, Tuple

from .arithmetic import clamp, limit16
from .colour_blocks import BLOCK

BASIS = (  # by frequency
    (64, 64, 64, 64, 64, 64, 64, 64),
    (89, 75, 50, 18, -18, -50, -75, -89),
    (83, 36, -36, -83, -83, -36, 36, 83),
    (75, -18, -89, -50, 50, 89, 18, -75),
    (64, -64, -64, 64, 64, -64, -64, 64),
    (50, -89, 18, 75, -75, -18, 89, -50),
    (36, -83, 83, -36, -36, 83, -83, 36),
    (18, -50, 75, -89, 89, -75, 50, -18),
)
BASIS_BY_PIXEL = tuple(zip(*BASIS))


def zigzag_order() -> List[Tuple[int, int]]:
    """Row and column of each coefficient in JPEG's order: along the diagonals, to and fro."""
    order = []
    for diagonal in range(2 * BLOCK - 1):
        places = [(row, diagonal - row) for row in range(BLOCK) if 0 <= diagonal - row < BLOCK]
        order += places if diagonal % 2 else places[::-1]
    return order


ZIGZAG = zigzag_order()


def inverse_transform(levels: Sequence[int], step: int) -> List[List[int]]:
    """Four times the values of a block's pixels, by row; the levels are DC, then AC in zigzag order."""
    coefficients = [[0] * BLOCK for _ in range(BLOCK)]
    for level, (row, column) in zip(levels, ZIGZAG):
        coefficients[row][column] = clamp(level * step, -32767, 32767)
    along_rows = [inverse(row, 8) for row in coefficients]
    along_columns = [inverse(column, 9) for column in zip(*along_rows)]
    return [list(row) for row in zip(*along_columns)]


def inverse(frequencies: Sequence[int], shift: int) -> List[int]:
    half = 1 << shift >> 1
    return [limit16((sum(f * b for f, b in zip(frequencies, basis)) + half) >> shift)
            for basis in BASIS_BY_PIXEL]
