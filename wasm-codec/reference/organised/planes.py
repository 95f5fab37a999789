"""Section "Depth" of "A tile's symbols": planes of depth and, likewise, of palette indices."""
from __future__ import annotations

from functools import lru_cache
from typing import Dict, List, Optional, Tuple

from .arithmetic import bin_of, clamp, unfold, wrap16
from .entropy_decoder import STATES, EntropyDecoder
from .tables import Context, ContextSet

LANES = 8
SIDE_PLACES = 16
LARGEST = 32767

GRADIENT_BINS = (0, 1, 2, 4, 7, 12, 22, 45, 130)
RESIDUAL_BINS = (0, 1, 4)
FIRST_ROW = 40  # its contexts, behind those by gradient
LAST_BIN_WITHOUT_RAW_BITS = 6

Plane = List[List[int]]
Side = List[int]


@lru_cache(maxsize=None)
def steps(width: int, height: int) -> List[List[Tuple[int, int]]]:
    """x, y of the pixels that are coded at the same time, by lane; one list for each time."""
    times: Dict[int, List[Tuple[int, int, int]]] = {}
    for y in range(height):
        lane = y % LANES
        for x in range(width):
            times.setdefault(x + 2 * lane + 16 * (y // LANES), []).append((lane, x, y))
    return [[(x, y) for _, x, y in sorted(times[time])] for time in sorted(times)]


class PlaneDecoder:
    """What goes on from tile to tile of a packet, for depth or for indices."""

    def __init__(self, decoder: EntropyDecoder, contexts: ContextSet,
                 anchor_context: Optional[Context]) -> None:
        """The anchor's context is None for palette indices, whose anchors are raw bits."""
        self._decoder = decoder
        self._contexts = contexts
        self._anchor_context = anchor_context
        self._residuals = [0] * LANES
        self._last_place: Optional[int] = None

    def _read_anchor(self) -> int:
        if self._anchor_context is None:
            return self._decoder.bits(8) + 1
        if self._last_place is None:
            return min(self._decoder.octaves(), LARGEST)
        difference = unfold(self._decoder.number(self._anchor_context))
        return clamp(self._last_place + difference, 1, LARGEST)

    def read(self, mask: List[List[int]], left_side: Optional[Side]) -> Tuple[Plane, Side]:
        """A tile's plane and its right side, spread over 16 places; left_side is the left tile's, or None."""
        height, width = len(mask), len(mask[0])
        values = [[0] * width for _ in range(height)]
        if left_side is None:
            # What stands left of each row; but for the first it is filled in as they begin.
            left_of = [self._read_anchor()] + [0] * (height - 1)
        else:
            left_of = [left_side[SIDE_PLACES * y // height] for y in range(height)]

        for step in steps(width, height):
            begun = []
            for x, y in step:
                if x == 0 and y > 0 and left_side is None:
                    left_of[y] = values[y - 1][0]
                L = values[y][x - 1] if x else left_of[y]
                if y == 0:
                    T = D = R = L  # so g is 0
                else:
                    above = values[y - 1]
                    T = above[x]
                    D = above[x - 1] if x else left_of[y - 1]
                    R = above[x + 1] if x + 1 < width else T
                # A limit of 16 bits on L + T − D would not change the median of values within it.
                prediction = sorted((L, T, L + T - D))[1]
                if not mask[y][x]:
                    values[y][x] = prediction
                    continue
                context = bin_of(self._residuals[y % LANES], RESIDUAL_BINS)
                gradient = bin_of(abs(L - D) + abs(T - D) + abs(R - T), GRADIENT_BINS)
                context += 4 * gradient if y else FIRST_ROW
                raw_bits = max(0, gradient - LAST_BIN_WITHOUT_RAW_BITS)
                symbol = self._decoder.symbol_by(y % STATES, self._contexts[context])
                begun.append((x, y, prediction, symbol, raw_bits))
            for x, y, prediction, symbol, raw_bits in begun:
                n = self._decoder.rest_of_number(symbol) << raw_bits
                n |= self._decoder.bits(raw_bits)
                residual = unfold(n & 0xFFFF)
                self._residuals[y % LANES] = abs(residual)
                values[y][x] = clamp(wrap16(prediction + residual), 1, LARGEST)

        self._decoder.start_turns()
        side = [values[i * height // SIDE_PLACES][width - 1] for i in range(SIDE_PLACES)]
        self._last_place = side[0]
        return values, side
