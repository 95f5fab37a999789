"""Section "Colour of patterns 3–7": Y, Co, Cg of each valid pixel by itself."""
from __future__ import annotations

from typing import List, Tuple

from .arithmetic import bin_of, clamp, unfold
from .colour_blocks import LARGEST_DC, PLANES
from .entropy_decoder import EntropyDecoder
from .tables import POINT, ContextSet

RESIDUAL_BINS = (0, 2, 8)


class PointColourDecoder:
    """What goes on from tile to tile of a packet."""

    def __init__(self, decoder: EntropyDecoder, contexts: ContextSet) -> None:
        self._decoder = decoder
        self._contexts = contexts
        self._levels = [0] * PLANES

    def read(self, points: int) -> List[Tuple[int, int, int]]:
        """The levels of a tile's valid pixels."""
        residuals = [0] * PLANES  # folded
        levels = []
        for _ in range(points):
            for plane in range(PLANES):
                context = POINT + 4 * plane + bin_of(residuals[plane], RESIDUAL_BINS)
                residuals[plane] = self._decoder.number(self._contexts[context])
                level = self._levels[plane] + unfold(residuals[plane])
                self._levels[plane] = clamp(level, -LARGEST_DC, LARGEST_DC)
            levels.append((self._levels[0], self._levels[1], self._levels[2]))
        return levels
